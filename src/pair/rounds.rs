//! Two bodies of one sphere or capsule each: measured by their axes, which are points or segments. Bit for bit what
//! [`Singles`](super::Singles) answers, which takes up to four times as long.

use super::hit::Hit;
use super::pairing::Pairing;
use super::singles::{SinglesNearest, is_within};
use crate::body::Body;
use crate::convex::{Contact, Segment, closest_parameters, mode_of};
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind, Round};
use crate::tolerance;

/// The only primitives of two bodies, where both are spheres or capsules, in the centred frame of A.
pub struct Rounds<'a> {
    pairing: &'a Pairing<'a>,
    rounds: [&'a Round; 2],
    /// `None` for two spheres.
    axes: Option<[Segment; 2]>,
    /// Where the nearest points of the axes are on these, from 0 to 1.
    parameters: [f64; 2],
    /// The nearest points of the axes.
    points: [Vec3; 2],
    /// From the point of B to that of A.
    between: Vec3,
    /// The distance of the axes.
    apart: f64,
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
            pairing,
            rounds,
            axes,
            parameters,
            points,
            between,
            apart: between.norm(),
        }
    }

    /// The distance beyond the radii; 0 where the two meet.
    #[inline(always)]
    fn distance(&self) -> f64 {
        let ([a, b], apart) = (self.radii(), self.apart);
        if apart >= a + b { apart - a - b } else { 0.0 }
    }

    #[inline(always)]
    fn radii(&self) -> [f64; 2] {
        [self.rounds[0].radius, self.rounds[1].radius]
    }

    /// Whether their distance may be at most `threshold`; doubt counts as within.
    #[inline(always)]
    pub fn are_within(&self, threshold: f64) -> bool {
        is_within(self.distance(), self.pairing.precision.error, threshold)
    }

    /// Their nearest points and contact, whatever their distance; `None` where the axes are too close together to define a normal.
    #[inline(always)]
    pub fn nearest(&self) -> Option<SinglesNearest> {
        let (pairing, precision) = (self.pairing, &self.pairing.precision);
        let ([on_a, on_b], [a, b], apart) = (self.points, self.radii(), self.apart);
        if apart
            <= precision
                .error
                .max(tolerance::MIN_NORMAL_DISTANCE * precision.size)
        {
            return None;
        }
        let features = [self.feature(0), self.feature(1)];
        let normal = self.normal(features)?;
        let gap = normal.dot(&self.between) - a - b;
        let gap = if gap.abs() > precision.error {
            gap
        } else {
            0.0
        };
        let contact = pairing.in_world(Contact {
            points: [on_a - normal * a, on_b + normal * b],
            normal,
            distance: gap.max(0.0),
            gap,
            mode: mode_of(features)?,
            features,
        });
        let way = self.between / apart;
        let points = if apart >= a + b {
            pairing.points_in_world(&[on_a - way * a, on_b + way * b])
        } else {
            // The middle of the overlap along the line between the axes.
            let middle = 0.5 * ((apart - b).max(0.0) + a.min(apart));
            [pairing.frame.transform_point(&(on_a - way * middle)); 2]
        };
        let distance = pairing.above_error(self.distance());
        let is_apart = distance > 0.0;
        Some(SinglesNearest {
            hit: Hit::of_singles(distance, is_apart),
            lower: if is_apart {
                distance - precision.error
            } else {
                0.0
            },
            points,
            contact: Some(contact),
        })
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
        let (parameter, point) = (self.parameters[side], &self.points[side]);
        let near = |end: &Vec3| (end - point).norm() <= self.pairing.precision.error;
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
        if let [Some(a), Some(b)] = edges {
            let across = a.cross(&b);
            let length = across.norm();
            if length > tolerance::PARALLEL_EDGES {
                let normal = across / length;
                let is_reversed = normal.dot(&self.between) < 0.0;
                return Some(if is_reversed { -normal } else { normal });
            }
        }
        let doubt = 64.0 * tolerance::EPSILON * self.pairing.precision.size / self.apart;
        if doubt >= tolerance::NORMAL_ERROR {
            return None;
        }
        if edges == [None; 2] {
            return Some(self.between / self.apart);
        }
        let way = edges.into_iter().flatten();
        let way = way.fold(self.between, |way, along| way - along * along.dot(&way));
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
