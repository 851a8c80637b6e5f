//! What a polytope's vertices are asked by: as the corners of a box, in cells of directions, or one after another.

use std::sync::OnceLock;

use super::cuboid::Cuboid;
use super::direction_cells::DirectionCells;
use super::incidence::Incidence;
use super::{Convex, Feature};
use crate::pose::Vec3;

/// How the vertices of a primitive's core are asked for the one farthest along a direction.
#[derive(Clone, Debug)]
pub enum Form {
    /// A box: the support vertex follows from the signs of the direction along its axes.
    Cuboid(Box<Cuboid>),
    /// Made when first asked.
    Hull(OnceLock<Box<HullForm>>),
}

/// What a polytope of many vertices is asked by.
#[derive(Clone, Debug)]
pub struct HullForm {
    cells: DirectionCells,
    incidence: Incidence,
    /// The mean of the vertices.
    middle: Vec3,
}

/// At most 8 vertices are compared one by one; more get cells.
const FEW: usize = 8;

impl Form {
    /// The form of a primitive's core; `None` for what has no more than a few vertices, and is no box.
    pub fn of(shape: &Convex) -> Option<Self> {
        if let Some(cuboid) = Cuboid::of(shape) {
            return Some(Self::Cuboid(Box::new(cuboid)));
        }
        (shape.vertices.len() > FEW).then(|| Self::Hull(OnceLock::new()))
    }

    /// The box, if this is one.
    pub fn cuboid(&self) -> Option<&Cuboid> {
        match self {
            Self::Cuboid(cuboid) => Some(cuboid),
            Self::Hull(_) => None,
        }
    }

    /// The vertex that is farthest along a direction; of the shape that the form was made of.
    #[inline(always)]
    pub fn farthest(&self, shape: &Convex, direction: &Vec3) -> u32 {
        match self {
            Self::Cuboid(cuboid) => cuboid.farthest(&shape.vertices, direction),
            Self::Hull(made) => {
                let cells = &HullForm::made(made, shape).cells;
                cells.farthest(&shape.vertices, direction)
            }
        }
    }

    /// The mean of the vertices.
    #[inline(always)]
    pub fn middle(&self, shape: &Convex) -> Vec3 {
        match self {
            Self::Cuboid(cuboid) => cuboid.center,
            Self::Hull(made) => HullForm::made(made, shape).middle,
        }
    }

    /// The least feature that holds some vertices.
    pub fn feature_of(&self, shape: &Convex, vertices: &[u32]) -> Option<Feature> {
        match self {
            Self::Cuboid(cuboid) => cuboid.feature_of(vertices),
            Self::Hull(made) => HullForm::made(made, shape).incidence.feature_of(vertices),
        }
    }

    /// Bytes of memory, as far as they are taken by now.
    pub fn bytes(&self) -> usize {
        let held = match self {
            Self::Cuboid(_) => size_of::<Cuboid>(),
            Self::Hull(made) => made.get().map_or(0, |form| {
                size_of::<HullForm>() + form.cells.bytes() + form.incidence.bytes()
            }),
        };
        size_of::<Self>() + held
    }
}

impl HullForm {
    #[inline(always)]
    fn made<'a>(cell: &'a OnceLock<Box<Self>>, shape: &Convex) -> &'a Self {
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

/// A form follows from the shape.
impl PartialEq for Form {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
