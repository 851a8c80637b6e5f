//! The sections of include/cstk.h: the public modules of src/capi, in their order. The docs of a module open its section: a
//! title, an introduction, an example in C. cbindgen writes the declarations of each.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::root;

/// A section of the header.
pub struct Section {
    /// The module's name.
    pub name: String,
    pub title: String,
    introduction: String,
    pub example: String,
    files: Vec<PathBuf>,
}

/// The names of a file's public modules, in order.
fn public_modules(file: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(file).unwrap();
    let names = text
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    names.map(str::to_string).collect()
}

impl Section {
    /// All of them, in the order of the header.
    pub fn all() -> Vec<Self> {
        let capi = root().join("src/capi");
        let names = public_modules(&capi.join("mod.rs"));
        names.iter().map(|name| Self::read(&capi, name)).collect()
    }

    fn read(capi: &Path, name: &str) -> Self {
        let folder = capi.join(name);
        let (first, files) = if folder.is_dir() {
            let first = folder.join("mod.rs");
            let names = public_modules(&first);
            let files = names.iter().map(|part| folder.join(format!("{part}.rs")));
            (first, files.collect())
        } else {
            let file = capi.join(format!("{name}.rs"));
            (file.clone(), vec![file])
        };
        let text = std::fs::read_to_string(&first).unwrap();
        let docs: Vec<&str> = text
            .lines()
            .map_while(|line| line.strip_prefix("//!"))
            .map(|line| line.strip_prefix(' ').unwrap_or(line))
            .collect();
        let docs = docs.join("\n");
        assert!(
            !docs.contains("*/"),
            "{first:?} would end the comment it opens"
        );
        let parts = docs.split_once("\n\n").and_then(|(title, rest)| {
            let (introduction, rest) = rest.split_once("\n\n```c\n")?;
            let example = rest.strip_suffix("\n```")?;
            Some((title.strip_suffix('.')?, introduction, example))
        });
        let (title, introduction, example) = parts.unwrap_or_else(|| {
            panic!("the docs of {first:?} are not a title, an introduction and an example")
        });
        Self {
            name: name.to_string(),
            title: title.to_string(),
            introduction: introduction.to_string(),
            example: example.to_string(),
            files,
        }
    }

    /// What cbindgen declares for the section's functions and types.
    fn declarations(&self) -> String {
        let mut config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
        config.header = None;
        config.include_guard = None;
        config.sys_includes.clear();
        for file in &self.files {
            // All of a section's types, whichever section's functions take them.
            let text = std::fs::read_to_string(file).unwrap();
            for keyword in ["\npub struct ", "\npub enum ", "\npub type "] {
                let names = named_after(&text, keyword);
                let own = names.filter(|name| name.starts_with("cstk_"));
                config.export.include.extend(own.map(str::to_string));
            }
        }
        let mut builder = cbindgen::Builder::new().with_config(config);
        for file in &self.files {
            builder = builder.with_src(file);
        }
        let mut written = Vec::new();
        builder.generate().unwrap().write(&mut written);
        let text = String::from_utf8(written).unwrap();
        // The whole header is wrapped once in extern "C", not each section.
        let is_wrapper =
            |three: &[&str]| three[0] == "#ifdef __cplusplus" && three[1].contains("extern \"C\"");
        let lines: Vec<&str> = text.lines().collect();
        let starts = (0..lines.len().saturating_sub(2)).filter(|&i| is_wrapper(&lines[i..i + 3]));
        let left_out: BTreeSet<usize> = starts.flat_map(|i| i..i + 3).collect();
        let kept = (0..lines.len()).filter(|i| !left_out.contains(i));
        let text = kept.map(|i| lines[i]).collect::<Vec<_>>().join("\n");
        text.trim().to_string()
    }
}

