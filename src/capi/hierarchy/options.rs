//! How the hierarchies of bodies are built.

use crate::capi::boundary::{Failure, guard};
use crate::capi::input::{OptionsStruct, write_defaults};
use crate::capi::status::status::cstk_status;
use crate::error::Error;
use crate::hierarchy::grouping::Cost;
use crate::hierarchy::{Grouping, HierarchyOptions, Pieces, WrapperKind};

/// The algorithm that groups primitives into a binary tree.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_grouping {
    /// Clusters edge-adjacent primitives, then near ones (the report's Simple Hybrid). The default. More than 16,384 parts
    /// without pieces are first cut top-down into regions of at most that size. Bodies of points only
    /// (cstk_body_builder_add_points), which have no edges, are split top-down altogether.
    CSTK_GROUPING_HYBRID = 0,
    /// Clusters near primitives, in such regions; needs no adjacency (the report's Basic Clustering).
    CSTK_GROUPING_BASIC = 1,
    /// Splits top-down by the surface-area heuristic; the fastest to build.
    CSTK_GROUPING_TOP_DOWN = 2,
}

/// The kind of convex bound at each node.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_wrapper_kind {
    /// Convex hulls, or oriented boxes where a hull has more than hull_vertex_limit vertices. The default. Unless a
    /// primitive is cut into slabs, they are computed when nodes are first inspected, on as many threads as the build, and
    /// the boxes that queries traverse are fitted to the primitives themselves.
    CSTK_WRAPPER_HULL = 0,
    CSTK_WRAPPER_ORIENTED_BOX = 1,
    CSTK_WRAPPER_ALIGNED_BOX = 2,
    /// Spheres around the vertices below the node.
    CSTK_WRAPPER_TIGHT_SPHERE = 3,
    /// Spheres around the children's spheres; the fastest to build, and loose.
    CSTK_WRAPPER_MERGED_SPHERE = 4,
}

/// Whether primitives that form a convex piece of the body get their own node, bounded exactly.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_pieces {
    CSTK_PIECES_OFF = 0,
    /// Coplanar neighbours whose union is a convex polygon.
    CSTK_PIECES_COPLANAR = 1,
    /// Also edge-adjacent polygons that bound a convex part of a closed body.
    CSTK_PIECES_PATCHES = 2,
}

/// Options of a body's hierarchy. Write it with cstk_hierarchy_options_default first. They affect the speed of queries,
/// never their answers.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_hierarchy_options {
    pub size: u32,
    pub cookie: u32,
    /// The most vertices of a convex hull; larger ones become oriented boxes. At least 8; default 32.
    pub hull_vertex_limit: u32,
    /// The number of threads to build on; 0 for as many as the machine runs at once. Default 1. The hierarchy does not
    /// depend on it.
    pub threads: u32,
    /// A cstk_grouping.
    pub grouping: i32,
    /// A cstk_wrapper_kind.
    pub wrapper: i32,
    /// A cstk_pieces.
    pub pieces: i32,
    pub reserved: u32,
    /// A (at most 16), B and C of the cost of merging two clusters, diameter^A (B Fill + C Balance): Fill is the merged
    /// diameter over the sum of the two, Balance the larger ratio of the two. Not negative.
    pub cost_diameter: f64,
    pub cost_fill: f64,
    pub cost_balance: f64,
    /// The largest diameter of clusters merged in the first round, and the largest gap between them; both double from round
    /// to round. 0, the default, for limits that suit the primitives.
    pub diameter_limit: f64,
    pub gap_limit: f64,
    /// Primitives longer than this many times their width get several leaves, each bounding a part; witnesses still name
    /// the primitive. At least 1.5, or 0, the default, for one leaf each.
    pub aspect_limit: f64,
}

