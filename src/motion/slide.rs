//! The step that slides along contacts instead of running into them (Appendix A: `slide`).

use std::cell::Cell;

use super::half_spaces::dot;
use super::interval_proof::{Proof, ProofLimits};
use super::linear_motion::LinearMotion;
use super::slide_contacts::Detail;
use super::slide_options::SlideOptions;
use super::slide_step::{Approach, LEAST_GAIN, nearest_movable, slide_step, spring_step};
use super::start_contacts::{StartContacts, TouchAllowance};
use super::step_limits::step_limits;
use super::way::Way;
use crate::cobject::{CObject, PureShape, Set};
use crate::error::{Error, ErrorKind, Result};
use crate::nonzero;
use crate::query::{Configuration, ContactRecord, QueryContext, WitnessList, World};
use crate::space::Space;

/// How a slide ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlideOutcome {
    /// A step was found; the whole motion is proved free.
    Moved,
    /// The configuration is inside the C-object, so it cannot slide.
    Inside,
    /// No step is possible: contacts, the coordinates' ranges or the world box block the way. To first order, no step as
    /// long as the floor that stays free, keeps the distance (or the desired distance, if that is less), the ranges and the
    /// box gains more than 1 % of its length along the requested step.
    Blocked,
}

/// The result of a slide.
#[derive(Clone, Debug)]
pub struct SlideStep {
    /// How the slide ended.
    pub outcome: SlideOutcome,
    /// The configuration reached; the start unless the robot moved.
    pub configuration: Vec<f64>,
    /// The distance at the start.
    pub distance_before: f64,
    /// The distance at the configuration reached.
    pub distance_after: f64,
    /// The number of contacts that constrained the step.
    pub contacts: usize,
}

/// A robot that is nearer than the desired distance by less than this fraction of it is not pushed out; otherwise it would
/// jitter.
const DEAD_BAND: f64 = 1e-2;

/// A step may miss the distance to keep by this fraction of the desired distance: what corrections leave over.
const FALL_SHORT: f64 = 1e-4;

/// The most corrections of a step at its end: contact normals turn during the step.
const MAX_CORRECTIONS: usize = 3;

/// The contacts that a step of this length can bring nearer by more than the tolerance.
fn approaches(list: &WitnessList, length: f64, desired: f64) -> Vec<Approach<'_>> {
    let mut all = list.approaches();
    all.retain(|a| nonzero::length(a.gradient) * 4.0 * length > 0.5 * FALL_SHORT * desired);
    all
}

/// Where a slide led.
pub(super) struct Slid {
    /// How it ended.
    pub outcome: SlideOutcome,
    /// The configuration reached; the start unless the robot moved.
    pub configuration: Vec<f64>,
    /// The number of contacts that constrained the step.
    contacts: usize,
}

/// What all attempts of one slide share.
struct SlideRequest<'a> {
    world: &'a World,
    cobject: &'a CObject,
    q: &'a [f64],
    here: Here<'a>,
    options: &'a SlideOptions,
    /// What touches, and what may still touch after a step.
    allowance: TouchAllowance,
    /// Contacts of less clearance overlap.
    too_deep: f64,
    /// The length of the requested step.
    length: f64,
    detail: Detail,
    /// How many intervals proofs may still look at.
    intervals_left: Cell<usize>,
}

/// What is near at the start.
struct Here<'a> {
    list: &'a WitnessList,
    contacts: Vec<Approach<'a>>,
    /// The clearance of the nearest.
    near: f64,
    /// The clearance to keep: within the desired distance that of the nearest contact.
    keep: f64,
}

impl<'a> Here<'a> {
    fn of(list: &'a WitnessList, length: f64, desired: f64) -> Self {
        let contacts = approaches(list, length, desired);
        let near = nearest_movable(&contacts);
        Self {
            list,
            contacts,
            near,
            keep: near.min(desired),
        }
    }
}

