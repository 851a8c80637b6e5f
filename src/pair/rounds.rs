//! Two bodies of one sphere or capsule each: measured by their axes, which are points or segments. Bit for bit what
//! [`Singles`](super::Singles) answers, which takes up to four times as long.

use super::closed_cores::ClosedCores;
use super::pairing::Pairing;
use super::singles::SinglesNearest;
use crate::body::Body;
use crate::convex::{Segment, closest_parameters};
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind, Round};
use crate::tolerance;

/// The only primitives of two bodies, where both are spheres or capsules, in the centred frame of A.
pub struct Rounds<'a> {
    cores: ClosedCores<'a>,
    rounds: [&'a Round; 2],
    /// `None` for two spheres.
    axes: Option<[Segment; 2]>,
    /// Where the nearest points of the axes are on these, from 0 to 1.
    parameters: [f64; 2],
}

impl<'a> Rounds<'a> {
    /// Of the spheres or capsules that are the only primitives of the pairing's bodies.
    #[inline(always)]
    pub fn new(pairing: &'a Pairing<'a>, rounds: [&'a Round; 2]) -> Self {
        let ([a, b], to_a) = (rounds, &pairing.relative);
        let (start_a, start_b) = (a.ends[0], to_a.transform_point(&b.ends[0]));
        if are_spheres(rounds) {
            return Self::at(pairing, rounds, None, [0.0; 2], [start_a, start_b]);
        }
        let axes = [
            match a.is_capsule {
                true => Segment::new((start_a, a.ends[1])),
                false => Segment::point(start_a),
            },
            match b.is_capsule {
                true => Segment::new((start_b, to_a.transform_point(&b.ends[1]))),
                false => Segment::point(start_b),
            },
        ];
        let (s, t) = closest_parameters(&axes[0], &axes[1]);
        let points = [axes[0].at(s), axes[1].at(t)];
        Self::at(pairing, rounds, Some(axes), [s, t], points)
    }

    #[inline(always)]
    fn at(
        pairing: &'a Pairing<'a>,
        rounds: [&'a Round; 2],
        axes: Option<[Segment; 2]>,
        parameters: [f64; 2],
        points: [Vec3; 2],
    ) -> Self {
        let between = points[0] - points[1];
        Self {
            cores: ClosedCores {
                pairing,
                radii: [rounds[0].radius, rounds[1].radius],
                points,
                between,
                apart: between.norm(),
            },
            rounds,
            axes,
            parameters,
        }
    }

    /// Whether their distance may be at most `threshold`; doubt counts as within.
    #[inline(always)]
    pub fn are_within(&self, threshold: f64) -> bool {
        self.cores.are_within(threshold)
    }

    /// Their nearest points and contact, whatever their distance; `None` where the axes are too close together to define a normal.
    #[inline(always)]
    pub fn nearest(&self) -> Option<SinglesNearest> {
        let precision = &self.cores.pairing.precision;
        let least = tolerance::MIN_NORMAL_DISTANCE * precision.size;
        if self.cores.apart <= precision.error.max(least) {
            return None;
        }
        let features = [self.feature(0), self.feature(1)];
        let normal = self.normal(features)?;
        let gap = normal.dot(&self.cores.between);
        self.cores.nearest(features, normal, gap)
    }

    /// The feature of an axis that holds its nearest point: an end, where the point is there up to the error.
    #[inline(always)]
    fn feature(&self, side: usize) -> Feature {
        let Some(axes) = &self.axes else {
            return Feature::vertex(0);
        };
        if !self.rounds[side].is_capsule {
            return Feature::vertex(0);
        }
        let (parameter, point) = (self.parameters[side], &self.cores.points[side]);
        let near = |end: &Vec3| (end - point).norm() <= self.cores.pairing.precision.error;
        let [start, end] = axes[side].ends();
        if parameter <= 0.0 || parameter < 1.0 && near(&start) {
            Feature::vertex(0)
        } else if parameter >= 1.0 || near(&end) {
            Feature::vertex(1)
        } else {
            Feature::edge(0)
        }
    }

    /// The unit normal from B to A: of two edges their common perpendicular, else the way between the points across the edges.
    /// `None` where rounding would turn it.
    #[inline(always)]
    fn normal(&self, features: [Feature; 2]) -> Option<Vec3> {
        let along = |side: usize| {
            let axes = self.axes.as_ref()?;
            let is_edge = features[side].kind == FeatureKind::Edge;
            is_edge.then(|| axes[side].along().normalize())
        };
        let edges = [along(0), along(1)];
        let (between, apart) = (&self.cores.between, self.cores.apart);
        if let [Some(a), Some(b)] = edges {
            let across = a.cross(&b);
            let length = across.norm();
            if length > tolerance::PARALLEL_EDGES {
                let normal = across / length;
                let is_reversed = normal.dot(between) < 0.0;
                return Some(if is_reversed { -normal } else { normal });
            }
        }
        let doubt = 64.0 * tolerance::EPSILON * self.cores.pairing.precision.size / apart;
        if doubt >= tolerance::NORMAL_ERROR {
            return None;
        }
        if edges == [None; 2] {
            return Some(between / apart);
        }
        let way = edges.into_iter().flatten();
        let way = way.fold(*between, |way, along| way - along * along.dot(&way));
        way.try_normalize(0.0)
    }
}

/// The spheres or capsules that two bodies are, if they are nothing else.
#[inline(always)]
pub fn only_rounds([a, b]: [&Body; 2]) -> Option<[&Round; 2]> {
    Some([a.only_round()?, b.only_round()?])
}

/// Whether both are spheres, whose distance takes no longer than a bound of it.
#[inline(always)]
pub fn are_spheres([a, b]: [&Round; 2]) -> bool {
    !a.is_capsule && !b.is_capsule
}
