//! Fast support functions of polytopes: by the corners of a box, or by cells of directions.

use std::sync::OnceLock;

use super::cuboid::Cuboid;
use super::direction_cells::DirectionCells;
use super::incidence::Incidence;
use super::{Convex, Feature};
use crate::pose::Vec3;

/// A data structure for the support vertex of a primitive's core.
#[derive(Clone, Debug)]
pub enum Form {
    /// A box: the support vertex follows from the signs of the direction along its axes.
    Cuboid(Box<Cuboid>),
    /// A table of directions, built on first use.
    Hull(OnceLock<Box<HullForm>>),
}

/// The tables of a polytope of many vertices.
#[derive(Clone, Debug)]
pub struct HullForm {
    cells: DirectionCells,
    incidence: Incidence,
    /// The mean of the vertices.
    middle: Vec3,
}

/// Up to 8 vertices are compared one by one; with more, cells are built.
const MAX_LINEAR: usize = 8;

impl Form {
    /// The form of a primitive's core; `None` if it has few vertices and is no box.
    pub fn of(shape: &Convex) -> Option<Self> {
        if let Some(cuboid) = Cuboid::of(shape) {
            return Some(Self::Cuboid(Box::new(cuboid)));
        }
        (shape.vertices.len() > MAX_LINEAR).then(|| Self::Hull(OnceLock::new()))
    }

    /// The box, if this is one.
    pub fn cuboid(&self) -> Option<&Cuboid> {
        match self {
            Self::Cuboid(cuboid) => Some(cuboid),
            Self::Hull(_) => None,
        }
    }

    /// The support vertex along a direction, in the primitive's frame; `shape` is the one that the form was built from.
    #[inline(always)]
    pub fn farthest(&self, shape: &Convex, direction: &Vec3) -> u32 {
        match self {
            Self::Cuboid(cuboid) => cuboid.farthest(&shape.vertices, direction),
            Self::Hull(table) => {
                let cells = &HullForm::table(table, shape).cells;
                cells.farthest(&shape.vertices, direction)
            }
        }
    }

    /// The mean of the vertices.
    #[inline(always)]
    pub fn middle(&self, shape: &Convex) -> Vec3 {
        match self {
            Self::Cuboid(cuboid) => cuboid.center,
            Self::Hull(table) => HullForm::table(table, shape).middle,
        }
    }

    /// The lowest-dimensional feature that holds the given vertices; `None` if only the interior does.
    pub fn feature_of(&self, shape: &Convex, vertices: &[u32]) -> Option<Feature> {
        match self {
            Self::Cuboid(cuboid) => cuboid.feature_of(vertices),
            Self::Hull(table) => HullForm::table(table, shape).incidence.feature_of(vertices),
        }
    }

    /// Which edges and faces meet in each vertex; `None` for a box.
    pub fn incidence(&self, shape: &Convex) -> Option<&Incidence> {
        match self {
            Self::Cuboid(_) => None,
            Self::Hull(table) => Some(&HullForm::table(table, shape).incidence),
        }
    }

    /// Bytes of memory allocated so far.
    pub fn bytes(&self) -> usize {
        let held = match self {
            Self::Cuboid(_) => size_of::<Cuboid>(),
            Self::Hull(table) => table.get().map_or(0, |form| {
                size_of::<HullForm>() + form.cells.bytes() + form.incidence.bytes()
            }),
        };
        size_of::<Self>() + held
    }
}

impl HullForm {
    #[inline(always)]
    fn table<'a>(cell: &'a OnceLock<Box<Self>>, shape: &Convex) -> &'a Self {
        cell.get_or_init(|| Box::new(Self::new(shape)))
    }

    fn new(shape: &Convex) -> Self {
        Self {
            cells: DirectionCells::new(&shape.vertices),
            incidence: Incidence::new(shape),
            middle: shape.vertices.iter().sum::<Vec3>() / shape.vertices.len() as f64,
        }
    }
}

/// Forms compare equal: a form follows from its shape, which is compared instead.
impl PartialEq for Form {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
