//! The numeric tolerances, each with its derivation. All are relative to a length that the caller states.

/// Unit round-off of f64 arithmetic, doubled: the spacing of numbers at 1.
pub const EPSILON: f64 = f64::EPSILON;

/// The rounding error of a primitive pair's distance, times L (the pair's largest coordinate); pairs at smaller distances
/// touch.
///
/// A closed-form distance is a difference of points whose coordinates carry the rounding of one rigid transform (three products
/// and three sums, each within EPSILON/2 of at most 3 L) and of one interpolation along a feature; that bounds the error by
/// about 12 EPSILON L. The rest is [`CERTIFIED_GAP`]. Primitives whose vertices are off their faces' planes add that deviation
/// (see `Convex::deviation`). A smaller gap cannot be distinguished from contact.
pub const DISTANCE_ERROR: f64 = 32.0 * EPSILON;

/// A distance of two solids is accepted when the lower bound of its certificate (a supporting direction) is this close, times
/// L, to the distance of its two points; otherwise all features are searched.
pub const CERTIFIED_GAP: f64 = 16.0 * EPSILON;

/// The rounding error of the gap of two support points along a unit direction, times L. A point is transformed into the pair's
/// frame (within 3 EPSILON L), and so is the direction (2 EPSILON); the product of the difference with the direction adds 4
/// EPSILON L: two points and the product are within 14 EPSILON L. A smaller gap proves nothing.
pub const SUPPORT_ERROR: f64 = 16.0 * EPSILON;

/// The error of distances of a smooth primitive, times its diameter. The iteration goes on until its bounds are
/// [`CERTIFIED_GAP`] L apart. Of 1.26e6 random pairs of cylinders, cones, ellipsoids and polytopes, with ratios of axes up to
/// 1e4, 1 in 4000 stopped with bounds farther apart than 2e-14 L, none farther than 2.2e-12 L: on ruled surfaces, where the
/// corners of the last simplex are as close together as rounding allows. A pair whose bounds stay farther apart than this
/// reports it in its answer.
pub const SMOOTH_ERROR: f64 = 1e-11;

/// The rounding error of a wrapper's bound, times L: one support evaluation along a unit vector.
pub const BOUND_ERROR: f64 = 64.0 * EPSILON;

/// Features of a contact are parallel when their supporting vertices are level to within this times L. It is ten times the
/// promised accuracy of a distance: a smaller tilt does not show in a distance.
pub const PARALLEL: f64 = 1e-11;

/// Two primitives whose interiors overlap by less than this times L still have a contact with a normal.
pub const TOUCH_DEPTH: f64 = 1e-10;

/// Two primitives that overlap by less than this times L ("just inside") still have contacts, with negative clearance. Steps of
/// planners and simulations sometimes end this deep; deeper, the shortest way out says little about the nearest features.
pub const JUST_INSIDE: f64 = 1e-6;

/// A polygon's vertices may be off its plane by this times its diameter, plus the rounding of their own coordinates.
pub const PLANAR: f64 = 1e-12;

/// An input point may lie outside its computed hull by this times the hull's diameter: a tenth of the promised 1e-12 L.
pub const HULL_EXCESS: f64 = 1e-13;

/// A rotation matrix may be off orthonormal by this before it is refused; it is replaced by the nearest rotation.
pub const ROTATION: f64 = 1e-6;

/// The largest coordinate accepted. Its sixth power is finite, so no product in the library overflows.
pub const LARGEST_COORDINATE: f64 = 1e50;

/// The smallest diameter accepted for a polygon. Its sixth power is a normal number.
pub const SMALLEST_DIAMETER: f64 = 1e-50;

/// The rounding error of a point's distance from a wrapper, times the largest coordinate: a rotation into a box's frame and
/// back, or a distance of two points, each within a few EPSILON.
pub const WRAPPER_ERROR: f64 = 32.0 * EPSILON;

/// The slack of the tests whether a foot is inside a polygon and whether an edge pierces it, times L (times L^2 for areas):
/// more than the rounding of a coordinate, so that none is missed.
pub const INSIDE_DOUBT: f64 = 256.0 * EPSILON;
