//! The boxes of one piece's look: those that stay apart fall away, near ones are opened, others are left to the halves.

use super::front::{Bundle, Group, Leaves};
use super::look::Look;
use super::near_boxes::NearBoxes;
use super::over_piece::PairOver;
use super::piece::Piece;
use crate::hierarchy::packed::{NodeRef, PackedTree};
use crate::lanes::Instructions;
use crate::pair::BoxSweep;

/// Boxes whose gap the motion may take off by more than this part of their sizes are left to the halves of the piece, others
/// are opened. Larger values open boxes that a smaller piece would part; smaller ones look at the same boxes again. On the arms of
/// benches/motion, free motions of 1 rad: half of this costs up to a third more in the median, twice of it changes less than a
/// tenth, four times of it costs up to a fifth more.
const OPEN_NODES_BELOW: f32 = 0.08;
/// The same for pairs of primitives. Twice and four times of it change less than a tenth there; of the hits some arms gain a quarter
/// in the median and others lose a sixth in the mean.
const MEASURE_LEAVES_BELOW: f32 = 0.04;

impl<P: Piece> Look<'_, '_, P> {
    /// Looks at the boxes of a bundle: those that stay apart fall away, near ones are opened, others left to the halves.
    #[inline(always)]
    pub(super) fn open_bundle<I: Instructions>(&mut self, lanes: I, mut bundle: Bundle) {
        if self.is_over() {
            self.front.bundles.push(bundle);
            return;
        }
        let crowd = &self.crowds[bundle.crowd as usize];
        let known = self.over.crowd.as_ref().map(|(number, _)| *number);
        if known != Some(bundle.crowd) {
            let made = crowd.over(self.pairs, self.piece);
            self.over.crowd = Some((bundle.crowd, made));
        }
        let Some((_, over)) = &self.over.crowd else {
            return;
        };
        let eight = crowd.boxes().load(lanes, bundle.eight);
        let sweep = BoxSweep {
            twists: over.twists.as_ref(),
            extension: over.extension,
            bends: over.bends,
        };
        self.scratch
            .meter_mut()
            .count_nodes(u64::from(bundle.lanes.count_ones()));
        let near = NearBoxes::of(lanes, &eight, &over.one, sweep, over.cutoff, bundle.lanes);
        let Some(mut near) = near else {
            return;
        };
        let size = length(&over.one.half);
        let mut left = 0u8;
        while let Some(lane) = near.take_first() {
            let pair = crowd.first_pair + 8 * bundle.eight + lane as u32;
            let [a, b] = self.pairs[pair as usize].bodies();
            let meeting = Meeting {
                pair,
                units: [a.packed().root(), b.packed().root()],
                sizes: [size, near.sizes[lane]],
                taken_off: near.taken_off[lane],
            };
            if !self.go_on(&meeting) {
                left |= 1 << lane;
            }
        }
        if left != 0 {
            bundle.lanes = left;
            self.front.bundles.push(bundle);
        }
    }

    /// Opens a pair of boxes, or visits the primitives in them. Of boxes that the motion moves far nothing is done, but for a complement:
    /// primitives that are near enough stay within the threshold, however large they are beside the motion.
    fn go_on(&mut self, meeting: &Meeting) -> bool {
        let Meeting {
            pair,
            units,
            sizes,
            taken_off,
        } = *meeting;
        let are_leaves = units[0].is_leaf() && units[1].is_leaf();
        let limit = if are_leaves {
            MEASURE_LEAVES_BELOW
        } else {
            OPEN_NODES_BELOW
        };
        let is_moved_far = !self.leaf.complement && taken_off > limit * (sizes[0] + sizes[1]);
        if is_moved_far || self.pair.is_left_to_halves(pair) {
            return false;
        }
        let [a, b] = self.pairs[pair as usize].bodies();
        let trees: [&PackedTree; 2] = [a.packed(), b.packed()];
        if are_leaves {
            self.visit(Leaves {
                pair,
                places: [trees[0].place(units[0]), trees[1].place(units[1])],
                direction: [0.0; 3],
            });
            return true;
        }
        let opens_b = if units[0].is_leaf() || units[1].is_leaf() {
            units[0].is_leaf()
        } else {
            sizes[1] > sizes[0]
        };
        let side = usize::from(opens_b);
        let node = trees[side].index(units[side]);
        self.front.open.push(Group {
            pair,
            node: node as u32,
            other: units[1 - side],
            opened: side as u8,
            lanes: ((1u32 << trees[side].node(node).count) - 1) as u8,
        });
        true
    }

