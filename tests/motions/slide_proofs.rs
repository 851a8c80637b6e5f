//! What slides prove of their ways: pair by pair, so that bodies at rest relative to each other, or slow ones that nearly touch,
//! are not in the way of others; and never of a way that is not free.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, Class, InducedOptions, LeftOut, PureOptions, PureShape, SObjects};
use cstk::environment::{Attachment, Change};
use cstk::motion::{SlideOptions, SlideOutcome, SlideStep};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};

use helpers::random::Random;
use helpers::robots::{Screw, against, environment, link, robot, space};
use helpers::shapes::{cuboid, hull, planar};

fn slide_once(cobject: &CObject, q: &[f64], step: &[f64], options: &SlideOptions) -> SlideStep {
    QueryContext::new()
        .slide(cobject, q, step, options)
        .unwrap()
}

fn class(context: &mut QueryContext, cobject: &CObject, q: &[f64]) -> Class {
    context
        .classify(cobject, Configuration::Coordinates(q))
        .unwrap()
}

fn with_body(body: &Arc<Body>, x: f64, link: LinkDefinition) -> LinkDefinition {
    LinkDefinition {
        body: Some(body.clone()),
        at: Pose::from_translation(Vec3::new(x, 0.0, 0.0)),
        ..link
    }
}

/// A base that turns by 2 rad carries two links that are .014 apart and joined by a joint that rests.
#[test]
fn links_that_a_joint_below_carries_keep_their_distance() {
    let cube = cuboid([1.0; 3]).body;
    let links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        with_body(&cube, 3.0, link(Some(0), JointKind::Fixed, Vec3::z())),
        with_body(&cube, 1.014, link(Some(1), JointKind::Prismatic, Vec3::x())),
    ];
    let space = space(vec![robot(3, links)]);
    let itself = CObject::induced_links(space, &[[1, 2]], InducedOptions::default()).unwrap();
    let taken = slide_once(
        &itself,
        &[0.0; 2],
        &[2.0, 0.0],
        &SlideOptions::with_shell(0.1),
    );
    assert_eq!(taken.outcome, SlideOutcome::Moved);
    assert_eq!(taken.configuration, [2.0, 0.0]);
}

fn rectangle(low: [f64; 2], high: [f64; 2]) -> Arc<Body> {
    let corners = [
        [low[0], low[1]],
        [high[0], low[1]],
        [high[0], high[1]],
        [low[0], high[1]],
    ];
    planar(&[corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec()]).body
}

/// A base that creeps over a floor, and an arm on it.
fn creeper(gap: f64) -> Arc<Space> {
    let links = vec![
        LinkDefinition {
            body: Some(rectangle([-0.5, -1.0 + gap], [0.5, 0.0])),
            ..link(None, JointKind::Prismatic, Vec3::x())
        },
        LinkDefinition {
            body: Some(rectangle([0.6, -0.1], [2.0, 0.1])),
            ..link(Some(0), JointKind::Revolute, Vec3::z())
        },
    ];
    space(vec![robot(2, links)])
}

#[test]
fn a_slow_pair_that_nearly_touches_does_not_block_a_fast_one() {
    let floor = rectangle([-10.0, -2.0], [10.0, -1.0]);
    for gap in [0.0, 1e-7, 1e-6, 1e-4] {
        let cobject = against(&creeper(gap), &environment(&[(&floor, Pose::identity())]).0);
        let step = [1e-6, 0.5];
        let taken = slide_once(&cobject, &[0.0; 2], &step, &SlideOptions::with_shell(0.2));
        assert_eq!(taken.outcome, SlideOutcome::Moved, "gap {gap:e}: {taken:?}");
        assert_eq!(taken.configuration, step, "gap {gap:e}");
    }
}

/// However near the base is above the floor, and wherever it goes over it.
#[test]
fn a_base_slides_over_a_floor_at_any_height() {
    let floor = rectangle([-10.0, -2.0], [10.0, -1.0]);
    let world = environment(&[(&floor, Pose::identity())]).0;
    for gap in [0.0, 1e-9, 1e-7, 1e-6, 1e-4] {
        let space = creeper(gap);
        let half_space = PureShape::floor(&space, &[], &Vec3::y(), -1.0).unwrap();
        let over_object = against(&space, &world);
        let over_floor = CObject::pure(space, half_space, PureOptions::default()).unwrap();
        for (cobject, what) in [(over_object, "object"), (over_floor, "floor")] {
            for step in [[1e-6, 0.5], [0.3, 0.5], [-4.0, 0.1]] {
                let options = SlideOptions::with_shell(0.2);
                let taken = slide_once(&cobject, &[0.0; 2], &step, &options);
                let moved = taken.outcome == SlideOutcome::Moved;
                assert!(moved, "{what}, gap {gap:e}: {taken:?}");
                assert_eq!(taken.configuration, step, "{what}, gap {gap:e}");
            }
        }
    }
}

