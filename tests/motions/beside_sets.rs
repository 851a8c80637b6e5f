//! Motions along the faces of pure sets, and beside what is known of them only in part.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, Predicate, PureShape};
use cstk::error::{ErrorKind, Result};
use cstk::motion::{MotionOptions, MotionOutcome, RegionOptions, RegionOutcome, Spline};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::pure::{class, pure};
use helpers::robots::{link, robot, space};
use helpers::shapes::cuboid;

use super::random_scenes::built;

fn sliders(count: usize) -> Arc<Space> {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let links = (0..count).map(|i| link(i.checked_sub(1), JointKind::Prismatic, axes[i]));
    space(vec![robot(3, links.collect())])
}

/// The most looks that a proof beside a set may take here; bisection of 1e-6 would take a million.
const FEW: u64 = 100;

fn proved(set: &CObject, points: &[f64]) -> MotionOutcome {
    let context = &mut QueryContext::new();
    context.set_limit(Some(FEW));
    let options = &MotionOptions::default();
    let nq = set.space().nq();
    let found = match points.len() == 2 * nq {
        true => context.motion(set, &points[..nq], &points[nq..], options),
        false => context.motion_on_curve(set, points, options),
    };
    found.unwrap().outcome
}

#[test]
fn the_gap_along_a_face_is_not_lost() {
    for gap in [1e-3, 1e-6, 1e-9] {
        let space = sliders(2);
        let around = PureShape::Box {
            low: vec![0.0; 2],
            high: vec![1.0; 2],
        };
        let half = PureShape::HalfSpace {
            normal: vec![0.0, 1.0],
            offset: 1.0,
            is_open: false,
        };
        for shape in [around, half] {
            let set = &pure(&space, shape, None);
            let y = 1.0 + gap;
            assert_eq!(
                proved(set, &[-1.0, y, 2.0, y]),
                MotionOutcome::Free,
                "{gap}"
            );
            let curve = [-1.0, y, 3.0, y, 2.0, y];
            assert_eq!(proved(set, &curve), MotionOutcome::Free, "{gap}");
            // Down to the face between the ends.
            let dips = [-1.0, y, 0.5, 1.0 - 9.0 * gap, 2.0, y];
            assert_ne!(proved(set, &dips), MotionOutcome::Free, "{gap}");
        }
        let base = LinkDefinition {
            body: Some(cuboid([1.0; 3]).body),
            ..link(None, JointKind::Planar, Vec3::z())
        };
        let base = space_of(base);
        let floor = PureShape::Floor {
            links: vec![0],
            normal: Vec3::z(),
            offset: -0.5 - gap,
        };
        let floor = &pure(&base, floor, None);
        let bend = [0.0, 0.0, 0.0, 30.0, 5.0, 1.0, -20.0, 40.0, 2.0];
        assert_eq!(proved(floor, &bend), MotionOutcome::Free, "{gap}");
    }
}

fn space_of(link: LinkDefinition) -> Arc<Space> {
    space(vec![robot(3, vec![link])])
}

#[test]
fn a_limit_ends_proofs_beside_sets() {
    // A ball has no faces.
    let ball = PureShape::Ball {
        center: vec![0.0; 2],
        radius: 1.0,
    };
    let set = &pure(&sliders(2), ball, None);
    let gap = 1.0 + 1e-7;
    assert_eq!(
        proved(set, &[-1.0, gap, 1.0, gap]),
        MotionOutcome::Undecided
    );
}

