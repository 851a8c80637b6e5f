//! Environments that change while others ask.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use cstk::cobject::{CObject, Leaf};
use cstk::environment::Environment;
use cstk::query::{Configuration, QueryContext};

use helpers::changing::{Model, change, configurations, options, spatial_bodies};
use helpers::random::Random;
use helpers::robots::{against_with, free_body, space};

/// Four threads ask while one changes the environment as fast as it can: each answer is that of one state, whole, as asked
/// of it again when all is still. CSTK_STRESS_SECONDS says for how long.
#[test]
fn answers_under_change_are_those_of_one_state() {
    let seconds = std::env::var("CSTK_STRESS_SECONDS").ok();
    let seconds = seconds
        .and_then(|seconds| seconds.parse().ok())
        .unwrap_or(2.0);
    let end = Instant::now() + Duration::from_secs_f64(seconds);
    let mut random = Random::new(46);
    let bodies = spatial_bodies(&mut random);
    let space = space(vec![free_body(&bodies[3])]);
    let live = Arc::new(Environment::default());
    let cobject = against_with(&space, &live, options());
    let mut model = Model::new();
    let mut contexts: Vec<QueryContext> = (0..4).map(|_| QueryContext::new()).collect();
    let (mut asked, mut changes, mut versions_seen) = (0, 0, 0);
    let is_enough = |asked: usize, versions_seen: usize| asked > 100 && versions_seen > 50;
    let mut rounds = 0;
    // Longer on a machine that is busy otherwise, where few threads run.
    while Instant::now() < end || rounds < 200 && !is_enough(asked, versions_seen) {
        rounds += 1;
        let changing = AtomicBool::new(true);
        let mut states = BTreeMap::from([(live.snapshot().version, live.freeze())]);
        let found: Vec<_> = std::thread::scope(|scope| {
            let readers: Vec<_> = contexts
                .iter_mut()
                .map(|context| {
                    let at = configurations(&mut random, 400);
                    let (changing, cobject) = (&changing, &cobject);
                    scope.spawn(move || {
                        let still = |_: &[f64; 6]| changing.load(Ordering::Relaxed);
                        let ask = |q| (q, said_in_short(cobject, &q, context));
                        at.into_iter()
                            .take_while(still)
                            .map(ask)
                            .collect::<Vec<_>>()
                    })
                })
                .collect();
            for step in 0..300 {
                // Where there are fewer processors than threads, the others are to see more than a few states.
                if step % 5 == 0 {
                    std::thread::yield_now();
                }
                change(&live, &mut model, &bodies, &mut random, 200);
                let frozen = live.freeze();
                states.insert(frozen.snapshot().version, frozen);
            }
            changing.store(false, Ordering::Relaxed);
            let joined = readers.into_iter().map(|reader| reader.join().unwrap());
            joined.flatten().collect()
        });
        changes += states.len() - 1;
        asked += found.len();
        let states: BTreeMap<u64, Arc<Environment>> = states
            .into_iter()
            .map(|(v, state)| (v, Arc::new(state)))
            .collect();
        let mut seen = BTreeSet::new();
        for (q, said) in found {
            for (version, said) in said {
                let alone = against_with(&space, &states[&version], options());
                let again = said_in_short(&alone, &q, &mut QueryContext::new());
                assert!(again.contains(&(version, said.clone())), "{said} {again:?}");
                seen.insert(version);
            }
        }
        versions_seen += seen.len();
    }
    println!("{asked} answers on {versions_seen} of {changes} states");
    assert!(is_enough(asked, versions_seen));
}

/// Two answers with the versions they are of.
fn said_in_short(
    cobject: &CObject,
    q: &[f64; 6],
    context: &mut QueryContext,
) -> [(u64, String); 2] {
    let at = Configuration::Coordinates(q);
    let mut distance = context.distance(cobject, at, f64::INFINITY).unwrap();
    let mut list = context.witnesses(cobject, at, 0.1, usize::MAX).unwrap();
    // Which C-object was asked is of no interest.
    for witness in distance.witness.iter_mut().chain(&mut list.witnesses) {
        witness.leaf = Leaf::default();
    }
    [
        (distance.version, format!("{distance:?}")),
        (list.version, format!("{list:?}")),
    ]
}
