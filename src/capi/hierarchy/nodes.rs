//! The hierarchies of bodies, for inspection: statistics, levels, covers, nodes and their meshes.

use std::ffi::c_char;
use std::sync::Arc;

use crate::body::Body;
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::hierarchy::options::cstk_wrapper_kind;
use crate::capi::input::{Output, OutputSlice, path, slice, start};
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::hierarchy::Node;
use crate::show::{node_surfaces, show_nodes};

/// A mesh of polygons, for display. Immutable; threads may share it.
pub struct cstk_mesh {
    _opaque: [u8; 0],
}

pub(crate) struct Mesh {
    xyz: Vec<f64>,
    face_sizes: Vec<u32>,
    face_nodes: Vec<u32>,
    indices: Vec<u32>,
}

impl Noun for Mesh {
    type Handle = cstk_mesh;
    const KIND: u32 = 9;
    const NAME: &'static str = "cstk_mesh";
}

/// Statistics of a body's hierarchy.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_hierarchy_statistics {
    /// A cstk_wrapper_kind.
    pub wrapper: cstk_wrapper_kind,
    pub reserved_0: u32,
    /// The number of nodes, of leaves among them, and of nodes that hold a maximal convex piece.
    pub node_count: u64,
    pub leaf_count: u64,
    pub piece_count: u64,
    /// The number of levels, and the mean level of a leaf; the root's level is 0.
    pub depth: u64,
    pub mean_leaf_level: f64,
    /// Means over interior nodes. `balance`: the larger ratio of the children's diameters (1 is perfect spatial balance).
    /// `fill`: the diameter over the sum of the children's (1/2: they overlap completely; above 1: they are apart).
    pub balance: f64,
    pub fill: f64,
    /// The mean number of tests for a random line through the body's box, a primitive counting as four nodes: compares
    /// hierarchies of one body.
    pub expected_cost: f64,
    /// Build times in seconds, on the machine that built it: convex pieces and slender primitives; the tree of sets; the
    /// boxes that queries traverse and the wrappers they are fitted to.
    pub preparation_seconds: f64,
    pub grouping_seconds: f64,
    pub construction_seconds: f64,
    /// Memory of the hierarchy and of the primitive data that queries read. It grows several times once the wrappers are
    /// computed, for hulls and for bodies of points only, whose wrappers are computed when nodes are first inspected.
    pub memory_bytes: u64,
    pub reserved: [u64; 8],
}

/// Statistics of a level of a hierarchy.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_level_statistics {
    /// The number of nodes of the level, and of leaves above it. Together they cover the body.
    pub node_count: u64,
    pub leaves_above: u64,
    /// The total volume and surface area of the wrappers of all these nodes; flat wrappers count both sides.
    pub volume: f64,
    pub surface: f64,
    pub reserved: [u64; 4],
}

/// A node of a hierarchy. Nodes are numbered from 0, the root, in depth-first order.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_hierarchy_node {
    /// The children; both UINT32_MAX for a leaf.
    pub children: [u32; 2],
    /// A leaf's primitive; UINT32_MAX otherwise. A slender primitive may have several leaves.
    pub primitive: u32,
    /// 1 if the node holds a maximal convex piece, else 0.
    pub is_piece: u32,
    /// The wrapper: the convex hull of its corners (see cstk_body_get_node_corners), grown by `excess`. A sphere has one
    /// corner, its centre, and `excess` is its radius.
    pub corner_count: u64,
    pub excess: f64,
    /// A sphere around the primitives below the node, in the frame in which the body was given.
    pub center: [f64; 3],
    pub radius: f64,
    pub reserved: [u64; 4],
}

/// The arrays of a mesh; they are valid as long as the mesh.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_mesh_view {
    /// `vertex_count` vertices of three doubles.
    pub vertices: *const f64,
    pub vertex_count: usize,
    /// For each face, its number of vertices, and the node it stands for.
    pub face_sizes: *const u32,
    pub face_nodes: *const u32,
    pub face_count: usize,
    /// The vertex indices of the faces, face after face, counter-clockwise seen from outside.
    pub indices: *const u32,
    pub index_count: usize,
    pub reserved: [u64; 4],
}

