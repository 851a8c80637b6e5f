//! The threads of a batch: each takes the next run of consecutive items until none is left.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::batch::Batch;
use super::job::{BatchJob, BatchSummary, ItemAnswer};
use super::options::BatchOptions;
use super::slots::Slots;
use super::worker::Worker;
use crate::contained::contained;
use crate::error::{Error, Result};
use crate::query::QueryContext;

/// The most items of a run. Neighbouring items are asked by one thread, which remembers the pair that decided the last.
const MAX_RUN: usize = 64;
/// So many runs a thread, at least, where there are items enough: then none waits long for the last.
const RUNS_PER_THREAD: usize = 16;
/// The stack of a thread, in bytes: that of a program's main thread. C-objects may be nested deeply.
const STACK_SIZE: usize = 8 << 20;

/// An item, with its slot: `slots` are those of its run.
pub(super) struct Item<'s, S> {
    pub number: usize,
    pub slots: &'s mut S,
    pub place: usize,
}

/// Consecutive items and their slots.
struct Run<S> {
    first: usize,
    count: usize,
    slots: S,
}

/// The items that nobody has taken.
struct Queue<S> {
    next: usize,
    slots: Option<S>,
}

/// What the threads of a call share.
struct Shared<'a, S, Ask, Refuse> {
    count: usize,
    run_length: usize,
    options: &'a BatchOptions,
    queue: Mutex<Queue<S>>,
    is_stopped: AtomicBool,
    /// Beyond this item nothing is asked any more.
    first_hit: AtomicUsize,
    first_failure: Mutex<Option<(usize, Error)>>,
    ask: Ask,
    refuse: Refuse,
}

