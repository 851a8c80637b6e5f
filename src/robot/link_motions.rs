//! All links on a motion through C-space: each link's pose in its parent is a chain of turns and shifts about and along axes that
//! are fixed in the frame before them. So velocities and accelerations are known at any time, and bounds of the derivatives for the
//! whole motion.

use super::circular_arc::CircularArc;
use super::course::{Course, CourseState};
use super::motion_rates::ChainRates;
use super::motion_state::MotionColumns;
use super::{JointKind, Link, Robot};
use crate::lanes::Instructions;
use crate::nonzero::length;
use crate::pose::{Pose, Vec3};
use crate::tolerance::EPSILON;

/// One step of a chain.
#[derive(Clone, Copy, Debug)]
pub(super) enum Element {
    /// A pose that stays.
    Fixed(Pose),
    /// A turn about a unit axis, in radians.
    Turn { axis: Vec3, angle: Course },
    /// A shift along a unit axis.
    Shift { axis: Vec3, length: Course },
    /// A turn about a unit axis through another point than the origin, which so moves on an arc.
    CircularArc(CircularArc),
}

/// A link's parent, and its pose in it.
#[derive(Clone, Debug)]
struct LinkMotion {
    parent: Option<usize>,
    /// The elements' places in the list of all.
    elements: [usize; 2],
    /// Not so where a custom joint moves, of which no more than a speed is known.
    is_known: bool,
}

/// How the coordinates of a robot go from time 0 to 1.
#[derive(Clone, Copy, Debug)]
pub enum CoordinateCourses<'a> {
    /// From q with constant velocity v.
    Line {
        /// The configuration at time 0.
        q: &'a [f64],
        /// One entry per velocity.
        v: &'a [f64],
    },
    /// On a Bezier curve; coordinates of quaternions must rest, and of custom joints that move no more than a speed is known.
    Curve {
        /// The control points, one configuration after another, of the whole space.
        controls: &'a [f64],
        /// The number of coordinates of the space.
        nq: usize,
        /// The robot's first coordinate in the space.
        first: usize,
    },
    /// As a function gives it, from q on; coordinates of quaternions must rest, and of custom joints that move no more than a speed is
    /// known.
    Given {
        /// The configuration at time 0, of the whole space.
        q: &'a [f64],
        /// Bounds of the first derivative of each coordinate.
        max_rates: &'a [f64],
        /// Bounds of the second.
        max_accelerations: &'a [f64],
        /// The robot's first coordinate in the space.
        first: usize,
    },
    /// Straight from a configuration to any other in a box around it; coordinates of quaternions must rest.
    Box {
        /// The middle of the box.
        q: &'a [f64],
        /// The half widths, one entry per velocity: those of a free joint's position stand with its linear velocities.
        half: &'a [f64],
        /// The robot's first velocity in the space.
        first: usize,
    },
}

/// The links of robots on a motion; the time goes from 0 to 1.
#[derive(Clone, Debug, Default)]
pub struct LinkMotions {
    links: Vec<LinkMotion>,
    elements: Vec<Element>,
    /// The control points of all curves, and the bounds of what functions give.
    controls: Vec<f64>,
}

impl LinkMotions {
    /// The number of links.
    pub fn len(&self) -> usize {
        self.links.len()
    }

    /// Whether there are no links.
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// Adds a body that goes from a pose with a constant twist, linear and angular velocity in its own frame: a screw.
    pub fn push_screw(&mut self, start: &Pose, linear: &Vec3, angular: &Vec3) {
        let first = self.elements.len();
        self.elements.push(Element::Fixed(*start));
        self.screw(linear, angular);
        self.links.push(LinkMotion {
            parent: None,
            elements: [first, self.elements.len()],
            is_known: true,
        });
    }

