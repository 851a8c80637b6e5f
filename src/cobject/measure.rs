//! Signed distances from pure sets: closed forms on lines, circles and rotations.
//!
//! The metric is that of the product space: the root of the sum of squared differences, with angles the shorter way round,
//! and translation and rotation of free joints taken separately. Outside a set the measure is the distance; inside it is
//! minus the depth, the distance from the complement.

use std::f64::consts::TAU;

use super::spans::{Span, largest, measure_of, slopes_of, span};
use super::world_place::{beyond_world, largest_coordinate_of, over_floor, stated_deviation_of};
use super::{Class, Measure, Measured, PureSet, PureShape, SpaceState, WorldPlace};
use crate::error::{Error, ErrorKind, Result};
use crate::nonzero::length;
use crate::robot::{Coordinate, RobotState};
use crate::space::Space;
use crate::tolerance::{DISTANCE_ERROR, EPSILON, LARGEST_COORDINATE};

impl PureSet {
    /// The class of a configuration. If that it is inside is to be proved, as for the complement, a floor is not met by what the
    /// links' bodies stand for where it need not be.
    pub fn classify(&self, at: &SpaceState, is_proved: bool) -> Result<Class> {
        if let PureShape::Predicate(predicate) = &self.shape {
            let class = predicate.classify(self.coordinates(at)?);
            return class.map_err(|e| self.named(e));
        }
        let found = self.measured(at)?;
        Ok(found.map_or(Class::Outside, |found| found.class(is_proved)))
    }

    /// The largest measure that classifies as contact, in the unit of measures. Infinite for predicates, which decide about
    /// contact themselves.
    pub fn epsilon(&self) -> f64 {
        match self.shape {
            PureShape::Predicate(_) => f64::INFINITY,
            _ => self.options.contact_epsilon * self.scale(),
        }
    }

    /// The factor from the set's own unit to that of its measures. 1 for the world box and floors, which measure in lengths
    /// already.
    pub fn scale(&self) -> f64 {
        match self.shape {
            _ if self.shape.is_in_world() => 1.0,
            _ => self.options.scale.unwrap_or(1.0),
        }
    }

    fn named(&self, error: Error) -> Error {
        error.within(format_args!("C-object {}", self.leaf.serial))
    }

    /// The signed distance; `None` for a predicate that does not measure.
    pub fn measure(&self, at: &SpaceState) -> Result<Option<Measure>> {
        Ok(self.measured(at)?.map(|found| found.measure()))
    }

