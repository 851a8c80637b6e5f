//! Where several bodies meet, the first pair in order of ids is answered, whatever the context was asked before.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, InducedOptions};
use cstk::environment::{Change, Environment};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::{Configuration, Distance, DistanceKind, QueryContext, SSide};
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against_with, environment, link, robot, space};
use helpers::shapes::{box_corners, hulls};

const LINKS: usize = 7;
const OBJECTS: usize = 6;

struct Crowd {
    body: Arc<Body>,
    space: Arc<Space>,
    world: Arc<Environment>,
    objects: Vec<(u64, Pose)>,
}

impl Crowd {
    fn new(random: &mut Random) -> Self {
        // Three boxes that share corners, so that several primitives meet.
        let part = |at: f64| -> Vec<Vec3> {
            let corners = box_corners([0.6, 0.7, 0.4]);
            corners.iter().map(|corner| corner.add_scalar(at)).collect()
        };
        let body = hulls(&[part(0.4), part(0.0), part(-0.3)]).body;
        let links = (0..LINKS).map(|_| {
            let mut link = link(None, JointKind::Prismatic, Vec3::x());
            link.body = Some(body.clone());
            link
        });
        let places: Vec<Pose> = (0..OBJECTS).map(|_| random.pose(2.5)).collect();
        let placed: Vec<(&Arc<Body>, Pose)> = places.iter().map(|at| (&body, *at)).collect();
        let (world, ids) = environment(&placed);
        Self {
            space: space(vec![robot(3, links.collect())]),
            body,
            world,
            objects: ids.into_iter().zip(places).collect(),
        }
    }

    /// The links against all objects, and against each other.
    fn set(&self, margin: f64) -> CObject {
        let options = InducedOptions {
            margin,
            ..InducedOptions::default()
        };
        let pairs: Vec<[usize; 2]> = self.link_pairs().collect();
        let links = CObject::induced_links(self.space.clone(), &pairs, options).unwrap();
        let objects = against_with(&self.space, &self.world, options);
        CObject::union(&[links.into(), objects.into()]).unwrap()
    }

    fn link_pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        (0..LINKS).flat_map(|r| (r + 1..LINKS).map(move |s| [r, s]))
    }

    /// The nearest pair, of several the first by its r-link, objects before links, by asking of each pair alone.
    fn nearest(&self, poses: &[Pose], margin: f64) -> (f64, usize, SSide, [u32; 2]) {
        let mut best: Option<(f64, usize, SSide, [u32; 2])> = None;
        for r in 0..LINKS {
            let objects = self.objects.iter();
            let objects = objects.map(|(id, pose)| (SSide::Object(*id), *pose));
            let links = (r + 1..LINKS).map(|s| (SSide::Link(s), poses[s]));
            for (side, pose) in objects.chain(links) {
                let bodies = ((&*self.body, &poses[r]), (&*self.body, &pose));
                let mut fresh = QueryContext::new();
                let near = fresh.pair_witnesses(bodies.0, bodies.1, margin, usize::MAX);
                let near = near.unwrap().witnesses.into_iter();
                let first = near.map(|witness| witness.primitives).min();
                let (clear, primitives) = first.map_or_else(
                    || {
                        let found = fresh.pair_distance(bodies.0, bodies.1, f64::INFINITY);
                        let found = found.unwrap();
                        (found.distance - margin, found.witness.unwrap().primitives)
                    },
                    |primitives| (0.0, primitives),
                );
                if best.is_none_or(|best| clear < best.0) {
                    best = Some((clear, r, side, primitives));
                }
            }
        }
        best.unwrap()
    }
}

fn told(found: &Distance) -> (f64, usize, SSide, [u32; 2]) {
    let witness = found.witness.as_ref().unwrap();
    (
        found.distance,
        witness.r_link,
        witness.s_side,
        witness.primitives,
    )
}

