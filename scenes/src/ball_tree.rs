//! Distances between meshes, for placing them.

use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::{Point, cross, dot, minus, norm, plus, times, unit};

type Triangle = [Point; 3];

/// Triangles in a leaf, at most.
const LEAF: usize = 2;

/// The triangles of a mesh in a binary tree of bounding balls, each with a slab.
pub(crate) struct BallTree {
    triangles: Vec<Triangle>,
    /// Depth first, so that a node's first child comes right after it.
    nodes: Vec<Node>,
}

/// Of a ball and a slab around its triangles, both with the same centre.
struct Node {
    centre: Point,
    radius: f64,
    /// The normal of the slab, and half its thickness.
    normal: Point,
    half: f64,
    /// Its triangles are `triangles[first..end]`.
    first: usize,
    end: usize,
    /// The second child; 0 for a leaf.
    second: usize,
}

impl BallTree {
    /// The tree over the faces of `mesh`, cut into triangles from their first corners.
    pub(crate) fn new(mesh: &Mesh) -> BallTree {
        let corner = |v: u32| mesh.vertices[v as usize];
        let fan = |face: &Vec<u32>| -> Vec<Triangle> {
            face[1..]
                .windows(2)
                .map(|pair| [corner(face[0]), corner(pair[0]), corner(pair[1])])
                .collect()
        };
        let mut tree = BallTree {
            triangles: mesh.faces.iter().flat_map(fan).collect(),
            nodes: Vec::new(),
        };
        tree.grow(0, tree.triangles.len());
        tree
    }

    /// A ball around all of the mesh: centre and radius.
    pub(crate) fn ball(&self) -> (Point, f64) {
        (self.nodes[0].centre, self.nodes[0].radius)
    }

    /// The distance of the surface, moved by `pose`, from the surface of `other`; `limit` if that is less.
    pub(crate) fn distance(&self, pose: &Pose, other: &BallTree, limit: f64) -> f64 {
        let mut search = Search {
            moved: self,
            pose,
            other,
            least: limit,
        };
        if search.bound(0, 0) < limit {
            search.visit(0, 0);
        }
        search.least
    }

    /// Adds the node over `triangles[first..end]` and those below it.
    fn grow(&mut self, first: usize, end: usize) {
        let corners = || self.triangles[first..end].iter().flatten();
        let low = corners().fold([f64::INFINITY; 3], |m, p| least(m, *p));
        let high = corners().fold([f64::NEG_INFINITY; 3], |m, p| most(m, *p));
        let area = self.triangles[first..end]
            .iter()
            .fold([0.0; 3], |sum, t| plus(sum, area_vector(t)));
        let normal = match norm(area) > 0.0 {
            true => unit(area),
            false => [0.0, 0.0, 1.0],
        };
        let (bottom, top) = corners()
            .map(|p| dot(normal, *p))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(b, t), x| {
                (b.min(x), t.max(x))
            });
        let middle = times(0.5, plus(low, high));
        let lift = 0.5 * (bottom + top) - dot(normal, middle);
        let centre = plus(middle, times(lift, normal));
        let radius = corners().fold(0.0, |r, p| norm(minus(*p, centre)).max(r));
        let own = self.nodes.len();
        self.nodes.push(Node {
            centre,
            radius,
            normal,
            half: 0.5 * (top - bottom),
            first,
            end,
            second: 0,
        });
        if end - first > LEAF {
            let sides = minus(high, low);
            let axis = (0..3).fold(0, |k, i| if sides[i] > sides[k] { i } else { k });
            let key = |t: &Triangle| t[0][axis] + t[1][axis] + t[2][axis];
            let half = (end - first) / 2;
            self.triangles[first..end]
                .select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)));
            self.grow(first, first + half);
            self.nodes[own].second = self.nodes.len();
            self.grow(first + half, end);
        }
    }
}

impl Node {
    /// How far it goes from its centre in a direction that has this cosine with the normal.
    fn extent(&self, cosine: f64) -> f64 {
        // Never less than it is, however the cosine is rounded.
        let sine = (1.0 - cosine * cosine).max(1e-12).sqrt();
        (self.half * cosine.abs() + self.radius * sine).min(self.radius)
    }
}

