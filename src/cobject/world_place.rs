//! Sets of the world that links must keep out of: beyond the world box, and floors.

use super::SpaceState;
use crate::pose::Vec3;
use crate::tolerance::DISTANCE_ERROR;

/// Where in the world a set is near: a point of a link (its origin, for the world box), and the direction out of the set.
#[derive(Clone, Copy, Debug)]
pub struct WorldPlace {
    pub link: usize,
    /// Of the link's body, if the point is one of it.
    pub primitive: Option<u32>,
    pub point: Vec3,
    pub normal: Vec3,
}

/// How far within the world box the links' origins are: the least of all, negative where one is outside, and there minus the
/// most that one is. With the place that decides.
pub(super) fn beyond_world(at: &SpaceState, links: &[usize]) -> (f64, Option<WorldPlace>) {
    let world = at.space.world();
    let mut least = f64::INFINITY;
    let mut place = None;
    for &link in links {
        let point = at.poses[link].translation;
        let mut outside = Vec3::zeros();
        let mut within = (f64::INFINITY, Vec3::zeros());
        // The plane has no height.
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

/// How far over a floor the lowest point of some links is, and that point.
pub(super) fn over_floor(
    at: &SpaceState,
    links: &[usize],
    normal: &Vec3,
    offset: f64,
) -> (f64, Option<WorldPlace>) {
    let mut least = f64::INFINITY;
    let mut place = None;
    for &link in links {
        let Some(body) = at.space.link(link).and_then(|link| link.body.as_deref()) else {
            continue;
        };
        let pose = &at.poses[link];
        let lowest = body.farthest(&-pose.rotation.tr_mul(normal));
        let point = pose.transform_point(&(lowest.point + body.center()));
        let over = normal.dot(&point) - offset;
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

/// No coordinate that goes into the points of a link is larger.
pub(super) fn largest_coordinate_of(at: &SpaceState, link: usize) -> f64 {
    let body = at.space.link(link).and_then(|link| link.body.as_deref());
    let body = body.map_or(0.0, |body| {
        body.radius_from_origin() + body.deviation() / DISTANCE_ERROR
    });
    at.poses[link].translation.norm() + body
}