    /// From the state of a link's parent to its own.
    #[inline(always)]
    pub(super) fn advance<I: Instructions>(
        &self,
        state: &mut MotionColumns<I>,
        link: usize,
        t: f64,
        given: &[CourseState],
    ) {
        let [first, end] = self.links[link].elements;
        for element in &self.elements[first..end] {
            match element {
                Element::Fixed(pose) => state.push_fixed(pose),
                Element::Turn { axis, angle } => {
                    state.turn(axis, &angle.at(t, &self.controls, given));
                }
                Element::Shift { axis, length } => {
                    state.shift(axis, &length.at(t, &self.controls, given));
                }
                Element::CircularArc(arc) => state.turn_on_arc(arc, t),
            }
        }
    }

    /// Whether the link's motion is known: no custom joint moves that carries it.
    pub fn is_known(&self, link: usize) -> bool {
        let mut carriers = std::iter::successors(Some(link), |&link| self.parent(link));
        carriers.all(|link| self.is_joint_known(link))
    }

    /// Whether the motion of a link's own joint is known.
    pub(super) fn is_joint_known(&self, link: usize) -> bool {
        self.links[link].is_known
    }

    /// The link that carries a link, if it is not the world.
    pub(super) fn parent(&self, link: usize) -> Option<usize> {
        self.links[link].parent
    }

    /// The lengths of the joints that carry a link and of whose motion no more than a speed is known, at these poses of links.
    pub fn lengths_of_unknown_joints<'p>(
        &self,
        link: usize,
        pose: impl Fn(usize) -> &'p Pose,
    ) -> f64 {
        let carriers = std::iter::successors(Some(link), |&link| self.parent(link));
        let unknown = carriers.filter(|&link| !self.is_joint_known(link));
        let length = |link: usize| {
            let from = self
                .parent(link)
                .map_or(Vec3::zeros(), |parent| pose(parent).translation);
            (pose(link).translation - from).norm()
        };
        unknown.map(length).sum()
    }

    /// What a link's joint is made of, from its parent's frame on. Of a custom joint that moves, only where it begins.
    pub(super) fn elements_of(&self, link: usize) -> &[Element] {
        let [first, end] = self.links[link].elements;
        &self.elements[first..end]
    }

    /// What courses are told by.
    pub(super) fn controls(&self) -> &[f64] {
        &self.controls
    }

    pub(super) fn push_element(&self, rates: &mut ChainRates, element: &Element) {
        match element {
            Element::Fixed(pose) => rates.push_fixed(pose),
            Element::Turn { axis, angle } => rates.push_turn(axis, &angle.bounds(&self.controls)),
            Element::Shift { axis, length } => {
                rates.push_shift(axis, &length.bounds(&self.controls));
            }
            Element::CircularArc(arc) => {
                rates.push_arc(&arc.axis, &arc.way_bounds(), &arc.angle_bounds())
            }
        }
    }

    fn turn(&mut self, axis: Vec3, angle: Course) {
        self.elements.push(Element::Turn { axis, angle });
    }

    fn shift(&mut self, axis: Vec3, length: Course) {
        self.elements.push(Element::Shift { axis, length });
    }

    /// Adds a shift from `start` on at a constant velocity.
    fn shift_at(&mut self, start: Vec3, velocity: Vec3) {
        self.elements
            .push(Element::Fixed(Pose::from_translation(start)));
        let rate = length(velocity.as_slice());
        if rate > 0.0 {
            self.shift(velocity / rate, Course::from_zero(rate));
        }
    }

    /// Adds what a twist makes of the last frame, in the frame that it moves.
    fn screw(&mut self, linear: &Vec3, angular: &Vec3) {
        let rate = angular.norm();
        // Turned by so little in all, no point is farther off a straight line than rounding puts it.
        if rate <= EPSILON {
            self.shift_at(Vec3::zeros(), *linear);
            return;
        }
        let axis = angular / rate;
        let along = axis.dot(linear);
        let across = linear - axis * along;
        if along != 0.0 {
            self.shift(axis, Course::from_zero(along));
        }
        if across == Vec3::zeros() {
            self.turn(axis, Course::from_zero(rate));
        } else {
            self.elements
                .push(Element::CircularArc(CircularArc { axis, rate, across }));
        }
    }

    /// The course of `multiplier * coordinate + offset`.
    fn course(&mut self, courses: &CoordinateCourses, at: Place) -> Course {
        let Place {
            coordinate,
            velocity,
            multiplier,
            offset,
        } = at;
        // What multiples of coordinates and the offset cancel is rounded nevertheless.
        let summed = |x: f64| multiplier.abs() * x + offset.abs();
        match courses {
            CoordinateCourses::Line { q, v } => Course::Line {
                start: multiplier * q[coordinate] + offset,
                rate: multiplier * v[velocity],
                summed: summed(q[coordinate].abs() + v[velocity].abs()),
            },
            CoordinateCourses::Curve {
                controls,
                nq,
                first,
            } => {
                let own = controls.iter().skip(first + coordinate).step_by(*nq);
                let farthest = own.clone().fold(0.0, |most: f64, x| most.max(x.abs()));
                self.controls.push(summed(farthest));
                let begin = self.controls.len();
                self.controls.extend(own.map(|x| multiplier * x + offset));
                Course::Curve {
                    first: begin as u32,
                    count: (self.controls.len() - begin) as u32,
                }
            }
            CoordinateCourses::Given {
                q,
                max_rates,
                max_accelerations,
                first,
            } => {
                let own = first + coordinate;
                let (rate, begin) = (multiplier.abs() * max_rates[own], self.controls.len());
                let start = multiplier * q[own] + offset;
                self.controls.extend([
                    start.abs() + rate,
                    summed(q[own].abs() + max_rates[own]),
                    rate,
                    multiplier.abs() * max_accelerations[own],
                ]);
                Course::Given {
                    coordinate: own as u32,
                    multiplier,
                    offset,
                    bounds: begin as u32,
                }
            }
            CoordinateCourses::Box { q, half, first } => Course::Range {
                center: multiplier * q[coordinate] + offset,
                rate: multiplier * half[velocity],
                velocity: (first + velocity) as u32,
                summed: summed(q[coordinate].abs() + half[velocity].abs()),
            },
        }
    }
}

