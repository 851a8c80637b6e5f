//! A body that touches another, and what must hold there.

use cstk::cobject::{CObject, Class};
use cstk::convex::ContactMode;
use cstk::pose::Vec3;
use cstk::query::{Configuration, QueryContext};

use super::differences::{distance, moved, rows};
use super::oracle::gap_along;

/// One free body touching one object at `q`.
pub struct Touch {
    pub cobject: CObject,
    pub q: Vec<f64>,
    pub r: Vec<Vec3>,
    pub s: Vec<Vec3>,
    /// The point of contact and the normal from s to r, by construction.
    pub point: Vec3,
    pub normal: Vec3,
    pub mode: ContactMode,
}

/// At exact contact: the answers of the one contact, its gradient's closed form, and the difference on the way out. A
/// step of 1e-7 keeps both its curvature and the distance's rounding under 1e-6.
pub fn check_touch(touch: &Touch, closed: &[f64]) {
    let (cobject, q) = (&touch.cobject, &touch.q);
    let mut context = QueryContext::new();
    let at = Configuration::Coordinates(q);
    let found = context.distance(cobject, at, f64::INFINITY).unwrap();
    assert_eq!((found.distance, found.lower), (0.0, 0.0));
    assert_eq!(context.classify(cobject, at).unwrap(), Class::Inside);
    let list = context.gradients(cobject, q, 0.0, 10).unwrap();
    assert_eq!(list.witnesses.len(), 1);
    assert!(!list.witnesses[0].overlapping, "{:?} overlaps", touch.mode);
    assert_eq!(
        list.contacts.len(),
        1,
        "{:?}: {:?}",
        touch.mode,
        list.contacts
    );
    let contact = &list.contacts[0];
    assert_eq!(contact.mode, touch.mode, "{:?}", contact.features);
    assert!((contact.normal.norm() - 1.0).abs() <= 1e-14);
    assert!(
        (contact.normal - touch.normal).amax() <= 1e-9,
        "{} {}",
        contact.normal,
        touch.normal
    );
    for point in contact.points {
        assert!((point - touch.point).norm() <= 1e-13);
    }
    let step = 1e-7;
    for (i, (gradient, want)) in rows(&list)[0].iter().zip(closed).enumerate() {
        assert!(
            (gradient - want).abs() <= 1e-9,
            "{:?} {i}: {gradient} {want}",
            touch.mode
        );
        let (out, into) = (step * gradient.signum(), -step * gradient.signum());
        let quotient = distance(cobject, &moved(q, i, out)) / step;
        assert!(
            (quotient - gradient.abs()).abs() <= 1e-6,
            "{i}: {quotient} {gradient}"
        );
        // The other way the solids meet, but for the curvature of the motion.
        assert!(distance(cobject, &moved(q, i, into)) <= 1e-6 * step);
    }
    // The normal separates the two sets.
    assert!(gap_along(&touch.r, &touch.s, &contact.normal) >= -1e-13);
}

/// The lowest of some points along `n`, if the next one lies clearly higher.
pub fn lowest(points: &[Vec3], n: &Vec3) -> Option<usize> {
    let height = |i: &usize| n.dot(&points[*i]);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|i, j| height(i).total_cmp(&height(j)));
    (height(&order[1]) - height(&order[0]) > 0.05).then_some(order[0])
}
