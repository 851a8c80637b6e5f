//! Our queries.

use std::sync::Arc;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::cobject::{CObject, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Change, Environment};
use cstk::hierarchy::{HierarchyOptions, WrapperKind};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition, RobotBuilder};
use cstk::space::{Space, WorldBox};

use super::case::{Case, Mode, Query, merged};

/// What a case asks of us.
pub enum Asked {
    /// Two bodies, of which the second stands still.
    Bodies(Arc<Body>, Arc<Body>),
    CObject(Box<CObject>),
}

/// What a pass took, its answers, and the boxes and primitives tested per query.
pub struct Pass {
    pub seconds: f64,
    pub answers: Vec<f64>,
    pub tests: [f64; 2],
}

impl Asked {
    pub fn new(case: &Case, wrapper: WrapperKind) -> Self {
        match case.query {
            Query::Pair => Self::Bodies(
                body(&case.moving[0], wrapper),
                body(&merged(&case.obstacles), wrapper),
            ),
            Query::CObject => Self::CObject(Box::new(cobject(case, wrapper))),
        }
    }

    /// The memory that queries of two bodies read.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Bodies(moving, still) => moving.packed().bytes() + still.packed().bytes(),
            Self::CObject(_) => 0,
        }
    }

    /// All queries, with or without the witnesses of the last one.
    pub fn run(&self, case: &Case, mode: Mode, cached: bool) -> Pass {
        let mut context = QueryContext::new();
        let mut answers = Vec::with_capacity(case.poses.len());
        let start = Instant::now();
        for poses in &case.poses {
            if !cached {
                context.clear();
            }
            answers.push(self.answer(&mut context, poses, mode));
        }
        let seconds = start.elapsed().as_secs_f64();
        let done = context.statistics();
        let each = |count: u64| count as f64 / case.poses.len() as f64;
        Pass {
            seconds,
            answers,
            tests: [each(done.node_pairs), each(done.primitive_pairs)],
        }
    }

    fn answer(&self, context: &mut QueryContext, poses: &[Pose], mode: Mode) -> f64 {
        let yes = |yes: bool| f64::from(u8::from(yes));
        match self {
            Self::Bodies(moving, still) => {
                let (a, b) = ((&**moving, &poses[0]), (&**still, &Pose::identity()));
                let within = |context: &mut QueryContext, threshold: f64| {
                    yes(context.pair_within(a, b, threshold).expect("an answer"))
                };
                match mode {
                    Mode::Distance => {
                        let found = context.pair_distance(a, b, f64::INFINITY);
                        found.expect("a distance").distance
                    }
                    Mode::Within(threshold) => within(context, threshold),
                    Mode::Collide => within(context, 0.0),
                }
            }
            Self::CObject(cobject) => {
                let at = Configuration::LinkPoses(poses);
                let within = |context: &mut QueryContext, threshold: f64| {
                    yes(context.within(cobject, at, threshold).expect("an answer"))
                };
                match mode {
                    Mode::Distance => {
                        let found = context.distance(cobject, at, f64::INFINITY);
                        found.expect("a distance").distance
                    }
                    Mode::Within(threshold) => within(context, threshold),
                    Mode::Collide => within(context, 0.0),
                }
            }
        }
    }
}

fn body(mesh: &Mesh, wrapper: WrapperKind) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).expect("a builder");
    builder.add_mesh(mesh).expect("a sound mesh");
    let options = HierarchyOptions {
        wrapper,
        ..HierarchyOptions::default()
    };
    let body = builder.build(&options, &mut |_| Ok(()));
    Arc::new(body.expect("a body"))
}

/// All links against all obstacles.
fn cobject(case: &Case, wrapper: WrapperKind) -> CObject {
    let mut builder = RobotBuilder::new(3).expect("a builder");
    for mesh in &case.moving {
        let link = LinkDefinition {
            body: Some(body(mesh, wrapper)),
            kind: JointKind::Prismatic,
            axis: Vec3::x(),
            ..Default::default()
        };
        builder.add_link(link).expect("a link");
    }
    let robot = Arc::new(builder.build().expect("a robot"));
    let space = Space::new(vec![robot], &[], WorldBox::unbounded()).expect("a space");
    let environment = Arc::new(Environment::default());
    let changes: Vec<Change> = case
        .obstacles
        .iter()
        .map(|mesh| Change::add(body(mesh, wrapper), Pose::identity()))
        .collect();
    environment.apply(&changes).expect("obstacles");
    let all = SObjects::All(environment);
    CObject::induced(
        Arc::new(space),
        &[],
        all,
        LeftOut::default(),
        InducedOptions::default(),
    )
    .expect("a C-object")
}
