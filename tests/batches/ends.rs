//! How batches end: at hits, with failures, cancelled; and what they see of a world that changes.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use cstk::batch::{Batch, BatchOptions, Configurations, ItemAnswer};
use cstk::cobject::Class;
use cstk::environment::Change;
use cstk::error::{Error, ErrorKind};
use cstk::query::{Configuration, QueryContext};

use super::scene::{Arm, NQ, at, on_threads, quiet};
use helpers::pure::classified;

/// An answer that was put; `None` where nothing was.
type Found = Option<std::result::Result<Class, ErrorKind>>;

fn keep(slots: &mut &mut [Found], item: usize, answer: ItemAnswer<Class>) {
    assert!(slots[item].is_none(), "an item is answered once");
    slots[item] = Some(answer.map_err(|error| error.kind));
}

fn classes(arm: &Arm, q: &[f64]) -> Vec<Found> {
    let context = &mut QueryContext::new();
    let ask = |q| context.classify(&arm.contact, Configuration::Coordinates(q));
    let answers = q.chunks(NQ).map(ask);
    answers
        .map(|class| Some(class.map_err(|error| error.kind)))
        .collect()
}

#[test]
fn a_batch_ends_at_its_first_hit() {
    let arm = Arm::new(15);
    let all = arm.configurations(4000, 16);
    let expected = classes(&arm, &all);
    // Hits here and there only.
    let mut kept = Vec::new();
    for (i, q) in all.chunks(NQ).enumerate() {
        if expected[i] != Some(Ok(Class::Inside)) || i % 100 == 99 {
            kept.extend_from_slice(q);
        }
    }
    let expected = classes(&arm, &kept);
    let first = expected
        .iter()
        .position(|class| *class == Some(Ok(Class::Inside)));
    assert!(first.is_some_and(|first| first > 10));
    for threads in [1, 2, 5] {
        let options = BatchOptions {
            stop_at_hit: true,
            ..on_threads(threads)
        };
        let mut found = vec![None; expected.len()];
        let nothing = &mut |_| Ok(());
        let job = quiet(&options, &mut found[..], nothing);
        let done = Batch::new()
            .classify(&arm.contact, at(&kept), job, keep)
            .unwrap();
        assert_eq!(done.first_hit, first);
        let end = first.unwrap() + 1;
        assert_eq!(found[..end], expected[..end]);
        let beyond = found[end..].iter().filter(|class| class.is_some()).count();
        assert!(threads > 1 || beyond == 0, "{beyond}");
    }
}

#[test]
fn an_item_that_fails_fails_alone() {
    let arm = Arm::new(17);
    let mut q = arm.configurations(500, 18);
    q[NQ * 333 + 2] = f64::NAN;
    q[NQ * 77 + 5] = f64::INFINITY;
    q[NQ * 499] = 1e300;
    let expected = classes(&arm, &q);
    assert_eq!(expected[333], Some(Err(ErrorKind::NotFinite)));
    for threads in [1, 2, 5] {
        let options = on_threads(threads);
        let mut found = vec![None; expected.len()];
        let nothing = &mut |_| Ok(());
        let job = quiet(&options, &mut found[..], nothing);
        let done = Batch::new()
            .classify(&arm.contact, at(&q), job, keep)
            .unwrap();
        assert_eq!(found, expected);
        let (number, error) = done.first_failure.unwrap();
        assert_eq!((number, error.kind), (77, ErrorKind::NotFinite));
        assert!(error.message.starts_with("item 77: "), "{error}");
    }
}

