//! One tree over the bodies of an environment, so that a query asks only those that are near. It goes after the objects as
//! they come, move and go, until it is worn.

use std::sync::Arc;

use super::bounds::{Bounds, slack};
use super::snapshot::{Place, Places};
use super::tree_limits::{FAR, TreeLimits};
use crate::boxes::Extent;
use crate::environment::box_tree::{BoxTree, BoxTreeChanges, Boxes, OrientedBox};
use crate::index_set::IndexSet;
use crate::pair::ROUNDING;

/// If more than one of so many objects leave their neighbours at once, the tree is made anew in haste. With one of ten jumping that
/// took less than half of the time of putting each in alone (`scripts/bench.sh objects --only "jump"`).
const LEAVING: usize = 16;

/// The same for objects that come or go, each of which is put in or taken out once: a guess from the above.
const COMING: usize = 4;

/// Up to one of so many objects are put into the tree anew sooner than many at once: that keeps it tighter, and costs each
/// some times what a refit does.
const FEW: usize = 16;

/// The objects of one state of an environment, by their places in it.
#[derive(Clone, Debug, Default)]
pub struct ObjectTree {
    pub(super) tree: BoxTree,
    /// The objects that are beyond the tree's limits, by their places, in order: each is visited.
    pub(super) strays: Arc<Vec<u32>>,
    limits: TreeLimits,
    /// Of the objects in the tree, now or since it was built; no deviation is larger.
    pub(super) deviation: f64,
    /// No corner of a box was farther from the tree's centre.
    pub(super) radius: f64,
    /// No coordinate of an object, in the world or on its way there, was larger.
    pub(super) largest_coordinate: f64,
    count: usize,
    wear: Wear,
}

/// What became of a tree since it was built.
#[derive(Clone, Copy, Debug, Default)]
struct Wear {
    changes: usize,
    /// Boxes put in and taken out.
    reshapings: usize,
    /// Whether it was made in haste.
    is_hasty: bool,
    /// As they were then.
    count: usize,
    surface: f64,
    strays: usize,
}

impl ObjectTree {
    /// The tree over those objects that are in the world; each place has one.
    pub(super) fn new(places: &Places) -> Self {
        let limits = TreeLimits::of(places);
        let all = (0..places.len() as u32).filter(|&i| places[i as usize].is_in_world());
        let (taken, strays): (Vec<u32>, Vec<u32>) =
            all.partition(|&i| limits.hold(&places[i as usize].bounds));
        let tree = BoxTree::new(&taken, places.len(), places);
        let mut built = Self {
            wear: Wear {
                changes: 0,
                reshapings: 0,
                is_hasty: false,
                count: taken.len() + strays.len(),
                surface: tree.surface(),
                strays: strays.len(),
            },
            count: taken.len() + strays.len(),
            strays: strays.into(),
            tree,
            ..Self::default()
        };
        for &place in &taken {
            built.measure(&places[place as usize].bounds);
        }
        let blur = slack(built.largest_coordinate, built.deviation);
        built.limits = TreeLimits::around(built.tree.frame().center, built.radius, blur);
        built
    }

