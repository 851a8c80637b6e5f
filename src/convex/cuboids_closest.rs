//! The closest points of two boxes by the separating axis test: of the axes the one with the largest gap proves the distance
//! where the nearest features are a corner and a face, or two edges. Boxes with parallel axes have a closed form; GJK finds the others.

use super::closest::Closest;
use super::cuboid_axes::{CuboidAxes, EdgeGap, GAP_ERROR};
use super::parallel_cuboids::{parallel_closest, parallel_touching};
use super::placed::PlacedPrimitive;
use super::segment::{Segment, closest_parameters};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::{Vec3, turned, turned_back};
use crate::primitive::{Cuboid, Feature};
use crate::tolerance;

/// The closest points of two boxes.
pub enum CuboidsClosest {
    /// They are farther apart than the cutoff.
    Beyond,
    Found(Closest),
    /// The axes do not tell.
    Unknown {
        /// A guess of the direction from B to A, not a unit vector.
        direction: Vec3,
        /// Features that they may touch at.
        features: Option<[Feature; 2]>,
    },
}

/// `size` is no less than any coordinate of the two.
pub fn cuboids_closest(
    placed: [&PlacedPrimitive; 2],
    cuboids: [&Cuboid; 2],
    size: f64,
    cutoff: f64,
) -> CuboidsClosest {
    with_widest(Search {
        placed,
        cuboids,
        size,
        cutoff,
    })
}

struct Search<'a> {
    placed: [&'a PlacedPrimitive<'a>; 2],
    cuboids: [&'a Cuboid; 2],
    size: f64,
    cutoff: f64,
}

/// The axis with the largest gap.
#[derive(Clone, Copy)]
enum Axis {
    /// The normal of A's faces across this axis.
    FaceOfA(usize),
    FaceOfB(usize),
    /// The cross product of an axis of each.
    Edges(usize, usize),
}

/// The cross product of edges less steep to one another than this is too inaccurate an axis.
const MIN_EDGE_CROSS: f64 = 0.01;

impl Work for Search<'_> {
    type Output = CuboidsClosest;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> CuboidsClosest {
        let axes = CuboidAxes::new(self.placed, self.cuboids);
        let error = GAP_ERROR * self.size;
        let (mut largest, mut axis) = (f64::NEG_INFINITY, Axis::FaceOfA(0));
        let (of_a, of_b) = (axes.gaps_at_a(), axes.gaps_at_b());
        for k in 0..3 {
            if of_a[k] > largest {
                (largest, axis) = (of_a[k], Axis::FaceOfA(k));
            }
            if of_b[k] > largest {
                (largest, axis) = (of_b[k], Axis::FaceOfB(k));
            }
        }
        if largest > self.cutoff + error {
            return CuboidsClosest::Beyond;
        }
        let of_faces = (largest, axis);
        // The overlap along each axis is at least this; nearly parallel edges separate hardly better than faces do.
        let mut overlap = -largest - error - 8.0 * tolerance::PARALLEL_EDGES * self.size;
        for i in 0..3 {
            for j in 0..3 {
                let EdgeGap { gap, length } = axes.edge_gap(i, j);
                if length < tolerance::PARALLEL_EDGES {
                    continue;
                }
                let inverse = 1.0 / length;
                overlap = overlap.min((-gap - error) * inverse);
                if gap * inverse > largest {
                    (largest, axis) = (gap * inverse, Axis::Edges(i, j));
                }
            }
        }
        let found = if overlap > tolerance::JUST_INSIDE * self.size {
            self.common(&axes, overlap)
        } else if largest > error {
            if let Some(points) = parallel_closest(&axes, self.size) {
                return CuboidsClosest::Found(self.at(points));
            }
            match axis {
                Axis::FaceOfA(k) => self.on_face_of_a(&axes, k),
                Axis::FaceOfB(k) => self.on_face_of_b(&axes, k),
                Axis::Edges(i, j) => self.between_edges(&axes, i, j),
            }
        } else {
            None
        };
        match found {
            Some(found) => CuboidsClosest::Found(found),
            None => {
                // Where axes are parallel, edges are across a face's axis too.
                let touching = match largest <= of_faces.0 + error {
                    true => of_faces.1,
                    false => axis,
                };
                CuboidsClosest::Unknown {
                    direction: self.direction(&axes, axis),
                    features: self.touching_features(&axes, touching, largest),
                }
            }
        }
    }
}

