//! The options of a hierarchy build.

use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::grouping::Cost;

/// The algorithm of the grouping phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Grouping {
    /// Adjacent-element clustering, then basic clustering of its chunks (§3.2.5). For models that are built once and
    /// queried often. With pieces off, more than 16,384 parts are first cut into regions of at most that many by the
    /// surface-area heuristic, and each region is clustered.
    #[default]
    Hybrid,
    /// Basic clustering alone (§3.2.2): needs no adjacency. Large models are cut into regions as for `Hybrid`.
    Basic,
    /// Top-down splits by the surface-area heuristic (§3.4). The fastest to build.
    TopDown,
}

/// The kind of wrapper in the construction phase (§3.2.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WrapperKind {
    /// Convex hulls of bounded size, oriented boxes where the hull has more vertices (§2.3.4). If no primitive is cut
    /// into slabs, the hulls are built on first use, and the tree that queries traverse is fitted to the primitives
    /// themselves.
    #[default]
    Hull,
    /// Oriented boxes of about the least volume.
    OrientedBox,
    /// Axis-aligned boxes.
    AlignedBox,
    /// Spheres around the vertices of the leaves below: O(N log N), much tighter than merged ones.
    TightSphere,
    /// Spheres around the children's spheres: O(N).
    MergedSphere,
}

/// Which maximal convex pieces get a node of their own (§3.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pieces {
    /// No pieces: each primitive is grouped by itself.
    #[default]
    Off,
    /// Coplanar neighbours whose union is a convex polygon form a piece.
    Coplanar,
    /// As `Coplanar`, and edge-adjacent polygons that bound a convex part of a closed body form a piece.
    Patches,
}

/// The options of a build. Answers do not depend on them, only their cost does.
#[derive(Clone, Copy, Debug)]
pub struct HierarchyOptions {
    /// The algorithm that groups the primitives.
    pub grouping: Grouping,
    /// The kind of the nodes' wrappers.
    pub wrapper: WrapperKind,
    /// Which convex pieces get a node of their own.
    pub pieces: Pieces,
    /// Hulls with more vertices than this are replaced by oriented boxes (§2.3.4). At least 8.
    pub hull_vertex_limit: u32,
    /// Number of build threads; 0 for the machine's available parallelism. The tree does not depend on it.
    pub threads: u32,
    /// The cost of merging two bodies (eq. 2).
    pub cost: Cost,
    /// The first DLimit, the largest diameter of bodies to be merged, a length; 0 for twice the smallest primitive's.
    pub diameter_limit: f64,
    /// The first GLimit, the largest gap between bodies to be merged, a length; 0 for a quarter of DLimit.
    pub gap_limit: f64,
    /// Primitives longer than this many times their width get several leaves, each bounding a part (§3.4). At least 1.5,
    /// or 0 for one leaf each.
    pub aspect_limit: f64,
}

impl Default for HierarchyOptions {
    fn default() -> Self {
        Self {
            grouping: Grouping::default(),
            wrapper: WrapperKind::default(),
            pieces: Pieces::default(),
            hull_vertex_limit: 32,
            threads: 1,
            cost: Cost::default(),
            diameter_limit: 0.0,
            gap_limit: 0.0,
            aspect_limit: 0.0,
        }
    }
}

impl HierarchyOptions {
    /// Fails and names the option that is out of range.
    pub fn check(&self) -> Result<()> {
        if self.hull_vertex_limit < 8 {
            return Err(Error::invalid(format!(
                "hull_vertex_limit must be at least 8, not {}",
                self.hull_vertex_limit
            )));
        }
        if self.threads > 1024 {
            return Err(Error::invalid(format!(
                "threads must be at most 1024, not {}",
                self.threads
            )));
        }
        let non_negative = [
            ("cost_diameter", self.cost.diameter),
            ("cost_fill", self.cost.fill),
            ("cost_balance", self.cost.balance),
            ("diameter_limit", self.diameter_limit),
            ("gap_limit", self.gap_limit),
            ("aspect_limit", self.aspect_limit),
        ];
        for (name, value) in non_negative {
            if !value.is_finite() {
                return Err(Error::new(
                    ErrorKind::NotFinite,
                    format!("{name} is {value}; it must be finite"),
                ));
            }
            if value < 0.0 {
                return Err(Error::invalid(format!(
                    "{name} must not be negative, but is {value}"
                )));
            }
        }
        if self.cost.diameter > 16.0 {
            return Err(Error::invalid(format!(
                "cost_diameter must be at most 16, not {}",
                self.cost.diameter
            )));
        }
        if self.aspect_limit != 0.0 && self.aspect_limit < 1.5 {
            return Err(Error::invalid(format!(
                "aspect_limit must be 0 or at least 1.5, not {}",
                self.aspect_limit
            )));
        }
        Ok(())
    }

    /// The number of threads to build on.
    pub fn thread_count(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, |n| n.get()),
            n => n as usize,
        }
    }
}
