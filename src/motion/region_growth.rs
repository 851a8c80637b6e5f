//! A box of C-space around a configuration, grown until contacts stop each of its sides.

use super::gathering::Keeps;
use super::region_proof::{BoxProof, BoxWork, Region, coordinates_of_velocities};
use crate::cobject::{CObject, Class};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::query::{Configuration, Distance, QueryContext, World};
use crate::robot::Coordinate;
use crate::space::Space;

/// A side that was free grows by this much more the next time.
const FASTER: f64 = 1.5;

/// All sides together are tried with the largest side halved so often: a configuration nearer to contact gets a box that leads away from
/// it.
const MAX_HALVINGS: usize = 24;

/// How a box is grown. Lengths of sides are counted in weights: those of a velocity with weight 2 grow twice as far.
#[derive(Clone, Copy, Debug)]
pub struct GrowthOptions {
    /// A side is stopped when it cannot grow by this much more, or by a quarter of what all sides could grow together, if that is less;
    /// larger than 0.
    pub tolerance: f64,
    /// No side goes farther than this from the configuration; finite, larger than 0.
    pub max_side: f64,
    /// The most boxes that each proof may take, at least 1.
    pub max_boxes: usize,
}

impl Default for GrowthOptions {
    fn default() -> Self {
        Self {
            tolerance: 0.01,
            max_side: 4.0,
            max_boxes: 200,
        }
    }
}

/// What stops a side of a grown box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SideStop {
    /// It was not to grow: its weight is 0, or it belongs to a quaternion.
    Fixed,
    /// The end of the coordinate's range; on circles half a turn.
    Range,
    /// The largest side of the options.
    MaxSide,
    /// A contact is certain a little farther.
    Contact,
    /// A little farther no proof was found within the number of boxes, nor a contact.
    Unproved,
    /// The work of the call was limited (see [`QueryContext::set_limit`]).
    Limited,
}

/// A side of a grown box.
#[derive(Clone, Debug)]
pub struct RegionSide {
    /// What stops it.
    pub stop: SideStop,
    /// The configuration in contact, or that no box around could be proved: of contacts and of what is unproved.
    pub configuration: Option<Vec<f64>>,
    /// The distance there, with its witness; unless lengths and units of C-space mix in the set.
    pub distance: Option<Distance>,
}

/// A box that is proved free.
#[derive(Clone, Debug)]
pub struct GrownRegion {
    /// The lowest coordinates. Angles do not wrap.
    pub low: Vec<f64>,
    /// The highest.
    pub high: Vec<f64>,
    /// The lower and the upper side of each velocity's coordinate, in turn.
    pub sides: Vec<RegionSide>,
}

impl GrowthOptions {
    fn check(&self) -> Result<()> {
        for (value, name) in [(self.tolerance, "tolerance"), (self.max_side, "max_side")] {
            require_coordinates(&[value], name)?;
            if value <= 0.0 {
                return Err(Error::invalid(format!("{name} is {value}, not above 0")));
            }
        }
        if self.max_boxes == 0 {
            return Err(Error::invalid("max_boxes is 0: nothing can be proved"));
        }
        Ok(())
    }
}

/// A side while the box grows.
struct Side {
    coordinate: usize,
    is_upper: bool,
    weight: f64,
    /// The farthest value it may take, and what stops it there.
    end: f64,
    at_end: SideStop,
    /// How much farther it is tried next, in weights.
    step: f64,
    /// `None` while it grows.
    stop: Option<SideStop>,
    /// Where the last proof failed, and whether it ended in contact.
    failed: Option<(Vec<f64>, SideStop)>,
}

