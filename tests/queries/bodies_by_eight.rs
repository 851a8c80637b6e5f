//! The bounds of bodies eight side by side: what holds of one body's bounds holds of each.

use cstk::body_bounds::{Bounds, BoundsByEight, BoxFrame, ChosenBodies};
use cstk::boxes::{BoxesByEight, PackedBox};
use cstk::index_set::IndexSet;
use cstk::lanes::{Instructions, Plain, Work, with_each};
use cstk::pair::ROUNDING;
use cstk::pose::{Pose, Vec3};
use helpers::random::Random;
use helpers::shapes::{Shape, hull};

/// The bounds of bodies at poses, and the boxes of some in a frame around a point.
struct Carried<'a> {
    own: &'a BoundsByEight,
    carriers: &'a [usize],
    poses: &'a [Pose],
    chosen: &'a IndexSet,
    center: Vec3,
}

impl Work for Carried<'_> {
    type Output = (BoundsByEight, BoxFrame, BoxesByEight, f64);

    fn run<I: Instructions>(self, lanes: I) -> Self::Output {
        let chosen = ChosenBodies {
            first: 0,
            words: self.chosen.words(),
        };
        let (mut bounds, mut boxes) = (BoundsByEight::default(), BoxesByEight::default());
        bounds.carry(lanes, self.own, self.carriers, self.poses);
        let limits = bounds.limits(lanes, chosen, &self.center);
        let frame = BoxFrame::new(self.center, &limits, limits.deviation);
        bounds.pack(lanes, chosen, &frame, &mut boxes);
        (bounds, frame, boxes, limits.size)
    }
}

/// The farthest that a point is out of a box, along its axes.
fn outside(given: &PackedBox, point: &Vec3) -> f64 {
    let center = Vec3::from(given.center.map(f64::from));
    let out = |i: usize| {
        let axis = Vec3::from(given.axes[i].map(f64::from));
        axis.dot(&(point - center)).abs() - f64::from(given.half[i])
    };
    (0..3).map(out).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn eight_bodies_are_bounded_as_each_alone() {
    let mut random = Random::new(72);
    for count in [1, 2, 3, 4, 5, 7, 8, 9, 12, 13, 64, 70] {
        let size = 10f64.powf(random.within(-4.0, 4.0));
        let shapes: Vec<Shape> = (0..count)
            .map(|_| {
                let (at, width) = (random.point(size), random.within(0.01, 1.0));
                let points: Vec<Vec3> = (0..10).map(|_| at + random.point(size * width)).collect();
                hull(&points)
            })
            .collect();
        // Every third link has a body.
        let carriers: Vec<usize> = (0..count).map(|i| 3 * i + 1).collect();
        let poses: Vec<Pose> = (0..3 * count).map(|_| random.pose(3.0 * size)).collect();
        let mut own = BoundsByEight::default();
        for shape in &shapes {
            own.push(&Bounds::of(Plain, &shape.body, &Pose::IDENTITY));
        }
        let mut chosen = IndexSet::new(count);
        for number in 0..count {
            if random.within(0.0, 1.0) < 0.7 {
                chosen.insert(number);
            }
        }
        let center = random.point(size);
        let found = with_each(|| Carried {
            own: &own,
            carriers: &carriers,
            poses: &poses,
            chosen: &chosen,
            center,
        });
        for (bounds, frame, boxes, limit) in found {
            for (number, shape) in shapes.iter().enumerate() {
                let pose = &poses[carriers[number]];
                let (own, alone) = (bounds.get(number), Bounds::of(Plain, &shape.body, pose));
                let rounding = 1e-14 * size;
                assert!((own.box_center - alone.box_center).norm() < rounding);
                assert!((own.axes[0] - alone.axes[0]).norm() < 1e-15);
                assert!((own.axes[1] - alone.axes[1]).norm() < 1e-15);
                assert!((own.largest_coordinate - alone.largest_coordinate).abs() < rounding);
                assert_eq!(
                    (own.half, own.box_radius, own.deviation),
                    (alone.half, alone.box_radius, alone.deviation)
                );
                let [other, at] = [shapes.len() - 1, 0];
                let other = Bounds::of(Plain, &shapes[other].body, &poses[at]);
                for (a, b) in own.distance(&other).iter().zip(alone.distance(&other)) {
                    assert!((a - b).abs() < rounding);
                }
                if !chosen.contains(number) {
                    continue;
                }
                for point in &shape.parts[0] {
                    let at = pose.rotation * point + pose.translation - center;
                    assert!(at.norm() <= limit * (1.0 + 1e-12));
                    let out = outside(&boxes.get(number), &(at * frame.inverse_scale));
                    assert!(out * frame.scale <= ROUNDING * limit, "{count} {number}");
                }
            }
        }
    }
}

/// Those that are pushed after bodies that are carried keep their numbers.
#[test]
fn held_bodies_come_after_those_that_are_carried() {
    let mut random = Random::new(73);
    for count in [0, 1, 6, 8] {
        let one = hull(&(0..8).map(|_| random.point(1.0)).collect::<Vec<_>>());
        let poses: Vec<Pose> = (0..12).map(|_| random.pose(1.0)).collect();
        let carriers: Vec<usize> = (0..count).collect();
        let mut own = BoundsByEight::default();
        for _ in 0..count {
            own.push(&Bounds::of(Plain, &one.body, &Pose::IDENTITY));
        }
        let mut bounds = BoundsByEight::default();
        // In the memory of another, with more.
        for _ in 0..20 {
            bounds.push(&Bounds::of(Plain, &one.body, &poses[0]));
        }
        bounds.carry(Plain, &own, &carriers, &poses);
        for pose in &poses[count..] {
            bounds.push(&Bounds::of(Plain, &one.body, pose));
        }
        for (number, pose) in poses.iter().enumerate() {
            let alone = Bounds::of(Plain, &one.body, pose);
            assert!((bounds.get(number).box_center - alone.box_center).norm() < 1e-14);
        }
    }
}
