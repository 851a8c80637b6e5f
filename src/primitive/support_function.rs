//! Convex sets by support functions of the caller: checked at construction, and guarded at every evaluation.

use std::fmt;
use std::sync::Arc;

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Vec3;
use crate::tolerance;

/// A bounded convex set given by its support function. It must be pure, and may be called by several threads at once.
pub trait SupportFunction: Send + Sync {
    /// A point of the set that is farthest along the unit vector `direction`, both in the caller's frame.
    fn support(&self, direction: &Vec3) -> Result<Vec3>;
}

/// A support function whose results are clamped to the box that they spanned at construction.
///
/// A query cannot return an error of the set's: if the function fails during a query, or returns a point that is not finite,
/// the box's corner is used instead. The set then counts as larger than it is, so that free of the set stays a safe answer; free of its
/// complement does not.
#[derive(Clone)]
pub struct WatchedSupport {
    function: Arc<dyn SupportFunction>,
    low: Vec3,
    high: Vec3,
    /// A point of the set, to which `support` is relative.
    middle: Vec3,
}

/// Directions over the sphere that are tried at construction, besides the axes.
const DIRECTIONS: usize = 300;

impl WatchedSupport {
    /// Evaluates the function along the axes and many other directions. Fails if the function fails, if a result is not finite,
    /// or if two results prove that it is no support function: the point for one direction is less far along it than the point
    /// for another.
    pub fn new(function: Arc<dyn SupportFunction>) -> Result<Self> {
        let directions = sample_directions();
        let mut points = Vec::with_capacity(directions.len());
        for direction in &directions {
            let [x, y, z] = direction.map(|x| (x * 1e6).round() / 1e6).into();
            let named = |e: Error| e.within(format_args!("direction ({x}, {y}, {z})"));
            let point = function.support(direction).map_err(named)?;
            require_coordinates(point.as_slice(), "coordinate").map_err(named)?;
            points.push(point);
        }
        let low = points.iter().fold(points[0], |low, p| low.inf(p));
        let high = points.iter().fold(points[0], |high, p| high.sup(p));
        let slack =
            1e-9 * (high - low).norm() + 16.0 * tolerance::EPSILON * low.amax().max(high.amax());
        for (direction, own) in directions.iter().zip(&points) {
            let extent = direction.dot(own) + slack;
            if let Some(other) = points.iter().position(|p| direction.dot(p) > extent) {
                let say = |v: &Vec3| format!("({:.6}, {:.6}, {:.6})", v.x, v.y, v.z);
                return Err(Error::new(
                    ErrorKind::NotConvex,
                    format!(
                        "the function's point for direction {} reaches less far along it than its point for direction {}",
                        say(direction),
                        say(&directions[other])
                    ),
                ));
            }
        }
        let middle = points.iter().map(|p| p - low).sum::<Vec3>() / points.len() as f64 + low;
        Ok(Self {
            function,
            low,
            high,
            middle,
        })
    }

    /// The origin of [`WatchedSupport::support`], in the caller's frame.
    pub fn middle(&self) -> Vec3 {
        self.middle
    }

    /// The lowest and highest coordinates of the set, relative to the middle.
    pub fn extent(&self) -> (Vec3, Vec3) {
        (self.low - self.middle, self.high - self.middle)
    }

    /// The support point along a direction of any length, relative to the middle.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let corner = || {
            direction.zip_zip_map(
                &self.low,
                &self.high,
                |d, low, high| {
                    if d < 0.0 { low } else { high }
                },
            )
        };
        let answer = direction
            .try_normalize(0.0)
            .and_then(|unit| self.function.support(&unit).ok())
            .filter(|point| point.iter().all(|x| x.is_finite()))
            .map_or_else(corner, |point| point.sup(&self.low).inf(&self.high));
        answer - self.middle
    }
}

/// Both directions of the axes, then directions spread evenly over the sphere.
fn sample_directions() -> Vec<Vec3> {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let mut directions: Vec<Vec3> = axes.iter().flat_map(|&axis| [axis, -axis]).collect();
    let golden = std::f64::consts::PI * (3.0 - 5.0f64.sqrt());
    directions.extend((0..DIRECTIONS).map(|i| {
        let z = 1.0 - (2 * i + 1) as f64 / DIRECTIONS as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let ring = (1.0 - z * z).sqrt();
        Vec3::new(ring * cos, ring * sin, z)
    }));
    directions
}

impl PartialEq for WatchedSupport {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function)
            && (self.low, self.high) == (other.low, other.high)
    }
}

impl fmt::Debug for WatchedSupport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("WatchedSupport")
            .field("low", &self.low)
            .field("high", &self.high)
            .finish_non_exhaustive()
    }
}
