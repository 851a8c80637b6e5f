//! How far a configuration is from a pure set: closed forms on lines, circles and rotations.
//!
//! The metric is that of the product: the root of the sum of the squares of differences, angles the shorter way round, of
//! free joints the shift and the turn apart. Outside a set the measure is the distance, inside minus the depth, which is the
//! distance from the complement.

use std::f64::consts::TAU;

use super::{Class, PureSet, PureShape};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Pose, Vec3};
use crate::robot::{Coordinate, Posture};
use crate::space::{Space, shorter_way};
use crate::tolerance::{DISTANCE_ERROR, EPSILON, LARGEST_COORDINATE};

/// A configuration: its coordinates, where they are known, and the poses of all links at it.
#[derive(Clone, Copy, Debug)]
pub struct Stand<'a> {
    pub space: &'a Space,
    pub q: Option<&'a [f64]>,
    pub poses: &'a [Pose],
}

/// A signed distance, known to `error`; in lengths where the set has a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Positive outside, negative inside; infinite where the set is empty, or all there is.
    pub signed: f64,
    pub error: f64,
    /// The truth is no less, but may be more.
    pub is_bound: bool,
    /// Inside, `signed` is minus the distance from the complement.
    pub knows_depth: bool,
}

/// Where in the world a set is near: a point of a link (its origin, for the world box), and the direction out of the set.
#[derive(Clone, Copy, Debug)]
pub struct WorldPlace {
    pub link: usize,
    /// Of the link's body, if the point is one of it.
    pub primitive: Option<u32>,
    pub point: Vec3,
    pub normal: Vec3,
}

/// How far q is from the nearest end of one coordinate's interval, from without (positive) or within; and the derivative.
#[derive(Clone, Copy)]
struct Span {
    beyond: f64,
    slope: f64,
    error: f64,
}

fn span(coordinate: Coordinate, q: f64, low: f64, high: f64) -> Option<Span> {
    let relative = |beyond: f64| 4.0 * EPSILON * beyond.abs();
    match coordinate {
        Coordinate::Quaternion => None,
        Coordinate::Interval { .. } => {
            if low == f64::NEG_INFINITY && high == f64::INFINITY {
                return None;
            }
            let (above, below) = (q - high, low - q);
            let (beyond, slope) = if above >= below {
                (above, 1.0)
            } else {
                (below, -1.0)
            };
            Some(Span {
                beyond,
                slope,
                error: relative(beyond),
            })
        }
        Coordinate::Circle => {
            let half = 0.5 * (high - low);
            if !half.is_finite() || 2.0 * half >= TAU {
                return None;
            }
            let from_middle = shorter_way(q - (low + half));
            let size = q.abs().max(low.abs()).max(high.abs()).max(TAU);
            Some(Span {
                beyond: from_middle.abs() - half,
                slope: if from_middle < 0.0 { -1.0 } else { 1.0 },
                error: 8.0 * EPSILON * size,
            })
        }
    }
}

/// The measure of a set of intervals, and its derivative by the coordinates: outside the length of what is beyond, inside the
/// least depth.
fn of_spans(spans: &[Option<Span>]) -> (f64, f64, Vec<f64>) {
    let mut by_coordinate = vec![0.0; spans.len()];
    let known = || {
        spans
            .iter()
            .enumerate()
            .filter_map(|(i, s)| Some((i, (*s)?)))
    };
    let error = known().map(|(_, span)| span.error).sum();
    let largest = known()
        .map(|(_, s)| s.beyond)
        .fold(f64::NEG_INFINITY, f64::max);
    if largest <= 0.0 {
        let first = known().find(|(_, span)| span.beyond == largest);
        if let Some((i, span)) = first {
            by_coordinate[i] = span.slope;
        }
        return (largest, error, by_coordinate);
    }
    let outside = || known().filter(|(_, span)| span.beyond > 0.0);
    // Scaled, so that no square overflows.
    let sum: f64 = outside().map(|(_, s)| (s.beyond / largest).powi(2)).sum();
    let length = largest * sum.sqrt();
    for (i, span) in outside() {
        by_coordinate[i] = span.slope * (span.beyond / length);
    }
    (length, error, by_coordinate)
}

impl PureSet {
    /// Where the configuration stands.
    pub fn classify(&self, at: &Stand) -> Result<Class> {
        if let PureShape::Predicate(predicate) = &self.shape {
            let class = predicate.classify(self.coordinates(at)?);
            return class.map_err(|e| self.named(e));
        }
        let Some(measure) = self.unscaled(at)? else {
            return Ok(Class::Outside);
        };
        Ok(measure.class(self.shape.is_open(), self.options.contact_epsilon))
    }

