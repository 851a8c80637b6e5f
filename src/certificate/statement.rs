//! What a certificate is to show: the items that a C-object asks about, in an order that its definition gives.

use std::cmp::Ordering;
use std::collections::HashMap;
use std::sync::Arc;

use super::certificate::Entry;
use crate::body::Body;
use crate::cobject::{CObject, Induced, PureSet, PureShape, Set};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Pose, Vec3};
use crate::query::{SSide, Scene, Target};
use crate::space::Space;

/// C-objects that ask about more items have no certificates.
const MAX_ITEMS: u32 = 1 << 22;

/// All that is to be shown.
pub(super) struct Statement<'a> {
    pub space: &'a Space,
    pub claim: Claim<'a>,
    /// The different bodies of the items. Bodies of the same content are one.
    pub bodies: Vec<&'a Body>,
    /// Their digests.
    pub digests: Vec<[u8; 32]>,
}

/// What is to be shown of a set: that the motion keeps out of it.
pub(super) enum Claim<'a> {
    /// It keeps out of each.
    All(Vec<Claim<'a>>),
    /// At every time it keeps out of one of them at least.
    One {
        parts: Vec<Alternative<'a>>,
        /// Why a part has no claim.
        refused: Option<Error>,
    },
    Item(Box<Item<'a>>),
}

/// A part of an intersection.
pub(super) struct Alternative<'a> {
    /// `None` for sets that certificates do not show.
    pub claim: Option<Claim<'a>>,
    /// The set itself; `None` for complements of induced sets.
    pub set: Option<Arc<CObject>>,
}

/// Something that is to be shown farther away than a limit.
pub(super) struct Item<'a> {
    pub number: u32,
    /// The threshold, with the margin of the set and the deviations that the bodies state.
    pub limit: f64,
    pub what: What<'a>,
}

pub(super) enum What<'a> {
    Bodies([Carried<'a>; 2]),
    /// Points over a plane of the world.
    Plane {
        points: Carried<'a>,
        normal: Vec3,
        offset: f64,
        /// Points on the plane are not in the set.
        is_open: bool,
    },
    /// A set given in C-space.
    Coordinates(&'a PureSet),
}

/// A body, or without one the origin of its frame.
#[derive(Clone, Copy)]
pub(super) struct Carried<'a> {
    /// What carries it; `None` for the world.
    pub link: Option<usize>,
    /// Its pose there.
    pub pose: Pose,
    pub body: Option<&'a Body>,
    /// The place of the body among those of the statement.
    pub place: usize,
}

impl<'a> Statement<'a> {
    /// Fails for leaves that certificates do not show, and names them. The scene is that at the start of the motion.
    pub fn of(cobject: &'a CObject, scene: &'a Scene, threshold: f64) -> Result<Self> {
        let mut builder = Builder {
            scene,
            threshold,
            items: 0,
            sets: 0,
            digests: HashMap::new(),
            places: HashMap::new(),
            statement: Self {
                space: scene.space(),
                claim: Claim::All(Vec::new()),
                bodies: Vec::new(),
                digests: Vec::new(),
            },
        };
        let claim = builder.set(cobject, false)?;
        Ok(Self {
            claim,
            ..builder.statement
        })
    }
}

struct Builder<'a> {
    scene: &'a Scene<'a>,
    threshold: f64,
    /// The number of the next item.
    items: u32,
    /// How many sets have been looked at: what stands in several sets counts in each.
    sets: u32,
    /// Of bodies by their serials.
    digests: HashMap<u64, [u8; 32]>,
    /// Of bodies by their digests.
    places: HashMap<[u8; 32], usize>,
    statement: Statement<'a>,
}

/// A body at a pose in the frame of what carries it.
struct Side<'a> {
    link: Option<usize>,
    pose: Pose,
    body: &'a Body,
    digest: [u8; 32],
}

impl Side<'_> {
    /// An order by content alone.
    fn order(&self, other: &Self) -> Ordering {
        let key = |side: &Self| (side.link, side.digest);
        let order = key(self).cmp(&key(other));
        order.then_with(|| self.pose.order(&other.pose))
    }
}

fn unsupported(leaf: u64, what: &str) -> Error {
    Error::new(
        ErrorKind::Unsupported,
        format!("C-object {leaf} has no certificate: {what}"),
    )
}

