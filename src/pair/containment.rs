//! Which pieces of one body lie wholly inside the other, a solid.
//!
//! A piece is connected: if it does not meet the boundary, it is inside or outside as any one of its points is.

use std::ops::ControlFlow;

use super::box_bounds::ROUNDING;
use super::hit::{Hit, HitKey, Inner};
use super::near_primitives::NearPrimitives;
use super::pairing::Pairing;
use super::shortlist::Ranked;
use super::traversal::{Scratch, traverse};
use super::visitor::{PrimitivePair, Visitor, Wanted};
use super::winding::{RayScratch, winding};
use crate::body::{Body, Piece, Solid};
use crate::boxes::PackedBox;
use crate::lanes::{cross3, each3};
use crate::pose::{Pose, Vec3};
use crate::work_meter::WorkMeter;

/// A piece with a point inside a solid.
#[derive(Clone, Copy)]
struct Candidate {
    inner: Inner,
    piece: u32,
    /// The lowest primitive of the piece and the lowest of the piece around it, A's first.
    primitives: [u32; 2],
}

impl<'a> Pairing<'a> {
    /// Whether one of the bodies is a solid, so that the other could be inside.
    #[inline(always)]
    pub fn has_solid(&self) -> bool {
        self.a.solid().is_some() || self.b.solid().is_some()
    }

    /// Whether a piece of one body lies inside the other, or meets it.
    pub fn is_one_inside(&self, scratch: &mut Scratch) -> bool {
        let mut found = false;
        self.visit_candidates(scratch, |_| {
            found = true;
            ControlFlow::Break(())
        });
        found
    }

    /// The pieces of either body that lie wholly inside the other, as hits of the given body pair, in the order of their
    /// representative primitives.
    pub fn contained(&self, pair: u32, scratch: &mut Scratch) -> Vec<Hit> {
        let mut candidates = Vec::new();
        self.visit_candidates(scratch, |candidate| {
            candidates.push(candidate);
            ControlFlow::Continue(())
        });
        if candidates.is_empty() {
            return Vec::new();
        }
        // Discards the candidates that meet the boundary.
        let mut filter = BoundaryFilter {
            pairing: self,
            candidates,
        };
        let _ = traverse(self, None, scratch, &mut filter);
        let mut found: Vec<Hit> = filter.candidates.iter().map(|c| c.hit(pair)).collect();
        found.sort_unstable_by(Hit::order);
        found
    }

    /// A point of the contained piece of a hit, in the world; the same for both bodies.
    pub fn points_inside(&self, inner: Inner, hit: &Hit) -> [Vec3; 2] {
        let primitive = hit.key.primitives[inner as usize];
        let start = self
            .body(inner)
            .primitives()
            .get(primitive as usize)
            .vertices[0];
        let at_home = match inner {
            Inner::A => start,
            Inner::B => self.relative.transform_point(&start),
        };
        [self.frame.transform_point(&at_home); 2]
    }

    fn body(&self, inner: Inner) -> &'a Body {
        match inner {
            Inner::A => self.a,
            Inner::B => self.b,
        }
    }

    /// Visits the pieces that have a point inside the other body, until the visitor breaks or the meter's limit is exceeded.
    fn visit_candidates(
        &self,
        scratch: &mut Scratch,
        mut visit: impl FnMut(Candidate) -> ControlFlow<()>,
    ) {
        for inner in [Inner::A, Inner::B] {
            let outer = self.body(inner.other());
            let Some(solid) = outer.solid() else {
                continue;
            };
            let into_outer = match inner {
                Inner::A => self.relative.inverse(),
                Inner::B => self.relative,
            };
            let ball = self.body(inner).packed().whole().ball();
            let outside = solid
                .extent()
                .outside(&into_outer.transform_point(&ball.center));
            if outside > ball.radius + self.slack() {
                continue;
            }
            let near = &mut scratch.rays.near;
            for number in self.pieces_near(inner, solid, &into_outer, near) {
                let piece = &self.body(inner).piece(number);
                let around = around(outer, piece, &into_outer, &mut scratch.rays);
                scratch.count_rays();
                if scratch.meter().is_exceeded() {
                    return;
                }
                let Some(around) = around else {
                    continue;
                };
                let primitives = match inner {
                    Inner::A => [piece.lowest, around],
                    Inner::B => [around, piece.lowest],
                };
                let candidate = Candidate {
                    inner,
                    piece: number,
                    primitives,
                };
                if visit(candidate).is_break() {
                    return;
                }
            }
        }
    }
}

