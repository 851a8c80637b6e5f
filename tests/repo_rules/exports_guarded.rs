//! No panic leaves the library: every exported function runs in the guard, and panics unwind in every profile.

use super::{root, sources};

/// Exported functions that cannot fail and hand out static or thread-local text.
const UNGUARDED: [&str; 3] = [
    "cstk_status_name",
    "cstk_last_error_message",
    "cstk_version",
];

pub(super) struct Export {
    pub(super) name: String,
    body: String,
}

/// The exported functions of a source text. rustfmt closes each at the indentation of its attribute.
pub(super) fn exports(text: &str) -> Vec<Export> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let attribute = line.trim_start();
        if !attribute.starts_with("#[") || !attribute.contains("no_mangle") {
            continue;
        }
        let end = format!("{}}}", &line[..line.len() - attribute.len()]);
        let text: Vec<&str> = lines[i + 1..]
            .iter()
            .take_while(|line| **line != end)
            .map(|line| line.split("//").next().unwrap_or_default())
            .collect();
        let text = text.join("\n");
        let after = text.split("fn ").nth(1).expect("an exported function");
        let name = after
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_');
        found.push(Export {
            name: name.collect(),
            body: after
                .split_once('{')
                .map_or("", |(_, body)| body)
                .to_string(),
        });
    }
    found
}

/// Whether a call of `name` stands in the text, and not of a function whose name merely ends so.
fn calls(text: &str, name: &str) -> bool {
    text.match_indices(&format!("{name}("))
        .any(|(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric() || "_.".contains(c)))
}

/// Those of a file's own functions `run` and `run_at` that are guarded calls, by `guard` or by one another: they may stand for the
/// guard there.
fn guarded_runs(text: &str) -> Vec<&'static str> {
    let mut guarded = vec!["guard"];
    for name in ["run", "run_at"] {
        let own = text.split(&format!("fn {name}<")).nth(1);
        let body = own.and_then(|rest| rest.split("\n}").next());
        if body.is_some_and(|body| guarded.iter().any(|guard| calls(body, guard))) {
            guarded.push(name);
        }
    }
    guarded
}

/// The same of functions that a file imports from another of the C layer.
fn imported_runs(text: &str) -> Vec<&'static str> {
    let imports = text
        .lines()
        .filter_map(|line| line.strip_prefix("use crate::capi::"));
    let mut guarded = Vec::new();
    for import in imports {
        let Some((module, names)) = import.trim_end_matches(';').rsplit_once("::") else {
            continue;
        };
        let file = root().join(format!("src/capi/{}.rs", module.replace("::", "/")));
        let own = std::fs::read_to_string(file).map_or(Vec::new(), |text| guarded_runs(&text));
        let is_imported = |name: &&str| {
            names
                .split(|c: char| !c.is_alphanumeric() && c != '_')
                .any(|word| word == *name)
        };
        guarded.extend(own.into_iter().filter(is_imported));
    }
    guarded
}

#[test]
fn every_export_runs_in_the_guard() {
    let mut names = Vec::new();
    let mut bare = Vec::new();
    for path in sources(&root().join("src/capi")) {
        let text = std::fs::read_to_string(&path).unwrap();
        let mut guarded = guarded_runs(&text);
        guarded.extend(imported_runs(&text));
        for export in exports(&text) {
            if !guarded.iter().any(|guard| calls(&export.body, guard)) {
                bare.push(export.name.clone());
            }
            names.push(export.name);
        }
    }
    assert!(names.len() > 40, "only {} exports were found", names.len());
    bare.sort();
    let mut allowed = UNGUARDED.to_vec();
    allowed.sort_unstable();
    assert_eq!(
        bare, allowed,
        "unguarded exports (left) and those allowed (right)"
    );
}

#[test]
fn panics_unwind_in_every_profile() {
    for file in ["Cargo.toml", ".cargo/config.toml", ".cargo/config"] {
        let Ok(text) = std::fs::read_to_string(root().join(file)) else {
            assert_ne!(file, "Cargo.toml");
            continue;
        };
        for (i, line) in text.lines().enumerate() {
            let code: String = line
                .split('#')
                .next()
                .unwrap_or_default()
                .split_whitespace()
                .collect();
            let aborts = code.contains("panic=\"abort\"") || code.contains("panic='abort'");
            assert!(!aborts, "{file}:{} makes panics abort", i + 1);
        }
    }
}

/// The reader of source texts tells a guarded function from one that is not.
#[test]
fn an_unguarded_export_is_seen() {
    let text = "\
#[unsafe(no_mangle)]
pub extern \"C\" fn cstk_good(x: i32) -> cstk_status {
    guard(|| Ok(()))
}

#[unsafe(no_mangle)]
pub unsafe extern \"C\" fn cstk_bad(x: i32) -> cstk_status {
    // guard( is only spoken of
    rerun(x)
}
";
    let found = exports(text);
    let guarded: Vec<(&str, bool)> = found
        .iter()
        .map(|export| {
            (
                &export.name[..],
                calls(&export.body, "guard") || calls(&export.body, "run"),
            )
        })
        .collect();
    assert_eq!(guarded, [("cstk_good", true), ("cstk_bad", false)]);
}
