//! Induced C-objects and their unions.

use std::collections::HashSet;
use std::sync::Arc;

use crate::environment::Environment;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::space::Space;

/// How an induced C-object measures.
#[derive(Clone, Copy, Debug)]
pub struct InducedOptions {
    /// Distances up to this (and above 0) classify as contact.
    pub contact_epsilon: f64,
    /// Grows the s-objects: it is taken off every distance.
    pub margin: f64,
}

impl Default for InducedOptions {
    fn default() -> Self {
        Self {
            contact_epsilon: 0.0,
            margin: 0.0,
        }
    }
}

/// The s-side of an induced C-object.
#[derive(Debug)]
pub enum SObjects {
    /// All objects of an environment, those added later too.
    All(Arc<Environment>),
    /// Some objects, by id. One that is deleted contributes the empty set.
    Some(Arc<Environment>, Vec<u64>),
}

/// One simple C-object within a union.
#[derive(Debug)]
pub enum Term {
    /// Links of the space against s-objects.
    Objects {
        links: Vec<usize>,
        objects: SObjects,
        options: InducedOptions,
    },
    /// Links against links; the second of a pair is the nominal s-object.
    Links {
        pairs: Vec<[usize; 2]>,
        options: InducedOptions,
    },
}

/// A set in C-space: a union of simple C-objects over one space.
#[derive(Debug)]
pub struct CObject {
    space: Arc<Space>,
    terms: Vec<Arc<Term>>,
}

impl CObject {
    /// The set where a link meets an s-object. No links given means all links that have a body.
    pub fn induced(
        space: Arc<Space>,
        links: &[usize],
        objects: SObjects,
        options: InducedOptions,
    ) -> Result<Self> {
        check_options(&options)?;
        let links = if links.is_empty() {
            let with_body = |&link: &usize| space.link(link).is_some_and(|l| l.body.is_some());
            let found: Vec<usize> = (0..space.link_count()).filter(with_body).collect();
            if found.is_empty() {
                return Err(Error::new(
                    ErrorKind::Empty,
                    "no link of the space has a body",
                ));
            }
            found
        } else {
            for &link in links {
                require_body(&space, link)?;
            }
            links.to_vec()
        };
        Ok(Self {
            space,
            terms: vec![Arc::new(Term::Objects {
                links,
                objects,
                options,
            })],
        })
    }

    /// The set where the links of some pair meet.
    pub fn induced_links(
        space: Arc<Space>,
        pairs: &[[usize; 2]],
        options: InducedOptions,
    ) -> Result<Self> {
        check_options(&options)?;
        if pairs.is_empty() {
            return Err(Error::new(ErrorKind::Empty, "no link pair given"));
        }
        for (i, pair) in pairs.iter().enumerate() {
            let named = |error: Error| error.within(format_args!("pair {i}"));
            for &link in pair {
                require_body(&space, link).map_err(named)?;
            }
            if pair[0] == pair[1] {
                return Err(named(Error::invalid(format!(
                    "link {} is paired with itself",
                    pair[0]
                ))));
            }
        }
        let mut distinct: Vec<[usize; 2]> = Vec::with_capacity(pairs.len());
        let mut seen = HashSet::new();
        for &[r, s] in pairs {
            if seen.insert([r.min(s), r.max(s)]) {
                distinct.push([r, s]);
            }
        }
        Ok(Self {
            space,
            terms: vec![Arc::new(Term::Links {
                pairs: distinct,
                options,
            })],
        })
    }

    /// The union of C-objects over one space.
    pub fn union(parts: &[Arc<CObject>]) -> Result<Self> {
        let Some(first) = parts.first() else {
            return Err(Error::new(
                ErrorKind::Empty,
                "a union needs at least one C-object",
            ));
        };
        let mut seen = HashSet::new();
        let serial = first.space.serial();
        if let Some(i) = parts.iter().position(|part| part.space.serial() != serial) {
            return Err(Error::invalid(format!(
                "C-object {i} belongs to another space than C-object 0"
            )));
        }
        Ok(Self {
            space: first.space.clone(),
            terms: parts
                .iter()
                .flat_map(|part| &part.terms)
                .filter(|term| seen.insert(Arc::as_ptr(term)))
                .cloned()
                .collect(),
        })
    }

    /// The same set as it is now: its environments stay in the state they are in.
    pub fn frozen(&self) -> Self {
        let mut frozen: Vec<(u64, Arc<Environment>)> = Vec::new();
        let mut freeze = |environment: &Arc<Environment>| {
            let serial = environment.serial();
            let known = frozen.iter().find(|(other, _)| *other == serial);
            match known {
                Some((_, environment)) => environment.clone(),
                None => {
                    let now = Arc::new(environment.freeze());
                    frozen.push((serial, now.clone()));
                    now
                }
            }
        };
        let terms = self.terms.iter().map(|term| match &**term {
            Term::Links { .. } => term.clone(),
            Term::Objects {
                links,
                objects,
                options,
            } => Arc::new(Term::Objects {
                links: links.clone(),
                objects: match objects {
                    SObjects::All(environment) => SObjects::All(freeze(environment)),
                    SObjects::Some(environment, ids) => {
                        SObjects::Some(freeze(environment), ids.clone())
                    }
                },
                options: *options,
            }),
        });
        let terms = terms.collect();
        Self {
            space: self.space.clone(),
            terms,
        }
    }

    /// The same without what no link that moves takes part in; `None` if nothing is left.
    pub fn moving(&self, moves: impl Fn(usize) -> bool) -> Option<Self> {
        let terms = self.terms.iter().filter_map(|term| match &**term {
            Term::Links { pairs, options } => {
                let pairs: Vec<[usize; 2]> = pairs
                    .iter()
                    .filter(|pair| pair.iter().any(|&link| moves(link)))
                    .copied()
                    .collect();
                (!pairs.is_empty()).then_some(Term::Links {
                    pairs,
                    options: *options,
                })
            }
            Term::Objects {
                links,
                objects,
                options,
            } => {
                let links: Vec<usize> = links.iter().filter(|&&l| moves(l)).copied().collect();
                (!links.is_empty()).then(|| Term::Objects {
                    links,
                    objects: match objects {
                        SObjects::All(environment) => SObjects::All(environment.clone()),
                        SObjects::Some(environment, ids) => {
                            SObjects::Some(environment.clone(), ids.clone())
                        }
                    },
                    options: *options,
                })
            }
        });
        let terms: Vec<Arc<Term>> = terms.map(Arc::new).collect();
        (!terms.is_empty()).then(|| Self {
            space: self.space.clone(),
            terms,
        })
    }

    pub fn space(&self) -> &Arc<Space> {
        &self.space
    }

    /// The simple C-objects whose union this is.
    pub fn terms(&self) -> &[Arc<Term>] {
        &self.terms
    }
}

fn check_options(options: &InducedOptions) -> Result<()> {
    for (value, name) in [
        (options.contact_epsilon, "contact_epsilon"),
        (options.margin, "margin"),
    ] {
        require_finite(&[value], name)?;
        if value < 0.0 {
            return Err(Error::invalid(format!("{name} is negative: {value}")));
        }
    }
    Ok(())
}

fn require_body(space: &Space, link: usize) -> Result<()> {
    let found = space.link(link).ok_or_else(|| {
        Error::new(
            ErrorKind::NotFound,
            format!(
                "link {link} does not exist; the space has {}",
                space.link_count()
            ),
        )
    })?;
    if found.body.is_none() {
        return Err(Error::new(
            ErrorKind::Empty,
            format!("link {link} (\"{}\") has no body", found.name),
        ));
    }
    Ok(())
}
