//! Motion bounds of pure sets: how much a distance can fall along a segment of C-space.

use super::{PureSet, PureShape};
use crate::nonzero::{length, product};
use crate::robot::{Block, BlockKind, Coordinate};
use crate::space::Space;

impl PureSet {
    /// Splits a floor or the world box into one set per link, so that each link has its own distance and contact. Other
    /// sets are returned as they are.
    pub fn by_link(&self) -> Vec<Self> {
        match &self.shape {
            PureShape::Floor {
                links,
                normal,
                offset,
            } => {
                let of_link = |&link: &usize| PureShape::Floor {
                    links: vec![link],
                    normal: *normal,
                    offset: *offset,
                };
                self.with_shapes(links.iter().map(of_link))
            }
            PureShape::BeyondWorld { links } => {
                let of_link = |&link: &usize| PureShape::BeyondWorld { links: vec![link] };
                self.with_shapes(links.iter().map(of_link))
            }
            _ => vec![self.clone()],
        }
    }

    /// The sets that a proof checks one by one along a segment whose ends are in the coordinates' ranges. Of limits these
    /// are half-spaces that bound the positions of free joints. Coordinates that are `straight` (asked of limits alone) stay between their
    /// values at the ends.
    pub fn parts_on_way(&self, space: &Space, straight: impl FnOnce() -> Vec<usize>) -> Vec<Self> {
        match &self.shape {
            PureShape::BeyondLimits => {
                self.with_shapes(position_limits(space, &straight()).into_iter())
            }
            _ => self.by_link(),
        }
    }

    fn with_shapes(&self, shapes: impl Iterator<Item = PureShape>) -> Vec<Self> {
        let with = |shape: PureShape| Self {
            shape,
            ..self.clone()
        };
        shapes.map(with).collect()
    }

    /// Bounds how much the distance falls on the way from q with velocity v for a unit of time, both ends within the
    /// coordinates' ranges. Infinite for predicates, and where a custom joint does not state its speeds.
    pub fn motion_bound(&self, space: &Space, q: &[f64], v: &[f64]) -> f64 {
        match &self.shape {
            PureShape::Predicate(_) => f64::INFINITY,
            PureShape::Floor { links, .. } => {
                let links = links.iter().map(|&link| space.motion_bound(link, q, v));
                links.fold(0.0, f64::max)
            }
            PureShape::BeyondWorld { links } => {
                let origin = |&link: &usize| space.motion_bound_of_radius(link, 0.0, q, v);
                links.iter().map(origin).fold(0.0, f64::max)
            }
            PureShape::BeyondLimits => {
                let parts = self.parts_on_way(space, || space.straight(q, v).collect());
                let bounds = parts.iter().map(|part| part.motion_bound(space, q, v));
                bounds.fold(0.0, f64::max)
            }
            PureShape::Box { low, high } => {
                let is_bounded = |c: usize| low[c].is_finite() || high[c].is_finite();
                product(self.scale(), box_bound(space, is_bounded, v))
            }
            PureShape::HalfSpace { normal, .. } => {
                product(self.scale(), half_space_bound(space, normal, v))
            }
            PureShape::Ball { .. } => product(self.scale(), length(v)),
        }
    }
}

/// The half-spaces outside the ranges of free joints' positions, but for those that go straight.
fn position_limits(space: &Space, straight: &[usize]) -> Vec<PureShape> {
    let mut half_spaces = Vec::new();
    for block in placements(space) {
        for c in block.coordinate..block.coordinate + 3 {
            let Coordinate::Interval { lower, upper } = space.coordinates()[c] else {
                continue;
            };
            if straight.contains(&c) {
                continue;
            }
            for (end, sign) in [(lower, 1.0), (upper, -1.0)] {
                if end.is_finite() {
                    let mut normal = vec![0.0; space.nq()];
                    normal[c] = sign;
                    half_spaces.push(PureShape::HalfSpace {
                        normal,
                        offset: sign * end,
                        is_open: true,
                    });
                }
            }
        }
    }
    half_spaces
}

fn placements(space: &Space) -> impl Iterator<Item = &Block> {
    let blocks = space.blocks().iter();
    blocks.filter(|block| block.kind == BlockKind::Placement)
}

/// The length of the motion in the coordinates that the box bounds.
fn box_bound(space: &Space, is_bounded: impl Fn(usize) -> bool, v: &[f64]) -> f64 {
    let mut whole = 0.0;
    for block in space.blocks() {
        let count = block.kind.lines();
        if (block.coordinate..block.coordinate + count).any(&is_bounded) {
            whole = length(&[whole, length(&v[block.velocity..block.velocity + count])]);
        }
    }
    whole
}

/// Bounds how much the distance falls. Single coordinates change it at a constant rate, counted with its sign; positions of
/// free joints by at most the product of the lengths.
fn half_space_bound(space: &Space, normal: &[f64], v: &[f64]) -> f64 {
    let (mut bound, mut size) = (0.0, 0.0);
    let whole = length(normal);
    for block in space.blocks() {
        let (c, k) = (block.coordinate, block.velocity);
        let falls = match block.kind {
            BlockKind::Line => product(-normal[c] / whole, v[k]),
            BlockKind::Rotation => 0.0,
            BlockKind::Placement => {
                product(length(&normal[c..c + 3]) / whole, length(&v[k..k + 3]))
            }
        };
        bound += falls;
        size += falls.abs();
    }
    // Slack for the rounding of terms that cancel.
    let rounding = space.nv() as f64 * f64::EPSILON * size;
    (bound + rounding).max(0.0)
}
