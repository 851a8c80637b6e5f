//! Newton's steps on the direction in which two parts of surfaces are nearest, once a search has told which parts these are: it
//! comes to the last digit in a few steps, where the search alone halves what is left.

use super::curved::Core;
use super::surface_part::SurfacePart;
use crate::gjk::{Nearby, Support};
use crate::pose::Vec3;

/// At most 10 Newton steps; then the search goes on by itself.
const MAX_STEPS: usize = 10;

/// At most this turn in one step, in radians.
const MAX_TURN: f64 = 0.7;

/// Lines whose directions have a smaller sine between them count as parallel.
const PARALLEL: f64 = 1e-9;

/// Two cores, their parts that are nearest, and how near the bounds of a distance must come together to be it.
pub struct NearestParts<'a> {
    cores: [&'a Core<'a>; 2],
    parts: [SurfacePart; 2],
    accepted: f64,
}

impl<'a> NearestParts<'a> {
    /// Of the parts between named points of the two; `None` where there is none.
    pub fn new(cores: [&'a Core<'a>; 2], names: [&[u32]; 2], accepted: f64) -> Option<Self> {
        let part = |side: usize| SurfacePart::between(cores[side], names[side]);
        Some(Self {
            cores,
            parts: [part(0)?, part(1)?],
            accepted,
        })
    }

    /// The nearest points, from a guess of the unit direction from B to A; `None` unless a direction proves them nearest.
    pub fn solve(&self, guess: &Vec3) -> Option<Nearby> {
        for side in 0..2 {
            if let Some(found) = self.over_face(side, guess) {
                return Some(found);
            }
        }
        if self
            .parts
            .iter()
            .any(|part| matches!(part, SurfacePart::Facet(_)))
        {
            return None;
        }
        // As of the direction from B to A: A looks along the opposite.
        let on_a = self.parts[0]
            .constraint()
            .map(|(along, value)| (along, -value));
        let on_b = self.parts[1].constraint();
        match (on_a, on_b) {
            (Some(one), Some(other)) => self.between_lines(&on_both(one, other, guess)?),
            (Some(one), None) | (None, Some(one)) => self.turn_around(one, guess),
            (None, None) => self.turn_freely(guess),
        }
    }

    /// The point of the other set that is farthest towards a face of one, if it is over it.
    fn over_face(&self, side: usize, guess: &Vec3) -> Option<Nearby> {
        let outwards = if side == 0 { -guess } else { *guess };
        let normal = self.parts[side].face_normal(&outwards)?;
        let other = self.cores[1 - side].support(&-normal);
        let foot = self.parts[side].foot(&normal, &other)?;
        let (direction, points) = if side == 0 {
            (-normal, [foot, other])
        } else {
            (normal, [other, foot])
        };
        self.accept(&direction, points)
    }

    /// The points of two lines, of a direction that both admit.
    fn between_lines(&self, direction: &Vec3) -> Option<Nearby> {
        let [p, q] = self.points(direction);
        let (along_p, half_p) = self.parts[0].line(&-direction)?;
        let (along_q, half_q) = self.parts[1].line(direction)?;
        let across = along_p.cross(&along_q);
        let square = across.norm_squared();
        if square <= PARALLEL * PARALLEL {
            return None;
        }
        let between = q - p;
        let place = |along: &Vec3, half: f64| {
            let place = between.cross(along).dot(&across) / square;
            place.clamp(-half, half)
        };
        let on_p = place(&along_q, half_p);
        let on_q = place(&along_p, half_q);
        self.accept(direction, [p + along_p * on_p, q + along_q * on_q])
    }

    /// Steps along the circle of directions that a line on one side admits.
    fn turn_around(&self, (axis, height): (Vec3, f64), guess: &Vec3) -> Option<Nearby> {
        let radius = (1.0 - height * height).sqrt();
        let on_circle = |n: &Vec3| {
            let away = (n - axis * axis.dot(n)).try_normalize(0.0)?;
            Some(axis * height + away * radius)
        };
        let mut direction = on_circle(guess)?;
        for _ in 0..MAX_STEPS {
            let (points, places) = self.points_on_line(&direction);
            let (off, apart) = split(&points, &direction);
            if self.is_near_enough(&off, apart)
                && let Some(found) = self.accept(&direction, points)
            {
                return Some(found);
            }
            let tangent = axis.cross(&direction) / radius;
            let stiffness = tangent.dot(&self.bend(&direction, &tangent, places)) + apart;
            let step = tangent * (tangent.dot(&off) / stiffness);
            direction = on_circle(&turned_by(&direction, &step)?)?;
        }
        None
    }

