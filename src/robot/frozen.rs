//! Robots of which only some joints move: a joint group, with the others frozen at a configuration.

use std::ops::Range;

use super::robot::{Coordinates, Links};
use super::whole::Whole;
use super::{Block, Joint, JointKind, Robot, check_configuration};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;

impl Robot {
    /// The same links, by the same numbers, with only some joints left to move: those that move the links of `joints`, and
    /// those that share a coordinate with one that is left. All others are frozen at `q`. Coordinates and velocities are numbered anew, in
    /// the order they had.
    pub fn freeze(&self, joints: &[usize], q: &[f64]) -> Result<Robot> {
        check_configuration(q, self.nq(), self.blocks())?;
        let is_kept = self.left_to_move(joints)?;
        let kept: Vec<usize> = (0..self.nq()).filter(|&c| is_kept[c]).collect();
        let mut places = vec![None; self.nq()];
        for (place, &c) in kept.iter().enumerate() {
            places[c] = Some(place);
        }
        let coordinates = self.kept_coordinates(&kept, &places);
        let mut links = Links::default();
        for (index, link) in self.links().iter().enumerate() {
            let mut link = link.clone();
            let joint = &mut link.joint;
            if joint.kind.nq() > 0 {
                if let Some(coordinate) = places[joint.coordinate] {
                    joint.coordinate = coordinate;
                    joint.velocity = velocity_of(&coordinates.blocks, coordinate);
                } else {
                    let motion = joint.motion(q).and_then(|motion| {
                        self.check_motion(&motion)?;
                        Ok(motion)
                    });
                    let named =
                        |e: Error| e.within(format_args!("link {index} (\"{}\")", link.name));
                    link.at = link.at.compose(&motion.map_err(named)?);
                    link.joint = FIXED;
                }
            }
            links.push(link);
        }
        let semantics = self.semantics().with_coordinates(&places);
        let mut frozen = Robot::assemble(self.dimension(), links, coordinates, semantics);
        frozen.set_whole(Whole {
            rest: q.to_vec(),
            blocks: self.blocks().to_vec(),
            kept,
        });
        Ok(frozen)
    }

    /// For each coordinate whether it moves the link of one of `joints`, or shares a joint with one that does.
    fn left_to_move(&self, joints: &[usize]) -> Result<Vec<bool>> {
        let mut is_kept = vec![false; self.nq()];
        for (i, &link) in joints.iter().enumerate() {
            let link = self.links().get(link).ok_or_else(|| {
                let count = self.links().len();
                let message = format!("joints[{i}]: link {link} does not exist; there are {count}");
                Error::new(ErrorKind::NotFound, message)
            })?;
            is_kept[coordinates_of(&link.joint)].fill(true);
        }
        // A joint of one coordinate may follow one of several: all of that joint's move then, and what follows the others of them.
        loop {
            let before = is_kept.clone();
            for link in self.links() {
                let own = &mut is_kept[coordinates_of(&link.joint)];
                if own.contains(&true) {
                    own.fill(true);
                }
            }
            if is_kept == before {
                return Ok(is_kept);
            }
        }
    }

    /// The ranges and blocks of the coordinates that are left.
    fn kept_coordinates(&self, kept: &[usize], places: &[Option<usize>]) -> Coordinates {
        let mut coordinates = Coordinates::default();
        for &c in kept {
            coordinates.ranges.push(self.ranges()[c]);
            coordinates.periodic.push(self.is_periodic(c));
        }
        for block in self.blocks() {
            if let Some(coordinate) = places[block.coordinate] {
                let velocity = coordinates.nv();
                coordinates.blocks.push(Block {
                    coordinate,
                    velocity,
                    ..*block
                });
            }
        }
        coordinates
    }

    /// The configuration of the robot that this one was made from by [`Robot::freeze`], at q.
    pub fn to_whole(&self, q: &[f64]) -> Result<Vec<f64>> {
        check_configuration(q, self.nq(), self.blocks())?;
        let whole = self.required_whole()?;
        let mut all = whole.rest.clone();
        for (&c, &value) in whole.kept.iter().zip(q) {
            all[c] = value;
        }
        Ok(all)
    }

    /// The part of a configuration of that robot that this one's coordinates are.
    pub fn from_whole(&self, q: &[f64]) -> Result<Vec<f64>> {
        let whole = self.required_whole()?;
        check_configuration(q, whole.rest.len(), &whole.blocks)?;
        Ok(whole.kept.iter().map(|&c| q[c]).collect())
    }

    fn required_whole(&self) -> Result<&Whole> {
        self.whole().ok_or_else(|| {
            Error::new(
                ErrorKind::Empty,
                "no joint of this robot was frozen: it is whole",
            )
        })
    }
}

const FIXED: Joint = Joint {
    kind: JointKind::Fixed,
    axis: Vec3::new(0.0, 0.0, 1.0),
    coordinate: 0,
    velocity: 0,
    multiplier: 1.0,
    offset: 0.0,
};

/// The places of a joint's coordinates.
fn coordinates_of(joint: &Joint) -> Range<usize> {
    joint.coordinate..joint.coordinate + joint.kind.nq()
}

/// The velocity of a joint's first coordinate, with which a block begins.
fn velocity_of(blocks: &[Block], coordinate: usize) -> usize {
    let after = blocks.partition_point(|block| block.coordinate <= coordinate);
    blocks[after - 1].velocity
}
