//! Our queries against those of FCL, Coal and parry on the same poses in one process:
//! `scripts/bench.sh kernel [--csv FILE] [--quick] [--seed N] [--only TEXT]`.
//!
//! Every variant of every library runs each row once; the fastest of each library then run several times in turn with ours,
//! and medians count. All answers are compared.

mod case;
#[path = "../peers/library.rs"]
mod library;
mod ours;
mod parry;
mod peer;
mod runner;
mod scaling;

use std::fmt::Write as _;

use cstk::hierarchy::WrapperKind;

use case::{Case, Mode, Query, cases};
use ours::Asked;
use parry::Parry;
use peer::Peer;
use runner::Runner;

/// The head of the tables. B and H are wrappers, C remembers witnesses, T is HC over the same polygons as triangles.
const HEAD: &str = "| row | polygons | B | BC | H | HC = default | T = default, triangles | FCL | Coal | parry | best peer / \
                    default | best peer / T | boxes, primitives a query |\n\
                    | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |";

/// How many of the runners are ours; the last two are those that ratios are of.
const OURS: usize = 5;

/// How often the fastest variants run.
const REPEATS: usize = 5;

/// What is slower is run once.
const SLOW: f64 = 2.0;

/// What is faster has each pass that counts follow another.
const BRIEF: f64 = 0.1;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| {
        let place = arguments.iter().position(|a| a == name)?;
        arguments.get(place + 1).cloned()
    };
    let quick = arguments.iter().any(|a| a == "--quick");
    let seed = value("--seed").map_or(0, |seed| seed.parse().expect("--seed takes a number"));
    let only = value("--only");
    let wanted = |name: &str| {
        only.as_ref()
            .is_none_or(|text| name.contains(text.as_str()))
    };
    let peers: Vec<Peer> = [("FCL", "fcl"), ("Coal", "coal")]
        .into_iter()
        .filter_map(|(name, prefix)| Peer::open(name, prefix))
        .collect();
    let mut csv = String::from("scene,mode,library,variant,microseconds_per_query\n");
    println!("{HEAD}");
    let mut ratios: Vec<[f64; 2]> = Vec::new();
    let mut culled = Vec::new();
    for case in cases(quick, seed).iter().filter(|case| wanted(&case.name)) {
        for &mode in &case.modes {
            let (line, ratio) = row(case, mode, &peers, &mut csv);
            if (case.counts)(mode) {
                println!("{line}");
                ratios.extend(ratio);
            } else {
                culled.push(line);
            }
        }
    }
    println!("\nRows in which everything is culled at once:\n");
    println!("{HEAD}");
    for line in culled {
        println!("{line}");
    }
    println!();
    for (column, name) in ["default", "T"].into_iter().enumerate() {
        let ratios: Vec<f64> = ratios.iter().map(|both| both[column]).collect();
        let mean = ratios.iter().map(|r| r.ln()).sum::<f64>() / ratios.len().max(1) as f64;
        let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        println!(
            "Geometric mean of best peer / {name} over the {} rows of the first table: {:.1}, least {least:.1}.",
            ratios.len(),
            mean.exp()
        );
    }
    if wanted("scaling") {
        scaling::table(quick, seed, &mut csv);
    }
    if let Some(file) = value("--csv") {
        std::fs::write(&file, csv).unwrap_or_else(|error| panic!("{file}: {error}"));
        println!("\nwritten: {file}");
    }
}

