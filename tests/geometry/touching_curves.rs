//! Contacts of curved shapes that touch or overlap by a little. Their normal is the direction of the largest signed gap: known where two
//! boundary points face one another on a surface, else compared with all directions around it.

use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::{ContactRecord, QueryContext};

use helpers::closed_sets::Set::{
    self, Ball, Capsule, Cone, Cuboid, Cylinder, Ellipsoid, Points, Sheet,
};
use helpers::closed_sets::{Facing, turn};
use helpers::random::Random;

/// Two sets in one frame, and both in another one.
struct Pair {
    sets: [Set; 2],
    /// Of B in A's frame.
    pose: Pose,
    common: Pose,
    /// The largest coordinate.
    size: f64,
}

impl Pair {
    /// B stands `gap` off A, points and normals of boundaries opposed.
    fn facing(random: &mut Random, sets: [Set; 2], [on_a, on_b]: [Facing; 2], gap: f64) -> Self {
        let spin = rotation_about(&on_a.normal, random.within(-3.0, 3.0));
        let rotation = spin * turn(&on_b.normal, &-on_a.normal);
        let translation = on_a.point + on_a.normal * gap - rotation * on_b.point;
        Self {
            size: sets[0].size().max(translation.norm() + sets[1].size()),
            sets,
            pose: Pose {
                rotation,
                translation,
            },
            common: random.pose(1.0),
        }
    }

    /// The signed gap along a direction from B to A.
    fn gap(&self, n: &Vec3) -> f64 {
        let turned = self.pose.rotation.transpose() * n;
        -n.dot(&self.pose.translation) - self.sets[0].reach(&-n) - self.sets[1].reach(&turned)
    }

    /// The distance, and the contact in A's frame.
    fn asked(&self) -> (f64, Option<ContactRecord>) {
        let [a, b] = [self.sets[0].body(), self.sets[1].body()];
        let there = self.common.compose(&self.pose);
        let mut context = QueryContext::new();
        let found = context
            .pair_distance((&a, &self.common), (&b, &there), f64::INFINITY)
            .unwrap();
        let back = self.common.inverse();
        let contact = found.contact.map(|contact| ContactRecord {
            normal: back.rotation * contact.normal,
            points: contact.points.map(|point| back.transform_point(&point)),
            ..contact
        });
        (found.distance, contact)
    }
}

fn lengths(random: &mut Random, decades: f64) -> Vec3 {
    Vec3::from_fn(|_, _| 10f64.powf(-random.within(0.0, decades)))
}

/// A curved set and a point on a smooth part of its surface, away from rims and the apex.
fn curved(random: &mut Random, decades: f64) -> (Set, Facing) {
    let l = lengths(random, decades);
    let angle = random.within(-3.0, 3.0);
    let around = |radius: f64, z: f64| Vec3::new(radius * angle.cos(), radius * angle.sin(), z);
    let share = random.within(0.1, 0.9);
    let facing = |point, normal: Vec3| Facing {
        point,
        normal: normal.normalize(),
    };
    match random.below(3) {
        0 => (
            Cylinder(l.x, l.y),
            facing(around(l.x, (2.0 * share - 1.0) * l.y), around(1.0, 0.0)),
        ),
        1 => (
            Cone(l.x, l.y),
            facing(
                around(l.x * (1.0 - share), l.y * (share - 0.5)),
                around(l.y, l.x),
            ),
        ),
        _ => {
            let set = Ellipsoid(l);
            let normal = random.unit();
            (set.clone(), facing(set.farthest(&normal), normal))
        }
    }
}

fn any_set(random: &mut Random, kind: usize, decades: f64) -> Set {
    let l = lengths(random, decades);
    match kind {
        0 => Cuboid(l),
        1 => Cylinder(l.x, l.y),
        2 => Cone(l.x, l.y),
        3 => Ellipsoid(l),
        4 => Ball(l.x),
        5 => Capsule(l.x, l.y),
        6 => {
            let corners = 3 + random.below(6);
            Sheet(random.polygon(corners, l.x))
        }
        7 => Points(random.points(2, 1.0)),
        _ => Points(random.points(10, 1.0)),
    }
}

