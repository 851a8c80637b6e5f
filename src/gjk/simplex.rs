//! The point of a simplex closest to the origin.

use super::Extreme;
use crate::pose::Vec3;
use crate::tolerance;

/// A point of a Minkowski difference A - B, and its point of A.
#[derive(Clone, Copy)]
pub struct Corner {
    pub difference: Vec3,
    pub on_a: Vec3,
    /// The names of its points of A and of B.
    pub names: [u32; 2],
}

impl Corner {
    const ORIGIN: Self = Self {
        difference: Vec3::new(0.0, 0.0, 0.0),
        on_a: Vec3::new(0.0, 0.0, 0.0),
        names: [0; 2],
    };

    #[inline(always)]
    pub fn between(on_a: Extreme, on_b: Extreme) -> Self {
        Self {
            difference: on_a.point - on_b.point,
            on_a: on_a.point,
            names: [on_a.name, on_b.name],
        }
    }
}

/// The closest points found of two sets, and the names of the extreme points they lie between.
#[derive(Clone, Copy, Debug)]
pub struct NearestCorners {
    /// A point of A and one of B.
    pub points: [Vec3; 2],
    /// The vector from B's point to A's.
    pub difference: Vec3,
    pub names: [Names; 2],
}

/// The distinct names of one to three extreme points of a set.
#[derive(Clone, Copy, Debug)]
pub struct Names {
    names: [u32; 3],
    len: usize,
}

impl Names {
    #[inline(always)]
    pub fn one(name: u32) -> Self {
        Self {
            names: [name; 3],
            len: 1,
        }
    }

    /// Two names that differ.
    #[inline(always)]
    pub fn two(one: u32, other: u32) -> Self {
        Self {
            names: [one, other, other],
            len: 2,
        }
    }

    /// Three names that differ.
    #[inline(always)]
    pub fn three(names: [u32; 3]) -> Self {
        Self { names, len: 3 }
    }

    /// The distinct ones of up to three names, at least one.
    #[inline(always)]
    fn distinct(all: &[u32]) -> Self {
        let mut found = Self::one(all[0]);
        for name in &all[1..] {
            if !found.as_slice().contains(name) {
                found.names[found.len] = *name;
                found.len += 1;
            }
        }
        found
    }

    #[inline(always)]
    pub fn as_slice(&self) -> &[u32] {
        &self.names[..self.len]
    }
}

/// A triangle of the difference that the origin is nearly on.
#[derive(Clone, Copy, Debug)]
pub struct NearTriangle {
    /// The unit direction across it, of either sign.
    pub direction: Vec3,
    /// The names of its corners, on A and on B.
    pub names: [Names; 2],
}

/// Up to four corners, reduced in step with the search.
#[derive(Clone, Copy)]
pub struct Simplex {
    corners: [Corner; 4],
    len: usize,
}

/// Where the origin lies relative to a simplex.
pub enum OriginPosition {
    /// Outside, with the closest point of the simplex.
    Outside(Vec3),
    /// Inside a tetrahedron, at least `margin` from its faces. The corners combine to `at`, which is the origin up to rounding.
    /// If it is far from the origin, the tetrahedron is flat and rounding decided the sides.
    Inside { margin: f64, at: Corner },
}

impl Simplex {
    #[inline(always)]
    pub fn empty() -> Self {
        Self {
            corners: [Corner::ORIGIN; 4],
            len: 0,
        }
    }

    #[inline(always)]
    pub fn contains(&self, difference: &Vec3) -> bool {
        self.corners[..self.len]
            .iter()
            .any(|corner| corner.difference == *difference)
    }

    #[inline(always)]
    pub fn push(&mut self, corner: Corner) {
        self.corners[self.len] = corner;
        self.len += 1;
    }

    /// The largest squared norm of its corners.
    #[inline(always)]
    pub fn largest_square(&self) -> f64 {
        let squares = self.corners[..self.len].iter();
        squares.fold(0.0, |most, corner| {
            corner.difference.norm_squared().max(most)
        })
    }

    #[inline(always)]
    pub fn is_full(&self) -> bool {
        self.len == 4
    }

    /// The closest point to the origin; the simplex shrinks to the face that holds it.
    #[inline(always)]
    pub fn reduce(&mut self) -> OriginPosition {
        let (point, kept) = match self.len {
            1 | 2 => self.on_few(),
            3 => self.on_triangle(0, 1, 2),
            _ => match self.on_tetrahedron() {
                Ok(found) => found,
                Err(inside) => return inside,
            },
        };
        self.keep(&kept);
        OriginPosition::Outside(point)
    }