/// The search for the least distance of two trees.
struct Search<'a> {
    moved: &'a BallTree,
    pose: &'a Pose,
    other: &'a BallTree,
    least: f64,
}

impl Search<'_> {
    /// A lower bound of the distance of two nodes.
    fn bound(&self, i: usize, j: usize) -> f64 {
        let (a, b) = (&self.moved.nodes[i], &self.other.nodes[j]);
        let apart = minus(self.pose.apply(a.centre), b.centre);
        let between = norm(apart);
        let balls = between - a.radius - b.radius;
        if balls >= self.least {
            return balls;
        }
        // How far the slabs and balls keep apart along some direction.
        let normal = minus(self.pose.apply(a.normal), self.pose.offset());
        let along =
            |w: Point| dot(apart, w).abs() - a.extent(dot(normal, w)) - b.extent(dot(b.normal, w));
        let discs = along(normal).max(along(b.normal)).max(balls);
        match between > 0.0 {
            true => discs.max(along(times(1.0 / between, apart))),
            false => discs,
        }
    }

    fn visit(&mut self, i: usize, j: usize) {
        let (a, b) = (&self.moved.nodes[i], &self.other.nodes[j]);
        if a.second == 0 && b.second == 0 {
            return self.compare(i, j);
        }
        let pairs = match b.second == 0 || (a.second != 0 && a.radius > b.radius) {
            true => [(i + 1, j), (a.second, j)],
            false => [(i, j + 1), (i, b.second)],
        };
        let mut bounded = pairs.map(|(i, j)| (self.bound(i, j), i, j));
        if bounded[1].0 < bounded[0].0 {
            bounded.swap(0, 1);
        }
        for (bound, i, j) in bounded {
            if bound < self.least {
                self.visit(i, j);
            }
        }
    }

    /// Compares the triangles of two leaves.
    fn compare(&mut self, i: usize, j: usize) {
        let (a, b) = (&self.moved.nodes[i], &self.other.nodes[j]);
        for triangle in &self.moved.triangles[a.first..a.end] {
            let moved = triangle.map(|p| self.pose.apply(p));
            for other in &self.other.triangles[b.first..b.end] {
                self.least = self.least.min(triangle_distance(&moved, other));
            }
        }
    }
}

fn least(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k].min(b[k]))
}

fn most(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k].max(b[k]))
}

/// Twice the area vector.
fn area_vector(t: &Triangle) -> Point {
    cross(minus(t[1], t[0]), minus(t[2], t[0]))
}

/// The edges of a triangle.
fn edges(t: &Triangle) -> [(Point, Point); 3] {
    [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]
}

/// The distance of two triangles with areas.
fn triangle_distance(a: &Triangle, b: &Triangle) -> f64 {
    let mut least = face_distance(a, b).min(face_distance(b, a));
    for (p, q) in edges(a) {
        for (r, s) in edges(b) {
            least = least.min(segment_distance(p, q, r, s));
        }
    }
    least
}

/// The least distance of the corners of `a` from the inside of `b`, as far as they are above or below it; 0 if an edge
/// of `a` passes through `b`.
fn face_distance(a: &Triangle, b: &Triangle) -> f64 {
    let normal = area_vector(b);
    let over = |p: Point| {
        edges(b)
            .iter()
            .all(|&(q, r)| dot(cross(minus(r, q), minus(p, q)), normal) >= 0.0)
    };
    let heights = a.map(|p| dot(normal, minus(p, b[0])) / norm(normal));
    let mut least = f64::INFINITY;
    for i in 0..3 {
        let (j, height) = ((i + 1) % 3, heights[i]);
        if height.abs() < least && over(a[i]) {
            least = height.abs();
        }
        if height * heights[j] < 0.0 {
            let share = height / (height - heights[j]);
            if over(plus(a[i], times(share, minus(a[j], a[i])))) {
                return 0.0;
            }
        }
    }
    least
}

