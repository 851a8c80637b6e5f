//! The attachment of a grasped s-object to a link.

use crate::error::{Error, ErrorKind, Result};
use crate::space::Space;

/// Fixes an s-object to a link. The object moves with the link; it is tested against the other s-objects like the link, and
/// against the other links as an s-object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// The serial number of the space that has the link.
    pub space: u64,
    /// Index of the link in the space.
    pub link: usize,
    /// Other links that may touch the object, such as the fingers.
    pub touch_links: Vec<usize>,
}

impl Attachment {
    /// Attaches to a link of a space. Fails for links that the space does not have.
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
