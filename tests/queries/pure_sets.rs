//! Sets given by coordinates: closed forms on lines, circles and rotations, gradients against central differences, and what
//! is refused.

use std::f64::consts::TAU;
use std::sync::Arc;

use cstk::cobject::{CObject, Class, Predicate, PureOptions, PureShape};
use cstk::error::{ErrorKind, Result};
use cstk::pose::Vec3;
use cstk::query::{Configuration, DistanceKind, QueryContext, SSide};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::{Sampler, Space, WorldBox};

use helpers::pure::{class, distance, pure};
use helpers::random::Random;
use helpers::robots::{link, robot};

/// x along a line with limits, an angle round a circle, a hinge with limits, and a free body.
fn mixed() -> Arc<Space> {
    let links = vec![
        link(None, JointKind::Prismatic, Vec3::x()),
        link(Some(0), JointKind::Revolute, Vec3::y()),
        link(Some(1), JointKind::Revolute, Vec3::z()),
        link(None, JointKind::Spherical, Vec3::z()),
        link(None, JointKind::Free, Vec3::z()),
    ];
    let mut ranges = vec![None; 3 + 4 + 7];
    let interval = |lower, upper| Some(Coordinate::Interval { lower, upper });
    ranges[0] = interval(-1.0, 2.0);
    ranges[2] = interval(-0.5, 0.25);
    let world = WorldBox {
        low: [-10.0, -5.0, f64::NEG_INFINITY],
        high: [10.0, 5.0, 8.0],
    };
    Arc::new(Space::new(vec![robot(3, links)], &ranges, world).unwrap())
}

fn rest() -> Vec<f64> {
    let mut q = vec![0.0; 14];
    q[6] = 1.0;
    q[13] = 1.0;
    q
}

fn with(changes: &[(usize, f64)]) -> Vec<f64> {
    let mut q = rest();
    for &(i, x) in changes {
        q[i] = x;
    }
    q
}

#[test]
fn limits_are_obstacles_that_do_not_hold_the_limit_itself() {
    let space = mixed();
    let limits = pure(&space, PureShape::BeyondLimits, None);
    for (q, expected, far) in [
        (rest(), Class::Outside, 0.25),
        (with(&[(2, 0.2)]), Class::Contact, 0.05),
        (with(&[(2, 0.25)]), Class::Contact, 0.0),
        (with(&[(2, 0.25000001)]), Class::Inside, 0.0),
        (with(&[(0, -1.5), (2, 0.5)]), Class::Inside, 0.0),
    ] {
        assert_eq!(class(&limits, &q), expected, "{q:?}");
        assert!((distance(&limits, &q) - far).abs() < 1e-15);
    }
    // The allowed configurations: how far back, from beyond two limits.
    let allowed = CObject::complement(&limits).unwrap();
    let back = distance(&allowed, &with(&[(0, -1.3), (2, 0.65)]));
    assert!((back - 0.5).abs() < 1e-15);
    assert_eq!(class(&allowed, &with(&[(2, 0.25)])), Class::Contact);
    assert_eq!(class(&allowed, &rest()), Class::Inside);
}

#[test]
fn intervals_go_round_circles() {
    let space = mixed();
    let mut low = vec![f64::NEG_INFINITY; 14];
    let mut high = vec![f64::INFINITY; 14];
    (low[1], high[1]) = (3.0, 3.0 + 1.0);
    let arc = pure(&space, PureShape::Box { low, high }, None);
    // From 3 to 4 past pi, whatever the turns counted.
    for turns in [-3.0, 0.0, 2.0] {
        for (angle, expected) in [(3.5, 0.0), (2.8, 0.2), (4.5, 0.5), (0.5, TAU - 3.5)] {
            let expected = if angle == 0.5 {
                f64::min(2.5, expected)
            } else {
                expected
            };
            let found = distance(&arc, &with(&[(1, angle + turns * TAU)]));
            assert!((found - expected).abs() < 1e-14, "{angle}: {found}");
        }
    }
    let inside = CObject::complement(&arc).unwrap();
    assert!((distance(&inside, &with(&[(1, 3.2)])) - 0.2).abs() < 1e-14);
    // A whole turn is no bound at all: the complement is empty.
    let mut low = vec![f64::NEG_INFINITY; 14];
    let mut high = vec![f64::INFINITY; 14];
    (low[1], high[1]) = (0.0, TAU);
    let all = pure(&space, PureShape::Box { low, high }, None);
    assert_eq!(class(&all, &rest()), Class::Inside);
    let nothing = CObject::complement(&all).unwrap();
    let mut query = QueryContext::new();
    let q = rest();
    let found = query.distance(&nothing, Configuration::Coordinates(&q), 1.0);
    assert_eq!(found.unwrap().kind, DistanceKind::Empty);
}

