//! How the time of what users build grows with its size: each case at n, 2 n and 4 n. What takes n log n time shows factors
//! a little above 2; a factor of 4 is quadratic.
//!
//! `cargo run --release --example growth [NAME...]` measures the cases whose names begin with one of the arguments.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::cobject::{CObject, InducedOptions, LeftOut, PureOptions, PureShape, SObjects};
use cstk::environment::{Attachment, Change, Environment};
use cstk::pose::{Pose, Vec3};
use cstk::primitive::{convex_polyhedron, split_face};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition, Robot, RobotBuilder};
use cstk::space::{Space, WorldBox};
use cstk::urdf::{UrdfOptions, add_urdf_file};

/// A case: its name, the smallest size, and what is measured at a size, in seconds.
type Case = (&'static str, usize, fn(usize) -> f64);

const CASES: &[Case] = &[
    ("links_added", 20_000, links_added),
    ("links_found", 20_000, links_found),
    ("followers_added", 10_000, followers_added),
    ("urdf_chain", 10_000, urdf_chain),
    ("urdf_mimics", 5_000, urdf_mimics),
    ("union_grown", 5_000, |n| grown(n, CObject::union)),
    ("intersection_grown", 5_000, |n| {
        grown(n, CObject::intersection)
    }),
    ("union_of_environments", 1_000, union_of_environments),
    ("objects_attached", 10_000, objects_attached),
    ("space_of_robots", 10_000, space_of_robots),
    ("hull_of_sphere", 10_000, |n| hull(&sphere(n))),
    ("hull_of_two_shells", 10_000, |n| hull(&two_shells(n))),
    ("hull_of_ball", 20_000, |n| hull(&ball(n))),
    ("hull_of_grid", 20_000, |n| hull(&grid(n))),
    ("hull_of_drum", 10_000, |n| hull(&drum(n))),
    ("scraps_of_an_edge", 20_000, scraps_of_an_edge),
    ("outline_of_a_face", 2_000, outline_of_a_face),
];

fn main() {
    let chosen: Vec<String> = std::env::args().skip(1).collect();
    println!("| case | n | s at n | at 2 n | at 4 n | factors |");
    println!("| --- | --- | --- | --- | --- | --- |");
    for (name, n, measure) in CASES {
        if !chosen.is_empty() && !chosen.iter().any(|start| name.starts_with(&**start)) {
            continue;
        }
        let [one, two, four] = [1, 2, 4].map(|times| measure(times * n));
        println!(
            "| {name} | {n} | {one:.4} | {two:.4} | {four:.4} | {:.1}, {:.1} |",
            two / one,
            four / two
        );
    }
}

fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}

fn links_added(n: usize) -> f64 {
    let names: Vec<String> = (0..n).map(|i| format!("a_link_with_number_{i}")).collect();
    seconds(|| chain(&names))
}

fn links_found(n: usize) -> f64 {
    let names: Vec<String> = (0..n).map(|i| format!("a_link_with_number_{i}")).collect();
    let robot = chain(&names).build().unwrap();
    seconds(|| {
        names
            .iter()
            .rev()
            .all(|name| robot.find_link(name).is_some())
    })
}

fn chain(names: &[String]) -> RobotBuilder {
    let mut builder = RobotBuilder::new(3).unwrap();
    for (i, name) in names.iter().enumerate() {
        let link = LinkDefinition {
            name: name.clone(),
            joint_name: format!("joint of {name}"),
            parent: i.checked_sub(1),
            kind: JointKind::Revolute,
            ..LinkDefinition::default()
        };
        builder.add_link(link).unwrap();
    }
    builder
}

/// As many joints of their own, and one more that follows each.
fn followers_added(n: usize) -> f64 {
    let mut builder = RobotBuilder::new(3).unwrap();
    seconds(|| {
        for i in 0..2 * n {
            let link = LinkDefinition {
                kind: JointKind::Prismatic,
                coordinate: (i >= n).then(|| i - n),
                ..LinkDefinition::default()
            };
            builder.add_link(link).unwrap();
        }
    })
}

fn urdf_chain(n: usize) -> f64 {
    urdf(n, |_| String::new())
}

