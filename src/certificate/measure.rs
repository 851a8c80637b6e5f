//! What one entry of a certificate claims, computed: the gap at both ends of its interval, and how far the motion leaves the line
//! between them.
//!
//! Let n be a unit direction that rests in the frame of one body, and x(t) the place of a point of the other as that frame sees it.
//! Then n . x(t) is at least the lesser of its values at the two ends, less `PointBounds::displacement`. The least over the points of
//! a group of primitives at each end is that of a support point, and so is the most of the group that rests. What remains is a lower
//! bound of their distance at every time of the interval.

use std::collections::HashMap;
use std::sync::Arc;

use super::carried_points::Course;
use super::statement::{Carried, Item, What};
use crate::body::Body;
use crate::boxes::Extent;
use crate::cobject::{PureSet, PureShape, SpaceState};
use crate::error::Result;
use crate::nonzero::{length, product};
use crate::pose::{Pose, Vec3};
use crate::robot::Coordinate;
use crate::tolerance::{EPSILON, LARGEST_COORDINATE, SUM_SLACK};

/// Link poses are kept for so many times.
const MAX_KEPT: usize = 4096;

/// The groups of primitives and the interval that a part of a proof is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    /// As [`super::Entry::groups`].
    pub groups: [[u32; 2]; 2],
    pub times: [f64; 2],
}

/// A direction from the second body to the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along {
    /// The body in whose frame it rests.
    pub carrier: usize,
    pub direction: Vec3,
}

/// What a part of a proof can claim.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measured {
    /// A lower bound, with rounding counted.
    pub gap: f64,
    pub displacement: f64,
    /// What was taken off the gap for rounding.
    pub rounding: f64,
}

/// A motion with the poses of its links.
pub(super) struct Measure<'a> {
    pub course: Course<'a>,
    pub q1: &'a [f64],
    /// Of the primitives of each of the bodies.
    pub orders: &'a [Vec<u32>],
    poses: HashMap<u64, Arc<Vec<Pose>>>,
}

impl<'a> Measure<'a> {
    pub fn new(course: Course<'a>, q1: &'a [f64], orders: &'a [Vec<u32>]) -> Self {
        Self {
            course,
            q1,
            orders,
            poses: HashMap::new(),
        }
    }

    /// The configuration at a time.
    pub fn configuration(&self, time: f64) -> Vec<f64> {
        self.course.space.interpolate(self.course.q0, self.q1, time)
    }

    /// The poses of all links at a time.
    pub fn link_poses(&mut self, time: f64) -> Result<Arc<Vec<Pose>>> {
        if let Some(known) = self.poses.get(&time.to_bits()) {
            return Ok(known.clone());
        }
        let found = self.course.space.link_poses(&self.configuration(time))?;
        let found = Arc::new(found);
        if self.poses.len() == MAX_KEPT {
            self.poses.clear();
        }
        self.poses.insert(time.to_bits(), found.clone());
        Ok(found)
    }

    /// The pose of a body in the world.
    pub fn place(&mut self, carried: &Carried, time: f64) -> Result<Pose> {
        Ok(match carried.link {
            None => carried.pose,
            Some(link) => self.link_poses(time)?[link].compose(&carried.pose),
        })
    }

    /// What can be claimed of a part of an item.
    pub fn of(&mut self, item: &Item, part: &Part, along: &Along) -> Result<Measured> {
        match &item.what {
            What::Bodies(sides) => self.of_bodies(sides, part, along),
            What::Plane {
                points,
                normal,
                offset,
                is_open,
            } => {
                let counts_boundary = !*is_open || item.limit > 0.0;
                self.over_plane(points, part, (normal, *offset), counts_boundary)
            }
            What::Coordinates(pure) => {
                let counts_boundary = !pure.shape.is_open() || item.limit > 0.0;
                self.of_coordinates(pure, part, counts_boundary)
            }
        }
    }

    fn of_bodies(&mut self, sides: &[Carried; 2], part: &Part, along: &Along) -> Result<Measured> {
        let resting = along.carrier;
        let moving = 1 - resting;
        // From what rests to what moves.
        let direction = match resting {
            1 => along.direction,
            _ => -along.direction,
        };
        let groups = [0, 1].map(|k| self.group(&sides[k], part.groups[k]));
        let mut gap = f64::INFINITY;
        for time in part.times {
            let to_moving = self.place(&sides[resting], time)?.inverse();
            let relative = to_moving.compose(&self.place(&sides[moving], time)?);
            let back = relative.rotation.tr_mul(&-direction);
            gap = gap.min(direction.dot(&relative.translation) - groups[moving].farthest(&back));
        }
        gap -= groups[resting].farthest(&direction);
        let radii = [0, 1].map(|k| groups[k].radius(&sides[k].pose, &Vec3::zeros()));
        let radius = |from: &Vec3| groups[moving].radius(&sides[moving].pose, from);
        let bounds = self
            .course
            .seen_from(sides[resting].link, sides[moving].link, radius);
        let rounding = self.course.rounding([0, 1].map(|k| Some(&sides[k])), radii);
        Ok(Measured {
            gap: gap - rounding,
            displacement: bounds.displacement(part.times[1] - part.times[0]),
            rounding,
        })
    }

