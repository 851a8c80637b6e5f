//! How the time of a query grows with the number of polygons.

use std::fmt::Write as _;

use cstk::hierarchy::WrapperKind;
use cstk_scenes::bumpy_pair_coherent;

use super::case::{Case, Mode, Query};
use super::ours::Asked;

const REPEATS: usize = 5;

/// Distances of the bodies, which are about 1 in diameter.
const GAPS: [f64; 2] = [0.01, 1.0];

pub fn table(quick: bool, seed: u64, csv: &mut String) {
    println!(
        "\nThe same two bumpy bodies in ever smaller triangles, on an arc at a fixed distance:\n"
    );
    println!(
        "| polygons each | bytes a polygon for queries | D at 0.01, µs | D at 1, µs | collide at 0.01, µs | boxes at 0.01, at 1 |"
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    let sizes: &[usize] = if quick {
        &[1_000, 10_000]
    } else {
        &[1_000, 10_000, 100_000, 1_000_000]
    };
    for &polygons in sizes {
        eprint!("\r{:78}\rscaling: {polygons} polygons", "");
        let mut times = Vec::new();
        let mut boxes = Vec::new();
        let mut bytes = 0.0;
        for gap in GAPS {
            let scene = bumpy_pair_coherent(polygons, gap, 1 + seed);
            let case = Case::of(scene, Query::Pair, &[]);
            let asked = Asked::new(&case, WrapperKind::Hull);
            bytes = asked.bytes() as f64 / case.polygons().iter().sum::<usize>() as f64;
            for mode in [Mode::Distance, Mode::Collide] {
                let mut passes: Vec<f64> = (0..REPEATS)
                    .map(|_| asked.run(&case, mode, true).seconds)
                    .collect();
                passes.sort_by(f64::total_cmp);
                let micro = passes[REPEATS / 2] / case.poses.len() as f64 * 1e6;
                writeln!(
                    csv,
                    "scaling {polygons} {gap},{},cstk,HC,{micro:.4}",
                    mode.name()
                )
                .expect("strings grow");
                times.push(micro);
            }
            boxes.push(asked.run(&case, Mode::Distance, true).tests[0]);
        }
        eprint!("\r{:78}\r", "");
        println!(
            "| {polygons} | {bytes:.0} | {:.2} | {:.2} | {:.3} | {:.0}, {:.0} |",
            times[0], times[2], times[1], boxes[0], boxes[1]
        );
    }
}