impl Pairing<'_> {
    /// The pieces whose lowest primitive may meet the box of a solid, in order; all others are outside.
    fn pieces_near(
        &self,
        inner: Inner,
        solid: &Solid,
        into_outer: &Pose,
        near: &mut NearPrimitives,
    ) -> Vec<u32> {
        // At most this many pieces are tested without the tree.
        const MAX_LINEAR: usize = 8;
        let body = self.body(inner);
        let all = 0..body.piece_count() as u32;
        let tree = body.packed();
        let unit = tree.scale();
        let extent = solid.extent();
        let into_inner = into_outer.inverse();
        let center = into_inner.transform_point(&extent.center()) / unit;
        let half = 0.5 * extent.size() / unit;
        let size = 1.0 + center.norm() + half.norm();
        // Beyond this size, boxes lose all meaning in single precision.
        const LARGE: f64 = 1e30;
        if all.len() <= MAX_LINEAR || size > LARGE {
            return all.collect();
        }
        let (x, y) = (into_inner.rotation.column(0), into_inner.rotation.column(1));
        let (x, y) = (each3(|k| x[k] as f32), each3(|k| y[k] as f32));
        let one = PackedBox {
            axes: [x, y, cross3(&x, &y)],
            center: each3(|k| center[k] as f32),
            half: each3(|k| (half[k] as f32).next_up()),
        };
        let error = 2.0 * ROUNDING * size + self.slack() / unit;
        let lowest = near.find(tree, one, error).iter().filter_map(|&primitive| {
            let piece = body.piece_of(primitive);
            (body.piece(piece).lowest == primitive).then_some(piece)
        });
        lowest.collect()
    }
}

/// The lowest primitive of the solid's piece that winds around the first end of a piece.
fn around(outer: &Body, piece: &Piece, pose: &Pose, rays: &mut RayScratch) -> Option<u32> {
    let [start, end] = piece.ends.map(|end| pose.transform_point(&end));
    if outer.solid()?.extent().outside(&end) > 0.0 {
        return None;
    }
    let found = winding(outer, &start, rays);
    let piece = found.piece.filter(|_| found.number != 0)?;
    Some(outer.piece(piece).lowest)
}

impl Candidate {
    fn hit(&self, pair: u32) -> Hit {
        Hit {
            distance: 0.0,
            apart: 0.0,
            key: HitKey {
                pair,
                primitives: self.primitives,
            },
            places: [0; 2],
            contained: Some(self.inner),
        }
    }
}

/// Drops the candidates that meet the boundary of the solid around them.
struct BoundaryFilter<'a> {
    pairing: &'a Pairing<'a>,
    candidates: Vec<Candidate>,
}

impl Visitor for BoundaryFilter<'_> {
    fn wanted(&self) -> Wanted {
        Wanted::MEETING
    }

    fn visit(&mut self, pair: &PrimitivePair, _: &mut WorkMeter) -> ControlFlow<()> {
        if pair.apart <= pair.error {
            let pairing = self.pairing;
            self.candidates.retain(|candidate| {
                let inner = candidate.inner;
                let [own, other] = [inner, inner.other()].map(|of| pair.primitives[of as usize]);
                let is_boundary = |solid: &Solid| solid.sign(other) != 0;
                pairing.body(inner).piece_of(own) != candidate.piece
                    || !pairing.body(inner.other()).solid().is_some_and(is_boundary)
            });
        }
        match self.candidates.is_empty() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}
