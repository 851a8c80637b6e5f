//! Shows nodes of a body's hierarchy: their wrappers as surfaces, and as a picture (§3.3.2, Figures 6–9).

use std::path::Path;

use serde_json::json;

use super::curved::curved_surface;
use super::glb::{Colour, Document, require_glb};
use super::shapes::{add_primitive, add_surface};
use super::triangles::Triangles;
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::Node;
use crate::hierarchy::wrapper::Surface;
use crate::pose::{Pose, Vec3};

/// Colours of neighbouring nodes.
const COLOURS: [Colour; 8] = [
    [0.55, 0.70, 0.90, 1.0],
    [0.95, 0.75, 0.45, 1.0],
    [0.60, 0.82, 0.55, 1.0],
    [0.88, 0.55, 0.55, 1.0],
    [0.72, 0.62, 0.86, 1.0],
    [0.78, 0.68, 0.58, 1.0],
    [0.92, 0.66, 0.82, 1.0],
    [0.55, 0.82, 0.84, 1.0],
];

/// The wrappers of nodes as meshes, leaves as their primitives, in the frame in which the body was given. Fails for a node
/// that the hierarchy does not have.
pub fn node_surfaces(body: &Body, nodes: &[u32]) -> Result<Vec<Surface>> {
    let count = body.statistics().nodes;
    nodes
        .iter()
        .map(|&node| {
            if u64::from(node) >= count {
                return Err(Error::new(
                    ErrorKind::NotFound,
                    format!("node {node} does not exist; the hierarchy has {count}"),
                ));
            }
            let mut surface = match body.tree().node(node) {
                Node::Interior { .. } => body.tree().wrapper(node).surface(),
                Node::Leaf { primitive } => {
                    let primitive = body.primitives().get(primitive as usize);
                    let primitive = &primitive.moved(&Vec3::zeros());
                    if primitive.curve.is_some() {
                        curved_surface(primitive)
                    } else {
                        Surface {
                            vertices: primitive.vertices.to_vec(),
                            faces: primitive
                                .faces
                                .iter()
                                .map(|f| f.vertices.to_vec())
                                .collect(),
                        }
                    }
                }
            };
            for vertex in &mut surface.vertices {
                *vertex += body.center();
            }
            Ok(surface)
        })
        .collect()
}

/// Writes a .glb picture of nodes, neighbours in different colours, leaves as their primitives.
pub fn show_nodes(body: &Body, nodes: &[u32], path: &Path) -> Result<()> {
    require_glb(path)?;
    if nodes.is_empty() {
        return Err(Error::new(ErrorKind::Empty, "there are no nodes to show"));
    }
    let surfaces = node_surfaces(body, nodes)?;
    let mut document = Document::default();
    let materials = COLOURS.map(|colour| document.add_material("node", colour, true));
    for (i, (&node, surface)) in nodes.iter().zip(&surfaces).enumerate() {
        let mut triangles = Triangles::default();
        match body.tree().node(node) {
            Node::Leaf { primitive } => {
                let primitive = body.primitives().get(primitive as usize);
                let primitive = primitive.moved(body.center());
                add_primitive(&mut triangles, &primitive, 0.004 * body.radius());
            }
            Node::Interior { .. } => add_surface(&mut triangles, surface),
        }
        if let Some(mesh) = document.add_mesh(&triangles, materials[i % COLOURS.len()]) {
            let name = format!("node {node}");
            document.add_node(&name, mesh, &Pose::identity(), json!({ "node": node }));
        }
    }
    document.save(path, json!({ "nodes": nodes.len() }))
}
