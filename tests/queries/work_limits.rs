//! Limits of the work of a query: what needs more fails and says so, what needs no more is answered as without a limit.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, InducedOptions};
use cstk::error::{ErrorKind, Result};
use cstk::hierarchy::HierarchyOptions;
use cstk::motion::{MotionOptions, MotionOutcome, SlideOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DepthOptions, LinkPairOptions, QueryContext, Shell};
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::checked::at;
use helpers::random::Random;
use helpers::robots::{against_with, environment, free_body, link, robot, space};
use helpers::shapes::hull;
use helpers::surfaces::{cube, solid, surface};

type Ask<'a> = Box<dyn Fn(&mut QueryContext) -> Result<String> + 'a>;

fn ask<'a>(with: impl Fn(&mut QueryContext) -> Result<String> + 'a) -> Ask<'a> {
    Box::new(with)
}

/// Asks fresh contexts: with the work that the question takes as the limit, and with less.
fn check(name: &str, ask: &Ask) {
    let mut free = QueryContext::new();
    let want = ask(&mut free).unwrap();
    let done = free.statistics();
    let needed = done.node_pairs + done.primitive_pairs;
    assert!(needed > 1, "{name} takes no work");
    assert!(done.primitive_distances <= done.primitive_pairs);

    let mut query = QueryContext::new();
    query.set_limit(Some(needed));
    assert_eq!(ask(&mut query).unwrap(), want, "{name}");

    for limit in [needed - 1, needed / 2, 1] {
        let mut query = QueryContext::new();
        query.set_limit(Some(limit));
        let error = ask(&mut query).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Limit, "{name}: {error}");
        assert!(error.message.contains(&limit.to_string()), "{error}");
        // It has stopped soon after: what one node, one ray or one search for pieces comes upon is counted at once. A search
        // looks at no box of a body twice; here there are fewer than 1,000.
        let done = query.statistics();
        let counted = done.node_pairs + done.primitive_pairs;
        assert!(counted <= limit + 1000, "{name}: {counted} of {limit}");
        // The context serves on.
        query.set_limit(None);
        assert_eq!(ask(&mut query).unwrap(), want, "{name}");
    }
}

/// The same triangle many times.
fn coincident(count: u64) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    for i in 0..count {
        let corners = [Vec3::zeros(), Vec3::x(), Vec3::y()];
        builder.add_polygon(&corners, i).unwrap();
    }
    let options = HierarchyOptions::default();
    Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap())
}

/// Small cubes in rows, each a piece of one body.
fn dust() -> Arc<Body> {
    let mut corners = Vec::new();
    for i in 0..60 {
        let place = Vec3::new(f64::from(i % 8), f64::from(i / 8), 0.0) * 0.1;
        let mut moved = cube(0.02);
        for p in &mut moved.vertices {
            *p += place - Vec3::new(0.35, 0.35, 0.0);
        }
        corners.push(moved);
    }
    surface(&corners)
}

