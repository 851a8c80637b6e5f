//! The parts of the kernel, each against something that knows nothing of it: boxes against the vertices they hold, bounds
//! against distances by brute force, the distance of polygons against the same and against all their features.

use cstk::body::{Body, BodyBuilder};
use cstk::boxes::{ChildPoints, PackedBox, WideNode};
use cstk::convex::{DistanceScratch, PlacedBuffer, measure};
use cstk::gjk::DistanceLimits;
use cstk::hierarchy::Grouping;
use cstk::hierarchy::packed::{NodeRef, PackedTree};
use cstk::lanes::{Instructions, Work, with_each};
use cstk::pair::{
    BoundRefinement, Pairing, PrimitiveScratch, ROUNDING, bounds, gaps_to_point, sharper_bounds,
};
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::query::QueryContext;
use cstk::tolerance::DISTANCE_ERROR;
use cstk_scenes as scenes;

use helpers::models::{KINDS, builder, built, mixed_primitives, options};
use helpers::oracle::hull_distance;
use helpers::random::Random;

/// How far a point is outside a box in either of its meanings, at most 0 inside; both in units of the tree.
fn outside(bounds: &PackedBox, point: &Vec3) -> f64 {
    let from_center = point - Vec3::from(bounds.center.map(f64::from));
    let axes = Mat3::from_columns(&bounds.axes.map(|axis| Vec3::from(axis.map(f64::from))));
    let uprightness = (axes.transpose() * axes - Mat3::identity()).norm();
    assert!(uprightness < 1.0 / 4096.0, "axes are {uprightness} askew");
    let along = axes.transpose() * from_center;
    let places = axes.try_inverse().expect("axes") * from_center;
    let half = Vec3::from(bounds.half.map(f64::from));
    (along.abs() - half).sup(&(places.abs() - half)).max()
}

/// The axes, half sides and centres of a node's boxes, coordinates apart, in units of two.
struct Decoded<'a>(&'a WideNode);

impl Work for Decoded<'_> {
    type Output = [[[f32; 8]; 3]; 5];

    fn run<I: Instructions>(self, lanes: I) -> Self::Output {
        let boxes = self.0.boxes(lanes, 0.5);
        let [a, b, c] = boxes.axes;
        [a, b, c, boxes.half, boxes.center].map(|three| three.map(|x| lanes.array(x)))
    }
}

/// Checks the boxes of a unit and of all below, and counts the primitives met.
fn check_boxes(
    body: &Body,
    tree: &PackedTree,
    unit: NodeRef,
    ancestors: &mut Vec<PackedBox>,
) -> usize {
    ancestors.push(tree.bounding_box(unit));
    let met = if unit.is_leaf() {
        let place = tree.place(unit);
        let primitive = tree.primitives().entry(place as usize).primitive;
        for vertex in body.primitives().get(primitive as usize).vertices {
            for bounds in ancestors.iter() {
                let excess = outside(bounds, &(vertex / tree.scale()));
                assert!(excess <= 1e-15, "primitive {primitive} is {excess} outside");
            }
        }
        1
    } else {
        let index = tree.index(unit);
        let node = tree.node(index);
        let count = node.count as usize;
        assert!((2..=8).contains(&count), "{count} children");
        let decoded = with_each(|| Decoded(node));
        let met = (0..count)
            .map(|lane| {
                let child = tree.child(index, lane);
                let bounds = tree.bounding_box(child);
                for [axis_a, axis_b, axis_c, half, center] in &decoded {
                    for k in 0..3 {
                        assert!((center[k][lane] - 0.5 * bounds.center[k]).abs() <= 6e-8);
                        assert_eq!(half[k][lane], 0.5 * bounds.half[k]);
                        let axes = [axis_a, axis_b, axis_c].map(|axis| axis[k][lane]);
                        assert_eq!(axes, bounds.axes.map(|axis| axis[k]));
                    }
                }
                assert!(tree.lowest(child) >= tree.lowest(unit));
                check_boxes(body, tree, child, ancestors)
            })
            .sum();
        let lowest = (0..count).map(|lane| tree.lowest(tree.child(index, lane)));
        assert_eq!(lowest.min(), Some(tree.lowest(unit)));
        met
    };
    ancestors.pop();
    met
}

