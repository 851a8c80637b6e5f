//! C-objects: leaves, and trees of unions, intersections and complements over them.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::compound::{Compound, CompoundKind};
use super::leaf::next_serial;
use super::set::{Flat, Metric, Set};
use super::{
    BodyPairs, Class, ClearCells, ClearPairs, Induced, InducedOptions, KnownClass, Leaf, LeftOut,
    PureOptions, PureSet, PureShape, SObjects,
};
use crate::environment::Environment;
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::space::Space;
use crate::tolerance;
use crate::user_data::{UserData, value_of};

/// The deepest nesting of sets; a union in a union, or an intersection in an intersection, adds no level.
pub const MAX_DEPTH: u32 = 256;

/// A set in the C-space of one space. Immutable, except for the environments that it refers to; threads may share it.
#[derive(Debug)]
pub struct CObject {
    serial: u64,
    space: Arc<Space>,
    content: Content,
    data: Option<UserData>,
    depth: u32,
}

/// The content of a C-object. Unions and intersections are flattened on first use.
#[derive(Clone, Debug)]
pub(super) enum Content {
    Flat(Box<Flat>),
    Compound(Arc<Compound>),
}

impl CObject {
    /// The configurations where a link meets an s-object. An empty `links` means all links that have a body.
    pub fn induced(
        space: Arc<Space>,
        links: &[usize],
        objects: SObjects,
        left_out: LeftOut,
        options: InducedOptions,
    ) -> Result<Self> {
        options.check()?;
        let pairs = BodyPairs::with_objects(&space, links, objects, left_out)?;
        Ok(Self::of_pairs(space, pairs, options))
    }

    /// The configurations where the links of some pair meet.
    pub fn induced_links(
        space: Arc<Space>,
        pairs: &[[usize; 2]],
        options: InducedOptions,
    ) -> Result<Self> {
        options.check()?;
        let pairs = BodyPairs::of_links(&space, pairs)?;
        Ok(Self::of_pairs(space, pairs, options))
    }

    fn of_pairs(space: Arc<Space>, pairs: BodyPairs, options: InducedOptions) -> Self {
        Self::leaf(space, |leaf| Set::Union {
            induced: vec![Arc::new(Induced {
                leaf,
                data: None,
                pairs,
                options,
                shell: None,
            })],
            others: Vec::new(),
        })
    }

    /// A set given in C-space itself.
    pub fn pure(space: Arc<Space>, shape: PureShape, options: PureOptions) -> Result<Self> {
        options.check()?;
        shape.check(&space)?;
        Ok(Self::leaf(space, |leaf| {
            Set::Pure(PureSet {
                leaf,
                data: None,
                shape,
                options,
                shell: None,
            })
        }))
    }

    fn leaf(space: Arc<Space>, set: impl FnOnce(Leaf) -> Set) -> Self {
        let serial = next_serial();
        let leaf = Leaf { serial, data: 0 };
        Self::with_set(serial, space, set(leaf), None)
    }

    /// The union of C-objects over one space.
    pub fn union(parts: &[Arc<CObject>]) -> Result<Self> {
        let space = common_space(parts, "a union")?;
        Self::of_compound(space, Compound::new(CompoundKind::Union, parts))
    }

    /// The intersection of C-objects over one space.
    pub fn intersection(parts: &[Arc<CObject>]) -> Result<Self> {
        let space = common_space(parts, "an intersection")?;
        Self::of_compound(space, Compound::new(CompoundKind::Intersection, parts))
    }

    /// The configurations that are not in a C-object. The complement of a complement is the original set, with its number.
    pub fn complement(part: &Arc<CObject>) -> Result<Self> {
        if let Content::Flat(flat) = &part.content
            && let Set::Complement(inner) = &flat.set
        {
            return Ok(Self {
                serial: inner.serial,
                space: inner.space.clone(),
                content: inner.content.clone(),
                data: inner.data.clone(),
                depth: inner.depth,
            });
        }
        let set = Set::Complement(part.clone());
        Self::with_set(next_serial(), part.space.clone(), set, None).with_depth_checked()
    }

    /// The configurations of one C-object that are not in another.
    pub fn difference(of: &Arc<CObject>, without: &Arc<CObject>) -> Result<Self> {
        Self::intersection(&[of.clone(), Arc::new(Self::complement(without)?)])
    }

    /// A C-object of which the caller knows that it has a class, outside or inside, at every configuration in the interior of convex
    /// sets (see [`ConvexSets::of`]).
    ///
    /// [`ConvexSets::of`]: super::ConvexSets::of
    pub fn with_known(of: &Arc<CObject>, within: &CObject, class: Class) -> Result<Self> {
        let set = Set::Known(KnownClass::new(of.clone(), within, class)?);
        Self::with_set(next_serial(), of.space.clone(), set, None).with_depth_checked()
    }

    /// The same set without what is known of it, for queries that take nobody's word; `None` if nothing is. Its leaves are the same.
    pub fn without_known(&self) -> Result<Option<Arc<CObject>>> {
        match self.has_known() {
            true => self.by_geometry(&mut HashMap::new()).map(Some),
            false => Ok(None),
        }
    }

