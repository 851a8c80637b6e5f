//! The modules form one order, that of src/lib.rs: each imports only from those that stand before it.

use std::path::Path;

use super::{root, sources};

/// The modules that a `mod` line of src/lib.rs names, in order.
fn modules(lib: &str) -> Vec<String> {
    lib.lines()
        .filter_map(|line| {
            let line = line.strip_prefix("pub ").unwrap_or(line);
            let name = line.strip_prefix("mod ")?.strip_suffix(';')?;
            Some(name.to_string())
        })
        .collect()
}

/// The modules of the crate that a source text refers to, each with the line. `depth` is how far the file's module lies
/// under the crate: 1 for src/a.rs and src/a/mod.rs, 2 for src/a/b.rs.
fn references(text: &str, depth: usize) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    // The indentation of the inline modules that are open; rustfmt closes each where it began.
    let mut inline: Vec<usize> = Vec::new();
    // A `use crate::{` that goes on over several lines.
    let mut group: Option<String> = None;
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        let indent = line.len() - line.trim_start().len();
        let trimmed = code.trim();
        if trimmed == "}" && inline.last() == Some(&indent) {
            inline.pop();
        }
        let opened = trimmed.trim_start_matches("pub ");
        if opened.starts_with("mod ") && opened.ends_with('{') {
            inline.push(indent);
        }
        if let Some(open) = &mut group {
            open.push_str(trimmed);
            if trimmed.ends_with(';') {
                found.extend(group_names(open).into_iter().map(|name| (number + 1, name)));
                group = None;
            }
            continue;
        }
        let mut rest = code;
        while let Some(start) = rest.find("crate::") {
            let whole = !rest[..start].ends_with(is_word);
            rest = &rest[start + "crate::".len()..];
            if !whole {
                continue;
            }
            if rest.starts_with('{') && !code.contains(';') {
                group = Some(rest.to_string());
            } else if rest.starts_with('{') {
                found.extend(group_names(rest).into_iter().map(|name| (number + 1, name)));
            } else {
                found.push((number + 1, first_word(rest)));
            }
        }
        found.extend(
            by_supers(code, depth + inline.len())
                .into_iter()
                .map(|name| (number + 1, name)),
        );
    }
    found
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn first_word(text: &str) -> String {
    text.chars().take_while(|c| is_word(*c)).collect()
}

/// The first names of the entries of `{a, b::{c, d}}`.
fn group_names(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut depth = 0;
    let mut start = true;
    for (i, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => start = true,
            c if depth == 1 && start && is_word(c) => {
                names.push(first_word(&text[i..]));
                start = false;
            }
            _ => {}
        }
    }
    names
}

/// What paths of as many `super::` as lead up to the crate go on with.
fn by_supers(code: &str, depth: usize) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = code;
    while let Some(start) = rest.find("super::") {
        rest = &rest[start..];
        let mut supers = 0;
        while let Some(next) = rest.strip_prefix("super::") {
            supers += 1;
            rest = next;
        }
        if supers == depth {
            names.push(first_word(rest));
        }
    }
    names
}

#[test]
fn modules_import_only_from_those_before_them() {
    let source = root().join("src");
    let order = modules(&std::fs::read_to_string(source.join("lib.rs")).unwrap());
    assert!(order.len() > 10, "src/lib.rs names {order:?}");
    let rank = |name: &str| order.iter().position(|module| module == name);
    let mut wrong = Vec::new();
    let mut checked = 0;
    for path in sources(&source) {
        let inside = path.strip_prefix(&source).unwrap();
        if inside == Path::new("lib.rs") {
            continue;
        }
        let parts: Vec<_> = inside.iter().map(|part| part.to_str().unwrap()).collect();
        let module = parts[0].trim_end_matches(".rs");
        let own = rank(module).unwrap_or_else(|| panic!("src/lib.rs does not name {module}"));
        let depth = parts.len() - usize::from(parts.len() > 1 && parts.ends_with(&["mod.rs"]));
        let text = std::fs::read_to_string(&path).unwrap();
        for (line, name) in references(&text, depth) {
            checked += 1;
            match rank(&name) {
                Some(other) if other <= own => {}
                Some(_) => wrong.push(format!("{}:{line} uses {name}", inside.display())),
                None => wrong.push(format!("{}:{line}: no module {name}", inside.display())),
            }
        }
    }
    assert!(checked > 100, "only {checked} references were found");
    assert!(
        wrong.is_empty(),
        "against the order of src/lib.rs:\n{}",
        wrong.join("\n")
    );
}

