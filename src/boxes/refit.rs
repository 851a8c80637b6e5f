//! The spans of boxes whose axes are known: those of an existing node, turned or kept. No axes are searched for.

use super::wide_node::{AXIS_STEP, AXIS_UNITS, MAX_AXIS, WideNode};
use crate::lanes::{cross3, each3};
use crate::pose::{Mat3, Vec3};

/// Added to a half side for the rounding of the axes to single precision, times the sum of the half sides: 2^-20. The third
/// axis is a cross product in single precision, within 3 * 2^-24 of the one that is orthogonal to the other two.
pub(super) const AXIS_ROUNDING: f64 = 1.0 / 1_048_576.0;

/// The axes of a box as a wide node stores them.
#[derive(Clone, Copy, Debug)]
pub struct StoredAxes {
    pub(super) numbers: [[i16; 3]; 2],
    /// The axes that the numbers stand for, as columns; the third is the cross product that a node computes.
    pub axes: Mat3,
}

impl StoredAxes {
    /// Rounds two orthonormal axes.
    #[inline(always)]
    pub fn rounded(first: &Vec3, second: &Vec3) -> Self {
        let numbers = [first, second].map(|axis| {
            each3(|k| {
                // The nearest whole number.
                let component = (axis[k] * AXIS_UNITS).clamp(-MAX_AXIS, MAX_AXIS);
                (component + 0.5f64.copysign(component)) as i16
            })
        });
        Self::of_numbers(numbers)
    }

    /// The axes of a box of a node, as they are.
    #[inline(always)]
    pub fn of(node: &WideNode, lane: usize) -> Self {
        Self::of_numbers([0, 1].map(|i: usize| each3(|k| node.axes[i][k][lane])))
    }

    #[inline(always)]
    fn of_numbers(numbers: [[i16; 3]; 2]) -> Self {
        let [a, b] = numbers.map(|axis| axis.map(|number| f32::from(number) * AXIS_STEP));
        let axes = [a, b, cross3(&a, &b)].map(|axis| Vec3::from(axis.map(f64::from)));
        Self {
            numbers,
            axes: Mat3::from_columns(&axes),
        }
    }
}

/// A set between two planes across each of three stored axes.
#[derive(Clone, Copy, Debug)]
pub struct AxisSpans {
    pub axes: StoredAxes,
    /// The lowest and highest coordinates of the set along the axes.
    pub low: Vec3,
    pub high: Vec3,
}

impl AxisSpans {
    /// The spans of at least one point.
    #[inline(always)]
    pub fn of_points(axes: StoredAxes, points: impl Iterator<Item = Vec3>) -> Self {
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(-f64::INFINITY));
        for point in points {
            let place = axes.axes.tr_mul(&point);
            (low, high) = (low.inf(&place), high.sup(&place));
        }
        Self { axes, low, high }
    }

    /// The spans of one of a node's boxes after a motion, whose rotation also turns the axes.
    pub fn moved(node: &WideNode, lane: usize, motion: &BoxMotion) -> Self {
        let old = node.get(lane);
        let turned = old
            .axes
            .map(|axis| motion.rotation * Vec3::from(axis.map(f64::from)));
        // Orthonormalized, or the rounding of motion after motion would add up.
        let first = turned[0].normalize();
        let second = (turned[1] - first * first.dot(&turned[1])).normalize();
        let axes = StoredAxes::rounded(&first, &second);
        let center = Vec3::from(old.center.map(f64::from)) * motion.factor;
        let center = motion.rotation * center + motion.translation;
        let half = old.half.map(|half| f64::from(half) * motion.factor);
        let middle = axes.axes.tr_mul(&center);
        let mut sides = Vec3::zeros();
        for (side, half) in turned.iter().zip(half) {
            sides += axes.axes.tr_mul(side).abs() * half;
        }
        Self {
            axes,
            low: middle - sides,
            high: middle + sides,
        }
    }
}

