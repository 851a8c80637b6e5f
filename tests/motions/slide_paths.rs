//! Slides over many steps: into corners, through corridors, round vertices, along limits; without trembling, and blocked
//! only where nothing is left. And the two halves of a step (`slide-step`, `compute-spring-step`) by themselves.

use std::sync::Arc;

use cstk::cobject::CObject;
use cstk::motion::{Approach, SlideOptions, SlideOutcome, SlideStep, slide_step, spring_step};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};

use helpers::differences::distance;
use helpers::robots::{Screw, against, environment, link, robot, space};
use helpers::shapes::{Shape, planar};

fn rectangle(low: [f64; 2], high: [f64; 2]) -> Shape {
    let corners = [
        [low[0], low[1]],
        [high[0], low[1]],
        [high[0], high[1]],
        [low[0], high[1]],
    ];
    planar(&[corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec()])
}

/// A unit square that moves in the plane, by x, y and angle, among obstacles.
fn square_among(obstacles: &[Shape], ranges: &[Option<Coordinate>], world: WorldBox) -> CObject {
    let body = rectangle([-0.5; 2], [0.5; 2]).body;
    let one = LinkDefinition {
        body: Some(body),
        ..link(None, JointKind::Planar, Vec3::z())
    };
    let space = Arc::new(Space::new(vec![robot(2, vec![one])], ranges, world).unwrap());
    let placed: Vec<_> = obstacles
        .iter()
        .map(|shape| (&shape.body, Pose::identity()))
        .collect();
    against(&space, &environment(&placed).0)
}

fn free_square(obstacles: &[Shape]) -> CObject {
    square_among(obstacles, &[], WorldBox::unbounded())
}

/// All steps of a slide, up to the first that does not move, which is the last.
fn slide(cobject: &CObject, start: &[f64], step: &[f64], options: &SlideOptions) -> Vec<SlideStep> {
    let mut query = QueryContext::new();
    let mut q = start.to_vec();
    let mut taken = Vec::new();
    for _ in 0..500 {
        let next = query.slide(cobject, &q, step, options).unwrap();
        q.clone_from(&next.configuration);
        let is_over = next.outcome != SlideOutcome::Moved;
        taken.push(next);
        if is_over {
            break;
        }
    }
    taken
}

/// No step undoes the one before it.
fn steady(taken: &[SlideStep]) -> bool {
    let way = |two: &[SlideStep]| -> Vec<f64> {
        let [from, to] = [0, 1].map(|i| &two[i].configuration);
        from.iter().zip(to).map(|(a, b)| b - a).collect()
    };
    let ways: Vec<Vec<f64>> = taken.windows(2).map(way).collect();
    ways.windows(2).all(|two| {
        let dot: f64 = two[0].iter().zip(&two[1]).map(|(a, b)| a * b).sum();
        let lengths = two
            .iter()
            .map(|w| w.iter().map(|x| x * x).sum::<f64>().sqrt());
        dot >= -1e-9 * lengths.product::<f64>()
    })
}

fn options() -> SlideOptions {
    SlideOptions::with_shell(0.2)
}

#[test]
fn into_a_corner_and_blocked_there() {
    let floor = rectangle([-10.0, -2.0], [10.0, -1.0]);
    let wall = rectangle([2.0, -2.0], [3.0, 10.0]);
    let cobject = free_square(&[floor, wall]);
    let taken = slide(&cobject, &[0.0, 0.5, 0.0], &[0.05, -0.03, 0.0], &options());
    let last = taken.last().unwrap();
    assert_eq!(last.outcome, SlideOutcome::Blocked);
    assert!(taken.len() < 60 && steady(&taken), "{}", taken.len());
    // At the stand-off from both.
    assert!(
        (last.configuration[0] - (1.5 - 0.02)).abs() < 1e-3,
        "{:?}",
        last.configuration
    );
    assert!((last.configuration[1] - (-0.5 + 0.02)).abs() < 1e-3);
    // Asked again it stays, to the last bit.
    let again = slide(
        &cobject,
        &last.configuration,
        &[0.05, -0.03, 0.0],
        &options(),
    );
    assert_eq!(again.len(), 1);
    assert_eq!(again[0].configuration, last.configuration);
}

#[test]
fn through_a_corridor_narrower_than_the_stand_off_asks() {
    // 0.01 on either side of the square, where 0.02 are desired.
    let below = rectangle([-10.0, -2.0], [10.0, -0.51]);
    let above = rectangle([-10.0, 0.51], [10.0, 2.0]);
    let cobject = free_square(&[below, above]);
    for offset in [0.0, 0.003, -0.006] {
        let taken = slide(&cobject, &[0.0, offset, 0.0], &[0.05, 0.0, 0.0], &options());
        assert_eq!(taken.len(), 500);
        assert!(steady(&taken[3..]));
        let last = &taken[499];
        assert!(last.configuration[0] > 20.0, "{:?}", last.configuration);
        // Pushed to the middle, as far as that wins anything.
        assert!(
            last.configuration[1].abs() <= 0.001 + 1e-9,
            "{:?}",
            last.configuration
        );
    }
}

