//! The shortest translation in an intersection of half-spaces, with a lower bound of its length that rounding does not make
//! wrong.
//!
//! Any multipliers that are not negative prove a bound: all t with n_i . t >= o_i have |t| >= sum(m_i o_i) / |sum(m_i n_i)|.
//! The best bound belongs to at most three of the half-spaces, the basis, which is exchanged against the half-space that
//! its point violates most, until none is violated.

use smallvec::SmallVec;

use crate::convex::HalfSpace;
use crate::pose::Vec3;
use crate::tolerance::EPSILON;

/// The shortest translation found.
#[derive(Clone, Debug)]
pub struct Least {
    /// No translation in all half-spaces is shorter. Infinite if there is none at all.
    pub bound: f64,
    pub point: Vec3,
    /// The half-spaces of the basis and their multipliers: the point is the sum of the normals times these.
    pub multipliers: SmallVec<[(usize, f64); 3]>,
    /// Whether `point` is in all half-spaces, up to rounding.
    pub is_inside: bool,
}

/// At most three half-spaces, by number.
#[derive(Clone, Copy, Default)]
struct Basis {
    spaces: [usize; 3],
    count: usize,
}

impl Basis {
    fn as_slice(&self) -> &[usize] {
        &self.spaces[..self.count]
    }

    /// Those whose bits are set in a mask.
    fn part(&self, mask: usize) -> Self {
        let mut part = Self::default();
        for (i, &space) in self.as_slice().iter().enumerate() {
            if mask >> i & 1 == 1 {
                part.spaces[part.count] = space;
                part.count += 1;
            }
        }
        part
    }

    /// With one more, unless there are three.
    fn with(mut self, space: usize) -> Option<Self> {
        *self.spaces.get_mut(self.count)? = space;
        self.count += 1;
        Some(self)
    }

    /// All parts, as masks.
    fn masks(&self) -> std::ops::Range<usize> {
        0..1 << self.count
    }
}

/// A basis with its point.
struct Corner {
    basis: Basis,
    multipliers: [f64; 3],
    bound: f64,
    point: Vec3,
}

/// Exchanges of the basis, at most: the bound grows with each, so that only rounding could go on for ever.
const MAX_EXCHANGES: usize = 100;

/// Multipliers and determinants below this, relative to their scale, count as 0.
const FLAT: f64 = 1e-13;

/// The shortest translation in all half-spaces, each shrunk by `inset`. `rounding` is the length by which a point may violate
/// a half-space.
pub fn least(spaces: &[HalfSpace], inset: f64, rounding: f64) -> Least {
    let offset = |i: usize| spaces[i].offset + inset;
    let mut best = Corner {
        basis: Basis::default(),
        multipliers: [0.0; 3],
        bound: 0.0,
        point: Vec3::zeros(),
    };
    for _ in 0..MAX_EXCHANGES {
        let violations =
            (0..spaces.len()).map(|i| (offset(i) - spaces[i].normal.dot(&best.point), i));
        let worst = violations.max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, worst)) = worst.filter(|(violation, _)| *violation > rounding) else {
            return best.answer(true);
        };
        let next = exchanged(spaces, &offset, &best.basis, worst);
        match next.filter(|next| next.bound > best.bound) {
            Some(next) => best = next,
            None => {
                let bound = contradiction(spaces, &offset, &best.basis, worst, rounding);
                best.bound = best.bound.max(bound);
                return best.answer(false);
            }
        }
    }
    best.answer(false)
}

impl Corner {
    fn answer(self, is_inside: bool) -> Least {
        Least {
            bound: self.bound,
            point: self.point,
            multipliers: (self.basis.as_slice().iter().copied().zip(self.multipliers)).collect(),
            is_inside,
        }
    }
}

/// The best corner of a basis and one half-space more, among those that use the latter.
fn exchanged(
    spaces: &[HalfSpace],
    offset: &impl Fn(usize) -> f64,
    basis: &Basis,
    worst: usize,
) -> Option<Corner> {
    let parts = basis
        .masks()
        .filter_map(|mask| basis.part(mask).with(worst));
    let corners = parts.filter_map(|tried| corner(spaces, offset, tried));
    corners.max_by(|a, b| a.bound.total_cmp(&b.bound))
}

