//! Solid bodies in all queries: as obstacles and links, with margins, in unions, warm and cold, and out of files.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, InducedOptions};
use cstk::environment::Environment;
use cstk::motion::{SlideOptions, SlideOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, Distance, QueryContext, SSide, Shell, WitnessList};
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::checked::at;
use helpers::files::loaded;
use helpers::random::Random;
use helpers::robots::{against, against_with, environment, link, robot, space};
use helpers::shapes::box_corners;
use helpers::surfaces::*;

/// A body that shifts along x.
fn slider(body: &Arc<Body>) -> Arc<Space> {
    let mut links = vec![link(None, JointKind::Prismatic, Vec3::x())];
    links[0].body = Some(body.clone());
    space(vec![robot(3, links)])
}

fn margin(margin: f64) -> InducedOptions {
    InducedOptions {
        margin,
        contact_epsilon: 0.05,
    }
}

/// A solid wall 2 thick, through which a small cube moves.
fn wall() -> (Arc<Environment>, Vec<u64>) {
    let wall = solid(&[cube(1.0)]);
    environment(&[(&wall, at(3.0, 0.0, 0.0))])
}

#[test]
fn a_link_wholly_inside_an_obstacle() {
    let small = surface(&[cube(0.2)]);
    let space = slider(&small);
    let (environment, ids) = wall();
    for margin_size in [0.0, 0.1] {
        let cobject = against_with(&space, &environment, margin(margin_size));
        // The face of the wall is at 2, the back at 4.
        let cases = [
            (0.0, Class::Outside, 1.8 - margin_size),
            (1.76 - margin_size, Class::Contact, 0.04),
            (1.9, Class::Inside, 0.0),
            (2.5, Class::Inside, 0.0),
            (3.0, Class::Inside, 0.0),
            (3.9, Class::Inside, 0.0),
            (4.5 + margin_size, Class::Outside, 0.3),
        ];
        let mut warm = QueryContext::new();
        for (x, class, expected) in cases.into_iter().chain(cases.into_iter().rev()) {
            let is_inside = (2.2 + margin_size..3.8 - margin_size).contains(&x);
            let q = Configuration::Coordinates(std::slice::from_ref(&x));
            for query in [&mut warm, &mut QueryContext::new()] {
                assert_eq!(query.classify(&cobject, q).unwrap(), class, "at {x}");
                let found = query.distance(&cobject, q, f64::INFINITY).unwrap();
                assert!((found.distance - expected).abs() < 1e-14, "at {x}");
                assert_eq!(found.lower == 0.0, expected == 0.0);
                let witness = found.witness.unwrap();
                assert_eq!(witness.s_side, SSide::Object(ids[0]));
                assert!(!is_inside || witness.contained);
                assert_eq!(query.within(&cobject, q, 0.0).unwrap(), expected == 0.0);
                assert_eq!(query.within(&cobject, q, 0.29).unwrap(), expected < 0.29);
                let beyond = query.distance(&cobject, q, 0.0).unwrap();
                assert_eq!(beyond.distance == 0.0, expected == 0.0);
                let list = query.witnesses(&cobject, q, 0.0, 99).unwrap();
                assert_eq!(list.witnesses.is_empty(), expected > 0.0);
                if x == 3.0 {
                    assert_eq!(list.witnesses.len(), 1);
                }
                let all = query.gradients(&cobject, &[x], 0.85, 99).unwrap();
                assert_eq!(all.gradients.len(), all.contacts.len());
                let contained = all.witnesses.iter().filter(|w| w.contained).count();
                assert_eq!(contained == 1, is_inside || (2.2..3.8).contains(&x));
                if x == 3.0 {
                    // Opposite faces of the two cubes, six times.
                    assert!(all.witnesses.len() >= 7 && all.witnesses[0].contained);
                    assert!(!all.contacts.is_empty());
                }
                let shell = Shell {
                    max_shell: 0.85,
                    max_count: 99,
                    normalize: false,
                };
                let whole = query.pseudo_normal(&cobject, &[x], &shell).unwrap();
                assert_eq!(whole.class, class);
                assert_eq!(whole.distance.distance, found.distance);
                assert_eq!(whole.list.witnesses.len(), all.witnesses.len());
                let options = SlideOptions::with_shell(0.1);
                let step = query.slide(&cobject, &[x], &[0.01], &options).unwrap();
                let overlaps = expected == 0.0;
                assert_eq!(step.outcome == SlideOutcome::Inside, overlaps, "at {x}");
            }
        }
    }
}

