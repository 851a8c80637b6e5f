//! What each coordinate of a box of configurations does to each link, to first order: the columns of the Jacobian at the middle of
//! the box, times the half widths.

use smallvec::SmallVec;

use super::course::Course;
use super::link_motions::{Element, LinkMotions};
use super::to_carrier::ToCarrier;
use crate::pose::{Displacement, Pose, Vec3, turned};

/// What one coordinate does to a link, from the middle of a box to its side: the world's points x that move with the link move by
/// `linear + angular x (x - point)`.
#[derive(Clone, Copy, Debug)]
struct OwnTwist {
    velocity: u32,
    linear: Vec3,
    angular: Vec3,
    point: Vec3,
}

/// What one coordinate does to a body as another body sees it, from the middle of a box to its side.
#[derive(Clone, Copy, Debug)]
pub struct RelativeTwist {
    /// The number of the coordinate's velocity.
    pub velocity: u32,
    /// Of the body's centre, along the world's axes.
    pub by: Displacement,
}

/// One entry for each coordinate that moves the one as the other sees it.
pub type RelativeTwists = SmallVec<[RelativeTwist; 8]>;

/// The links at the middle of a box of configurations.
pub struct LinkTwists<'a> {
    motions: &'a LinkMotions,
    poses: &'a [Pose],
    own: Vec<OwnTwist>,
    /// Where each link's twists end in the list.
    ends: Vec<u32>,
}

impl<'a> LinkTwists<'a> {
    /// Of links whose motions are ranges, with the poses of all links at the middle.
    pub fn new(motions: &'a LinkMotions, poses: &'a [Pose]) -> Self {
        let mut twists = Self {
            motions,
            poses,
            own: Vec::with_capacity(2 * poses.len()),
            ends: Vec::with_capacity(poses.len()),
        };
        for link in 0..motions.len() {
            twists.add(link);
            twists.ends.push(twists.own.len() as u32);
        }
        twists
    }

    fn add(&mut self, link: usize) {
        let motions = self.motions;
        let parent = motions.parent(link);
        // Where a custom joint moves, no twist is known.
        let is_known = motions.is_joint_known(link);
        let elements = if is_known {
            motions.elements_of(link)
        } else {
            &[]
        };
        let mut pose = parent.map_or_else(Pose::identity, |parent| self.poses[parent]);
        for element in elements {
            match element {
                Element::Fixed(fixed) => pose = pose.compose(fixed),
                // No coordinate of a box turns so.
                Element::CircularArc(_) => {}
                Element::Turn { axis, angle } => {
                    let direction = turned(&pose.rotation, axis);
                    let Course::Range {
                        center,
                        rate,
                        velocity,
                        ..
                    } = *angle
                    else {
                        continue;
                    };
                    if rate != 0.0 {
                        self.own.push(OwnTwist {
                            velocity,
                            linear: Vec3::zeros(),
                            angular: direction * rate,
                            point: pose.translation,
                        });
                    }
                    pose = pose.turned_about(axis, center);
                }
                Element::Shift { axis, length } => {
                    let direction = turned(&pose.rotation, axis);
                    let Course::Range {
                        center,
                        rate,
                        velocity,
                        ..
                    } = *length
                    else {
                        continue;
                    };
                    if rate != 0.0 {
                        self.own.push(OwnTwist {
                            velocity,
                            linear: direction * rate,
                            angular: Vec3::zeros(),
                            point: pose.translation,
                        });
                    }
                    pose.translation += direction * center;
                }
            }
        }
    }

    /// A link's pose at the middle.
    pub fn pose(&self, link: usize) -> &Pose {
        &self.poses[link]
    }

    /// Bounds how far points within `radius` of a link's origin move along a unit direction of the world, to any configuration of the
    /// box: nothing for a base that drives on a floor, along the floor's normal. Only of links whose motions are known.
    ///
    /// Let the joints move one after the other, from the root on. What is behind a joint is then still as in the middle, and what
    /// is before it has turned the direction, as the joint's frame sees it, by no more than the sum of what each turn turns it.
    pub fn farthest_along(&self, link: usize, radius: f64, direction: &Vec3) -> f64 {
        let origin = self.poses[link].translation;
        let mut path: SmallVec<[usize; 16]> = SmallVec::new();
        let mut next = Some(link);
        while let Some(index) = next {
            path.push(index);
            next = self.motions.parent(index);
        }
        let mut farthest = 0.0;
        let mut drift = 0.0;
        for own in path.into_iter().rev().flat_map(|link| self.own_of(link)) {
            let shift = own.linear.norm();
            farthest += (own.linear.dot(direction).abs() + drift * shift).min(shift);
            let turn = own.angular.norm();
            let turned = (own.angular.cross(direction).norm() + drift * turn).min(turn);
            farthest += turned * ((origin - own.point).norm() + radius);
            drift += turned;
        }
        farthest
    }

    fn own_of(&self, link: usize) -> &[OwnTwist] {
        let first = link.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.own[first as usize..self.ends[link] as usize]
    }

    /// What the coordinates do to a body of a link, centred at a point of the world, as another link sees it, or the world. Joints
    /// that carry both do nothing; a coordinate that moves several joints is one entry.
    pub fn between(&self, link: usize, from: Option<usize>, center: &Vec3) -> RelativeTwists {
        let mut found = RelativeTwists::new();
        let carriers = ToCarrier::new([Some(link), from], |link| self.motions.parent(link));
        for (end, carrier) in carriers {
            let sign = if end == 0 { 1.0 } else { -1.0 };
            for own in self.own_of(carrier) {
                let linear = sign * (own.linear + own.angular.cross(&(center - own.point)));
                let angular = sign * own.angular;
                match found.iter_mut().find(|f| f.velocity == own.velocity) {
                    Some(same) => {
                        same.by.linear += linear;
                        same.by.angular += angular;
                    }
                    None => found.push(RelativeTwist {
                        velocity: own.velocity,
                        by: Displacement { linear, angular },
                    }),
                }
            }
        }
        found
    }
}
