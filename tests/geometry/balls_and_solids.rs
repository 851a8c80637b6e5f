//! Pairs of a sphere and a box, cylinder or cone, which have a path of their own: against the point of the solid that is nearest to the
//! centre, and against the list of witnesses, which takes the path of all primitives.

use cstk::body::{Body, BodyBuilder};
use cstk::pose::{Pose, Vec3};
use cstk::query::{ContactRecord, Distance, QueryContext};
use helpers::models::built;
use helpers::random::Random;

/// A solid around the origin of `frame`, which is a pose in its body.
struct Solid {
    body: Body,
    frame: Pose,
    kind: Kind,
    /// Added around it.
    radius: f64,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Box(Vec3),
    Cylinder { radius: f64, half: f64 },
    Cone { radius: f64, height: f64 },
}

impl Solid {
    fn drawn(random: &mut Random) -> Self {
        let far = [0.0, 1.0, 1e3][random.below(3)];
        let frame = Pose {
            rotation: match random.below(2) {
                0 => random.rotation(),
                _ => Pose::identity().rotation,
            },
            translation: random.point(far),
        };
        let mut side = || 10f64.powf(random.within(-2.0, 0.0));
        let (x, y, z) = (side(), side(), side());
        let kind = match random.below(3) {
            0 => Kind::Box(Vec3::new(x, y, z)),
            1 => Kind::Cylinder { radius: x, half: z },
            _ => Kind::Cone {
                radius: x,
                height: z,
            },
        };
        let mut builder = BodyBuilder::new(3).unwrap();
        let mut around = 0.0;
        let added = match kind {
            Kind::Box(half) if random.below(3) == 0 => {
                around = 0.3 * half.min();
                let corner = |i: u32| {
                    let sign = Vec3::from_fn(|k, _| if i >> k & 1 == 1 { 1.0 } else { -1.0 });
                    frame.transform_point(&half.component_mul(&sign))
                };
                let corners: Vec<Vec3> = (0..8).map(corner).collect();
                builder.add_rounded_polyhedron(&corners, around, 9)
            }
            Kind::Box(half) => builder.add_box(&frame, &half, 9),
            Kind::Cylinder { radius, half } => builder.add_cylinder(&frame, radius, half, 9),
            Kind::Cone { radius, height } => builder.add_cone(&frame, radius, height, 9),
        };
        added.unwrap();
        Self {
            body: built(&builder, &Default::default()),
            frame,
            kind,
            radius: around,
        }
    }

    /// The point of the core nearest to a point, both in the solid's own frame; the point itself where it is in the core.
    fn nearest(&self, p: &Vec3) -> Vec3 {
        match self.kind {
            Kind::Box(half) => p.zip_map(&half, |x, h| x.min(h).max(-h)),
            Kind::Cylinder { radius, half } => {
                let away = p.x.hypot(p.y);
                let part = if away > radius { radius / away } else { 1.0 };
                Vec3::new(p.x * part, p.y * part, p.z.min(half).max(-half))
            }
            Kind::Cone { radius, height } => {
                let away = p.x.hypot(p.y);
                let width = |z: f64| radius * (0.5 - z / height);
                if p.z.abs() <= 0.5 * height && away <= width(p.z) {
                    return *p;
                }
                // In the half plane through the axis and the point: the base, and the side from its rim to the apex.
                let base = (away.min(radius), -0.5 * height);
                let (along, up) = (-radius, height);
                let place = ((away - radius) * along + (p.z + 0.5 * height) * up)
                    / (along * along + up * up);
                let place = place.clamp(0.0, 1.0);
                let side = (radius + along * place, up * place - 0.5 * height);
                let off = |(r, z): (f64, f64)| (away - r).hypot(p.z - z);
                let (r, z) = if off(base) <= off(side) { base } else { side };
                let part = if away > 0.0 { r / away } else { 0.0 };
                Vec3::new(p.x * part, p.y * part, z)
            }
        }
    }

    /// A point of the core's surface, or in it, in its own frame.
    fn some_point(&self, random: &mut Random) -> Vec3 {
        self.nearest(&random.point(2.0))
    }
}

/// A sphere and a solid, and a pose for each.
struct Case {
    solid: Solid,
    ball: Body,
    center: Vec3,
    radius: f64,
    /// Of the sphere and of the solid.
    poses: [Pose; 2],
    /// The largest coordinate on the way.
    largest: f64,
}

