//! NURBS surfaces that are none, or whose tolerance cannot be kept: refused, and nothing is added.

use cstk::body::{BodyBuilder, NurbsSurface};
use cstk::error::ErrorKind;
use cstk::pose::Vec3;

use super::sampled_surfaces::built;

#[test]
fn what_is_no_surface_is_refused_and_adds_nothing() {
    let points: Vec<Vec3> = (0..20)
        .map(|k| Vec3::new(f64::from(k / 5), f64::from(k % 5), f64::from(k)))
        .collect();
    let good = NurbsSurface {
        degrees: [2, 3],
        knots: [
            &[0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0],
            &[0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0],
        ],
        points: &points,
        weights: None,
    };
    let mut builder = BodyBuilder::new(3).unwrap();
    let mut refused = |surface: NurbsSurface, tolerance: f64, kind: ErrorKind, culprit: &str| {
        let error = builder
            .add_nurbs_surface(&surface, tolerance, 0)
            .unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.message.contains(culprit), "{error}");
        assert!(builder.is_empty());
    };
    let (invalid, size, infinite) = (
        ErrorKind::InvalidArgument,
        ErrorKind::WrongSize,
        ErrorKind::NotFinite,
    );
    let u = |knots| NurbsSurface {
        knots: [knots, good.knots[1]],
        ..good
    };
    let v = |knots| NurbsSurface {
        knots: [good.knots[0], knots],
        ..good
    };
    for (degree, culprit) in [(0, "degree_u"), (33, "degree_u"), (usize::MAX, "degree_u")] {
        let degrees = [degree, 3];
        refused(NurbsSurface { degrees, ..good }, 0.1, invalid, culprit);
    }
    let degrees = [2, 0];
    refused(NurbsSurface { degrees, ..good }, 0.1, invalid, "degree_v");
    refused(
        u(&[0.0; 5]),
        0.1,
        size,
        "knots_u: degree 2 needs at least 6 knots",
    );
    refused(
        v(&[]),
        0.1,
        size,
        "knots_v: degree 3 needs at least 8 knots",
    );
    refused(
        u(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
        0.1,
        size,
        "3 x 5 control points, not 20",
    );
    let spoilt = [f64::NAN, f64::INFINITY, -f64::INFINITY];
    let spoilt = spoilt.map(|knot| [0.0, 0.0, 0.0, knot, 2.0, 2.0, 2.0]);
    for knots in &spoilt {
        refused(u(knots), 0.1, infinite, "knots_u: knot 3");
    }
    refused(
        u(&[0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 1e51]),
        0.1,
        invalid,
        "knots_u: knot 6",
    );
    refused(
        u(&[0.0, 0.0, 0.0, 2.0, 1.0, 2.0, 2.0]),
        0.1,
        invalid,
        "knots_u: knot 4 is less",
    );
    refused(
        u(&[0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0]),
        0.1,
        invalid,
        "knots_u: knots 2 and 4",
    );
    refused(u(&[1.0; 7]), 0.1, invalid, "knots_u: knots 2 and 4");
    // A denormal difference, whose quotients have few digits on processors that take it for 0.
    refused(
        u(&[0.0, 0.0, 0.0, 5e-324, 2.0, 2.0, 2.0]),
        0.1,
        invalid,
        "knots_u: knots 2 and 3",
    );
    let torn = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
    let long: Vec<Vec3> = (0..30).map(|k| points[k % 20]).collect();
    let surface = NurbsSurface {
        points: &long,
        ..u(&torn)
    };
    refused(surface, 0.1, invalid, "knots_u: knots 3 to 5 are equal");
    refused(surface, 0.1, invalid, "torn");
    refused(
        u(&[0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 2.0]),
        0.1,
        invalid,
        "knots_u: knots 0 to 3",
    );
    refused(
        u(&[0.0, 0.0, 0.0, 2.0, 2.0, 2.0, 2.0]),
        0.1,
        invalid,
        "knots_u: knots 3 to 6",
    );
    let few = &points[..19];
    refused(
        NurbsSurface {
            points: few,
            ..good
        },
        0.1,
        size,
        "not 19",
    );
    let weights = Some(&[1.0; 19][..]);
    refused(NurbsSurface { weights, ..good }, 0.1, size, "weights");
    for (weight, kind) in [
        (0.0, invalid),
        (-1.0, invalid),
        (1e-7, invalid),
        (f64::NAN, infinite),
    ] {
        let mut weights = [1.0; 20];
        weights[12] = weight;
        let weights = Some(&weights[..]);
        refused(NurbsSurface { weights, ..good }, 0.1, kind, "weight 12");
    }
    let mut far = points.clone();
    far[7].y = f64::NAN;
    let surface = NurbsSurface {
        points: &far,
        ..good
    };
    refused(surface, 0.1, infinite, "control point 7");
    for tolerance in [0.0, -1.0] {
        refused(good, tolerance, invalid, "tolerance");
    }
    refused(good, f64::NAN, infinite, "tolerance");
    for tolerance in [1e-12, 1e-300] {
        refused(good, tolerance, ErrorKind::Limit, "tolerance");
    }
    // More patches than cells: nothing is done with the control points, which are not even finite.
    let knots: Vec<f64> = (0..602).map(f64::from).collect();
    let many = vec![Vec3::repeat(f64::NAN); 600 * 600];
    let surface = NurbsSurface {
        degrees: [1, 1],
        knots: [&knots, &knots],
        points: &many,
        weights: None,
    };
    refused(surface, 0.1, ErrorKind::Limit, "599 x 599");
    // Coordinates and knots may be as large as any.
    let huge: Vec<Vec3> = points.iter().map(|p| p * 3e48).collect();
    let surface = NurbsSurface {
        points: &huge,
        ..u(&[-1e50, -1e50, -1e50, 0.0, 1e50, 1e50, 1e50])
    };
    builder.add_nurbs_surface(&surface, 1e48, 0).unwrap();
    // All of it may be one point.
    let surface = NurbsSurface {
        points: &[Vec3::x(); 20],
        ..good
    };
    builder.add_nurbs_surface(&surface, 1e-3, 0).unwrap();
    built(&builder);
    let mut plane = BodyBuilder::new(2).unwrap();
    let error = plane.add_nurbs_surface(&good, 0.1, 0).unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotPlanar);
    assert!(error.message.contains("vertex 1 ") && plane.is_empty());
}

/// A control point far away, of which the surface has 3e-10: 1 less a share that is nearly 1 has lost the digits of its distance.
#[test]
fn tolerances_below_the_rounding_of_far_control_points_are_refused() {
    let points: Vec<Vec3> = (0..6)
        .map(|k| Vec3::new(if k < 2 { 1e9 } else { 0.0 }, 1e-3 * f64::from(k % 2), 0.0))
        .collect();
    let surface = NurbsSurface {
        degrees: [2, 1],
        knots: [&[-3e9, -3e9, 0.0, 1.0, 1.0, 1.0], &[0.0, 0.0, 1.0, 1.0]],
        points: &points,
        weights: None,
    };
    let mut builder = BodyBuilder::new(3).unwrap();
    let error = builder.add_nurbs_surface(&surface, 1e-9, 0).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Limit);
    builder.add_nurbs_surface(&surface, 1e-3, 0).unwrap();
    let body = built(&builder);
    let end = body.vertices().map(|vertex| vertex.x).fold(0.0, f64::max);
    let error = (end - 1e9 / (1.0 + 3e9)).abs();
    assert!(1e-9 < error && error < body.stated_deviation(), "{error}");
}
