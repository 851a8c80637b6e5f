//! Motions that a function gives.

use super::linear_motion::LinearMotion;
use super::motion::MotionOptions;
use super::motion_answer::MotionAnswer;
use super::stated_motion::{MotionBounds, MotionFunction, StatedMotion};
use super::way::{Way, WayKind};
use crate::cobject::CObject;
use crate::error::Result;
use crate::query::QueryContext;

impl QueryContext {
    /// The same as [`QueryContext::motion`] on a motion that a function gives, smooth but for jumps of its second derivative. The
    /// proof holds if the bounds do. They are compared with what the function gives wherever it is asked; it may be asked for any
    /// time, in any order. Coordinates on circles are not taken the shorter way round; those of quaternions must not change.
    pub fn motion_on_function(
        &mut self,
        cobject: &CObject,
        function: &dyn MotionFunction,
        bounds: &MotionBounds,
        options: &MotionOptions,
    ) -> Result<MotionAnswer> {
        let motion = &StatedMotion::new(cobject.space(), function, bounds)?;
        let world = &self.begin_motion(cobject, options)?;
        let line = LinearMotion {
            world,
            cobject,
            q: &motion.start,
            v: &motion.speeds(),
        };
        let way = &Way {
            line,
            end: None,
            kind: WayKind::Stated(motion),
        };
        MotionAnswer::or_undecided(self.motion_on(way, options), || motion.start.clone())
    }
}
