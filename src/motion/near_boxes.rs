//! Which of eight boxes a piece does not part from one box, and how near these are.

use crate::boxes::{EightBoxes, PackedBox};
use crate::lanes::Instructions;
use crate::pair::{BoxSweep, GapsWanted, swept_gaps};

/// Those of eight boxes that a piece does not part from one box.
pub(super) struct NearBoxes {
    /// As bits; those taken are left out.
    lanes: u32,
    /// The gaps where boxes are compared.
    gaps: [f32; 8],
    /// What the motion takes off these.
    pub taken_off: [f32; 8],
    /// Half the diagonals of the eight.
    pub sizes: [f32; 8],
}

impl NearBoxes {
    /// Of the boxes that `among` names by its bits, those whose gap is not above `cutoff` all through the piece; `None` if there are none.
    #[inline(always)]
    pub fn of<I: Instructions>(
        lanes: I,
        eight: &EightBoxes<I>,
        one: &PackedBox,
        sweep: BoxSweep,
        cutoff: f32,
        among: u8,
    ) -> Option<Self> {
        let among = u32::from(among);
        let gaps = swept_gaps(lanes, eight, one, sweep, GapsWanted { cutoff, among });
        let near = lanes.not_above(gaps.swept, cutoff) & among;
        (near != 0).then(|| Self {
            lanes: near,
            gaps: lanes.array(gaps.still),
            taken_off: lanes.array(lanes.sub(gaps.still, gaps.swept)),
            sizes: lanes.array(lanes.sqrt(lanes.dot(&eight.half, &eight.half))),
        })
    }

    /// Takes those out that are farther apart, where they are compared, than `gap`; as bits.
    #[inline(always)]
    pub fn take_farther(&mut self, gap: f32) -> u8 {
        let mut taken = 0;
        for lane in 0..8 {
            if self.lanes >> lane & 1 == 1 && self.gaps[lane] > gap {
                taken |= 1 << lane;
            }
        }
        self.lanes &= !taken;
        taken as u8
    }

    /// Takes the first one out.
    #[inline(always)]
    pub fn take_first(&mut self) -> Option<usize> {
        if self.lanes == 0 {
            return None;
        }
        let lane = self.lanes.trailing_zeros() as usize & 7;
        self.lanes &= self.lanes - 1;
        Some(lane)
    }

    /// Takes the nearest one out, of boxes that overlap the one that does so most deeply.
    #[inline(always)]
    pub fn take_nearest(&mut self) -> Option<usize> {
        let left = (0..8).filter(|lane| self.lanes >> lane & 1 == 1);
        let lane = left.min_by(|&a, &b| self.gaps[a].total_cmp(&self.gaps[b]))?;
        self.lanes &= !(1 << lane);
        Some(lane)
    }
}
