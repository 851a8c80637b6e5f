//! A body: primitives, their user tags, and the tree over them.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use super::curved_cells::CurvedCells;
use super::joints::Joints;
use super::part::{BodyPart, part_of};
use super::pieces::{Piece, Pieces};
use super::solid::Solid;
use crate::error::{Error, Result};
use crate::hierarchy::packed::PackedTree;
use crate::hierarchy::wrapper::{WrapperTree, Wrappers};
use crate::hierarchy::{BuildTimes, TreeStatistics, WrapperKind, require_level};
use crate::pose::Vec3;
use crate::primitive::{Primitives, Round, is_plain_solid};
use crate::user_data::UserData;

/// A rigid union of convex primitives with its hierarchy. Its own frame has its origin at `center` in the caller's frame, the
/// middle of the primitives' box. Distances are computed in it, so that bodies modelled far from their origin lose no
/// precision.
#[derive(Debug)]
pub struct Body {
    serial: u64,
    pub(super) dimension: u32,
    pub(super) center: Vec3,
    pub(super) radius: f64,
    pub(super) deviation: f64,
    pub(super) stated_deviation: f64,
    /// What the deviation is of primitives that are no cells of patches.
    flat_deviation: f64,
    curved: Option<CurvedCells>,
    has_functions: bool,
    only_round: Option<Round>,
    is_plain_solid: bool,
    pub(super) primitives: Primitives,
    pub(super) wrappers: Wrappers,
    pub(super) packed: PackedTree,
    pub(super) solid: Option<Solid>,
    pub(super) parts: Vec<BodyPart>,
    /// Computed when a solid is first refitted, shared with what it is refitted to.
    pub(super) joints: Arc<OnceLock<Joints>>,
    /// Computed on first use, for solids with the body unless that is refitted. Point clouds need none.
    pieces: OnceLock<Pieces>,
    /// Computed on first use, of solids.
    pub(super) convex_whole: OnceLock<Option<Box<Body>>>,
    /// Computed on first use.
    pub(super) hull: OnceLock<Option<Box<Body>>>,
    pub(super) statistics: BodyStatistics,
    data: OnceLock<UserData>,
}

/// Counts, size and build times of a body.
#[derive(Clone, Copy, Debug, Default)]
pub struct BodyStatistics {
    /// Number of primitives.
    pub primitives: u64,
    /// Faces of meshes that were not convex or not planar and became several triangles.
    pub faces_split: u64,
    /// Faces of meshes that had no area and became no primitive.
    pub faces_dropped: u64,
    /// Number of nodes of the binary tree.
    pub nodes: u64,
    /// Number of levels of the binary tree.
    pub depth: u64,
    /// Whether the body was declared solid.
    pub is_solid: bool,
    /// The lowest coordinates of the body's box, in the caller's frame.
    pub low: [f64; 3],
    /// The highest coordinates of the body's box, in the caller's frame.
    pub high: [f64; 3],
    /// Seconds each phase of the build took.
    pub times: BuildTimes,
}

