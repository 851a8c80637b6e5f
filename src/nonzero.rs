//! Lengths and products that are 0 only where all they are made of is: by them one tells what rests.

/// The length of a vector.
pub fn length(v: &[f64]) -> f64 {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    // Squares of smaller components underflow.
    if length > 1e-140 {
        return length;
    }
    let most = v.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if most == 0.0 {
        return 0.0;
    }
    most * v
        .iter()
        .map(|x| (x / most) * (x / most))
        .sum::<f64>()
        .sqrt()
}

/// The product of two numbers.
pub fn product(a: f64, b: f64) -> f64 {
    let product = a * b;
    match product == 0.0 && a != 0.0 && b != 0.0 {
        true => f64::MIN_POSITIVE.copysign(product),
        false => product,
    }
}
