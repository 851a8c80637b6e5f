//! The result structures of queries, and their conversion.

use std::ffi::c_void;

use crate::capi::body::body::cstk_feature_kind;
use crate::capi::user_data::address;
use crate::cobject::Class;
use crate::convex::ContactMode;
use crate::query::{
    ContactRecord, Distance, DistanceKind, PrimitivePenetration, PurePlace, SSide, Witness,
};

/// Means "none" in fields that hold the number of a link or a coordinate.
pub const CSTK_NONE: u32 = 0xFFFF_FFFF;

/// The class of a configuration. The order is that of the set algebra: a union takes the largest.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_class {
    /// Farther away than the contact epsilon.
    CSTK_CLASS_OUTSIDE = 0,
    /// Apart, but no farther than the contact epsilon; doubt within rounding counts as contact.
    CSTK_CLASS_CONTACT = 1,
    /// The sets meet: distance 0.
    CSTK_CLASS_INSIDE = 2,
}

impl From<Class> for cstk_class {
    fn from(class: Class) -> Self {
        match class {
            Class::Outside => Self::CSTK_CLASS_OUTSIDE,
            Class::Contact => Self::CSTK_CLASS_CONTACT,
            Class::Inside => Self::CSTK_CLASS_INSIDE,
        }
    }
}

/// The contact modes of §4.4: the r-feature, then the s-feature.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_contact_mode {
    CSTK_MODE_POINT_POINT = 0,
    CSTK_MODE_POINT_EDGE = 1,
    CSTK_MODE_EDGE_POINT = 2,
    CSTK_MODE_POINT_FACE = 3,
    CSTK_MODE_FACE_POINT = 4,
    CSTK_MODE_EDGE_EDGE = 5,
    /// The boundary of a pure set: there are no features. Points and normal are 0, except for the world box (at the link's
    /// origin) and for a floor (at the link's lowest point).
    CSTK_MODE_PURE_SET = 6,
}

/// A contact. The r-side is the link (or body a), the s-side the s-object, second link or body b.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_contact {
    /// The witness points, in the world.
    pub r_point: [f64; 3],
    pub s_point: [f64; 3],
    /// Of length 1, in the world, from the s-side to the r-side; also valid at exact touch.
    pub normal: [f64; 3],
    /// The distance between the points, less the C-object's margin and at least 0.
    pub distance: f64,
    pub mode: cstk_contact_mode,
    /// The features that hold the points; cstk_body_get_feature_vertices gives their vertices.
    pub r_feature_kind: cstk_feature_kind,
    pub r_feature: u32,
    pub s_feature_kind: cstk_feature_kind,
    pub s_feature: u32,
    pub reserved_word: u32,
    /// The signed distance between the points, less the C-object's margin. It is negative within the margin, and where
    /// primitives overlap slightly: by at most 1e-6 of the pair's size, or, for round ones, as deep as their radii allow
    /// while their cores are apart: by 1e-6 of
    /// the pair's size at least, where a smooth core is a thousand times smaller than the radii.
    pub clearance: f64,
    pub reserved: [u64; 2],
}