    /// How near what made a contact is, at most, in the unit of measures. Predicates say by themselves what is in contact.
    pub fn epsilon(&self) -> f64 {
        match self.shape {
            PureShape::Predicate(_) => f64::INFINITY,
            _ => self.options.contact_epsilon * self.scale(),
        }
    }

    /// What measures are multiplied by. The world box is measured in lengths already.
    pub fn scale(&self) -> f64 {
        match self.shape {
            _ if self.shape.is_in_world() => 1.0,
            _ => self.options.scale.unwrap_or(1.0),
        }
    }

    fn named(&self, error: Error) -> Error {
        error.within(format_args!("C-object {}", self.leaf.serial))
    }

    /// The signed distance; `None` of a predicate that does not measure.
    pub fn measure(&self, at: &Stand) -> Result<Option<Measure>> {
        let scale = self.scale();
        let scaled = |x: f64| match x * scale {
            // What is not 0 stays so.
            0.0 if x != 0.0 => f64::MIN_POSITIVE.copysign(x),
            scaled => scaled,
        };
        let found = self.unscaled(at)?;
        Ok(found.map(|found| Measure {
            signed: scaled(found.signed),
            error: found.error * scale,
            ..found
        }))
    }

    fn unscaled(&self, at: &Stand) -> Result<Option<Measure>> {
        let found = match &self.shape {
            PureShape::Predicate(predicate) => {
                let q = self.coordinates(at)?;
                let distance = predicate.distance(q).map_err(|e| self.named(e))?;
                let Some(signed) = distance else {
                    return Ok(None);
                };
                let class = predicate.classify(q).map_err(|e| self.named(e))?;
                self.check_predicate(signed, class)?;
                Measure {
                    signed,
                    error: 0.0,
                    is_bound: !predicate.is_exact(),
                    knows_depth: predicate.knows_depth(),
                }
            }
            PureShape::Floor {
                links,
                normal,
                offset,
            } => {
                let (signed, _) = over_floor(at, links, normal, *offset);
                let reach = links.iter().map(|&link| reach_of(at, link));
                Measure {
                    signed,
                    error: DISTANCE_ERROR * reach.fold(offset.abs(), f64::max),
                    is_bound: false,
                    knows_depth: false,
                }
            }
            PureShape::BeyondWorld { links } => {
                let (signed, _) = beyond_world(at, links);
                let size = links.iter().map(|&link| at.poses[link].translation.amax());
                Measure {
                    signed,
                    error: DISTANCE_ERROR * size.fold(0.0, f64::max),
                    is_bound: false,
                    // How far a link must be moved says less than how far the robot must.
                    knows_depth: false,
                }
            }
            _ => {
                let (signed, error, _) = self.by_coordinate(at.space, self.coordinates(at)?);
                Measure {
                    signed,
                    error,
                    is_bound: false,
                    knows_depth: true,
                }
            }
        };
        Ok(Some(found))
    }

    /// Where in the world, for sets that are there.
    pub fn place(&self, at: &Stand) -> Option<WorldPlace> {
        match &self.shape {
            PureShape::BeyondWorld { links } => beyond_world(at, links).1,
            PureShape::Floor {
                links,
                normal,
                offset,
            } => over_floor(at, links, normal, *offset).1,
            _ => None,
        }
    }

    /// The coordinate that decides the measure of limits or a box: the one farthest beyond its interval, or nearest to an end
    /// of it.
    pub fn coordinate(&self, at: &Stand) -> Option<usize> {
        let spans = self.spans(at.space, at.q?)?;
        let known = spans
            .iter()
            .enumerate()
            .filter_map(|(i, span)| Some((i, (*span)?.beyond)));
        let most = known.clone().map(|(_, beyond)| beyond);
        let most = most.fold(f64::NEG_INFINITY, f64::max);
        known
            .into_iter()
            .find(|(_, beyond)| *beyond == most)
            .map(|(i, _)| i)
    }

