//! The tree made anew in haste: each set of boxes is halved at the median of their centres.

use super::box_split::FULL;
use super::box_tree::{BOX, BoxFrame, BoxTree, Boxes, NOWHERE, OrientedBox};
use crate::boxes::Extent;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;

impl BoxTree {
    /// Makes the tree anew over some of `places` boxes, in the memory it has. Takes a small part of the time that
    /// [`BoxTree::new`] takes; the boxes of nodes overlap more. Boxes that come later are within `radius` of a centre.
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

/// A node to be made. Children that are nodes have later plans, by whose places they are named.
struct Plan {
    children: [u32; FULL],
    count: usize,
    parent: u32,
}

/// The frame in which the boxes have a size, and what comes later none that single precision does not hold.
fn frame_around(
    taken: &[u32],
    boxes: &impl Boxes,
    (center, radius): (Vec3, f64),
) -> (BoxFrame, Vec<Center>) {
    const LEAST: f64 = 1.0 / (1u64 << 60) as f64;
    let all = || taken.iter().map(|&place| boxes.oriented(place as usize));
    let point = |given: OrientedBox| Extent {
        low: given.center,
        high: given.center,
    };
    let Some(around) = all().map(point).reduce(|all, own| all.union(&own)) else {
        return (BoxFrame::new(center, radius), Vec::new());
    };
    let largest = all().map(|given| given.half.amax()).fold(0.0, f64::max);
    let size = around.size().amax().max(largest);
    let frame = BoxFrame::new(around.center(), size.max(LEAST * radius));
    let local = |(&place, given): (&u32, OrientedBox)| Center {
        at: ((given.center - frame.center) / frame.scale)
            .map(|x| x as f32)
            .into(),
        place,
    };
    let centers = taken.iter().zip(all()).map(local).collect();
    (frame, centers)
}

/// Plans the node over some boxes and all below it. Returns its name.
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
    // All leaves are on one level, and nodes as full as they can be.
    let mut below = FULL;
    while FULL * below < centers.len() {
        below *= FULL;
    }
    let parts = centers.len().div_ceil(below);
    share(centers, parts, &mut |part| {
        let child = plan(part, name, plans);
        add_child(&mut plans[name as usize], child);
    });
    name
}

fn add_child(plan: &mut Plan, child: u32) {
    plan.children[plan.count] = child;
    plan.count += 1;
}

/// Cuts a set into parts of about the same number, across its longest side each time.
fn share(centers: &mut [Center], parts: usize, visit: &mut dyn FnMut(&mut [Center])) {
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
    share(left, first, visit);
    share(right, parts - first, visit);
}

/// Nodes as they are made from plans, those below others first.
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
        let mut above = vec![NOWHERE; places];
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
                    above[(child & !BOX) as usize] = name as u32;
                }
                extents[name] = whole;
                *surface += whole.half_surface();
            }
        }
        tree.parents.resize(plans.len());
        let parents = (0..plans.len()).map(|name| plans[name].parent);
        tree.parents.set_all(parents);
        tree.above.resize(places);
        tree.above.set_all(above);
    }
}

#[inline(always)]
fn extent_of(child: u32, extents: &[Extent], boxes: &impl Boxes) -> Extent {
    match child & BOX {
        0 => extents[child as usize],
        _ => boxes.extent((child & !BOX) as usize),
    }
}
