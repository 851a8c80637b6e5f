//! The direction along which the signed gap of two smooth cores that touch, or overlap by a little, is largest: the best that the surfaces
//! around their common point offer, brought to the last digit by Newton's method between the parts that it is normal to.

use smallvec::SmallVec;

use super::contact_normal::LocalFeatures;
use super::core::Core;
use super::nearest_parts::{NearestParts, direction_on_both};
use super::placed::PlacedPrimitive;
use super::polytope_distance::cuboid;
use super::surface_part::SurfacePart;
use crate::gjk::{Names, Nearby, Support};
use crate::pose::{Vec3, turned};
use crate::primitive::{Feature, HIGH_END, LOW_END, SmoothKind};
use crate::tolerance;

/// How far off, in L, the points that Newton's method finds may be across its direction: some rounding errors.
const ACCEPTED: f64 = 64.0 * tolerance::EPSILON;

/// A normal whose sine to the plane across the rulings of a tube is at most this is taken to be theirs, not the rim's. Either is proved.
const ON_RULINGS: f64 = 1e-6;

/// What is this near to a point, in L, is around it: some depths of cores that touch.
const AROUND: f64 = 2.0 * tolerance::JUST_INSIDE;

/// Two cores that may touch.
pub struct TouchingParts<'a> {
    cores: [&'a Core<'a>; 2],
    /// A point of each where they nearly do.
    pub points: [Vec3; 2],
    /// Of polytopes, the names of the parts that hold these, where they are known.
    names: [Option<Names>; 2],
    size: f64,
}

/// A direction, and the gap along it.
#[derive(Clone, Copy)]
struct Guess {
    normal: Vec3,
    gap: f64,
}

impl<'a> TouchingParts<'a> {
    /// `features` are those that hold the points, or interiors; `size` is L, the largest coordinate.
    pub fn new(
        cores: [&'a Core<'a>; 2],
        points: [Vec3; 2],
        features: [Feature; 2],
        size: f64,
    ) -> Self {
        let names = [0, 1].map(|side| {
            let placed = cores[side].placed();
            let known = placed.names_of(features[side]);
            known.or_else(|| part_around(placed, &points[side], AROUND * size))
        });
        Self {
            cores,
            points,
            names,
            size,
        }
    }

    /// The best guess of a unit direction from B to A, and what Newton's method makes of it: a signed gap, its direction, and a point of A and
    /// one of B where it is. No other direction around it has a larger gap; `None` where that is not proved. `known` is a guess, or zero.
    pub fn touch(&self, known: Vec3) -> (Vec3, Option<Nearby>) {
        if known != Vec3::zeros() {
            let guess = self.guess(known);
            let apart = (self.points[0] - self.points[1]).norm();
            // No direction has a larger gap than two points are apart.
            if guess.gap >= apart - self.accepted()
                && let Some(found) = self.solve(&guess)
            {
                return (known, Some(found));
            }
        }
        let guess = self.best_guess(known);
        (guess.normal, self.solve(&guess))
    }

    /// The gap along a unit direction from B to A.
    pub fn gap_along(&self, n: &Vec3) -> f64 {
        let [a, b] = self.cores;
        n.dot(&(a.support(&-n) - b.support(n)))
    }

    fn guess(&self, normal: Vec3) -> Guess {
        Guess {
            normal,
            gap: self.gap_along(&normal),
        }
    }

    fn accepted(&self) -> f64 {
        ACCEPTED * self.size
    }

    /// The direction with the largest gap among those that the surfaces around the points offer.
    fn best_guess(&self, known: Vec3) -> Guess {
        let [a, b] = self.cores.map(|core| core.placed().middle());
        let between = (a - b).try_normalize(0.0).unwrap_or_else(Vec3::x);
        let mut best = self.guess(between);
        if known != Vec3::zeros() {
            best = best.or(self.guess(known));
        }
        best = self.best_around(&self.points, best);
        if best.gap < -self.accepted() {
            // The common point is not where the surfaces are. Each around the other's point: which side of an apex is next to it matters.
            let n = best.normal;
            let points = [self.cores[1].support(&n), self.cores[0].support(&-n)];
            best = self.best_around(&points, best);
        }
        best
    }

    /// The best of a guess and the directions from B to A that are normal to one of the surfaces around two points, or to an edge of either.
    fn best_around(&self, points: &[Vec3; 2], mut best: Guess) -> Guess {
        let [a, b] =
            [0, 1].map(|side| Surroundings::of(self.cores[side], &points[side], self.size));
        let mut offer = |normal: Vec3| best = best.or(self.guess(normal));
        a.normals.iter().for_each(|normal| offer(-normal));
        b.normals.iter().for_each(|normal| offer(*normal));
        for (along, height) in &a.edges {
            // A's outward normal is the opposite of the direction.
            let on_a = (*along, -height);
            for on_b in &b.edges {
                let across = along.cross(&on_b.0);
                if across.norm() > tolerance::PARALLEL_EDGES {
                    let both = [across, -across].map(|side| direction_on_both(on_a, *on_b, &side));
                    both.into_iter().flatten().for_each(&mut offer);
                }
            }
        }
        best
    }

