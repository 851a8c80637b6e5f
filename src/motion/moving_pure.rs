//! A pure set over an interval of a motion, or a box of configurations: its measure at the middle, and how much may change it from
//! there.

use super::box_piece::BoxPiece;
use super::linear_motion::LinearMotion;
use super::set_tree::SetVerdict;
use super::span::{Followed, Span};
use super::start_contacts::StartContacts;
use super::way::{Way, WayKind};
use crate::cobject::{Class, PureSet, PureShape};
use crate::error::{Error, ErrorKind, Result};
use crate::nonzero::{length, product};
use crate::query::{PureAt, Scene};
use crate::robot::{Block, BlockKind, ChainRounding, Coordinate, Velocity};
use crate::space::Space;
use crate::tolerance::SUM_SLACK;

/// Asked for a link: what the rounding of its place comes from on the motion.
pub(super) type Places<'p> = dyn FnMut(usize) -> ChainRounding + 'p;

/// A pure set, or its complement, on a motion.
pub(super) struct MovingPure {
    /// Sets whose union it is.
    parts: Vec<MovingPart>,
    complement: bool,
    /// What comes at most this near counts as contact.
    threshold: f64,
}

/// A set with a bound of how its signed distance changes in the whole time, or from the middle of the whole box.
struct MovingPart {
    set: PureSet,
    rate: f64,
    /// What the rounding of configurations on the way may change.
    rounding: f64,
    /// Of each link that moves over a floor or in the world box, what the rounding of its places comes from.
    places: Vec<(usize, ChainRounding)>,
    /// Intervals before this time need no proof.
    followed_from: f64,
}

/// A piece of a motion, at its middle.
pub(super) struct Moment<'a> {
    pub way: &'a Way<'a>,
    pub scene: &'a Scene<'a>,
    pub extent: Extent<'a>,
}

/// How far a piece goes from its middle.
#[derive(Clone, Copy)]
pub(super) enum Extent<'a> {
    /// An interval.
    Time {
        /// The time at which the set is measured.
        time: f64,
        span: Span,
    },
    /// A box, which is all of the moment's way.
    Box(&'a BoxPiece<'a>),
}

impl MovingPure {
    /// Fails for sets of which no speed is known.
    pub fn new(
        way: &Way,
        places: &mut Places,
        set: &PureSet,
        complement: bool,
        threshold: f64,
    ) -> Result<Self> {
        let parts = parts_of(way, set, complement || threshold > 0.0);
        let parts = parts
            .into_iter()
            .map(|part| MovingPart::new(way, places, part, 0.0));
        Ok(Self {
            parts: parts.collect::<Result<_>>()?,
            complement,
            threshold,
        })
    }

    /// Of a motion that is known not to begin inside, with both ends in the coordinates' ranges: what rests needs no proof.
    pub fn after_start(
        way: &Way,
        places: &mut Places,
        set: &PureSet,
        start: &StartContacts,
    ) -> Result<Self> {
        let mut parts = Vec::new();
        for (number, part) in parts_on_way(way, set).into_iter().enumerate() {
            let from = start.part_followed_from(set, number);
            let part = MovingPart::new(way, places, part, from)?;
            if part.rate > 0.0 && from < 1.0 {
                parts.push(part);
            }
        }
        Ok(Self {
            parts,
            complement: false,
            threshold: 0.0,
        })
    }

    /// Whether the whole way keeps out of it, as is known beforehand.
    pub fn is_free(&self) -> bool {
        !self.complement && self.parts.is_empty()
    }

    /// What is known over an interval.
    pub fn over(&self, moment: &Moment) -> Result<SetVerdict> {
        if self.complement {
            return self.complement_over(moment);
        }
        let mut all = SetVerdict::Free;
        for part in &self.parts {
            match part.over(moment, self.threshold)? {
                SetVerdict::Meets => return Ok(SetVerdict::Meets),
                SetVerdict::Undecided => all = SetVerdict::Undecided,
                SetVerdict::Free => {}
            }
        }
        Ok(all)
    }

