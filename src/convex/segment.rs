//! Segments, and the closest points of two.

use crate::pose::Vec3;

/// A segment with its direction.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    start: Vec3,
    end: Vec3,
    along: Vec3,
    square: f64,
}

impl Segment {
    pub fn new((start, end): (Vec3, Vec3)) -> Self {
        let along = end - start;
        Self {
            start,
            end,
            along,
            square: along.norm_squared(),
        }
    }

    /// A segment of length 0.
    pub fn point(at: Vec3) -> Self {
        Self {
            start: at,
            end: at,
            along: Vec3::zeros(),
            square: 0.0,
        }
    }

    #[inline(always)]
    pub fn ends(&self) -> [Vec3; 2] {
        [self.start, self.end]
    }

    /// From the start to the end.
    #[inline(always)]
    pub fn along(&self) -> &Vec3 {
        &self.along
    }

    #[inline(always)]
    pub fn at(&self, parameter: f64) -> Vec3 {
        if parameter >= 1.0 {
            self.end
        } else {
            self.start + self.along * parameter
        }
    }

    pub fn nearest_parameter(&self, point: &Vec3) -> f64 {
        if self.square > 0.0 {
            (self.along.dot(&(point - self.start)) / self.square).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// Parameters of the closest points of two segments.
///
/// Where both lie within the segments, the first is that of the lines, from the cross product of the directions: off by some EPSILON over
/// the sine of their angle. The other is its foot on the other line. So the points are off along the lines alone, together, and their
/// distance by that times the sine: it is fully accurate at any angle. With the usual determinant it would lose half its digits, and with
/// two parameters from the cross product as much where the lines meet.
#[inline(always)]
pub fn closest_parameters(p: &Segment, q: &Segment) -> (f64, f64) {
    // A segment of length 0 is a point.
    if p.square == 0.0 {
        return (0.0, q.nearest_parameter(&p.start));
    }
    if q.square == 0.0 {
        return (p.nearest_parameter(&q.start), 0.0);
    }
    closest_of_lines(p, q)
}

fn closest_of_lines(p: &Segment, q: &Segment) -> (f64, f64) {
    let cross = p.along.cross(&q.along);
    let square = cross.norm_squared();
    let between = q.start - p.start;
    let mut best = (0.0, 0.0);
    let mut least = f64::INFINITY;
    let mut offer = |s: f64, t: f64| {
        let d = (p.at(s) - q.at(t)).norm_squared();
        if d < least {
            least = d;
            best = (s, t);
        }
    };
    if square > 0.0 {
        let s = between.cross(&q.along).dot(&cross) / square;
        let t = q.along.dot(&(p.along * s - between)) / q.square;
        if s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 {
            offer(s, t);
            if square > 1e-4 * p.square * q.square {
                return (s, t);
            }
        }
    }
    offer(0.0, q.nearest_parameter(&p.start));
    offer(1.0, q.nearest_parameter(&p.end));
    offer(p.nearest_parameter(&q.start), 0.0);
    offer(p.nearest_parameter(&q.end), 1.0);
    best
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;
    use crate::pose::rotation_about;

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    #[test]
    fn nearly_parallel_segments_keep_their_digits() {
        let random = &mut Random::new(5);
        for round in 0..20_000 {
            // Lines that cross in projection, at angles down to 1e-12, anyhow turned.
            let angle = 10f64.powf(random.within(-12.0, 0.0));
            let height = [0.0, 1e-9, 1e-3][round % 3];
            let frame = rotation_about(&vector(random).normalize(), random.within(0.0, 6.0));
            let (y, x) = angle.sin_cos();
            let ways = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(x, y, 0.0)];
            let at = [Vec3::zeros(), Vec3::new(0.0, 0.0, height)];
            let [p, q] = [0, 1].map(|i| {
                let ends =
                    [-1.0, 1.0].map(|sign| at[i] + ways[i] * (sign * random.within(0.1, 1.0)));
                Segment::new((frame * ends[0], frame * ends[1]))
            });
            let (s, t) = closest_parameters(&p, &q);
            let distance = (p.at(s) - q.at(t)).norm();
            assert!(
                (distance - height).abs() < 2e-15,
                "{angle}: {distance} for {height}"
            );
        }
    }
}