/// The distance of the segments from `p` to `q` and from `r` to `s`, neither of them a point.
fn segment_distance(p: Point, q: Point, r: Point, s: Point) -> f64 {
    let (d, e, w) = (minus(q, p), minus(s, r), minus(p, r));
    let (dd, de, ee, dw, ew) = (dot(d, d), dot(d, e), dot(e, e), dot(d, w), dot(e, w));
    let determinant = dd * ee - de * de;
    let free = match determinant > 1e-14 * dd * ee {
        true => ((de * ew - ee * dw) / determinant).clamp(0.0, 1.0),
        false => 0.0,
    };
    let u = ((de * free + ew) / ee).clamp(0.0, 1.0);
    let t = ((de * u - dw) / dd).clamp(0.0, 1.0);
    norm(minus(plus(w, times(t, d)), times(u, e)))
}

/// Comes down from `start` to where `distance` is `gap`, up to 10⁻⁶ more, and returns the place.
///
/// `distance` must be at least `gap` at `start` and change by at most as much as its argument; then it stays so on the
/// way.
pub(crate) fn approach(start: f64, gap: f64, distance: impl Fn(f64) -> f64) -> f64 {
    let mut at = start;
    loop {
        let excess = distance(at) - gap;
        if excess <= 1e-6 {
            return at;
        }
        at -= excess;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bumpy_sphere::bumpy_sphere;
    use crate::prism::cuboid;

    fn moved_distance(a: &Mesh, offset: Point, b: &Mesh) -> f64 {
        let pose = Pose::translation(offset);
        BallTree::new(a).distance(&pose, &BallTree::new(b), f64::INFINITY)
    }

    #[test]
    fn boxes_are_as_far_apart_as_they_should() {
        let cube = cuboid([0.0; 3], [1.0; 3]);
        assert_eq!(moved_distance(&cube, [1.5, 0.2, -0.3], &cube), 0.5);
        assert_eq!(moved_distance(&cube, [4.0, 5.0, 0.0], &cube), 5.0);
        assert_eq!(moved_distance(&cube, [0.5, 0.2, 0.3], &cube), 0.0);
    }

    #[test]
    fn an_edge_over_an_edge() {
        let beam = cuboid([-1.0, -0.1, -0.1], [1.0, 0.1, 0.1]);
        let roll = Pose::rotation([1.0, 0.0, 0.0], std::f64::consts::FRAC_PI_4);
        let turn = Pose::rotation([0.0, 0.0, 1.0], 1.0);
        let (below, above) = (beam.moved(&roll), beam.moved(&turn.compose(&roll)));
        let found = moved_distance(&above, [0.0, 0.0, 0.5], &below);
        assert!((found - (0.5 - 0.2 * 2f64.sqrt())).abs() < 1e-15);
    }

    #[test]
    fn a_corner_over_a_face() {
        let cube = cuboid([0.0; 3], [1.0; 3]);
        let down = Pose::rotation([1.0, -1.0, 0.0], 2f64.sqrt().atan());
        // The cube stands on its corner at the origin now.
        let found = moved_distance(&cube.moved(&down), [0.5, 0.4, 1.25], &cube);
        assert!((found - 0.25).abs() < 1e-15, "{found}");
    }

    #[test]
    fn the_tree_changes_nothing() {
        let (a, b) = (bumpy_sphere(300, 1), bumpy_sphere(300, 2));
        let (trees, pose) = (
            (BallTree::new(&a), BallTree::new(&b)),
            Pose::translation([1.9, 1.0, 0.3]).compose(&Pose::rotation([1.0, 2.0, 0.5], 1.2)),
        );
        let mut least = f64::INFINITY;
        for s in &trees.0.triangles {
            for t in &trees.1.triangles {
                least = least.min(triangle_distance(&s.map(|p| pose.apply(p)), t));
            }
        }
        assert!(least > 0.0);
        assert_eq!(trees.0.distance(&pose, &trees.1, f64::INFINITY), least);
        assert_eq!(trees.0.distance(&pose, &trees.1, 0.5 * least), 0.5 * least);
    }

    #[test]
    fn approach_stops_at_the_gap() {
        // As on a slope: the distance is less than the height.
        let at = approach(3.0, 0.25, |x| 0.6 * (x - 1.0));
        assert!((0.25..0.25 + 1.001e-6).contains(&(0.6 * (at - 1.0))));
    }
}
