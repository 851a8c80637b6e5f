//! Gradients of every contact mode and every joint (§4.4) against central differences, from ten times the pair's size down
//! to a millionth of it; at exact contact against the one-sided limit; and just inside. Ten thousand cases each.
//!
//! A case is made backwards: a feature of each body with a direction that belongs to it alone is chosen, the bodies are placed
//! so that the two face each other at a given distance, and a joint at a random configuration is put where it holds the one
//! body so.

use std::collections::BTreeMap;
use std::sync::Arc;

use cstk::cobject::{CObject, InducedOptions};
use cstk::convex::ContactMode;
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::primitive::{Convex, Feature};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::facing::{facing, supported};
use helpers::oracle::gap_along;
use helpers::random::Random;
use helpers::robots::{Screw, against, environment, link, robot, space};
use helpers::shapes::{Shape, hull, planar};

/// What faces what, and whether the direction at contact is the features' alone.
const MODES: [(ContactMode, [char; 2], bool); 6] = [
    (ContactMode::PointPoint, ['v', 'v'], false),
    (ContactMode::PointEdge, ['v', 'e'], false),
    (ContactMode::EdgePoint, ['e', 'v'], false),
    (ContactMode::PointFace, ['v', 'f'], true),
    (ContactMode::FacePoint, ['f', 'v'], true),
    (ContactMode::EdgeEdge, ['e', 'e'], true),
];

const PLANAR_MODES: [(ContactMode, [char; 2], bool); 3] = [
    (ContactMode::PointPoint, ['v', 'v'], false),
    (ContactMode::PointEdge, ['v', 'e'], true),
    (ContactMode::EdgePoint, ['e', 'v'], true),
];

fn joints(planar: bool) -> Vec<(&'static str, JointKind)> {
    let mut found = vec![
        ("revolute", JointKind::Revolute),
        ("prismatic", JointKind::Prismatic),
        ("planar", JointKind::Planar),
    ];
    if !planar {
        found.extend([
            ("spherical", JointKind::Spherical),
            ("free", JointKind::Free),
            ("free by angles", JointKind::FreeEuler),
            ("custom", JointKind::Custom(Arc::new(Screw))),
        ]);
    }
    found
}

struct Case {
    cobject: CObject,
    q: Vec<f64>,
    /// Both bodies' vertices in the world, and the normal from s to r.
    sides: [Vec<Vec3>; 2],
    normal: Vec3,
    mode: ContactMode,
    is_smooth: bool,
}

/// A link at `pose` by a joint at a random configuration, on a carrier that moves too; with the carrier's joint sharing its
/// coordinate where both have one.
fn held(
    kind: &JointKind,
    pose: &Pose,
    body: &Shape,
    planar: bool,
    random: &mut Random,
) -> (Vec<LinkDefinition>, Vec<f64>) {
    let axis = if !planar {
        random.point(1.0)
    } else if matches!(kind, JointKind::Revolute) {
        Vec3::z()
    } else {
        Vec3::new(random.within(-1.0, 1.0), 1.0, 0.0)
    };
    let some_pose = |random: &mut Random| {
        if planar {
            random.planar_pose(1.0)
        } else {
            random.pose(1.0)
        }
    };
    let carrier = LinkDefinition {
        at: some_pose(random),
        ..link(None, JointKind::Revolute, Vec3::z())
    };
    let mut definition = LinkDefinition {
        at: some_pose(random),
        body: Some(body.body.clone()),
        ..link(Some(0), kind.clone(), axis)
    };
    if kind.has_axis() && random.below(3) == 0 {
        definition.coordinate = Some(0);
        definition.multiplier = random.within(-2.0, 2.0);
        definition.offset = random.within(-1.0, 1.0);
    }
    let dimension = if planar { 2 } else { 3 };
    let loose = space(vec![robot(
        dimension,
        vec![carrier.clone(), definition.clone()],
    )]);
    let v: Vec<f64> = (0..loose.nv()).map(|_| random.within(-1.2, 1.2)).collect();
    let q = loose.step(&loose.neutral(), &v);
    // Where the joint has to sit for the link to stand at `pose`.
    let poses = loose.link_poses(&q).unwrap();
    let motion = poses[0]
        .compose(&definition.at)
        .inverse()
        .compose(&poses[1]);
    definition.at = poses[0].inverse().compose(pose).compose(&motion.inverse());
    if planar {
        definition.at = flat(&definition.at);
    }
    (vec![carrier, definition], q)
}

