//! Reads meshes from COLLADA files (.dae, version 1.4 and 1.5): the polygons of the scene with its nodes' transforms applied.
//!
//! Lengths are scaled to metres by the file's unit. `up_axis` is not applied: coordinates are taken as written, as the tools
//! of ROS do, for which most such files are made.

use std::collections::HashMap;
use std::rc::Rc;

use foldhash::fast::RandomState;
use nalgebra::{Matrix4, Point3, Rotation3, Unit};
use roxmltree::{Node, NodeId};

use crate::body::{Mesh, MeshBudget, MeshSize, require_mesh_size, reverse_faces};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::pose::Vec3;
use crate::whole_file::text_of;
use crate::xml::{child, children, fault, list, numbers, parse, required, required_child, text_in};

/// The deepest nesting of scene nodes; refuses nodes that instance themselves.
const MAX_DEPTH: usize = 64;

/// The most nodes, transforms and parts of a scene, counted per instance; refuses scenes that grow exponentially, each node
/// instancing another twice.
const MAX_NODE_PARTS: usize = 1 << 20;

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
    let mut reader = Reader::default();
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
                reader.add_node(node, &world, 0)?;
            }
        }
        None => {
            let libraries = children(root, "library_geometries");
            for geometry in libraries.flat_map(|library| children(library, "geometry")) {
                reader.add_geometry(geometry, geometry, &world)?;
            }
        }
    }
    Ok(reader.mesh)
}

/// A scene node, parsed once, however often it is instanced.
struct SceneNode<'a, 'i> {
    /// In file order, in which they are applied.
    transforms: Vec<Matrix4<f64>>,
    parts: Vec<Part<'a, 'i>>,
}

enum Part<'a, 'i> {
    Node(Node<'a, 'i>),
    Geometry {
        instance: Node<'a, 'i>,
        geometry: Node<'a, 'i>,
    },
}

#[derive(Default)]
struct Reader<'a, 'i> {
    ids: HashMap<&'a str, Node<'a, 'i>>,
    nodes: HashMap<NodeId, Rc<SceneNode<'a, 'i>>>,
    /// The meshes of geometries, in their own coordinates.
    geometries: HashMap<NodeId, Rc<Mesh>>,
    /// The points of sources.
    positions: HashMap<NodeId, Rc<Vec<Vec3>>>,
    /// The scene so far.
    mesh: Mesh,
    budget: MeshBudget,
    node_parts: usize,
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

    fn add_node(
        &mut self,
        element: Node<'a, 'i>,
        to_world: &Matrix4<f64>,
        depth: usize,
    ) -> Result<()> {
        let refused = |message: String| Err(fault(element, ErrorKind::Unsupported, message));
        if depth == MAX_DEPTH {
            return refused(format!("nodes are nested deeper than {MAX_DEPTH}"));
        }
        let node = self.node(element)?;
        self.node_parts += 1 + node.transforms.len() + node.parts.len();
        if self.node_parts > MAX_NODE_PARTS {
            return refused(format!(
                "the scene has more than {MAX_NODE_PARTS} nodes, transforms and instances"
            ));
        }
        let mut to_world = *to_world;
        for transform in &node.transforms {
            to_world *= transform;
        }
        for part in &node.parts {
            match *part {
                Part::Node(other) => self.add_node(other, &to_world, depth + 1)?,
                Part::Geometry { instance, geometry } => {
                    self.add_geometry(instance, geometry, &to_world)?;
                }
            }
        }
        Ok(())
    }

    fn node(&mut self, element: Node<'a, 'i>) -> Result<Rc<SceneNode<'a, 'i>>> {
        if let Some(known) = self.nodes.get(&element.id()) {
            return Ok(known.clone());
        }
        let mut node = SceneNode {
            transforms: Vec::new(),
            parts: Vec::new(),
        };
        for part in element.children().filter(Node::is_element) {
            node.transforms.extend(transform(part)?);
            match part.tag_name().name() {
                "node" => node.parts.push(Part::Node(part)),
                "instance_node" => {
                    let other = self.refer(part, "url", "node")?;
                    node.parts.push(Part::Node(other));
                }
                "instance_geometry" => node.parts.push(Part::Geometry {
                    instance: part,
                    geometry: self.refer(part, "url", "geometry")?,
                }),
                "instance_controller" => {
                    return Err(fault(
                        part,
                        ErrorKind::Unsupported,
                        "skins and morphs have no rigid shape",
                    ));
                }
                _ => {}
            }
        }
        let node = Rc::new(node);
        self.nodes.insert(element.id(), node.clone());
        Ok(node)
    }

