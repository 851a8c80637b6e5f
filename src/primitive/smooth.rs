//! Smooth convex sets, each by its support function around its own origin.

use super::support_function::WatchedSupport;
use crate::gjk::Extreme;
use crate::pose::{Mat3, Vec3};

/// A smooth set in its local frame; the local origin is a point of the set.
#[derive(Clone, Debug, PartialEq)]
pub enum SmoothKind {
    /// Around the local z axis, from -half_length to half_length.
    Cylinder {
        /// The radius of the cylinder.
        radius: f64,
        /// Half the length along the axis.
        half_length: f64,
    },
    /// Around the local z axis: the base at -height / 2, the apex at height / 2.
    Cone {
        /// The radius of the base.
        radius: f64,
        /// The distance from the base to the apex.
        height: f64,
    },
    /// Around the local origin, along the local axes.
    Ellipsoid {
        /// The semi-axes along the local axes.
        semi_axes: Vec3,
    },
    /// A support function of the caller's, in the body's frame.
    Function(WatchedSupport),
}

/// A smooth set with its orientation in the primitive's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Smooth {
    /// Which set it is, with its sizes.
    pub kind: SmoothKind,
    /// The directions of the local axes, as columns.
    pub axes: Mat3,
}

/// The name of an extreme point on a cylinder's upper end, or at a cone's apex.
pub const HIGH_END: u32 = 1;
/// The name of an extreme point on a cylinder's lower end, or on a cone's base.
pub const LOW_END: u32 = 2;

/// The name of all other points.
const BETWEEN: u32 = 0;

impl SmoothKind {
    /// The point farthest along a direction of any length, in the local frame.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        self.extreme(direction).point
    }

    /// The same with the name of the end that the point is on.
    #[inline(always)]
    pub fn extreme(&self, direction: &Vec3) -> Extreme {
        let along = direction.z;
        let across = (direction.x * direction.x + direction.y * direction.y).sqrt();
        let on_circle = |radius: f64, z: f64| {
            let scale = if across > 0.0 { radius / across } else { 0.0 };
            Vec3::new(direction.x * scale, direction.y * scale, z)
        };
        let named = |point: Vec3| Extreme {
            point,
            name: match point.z {
                z if z > 0.0 => HIGH_END,
                z if z < 0.0 => LOW_END,
                _ => BETWEEN,
            },
        };
        let unnamed = |point: Vec3| Extreme {
            point,
            name: BETWEEN,
        };
        match self {
            Self::Cylinder {
                radius,
                half_length,
            } => {
                let z = if along == 0.0 {
                    0.0
                } else {
                    half_length.copysign(along)
                };
                named(on_circle(*radius, z))
            }
            Self::Cone { radius, height } => {
                let half = 0.5 * height;
                named(if along * height >= radius * across {
                    Vec3::new(0.0, 0.0, half)
                } else {
                    on_circle(*radius, -half)
                })
            }
            Self::Ellipsoid { semi_axes } => {
                let scaled = semi_axes.component_mul(direction);
                let length = scaled.norm();
                unnamed(if length > 0.0 {
                    semi_axes.component_mul(&scaled) / length
                } else {
                    Vec3::zeros()
                })
            }
            Self::Function(function) => unnamed(function.support(direction)),
        }
    }

    /// Points whose hull contains the set, in the local frame.
    pub fn bounding_points(&self) -> Vec<Vec3> {
        match self {
            Self::Cylinder {
                radius,
                half_length,
            } => {
                let high = Vec3::new(*radius, *radius, *half_length);
                corners(&-high, &high)
            }
            Self::Cone { radius, height } => {
                let (r, half) = (*radius, 0.5 * height);
                let base = [(-r, -r), (r, -r), (r, r), (-r, r)];
                let mut points = base.map(|(x, y)| Vec3::new(x, y, -half)).to_vec();
                points.push(Vec3::new(0.0, 0.0, half));
                points
            }
            Self::Ellipsoid { semi_axes } => corners(&-semi_axes, semi_axes),
            Self::Function(function) => {
                let (low, high) = function.extent();
                corners(&low, &high)
            }
        }
    }
}

fn corners(low: &Vec3, high: &Vec3) -> Vec<Vec3> {
    let pick = |i: usize, axis: usize| [low, high][i >> axis & 1][axis];
    (0..8)
        .map(|i| Vec3::new(pick(i, 0), pick(i, 1), pick(i, 2)))
        .collect()
}