/// Exactly in the plane.
fn flat(pose: &Pose) -> Pose {
    Pose {
        rotation: rotation_about(
            &Vec3::z(),
            pose.rotation[(1, 0)].atan2(pose.rotation[(0, 0)]),
        ),
        translation: Vec3::new(pose.translation.x, pose.translation.y, 0.0),
    }
}

fn world(shape: &Shape, pose: &Pose) -> Vec<Vec3> {
    shape.parts[0]
        .iter()
        .map(|p| pose.transform_point(p))
        .collect()
}

/// The body's one primitive, in the body's frame.
fn primitive(shape: &Shape) -> Convex {
    let own = shape.body.primitives().get(0);
    own.moved(shape.body.center())
}

fn case(
    bodies: &[Shape],
    (mode, kinds, is_smooth): (ContactMode, [char; 2], bool),
    kind: &JointKind,
    apart: f64,
    random: &mut Random,
) -> Case {
    let planar = bodies[0].body.dimension() == 2;
    let (r, s) = (
        &bodies[random.below(bodies.len())],
        &bodies[random.below(bodies.len())],
    );
    let on_r = supported(&primitive(r), kinds[0], planar, random);
    let on_s = supported(&primitive(s), kinds[1], planar, random);
    let pose_s = if planar {
        random.planar_pose(1.0)
    } else {
        random.pose(1.0)
    };
    let (pose_r, normal) = facing(&on_r, &on_s, &pose_s, apart, planar, random);
    let dimension = if planar { 2 } else { 3 };
    // Every third time the s-side is a link of another robot, which moves by a joint of the same kind.
    let (cobject, q): (CObject, Vec<f64>) = if random.below(3) == 0 {
        let (links, mut q) = held(kind, &pose_r, r, planar, random);
        let (others, more) = held(kind, &pose_s, s, planar, random);
        q.extend(more);
        let both: Arc<Space> = space(vec![robot(dimension, links), robot(dimension, others)]);
        let options = InducedOptions::default();
        (CObject::induced_links(both, &[[1, 3]], options).unwrap(), q)
    } else {
        let (links, q) = held(kind, &pose_r, r, planar, random);
        let one = space(vec![robot(dimension, links)]);
        (against(&one, &environment(&[(&s.body, pose_s)]).0), q)
    };
    Case {
        cobject,
        q,
        sides: [world(r, &pose_r), world(s, &pose_s)],
        normal,
        mode,
        is_smooth,
    }
}

impl Case {
    /// The contact's signed distance `by` away along velocity `k`, if it is still of the same features.
    fn clearance(&self, k: usize, by: f64, within: f64, features: [Feature; 2]) -> Option<f64> {
        let space = self.cobject.space();
        let mut v = vec![0.0; space.nv()];
        v[k] = by;
        let q = space.step(&self.q, &v);
        let mut query = QueryContext::new();
        let at = Configuration::Coordinates(&q);
        let list = query.witnesses(&self.cobject, at, within, 4).unwrap();
        let [contact] = &list.contacts[..] else {
            return None;
        };
        (contact.features == features).then_some(contact.clearance)
    }

    fn distance(&self, k: usize, by: f64) -> f64 {
        let space = self.cobject.space();
        let mut v = vec![0.0; space.nv()];
        v[k] = by;
        let q = space.step(&self.q, &v);
        let at = Configuration::Coordinates(&q);
        QueryContext::new()
            .distance(&self.cobject, at, f64::INFINITY)
            .unwrap()
            .distance
    }