    /// Adds an instance of a geometry to the scene.
    fn add_geometry(
        &mut self,
        instance: Node<'a, 'i>,
        geometry: Node<'a, 'i>,
        to_world: &Matrix4<f64>,
    ) -> Result<()> {
        let is_repeated = self.geometries.contains_key(&geometry.id());
        let own = self.geometry(geometry)?;
        let named = |e: Error| fault(instance, e.kind, e.message);
        self.budget
            .take(MeshSize::of(&own), is_repeated)
            .map_err(named)?;
        let all = &mut self.mesh;
        let (base, first) = (all.vertices.len() as u32, all.indices.len());
        let reserved = (all.vertices.try_reserve(own.vertices.len()))
            .and_then(|()| all.indices.try_reserve(own.indices.len()))
            .and_then(|()| all.face_sizes.try_reserve(own.face_sizes.len()));
        reserved.map_err(Error::memory).map_err(named)?;
        let moved = own
            .vertices
            .iter()
            .map(|p| to_world.transform_point(&Point3::from(*p)).coords);
        all.vertices.extend(moved);
        all.indices.extend(own.indices.iter().map(|i| base + i));
        all.face_sizes.extend(&own.face_sizes);
        if to_world.fixed_view::<3, 3>(0, 0).determinant() < 0.0 {
            reverse_faces(&own.face_sizes, &mut all.indices[first..]);
        }
        Ok(())
    }

    fn geometry(&mut self, geometry: Node<'a, 'i>) -> Result<Rc<Mesh>> {
        if let Some(known) = self.geometries.get(&geometry.id()) {
            return Ok(known.clone());
        }
        let read = Rc::new(self.read_geometry(geometry)?);
        self.geometries.insert(geometry.id(), read.clone());
        Ok(read)
    }

    /// The faces of a geometry, with only the positions that they use.
    fn read_geometry(&mut self, geometry: Node<'a, 'i>) -> Result<Mesh> {
        let Some(mesh) = child(geometry, "mesh") else {
            return Err(fault(
                geometry,
                ErrorKind::Unsupported,
                "only geometries that are a <mesh> are read",
            ));
        };
        let mut own = Mesh::default();
        // Elements that refer to the same <vertices> share vertices in the mesh.
        let mut used: HashMap<(NodeId, u32), u32, RandomState> = HashMap::default();
        for element in mesh.children().filter(Node::is_element) {
            let kind = element.tag_name().name();
            if !["triangles", "polylist", "polygons", "trifans", "tristrips"].contains(&kind) {
                continue;
            }
            let input = children(element, "input")
                .find(|input| input.attribute("semantic") == Some("VERTEX"))
                .ok_or_else(|| fault(element, ErrorKind::Parse, "it has no input of VERTEX"))?;
            let vertices = self.refer(input, "source", "vertices")?;
            let positions = self.positions(vertices)?;
            let offset = offset(input)?;
            let stride = 1 + children(element, "input")
                .map(self::offset)
                .collect::<Result<Vec<_>>>()?
                .into_iter()
                .max()
                .unwrap_or(0);
            let first = own.indices.len();
            let mut runs = Vec::new();
            for p in children(element, "p") {
                let run = list::<u32>(p, "index", &text_in(p))?;
                runs.push(corners(p, run, offset, stride, positions.len())?);
            }
            add_faces(element, &runs, &mut own)?;
            for index in &mut own.indices[first..] {
                let fresh = own.vertices.len() as u32;
                let place = *used.entry((vertices.id(), *index)).or_insert(fresh);
                if place == fresh {
                    own.vertices.push(positions[*index as usize]);
                }
                *index = place;
            }
            require_mesh_size(&own).map_err(|e| fault(element, e.kind, e.message))?;
        }
        Ok(own)
    }

    /// The positions of a <vertices>.
    fn positions(&mut self, vertices: Node<'a, 'i>) -> Result<Rc<Vec<Vec3>>> {
        let input = children(vertices, "input")
            .find(|input| input.attribute("semantic") == Some("POSITION"))
            .ok_or_else(|| fault(vertices, ErrorKind::Parse, "it has no input of POSITION"))?;
        let source = self.refer(input, "source", "source")?;
        if let Some(known) = self.positions.get(&source.id()) {
            return Ok(known.clone());
        }
        let read = Rc::new(read_positions(source)?);
        self.positions.insert(source.id(), read.clone());
        Ok(read)
    }
}

