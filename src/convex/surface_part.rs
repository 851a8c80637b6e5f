//! The parts of convex surfaces that can hold closest points: vertices, edges, rims, rulings, ellipsoids, faces.

use super::core::Core;
use super::polytope_distance::cuboid;
use super::segment::Segment;
use crate::pose::{Mat3, Vec3, turned, turned_back};
use crate::primitive::{Feature, FeatureKind, HIGH_END, LOW_END, SmoothKind, plane_axes};

/// A part of a surface on which the support point stays while the direction turns a little; in the common frame.
#[derive(Clone, Copy, Debug)]
pub enum SurfacePart {
    Vertex(Vec3),
    Edge {
        middle: Vec3,
        along: Vec3,
        half: f64,
    },
    Facet([Vec3; 3]),
    /// A face of a box: a corner, and the two edges from it.
    Rectangle {
        corner: Vec3,
        sides: [Vec3; 2],
    },
    /// The boundary circle of a disc that is a face of the set; the axis is the disc's outward normal.
    Rim {
        center: Vec3,
        axis: Vec3,
        radius: f64,
    },
    /// The rulings of a cylinder.
    Tube {
        center: Vec3,
        axis: Vec3,
        radius: f64,
        half: f64,
    },
    /// The rulings of a cone whose axis goes from the base to the apex.
    Cone {
        center: Vec3,
        axis: Vec3,
        radius: f64,
        height: f64,
    },
    Ellipsoid {
        center: Vec3,
        axes: Mat3,
        squares: Vec3,
    },
}

/// A support point of a part, and what its derivative is computed from.
pub struct PartSupport {
    /// Of a line of such points, its middle.
    pub point: Vec3,
    /// Of a circle, the unit vector from its centre; of an ellipsoid, the vector from its centre to the point along its axes.
    outwards: Vec3,
    /// Of a circle, the length of the direction's component in its plane; of an ellipsoid, its extent along the direction.
    length: f64,
}

impl SurfacePart {
    /// The part of a core between the extreme points of these names; `None` for a support function of the caller's.
    #[inline(always)]
    pub fn between(core: &Core, names: &[u32]) -> Option<Self> {
        let Some(smooth) = core.smooth() else {
            return Self::between_vertices(core, names);
        };
        let (center, axis) = (smooth.center, Vec3::from(smooth.axes.column(2)));
        let all_are = |name: u32| names.iter().all(|other| *other == name);
        Some(match *smooth.kind {
            SmoothKind::Cylinder {
                radius,
                half_length,
            } => {
                let rim = |axis: Vec3| Self::Rim {
                    center: center + axis * half_length,
                    axis,
                    radius,
                };
                if all_are(HIGH_END) {
                    rim(axis)
                } else if all_are(LOW_END) {
                    rim(-axis)
                } else {
                    Self::Tube {
                        center,
                        axis,
                        radius,
                        half: half_length,
                    }
                }
            }
            SmoothKind::Cone { radius, height } => {
                if all_are(HIGH_END) {
                    Self::Vertex(center + axis * (0.5 * height))
                } else if all_are(LOW_END) {
                    Self::Rim {
                        center: center - axis * (0.5 * height),
                        axis: -axis,
                        radius,
                    }
                } else {
                    Self::Cone {
                        center,
                        axis,
                        radius,
                        height,
                    }
                }
            }
            SmoothKind::Ellipsoid { semi_axes } => Self::Ellipsoid {
                center,
                axes: smooth.axes,
                squares: semi_axes.component_mul(&semi_axes),
            },
            SmoothKind::Function(_) => return None,
        })
    }

    /// The same of a polytope: of a box a whole face, of others the triangle between three vertices.
    #[inline(always)]
    fn between_vertices(core: &Core, names: &[u32]) -> Option<Self> {
        if let ([_, _, ..], Some(cuboid)) = (names, cuboid(core.placed()))
            && let Some(Feature {
                kind: FeatureKind::Face,
                index,
            }) = cuboid.feature_of(names)
        {
            let ring = &core.placed().shape.faces[index as usize].vertices;
            let [corner, next, last] = [0, 1, 3].map(|i| core.vertex(ring[i]));
            return Some(Self::Rectangle {
                corner,
                sides: [next - corner, last - corner],
            });
        }
        Some(match *names {
            [a] => Self::Vertex(core.vertex(a)),
            [a, b] => {
                let (a, b) = (core.vertex(a), core.vertex(b));
                let between = b - a;
                let length = between.norm();
                Self::Edge {
                    middle: (a + b) * 0.5,
                    along: between / length,
                    half: 0.5 * length,
                }
            }
            [a, b, c] => Self::Facet([a, b, c].map(|i| core.vertex(i))),
            _ => return None,
        })
    }

