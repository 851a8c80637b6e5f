//! Pure sets: given in C-space itself, by coordinates (§2.2.4, where they are an extension).

use std::fmt;
use std::sync::Arc;

use super::{Leaf, Predicate};
use crate::error::{Error, ErrorKind, Result, require_coordinates, require_finite};
use crate::pose::Vec3;
use crate::robot::Coordinate;
use crate::space::Space;
use crate::tolerance;
use crate::user_data::UserData;

/// Options of a pure set.
#[derive(Clone, Copy, Debug, Default)]
pub struct PureOptions {
    /// Distances above 0 and up to this classify as contact; in units of C-space, before any scale.
    pub contact_epsilon: f64,
    /// The length that a C-space unit stands for, so that distances can be compared with those of induced sets.
    pub scale: Option<f64>,
}

/// The shape of a pure set. All are closed except the two marked open.
#[derive(Clone)]
pub enum PureShape {
    /// Where some coordinate is outside its range. Open: a configuration at a limit is not in the set.
    BeyondLimits,
    /// Where the origin of any of the links is outside the world box; measures in lengths. Open.
    BeyondWorld {
        /// By number in the space.
        links: Vec<usize>,
    },
    /// Where the body of any of the links meets the half-space normal . x <= offset of the world. Measures in lengths.
    Floor {
        /// By number in the space.
        links: Vec<usize>,
        /// Of length 1, out of the floor, in the world.
        normal: Vec3,
        /// The height of the floor along the normal.
        offset: f64,
    },
    /// Where every coordinate is in its interval; on a circle that is the arc from `low` upwards to `high`.
    Box {
        /// One entry per coordinate; may be minus infinity.
        low: Vec<f64>,
        /// One entry per coordinate; may be infinite.
        high: Vec<f64>,
    },
    /// Where normal . q <= offset.
    HalfSpace {
        /// One entry per coordinate; of any length above 0.
        normal: Vec<f64>,
        /// The largest `normal . q` in the set.
        offset: f64,
        /// Whether the boundary does not belong to the set.
        is_open: bool,
    },
    /// The configurations within `radius` of a centre (see [`super::measure`] for the metric).
    Ball {
        /// A configuration.
        center: Vec<f64>,
        /// In C-space units.
        radius: f64,
    },
    /// Defined by the caller.
    Predicate(Arc<dyn Predicate>),
}

/// A pure set: its shape and its options.
#[derive(Clone, Debug)]
pub struct PureSet {
    /// How answers name the set.
    pub leaf: Leaf,
    /// Keeps the leaf's user data alive: it must outlive every set that holds the leaf.
    pub data: Option<UserData>,
    /// Which configurations the set holds.
    pub shape: PureShape,
    /// Contact epsilon and scale.
    pub options: PureOptions,
    /// The shell that slides use for this set, in the unit of its distances; `None` for that of their options.
    pub shell: Option<f64>,
}

impl fmt::Debug for PureShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl PureShape {
    /// The links whose places decide it, by number in the space.
    pub fn links(&self) -> &[usize] {
        match self {
            Self::BeyondWorld { links } | Self::Floor { links, .. } => links,
            _ => &[],
        }
    }

    /// The name of the shape in error messages.
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

    /// The outside of the world box, for all links.
    pub fn beyond_world(space: &Space) -> Self {
        Self::BeyondWorld {
            links: (0..space.link_count()).collect(),
        }
    }

    /// A floor for links, or for all with a body if `links` is empty. The normal may have any length above 0; the floor is
    /// `normal . x <= offset`.
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
        let mut numbers: Vec<usize> = match links {
            [] => space.bodies().carriers().to_vec(),
            _ => links.to_vec(),
        };
        check_links(space, &numbers)?;
        numbers.sort_unstable();
        numbers.dedup();
        Ok(Self::Floor {
            links: numbers,
            normal: scaled / length,
            offset: offset / largest / length,
        })
    }

    /// Whether the set measures in lengths without a scale, and is determined by link poses alone.
    pub fn is_in_world(&self) -> bool {
        matches!(self, Self::BeyondWorld { .. } | Self::Floor { .. })
    }

    /// Whether the boundary does not belong to the set.
    pub fn is_open(&self) -> bool {
        match self {
            Self::BeyondLimits | Self::BeyondWorld { .. } => true,
            Self::HalfSpace { is_open, .. } => *is_open,
            _ => false,
        }
    }

    pub(super) fn check(&self, space: &Space) -> Result<()> {
        match self {
            Self::BeyondLimits | Self::Predicate(_) => Ok(()),
            Self::BeyondWorld { links } | Self::Floor { links, .. } => check_links(space, links),
            Self::Box { low, high } => check_box(space, low, high),
            Self::HalfSpace { normal, offset, .. } => check_half_space(space, normal, *offset),
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
