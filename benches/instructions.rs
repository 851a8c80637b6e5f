//! Instructions a query takes, counted by callgrind, so that a change of some percent shows on a noisy machine too:
//! `scripts/bench.sh instructions [--csv FILE]`.

#[path = "kernel/case.rs"]
#[allow(dead_code)]
mod case;
#[path = "kernel/ours.rs"]
#[allow(dead_code)]
mod ours;

use std::fmt::Write as _;
use std::process::Command;

use cstk::hierarchy::WrapperKind;

use case::{Case, Mode, cases};
use ours::Asked;

/// What callgrind is told to count.
const COUNTED: &str = "*counted_pass*";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| {
        let place = arguments.iter().position(|a| a == name)?;
        arguments.get(place + 1).cloned()
    };
    // The report's scenes; larger ones take callgrind too long.
    let is_small = |case: &Case| case.polygons().iter().sum::<usize>() < 20_000;
    let cases: Vec<Case> = cases(true, 0)
        .into_iter()
        .filter(is_small)
        .flat_map(|case| {
            let name = format!("{} in triangles", case.name);
            let in_triangles = Case {
                name,
                ..case.in_triangles()
            };
            [case, in_triangles]
        })
        .collect();
    if let (Some(name), Some(mode)) = (value("--case"), value("--mode")) {
        let case = cases.iter().find(|case| case.name == name);
        let case = case.expect("--case names a case");
        let mode = case.modes.iter().find(|m| m.name() == mode);
        let asked = Asked::new(case, WrapperKind::Hull);
        let mode = *mode.expect("--mode names one of the case's");
        // What is built once is not counted.
        asked.run(case, mode, true);
        counted_pass(&asked, case, mode);
        return;
    }
    let mut csv = String::from("scene,mode,instructions_per_query\n");
    println!("| row | instructions a query |\n| --- | --- |");
    for case in &cases {
        for &mode in &case.modes {
            let count = count(&case.name, &mode.name()) / case.poses.len() as u64;
            println!("| {} {} | {count} |", case.name, mode.name());
            writeln!(csv, "{},{},{count}", case.name, mode.name()).expect("strings grow");
        }
    }
    if let Some(file) = value("--csv") {
        std::fs::write(&file, csv).unwrap_or_else(|error| panic!("{file}: {error}"));
        println!("\nwritten: {file}");
    }
}

#[inline(never)]
fn counted_pass(asked: &Asked, case: &Case, mode: Mode) {
    std::hint::black_box(asked.run(case, mode, true).answers);
}

/// Runs one row in a process of its own, under callgrind.
fn count(name: &str, mode: &str) -> u64 {
    let this = std::env::current_exe().expect("this program has a path");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(format!("--toggle-collect={COUNTED}"))
        .arg(this)
        .args(["--case", name, "--mode", mode])
        .output()
        .unwrap_or_else(|error| panic!("valgrind: {error}"));
    let text = String::from_utf8_lossy(&output.stderr);
    let collected = text
        .lines()
        .find_map(|line| line.split("Collected : ").nth(1));
    let count = collected.and_then(|count| count.trim().parse().ok());
    count.unwrap_or_else(|| panic!("callgrind counted nothing:\n{text}"))
}
