//! The bodies that were added to a builder: their primitives, hierarchies and solids at their places.

use std::sync::Arc;

use super::body::{Body, BodyStatistics};
use super::curved_cells::CurvedCells;
use super::part::BodyPart;
use super::solid::{Solid, Surfaces};
use crate::error::{Error, Result};
use crate::hierarchy::PartHierarchy;
use crate::pose::{Pose, Vec3};
use crate::primitive::{PosedPrimitives, Primitives};
use crate::relative_pose::relative_centered;
use crate::tolerance;

/// A body that was added to a builder.
#[derive(Clone, Debug)]
struct AddedBody {
    body: Arc<Body>,
    part: BodyPart,
}

impl AddedBody {
    /// From the body's own frame to that of a body around this centre.
    fn centered(&self, center: &Vec3) -> Pose {
        let body = self.body.center();
        relative_centered(&Pose::identity(), center, &self.part.pose, body)
    }

    /// The lowest and highest coordinates, in the builder's frame.
    fn extent(&self) -> (Vec3, Vec3) {
        let (mut low, mut high) = (Vec3::zeros(), Vec3::zeros());
        let rotation = &self.part.pose.rotation;
        for axis in 0..3 {
            let along = rotation.row(axis).transpose().normalize();
            let coordinate = |direction: &Vec3| {
                let point = self.body.farthest(direction).point + self.body.center();
                self.part.pose.transform_point(&point)[axis]
            };
            (low[axis], high[axis]) = (coordinate(&-along), coordinate(&along));
        }
        (low, high)
    }
}

/// The bodies of a builder, in the order in which they were added. The builder's other primitives, those added by themselves,
/// are its `singles`.
#[derive(Clone, Debug, Default)]
pub(super) struct AddedBodies {
    bodies: Vec<AddedBody>,
    /// The number of primitives of all.
    primitives: usize,
}

impl AddedBodies {
    /// Adds a body whose first primitive has this number among all.
    pub fn push(&mut self, body: &Arc<Body>, first: usize, pose: &Pose, tag: u64) -> Result<()> {
        let added = AddedBody {
            body: body.clone(),
            part: BodyPart {
                first: first as u32,
                count: body.primitives().len() as u32,
                tag,
                pose: *pose,
            },
        };
        let (low, high) = added.extent();
        let largest = low.amax().max(high.amax());
        if largest > tolerance::LARGEST_COORDINATE {
            return Err(Error::invalid(format!(
                "a coordinate is too large: {largest:e}; at most {:e}",
                tolerance::LARGEST_COORDINATE
            )));
        }
        self.primitives += added.part.count as usize;
        self.bodies.push(added);
        Ok(())
    }

    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// The number of their primitives.
    pub fn primitive_count(&self) -> usize {
        self.primitives
    }

    pub fn parts(&self) -> Vec<BodyPart> {
        self.bodies.iter().map(|added| added.part).collect()
    }

    /// The largest deviation that any of them states.
    pub fn stated_deviation(&self) -> f64 {
        let stated = self
            .bodies
            .iter()
            .map(|added| added.body.stated_deviation());
        stated.fold(0.0, f64::max)
    }

    /// The largest deviation of what is no cell of a patch.
    pub fn flat_deviation(&self) -> f64 {
        let flat = self.bodies.iter().map(|added| added.body.flat_deviation());
        flat.fold(0.0, f64::max)
    }

    /// Appends the cells of their patches, in the frame around a centre.
    pub fn append_curved(&self, curved: &mut CurvedCells, center: &Vec3) {
        for added in &self.bodies {
            if let Some(cells) = added.body.curved() {
                curved.append(cells, added.part.first, &added.centered(center));
            }
        }
    }

    pub fn statistics(&self) -> impl Iterator<Item = &BodyStatistics> {
        self.bodies.iter().map(|added| added.body.statistics())
    }

    /// The numbers that so many singles have among all.
    pub fn single_numbers(&self, singles: usize) -> Vec<u32> {
        let mut numbers = Vec::with_capacity(singles);
        let mut next = 0;
        for added in &self.bodies {
            numbers.extend(next..added.part.first);
            next = added.part.first + added.part.count;
        }
        numbers.extend(next..(singles + self.primitive_count()) as u32);
        numbers
    }