impl QueryContext {
    /// One step from q, given as a velocity for a unit of time. The result is `step` itself where nothing is within the
    /// shell; else the nearest step that brings no contact nearer than the desired distance (or than the nearest contact,
    /// if that is nearer). A robot within the desired distance is pushed out to it. The step is corrected at its end, and
    /// halved until the whole motion is proved free.
    pub fn slide(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        step: &[f64],
        options: &SlideOptions,
    ) -> Result<SlideStep> {
        options.check()?;
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        // One state of the world for the whole slide: the proof must not combine distances of several.
        let world = &self.look(cobject);
        let slid = self.slide_in(world, cobject, q, step, options)?;
        let before = self.distance_at(world, cobject, q)?;
        let after = match slid.outcome {
            SlideOutcome::Moved => self.distance_at(world, cobject, &slid.configuration)?,
            SlideOutcome::Inside | SlideOutcome::Blocked => before,
        };
        Ok(SlideStep {
            outcome: slid.outcome,
            configuration: slid.configuration,
            distance_before: before,
            distance_after: after,
            contacts: slid.contacts,
        })
    }

    /// The same in a given world, with checked options, and without distances.
    pub(super) fn slide_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        q: &[f64],
        step: &[f64],
        options: &SlideOptions,
    ) -> Result<Slid> {
        let space = cobject.space();
        space.check_configuration(q)?;
        space.check_velocity(step, "step")?;
        require_union(cobject)?;
        let here = self.slide_contacts(world, cobject, q, options, Detail::Nearest)?;
        let contacts = here.contacts.len();
        let ended = |outcome| Slid {
            outcome,
            configuration: q.to_vec(),
            contacts,
        };
        let too_deep = too_deep(space, options);
        // A touching robot may slide; one whose primitives overlap, or are closer than the margin, may not.
        if here.overlaps(too_deep) {
            return Ok(ended(SlideOutcome::Inside));
        }
        let length = nonzero::length(step);
        if length == 0.0 || !space.contains(q)? {
            return Ok(ended(SlideOutcome::Blocked));
        }
        let motion = LinearMotion {
            world,
            cobject,
            q,
            v: step,
        };
        if !motion.states_speeds() {
            return Err(motion.without_speed(Error::new(
                ErrorKind::Unsupported,
                "a custom joint that the step moves does not state its speeds, so that no way can be proved free",
            )));
        }
        let mut request = SlideRequest {
            world,
            cobject,
            q,
            here: Here::of(&here, length, options.desired_distance),
            options,
            allowance: TouchAllowance {
                distance: TOUCH_FRACTION * options.max_shell.min(smallest_radius(world, space)),
                max_count: options.max_witnesses,
            },
            too_deep,
            length,
            detail: Detail::Nearest,
            intervals_left: Cell::new(MAX_INTERVALS_OF_SLIDE),
        };
        let mut reached = self.find_step(&request, step)?;
        // Contacts that were left out of large meshes may have blocked the step, so try again with all.
        let all;
        if reached.is_none() {
            all = self.slide_contacts(world, cobject, q, options, Detail::All)?;
            request.here = Here::of(&all, length, options.desired_distance);
            request.detail = Detail::All;
            reached = self.find_step(&request, step)?;
        }
        Ok(match reached {
            Some(configuration) => Slid {
                configuration,
                ..ended(SlideOutcome::Moved)
            },
            None => ended(SlideOutcome::Blocked),
        })
    }

    /// The configuration reached by the longest acceptable fraction of a step.
    fn find_step(&mut self, request: &SlideRequest, step: &[f64]) -> Result<Option<Vec<f64>>> {
        let push = OutwardStep::of(request)?;
        let mut share = 1.0;
        while share >= request.options.floor {
            let wish: Vec<f64> = step.iter().map(|x| x * share).collect();
            let pushed = push.as_ref().map(|push| push.part(share));
            let wishes = pushed.as_ref().into_iter().map(Some).chain([None]);
            for push in wishes {
                let found = self.try_step(request, &wish, push)?;
                if found.is_some() {
                    return Ok(found);
                }
            }
            share *= 0.5;
        }
        Ok(None)
    }

    fn distance_at(&mut self, world: &World, cobject: &CObject, q: &[f64]) -> Result<f64> {
        let at = Configuration::Coordinates(q);
        let found = self.distance_in(world, cobject, at, f64::INFINITY)?;
        Ok(found.distance)
    }

    /// The configuration reached by one attempt, if it keeps its distance, gains or is pushed out, and is free all the way.
    fn try_step(
        &mut self,
        request: &SlideRequest,
        wish: &[f64],
        push: Option<&OutwardStep>,
    ) -> Result<Option<Vec<f64>>> {
        let space = request.cobject.space();
        let Some(first) = request.first_step(wish, push)? else {
            return Ok(None);
        };
        let first = space.clamp(&space.step(request.q, &first));
        let Some((reached, nearest)) = self.corrected(request, first, nonzero::length(wish))?
        else {
            return Ok(None);
        };
        let way = space.displacement(request.q, &reached);
        let is_worth = request.is_worth(&way, wish, push.is_some(), nearest);
        if !is_worth || !space.contains(&reached)? {
            return Ok(None);
        }
        let motion = LinearMotion {
            world: request.world,
            cobject: request.cobject,
            q: request.q,
            v: &way,
        };
        let is_free = self.way_is_free(request, motion)?;
        Ok(is_free.then_some(reached))
    }

    /// Where the contacts at the end of a step correct it to, by no more than `length` at a time, with the clearance there; `None` where
    /// that is of no avail.
    fn corrected(
        &mut self,
        request: &SlideRequest,
        first: Vec<f64>,
        length: f64,
    ) -> Result<Option<(Vec<f64>, f64)>> {
        let &SlideRequest {
            world,
            cobject,
            options,
            ..
        } = request;
        let (space, desired) = (cobject.space(), options.desired_distance);
        let keep = request.here.keep;
        let mut reached = first;
        let mut corrections = 0;
        loop {
            if space.check_configuration(&reached).is_err() {
                return Ok(None);
            }
            let there = self.slide_contacts(world, cobject, &reached, options, request.detail)?;
            if there.overlaps(request.too_deep) {
                return Ok(None);
            }
            let contacts = approaches(&there, request.length, desired);
            let nearest = nearest_movable(&contacts);
            if corrections == MAX_CORRECTIONS || nearest >= keep - 0.1 * FALL_SHORT * desired {
                return Ok(Some((reached, nearest)));
            }
            corrections += 1;
            let limits = step_limits(space, &reached, length)?;
            match spring_step(&contacts, &limits, keep) {
                Some(correction) if nonzero::length(&correction) <= length => {
                    reached = space.clamp(&space.step(&reached, &correction));
                }
                _ => return Ok(None),
            }
        }
    }

    /// Whether the robot is proved to keep clear of the C-object on a motion from the start.
    fn way_is_free(&mut self, request: &SlideRequest, motion: LinearMotion) -> Result<bool> {
        let allowance = &request.allowance;
        let mut start = StartContacts::default();
        let clearances = request.here.list.contacts.iter().map(|c| c.clearance);
        if clearances.fold(f64::INFINITY, f64::min) <= allowance.distance {
            match self.start_contacts(&motion, allowance)? {
                Some(found) => start = found,
                None => return Ok(false),
            }
        }
        let left = request.intervals_left.get();
        let given = left.min(MAX_INTERVALS);
        let limits = &mut ProofLimits {
            tolerance: 1.0,
            any_contact: true,
            intervals: given,
        };
        let way = &Way::straight(motion);
        // The start is known not to be inside; what the proof meets later is contact enough.
        let confirm = &mut |_: &mut Self, _| Ok(false);
        let proof = self.prove_way(way, 0.0, limits, Some(&start), confirm);
        request
            .intervals_left
            .set(left - (given - limits.intervals));
        match proof {
            Ok(Proof::Free) => Ok(true),
            Ok(_) => self.scratch.meter().check().map(|()| false),
            // Contacts may turn a step so that it moves a custom joint that does not state its speeds.
            Err(error) if error.kind == ErrorKind::Unsupported => Ok(false),
            Err(error) => Err(error),
        }
    }
}

