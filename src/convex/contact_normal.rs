//! The normal of a contact. Where features define it, it is exact at any distance; at touch it is the direction of least
//! overlap.

use super::closest::Closest;
use super::contact::mode_of;
use super::feature_pair::{FeatureTouch, across, feature_normal};
use super::local_features::{Directions, local_normals};
use super::placed::{PlacedPrimitive, Precision, gap_of_primitives};
use super::ways_out::shortest_way;
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind};
use crate::tolerance;
use crate::work_meter::WorkMeter;

/// The normal of the features is along the closest points to within a cosine of this. Nearly parallel edges that are very short for where
/// they lie may have another: then their closest points are at their ends.
const MIN_AGREEMENT: f64 = 1.0 - 1e-6;

/// A primitive pair with its closest points, in a common frame.
#[derive(Clone, Copy)]
pub struct ContactPair<'a> {
    pub r: &'a PlacedPrimitive<'a>,
    pub s: &'a PlacedPrimitive<'a>,
    pub closest: &'a Closest,
    pub precision: &'a Precision,
}

impl ContactPair<'_> {
    /// The unit normal from s to r, if the primitives are far enough apart for their closest points to determine it.
    #[inline(always)]
    pub fn normal_if_apart(&self) -> Option<Vec3> {
        self.is_apart().then(|| self.normal_apart()).flatten()
    }

    fn is_apart(&self) -> bool {
        self.closest.distance > tolerance::MIN_NORMAL_DISTANCE * self.precision.size
    }

    /// What touches at the closest features, if their own normal is the one of the contact.
    pub fn feature_touch(&self) -> Option<FeatureTouch> {
        let Self {
            r, s, precision, ..
        } = *self;
        let features = self.closest.features;
        if self.is_apart() || precision.planar {
            return None;
        }
        let touch = FeatureTouch::at(r, s, features, precision)?;
        touch
            .is_least(r, s, features, precision.size)
            .then_some(touch)
    }

    /// The unit normal from s to r, or `None` where the interiors overlap deeper than [`tolerance::JUST_INSIDE`] L.
    pub fn normal(&self) -> Option<Vec3> {
        if self.is_apart() {
            let normal = self.normal_apart()?;
            return Some(match mode_of(self.closest.features) {
                Some(_) => normal,
                None => self.normal_of_parallel(normal),
            });
        }
        if self.closest.depth > tolerance::JUST_INSIDE * self.precision.size {
            return None;
        }
        let is_within = |f: &Feature| f.kind == FeatureKind::Interior;
        let touching = if self.closest.features.iter().any(is_within) {
            None
        } else {
            self.normal_at_touch()
        };
        touching.or_else(|| self.normal_just_inside())
    }

    /// The normal of primitives that are apart. It is that of the features where they define one. Else it is the direction
    /// between the points, without its components along the edges that hold the points: these components are rounding. If a
    /// normal of the features around the points agrees with that direction within rounding, it is taken instead: it is exact.
    #[inline(always)]
    fn normal_apart(&self) -> Option<Vec3> {
        let between = self.closest.points[0] - self.closest.points[1];
        if !self.precision.planar
            && let Some(normal) = feature_normal(self.r, self.s, self.closest.features)
            && normal.dot(&between).abs() >= MIN_AGREEMENT * self.closest.distance
        {
            return Some(oriented(normal, &between));
        }
        let [on_r, on_s] = self.closest.features;
        let direct = across(self.s, on_s, across(self.r, on_r, between));
        let direct = direct.try_normalize(0.0)?;
        let doubt = 64.0 * tolerance::EPSILON * self.precision.size / self.closest.distance;
        if doubt < tolerance::NORMAL_ERROR {
            return Some(direct);
        }
        // A copy for the rare case: what is passed on by address is not kept in registers.
        let closest = *self.closest;
        let pair = ContactPair {
            closest: &closest,
            ..*self
        };
        Some(pair.normal_near(direct, doubt))
    }

    /// The normal of parallel features, in whose middle closest points need not be each other's feet: what they are aside shows in their
    /// distance only by its square. A candidate normal along which the sets are farther apart is better than the direction between them.
    fn normal_of_parallel(&self, between: Vec3) -> Vec3 {
        let mut best = (gap_of_primitives(self.r, self.s, &between), between);
        let least = tolerance::SUPPORT_ERROR * self.precision.size;
        for candidate in self.candidates() {
            let candidate = oriented(candidate, &between);
            let gap = gap_of_primitives(self.r, self.s, &candidate);
            if gap > best.0 + least {
                best = (gap, candidate);
            }
        }
        best.1
    }

    /// The normals of the features around the closest points.
    fn candidates(&self) -> Directions {
        local_normals([self.r, self.s], &self.closest.points, self.precision)
    }

    /// The candidate normal nearest to a unit direction, or the direction itself where none is within `doubt` of it.
    #[inline(never)]
    fn normal_near(&self, direct: Vec3, doubt: f64) -> Vec3 {
        let mut best = (doubt, direct);
        for candidate in self.candidates() {
            let candidate = oriented(candidate, &direct);
            let off = (candidate - direct).norm();
            if off <= best.0 {
                best = (off, candidate);
            }
        }
        best.1
    }

    /// The normal of touching primitives: among the candidate normals of the touching features, the one along which the sets
    /// overlap least.
    fn normal_at_touch(&self) -> Option<Vec3> {
        let tie = tolerance::GAP_TIE * self.precision.size;
        let rounding = tolerance::SUPPORT_ERROR * self.precision.size;
        // No direction has a larger gap, so that no candidate after one with this replaces it.
        let most = self.closest.distance + self.precision.error + rounding;
        let mut best: Option<(f64, Vec3)> = None;
        for candidate in self.candidates() {
            if best.is_some_and(|(gap, _)| gap + tie >= most) {
                break;
            }
            let [ahead, back] =
                [candidate, -candidate].map(|n| (gap_of_primitives(self.r, self.s, &n), n));
            // Flat sets have gaps of opposite signs: which side r is on shows in less than a tie.
            let side = if back.0 > ahead.0 + rounding {
                back
            } else {
                ahead
            };
            if best.is_none_or(|(most, _)| side.0 > most + tie) {
                best = Some(side);
            }
        }
        best.filter(|(gap, _)| *gap >= -tolerance::TOUCH_DEPTH * self.precision.size)
            .map(|(_, normal)| normal)
    }

    /// The normal of primitives that overlap slightly: the direction of the shortest way out, if that is short. Surfaces have
    /// no inside.
    fn normal_just_inside(&self) -> Option<Vec3> {
        let planar = self.precision.planar;
        let sides = [self.r, self.s];
        if !planar && !sides.iter().any(|side| side.shape.is_solid()) {
            return None;
        }
        // Early out for most deep pairs: the penetration depth is at least the depth of the common point in either set.
        let common = &self.closest.points[0];
        let most = tolerance::JUST_INSIDE * self.precision.size;
        if sides
            .iter()
            .any(|side| depth_below(side, common, planar) > most)
        {
            return None;
        }
        let meter = &mut WorkMeter::default();
        let found = shortest_way(self.r, self.s, self.precision, meter);
        (found.depth <= most).then_some(found.direction)
    }
}

/// A normal of either sign, on the side of a direction.
#[inline(always)]
fn oriented(normal: Vec3, direction: &Vec3) -> Vec3 {
    if normal.dot(direction) < 0.0 {
        -normal
    } else {
        normal
    }
}

/// The depth of a point below the boundary of a set; at most 0 where it is not inside, or the set has no inside.
fn depth_below(placed: &PlacedPrimitive, point: &Vec3, planar: bool) -> f64 {
    let faces = 0..placed.shape.faces.len();
    if faces.is_empty() {
        return 0.0;
    }
    if planar {
        // The outline runs counter-clockwise around the one face's normal.
        return faces
            .map(|f| placed.depth_in_face(f, point))
            .fold(f64::INFINITY, f64::min);
    }
    if !placed.shape.is_solid() {
        return 0.0;
    }
    let depth = |f: usize| {
        let corner = placed.vertex(placed.shape.faces[f].vertices[0]);
        placed.normal(f).dot(&(corner - point))
    };
    faces.map(depth).fold(f64::INFINITY, f64::min)
}
