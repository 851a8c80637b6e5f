//! Which pairs of links a self-collision set should test: the rules, and shares that closed forms know.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, InducedOptions};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, LinkPair, LinkPairOptions, PairVerdict, QueryContext};
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};

use helpers::robots::{link, robot, space};
use helpers::shapes::box_corners;

fn cuboid(sides: [f64; 3], at: Vec3) -> Arc<Body> {
    let corners: Vec<Vec3> = box_corners(sides).iter().map(|c| c + at).collect();
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&corners, 0).unwrap();
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

/// A link with a body, joined at a place by a joint about or along z.
fn part(
    parent: Option<usize>,
    kind: JointKind,
    at: [f64; 3],
    body: Option<Arc<Body>>,
) -> LinkDefinition {
    LinkDefinition {
        body,
        at: Pose::from_translation(Vec3::from(at)),
        ..link(parent, kind, Vec3::z())
    }
}

fn verdict(pairs: &[LinkPair], links: [usize; 2]) -> (PairVerdict, f64) {
    let pair = pairs.iter().find(|pair| pair.links == links);
    let pair = pair.unwrap_or_else(|| panic!("no pair {links:?}"));
    (pair.verdict, pair.share)
}

fn judged(space: &Space, options: &LinkPairOptions) -> Vec<LinkPair> {
    let mut query = QueryContext::new();
    query
        .find_link_pairs(space, options, &mut |_| Ok(()))
        .unwrap()
}

/// A turntable with an arm, posts around it, and links of every kind of pair.
#[test]
fn every_rule_finds_its_pairs() {
    let (fixed, turning) = (JointKind::Fixed, JointKind::Revolute);
    let small = || cuboid([0.2, 0.2, 0.2], Vec3::zeros());
    let links = vec![
        // 0: the base. 1: a table that turns in it. 2: a frame without a body. 3: an arm along x, 1 to 2 from the axis.
        part(None, fixed.clone(), [0.0; 3], Some(small())),
        part(Some(0), turning.clone(), [0.0, 0.0, 0.5], Some(small())),
        part(Some(1), fixed.clone(), [0.0; 3], None),
        part(
            Some(2),
            fixed.clone(),
            [0.0; 3],
            Some(cuboid([1.0, 1e-6, 0.2], Vec3::new(1.5, 0.0, 0.0))),
        ),
        // 4: a post in the arm's way, fixed to the base, seen from the axis under an angle of 2 atan(0.25 / 1.5).
        part(
            Some(0),
            fixed.clone(),
            [0.0, 1.5, 0.5],
            Some(cuboid([0.5, 1e-6, 0.2], Vec3::zeros())),
        ),
        // 5: a ring's part that every position of the table touches: around the axis.
        part(Some(4), fixed.clone(), [0.0, -1.5, 0.0], Some(small())),
        // 6: far below all. 7: turns there, joined to it by nothing with a body.
        part(None, fixed.clone(), [0.0, 0.0, -5.0], Some(small())),
        part(None, turning, [3.0, 0.0, -5.0], Some(small())),
    ];
    let space = space(vec![robot(3, links)]);
    let options = LinkPairOptions {
        samples: 20_000,
        rest: Some(vec![1.0, 0.0]),
        ..LinkPairOptions::default()
    };
    let pairs = judged(&space, &options);
    // Links with bodies: 0, 1, 3, 4, 5, 6, 7.
    assert_eq!(pairs.len(), 21);
    let is = |links: [usize; 2], expected: PairVerdict| {
        assert_eq!(verdict(&pairs, links).0, expected, "{links:?}");
    };
    is([0, 1], PairVerdict::Adjacent);
    // Past the frame without a body.
    is([1, 3], PairVerdict::Adjacent);
    // Fixed to each other, one through the other.
    is([0, 4], PairVerdict::Adjacent);
    is([0, 5], PairVerdict::Adjacent);
    is([4, 5], PairVerdict::Adjacent);
    // Both stand still, but nothing says that they are fixed to each other, except the world.
    is([0, 6], PairVerdict::Never);
    is([6, 7], PairVerdict::Never);
    is([1, 5], PairVerdict::AtRest);
    // The arm sweeps over the post in a known share of all angles.
    let (found, share) = verdict(&pairs, [3, 4]);
    let expected = 2.0 * (0.25f64 / 1.5).atan() / std::f64::consts::TAU;
    assert_eq!(found, PairVerdict::Test);
    let deviation = (expected * (1.0 - expected) / 20_000.0).sqrt();
    assert!(
        (share - expected).abs() < 4.0 * deviation,
        "{share} {expected}"
    );
}

