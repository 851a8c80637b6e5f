//! Robots from URDF files, written here: joints, shapes, meshes of every format, packages, mimics, and what is refused.

use std::path::{Path, PathBuf};

use cstk::body::Body;
use cstk::error::{Error, ErrorKind};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, Robot, RobotBuilder};
use cstk::urdf::{BaseJoint, UrdfGeometry, UrdfOptions, UrdfReport, add_urdf_file, add_urdf_text};

/// A folder of its own that goes when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("cstk-urdf-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn load(path: &Path, options: &UrdfOptions) -> Result<Robot, Error> {
    let mut builder = RobotBuilder::new(3).unwrap();
    let added = add_urdf_file(&mut builder, path, options, &mut |_| Ok(()));
    if added.is_err() {
        assert!(builder.links().is_empty());
    }
    added?;
    builder.build()
}

fn robot(name: &str, body: &str) -> Result<Robot, Error> {
    let folder = Folder::new(name);
    let path = folder.write(
        "robot.urdf",
        format!("<robot name=\"r\">\n{body}\n</robot>\n"),
    );
    load(&path, &UrdfOptions::default())
}

fn refused(name: &str, body: &str, kind: ErrorKind, culprits: &[&str]) {
    let error = robot(name, body)
        .err()
        .unwrap_or_else(|| panic!("{body} was accepted"));
    assert_eq!(error.kind, kind, "{error}");
    for culprit in culprits.iter().chain(&["robot.urdf"]) {
        assert!(
            error.message.contains(culprit),
            "{error} names no {culprit}"
        );
    }
}

const ARM: &str = r#"
<link name="base"><inertial/><collision><geometry><box size="1 2 3"/></geometry></collision></link>
<link name="arm"><collision><origin xyz="0 0 1" rpy="0.1 0.2 0.3"/><geometry><cylinder radius="0.5" length="2"/></geometry></collision></link>
<link name="slide"/><link name="wheel"/><link name="finger"/><link name="ball"/><link name="plane"/><link name="free"/>
<gazebo><joint name="not one"/></gazebo>
<joint name="finger_joint" type="prismatic"><parent link="arm"/><child link="finger"/><axis xyz="0 1 0"/>
  <limit lower="0" upper="0.2"/><mimic joint="slide_joint" multiplier="-0.5" offset="0.1"/></joint>
<joint name="arm_joint" type="revolute"><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><parent link="base"/><child link="arm"/>
  <axis xyz="0 0 2"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
<joint name="slide_joint" type="prismatic"><parent link="arm"/><child link="slide"/><limit lower="-0.1" upper="0.4"/></joint>
<joint name="wheel_joint" type="continuous"><parent link="slide"/><child link="wheel"/><axis xyz="0 0 1"/></joint>
<joint name="ball_joint" type="spherical"><parent link="wheel"/><child link="ball"/></joint>
<joint name="plane_joint" type="planar"><parent link="base"/><child link="plane"/><axis xyz="1 0 0"/></joint>
<joint name="free_joint" type="floating"><parent link="plane"/><child link="free"/></joint>
"#;

