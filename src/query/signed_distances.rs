//! Signed distances of all near body pairs with their derivatives, for planners that optimise: positive apart, minus the depth
//! of bodies that meet.

use super::answer::Witness;
use super::candidates::CandidateFilter;
use super::context::{QueryContext, check_threshold};
use super::scene::{Configuration, Group, Scene};
use super::target::Target;
use crate::cobject::{CObject, InducedOptions, Leaf, Set};
use crate::depth::{Depth, DepthOptions, Touching, require_inside, touching_at};
use crate::error::{Error, ErrorKind, Result};
use crate::pair::Hit;
use crate::pose::Vec3;
use crate::robot::RobotState;
use crate::tolerance;

/// What the row of a signed distance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GradientKind {
    /// The derivative.
    Derivative,
    /// Several features are nearest, or several ways out shortest: the derivative of one of them. The distance has no
    /// derivative here.
    OneOfSeveral,
    /// The depth is not known to the tolerance, or its way out is not explained by what it touches: the derivative of the
    /// translation found.
    Approximate,
    /// The bodies meet, and neither has an inside everywhere: no depth is defined. The row is 0.
    Undefined,
}

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

/// Contacts whose distances differ by less than this, times the pair's size, are equally near.
const EQUALLY_NEAR: f64 = 1e-10;