/// The names that follow a text's occurrences of a keyword, as in `struct cstk_body`.
fn named_after<'a>(text: &'a str, keyword: &str) -> impl Iterator<Item = &'a str> {
    let ends = text
        .match_indices(keyword)
        .map(|(at, found)| at + found.len());
    ends.map(|end| {
        let rest = &text[end..];
        let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
        &rest[..length.unwrap_or(rest.len())]
    })
}

/// The whole header.
pub fn header() -> String {
    let sections = Section::all();
    let declared: Vec<String> = sections.iter().map(Section::declarations).collect();
    let mut place_of = BTreeMap::new();
    for (place, text) in declared.iter().enumerate() {
        for name in named_after(text, "typedef struct ") {
            place_of.insert(name.to_string(), place);
        }
    }
    // Opaque types, and structures that a section before their own points to, are announced.
    let mut announced = BTreeSet::new();
    for (place, text) in declared.iter().enumerate() {
        for name in named_after(text, "cstk_").map(|rest| format!("cstk_{rest}")) {
            if place_of.get(&name).is_some_and(|own| *own > place) {
                announced.insert(name);
            }
        }
    }
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    let about = config.header.expect("cbindgen.toml has a header");
    let contents: Vec<String> = sections
        .iter()
        .map(|section| format!(" *   @ref {:<18} {}", section.name, section.title))
        .collect();
    let mut text = about.replace("@CONTENTS@", &contents.join("\n"));
    text.push_str("\n#ifndef CSTK_H\n#define CSTK_H\n\n");
    for include in &config.sys_includes {
        text.push_str(&format!("#include <{include}>\n"));
    }
    text.push_str("\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n/* Used before the sections that describe them. */\n");
    for name in &announced {
        text.push_str(&format!("typedef struct {name} {name};\n"));
    }
    for (section, declarations) in sections.iter().zip(&declared) {
        let Section {
            name,
            title,
            introduction,
            example,
            ..
        } = section;
        let lines = introduction
            .lines()
            .map(|line| format!("{}\n", format!(" * {line}").trim_end()));
        let introduction: String = lines.collect();
        let lines = example.lines().map(|line| format!("     {line}\n"));
        let example: String = lines.collect();
        text.push_str(&format!(
            "\n/**\n * @defgroup {name} {title}\n *\n{introduction} *\n * @code\n{example} * @endcode\n * @{{\n */\n\n"
        ));
        text.push_str(&plain(declarations, &announced));
        text.push_str("\n\n/** @} */\n");
    }
    text.push_str("\n#ifdef __cplusplus\n} /* extern \"C\" */\n#endif\n\n#endif /* CSTK_H */\n");
    text
}

/// Declarations with types by their names alone, and without a second typedef of those that were announced.
fn plain(declarations: &str, announced: &BTreeSet<String>) -> String {
    let mut text = String::new();
    // The announced structure whose fields are being read.
    let mut open: Option<&str> = None;
    for line in declarations.lines() {
        let opened = line.strip_prefix("typedef struct ");
        let opaque = opened.and_then(|rest| rest.strip_suffix(';')?.split(' ').next());
        if opaque.is_some_and(|name| announced.contains(name)) {
            // Its comment stays, for the struct.
            text.push_str(&format!("struct {};\n", opaque.unwrap_or_default()));
            continue;
        }
        let name = opened.and_then(|rest| rest.strip_suffix(" {"));
        if let Some(name) = name.filter(|name| announced.contains(*name)) {
            open = Some(name);
            text.push_str(&format!("struct {name} {{\n"));
            continue;
        }
        if open.is_some_and(|name| line == format!("}} {name};")) {
            open = None;
            text.push_str("};\n");
            continue;
        }
        let line =
            if opened.is_some() || line.starts_with("enum ") || line.contains("typedef enum ") {
                line.to_string()
            } else {
                line.replace("struct cstk_", "cstk_")
                    .replace("enum cstk_", "cstk_")
            };
        text.push_str(&line);
        text.push('\n');
    }
    text.trim_end().to_string()
}
