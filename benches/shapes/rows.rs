//! Which bodies are asked what.

use super::poses::Motion;
use super::question::Query;
use super::shape::Shape;

/// Two bodies at poses of one kind, and what is asked of them. Mean ratios are those of the rows of one group.
pub struct Rows {
    pub group: &'static str,
    pub shapes: [Shape; 2],
    pub motion: Motion,
    pub gaps: [f64; 2],
    pub poses: usize,
    pub queries: Vec<Query>,
}

impl Rows {
    pub fn name(&self) -> String {
        format!("{} and {}", self.shapes[0].name, self.shapes[1].name)
    }

    fn of(group: &'static str, shapes: [Shape; 2], queries: &[Query]) -> Self {
        Self {
            group,
            shapes,
            motion: Motion::Random,
            gaps: [-0.5, 0.5],
            poses: 1000,
            queries: queries.to_vec(),
        }
    }

    fn of_surface(group: &'static str, shapes: [Shape; 2], queries: &[Query]) -> Self {
        Self {
            gaps: [-0.3, 0.3],
            poses: 100,
            ..Self::of(group, shapes, queries)
        }
    }
}

const KINDS: [&str; 8] = [
    "sphere",
    "capsule",
    "box",
    "cylinder",
    "cone",
    "ellipsoid",
    "hull 50",
    "hull 500",
];

const OTHER_PAIRS: [[&str; 2]; 7] = [
    ["sphere", "capsule"],
    ["sphere", "cylinder"],
    ["sphere", "hull 50"],
    ["capsule", "cylinder"],
    ["capsule", "hull 50"],
    ["cylinder", "hull 50"],
    ["hull 50", "hull 500"],
];

const MOTIONS: [Motion; 2] = [Motion::Random, Motion::Coherent];

/// A function that makes the rows, so that the large bodies are made one after the other.
pub type Maker = Box<dyn Fn() -> Rows>;

/// All of them; with `quick`, without the largest clouds. The seed is that of meshes and clouds.
pub fn all(quick: bool, seed: u64) -> Vec<Maker> {
    let mut makers = single_shapes();
    makers.extend(standing_shapes());
    makers.extend(touching_shapes());
    makers.extend(shapes_and_meshes(seed));
    makers.extend(thresholds(seed));
    makers.extend(clouds(quick, seed));
    makers.extend(contacts(seed));
    makers
}

fn single_shapes() -> Vec<Maker> {
    let with_itself = KINDS.map(|kind| [kind, kind]);
    let with_box = KINDS
        .iter()
        .filter(|kind| **kind != "box")
        .map(|kind| [*kind, "box"]);
    let mut makers: Vec<Maker> = Vec::new();
    for pair in with_itself.into_iter().chain(with_box).chain(OTHER_PAIRS) {
        for motion in MOTIONS {
            makers.push(Box::new(move || Rows {
                motion,
                ..Rows::of(
                    "shapes",
                    pair.map(Shape::named),
                    &[Query::Distance, Query::Collide],
                )
            }));
        }
    }
    makers
}

/// Shapes whose faces and axes are parallel, as in scenes that people build.
fn standing_shapes() -> Vec<Maker> {
    let mut makers: Vec<Maker> = Vec::new();
    for pair in [
        ["box", "box"],
        ["capsule", "box"],
        ["cylinder", "box"],
        ["cone", "box"],
        ["prism 12", "box"],
        ["capsule", "capsule"],
        ["cylinder", "capsule"],
        ["prism 12", "capsule"],
        ["cylinder", "cylinder"],
        ["prism 12", "cylinder"],
        ["prism 12", "prism 12"],
    ] {
        for motion in [Motion::Upright, Motion::Aligned] {
            makers.push(Box::new(move || Rows {
                motion,
                ..Rows::of(
                    "standing shapes",
                    pair.map(Shape::named),
                    &[Query::Distance, Query::Collide],
                )
            }));
        }
    }
    makers
}

/// What lies on one another, to within 1e-10, or has one middle: where solvers that step towards an answer find little to step on.
fn touching_shapes() -> Vec<Maker> {
    let mut makers: Vec<Maker> = Vec::new();
    for kind in [
        "box",
        "capsule",
        "cylinder",
        "cone",
        "ellipsoid",
        "prism 12",
        "hull 50",
        "hull 500",
    ] {
        for (motion, gaps) in [
            (Motion::Touching, [-1e-10, 1e-10]),
            (Motion::Resting, [-1e-10, 1e-10]),
            (Motion::Centred, [-2.0; 2]),
        ] {
            makers.push(Box::new(move || Rows {
                motion,
                gaps,
                ..Rows::of(
                    "touching shapes",
                    [kind; 2].map(Shape::named),
                    &[Query::Distance, Query::Collide],
                )
            }));
        }
    }
    makers
}

fn shapes_and_meshes(seed: u64) -> Vec<Maker> {
    let mut makers: Vec<Maker> = Vec::new();
    for polygons in [1000, 10_000] {
        for kind in ["sphere", "box", "capsule", "cylinder", "hull 50"] {
            for motion in MOTIONS {
                makers.push(Box::new(move || Rows {
                    motion,
                    ..Rows::of_surface(
                        "shapes and meshes",
                        [Shape::named(kind), Shape::mesh(polygons, seed)],
                        &[Query::Distance, Query::Collide],
                    )
                }));
            }
        }
    }
    makers
}

/// Just below the distance, where no answer can be had cheaply, and just above; bodies apart.
fn thresholds(seed: u64) -> Vec<Maker> {
    let queries = [Query::Within(0.99), Query::Within(1.01)];
    let gaps = [0.01, 1.0];
    let mut makers: Vec<Maker> = Vec::new();
    for pair in [
        ["box", "box"],
        ["capsule", "cylinder"],
        ["cylinder", "cylinder"],
        ["hull 50", "hull 50"],
    ] {
        makers.push(Box::new(move || Rows {
            gaps,
            ..Rows::of("thresholds", pair.map(Shape::named), &queries)
        }));
    }
    for kind in ["sphere", "hull 50", "mesh"] {
        makers.push(Box::new(move || {
            let first = match kind {
                "mesh" => Shape::mesh(10_000, seed),
                kind => Shape::named(kind),
            };
            let shapes = [first, Shape::mesh(10_000, seed + 1)];
            Rows {
                gaps,
                ..Rows::of_surface("thresholds", shapes, &queries)
            }
        }));
    }
    makers
}

fn clouds(quick: bool, seed: u64) -> Vec<Maker> {
    let sizes = if quick {
        vec![10_000]
    } else {
        vec![10_000, 100_000]
    };
    let mut makers: Vec<Maker> = Vec::new();
    for points in sizes {
        for with_mesh in [false, true] {
            makers.push(Box::new(move || {
                let other = match with_mesh {
                    true => Shape::mesh(1000, seed),
                    false => Shape::named("box"),
                };
                let shapes = [other, Shape::cloud(points, seed + 1)];
                Rows {
                    poses: 40,
                    ..Rows::of_surface("clouds", shapes, &[Query::Distance, Query::Collide])
                }
            }));
        }
    }
    makers
}

/// Two meshes that are a little in one another.
fn contacts(seed: u64) -> Vec<Maker> {
    let queries = [1, 16, 256].map(Query::Contacts);
    vec![Box::new(move || {
        let shapes = [0, 1].map(|i| Shape::mesh(10_000, seed + i));
        Rows {
            gaps: [-0.03, 0.0],
            ..Rows::of_surface("contacts", shapes, &queries)
        }
    })]
}