/// A solid link that takes in an obstacle, and two links one inside the other.
#[test]
fn links_may_be_the_solids() {
    let (large, small) = (solid(&[cube(1.0)]), surface(&[cube(0.2)]));
    let space_of_large = slider(&large);
    let (environment, _) = environment(&[(&small, at(3.0, 0.0, 0.0))]);
    let cobject = against(&space_of_large, &environment);
    let class = |cobject: &CObject, q: &[f64]| {
        let q = Configuration::Coordinates(q);
        QueryContext::new().classify(cobject, q).unwrap()
    };
    assert_eq!(class(&cobject, &[3.1]), Class::Inside);
    assert_eq!(class(&cobject, &[1.0]), Class::Outside);
    let mut links = vec![
        link(None, JointKind::Prismatic, Vec3::x()),
        link(None, JointKind::Prismatic, Vec3::x()),
    ];
    links[0].body = Some(small);
    links[1].body = Some(large);
    let two = space(vec![robot(3, links)]);
    let pairs = CObject::induced_links(two, &[[0, 1]], InducedOptions::default()).unwrap();
    assert_eq!(class(&pairs, &[0.3, 0.0]), Class::Inside);
    assert_eq!(class(&pairs, &[0.0, 2.0]), Class::Outside);
    let q = Configuration::Coordinates(&[0.3, 0.0]);
    let found = QueryContext::new().distance(&pairs, q, 1.0).unwrap();
    let witness = found.witness.unwrap();
    assert!(witness.contained);
    assert_eq!((witness.r_link, witness.s_side), (0, SSide::Link(1)));
    let corner = found.points[0] - Vec3::new(0.3, 0.0, 0.0);
    assert!((corner.abs() - Vec3::repeat(0.2)).norm() < 1e-15);
}

/// Of an object that touches and one that contains, the first by id is named, whichever is asked first.
#[test]
fn ties_go_to_the_lowest_ids() {
    let (large, small) = (solid(&[cube(1.0)]), surface(&[cube(0.25)]));
    let space = slider(&small);
    // The first reaches into the small cube at 0; the second is around it.
    let touching = at(1.125, 0.0, 0.0);
    for (places, contained) in [
        ([touching, Pose::identity()], false),
        ([Pose::identity(), touching], true),
    ] {
        let (environment, ids) = environment(&places.map(|place| (&large, place)));
        let cobject = against(&space, &environment);
        let mut query = QueryContext::new();
        for x in [0.0, 0.05, 0.0, -0.3, 0.0] {
            let q = [x];
            let q = Configuration::Coordinates(&q);
            let found = query.distance(&cobject, q, f64::INFINITY).unwrap();
            let witness = found.witness.unwrap();
            let touches = x >= 0.0;
            let first = if touches || contained { ids[0] } else { ids[1] };
            assert_eq!(witness.s_side, SSide::Object(first), "at {x}");
            assert_eq!(witness.contained, contained || !touches);
            let list = query.witnesses(&cobject, q, 0.0, 999).unwrap();
            assert_eq!(list.witnesses[0].s_side, SSide::Object(first));
            assert_eq!(list.witnesses.iter().filter(|w| w.contained).count(), 1);
        }
    }
    // Within one pair the lower primitive: of the body's two cubes the one touches and the other is inside.
    for (meshes, contained) in [([-0.5, 1.0], true), ([1.0, -0.5], false)] {
        let parts = meshes.map(|x| shifted(&cube(0.25), [x, 0.0, 0.0]));
        let body = surface(&parts);
        let here = Pose::identity();
        let found = QueryContext::new()
            .pair_distance((&body, &here), (&large, &here), 1.0)
            .unwrap();
        let witness = found.witness.unwrap();
        assert_eq!(witness.contained, contained);
        assert!(witness.primitives[0] < 6);
    }
}

fn same(a: &Distance, b: &Distance) -> bool {
    let names = |d: &Distance| {
        d.witness
            .map(|w| (w.primitives, w.contained, w.overlapping))
    };
    let numbers = |d: &Distance| [d.distance, d.lower, d.upper].map(f64::to_bits);
    numbers(a) == numbers(b) && a.points == b.points && names(a) == names(b)
}

fn keys(list: &WitnessList) -> Vec<([u32; 2], u64, bool)> {
    let key = |w: &cstk::query::Witness| (w.primitives, w.distance.to_bits(), w.contained);
    list.witnesses.iter().map(key).collect()
}