/// A pair of primitives, a piece of one body wholly inside the other, or a pure set. The links of a pure set are CSTK_NONE,
/// except `r_link` of the world box and of floors: the link nearest to the set, or deepest in it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_witness {
    /// The link, by number in the space; 0 in queries on two bodies or on objects against
    /// objects.
    pub r_link: u32,
    /// The second link, or the link that the s-object is attached to; CSTK_NONE for other s-objects and for bodies.
    pub s_link: u32,
    /// The s-object's id, or 0.
    pub s_object: u64,
    /// The primitives' numbers in their bodies, and their tags.
    pub r_primitive: u32,
    pub s_primitive: u32,
    pub r_tag: u64,
    pub s_tag: u64,
    /// The primitives' distance, less the C-object's margin and at least 0.
    pub distance: f64,
    /// The contacts are `contact_count` entries of the list from `first_contact` on. Parallel features have several
    /// contacts, which span their common part.
    pub first_contact: u32,
    pub contact_count: u32,
    /// The primitives overlap more than slightly, or `contained` is set: there is no contact and no gradient. With
    /// CSTK_CONTACTS_NONE every pair at distance 0 counts as overlapping.
    pub overlapping: bool,
    /// A connected piece of one body lies wholly inside the other, a solid. The primitives, which do not meet, are the
    /// lowest of the piece and the lowest of the part of the solid's boundary around it.
    pub contained: bool,
    /// The distance is that of the set's complement.
    pub complemented: bool,
    pub reserved_bytes: [u8; 1],
    /// For joint limits and C-space boxes, the coordinate that decides: the one farthest outside its range, or nearest to
    /// an end of it (the distance combines all coordinates). Otherwise CSTK_NONE.
    pub coordinate: u32,
    /// The leaf C-object that the pair belongs to, by its number (cstk_cobject_get_data), and its data; 0 and NULL in
    /// queries on two bodies.
    pub cobject: u64,
    pub cobject_data: *mut c_void,
    /// The data of the r-side's body, and of the s-object or, if it has none, of its body; NULL for none.
    pub r_data: *mut c_void,
    pub s_data: *mut c_void,
    /// The s-object attached to `r_link` that is the r-side, or 0 for the link's own body. In queries on objects against objects,
    /// the first object.
    pub r_object: u64,
    /// The parts of their bodies that the primitives belong to, by number (cstk_body_get_part); CSTK_NONE for primitives
    /// that were added to their bodies by themselves.
    pub r_part: u32,
    pub s_part: u32,
    pub reserved: [u64; 3],
}

// SAFETY: the caller's addresses are only handed back, never followed.
unsafe impl Send for cstk_witness {}

/// How much is known of a distance.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_distance_kind {
    /// The distance is known, up to rounding.
    CSTK_DISTANCE_EXACT = 0,
    /// Only `lower` and `upper` are known; `distance` equals `lower`.
    CSTK_DISTANCE_LOWER_BOUND = 1,
    /// Nothing is within max_distance: `lower` is max_distance less rounding, `distance` and `upper` are infinite.
    CSTK_DISTANCE_BEYOND_MAX = 2,
    /// The set is empty; all three are infinite.
    CSTK_DISTANCE_EMPTY = 3,
}

/// A distance with safe bounds: lower <= truth <= upper.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_distance_result {
    pub kind: cstk_distance_kind,
    /// Whether `witness`, `r_point` and `s_point` are set: the nearest primitive pair. Ties (equal to the last bit) go to
    /// the lowest ids.
    pub has_witness: bool,
    /// Whether `contact` is set: the contact at these points. An overlap has none; parallel features have more, see
    /// cstk_witnesses.
    pub has_contact: bool,
    pub reserved_bytes: [u8; 2],
    /// 0 if and only if the sets meet, the s-side grown by the C-object's margin.
    pub distance: f64,
    /// Never above the true distance. Where `distance` is finite, `lower` is 0 if and only if `distance` is.
    pub lower: f64,
    /// Never below the true distance; infinite where nothing better is known, for an intersection, a difference or a
    /// complement.
    pub upper: f64,
    /// The witness points, in the world. Where the sets overlap both are one common point; for a piece inside a solid both
    /// are a vertex of the piece.
    pub r_point: [f64; 3],
    pub s_point: [f64; 3],
    pub witness: cstk_witness,
    pub contact: cstk_contact,
    /// The version of the environment that the query saw, the largest of several; 0 without an environment.
    pub environment_version: u64,
    pub reserved: [u64; 8],
}

/// Witnesses, nearest first, with their contacts. The arrays belong to the query context and stay valid until its next call
/// or its release.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_witness_list {
    pub witnesses: *const cstk_witness,
    pub witness_count: usize,
    pub contacts: *const cstk_contact,
    pub contact_count: usize,
    /// One row of `nv` doubles per contact (not per witness): the derivative of its distance with respect to each velocity.
    /// NULL without gradients.
    pub gradients: *const f64,
    pub nv: usize,
    /// There are more witnesses than max_count; these are the nearest.
    pub truncated: bool,
    /// cstk_query_set_contacts has left out contacts: cstk_slide_step and cstk_spring_step refuse the list.
    pub contacts_left_out: bool,
    pub reserved_bytes: [u8; 6],
    pub environment_version: u64,
    pub reserved: [u64; 8],
}

