//! Meshes of URDF files: every format, packages, what is built of them and what is kept for the next load.

use std::path::{Path, PathBuf};

use cstk::body::Body;
use cstk::error::ErrorKind;
use cstk::pose::Vec3;
use cstk::robot::RobotBuilder;
use cstk::urdf::{UrdfGeometry, UrdfOptions, UrdfReport, add_urdf_file, add_urdf_text};

use crate::urdf::ARM;
use crate::urdf_folder::{Folder, load};

const TRIANGLE_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

const SCENE_DAE: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.1" name="dm"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0  1 0 0  1 1 0  0 1 0</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="1"/><input semantic="NORMAL" source="#n" offset="0"/>
<vcount>4</vcount><p>9 0 9 1 9 2 9 3</p></polylist>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node><translate>0 0 5</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale><instance_geometry url="#g"/>
<node><matrix>1 0 0 0  0 1 0 0  0 0 1 1  0 0 0 1</matrix><instance_geometry url="#g"/></node></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"##;

#[test]
fn a_collada_scene_is_read_with_its_transforms() {
    let folder = Folder::new("dae");
    let path = folder.write("scene.DAE", SCENE_DAE);
    let mesh = cstk::body::mesh_file::read_mesh_file(&path).unwrap();
    assert_eq!(mesh.face_sizes, [4, 3, 4, 3]);
    // (1, 1, 0): stretched, turned, lifted, then from tenths to metres.
    assert!((mesh.vertices[2] - Vec3::new(-0.1, 0.2, 0.5)).amax() < 1e-16);
    assert!((mesh.vertices[6] - Vec3::new(-0.1, 0.2, 0.6)).amax() < 1e-16);
    for (text, with, kind, culprit) in [
        ("1 1 0  0 1 0<", "1 x 0  0 1 0<", ErrorKind::Parse, "\"x\""),
        (
            "1 1 0  0 1 0<",
            "1 inf 0  0 1 0<",
            ErrorKind::NotFinite,
            "coordinate",
        ),
        (
            "9 2 9 3</p>",
            "9 2 9 4</p>",
            ErrorKind::NotFound,
            "vertex 4",
        ),
        ("<vcount>4", "<vcount>5", ErrorKind::WrongSize, "vcount"),
        ("url=\"#s\"", "url=\"#q\"", ErrorKind::NotFound, "#q"),
        ("0 0 1 90", "0 0 0 90", ErrorKind::Degenerate, "rotate"),
        ("</COLLADA>", "", ErrorKind::Parse, ""),
    ] {
        let broken = SCENE_DAE.replace(text, with);
        assert_ne!(broken, SCENE_DAE);
        let path = folder.write("broken.dae", broken);
        let error = cstk::body::mesh_file::read_mesh_file(&path).unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.message.contains(culprit), "{error}");
    }
    // Nodes that hold others twice, sixty deep, end in a refusal.
    let doubled: String = (0..60)
        .map(|i| format!("<node id=\"n{i}\"><instance_node url=\"#n{}\"/><instance_node url=\"#n{}\"/></node>", i + 1, i + 1))
        .collect();
    let bomb = SCENE_DAE.replace(
        "<node><translate>",
        &format!("{doubled}<node id=\"n60\"/><node><translate>"),
    );
    let path = folder.write("bomb.dae", bomb);
    assert_eq!(
        cstk::body::mesh_file::read_mesh_file(&path)
            .unwrap_err()
            .kind,
        ErrorKind::Unsupported
    );
}

