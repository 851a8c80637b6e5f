//! Penetration depths of polyhedra against all normals that a facet of their Minkowski difference can have: each face's, and
//! the cross product of each two edges, whether the two support along it or not.

use cstk::convex::ContactMode;
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::query::{DepthOptions, QueryContext};

use helpers::random::Random;
use helpers::shapes::{Shape, box_corners, hull, off_feature, sphere_points};

/// How far A has to move along each of the lines, either way, to part the two, and the way.
fn ways_of_all_lines(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> Vec<(f64, Vec3)> {
    let origin = a.1.translation;
    let corners = [a, b].map(|(shape, pose)| shape.placed(pose, &origin).concat());
    let [faces, edges] = [0, 1].map(|what| {
        [a, b].map(|(shape, pose)| -> Vec<Vec3> {
            let primitive = shape.body.primitives().get(0).shape;
            let vertices = &primitive.vertices;
            if what == 0 {
                let faces = primitive.faces.iter();
                return faces.map(|face| pose.rotation * face.normal).collect();
            }
            let along = |&[i, j]: &[u32; 2]| vertices[j as usize] - vertices[i as usize];
            let edges = primitive.edges.iter();
            edges.map(|edge| pose.rotation * along(edge)).collect()
        })
    });
    let [edges_a, edges_b] = &edges;
    let crosses = edges_a
        .iter()
        .flat_map(|x| edges_b.iter().map(|y| x.cross(y)));
    let lines = faces.concat().into_iter().chain(crosses);
    let extent = |corners: &[Vec3], n: &Vec3| {
        let heights = corners.iter().map(|v| n.dot(v));
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    };
    let ways = |n: Vec3| {
        let [[low_a, high_a], [low_b, high_b]] = [0, 1].map(|i| extent(&corners[i], &n));
        [(high_b - low_a, n), (high_a - low_b, -n)]
    };
    let normals = lines.filter_map(|line| line.try_normalize(1e-13));
    normals.flat_map(ways).collect()
}

/// The shortest of them; of length 0 if the two are apart. A line that is no facet's normal is longer, so that none need be left out.
fn way_of_all_lines(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> (f64, Vec3) {
    let ways = ways_of_all_lines(a, b).into_iter();
    let (depth, normal) = ways.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap();
    (depth.max(0.0), normal)
}

/// How long it is.
fn depth_of_all_lines(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> f64 {
    way_of_all_lines(a, b).0
}

/// Checks one pair; false if the two do not meet.
fn check(a: (&Shape, &Pose), b: (&Shape, &Pose), case: &str) -> bool {
    let list = QueryContext::new()
        .pair_penetration((&a.0.body, a.1), (&b.0.body, b.1), 1)
        .unwrap();
    let Some(found) = list.penetrations.first() else {
        return false;
    };
    let want = depth_of_all_lines(a, b);
    let found = &found.penetration;
    let size = a.0.body.radius() + b.0.body.radius();
    let off = (found.depth - want).abs();
    assert!(off <= 1e-13 * size, "{case}: {} for {want}", found.depth);
    let [on_a, on_b] = &found.points;
    let gap = (on_b - on_a - found.direction * found.depth).norm();
    assert!(gap <= 1e-13 * size, "{case}: the points are {gap:e} off");
    // The points belong to the two.
    for ((shape, pose), point) in [a, b].into_iter().zip([on_a, on_b]) {
        let primitive = shape.body.primitives().get(0).shape;
        let home = pose.inverse().transform_point(point) - shape.body.center();
        for face in &primitive.faces {
            let height = face
                .normal
                .dot(&(home - primitive.vertices[face.vertices[0] as usize]));
            let is_flat = primitive.faces.len() == 1;
            let beyond = if is_flat { height.abs() } else { height };
            assert!(beyond <= 1e-13 * size, "{case}: a point is {beyond:e} out");
        }
    }
    true
}

fn random_hull(random: &mut Random) -> Shape {
    let count = 4 + random.below(20);
    let stretch = Vec3::from_fn(|_, _| 10f64.powf(random.within(-1.5, 0.0)));
    let points = random.points(count, 1.0);
    hull(
        &points
            .iter()
            .map(|p| p.component_mul(&stretch))
            .collect::<Vec<_>>(),
    )
}

#[test]
fn random_polyhedra_are_as_deep_as_the_best_of_all_lines() {
    let mut random = Random::new(71);
    let mut met = 0;
    for case in 0..1500 {
        let shapes = [random_hull(&mut random), random_hull(&mut random)];
        let poses = [random.pose(0.2), random.pose(0.2)];
        let pairs = [0, 1].map(|i| (&shapes[i], &poses[i]));
        met += usize::from(check(pairs[0], pairs[1], &format!("random {case}")));
    }
    assert!(met > 700, "{met}");
}

/// A prism over a regular polygon.
fn prism(sides: usize, radius: f64, half: f64) -> Shape {
    let angle = |i: usize| i as f64 / sides as f64 * std::f64::consts::TAU;
    let ring = |z: f64| (0..sides).map(move |i| Vec3::new(angle(i).cos(), angle(i).sin(), z));
    let scaled = |v: Vec3| Vec3::new(radius * v.x, radius * v.y, v.z);
    hull(
        &ring(-half)
            .chain(ring(half))
            .map(scaled)
            .collect::<Vec<_>>(),
    )
}

/// A flat polygon in space.
fn flat(sides: usize, radius: f64) -> Shape {
    let corner = |i: usize| {
        let angle = i as f64 / sides as f64 * std::f64::consts::TAU;
        Vec3::new(angle.cos(), angle.sin(), 0.0) * radius
    };
    hull(&(0..sides).map(corner).collect::<Vec<_>>())
}

#[test]
fn parallel_and_nearly_parallel_edges_and_faces() {
    let mut random = Random::new(72);
    let apex = |z: f64| {
        let mut corners = box_corners([1.0, 1.0, 0.0])[..4].to_vec();
        corners.push(Vec3::z() * z);
        hull(&corners)
    };
    let shapes = [
        ("cube", hull(&box_corners([1.0; 3]))),
        ("slab", hull(&box_corners([1.0, 0.7, 1e-3]))),
        ("sliver", hull(&box_corners([1.0, 1e-5, 1e-7]))),
        ("prism", prism(7, 0.5, 0.5)),
        ("even prism", prism(12, 0.6, 0.2)),
        ("ball", hull(&sphere_points(0.5, 3))),
        ("low pyramid", apex(1e-4)),
        ("pyramid", apex(0.8)),
        ("triangle", flat(3, 0.6)),
        ("hexagon", flat(6, 0.5)),
    ];
    let quarter = |k: usize| {
        let axis = [Vec3::x(), Vec3::y(), Vec3::z()][k % 3];
        let (x, y) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][k / 3 % 4];
        // Without the rounding of sines.
        let cross = Mat3::new(
            0.0, -axis.z, axis.y, axis.z, 0.0, -axis.x, -axis.y, axis.x, 0.0,
        );
        Mat3::identity() * x + axis * axis.transpose() * (1.0 - x) + cross * y
    };
    let mut met = 0;
    for (i, (name_a, a)) in shapes.iter().enumerate() {
        for (name_b, b) in &shapes[i..] {
            for tilt in [0.0, 1e-16, 1e-13, 1e-10, 1e-8, 1e-5, 1e-2] {
                for k in 0..12 {
                    let tilted = rotation_about(&random.unit(), tilt);
                    let grid = [0.0, 0.125, 0.25, -0.375];
                    let mut shift = || grid[random.below(4)];
                    let pose_b = Pose {
                        rotation: tilted * quarter(k),
                        translation: Vec3::new(shift(), shift(), 0.1 * shift()),
                    };
                    let case = format!("{name_a}, {name_b}, tilt {tilt:e}, turn {k}");
                    let here = Pose::identity();
                    met += usize::from(check((a, &here), (b, &pose_b), &case));
                }
            }
        }
    }
    assert!(met > 3000, "{met}");
}

/// Polyhedra that overlap by a little have a contact along the shortest way out, as deep as that is long; also where another is about as
/// long, at the end of a face or an edge. All contacts that are listed are on the features that they name.
#[test]
fn contacts_just_inside_are_along_the_shortest_way_out() {
    let mut random = Random::new(75);
    let any = |random: &mut Random| match random.below(9) {
        0 => hull(&box_corners([1.0; 3])),
        1 => hull(&box_corners([1.0, 0.7, 1e-3])),
        2 => prism(3 + random.below(10), 0.5, 0.3),
        3 => flat(3 + random.below(4), 0.5),
        4 => ball(30, random),
        5 => hull(&random.points(4, 1.0)),
        _ => random_hull(random),
    };
    let (mut met, mut edges) = (0, 0);
    for case in 0..4000 {
        let shapes = [any(&mut random), any(&mut random)];
        let mut poses = [random.pose(0.2), random.pose(0.2)];
        match case % 4 {
            0 => poses[1].rotation = poses[0].rotation,
            1 => {
                let spin = rotation_about(&Vec3::z(), random.within(-3.0, 3.0));
                poses[1].rotation = poses[0].rotation * spin;
            }
            _ => {}
        }
        let at = |poses: &[Pose; 2]| {
            let [a, b] = [0, 1].map(|i| (&shapes[i], poses[i]));
            way_of_all_lines((a.0, &a.1), (b.0, &b.1))
        };
        let size = shapes[0].body.radius() + shapes[1].body.radius();
        let (depth, way) = at(&poses);
        let left = size * 10f64.powf(random.within(-14.0, -7.0));
        if depth <= left {
            continue;
        }
        poses[0].translation += way * (depth - left);
        let is_at_end = case % 8 >= 4;
        if is_at_end {
            let aside = way.cross(&random.unit()).normalize();
            let left = size * 10f64.powf(random.within(-14.0, -7.0));
            let [a, b] = [0, 1].map(|i| (&shapes[i], &poses[i]));
            let ways = ways_of_all_lines(a, b).into_iter();
            let ahead = ways.filter(|(_, way)| way.dot(&aside) > 1e-9);
            let lengths = ahead.map(|(depth, way)| (depth - left) / way.dot(&aside));
            let length = lengths.fold(f64::INFINITY, f64::min);
            if length > 0.0 && length < f64::INFINITY {
                poses[0].translation += aside * length;
            }
        }
        let (want, _) = at(&poses);
        for [i, j] in [[0, 1], [1, 0]] {
            let sides = [i, j].map(|k| (&*shapes[k].body, &poses[k]));
            let mut context = QueryContext::new();
            let found = context
                .pair_distance(sides[0], sides[1], f64::INFINITY)
                .unwrap();
            assert_eq!(found.distance, 0.0, "{case}");
            let Some(contact) = found.contact else {
                // Surfaces that cross by more than a touch have no inside.
                let is_flat = |shape: &Shape| shape.body.primitives().get(0).shape.faces.len() == 1;
                assert!(want > 1e-11 * size && shapes.iter().all(is_flat), "{case}");
                continue;
            };
            let off = (contact.clearance + want).abs();
            // One normal gives way to another only where its gap is larger by GAP_TIE, 1e-13 of the largest coordinate.
            let most = if is_at_end { 2e-13 } else { 1e-13 };
            assert!(
                off <= most * size,
                "{case}: {} for {want}",
                contact.clearance
            );
            let moved = Pose {
                translation: poses[i].translation + contact.normal * want,
                ..poses[i]
            };
            let parted = way_of_all_lines((&shapes[i], &moved), (&shapes[j], &poses[j])).0;
            assert!(parted <= 2.0 * most * size, "{case}: {parted:e} are left");
            edges += usize::from(contact.mode == ContactMode::EdgeEdge);
            let list = context.pair_witnesses(sides[0], sides[1], 0.0, 10).unwrap();
            for contact in list.contacts {
                for (side, k) in [i, j].into_iter().enumerate() {
                    let (feature, point) = (contact.features[side], &contact.points[side]);
                    let off = off_feature((&shapes[k], &poses[k]), feature, point);
                    assert!(off <= 1e-9 * size, "{case}: {off:e} off {contact:?}");
                }
            }
        }
        met += 1;
    }
    assert!(met > 2000 && edges > 500, "{met} {edges}");
}

#[test]
fn coincident_bodies_and_concentric_balls() {
    let mut random = Random::new(73);
    let (fine, coarse) = (hull(&sphere_points(1.0, 4)), hull(&sphere_points(1.0, 3)));
    let here = Pose::identity();
    for tilt in [0.0, 1e-15, 1e-9, 1e-3, 1.0] {
        let turned = Pose {
            rotation: rotation_about(&random.unit(), tilt),
            translation: Vec3::zeros(),
        };
        for (a, b) in [(&fine, &fine), (&fine, &coarse), (&coarse, &coarse)] {
            assert!(check(
                (a, &here),
                (b, &turned),
                &format!("balls, tilt {tilt:e}")
            ));
        }
    }
    for _ in 0..50 {
        let shape = random_hull(&mut random);
        assert!(check((&shape, &here), (&shape, &here), "a hull in itself"));
    }
}

/// Points all over a sphere, none of them regular.
fn ball(count: usize, random: &mut Random) -> Shape {
    hull(&(0..count).map(|_| random.unit()).collect::<Vec<_>>())
}

#[test]
fn few_facets_are_looked_at() {
    let mut random = Random::new(74);
    let mut query = QueryContext::new();
    for count in [500, 1000, 2000] {
        let shapes = [ball(count, &mut random), ball(count, &mut random)];
        let poses = [random.pose(0.1), random.pose(0.1)];
        let sides = [0, 1].map(|i| (&*shapes[i].body, &poses[i]));
        // A convex polyhedron of n triangle corners has 3 n - 6 edges, and hence 9 n^2 pairs of them.
        query.set_limit(Some(2 * count as u64));
        let list = query.pair_penetration(sides[0], sides[1], 1).unwrap();
        assert!(list.penetrations[0].penetration.depth > 1.0);
    }
}

/// Of bodies that hardly touch, with edges that are parallel to within 1e-10, the facet of the shortest way out is as narrow. The depth was
/// computed in numbers of 113 bits.
#[test]
fn a_facet_between_nearly_parallel_edges() {
    let points = |corners: &[[f64; 3]]| -> Vec<Vec3> {
        corners.iter().map(|&corner| Vec3::from(corner)).collect()
    };
    let a = hull(&points(&[
        [0.5, 0.0, 0.5],
        [-0.5, 0.25, -0.25],
        [0.5, 0.5, -0.25],
        [-0.25, -0.5, -0.25],
        [-0.25, -0.25, 0.25],
        [0.0, 0.5, 0.25],
    ]));
    let b = hull(&points(&[
        [0.25, -0.25, 0.0],
        [0.25, -0.5, 0.5],
        [-0.25, -0.25, 0.0],
        [0.5, 0.0, 0.25],
        [0.5, -0.5, 0.5],
    ]));
    let here = Pose::identity();
    let pose = Pose {
        rotation: Mat3::new(
            1.0,
            -1.7404704548607607e-10,
            -1.0866174359701308e-10,
            1.740470454574241e-10,
            1.0,
            -1.926422962329494e-10,
            1.0866174364290583e-10,
            1.9264229620706313e-10,
            1.0,
        ),
        translation: Vec3::new(0.0, 0.0, 0.25),
    };
    let want = 3.3545825511771752e-12;
    let sides = [(&*a.body, &here), (&*b.body, &pose)];
    for [r, s] in [sides, [sides[1], sides[0]]] {
        let mut context = QueryContext::new();
        let list = context.pair_penetration(r, s, 1).unwrap();
        let found = list.penetrations[0].penetration.depth;
        assert!((found - want).abs() <= 1e-14, "{found} for {want}");
        let bounds = context.pair_depth(r, s, &DepthOptions::default()).unwrap();
        assert!(
            bounds.lower <= want && want <= bounds.upper,
            "{bounds:?} for {want}"
        );
    }
}
