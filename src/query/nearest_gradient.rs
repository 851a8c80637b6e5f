//! The distance with the gradient of its nearest pair: operations 6 and 8 in one.

use super::answer::{Distance, SSide};
use super::context::{QueryContext, check_threshold};
use super::leaves::Leaves;
use super::scene::{Configuration, Scene};
use super::witnesses::push_gradient;
use super::world::World;
use crate::cobject::CObject;
use crate::error::Result;

impl QueryContext {
    /// The distance at q, and in `row` the gradient of its contact: the derivative of the contact's distance with respect to the
    /// velocities. Without a contact the row is empty.
    pub fn distance_with_gradient(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        max_distance: f64,
        row: &mut Vec<f64>,
    ) -> Result<Distance> {
        let world = self.look(cobject);
        self.refining(|context| {
            context.distance_with_gradient_in(&world, cobject, q, max_distance, row)
        })
    }

    /// The same in a given world.
    pub fn distance_with_gradient_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        q: &[f64],
        max_distance: f64,
        row: &mut Vec<f64>,
    ) -> Result<Distance> {
        check_threshold(max_distance, "max_distance")?;
        cobject.require_one_metric()?;
        row.clear();
        let at = Configuration::Coordinates(q);
        self.with_scene(cobject, world, at, |context, scene| {
            let distance = context.set_distance(cobject, scene, max_distance)?;
            push_nearest(cobject, scene, &distance, row)?;
            Ok(distance)
        })
    }
}

/// Appends the gradient of the contact, if there is one.
fn push_nearest(
    cobject: &CObject,
    scene: &Scene,
    distance: &Distance,
    row: &mut Vec<f64>,
) -> Result<()> {
    let (Some(witness), Some(contact)) = (&distance.witness, &distance.contact) else {
        return Ok(());
    };
    if let SSide::PureSet(_) = witness.s_side {
        let leaves = Leaves::of(cobject).pure;
        let mut sets = leaves.into_iter().map(|(set, _)| set);
        if let Some(set) = sets.find(|set| set.leaf == witness.leaf) {
            let sign = if witness.complemented { -1.0 } else { 1.0 };
            let gradient = set.gradient(&scene.space_state())?;
            row.extend(gradient.into_iter().map(|x| x * sign));
        }
        return Ok(());
    }
    match scene.state() {
        Some(state) => {
            let (normal, points) = (&contact.normal, &contact.points);
            push_gradient(scene.space(), state, witness.links(), normal, points, row)
        }
        None => Ok(()),
    }
}
