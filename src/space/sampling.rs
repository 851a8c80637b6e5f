//! Uniform sampling of configurations.

use std::f64::consts::TAU;

use smallvec::SmallVec;

use super::Space;
use crate::error::{Error, ErrorKind, Result};
use crate::robot::Coordinate;

/// A random number generator: SplitMix64 (Steele, Lea, Flood 2014). Equal states give equal streams, on every machine and
/// with every version of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler(pub u64);

impl Sampler {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A configuration, in memory of its own for most robots.
pub type Sample = SmallVec<[f64; 16]>;

impl Space {
    /// A configuration drawn uniformly from the coordinates' ranges: intervals by length, circles by angle, quaternions by
    /// the volume of SO(3) (Shoemake 1992). The world box is ignored. Refused where an interval is unbounded.
    pub fn sample(&self, sampler: &mut Sampler) -> Result<Sample> {
        let mut q = Sample::from_elem(0.0, self.nq());
        let mut advanced = *sampler;
        if let Some(i) = self.make_sample(&mut advanced, &mut q) {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "coordinate {i} has no bounds to sample between: give the space a range for it"
                ),
            ));
        }
        *sampler = advanced;
        Ok(q)
    }

    /// The same, but unbounded coordinates are copied from `beside`.
    pub fn sample_beside(&self, sampler: &mut Sampler, beside: &[f64]) -> Sample {
        let mut q = Sample::from_slice(beside);
        self.make_sample(sampler, &mut q);
        q
    }

    /// Draws all coordinates of q but those that are unbounded; returns the first of these.
    fn make_sample(&self, sampler: &mut Sampler, q: &mut [f64]) -> Option<usize> {
        let mut unbounded = None;
        for (i, (coordinate, x)) in self.coordinates().iter().zip(&mut *q).enumerate() {
            match *coordinate {
                Coordinate::Circle => *x = sampler.unit() * TAU,
                Coordinate::Interval { lower, upper } if (upper - lower).is_finite() => {
                    *x = (lower + (upper - lower) * sampler.unit()).clamp(lower, upper);
                }
                Coordinate::Interval { .. } => unbounded = unbounded.or(Some(i)),
                Coordinate::Quaternion => {}
            }
        }
        for at in self.quaternions() {
            let share = sampler.unit();
            let (small, large) = (share.sqrt(), (1.0 - share).sqrt());
            let (s, c) = (sampler.unit() * TAU).sin_cos();
            let (t, d) = (sampler.unit() * TAU).sin_cos();
            q[at..at + 4].copy_from_slice(&[large * s, large * c, small * t, small * d]);
        }
        unbounded
    }
}
