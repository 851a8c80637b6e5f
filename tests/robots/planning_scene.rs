//! MoveIt's planning scenes, written here: both versions of the text, every shape, and what is refused.

use cstk::body::{BodyBuilder, MeshForm};
use cstk::error::ErrorKind;
use cstk::planning_scene::{SceneObject, SceneOptions, read_scene_text};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

const POSE: &str = "0 0 0\n0 0 0 1\n0 0 0 0\n";

const NEW: &str = "kitchen table++\n\
    * the table top\n1 2 3\n0 0 0.70711 0.70711\n2\n\
    box\n4 2 0.5\n0 0 0\n0 0 0 1\n0.5 0.5 0.5 1\n\
    cylinder\n0.25 2\n1 0 -1.25\n0 0 0 1\n0 0 0 0\n\
    1\nhandle 0 0 0 0 0 0 1\n\
    * ball\n0 0 10\n0 0 0 1\n1\nsphere\n0.5\n0 0 1\n0 0 0 1\n0 0 0 0\n0\n\
    * hat\n10 0 0\n0 0 0 1\n1\ncone\n1 2\n0 0 0\n0 0 0 1\n0 0 0 0\n0\n\
    * wedge\n0 10 0\n0 0 0 1\n1\nmesh\n4 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 2 1\n0 1 3\n0 3 2\n1 2 3\n1 0 0\n0 0 0 1\n0 0 0 0\n0\n\
    .\n";

const OLD: &str = "(noname)\n* post\n1\nbox\n1 1 2\n5 0 1\n0 0 0 1\n0 0 0 0\n* other\n1\nsphere\n1\n-5 0 0\n0 0 0 1\n0 0 0 0\n.\n";

/// The distance of a point of the world.
fn distance(object: &SceneObject, at: [f64; 3]) -> f64 {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&[Vec3::zeros()], 0).unwrap();
    let point = helpers::models::built(&builder, &Default::default());
    let there = Pose::from_translation(Vec3::from(at));
    let found = QueryContext::new().pair_distance(
        (&object.body, &object.pose),
        (&point, &there),
        f64::INFINITY,
    );
    found.unwrap().distance
}

#[test]
fn shapes_stand_where_the_text_says() {
    let objects = read_scene_text(NEW, &SceneOptions::default()).unwrap();
    let names: Vec<&str> = objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["the table top", "ball", "hat", "wedge"]);
    let near = |i: usize, at: [f64; 3], expected: f64| {
        let found = distance(&objects[i], at);
        assert!(
            (found - expected).abs() < 1e-5,
            "{i} {at:?}: {found}, not {expected}"
        );
    };
    // A quarter turn: the top is 2 by 4 around (1, 2, 3); its leg, from -2.25 to -0.25 of it, stands at (1, 3).
    near(0, [3.0, 2.0, 3.0], 1.0);
    near(0, [1.0, 6.0, 3.0], 2.0);
    near(0, [1.0, 3.0, 0.0], 0.75);
    near(0, [1.0, 3.0, 4.25], 1.0);
    near(1, [0.0, 0.0, 13.0], 1.5);
    // The cone's base is at -1, its apex at 1.
    near(2, [10.0, 0.0, 3.0], 2.0);
    near(2, [10.0, 0.0, -2.0], 1.0);
    near(2, [13.0, 0.0, -1.0], 2.0);
    near(3, [0.0, 10.2, 0.2], 1.0);
    // Surfaces, unless they are asked to be solid.
    let within = [1.2, 10.2, 0.2];
    near(3, within, 0.2);
    for form in [MeshForm::Solid, MeshForm::Hull] {
        let options = SceneOptions {
            at: Pose::from_translation(Vec3::new(0.0, -10.0, 0.0)),
            form,
            ..Default::default()
        };
        let moved = read_scene_text(NEW, &options).unwrap();
        assert_eq!(distance(&moved[3], [1.2, 0.2, 0.2]), 0.0);
        assert!((distance(&moved[3], [0.0, 0.2, 0.2]) - 1.0).abs() < 1e-12);
    }
    let old = read_scene_text(OLD, &SceneOptions::default()).unwrap();
    assert!((distance(&old[0], [5.0, 0.0, 4.0]) - 2.0).abs() < 1e-12);
    assert!((distance(&old[1], [-5.0, 3.0, 0.0]) - 2.0).abs() < 1e-12);
    assert!(
        read_scene_text("empty\n.\n", &SceneOptions::default())
            .unwrap()
            .is_empty()
    );
}