/// Writes statistics of the body's hierarchy; takes time in proportion to its nodes. Where wrappers are computed on first
/// inspection (hulls without an aspect_limit that cuts, and bodies of points only), axis-aligned boxes around the
/// primitives are measured instead.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_hierarchy_statistics(
    body: *const cstk_body,
    out: *mut cstk_hierarchy_statistics,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        let s = body.tree_statistics();
        let times = body.statistics().times;
        out.write(cstk_hierarchy_statistics {
            wrapper: body.wrapper_kind().into(),
            reserved_0: 0,
            node_count: s.nodes,
            leaf_count: s.leaves,
            piece_count: s.pieces,
            depth: s.depth,
            mean_leaf_level: s.mean_leaf_level,
            balance: s.balance,
            fill: s.fill,
            expected_cost: s.expected_cost,
            preparation_seconds: times.preparation,
            grouping_seconds: times.grouping,
            construction_seconds: times.construction,
            memory_bytes: s.bytes,
            reserved: [0; 8],
        });
        Ok(())
    })
}

/// Writes statistics of a level of the hierarchy; the root's is 0. CSTK_ERROR_NOT_FOUND for a level it does not have.
/// Computes the wrappers' hulls: some tens of microseconds a node.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_level_statistics(
    body: *const cstk_body,
    level: u32,
    out: *mut cstk_level_statistics,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        body.require_level(level)?;
        let s = body.tree().level_statistics(level)?;
        out.write(cstk_level_statistics {
            node_count: s.nodes,
            leaves_above: s.leaves_above,
            volume: s.volume,
            surface: s.surface,
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Writes the nodes of a level and the leaves above it, which together cover the body. At most `max_count` are written to
/// `nodes` (NULL if `max_count` is 0), and their full number to `count`. CSTK_ERROR_NOT_FOUND for a level that the
/// hierarchy does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_level_nodes(
    body: *const cstk_body,
    level: u32,
    max_count: usize,
    nodes: *mut u32,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let room = OutputSlice::checked(nodes, max_count, "nodes")?;
        let count = Output::checked(count, "count")?;
        body.require_level(level)?;
        let found = body.tree().level(level);
        room.write(&found);
        count.write(found.len());
        Ok(())
    })
}

/// Writes at most `max_count` nodes that cover the body, found by repeatedly replacing the node with the largest wrapper by
/// its children: for broad-phase structures of limited size. They are written to `nodes`, their number to `count`.
/// CSTK_ERROR_INVALID_ARGUMENT if `max_count` is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_cover_nodes(
    body: *const cstk_body,
    max_count: usize,
    nodes: *mut u32,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let room = OutputSlice::checked(nodes, max_count, "nodes")?;
        let count = Output::checked(count, "count")?;
        if max_count == 0 {
            return Err(Error::invalid("max_count must be at least 1").into());
        }
        let found = body.tree().cover(max_count)?;
        room.write(&found);
        count.write(found.len());
        Ok(())
    })
}

/// Describes a node. CSTK_ERROR_NOT_FOUND for a node that the hierarchy does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_node(
    body: *const cstk_body,
    node: u32,
    out: *mut cstk_hierarchy_node,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        require_node(body, node)?;
        let wrapper = body.tree().wrapper(node);
        let (children, primitive) = match body.tree().node(node) {
            Node::Leaf { primitive } => ([u32::MAX; 2], primitive),
            Node::Interior { children } => (children, u32::MAX),
        };
        out.write(cstk_hierarchy_node {
            children,
            primitive,
            is_piece: u32::from(body.tree().pieces().binary_search(&node).is_ok()),
            corner_count: wrapper.corners.len() as u64,
            excess: wrapper.excess,
            center: (wrapper.center + body.center()).into(),
            radius: wrapper.radius,
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Writes the corners of a node's wrapper, in the frame in which the body was given. At most `max_count` points of three
/// doubles are written to `xyz` (NULL if `max_count` is 0), and their full number to `count`. CSTK_ERROR_NOT_FOUND for a
/// node that the hierarchy does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_get_node_corners(
    body: *const cstk_body,
    node: u32,
    max_count: usize,
    xyz: *mut f64,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let room = OutputSlice::checked(xyz, max_count.saturating_mul(3), "xyz")?;
        let count = Output::checked(count, "count")?;
        require_node(body, node)?;
        let corners = body.tree().wrapper(node).corners;
        let coordinates: Vec<f64> = corners
            .iter()
            .map(|corner| corner + body.center())
            .flat_map(<[f64; 3]>::from)
            .collect();
        room.write(&coordinates);
        count.write(corners.len());
        Ok(())
    })
}

