//! Robots, spaces and C-objects for tests.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Change, Environment};
use cstk::error::Result;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::robot::{CustomJoint, JointKind, LinkDefinition, Robot, RobotBuilder, Speeds, Twist};
use cstk::space::{Space, WorldBox};

/// A link without a name on the next unused coordinate.
pub fn link(parent: Option<usize>, kind: JointKind, axis: Vec3) -> LinkDefinition {
    LinkDefinition {
        parent,
        kind,
        axis,
        ..Default::default()
    }
}

pub fn robot(dimension: u32, links: Vec<LinkDefinition>) -> Arc<Robot> {
    let mut builder = RobotBuilder::new(dimension).unwrap();
    for link in links {
        builder.add_link(link).unwrap();
    }
    Arc::new(builder.build().unwrap())
}

/// A body that moves freely: x, y, z, then turns about z, the new y and the new x.
pub fn free_body(body: &Arc<Body>) -> Arc<Robot> {
    let joints = || [JointKind::Prismatic, JointKind::Revolute];
    let axes = [
        [Vec3::x(), Vec3::y(), Vec3::z()],
        [Vec3::z(), Vec3::y(), Vec3::x()],
    ];
    let mut links: Vec<LinkDefinition> = (0..6usize)
        .map(|i| {
            link(
                i.checked_sub(1),
                joints()[i / 3].clone(),
                axes[i / 3][i % 3],
            )
        })
        .collect();
    links[5].body = Some(body.clone());
    robot(3, links)
}

/// A body of the plane that moves freely: x, y, angle.
pub fn free_planar_body(body: &Arc<Body>) -> Arc<Robot> {
    let mut links = vec![
        link(None, JointKind::Prismatic, Vec3::x()),
        link(Some(0), JointKind::Prismatic, Vec3::y()),
        link(Some(1), JointKind::Revolute, Vec3::z()),
    ];
    links[2].body = Some(body.clone());
    robot(2, links)
}

pub fn space(robots: Vec<Arc<Robot>>) -> Arc<Space> {
    Arc::new(Space::new(robots, &[], WorldBox::unbounded()).unwrap())
}

/// An environment and the ids of its objects.
pub fn environment(objects: &[(&Arc<Body>, Pose)]) -> (Arc<Environment>, Vec<u64>) {
    let environment = Arc::new(Environment::default());
    let changes: Vec<Change> = objects
        .iter()
        .map(|(body, pose)| Change::add((*body).clone(), *pose))
        .collect();
    let (ids, _) = environment.apply(&changes).unwrap();
    (environment, ids)
}

/// All links with bodies against all objects.
pub fn against(space: &Arc<Space>, environment: &Arc<Environment>) -> CObject {
    against_with(space, environment, InducedOptions::default())
}

pub fn against_with(
    space: &Arc<Space>,
    environment: &Arc<Environment>,
    options: InducedOptions,
) -> CObject {
    CObject::induced(
        space.clone(),
        &[],
        SObjects::All(environment.clone()),
        LeftOut::default(),
        options,
    )
    .unwrap()
}

/// All links with bodies against one object.
pub fn against_one(space: &Arc<Space>, environment: &Arc<Environment>, id: u64) -> CObject {
    CObject::induced(
        space.clone(),
        &[],
        SObjects::Some(environment.clone(), vec![id]),
        LeftOut::default(),
        InducedOptions::default(),
    )
    .unwrap()
}

/// A joint that rides up a screw and sways, by maps of its own.
pub struct Screw;

impl CustomJoint for Screw {
    fn coordinates(&self) -> usize {
        2
    }

    fn pose(&self, q: &[f64]) -> Result<Pose> {
        Ok(Pose {
            rotation: rotation_about(&Vec3::z(), q[0]) * rotation_about(&Vec3::x(), q[1].sin()),
            translation: Vec3::new(0.0, q[1].cos(), 0.2 * q[0]),
        })
    }

    fn jacobian(&self, q: &[f64], columns: &mut Vec<Twist>) -> Result<()> {
        columns.push(Twist {
            linear: Vec3::new(0.0, 0.0, 0.2),
            angular: Vec3::z(),
        });
        columns.push(Twist {
            linear: Vec3::new(0.0, -q[1].sin(), 0.0),
            angular: rotation_about(&Vec3::z(), q[0]) * Vec3::x() * q[1].cos(),
        });
        Ok(())
    }

    fn speeds(&self) -> Option<Speeds> {
        Some(Speeds {
            linear: 1.0,
            angular: 1.0,
        })
    }
}
