//! What a slide is asked for.

use crate::error::{Error, Result, require_coordinates, require_finite};
use crate::query::check_threshold;

/// Options of a slide. Distances are lengths.
#[derive(Clone, Copy, Debug)]
pub struct SlideOptions {
    /// Contacts up to this distance constrain the step.
    pub max_shell: f64,
    /// The distance at which the robot slides; where it is nearer it is pushed out.
    pub desired_distance: f64,
    /// Lengthens the step along the contact to the length of the requested step, at most fourfold: the report's
    /// `normalize?`.
    pub normalize: bool,
    /// A step is halved until it is accepted, or shorter than this fraction of the requested step.
    pub floor: f64,
    /// The most witnesses considered, the nearest first.
    pub max_witnesses: usize,
}

impl SlideOptions {
    /// The report's defaults: a desired distance of a tenth of the shell.
    pub fn with_shell(max_shell: f64) -> Self {
        Self {
            max_shell,
            desired_distance: max_shell / 10.0,
            normalize: false,
            floor: 1.0 / 1024.0,
            max_witnesses: 256,
        }
    }

    pub(super) fn check(&self) -> Result<()> {
        check_threshold(self.max_shell, "max_shell")?;
        require_coordinates(&[self.max_shell], "max_shell")?;
        check_threshold(self.desired_distance, "desired_distance")?;
        if self.max_shell == 0.0 {
            return Err(Error::invalid(
                "max_shell is 0; a slide needs room to see contacts",
            ));
        }
        if self.desired_distance > self.max_shell {
            return Err(Error::invalid(format!(
                "desired_distance {} is larger than max_shell {}",
                self.desired_distance, self.max_shell
            )));
        }
        require_finite(&[self.floor], "floor")?;
        if !(f64::EPSILON..=1.0).contains(&self.floor) {
            return Err(Error::invalid(format!(
                "floor {} is not between {:e} and 1",
                self.floor,
                f64::EPSILON
            )));
        }
        if self.max_witnesses == 0 {
            return Err(Error::invalid("max_witnesses is 0"));
        }
        Ok(())
    }
}
