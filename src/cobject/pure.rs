//! Pure sets: given in C-space itself, by coordinates (§2.2.4; an extension in the report).

use std::fmt;
use std::sync::Arc;

use super::{Leaf, Predicate};
use crate::error::{Error, ErrorKind, Result, require_coordinates, require_finite};
use crate::pose::Vec3;
use crate::robot::Coordinate;
use crate::space::Space;
use crate::tolerance;
use crate::user_data::UserData;

/// How a pure set measures.
#[derive(Clone, Copy, Debug, Default)]
pub struct PureOptions {
    /// Distances above 0 and up to this classify as contact; in units of C-space, before any scale.
    pub contact_epsilon: f64,
    /// The length that a unit of C-space stands for, so that distances can be compared with those of induced sets.
    pub scale: Option<f64>,
}

/// What the set is. All but the two open ones are closed.
#[derive(Clone)]
pub enum PureShape {
    /// Where some coordinate is beyond its range. Open: at a limit the robot is not out yet.
    BeyondLimits,
    /// Where the origin of some of the links is outside the world box; measures in lengths. Open.
    BeyondWorld { links: Vec<usize> },
    /// Where the body of some of the links reaches the half-space normal . x <= offset of the world; the normal has length 1.
    /// Measures in lengths.
    Floor {
        links: Vec<usize>,
        normal: Vec3,
        offset: f64,
    },
    /// Where every coordinate is in its interval; on a circle the arc from `low` upwards to `high`.
    Box { low: Vec<f64>, high: Vec<f64> },
    /// Where normal . q <= offset.
    HalfSpace { normal: Vec<f64>, offset: f64 },
    /// The configurations at most `radius` from a centre (see [`super::measure`] for the metric).
    Ball { center: Vec<f64>, radius: f64 },
    /// By functions of the caller.
    Predicate(Arc<dyn Predicate>),
}

/// A set in C-space with how it measures.
#[derive(Clone, Debug)]
pub struct PureSet {
    pub leaf: Leaf,
    /// What the leaf's data are kept by: it must outlive every set that holds the leaf.
    pub data: Option<UserData>,
    pub shape: PureShape,
    pub options: PureOptions,
    /// How far slides look for its contacts, if not as far as for those of others; in the unit of its distances.
    pub shell: Option<f64>,
}

impl fmt::Debug for PureShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl PureShape {
    /// What messages call it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::BeyondLimits => "a set beyond limits",
            Self::BeyondWorld { .. } => "a set beyond the world box",
            Self::Floor { .. } => "a floor",
            Self::Box { .. } => "a box",
            Self::HalfSpace { .. } => "a half-space",
            Self::Ball { .. } => "a ball",
            Self::Predicate(_) => "a predicate",
        }
    }

    /// The world box for all links.
    pub fn beyond_world(space: &Space) -> Self {
        Self::BeyondWorld {
            links: (0..space.link_count()).collect(),
        }
    }

    /// A floor for links, or for all that have a body if none is named. The normal may have any length, which the offset is
    /// in units of.
    pub fn floor(space: &Space, links: &[usize], normal: &Vec3, offset: f64) -> Result<Self> {
        require_coordinates(normal.as_slice(), "normal entry")?;
        require_coordinates(&[offset], "offset")?;
        if space.dimension() == 2 && normal.z != 0.0 {
            return Err(Error::invalid(format!(
                "the normal leaves the plane of the space: its z is {}",
                normal.z
            )));
        }
        let largest = normal.amax();
        if largest < 1e-100 {
            return Err(Error::new(
                ErrorKind::Degenerate,
                "the floor's normal has no length",
            ));
        }
        let scaled = normal / largest;
        let length = scaled.norm();
        let has_body = |&link: &usize| space.link(link).is_some_and(|link| link.body.is_some());
        let mut chosen: Vec<usize> = match links {
            [] => (0..space.link_count()).filter(has_body).collect(),
            _ => links.to_vec(),
        };
        check_links(space, &chosen)?;
        chosen.sort_unstable();
        chosen.dedup();
        Ok(Self::Floor {
            links: chosen,
            normal: scaled / length,
            offset: offset / largest / length,
        })
    }

    /// Whether it measures in lengths by itself, and link poses are enough to tell.
    pub fn is_in_world(&self) -> bool {
        matches!(self, Self::BeyondWorld { .. } | Self::Floor { .. })
    }

    /// Whether its boundary is not part of it.
    pub fn is_open(&self) -> bool {
        matches!(self, Self::BeyondLimits | Self::BeyondWorld { .. })
    }

    pub(super) fn check(&self, space: &Space) -> Result<()> {
        match self {
            Self::BeyondLimits | Self::Predicate(_) => Ok(()),
            Self::BeyondWorld { links } | Self::Floor { links, .. } => check_links(space, links),
            Self::Box { low, high } => check_box(space, low, high),
            Self::HalfSpace { normal, offset } => check_half_space(space, normal, *offset),
            Self::Ball { center, radius } => {
                space
                    .check_configuration(center)
                    .map_err(|e| e.within("center"))?;
                require_coordinates(&[*radius], "radius")?;
                if *radius < 0.0 {
                    return Err(Error::invalid(format!("the radius is negative: {radius}")));
                }
                Ok(())
            }
        }
    }
}

