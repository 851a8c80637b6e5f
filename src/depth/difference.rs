//! Convex sets of translations at which two bodies meet, and half-spaces that cover what is beyond them.

use crate::convex::HalfSpace;
use crate::pose::Vec3;

/// A convex set of translations at which two bodies meet.
pub enum Difference {
    /// What is in none of these half-spaces: the difference of two polytopes.
    Polytope(Vec<HalfSpace>),
    /// A set with a curved boundary.
    Round(RoundDifference),
}

/// A convex set with a curved boundary, known by the points where rays from its middle leave it. All space is parted into
/// cones of such rays. What is beyond the set within a cone is beyond the triangle of the points on its edges, because the
/// simplex of the triangle and the middle belongs to the set. A cone is parted where that is too little.
pub struct RoundDifference {
    pub middle: Vec3,
    pub shape: RoundShape,
    pub cones: Vec<Cone>,
    is_planar: bool,
}

/// What a round set is the difference of.
#[derive(Clone, Copy)]
pub enum RoundShape {
    /// A ball around the middle.
    Ball(f64),
    /// The primitives at two places.
    Primitives([u32; 2]),
}

/// The rays between three, in the plane two, boundary points.
#[derive(Clone, Copy)]
pub struct Cone {
    corners: [Vec3; 3],
    /// The first of the cones that it was parted into, which follow each other.
    parts: Option<u32>,
}

/// The number of cones around the middle.
const ROOTS: [usize; 2] = [8, 4];

impl RoundDifference {
    /// The set with its cones around the axes. `boundary` finds the point of the set, next to its boundary, on a ray from the
    /// middle.
    pub fn new(
        middle: Vec3,
        shape: RoundShape,
        is_planar: bool,
        mut boundary: impl FnMut(&Vec3) -> Vec3,
    ) -> Self {
        let axes = [0, 1, 2].map(|k| {
            let mut axis = Vec3::zeros();
            axis[k] = 1.0;
            match is_planar && k == 2 {
                true => [middle; 2],
                false => [boundary(&axis), boundary(&-axis)],
            }
        });
        let count = ROOTS[usize::from(is_planar)];
        let cone = |i: usize| Cone {
            corners: [0, 1, 2].map(|k| axes[k][i >> k & 1]),
            parts: None,
        };
        Self {
            middle,
            shape,
            cones: (0..count).map(cone).collect(),
            is_planar,
        }
    }

    /// The cones around the middle.
    pub fn roots(&self) -> std::ops::Range<u32> {
        0..ROOTS[usize::from(self.is_planar)] as u32
    }

    /// The cones that a cone is parted into: along the middles of its triangle's sides.
    pub fn parts(
        &mut self,
        cone: u32,
        mut boundary: impl FnMut(&Vec3) -> Vec3,
    ) -> std::ops::Range<u32> {
        let count = if self.is_planar { 2 } else { 4 };
        let Cone { corners, parts } = self.cones[cone as usize];
        if let Some(first) = parts {
            return first..first + count;
        }
        let first = self.cones.len() as u32;
        self.cones[cone as usize].parts = Some(first);
        let [a, b, c] = corners;
        let mut between = |p: &Vec3, q: &Vec3| boundary(&(0.5 * (p + q) - self.middle));
        let ab = between(&a, &b);
        let triangles = if self.is_planar {
            vec![[a, ab, c], [ab, b, c]]
        } else {
            let (bc, ca) = (between(&b, &c), between(&c, &a));
            vec![[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        let cones = triangles.into_iter().map(|corners| Cone {
            corners,
            parts: None,
        });
        self.cones.extend(cones);
        first..first + count
    }

    /// The half-spaces whose intersection holds all that is in a cone and not in the set. `error` is how far a corner may be
    /// outside the set.
    pub fn half_spaces(&self, cone: u32, error: f64) -> Vec<HalfSpace> {
        let [a, b, c] = self.cones[cone as usize].corners;
        let (across, sides) = if self.is_planar {
            let upright = Vec3::z();
            let along = b - a;
            (
                along.cross(&upright),
                vec![(a, upright, b), (b, upright, a)],
            )
        } else {
            (
                (b - a).cross(&(c - a)),
                vec![(a, b, c), (b, c, a), (c, a, b)],
            )
        };
        let mut found = Vec::with_capacity(sides.len() + 1);
        let mut add = |normal: Vec3, inner: &Vec3, point: &Vec3| {
            let Some(normal) = normal.try_normalize(0.0) else {
                return;
            };
            let side = normal.dot(&(inner - point));
            let normal = if side < 0.0 { -normal } else { normal };
            found.push(HalfSpace {
                normal,
                offset: normal.dot(point) - error,
            });
        };
        // Beyond the triangle: the middle is on its other side.
        add(across, &(2.0 * a - self.middle), &a);
        let middle = self.middle;
        for (p, q, inside) in sides {
            let q = if self.is_planar { q } else { q - middle };
            add((p - middle).cross(&q), &inside, &middle);
        }
        found
    }
}
