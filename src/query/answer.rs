//! The answers' types.

use crate::cobject::Leaf;
use crate::convex::{ContactMode, Penetration};
use crate::pose::Vec3;
use crate::primitive::Feature;

/// The s-side of a body pair. Objects sort before links, and both by number: the order in which ties are broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SSide {
    Object(u64),
    Link(usize),
    /// There is no pair of bodies: a pure set.
    PureSet(PurePlace),
}

/// Where a pure set is near.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PurePlace {
    /// At all coordinates together.
    Configuration,
    /// At the coordinate of limits or a box that decides.
    Coordinate(usize),
    /// In the world: at the origin of the r-link, for the world box, or at its primitive, for a floor.
    World,
}

/// What a distance says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceKind {
    /// The distance, to rounding.
    Exact,
    /// Only `lower` and `upper` are known.
    LowerBound,
    /// Nothing is within the maximal distance asked for.
    BeyondMax,
    /// There is nothing to measure to.
    Empty,
}

/// A distance with safe bounds: `lower <= truth <= upper`.
#[derive(Clone, Debug)]
pub struct Distance {
    pub kind: DistanceKind,
    pub distance: f64,
    pub lower: f64,
    pub upper: f64,
    /// The nearest primitive pair; ties go to the lowest ids.
    pub witness: Option<Witness>,
    /// The closest points of the witness, and its contact there if it has one. Of a piece that is contained both are the same
    /// vertex of it.
    pub points: [Vec3; 2],
    pub contact: Option<ContactRecord>,
    /// The version of the environment that was measured; 0 if there is none.
    pub version: u64,
}

/// A primitive pair, a piece of a body inside another body, or a pure set, whose numbers of links and primitives are 0 unless
/// it is one of the world. Its contacts are `contact_count` entries of the list it comes in, from `first_contact`.
#[derive(Clone, Copy, Debug)]
pub struct Witness {
    /// The leaf of the C-object that it is of.
    pub leaf: Leaf,
    pub r_link: usize,
    /// The s-object attached to the link that is the r-side, or 0 for the link's own body.
    pub r_object: u64,
    /// The link that the s-object is attached to, if it is.
    pub s_carrier: Option<usize>,
    pub s_side: SSide,
    pub primitives: [u32; 2],
    pub tags: [u64; 2],
    /// The user data of the two sides, or 0.
    pub data: [usize; 2],
    pub distance: f64,
    pub first_contact: usize,
    pub contact_count: usize,
    /// The primitives' interiors overlap, or `contained`: there is no contact, and no gradient.
    pub overlapping: bool,
    /// It is the complement of a pure set that is near.
    pub complemented: bool,
    /// A piece of one body lies wholly inside the other, a solid, and the primitives, which do not meet, stand for the
    /// two: the lowest of the piece, and the lowest of what of the solid's boundary is around it. The distance is 0,
    /// whatever that of the primitives is.
    pub contained: bool,
}

/// One contact, in the world. One of a pure set has neither points nor a normal, unless it is of the world box or a floor.
#[derive(Clone, Copy, Debug)]
pub struct ContactRecord {
    pub points: [Vec3; 2],
    /// Unit, from s to r.
    pub normal: Vec3,
    /// Less the margin, and at least 0.
    pub distance: f64,
    /// The same with its sign: negative within the margin, and where the primitives are just inside one another, or
    /// round ones deeper while their cores are apart.
    pub clearance: f64,
    pub mode: ContactMode,
    pub features: [Feature; 2],
}

/// Which contacts come with witnesses. Finding them takes most of the time that a witness takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactsListed {
    /// All of each pair of primitives.
    #[default]
    All,
    /// The one at the closest points.
    Nearest,
    /// None, and no gradients: it is not told whether what meets touches or overlaps, so that all of it counts as
    /// overlapping.
    None,
}

/// All primitive pairs within a threshold, nearest first, and their contacts; with each piece of a body that lies inside
/// another, at distance 0.
#[derive(Clone, Debug, Default)]
pub struct WitnessList {
    pub witnesses: Vec<Witness>,
    pub contacts: Vec<ContactRecord>,
    /// One row of nv numbers per contact; empty where no gradients were asked for.
    pub gradients: Vec<f64>,
    /// The length of a row.
    pub nv: usize,
    /// There are more witnesses than were asked for; these are the nearest.
    pub truncated: bool,
    pub version: u64,
}

/// A primitive pair that meets, and the shortest translation that takes the two apart.
#[derive(Clone, Copy, Debug)]
pub struct PrimitivePenetration {
    pub primitives: [u32; 2],
    pub tags: [u64; 2],
    /// In the world.
    pub penetration: Penetration,
}

/// All primitive pairs that meet, the deepest first. Pieces of a body inside another have none.
#[derive(Clone, Debug, Default)]
pub struct PenetrationList {
    pub penetrations: Vec<PrimitivePenetration>,
    /// The bodies are one primitive each, so that the first entry takes the bodies apart; else each takes apart its two
    /// primitives only.
    pub of_whole_bodies: bool,
    /// There are more than were asked for; these are the deepest.
    pub truncated: bool,
}