/// Measures one row. The line of the table, and the ratios of the best peer's time to ours with polygons and with triangles.
fn row(case: &Case, mode: Mode, peers: &[Peer], csv: &mut String) -> (String, Option<[f64; 2]>) {
    let kind = match case.query {
        Query::Pair => "",
        Query::CObject => ", C-object",
    };
    let name = format!("{} {}{kind}", case.name, mode.name());
    let asked = [WrapperKind::AlignedBox, WrapperKind::Hull].map(|w| Asked::new(case, w));
    let in_triangles = case.in_triangles();
    let triangles = Asked::new(&in_triangles, WrapperKind::Hull);
    let parry = Parry::new(case);
    let mut runners: Vec<Runner> = Vec::new();
    for (asked, letter) in asked.iter().zip(["B", "H"]) {
        for (cached, suffix) in [(false, ""), (true, "C")] {
            runners.push(Runner::new(
                "cstk",
                format!("{letter}{suffix}"),
                move || {
                    let pass = asked.run(case, mode, cached);
                    Some((pass.seconds, pass.answers))
                },
            ));
        }
    }
    runners.push(Runner::new("cstk", "T", || {
        let pass = triangles.run(&in_triangles, mode, true);
        Some((pass.seconds, pass.answers))
    }));
    for peer in peers {
        runners.extend(peer.runners(case, mode));
    }
    runners.push(Runner::new("parry", "trimesh", || parry.run(mode)));
    let notes = first_passes(&name, mode, &mut runners);
    let kept = fastest(&runners);
    for _ in 0..REPEATS {
        for &i in &kept {
            let runner = &mut runners[i];
            if runner.seconds[0] > SLOW {
                continue;
            }
            // Each finds its bodies in the caches, whoever came before.
            if runner.seconds[0] < BRIEF {
                (runner.run)();
            }
            if let Some((seconds, _)) = (runner.run)() {
                runner.seconds.push(seconds);
            }
        }
    }
    eprint!("\r{:78}\r", "");
    let micro = |runner: &Runner| runner.median() / case.poses.len() as f64 * 1e6;
    for &i in &kept {
        let runner = &runners[i];
        let (scene, mode) = (&case.name, mode.name());
        let (library, variant) = (runner.library, &runner.variant);
        writeln!(
            csv,
            "{scene},{mode},{library},{variant},{:.4}",
            micro(runner)
        )
        .expect("strings grow");
    }
    let best = |library: &str| {
        kept.iter()
            .map(|&i| &runners[i])
            .filter(|runner| runner.library == library)
            .map(|runner| (micro(runner), &runner.variant))
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let libraries = ["FCL", "Coal", "parry"];
    let shown = libraries.map(|library| {
        best(library).map_or("-".into(), |(us, variant)| format!("{us:.3} ({variant})"))
    });
    let times = libraries
        .iter()
        .filter_map(|library| Some(best(library)?.0));
    let best_peer = times.fold(f64::INFINITY, f64::min);
    let ours: Vec<String> = runners[..OURS]
        .iter()
        .map(|runner| format!("{:.3}", micro(runner)))
        .collect();
    let ratios = [OURS - 2, OURS - 1].map(|i| best_peer / micro(&runners[i]));
    let tests = asked[1].run(case, mode, true).tests;
    let polygons = case.polygons();
    for note in notes {
        eprintln!("  {name}: {note}");
    }
    let line = format!(
        "| {name} | {}, {} | {} | {} | {:.1} | {:.1} | {:.0}, {:.1} |",
        polygons[0],
        polygons[1],
        ours.join(" | "),
        shown.join(" | "),
        ratios[0],
        ratios[1],
        tests[0],
        tests[1],
    );
    (line, best_peer.is_finite().then_some(ratios))
}

/// Runs everything once and compares the answers with our first; says where they differ.
fn first_passes(name: &str, mode: Mode, runners: &mut [Runner]) -> Vec<String> {
    let mut expected: Vec<f64> = Vec::new();
    let mut differing: Vec<(&str, String, usize, f64)> = Vec::new();
    for runner in runners {
        let (library, variant) = (runner.library, &runner.variant);
        eprint!("\r{:78}\r{name}: {library} {variant}", "");
        let Some((seconds, answers)) = (runner.run)() else {
            continue;
        };
        runner.seconds.push(seconds);
        if expected.is_empty() {
            expected = answers;
            continue;
        }
        let allowed = if mode == Mode::Distance { 1e-7 } else { 0.5 };
        let differences = expected.iter().zip(&answers).map(|(a, b)| (a - b).abs());
        let (count, worst) = differences
            .filter(|&d| d > allowed)
            .fold((0, 0.0f64), |(n, worst), d| (n + 1, worst.max(d)));
        if count > 0 {
            differing.push((library, variant.clone(), count, worst));
        }
    }
    differing
        .chunk_by(|a, b| a.0 == b.0)
        .map(|same| {
            let variants: Vec<&str> = same.iter().map(|d| d.1.as_str()).collect();
            let count = same.iter().map(|d| d.2).max().unwrap_or(0);
            let worst = same.iter().map(|d| d.3).fold(0.0, f64::max);
            let (library, variants) = (same[0].0, variants.join(", "));
            format!("{library} differs in up to {count} answers, by up to {worst:.1e} ({variants})")
        })
        .collect()
}

/// All of ours, and the two fastest variants of each peer.
fn fastest(runners: &[Runner]) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..OURS).collect();
    for library in ["FCL", "Coal", "parry"] {
        let mut of: Vec<usize> = (0..runners.len())
            .filter(|&i| runners[i].library == library && !runners[i].seconds.is_empty())
            .collect();
        of.sort_by(|&i, &j| runners[i].seconds[0].total_cmp(&runners[j].seconds[0]));
        kept.extend(of.into_iter().take(2));
    }
    kept
}
