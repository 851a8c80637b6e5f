//! Many objects that move at once, by little and far, while some come, go and are attached: queries find what brute force
//! finds, and states that somebody holds do not change.

use std::collections::BTreeMap;
use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::body_bounds::{Bounds, BoundsByEight};
use cstk::environment::{Addition, Attachment, Change, Environment, NearScratch, Snapshot};
use cstk::hierarchy::HierarchyOptions;
use cstk::index_set::IndexSet;
use cstk::lanes::Plain;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::space::Space;
use cstk::user_data::UserData;

use helpers::random::Random;
use helpers::robots::{free_body, space};
use helpers::shapes::cuboid;

/// Objects by their ids: body, pose, and whether it is attached.
type Model = BTreeMap<u64, (Arc<Body>, Pose, bool)>;

/// How the objects of one change move.
#[derive(Clone, Copy, Debug)]
enum Motion {
    Little,
    Anywhere,
    /// All by the same large step.
    Together,
}

fn target(random: &mut Random, motion: Motion, from: &Pose, step: Vec3) -> Pose {
    match motion {
        Motion::Little => Pose {
            translation: from.translation + random.point(0.03),
            rotation: random.rotation(),
        },
        Motion::Anywhere if random.below(60) == 0 => random.pose(1e7),
        Motion::Anywhere => random.pose(2.0),
        Motion::Together => Pose {
            translation: from.translation + step,
            ..*from
        },
    }
}

/// Moves `count` objects, attaches some, deletes and adds as many as `exchanged`, all in one call.
fn change(
    live: &Environment,
    space: &Space,
    model: &mut Model,
    random: &mut Random,
    (motion, count, exchanged): (Motion, usize, usize),
) {
    let mut ids: Vec<u64> = model.keys().copied().collect();
    let step = random.point(3.0);
    let mut changes = Vec::new();
    for i in 0..count.min(ids.len()) {
        let j = i + random.below(ids.len() - i);
        ids.swap(i, j);
        let (_, pose, is_attached) = model.get_mut(&ids[i]).unwrap();
        *pose = target(random, motion, pose, step);
        *is_attached = random.below(30) == 0;
        let (id, pose) = (ids[i], *pose);
        // The last change about an object counts.
        if random.below(20) == 0 {
            let pose = random.pose(5.0);
            changes.push(Change::Move { id, pose });
        }
        changes.push(if *is_attached {
            let attachment = Attachment::new(space, 0, &[]).unwrap();
            Change::Attach {
                id,
                pose,
                attachment,
            }
        } else {
            Change::Move { id, pose }
        });
    }
    let mut added = Vec::new();
    for &id in ids.iter().take(exchanged) {
        model.remove(&id);
        changes.push(Change::Delete { id });
        let sides = [0; 3].map(|_| random.within(0.02, 0.3));
        let (body, pose) = (cuboid(sides).body, random.pose(2.0));
        added.push((changes.len(), body.clone(), pose));
        let data = None;
        changes.push(Change::Add(Addition {
            data,
            ..Addition::new(body, pose)
        }));
    }
    let (ids, _) = live.apply(&changes).unwrap();
    for (at, body, pose) in added {
        model.insert(ids[at], (body, pose, false));
    }
}