/// A rigid motion of boxes from one tree's units to another's.
#[derive(Clone, Copy, Debug)]
pub struct BoxMotion {
    pub rotation: Mat3,
    /// In units of the tree that the boxes come into.
    pub translation: Vec3,
    /// The unit of the tree that the boxes come from, in units of the one they come into.
    pub factor: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::{ChildPoints, fitted_axes};
    use crate::pose::rotation_about;

    /// Points that spread like those of a slender, tilted polygon.
    fn points(seed: u32) -> Vec<Vec3> {
        let number = |i: u32| f64::from((seed * 7919 + i * 104_729) % 1009) / 1009.0 - 0.5;
        let turn = rotation_about(&Vec3::new(0.36, 0.48, 0.8), f64::from(seed));
        let at = Vec3::new(number(50), number(51), number(52)) * 0.5;
        (0..6)
            .map(|i| {
                let flat = Vec3::new(
                    number(3 * i),
                    0.1 * number(3 * i + 1),
                    1e-3 * number(3 * i + 2),
                );
                at + turn * flat * 0.3
            })
            .collect()
    }

    /// The largest excess of the points over a box, in either sense of `PackedBox`.
    fn excess(node: &WideNode, lane: usize, points: &[Vec3]) -> f64 {
        let stored = node.get(lane);
        let axes = Mat3::from_columns(&stored.axes.map(|axis| Vec3::from(axis.map(f64::from))));
        let inverse = axes.try_inverse().unwrap();
        let [center, half] = [stored.center, stored.half].map(|v| Vec3::from(v.map(f64::from)));
        let over = points.iter().map(|point| {
            let from = point - center;
            let along = axes.tr_mul(&from).abs() - half;
            let parts = (inverse * from).abs() - half;
            along.max().max(parts.max())
        });
        over.fold(f64::NEG_INFINITY, f64::max)
    }

    #[test]
    fn boxes_bound_their_points_in_both_senses_before_and_after_motions() {
        for seed in 0..200 {
            let sets: Vec<Vec<Vec3>> = (0..1 + seed % 8).map(|i| points(8 * seed + i)).collect();
            let children: Vec<ChildPoints> = sets
                .iter()
                .map(|points| ChildPoints {
                    axes: fitted_axes(points, None),
                    excess: 0.0,
                    points: points.into(),
                })
                .collect();
            let fitted = WideNode::new(&children);
            let motion = BoxMotion {
                rotation: rotation_about(&Vec3::new(0.6, 0.0, 0.8), 0.1 * f64::from(seed)),
                translation: Vec3::new(0.2, -0.1, 0.15),
                factor: 0.5,
            };
            let lanes = 0..fitted.count as usize;
            let moved: Vec<AxisSpans> = lanes
                .clone()
                .map(|lane| AxisSpans::moved(&fitted, lane, &motion))
                .collect();
            let moved = WideNode::of_spans(&moved);
            let kept: Vec<AxisSpans> = sets
                .iter()
                .enumerate()
                .map(|(lane, set)| {
                    AxisSpans::of_points(StoredAxes::of(&fitted, lane), set.iter().copied())
                })
                .collect();
            let kept = WideNode::of_spans(&kept);
            for lane in lanes {
                let set = &sets[lane];
                assert!(excess(&kept, lane, set) <= 1e-15, "{seed}");
                let after: Vec<Vec3> = set
                    .iter()
                    .map(|p| motion.rotation * p * motion.factor + motion.translation)
                    .collect();
                assert!(excess(&moved, lane, &after) <= 1e-15, "{seed}");
                // Hardly larger than before.
                let [before, since] =
                    [&fitted, &moved].map(|node| Vec3::from(node.get(lane).half.map(f64::from)));
                let room = 3e-4 * before.norm();
                assert!((since - before * 0.5).max() <= room, "{before} {since}");
            }
        }
    }
}
