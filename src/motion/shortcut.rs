//! Paths made shorter by proofs (Geraerts and Overmars 2007 compare such methods): a straight motion that is proved free replaces the part
//! of a path between two places on it.

use super::motion::MotionOptions;
use super::motion_answer::MotionOutcome;
use super::path::{Path, PathAnswer, checked_count};
use crate::cobject::CObject;
use crate::error::{ErrorKind, Result};
use crate::query::{QueryContext, World};
use crate::room::room_for;
use crate::space::{Sampler, Space};

/// How a path is made shorter.
#[derive(Clone, Copy, Debug)]
pub struct ShortcutOptions {
    /// So many pairs of places are tried.
    pub attempts: usize,
    /// The places are drawn with this seed.
    pub seed: u64,
    /// What comes at most this near counts as contact, as in [`MotionOptions`].
    pub threshold: f64,
}

impl Default for ShortcutOptions {
    fn default() -> Self {
        Self {
            attempts: 100,
            seed: 0,
            threshold: 0.0,
        }
    }
}

/// How the work on a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShortcutOutcome {
    /// All attempts were made, or there is nothing left to cut.
    Done,
    /// The work of the call was limited (see [`QueryContext::set_limit`]); the path is what was reached.
    Limited,
    /// The given path is not proved free. It was not changed.
    NotFree,
}

/// A shortened path.
#[derive(Clone, Debug)]
pub struct Shortcut {
    /// How the work ended.
    pub outcome: ShortcutOutcome,
    /// One configuration after the other. Unless the given path is not free, every segment is proved free.
    pub points: Vec<f64>,
    /// The lengths of the given path and of this one, as [`Space::distance`] measures.
    pub lengths: [f64; 2],
    /// How many times the path was cut.
    pub cuts: usize,
    /// What was found of the given path.
    pub given: PathAnswer,
}

/// A cut that saves less than this part of the path is left: rounding of lengths could take back what it gains.
const MIN_GAIN: f64 = 1e-9;

/// A path while it is cut.
struct Cutting<'a> {
    space: &'a Space,
    points: Vec<Vec<f64>>,
    /// Of the segments: segment i leads from point i to the next.
    lengths: Vec<f64>,
}

/// A place on a path.
struct Place {
    segment: usize,
    q: Vec<f64>,
}

impl<'a> Cutting<'a> {
    fn new(space: &'a Space, points: Vec<Vec<f64>>) -> Self {
        let lengths = lengths_of(space, &points);
        Self {
            space,
            points,
            lengths,
        }
    }

    fn length(&self) -> f64 {
        self.lengths.iter().sum()
    }

    /// The place after a length of the path. Ends of segments are points of the path to the last bit.
    fn place(&self, mut away: f64) -> Place {
        let last = self.lengths.len() - 1;
        let mut segment = 0;
        while segment < last && away >= self.lengths[segment] {
            away -= self.lengths[segment];
            segment += 1;
        }
        let [from, to] = [0, 1].map(|i| &self.points[segment + i]);
        let t = away / self.lengths[segment];
        let q = if away <= 0.0 {
            from.clone()
        } else if t < 1.0 {
            self.space.interpolate(from, to, t)
        } else {
            to.clone()
        };
        Place { segment, q }
    }

    /// Both ends of the path.
    fn ends(&self) -> [Place; 2] {
        [0, self.lengths.len() - 1].map(|segment| Place {
            segment,
            q: self.points[segment + segment.min(1)].clone(),
        })
    }

    /// The start of one place's segment, and the end of another's.
    fn around(&self, from: &Place, to: &Place) -> [&[f64]; 2] {
        [&self.points[from.segment], &self.points[to.segment + 1]]
    }

    /// The points that replace those around two places.
    fn cut(&self, [from, to]: &[Place; 2]) -> Vec<Vec<f64>> {
        let [before, after] = self.around(from, to);
        let mut points = [before, &from.q, &to.q, after]
            .map(<[f64]>::to_vec)
            .to_vec();
        points.dedup();
        points
    }

    /// Replaces the points around two places by others, with the lengths between them.
    fn replace(&mut self, [from, to]: &[Place; 2], points: Vec<Vec<f64>>, lengths: Vec<f64>) {
        self.points.splice(from.segment..=to.segment + 1, points);
        self.lengths.splice(from.segment..=to.segment, lengths);
    }
}

fn lengths_of(space: &Space, points: &[Vec<f64>]) -> Vec<f64> {
    let pairs = points.windows(2);
    pairs
        .map(|two| space.distance(&two[0], &two[1], None))
        .collect()
}

