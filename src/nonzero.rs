//! Lengths and products that are 0 only where all they are made of is: by them one tells what rests.

/// Sums of squares between these have lost nothing to the range of numbers.
pub const PLAIN_SQUARES: std::ops::Range<f64> = 1e-280..1e300;

/// The length of a vector; its squares may underflow or overflow.
pub fn length(v: &[f64]) -> f64 {
    let squares: f64 = v.iter().map(|x| x * x).sum();
    if PLAIN_SQUARES.contains(&squares) {
        return squares.sqrt();
    }
    let largest = v.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 || largest.is_infinite() {
        return largest;
    }
    let scaled: f64 = v.iter().map(|x| (x / largest).powi(2)).sum();
    largest * scaled.sqrt()
}

/// The product of two numbers.
pub fn product(a: f64, b: f64) -> f64 {
    let product = a * b;
    match product == 0.0 && a != 0.0 && b != 0.0 {
        true => f64::MIN_POSITIVE.copysign(product),
        false => product,
    }
}