/// Warm and cold, saved and loaded: the same bits.
#[test]
fn answers_depend_on_nothing_else() {
    let mut random = Random::new(91);
    let mut meshes = hollow_cube();
    // The sliver has no primitive, and has to be in the file too.
    meshes[0] = with_sliver(0.0);
    let hollow = solid(&meshes);
    assert_eq!(hollow.solid().unwrap().scraps().len(), 1);
    let dust: Vec<_> = (0..10)
        .map(|_| moved(&cube(0.1), &random.pose(0.6)))
        .collect();
    let dust = surface(&dust);
    let again = loaded(&hollow);
    assert_eq!(again.solid(), hollow.solid());
    assert!(again.statistics().is_solid && !loaded(&dust).statistics().is_solid);
    let mut warm = QueryContext::new();
    let mut contained = 0;
    let mut pose = random.pose(0.5);
    for k in 0..300 {
        if k % 10 == 0 {
            pose = random.pose(0.8);
        }
        pose.translation += random.point(0.05);
        let here = Pose::identity();
        let ask = |query: &mut QueryContext, body: &Body| {
            let (a, b) = ((&*dust, &pose), (body, &here));
            (
                query.pair_distance(a, b, f64::INFINITY).unwrap(),
                query.pair_witnesses(a, b, 0.01, 99).unwrap(),
                query.pair_within(a, b, 0.0).unwrap(),
            )
        };
        let cold = ask(&mut QueryContext::new(), &hollow);
        for (d, list, within) in [
            ask(&mut warm, &hollow),
            ask(&mut QueryContext::new(), &again),
        ] {
            assert!(same(&d, &cold.0));
            assert_eq!(keys(&list), keys(&cold.1));
            assert_eq!(within, cold.2);
        }
        assert_eq!(cold.2, cold.0.distance == 0.0);
        contained += usize::from(cold.0.witness.unwrap().contained);
    }
    assert!(contained > 20, "{contained}");
}

/// A solid may have polyhedra inside: what meets one of them, and not the boundary, is inside all the same.
#[test]
fn inside_and_touching() {
    let mut builder = builder(&[cube(1.0)]);
    builder.add_polyhedron(&box_corners([0.2; 3]), 5).unwrap();
    let body = solid_of(builder).unwrap();
    let small = surface(&[cube(0.2)]);
    let here = Pose::identity();
    let mut query = QueryContext::new();
    for (x, pairs, contained) in [(0.3, 1, 1), (0.5, 0, 1), (0.8, 1, 0)] {
        let list = query
            .pair_witnesses((&small, &at(x, 0.0, 0.0)), (&body, &here), 0.0, 99)
            .unwrap();
        let inside = list.witnesses.iter().filter(|w| w.contained).count();
        assert_eq!(inside, contained, "at {x}");
        assert_eq!(list.witnesses.len() - inside > 0, pairs > 0, "at {x}");
        let penetrations = query
            .pair_penetration((&small, &at(x, 0.0, 0.0)), (&body, &here), 99)
            .unwrap()
            .penetrations;
        assert_eq!(penetrations.len(), list.witnesses.len() - inside);
    }
}

/// In the plane polygons are solid, declared or not, closed or not.
#[test]
fn planar_bodies_are_as_they_were() {
    let square = |half: f64| {
        [(-half, -half), (half, -half), (half, half), (-half, half)]
            .map(|(x, y)| Vec3::new(x, y, 0.0))
    };
    let build_one = |half: f64, is_solid: bool| {
        let mut builder = BodyBuilder::new(2).unwrap();
        builder.add_polygon(&square(half), 0).unwrap();
        builder.set_solid(is_solid);
        build(&builder).unwrap()
    };
    let here = Pose::identity();
    for (a, b) in [(false, false), (true, false), (true, true)] {
        let (a, b) = (build_one(0.2, a), build_one(1.0, b));
        for x in [0.0, 0.5, 1.1, 3.0] {
            let found = QueryContext::new()
                .pair_distance((&a, &at(x, 0.0, 0.0)), (&b, &here), f64::INFINITY)
                .unwrap();
            assert!((found.distance - (x - 1.2f64).max(0.0)).abs() < 1e-15);
            assert!(!found.witness.unwrap().contained);
        }
        assert!(loaded(&a).solid().is_none());
    }
}