impl<S, Ask, Refuse> Shared<'_, S, Ask, Refuse>
where
    S: Slots,
    Ask: Fn(&mut Worker, &mut Item<S>) -> Result<bool> + Sync,
    Refuse: Fn(&mut S, usize, &Error) + Sync,
{
    /// The next run.
    fn take(&self) -> Option<Run<S>> {
        let mut queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
        let first = queue.next;
        if first >= self.count || self.is_over(first) {
            return None;
        }
        let count = self.run_length.min(self.count - first);
        let (slots, rest) = queue.slots.take()?.split(count);
        queue.next = first + count;
        queue.slots = Some(rest);
        Some(Run {
            first,
            count,
            slots,
        })
    }

    fn is_over(&self, item: usize) -> bool {
        self.is_stopped.load(Ordering::Relaxed) || item > self.first_hit.load(Ordering::Relaxed)
    }

    /// Asks the items of a run; whether there was one.
    fn work(&self, worker: &mut Worker) -> bool {
        let Some(mut run) = self.take() else {
            return false;
        };
        for place in 0..run.count {
            let number = run.first + place;
            if self.is_over(number) {
                return false;
            }
            worker.context.start_item(self.options.limit);
            let item = &mut Item {
                number,
                slots: &mut run.slots,
                place,
            };
            let asked = contained(|| (self.ask)(worker, item)).unwrap_or_else(|panic| {
                // Caches and scratch memory may be inconsistent.
                *worker = Worker::default();
                Err(panic)
            });
            match asked {
                Ok(true) if self.options.stop_at_hit => {
                    self.first_hit.fetch_min(number, Ordering::Relaxed);
                }
                Ok(_) => {}
                Err(error) => {
                    (self.refuse)(&mut run.slots, place, &error);
                    self.keep_failure(number, error);
                }
            }
        }
        true
    }

    fn keep_failure(&self, number: usize, error: Error) {
        let first = self.first_failure.lock();
        let mut first = first.unwrap_or_else(PoisonError::into_inner);
        if first.as_ref().is_none_or(|(other, _)| number < *other) {
            *first = Some((number, error.within(format_args!("item {number}"))));
        }
    }

    /// The part of the items that was taken.
    fn fraction(&self) -> f64 {
        let queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
        queue.next as f64 / self.count as f64
    }

    /// Works until no run is left, this thread among others.
    fn work_off(
        &self,
        workers: &mut [Worker],
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<()> {
        let Some((own, others)) = workers.split_first_mut() else {
            return Ok(());
        };
        if others.is_empty() {
            while self.work(own) {
                progress(self.fraction())?;
            }
            return Ok(());
        }
        let (outcome, helped) = std::thread::scope(|scope| {
            let helpers = others.iter_mut().map_while(|worker| {
                let work = || contained(|| while self.work(worker) {});
                let thread = std::thread::Builder::new().stack_size(STACK_SIZE);
                // Where the system has no more threads, those that there are do the work.
                thread.spawn_scoped(scope, work).ok()
            });
            let helpers: Vec<_> = helpers.collect();
            let mut outcome = Ok(());
            while outcome.is_ok() && self.work(own) {
                outcome = progress(self.fraction());
            }
            if outcome.is_err() {
                self.is_stopped.store(true, Ordering::Relaxed);
            }
            let mut helped = Ok(());
            for helper in helpers {
                match helper.join() {
                    Ok(ended) => helped = helped.and(ended),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            (outcome, helped)
        });
        outcome.and(helped)
    }
}

impl Batch {
    /// Asks `count` items, each by `ask`, which fills its slot and tells whether it was a hit; what fails or panics is passed to
    /// `refuse`. A thread is worth its while with `items_per_thread`.
    pub(super) fn run<S: Slots>(
        &mut self,
        job: BatchJob<S>,
        count: usize,
        items_per_thread: usize,
        ask: impl Fn(&mut Worker, &mut Item<S>) -> Result<bool> + Sync,
        refuse: impl Fn(&mut S, usize, &Error) + Sync,
    ) -> Result<BatchSummary> {
        let BatchJob {
            options,
            mut slots,
            progress,
        } = job;
        let threads = options.thread_count(count, items_per_thread)?;
        if self.workers.len() < threads {
            self.workers.resize_with(threads, Worker::default);
        }
        slots.begin();
        let shared = &Shared {
            count,
            run_length: (count / (RUNS_PER_THREAD * threads)).clamp(1, MAX_RUN),
            options,
            queue: Mutex::new(Queue {
                next: 0,
                slots: Some(slots),
            }),
            is_stopped: AtomicBool::new(false),
            first_hit: AtomicUsize::new(usize::MAX),
            first_failure: Mutex::new(None),
            ask,
            refuse,
        };
        progress(0.0)?;
        shared.work_off(&mut self.workers[..threads], progress)?;
        progress(1.0)?;
        let first_hit = shared.first_hit.load(Ordering::Relaxed);
        let mut first_failure = shared.first_failure.lock();
        let first_failure = first_failure.as_mut();
        let first_failure = first_failure.map_or(None, |failure| failure.take());
        Ok(BatchSummary {
            first_hit: (first_hit < count).then_some(first_hit),
            first_failure: first_failure.filter(|(number, _)| *number < first_hit),
            version: 0,
        })
    }

    /// Runs a part of a longer job for each item, on any number of threads.
    pub(crate) fn work_off(
        &mut self,
        job: BatchJob<()>,
        count: usize,
        work: impl Fn(&mut QueryContext, usize) -> Result<()> + Sync,
    ) -> Result<BatchSummary> {
        let ask = |worker: &mut Worker, item: &mut Item<()>| {
            work(&mut worker.context, item.number)?;
            Ok(false)
        };
        self.run(job, count, 1, ask, |(), _, _| ())
    }

    /// Asks `count` items where the answer needs nothing of the thread's.
    pub(super) fn answer_each<S: Slots, T>(
        &mut self,
        job: BatchJob<S>,
        count: usize,
        items_per_thread: usize,
        ask: impl Fn(&mut QueryContext, usize) -> Result<(T, bool)> + Sync,
        put: impl Fn(&mut S, usize, ItemAnswer<T>) + Sync,
    ) -> Result<BatchSummary> {
        let put = &put;
        let answer = |worker: &mut Worker, item: &mut Item<S>| {
            let (answer, is_hit) = ask(&mut worker.context, item.number)?;
            put(item.slots, item.place, Ok(answer));
            Ok(is_hit)
        };
        self.run(
            job,
            count,
            items_per_thread,
            answer,
            |slots, place, error| put(slots, place, Err(error)),
        )
    }
}