#[test]
fn every_box_holds_what_is_below_and_every_primitive_is_met_once() {
    for (name, builder) in [
        ("lamp", builder(&scenes::lamp())),
        ("spaghetti", builder(&scenes::spaghetti(2000, 3))),
        ("mixed", mixed_primitives(300, 5)),
    ] {
        for wrapper in KINDS {
            let body = built(&builder, &options(Grouping::Hybrid, wrapper, 0.0));
            let tree = body.packed();
            let met = check_boxes(&body, tree, tree.root(), &mut Vec::new());
            assert_eq!(met, body.primitives().len(), "{name}, {wrapper:?}");
        }
    }
}

/// Convex polygons of three to nine corners: round, slender, tiny, or nearly flat triangles.
fn polygon(random: &mut Random) -> Vec<Vec3> {
    let corners = 3 + random.below(7);
    let size = [1.0, 1e-3, 3.0][random.below(3)];
    let width = size * [1.0, 1e-2, 1e-6][random.below(3)];
    let turn = random.within(0.0, 6.0);
    (0..corners)
        .map(|i| {
            let angle = turn
                + (i as f64 + random.within(0.0, 0.5)) / corners as f64 * std::f64::consts::TAU;
            Vec3::new(size * angle.cos(), width * angle.sin(), 0.0)
        })
        .collect()
}

/// A pose in which two polygons may be apart, nearly touching, crossing, parallel or in one plane.
fn relative(random: &mut Random) -> Pose {
    let mut pose = Pose::identity();
    if random.below(3) > 0 {
        pose.rotation = random.rotation();
    } else if random.below(2) == 0 {
        pose.rotation = cstk::pose::rotation_about(&Vec3::z(), random.within(-3.0, 3.0));
    }
    let reach = [1e-9, 1e-3, 0.5, 3.0][random.below(4)];
    pose.translation = random.point(reach);
    if random.below(4) == 0 {
        pose.translation.z = 0.0;
    }
    pose
}

#[test]
fn distances_of_polygons_are_those_of_brute_force_and_of_all_features() {
    let mut random = Random::new(11);
    let (mut touching, mut worst) = (0, 0.0f64);
    for case in 0..20_000 {
        let body = |points: &[Vec3]| {
            let mut builder = BodyBuilder::new(3).unwrap();
            builder.add_polygon(points, 0).ok()?;
            builder.build(&Default::default(), &mut |_| Ok(())).ok()
        };
        let (Some(a), Some(b)) = (body(&polygon(&mut random)), body(&polygon(&mut random))) else {
            continue;
        };
        let pose = relative(&mut random);
        let pairing = Pairing::new(&a, &Pose::identity(), &b, &pose);
        let size = pairing.precision.size;
        let mut scratch = PrimitiveScratch::default();
        let found = pairing
            .distance([0, 0], f64::INFINITY, &mut scratch)
            .unwrap();
        // The same with a cutoff on either side of it.
        if found > 0.0 {
            assert_eq!(pairing.distance([0, 0], found, &mut scratch), Some(found));
            assert_eq!(
                pairing.distance([0, 0], found * 0.99 - 1e-12 * size, &mut scratch),
                None
            );
        }
        let moved: Vec<Vec3> = b
            .primitives()
            .get(0)
            .vertices
            .iter()
            .map(|v| pairing.relative.transform_point(v))
            .collect();
        let truth = hull_distance(a.primitives().get(0).vertices, &moved);
        let error = (found - truth.upper).max(truth.lower() - found) / size;
        worst = worst.max(error);
        assert!(
            error <= 1e-13,
            "case {case}: {found}, brute force {truth:?}"
        );
        let (mut buffer_a, mut buffer_b) = (PlacedBuffer::default(), PlacedBuffer::default());
        let features = measure(
            &buffer_a.place(a.primitives().get(0), None, &Pose::identity()),
            &buffer_b.place(b.primitives().get(0), None, &pairing.relative),
            &pairing.precision,
            DistanceLimits::EXACT,
            &mut DistanceScratch::default(),
        );
        let features = features.unwrap().closest;
        let apart = (features.distance - found).abs() / size;
        assert!(
            apart <= 2.0 * DISTANCE_ERROR,
            "case {case}: {found}, all features {features:?}"
        );
        // The closest points are as far apart as the distance says.
        let hit = pairing.primitive_pair([0, 0], found).hit(0, found);
        let closest = pairing.closest(&hit, &mut scratch).closest;
        let between = (closest.points[0] - closest.points[1]).norm();
        assert!(
            (between - found).abs() <= 1e-13 * size,
            "case {case}: {closest:?}"
        );
        touching += usize::from(found == 0.0);
    }
    println!("worst error {worst:.1e} of the size; {touching} of 20,000 touch");
    assert!((1000..15_000).contains(&touching));
}

