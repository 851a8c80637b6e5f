//! The distance of a point or a segment from a box, in closed form.

use super::closest::Closest;
use super::placed::PlacedPrimitive;
use crate::pose::{Vec3, turned, turned_back};
use crate::primitive::{Cuboid, Feature};

/// The closest points of a hull of one or two vertices and a box. Where they meet, a common point, and the depth of the box there. Of a
/// segment along a face they are an end of what is over the face: on features that have a contact mode. A point within `slack` of an edge of
/// the box is on it then.
pub fn segment_to_cuboid(
    segment: &PlacedPrimitive,
    other: &PlacedPrimitive,
    cuboid: &Cuboid,
    slack: f64,
) -> Closest {
    let start = segment.vertex(0);
    let from = cuboid.seen(&other.seen(&start));
    let meeting = |point: Vec3, seen: &Vec3| Closest {
        // A ball around the point is in the box: no shorter way parts the two.
        depth: (cuboid.half - seen.abs()).min(),
        ..Closest::meeting_at(point, [Feature::interior(); 2])
    };
    if segment.vertex_count() == 1 {
        let apart = beside_cuboid(&start, Feature::vertex(0), &from, other, cuboid, 0.0);
        return apart.unwrap_or_else(|| meeting(start, &from));
    }
    let end = segment.vertex(1);
    let along = other.turned_back(&(end - start));
    let along = turned_back(&cuboid.axes, &along);
    let t = nearest_parameter(&from, &along, &cuboid.half);
    let (feature, slack) = match t {
        0.0 => (Feature::vertex(0), 0.0),
        1.0 => (Feature::vertex(1), 0.0),
        _ => (Feature::edge(0), slack),
    };
    let point = if t == 1.0 {
        end
    } else {
        start + (end - start) * t
    };
    let seen = from + along * t;
    let apart = beside_cuboid(&point, feature, &seen, other, cuboid, slack);
    apart.unwrap_or_else(|| meeting(point, &seen))
}

/// The closest points of a box and the point of a set that is nearest to it, which is on this feature of the set; `seen` is where the
/// box's frame has it. `None` where they meet.
#[inline(always)]
fn beside_cuboid(
    point: &Vec3,
    feature: Feature,
    seen: &Vec3,
    other: &PlacedPrimitive,
    cuboid: &Cuboid,
    slack: f64,
) -> Option<Closest> {
    let across = way_from_cuboid(seen, cuboid)?;
    let on_other = point - other.turned(&turned(&cuboid.axes, &across));
    let features = [feature, cuboid.feature_at(seen, slack)];
    Some(Closest {
        distance: across.norm(),
        ..Closest::between([*point, on_other], features)
    })
}

/// The way from the nearest point of a box to another point, both in the box's frame; `None` for a point of the box.
#[inline(always)]
pub fn way_from_cuboid(seen: &Vec3, cuboid: &Cuboid) -> Option<Vec3> {
    let nearest = seen.zip_map(&cuboid.half, |x, half| x.clamp(-half, half));
    let way = seen - nearest;
    (way != Vec3::zeros()).then_some(way)
}

/// The t in [0, 1] at which the segment start + t along is nearest to the box of these half extents around the origin: where they
/// meet, the middle of what is in the box; where it is along a face, the start of what is over it.
///
/// The squared distance is convex in t. Its derivative is increasing, and linear between the crossings of the segment's line
/// with the planes of the box's faces. It is evaluated at all crossings at once, and solved in the interval where it is 0.
#[inline(always)]
pub fn nearest_parameter(start: &Vec3, along: &Vec3, half: &Vec3) -> f64 {
    let crossing = |k: usize, bound: f64| {
        let t = (bound - start[k]) / along[k];
        // A segment parallel to the faces has no crossing.
        if along[k] == 0.0 {
            0.0
        } else {
            t.clamp(0.0, 1.0)
        }
    };
    let places = [
        0.0,
        1.0,
        crossing(0, -half[0]),
        crossing(0, half[0]),
        crossing(1, -half[1]),
        crossing(1, half[1]),
        crossing(2, -half[2]),
        crossing(2, half[2]),
    ];
    let mut rises = [0.0; 8];
    for k in 0..3 {
        for (rise, t) in rises.iter_mut().zip(&places) {
            let x = start[k] + along[k] * t;
            *rise += (x - x.clamp(-half[k], half[k])) * along[k];
        }
    }
    // The last crossing where the distance still falls, and the first where it rises.
    let (mut low, mut high) = (0.0f64, 1.0f64);
    for (rise, t) in rises.iter().zip(places) {
        low = if *rise <= 0.0 { low.max(t) } else { low };
        high = if *rise >= 0.0 { high.min(t) } else { high };
    }
    let high = high.max(low);
    let middle = 0.5 * (low + high);
    let (mut part, mut whole, mut apart) = (0.0, 0.0, false);
    for k in 0..3 {
        let x = start[k] + along[k] * middle;
        let bound = x.clamp(-half[k], half[k]);
        if x != bound {
            apart = true;
            part += (bound - start[k]) * along[k];
            whole += along[k] * along[k];
        }
    }
    if whole > 0.0 {
        (part / whole).clamp(low, high)
    } else if apart {
        low
    } else {
        middle
    }
}
