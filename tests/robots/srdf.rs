//! What SRDF files say: pairs, groups, states, end effectors, virtual joints.

use std::sync::Arc;

use cstk::query::{LinkPairOptions, PairVerdict, QueryContext};
use cstk::space::{Space, WorldBox};
use cstk::srdf::{SrdfOptions, SrdfReport};
use cstk::urdf::BaseJoint;

use crate::srdf_example::{SRDF, loaded, names, with};

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
