//! The closest points of a cylinder and a cylinder, a box or a segment that has an axis parallel to its own, as of what stands on one floor:
//! the distance along the axis, and that of a disc from a disc, a rectangle or a point across it.
//!
//! A direction proves them, or a depth that the two meet; where neither does, the axes were not parallel enough, or the two touch.

use super::closest::Closest;
use super::core::Core;
use super::placed::PlacedPrimitive;
use super::polytope_distance::cuboid;
use crate::gjk::Support;
use crate::pose::{Vec3, turned, turned_back};
use crate::primitive::{Feature, SmoothKind};
use crate::tolerance;

/// The closest points of two cores with parallel axes, the first of a cylinder, and the unit direction from the second to the first that
/// proves them; zero where they meet. `size` is no less than any coordinate of the two.
#[inline(always)]
pub fn beside_cylinder(
    [on, core]: [&Core; 2],
    other: &PlacedPrimitive,
    size: f64,
) -> Option<(Closest, Vec3)> {
    let cylinder = Cylinder::of(on)?;
    let section = Section::along(&cylinder.axis, core, other)?;
    let prism = Prism::new(section, &cylinder, other)?;
    let along = Along::of(&cylinder, &prism);
    let away = prism.way.norm();
    let outwards = if away > 0.0 {
        prism.way / away
    } else {
        Vec3::zeros()
    };
    // Places on the line from the other's nearest point through the cylinder's axis.
    let gap = away - cylinder.radius - prism.radius;
    let [place, place_other] = if gap > 0.0 {
        [away - cylinder.radius, prism.radius]
    } else {
        let low = (away - cylinder.radius).max(-prism.radius);
        let high = (away + cylinder.radius).min(prism.radius);
        [0.5 * (low + high); 2]
    };
    let points = [
        cylinder.center + cylinder.axis * along.place + outwards * (place - away),
        prism.foot + prism.axis * along.place_other + outwards * place_other,
    ];
    let depth = along.overlap.min(-gap) - 4.0 * tolerance::PARALLEL_AXES * size;
    if depth > tolerance::JUST_INSIDE * size {
        let features = [Feature::surface(), prism.inside()];
        let found = Closest {
            depth,
            ..Closest::meeting_at(points[0], features)
        };
        return Some((found, Vec3::zeros()));
    }
    let way = outwards * gap.max(0.0) + cylinder.axis * along.way;
    let direction = way.try_normalize(0.0)?;
    let slack = tolerance::ON_FEATURE * size;
    let feature = prism.feature_at(&points[1], along.place_other, other, slack);
    let found = Closest::between(points, [Feature::surface(), feature]);
    let lower = direction.dot(&(on.support(&-direction) - core.support(&direction)));
    let is_proved = lower > tolerance::SUPPORT_ERROR * size
        && (found.distance - lower).abs() <= tolerance::CERTIFIED_GAP * size;
    is_proved.then_some((found, direction))
}

pub fn is_cylinder(core: &Core) -> bool {
    Cylinder::of(core).is_some()
}

/// A cylinder, in the common frame.
struct Cylinder {
    center: Vec3,
    axis: Vec3,
    radius: f64,
    half: f64,
}

impl Cylinder {
    #[inline(always)]
    fn of(core: &Core) -> Option<Self> {
        let smooth = core.smooth()?;
        match *smooth.kind {
            SmoothKind::Cylinder {
                radius,
                half_length,
            } => Some(Self {
                center: smooth.center,
                axis: smooth.axes.column(2).into(),
                radius,
                half: half_length,
            }),
            _ => None,
        }
    }
}

/// What is the same all along an axis.
#[derive(Clone, Copy)]
enum Section {
    Disc {
        center: Vec3,
        radius: f64,
        half: f64,
    },
    /// Of a segment; whether its own direction is the axis.
    Point { is_along: bool },
    /// Across this axis of a box.
    Rectangle { across: usize },
}

