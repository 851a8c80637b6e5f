//! Bodies of generated models, with all ways to build their hierarchies.

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::hierarchy::{Grouping, HierarchyOptions, WrapperKind};
use cstk::pose::{Pose, Vec3};

use super::random::Random;
use super::shapes::box_corners;

pub const GROUPINGS: [Grouping; 3] = [Grouping::Hybrid, Grouping::Basic, Grouping::TopDown];

pub const KINDS: [WrapperKind; 5] = [
    WrapperKind::Hull,
    WrapperKind::OrientedBox,
    WrapperKind::AlignedBox,
    WrapperKind::TightSphere,
    WrapperKind::MergedSphere,
];

pub fn options(grouping: Grouping, wrapper: WrapperKind, aspect_limit: f64) -> HierarchyOptions {
    HierarchyOptions {
        grouping,
        wrapper,
        aspect_limit,
        ..Default::default()
    }
}

/// The faces of a generated mesh, tagged with their indices.
pub fn builder(mesh: &cstk_scenes::Mesh) -> BodyBuilder {
    let mut builder = BodyBuilder::new(3).unwrap();
    let mesh = Mesh {
        vertices: mesh.vertices.iter().map(|p| Vec3::from(*p)).collect(),
        face_sizes: mesh.faces.iter().map(|f| f.len() as u32).collect(),
        indices: mesh.faces.concat(),
    };
    builder.add_mesh(&mesh).unwrap();
    builder
}

pub fn built(builder: &BodyBuilder, options: &HierarchyOptions) -> Body {
    builder.build(options, &mut |_| Ok(())).unwrap()
}

pub fn pose(pose: &cstk_scenes::Pose) -> Pose {
    Pose::from_row_major(&pose.0).unwrap()
}

/// `count` copies of the same square.
pub fn squares(count: usize) -> BodyBuilder {
    let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| Vec3::new(x, y, 0.25));
    let mut builder = BodyBuilder::new(3).unwrap();
    for tag in 0..count {
        builder.add_polygon(&square, tag as u64).unwrap();
    }
    builder
}

/// Points, segments, polygons, needles, boxes and round solids of up to 60 points, scattered.
pub fn mixed_primitives(count: usize, seed: u64) -> BodyBuilder {
    let mut random = Random::new(seed);
    let mut builder = BodyBuilder::new(3).unwrap();
    for tag in 0..count {
        let at = random.pose(3.0);
        let points: Vec<Vec3> = match tag % 7 {
            0 => vec![Vec3::zeros()],
            1 => vec![Vec3::zeros(), random.point(1.0)],
            2 => random.polygon(3 + tag % 5, 0.5),
            3 => box_corners([2.0, 0.02, 0.03]),
            4 => box_corners([0.3, 0.4, 0.5]),
            5 => random.points(12, 0.4),
            _ => (0..60).map(|_| random.unit() * 0.4).collect(),
        };
        let points: Vec<Vec3> = points.iter().map(|p| at.transform_point(p)).collect();
        builder.add_polyhedron(&points, tag as u64).unwrap();
    }
    builder
}