/// Each joint mimics the one before.
fn urdf_mimics(n: usize) -> f64 {
    urdf(n, |i| match i {
        1 => String::new(),
        _ => format!("<mimic joint=\"j{}\" multiplier=\"0.5\"/>", i - 1),
    })
}

fn urdf(n: usize, mimic: impl Fn(usize) -> String) -> f64 {
    let mut text = String::from("<robot name=\"chain\"><link name=\"l0\"/>");
    for i in 1..n {
        let (parent, mimic) = (i - 1, mimic(i));
        write!(
            text,
            "<link name=\"l{i}\"/>\n<joint name=\"j{i}\" type=\"continuous\"><parent link=\"l{parent}\"/>\
             <child link=\"l{i}\"/>{mimic}</joint>"
        )
        .unwrap();
    }
    text.push_str("</robot>");
    let file = std::env::temp_dir().join(format!("cstk_growth_{}.urdf", std::process::id()));
    std::fs::write(&file, text).unwrap();
    let mut builder = RobotBuilder::new(3).unwrap();
    let options = UrdfOptions::default();
    let taken = seconds(|| add_urdf_file(&mut builder, &file, &options, &mut |_| Ok(())).unwrap());
    std::fs::remove_file(&file).unwrap();
    taken
}

fn cube() -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    let half = Vec3::repeat(0.5);
    builder.add_box(&Pose::identity(), &half, 0).unwrap();
    Arc::new(builder.build(&Default::default(), &mut |_| Ok(())).unwrap())
}

/// A space of robots of one link each, which has a body.
fn robots(count: usize) -> Arc<Space> {
    let mut builder = RobotBuilder::new(3).unwrap();
    let link = LinkDefinition {
        body: Some(cube()),
        kind: JointKind::Prismatic,
        ..LinkDefinition::default()
    };
    builder.add_link(link).unwrap();
    let robots: Vec<Arc<Robot>> = (0..count)
        .map(|_| Arc::new(builder.build().unwrap()))
        .collect();
    Arc::new(Space::new(robots, &[], WorldBox::unbounded()).unwrap())
}

fn at(x: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, 0.0, 0.0))
}

/// One set after the other joined to what is there, and a query of the whole.
fn grown(n: usize, join: fn(&[Arc<CObject>]) -> cstk::error::Result<CObject>) -> f64 {
    let space = robots(1);
    let ball = |i: usize| {
        let (center, radius) = (vec![i as f64], 0.5);
        let shape = PureShape::Ball { center, radius };
        Arc::new(CObject::pure(space.clone(), shape, PureOptions::default()).unwrap())
    };
    let balls: Vec<_> = (0..n).map(ball).collect();
    let mut context = QueryContext::new();
    seconds(|| {
        let mut all = balls[0].clone();
        for ball in &balls[1..] {
            all = Arc::new(join(&[all, ball.clone()]).unwrap());
        }
        let q = Configuration::Coordinates(&[-1.0]);
        context.classify(&all, q).unwrap()
    })
}

/// Each term has an environment of its own, with one object that the link holds and one that it does not.
fn union_of_environments(n: usize) -> f64 {
    let space = robots(1);
    let body = cube();
    let term = |i: usize| {
        let environment = Arc::new(Environment::default());
        let add = |x: f64| Change::add(body.clone(), at(x));
        let (ids, _) = environment
            .apply(&[add(2.0), add(10.0 + i as f64)])
            .unwrap();
        let attach = Change::Attach {
            id: ids[0],
            pose: at(1.5),
            attachment: Attachment::new(&space, 0, &[]).unwrap(),
        };
        environment.apply(&[attach]).unwrap();
        let objects = SObjects::All(environment);
        let options = InducedOptions::default();
        Arc::new(
            CObject::induced(space.clone(), &[], objects, LeftOut::default(), options).unwrap(),
        )
    };
    let terms: Vec<_> = (0..n).map(term).collect();
    let all = CObject::union(&terms).unwrap();
    let mut context = QueryContext::new();
    let mut ask = || {
        let q = Configuration::Coordinates(&[0.0]);
        context.classify(&all, q).unwrap()
    };
    ask();
    seconds(ask)
}

