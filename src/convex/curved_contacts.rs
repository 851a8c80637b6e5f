//! Contacts of curved primitives: those of their cores, moved outwards by the radii.

use super::closest::Closest;
use super::contact::{Contact, deepest_first, mode_of};
use super::core::{Core, is_smooth};
use super::distance::PrimitiveDistance;
use super::placed::{PlacedPrimitive, Precision, gap_of_primitives};
use super::polytope_contacts::{
    first_of_polytope_contacts, first_polytope_contact, polytope_contacts,
};
use super::smooth_distance::holding_feature;
use super::smooth_touch::smooth_touch;
use crate::gjk::Support;
use crate::pose::Vec3;
use crate::primitive::FeatureKind;
use crate::tolerance;

/// The contacts of a pair of which at least one is curved. They are exact as long as the cores are apart, however deep the
/// rounded sets overlap.
pub fn curved_contacts(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: &PrimitiveDistance,
    precision: &Precision,
) -> Vec<Contact> {
    let mut found: Vec<Contact> = if is_smooth(r, s) {
        let contact = smooth_contact(r, s, measured, precision);
        contact.into_iter().collect()
    } else {
        polytope_contacts(r, s, &touching(&measured.cores, precision), precision)
    };
    for contact in &mut found {
        grow(contact, [r, s], precision);
    }
    deepest_first(&mut found, precision);
    found
}

/// The first of these contacts, if the cores are apart: it is then found without the others.
#[inline(always)]
pub fn first_curved_contact(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: &PrimitiveDistance,
    precision: &Precision,
) -> Option<Contact> {
    let mut contact = if is_smooth(r, s) {
        smooth_contact(r, s, measured, precision)?
    } else {
        first_polytope_contact(r, s, &touching(&measured.cores, precision), precision)?
    };
    grow(&mut contact, [r, s], precision);
    Some(contact)
}

/// The first of these contacts of rounded polytopes.
pub fn first_of_rounded_contacts(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: &PrimitiveDistance,
    precision: &Precision,
) -> Option<Contact> {
    let cores = touching(&measured.cores, precision);
    let mut contact = first_of_polytope_contacts(r, s, &cores, precision)?;
    // Of cores that are apart the first need not be the nearest along the normal, and of sets that overlap it would be less deep.
    if gap_of_primitives(r, s, &contact.normal) < contact.gap - 0.5 * precision.error {
        let all = curved_contacts(r, s, measured, precision);
        return all.into_iter().next();
    }
    grow(&mut contact, [r, s], precision);
    Some(contact)
}

/// Sets the distance of the cores to 0 where it is at most the pair's error.
#[inline(always)]
fn touching(cores: &Closest, precision: &Precision) -> Closest {
    let distance = if cores.distance <= precision.error {
        0.0
    } else {
        cores.distance
    };
    Closest { distance, ..*cores }
}

/// Moves a contact of the cores outwards by the radii.
#[inline(always)]
fn grow(contact: &mut Contact, sides: [&PlacedPrimitive; 2], precision: &Precision) {
    let [radius_r, radius_s] = sides.map(|placed| placed.shape.radius());
    let gap = contact.gap - radius_r - radius_s;
    contact.gap = if gap.abs() > precision.error {
        gap
    } else {
        0.0
    };
    contact.distance = contact.gap.max(0.0);
    contact.points[0] -= contact.normal * radius_r;
    contact.points[1] += contact.normal * radius_s;
}

/// The contact of two cores of which at least one is smooth; a smooth surface counts as a point.
fn smooth_contact(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: &PrimitiveDistance,
    precision: &Precision,
) -> Option<Contact> {
    let (closest, direction) = (measured.cores, measured.direction);
    if closest.depth > tolerance::JUST_INSIDE * precision.size {
        return None;
    }
    let least = tolerance::MIN_SMOOTH_NORMAL_DISTANCE * precision.size;
    let is_apart = closest.distance > least && direction != Vec3::zeros();
    let mut features = closest.features;
    let (normal, gap, points) = if is_apart {
        (direction, closest.distance, closest.points)
    } else if are_dwarfed(r, s) {
        return None;
    } else {
        let touch = smooth_touch(r, s, &closest, direction, precision)?;
        // The points are others than the closest ones.
        for (side, placed) in [r, s].into_iter().enumerate() {
            if placed.shape.smooth().is_none() {
                let slack = tolerance::ON_FEATURE * precision.size;
                let point = &touch.points[side];
                let names = touch.names.map(|names| names[side]);
                let known = holding_feature(placed, names, point, slack);
                let here = placed.end_of_face(known, point, slack).unwrap_or(known);
                if here.kind != FeatureKind::Interior {
                    features[side] = here;
                }
            }
        }
        (touch.normal, touch.gap, touch.points)
    };
    Some(Contact {
        points,
        normal,
        distance: gap.max(0.0),
        gap,
        mode: mode_of(features)?,
        features,
    })
}

/// Cores that touch have no contact where the radii are more than this many times larger than they. All lengths below which cores touch
/// are parts of the pair's size, radii included, and the steps to their normal shift them by 1e-4 of it: a tenth of the cores
/// here. A larger value gives contacts whose normals are off, of a ball a million times as large as what is in its centre by 30
/// degrees; a smaller one leaves out some that are right.
const MAX_RADII: f64 = 1e3;

/// Whether the radii of two primitives are so much larger than their cores.
#[cold]
fn are_dwarfed(r: &PlacedPrimitive, s: &PlacedPrimitive) -> bool {
    let radii = r.shape.radius() + s.shape.radius();
    if radii == 0.0 {
        return false;
    }
    let widths = [r, s].map(|placed| {
        let core = Core::of(placed);
        let along = |axis: Vec3| (core.support(&axis) - core.support(&-axis)).dot(&axis);
        along(Vec3::x()).max(along(Vec3::y())).max(along(Vec3::z()))
    });
    radii > MAX_RADII * widths[0].max(widths[1])
}