    /// The same, of a set that has something known; `memo` holds what became of parts, by serial.
    fn by_geometry(&self, memo: &mut HashMap<u64, Arc<CObject>>) -> Result<Arc<CObject>> {
        if let Some(found) = memo.get(&self.serial) {
            return Ok(found.clone());
        }
        let mut part = |part: &Arc<CObject>| match part.has_known() {
            true => part.by_geometry(memo),
            false => Ok(part.clone()),
        };
        let set = match self.set() {
            Set::Known(known) => part(&known.of)?,
            Set::Complement(inner) => Arc::new(Self::complement(&part(inner)?)?),
            Set::Intersection(parts) => {
                let parts: Vec<_> = parts.iter().map(part).collect::<Result<_>>()?;
                Arc::new(Self::intersection(&parts)?)
            }
            Set::Union { induced, others } => {
                let mut parts: Vec<_> = others.iter().map(part).collect::<Result<_>>()?;
                if !induced.is_empty() {
                    parts.insert(0, Arc::new(self.induced_alone(induced.clone())));
                }
                Arc::new(Self::union(&parts)?)
            }
            Set::Pure(_) => unreachable!("of a pure set nothing is known"),
        };
        memo.insert(self.serial, set.clone());
        Ok(set)
    }

    fn induced_alone(&self, induced: Vec<Arc<Induced>>) -> Self {
        let others = Vec::new();
        let set = Set::Union { induced, others };
        Self::with_set(next_serial(), self.space.clone(), set, None)
    }

    /// Whether its class, or that of a part, is known in places.
    pub fn has_known(&self) -> bool {
        self.flat().has_known
    }

    fn of_compound(space: Arc<Space>, compound: Compound) -> Result<Self> {
        let cobject = Self {
            serial: next_serial(),
            space,
            depth: 1 + compound.depth(),
            content: Content::Compound(Arc::new(compound)),
            data: None,
        };
        cobject.with_depth_checked()
    }