    /// The motion keeps out of the complement where it stays in one of the parts.
    fn complement_over(&self, moment: &Moment) -> Result<SetVerdict> {
        let mut all = SetVerdict::Meets;
        for part in &self.parts {
            match part.complement_over(moment, self.threshold)? {
                SetVerdict::Free => return Ok(SetVerdict::Free),
                SetVerdict::Undecided => all = SetVerdict::Undecided,
                SetVerdict::Meets => {}
            }
        }
        Ok(all)
    }
}

impl MovingPart {
    fn new(way: &Way, places: &mut Places, set: PureSet, followed_from: f64) -> Result<Self> {
        let rate = rate(way, &set);
        if !rate.is_finite() {
            return Err(way.line.without_speed(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "of pure set {} no speed is known: a predicate that does not measure, or a custom joint without speeds",
                    set.leaf.serial
                ),
            )));
        }
        Ok(Self {
            rounding: rounding(way, &set),
            places: rounding_of_places(&set, rate, places),
            set,
            rate,
            followed_from,
        })
    }

    fn over(&self, moment: &Moment, threshold: f64) -> Result<SetVerdict> {
        if let Extent::Time { time, span } = moment.extent {
            match Followed::over_interval(self.followed_from, time, span) {
                Followed::Yes => {}
                Followed::InPart => return Ok(SetVerdict::Undecided),
                Followed::No => return Ok(SetVerdict::Free),
            }
        }
        let pure = self.at(moment, false);
        let measured = pure.measured()?;
        let lower = pure.bounds_of(measured.as_ref())?.lower;
        // At the boundary of an open set, such as that beyond the joint limits, a configuration is outside.
        let is_inside = pure.class_of(measured.as_ref())? == Class::Inside;
        if is_inside || (threshold > 0.0 && lower <= threshold) {
            return Ok(SetVerdict::Meets);
        }
        let change = self.change(moment);
        if change == 0.0 || lower - threshold > change {
            return Ok(SetVerdict::Free);
        }
        let along = self.along_normal(moment).unwrap_or(f64::INFINITY);
        let stays_out = lower - threshold > along + self.rounding + self.rounding_of_places(moment)
            || self
                .beyond_box(moment)
                .is_some_and(|beyond| beyond > threshold);
        Ok(if stays_out {
            SetVerdict::Free
        } else {
            SetVerdict::Undecided
        })
    }

    /// A lower bound of the distance from a box all the while, by the motion of each coordinate alone: nothing is lost along a face. Where
    /// all coordinates are lines.
    fn beyond_box(&self, moment: &Moment) -> Option<f64> {
        let PureShape::Box { .. } = &self.set.shape else {
            return None;
        };
        let space = moment.scene.space();
        let is_line = |block: &Block| block.kind == BlockKind::Line;
        if !space.blocks().iter().all(is_line) {
            return None;
        }
        let reach = match moment.extent {
            Extent::Time { span, .. } => span.reach(),
            Extent::Box(_) => 1.0,
        };
        let (v, rounding) = (moment.way.line.v, moment.way.rounding());
        let beyond = self.set.beyond(&moment.scene.space_state())?;
        let left: Vec<f64> = space
            .blocks()
            .iter()
            .map(|block| {
                let k = block.velocity;
                let change = product(v[k].abs(), reach) * SUM_SLACK + rounding[k];
                (beyond[block.coordinate] - change).max(0.0)
            })
            .collect();
        // The sum of squares is off by a few roundings a coordinate.
        Some(product(self.set.scale(), length(&left)) * (1.0 - 1e-9))
    }

    fn complement_over(&self, moment: &Moment, threshold: f64) -> Result<SetVerdict> {
        let change = self.change(moment);
        let pure = self.at(moment, true);
        let measured = pure.measured()?;
        if threshold > 0.0 {
            let lower = pure.bounds_of(measured.as_ref())?.lower;
            return Ok(if lower <= threshold {
                SetVerdict::Meets
            } else if change == 0.0 || lower - threshold > change {
                SetVerdict::Free
            } else {
                SetVerdict::Undecided
            });
        }
        if pure.class_of(measured.as_ref())? == Class::Inside {
            return Ok(SetVerdict::Meets);
        }
        let stays = match measured.map(|measured| measured.measure()) {
            Some(measure) if !measure.is_bound => {
                // Predicates decide about contact themselves, and those that do not know how deep they are say nothing below 0.
                let is_predicate = matches!(self.set.shape, PureShape::Predicate(_));
                let signed = match is_predicate && !measure.knows_depth {
                    true => measure.signed.max(0.0),
                    false => measure.signed,
                };
                let highest = signed + measure.excess + measure.error + change;
                // What bodies only stand for is met by no contact epsilon: see [`PureSet::classify`].
                let epsilon = if is_predicate || measure.excess > 0.0 {
                    0.0
                } else {
                    self.set.epsilon()
                };
                highest < epsilon || (highest == epsilon && !self.set.shape.is_open())
            }
            _ => false,
        };
        Ok(if stays || change == 0.0 {
            SetVerdict::Free
        } else {
            SetVerdict::Undecided
        })
    }

    /// Bounds how much the signed distance changes from the middle of a piece on.
    fn change(&self, moment: &Moment) -> f64 {
        let (change, rounding) = match moment.extent {
            Extent::Time { span, .. } => (product(self.rate, span.reach()), self.rounding),
            Extent::Box(_) => (rate(moment.way, &self.set), rounding(moment.way, &self.set)),
        };
        change * SUM_SLACK + rounding + self.rounding_of_places(moment)
    }

    /// What the rounding of the links' places, at the middle of a piece and anywhere in it, takes off the distances measured there.
    fn rounding_of_places(&self, moment: &Moment) -> f64 {
        let reach = match moment.extent {
            Extent::Time { span, .. } => span.reach(),
            Extent::Box(_) => 1.0,
        };
        let of_link = |(link, rounding): &(usize, ChainRounding)| {
            let body = moment.scene.link(*link);
            rounding.of_places(
                body.map_or(0.0, |(body, _)| body.radius_from_origin()),
                reach,
            )
        };
        self.places.iter().map(of_link).fold(0.0, f64::max)
    }

    fn at<'a>(&'a self, moment: &Moment<'a>, complement: bool) -> PureAt<'a> {
        PureAt {
            set: &self.set,
            complement,
            scene: moment.scene,
        }
    }

    /// How far the link over a floor may come down from the middle of the interval on, by its motion along the normal alone:
    /// nothing for a base that slides.
    fn along_normal(&self, moment: &Moment) -> Option<f64> {
        let PureShape::Floor { links, normal, .. } = &self.set.shape else {
            return None;
        };
        let &[link] = &links[..] else {
            return None;
        };
        let half = match moment.extent {
            Extent::Time { span, .. } => span.reach(),
            Extent::Box(piece) => {
                let (body, _) = moment.scene.link(link)?;
                return Some(piece.change_along(link, body, normal)? * SUM_SLACK);
            }
        };
        let extent = moment.scene.link(link)?.0.radius_from_origin();
        let space = moment.scene.space();
        let state = moment.scene.state()?;
        let is_straight = matches!(moment.way.kind, WayKind::Line);
        let toward = |sign: f64| {
            let v = moment.way.line.v.iter();
            let v: Vec<f64> = v.map(|rate| sign * half * rate).collect();
            let velocity = match is_straight {
                true => Velocity::Constant(&v),
                false => Velocity::AtMost(&v),
            };
            space.directed_motion_bound(link, extent, normal, state, velocity)
        };
        let along = match is_straight {
            true => toward(1.0).max(toward(-1.0)),
            false => toward(1.0),
        };
        Some(along * SUM_SLACK)
    }
}