/// A state is what its model says; and what its tree finds near a body is what is near it by distances of pairs alone.
fn check(state: &Snapshot, model: &Model, probe: &Body, random: &mut Random) {
    assert!(state.objects().map(|object| &object.id).eq(model.keys()));
    for (object, (body, pose, is_attached)) in state.objects().zip(model.values()) {
        assert_eq!(object.body.serial(), body.serial());
        assert_eq!(&object.pose, pose);
        assert_eq!(object.attachment.is_some(), *is_attached);
        assert_eq!(state.find(object.id).unwrap().id, object.id);
    }
    let attached = model.values().filter(|(.., is_attached)| *is_attached);
    assert_eq!(state.attached().count(), attached.count());
    let mut context = QueryContext::new();
    let mut scratch = NearScratch::default();
    for limit in [0.0, 0.1, 1.0] {
        let any = model.values().nth(random.below(model.len()));
        let center = any.map_or(Vec3::zeros(), |(_, pose, _)| pose.translation);
        let at = Pose {
            translation: center + random.point(0.5),
            rotation: random.rotation(),
        };
        let mut found = BTreeMap::new();
        let mut bounds = BoundsByEight::default();
        bounds.push(&Bounds::of(Plain, probe, &at));
        let mut first = IndexSet::new(1);
        first.insert(0);
        let tree = state.tree();
        tree.visit_near(
            &bounds,
            &first,
            limit,
            &mut scratch,
            |_, place, at_least| {
                let is_new = found.insert(state.object(place).id, at_least).is_none();
                assert!(is_new, "an object was visited twice");
                limit
            },
        );
        for (id, (body, pose, is_attached)) in model {
            let answer = context.pair_distance((probe, &at), (body, pose), f64::INFINITY);
            let distance = answer.unwrap().distance;
            match found.get(id) {
                Some(at_least) => assert!(!is_attached && *at_least <= distance),
                None => assert!(*is_attached || distance > limit),
            }
        }
    }
}

#[test]
fn bulk_moves_leave_nothing_out() {
    let probe = cuboid([0.4, 0.3, 0.2]).body;
    let space = space(vec![free_body(&probe)]);
    for (seed, size) in [(70, 5), (71, 60), (72, 400)] {
        let mut random = Random::new(seed);
        let live = Environment::default();
        let mut model = Model::new();
        let additions: Vec<Change> = (0..size)
            .map(|_| {
                Change::add(
                    cuboid([0; 3].map(|_| random.within(0.02, 0.3))).body,
                    random.pose(2.0),
                )
            })
            .collect();
        let (ids, _) = live.apply(&additions).unwrap();
        for (id, addition) in ids.iter().zip(additions) {
            let Change::Add(Addition { body, pose, .. }) = addition else {
                unreachable!()
            };
            model.insert(*id, (body, pose, false));
        }
        let mut kept = Vec::new();
        for round in 0..80 {
            let motion = [Motion::Little, Motion::Anywhere, Motion::Together][random.below(3)];
            let counts = [1, 1 + size / 10, size / 3, size];
            let count = counts[random.below(counts.len())];
            let exchanged = [0, 0, 0, 1, size / 4, size][random.below(6)];
            change(
                &live,
                &space,
                &mut model,
                &mut random,
                (motion, count, exchanged),
            );
            let state = live.snapshot();
            check(&state, &model, &probe, &mut random);
            // Some are held for long, some until the next change but one, most are not.
            if round % 3 == 0 {
                kept.push((state, model.clone()));
            }
            if kept.len() > 5 {
                let (state, model) = kept.remove(random.below(2));
                check(&state, &model, &probe, &mut random);
            }
        }
        for (state, model) in &kept {
            check(state, model, &probe, &mut random);
        }
    }
}

/// A change that fails in its middle leaves the next one to start from what was before.
#[test]
fn a_failed_change_leaves_no_trace_in_the_next() {
    let probe = cuboid([0.4, 0.3, 0.2]).body;
    let mut random = Random::new(73);
    let live = Environment::default();
    let mut model = Model::new();
    for _ in 0..50 {
        let (body, pose) = (cuboid([0.1, 0.2, 0.1]).body, random.pose(1.0));
        let add = Change::add(body.clone(), pose);
        let (ids, _) = live.apply(&[add]).unwrap();
        model.insert(ids[0], (body, pose, false));
    }
    let ids: Vec<u64> = model.keys().copied().collect();
    for round in 0..30 {
        let mut changes: Vec<Change> = ids
            .iter()
            .map(|&id| Change::Move {
                id,
                pose: random.pose(1.0),
            })
            .collect();
        changes.push(Change::Delete { id: 0 });
        assert!(live.apply(&changes).is_err());
        check(&live.snapshot(), &model, &probe, &mut random);
        let (id, pose) = (ids[round], random.pose(1.0));
        live.apply(&[Change::Move { id, pose }]).unwrap();
        model.get_mut(&id).unwrap().1 = pose;
        check(&live.snapshot(), &model, &probe, &mut random);
    }
}

