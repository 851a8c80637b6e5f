//! The bodies of a C-object's robots and environments.

use std::collections::{HashMap, HashSet};

use serde_json::{Value, json};

use super::glb::{Colour, Document};
use super::shapes::of_body;
use crate::body::Body;
use crate::cobject::{BodyPairs, CObject, LinksAndObjects};
use crate::pose::Pose;
use crate::query::World;

/// Robots take turns.
const LINKS: [Colour; 2] = [[0.62, 0.74, 0.90, 1.0], [0.62, 0.86, 0.62, 1.0]];
const OBJECTS: Colour = [0.95, 0.80, 0.50, 1.0];

/// A body in a document, and what carries it.
pub struct ShownBody {
    pub name: String,
    pub mesh: usize,
    /// `None` for what stands in the world.
    pub link: Option<usize>,
    /// In the frame of the link or of the world.
    pub pose: Pose,
    pub extras: Value,
}

/// Meshes that several nodes may share.
struct Meshes<'a> {
    document: &'a mut Document,
    known: HashMap<(u64, usize), Option<usize>>,
    shown: Vec<ShownBody>,
}

impl Meshes<'_> {
    fn add(&mut self, body: &Body, material: usize, shown: impl FnOnce(usize) -> ShownBody) {
        let document = &mut *self.document;
        let known = self.known.entry((body.serial(), material));
        let mesh = *known.or_insert_with(|| document.add_mesh(&of_body(body), material));
        if let Some(mesh) = mesh {
            let mut shown = shown(mesh);
            shown.pose = shown.pose.compose(&Pose::from_translation(*body.center()));
            self.shown.push(shown);
        }
    }
}

/// Adds the meshes of all links and s-objects to a document.
pub fn shown_bodies(world: &World, cobject: &CObject, document: &mut Document) -> Vec<ShownBody> {
    let space = cobject.space();
    let robots = space.offsets().len().clamp(1, LINKS.len());
    let links: Vec<usize> = (0..robots)
        .map(|robot| document.add_material("link", LINKS[robot], true))
        .collect();
    let objects = document.add_material("s-object", OBJECTS, true);
    let mut meshes = Meshes {
        document,
        known: HashMap::new(),
        shown: Vec::new(),
    };
    for link in 0..space.link_count() {
        if let Some(found) = space.link(link)
            && let Some(body) = &found.body
        {
            let material = links[space.robot_of(link) % robots];
            meshes.add(body, material, |mesh| ShownBody {
                name: found.name.clone(),
                mesh,
                link: Some(link),
                pose: Pose::identity(),
                extras: json!({ "link": link }),
            });
        }
    }
    let mut drawn = HashSet::new();
    for term in cobject.induced_leaves() {
        let BodyPairs::Objects(LinksAndObjects { objects: set, .. }) = &term.pairs else {
            continue;
        };
        let Some(snapshot) = world.snapshot(set.environment()) else {
            continue;
        };
        for object in snapshot.objects() {
            if set.contains(object.id) && drawn.insert(object.id) {
                meshes.add(&object.body, objects, |mesh| ShownBody {
                    name: format!("s-object {}", object.id),
                    mesh,
                    link: object.attachment.as_ref().map(|held| held.link),
                    pose: object.pose,
                    extras: json!({ "id": object.id }),
                });
            }
        }
    }
    meshes.shown
}
