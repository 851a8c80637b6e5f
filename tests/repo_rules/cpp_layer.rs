//! The C++ layer, include/cstk.hpp and the headers in include/cstk: they include one way, and every C function is called there.

use std::path::PathBuf;

use super::exports_guarded::exports;
use super::{root, sources};

/// Exported functions that a program calls as they are.
const WITHOUT_METHOD: [&str; 1] = ["cstk_version"];

/// The headers of include/cstk that a text includes, in order.
fn included(text: &str) -> Vec<&str> {
    text.lines()
        .filter_map(|line| line.strip_prefix("#include <cstk/")?.strip_suffix(".hpp>"))
        .collect()
}

/// The headers of the layer with their names. FCL's calls (include/cstk/fcl.hpp) and Eigen's poses (include/cstk/eigen.hpp) stand above
/// it.
fn headers() -> Vec<(String, PathBuf)> {
    let files = std::fs::read_dir(root().join("include/cstk")).unwrap();
    files
        .map(|file| file.unwrap().path())
        .filter(|path| path.is_file())
        .map(|path| {
            (
                path.file_stem().unwrap().to_str().unwrap().to_string(),
                path,
            )
        })
        .filter(|(name, _)| !["fcl", "eigen"].contains(&&name[..]))
        .collect()
}

/// A text without its comments, of lines and in between.
fn without_comments(text: &str) -> String {
    let blocks = text.split("/*").enumerate().map(|(i, part)| match i {
        0 => part,
        _ => part.split_once("*/").map_or("", |(_, rest)| rest),
    });
    let lines = blocks.collect::<String>();
    let code = lines
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    code.collect::<Vec<_>>().join("\n")
}

#[test]
fn headers_include_only_those_above_them() {
    let whole = std::fs::read_to_string(root().join("include/cstk.hpp")).unwrap();
    let order = included(&whole);
    let rank = |name: &str| order.iter().position(|header| *header == name);
    let headers = headers();
    assert_eq!(
        order.len(),
        headers.len(),
        "include/cstk.hpp names {order:?}"
    );
    for (name, path) in headers {
        let own =
            rank(&name).unwrap_or_else(|| panic!("include/cstk.hpp does not include {name}.hpp"));
        for other in included(&std::fs::read_to_string(path).unwrap()) {
            assert!(
                rank(other).is_some_and(|other| other < own),
                "{name}.hpp includes {other}.hpp, which does not stand before it in include/cstk.hpp"
            );
        }
    }
}

#[test]
fn every_export_is_called_in_the_layer() {
    let text: String = headers()
        .iter()
        .map(|(_, path)| without_comments(&std::fs::read_to_string(path).unwrap()))
        .collect();
    // What is called, or handed on to be called.
    let words: std::collections::HashSet<&str> = text
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .collect();
    let missing: Vec<String> = sources(&root().join("src/capi"))
        .iter()
        .flat_map(|path| exports(&std::fs::read_to_string(path).unwrap()))
        .map(|export| export.name)
        .filter(|name| !words.contains(&name[..]))
        .collect();
    assert_eq!(
        missing, WITHOUT_METHOD,
        "exports that no header of include/cstk calls (left) and those allowed (right)"
    );
}
