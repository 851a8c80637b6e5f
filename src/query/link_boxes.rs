//! The boxes of a robot's links, eight side by side: most pairs of links are far from each other.

use crate::body_bounds::{Bounds, BoxFrame, FrameLimits};
use crate::boxes::{BoxesByEight, PackedBox};
use crate::cobject::LinkRows;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::{bounds, gaps_of_balls};

/// The links' boxes, in memory that is reused by the next query.
#[derive(Default)]
pub(crate) struct LinkBoxes {
    one: Vec<PackedBox>,
    eights: BoxesByEight,
}

impl LinkBoxes {
    /// Visits the pairs whose boxes may be within `limit` of each other, with a safe lower and a safe upper bound of the distance.
    /// `visit` returns the limit from then on. `bounds` are those of all links of the space.
    pub fn visit_near(
        &mut self,
        rows: &LinkRows,
        bounds: &[Bounds],
        limit: f64,
        visit: impl FnMut([usize; 2], [f64; 2]) -> f64,
    ) {
        with_widest(VisitNear {
            boxes: self,
            rows,
            bounds,
            limit,
            visit,
        });
    }
}

struct VisitNear<'a, V> {
    boxes: &'a mut LinkBoxes,
    rows: &'a LinkRows,
    bounds: &'a [Bounds],
    limit: f64,
    visit: V,
}

impl<V: FnMut([usize; 2], [f64; 2]) -> f64> Work for VisitNear<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        let LinkRows { links, rows } = self.rows;
        let Some(&first) = links.first() else {
            return;
        };
        let frame = self.pack(links, &self.bounds[first]);
        let mut cutoff = frame.cutoff(self.limit);
        let LinkBoxes { one, eights } = self.boxes;
        for row in rows {
            let (eight, one) = (eights.load(lanes, row.eight), &one[row.first as usize]);
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
            let r = links[row.first as usize];
            while near != 0 {
                let lane = near.trailing_zeros() & 7;
                near &= near - 1;
                let s = links[(8 * row.eight + lane) as usize];
                // Where a link is far from the others, its box is placed less exactly than its ball.
                let [lower, upper] = self.bounds[r].distance(&self.bounds[s]);
                let lower = lower.max(frame.lower(found[lane as usize]));
                if lower <= self.limit {
                    self.limit = (self.visit)([r, s], [lower, upper]);
                }
            }
            cutoff = frame.cutoff(self.limit);
        }
    }
}

impl<V> VisitNear<'_, V> {
    /// Packs the boxes of the links in a frame around the first.
    #[inline(always)]
    fn pack(&mut self, links: &[usize], first: &Bounds) -> BoxFrame {
        let center = first.box_center;
        let mut limits = FrameLimits::default();
        for &link in links {
            limits.take_in(&center, &self.bounds[link]);
        }
        let frame = BoxFrame::new(center, &limits, 2.0 * limits.deviation);
        let LinkBoxes { one, eights } = &mut *self.boxes;
        one.clear();
        eights.clear();
        for &link in links {
            let packed = frame.pack(&self.bounds[link]);
            eights.push(&packed);
            one.push(packed);
        }
        frame
    }
}