    /// The height of points over a plane of the world, which may count as inside or not.
    fn over_plane(
        &mut self,
        points: &Carried,
        part: &Part,
        (normal, offset): (&Vec3, f64),
        counts_boundary: bool,
    ) -> Result<Measured> {
        let group = self.group(points, part.groups[0]);
        let mut gap = f64::INFINITY;
        for time in part.times {
            let place = self.place(points, time)?;
            let back = place.rotation.tr_mul(&-normal);
            gap = gap.min(normal.dot(&place.translation) - group.farthest(&back));
        }
        gap -= offset;
        let radius = |from: &Vec3| group.radius(&points.pose, from);
        let bounds = self.course.seen_from(None, points.link, radius);
        // What rests on the boundary of an open set is outside of it, as queries compute it.
        let rounding = match counts_boundary || bounds.speed != 0.0 {
            false => 0.0,
            true => {
                let radii = [radius(&Vec3::zeros()), offset.abs()];
                self.course.rounding([Some(points), None], radii)
            }
        };
        Ok(Measured {
            gap: gap - rounding,
            displacement: bounds.displacement(part.times[1] - part.times[0]),
            rounding,
        })
    }

    /// The distance from a set given in C-space. It changes no faster than the configuration moves; and where it is the least of
    /// linear functions, it is least at one of the ends.
    fn of_coordinates(
        &mut self,
        pure: &PureSet,
        part: &Part,
        counts_boundary: bool,
    ) -> Result<Measured> {
        let is_least_at_ends = self.is_least_at_ends(pure);
        let mut gap = LARGEST_COORDINATE;
        let mut rounding = 0.0f64;
        for time in part.times {
            let q = self.configuration(time);
            let at = SpaceState {
                space: self.course.space,
                q: Some(&q),
                poses: &self.link_poses(time)?,
            };
            let Some(measure) = pure.measure(&at)? else {
                return Ok(Measured {
                    gap: f64::NEG_INFINITY,
                    displacement: f64::INFINITY,
                    rounding: 0.0,
                });
            };
            gap = gap.min(measure.signed);
            let size: f64 = q.iter().map(|x| x.abs()).sum();
            rounding = rounding.max(measure.error + 16.0 * EPSILON * size * pure.scale());
        }
        if is_least_at_ends && !counts_boundary {
            rounding = 0.0;
        }
        let speed = length(&self.course.v);
        let time = part.times[1] - part.times[0];
        Ok(Measured {
            gap: gap - rounding,
            displacement: match is_least_at_ends {
                true => 0.0,
                false => product(0.5 * pure.scale(), product(speed, time)) * SUM_SLACK,
            },
            rounding,
        })
    }

    /// Whether the distance is the least of functions that are linear along the motion: limits and half-spaces of coordinates that
    /// go straight.
    fn is_least_at_ends(&self, pure: &PureSet) -> bool {
        let space = self.course.space;
        let counts = |c: usize| match &pure.shape {
            PureShape::BeyondLimits => match space.coordinates()[c] {
                Coordinate::Interval { lower, upper } => lower.is_finite() || upper.is_finite(),
                _ => false,
            },
            PureShape::HalfSpace { normal, .. } => normal[c] != 0.0,
            _ => true,
        };
        let straight: Vec<usize> = space.straight(self.course.q0, &self.course.v).collect();
        let is_known = matches!(
            pure.shape,
            PureShape::BeyondLimits | PureShape::HalfSpace { .. }
        );
        is_known
            && space.blocks().iter().all(|block| {
                let mut own = block.coordinate..block.coordinate + block.kind.nq();
                own.all(|c| !counts(c) || straight.contains(&c))
            })
    }

    /// The primitives of a group.
    pub fn group<'b>(&self, carried: &Carried<'b>, [first, count]: [u32; 2]) -> Group<'b>
    where
        'a: 'b,
    {
        let range = first as usize..first as usize + count as usize;
        Group {
            body: carried.body,
            primitives: match carried.body {
                Some(_) => &self.orders[carried.place][range],
                None => &[],
            },
        }
    }
}

/// Some primitives of a body; without one the origin of the frame.
#[derive(Clone, Copy)]
pub(super) struct Group<'a> {
    pub body: Option<&'a Body>,
    pub primitives: &'a [u32],
}

impl Group<'_> {
    /// The largest coordinate along a direction of the body's frame.
    pub fn farthest(&self, direction: &Vec3) -> f64 {
        let Some(body) = self.body else {
            return 0.0;
        };
        let along = |primitive: &u32| {
            let primitive = body.primitives().get(*primitive as usize);
            direction.dot(&primitive.farthest(direction))
        };
        let farthest = self.primitives.iter().map(along);
        farthest.fold(f64::NEG_INFINITY, f64::max) + direction.dot(body.center())
    }

    /// The middle of the box around the group's points.
    pub fn center(&self) -> Vec3 {
        let Some(body) = self.body else {
            return Vec3::zeros();
        };
        let points = self.primitives.iter().flat_map(|primitive| {
            let (low, high) = body.primitives().get(*primitive as usize).extent();
            [low, high]
        });
        Extent::of_points(points).center() + body.center()
    }

    /// Bounds the distances of the group's points from a point, at a pose.
    pub fn radius(&self, pose: &Pose, from: &Vec3) -> f64 {
        let Some(body) = self.body else {
            return (pose.translation - from).norm();
        };
        let mut radius = 0.0f64;
        for primitive in self.primitives {
            for point in body.primitives().get(*primitive as usize).bounding_points() {
                let place = pose.transform_point(&(point + body.center()));
                radius = radius.max((place - from).norm());
            }
        }
        radius * (1.0 + 1e-12) + body.deviation()
    }
}
