//! What a measure says of a distance: with bounds, and of the complement.

use super::Class;

/// A signed distance, known to `error`; in lengths where the set has a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Positive outside, negative inside; infinite where the set is empty, or all there is.
    pub signed: f64,
    pub error: f64,
    /// The truth is no less, but may be more.
    pub is_bound: bool,
    /// Inside, `signed` is minus the distance from the complement.
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

    /// What it says of the distance from the set, or from its complement.
    pub fn bounded_distance(&self, from_complement: bool) -> BoundedDistance {
        let Self { signed, error, .. } = *self;
        let certain = if from_complement {
            signed > error
        } else {
            signed < -error
        };
        let here = BoundedDistance {
            distance: 0.0,
            lower: 0.0,
            upper: if certain { 0.0 } else { 2.0 * error },
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
                is_exact: false,
            };
        }
        if away <= error {
            return here;
        }
        BoundedDistance {
            distance: away,
            lower: away - error,
            upper: away + error,
            is_exact: true,
        }
    }
}

/// A distance with safe bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedDistance {
    pub distance: f64,
    pub lower: f64,
    pub upper: f64,
    /// The distance is known; else `distance` is the lower bound.
    pub is_exact: bool,
}
