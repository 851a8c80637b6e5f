//! What small files may ask for: memory stays in proportion, and what exceeds the limits is refused by name. Peaks are those
//! of this process's allocator, so one test runs at a time.

use std::alloc::{GlobalAlloc, Layout, System};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};

use cstk::body::Mesh;
use cstk::body::cloud_file::read_cloud_file;
use cstk::body::mesh_file::read_mesh_file;
use cstk::error::{Error, ErrorKind};
use cstk::octree::Octree;
use cstk::robot::RobotBuilder;
use cstk::urdf::{UrdfOptions, add_urdf_file};

/// Counts what is allocated, and the peak.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn add(bytes: usize) {
    let now = NOW.fetch_add(bytes, Ordering::Relaxed) + bytes;
    PEAK.fetch_max(now, Ordering::Relaxed);
}

// SAFETY: hands every call on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        add(layout.size());
        // SAFETY: as the caller states.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller states.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        add(size);
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller states.
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const MEGABYTE: usize = 1 << 20;

fn alone() -> MutexGuard<'static, ()> {
    static ONE: Mutex<()> = Mutex::new(());
    ONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Runs a call and returns its peak beyond what was in use before.
fn with_peak<T>(call: impl FnOnce() -> T) -> (T, usize) {
    let before = NOW.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let result = call();
    (result, PEAK.load(Ordering::Relaxed) - before)
}

/// A folder of its own that goes when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("cstk-budget-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn refused<T>(result: Result<T, Error>, kind: ErrorKind, culprits: &[&str]) {
    let error = result.err().expect("what exceeds the limits was taken");
    assert_eq!(error.kind, kind, "{error}");
    for culprit in culprits {
        assert!(
            error.message.contains(culprit),
            "{error} names no {culprit}"
        );
    }
}

/// A DAE file of one geometry, instanced by what `scene` says.
fn dae(vertices: &str, elements: &str, library: &str, scene: &str) -> String {
    let count = vertices.split_ascii_whitespace().count() / 3;
    format!(
        "<COLLADA version=\"1.4.1\">\n<library_geometries><geometry id=\"g\"><mesh>\n\
         <source id=\"s\"><float_array id=\"a\">{vertices}</float_array><technique_common>\
         <accessor source=\"#a\" count=\"{count}\" stride=\"3\"/></technique_common></source>\n\
         <vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>\n{elements}\n\
         </mesh></geometry></library_geometries>\n<library_nodes>{library}</library_nodes>\n\
         <library_visual_scenes><visual_scene id=\"w\">{scene}</visual_scene></library_visual_scenes>\n\
         <scene><instance_visual_scene url=\"#w\"/></scene>\n</COLLADA>\n"
    )
}

const INPUT: &str = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
const TRIANGLE: &str = "0 0 0 1 0 0 0 1 0";
const INSTANCE: &str = "<instance_geometry url=\"#g\"/>";

/// Triangles in the plane, `2 n` of them on each of `n` rows.
fn grid(n: usize) -> Mesh {
    let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
    let mut mesh = Mesh::default();
    for i in 0..=n {
        for j in 0..=n {
            let z = 0.1 * ((i * 7 + j * 3) % 5) as f64;
            mesh.vertices.push([i as f64, j as f64, z].into());
        }
    }
    for i in 0..n {
        for j in 0..n {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            mesh.indices.extend([a, b, c, a, c, d]);
            mesh.face_sizes.extend([3, 3]);
        }
    }
    mesh
}

fn obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    for v in &mesh.vertices {
        writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
    }
    for face in mesh.indices.chunks(3) {
        writeln!(text, "f {} {} {}", face[0] + 1, face[1] + 1, face[2] + 1).unwrap();
    }
    text
}

#[test]
fn faces_without_corners_count_in_every_instance() {
    let _one = alone();
    let folder = Folder::new("vcount");
    let zeros = "0 ".repeat(1_000_000);
    let polygons = format!("<polylist>{INPUT}<vcount>{zeros}</vcount><p></p></polylist>");
    let path = folder.write(
        "zeros.dae",
        dae(
            TRIANGLE,
            &polygons,
            "",
            &format!("<node>{}</node>", INSTANCE.repeat(1000)),
        ),
    );
    let (read, peak) = with_peak(|| read_mesh_file(&path));
    refused(
        read,
        ErrorKind::Unsupported,
        &["<instance_geometry>", "line", "faces"],
    );
    assert!(peak < 64 * MEGABYTE, "{peak} bytes");
}