// SAFETY: repr(C), eight 4-byte numbers, then doubles.
unsafe impl OptionsStruct for cstk_hierarchy_options {
    const COOKIE: u32 = 0x4353_0101;
    const NAME: &'static str = "cstk_hierarchy_options";
    const EARLIER_SIZES: &'static [usize] = &[16];
    fn defaults() -> Self {
        let options = HierarchyOptions::default();
        Self {
            size: 0,
            cookie: 0,
            hull_vertex_limit: options.hull_vertex_limit,
            threads: options.threads,
            grouping: cstk_grouping::CSTK_GROUPING_HYBRID as i32,
            wrapper: cstk_wrapper_kind::CSTK_WRAPPER_HULL as i32,
            pieces: cstk_pieces::CSTK_PIECES_OFF as i32,
            reserved: 0,
            cost_diameter: options.cost.diameter,
            cost_fill: options.cost.fill,
            cost_balance: options.cost.balance,
            diameter_limit: options.diameter_limit,
            gap_limit: options.gap_limit,
            aspect_limit: options.aspect_limit,
        }
    }
}

impl cstk_hierarchy_options {
    /// The options of the core; their ranges are checked there.
    pub(crate) fn decode(&self) -> Result<HierarchyOptions, Failure> {
        let unknown = |name: &str, value: i32, of: &str| {
            Error::invalid(format!("{name} is {value}, which is no {of}"))
        };
        if self.reserved != 0 {
            return Err(Error::invalid("reserved must be 0").into());
        }
        Ok(HierarchyOptions {
            grouping: [Grouping::Hybrid, Grouping::Basic, Grouping::TopDown]
                .into_iter()
                .find(|&grouping| cstk_grouping::from(grouping) as i32 == self.grouping)
                .ok_or_else(|| unknown("grouping", self.grouping, "cstk_grouping"))?,
            wrapper: [
                WrapperKind::Hull,
                WrapperKind::OrientedBox,
                WrapperKind::AlignedBox,
                WrapperKind::TightSphere,
                WrapperKind::MergedSphere,
            ]
            .into_iter()
            .find(|&kind| cstk_wrapper_kind::from(kind) as i32 == self.wrapper)
            .ok_or_else(|| unknown("wrapper", self.wrapper, "cstk_wrapper_kind"))?,
            pieces: [Pieces::Off, Pieces::Coplanar, Pieces::Patches]
                .into_iter()
                .find(|&pieces| cstk_pieces::from(pieces) as i32 == self.pieces)
                .ok_or_else(|| unknown("pieces", self.pieces, "cstk_pieces"))?,
            hull_vertex_limit: self.hull_vertex_limit,
            threads: self.threads,
            cost: Cost {
                diameter: self.cost_diameter,
                fill: self.cost_fill,
                balance: self.cost_balance,
            },
            diameter_limit: self.diameter_limit,
            gap_limit: self.gap_limit,
            aspect_limit: self.aspect_limit,
        })
    }
}

impl From<Grouping> for cstk_grouping {
    fn from(grouping: Grouping) -> Self {
        match grouping {
            Grouping::Hybrid => Self::CSTK_GROUPING_HYBRID,
            Grouping::Basic => Self::CSTK_GROUPING_BASIC,
            Grouping::TopDown => Self::CSTK_GROUPING_TOP_DOWN,
        }
    }
}

impl From<WrapperKind> for cstk_wrapper_kind {
    fn from(kind: WrapperKind) -> Self {
        match kind {
            WrapperKind::Hull => Self::CSTK_WRAPPER_HULL,
            WrapperKind::OrientedBox => Self::CSTK_WRAPPER_ORIENTED_BOX,
            WrapperKind::AlignedBox => Self::CSTK_WRAPPER_ALIGNED_BOX,
            WrapperKind::TightSphere => Self::CSTK_WRAPPER_TIGHT_SPHERE,
            WrapperKind::MergedSphere => Self::CSTK_WRAPPER_MERGED_SPHERE,
        }
    }
}

impl From<Pieces> for cstk_pieces {
    fn from(pieces: Pieces) -> Self {
        match pieces {
            Pieces::Off => Self::CSTK_PIECES_OFF,
            Pieces::Coplanar => Self::CSTK_PIECES_COPLANAR,
            Pieces::Patches => Self::CSTK_PIECES_PATCHES,
        }
    }
}

/// Writes the default options. `size` is sizeof(cstk_hierarchy_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_hierarchy_options_default(
    out: *mut cstk_hierarchy_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}