impl Body {
    pub(super) fn assemble(
        dimension: u32,
        center: Vec3,
        radius: f64,
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
            radius,
            deviation: primitives.deviation(),
            stated_deviation: 0.0,
            flat_deviation: 0.0,
            curved: None,
            has_functions: primitives.have_functions(),
            only_round: primitives.only().and_then(Round::of),
            is_plain_solid: is_one_plain_solid(&primitives, &packed),
            packed,
            primitives,
            wrappers,
            solid: None,
            parts: Vec::new(),
            joints: Arc::default(),
            pieces: OnceLock::new(),
            convex_whole: OnceLock::new(),
            hull: OnceLock::new(),
            statistics,
            data: OnceLock::new(),
        }
    }

    /// Adds the solid that the body's polygons bound, if they bound one.
    pub(super) fn with_solid(mut self, solid: Option<Solid>) -> Self {
        if let Some(solid) = &solid {
            self.pieces = Pieces::new(&self.primitives, solid.scraps()).into();
        }
        self.solid = solid;
        self
    }

    /// States how far the surface that the body stands for may be from it.
    pub(super) fn with_stated_deviation(mut self, stated_deviation: f64) -> Self {
        self.stated_deviation = stated_deviation;
        self.flat_deviation = stated_deviation;
        if stated_deviation != 0.0 {
            self.only_round = None;
            self.is_plain_solid = false;
        }
        self
    }

    /// Adds the cells of patches that some primitives stand for; the others are within `flat_deviation` of what they do. Called after
    /// [`Body::with_stated_deviation`].
    pub(super) fn with_curved(mut self, curved: Option<CurvedCells>, flat_deviation: f64) -> Self {
        if curved.is_some() {
            self.curved = curved;
            self.flat_deviation = flat_deviation;
        }
        self
    }

    /// Adds where the bodies are that the body was put together of.
    pub(super) fn with_parts(mut self, parts: Vec<BodyPart>) -> Self {
        self.parts = parts;
        self
    }

    /// The bodies that the body was put together of, in the order in which they were added.
    pub fn parts(&self) -> &[BodyPart] {
        &self.parts
    }

    /// The number of the part that a primitive belongs to; `None` if it was added by itself.
    #[inline(always)]
    pub fn part_of(&self, primitive: u32) -> Option<u32> {
        part_of(&self.parts, primitive)
    }

    /// A number that no other body of this process has; caches key on it.
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

    /// The largest distance of a vertex from the centre; of a curved primitive, that of a bounding point.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// An upper bound of the points' distance from the origin of the caller's frame.
    pub fn radius_from_origin(&self) -> f64 {
        self.center.norm() + self.radius
    }

    /// The largest deviation of a primitive from its faces (see [`Convex`](crate::primitive::Convex)).
    pub fn deviation(&self) -> f64 {
        self.deviation
    }

    /// How far the set that the body stands for may be from its primitives, as its builder was told: the Hausdorff distance of
    /// the two is at most this. It is subtracted from distances as a margin is (see `Target::margin` in the queries).
    pub fn stated_deviation(&self) -> f64 {
        self.stated_deviation
    }

    /// The cells of patches that primitives stand for, if any do.
    #[inline(always)]
    pub(crate) fn curved(&self) -> Option<&CurvedCells> {
        self.curved.as_ref()
    }

    /// How far primitives that are no cells of patches may be from what they stand for.
    pub(crate) fn flat_deviation(&self) -> f64 {
        self.flat_deviation
    }

    /// Whether queries call support functions of the caller.
    pub fn has_functions(&self) -> bool {
        self.has_functions
    }

    /// The primitives, in the body's own (centred) frame.
    pub fn primitives(&self) -> &Primitives {
        &self.primitives
    }

    /// The value of the caller's data, or 0.
    pub fn data(&self) -> usize {
        self.data.get().map_or(0, |data| data.value)
    }

    /// Attaches the caller's data. Fails if the body has data already.
    pub fn set_data(&self, data: UserData) -> Result<()> {
        self.data
            .set(data)
            .map_err(|_| Error::invalid("the body has data already"))
    }

    /// The caller's tag of a primitive.
    #[inline(always)]
    pub fn tag(&self, primitive: u32) -> u64 {
        self.primitives.tag(primitive as usize)
    }

    /// The wrapper tree; for hulls and clouds it is built on first use.
    pub fn tree(&self) -> &WrapperTree {
        self.wrappers.tree(&self.primitives)
    }

    /// Fails for a level that the hierarchy does not have. Builds no wrappers.
    pub fn require_level(&self, level: u32) -> Result<()> {
        require_level(level, self.statistics.depth as usize)
    }

    /// The kind of the wrappers, built or not.
    pub fn wrapper_kind(&self) -> WrapperKind {
        self.wrappers.kind()
    }

    /// The statistics of the hierarchy; the bytes include the packed tree and the points of clouds. Builds no wrappers.
    pub fn tree_statistics(&self) -> TreeStatistics {
        let statistics = self.wrappers.statistics(&self.primitives);
        let packed = self.packed.bytes() + self.primitives.point_bytes();
        TreeStatistics {
            bytes: statistics.bytes + packed as u64,
            ..statistics
        }
    }

    /// The tree that queries traverse.
    pub fn packed(&self) -> &PackedTree {
        &self.packed
    }

    /// The index of its packed primitive, if the tree is a single leaf.
    #[inline(always)]
    pub fn only_place(&self) -> Option<u32> {
        let root = self.packed.root();
        if !root.is_leaf() {
            return None;
        }
        Some(self.packed.place(root))
    }

    /// The sphere or capsule that is its only primitive, if it stands for nothing but that.
    #[inline(always)]
    pub fn only_round(&self) -> Option<&Round> {
        self.only_round.as_ref()
    }

    /// Whether it is one box, cylinder or cone, with or without a radius around it, and stands for nothing but that.
    #[inline(always)]
    pub fn is_plain_solid(&self) -> bool {
        self.is_plain_solid
    }

    /// Whether it is a single leaf that stands for nothing but itself, and no boundary of a solid.
    #[inline(always)]
    pub fn is_single(&self) -> bool {
        self.packed.root().is_leaf() && self.solid.is_none() && self.stated_deviation == 0.0
    }

    /// The solid that its polygons bound, if a spatial body was declared solid and has any.
    #[inline(always)]
    pub fn solid(&self) -> Option<&Solid> {
        self.solid.as_ref()
    }

    /// The connected pieces; computed on first use.
    pub fn pieces(&self) -> &Pieces {
        let scraps = self.solid.as_ref().map_or(&[][..], Solid::scraps);
        self.pieces
            .get_or_init(|| Pieces::new(&self.primitives, scraps))
    }

    /// Number of connected pieces.
    pub fn piece_count(&self) -> usize {
        match self.primitives.are_points() {
            true => self.primitives.len(),
            false => self.pieces().list.len(),
        }
    }

    /// A piece by its index; pieces are in the order of their lowest primitives.
    pub fn piece(&self, number: u32) -> Piece {
        match self.primitives.are_points() {
            true => Piece::of_point(number, &self.primitives.points()[number as usize]),
            false => self.pieces().list[number as usize],
        }
    }

    /// The index of the piece that a primitive belongs to.
    pub fn piece_of(&self, primitive: u32) -> u32 {
        match self.primitives.are_points() {
            true => primitive,
            false => self.pieces().of(primitive),
        }
    }

    /// Counts, size and build times.
    pub fn statistics(&self) -> &BodyStatistics {
        &self.statistics
    }
}

fn is_one_plain_solid(primitives: &Primitives, packed: &PackedTree) -> bool {
    let is_leaf = packed.root().is_leaf();
    let form = || {
        let packed = packed.primitives();
        packed.form(packed.entry(0))
    };
    let only = primitives.only().filter(|_| is_leaf);
    only.is_some_and(|only| is_plain_solid(only, form()))
}
