//! Pairs of primitives as the traversal comes upon them: measured if they may matter, and shown to the visitor.

use std::ops::ControlFlow;

use super::pair_distance::{BeyondCutoff, PairDistance, PrimitiveScratch};
use super::pairing::{MovedOutline, Pairing};
use super::visitor::{PrimitivePair, Visitor, Wanted};
use crate::convex::{Beyond, Outline};
use crate::gjk::DistanceLimits;
use crate::lanes::{Instructions, Work};
use crate::pose::Vec3;
use crate::work_meter::WorkMeter;

/// What visits leave to the next ones: memory, directions that parted pairs, the work done.
#[derive(Default)]
pub(super) struct State {
    pub(super) primitives: PrimitiveScratch,
    /// The unit direction from B to A, in A's frame, at the nearest pair so far, or zero; and that pair's distance.
    pub(super) direction: Vec3,
    pub(super) direction_at: f64,
    /// The same direction for the pair that was measured last, near or not.
    pub(super) last_direction: Vec3,
    /// The primitive of B whose outline is in the buffer.
    pub(super) moved: Option<MovedPlane>,
    pub(super) meter: WorkMeter,
}

/// A transformed outline without its corners, which are in the buffer.
#[derive(Clone, Copy)]
pub(super) struct MovedPlane {
    place: u32,
    corners: usize,
    normal: Vec3,
    offset: f64,
}

/// Shows the visitor primitive pairs of two bodies.
pub(super) struct PairVisits<'a> {
    pub(super) pairing: &'a Pairing<'a>,
    pub(super) buffer: &'a mut MovedOutline,
    pub(super) state: &'a mut State,
    visitor: &'a mut dyn Visitor,
    /// What the visitor wants to see.
    pub(super) wanted: Wanted,
}

impl<'a> PairVisits<'a> {
    pub(super) fn new(
        pairing: &'a Pairing<'a>,
        buffer: &'a mut MovedOutline,
        state: &'a mut State,
        visitor: &'a mut dyn Visitor,
    ) -> Self {
        state.direction = Vec3::zeros();
        state.direction_at = f64::INFINITY;
        state.last_direction = Vec3::zeros();
        state.moved = None;
        Self {
            pairing,
            buffer,
            state,
            wanted: visitor.wanted(),
            visitor,
        }
    }

    /// Visits the primitives at two places, unless they are beyond the bound. With `aims`, the direction between the nearest
    /// pair so far becomes the separating direction tried on later pairs.
    #[inline(always)]
    pub(super) fn visit<I: Instructions>(
        &mut self,
        lanes: I,
        places: [u32; 2],
        aims: bool,
    ) -> ControlFlow<()> {
        let cutoff = self.wanted.bound + self.pairing.slack();
        self.state.meter.count_primitives(1);
        let moved = &mut self.state.moved;
        let outline = moved_outline(lanes, self.pairing, places[1], self.buffer, moved);
        let outlines = self.pairing.outline_a(lanes, places[0]).zip(outline);
        if let Some((a, b)) = &outlines {
            for direction in [&self.state.direction, &self.state.last_direction] {
                let direction: [f64; 3] = (*direction).into();
                if a.extent_along(&direction).0 - b.extent_along(&direction).1 > cutoff {
                    return ControlFlow::Continue(());
                }
            }
        }
        self.state.meter.done.primitive_distances += 1;
        let primitives = &mut self.state.primitives;
        let limits = DistanceLimits {
            enough: self.wanted.enough,
            cutoff,
        };
        let direction = self.state.direction;
        let found = self
            .pairing
            .distance_to(lanes, places, &outline, &direction, limits, primitives);
        let apart = match found {
            Ok(apart) => apart,
            Err(BeyondCutoff::Outlines(nearest)) => {
                if let (Some((a, b)), Some(nearest)) = (&outlines, nearest) {
                    self.state.last_direction = unit(&nearest.across(a, b));
                }
                return ControlFlow::Continue(());
            }
            // Where all pairs are beyond the bound, the nearest of them is the best to aim along. Of polygons it gains nothing.
            Err(BeyondCutoff::Others(Beyond { direction, gap })) => {
                if aims && gap < self.state.direction_at {
                    (self.state.direction, self.state.direction_at) = (direction, gap);
                }
                return ControlFlow::Continue(());
            }
        };
        if aims && apart.distance < self.state.direction_at {
            self.state.direction_at = apart.distance;
            self.state.direction = if apart.distance > 0.0 {
                let across = match (&outlines, apart.nearest, &apart.measured) {
                    (Some((a, b)), Some(nearest), _) => unit(&nearest.across(a, b)),
                    (_, _, Some(measured)) => {
                        let [on_a, on_b] = measured.closest.points;
                        on_a - on_b
                    }
                    _ => Vec3::zeros(),
                };
                unit(&across)
            } else {
                Vec3::zeros()
            };
        }
        self.show(places, &apart)
    }

    /// The same as `visit` for primitives of which at least one has no outline.
    pub(super) fn visit_without_outlines(&mut self, places: [u32; 2]) -> ControlFlow<()> {
        let limits = DistanceLimits {
            enough: self.wanted.enough,
            cutoff: self.wanted.bound + self.pairing.slack(),
        };
        self.state.meter.count_primitives(1);
        self.state.meter.done.primitive_distances += 1;
        let primitives = &mut self.state.primitives;
        let nowhere = Vec3::zeros();
        match self
            .pairing
            .measured_apart(places, &nowhere, limits, primitives)
        {
            Ok(apart) => self.show(places, &apart),
            Err(_) => ControlFlow::Continue(()),
        }
    }

    /// Visits a pair whose distance is known.
    fn show(&mut self, places: [u32; 2], apart: &PairDistance) -> ControlFlow<()> {
        let pair = self.pairing.primitive_pair(places, apart.distance);
        let pair = PrimitivePair {
            error: pair.error + apart.doubt,
            measured: apart.measured.as_ref(),
            ..pair
        };
        let visited = self.visitor.visit(&pair, &mut self.state.meter);
        self.wanted = self.visitor.wanted();
        visited
    }
}

/// The outline of a primitive of B in A's frame, if it has one. Reuses the buffer if the last call was for the same primitive.
#[inline(always)]
fn moved_outline<'b, I: Instructions>(
    lanes: I,
    pairing: &Pairing,
    place: u32,
    buffer: &'b mut MovedOutline,
    moved: &mut Option<MovedPlane>,
) -> Option<Outline<'b, I>> {
    if let Some(plane) = moved
        && plane.place == place
    {
        return Some(Outline {
            lanes,
            blocks: &buffer[..plane.corners.div_ceil(4)],
            corners: plane.corners,
            normal: plane.normal,
            offset: plane.offset,
        });
    }
    let outline = pairing.outline_b(lanes, place, buffer);
    *moved = outline.map(|outline| MovedPlane {
        place,
        corners: outline.corners,
        normal: outline.normal,
        offset: outline.offset,
    });
    outline
}

/// The unit vector along another; zero for zero.
#[inline(always)]
fn unit(across: &Vec3) -> Vec3 {
    across.try_normalize(0.0).unwrap_or_else(Vec3::zeros)
}

pub(super) struct SinglePair<'a> {
    pub(super) visits: PairVisits<'a>,
    pub(super) places: [u32; 2],
}

impl Work for SinglePair<'_> {
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) -> ControlFlow<()> {
        self.visits.visit(lanes, self.places, false)
    }
}
