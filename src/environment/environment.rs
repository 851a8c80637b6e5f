//! The live set of s-objects.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::{Attachment, SObject, Snapshot};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Pose;
use crate::user_data::UserData;

/// One change of an environment.
#[derive(Clone, Debug)]
pub enum Change {
    /// Adds a body at a pose, with data of the caller's.
    Add {
        body: Arc<Body>,
        pose: Pose,
        data: Option<UserData>,
    },
    /// Places an object in the world; one that was attached is let go.
    Move {
        id: u64,
        pose: Pose,
    },
    /// Fixes an object to a link, at a pose in the link's frame.
    Attach {
        id: u64,
        pose: Pose,
        attachment: Attachment,
    },
    Delete {
        id: u64,
    },
}

/// A set of s-objects that several threads may query while it changes: a query sees the state before a change or after
/// it. A frozen environment never changes.
#[derive(Debug)]
pub struct Environment {
    serial: u64,
    frozen: bool,
    /// Held by who changes the environment, so that `state` is never held for long.
    writer: Mutex<()>,
    state: Mutex<Arc<Snapshot>>,
}

static NEXT_SERIAL: AtomicU64 = AtomicU64::new(1);
static NEXT_ID: AtomicU64 = AtomicU64::new(1);

impl Default for Environment {
    fn default() -> Self {
        Self::with_state(Arc::default(), false)
    }
}

impl Environment {
    fn with_state(state: Arc<Snapshot>, frozen: bool) -> Self {
        Self {
            serial: NEXT_SERIAL.fetch_add(1, Ordering::Relaxed),
            frozen,
            writer: Mutex::default(),
            state: Mutex::new(state),
        }
    }

    /// A number no other environment of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// The state now.
    pub fn snapshot(&self) -> Arc<Snapshot> {
        // A snapshot is replaced whole, so a panic elsewhere cannot have left half of one.
        self.state
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// An environment that stays at the state of now.
    pub fn freeze(&self) -> Self {
        Self::with_state(self.snapshot(), true)
    }

    /// Applies all changes as one, or none of them. Returns the id of the object each change is about, and the version.
    ///
    /// Takes time in proportion to the number of changes, times the logarithm of that of the objects, on average: at times
    /// the tree over the objects is built anew. Nobody who reads waits for it.
    pub fn apply(&self, changes: &[Change]) -> Result<(Vec<u64>, u64)> {
        if self.frozen {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "the environment is a snapshot; it cannot be changed",
            ));
        }
        // What the state before does not share is freed when no lock is held any more: that runs functions of the caller.
        let before;
        let _alone = self.writer.lock().unwrap_or_else(PoisonError::into_inner);
        before = self.snapshot();
        let mut next = Snapshot::clone(&before);
        let mut ids = Vec::with_capacity(changes.len());
        let mut places = Vec::with_capacity(changes.len());
        for (i, change) in changes.iter().enumerate() {
            let (id, place) = next
                .change(change)
                .map_err(|error| error.within(format_args!("changes[{i}]")))?;
            ids.push(id);
            places.push(place);
        }
        places.sort_unstable();
        places.dedup();
        next.update_tree(&places);
        next.version += 1;
        let version = next.version;
        *self.state.lock().unwrap_or_else(PoisonError::into_inner) = Arc::new(next);
        Ok((ids, version))
    }
}

impl Snapshot {
    /// Changes the objects, but not the tree. Returns the id and the place of the one it is about.
    fn change(&mut self, change: &Change) -> Result<(u64, usize)> {
        match change {
            Change::Add { body, pose, data } => {
                if let Some(other) = self.first()
                    && other.body.dimension() != body.dimension()
                {
                    return Err(Error::invalid(
                        "planar and spatial bodies cannot share an environment",
                    ));
                }
                let object = SObject {
                    id: NEXT_ID.fetch_add(1, Ordering::Relaxed),
                    body: body.clone(),
                    pose: planar_checked(body, pose)?,
                    attachment: None,
                    data: data.clone(),
                };
                Ok((object.id, self.push(object)))
            }
            Change::Move { id, pose } => {
                let place = self.required(*id)?;
                let pose = planar_checked(&self.object(place).body, pose)?;
                self.set_pose(place, pose, None);
                Ok((*id, place))
            }
            Change::Attach {
                id,
                pose,
                attachment,
            } => {
                let place = self.required(*id)?;
                let pose = planar_checked(&self.object(place).body, pose)?;
                self.set_pose(place, pose, Some(Arc::new(attachment.clone())));
                Ok((*id, place))
            }
            Change::Delete { id } => {
                let place = self.required(*id)?;
                self.take(place);
                Ok((*id, place))
            }
        }
    }

    fn required(&self, id: u64) -> Result<usize> {
        self.place_of(id).ok_or_else(|| {
            Error::new(
                ErrorKind::NotFound,
                format!("there is no s-object with id {id}"),
            )
        })
    }
}

fn planar_checked(body: &Body, pose: &Pose) -> Result<Pose> {
    if body.dimension() == 2 && !pose.is_planar() {
        return Err(Error::invalid(
            "a planar body's pose leaves the plane z = 0",
        ));
    }
    Ok(*pose)
}
