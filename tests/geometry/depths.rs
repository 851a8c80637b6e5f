//! Depths of unions: closed forms, an exact oracle for unions of boxes, the definition itself by translations at random.

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::query::{DepthOptions, PairDepth, QueryContext};

use helpers::all_cases;
use helpers::random::Random;
use helpers::shapes::{Shape, cube_surface, cuboid, dented_ball};

pub fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

pub fn depth_to(a: (&Body, &Pose), b: (&Body, &Pose), tolerance: f64, max_steps: u64) -> PairDepth {
    let options = DepthOptions {
        tolerance,
        max_steps,
    };
    let found = QueryContext::new().pair_depth(a, b, &options).unwrap();
    check(a, b, &found);
    found
}

pub fn depth(a: (&Body, &Pose), b: (&Body, &Pose)) -> PairDepth {
    depth_to(a, b, 1e-13, 2000)
}

/// The translation parts the bodies, and has the length that is claimed.
fn check(a: (&Body, &Pose), b: (&Body, &Pose), found: &PairDepth) {
    assert!(found.lower <= found.upper);
    assert!((found.translation.norm() - found.upper).abs() <= 1e-12 * (1.0 + found.upper));
    let away = moved(a.1, &found.translation);
    let apart = QueryContext::new()
        .pair_distance((a.0, &away), b, f64::INFINITY)
        .unwrap();
    assert!(apart.lower > 0.0, "the way out does not part the bodies");
}

fn moved(pose: &Pose, way: &Vec3) -> Pose {
    Pose {
        translation: pose.translation + way,
        ..*pose
    }
}

pub fn built(add: impl FnOnce(&mut BodyBuilder)) -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap()
}

type Box3 = [Vec3; 2];

fn boxes(parts: &[Box3], turn: &Mat3) -> Body {
    built(|builder| {
        for (i, [low, high]) in parts.iter().enumerate() {
            let middle = Pose {
                rotation: *turn,
                translation: turn * (0.5 * (low + high)),
            };
            builder
                .add_box(&middle, &(0.5 * (high - low)), i as u64)
                .unwrap();
        }
    })
}

/// The depth of two unions of boxes along the axes, A moved by `way`: the shortest vector outside all Minkowski differences.
/// Its coordinates are 0 or faces of differences, by the grid of these.
fn grid_depth(a: &[Box3], b: &[Box3], way: &Vec3) -> f64 {
    let mut differences: Vec<Box3> = Vec::new();
    for [low_a, high_a] in a {
        for [low_b, high_b] in b {
            differences.push([low_b - high_a - way, high_b - low_a - way]);
        }
    }
    let cuts = [0, 1, 2].map(|k| {
        let mut cuts: Vec<f64> = differences
            .iter()
            .flat_map(|d| [d[0][k], d[1][k]])
            .collect();
        cuts.push(0.0);
        cuts.sort_by(f64::total_cmp);
        cuts.insert(0, cuts[0] - 1.0);
        cuts.push(cuts[cuts.len() - 1] + 1.0);
        cuts
    });
    let mut best = f64::INFINITY;
    for i in 1..cuts[0].len() {
        for j in 1..cuts[1].len() {
            for k in 1..cuts[2].len() {
                let low = Vec3::new(cuts[0][i - 1], cuts[1][j - 1], cuts[2][k - 1]);
                let high = Vec3::new(cuts[0][i], cuts[1][j], cuts[2][k]);
                // The outermost cells go on for ever.
                let near = Vec3::zeros().sup(&low).inf(&high);
                if near.norm() >= best || (0..3).any(|k| low[k] >= high[k]) {
                    continue;
                }
                let middle = 0.5 * (low + high);
                let holds = |d: &Box3| (0..3).all(|k| d[0][k] < middle[k] && middle[k] < d[1][k]);
                if !differences.iter().any(holds) {
                    best = near.norm();
                }
            }
        }
    }
    best
}

#[test]
fn two_boxes_have_the_depth_of_their_least_overlap() {
    let (a, b) = (cuboid([2.0, 2.0, 2.0]).body, cuboid([2.0, 4.0, 6.0]).body);
    let found = depth((&a, &at(1.7, 0.5, 0.2)), (&b, &at(0.0, 0.0, 0.0)));
    assert!((found.lower - 0.3).abs() < 1e-12 && (found.upper - 0.3).abs() < 1e-12);
    assert!((found.translation - Vec3::new(0.3, 0.0, 0.0)).norm() < 1e-12);
    let apart = depth_or_apart((&a, &at(2.1, 0.0, 0.0)), (&b, &at(0.0, 0.0, 0.0)));
    assert!(!apart.meet && apart.lower == 0.0 && apart.upper == 0.0);
}

