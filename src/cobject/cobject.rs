//! C-objects: leaves, and trees of unions, intersections and complements over them.

use std::collections::HashSet;
use std::sync::Arc;

use super::leaf::next_serial;
use super::{
    AllowedPair, BodyPairs, Induced, InducedOptions, Leaf, PureOptions, PureSet, PureShape,
    SObjects,
};
use crate::environment::Environment;
use crate::error::{Error, ErrorKind, Result};
use crate::space::Space;
use crate::user_data::UserData;

/// Sets nested deeper than this are refused; unions in unions, and intersections in intersections, count as one.
pub const MOST_DEPTH: u32 = 256;

/// What a C-object is made of.
#[derive(Clone, Debug)]
pub enum Set {
    /// A union. What is induced is searched as one, whatever it was joined from; a lone induced set is a union of one.
    Union {
        induced: Vec<Arc<Induced>>,
        others: Vec<Arc<CObject>>,
    },
    Intersection(Vec<Arc<CObject>>),
    Complement(Arc<CObject>),
    Pure(PureSet),
}

/// The unit in which a set measures.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unit {
    /// It does not.
    None,
    Length,
    /// That of C-space, in the pure set of this number.
    CSpace(u64),
    /// Both: the pure set of this number has no scale.
    Mixed(u64),
}

/// A set in C-space, over one space. Immutable, but for the environments it refers to.
#[derive(Debug)]
pub struct CObject {
    serial: u64,
    space: Arc<Space>,
    set: Set,
    data: Option<UserData>,
    depth: u32,
    unit: Unit,
    /// A pure set that asks for coordinates: its number, and what it is.
    needs_coordinates: Option<(u64, &'static str)>,
    /// Each once, in order of serials.
    environments: Vec<Arc<Environment>>,
}

impl CObject {
    /// The set where a link meets an s-object. No links given means all links that have a body.
    pub fn induced(
        space: Arc<Space>,
        links: &[usize],
        objects: SObjects,
        allowed: &[AllowedPair],
        options: InducedOptions,
    ) -> Result<Self> {
        options.check()?;
        let pairs = BodyPairs::with_objects(&space, links, objects, allowed)?;
        Ok(Self::of_pairs(space, pairs, options))
    }

