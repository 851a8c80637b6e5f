//! What is refused or skipped of SRDF files.

use cstk::error::ErrorKind;
use cstk::robot::RobotBuilder;
use cstk::srdf::{SrdfOptions, add_srdf_text};
use cstk::urdf::{BaseJoint, UrdfOptions, add_urdf_text};

use crate::srdf_example::{SRDF, loaded, names, urdf, with};

#[test]
fn faults_are_named_with_line_and_element() {
    use ErrorKind::{
        InvalidArgument, NotARotation, NotFinite, NotFound, Parse, Unsupported, WrongSize,
    };
    let state = |rest: &str| {
        format!(
            "<group name='g'><joint name='ja'/></group>\n<group_state name='s' group='g'>{rest}</group_state>"
        )
    };
    let circle = "<group name='x'><group name='y'/></group>\n<group name='y'><group name='z'/></group>\n<group name='z'><group name='x'/></group>";
    let many: String = (0..4097).map(|i| format!("<group name='g{i}'/>")).collect();
    // Each group holds the one before twice: 2^n joints if they were not put together.
    let doubled: String = (1..60)
        .map(|i| {
            format!(
                "<group name='g{i}'><group name='g{0}'/><group name='g{0}'/></group>",
                i - 1
            )
        })
        .collect();
    let doubled =
        format!("<group name='g0'><chain base_link='base' tip_link='c'/></group>{doubled}");
    assert_eq!(names(&loaded(&doubled).0, "g59"), ["ja", "jb", "jtool"]);
    for (text, kind, culprits) in [
        ("<group name='g'>".to_string(), Parse, vec![]),
        (
            "<group/>".into(),
            Parse,
            vec!["line 1, <group>", "\"name\""],
        ),
        (
            "\n<group name='g'><joint name='no'/></group>".into(),
            NotFound,
            vec!["line 2, <joint>", "group \"g\"", "joint \"no\""],
        ),
        (
            "<group name='g'><link name='no'/></group>".into(),
            NotFound,
            vec!["<link>", "link \"no\""],
        ),
        (
            "<group name='g'><chain base_link='base' tip_link='no'/></group>".into(),
            NotFound,
            vec!["<chain>", "\"no\""],
        ),
        (
            "<group name='g'><chain base_link='base'/></group>".into(),
            Parse,
            vec!["<chain>", "tip_link"],
        ),
        (
            "<group name='g'><group name='no'/></group>".into(),
            NotFound,
            vec!["group \"no\""],
        ),
        (
            "<group name='g'><group name='g'/></group>".into(),
            InvalidArgument,
            vec!["\"g\"", "circle"],
        ),
        (
            circle.into(),
            InvalidArgument,
            vec!["line 1, <group>", "\"x\"", "circle"],
        ),
        (
            "<group name='g'/><group name='g'/>".into(),
            InvalidArgument,
            vec!["another group", "\"g\""],
        ),
        (many, Unsupported, vec!["4097 groups"]),
        (
            "<end_effector/>".repeat(4097),
            Unsupported,
            vec!["4097 elements <end_effector>"],
        ),
        (
            "<group_state name='s' group='no'/>".into(),
            NotFound,
            vec!["<group_state>", "\"s\"", "\"no\""],
        ),
        (
            state("<joint name='no' value='1'/>"),
            NotFound,
            vec!["line 2, <joint>", "\"no\""],
        ),
        (state("<joint name='ja'/>"), Parse, vec!["\"ja\"", "value"]),
        (
            state("<joint name='ja' value='1 2'/>"),
            WrongSize,
            vec!["\"s\"", "\"ja\"", "2 numbers, not 1"],
        ),
        (
            state("<joint name='ja' value='x'/>"),
            Parse,
            vec!["\"ja\"", "\"x\""],
        ),
        (
            state("<joint name='ja' value='nan'/>"),
            NotFinite,
            vec!["\"ja\""],
        ),
        (
            state("<joint name='ja' value='1e60'/>"),
            InvalidArgument,
            vec!["\"ja\"", "too large"],
        ),
        (
            state("<joint name='ja' value='1'/><joint name='ja' value='1'/>"),
            InvalidArgument,
            vec!["\"ja\"", "already"],
        ),
        (
            format!("{}<group_state name='s' group='g'/>", state("")),
            InvalidArgument,
            vec!["\"s\"", "another state"],
        ),
        (
            "<end_effector name='e' parent_link='no' group='g'/>".into(),
            NotFound,
            vec!["<end_effector>", "\"no\""],
        ),
        (
            "<end_effector name='e' parent_link='c'/>".into(),
            Parse,
            vec!["\"e\"", "group"],
        ),
        (
            "<virtual_joint name='v' type='hinge' parent_frame='w' child_link='base'/>".into(),
            Unsupported,
            vec!["\"v\"", "hinge"],
        ),
        (
            "<virtual_joint name='v' type='fixed' parent_frame='w' child_link='b'/>".into(),
            InvalidArgument,
            vec!["\"v\"", "\"jb\"", "no root"],
        ),
        (
            "<virtual_joint name='ja' type='fixed' parent_frame='w' child_link='base'/>".into(),
            InvalidArgument,
            vec!["another joint"],
        ),
        (
            "<virtual_joint name='v' type='floating' parent_frame='w' child_link='base'/>\
          <group_state name='s'><joint name='v' value='0 0 0 0 0 0 0.5'/></group_state>"
                .into(),
            NotARotation,
            vec!["\"v\"", "norm"],
        ),
        (
            "<passive_joint name='no'/>".into(),
            NotFound,
            vec!["<passive_joint>", "\"no\""],
        ),
        (
            "<disable_collisions link1='a' link2='no'/>".into(),
            NotFound,
            vec!["<disable_collisions>", "\"no\""],
        ),
        (
            "<disable_collisions link1='a'/>".into(),
            Parse,
            vec!["link2"],
        ),
        (
            "<disable_collisions link1='a' link2='a'/>".into(),
            InvalidArgument,
            vec!["\"a\"", "itself"],
        ),
    ] {
        let error = with(BaseJoint::Free, &text, &SrdfOptions::default()).err();
        let error = error.unwrap_or_else(|| panic!("{text} was accepted"));
        assert_eq!(error.kind, kind, "{error}");
        for culprit in culprits.iter().chain(&["SRDF text"]) {
            assert!(
                error.message.contains(culprit),
                "{error} names no {culprit}"
            );
        }
    }
}