#[test]
fn of_pairs_that_meet_the_first_is_answered_whatever_was_asked_before() {
    let mut random = Random::new(11);
    let (mut meeting, mut apart) = (0, 0);
    for case in 0..12 {
        let crowd = Crowd::new(&mut random);
        let margin = [0.0, 0.03][case % 2];
        let set = crowd.set(margin);
        let spread = [1.0, 3.0, 8.0][case % 3];
        let mut used = QueryContext::new();
        // Small steps, so that the pair found last mostly meets again.
        for _ in 0..6 {
            let mut poses: Vec<Pose> = (0..LINKS).map(|_| random.pose(spread)).collect();
            for _ in 0..8 {
                for pose in &mut poses {
                    pose.translation += 0.1 * random.unit();
                    let turn = rotation_about(&random.unit(), 0.05);
                    pose.rotation = turn * pose.rotation;
                }
                let at = Configuration::LinkPoses(&poses);
                let warm = used.distance(&set, at, f64::INFINITY).unwrap();
                let mut fresh = QueryContext::new();
                let cold = fresh.distance(&set, at, f64::INFINITY).unwrap();
                assert_eq!(told(&warm), told(&cold), "case {case}");
                assert_eq!((warm.lower, warm.upper), (cold.lower, cold.upper));
                assert_eq!(warm.points, cold.points, "case {case}");
                let expected = crowd.nearest(&poses, margin);
                assert_eq!(told(&warm), expected, "case {case}");
                let limited = used.distance(&set, at, 0.0).unwrap();
                if warm.distance == 0.0 {
                    assert_eq!(told(&limited), expected, "case {case}");
                    meeting += 1;
                } else {
                    assert_eq!(limited.kind, DistanceKind::BeyondMax);
                    apart += 1;
                }
            }
        }
    }
    assert!(meeting > 200 && apart > 50, "{meeting} {apart}");
}

/// An environment and an older state of it, in which objects are elsewhere, by several terms with other margins: which of two pairs with
/// the same ids is answered depends on where they are, not on what was asked before.
#[test]
fn of_two_states_of_an_object_the_same_is_answered_whatever_was_asked_before() {
    let mut random = Random::new(12);
    let ball = hulls(&[box_corners([0.5, 0.4, 0.3])]).body;
    let (mut met, mut twice) = (0, 0);
    for case in 0..150 {
        let links = (0..2).map(|_| {
            let mut link = link(None, JointKind::Prismatic, Vec3::x());
            link.body = Some(ball.clone());
            link
        });
        let space = space(vec![robot(3, links.collect())]);
        let places = [random.pose(0.6), random.pose(0.6)];
        let (live, ids) = environment(&places.map(|at| (&ball, at)));
        let old = Arc::new(live.freeze());
        let moves = ids.iter().map(|&id| Change::Move {
            id,
            pose: random.pose(0.6),
        });
        live.apply(&moves.collect::<Vec<_>>()).unwrap();
        let terms: Vec<Arc<CObject>> = (0..4)
            .map(|_| {
                let world = [&old, &live][random.below(2)];
                let options = InducedOptions {
                    margin: [0.0, 0.2][random.below(2)],
                    ..InducedOptions::default()
                };
                Arc::new(against_with(&space, world, options))
            })
            .collect();
        let union = CObject::union(&terms).unwrap();
        let mut used = QueryContext::new();
        for _ in 0..20 {
            let q = [random.within(-0.6, 0.6), random.within(-0.6, 0.6)];
            let at = Configuration::Coordinates(&q);
            if random.below(2) == 0 {
                let part = &terms[random.below(terms.len())];
                used.distance(part, at, f64::INFINITY).unwrap();
            }
            let warm = used.distance(&union, at, f64::INFINITY).unwrap();
            let cold = QueryContext::new()
                .distance(&union, at, f64::INFINITY)
                .unwrap();
            assert_eq!(told(&warm), told(&cold), "case {case}");
            assert_eq!((warm.lower, warm.upper), (cold.lower, cold.upper));
            assert_eq!(warm.points, cold.points, "case {case}");
            let leaf = |found: &Distance| found.witness.as_ref().unwrap().leaf;
            assert_eq!(leaf(&warm), leaf(&cold), "case {case}");
            let parts = terms.iter().map(|part| {
                let mut fresh = QueryContext::new();
                fresh.distance(part, at, f64::INFINITY).unwrap().distance
            });
            let parts: Vec<f64> = parts.collect();
            let least = parts.iter().copied().fold(f64::INFINITY, f64::min);
            assert_eq!(warm.distance, least, "case {case}");
            met += usize::from(least == 0.0);
            twice += usize::from(parts.iter().filter(|&&part| part == 0.0).count() > 1);
        }
    }
    assert!(met > 1000 && twice > 500, "{met} {twice}");
}
