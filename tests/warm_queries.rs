//! Queries that were asked before allocate nothing: their memory is the query context's. Left out are the contacts of what touches
//! or is just inside, balls of C-space, predicates, and what lists witnesses.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, InducedOptions, PureOptions, PureShape};
use cstk::environment::{Attachment, Change};
use cstk::pose::{Pose, Vec3};
use cstk::query::Configuration::Coordinates;
use cstk::query::QueryContext;
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::models::built;
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, link, robot, space};
use helpers::shapes::dented_ball;

/// The system's allocator, and how often it was asked for memory.
struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as the caller states.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as the caller states.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn solid_box(half: f64) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    let half = Vec3::new(half, 0.5 * half, 0.2 * half);
    builder.add_box(&Pose::identity(), &half, 0).unwrap();
    Arc::new(built(&builder, &Default::default()))
}

/// An upright prism of height 1.
fn prism(sides: u32) -> Arc<Body> {
    let corner = |i: u32| {
        let (y, x) = (std::f64::consts::TAU * f64::from(i / 2) / f64::from(sides)).sin_cos();
        Vec3::new(x, y, f64::from(i % 2) - 0.5)
    };
    let corners: Vec<Vec3> = (0..2 * sides).map(corner).collect();
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&corners, 0).unwrap();
    Arc::new(built(&builder, &Default::default()))
}

/// An arm of links that turn about axes in turn, each with a body.
fn arm(body: &Arc<Body>) -> Arc<Space> {
    let mut links: Vec<_> = (0..7usize)
        .map(|i| {
            let axis = [Vec3::z(), Vec3::y()][i % 2];
            let mut link = link(i.checked_sub(1), JointKind::Revolute, axis);
            link.at = Pose::from_translation(Vec3::x() * 0.3);
            link
        })
        .collect();
    links
        .iter_mut()
        .for_each(|link| link.body = Some(body.clone()));
    space(vec![robot(3, links)])
}

/// Asks each of some configurations, twice to warm up and once to count.
fn allocations(
    configurations: &[Vec<f64>],
    context: &mut QueryContext,
    ask: impl Fn(&mut QueryContext, &[f64]),
) -> usize {
    let mut ask_all = || configurations.iter().for_each(|q| ask(context, q));
    ask_all();
    ask_all();
    let before = COUNT.load(Ordering::Relaxed);
    ask_all();
    COUNT.load(Ordering::Relaxed) - before
}

#[test]
fn warm_queries_allocate_nothing() {
    let mut random = Random::new(73);
    let dented = dented_ball(|| random.within(0.5, 0.8)).body;
    let boxy = solid_box(0.12);
    let mut random = Random::new(74);
    let placed: Vec<(&Arc<Body>, Pose)> = (0..200)
        .map(|i| ([&dented, &boxy][i % 2], random.pose(9.0)))
        .collect();
    let (around, ids) = environment(&placed);
    let free = space(vec![free_body(&dented)]);
    let arm = arm(&solid_box(0.05));
    let pairs: Vec<[usize; 2]> = (2..7)
        .flat_map(|s| (0..s - 1).map(move |r| [r, s]))
        .collect();
    let own = CObject::induced_links(arm.clone(), &pairs, InducedOptions::default()).unwrap();
    let against_all = Arc::new(against(&arm, &around));
    let limits = CObject::pure(
        arm.clone(),
        PureShape::BeyondLimits,
        PureOptions {
            scale: Some(1.0),
            ..PureOptions::default()
        },
    );
    let union = CObject::union(&[against_all.clone(), Arc::new(own)]).unwrap();
    let with_limits = CObject::union(&[Arc::new(union), Arc::new(limits.unwrap())]).unwrap();
    let cases = [
        (Arc::new(against(&free, &around)), 6),
        (against_all, 7),
        (Arc::new(with_limits), 7),
    ];
    for turn in ["loose", "held"] {
        // What the arm holds is nowhere for others.
        let others = if turn == "held" { 1 } else { 0 };
        for (cobject, nq) in &cases[others..] {
            let configurations: Vec<Vec<f64>> = (0..50)
                .map(|_| (0..*nq).map(|_| random.within(-3.0, 3.0)).collect())
                .collect();
            let context = &mut QueryContext::new();
            let classified = allocations(&configurations, context, |context, q| {
                context.classify(cobject, Coordinates(q)).unwrap();
            });
            let within = allocations(&configurations, context, |context, q| {
                context.within(cobject, Coordinates(q), 0.1).unwrap();
            });
            let apart: Vec<Vec<f64>> = configurations
                .into_iter()
                .filter(|q| context.classify(cobject, Coordinates(q)).unwrap() == Class::Outside)
                .collect();
            assert!(apart.len() > 5, "{}", apart.len());
            let measured = allocations(&apart, context, |context, q| {
                context
                    .distance(cobject, Coordinates(q), f64::INFINITY)
                    .unwrap();
            });
            assert_eq!(
                [classified, within, measured],
                [0; 3],
                "turn {turn}, nq {nq}"
            );
        }
        around
            .apply(&[Change::Attach {
                id: ids[0],
                pose: Pose::identity(),
                attachment: Attachment::new(&arm, 6, &[]).unwrap(),
            }])
            .unwrap();
    }
    let poses: Vec<Vec<f64>> = (0..50).map(|_| vec![random.within(1.7, 3.0)]).collect();
    let context = &mut QueryContext::new();
    for (a, b) in [(&dented, &dented), (&boxy, &dented), (&boxy, &boxy)] {
        let asked = allocations(&poses, context, |context, q| {
            let (here, there) = (Pose::identity(), Pose::from_translation(Vec3::x() * q[0]));
            let sides = ((&**a, &here), (&**b, &there));
            context.pair_within(sides.0, sides.1, 0.0).unwrap();
            context
                .pair_distance(sides.0, sides.1, f64::INFINITY)
                .unwrap();
        });
        assert_eq!(asked, 0);
    }
    // Hulls that touch are decided by their features.
    let prism = prism(40);
    let gaps: Vec<Vec<f64>> = (-20..20).map(|i| vec![f64::from(i) * 1e-15]).collect();
    let asked = allocations(&gaps, context, |context, q| {
        let stacked = Pose::from_translation(Vec3::z() * (1.0 + q[0]));
        let sides = ((&*prism, &Pose::identity()), (&*prism, &stacked));
        assert!(context.pair_within(sides.0, sides.1, 0.0).unwrap());
    });
    assert_eq!(asked, 0);
}
