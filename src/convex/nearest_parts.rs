//! Newton's method for the direction between the closest points of two surface parts, once GJK has found which parts these are.
//! It reaches the last digit in a few steps, where GJK alone halves the error in each.

use super::core::Core;
use super::surface_part::{PartSupport, SurfacePart};
use crate::gjk::{Names, Nearby, Support};
use crate::pose::Vec3;
use crate::primitive::plane_axes;

/// At most 10 Newton steps; then GJK goes on by itself.
const MAX_STEPS: usize = 10;

/// The largest turn in one step, in radians.
const MAX_TURN: f64 = 0.7;

/// Lines count as parallel when the sine of the angle between them is below this.
const PARALLEL_LINES: f64 = 1e-9;

/// Two cores, their nearest surface parts, and the gap between upper and lower bound at which a distance is accepted.
pub struct NearestParts<'a> {
    cores: [&'a Core<'a>; 2],
    names: [Names; 2],
    parts: [SurfacePart; 2],
    accepted: f64,
    /// Whether what the points are off one another across the direction has to be accepted too. The distance of cores that are apart hardly
    /// shows it, and cores that touch have nothing else.
    is_at_touch: bool,
}

impl<'a> NearestParts<'a> {
    /// Takes the surface parts between the named extreme points of the two cores; `None` where a core has no such part.
    #[inline(always)]
    pub fn new(cores: [&'a Core<'a>; 2], names: [Names; 2], accepted: f64) -> Option<Self> {
        let part = |side: usize| SurfacePart::between(cores[side], names[side].as_slice());
        Some(Self {
            cores,
            names,
            parts: [part(0)?, part(1)?],
            accepted,
            is_at_touch: false,
        })
    }

    /// The same of cores that touch or overlap by a little: what [`Self::solve`] finds has a signed gap, and its direction no other around
    /// it that has a larger one, to first order.
    #[inline(always)]
    pub fn at_touch(self) -> Self {
        Self {
            is_at_touch: true,
            ..self
        }
    }

    /// The closest points, from a guess of the unit direction from B to A; `None` unless a direction certifies them.
    #[inline(always)]
    pub fn solve(&self, guess: &Vec3) -> Option<Nearby> {
        for side in 0..2 {
            if let Some(found) = self.over_face(side, guess) {
                return Some(found);
            }
        }
        if self.parts.iter().any(SurfacePart::is_flat) {
            return None;
        }
        // Constraints on the direction from B to A; A's own direction is the opposite.
        let on_a = self.parts[0]
            .constraint()
            .map(|(along, value)| (along, -value));
        let on_b = self.parts[1].constraint();
        match (on_a, on_b) {
            (Some(one), Some(other)) if are_parallel(&one.0, &other.0) => {
                self.between_parallel_lines()
            }
            (Some(one), Some(other)) => self.between_lines(&direction_on_both(one, other, guess)?),
            (Some(one), None) | (None, Some(one)) => self.turn_around(one, guess),
            (None, None) => self.turn_freely(guess),
        }
    }

    /// The other set's support point towards a face of one set, if it lies over that face.
    #[inline(always)]
    fn over_face(&self, side: usize, guess: &Vec3) -> Option<Nearby> {
        let outwards = if side == 0 { -guess } else { *guess };
        let normal = self.parts[side].face_normal(&outwards)?;
        let mut names = self.names;
        let (foot, other) = match self.level_over_face(side, &normal) {
            Some(points) => points,
            None => {
                // Not always on the part that was taken to be nearest.
                let other = self.cores[1 - side].extreme(&-normal);
                names[1 - side] = Names::one(other.name);
                (self.parts[side].foot(&normal, &other.point)?, other.point)
            }
        };
        let (direction, points) = if side == 0 {
            (-normal, [foot, other])
        } else {
            (normal, [other, foot])
        };
        let found = self.accept(&direction, points)?;
        Some(Nearby { names, ..found })
    }

