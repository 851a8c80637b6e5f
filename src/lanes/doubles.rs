//! Four lanes in double precision, in a register of an instruction set. What loops over an [`F64x4`] is left to the compiler,
//! which in long code takes registers of two lanes.

use std::ops::{Add, Mul, Sub};

use super::F64x4;
use super::four::Points64;

/// The operations of an instruction set on four doubles. None fuses a product and a sum, so every instruction set gives the same
/// bits; they are those of the operations of the same names of [`F64x4`].
pub trait DoubleInstructions: Copy {
    /// Four lanes of f64.
    type Numbers64: Copy;

    fn splat64(self, value: f64) -> Self::Numbers64;
    fn load64(self, values: &[f64; 4]) -> Self::Numbers64;
    fn array64(self, a: Self::Numbers64) -> F64x4;
    fn add64(self, a: Self::Numbers64, b: Self::Numbers64) -> Self::Numbers64;
    fn sub64(self, a: Self::Numbers64, b: Self::Numbers64) -> Self::Numbers64;
    fn mul64(self, a: Self::Numbers64, b: Self::Numbers64) -> Self::Numbers64;
    /// The quotient, and 0 where the divisor is 0.
    fn quotient64(self, a: Self::Numbers64, divisor: Self::Numbers64) -> Self::Numbers64;
    /// The lane-wise minimum; the second operand where either is NaN.
    fn min64(self, a: Self::Numbers64, b: Self::Numbers64) -> Self::Numbers64;
    /// The lane-wise maximum; the second operand where either is NaN.
    fn max64(self, a: Self::Numbers64, b: Self::Numbers64) -> Self::Numbers64;
    fn abs64(self, a: Self::Numbers64) -> Self::Numbers64;
    /// The last three lanes, then the first lane of the next four.
    fn following64(self, a: Self::Numbers64, next: Self::Numbers64) -> Self::Numbers64;
    /// The second lane, the third, the first, the fourth.
    fn rolled64(self, a: Self::Numbers64) -> Self::Numbers64;
    /// The first three lanes, then the last lane of another four.
    fn ending64(self, a: Self::Numbers64, last: Self::Numbers64) -> Self::Numbers64;
    /// The bit mask of the lanes where one is less than the other.
    fn less64(self, a: Self::Numbers64, b: Self::Numbers64) -> u32;
    /// The bit mask of the lanes that are equal.
    fn equal64(self, a: Self::Numbers64, b: Self::Numbers64) -> u32;
    /// Where `a` is less than `b` the lanes of the first of two, and of the second elsewhere.
    fn chosen64(
        self,
        a: Self::Numbers64,
        b: Self::Numbers64,
        if_less: Self::Numbers64,
        otherwise: Self::Numbers64,
    ) -> Self::Numbers64;

    /// The numbers in the lanes of a bit mask; 0 in all others.
    fn kept64(self, a: Self::Numbers64, lanes: u32) -> Self::Numbers64;

    /// The rounding error of a product. It is exact, and so the same on every instruction set, except near overflow and underflow.
    fn product_error(self, x: F64x4, y: F64x4, product: F64x4) -> F64x4;
}

/// Four doubles.
#[derive(Clone, Copy)]
pub struct Doubles<I: DoubleInstructions> {
    pub(super) numbers: I::Numbers64,
    pub(super) lanes: I,
}

/// Four points or vectors, as one register per coordinate.
pub type DoubleTriple<I> = [Doubles<I>; 3];

impl<I: DoubleInstructions> Doubles<I> {
    #[inline(always)]
    pub fn splat(lanes: I, value: f64) -> Self {
        Self {
            numbers: lanes.splat64(value),
            lanes,
        }
    }

    #[inline(always)]
    pub fn load(lanes: I, values: &F64x4) -> Self {
        Self::four(lanes, &values.0)
    }

    #[inline(always)]
    pub fn four(lanes: I, values: &[f64; 4]) -> Self {
        Self {
            numbers: lanes.load64(values),
            lanes,
        }
    }

    #[inline(always)]
    pub fn points(lanes: I, points: &Points64) -> DoubleTriple<I> {
        let [x, y, z] = points;
        [
            Self::load(lanes, x),
            Self::load(lanes, y),
            Self::load(lanes, z),
        ]
    }

    /// One point in all lanes.
    #[inline(always)]
    pub fn point(lanes: I, point: &[f64; 3]) -> DoubleTriple<I> {
        let [x, y, z] = *point;
        [
            Self::splat(lanes, x),
            Self::splat(lanes, y),
            Self::splat(lanes, z),
        ]
    }