/// The sets that are followed one by one.
fn parts_of(way: &Way, set: &PureSet, is_whole: bool) -> Vec<PureSet> {
    let space = way.line.cobject.space();
    if matches!(set.shape, PureShape::BeyondLimits) {
        // Between configurations in range, coordinates that move alone are in range.
        let is_in_range = |q: &[f64]| space.beyond_limits(q).is_none();
        let stays = match way.kind {
            WayKind::Line => is_in_range(way.line.q) && way.at(1.0).is_ok_and(|q| is_in_range(&q)),
            WayKind::Curve { controls } => controls.chunks_exact(way.line.q.len()).all(is_in_range),
            WayKind::Stated(motion) => motion.farthest().iter().all(|q| is_in_range(q)),
            WayKind::Box { low, high } => is_in_range(low) && is_in_range(high),
        };
        if is_whole || !stays {
            return vec![set.clone()];
        }
        // In a box the positions of free joints are coordinates like others.
        if matches!(way.kind, WayKind::Box { .. }) {
            return Vec::new();
        }
    }
    parts_on_way(way, set)
}

/// The sets that are followed one by one, of a way with both ends in the coordinates' ranges.
fn parts_on_way(way: &Way, set: &PureSet) -> Vec<PureSet> {
    let LinearMotion { cobject, q, v, .. } = way.line;
    let space = cobject.space();
    set.parts_on_way(space, || match way.kind {
        WayKind::Line => space.straight(q, v).collect(),
        _ => Vec::new(),
    })
}