    /// Refuses a set that is nested too deeply.
    fn with_depth_checked(self) -> Result<Self> {
        if self.depth > MAX_DEPTH {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("the C-objects are nested deeper than {MAX_DEPTH}"),
            ));
        }
        Ok(self)
    }

    fn with_set(serial: u64, space: Arc<Space>, set: Set, data: Option<UserData>) -> Self {
        Self {
            serial,
            space,
            depth: 1 + set.parts().iter().map(|part| part.depth).max().unwrap_or(0),
            content: Content::Flat(Box::new(Flat::of(set))),
            data,
        }
    }

    /// The same set with user data, under a new number. Answers return the data of leaves.
    pub fn with_data(&self, data: UserData) -> Self {
        self.with_new_serial(Some(data), self.shell())
    }

    /// The same leaf with its own shell, under a new number: slides consider its contacts up to this distance, whatever the
    /// shell of their options.
    pub fn with_shell(&self, shell: f64) -> Result<Self> {
        require_coordinates(&[shell], "shell")?;
        if shell < tolerance::SMALLEST_DIAMETER {
            let least = tolerance::SMALLEST_DIAMETER;
            return Err(Error::invalid(format!(
                "shell is {shell}; it must be {least:e} at least"
            )));
        }
        if self.leaf_set().is_none() {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "only an induced or a pure set takes a shell: give one to each part before they are combined",
            ));
        }
        Ok(self.with_new_serial(self.data.clone(), Some(shell)))
    }

    /// The link pairs of an induced set of links; `None` for other C-objects.
    pub fn link_pairs(&self) -> Option<(&Induced, &[[usize; 2]])> {
        match self.leaf_set()? {
            Set::Union { induced, .. } => match &induced[0].pairs {
                BodyPairs::Links { pairs, .. } => Some((&induced[0], pairs)),
                BodyPairs::Objects(_) => None,
            },
            _ => None,
        }
    }

    /// The grids of the pairs of an induced set of links that are proved apart in some cells.
    pub fn clear_grids(&self) -> &[ClearCells] {
        let clear = self.link_pairs().and_then(|(set, _)| set.pairs.clear());
        clear.map_or(&[], ClearPairs::grids)
    }

    /// The same induced set of links, under a new number, with what is proved of its pairs.
    pub(crate) fn with_clear_pairs(&self, proved: ClearPairs) -> Option<Self> {
        let (induced, _) = self.link_pairs()?;
        let mut induced = induced.clone();
        if let BodyPairs::Links { clear, .. } = &mut induced.pairs {
            *clear = Some(Arc::new(proved));
        }
        induced.leaf.serial = next_serial();
        let serial = induced.leaf.serial;
        let set = Set::Union {
            induced: vec![Arc::new(induced)],
            others: Vec::new(),
        };
        Some(Self::with_set(
            serial,
            self.space.clone(),
            set,
            self.data.clone(),
        ))
    }

    /// The same set under a new number; the data and the shell go to its leaf, if it is one.
    fn with_new_serial(&self, data: Option<UserData>, shell: Option<f64>) -> Self {
        let serial = next_serial();
        let leaf = Leaf {
            serial,
            data: value_of(&data),
        };
        let set = match self.leaf_set() {
            Some(Set::Union { induced, others }) => {
                let with_data = |i: &Arc<Induced>| {
                    Arc::new(Induced {
                        leaf,
                        data: data.clone(),
                        shell,
                        ..Induced::clone(i)
                    })
                };
                Set::Union {
                    induced: induced.iter().map(with_data).collect(),
                    others: others.clone(),
                }
            }
            Some(Set::Pure(pure)) => Set::Pure(PureSet {
                leaf,
                data: data.clone(),
                shell,
                ..pure.clone()
            }),
            _ => {
                return Self {
                    serial,
                    space: self.space.clone(),
                    content: self.content.clone(),
                    data,
                    depth: self.depth,
                };
            }
        };
        Self::with_set(serial, self.space.clone(), set, data)
    }

    /// The shell of a leaf that has its own.
    fn shell(&self) -> Option<f64> {
        match self.leaf_set()? {
            Set::Pure(pure) => pure.shell,
            Set::Union { induced, .. } => induced.first()?.shell,
            _ => None,
        }
    }

    /// The set of a leaf; `None` for compounds.
    fn leaf_set(&self) -> Option<&Set> {
        let Content::Flat(flat) = &self.content else {
            return None;
        };
        let set = &flat.set;
        let is_leaf = match set {
            Set::Pure(_) => true,
            Set::Union { induced, others } => {
                others.is_empty() && induced.len() == 1 && induced[0].leaf.serial == self.serial
            }
            _ => false,
        };
        is_leaf.then_some(set)
    }

    /// The union of the induced sets alone. It keeps the number of the C-object.
    pub fn induced_part(&self) -> Self {
        let set = Set::Union {
            induced: self.induced_leaves(),
            others: Vec::new(),
        };
        Self::with_set(self.serial, self.space.clone(), set, None)
    }

    /// A number that identifies the set within this process. Two C-objects share it where one is made from the other
    /// without change (the complement of a complement), or as a part of it ([`Self::induced_part`]).
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// The space whose configurations the set holds.
    pub fn space(&self) -> &Arc<Space> {
        &self.space
    }

    /// What the C-object is made of. Flattens unions and intersections on first use.
    pub fn set(&self) -> &Set {
        &self.flat().set
    }

    pub(super) fn flat(&self) -> &Flat {
        match &self.content {
            Content::Flat(flat) => flat,
            Content::Compound(compound) => compound.flat(),
        }
    }

    pub(super) fn content(&self) -> &Content {
        &self.content
    }

    /// The number of nested sets, this one included.
    pub(super) fn depth(&self) -> u32 {
        self.depth
    }

    /// The user data, if any.
    pub fn data(&self) -> Option<&UserData> {
        self.data.as_ref()
    }

    /// The environments that the set refers to, without duplicates, in order of serials.
    pub fn environments(&self) -> &[Arc<Environment>] {
        &self.flat().environments
    }

    /// Refuses a set that cannot be answered from link poses alone: one with a part that needs coordinates.
    pub fn require_no_coordinates(&self) -> Result<()> {
        match self.flat().needs_coordinates {
            Some((pure, name)) => Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "C-object {pure} is {name}, which needs the coordinates: link poses alone do not tell them"
                ),
            )),
            None => Ok(()),
        }
    }

    /// Refuses a set that mixes lengths with units of C-space.
    pub fn require_one_metric(&self) -> Result<()> {
        match self.flat().metric {
            Metric::Mixed(pure) => Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "C-object {pure} is a pure set without a scale: its units of C-space cannot be compared with lengths; give it one when it is made (the option scale of pure sets)"
                ),
            )),
            _ => Ok(()),
        }
    }

    /// All induced leaves, without duplicates.
    pub fn induced_leaves(&self) -> Vec<Arc<Induced>> {
        let mut seen = HashSet::new();
        let mut leaves = Vec::new();
        let mut stack = vec![self];
        let mut visited = HashSet::new();
        while let Some(next) = stack.pop() {
            if let Set::Union { induced, .. } = next.set() {
                let is_new = |i: &&Arc<Induced>| seen.insert(i.leaf.serial);
                leaves.extend(induced.iter().filter(is_new).cloned());
            }
            let parts = next.set().parts().iter().rev();
            stack.extend(
                parts
                    .filter(|part| visited.insert(part.serial))
                    .map(|part| &**part),
            );
        }
        leaves
    }
}

fn common_space(parts: &[Arc<CObject>], what: &str) -> Result<Arc<Space>> {
    let first = parts.first().ok_or_else(|| {
        Error::new(
            ErrorKind::Empty,
            format!("{what} needs at least one C-object"),
        )
    })?;
    let serial = first.space.serial();
    match parts.iter().position(|part| part.space.serial() != serial) {
        None => Ok(first.space.clone()),
        Some(i) => Err(Error::invalid(format!(
            "C-object {i} belongs to another space than C-object 0"
        ))),
    }
}