    /// Takes over what was changed in a tree that was cloned from this one, or followed it.
    pub(super) fn follow(&mut self, other: &Self) {
        self.tree.follow(&other.tree);
        self.strays = other.strays.clone();
        let &Self {
            limits,
            deviation,
            radius,
            largest_coordinate,
            count,
            wear,
            ..
        } = other;
        (self.limits, self.deviation, self.radius) = (limits, deviation, radius);
        (self.largest_coordinate, self.count, self.wear) = (largest_coordinate, count, wear);
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Half the surfaces of the boxes of all nodes below the root: a descent opens about as many nodes as it is large.
    pub fn surface(&self) -> f64 {
        self.tree.surface()
    }

    /// Goes after the objects of some places, which are new, gone, or elsewhere. Boxes that stay about where they were are
    /// refitted, all in one pass; one that leaves its neighbours is put into the tree anew, unless many do: then the tree is made
    /// anew in haste. False where so many come and go that the tree is to be built anew, and is left unfinished.
    pub(super) fn update(&mut self, changed: &IndexSet, places: &Places) -> bool {
        let mut refitted = IndexSet::new(places.len());
        let (mut removed, mut inserted, mut leaving) = (Vec::new(), Vec::new(), Vec::new());
        let is_few = FEW * changed.iter().take(self.count / FEW + 1).count() <= self.count;
        let max_growth = if is_few { 1.1 } else { 1.5 };
        for place in changed.iter() {
            let was_held = self.tree.holds(place);
            let Place { bounds, .. } = &places[place];
            let is_there = places[place].is_in_world();
            let is_held = is_there && self.limits.hold(bounds);
            self.wear.changes += 1;
            let was_stray = self.note_stray(place, is_there && !is_held);
            self.count = self.count + usize::from(is_there) - usize::from(was_held || was_stray);
            if is_held {
                self.measure(bounds);
            }
            match (was_held, is_held) {
                (true, true) => {
                    refitted.insert(place);
                    if self.tree.growth(place, &bounds.extent()) > max_growth {
                        leaving.push(place);
                    }
                }
                (true, false) => removed.push(place),
                (false, true) => inserted.push(place),
                (false, false) => {}
            }
        }
        if 2 * (removed.len() + inserted.len()) > self.count {
            return false;
        }
        let is_many = LEAVING * leaving.len() > self.count
            || COMING * (removed.len() + inserted.len()) > self.count;
        if is_many {
            self.rebuild_in_haste(places);
            return true;
        }
        removed.extend(&leaving);
        inserted.extend(&leaving);
        leaving.iter().for_each(|&place| refitted.remove(place));
        self.wear.reshapings += removed.len() + inserted.len();
        let mut changes = BoxTreeChanges {
            tree: &mut self.tree,
            boxes: places,
        };
        removed.iter().for_each(|&place| changes.remove(place));
        changes.refit(&refitted);
        inserted.iter().for_each(|&place| changes.insert(place));
        true
    }

    /// Makes the tree anew over all objects in the world that are no strays, within the limits it had.
    fn rebuild_in_haste(&mut self, places: &Places) {
        let is_taken = |&place: &u32| {
            places[place as usize].is_in_world() && self.strays.binary_search(&place).is_err()
        };
        let taken: Vec<u32> = (0..places.len() as u32).filter(is_taken).collect();
        self.tree
            .rebuild_in_haste(&taken, places.len(), places, self.limits.ball());
        (self.deviation, self.radius, self.largest_coordinate) = (0.0, 0.0, 0.0);
        for &place in &taken {
            self.measure(&places[place as usize].bounds);
        }
        self.wear = Wear {
            is_hasty: true,
            count: self.count,
            surface: self.tree.surface(),
            strays: self.wear.strays,
            ..Wear::default()
        };
    }

    /// Notes whether the object of a place is a stray; returns whether it was.
    fn note_stray(&mut self, place: usize, is_stray: bool) -> bool {
        let found = self.strays.binary_search(&(place as u32));
        match (found, is_stray) {
            (Ok(at), false) => drop(Arc::make_mut(&mut self.strays).remove(at)),
            (Err(at), true) => Arc::make_mut(&mut self.strays).insert(at, place as u32),
            _ => {}
        }
        found.is_ok()
    }

    /// Whether the tree is to be built anew: after so many changes that each bears a small part of it. `objects` counts those
    /// too that are not in the world, `places` also what was deleted since the places were closed up.
    pub fn is_worn(&self, objects: usize, places: usize) -> bool {
        let Wear {
            changes,
            reshapings,
            is_hasty,
            count,
            surface,
            strays,
        } = self.wear;
        // What is left of far or ill known objects that are gone.
        let size = self.tree.extent().map_or(0.0, Extent::diameter);
        let blur = ROUNDING * self.radius + slack(self.largest_coordinate, self.deviation);
        let is_blurred = blur > 0.5 * FAR * ROUNDING * size;
        let more = (self.count as f64 / count.max(1) as f64).max(1.0);
        let is_loose = self.surface() > 1.3 * more * surface;
        is_blurred && changes > self.count / 16
            || self.strays.len() > strays + self.count / 8
            || (is_loose || is_hasty) && changes > self.count
            || self.count > 2 * count + 8
            || reshapings > 4 * self.count + 64
            || places > 2 * objects + 64
    }

    fn measure(&mut self, bounds: &Bounds) {
        let from_center = (bounds.box_center - self.tree.frame().center).norm();
        self.radius = self.radius.max(from_center + bounds.box_radius);
        let farthest = bounds.box_center.amax() + bounds.box_radius;
        self.largest_coordinate = self
            .largest_coordinate
            .max(bounds.largest_coordinate)
            .max(farthest);
        self.deviation = self.deviation.max(bounds.deviation);
    }
}

impl Boxes for Places {
    #[inline(always)]
    fn extent(&self, place: usize) -> Extent {
        self[place].bounds.extent()
    }

    #[inline(always)]
    fn oriented(&self, place: usize) -> OrientedBox {
        self[place].bounds.oriented_box()
    }
}
