//! Collects links, checks each as it comes, and builds the robot.

use std::sync::Arc;

use super::{Joint, JointKind, Link, Robot};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::pose::{Pose, Vec3, check_dimension};

/// A link to be added.
#[derive(Clone, Debug)]
pub struct LinkDefinition {
    pub name: String,
    pub body: Option<Arc<Body>>,
    pub parent: Option<usize>,
    pub at: Pose,
    pub kind: JointKind,
    pub axis: Vec3,
    /// Which coordinate moves the joint; `None` takes the next unused one. Joints may share a coordinate.
    pub coordinate: Option<usize>,
}

/// Links on their way to a robot. A failed call adds nothing.
#[derive(Debug)]
pub struct RobotBuilder {
    dimension: u32,
    links: Vec<Link>,
    coordinates: usize,
}

impl RobotBuilder {
    /// For robots of the plane (2) or of space (3).
    pub fn new(dimension: u32) -> Result<Self> {
        check_dimension(dimension)?;
        Ok(Self {
            dimension,
            links: Vec::new(),
            coordinates: 0,
        })
    }

    /// Adds a link and returns its number.
    pub fn add_link(&mut self, definition: LinkDefinition) -> Result<usize> {
        let index = self.links.len();
        let name = if definition.name.is_empty() {
            format!("link{index}")
        } else {
            definition.name.clone()
        };
        let link = self
            .check(&definition, &name)
            .map_err(|e| e.within(format_args!("link {index} (\"{name}\")")))?;
        if link.joint.kind != JointKind::Fixed {
            self.coordinates = self.coordinates.max(link.joint.coordinate + 1);
        }
        self.links.push(link);
        Ok(index)
    }

    fn check(&self, definition: &LinkDefinition, name: &str) -> Result<Link> {
        if self.links.iter().any(|link| link.name == name) {
            return Err(Error::invalid("another link has this name"));
        }
        if let Some(parent) = definition.parent
            && parent >= self.links.len()
        {
            return Err(Error::new(
                ErrorKind::NotFound,
                format!(
                    "parent {parent} does not exist yet; there are {} links",
                    self.links.len()
                ),
            ));
        }
        if let Some(body) = &definition.body
            && body.dimension() != self.dimension
        {
            return Err(Error::invalid(format!(
                "the body has dimension {}, the robot {}",
                body.dimension(),
                self.dimension
            )));
        }
        let planar = self.dimension == 2;
        if planar && !definition.at.is_planar() {
            return Err(Error::invalid("the link leaves the plane z = 0"));
        }
        let mut joint = Joint {
            kind: definition.kind,
            axis: Vec3::z(),
            coordinate: 0,
        };
        if definition.kind != JointKind::Fixed {
            joint.axis = unit_axis(&definition.axis)?;
            let out_of_plane = match definition.kind {
                JointKind::Revolute => joint.axis.x != 0.0 || joint.axis.y != 0.0,
                _ => joint.axis.z != 0.0,
            };
            if planar && out_of_plane {
                return Err(Error::invalid(
                    "a planar robot's joints turn about z or shift along x and y",
                ));
            }
            joint.coordinate = definition.coordinate.unwrap_or(self.coordinates);
            if joint.coordinate > self.coordinates {
                return Err(Error::invalid(format!(
                    "coordinate {} leaves a gap: the next free one is {}",
                    joint.coordinate, self.coordinates
                )));
            }
        }
        Ok(Link {
            name: name.to_string(),
            body: definition.body.clone(),
            parent: definition.parent,
            at: definition.at,
            joint,
        })
    }

    /// Builds the robot from what was added so far; the builder stays as it is.
    pub fn build(&self) -> Result<Robot> {
        if self.links.is_empty() {
            return Err(Error::new(ErrorKind::Empty, "the robot has no link"));
        }
        Ok(Robot::assemble(
            self.dimension,
            self.coordinates,
            self.links.clone(),
        ))
    }
}

fn unit_axis(axis: &Vec3) -> Result<Vec3> {
    require_finite(axis.as_slice(), "axis entry")?;
    // Scaled first, so that the length of a long axis does not overflow.
    let largest = axis.amax();
    if largest == 0.0 {
        return Err(Error::new(
            ErrorKind::Degenerate,
            "the joint's axis is zero",
        ));
    }
    Ok((axis / largest).normalize())
}