#[test]
fn round_a_vertex_and_on() {
    // A diamond whose corner points at the square's side; the square may turn.
    let diamond = [(3.0, 0.0), (4.0, -1.0), (5.0, 0.0), (4.0, 1.0)];
    let diamond = planar(&[diamond.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec()]);
    let cobject = free_square(&[diamond]);
    let taken = slide(&cobject, &[0.0, 0.1, 0.0], &[0.05, 0.0, 0.0], &options());
    assert_eq!(taken.len(), 500);
    assert!(
        taken[499].configuration[0] > 8.0,
        "{:?}",
        taken[499].configuration
    );
    assert!(steady(&taken));
    let least = taken
        .iter()
        .map(|s| s.distance_after)
        .fold(f64::INFINITY, f64::min);
    assert!(least >= 0.02 * (1.0 - 1e-3), "{least}");
}

#[test]
fn ranges_and_world_box_are_slid_along() {
    let floor = rectangle([-10.0, -2.0], [10.0, -1.0]);
    let interval = |lower, upper| Some(Coordinate::Interval { lower, upper });
    let ranges = [interval(-1.0, 1.0), None, interval(0.3, 0.3)];
    let world = WorldBox {
        low: [-9.0, -9.0, -9.0],
        high: [9.0, 2.0, 9.0],
    };
    let cobject = square_among(&[floor], &ranges, world);
    // The angle is held, x ends at 1, y at the box.
    let taken = slide(&cobject, &[0.0, 0.5, 0.3], &[0.05, 0.05, 0.05], &options());
    let last = taken.last().unwrap();
    assert_eq!(last.outcome, SlideOutcome::Blocked);
    assert!(steady(&taken));
    for (got, want) in last.configuration.iter().zip([1.0, 2.0, 0.3]) {
        assert!((got - want).abs() < 1e-3, "{:?}", last.configuration);
    }
    assert!(taken.iter().all(|s| s.configuration[2] == 0.3));
    assert!(
        taken
            .iter()
            .all(|s| cobject.space().contains(&s.configuration).unwrap())
    );
}

#[test]
fn custom_joints_slide_if_they_state_their_speeds() {
    let body = helpers::shapes::cuboid([0.4, 0.4, 0.4]);
    let wall = helpers::shapes::cuboid([0.2, 4.0, 4.0]);
    let screw = LinkDefinition {
        body: Some(body.body.clone()),
        ..link(None, JointKind::Custom(Arc::new(Screw)), Vec3::z())
    };
    let space = space(vec![robot(3, vec![screw])]);
    let at = Pose::from_translation(Vec3::new(0.8, 0.0, 0.0));
    let cobject = against(&space, &environment(&[(&wall.body, at)]).0);
    let taken = slide(&cobject, &[0.0, 1.0], &[0.02, 0.05], &options());
    assert!(taken.len() > 20);
    for step in &taken {
        assert!(distance(&cobject, &step.configuration) > 0.0);
    }
}

#[test]
fn the_two_halves_of_a_step() {
    let (floor, wall) = ([0.0, 1.0], [-1.0, 0.0]);
    let at = |gradient, clearance| Approach {
        gradient,
        clearance,
    };
    let near = |got: Option<Vec<f64>>, want: [f64; 2]| {
        let got = got.unwrap();
        assert!(
            (got[0] - want[0]).abs() < 1e-12 && (got[1] - want[1]).abs() < 1e-12,
            "{got:?}"
        );
    };
    let slid = |approaches: &[Approach]| slide_step(&[0.3, -0.4], approaches, &[], 0.1, false);
    // Free, then down to the desired distance, then along, then nothing in the corner.
    near(slid(&[]), [0.3, -0.4]);
    near(slid(&[at(&floor[..], 0.25)]), [0.3, -0.15]);
    near(slid(&[at(&floor[..], 0.1)]), [0.3, 0.0]);
    near(slid(&[at(&floor[..], 0.02)]), [0.3, 0.0]);
    assert!(slid(&[at(&floor[..], 0.1), at(&wall[..], 0.1)]).is_none());
    // With the length kept.
    let kept = slide_step(&[0.3, -0.4], &[at(&floor[..], 0.1)], &[], 0.1, true);
    near(kept, [0.5, 0.0]);

    let sprung = |approaches: &[Approach]| spring_step(approaches, &[], 0.1);
    assert!(sprung(&[]).is_none() && sprung(&[at(&floor[..], 0.1)]).is_none());
    near(sprung(&[at(&floor[..], 0.04)]), [0.0, 0.06]);
    near(
        sprung(&[at(&floor[..], 0.04), at(&wall[..], 0.07)]),
        [-0.03, 0.06],
    );
    // Between two walls closer than that: to the middle.
    let roof = [0.0, -1.0];
    near(
        sprung(&[at(&floor[..], 0.02), at(&roof[..], 0.06)]),
        [0.0, 0.02],
    );
    // What no step can move is nobody's to spring from.
    let fixed = [0.0, 0.0];
    assert!(sprung(&[at(&fixed[..], 0.01)]).is_none());
}