fn depth_or_apart(a: (&Body, &Pose), b: (&Body, &Pose)) -> PairDepth {
    QueryContext::new()
        .pair_depth(a, b, &DepthOptions::default())
        .unwrap()
}

#[test]
fn unions_of_boxes_have_the_depth_of_the_grid() {
    let mut random = Random::new(1);
    let cases = if all_cases() { 100_000 } else { 400 };
    let mut most = 0;
    for case in 0..cases {
        let mut some = |n: usize| -> Vec<Box3> {
            (0..n)
                .map(|_| {
                    let middle = random.point(1.0);
                    let half = Vec3::new(
                        random.within(0.1, 0.8),
                        random.within(0.1, 0.8),
                        random.within(0.1, 0.8),
                    );
                    [middle - half, middle + half]
                })
                .collect()
        };
        let (a, b) = (some(1 + case % 3), some(1 + case / 3 % 3));
        let turn = if case % 2 == 0 {
            Mat3::identity()
        } else {
            random.rotation()
        };
        let way = random.point(0.5);
        let exact = grid_depth(&a, &b, &way);
        let (body_a, body_b) = (boxes(&a, &turn), boxes(&b, &turn));
        let here = Pose::identity();
        let placed = Pose::from_translation(turn * way);
        if exact < 1e-9 {
            continue;
        }
        let found = depth((&body_a, &placed), (&body_b, &here));
        most = most.max(found.steps);
        assert!(
            found.lower <= exact + 1e-12 && found.upper >= exact - 1e-12,
            "case {case}: {} in {} .. {}",
            exact,
            found.lower,
            found.upper
        );
        assert!(
            found.is_tight && found.upper - found.lower < 1e-11,
            "case {case}: {found:?}, {exact}"
        );
    }
    println!("{cases} unions of boxes, at most {most} steps");
}

#[test]
fn bodies_of_the_plane_stay_in_it() {
    let square = |x: f64, y: f64| {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        corners.map(|(u, v)| Vec3::new(x + u, y + v, 0.0))
    };
    let built = |parts: &[(f64, f64)]| {
        let mut builder = BodyBuilder::new(2).unwrap();
        for &(x, y) in parts {
            builder.add_polygon(&square(x, y), 0).unwrap();
        }
        builder
            .build(&HierarchyOptions::default(), &mut |_| Ok(()))
            .unwrap()
    };
    // Two squares side by side: the way out of one along x leads into the other.
    let (a, b) = (built(&[(0.0, 0.0)]), built(&[(-0.75, 0.0), (0.75, 0.0)]));
    let found = depth((&a, &at(-0.5, 0.5, 0.0)), (&b, &at(0.0, 0.0, 0.0)));
    assert!(
        (found.lower - 1.5).abs() < 1e-11 && (found.upper - 1.5).abs() < 1e-11,
        "{found:?}"
    );
    assert!(
        (found.translation - Vec3::new(0.0, 1.5, 0.0)).norm() < 1e-11,
        "{found:?}"
    );
    // A disc in the corner of two squares: out to where it touches the corner, or across a side.
    let mut builder = BodyBuilder::new(2).unwrap();
    builder.add_sphere(&Vec3::zeros(), 0.5, 0).unwrap();
    let disc = builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap();
    let found = depth_to(
        (&disc, &at(1.3, 1.3, 0.0)),
        (&a, &at(0.0, 0.0, 0.0)),
        1e-9,
        2000,
    );
    let exact = 0.5 - 0.3 * 2f64.sqrt();
    assert!(
        (found.lower - exact).abs() < 1e-9 && (found.upper - exact).abs() < 1e-9,
        "{found:?}"
    );
}

