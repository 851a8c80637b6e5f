//! SRDF files, written here: pairs, groups, states, end effectors, virtual joints, and what is refused.

use std::sync::Arc;

use cstk::error::{Error, ErrorKind};
use cstk::query::{LinkPairOptions, PairVerdict, QueryContext};
use cstk::robot::{Robot, RobotBuilder};
use cstk::space::{Space, WorldBox};
use cstk::srdf::{SrdfOptions, SrdfReport, add_srdf_file, add_srdf_text};
use cstk::urdf::{BaseJoint, UrdfOptions, add_urdf_text};

use helpers::random::Random;

/// A base, an arm of three links with a gripper of two fingers of which one follows the other, and a mast beside it.
fn urdf() -> String {
    let ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
    let links: String = ["base", "a", "b", "c", "left", "right", "mast", "top"]
        .iter()
        .map(|name| format!("<link name=\"{name}\">{ball}</link>"))
        .collect();
    let joint = |name: &str, kind: &str, parent: &str, child: &str, rest: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><origin xyz=\"1 0 0\"/><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <axis xyz=\"0 0 1\"/><limit lower=\"-2\" upper=\"2\"/>{rest}</joint>"
        )
    };
    let joints = [
        joint("ja", "revolute", "base", "a", ""),
        joint("jb", "revolute", "a", "b", ""),
        joint("jtool", "fixed", "b", "c", ""),
        joint("jleft", "prismatic", "c", "left", ""),
        joint(
            "jright",
            "prismatic",
            "c",
            "right",
            "<mimic joint=\"jleft\" multiplier=\"-2\" offset=\"0.5\"/>",
        ),
        joint("jmast", "fixed", "base", "mast", ""),
        joint("jtop", "continuous", "mast", "top", ""),
    ];
    format!(
        "<robot name=\"r\">{links}<link name=\"tool\"/>{}{}</robot>",
        joints.concat(),
        joint("jt", "fixed", "c", "tool", "")
    )
}

const SRDF: &str = r#"
<virtual_joint name="world_joint" type="floating" parent_frame="odom" child_link="base"/>
<group name="both"><group name="arm"/><group name="hand"/><joint name="jtop"/></group>
<group name="arm"><chain base_link="base" tip_link="c"/></group>
<group name="hand"><link name="left"/><link name="right"/></group>
<group name="across"><chain base_link="top" tip_link="a"/></group>
<group name="all"><joint name="world_joint"/><group name="both"/><group name="arm"/></group>
<group name="none"/>
<group_state name="home" group="arm"><joint name="ja" value="0.5"/><joint name="jb" value=" -0.25 "/><joint name="jtool" value="1"/></group_state>
<group_state name="home" group="hand"><joint name="jleft" value="0.1"/><joint name="jright" value="0.7"/></group_state>
<group_state name="wide" group="hand"><joint name="jright" value="-0.5"/></group_state>
<group_state name="there"><joint name="world_joint" value="1 2 3 0 0 0.70711 0.70711"/></group_state>
<end_effector name="gripper" parent_link="c" group="hand" parent_group="arm"/>
<end_effector name="probe" parent_link="tool" group="arm"/>
<passive_joint name="jtop"/>
<disable_collisions link1="base" link2="a" reason="Adjacent"/>
<disable_collisions link1="a" link2="base" reason="Adjacent"/>
<disable_collisions link1="c" link2="mast"/>
<disable_default_collisions link="mast"/>
<enable_collisions link1="mast" link2="b"/>
<enable_collisions link1="mast" link2="c"/>
<link_sphere_approximation link="a"/>
"#;

fn with(base: BaseJoint, srdf: &str, options: &SrdfOptions) -> Result<(Robot, SrdfReport), Error> {
    let mut builder = RobotBuilder::new(3).unwrap();
    let of_urdf = UrdfOptions {
        base,
        prefix: options.prefix.clone(),
        ..Default::default()
    };
    add_urdf_text(&mut builder, &urdf(), None, &of_urdf, &mut |_| Ok(())).unwrap();
    let text = format!("<robot name=\"r\">{srdf}</robot>");
    let report = add_srdf_text(&mut builder, &text, options)?;
    Ok((builder.build()?, report))
}

fn loaded(srdf: &str) -> (Robot, SrdfReport) {
    with(BaseJoint::Free, srdf, &SrdfOptions::default()).unwrap()
}

fn names(robot: &Robot, group: &str) -> Vec<String> {
    let semantics = robot.semantics();
    let group = &semantics.groups[semantics.find_group(group).unwrap()];
    let names = group
        .joints
        .iter()
        .map(|&link| robot.links()[link as usize].joint_name.clone());
    names.collect()
}