    /// A number in all lanes, for the same instructions.
    #[inline(always)]
    pub fn splatted(self, value: f64) -> Self {
        Self::splat(self.lanes, value)
    }

    #[inline(always)]
    pub fn array(self) -> F64x4 {
        self.lanes.array64(self.numbers)
    }

    /// The same instructions' other numbers.
    #[inline(always)]
    fn of(self, numbers: I::Numbers64) -> Self {
        Self {
            numbers,
            lanes: self.lanes,
        }
    }

    /// The lane-wise minimum; the second operand where either is NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.of(self.lanes.min64(self.numbers, other.numbers))
    }

    /// The lane-wise maximum; the second operand where either is NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.of(self.lanes.max64(self.numbers, other.numbers))
    }

    /// The quotient, and 0 where the divisor is 0.
    #[inline(always)]
    pub fn quotient(self, divisor: Self) -> Self {
        self.of(self.lanes.quotient64(self.numbers, divisor.numbers))
    }

    /// The reciprocal, and 0 where the number is 0.
    #[inline(always)]
    pub fn inverse(self) -> Self {
        self.splatted(1.0).quotient(self)
    }

    /// The numbers clamped to [0, 1].
    #[inline(always)]
    pub fn unit(self) -> Self {
        self.min(self.splatted(1.0)).max(self.splatted(0.0))
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        self.of(self.lanes.abs64(self.numbers))
    }

    /// The second lane, the third, the first, the fourth.
    #[inline(always)]
    pub fn rolled(self) -> Self {
        self.of(self.lanes.rolled64(self.numbers))
    }

    /// The first three lanes, then the last lane of another four.
    #[inline(always)]
    pub fn ending(self, last: Self) -> Self {
        self.of(self.lanes.ending64(self.numbers, last.numbers))
    }

    /// The rounding error of the product with another.
    #[inline(always)]
    pub fn product_error(self, other: Self, product: Self) -> Self {
        let [x, y] = [self.array(), other.array()];
        let error = self.lanes.product_error(x, y, product.array());
        Self::load(self.lanes, &error)
    }

    /// The last three lanes, then the first lane of the next four.
    #[inline(always)]
    pub fn following(self, next: Self) -> Self {
        self.of(self.lanes.following64(self.numbers, next.numbers))
    }

    /// The bit mask of the lanes that are less than another's.
    #[inline(always)]
    pub fn less(self, other: Self) -> u32 {
        self.lanes.less64(self.numbers, other.numbers)
    }

    /// The bit mask of the lanes that are equal to another's.
    #[inline(always)]
    pub fn equal(self, other: Self) -> u32 {
        self.lanes.equal64(self.numbers, other.numbers)
    }

    /// Where this is less than another the lanes of the first of two, and of the second elsewhere.
    #[inline(always)]
    pub fn chosen(self, other: Self, if_less: Self, otherwise: Self) -> Self {
        self.of(self.lanes.chosen64(
            self.numbers,
            other.numbers,
            if_less.numbers,
            otherwise.numbers,
        ))
    }

    /// The numbers in the lanes of a bit mask; 0 in all others.
    #[inline(always)]
    pub fn kept(self, lanes: u32) -> Self {
        self.of(self.lanes.kept64(self.numbers, lanes))
    }

    /// The minimum over all lanes.
    #[inline(always)]
    pub fn least(self) -> f64 {
        self.array().least()
    }

    /// The maximum over all lanes.
    #[inline(always)]
    pub fn greatest(self) -> f64 {
        self.array().greatest()
    }
}

impl<I: DoubleInstructions> Add for Doubles<I> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.of(self.lanes.add64(self.numbers, other.numbers))
    }
}

impl<I: DoubleInstructions> Sub for Doubles<I> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.of(self.lanes.sub64(self.numbers, other.numbers))
    }
}

impl<I: DoubleInstructions> Mul for Doubles<I> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.of(self.lanes.mul64(self.numbers, other.numbers))
    }
}

impl<I: DoubleInstructions> Add<f64> for Doubles<I> {
    type Output = Self;
    #[inline(always)]
    fn add(self, term: f64) -> Self {
        self + self.splatted(term)
    }
}

impl<I: DoubleInstructions> Mul<f64> for Doubles<I> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * self.splatted(factor)
    }
}