/// Whether a length is the true one, or 0 where that is within the error of smooth distances.
fn is_told(told: f64, truth: f64, size: f64) -> bool {
    (told - truth).abs() <= 1e-13 * size || told == 0.0 && truth.abs() <= 6e-11 * size
}

fn any_gap(random: &mut Random) -> f64 {
    let gap = 10f64.powf(random.within(-17.0, -7.0));
    [gap, -gap, 0.0][random.below(3)]
}

/// What does not hold, by what it is: all of a run is counted, not only the first.
#[derive(Default)]
struct Faults(Vec<(&'static str, String)>);

impl Faults {
    fn check(&mut self, holds: bool, what: &'static str, of: impl FnOnce() -> String) {
        if !holds {
            self.0.push((what, of()));
        }
    }

    fn none(self) {
        let mut kinds: Vec<&str> = self.0.iter().map(|(what, _)| *what).collect();
        kinds.sort_unstable();
        for kind in kinds.chunk_by(|one, other| one == other) {
            let first = self.0.iter().find(|(what, _)| *what == kind[0]);
            println!("{} times: {} {}", kind.len(), kind[0], first.unwrap().1);
        }
        assert!(self.0.is_empty());
    }
}

#[test]
fn contacts_on_smooth_surfaces_have_the_normal_of_the_surface() {
    let random = &mut Random::new(91);
    let mut faults = Faults::default();
    let mut worst = 0.0f64;
    for round in 0..24_000 {
        let decades = [0.3, 1.0][round % 2];
        let kinds = [random.below(3), random.below(9)];
        let (a, on_a) = curved(random, decades);
        let b = any_set(random, kinds[1], decades);
        let on_b = b.facing(random);
        let (normal, gap) = (-on_a.normal, any_gap(random));
        let pair = Pair::facing(random, [a, b], [on_a, on_b], gap);
        let (distance, contact) = pair.asked();
        let text = || {
            format!(
                "{round}: {gap:e} {:?} {:?} {contact:?}",
                pair.sets, pair.pose
            )
        };
        faults.check(is_told(distance, gap.max(0.0), pair.size), "distance", text);
        let Some(contact) = contact else {
            faults.check(false, "no contact", text);
            continue;
        };
        let off = (contact.normal - normal).norm();
        // Of rounded shapes the normal is that of cores apart, which a certificate of their distance D holds to sqrt(2 CERTIFIED_GAP L / D).
        let allowed = match pair.sets[1] {
            Ball(radius) | Capsule(radius, _) => (7.2e-15 * pair.size / radius).sqrt(),
            _ => 1e-10,
        };
        faults.check(off <= allowed, "normal", || {
            format!("{off:e} {allowed:e} {}", text())
        });
        faults.check(
            is_told(contact.clearance, gap, pair.size),
            "clearance",
            text,
        );
        worst = worst.max(off);
    }
    println!("normals are {worst:e} off at most");
    faults.none();
}

/// Rims, edges and corners that are a little inside: no direction around the normal has a larger gap, nor has that of the points that face.
#[test]
fn contacts_have_the_largest_gap_there_is() {
    let random = &mut Random::new(92);
    let mut faults = Faults::default();
    let mut overlaps = 0;
    for round in 0..24_000 {
        let decades = [0.3, 1.0, 3.0][round % 3];
        let kinds = [random.below(3), random.below(9)];
        let a = any_set(random, 1 + kinds[0], decades);
        let b = any_set(random, kinds[1], decades);
        let (on_a, on_b) = (a.facing(random), b.facing(random));
        let (facing, gap) = (-on_a.normal, any_gap(random));
        let mut pair = Pair::facing(random, [a, b], [on_a, on_b], gap);
        let aside = 10f64.powf(random.within(-11.0, -6.0));
        pair.pose.translation += random.unit() * aside * pair.size;
        let (distance, contact) = pair.asked();
        let before = pair.gap(&facing);
        let text = || {
            format!(
                "{round}: {before:e} {:?} {:?} {contact:?}",
                pair.sets, pair.pose
            )
        };
        let Some(contact) = contact else {
            // Some are deeper than a contact may be.
            let is_shallow = before > -0.2e-6 * pair.size;
            faults.check(!is_shallow, "no contact", text);
            continue;
        };
        overlaps += usize::from(contact.clearance < 0.0);
        let own = pair.gap(&contact.normal);
        let text = || format!("{own:e} {}", text());
        faults.check(
            is_told(contact.clearance, own, pair.size),
            "clearance",
            text,
        );
        faults.check(is_told(distance, own.max(0.0), pair.size), "distance", text);
        let mut directions = vec![facing];
        for power in 1..10 {
            for _ in 0..20 {
                let turned = contact.normal + random.unit() * 10f64.powi(-power);
                directions.push(turned.normalize());
            }
        }
        let gaps = directions.iter().map(|direction| pair.gap(direction));
        let most = gaps.fold(f64::NEG_INFINITY, f64::max);
        faults.check(most <= own + 1e-12 * pair.size, "gap", || {
            format!("{most:e} {}", text())
        });
    }
    println!("{overlaps} overlap");
    faults.none();
}

/// The clearance that the bodies have, and a normal of length 1 that has it.
fn check_clearance(sets: [&Set; 2], poses: [[f64; 12]; 2], clearance: f64, error: f64) {
    let poses = poses.map(|rows| Pose::from_row_major(&rows).unwrap());
    let bodies = sets.map(Set::body);
    let mut context = QueryContext::new();
    let places = [(&bodies[0], &poses[0]), (&bodies[1], &poses[1])];
    let found = context
        .pair_distance(places[0], places[1], f64::INFINITY)
        .unwrap();
    let contact = found.contact.unwrap();
    assert!((contact.normal.norm() - 1.0).abs() <= 1e-14, "{contact:?}");
    assert!(
        (contact.clearance - clearance).abs() <= error,
        "{contact:?}"
    );
    let [a, b] = [0, 1].map(|side| {
        let towards = contact.normal * [-1.0, 1.0][side];
        let turned = poses[side].rotation.transpose() * towards;
        towards.dot(&poses[side].translation) + sets[side].reach(&turned)
    });
    assert!(
        (-a - b - clearance).abs() <= error,
        "{} {contact:?}",
        -a - b
    );
}

/// A point at the apex of a cone that is nearly a disc: all normals there are along the axis to within 2e-5.
#[test]
fn normals_at_the_apex_of_a_flat_cone_are_of_length_1() {
    let turn = 1.5890791026847955e-5;
    let cos = 0.999_999_999_873_741_3;
    let height = 2f64.powi(-15);
    let point = Vec3::new(
        -0.0008697509765625,
        -0.0007476806640625,
        -0.0004119873046875,
    );
    let cone = Cone(1.5, height);
    let (x, y, z) = (
        -0.0007476806640625,
        0.00041200112566649696,
        -0.000_854_485_640_586_021_9,
    );
    check_clearance(
        [&Points(vec![point]), &cone],
        [
            [0.0, -1.0, 0.0, x, turn, 0.0, cos, y, -cos, 0.0, turn, z],
            [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        ],
        0.0,
        1e-11,
    );
}

/// Small ellipsoids on the edge of a large triangle: the way out is in the triangle's plane.
#[test]
fn ellipsoids_on_edges_leave_in_the_plane() {
    let triangle = Sheet(vec![Vec3::zeros(), Vec3::x(), Vec3::y()]);
    let (x, y, z) = (2f64.powi(-21), 0.75 * 2f64.powi(-20), 2f64.powi(-19));
    let tilt = 4.226460287246623e-05;
    let cos = 0.999_999_999_106_851_7;
    check_clearance(
        [&Ellipsoid(Vec3::new(x, y, z)), &triangle],
        [
            [
                cos,
                0.0,
                tilt,
                -820.21875,
                0.0,
                1.0,
                0.0,
                -764.000_000_713_311_5,
                -tilt,
                0.0,
                cos,
                305.0,
            ],
            [
                1.0, 0.0, 0.0, -821.0, 0.0, 1.0, 0.0, -764.0, 0.0, 0.0, 1.0, 305.0,
            ],
        ],
        -1.9443e-9,
        1e-12 * 800.0,
    );
}
