//! Slides that go on until they arrive or are blocked: what a local planner does between two subgoals.

use super::goal_box::GoalBox;
use super::motion::MotionOptions;
use super::motion_answer::MotionOutcome;
use super::slide::{Slid, SlideOutcome};
use super::slide_options::SlideOptions;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result, require_coordinates, require_finite};
use crate::nonzero;
use crate::query::{QueryContext, World};
use crate::space::Space;

/// Options of a slide that goes on. Lengths are those of velocities, each entry multiplied by its weight.
#[derive(Clone, Copy, Debug)]
pub struct SlideToOptions {
    /// Of each sliding step.
    pub slide: SlideOptions,
    /// The length of a sliding step, larger than 0.
    pub step: f64,
    /// No more sliding steps than this are taken; at least 1.
    pub max_steps: usize,
    /// The robot has arrived where it is no farther than this from the goal: at least 0.
    pub tolerance: f64,
    /// A sliding step that comes nearer to the goal by less than this part of `step` gains nothing: at least 0, less than 1.
    pub min_gain: f64,
    /// The slide ends after more than this many steps in a row that gain nothing. Corners take one or two.
    pub max_idle_steps: usize,
    /// The straight motion to the goal is tried at the start and after this many sliding steps; at least 1.
    pub steps_between_motions: usize,
}

impl SlideToOptions {
    /// The defaults for steps of a length along contacts within a shell.
    pub fn with_step(step: f64, max_shell: f64) -> Self {
        Self {
            slide: SlideOptions::with_shell(max_shell),
            step,
            max_steps: 1000,
            tolerance: 0.0,
            min_gain: 0.05,
            max_idle_steps: 3,
            steps_between_motions: 8,
        }
    }

    fn check(&self) -> Result<()> {
        self.slide.check()?;
        require_coordinates(&[self.step], "step")?;
        if self.step <= 0.0 {
            return Err(Error::invalid(format!(
                "step is {}; it must be larger than 0",
                self.step
            )));
        }
        require_coordinates(&[self.tolerance], "tolerance")?;
        if self.tolerance < 0.0 {
            return Err(Error::invalid(format!(
                "tolerance is negative: {}",
                self.tolerance
            )));
        }
        require_finite(&[self.min_gain], "min_gain")?;
        if !(0.0..1.0).contains(&self.min_gain) {
            return Err(Error::invalid(format!(
                "min_gain {} is not from 0 to less than 1",
                self.min_gain
            )));
        }
        for (count, name) in [
            (self.max_steps, "max_steps"),
            (self.steps_between_motions, "steps_between_motions"),
        ] {
            if count == 0 {
                return Err(Error::invalid(format!("{name} is 0")));
            }
        }
        Ok(())
    }
}

/// Why a slide ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlideToOutcome {
    /// In the goal, or no farther from it than the tolerance.
    Arrived,
    /// The start is inside the C-object.
    Inside,
    /// No sliding step is possible.
    Blocked,
    /// Steps are possible, but the last of them gained nothing.
    Idle,
    /// The number of steps is used up.
    Steps,
    /// The work of the call was limited (see [`QueryContext::set_limit`]).
    Limited,
}

/// Where a slide led.
#[derive(Clone, Debug)]
pub struct SlidPath {
    /// Why it ended.
    pub outcome: SlideToOutcome,
    /// The configurations from the start on, one after the other. Straight motions lead from each to the next.
    pub points: Vec<f64>,
    /// How far the last of them is from the goal.
    pub remaining: f64,
    /// How many sliding steps were tried.
    pub steps: usize,
    /// How many straight motions.
    pub motions: usize,
}

/// Before a first contact the robot stops by a step; the contact need not be known better than this part of the motion.
const CONTACT_TOLERANCE: f64 = 0.01;

/// A step that turned a circle by more than half a turn is taken again, this long: bent, lengthened and corrected it becomes at most eight
/// times as long.
const SAFE_TURN: f64 = std::f64::consts::PI / 10.0;

/// A robot under way.
struct Walk<'a> {
    world: &'a World,
    cobject: &'a CObject,
    goal: GoalBox<'a>,
    weights: Option<&'a [f64]>,
    options: &'a SlideToOptions,
    q: Vec<f64>,
    points: Vec<f64>,
    steps: usize,
    motions: usize,
}

impl Walk<'_> {
    fn space(&self) -> &Space {
        self.cobject.space()
    }

    fn target(&self) -> Vec<f64> {
        self.goal.nearest(&self.q)
    }

    fn remaining(&self) -> f64 {
        let target = self.target();
        self.space().distance(&self.q, &target, self.weights)
    }

    fn go(&mut self, to: Vec<f64>) {
        self.points.extend(&to);
        self.q = to;
    }

    /// The step towards a configuration.
    fn step_towards(&self, target: &[f64]) -> Vec<f64> {
        let way = self.space().distance(&self.q, target, self.weights);
        let part = (self.options.step / way).min(1.0);
        let difference = self.space().difference(&self.q, target);
        difference.iter().map(|x| x * part).collect()
    }

    /// Whether the shorter way to a configuration is the one that a slide took there: no circle was turned by half a turn.
    fn is_shorter_way(&self, to: &[f64]) -> bool {
        let space = self.space();
        space.difference(&self.q, to) == space.displacement(&self.q, to)
    }
}