    /// The gradient of the first contact within `within`, after its mode, normal and clearance were checked.
    fn gradient(&self, apart: f64, within: f64) -> Row {
        let list = QueryContext::new()
            .gradients(&self.cobject, &self.q, within, 4)
            .unwrap();
        assert_eq!(list.witnesses.len(), 1, "{:?} {apart:e}", self.mode);
        let contact = &list.contacts[0];
        let off = (contact.normal - self.normal).amax();
        if self.is_smooth || apart > 0.0 {
            assert_eq!((list.contacts.len(), contact.mode), (1, self.mode));
            // A direction between points is blurred by their rounding over the distance; edges that are nearly parallel
            // blur the one across them.
            let blur = if self.is_smooth { 0.0 } else { 2e-14 / apart };
            assert!(off <= blur.max(1e-10), "{:?} {apart:e}: {off:e}", self.mode);
        } else {
            // A touch of corners is of several modes, and any direction that separates the two will do.
            let [r, s] = &self.sides;
            assert!(gap_along(r, s, &contact.normal) >= -1e-13);
        }
        let error = (contact.clearance - apart).abs();
        assert!(
            error <= 1e-13 * apart.abs().max(10.0),
            "{apart:e}: {error:e}"
        );
        Row {
            gradient: list.gradients[..list.nv].to_vec(),
            features: contact.features,
        }
    }
}

/// A contact's gradient.
struct Row {
    gradient: Vec<f64>,
    features: [Feature; 2],
}

/// By what was measured: how many cases, how many of them with a tie, and the largest error.
#[derive(Default)]
struct Table(BTreeMap<String, (usize, usize, f64)>);

impl Table {
    fn enter(&mut self, keys: [&str; 2], error: Option<f64>) {
        for key in keys {
            let entry = self.0.entry(key.to_string()).or_default();
            entry.0 += 1;
            match error {
                Some(error) => entry.2 = entry.2.max(error),
                None => entry.1 += 1,
            }
        }
    }

    /// Prints it, and demands that errors are small and ties few.
    fn finish(&self, title: &str, most: f64) {
        println!("{title}");
        for (key, (cases, ties, error)) in &self.0 {
            println!("  {key:28} {cases:6} cases, {ties:5} ties, largest error {error:.1e}");
        }
        for (key, (cases, ties, error)) in &self.0 {
            assert!(*error <= most, "{title}, {key}: {error:e}");
            assert!(
                cases - ties >= 10_000 / share(),
                "{title}, {key}: {cases} cases, {ties} ties"
            );
        }
    }
}

fn bodies(random: &mut Random) -> Vec<Shape> {
    (0..24)
        .map(|i| {
            let away = random.point(0.4);
            let points: Vec<Vec3> = (0..6 + i % 6).map(|_| random.unit() * 0.5 + away).collect();
            hull(&points)
        })
        .collect()
}

fn polygons(random: &mut Random) -> Vec<Shape> {
    (0..24)
        .map(|i| {
            let away = random.planar_pose(0.4).translation;
            let corners: Vec<Vec3> = random
                .polygon(3 + i % 5, 0.5)
                .iter()
                .map(|p| p + away)
                .collect();
            planar(&[corners])
        })
        .collect()
}

/// A tenth of the cases, unless all are asked for.
fn share() -> usize {
    if helpers::all_cases() { 1 } else { 10 }
}

/// Each mode with each joint often enough that every mode and every joint has ten thousand cases.
fn each_case(
    planar: bool,
    seed: u64,
    smooth_only: bool,
    mut visit: impl FnMut(&dyn Fn(f64, &mut Random) -> Case, [&str; 2], &mut Random),
) {
    let mut random = Random::new(seed);
    let bodies = if planar {
        polygons(&mut random)
    } else {
        bodies(&mut random)
    };
    let modes = if planar {
        &PLANAR_MODES[..]
    } else {
        &MODES[..]
    };
    let modes: Vec<_> = modes.iter().filter(|mode| mode.2 || !smooth_only).collect();
    let joints = joints(planar);
    let rounds = 10_400 / share() / modes.len().min(joints.len());
    for mode in &modes {
        for (name, kind) in &joints {
            let keys = [&*format!("{:?}", mode.0), *name];
            for _ in 0..rounds {
                let make =
                    |apart: f64, random: &mut Random| case(&bodies, **mode, kind, apart, random);
                visit(&make, keys, &mut random);
            }
        }
    }
}

