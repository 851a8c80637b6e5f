//! Motions on Bezier curves and B-splines through C-space.

use super::coordinate_motion::{check_quaternions, speeds};
use super::linear_motion::LinearMotion;
use super::motion::MotionOptions;
use super::motion_answer::{MotionAnswer, MotionOutcome};
use super::way::{Way, WayKind};
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result};
use crate::query::{QueryContext, World};
use crate::robot::{MAX_DEGREE, between, bezier_speed};
use crate::space::Space;

/// A B-spline through C-space: its parameter goes from the knot of number `degree` to that of number `points / nq`.
#[derive(Clone, Copy, Debug)]
pub struct Spline<'a> {
    /// From 1 to [`MAX_DEGREE`].
    pub degree: usize,
    /// Never falling; `degree + 1` more than control points.
    pub knots: &'a [f64],
    /// The control points, one configuration after another.
    pub points: &'a [f64],
}

/// A Bezier curve that a spline follows between two of its knots.
#[derive(Clone, Debug, PartialEq)]
pub struct SplinePiece {
    /// The parameters where it begins and ends.
    pub knots: [f64; 2],
    /// Its control points.
    pub points: Vec<f64>,
}

impl QueryContext {
    /// The same as [`QueryContext::motion`] on a Bezier curve, given by its control points, one configuration after another: at time
    /// t every coordinate is the mean that de Casteljau's construction makes. Coordinates on circles are not taken the shorter way
    /// round. Those of quaternions must not change. A space without coordinates has one configuration, on which every curve rests.
    pub fn motion_on_curve(
        &mut self,
        cobject: &CObject,
        points: &[f64],
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let nq = cobject.space().nq();
        if nq == 0 {
            check_no_points(points)?;
            return self.motion(cobject, &[], &[], options);
        }
        // Before the points are read.
        if let Some(degree) = (points.len() / nq).checked_sub(1)
            && degree > MAX_DEGREE
        {
            return Err(Error::invalid(format!(
                "the curve is of degree {degree}; the highest is {MAX_DEGREE}"
            )));
        }
        check_points(cobject.space(), points)?;
        let world = &self.begin_motion(cobject, options)?;
        self.motion_on_piece(world, cobject, points, options)
    }

    /// The same on a B-spline. Times go from 0 to 1, in proportion to the parameter.
    pub fn motion_on_spline(
        &mut self,
        cobject: &CObject,
        spline: &Spline,
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let space = cobject.space();
        if space.nq() == 0 {
            check_no_points(spline.points)?;
            spline.check((spline.knots.len()).saturating_sub(spline.degree + 1))?;
            return self.motion(cobject, &[], &[], options);
        }
        check_points(space, spline.points)?;
        let pieces = spline.pieces(space.nq())?;
        let world = &self.begin_motion(cobject, options)?;
        let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
            return Err(Error::invalid(
                "the spline has no length: all of its knots are equal",
            ));
        };
        let [start, whole] = [first.knots[0], last.knots[1] - first.knots[0]];
        let time = |u: f64| ((u - start) / whole).clamp(0.0, 1.0);
        let mut found = None;
        for piece in &pieces {
            let [from, to] = piece.knots.map(time);
            let within = MotionOptions {
                tolerance: (options.tolerance / (to - from)).clamp(1e-12, 1.0),
                ..*options
            };
            let answer = self.motion_on_piece(world, cobject, &piece.points, &within)?;
            let is_free = answer.outcome == MotionOutcome::Free;
            let times = answer.times.map(|t| (from + t * (to - from)).min(to));
            found = Some(MotionAnswer { times, ..answer });
            if !is_free {
                break;
            }
        }
        found.ok_or_else(|| Error::invalid("the spline has no piece"))
    }

    fn motion_on_piece(
        &mut self,
        world: &World,
        cobject: &CObject,
        points: &[f64],
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let space = cobject.space();
        let q = &points[..space.nq()];
        let speed = |c: usize| bezier_speed(points.iter().skip(c).step_by(space.nq()).copied());
        let v = &speeds(space, points, speed);
        let line = LinearMotion {
            world,
            cobject,
            q,
            v,
        };
        let way = &Way {
            line,
            end: None,
            kind: WayKind::Curve { controls: points },
        };
        MotionAnswer::or_undecided(self.motion_on(way, options), || q.to_vec())
    }
}

