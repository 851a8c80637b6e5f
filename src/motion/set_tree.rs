//! A C-object as a tree of unions and intersections over its leaves, with complements moved down to the leaves, and what is known of
//! it over an interval of a motion.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use foldhash::fast::RandomState;

use crate::cobject::{Around, CObject, Class, ConvexSets, KnownClass, PureSet, Set};
use crate::query::{Composition, Group, composition};
use crate::space::Space;

/// What is known of a set over an interval of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SetVerdict {
    /// Through the interval the motion stays out of it.
    Free,
    /// At the middle of the interval the motion is in it.
    Meets,
    /// Neither is known.
    Undecided,
}

/// A leaf of the tree.
#[derive(Clone, Copy)]
pub(super) struct SetLeaf<'a> {
    pub content: LeafContent<'a>,
    /// Stands for the complement.
    pub complement: bool,
}

#[derive(Clone, Copy)]
pub(super) enum LeafContent<'a> {
    /// A union of induced sets.
    Induced(&'a Group),
    Pure(&'a PureSet),
    /// Where the caller knows the class of another part.
    Known(&'a Arc<ConvexSets>),
}

#[derive(Debug)]
enum Node {
    Leaf(u32),
    /// The union of nodes, at these places in the list of children.
    Any(Range<usize>),
    /// The intersection.
    All(Range<usize>),
}

/// A C-object as a tree over leaves. What several sets share stands once.
#[derive(Default)]
pub(super) struct SetTree<'a> {
    /// Children before parents; the root is the last.
    nodes: Vec<Node>,
    children: Vec<u32>,
    pub leaves: Vec<SetLeaf<'a>>,
    /// Has leaves for what is known; else they are left out.
    uses_known: bool,
}

/// The nodes of sets by serial and whether the complement is meant.
type Memo = HashMap<(u64, bool), u32, RandomState>;

impl<'a> SetTree<'a> {
    /// With leaves for what the caller knows of the set, if `uses_known`.
    pub fn new(cobject: &'a CObject, uses_known: bool) -> Self {
        match cobject.set() {
            // The common case takes no list of what was seen.
            Set::Union { induced, others } if others.is_empty() => Self::of_group(induced),
            _ => {
                let mut tree = Self {
                    uses_known,
                    ..Self::default()
                };
                tree.add(cobject, false, &mut Memo::default());
                tree
            }
        }
    }

    /// The complement of a set.
    pub fn of_complement(cobject: &'a CObject) -> Self {
        let mut tree = Self {
            uses_known: true,
            ..Self::default()
        };
        tree.add(cobject, true, &mut Memo::default());
        tree
    }

    /// A union of one induced set.
    pub fn of_group(group: &'a Group) -> Self {
        let mut tree = Self::default();
        tree.add_leaf(LeafContent::Induced(group), false);
        tree
    }

    /// Whether the set is a union of leaves that are no complements: what meets one of them meets the set.
    pub fn is_plain_union(&self) -> bool {
        let is_union = |node: &Node| !matches!(node, Node::All(_));
        self.nodes.iter().all(is_union) && self.leaves.iter().all(|leaf| !leaf.complement)
    }

    /// Whether the caller's word alone keeps configurations out of the set.
    pub fn is_free_by_word(&self, space: &Space, around: &Around) -> bool {
        let over = |leaf: &SetLeaf| match leaf.content {
            LeafContent::Known(sets) => {
                verdict_over(sets, leaf.complement, space, around, around.q)
            }
            _ => SetVerdict::Undecided,
        };
        let leaves: Vec<SetVerdict> = self.leaves.iter().map(over).collect();
        leaves.contains(&SetVerdict::Free)
            && self.verdict(&leaves, &mut Vec::new()) == SetVerdict::Free
    }

    /// What is known of the set, given what is known of its leaves.
    pub fn verdict(&self, leaves: &[SetVerdict], memory: &mut Vec<SetVerdict>) -> SetVerdict {
        memory.clear();
        for node in &self.nodes {
            let verdict = match node {
                Node::Leaf(leaf) => leaves[*leaf as usize],
                Node::Any(children) => decide(
                    &self.children[children.clone()],
                    memory,
                    [SetVerdict::Meets, SetVerdict::Free],
                ),
                Node::All(children) => decide(
                    &self.children[children.clone()],
                    memory,
                    [SetVerdict::Free, SetVerdict::Meets],
                ),
            };
            memory.push(verdict);
        }
        *memory.last().expect("a set has a node")
    }

    fn add(&mut self, cobject: &'a CObject, complement: bool, memo: &mut Memo) -> u32 {
        let key = (cobject.serial(), complement);
        if let Some(node) = memo.get(&key) {
            return *node;
        }
        let node = match cobject.set() {
            Set::Pure(set) => self.add_leaf(LeafContent::Pure(set), complement),
            Set::Complement(part) => self.add(part, !complement, memo),
            Set::Known(known) if !self.uses_known => self.add(&known.of, complement, memo),
            Set::Known(known) => self.add_known(known, complement, memo),
            set => {
                let (is_any, group, parts) = match composition(set, complement) {
                    Composition::Any(group, parts) => (true, group, parts),
                    Composition::All(group, parts) => (false, group, parts),
                };
                let mut children: Vec<u32> = Vec::with_capacity(parts.len() + 1);
                if let Some(group) = group {
                    children.push(self.add_leaf(LeafContent::Induced(group), complement));
                }
                for part in parts {
                    children.push(self.add(part, complement, memo));
                }
                let first = self.children.len();
                self.children.extend(children);
                let children = first..self.children.len();
                self.push(if is_any {
                    Node::Any(children)
                } else {
                    Node::All(children)
                })
            }
        };
        memo.insert(key, node);
        node
    }

    /// What is known to be outside is taken from the set, what is known to be inside is added to it.
    fn add_known(&mut self, known: &'a KnownClass, complement: bool, memo: &mut Memo) -> u32 {
        let is_taken = known.class == Class::Outside;
        let leaf = LeafContent::Known(&known.within);
        let sets = self.add_leaf(leaf, complement != is_taken);
        let of = self.add(&known.of, complement, memo);
        let first = self.children.len();
        self.children.extend([sets, of]);
        let children = first..self.children.len();
        self.push(if is_taken != complement {
            Node::All(children)
        } else {
            Node::Any(children)
        })
    }

    fn add_leaf(&mut self, content: LeafContent<'a>, complement: bool) -> u32 {
        self.leaves.push(SetLeaf {
            content,
            complement,
        });
        self.push(Node::Leaf(self.leaves.len() as u32 - 1))
    }

    fn push(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }
}

/// What is known of a union of convex sets, or of its complement, over configurations around one, with the class at `middle`.
pub(super) fn verdict_over(
    sets: &ConvexSets,
    complement: bool,
    space: &Space,
    around: &Around,
    middle: &[f64],
) -> SetVerdict {
    let is_free = match complement {
        true => sets.contain(space, around),
        false => sets.are_apart(space, around),
    };
    let middle = &Around {
        q: middle,
        half: &[],
        is_line: true,
    };
    if is_free {
        SetVerdict::Free
    } else if sets.contain(space, middle) != complement {
        SetVerdict::Meets
    } else {
        SetVerdict::Undecided
    }
}

/// `one` if it is known of some child, `all` if it is known of every child.
fn decide(children: &[u32], verdicts: &[SetVerdict], [one, all]: [SetVerdict; 2]) -> SetVerdict {
    let mut is_all = true;
    for child in children {
        let child = verdicts[*child as usize];
        if child == one {
            return one;
        }
        is_all &= child == all;
    }
    if is_all { all } else { SetVerdict::Undecided }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The truth table of a difference, and of its complement.
    #[test]
    fn parts_decide_the_whole() {
        use SetVerdict::{Free, Meets, Undecided};
        for (states, any, all) in [
            ([Free, Free], Free, Free),
            ([Free, Meets], Meets, Free),
            ([Free, Undecided], Undecided, Free),
            ([Meets, Meets], Meets, Meets),
            ([Meets, Undecided], Meets, Undecided),
            ([Undecided, Undecided], Undecided, Undecided),
        ] {
            for states in [states, [states[1], states[0]]] {
                assert_eq!(decide(&[0, 1], &states, [Meets, Free]), any);
                assert_eq!(decide(&[0, 1], &states, [Free, Meets]), all);
            }
        }
        assert_eq!(decide(&[], &[], [Meets, Free]), Free);
        assert_eq!(decide(&[], &[], [Free, Meets]), Meets);
    }
}