/// Bounds how much the signed distance changes in the whole time, or from the middle of a box.
fn rate(way: &Way, set: &PureSet) -> f64 {
    let space = way.line.cobject.space();
    let (q, v) = (way.line.q, way.line.v);
    let speed = || product(set.scale(), length(v));
    match &set.shape {
        // Distances in the metric of C-space change no faster than the configuration.
        PureShape::Predicate(predicate) if predicate.measures() => speed(),
        PureShape::BeyondLimits => speed(),
        PureShape::HalfSpace { .. } if matches!(way.kind, WayKind::Line) => {
            let back: Vec<f64> = v.iter().map(|rate| -rate).collect();
            let falls = |v: &[f64]| set.motion_bound(space, q, v);
            falls(v).max(falls(&back))
        }
        PureShape::HalfSpace { normal, .. } => {
            set.motion_bound(space, q, &falling(space, normal, v))
        }
        _ => set.motion_bound(space, q, v),
    }
}

/// The velocity of these sizes that leads straightest into a half-space.
fn falling(space: &Space, normal: &[f64], v: &[f64]) -> Vec<f64> {
    let mut falling = v.to_vec();
    for block in space.blocks() {
        if block.kind == BlockKind::Line {
            let k = block.velocity;
            falling[k] = v[k].copysign(-normal[block.coordinate]);
        }
    }
    falling
}

/// Bounds how much the rounding of configurations on the way changes the signed distance.
fn rounding(way: &Way, set: &PureSet) -> f64 {
    let space = way.line.cobject.space();
    let mut v = way.rounding();
    match &set.shape {
        PureShape::Predicate(_) => product(set.scale(), length(&v)),
        PureShape::BeyondLimits => {
            for block in space.blocks() {
                let own = block.coordinate..block.coordinate + block.kind.nq();
                if !own.clone().any(|c| has_range(&space.coordinates()[c])) {
                    v[block.velocity..block.velocity + block.kind.nv()].fill(0.0);
                }
            }
            product(set.scale(), length(&v))
        }
        PureShape::HalfSpace { normal, .. } => {
            set.motion_bound(space, way.line.q, &falling(space, normal, &v))
        }
        _ => set.motion_bound(space, way.line.q, &v),
    }
}

/// What the rounding of the places of links comes from, if they move at all over a floor or in the world box. `rate` bounds how far.
fn rounding_of_places(
    set: &PureSet,
    rate: f64,
    places: &mut Places,
) -> Vec<(usize, ChainRounding)> {
    let (PureShape::Floor { links, .. } | PureShape::BeyondWorld { links }) = &set.shape else {
        return Vec::new();
    };
    if rate == 0.0 {
        return Vec::new();
    }
    let of_link = |&link: &usize| {
        let mut rounding = places(link);
        // Joints of which no more than a speed is known go no farther than that.
        rounding.size += rate;
        (link, rounding)
    };
    links.iter().map(of_link).collect()
}

fn has_range(coordinate: &Coordinate) -> bool {
    match coordinate {
        Coordinate::Interval { lower, upper } => lower.is_finite() || upper.is_finite(),
        _ => false,
    }
}