#[test]
fn groups_hold_what_is_named_chained_and_nested() {
    let (robot, report) = loaded(SRDF);
    let expected = SrdfReport {
        groups: 6,
        states: 4,
        end_effectors: 2,
        virtual_joints: 1,
        passive_joints: 1,
        disabled_pairs: 2,
        skipped_elements: 1,
        // The fixed tool, and the finger that follows.
        unused_values: 2,
        ..Default::default()
    };
    assert_eq!(report, expected);
    assert_eq!(names(&robot, "arm"), ["ja", "jb", "jtool"]);
    assert_eq!(names(&robot, "hand"), ["jleft", "jright"]);
    assert_eq!(
        names(&robot, "both"),
        ["ja", "jb", "jtool", "jleft", "jright", "jtop"]
    );
    // Down one branch and up the other, without the joint above where they meet.
    assert_eq!(names(&robot, "across"), ["ja", "jmast", "jtop"]);
    assert_eq!(names(&robot, "all").len(), 7);
    assert!(names(&robot, "none").is_empty());
    let coordinate = |joint: &str| {
        robot.links()[robot.find_joint(joint).unwrap()]
            .joint
            .coordinate as u32
    };
    let semantics = robot.semantics();
    let of = |group: &str| {
        semantics.groups[semantics.find_group(group).unwrap()]
            .coordinates
            .clone()
    };
    assert_eq!(of("arm"), [coordinate("ja"), coordinate("jb")]);
    // Two fingers, one coordinate.
    assert_eq!(of("hand"), [coordinate("jleft")]);
    assert_eq!(of("all").len(), 7 + 4);
    assert_eq!(
        semantics.passive_joints,
        [robot.find_link("top").unwrap() as u32]
    );
}

#[test]
fn states_set_the_coordinates_of_their_joints() {
    let (robot, _) = loaded(SRDF);
    let semantics = robot.semantics();
    let coordinate = |joint: &str| {
        robot.links()[robot.find_joint(joint).unwrap()]
            .joint
            .coordinate as u32
    };
    let state = |group: Option<&str>, name: &str| {
        let group = group.map(|group| semantics.find_group(group).unwrap());
        let state = &semantics.states[semantics.find_state(group, name).unwrap()];
        let pairs = state
            .coordinates
            .iter()
            .copied()
            .zip(state.values.iter().copied());
        pairs.collect::<Vec<_>>()
    };
    assert_eq!(
        state(Some("arm"), "home"),
        [(coordinate("ja"), 0.5), (coordinate("jb"), -0.25)]
    );
    // The finger's own value holds, whatever the follower's says; alone the follower's is solved for: -2 q + 0.5 = -0.5.
    assert_eq!(state(Some("hand"), "home"), [(coordinate("jleft"), 0.1)]);
    assert_eq!(state(Some("hand"), "wide"), [(coordinate("jleft"), 0.5)]);
    let there = state(None, "there");
    assert_eq!(there.len(), 7);
    let norm: f64 = there[3..].iter().map(|(_, x)| x * x).sum();
    assert!((norm - 1.0).abs() < 1e-15 && (there[5].1 - 0.5f64.sqrt()).abs() < 1e-6);
    assert!(semantics.find_state(None, "home").is_none());
    // On a base that stands still there is nothing to set.
    let (fixed, report) = with(BaseJoint::Fixed, SRDF, &SrdfOptions::default()).unwrap();
    assert_eq!(report.unused_values, 3);
    let semantics = fixed.semantics();
    assert!(
        semantics.states[semantics.find_state(None, "there").unwrap()]
            .values
            .is_empty()
    );
    // Of a frozen robot the states keep what is left.
    let arm = robot.semantics().groups[robot.semantics().find_group("arm").unwrap()].clone();
    let joints: Vec<usize> = arm.joints.iter().map(|&link| link as usize).collect();
    let mut q = vec![0.0; robot.nq()];
    q[6] = 1.0;
    let alone = robot.freeze(&joints, &q).unwrap();
    let semantics = alone.semantics();
    assert_eq!(
        semantics.groups[semantics.find_group("both").unwrap()].coordinates,
        [0, 1]
    );
    let home = &semantics.states[semantics
        .find_state(semantics.find_group("arm"), "home")
        .unwrap()];
    assert_eq!(
        (&home.coordinates[..], &home.values[..]),
        (&[0, 1][..], &[0.5, -0.25][..])
    );
}