/// Of a space without coordinates, control points have no numbers.
fn check_no_points(points: &[f64]) -> Result<()> {
    match points.len() {
        0 => Ok(()),
        count => Err(Error::new(
            ErrorKind::WrongSize,
            format!("the control points have {count} entries, but the space has no coordinates"),
        )),
    }
}

/// Refuses control points that make no curve.
fn check_points(space: &Space, points: &[f64]) -> Result<()> {
    let nq = space.nq();
    if points.is_empty() || !points.len().is_multiple_of(nq) {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "the control points have {} entries, which is no multiple of the {nq} coordinates",
                points.len()
            ),
        ));
    }
    for (number, point) in points.chunks_exact(nq).enumerate() {
        let named = |error: Error| error.within(format_args!("control point {number}"));
        space.check_configuration(point).map_err(named)?;
    }
    let rests = |c: usize| points.iter().skip(c).step_by(nq).all(|x| *x == points[c]);
    check_quaternions(space, rests, "on a curve of coordinates")
}

impl Spline<'_> {
    /// The Bezier curves between its knots.
    pub fn pieces(&self, nq: usize) -> Result<Vec<SplinePiece>> {
        let count = self.points.len() / nq;
        self.check(count)?;
        let spans = (self.degree..count).filter(|k| self.knots[*k] < self.knots[k + 1]);
        let pieces = spans.map(|k| {
            let [from, to] = [self.knots[k], self.knots[k + 1]];
            let points = (0..=self.degree).flat_map(|j| self.blossom(nq, k, [from, to], j));
            SplinePiece {
                knots: [from, to],
                points: points.collect(),
            }
        });
        Ok(pieces.collect())
    }

    /// The polar form of span k with `ends[1]` as its first j arguments and `ends[0]` as the others: control point j of the span's
    /// Bezier curve (Ramshaw 1989). De Boor's means, with another argument at each level.
    fn blossom(&self, nq: usize, k: usize, ends: [f64; 2], j: usize) -> Vec<f64> {
        let degree = self.degree;
        let first = k - degree;
        let mut points = self.points[first * nq..(k + 1) * nq].to_vec();
        for level in 1..=degree {
            let argument = ends[usize::from(level <= j)];
            for i in (level..=degree).rev() {
                let [low, high] = [self.knots[first + i], self.knots[k + 1 + i - level]];
                let share = (argument - low) / (high - low);
                for c in 0..nq {
                    points[i * nq + c] =
                        between(points[(i - 1) * nq + c], points[i * nq + c], share);
                }
            }
        }
        points.split_off(degree * nq)
    }

    /// Whether it is a spline with so many control points.
    fn check(&self, count: usize) -> Result<()> {
        if !(1..=MAX_DEGREE).contains(&self.degree) {
            return Err(Error::invalid(format!(
                "the degree {} is not between 1 and {MAX_DEGREE}",
                self.degree
            )));
        }
        if count <= self.degree || self.knots.len() != count + self.degree + 1 {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "a spline of degree {} with {count} control points needs more of them than its degree, and {} knots; {} given",
                    self.degree,
                    count + self.degree + 1,
                    self.knots.len()
                ),
            ));
        }
        crate::error::require_coordinates(self.knots, "knot")?;
        if let Some(i) = self.knots.windows(2).position(|two| two[0] > two[1]) {
            return Err(Error::invalid(format!(
                "knot {} is less than the knot before it",
                i + 1
            )));
        }
        // There the pieces before and behind need not join: a jump is no motion.
        let inner = self.knots[self.degree]..self.knots[count];
        let repeated = self.knots.windows(self.degree + 1);
        let jump = repeated
            .map(|same| (same[0], same[self.degree]))
            .position(|(first, last)| {
                first == last && first > inner.start && inner.contains(&first)
            });
        if let Some(i) = jump {
            return Err(Error::invalid(format!(
                "knots {i} to {} are equal: an inner knot of a spline of degree {} stands there at most {} times, or the spline jumps",
                i + self.degree,
                self.degree,
                self.degree
            )));
        }
        Ok(())
    }
}
