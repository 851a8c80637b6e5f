//! What a query sees of an environment: whole or not at all.

use std::sync::Arc;

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
}

impl Snapshot {
    pub fn find(&self, id: u64) -> Option<&SObject> {
        let index = self
            .objects
            .binary_search_by_key(&id, |object| object.id)
            .ok()?;
        Some(&self.objects[index])
    }
}