#[test]
fn an_index_list_that_many_instances_share_counts_in_each() {
    let _one = alone();
    let folder = Folder::new("shared");
    let triangles = "0 1 2 ".repeat(100_000);
    let elements = format!("<triangles>{INPUT}<p>{triangles}</p></triangles>");
    let scene = format!("<node>{}</node>", INSTANCE.repeat(5000));
    let path = folder.write("shared.dae", dae(TRIANGLE, &elements, "", &scene));
    let (read, peak) = with_peak(|| read_mesh_file(&path));
    refused(
        read,
        ErrorKind::Unsupported,
        &["<instance_geometry>", "line"],
    );
    assert!(peak < 128 * MEGABYTE, "{peak} bytes");
    // Each list of indices over the same positions repeats no more of them than it uses.
    let one = format!("<triangles>{INPUT}<p>0 1 2</p></triangles>");
    let many: String = (0..2000)
        .map(|i| {
            format!(
                "<geometry id=\"g{i}\"><mesh><vertices id=\"v{i}\"><input semantic=\"POSITION\" source=\"#s\"/>\
                 </vertices><triangles><input semantic=\"VERTEX\" source=\"#v{i}\" offset=\"0\"/><p>0 1 2</p></triangles>\
                 </mesh></geometry>"
            )
        })
        .collect();
    let positions = format!("{TRIANGLE} {}", "7 7 7 ".repeat(50_000));
    let text = dae(&positions, &one, "", &format!("<node>{INSTANCE}</node>"));
    let text = text.replace(
        "</library_geometries>",
        &format!("{many}</library_geometries>"),
    );
    let scene: String = (0..2000)
        .map(|i| format!("<instance_geometry url=\"#g{i}\"/>"))
        .collect();
    let text = text.replace(INSTANCE, &scene);
    let path = folder.write("positions.dae", text);
    let (read, peak) = with_peak(|| read_mesh_file(&path));
    assert_eq!(read.unwrap().face_sizes.len(), 2000);
    assert!(peak < 32 * MEGABYTE, "{peak} bytes");
}

#[test]
fn nodes_that_hold_others_again_and_again_end() {
    let _one = alone();
    let folder = Folder::new("nodes");
    let elements = format!("<triangles>{INPUT}<p>0 1 2</p></triangles>");
    // Each node holds the next twice.
    let mut library = String::new();
    for level in 0..40 {
        let next = format!("<instance_node url=\"#n{}\"/>", level + 1);
        write!(library, "<node id=\"n{level}\">{next}{next}</node>").unwrap();
    }
    write!(library, "<node id=\"n40\">{INSTANCE}</node>").unwrap();
    let scene = "<node><instance_node url=\"#n0\"/></node>";
    let path = folder.write("doubling.dae", dae(TRIANGLE, &elements, &library, scene));
    refused(
        read_mesh_file(&path),
        ErrorKind::Unsupported,
        &["<node>", "line"],
    );
    // Few nodes, but each of them is looked through as often as it is instanced.
    let wide = format!("<node id=\"n0\">{}</node>", "<extra/>".repeat(20_000));
    let scene = format!(
        "<node>{}</node>",
        "<instance_node url=\"#n0\"/>".repeat(60_000)
    );
    let path = folder.write("wide.dae", dae(TRIANGLE, &elements, &wide, &scene));
    let read = read_mesh_file(&path);
    refused(read, ErrorKind::Empty, &["no face"]);
    // A circle.
    let circle = "<node id=\"n0\"><instance_node url=\"#n0\"/></node>";
    let scene = "<node><instance_node url=\"#n0\"/></node>";
    let path = folder.write("circle.dae", dae(TRIANGLE, &elements, circle, scene));
    refused(
        read_mesh_file(&path),
        ErrorKind::Unsupported,
        &["<node>", "line"],
    );
}

/// XML whose parser would need far more than the file has: time or memory by the square of its length.
#[test]
fn xml_does_not_multiply() {
    let _one = alone();
    let folder = Folder::new("xml");
    let entities = "<!DOCTYPE r [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]><COLLADA>&b;</COLLADA>";
    let path = folder.write("entities.dae", entities);
    refused(read_mesh_file(&path), ErrorKind::Parse, &[]);
    let attributes: String = (0..200_000).map(|i| format!("a{i}='' ")).collect();
    let path = folder.write(
        "attributes.dae",
        format!("<COLLADA><b {attributes}/></COLLADA>"),
    );
    refused(
        read_mesh_file(&path),
        ErrorKind::Unsupported,
        &["line 1", "attributes"],
    );
    let spaces: String = (0..5_000).map(|i| format!("xmlns:a{i}='u{i}' ")).collect();
    let children: String = (0..5_000)
        .map(|i| format!("<b xmlns:b{i}='w{i}'/>"))
        .collect();
    let path = folder.write(
        "spaces.dae",
        format!("<COLLADA {spaces}>{children}</COLLADA>"),
    );
    let (read, peak) = with_peak(|| read_mesh_file(&path));
    refused(read, ErrorKind::Unsupported, &["namespaces"]);
    assert!(peak < 16 * MEGABYTE, "{peak} bytes");
    let deep = format!(
        "<COLLADA>{}{}</COLLADA>",
        "<a>".repeat(300_000),
        "</a>".repeat(300_000)
    );
    let path = folder.write("deep.dae", deep);
    assert!(read_mesh_file(&path).is_err());
}

