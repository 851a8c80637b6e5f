//! Environments that change: after any changes, in any order, an environment answers as one made anew with the same
//! objects, and as brute force does; what was seen of it before goes on answering as it did.

use std::fmt::Write as _;
use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::CObject;
use cstk::environment::{Addition, Change, Environment};
use cstk::error::ErrorKind;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext, SSide};
use cstk::space::Space;
use cstk::user_data::UserData;

use helpers::changing::{
    Model, any_pose, beside_one, change, configurations, made_anew, options, spatial_bodies,
};
use helpers::random::Random;
use helpers::robots::{against, against_with, environment, free_body, free_planar_body, space};
use helpers::shapes::{cuboid, planar};

/// All that queries say of a C-object at some configurations, to the last bit; objects by their places in `ids`.
fn answers(cobject: &CObject, ids: &[u64], at: &[[f64; 6]], context: &mut QueryContext) -> String {
    let place = |side: SSide| match side {
        SSide::Object(id) => ids.iter().position(|&other| other == id).unwrap(),
        SSide::Link(_) | SSide::PureSet(_) => unreachable!("only objects are in the C-object"),
    };
    let mut said = String::new();
    for q in at {
        let at = Configuration::Coordinates(q);
        let class = context.classify(cobject, at).unwrap();
        write!(said, "{class:?} ").unwrap();
        for threshold in [0.0, 1e-3, 0.2, 5.0] {
            write!(said, "{} ", context.within(cobject, at, threshold).unwrap()).unwrap();
        }
        for most in [f64::INFINITY, 0.3, 0.0] {
            let found = context.distance(cobject, at, most).unwrap();
            // Two objects may meet the robot, and then which one is named, and its error, depends on the ids.
            let upper = if found.distance > 0.0 {
                found.upper
            } else {
                0.0
            };
            let numbers = [found.distance, found.lower, upper];
            write!(said, "{:?} {numbers:?} ", found.kind).unwrap();
        }
        for epsilon in [0.0, 0.1] {
            let list = context.witnesses(cobject, at, epsilon, usize::MAX).unwrap();
            let mut lines: Vec<String> = list
                .witnesses
                .iter()
                .map(|w| {
                    let contacts = &list.contacts[w.first_contact..][..w.contact_count];
                    let of = (place(w.s_side), w.r_link, w.primitives, w.overlapping);
                    format!("{of:?} {:?} {contacts:?}", w.distance)
                })
                .collect();
            lines.sort();
            write!(said, "{lines:?} ").unwrap();
        }
        said.push('\n');
    }
    said
}

fn check_objects(environment: &Environment, model: &Model) {
    let snapshot = environment.snapshot();
    assert_eq!(snapshot.len(), model.len());
    assert!(snapshot.objects().map(|o| &o.id).eq(model.keys()));
    assert_eq!(snapshot.first().map(|o| o.id), model.keys().next().copied());
    for (id, (body, pose)) in model {
        let found = snapshot.find(*id).unwrap();
        assert_eq!((found.body.serial(), &found.pose), (body.serial(), pose));
        let place = snapshot.place_of(*id).unwrap();
        assert_eq!(snapshot.object(place).id, *id);
    }
    assert!(snapshot.find(0).is_none() && snapshot.find(u64::MAX).is_none());
}

/// The least distance over all objects, each alone.
fn nearest_alone(space: &Space, q: &[f64; 6], model: &Model) -> f64 {
    let link = space.link_count() - 1;
    let pose = space.link_poses(q).unwrap()[link];
    let body = space.link(link).unwrap().body.as_deref().unwrap();
    let mut context = QueryContext::new();
    let distances = model.values().map(|(other, at)| {
        let found = context.pair_distance((body, &pose), (other, at), f64::INFINITY);
        (found.unwrap().distance - options().margin).max(0.0)
    });
    distances.fold(f64::INFINITY, f64::min)
}