/// The base rests on the floor, or nearly: the arm comes down to the stand-off all the same.
#[test]
fn a_link_on_a_floor_does_not_hide_another() {
    for gap in [0.0, 1e-6] {
        let space = creeper(gap);
        let floor = PureShape::floor(&space, &[], &Vec3::y(), -1.0).unwrap();
        let cobject = CObject::pure(space, floor, PureOptions::default()).unwrap();
        let options = SlideOptions::with_shell(0.2);
        let mut q = vec![0.0; 2];
        let mut steps = 0;
        loop {
            let taken = slide_once(&cobject, &q, &[0.0, -0.05], &options);
            if taken.outcome != SlideOutcome::Moved {
                break;
            }
            steps += 1;
            q = taken.configuration;
        }
        // The lower corner of the tip is at the stand-off.
        let tip = 2.0 * q[1].sin() - 0.1 * q[1].cos();
        assert!((tip + 1.0 - 0.02).abs() < 2e-3, "gap {gap:e}: tip at {tip}");
        assert!(steps < 20, "{steps} steps");
    }
}

/// An object lies in a hand that carries it past a finger's breadth of another link of the hand: all three move as one.
#[test]
fn what_a_hand_holds_moves_with_the_hand() {
    let cube = cuboid([1.0; 3]).body;
    let far = |x: f64| Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    let links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        with_body(&cube, 3.0, link(Some(0), JointKind::Fixed, Vec3::z())),
        with_body(&cube, 5.0, link(Some(0), JointKind::Fixed, Vec3::z())),
    ];
    let space = space(vec![robot(3, links)]);
    for gap in [0.0, 1e-9, 1e-4] {
        let (world, ids) = environment(&[(&cube, far(0.0)), (&cube, far(-30.0))]);
        // Held by link 1, on which it rests, a gap from link 2.
        world
            .apply(&[Change::Attach {
                id: ids[0],
                pose: far(1.0 - gap),
                attachment: Attachment::new(&space, 1, &[]).unwrap(),
            }])
            .unwrap();
        let cobject = against(&space, &world);
        let taken = slide_once(&cobject, &[0.0], &[2.0], &SlideOptions::with_shell(0.1));
        assert_eq!(taken.outcome, SlideOutcome::Moved, "gap {gap:e}: {taken:?}");
        assert_eq!(taken.configuration, [2.0]);
    }
}

/// A coordinate that rests at the end of its range says nothing of another.
#[test]
fn a_coordinate_at_its_limit_does_not_hold_another() {
    let joint = |x: f64| {
        Some(Coordinate::Interval {
            lower: -x,
            upper: x,
        })
    };
    let links = vec![
        link(None, JointKind::Prismatic, Vec3::x()),
        link(Some(0), JointKind::Prismatic, Vec3::y()),
    ];
    let ranges = [joint(1.0), joint(5.0)];
    let world = WorldBox::unbounded();
    let space = Arc::new(Space::new(vec![robot(3, links)], &ranges, world).unwrap());
    let limits = CObject::pure(space, PureShape::BeyondLimits, PureOptions::default()).unwrap();
    let mut options = SlideOptions::with_shell(0.2);
    options.desired_distance = 0.0;
    let taken = slide_once(&limits, &[1.0, 0.0], &[0.0, 3.0], &options);
    assert_eq!(taken.outcome, SlideOutcome::Moved, "{taken:?}");
    assert_eq!(taken.configuration, [1.0, 3.0]);
}

const KINDS: [fn() -> JointKind; 8] = [
    || JointKind::Fixed,
    || JointKind::Revolute,
    || JointKind::Prismatic,
    || JointKind::Planar,
    || JointKind::Spherical,
    || JointKind::Free,
    || JointKind::FreeEuler,
    || JointKind::Custom(Arc::new(Screw)),
];

fn any_body(random: &mut Random) -> Arc<Body> {
    match random.below(3) {
        0 => cuboid([0.8, 0.8, 1e-3]).body,
        1 => cuboid([1e-2, 0.6, 1e-2]).body,
        _ => hull(&random.points(6, 0.4)).body,
    }
}