    /// The set where the links of some pair meet.
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
            })],
            others: Vec::new(),
        })
    }

    /// A set given by coordinates.
    pub fn pure(space: Arc<Space>, shape: PureShape, options: PureOptions) -> Result<Self> {
        options.check()?;
        shape.check(&space)?;
        Ok(Self::leaf(space, |leaf| {
            Set::Pure(PureSet {
                leaf,
                data: None,
                shape,
                options,
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
        let (mut induced, mut others) = (Vec::new(), Vec::new());
        let mut seen = HashSet::new();
        for part in parts {
            match &part.set {
                Set::Union {
                    induced: more,
                    others: rest,
                } => {
                    let is_new = |i: &&Arc<Induced>| seen.insert(i.leaf.serial);
                    induced.extend(more.iter().filter(is_new).cloned());
                    let is_new = |o: &&Arc<CObject>| seen.insert(o.serial);
                    others.extend(rest.iter().filter(is_new).cloned());
                }
                _ => others.extend(seen.insert(part.serial).then(|| part.clone())),
            }
        }
        Self::compound(space, Set::Union { induced, others })
    }

    /// The intersection of C-objects over one space.
    pub fn intersection(parts: &[Arc<CObject>]) -> Result<Self> {
        let space = common_space(parts, "an intersection")?;
        let mut seen = HashSet::new();
        let mut all = Vec::new();
        for part in parts {
            match &part.set {
                Set::Intersection(inner) => {
                    let is_new = |o: &&Arc<CObject>| seen.insert(o.serial);
                    all.extend(inner.iter().filter(is_new).cloned());
                }
                _ => all.extend(seen.insert(part.serial).then(|| part.clone())),
            }
        }
        Self::compound(space, Set::Intersection(all))
    }

    /// All configurations that are not in a C-object.
    pub fn complement(part: &Arc<CObject>) -> Result<Self> {
        if let Set::Complement(inner) = &part.set {
            let (set, data) = (inner.set.clone(), inner.data.clone());
            return Ok(Self::with_set(inner.serial, inner.space.clone(), set, data));
        }
        Self::compound(part.space.clone(), Set::Complement(part.clone()))
    }

    /// The configurations of one C-object that are not in another.
    pub fn difference(of: &Arc<CObject>, without: &Arc<CObject>) -> Result<Self> {
        Self::intersection(&[of.clone(), Arc::new(Self::complement(without)?)])
    }

    fn compound(space: Arc<Space>, set: Set) -> Result<Self> {
        let made = Self::with_set(next_serial(), space, set, None);
        if made.depth > MOST_DEPTH {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("the C-objects are nested deeper than {MOST_DEPTH}"),
            ));
        }
        Ok(made)
    }

    fn with_set(serial: u64, space: Arc<Space>, set: Set, data: Option<UserData>) -> Self {
        let mut environments: Vec<Arc<Environment>> = set.environments();
        environments.sort_by_key(|environment| environment.serial());
        environments.dedup_by_key(|environment| environment.serial());
        Self {
            serial,
            space,
            depth: 1 + set.parts().iter().map(|part| part.depth).max().unwrap_or(0),
            unit: set.unit(),
            needs_coordinates: set.needs_coordinates(),
            set,
            data,
            environments,
        }
    }

    /// The same set, carrying data of the caller's: answers hand those of leaves back.
    pub fn with_data(&self, data: UserData) -> Self {
        let serial = next_serial();
        let leaf = Leaf {
            serial,
            data: data.value,
        };
        let set = match &self.set {
            Set::Union { induced, others } if self.is_leaf() => Set::Union {
                induced: induced
                    .iter()
                    .map(|i| {
                        Arc::new(Induced {
                            leaf,
                            data: Some(data.clone()),
                            ..Induced::clone(i)
                        })
                    })
                    .collect(),
                others: others.clone(),
            },
            Set::Pure(pure) => Set::Pure(PureSet {
                leaf,
                data: Some(data.clone()),
                ..pure.clone()
            }),
            compound => compound.clone(),
        };
        Self::with_set(serial, self.space.clone(), set, Some(data))
    }

    fn is_leaf(&self) -> bool {
        match &self.set {
            Set::Pure(_) => true,
            Set::Union { induced, others } => {
                others.is_empty() && induced.len() == 1 && induced[0].leaf.serial == self.serial
            }
            _ => false,
        }
    }

    /// The union of what is induced, without anything else.
    pub fn induced_part(&self) -> Self {
        let set = Set::Union {
            induced: self.induced_leaves(),
            others: Vec::new(),
        };
        Self::with_set(self.serial, self.space.clone(), set, None)
    }

    /// Of a union the same without pairs of bodies that do not move, or links over a floor; `None` if nothing is left. Other
    /// pure sets stay. Links that rest meet what moving ones hold.
    pub fn moving(&self, moves: impl Fn(usize) -> bool) -> Option<Self> {
        let Set::Union { induced, others } = &self.set else {
            return None;
        };
        let moving = induced.iter().filter_map(|term| {
            Some(Arc::new(Induced {
                pairs: term.pairs.moving(&moves)?,
                ..Induced::clone(term)
            }))
        });
        let induced: Vec<Arc<Induced>> = moving.collect();
        let others = others.iter().filter_map(|other| match &other.set {
            Set::Pure(pure) => {
                let set = Set::Pure(pure.moving(&moves)?);
                let space = other.space.clone();
                Some(Arc::new(Self::with_set(other.serial, space, set, None)))
            }
            _ => Some(other.clone()),
        });
        let others: Vec<Arc<Self>> = others.collect();
        let is_left = !(induced.is_empty() && others.is_empty());
        is_left.then(|| {
            let set = Set::Union { induced, others };
            Self::with_set(self.serial, self.space.clone(), set, None)
        })
    }

    /// A number no other C-object of this process has.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    pub fn space(&self) -> &Arc<Space> {
        &self.space
    }

    pub fn set(&self) -> &Set {
        &self.set
    }

    pub fn data(&self) -> Option<&UserData> {
        self.data.as_ref()
    }

    /// The environments it refers to, each once, in order of serials.
    pub fn environments(&self) -> &[Arc<Environment>] {
        &self.environments
    }

    /// Refuses to answer at link poses where a pure set asks for coordinates.
    pub fn require_no_coordinates(&self) -> Result<()> {
        match self.needs_coordinates {
            Some((pure, name)) => Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "C-object {pure} is {name}, which needs the coordinates: link poses alone do not tell them"
                ),
            )),
            None => Ok(()),
        }
    }

    /// Refuses to measure lengths together with units of C-space.
    pub fn require_one_unit(&self) -> Result<()> {
        match self.unit {
            Unit::Mixed(pure) => Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "C-object {pure} is a pure set without a scale: its units of C-space cannot be compared with lengths; give it one (scale)"
                ),
            )),
            _ => Ok(()),
        }
    }

    /// All induced leaves, each once.
    pub fn induced_leaves(&self) -> Vec<Arc<Induced>> {
        let mut seen = HashSet::new();
        let mut found = Vec::new();
        let mut open = vec![self];
        let mut visited = HashSet::new();
        while let Some(next) = open.pop() {
            if let Set::Union { induced, .. } = &next.set {
                let is_new = |i: &&Arc<Induced>| seen.insert(i.leaf.serial);
                found.extend(induced.iter().filter(is_new).cloned());
            }
            let parts = next.set.parts().iter().rev();
            open.extend(
                parts
                    .filter(|part| visited.insert(part.serial))
                    .map(|part| &**part),
            );
        }
        found
    }
}

