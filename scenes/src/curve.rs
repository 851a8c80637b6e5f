//! Cubic curves for profiles and centre lines.

use crate::point::between;

/// The `segments + 1` points at equal parameter steps on the cubic Bézier curve with these controls; exact at both
/// ends.
pub(crate) fn bezier<const D: usize>(
    [a, b, c, d]: [[f64; D]; 4],
    segments: usize,
) -> Vec<[f64; D]> {
    let at = |step: usize| {
        let t = step as f64 / segments as f64;
        let (ab, bc, cd) = (between(a, b, t), between(b, c, t), between(c, d, t));
        between(between(ab, bc, t), between(bc, cd, t), t)
    };
    (0..=segments).map(at).collect()
}

/// The profile that goes on from the last point of `profile` to `end` in `segments` equal steps.
pub(crate) fn straight_on(profile: &mut Vec<[f64; 2]>, end: [f64; 2], segments: usize) {
    let start = profile[profile.len() - 1];
    profile.extend((1..=segments).map(|k| between(start, end, k as f64 / segments as f64)));
}

/// The profile that goes on from its last point, which heads for `corner`, in a rounded corner that ends at `end`.
pub(crate) fn rounded_on(
    profile: &mut Vec<[f64; 2]>,
    corner: [f64; 2],
    end: [f64; 2],
    segments: usize,
) {
    let start = profile[profile.len() - 1];
    // The weight with which a cubic comes closest to a quarter of a circle.
    let weight = 0.552_284_75;
    let controls = [
        start,
        between(start, corner, weight),
        between(end, corner, weight),
        end,
    ];
    profile.extend(&bezier(controls, segments)[1..]);
}
