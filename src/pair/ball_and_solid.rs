//! A body of one sphere and a body of one box, cylinder or cone: measured by the sphere's centre, which is nearest to one point of the
//! solid. Bit for bit what [`Singles`](super::Singles) answers, which takes up to twice as long.

use super::closed_cores::ClosedCores;
use super::pair_distance::PrimitiveScratch;
use super::pairing::Pairing;
use super::singles::{SinglesNearest, is_within};
use crate::body::Body;
use crate::convex::{BesidePlainSolid, beyond_radii};
use crate::pose::Vec3;
use crate::primitive::{Feature, Round};

/// A sphere, and which of the two bodies it is: 0 for A.
#[derive(Clone, Copy)]
pub struct OnlyBall<'a> {
    ball: &'a Round,
    side: usize,
}

impl<'a> OnlyBall<'a> {
    /// The sphere that one of two bodies is, if the other is a box, a cylinder or a cone.
    #[inline(always)]
    pub fn beside_plain_solid([a, b]: [&'a Body; 2]) -> Option<Self> {
        let (ball, side) = match (a.only_round(), b.only_round()) {
            (Some(ball), _) if b.is_plain_solid() => (ball, 0),
            (_, Some(ball)) if a.is_plain_solid() => (ball, 1),
            _ => return None,
        };
        (!ball.is_capsule).then_some(Self { ball, side })
    }
}

/// Both in the centred frame of A, where the sphere's centre is outside the solid.
pub struct BallAndSolid<'a> {
    pairing: &'a Pairing<'a>,
    center: Vec3,
    beside: BesidePlainSolid<'a>,
    /// Of A and of B: that of the sphere, and that around the solid's core.
    radii: [f64; 2],
    /// Which body is the sphere.
    side: usize,
}

impl<'a> BallAndSolid<'a> {
    /// `None` where the centre is in the solid's core, or so near to it that its nearest point defines no direction.
    #[inline(always)]
    pub fn new(
        pairing: &'a Pairing<'a>,
        OnlyBall { ball, side }: OnlyBall<'a>,
        scratch: &'a mut PrimitiveScratch,
    ) -> Option<Self> {
        let center = &ball.ends[0];
        let (center, solid) = match side {
            0 => (*center, pairing.only_b(&mut scratch.buffer)),
            _ => (pairing.relative.transform_point(center), pairing.only_a()),
        };
        let around = solid.shape.radius();
        Some(Self {
            pairing,
            center,
            radii: match side {
                0 => [ball.radius, around],
                _ => [around, ball.radius],
            },
            beside: BesidePlainSolid::new(center, solid, &pairing.precision)?,
            side,
        })
    }

    /// Whether their distance may be at most `threshold`; doubt counts as within.
    #[inline(always)]
    pub fn are_within(&self, threshold: f64) -> bool {
        let distance = beyond_radii(self.beside.distance, self.radii);
        is_within(distance, self.pairing.precision.error, threshold)
    }

    /// Their nearest points and contact, whatever their distance; `None` where the normal is in doubt.
    #[inline(always)]
    pub fn nearest(&self) -> Option<SinglesNearest> {
        let precision = &self.pairing.precision;
        let (on_solid, feature) = self.beside.nearest(precision);
        let (center, ball) = (self.center, Feature::vertex(0));
        let (points, features) = match self.side {
            0 => ([center, on_solid], [ball, feature]),
            _ => ([on_solid, center], [feature, ball]),
        };
        let cores = ClosedCores {
            pairing: self.pairing,
            radii: self.radii,
            points,
            between: points[0] - points[1],
            apart: self.beside.distance,
        };
        let (normal, gap) = self.beside.normal(feature, &cores.between, precision)?;
        cores.nearest(features, normal, gap)
    }
}
