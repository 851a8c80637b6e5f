//! The cost of merging two bodies (§3.2.2, eq. 2).

/// Cost = diameter^A (B Fill + C Balance). Fill is the merged diameter over the sum of the two, Balance the larger of the
/// two over the smaller. A (`diameter`) weighs spatial balance, B (`fill`) coherence, C (`balance`) structural balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    pub diameter: f64,
    pub fill: f64,
    pub balance: f64,
}

impl Default for Cost {
    fn default() -> Self {
        Self {
            diameter: 1.0,
            fill: 1.0,
            balance: 0.1,
        }
    }
}

impl Cost {
    /// The cost of a body of diameter `merged` from two with the given positive diameters.
    pub fn of(&self, merged: f64, diameters: [f64; 2]) -> f64 {
        let [a, b] = diameters;
        let fill = merged / (a + b);
        let balance = if a > b { a / b } else { b / a };
        self.power(merged) * (self.fill * fill + self.balance * balance)
    }

    /// The largest merged diameter whose cost can be as low as `cost`: Fill is at least 1/2, Balance at least 1.
    pub fn largest_diameter(&self, cost: f64) -> f64 {
        let ratio = cost / (0.5 * self.fill + self.balance);
        if self.diameter == 1.0 {
            ratio
        } else if self.diameter > 0.0 {
            // Slightly more than the root, which may be rounded down.
            ratio.powf(1.0 / self.diameter) * (1.0 + 1e-12)
        } else {
            f64::INFINITY
        }
    }

    fn power(&self, diameter: f64) -> f64 {
        if self.diameter == 1.0 {
            diameter
        } else {
            diameter.powf(self.diameter)
        }
    }
}