/// Of a list that was cut the rest is unknown: a touching robot must not go on its word. 300 strips lie on the floor, and a
/// wall stands nearer than what a touching start takes on trust.
#[test]
fn no_trust_in_a_list_that_was_cut() {
    use cstk::robot::LinkDefinition;
    let strips: Vec<Vec<Vec3>> = (0..300)
        .map(|i| {
            let x = -1.5 + 0.01 * f64::from(i);
            [(0.0, 0.0), (0.009, 0.0), (0.009, 1.0), (0.0, 1.0)]
                .map(|(dx, y)| Vec3::new(x + dx, y, 0.0))
                .to_vec()
        })
        .collect();
    let comb = planar(&strips);
    let floor = rectangle([-10.0, -1.0], [10.0, 0.0]);
    let ahead = strips[299][1].x;
    let wall = rectangle([ahead + 5e-5, -1.0], [ahead + 6e-5, 9.0]);
    let one = LinkDefinition {
        body: Some(comb.body.clone()),
        ..link(None, JointKind::Planar, Vec3::z())
    };
    let space = space(vec![robot(2, vec![one])]);
    let placed = [
        (&floor.body, Pose::identity()),
        (&wall.body, Pose::identity()),
    ];
    let cobject = against(&space, &environment(&placed).0);
    let mut options = SlideOptions::with_shell(1.0);
    for most in [1, 256, 1000] {
        options.max_witnesses = most;
        let step = QueryContext::new()
            .slide(&cobject, &[0.0; 3], &[1.0, 0.0, 0.0], &options)
            .unwrap();
        assert!(step.configuration[0] < 5e-5, "{most}: {step:?}");
    }
}

/// However large the shell, only a part of the link's own size is taken on trust.
#[test]
fn a_large_shell_proves_nothing() {
    let floor = rectangle([-10.0, -2.0], [10.0, -1.0]);
    let post = rectangle([2.0, -1.0], [2.5, 10.0]);
    let cobject = free_square(&[floor, post]);
    for shell in [0.5, 1e3, 1e5, 1e9] {
        let mut options = SlideOptions::with_shell(shell);
        options.desired_distance = 0.01;
        let step = QueryContext::new()
            .slide(&cobject, &[0.0, -0.5, 0.0], &[4.0, 0.1, 0.0], &options)
            .unwrap();
        assert!(step.configuration[0] < 1.5, "{shell:e}: {step:?}");
    }
}

/// Two bodies that one joint carries along keep their distance, whatever rounding says of it; they are not in the way.
#[test]
fn what_moves_as_one_is_not_in_the_way() {
    use cstk::cobject::InducedOptions;
    let mut links = vec![
        link(None, JointKind::Revolute, Vec3::new(0.3, 0.5, 0.8)),
        link(Some(0), JointKind::Fixed, Vec3::z()),
        link(Some(0), JointKind::Fixed, Vec3::z()),
    ];
    let body = helpers::shapes::cuboid([1.0; 3]).body;
    for (link, x) in links[1..].iter_mut().zip([0.3, 1.35]) {
        link.body = Some(body.clone());
        link.at = Pose::from_translation(Vec3::new(x, 0.7, -0.2));
    }
    let space = space(vec![robot(3, links)]);
    let options = InducedOptions::default();
    let cobject = CObject::induced_links(space, &[[1, 2]], options).unwrap();
    let mut slide = SlideOptions::with_shell(0.5);
    slide.desired_distance = 0.1;
    for step in [0.1, -0.1] {
        let taken = QueryContext::new()
            .slide(&cobject, &[0.4], &[step], &slide)
            .unwrap();
        assert_eq!(taken.outcome, SlideOutcome::Moved);
        assert!(
            (taken.configuration[0] - 0.4 - step).abs() < 1e-12,
            "{taken:?}"
        );
    }
}

/// A base that no joint moves may stand on the floor, or a hair above it: the arm slides all the same.
#[test]
fn a_base_on_the_floor_is_not_in_the_way() {
    let floor = rectangle([-10.0, -2.0], [10.0, -1.0]);
    for gap in [0.0, 1e-9, 1e-6, 1e-4] {
        let links = vec![
            LinkDefinition {
                body: Some(rectangle([-0.5, -1.0 + gap], [0.5, 0.0]).body),
                ..link(None, JointKind::Fixed, Vec3::z())
            },
            LinkDefinition {
                body: Some(rectangle([0.2, -0.1], [2.0, 0.1]).body),
                ..link(Some(0), JointKind::Revolute, Vec3::z())
            },
        ];
        let space = space(vec![robot(2, links)]);
        let cobject = against(&space, &environment(&[(&floor.body, Pose::identity())]).0);
        let taken = slide(&cobject, &[1.0], &[-0.05], &options());
        // Down to the stand-off of the arm's tip, and blocked there.
        let last = taken.last().unwrap();
        assert_eq!(last.outcome, SlideOutcome::Blocked);
        let q = last.configuration[0];
        let tip = 2.0 * q.sin() - 0.1 * q.cos();
        assert!((tip + 1.0 - 0.02).abs() < 2e-3, "gap {gap:e}: tip at {tip}");
    }
}
