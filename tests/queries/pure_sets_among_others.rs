//! Pure sets together with induced ones: units, slides, data that answers hand back, and how deep sets are made of sets.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, InducedOptions, PureOptions, PureShape};
use cstk::error::{Error, ErrorKind};
use cstk::motion::SlideOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext, SSide, Shell};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::{Space, WorldBox};
use cstk::user_data::UserData;

use helpers::pure::{distance, pure};
use helpers::robots::{against_with, environment, link, robot};
use helpers::shapes::cuboid;

/// A box of one robot that shifts along x, and an obstacle from 2 on.
fn cart() -> (Arc<Space>, CObject) {
    let mut links = vec![link(None, JointKind::Prismatic, Vec3::x())];
    let shape = cuboid([1.0, 1.0, 1.0]);
    links[0].body = Some(shape.body.clone());
    let range = Some(Coordinate::Interval {
        lower: -1.0,
        upper: 1.25,
    });
    let space = Space::new(vec![robot(3, links)], &[range], WorldBox::unbounded());
    let space = Arc::new(space.unwrap());
    let at = Pose::from_translation(Vec3::new(2.5, 0.0, 0.0));
    let (obstacles, _) = environment(&[(&shape.body, at)]);
    let options = InducedOptions::default();
    let cobject = against_with(&space, &obstacles, options);
    (space, cobject)
}

#[test]
fn lengths_and_units_of_c_space_are_not_mixed() {
    let (space, induced) = cart();
    let induced = Arc::new(induced);
    let union = |scale| {
        let limits = pure(&space, PureShape::BeyondLimits, scale);
        CObject::union(&[induced.clone(), limits]).unwrap()
    };
    let mut query = QueryContext::new();
    let q = [1.0];
    let at = Configuration::Coordinates(&q);
    let mixed = union(None);
    assert_eq!(query.classify(&mixed, at).unwrap(), Class::Outside);
    assert_eq!(query.explain(&mixed, at, 4).unwrap().leaves.len(), 2);
    let shell = Shell {
        max_shell: 1.0,
        max_count: 9,
        normalize: false,
    };
    let refusals = [
        query.distance(&mixed, at, f64::INFINITY).map(drop),
        query.within(&mixed, at, 0.5).map(drop),
        query.witnesses(&mixed, at, 0.5, 9).map(drop),
        query.gradients(&mixed, &q, 0.5, 9).map(drop),
        query.pseudo_normal(&mixed, &q, &shell).map(drop),
    ];
    for refused in refusals {
        let error = refused.unwrap_err();
        assert_eq!(error.kind, ErrorKind::Unsupported);
        assert!(error.message.contains("scale"), "{error}");
    }
    // The obstacle is 0.5 away, the limit 0.25 units.
    for (scale, expected) in [(1.0, 0.25), (10.0, 0.5)] {
        let union = union(Some(scale));
        assert!((distance(&union, &q) - expected).abs() < 1e-15);
        let list = query.gradients(&union, &q, 10.0, 9).unwrap();
        assert_eq!(list.contacts.len(), list.gradients.len());
        let of_limits = list
            .witnesses
            .iter()
            .find(|w| matches!(w.s_side, SSide::PureSet(_)))
            .unwrap();
        assert_eq!(of_limits.contact_count, 1);
        assert_eq!(list.gradients[of_limits.first_contact], -scale);
        let sorted = list.witnesses.is_sorted_by_key(|w| w.distance);
        assert!(sorted && !list.truncated);
        let cut = query.gradients(&union, &q, 10.0, 1).unwrap();
        assert!(cut.truncated && cut.witnesses[0].distance == list.witnesses[0].distance);
    }
}

/// A slide meets limits as it meets obstacles; sets of which too little is known are refused.
#[test]
fn slides_keep_off_pure_sets() {
    let (space, induced) = cart();
    let induced = Arc::new(induced);
    let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
    let union = CObject::union(&[induced.clone(), limits.clone()]).unwrap();
    let options = SlideOptions::with_shell(0.2);
    let mut query = QueryContext::new();
    let mut q = vec![0.0];
    for _ in 0..60 {
        q = query
            .slide(&union, &q, &[0.05], &options)
            .unwrap()
            .configuration;
    }
    // Stopped a desired distance before the limit at 1.25, not before the obstacle at 1.5.
    assert!((q[0] - (1.25 - 0.02)).abs() < 1e-3, "{q:?}");
    let ellipse = pure(
        &space,
        PureShape::Ball {
            center: vec![0.0],
            radius: 0.1,
        },
        Some(1.0),
    );
    for bad in [
        CObject::intersection(&[induced.clone(), limits.clone()]).unwrap(),
        CObject::complement(&ellipse).unwrap(),
    ] {
        let refused = query.slide(&bad, &[0.0], &[0.05], &options);
        assert_eq!(refused.unwrap_err().kind, ErrorKind::Unsupported);
    }
}

