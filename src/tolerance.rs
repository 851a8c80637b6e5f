//! The numeric tolerances, each with its derivation. All are relative to a length that the caller states.

/// Unit round-off of f64 arithmetic, doubled: the spacing of numbers at 1.
pub const EPSILON: f64 = f64::EPSILON;

/// Two closest points nearer than this times L (the pair's largest coordinate) touch.
///
/// A closed-form distance is a difference of points whose coordinates carry the rounding of one rigid transform
/// (three products and three sums, each within EPSILON/2 of at most 3 L) and of one interpolation along a feature; that
/// bounds the error by about 12 EPSILON L. Below it a gap cannot be told from contact.
pub const TOUCH: f64 = 16.0 * EPSILON;

/// Slack, times L, taken off every wrapper bound, so that a pair pruned by it could not have changed the computed
/// minimum even in its last bit: twice the error of a leaf distance and that of the bound itself.
pub const BOUND_SLACK: f64 = 64.0 * EPSILON;

/// A distance of two solids is accepted when its certificate (a supporting direction) comes this close, times L, to the
/// distance of its two points; otherwise all features are searched. Five times under the promised 1e-12 L.
pub const CERTIFIED_GAP: f64 = 2e-13;

/// Features of a contact are parallel when their supporting vertices are level to within this times L. Ten times the
/// promised accuracy of a distance: a tilt below it cannot be seen in a distance.
pub const PARALLEL: f64 = 1e-11;

/// Two primitives whose interiors overlap by less than this times L still have a contact with a normal.
pub const TOUCH_DEPTH: f64 = 1e-10;

/// A polygon's vertices may leave its plane by this times its diameter, plus the rounding of their own coordinates.
pub const PLANAR: f64 = 1e-12;

/// A vertex of a hull may lie outside one of its faces by this times the hull's diameter; the distance error that
/// follows is a tenth of the promised 1e-12 L.
pub const HULL_EXCESS: f64 = 1e-13;

/// A rotation matrix may be off orthonormal by this before it is refused; it is replaced by the nearest rotation.
pub const ROTATION: f64 = 1e-6;

/// The largest coordinate accepted. Its sixth power is finite, so no product in the library overflows.
pub const LARGEST_COORDINATE: f64 = 1e50;

/// The smallest diameter accepted for a polygon. Its sixth power is a normal number.
pub const SMALLEST_DIAMETER: f64 = 1e-50;
