//! A body: primitives, their user tags, and the tree over them.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use super::pieces::{Piece, Pieces};
use super::solid::Solid;
use crate::error::{Error, Result};
use crate::hierarchy::packed::PackedTree;
use crate::hierarchy::wrapper::{WrapperTree, Wrappers};
use crate::hierarchy::{BuildTimes, TreeStatistics, WrapperKind, require_level};
use crate::pose::Vec3;
use crate::primitive::Primitives;
use crate::user_data::UserData;

/// A rigid union of convex primitives, in a frame of its own whose origin is `center` in the caller's frame: the middle
/// of the primitives' box. Distances are computed around it, so that bodies modelled far from their origin lose nothing.
#[derive(Debug)]
pub struct Body {
    serial: u64,
    pub(super) dimension: u32,
    pub(super) center: Vec3,
    pub(super) radius: f64,
    pub(super) deviation: f64,
    has_functions: bool,
    pub(super) primitives: Primitives,
    pub(super) wrappers: Wrappers,
    pub(super) packed: PackedTree,
    pub(super) solid: Option<Solid>,
    /// Made when first asked for, but for solids. Bodies of nothing but points do without.
    pieces: OnceLock<Pieces>,
    pub(super) statistics: BodyStatistics,
    data: OnceLock<UserData>,
}

/// What became of the input, and what was built.
#[derive(Clone, Copy, Debug, Default)]
pub struct BodyStatistics {
    pub primitives: u64,
    /// Faces of meshes that were not convex or not planar and became several triangles.
    pub faces_split: u64,
    /// Faces of meshes that had no area and were left out.
    pub faces_dropped: u64,
    pub nodes: u64,
    pub depth: u64,
    /// The body was declared solid.
    pub is_solid: bool,
    /// The box of the body, in the caller's frame.
    pub low: [f64; 3],
    pub high: [f64; 3],
    pub times: BuildTimes,
}

impl Body {
    pub(super) fn assemble(
        dimension: u32,
        center: Vec3,
        primitives: Primitives,
        wrappers: Wrappers,
        packed: PackedTree,
        statistics: BodyStatistics,
    ) -> Self {
        static NEXT_SERIAL: AtomicU64 = AtomicU64::new(1);
        Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            dimension,
            center,
            radius: primitives.radius(),
            deviation: primitives.deviation(),
            has_functions: primitives.have_functions(),
            packed,
            primitives,
            wrappers,
            solid: None,
            pieces: OnceLock::new(),
            statistics,
            data: OnceLock::new(),
        }
    }

    /// The same body with what its polygons bound.
    pub(super) fn bounding(mut self, solid: Option<Solid>) -> Self {
        if let Some(solid) = &solid {
            self.pieces = Pieces::new(&self.primitives, solid.scraps()).into();
        }
        self.solid = solid;
        self
    }

    /// A number no other body of this process has; caches key on it.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// 2 for bodies of planar worlds, else 3.
    pub fn dimension(&self) -> u32 {
        self.dimension
    }

    /// The origin of the body's own frame, in the caller's frame.
    pub fn center(&self) -> &Vec3 {
        &self.center
    }

    /// The largest distance of a vertex from the centre; of a bounding point of what is curved.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// No point is farther from the origin of the caller's frame.
    pub fn radius_from_origin(&self) -> f64 {
        self.center.norm() + self.radius
    }

    /// The largest deviation of a primitive from its faces (see [`Convex`]).
    pub fn deviation(&self) -> f64 {
        self.deviation
    }

    /// Whether queries run support functions of the caller's.
    pub fn has_functions(&self) -> bool {
        self.has_functions
    }

    /// The primitives, in the body's own (centred) frame.
    pub fn primitives(&self) -> &Primitives {
        &self.primitives
    }

    /// The number of the caller's data, or 0.
    pub fn data(&self) -> usize {
        self.data.get().map_or(0, |data| data.value)
    }

    /// Attaches the caller's data; once.
    pub fn set_data(&self, data: UserData) -> Result<()> {
        self.data
            .set(data)
            .map_err(|_| Error::invalid("the body has data already"))
    }

    pub fn tag(&self, primitive: u32) -> u64 {
        self.primitives.tag(primitive as usize)
    }

    /// The wrapper tree; of hulls and of clouds it is made when first asked for.
    pub fn tree(&self) -> &WrapperTree {
        self.wrappers.tree(&self.primitives)
    }

    /// Fails for a level that the hierarchy does not have. Makes no wrappers.
    pub fn require_level(&self, level: u32) -> Result<()> {
        require_level(level, self.statistics.depth as usize)
    }

    /// The kind of the wrappers, made or not.
    pub fn wrapper_kind(&self) -> WrapperKind {
        self.wrappers.kind()
    }

    /// What the hierarchy is like, with the bytes that it and the points of clouds take. Makes
    /// no wrappers.
    pub fn tree_statistics(&self) -> TreeStatistics {
        let statistics = self.wrappers.statistics(&self.primitives);
        let read = self.packed.bytes() + self.primitives.point_bytes();
        TreeStatistics {
            bytes: statistics.bytes + read as u64,
            ..statistics
        }
    }

    /// The tree as queries walk it.
    pub fn packed(&self) -> &PackedTree {
        &self.packed
    }

    /// The place of its primitive, if it has but one.
    pub fn only_place(&self) -> Option<u32> {
        let root = self.packed.root();
        root.is_leaf().then(|| self.packed.place(root))
    }

    /// Whether it is one primitive, and no more than that.
    pub fn is_single(&self) -> bool {
        self.only_place().is_some() && self.solid.is_none()
    }

    /// What its polygons bound, if the body is a solid of space that has some.
    #[inline(always)]
    pub fn solid(&self) -> Option<&Solid> {
        self.solid.as_ref()
    }

    /// What of it hangs together.
    pub fn pieces(&self) -> &Pieces {
        self.pieces
            .get_or_init(|| Pieces::new(&self.primitives, &[]))
    }

    pub fn piece_count(&self) -> usize {
        match self.primitives.are_points() {
            true => self.primitives.len(),
            false => self.pieces().list.len(),
        }
    }

    /// A piece by its number; pieces are in the order of their lowest primitives.
    pub fn piece(&self, number: u32) -> Piece {
        match self.primitives.are_points() {
            true => Piece::of_point(number, &self.primitives.points()[number as usize]),
            false => self.pieces().list[number as usize],
        }
    }

    /// The number of the piece that a primitive belongs to.
    pub fn piece_of(&self, primitive: u32) -> u32 {
        match self.primitives.are_points() {
            true => primitive,
            false => self.pieces().of(primitive),
        }
    }

    pub fn statistics(&self) -> &BodyStatistics {
        &self.statistics
    }
}
