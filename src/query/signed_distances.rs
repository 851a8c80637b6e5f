//! Signed distances of all near body pairs with their derivatives, for planners that optimise: positive apart, minus the depth
//! of bodies that meet.

use super::answer::Witness;
use super::candidates::CandidateFilter;
use super::context::{QueryContext, check_threshold};
use super::scene::{Configuration, Group, Scene};
use super::signed_derivative::{Derivative, GradientKind, SeenPair};
use super::target::Target;
use crate::cobject::{CObject, InducedOptions, Leaf, Set};
use crate::depth::{DepthOptions, require_inside};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;

/// The signed distance of two bodies, less the margin.
#[derive(Clone, Debug)]
pub struct SignedDistance {
    /// Which bodies, and which of their primitives decide. Without contacts.
    pub witness: Witness,
    /// The distance; for bodies that meet minus the length of the shortest translation known to part them.
    pub distance: f64,
    /// The true signed distance is not smaller.
    pub lower: f64,
    /// The true signed distance is not larger.
    pub upper: f64,
    /// The unit direction in which the r-side must move to get away from the s-side fastest. 0 if undefined.
    pub normal: Vec3,
    /// The witness points, r-side first: for bodies that meet, the two that touch once the r-side has moved.
    pub points: [Vec3; 2],
    /// What the row of the gradients is.
    pub gradient: GradientKind,
}

/// The signed distances of the pairs within a range, least first.
#[derive(Clone, Debug, Default)]
pub struct SignedDistanceList {
    /// One entry per body pair.
    pub pairs: Vec<SignedDistance>,
    /// A row of `nv` entries per pair.
    pub gradients: Vec<f64>,
    /// The length of a row.
    pub nv: usize,
    /// There are more pairs than requested; these have the least distances.
    pub truncated: bool,
    /// The version of the environment that the query saw; 0 without an environment.
    pub version: u64,
}

/// A signed distance with its row.
struct Measured {
    pair: SignedDistance,
    row: Vec<f64>,
}

/// So many pairs are measured before the list is cut to those asked for.
const MIN_KEPT: usize = 64;

impl QueryContext {
    /// The signed distances of all body pairs of a union of induced sets that are at most `max_distance` apart, less the margin,
    /// with their derivatives; at most `max_count`, least first.
    pub fn signed_distances(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        max_distance: f64,
        max_count: usize,
        options: &DepthOptions,
    ) -> Result<SignedDistanceList> {
        check_threshold(max_distance, "max_distance")?;
        check_threshold(options.tolerance, "options->tolerance")?;
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        let group = match cobject.set() {
            Set::Union { induced, others } if others.is_empty() => induced,
            _ => {
                return Err(Error::new(
                    ErrorKind::Unsupported,
                    "signed distances are of induced C-objects and their unions only",
                ));
            }
        };
        let world = self.look(cobject);
        let at = Configuration::Coordinates(q);
        self.with_scene(cobject, &world, at, |context, scene| {
            context.group_signed_distances(group, scene, max_distance, max_count, options)
        })
    }

    fn group_signed_distances(
        &mut self,
        group: &Group,
        scene: &Scene,
        max_distance: f64,
        max_count: usize,
        options: &DepthOptions,
    ) -> Result<SignedDistanceList> {
        let filter = CandidateFilter::within(max_distance);
        let candidates = self.candidates(scene, scene.checked(group)?, filter)?;
        let mut found = Vec::new();
        let (mut truncated, mut limit) = (false, max_distance);
        for target in &candidates {
            let leaf = group[target.term as usize].leaf;
            let measured = self.signed_distance(scene, target, leaf, limit, options)?;
            found.extend(measured.map(|measured| (target.rank, measured)));
            // What is too far down is not kept, and what is beyond all that are listed is not measured.
            if found.len() > MIN_KEPT.max(max_count.saturating_mul(2)) {
                truncated |= trim(&mut found, max_count);
                let farthest = found.last().map(|(_, last)| last.pair.distance);
                limit = farthest.map_or(limit, |distance| limit.min(distance.max(0.0)));
            }
        }
        self.keep_memory(candidates);
        truncated |= trim(&mut found, max_count);
        let mut list = SignedDistanceList {
            nv: scene.space().nv(),
            truncated,
            version: scene.version(),
            ..Default::default()
        };
        for (_, measured) in found {
            list.pairs.push(measured.pair);
            list.gradients.extend(measured.row);
        }
        Ok(list)
    }

