//! The check of a certificate: whether it proves that a motion keeps clear of a C-object.
//!
//! Nothing that found the proof is asked. The check goes through what the C-object asks about (`statement`), item by item, and
//! follows the certificate's steps: each either parts what is to be shown into halves, which together are all of it, or shows it by an
//! entry. So what the entries show covers all primitives of all body pairs at all times. What an entry claims is measured anew
//! (`measure`). Bodies that are solids are also shown to be outside of each other at one time (`outside`): as their surfaces never
//! meet, they stay so.

use super::carried_points::Course;
use super::certificate::{Certificate, Entry, Step};
use super::fingerprint::fingerprint;
use super::measure::{Along, Measure, Measured, Part};
use super::statement::{Claim, Item, Statement, What};
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;
use crate::query::{Configuration, Scene, SceneMemory, World};

/// Intervals are not halved below this: it bounds the depth of a proof.
pub(super) const SHORTEST: f64 = 1.0 / (1u64 << 40) as f64;

fn refused(what: impl Into<String>) -> Error {
    Error::new(ErrorKind::NotProved, what)
}

impl Certificate {
    /// Checks that this proves the motion from q0 to q1, as [`crate::space::Space::interpolate`] makes it, free of a C-object, in the
    /// state that its environments are in now: that everything stays farther away than the threshold. Fails with
    /// [`ErrorKind::NotProved`], naming the entry, where it does not: where it was made for other bodies, robots or sets, another motion
    /// or threshold, where an entry claims too much, or where entries are missing.
    pub fn verify(&self, cobject: &CObject, q0: &[f64], q1: &[f64], threshold: f64) -> Result<()> {
        let space = cobject.space();
        for (q, name) in [(q0, "q0"), (q1, "q1")] {
            let checked = space.check_configuration(q);
            checked.map_err(|error| error.within(name))?;
        }
        if self.ends != [q0, q1] {
            return Err(refused("the certificate is of another motion"));
        }
        if self.threshold != threshold {
            let own = self.threshold;
            return Err(refused(format!(
                "the certificate is of the threshold {own}, not {threshold}"
            )));
        }
        if threshold > 0.0 {
            cobject.require_one_metric()?;
        }
        // As it was made: of the set without what is known of its parts.
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        let world = &World::of(cobject);
        let start = Configuration::Coordinates(q0);
        let scene = &Scene::new(space, world, start, SceneMemory::default())?;
        let statement = &Statement::of(cobject, scene, threshold)?;
        if self.fingerprint != fingerprint(statement) {
            return Err(refused(
                "the certificate is of other robots, bodies, poses or sets",
            ));
        }
        self.check_orders(statement)?;
        let course = Course {
            space,
            q0,
            v: space.difference(q0, q1),
        };
        let mut check = Check {
            measure: Measure::new(course, q1, &self.orders),
            certificate: self,
            steps: 0,
            entries: 0,
        };
        check.claim(&statement.claim, [0.0, 1.0])?;
        let unread = self.steps.len() - check.steps + self.entries.len() - check.entries;
        match unread {
            0 => Ok(()),
            _ => Err(refused(format!(
                "{unread} steps or entries follow the proof"
            ))),
        }
    }

    /// Every primitive of every body stands once in the body's order.
    fn check_orders(&self, statement: &Statement) -> Result<()> {
        if self.orders.len() != statement.bodies.len() {
            return Err(refused("the certificate is of another number of bodies"));
        }
        for (order, body) in self.orders.iter().zip(&statement.bodies) {
            let mut sorted = order.clone();
            sorted.sort_unstable();
            if !sorted.into_iter().eq(0..body.primitives().len() as u32) {
                return Err(refused(
                    "an order of primitives does not have each of them once",
                ));
            }
        }
        Ok(())
    }
}

struct Check<'a> {
    measure: Measure<'a>,
    certificate: &'a Certificate,
    /// How many steps and entries have been read.
    steps: usize,
    entries: usize,
}

