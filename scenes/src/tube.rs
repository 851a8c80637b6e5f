//! Mitred tubes along polylines.

use crate::lathe::directions;
use crate::loft::{Ends, loft};
use crate::mesh::Mesh;
use crate::point::{Point, across, dot, minus, plus, times, unit};

/// The closed tube of `sides` flat sides along `path`, with a radius for each of its points; planar ends.
///
/// Each piece is part of a prism or pyramid and is cut by the plane halfway between its direction and the next, so all
/// quads are planar; `sides` for each piece and two ends.
pub(crate) fn tube(path: &[Point], radii: &[f64], sides: usize) -> Mesh {
    let steps: Vec<Point> = path.windows(2).map(|leg| minus(leg[1], leg[0])).collect();
    let (u, v) = across(unit(steps[0]));
    let corner = |&[c, s]: &[f64; 2]| {
        let offset = plus(times(radii[0] * c, u), times(radii[0] * s, v));
        plus(path[0], offset)
    };
    let mut rings: Vec<Vec<Point>> = vec![directions(sides).iter().map(corner).collect()];
    for (k, &step) in steps.iter().enumerate() {
        let next = steps.get(k + 1).copied().unwrap_or(step);
        let normal = plus(unit(step), unit(next));
        let growth = radii[k + 1] / radii[k] - 1.0;
        let carried = |&p: &Point| {
            // All these lines meet in one point or are parallel, so neighbours span a plane.
            let line = plus(step, times(growth, minus(p, path[k])));
            let reach = dot(normal, minus(path[k + 1], p)) / dot(normal, line);
            plus(p, times(reach, line))
        };
        let ring = rings[k].iter().map(carried).collect();
        rings.push(ring);
    }
    loft(&rings, Ends::Capped)
}

/// A straight round bar of `sides` long quads and two ends.
pub(crate) fn bar(from: Point, to: Point, radius: f64, sides: usize) -> Mesh {
    tube(&[from, to], &[radius; 2], sides)
}
