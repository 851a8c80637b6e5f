//! Bodies of meshes and round shapes that turn: the convex hulls of such bodies, which proofs may try, are not centred where the bodies
//! are. Motions, boxes and bodies between poses that end, or have within them, a little contact are not free.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class};
use cstk::motion::{MotionOptions, MotionOutcome, PairMotion, RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;
use cstk::robot::{JointKind, LinkDefinition};
use cstk_scenes::bumpy_sphere;
use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};

use super::random_scenes::{built, class};

fn add_bumpy(builder: &mut BodyBuilder, polygons: usize, center: &Vec3, radius: f64, seed: u64) {
    let mesh = bumpy_sphere(polygons, seed);
    let at = |index: &u32| Vec3::from(mesh.vertices[*index as usize]) * radius + center;
    for face in &mesh.faces {
        let corners: Vec<Vec3> = face.iter().map(at).collect();
        builder.add_polygon(&corners, 0).unwrap();
    }
}

fn add_round(builder: &mut BodyBuilder, random: &mut Random, kind: usize, center: &Vec3) {
    let pose = Pose {
        rotation: rotation_about(&random.unit(), random.within(0.0, 3.0)),
        translation: *center,
    };
    let size = random.within(0.2, 0.5);
    let slim = size * random.within(0.2, 2.0);
    match kind {
        0 => builder.add_cylinder(&pose, size, slim, 0),
        1 => builder.add_ellipsoid(&pose, &Vec3::new(size, 0.5 * slim, 0.3 * size), 0),
        2 => {
            let way = pose.rotation.column(0) * size;
            builder.add_capsule(center, &(center + way), 0.2, 0)
        }
        3 => builder.add_cone(&pose, size, 2.0 * size, 0),
        4 => builder.add_sphere(center, size, 0),
        _ => builder.add_box(&pose, &Vec3::new(size, slim, 0.1), 0),
    }
    .unwrap();
}

/// A body that turns about z, and one in its way.
struct Turning {
    kind: usize,
    cell: CObject,
    pair: [Arc<Body>; 2],
    pose: Pose,
    /// Where the way is free, and the first contact after it.
    angles: [f64; 2],
}

impl Turning {
    fn random(context: &mut QueryContext, random: &mut Random, seed: u64) -> Option<Self> {
        let kind = random.below(6);
        // The round shape is in front of the mesh that meets first, or on the other side.
        let beside = match random.below(2) {
            0 => Vec3::new(random.within(0.9, 1.2), -0.5, random.within(-0.2, 0.2)),
            _ => Vec3::new(-1.0, random.within(-0.3, 0.3), random.within(-0.2, 0.2)),
        };
        let moving = built(|b| {
            add_bumpy(b, 64, &Vec3::new(-1.0, 0.0, 0.0), 0.2, seed);
            add_round(b, random, kind, &beside);
            add_bumpy(b, 600, &Vec3::x(), 0.3, seed + 1);
        });
        let object = built(|b| add_bumpy(b, 600, &Vec3::zeros(), 0.5, seed + 2));
        let links = vec![LinkDefinition {
            body: Some(moving.clone()),
            ..link(None, JointKind::Revolute, Vec3::z())
        }];
        let pose = Pose::from_translation(Vec3::new(
            random.within(1.2, 1.6),
            0.75,
            random.within(-0.1, 0.1),
        ));
        let (environment, _) = environment(&[(&object, pose)]);
        let cell = against(&space(vec![robot(3, links)]), &environment);
        let mut angles = [-0.8, 0.6];
        if class(context, &cell, &[angles[0]]) != Class::Outside
            || class(context, &cell, &[angles[1]]) == Class::Outside
        {
            return None;
        }
        for _ in 0..60 {
            let middle = 0.5 * (angles[0] + angles[1]);
            let is_free = class(context, &cell, &[middle]) == Class::Outside;
            angles[usize::from(!is_free)] = middle;
        }
        Some(Self {
            kind,
            cell,
            pair: [moving, object],
            pose,
            angles,
        })
    }

    fn pair_motion(
        &self,
        context: &mut QueryContext,
        [start, end]: [f64; 2],
        options: &MotionOptions,
    ) -> MotionOutcome {
        let poses = [start, end].map(|angle| Pose {
            rotation: rotation_about(&Vec3::z(), angle),
            ..Pose::identity()
        });
        let [moving, object] = &self.pair;
        let moving = PairMotion {
            body: moving,
            poses: [&poses[0], &poses[1]],
        };
        let resting = PairMotion {
            body: object,
            poses: [&self.pose, &self.pose],
        };
        let answer = context.pair_motion(&moving, &resting, options);
        answer.unwrap().outcome
    }
}

#[test]
fn bodies_of_meshes_and_round_shapes_do_not_turn_into_contact_unseen() {
    let mut random = Random::new(251);
    let context = &mut QueryContext::new();
    let mut seen = 0;
    for seed in 0..60 {
        let Some(scene) = Turning::random(context, &mut random, 3 * seed) else {
            continue;
        };
        for past in [1e-6, 1e-4, 1e-3, 1e-2] {
            for before in [1e-3, 1e-2, 0.1, 0.5] {
                let [free, contact] = scene.angles;
                let [start, end] = [free - before, contact + past];
                if class(context, &scene.cell, &[end]) == Class::Outside {
                    continue;
                }
                seen += 1;
                let told = format!("kind {}, from {start} to {end}", scene.kind);
                let options = MotionOptions::default();
                let motion = context.motion(&scene.cell, &[start], &[end], &options);
                assert_ne!(motion.unwrap().outcome, MotionOutcome::Free, "{told}");
                let pair = scene.pair_motion(context, [start, end], &options);
                assert_ne!(pair, MotionOutcome::Free, "{told}, as a pair");
                let options = RegionOptions::default();
                let region = context.classify_region(&scene.cell, &[start], &[end], &options);
                let outcome = region.unwrap().outcome;
                assert_ne!(outcome, RegionOutcome::Free, "{told}, as a box");
            }
        }
    }
    assert!(seen > 400, "{seen}");
}