/// Rows that differ by less than this, times their size, are of one derivative.
const SAME_ROW: f64 = 1e-7;

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
        let state = scene.state().expect("the configuration is known");
        let error = target.pairing().precision.error;
        if hit.contained.is_none() && hit.apart > error {
            let apart = self.apart(scene, state, target, &hit)?;
            let pair = SignedDistance {
                distance: hit.apart - margin,
                lower: hit.apart - margin - doubt.max(error),
                upper: hit.apart - margin + excess + error,
                ..apart.pair_of(witness)
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
            let undefined =
                Derivative::undefined(scene.space().nv(), &target.pairing().frame.translation);
            let pair = SignedDistance {
                distance: -margin,
                lower: f64::NEG_INFINITY,
                upper: excess - margin,
                ..undefined.pair_of(witness)
            };
            return Ok(Some(Measured {
                pair,
                row: undefined.row,
            }));
        }
        let options = DepthOptions {
            seeks_rivals: true,
            ..*options
        };
        let depth = self.depth_of(target, &options)?;
        let out = way_out(scene, state, target, &depth)?;
        let pair = SignedDistance {
            distance: -depth.upper - margin,
            lower: -depth.upper - margin,
            upper: -depth.lower - margin,
            ..out.pair_of(witness)
        };
        let pair = of_approximate(pair, target);
        Ok(Some(Measured { pair, row: out.row }))
    }

    /// The derivative for bodies that are apart.
    fn apart(
        &mut self,
        scene: &Scene,
        state: RobotState,
        target: &Target,
        hit: &Hit,
    ) -> Result<Derivative> {
        let pairing = target.pairing();
        let reach = hit.apart + EQUALLY_NEAR * pairing.precision.size;
        let (touching, is_all) = touching_at(&pairing, &Vec3::zeros(), reach, &mut self.scratch);
        self.scratch.meter().check()?;
        let near: Vec<&Touching> = touching
            .iter()
            .filter(|contact| contact.gap <= reach)
            .collect();
        let own = |contact: &&&Touching| contact.primitives == hit.key.primitives;
        let Some(&first) = near.iter().find(own).or(near.first()) else {
            return Ok(Derivative::undefined(
                scene.space().nv(),
                &pairing.frame.translation,
            ));
        };
        let rows: Result<Vec<Vec<f64>>> = near
            .iter()
            .map(|contact| row(scene, state, target, &contact.normal, contact))
            .collect();
        let own_row = row(scene, state, target, &first.normal, first)?;
        let is_one = rows?.iter().all(|row| are_same(row, &own_row));
        Ok(Derivative {
            row: own_row,
            normal: pairing.frame.rotation * first.normal,
            points: first.points.map(|p| pairing.frame.transform_point(&p)),
            kind: match is_one && is_all {
                true => GradientKind::Derivative,
                false => GradientKind::OneOfSeveral,
            },
        })
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

/// The derivative of a signed distance, with what it is taken at. In the world.
struct Derivative {
    row: Vec<f64>,
    normal: Vec3,
    points: [Vec3; 2],
    kind: GradientKind,
}

impl Derivative {
    fn undefined(nv: usize, point: &Vec3) -> Self {
        Self {
            row: vec![0.0; nv],
            normal: Vec3::zeros(),
            points: [*point; 2],
            kind: GradientKind::Undefined,
        }
    }

    /// A pair whose distances are still to be set.
    fn pair_of(&self, witness: Witness) -> SignedDistance {
        SignedDistance {
            witness,
            distance: 0.0,
            lower: 0.0,
            upper: 0.0,
            normal: self.normal,
            points: self.points,
            gradient: self.kind,
        }
    }
}

/// The derivative for bodies that meet. The way out t is as long as the half-spaces n_k . t >= o_k make it that touch after it;
/// the derivative of |t| is the sum of their multipliers times the derivatives of o_k - n_k . t, which are those of the
/// distances of what touches there.
fn way_out(scene: &Scene, state: RobotState, target: &Target, depth: &Depth) -> Result<Derivative> {
    let pairing = target.pairing();
    let direction = depth.way / depth.upper;
    let Some(first) = &depth.first else {
        let mut undefined = Derivative::undefined(scene.space().nv(), &pairing.frame.translation);
        undefined.kind = GradientKind::Approximate;
        undefined.normal = pairing.frame.rotation * direction;
        return Ok(undefined);
    };
    let mut sum = vec![0.0; scene.space().nv()];
    let mut is_one = !depth.has_rival;
    for (weight, contacts) in &depth.out.terms {
        let normal = contacts[0].normal * *weight;
        let own = row(scene, state, target, &normal, &contacts[0])?;
        for contact in &contacts[1..] {
            is_one &= are_same(&own, &row(scene, state, target, &normal, contact)?);
        }
        sum.iter_mut().zip(&own).for_each(|(sum, x)| *sum += x);
    }
    if depth.out.terms.is_empty() {
        sum = row(scene, state, target, &direction, first)?;
    }
    let is_known = depth.is_tight && depth.out.is_explained;
    Ok(Derivative {
        row: sum,
        normal: pairing.frame.rotation * direction,
        points: first.points.map(|p| pairing.frame.transform_point(&p)),
        kind: match (is_known, is_one && depth.out.is_regular) {
            (false, _) => GradientKind::Approximate,
            (true, false) => GradientKind::OneOfSeveral,
            (true, true) => GradientKind::Derivative,
        },
    })
}

/// The derivative of the distance of two points along a direction, all in the centred frame of the first body.
fn row(
    scene: &Scene,
    state: RobotState,
    target: &Target,
    direction: &Vec3,
    contact: &Touching,
) -> Result<Vec<f64>> {
    let space = scene.space();
    let frame = target.pairing().frame;
    let [on_r, on_s] = contact.points.map(|p| frame.transform_point(&p));
    let direction = frame.rotation * direction;
    let mut row = vec![0.0; space.nv()];
    let (r_link, s_link) = target.links();
    space.add_gradient(state, r_link, &on_r, &direction, &mut row)?;
    if let Some(s_link) = s_link {
        space.add_gradient(state, s_link, &on_s, &-direction, &mut row)?;
    }
    Ok(row)
}

fn are_same(a: &[f64], b: &[f64]) -> bool {
    let size = a
        .iter()
        .chain(b)
        .fold(0.0, |size: f64, x| size.max(x.abs()));
    let slack = SAME_ROW * size + tolerance::EPSILON;
    a.iter().zip(b).all(|(x, y)| (x - y).abs() <= slack)
}
