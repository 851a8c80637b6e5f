//! The derivative of a signed distance of two bodies, on both sides of contact.

use super::scene::Scene;
use super::target::Target;
use super::witnesses::push_gradient;
use crate::depth::{ExplainedDepth, Touching, touching_at};
use crate::error::Result;
use crate::pair::{Hit, Pairing, Scratch};
use crate::pose::Vec3;
use crate::robot::RobotState;
use crate::tolerance;

/// Contacts whose distances differ by less than this, times the pair's size, are equally near.
const EQUALLY_NEAR: f64 = 1e-10;

/// Rows that differ by less than this, times their size, are of one derivative.
const SAME_ROW: f64 = 1e-7;

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

/// A body pair at a configuration.
pub(super) struct SeenPair<'t> {
    scene: &'t Scene<'t>,
    state: RobotState<'t>,
    target: &'t Target<'t>,
    pub pairing: Pairing<'t>,
}

impl<'t> SeenPair<'t> {
    pub fn new(scene: &'t Scene<'t>, target: &'t Target<'t>) -> Self {
        Self {
            scene,
            state: scene.state().expect("the configuration is known"),
            target,
            pairing: target.pairing(),
        }
    }

    /// The derivative of the distance of two points along a direction, all in the centred frame of the first body.
    fn row(&self, direction: &Vec3, contact: &Touching) -> Result<Vec<f64>> {
        let (normal, points) = self.in_world(direction, contact);
        let space = self.scene.space();
        let mut row = Vec::with_capacity(space.nv());
        push_gradient(
            space,
            self.state,
            self.target.links(),
            &normal,
            &points,
            &mut row,
        )?;
        Ok(row)
    }

    /// Whether a contact stands for others, which have other derivatives.
    fn is_flat(&self, contact: &Touching) -> bool {
        self.pairing
            .is_flat_contact(contact.primitives, &contact.normal)
    }

    fn in_world(&self, direction: &Vec3, contact: &Touching) -> (Vec3, [Vec3; 2]) {
        let frame = &self.pairing.frame;
        let points = contact.points.map(|p| frame.transform_point(&p));
        (frame.rotation * direction, points)
    }
}

/// The derivative of a signed distance, with what it is taken at. In the world.
pub(super) struct Derivative {
    pub row: Vec<f64>,
    pub normal: Vec3,
    pub points: [Vec3; 2],
    pub kind: GradientKind,
}

impl Derivative {
    pub fn undefined(seen: &SeenPair) -> Self {
        Self {
            row: vec![0.0; seen.scene.space().nv()],
            normal: Vec3::zeros(),
            points: [seen.pairing.frame.translation; 2],
            kind: GradientKind::Undefined,
        }
    }

    /// For bodies that are apart.
    pub fn of_apart(seen: &SeenPair, hit: &Hit, scratch: &mut Scratch) -> Result<Self> {
        let pairing = &seen.pairing;
        let cutoff = hit.apart + EQUALLY_NEAR * pairing.precision.size;
        let (touching, is_all) = touching_at(pairing, &Vec3::zeros(), cutoff, scratch);
        scratch.meter().check()?;
        let near: Vec<&Touching> = touching
            .iter()
            .filter(|contact| contact.gap <= cutoff)
            .collect();
        let own = |contact: &&&Touching| contact.primitives == hit.key.primitives;
        let Some(&first) = near.iter().find(own).or(near.first()) else {
            return Ok(Self::undefined(seen));
        };
        let row = seen.row(&first.normal, first)?;
        let mut is_one = is_all;
        for contact in near {
            is_one &=
                are_same(&row, &seen.row(&contact.normal, contact)?) && !seen.is_flat(contact);
        }
        let (normal, points) = seen.in_world(&first.normal, first);
        Ok(Self {
            row,
            normal,
            points,
            kind: match is_one {
                true => GradientKind::Derivative,
                false => GradientKind::OneOfSeveral,
            },
        })
    }

    /// For bodies that meet. The way out t is as long as the half-spaces n_k . t >= o_k make it that touch after it; the derivative of |t| is
    /// the sum of their multipliers times the derivatives of o_k - n_k . t, which are those of the distances of what touches there.
    pub fn of_way_out(seen: &SeenPair, found: &ExplainedDepth) -> Result<Self> {
        let depth = &found.depth;
        let direction = depth.way / depth.upper;
        let Some(first) = &found.first else {
            return Ok(Self {
                normal: seen.pairing.frame.rotation * direction,
                kind: GradientKind::Approximate,
                ..Self::undefined(seen)
            });
        };
        let mut sum = vec![0.0; seen.scene.space().nv()];
        let mut is_one = !found.has_rival;
        for (weight, contacts) in &found.out.terms {
            let normal = contacts[0].normal * *weight;
            let own = seen.row(&normal, &contacts[0])?;
            is_one &= !contacts.iter().any(|contact| seen.is_flat(contact));
            for contact in &contacts[1..] {
                is_one &= are_same(&own, &seen.row(&normal, contact)?);
            }
            sum.iter_mut().zip(&own).for_each(|(sum, x)| *sum += x);
        }
        if found.out.terms.is_empty() {
            sum = seen.row(&direction, first)?;
            is_one &= !seen.is_flat(first);
        }
        let is_known = depth.is_tight && found.out.is_explained;
        let (normal, points) = seen.in_world(&direction, first);
        Ok(Self {
            row: sum,
            normal,
            points,
            kind: match (is_known, is_one && found.out.is_regular) {
                (false, _) => GradientKind::Approximate,
                (true, false) => GradientKind::OneOfSeveral,
                (true, true) => GradientKind::Derivative,
            },
        })
    }
}

fn are_same(a: &[f64], b: &[f64]) -> bool {
    let size = a
        .iter()
        .chain(b)
        .fold(0.0, |size: f64, x| size.max(x.abs()));
    let slack = SAME_ROW * size + tolerance::EPSILON;
    a.iter().zip(b).all(|(x, y)| (x - y).abs() <= slack)
}
