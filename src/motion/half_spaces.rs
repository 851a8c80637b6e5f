//! The nearest point of an intersection of half-spaces: least distance programming by non-negative least squares (Lawson
//! and Hanson 1974, ch. 23), an exact active set method that ends after finitely many exchanges.

use nalgebra::{DMatrix, DVector};

/// The half-space `row . s >= least` of vectors s.
#[derive(Clone, Debug)]
pub struct HalfSpace {
    /// The normal, of any length, into the half-space.
    pub row: Vec<f64>,
    /// The smallest `row . s` in the half-space.
    pub least: f64,
}

/// Tolerance for rounding, relative to the vector's length.
const SLACK: f64 = 1e-9;

/// The point of the half-spaces' intersection nearest to `wish`, or `None` if the intersection is (numerically) empty. Zero
/// rows are left out: no vector changes them.
pub fn nearest_in_half_spaces(wish: &[f64], half_spaces: &[HalfSpace]) -> Option<Vec<f64>> {
    // Normalized and relative to the wish: the shortest x = s - wish with unit . x >= short.
    let constraints: Vec<(DVector<f64>, f64)> = half_spaces
        .iter()
        .filter_map(|h| {
            let length = dot(&h.row, &h.row).sqrt();
            let unit = DVector::from_iterator(wish.len(), h.row.iter().map(|g| g / length));
            (length > 0.0).then(|| {
                let short = h.least / length - dot(unit.as_slice(), wish);
                (unit, short)
            })
        })
        .collect();
    let scale = constraints
        .iter()
        .fold(0.0f64, |most, (_, short)| most.max(*short));
    if scale <= 0.0 {
        return Some(wish.to_vec());
    }
    let n = wish.len();
    let columns: Vec<DVector<f64>> = constraints
        .iter()
        .map(|(unit, short)| unit.push(short / scale))
        .collect();
    let mut target = DVector::zeros(n + 1);
    target[n] = 1.0;
    let residual = non_negative_residual(&columns, &target);
    if residual.norm() <= SLACK || residual[n] >= 0.0 {
        return None;
    }
    let x: Vec<f64> = (0..n).map(|i| -residual[i] / residual[n] * scale).collect();
    let size = scale + dot(&x, &x).sqrt();
    let holds = |(unit, short): &(DVector<f64>, f64)| {
        dot(unit.as_slice(), &x) >= short - 1e3 * SLACK * size
    };
    constraints
        .iter()
        .all(holds)
        .then(|| wish.iter().zip(&x).map(|(w, x)| w + x).collect())
}