    /// The closest point to the origin of a simplex known not to contain it, as a combination of its corners. Of a tetrahedron
    /// each face is tried that the origin does not clearly lie behind: where the corners are nearly coplanar, rounding decides on
    /// which side it is.
    ///
    /// Also returns the foot, whose direction is the triangle's normal and therefore more accurate.
    #[inline(always)]
    pub fn nearest_apart(&mut self) -> (Corner, Vec3) {
        let faces: &[[usize; 3]] = match self.len {
            // Faces with the newest corner first: the closest point moves to one of them.
            4 => &[[0, 3, 1], [0, 2, 3], [1, 3, 2], [0, 1, 2]],
            3 => &[[0, 1, 2]],
            _ => {
                let (foot, kept) = self.on_few();
                return self.reduced_to((self.combined_of(&kept, &foot), foot, kept));
            }
        };
        let mut least = f64::INFINITY;
        let mut best = None;
        for &[i, j, k] in faces {
            if self.len == 4 && self.hides_origin([i, j, k]) {
                continue;
            }
            let (foot, kept) = self.on_triangle(i, j, k);
            // No combination is nearer to the origin than the foot.
            if foot.norm_squared() > (1.0 + 1e-9) * least {
                continue;
            }
            let corner = self.combined_of(&kept, &foot);
            let reached = corner.difference.norm_squared();
            if best.is_none() || reached < least {
                least = reached;
                best = Some((corner, foot, kept));
            }
        }
        match best {
            Some(best) => self.reduced_to(best),
            None => (self.corners[0], self.corners[0].difference),
        }
    }

    /// Whether the origin clearly lies behind a face of a tetrahedron, as the fourth corner does.
    #[inline(always)]
    fn hides_origin(&self, [i, j, k]: [usize; 3]) -> bool {
        let a = self.at(i);
        let normal = (self.at(j) - a).cross(&(self.at(k) - a));
        let towards = self.at(6 - i - j - k) - a;
        let (origin, fourth) = (-normal.dot(&a), normal.dot(&towards));
        let doubt = CLEARLY_BEHIND * normal.norm_squared();
        origin * fourth > 0.0
            && origin * origin > doubt * a.norm_squared()
            && fourth * fourth > doubt * towards.norm_squared()
    }

    /// Reduces the simplex to a face, and returns the combined corner and the foot on the face.
    #[inline(always)]
    fn reduced_to(&mut self, (corner, foot, kept): (Corner, Vec3, ClosestFace)) -> (Corner, Vec3) {
        self.keep(&kept);
        (corner, self.upright(&foot))
    }

    #[inline(always)]
    fn keep(&mut self, kept: &ClosestFace) {
        let corners = self.corners;
        for (to, &from) in kept.corners[..kept.len].iter().enumerate() {
            self.corners[to] = corners[from];
        }
        self.len = kept.len;
    }

    /// The closest point of a simplex of one or two corners.
    #[inline(always)]
    fn on_few(&self) -> (Vec3, ClosestFace) {
        match self.len {
            1 => (self.corners[0].difference, ClosestFace::new([0])),
            _ => self.on_segment(0, 1),
        }
    }

    /// Removes from the foot on a segment its component along the segment. That component is rounding: it hardly moves the
    /// foot, but turns its direction where the origin is near.
    fn upright(&self, foot: &Vec3) -> Vec3 {
        if self.len != 2 {
            return *foot;
        }
        let along = self.at(1) - self.at(0);
        foot - along * (foot.dot(&along) / along.norm_squared())
    }

    /// The combination of one to three corners at the closest point that `reduce` returned last. The weights are clamped to be
    /// at least 0, in spite of rounding in that point.
    pub fn combined(&self, point: &Vec3) -> Corner {
        let all = ClosestFace {
            corners: [0, 1, 2],
            len: self.len,
        };
        self.combined_of(&all, point)
    }

    /// The same with the names of the corners; `None` for a simplex of no corners or of four.
    pub fn nearest(&self, point: &Vec3) -> Option<NearestCorners> {
        let names = self.names()?;
        let corner = self.combined(point);
        Some(NearestCorners {
            points: [corner.on_a, corner.on_a - corner.difference],
            difference: corner.difference,
            names,
        })
    }

