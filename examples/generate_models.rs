//! Writes the models of the examples to models/: three links of a Puma-like arm in the frames of the report's Appendix A,
//! and a faceted cylinder. `cargo run --example generate_models -- --check` only compares.
//!
//! The arm's joints 0, 1 and 2 sit at the origins of links 0, 1 and 2 and turn about their z axes; lengths are those of
//! the appendix (shoulder offset 2.875, upper arm 6.5, elbow offset -2.125).

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

type Point = [f64; 3];

/// A polygon mesh in the making.
#[derive(Default)]
struct Model {
    vertices: Vec<Point>,
    faces: Vec<Vec<usize>>,
}

/// Which axis a prism's outline is swept along; the outline's x and y are the next two axes.
#[derive(Clone, Copy)]
enum Along {
    X = 0,
    Y = 1,
    Z = 2,
}

impl Model {
    /// A convex outline (counter-clockwise) swept from one height to another, with its caps.
    fn prism(mut self, outline: &[[f64; 2]], along: Along, from: f64, to: f64) -> Self {
        let first = self.vertices.len();
        let n = outline.len();
        let axis = along as usize;
        for height in [from, to] {
            for [u, v] in outline {
                let mut point = [0.0; 3];
                point[axis] = height;
                point[(axis + 1) % 3] = *u;
                point[(axis + 2) % 3] = *v;
                self.vertices.push(point);
            }
        }
        self.faces.push((0..n).rev().map(|i| first + i).collect());
        self.faces.push((0..n).map(|i| first + n + i).collect());
        for i in 0..n {
            let j = (i + 1) % n;
            self.faces
                .push(vec![first + i, first + j, first + n + j, first + n + i]);
        }
        self
    }

    fn to_obj(&self, title: &str) -> String {
        let mut text = format!("# {title}; written by examples/generate_models.rs\n");
        // Rounded, so that the last digits of the machine's sine do not show.
        let round = |x: f64| (x * 1e9).round() / 1e9;
        for point in &self.vertices {
            let [x, y, z] = point.map(round);
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        for face in &self.faces {
            let indices: Vec<String> = face.iter().map(|i| (i + 1).to_string()).collect();
            writeln!(text, "f {}", indices.join(" ")).unwrap();
        }
        text
    }
}

fn circle(center: [f64; 2], radius: f64, sides: usize) -> Vec<[f64; 2]> {
    (0..sides)
        .map(|i| {
            let angle = TAU * (i as f64 + 0.5) / sides as f64;
            [
                center[0] + radius * angle.cos(),
                center[1] + radius * angle.sin(),
            ]
        })
        .collect()
}

/// The outline around two circles on the x axis, at 0 and at `length`: a tapered bar with round ends.
fn tapered_bar(radius_0: f64, length: f64, radius_1: f64, arc: usize) -> Vec<[f64; 2]> {
    // The common tangents touch both circles at this angle from the x axis.
    let tangent = ((radius_0 - radius_1) / length).acos();
    let end = |x: f64, radius: f64, from: f64, to: f64| {
        (0..=arc).map(move |i| {
            let angle = from + (to - from) * i as f64 / arc as f64;
            [x + radius * angle.cos(), radius * angle.sin()]
        })
    };
    end(length, radius_1, -tangent, tangent)
        .chain(end(0.0, radius_0, tangent, TAU - tangent))
        .collect()
}

fn models() -> Vec<(&'static str, &'static str, Model)> {
    // Link 0 turns about the vertical z: a trunk around the axis and the shoulder's drum along y.
    let shoulder = Model::default()
        .prism(&circle([0.0, 0.0], 1.3, 24), Along::Z, -3.0, -0.9)
        .prism(&circle([0.0, 0.0], 1.1, 24), Along::Y, -1.4, 2.7)
        .prism(&circle([0.0, 0.0], 0.8, 20), Along::Y, -1.9, -1.4);
    // Link 1 turns about its z, which is the world's -y at rest: the upper arm, along x.
    let upper_arm = Model::default()
        .prism(&tapered_bar(1.25, 6.5, 0.9, 10), Along::Z, -1.9, -0.1)
        .prism(&circle([-1.6, 0.0], 0.55, 14), Along::Z, -1.6, -0.4)
        .prism(&circle([0.0, 0.0], 1.0, 20), Along::Z, -0.1, 0.1);
    // Link 2 turns about its z, parallel to that of link 1: the forearm with its wrist.
    let forearm = Model::default()
        .prism(&tapered_bar(0.9, 5.2, 0.5, 8), Along::Z, -1.45, -0.15)
        .prism(&circle([0.0, 0.0], 0.7, 16), Along::Z, -0.15, 0.15)
        .prism(&circle([0.0, -0.8], 0.42, 16), Along::X, 5.2, 6.4)
        .prism(&circle([0.0, -0.8], 0.25, 12), Along::X, 6.4, 6.9);
    let cylinder = Model::default().prism(&circle([0.0, 0.0], 1.5, 32), Along::Z, -6.0, 6.0);
    vec![
        ("puma_shoulder.obj", "link 0 of the Puma-like arm", shoulder),
        (
            "puma_upper_arm.obj",
            "link 1 of the Puma-like arm",
            upper_arm,
        ),
        ("puma_forearm.obj", "link 2 of the Puma-like arm", forearm),
        (
            "cylinder.obj",
            "a cylinder of length 12 and radius 1.5 along z, 32 sides",
            cylinder,
        ),
    ]
}

fn main() {
    let check = std::env::args().any(|argument| argument == "--check");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    for (name, title, model) in models() {
        let text = model.to_obj(title);
        let path = folder.join(name);
        if check {
            let committed = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(
                committed == text,
                "models/{name} is not what examples/generate_models.rs writes"
            );
        } else {
            std::fs::write(&path, text).unwrap();
        }
        println!("{name}: {} polygons", model.faces.len());
    }
}
