//! The report's `slide-step` and `compute-spring-step` (Appendix A): steps that respect contacts, to first order.

use super::half_spaces::{HalfSpace, dot, nearest_in_half_spaces};
use crate::nonzero;
use crate::query::WitnessList;

/// A contact's clearance, and how a step changes it.
#[derive(Clone, Copy, Debug)]
pub struct Approach<'a> {
    /// The derivative of the clearance, one entry per velocity.
    pub gradient: &'a [f64],
    /// The distance, less the margin; negative within it.
    pub clearance: f64,
}

impl WitnessList {
    /// The contacts with their gradients; empty if the list has no gradients.
    pub fn approaches(&self) -> Vec<Approach<'_>> {
        self.contacts
            .iter()
            .zip(self.gradients.chunks_exact(self.nv.max(1)))
            .map(|(contact, gradient)| Approach {
                gradient,
                clearance: contact.clearance,
            })
            .collect()
    }
}

/// A step that is shorter than this fraction of the requested step, or whose cosine to it is below this, is not worth
/// taking.
pub const LEAST_GAIN: f64 = 1e-2;

/// The largest factor by which a step is lengthened.
const MAX_STRETCH: f64 = 4.0;

/// The step nearest to `step` that brings no contact nearer than `desired`, brings contacts that are nearer already no
/// nearer still, and keeps to the `limits`. With `normalize` it is lengthened to the length of `step`, at most fourfold.
/// `None` where less than [`LEAST_GAIN`] of the step is left.
pub fn slide_step(
    step: &[f64],
    approaches: &[Approach],
    limits: &[HalfSpace],
    desired: f64,
    normalize: bool,
) -> Option<Vec<f64>> {
    let mut half_spaces = limits.to_vec();
    half_spaces.extend(movable(approaches).map(|a| HalfSpace {
        row: a.gradient.to_vec(),
        least: (desired - a.clearance).min(0.0),
    }));
    let along = nearest_in_half_spaces(step, &half_spaces)?;
    let [requested, left] = [step, &along[..]].map(nonzero::length);
    if left <= LEAST_GAIN * requested || dot(&along, step) <= LEAST_GAIN * left * requested {
        return None;
    }
    if normalize && left < requested {
        let stretch = (requested / left).min(MAX_STRETCH);
        let wish: Vec<f64> = step.iter().map(|x| x * stretch).collect();
        if let Some(longer) = nearest_in_half_spaces(&wish, &half_spaces)
            && nonzero::length(&longer) <= 1.5 * requested
        {
            return Some(longer);
        }
    }
    Some(along)
}

/// A step is no longer than this times the longest that one contact alone asks for. Contacts that oppose each other to within an angle of
/// its inverse could share a larger distance only far along them, where derivatives say nothing, and rounding is as large as what is gained.
const MAX_REACH: f64 = 1e3;

/// The shortest step that takes all contacts out to `desired`. Where not all can get there, or not within [`MAX_REACH`], the step that
/// takes them all out to the largest distance that they can share. `None` where no contact is nearer than `desired`, or none can move
/// out.
pub fn spring_step(
    approaches: &[Approach],
    limits: &[HalfSpace],
    desired: f64,
) -> Option<Vec<f64>> {
    let nearest = nearest_movable(approaches);
    if nearest >= desired {
        return None;
    }
    let nv = approaches.first()?.gradient.len();
    let still = vec![0.0; nv];
    let alone = movable(approaches).map(|a| (desired - a.clearance) / nonzero::length(a.gradient));
    let longest = MAX_REACH * alone.fold(0.0, f64::max);
    let out_to = |level: f64| {
        let mut half_spaces = limits.to_vec();
        half_spaces.extend(movable(approaches).map(|a| HalfSpace {
            row: a.gradient.to_vec(),
            least: level - a.clearance,
        }));
        let found = nearest_in_half_spaces(&still, &half_spaces)?;
        (nonzero::length(&found) <= longest).then_some(found)
    };
    if let Some(found) = out_to(desired) {
        return Some(found);
    }
    let (mut low, mut high, mut best) = (nearest, desired, None);
    for _ in 0..20 {
        let level = 0.5 * (low + high);
        match out_to(level) {
            Some(found) => (low, best) = (level, Some(found)),
            None => high = level,
        }
    }
    best.filter(|found| dot(found, found) > 0.0)
}

/// The contacts that some step changes. Where the joints move both bodies together, the gradient is rounding error, whose
/// direction means nothing.
fn movable<'s, 'a>(approaches: &'s [Approach<'a>]) -> impl Iterator<Item = &'s Approach<'a>> {
    let length = |a: &Approach| nonzero::length(a.gradient);
    let largest = approaches.iter().map(length).fold(0.0, f64::max);
    approaches
        .iter()
        .filter(move |a| length(a) > ROUNDING * largest.max(ROUNDING))
}

/// A gradient shorter than this fraction of the longest is rounding error of sums that cancel.
const ROUNDING: f64 = 1e-12;

/// The clearance of the nearest contact that some step changes.
pub fn nearest_movable(approaches: &[Approach]) -> f64 {
    movable(approaches).fold(f64::INFINITY, |least, a| least.min(a.clearance))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between two walls that hardly narrow: in the middle, whatever their angle, and not far along them.
    #[test]
    fn nearly_opposed_contacts_share_what_is_there() {
        for tilt in [0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4f64] {
            let rows = [[0.0, 1.0], [-tilt.sin(), -tilt.cos()]];
            let approaches = [0, 1].map(|i| Approach {
                gradient: &rows[i],
                clearance: [0.005, 0.015][i],
            });
            let step = spring_step(&approaches, &[], 0.1).unwrap();
            assert!(nonzero::length(&step) <= 100.0, "{tilt}: {step:?}");
            for approach in &approaches {
                let after = approach.clearance + dot(approach.gradient, &step);
                // The solver's rounding is a millionth of the step.
                assert!(
                    after >= 0.01 - 1e-6 * (1.0 + nonzero::length(&step)),
                    "{tilt}: {after}"
                );
            }
        }
    }
}
