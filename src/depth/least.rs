//! The shortest translation in an intersection of half-spaces, with a lower bound of its length that rounding does not make
//! wrong.
//!
//! Any multipliers that are not negative prove a bound: all t with n_i . t >= o_i have |t| >= sum(m_i o_i) / |sum(m_i n_i)|.
//! The best bound belongs to at most three of the half-spaces, the basis, which is exchanged against the half-space that
//! its point violates most, until none is violated.

use smallvec::{SmallVec, smallvec};

use crate::convex::HalfSpace;
use crate::pose::{Mat3, Vec3};
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
        let kept = (0..basis.len()).filter(|i| mask >> i & 1 == 1);
        let mut tried: Basis = kept.map(|i| basis[i]).collect();
        tried.push(worst);
        (tried.len() <= 3).then_some(())?;
        corner(spaces, offset, tried)
    });
    corners.max_by(|a, b| a.bound.total_cmp(&b.bound))
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
    let product = |i: usize, j: usize| normals[i].dot(&normals[j]);
    match normals.len() {
        1 => Some(smallvec![offsets[0] / product(0, 0)]),
        2 => {
            let (a, b, d) = (product(0, 0), product(0, 1), product(1, 1));
            let determinant = normals[0].cross(&normals[1]).norm_squared();
            (determinant > FLAT * FLAT).then_some(())?;
            let [x, y] = [offsets[0], offsets[1]];
            Some(smallvec![
                (d * x - b * y) / determinant,
                (a * y - b * x) / determinant
            ])
        }
        _ => {
            let columns = Mat3::from_columns(normals);
            (columns.determinant().abs() > FLAT).then_some(())?;
            // The point on the three planes, and then its multipliers.
            let point = columns
                .transpose()
                .lu()
                .solve(&Vec3::from_row_slice(offsets))?;
            let multipliers = columns.lu().solve(&point)?;
            Some(multipliers.iter().copied().collect())
        }
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
        let kept: Basis = (0..basis.len())
            .filter(|i| mask >> i & 1 == 1)
            .map(|i| basis[i])
            .collect();
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