impl Set {
    /// The C-objects it is made of, but for what is induced.
    pub fn parts(&self) -> &[Arc<CObject>] {
        match self {
            Self::Union { others, .. } => others,
            Self::Intersection(parts) => parts,
            Self::Complement(part) => std::slice::from_ref(part),
            Self::Pure(_) => &[],
        }
    }

    fn environments(&self) -> Vec<Arc<Environment>> {
        let own = match self {
            Self::Union { induced, .. } => &induced[..],
            _ => &[],
        };
        let own = own.iter().filter_map(|term| term.pairs.environment());
        let below = self.parts().iter().flat_map(|part| &part.environments);
        own.chain(below).cloned().collect()
    }

    fn needs_coordinates(&self) -> Option<(u64, &'static str)> {
        match self {
            Self::Pure(pure) => {
                let names = (pure.leaf.serial, pure.shape.name());
                (!pure.shape.is_in_world()).then_some(names)
            }
            _ => self.parts().iter().find_map(|part| part.needs_coordinates),
        }
    }

    fn unit(&self) -> Unit {
        let own = match self {
            Self::Union { induced, .. } if !induced.is_empty() => Unit::Length,
            Self::Pure(pure) if pure.shape.is_in_world() || pure.options.scale.is_some() => {
                Unit::Length
            }
            Self::Pure(pure) => match &pure.shape {
                PureShape::Predicate(predicate) if !predicate.measures() => Unit::None,
                _ => Unit::CSpace(pure.leaf.serial),
            },
            _ => Unit::None,
        };
        let parts = self.parts().iter().map(|part| part.unit);
        parts.fold(own, |unit, next| match (unit, next) {
            (Unit::None, other) | (other, Unit::None) => other,
            (Unit::Mixed(pure), _) | (_, Unit::Mixed(pure)) => Unit::Mixed(pure),
            (Unit::CSpace(pure), Unit::Length) | (Unit::Length, Unit::CSpace(pure)) => {
                Unit::Mixed(pure)
            }
            (same, _) => same,
        })
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