impl Search<'_> {
    /// Boxes that overlap by `depth`, if a point of both is found: of one box the point nearest to the other's centre.
    #[inline(always)]
    fn common(&self, axes: &CuboidAxes, depth: f64) -> Option<Closest> {
        let clamped =
            |point: &Vec3, half: &Vec3| point.zip_map(half, |x, half| x.clamp(-half, half));
        let holds = |half: &Vec3, point: &Vec3| {
            (point.x.abs() < half.x) & (point.y.abs() < half.y) & (point.z.abs() < half.z)
        };
        let of_a = clamped(&axes.between, &axes.half_a);
        let seen = turned_back(&axes.turn, &of_a) - axes.seen_by_b;
        let common = if holds(&axes.half_b, &seen) {
            of_a
        } else {
            let of_b = clamped(&-axes.seen_by_b, &axes.half_b);
            let of_b = axes.between + turned(&axes.turn, &of_b);
            holds(&axes.half_a, &of_b).then_some(of_b)?
        };
        let (a, on_a) = (self.placed[0], self.cuboids[0]);
        let common = a.moved(&(on_a.center + turned(&on_a.axes, &common)));
        Some(Closest {
            depth,
            ..Closest::meeting_at(common, [Feature::interior(); 2])
        })
    }

    /// Two points, each in its own box's frame.
    #[inline(always)]
    fn at(&self, seen: [Vec3; 2]) -> Closest {
        let point = |side: usize| {
            let cuboid = self.cuboids[side];
            self.placed[side].moved(&(cuboid.center + turned(&cuboid.axes, &seen[side])))
        };
        Closest::between([point(0), point(1)], self.features_at(&seen))
    }

    /// The features that hold two points, each in its own box's frame.
    #[inline(always)]
    fn features_at(&self, seen: &[Vec3; 2]) -> [Feature; 2] {
        let slack = GAP_ERROR * self.size;
        [0, 1].map(|side| self.cuboids[side].feature_at(&seen[side], slack))
    }

    #[inline(always)]
    fn on_face_of_a(&self, axes: &CuboidAxes, k: usize) -> Option<Closest> {
        let (is_high, corner) = self.corner_at_a(axes, k)?;
        self.over_face(0, k, is_high, corner)
    }

    #[inline(always)]
    fn on_face_of_b(&self, axes: &CuboidAxes, k: usize) -> Option<Closest> {
        let (is_high, corner) = self.corner_at_b(axes, k)?;
        Some(self.over_face(1, k, is_high, corner)?.swapped())
    }

    /// Which of A's faces across an axis is towards B, and B's corner that is nearest to its plane, if one alone is.
    #[inline(always)]
    fn corner_at_a(&self, axes: &CuboidAxes, k: usize) -> Option<(bool, u32)> {
        let is_high = axes.between[k] > 0.0;
        let outward = if is_high { 1.0 } else { -1.0 };
        let row = Vec3::new(axes.turn[(k, 0)], axes.turn[(k, 1)], axes.turn[(k, 2)]);
        Some((is_high, self.cuboids[1].corner_towards(&(row * -outward))?))
    }

    /// The same with A and B swapped.
    #[inline(always)]
    fn corner_at_b(&self, axes: &CuboidAxes, k: usize) -> Option<(bool, u32)> {
        let is_high = axes.seen_by_b[k] < 0.0;
        let outward = if is_high { 1.0 } else { -1.0 };
        let column = Vec3::new(axes.turn[(0, k)], axes.turn[(1, k)], axes.turn[(2, k)]);
        Some((
            is_high,
            self.cuboids[0].corner_towards(&(column * -outward))?,
        ))
    }

    /// The edges that are farthest along the cross product of their directions, each towards the other box.
    #[inline(always)]
    fn edges_across(&self, axes: &CuboidAxes, i: usize, j: usize) -> Option<[Feature; 2]> {
        let across = axes.across_edges(i, j);
        Some([
            self.cuboids[0].edge_towards(i, &across)?,
            self.cuboids[1].edge_towards(j, &-turned_back(&axes.turn, &across))?,
        ])
    }

    /// Features that the boxes may touch at, if they are just inside one another along the axis with the largest gap.
    fn touching_features(
        &self,
        axes: &CuboidAxes,
        axis: Axis,
        largest: f64,
    ) -> Option<[Feature; 2]> {
        if largest < -2.0 * tolerance::JUST_INSIDE * self.size {
            return None;
        }
        let level = match axis {
            Axis::FaceOfA(k) => parallel_touching(axes, (0, k), self.size),
            Axis::FaceOfB(k) => parallel_touching(axes, (1, k), self.size),
            Axis::Edges(..) => None,
        };
        match level {
            Some(points) => Some(self.features_at(&points)),
            None => self.features_across(axes, axis),
        }
    }

    /// The features that face one another along an axis.
    fn features_across(&self, axes: &CuboidAxes, axis: Axis) -> Option<[Feature; 2]> {
        match axis {
            Axis::FaceOfA(k) => {
                let (is_high, corner) = self.corner_at_a(axes, k)?;
                Some([
                    self.cuboids[0].face_across(k, is_high),
                    Feature::vertex(corner),
                ])
            }
            Axis::FaceOfB(k) => {
                let (is_high, corner) = self.corner_at_b(axes, k)?;
                Some([
                    Feature::vertex(corner),
                    self.cuboids[1].face_across(k, is_high),
                ])
            }
            Axis::Edges(i, j) => self.edges_across(axes, i, j),
        }
    }

    /// A corner of the other box over the face of one box: the face's normal proves the distance, since no corner of the other
    /// lies farther back. `None` where the foot is not well inside the face.
    #[inline(always)]
    fn over_face(&self, side: usize, axis: usize, is_high: bool, corner: u32) -> Option<Closest> {
        let (placed, cuboid) = (self.placed[side], self.cuboids[side]);
        let point = self.placed[1 - side].vertex(corner);
        let seen = cuboid.seen(&placed.seen(&point));
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let error = GAP_ERROR * self.size;
        let is_inside = |k: usize| seen[k].abs() < cuboid.half[k] - error;
        if !is_inside(next) || !is_inside(last) {
            return None;
        }
        let face = cuboid.face_across(axis, is_high);
        let normal = placed.normal(face.index as usize);
        let ring = &placed.shape.faces[face.index as usize].vertices;
        let height = normal.dot(&(point - placed.vertex(ring[0])));
        (height > error).then(|| Closest {
            distance: height,
            ..Closest::between(
                [point - normal * height, point],
                [face, Feature::vertex(corner)],
            )
        })
    }

    #[inline(always)]
    fn between_edges(&self, axes: &CuboidAxes, i: usize, j: usize) -> Option<Closest> {
        let edges = self.edges_across(axes, i, j)?;
        let segment = |side: usize| {
            let placed = self.placed[side];
            placed.edge_ends(placed.shape.edges[edges[side].index as usize])
        };
        let (ends_a, ends_b) = (segment(0), segment(1));
        let (along_a, along_b) = (ends_a.1 - ends_a.0, ends_b.1 - ends_b.0);
        let normal = along_a.cross(&along_b);
        let length = normal.norm();
        if length < MIN_EDGE_CROSS * along_a.norm() * along_b.norm() {
            return None;
        }
        let (on_a, on_b) = (Segment::new(ends_a), Segment::new(ends_b));
        let (s, t) = closest_parameters(&on_a, &on_b);
        let is_between = |t: f64| t > 0.0 && t < 1.0;
        if !is_between(s) || !is_between(t) {
            return None;
        }
        let found = Closest::between([on_a.at(s), on_b.at(t)], edges);
        let gap = normal.dot(&(ends_b.0 - ends_a.0)).abs() / length;
        ((found.distance - gap).abs() <= tolerance::CERTIFIED_GAP * self.size).then_some(found)
    }

    /// The direction from B to A along an axis, in the pair's frame.
    fn direction(&self, axes: &CuboidAxes, axis: Axis) -> Vec3 {
        let (a, on_a) = (self.placed[0], self.cuboids[0]);
        let towards_b = match axis {
            Axis::FaceOfA(k) => Vec3::from(std::array::from_fn(|i| {
                if i == k {
                    axes.between[k].signum()
                } else {
                    0.0
                }
            })),
            Axis::FaceOfB(k) => axes.turn.column(k) * axes.seen_by_b[k].signum(),
            Axis::Edges(i, j) => axes.across_edges(i, j),
        };
        -a.turned(&turned(&on_a.axes, &towards_b))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use cstk_scenes::Random;

    use super::*;
    use crate::convex::{PlacedBuffer, mode_of};
    use crate::pose::{Pose, rotation_about};
    use crate::primitive::{Form, block};

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    fn half(random: &mut Random, spread: f64) -> Vec3 {
        Vec3::from([0; 3].map(|_| 10f64.powf(random.within(-spread, 0.0))))
    }

    fn pose(random: &mut Random, reach: f64) -> Pose {
        let axis = vector(random).normalize();
        Pose {
            rotation: rotation_about(&axis, random.within(0.0, 6.0)),
            translation: vector(random) * reach,
        }
    }

    /// A box around the origin of a frame.
    struct Block {
        half: Vec3,
        pose: Pose,
    }

    impl Block {
        fn nearest(&self, point: &Vec3) -> Vec3 {
            let seen = self.pose.inverse().transform_point(point);
            let clamped = seen.zip_map(&self.half, |x, half| x.clamp(-half, half));
            self.pose.transform_point(&clamped)
        }

        fn corners(&self) -> impl Iterator<Item = Vec3> {
            (0..8).map(|bits| {
                let sign = |k: usize| if bits >> k & 1 == 0 { -1.0 } else { 1.0 };
                let signs = Vec3::new(sign(0), sign(1), sign(2));
                self.pose.transform_point(&self.half.component_mul(&signs))
            })
        }
    }

    /// What is found, whose points and distance prove themselves.
    fn closest(a: &Block, b: &Block) -> Option<Closest> {
        let [shape_a, shape_b] = [a, b].map(|one| block(&Pose::identity(), &one.half).unwrap());
        let forms = [&shape_a, &shape_b].map(|shape| Form::of(shape).unwrap());
        let mut buffers = [PlacedBuffer::default(), PlacedBuffer::default()];
        let [buffer_a, buffer_b] = &mut buffers;
        let placed_a = buffer_a.place(&shape_a, Some(&forms[0]), &a.pose);
        let placed_b = buffer_b.place(&shape_b, Some(&forms[1]), &b.pose);
        let cuboids = [forms[0].cuboid().unwrap(), forms[1].cuboid().unwrap()];
        let CuboidsClosest::Found(found) =
            cuboids_closest([&placed_a, &placed_b], cuboids, 5.0, f64::INFINITY)
        else {
            return None;
        };
        let [on_a, on_b] = found.points;
        assert!((a.nearest(&on_a) - on_a).norm() < 1e-14);
        assert!((b.nearest(&on_b) - on_b).norm() < 1e-14);
        if found.distance > 0.0 {
            assert!(((on_a - on_b).norm() - found.distance).abs() < 1e-14);
            let direction = (on_a - on_b) / found.distance;
            let from_a = a.corners().map(|p| direction.dot(&p));
            let from_b = b.corners().map(|p| direction.dot(&p));
            let gap =
                from_a.fold(f64::INFINITY, f64::min) - from_b.fold(f64::NEG_INFINITY, f64::max);
            // The direction is off by the points' rounding over their distance.
            let rounding = 1e-14 + 4e-15 / found.distance;
            assert!((gap - found.distance).abs() < rounding, "{gap} {found:?}");
        }
        Some(found)
    }

    /// Alternating projections come to a point of both sets where there is one.
    fn meet(a: &Block, b: &Block) -> bool {
        let mut point = a.pose.translation;
        (0..100_000).any(|_| {
            let on_b = b.nearest(&point);
            point = a.nearest(&on_b);
            (point - on_b).norm() < 1e-9
        })
    }

    /// The points lie in the boxes, and the direction between them parts all corners by their distance: no other points are nearer.
    /// Boxes that overlap by a depth still do after a shorter move in any direction.
    #[test]
    fn points_and_depths_prove_themselves() {
        let (mut apart, mut overlaps, mut all) = (0, 0, 0);
        for spread in [0.0, 0.5, 2.0] {
            let random = &mut Random::new(7);
            for _ in 0..3000 {
                let pose = pose(random, 1.5);
                let a = Block {
                    half: half(random, spread),
                    pose: Pose::identity(),
                };
                let b = Block {
                    half: half(random, spread),
                    pose,
                };
                all += 1;
                let Some(found) = closest(&a, &b) else {
                    continue;
                };
                let [on_a, on_b] = found.points;
                if found.distance > 0.0 {
                    apart += 1;
                } else if overlaps < 300 {
                    overlaps += 1;
                    assert_eq!(on_a, on_b);
                    for _ in 0..5 {
                        let step = vector(random).normalize() * (0.999 * found.depth);
                        let moved = Block {
                            half: b.half,
                            pose: Pose {
                                translation: b.pose.translation + step,
                                ..b.pose
                            },
                        };
                        assert!(meet(&a, &moved), "{found:?}");
                    }
                }
            }
        }
        assert!(
            apart > 1000 && overlaps == 300,
            "{apart} {overlaps} of {all}"
        );
    }
    /// Boxes with parallel axes are all told apart by what proves itself, and have a contact: those that stand on one floor, and those
    /// turned by quarters.
    #[test]
    fn boxes_with_parallel_axes_are_found() {
        let random = &mut Random::new(11);
        let (mut modes, mut apart) = ([0; 6], 0);
        for round in 0..20_000 {
            let quarter = |random: &mut Random| random.within(0.0, 4.0).floor() * FRAC_PI_2;
            let turn = |random: &mut Random| match round % 2 {
                0 => rotation_about(&Vec3::z(), random.within(0.0, 6.0)),
                _ => [Vec3::x(), Vec3::y(), Vec3::z()]
                    .iter()
                    .map(|axis| rotation_about(axis, quarter(random)))
                    .product(),
            };
            // Half of them are on a grid, so that faces are level and edges flush.
            let on_grid = |v: Vec3| match round / 2 % 2 {
                0 => v,
                _ => (v * 4.0).map(f64::round) / 4.0,
            };
            let mut block = || Block {
                half: on_grid(half(random, 1.0)).sup(&Vec3::repeat(0.1)),
                pose: Pose {
                    rotation: turn(random),
                    translation: on_grid(vector(random) * 1.5),
                },
            };
            let (a, b) = (block(), block());
            let seen = |corner: &Vec3| b.pose.inverse().transform_point(corner);
            let found = closest(&a, &b);
            // Apart by more than rounding along an axis of one of them.
            let gap_at = |one: &Block, other: &Block| {
                let seen = |p: Vec3| one.pose.inverse().transform_point(&p);
                (0..3).fold(f64::NEG_INFINITY, |most, k| {
                    let (low, high) = other
                        .corners()
                        .map(|p| seen(p)[k])
                        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                            (low.min(x), high.max(x))
                        });
                    most.max(low - one.half[k]).max(-one.half[k] - high)
                })
            };
            if gap_at(&a, &b).max(gap_at(&b, &a)) < 1e-12 {
                continue;
            }
            apart += 1;
            let found = found.unwrap_or_else(|| panic!("{:?} {:?}", a.half, seen(&a.half)));
            modes[mode_of(found.features).expect("a contact mode") as usize] += 1;
        }
        assert!(
            apart > 10_000 && modes.iter().all(|count| *count > 100),
            "{apart} {modes:?}"
        );
    }
}