    /// The names of one to three corners, on A and on B.
    pub fn names(&self) -> Option<[Names; 2]> {
        let names = |side: usize| [0, 1, 2].map(|i| self.corners[i].names[side]);
        (1..=3)
            .contains(&self.len)
            .then(|| [0, 1].map(|side| Names::distinct(&names(side)[..self.len])))
    }

    #[inline(always)]
    fn combined_of(&self, kept: &ClosestFace, point: &Vec3) -> Corner {
        let [first, second, third] = kept.corners.map(|i| self.corners[i]);
        let towards = |from: Corner, to: Corner, t: f64| Corner {
            difference: from.difference + (to.difference - from.difference) * t,
            on_a: from.on_a + (to.on_a - from.on_a) * t,
            names: from.names,
        };
        let (a, b, c) = (first.difference, second.difference, third.difference);
        let ab = b - a;
        match kept.len {
            1 => first,
            2 => {
                let t = (point - a).dot(&ab) / ab.norm_squared();
                towards(first, second, t.clamp(0.0, 1.0))
            }
            _ => {
                let (ac, ap) = (c - a, point - a);
                let normal = ab.cross(&ac);
                let square = normal.norm_squared();
                let s = (ap.cross(&ac).dot(&normal) / square).clamp(0.0, 1.0);
                let t = (ab.cross(&ap).dot(&normal) / square).clamp(0.0, 1.0);
                let both = s + t;
                if both <= 0.0 {
                    return first;
                }
                towards(first, towards(second, third, t / both), both.min(1.0))
            }
        }
    }

    #[inline(always)]
    fn at(&self, i: usize) -> Vec3 {
        self.corners[i].difference
    }

    #[inline(always)]
    fn on_segment(&self, i: usize, j: usize) -> (Vec3, ClosestFace) {
        let (a, b) = (self.at(i), self.at(j));
        let ab = b - a;
        let t = -a.dot(&ab);
        let square = ab.norm_squared();
        if t <= 0.0 {
            (a, ClosestFace::new([i]))
        } else if t >= square {
            (b, ClosestFace::new([j]))
        } else {
            (a + ab * (t / square), ClosestFace::new([i, j]))
        }
    }

    #[inline(always)]
    fn on_triangle(&self, i: usize, j: usize, k: usize) -> (Vec3, ClosestFace) {
        let (a, b, c) = (self.at(i), self.at(j), self.at(k));
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(&ac);
        let square = normal.norm_squared();
        let rounding = (64.0 * tolerance::EPSILON).powi(2);
        let is_needle = square <= rounding * ab.norm_squared() * ac.norm_squared();
        // For each edge, twice the signed area of its triangle with the origin's foot, times |normal|. It is computed from the
        // vector along the edge, whose error is small where the corners are close.
        let weight = |p: Vec3, q: Vec3| normal.dot(&(p - q).cross(&p));
        let weights = [weight(b, c), weight(c, a), weight(a, b)];
        if square > 0.0 && weights.iter().all(|weight| *weight > 0.0) {
            return (
                normal * (a.dot(&normal) / square),
                ClosestFace::new([i, j, k]),
            );
        }
        // The foot is beyond the nearest edge. For a needle, whose normal is unreliable, all edges are tried.
        let mut best: Option<(Vec3, ClosestFace)> = None;
        for (weight, (from, to)) in weights.iter().zip([(j, k), (k, i), (i, j)]) {
            if *weight > 0.0 && !is_needle {
                continue;
            }
            let found = self.on_segment(from, to);
            if best
                .as_ref()
                .is_none_or(|(least, _)| found.0.norm_squared() < least.norm_squared())
            {
                best = Some(found);
            }
        }
        best.unwrap_or_else(|| self.on_segment(i, j))
    }

    /// The nearest face, or `Err` with [`OriginPosition::Inside`].
    #[inline(always)]
    fn on_tetrahedron(&self) -> Result<(Vec3, ClosestFace), OriginPosition> {
        let mut weights = [0.0; 4];
        let mut heights = [(0.0, 0.0); 4];
        let mut best: Option<(Vec3, ClosestFace)> = None;
        for [i, j, k] in FACES {
            let opposite = 6 - i - j - k;
            let a = self.at(i);
            let normal = (self.at(j) - a).cross(&(self.at(k) - a));
            let towards = normal.dot(&(self.at(opposite) - a));
            let origin = -normal.dot(&a);
            // A flat tetrahedron has no inside: the origin is then outside each face.
            if towards * origin > 0.0 {
                heights[opposite] = (origin, normal.norm_squared());
                weights[opposite] = origin / towards;
                continue;
            }
            let found = self.on_triangle(i, j, k);
            if best
                .as_ref()
                .is_none_or(|(least, _)| found.0.norm_squared() < least.norm_squared())
            {
                best = Some(found);
            }
        }
        best.ok_or_else(|| {
            let height = |&(origin, square): &(f64, f64)| origin.abs() / square.sqrt();
            let margin = heights.iter().map(height).fold(f64::INFINITY, f64::min);
            self.inside(margin, weights)
        })
    }

