//! What a query sees of an environment: whole or not at all.

use std::sync::{Arc, OnceLock};

use super::ObjectTree;
use crate::body::Body;
use crate::pose::Pose;

/// An obstacle: a body at a pose.
#[derive(Clone, Debug)]
pub struct SObject {
    /// Never used again after the object is deleted, by any environment of the process.
    pub id: u64,
    pub body: Arc<Body>,
    pub pose: Pose,
}

/// One state of an environment.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Counts the changes applied, each whole set as one: 0 for a new environment.
    pub version: u64,
    /// In order of ids.
    pub objects: Vec<SObject>,
    /// Built when first asked for.
    pub(super) tree: OnceLock<ObjectTree>,
}

impl Snapshot {
    pub fn find(&self, id: u64) -> Option<&SObject> {
        self.place_of(id).map(|place| &self.objects[place])
    }

    /// The place of an object among all.
    pub fn place_of(&self, id: u64) -> Option<usize> {
        // Ids count up, so that an object none before which was deleted is found at once.
        let first = self.objects.first()?.id;
        let guess = usize::try_from(id.checked_sub(first)?).ok()?;
        if self
            .objects
            .get(guess)
            .is_some_and(|object| object.id == id)
        {
            return Some(guess);
        }
        self.objects
            .binary_search_by_key(&id, |object| object.id)
            .ok()
    }

    /// The tree over the objects, which it names by their places.
    pub fn tree(&self) -> &ObjectTree {
        self.tree.get_or_init(|| ObjectTree::new(&self.objects))
    }
}
