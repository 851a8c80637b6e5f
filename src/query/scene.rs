//! The world at a configuration.

use std::borrow::Cow;
use std::sync::Arc;

use super::target::Placement;
use super::world::World;
use crate::cobject::{Induced, Stand};
use crate::environment::{Attachment, SObject};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Pose;
use crate::robot::Posture;
use crate::space::Space;

/// Where the robot is: by its coordinates, or by the pose of every link of the space.
#[derive(Clone, Copy, Debug)]
pub enum Configuration<'a> {
    Coordinates(&'a [f64]),
    LinkPoses(&'a [Pose]),
}

/// The world at one configuration: link poses, and the states of the environments.
pub struct Scene<'a> {
    space: &'a Space,
    q: Option<&'a [f64]>,
    pub poses: Cow<'a, [Pose]>,
    world: &'a World,
    /// By their environments' serial numbers, in their order.
    held: Vec<Held<'a>>,
}

/// An s-object attached to a link, where that has taken it.
pub struct Held<'a> {
    /// The serial number of its environment.
    pub environment: u64,
    pub object: &'a SObject,
    pub attachment: &'a Attachment,
    pub pose: Pose,
}

/// The induced sets of a union, searched as one.
pub type Group = [Arc<Induced>];

impl<'a> Scene<'a> {
    pub fn new(
        space: &'a Space,
        world: &'a World,
        configuration: Configuration<'a>,
    ) -> Result<Self> {
        let (q, poses) = match configuration {
            Configuration::Coordinates(q) => {
                space.check_configuration(q)?;
                (Some(q), Cow::Owned(space.link_poses(q)?))
            }
            Configuration::LinkPoses(poses) => {
                if poses.len() != space.link_count() {
                    return Err(Error::new(
                        ErrorKind::WrongSize,
                        format!(
                            "{} link poses given, the space has {} links",
                            poses.len(),
                            space.link_count()
                        ),
                    ));
                }
                if let Some(link) = poses.iter().position(|pose| !pose.is_planar())
                    && space.dimension() == 2
                {
                    return Err(Error::invalid(format!(
                        "the pose of link {link} leaves the plane z = 0 of its robot"
                    )));
                }
                (None, Cow::Borrowed(poses))
            }
        };
        let held = world
            .attached(space)
            .map(|(environment, object, attachment)| Held {
                environment,
                object,
                attachment,
                pose: poses[attachment.link].compose(&object.pose),
            });
        let held = held.collect();
        Ok(Self {
            space,
            q,
            poses,
            world,
            held,
        })
    }

    pub fn version(&self) -> u64 {
        self.world.version()
    }

    /// The configuration as pure sets see it.
    pub fn stand(&self) -> Stand<'_> {
        Stand {
            space: self.space,
            q: self.q,
            poses: &self.poses,
        }
    }

    /// The configuration with its link poses; `None` where only the poses are known.
    pub fn posture(&self) -> Option<Posture<'_>> {
        let poses = &self.poses;
        self.q.map(|q| Posture { q, poses })
    }

    /// A link's body, if it has one, at its pose.
    pub fn link(&self, link: usize) -> Option<Placement<'_>> {
        let body = self.space.link(link)?.body.as_deref()?;
        Some((body, &self.poses[link]))
    }

    /// The s-objects attached to links.
    pub fn held(&self) -> &[Held<'a>] {
        &self.held
    }

    /// The s-objects of one environment that are attached to links, with their places among all.
    pub fn held_of(&self, environment: u64) -> impl Iterator<Item = (usize, &Held<'a>)> + Clone {
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