impl Section {
    /// With the axis in the direction of the cylinder's; `None` where that is not parallel to one.
    #[inline(always)]
    fn along(cylinder: &Vec3, core: &Core, placed: &PlacedPrimitive) -> Option<(Self, Vec3)> {
        if let Some(Cylinder {
            center,
            axis,
            radius,
            half,
        }) = Cylinder::of(core)
        {
            let section = Self::Disc {
                center,
                radius,
                half,
            };
            return Some((section, parallel(axis, cylinder)?));
        }
        if core.smooth().is_some() {
            return None;
        }
        if placed.vertex_count() == 2 {
            let axis = (placed.vertex(1) - placed.vertex(0)).normalize();
            let is_along = axis.dot(cylinder) > 0.0;
            return Some((Self::Point { is_along }, parallel(axis, cylinder)?));
        }
        let cuboid = cuboid(placed)?;
        let seen = turned_back(&cuboid.axes, &placed.turned_back(cylinder));
        let off = seen.abs();
        let others = [off.y.max(off.z), off.z.max(off.x), off.x.max(off.y)];
        let across = others
            .iter()
            .position(|off| *off <= tolerance::PARALLEL_AXES)?;
        let axis = placed.turned(&(cuboid.axes.column(across) * seen[across].signum()));
        Some((Self::Rectangle { across }, axis))
    }
}

/// An axis in the direction of another, if they are parallel.
#[inline(always)]
fn parallel(axis: Vec3, other: &Vec3) -> Option<Vec3> {
    let axis = axis * axis.dot(other).signum();
    ((axis - other).amax() <= tolerance::PARALLEL_AXES).then_some(axis)
}

/// What is beside the cylinder.
struct Prism {
    section: Section,
    /// In the direction of the cylinder's axis.
    axis: Vec3,
    /// Half the length along the axis.
    half: f64,
    /// In the middle of its length, the point nearest to the cylinder's axis; of a disc, its centre.
    foot: Vec3,
    /// From there to the cylinder's axis, across both.
    way: Vec3,
    /// Of a disc; 0 for others.
    radius: f64,
}

impl Prism {
    #[inline(always)]
    fn new(
        (section, axis): (Section, Vec3),
        cylinder: &Cylinder,
        placed: &PlacedPrimitive,
    ) -> Option<Self> {
        let (center, half, radius) = match section {
            Section::Disc {
                center,
                radius,
                half,
            } => (center, half, radius),
            Section::Point { .. } => {
                let (start, end) = (placed.vertex(0), placed.vertex(1));
                ((start + end) * 0.5, 0.5 * (end - start).norm(), 0.0)
            }
            Section::Rectangle { across } => {
                let cuboid = cuboid(placed)?;
                let axes = placed.turned_axes(&cuboid.axes);
                let center = placed.moved(&cuboid.center);
                let mut between = turned_back(&axes, &(cylinder.center - center));
                between[across] = 0.0;
                let foot = between.zip_map(&cuboid.half, |x, half| x.clamp(-half, half));
                return Some(Self {
                    section,
                    axis,
                    half: cuboid.half[across],
                    foot: center + turned(&axes, &foot),
                    way: turned(&axes, &(between - foot)),
                    radius: 0.0,
                });
            }
        };
        let between = cylinder.center - center;
        Some(Self {
            section,
            axis,
            half,
            foot: center,
            way: between - axis * axis.dot(&between),
            radius,
        })
    }

    /// The feature where it and the cylinder meet.
    #[inline(always)]
    fn inside(&self) -> Feature {
        match self.section {
            Section::Disc { .. } => Feature::surface(),
            _ => Feature::interior(),
        }
    }

    /// The feature that holds a point at this place along the axis.
    #[inline(always)]
    fn feature_at(
        &self,
        point: &Vec3,
        place: f64,
        placed: &PlacedPrimitive,
        slack: f64,
    ) -> Feature {
        match self.section {
            Section::Disc { .. } => Feature::surface(),
            Section::Point { .. } if place.abs() < self.half - slack => Feature::edge(0),
            Section::Point { is_along } => Feature::vertex(u32::from((place > 0.0) == is_along)),
            Section::Rectangle { .. } => cuboid(placed).map_or(Feature::interior(), |cuboid| {
                cuboid.feature_at(&cuboid.seen(&placed.seen(point)), slack)
            }),
        }
    }
}

/// The closest places along the axes, from the middle of each.
struct Along {
    place: f64,
    place_other: f64,
    /// From the other's to the cylinder's along its axis; 0 where they overlap: then the places are the middle of what they have in common.
    way: f64,
    /// How far one of them must move along the axis until they do not overlap; negative where they do not.
    overlap: f64,
}

