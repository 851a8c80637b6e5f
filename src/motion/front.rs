//! The front of a proof: the pairs of boxes and primitives that a piece left undecided, an interval of a motion or a box of
//! configurations. A pair that a piece decides is never looked at again in its halves.

use super::crowd::Crowd;
use super::moving_pair::MovingPair;
use super::set_tree::SetVerdict;
use crate::hierarchy::packed::NodeRef;

/// Some children of a node against a unit of the other body.
#[derive(Clone, Copy)]
pub(super) struct Group {
    pub pair: u32,
    pub node: u32,
    pub other: NodeRef,
    /// Which body's node it is, 0 or 1.
    pub opened: u8,
    /// The children, as bits.
    pub lanes: u8,
}

/// Some of eight objects of a crowd against the body that moves among them.
#[derive(Clone, Copy)]
pub(super) struct Bundle {
    pub crowd: u32,
    pub eight: u32,
    /// The objects, as bits.
    pub lanes: u8,
}

/// Two primitives, and what parted them last: see [`SweptLeaves::Undecided`].
#[derive(Clone, Copy)]
pub(super) struct Leaves {
    pub pair: u32,
    pub places: [u32; 2],
    pub direction: [f32; 3],
}

/// A part of the front: what stands between two places of each list.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FrontPart {
    pub bundles: [usize; 2],
    pub groups: [usize; 2],
    pub leaves: [usize; 2],
    pub solids: [usize; 2],
    pub settled: [usize; 2],
}

/// The lists of all parts of the front. Each is in order of the set tree's leaves within a part.
#[derive(Default)]
pub(super) struct Front {
    pub bundles: Vec<Bundle>,
    pub groups: Vec<Group>,
    pub leaves: Vec<Leaves>,
    /// Pairs with a solid of which it is not known whether one body is inside the other.
    pub solids: Vec<u32>,
    /// Leaves of the set tree of which something is known through the whole piece.
    pub settled: Vec<(u32, SetVerdict)>,
    pub open: Vec<Group>,
}

impl Front {
    /// Begins with all pairs, those of crowds in bundles; `solids` where containment is to be followed.
    pub fn start(&mut self, pairs: &[MovingPair], crowds: &[Crowd], solids: bool) -> FrontPart {
        self.truncate(&FrontPart::default());
        self.open.clear();
        let mut number = 0;
        for (crowd, index) in crowds.iter().zip(0..) {
            self.add_pairs(pairs, number..crowd.first_pair);
            number = crowd.first_pair + crowd.boxes().len() as u32;
            self.bundles
                .extend(crowd.boxes().lanes().map(|(eight, lanes)| Bundle {
                    crowd: index,
                    eight,
                    lanes,
                }));
        }
        self.add_pairs(pairs, number..pairs.len() as u32);
        if solids {
            let with_solid = (0..).zip(pairs).filter(|(_, pair)| pair.has_solid());
            self.solids.extend(with_solid.map(|(number, _)| number));
        }
        self.part_after(&FrontPart::default())
    }

    fn add_pairs(&mut self, pairs: &[MovingPair], numbers: std::ops::Range<u32>) {
        for number in numbers {
            let [_, b] = pairs[number as usize].bodies();
            self.groups.push(Group {
                pair: number,
                node: 0,
                other: b.packed().root(),
                opened: 0,
                lanes: 1,
            });
        }
    }

    /// What stands behind a part.
    pub fn part_after(&self, part: &FrontPart) -> FrontPart {
        FrontPart {
            bundles: [part.bundles[1], self.bundles.len()],
            groups: [part.groups[1], self.groups.len()],
            leaves: [part.leaves[1], self.leaves.len()],
            solids: [part.solids[1], self.solids.len()],
            settled: [part.settled[1], self.settled.len()],
        }
    }

    /// What of a part stands from a cursor on and is of one leaf of the set tree; the cursor moves behind it. `is_of` says whether a pair,
    /// given its number, is of the leaf.
    pub fn share(
        &self,
        part: &FrontPart,
        cursor: &mut FrontPart,
        crowds: &[Crowd],
        is_of: impl Fn(u32) -> bool,
    ) -> FrontPart {
        let is_bundle_of = |bundle: &Bundle| is_of(crowds[bundle.crowd as usize].first_pair);
        FrontPart {
            bundles: run_of(
                &self.bundles,
                part.bundles,
                &mut cursor.bundles,
                is_bundle_of,
            ),
            groups: run_of(&self.groups, part.groups, &mut cursor.groups, |g| {
                is_of(g.pair)
            }),
            leaves: run_of(&self.leaves, part.leaves, &mut cursor.leaves, |l| {
                is_of(l.pair)
            }),
            solids: run_of(&self.solids, part.solids, &mut cursor.solids, |s| is_of(*s)),
            settled: [0; 2],
        }
    }

    /// The numbers of the pairs that a part has undecided; of a crowd that of its first. Some come more than once.
    pub fn undecided(&self, part: &FrontPart, crowds: &[Crowd]) -> impl Iterator<Item = u32> {
        let [bundles, groups, leaves] =
            [part.bundles, part.groups, part.leaves].map(|[first, end]| first..end);
        let bundles = self.bundles[bundles].iter();
        bundles
            .map(|bundle| crowds[bundle.crowd as usize].first_pair)
            .chain(self.groups[groups].iter().map(|group| group.pair))
            .chain(self.leaves[leaves].iter().map(|leaf| leaf.pair))
            .chain(self.solids[part.solids[0]..part.solids[1]].iter().copied())
    }

    /// Forgets what stands behind a part.
    pub fn truncate(&mut self, part: &FrontPart) {
        self.bundles.truncate(part.bundles[1]);
        self.groups.truncate(part.groups[1]);
        self.leaves.truncate(part.leaves[1]);
        self.solids.truncate(part.solids[1]);
        self.settled.truncate(part.settled[1]);
    }
}

/// The places of a list from a cursor on that are of something, up to the end of a part; the cursor moves behind them.
#[inline(always)]
fn run_of<T>(
    list: &[T],
    [_, end]: [usize; 2],
    cursor: &mut [usize; 2],
    is_of: impl Fn(&T) -> bool,
) -> [usize; 2] {
    let first = cursor[0];
    let run = list[first..end].iter().take_while(|item| is_of(item));
    cursor[0] += run.count();
    [first, cursor[0]]
}