/// The reader of source texts sees every form of reference.
#[test]
fn references_are_found_in_all_their_forms() {
    let text = "\
use crate::error::{Error, Result};
use crate::{pose::Vec3, body};
use crate::{
    pair,
    query::{answer, other},
};
use super::helper;
fn f() -> crate::space::Space { my_crate::x() } // crate::not
mod tests {
    use super::super::robot::Robot;
    use super::local;
}
use super::convex;
";
    let names: Vec<String> = references(text, 1)
        .into_iter()
        .map(|(_, name)| name)
        .collect();
    let want = [
        "error", "pose", "body", "pair", "query", "helper", "space", "robot", "convex",
    ];
    assert_eq!(names, want);
}

/// The files beside a source text of a folder that it refers to, as `super::name::` or by the folder's path.
fn siblings(text: &str, folder: &str) -> Vec<String> {
    let outside_tests = text.split("#[cfg(test)]").next().unwrap_or_default();
    let path = format!("crate::{}::", folder.replace('/', "::"));
    let mut names = Vec::new();
    for line in outside_tests.lines() {
        let code = line.split("//").next().unwrap_or_default();
        names.extend(by_supers(code, 1));
        names.extend(code.split(&path).skip(1).map(first_word));
    }
    names
}

/// Inside these folders files import one way too: no file needs one that needs it. Of the other folders with several files only
/// `cobject` (a set holds a combination, which holds sets) and `capi` (where types stand beside the calls of their section of the
/// header) have circles.
#[test]
fn files_of_a_folder_import_one_way() {
    let folders = [
        "gjk",
        "primitive",
        "convex",
        "boxes",
        "hierarchy",
        "hierarchy/grouping",
        "body",
        "pair",
        "robot",
        "urdf",
        "space",
        "environment",
        "environment/box_tree",
        "query",
        "motion",
        "certificate",
        "batch",
        "map",
    ];
    for folder in folders {
        let inside = root().join("src").join(folder);
        let name_of = |path: &Path| path.file_stem().unwrap().to_str().unwrap().to_string();
        let mut files: Vec<(String, Vec<String>)> = sources(&inside)
            .iter()
            .filter(|path| path.parent() == Some(&inside))
            .map(|path| {
                let text = std::fs::read_to_string(path).unwrap();
                (name_of(path), siblings(&text, folder))
            })
            .filter(|(name, _)| name != "mod")
            .collect();
        assert!(files.len() > 2, "src/{folder} has {} files", files.len());
        // Files that import none of those left are taken away, until none is left.
        while !files.is_empty() {
            let left: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
            files.retain(|(_, used)| used.iter().any(|name| left.contains(name)));
            assert!(
                files.len() < left.len(),
                "in src/{folder} these import each other in a circle, or need those that do: {left:?}"
            );
        }
    }
}

/// docs/architecture.md and src/lib.rs say the same of each module, in the same order.
#[test]
fn the_map_of_modules_is_current() {
    let lib = std::fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let map = std::fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let mut told = Vec::new();
    let mut comment = String::new();
    for line in lib.lines() {
        if let Some(text) = line.strip_prefix("// ") {
            comment = text.trim_end_matches('.').to_string();
        }
        if let [name] = &modules(line)[..] {
            told.push((name.clone(), std::mem::take(&mut comment).to_lowercase()));
        }
    }
    let rows = map.lines().filter_map(|line| {
        let (name, text) = line.strip_prefix("| `")?.split_once("` | ")?;
        Some((name.to_string(), text.strip_suffix(" |")?.to_lowercase()))
    });
    assert_eq!(told, rows.collect::<Vec<_>>());
}
