//! The states of links at one time of a motion.

use smallvec::SmallVec;

use super::LinkMotions;
use super::course::CourseState;
use super::motion_state::{MotionColumns, MotionState};
use crate::lanes::{Instructions, Work, with_widest};

/// The states of links at one time, each computed when it is first asked for.
#[derive(Debug, Default)]
pub struct LinkStates {
    time: f64,
    /// The space's coordinates at this time, where a function gives them.
    given: Vec<CourseState>,
    states: Vec<MotionState>,
    /// Which of them are of this time.
    is_known: Vec<bool>,
}

impl LinkStates {
    /// Begins a new time, at which no link's state is known.
    pub fn start(&mut self, motions: &LinkMotions, time: f64) {
        self.time = time;
        self.is_known.clear();
        self.is_known.resize(motions.len(), false);
        self.states.resize(motions.len(), MotionState::REST);
    }

    /// Where the coordinates of the time that began are to be put, for motions that a function gives.
    pub fn given_mut(&mut self) -> &mut Vec<CourseState> {
        &mut self.given
    }

    /// A link's state. Only of links whose motion is known.
    pub fn of(&mut self, motions: &LinkMotions, link: usize) -> &MotionState {
        if !self.is_known[link] {
            with_widest(FindState {
                states: self,
                motions,
                link,
            });
        }
        &self.states[link]
    }
}

/// Finds the state of a link, and of those that carry it, that is not known yet.
struct FindState<'a> {
    states: &'a mut LinkStates,
    motions: &'a LinkMotions,
    link: usize,
}

impl Work for FindState<'_> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) {
        let Self {
            states,
            motions,
            link,
        } = self;
        let mut path: SmallVec<[usize; 16]> = SmallVec::new();
        let mut next = Some(link);
        while let Some(index) = next.filter(|&index| !states.is_known[index]) {
            path.push(index);
            next = motions.parent(index);
        }
        let from = next.map_or(&MotionState::REST, |index| &states.states[index]);
        let mut state = MotionColumns::of(lanes, from);
        for index in path.into_iter().rev() {
            motions.advance(&mut state, index, states.time, &states.given);
            states.states[index] = state.state();
            states.is_known[index] = true;
        }
    }
}