#[test]
fn a_panic_is_the_failure_of_its_item() {
    let arm = Arm::new(19);
    let trap = classified(&arm.space, |q| {
        assert!(q[0] < 9.0, "a trap");
        Ok(match q[0] {
            right if right > 0.0 => Class::Inside,
            _ => Class::Outside,
        })
    });
    let mut q = arm.configurations(300, 20);
    q[NQ * 41] = 10.0;
    q[NQ * 42] = 10.0;
    for threads in [1, 4] {
        let options = on_threads(threads);
        let mut found = vec![None; 300];
        let nothing = &mut |_| Ok(());
        let job = quiet(&options, &mut found[..], nothing);
        let done = Batch::new().classify(&trap, at(&q), job, keep).unwrap();
        let (number, error) = done.first_failure.unwrap();
        assert_eq!((number, error.kind), (41, ErrorKind::Internal));
        assert!(error.message.contains("a trap"), "{error}");
        for (i, q) in q.chunks(NQ).enumerate() {
            let expected = match q[0] {
                trapped if trapped > 9.0 => Err(ErrorKind::Internal),
                right if right > 0.0 => Ok(Class::Inside),
                _ => Ok(Class::Outside),
            };
            assert_eq!(found[i], Some(expected), "{i}");
        }
    }
}

#[test]
fn progress_rises_and_cancels() {
    let arm = Arm::new(21);
    let q = arm.configurations(1000, 22);
    let expected = classes(&arm, &q);
    for threads in [1, 3] {
        let options = on_threads(threads);
        let batch = &mut Batch::new();
        let mut heard = Vec::new();
        let mut found = vec![None; 1000];
        let mut hear = |fraction: f64| {
            heard.push(fraction);
            Ok(())
        };
        let job = quiet(&options, &mut found[..], &mut hear);
        batch.classify(&arm.contact, at(&q), job, keep).unwrap();
        assert!(heard.is_sorted() && heard.len() >= 2);
        assert_eq!([heard[0], heard[heard.len() - 1]], [0.0, 1.0]);
        for stop in 0..heard.len() {
            let mut calls = 0;
            let mut end = |_: f64| {
                calls += 1;
                if calls > stop {
                    return Err(Error::new(ErrorKind::Cancelled, "enough"));
                }
                Ok(())
            };
            let mut found = vec![None; 1000];
            let job = quiet(&options, &mut found[..], &mut end);
            // With threads that are faster than in the run before there are fewer calls.
            let done = batch.classify(&arm.contact, at(&q), job, keep);
            let end = done.unwrap().end;
            assert_eq!(end.is_some(), calls > stop);
            assert!(end.is_none_or(|end| end.kind == ErrorKind::Cancelled));
            for (found, expected) in found.iter().zip(&expected) {
                assert!(found.is_none() || found == expected);
            }
        }
    }
}

#[test]
fn all_items_see_one_state() {
    let arm = Arm::new(23);
    let q = arm.configurations(2000, 24);
    let expected = classes(&arm, &q);
    let options = on_threads(2);
    let changes = AtomicUsize::new(0);
    let mut move_all = |_: f64| {
        let ids: Vec<u64> = arm
            .environment
            .snapshot()
            .objects()
            .map(|object| object.id)
            .collect();
        let away = ids.iter().map(|&id| Change::Delete { id });
        if changes.fetch_add(1, Ordering::Relaxed) == 0 {
            arm.environment.apply(&away.collect::<Vec<_>>())?;
        }
        Ok(())
    };
    let version = arm.environment.snapshot().version;
    let mut found = vec![None; 2000];
    let job = quiet(&options, &mut found[..], &mut move_all);
    let done = Batch::new()
        .classify(&arm.contact, at(&q), job, keep)
        .unwrap();
    assert_eq!((done.version, &found), (version, &expected));
    assert!(arm.environment.snapshot().version > version);
    assert_ne!(classes(&arm, &q), expected);
}

