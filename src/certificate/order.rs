//! The order of a body's primitives in which groups are ranges: halved again and again across their longest side.

use super::check::halves_of_group;
use crate::body::Body;
use crate::boxes::Extent;
use crate::pose::Vec3;

/// An order whose halves, and their halves, are near together.
pub(super) fn order_of(body: &Body) -> Vec<u32> {
    let centers = body.primitives().iter().map(|primitive| {
        let (low, high) = primitive.extent();
        (low + high) * 0.5
    });
    let centers: Vec<Vec3> = centers.collect();
    let mut order: Vec<u32> = (0..centers.len() as u32).collect();
    arrange(&mut order, &centers);
    order
}

fn arrange(part: &mut [u32], centers: &[Vec3]) {
    let Some([[_, half], _]) = halves_of_group([0, part.len() as u32]) else {
        return;
    };
    let places = part.iter().map(|primitive| centers[*primitive as usize]);
    let axis = Extent::of_points(places).size().imax();
    let along = |primitive: &u32| (centers[*primitive as usize][axis], *primitive);
    part.select_nth_unstable_by(half as usize, |a, b| {
        let ((a, i), (b, j)) = (along(a), along(b));
        a.total_cmp(&b).then(i.cmp(&j))
    });
    let (first, second) = part.split_at_mut(half as usize);
    arrange(first, centers);
    arrange(second, centers);
}
