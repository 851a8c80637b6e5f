//! The direction along which the signed gap of two smooth cores that touch, or overlap by a little, is largest: the best that the surfaces
//! around their common point offer, brought to the last digit by Newton's method between the parts that it is normal to.

use smallvec::SmallVec;

use super::core::Core;
use super::local_features::LocalFeatures;
use super::nearest_parts::{NearestParts, direction_on_both};
use super::polytope_distance::cuboid;
use super::surface_part::SurfacePart;
use crate::gjk::{Names, Nearby, Support};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::{Vec3, turned, turned_back};
use crate::primitive::{HIGH_END, LOW_END, SmoothKind};
use crate::tolerance;

/// How far off, in L, the points that Newton's method finds may be across its direction: some rounding errors.
const ACCEPTED: f64 = 64.0 * tolerance::EPSILON;

/// A normal whose sine to the plane across the rulings of a tube is at most this is taken to be theirs, not the rim's. Either is proved.
const ON_RULINGS: f64 = 1e-6;

/// What is this near to a point, in L, is around it: some depths of cores that touch.
const AROUND: f64 = 2.0 * tolerance::JUST_INSIDE;

/// At most 16 faces and 16 edges of a polytope around a point are tried, evenly out of all: at the apex of a fan of n each of n would cost n.
/// A larger value costs more there, a smaller one may leave out the best guess where many meet.
const MAX_AROUND: usize = 16;

/// Some unit vectors.
type Normals = SmallVec<[Vec3; 8]>;

/// Two cores that may touch.
pub struct TouchingParts<'a> {
    cores: [&'a Core<'a>; 2],
    /// A point of each where they nearly do.
    pub points: [Vec3; 2],
    size: f64,
}

/// A direction, and the gap along it.
#[derive(Clone, Copy)]
struct Guess {
    normal: Vec3,
    gap: f64,
}

impl<'a> TouchingParts<'a> {
    /// `size` is L, the largest coordinate.
    pub fn new(cores: [&'a Core<'a>; 2], points: [Vec3; 2], size: f64) -> Self {
        Self {
            cores,
            points,
            size,
        }
    }

    /// What Newton's method makes of the unit direction from B to A: a signed gap, its direction, and a point of A and one of B where it is.
    /// No other direction around it has a larger gap; `None` where that is not proved.
    pub fn touch_along(&self, direction: &Vec3) -> Option<Nearby> {
        self.solve(&self.guess(*direction))
    }

    /// The same of the best guess that the surfaces offer, with that guess. `known` is one, or zero.
    pub fn touch(&self, known: Vec3) -> (Vec3, Option<Nearby>) {
        let first = if known == Vec3::zeros() {
            self.between_middles()
        } else {
            known
        };
        let normals = self.normals_around(&self.points);
        let mut best = Tried::new(self, self.best_normal(&normals, self.guess(first)));
        if !best.is_apart(self) {
            let between = self.guess(self.between_middles());
            best.improve(
                self,
                self.best_across_edges(&self.points, &normals, between),
            );
        }
        if !best.is_apart(self) {
            // The points were not where the surfaces are. Each around the other's point: which side of an apex is next to it matters.
            let n = best.guess.normal;
            let [p, q] = match &best.found {
                Some(near) => near.points,
                None => [self.cores[0].support(&-n), self.cores[1].support(&n)],
            };
            let normals = self.normals_around(&[q, p]);
            let normal = self.best_normal(&normals, best.guess);
            best.improve(self, self.best_across_edges(&[q, p], &normals, normal));
        }
        (best.guess.normal, best.found)
    }

    /// The gap along a unit direction from B to A.
    #[inline(always)]
    pub fn gap_along(&self, n: &Vec3) -> f64 {
        let [a, b] = self.cores;
        n.dot(&(a.support(&-n) - b.support(n)))
    }

    #[inline(always)]
    fn guess(&self, normal: Vec3) -> Guess {
        Guess {
            normal,
            gap: self.gap_along(&normal),
        }
    }

    fn accepted(&self) -> f64 {
        ACCEPTED * self.size
    }

    /// The direction from the middle of B to that of A.
    fn between_middles(&self) -> Vec3 {
        let [a, b] = self.cores.map(|core| core.placed().middle());
        (a - b).try_normalize(0.0).unwrap_or_else(Vec3::x)
    }

