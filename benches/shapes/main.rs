//! Pairs of bodies asked by the C interface, against FCL, Coal and parry on the same poses in one process:
//! `scripts/bench.sh shapes [--csv FILE] [--quick] [--seed N] [--only TEXT]`.

#[path = "../kernel/case.rs"]
#[allow(dead_code)]
mod case;
#[path = "../peers/library.rs"]
mod library;
mod measure;
mod ours;
mod parry;
mod peer;
mod placement;
mod poses;
mod question;
mod rows;
#[path = "../kernel/runner.rs"]
mod runner;
mod shape;
mod table;

use measure::measured;
use ours::Ours;
use peer::Peer;
use poses::placements;
use question::Question;
use rows::Rows;
use table::Table;

struct Options {
    csv: Option<String>,
    only: String,
    quick: bool,
    seed: u64,
}

impl Options {
    fn read(mut arguments: impl Iterator<Item = String>) -> Self {
        let mut options = Self {
            csv: None,
            only: String::new(),
            quick: false,
            seed: 1,
        };
        while let Some(name) = arguments.next() {
            let mut value = || {
                arguments
                    .next()
                    .unwrap_or_else(|| panic!("{name} needs a value"))
            };
            match name.as_str() {
                "--csv" => options.csv = Some(value()),
                "--only" => options.only = value(),
                "--seed" => options.seed = value().parse().expect("--seed takes a number"),
                "--quick" => options.quick = true,
                // What cargo adds.
                "--bench" => {}
                _ => panic!("unknown option {name}"),
            }
        }
        options
    }
}

fn main() {
    let options = Options::read(std::env::args().skip(1));
    let peers: Vec<Peer> = [("FCL", "fcl"), ("Coal", "coal")]
        .into_iter()
        .filter_map(|(name, prefix)| Peer::open(name, prefix))
        .collect();
    let mut table = Table::new();
    for make in rows::all(options.quick, options.seed) {
        measure_rows(&make(), &options, &peers, &mut table);
    }
    eprint!("\r{:78}\r", "");
    table.finish();
    if let Some(file) = options.csv {
        std::fs::write(&file, &table.csv).unwrap_or_else(|error| panic!("{file}: {error}"));
        println!("\nwritten: {file}");
    }
}

fn measure_rows(rows: &Rows, options: &Options, peers: &[Peer], table: &mut Table) {
    let (case, motion) = (rows.name(), rows.motion.name());
    let names: Vec<String> = rows.queries.iter().map(|query| query.name()).collect();
    let is_wanted =
        |query: &str| format!("{} {case} {motion} {query}", rows.group).contains(&options.only);
    if !names.iter().any(|name| is_wanted(name)) {
        return;
    }
    let ours = Ours::new(&rows.shapes);
    let count = if options.quick {
        rows.poses / 4
    } else {
        rows.poses
    };
    let placed = placements(&ours, rows.motion, rows.gaps, count, options.seed);
    for (query, name) in rows.queries.iter().zip(&names) {
        if is_wanted(name) {
            eprint!("\r{:78}\r{case}, {motion}, {name}", "");
            let question = Question::new(*query, placed.clone(), &ours);
            let best = measured(&rows.shapes, &ours, &question, peers);
            eprint!("\r{:78}\r", "");
            table.row(rows.group, [&case, motion, name], count, &best);
        }
    }
}
