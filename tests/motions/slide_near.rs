//! Slides that stay a hair above what they slide along: whole steps are taken, however near, where nothing is in the way. The ways
//! have closed forms: a box that moves without turning keeps its height.

use std::f64::consts::PI;
use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, Class, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Attachment, Change};
use cstk::motion::{SlideOptions, SlideOutcome, SlideStep};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};

use helpers::robots::{against, against_with, environment, link, robot, space};
use helpers::shapes::{cuboid, hull, mesh};

const GAPS: [f64; 6] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

fn slide_once(cobject: &CObject, q: &[f64], step: &[f64], options: &SlideOptions) -> SlideStep {
    QueryContext::new()
        .slide(cobject, q, step, options)
        .unwrap()
}

fn class(cobject: &CObject, q: &[f64]) -> Class {
    QueryContext::new()
        .classify(cobject, Configuration::Coordinates(q))
        .unwrap()
}

/// Slides at whatever distance the start has.
fn keeping_distance(desired_distance: f64) -> SlideOptions {
    SlideOptions {
        desired_distance,
        ..SlideOptions::with_shell(0.1)
    }
}

/// A floor at z = 0 of 20 by 20 and walls upon it at x = 6 and y = 6, one body of triangles: no plane separates it from what stands
/// in the room.
fn room() -> Arc<Body> {
    let corners = [
        [-10.0, -10.0, 0.0],
        [10.0, -10.0, 0.0],
        [10.0, 10.0, 0.0],
        [-10.0, 10.0, 0.0],
        [6.0, -10.0, 0.0],
        [6.0, 10.0, 0.0],
        [6.0, 10.0, 3.0],
        [6.0, -10.0, 3.0],
        [-10.0, 6.0, 0.0],
        [10.0, 6.0, 0.0],
        [10.0, 6.0, 3.0],
        [-10.0, 6.0, 3.0],
    ];
    let faces = [0, 4, 8].map(|i| [[i, i + 1, i + 2], [i, i + 2, i + 3]]);
    mesh(&corners.map(Vec3::from), &faces.concat()).body
}

/// A box of 1 by 1 by 1 that moves along x, y and z and turns about z; at 0 its lower face is `height` above z = 0.
fn base(height: f64) -> Vec<LinkDefinition> {
    let mut links: Vec<LinkDefinition> = [Vec3::x(), Vec3::y(), Vec3::z()]
        .into_iter()
        .enumerate()
        .map(|(i, axis)| link(i.checked_sub(1), JointKind::Prismatic, axis))
        .collect();
    links.push(LinkDefinition {
        body: Some(cuboid([1.0; 3]).body),
        at: Pose::from_translation(Vec3::new(0.0, 0.0, 0.5 + height)),
        ..link(Some(2), JointKind::Revolute, Vec3::z())
    });
    links
}

fn base_in_room(height: f64) -> CObject {
    let placed = [(&room(), Pose::identity())];
    against(
        &space(vec![robot(3, base(height))]),
        &environment(&placed).0,
    )
}

fn near(got: &[f64], want: &[f64], tolerance: f64) -> bool {
    got.iter()
        .zip(want)
        .all(|(got, want)| (got - want).abs() <= tolerance)
}

/// 2 m in one step, straight or turning.
#[test]
fn a_base_a_hair_above_the_floor_of_a_room_takes_whole_steps() {
    for gap in GAPS {
        let cobject = base_in_room(gap);
        let q = [0.1, -0.3, 0.0, 0.0];
        for step in [
            [2.0, 0.0, 0.0, 0.0],
            [-1.5, 1.0, 0.0, 0.0],
            [0.5, 0.2, 0.0, 0.3],
        ] {
            let taken = slide_once(&cobject, &q, &step, &keeping_distance(0.0));
            let want: Vec<f64> = q.iter().zip(&step).map(|(q, v)| q + v).collect();
            let moved = taken.outcome == SlideOutcome::Moved;
            assert!(moved, "gap {gap:e}, {step:?}: {taken:?}");
            assert!(near(&taken.configuration, &want, 1e-12), "{taken:?}");
            for distance in [taken.distance_before, taken.distance_after] {
                assert!((distance - gap).abs() < 1e-14, "{gap:e}: {taken:?}");
            }
        }
    }
}

