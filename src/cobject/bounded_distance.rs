//! Signed distances from pure sets, and the bounded distances that follow from them.

use super::Class;

/// A signed distance from a set, in lengths where the set has a scale, else in C-space units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Positive outside, negative inside; plus infinity for an empty set, minus infinity for the whole space.
    pub signed: f64,
    /// The largest error of `signed`.
    pub error: f64,
    /// The true signed distance may be larger than `signed` by this, besides the error: where bodies may differ from what they
    /// stand for.
    pub excess: f64,
    /// `signed` is only a lower bound: the true distance may be larger.
    pub is_bound: bool,
    /// Inside, `signed` is minus the distance from the complement; else the depth is unknown.
    pub knows_depth: bool,
}

impl Measure {
    pub(super) fn class(&self, is_open: bool, epsilon: f64) -> Class {
        let inside = if is_open {
            self.signed < -self.error
        } else {
            self.signed <= self.error
        };
        if inside {
            Class::Inside
        } else if self.signed <= epsilon && epsilon > 0.0 {
            Class::Contact
        } else {
            Class::Outside
        }
    }

    /// The distance from the set, or from its complement, with bounds.
    pub fn bounded_distance(&self, from_complement: bool) -> BoundedDistance {
        let Self {
            signed,
            error,
            excess,
            ..
        } = *self;
        let certain = if from_complement {
            signed > error
        } else {
            signed + excess < -error
        };
        let here = BoundedDistance {
            distance: 0.0,
            lower: 0.0,
            upper: if certain { 0.0 } else { 2.0 * error + excess },
            excess: if certain { 0.0 } else { excess },
            is_exact: true,
        };
        let (away, is_bound) = if !from_complement {
            (signed, self.is_bound)
        } else if self.knows_depth {
            (-signed, false)
        } else if signed > 0.0 {
            return here;
        } else {
            (0.0, true)
        };
        if is_bound && (from_complement || away > error) {
            let lower = (away - error).max(0.0);
            return BoundedDistance {
                distance: lower,
                lower,
                upper: f64::INFINITY,
                excess: 0.0,
                is_exact: false,
            };
        }
        if away <= error {
            return here;
        }
        BoundedDistance {
            distance: away,
            lower: away - error,
            upper: away + excess + error,
            excess,
            is_exact: true,
        }
    }
}

/// A distance with safe bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedDistance {
    /// The distance, or the lower bound if it is not known.
    pub distance: f64,
    /// The true distance is not smaller.
    pub lower: f64,
    /// The true distance is not larger.
    pub upper: f64,
    /// What of the upper bound is there because of the measure's excess.
    pub excess: f64,
    /// Whether the distance is known; else `distance` is the lower bound.
    pub is_exact: bool,
}
