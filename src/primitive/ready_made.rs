//! Constructors of primitives: balls, capsules, cylinders, cones, ellipsoids and sets by support functions, and the
//! rounding of any primitive by a radius.

use std::sync::Arc;

use super::polygon::extent_of;
use super::polyhedron::convex_polyhedron;
use super::support_function::{SupportFunction, WatchedSupport};
use super::{Convex, Curve, Smooth, SmoothKind};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::{Mat3, Pose, Vec3};
use crate::tolerance;

/// All points within `radius` of a primitive; with `planar`, those in the plane z = 0. A radius of 0 adds nothing.
pub fn rounded(mut core: Convex, radius: f64, planar: bool) -> Result<Convex> {
    require_number(radius, "the radius")?;
    if radius < 0.0 {
        return Err(Error::invalid(format!("the radius is negative: {radius}")));
    }
    if radius > 0.0 && radius < tolerance::SMALLEST_DIAMETER {
        return Err(too_small("the radius", radius));
    }
    let smooth = core.curve.take().and_then(|curve| curve.smooth);
    if radius > 0.0 || smooth.is_some() {
        core.curve = Some(Box::new(Curve::new(&core, radius, smooth, planar)));
    }
    Ok(core)
}

/// The ball around a point; in the plane the disc.
pub fn sphere(center: &Vec3, radius: f64, planar: bool) -> Result<Convex> {
    require_coordinates(center.as_slice(), "coordinate").map_err(|e| e.within("the center"))?;
    rounded(convex_polyhedron(&[*center])?, radius, planar)
}

/// All points within a radius of a segment, which may have no length.
pub fn capsule(ends: &[Vec3; 2], radius: f64, planar: bool) -> Result<Convex> {
    for (end, name) in ends.iter().zip(["a", "b"]) {
        require_coordinates(end.as_slice(), "coordinate")
            .map_err(|e| e.within(format_args!("end {name}")))?;
    }
    rounded(convex_polyhedron(ends)?, radius, planar)
}

/// The cylinder around the z axis of the pose, from -half_length to half_length.
pub fn cylinder(pose: &Pose, radius: f64, half_length: f64) -> Result<Convex> {
    require_size(radius, "the radius")?;
    require_size(half_length, "the half length")?;
    let kind = SmoothKind::Cylinder {
        radius,
        half_length,
    };
    smooth(kind, pose.rotation, pose.translation)
}

/// The cone around the z axis of the pose: its base at -height / 2, its apex at height / 2.
pub fn cone(pose: &Pose, radius: f64, height: f64) -> Result<Convex> {
    require_size(radius, "the radius")?;
    require_size(height, "the height")?;
    let kind = SmoothKind::Cone { radius, height };
    smooth(kind, pose.rotation, pose.translation)
}

/// The ellipsoid of these semi-axes around the origin of the pose, along its axes.
pub fn ellipsoid(pose: &Pose, semi_axes: &Vec3) -> Result<Convex> {
    for (axis, &half) in ["x", "y", "z"].iter().zip(semi_axes.iter()) {
        require_size(half, &format!("semi-axis {axis}"))?;
    }
    let kind = SmoothKind::Ellipsoid {
        semi_axes: *semi_axes,
    };
    smooth(kind, pose.rotation, pose.translation)
}

/// The bounded convex set of a support function of the caller's.
pub fn support_set(function: Arc<dyn SupportFunction>) -> Result<Convex> {
    let watched = WatchedSupport::new(function)?;
    let middle = watched.middle();
    smooth(SmoothKind::Function(watched), Mat3::identity(), middle)
}

fn smooth(kind: SmoothKind, axes: Mat3, origin: Vec3) -> Result<Convex> {
    let smooth = Smooth { kind, axes };
    let mut core = convex_polyhedron(&[origin])?;
    let curve = Curve::new(&core, 0.0, Some(smooth), false);
    let extent = extent_of(curve.bounds())?;
    core.deviation = tolerance::SMOOTH_ERROR * extent.diameter;
    core.curve = Some(Box::new(curve));
    Ok(core)
}

fn require_number(value: f64, what: &str) -> Result<()> {
    if !value.is_finite() {
        return Err(Error::new(
            ErrorKind::NotFinite,
            format!("{what} is {value}"),
        ));
    }
    if value.abs() > tolerance::LARGEST_COORDINATE {
        return Err(Error::invalid(format!("{what} is too large: {value}")));
    }
    Ok(())
}

fn too_small(what: &str, value: f64) -> Error {
    Error::new(
        ErrorKind::Degenerate,
        format!(
            "{what} is {value:e}; at least {:e} is needed",
            tolerance::SMALLEST_DIAMETER
        ),
    )
}

/// Refuses sizes that are not finite, negative, zero or beyond the accepted range.
pub(super) fn require_size(value: f64, what: &str) -> Result<()> {
    require_number(value, what)?;
    if value < 0.0 {
        return Err(Error::invalid(format!("{what} is negative: {value}")));
    }
    if value < tolerance::SMALLEST_DIAMETER {
        return Err(too_small(what, value));
    }
    Ok(())
}
