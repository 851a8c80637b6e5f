//! Proof that two primitives are farther apart than a cutoff.

use crate::pose::Vec3;

/// What proves two primitives, or their cores, to be farther apart than a cutoff.
#[derive(Clone, Copy, Debug)]
pub struct Beyond {
    /// The unit direction from B to A along which they are apart; zero where it is not known.
    pub direction: Vec3,
    /// How far apart the cores are along it.
    pub gap: f64,
}

impl Beyond {
    /// Along a direction that is not known.
    pub const SOMEHOW: Self = Self {
        direction: Vec3::new(0.0, 0.0, 0.0),
        gap: f64::INFINITY,
    };

    /// Along a direction of any length; zero if it is not known. `lowest` is the lowest point of A - B along it.
    pub fn along(direction: &Vec3, lowest: &Vec3) -> Self {
        match direction.try_normalize(0.0) {
            Some(direction) => Self {
                direction,
                gap: direction.dot(lowest),
            },
            None => Self::SOMEHOW,
        }
    }
}
