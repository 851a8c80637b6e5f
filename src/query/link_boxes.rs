//! The boxes of a robot's links, eight side by side: most pairs of links are far from each other.

use crate::boxes::{BoxesByEight, PackedBox};
use crate::environment::{Bounds, BoxFrame, FrameLimits};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::bounds;
use crate::pose::Vec3;

/// The place of a link that has no box.
const NONE: u32 = u32::MAX;

/// Memory of [`LinkBoxes`], reused by the next query.
#[derive(Default)]
pub(crate) struct LinkBoxMemory {
    places: Vec<u32>,
    bounds: Vec<Bounds>,
    one: Vec<PackedBox>,
    eights: BoxesByEight,
}

/// The boxes around the links of some pairs.
pub(super) struct LinkBoxes<'m> {
    memory: &'m LinkBoxMemory,
    frame: BoxFrame,
}

impl<'m> LinkBoxes<'m> {
    /// The boxes of all links of the pairs that have a body. `bounds_of` gives a link's bounds.
    pub fn new(
        pairs: &[[usize; 2]],
        links: usize,
        memory: &'m mut LinkBoxMemory,
        bounds_of: impl Fn(usize) -> Option<Bounds>,
    ) -> Self {
        let LinkBoxMemory {
            places,
            bounds,
            one,
            eights,
        } = &mut *memory;
        places.clear();
        places.resize(links, NONE);
        bounds.clear();
        let mut center = None;
        let mut limits = FrameLimits::default();
        for &link in pairs.as_flattened() {
            if places[link] == NONE
                && let Some(found) = bounds_of(link)
            {
                places[link] = bounds.len() as u32;
                limits.take_in(center.get_or_insert_with(|| found.box_center()), &found);
                bounds.push(found);
            }
        }
        let center = center.unwrap_or_else(Vec3::zeros);
        let frame = BoxFrame::new(center, &limits, 2.0 * limits.deviation);
        one.clear();
        one.extend(bounds.iter().map(|bounds| frame.pack(bounds)));
        eights.clear();
        for packed in &*one {
            eights.push(packed);
        }
        Self { memory, frame }
    }

    /// Visits the pairs whose boxes may be within `limit` of each other, in their order, with safe lower bounds of the
    /// distances.
    pub fn visit_near(&self, pairs: &[[usize; 2]], limit: f64, visit: impl FnMut([usize; 2], f64)) {
        with_widest(VisitNear {
            boxes: self,
            pairs,
            limit,
            visit,
        });
    }

    fn place(&self, link: usize) -> Option<u32> {
        Some(self.memory.places[link]).filter(|&place| place != NONE)
    }
}

struct VisitNear<'a, 'm, V> {
    boxes: &'a LinkBoxes<'m>,
    pairs: &'a [[usize; 2]],
    limit: f64,
    visit: V,
}

impl<V: FnMut([usize; 2], f64)> Work for VisitNear<'_, '_, V> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        let LinkBoxes { memory, frame } = self.boxes;
        let cutoff = frame.cutoff(self.limit);
        // The eight that one link was tested against last: its partners come one after the other.
        let mut tested = ([NONE; 2], [f32::INFINITY; 8]);
        for &[r, s] in self.pairs {
            let (Some(at_r), Some(at_s)) = (self.boxes.place(r), self.boxes.place(s)) else {
                continue;
            };
            let names = [at_r, at_s / 8];
            if tested.0 != names {
                let eight = memory.eights.load(lanes, names[1]);
                let found = bounds(lanes, &eight, &memory.one[at_r as usize]);
                tested = (names, lanes.array(found));
            }
            let bound = tested.1[at_s as usize % 8];
            if bound > cutoff {
                continue;
            }
            // Where a link is far from the others, its box is placed less exactly than its ball.
            let [on_r, on_s] = [at_r, at_s].map(|place| &memory.bounds[place as usize]);
            let lower = on_r.distance(on_s)[0].max(frame.lower(bound));
            if lower <= self.limit {
                (self.visit)([r, s], lower);
            }
        }
    }
}
