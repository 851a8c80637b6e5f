//! Signed distances of coordinates from intervals, and of all together from a box.

use std::f64::consts::TAU;

use crate::robot::Coordinate;
use crate::space::shorter_way;
use crate::tolerance::EPSILON;

/// The signed distance of a coordinate from its interval: positive outside, negative inside, with the derivative and the
/// error.
#[derive(Clone, Copy)]
pub(super) struct Span {
    pub beyond: f64,
    pub slope: f64,
    pub error: f64,
}

pub(super) fn span(coordinate: Coordinate, q: f64, low: f64, high: f64) -> Option<Span> {
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

/// The signed distance from a box, and its error. Outside it is the length of the vector of excesses, inside minus the
/// smallest depth. Each interval comes with the index of its coordinate.
pub(super) fn measure_of(spans: impl Iterator<Item = (usize, Span)> + Clone) -> (f64, f64) {
    let error = spans.clone().map(|(_, span)| span.error).sum();
    let largest = largest(spans.clone());
    if largest <= 0.0 {
        return (largest, error);
    }
    (length_outside(spans, largest), error)
}

/// The derivative of the same with respect to the coordinates.
pub(super) fn slopes_of(
    spans: impl Iterator<Item = (usize, Span)> + Clone,
    coordinates: usize,
) -> Vec<f64> {
    let mut slopes = vec![0.0; coordinates];
    let largest = largest(spans.clone());
    if largest <= 0.0 {
        if let Some((i, span)) = spans.clone().find(|(_, span)| span.beyond == largest) {
            slopes[i] = span.slope;
        }
        return slopes;
    }
    let length = length_outside(spans.clone(), largest);
    for (i, span) in spans.filter(|(_, span)| span.beyond > 0.0) {
        slopes[i] = span.slope * (span.beyond / length);
    }
    slopes
}

/// The largest signed distance of a coordinate from its interval.
pub(super) fn largest(spans: impl Iterator<Item = (usize, Span)>) -> f64 {
    let beyond = spans.map(|(_, span)| span.beyond);
    beyond.fold(f64::NEG_INFINITY, f64::max)
}

/// The length of the vector of excesses, whose largest entry is `largest`.
fn length_outside(spans: impl Iterator<Item = (usize, Span)>, largest: f64) -> f64 {
    let outside = spans.filter(|(_, span)| span.beyond > 0.0);
    // Scaled: squares of large entries would overflow.
    let sum: f64 = outside.map(|(_, s)| (s.beyond / largest).powi(2)).sum();
    largest * sum.sqrt()
}