/// `E u - f` for the `u >= 0` that makes it shortest; the columns of E are given.
fn non_negative_residual(columns: &[DVector<f64>], target: &DVector<f64>) -> DVector<f64> {
    let mut u = vec![0.0; columns.len()];
    let mut passive: Vec<usize> = Vec::new();
    let mut residual = -target;
    // Each exchange shortens the residual, so no passive set repeats; the limit guards against rounding.
    for _ in 0..3 * columns.len() + 10 {
        let entering = (0..columns.len())
            .filter(|j| !passive.contains(j))
            .map(|j| (-columns[j].dot(&residual) / columns[j].norm(), j))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match entering {
            Some((gain, j)) if gain > 1e-13 => passive.push(j),
            _ => break,
        }
        loop {
            let chosen: Vec<DVector<f64>> = passive.iter().map(|&j| columns[j].clone()).collect();
            let matrix = DMatrix::from_columns(&chosen);
            let Ok(best) = matrix.svd(true, true).solve(target, 1e-13) else {
                return residual;
            };
            let blocking = passive
                .iter()
                .zip(best.iter())
                .filter(|(_, best)| **best <= 0.0)
                .map(|(&j, best)| u[j] / (u[j] - best))
                .fold(f64::INFINITY, f64::min);
            let part = if blocking.is_finite() { blocking } else { 1.0 };
            for (&j, best) in passive.iter().zip(best.iter()) {
                u[j] += part * (best - u[j]);
            }
            if !blocking.is_finite() {
                break;
            }
            let before = passive.len();
            passive.retain(|&j| u[j] > 1e-15);
            for (j, u) in u.iter_mut().enumerate() {
                if !passive.contains(&j) {
                    *u = 0.0;
                }
            }
            if passive.is_empty() || passive.len() == before {
                break;
            }
        }
        residual = -target;
        for &j in &passive {
            residual += &columns[j] * u[j];
        }
    }
    residual
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;

    fn half_space(row: &[f64], least: f64) -> HalfSpace {
        HalfSpace {
            row: row.to_vec(),
            least,
        }
    }

    #[test]
    fn projects_onto_a_corner() {
        // x >= 1 and x + y >= 3, from (0, 0): the nearest point is (1.5, 1.5); with x >= 2 it is (2, 1).
        for (least, want) in [(1.0, [1.5, 1.5]), (2.0, [2.0, 1.0])] {
            let half_spaces = [half_space(&[1.0, 0.0], least), half_space(&[1.0, 1.0], 3.0)];
            let found = nearest_in_half_spaces(&[0.0, 0.0], &half_spaces).unwrap();
            assert!((found[0] - want[0]).abs() < 1e-12 && (found[1] - want[1]).abs() < 1e-12);
        }
    }

    #[test]
    fn opposed_half_spaces_have_no_point() {
        let half_spaces = [half_space(&[1.0, 0.0], 1.0), half_space(&[-1.0, 0.0], 1.0)];
        assert!(nearest_in_half_spaces(&[1.0, 1.0], &half_spaces).is_none());
    }

    /// Optimal by Karush, Kuhn and Tucker: feasible, and the way to it is a non-negative mixture of rows that hold with
    /// equality. Rows come in near copies, as contacts of finely meshed bodies do.
    #[test]
    fn random_projections_are_optimal() {
        let mut random = Random::new(7);
        let mut random = || random.within(-1.0, 1.0);
        let mut moved = 0;
        for _ in 0..2000 {
            let n = 1 + (random().abs() * 7.0) as usize;
            let m = 1 + (random().abs() * 40.0) as usize;
            let mut half_spaces: Vec<HalfSpace> = Vec::new();
            for i in 0..m {
                let row: Vec<f64> = match half_spaces.last() {
                    Some(last) if i % 3 > 0 => {
                        last.row.iter().map(|g| g + 1e-7 * random()).collect()
                    }
                    _ => (0..n).map(|_| random()).collect(),
                };
                half_spaces.push(half_space(&row, -0.3 * random().abs()));
            }
            let wish: Vec<f64> = (0..n).map(|_| 3.0 * random()).collect();
            // 0 lies in all of them.
            let s = nearest_in_half_spaces(&wish, &half_spaces).unwrap();
            for h in &half_spaces {
                assert!(dot(&h.row, &s) >= h.least - 1e-6);
            }
            let way: Vec<f64> = s.iter().zip(&wish).map(|(s, w)| s - w).collect();
            let length = dot(&way, &way).sqrt();
            if length == 0.0 {
                continue;
            }
            moved += 1;
            // No feasible point is nearer: for each, the way there and the way back from s enclose at least a right angle.
            for t in [0.0, 0.25, 0.5, 0.9] {
                let other: Vec<f64> = s.iter().map(|x| x * t).collect();
                let back: Vec<f64> = other.iter().zip(&s).map(|(o, s)| o - s).collect();
                assert!(dot(&way, &back) >= -1e-6 * length, "{n} {m}");
            }
            let tight: Vec<DVector<f64>> = half_spaces
                .iter()
                .filter(|h| dot(&h.row, &s) <= h.least + 1e-6)
                .map(|h| DVector::from_column_slice(&h.row))
                .collect();
            let left = non_negative_residual(&tight, &DVector::from_column_slice(&way));
            assert!(left.norm() <= 1e-6 * length, "{}", left.norm() / length);
        }
        assert!(moved > 1000);
    }
}
