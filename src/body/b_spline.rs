//! Knot vectors of B-splines, and the Bezier curves between their knots.

use nalgebra::Vector4;

use crate::error::{Error, ErrorKind, Result, require_coordinates};

/// A checked knot vector: t_0 <= ... <= t_(n + p) for n control points of degree p. The curve goes from t_p to t_n and does not tear
/// between them. The knots before and after need not be equal to these.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnotVector<'a> {
    degree: usize,
    knots: &'a [f64],
}

impl<'a> KnotVector<'a> {
    /// Checks the knots of a curve of this degree.
    pub fn checked(degree: usize, knots: &'a [f64]) -> Result<Self> {
        let least = 2 * (degree + 1);
        if knots.len() < least {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "degree {degree} needs at least {least} knots, not {}",
                    knots.len()
                ),
            ));
        }
        // Differences are finite therefore.
        require_coordinates(knots, "knot")?;
        let checked = Self { degree, knots };
        checked.require_order()?;
        checked.require_domain()?;
        checked.require_multiplicities()?;
        Ok(checked)
    }

    /// Refuses knots that fall. Quotients of differences are as exact as any for normal numbers, wherever the processor is set to
    /// take others for 0.
    fn require_order(&self) -> Result<()> {
        for (i, two) in self.knots.windows(2).enumerate() {
            let [here, next] = [two[0], two[1]];
            if here > next {
                return Err(Error::invalid(format!(
                    "knot {} is less than the knot before it",
                    i + 1
                )));
            }
            if here < next && next - here < f64::MIN_POSITIVE {
                return Err(Error::invalid(format!(
                    "knots {i} and {} are {:e} apart; they must be equal, or {:e} apart",
                    i + 1,
                    next - here,
                    f64::MIN_POSITIVE
                )));
            }
        }
        Ok(())
    }

    fn require_domain(&self) -> Result<()> {
        let [first, last] = [self.degree, self.point_count()];
        match self.knots[first] < self.knots[last] {
            true => Ok(()),
            false => Err(Error::invalid(format!(
                "knots {first} and {last}, between which the surface lies, are equal"
            ))),
        }
    }

    fn require_multiplicities(&self) -> Result<()> {
        let domain = [self.knots[self.degree], self.knots[self.point_count()]];
        let mut first = 0;
        for equal in self.knots.chunk_by(|a, b| a == b) {
            let is_inner = domain[0] < equal[0] && equal[0] < domain[1];
            let most = self.degree + usize::from(!is_inner);
            if equal.len() > most {
                let (last, why) = (
                    first + equal.len() - 1,
                    if is_inner {
                        ": the surface is torn"
                    } else {
                        ""
                    },
                );
                return Err(Error::invalid(format!(
                    "knots {first} to {last} are equal, more than {most}{why}"
                )));
            }
            first += equal.len();
        }
        Ok(())
    }

    /// The number of control points.
    pub fn point_count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// The spans that are not empty, in order: the number k of the knot where each begins.
    pub fn spans(&self) -> Vec<usize> {
        let all = self.degree..self.point_count();
        all.filter(|&k| self.knots[k] < self.knots[k + 1]).collect()
    }

    /// The number of the first of the p + 1 control points on which a span depends.
    pub fn first_point(&self, span: usize) -> usize {
        span - self.degree
    }

    /// How many rounds of averages [`KnotVector::insert_ends`] makes.
    pub fn rounds(&self) -> usize {
        2 * (self.degree - 1)
    }

    /// Turns the control points on which a span depends, which stand at `at(0)` to `at(p)`, into those of its Bezier curve: inserts the
    /// knots at its ends until each is there p times (Boehm 1980).
    ///
    /// Averages have weights within [0, 1], also when rounded: where t_i <= t < t_j or t_i < t <= t_j, the quotient of t - t_i and
    /// t_j - t_i is one of a number and one that is not less, which is at least as long as the span.
    pub fn insert_ends(
        &self,
        span: usize,
        points: &mut [Vector4<f64>],
        at: impl Fn(usize) -> usize,
    ) {
        let (p, t) = (self.degree, self.knots);
        let [from, to] = [t[span], t[span + 1]];
        for round in 1..p {
            for i in 0..p - round {
                let [low, high] = [t[span - p + i + round], t[span + i + 1]];
                let share = (from - low) / (high - low);
                points[at(i)] = average(&points[at(i)], &points[at(i + 1)], share);
            }
        }
        // Before the second end stands nothing but the first one.
        for round in 1..p {
            for i in (round + 1..=p).rev() {
                let share = (to - from) / (t[span + i - round + 1] - from);
                points[at(i)] = average(&points[at(i - 1)], &points[at(i)], share);
            }
        }
    }
}

/// One of both points where the share is 0 or 1, to the last bit.
fn average(a: &Vector4<f64>, b: &Vector4<f64>, share: f64) -> Vector4<f64> {
    a * (1.0 - share) + b * share
}
