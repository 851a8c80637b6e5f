//! The set of s-objects that changes while queries run.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::attachment::Attachment;
use super::places::SObject;
use super::snapshot::Snapshot;
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};
use crate::index_set::IndexSet;
use crate::pose::Pose;
use crate::user_data::UserData;

/// One change of an environment.
#[derive(Clone, Debug)]
pub enum Change {
    /// Adds an object.
    Add(Addition),
    /// Places an object in the world; an attached one is detached.
    Move {
        /// The object's id.
        id: u64,
        /// The new pose in the world.
        pose: Pose,
    },
    /// Fixes an object to a link.
    Attach {
        /// The object's id.
        id: u64,
        /// The pose in the link's frame.
        pose: Pose,
        /// The link, and the links that may touch the object.
        attachment: Attachment,
    },
    /// Deletes an object.
    Delete {
        /// The object's id.
        id: u64,
    },
}

/// An object to add.
#[derive(Clone, Debug)]
pub struct Addition {
    /// The body, which the object keeps alive.
    pub body: Arc<Body>,
    /// The body's pose: in the world, or, of an object that comes attached, in the link's frame.
    pub pose: Pose,
    /// What it comes attached to, if anything.
    pub attachment: Option<Attachment>,
    /// Its name, if it has one; others may have the same.
    pub name: Option<Arc<str>>,
    /// The caller's data, if any.
    pub data: Option<UserData>,
}

impl Addition {
    /// A body in the world.
    pub fn new(body: Arc<Body>, pose: Pose) -> Self {
        Self {
            body,
            pose,
            attachment: None,
            name: None,
            data: None,
        }
    }
}

/// A set of s-objects that several threads may query while it changes: a query sees the state before a change or after
/// it. A frozen environment never changes.
#[derive(Debug)]
pub struct Environment {
    serial: u64,
    frozen: bool,
    /// Locked during a whole change, so that `state` is only locked briefly.
    writer: Mutex<Writer>,
    state: Mutex<Arc<Snapshot>>,
}

/// Memory that is reused from one change to the next.
#[derive(Debug, Default)]
struct Writer {
    /// The state before the last change. It becomes the next one if nobody else holds it: only the differences are copied, and
    /// nothing is allocated. It holds no deleted object.
    spare: Option<Arc<Snapshot>>,
    /// Per changed place, the index of the last change to it.
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

    /// A number that no other environment of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// The current state.
    pub fn snapshot(&self) -> Arc<Snapshot> {
        // A snapshot is replaced as a whole, so a panic elsewhere cannot have left it half changed.
        self.state
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// A frozen environment with the current state.
    pub fn freeze(&self) -> Self {
        Self::with_state(self.snapshot(), true)
    }

    /// Applies all changes atomically, or none of them. Returns the id of each change's object, and the new version.
    ///
    /// Takes time proportional to the number of changes times the logarithm of the number of objects, amortized over rebuilds
    /// of the tree over the objects; plus one pass over a bit array, 64 objects per word. Readers do not wait for it.
    pub fn apply(&self, changes: &[Change]) -> Result<(Vec<u64>, u64)> {
        if self.frozen {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "the environment is a snapshot; it cannot be changed",
            ));
        }
        // Declared before the locks and so dropped after them: freeing objects runs functions of the caller.
        let _dropped_last;
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
            _dropped_last = before;
        } else {
            *spare = Some(before);
        }
        Ok((ids, version))
    }
}

impl Change {
    /// Adds a body at a pose in the world.
    pub fn add(body: Arc<Body>, pose: Pose) -> Self {
        Self::Add(Addition::new(body, pose))
    }

    /// The object's new pose and attachment, if it is moved.
    fn target(&self) -> Option<(&Pose, Option<&Attachment>)> {
        match self {
            Change::Move { pose, .. } => Some((pose, None)),
            Change::Attach {
                pose, attachment, ..
            } => Some((pose, Some(attachment))),
            Change::Add(_) | Change::Delete { .. } => None,
        }
    }
}

/// A copy of the state before the changes: the spare one brought up to date if nobody else holds it, otherwise a clone. The
/// poses of objects that the changes move may be out of date.
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
    /// Checks a change, and adds or deletes its object; [`Snapshot::settle`] does the moves. Returns the id and the place of
    /// the object.
    fn change(&mut self, change: &Change) -> Result<(u64, usize)> {
        match change {
            Change::Add(Addition {
                body,
                pose,
                attachment,
                name,
                data,
            }) => {
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
                    attachment: attachment.clone().map(Arc::new),
                    name: name.clone(),
                    data: data.clone(),
                };
                let (id, is_attached) = (object.id, object.attachment.is_some());
                let place = self.push(object);
                self.note_attached(place, is_attached);
                Ok((id, place))
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