/// The walk compares single-precision bounds of boxes; what it finds must not depend on how large the world is.
#[test]
fn answers_scale_with_the_world() {
    let mesh = scenes::lamp();
    let mut answers = Vec::new();
    for scale in [
        1.0,
        2f64.powi(-90),
        2f64.powi(90),
        2f64.powi(-30),
        2f64.powi(30),
    ] {
        let mut scaled = mesh.clone();
        for vertex in &mut scaled.vertices {
            *vertex = vertex.map(|x| x * scale);
        }
        let body = built(&builder(&scaled), &Default::default());
        let mut context = cstk::query::QueryContext::new();
        let mut random = Random::new(2);
        for _ in 0..20 {
            let pose = Pose {
                rotation: random.rotation(),
                translation: random.point(1.5) * scale,
            };
            let found = context
                .pair_distance((&body, &pose), (&body, &Pose::identity()), f64::INFINITY)
                .unwrap();
            answers.push((found.distance / scale, found.witness.unwrap().primitives));
        }
    }
    for other in answers.chunks_exact(20).skip(1) {
        assert_eq!(other, &answers[..20]);
    }
}

/// The bounds of a node's boxes from another box, coarse and refined, and along a direction from the nearest along it of what the box
/// holds.
struct Bounded<'a> {
    node: &'a WideNode,
    one: &'a PackedBox,
    direction: &'a [f32; 3],
    nearest: &'a [f32; 3],
}

impl Work for Bounded<'_> {
    type Output = [[f32; 8]; 3];

    fn run<I: Instructions>(self, lanes: I) -> Self::Output {
        let eight = self.node.boxes(lanes, 1.0);
        let wanted = BoundRefinement {
            direction: None,
            cutoff: f32::INFINITY,
            among: 255,
        };
        [
            bounds(lanes, &eight, self.one),
            sharper_bounds(lanes, &eight, self.one, &wanted),
            gaps_to_point(lanes, &eight, self.nearest, self.direction),
        ]
        .map(|found| lanes.array(found))
    }
}

