//! The least distance along a path of several segments.

use super::clearance::{ClearanceOptions, ClearanceOutcome, MotionClearance, STEP};
use super::path::{Path, checked_count};
use crate::cobject::CObject;
use crate::error::{ErrorKind, Result};
use crate::query::{Configuration, QueryContext};
use crate::room::room_for;

/// The least distance along a path.
#[derive(Clone, Debug)]
pub struct PathClearance {
    /// The number of the segment with the nearest place, from 0.
    pub segment: usize,
    /// The bounds are of the whole path; time, configuration and distance are those of the nearest place, in its segment.
    pub clearance: MotionClearance,
}

/// What is known while segments are looked at one after the other.
struct Search<'a> {
    path: &'a Path<'a>,
    options: &'a ClearanceOptions,
    /// The segments, those with the nearest points first.
    order: Vec<usize>,
    /// The least lower bound of those that were looked at.
    lower: f64,
    /// Whether all of these were proved free.
    is_free: bool,
    nearest: Option<PathClearance>,
}

impl Search<'_> {
    /// Of the bodies grown by their stated deviations, as proofs know them.
    fn upper(&self) -> f64 {
        let nearest = self.nearest.as_ref();
        nearest.map_or(f64::INFINITY, |nearest| {
            nearest.clearance.distance.upper_of_grown()
        })
    }

    /// What the next segment is asked for: one that is proved to be farther than this changes nothing.
    fn options(&self) -> ClearanceOptions {
        let upper = self.upper();
        let beyond = if upper.is_finite() {
            (upper - STEP * self.options.allowed(upper)).max(0.0)
        } else {
            f64::INFINITY
        };
        ClearanceOptions {
            max_distance: self.options.max_distance.min(beyond),
            ..*self.options
        }
    }

    fn take(&mut self, segment: usize, found: MotionClearance) {
        self.lower = self.lower.min(found.lower);
        let proved = matches!(
            found.outcome,
            ClearanceOutcome::Known | ClearanceOutcome::BeyondMax
        );
        self.is_free &= proved || found.lower > 0.0;
        if self.nearest.is_none() || found.distance.upper_of_grown() < self.upper() {
            self.nearest = Some(PathClearance {
                segment,
                clearance: found,
            });
        }
    }

    /// What all segments together say.
    fn whole(&self, last: ClearanceOutcome) -> ClearanceOutcome {
        let upper = self.upper();
        match last {
            ClearanceOutcome::Hit | ClearanceOutcome::Undecided | ClearanceOutcome::Empty => last,
            _ if !self.is_free => ClearanceOutcome::Near,
            _ if upper.is_infinite() && self.lower >= self.options.max_distance => {
                ClearanceOutcome::BeyondMax
            }
            _ if upper - self.lower.min(upper) <= self.options.allowed(upper) => {
                ClearanceOutcome::Known
            }
            _ => ClearanceOutcome::Near,
        }
    }
}

impl QueryContext {
    /// The least distance from a C-object, a union of induced and pure sets, along a path: that of
    /// [`QueryContext::motion_clearance`] over all its segments, in one state of the world. `points` holds one configuration after the
    /// other. The limit of work counts for the whole path. `progress` receives the part of the segments that were looked at, and may
    /// stop the work with an error.
    pub fn path_clearance(
        &mut self,
        cobject: &CObject,
        points: &[f64],
        options: &ClearanceOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<PathClearance> {
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        options.check_for(cobject)?;
        checked_count(cobject.space(), points)?;
        let world = &self.look(cobject);
        let path = &Path {
            world,
            cobject,
            points,
        };
        let mut search = Search {
            path,
            options,
            order: self.nearest_first(path, options.max_distance)?,
            lower: f64::INFINITY,
            is_free: true,
            nearest: None,
        };
        let last = match self.search_segments(&mut search, progress) {
            // Where not even the first segment is known there is nothing to tell.
            Err(error) if error.kind == ErrorKind::Limit && search.nearest.is_some() => {
                ClearanceOutcome::Undecided
            }
            last => last?,
        };
        progress(1.0)?;
        let outcome = search.whole(last);
        // Segments that were not looked at may be nearer.
        let looked_at_all = !matches!(last, ClearanceOutcome::Undecided | ClearanceOutcome::Hit);
        let lower = if looked_at_all { search.lower } else { 0.0 };
        let mut found = search.nearest.expect("a path has a segment");
        found.clearance.outcome = outcome;
        found.clearance.lower = lower.min(found.clearance.upper);
        Ok(found)
    }

    /// The numbers of the segments, by the distance of the nearer of their two points.
    fn nearest_first(&mut self, path: &Path, max_distance: f64) -> Result<Vec<usize>> {
        let nq = path.cobject.space().nq();
        let count = path.points.len().checked_div(nq).unwrap_or(1);
        let mut limit = max_distance;
        let (mut distances, mut order) = (room_for(count)?, room_for(path.segment_count())?);
        for i in 0..count {
            let at = Configuration::Coordinates(path.point(i));
            let distance = match self.distance_in(path.world, path.cobject, at, limit) {
                // The order changes no answer.
                Err(error) if error.kind == ErrorKind::Limit && i > 0 => break,
                distance => distance?.upper_of_grown(),
            };
            limit = limit.min(distance);
            distances.push(distance);
        }
        distances.resize(count, f64::INFINITY);
        let nearer = |&segment: &usize| distances[segment].min(distances[(segment + 1) % count]);
        order.extend(0..path.segment_count());
        order.sort_by(|a, b| nearer(a).total_cmp(&nearer(b)));
        Ok(order)
    }

    /// Looks at one segment after the other; returns how the last of them ended.
    fn search_segments(
        &mut self,
        search: &mut Search,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<ClearanceOutcome> {
        let mut last = ClearanceOutcome::Empty;
        for done in 0..search.order.len() {
            progress(done as f64 / search.order.len() as f64)?;
            let segment = search.order[done];
            let options = &search.options();
            let found = search
                .path
                .ask(segment, |way| self.clearance_on(way, options))?;
            last = found.outcome;
            search.take(segment, found);
            // The set is empty everywhere, or nothing is nearer than contact.
            let is_over = matches!(last, ClearanceOutcome::Empty | ClearanceOutcome::Hit);
            if is_over || last == ClearanceOutcome::Undecided {
                break;
            }
        }
        Ok(last)
    }
}
