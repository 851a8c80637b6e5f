//! One row: every way of every library once, and the best several times in turn.

use std::time::Instant;

use super::ours::Ours;
use super::parry::Parry;
use super::peer::Peer;
use super::placement::Placement;
use super::question::{Query, Question};
use super::runner::Runner;
use super::shape::Shape;

/// How often the best run.
const REPEATS: usize = 7;

/// Of each peer's ways, so many are measured in the end.
const KEPT: usize = 2;

/// What takes longer than this many seconds runs less often.
const SLOW: f64 = 0.1;

/// Seconds that are measured at least each time.
const LEAST: f64 = 0.004;

/// Distances of bodies of about 1 may differ by this; nearer than this, bodies may count as touching.
const ALLOWED: f64 = 1e-6;

/// A library's best way in a row.
pub struct Best {
    pub library: &'static str,
    pub variant: String,
    pub nanoseconds: f64,
    /// Of its answers, those that are not ours; None where its body is another.
    pub differing: Option<usize>,
}

/// A way to answer, and how many answers are not ours.
struct Candidate<'a> {
    runner: Runner<'a>,
    differing: Option<usize>,
}

/// The best of each library, ours first.
pub fn measured(
    shapes: &[Shape; 2],
    ours: &Ours,
    question: &Question,
    peers: &[Peer],
) -> Vec<Best> {
    let mut runners = vec![Runner::new("cstk", "C interface", || {
        Some(our_pass(ours, question))
    })];
    for peer in peers {
        runners.extend(peer.runners(shapes, question));
    }
    if let Some(parry) = Parry::new(shapes, question) {
        runners.push(Runner::new("parry", "", move || parry.run(question)));
    }
    let expected = our_pass(ours, question).1;
    let near: Vec<bool> = question
        .placed
        .iter()
        .map(|at| (0.0..=ALLOWED).contains(&ours.distance(at)) && !ours.within(at, 0.0))
        .collect();
    let mut candidates: Vec<Candidate> = Vec::new();
    for mut runner in runners {
        if let Some((seconds, answers)) = (runner.run)() {
            if seconds > LEAST {
                runner.seconds.push(seconds);
            } else {
                run_for_a_while(&mut runner);
            }
            let is_same = !shapes.iter().any(Shape::is_cloud) || runner.library == "parry";
            let differing = is_same.then(|| differing(question.query, &expected, &answers, &near));
            candidates.push(Candidate { runner, differing });
        }
    }
    let candidates = repeated(fastest(question.query, candidates));
    best_of_each(&candidates, question.placed.len())
}

fn our_pass(ours: &Ours, question: &Question) -> (f64, Vec<f64>) {
    let yes = |yes: bool| f64::from(u8::from(yes));
    let answer = |at: &Placement, threshold: f64| match question.query {
        Query::Distance => ours.distance(at),
        Query::Within(_) | Query::Collide => yes(ours.within(at, threshold)),
        Query::Contacts(most) => ours.witnesses(at, most) as f64,
    };
    let mut answers = Vec::with_capacity(question.placed.len());
    let start = Instant::now();
    for (at, threshold) in question.placed.iter().zip(&question.thresholds) {
        answers.push(answer(at, *threshold));
    }
    (start.elapsed().as_secs_f64(), answers)
}

/// Passes until enough was measured; keeps their mean.
fn run_for_a_while(runner: &mut Runner) {
    let (mut total, mut passes) = (0.0, 0);
    while total < LEAST {
        let Some((seconds, _)) = (runner.run)() else {
            return;
        };
        total += seconds;
        passes += 1;
    }
    runner.seconds.push(total / f64::from(passes));
}

fn differing(query: Query, expected: &[f64], answers: &[f64], near: &[bool]) -> usize {
    let differs = |ours: f64, theirs: f64| match query {
        Query::Distance => (ours - theirs).abs() > ALLOWED,
        // How many pairs there are depends on how triangles are paired.
        Query::Contacts(_) => (ours > 0.0) != (theirs > 0.0),
        Query::Within(_) | Query::Collide => ours != theirs,
    };
    let pairs = expected.iter().zip(answers).zip(near);
    pairs
        .filter(|((ours, theirs), near)| differs(**ours, **theirs) && !**near)
        .count()
}

/// Of each library the fastest; of yes-or-no answers, only from ways that err least.
fn fastest(query: Query, mut candidates: Vec<Candidate>) -> Vec<Candidate> {
    let errors = |candidate: &Candidate| match query {
        Query::Distance => 0,
        _ => candidate.differing.unwrap_or(0),
    };
    candidates.sort_by(|a, b| {
        let times = a.runner.median().total_cmp(&b.runner.median());
        errors(a).cmp(&errors(b)).then(times)
    });
    let mut seen: Vec<(&str, usize)> = Vec::new();
    candidates.retain(|candidate| {
        let own: Vec<usize> = seen
            .iter()
            .filter(|(library, _)| *library == candidate.runner.library)
            .map(|(_, errors)| *errors)
            .collect();
        seen.push((candidate.runner.library, errors(candidate)));
        own.len() < KEPT && own.first().is_none_or(|least| *least == errors(candidate))
    });
    candidates
}

/// Run in turn.
fn repeated(mut candidates: Vec<Candidate>) -> Vec<Candidate> {
    for repeat in 0..REPEATS {
        for Candidate { runner, .. } in &mut candidates {
            if repeat < 2 || runner.median() < SLOW {
                run_for_a_while(runner);
            }
        }
    }
    candidates
}

fn best_of_each(candidates: &[Candidate], poses: usize) -> Vec<Best> {
    ["cstk", "FCL", "Coal", "parry"]
        .into_iter()
        .filter_map(|library| {
            let own = candidates.iter().filter(|c| c.runner.library == library);
            let best = own.min_by(|a, b| a.runner.median().total_cmp(&b.runner.median()))?;
            Some(Best {
                library,
                variant: best.runner.variant.clone(),
                nanoseconds: best.runner.median() / poses as f64 * 1e9,
                differing: best.differing,
            })
        })
        .collect()
}