#[test]
fn answers_do_not_depend_on_how_the_objects_came() {
    let mut random = Random::new(40);
    let bodies = spatial_bodies(&mut random);
    let space = space(vec![free_body(&bodies[3])]);
    for wanted in [7, 40, 300] {
        let live = Arc::new(Environment::default());
        let cobject = against_with(&space, &live, options());
        let mut warm = QueryContext::new();
        let mut model = Model::new();
        let mut kept = Vec::new();
        for step in 0..400 {
            change(&live, &mut model, &bodies, &mut random, wanted);
            if step % 8 != 0 {
                continue;
            }
            check_objects(&live, &model);
            let ids: Vec<u64> = model.keys().copied().collect();
            let mut at = configurations(&mut random, 3);
            at.extend((0..3).map(|_| beside_one(&mut random, &model)));
            let said = answers(&cobject, &ids, &at, &mut warm);
            let (anew, new_ids) = made_anew(&model, &mut random);
            let again = against_with(&space, &anew, options());
            assert_eq!(
                said,
                answers(&again, &new_ids, &at, &mut QueryContext::new())
            );
            for q in &at {
                let at = Configuration::Coordinates(q);
                let found = QueryContext::new().distance(&cobject, at, f64::INFINITY);
                let found = found.unwrap().distance;
                assert_eq!(found.to_bits(), nearest_alone(&space, q, &model).to_bits());
            }
            if step % 24 == 0 {
                kept.push((Arc::new(live.freeze()), ids, at, said));
            }
        }
        // What was seen before is still there.
        for (frozen, ids, at, said) in &kept {
            let cobject = against_with(&space, frozen, options());
            assert_eq!(said, &answers(&cobject, ids, at, &mut warm));
            assert_eq!(said, &answers(&cobject, ids, at, &mut QueryContext::new()));
        }
        // To the last one, and then others.
        while let Some((&id, _)) = model.iter().nth(random.below(model.len().max(1))) {
            live.apply(&[Change::Delete { id }]).unwrap();
            model.remove(&id);
            check_objects(&live, &model);
        }
        change(&live, &mut model, &bodies, &mut random, wanted);
        check_objects(&live, &model);
    }
}

#[test]
fn the_order_in_which_objects_come_does_not_matter() {
    let mut random = Random::new(41);
    let bodies = spatial_bodies(&mut random);
    let space = space(vec![free_body(&bodies[3])]);
    let mut model = Model::new();
    for id in 0..150 {
        let body = bodies[random.below(bodies.len())].clone();
        let pose = any_pose(&mut random, &body);
        model.insert(id, (body, pose));
    }
    let mut at = configurations(&mut random, 20);
    at.extend((0..50).map(|_| beside_one(&mut random, &model)));
    let mut first = None;
    for case in 0..6 {
        let (made, ids) = made_anew(&model, &mut random);
        let ids = if case % 2 == 0 {
            ids
        } else {
            // One by one.
            let objects = made.snapshot();
            let mut places: Vec<usize> = (0..ids.len()).collect();
            places.sort_by_key(|&place| ids[place]);
            let mut now = vec![0; ids.len()];
            for (object, place) in objects.objects().zip(places) {
                let add = Change::add(object.body.clone(), object.pose);
                let delete = Change::Delete { id: object.id };
                now[place] = made.apply(&[add, delete]).unwrap().0[0];
            }
            now
        };
        let cobject = against_with(&space, &made, options());
        let said = answers(&cobject, &ids, &at, &mut QueryContext::new());
        assert!(said.contains("Inside") && said.contains("Outside"));
        assert_eq!(*first.get_or_insert(said.clone()), said);
    }
}

#[test]
fn changes_are_made_in_order_and_all_or_none() {
    let brick = cuboid([1.0; 3]).body;
    let tile = planar(&[vec![Vec3::zeros(), Vec3::x(), Vec3::y()]]).body;
    let at = |x: f64| Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    let add = |body: &Arc<Body>, pose| Change::add(body.clone(), pose);
    let (live, ids) = environment(&[(&brick, at(0.0)), (&brick, at(1.0)), (&brick, at(2.0))]);
    let moved = |id, x| Change::Move { id, pose: at(x) };
    let delete = |id| Change::Delete { id };
    let poses = |environment: &Environment| -> Vec<f64> {
        let snapshot = environment.snapshot();
        let along = snapshot.objects().map(|o| o.pose.translation.x);
        along.collect()
    };

    // The last move holds; what is moved and deleted is gone, what is added and deleted never seen.
    let changes = [moved(ids[1], 5.0), moved(ids[1], 6.0)];
    assert_eq!(live.apply(&changes).unwrap(), (vec![ids[1]; 2], 2));
    assert_eq!(poses(&live), [0.0, 6.0, 2.0]);
    live.apply(&[moved(ids[0], 7.0), delete(ids[0]), add(&brick, at(3.0))])
        .unwrap();
    assert_eq!(poses(&live), [6.0, 2.0, 3.0]);
    assert_eq!(live.apply(&[]).unwrap(), (vec![], 4));

    // An object is no more after it was deleted, and a planar body does not join spatial ones.
    let leaving_the_plane = Pose::from_translation(Vec3::z());
    let all = live.snapshot();
    let gone: Vec<Change> = all.objects().map(|object| delete(object.id)).collect();
    let refused: [(Vec<Change>, ErrorKind, usize); 6] = [
        (
            vec![delete(ids[1]), moved(ids[1], 0.0)],
            ErrorKind::NotFound,
            1,
        ),
        (
            vec![moved(ids[1], 0.0), delete(ids[0])],
            ErrorKind::NotFound,
            1,
        ),
        (vec![delete(u64::MAX)], ErrorKind::NotFound, 0),
        (
            vec![add(&brick, at(0.0)), add(&tile, at(0.0))],
            ErrorKind::InvalidArgument,
            1,
        ),
        (
            [gone.clone(), vec![add(&tile, leaving_the_plane)]].concat(),
            ErrorKind::InvalidArgument,
            3,
        ),
        (
            [
                gone.clone(),
                vec![add(&tile, at(0.0)), add(&brick, at(0.0))],
            ]
            .concat(),
            ErrorKind::InvalidArgument,
            4,
        ),
    ];
    for (changes, kind, culprit) in refused {
        let error = live.apply(&changes).unwrap_err();
        assert_eq!(error.kind, kind);
        let message = error.to_string();
        assert!(
            message.contains(&format!("changes[{culprit}]")),
            "{message}"
        );
        assert_eq!(poses(&live), [6.0, 2.0, 3.0]);
        assert_eq!(live.snapshot().version, 4);
    }

    // With all of one kind deleted, the other may come: in the same changes, or later.
    let frozen = live.freeze();
    let changes = [gone, vec![add(&tile, at(9.0))]].concat();
    let (new, version) = live.apply(&changes).unwrap();
    assert_eq!((version, poses(&live)), (5, vec![9.0]));
    assert!(new[3] > ids[2]);
    let none = live.apply(&[delete(new[3])]).unwrap();
    assert!(none.1 == 6 && live.snapshot().is_empty());
    live.apply(&[add(&brick, at(8.0))]).unwrap();
    assert_eq!(poses(&live), [8.0]);

    // A snapshot is not changed, whatever is asked of it.
    assert_eq!(poses(&frozen), [6.0, 2.0, 3.0]);
    assert_eq!(frozen.apply(&[]).unwrap_err().kind, ErrorKind::Unsupported);
    let mut nan = at(0.0).to_row_major();
    nan[3] = f64::NAN;
    assert!(Pose::from_row_major(&nan).is_err());
}

