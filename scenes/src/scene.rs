//! Moving scenes.

use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::Point;
use crate::random::Random;

/// A body that moves among obstacles that do not.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What to call it in tables: the report's code for it, and the seed if there is one.
    pub name: String,
    /// The moving body, in its own frame.
    pub moving: Mesh,
    /// The obstacles, in the frame of the world.
    pub obstacles: Vec<Mesh>,
    /// Where the moving body is, in order of time.
    pub poses: Vec<Pose>,
}

impl Scene {
    /// The scene with the whole world turned at random, so that no face is aligned with an axis any more.
    ///
    /// The vertices of all meshes are turned, the moving body's too, and the poses match; distances stay the same but
    /// for rounding.
    pub fn turned(&self, seed: u64) -> Scene {
        let mut random = Random::new(seed);
        let axis = random.direction();
        let angle = random.within(0.6, 2.5);
        let (turn, back) = (Pose::rotation(axis, angle), Pose::rotation(axis, -angle));
        let carried = |pose: &Pose| match pose.is_translation() {
            true => Pose::translation(turn.apply(pose.offset())),
            false => turn.compose(pose).compose(&back),
        };
        Scene {
            name: format!("{} turned {seed}", self.name),
            moving: self.moving.moved(&turn),
            obstacles: self.obstacles.iter().map(|m| m.moved(&turn)).collect(),
            poses: self.poses.iter().map(carried).collect(),
        }
    }
}

/// Small changes to a scene: none, or drawn from a seed.
pub(crate) struct Changes(Option<Random>);

impl Changes {
    /// No changes: the scene as designed.
    pub(crate) fn none() -> Changes {
        Changes(None)
    }

    /// The changes that belong to `seed`.
    pub(crate) fn seeded(seed: u64) -> Changes {
        Changes(Some(Random::new(seed)))
    }

    /// A number of at most `most` either way.
    pub(crate) fn number(&mut self, most: f64) -> f64 {
        self.0.as_mut().map_or(0.0, |r| r.within(-most, most))
    }

    /// `p` moved by at most `most` along each axis.
    pub(crate) fn point(&mut self, p: Point, most: f64) -> Point {
        p.map(|x| x + self.number(most))
    }
}
