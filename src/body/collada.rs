//! Meshes from COLLADA files (.dae, version 1.4 and 1.5): the polygons of the scene, its nodes' transforms applied.
//!
//! Lengths are scaled to metres by the file's unit. `up_axis` is not applied: like the tools of ROS, for which most such
//! files are made, this takes coordinates as they are written.

use std::collections::HashMap;

use nalgebra::{Matrix4, Rotation3, Unit};
use roxmltree::Node;

use super::Mesh;
use crate::error::{ErrorKind, Result, require_finite};
use crate::pose::Vec3;
use crate::xml::{child, children, fault, list, numbers, parse, required, required_child, text_of};

/// Nodes of a scene may be nested so deep; instances of nodes that hold themselves end here.
const DEEPEST: usize = 64;

/// So many vertices and indices are read at most, and so many nodes: those that hold others twice, again and again, end here.
const MOST_NUMBERS: usize = 1 << 24;
const MOST_NODES: usize = 1 << 16;

pub fn parse_collada(bytes: &[u8]) -> Result<Mesh> {
    let document = parse(text_of(bytes)?)?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(fault(
            root,
            ErrorKind::Parse,
            "a COLLADA file begins with <COLLADA>",
        ));
    }
    let unit = child(root, "asset").and_then(|asset| child(asset, "unit"));
    let meter = match unit.and_then(|unit| unit.attribute("meter").map(|text| (unit, text))) {
        Some((unit, text)) => numbers::<1>(unit, "meter", text)?[0],
        None => 1.0,
    };
    let mut reader = Reader {
        ids: HashMap::new(),
        mesh: Mesh::default(),
        nodes: 0,
        numbers: 0,
    };
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            reader.ids.entry(id).or_insert(node);
        }
    }
    let world = Matrix4::new_scaling(meter);
    match child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene")) {
        Some(instance) => {
            let scene = reader.refer(instance, "url", "visual_scene")?;
            for node in children(scene, "node") {
                reader.read_node(node, &world, 0)?;
            }
        }
        None => {
            let libraries = children(root, "library_geometries");
            for geometry in libraries.flat_map(|library| children(library, "geometry")) {
                reader.read_geometry(geometry, &world)?;
            }
        }
    }
    Ok(reader.mesh)
}

struct Reader<'a, 'i> {
    ids: HashMap<&'a str, Node<'a, 'i>>,
    mesh: Mesh,
    nodes: usize,
    /// How many numbers were read, those of a source that is read again too.
    numbers: usize,
}

impl<'a, 'i> Reader<'a, 'i> {
    /// The element that an attribute refers to, as `#id`.
    fn refer(&self, from: Node<'a, 'i>, attribute: &str, name: &str) -> Result<Node<'a, 'i>> {
        let url = required(from, attribute)?;
        let found = url
            .strip_prefix('#')
            .and_then(|id| self.ids.get(id))
            .copied();
        found
            .filter(|node| node.tag_name().name() == name)
            .ok_or_else(|| {
                let message = format!("{attribute} \"{url}\" refers to no <{name}> of this file");
                fault(from, ErrorKind::NotFound, message)
            })
    }

