//! How coordinates are divided into cells in which links are proved apart.

use std::f64::consts::{PI, TAU};

use smallvec::SmallVec;

use crate::cobject::{CellAxis, MAX_CELL_AXES};
use crate::robot::{Coordinate, JointKind};
use crate::space::Space;

/// About how many cells a grid has: over one coordinate, over two and over three.
const CELLS: [f64; MAX_CELL_AXES] = [256.0, 16384.0, 65536.0];

/// The most cells along an axis.
const LONGEST: f64 = 1024.0;

/// Coordinates of a space, each with its velocity.
pub(super) type Coordinates = SmallVec<[[usize; 2]; MAX_CELL_AXES]>;

/// The coordinates that move two links relative to each other; `None` where these are none or too many, or of other joints.
pub(super) fn coordinates_between(space: &Space, links: [usize; 2]) -> Option<Coordinates> {
    let mut coordinates = Coordinates::new();
    let [mut r, mut s] = links.map(Some);
    // Links have larger numbers than what carries them: the larger cannot carry the smaller.
    while r != s {
        let link = r.max(s)?;
        let parent = space.parent(link);
        for end in [&mut r, &mut s] {
            if *end == Some(link) {
                *end = parent;
            }
        }
        let joint = &space.link(link)?.joint;
        match joint.kind {
            JointKind::Fixed => continue,
            JointKind::Revolute | JointKind::Prismatic => {}
            _ => return None,
        }
        let offset = space.offsets()[space.robot_of(link)];
        let own = [
            offset.coordinate + joint.coordinate,
            offset.velocity + joint.velocity,
        ];
        if !coordinates.contains(&own) {
            if coordinates.len() == MAX_CELL_AXES {
                return None;
            }
            coordinates.push(own);
        }
    }
    (!coordinates.is_empty()).then_some(coordinates)
}

/// How they are divided: so that bodies go about equally far over a cell along each. `moves` tells how far they go with a velocity. `None`
/// where one has no bounds.
pub(super) fn divided(
    space: &Space,
    coordinates: &Coordinates,
    moves: &dyn Fn(&[f64]) -> f64,
) -> Option<SmallVec<[CellAxis; MAX_CELL_AXES]>> {
    let one = |&coordinate| undivided(space, coordinate);
    let mut axes: SmallVec<[CellAxis; MAX_CELL_AXES]> =
        coordinates.iter().map(one).collect::<Option<_>>()?;
    let lengths: SmallVec<[f64; MAX_CELL_AXES]> = (axes.iter())
        .map(|axis| {
            let mut v = vec![0.0; space.nv()];
            v[axis.velocity] = axis.width;
            moves(&v)
        })
        .collect();
    // The longest first gets its share of the cells, then the others theirs of what is left.
    let mut order: SmallVec<[usize; MAX_CELL_AXES]> = (0..axes.len()).collect();
    order.sort_unstable_by(|&a, &b| lengths[b].total_cmp(&lengths[a]));
    let mut cells = CELLS[axes.len() - 1];
    for (done, &k) in order.iter().enumerate() {
        let left = &order[done..];
        let product: f64 = left.iter().map(|&k| lengths[k]).product();
        let side = (product / cells).powf(1.0 / left.len() as f64);
        let count = (lengths[k] / side).clamp(1.0, LONGEST).min(cells).round();
        // Of what is no number one cell.
        axes[k].count = count as u32 + u32::from(count.is_nan());
        axes[k].width /= f64::from(axes[k].count);
        cells = (cells / f64::from(axes[k].count)).max(1.0);
    }
    Some(axes)
}

/// One cell over all that a coordinate's limits allow; `None` without limits.
fn undivided(space: &Space, [coordinate, velocity]: [usize; 2]) -> Option<CellAxis> {
    let is_periodic = space.is_periodic(coordinate);
    let (low, high, is_periodic) = match space.coordinates()[coordinate] {
        Coordinate::Circle => (-PI, PI, true),
        Coordinate::Interval { lower, upper } if is_periodic && upper - lower >= TAU => {
            (-PI, PI, true)
        }
        Coordinate::Interval { lower, upper } => (lower, upper, false),
        Coordinate::Quaternion => return None,
    };
    let width = high - low;
    (width.is_finite() && width > 0.0).then_some(CellAxis {
        coordinate,
        velocity,
        low,
        width,
        count: 1,
        is_periodic,
    })
}
