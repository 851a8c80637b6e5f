//! Induced sets: the configurations at which bodies meet (§2.2.4).

use std::collections::HashSet;
use std::sync::Arc;

use super::{ClearPairs, Exceptions, Leaf, LeftOut, LinkRows};
use crate::environment::{Environment, SObject};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::index_set::IndexSet;
use crate::space::Space;
use crate::user_data::UserData;

/// Options of an induced C-object; lengths.
#[derive(Clone, Copy, Debug, Default)]
pub struct InducedOptions {
    /// Distances above 0 and up to this classify as contact.
    pub contact_epsilon: f64,
    /// Grows the s-objects: it is subtracted from every distance.
    pub margin: f64,
}

/// The s-side of an induced C-object.
#[derive(Clone, Debug)]
pub enum SObjects {
    /// All objects of an environment, including those added later.
    All(Arc<Environment>),
    /// Some objects, by id. A set stores the ids in ascending order. A deleted object contributes the empty set.
    Some(Arc<Environment>, Vec<u64>),
}

/// The body pairs of an induced set.
#[derive(Clone, Debug)]
pub enum BodyPairs {
    /// Links against s-objects.
    Objects(LinksAndObjects),
    /// Links against links; the second of a pair is the nominal s-object.
    Links {
        /// By number in the space; no pair twice. All have bodies.
        pairs: Vec<[usize; 2]>,
        /// The same for the broad phase.
        rows: LinkRows,
        /// Where some of them are proved apart.
        clear: Option<Arc<ClearPairs>>,
    },
}

/// Links of the space and the objects attached to them, against s-objects. A link without a body contributes only its
/// attached objects.
#[derive(Clone, Debug)]
pub struct LinksAndObjects {
    /// The links on the r-side, by number in the space; none twice.
    pub links: Vec<usize>,
    /// The bodies of these, by their numbers.
    pub bodies: IndexSet,
    /// The s-side.
    pub objects: SObjects,
    /// Pairs that are left out.
    pub exceptions: Exceptions,
}

/// The set of configurations at which some pair of bodies meets.
#[derive(Clone, Debug)]
pub struct Induced {
    /// How answers name the set.
    pub leaf: Leaf,
    /// Keeps the leaf's user data alive: it must outlive every set that holds the leaf.
    pub data: Option<UserData>,
    /// The body pairs that the set tests.
    pub pairs: BodyPairs,
    /// Contact epsilon and margin.
    pub options: InducedOptions,
    /// The shell that slides use for this set; `None` for that of their options.
    pub shell: Option<f64>,
}

impl LinksAndObjects {
    /// Whether an object makes a pair with the body of one of the links, or with an object attached to it, by its id, or 0.
    pub fn admits(&self, link: usize, attached: u64, object: &SObject) -> bool {
        if self.exceptions.have(link, attached, object) {
            return false;
        }
        let Some(attachment) = &object.attachment else {
            return true;
        };
        // An attached object is not tested against the link that holds it, nor against its touch links. Of two attached
        // objects, the one with the lower id is the r-side.
        let touches =
            attachment.link == link || (attached == 0 && attachment.touch_links.contains(&link));
        let is_mirrored = attached > object.id
            && self.objects.contains(attached)
            && self.links.contains(&attachment.link);
        !touches && !is_mirrored
    }
}

impl SObjects {
    /// The environment that holds the objects.
    pub fn environment(&self) -> &Arc<Environment> {
        let (Self::All(environment) | Self::Some(environment, _)) = self;
        environment
    }

    /// Whether the s-side includes an object.
    pub fn contains(&self, id: u64) -> bool {
        match self {
            Self::All(_) => true,
            Self::Some(_, ids) => ids.binary_search(&id).is_ok(),
        }
    }
}

impl BodyPairs {
    /// Links against s-objects. An empty `links` means all links, some of which must have a body.
    pub(super) fn with_objects(
        space: &Space,
        links: &[usize],
        mut objects: SObjects,
        left_out: LeftOut,
    ) -> Result<Self> {
        let links: Vec<usize> = if links.is_empty() {
            if space.bodies().count() == 0 {
                return Err(Error::new(
                    ErrorKind::Empty,
                    "no link of the space has a body",
                ));
            }
            (0..space.link_count()).collect()
        } else {
            for &link in links {
                require_link(space, link)?;
            }
            let mut seen = HashSet::new();
            let is_new = |link: &usize| seen.insert(*link);
            links.iter().copied().filter(is_new).collect()
        };
        let exceptions = Exceptions::new(space, left_out)?;
        if let SObjects::Some(_, ids) = &mut objects {
            ids.sort_unstable();
            ids.dedup();
        }
        let mut bodies = IndexSet::new(space.bodies().count());
        for number in links.iter().filter_map(|&link| space.bodies().number(link)) {
            bodies.insert(number);
        }
        Ok(Self::Objects(LinksAndObjects {
            links,
            bodies,
            objects,
            exceptions,
        }))
    }

    /// Links against links; a pair given twice counts once.
    pub(super) fn of_links(space: &Space, pairs: &[[usize; 2]]) -> Result<Self> {
        for (i, pair) in pairs.iter().enumerate() {
            let named = |error: Error| error.within(format_args!("pair {i}"));
            for &link in pair {
                require_body(space, link).map_err(named)?;
            }
            if pair[0] == pair[1] {
                return Err(named(Error::invalid(format!(
                    "link {} is paired with itself",
                    pair[0]
                ))));
            }
        }
        let mut seen = HashSet::new();
        let is_new = |&&[r, s]: &&[usize; 2]| seen.insert([r.min(s), r.max(s)]);
        let pairs: Vec<[usize; 2]> = pairs.iter().filter(is_new).copied().collect();
        let numbers =
            |&[r, s]: &[usize; 2]| Some([space.bodies().number(r)?, space.bodies().number(s)?]);
        let numbered = pairs.iter().filter_map(numbers);
        Ok(Self::Links {
            rows: LinkRows::new(space.bodies().count(), numbered),
            clear: None,
            pairs,
        })
    }

    /// What is proved of pairs of links.
    pub fn clear(&self) -> Option<&ClearPairs> {
        match self {
            Self::Links { clear, .. } => clear.as_deref(),
            Self::Objects(_) => None,
        }
    }

    /// The environment of the s-objects; `None` for links against links.
    pub fn environment(&self) -> Option<&Arc<Environment>> {
        match self {
            Self::Objects(pairs) => Some(pairs.objects.environment()),
            Self::Links { .. } => None,
        }
    }
}

impl InducedOptions {
    pub(super) fn check(&self) -> Result<()> {
        for (value, name) in [
            (self.contact_epsilon, "contact_epsilon"),
            (self.margin, "margin"),
        ] {
            require_finite(&[value], name)?;
            if value < 0.0 {
                return Err(Error::invalid(format!("{name} is negative: {value}")));
            }
        }
        Ok(())
    }
}

pub(super) fn require_link(space: &Space, link: usize) -> Result<&crate::robot::Link> {
    space.link(link).ok_or_else(|| {
        Error::new(
            ErrorKind::NotFound,
            format!(
                "link {link} does not exist; the space has {}",
                space.link_count()
            ),
        )
    })
}

fn require_body(space: &Space, link: usize) -> Result<()> {
    let found = require_link(space, link)?;
    if found.body.is_none() {
        return Err(Error::new(
            ErrorKind::Empty,
            format!("link {link} (\"{}\") has no body", found.name),
        ));
    }
    Ok(())
}
