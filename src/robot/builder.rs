//! Builds robots: collects links and checks each as it is added.

use std::sync::Arc;

use super::custom_joint::{Checked, MAX_COORDINATES};
use super::robot::{Coordinates, Links};
use super::{Block, BlockKind, Coordinate, Joint, JointKind, Link, Robot, Semantics};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result, require_coordinates, require_finite};
use crate::pose::{Pose, Vec3, check_dimension};

/// The definition of a link and of the joint that moves it.
#[derive(Clone, Debug)]
pub struct LinkDefinition {
    /// Empty for `link<number>`.
    pub name: String,
    /// Unique among the joints, or empty.
    pub joint_name: String,
    /// The link's geometry, in the link's frame; `None` for a link that only carries others.
    pub body: Option<Arc<Body>>,
    /// An earlier link; `None` for the world.
    pub parent: Option<usize>,
    /// The joint's frame, from the parent's frame, at coordinate 0.
    pub at: Pose,
    /// How the joint moves the link.
    pub kind: JointKind,
    /// The axis of a revolute or prismatic joint, in the joint's frame; of any length above 0.
    pub axis: Vec3,
    /// The joint's first coordinate; `None` takes the next unused ones. Revolute and prismatic joints may share a
    /// coordinate.
    pub coordinate: Option<usize>,
    /// A revolute or prismatic joint moves by `multiplier * coordinate + offset`, so that one joint can mimic another.
    pub multiplier: f64,
    /// See `multiplier`; radians or a length.
    pub offset: f64,
    /// The range of a revolute or prismatic joint's coordinate, which a space may override; radians or lengths. Ignored
    /// where the joint shares the coordinate of an earlier one. A revolute joint with infinite limits turns on a circle.
    pub limits: [f64; 2],
}

