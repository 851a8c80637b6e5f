//! A point outside a box, a cylinder or a cone: the nearest point there, and the normal. They are those of `distance.rs` and
//! `contacts.rs`, but the distance is known before either is computed.

use super::cuboid_distance::way_from_cuboid;
use super::feature_pair::across;
use super::placed::{PlacedPrimitive, Precision};
use super::point_to_smooth::way_from_smooth;
use super::polytope_distance::{cuboid, snapped};
use crate::pose::{Mat3, Vec3, turned, turned_back};
use crate::primitive::{Cuboid, Feature, FeatureKind, Smooth};
use crate::tolerance;

/// A point outside the core of such a solid.
pub struct BesidePlainSolid<'a> {
    point: Vec3,
    solid: PlacedPrimitive<'a>,
    frame: Frame<'a>,
    /// From the nearest point of the core, in its own frame.
    way: Vec3,
    /// The length of the way.
    pub distance: f64,
}

/// The core's own frame.
enum Frame<'a> {
    /// Where the box has the point.
    Cuboid { cuboid: &'a Cuboid, seen: Vec3 },
    /// The directions of the axes in the common frame.
    Smooth { axes: Mat3 },
}

impl<'a> BesidePlainSolid<'a> {
    /// `None` for a point in the core, or so near to it that the way defines no direction, and for cores of other kinds.
    #[inline(always)]
    pub fn new(point: Vec3, solid: PlacedPrimitive<'a>, precision: &Precision) -> Option<Self> {
        match solid.shape.smooth() {
            None => Self::of_cuboid(point, solid, precision),
            Some(smooth) => Self::of_smooth(point, solid, smooth, precision),
        }
    }

    #[inline(always)]
    fn of_cuboid(point: Vec3, solid: PlacedPrimitive<'a>, precision: &Precision) -> Option<Self> {
        let cuboid = cuboid(&solid)?;
        let seen = cuboid.seen(&solid.seen(&point));
        let way = way_from_cuboid(&seen, cuboid)?;
        let least = tolerance::MIN_NORMAL_DISTANCE * precision.size;
        let found = Self {
            point,
            solid,
            frame: Frame::Cuboid { cuboid, seen },
            way,
            distance: way.norm(),
        };
        (found.distance > precision.error.max(least)).then_some(found)
    }

    #[inline(always)]
    fn of_smooth(
        point: Vec3,
        solid: PlacedPrimitive<'a>,
        smooth: &Smooth,
        precision: &Precision,
    ) -> Option<Self> {
        let axes = solid.turned_axes(&smooth.axes);
        let local = turned_back(&axes, &(point - solid.vertex(0)));
        let way = way_from_smooth(&local, &smooth.kind)?;
        let least = tolerance::MIN_SMOOTH_NORMAL_DISTANCE * precision.size;
        let found = Self {
            point,
            solid,
            frame: Frame::Smooth { axes },
            way,
            distance: way.norm(),
        };
        (found.distance > least).then_some(found)
    }

    /// The point of the core nearest to the point, and the feature that holds it.
    #[inline(always)]
    pub fn nearest(&self, precision: &Precision) -> (Vec3, Feature) {
        match &self.frame {
            Frame::Smooth { axes } => (self.point - turned(axes, &self.way), Feature::surface()),
            Frame::Cuboid { cuboid, seen } => {
                let way = self.solid.turned(&turned(&cuboid.axes, &self.way));
                let (at, feature) = (self.point - way, cuboid.feature_towards(seen));
                (at, snapped(&self.solid, feature, &at, precision.error))
            }
        }
    }

    /// The unit normal along `way`, which leads between the point and the nearest one, on `feature`, in either direction; and the gap along
    /// the normal. `None` where rounding would turn it.
    #[inline(always)]
    pub fn normal(
        &self,
        feature: Feature,
        way: &Vec3,
        precision: &Precision,
    ) -> Option<(Vec3, f64)> {
        let with_gap = |normal: Vec3| (normal, normal.dot(way));
        match feature.kind {
            FeatureKind::Surface => Some((way.normalize(), self.distance)),
            FeatureKind::Face => {
                let normal = self.solid.normal(feature.index as usize);
                let is_reversed = normal.dot(way) < 0.0;
                Some(with_gap(if is_reversed { -normal } else { normal }))
            }
            _ => {
                let doubt = 64.0 * tolerance::EPSILON * precision.size / self.distance;
                let is_clear = doubt < tolerance::NORMAL_ERROR;
                let direct = is_clear.then(|| across(&self.solid, feature, *way))?;
                direct.try_normalize(0.0).map(with_gap)
            }
        }
    }
}