#[test]
fn end_effectors_tell_what_a_held_object_may_touch() {
    let (robot, _) = loaded(SRDF);
    let semantics = robot.semantics();
    let touched = |name: &str| {
        let found = &semantics.end_effectors[semantics.find_end_effector(name).unwrap()];
        let links = found
            .touch_links
            .iter()
            .map(|&link| robot.links()[link as usize].name.clone());
        (links.collect::<Vec<_>>(), found.parent_group)
    };
    assert_eq!(
        touched("gripper"),
        (
            vec!["c".into(), "left".into(), "right".into()],
            semantics.find_group("arm")
        )
    );
    // The tool frame has no body.
    assert_eq!(
        touched("probe"),
        (vec!["a".into(), "b".into(), "c".into()], None)
    );
    let world = &semantics.virtual_joints[0];
    assert_eq!((world.parent_frame.as_str(), world.child_link), ("odom", 0));
    assert_eq!(robot.find_joint("world_joint"), Some(0));
}

/// The rule by its words, for every pair: disabled by name, or by a link's default and not enabled.
#[test]
fn pairs_are_those_that_the_file_leaves() {
    let (robot, _) = loaded(SRDF);
    let robot = Arc::new(robot);
    let space = Space::new(
        vec![robot.clone(), robot.clone()],
        &[],
        WorldBox::unbounded(),
    )
    .unwrap();
    let name = |link: usize| robot.links()[link % 9].name.as_str();
    let enabled: Vec<[usize; 2]> = space.enabled_pairs().collect();
    let mut expected = Vec::new();
    let mut disabled = 0;
    for r in 0..18 {
        for s in r + 1..18 {
            if name(r) == "tool" || name(s) == "tool" {
                continue;
            }
            let is = |a: &str, b: &str| [[a, b], [b, a]].contains(&[name(r), name(s)]);
            let by_name = is("base", "a") || is("c", "mast");
            let of_mast = name(r) == "mast" || name(s) == "mast";
            let by_default = of_mast && !is("mast", "b") && !is("mast", "c");
            if (r < 9) == (s < 9) && (by_name || by_default) {
                disabled += 1;
                continue;
            }
            expected.push([r, s]);
        }
    }
    assert_eq!(enabled, expected);
    // Of each robot: base-a, c-mast, and the mast with base, a, left, right, top.
    assert_eq!(disabled, 2 * 7);
    // Sampling keeps to it, and adds what it finds.
    let options = LinkPairOptions {
        samples: 10,
        ..Default::default()
    };
    let found = QueryContext::new()
        .find_link_pairs(&space, &options, &mut |_| Ok(()))
        .unwrap();
    for pair in &found {
        let is_out = pair.verdict == PairVerdict::Disabled;
        assert_eq!(is_out, !enabled.contains(&pair.links), "{pair:?}");
    }
    assert!(
        found
            .iter()
            .any(|pair| pair.verdict == PairVerdict::Adjacent)
    );
}

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

/// What a robot holds after any SRDF is whole: every number names something, names are unique, lists ascend.
fn check_semantics(robot: &Robot) {
    let semantics = robot.semantics();
    let links = robot.links().len() as u32;
    let ascends = |items: &[u32], end: u32| {
        assert!(items.windows(2).all(|two| two[0] < two[1]), "{items:?}");
        assert!(
            items.iter().all(|&item| item < end),
            "{items:?} below {end}"
        );
    };
    for (i, group) in semantics.groups.iter().enumerate() {
        ascends(&group.joints, links);
        ascends(&group.coordinates, robot.nq() as u32);
        assert_eq!(semantics.find_group(group.name.as_str()), Some(i));
    }
    for (i, state) in semantics.states.iter().enumerate() {
        ascends(&state.coordinates, robot.nq() as u32);
        assert_eq!(state.coordinates.len(), state.values.len());
        assert!(state.values.iter().all(|value| value.is_finite()));
        assert!(
            state
                .group
                .is_none_or(|group| group < semantics.groups.len())
        );
        assert_eq!(
            semantics.find_state(state.group, state.name.as_str()),
            Some(i)
        );
    }
    for (i, effector) in semantics.end_effectors.iter().enumerate() {
        assert!(effector.parent_link < links && effector.group < semantics.groups.len());
        assert!(
            effector
                .parent_group
                .is_none_or(|group| group < semantics.groups.len())
        );
        ascends(&effector.touch_links, links);
        assert_eq!(semantics.find_end_effector(effector.name.as_str()), Some(i));
    }
    ascends(&semantics.passive_joints, links);
    for virtual_joint in &semantics.virtual_joints {
        assert!(virtual_joint.child_link < links);
    }
}

