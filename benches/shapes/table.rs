//! What is printed and written of the rows.

use std::fmt::Write as _;

use super::measure::Best;

const PEERS: [&str; 3] = ["FCL", "Coal", "parry"];

pub struct Table {
    pub csv: String,
    group: &'static str,
    ratios: Vec<(&'static str, String, f64)>,
    /// Of each peer's answers, how many were compared and how many differ.
    compared: [[usize; 2]; 3],
}

impl Table {
    pub fn new() -> Self {
        Self {
            csv: String::from("case,poses,query,library,nanoseconds\n"),
            group: "",
            ratios: Vec::new(),
            compared: [[0; 2]; 3],
        }
    }

    /// Prints a row. `[case, poses, query]` name it.
    pub fn row(&mut self, group: &'static str, name: [&str; 3], count: usize, best: &[Best]) {
        self.start(group);
        let Some((ours, peers)) = best.split_first() else {
            return;
        };
        let shown = PEERS.map(|library| {
            let found = peers.iter().find(|best| best.library == library);
            found.map_or("-".into(), |best| cell(best, count))
        });
        let fastest = peers.iter().map(|best| best.nanoseconds);
        let ratio = fastest.fold(f64::INFINITY, f64::min) / ours.nanoseconds;
        let [case, poses, query] = name;
        println!(
            "| {case} | {poses} | {query} | {:.0} | {} | {ratio:.2} |",
            ours.nanoseconds,
            shown.join(" | ")
        );
        if ratio.is_finite() {
            self.ratios.push((group, name.join(", "), ratio));
        }
        for best in best {
            let (library, ns) = (best.library, best.nanoseconds);
            writeln!(self.csv, "{case},{poses},{query},{library},{ns:.1}").expect("strings grow");
            let peer = PEERS.iter().position(|name| *name == library);
            if let (Some(peer), Some(differing)) = (peer, best.differing) {
                self.compared[peer][0] += count;
                self.compared[peer][1] += differing;
            }
        }
    }

    fn start(&mut self, group: &'static str) {
        if self.group != group {
            self.group = group;
            println!("\n### {}\n", capitalised(group));
            println!(
                "| case | poses | query | cstk, ns | FCL, ns | Coal, ns | parry, ns | best peer / cstk |"
            );
            println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
        }
    }

    pub fn finish(&self) {
        println!("\n| group | rows | geometric mean of best peer / cstk | least | of |");
        println!("| --- | --- | --- | --- | --- |");
        for of_group in self.ratios.chunk_by(|a, b| a.0 == b.0) {
            let logarithms: f64 = of_group.iter().map(|row| row.2.ln()).sum();
            let mean = (logarithms / of_group.len() as f64).exp();
            let least = of_group.iter().min_by(|a, b| a.2.total_cmp(&b.2));
            if let Some((group, name, least)) = least {
                let rows = of_group.len();
                println!("| {group} | {rows} | {mean:.2} | {least:.2} | {name} |");
            }
        }
        println!();
        for (library, [compared, differing]) in PEERS.iter().zip(self.compared) {
            println!("{library}: {compared} answers compared, {differing} differ");
        }
    }
}

fn cell(best: &Best, count: usize) -> String {
    let mut notes = Vec::new();
    if !best.variant.is_empty() {
        notes.push(best.variant.clone());
    }
    match best.differing {
        None => notes.push("another body".into()),
        Some(0) => {}
        Some(differing) => notes.push(format!("{differing} of {count} differ")),
    }
    match notes.is_empty() {
        true => format!("{:.0}", best.nanoseconds),
        false => format!("{:.0} ({})", best.nanoseconds, notes.join("; ")),
    }
}

fn capitalised(text: &str) -> String {
    let (first, rest) = text.split_at(1);
    first.to_uppercase() + rest
}