/// A robot of one to four links of any kinds, each on any of those before it, two of them in a space at times.
fn any_space(random: &mut Random) -> Arc<Space> {
    let robots = 1 + random.below(2);
    let robots = (0..robots).map(|_| {
        let length = 1 + random.below(4);
        let links = (0..length).map(|i| {
            let kind = KINDS[random.below(KINDS.len())]();
            let parent = (i > 0).then(|| random.below(i));
            let mut made = LinkDefinition {
                at: random.pose(1.0),
                body: Some(any_body(random)),
                ..link(parent, kind, random.point(1.0))
            };
            if made.kind.has_axis() {
                made.multiplier = random.within(-2.0, 2.0);
            }
            made
        });
        robot(3, links.collect())
    });
    space(robots.collect())
}

/// Links against plates, needles and hulls, one of them held; against each other where they do not meet at the start; and over
/// a floor.
fn any_set(random: &mut Random, space: &Arc<Space>, q: &[f64]) -> CObject {
    let bodies: Vec<Arc<Body>> = (0..5).map(|_| any_body(random)).collect();
    let placed: Vec<_> = bodies.iter().map(|body| (body, random.pose(2.0))).collect();
    let (world, ids) = environment(&placed);
    if random.below(2) == 0 {
        let link = random.below(space.link_count());
        world
            .apply(&[Change::Attach {
                id: ids[0],
                pose: random.pose(0.5),
                attachment: Attachment::new(space, link, &[]).unwrap(),
            }])
            .unwrap();
    }
    let options = InducedOptions {
        margin: [0.0, 0.02][random.below(2)],
        ..Default::default()
    };
    let objects = SObjects::All(world);
    let mut parts =
        vec![CObject::induced(space.clone(), &[], objects, LeftOut::default(), options).unwrap()];
    let count = space.link_count();
    let pairs = (0..count).flat_map(|r| (r + 1..count).map(move |s| [r, s]));
    let mut context = QueryContext::new();
    for pair in pairs {
        let one = CObject::induced_links(space.clone(), &[pair], options).unwrap();
        if class(&mut context, &one, q) != Class::Inside {
            parts.push(one);
        }
    }
    let floor = PureShape::floor(space, &[], &Vec3::z(), -2.5).unwrap();
    parts.push(CObject::pure(space.clone(), floor, PureOptions::default()).unwrap());
    let parts: Vec<Arc<CObject>> = parts.into_iter().map(Arc::new).collect();
    CObject::union(&parts).unwrap()
}

#[test]
fn no_way_that_was_moved_along_meets_anything() {
    let mut random = Random::new(67);
    let (mut moved, mut near, mut blocked) = (0, 0, 0);
    for _ in 0..160 {
        let space = any_space(&mut random);
        let start: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.5, 1.5)).collect();
        let mut q = space.step(&space.neutral(), &start);
        let cobject = any_set(&mut random, &space, &q);
        let mut context = QueryContext::new();
        if class(&mut context, &cobject, &q) == Class::Inside {
            continue;
        }
        let mut options = SlideOptions::with_shell(random.within(0.02, 0.3));
        options.desired_distance *= [1.0, 1.0, 1e-3, 1e-6, 0.0][random.below(5)];
        let size = [0.05, 0.3, 2.0][random.below(3)];
        let mut step = Vec::new();
        for k in 0..12 {
            // Long enough in one direction to come near something and go on along it.
            if k % 6 == 0 {
                step = (0..space.nv())
                    .map(|_| random.within(-size, size))
                    .collect();
            }
            let taken = context.slide(&cobject, &q, &step, &options).unwrap();
            if taken.outcome != SlideOutcome::Moved {
                blocked += 1;
                continue;
            }
            moved += 1;
            near += usize::from(taken.distance_before < 1e-3 * options.max_shell);
            let way = space.displacement(&q, &taken.configuration);
            for k in 1..=1000 {
                let part: Vec<f64> = way.iter().map(|x| x * f64::from(k) / 1000.0).collect();
                let at = space.step(&q, &part);
                let class = class(&mut context, &cobject, &at);
                assert_ne!(class, Class::Inside, "{k} of 1000: {q:?} by {way:?}");
            }
            q = taken.configuration;
        }
    }
    assert!(moved > 100, "{moved} moved, {blocked} not");
    assert!(near > 10, "{near} of {moved} from near contact");
}