impl Check<'_> {
    fn step(&mut self) -> Result<Step> {
        let step = self.certificate.steps.get(self.steps);
        self.steps += 1;
        step.copied()
            .ok_or_else(|| refused("the certificate ends before the proof does"))
    }

    fn refused_here(&self, what: &str) -> Error {
        refused(format!("before entry {}: {what}", self.entries))
    }

    /// Shows that the motion keeps out of a set over an interval.
    fn claim(&mut self, claim: &Claim, times: [f64; 2]) -> Result<()> {
        match claim {
            Claim::All(claims) => claims.iter().try_for_each(|claim| self.claim(claim, times)),
            Claim::One { parts, .. } => match self.step()? {
                Step::HALVE_TIME => {
                    let halves = self.halves_of_time(times)?;
                    halves
                        .into_iter()
                        .try_for_each(|half| self.claim(claim, half))
                }
                Step(number) => {
                    let chosen = number.checked_sub(Step::CHOOSE_FIRST);
                    let part = chosen.and_then(|chosen| parts.get(chosen as usize));
                    match part.and_then(|part| part.claim.as_ref()) {
                        Some(part) => self.claim(part, times),
                        None => Err(self.refused_here("no part of the intersection is chosen")),
                    }
                }
            },
            Claim::Item(item) => {
                let groups = item.whole();
                self.part(item, Part { groups, times })?;
                match self.measure.is_outside(item, times[0])? {
                    true => Ok(()),
                    false => {
                        Err(self.refused_here("a body is inside a solid, or that is not certain"))
                    }
                }
            }
        }
    }

    /// Shows an item for two groups of primitives over an interval.
    fn part(&mut self, item: &Item, part: Part) -> Result<()> {
        match self.step()? {
            Step::PROVED => self.entry(item, &part),
            Step::HALVE_TIME => {
                let halves = self.halves_of_time(part.times)?;
                halves
                    .into_iter()
                    .try_for_each(|times| self.part(item, Part { times, ..part }))
            }
            step @ (Step::HALVE_FIRST | Step::HALVE_SECOND) => {
                let side = usize::from(step == Step::HALVE_SECOND);
                let halves = halves_of_group(part.groups[side]);
                let halves = halves.ok_or_else(|| self.refused_here("one primitive is halved"))?;
                halves.into_iter().try_for_each(|half| {
                    let mut groups = part.groups;
                    groups[side] = half;
                    self.part(item, Part { groups, ..part })
                })
            }
            _ => Err(self.refused_here("a step chooses a part of no intersection")),
        }
    }

    fn halves_of_time(&self, times: [f64; 2]) -> Result<[[f64; 2]; 2]> {
        halves_of_time(times).ok_or_else(|| self.refused_here("the interval is too short"))
    }

    /// Shows it by the next entry.
    fn entry(&mut self, item: &Item, part: &Part) -> Result<()> {
        let number = self.entries;
        let entry = self.certificate.entries.get(number);
        let entry = entry.ok_or_else(|| refused("the certificate ends before the proof does"))?;
        self.entries += 1;
        let fails = |what: String| Err(refused(format!("entry {number}: {what}")));
        let named = (entry.item, entry.links, entry.bodies);
        if named != (item.number, item.links(), item.bodies()) {
            return fails(format!("it is of item {}, not {}", entry.item, item.number));
        }
        if (entry.groups, entry.times) != (part.groups, part.times) {
            return fails("its primitives or its interval are others".into());
        }
        let direction = Vec3::from(entry.direction);
        let is_unit = (direction.norm() - 1.0).abs() <= 1e-9;
        let is_of_item = match &item.what {
            What::Bodies(_) => is_unit && entry.carrier <= 1,
            What::Plane { normal, .. } => direction == *normal && entry.carrier == 1,
            What::Coordinates(_) => direction == Vec3::zeros() && entry.carrier == 1,
        };
        if !is_of_item {
            return fails("its direction is not a unit vector, or another".into());
        }
        // A direction longer than 1 by rounding would make the gap larger.
        let along = Along {
            carrier: entry.carrier as usize,
            direction: direction / direction.norm().max(1.0),
        };
        let Measured {
            gap, displacement, ..
        } = self.measure.of(item, part, &along)?;
        // What is not a number fails every comparison.
        let [has_gap, stays] = [entry.gap <= gap, entry.displacement >= displacement];
        if !has_gap {
            return fails(format!("the gap is {gap:e}, not {:e}", entry.gap));
        }
        if !stays {
            let claimed = entry.displacement;
            return fails(format!(
                "the displacement is {displacement:e}, not {claimed:e}"
            ));
        }
        if !entry.is_enough_for(item) {
            return fails("the gap less the displacement is not above the limit".into());
        }
        Ok(())
    }
}

impl Entry {
    /// Whether what it claims keeps an item farther away than its limit. A configuration on the boundary of an open set is outside.
    pub(super) fn is_enough_for(&self, item: &Item) -> bool {
        let is_open = match &item.what {
            What::Bodies(_) => false,
            What::Plane { is_open, .. } => *is_open,
            What::Coordinates(pure) => pure.shape.is_open(),
        };
        let left = self.gap - self.displacement;
        left > item.limit || (is_open && item.limit == 0.0 && left == 0.0)
    }
}

/// Both halves of an interval; `None` if it is too short.
pub(super) fn halves_of_time([start, end]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let middle = 0.5 * (start + end);
    (end - start > SHORTEST).then_some([[start, middle], [middle, end]])
}

/// Both halves of a group; `None` if it is one primitive, or none.
pub(super) fn halves_of_group([first, count]: [u32; 2]) -> Option<[[u32; 2]; 2]> {
    let half = count / 2;
    (half > 0).then_some([[first, half], [first + half, count - half]])
}
