//! Sets of C-space within which the class of a C-object is known by the caller's word, so that no geometry is asked there (§2.2.3).

use std::sync::Arc;

use super::{CObject, Class, PureSet, PureShape, Set};
use crate::error::{Error, ErrorKind, Result};
use crate::nonzero::length;
use crate::robot::BlockKind;
use crate::space::Space;
use crate::tolerance::EPSILON;

/// A C-object whose class is known in the interior of some sets.
#[derive(Clone, Debug)]
pub struct KnownClass {
    /// The C-object itself.
    pub of: Arc<CObject>,
    /// Where its class is known.
    pub within: Arc<ConvexSets>,
    /// Outside or inside.
    pub class: Class,
}

/// A union of convex sets of C-space, each the intersection of boxes, balls and half-spaces. Contact epsilons and scales are ignored.
#[derive(Debug)]
pub struct ConvexSets {
    parts: Vec<Vec<PureSet>>,
}

/// Configurations around one of them.
#[derive(Clone, Copy)]
pub struct Around<'a> {
    /// The one in the middle.
    pub q: &'a [f64],
    /// How far they are from it, one entry per velocity; empty for the middle alone.
    pub half: &'a [f64],
    /// They lie on the straight motions from the middle by `half` and back by it; else anywhere in the box with these half widths.
    pub is_line: bool,
}

impl ConvexSets {
    /// Of a box, a ball or a half-space, of an intersection of such, or of a union of these.
    pub fn of(cobject: &CObject) -> Result<Self> {
        let parts = match cobject.set() {
            Set::Union { induced, others } if induced.is_empty() => {
                let parts = others.iter().map(|part| convex_part(part));
                parts.collect::<Result<_>>()?
            }
            _ => vec![convex_part(cobject)?],
        };
        Ok(Self { parts })
    }

    /// Whether all of the configurations are certainly in the interior of one of the sets.
    pub fn contain(&self, space: &Space, around: &Around) -> bool {
        let is_in = |set: &PureSet| signed_range(set, space, around)[1] < 0.0;
        self.parts.iter().any(|part| part.iter().all(is_in))
    }

    /// Whether none of the configurations is in one of the sets.
    pub fn are_apart(&self, space: &Space, around: &Around) -> bool {
        let is_out = |set: &PureSet| signed_range(set, space, around)[0] > 0.0;
        self.parts.iter().all(|part| part.iter().any(is_out))
    }
}

impl KnownClass {
    /// Refuses sets that are not convex, and a class of contact.
    pub fn new(of: Arc<CObject>, within: &CObject, class: Class) -> Result<Self> {
        if class == Class::Contact {
            return Err(Error::invalid(
                "class is contact: within a set a C-object is known to be outside or inside",
            ));
        }
        if of.space().serial() != within.space().serial() {
            return Err(Error::invalid(
                "within belongs to another space than the C-object",
            ));
        }
        Ok(Self {
            within: Arc::new(ConvexSets::of(within)?),
            of,
            class,
        })
    }

    /// The class of the C-object at a configuration, or of its complement, if it is known there.
    pub fn class_at(&self, q: Option<&[f64]>, complement: bool) -> Option<Class> {
        let around = Around {
            q: q?,
            half: &[],
            is_line: true,
        };
        let is_known = self.within.contain(self.of.space(), &around);
        is_known.then(|| self.class.reversed_if(complement))
    }
}

fn convex_part(cobject: &CObject) -> Result<Vec<PureSet>> {
    let one = |cobject: &CObject| match cobject.set() {
        Set::Pure(set)
            if matches!(
                set.shape,
                PureShape::Box { .. } | PureShape::Ball { .. } | PureShape::HalfSpace { .. }
            ) =>
        {
            Ok(set.clone())
        }
        Set::Pure(set) => Err(not_convex(cobject, set.shape.name())),
        _ => Err(not_convex(cobject, "no pure set")),
    };
    match cobject.set() {
        Set::Intersection(parts) => parts.iter().map(|part| one(part)).collect(),
        _ => Ok(vec![one(cobject)?]),
    }
}