impl SlideRequest<'_> {
    /// Along the contacts and out from them, as far as either is possible.
    fn first_step(&self, wish: &[f64], push: Option<&OutwardStep>) -> Result<Option<Vec<f64>>> {
        let limits = step_limits(self.cobject.space(), self.q, nonzero::length(wish))?;
        let Here { contacts, keep, .. } = &self.here;
        let along = slide_step(wish, contacts, &limits, *keep, self.options.normalize);
        Ok(match (along, push) {
            (Some(along), Some(push)) => {
                Some(along.iter().zip(&push.step).map(|(a, b)| a + b).collect())
            }
            (Some(along), None) => Some(along),
            (None, push) => push.map(|push| push.step.clone()),
        })
    }

    /// Whether a way keeps its distance, and gains or is pushed out; `nearest` is the clearance at its end.
    fn is_worth(&self, way: &[f64], wish: &[f64], is_pushed: bool, nearest: f64) -> bool {
        let Here { near, keep, .. } = self.here;
        let desired = self.options.desired_distance;
        let length = nonzero::length(wish);
        let (gain, moved) = (dot(way, wish) / length, nonzero::length(way));
        let gains = moved > LEAST_GAIN * length && gain > LEAST_GAIN * moved;
        let keeps = nearest >= keep - FALL_SHORT * desired;
        // A push alone must gain more distance than advancing steps may lose, or the two would alternate forever.
        let gets_out = is_pushed && nearest - near >= 0.25 * DEAD_BAND * desired;
        keeps && (gains || gets_out)
    }
}

