//! Which objects a tree takes. Its boxes are in single precision, for all of it alike: one that is very far away, or known
//! very badly, would blur all others.

use super::bounds::{Bounds, slack};
use super::snapshot::Places;
use crate::pair::ROUNDING;
use crate::pose::Vec3;

/// So many times farther than most, an object is not taken: the blur of all becomes a hundredth of where most are.
pub const FAR: f64 = 1024.0;

/// Objects are taken that are within a range of a centre, and whose bounds are not blurred more than by that range.
#[derive(Clone, Copy, Debug, Default)]
pub struct TreeLimits {
    center: Vec3,
    range: f64,
    blur: f64,
}

impl TreeLimits {
    /// Those for a tree over some objects: 15 of 16 are within, and others if they are not very far from those.
    pub fn of(all: &Places) -> Self {
        if all.len() == 0 {
            return Self::default();
        }
        let nth = |value: &dyn Fn(&Bounds) -> f64, n: usize| {
            let mut values: Vec<f64> = all.iter().map(|place| value(&place.bounds)).collect();
            *values.select_nth_unstable_by(n, f64::total_cmp).1
        };
        let most = all.len() * 15 / 16;
        let center = Vec3::from_fn(|k, _| nth(&|bounds| bounds.box_center[k], all.len() / 2));
        let near = nth(&|bounds| farthest(bounds, &center), most);
        Self::around(
            center,
            0.5 * FAR * near,
            nth(
                &|bounds| slack(bounds.largest_coordinate, bounds.deviation),
                most,
            ),
        )
    }

    /// Those for objects that come to a tree, given how far from its centre it goes, and its blur: twice as much.
    pub fn around(center: Vec3, radius: f64, blur: f64) -> Self {
        let range = 2.0 * radius;
        Self {
            center,
            range,
            blur: (ROUNDING * range).max(2.0 * blur),
        }
    }

    /// What is taken is within a range of a centre.
    pub fn ball(&self) -> (Vec3, f64) {
        (self.center, self.range)
    }

    pub fn hold(&self, bounds: &Bounds) -> bool {
        let blur = slack(bounds.largest_coordinate, bounds.deviation);
        farthest(bounds, &self.center) <= self.range && blur <= self.blur
    }
}

/// No corner of the box is farther from a point.
fn farthest(bounds: &Bounds, from: &Vec3) -> f64 {
    (bounds.box_center - from).norm() + bounds.box_radius
}