    /// The lowest and highest coordinates of everything.
    pub fn extent(&self, singles: &Primitives) -> (Vec3, Vec3) {
        let of_singles = (!singles.is_empty()).then(|| singles.extent());
        let of_bodies = self.bodies.iter().map(AddedBody::extent);
        let all = of_singles.into_iter().chain(of_bodies);
        all.reduce(|all, one| (all.0.inf(&one.0), all.1.sup(&one.1)))
            .unwrap_or_default()
    }

    /// All primitives in the frame around a centre.
    pub fn centered(&self, singles: &Primitives, center: &Vec3) -> Primitives {
        if self.is_empty() {
            return singles.recentered(center);
        }
        let mut of_bodies = 0;
        let posed = self.bodies.iter().map(|added| {
            let before = added.part.first as usize - of_bodies;
            of_bodies += added.part.count as usize;
            PosedPrimitives {
                before,
                primitives: added.body.primitives(),
                pose: added.centered(center),
            }
        });
        let posed: Vec<PosedPrimitives> = posed.collect();
        singles.interleaved(center, &posed)
    }

    /// Their hierarchies, in the frame around a centre.
    pub fn hierarchies(&self, center: &Vec3) -> Vec<PartHierarchy<'_>> {
        let hierarchies = self.bodies.iter().map(|added| PartHierarchy {
            packed: &added.body.packed,
            wrappers: &added.body.wrappers,
            pose: added.centered(center),
            first: added.part.first,
        });
        hierarchies.collect()
    }

    /// The solid that the boundary of the singles, if given, and the solids among the bodies make up.
    pub fn solid(
        &self,
        own: Option<(Vec<i8>, Vec<Vec<Vec3>>)>,
        center: &Vec3,
        primitives: &Primitives,
    ) -> Option<Solid> {
        let are_parts_solid = self.bodies.iter().any(|added| added.body.solid().is_some());
        if own.is_none() && !are_parts_solid {
            return None;
        }
        let mut surfaces = Surfaces {
            signs: vec![0; primitives.len()],
            ..Surfaces::default()
        };
        let mut next = 0;
        let own = own.filter(|(signs, _)| signs.iter().any(|&sign| sign != 0));
        let has_own = own.is_some();
        if let Some((signs, mut scraps)) = own {
            surfaces.signs[..signs.len()].copy_from_slice(&signs);
            for vertex in scraps.iter_mut().flatten() {
                *vertex -= center;
            }
            surfaces.scrap_boundaries = vec![0; scraps.len()];
            surfaces.scraps = scraps;
            surfaces.begin(0, 0);
            next = 1;
        }
        for added in &self.bodies {
            let Some(solid) = added.body.solid() else {
                continue;
            };
            let BodyPart { first, count, .. } = added.part;
            surfaces.append(&solid.surfaces, first, next, &added.centered(center));
            next += solid.boundary_count();
            if has_own {
                surfaces.begin(first + count, 0);
            }
        }
        if next < 2 {
            surfaces.runs.clear();
        }
        Solid::new(surfaces, primitives)
    }
}

impl Surfaces {
    /// Appends the surfaces of a part after a motion; `first` is the number of its first primitive, `boundary` that of its
    /// first boundary.
    fn append(&mut self, part: &Self, first: u32, boundary: u32, pose: &Pose) {
        let signs = &mut self.signs[first as usize..][..part.signs.len()];
        signs.copy_from_slice(&part.signs);
        for scrap in &part.scraps {
            let moved = scrap.iter().map(|vertex| pose.transform_point(vertex));
            self.scraps.push(moved.collect());
        }
        let numbers = part.scrap_boundaries.iter().map(|of| boundary + of);
        self.scrap_boundaries.extend(numbers);
        if part.runs.is_empty() {
            self.begin(first, boundary);
        }
        for run in &part.runs {
            self.begin(first + run.first, boundary + run.boundary);
        }
    }
}
