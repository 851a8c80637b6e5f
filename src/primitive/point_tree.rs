//! A tree over points, for support functions of hulls of thousands of vertices: a query takes logarithmic time.

use crate::gjk::{Extreme, Support};
use crate::pose::Vec3;
use crate::tolerance::EPSILON;

/// Points per leaf, at most; a leaf is scanned linearly.
const MAX_LEAF: usize = 32;

/// The rounding error of a bound, times its largest length: a few times three products and three sums.
const ROUNDING: f64 = 16.0 * EPSILON;

/// Points in a binary tree of slices of balls. A small piece of a hull's surface is flat, and so is its slice: along its normal
/// the slice bounds the piece to second order, where a box or a ball would only to first.
pub struct PointTree<'a> {
    points: &'a [Vec3],
    /// The indices of the points; those of each node are contiguous.
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// All points within `radius` of `center` whose offset from it along `normal` is within `slice`.
struct Node {
    center: Vec3,
    radius: f64,
    normal: Vec3,
    slice: [f64; 2],
    /// Its points in `order`.
    first: usize,
    end: usize,
    /// The second child; the first is the next node. `None` for leaves.
    second: Option<usize>,
}

/// The best point so far, and its projection on the direction of the query.
#[derive(Clone, Copy)]
struct Best {
    value: f64,
    point: u32,
    /// The number of points visited.
    looked_at: usize,
}

impl<'a> PointTree<'a> {
    /// Takes n log n time. `points` must not be empty.
    pub fn new(points: &'a [Vec3]) -> Self {
        let mut tree = Self {
            points,
            order: (0..points.len() as u32).collect(),
            nodes: Vec::new(),
        };
        tree.add_node(0, points.len());
        tree
    }

    /// The maximum of `direction . (p - origin)` over all points p, and the first point that attains it.
    pub fn farthest(&self, direction: &Vec3, origin: &Vec3) -> (f64, u32) {
        let best = self.best(direction, origin);
        (best.value, best.point)
    }

    fn best(&self, direction: &Vec3, origin: &Vec3) -> Best {
        let mut best = Best {
            value: f64::NEG_INFINITY,
            point: self.order[0],
            looked_at: 0,
        };
        self.search(0, f64::INFINITY, direction, origin, &mut best);
        best
    }

    fn search(&self, index: usize, bound: f64, direction: &Vec3, origin: &Vec3, best: &mut Best) {
        if bound < best.value {
            return;
        }
        let node = &self.nodes[index];
        let Some(second) = node.second else {
            for &point in &self.order[node.first..node.end] {
                let value = direction.dot(&(self.points[point as usize] - origin));
                if value > best.value || (value == best.value && point < best.point) {
                    (best.value, best.point) = (value, point);
                }
            }
            best.looked_at += node.end - node.first;
            return;
        };
        let children = [index + 1, second].map(|c| (c, self.bound(c, direction, origin)));
        let [near, far] = if children[0].1 >= children[1].1 {
            children
        } else {
            [children[1], children[0]]
        };
        for (child, bound) in [near, far] {
            self.search(child, bound, direction, origin, best);
        }
    }

    /// An upper bound of the projection of the node's points on the direction.
    fn bound(&self, index: usize, direction: &Vec3, origin: &Vec3) -> f64 {
        let node = &self.nodes[index];
        let offset = node.center - origin;
        let along = direction.dot(&node.normal);
        let across = (direction - node.normal * along).norm();
        let [low, high] = node.slice;
        let beyond = (along * low).max(along * high) + across * node.radius;
        let largest = node.center.norm() + origin.norm() + node.radius;
        direction.dot(&offset) + beyond + ROUNDING * direction.norm() * largest
    }

