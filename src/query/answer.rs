//! The result types of queries.

use crate::cobject::Leaf;
use crate::convex::{ContactMode, Penetration};
use crate::pose::Vec3;
use crate::primitive::Feature;

/// The s-side of a witness. Objects sort before links, and both by number: the order that breaks ties.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SSide {
    /// An s-object, by id.
    Object(u64),
    /// A link of the space, by number.
    Link(usize),
    /// A pure set: there is no body pair.
    PureSet(PurePlace),
}

impl SSide {
    /// The link, if it is one.
    pub(crate) fn link(self) -> Option<usize> {
        match self {
            Self::Link(link) => Some(link),
            Self::Object(_) | Self::PureSet(_) => None,
        }
    }
}

/// What decides the distance of a pure set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PurePlace {
    /// All coordinates together.
    Configuration,
    /// One coordinate, of limits or a box.
    Coordinate(usize),
    /// A point in the world: the origin of the r-link, for the world box, or a point of its primitive, for a floor.
    World,
}

/// How much is known of a distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceKind {
    /// The distance is known, up to rounding.
    Exact,
    /// Only `lower` and `upper` are known.
    LowerBound,
    /// Nothing is within the maximal distance of the query.
    BeyondMax,
    /// The set is empty: there is nothing to measure to.
    Empty,
}

/// A distance with safe bounds: `lower <= truth <= upper`.
#[derive(Clone, Debug)]
pub struct Distance {
    /// How much is known.
    pub kind: DistanceKind,
    /// The distance; `lower` for a lower bound, infinity if nothing is near. In lengths, or in C-space units for pure sets
    /// without a scale.
    pub distance: f64,
    /// The true distance is not smaller.
    pub lower: f64,
    /// The true distance is not larger.
    pub upper: f64,
    /// The nearest primitive pair; ties go to the lowest ids.
    pub witness: Option<Witness>,
    /// The witness points, in the world, r-side first. For a contained piece both are the same vertex of the piece.
    pub points: [Vec3; 2],
    /// The contact at the witness points, if there is one.
    pub contact: Option<ContactRecord>,
    /// What of the upper bound is there only because bodies may differ from what they stand for: so much less bounds the distance
    /// of the bodies grown by their stated deviations, which the lower bound is of.
    pub excess: f64,
    /// The version of the environment that the query saw; 0 without an environment.
    pub version: u64,
}

/// A primitive pair, a piece of a body inside another body, or a pure set. Pure sets have link and primitive numbers 0,
/// unless they are in the world. The contacts of a witness are `contact_count` entries of its list, from `first_contact`
/// on.
#[derive(Clone, Copy, Debug)]
pub struct Witness {
    /// The leaf of the C-object that the witness belongs to.
    pub leaf: Leaf,
    /// The link on the r-side, by number in the space.
    pub r_link: usize,
    /// The attached s-object that is the r-side, or 0 for the link's own body.
    pub r_object: u64,
    /// The link that the s-object is attached to, if any.
    pub s_carrier: Option<usize>,
    /// The s-side.
    pub s_side: SSide,
    /// The primitives of the two sides, r first.
    pub primitives: [u32; 2],
    /// The tags of the two primitives.
    pub tags: [u64; 2],
    /// The parts of their bodies that the two primitives belong to, if they do.
    pub parts: [Option<u32>; 2],
    /// The user data of the two sides, or 0.
    pub data: [usize; 2],
    /// The distance less the margin, at least 0.
    pub distance: f64,
    /// Index of the first contact in the list.
    pub first_contact: usize,
    /// The number of contacts.
    pub contact_count: usize,
    /// The primitives' interiors overlap, or `contained` is set: there is no contact and no gradient.
    pub overlapping: bool,
    /// The distance is that of the complement of the pure set.
    pub complemented: bool,
    /// A piece of one body lies wholly inside the other, a solid. The distance is 0, although the two primitives do not
    /// meet: they are the lowest of the piece, and the lowest of the part of the solid's boundary around it.
    pub contained: bool,
}

/// A contact, in the world frame. A contact with a pure set has neither points nor a normal, unless the set is the world
/// box or a floor.
#[derive(Clone, Copy, Debug)]
pub struct ContactRecord {
    /// The witness points, r-side first.
    pub points: [Vec3; 2],
    /// Of length 1, from s to r.
    pub normal: Vec3,
    /// The distance less the margin, at least 0.
    pub distance: f64,
    /// The signed distance less the margin: negative within the margin, and where primitives overlap slightly, or round
    /// ones more while their cores are apart.
    pub clearance: f64,
    /// The contact mode (§4.4).
    pub mode: ContactMode,
    /// The features in contact, r-side first.
    pub features: [Feature; 2],
}

/// Which contacts are computed for witnesses. They take most of the time of a witness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactsListed {
    /// All contacts of each primitive pair.
    #[default]
    All,
    /// The contact at the witness points.
    Nearest,
    /// No contacts and no gradients. Touching and overlapping are then not distinguished: every pair that meets counts as
    /// overlapping.
    None,
}

/// All primitive pairs within a threshold, nearest first, with their contacts. Pieces of a body that lie inside another are
/// listed at distance 0.
#[derive(Clone, Debug, Default)]
pub struct WitnessList {
    /// The witnesses, nearest first.
    pub witnesses: Vec<Witness>,
    /// The contacts of all witnesses.
    pub contacts: Vec<ContactRecord>,
    /// One row of `nv` entries per contact; empty where no gradients were requested.
    pub gradients: Vec<f64>,
    /// The length of a row.
    pub nv: usize,
    /// There are more witnesses than requested; these are the nearest.
    pub truncated: bool,
    /// The version of the environment that the query saw; 0 without an environment.
    pub version: u64,
}

/// The penetration of a primitive pair that meets: the shortest translation that separates the two.
#[derive(Clone, Copy, Debug)]
pub struct PrimitivePenetration {
    /// The primitives of the two bodies.
    pub primitives: [u32; 2],
    /// The tags of the two primitives.
    pub tags: [u64; 2],
    /// The parts of their bodies that the two primitives belong to, if they do.
    pub parts: [Option<u32>; 2],
    /// The depth and the translation, in the world.
    pub penetration: Penetration,
}

/// All primitive pairs that meet, deepest first. Pieces of a body inside another have none.
#[derive(Clone, Debug, Default)]
pub struct PenetrationList {
    /// The penetrations, deepest first.
    pub penetrations: Vec<PrimitivePenetration>,
    /// Both bodies are a single primitive, so that the first entry separates the bodies; else each entry separates its two
    /// primitives only.
    pub of_whole_bodies: bool,
    /// There are more than requested; these are the deepest.
    pub truncated: bool,
}
