//! Boxes of C-space: what a proof takes, and how large grown boxes are beside balls of distance over speed.
//!
//!     cargo run --release --example regions

use std::f64::consts::PI;
use std::sync::Arc;
use std::time::Instant;

use cstk::cobject::{CObject, Class};
use cstk::motion::{GrowthOptions, RegionOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

/// An arm of 6 joints, 1.3 long, whose links are boxes.
fn arm() -> Arc<Space> {
    let lengths = [0.2, 0.4, 0.35, 0.1, 0.15, 0.1];
    let axes = [
        Vec3::z(),
        Vec3::y(),
        Vec3::y(),
        Vec3::z(),
        Vec3::y(),
        Vec3::z(),
    ];
    let mut links = Vec::new();
    let mut height = 0.0;
    let mut parent = None;
    for (length, axis) in lengths.into_iter().zip(axes) {
        links.push(LinkDefinition {
            at: Pose::from_translation(Vec3::new(0.0, 0.0, height)),
            ..link(parent, JointKind::Revolute, axis)
        });
        let joint = links.len() - 1;
        links.push(LinkDefinition {
            at: Pose::from_translation(Vec3::new(0.0, 0.0, 0.5 * length)),
            body: Some(cuboid([0.08, 0.08, length]).body),
            ..link(Some(joint), JointKind::Fixed, Vec3::z())
        });
        height = length;
        parent = Some(joint);
    }
    space(vec![robot(3, links)])
}

/// The arm among boxes that leave its base alone.
fn cell(random: &mut Random, space: &Arc<Space>, count: usize) -> CObject {
    let mut objects = Vec::new();
    while objects.len() < count {
        let pose = random.pose(1.2);
        let t = pose.translation;
        if t.xy().norm() > 0.45 {
            let sides = [(); 3].map(|()| random.within(0.05, 0.3));
            objects.push((cuboid(sides).body, pose));
        }
    }
    let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
    against(space, &environment(&objects).0)
}

/// Free configurations, a third of them less than 5 cm from contact.
fn free_configurations(
    random: &mut Random,
    context: &mut QueryContext,
    set: &CObject,
    count: usize,
) -> Vec<(Vec<f64>, f64)> {
    let mut found = Vec::new();
    while found.len() < count {
        let q: Vec<f64> = (0..set.space().nq())
            .map(|_| random.within(-2.0, 2.0))
            .collect();
        let at = Configuration::Coordinates(&q);
        if context.classify(set, at).unwrap() == Class::Inside {
            continue;
        }
        let distance = context.distance(set, at, f64::INFINITY).unwrap().lower;
        if distance < 0.05 || found.len() % 3 != 0 {
            found.push((q, distance));
        }
    }
    found
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let mut random = Random::new(1);
    let space = arm();
    let nv = space.nv();
    let set = cell(&mut random, &space, 40);
    let context = &mut QueryContext::new();
    let configurations = free_configurations(&mut random, context, &set, 60);

    println!("An arm of 6 joints among 40 boxes.\n");
    println!("Boxes around free configurations, at most 1000 parts:\n");
    println!("| half side | free | mixed | undecided | median µs | mean µs |");
    println!("| --- | --- | --- | --- | --- | --- |");
    for half in [0.01, 0.02, 0.05, 0.1, 0.2] {
        let mut outcomes = [0usize; 4];
        let mut times = Vec::new();
        for (q, _) in &configurations {
            let [low, high] = [-half, half].map(|h| q.iter().map(|x| x + h).collect::<Vec<_>>());
            let start = Instant::now();
            let options = RegionOptions::default();
            let answer = context.classify_region(&set, &low, &high, &options);
            times.push(1e6 * start.elapsed().as_secs_f64());
            outcomes[answer.unwrap().outcome as usize] += 1;
        }
        let mean = times.iter().sum::<f64>() / times.len() as f64;
        println!(
            "| {half} | {} | {} | {} | {:.0} | {mean:.0} |",
            outcomes[0],
            outcomes[2],
            outcomes[3],
            median(&mut times)
        );
    }

    println!(
        "\nGrown boxes, and their volume over that of regions by one distance d, where joint i moves points by at most s_i:\n"
    );
    println!(
        "| tolerance | parts | median ms | over the ball | least | over the cross-polytope | least |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for (tolerance, max_boxes) in [(0.02, 50), (0.01, 200), (0.005, 1000)] {
        let options = GrowthOptions {
            tolerance,
            max_boxes,
            max_side: PI,
        };
        let mut times = Vec::new();
        let mut over_ball = Vec::new();
        let mut over_polytope = Vec::new();
        for (q, distance) in &configurations {
            let start = Instant::now();
            let grown = context.grow_region(&set, q, None, &options).unwrap();
            times.push(1e3 * start.elapsed().as_secs_f64());
            let sides = grown.low.iter().zip(&grown.high).map(|(l, h)| h - l);
            let volume: f64 = sides.product();
            let speeds: Vec<f64> = (0..nv)
                .map(|k| {
                    let mut v = vec![0.0; nv];
                    v[k] = 1.0;
                    let of_link = |link| space.motion_bound(link, q, &v);
                    (0..space.link_count()).map(of_link).fold(0.0, f64::max)
                })
                .collect();
            // All configurations as far as the distance over the largest speed that a unit of C-space can have.
            let fastest = speeds.iter().map(|s| s * s).sum::<f64>().sqrt();
            let ball = PI.powi(3) / 6.0 * (distance / fastest).powi(6);
            // All whose sum of |step_i| s_i is at most the distance.
            let product: f64 = speeds.iter().product();
            let polytope = (2.0 * distance).powi(6) / 720.0 / product;
            over_ball.push(volume / ball);
            over_polytope.push(volume / polytope);
        }
        let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        println!(
            "| {tolerance} | {max_boxes} | {:.1} | {:.3e} | {:.3e} | {:.3e} | {:.3e} |",
            median(&mut times),
            median(&mut over_ball),
            least(&over_ball),
            median(&mut over_polytope),
            least(&over_polytope)
        );
    }
}
