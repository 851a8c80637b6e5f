//! Answers of queries about a pure set.

use super::answer::{ContactRecord, Distance, PurePlace, SSide, Witness};
use super::scene::Scene;
use crate::cobject::{BoundedDistance, Class, Measured, PureSet, PureShape, WorldPlace};
use crate::convex::ContactMode;
use crate::error::Result;
use crate::pose::Vec3;
use crate::primitive::Feature;

/// A pure set, or its complement, at one configuration.
#[derive(Clone, Copy)]
pub(crate) struct PureAt<'a> {
    pub set: &'a PureSet,
    /// Asks about the complement instead.
    pub complement: bool,
    pub scene: &'a Scene<'a>,
}

/// The witness of a pure set, its contact, and the gradient if requested.
pub(crate) struct PureWitness {
    pub witness: Witness,
    pub contact: Option<ContactRecord>,
    pub row: Vec<f64>,
}

impl PureAt<'_> {
    /// The class.
    pub fn class_of(&self, measured: Option<&Measured>) -> Result<Class> {
        let class = match measured {
            Some(measured) => measured.class(self.complement),
            None => {
                let state = self.scene.space_state();
                self.set.classify(&state, self.complement)?
            }
        };
        Ok(class.reversed_if(self.complement))
    }

    /// What a look at the set tells; `None` of a predicate that does not measure.
    pub fn measured(&self) -> Result<Option<Measured<'_>>> {
        self.set.measured(&self.scene.space_state())
    }

    /// The distance.
    pub fn bounded_distance(&self) -> Result<BoundedDistance> {
        self.bounds_of(self.measured()?.as_ref())
    }

    /// A set that does not measure has distance 0 where the configuration is inside, else an unknown one.
    pub fn bounds_of(&self, measured: Option<&Measured>) -> Result<BoundedDistance> {
        if let Some(measured) = measured {
            return Ok(measured.measure().bounded_distance(self.complement));
        }
        let is_inside = self.class_of(None)? == Class::Inside;
        Ok(BoundedDistance {
            distance: 0.0,
            lower: 0.0,
            upper: if is_inside { 0.0 } else { f64::INFINITY },
            excess: 0.0,
            is_exact: is_inside,
        })
    }

    pub fn distance(&self, max_distance: f64) -> Result<Distance> {
        let measured = self.measured()?;
        let measured = measured.as_ref();
        let bounds = self.bounds_of(measured)?;
        let contact = measured.and_then(|measured| self.contact(measured, &bounds));
        let mut witness = self.witness(measured, &bounds);
        witness.contact_count = usize::from(contact.is_some());
        Ok(Distance::from_bounds(
            bounds,
            max_distance,
            witness,
            contact,
        ))
    }

    /// The witness and its contact, if the set may be within `epsilon`, with the gradient if requested.
    pub fn within(&self, epsilon: f64, with_gradient: bool) -> Result<Option<PureWitness>> {
        let measured = self.measured()?;
        let measured = measured.as_ref();
        let bounds = self.bounds_of(measured)?;
        let measures = bounds.is_exact || bounds.lower > 0.0;
        if bounds.lower > epsilon || bounds.lower == f64::INFINITY || !measures {
            return Ok(None);
        }
        let contact = measured.and_then(|measured| self.contact(measured, &bounds));
        let mut row = Vec::new();
        if with_gradient && contact.is_some() {
            let gradient = self.set.gradient(&self.scene.space_state())?;
            let sign = self.sign();
            row = gradient.into_iter().map(|x| x * sign).collect();
        }
        let mut witness = self.witness(measured, &bounds);
        witness.contact_count = usize::from(contact.is_some());
        witness.overlapping = contact.is_none();
        Ok(Some(PureWitness {
            witness,
            contact,
            row,
        }))
    }

    fn sign(&self) -> f64 {
        if self.complement { -1.0 } else { 1.0 }
    }

    fn witness(&self, measured: Option<&Measured>, bounds: &BoundedDistance) -> Witness {
        let state = self.scene.space_state();
        let world = measured.and_then(|measured| measured.place);
        let coordinate = self.set.coordinate(&state);
        let place = match coordinate {
            Some(coordinate) => PurePlace::Coordinate(coordinate),
            None if world.is_some() => PurePlace::World,
            None => PurePlace::Configuration,
        };
        let link = world.map_or(0, |place| place.link);
        let primitive = world.and_then(|place| place.primitive).unwrap_or(0);
        let body = state.space.body(link);
        let body = body.filter(|_| matches!(world, Some(place) if place.primitive.is_some()));
        Witness {
            leaf: self.set.leaf,
            r_link: link,
            r_object: 0,
            s_carrier: None,
            s_side: SSide::PureSet(place),
            primitives: [primitive, 0],
            tags: [body.map_or(0, |body| body.tag(primitive)), 0],
            parts: [body.and_then(|body| body.part_of(primitive)), None],
            data: [body.map_or(0, |body| body.data()), 0],
            distance: bounds.distance,
            first_contact: 0,
            contact_count: 0,
            overlapping: false,
            contained: false,
            complemented: self.complement,
        }
    }

    /// A contact where the signed distance is known.
    fn contact(&self, measured: &Measured, bounds: &BoundedDistance) -> Option<ContactRecord> {
        let measure = measured.measure();
        let knows = if measure.signed > 0.0 {
            !(self.complement && measure.is_bound)
        } else {
            // The depth of a link in a floor is not the depth of the robot, but gives the direction out. At the boundary of
            // an open set the depth is 0.
            let is_at_boundary = self.set.shape.is_open() && measure.signed >= -measure.error;
            let is_floor = matches!(self.set.shape, PureShape::Floor { .. });
            measure.knows_depth || is_floor || is_at_boundary
        };
        if !knows || !measure.signed.is_finite() {
            return None;
        }
        let mut contact = ContactRecord {
            points: [Vec3::zeros(); 2],
            normal: Vec3::zeros(),
            distance: bounds.distance,
            clearance: measure.signed * self.sign(),
            mode: ContactMode::PureSet,
            features: [Feature::interior(); 2],
        };
        if let Some(place) = &measured.place {
            contact.place(place, self.sign(), 0.5 * measure.excess);
        }
        Some(contact)
    }
}

impl ContactRecord {
    /// Sets points and normal at the place where a link is near the world box or a floor. The points are those of the body, whose
    /// stated deviation the clearance is less.
    fn place(&mut self, place: &WorldPlace, sign: f64, stated_deviation: f64) {
        let normal = place.normal * sign;
        self.points = [
            place.point,
            place.point - normal * (self.clearance + sign * stated_deviation),
        ];
        self.normal = normal;
    }
}
