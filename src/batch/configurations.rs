//! Batches of configurations: class, within, distance.

use super::batch::Batch;
use super::job::{BatchJob, BatchSummary, ItemAnswer};
use super::run::Item;
use super::slots::Slots;
use super::worker::Worker;
use crate::cobject::{CObject, Class};
use crate::error::{Error, ErrorKind, Result};
use crate::query::{Configuration, Distance, QueryContext, World, check_threshold};

/// A thread is begun for so many configurations.
const PER_THREAD: usize = 8;

/// Configurations one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Configurations<'a> {
    /// Their coordinates, `nq` of each.
    pub q: &'a [f64],
    /// How many there are: a space without coordinates has some too.
    pub count: usize,
}

impl<'a> Configurations<'a> {
    pub(super) fn at(&self, item: usize) -> &'a [f64] {
        let nq = self.q.len() / self.count;
        &self.q[item * nq..(item + 1) * nq]
    }

    /// Refuses another number of coordinates than the space's.
    pub(super) fn check(&self, cobject: &CObject, name: &str) -> Result<()> {
        let nq = cobject.space().nq();
        if self.count.checked_mul(nq) == Some(self.q.len()) {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "{name} has {} numbers, which are not {} configurations of {nq} coordinates",
                self.q.len(),
                self.count
            ),
        ))
    }
}

impl Batch {
    /// Operation 4 at each configuration: inside, in contact or outside. Inside is a hit.
    pub fn classify<S: Slots>(
        &mut self,
        cobject: &CObject,
        at: Configurations,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<Class>) + Sync,
    ) -> Result<BatchSummary> {
        at.check(cobject, "q")?;
        let world = &World::of(cobject);
        let ask = |context: &mut QueryContext, item| {
            let class = context.classify_in(world, cobject, at.at(item))?;
            Ok((class, class == Class::Inside))
        };
        let done = self.answer_each(job, at.count, PER_THREAD, ask, put)?;
        Ok(done.in_world(world))
    }

    /// Whether the distance may be at most `threshold`, at each configuration. Within is a hit.
    pub fn within<S: Slots>(
        &mut self,
        cobject: &CObject,
        at: Configurations,
        threshold: f64,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<bool>) + Sync,
    ) -> Result<BatchSummary> {
        at.check(cobject, "q")?;
        check_threshold(threshold, "threshold")?;
        cobject.require_one_metric()?;
        let world = &World::of(cobject);
        let ask = |context: &mut QueryContext, item| {
            let q = Configuration::Coordinates(at.at(item));
            let is_within = context.within_in(world, cobject, q, threshold)?;
            Ok((is_within, is_within))
        };
        let done = self.answer_each(job, at.count, PER_THREAD, ask, put)?;
        Ok(done.in_world(world))
    }

    /// Operation 6 at each configuration, up to `max_distance`. Distance 0 is a hit.
    pub fn distance<S: Slots>(
        &mut self,
        cobject: &CObject,
        at: Configurations,
        max_distance: f64,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<Distance>) + Sync,
    ) -> Result<BatchSummary> {
        at.check(cobject, "q")?;
        check_threshold(max_distance, "max_distance")?;
        cobject.require_one_metric()?;
        let world = &World::of(cobject);
        let ask = |context: &mut QueryContext, item| {
            let q = Configuration::Coordinates(at.at(item));
            let distance = context.distance_in(world, cobject, q, max_distance)?;
            let is_hit = distance.distance == 0.0;
            Ok((distance, is_hit))
        };
        let done = self.answer_each(job, at.count, PER_THREAD, ask, put)?;
        Ok(done.in_world(world))
    }

    /// The same with the gradient of the contact, a row that is empty where there is none.
    pub fn distance_with_gradient<S: Slots>(
        &mut self,
        cobject: &CObject,
        at: Configurations,
        max_distance: f64,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<(Distance, &[f64])>) + Sync,
    ) -> Result<BatchSummary> {
        at.check(cobject, "q")?;
        check_threshold(max_distance, "max_distance")?;
        cobject.require_one_metric()?;
        let world = &World::of(cobject);
        let put = &put;
        let ask = |Worker { context, row }: &mut Worker, item: &mut Item<S>| {
            let q = at.at(item.number);
            let distance =
                context.distance_with_gradient_in(world, cobject, q, max_distance, row)?;
            let is_hit = distance.distance == 0.0;
            put(item.slots, item.place, Ok((distance, row)));
            Ok(is_hit)
        };
        let refuse = |slots: &mut S, place: usize, error: &Error| put(slots, place, Err(error));
        let done = self.run(job, at.count, PER_THREAD, ask, refuse)?;
        Ok(done.in_world(world))
    }
}