/// What stands between numbers, and parameters without a name, change nothing.
#[test]
fn comments_and_unnamed_parameters_are_passed_over() {
    let folder = Folder::new("comments");
    let read = |text: &str| {
        let path = folder.write("scene.dae", text);
        cstk::body::mesh_file::read_mesh_file(&path)
    };
    let plain = read(SCENE_DAE).unwrap();
    let commented = SCENE_DAE
        .replace(
            "<p>0 1 2<",
            "<p><!-- first -->0 1<?and then?> 2<!-- last --><",
        )
        .replace("9 1 9 2", "9 1 <!-- half --> 9 2")
        .replace("1 0 0  1 1 0", "1 0 0 <!-- c --> 1 1 0")
        .replace("<vcount>4", "<vcount><!-- a quad -->4")
        .replace("<scale>2 1 1", "<scale>2 <!-- x --> 1 1")
        .replace("0 1 0 0  0 0 1 1", "0 1 0 0 <!-- lifted --> 0 0 1 1");
    let padded = SCENE_DAE
        .replace("0 0 0  1 0 0  1 1 0  0 1 0<", "9 0 0 0  9 1 0 0  9 1 1 0  9 0 1 0<")
        .replace("count=\"4\" stride=\"3\"/>", "count=\"4\" stride=\"4\"><param type=\"float\"/><param name=\"X\"/><param name=\"Y\"/><param name=\"Z\"/></accessor>");
    for text in [commented, padded.clone()] {
        let mesh = read(&text).unwrap();
        assert_eq!(mesh.face_sizes, plain.face_sizes);
        assert_eq!(mesh.indices, plain.indices);
        assert_eq!(mesh.vertices, plain.vertices);
    }
    let flat = read(&padded.replace("<param name=\"Z\"/>", "")).unwrap_err();
    assert_eq!(flat.kind, ErrorKind::Parse);
    assert!(flat.message.contains("three coordinates"), "{flat}");
}

/// Parts that a node, or the scale of a URDF's mesh, mirrors keep their outside: a closed part would be inside out otherwise, and where
/// it overlaps another the two would count as outside.
#[test]
fn mirrored_faces_face_the_same_way() {
    let folder = Folder::new("mirrored");
    let normals = |text: &str| -> Vec<Vec3> {
        let path = folder.write("scene.dae", text);
        let mesh = cstk::body::mesh_file::read_mesh_file(&path).unwrap();
        let mut rest = &mesh.indices[..];
        let sizes = mesh.face_sizes.iter();
        let normal = |&size: &u32| {
            let (face, after) = rest.split_at(size as usize);
            rest = after;
            let [a, b, c] = [0, 1, 2].map(|i| mesh.vertices[face[i] as usize]);
            (b - a).cross(&(c - a)).normalize()
        };
        sizes.map(normal).collect()
    };
    let plain = normals(SCENE_DAE);
    for (from, to) in [
        ("<scale>2 1 1<", "<scale>2 -1 1<"),
        ("<scale>2 1 1<", "<scale>-2 1 1<"),
        ("<scale>2 1 1<", "<scale>-2 -1 1<"),
    ] {
        let mirrored = SCENE_DAE.replace(from, to);
        assert_ne!(mirrored, SCENE_DAE);
        for (plain, mirrored) in plain.iter().zip(normals(&mirrored)) {
            assert!((plain - mirrored).norm() < 1e-12, "{to}");
        }
    }
    // Only the inner node: its faces alone are reversed.
    let inner = SCENE_DAE.replace("<matrix>1 0 0 0", "<matrix>-1 0 0 0");
    for (plain, mirrored) in plain.iter().zip(normals(&inner)) {
        assert!((plain - mirrored).norm() < 1e-12);
    }

    folder.write("t.obj", TRIANGLE_OBJ);
    for (scale, sign) in [("2 1 1", 1.0), ("2 -1 1", 1.0), ("1 1 -1", -1.0)] {
        let path = folder.write(
            "robot.urdf",
            format!(
                "<robot name=\"r\"><link name=\"l\"><collision><geometry><mesh filename=\"t.obj\" scale=\"{scale}\"/></geometry></collision></link></robot>"
            ),
        );
        let robot = load(&path, &UrdfOptions::default()).unwrap();
        let body = robot.links()[0].body.as_ref().unwrap();
        let normal = body.primitives().get(0).shape.faces[0].normal;
        assert_eq!(normal, sign * Vec3::z(), "{scale}");
    }
    let path = folder.write(
        "robot.urdf",
        "<robot name=\"r\"><link name=\"l\"><collision><geometry><mesh filename=\"t.obj\" scale=\"1 1e-60 1\"/></geometry></collision></link></robot>",
    );
    let error = load(&path, &UrdfOptions::default()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument, "{error}");
    assert!(error.message.contains("scale entry 1"), "{error}");
}