    /// Whether closest points on the part are not found by turning a direction: it has but one.
    #[inline(always)]
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Facet(_) | Self::Rectangle { .. })
    }

    /// The support point along a direction.
    #[inline(always)]
    pub fn support(&self, direction: &Vec3) -> PartSupport {
        let at = |point: Vec3| PartSupport {
            point,
            outwards: Vec3::zeros(),
            length: 1.0,
        };
        let around = |center: &Vec3, axis: &Vec3, radius: f64| {
            let (outwards, length) = across(direction, axis);
            PartSupport {
                point: center + outwards * radius,
                outwards,
                length,
            }
        };
        match self {
            Self::Vertex(point) => at(*point),
            Self::Edge { middle, .. } => at(*middle),
            Self::Facet([a, ..]) => at(*a),
            Self::Rectangle { corner, .. } => at(*corner),
            Self::Rim {
                center,
                axis,
                radius,
            }
            | Self::Tube {
                center,
                axis,
                radius,
                ..
            } => around(center, axis, *radius),
            Self::Cone {
                center,
                axis,
                radius,
                ..
            } => around(center, axis, 0.5 * radius),
            Self::Ellipsoid {
                center,
                axes,
                squares,
            } => {
                let local = turned_back(axes, direction);
                let stretched = squares.component_mul(&local);
                let length = local.dot(&stretched).sqrt();
                let outwards = stretched / length;
                PartSupport {
                    point: center + turned(axes, &outwards),
                    outwards,
                    length,
                }
            }
        }
    }

    /// The line of support points along a direction: its unit direction and half its length.
    #[inline(always)]
    pub fn line(&self, direction: &Vec3) -> Option<(Vec3, f64)> {
        match *self {
            Self::Edge { along, half, .. } => Some((along, half)),
            Self::Tube { axis, half, .. } => Some((axis, half)),
            Self::Cone {
                axis,
                radius,
                height,
                ..
            } => {
                let length = radius.hypot(height);
                let outwards = across(direction, &axis).0;
                Some(((outwards * radius - axis * height) / length, 0.5 * length))
            }
            _ => None,
        }
    }

    /// The directions along which such a line supports: all n with n . v = c, for the returned unit vector v and number c.
    #[inline(always)]
    pub fn constraint(&self) -> Option<(Vec3, f64)> {
        match *self {
            Self::Edge { along, .. } => Some((along, 0.0)),
            Self::Tube { axis, .. } => Some((axis, 0.0)),
            Self::Cone {
                axis,
                radius,
                height,
                ..
            } => Some((axis, radius / radius.hypot(height))),
            _ => None,
        }
    }

    /// The derivative of a support point as the unit direction turns by `by`; for a line, of the point at `place` along it.
    #[inline(always)]
    pub fn bend(&self, at: &PartSupport, by: &Vec3, place: f64) -> Vec3 {
        let around = |axis: &Vec3, radius: f64| {
            let tangent = axis.cross(&at.outwards);
            tangent * (radius / at.length * tangent.dot(by))
        };
        match self {
            Self::Vertex(_) | Self::Edge { .. } | Self::Facet(_) | Self::Rectangle { .. } => {
                Vec3::zeros()
            }
            Self::Rim { axis, radius, .. } | Self::Tube { axis, radius, .. } => {
                around(axis, *radius)
            }
            Self::Cone {
                axis,
                radius,
                height,
                ..
            } => {
                let there = 0.5 * radius + place * radius / radius.hypot(*height);
                around(axis, there.max(0.0))
            }
            Self::Ellipsoid { axes, squares, .. } => {
                let by = turned_back(axes, by);
                let along = at.outwards * at.outwards.dot(&by);
                turned(axes, &((squares.component_mul(&by) - along) / at.length))
            }
        }
    }

    /// The normal towards `direction` of the face that the part is, or that it bounds. For a rim, only if the disc's normal is
    /// close to `direction`.
    #[inline(always)]
    pub fn face_normal(&self, direction: &Vec3) -> Option<Vec3> {
        match self {
            Self::Facet([a, b, c]) => turned_towards(&(b - a).cross(&(c - a)), direction),
            Self::Rectangle {
                sides: [one, other],
                ..
            } => turned_towards(&one.cross(other), direction),
            Self::Rim { axis, .. } => (axis.dot(direction) > MIN_FACE_COSINE).then_some(*axis),
            _ => None,
        }
    }

    /// The foot of a point on that face, if it lies inside.
    #[inline(always)]
    pub fn foot(&self, normal: &Vec3, point: &Vec3) -> Option<Vec3> {
        match self {
            Self::Facet([a, b, c]) => {
                let up = (b - a).cross(&(c - a));
                let part = |from: &Vec3, to: &Vec3| up.dot(&(to - from).cross(&(point - from)));
                let [of_a, of_b, of_c] = [part(b, c), part(c, a), part(a, b)];
                // A combination of the corners, so that it is a point of the set even for a needle.
                let foot = (a * of_a + b * of_b + c * of_c) / (of_a + of_b + of_c);
                (of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0).then_some(foot)
            }
            Self::Rectangle { corner, sides } => {
                let [x, y] = sides.map(|side| side.dot(&(point - corner)) / side.norm_squared());
                let is_inside = (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y);
                is_inside.then(|| corner + sides[0] * x + sides[1] * y)
            }
            Self::Rim { center, radius, .. } => {
                let foot = point - normal * normal.dot(&(point - center));
                ((foot - center).norm() <= *radius).then_some(foot)
            }
            _ => None,
        }
    }

    /// The point of that face nearest to a point, both seen along the normal.
    pub fn nearest_in_face(&self, normal: &Vec3, point: &Vec3) -> Option<Vec3> {
        if let Some(foot) = self.foot(normal, point) {
            return Some(foot);
        }
        match self {
            Self::Facet([a, b, c]) => {
                let sides = [(*a, *b), (*b, *c), (*c, *a)].map(Segment::new);
                let flat = point - normal * normal.dot(&(point - a));
                let feet = sides.map(|side| side.at(side.nearest_parameter(&flat)));
                let distance = |foot: &Vec3| (foot - flat).norm_squared();
                feet.into_iter()
                    .min_by(|one, other| distance(one).total_cmp(&distance(other)))
            }
            Self::Rectangle { corner, sides } => {
                let [x, y] = sides.map(|side| {
                    let place = side.dot(&(point - corner)) / side.norm_squared();
                    side * place.clamp(0.0, 1.0)
                });
                Some(corner + x + y)
            }
            Self::Rim { center, radius, .. } => {
                let way = point - center;
                let flat = way - normal * normal.dot(&way);
                Some(center + flat * (radius / flat.norm()))
            }
            _ => None,
        }
    }

    /// A place on a line parallel to that face where it is over it, if there is one: at most `half` from the line's middle.
    pub fn place_over_face(
        &self,
        normal: &Vec3,
        middle: &Vec3,
        along: &Vec3,
        half: f64,
    ) -> Option<f64> {
        match self {
            Self::Facet([a, b, c]) => {
                let up = (b - a).cross(&(c - a));
                let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| {
                    let inwards = up.cross(&(to - from));
                    (inwards.dot(&(middle - from)), inwards.dot(along))
                });
                middle_of_positive(sides, half)
            }
            Self::Rectangle { corner, sides } => {
                let from = middle - corner;
                let [(x, x_rise, x_end), (y, y_rise, y_end)] =
                    sides.map(|side| (side.dot(&from), side.dot(along), side.norm_squared()));
                let sides = [
                    (x, x_rise),
                    (x_end - x, -x_rise),
                    (y, y_rise),
                    (y_end - y, -y_rise),
                ];
                middle_of_positive(sides, half)
            }
            Self::Rim { center, radius, .. } => {
                let place = along.dot(&(center - middle)).clamp(-half, half);
                let way = middle + along * place - center;
                let flat = way - normal * normal.dot(&way);
                (flat.norm() <= *radius).then_some(place)
            }
            _ => None,
        }
    }

    /// An edge, or the rulings of a tube around its axis.
    pub fn round_line(&self) -> Option<RoundLine> {
        match *self {
            Self::Edge {
                middle,
                along,
                half,
            } => Some(RoundLine {
                center: middle,
                along,
                half,
                radius: 0.0,
            }),
            Self::Tube {
                center,
                axis,
                radius,
                half,
            } => Some(RoundLine {
                center,
                along: axis,
                half,
                radius,
            }),
            _ => None,
        }
    }
}

