//! A motion with constant velocity through C-space, and bounds of how far it moves links, by the joints between them and what
//! they are compared with (Quinlan 1994, ch. 4).

use crate::cobject::{BodyPairs, CObject, Induced, LinksAndObjects, PureSet, Set};
use crate::environment::{Environment, SObject};
use crate::error::{Error, Result};
use crate::pose::Vec3;
use crate::query::{Configuration, Placement, Scene, SceneMemory, Target, World};
use crate::robot::Velocity;
use crate::space::Space;

/// The fraction of a distance that a bound may use: the rest is more than the rounding of the bound itself, a sum of products. That of
/// the bodies' places has nothing to do with their distance, and is added to what they move.
pub(super) const STEP_FRACTION: f64 = 0.99;

/// The motion from q with velocity v for a unit of time, in one state of the world. Both ends are within the coordinates'
/// ranges.
#[derive(Clone, Copy)]
pub(crate) struct LinearMotion<'a> {
    pub world: &'a World,
    pub cobject: &'a CObject,
    pub q: &'a [f64],
    pub v: &'a [f64],
}

impl<'a> LinearMotion<'a> {
    pub(super) fn at(&self, t: f64) -> Vec<f64> {
        let displacement: Vec<f64> = self.v.iter().map(|x| x * t).collect();
        self.cobject.space().step(self.q, &displacement)
    }

    pub(super) fn scene<'s>(&'s self, q: &'s [f64]) -> Result<Scene<'s>> {
        Scene::new(
            self.cobject.space(),
            self.world,
            Configuration::Coordinates(q),
            SceneMemory::default(),
        )
    }

    /// The error where no speed is known: that of a custom joint whose place is not known, if there is one, else the given one.
    pub fn without_speed(&self, unstated: Error) -> Error {
        let poses = self.cobject.space().link_poses(self.q);
        poses.err().unwrap_or(unstated)
    }

    /// Whether every joint that moves, and that changes some distance, states its speeds.
    pub fn states_speeds(&self) -> bool {
        let space = self.cobject.space();
        let of_pairs = match self.cobject.set() {
            Set::Union { induced, .. } => &induced[..],
            _ => &[],
        };
        let of_pairs = of_pairs.iter().filter_map(|term| self.fastest_pair(term));
        let of_sets = pure_sets(self.cobject).map(|set| set.motion_bound(space, self.q, self.v));
        of_pairs.chain(of_sets).all(f64::is_finite)
    }

    /// Bounds the change of distance of all pairs of the set; `None` if no distance changes.
    pub(super) fn fastest_pair(&self, term: &Induced) -> Option<f64> {
        let &Self { world, q, v, .. } = self;
        let space = self.cobject.space();
        let fastest = match &term.pairs {
            BodyPairs::Objects(LinksAndObjects { links, objects, .. }) => {
                let held = extents_of_held(world, objects.environment(), space);
                let of_link = |link: usize| {
                    let held = held.iter().filter(|(holder, _)| *holder == link);
                    let held =
                        held.map(|(_, extent)| space.motion_bound_of_radius(link, *extent, q, v));
                    held.fold(space.motion_bound(link, q, v), f64::max)
                };
                let of_links = links.iter().map(|&link| of_link(link));
                // An attached object moves, and is an s-object to the other links.
                let of_carriers = held.iter().map(|(holder, _)| of_link(*holder));
                of_links.fold(0.0, f64::max) + of_carriers.fold(0.0, f64::max)
            }
            BodyPairs::Links { pairs, .. } => {
                let extent = |link: usize| {
                    let body = space.body(link);
                    body.map_or(0.0, |body| body.radius_from_origin())
                };
                let of_pair = |&[r, s]: &[usize; 2]| {
                    space.relative_motion_bound([(r, extent(r)), (s, extent(s))], q, v)
                };
                pairs.iter().map(of_pair).fold(0.0, f64::max)
            }
        };
        (fastest > 0.0).then_some(fastest)
    }

    /// Bounds how far a body carried by a link moves along a direction of the world, from a scene on.
    pub(super) fn directed_rate(
        &self,
        scene: &Scene,
        link: usize,
        carried: Placement,
        direction: &Vec3,
    ) -> Option<f64> {
        let extent = extent(scene, link, carried);
        let space = self.cobject.space();
        Some(space.directed_motion_bound(
            link,
            extent,
            direction,
            scene.state()?,
            Velocity::Constant(self.v),
        ))
    }

    /// Bounds the change of a pair's distance, by the relative motion of its bodies.
    pub(super) fn rate(&self, scene: &Scene, target: &Target) -> f64 {
        let &Self { q, v, .. } = self;
        let space = self.cobject.space();
        let (r_link, s_link) = target.links();
        let r = (r_link, extent(scene, r_link, target.sides[0]));
        match s_link {
            Some(s) => {
                let s = (s, extent(scene, s, target.sides[1]));
                space.relative_motion_bound([r, s], q, v)
            }
            None => space.motion_bound_of_radius(r.0, r.1, q, v),
        }
    }
}

/// Bounds the distance of a link's body, or of an object attached to the link, from the link's origin.
pub(super) fn extent(scene: &Scene, link: usize, (body, pose): Placement) -> f64 {
    (pose.translation - scene.poses()[link].translation).norm() + body.radius_from_origin()
}

/// The pure sets of a union, or the set itself if it is pure.
fn pure_sets(cobject: &CObject) -> impl Iterator<Item = &PureSet> {
    let own = match cobject.set() {
        Set::Pure(set) => Some(set),
        _ => None,
    };
    let parts = cobject.set().parts().iter();
    own.into_iter()
        .chain(parts.filter_map(|part| match part.set() {
            Set::Pure(set) => Some(set),
            _ => None,
        }))
}

/// The links of a space that hold s-objects of an environment, with bounds of the objects' distances from the links'
/// origins.
fn extents_of_held(world: &World, environment: &Environment, space: &Space) -> Vec<(usize, f64)> {
    let attached = world.snapshot(environment).map(|now| now.attached());
    let extent = |object: &SObject| {
        let attachment = object.attachment.as_ref()?;
        let radius = object.pose.translation.norm() + object.body.radius_from_origin();
        (attachment.space == space.serial()).then_some((attachment.link, radius))
    };
    attached.into_iter().flatten().filter_map(extent).collect()
}