/// A hair from the floor and from a wall: along both it goes on, down and into the wall it does not.
#[test]
fn a_base_in_a_corner_slides_along_it() {
    for gap in GAPS {
        let cobject = base_in_room(gap);
        let q = [0.0, 5.5 - gap, 0.0, 0.0];
        let step = [-3.0, 0.5, 0.0, 0.0];
        let taken = slide_once(&cobject, &q, &step, &keeping_distance(gap));
        assert_eq!(taken.outcome, SlideOutcome::Moved, "gap {gap:e}: {taken:?}");
        let [x, y] = [taken.configuration[0], taken.configuration[1]];
        assert!((x + 3.0).abs() < 1e-3, "gap {gap:e}: {taken:?}");
        assert!(y <= 5.5 && y >= q[1] - 1e-6, "gap {gap:e}: {taken:?}");
        let into = slide_once(&cobject, &q, &[0.0, 1.0, 0.0, 0.0], &keeping_distance(gap));
        assert_eq!(into.outcome, SlideOutcome::Blocked, "gap {gap:e}: {into:?}");
    }
}

/// A wall ahead still stops it, at the stand-off.
#[test]
fn a_wall_ahead_stops_a_base_above_a_floor() {
    for gap in GAPS {
        let cobject = base_in_room(gap);
        let mut q = vec![0.0; 4];
        for _ in 0..200 {
            let taken = slide_once(&cobject, &q, &[0.9, 0.0, 0.0, 0.0], &keeping_distance(gap));
            for k in 0..=100 {
                let part = f64::from(k) / 100.0;
                let between = q.iter().zip(&taken.configuration);
                let between: Vec<f64> = between.map(|(a, b)| a + part * (b - a)).collect();
                assert_ne!(class(&cobject, &between), Class::Inside);
            }
            q = taken.configuration;
            if taken.outcome != SlideOutcome::Moved {
                break;
            }
        }
        assert!((q[0] - 5.5).abs() < 2e-3, "gap {gap:e}: {q:?}");
        assert!(q[0] < 5.5, "gap {gap:e}: {q:?}");
    }
}

/// A carriage a hair above its rail, which a turning column carries: both links move, and so does the plane between them.
#[test]
fn a_carriage_on_a_rail_that_moves_is_not_blocked() {
    let rail = cuboid([8.0, 0.4, 0.2]).body;
    let carriage = cuboid([0.5, 0.5, 0.3]).body;
    for gap in GAPS {
        let links = vec![
            LinkDefinition {
                body: Some(rail.clone()),
                ..link(None, JointKind::Revolute, Vec3::new(0.6, 0.0, 0.8))
            },
            LinkDefinition {
                body: Some(carriage.clone()),
                at: Pose::from_translation(Vec3::new(0.0, 0.0, 0.25 + gap)),
                ..link(Some(0), JointKind::Prismatic, Vec3::x())
            },
        ];
        let space = space(vec![robot(3, links)]);
        let itself = CObject::induced_links(space, &[[0, 1]], InducedOptions::default()).unwrap();
        let step = [0.7, 1.5];
        let taken = slide_once(&itself, &[0.2, -0.4], &step, &keeping_distance(0.0));
        assert_eq!(taken.outcome, SlideOutcome::Moved, "gap {gap:e}: {taken:?}");
        assert!(
            near(&taken.configuration, &[0.9, 1.1], 1e-12),
            "gap {gap:e}: {taken:?}"
        );
    }
}

/// What a base drags along, a hair above the floor of the room, is no hindrance.
#[test]
fn a_held_object_a_hair_above_the_floor_moves_on() {
    let crate_body = cuboid([0.4; 3]).body;
    for gap in GAPS {
        let space = space(vec![robot(3, base(0.2))]);
        let far = Pose::from_translation(Vec3::new(0.0, 0.0, 50.0));
        let (world, ids) = environment(&[(&room(), Pose::identity()), (&crate_body, far)]);
        world
            .apply(&[Change::Attach {
                id: ids[1],
                pose: Pose::from_translation(Vec3::new(1.0, 0.0, gap - 0.5)),
                attachment: Attachment::new(&space, 3, &[]).unwrap(),
            }])
            .unwrap();
        let objects = SObjects::All(world);
        let options = InducedOptions::default();
        let cobject = CObject::induced(space, &[], objects, LeftOut::default(), options).unwrap();
        let q = [-2.0, 0.0, 0.0, 0.0];
        let step = [1.5, 0.5, 0.0, 0.0];
        let taken = slide_once(&cobject, &q, &step, &keeping_distance(0.0));
        assert_eq!(taken.outcome, SlideOutcome::Moved, "gap {gap:e}: {taken:?}");
        let want = [-0.5, 0.5, 0.0, 0.0];
        assert!(near(&taken.configuration, &want, 1e-12), "{taken:?}");
    }
}