    /// The outward normals of each surface around its point.
    fn normals_around(&self, points: &[Vec3; 2]) -> [Normals; 2] {
        let [a, b] = self.cores;
        [
            normals_around(a, &points[0], self.size),
            normals_around(b, &points[1], self.size),
        ]
    }

    /// The best of a guess and the directions that are normal to one of the surfaces.
    fn best_normal(&self, [outwards_a, outwards_b]: &[Normals; 2], best: Guess) -> Guess {
        let mut normals: Normals = outwards_a.iter().map(|outwards| -outwards).collect();
        normals.extend_from_slice(outwards_b);
        self.best_of(&normals, best)
    }

    /// The best of a guess and the directions across an edge, a rim or a ruling of each surface around two points, and of the normals of one
    /// across edges of a polytope.
    fn best_across_edges(&self, points: &[Vec3; 2], normals: &[Normals; 2], best: Guess) -> Guess {
        let on_a = edges_around(self.cores[0], &points[0], self.size);
        let on_b = edges_around(self.cores[1], &points[1], self.size);
        let mut found = Normals::new();
        for (side, edges) in [&on_a, &on_b].into_iter().enumerate() {
            let other = 1 - side;
            if self.cores[side].smooth().is_some() {
                continue;
            }
            for (along, _) in edges {
                for outwards in &normals[other] {
                    let normal = if other == 0 { -outwards } else { *outwards };
                    let level = normal - along * along.dot(&normal);
                    found.extend(level.try_normalize(tolerance::PARALLEL_EDGES));
                }
            }
        }
        for (along, height) in &on_a {
            // A's outward normal is the opposite of the direction.
            let on_a = (*along, -height);
            for on_b in &on_b {
                let across = along.cross(&on_b.0);
                if across.norm() > tolerance::PARALLEL_EDGES {
                    for side in [across, -across] {
                        found.extend(direction_on_both(on_a, *on_b, &side));
                    }
                }
            }
        }
        self.best_of(&found, best)
    }

    /// The best of a guess and some unit directions from B to A.
    fn best_of(&self, normals: &[Vec3], best: Guess) -> Guess {
        with_widest(BestOf {
            parts: self,
            normals,
            best,
        })
    }

    /// What Newton's method finds from a guess, between the parts of the surfaces that this is normal to.
    fn solve(&self, guess: &Guess) -> Option<Nearby> {
        let [a, b] = self.cores;
        let [on_a, on_b] = &self.points;
        let n = &guess.normal;
        let names = [part_along(a, on_a, &-n), part_along(b, on_b, n)];
        let found = touch_between(self.cores, names, n, self.size)?;
        (found.lower >= guess.gap - self.accepted()).then_some(found)
    }
}

/// What Newton's method finds from a guess of the unit direction from B to A, between parts of these names: see [`TouchingParts::touch_along`].
pub fn touch_between(
    cores: [&Core; 2],
    names: [Names; 2],
    guess: &Vec3,
    size: f64,
) -> Option<Nearby> {
    with_widest(BetweenParts {
        cores,
        names,
        guess,
        accepted: ACCEPTED * size,
    })
}

struct BestOf<'a> {
    parts: &'a TouchingParts<'a>,
    normals: &'a [Vec3],
    best: Guess,
}

impl Work for BestOf<'_> {
    type Output = Guess;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Guess {
        let mut best = self.best;
        for normal in self.normals {
            best = best.or(self.parts.guess(*normal));
        }
        best
    }
}

struct BetweenParts<'a> {
    cores: [&'a Core<'a>; 2],
    names: [Names; 2],
    guess: &'a Vec3,
    accepted: f64,
}

impl Work for BetweenParts<'_> {
    type Output = Option<Nearby>;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Option<Nearby> {
        let parts = NearestParts::new(self.cores, self.names, self.accepted)?;
        parts.at_touch().solve(self.guess)
    }
}

/// A guess, and what Newton's method makes of it.
struct Tried {
    guess: Guess,
    found: Option<Nearby>,
}

impl Tried {
    fn new(parts: &TouchingParts, guess: Guess) -> Self {
        Self {
            guess,
            found: parts.solve(&guess),
        }
    }