#[test]
fn unknown_names_are_skipped_on_request_and_prefixes_are_kept_apart() {
    let skipping = SrdfOptions {
        prefix: "left_".into(),
        skip_unknown: true,
    };
    let text = format!(
        "{SRDF}<disable_collisions link1='a' link2='no'/><group name='more'><joint name='no'/><joint name='ja'/></group>\
         <group_state name='s' group='no'/><end_effector name='e' parent_link='no' group='no'/><passive_joint name='no'/>\
         <virtual_joint name='w' type='fixed' parent_frame='o' child_link='b'/>"
    );
    let (robot, report) = with(BaseJoint::Free, &text, &skipping).unwrap();
    assert_eq!((report.unknown_names, report.groups), (7, 7));
    assert_eq!(names(&robot, "left_more"), ["left_ja"]);
    assert_eq!(robot.find_joint("left_world_joint"), Some(0));
    // Another robot of the same file beside it, and pairs by name.
    let mut builder = RobotBuilder::new(3).unwrap();
    for prefix in ["l_", "r_"] {
        let of_urdf = UrdfOptions {
            prefix: prefix.into(),
            ..Default::default()
        };
        add_urdf_text(&mut builder, &urdf(), None, &of_urdf, &mut |_| Ok(())).unwrap();
        let options = SrdfOptions {
            prefix: prefix.into(),
            ..Default::default()
        };
        let text = format!("<robot>{SRDF}</robot>");
        add_srdf_text(&mut builder, &text, &options).unwrap();
        // Twice is refused, and changes nothing.
        assert!(add_srdf_text(&mut builder, &text, &options).is_err());
    }
    assert_eq!(builder.semantics().groups.len(), 12);
    builder.disable_pair(["l_a", "r_a"]).unwrap();
    assert_eq!(
        builder.disable_pair(["l_a", "a"]).unwrap_err().kind,
        ErrorKind::NotFound
    );
    assert_eq!(
        builder.disable_pair(["l_a", "l_a"]).unwrap_err().kind,
        ErrorKind::InvalidArgument
    );
    let robot = builder.build().unwrap();
    let pair = ["l_a", "r_a"].map(|name| robot.find_link(name).unwrap() as u32);
    assert!(robot.semantics().pairs.is_disabled(pair));
    assert!(!robot.semantics().pairs.is_disabled([pair[0], pair[1] + 1]));
}

#[test]
fn texts_that_are_no_srdf_are_refused() {
    let refused = |srdf: &str| {
        let error = with(BaseJoint::Free, srdf, &SrdfOptions::default()).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Parse);
        error.message
    };
    for urdf in [
        "<link name='a'/>",
        "<gazebo/><joint name='ja' type='fixed'/>",
    ] {
        let message = refused(urdf);
        assert!(message.contains("URDF"), "{message}");
    }
    for raw in [
        "<group name='${prefix}arm'/>",
        "<disable_collisions link1='a' link2='${prefix}b'/>",
        "<group name='arm'><joint name='${prefix}ja'/></group>",
    ] {
        let message = refused(raw);
        assert!(
            message.contains("raw xacro") && message.contains("${prefix}"),
            "{message}"
        );
    }
    // Nothing, or what is of neither kind, is an SRDF file without content.
    loaded("");
    loaded("<link_sphere_approximation link='a'/>");
    loaded("<group name='g'/><link name='a'/>");
}
