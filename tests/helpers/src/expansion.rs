//! Exact sums of products of f64 numbers, as expansions (Shewchuk 1997): sums of numbers that do not overlap. Right
//! unless a product underflows.

/// A sum kept exactly.
#[derive(Clone, Debug, Default)]
pub struct Expansion(Vec<f64>);

fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let part = sum - a;
    [sum, (a - (sum - part)) + (b - part)]
}

/// `a - b` as two numbers.
pub fn exact_difference(a: f64, b: f64) -> [f64; 2] {
    two_sum(a, -b)
}

impl Expansion {
    pub fn add(&mut self, x: f64) {
        let mut carry = x;
        let mut kept = 0;
        for i in 0..self.0.len() {
            let [sum, rest] = two_sum(carry, self.0[i]);
            carry = sum;
            if rest != 0.0 {
                self.0[kept] = rest;
                kept += 1;
            }
        }
        self.0.truncate(kept);
        if carry != 0.0 {
            self.0.push(carry);
        }
    }

    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(a.mul_add(b, -product));
        self.add(product);
    }

    /// -1, 0 or 1 with the sign of the sum.
    pub fn sign(&self) -> i32 {
        self.0.last().map_or(0, |x| if *x > 0.0 { 1 } else { -1 })
    }

    /// The absolute value, rounded up.
    pub fn magnitude(&self) -> f64 {
        self.0.iter().sum::<f64>().abs() * (1.0 + 4.0 * f64::EPSILON)
    }
}
