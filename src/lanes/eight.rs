//! Eight lanes in single precision, for bounds. Products and sums are fused where that is cheap, and different instruction sets may
//! give different bits: a bound decides what is looked at, and is lowered by more than its rounding, as `pair::ROUNDING` derives.
//! Proofs of whole motions rest on that, so another operation needs another derivation.

use super::doubles::{DoubleInstructions, Doubles};

/// Eight lanes of an instruction set.
pub type Lanes8<I> = <I as Instructions>::Numbers;

/// Eight points or vectors, as one register per coordinate.
pub type Triple<I> = [Lanes8<I>; 3];

/// An instruction set that the processor has.
pub trait Instructions: DoubleInstructions {
    /// Eight lanes of f32.
    type Numbers: Copy;

    fn splat(self, value: f32) -> Self::Numbers;
    fn signed(self, values: &[i16; 8]) -> Self::Numbers;
    fn unsigned(self, values: &[u16; 8]) -> Self::Numbers;
    fn whole(self, values: &[i32; 8]) -> Self::Numbers;
    fn load(self, values: &[f32; 8]) -> Self::Numbers;
    /// Loads four numbers; the other four lanes are 0.
    fn four(self, values: &[f32; 4]) -> Self::Numbers;
    /// Four doubles and four more, each rounded to the nearest.
    fn rounded(self, first: Self::Numbers64, more: Self::Numbers64) -> Self::Numbers;
    fn array(self, a: Self::Numbers) -> [f32; 8];
    fn add(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn sub(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn mul(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn div(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// a * b + c
    fn mul_add(self, a: Self::Numbers, b: Self::Numbers, c: Self::Numbers) -> Self::Numbers;
    fn sqrt(self, a: Self::Numbers) -> Self::Numbers;
    fn abs(self, a: Self::Numbers) -> Self::Numbers;
    /// The first operand where the second is positive, and its opposite where that is negative.
    fn signed_as(self, a: Self::Numbers, sign: Self::Numbers) -> Self::Numbers;
    /// The lane-wise minimum; the second operand where either is NaN.
    fn min(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// The lane-wise maximum; the second operand where either is NaN.
    fn max(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// Broadcasts one lane of each four to all four.
    fn spread<const LANE: i32>(self, a: Self::Numbers) -> Self::Numbers;
    /// Rotates the first three lanes of each four: second, third, first.
    fn rolled(self, a: Self::Numbers) -> Self::Numbers;
    /// Swaps the two halves: the last four lanes, then the first four.
    fn swapped(self, a: Self::Numbers) -> Self::Numbers;
    /// The bit mask of the lanes that are at most a limit.
    fn at_most(self, a: Self::Numbers, limit: f32) -> u32;
    /// The bit mask of the lanes that are not above a limit: those that are at most as large, and what is no number.
    fn not_above(self, a: Self::Numbers, limit: f32) -> u32;
    /// The lanes of a bit mask; infinity in all others.
    fn only(self, a: Self::Numbers, lanes: u32) -> Self::Numbers;
    /// The bits of each value that are set in `kept`, with the numbers from `first` on in the others.
    fn numbered(self, values: &[u32; 8], kept: u32, first: u32) -> [u32; 8];
    /// Compacts the values of the lanes in a bit mask to the front; what follows them is meaningless.
    fn gathered(self, values: &[u32; 8], lanes: u32) -> [u32; 8];

    /// The minimum over all lanes.
    #[inline(always)]
    fn least(self, a: Self::Numbers) -> f32 {
        let mut rest = self.array(a);
        let mut count = 8;
        while count > 1 {
            count /= 2;
            for lane in 0..count {
                let (a, b) = (rest[lane], rest[lane + count]);
                rest[lane] = if a < b { a } else { b };
            }
        }
        rest[0]
    }

    #[inline(always)]
    fn dot(self, a: &[Self::Numbers; 3], b: &[Self::Numbers; 3]) -> Self::Numbers {
        let first = self.mul(a[0], b[0]);
        self.mul_add(a[2], b[2], self.mul_add(a[1], b[1], first))
    }

    /// The dot products of eight vectors with one.
    #[inline(always)]
    fn along(self, a: &[Self::Numbers; 3], b: &[f32; 3]) -> Self::Numbers {
        let b = [self.splat(b[0]), self.splat(b[1]), self.splat(b[2])];
        self.dot(a, &b)
    }

    #[inline(always)]
    fn cross(self, a: &[Self::Numbers; 3], b: &[Self::Numbers; 3]) -> [Self::Numbers; 3] {
        // Not fused, so that the result is the same as for a single box.
        [
            self.sub(self.mul(a[1], b[2]), self.mul(a[2], b[1])),
            self.sub(self.mul(a[2], b[0]), self.mul(a[0], b[2])),
            self.sub(self.mul(a[0], b[1]), self.mul(a[1], b[0])),
        ]
    }
}

impl<I: Instructions> Doubles<I> {
    /// These numbers and four more, rounded to single precision.
    #[inline(always)]
    pub fn rounded(self, more: Self) -> Lanes8<I> {
        self.lanes.rounded(self.numbers, more.numbers)
    }
}

/// For each bit mask, the indices of its lanes in order, then zeros.
pub(super) const LANES_OF: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut set = 0;
    while set < 256 {
        let (mut lane, mut place) = (0, 0);
        while lane < 8 {
            if set >> lane & 1 == 1 {
                table[set][place] = lane as u8;
                place += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};
