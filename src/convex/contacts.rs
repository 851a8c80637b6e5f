//! The contacts of two primitives, by the form of these.

use super::contact::Contact;
use super::core::{is_curved, is_smooth};
use super::curved_contacts::{curved_contacts, first_curved_contact, first_of_rounded_contacts};
use super::distance::PrimitiveDistance;
use super::placed::{PlacedPrimitive, Precision};
use super::polytope_contacts::{
    first_of_polytope_contacts, first_polytope_contact, polytope_contacts,
};
use crate::tolerance;

/// The contacts of the pair (r, s) with the given closest points; the contact at these points comes first. Empty when the
/// interiors overlap deeper than [`tolerance::JUST_INSIDE`] L: containment has no contact.
///
/// Curved primitives have the contacts of their cores. Smooth cores have a single contact even where they touch along a line or
/// a face.
pub fn contacts(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: &PrimitiveDistance,
    precision: &Precision,
) -> Vec<Contact> {
    if is_curved(r, s) {
        curved_contacts(r, s, measured, precision)
    } else {
        polytope_contacts(r, s, &measured.closest, precision)
    }
}

/// The first contact that [`contacts`] returns.
#[inline(always)]
pub fn first_contact(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: &PrimitiveDistance,
    precision: &Precision,
) -> Option<Contact> {
    let first = if is_smooth(r, s) {
        // The only one.
        return first_curved_contact(r, s, measured, precision);
    } else if is_curved(r, s) {
        first_curved_contact(r, s, measured, precision)
    } else {
        first_polytope_contact(r, s, &measured.closest, precision)
    };
    if first.is_some() || measured.closest.depth > tolerance::JUST_INSIDE * precision.size {
        return first;
    }
    first_of_all(r, s, *measured, precision)
}

#[inline(never)]
fn first_of_all(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    measured: PrimitiveDistance,
    precision: &Precision,
) -> Option<Contact> {
    if is_curved(r, s) {
        first_of_rounded_contacts(r, s, &measured, precision)
    } else {
        first_of_polytope_contacts(r, s, &measured.closest, precision)
    }
}