/// All points of a surface at a distance from a segment.
pub struct RoundLine {
    pub center: Vec3,
    pub along: Vec3,
    pub half: f64,
    pub radius: f64,
}

/// A disc counts as the nearest feature, not only its rim, when the cosine between its normal and the direction exceeds this. A larger
/// value finds less of what is over a disc at the first try, a smaller one tries discs in vain.
const MIN_FACE_COSINE: f64 = 0.9;

/// A normal of any length and sign, as a unit vector on the side of a direction.
#[inline(always)]
fn turned_towards(normal: &Vec3, direction: &Vec3) -> Option<Vec3> {
    let normal = normal.try_normalize(0.0)?;
    Some(if normal.dot(direction) < 0.0 {
        -normal
    } else {
        normal
    })
}

/// The middle of the places from -half to half at which no linear function is negative; each is given by its value at 0 and its rise.
fn middle_of_positive<const N: usize>(functions: [(f64, f64); N], half: f64) -> Option<f64> {
    let (mut low, mut high) = (-half, half);
    for (value, rise) in functions {
        if rise > 0.0 {
            low = low.max(-value / rise);
        } else if rise < 0.0 {
            high = high.min(-value / rise);
        } else if value < 0.0 {
            return None;
        }
    }
    (low <= high).then_some(0.5 * (low + high))
}

/// The component of a direction perpendicular to an axis: normalized, and its length. Any perpendicular and 0 where the direction is the
/// axis to rounding.
#[inline(always)]
fn across(direction: &Vec3, axis: &Vec3) -> (Vec3, f64) {
    let once = direction - axis * axis.dot(direction);
    // Projected twice: near the axis, rounding along it would not be small compared with the remainder.
    let away = once - axis * axis.dot(&once);
    let length = away.norm();
    // What is left of rounding alone may point anywhere, along the axis too.
    if length <= 0.5 * once.norm() || length == 0.0 {
        return (plane_axes(axis).0, 0.0);
    }
    (away / length, length)
}