/// Answers name leaves and hand data back, through compounds too; what keeps the data goes with the last of them.
#[test]
fn data_come_back_with_witnesses() {
    let (space, induced) = cart();
    let kept = Arc::new(());
    let data = |value| UserData::new(value, Some(kept.clone()));
    let induced = Arc::new(induced.with_data(data(11)));
    let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
    let limits = Arc::new(limits.with_data(data(22)));
    let union = Arc::new(CObject::union(&[induced.clone(), limits.clone()]).unwrap());
    let both = CObject::intersection(&[union.clone(), union]).unwrap();
    let q = [1.0];
    let mut query = QueryContext::new();
    let found = query
        .witnesses(&both, Configuration::Coordinates(&q), 10.0, 99)
        .unwrap();
    let mut leaves: Vec<_> = found
        .witnesses
        .iter()
        .map(|w| (w.leaf.serial, w.leaf.data))
        .collect();
    leaves.sort_unstable();
    leaves.dedup();
    assert_eq!(leaves, [(induced.serial(), 11), (limits.serial(), 22)]);
    drop((induced, limits));
    assert!(Arc::strong_count(&kept) >= 3);
    drop(both);
    assert_eq!(Arc::strong_count(&kept), 1);
}

/// Sharing that would double with every level is asked once; towers beyond reason are refused.
#[test]
fn towers_of_sets_are_bounded() {
    let (space, induced) = cart();
    let mut tower = Arc::new(induced);
    let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
    for _ in 0..60 {
        let not = Arc::new(CObject::complement(&tower).unwrap());
        let both = Arc::new(CObject::intersection(&[not.clone(), limits.clone()]).unwrap());
        tower = Arc::new(CObject::union(&[not, both]).unwrap());
    }
    let q = [0.0];
    let at = Configuration::Coordinates(&q);
    let mut query = QueryContext::new();
    query.classify(&tower, at).unwrap();
    query.distance(&tower, at, f64::INFINITY).unwrap();
    query.within(&tower, at, 0.1).unwrap();
    query.witnesses(&tower, at, 0.1, 9).unwrap();
    assert_eq!(query.explain(&tower, at, 9).unwrap().leaves.len(), 3);
    let refused: Error = (0..1000)
        .find_map(|_| {
            let not = Arc::new(CObject::complement(&tower).unwrap());
            match CObject::intersection(&[not, limits.clone()]) {
                Ok(deeper) => {
                    tower = Arc::new(deeper);
                    None
                }
                Err(error) => Some(error),
            }
        })
        .unwrap();
    assert_eq!(refused.kind, ErrorKind::Unsupported);
}

/// A base on the world box's bottom: not out, and in nobody's way.
#[test]
fn the_boundary_of_the_world_box_is_allowed() {
    let mut links = vec![
        link(None, JointKind::Fixed, Vec3::z()),
        link(Some(0), JointKind::Prismatic, Vec3::z()),
    ];
    let body = cuboid([0.2; 3]).body;
    links[1].body = Some(body.clone());
    let world = WorldBox {
        low: [-1.0, -1.0, 0.0],
        high: [1.0, 1.0, 2.0],
    };
    let space = Arc::new(Space::new(vec![robot(3, links)], &[], world).unwrap());
    let (obstacles, _) = environment(&[(&body, Pose::from_translation(Vec3::new(9.0, 0.0, 0.0)))]);
    let induced = Arc::new(against_with(&space, &obstacles, InducedOptions::default()));
    let options = PureOptions::default();
    let beyond = CObject::pure(space.clone(), PureShape::beyond_world(&space), options).unwrap();
    let beyond = Arc::new(beyond);
    let union = CObject::union(&[induced, beyond.clone()]).unwrap();
    let mut query = QueryContext::new();
    let q = [0.5];
    let at = Configuration::Coordinates(&q);
    assert_eq!(query.classify(&union, at).unwrap(), Class::Outside);
    let list = query.witnesses(&beyond, at, 0.0, 10).unwrap();
    assert!(!list.witnesses[0].overlapping);
    assert_eq!(list.contacts[0].clearance, 0.0);
    let options = SlideOptions::with_shell(0.2);
    let step = query.slide(&union, &q, &[0.3], &options).unwrap();
    assert_eq!(step.configuration, [0.8]);
    // The link that moves is held up.
    let mut q = q.to_vec();
    for _ in 0..30 {
        q = query
            .slide(&union, &q, &[0.1], &options)
            .unwrap()
            .configuration;
    }
    assert!(q[0] < 2.0 && q[0] > 1.9, "{q:?}");
}
