//! Pairs of links are culled by their boxes, eight side by side; the oracle asks each pair of bodies by itself.

use cstk::cobject::{CObject, Class, InducedOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::JointKind;

use helpers::changing::spatial_bodies;
use helpers::random::Random;
use helpers::robots::{link, robot, space};

#[test]
fn all_pairs_of_links_are_asked() {
    let mut random = Random::new(91);
    let mut counts = [[0u32; 2]; 2];
    for _ in 0..400 {
        let bodies = spatial_bodies(&mut random);
        let count = 2 + random.below(24);
        let links: Vec<_> = (0..count)
            .map(|_| {
                let mut one = link(None, JointKind::Fixed, Vec3::x());
                // Some links have none.
                one.body = bodies.get(random.below(bodies.len() + 1)).cloned();
                one
            })
            .collect();
        let body_of: Vec<_> = links.iter().map(|one| one.body.clone()).collect();
        let poses: Vec<Pose> = body_of
            .iter()
            .map(|body| {
                let mut pose = random.pose(4.0);
                if let Some(body) = body {
                    pose.translation -= pose.rotation * body.center();
                }
                pose
            })
            .collect();
        // In any order, either link first.
        let mut pairs = Vec::new();
        for _ in 0..count * count / 3 {
            let pair = [random.below(count), random.below(count)];
            if pair[0] != pair[1] && pair.iter().all(|&link| body_of[link].is_some()) {
                pairs.push(pair);
            }
        }
        let space = space(vec![robot(3, links)]);
        let options = InducedOptions {
            margin: [0.0, 0.1][random.below(2)],
            ..InducedOptions::default()
        };
        let cobject = CObject::induced_links(space, &pairs, options).unwrap();
        let at = Configuration::LinkPoses(&poses);
        let threshold = random.within(0.0, 0.5);
        let mut context = QueryContext::new();
        let any_within = |beyond: f64| {
            let mut oracle = QueryContext::new();
            pairs.iter().any(|&pair| {
                let [a, b] = pair.map(|link| (body_of[link].as_deref().unwrap(), &poses[link]));
                oracle.pair_within(a, b, options.margin + beyond).unwrap()
            })
        };
        let within = context.within(&cobject, at, threshold).unwrap();
        assert_eq!(within, any_within(threshold));
        let is_inside = context.classify(&cobject, at).unwrap() == Class::Inside;
        assert_eq!(is_inside, any_within(0.0));
        counts[0][usize::from(within)] += 1;
        counts[1][usize::from(is_inside)] += 1;
    }
    println!("not within or within, not inside or inside: {counts:?}");
    assert!(counts.as_flattened().iter().all(|count| *count > 40));
}
