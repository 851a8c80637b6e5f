//! The points of a file.

use crate::error::{Result, require_coordinates};
use crate::pose::Vec3;

/// The most points of a file. The hierarchy of so many takes some 7 GB.
pub const MAX_CLOUD_POINTS: u64 = 1 << 26;

/// The points of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cloud {
    /// In the order of the file.
    pub points: Vec<Vec3>,
    /// The number of points that the file marks as not measured.
    pub left_out: u64,
}

impl Cloud {
    /// Adds a point of a file; one with a coordinate that is no number counts as left out.
    pub(super) fn add(&mut self, xyz: [f64; 3]) -> Result<()> {
        if xyz.iter().any(|c| c.is_nan()) {
            self.left_out += 1;
            return Ok(());
        }
        require_coordinates(&xyz, "coordinate")?;
        self.points.push(Vec3::from(xyz));
        Ok(())
    }
}