    /// The points of a face and of the other part where that is a disc or a line parallel to the face, and over it: support points would be
    /// any of it.
    #[inline(always)]
    fn level_over_face(&self, side: usize, normal: &Vec3) -> Option<(Vec3, Vec3)> {
        let (face, other) = (&self.parts[side], &self.parts[1 - side]);
        if let SurfacePart::Rim {
            center,
            axis,
            radius,
        } = other
        {
            if (axis + normal).amax() > PARALLEL_LINES {
                return None;
            }
            let foot = face.nearest_in_face(normal, center)?;
            let aside = foot - center;
            let aside = aside - axis * axis.dot(&aside);
            return (aside.norm() <= *radius).then_some((foot, center + aside));
        }
        let (along, half) = other.line(&-normal)?;
        if along.dot(normal).abs() > PARALLEL_LINES {
            return None;
        }
        let middle = other.support(&-normal).point;
        let point = middle + along * face.place_over_face(normal, &middle, &along, half)?;
        Some((face.foot(normal, &point)?, point))
    }

    /// The closest points of two lines that are parallel, edges or rulings of a tube, from the middle of what is beside one another.
    fn between_parallel_lines(&self) -> Option<Nearby> {
        let [a, b] = [self.parts[0].round_line()?, self.parts[1].round_line()?];
        let way = a.center - b.center;
        let along = a.along * a.along.dot(&b.along).signum();
        let place = along.dot(&way);
        let direction = (way - along * place).try_normalize(0.0)?;
        let (low, high) = ((place - a.half).max(-b.half), (place + a.half).min(b.half));
        if low > high {
            return None;
        }
        let middle = 0.5 * (low + high);
        let points = [
            a.center + along * (middle - place) - direction * a.radius,
            b.center + b.along * middle + direction * b.radius,
        ];
        self.accept(&direction, points)
    }

