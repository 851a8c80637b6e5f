//! The wrapper tree of a body, which pictures, covers and whoever looks at single nodes read.

use std::sync::OnceLock;

use crate::hierarchy::{
    Ball, HierarchyOptions, TreeStatistics, WrapperKind, WrapperTree, ball_of, cloud_statistics,
    wrap_cloud,
};
use crate::primitive::Primitives;

/// Made when the body was built, or for a cloud of points when it is first asked for: queries do without it, and it takes
/// ten times the memory of all else.
#[derive(Debug)]
pub enum Wrappers {
    Eager(Box<WrapperTree>),
    Lazy {
        options: HierarchyOptions,
        tree: OnceLock<Box<WrapperTree>>,
    },
}

impl Wrappers {
    /// Those of a cloud, not yet made.
    pub fn of_cloud(options: &HierarchyOptions) -> Self {
        Self::Lazy {
            options: *options,
            tree: OnceLock::new(),
        }
    }

    /// The tree over the body's primitives.
    pub fn tree(&self, primitives: &Primitives) -> &WrapperTree {
        match self {
            Self::Eager(tree) => tree,
            Self::Lazy { options, tree } => {
                tree.get_or_init(|| Box::new(wrap_cloud(primitives, options)))
            }
        }
    }

    pub fn kind(&self) -> WrapperKind {
        match self {
            Self::Eager(tree) => tree.kind(),
            Self::Lazy { options, .. } => options.wrapper,
        }
    }

    /// The ball around the body's primitives.
    pub fn ball(&self, primitives: &Primitives) -> Ball {
        match self {
            Self::Eager(tree) => tree.ball(),
            Self::Lazy { .. } => ball_of(primitives),
        }
    }

    /// What the hierarchy is like; of a cloud by the boxes of the points along the axes of coordinates. The bytes are those
    /// of wrappers that are made.
    pub fn statistics(&self, primitives: &Primitives) -> TreeStatistics {
        match self {
            Self::Eager(tree) => tree.statistics(),
            Self::Lazy { options, tree } => TreeStatistics {
                bytes: tree.get().map_or(0, |tree| tree.bytes() as u64),
                ..cloud_statistics(primitives, options)
            },
        }
    }
}