#[test]
fn balls_measure_turns_by_their_angle() {
    let space = mixed();
    let ball = |radius| PureShape::Ball {
        center: rest(),
        radius,
    };
    let half: f64 = 0.4;
    // A turn by 0.8 about a skew axis, and the same quaternion with the other sign.
    let axis = Vec3::new(1.0, 2.0, 2.0) / 3.0;
    for sign in [1.0, -1.0] {
        let mut q = rest();
        for i in 0..3 {
            q[3 + i] = sign * half.sin() * axis[i];
        }
        q[6] = sign * half.cos();
        let found = distance(&pure(&space, ball(0.3), None), &q);
        assert!((found - 0.5).abs() < 1e-14);
        // A shift of the free body by 3, 4, 12 and a turn, of a full turn the rest.
        (q[7], q[8], q[9]) = (3.0, 4.0, 12.0);
        q[1] = TAU - 0.6;
        let expected = (0.8f64.powi(2) + 169.0 + 0.36).sqrt() - 0.3;
        let found = distance(&pure(&space, ball(0.3), Some(2.0)), &q);
        assert!((found - 2.0 * expected).abs() < 1e-12);
    }
}

#[test]
fn the_world_box_holds_the_links_origins() {
    let space = mixed();
    let world = pure(&space, PureShape::beyond_world(&space), None);
    let q = with(&[(0, 2.0), (7, 1.0), (8, 4.5), (9, 1.0)]);
    assert!((distance(&world, &q) - 0.5).abs() < 1e-14);
    let out = with(&[(8, 9.0), (9, 11.0)]);
    assert_eq!(class(&world, &out), Class::Inside);
    // It needs no coordinates.
    let poses = space.link_poses(&q).unwrap();
    let mut query = QueryContext::new();
    let found = query.distance(&world, Configuration::LinkPoses(&poses), f64::INFINITY);
    assert!((found.unwrap().distance - 0.5).abs() < 1e-14);
    let limits = pure(&space, PureShape::BeyondLimits, None);
    let refused = query.classify(&limits, Configuration::LinkPoses(&poses));
    assert_eq!(refused.unwrap_err().kind, ErrorKind::Unsupported);
    // From beyond it the way back is not known in C-space: a bound says so.
    let within = CObject::complement(&world).unwrap();
    let found = query.distance(&within, Configuration::Coordinates(&out), f64::INFINITY);
    let found = found.unwrap();
    assert_eq!((found.kind, found.lower), (DistanceKind::LowerBound, 0.0));
    assert_eq!(found.upper, f64::INFINITY);
}

/// Ridged: the root of x^2 + 4 y^2, less 1.
struct Ellipse {
    has_gradient: bool,
}

impl Predicate for Ellipse {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        let value = self.distance(q)?.unwrap();
        Ok(if value > 0.0 {
            Class::Outside
        } else {
            Class::Inside
        })
    }
    fn distance(&self, q: &[f64]) -> Result<Option<f64>> {
        Ok(Some(0.5 * (q[0].hypot(2.0 * q[2]) - 1.0)))
    }
    fn gradient(&self, q: &[f64], row: &mut [f64]) -> Result<bool> {
        row.fill(0.0);
        let root = q[0].hypot(2.0 * q[2]);
        row[0] = 0.5 * q[0] / root;
        row[2] = 2.0 * q[2] / root;
        Ok(self.has_gradient)
    }
}

/// Every kind of set, in and out: gradients of signed distances against central differences of the clearance.
#[test]
fn gradients_are_the_derivatives_of_clearances() {
    let space = mixed();
    let mut random = Random::new(4);
    let mut sampler = Sampler(9);
    let mut query = QueryContext::new();
    let mut checked = 0;
    for _ in 0..300 {
        let q = space.sample_beside(&mut sampler, &random_rest(&mut random));
        let center = space.sample_beside(&mut sampler, &random_rest(&mut random));
        let mut low = vec![f64::NEG_INFINITY; 14];
        let mut high = vec![f64::INFINITY; 14];
        for i in [0, 1, 2, 7, 8, 9] {
            let middle = random.within(-2.0, 2.0);
            (low[i], high[i]) = (middle - 0.4, middle + 0.4);
        }
        let mut normal = vec![0.0; 14];
        for i in [0, 2, 7, 8, 9] {
            normal[i] = random.within(-1.0, 1.0);
        }
        let shapes = [
            PureShape::BeyondLimits,
            PureShape::beyond_world(&space),
            PureShape::Box { low, high },
            PureShape::HalfSpace {
                normal,
                offset: random.within(-1.0, 1.0),
                is_open: false,
            },
            PureShape::Ball {
                center: center.to_vec(),
                radius: random.within(0.1, 5.0),
            },
            PureShape::Predicate(Arc::new(Ellipse { has_gradient: true })),
        ];
        for shape in shapes {
            let name = shape.name();
            let set = pure(&space, shape, Some(1.5));
            let mut clearance = |q: &[f64]| {
                let list = query.gradients(&set, q, f64::INFINITY, 10).unwrap();
                assert!(matches!(list.witnesses[0].s_side, SSide::PureSet(_)));
                let contact = list.contacts.first().map(|c| c.clearance);
                contact.map(|clearance| (clearance, list.gradients))
            };
            let Some((here, row)) = clearance(&q) else {
                assert_eq!(name, "a predicate");
                continue;
            };
            assert_eq!(row.len(), space.nv());
            let (step, mut differences) = (1e-5, Vec::new());
            let mut curvature = 0.0f64;
            for k in 0..space.nv() {
                let mut v = vec![0.0; space.nv()];
                let mut there = |h: f64| {
                    v[k] = h;
                    clearance(&space.step(&q, &v)).map(|(c, _)| c)
                };
                if let (Some(more), Some(less)) = (there(step), there(-step)) {
                    differences.push((more - less) / (2.0 * step));
                    curvature = curvature.max((more + less - 2.0 * here).abs() / step);
                }
            }
            // Where another face, or the far side of a circle, is as near, there is no derivative.
            if curvature > 1e-2 || differences.len() < space.nv() {
                continue;
            }
            for (x, y) in row.iter().zip(&differences) {
                assert!(
                    (x - y).abs() < 1e-6 * (1.0 + here.abs()),
                    "{name}: {row:?} {differences:?}"
                );
            }
            checked += 1;
        }
    }
    assert!(checked > 1200, "{checked}");
}

