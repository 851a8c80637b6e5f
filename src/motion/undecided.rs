//! An interval of a motion that is undecided, and what of it is left when something is known.

use super::front::FrontPart;
use super::span::Span;

/// The work on a pair that goes on in the halves of an interval, times the interval's length: see `PairLook`. By the motion benchmark
/// from .5 to 16 within a tenth of each other on arms; without a limit hits of the UR10 take three times as long.
const WORK_PER_LENGTH: f64 = 1.0;

/// An interval of time, with what is undecided in it.
pub(super) struct Undecided {
    pub times: [f64; 2],
    pub part: FrontPart,
    /// Primitives nearly meet at its end.
    pub ends_near_contact: bool,
}

impl Undecided {
    /// The time at which bodies are compared.
    pub fn compared_at(&self) -> f64 {
        let [start, end] = self.times;
        if self.ends_near_contact {
            end
        } else {
            0.5 * (start + end)
        }
    }

    pub fn span(&self) -> Span {
        let [start, end] = self.times;
        if self.ends_near_contact {
            Span::Before(end - start)
        } else {
            Span::Around(0.5 * (end - start))
        }
    }

    /// What is spent on a pair that goes on in the halves: the shorter the interval, the more. So long intervals are not searched in
    /// vain, and what short ones decide is not decided again in too many still shorter ones.
    pub fn max_work(&self) -> u32 {
        let [start, end] = self.times;
        (WORK_PER_LENGTH / (end - start)) as u32
    }

    /// Adds what comes before a contact at `meeting`; the primitives that meet there are apart up to `apart`.
    pub fn before(&self, apart: f64, meeting: f64, part: FrontPart, todo: &mut Vec<Self>) {
        let [start, _] = self.times;
        let with = |times: [f64; 2], ends_near_contact: bool| Self {
            times,
            part,
            ends_near_contact,
        };
        if start < apart && apart < meeting {
            todo.push(with([apart, meeting], false));
            todo.push(with([start, apart], true));
        } else {
            todo.push(with([start, meeting], false));
        }
    }

    /// Adds both halves, the first of them last: it is looked at next.
    pub fn halve(&self, part: FrontPart, todo: &mut Vec<Self>) {
        let [start, end] = self.times;
        let middle = 0.5 * (start + end);
        let later = Self {
            times: [middle, end],
            part,
            ends_near_contact: self.ends_near_contact,
        };
        let first = Self {
            times: [start, middle],
            part,
            ends_near_contact: false,
        };
        todo.extend([later, first]);
    }
}
