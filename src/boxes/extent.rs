//! Axis-aligned boxes: the p-set wrappers of the grouping phase (§3.2.1).

use crate::pose::Vec3;

/// The axis-aligned box of a set of points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    pub low: Vec3,
    pub high: Vec3,
}

impl Extent {
    /// The box of at least one point.
    pub fn of(points: &[Vec3]) -> Self {
        Self::of_points(points.iter().copied())
    }

    /// The same for an iterator.
    pub fn of_points(points: impl Iterator<Item = Vec3>) -> Self {
        let boxes = points.map(|point| Self {
            low: point,
            high: point,
        });
        let whole = boxes.reduce(|all, point| all.union(&point));
        whole.expect("a box is around at least one point")
    }

    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    pub fn contains(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k])
    }

    /// The eight corners; bit k of a corner's index says whether it is high along axis k.
    pub fn corners(&self) -> [Vec3; 8] {
        let pick = |i: usize, axis: usize| [self.low, self.high][i >> axis & 1][axis];
        std::array::from_fn(|i| Vec3::new(pick(i, 0), pick(i, 1), pick(i, 2)))
    }

    pub fn center(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    pub fn size(&self) -> Vec3 {
        self.high - self.low
    }

    pub fn diameter(&self) -> f64 {
        self.size().norm()
    }

    /// Half the area of the box's surface.
    pub fn half_surface(&self) -> f64 {
        let s = self.size();
        s.x * s.y + s.y * s.z + s.z * s.x
    }

    /// The L∞ gap between two boxes; 0 when they meet.
    pub fn gap(&self, other: &Self) -> f64 {
        let apart = (other.low - self.high).sup(&(self.low - other.high));
        apart.max().max(0.0)
    }

    /// The L∞ distance of a point from the box; 0 inside.
    pub fn outside(&self, point: &Vec3) -> f64 {
        let beyond = (self.low - point).sup(&(point - self.high));
        beyond.max().max(0.0)
    }
}