#[test]
fn faults_are_named_with_line_and_object() {
    use ErrorKind::{
        Empty, InvalidArgument, NotARotation, NotFinite, NotFound, Parse, Unsupported,
    };
    let object = |rest: &str| format!("s\n* a\n1\n{rest}");
    let mesh = |rest: &str| object(&format!("mesh\n{rest}"));
    let many = format!(
        "s\n* a\n200000\n{}.\n",
        format!("sphere\n1\n{POSE}").repeat(200_000)
    );
    for (text, kind, culprits) in [
        (String::new(), Parse, vec!["the file ends"]),
        ("s".into(), Parse, vec!["the file ends"]),
        ("s\nbox 1 1 1".into(), Parse, vec!["line 2", "\"box\""]),
        (
            object(&format!("box\n1 1 1\n{POSE}")),
            Parse,
            vec!["the file ends", "* or ."],
        ),
        (
            object("box\n1 1"),
            Parse,
            vec!["\"a\"", "shape 0", "the file ends", "sizes"],
        ),
        (
            object("box\n1 x 1\n"),
            Parse,
            vec!["line 5", "\"a\"", "\"x\""],
        ),
        (object("box\n1 nan 1\n"), NotFinite, vec!["line 5", "sizes"]),
        (
            object("box\n1 nan\n1\n"),
            NotFinite,
            vec!["line 5", "sizes"],
        ),
        ("s\n* a\0b\n0\n.".into(), Parse, vec!["line 2", "NUL"]),
        (
            object("box\n1 1e99 1\n"),
            InvalidArgument,
            vec!["line 5", "too large"],
        ),
        (
            object(&format!("box\n1 -1 1\n{POSE}.")),
            InvalidArgument,
            vec!["\"a\""],
        ),
        (
            object(&format!("sphere\n-1\n{POSE}.")),
            InvalidArgument,
            vec!["\"a\"", "radius"],
        ),
        (
            object("sphere\n1\n0 0 0\n0 0 0 2\n"),
            NotARotation,
            vec!["line 7", "\"a\"", "norm"],
        ),
        (
            object("plane\n0 0 1 0\n"),
            Unsupported,
            vec!["line 4", "\"a\"", "plane"],
        ),
        (
            object("octomap\n"),
            Unsupported,
            vec!["line 4", "\"octomap\""],
        ),
        ("s\n* a\n0\n.".into(), Empty, vec!["line 3", "\"a\""]),
        ("s\n* a\n-1\n.".into(), Parse, vec!["line 3", "\"-1\""]),
        (
            format!("{}* post\n1\n.", OLD.strip_suffix(".\n").unwrap()),
            InvalidArgument,
            vec!["line 16", "\"post\""],
        ),
        (
            "s\n* a\n99999999999999999999\n".into(),
            Parse,
            vec!["line 3"],
        ),
        (
            "s\n* a\n100000000000\nsphere\n1\n".into(),
            Unsupported,
            vec!["line 3", "131072 shapes"],
        ),
        (many, Unsupported, vec!["131072 shapes"]),
        (
            mesh("4000000000 1\n0 0 0\n"),
            Parse,
            vec!["the file ends", "vertex"],
        ),
        (
            mesh("3 4000000000\n0 0 0\n"),
            Unsupported,
            vec!["line 5", "4000000000 faces"],
        ),
        (
            mesh("3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 3\n"),
            NotFound,
            vec!["line 9", "vertex 3"],
        ),
        (
            mesh(&format!("1 0\n0 0 0\n{POSE}.")),
            Empty,
            vec!["\"a\"", "no primitive"],
        ),
    ] {
        let error = read_scene_text(&text, &SceneOptions::default()).err();
        let short: String = text.chars().take(80).collect();
        let error = error.unwrap_or_else(|| panic!("{short} was accepted"));
        assert_eq!(error.kind, kind, "{short}: {error}");
        for culprit in culprits {
            assert!(
                error.message.contains(culprit),
                "{error} names no {culprit}"
            );
        }
    }
    // Cut anywhere, it is refused.
    for text in [NEW, OLD] {
        for end in 0..text.len() - 2 {
            assert!(
                read_scene_text(&text[..end], &SceneOptions::default()).is_err(),
                "{end}"
            );
        }
    }
}
