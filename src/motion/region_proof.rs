//! The proof that a box of configurations keeps out of a set: boxes are halved until bounds over them part all pairs of boxes and
//! primitives, and all pure sets.

use super::box_piece::BoxPiece;
use super::front::{Front, FrontPart};
use super::linear_motion::LinearMotion;
use super::look::Look;
use super::moving_set::{Middle, MovingSet};
use super::over_pairs::OverPairs;
use super::over_piece::ManyTwists;
use super::pair_look::PairLook;
use super::pair_rates::PairRatesMemory;
use super::set_tree::SetVerdict;
use super::way::{Way, WayKind};
use crate::cobject::CObject;
use crate::error::Result;
use crate::lanes::{Instructions, Work, with_widest};
use crate::query::{QueryContext, World};
use crate::space::Space;

/// Sides of boxes no longer than this part of the whole box's are not halved: over them hardly anything moves by more than rounding.
const SHORTEST_SIDE: f64 = 1.0 / (1u64 << 40) as f64;

/// The configurations tried when a box is not proved at once: contacts are cheaper to find by chance than by halving.
const SAMPLES: usize = 16;

/// How much work goes into a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxWork {
    /// How many parts it is halved into at most.
    pub max_boxes: usize,
    /// How many configurations are tried if it is not proved at once.
    pub samples: usize,
}

impl BoxWork {
    /// With configurations that are tried.
    pub fn sampled(max_boxes: usize) -> Self {
        Self {
            max_boxes,
            samples: SAMPLES,
        }
    }
}

/// The work on a pair that goes on in the halves of a box, times the part of the volume: see `PairLook`.
const WORK_PER_VOLUME: f64 = 64.0;

/// The most undecided pairs that are asked which coordinate moves them most.
const MAX_ASKED_PAIRS: usize = 64;

/// A box of configurations: one interval for each coordinate, in which angles do not wrap.
#[derive(Clone, Debug)]
pub(super) struct Region {
    pub low: Vec<f64>,
    pub high: Vec<f64>,
}

/// The middle of a box, and its half widths.
pub(super) struct Center {
    pub q: Vec<f64>,
    /// One entry per velocity: those of a free joint's position stand with its linear velocities.
    pub half: Vec<f64>,
}

impl Region {
    /// The half widths are rounded up: every configuration of the box is within them of the middle.
    pub fn center(&self, space: &Space) -> Center {
        let mut q = self.low.clone();
        let mut half = vec![0.0; space.nv()];
        for (k, c) in coordinates_of_velocities(space) {
            let [low, high] = [self.low[c], self.high[c]];
            if low < high {
                q[c] = 0.5 * (low + high);
                half[k] = (q[c] - low).max(high - q[c]).next_up();
            }
        }
        Center { q, half }
    }

    /// The way through it from its centre.
    pub fn way<'a>(
        &'a self,
        world: &'a World,
        cobject: &'a CObject,
        center: &'a Center,
    ) -> Way<'a> {
        Way {
            line: LinearMotion {
                world,
                cobject,
                q: &center.q,
                v: &center.half,
            },
            end: None,
            kind: WayKind::Box {
                low: &self.low,
                high: &self.high,
            },
        }
    }

    /// The configuration at the given parts of the sides, from 0 to 1.
    fn at(&self, part: impl Fn(usize) -> f64) -> Vec<f64> {
        let ends = self.low.iter().zip(&self.high).enumerate();
        ends.map(|(c, (&low, &high))| (low + part(c) * (high - low)).clamp(low, high))
            .collect()
    }

    /// Both ends, then points that fill the box evenly: multiples of the powers of 1 / g, where g is the root of
    /// g^(n+1) = g + 1 (Roberts 2018).
    fn samples(&self, count: usize) -> impl Iterator<Item = Vec<f64>> {
        let dimensions = self.low.iter().zip(&self.high).filter(|(l, h)| l < h);
        let dimensions = dimensions.count() as i32;
        let mut ratio = 2.0f64;
        for _ in 0..40 {
            ratio = (1.0 + ratio).powf(1.0 / f64::from(dimensions + 1));
        }
        (0..count).map(move |i| match i {
            0 => self.low.clone(),
            1 => self.high.clone(),
            _ => {
                let mut number = 0;
                let parts: Vec<f64> = (self.low.iter().zip(&self.high))
                    .map(|(low, high)| {
                        number += i32::from(low < high);
                        (0.5 + i as f64 * ratio.powi(-number)).fract()
                    })
                    .collect();
                self.at(|c| parts[c])
            }
        })
    }
}

/// The velocities whose coordinates may have a width, with these coordinates.
pub(super) fn coordinates_of_velocities(space: &Space) -> impl Iterator<Item = (usize, usize)> {
    space.blocks().iter().flat_map(|block| {
        let count = block.kind.lines();
        (0..count).map(|i| (block.velocity + i, block.coordinate + i))
    })
}