#[test]
fn queries_of_two_bodies() {
    let mut random = Random::new(91);
    let here = Pose::identity();
    let there = at(0.3, 0.2, 0.1);
    let far = at(0.0, 0.0, 1.5);
    let ball = |random: &mut Random| hull(&(0..60).map(|_| random.unit()).collect::<Vec<_>>()).body;
    let balls = [ball(&mut random), ball(&mut random)];
    let triangles = coincident(300);
    let (dust, wall) = (dust(), solid(&[cube(2.0)]));
    let shell = surface(&[cube(1.0)]);
    let pairs: [(&str, &Arc<Body>, &Arc<Body>, &Pose); 4] = [
        ("surfaces", &shell, &shell, &there),
        ("coincident triangles", &triangles, &triangles, &here),
        ("surfaces apart", &shell, &triangles, &far),
        ("pieces in a solid", &dust, &wall, &here),
    ];
    for (name, a, b, pose) in pairs {
        let (a, b) = ((&**a, &here), (&**b, pose));
        let asks: Vec<(&str, Ask)> = vec![
            (
                "distance",
                ask(move |q| Ok(format!("{:?}", q.pair_distance(a, b, f64::INFINITY)?))),
            ),
            (
                "within",
                ask(move |q| Ok(format!("{:?}", q.pair_within(a, b, 0.01)?))),
            ),
            (
                "witnesses",
                ask(move |q| Ok(format!("{:?}", q.pair_witnesses(a, b, 2.0, 20)?))),
            ),
        ];
        for (query, ask) in &asks {
            check(&format!("{query} of {name}"), ask);
        }
    }
    let (a, b) = ((&*triangles, &here), (&*triangles, &here));
    // Pairs of edges count as well: 9 of two triangles, and the pair of their nodes.
    let mut query = QueryContext::new();
    let mut with_limit = |limit: Option<u64>| {
        query.set_limit(limit);
        query.pair_penetration(a, b, 5)
    };
    let want = with_limit(None).unwrap();
    let needed = 11 * 300 * 300;
    assert_eq!(
        with_limit(Some(needed / 2)).unwrap_err().kind,
        ErrorKind::Limit
    );
    let found = with_limit(Some(2 * needed)).unwrap();
    assert_eq!(format!("{found:?}"), format!("{want:?}"));
    // One pair of primitives, of whose difference some facets are looked at.
    let (a, b) = ((&*balls[0], &here), (&*balls[1], &there));
    let mut query = QueryContext::new();
    query.set_limit(Some(4));
    let error = query.pair_penetration(a, b, 1).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Limit);
    query.set_limit(Some(1000));
    assert_eq!(
        query.pair_penetration(a, b, 1).unwrap().penetrations.len(),
        1
    );
}

/// Depths also count what statistics do not show: limits are tried from one to enough.
#[test]
fn depths_of_two_bodies() {
    let mut random = Random::new(92);
    let ball = |random: &mut Random| hull(&(0..40).map(|_| random.unit()).collect::<Vec<_>>()).body;
    let balls = [ball(&mut random), ball(&mut random)];
    let (large, small) = (solid(&[cube(2.0)]), solid(&[cube(1.0)]));
    let (dust, near, inside) = (dust(), at(0.3, 0.2, 0.1), at(0.9, 0.1, 0.2));
    let pairs: [(&str, &Body, &Body, &Pose); 3] = [
        ("hulls", &balls[0], &balls[1], &near),
        ("solids", &large, &small, &inside),
        ("pieces in a solid", &dust, &large, &inside),
    ];
    let options = DepthOptions {
        max_steps: 100,
        ..DepthOptions::default()
    };
    for (name, a, b, pose) in pairs {
        let ask = |query: &mut QueryContext| {
            let found = query.pair_depth((a, &Pose::identity()), (b, pose), &options)?;
            Ok::<String, cstk::error::Error>(format!("{found:?}"))
        };
        let want = ask(&mut QueryContext::new()).unwrap();
        let (mut ended, mut enough) = (0, 0);
        for limit in (0..40).map(|power| 1u64 << power) {
            let mut query = QueryContext::new();
            query.set_limit(Some(limit));
            match ask(&mut query) {
                Ok(found) => {
                    assert_eq!(found, want, "{name} within {limit}");
                    enough += 1;
                }
                Err(error) => {
                    assert_eq!(error.kind, ErrorKind::Limit, "{name}: {error}");
                    assert!(error.message.contains(&limit.to_string()), "{error}");
                    assert_eq!(enough, 0, "{name}: {limit} ends what less did not");
                    let done = query.statistics();
                    let counted = done.node_pairs + done.primitive_pairs;
                    assert!(counted <= limit + 1000, "{name}: {counted} of {limit}");
                    // The context serves on.
                    query.set_limit(None);
                    assert_eq!(ask(&mut query).unwrap(), want, "{name}");
                    ended += 1;
                }
            }
            if enough == 2 {
                break;
            }
        }
        assert!(ended > 3 && enough == 2, "{name}: {ended} and {enough}");
    }
}