/// A pair of primitives that meet, and the shortest translation that separates them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_penetration {
    /// The primitives' numbers in their bodies, and their tags.
    pub r_primitive: u32,
    pub s_primitive: u32,
    pub r_tag: u64,
    pub s_tag: u64,
    /// The length of the translation; 0 for primitives that only touch, or whose interiors do not meet.
    pub depth: f64,
    /// The direction in which body a must move: a unit vector in the world, from body b to body a.
    pub direction: [f64; 3],
    /// A point of each primitive, in the world, that the translation brings together: s_point = r_point + depth *
    /// direction.
    pub r_point: [f64; 3],
    pub s_point: [f64; 3],
    /// The parts of their bodies that the primitives belong to, as in a cstk_witness.
    pub r_part: u32,
    pub s_part: u32,
    pub reserved: [u64; 5],
}

/// Primitive pairs that meet, deepest first. The array belongs to the query context and stays valid until its next call or
/// its release.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_penetration_list {
    pub penetrations: *const cstk_penetration,
    pub count: usize,
    /// Each body is a single convex primitive, so that the first entry separates the bodies. Otherwise an entry separates
    /// its two primitives only.
    pub of_whole_bodies: bool,
    /// More pairs meet than max_count; these are the deepest.
    pub truncated: bool,
    pub reserved_bytes: [u8; 6],
    pub reserved: [u64; 5],
}

impl From<&PrimitivePenetration> for cstk_penetration {
    fn from(pair: &PrimitivePenetration) -> Self {
        let penetration = &pair.penetration;
        Self {
            r_primitive: pair.primitives[0],
            s_primitive: pair.primitives[1],
            r_tag: pair.tags[0],
            s_tag: pair.tags[1],
            depth: penetration.depth,
            direction: penetration.direction.into(),
            r_point: penetration.points[0].into(),
            s_point: penetration.points[1].into(),
            r_part: pair.parts[0].unwrap_or(CSTK_NONE),
            s_part: pair.parts[1].unwrap_or(CSTK_NONE),
            reserved: [0; 5],
        }
    }
}

impl From<&ContactRecord> for cstk_contact {
    #[inline(always)]
    fn from(contact: &ContactRecord) -> Self {
        Self {
            r_point: contact.points[0].into(),
            s_point: contact.points[1].into(),
            normal: contact.normal.into(),
            distance: contact.distance,
            mode: match contact.mode {
                ContactMode::PointPoint => cstk_contact_mode::CSTK_MODE_POINT_POINT,
                ContactMode::PointEdge => cstk_contact_mode::CSTK_MODE_POINT_EDGE,
                ContactMode::EdgePoint => cstk_contact_mode::CSTK_MODE_EDGE_POINT,
                ContactMode::PointFace => cstk_contact_mode::CSTK_MODE_POINT_FACE,
                ContactMode::FacePoint => cstk_contact_mode::CSTK_MODE_FACE_POINT,
                ContactMode::EdgeEdge => cstk_contact_mode::CSTK_MODE_EDGE_EDGE,
                ContactMode::PureSet => cstk_contact_mode::CSTK_MODE_PURE_SET,
            },
            r_feature_kind: contact.features[0].kind.into(),
            r_feature: contact.features[0].index,
            s_feature_kind: contact.features[1].kind.into(),
            s_feature: contact.features[1].index,
            reserved_word: 0,
            clearance: contact.clearance,
            reserved: [0; 2],
        }
    }
}