/// A way whose proof takes more intervals than this counts as blocked. Some thousands are needed by what turns 1e-9 above a floor from
/// which no plane parts it, millions by joints and shapes of the caller's that state no more than speeds or farthest points.
const MAX_INTERVALS: usize = 1 << 14;

/// The same for all ways that a slide tries.
const MAX_INTERVALS_OF_SLIDE: usize = 1 << 16;

/// How far a touching robot may move before a distance must prove it free, as a fraction of the shell or of the smallest
/// link.
const TOUCH_FRACTION: f64 = 1e-4;

/// Refuses sets whose distances cannot prove a motion free.
fn require_union(cobject: &CObject) -> Result<()> {
    let measures = |cobject: &CObject| match cobject.set() {
        Set::Pure(pure) => !matches!(pure.shape, PureShape::Predicate(_)),
        _ => false,
    };
    let all = match cobject.set() {
        Set::Union { others, .. } => others.iter().all(|other| measures(other)),
        _ => measures(cobject),
    };
    if all {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::Unsupported,
        "slides need a union of induced sets and of pure sets that are no predicates: no way through others can be proved free",
    ))
}

/// The least radius of a body that a link carries, its own or an attached object.
fn smallest_radius(world: &World, space: &Space) -> f64 {
    let attached = world.attached(space);
    let attached = attached.map(|(_, object, _)| object.body.radius());
    link_radii(space)
        .chain(attached)
        .fold(f64::INFINITY, f64::min)
}

impl WitnessList {
    /// Whether primitives overlap, or are nearer to each other than a clearance below 0.
    fn overlaps(&self, too_deep: f64) -> bool {
        let is_too_deep = |contact: &ContactRecord| contact.clearance < too_deep;
        self.witnesses.iter().any(|witness| witness.overlapping)
            || self.contacts.iter().any(is_too_deep)
    }
}

/// Clearances below this are of primitives that overlap, or are closer than the margin: by more than slides leave of their shell, or of the
/// largest body where the shell is larger than any.
fn too_deep(space: &Space, options: &SlideOptions) -> f64 {
    let largest = link_radii(space).fold(0.0, f64::max);
    let size = match largest > 0.0 {
        true => options.max_shell.min(largest),
        false => options.max_shell,
    };
    -1e-9 * size
}

fn link_radii(space: &Space) -> impl Iterator<Item = f64> {
    let links = (0..space.link_count()).filter_map(|link| space.body(link));
    links.map(|body| body.radius())
}

/// A step out to the desired distance.
struct OutwardStep {
    step: Vec<f64>,
}

impl OutwardStep {
    /// The push for a configuration within the desired distance, no longer than `length`; `None` where opposing contacts
    /// leave hardly any gain.
    fn of(request: &SlideRequest) -> Result<Option<Self>> {
        let (space, length) = (request.cobject.space(), request.length);
        let desired = request.options.desired_distance;
        let Here { contacts, near, .. } = &request.here;
        if *near >= desired * (1.0 - DEAD_BAND) {
            return Ok(None);
        }
        let limits = step_limits(space, request.q, length)?;
        let Some(step) = spring_step(contacts, &limits, desired) else {
            return Ok(None);
        };
        let after = contacts
            .iter()
            .map(|a| a.clearance + dot(a.gradient, &step));
        let is_worth = after.fold(desired, f64::min) - near >= DEAD_BAND * desired;
        let part = (length / nonzero::length(&step)).min(1.0);
        Ok(is_worth.then(|| Self { step }.part(part)))
    }

    /// A fraction of the push: to first order, each contact is then at least as far as at one of its ends.
    fn part(&self, share: f64) -> Self {
        Self {
            step: self.step.iter().map(|x| x * share).collect(),
        }
    }
}
