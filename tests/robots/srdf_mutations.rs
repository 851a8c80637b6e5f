//! No text leads to a fault: SRDF files with random changes.

use cstk::robot::{Robot, RobotBuilder};
use cstk::srdf::{SrdfOptions, add_srdf_file, add_srdf_text};
use cstk::urdf::{BaseJoint, UrdfOptions, add_urdf_text};

use helpers::random::Random;

use crate::srdf_example::{SRDF, urdf};

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