/// With a limit an item does as much work as a new context does, whatever was asked before.
#[test]
fn limits_hold_for_each_item_alone() {
    let arm = Arm::new(25);
    let q = arm.configurations(400, 26);
    let limit = Some(25);
    let alone = |q: &[f64]| {
        let mut context = QueryContext::new();
        context.set_limit(limit);
        let class = context.classify(&arm.contact, Configuration::Coordinates(q));
        Some(class.map_err(|error| error.kind))
    };
    let expected: Vec<Found> = q.chunks(NQ).map(alone).collect();
    let limited = expected
        .iter()
        .filter(|class| **class == Some(Err(ErrorKind::Limit)))
        .count();
    assert!(limited > 20 && limited < 380, "{limited}");
    for threads in [1, 2, 7] {
        let options = BatchOptions {
            limit,
            ..on_threads(threads)
        };
        let mut found = vec![None; 400];
        let nothing = &mut |_| Ok(());
        let job = quiet(&options, &mut found[..], nothing);
        Batch::new()
            .classify(&arm.contact, at(&q), job, keep)
            .unwrap();
        assert_eq!(found, expected);
    }
}

#[test]
fn batches_without_order_are_refused() {
    let arm = Arm::new(27);
    let q = arm.configurations(4, 28);
    let nothing = &mut |_| Ok(());
    let put = |_: &mut &mut [bool], _: usize, _: ItemAnswer<bool>| panic!("nothing is asked");
    let mut refused = |at: Configurations, threshold: f64, options: &BatchOptions| {
        let job = quiet(options, &mut [][..], nothing);
        let done = Batch::new().within(&arm.contact, at, threshold, job, put);
        done.unwrap_err().kind
    };
    let one = &on_threads(1);
    let odd = Configurations {
        q: &q[1..],
        count: 4,
    };
    let many = Configurations {
        q: &q,
        count: usize::MAX,
    };
    assert_eq!(refused(odd, 0.0, one), ErrorKind::WrongSize);
    assert_eq!(refused(many, 0.0, one), ErrorKind::WrongSize);
    assert_eq!(refused(at(&q), f64::NAN, one), ErrorKind::NotFinite);
    assert_eq!(refused(at(&q), -1.0, one), ErrorKind::InvalidArgument);
    assert_eq!(
        refused(at(&q), 0.0, &on_threads(1025)),
        ErrorKind::InvalidArgument
    );
    // No items are a batch too.
    let none = Configurations { q: &[], count: 0 };
    let job = quiet(one, &mut [][..], nothing);
    let done = Batch::new()
        .within(&arm.contact, none, 0.0, job, put)
        .unwrap();
    assert!(done.first_hit.is_none() && done.first_failure.is_none());
}

/// More threads than a machine has, for fewer items than threads.
#[test]
fn few_items_have_few_threads() {
    let arm = Arm::new(29);
    for count in [1, 2, 9, 65] {
        let q = arm.configurations(count, 30);
        let mut found = vec![None; count];
        let nothing = &mut |_| Ok(());
        let options = on_threads(1024);
        let job = quiet(&options, &mut found[..], nothing);
        Batch::new()
            .classify(&arm.contact, at(&q), job, keep)
            .unwrap();
        assert_eq!(found, classes(&arm, &q));
    }
}

/// Within a run of items progress is told after each that takes long, and cancels before the next.
#[test]
fn long_items_are_reported_one_by_one() {
    let arm = Arm::new(31);
    let slow = classified(&arm.space, |_| {
        std::thread::sleep(Duration::from_millis(25));
        Ok(Class::Outside)
    });
    // Runs of three items.
    let q = arm.configurations(48, 32);
    let mut found = [None; 48];
    let mut end = |fraction: f64| match fraction {
        0.0 => Ok(()),
        _ => Err(Error::new(ErrorKind::Cancelled, "enough")),
    };
    let options = on_threads(1);
    let job = quiet(&options, &mut found[..], &mut end);
    let done = Batch::new().classify(&slow, at(&q), job, keep).unwrap();
    assert_eq!(done.end.map(|end| end.kind), Some(ErrorKind::Cancelled));
    assert_eq!(found.iter().flatten().count(), 1);
}
