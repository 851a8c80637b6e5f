//! The digest of all that a certificate is about: of the content of the bodies, robots and sets, not of ids or addresses, so that it
//! is the same in another process.

use sha2::{Digest, Sha256};

use super::certificate::Entry;
use super::statement::{Carried, Claim, Item, Statement, What};
use crate::cobject::{PureSet, PureShape};
use crate::pose::{Pose, Vec3};
use crate::robot::{Coordinate, JointKind};
use crate::sealed_file::Writer;
use crate::space::Space;

/// Begins what is digested; another arrangement gets another name.
const ARRANGEMENT: &[u8] = b"cstk certificate 1";

/// Of the statement, whose threshold counts in its limits, and of the robots.
pub(super) fn fingerprint(statement: &Statement) -> [u8; 32] {
    let mut content = Writer(ARRANGEMENT.to_vec());
    for digest in &statement.digests {
        content.0.extend(digest);
    }
    content.space(statement.space);
    content.claim(&statement.claim);
    Sha256::digest(content.0).into()
}

impl Writer {
    fn claim(&mut self, claim: &Claim) {
        match claim {
            Claim::All(parts) => {
                self.u32(0);
                self.count(parts.len());
                parts.iter().for_each(|part| self.claim(part));
            }
            Claim::One { parts, .. } => {
                self.u32(1);
                self.count(parts.len());
                for part in parts {
                    self.u32(part.claim.is_some().into());
                    part.claim.iter().for_each(|part| self.claim(part));
                }
            }
            Claim::Item(item) => self.item(item),
        }
    }

    fn item(&mut self, item: &Item) {
        self.f64(item.limit);
        match &item.what {
            What::Bodies(sides) => {
                self.u32(2);
                sides.iter().for_each(|side| self.carried(side));
            }
            What::Plane {
                points,
                normal,
                offset,
                is_open,
            } => {
                self.u32(3);
                self.carried(points);
                self.vector(normal);
                self.f64(*offset);
                self.u32((*is_open).into());
            }
            What::Coordinates(pure) => self.pure(pure),
        }
    }

    fn carried(&mut self, side: &Carried) {
        self.u32(side.link.map_or(Entry::NONE, |link| link as u32));
        self.pose(&side.pose);
        self.u32(side.body.is_some().into());
        self.count(side.place);
    }

    fn pose(&mut self, pose: &Pose) {
        // Zeros of either sign are equal, as in [`Pose::order`].
        self.numbers(&pose.to_row_major().map(|x| x + 0.0));
    }

    fn pure(&mut self, pure: &PureSet) {
        self.f64(pure.scale());
        match &pure.shape {
            PureShape::Box { low, high } => {
                self.u32(4);
                self.numbers(low);
                self.numbers(high);
            }
            PureShape::HalfSpace { normal, offset, .. } => {
                self.u32(5);
                self.numbers(normal);
                self.f64(*offset);
            }
            PureShape::Ball { center, radius } => {
                self.u32(6);
                self.numbers(center);
                self.f64(*radius);
            }
            // The limits are those of the space; the others are planes, or refused.
            PureShape::BeyondLimits
            | PureShape::BeyondWorld { .. }
            | PureShape::Floor { .. }
            | PureShape::Predicate(_) => self.u32(7),
        }
    }

    fn space(&mut self, space: &Space) {
        self.u32(space.dimension());
        self.count(space.link_count());
        for link in (0..space.link_count()).filter_map(|link| space.link(link)) {
            let joint = &link.joint;
            self.u32(link.parent.map_or(Entry::NONE, |parent| parent as u32));
            self.pose(&link.at);
            self.u32(kind_number(&joint.kind));
            self.vector(&if joint.kind.has_axis() {
                joint.axis
            } else {
                Vec3::zeros()
            });
            self.count(joint.coordinate);
            self.count(joint.kind.nq());
            self.f64(joint.multiplier);
            self.f64(joint.offset);
        }
        for offset in space.offsets() {
            self.count(offset.link);
        }
        for coordinate in space.coordinates() {
            let (kind, ends) = match *coordinate {
                Coordinate::Circle => (0, [0.0; 2]),
                Coordinate::Quaternion => (1, [0.0; 2]),
                Coordinate::Interval { lower, upper } => (2, [lower, upper]),
            };
            self.u32(kind);
            self.numbers(&ends);
        }
    }
}

fn kind_number(kind: &JointKind) -> u32 {
    match kind {
        JointKind::Fixed => 0,
        JointKind::Revolute => 1,
        JointKind::Prismatic => 2,
        JointKind::Planar => 3,
        JointKind::Spherical => 4,
        JointKind::Free => 5,
        JointKind::FreeEuler => 6,
        // What it computes is checked at the times of the entries.
        JointKind::Custom(_) => 7,
    }
}
