//! What holds an s-object that was grasped.

use crate::error::{Error, ErrorKind, Result};
use crate::space::Space;

/// An s-object fixed to a link: it moves with the link, and is tested against the other s-objects as the link is, and as an
/// s-object against the other links.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// The serial number of the space whose link it is.
    pub space: u64,
    pub link: usize,
    /// Other links that may meet the object: the fingers, say.
    pub touch_links: Vec<usize>,
}

impl Attachment {
    pub fn new(space: &Space, link: usize, touch_links: &[usize]) -> Result<Self> {
        for (number, name) in std::iter::once((link, "link"))
            .chain(touch_links.iter().map(|&touched| (touched, "touch link")))
        {
            if number >= space.link_count() {
                return Err(Error::new(
                    ErrorKind::NotFound,
                    format!(
                        "{name} {number} does not exist; the space has {}",
                        space.link_count()
                    ),
                ));
            }
        }
        Ok(Self {
            space: space.serial(),
            link,
            touch_links: touch_links.to_vec(),
        })
    }
}