#[test]
fn no_bound_is_above_the_distance_of_the_boxes() {
    let single = |v: &Vec3| [0, 1, 2].map(|k| v[k] as f32);
    let corners = |given: &PackedBox| -> Vec<Vec3> {
        let vector = |v: [f32; 3]| Vec3::from(v.map(f64::from));
        let (center, half) = (vector(given.center), vector(given.half));
        let axes = Mat3::from_columns(&given.axes.map(vector));
        let signs = |i: usize| Vec3::from([0, 1, 2].map(|k| [-1.0, 1.0][i >> k & 1]));
        let corner = |i| center + axes * half.component_mul(&signs(i));
        (0..8).map(corner).collect()
    };
    let mut random = Random::new(71);
    let (mut coarse_sum, mut refined_sum, mut exact_sum) = (0.0, 0.0, 0.0);
    let (mut aimed_sum, mut within_sum) = (0.0, 0.0);
    for step in 0..150 {
        let half = [0.3, 0.1, 0.01][step % 3];
        let mut held = || {
            let center = random.point(0.5);
            let points = random.points(6, half);
            ChildPoints {
                points: points.into_iter().map(|p| center + p).collect(),
                excess: 0.0,
                axes: random.rotation(),
            }
        };
        let all: Vec<ChildPoints> = (0..1 + step % 8).map(|_| held()).collect();
        let node = WideNode::new(&all);
        let held = held();
        let one = WideNode::new(std::slice::from_ref(&held)).get(0);
        // From the first box towards the other one.
        let towards = Vec3::from(one.center.map(f64::from))
            - corners(&node.get(0)).iter().sum::<Vec3>() / 8.0;
        let direction = towards.normalize();
        let along = |p: &&Vec3| p.dot(&direction);
        let nearest = held
            .points
            .iter()
            .min_by(|p, q| along(p).total_cmp(&along(q)));
        let (direction, nearest) = (single(&direction), single(nearest.unwrap()));
        let bounded = || Bounded {
            node: &node,
            one: &one,
            direction: &direction,
            nearest: &nearest,
        };
        let found = with_each(bounded);
        for lane in 0..all.len() {
            let exact = hull_distance(&corners(&node.get(lane)), &corners(&one)).lower();
            let within = hull_distance(&corners(&node.get(lane)), &held.points).lower();
            for [coarse, refined, aimed] in &found {
                let [coarse, refined, aimed] = [coarse, refined, aimed].map(|b| f64::from(b[lane]));
                assert!(aimed <= within.max(0.0) + ROUNDING, "{aimed} {within}");
                aimed_sum += aimed.max(0.0);
                within_sum += within.max(0.0);
                assert!(refined <= exact.max(0.0) + ROUNDING, "{refined} {exact}");
                assert!(coarse <= refined);
                coarse_sum += coarse.max(0.0);
                refined_sum += refined.max(0.0);
                exact_sum += exact.max(0.0);
            }
        }
    }
    let shares = [coarse_sum, refined_sum].map(|sum| sum / exact_sum);
    // The largest gap alone is short of distances between corners.
    assert!(shares[0] > 0.88 && shares[1] > 0.98, "{shares:?}");
    // What the box holds is farther away than the box.
    assert!(within_sum > 1.05 * exact_sum, "{within_sum} {exact_sum}");
    println!("aimed {aimed_sum}, within {within_sum}, boxes {exact_sum}");
}

/// Triangles so small, for where they stand in the body, that single precision of their boxes' centres outgrows what the
/// boxes' sides have to spare: such bodies once were built without end.
#[test]
fn tiny_triangles_far_from_the_middle_are_built() {
    let mut random = Random::new(77);
    for size in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
        for _ in 0..40 {
            let mut builder = BodyBuilder::new(3).unwrap();
            let mut corners = Vec::new();
            for _ in 0..3 {
                let at = random.point(0.4);
                for _ in 0..4 {
                    let triangle: Vec<Vec3> = (0..3).map(|_| at + random.point(size)).collect();
                    builder.add_polygon(&triangle, 0).unwrap();
                    corners.extend(triangle);
                }
            }
            let body = built(&builder, &Default::default());
            // Still found where they are.
            let mut point = BodyBuilder::new(3).unwrap();
            point.add_polyhedron(&[Vec3::zeros()], 0).unwrap();
            let point = built(&point, &Default::default());
            for corner in &corners {
                let there = Pose::from_translation(*corner);
                let found = QueryContext::new()
                    .pair_distance((&body, &Pose::identity()), (&point, &there), f64::INFINITY)
                    .unwrap();
                assert!(found.distance <= 1e-15, "{size:e}: {}", found.distance);
            }
        }
    }
}