#[test]
fn joints_of_every_type() {
    let robot = robot("joints", ARM).unwrap();
    let at = |name: &str| robot.find_joint(name).unwrap();
    let joint = |name: &str| &robot.links()[at(name)].joint;
    assert_eq!(robot.links()[at("finger_joint")].name, "finger");
    assert_eq!(
        (robot.nq(), robot.nv()),
        (1 + 1 + 1 + 4 + 3 + 7, 1 + 1 + 1 + 3 + 3 + 6)
    );
    let range = |name: &str| robot.ranges()[joint(name).coordinate];
    let interval = |lower, upper| Coordinate::Interval { lower, upper };
    assert_eq!(range("arm_joint"), interval(-1.0, 2.0));
    assert_eq!(range("wheel_joint"), Coordinate::Circle);
    // The finger comes before the joint it mimics, and brings that one's limits.
    assert_eq!(
        joint("finger_joint").coordinate,
        joint("slide_joint").coordinate
    );
    assert_eq!(range("slide_joint"), interval(-0.1, 0.4));
    assert!(matches!(joint("ball_joint").kind, JointKind::Spherical));
    assert!(matches!(joint("free_joint").kind, JointKind::Free));

    let mut q = vec![0.0; robot.nq()];
    for name in ["ball_joint", "free_joint"] {
        let j = joint(name);
        q[j.coordinate + j.kind.nq() - 1] = 1.0;
    }
    q[joint("arm_joint").coordinate] = 0.5;
    q[joint("slide_joint").coordinate] = 0.3;
    let plane = joint("plane_joint").coordinate;
    q[plane..plane + 3].copy_from_slice(&[0.2, 0.3, 0.4]);
    let mut poses = Vec::new();
    robot.link_poses(&q, &mut poses).unwrap();
    let pose = |name: &str| &poses[robot.find_link(name).unwrap()];
    let arm = Pose {
        rotation: rotation_about(&Vec3::z(), std::f64::consts::FRAC_PI_2 + 0.5),
        translation: Vec3::x(),
    };
    assert!((pose("arm").rotation - arm.rotation).amax() < 1e-15);
    // The default axis is x; the finger follows -0.5 * 0.3 + 0.1.
    let slide = arm.transform_point(&Vec3::new(0.3, 0.0, 0.0));
    let finger = arm.transform_point(&Vec3::new(0.0, -0.05, 0.0));
    assert!((pose("slide").translation - slide).amax() < 1e-15);
    assert!((pose("finger").translation - finger).amax() < 1e-15);
    // A plane across x: the link stays in it, and turns about x.
    assert!(pose("plane").translation.x.abs() < 1e-15);
    assert!((pose("plane").rotation - rotation_about(&Vec3::x(), 0.4)).amax() < 1e-15);
    assert!((pose("plane").translation.norm() - 0.2f64.hypot(0.3)).abs() < 1e-15);
}

#[test]
fn shapes_stand_where_the_file_says() {
    let robot = robot("shapes", ARM).unwrap();
    let body = |name: &str| robot.links()[robot.find_link(name).unwrap()].body.clone();
    assert!(body("slide").is_none());
    let (cube, can) = (body("base").unwrap(), body("arm").unwrap());
    // Roll, pitch, yaw about the fixed x, y, z.
    let turned = rotation_about(&Vec3::z(), 0.3)
        * rotation_about(&Vec3::y(), 0.2)
        * rotation_about(&Vec3::x(), 0.1);
    let mut builder = cstk::body::BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&[Vec3::zeros()], 0).unwrap();
    let point = helpers::models::built(&builder, &Default::default());
    let mut query = QueryContext::new();
    let mut distance = |body: &cstk::body::Body, at: Vec3| {
        let here = Pose::identity();
        let there = Pose::from_translation(at);
        let found = query.pair_distance((body, &here), (&point, &there), f64::INFINITY);
        found.unwrap().distance
    };
    assert_eq!(distance(&cube, Vec3::new(0.5, 1.0, 3.5)), 2.0);
    for (local, want) in [
        (Vec3::new(0.0, 0.0, 2.0), 1.0),
        (Vec3::new(0.0, 0.0, -1.0), 0.0),
        (Vec3::new(0.5, 0.0, 0.0), 0.0),
    ] {
        let at = turned * local + Vec3::z();
        assert!((distance(&can, at) - want).abs() < 1e-12, "{local}");
    }
    let aside = turned * Vec3::new(1.5, 0.0, 0.0) + Vec3::z();
    assert!((distance(&can, aside) - 1.0).abs() < 1e-12);
    // The polyhedron holds the cylinder: from the side it is nearer by 0.5 / cos(pi / 32) - 0.5 at most.
    let folder = Folder::new("sided");
    let path = folder.write("robot.urdf", format!("<robot name=\"r\">{ARM}</robot>"));
    let options = UrdfOptions {
        sides: 32,
        ..Default::default()
    };
    let sided = load(&path, &options).unwrap();
    let can = sided.links()[sided.find_link("arm").unwrap()].body.clone();
    let aside = distance(&can.unwrap(), aside);
    assert!((0.99..1.0).contains(&aside), "{aside}");
}

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

