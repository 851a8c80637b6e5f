//! The places of an environment's objects: an object keeps its place as long as it exists.

use std::sync::Arc;

use super::attachment::Attachment;
use crate::body::Body;
use crate::body_bounds::Bounds;
use crate::cow_vec::CowVec;
use crate::pose::Pose;
use crate::user_data::UserData;

/// An obstacle: a body at a pose.
#[derive(Clone, Debug)]
pub struct SObject {
    /// Never reused by any environment of the process, even after the object is deleted.
    pub id: u64,
    /// The body, which the object keeps alive.
    pub body: Arc<Body>,
    /// In the world; in the link's frame while it is attached.
    pub pose: Pose,
    /// The link it is fixed to, if it is attached.
    pub attachment: Option<Arc<Attachment>>,
    /// Its name, if it has one; others may have the same.
    pub name: Option<Arc<str>>,
    /// The caller's data, if any.
    pub data: Option<UserData>,
}

impl SObject {
    /// The value of its data, or of its body's data if it has none.
    pub fn data(&self) -> usize {
        match &self.data {
            Some(data) => data.value,
            None => self.body.data(),
        }
    }
}

/// The places of a snapshot, each for one object.
pub(super) type Places = CowVec<Place, 16>;

#[derive(Debug, Default)]
pub(super) struct Place {
    /// `None` after the object was deleted, until the gaps are closed.
    pub object: Option<SObject>,
    /// The bounds of the object, or of the last one.
    pub bounds: Bounds,
}

impl Clone for Place {
    fn clone(&self) -> Self {
        Self {
            object: self.object.clone(),
            bounds: self.bounds,
        }
    }

    fn clone_from(&mut self, other: &Self) {
        match (&mut self.object, &other.object) {
            // The body, the name and the data of an id never change.
            (Some(own), Some(now)) if own.id == now.id => {
                own.pose = now.pose;
                if own.attachment.is_some() || now.attachment.is_some() {
                    own.attachment = now.attachment.clone();
                }
            }
            (own, now) => *own = now.clone(),
        }
        self.bounds = other.bounds;
    }
}

impl Place {
    pub fn differs_in_pose_alone(&self, other: &Self) -> bool {
        match (&self.object, &other.object) {
            (Some(own), Some(now)) => {
                own.id == now.id && own.attachment.is_none() && now.attachment.is_none()
            }
            _ => false,
        }
    }

    pub fn is_attached(&self) -> bool {
        let object = self.object.as_ref();
        object.is_some_and(|object| object.attachment.is_some())
    }

    /// Whether the object here belongs to the tree.
    pub fn is_in_world(&self) -> bool {
        self.object.is_some() && !self.is_attached()
    }
}
