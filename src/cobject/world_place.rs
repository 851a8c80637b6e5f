//! Pure sets in the world: the outside of the world box, and floors.

use super::SpaceState;
use crate::pose::Vec3;
use crate::tolerance::DISTANCE_ERROR;

/// The place of contact with a set in the world: a point of a link (its origin, for the world box), and the direction out
/// of the set.
#[derive(Clone, Copy, Debug)]
pub struct WorldPlace {
    /// The number of the link.
    pub link: usize,
    /// The primitive of the link's body that holds the point; `None` for a link's origin.
    pub primitive: Option<u32>,
    /// In the world.
    pub point: Vec3,
    /// Of length 1, out of the set, in the world.
    pub normal: Vec3,
}

/// The smallest signed distance of the links' origins from the outside of the world box, negative for origins outside, and
/// the place that decides.
pub(super) fn beyond_world(at: &SpaceState, links: &[usize]) -> (f64, Option<WorldPlace>) {
    let world = at.space.world();
    let mut least = f64::INFINITY;
    let mut place = None;
    for &link in links {
        let point = at.poses[link].translation;
        let mut outside = Vec3::zeros();
        let mut within = (f64::INFINITY, Vec3::zeros());
        // A planar world has no height.
        for axis in 0..at.space.dimension() as usize {
            for (clear, sign) in [
                (point[axis] - world.low[axis], 1.0),
                (world.high[axis] - point[axis], -1.0),
            ] {
                if clear < within.0 {
                    within = (clear, Vec3::ith(axis, sign));
                }
                if clear < 0.0 {
                    outside[axis] = -sign * clear;
                }
            }
        }
        let (clear, normal) = match outside.try_normalize(0.0) {
            Some(normal) => (-outside.norm(), normal),
            None => within,
        };
        if clear < least {
            least = clear;
            place = Some(WorldPlace {
                link,
                primitive: None,
                point,
                normal,
            });
        }
    }
    (least, place)
}

/// The height of the links' lowest point over a floor, less the deviation that its body states, and that point.
pub(super) fn over_floor(
    at: &SpaceState,
    links: &[usize],
    normal: &Vec3,
    offset: f64,
) -> (f64, Option<WorldPlace>) {
    let mut least = f64::INFINITY;
    let mut place = None;
    for &link in links {
        let Some(body) = at.space.body(link) else {
            continue;
        };
        let pose = &at.poses[link];
        let deviation = body.stated_deviation();
        // A link whose ball lies higher than the lowest point so far has none lower, nor one as low.
        let height = normal.dot(&pose.transform_point(body.center())) - offset;
        let rounding = 1e-12 * (pose.translation.norm() + body.radius_from_origin() + offset.abs());
        if height - body.radius() - deviation - rounding > least {
            continue;
        }
        let lowest = body.farthest(&-pose.rotation.tr_mul(normal));
        let point = pose.transform_point(&(lowest.point + body.center()));
        let over = normal.dot(&point) - offset - deviation;
        if over < least {
            least = over;
            place = Some(WorldPlace {
                link,
                primitive: Some(lowest.primitive),
                point,
                normal: *normal,
            });
        }
    }
    (least, place)
}

/// Bounds the coordinates that enter the points of a link.
pub(super) fn largest_coordinate_of(at: &SpaceState, link: usize) -> f64 {
    let body = at.space.body(link).map_or(0.0, |body| {
        body.radius_from_origin() + body.deviation() / DISTANCE_ERROR
    });
    at.poses[link].translation.norm() + body
}

/// How far what a link's body stands for may be from it.
pub(super) fn stated_deviation_of(at: &SpaceState, link: usize) -> f64 {
    let body = at.space.body(link);
    body.map_or(0.0, |body| body.stated_deviation())
}
