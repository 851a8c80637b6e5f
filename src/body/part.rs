//! Bodies that are parts of another body.

use std::sync::Arc;

use super::body::{Body, BodyStatistics};
use super::builder::BodyBuilder;
use super::solid::{Solid, Surfaces};
use crate::error::{Error, Result};
use crate::hierarchy::PartHierarchy;
use crate::pose::{Pose, Vec3, relative_centered};
use crate::primitive::{PosedPrimitives, Primitives};

/// Where a body stands in the larger one that it is part of. Its primitives follow one another in their own order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPart {
    /// The number of its first primitive in the larger body.
    pub first: u32,
    /// The number of its primitives.
    pub count: u32,
    /// The caller's tag of the part.
    pub tag: u64,
    /// From its frame to that of the larger body, as the callers of both gave them.
    pub pose: Pose,
}

/// The index of the part that a primitive belongs to, among parts in order.
pub(super) fn part_of(parts: &[BodyPart], primitive: u32) -> Option<u32> {
    let after = parts.partition_point(|part| part.first <= primitive);
    let index = after.checked_sub(1)?;
    let part = &parts[index];
    (primitive - part.first < part.count).then_some(index as u32)
}

/// A body that was added to a builder.
#[derive(Clone, Debug)]
pub(super) struct AddedBody {
    body: Arc<Body>,
    pub part: BodyPart,
}

impl AddedBody {
    pub fn statistics(&self) -> &BodyStatistics {
        self.body.statistics()
    }

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

impl BodyBuilder {
    /// Adds a body at a pose. Its primitives keep their order, tags and features; its hierarchy is taken over. If it is a
    /// solid it stays one, whatever [`BodyBuilder::set_solid`] says of the faces added by themselves.
    pub fn add_body(&mut self, body: &Arc<Body>, pose: &Pose, tag: u64) -> Result<()> {
        if body.dimension != self.dimension {
            return Err(Error::invalid(format!(
                "the body's dimension is {}, the builder's {}",
                body.dimension, self.dimension
            )));
        }
        if self.dimension == 2 && !pose.is_planar() {
            return Err(Error::invalid("the pose leaves the plane z = 0"));
        }
        let count = body.primitives().len();
        self.require_room(count)?;
        let added = AddedBody {
            body: body.clone(),
            part: BodyPart {
                first: self.len() as u32,
                count: count as u32,
                tag,
                pose: *pose,
            },
        };
        let (low, high) = added.extent();
        let largest = low.amax().max(high.amax());
        if largest > crate::tolerance::LARGEST_COORDINATE {
            return Err(Error::invalid(format!(
                "a coordinate is too large: {largest:e}; at most {:e}",
                crate::tolerance::LARGEST_COORDINATE
            )));
        }
        self.added.push(added);
        Ok(())
    }

    /// The numbers that the primitives added by themselves have among all.
    pub(super) fn single_numbers(&self) -> Vec<u32> {
        let mut numbers = Vec::with_capacity(self.primitives.len());
        let mut next = 0;
        for added in &self.added {
            numbers.extend(next..added.part.first);
            next = added.part.first + added.part.count;
        }
        numbers.extend(next..self.len() as u32);
        numbers
    }

    /// The lowest and highest coordinates of everything added.
    pub(super) fn extent(&self) -> (Vec3, Vec3) {
        let singles = (!self.primitives.is_empty()).then(|| self.primitives.extent());
        let parts = self.added.iter().map(AddedBody::extent);
        let all = singles.into_iter().chain(parts);
        all.reduce(|all, one| (all.0.inf(&one.0), all.1.sup(&one.1)))
            .unwrap_or_default()
    }

    /// All primitives in the frame around a centre.
    pub(super) fn centered(&self, center: &Vec3) -> Primitives {
        if self.added.is_empty() {
            return self.primitives.recentered(center);
        }
        let mut of_parts = 0;
        let posed = self.added.iter().map(|added| {
            let before = added.part.first as usize - of_parts;
            of_parts += added.part.count as usize;
            PosedPrimitives {
                before,
                primitives: added.body.primitives(),
                pose: added.centered(center),
            }
        });
        let posed: Vec<PosedPrimitives> = posed.collect();
        self.primitives.interleaved(center, &posed)
    }

    /// The bodies added with their hierarchies, in the frame around a centre.
    pub(super) fn part_hierarchies(&self, center: &Vec3) -> Vec<PartHierarchy<'_>> {
        let added = self.added.iter();
        let hierarchies = added.map(|added| PartHierarchy {
            packed: &added.body.packed,
            wrappers: &added.body.wrappers,
            pose: added.centered(center),
            first: added.part.first,
        });
        hierarchies.collect()
    }

    /// The solid that the boundary of the faces added by themselves, if given, and the solids among the parts make up.
    pub(super) fn solid_of_all(
        &self,
        own: Option<(Vec<i8>, Vec<Vec<Vec3>>)>,
        center: &Vec3,
        primitives: &Primitives,
    ) -> Option<Solid> {
        let are_parts_solid = self.added.iter().any(|added| added.body.solid().is_some());
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
        for added in &self.added {
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