/// Headers that claim much, and data that unpack to much: memory follows what is there.
#[test]
fn point_clouds_and_octrees_ask_for_no_memory_on_their_word() {
    let _alone = alone();
    let folder = Folder::new("clouds");
    let head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 60000000\nDATA";
    // 720,000,000 bytes, it says, from 2,000 bytes that repeat the first.
    let mut bomb = format!("{head} binary_compressed\n").into_bytes();
    bomb.extend(2_000u32.to_le_bytes());
    bomb.extend(720_000_000u32.to_le_bytes());
    bomb.extend([0, 0]);
    bomb.extend([0xE0, 0xFF, 0x00].repeat(666));
    let vertices =
        "element vertex 60000000\nproperty double x\nproperty double y\nproperty double z";
    let faces = "element face 8000000\nproperty list uchar int vertex_index";
    let ply = |format: &str, elements: &str| {
        format!("ply\nformat {format} 1.0\n{elements}\nend_header\n0 ")
    };
    let clouds = [
        ("bomb.pcd", bomb),
        ("text.pcd", format!("{head} ascii\n1 2 3\n").into_bytes()),
        ("bytes.pcd", format!("{head} binary\n1 2 3\n").into_bytes()),
        ("text.ply", ply("ascii", vertices).into_bytes()),
        ("bytes.ply", ply("binary_big_endian", vertices).into_bytes()),
        ("faces.ply", ply("binary_little_endian", faces).into_bytes()),
    ];
    for (name, bytes) in clouds {
        let path = folder.write(name, bytes);
        let (read, peak) = with_peak(|| read_cloud_file(&path));
        refused(read, ErrorKind::Parse, &[]);
        assert!(peak < MEGABYTE, "{name}: {peak} bytes");
    }
    let head = "# Octomap OcTree file\nid OcTree\nsize 4000000000\nres 1\ndata\n";
    let mut tree = head.as_bytes().to_vec();
    tree.extend([0, 0, 0, 0, 0xFF].repeat(16));
    let path = folder.write("tree.ot", tree);
    let (read, peak) = with_peak(|| Octree::load(&path, 0.5));
    refused(read, ErrorKind::Parse, &["node 17"]);
    assert!(peak < MEGABYTE, "{peak} bytes");
    // One occupied child of half the grid: no cell is made on its own.
    let head = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 1\ndata\n";
    let path = folder.write("half.bt", [head.as_bytes(), &[2, 0]].concat());
    let (read, peak) = with_peak(|| Octree::load(&path, 0.5).unwrap());
    assert!(
        read.cell_count() == 1 << 45 && peak < MEGABYTE,
        "{peak} bytes"
    );
}

fn load(path: &Path) -> Result<RobotBuilder, Error> {
    let mut builder = RobotBuilder::new(3)?;
    add_urdf_file(&mut builder, path, &UrdfOptions::default(), &mut |_| Ok(()))?;
    Ok(builder)
}

/// A chain of links, one for each text of collision elements.
fn chain(links: impl Iterator<Item = String>) -> String {
    let mut text = String::from("<robot name=\"r\">\n");
    for (i, shapes) in links.enumerate() {
        writeln!(text, "<link name=\"l{i}\">{shapes}</link>").unwrap();
        if i > 0 {
            writeln!(
                text,
                "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l{}\"/><child link=\"l{i}\"/></joint>",
                i - 1
            )
            .unwrap();
        }
    }
    text + "</robot>\n"
}

fn collision(file: &str, x: usize) -> String {
    format!(
        "<collision><origin xyz=\"{x} 0 0\"/><geometry><mesh filename=\"{file}\"/></geometry></collision>"
    )
}

#[test]
fn one_mesh_of_many_collision_elements_is_refused_before_it_is_built() {
    let _one = alone();
    let folder = Folder::new("references");
    folder.write("grid.obj", obj(&grid(100)));
    let shapes: String = (0..500).map(|x| collision("grid.obj", x)).collect();
    let path = folder.write("one_link.urdf", chain(std::iter::once(shapes)));
    let (read, peak) = with_peak(|| load(&path));
    refused(
        read,
        ErrorKind::Unsupported,
        &["link \"l0\"", "<collision>", "grid.obj", "faces"],
    );
    assert!(peak < 32 * MEGABYTE, "{peak} bytes");
    let path = folder.write(
        "links.urdf",
        chain((0..500).map(|x| collision("grid.obj", x))),
    );
    let (read, peak) = with_peak(|| load(&path));
    refused(
        read,
        ErrorKind::Unsupported,
        &["link \"l", "grid.obj", "faces"],
    );
    assert!(peak < 32 * MEGABYTE, "{peak} bytes");
    // The same file by other names is the same file.
    let other = |x: usize| collision(&format!("{}grid.obj", "./".repeat(x)), x);
    let path = folder.write("names.urdf", chain((0..300).map(other)));
    let (read, peak) = with_peak(|| load(&path));
    refused(
        read,
        ErrorKind::Unsupported,
        &["link \"l", "grid.obj", "faces"],
    );
    assert!(peak < 32 * MEGABYTE, "{peak} bytes");
}