/// Pairs that are apart at rest only: nearly always in touch.
#[test]
fn what_hardly_ever_parts_is_left_out() {
    let links = vec![
        part(
            None,
            JointKind::Fixed,
            [0.0; 3],
            Some(cuboid([1.0; 3], Vec3::zeros())),
        ),
        part(
            Some(0),
            JointKind::Fixed,
            [5.0, 0.0, 0.0],
            Some(cuboid([0.1; 3], Vec3::zeros())),
        ),
        // Slides from within the first to just outside of it.
        part(
            Some(1),
            JointKind::Prismatic,
            [-5.0, 0.0, 0.0],
            Some(cuboid([1.0; 3], Vec3::zeros())),
        ),
    ];
    for (reach, expected) in [(1.02, PairVerdict::Always), (1.2, PairVerdict::Test)] {
        let range = Some(Coordinate::Interval {
            lower: 0.0,
            upper: reach,
        });
        let space = Space::new(
            vec![robot(3, links.clone())],
            &[range],
            WorldBox::unbounded(),
        );
        let options = LinkPairOptions {
            rest: Some(vec![reach]),
            ..LinkPairOptions::default()
        };
        let pairs = judged(&space.unwrap(), &options);
        assert_eq!(verdict(&pairs, [0, 2]).0, expected);
        let options = LinkPairOptions {
            margin: 0.3,
            ..options
        };
        let space = Space::new(
            vec![robot(3, links.clone())],
            &[range],
            WorldBox::unbounded(),
        );
        let pairs = judged(&space.unwrap(), &options);
        assert_eq!(verdict(&pairs, [0, 2]).0, PairVerdict::AtRest);
    }
}

/// Links of different robots are always tested, though they touch at rest; lines without bounds stay at rest.
#[test]
fn robots_are_kept_from_each_other() {
    let one = || {
        robot(
            3,
            vec![part(
                None,
                JointKind::Prismatic,
                [0.0; 3],
                Some(cuboid([1.0; 3], Vec3::zeros())),
            )],
        )
    };
    let space = space(vec![one(), one()]);
    let pairs = judged(&space, &LinkPairOptions::default());
    assert_eq!(verdict(&pairs, [0, 1]), (PairVerdict::Test, 1.0));
    let flat: Vec<[usize; 2]> = pairs.iter().map(|pair| pair.links).collect();
    let cobject = CObject::induced_links(space, &flat, InducedOptions::default()).unwrap();
    let mut query = QueryContext::new();
    let apart = Configuration::Coordinates(&[0.0, 1.5]);
    let found = query.distance(&cobject, apart, f64::INFINITY).unwrap();
    assert!((found.distance - 0.5).abs() < 1e-15);
}

#[test]
fn options_are_checked() {
    let links = vec![part(
        None,
        JointKind::Revolute,
        [0.0; 3],
        Some(cuboid([1.0; 3], Vec3::zeros())),
    )];
    let space = space(vec![robot(3, links)]);
    let mut query = QueryContext::new();
    let mut refused = |change: &dyn Fn(&mut LinkPairOptions)| {
        let mut options = LinkPairOptions::default();
        change(&mut options);
        query
            .find_link_pairs(&space, &options, &mut |_| Ok(()))
            .unwrap_err()
            .kind
    };
    assert_eq!(refused(&|o| o.samples = 0), ErrorKind::InvalidArgument);
    assert_eq!(refused(&|o| o.always = 0.0), ErrorKind::InvalidArgument);
    assert_eq!(
        refused(&|o| o.always = f64::NAN),
        ErrorKind::InvalidArgument
    );
    assert_eq!(refused(&|o| o.margin = -1.0), ErrorKind::InvalidArgument);
    assert_eq!(refused(&|o| o.margin = f64::NAN), ErrorKind::NotFinite);
    assert_eq!(refused(&|o| o.rest = Some(vec![])), ErrorKind::WrongSize);
    let mut stopped = |_: f64| Err(cstk::error::Error::new(ErrorKind::Cancelled, "enough"));
    let ended = query.find_link_pairs(&space, &LinkPairOptions::default(), &mut stopped);
    assert_eq!(ended.unwrap_err().kind, ErrorKind::Cancelled);
}

/// Links on either side of one without a body are joined, whichever way the chain runs.
#[test]
fn frames_without_a_body_join() {
    let (fixed, turning) = (JointKind::Fixed, JointKind::Revolute);
    let small = || Some(cuboid([0.2, 0.2, 0.2], Vec3::zeros()));
    let links = vec![
        // 0: a root without a body. 1 is fixed to it, 2 turns on it, 3 on a frame that turns on it.
        part(None, fixed.clone(), [0.0; 3], None),
        part(Some(0), fixed.clone(), [1.0, 0.0, 0.0], small()),
        part(Some(0), turning.clone(), [0.0, 3.0, 0.0], small()),
        part(Some(0), turning.clone(), [0.0; 3], None),
        part(Some(3), turning.clone(), [0.0, 0.0, 5.0], small()),
        // 5 stands on 4 with a body.
        part(Some(4), turning, [0.0, 0.0, 3.0], small()),
    ];
    let pairs = judged(&space(vec![robot(3, links)]), &LinkPairOptions::default());
    for joined in [[1, 2], [1, 4], [2, 4], [4, 5]] {
        assert_eq!(
            verdict(&pairs, joined).0,
            PairVerdict::Adjacent,
            "{joined:?}"
        );
    }
    for apart in [[1, 5], [2, 5]] {
        assert_ne!(verdict(&pairs, apart).0, PairVerdict::Adjacent, "{apart:?}");
    }
}