fn random_rest(random: &mut Random) -> Vec<f64> {
    let mut q = rest();
    for x in &mut q[7..10] {
        *x = random.within(-4.0, 4.0);
    }
    q
}

/// A predicate without a gradient answers all but gradients; one that contradicts itself is found out.
#[test]
fn predicates_are_checked() {
    struct Liar;
    impl Predicate for Liar {
        fn classify(&self, _: &[f64]) -> Result<Class> {
            Ok(Class::Outside)
        }
        fn distance(&self, _: &[f64]) -> Result<Option<f64>> {
            Ok(Some(-1.0))
        }
        fn is_exact(&self) -> bool {
            true
        }
        fn knows_depth(&self) -> bool {
            true
        }
    }
    let space = mixed();
    let mut query = QueryContext::new();
    let q = rest();
    let liar = pure(&space, PureShape::Predicate(Arc::new(Liar)), None);
    let found = query.distance(&liar, Configuration::Coordinates(&q), 1.0);
    assert_eq!(found.unwrap_err().kind, ErrorKind::Callback);
    let shape = PureShape::Predicate(Arc::new(Ellipse {
        has_gradient: false,
    }));
    let ellipse = pure(&space, shape, None);
    let q = with(&[(0, 3.0)]);
    let at = Configuration::Coordinates(&q);
    let found = query.distance(&ellipse, at, 9.0).unwrap();
    assert_eq!((found.kind, found.lower), (DistanceKind::LowerBound, 1.0));
    assert_eq!(
        query
            .witnesses(&ellipse, at, 9.0, 9)
            .unwrap()
            .witnesses
            .len(),
        1
    );
    let refused = query.gradients(&ellipse, &q, 9.0, 9);
    assert_eq!(refused.unwrap_err().kind, ErrorKind::Unsupported);
}

#[test]
fn shapes_are_checked() {
    let space = mixed();
    let refused = |shape: PureShape, options: PureOptions| {
        CObject::pure(space.clone(), shape, options)
            .unwrap_err()
            .kind
    };
    let plain = PureOptions::default;
    let free = || (vec![f64::NEG_INFINITY; 14], vec![f64::INFINITY; 14]);
    let a_box = |change: &dyn Fn(&mut Vec<f64>, &mut Vec<f64>)| {
        let (mut low, mut high) = free();
        change(&mut low, &mut high);
        PureShape::Box { low, high }
    };
    use ErrorKind::{Degenerate, InvalidArgument, NotFinite, WrongSize};
    assert_eq!(refused(a_box(&|l, _| l[0] = f64::NAN), plain()), NotFinite);
    assert_eq!(
        refused(a_box(&|l, h| (l[0], h[0]) = (2.0, 1.0)), plain()),
        InvalidArgument
    );
    assert_eq!(refused(a_box(&|l, _| l[1] = 0.0), plain()), InvalidArgument);
    assert_eq!(
        refused(a_box(&|l, h| (l[3], h[3]) = (0.0, 1.0)), plain()),
        InvalidArgument
    );
    assert_eq!(refused(a_box(&|l, _| l.truncate(13)), plain()), WrongSize);
    let half = |at: usize, x: f64| {
        let mut normal = vec![0.0; 14];
        normal[at] = x;
        PureShape::HalfSpace {
            normal,
            offset: 0.0,
            is_open: false,
        }
    };
    assert_eq!(refused(half(1, 1.0), plain()), InvalidArgument);
    assert_eq!(refused(half(4, 1.0), plain()), InvalidArgument);
    assert_eq!(refused(half(0, 0.0), plain()), Degenerate);
    assert_eq!(refused(half(0, f64::INFINITY), plain()), NotFinite);
    let ball = |radius| PureShape::Ball {
        center: rest(),
        radius,
    };
    assert_eq!(refused(ball(-1.0), plain()), InvalidArgument);
    assert_eq!(refused(ball(f64::NAN), plain()), NotFinite);
    let scaled = |scale| PureOptions {
        scale: Some(scale),
        ..plain()
    };
    assert_eq!(refused(ball(1.0), scaled(-1.0)), InvalidArgument);
    assert_eq!(refused(ball(1.0), scaled(f64::NAN)), NotFinite);
}
