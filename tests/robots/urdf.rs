//! Robots from URDF files, written here: joints, shapes, bases, mimics, and what is refused.

use cstk::error::{Error, ErrorKind};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, RobotBuilder};
use cstk::urdf::{BaseJoint, UrdfOptions, add_urdf_file};

use crate::urdf_folder::{Folder, load, refused, robot};

pub const ARM: &str = r#"
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
    let poses = robot.link_poses(&q).unwrap();
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
fn planes_turn_about_their_axis_whichever_way_it_points() {
    for axis in [
        Vec3::z(),
        -Vec3::z(),
        Vec3::x(),
        -Vec3::y(),
        Vec3::new(0.0, 0.0, -3.0),
        Vec3::new(1e-9, 0.0, -1.0),
        Vec3::new(1.0, -2.0, 0.5),
    ] {
        let [x, y, z] = [axis.x, axis.y, axis.z];
        let plane = format!(
            r#"<link name="base"/><link name="plane"/><joint name="j" type="planar"><parent link="base"/><child link="plane"/><axis xyz="{x} {y} {z}"/></joint>"#
        );
        let robot = robot("plane_axes", &plane).unwrap();
        let poses = robot.link_poses(&[0.2, 0.3, 0.4]).unwrap();
        let pose = &poses[robot.find_link("plane").unwrap()];
        let axis = axis.normalize();
        assert!(
            (pose.rotation - rotation_about(&axis, 0.4)).amax() < 1e-15,
            "{axis}"
        );
        assert!(pose.translation.dot(&axis).abs() < 1e-15, "{axis}");
    }
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
        (
            "<link name=\"${prefix}a\"/>".into(),
            Parse,
            vec!["line 2", "<link>", "${prefix}", "raw xacro"],
        ),
        (
            "<link name=\"a\"/>\n<x:arm xmlns:x=\"http://www.ros.org/wiki/xacro\"/>".into(),
            Parse,
            vec!["line 3", "<arm>", "raw xacro"],
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
