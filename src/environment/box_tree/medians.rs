//! Rebuilds the tree in haste: each set of boxes is split at the median of the centres.

use super::box_split::FULL;
use super::box_tree::{BOX, BoxTree, Boxes, NOWHERE, TreeFrame};
use super::oriented_box::OrientedBox;
use crate::boxes::Extent;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;

impl BoxTree {
    /// Rebuilds the tree over the boxes `taken` in the memory it has; places are below `places`. Takes a small fraction of the
    /// time of [`BoxTree::new`], but the nodes' boxes overlap more. Boxes inserted later must be within `radius` of `center`.
    pub fn rebuild_in_haste(
        &mut self,
        taken: &[u32],
        places: usize,
        boxes: &impl Boxes,
        (center, radius): (Vec3, f64),
    ) {
        let (frame, mut centers) = frame_around(taken, boxes, (center, radius));
        let mut plans = Vec::with_capacity(taken.len() / 4 + 1);
        if !centers.is_empty() {
            plan(&mut centers, NOWHERE, &mut plans);
        }
        (self.frame, self.surface) = (frame, 0.0);
        self.root = (!plans.is_empty()).then_some(0);
        with_widest(TreeFilling {
            tree: self,
            plans: &plans,
            places,
            boxes,
        });
    }
}

/// The place of a box, and its centre in the units of the frame.
#[derive(Clone, Copy)]
struct Center {
    at: [f32; 3],
    place: u32,
}

/// A node to be built. A child that is a node is named by the index of its plan, which comes later.
struct Plan {
    children: [u32; FULL],
    count: usize,
    parent: u32,
}

/// The frame of the tree, and the boxes' centres in it. Its scale suits the boxes, and is large enough that later boxes
/// within `radius` stay in the range of single precision.
fn frame_around(
    taken: &[u32],
    boxes: &impl Boxes,
    (center, radius): (Vec3, f64),
) -> (TreeFrame, Vec<Center>) {
    const LEAST: f64 = 1.0 / (1u64 << 60) as f64;
    let all = || taken.iter().map(|&place| boxes.oriented(place as usize));
    let point = |given: OrientedBox| Extent {
        low: given.center,
        high: given.center,
    };
    let Some(around) = all().map(point).reduce(|all, own| all.union(&own)) else {
        return (TreeFrame::new(center, radius), Vec::new());
    };
    let largest = all().map(|given| given.half.amax()).fold(0.0, f64::max);
    let size = around.size().amax().max(largest);
    let frame = TreeFrame::new(around.center(), size.max(LEAST * radius));
    let local = |(&place, given): (&u32, OrientedBox)| Center {
        at: ((given.center - frame.center) / frame.scale)
            .map(|x| x as f32)
            .into(),
        place,
    };
    let centers = taken.iter().zip(all()).map(local).collect();
    (frame, centers)
}

/// Plans the node over some boxes and all nodes below it. Returns its name.
fn plan(centers: &mut [Center], parent: u32, plans: &mut Vec<Plan>) -> u32 {
    let name = plans.len() as u32;
    plans.push(Plan {
        children: [NOWHERE; FULL],
        count: 0,
        parent,
    });
    if centers.len() <= FULL {
        for center in centers.iter() {
            add_child(&mut plans[name as usize], center.place | BOX);
        }
        return name;
    }
    // All boxes are on one level, and the nodes as full as possible.
    let mut below = FULL;
    while FULL * below < centers.len() {
        below *= FULL;
    }
    let parts = centers.len().div_ceil(below);
    split_evenly(centers, parts, &mut |part| {
        let child = plan(part, name, plans);
        add_child(&mut plans[name as usize], child);
    });
    name
}

fn add_child(plan: &mut Plan, child: u32) {
    plan.children[plan.count] = child;
    plan.count += 1;
}

/// Splits a set into parts of about equal counts, each time across its longest side.
fn split_evenly(centers: &mut [Center], parts: usize, visit: &mut dyn FnMut(&mut [Center])) {
    if parts == 1 {
        return visit(centers);
    }
    let (mut low, mut high) = (centers[0].at, centers[0].at);
    for center in centers.iter() {
        for k in 0..3 {
            low[k] = low[k].min(center.at[k]);
            high[k] = high[k].max(center.at[k]);
        }
    }
    let size = |k: &usize| high[*k] - low[*k];
    let axis = (0..3)
        .max_by(|i, j| size(i).total_cmp(&size(j)))
        .unwrap_or(0);
    let first = parts / 2;
    let middle = centers.len() * first / parts;
    centers.select_nth_unstable_by(middle, |a, b| {
        let order = a.at[axis].total_cmp(&b.at[axis]);
        order.then(a.place.cmp(&b.place))
    });
    let (left, right) = centers.split_at_mut(middle);
    split_evenly(left, first, visit);
    split_evenly(right, parts - first, visit);
}

/// Fills the nodes from their plans, children before parents.
struct TreeFilling<'t, 'p, B> {
    tree: &'t mut BoxTree,
    plans: &'p [Plan],
    places: usize,
    boxes: &'p B,
}

impl<B: Boxes> Work for TreeFilling<'_, '_, B> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) {
        let Self {
            tree,
            plans,
            places,
            boxes,
        } = self;
        let mut box_parents = vec![NOWHERE; places];
        let mut extents = vec![Extent::default(); plans.len()];
        let (frame, surface) = (tree.frame, &mut tree.surface);
        tree.nodes.resize(plans.len());
        let mut names = (0..plans.len()).rev().peekable();
        while let Some(mut run) = tree.nodes.next_run(&mut names) {
            while let Some((name, node)) = run.next() {
                let plan = &plans[name];
                let children = &plan.children[..plan.count];
                let mut whole = extent_of(children[0], &extents, boxes);
                for &child in &children[1..] {
                    whole = whole.union(&extent_of(child, &extents, boxes));
                }
                node.extent = whole;
                node.wide = frame.packed(children, &whole, |lane| match children[lane] {
                    child if child & BOX == 0 => OrientedBox::from(&extents[child as usize]),
                    child => boxes.oriented((child & !BOX) as usize),
                });
                for &child in children.iter().filter(|&&child| child & BOX != 0) {
                    box_parents[(child & !BOX) as usize] = name as u32;
                }
                extents[name] = whole;
                *surface += whole.half_surface();
            }
        }
        tree.parents.resize(plans.len());
        let parents = (0..plans.len()).map(|name| plans[name].parent);
        tree.parents.set_all(parents);
        tree.box_parents.resize(places);
        tree.box_parents.set_all(box_parents);
    }
}

#[inline(always)]
fn extent_of(child: u32, extents: &[Extent], boxes: &impl Boxes) -> Extent {
    match child & BOX {
        0 => extents[child as usize],
        _ => boxes.extent((child & !BOX) as usize),
    }
}
