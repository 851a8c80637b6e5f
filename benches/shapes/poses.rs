//! Where the bodies are placed.

use std::f64::consts::TAU;

use cstk_scenes::{Point, Pose, Random};

use super::ours::Ours;
use super::placement::Placement;

/// From a body's middle to its farthest point, at most.
const REACH: f64 = 0.7;

/// Nearer than this counts as touching when a body comes in.
const TOUCH: f64 = 1e-9;

#[derive(Clone, Copy, PartialEq)]
pub enum Motion {
    /// Each pose is independent of the one before.
    Random,
    /// Once round the other body in small steps, turning once, in and out twice.
    Coherent,
    /// Independent, both bodies turned about the vertical alone, as what stands on one floor.
    Upright,
    /// Independent, both turned by quarters alone: faces and axes are parallel.
    Aligned,
    /// Independent, on one another.
    Touching,
    /// The same, both turned by quarters alone.
    Resting,
    /// About one middle, both turned by quarters alone.
    Centred,
}

impl Motion {
    pub fn name(self) -> &'static str {
        match self {
            Motion::Random => "random",
            Motion::Coherent => "coherent",
            Motion::Upright => "upright",
            Motion::Aligned => "aligned",
            Motion::Touching => "touching",
            Motion::Resting => "resting",
            Motion::Centred => "centred",
        }
    }
}

/// `count` placements, in which the first body was brought in along a line through the other's middle until they touched, and
/// then moved back, or on as far as the other's middle, by a number out of `gaps` (those below 0 are depths).
pub fn placements(
    ours: &Ours,
    motion: Motion,
    gaps: [f64; 2],
    count: usize,
    seed: u64,
) -> Vec<Placement> {
    let random = &mut Random::new(seed);
    let first = Approach::drawn(random, motion, gaps);
    let axes = [random.direction(), random.direction()];
    (0..count)
        .map(|k| {
            let approach = match motion {
                Motion::Coherent => first.moved_on(k as f64 / count as f64, axes, gaps),
                independent => Approach::drawn(random, independent, gaps),
            };
            approach.placed(ours)
        })
        .collect()
}

fn turn(random: &mut Random, motion: Motion) -> Pose {
    let about = |axis: usize, angle: f64| {
        let along = std::array::from_fn(|k| f64::from(u8::from(k == axis)));
        Pose::rotation(along, angle)
    };
    match motion {
        Motion::Random | Motion::Coherent | Motion::Touching => random.rotation(),
        Motion::Upright => about(2, random.within(0.0, TAU)),
        Motion::Aligned | Motion::Resting | Motion::Centred => {
            (0..3).fold(Pose::identity(), |pose, axis| {
                let quarters = (random.bits() % 4) as f64;
                pose.compose(&about(axis, quarters * TAU / 4.0))
            })
        }
    }
}

/// How the first body comes to the other.
struct Approach {
    /// Of the other body.
    at: Pose,
    turn: Pose,
    direction: Point,
    gap: f64,
}

impl Approach {
    fn drawn(random: &mut Random, motion: Motion, gaps: [f64; 2]) -> Self {
        let at = Pose::translation(random.point(1.0));
        Self {
            at: at.compose(&turn(random, motion)),
            turn: turn(random, motion),
            direction: random.direction(),
            gap: random.within(gaps[0], gaps[1]),
        }
    }

    /// A share of the way round.
    fn moved_on(&self, share: f64, [round, turned]: [Point; 2], [low, high]: [f64; 2]) -> Self {
        let wave = (2.0 * TAU * share + 1.0).sin();
        Self {
            at: self.at,
            turn: Pose::rotation(turned, TAU * share).compose(&self.turn),
            direction: Pose::rotation(round, TAU * share).apply(self.direction),
            gap: 0.5 * (low + high) + 0.5 * (high - low) * wave,
        }
    }

    fn placed(&self, ours: &Ours) -> Placement {
        let at = |away: f64| {
            let offset = self.direction.map(|x| away * x);
            let relative = Pose::translation(offset).compose(&self.turn);
            Placement {
                poses: [self.at.compose(&relative).0, self.at.0],
            }
        };
        // It can come in by as much as it is away.
        let mut away = 2.0 * REACH;
        loop {
            let distance = ours.distance(&at(away));
            away -= distance;
            if distance < TOUCH || away < 0.0 {
                break;
            }
        }
        at((away + self.gap).max(0.0))
    }
}