    fn read_node(
        &mut self,
        node: Node<'a, 'i>,
        to_world: &Matrix4<f64>,
        depth: usize,
    ) -> Result<()> {
        self.nodes += 1;
        if depth == DEEPEST || self.nodes > MOST_NODES {
            return Err(fault(
                node,
                ErrorKind::Unsupported,
                format!("nodes are nested deeper than {DEEPEST}, or more than {MOST_NODES}"),
            ));
        }
        let mut to_world = *to_world;
        // Transforms are applied in the order in which they stand.
        for element in node.children().filter(Node::is_element) {
            if let Some(transform) = transform(element)? {
                to_world *= transform;
            }
        }
        for element in node.children().filter(Node::is_element) {
            match element.tag_name().name() {
                "node" => self.read_node(element, &to_world, depth + 1)?,
                "instance_node" => {
                    let other = self.refer(element, "url", "node")?;
                    self.read_node(other, &to_world, depth + 1)?;
                }
                "instance_geometry" => {
                    let geometry = self.refer(element, "url", "geometry")?;
                    self.read_geometry(geometry, &to_world)?;
                }
                "instance_controller" => {
                    return Err(fault(
                        element,
                        ErrorKind::Unsupported,
                        "skins and morphs have no rigid shape",
                    ));
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn read_geometry(&mut self, geometry: Node<'a, 'i>, to_world: &Matrix4<f64>) -> Result<()> {
        let Some(mesh) = child(geometry, "mesh") else {
            return Err(fault(
                geometry,
                ErrorKind::Unsupported,
                "only geometries that are a <mesh> are read",
            ));
        };
        // Elements that share their vertices share them in the mesh too.
        let mut bases: HashMap<roxmltree::NodeId, (u32, u32)> = HashMap::new();
        for element in mesh.children().filter(Node::is_element) {
            let kind = element.tag_name().name();
            if !["triangles", "polylist", "polygons", "trifans", "tristrips"].contains(&kind) {
                continue;
            }
            let input = children(element, "input")
                .find(|input| input.attribute("semantic") == Some("VERTEX"))
                .ok_or_else(|| fault(element, ErrorKind::Parse, "it has no input of VERTEX"))?;
            let vertices = self.refer(input, "source", "vertices")?;
            let (base, count) = match bases.get(&vertices.id()) {
                Some(known) => *known,
                None => {
                    let read = self.read_vertices(vertices, to_world)?;
                    bases.insert(vertices.id(), read);
                    read
                }
            };
            let offset = offset(input)?;
            let stride = 1 + children(element, "input")
                .map(self::offset)
                .collect::<Result<Vec<_>>>()?
                .into_iter()
                .max()
                .unwrap_or(0);
            let mut runs: Vec<Vec<u32>> = Vec::new();
            for p in children(element, "p") {
                let all = list::<u32>(p, "index", p.text().unwrap_or_default())?;
                if all.len() % stride != 0 {
                    return Err(fault(
                        p,
                        ErrorKind::WrongSize,
                        format!("{} indices are no multiple of {stride}", all.len()),
                    ));
                }
                let own: Vec<u32> = all.iter().skip(offset).step_by(stride).copied().collect();
                if let Some(i) = own.iter().find(|&&i| i >= count) {
                    return Err(fault(
                        p,
                        ErrorKind::NotFound,
                        format!("vertex {i} does not exist; there are {count}, counted from 0"),
                    ));
                }
                runs.push(own.iter().map(|i| base + i).collect());
            }
            for face in faces(element, &runs)? {
                self.mesh.face_sizes.push(face.len() as u32);
                self.mesh.indices.extend(face);
            }
            self.check_size(element)?;
        }
        Ok(())
    }

    /// Appends the positions of a <vertices>; returns where they begin and how many there are.
    fn read_vertices(
        &mut self,
        vertices: Node<'a, 'i>,
        to_world: &Matrix4<f64>,
    ) -> Result<(u32, u32)> {
        let input = children(vertices, "input")
            .find(|input| input.attribute("semantic") == Some("POSITION"))
            .ok_or_else(|| fault(vertices, ErrorKind::Parse, "it has no input of POSITION"))?;
        let source = self.refer(input, "source", "source")?;
        let array = required_child(source, "float_array")?;
        let numbers = list::<f64>(array, "coordinate", array.text().unwrap_or_default())?;
        require_finite(&numbers, "coordinate").map_err(|e| fault(array, e.kind, e.message))?;
        let accessor = child(source, "technique_common").and_then(|t| child(t, "accessor"));
        let number = |name: &str, default: usize| match accessor
            .and_then(|a| Some((a, a.attribute(name)?)))
        {
            None => Ok(default),
            Some((accessor, text)) => text.parse().map_err(|_| {
                fault(
                    accessor,
                    ErrorKind::Parse,
                    format!("{name} \"{text}\" is no count"),
                )
            }),
        };
        let (stride, first) = (number("stride", 3)?, number("offset", 0)?);
        if stride < 3 {
            return Err(fault(
                source,
                ErrorKind::Parse,
                "positions need three coordinates",
            ));
        }
        if first > numbers.len() {
            return Err(fault(
                source,
                ErrorKind::NotFound,
                "its accessor begins beyond its numbers",
            ));
        }
        self.numbers += numbers.len();
        let base = self.mesh.vertices.len() as u32;
        let points = numbers.get(first..).unwrap_or_default().chunks(stride);
        let whole = points.filter(|point| point.len() >= 3);
        let moved =
            whole.map(|p| to_world.transform_point(&nalgebra::Point3::new(p[0], p[1], p[2])));
        self.mesh
            .vertices
            .extend(moved.map(|p| Vec3::from(p.coords)));
        self.check_size(vertices)?;
        Ok((base, self.mesh.vertices.len() as u32 - base))
    }

    fn check_size(&self, node: Node) -> Result<()> {
        let largest = self.mesh.vertices.len().max(self.mesh.indices.len());
        if largest.max(self.numbers) > MOST_NUMBERS {
            return Err(fault(
                node,
                ErrorKind::Unsupported,
                "the scene is too large",
            ));
        }
        Ok(())
    }
}

fn offset(input: Node) -> Result<usize> {
    match input.attribute("offset") {
        None => Ok(0),
        Some(text) => text.parse::<u16>().map(usize::from).map_err(|_| {
            fault(
                input,
                ErrorKind::Parse,
                format!("offset \"{text}\" is no count"),
            )
        }),
    }
}

/// The corners of each face of an element, from its lists of indices.
fn faces(element: Node, runs: &[Vec<u32>]) -> Result<Vec<Vec<u32>>> {
    let all = runs.concat();
    Ok(match element.tag_name().name() {
        "triangles" => {
            if all.len() % 3 != 0 {
                return Err(fault(
                    element,
                    ErrorKind::WrongSize,
                    format!("{} corners make no triangles", all.len()),
                ));
            }
            all.chunks_exact(3).map(<[u32]>::to_vec).collect()
        }
        "polylist" => {
            let sizes = required_child(element, "vcount")?;
            let mut rest = &all[..];
            let mut found = Vec::new();
            for size in list::<u32>(sizes, "vcount", sizes.text().unwrap_or_default())? {
                let (face, after) = rest.split_at_checked(size as usize).ok_or_else(|| {
                    fault(
                        sizes,
                        ErrorKind::WrongSize,
                        "its faces need more corners than there are",
                    )
                })?;
                found.push(face.to_vec());
                rest = after;
            }
            if !rest.is_empty() {
                let message = format!("{} corners are left after the last face", rest.len());
                return Err(fault(sizes, ErrorKind::WrongSize, message));
            }
            found
        }
        "polygons" => {
            if let Some(holed) = child(element, "ph") {
                return Err(fault(
                    holed,
                    ErrorKind::Unsupported,
                    "polygons with holes are not read",
                ));
            }
            runs.to_vec()
        }
        "trifans" => {
            let fan = |run: &Vec<u32>| -> Vec<Vec<u32>> {
                let rim = run.get(1..).unwrap_or_default().windows(2);
                rim.map(|two| vec![run[0], two[0], two[1]]).collect()
            };
            runs.iter().flat_map(fan).collect()
        }
        _ => runs
            .iter()
            .flat_map(|run| run.windows(3).map(<[u32]>::to_vec))
            .collect(),
    })
}

/// What an element of a node does to what is in the node; `None` if it is no transform.
fn transform(element: Node) -> Result<Option<Matrix4<f64>>> {
    let text = element.text().unwrap_or_default();
    let name = element.tag_name().name();
    Ok(Some(match name {
        "matrix" => {
            let m = Matrix4::from_row_slice(&numbers::<16>(element, name, text)?);
            if m.row(3) != Matrix4::<f64>::identity().row(3) {
                return Err(fault(
                    element,
                    ErrorKind::Unsupported,
                    "the last row of a transform must be 0 0 0 1",
                ));
            }
            m
        }
        "translate" => Matrix4::new_translation(&Vec3::from(numbers::<3>(element, name, text)?)),
        "scale" => Matrix4::new_nonuniform_scaling(&Vec3::from(numbers::<3>(element, name, text)?)),
        "rotate" => {
            let [x, y, z, degrees] = numbers::<4>(element, name, text)?;
            match Unit::try_new(Vec3::new(x, y, z), 0.0) {
                Some(axis) => {
                    Rotation3::from_axis_angle(&axis, degrees.to_radians()).to_homogeneous()
                }
                None if degrees == 0.0 => Matrix4::identity(),
                None => {
                    return Err(fault(
                        element,
                        ErrorKind::Degenerate,
                        "the axis has no length",
                    ));
                }
            }
        }
        "skew" | "lookat" => {
            return Err(fault(
                element,
                ErrorKind::Unsupported,
                "this transform is not read",
            ));
        }
        _ => return Ok(None),
    }))
}
