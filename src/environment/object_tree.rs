//! The broad phase: one tree over the objects of an environment, so that a query tests only near ones. It is updated as
//! objects are added, moved and deleted, and rebuilt when it has degraded.

use std::sync::Arc;

use super::places::{Place, Places};
use super::tree_limits::{FAR, TreeLimits};
use crate::body_bounds::{Bounds, slack};
use crate::boxes::Extent;
use crate::environment::box_tree::{BOX, BoxTree, BoxTreeChanges, Boxes, OrientedBox};
use crate::index_set::IndexSet;
use crate::pair::ROUNDING;

/// If more than 1 in this many objects leave their nodes in one update, the tree is rebuilt in haste. With 1 in 10 jumping,
/// that took less than half the time of reinserting each (`scripts/bench.sh objects --only "jump"`).
const LEAVING: usize = 16;

/// If more than 1 in this many objects are added or deleted in one update, the tree is rebuilt in haste. This is a guess: such
/// a change costs less than the reinsertions measured for [`LEAVING`], of which each is a removal and an insertion.
const COMING: usize = 4;

/// If at most 1 in this many objects changes, objects are reinserted at a smaller growth of their nodes than otherwise. That
/// keeps the tree tighter, but a reinsertion costs several times a refit.
const FEW: usize = 16;

/// An object is reinserted if its node would grow by more than this factor: where few objects change, and where many do. A
/// larger factor reinserts less and leaves larger nodes, which queries open more often.
const MAX_GROWTH: [f64; 2] = [1.1, 1.5];

/// A tree is rebuilt if its nodes have more than this many times the surface that they would have by the growth of the number
/// of objects. A smaller value rebuilds more often, a larger one leaves a tree of which queries open more nodes.
const MAX_LOOSENESS: f64 = 1.3;

/// The tree over the objects of one snapshot; it refers to them by their places.
#[derive(Clone, Debug, Default)]
pub struct ObjectTree {
    pub(super) tree: BoxTree,
    /// The places of the objects beyond the tree's limits, in order. Queries visit each of them.
    pub(super) strays: Arc<Vec<u32>>,
    limits: TreeLimits,
    /// The largest deviation of an object in the tree since it was built.
    pub(super) deviation: f64,
    /// The largest distance of a box's corner from the tree's centre since it was built.
    pub(super) radius: f64,
    /// The largest coordinate of an object, in its bounds or in their computation, since the tree was built.
    pub(super) largest_coordinate: f64,
    count: usize,
    wear: Wear,
}

/// How much a tree has changed since it was built; decides when it is rebuilt.
#[derive(Clone, Copy, Debug, Default)]
struct Wear {
    changes: usize,
    /// Number of boxes inserted and removed.
    reshapings: usize,
    /// Whether it was built in haste.
    is_hasty: bool,
    /// The values when it was built.
    count: usize,
    surface: f64,
    strays: usize,
}

impl ObjectTree {
    /// The tree over the objects in the world; every place must have an object.
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
        let slack = slack(built.largest_coordinate, built.deviation);
        built.limits = TreeLimits::around(built.tree.frame().center, built.radius, slack);
        built
    }

    /// Becomes equal to `other`, which was cloned from this tree, or followed it, and was then changed. Copies only what
    /// changed.
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

    /// Whether there is no object, in the tree or a stray.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether the root has nodes below it.
    pub fn has_several_nodes(&self) -> bool {
        self.tree.root().is_some_and(|root| {
            let wide = &self.tree.node(root).wide;
            let children = &wide.children[..wide.count as usize];
            children.iter().any(|child| child & BOX == 0)
        })
    }

    /// The sum of half the surfaces of all nodes below the root; a traversal opens a number of nodes about proportional to it.
    pub fn surface(&self) -> f64 {
        self.tree.surface()
    }

    /// Updates the tree for places whose objects were added, deleted or moved. Boxes that stay about where they were are
    /// refitted, all in one pass; boxes that make their node grow too much are reinserted. If many do, the tree is rebuilt in
    /// haste. Returns false if so many were added or deleted that the caller must rebuild the tree, which is left invalid.
    pub(super) fn update(&mut self, changed: &IndexSet, places: &Places) -> bool {
        let mut refitted = IndexSet::new(places.len());
        let (mut removed, mut inserted, mut leaving) = (Vec::new(), Vec::new(), Vec::new());
        let is_few = FEW * changed.iter().take(self.count / FEW + 1).count() <= self.count;
        let max_growth = MAX_GROWTH[usize::from(!is_few)];
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

    /// Rebuilds the tree quickly over all objects in the world that are not strays; keeps its limits.
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

    /// Records whether the object of a place is a stray; returns whether it was.
    fn note_stray(&mut self, place: usize, is_stray: bool) -> bool {
        let found = self.strays.binary_search(&(place as u32));
        match (found, is_stray) {
            (Ok(at), false) => drop(Arc::make_mut(&mut self.strays).remove(at)),
            (Err(at), true) => Arc::make_mut(&mut self.strays).insert(at, place as u32),
            _ => {}
        }
        found.is_ok()
    }

    /// Whether the tree should be rebuilt. That takes changes in proportion to the number of objects, so that the amortized
    /// cost of a change stays small; smaller fractions rebuild more often. `objects` includes attached objects; `places`
    /// includes the places of objects that were deleted since the gaps were closed.
    pub fn is_worn(&self, objects: usize, places: usize) -> bool {
        let Wear {
            changes,
            reshapings,
            is_hasty,
            count,
            surface,
            strays,
        } = self.wear;
        // Objects that were far away or imprecise, and are gone, have left a large slack.
        let size = self.tree.extent().map_or(0.0, Extent::diameter);
        let slack = ROUNDING * self.radius + slack(self.largest_coordinate, self.deviation);
        let has_large_slack = slack > 0.5 * FAR * ROUNDING * size;
        let count_growth = (self.count as f64 / count.max(1) as f64).max(1.0);
        let is_loose = self.surface() > MAX_LOOSENESS * count_growth * surface;
        has_large_slack && changes > self.count / 16
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
        let bounds = &self[place].bounds;
        OrientedBox {
            center: bounds.box_center,
            axes: bounds.axes,
            half: bounds.half,
        }
    }
}
