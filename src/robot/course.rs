//! A coordinate as a function of time.

use smallvec::SmallVec;

/// The highest degree of a curve.
pub const MAX_DEGREE: usize = 16;

/// A coordinate as a function of time, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) enum Course {
    /// `start + rate t`. `summed` is the largest size of what these are sums of.
    Line { start: f64, rate: f64, summed: f64 },
    /// A Bezier curve, by the place and the number of its control points in a list; before them stands the largest size of what
    /// they are sums of.
    Curve { first: u32, count: u32 },
    /// `multiplier x + offset` of a coordinate x that a function gives, with its bounds from this place on in a list.
    Given {
        coordinate: u32,
        multiplier: f64,
        offset: f64,
        bounds: u32,
    },
    /// Of a box of configurations: `center + s rate`, with any s from -1 to 1 that the velocity of this number takes.
    Range {
        center: f64,
        rate: f64,
        velocity: u32,
        /// As that of a line.
        summed: f64,
    },
}

/// A value with its first two derivatives.
#[derive(Clone, Copy, Debug)]
pub struct CourseState {
    /// The value.
    pub value: f64,
    /// Its first derivative.
    pub rate: f64,
    /// Its second derivative.
    pub acceleration: f64,
}

/// The bound of a third derivative of which nothing is stated: above what any other bound may be, though an infinite one times 0
/// would be no number.
const UNSTATED: f64 = f64::MAX;

/// Bounds from time 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct CourseBounds {
    /// Of the absolute value.
    pub farthest: f64,
    /// Of what the value is a sum of: its rounding is relative to this.
    pub summed: f64,
    /// Of the first three derivatives' absolute values.
    pub derivatives: [f64; 3],
    /// The degree of a curve: see [`curve_rounding`]. 0 for what is no curve.
    pub degree: u32,
}

impl Course {
    /// From 0 on at a constant rate.
    pub fn from_zero(rate: f64) -> Self {
        Self::Line {
            start: 0.0,
            rate,
            summed: rate.abs(),
        }
    }

    /// The value and its derivatives at time t, at which a function gives these coordinates; of a range what is at its centre.
    #[inline]
    pub fn at(&self, t: f64, controls: &[f64], given: &[CourseState]) -> CourseState {
        match *self {
            Self::Line { start, rate, .. } => CourseState {
                value: start + rate * t,
                rate,
                acceleration: 0.0,
            },
            Self::Curve { first, count } => {
                let (first, count) = (first as usize, count as usize);
                bezier_at(&controls[first..first + count], t)
            }
            Self::Given {
                coordinate,
                multiplier,
                offset,
                ..
            } => {
                let given = given[coordinate as usize];
                CourseState {
                    value: multiplier * given.value + offset,
                    rate: multiplier * given.rate,
                    acceleration: multiplier * given.acceleration,
                }
            }
            Self::Range { center, .. } => CourseState {
                value: center,
                rate: 0.0,
                acceleration: 0.0,
            },
        }
    }

    /// The value is a mean of the control points, and each derivative one of multiples of their differences.
    pub fn bounds(&self, controls: &[f64]) -> CourseBounds {
        match *self {
            Self::Line {
                start,
                rate,
                summed,
            } => CourseBounds {
                farthest: start.abs().max((start + rate).abs()),
                summed,
                derivatives: [rate.abs(), 0.0, 0.0],
                degree: 0,
            },
            Self::Curve { first, count } => {
                let (first, count) = (first as usize, count as usize);
                let mut points: SmallVec<[f64; MAX_DEGREE + 1]> =
                    controls[first..first + count].into();
                let farthest = largest(&points);
                let derivatives = [(); 3].map(|()| {
                    differentiate(&mut points);
                    largest(&points)
                });
                CourseBounds {
                    farthest,
                    summed: controls[first - 1],
                    derivatives,
                    degree: (count - 1) as u32,
                }
            }
            Self::Given { bounds, .. } => {
                let [farthest, summed, rate, acceleration] =
                    [0, 1, 2, 3].map(|k| controls[bounds as usize + k]);
                CourseBounds {
                    farthest,
                    summed,
                    derivatives: [rate, acceleration, UNSTATED],
                    degree: 0,
                }
            }
            // The way from the centre to any value in the range.
            Self::Range {
                center,
                rate,
                summed,
                ..
            } => CourseBounds {
                farthest: center.abs() + rate.abs(),
                summed,
                derivatives: [rate.abs(), 0.0, 0.0],
                degree: 0,
            },
        }
    }
}

