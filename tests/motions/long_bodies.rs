//! Long bodies that slide along themselves past another, with thresholds near their distance: the direction between closest points,
//! as they are rounded, tilts over such a length by more than the gap has to spare.

use cstk::body::Body;
use cstk::motion::{MotionOptions, MotionOutcome, PairMotion};
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::query::QueryContext;

use helpers::all_cases;
use helpers::random::Random;

use super::random_scenes::built;

/// More boxes and primitives than any of these motions need.
const WORK: u64 = 10_000;

#[test]
fn few_steps_prove_a_slide_along_a_long_body() {
    let mut random = Random::new(91);
    let mut outcomes = [0; 4];
    for _ in 0..if all_cases() { 50_000 } else { 3000 } {
        let length = 10f64.powf(random.within(0.0, 6.5));
        let mut side = || random.within(0.1, 1.0);
        let (x, y, z, thick) = (side(), side(), side(), side());
        let rod = built(|b| {
            let half = Vec3::new(1.0, length, thick);
            b.add_box(&Pose::IDENTITY, &half, 0).unwrap();
        });
        let other = built(|b| match random.below(3) {
            0 => b.add_box(&Pose::IDENTITY, &Vec3::new(x, y, z), 0).unwrap(),
            1 => b.add_sphere(&Vec3::zeros(), x, 0).unwrap(),
            _ => b.add_cylinder(&Pose::IDENTITY, x, y, 0).unwrap(),
        });
        let resting = random.pose(0.0);
        let tilt = match random.below(3) {
            0 => 0.0,
            _ => 10f64.powf(random.within(-10.0, -6.0)),
        };
        let rotation = rotation_about(&Vec3::x(), tilt);
        let along = match random.below(2) {
            0 => Vec3::y(),
            _ => rotation * Vec3::y(),
        };
        let aside = -Vec3::z() * random.within(2.5, 3.5);
        let [from, to] = [1.0, 3.0].map(|far| random.within(-far, far) * length);
        let at = |place: f64| Pose {
            rotation,
            translation: aside + along * place,
        };
        let (start, end) = (at(from), at(to));
        let between = at(from + random.within(0.0, 1.0) * (to - from));
        let mut context = QueryContext::new();
        let bodies: [&Body; 2] = [&other, &rod];
        let there =
            context.pair_distance((bodies[0], &resting), (bodies[1], &between), f64::INFINITY);
        let distance = there.unwrap().distance;
        let off = [1.0, -1.0][random.below(2)] * 10f64.powf(random.within(-8.0, -3.0));
        if distance == 0.0 {
            continue;
        }
        let options = MotionOptions {
            threshold: distance * (1.0 + off),
            ..MotionOptions::default()
        };
        context.set_limit(Some(WORK));
        let [a, b] = [
            PairMotion {
                body: bodies[0],
                poses: [&resting; 2],
            },
            PairMotion {
                body: bodies[1],
                poses: [&start, &end],
            },
        ];
        let found = context.pair_motion(&a, &b, &options).unwrap();
        let outcome = match found.outcome {
            MotionOutcome::Free => 0,
            MotionOutcome::Hit => 1,
            MotionOutcome::Near => 2,
            MotionOutcome::Undecided => 3,
        };
        outcomes[outcome] += 1;
        assert!(outcome < 3, "{length} {tilt:e} {off:e} {found:?}");
    }
    println!("free, hit, near, undecided: {outcomes:?}");
    assert!(outcomes[0] > 100 && outcomes[1] > 300, "{outcomes:?}");
}

/// A thin plate that lies askew beside an edge of 2e6: by the direction between closest points alone no interval longer than 1e-10 of the
/// motion was proved.
#[test]
fn an_edge_of_two_million_beside_a_plate() {
    let block = |half: [f64; 3]| {
        built(|b| {
            b.add_box(&Pose::IDENTITY, &Vec3::from(half), 0).unwrap();
        })
    };
    let plate = block([0.0001, 1.9548996569445445, 1.0]);
    let rod = block([2.0, 1e6, 0.36978223914696884]);
    let askew = Pose {
        rotation: Mat3::new(
            0.22006881190097782,
            -0.962_888_775_801_229_4,
            -0.15625275506211783,
            -0.17146649701243627,
            0.119_502_418_879_638_2,
            -0.977_915_340_039_310_4,
            0.960_296_286_794_225_1,
            0.24200077958123534,
            -0.13880441005709498,
        ),
        translation: Vec3::zeros(),
    };
    let tilt = 2.541778979937228e-09;
    let at = |y: f64| Pose {
        rotation: Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, -tilt, 0.0, tilt, 1.0),
        translation: Vec3::new(-2.254_629_226_454_368, y, -1.5365082849759963),
    };
    let (start, end) = (at(839_821.583_509_794), at(-4_816_058.121_613_95));
    let mut context = QueryContext::new();
    for shorter in [0.0, 1e-9, 1e-7, 1e-6, 1e-4] {
        let options = MotionOptions {
            threshold: 1.0207988012743137 - shorter,
            ..MotionOptions::default()
        };
        context.set_limit(Some(WORK));
        let [a, b] = [
            PairMotion {
                body: &plate,
                poses: [&askew; 2],
            },
            PairMotion {
                body: &rod,
                poses: [&start, &end],
            },
        ];
        let found = context.pair_motion(&a, &b, &options).unwrap();
        assert_ne!(
            found.outcome,
            MotionOutcome::Undecided,
            "{shorter:e} {found:?}"
        );
    }
}