/// Where a coordinate and its velocity stand, and what the joint makes of it.
struct Place {
    coordinate: usize,
    velocity: usize,
    multiplier: f64,
    offset: f64,
}

impl CoordinateCourses<'_> {
    /// Whether none of a joint's coordinates changes.
    fn rests(&self, link: &Link) -> bool {
        let joint = &link.joint;
        match self {
            Self::Line { v, .. } | Self::Box { half: v, .. } => {
                let own = &v[joint.velocity..joint.velocity + joint.kind.nv()];
                own.iter().all(|rate| *rate == 0.0)
            }
            Self::Curve {
                controls,
                nq,
                first,
            } => {
                let from = first + joint.coordinate;
                let own = from..from + joint.kind.nq();
                let mut points = controls.chunks_exact(*nq);
                points.all(|point| point[own.clone()] == controls[own.clone()])
            }
            Self::Given {
                max_rates, first, ..
            } => {
                let from = first + joint.coordinate;
                let own = &max_rates[from..from + joint.kind.nq()];
                own.iter().all(|rate| *rate == 0.0)
            }
        }
    }

    /// The coordinates at time 0, or in the middle, from the robot's first on.
    fn start(&self) -> &[f64] {
        match self {
            Self::Line { q, .. } | Self::Box { q, .. } => q,
            Self::Curve {
                controls: q, first, ..
            }
            | Self::Given { q, first, .. } => &q[*first..],
        }
    }
}