fn not_convex(cobject: &CObject, what: &str) -> Error {
    Error::new(
        ErrorKind::Unsupported,
        format!(
            "within: C-object {} is {what}; classes are known within boxes, balls and half-spaces, their intersections, and unions of these",
            cobject.serial()
        ),
    )
}

/// Bounds of the signed distances from a set, in units of C-space, below and above.
fn signed_range(set: &PureSet, space: &Space, around: &Around) -> [f64; 2] {
    let numbers = || around.q.iter().chain(around.half);
    if !numbers().all(|x| x.is_finite()) {
        return [f64::NEG_INFINITY, f64::INFINITY];
    }
    let size = numbers().fold(std::f64::consts::TAU, |most, x| most.max(x.abs()));
    let slack = 32.0 * around.q.len() as f64 * EPSILON * size;
    match &set.shape {
        PureShape::Box { .. } => {
            let mut range = [f64::NEG_INFINITY; 2];
            for (c, span) in set.spans(space, around.q) {
                let change = coordinate_change(space, around, c) + span.error + slack;
                range[0] = range[0].max(span.beyond - change);
                range[1] = range[1].max(span.beyond + change);
            }
            range
        }
        PureShape::HalfSpace { normal, .. } => {
            let (signed, error) = set.by_coordinate(space, around.q);
            let change = change_across(space, around, normal) + error + slack;
            [signed - change, signed + change]
        }
        PureShape::Ball { center, radius } => {
            let (signed, error) = set.by_coordinate(space, around.q);
            let change = length(around.half);
            let error = error + slack;
            let offset = space.offset(center, around.q);
            let highest = match around.half {
                [] => signed,
                _ if !moves_lines_only(space, around) => signed + change,
                half => farthest(&offset, half, around.is_line) - radius,
            };
            [signed - change - error, highest + error]
        }
        _ => [f64::NEG_INFINITY, f64::INFINITY],
    }
}

/// How far a coordinate goes from the middle; positions of free joints together at most as far as their velocities are long.
fn coordinate_change(space: &Space, around: &Around, c: usize) -> f64 {
    if around.half.is_empty() {
        return 0.0;
    }
    let holds = |block: &&crate::robot::Block| {
        let end = block.coordinate + block.kind.nq();
        (block.coordinate..end).contains(&c)
    };
    match space.blocks().iter().find(holds) {
        Some(block) if block.kind == BlockKind::Line => around.half[block.velocity].abs(),
        Some(block) if block.kind == BlockKind::Placement => {
            let shift = &around.half[block.velocity..block.velocity + 3];
            length(shift)
        }
        _ => f64::INFINITY,
    }
}

/// How far the configurations go from the middle along a normal, which has entries for lines and positions only.
fn change_across(space: &Space, around: &Around, normal: &[f64]) -> f64 {
    if around.half.is_empty() {
        return 0.0;
    }
    let (mut along, mut rest) = (0.0f64, 0.0);
    for block in space.blocks() {
        let (c, k) = (block.coordinate, block.velocity);
        match block.kind {
            BlockKind::Line if around.is_line => along += normal[c] * around.half[k],
            BlockKind::Line => along += (normal[c] * around.half[k]).abs(),
            BlockKind::Rotation => {}
            BlockKind::Placement => {
                let shift = length(&around.half[k..k + 3]);
                rest += length(&normal[c..c + 3]) * shift;
            }
        }
    }
    (along.abs() + rest) / length(normal)
}

/// Whether rotations and free joints rest.
fn moves_lines_only(space: &Space, around: &Around) -> bool {
    space.blocks().iter().all(|block| {
        let own = block.velocity..block.velocity + block.kind.nv();
        block.kind == BlockKind::Line || around.half[own].iter().all(|x| *x == 0.0)
    })
}

/// The largest length of an offset that changes by `half` to both sides, or in each entry by itself.
fn farthest(offset: &[f64], half: &[f64], is_line: bool) -> f64 {
    let sums =
        |of: fn((&f64, &f64)) -> f64| -> Vec<f64> { offset.iter().zip(half).map(of).collect() };
    match is_line {
        true => length(&sums(|(x, h)| x + h)).max(length(&sums(|(x, h)| x - h))),
        false => length(&sums(|(x, h)| x.abs() + h.abs())),
    }
}
