//! The boxes of a robot's links, eight side by side: most pairs of links are far from each other.

use crate::body_bounds::{BoundsByEight, BoxFrame, ChosenBodies};
use crate::boxes::BoxesByEight;
use crate::cobject::LinkRows;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::{bounds, gaps_of_balls};

/// The boxes of links' bodies, in memory that is reused by the next query.
#[derive(Default)]
pub(crate) struct LinkBoxes(BoxesByEight);

impl LinkBoxes {
    /// Visits the pairs of bodies whose boxes may be within `limit` of each other, by their numbers, with a safe lower and a safe upper
    /// bound of the distance. `visit` returns the limit from then on. `bounds` are those of all bodies of the space.
    pub fn visit_near(
        &mut self,
        rows: &LinkRows,
        bounds: &BoundsByEight,
        limit: f64,
        visit: impl FnMut([usize; 2], [f64; 2]) -> f64,
    ) {
        with_widest(VisitNear {
            boxes: &mut self.0,
            rows,
            bounds,
            limit,
            visit,
        });
    }
}

struct VisitNear<'a, V> {
    boxes: &'a mut BoxesByEight,
    rows: &'a LinkRows,
    bounds: &'a BoundsByEight,
    limit: f64,
    visit: V,
}

impl<V: FnMut([usize; 2], [f64; 2]) -> f64> Work for VisitNear<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        let LinkRows { bodies, rows } = self.rows;
        let Some(first) = bodies.iter().next() else {
            return;
        };
        let chosen = ChosenBodies {
            first: 0,
            words: bodies.words(),
        };
        let center = self.bounds.get(first).box_center;
        let limits = self.bounds.limits(lanes, chosen, &center);
        let frame = BoxFrame::new(center, &limits, 2.0 * limits.deviation);
        self.bounds.pack(lanes, chosen, &frame, self.boxes);
        let mut cutoff = frame.cutoff(self.limit);
        for row in rows {
            let first = row.first as usize;
            let (eight, one) = (self.boxes.load(lanes, row.eight), &self.boxes.get(first));
            let seconds = u32::from(row.seconds);
            // Many are far even by the balls around the boxes, which takes far less.
            if lanes.at_most(gaps_of_balls(lanes, &eight, one), cutoff) & seconds == 0 {
                continue;
            }
            let found = bounds(lanes, &eight, one);
            let mut near = lanes.at_most(found, cutoff) & seconds;
            if near == 0 {
                continue;
            }
            let found = lanes.array(found);
            let bounds_of_first = self.bounds.get(first);
            while near != 0 {
                let lane = near.trailing_zeros() & 7;
                near &= near - 1;
                let second = (8 * row.eight + lane) as usize;
                // Where a link is far from the others, its box is placed less exactly than its ball.
                let [lower, upper] = bounds_of_first.distance(&self.bounds.get(second));
                let lower = lower.max(frame.lower(found[lane as usize]));
                if lower <= self.limit {
                    self.limit = (self.visit)([first, second], [lower, upper]);
                }
            }
            cutoff = frame.cutoff(self.limit);
        }
    }
}