    /// The closest points of two lines, for a direction that satisfies both constraints.
    #[inline(always)]
    fn between_lines(&self, direction: &Vec3) -> Option<Nearby> {
        let [p, q] = self.supports(direction).map(|at| at.point);
        let (along_p, half_p) = self.parts[0].line(&-direction)?;
        let (along_q, half_q) = self.parts[1].line(direction)?;
        let across = along_p.cross(&along_q);
        let square = across.norm_squared();
        if square <= PARALLEL_LINES * PARALLEL_LINES {
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

    /// Newton steps along the circle of directions that satisfy the constraint of the one line.
    #[inline(always)]
    fn turn_around(&self, (axis, height): (Vec3, f64), guess: &Vec3) -> Option<Nearby> {
        let radius = (1.0 - height * height).sqrt();
        let on_circle = |n: &Vec3| {
            let once = (n - axis * axis.dot(n)).try_normalize(0.0)?;
            // Projected twice: what is left of a direction along the axis is rounding, which may point along it too.
            let away = (once - axis * axis.dot(&once)).try_normalize(0.5)?;
            Some(axis * height + away * radius)
        };
        let mut direction = on_circle(guess)?;
        for _ in 0..MAX_STEPS {
            let supports = self.supports(&direction);
            let (points, places) = self.points_on_line(&supports, &direction);
            let (off, apart) = split(&points, &direction);
            if self.is_within_accepted(&off, apart)
                && let Some(found) = self.accept(&direction, points)
            {
                return Some(found);
            }
            let tangent = axis.cross(&direction) / radius;
            let stiffness = tangent.dot(&self.bend(&supports, &tangent, places)) + apart;
            let step = tangent * (tangent.dot(&off) / stiffness);
            direction = on_circle(&turned_by(&direction, &step)?)?;
        }
        None
    }

    /// Newton steps over the sphere of directions.
    #[inline(always)]
    fn turn_freely(&self, guess: &Vec3) -> Option<Nearby> {
        let mut direction = *guess;
        for _ in 0..MAX_STEPS {
            let supports = self.supports(&direction);
            let points = [supports[0].point, supports[1].point];
            let (off, apart) = split(&points, &direction);
            if self.is_within_accepted(&off, apart)
                && let Some(found) = self.accept(&direction, points)
            {
                return Some(found);
            }
            let (x, y) = plane_axes(&direction);
            let (by_x, by_y) = (
                self.bend(&supports, &x, [0.0; 2]),
                self.bend(&supports, &y, [0.0; 2]),
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

    /// The support points of both parts towards each other, for a direction from B to A.
    #[inline(always)]
    fn supports(&self, direction: &Vec3) -> [PartSupport; 2] {
        let [a, b] = &self.parts;
        [a.support(&-direction), b.support(direction)]
    }

    /// The same where one part is a line: its point nearest to the other part, and the places of both points along their lines.
    #[inline(always)]
    fn points_on_line(
        &self,
        supports: &[PartSupport; 2],
        direction: &Vec3,
    ) -> ([Vec3; 2], [f64; 2]) {
        let [a, b] = &self.parts;
        let (p, q) = (supports[0].point, supports[1].point);
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

    /// Minus the derivative of the vector between the points as the direction turns by `by`.
    #[inline(always)]
    fn bend(&self, [at_a, at_b]: &[PartSupport; 2], by: &Vec3, places: [f64; 2]) -> Vec3 {
        let [a, b] = &self.parts;
        b.bend(at_b, by, places[1]) - a.bend(at_a, &-by, places[0])
    }

    /// Whether the remaining offset across the direction lengthens the distance by no more than the accepted gap.
    #[inline(always)]
    fn is_within_accepted(&self, off: &Vec3, apart: f64) -> bool {
        let most = if self.is_at_touch {
            self.accepted
        } else {
            apart.abs()
        };
        off.norm_squared() <= self.accepted * most
    }

    /// The points, if the direction certifies their distance to within the accepted gap. Points nearer to each other than that by more
    /// are not points of the cores. At touch, if they are that near to where the direction has its gap.
    #[inline(always)]
    fn accept(&self, direction: &Vec3, points: [Vec3; 2]) -> Option<Nearby> {
        let [a, b] = self.cores;
        let lower = direction.dot(&(a.support(&-direction) - b.support(direction)));
        let way = points[0] - points[1];
        let off = if self.is_at_touch {
            (way - direction * lower).norm()
        } else {
            (way.norm() - lower).abs()
        };
        (off <= self.accepted).then_some(Nearby {
            lower,
            direction: *direction,
            points,
            names: self.names,
        })
    }
}

#[inline(always)]
fn are_parallel(one: &Vec3, other: &Vec3) -> bool {
    one.cross(other).norm_squared() <= PARALLEL_LINES * PARALLEL_LINES
}

/// The components of the vector from B's point to A's across a direction and along it.
#[inline(always)]
fn split(points: &[Vec3; 2], direction: &Vec3) -> (Vec3, f64) {
    let way = points[0] - points[1];
    let apart = direction.dot(&way);
    (way - direction * apart, apart)
}

/// A unit direction after a step of at most `MAX_TURN`; `None` if the step is not finite.
#[inline(always)]
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

/// The unit direction that satisfies two constraints that are not parallel; of two solutions the one nearer to a guess. `None` where there
/// is none.
#[inline(always)]
pub fn direction_on_both(one: (Vec3, f64), other: (Vec3, f64), guess: &Vec3) -> Option<Vec3> {
    let ((g, s), (h, t)) = (one, other);
    let across = g.cross(&h);
    let square = across.norm_squared();
    // The component in the plane of the two axes, then the one across it.
    let in_plane = h.cross(&across) * (s / square) + across.cross(&g) * (t / square);
    let rest = 1.0 - in_plane.norm_squared();
    if rest < 0.0 {
        return None;
    }
    let out = across * (rest / square).sqrt();
    let sign = if out.dot(guess) < 0.0 { -1.0 } else { 1.0 };
    (in_plane + out * sign).try_normalize(0.0)
}