fn largest(points: &[f64]) -> f64 {
    points.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Turns the control points of a curve into those of its derivative.
fn differentiate(points: &mut SmallVec<[f64; MAX_DEGREE + 1]>) {
    let degree = points.len().saturating_sub(1);
    for i in 0..degree {
        points[i] = degree as f64 * (points[i + 1] - points[i]);
    }
    points.truncate(degree);
}

/// By de Casteljau's means: the last three of them give the derivatives.
fn bezier_at(controls: &[f64], t: f64) -> CourseState {
    let mut points: SmallVec<[f64; MAX_DEGREE + 1]> = controls.into();
    let degree = (points.len() - 1) as f64;
    let mut second = 0.0;
    let mut first = 0.0;
    for count in (1..points.len()).rev() {
        if count == 2 {
            second = points[2] - 2.0 * points[1] + points[0];
        } else if count == 1 {
            first = points[1] - points[0];
        }
        for i in 0..count {
            points[i] = between(points[i], points[i + 1], t);
        }
    }
    CourseState {
        value: points[0],
        rate: degree * first,
        acceleration: degree * (degree - 1.0) * second,
    }
}

/// How far rounding puts a Bezier curve of degree n off within a time `reach` of where its value and derivatives are computed, in
/// epsilons of its largest control point: at most 16 n (1 + n reach)^2.
///
/// With M for that point, a mean of two points (see [`between`]) is off by at most 2.5 epsilon M, and by 5.5 where its share is a quotient of
/// differences, as in the blossoms of splines; means of means hand on no more than what their points are off by. So the control points
/// of a spline's piece are off by 5.5 n epsilon M, those of de Casteljau's last means by 2.5 n more, and the value by 8 n. A first
/// derivative is n times a difference of two of them, off by 16 n^2, a second one n (n - 1) times a difference of differences, off by
/// 32 n^3, and counts for half the square of the time.
pub(super) fn curve_rounding(degree: f64, reach: f64) -> f64 {
    let grown = 1.0 + degree * reach;
    16.0 * degree * grown * grown
}

/// A part of the way from one coordinate to another, never beyond either, whatever is rounded: a curve whose control points are at a limit of
/// a joint stays there.
pub fn between(from: f64, to: f64, share: f64) -> f64 {
    if share == 1.0 {
        return to;
    }
    let [low, high] = [from.min(to), from.max(to)];
    (from + share * (to - from)).max(low).min(high)
}

/// The value of a Bezier curve at time t.
pub fn bezier(controls: impl Iterator<Item = f64>, t: f64) -> f64 {
    let points: SmallVec<[f64; MAX_DEGREE + 1]> = controls.collect();
    bezier_at(&points, t).value
}

/// The largest speed of a Bezier curve, or more.
pub fn bezier_speed(controls: impl Iterator<Item = f64>) -> f64 {
    let mut points: SmallVec<[f64; MAX_DEGREE + 1]> = controls.collect();
    differentiate(&mut points);
    largest(&points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::EPSILON;
    use cstk_scenes::Random;

    /// The value and the first two derivatives at time `part / 64` of a curve, 64^degree times as large.
    fn exact(controls: &[i128], part: i128) -> [i128; 3] {
        let mut points = controls.to_vec();
        let degree = (controls.len() - 1) as i128;
        let mut found = [0; 3];
        // The means are not divided by 64: those of level k are 64^k times as large.
        while points.len() > 1 {
            match points.len() {
                3 => {
                    let second = points[2] - 2 * points[1] + points[0];
                    found[2] = 64 * 64 * degree * (degree - 1) * second;
                }
                2 => found[1] = 64 * degree * (points[1] - points[0]),
                _ => {}
            }
            points = points
                .windows(2)
                .map(|two| (64 - part) * two[0] + part * two[1])
                .collect();
        }
        found[0] = points[0];
        found
    }

    /// What [`curve_rounding`] counts holds beside whole numbers, in which nothing is rounded.
    #[test]
    fn curves_are_rounded_as_stated() {
        let mut random = Random::new(7);
        let mut worst = [0.0_f64; 3];
        for _ in 0..20_000 {
            let degree = 1 + (random.bits() % MAX_DEGREE as u64) as usize;
            let controls: Vec<i128> = (0..=degree)
                .map(|_| i128::from(random.bits() % 2048) - 1024)
                .collect();
            let part = i128::from(random.bits() % 65);
            let floats: Vec<f64> = controls.iter().map(|c| *c as f64 / 1024.0).collect();
            let largest = largest(&floats);
            let found = bezier_at(&floats, part as f64 / 64.0);
            let unit = 2f64.powi(-(10 + 6 * degree as i32));
            let truth = exact(&controls, part);
            let found = [found.value, found.rate, found.acceleration];
            let n = degree as f64;
            let stated = [16.0 * n, 32.0 * n * n, 32.0 * n * n * n];
            for k in 0..3 {
                // Both in units, so that their difference is exact.
                let off = ((found[k] / unit) as i128 - truth[k]) as f64 * unit;
                let off = off.abs() / (EPSILON * largest.max(1e-3));
                assert!(off <= stated[k], "degree {degree}, derivative {k}: {off}");
                worst[k] = worst[k].max(off / stated[k]);
            }
        }
        assert!(worst.iter().all(|share| *share > 1e-3), "{worst:?}");
    }
}