impl Along {
    #[inline(always)]
    fn of(cylinder: &Cylinder, prism: &Prism) -> Self {
        let middle = cylinder.axis.dot(&(prism.foot - cylinder.center));
        let (low, high) = (middle - prism.half, middle + prism.half);
        let half = cylinder.half;
        let (place, way) = if low > half {
            (half, half - low)
        } else if high < -half {
            (-half, -half - high)
        } else {
            (0.5 * (low.max(-half) + high.min(half)), 0.0)
        };
        Self {
            place,
            place_other: (place - middle).clamp(-prism.half, prism.half),
            way,
            overlap: half + prism.half - middle.abs(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use cstk_scenes::Random;

    use super::*;
    use crate::convex::PlacedBuffer;
    use crate::gjk::{DistanceLimits, refined};
    use crate::pose::{Pose, rotation_about};
    use crate::primitive::{Convex, Form, block, convex_polyhedron, cylinder};

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    fn size(random: &mut Random) -> f64 {
        10f64.powf(random.within(-1.5, 0.0))
    }

    fn shape(kind: usize, random: &mut Random) -> Convex {
        match kind {
            0 => cylinder(&Pose::identity(), size(random), size(random)).unwrap(),
            1 => {
                let half = Vec3::from([0; 3].map(|_| size(random)));
                block(&Pose::identity(), &half).unwrap()
            }
            _ => {
                let end = Vec3::z() * size(random);
                convex_polyhedron(&[end, -end]).unwrap()
            }
        }
    }

    /// Cores with parallel axes that are clearly apart are found, as GJK by support points alone has them.
    #[test]
    fn parallel_cores_are_as_far_apart_as_gjk_finds() {
        let random = &mut Random::new(5);
        let (mut found, mut met) = ([0; 3], [0; 3]);
        for round in 0..6000 {
            let kind = round % 3;
            let shapes = [shape(0, random), shape(kind, random)];
            let forms = shapes.each_ref().map(Form::of);
            // Both upright before a common turn; the second may be upside down, and the box on any side.
            let common = rotation_about(&vector(random).normalize(), random.within(0.0, 6.0));
            let over = match kind {
                1 => random.within(0.0, 4.0).floor() * FRAC_PI_2,
                _ => random.within(0.0, 2.0).floor() * PI,
            };
            let turn = rotation_about(&Vec3::z(), random.within(0.0, 6.0))
                * rotation_about(&Vec3::x(), over);
            let poses = [common, common * turn].map(|rotation| Pose {
                rotation,
                translation: vector(random),
            });
            let mut buffers = [PlacedBuffer::default(), PlacedBuffer::default()];
            let [buffer_a, buffer_b] = &mut buffers;
            let a = buffer_a.place(&shapes[0], forms[0].as_ref(), &poses[0]);
            let b = buffer_b.place(&shapes[1], forms[1].as_ref(), &poses[1]);
            let (core_a, core_b) = (Core::of(&a), Core::of(&b));
            let size = 6.0;
            let start = poses[0].translation - poses[1].translation;
            let limits = DistanceLimits::EXACT;
            let search = |a: &Core| {
                let never = f64::NEG_INFINITY;
                refined(a, &core_b, start, size, limits, never, |_, _, _| None).bounds()
            };
            let bounds = search(&core_a);
            let closest = beside_cylinder([&core_a, &core_b], &b, size);
            if bounds.lower < 1e-9 {
                let Some((closest, _)) = closest else {
                    continue;
                };
                assert!(closest.distance < 1e-8);
                met[kind] += 1;
                // They still meet after any shorter move.
                let way = vector(random).normalize() * (0.999 * closest.depth);
                let shifted = Core::shifted(&a, way);
                let moved = search(&shifted);
                assert!(moved.lower == 0.0, "{closest:?} {moved:?}");
                continue;
            }
            let (closest, direction) = closest.expect("parallel axes");
            found[kind] += 1;
            // GJK alone ends at about the square root of rounding where surfaces are round.
            assert!(
                closest.distance > bounds.lower - 1e-13,
                "{closest:?} {bounds:?}"
            );
            assert!(
                closest.distance < bounds.upper + 1e-13,
                "{closest:?} {bounds:?}"
            );
            for (core, point) in [(&core_a, &closest.points[0]), (&core_b, &closest.points[1])] {
                // No direction has the point outside its set.
                for _ in 0..50 {
                    let way = vector(random).normalize();
                    assert!(way.dot(&(core.support(&way) - point)) > -1e-14);
                }
            }
            let off = closest.points[0] - closest.points[1] - direction * closest.distance;
            assert!(off.norm() < 1e-13, "{off:?}");
        }
        assert!(found.iter().all(|count| *count > 500), "{found:?}");
        assert!(met.iter().all(|count| *count > 50), "{met:?}");
    }
}