#[test]
fn meshes_are_found_in_packages_and_beside_the_file() {
    let folder = Folder::new("packages");
    folder.write("here/meshes/t.obj", TRIANGLE_OBJ);
    folder.write("there/my_robot/t.obj", TRIANGLE_OBJ);
    folder.write("there/my_robot/scene.dae", SCENE_DAE);
    let with = |mesh: &str| {
        format!(
            "<robot name=\"r\"><link name=\"l\"><visual><geometry><mesh filename=\"{mesh}\" scale=\"2 -1 1\"/></geometry></visual></link></robot>"
        )
    };
    let options = UrdfOptions {
        geometry: UrdfGeometry::Visual,
        search: vec![folder.0.join("there")],
        ..Default::default()
    };
    let absolute = format!("file://{}", folder.0.join("here/meshes/t.obj").display());
    for mesh in [
        "meshes/t.obj",
        "package://here/meshes/t.obj",
        "package://my_robot/t.obj",
        "package://my_robot/scene.dae",
        "model://my_robot/t.obj",
        &absolute,
    ] {
        let path = folder.write("here/robot.urdf", with(mesh));
        let robot = load(&path, &options).unwrap_or_else(|e| panic!("{mesh}: {e}"));
        assert!(robot.links()[0].body.is_some(), "{mesh}");
    }
    // A package path may be the package itself.
    let inside = UrdfOptions {
        search: vec![folder.0.join("there/my_robot")],
        ..options.clone()
    };
    let path = folder.write("here/robot.urdf", with("package://my_robot/t.obj"));
    load(&path, &inside).unwrap();

    folder.write("here/bad.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
    for (mesh, kind, culprits) in [
        (
            "package://other/t.obj",
            ErrorKind::NotFound,
            ["package://other/t.obj", "there"],
        ),
        ("gone.stl", ErrorKind::NotFound, ["gone.stl", "here"]),
        (
            "bad.obj",
            ErrorKind::NotFinite,
            ["bad.obj", "vertex 1: coordinate 2"],
        ),
        (
            "robot.urdf",
            ErrorKind::Unsupported,
            ["robot.urdf", ".urdf"],
        ),
    ] {
        let path = folder.write("here/robot.urdf", with(mesh));
        let error = load(&path, &options).unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        for culprit in culprits.iter().chain(&["link \"l\"", "line 1", "<visual>"]) {
            assert!(
                error.message.contains(culprit),
                "{error} names no {culprit}"
            );
        }
        // Without geometry no mesh is looked for.
        let frames = UrdfOptions {
            geometry: UrdfGeometry::None,
            ..Default::default()
        };
        load(&path, &frames).unwrap();
    }
}

#[test]
fn a_text_makes_the_robot_that_the_file_makes() {
    let folder = Folder::new("text");
    folder.write("t.obj", TRIANGLE_OBJ);
    let text = format!(
        "<robot name=\"r\">{ARM}<link name=\"mesh\"><collision><geometry><mesh filename=\"t.obj\"/></geometry></collision></link>\
         <joint name=\"m\" type=\"fixed\"><parent link=\"base\"/><child link=\"mesh\"/></joint></robot>"
    );
    let path = folder.write("robot.urdf", &text);
    let options = UrdfOptions::default();
    let (of_file, from_file) = report(&path, &options);
    let add = |folder: Option<&Path>| {
        let mut builder = RobotBuilder::new(3).unwrap();
        let added = add_urdf_text(&mut builder, &text, folder, &options, &mut |_| Ok(()));
        added.map(|report| (report, builder))
    };
    let (of_text, from_text) = add(Some(&folder.0)).unwrap();
    assert_eq!(of_text, of_file);
    for (link, other) in from_text.links().iter().zip(from_file.links()) {
        assert_eq!((&link.name, &link.at), (&other.name, &other.at));
        let bodies = [link, other].map(|link| link.body.as_deref().map(content));
        assert_eq!(bodies[0], bodies[1]);
    }
    // Without a folder there is nothing beside the text.
    let error = add(None).map(|_| ()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotFound);
    for culprit in [
        "URDF text",
        "link \"mesh\"",
        "<collision>",
        "t.obj",
        "no folder",
    ] {
        assert!(error.message.contains(culprit), "{error}");
    }
}

fn report(path: &Path, options: &UrdfOptions) -> (UrdfReport, RobotBuilder) {
    let mut builder = RobotBuilder::new(3).unwrap();
    let report = add_urdf_file(&mut builder, path, options, &mut |_| Ok(())).unwrap();
    (report, builder)
}

#[test]
fn the_report_counts_what_was_read_built_and_passed_over() {
    let folder = Folder::new("report");
    folder.write("part.obj", TRIANGLE_OBJ);
    let mesh = "<geometry><mesh filename=\"part.obj\"/></geometry>";
    let shape = "<geometry><sphere radius=\"1\"/><box size=\"1 1 1\"/></geometry>";
    let text = format!(
        "<robot name=\"r\"><material/><transmission/>\
         <link name=\"a\"><inertial/><collision>{mesh}</collision><collision>{shape}</collision></link>\
         <link name=\"b\"><collision>{mesh}</collision><visual>{mesh}<material/></visual></link>\
         <link name=\"c\"><collision><verbose/>{mesh}</collision></link>\
         <link name=\"d\"><visual>{shape}</visual></link><link name=\"e\"/>\
         <joint name=\"ab\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/><dynamics/></joint>\
         <joint name=\"bc\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/></joint>\
         <joint name=\"cd\" type=\"fixed\"><parent link=\"c\"/><child link=\"d\"/></joint>\
         <joint name=\"de\" type=\"fixed\"><parent link=\"d\"/><child link=\"e\"/></joint></robot>"
    );
    let path = folder.write("robot.urdf", text);
    let with = |geometry| UrdfOptions {
        geometry,
        ..Default::default()
    };
    let all = UrdfReport {
        links: 5,
        joints: 4,
        ..Default::default()
    };
    let collision = UrdfReport {
        links_with_body: 3,
        links_with_other_shapes: 1,
        bodies: 2,
        shapes: 4,
        mesh_files: 1,
        primitives: 3,
        // material, transmission; inertial, the box; visual; verbose; visual; dynamics.
        skipped_elements: 8,
        ..all
    };
    assert_eq!(report(&path, &with(UrdfGeometry::Collision)).0, collision);
    let visual = UrdfReport {
        links_with_body: 2,
        links_with_other_shapes: 2,
        bodies: 2,
        shapes: 2,
        mesh_files: 1,
        primitives: 2,
        // material, transmission; inertial, two collisions; collision, material; collision; the box; dynamics.
        skipped_elements: 10,
        ..all
    };
    assert_eq!(report(&path, &with(UrdfGeometry::Visual)).0, visual);
    let none = report(&path, &with(UrdfGeometry::None)).0;
    assert_eq!((none.links_with_body, none.links_with_other_shapes), (0, 4));
    assert_eq!((none.bodies, none.mesh_files), (0, 0));
}

/// The content of a body, without the times of its construction.
fn content(body: &Body) -> String {
    let s = body.statistics();
    let tags: Vec<u64> = (0..s.primitives as u32).map(|i| body.tag(i)).collect();
    format!(
        "{:?} {:?} {:?} {tags:?} {} {} {} {:?} {:?}",
        body.primitives(),
        body.tree(),
        body.center(),
        s.nodes,
        s.faces_split,
        s.faces_dropped,
        s.low,
        s.high
    )
}

#[test]
fn a_second_load_builds_nothing_and_gives_equal_bodies() {
    let folder = Folder::new("cache");
    let cache = folder.0.join("new/cache");
    let mut mesh = String::new();
    for i in 0..60 {
        let [x, y] = [f64::from(i % 8), f64::from(i / 8)];
        mesh += &format!("v {x} {y} {}\n", 0.1 * f64::from(i * 7 % 5));
    }
    for i in 1..50 {
        mesh += &format!("f {i} {} {}\n", i + 1, i + 9);
    }
    folder.write("part.obj", &mesh);
    let shape = |scale: &str| {
        format!(
            "<collision><geometry><mesh filename=\"part.obj\" scale=\"{scale}\"/></geometry></collision>"
        )
    };
    let body = format!(
        "<link name=\"a\">{}</link><link name=\"b\">{}<collision><geometry><sphere radius=\"1\"/></geometry></collision></link>\
         <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>",
        shape("1 1 1"),
        shape("1 2 1")
    );
    let path = folder.write("robot.urdf", format!("<robot name=\"r\">{body}</robot>"));
    let plain = report(&path, &UrdfOptions::default()).1;
    let options = UrdfOptions {
        cache_folder: Some(cache.clone()),
        ..Default::default()
    };
    let files = || {
        let entries = std::fs::read_dir(&cache).unwrap();
        let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        files.sort();
        files
    };
    let same_as_built = |options: &UrdfOptions, from_cache: usize| {
        let (found, builder) = report(&path, options);
        assert_eq!((found.bodies, found.bodies_from_cache), (2, from_cache));
        for (link, built) in builder.links().iter().zip(plain.links()) {
            let [link, built] = [link, built].map(|l| l.body.as_ref().unwrap());
            assert_eq!(content(link), content(built));
        }
        found
    };
    same_as_built(&options, 0);
    assert_eq!(files().len(), 2);
    same_as_built(&options, 2);
    // The number of threads does not matter.
    let mut threads = options.clone();
    threads.hierarchy.threads = 2;
    same_as_built(&threads, 2);

    // Damaged, cut, exchanged, replaced by a folder: what is kept is not believed.
    let whole: Vec<Vec<u8>> = files().iter().map(|f| std::fs::read(f).unwrap()).collect();
    let [first, second] = [files()[0].clone(), files()[1].clone()];
    for bytes in [
        &whole[0][..whole[0].len() - 1],
        b"",
        &whole[1],
        &whole[0][40..],
    ] {
        std::fs::write(&first, bytes).unwrap();
        same_as_built(&options, 1);
        same_as_built(&options, 2);
    }
    let mut flipped = whole[1].clone();
    for place in [0, 9, 39, 41, 60, whole[1].len() / 2, whole[1].len() - 1] {
        flipped[place] ^= 4;
        std::fs::write(&second, &flipped).unwrap();
        same_as_built(&options, 1);
        flipped[place] ^= 4;
    }
    assert_eq!(files().len(), 2);
    std::fs::remove_file(&first).unwrap();
    std::fs::create_dir(&first).unwrap();
    assert_eq!(same_as_built(&options, 1).cache_failures, 1);
    std::fs::remove_dir(&first).unwrap();

    // Other meshes and other options are other bodies.
    let mut wrapped = options.clone();
    wrapped.hierarchy.hull_vertex_limit = 16;
    assert_eq!(report(&path, &wrapped).0.bodies_from_cache, 0);
    let sided = UrdfOptions {
        sides: 8,
        ..options.clone()
    };
    assert_eq!(report(&path, &sided).0.bodies_from_cache, 0);
    folder.write("part.obj", mesh.replace("v 1 0", "v 1.5 0"));
    assert_eq!(report(&path, &options).0.bodies_from_cache, 0);

    let no_folder = UrdfOptions {
        cache_folder: Some(path.clone()),
        ..options
    };
    let error = load(&path, &no_folder).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Io);
    assert!(error.message.contains("robot.urdf: "), "{error}");
}
