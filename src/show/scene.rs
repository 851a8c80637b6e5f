//! The scene of a C-object at a configuration.

use std::path::Path;

use serde_json::{Value, json};

use super::bodies::shown_bodies;
use super::glb::{Document, require_glb};
use super::shapes::{add_arrow, add_ball, add_rod};
use super::triangles::Triangles;
use crate::cobject::CObject;
use crate::error::Result;
use crate::pose::{Pose, Vec3};
use crate::query::{PseudoNormal, QueryContext, SSide, Shell, World};
use crate::robot::RobotState;

/// The most witnesses drawn.
const MAX_WITNESSES: usize = 64;

/// Writes the scene at q: links, s-objects, witnesses, normals and gradients. The file is written whole or not at all.
pub fn show(cobject: &CObject, q: &[f64], path: &Path) -> Result<()> {
    require_glb(path)?;
    let epsilons = cobject.induced_leaves().into_iter();
    let epsilons = epsilons.map(|term| term.options.contact_epsilon);
    let shell = Shell {
        max_shell: epsilons.fold(0.0, f64::max),
        max_count: MAX_WITNESSES,
        normalize: false,
    };
    // The whole picture shows one state of the world.
    let world = &World::of(cobject);
    // Distances from pure sets without a scale cannot be compared with lengths: then only induced sets are measured.
    let is_mixed = cobject.require_one_metric().is_err();
    let part = is_mixed.then(|| cobject.induced_part());
    let measured = part.as_ref().unwrap_or(cobject);
    let context = &mut QueryContext::new();
    let class = context.classify_in(world, cobject, q)?;
    let found = context.pseudo_normal_in(world, measured, q, &shell)?;
    let mut drawing = Drawing::new(world, cobject, q)?;
    drawing.draw_bodies();
    drawing.draw_witnesses(&found)?;
    let extras = json!({
        "configuration": q,
        "class": format!("{class:?}"),
        "distance": finite(found.distance.distance),
    });
    drawing.document.save(path, extras)
}

/// JSON has no infinities.
fn finite(x: f64) -> Value {
    if x.is_finite() { json!(x) } else { Value::Null }
}

struct Drawing<'a> {
    world: &'a World,
    cobject: &'a CObject,
    q: &'a [f64],
    poses: Vec<Pose>,
    document: Document,
    /// The length that scales marks.
    size: f64,
}

impl<'a> Drawing<'a> {
    fn new(world: &'a World, cobject: &'a CObject, q: &'a [f64]) -> Result<Self> {
        let space = cobject.space();
        let sizes = (0..space.link_count())
            .filter_map(|link| space.body(link))
            .map(|body| body.radius());
        Ok(Self {
            world,
            cobject,
            q,
            poses: space.link_poses(q)?,
            document: Document::default(),
            size: sizes.fold(1e-9, f64::max),
        })
    }

    fn draw_bodies(&mut self) {
        for shown in shown_bodies(self.world, self.cobject, &mut self.document) {
            let pose = match shown.link {
                Some(link) => self.poses[link].compose(&shown.pose),
                None => shown.pose,
            };
            self.document
                .add_node(&shown.name, shown.mesh, &pose, shown.extras);
        }
    }

    fn draw_witnesses(&mut self, found: &PseudoNormal) -> Result<()> {
        let red = self
            .document
            .add_material("witness", [0.85, 0.10, 0.10, 1.0], true);
        let green = self
            .document
            .add_material("normal", [0.10, 0.65, 0.20, 1.0], true);
        let blue = self
            .document
            .add_material("gradient", [0.15, 0.25, 0.90, 1.0], true);
        let thick = 0.008 * self.size;
        if found.distance.witness.is_some() {
            let mut marks = Triangles::default();
            let [on_r, on_s] = &found.distance.points;
            add_ball(&mut marks, on_r, 2.0 * thick);
            add_ball(&mut marks, on_s, 2.0 * thick);
            add_rod(&mut marks, on_r, on_s, 0.6 * thick, 0.6 * thick);
            let extras = json!({ "distance": finite(found.distance.distance) });
            self.draw_marks("nearest", &marks, red, extras);
        }
        let nv = found.list.nv.max(1);
        for (w, witness) in found.list.witnesses.iter().enumerate() {
            let contacts = witness.first_contact..witness.first_contact + witness.contact_count;
            for c in contacts {
                let contact = &found.list.contacts[c];
                let row = found
                    .list
                    .gradients
                    .chunks_exact(nv)
                    .nth(c)
                    .unwrap_or_default();
                let extras = json!({
                    "witness": w,
                    "mode": format!("{:?}", contact.mode),
                    "distance": finite(contact.distance),
                    "gradient": row,
                });
                let [on_r, on_s] = &contact.points;
                let mut marks = Triangles::default();
                add_ball(&mut marks, on_r, 1.5 * thick);
                add_ball(&mut marks, on_s, 1.5 * thick);
                add_rod(&mut marks, on_r, on_s, 0.5 * thick, 0.5 * thick);
                self.draw_marks("contact", &marks, red, extras.clone());

                let mut arrow = Triangles::default();
                add_arrow(
                    &mut arrow,
                    on_r,
                    &(contact.normal * (0.12 * self.size)),
                    0.7 * thick,
                );
                self.draw_marks("normal", &arrow, green, extras.clone());

                let way = self.way_along(witness.r_link, on_r, row)?;
                if let Some(way) = way.try_normalize(0.0) {
                    let mut arrow = Triangles::default();
                    add_arrow(&mut arrow, on_r, &(way * (0.18 * self.size)), 0.5 * thick);
                    self.draw_marks("gradient", &arrow, blue, extras);
                }
                if let SSide::Link(link) = witness.s_side {
                    let way = self.way_along(link, on_s, row)?;
                    if let Some(way) = way.try_normalize(0.0) {
                        let mut arrow = Triangles::default();
                        add_arrow(&mut arrow, on_s, &(way * (0.18 * self.size)), 0.5 * thick);
                        self.draw_marks("gradient", &arrow, blue, Value::Null);
                    }
                }
            }
        }
        Ok(())
    }

    /// The velocity of a link's point when the robot moves along the gradient.
    fn way_along(&self, link: usize, point: &Vec3, gradient: &[f64]) -> Result<Vec3> {
        let state = RobotState {
            q: self.q,
            poses: &self.poses,
        };
        let jacobian = self.cobject.space().jacobian(state, link, point)?;
        let mut rows = jacobian.chunks_exact(gradient.len().max(1));
        let mut along = || {
            let row = rows.next().unwrap_or_default();
            row.iter().zip(gradient).map(|(a, b)| a * b).sum()
        };
        Ok(Vec3::new(along(), along(), along()))
    }

    fn draw_marks(&mut self, name: &str, marks: &Triangles, material: usize, extras: Value) {
        if let Some(mesh) = self.document.add_mesh(marks, material) {
            self.document
                .add_node(name, mesh, &Pose::identity(), extras);
        }
    }
}