    /// The triangle nearest to the origin: of a tetrahedron that holds it, the nearest face.
    #[inline(never)]
    pub fn nearest_triangle(&self) -> Option<NearTriangle> {
        let faces: &[[usize; 3]] = match self.len {
            3 => &FACES[..1],
            4 => &FACES,
            _ => return None,
        };
        let planes = faces.iter().filter_map(|&[i, j, k]| {
            let a = self.at(i);
            let normal = (self.at(j) - a).cross(&(self.at(k) - a));
            let normal = normal.try_normalize(0.0)?;
            Some((normal.dot(&a).abs(), normal, [i, j, k]))
        });
        let nearest = planes.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.map(|(_, direction, face)| NearTriangle {
            direction,
            names: [0, 1]
                .map(|side: usize| Names::distinct(&face.map(|i| self.corners[i].names[side]))),
        })
    }

    /// The result for an origin on the inner side of all four faces. `weights` combine the corners to about the origin.
    ///
    /// A weight is a quotient of volumes. Where the corners are far apart compared with the heights, its rounding moves the
    /// point by more than a distance's error; Newton steps with the same volumes correct it.
    #[inline(never)]
    fn inside(&self, margin: f64, weights: [f64; 4]) -> OriginPosition {
        let total: f64 = weights.iter().sum();
        let mut weights = weights.map(|w| w / total);
        let mut at = self.combination(&weights);
        let square = |corner: &Corner| corner.difference.norm_squared();
        let largest = self.corners.iter().map(square).fold(0.0, f64::max);
        if square(&at) <= (4.0 * tolerance::EPSILON).powi(2) * largest {
            return OriginPosition::Inside { margin, at };
        }
        let normals = self.inner_normals();
        for _ in 0..MAX_WEIGHT_STEPS {
            let mut next = weights;
            for (weight, normal) in next.iter_mut().zip(&normals) {
                *weight -= normal.dot(&at.difference);
            }
            let total: f64 = next.iter().sum();
            let next = next.map(|w| w / total);
            if next.iter().any(|w| w.is_nan() || *w < 0.0) {
                break;
            }
            let better = self.combination(&next);
            if better.difference.norm_squared() >= at.difference.norm_squared() {
                break;
            }
            (weights, at) = (next, better);
        }
        OriginPosition::Inside { margin, at }
    }

    /// The gradients of the four barycentric weights.
    fn inner_normals(&self) -> [Vec3; 4] {
        [(1, 2, 3, 0), (0, 3, 2, 1), (0, 1, 3, 2), (0, 2, 1, 3)].map(|(i, j, k, opposite)| {
            let a = self.at(i);
            let normal = (self.at(j) - a).cross(&(self.at(k) - a));
            normal / normal.dot(&(self.at(opposite) - a))
        })
    }

    fn combination(&self, weights: &[f64; 4]) -> Corner {
        let all = || self.corners.iter().zip(weights);
        Corner {
            difference: all()
                .map(|(corner, weight)| corner.difference * *weight)
                .sum(),
            on_a: all().map(|(corner, weight)| corner.on_a * *weight).sum(),
            names: [0; 2],
        }
    }
}

/// The faces of a tetrahedron.
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];

/// Each step reduces the error to the rounding of a quotient of volumes, so one suffices except for needles.
const MAX_WEIGHT_STEPS: usize = 4;

/// The square of the sine of the angle under which a point must be seen over a face, to be clearly on one side of it.
const CLEARLY_BEHIND: f64 = 1e-12;

/// The one to three corners whose hull holds the closest point.
struct ClosestFace {
    corners: [usize; 3],
    len: usize,
}

impl ClosestFace {
    fn new<const N: usize>(given: [usize; N]) -> Self {
        let mut corners = [0; 3];
        corners[..N].copy_from_slice(&given);
        Self { corners, len: N }
    }
}