/// One change each.
fn objects_attached(n: usize) -> f64 {
    let space = robots(1);
    let body = cube();
    let environment = Environment::default();
    let add = |i: usize| Change::add(body.clone(), at(i as f64));
    let (ids, _) = environment
        .apply(&(0..n).map(add).collect::<Vec<_>>())
        .unwrap();
    seconds(|| {
        for &id in ids.iter().rev() {
            let attach = Change::Attach {
                id,
                pose: at(1.5),
                attachment: Attachment::new(&space, 0, &[]).unwrap(),
            };
            environment.apply(&[attach]).unwrap();
        }
    })
}

fn space_of_robots(n: usize) -> f64 {
    seconds(|| {
        let space = robots(n);
        space.link_poses(&space.neutral()).unwrap().len()
    })
}

fn hull(points: &[Vec3]) -> f64 {
    seconds(|| convex_polyhedron(points).unwrap())
}

/// Points of the unit sphere, evenly spread.
fn sphere(n: usize) -> Vec<Vec3> {
    let golden = TAU * (1.0 - 0.5 * (5f64.sqrt() - 1.0));
    (0..n)
        .map(|i| {
            let z = 1.0 - (2 * i + 1) as f64 / n as f64;
            let (sin, cos) = (golden * i as f64).sin_cos();
            let across = (1.0 - z * z).sqrt();
            Vec3::new(across * cos, across * sin, z)
        })
        .collect()
}

/// Half of the points on a sphere, half just below it.
fn two_shells(n: usize) -> Vec<Vec3> {
    let mut points = sphere(n / 2);
    let below: Vec<Vec3> = points.iter().map(|p| p * (1.0 - 1e-3)).collect();
    points.extend(below);
    points
}

fn ball(n: usize) -> Vec<Vec3> {
    let radius = |i: usize| ((i * 7919 % n) as f64 / n as f64).cbrt();
    let points = sphere(n).into_iter().enumerate();
    points.map(|(i, p)| p * radius(i)).collect()
}

/// A grid on the six faces of a cube.
fn grid(n: usize) -> Vec<Vec3> {
    let side = (n as f64 / 6.0).sqrt() as usize;
    let mut points = Vec::new();
    for axis in 0..3 {
        for face in [-1.0, 1.0] {
            for i in 0..side * side {
                let place = |k: usize| 2.0 * k as f64 / (side - 1) as f64 - 1.0;
                let mut point = Vec3::zeros();
                point[axis] = face;
                point[(axis + 1) % 3] = place(i % side);
                point[(axis + 2) % 3] = place(i / side);
                points.push(point);
            }
        }
    }
    points
}

/// The rims of a drum.
fn drum(n: usize) -> Vec<Vec3> {
    let place = |i: usize| {
        let (sin, cos) = (TAU * (i / 2) as f64 / (n / 2) as f64).sin_cos();
        Vec3::new(cos, sin, (i % 2) as f64)
    };
    (0..n).map(place).collect()
}

/// A cube, and faces without area that all run along one of its edges, in pairs.
fn scraps_of_an_edge(n: usize) -> f64 {
    let corner = |i: usize| Vec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
    let mut mesh = Mesh {
        vertices: (0..8).map(corner).collect(),
        face_sizes: vec![4; 6],
        indices: vec![
            0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5,
        ],
    };
    for i in 0..n as u32 {
        if i % 2 == 0 {
            let beyond = Vec3::new(2.0 + f64::from(i), 0.0, 0.0);
            mesh.vertices.push(beyond);
        }
        mesh.face_sizes.push(3);
        mesh.indices.extend([0, 1, 8 + i / 2]);
    }
    // Half of an edge is left to the scraps to close.
    mesh.face_sizes.push(3);
    mesh.indices.extend([0, 1, 8]);
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.set_solid(true);
    seconds(|| {
        builder.add_mesh(&mesh).unwrap();
        builder.build(&Default::default(), &mut |_| Ok(())).is_ok()
    })
}

/// A star, which has to be split into triangles.
fn outline_of_a_face(n: usize) -> f64 {
    let place = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
        Vec3::new(cos, sin, 0.0) * [1.0, 0.9][i % 2]
    };
    let outline: Vec<Vec3> = (0..n).map(place).collect();
    seconds(|| split_face(&outline).unwrap())
}