impl Side {
    fn new(space: &Space, q: &[f64], place: [usize; 2], weight: f64, max_side: f64) -> Self {
        let [side, coordinate] = place;
        let is_upper = side == 1;
        let x = q[coordinate];
        let farthest = weight * max_side;
        let (room, at_room) = match space.coordinates()[coordinate] {
            Coordinate::Circle => (std::f64::consts::PI, SideStop::Range),
            Coordinate::Interval { lower, upper } => {
                let room = if is_upper { upper - x } else { x - lower };
                (room.max(0.0), SideStop::Range)
            }
            Coordinate::Quaternion => (0.0, SideStop::Fixed),
        };
        let (room, at_end) = if farthest < room {
            (farthest, SideStop::MaxSide)
        } else {
            (room, at_room)
        };
        let end = match (space.coordinates()[coordinate], at_end) {
            // To the last bit.
            (Coordinate::Interval { upper, .. }, SideStop::Range) if is_upper => upper.max(x),
            (Coordinate::Interval { lower, .. }, SideStop::Range) => lower.min(x),
            _ if is_upper => x + room,
            _ => x - room,
        };
        Self {
            coordinate,
            is_upper,
            weight,
            end,
            at_end,
            step: 0.0,
            stop: (weight == 0.0).then_some(SideStop::Fixed),
            failed: None,
        }
    }

    fn ends<'r>(&self, region: &'r mut Region) -> &'r mut f64 {
        let ends = if self.is_upper {
            &mut region.high
        } else {
            &mut region.low
        };
        &mut ends[self.coordinate]
    }

    /// The value it has in a box, moved on by a length, but not beyond its end.
    fn moved_on(&self, from: f64, length: f64) -> f64 {
        if self.is_upper {
            (from + length).min(self.end)
        } else {
            (from - length).max(self.end)
        }
    }
}

/// What growing takes.
struct Growth<'a> {
    world: &'a World,
    cobject: &'a CObject,
    options: &'a GrowthOptions,
    /// That of the options, or less in narrow places.
    tolerance: f64,
    region: Region,
    sides: Vec<Side>,
}

impl QueryContext {
    /// A box around q that is proved free, grown on each side until something stops it. `weights` has one entry per velocity, at
    /// least 0; without weights each counts as 1. All sides first grow together, then each as far as it can, a step at a time in
    /// turn. The same call has the same answer.
    pub fn grow_region(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        weights: Option<&[f64]>,
        options: &GrowthOptions,
    ) -> Result<GrownRegion> {
        options.check()?;
        let space = cobject.space();
        space.check_configuration(q)?;
        if let Some(weights) = weights {
            space.check_weights(weights)?;
        }
        let world = &self.look(cobject);
        if self.classify_in(world, cobject, q)? == Class::Inside {
            return Err(Error::invalid(
                "q is inside the C-object: no box around it is free",
            ));
        }
        let mut sides = Vec::new();
        for (k, coordinate) in coordinates_of_velocities(space) {
            let weight = weights.map_or(1.0, |weights| weights[k]);
            for side in 0..2 {
                let place = [side, coordinate];
                sides.push(Side::new(space, q, place, weight, options.max_side));
            }
        }
        let mut growth = Growth {
            world,
            cobject,
            options,
            tolerance: options.tolerance,
            region: Region {
                low: q.to_vec(),
                high: q.to_vec(),
            },
            sides,
        };
        growth.together(self)?;
        growth.in_turn(self)?;
        growth.answer(self)
    }
}