    /// Whether cores that do not overlap have been found to touch or to be apart: no direction has a larger gap than two points are apart.
    fn is_apart(&self, parts: &TouchingParts) -> bool {
        self.found
            .is_some_and(|near| near.lower >= -parts.accepted())
    }

    /// Takes a guess that is better than all that is known by more than rounding.
    fn improve(&mut self, parts: &TouchingParts, guess: Guess) {
        let reached = self.found.map_or(self.guess.gap, |near| near.lower);
        if guess.gap > reached + parts.accepted() {
            *self = Self::new(parts, guess);
        }
    }
}

impl Guess {
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        if other.gap > self.gap { other } else { self }
    }
}

/// The names of the part of a core's surface that has an outward normal; of a face, those of corners around a point in it.
fn part_along(core: &Core, point: &Vec3, outwards: &Vec3) -> Names {
    let placed = core.placed();
    if core.smooth().is_some() {
        let rulings = Names::two(LOW_END, HIGH_END);
        let tube = SurfacePart::between(core, rulings.as_slice());
        return match tube.and_then(|tube| tube.constraint()) {
            Some((axis, height)) if (axis.dot(outwards) - height).abs() <= ON_RULINGS => rulings,
            _ => Names::one(core.extreme(outwards).name),
        };
    }
    if let Some(cuboid) = cuboid(placed) {
        let normal = turned_back(&cuboid.axes, &placed.turned_back(outwards));
        let is_level = |k: usize| normal[k].abs() <= ON_RULINGS;
        let sides = Vec3::from_fn(|k, _| {
            if is_level(k) {
                0.0
            } else {
                2.0 * normal[k].signum()
            }
        });
        let names = placed.names_of(cuboid.feature_towards(&cuboid.half.component_mul(&sides)));
        return names.unwrap_or_else(|| Names::one(core.extreme(outwards).name));
    }
    polytope_part_along(core, point, outwards)
}

/// The same of a hull of vertices that is no box: of the faces and edges at the extreme vertex.
#[inline(never)]
fn polytope_part_along(core: &Core, point: &Vec3, outwards: &Vec3) -> Names {
    let placed = core.placed();
    let corner = core.extreme(outwards).name;
    let is_face = |face: usize| {
        let normal = placed.normal(face);
        let side = if placed.shape.faces.len() == 1 {
            outwards * normal.dot(outwards).signum()
        } else {
            *outwards
        };
        (normal - side).amax() <= ON_RULINGS
    };
    let is_edge = |edge: &&[u32; 2]| {
        let along = core.vertex(edge[1]) - core.vertex(edge[0]);
        along.dot(outwards).abs() <= ON_RULINGS * along.norm()
    };
    let (faces, edges) = (&placed.shape.faces, &placed.shape.edges);
    let (face, edge) = match placed.incidence() {
        Some(incidence) => {
            let mut around = incidence.faces_of(corner).iter().map(|&face| face as usize);
            let ending = incidence.edges_of(corner).iter();
            (
                around.find(|&face| is_face(face)),
                ending.map(|&edge| &edges[edge as usize]).find(is_edge),
            )
        }
        None => {
            let mut around =
                (0..faces.len()).filter(|&face| faces[face].vertices.contains(&corner));
            let mut ending = edges.iter().filter(|edge| edge.contains(&corner));
            (around.find(|&face| is_face(face)), ending.find(is_edge))
        }
    };
    match (face, edge) {
        (Some(face), _) => Names::three(corners_around(core, face, point)),
        (None, Some(edge)) => Names::two(edge[0], edge[1]),
        (None, None) => Names::one(corner),
    }
}

/// Three corners of a face whose triangle holds a point, if the face does.
fn corners_around(core: &Core, face: usize, point: &Vec3) -> [u32; 3] {
    let ring = &core.placed().shape.faces[face].vertices;
    let normal = core.placed().normal(face);
    let first = core.vertex(ring[0]);
    // Counter-clockwise from the first corner: what is not beyond a triangle's last side is in it.
    let is_before = |&i: &usize| {
        let side = core.vertex(ring[i + 1]) - first;
        normal.cross(&side).dot(&(point - first)) <= 0.0
    };
    let last = ring.len() - 2;
    let i = (1..last).find(is_before).unwrap_or(last);
    [ring[0], ring[i], ring[i + 1]]
}

