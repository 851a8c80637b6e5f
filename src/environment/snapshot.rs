//! One consistent state of an environment, as a query sees it.

use std::sync::Arc;

use super::attachment::Attachment;
use super::object_tree::ObjectTree;
use super::places::{Place, Places, SObject};
use crate::body_bounds::Bounds;
use crate::cow_vec::CowVec;
use crate::index_set::IndexSet;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Pose;

/// One state of an environment. A clone shares with it the memory that neither changes.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Number of sets of changes applied so far; 0 for a new environment.
    pub version: u64,
    /// In order of ids.
    places: Places,
    ids: CowVec<u64, 128>,
    count: usize,
    /// No place below this has an object.
    first: usize,
    /// The tree over the objects that are not attached.
    tree: ObjectTree,
    /// The places of the attached objects, in order.
    attached: Arc<Vec<usize>>,
}

impl Snapshot {
    /// All objects, in order of ids.
    pub fn objects(&self) -> impl Iterator<Item = &SObject> {
        (self.first..self.places.len()).filter_map(|place| self.places[place].object.as_ref())
    }

    /// Number of objects, attached ones included.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is no object.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The object with the lowest id.
    pub fn first(&self) -> Option<&SObject> {
        self.objects().next()
    }

    /// The object with an id.
    pub fn find(&self, id: u64) -> Option<&SObject> {
        self.place_of(id).map(|place| self.object(place))
    }

    /// The object at a place from the tree or from [`Snapshot::place_of`]. Panics for other places.
    #[inline]
    pub fn object(&self, place: usize) -> &SObject {
        let object = self.places[place].object.as_ref();
        object.expect("an object is at each place that is told")
    }

    /// The bounds of that object.
    #[inline(always)]
    pub fn bounds(&self, place: usize) -> &Bounds {
        &self.places[place].bounds
    }

    /// The place of the object with an id.
    pub fn place_of(&self, id: u64) -> Option<usize> {
        // Ids count up, so this guess is right if no id before it is missing.
        let from_first = usize::try_from(id.checked_sub(*self.ids.get(0)?)?);
        let guess = from_first.unwrap_or(usize::MAX).min(self.ids.len() - 1);
        let place = if self.ids[guess] == id {
            guess
        } else {
            self.search(id, guess)?
        };
        self.places[place].object.is_some().then_some(place)
    }

    /// The place of an id at or before a place, by binary search.
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

    /// The tree over the objects; it refers to them by their places.
    pub fn tree(&self) -> &ObjectTree {
        &self.tree
    }

    /// Appends an object, whose id must be the highest. Does not update the tree. Returns its place.
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

    /// The number of places, which exceeds the number of objects after deletions.
    pub(super) fn place_count(&self) -> usize {
        self.places.len()
    }

    /// Records whether the object at a place is attached.
    pub(super) fn note_attached(&mut self, place: usize, is_attached: bool) {
        match self.attached.binary_search(&place) {
            Ok(i) if !is_attached => drop(Arc::make_mut(&mut self.attached).remove(i)),
            Err(i) if is_attached => Arc::make_mut(&mut self.attached).insert(i, place),
            _ => {}
        }
    }

    /// Removes the object from its place. Does not update the tree.
    pub(super) fn take(&mut self, place: usize) {
        self.note_attached(place, false);
        let taken = self.places.get_mut(place).object.take();
        self.count -= usize::from(taken.is_some());
        let is_empty = |place: &Place| place.object.is_none();
        while self.places.get(self.first).is_some_and(is_empty) {
            self.first += 1;
        }
    }

    /// Moves the objects at changed places to the pose and attachment that `target` gives, if it gives any, and updates the
    /// tree.
    pub(super) fn settle<'a>(
        &mut self,
        changed: &IndexSet,
        target: impl Fn(usize) -> Option<(&'a Pose, Option<&'a Attachment>)>,
    ) {
        with_widest(ObjectMoves {
            places: &mut self.places,
            changed,
            target,
        });
        if self.tree.update(changed, &self.places)
            && !self.tree.is_worn(self.count, self.places.len())
        {
            return;
        }
        if self.places.len() > self.count {
            self.close_gaps();
        }
        self.tree = ObjectTree::new(&self.places);
    }

    /// Gives the objects new places without gaps.
    fn close_gaps(&mut self) {
        self.ids = self.objects().map(|object| object.id).collect();
        let occupied = self.places.iter().filter(|place| place.object.is_some());
        self.places = occupied.cloned().collect();
        self.first = 0;
        let is_attached = |place: &usize| self.places[*place].is_attached();
        self.attached = Arc::new((0..self.places.len()).filter(is_attached).collect());
    }

    /// Copies what changed in a state that was cloned from this one, or followed it; but not the poses at the places `to_move`,
    /// which will be moved anyway.
    pub(super) fn follow(&mut self, other: &Self, to_move: &IndexSet) {
        self.version = other.version;
        self.places.follow_by(&other.places, |index, own, now| {
            if !to_move.contains(index) || !own.differs_in_pose_alone(now) {
                own.clone_from(now);
            }
        });
        self.ids.follow(&other.ids);
        (self.count, self.first) = (other.count, other.first);
        self.tree.follow(&other.tree);
        self.attached = other.attached.clone();
    }
}

/// Moves the objects at changed places and computes their bounds.
struct ObjectMoves<'m, F> {
    places: &'m mut Places,
    changed: &'m IndexSet,
    target: F,
}

impl<'a, F> Work for ObjectMoves<'_, F>
where
    F: Fn(usize) -> Option<(&'a Pose, Option<&'a Attachment>)>,
{
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) {
        let target = self.target;
        let mut changed = self.changed.iter().peekable();
        while let Some(mut run) = self.places.next_run(&mut changed) {
            while let Some((index, place)) = run.next() {
                let Some(object) = &mut place.object else {
                    continue;
                };
                if let Some((pose, attachment)) = target(index) {
                    object.pose = *pose;
                    if object.attachment.is_some() || attachment.is_some() {
                        object.attachment = attachment.cloned().map(Arc::new);
                    }
                }
                place.bounds = Bounds::of(lanes, &object.body, &object.pose);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::environment::{Change, Environment};
    use crate::body::BodyBuilder;
    use crate::hierarchy::HierarchyOptions;
    use crate::pose::{Pose, Vec3};

    /// Objects far from all others are strays outside the tree and do not wear it.
    #[test]
    fn far_objects_that_come_and_go_leave_no_places_behind() {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_sphere(&Vec3::zeros(), 0.1, 0).unwrap();
        let options = HierarchyOptions::default();
        let body = Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap());
        let live = Environment::default();
        let add =
            |x: f64| Change::add(body.clone(), Pose::from_translation(Vec3::new(x, 0.0, 0.0)));
        let near: Vec<Change> = (0..8).map(|i| add(f64::from(i))).collect();
        live.apply(&near).unwrap();
        for _ in 0..1000 {
            let (ids, _) = live.apply(&[add(1e6)]).unwrap();
            live.apply(&[Change::Delete { id: ids[0] }]).unwrap();
            assert!(live.snapshot().places.len() <= 2 * 9 + 65);
        }
    }
}