#[test]
fn links_of_equal_shapes_share_their_body() {
    let _one = alone();
    let folder = Folder::new("sharing");
    folder.write("grid.obj", obj(&grid(30)));
    let shapes = |i: usize| match i % 4 {
        // The origin, the scale and the number of shapes tell bodies apart.
        0 => collision("grid.obj", 0),
        1 => collision("grid.obj", 1),
        2 => collision("grid.obj", 0).replace("<mesh", "<mesh scale=\"2 1 1\""),
        _ => {
            collision("grid.obj", 0)
                + "<collision><geometry><sphere radius=\"1\"/></geometry></collision>"
        }
    };
    let path = folder.write("robot.urdf", chain((0..400).map(shapes)));
    let (builder, peak) = with_peak(|| load(&path).unwrap());
    let body = |i: usize| builder.links()[i].body.as_ref().unwrap();
    for i in 0..400 {
        assert!(Arc::ptr_eq(body(i), body(i % 4)), "link {i}");
        assert!(
            i == 0 || i >= 4 || !Arc::ptr_eq(body(i), body(0)),
            "link {i}"
        );
    }
    assert!(peak < 64 * MEGABYTE, "{peak} bytes");
}

#[test]
fn robots_of_too_many_links_are_refused() {
    let _one = alone();
    let folder = Folder::new("links");
    let path = folder.write("links.urdf", chain((0..140_000).map(|_| String::new())));
    refused(load(&path), ErrorKind::Unsupported, &["<robot>", "links"]);
}

#[test]
fn faces_of_too_many_corners_are_refused() {
    let _one = alone();
    let folder = Folder::new("corners");
    let mut text = String::new();
    for i in 0..100_000 {
        let (s, c) = (i as f64 * 6e-5).sin_cos();
        let radius = 1.0 + 0.3 * f64::from(i % 2);
        writeln!(text, "v {} {} 0", radius * c, radius * s).unwrap();
    }
    text += "f 1 2 3\nf";
    for i in 1..=100_000 {
        write!(text, " {i}").unwrap();
    }
    let path = folder.write("star.obj", text);
    let read = read_mesh_file(&path);
    refused(read, ErrorKind::Unsupported, &["face 1", "corners"]);
}

/// The length that a header claims is compared with what there is.
#[test]
fn claims_of_headers_reserve_nothing() {
    let _one = alone();
    let folder = Folder::new("claims");
    let mut stl = vec![b' '; 80];
    stl.extend(u32::MAX.to_le_bytes());
    stl.extend([0; 50]);
    let path = folder.write("claims.stl", &stl);
    let (read, peak) = with_peak(|| read_mesh_file(&path));
    refused(read, ErrorKind::Parse, &[]);
    assert!(peak < MEGABYTE, "{peak} bytes");
    // A file without content, but of any length.
    let path = folder.write("sparse.stl", b"");
    let file = std::fs::OpenOptions::new().write(true).open(&path).unwrap();
    file.set_len(1 << 42).unwrap();
    let (read, peak) = with_peak(|| read_mesh_file(&path));
    refused(read, ErrorKind::Unsupported, &["bytes"]);
    assert!(peak < MEGABYTE, "{peak} bytes");
}

/// A star's face is split in time that grows with the square of its corners, in each instance anew.
#[test]
fn a_face_that_takes_long_to_split_counts_in_each_instance() {
    let _one = alone();
    let folder = Folder::new("star");
    let corners = 1 << 13;
    let star: String = (0..corners)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
            let radius = if i % 2 == 0 { 1.0 } else { 0.5 };
            format!("{} {} 0 ", radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    let numbers: String = (0..corners).map(|i| format!("{i} ")).collect();
    let polygons =
        format!("<polylist>{INPUT}<vcount>{corners}</vcount><p>{numbers}</p></polylist>");
    let with = |count: usize| {
        let scene = format!("<node>{}</node>", INSTANCE.repeat(count));
        folder.write("star.dae", dae(&star, &polygons, "", &scene))
    };
    assert_eq!(read_mesh_file(&with(33)).unwrap().face_sizes.len(), 33);
    let culprits = ["<instance_geometry>", "line", "squares of corners"];
    refused(read_mesh_file(&with(34)), ErrorKind::Unsupported, &culprits);
}