impl PureOptions {
    pub(super) fn check(&self) -> Result<()> {
        require_finite(&[self.contact_epsilon], "contact_epsilon")?;
        if self.contact_epsilon < 0.0 {
            let epsilon = self.contact_epsilon;
            return Err(Error::invalid(format!(
                "contact_epsilon is negative: {epsilon}"
            )));
        }
        if let Some(scale) = self.scale {
            require_coordinates(&[scale], "scale")?;
            if scale < tolerance::SMALLEST_DIAMETER {
                let least = tolerance::SMALLEST_DIAMETER;
                return Err(Error::invalid(format!(
                    "scale is {scale}; it must be {least:e} at least"
                )));
            }
        }
        Ok(())
    }
}

fn check_links(space: &Space, links: &[usize]) -> Result<()> {
    let count = space.link_count();
    match links.iter().find(|link| **link >= count) {
        Some(link) => Err(Error::new(
            ErrorKind::NotFound,
            format!("link {link} does not exist; the space has {count}, counted from 0"),
        )),
        None => Ok(()),
    }
}

fn require_size(space: &Space, given: usize, name: &str) -> Result<()> {
    if given != space.nq() {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "{name} has {given} entries, but the space has {} coordinates",
                space.nq()
            ),
        ));
    }
    Ok(())
}

fn check_box(space: &Space, low: &[f64], high: &[f64]) -> Result<()> {
    require_size(space, low.len(), "low")?;
    require_size(space, high.len(), "high")?;
    for (i, (coordinate, (&low, &high))) in space
        .coordinates()
        .iter()
        .zip(low.iter().zip(high))
        .enumerate()
    {
        if low.is_nan() || high.is_nan() {
            return Err(Error::new(
                ErrorKind::NotFinite,
                format!("the interval of coordinate {i} holds a NaN"),
            ));
        }
        if low > high || low == f64::INFINITY || high == f64::NEG_INFINITY {
            return Err(Error::invalid(format!(
                "the interval of coordinate {i} is empty: {low} to {high}"
            )));
        }
        let ends = [low, high];
        for end in ends.into_iter().filter(|end| end.is_finite()) {
            require_coordinates(&[end], "an end of an interval,")?;
        }
        let is_half_open = ends.iter().filter(|end| end.is_finite()).count() == 1;
        let is_bounded = ends.iter().any(|end| end.is_finite());
        match coordinate {
            Coordinate::Quaternion if is_bounded => {
                return Err(Error::invalid(format!(
                    "coordinate {i} belongs to a quaternion, which has no intervals; pass -INFINITY and INFINITY"
                )));
            }
            Coordinate::Circle if is_half_open => {
                return Err(Error::invalid(format!(
                    "coordinate {i} runs round a circle, where an interval has two ends or none: {low} to {high}"
                )));
            }
            _ => {}
        }
    }
    Ok(())
}

fn check_half_space(space: &Space, normal: &[f64], offset: f64) -> Result<()> {
    require_size(space, normal.len(), "normal")?;
    require_coordinates(normal, "normal entry")?;
    require_coordinates(&[offset], "offset")?;
    let pairs = || space.coordinates().iter().zip(normal).enumerate();
    for (i, (coordinate, &entry)) in pairs() {
        let what = match coordinate {
            Coordinate::Interval { .. } => continue,
            Coordinate::Circle => "runs round a circle",
            Coordinate::Quaternion => "belongs to a quaternion",
        };
        if entry != 0.0 {
            return Err(Error::invalid(format!(
                "coordinate {i} {what}, where a plane means nothing; its entry of the normal must be 0"
            )));
        }
    }
    let length = normal.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    if length < 1e-100 {
        return Err(Error::new(
            ErrorKind::Degenerate,
            "the half-space's normal has no length",
        ));
    }
    Ok(())
}
