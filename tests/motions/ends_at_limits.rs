//! Motions that end exactly at a limit of a joint, which is not beyond it: free in all ways of asking.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureShape};
use cstk::motion::{MotionOptions, MotionOutcome, Spline};
use cstk::pose::Vec3;
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::{Space, WorldBox};
use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{link, robot};

/// What is beyond the range of a slider.
fn beyond([lower, upper]: [f64; 2]) -> Arc<CObject> {
    let links = vec![link(None, JointKind::Prismatic, Vec3::x())];
    let ranges = [Some(Coordinate::Interval { lower, upper })];
    let space = Space::new(vec![robot(3, links)], &ranges, WorldBox::unbounded());
    pure(&Arc::new(space.unwrap()), PureShape::BeyondLimits, None)
}

#[test]
fn motions_that_end_at_a_limit_are_free() {
    let mut random = Random::new(811);
    let options = MotionOptions::default();
    for case in 0..3000 {
        let size = [1e-3, 1.0, 1e4][random.below(3)];
        let range = [-random.within(0.0, size), random.within(0.0, size)];
        let limits = &beyond(range);
        let inside = |random: &mut Random| random.within(range[0], range[1]);
        let (start, end) = (inside(&mut random), range[random.below(2)]);
        let context = &mut QueryContext::new();
        let straight = context.motion(limits, &[start], &[end], &options).unwrap();
        let (certified, certificate) = context
            .motion_certificate(limits, &[start], &[end], &options)
            .unwrap();
        assert!(certificate.is_some(), "{case} {start} {end}: {certified:?}");
        // Up to a cubic curve, some of whose other control points are at the limit too.
        let degree = 1 + random.below(3);
        let mut points = vec![start];
        points.extend((1..degree).map(|_| [inside(&mut random), end][random.below(2)]));
        points.push(end);
        let curve = context.motion_on_curve(limits, &points, &options).unwrap();
        let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
        // And once more with an inner knot.
        let inner = degree + 1..degree + 1 + random.below(2);
        let mut more = knots.clone();
        more.splice(
            inner.start..inner.start,
            inner.map(|_| random.within(0.1, 0.9)),
        );
        points.resize(more.len() - degree - 1, end);
        let spline = Spline {
            degree,
            knots: &more,
            points: &points,
        };
        let spline = context.motion_on_spline(limits, &spline, &options).unwrap();
        for (way, answer) in [
            ("straight", &straight),
            ("certified", &certified),
            ("curve", &curve),
            ("spline", &spline),
        ] {
            assert_eq!(
                answer.outcome,
                MotionOutcome::Free,
                "{case} {way} {start} {end}"
            );
            let at = Configuration::Coordinates(&answer.configuration);
            let class = context.classify(limits, at).unwrap();
            assert_ne!(class, Class::Inside, "{case} {way} {start} {end}");
            assert_eq!(answer.configuration, [end], "{case} {way}");
        }
    }
}
