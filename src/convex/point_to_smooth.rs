//! The distance of a point from a cylinder or a cone, in closed form: both are solids of revolution.

use super::closest::Closest;
use super::core::Core;
use crate::pose::{Vec3, turned};
use crate::primitive::{Feature, SmoothKind};

/// The closest points of a point and a cylinder or cone; `None` if they are at most `least` apart, or for other cores.
pub fn point_to_smooth(point: &Vec3, core: &Core, least: f64) -> Option<Closest> {
    let smooth = core.smooth()?;
    let way = way_from_smooth(&smooth.seen(point), smooth.kind)?;
    let distance = way.norm();
    (distance > least).then(|| Closest {
        distance,
        ..Closest::between(
            [*point, point - turned(&smooth.axes, &way)],
            [Feature::vertex(0), Feature::surface()],
        )
    })
}

/// The way from the nearest point of a cylinder or cone to another point, both in the set's own frame; `None` for a point in a cone, and for
/// other sets.
#[inline(always)]
pub fn way_from_smooth(local: &Vec3, kind: &SmoothKind) -> Option<Vec3> {
    Some(local - nearest_on_smooth(local, kind)?)
}

/// That nearest point: of a cylinder the point itself where it is inside.
#[inline(always)]
pub fn nearest_on_smooth(local: &Vec3, kind: &SmoothKind) -> Option<Vec3> {
    let away = (local.x * local.x + local.y * local.y).sqrt();
    let (away_there, along_there) = match *kind {
        SmoothKind::Cylinder {
            radius,
            half_length,
        } => (away.min(radius), local.z.clamp(-half_length, half_length)),
        SmoothKind::Cone { radius, height } => on_cone(away, local.z, radius, height)?,
        SmoothKind::Ellipsoid { .. } | SmoothKind::Function(_) => return None,
    };
    let part = if away > away_there {
        away_there / away
    } else {
        1.0
    };
    Some(Vec3::new(local.x * part, local.y * part, along_there))
}

/// The point of a cone's profile nearest to a point outside, as distance from the axis and height; `None` for a point inside.
#[inline(always)]
fn on_cone(away: f64, along: f64, radius: f64, height: f64) -> Option<(f64, f64)> {
    let half = 0.5 * height;
    if along <= -half && away <= radius {
        return Some((away, -half));
    }
    // From the rim to the apex.
    let (from_rim, above_rim) = (away - radius, along + half);
    let outside = from_rim * height + above_rim * radius;
    if outside <= 0.0 && along > -half {
        return None;
    }
    let part = (above_rim * height - from_rim * radius) / (radius * radius + height * height);
    let part = part.clamp(0.0, 1.0);
    Some((radius * (1.0 - part), part * height - half))
}