impl cstk_contact {
    fn none() -> Self {
        Self {
            r_point: [0.0; 3],
            s_point: [0.0; 3],
            normal: [0.0; 3],
            distance: 0.0,
            mode: cstk_contact_mode::CSTK_MODE_POINT_POINT,
            r_feature_kind: cstk_feature_kind::CSTK_FEATURE_VERTEX,
            r_feature: 0,
            s_feature_kind: cstk_feature_kind::CSTK_FEATURE_VERTEX,
            s_feature: 0,
            reserved_word: 0,
            clearance: 0.0,
            reserved: [0; 2],
        }
    }
}

impl From<&Witness> for cstk_witness {
    #[inline(always)]
    fn from(witness: &Witness) -> Self {
        let (r_link, s_object, s_link) = match witness.s_side {
            SSide::Object(id) => {
                let carrier = witness.s_carrier.map_or(CSTK_NONE, |link| link as u32);
                (witness.r_link as u32, id, carrier)
            }
            SSide::Link(link) => (witness.r_link as u32, 0, link as u32),
            SSide::PureSet(PurePlace::World) => (witness.r_link as u32, 0, CSTK_NONE),
            SSide::PureSet(_) => (CSTK_NONE, 0, CSTK_NONE),
        };
        Self {
            r_link,
            s_link,
            s_object,
            r_primitive: witness.primitives[0],
            s_primitive: witness.primitives[1],
            r_tag: witness.tags[0],
            s_tag: witness.tags[1],
            distance: witness.distance,
            first_contact: witness.first_contact as u32,
            contact_count: witness.contact_count as u32,
            overlapping: witness.overlapping,
            contained: witness.contained,
            complemented: witness.complemented,
            reserved_bytes: [0; 1],
            coordinate: match witness.s_side {
                SSide::PureSet(PurePlace::Coordinate(i)) => i as u32,
                _ => CSTK_NONE,
            },
            cobject: witness.leaf.serial,
            cobject_data: address(witness.leaf.data),
            r_data: address(witness.data[0]),
            s_data: address(witness.data[1]),
            r_object: witness.r_object,
            r_part: witness.parts[0].unwrap_or(CSTK_NONE),
            s_part: witness.parts[1].unwrap_or(CSTK_NONE),
            reserved: [0; 3],
        }
    }
}

impl cstk_witness {
    fn none() -> Self {
        Self {
            r_link: CSTK_NONE,
            s_link: CSTK_NONE,
            s_object: 0,
            r_primitive: 0,
            s_primitive: 0,
            r_tag: 0,
            s_tag: 0,
            distance: 0.0,
            first_contact: 0,
            contact_count: 0,
            overlapping: false,
            contained: false,
            complemented: false,
            reserved_bytes: [0; 1],
            coordinate: CSTK_NONE,
            cobject: 0,
            cobject_data: std::ptr::null_mut(),
            r_data: std::ptr::null_mut(),
            s_data: std::ptr::null_mut(),
            r_object: 0,
            r_part: CSTK_NONE,
            s_part: CSTK_NONE,
            reserved: [0; 3],
        }
    }
}

impl From<&Distance> for cstk_distance_result {
    #[inline(always)]
    fn from(distance: &Distance) -> Self {
        Self {
            kind: match distance.kind {
                DistanceKind::Exact => cstk_distance_kind::CSTK_DISTANCE_EXACT,
                DistanceKind::LowerBound => cstk_distance_kind::CSTK_DISTANCE_LOWER_BOUND,
                DistanceKind::BeyondMax => cstk_distance_kind::CSTK_DISTANCE_BEYOND_MAX,
                DistanceKind::Empty => cstk_distance_kind::CSTK_DISTANCE_EMPTY,
            },
            has_witness: distance.witness.is_some(),
            has_contact: distance.contact.is_some(),
            reserved_bytes: [0; 2],
            distance: distance.distance,
            lower: distance.lower,
            upper: distance.upper,
            r_point: distance.points[0].into(),
            s_point: distance.points[1].into(),
            witness: distance
                .witness
                .as_ref()
                .map_or_else(cstk_witness::none, From::from),
            contact: distance
                .contact
                .as_ref()
                .map_or_else(cstk_contact::none, From::from),
            environment_version: distance.version,
            reserved: [0; 8],
        }
    }
}
