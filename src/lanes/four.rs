//! Four lanes in double precision: plain arrays, which the compiler turns into vector instructions.
//!
//! No operation fuses a product and a sum, so every instruction set gives the same bits.

use std::ops::{Add, Mul, Neg, Sub};

use super::each3;

/// 1.5 * 2^52. The numbers around it are whole and one apart, so that a sum with it is rounded to a whole number. `f64::round`
/// and `f64::ceil` are function calls on an x86-64 without SSE4.1.
const TO_WHOLE: f64 = 6_755_399_441_055_744.0;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct F64x4(pub [f64; 4]);

impl F64x4 {
    #[inline(always)]
    pub fn splat(value: f64) -> Self {
        Self([value; 4])
    }

    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut result = self;
        for lane in 0..4 {
            result.0[lane] = f(self.0[lane]);
        }
        result
    }

    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        for lane in 0..4 {
            result.0[lane] = f(self.0[lane], other.0[lane]);
        }
        result
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The lane-wise minimum; the second operand where either is NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    /// The lane-wise maximum; the second operand where either is NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    /// The quotient, and 0 where the divisor is 0.
    #[inline(always)]
    pub fn quotient(self, divisor: Self) -> Self {
        self.zip(divisor, |a, b| if b != 0.0 { a / b } else { 0.0 })
    }

    /// The reciprocal, and 0 where the number is 0.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        Self::splat(1.0).quotient(self)
    }

    /// The numbers clamped to [0, 1].
    #[inline(always)]
    pub fn unit(self) -> Self {
        self.min(Self::splat(1.0)).max(Self::splat(0.0))
    }

    /// The nearest whole numbers, of two the even one. For numbers of at most 2^31 in size.
    #[inline(always)]
    pub fn nearest(self) -> Self {
        nearest(self)
    }

    /// The same as integers, without calls or saturation; those of numbers out of range mean nothing.
    #[inline(always)]
    pub fn nearest_integers(self) -> [i32; 4] {
        let sums = self.map(|a| a + TO_WHOLE);
        // The lowest bits of the sum are the whole number in two's complement.
        [0, 1, 2, 3].map(|lane: usize| sums.0[lane].to_bits() as i32)
    }

    /// The least whole numbers that are not less. For numbers of at most 2^31 in size.
    #[inline(always)]
    pub fn ceiling(self) -> Self {
        self.nearest()
            .zip(self, |near, a| if near < a { near + 1.0 } else { near })
    }

    #[inline(always)]
    pub fn least(self) -> f64 {
        let mut rest = self;
        let mut count = 4;
        while count > 1 {
            count /= 2;
            for lane in 0..count {
                let (a, b) = (rest.0[lane], rest.0[lane + count]);
                rest.0[lane] = if a < b { a } else { b };
            }
        }
        rest.0[0]
    }

    #[inline(always)]
    pub fn greatest(self) -> f64 {
        -(-self).least()
    }
}

impl Add for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Neg for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

impl Add<f64> for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, term: f64) -> Self {
        self.map(|a| a + term)
    }
}

impl Mul<f64> for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.map(|a| a * factor)
    }
}

/// Four points or vectors, as one [`F64x4`] per coordinate.
pub type Points64 = [F64x4; 3];

/// Four numbers: an [`F64x4`], or the register of an instruction set; or one number.
pub trait Numbers:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Add<f64, Output = Self>
{
}

impl<N> Numbers for N where
    N: Copy
        + Add<Output = N>
        + Sub<Output = N>
        + Mul<Output = N>
        + Mul<f64, Output = N>
        + Add<f64, Output = N>
{
}

/// The nearest whole numbers, of two the even one. For numbers of at most 2^31 in size.
#[inline(always)]
pub fn nearest<N: Numbers>(numbers: N) -> N {
    (numbers + TO_WHOLE) + -TO_WHOLE
}

#[inline(always)]
pub fn dot64<N: Numbers>(a: &[N; 3], b: &[N; 3]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn along64<N: Numbers>(points: &[N; 3], direction: &[f64; 3]) -> N {
    points[0] * direction[0] + points[1] * direction[1] + points[2] * direction[2]
}

#[inline(always)]
pub fn cross64<N: Numbers>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub fn sub64<N: Numbers>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The points at parameters of lines.
#[inline(always)]
pub fn at64<N: Numbers>(starts: &[N; 3], along: &[N; 3], parameters: N) -> [N; 3] {
    [
        starts[0] + along[0] * parameters,
        starts[1] + along[1] * parameters,
        starts[2] + along[2] * parameters,
    ]
}

#[inline(always)]
pub fn splat64(point: &[f64; 3]) -> Points64 {
    each3(|k| F64x4::splat(point[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_those_of_the_standard_library() {
        let below_half = 0.5f64.next_down();
        let mut numbers = vec![
            0.0,
            -0.0,
            0.5,
            1.5,
            below_half,
            -below_half,
            1.0 + f64::EPSILON,
        ];
        numbers.extend([65_535.0, 65_535.5, 65_535.000_001, 32_767.499_999, 2e9]);
        numbers.extend((0..40_000).map(|i| f64::from(i) * 1.637_251 - 32_768.0));
        for number in numbers.iter().flat_map(|&a| [a, -a]) {
            let lanes = F64x4::splat(number);
            let nearest = number.round_ties_even();
            assert_eq!(lanes.nearest(), F64x4::splat(nearest), "{number}");
            assert_eq!(lanes.nearest_integers(), [nearest as i32; 4], "{number}");
            assert_eq!(lanes.ceiling(), F64x4::splat(number.ceil()), "{number}");
        }
    }
}