/// A text with some of its parts replaced, repeated, moved or removed: whole lines, attributes' values, and single bytes.
fn mutated(random: &mut Random) -> Vec<u8> {
    let words = [
        "base",
        "a",
        "c",
        "tool",
        "mast",
        "ja",
        "jb",
        "jleft",
        "jright",
        "jtop",
        "arm",
        "hand",
        "both",
        "none",
        "home",
        "wide",
        "world_joint",
        "floating",
        "planar",
        "fixed",
        "",
        " ",
        "0",
        "-1e308",
        "1e999",
        "nan",
        "1 2 3 0 0 0 1",
        "&lt;",
        "&#0;",
        "group",
        "joint",
        "link",
        "chain",
        "\u{e9}",
        "/",
        "../x",
    ];
    let mut lines: Vec<String> = SRDF.lines().map(String::from).collect();
    for _ in 0..=random.below(3) {
        let [from, to] = [0, 1].map(|_| random.below(lines.len()));
        match random.below(4) {
            0 => lines.swap(from, to),
            1 => lines.insert(to, lines[from].clone()),
            2 if lines.len() > 2 => drop(lines.remove(from)),
            _ => {
                // Every second part is an attribute's value, but for elements that hold others.
                let mut parts: Vec<&str> = lines[from].split('"').collect();
                let at = random.below(parts.len());
                parts[at] = words[random.below(words.len())];
                lines[from] = parts.join("\"");
            }
        }
    }
    let text = format!("<robot name=\"r\">{}</robot>", lines.join("\n"));
    let mut bytes = text.into_bytes();
    for _ in 0..random.below(3) {
        let at = random.below(bytes.len());
        match random.below(3) {
            0 => bytes[at] = b"<>/\"= &;\0x\xff"[random.below(11)],
            1 => drop(bytes.splice(at..at, *b"<group>")),
            _ => bytes.truncate(at + 1),
        }
    }
    bytes
}

/// `CSTK_MUTATIONS=1000000 cargo test --release --test robots no_srdf -- --nocapture` runs a campaign.
#[test]
fn no_srdf_text_leads_to_a_fault() {
    let campaign = std::env::var("CSTK_MUTATIONS").ok();
    let count = campaign.map_or(6000, |count| count.parse().unwrap());
    let mut random = Random::new(61);
    let mut builder = RobotBuilder::new(3).unwrap();
    let of_urdf = UrdfOptions {
        base: BaseJoint::Free,
        ..Default::default()
    };
    add_urdf_text(&mut builder, &urdf(), None, &of_urdf, &mut |_| Ok(())).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mutated.srdf");
    let [mut taken, mut refused] = [0; 2];
    for round in 0..count {
        let bytes = mutated(&mut random);
        let options = SrdfOptions {
            prefix: ["", "p_"][usize::from(random.below(8) == 0)].to_string(),
            skip_unknown: random.below(2) == 0,
        };
        let mut extended = builder.clone();
        // Some are read from files, where they need not be text.
        let found = match std::str::from_utf8(&bytes) {
            Ok(text) if round % 16 > 0 => add_srdf_text(&mut extended, text, &options),
            _ => {
                std::fs::write(&file, &bytes).unwrap();
                add_srdf_file(&mut extended, &file, &options)
            }
        };
        match found {
            Ok(report) => {
                taken += 1;
                let robot = extended.build().unwrap();
                check_semantics(&robot);
                assert_eq!(report.groups, robot.semantics().groups.len());
                assert_eq!(report.states, robot.semantics().states.len());
            }
            Err(error) => {
                refused += 1;
                assert!(
                    error.message.contains("SRDF text") || error.message.contains("mutated.srdf")
                );
                // Added whole or not at all.
                let robot = extended.build().unwrap();
                assert!(robot.semantics().groups.is_empty() && robot.semantics().states.is_empty());
            }
        }
    }
    println!("{taken} taken, {refused} refused");
    assert!(
        taken > count / 20 && refused > count / 20,
        "{taken} {refused}"
    );
}

/// As in MoveIt, a state is of its group: what it says of other joints is not applied.
#[test]
fn states_set_no_joint_outside_their_group() {
    let (robot, report) = loaded(
        r#"<group name="hand"><joint name="jleft"/></group>
<group_state name="home" group="hand"><joint name="ja" value="0.5"/><joint name="jleft" value="0.1"/></group_state>
<group_state name="all"><joint name="ja" value="0.5"/></group_state>"#,
    );
    assert_eq!(report.unused_values, 1);
    let states = &robot.semantics().states;
    assert_eq!(states[0].values, [0.1]);
    assert_eq!(states[1].values, [0.5]);
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
