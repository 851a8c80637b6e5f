//! Seeded random numbers: SplitMix64, so that every run sees the same cases.

use cstk::pose::{Mat3, Pose, Vec3, rotation_about};

pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn next_bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next_bits() % n as u64) as usize
    }

    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next_bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// A point of the cube of half-width `half`.
    pub fn point(&mut self, half: f64) -> Vec3 {
        Vec3::from_fn(|_, _| self.within(-half, half))
    }

    pub fn points(&mut self, n: usize, half: f64) -> Vec<Vec3> {
        (0..n).map(|_| self.point(half)).collect()
    }

    pub fn unit(&mut self) -> Vec3 {
        loop {
            let v = self.point(1.0);
            if v.norm() > 0.1 && v.norm() < 1.0 {
                return v.normalize();
            }
        }
    }

    pub fn rotation(&mut self) -> Mat3 {
        let axis = self.unit();
        rotation_about(&axis, self.within(-3.0, 3.0))
    }

    pub fn pose(&mut self, half: f64) -> Pose {
        Pose {
            rotation: self.rotation(),
            translation: self.point(half),
        }
    }

    /// A pose of the plane z = 0.
    pub fn planar_pose(&mut self, half: f64) -> Pose {
        Pose {
            rotation: rotation_about(&Vec3::z(), self.within(-3.0, 3.0)),
            translation: Vec3::new(self.within(-half, half), self.within(-half, half), 0.0),
        }
    }

    /// A convex polygon of the plane: points of a stretched circle in the order of their angles.
    pub fn polygon(&mut self, corners: usize, radius: f64) -> Vec<Vec3> {
        let turn = self.within(0.0, 1.0);
        let (a, b) = (self.within(0.6, 1.0), self.within(0.6, 1.0));
        (0..corners)
            .map(|i| {
                let share = (i as f64 + turn + self.within(-0.3, 0.3)) / corners as f64;
                let (sin, cos) = (share * std::f64::consts::TAU).sin_cos();
                Vec3::new(a * cos, b * sin, 0.0) * radius
            })
            .collect()
    }
}