impl Link {
    /// Adds what the link's joint does. `false` where that is not known: custom joints that move, and quaternions on a
    /// curve.
    fn push_motion(&self, motions: &mut LinkMotions, courses: &CoordinateCourses) -> bool {
        let joint = &self.joint;
        motions.elements.push(Element::Fixed(self.at));
        let place = |k: usize| Place {
            coordinate: joint.coordinate + k,
            velocity: joint.velocity + k,
            multiplier: 1.0,
            offset: 0.0,
        };
        let of_axis = Place {
            multiplier: joint.multiplier,
            offset: joint.offset,
            ..place(0)
        };
        match (&joint.kind, courses) {
            (JointKind::Fixed, _) => {}
            (JointKind::Revolute, _) => {
                let angle = motions.course(courses, of_axis);
                motions.turn(joint.axis, angle);
            }
            (JointKind::Prismatic, _) => {
                let length = motions.course(courses, of_axis);
                motions.shift(joint.axis, length);
            }
            (JointKind::Planar, _) => {
                motions.shift_by(courses, [place(0), place(1)]);
                let angle = motions.course(courses, place(2));
                motions.turn(Vec3::z(), angle);
            }
            (JointKind::FreeEuler, _) => {
                motions.shift_by(courses, [place(0), place(1), place(2)]);
                for (axis, k) in [(Vec3::y(), 3), (Vec3::z(), 4), (Vec3::x(), 5)] {
                    let angle = motions.course(courses, place(k));
                    motions.turn(axis, angle);
                }
            }
            (JointKind::Free, CoordinateCourses::Box { q, .. }) => {
                let Ok(start) = joint.motion(q) else {
                    return false;
                };
                // Along the axes of the joint's frame: the coordinates are ranges, not the velocities in the moved frame.
                motions.shift_by(courses, [place(0), place(1), place(2)]);
                let turned = Pose {
                    translation: Vec3::zeros(),
                    ..start
                };
                motions.elements.push(Element::Fixed(turned));
            }
            (kind, _) => {
                let Ok(start) = joint.motion(courses.start()) else {
                    return false;
                };
                motions.elements.push(Element::Fixed(start));
                if courses.rests(self) {
                    return true;
                }
                let CoordinateCourses::Line { v, .. } = courses else {
                    return false;
                };
                let vector = |k: usize| Vec3::from_column_slice(&v[joint.velocity + k..][..3]);
                match kind {
                    JointKind::Free => motions.screw(&vector(0), &vector(3)),
                    JointKind::Spherical => motions.screw(&Vec3::zeros(), &vector(0)),
                    _ => return false,
                }
            }
        }
        true
    }
}

impl LinkMotions {
    /// Adds a shift by the first coordinates of a joint, along x, y and z.
    fn shift_by<const N: usize>(&mut self, courses: &CoordinateCourses, places: [Place; N]) {
        if let CoordinateCourses::Line { q, v } = courses {
            let (mut start, mut velocity) = (Vec3::zeros(), Vec3::zeros());
            for (k, place) in places.iter().enumerate() {
                (start[k], velocity[k]) = (q[place.coordinate], v[place.velocity]);
            }
            self.shift_at(start, velocity);
            return;
        }
        for (place, axis) in places.into_iter().zip([Vec3::x(), Vec3::y(), Vec3::z()]) {
            let length = self.course(courses, place);
            self.shift(axis, length);
        }
    }
}

impl Robot {
    /// Adds the robot's links, whose numbers go on from those that are there.
    pub fn append_motions(&self, motions: &mut LinkMotions, courses: &CoordinateCourses) {
        let offset = motions.links.len();
        motions.links.reserve(self.links().len());
        // Most joints are a fixed pose and a turn or a shift.
        motions.elements.reserve(2 * self.links().len());
        for link in self.links() {
            let first = motions.elements.len();
            let is_known = link.push_motion(motions, courses);
            motions.links.push(LinkMotion {
                parent: link.parent.map(|parent| parent + offset),
                elements: [first, motions.elements.len()],
                is_known,
            });
        }
    }
}