/// The shortest translation on the planes of a basis, if it proves a bound.
fn corner(spaces: &[HalfSpace], offset: &impl Fn(usize) -> f64, basis: Basis) -> Option<Corner> {
    let count = basis.count;
    let mut normals = [Vec3::zeros(); 3];
    let mut offsets = [0.0; 3];
    for (k, &i) in basis.as_slice().iter().enumerate() {
        (normals[k], offsets[k]) = (spaces[i].normal, offset(i));
    }
    let multipliers = solved(&normals[..count], &offsets[..count])?;
    let largest = multipliers.iter().fold(0.0, |a: f64, m| a.max(m.abs()));
    if multipliers.iter().any(|m| *m < -FLAT * largest) {
        return None;
    }
    let largest_offset = offsets.iter().fold(0.0, |a: f64, o| a.max(o.abs()));
    let (mut sum, mut along, mut weight) = (Vec3::zeros(), 0.0, 0.0);
    for k in 0..count {
        let multiplier = multipliers[k].max(0.0);
        sum += normals[k] * multiplier;
        along += offsets[k] * multiplier;
        weight += multiplier;
    }
    // Both sums carry the rounding of their terms.
    let length = sum.norm() + 8.0 * EPSILON * weight;
    let bound = (along - 8.0 * EPSILON * weight * largest_offset) / length;
    (along > 0.0 && length > 0.0).then_some(())?;
    Some(Corner {
        basis,
        multipliers,
        bound,
        point: sum,
    })
}

/// The multipliers whose sum of normals lies on all planes, one for each and then zeros; `None` where the normals are not independent.
fn solved(normals: &[Vec3], offsets: &[f64]) -> Option<[f64; 3]> {
    match (normals, offsets) {
        ([a], [x]) => Some([x / a.norm_squared(), 0.0, 0.0]),
        ([a, b], [x, y]) => {
            let determinant = a.cross(b).norm_squared();
            (determinant > FLAT * FLAT).then_some(())?;
            let (aa, ab, bb) = (a.norm_squared(), a.dot(b), b.norm_squared());
            let [of_a, of_b] = [bb * x - ab * y, aa * y - ab * x].map(|m| m / determinant);
            Some([of_a, of_b, 0.0])
        }
        ([a, b, c], [x, y, z]) => {
            // The products of two with the third are the determinant, those with one of the two are 0.
            let across = [b.cross(c), c.cross(a), a.cross(b)];
            let determinant = a.dot(&across[0]);
            (determinant.abs() > FLAT).then_some(())?;
            let point = (across[0] * *x + across[1] * *y + across[2] * *z) / determinant;
            Some(across.map(|normal| normal.dot(&point) / determinant))
        }
        _ => None,
    }
}

/// A lower bound from a half-space that opposes the basis: large, if the sum of their normals nearly vanishes while that of
/// their offsets does not.
fn contradiction(
    spaces: &[HalfSpace],
    offset: &impl Fn(usize) -> f64,
    basis: &Basis,
    worst: usize,
    rounding: f64,
) -> f64 {
    let mut best: f64 = 0.0;
    for part in basis.masks().skip(1).map(|mask| basis.part(mask)) {
        let opposite = -spaces[worst].normal;
        let mut normals = [Vec3::zeros(); 3];
        let mut products = [0.0; 3];
        for (k, &i) in part.as_slice().iter().enumerate() {
            normals[k] = spaces[i].normal;
            products[k] = normals[k].dot(&opposite);
        }
        let Some(multipliers) = solved(&normals[..part.count], &products[..part.count]) else {
            continue;
        };
        if multipliers.iter().any(|m| *m < 0.0) {
            continue;
        }
        let (mut sum, mut along) = (spaces[worst].normal, offset(worst));
        for (&i, multiplier) in part.as_slice().iter().zip(&multipliers) {
            sum += spaces[i].normal * *multiplier;
            along += offset(i) * multiplier;
        }
        // The sums carry the rounding of their terms.
        let weight = 1.0 + multipliers.iter().sum::<f64>();
        along -= rounding * weight;
        if along > 0.0 {
            best = best.max(along / (sum.norm() + 8.0 * EPSILON * weight));
        }
    }
    best
}
