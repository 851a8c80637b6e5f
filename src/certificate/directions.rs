//! Directions that may part two groups of primitives over an interval.

use super::measure::{Along, Group, Measure, Part};
use super::statement::Carried;
use crate::error::Result;
use crate::gjk::{DistanceLimits, Extreme, Gjk, Support, gjk};
use crate::pose::{Pose, Vec3};

/// The hull of a group at one or two poses.
struct Swept<'a> {
    group: Group<'a>,
    poses: &'a [Pose],
}

impl Support for Swept<'_> {
    fn extreme(&self, direction: &Vec3) -> Extreme {
        let mut best = (f64::NEG_INFINITY, Vec3::zeros(), 0);
        let Some(body) = self.group.body else {
            return Extreme {
                point: Vec3::zeros(),
                name: 0,
            };
        };
        let mut name = 0;
        for pose in self.poses {
            let back = pose.rotation.tr_mul(direction);
            for primitive in self.group.primitives {
                let primitive = body.primitives().get(*primitive as usize);
                let point = pose.transform_point(&(primitive.farthest(&back) + body.center()));
                let along = direction.dot(&point);
                if along > best.0 {
                    best = (along, point, name);
                }
                name += 1;
            }
        }
        Extreme {
            point: best.1,
            name: best.2,
        }
    }
}

impl Measure<'_> {
    /// Bounds the distance of one group, at the given times all together, from the other, in the frame of the carrier's body. The
    /// direction found leads from the group that rests.
    fn distance_at(
        &mut self,
        sides: &[Carried; 2],
        part: &Part,
        resting: usize,
        times: &[f64],
    ) -> Result<Gjk> {
        let moving = 1 - resting;
        let mut poses = Vec::new();
        for time in times {
            let to_resting = self.place(&sides[resting], *time)?.inverse();
            poses.push(to_resting.compose(&self.place(&sides[moving], *time)?));
        }
        let swept = Swept {
            group: self.group(&sides[moving], part.groups[moving]),
            poses: &poses,
        };
        let other = Swept {
            group: self.group(&sides[resting], part.groups[resting]),
            poses: &[Pose::identity()],
        };
        let exact = DistanceLimits::EXACT;
        Ok(gjk(&swept, &other, Vec3::zeros(), exact))
    }

    /// A lower bound of the distance of the two groups at a time.
    pub fn distance(&mut self, sides: &[Carried; 2], part: &Part, time: f64) -> Result<f64> {
        Ok(self.distance_at(sides, part, 1, &[time])?.lower)
    }

    /// The direction that rests with a body and parts the groups best at both ends of the interval, if one does.
    pub fn parting(
        &mut self,
        sides: &[Carried; 2],
        part: &Part,
        carrier: usize,
    ) -> Result<Option<Along>> {
        let found = self.distance_at(sides, part, carrier, &part.times)?;
        let direction = match carrier {
            1 => found.direction,
            _ => -found.direction,
        };
        let direction = direction.try_normalize(0.0);
        Ok(direction.map(|direction| Along { carrier, direction }))
    }

    /// The direction between the middles of the bodies in the middle of the interval.
    pub fn between_centers(&mut self, sides: &[Carried; 2], part: &Part) -> Result<Option<Along>> {
        let time = 0.5 * (part.times[0] + part.times[1]);
        let mut centers = [Vec3::zeros(); 2];
        for (side, center) in sides.iter().zip(&mut centers) {
            let own = side.body.map_or(Vec3::zeros(), |body| *body.center());
            *center = self.place(side, time)?.transform_point(&own);
        }
        let apart = centers[0] - centers[1];
        let in_second = self.place(&sides[1], time)?.rotation.tr_mul(&apart);
        let direction = in_second.try_normalize(0.0);
        Ok(direction.map(|direction| Along {
            carrier: 1,
            direction,
        }))
    }
}