/// Touching a floor without walls: along it and away from it, never down; inside is told.
#[test]
fn a_base_that_touches_a_floor_goes_along_it_and_up() {
    let corners = [
        [-10.0, -10.0, 0.0],
        [10.0, -10.0, 0.0],
        [10.0, 10.0, 0.0],
        [-10.0, 10.0, 0.0],
    ];
    let floor = mesh(&corners.map(Vec3::from), &[[0, 1, 2], [0, 2, 3]]).body;
    let world = environment(&[(&floor, Pose::identity())]).0;
    let with_height = |height: f64| against(&space(vec![robot(3, base(height))]), &world);
    let options = keeping_distance(0.0);
    let cobject = with_height(0.0);
    for step in [
        [2.0, 0.5, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.5 * PI],
        [0.0, 0.0, 1.0, 0.0],
        [1.0, 0.0, 0.5, 0.0],
        [0.3, 0.2, 1e-3, 0.2],
    ] {
        let taken = slide_once(&cobject, &[0.0; 4], &step, &options);
        assert_eq!(taken.outcome, SlideOutcome::Moved, "{step:?}: {taken:?}");
        assert!(
            near(&taken.configuration, &step, 1e-9),
            "{step:?}: {taken:?}"
        );
    }
    let down = slide_once(&cobject, &[0.0; 4], &[0.0, 0.0, -0.1, 0.0], &options);
    assert_eq!(down.outcome, SlideOutcome::Blocked, "{down:?}");
    let sunk = slide_once(
        &with_height(-1e-3),
        &[0.0; 4],
        &[1.0, 0.0, 0.0, 0.0],
        &options,
    );
    assert_eq!(sunk.outcome, SlideOutcome::Inside, "{sunk:?}");
}

/// Of two contacts one may touch while another is a hair away, and the free one ahead is met all the same.
#[test]
fn a_touching_pair_does_not_hide_a_near_one() {
    let slab = cuboid([20.0, 20.0, 1.0]).body;
    let post = cuboid([0.2, 0.2, 0.4]).body;
    let at = |x: f64, y: f64, z: f64| Pose::from_translation(Vec3::new(x, y, z));
    let placed = [(&slab, at(0.0, 0.0, -0.5)), (&post, at(2.0, 0.4, 0.2))];
    let cobject = against(&space(vec![robot(3, base(0.0))]), &environment(&placed).0);
    let mut options = keeping_distance(0.0);
    options.max_shell = 0.3;
    for length in [0.5, 1.0, 1.39, 1.6, 3.0, 8.0] {
        let taken = slide_once(&cobject, &[0.0; 4], &[length, 0.0, 0.0, 0.0], &options);
        let x = taken.configuration[0];
        // The post begins at x = 1.9, the base reaches .5 ahead.
        assert!(x < 1.4, "{length}: {taken:?}");
        assert!(length > 1.4 || x == length, "{length}: {taken:?}");
    }
}

/// However long the shell, and whatever moves: what is inside is not moved.
#[test]
fn a_start_inside_is_told_with_any_shell() {
    let cube = cuboid([2.0; 3]).body;
    let moving = LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.0, 10.0, 0.0)),
        body: Some(cube.clone()),
        ..link(None, JointKind::Prismatic, Vec3::x())
    };
    let resting = LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Fixed, Vec3::x())
    };
    let space = space(vec![robot(3, vec![moving, resting])]);
    let at = Pose::from_translation(Vec3::new(2.05, 0.0, 0.0));
    let (world, _) = environment(&[(&cube, at)]);
    let options = InducedOptions {
        margin: 0.1,
        ..InducedOptions::default()
    };
    let cell = against_with(&space, &world, options);
    assert_eq!(class(&cell, &[0.0]), Class::Inside);
    for shell in [0.5, 1e6, 1e8, 1e9, 1e20] {
        let found = slide_once(&cell, &[0.0], &[-0.1], &SlideOptions::with_shell(shell));
        assert_eq!(found.outcome, SlideOutcome::Inside, "shell {shell}");
    }
}

/// A link that moves along z, at 0 with its lowest point at z = 0.
fn lifted(body: &Arc<Body>) -> LinkDefinition {
    LinkDefinition {
        body: Some(body.clone()),
        ..link(None, JointKind::Prismatic, Vec3::z())
    }
}