/// How a proof over a box ended.
#[derive(Debug)]
pub(super) enum BoxProof {
    /// No configuration of the box is in the set.
    Free,
    /// This one is, certainly.
    Meets(Vec<f64>),
    /// The work ended, or some part is too small to be halved.
    Undecided {
        /// The middle of the part that was looked at last, or of one that is too small.
        at: Vec<f64>,
        /// The part of the volume that is proved.
        proved: f64,
    },
}

/// A box that is left to be proved.
struct Rest {
    region: Region,
    part: FrontPart,
    /// The part of the whole box's volume.
    volume: f64,
}

/// What a proof over a box is about.
pub(super) struct RegionProof<'a> {
    pub world: &'a World,
    pub cobject: &'a CObject,
    pub set: &'a MovingSet<'a>,
    pub region: &'a Region,
    pub work: BoxWork,
}

/// Asked for a configuration: whether the set is certainly met there.
pub(super) type ConfirmAt<'c> = dyn FnMut(&mut QueryContext, &[f64]) -> Result<bool> + 'c;

/// Proves that no configuration of a box is in a set, or finds one that is.
pub(super) fn prove_region(
    proof: RegionProof,
    context: &mut QueryContext,
    confirm: &mut ConfirmAt,
) -> Result<BoxProof> {
    with_widest(Prover {
        proof,
        context,
        confirm,
    })
}

struct Prover<'a, 'c, 'd> {
    proof: RegionProof<'a>,
    context: &'a mut QueryContext,
    confirm: &'c mut ConfirmAt<'d>,
}

/// What the looks at all parts of a box share.
struct Lists<'a> {
    front: Front,
    over: OverPairs<'a, ManyTwists>,
    verdicts: Vec<SetVerdict>,
    memory: Vec<SetVerdict>,
    rates: PairRatesMemory,
    whole_half: Vec<f64>,
}

/// What a look at a part of a box has shown.
enum Looked {
    Free,
    /// The set is met at this configuration of the whole box, certainly.
    Meets(Vec<f64>),
    /// What is left, and the coordinate at whose middle it is halved, if any can be.
    Left(FrontPart, Option<usize>),
    /// The work ended.
    Exceeded,
}

impl Work for Prover<'_, '_, '_> {
    type Output = Result<BoxProof>;

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) -> Result<BoxProof> {
        let RegionProof {
            cobject,
            set,
            region,
            work: BoxWork { max_boxes, .. },
            ..
        } = self.proof;
        let space = cobject.space();
        let mut lists = Lists {
            front: Front::default(),
            over: OverPairs::new(set.pairs.len(), Default::default()),
            verdicts: vec![SetVerdict::Undecided; set.leaves.len()],
            memory: Vec::new(),
            rates: PairRatesMemory::default(),
            whole_half: region.center(space).half,
        };
        let follows_solids = !set.tree.is_plain_union();
        let mut todo = vec![Rest {
            region: region.clone(),
            part: lists.front.start(&set.pairs, &set.crowds, follows_solids),
            volume: 1.0,
        }];
        let (mut proved, mut boxes) = (0.0, 0);
        let mut undecided = None;
        while let Some(rest) = todo.pop() {
            let center = rest.region.center(space);
            if boxes == max_boxes || self.context.scratch.meter().is_exceeded() {
                return Ok(BoxProof::Undecided {
                    at: center.q,
                    proved,
                });
            }
            boxes += 1;
            let (left, halved) = match self.look_at(lanes, &rest, &center, &mut lists)? {
                Looked::Free => {
                    proved += rest.volume;
                    continue;
                }
                Looked::Exceeded => {
                    return Ok(BoxProof::Undecided {
                        at: center.q,
                        proved,
                    });
                }
                Looked::Meets(at) => return Ok(BoxProof::Meets(at)),
                Looked::Left(left, halved) => (left, halved),
            };
            match halved {
                Some(c) => todo.extend(rest.halves(c, center.q[c], left)),
                // It cannot be halved any more. Another part may still have a contact.
                None => undecided = Some(center.q),
            }
        }
        Ok(match undecided {
            Some(at) => BoxProof::Undecided { at, proved },
            None => BoxProof::Free,
        })
    }
}

impl<'a> Prover<'a, '_, '_> {
    /// Looks at a part of the box.
    #[inline(always)]
    fn look_at<I: Instructions>(
        &mut self,
        lanes: I,
        rest: &Rest,
        center: &Center,
        lists: &mut Lists<'a>,
    ) -> Result<Looked> {
        let RegionProof { world, cobject, .. } = self.proof;
        let way = &rest.region.way(world, cobject, center);
        let motions = &way.link_motions();
        let poses = &way.link_poses(0.0)?;
        let rates = std::mem::take(&mut lists.rates);
        let mut piece = BoxPiece::new(way, motions, poses, rates);
        let looked = self.look_with(lanes, rest, way, &mut piece, lists);
        lists.rates = piece.into_memory();
        looked
    }