impl Case {
    /// The centre goes as far from the core as the radii and a gap, if it is outside.
    fn drawn(random: &mut Random) -> Self {
        let solid = Solid::drawn(random);
        let radius = 10f64.powf(random.within(-2.0, 0.0));
        let far = [0.0, 1.0, 1e3][random.below(3)];
        let center = random.point(far);
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_sphere(&center, radius, 7).unwrap();
        let size = 10f64.powf(random.within(-14.0, 0.0));
        let clear = 10f64.powf(random.within(-3.0, 0.3));
        let away = match random.below(6) {
            0 => size,
            1 => size * radius,
            2 => radius + solid.radius - size * radius,
            3 => radius + solid.radius + size,
            _ => radius + solid.radius + clear,
        };
        let on = solid.some_point(random);
        let outwards = match random.below(3) {
            0 => random.unit(),
            1 => (on + Vec3::repeat(1e-3)).normalize(),
            _ => [Vec3::x(), Vec3::y(), Vec3::z()][random.below(3)],
        };
        let far = [1.0, 1e4][random.below(2)];
        let at = random.pose(far);
        let (turn, aligned) = (random.rotation(), random.below(2) == 0);
        let goal = at.transform_point(&solid.frame.transform_point(&(on + outwards * away)));
        let rotation = if aligned { at.rotation } else { turn };
        let placed = Pose {
            rotation,
            translation: goal - rotation * center,
        };
        let largest = at.translation.norm() + solid.frame.translation.norm() + center.norm() + 4.0;
        Self {
            solid,
            ball: built(&builder, &Default::default()),
            center,
            radius,
            poses: [placed, at],
            largest,
        }
    }

    /// The distance of the centre from the core, and the core's nearest point in the world.
    fn truth(&self) -> (f64, Vec3) {
        let to_world = self.poses[1].compose(&self.solid.frame);
        let center = self.poses[0].transform_point(&self.center);
        let local = to_world.rotation.transpose() * (center - to_world.translation);
        let nearest = self.solid.nearest(&local);
        ((local - nearest).norm(), to_world.transform_point(&nearest))
    }

    fn distance(&self, query: &mut QueryContext, is_ball_first: bool) -> Distance {
        let ball = (&self.ball, &self.poses[0]);
        let solid = (&self.solid.body, &self.poses[1]);
        let (a, b) = match is_ball_first {
            true => (ball, solid),
            false => (solid, ball),
        };
        query.pair_distance(a, b, f64::INFINITY).unwrap()
    }
}

#[test]
fn balls_are_as_far_from_solids_as_their_centres_less_their_radii() {
    let mut random = Random::new(93);
    let mut query = QueryContext::new();
    let (mut met, mut contacts) = (0, 0);
    for number in 0..12_000 {
        let case = Case::drawn(&mut random);
        let (core, on_core) = case.truth();
        let signed = core - case.radius - case.solid.radius;
        // Gaps up to the error of a distance, with that of where the primitives are in their bodies, count as 0.
        let rounding = case.largest
            * match case.solid.kind {
                Kind::Box(_) => 1e-13,
                Kind::Cylinder { .. } | Kind::Cone { .. } => 1e-11,
            };
        let is_ball_first = random.below(2) == 0;
        let found = case.distance(&mut query, is_ball_first);
        let about = format!("{number} {:?} {signed} {found:?}", case.solid.kind);
        assert!(
            (found.distance - signed.max(0.0)).abs() <= rounding,
            "{about}"
        );
        assert!(found.lower <= signed.max(0.0) + rounding, "{about}");
        assert!(found.upper >= signed - rounding, "{about}");
        let [ball, solid] = match is_ball_first {
            true => [0, 1],
            false => [1, 0],
        };
        let center = case.poses[0].transform_point(&case.center);
        // What rounding does to a direction is as much more as the points are nearer.
        let turned = rounding * (1.0 + (case.radius + case.solid.radius) / core.max(1e-300));
        if core > 1e-9 * case.largest && found.distance > 0.0 {
            let way = (center - on_core) / core;
            let off = found.points[ball] - (center - way * case.radius);
            assert!(off.norm() <= 4.0 * turned, "{about}");
            let off = found.points[solid] - (on_core + way * case.solid.radius);
            assert!(off.norm() <= 4.0 * turned, "{about}");
        }
        if let Some(contact) = &found.contact
            && core > 1e-3
        {
            contacts += 1;
            let way = (center - on_core) / core;
            let normal = if ball == 0 {
                contact.normal
            } else {
                -contact.normal
            };
            assert!((normal - way).norm() <= 1e-9 * case.largest, "{about}");
            assert!((contact.clearance - signed).abs() <= rounding, "{about}");
        }
        met += usize::from(found.distance == 0.0);
        let mut within = |threshold: f64| {
            let (a, b) = (
                (&case.ball, &case.poses[0]),
                (&case.solid.body, &case.poses[1]),
            );
            let (a, b) = if is_ball_first { (a, b) } else { (b, a) };
            query.pair_within(a, b, threshold).unwrap()
        };
        assert_eq!(within(0.0), found.distance == 0.0, "{about}");
        assert!(within(found.lower) && within(found.upper), "{about}");
        if found.distance > 0.0 {
            assert!(!within(found.lower.next_down()), "{about}");
        }
    }
    assert!(
        (3000..9000).contains(&met) && contacts > 2000,
        "{met} {contacts}"
    );
}