/// Surfaces have no inside, and a hair above and below them differ by less than what ties normals.
#[test]
fn what_is_apart_from_a_surface_does_not_pass_it() {
    let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let square = |half: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| corner(half * x, half * y))
    };
    let triangles = [[0, 1, 2], [0, 2, 3]];
    let plates = [
        hull(&square(10.0)).body,
        mesh(&square(10.0), &triangles).body,
    ];
    let robots = [
        hull(&square(1.0)).body,
        mesh(&square(1.0), &triangles).body,
        hull(&[corner(-1.0, 0.0), corner(1.0, 0.5)]).body,
        hull(&[corner(0.3, 0.2)]).body,
    ];
    let mut apart = 0;
    for (plate, body) in plates
        .iter()
        .flat_map(|plate| robots.iter().map(move |body| (plate, body)))
    {
        let space = space(vec![robot(3, vec![lifted(body)])]);
        let cobject = against(&space, &environment(&[(plate, Pose::identity())]).0);
        for gap in [1e-13, 2e-13, 5e-13, 1e-12, 1e-11, 1e-10, 1e-9] {
            for side in [-1.0, 1.0] {
                let q = [side * gap];
                if class(&cobject, &q) != Class::Outside {
                    continue;
                }
                apart += 1;
                let list = QueryContext::new()
                    .gradients(&cobject, &q, 1e-3, 10)
                    .unwrap();
                assert!(!list.contacts.is_empty());
                for contact in &list.contacts {
                    assert!(
                        (contact.normal.z - side).abs() < 1e-9,
                        "{gap:e}: {contact:?}"
                    );
                }
                for (desired, shell, length) in [
                    (0.0, 1.0, 0.5),
                    (0.0, 10.0, 1e-4),
                    (1e-4, 1.0, 0.5),
                    (1e-4, 10.0, 1e-6),
                ] {
                    let mut options = keeping_distance(desired);
                    options.max_shell = shell;
                    let taken = slide_once(&cobject, &q, &[-side * length], &options);
                    assert!(
                        taken.configuration[0] * side > 0.0,
                        "{gap:e}, {side}: {taken:?}"
                    );
                }
            }
        }
    }
    assert!(apart > 80, "{apart}");
}

/// However thin beside the shell: what was proved apart before is not passed.
#[test]
fn what_is_apart_from_a_thin_plate_does_not_pass_it() {
    let mut apart = 0;
    for thickness in [1e-9, 1e-8, 5e-8, 1e-6] {
        let plate = cuboid([6.0, 6.0, thickness]).body;
        let body = cuboid([2.0, 2.0, 2e-8]).body;
        let space = space(vec![robot(3, vec![lifted(&body)])]);
        let below = Pose::from_translation(Vec3::new(0.0, 0.0, -0.5 * thickness));
        let cobject = against(&space, &environment(&[(&plate, below)]).0);
        for gap in [5e-14, 1e-12, 5e-12, 1e-11, 1e-10] {
            let q = [1e-8 + gap];
            if class(&cobject, &q) != Class::Outside {
                continue;
            }
            apart += 1;
            for (shell, length) in [
                (10.0, 1e-6),
                (10.0, 2.0 * thickness),
                (1e3, 1e-5),
                (0.1, 1e-6),
            ] {
                let mut options = SlideOptions::with_shell(shell);
                let mut desired = options.desired_distance;
                for _ in 0..2 {
                    options.desired_distance = desired;
                    let taken = slide_once(&cobject, &q, &[-length], &options);
                    assert!(
                        taken.configuration[0] > 0.0,
                        "{thickness:e} {gap:e}: {taken:?}"
                    );
                    desired = 0.0;
                }
            }
        }
    }
    assert!(apart > 10, "{apart}");
}

/// A tip that swings along a plate a hair above it dips, and comes to its edge: the end of the way is apart, but not all of it.
#[test]
fn a_tip_that_swings_past_an_edge_does_not_cut_it() {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let mut points = vec![Vec3::z()];
    points.extend(corners.map(|(x, y)| Vec3::new(x, y, 2.0)));
    let link = LinkDefinition {
        body: Some(hull(&points).body),
        ..link(None, JointKind::Revolute, Vec3::y())
    };
    let space = space(vec![robot(3, vec![link])]);
    let mut moved = 0;
    for (edge, gap) in [(3.5e-5, 5e-12), (3e-5, 1e-13), (5e-6, 1e-11), (1.0, 5e-12)] {
        let plate = cuboid([2.0 + edge, 2.0, 0.1]).body;
        let middle = Vec3::new(0.5 * edge - 1.0, 0.0, 0.95 - gap);
        let at = Pose::from_translation(middle);
        let cobject = against(&space, &environment(&[(&plate, at)]).0);
        assert_eq!(class(&cobject, &[0.0]), Class::Outside);
        for (length, desired) in [
            (4e-5, 0.0),
            (4e-5, 1e-6),
            (1e-6, 0.0),
            (1e-3, 0.0),
            (-1e-3, 0.0),
        ] {
            let mut options = keeping_distance(desired);
            options.max_shell = 1.0;
            let taken = slide_once(&cobject, &[0.0], &[length], &options);
            moved += usize::from(taken.outcome == SlideOutcome::Moved);
            for i in 0..=1000 {
                let q = [taken.configuration[0] * f64::from(i) / 1000.0];
                assert_eq!(
                    class(&cobject, &q),
                    Class::Outside,
                    "{edge} {gap:e} {length}: {taken:?}"
                );
            }
        }
    }
    println!("{moved} moved");
}
