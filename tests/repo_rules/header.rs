//! include/cstk.h is what the sources say today, and its examples compile. `scripts/header.sh` rewrites it.

use std::io::Write;
use std::process::{Command, Stdio};

use super::header_sections::{Section, header};
use super::root;

#[test]
fn the_header_is_current() {
    let generated = header();
    let path = root().join("include/cstk.h");
    if std::env::var_os("CSTK_UPDATE_HEADER").is_some() {
        std::fs::write(&path, &generated).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    let lines = committed.lines().zip(generated.lines()).enumerate();
    if let Some((line, (old, new))) = lines.into_iter().find(|(_, (old, new))| old != new) {
        panic!(
            "include/cstk.h:{} is\n  {old}\nbut should be\n  {new}\nrun scripts/header.sh",
            line + 1
        );
    }
    assert!(committed == generated, "run scripts/header.sh");
}

/// What the examples take for granted: one object of each kind, a configuration, a step, two poses.
const GIVEN: &str = "\
#include <cstk.h>
#include <math.h>
#include <stdio.h>
void check(cstk_status status);
void example(cstk_body_builder *body_builder, cstk_body *body, cstk_robot_builder *robot_builder,
             cstk_robot *robot, cstk_space *space, cstk_environment *environment,
             cstk_cobject *cobject, cstk_query *query, double *q, const double *q0,
             const double *q1, size_t nq, const double *step,
             size_t nv, const double pose_a[12], const double pose_b[12]);
";

#[test]
fn the_examples_of_the_header_compile() {
    for section in Section::all() {
        let declaration = GIVEN.split("void example").nth(1).unwrap();
        let parameters = declaration.trim_end().trim_end_matches(';');
        let program = format!(
            "{GIVEN}void example{parameters} {{\n{}\n}}\n",
            section.example
        );
        let mut compiler = Command::new("cc")
            .args([
                "-std=c99",
                "-fsyntax-only",
                "-Wall",
                "-Werror",
                "-x",
                "c",
                "-",
            ])
            .arg("-I")
            .arg(root().join("include"))
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("cc, which Rust links with");
        let mut input = compiler.stdin.take().unwrap();
        input.write_all(program.as_bytes()).unwrap();
        drop(input);
        let done = compiler.wait_with_output().unwrap();
        let errors = String::from_utf8_lossy(&done.stderr);
        let title = &section.title;
        assert!(
            done.status.success(),
            "the example of \"{title}\":\n{errors}"
        );
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    use cstk::capi::status::version::*;
    let parts = format!("{CSTK_VERSION_MAJOR}.{CSTK_VERSION_MINOR}.{CSTK_VERSION_PATCH}");
    assert_eq!(parts, env!("CARGO_PKG_VERSION"));
}