impl Default for LinkDefinition {
    fn default() -> Self {
        Self {
            name: String::new(),
            joint_name: String::new(),
            body: None,
            parent: None,
            at: Pose::identity(),
            kind: JointKind::Fixed,
            axis: Vec3::z(),
            coordinate: None,
            multiplier: 1.0,
            offset: 0.0,
            limits: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

/// Collects the links of a robot. A failed call adds nothing.
#[derive(Clone, Debug)]
pub struct RobotBuilder {
    dimension: u32,
    links: Links,
    coordinates: Coordinates,
    semantics: Semantics,
}

impl RobotBuilder {
    /// For robots of the plane (2) or of space (3).
    pub fn new(dimension: u32) -> Result<Self> {
        check_dimension(dimension)?;
        Ok(Self {
            dimension,
            links: Links::default(),
            coordinates: Coordinates::default(),
            semantics: Semantics::default(),
        })
    }

    /// 2 for a planar robot, 3 for a spatial one.
    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// The links added so far.
    pub fn links(&self) -> &[Link] {
        &self.links.list
    }

    /// What SRDF files said so far.
    pub fn semantics(&self) -> &Semantics {
        &self.semantics
    }

    /// Puts other semantics in place of those so far; they must name links and coordinates that are there.
    pub(crate) fn set_semantics(&mut self, semantics: Semantics) {
        self.semantics = semantics;
    }

    /// The number of the link with this name.
    pub fn find_link(&self, name: &str) -> Option<usize> {
        self.links.names.find(name)
    }

    /// The number of the link that the joint with this name moves.
    pub fn find_joint(&self, name: &str) -> Option<usize> {
        self.links.joint_names.find(name)
    }

    /// Names the joint of a link whose joint has no name.
    pub(crate) fn name_joint(&mut self, link: usize, name: &str) {
        self.links.joint_names.add(name, link);
        self.links.list[link].joint_name = name.to_string();
    }

    /// Rules out a pair of links, by name, for self-collision.
    pub fn disable_pair(&mut self, names: [&str; 2]) -> Result<()> {
        let mut pair = [0; 2];
        for (place, name) in pair.iter_mut().zip(names) {
            let link = self.find_link(name).ok_or_else(|| {
                Error::new(ErrorKind::NotFound, format!("there is no link \"{name}\""))
            })?;
            *place = link as u32;
        }
        if pair[0] == pair[1] {
            let message = format!("link \"{}\" is paired with itself", names[0]);
            return Err(Error::invalid(message));
        }
        self.semantics.pairs.disable(pair);
        Ok(())
    }

    /// Adds a link and returns its number.
    pub fn add_link(&mut self, definition: LinkDefinition) -> Result<usize> {
        let index = self.links.list.len();
        let name = if definition.name.is_empty() {
            format!("link{index}")
        } else {
            definition.name.clone()
        };
        let joint = self
            .check(&definition, &name)
            .and_then(|()| self.joint(&definition))
            .map_err(|e| e.within(format_args!("link {index} (\"{name}\")")))?;
        self.extend_coordinates(&joint, definition.limits);
        self.links.push(Link {
            name,
            joint_name: definition.joint_name,
            body: definition.body,
            parent: definition.parent,
            at: definition.at,
            joint,
        });
        Ok(index)
    }

    fn check(&self, definition: &LinkDefinition, name: &str) -> Result<()> {
        let joint_name = &definition.joint_name;
        if self.links.names.find(name).is_some() {
            return Err(Error::invalid("another link has this name"));
        }
        if let Some(other) = self.links.joint_names.find(joint_name) {
            return Err(Error::invalid(format!(
                "the joint of link \"{}\" is named \"{joint_name}\" too",
                self.links.list[other].name
            )));
        }
        if let Some(parent) = definition.parent
            && parent >= self.links.list.len()
        {
            return Err(Error::new(
                ErrorKind::NotFound,
                format!(
                    "parent {parent} does not exist yet; there are {} links",
                    self.links.list.len()
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
        require_coordinates(definition.at.translation.as_slice(), "position entry")?;
        if self.dimension == 2 && !definition.at.is_planar() {
            return Err(Error::invalid("the link leaves the plane z = 0"));
        }
        Ok(())
    }

    /// The joint of a definition, with its coordinates assigned.
    fn joint(&self, definition: &LinkDefinition) -> Result<Joint> {
        let kind = match &definition.kind {
            JointKind::Custom(joint) => JointKind::Custom(Arc::new(Checked(joint.clone()))),
            other => other.clone(),
        };
        let mut joint = Joint {
            kind,
            axis: Vec3::z(),
            coordinate: 0,
            velocity: 0,
            multiplier: 1.0,
            offset: 0.0,
        };
        if joint.kind.has_axis() {
            joint.axis = unit_axis(&definition.axis)?;
            (joint.multiplier, joint.offset) = (definition.multiplier, definition.offset);
        }
        let [lower, upper] = definition.limits;
        let is_default = definition.multiplier == 1.0 && definition.offset == 0.0;
        if !joint.kind.has_axis() && (!is_default || lower.is_finite() || upper.is_finite()) {
            return Err(Error::invalid(
                "limits, multiplier and offset are for revolute and prismatic joints; for others give the space a range",
            ));
        }
        require_coordinates(&[definition.multiplier], "multiplier")?;
        require_coordinates(&[definition.offset], "offset")?;
        check_limits(definition.limits)?;
        self.check_kind(&joint)?;
        if joint.kind.nq() > 0 {
            (joint.coordinate, joint.velocity) = self.place(&joint, definition.coordinate)?;
        }
        Ok(joint)
    }

    fn check_kind(&self, joint: &Joint) -> Result<()> {
        let axis = &joint.axis;
        let leaves_the_plane = match &joint.kind {
            JointKind::Fixed | JointKind::Planar => false,
            JointKind::Revolute => axis.x != 0.0 || axis.y != 0.0,
            JointKind::Prismatic => axis.z != 0.0,
            JointKind::Spherical | JointKind::Free | JointKind::FreeEuler => true,
            JointKind::Custom(custom) => {
                if !(1..=MAX_COORDINATES).contains(&custom.coordinates()) {
                    return Err(Error::invalid(format!(
                        "the joint has {} coordinates; 1 to {MAX_COORDINATES} are possible",
                        custom.coordinates()
                    )));
                }
                false
            }
        };
        if self.dimension == 2 && leaves_the_plane {
            return Err(Error::invalid(
                "a planar robot's joints turn about z, shift along x and y, or are planar",
            ));
        }
        Ok(())
    }

    /// Assigns a joint its first coordinate and its first velocity.
    fn place(&self, joint: &Joint, coordinate: Option<usize>) -> Result<(usize, usize)> {
        let end = self.coordinates.ranges.len();
        let first = coordinate.unwrap_or(end);
        if first > end {
            return Err(Error::invalid(format!(
                "coordinate {first} leaves a gap: the next free one is {end}"
            )));
        }
        if first == end {
            return Ok((end, self.coordinates.nv()));
        }
        // Blocks are sorted by their first coordinate.
        let blocks = &self.coordinates.blocks;
        let found = blocks.binary_search_by_key(&first, |block| block.coordinate);
        let shared = found.ok().map(|i| &blocks[i]);
        match shared.filter(|block| block.kind == BlockKind::Line) {
            Some(block) if joint.kind.has_axis() => Ok((first, block.velocity)),
            _ => Err(Error::invalid(format!(
                "coordinate {first} is taken: only revolute and prismatic joints follow another's, and never part of a quaternion"
            ))),
        }
    }

    /// Appends the coordinates that a joint adds, or narrows the one that it shares.
    fn extend_coordinates(&mut self, joint: &Joint, limits: [f64; 2]) {
        let [lower, upper] = limits;
        let is_free = lower == f64::NEG_INFINITY && upper == f64::INFINITY;
        let whole_turns = joint.multiplier.fract() == 0.0;
        let coordinates = &mut self.coordinates;
        if joint.coordinate < coordinates.ranges.len() {
            // The joint shares a coordinate, or has none.
            let turns = matches!(joint.kind, JointKind::Revolute) && whole_turns;
            if joint.kind.nq() > 0 && !turns {
                coordinates.periodic[joint.coordinate] = false;
                if coordinates.ranges[joint.coordinate] == Coordinate::Circle {
                    coordinates.ranges[joint.coordinate] = Coordinate::LINE;
                }
            }
            return;
        }
        let line = Coordinate::LINE;
        let circle = Coordinate::Circle;
        let quaternion = [Coordinate::Quaternion; 4];
        let (ranges, blocks): (Vec<Coordinate>, Vec<BlockKind>) = match &joint.kind {
            JointKind::Fixed => return,
            JointKind::Revolute if is_free && whole_turns => (vec![circle], vec![BlockKind::Line]),
            JointKind::Revolute | JointKind::Prismatic => (
                vec![Coordinate::Interval { lower, upper }],
                vec![BlockKind::Line],
            ),
            JointKind::Planar => (vec![line, line, circle], vec![BlockKind::Line; 3]),
            JointKind::Spherical => (quaternion.to_vec(), vec![BlockKind::Rotation]),
            JointKind::Free => (
                [[line; 3].as_slice(), &quaternion].concat(),
                vec![BlockKind::Placement],
            ),
            JointKind::FreeEuler => ([[line; 3], [circle; 3]].concat(), vec![BlockKind::Line; 6]),
            JointKind::Custom(custom) => {
                let n = custom.coordinates();
                (vec![line; n], vec![BlockKind::Line; n])
            }
        };
        for kind in blocks {
            coordinates.blocks.push(Block {
                kind,
                coordinate: coordinates
                    .blocks
                    .last()
                    .map_or(0, |b| b.coordinate + b.kind.nq()),
                velocity: coordinates.nv(),
            });
        }
        coordinates
            .periodic
            .extend(ranges.iter().map(|range| match &joint.kind {
                JointKind::Custom(_) => true,
                JointKind::Revolute => whole_turns,
                _ => *range == Coordinate::Circle,
            }));
        coordinates.ranges.extend(ranges);
    }

    /// Builds the robot from the links added so far; the builder stays as it is.
    pub fn build(&self) -> Result<Robot> {
        if self.links.list.is_empty() {
            return Err(Error::new(ErrorKind::Empty, "the robot has no link"));
        }
        Ok(Robot::assemble(
            self.dimension,
            self.links.clone(),
            self.coordinates.clone(),
            self.semantics.clone(),
        ))
    }
}

fn unit_axis(axis: &Vec3) -> Result<Vec3> {
    require_finite(axis.as_slice(), "axis entry")?;
    // Scaled first: the length of a long axis would overflow.
    let largest = axis.amax();
    if largest == 0.0 {
        return Err(Error::new(
            ErrorKind::Degenerate,
            "the joint's axis is zero",
        ));
    }
    Ok((axis / largest).normalize())
}

fn check_limits([lower, upper]: [f64; 2]) -> Result<()> {
    if lower.is_nan() || upper.is_nan() {
        return Err(Error::new(ErrorKind::NotFinite, "a limit is NaN"));
    }
    if lower > upper || lower == f64::INFINITY || upper == f64::NEG_INFINITY {
        return Err(Error::invalid(format!(
            "the limits are empty: {lower} to {upper}"
        )));
    }
    for limit in [lower, upper].into_iter().filter(|x| x.is_finite()) {
        require_coordinates(&[limit], "limit")?;
    }
    Ok(())
}