#[test]
fn a_robot_on_a_robot_with_a_free_base() {
    let folder = Folder::new("base");
    let path = folder.write("robot.urdf", format!("<robot name=\"r\">{ARM}</robot>"));
    let mut builder = RobotBuilder::new(3).unwrap();
    let base = UrdfOptions {
        base: BaseJoint::Free,
        ..Default::default()
    };
    add_urdf_file(&mut builder, &path, &base, &mut |_| Ok(())).unwrap();
    let count = builder.links().len();
    // The same names again are refused, and leave no trace.
    let again = add_urdf_file(&mut builder, &path, &base, &mut |_| Ok(()));
    assert_eq!(again.unwrap_err().kind, ErrorKind::InvalidArgument);
    assert_eq!(builder.links().len(), count);
    let second = UrdfOptions {
        base: BaseJoint::Planar,
        parent: Some(count - 1),
        at: Pose::from_translation(Vec3::y()),
        prefix: "second/".into(),
        ..Default::default()
    };
    let report = add_urdf_file(&mut builder, &path, &second, &mut |_| Ok(())).unwrap();
    let root = report.root;
    assert_eq!(root, count);
    let robot = builder.build().unwrap();
    assert_eq!(robot.links()[root].parent, Some(count - 1));
    assert_eq!((robot.nq(), robot.nv()), (7 + 17 + 3 + 17, 6 + 15 + 3 + 15));
    assert!(robot.find_joint("second/arm_joint").is_some());
    // Ended from outside.
    let stop = &mut |_| Err(Error::new(ErrorKind::Cancelled, "enough"));
    let ended = add_urdf_file(&mut RobotBuilder::new(3).unwrap(), &path, &base, stop);
    assert_eq!(ended.unwrap_err().kind, ErrorKind::Cancelled);
}

