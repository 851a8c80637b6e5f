//! Explains a class: which leaves of a C-object's tree, and which primitive pairs, decide it (§2.2.4, operations 4 and 5).

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::answer::WitnessList;
use super::context::QueryContext;
use super::scene::{Configuration, Group, Scene};
use super::witnesses::{WitnessRequest, pure_witnesses};
use crate::cobject::{CObject, Class, Leaf, PureSet, Set};
use crate::error::Result;

/// The class of one leaf, and its part in the class of the whole.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// The leaf.
    pub leaf: Leaf,
    /// The class with respect to the leaf itself.
    pub class: Class,
    /// Whether the tree takes the leaf's complement.
    pub complemented: bool,
    /// Whether the class of the whole rests on this leaf: the leaf and every part above it have the class of the union or
    /// intersection that they belong to.
    pub decisive: bool,
    /// Index of the first witness of the leaf's class, a pair that meets or is in contact. Only decisive leaves have any.
    pub first_witness: usize,
    /// The number of its witnesses.
    pub witness_count: usize,
}

/// A class with its reasons.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The class of the whole.
    pub class: Class,
    /// Every leaf; twice if both it and its complement are used.
    pub leaves: Vec<Verdict>,
    /// The witnesses of all decisive leaves.
    pub list: WitnessList,
}

/// A leaf of the tree, in the form that queries take.
#[derive(Clone, Copy)]
enum LeafQuery<'a> {
    Induced(&'a Group),
    Pure(&'a PureSet),
}

impl LeafQuery<'_> {
    fn leaf(&self) -> Leaf {
        match self {
            Self::Induced(group) => group[0].leaf,
            Self::Pure(set) => set.leaf,
        }
    }
}

/// The classes of all parts, by serial and whether that they are inside is to be proved (see `class_of_group`).
struct Classes<'a> {
    scene: &'a Scene<'a>,
    leaves: HashMap<(u64, bool), Class>,
    compounds: HashMap<(u64, bool), Class>,
}

impl QueryContext {
    /// The class of a configuration, the leaves that decide it, and at most `max_count` witnesses.
    pub fn explain(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        max_count: usize,
    ) -> Result<Explanation> {
        let world = self.look(cobject);
        self.with_scene(cobject, &world, at, |context, scene| {
            context.explanation(cobject, scene, max_count)
        })
    }

    fn explanation(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        max_count: usize,
    ) -> Result<Explanation> {
        let mut classes = Classes {
            scene,
            leaves: HashMap::new(),
            compounds: HashMap::new(),
        };
        let class = self.class_of_all(cobject, false, &mut classes)?;
        let mut explanation = Explanation {
            class,
            leaves: Vec::new(),
            list: WitnessList {
                version: scene.version(),
                ..WitnessList::default()
            },
        };
        for (query, complemented, decisive) in verdicts(cobject, &classes) {
            let leaf = query.leaf();
            let class = classes.leaves[&(leaf.serial, complemented)];
            let first_witness = explanation.list.witnesses.len();
            if decisive {
                let room = max_count - first_witness;
                let list = self.reasons(query, class, room, complemented, scene)?;
                explanation.list.truncated |= list.truncated;
                for witness in &list.witnesses {
                    explanation.list.take(&list, witness);
                }
            }
            explanation.leaves.push(Verdict {
                leaf,
                class,
                complemented,
                decisive,
                first_witness,
                witness_count: explanation.list.witnesses.len() - first_witness,
            });
        }
        Ok(explanation)
    }

