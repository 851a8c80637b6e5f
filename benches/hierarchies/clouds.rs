//! Bodies of points: what building them takes, and what asking them costs.

use std::process::Command;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;
use cstk_scenes as scenes;

use super::{builder_of, memory_kibibytes, peak_kibibytes};

/// A kind of cloud: its name, its points, and a radius that closes the gaps between them.
type Kind = (&'static str, fn(usize) -> Vec<Vec3>, fn(usize) -> f64);

const KINDS: [Kind; 8] = [
    ("random in a cube", random, spacing),
    ("random, no radius", random, |_| 0.0),
    ("seen by a camera", seen, seen_spacing),
    ("seen, no radius", seen, |_| 0.0),
    ("grid", grid, spacing),
    ("each ten times", repeated, spacing),
    ("on a line", on_a_line, |n| 1.0 / n as f64),
    ("all equal", |n| vec![Vec3::new(0.1, 0.2, 0.3); n], |_| 0.1),
];

const ONE_BY_ONE: &str = ", one by one";

pub fn print(quick: bool) {
    println!("### Clouds of points, default options\n");
    println!(
        "| cloud | points | levels | s | µs a point | bytes a point | peak, bytes a point | distance, µs | collision, µs |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    let sizes: &[usize] = match quick {
        true => &[10_000, 100_000],
        false => &[10_000, 100_000, 1_000_000],
    };
    for (name, ..) in KINDS {
        for &n in sizes {
            print_row(name, n, "");
        }
        // As shapes of their own the same balls are clustered, with wrappers, as any primitives are.
        print_row(name, 10_000, ONE_BY_ONE);
        if !quick {
            print_row(name, 100_000, ONE_BY_ONE);
        }
    }
    println!();
}

/// Builds a cloud in a process of its own.
fn print_row(name: &str, n: usize, way: &str) {
    let exe = std::env::current_exe().expect("the path of this program");
    let output = Command::new(exe)
        .args(["--build-cloud", &format!("{name}|{n}|{way}")])
        .output()
        .expect("this program runs");
    let text = String::from_utf8_lossy(&output.stdout);
    let numbers: Vec<f64> = text
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect();
    let [levels, seconds, bytes, peak, distance, collision] = numbers[..] else {
        let errors = String::from_utf8_lossy(&output.stderr);
        panic!("the build of {name} failed: {text}{errors}");
    };
    println!(
        "| {name}{way} | {n} | {levels} | {seconds:.4} | {:.2} | {:.0} | {:.0} | {distance:.2} | {collision:.2} |",
        seconds / n as f64 * 1e6,
        bytes / n as f64,
        peak / n as f64,
    );
}

/// The inner side of `print_row`: prints what it measured.
pub fn build_and_tell(request: &str) {
    let words: Vec<&str> = request.split('|').collect();
    let [name, n, way] = words[..] else {
        panic!("--build-cloud NAME|POINTS|WAY");
    };
    let n: usize = n.parse().expect("a number of points");
    let kind = KINDS.iter().find(|kind| kind.0 == name);
    let (_, points, radius) = kind.expect("a known cloud");
    let mut builder = BodyBuilder::new(3).expect("a builder");
    let points = points(n);
    let start = Instant::now();
    if way == ONE_BY_ONE {
        for (tag, point) in (0..).zip(&points) {
            builder.add_sphere(point, radius(n), tag).expect("a ball");
        }
    } else {
        builder.add_points(&points, radius(n)).expect("a cloud");
    }
    let adding = start.elapsed().as_secs_f64();
    drop(points);
    let mut seconds = Vec::new();
    let mut last: Vec<Body> = Vec::new();
    let mut peak = 0.0;
    for run in 0..if n > 100_000 { 3 } else { 5 } {
        last.clear();
        let before = memory_kibibytes("VmRSS:");
        let start = Instant::now();
        let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
        seconds.push(adding + start.elapsed().as_secs_f64());
        last.push(body.expect("a body"));
        if run == 0 {
            peak = peak_kibibytes() - before;
        }
    }
    seconds.sort_by(f64::total_cmp);
    let body = &last[0];
    let [distance, collision] = ask(body);
    println!(
        "{} {} {} {} {distance} {collision}",
        body.statistics().depth,
        seconds[seconds.len() / 2],
        body.tree_statistics().bytes,
        peak * 1024.0,
    );
}

/// Microseconds a query against a mesh of a tenth of the cloud's size, at random poses in and around the cloud.
fn ask(cloud: &Body) -> [f64; 2] {
    const QUERIES: usize = 500;
    let mut mesh = scenes::bumpy_sphere(1000, 1);
    for point in &mut mesh.vertices {
        *point = point.map(|x| 0.1 * x);
    }
    let mesh = builder_of(&mesh)
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .expect("a body");
    let mut random = Random(7);
    let poses: Vec<Pose> = (0..QUERIES)
        .map(|_| {
            let axis = random.point() + Vec3::new(0.0, 0.0, 1e-3);
            Pose {
                rotation: rotation_about(&axis.normalize(), 3.0 * random.next()),
                translation: 1.3 * random.point(),
            }
        })
        .collect();
    let still = Pose::identity();
    let mut best = [f64::INFINITY; 2];
    for _ in 0..3 {
        let mut query = QueryContext::new();
        let start = Instant::now();
        for pose in &poses {
            let found = query.pair_distance((&mesh, pose), (cloud, &still), f64::INFINITY);
            std::hint::black_box(found.expect("a distance"));
        }
        best[0] = best[0].min(start.elapsed().as_secs_f64());
        let start = Instant::now();
        for pose in &poses {
            let found = query.pair_within((&mesh, pose), (cloud, &still), 0.0);
            std::hint::black_box(found.expect("an answer"));
        }
        best[1] = best[1].min(start.elapsed().as_secs_f64());
    }
    best.map(|seconds| seconds / QUERIES as f64 * 1e6)
}

/// About half the distance between neighbours of n points that fill a cube of side 2.
fn spacing(n: usize) -> f64 {
    1.0 / (n as f64).cbrt()
}

/// The same of points on a surface.
fn seen_spacing(n: usize) -> f64 {
    1.0 / (n as f64).sqrt()
}

fn random(n: usize) -> Vec<Vec3> {
    let mut random = Random(1);
    (0..n).map(|_| random.point()).collect()
}

/// Rays of a camera above a table with things on it.
fn seen(n: usize) -> Vec<Vec3> {
    let side = (n as f64).sqrt().ceil() as usize;
    let mut random = Random(2);
    let ray = |k: usize| {
        let at = |i: usize| 2.0 * (i as f64 + 0.5) / side as f64 - 1.0;
        let (x, y) = (at(k % side), at(k / side));
        let thing = (0.3 - (x * 5.0).sin() * (y * 4.0).cos()).max(0.0);
        let depth = 2.0 - thing.min(0.6) + 2e-3 * random.next();
        Vec3::new(0.5 * x * depth, 0.5 * y * depth, 1.5 - depth)
    };
    (0..n).map(ray).collect()
}

fn grid(n: usize) -> Vec<Vec3> {
    let side = (n as f64).cbrt().ceil() as usize;
    let at = |i: usize| 2.0 * i as f64 / side as f64 - 1.0;
    let node = |k: usize| Vec3::new(at(k % side), at(k / side % side), at(k / side / side));
    (0..n).map(node).collect()
}

fn repeated(n: usize) -> Vec<Vec3> {
    let once = random(n.div_ceil(10));
    (0..n).map(|i| once[i % once.len()]).collect()
}

fn on_a_line(n: usize) -> Vec<Vec3> {
    let along = Vec3::new(1.0, 0.7, -0.4);
    let at = |i: usize| along * (2.0 * i as f64 / n as f64 - 1.0);
    (0..n).map(at).collect()
}

/// SplitMix64.
struct Random(u64);

impl Random {
    /// From -1 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}