#[test]
fn planar_environments_change_as_well() {
    let mut random = Random::new(43);
    let bodies: Vec<Arc<Body>> = (3..6)
        .map(|corners| planar(&[random.polygon(corners, 0.2)]).body)
        .collect();
    let space = space(vec![free_planar_body(&bodies[2])]);
    let live = Arc::new(Environment::default());
    let cobject = against(&space, &live);
    let mut warm = QueryContext::new();
    let mut model = Model::new();
    for step in 0..600 {
        let ids: Vec<u64> = model.keys().copied().collect();
        let body = bodies[random.below(3)].clone();
        let half = if random.below(30) == 0 { 1e4 } else { 2.0 };
        let pose = random.planar_pose(half);
        if ids.len() < 100 || step % 3 == 0 {
            let add = Change::add(body.clone(), pose);
            let (new, _) = live.apply(&[add]).unwrap();
            model.insert(new[0], (body, pose));
        } else {
            let id = ids[random.below(ids.len())];
            live.apply(&[Change::Move { id, pose }]).unwrap();
            model.get_mut(&id).unwrap().1 = pose;
        }
        if step % 10 == 0 {
            let (anew, _) = made_anew(&model, &mut random);
            let again = against(&space, &anew);
            let q = [random.within(-2.0, 2.0), random.within(-2.0, 2.0), 1.0];
            let q = Configuration::Coordinates(&q);
            let found = warm.distance(&cobject, q, f64::INFINITY).unwrap();
            let other = QueryContext::new().distance(&again, q, f64::INFINITY);
            let other = other.unwrap();
            assert_eq!(found.distance.to_bits(), other.distance.to_bits());
            assert_eq!(found.lower.to_bits(), other.lower.to_bits());
        }
    }
}

/// What is dropped with the last state that holds an object may itself change the environment.
#[test]
fn what_an_object_keeps_may_change_the_environment() {
    struct Changes(
        std::sync::Weak<Environment>,
        Arc<std::sync::atomic::AtomicU64>,
    );
    impl Drop for Changes {
        fn drop(&mut self) {
            if let Some(environment) = self.0.upgrade() {
                let (_, version) = environment.apply(&[]).unwrap();
                self.1.store(version, std::sync::atomic::Ordering::Relaxed);
            }
        }
    }
    let environment = Arc::new(Environment::default());
    let seen = Arc::new(std::sync::atomic::AtomicU64::new(0));
    let keeper = Changes(Arc::downgrade(&environment), seen.clone());
    let add = Change::Add(Addition {
        data: Some(UserData::new(1, Some(Arc::new(keeper)))),
        ..Addition::new(cuboid([1.0; 3]).body, Pose::identity())
    });
    let (ids, _) = environment.apply(&[add]).unwrap();
    environment.apply(&[Change::Delete { id: ids[0] }]).unwrap();
    assert_eq!(seen.load(std::sync::atomic::Ordering::Relaxed), 3);
}
