//! The names of a robot's links or joints, for looking numbers up.

use std::collections::HashMap;

use foldhash::fast::RandomState;

/// The number of the link behind each name. The empty name stands for none.
#[derive(Clone, Debug, Default)]
pub(super) struct Names(HashMap<String, usize, RandomState>);

impl Names {
    /// The link with this name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.0.get(name).copied()
    }

    /// Adds the name of a link, which no other has.
    pub fn add(&mut self, name: &str, link: usize) {
        if !name.is_empty() {
            self.0.insert(name.to_string(), link);
        }
    }
}