/// The memory of states that is kept for the next ones holds nothing that was deleted.
#[test]
fn what_is_deleted_is_let_go_at_once() {
    let live = Environment::default();
    let body = cuboid([0.1; 3]).body;
    let keeper = Arc::new(7u8);
    let add = || {
        Change::Add(Addition {
            data: Some(UserData::new(1, Some(keeper.clone()))),
            ..Addition::new(body.clone(), Pose::identity())
        })
    };
    let (ids, _) = live.apply(&[add(), add(), add()]).unwrap();
    for &id in &ids {
        for x in 0..4 {
            let pose = Pose::from_translation(Vec3::new(f64::from(x), 0.0, 0.0));
            live.apply(&[Change::Move { id: ids[2], pose }]).unwrap();
        }
        let before = Arc::strong_count(&keeper);
        live.apply(&[Change::Delete { id }]).unwrap();
        assert!(Arc::strong_count(&keeper) < before);
    }
    assert_eq!(Arc::strong_count(&keeper), 1);
}

/// Where their sides are less than the spacing of coordinates, boxes have no extent in the world.
#[test]
fn objects_that_are_small_for_where_they_stand_are_taken_and_found() {
    let body = cuboid([1.0; 3]).body;
    for away in [1e12, 1e14, 1e17, 1e30, 1e49] {
        for count in [1, 2, 9, 40] {
            let live = Environment::default();
            let at =
                |i: usize| Pose::from_translation(Vec3::repeat(away) * (1.0 + i as f64 * 1e-15));
            let add = |i: usize| Change::add(body.clone(), at(i));
            let changes: Vec<Change> = (0..count).map(add).collect();
            let (ids, _) = live.apply(&changes).unwrap();
            for step in 0..4 {
                let moves: Vec<Change> = ids
                    .iter()
                    .map(|&id| Change::Move { id, pose: at(step) })
                    .collect();
                live.apply(&moves).unwrap();
            }
            let more: Vec<u64> = (0..20)
                .map(|i| live.apply(&[add(i)]).unwrap().0[0])
                .collect();
            for id in ids.into_iter().chain(more) {
                live.apply(&[Change::Delete { id }]).unwrap();
            }
            assert_eq!(live.snapshot().len(), 0);
        }
    }
}

/// A tree made anew over points that came together has no size of its own; the next of them may go anywhere within its limits.
#[test]
fn points_that_come_together_part_again() {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_sphere(&Vec3::zeros(), 0.0, 0).unwrap();
    let options = HierarchyOptions::default();
    let body = Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap());
    let probe = cuboid([0.4, 0.3, 0.2]).body;
    let mut random = Random::new(74);
    for count in [1, 9, 100] {
        let live = Environment::default();
        let mut model = Model::new();
        let go = |ids: &[u64], random: &mut Random, reach: f64, model: &mut Model| {
            let changes: Vec<Change> = ids
                .iter()
                .map(|&id| {
                    let pose = Pose::from_translation(random.point(reach));
                    model.insert(id, (body.clone(), pose, false));
                    Change::Move { id, pose }
                })
                .collect();
            live.apply(&changes).unwrap();
            check(&live.snapshot(), model, &probe, random);
        };
        let add = || Change::add(body.clone(), Pose::from_translation(Vec3::repeat(0.5)));
        let changes: Vec<Change> = (0..count).map(|_| add()).collect();
        let (ids, _) = live.apply(&changes).unwrap();
        go(&ids, &mut random, 1.0, &mut model);
        for _ in 0..3 {
            go(&ids, &mut random, 0.0, &mut model);
            go(&ids[..1], &mut random, 1.0, &mut model);
            go(&ids, &mut random, 1.0, &mut model);
            go(&ids, &mut random, 1e-200, &mut model);
            go(&ids[..1], &mut random, 1.0, &mut model);
        }
    }
}