/// Bodies that state a deviation are in a floor only where all that they may stand for is, whatever its contact epsilon.
#[test]
fn deviating_bodies_leave_the_complement_of_a_floor_where_classes_say_so() {
    let ball = built(|b| {
        b.add_sphere(&Vec3::zeros(), 1.0, 0).unwrap();
        b.set_deviation(1e-3).unwrap();
    });
    let space = space_of(LinkDefinition {
        body: Some(ball),
        ..link(None, JointKind::Prismatic, Vec3::z())
    });
    let floor = PureShape::Floor {
        links: vec![0],
        normal: Vec3::z(),
        offset: 0.0,
    };
    let outside = &CObject::complement(&pure(&space, floor, None)).unwrap();
    assert_eq!(class(outside, &[1.02]), Class::Inside);
    let options = &MotionOptions::default();
    let context = &mut QueryContext::new();
    let answer = context.motion(outside, &[0.95], &[1.03], options).unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Hit);
    let region = context.classify_region(outside, &[0.95], &[1.03], &RegionOptions::default());
    assert_eq!(region.unwrap().outcome, RegionOutcome::Mixed);
    let answer = context.motion(outside, &[0.5], &[0.95], options).unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Free);
}

/// Where |q| is at most 1, with a distance that says something below 0 there, though it does not know how deep.
struct Shallow;

impl Predicate for Shallow {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        Ok(match q[0].abs() <= 1.0 {
            true => Class::Inside,
            false => Class::Outside,
        })
    }

    fn distance(&self, q: &[f64]) -> Result<Option<f64>> {
        let outside = q[0].abs() - 1.0;
        Ok(Some(if outside <= 0.0 { -10.0 } else { outside }))
    }

    fn measures(&self) -> bool {
        true
    }

    fn is_exact(&self) -> bool {
        true
    }
}

#[test]
fn what_a_predicate_does_not_know_proves_nothing() {
    let set = pure(&sliders(1), PureShape::Predicate(Arc::new(Shallow)), None);
    let context = &mut QueryContext::new();
    let found = context.classify_region(&set, &[-2.0], &[2.0], &RegionOptions::default());
    assert_eq!(found.unwrap().outcome, RegionOutcome::Mixed);
    let outside = CObject::complement(&set).unwrap();
    let options = &MotionOptions::default();
    let answer = context.motion(&outside, &[0.0], &[1.5], options).unwrap();
    assert_ne!(answer.outcome, MotionOutcome::Free);
}

/// A ball that a spline of degree 1 would take past another by a jump.
#[test]
fn splines_that_jump_are_refused() {
    let ball = PureShape::Ball {
        center: vec![0.0],
        radius: 0.5,
    };
    let set = &pure(&sliders(1), ball, None);
    let ask = |degree: usize, knots: &[f64], points: &[f64]| {
        let spline = Spline {
            degree,
            knots,
            points,
        };
        QueryContext::new().motion_on_spline(set, &spline, &MotionOptions::default())
    };
    let jump = ask(1, &[0.0, 0.0, 1.0, 1.0, 2.0, 2.0], &[-2.0, -1.0, 1.0, 2.0]);
    let error = jump.unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument);
    assert!(error.message.contains("knots 2 to 3"), "{}", error.message);
    // As often as the degree it bends there, and more often at the ends it only waits.
    let bend = ask(1, &[0.0, 0.0, 1.0, 2.0, 2.0], &[-2.0, -1.0, 2.0]);
    assert_eq!(bend.unwrap().outcome, MotionOutcome::Hit);
    let ends = ask(1, &[0.0, 0.0, 0.0, 1.0, 1.0], &[-2.0, -1.0, -0.75]);
    assert_eq!(ends.unwrap().outcome, MotionOutcome::Free);
}

#[test]
fn turns_about_an_axis_keep_it() {
    for i in 0..1000 {
        let (sin, cos) = (f64::from(i) * 0.01).sin_cos();
        for k in 0..3 {
            let mut xyzw = [0.0, 0.0, 0.0, cos];
            xyzw[k] = sin;
            let pose = Pose::from_quaternion(Vec3::zeros(), xyzw).unwrap();
            assert_eq!(pose.rotation[(k, k)], 1.0, "{xyzw:?}");
            assert_eq!(pose.is_planar(), k == 2 || sin == 0.0, "{xyzw:?}");
        }
    }
}
