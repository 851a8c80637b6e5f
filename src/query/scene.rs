//! The world at a configuration.

use std::cell::{Cell, OnceCell};
use std::sync::Arc;

use super::target::Placement;
use super::world::World;
use crate::body_bounds::{Bounds, BoundsByEight};
use crate::cobject::{Induced, SpaceState};
use crate::environment::{Attachment, SObject};
use crate::error::{Error, Result};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Pose;
use crate::reused::emptied;
use crate::robot::RobotState;
use crate::space::Space;

/// Where the robot is: by its coordinates, or by the pose of every link of the space.
#[derive(Clone, Copy, Debug)]
pub enum Configuration<'a> {
    /// The coordinates of the space.
    Coordinates(&'a [f64]),
    /// The pose of every link, in the world.
    LinkPoses(&'a [Pose]),
}

/// The world at one configuration: link poses, and snapshots of the environments.
pub struct Scene<'a> {
    space: &'a Space,
    q: Option<&'a [f64]>,
    /// Link poses given by the caller; else they are in `computed`.
    given: Option<&'a [Pose]>,
    computed: Vec<Pose>,
    world: &'a World,
    /// Attached s-objects, in order of their environments' serials.
    held: Vec<AttachedObject<'a>>,
    /// See [`Scene::bounds`].
    bounds: OnceCell<BoundsByEight>,
    bounds_memory: Cell<BoundsByEight>,
}

/// Memory of a scene, reused by the next.
#[derive(Default)]
pub struct SceneMemory {
    poses: Vec<Pose>,
    held: Vec<AttachedObject<'static>>,
    bounds: BoundsByEight,
}

/// An s-object attached to a link, with its pose in the world.
pub struct AttachedObject<'a> {
    /// The serial number of its environment.
    pub environment: u64,
    pub object: &'a SObject,
    pub attachment: &'a Attachment,
    pub pose: Pose,
}

/// The induced sets of a union, which are searched together.
pub type Group = [Arc<Induced>];

impl<'a> Scene<'a> {
    pub fn new(
        space: &'a Space,
        world: &'a World,
        configuration: Configuration<'a>,
        memory: SceneMemory,
    ) -> Result<Self> {
        let mut computed = memory.poses;
        let (q, given) = match configuration {
            Configuration::Coordinates(q) => {
                space.check_configuration(q)?;
                computed.resize(space.link_count(), Pose::IDENTITY);
                space.write_link_poses(q, &mut computed)?;
                (Some(q), None)
            }
            Configuration::LinkPoses(poses) => {
                space.check_link_poses(poses.len())?;
                if let Some(link) = poses.iter().position(|pose| !pose.is_planar())
                    && space.dimension() == 2
                {
                    return Err(Error::invalid(format!(
                        "the pose of link {link} leaves the plane z = 0 of its robot"
                    )));
                }
                (None, Some(poses))
            }
        };
        let poses = given.unwrap_or(&computed);
        let mut held = emptied(memory.held);
        let attached = world
            .attached(space)
            .map(|(environment, object, attachment)| AttachedObject {
                environment,
                object,
                attachment,
                pose: poses[attachment.link].compose(&object.pose),
            });
        held.extend(attached);
        Ok(Self {
            space,
            q,
            given,
            computed,
            world,
            held,
            bounds: OnceCell::new(),
            bounds_memory: Cell::new(memory.bounds),
        })
    }

    pub fn into_memory(self) -> SceneMemory {
        SceneMemory {
            poses: self.computed,
            held: emptied(self.held),
            bounds: (self.bounds.into_inner()).unwrap_or_else(|| self.bounds_memory.take()),
        }
    }

    /// The pose of every link of the space.
    #[inline]
    pub fn poses(&self) -> &[Pose] {
        self.given.unwrap_or(&self.computed)
    }

    pub fn version(&self) -> u64 {
        self.world.version()
    }

    /// The configuration in the form that pure sets take.
    pub fn space_state(&self) -> SpaceState<'_> {
        SpaceState {
            space: self.space,
            q: self.q,
            poses: self.poses(),
        }
    }

    /// The configuration; `None` where only the poses are known.
    pub fn coordinates(&self) -> Option<&[f64]> {
        self.q
    }

    /// The configuration with its link poses; `None` where only the poses are known.
    pub fn state(&self) -> Option<RobotState<'_>> {
        let poses = self.poses();
        self.q.map(|q| RobotState { q, poses })
    }

    /// A link's body, if it has one, at its pose.
    pub fn link(&self, link: usize) -> Option<Placement<'_>> {
        let body = self.space.body(link)?;
        Some((body, &self.poses()[link]))
    }

    /// The bounds of all bodies that move with the robot, by their numbers: those of links, in the links' order, then the s-objects
    /// attached to links. Computed when they are first asked for.
    pub fn bounds(&self) -> &BoundsByEight {
        self.bounds.get_or_init(|| {
            let mut bounds = self.bounds_memory.take();
            with_widest(BoundAll {
                scene: self,
                bounds: &mut bounds,
            });
            bounds
        })
    }

    /// The bounds of a link's body, if it has one.
    pub fn bounds_of_link(&self, link: usize) -> Option<Bounds> {
        let number = self.space.bodies().number(link)?;
        Some(self.bounds().get(number))
    }

    /// How many bodies move with the robot.
    pub fn body_count(&self) -> usize {
        self.space.bodies().count() + self.held.len()
    }

    /// The s-objects attached to links.
    pub fn held(&self) -> &[AttachedObject<'a>] {
        &self.held
    }

    /// The s-objects of one environment that are attached to links, with their places among all.
    pub fn held_of(
        &self,
        environment: u64,
    ) -> impl Iterator<Item = (usize, &AttachedObject<'a>)> + Clone {
        let first = self.held.partition_point(|h| h.environment < environment);
        let own = self.held[first..].iter();
        (first..).zip(own.take_while(move |held| held.environment == environment))
    }

    pub fn space(&self) -> &Space {
        self.space
    }

    pub fn world(&self) -> &World {
        self.world
    }
}

/// Bounds all bodies that move with the robot.
struct BoundAll<'b, 'a> {
    scene: &'b Scene<'a>,
    bounds: &'b mut BoundsByEight,
}

impl Work for BoundAll<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) {
        let Self { scene, bounds } = self;
        let space = scene.space;
        bounds.carry(
            lanes,
            space.bodies().own_bounds(),
            space.bodies().carriers(),
            scene.poses(),
        );
        for held in &scene.held {
            bounds.push(&Bounds::of(lanes, &held.object.body, &held.pose));
        }
    }
}
