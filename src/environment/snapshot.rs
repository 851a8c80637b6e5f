//! What a query sees of an environment: whole or not at all.

use std::sync::Arc;

use super::{Attachment, Bounds, ObjectTree};
use crate::body::Body;
use crate::cow_vec::CowVec;
use crate::pose::Pose;
use crate::user_data::UserData;

/// An obstacle: a body at a pose.
#[derive(Clone, Debug)]
pub struct SObject {
    /// Never used again after the object is deleted, by any environment of the process.
    pub id: u64,
    pub body: Arc<Body>,
    /// In the world; in the link's frame while it is attached.
    pub pose: Pose,
    pub attachment: Option<Arc<Attachment>>,
    pub data: Option<UserData>,
}

impl SObject {
    /// The number of its data, or of its body's where it has none of its own.
    pub fn data(&self) -> usize {
        match &self.data {
            Some(data) => data.value,
            None => self.body.data(),
        }
    }
}

/// What is at each place.
pub(super) type Places = CowVec<Place, 16>;

#[derive(Clone, Debug, Default)]
pub(super) struct Place {
    /// None for a while after it was deleted.
    pub object: Option<SObject>,
    /// Those of the object, or the last one, when the tree was told.
    pub bounds: Bounds,
}

/// One state of an environment. A clone shares with it what is not changed.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Counts the changes applied, each whole set as one: 0 for a new environment.
    pub version: u64,
    /// In order of ids.
    places: Places,
    ids: CowVec<u64, 128>,
    count: usize,
    /// No object has a place before this.
    first: usize,
    /// Of the objects that are not attached.
    tree: ObjectTree,
    /// The places of those that are, in order.
    attached: Arc<Vec<usize>>,
}

impl Snapshot {
    /// All objects, in order of ids.
    pub fn objects(&self) -> impl Iterator<Item = &SObject> {
        (self.first..self.places.len()).filter_map(|place| self.places[place].object.as_ref())
    }

    pub fn len(&self) -> usize {
        self.count
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The object with the lowest id.
    pub fn first(&self) -> Option<&SObject> {
        self.objects().next()
    }

    pub fn find(&self, id: u64) -> Option<&SObject> {
        self.place_of(id).map(|place| self.object(place))
    }

    /// The object at a place that the tree or [`Snapshot::place_of`] told.
    #[inline]
    pub fn object(&self, place: usize) -> &SObject {
        let object = self.places[place].object.as_ref();
        object.expect("an object is at each place that is told")
    }

    /// What bounds that object.
    #[inline(always)]
    pub fn bounds(&self, place: usize) -> &Bounds {
        &self.places[place].bounds
    }

    /// The place of an object among all.
    pub fn place_of(&self, id: u64) -> Option<usize> {
        // Ids count up, so that an object before which none is missing is found at once.
        let from_first = usize::try_from(id.checked_sub(*self.ids.get(0)?)?);
        let guess = from_first.unwrap_or(usize::MAX).min(self.ids.len() - 1);
        let place = if self.ids[guess] == id {
            guess
        } else {
            self.search(id, guess)?
        };
        self.places[place].object.is_some().then_some(place)
    }

    /// The place of an id before another.
    fn search(&self, id: u64, before: usize) -> Option<usize> {
        let (mut low, mut high) = (0, before);
        while low < high {
            let middle = low + (high - low) / 2;
            if self.ids[middle] < id {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        (self.ids[low] == id).then_some(low)
    }

    /// The tree over the objects, which it names by their places.
    pub fn tree(&self) -> &ObjectTree {
        &self.tree
    }

    /// Appends an object, whose id is higher than all before. The tree is not told. Returns its place.
    pub(super) fn push(&mut self, object: SObject) -> usize {
        self.ids.push(object.id);
        self.places.push(Place {
            object: Some(object),
            bounds: Bounds::default(),
        });
        self.count += 1;
        self.places.len() - 1
    }

    /// The objects that are attached to links, in order of ids.
    pub fn attached(&self) -> impl Iterator<Item = &SObject> {
        self.attached.iter().map(|&place| self.object(place))
    }

    /// Moves the object at a place, attaches it or lets it go. The tree is not told.
    pub(super) fn set_pose(
        &mut self,
        place: usize,
        pose: Pose,
        attachment: Option<Arc<Attachment>>,
    ) {
        let is_attached = attachment.is_some();
        if let Some(object) = &mut self.places.get_mut(place).object {
            object.pose = pose;
            object.attachment = attachment;
        }
        self.note_attached(place, is_attached);
    }

    fn note_attached(&mut self, place: usize, is_attached: bool) {
        match self.attached.binary_search(&place) {
            Ok(i) if !is_attached => drop(Arc::make_mut(&mut self.attached).remove(i)),
            Err(i) if is_attached => Arc::make_mut(&mut self.attached).insert(i, place),
            _ => {}
        }
    }

    /// Takes the object out of its place. The tree is not told.
    pub(super) fn take(&mut self, place: usize) {
        self.note_attached(place, false);
        let taken = self.places.get_mut(place).object.take();
        self.count -= usize::from(taken.is_some());
        let is_empty = |place: &Place| place.object.is_none();
        while self.places.get(self.first).is_some_and(is_empty) {
            self.first += 1;
        }
    }

    /// Tells the tree of changed places, each once.
    pub(super) fn update_tree(&mut self, changed: &[usize]) {
        // Most of the tree at once is built faster than it is changed.
        if 2 * changed.len() < self.count {
            for &place in changed {
                let from = self.places[place].bounds;
                self.places.get_mut(place).measure();
                self.tree.update(place, &from, &self.places);
            }
            if !self.tree.is_worn(self.count) {
                return;
            }
        }
        if self.places.len() > self.count {
            self.ids = self.objects().map(|object| object.id).collect();
        }
        let mut left: Vec<Place> = self
            .places
            .iter()
            .filter(|place| place.object.is_some())
            .cloned()
            .collect();
        left.iter_mut().for_each(Place::measure);
        self.first = 0;
        let is_attached = |place: &usize| left[*place].is_attached();
        self.attached = Arc::new((0..left.len()).filter(is_attached).collect());
        self.tree = ObjectTree::new(&left);
        self.places = left.into_iter().collect();
    }
}

impl Place {
    fn is_attached(&self) -> bool {
        let object = self.object.as_ref();
        object.is_some_and(|object| object.attachment.is_some())
    }

    /// Whether the tree holds what is here.
    pub fn is_in_world(&self) -> bool {
        self.object.is_some() && !self.is_attached()
    }

    fn measure(&mut self) {
        if let Some(object) = &self.object {
            self.bounds = Bounds::of(&object.body, &object.pose);
        }
    }
}