    /// The derivative of the measure, one entry a velocity.
    pub fn gradient(&self, at: &Stand) -> Result<Vec<f64>> {
        let space = at.space;
        let q = self.coordinates(at)?;
        let mut row = match &self.shape {
            PureShape::Predicate(predicate) => {
                let mut row = vec![f64::NAN; space.nv()];
                let is_known = predicate.gradient(q, &mut row).map_err(|e| self.named(e))?;
                if !is_known {
                    return Err(Error::new(
                        ErrorKind::Unsupported,
                        format!(
                            "C-object {} is a predicate without a gradient",
                            self.leaf.serial
                        ),
                    ));
                }
                crate::error::require_coordinates(&row, "the predicate's gradient entry")
                    .map_err(|e| self.named(Error::new(ErrorKind::Callback, e.message)))?;
                row
            }
            PureShape::BeyondWorld { .. } | PureShape::Floor { .. } => {
                let place = self.place(at);
                let mut row = vec![0.0; space.nv()];
                if let Some(place) = place {
                    let posture = Posture { q, poses: at.poses };
                    space.add_gradient(
                        posture,
                        place.link,
                        &place.point,
                        &place.normal,
                        &mut row,
                    )?;
                }
                return Ok(row);
            }
            PureShape::Ball { center, .. } => {
                let offset = space.offset(center, q);
                let length = norm(&offset);
                let mut row = space.offset_as_velocity(q, &offset);
                // At the centre no way out is shorter than another.
                let factor = if length > 0.0 { 1.0 / length } else { 0.0 };
                row.iter_mut().for_each(|x| *x *= factor);
                row
            }
            _ => {
                let (_, _, by_coordinate) = self.by_coordinate(space, q);
                space.by_velocity(q, &by_coordinate)
            }
        };
        let scale = self.scale();
        row.iter_mut().for_each(|x| *x *= scale);
        Ok(row)
    }

    /// The measure before the scale, its error, and its derivative by the coordinates.
    fn by_coordinate(&self, space: &Space, q: &[f64]) -> (f64, f64, Vec<f64>) {
        match &self.shape {
            PureShape::BeyondLimits | PureShape::Box { .. } => {
                let spans = self.spans(space, q).unwrap_or_default();
                let (measure, error, slopes) = of_spans(&spans);
                if matches!(self.shape, PureShape::Box { .. }) {
                    return (measure, error, slopes);
                }
                (-measure, error, slopes.iter().map(|x| -x).collect())
            }
            PureShape::HalfSpace { normal, offset } => {
                let length = norm(normal);
                let unit: Vec<f64> = normal.iter().map(|x| x / length).collect();
                let terms = || unit.iter().zip(q).map(|(n, x)| n * x);
                let signed = terms().sum::<f64>() - offset / length;
                let size = terms().map(f64::abs).sum::<f64>() + (offset / length).abs();
                let error = (q.len() + 4) as f64 * EPSILON * size;
                (signed, error, unit)
            }
            PureShape::Ball { center, radius } => {
                let offset = space.offset(center, q);
                let sizes = center.iter().chain(q).map(|x| x.abs());
                let size = sizes.fold(TAU.max(*radius), f64::max);
                let error = 8.0 * (q.len() as f64).sqrt() * EPSILON * size;
                (norm(&offset) - radius, error, Vec::new())
            }
            PureShape::BeyondWorld { .. } | PureShape::Floor { .. } | PureShape::Predicate(_) => {
                (f64::INFINITY, 0.0, Vec::new())
            }
        }
    }

    /// How far each coordinate is from the ends of its interval, for limits and boxes.
    fn spans(&self, space: &Space, q: &[f64]) -> Option<Vec<Option<Span>>> {
        let coordinates = space.coordinates().iter().zip(q).enumerate();
        let spans = coordinates.map(|(i, (&coordinate, &x))| match &self.shape {
            PureShape::BeyondLimits => match coordinate {
                Coordinate::Interval { lower, upper } => Some(span(coordinate, x, lower, upper)),
                _ => Some(None),
            },
            PureShape::Box { low, high } => Some(span(coordinate, x, low[i], high[i])),
            _ => None,
        });
        spans.collect()
    }

    fn coordinates<'a>(&self, at: &Stand<'a>) -> Result<&'a [f64]> {
        at.q.ok_or_else(|| {
            Error::new(
                ErrorKind::Unsupported,
                format!(
                    "C-object {} is {}, which needs the coordinates: link poses alone do not tell them",
                    self.leaf.serial,
                    self.shape.name()
                ),
            )
        })
    }

    fn check_predicate(&self, signed: f64, class: Class) -> Result<()> {
        let is_number = signed.abs() <= LARGEST_COORDINATE;
        let fits = is_number
            && if class == Class::Inside {
                signed <= 0.0
            } else {
                signed > 0.0
            };
        if fits {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::Callback,
            format!(
                "C-object {}: the predicate's distance is {signed} where it says {class:?}",
                self.leaf.serial
            ),
        ))
    }
}

