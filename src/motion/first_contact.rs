//! When two primitives on a motion begin to meet.

use super::kinematics::Kinematics;
use super::moving_pair::MovingPair;
use crate::error::Result;
use crate::pair::Scratch;

/// The most times that are looked at.
const MAX_LOOKS: u32 = 24;

/// Two primitives that meet at one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MeetingLeaves {
    pub pair: u32,
    pub places: [u32; 2],
}

/// A time at which primitives are apart, and how far.
#[derive(Clone, Copy)]
struct Apart {
    time: f64,
    /// Beyond the threshold.
    by: f64,
}

impl MeetingLeaves {
    /// Narrows two times, of which the primitives meet at the second, to at most `wanted` around the time at which they begin to.
    /// All before the first need not be free: this is a guess of where contact is, for the proof to confirm.
    pub fn narrowed(
        &self,
        pairs: &[MovingPair],
        kinematics: &mut Kinematics,
        [start, end]: [f64; 2],
        wanted: f64,
        scratch: &mut Scratch,
    ) -> Result<[f64; 2]> {
        let pair = &pairs[self.pair as usize];
        let (mut from, mut to) = (start, end);
        let mut known: Option<Apart> = None;
        // The root of the line through the last two distances.
        let mut root: Option<f64> = None;
        for look in 0..MAX_LOOKS {
            if to - from <= wanted || scratch.meter().is_exceeded() {
                break;
            }
            let middle = 0.5 * (from + to);
            let time = match root {
                // Behind the root and before it in turn, so that both ends close in; sometimes the middle, where the line misleads.
                Some(root) if look % 4 != 3 => {
                    let aside = if look % 2 == 0 { 0.4 } else { -0.4 };
                    let aimed = root + aside * wanted;
                    if from < aimed && aimed < to {
                        aimed
                    } else {
                        middle
                    }
                }
                _ if look == 0 => from + 1e-3 * (to - from),
                _ => middle,
            };
            match self.apart_at(pair, kinematics, time, scratch)? {
                None => to = time,
                Some(by) => {
                    from = time;
                    let now = Apart { time, by };
                    if let Some(before) = known
                        && before.by > now.by
                        && now.time > before.time
                    {
                        let rate = (before.by - now.by) / (now.time - before.time);
                        root = Some(now.time + now.by / rate);
                    }
                    known = Some(now);
                }
            }
        }
        Ok([from, to])
    }

    /// How far the primitives are beyond the threshold at a time; `None` where they meet.
    fn apart_at(
        &self,
        pair: &MovingPair,
        kinematics: &mut Kinematics,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<Option<f64>> {
        if time < pair.followed_from {
            return Ok(Some(f64::INFINITY));
        }
        kinematics.start(time)?;
        let pairing = pair.pairing(kinematics);
        scratch.count_primitive_pair();
        let distance = pairing.distance_of_leaves(self.places, scratch.for_primitives());
        let lower = distance - pairing.precision.error;
        let by = lower - pair.threshold;
        Ok((lower > 0.0 && by > 0.0).then_some(by))
    }
}
