//! What one look at a pure set tells: its signed distance, its class and its place.

use super::{Class, Measure, PureSet, WorldPlace};

/// A pure set that measures, at one configuration.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'a> {
    pub(super) set: &'a PureSet,
    /// In the set's own unit.
    pub(super) unscaled: Measure,
    /// What a predicate says itself.
    pub(super) told: Option<Class>,
    /// The link and the point that decide; `None` for sets that are not in the world.
    pub place: Option<WorldPlace>,
}

impl Measured<'_> {
    /// The class, as [`PureSet::classify`] has it.
    pub fn class(&self, is_proved: bool) -> Class {
        if let Some(class) = self.told {
            return class;
        }
        let found = &self.unscaled;
        if is_proved && found.excess > 0.0 && found.signed + found.excess > -found.error {
            return Class::Outside;
        }
        found.class(self.set.shape.is_open(), self.set.options.contact_epsilon)
    }

    /// The signed distance in the unit of measures.
    pub fn measure(&self) -> Measure {
        let scale = self.set.scale();
        let scaled = |x: f64| match x * scale {
            // Scaling must not turn a nonzero distance into 0.
            0.0 if x != 0.0 => f64::MIN_POSITIVE.copysign(x),
            scaled => scaled,
        };
        Measure {
            signed: scaled(self.unscaled.signed),
            error: self.unscaled.error * scale,
            excess: self.unscaled.excess * scale,
            ..self.unscaled
        }
    }
}