impl Measure {
    fn class(&self, is_open: bool, epsilon: f64) -> Class {
        let inside = if is_open {
            self.signed < -self.error
        } else {
            self.signed <= self.error
        };
        if inside {
            Class::Inside
        } else if self.signed <= epsilon && epsilon > 0.0 {
            Class::Contact
        } else {
            Class::Outside
        }
    }

    /// What it says of the distance from the set, or from its complement.
    pub fn reach(&self, from_complement: bool) -> Reach {
        let Self { signed, error, .. } = *self;
        let certain = if from_complement {
            signed > error
        } else {
            signed < -error
        };
        let here = Reach {
            distance: 0.0,
            lower: 0.0,
            upper: if certain { 0.0 } else { 2.0 * error },
            is_exact: true,
        };
        let (away, is_bound) = if !from_complement {
            (signed, self.is_bound)
        } else if self.knows_depth {
            (-signed, false)
        } else if signed > 0.0 {
            return here;
        } else {
            (0.0, true)
        };
        if is_bound && (from_complement || away > error) {
            let lower = (away - error).max(0.0);
            return Reach {
                distance: lower,
                lower,
                upper: f64::INFINITY,
                is_exact: false,
            };
        }
        if away <= error {
            return here;
        }
        Reach {
            distance: away,
            lower: away - error,
            upper: away + error,
            is_exact: true,
        }
    }
}

/// A distance with safe bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    pub distance: f64,
    pub lower: f64,
    pub upper: f64,
    /// The distance is known; else `distance` is the lower bound.
    pub is_exact: bool,
}

/// How far within the world box the links' origins are: the least of all, negative where one is outside, and there minus the
/// most that one is. With the place that decides.
fn beyond_world(at: &Stand, links: &[usize]) -> (f64, Option<WorldPlace>) {
    let world = at.space.world();
    let mut least = f64::INFINITY;
    let mut place = None;
    for &link in links {
        let point = at.poses[link].translation;
        let mut outside = Vec3::zeros();
        let mut within = (f64::INFINITY, Vec3::zeros());
        // The plane has no height.
        for axis in 0..at.space.dimension() as usize {
            for (clear, sign) in [
                (point[axis] - world.low[axis], 1.0),
                (world.high[axis] - point[axis], -1.0),
            ] {
                if clear < within.0 {
                    within = (clear, Vec3::ith(axis, sign));
                }
                if clear < 0.0 {
                    outside[axis] = -sign * clear;
                }
            }
        }
        let (clear, normal) = match outside.try_normalize(0.0) {
            Some(normal) => (-outside.norm(), normal),
            None => within,
        };
        if clear < least {
            least = clear;
            place = Some(WorldPlace {
                link,
                primitive: None,
                point,
                normal,
            });
        }
    }
    (least, place)
}

/// How far over a floor the lowest point of some links is, and that point.
fn over_floor(
    at: &Stand,
    links: &[usize],
    normal: &Vec3,
    offset: f64,
) -> (f64, Option<WorldPlace>) {
    let mut least = f64::INFINITY;
    let mut place = None;
    for &link in links {
        let Some(body) = at.space.link(link).and_then(|link| link.body.as_deref()) else {
            continue;
        };
        let pose = &at.poses[link];
        let lowest = body.farthest(&-pose.rotation.tr_mul(normal));
        let point = pose.transform_point(&(lowest.point + body.center()));
        let over = normal.dot(&point) - offset;
        if over < least {
            least = over;
            place = Some(WorldPlace {
                link,
                primitive: Some(lowest.primitive),
                point,
                normal: *normal,
            });
        }
    }
    (least, place)
}

/// No coordinate that goes into the points of a link is larger.
fn reach_of(at: &Stand, link: usize) -> f64 {
    let body = at.space.link(link).and_then(|link| link.body.as_deref());
    let body = body.map_or(0.0, |body| body.reach() + body.deviation() / DISTANCE_ERROR);
    at.poses[link].translation.norm() + body
}

fn norm(v: &[f64]) -> f64 {
    let largest = v.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    largest * v.iter().map(|x| (x / largest).powi(2)).sum::<f64>().sqrt()
}
