//! What the meshes of each link stand for.

use std::collections::{HashMap, HashSet};

use super::model::LinkElement;
use crate::body::MeshForm;
use crate::error::{Error, ErrorKind, Result};

/// What the meshes of the links stand for.
#[derive(Clone, Debug, Default)]
pub struct LinkForms {
    /// Of all links that are not named.
    pub others: MeshForm,
    /// Of links by their name in the file.
    pub named: HashMap<String, MeshForm>,
}

impl LinkForms {
    /// The form of a link's meshes.
    pub fn of(&self, link: &str) -> MeshForm {
        self.named.get(link).copied().unwrap_or(self.others)
    }

    /// Refuses names that no link has.
    pub(super) fn check(&self, links: &[LinkElement]) -> Result<()> {
        let links: HashSet<&str> = links.iter().map(|link| link.name).collect();
        let missing = self
            .named
            .keys()
            .filter(|name| !links.contains(name.as_str()));
        match missing.min() {
            None => Ok(()),
            Some(name) => Err(Error::new(
                ErrorKind::NotFound,
                format!("there is no link \"{name}\", for which the options choose a mesh form"),
            )),
        }
    }
}