#[test]
fn no_translation_below_the_bound_parts_round_unions() {
    let mut random = Random::new(7);
    for case in 0..if all_cases() { 300 } else { 12 } {
        let union = built(|builder| {
            for i in 0..3 + case % 6 {
                let half = Vec3::new(
                    random.within(0.2, 0.6),
                    random.within(0.2, 0.6),
                    random.within(0.2, 0.6),
                );
                let pose = Pose::from_translation(random.point(0.8));
                builder.add_box(&pose, &half, i).unwrap();
            }
        });
        let round = built(|builder| {
            let axes = Vec3::new(1.0, 0.5, 0.3);
            match case % 3 {
                0 => builder.add_ellipsoid(&Pose::identity(), &axes, 0).unwrap(),
                1 => builder.add_sphere(&Vec3::zeros(), 0.6, 0).unwrap(),
                _ => builder.add_cone(&Pose::identity(), 0.5, 1.0, 0).unwrap(),
            }
        });
        let (here, there) = (random.pose(0.3), Pose::identity());
        let found = depth_or_apart((&union, &here), (&round, &there));
        if !found.meet {
            continue;
        }
        check((&union, &here), (&round, &there), &found);
        let best = found.translation.normalize();
        for i in 0..3000 {
            let near = best + 0.2 * random.unit() * random.within(0.0, 1.0);
            let direction = if i % 2 == 0 {
                near.normalize()
            } else {
                random.unit()
            };
            let way = direction * found.lower * random.within(0.8, 0.9999);
            let away = moved(&here, &way);
            let met = QueryContext::new().pair_within((&union, &away), (&round, &there), 0.0);
            assert!(
                met.unwrap(),
                "case {case}: {} parts them: {found:?}",
                way.norm()
            );
        }
    }
}

fn solid(shape: &Shape) -> Body {
    built(|builder| {
        for part in &shape.parts {
            builder.add_polygon(part, 0).unwrap();
        }
        builder.set_solid(true);
    })
}

/// A solid whose boundary is convex has the depth of the polyhedron, which penetrations have in closed form.
#[test]
fn convex_solids_are_as_deep_as_polyhedra() {
    let mut random = Random::new(77);
    let corners = |side: f64| -> Vec<Vec3> {
        let all = cube_surface(side).parts.into_iter().flatten();
        all.collect()
    };
    let whole = |side: f64| built(|builder| builder.add_polyhedron(&corners(side), 0).unwrap());
    let solids = [solid(&cube_surface(2.0)), solid(&cube_surface(1.0))];
    let wholes = [whole(2.0), whole(1.0)];
    let mut deep = 0;
    for _ in 0..300 {
        let poses = [0, 1].map(|_| random.pose(0.8));
        let (a, b) = ((&wholes[0], &poses[0]), (&wholes[1], &poses[1]));
        let exact = QueryContext::new().pair_penetration(a, b, 1).unwrap();
        let exact = exact
            .penetrations
            .first()
            .map_or(0.0, |deepest| deepest.penetration.depth);
        for bodies in [[&solids[0], &solids[1]], [&wholes[0], &solids[1]]] {
            let (a, b) = ((bodies[0], &poses[0]), (bodies[1], &poses[1]));
            let found = depth_to(a, b, 1e-9, 1000);
            assert!(found.is_tight && found.steps < 200, "{found:?}");
            assert!(
                found.lower <= exact + 1e-13 && exact <= found.upper + 1e-12,
                "{exact} {found:?}"
            );
            assert!(found.upper - found.lower < 1e-9, "{exact} {found:?}");
        }
        deep += usize::from(exact > 0.0);
    }
    assert!(deep > 100);
    // What is dented, or is two pieces, is none.
    let dented = solid(&dented_ball(|| random.within(0.8, 1.0)));
    assert!(dented.convex_whole().is_none() && wholes[0].convex_whole().is_none());
}

#[test]
fn solids_have_bounds() {
    let (a, b) = (solid(&cube_surface(2.0)), solid(&cube_surface(1.0)));
    for (x, exact) in [(1.2, 0.3), (0.0, 1.5), (0.4, 1.1)] {
        let found = depth_to((&a, &at(0.0, 0.0, 0.0)), (&b, &at(x, 0.0, 0.0)), 0.02, 2000);
        println!("cube in cube at {x}: {found:?}");
        assert!(
            found.lower <= exact && found.upper >= exact - 1e-12,
            "{found:?}"
        );
        assert!(found.upper - exact < 0.02, "{found:?}");
    }
    let mut random = Random::new(4);
    let ball = solid(&dented_ball(|| random.within(0.8, 1.0)));
    let (here, there) = (at(0.0, 0.0, 0.0), at(0.9, 0.1, 0.2));
    let found = depth_to((&ball, &here), (&b, &there), 0.02, 2000);
    println!("dented ball: {found:?}");
    assert!(found.lower > 0.0, "{found:?}");
    // By the definition: no shorter translation parts them.
    for _ in 0..1000 {
        let way = random.unit() * found.lower * random.within(0.0, 1.0).cbrt();
        let moved = moved(&here, &way);
        let met = QueryContext::new().pair_within((&ball, &moved), (&b, &there), 0.0);
        assert!(met.unwrap(), "{way} parts them, {found:?}");
    }
}
