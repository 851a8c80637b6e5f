//! A small seeded generator.

use std::f64::consts::TAU;

use crate::motion::Pose;
use crate::point::Point;

/// The splitmix64 generator: the same seed gives the same numbers everywhere.
pub struct Random(u64);

impl Random {
    /// The generator that starts from `seed`.
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// A point in the cube of side `2 * half` about the origin.
    pub fn point(&mut self, half: f64) -> Point {
        std::array::from_fn(|_| self.within(-half, half))
    }

    /// A unit vector, uniform on the sphere.
    pub fn direction(&mut self) -> Point {
        let z = self.within(-1.0, 1.0);
        let angle = self.within(0.0, TAU);
        let r = (1.0 - z * z).sqrt();
        [r * angle.cos(), r * angle.sin(), z]
    }

    /// A rotation about a random axis by at least an eighth of a turn either way.
    pub fn rotation(&mut self) -> Pose {
        let axis = self.direction();
        Pose::rotation(axis, self.within(TAU / 8.0, TAU * 7.0 / 8.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_of_splitmix64() {
        let mut random = Random::new(1_234_567);
        assert_eq!(random.bits(), 6_457_827_717_110_365_317);
        assert_eq!(random.bits(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn numbers_stay_within_their_bounds() {
        let mut random = Random::new(7);
        for _ in 0..1000 {
            assert!((-2.0..3.0).contains(&random.within(-2.0, 3.0)));
        }
    }
}