    /// What Newton's method finds from a guess, between the parts of the surfaces that this is normal to.
    fn solve(&self, guess: &Guess) -> Option<Nearby> {
        let n = &guess.normal;
        let names = [(0, -n), (1, *n)].map(|(side, outwards): (usize, Vec3)| {
            self.names[side].unwrap_or_else(|| part_along(self.cores[side], &outwards))
        });
        let parts = NearestParts::new(self.cores, names, self.accepted())?.at_touch();
        let found = parts.solve(n)?;
        (found.lower >= guess.gap - self.accepted()).then_some(found)
    }
}

impl Guess {
    fn or(self, other: Self) -> Self {
        if other.gap > self.gap { other } else { self }
    }
}

/// The names of the part of a box, a segment or a point that is around a point; `None` for others.
fn part_around(placed: &PlacedPrimitive, point: &Vec3, near: f64) -> Option<Names> {
    if placed.shape.smooth().is_some() {
        return None;
    }
    if let Some(cuboid) = cuboid(placed) {
        return placed.names_of(cuboid.feature_at(&cuboid.seen(&placed.seen(point)), near));
    }
    match placed.vertex_count() {
        1 => Some(Names::one(0)),
        2 => {
            let is_here = |end: &u32| (placed.vertex(*end) - point).norm() <= near;
            let end = [0, 1].into_iter().find(is_here);
            Some(end.map_or(Names::two(0, 1), Names::one))
        }
        _ => None,
    }
}

/// The names of the part of a core's surface that has an outward normal.
fn part_along(core: &Core, outwards: &Vec3) -> Names {
    let rulings = Names::two(LOW_END, HIGH_END);
    let tube = core
        .smooth()
        .and_then(|_| SurfacePart::between(core, rulings.as_slice()));
    match tube.and_then(|tube| tube.constraint()) {
        Some((axis, height)) if (axis.dot(outwards) - height).abs() <= ON_RULINGS => rulings,
        _ => Names::one(core.extreme(outwards).name),
    }
}

/// What a core's surface is like around a point on it or near it.
#[derive(Default)]
struct Surroundings {
    /// Outward normals.
    normals: SmallVec<[Vec3; 8]>,
    /// Of edges, rims and rulings: the outward normals n of the planes that touch them are those with n . v = c, for a unit vector v and a
    /// number c.
    edges: SmallVec<[(Vec3, f64); 8]>,
}

impl Surroundings {
    fn of(core: &Core, point: &Vec3, size: f64) -> Self {
        let Some(smooth) = core.smooth() else {
            let local = LocalFeatures::around(core.placed(), point, AROUND * size);
            let both = local.normals.iter().flat_map(|normal| [*normal, -normal]);
            return Self {
                normals: if local.is_flat {
                    both.collect()
                } else {
                    local.normals.into_iter().collect()
                },
                edges: local.directions.iter().map(|&along| (along, 0.0)).collect(),
            };
        };
        let local = smooth.seen(point);
        let outwards = Vec3::new(local.x, local.y, 0.0).try_normalize(0.0);
        let outwards = outwards.unwrap_or_else(Vec3::x);
        let along_rim = (Vec3::new(-outwards.y, outwards.x, 0.0), 0.0);
        let up = Vec3::z();
        let mut found = Self::default();
        match *smooth.kind {
            SmoothKind::Cylinder { .. } => {
                found
                    .normals
                    .extend([outwards, up * 1f64.copysign(local.z)]);
                found.edges.extend([along_rim, (up, 0.0)]);
            }
            SmoothKind::Cone { radius, height } => {
                let slope = radius.hypot(height);
                let side = (outwards * height + up * radius) / slope;
                found.normals.extend([side, -up, up]);
                found.edges.extend([along_rim, (up, radius / slope)]);
            }
            SmoothKind::Ellipsoid { semi_axes } => {
                let steepest = local.component_div(&semi_axes.component_mul(&semi_axes));
                found.normals.extend(steepest.try_normalize(0.0));
            }
            SmoothKind::Function(_) => (),
        }
        for normal in &mut found.normals {
            *normal = turned(&smooth.axes, normal);
        }
        for (along, _) in &mut found.edges {
            *along = turned(&smooth.axes, along);
        }
        found
    }
}
