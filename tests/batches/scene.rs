//! What the tests ask about: an arm that holds an object among 60 others, with its own links and its limits.

use std::sync::Arc;

use cstk::batch::{BatchJob, BatchOptions, Configurations, Slots};
use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, InducedOptions, PureOptions, PureShape};
use cstk::environment::{Attachment, Change, Environment};
use cstk::error::Result;
use cstk::pose::{Pose, Vec3};
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::models::built;
use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::dented_ball;

pub const NQ: usize = 7;

pub struct Arm {
    pub space: Arc<Space>,
    pub environment: Arc<Environment>,
    pub body: Arc<Body>,
    /// Against all objects, its own links, and beyond its limits.
    pub contact: CObject,
    /// What this is the union of.
    pub parts: [Arc<CObject>; 3],
}

fn solid_box(half: f64) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    let half = Vec3::new(half, 0.5 * half, 0.2 * half);
    builder.add_box(&Pose::identity(), &half, 0).unwrap();
    Arc::new(built(&builder, &Default::default()))
}

fn links(body: &Arc<Body>) -> Arc<Space> {
    let links = (0..NQ).map(|i| {
        let axis = [Vec3::z(), Vec3::y()][i % 2];
        let mut link = link(i.checked_sub(1), JointKind::Revolute, axis);
        link.at = Pose::from_translation(Vec3::x() * 0.3);
        link.limits = [-3.0, 2.9];
        link.body = Some(body.clone());
        link
    });
    space(vec![robot(3, links.collect())])
}

impl Arm {
    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let dented = dented_ball(|| random.within(0.2, 0.4)).body;
        let boxy = solid_box(0.12);
        let placed: Vec<(&Arc<Body>, Pose)> = (0..60)
            .map(|i| ([&dented, &boxy][i % 2], random.pose(2.5)))
            .collect();
        let (environment, ids) = environment(&placed);
        let space = links(&solid_box(0.05));
        environment
            .apply(&[Change::Attach {
                id: ids[1],
                pose: Pose::identity(),
                attachment: Attachment::new(&space, NQ - 1, &[]).unwrap(),
            }])
            .unwrap();
        let pairs: Vec<[usize; 2]> = (2..NQ)
            .flat_map(|s| (0..s - 1).map(move |r| [r, s]))
            .collect();
        let own = CObject::induced_links(space.clone(), &pairs, InducedOptions::default());
        let scaled = PureOptions {
            scale: Some(1.0),
            ..PureOptions::default()
        };
        let limits = CObject::pure(space.clone(), PureShape::BeyondLimits, scaled);
        let parts = [
            Arc::new(against(&space, &environment)),
            Arc::new(own.unwrap()),
            Arc::new(limits.unwrap()),
        ];
        Self {
            contact: CObject::union(&parts).unwrap(),
            parts,
            space,
            environment,
            body: dented,
        }
    }

    /// Half of them anywhere, the others in short steps.
    pub fn configurations(&self, count: usize, seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let mut all: Vec<f64> = Vec::new();
        for i in 0..count {
            for k in 0..NQ {
                all.push(if i < count.div_ceil(2) {
                    random.within(-3.1, 3.1)
                } else {
                    all[all.len() - NQ] + 0.02 * (k as f64 - 3.0)
                });
            }
        }
        all
    }
}

pub fn at(q: &[f64]) -> Configurations<'_> {
    Configurations {
        q,
        count: q.len() / NQ,
    }
}

pub fn on_threads(threads: u32) -> BatchOptions {
    BatchOptions {
        threads,
        ..Default::default()
    }
}

/// A job whose progress nobody hears.
pub fn quiet<'a, S: Slots>(
    options: &'a BatchOptions,
    slots: S,
    progress: &'a mut dyn FnMut(f64) -> Result<()>,
) -> BatchJob<'a, S> {
    BatchJob {
        options,
        slots,
        progress,
    }
}