/// Creates a mesh of the wrappers of nodes, leaves as their primitives, in the frame in which the body was given. Release
/// it with cstk_mesh_release. CSTK_ERROR_NOT_FOUND for a node that the hierarchy does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_mesh_create_from_nodes(
    body: *const cstk_body,
    nodes: *const u32,
    node_count: usize,
    out: *mut *mut cstk_mesh,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let nodes = unsafe { slice(nodes, node_count, "nodes")? };
        let mut mesh = Mesh {
            xyz: Vec::new(),
            face_sizes: Vec::new(),
            face_nodes: Vec::new(),
            indices: Vec::new(),
        };
        for (&node, surface) in nodes.iter().zip(node_surfaces(body, nodes)?) {
            let first = (mesh.xyz.len() / 3) as u32;
            mesh.xyz
                .extend(surface.vertices.iter().flat_map(|v| <[f64; 3]>::from(*v)));
            for face in &surface.faces {
                mesh.face_sizes.push(face.len() as u32);
                mesh.face_nodes.push(node);
                mesh.indices.extend(face.iter().map(|i| first + i));
            }
        }
        if mesh.xyz.len() / 3 > u32::MAX as usize {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "a mesh holds at most 2^32 vertices; ask for fewer nodes",
            )
            .into());
        }
        out.write(handle::create(Arc::new(mesh)));
        Ok(())
    })
}

/// Writes a picture of at least one node to a .glb file (glTF), neighbours in different colours, leaves as their
/// primitives. The name must end in .glb (CSTK_ERROR_UNSUPPORTED otherwise). The file is written whole or not at all;
/// CSTK_ERROR_IO if that fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_show_nodes(
    body: *const cstk_body,
    nodes: *const u32,
    node_count: usize,
    file: *const c_char,
) -> cstk_status {
    guard(|| {
        let body = &*handle::share::<Body>(body, "body")?;
        // SAFETY: checked for NULL; the caller states the length and the terminator.
        let (nodes, file) = unsafe { (slice(nodes, node_count, "nodes")?, path(file, "file")?) };
        Ok(show_nodes(body, nodes, file)?)
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_mesh_retain(mesh: *mut cstk_mesh) -> cstk_status {
    guard(|| handle::retain::<Mesh>(mesh, "mesh"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_mesh_release(mesh: *mut cstk_mesh) -> cstk_status {
    guard(|| handle::release::<Mesh>(mesh, "mesh"))
}

/// Writes the arrays of the mesh; they are valid as long as the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_mesh_get_view(
    mesh: *const cstk_mesh,
    out: *mut cstk_mesh_view,
) -> cstk_status {
    guard(|| {
        let mesh = &*handle::share::<Mesh>(mesh, "mesh")?;
        let out = Output::checked(out, "out")?;
        out.write(cstk_mesh_view {
            vertices: start(&mesh.xyz),
            vertex_count: mesh.xyz.len() / 3,
            face_sizes: start(&mesh.face_sizes),
            face_nodes: start(&mesh.face_nodes),
            face_count: mesh.face_sizes.len(),
            indices: start(&mesh.indices),
            index_count: mesh.indices.len(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

fn require_node(body: &Body, node: u32) -> Result<(), Error> {
    let count = body.statistics().nodes;
    if u64::from(node) < count {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::NotFound,
        format!("node {node} does not exist; the hierarchy has {count}"),
    ))
}
