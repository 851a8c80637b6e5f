//! Decides which objects are in the tree and which are strays. The tree's boxes share one scale in single precision, so an
//! object that is very far away, or has a very large error, would loosen the bounds of all others.

use super::places::Places;
use crate::body_bounds::{Bounds, slack};
use crate::pair::ROUNDING;
use crate::pose::Vec3;

/// An object this many times farther out than most is a stray. At this limit the slack of all bounds is about 1/64 of the
/// distance of most objects from the centre.
pub const FAR: f64 = 1024.0;

/// The tree takes objects within `range` of `center` whose bounds have at most `max_slack`.
#[derive(Clone, Copy, Debug, Default)]
pub struct TreeLimits {
    center: Vec3,
    range: f64,
    max_slack: f64,
}

impl TreeLimits {
    /// The limits for a tree over the objects in the world. Each limit is kept by 15 of 16 objects, and by others that are not [`FAR`] times
    /// farther out or twice as inaccurate.
    pub fn of(all: &Places) -> Self {
        let in_world = || all.iter().filter(|place| place.is_in_world());
        let count = in_world().count();
        if count == 0 {
            return Self::default();
        }
        let nth = |value: &dyn Fn(&Bounds) -> f64, n: usize| {
            let mut values: Vec<f64> = in_world().map(|place| value(&place.bounds)).collect();
            *values.select_nth_unstable_by(n, f64::total_cmp).1
        };
        let rank = count * 15 / 16;
        let center = Vec3::from_fn(|k, _| nth(&|bounds| bounds.box_center[k], count / 2));
        let near = nth(&|bounds| farthest(bounds, &center), rank);
        Self::around(
            center,
            0.5 * FAR * near,
            nth(
                &|bounds| slack(bounds.largest_coordinate, bounds.deviation),
                rank,
            ),
        )
    }

    /// The limits for objects added to a tree: twice its radius around its centre, and twice its slack.
    pub fn around(center: Vec3, radius: f64, slack: f64) -> Self {
        let range = 2.0 * radius;
        Self {
            center,
            range,
            max_slack: (ROUNDING * range).max(2.0 * slack),
        }
    }

    /// The centre and the range.
    pub fn ball(&self) -> (Vec3, f64) {
        (self.center, self.range)
    }

    pub fn hold(&self, bounds: &Bounds) -> bool {
        let slack = slack(bounds.largest_coordinate, bounds.deviation);
        farthest(bounds, &self.center) <= self.range && slack <= self.max_slack
    }
}

/// An upper bound of the distance of the box's corners from a point.
fn farthest(bounds: &Bounds, from: &Vec3) -> f64 {
    (bounds.box_center - from).norm() + bounds.box_radius
}