impl QueryContext {
    /// Leads the robot from q towards the box of configurations from `goal[0]` to `goal[1]`: straight as far as that is proved free,
    /// sliding along contacts where it is not. Distances from the goal are measured as [`Space::distance`] does. `progress` receives
    /// the part of the steps that is used up, and may stop the work with an error.
    pub fn slide_to(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        goal: [&[f64]; 2],
        weights: Option<&[f64]>,
        options: &SlideToOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<SlidPath> {
        options.check()?;
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        let space = cobject.space();
        space.check_configuration(q)?;
        let goal = GoalBox::checked(space, goal[0], goal[1])?;
        if let Some(weights) = weights {
            space.check_weights(weights)?;
            if let Some(i) = weights.iter().position(|&weight| weight == 0.0) {
                return Err(Error::invalid(format!(
                    "weight {i} is 0; it must be larger than 0"
                )));
            }
        }
        let world = &self.look(cobject);
        let mut walk = Walk {
            world,
            cobject,
            goal,
            weights,
            options,
            q: q.to_vec(),
            points: q.to_vec(),
            steps: 0,
            motions: 0,
        };
        let outcome = match self.walk(&mut walk, progress) {
            Err(error) if error.kind == ErrorKind::Limit => SlideToOutcome::Limited,
            outcome => outcome?,
        };
        progress(1.0)?;
        let remaining = walk.remaining();
        Ok(SlidPath {
            // However the last step ended.
            outcome: if remaining <= options.tolerance {
                SlideToOutcome::Arrived
            } else {
                outcome
            },
            remaining,
            points: walk.points,
            steps: walk.steps,
            motions: walk.motions,
        })
    }

    fn walk(
        &mut self,
        walk: &mut Walk,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<SlideToOutcome> {
        let options = walk.options;
        let mut idle = 0;
        while walk.steps < options.max_steps {
            progress(walk.steps as f64 / options.max_steps as f64)?;
            let is_near = walk.remaining() <= options.step;
            if is_near || walk.steps.is_multiple_of(options.steps_between_motions) {
                self.go_straight(walk)?;
            }
            let before = walk.remaining();
            if before <= options.tolerance {
                return Ok(SlideToOutcome::Arrived);
            }
            let slid = self.slide_towards(walk)?;
            match slid.outcome {
                SlideOutcome::Moved => walk.go(slid.configuration),
                SlideOutcome::Inside => return Ok(SlideToOutcome::Inside),
                SlideOutcome::Blocked => return Ok(SlideToOutcome::Blocked),
            }
            let gain = before - walk.remaining();
            idle = if gain < options.min_gain * options.step {
                idle + 1
            } else {
                0
            };
            if idle > options.max_idle_steps {
                return Ok(SlideToOutcome::Idle);
            }
        }
        Ok(SlideToOutcome::Steps)
    }

    /// One sliding step towards the goal.
    fn slide_towards(&mut self, walk: &mut Walk) -> Result<Slid> {
        let mut step = walk.step_towards(&walk.target());
        walk.steps += 1;
        let slide = &walk.options.slide;
        let slid = self.slide_in(walk.world, walk.cobject, &walk.q, &step, slide)?;
        if walk.is_shorter_way(&slid.configuration) {
            return Ok(slid);
        }
        let part = SAFE_TURN / nonzero::length(&step);
        step.iter_mut().for_each(|x| *x *= part.min(1.0));
        self.slide_in(walk.world, walk.cobject, &walk.q, &step, slide)
    }

    /// Goes to the goal if the straight motion is proved free; else as far as it is, less a step.
    fn go_straight(&mut self, walk: &mut Walk) -> Result<()> {
        let space = walk.cobject.space();
        let target = walk.target();
        let way = space.distance(&walk.q, &target, walk.weights);
        if way == 0.0 || !space.contains(&walk.q)? || !space.contains(&target)? {
            return Ok(());
        }
        walk.motions += 1;
        let Some(times) = self.straight(walk, &target)? else {
            walk.go(target);
            return Ok(());
        };
        let part = times[0] - walk.options.step / way;
        if part <= 0.0 {
            return Ok(());
        }
        // The rounded place has a proof of its own.
        let before = space.interpolate(&walk.q, &target, part);
        if space.contains(&before)? && self.straight(walk, &before)?.is_none() {
            walk.go(before);
        }
        Ok(())
    }

    /// The times of contact on the straight motion to a configuration; `None` if it is proved free.
    fn straight(&mut self, walk: &Walk, to: &[f64]) -> Result<Option<[f64; 2]>> {
        let options = MotionOptions {
            tolerance: CONTACT_TOLERANCE,
            ..MotionOptions::default()
        };
        let ends = [&walk.q[..], to];
        let answer = self.motion_between_in(walk.world, walk.cobject, ends, &options)?;
        Ok((answer.outcome != MotionOutcome::Free).then_some(answer.times))
    }
}
