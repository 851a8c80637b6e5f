//! Balls inside a body: two of them, one in each body, show at which translations the bodies meet, also where these are solids
//! of any shape.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use crate::body::{Body, BodyBuilder};
use crate::convex::Precision;
use crate::hierarchy::HierarchyOptions;
use crate::pair::{
    NearestPrimitives, Pairing, PrimitivePair, PrimitiveScratch, RayScratch, Scratch, Visitor,
    Wanted, meets, traverse, winding,
};
use crate::pose::{Pose, Vec3};
use crate::work_meter::WorkMeter;

/// A ball inside a body, in its centred frame.
#[derive(Clone, Copy, Debug)]
pub struct InnerBall {
    pub center: Vec3,
    pub radius: f64,
}

/// Steps of the search for a large ball, each a test of six points; the step is halved where none is better.
const MAX_STEPS: usize = 24;

/// A body that is one point.
fn point_body() -> &'static Body {
    static POINT: OnceLock<Body> = OnceLock::new();
    POINT.get_or_init(|| {
        let mut builder = BodyBuilder::new(3).expect("3 is a dimension");
        let added = builder.add_points(&[Vec3::zeros()], 0.0);
        added.expect("a point is a primitive");
        let built = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
        built.expect("a point is a body")
    })
}

/// The primitives of a body that hold a point, by their places in its tree.
#[derive(Default)]
struct Around {
    places: Vec<u32>,
}

/// Of more primitives around a point, the others are left out: their balls are not needed for a valid bound.
const MAX_AROUND: usize = 16;

impl Visitor for Around {
    fn wanted(&self) -> Wanted {
        Wanted::MEETING
    }

    fn visit(&mut self, pair: &PrimitivePair, _: &mut WorkMeter) -> ControlFlow<()> {
        if meets(pair) {
            self.places.push(pair.places[0]);
        }
        match self.places.len() >= MAX_AROUND {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

/// The signed radius of a point in a body, in the body's centred frame: a ball of that radius around it is inside the body;
/// minus the distance, if it is outside.
pub fn signed_radius(
    body: &Body,
    point: &Vec3,
    scratch: &mut Scratch,
    rays: &mut RayScratch,
) -> f64 {
    let (here, there) = (
        Pose::identity(),
        Pose::from_translation(body.center() + point),
    );
    let pairing = Pairing::new(body, &here, point_body(), &there);
    let error = pairing.precision.error;
    let mut nearest = NearestPrimitives::up_to(f64::INFINITY);
    scratch.meter_mut().count_nodes(1);
    let _ = traverse(&pairing, None, scratch, &mut nearest);
    let distance = nearest.best.map_or(f64::INFINITY, |hit| hit.distance);
    if distance == 0.0 {
        let mut around = Around::default();
        let _ = traverse(&pairing, None, scratch, &mut around);
        let mut deepest: f64 = 0.0;
        for place in around.places {
            let scratch = scratch.for_primitives();
            deepest = deepest.max(radius_in_primitive(&pairing, place, point, scratch));
        }
        return deepest - 2.0 * error;
    }
    let is_inside = body.solid().is_some() && winding(body, point, rays).number != 0;
    match is_inside {
        true => nearest.lower.min(distance) - 2.0 * error,
        false => -distance,
    }
}

/// The radius of a ball around a point of a primitive, at a place in A's tree, that belongs to the primitive; B is the point.
fn radius_in_primitive(
    pairing: &Pairing,
    place: u32,
    point: &Vec3,
    scratch: &mut PrimitiveScratch,
) -> f64 {
    let number = pairing
        .a
        .packed()
        .primitives()
        .entry(place as usize)
        .primitive;
    let primitive = pairing.a.primitives().get(number as usize);
    let shape = primitive.shape;
    if shape.is_solid() {
        let heights = shape.faces.iter().map(|face| {
            let corner = primitive.vertices[face.vertices[0] as usize];
            face.normal.dot(&(corner - point))
        });
        let in_core = heights.fold(f64::INFINITY, f64::min);
        if in_core >= 0.0 {
            return in_core + shape.radius();
        }
    }
    // Beyond a face the core may be farther than the face's plane: its edges and corners are.
    let found = pairing.closest_at([place, 0], scratch);
    let from_core = found.map_or(f64::INFINITY, |found| found.cores.distance);
    (shape.radius() - from_core).max(0.0)
}

/// Grows a ball in A and one in B around a common point, for the position of B that `pairing` gives, so that the sum of the radii
/// gets large. `None` if no common point with radii above 0 is found near `start`, in A's centred frame.
pub fn common_balls(
    pairing: &Pairing,
    start: &Vec3,
    scratch: &mut Scratch,
    rays: &mut RayScratch,
) -> Option<[InnerBall; 2]> {
    let into_b = pairing.relative.inverse();
    let mut radii_at = |point: &Vec3| {
        let in_b = into_b.transform_point(point);
        let in_a = signed_radius(pairing.a, point, scratch, rays);
        [in_a, signed_radius(pairing.b, &in_b, scratch, rays)]
    };
    // A point outside one of them is worth less than any inside both.
    let value = |radii: &[f64; 2]| match radii[0].min(radii[1]) {
        low if low <= 0.0 => low,
        _ => radii[0] + radii[1],
    };
    let (mut point, mut radii) = (*start, radii_at(start));
    let mut step = 0.25 * pairing.a.radius().min(pairing.b.radius());
    for _ in 0..MAX_STEPS {
        let ways = (0..6).map(|i| {
            let mut way = Vec3::zeros();
            way[i % 3] = if i < 3 { step } else { -step };
            way
        });
        let tried = ways.map(|way| (point + way, radii_at(&(point + way))));
        let best = tried.max_by(|a, b| value(&a.1).total_cmp(&value(&b.1)));
        match best {
            Some(best) if value(&best.1) > value(&radii) => (point, radii) = best,
            _ => step *= 0.5,
        }
    }
    (radii[0].min(radii[1]) > 0.0).then(|| {
        [
            InnerBall {
                center: point,
                radius: radii[0],
            },
            InnerBall {
                center: into_b.transform_point(&point),
                radius: radii[1],
            },
        ]
    })
}

/// The precision of a pair whose translations are searched: that of the pair where A has moved as far as it may.
pub fn widened(precision: &Precision, farthest: f64) -> Precision {
    let factor = (precision.size + farthest) / precision.size;
    Precision {
        size: precision.size * factor,
        error: precision.error * factor,
        ..*precision
    }
}