fn read_positions(source: Node) -> Result<Vec<Vec3>> {
    let array = required_child(source, "float_array")?;
    let numbers = list::<f64>(array, "coordinate", &text_in(array))?;
    require_finite(&numbers, "coordinate").map_err(|e| fault(array, e.kind, e.message))?;
    let accessor = child(source, "technique_common").and_then(|t| child(t, "accessor"));
    let number =
        |name: &str, default: usize| match accessor.and_then(|a| Some((a, a.attribute(name)?))) {
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
    let places = coordinate_places(accessor).filter(|places| places.iter().all(|&k| k < stride));
    let Some([x, y, z]) = places else {
        let message = "positions need three coordinates";
        return Err(fault(source, ErrorKind::Parse, message));
    };
    let numbers = numbers.get(first..).ok_or_else(|| {
        fault(
            source,
            ErrorKind::NotFound,
            "its accessor begins beyond its numbers",
        )
    })?;
    let needed = x.max(y).max(z) + 1;
    let whole = numbers.chunks(stride).filter(|point| point.len() >= needed);
    Ok(whole.map(|p| Vec3::new(p[x], p[y], p[z])).collect())
}

/// Where in a stride the three coordinates are: parameters without a name are passed over, unless none has one.
fn coordinate_places(accessor: Option<Node>) -> Option<[usize; 3]> {
    let parameters = accessor.into_iter().flat_map(|a| children(a, "param"));
    let named: Vec<usize> = parameters
        .enumerate()
        .filter(|(_, parameter)| {
            parameter
                .attribute("name")
                .is_some_and(|name| !name.is_empty())
        })
        .map(|(place, _)| place)
        .collect();
    match named[..] {
        [] => Some([0, 1, 2]),
        [x, y, z, ..] => Some([x, y, z]),
        _ => None,
    }
}

/// The vertex indices among the indices of a <p>.
fn corners(
    p: Node,
    indices: Vec<u32>,
    offset: usize,
    stride: usize,
    vertex_count: usize,
) -> Result<Vec<u32>> {
    if !indices.len().is_multiple_of(stride) {
        return Err(fault(
            p,
            ErrorKind::WrongSize,
            format!("{} indices are no multiple of {stride}", indices.len()),
        ));
    }
    let own: Vec<u32> = indices.into_iter().skip(offset).step_by(stride).collect();
    match own.iter().find(|&&i| i as usize >= vertex_count) {
        None => Ok(own),
        Some(i) => Err(fault(
            p,
            ErrorKind::NotFound,
            format!("vertex {i} does not exist; there are {vertex_count}, counted from 0"),
        )),
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

/// Appends the faces of an element, from its lists of indices.
fn add_faces(element: Node, runs: &[Vec<u32>], mesh: &mut Mesh) -> Result<()> {
    let mut add = |face: &[u32]| {
        mesh.face_sizes.push(face.len() as u32);
        mesh.indices.extend(face);
    };
    match element.tag_name().name() {
        "triangles" => {
            let all = runs.concat();
            if all.len() % 3 != 0 {
                return Err(fault(
                    element,
                    ErrorKind::WrongSize,
                    format!("{} corners make no triangles", all.len()),
                ));
            }
            all.chunks_exact(3).for_each(add);
        }
        "polylist" => {
            let all = runs.concat();
            let mut rest = &all[..];
            let sizes = required_child(element, "vcount")?;
            for size in list::<u32>(sizes, "vcount", &text_in(sizes))? {
                let (face, after) = rest.split_at_checked(size as usize).ok_or_else(|| {
                    fault(
                        sizes,
                        ErrorKind::WrongSize,
                        "its faces need more corners than there are",
                    )
                })?;
                add(face);
                rest = after;
            }
            if !rest.is_empty() {
                let message = format!("{} corners are left after the last face", rest.len());
                return Err(fault(sizes, ErrorKind::WrongSize, message));
            }
        }
        "polygons" => {
            if let Some(holed) = child(element, "ph") {
                return Err(fault(
                    holed,
                    ErrorKind::Unsupported,
                    "polygons with holes are not read",
                ));
            }
            runs.iter().for_each(|run| add(run));
        }
        "trifans" => {
            for run in runs {
                let rim = run.get(1..).unwrap_or_default().windows(2);
                rim.for_each(|two| add(&[run[0], two[0], two[1]]));
            }
        }
        _ => runs
            .iter()
            .for_each(|run| run.windows(3).for_each(&mut add)),
    }
    Ok(())
}

/// The matrix of a transform element of a node; `None` for other elements.
fn transform(element: Node) -> Result<Option<Matrix4<f64>>> {
    let text = &text_in(element);
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