    /// The same, with the pairs as they are over the part.
    #[inline(always)]
    fn look_with<I: Instructions>(
        &mut self,
        lanes: I,
        rest: &Rest,
        way: &Way,
        piece: &mut BoxPiece,
        lists: &mut Lists<'a>,
    ) -> Result<Looked> {
        let set = self.proof.set;
        lists.verdicts.fill(SetVerdict::Undecided);
        let mut look = Look {
            pairs: &set.pairs,
            crowds: &set.crowds,
            over: &mut lists.over,
            piece,
            front: &mut lists.front,
            scratch: &mut self.context.scratch,
            verdicts: &mut lists.verdicts,
            leaf: Default::default(),
            pair: PairLook::new((WORK_PER_VOLUME / rest.volume) as u32),
            met: None,
            is_grazed: false,
        };
        let at = Middle {
            way: Some(way),
            time: 0.0,
        };
        let whole = set.look_at_all(lanes, &mut look, &rest.part, at, &mut lists.memory)?;
        let left = look.left(&rest.part);
        // Parts over which nothing can be said of pairs take work without a look at boxes.
        let asked = 1 + lists.over.asked();
        self.context.scratch.meter_mut().count_nodes(asked);
        if self.context.scratch.meter().is_exceeded() {
            return Ok(Looked::Exceeded);
        }
        if whole == SetVerdict::Free {
            return Ok(Looked::Free);
        }
        let middle = way.line.q;
        if let Some(at) = self.meeting(whole, middle, rest.volume == 1.0)? {
            return Ok(Looked::Meets(at));
        }
        let mut shares = vec![0.0; way.line.v.len()];
        lists.front.raise_shares(&left, set, piece, &mut shares);
        let halved = widest(way, shares, &lists.whole_half);
        Ok(Looked::Left(left, halved))
    }

    /// Where the set is certainly met: at the middle of a part, if a look there says so, or for the whole box at one of the samples.
    fn meeting(
        &mut self,
        verdict: SetVerdict,
        middle: &[f64],
        is_whole: bool,
    ) -> Result<Option<Vec<f64>>> {
        if verdict == SetVerdict::Meets && (self.confirm)(self.context, middle)? {
            return Ok(Some(middle.to_vec()));
        }
        if !is_whole {
            return Ok(None);
        }
        let RegionProof { region, work, .. } = self.proof;
        for sample in region.samples(work.samples) {
            if (self.confirm)(self.context, &sample)? {
                return Ok(Some(sample));
            }
        }
        Ok(None)
    }
}

impl Rest {
    /// The halves that a coordinate's middle makes, the lower one last.
    fn halves(self, c: usize, middle: f64, part: FrontPart) -> [Self; 2] {
        let [mut lower, mut upper] = [self.region.clone(), self.region];
        lower.high[c] = middle;
        upper.low[c] = middle;
        [upper, lower].map(|region| Self {
            region,
            part,
            volume: 0.5 * self.volume,
        })
    }
}

impl Front {
    fn raise_shares(
        &self,
        left: &FrontPart,
        set: &MovingSet,
        piece: &mut BoxPiece,
        shares: &mut [f64],
    ) {
        let mut asked = 0;
        let mut last = None;
        for number in self.undecided(left, &set.crowds) {
            if last == Some(number) {
                continue;
            }
            last = Some(number);
            piece.raise_shares(&set.pairs[number as usize], shares);
            asked += 1;
            if asked == MAX_ASKED_PAIRS {
                return;
            }
        }
    }
}

/// The coordinate with the largest share; where no pair tells, the one that moves the robot most. `None` if its side
/// is too short to be halved.
fn widest(way: &Way, mut shares: Vec<f64>, whole_half: &[f64]) -> Option<usize> {
    let space = way.line.cobject.space();
    let (q, half) = (way.line.q, way.line.v);
    if shares.iter().all(|share| *share == 0.0) {
        let mut alone = vec![0.0; half.len()];
        for (k, share) in shares.iter_mut().enumerate() {
            alone[k] = half[k];
            let moved = (0..space.link_count()).map(|link| space.motion_bound(link, q, &alone));
            let moved = moved.filter(|moved| moved.is_finite());
            *share = moved.fold(half[k], f64::max);
            alone[k] = 0.0;
        }
    }
    let can_be_halved = |k: usize, c: usize| {
        half[k] > SHORTEST_SIDE * whole_half[k] && q[c] - half[k] < q[c] && q[c] < q[c] + half[k]
    };
    coordinates_of_velocities(space)
        .filter(|&(k, c)| shares[k] > 0.0 && can_be_halved(k, c))
        .max_by(|a, b| shares[a.0].total_cmp(&shares[b.0]))
        .map(|(_, c)| c)
}