/// The largest difference of a gradient's entries from differences of fourth order; `None` where a neighbour has another
/// contact, and the distance a kink.
fn central(case: &Case, row: &Row, apart: f64, step: f64) -> Option<f64> {
    let mut worst = 0.0f64;
    let reach = apart.abs() + 20.0 * step + 1e-13;
    for (k, gradient) in row.gradient.iter().enumerate() {
        let at = |by: f64| case.clearance(k, by, reach, row.features);
        let [a, b, c, d] = [at(-2.0 * step)?, at(-step)?, at(step)?, at(2.0 * step)?];
        let quotient = ((a - d) + 8.0 * (c - b)) / (12.0 * step);
        worst = worst.max((gradient - quotient).abs() / gradient.abs().max(1.0));
    }
    Some(worst)
}

fn apart(planar: bool, seed: u64) {
    let mut table = Table::default();
    each_case(planar, seed, false, |make, keys, random| {
        let distance = 10f64.powf(random.within(-6.0, 1.0));
        let case = make(distance, random);
        let row = case.gradient(distance, 1.001 * distance + 1e-13);
        // The fourth-order error goes with (step / distance)^4, rounding with 1e-16 / step.
        let step = (0.006 * distance).min(2e-3);
        table.enter(keys, central(&case, &row, distance, step));
    });
    let title = if planar {
        "apart, in the plane"
    } else {
        "apart"
    };
    table.finish(title, 1e-6);
}

#[test]
fn gradients_apart() {
    apart(false, 21);
}

#[test]
fn gradients_apart_in_the_plane() {
    apart(true, 22);
}

/// At exact contact: along each coordinate either way, the distance grows by no less than the gradient says; where the
/// direction is the features' alone, by just as much.
fn touching(planar: bool, seed: u64) {
    let mut table = Table::default();
    let step = 3e-8;
    each_case(planar, seed, false, |make, keys, random| {
        let case = make(0.0, random);
        let row = case.gradient(0.0, 1e-13);
        let mut worst = 0.0f64;
        for (k, gradient) in row.gradient.iter().enumerate() {
            for sign in [-1.0, 1.0] {
                let growth = case.distance(k, sign * step) / step;
                let promised = (sign * gradient).max(0.0);
                let error = if case.is_smooth {
                    (growth - promised).abs()
                } else {
                    promised - growth
                };
                worst = worst.max(error / gradient.abs().max(1.0));
            }
        }
        table.enter(keys, Some(worst));
    });
    let title = if planar {
        "touching, in the plane"
    } else {
        "touching"
    };
    table.finish(title, 1e-6);
}

#[test]
fn gradients_at_contact() {
    touching(false, 23);
}

#[test]
fn gradients_at_contact_in_the_plane() {
    touching(true, 24);
}

/// Just inside, the mode's own distance function goes on with its sign.
fn inside(planar: bool, seed: u64) {
    let mut table = Table::default();
    each_case(planar, seed, true, |make, keys, random| {
        let depth = 10f64.powf(random.within(-9.0, -6.7));
        let case = make(-depth, random);
        let row = case.gradient(-depth, 0.0);
        table.enter(keys, central(&case, &row, -depth, 1e-8));
    });
    let title = if planar {
        "just inside, in the plane"
    } else {
        "just inside"
    };
    table.finish(title, 1e-6);
}

#[test]
fn gradients_just_inside() {
    inside(false, 25);
}

#[test]
fn gradients_just_inside_in_the_plane() {
    inside(true, 26);
}