    /// Classifies a part and all below it, without early out.
    fn class_of_all(
        &mut self,
        cobject: &CObject,
        is_proved: bool,
        classes: &mut Classes,
    ) -> Result<Class> {
        let key = (cobject.serial(), is_proved);
        if let Some(class) = classes.compounds.get(&key) {
            return Ok(*class);
        }
        let mut parts = Vec::new();
        for query in own_leaves(cobject) {
            let own = (query.leaf().serial, is_proved);
            let class = match classes.leaves.get(&own) {
                Some(class) => *class,
                None => match query {
                    LeafQuery::Induced(group) => {
                        self.class_of_group(group, classes.scene, is_proved)?
                    }
                    LeafQuery::Pure(set) => {
                        set.classify(&classes.scene.space_state(), is_proved)?
                    }
                },
            };
            classes.leaves.insert(own, class);
            parts.push(class);
        }
        for part in cobject.set().parts() {
            let is_complement = matches!(cobject.set(), Set::Complement(_));
            parts.push(self.class_of_all(part, is_proved != is_complement, classes)?);
        }
        let parts = parts.into_iter();
        let class = match cobject.set() {
            Set::Union { .. } | Set::Pure(_) | Set::Known(_) => {
                parts.max().unwrap_or(Class::Outside)
            }
            Set::Intersection(_) => parts.min().unwrap_or(Class::Inside),
            Set::Complement(_) => parts.max().unwrap_or(Class::Outside).reversed(),
        };
        classes.compounds.insert(key, class);
        Ok(class)
    }

    /// The witnesses of a leaf's class.
    fn reasons(
        &mut self,
        query: LeafQuery,
        class: Class,
        max_count: usize,
        is_proved: bool,
        scene: &Scene,
    ) -> Result<WitnessList> {
        let epsilon = match (class, query) {
            (Class::Outside, _) => return Ok(WitnessList::default()),
            (Class::Inside, _) => 0.0,
            (Class::Contact, LeafQuery::Induced(group)) => group[0].options.contact_epsilon,
            (Class::Contact, LeafQuery::Pure(set)) => set.epsilon(),
        };
        // Classes count doubt as within, so the request must too.
        let request = WitnessRequest {
            counts_doubt: true,
            is_proved,
            contacts: self.contacts,
            ..WitnessRequest::within(epsilon, max_count)
        };
        match query {
            LeafQuery::Induced(group) => self.group_witnesses(group, scene, request),
            LeafQuery::Pure(set) => pure_witnesses(&[(set, false)], scene, request),
        }
    }
}

/// The leaves directly in a part.
fn own_leaves(cobject: &CObject) -> impl Iterator<Item = LeafQuery<'_>> {
    let induced = match cobject.set() {
        Set::Union { induced, .. } => &induced[..],
        _ => &[],
    };
    let pure = match cobject.set() {
        Set::Pure(set) => Some(LeafQuery::Pure(set)),
        _ => None,
    };
    induced.chunks(1).map(LeafQuery::Induced).chain(pure)
}

/// All leaves in order, each with whether its complement is meant and whether it is decisive.
fn verdicts<'a>(cobject: &'a CObject, classes: &Classes) -> Vec<(LeafQuery<'a>, bool, bool)> {
    let mut leaves: Vec<(LeafQuery<'a>, bool, bool)> = Vec::new();
    let mut place_of: HashMap<(u64, bool), usize> = HashMap::new();
    let mut seen: HashSet<(u64, bool, bool)> = HashSet::new();
    let mut stack: Vec<(&'a CObject, bool, bool)> = vec![(cobject, false, true)];
    while let Some((next, complemented, decides)) = stack.pop() {
        if !seen.insert((next.serial(), complemented, decides)) {
            continue;
        }
        let class = classes.compounds[&(next.serial(), complemented)];
        for query in own_leaves(next) {
            let serial = query.leaf().serial;
            let decisive = decides && classes.leaves[&(serial, complemented)] == class;
            let place = *place_of.entry((serial, complemented)).or_insert_with(|| {
                leaves.push((query, complemented, false));
                leaves.len() - 1
            });
            leaves[place].2 |= decisive;
        }
        let is_complement = matches!(next.set(), Set::Complement(_));
        let below = |part: &'a Arc<CObject>| {
            let below = complemented != is_complement;
            let is_same = || classes.compounds[&(part.serial(), below)] == class;
            (&**part, below, decides && (is_complement || is_same()))
        };
        stack.extend(next.set().parts().iter().rev().map(below));
    }
    leaves
}