#[test]
fn faults_are_named_with_line_and_element() {
    use ErrorKind::{Degenerate, Empty, InvalidArgument, NotFinite, NotFound, Parse, Unsupported};
    let joint = |rest: &str| {
        format!("<link name=\"a\"/>\n<link name=\"b\"/>\n<joint name=\"j\" {rest}</joint>")
    };
    let ends = "<parent link=\"a\"/><child link=\"b\"/>";
    let revolute = |rest: &str| joint(&format!("type=\"revolute\">{ends}{rest}"));
    let shape = |text: &str| {
        format!("<link name=\"a\">\n<collision><geometry>{text}</geometry></collision></link>")
    };
    for (i, (body, kind, culprits)) in [
        (String::new(), Empty, vec!["no link"]),
        (
            "<link/>".into(),
            Parse,
            vec!["line 2", "<link>", "\"name\""],
        ),
        (
            "<link name=\"a\"/><link name=\"a\"/>".into(),
            InvalidArgument,
            vec!["\"a\""],
        ),
        (
            "<link name=\"a\"/><link name=\"b\"/>".into(),
            InvalidArgument,
            vec!["\"b\"", "\"a\""],
        ),
        ("<link name=\"a\">".into(), Parse, vec![]),
        (
            joint(&format!("type=\"hinge\">{ends}")),
            Unsupported,
            vec!["line 4", "\"j\"", "hinge"],
        ),
        (joint(&format!(">{ends}")), Parse, vec!["\"j\"", "type"]),
        (
            joint("type=\"fixed\"><parent link=\"a\"/>"),
            Parse,
            vec!["\"j\"", "<child>"],
        ),
        (
            joint("type=\"fixed\"><parent link=\"c\"/><child link=\"b\"/>"),
            NotFound,
            vec!["\"j\"", "\"c\""],
        ),
        (
            joint("type=\"fixed\"><parent link=\"b\"/><child link=\"b\"/>"),
            InvalidArgument,
            vec!["circle"],
        ),
        (revolute(""), Parse, vec!["\"j\"", "<limit>"]),
        (
            revolute("<limit lower=\"1\" upper=\"0\"/>"),
            InvalidArgument,
            vec!["\"j\"", "1 to 0"],
        ),
        (
            revolute("<limit lower=\"nan\"/>"),
            NotFinite,
            vec!["\"j\"", "<limit>", "lower"],
        ),
        (
            revolute("<limit/><axis xyz=\"0 0 0\"/>"),
            Degenerate,
            vec!["\"j\"", "axis"],
        ),
        (
            revolute("<limit/><axis xyz=\"0 x 0 1\"/>"),
            Parse,
            vec!["\"j\"", "<axis>", "\"x\""],
        ),
        (
            revolute("<limit/><origin rpy=\"0 0\"/>"),
            Parse,
            vec!["\"j\"", "<origin>", "rpy", "2 numbers"],
        ),
        (
            revolute("<limit/><origin xyz=\"1e60 0 0\"/>"),
            InvalidArgument,
            vec!["\"j\"", "position"],
        ),
        (
            revolute("<limit/><mimic joint=\"k\"/>"),
            NotFound,
            vec!["\"j\"", "\"k\""],
        ),
        (
            revolute("<limit/><mimic joint=\"j\"/>"),
            InvalidArgument,
            vec!["\"j\"", "circle"],
        ),
        (
            shape("<box size=\"1 2\"/>"),
            Parse,
            vec!["\"a\"", "line 3", "<box>", "size"],
        ),
        (
            shape("<box size=\"1 0 1\"/>"),
            InvalidArgument,
            vec!["\"a\"", "<box>", "size"],
        ),
        (
            shape("<sphere/>"),
            Parse,
            vec!["\"a\"", "<sphere>", "radius"],
        ),
        (
            shape("<sphere radius=\"-1\"/>"),
            InvalidArgument,
            vec!["\"a\"", "<sphere>", "radius"],
        ),
        (shape("<cone/>"), Unsupported, vec!["\"a\"", "<cone>"]),
        (shape(""), Parse, vec!["\"a\"", "<geometry>"]),
        (
            shape("<mesh filename=\"x.obj\" scale=\"1 0 1\"/>"),
            Degenerate,
            vec!["\"a\"", "scale"],
        ),
    ]
    .into_iter()
    .enumerate()
    {
        refused(&format!("fault{i}"), &body, kind, &culprits);
    }
    let folder = Folder::new("files");
    let missing = load(&folder.0.join("none.urdf"), &UrdfOptions::default()).unwrap_err();
    assert_eq!(missing.kind, Io);
    let path = folder.write("other.urdf", "<sdf/>");
    let error = load(&path, &UrdfOptions::default()).unwrap_err();
    assert!(
        error.message.contains("other.urdf") && error.message.contains("<sdf>"),
        "{error}"
    );
    let path = folder.write("bytes.urdf", b"<robot>\n\xff</robot>");
    let error = load(&path, &UrdfOptions::default()).unwrap_err();
    assert!(error.message.contains("line 2"), "{error}");
    use cstk::error::ErrorKind::Io;
}

/// Whichever of the joints stands first in the file, each follows the end of the chain by all that is in between.
#[test]
fn a_long_chain_of_mimics_is_followed_to_its_end() {
    const COUNT: usize = 3000;
    let joint = |k: usize| {
        let mimic = match k {
            1 => String::new(),
            _ => format!(
                "<mimic joint=\"j{}\" multiplier=\"-1\" offset=\"{k}\"/>",
                k - 1
            ),
        };
        format!(
            "<joint name=\"j{k}\" type=\"continuous\"><parent link=\"l{}\"/><child link=\"l{k}\"/>{mimic}</joint>\n",
            k - 1
        )
    };
    let links: String = (0..=COUNT)
        .map(|k| format!("<link name=\"l{k}\"/>\n"))
        .collect();
    let forwards: String = (1..=COUNT).map(joint).collect();
    let backwards: String = (1..=COUNT).rev().map(joint).collect();
    for (name, joints) in [("mimics", forwards), ("mimics_back", backwards)] {
        let robot = robot(name, &format!("{links}{joints}")).unwrap();
        assert_eq!(robot.nq(), 1);
        let (mut multiplier, mut offset) = (1.0, 0.0);
        for k in 1..=COUNT {
            if k > 1 {
                (multiplier, offset) = (-multiplier, k as f64 - offset);
            }
            let link = robot.find_joint(&format!("j{k}")).unwrap();
            let joint = &robot.links()[link].joint;
            assert_eq!((joint.multiplier, joint.offset), (multiplier, offset));
        }
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
