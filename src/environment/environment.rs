//! The live set of s-objects.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::attachment::Attachment;
use super::snapshot::{SObject, Snapshot};
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};
use crate::index_set::IndexSet;
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
    writer: Mutex<Writer>,
    state: Mutex<Arc<Snapshot>>,
}

/// Memory that goes from one change to the next.
#[derive(Debug, Default)]
struct Writer {
    /// The state before the last change. It becomes the next one if nobody else holds it: what little differs is copied, and
    /// nothing is allocated. It holds no object that is gone.
    spare: Option<Arc<Snapshot>>,
    /// The last change about each place of those that were changed.
    latest: Vec<u32>,
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
    /// the tree over the objects is built anew. One pass over an array of bits, 64 objects a word, comes on top. Nobody who
    /// reads waits for it.
    pub fn apply(&self, changes: &[Change]) -> Result<(Vec<u64>, u64)> {
        if self.frozen {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "the environment is a snapshot; it cannot be changed",
            ));
        }
        // What is no longer part of any state is freed when no lock is held any more: that runs functions of the caller.
        let _gone;
        let mut writer = self.writer.lock().unwrap_or_else(PoisonError::into_inner);
        let Writer { spare, latest } = &mut *writer;
        let before = self.snapshot();
        let mut next = next_state(spare.take(), &before, changes);
        let state = Arc::get_mut(&mut next).expect("nobody else knows it yet");
        let mut ids = Vec::with_capacity(changes.len());
        let mut changed = IndexSet::new(state.place_count() + changes.len());
        latest.resize(state.place_count() + changes.len(), 0);
        for (i, change) in changes.iter().enumerate() {
            let (id, place) = state
                .change(change)
                .map_err(|error| error.within(format_args!("changes[{i}]")))?;
            ids.push(id);
            changed.insert(place);
            latest[place] = i as u32;
        }
        state.settle(&changed, |place| changes[latest[place] as usize].target());
        state.version += 1;
        let version = state.version;
        *self.state.lock().unwrap_or_else(PoisonError::into_inner) = next;
        let is_deletion = |change: &Change| matches!(change, Change::Delete { .. });
        if changes.iter().any(is_deletion) {
            _gone = before;
        } else {
            *spare = Some(before);
        }
        Ok((ids, version))
    }
}

impl Change {
    /// Where the object is to go, and what holds it there, if it is moved.
    fn target(&self) -> Option<(&Pose, Option<&Attachment>)> {
        match self {
            Change::Move { pose, .. } => Some((pose, None)),
            Change::Attach {
                pose, attachment, ..
            } => Some((pose, Some(attachment))),
            Change::Add { .. } | Change::Delete { .. } => None,
        }
    }
}

/// A state equal to the one before the changes, but for where objects are that they move: the spare one brought up to date,
/// if nobody else holds it.
fn next_state(
    spare: Option<Arc<Snapshot>>,
    before: &Snapshot,
    changes: &[Change],
) -> Arc<Snapshot> {
    if let Some(mut spare) = spare
        && let Some(state) = Arc::get_mut(&mut spare)
    {
        let mut to_move = IndexSet::new(before.place_count());
        for change in changes {
            if let Change::Move { id, .. } = change
                && let Some(place) = before.place_of(*id)
            {
                to_move.insert(place);
            }
        }
        state.follow(before, &to_move);
        return spare;
    }
    Arc::new(before.clone())
}

impl Snapshot {
    /// Checks a change, and adds or deletes its object; those that are to move stay until [`Snapshot::settle`]. Returns the id
    /// and the place of the one it is about.
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
                check_planar(body, pose)?;
                let object = SObject {
                    id: NEXT_ID.fetch_add(1, Ordering::Relaxed),
                    body: body.clone(),
                    pose: *pose,
                    attachment: None,
                    data: data.clone(),
                };
                Ok((object.id, self.push(object)))
            }
            Change::Move { id, pose } => {
                let place = self.required(*id)?;
                check_planar(&self.object(place).body, pose)?;
                self.note_attached(place, false);
                Ok((*id, place))
            }
            Change::Attach { id, pose, .. } => {
                let place = self.required(*id)?;
                check_planar(&self.object(place).body, pose)?;
                self.note_attached(place, true);
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

fn check_planar(body: &Body, pose: &Pose) -> Result<()> {
    if body.dimension() == 2 && !pose.is_planar() {
        return Err(Error::invalid(
            "a planar body's pose leaves the plane z = 0",
        ));
    }
    Ok(())
}