    /// Looks at all groups that are open.
    #[inline(always)]
    pub(super) fn open_all<I: Instructions>(&mut self, lanes: I) {
        while let Some(group) = self.front.open.pop() {
            self.open(lanes, group);
        }
    }

    /// Looks at the children of a group: decided ones fall away, others are opened, visited, or left to the halves.
    #[inline(always)]
    fn open<I: Instructions>(&mut self, lanes: I, mut group: Group) {
        if self.is_over() {
            self.front.groups.push(group);
            return;
        }
        let number = group.pair as usize;
        if self.parts_hulls(group.pair, 1) {
            return;
        }
        let [a, b] = self.pairs[number].bodies();
        let over = self.over.of(number, self.pairs, self.piece);
        let over = match over {
            PairOver::Near(over) => over,
            PairOver::Apart => return,
            PairOver::TooLong => {
                self.front.groups.push(group);
                return;
            }
        };
        let trees: [&PackedTree; 2] = [a.packed(), b.packed()];
        let opened = usize::from(group.opened);
        let (tree, other_tree) = (trees[opened], trees[1 - opened]);
        let index = group.node as usize;
        let node = tree.node(index);
        let unit = over.motions[1 - opened].factor;
        let one = over.motions[opened].apply(lanes, other_tree.core_in_lanes(lanes, group.other));
        let eight = node.boxes(lanes, unit);
        let sweep = BoxSweep {
            twists: over.twists[opened].as_ref(),
            extension: over.extension,
            bends: [over.bends[opened], over.bends[1 - opened]],
        };
        self.scratch
            .meter_mut()
            .count_nodes(u64::from(group.lanes.count_ones()));
        self.pair.count(group.pair, 1);
        let near = NearBoxes::of(lanes, &eight, &one, sweep, over.cutoff, group.lanes);
        let Some(mut near) = near else {
            return;
        };
        let is_complement = self.leaf.complement;
        // What is to stay within the threshold is nearest at the middle: what is too far apart there is left to the halves.
        let mut left = match is_complement {
            true => near.take_farther(over.within),
            false => 0,
        };
        let radii = [over.core_radii[opened], over.core_radii[1 - opened]];
        let other_size = length(&one.half) + radii[1];
        let children = tree.children(lanes, index);
        let first_open = self.front.open.len();
        while let Some(lane) = match is_complement {
            true => near.take_nearest(),
            false => near.take_first(),
        } {
            let (mut units, mut sizes) = (
                [children.units[lane], group.other],
                [near.sizes[lane] + radii[0], other_size],
            );
            if opened == 1 {
                units.swap(0, 1);
                sizes.swap(0, 1);
            }
            let meeting = Meeting {
                pair: group.pair,
                units,
                sizes,
                taken_off: near.taken_off[lane],
            };
            if !self.go_on(&meeting) {
                left |= 1 << lane;
            }
        }
        if is_complement {
            // The one pushed last is opened first.
            self.front.open[first_open..].reverse();
        }
        if left != 0 {
            self.pair.leave(group.pair);
            group.lanes = left;
            self.front.groups.push(group);
        }
    }
}

/// Two boxes that the piece does not part.
struct Meeting {
    pair: u32,
    /// Of A and of B.
    units: [NodeRef; 2],
    /// Half the diagonals of the boxes, with what they leave out around cores.
    sizes: [f32; 2],
    /// What the motion takes off their gap.
    taken_off: f32,
}

fn length([x, y, z]: &[f32; 3]) -> f32 {
    (x * x + y * y + z * z).sqrt()
}