    /// Steps over the sphere of directions.
    fn turn_freely(&self, guess: &Vec3) -> Option<Nearby> {
        let mut direction = *guess;
        for _ in 0..MAX_STEPS {
            let points = self.points(&direction);
            let (off, apart) = split(&points, &direction);
            if self.is_near_enough(&off, apart)
                && let Some(found) = self.accept(&direction, points)
            {
                return Some(found);
            }
            let (x, y) = upright_to(&direction);
            let (by_x, by_y) = (
                self.bend(&direction, &x, [0.0; 2]),
                self.bend(&direction, &y, [0.0; 2]),
            );
            let (xx, xy, yy) = (x.dot(&by_x) + apart, x.dot(&by_y), y.dot(&by_y) + apart);
            let determinant = xx * yy - xy * xy;
            let (along_x, along_y) = (x.dot(&off), y.dot(&off));
            let step = x * ((along_x * yy - along_y * xy) / determinant)
                + y * ((along_y * xx - along_x * xy) / determinant);
            direction = turned_by(&direction, &step)?;
        }
        None
    }

    /// The points of both parts that are farthest towards one another along a direction from B to A.
    fn points(&self, direction: &Vec3) -> [Vec3; 2] {
        let [a, b] = &self.parts;
        [a.point(&-direction), b.point(direction)]
    }

    /// The same where one part is a line: of it the point nearest to the other, and where on the lines they are.
    fn points_on_line(&self, direction: &Vec3) -> ([Vec3; 2], [f64; 2]) {
        let [a, b] = &self.parts;
        let [p, q] = self.points(direction);
        if let Some((along, half)) = a.line(&-direction) {
            let place = along.dot(&(q - p)).clamp(-half, half);
            ([p + along * place, q], [place, 0.0])
        } else if let Some((along, half)) = b.line(direction) {
            let place = along.dot(&(p - q)).clamp(-half, half);
            ([p, q + along * place], [0.0, place])
        } else {
            ([p, q], [0.0; 2])
        }
    }

    /// How the points move apart, to first order, as the direction turns, with the opposite sign.
    fn bend(&self, direction: &Vec3, by: &Vec3, places: [f64; 2]) -> Vec3 {
        let [a, b] = &self.parts;
        b.bend(direction, by, places[1]) - a.bend(&-direction, &-by, places[0])
    }

    /// Whether what is left aside of the direction lengthens the distance by no more than is accepted.
    fn is_near_enough(&self, off: &Vec3, apart: f64) -> bool {
        off.norm_squared() <= self.accepted * apart.abs()
    }

    /// Points that the direction proves nearest, but for what is accepted.
    fn accept(&self, direction: &Vec3, points: [Vec3; 2]) -> Option<Nearby> {
        let [a, b] = self.cores;
        let lower = direction.dot(&(a.support(&-direction) - b.support(direction)));
        let upper = (points[0] - points[1]).norm();
        (upper - lower <= self.accepted).then_some(Nearby {
            lower,
            direction: *direction,
            points,
        })
    }
}

/// The part of the way from B to A that is aside of a direction, and the part along it.
fn split(points: &[Vec3; 2], direction: &Vec3) -> (Vec3, f64) {
    let way = points[0] - points[1];
    let apart = direction.dot(&way);
    (way - direction * apart, apart)
}

/// A unit direction after a step, if that makes sense.
fn turned_by(direction: &Vec3, step: &Vec3) -> Option<Vec3> {
    let length = step.norm();
    if !length.is_finite() {
        return None;
    }
    let part = if length > MAX_TURN {
        MAX_TURN / length
    } else {
        1.0
    };
    (direction + step * part).try_normalize(0.0)
}

/// Two unit vectors upright to a third and to each other.
fn upright_to(direction: &Vec3) -> (Vec3, Vec3) {
    let other = if direction.x.abs() < 0.6 {
        Vec3::x()
    } else {
        Vec3::y()
    };
    let x = direction.cross(&other).normalize();
    (x, direction.cross(&x))
}

/// The unit direction that two constraints admit, of two the one nearer to a guess; `None` where they are parallel, or admit
/// none.
fn on_both(one: (Vec3, f64), other: (Vec3, f64), guess: &Vec3) -> Option<Vec3> {
    let ((g, s), (h, t)) = (one, other);
    let across = g.cross(&h);
    let square = across.norm_squared();
    if square <= PARALLEL * PARALLEL {
        return None;
    }
    // In the plane of the two, and then out of it.
    let in_plane = h.cross(&across) * (s / square) + across.cross(&g) * (t / square);
    let rest = 1.0 - in_plane.norm_squared();
    if rest < 0.0 {
        return None;
    }
    let out = across * (rest / square).sqrt();
    let sign = if out.dot(guess) < 0.0 { -1.0 } else { 1.0 };
    (in_plane + out * sign).try_normalize(0.0)
}