    /// The signed distance of one body pair; `None` beyond the maximum.
    fn signed_distance(
        &mut self,
        scene: &Scene,
        target: &Target,
        leaf: Leaf,
        max_distance: f64,
        options: &DepthOptions,
    ) -> Result<Option<Measured>> {
        let margin = target.margin();
        let excess = 2.0 * target.stated_deviation();
        let (hit, doubt) = {
            let alone = &[without_margin(target)];
            let found = self.nearest(alone, max_distance + margin)?;
            match found.hit {
                Some((hit, _)) => (hit, hit.distance - found.lower),
                None => return Ok(None),
            }
        };
        let witness = Witness {
            distance: (hit.distance - margin).max(0.0),
            ..Witness::of(&target.parties(), &hit, leaf)
        };
        let seen = &SeenPair::new(scene, target);
        let error = seen.pairing.precision.error;
        if hit.contained.is_none() && hit.apart > error {
            let apart = Derivative::of_apart(seen, &hit, &mut self.scratch)?;
            let pair = SignedDistance {
                distance: hit.apart - margin,
                lower: hit.apart - margin - doubt.max(error),
                upper: hit.apart - margin + excess + error,
                ..SignedDistance::with(&apart, witness)
            };
            return Ok(Some(Measured {
                pair: if pair.lower + target.options.margin > 0.0 {
                    pair
                } else {
                    of_approximate(pair, target)
                },
                row: apart.row,
            }));
        }
        let [(a, _), (b, _)] = target.sides;
        if require_inside(a, b).is_err() {
            let undefined = Derivative::undefined(seen);
            let pair = SignedDistance {
                distance: -margin,
                lower: f64::NEG_INFINITY,
                upper: excess - margin,
                ..SignedDistance::with(&undefined, witness)
            };
            return Ok(Some(Measured {
                pair,
                row: undefined.row,
            }));
        }
        let found = self.searched_depth(target, options, |search| search.explained())?;
        let out = Derivative::of_way_out(seen, &found)?;
        let depth = &found.depth;
        let pair = SignedDistance {
            distance: -depth.upper - margin,
            lower: -depth.upper - margin,
            upper: -depth.lower - margin,
            ..SignedDistance::with(&out, witness)
        };
        let pair = of_approximate(pair, target);
        Ok(Some(Measured { pair, row: out.row }))
    }
}

impl SignedDistance {
    /// A pair whose distances are still to be set.
    fn with(derivative: &Derivative, witness: Witness) -> Self {
        Self {
            witness,
            distance: 0.0,
            lower: 0.0,
            upper: 0.0,
            normal: derivative.normal,
            points: derivative.points,
            gradient: derivative.kind,
        }
    }
}

/// Sorts pairs by distance and rank, and cuts them to as many as are asked for. Whether any are left out.
fn trim<R: Ord>(found: &mut Vec<(R, Measured)>, max_count: usize) -> bool {
    found.sort_by(|(rank_a, a), (rank_b, b)| {
        let by_distance = a.pair.distance.total_cmp(&b.pair.distance);
        by_distance.then(rank_a.cmp(rank_b))
    });
    let is_cut = found.len() > max_count;
    found.truncate(max_count);
    is_cut
}

/// The same pair, measured without a margin: within a margin the nearest primitives are not looked for.
fn without_margin<'a>(target: &Target<'a>) -> Target<'a> {
    let options = InducedOptions {
        margin: -target.stated_deviation(),
        ..target.options
    };
    Target {
        options,
        bound: target.bound + target.margin(),
        ..*target
    }
}

/// The signed distance of bodies that meet, or may meet, by what is known of what they stand for. That this meets is not proved. It lies
/// in the bodies grown by the stated deviations: convex ones are deeper in each other by these at most, others may have no way out left.
fn of_approximate(pair: SignedDistance, target: &Target) -> SignedDistance {
    let stated = target.stated_deviation();
    if stated == 0.0 {
        return pair;
    }
    let are_convex = target
        .sides
        .iter()
        .all(|(body, _)| body.primitives().len() == 1);
    SignedDistance {
        lower: match are_convex {
            true => pair.lower,
            false => f64::NEG_INFINITY,
        },
        upper: pair.upper.max(stated - target.options.margin),
        ..pair
    }
}