    /// Builds the subtree of a range of points. Returns the index of its root.
    fn add_node(&mut self, first: usize, end: usize) -> usize {
        let points = self.points;
        let at = |i: &u32| &points[*i as usize];
        let run = &mut self.order[first..end];
        let start = *at(&run[0]);
        let low = run.iter().fold(start, |low, i| low.inf(at(i)));
        let high = run.iter().fold(start, |high, i| high.sup(at(i)));
        let center = low * 0.5 + high * 0.5;
        let normal = normal_of(run.iter().map(at));
        let (mut radius, mut slice) = (0.0f64, [0.0f64; 2]);
        for point in run.iter().map(at) {
            let offset = point - center;
            let along = normal.dot(&offset);
            radius = radius.max(offset.norm());
            slice = [slice[0].min(along), slice[1].max(along)];
        }
        let index = self.nodes.len();
        let node = Node {
            center,
            radius,
            normal,
            slice,
            first,
            end,
            second: None,
        };
        if end - first <= MAX_LEAF {
            self.nodes.push(node);
            return index;
        }
        let axis = (high - low).imax();
        let middle = (end - first) / 2;
        run.select_nth_unstable_by(middle, |i, j| at(i)[axis].total_cmp(&at(j)[axis]));
        self.nodes.push(node);
        self.add_node(first, first + middle);
        self.nodes[index].second = Some(self.add_node(first + middle, end));
        index
    }
}

impl Support for PointTree<'_> {
    fn extreme(&self, direction: &Vec3) -> Extreme {
        let (_, point) = self.farthest(direction, &Vec3::zeros());
        Extreme {
            point: self.points[point as usize],
            name: point,
        }
    }
}

/// The normal of a large triangle of the points; the z axis if they are collinear.
fn normal_of<'a>(points: impl Iterator<Item = &'a Vec3> + Clone) -> Vec3 {
    let farthest = |measure: &dyn Fn(&Vec3) -> f64| {
        let measured = points.clone().map(|p| (measure(p), p));
        measured.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, p)| *p)
    };
    let corners = || {
        let start = points.clone().next()?;
        let first = farthest(&|p| (p - start).norm_squared())?;
        let second = farthest(&|p| (p - first).norm_squared())?;
        let along = (second - first).try_normalize(0.0)?;
        let third = farthest(&|p| along.cross(&(p - first)).norm_squared())?;
        along.cross(&(third - first)).try_normalize(0.0)
    };
    corners().unwrap_or_else(Vec3::z)
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;
    use crate::gjk::PointCloud;

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(0.5))
    }

    /// On a sphere all points are corners of their hull; a query still visits only a few leaves for any number of points.
    #[test]
    fn few_points_are_looked_at() {
        for count in [1000, 10_000, 100_000] {
            let random = &mut Random::new(3);
            let mut unit = || vector(random).normalize();
            let points: Vec<Vec3> = (0..count).map(|_| unit()).collect();
            let tree = PointTree::new(&points);
            let asked = 200;
            let looked_at: usize = (0..asked)
                .map(|_| tree.best(&unit(), &Vec3::zeros()).looked_at)
                .sum();
            assert!(looked_at <= 20 * MAX_LEAF * asked, "{count}: {looked_at}");
        }
    }

    /// Against a linear scan: the same point bit for bit, and of equal ones the first.
    #[test]
    fn the_farthest_point_is_that_of_all_points() {
        let random = &mut Random::new(7);
        for (count, size, away) in [
            (1, 1.0, 0.0),
            (33, 1e-9, 1e3),
            (500, 1.0, 0.0),
            (3000, 1e6, 1e9),
        ] {
            for shape in 0..4 {
                let points: Vec<Vec3> = (0..count)
                    .map(|_| {
                        let mut p = vector(random);
                        match shape {
                            0 => p = p.try_normalize(0.0).unwrap_or_default(),
                            1 => p.z = 0.0,
                            // Many are equal, and many are level.
                            2 => p = p.map(|x| (4.0 * x).round()),
                            _ => {}
                        }
                        p * size + Vec3::repeat(away)
                    })
                    .collect();
                let tree = PointTree::new(&points);
                for k in 0..60 {
                    let mut direction = vector(random);
                    if k < 3 {
                        direction = Vec3::ith(k, -1.0);
                    }
                    let plain = PointCloud(&points).support(&direction);
                    assert_eq!(tree.support(&direction), plain);
                    let origin = points[k % count];
                    let (value, point) = tree.farthest(&direction, &origin);
                    let values = points.iter().map(|p| direction.dot(&(p - origin)));
                    let (first, most) = values
                        .enumerate()
                        .reduce(|best, next| if next.1 > best.1 { next } else { best })
                        .unwrap();
                    assert_eq!((value, point as usize), (most, first));
                }
            }
        }
    }
}
