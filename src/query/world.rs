//! The snapshots of environments that queries see.

use std::sync::Arc;

use smallvec::SmallVec;

use crate::cobject::CObject;
use crate::environment::{Attachment, Environment, SObject, Snapshot};
use crate::space::Space;

/// One snapshot of each environment that a C-object refers to: the state that one query, or several that belong together,
/// see.
#[derive(Clone, Debug)]
pub struct World {
    /// In order of the environments' serials.
    snapshots: SmallVec<[(u64, Arc<Snapshot>); 2]>,
    version: u64,
}

impl World {
    /// The current world of a C-object.
    pub fn of(cobject: &CObject) -> Self {
        let environments = cobject.environments().iter();
        let snapshots: SmallVec<[(u64, Arc<Snapshot>); 2]> = environments
            .map(|environment| (environment.serial(), environment.snapshot()))
            .collect();
        let versions = snapshots.iter().map(|(_, snapshot)| snapshot.version);
        Self {
            version: versions.max().unwrap_or(0),
            snapshots,
        }
    }

    /// The largest version of the snapshots.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The serial and the version of each environment.
    pub fn versions(&self) -> impl Iterator<Item = (u64, u64)> {
        let all = self.snapshots.iter();
        all.map(|(serial, snapshot)| (*serial, snapshot.version))
    }

    /// The s-objects attached to links of a space, with their environments' serials.
    pub fn attached<'a>(
        &'a self,
        space: &Space,
    ) -> impl Iterator<Item = (u64, &'a SObject, &'a Attachment)> {
        let serial = space.serial();
        let all = self.snapshots.iter().flat_map(|(environment, snapshot)| {
            let attached = snapshot.attached();
            attached.map(move |object| (*environment, object, object.attachment.as_deref()))
        });
        all.filter_map(move |(environment, object, attachment)| {
            let attachment = attachment.filter(|attachment| attachment.space == serial)?;
            Some((environment, object, attachment))
        })
    }

    /// The snapshot of an environment; `None` if the C-object does not refer to it.
    pub fn snapshot(&self, environment: &Environment) -> Option<&Arc<Snapshot>> {
        let serial = environment.serial();
        let place = self
            .snapshots
            .binary_search_by_key(&serial, |(serial, _)| *serial);
        Some(&self.snapshots[place.ok()?].1)
    }
}
