//! Meshes of URDF links as surfaces, solids and convex hulls.

use cstk::body::{Body, BodyBuilder, MeshForm};
use cstk::error::ErrorKind;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::RobotBuilder;
use cstk::urdf::{LinkForms, UrdfOptions, UrdfReport, add_urdf_text};

/// An L of unit thickness and depth: 3 long, 3 high; an open one lacks a face. Its notch is around (2, 2).
fn ell(is_open: bool) -> String {
    let corners = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]];
    let mut text = String::new();
    for z in 0..2 {
        for [x, y] in corners {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text += "v 9 9 9\n";
    // The caps of two convex parts each; sides follow the outline.
    text += "f 4 3 2 1\nf 1 6 5 4\nf 7 8 9 10\nf 10 11 12 7\n";
    for i in 1..=if is_open { 5 } else { 6 } {
        let next = i % 6 + 1;
        text += &format!("f {i} {next} {} {}\n", next + 6, i + 6);
    }
    text
}

fn loaded(
    forms: LinkForms,
    cache: Option<std::path::PathBuf>,
) -> (UrdfReport, Vec<std::sync::Arc<Body>>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("closed.obj"), ell(false)).unwrap();
    std::fs::write(folder.path().join("open.obj"), ell(true)).unwrap();
    let mesh = |link: &str, file: &str| {
        format!(
            "<link name='{link}'><collision><geometry><mesh filename='{file}.obj'/></geometry></collision></link>"
        )
    };
    let text = format!(
        "<robot>{}{}<link name='ball'><collision><geometry><sphere radius='1'/></geometry></collision></link>\
         <joint name='a' type='fixed'><parent link='closed'/><child link='open'/></joint>\
         <joint name='b' type='fixed'><parent link='closed'/><child link='ball'/></joint></robot>",
        mesh("closed", "closed"),
        mesh("open", "open")
    );
    let mut builder = RobotBuilder::new(3).unwrap();
    let options = UrdfOptions {
        forms,
        cache_folder: cache,
        ..Default::default()
    };
    let report = add_urdf_text(
        &mut builder,
        &text,
        Some(folder.path()),
        &options,
        &mut |_| Ok(()),
    )
    .unwrap();
    let bodies = builder
        .links()
        .iter()
        .map(|link| link.body.clone().unwrap());
    (report, bodies.collect())
}

/// The distance of a point.
fn distance(body: &Body, at: [f64; 3]) -> f64 {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&[Vec3::zeros()], 0).unwrap();
    let point = helpers::models::built(&builder, &Default::default());
    let (here, there) = (Pose::identity(), Pose::from_translation(Vec3::from(at)));
    let found = QueryContext::new().pair_distance((body, &here), (&point, &there), f64::INFINITY);
    found.unwrap().distance
}

#[test]
fn meshes_are_surfaces_solids_or_hulls() {
    let all = |form| LinkForms {
        others: form,
        ..Default::default()
    };
    let inside = [0.5, 0.25, 0.5];
    let notch = [2.0, 2.0, 0.5];
    let beyond_hull = [2.5, 2.5, 0.5];
    // From the notch the L is 1 away, its hull ends at x + y = 4.
    let off_hull = (2.5f64 + 2.5 - 4.0) / 2f64.sqrt();
    for (form, solids, closed, open) in [
        (MeshForm::Surface, 0, [0.25, 1.0, 1.5], [0.25, 1.0, 1.5]),
        (MeshForm::Solid, 1, [0.0, 1.0, 1.5], [0.25, 1.0, 1.5]),
        (
            MeshForm::Hull,
            0,
            [0.0, 0.0, off_hull],
            [0.0, 0.0, off_hull],
        ),
    ] {
        let (report, bodies) = loaded(all(form), None);
        assert_eq!(report.solid_bodies, solids, "{form:?}");
        for (body, expected) in bodies.iter().zip([closed, open]) {
            for (at, expected) in [inside, notch, beyond_hull].into_iter().zip(expected) {
                let found = distance(body, at);
                assert!(
                    (found - expected).abs() < 1e-12,
                    "{form:?} {at:?}: {found}, not {expected}"
                );
            }
        }
        // The link without a mesh stays what it is.
        assert!(!bodies[2].statistics().is_solid);
    }
}

#[test]
fn links_have_forms_of_their_own_and_caches_keep_them_apart() {
    let cache = tempfile::tempdir().unwrap();
    let folder = || Some(cache.path().to_path_buf());
    let forms = LinkForms {
        others: MeshForm::Solid,
        named: [("open".to_string(), MeshForm::Hull)].into(),
    };
    for cached in [0, 3] {
        let (report, bodies) = loaded(forms.clone(), folder());
        assert_eq!((report.bodies_from_cache, report.solid_bodies), (cached, 1));
        assert_eq!(
            bodies
                .iter()
                .map(|b| b.statistics().primitives)
                .collect::<Vec<_>>(),
            [10, 1, 1]
        );
    }
    // Surfaces are other bodies; the ball is the same.
    let (report, _) = loaded(LinkForms::default(), folder());
    assert_eq!(report.bodies_from_cache, 1);
    let unknown = LinkForms {
        named: [("no".to_string(), MeshForm::Hull)].into(),
        ..Default::default()
    };
    let options = UrdfOptions {
        forms: unknown,
        ..Default::default()
    };
    let mut builder = RobotBuilder::new(3).unwrap();
    let error = add_urdf_text(
        &mut builder,
        "<robot><link name='a'/></robot>",
        None,
        &options,
        &mut |_| Ok(()),
    );
    let error = error.unwrap_err();
    assert!(
        error.kind == ErrorKind::NotFound && error.message.contains("\"no\""),
        "{error}"
    );
}
