//! Sines and cosines, four angles at a time: the same bits with every instruction set and on every machine.

use std::f64::consts::FRAC_2_PI;

use crate::lanes::{Doubles, Instructions, Numbers, nearest};

/// Angles up to this are computed here; larger ones by the standard library.
const MAX_ANGLE: f64 = 1_048_576.0;

/// A quarter turn is the sum of these. The first two have 33 binary digits each, so that their products with a number of quarter turns
/// below [`MAX_ANGLE`] are exact.
const QUARTER: [f64; 3] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_795_950_6e-21,
];

/// The sine and the cosine of an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    pub sine: f64,
    pub cosine: f64,
}

impl Turn {
    /// Of the angle 0.
    pub const NONE: Self = Self {
        sine: 0.0,
        cosine: 1.0,
    };

    /// Of one angle: the bits of [`Turn::by_each`].
    pub fn by(angle: f64) -> Self {
        Self::of_rest(rest_of_turn(angle), angle)
    }

    /// Of four angles, each within 0.8 units in the last place and 1e-29. An angle that is not finite gives NaN.
    #[inline(always)]
    pub fn by_each<I: Instructions>(lanes: I, angles: &[f64; 4]) -> [Self; 4] {
        let rests = rest_of_turn(Doubles::four(lanes, angles)).map(|each| each.array().0);
        std::array::from_fn(|lane| Self::of_rest(rests.map(|each| each[lane]), angles[lane]))
    }

    /// By the sine and the cosine of what is left without a number of quarter turns, and that number.
    #[inline(always)]
    fn of_rest([sine, cosine, quarters]: [f64; 3], angle: f64) -> Self {
        if angle.abs() <= MAX_ANGLE {
            return Self { sine, cosine }.after_quarters(quarters as i32);
        }
        let (sine, cosine) = angle.sin_cos();
        Self { sine, cosine }
    }

    /// The sine, and the cosine.
    pub fn pair(self) -> (f64, f64) {
        (self.sine, self.cosine)
    }

    /// Of the opposite angle where `sign` is -1, of this one where it is 1.
    #[inline(always)]
    pub fn signed(self, sign: f64) -> Self {
        Self {
            sine: self.sine * sign,
            ..self
        }
    }

    /// Of an angle larger by a number of quarter turns. Without branches, which random angles would mispredict.
    #[inline(always)]
    fn after_quarters(self, quarters: i32) -> Self {
        let both = [self.sine, self.cosine];
        let is_odd = (quarters & 1) as usize;
        let negated = |value: f64, quarters: i32| {
            f64::from_bits(value.to_bits() ^ (((quarters & 2) as u64) << 62))
        };
        Self {
            sine: negated(both[is_odd], quarters),
            cosine: negated(both[1 - is_odd], quarters.wrapping_add(1)),
        }
    }
}

/// The sine and the cosine of what is left of angles without a number of quarter turns, and that number.
#[inline(always)]
fn rest_of_turn<N: Numbers>(angle: N) -> [N; 3] {
    let quarters = nearest(angle * FRAC_2_PI);
    let [high, low] = without_quarters(angle, quarters);
    let square = high * high;
    let sine = high + (square * high * series(square, &SINE) + low * (square * -0.5 + 1.0));
    let half = square * 0.5;
    let about = half * -1.0 + 1.0;
    let rounded_off = (about * -1.0 + 1.0) - half;
    let rest = square * square * series(square, &COSINE) - high * low;
    [sine, about + (rounded_off + rest), quarters]
}

/// What is left of angles without a number of quarter turns, at most about 0.79, as a sum: a number and what its rounding left off.
#[inline(always)]
fn without_quarters<N: Numbers>(angle: N, quarters: N) -> [N; 2] {
    // Exact: the product has no more digits than the angle, and is near it.
    let first = angle - quarters * QUARTER[0];
    let product = quarters * QUARTER[1];
    let second = first - product;
    // What the rounding of `second` left off.
    let taken = second - first;
    let error = (first - (second - taken)) - (product + taken);
    let third = quarters * QUARTER[2] - error;
    let high = second - third;
    [high, (second - high) - third]
}

/// Taylor's series of sin r after r, in r²: what is left off is less than 1e-19 of r up to 0.79.
const SINE: [f64; 8] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];

/// Taylor's series of cos r after 1 - r² / 2, in r²: what is left off is less than 3e-18.
const COSINE: [f64; 7] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

/// The sum of a series without its first factor.
#[inline(always)]
fn series<N: Numbers, const COUNT: usize>(x: N, factors: &[f64; COUNT]) -> N {
    let mut sum = x * factors[COUNT - 1] + factors[COUNT - 2];
    for factor in factors[..COUNT - 2].iter().rev() {
        sum = sum * x + *factor;
    }
    sum
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use cstk_scenes::Random;

    use super::*;
    use crate::lanes::{Work, with_each};

    struct Turns([f64; 4]);

    impl Work for Turns {
        type Output = [Turn; 4];

        #[inline(always)]
        fn run<I: Instructions>(self, lanes: I) -> [Turn; 4] {
            Turn::by_each(lanes, &self.0)
        }
    }

    fn angles() -> Vec<f64> {
        let near_quarters = (-40..40).flat_map(|n| {
            let at = f64::from(n) * FRAC_PI_2;
            [
                at,
                at.next_up(),
                at.next_down(),
                at + 1e-9,
                at + 0.5 * FRAC_PI_2,
            ]
        });
        let special = [
            0.0,
            -0.0,
            5e-324,
            1e-300,
            -1e-12,
            1e300,
            MAX_ANGLE,
            MAX_ANGLE.next_up(),
        ];
        let mut random = Random::new(1);
        let mut angles: Vec<f64> = near_quarters.chain(special).collect();
        angles.extend((0..40_000).map(|_| random.within(-7.0, 7.0)));
        angles.extend((0..10_000).map(|_| random.within(-MAX_ANGLE, MAX_ANGLE)));
        angles
    }

    /// The distance of two numbers in units in the last place.
    fn units_apart(a: f64, b: f64) -> f64 {
        let unit = a.abs().next_up() - a.abs();
        (a - b).abs() / unit
    }

    #[test]
    fn sines_and_cosines_are_those_of_the_standard_library_to_the_last_digit() {
        for angle in angles() {
            let (sine, cosine) = angle.sin_cos();
            let turn = Turn::by(angle);
            assert!(units_apart(sine, turn.sine) <= 1.0, "{angle}: {turn:?}");
            assert!(units_apart(cosine, turn.cosine) <= 1.0, "{angle}: {turn:?}");
        }
        assert_eq!(Turn::by(0.0), Turn::NONE);
        assert!(Turn::by(f64::INFINITY).sine.is_nan());
        assert!(Turn::by(f64::NAN).cosine.is_nan());
    }

    #[test]
    fn every_instruction_set_and_every_lane_gives_the_same_bits() {
        for four in angles().chunks_exact(4) {
            let four: [f64; 4] = four.try_into().unwrap();
            let one_by_one = four.map(|angle| {
                let Turn { sine, cosine } = Turn::by(angle);
                [sine.to_bits(), cosine.to_bits()]
            });
            for found in with_each(|| Turns(four)) {
                let found = found.map(|turn| [turn.sine.to_bits(), turn.cosine.to_bits()]);
                assert_eq!(one_by_one, found, "{four:?}");
            }
        }
    }
}
