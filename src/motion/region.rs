//! Whole boxes of C-space: whether all of their configurations are out of a C-object, or all inside. Nothing rests on samples but that
//! a box is mixed.

use super::crowd::CrowdMemory;
use super::gathering::{Gathering, Keeps};
use super::links_on_way::LinksOnWay;
use super::moving_set::MovingSet;
use super::pair_rates::PairRates;
use super::region_proof::{BoxProof, BoxWork, Center, Region, RegionProof, prove_region};
use super::set_tree::SetTree;
use crate::cobject::{CObject, Class};
use crate::error::{Error, ErrorKind, Result};
use crate::query::{QueryContext, World};
use crate::robot::Coordinate;
use crate::space::Space;

/// How much work a box may take.
#[derive(Clone, Copy, Debug)]
pub struct RegionOptions {
    /// The most boxes that the box is halved into, at least 1.
    pub max_boxes: usize,
}

impl Default for RegionOptions {
    fn default() -> Self {
        Self { max_boxes: 1000 }
    }
}

/// What is known of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegionOutcome {
    /// Proved: no configuration of the box is inside the C-object.
    Free,
    /// Proved: every configuration of the box is inside.
    Inside,
    /// One configuration of the box is inside, and another is not.
    Mixed,
    /// The work ended before one of the others was known.
    Undecided,
}

/// What was found of a box.
#[derive(Clone, Debug)]
pub struct RegionAnswer {
    /// What is known.
    pub outcome: RegionOutcome,
    /// The part of the box's volume that is proved to be like its middle: 1 for free and inside.
    pub proved: f64,
    /// A configuration of the box that is inside, if one is known.
    pub inside: Option<Vec<f64>>,
    /// One that is not inside.
    pub outside: Option<Vec<f64>>,
}

impl RegionOptions {
    pub(crate) fn check(&self) -> Result<()> {
        if self.max_boxes == 0 {
            return Err(Error::invalid(
                "max_boxes is 0: not even one box is looked at",
            ));
        }
        Ok(())
    }
}

impl QueryContext {
    /// Whether all configurations between `low` and `high` are out of a C-object, or all inside. On a circle these are the angles from
    /// `low` upwards to `high`. Quaternions must be the same in both.
    pub fn classify_region(
        &mut self,
        cobject: &CObject,
        low: &[f64],
        high: &[f64],
        options: &RegionOptions,
    ) -> Result<RegionAnswer> {
        let world = &self.look(cobject);
        self.classify_region_in(world, cobject, [low, high], options)
    }

    /// The same in a given world.
    pub(crate) fn classify_region_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        [low, high]: [&[f64]; 2],
        options: &RegionOptions,
    ) -> Result<RegionAnswer> {
        options.check()?;
        let region = &checked(cobject.space(), low, high)?;
        let Center { q, .. } = region.center(cobject.space());
        let is_inside = self.classify_in(world, cobject, &q)? == Class::Inside;
        let keeps = if is_inside { Keeps::In } else { Keeps::Out };
        let found = self.prove_region(
            world,
            cobject,
            region,
            keeps,
            BoxWork::sampled(options.max_boxes),
        )?;
        let (outcome, proved, other) = match found {
            BoxProof::Free if is_inside => (RegionOutcome::Inside, 1.0, None),
            BoxProof::Free => (RegionOutcome::Free, 1.0, None),
            BoxProof::Meets(other) => (RegionOutcome::Mixed, 0.0, Some(other)),
            BoxProof::Undecided { proved, .. } => (RegionOutcome::Undecided, proved, None),
        };
        let [inside, outside] = if is_inside {
            [Some(q), other]
        } else {
            [other, Some(q)]
        };
        Ok(RegionAnswer {
            outcome,
            proved,
            inside,
            outside,
        })
    }

    /// Proves that all configurations of a box are as its middle is, which the caller has classified: not inside, or inside. A body may
    /// be inside a solid without meeting its surface.
    pub(super) fn prove_region(
        &mut self,
        world: &World,
        cobject: &CObject,
        region: &Region,
        keeps: Keeps,
        work: BoxWork,
    ) -> Result<BoxProof> {
        let center = &region.center(cobject.space());
        let way = &region.way(world, cobject, center);
        let tree = &match keeps {
            Keeps::Out => SetTree::new(cobject, true),
            Keeps::In => SetTree::of_complement(cobject),
        };
        if way.is_free_by_word(tree)? {
            return Ok(BoxProof::Free);
        }
        let motions = &way.link_motions();
        let scene = &way.scene(&center.q)?;
        let links = LinksOnWay::new(way, scene, PairRates::new(motions), None);
        let mut gathering = Gathering::new(way, scene, links, 0.0, tree, keeps);
        for leaf in &tree.leaves {
            gathering.add(leaf, self)?;
        }
        let crowds = gathering.crowds(&mut CrowdMemory::default());
        let Gathering { leaves, pairs, .. } = gathering;
        let set = &MovingSet {
            way: Some(way),
            tree,
            leaves,
            pairs,
            crowds,
        };
        let proof = RegionProof {
            world,
            cobject,
            set,
            region,
            work,
        };
        prove_region(proof, self, &mut |context, q| {
            let is_inside = context.classify_in(world, cobject, q)? == Class::Inside;
            Ok(is_inside == (keeps == Keeps::Out))
        })
    }
}

/// A box, if it is one.
pub(super) fn checked(space: &Space, low: &[f64], high: &[f64]) -> Result<Region> {
    for (q, name) in [(low, "low"), (high, "high")] {
        space
            .check_configuration(q)
            .map_err(|error| error.within(name))?;
    }
    for (c, coordinate) in space.coordinates().iter().enumerate() {
        let ends = [low[c], high[c]];
        if *coordinate == Coordinate::Quaternion && ends[0] != ends[1] {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!(
                    "coordinate {c} belongs to a quaternion, which must be the same in low and high"
                ),
            ));
        }
        if ends[0] > ends[1] {
            return Err(Error::invalid(format!(
                "coordinate {c} has low {} above high {}",
                ends[0], ends[1]
            )));
        }
    }
    Ok(Region {
        low: low.to_vec(),
        high: high.to_vec(),
    })
}
