//! The nearest vector in an intersection of half-spaces, by Hildreth's dual coordinate ascent (1957).

/// A row `g` and a number `least`: the half-space `g . s >= least`.
pub struct HalfSpace<'a> {
    pub row: &'a [f64],
    pub least: f64,
}

/// The point of the half-spaces' intersection nearest to `wish`, or `None` if the intersection is (numerically) empty.
pub fn nearest_in_half_spaces(wish: &[f64], half_spaces: &[HalfSpace]) -> Option<Vec<f64>> {
    let mut s = wish.to_vec();
    let mut multipliers = vec![0.0; half_spaces.len()];
    let squares: Vec<f64> = half_spaces.iter().map(|h| dot(h.row, h.row)).collect();
    let short_of = |h: &HalfSpace, s: &[f64]| h.least - dot(h.row, s);
    for _ in 0..2000 {
        let mut changed = 0.0f64;
        for ((half_space, multiplier), square) in
            half_spaces.iter().zip(&mut multipliers).zip(&squares)
        {
            if *square == 0.0 {
                continue;
            }
            let change = (short_of(half_space, &s) / square).max(-*multiplier);
            *multiplier += change;
            for (x, g) in s.iter_mut().zip(half_space.row) {
                *x += change * g;
            }
            changed = changed.max(change.abs() * square.sqrt());
        }
        if changed <= 1e-12 * dot(wish, wish).sqrt() {
            break;
        }
    }
    let scale = dot(wish, wish).sqrt().max(dot(&s, &s).sqrt());
    let holds = |(h, square): (&HalfSpace, &f64)| short_of(h, &s) <= 1e-6 * square.sqrt() * scale;
    half_spaces.iter().zip(&squares).all(holds).then_some(s)
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projects_onto_a_corner() {
        // x >= 1 and x + y >= 3, from (0, 0): the nearest point is (1.5, 1.5); with x >= 2 it is (2, 1).
        let sum = [1.0, 1.0];
        let x = [1.0, 0.0];
        for (least, want) in [(1.0, [1.5, 1.5]), (2.0, [2.0, 1.0])] {
            let half_spaces = [
                HalfSpace { row: &x, least },
                HalfSpace {
                    row: &sum,
                    least: 3.0,
                },
            ];
            let found = nearest_in_half_spaces(&[1e-9, 0.0], &half_spaces).unwrap();
            assert!((found[0] - want[0]).abs() < 1e-6 && (found[1] - want[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn opposed_half_spaces_have_no_point() {
        let (up, down) = ([1.0, 0.0], [-1.0, 0.0]);
        let half_spaces = [
            HalfSpace {
                row: &up,
                least: 1.0,
            },
            HalfSpace {
                row: &down,
                least: 1.0,
            },
        ];
        assert!(nearest_in_half_spaces(&[1.0, 1.0], &half_spaces).is_none());
    }
}
