//! Finds a robot's links by name.

use std::collections::HashMap;

use foldhash::fast::RandomState;

/// Maps the names of links, or of joints, to link numbers. Empty names are not stored.
#[derive(Clone, Debug, Default)]
pub(super) struct Names(HashMap<String, usize, RandomState>);

impl Names {
    /// The link with this name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.0.get(name).copied()
    }

    /// Adds a name that is not in use.
    pub fn add(&mut self, name: &str, link: usize) {
        if !name.is_empty() {
            self.0.insert(name.to_string(), link);
        }
    }
}