/// The same bits, contacts and features.
#[test]
fn balls_and_solids_have_the_bits_of_their_witness_list() {
    let mut random = Random::new(94);
    let mut query = QueryContext::new();
    let mut contacts = 0;
    for number in 0..12_000 {
        let case = Case::drawn(&mut random);
        let is_ball_first = random.below(2) == 0;
        if case.truth().0 < 1e-11 * case.largest {
            // Nothing of their own: the centre is in the core.
            continue;
        }
        let found = case.distance(&mut query, is_ball_first);
        let (a, b) = (
            (&case.ball, &case.poses[0]),
            (&case.solid.body, &case.poses[1]),
        );
        let (a, b) = if is_ball_first { (a, b) } else { (b, a) };
        let list = query.pair_witnesses(a, b, f64::INFINITY, 1).unwrap();
        assert_eq!(found.distance, list.witnesses[0].distance, "{number}");
        let all = |c: &ContactRecord| {
            let places = [c.points[0], c.points[1], c.normal];
            (places, [c.distance, c.clearance], c.mode, c.features)
        };
        assert_eq!(
            found.contact.as_ref().map(all),
            list.contacts.first().map(all),
            "{number} {found:?}"
        );
        contacts += usize::from(found.contact.is_some());
    }
    assert!(contacts > 4000, "{contacts}");
}

/// A ball whose centre is in the face of a solid has the face's normal as its contact, or none where it is so large that a millionth of it
/// is as large as the solid.
#[test]
fn balls_in_the_middle_of_a_face_have_its_normal_or_none() {
    let solids: [fn(&mut BodyBuilder); 3] = [
        |builder| {
            builder
                .add_cylinder(&Pose::identity(), 1.0, 0.5, 0)
                .unwrap()
        },
        |builder| {
            builder
                .add_ellipsoid(&Pose::identity(), &Vec3::new(1.0, 1.0, 0.5), 0)
                .unwrap()
        },
        |builder| {
            builder
                .add_box(&Pose::identity(), &Vec3::new(1.0, 1.0, 0.5), 0)
                .unwrap()
        },
    ];
    for (kind, solid) in solids.into_iter().enumerate() {
        let made = |add: &dyn Fn(&mut BodyBuilder)| {
            let mut builder = BodyBuilder::new(3).unwrap();
            add(&mut builder);
            built(&builder, &Default::default())
        };
        let solid = made(&solid);
        for exponent in -1..9 {
            let radius = 10f64.powi(exponent);
            let ball = made(&|builder| builder.add_sphere(&Vec3::zeros(), radius, 0).unwrap());
            let at = Pose::from_translation(Vec3::new(0.1, -0.2, 0.5));
            let at = match kind {
                1 => Pose::from_translation(Vec3::new(0.0, 0.0, 0.5)),
                _ => at,
            };
            let mut query = QueryContext::new();
            let found = query
                .pair_distance((&solid, &Pose::identity()), (&ball, &at), f64::INFINITY)
                .unwrap();
            assert_eq!(found.distance, 0.0);
            let Some(contact) = found.contact else {
                assert!(radius > 500.0, "{kind} {radius}");
                continue;
            };
            assert!(
                (contact.normal + Vec3::z()).norm() < 1e-6,
                "{kind} {radius} {}",
                contact.normal
            );
            assert!(
                (contact.clearance + radius).abs() < 1e-10 * radius.max(1.0),
                "{kind} {radius}"
            );
        }
    }
}
