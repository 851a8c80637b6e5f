//! Bodies of primitives of all kinds, and comparisons of two bodies that should be the same.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{QueryContext, WitnessList};

use helpers::models::built;
use helpers::random::Random;

/// A primitive as it is given to a builder.
#[derive(Clone)]
pub enum Given {
    Polygon(Vec<Vec3>),
    Hull(Vec<Vec3>),
    Rounded(Vec<Vec3>, f64),
    Cylinder(Pose, f64, f64),
    Cone(Pose, f64, f64),
    Ellipsoid(Pose, Vec3),
    Points(Vec<Vec3>, f64),
}

impl Given {
    pub fn random(random: &mut Random, kind: usize) -> Self {
        let at = random.pose(1.0);
        let near = |points: Vec<Vec3>| -> Vec<Vec3> {
            points.iter().map(|p| at.transform_point(p)).collect()
        };
        match kind % 8 {
            0 => Self::Polygon(near(random.polygon(3 + kind % 5, 0.4))),
            1 => Self::Hull(near(random.points(4 + kind % 9, 0.3))),
            2 => Self::Rounded(near(random.points(2, 0.4)), 0.1),
            3 => Self::Rounded(near(random.polygon(4, 0.3)), 0.05),
            4 => Self::Cylinder(at, 0.1, 0.3),
            5 => Self::Cone(at, 0.2, 0.3),
            6 => Self::Ellipsoid(at, Vec3::new(0.1, 0.2, 0.3)),
            _ => Self::Points(near(random.points(30, 0.5)), 0.02 * (kind % 2) as f64),
        }
    }

    /// The same after its vertices have moved; what is smooth keeps its orientation.
    pub fn with_vertices(&self, moved: impl Fn(&Vec3) -> Vec3) -> Self {
        let at = |pose: &Pose| Pose {
            translation: moved(&pose.translation),
            ..*pose
        };
        let all = |points: &[Vec3]| points.iter().map(&moved).collect();
        match self {
            Self::Polygon(points) => Self::Polygon(all(points)),
            Self::Hull(points) => Self::Hull(all(points)),
            Self::Rounded(points, radius) => Self::Rounded(all(points), *radius),
            Self::Cylinder(pose, radius, half) => Self::Cylinder(at(pose), *radius, *half),
            Self::Cone(pose, radius, height) => Self::Cone(at(pose), *radius, *height),
            Self::Ellipsoid(pose, axes) => Self::Ellipsoid(at(pose), *axes),
            Self::Points(points, radius) => Self::Points(all(points), *radius),
        }
    }

    /// Adds it after a motion.
    pub fn add(&self, builder: &mut BodyBuilder, pose: &Pose, tag: u64) {
        let moved = |points: &[Vec3]| -> Vec<Vec3> {
            points.iter().map(|p| pose.transform_point(p)).collect()
        };
        match self {
            Self::Polygon(points) => builder.add_polygon(&moved(points), tag),
            Self::Hull(points) => builder.add_polyhedron(&moved(points), tag),
            Self::Rounded(points, radius) => {
                builder.add_rounded_polyhedron(&moved(points), *radius, tag)
            }
            Self::Cylinder(at, radius, half) => {
                builder.add_cylinder(&pose.compose(at), *radius, *half, tag)
            }
            Self::Cone(at, radius, height) => {
                builder.add_cone(&pose.compose(at), *radius, *height, tag)
            }
            Self::Ellipsoid(at, axes) => builder.add_ellipsoid(&pose.compose(at), axes, tag),
            Self::Points(points, radius) => builder.add_points(&moved(points), *radius),
        }
        .unwrap();
    }
}

pub fn body_of(given: &[Given], options: &HierarchyOptions) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    for (tag, one) in (0..).zip(given) {
        one.add(&mut builder, &Pose::identity(), tag);
    }
    Arc::new(built(&builder, options))
}

/// Every box of the packed tree bounds the primitives below it along its axes.
pub fn boxes_bound_their_primitives(body: &Body) {
    let tree = body.packed();
    let mut below = vec![(tree.root(), Vec::new())];
    while let Some((node, mut above)) = below.pop() {
        let stored = tree.bounding_box(node);
        above.push(stored);
        if node.is_leaf() {
            let entry = tree.primitives().entry(tree.place(node) as usize);
            let primitive = body.primitives().get(entry.primitive as usize);
            for stored in &above {
                let center = Vec3::from(stored.center.map(f64::from)) * tree.scale();
                for (axis, half) in stored.axes.iter().zip(stored.half) {
                    let axis = Vec3::from(axis.map(f64::from));
                    let half = f64::from(half) * tree.scale();
                    for axis in [axis, -axis] {
                        let along = axis.dot(&(primitive.farthest(&axis) - center));
                        assert!(along <= half + 1e-13 * body.radius(), "{along} {half}");
                    }
                }
            }
        } else {
            let index = tree.index(node);
            let lanes = 0..tree.node(index).count as usize;
            below.extend(lanes.map(|lane| (tree.child(index, lane), above.clone())));
        }
    }
}

/// Distances, classes and witnesses of both bodies with a probe at random poses are the same, but for rounding.
pub fn answers_are_equal(whole: &Body, flat: &Body, random: &mut Random, poses: usize) {
    let probe = body_of(
        &[0, 1, 2, 4, 8].map(|kind| Given::random(random, kind)),
        &HierarchyOptions::default(),
    );
    let (mut query, mut other) = (QueryContext::new(), QueryContext::new());
    let half = 1.2 * whole.radius();
    for _ in 0..poses {
        let at = random.pose(half);
        let at = Pose {
            translation: at.translation + whole.center(),
            ..at
        };
        let b = (&*probe, &at);
        let [x, y] = [whole, flat].map(|body| (body, Pose::identity()));
        let one = query.pair_distance((x.0, &x.1), b, f64::INFINITY).unwrap();
        let two = other.pair_distance((y.0, &y.1), b, f64::INFINITY).unwrap();
        let size = 4.0 * whole.radius() + whole.center().norm();
        // Smooth primitives are known to 1e-11 of their diameters.
        let error = 1e-12 * size + 2e-11;
        let off = (one.distance - two.distance).abs();
        assert!(off <= error, "{} {}", one.distance, two.distance);
        assert_eq!(
            one.lower == 0.0,
            two.lower == 0.0,
            "{} {}",
            one.lower,
            two.lower
        );
        let shell = two.distance + 0.1;
        let one = query.pair_witnesses((x.0, &x.1), b, shell, 10_000).unwrap();
        let two = other.pair_witnesses((y.0, &y.1), b, shell, 10_000).unwrap();
        let of = |list: &WitnessList| -> Vec<[u64; 3]> {
            let sure = list.witnesses.iter().filter(|w| w.distance < shell - error);
            let mut all: Vec<[u64; 3]> = sure
                .map(|w| [w.primitives[0].into(), w.primitives[1].into(), w.tags[0]])
                .collect();
            all.sort_unstable();
            all
        };
        let (one, two) = (of(&one), of(&two));
        // A witness at the edge of the shell may be in one list alone.
        let lone = one.iter().filter(|w| two.binary_search(w).is_err()).count();
        assert!(
            lone == 0 && one.len() >= two.len() - lone,
            "{one:?} {two:?}"
        );
    }
}