impl QueryContext {
    /// Makes a path shorter: for each attempt two places on it are drawn, uniformly by length, and what is between them is replaced by
    /// the straight motion if that is shorter and, with what is left of the two segments, proved free. The first attempt is from end
    /// to end. The path is proved first; its ends stay where they are. The same call has the same answer. The limit of work counts for
    /// the whole call. `progress` receives the part of the work that is done, and may stop it with an error.
    pub fn path_shortcut(
        &mut self,
        cobject: &CObject,
        points: &[f64],
        options: &ShortcutOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Shortcut> {
        let motion = &MotionOptions {
            threshold: options.threshold,
            any_contact: true,
            ..MotionOptions::default()
        };
        let space = cobject.space();
        let count = checked_count(space, points)?;
        let world = &self.begin_motion(cobject, motion)?;
        let path = &Path {
            world,
            cobject,
            points,
        };
        let steps = path.segment_count().saturating_add(options.attempts);
        let mut done = 0;
        let mut step = || {
            progress(done as f64 / steps as f64)?;
            done += 1;
            Ok(())
        };
        let given = self.prove_segments(path, motion, &mut step)?;
        let mut all = room_for(count)?;
        all.extend((0..count).map(|i| path.point(i).to_vec()));
        let mut cutting = Cutting::new(space, all);
        let before = cutting.length();
        let mut cuts = 0;
        let outcome = if given.motion.outcome != MotionOutcome::Free {
            ShortcutOutcome::NotFree
        } else {
            let set = (world, cobject);
            match self.cut_corners(set, &mut cutting, options, motion, &mut cuts, &mut step) {
                Err(error) if error.kind == ErrorKind::Limit => ShortcutOutcome::Limited,
                done => done.map(|()| ShortcutOutcome::Done)?,
            }
        };
        progress(1.0)?;
        Ok(Shortcut {
            outcome,
            lengths: [before, cutting.length()],
            points: cutting.points.concat(),
            cuts,
            given,
        })
    }

    fn cut_corners(
        &mut self,
        set: (&World, &CObject),
        cutting: &mut Cutting,
        options: &ShortcutOptions,
        motion: &MotionOptions,
        cuts: &mut usize,
        step: &mut dyn FnMut() -> Result<()>,
    ) -> Result<()> {
        let mut random = Sampler(options.seed);
        for attempt in 0..options.attempts {
            let whole = cutting.length();
            // What rests, or leads straight, has nothing to cut.
            if cutting.points.len() < 3 || whole == 0.0 {
                return Ok(());
            }
            step()?;
            let places = &match attempt {
                0 => cutting.ends(),
                _ => {
                    let mut away = [random.unit(), random.unit()].map(|part| part * whole);
                    away.sort_by(f64::total_cmp);
                    away.map(|away| cutting.place(away))
                }
            };
            if places[0].segment == places[1].segment {
                continue;
            }
            let points = cutting.cut(places);
            let replaced = &cutting.lengths[places[0].segment..=places[1].segment];
            let lengths = lengths_of(cutting.space, &points);
            let gain = replaced.iter().sum::<f64>() - lengths.iter().sum::<f64>();
            if gain > MIN_GAIN * whole && self.may_cut(set, cutting, places, motion)? {
                cutting.replace(places, points, lengths);
                *cuts += 1;
            }
        }
        Ok(())
    }

    /// Whether the motion between two places is proved free, and what is left of their segments: that ends at rounded places.
    fn may_cut(
        &mut self,
        set: (&World, &CObject),
        cutting: &Cutting,
        [from, to]: &[Place; 2],
        motion: &MotionOptions,
    ) -> Result<bool> {
        let [before, after] = cutting.around(from, to);
        Ok(self.leads_freely(set, [&from.q, &to.q], motion)?
            && self.leads_freely(set, [before, &from.q], motion)?
            && self.leads_freely(set, [&to.q, after], motion)?)
    }

    /// Whether the motion is proved free; one that rests leads nowhere.
    fn leads_freely(
        &mut self,
        (world, cobject): (&World, &CObject),
        [from, to]: [&[f64]; 2],
        options: &MotionOptions,
    ) -> Result<bool> {
        if from == to {
            return Ok(true);
        }
        let answer = self.motion_between_in(world, cobject, [from, to], options)?;
        if answer.outcome == MotionOutcome::Undecided {
            self.scratch.meter().check()?;
        }
        Ok(answer.outcome == MotionOutcome::Free)
    }
}