    /// Signed distance, class and place; `None` for a predicate that does not measure.
    pub fn measured(&self, at: &SpaceState) -> Result<Option<Measured<'_>>> {
        let (mut told, mut decides) = (None, None);
        let unscaled = match &self.shape {
            PureShape::Predicate(predicate) => {
                let q = self.coordinates(at)?;
                let distance = predicate.distance(q).map_err(|e| self.named(e))?;
                let Some(signed) = distance else {
                    return Ok(None);
                };
                let class = predicate.classify(q).map_err(|e| self.named(e))?;
                self.check_predicate(signed, class)?;
                told = Some(class);
                Measure {
                    signed,
                    error: 0.0,
                    excess: 0.0,
                    is_bound: !predicate.is_exact(),
                    knows_depth: predicate.knows_depth(),
                }
            }
            PureShape::Floor {
                links,
                normal,
                offset,
            } => {
                let (signed, place) = over_floor(at, links, normal, *offset);
                decides = place;
                let largest = links.iter().map(|&link| largest_coordinate_of(at, link));
                Measure {
                    signed,
                    error: DISTANCE_ERROR * largest.fold(offset.abs(), f64::max),
                    excess: place.map_or(0.0, |place| 2.0 * stated_deviation_of(at, place.link)),
                    is_bound: false,
                    knows_depth: false,
                }
            }
            PureShape::BeyondWorld { links } => {
                let (signed, place) = beyond_world(at, links);
                decides = place;
                let size = links.iter().map(|&link| at.poses[link].translation.amax());
                Measure {
                    signed,
                    error: DISTANCE_ERROR * size.fold(0.0, f64::max),
                    excess: 0.0,
                    is_bound: false,
                    // The depth of a link is not the depth of the configuration.
                    knows_depth: false,
                }
            }
            _ => {
                let (signed, error) = self.by_coordinate(at.space, self.coordinates(at)?);
                Measure {
                    signed,
                    error,
                    excess: 0.0,
                    is_bound: false,
                    knows_depth: true,
                }
            }
        };
        Ok(Some(Measured {
            set: self,
            unscaled,
            told,
            place: decides,
        }))
    }

    /// The link and the point that decide the measure; `None` for sets that are not in the world.
    fn place(&self, at: &SpaceState) -> Option<WorldPlace> {
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

    /// The coordinate that decides the measure of limits or a box: the one farthest outside its interval, or, inside all,
    /// the nearest to an end. `None` for other sets.
    pub fn coordinate(&self, at: &SpaceState) -> Option<usize> {
        let mut spans = self.spans(at.space, at.q?);
        let largest_beyond = largest(spans.clone());
        let (i, _) = spans.find(|(_, span)| span.beyond == largest_beyond)?;
        Some(i)
    }

    /// The derivative of the measure, one entry per velocity.
    pub fn gradient(&self, at: &SpaceState) -> Result<Vec<f64>> {
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
                    let state = RobotState { q, poses: at.poses };
                    space.add_gradient(state, place.link, &place.point, &place.normal, &mut row)?;
                }
                return Ok(row);
            }
            PureShape::Ball { center, .. } => {
                let offset = space.offset(center, q);
                let length = length(&offset);
                let mut row = space.offset_as_velocity(q, &offset);
                // At the centre all directions out are equal: the gradient is 0.
                let factor = if length > 0.0 { 1.0 / length } else { 0.0 };
                row.iter_mut().for_each(|x| *x *= factor);
                row
            }
            _ => space.by_velocity(q, &self.slopes(space, q)),
        };
        let scale = self.scale();
        row.iter_mut().for_each(|x| *x *= scale);
        Ok(row)
    }

    /// The measure before scaling, and its error.
    pub(super) fn by_coordinate(&self, space: &Space, q: &[f64]) -> (f64, f64) {
        match &self.shape {
            PureShape::BeyondLimits => {
                let (measure, error) = measure_of(self.spans(space, q));
                (-measure, error)
            }
            PureShape::Box { .. } => measure_of(self.spans(space, q)),
            PureShape::HalfSpace { normal, offset, .. } => {
                let length = length(normal);
                let terms = || normal.iter().zip(q).map(|(n, x)| n / length * x);
                let signed = terms().sum::<f64>() - offset / length;
                let size = terms().map(f64::abs).sum::<f64>() + (offset / length).abs();
                let error = (q.len() + 4) as f64 * EPSILON * size;
                (signed, error)
            }
            PureShape::Ball { center, radius } => {
                let offset = space.offset(center, q);
                let sizes = center.iter().chain(q).map(|x| x.abs());
                let size = sizes.fold(TAU.max(*radius), f64::max);
                let error = 8.0 * (q.len() as f64).sqrt() * EPSILON * size;
                (length(&offset) - radius, error)
            }
            PureShape::BeyondWorld { .. } | PureShape::Floor { .. } | PureShape::Predicate(_) => {
                (f64::INFINITY, 0.0)
            }
        }
    }

    /// The derivative of limits, boxes and half-spaces before scaling, with respect to the coordinates.
    fn slopes(&self, space: &Space, q: &[f64]) -> Vec<f64> {
        match &self.shape {
            PureShape::BeyondLimits => {
                let slopes = slopes_of(self.spans(space, q), q.len());
                slopes.iter().map(|x| -x).collect()
            }
            PureShape::Box { .. } => slopes_of(self.spans(space, q), q.len()),
            PureShape::HalfSpace { normal, .. } => {
                let length = length(normal);
                normal.iter().map(|x| x / length).collect()
            }
            _ => Vec::new(),
        }
    }

    /// How far each coordinate is beyond its interval, at least; negative within it, or where it has none. Of limits and boxes; `None`
    /// where the coordinates are not known.
    pub fn beyond(&self, at: &SpaceState) -> Option<Vec<f64>> {
        let mut beyond = vec![f64::NEG_INFINITY; at.space.nq()];
        for (i, span) in self.spans(at.space, at.q?) {
            beyond[i] = span.beyond - span.error;
        }
        Some(beyond)
    }

    /// The signed distance of each coordinate from its interval, for limits and boxes; empty for other sets.
    pub(super) fn spans<'a>(
        &'a self,
        space: &'a Space,
        q: &'a [f64],
    ) -> impl Iterator<Item = (usize, Span)> + Clone + 'a {
        let coordinates = space.coordinates().iter().zip(q).enumerate();
        coordinates.filter_map(|(i, (&coordinate, &x))| {
            let span = match &self.shape {
                PureShape::BeyondLimits => match coordinate {
                    Coordinate::Interval { lower, upper } => span(coordinate, x, lower, upper),
                    _ => None,
                },
                PureShape::Box { low, high } => span(coordinate, x, low[i], high[i]),
                _ => None,
            };
            Some((i, span?))
        })
    }

    fn coordinates<'a>(&self, at: &SpaceState<'a>) -> Result<&'a [f64]> {
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