/// The outward normals of a core's surface around a point on it or near it.
fn normals_around(core: &Core, point: &Vec3, size: f64) -> Normals {
    let mut found = Normals::new();
    let Some(smooth) = core.smooth() else {
        let placed = core.placed();
        if let Some(cuboid) = cuboid(placed) {
            let seen = cuboid.seen(&placed.seen(point));
            let normal = |k: usize| cuboid.axes.column(k) * seen[k].signum();
            found.extend([0, 1, 2].map(|k| placed.turned(&normal(k))));
            return found;
        }
        let is_flat = placed.shape.faces.len() == 1;
        let faces: SmallVec<[usize; 16]> = placed.faces_at(point, AROUND * size).collect();
        for &face in evenly(&faces) {
            let normal = placed.normal(face);
            found.push(normal);
            if is_flat {
                found.push(-normal);
                // Across its edges, in its plane.
                let edges = edges_around(core, point, size);
                let across = edges.iter().map(|(along, _)| along.cross(&normal));
                found.extend(across.flat_map(|across| [across, -across]));
            }
        }
        return found;
    };
    let local = smooth.seen(point);
    match *smooth.kind {
        SmoothKind::Cylinder { .. } => {
            let end = Vec3::z() * 1f64.copysign(local.z);
            found.extend([outwards(&local), end]);
        }
        SmoothKind::Cone { radius, height } => {
            let side = outwards(&local) * height + Vec3::z() * radius;
            found.extend([side / radius.hypot(height), -Vec3::z(), Vec3::z()]);
        }
        SmoothKind::Ellipsoid { semi_axes } => {
            let steepest = local.component_div(&semi_axes.component_mul(&semi_axes));
            found.extend(steepest.try_normalize(0.0));
        }
        SmoothKind::Function(_) => (),
    }
    for normal in &mut found {
        *normal = turned(&smooth.axes, normal);
    }
    found
}

/// The edges, the rim and the rulings of a core's surface around a point on it or near it: planes touch one where their outward normal n has
/// n . v = c, for a unit vector v and a number c.
fn edges_around(core: &Core, point: &Vec3, size: f64) -> SmallVec<[(Vec3, f64); 8]> {
    let Some(smooth) = core.smooth() else {
        let placed = core.placed();
        if let Some(cuboid) = cuboid(placed) {
            let along = |k: usize| placed.turned(&cuboid.axes.column(k).into());
            return [0, 1, 2].map(|k| (along(k), 0.0)).into_iter().collect();
        }
        if placed.vertex_count() == 2 {
            let along = (core.vertex(1) - core.vertex(0)).try_normalize(0.0);
            return along.into_iter().map(|along| (along, 0.0)).collect();
        }
        let local = LocalFeatures::around(placed, point, AROUND * size);
        return evenly(&local.directions)
            .map(|&along| (along, 0.0))
            .collect();
    };
    let rulings_height = match *smooth.kind {
        SmoothKind::Cylinder { .. } => 0.0,
        SmoothKind::Cone { radius, height } => radius / radius.hypot(height),
        SmoothKind::Ellipsoid { .. } | SmoothKind::Function(_) => return SmallVec::new(),
    };
    let outwards = outwards(&smooth.seen(point));
    let rim = Vec3::new(-outwards.y, outwards.x, 0.0);
    let edges = [(rim, 0.0), (Vec3::z(), rulings_height)];
    let edges = edges.map(|(along, height)| (turned(&smooth.axes, &along), height));
    edges.into_iter().collect()
}

/// At most [`MAX_AROUND`] of a list.
fn evenly<T>(all: &[T]) -> impl Iterator<Item = &T> {
    all.iter().step_by(all.len().div_ceil(MAX_AROUND).max(1))
}

/// The direction from the axis of a solid of revolution to a point, in the solid's own frame.
fn outwards(local: &Vec3) -> Vec3 {
    let away = Vec3::new(local.x, local.y, 0.0);
    away.try_normalize(0.0).unwrap_or_else(Vec3::x)
}
