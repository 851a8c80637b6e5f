//! The numeric tolerances that several modules share: bounds of rounding errors, each with its derivation, and choices, each with its
//! reason. All are relative to a length that the caller states. What one algorithm alone needs stands beside it.

/// Unit round-off of f64 arithmetic, doubled: the spacing of numbers at 1.
pub const EPSILON: f64 = f64::EPSILON;

/// The rounding error of a primitive pair's distance, times L (the pair's largest coordinate); pairs at smaller distances
/// touch.
///
/// In EPSILON L: the given rotations may be off the nearest ones by 4 each, and the inverse of one is its transpose; that is 12, with
/// the lengths that A's frame distorts. The relative pose is off by 4, a product of two matrices and a turned difference. A distance that
/// a certificate proves is at most [`CERTIFIED_GAP`], 16, above its bound, and the bound is off by 9: B's support point is transformed
/// (3), so is the direction (2), and the product of the difference with the direction is rounded (4). Each support point is chosen by
/// products that are rounded: another may be farther by 3. That is 47 together. A closed-form distance is a difference of points that
/// carry one transform and one interpolation along a feature, 12 in place of the last 31. Primitives whose vertices are off their
/// faces' planes add that deviation (see `Convex::deviation`). A smaller gap cannot be distinguished from contact.
pub const DISTANCE_ERROR: f64 = 48.0 * EPSILON;

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

/// More than the rounding of sums and products of rates, times and lengths, none of them negative: each of n terms adds EPSILON, and
/// nothing sums 10^6.
pub const SUM_SLACK: f64 = 1.0 + 1e-9;

/// The rounding error of a wrapper's bound, times L: the gap of two boxes along a unit vector. The support of a box is the product of its
/// centre with the vector, within 6 EPSILON L with the centre's transform, and three half axes times products within 3 EPSILON: 15
/// EPSILON L for each of two, and the vector is off by 2 EPSILON as either sees it: 34 EPSILON L.
pub const BOUND_ERROR: f64 = 64.0 * EPSILON;

/// Features of a contact are parallel when their supporting vertices are level to within this times L. It is ten times the
/// promised accuracy of a distance: a smaller tilt does not show in a distance.
pub const PARALLEL: f64 = 1e-11;

/// Two primitives whose interiors overlap by less than this times L still have a contact with a normal.
pub const TOUCH_DEPTH: f64 = 1e-10;

/// Two primitives that overlap by less than this times L ("just inside") still have contacts, with negative clearance. Steps of
/// planners and simulations sometimes end this deep; deeper, the shortest way out says little about the nearest features.
pub const JUST_INSIDE: f64 = 1e-6;

/// Closest points nearer to each other than this times L do not determine a normal: their rounding, a few EPSILON L, turns the
/// direction between them by 1e-4 and more. Then features do.
pub const MIN_NORMAL_DISTANCE: f64 = 1e-12;

/// The normal between two closest points is taken as it is where its error is below this, a tenth of [`PARALLEL`]; else the
/// normals of the features around the points are compared with it.
pub const NORMAL_ERROR: f64 = 1e-12;

/// Closest points of smooth cores nearer to each other than this times L do not determine a normal. At this distance the
/// direction that certifies it is within sqrt(2 CERTIFIED_GAP / 1e-6) = 8e-5 of the normal.
pub const MIN_SMOOTH_NORMAL_DISTANCE: f64 = 1e-6;

/// Axes of boxes and cylinders are tried as parallel where the sine of their angle is at most this: a few times what rounding leaves of it.
pub const PARALLEL_AXES: f64 = 64.0 * EPSILON;

/// Two directions of edges whose cross product is shorter than this are parallel: the product's rounding of some EPSILON would
/// turn a normal by more than 1e-10.
pub const PARALLEL_EDGES: f64 = 1e-6;

/// A normal replaces another at touch only where the sets' gap along it is larger by this times L. That is 28 times
/// [`SUPPORT_ERROR`], so that rounding does not choose among normals that are equal.
pub const GAP_TIE: f64 = 1e-13;

/// Features within this times L of a touching pair's closest points offer their normals. A larger value offers normals of
/// features that do not touch, a smaller one misses features where the points are inaccurate.
pub const NEAR_FEATURE: f64 = 1e-8;

/// A point nearer than this times L to a vertex, edge or face counts as lying on it, where one of the sets is smooth: along a
/// surface, closest points are known only to about the square root of the distance's error, sqrt(CERTIFIED_GAP) = 6e-8.
pub const ON_FEATURE: f64 = 1e-7;

/// Contacts whose points on both primitives are within this times L of each other count as one. A larger value drops contacts
/// of small features, a smaller one lists contacts twice that differ by rounding alone.
pub const SAME_CONTACT: f64 = 1e-9;

/// Features whose vertices are within this times L of the supporting plane along GJK's direction are compared first. The
/// direction is more accurate than that unless the sets nearly touch; then the certificate fails and all features are compared.
pub const NEAR_SUPPORT: f64 = 1e-6;

/// A vertex may lie beyond a supporting plane by this times L. For the penetration, a larger value tries more pairs of edges,
/// none of which can give too small a depth; a smaller one could miss the pair that does support.
pub const SUPPORT_SLACK: f64 = 1e-9;

/// The normal of touching smooth cores is found when a step turns it by less than this: some thousand times EPSILON, above the
/// rounding of a unit vector.
pub const NORMAL_STEP: f64 = 1e-12;

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
