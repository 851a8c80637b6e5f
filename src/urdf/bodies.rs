//! The bodies of the links: links with equal shapes share one, and a folder may cache them between loads.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::link_forms::LinkForms;
use super::model::{Geometry, LinkElement, Shape};
use super::report::UrdfReport;
use super::shapes::ShapeReader;
use crate::body::{Body, BodyCache, BodyKey, MeshForm};
use crate::error::Result;
use crate::hierarchy::HierarchyOptions;

/// The bodies of one file's links.
pub struct LinkBodies<'a> {
    shapes: ShapeReader<'a>,
    hierarchy: &'a HierarchyOptions,
    cache: Option<BodyCache>,
    forms: &'a LinkForms,
    /// By the link's name.
    keys: HashMap<&'a str, BodyKey>,
    bodies: HashMap<BodyKey, Arc<Body>>,
    report: UrdfReport,
}

impl<'a> LinkBodies<'a> {
    /// Looks up the links' bodies in the cache, and reads the meshes of those that must be built. Everything is counted
    /// before the first is built, so that a file that exceeds the budget is refused early.
    pub fn new(
        links: &[LinkElement<'a, '_>],
        shapes: ShapeReader<'a>,
        hierarchy: &'a HierarchyOptions,
        cache: Option<BodyCache>,
        forms: &'a LinkForms,
    ) -> Result<Self> {
        let mut bodies = Self {
            shapes,
            hierarchy,
            cache,
            forms,
            keys: HashMap::new(),
            bodies: HashMap::new(),
            report: UrdfReport::default(),
        };
        // The number of threads does not change the body built, so it is not part of the key.
        let options = HierarchyOptions {
            threads: 0,
            ..*hierarchy
        };
        let mut to_build = HashSet::new();
        for link in links.iter().filter(|link| !link.geometry.is_empty()) {
            let shapes = bodies.shapes.describe(link, form_of(link, forms))?;
            let key = BodyKey::of(&format!("{options:?}\n{shapes}"));
            bodies.keys.insert(link.name, key);
            bodies.report.links_with_body += 1;
            bodies.report.shapes += link.geometry.len();
            if bodies.bodies.contains_key(&key) || !to_build.insert(key) {
                continue;
            }
            match bodies.cache.as_ref().and_then(|cache| cache.load(&key)) {
                Some(body) => {
                    bodies.report.bodies_from_cache += 1;
                    bodies.add(key, Arc::new(body));
                }
                None => bodies.shapes.prepare(link)?,
            }
        }
        bodies.report.mesh_files = bodies.shapes.file_count();
        Ok(bodies)
    }

    /// The body of a link, built on first use.
    pub fn body(&mut self, link: &LinkElement) -> Result<Option<Arc<Body>>> {
        let Some(key) = self.keys.get(link.name).copied() else {
            return Ok(None);
        };
        if let Some(body) = self.bodies.get(&key) {
            return Ok(Some(body.clone()));
        }
        let form = form_of(link, self.forms);
        let body = self
            .shapes
            .read(link, form)?
            .build_as(form, self.hierarchy, &mut |_| Ok(()))
            .map_err(|e| e.within(format_args!("link \"{}\"", link.name)))?;
        let body = Arc::new(body);
        // A cache that cannot be written to is reported, not an error: the robot does not need it.
        if let Some(cache) = &self.cache
            && cache.store(&key, &body).is_err()
        {
            self.report.cache_failures += 1;
        }
        self.add(key, body.clone());
        Ok(Some(body))
    }

    fn add(&mut self, key: BodyKey, body: Arc<Body>) {
        let statistics = body.statistics();
        self.report.bodies += 1;
        self.report.solid_bodies += usize::from(statistics.is_solid);
        self.report.primitives += statistics.primitives;
        self.report.faces_split += statistics.faces_split;
        self.report.faces_dropped += statistics.faces_dropped;
        self.bodies.insert(key, body);
    }

    /// What was read and built so far.
    pub fn report(&self) -> UrdfReport {
        self.report
    }
}

/// The form of a link's meshes; a link without any is as it is.
fn form_of(link: &LinkElement, forms: &LinkForms) -> MeshForm {
    let has_mesh = |geometry: &Geometry| matches!(geometry.shape, Shape::Mesh { .. });
    match link.geometry.iter().any(has_mesh) {
        true => forms.of(link.name),
        false => MeshForm::Surface,
    }
}
