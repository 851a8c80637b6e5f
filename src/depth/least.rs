//! The shortest translation in an intersection of half-spaces, with a lower bound of its length that rounding does not make
//! wrong.
//!
//! Any multipliers that are not negative prove a bound: all t with n_i . t >= o_i have |t| >= sum(m_i o_i) / |sum(m_i n_i)|.
//! The best bound belongs to at most three of the half-spaces, the basis, which is exchanged against the half-space that
//! its point violates most, until none is violated.

use smallvec::{SmallVec, smallvec};

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

type Basis = SmallVec<[usize; 4]>;

/// A basis with its point.
struct Corner {
    basis: Basis,
    multipliers: SmallVec<[f64; 3]>,
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
        basis: smallvec![],
        multipliers: smallvec![],
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
            multipliers: self.basis.iter().copied().zip(self.multipliers).collect(),
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
    let subsets = 0..1usize << basis.len();
    let corners = subsets.filter_map(|mask| {
        let mut tried: Basis = smallvec![];
        tried.extend(kept(basis, mask));
        tried.push(worst);
        (tried.len() <= 3).then_some(())?;
        corner(spaces, offset, tried)
    });
    corners.max_by(|a, b| a.bound.total_cmp(&b.bound))
}

/// Those of a basis whose bits are set.
fn kept(basis: &Basis, mask: usize) -> impl Iterator<Item = usize> {
    let numbered = basis.iter().enumerate();
    numbered.filter_map(move |(i, &space)| (mask >> i & 1 == 1).then_some(space))
}

/// The shortest translation on the planes of a basis, if it proves a bound.
fn corner(spaces: &[HalfSpace], offset: &impl Fn(usize) -> f64, basis: Basis) -> Option<Corner> {
    let normals: SmallVec<[Vec3; 3]> = basis.iter().map(|&i| spaces[i].normal).collect();
    let offsets: SmallVec<[f64; 3]> = basis.iter().map(|&i| offset(i)).collect();
    let multipliers = solved(&normals, &offsets)?;
    let largest = multipliers.iter().fold(0.0, |a: f64, m| a.max(m.abs()));
    if multipliers.iter().any(|m| *m < -FLAT * largest) {
        return None;
    }
    let largest_offset = offsets.iter().fold(0.0, |a: f64, o| a.max(o.abs()));
    let (mut sum, mut along) = (Vec3::zeros(), 0.0);
    for ((normal, offset), multiplier) in normals.iter().zip(&offsets).zip(&multipliers) {
        let multiplier = multiplier.max(0.0);
        sum += normal * multiplier;
        along += offset * multiplier;
    }
    // Both sums carry the rounding of their terms.
    let weight: f64 = multipliers.iter().map(|m| m.max(0.0)).sum();
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

/// The multipliers whose sum of normals lies on all planes; `None` where the normals are not independent.
fn solved(normals: &[Vec3], offsets: &[f64]) -> Option<SmallVec<[f64; 3]>> {
    match (normals, offsets) {
        ([a], [x]) => Some(smallvec![x / a.norm_squared()]),
        ([a, b], [x, y]) => {
            let determinant = a.cross(b).norm_squared();
            (determinant > FLAT * FLAT).then_some(())?;
            let (aa, ab, bb) = (a.norm_squared(), a.dot(b), b.norm_squared());
            Some(smallvec![
                (bb * x - ab * y) / determinant,
                (aa * y - ab * x) / determinant
            ])
        }
        ([a, b, c], [x, y, z]) => {
            // The products of two with the third are the determinant, those with one of the two are 0.
            let across = [b.cross(c), c.cross(a), a.cross(b)];
            let determinant = a.dot(&across[0]);
            (determinant.abs() > FLAT).then_some(())?;
            let point = (across[0] * *x + across[1] * *y + across[2] * *z) / determinant;
            Some(across.iter().map(|n| n.dot(&point) / determinant).collect())
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
    for mask in 1..1usize << basis.len() {
        let kept: Basis = kept(basis, mask).collect();
        let normals: SmallVec<[Vec3; 3]> = kept.iter().map(|&i| spaces[i].normal).collect();
        let opposite = -spaces[worst].normal;
        let products: SmallVec<[f64; 3]> = normals.iter().map(|n| n.dot(&opposite)).collect();
        let Some(multipliers) = solved(&normals, &products) else {
            continue;
        };
        if multipliers.iter().any(|m| *m < 0.0) {
            continue;
        }
        let (mut sum, mut along) = (spaces[worst].normal, offset(worst));
        for (&i, multiplier) in kept.iter().zip(&multipliers) {
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