impl<'a> Builder<'a> {
    fn set(&mut self, cobject: &'a CObject, complement: bool) -> Result<Claim<'a>> {
        count(&mut self.sets)?;
        let (is_union, terms, parts) = match cobject.set() {
            // A certificate takes nobody's word.
            Set::Known(known) => return self.set(&known.of, complement),
            Set::Complement(part) => return self.set(part, !complement),
            Set::Pure(pure) if complement => {
                let what = format!("it is the complement of {}", pure.shape.name());
                return Err(unsupported(pure.leaf.serial, &what));
            }
            Set::Pure(pure) => return self.pure(pure),
            Set::Union { induced, others } => (true, &induced[..], &others[..]),
            Set::Intersection(parts) => (false, &[][..], &parts[..]),
        };
        if is_union != complement {
            let mut claims = Vec::new();
            for term in terms {
                claims.push(self.term(term, complement)?);
            }
            for part in parts {
                claims.push(self.set(part, complement)?);
            }
            return Ok(Claim::All(claims));
        }
        let mut alternatives = Alternatives::default();
        for term in terms {
            let before = self.items;
            let found = self.term(term, complement);
            self.items = alternatives.push(found, None, [before, self.items])?;
        }
        for part in parts {
            let set = match complement {
                false => part.clone(),
                true => Arc::new(CObject::complement(part)?),
            };
            let before = self.items;
            let found = self.set(part, complement);
            self.items = alternatives.push(found, Some(set), [before, self.items])?;
        }
        alternatives.claim()
    }

    fn term(&mut self, term: &'a Induced, complement: bool) -> Result<Claim<'a>> {
        let leaf = term.leaf.serial;
        if complement {
            let what = "it is the complement of an induced set";
            return Err(unsupported(leaf, what));
        }
        let mut pairs = Vec::new();
        self.scene.visit_every_pair(term, |target| {
            let sides = self
                .sides(&target)
                .map_err(|_| unsupported(leaf, "a body has a support function of the caller's"))?;
            pairs.push((sides, target.margin()));
            Ok(())
        })?;
        // Not by ids, which tell how an environment came about: those of an octree's tiles change with its cells.
        pairs.sort_by(|([a, b], _), ([c, d], _)| a.order(c).then_with(|| b.order(d)));
        let mut items = Vec::with_capacity(pairs.len());
        for (sides, margin) in pairs {
            let sides = sides.map(|side| self.carried(side));
            items.push(self.item(self.threshold + margin, What::Bodies(sides))?);
        }
        Ok(Claim::All(items))
    }

    fn sides(&mut self, target: &Target<'a>) -> Result<[Side<'a>; 2]> {
        let (r_link, r_object, s_side) = target.ids();
        let (_, s_link) = target.links();
        let [(a, _), (b, s_pose)] = target.sides;
        let held = |id: u64| self.scene.held().iter().find(|held| held.object.id == id);
        let on_link = |id: u64| held(id).map_or(Pose::identity(), |held| held.object.pose);
        let r_pose = on_link(r_object);
        let s_pose = match s_side {
            SSide::Object(id) if s_link.is_some() => on_link(id),
            SSide::Object(_) => *s_pose,
            _ => Pose::identity(),
        };
        let mut sides = [
            self.side(Some(r_link), a, r_pose)?,
            self.side(s_link, b, s_pose)?,
        ];
        // Of two attached objects ids say which is the first side.
        let are_attached = r_object != 0 && s_link.is_some() && s_side.link().is_none();
        if are_attached && sides[0].order(&sides[1]).is_gt() {
            sides.reverse();
        }
        Ok(sides)
    }

    fn side(&mut self, link: Option<usize>, body: &'a Body, pose: Pose) -> Result<Side<'a>> {
        let digest = match self.digests.get(&body.serial()) {
            Some(known) => *known,
            None => body.digest()?,
        };
        self.digests.insert(body.serial(), digest);
        Ok(Side {
            link,
            pose,
            body,
            digest,
        })
    }

    /// The side, with the place of its body among those of the statement.
    fn carried(&mut self, side: Side<'a>) -> Carried<'a> {
        let Statement {
            bodies, digests, ..
        } = &mut self.statement;
        let place = *self.places.entry(side.digest).or_insert_with(|| {
            bodies.push(side.body);
            digests.push(side.digest);
            bodies.len() - 1
        });
        Carried {
            link: side.link,
            pose: side.pose,
            body: Some(side.body),
            place,
        }
    }

    fn pure(&mut self, pure: &'a PureSet) -> Result<Claim<'a>> {
        let mut items = Vec::new();
        let limit = self.threshold;
        match &pure.shape {
            PureShape::Predicate(_) => {
                let what = "it is a predicate, which only its caller knows";
                return Err(unsupported(pure.leaf.serial, what));
            }
            PureShape::Floor {
                links,
                normal,
                offset,
            } => {
                for &link in links {
                    let Some((body, _)) = self.scene.link(link) else {
                        continue;
                    };
                    let on_link = Pose::identity();
                    let side = self.side(Some(link), body, on_link).map_err(|_| {
                        let what = "a body has a support function of the caller's";
                        unsupported(pure.leaf.serial, what)
                    })?;
                    let points = self.carried(side);
                    let what = What::Plane {
                        points,
                        normal: *normal,
                        offset: *offset,
                        is_open: false,
                    };
                    let limit = limit + body.stated_deviation();
                    items.push(self.item(limit, what)?);
                }
            }
            PureShape::BeyondWorld { links } => {
                let space = self.scene.space();
                let world = space.world();
                for &link in links {
                    for axis in 0..space.dimension() as usize {
                        for (end, sign) in [(world.low[axis], 1.0), (world.high[axis], -1.0)] {
                            if end.is_infinite() {
                                continue;
                            }
                            let what = What::Plane {
                                points: Carried {
                                    link: Some(link),
                                    pose: Pose::identity(),
                                    body: None,
                                    place: 0,
                                },
                                normal: Vec3::ith(axis, sign),
                                offset: sign * end,
                                is_open: true,
                            };
                            items.push(self.item(limit, what)?);
                        }
                    }
                }
            }
            _ => items.push(self.item(limit, What::Coordinates(pure))?),
        }
        Ok(Claim::All(items))
    }

    fn item(&mut self, limit: f64, what: What<'a>) -> Result<Claim<'a>> {
        let number = count(&mut self.items)?;
        Ok(Claim::Item(Box::new(Item {
            number,
            limit,
            what,
        })))
    }
}

/// The next number.
fn count(counter: &mut u32) -> Result<u32> {
    *counter += 1;
    if *counter > MAX_ITEMS {
        return Err(Error::new(
            ErrorKind::Limit,
            format!("the C-object asks about more than {MAX_ITEMS} pairs of bodies and sets"),
        ));
    }
    Ok(*counter - 1)
}

/// The parts of an intersection.
#[derive(Default)]
struct Alternatives<'a> {
    parts: Vec<Alternative<'a>>,
    refused: Option<Error>,
}

impl<'a> Alternatives<'a> {
    /// Adds a part, unless it failed by more than that certificates do not show it. Returns the number of the next item, of those
    /// before and after the part.
    fn push(
        &mut self,
        found: Result<Claim<'a>>,
        set: Option<Arc<CObject>>,
        [before, after]: [u32; 2],
    ) -> Result<u32> {
        let (claim, next) = match found {
            Ok(claim) => (Some(claim), after),
            Err(error) if error.kind == ErrorKind::Unsupported => {
                self.refused.get_or_insert(error);
                (None, before)
            }
            Err(error) => return Err(error),
        };
        self.parts.push(Alternative { claim, set });
        Ok(next)
    }

    fn claim(self) -> Result<Claim<'a>> {
        let Self { parts, refused } = self;
        match refused {
            Some(error) if parts.iter().all(|part| part.claim.is_none()) => Err(error),
            refused => Ok(Claim::One { parts, refused }),
        }
    }
}

impl<'a> Item<'a> {
    /// What moves: the body of a link and what it is to keep away from; nothing of a set given in C-space.
    pub fn sides(&self) -> [Option<&Carried<'a>>; 2] {
        match &self.what {
            What::Bodies([a, b]) => [Some(a), Some(b)],
            What::Plane { points, .. } => [Some(points), None],
            What::Coordinates(_) => [None, None],
        }
    }

    /// The links of an entry about it.
    pub fn links(&self) -> [u32; 2] {
        let link = |side: Option<&Carried>| side.and_then(|side| side.link);
        self.sides()
            .map(|side| link(side).map_or(Entry::NONE, |link| link as u32))
    }

    /// The bodies of an entry about it.
    pub fn bodies(&self) -> [u32; 2] {
        let place = |side: &Carried| side.body.map(|_| side.place as u32);
        self.sides()
            .map(|side| side.and_then(place).unwrap_or(Entry::NONE))
    }

    /// All primitives of both bodies.
    pub fn whole(&self) -> [[u32; 2]; 2] {
        let count = |side: &Carried| side.body.map_or(0, |body| body.primitives().len() as u32);
        self.sides().map(|side| [0, side.map_or(0, count)])
    }
}