/// A chain of cubes.
fn chain() -> Arc<Space> {
    let body = surface(&[cube(0.5)]);
    let links = (0..5).map(|i: usize| {
        let mut next = link(i.checked_sub(1), JointKind::Revolute, Vec3::z());
        next.body = Some(body.clone());
        next.at = at(if i == 0 { 0.0 } else { 1.2 }, 0.0, 0.0);
        next
    });
    space(vec![robot(3, links.collect())])
}

#[test]
fn queries_of_cobjects() {
    let body = surface(&[cube(0.5)]);
    let space = space(vec![free_body(&body)]);
    let block = solid(&[cube(0.4)]);
    let mut objects = Vec::new();
    for i in 0..30 {
        let angle = f64::from(i) * 0.2;
        objects.push((&block, at(2.0 * angle.cos(), 2.0 * angle.sin(), 0.0)));
    }
    let (environment, _) = environment(&objects);
    let options = InducedOptions {
        margin: 0.0,
        contact_epsilon: 0.7,
    };
    let cobject: &CObject = &against_with(&space, &environment, options);
    let q = &[0.05, 0.02, 0.0, 0.1, 0.2, 0.3];
    let at = Configuration::Coordinates(q);
    let shell = Shell {
        max_shell: 2.0,
        max_count: 30,
        normalize: false,
    };
    let step = &[0.3, 0.0, 0.0, 0.0, 0.0, 0.0];
    let asks: Vec<(&str, Ask)> = vec![
        (
            "classify",
            ask(|c| Ok(format!("{:?}", c.classify(cobject, at)?))),
        ),
        (
            "within",
            ask(|c| Ok(format!("{:?}", c.within(cobject, at, 0.6)?))),
        ),
        (
            "distance",
            ask(|c| Ok(format!("{:?}", c.distance(cobject, at, f64::INFINITY)?))),
        ),
        (
            "witnesses",
            ask(|c| Ok(format!("{:?}", c.witnesses(cobject, at, 2.0, 30)?))),
        ),
        (
            "gradients",
            ask(|c| Ok(format!("{:?}", c.gradients(cobject, q, 2.0, 30)?))),
        ),
        (
            "explain",
            ask(|c| Ok(format!("{:?}", c.explain(cobject, at, 30)?))),
        ),
        (
            "pseudo_normal",
            ask(|c| Ok(format!("{:?}", c.pseudo_normal(cobject, q, &shell)?))),
        ),
        (
            "slide",
            ask(|c| {
                let options = SlideOptions::with_shell(1.5);
                Ok(format!("{:?}", c.slide(cobject, q, step, &options)?))
            }),
        ),
    ];
    for (name, ask) in &asks {
        check(name, ask);
    }
    let chain = &chain();
    check(
        "find_link_pairs",
        &ask(|c| {
            let options = LinkPairOptions {
                samples: 50,
                ..LinkPairOptions::default()
            };
            Ok(format!(
                "{:?}",
                c.find_link_pairs(chain, &options, &mut |_| Ok(()))?
            ))
        }),
    );
}

/// A turn of a million rounds past a far ball: balls alone decide each part of it, and that is work too.
#[test]
fn a_motion_of_many_turns_is_ended() {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder
        .add_capsule(&Vec3::zeros(), &Vec3::x(), 0.05, 0)
        .unwrap();
    let options = HierarchyOptions::default();
    let bar = Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap());
    let mut turned = link(None, JointKind::Revolute, Vec3::z());
    turned.body = Some(bar.clone());
    turned.limits = [-1e50, 1e50];
    let space = space(vec![robot(3, vec![turned])]);
    let (world, _) = environment(&[(&bar, Pose::from_translation(Vec3::new(0.0, 0.0, 10.0)))]);
    let set = against_with(&space, &world, InducedOptions::default());
    let mut query = QueryContext::new();
    query.set_limit(Some(1000));
    let options = MotionOptions::default();
    let found = query.motion(&set, &[0.0], &[6e6], &options).unwrap();
    assert_eq!(found.outcome, MotionOutcome::Undecided);
    assert!(query.statistics().node_pairs <= 1100);
    query.set_limit(None);
    let found = query.motion(&set, &[0.0], &[600.0], &options).unwrap();
    assert_eq!(found.outcome, MotionOutcome::Free);
}