impl Growth<'_> {
    /// Where the work of the call ends on the way, nothing is known.
    fn prove(&self, region: &Region, context: &mut QueryContext) -> Result<BoxProof> {
        let max_boxes = self.options.max_boxes;
        let found = context.prove_region(
            self.world,
            self.cobject,
            region,
            Keeps::Out,
            BoxWork::sampled(max_boxes),
        );
        match found {
            Err(error) if error.kind == ErrorKind::Limit => Ok(BoxProof::Undecided {
                at: region.low.clone(),
                proved: 0.0,
            }),
            found => found,
        }
    }

    /// The box with all sides moved on from where they are.
    fn all_moved_on(&self, length: f64) -> Region {
        let mut region = self.region.clone();
        for side in &self.sides {
            let end = side.ends(&mut region);
            *end = side.moved_on(*end, length * side.weight);
        }
        region
    }

    /// Grows all sides by the same length, as far as powers of 2 and two bisections tell.
    fn together(&mut self, context: &mut QueryContext) -> Result<()> {
        let mut grown = None;
        let mut length = self.options.max_side;
        for _ in 0..=MAX_HALVINGS {
            let region = self.all_moved_on(length);
            if matches!(self.prove(&region, context)?, BoxProof::Free) {
                grown = Some(region);
                break;
            }
            length *= 0.5;
        }
        if let Some(mut grown) = grown {
            let mut more = 0.5 * length;
            if length < self.options.max_side {
                for _ in 0..2 {
                    let region = self.all_moved_on(length + more);
                    if matches!(self.prove(&region, context)?, BoxProof::Free) {
                        length += more;
                        grown = region;
                    }
                    more *= 0.5;
                }
            }
            self.region = grown;
            self.tolerance = self.tolerance.min(0.25 * length);
        }
        for side in &mut self.sides {
            side.step = self.tolerance.max(0.25 * length);
        }
        Ok(())
    }

    /// Grows the sides one after the other, each by a step that depends on its own successes, until all are stopped.
    fn in_turn(&mut self, context: &mut QueryContext) -> Result<()> {
        while self.sides.iter().any(|side| side.stop.is_none()) {
            for i in 0..self.sides.len() {
                if self.sides[i].stop.is_none() {
                    self.grow(i, context)?;
                }
            }
        }
        Ok(())
    }

    /// Grows one side, if what it would add is proved free.
    fn grow(&mut self, i: usize, context: &mut QueryContext) -> Result<()> {
        let side = &self.sides[i];
        let from = *side.ends(&mut self.region);
        let to = side.moved_on(from, side.step * side.weight);
        if to == from {
            // Elsewhere than at its end a step is lost in rounding.
            let failed = side.failed.as_ref().map_or(SideStop::Unproved, |f| f.1);
            let stop = if from == side.end {
                side.at_end
            } else {
                failed
            };
            self.sides[i].stop = Some(stop);
            return Ok(());
        }
        let c = side.coordinate;
        let mut added = self.region.clone();
        [added.low[c], added.high[c]] = if side.is_upper {
            [from, to]
        } else {
            [to, from]
        };
        let found = self.prove(&added, context)?;
        let is_limited = context.scratch.meter().is_exceeded();
        let side = &mut self.sides[i];
        let failed = match found {
            BoxProof::Free => {
                *side.ends(&mut self.region) = to;
                side.step *= FASTER;
                return Ok(());
            }
            _ if is_limited => {
                side.stop = Some(SideStop::Limited);
                return Ok(());
            }
            BoxProof::Meets(at) => (at, SideStop::Contact),
            BoxProof::Undecided { at, .. } => (at, SideStop::Unproved),
        };
        // A step to the end may have been shorter than the side's.
        let tried = side.step.min((to - from).abs() / side.weight);
        if tried <= self.tolerance {
            side.stop = Some(failed.1);
        }
        side.step = self.tolerance.max(0.5 * tried);
        side.failed = Some(failed);
        Ok(())
    }

    fn answer(self, context: &mut QueryContext) -> Result<GrownRegion> {
        let has_distances = self.cobject.require_one_metric().is_ok();
        let nv = self.cobject.space().nv();
        let fixed = RegionSide {
            stop: SideStop::Fixed,
            configuration: None,
            distance: None,
        };
        let mut sides = vec![fixed; 2 * nv];
        let places = coordinates_of_velocities(self.cobject.space()).map(|(k, _)| k);
        let places = places.flat_map(|k| [2 * k, 2 * k + 1]);
        for (place, side) in places.zip(self.sides) {
            let Some(stop) = side.stop else {
                continue;
            };
            sides[place].stop = stop;
            if let (SideStop::Contact | SideStop::Unproved, Some((at, _))) = (stop, side.failed) {
                if has_distances && !context.scratch.meter().is_exceeded() {
                    let q = Configuration::Coordinates(&at);
                    let found = context.distance_in(self.world, self.cobject, q, f64::INFINITY);
                    sides[place].distance = match found {
                        Err(error) if error.kind == ErrorKind::Limit => None,
                        found => Some(found?),
                    };
                }
                sides[place].configuration = Some(at);
            }
        }
        let Region { low, high } = self.region;
        Ok(GrownRegion { low, high, sides })
    }
}
