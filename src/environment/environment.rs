//! The live set of s-objects.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::{SObject, Snapshot};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Pose;

/// One change of an environment.
#[derive(Clone, Debug)]
pub enum Change {
    Add { body: Arc<Body>, pose: Pose },
    Move { id: u64, pose: Pose },
    Delete { id: u64 },
}

/// A set of s-objects that several threads may query while it changes: a query sees the state before a change or after
/// it. A frozen environment never changes.
#[derive(Debug)]
pub struct Environment {
    serial: u64,
    frozen: bool,
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
    pub fn apply(&self, changes: &[Change]) -> Result<(Vec<u64>, u64)> {
        if self.frozen {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "the environment is a snapshot; it cannot be changed",
            ));
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let mut next = Snapshot {
            version: state.version + 1,
            objects: state.objects.clone(),
            ..Snapshot::default()
        };
        let mut ids = Vec::with_capacity(changes.len());
        for (i, change) in changes.iter().enumerate() {
            let id = next
                .change(change)
                .map_err(|error| error.within(format_args!("changes[{i}]")))?;
            ids.push(id);
        }
        let version = next.version;
        *state = Arc::new(next);
        Ok((ids, version))
    }
}

impl Snapshot {
    fn change(&mut self, change: &Change) -> Result<u64> {
        match change {
            Change::Add { body, pose } => {
                if let Some(other) = self.objects.first()
                    && other.body.dimension() != body.dimension()
                {
                    return Err(Error::invalid(
                        "planar and spatial bodies cannot share an environment",
                    ));
                }
                let pose = planar_checked(body, pose)?;
                let id = NEXT_ID.fetch_add(1, Ordering::Relaxed);
                self.objects.push(SObject {
                    id,
                    body: body.clone(),
                    pose,
                });
                Ok(id)
            }
            Change::Move { id, pose } => {
                let index = self.index_of(*id)?;
                let object = &mut self.objects[index];
                object.pose = planar_checked(&object.body, pose)?;
                Ok(*id)
            }
            Change::Delete { id } => {
                let index = self.index_of(*id)?;
                self.objects.remove(index);
                Ok(*id)
            }
        }
    }

    fn index_of(&self, id: u64) -> Result<usize> {
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
