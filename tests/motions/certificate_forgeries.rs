//! Certificates that are spoilt, forged or damaged are refused.

use std::sync::Arc;

use cstk::certificate::{Certificate, Entry};
use cstk::cobject::{CObject, InducedOptions};
use cstk::error::ErrorKind;
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against_with, environment, link, robot, space};
use helpers::shapes::cuboid;

use super::certificates::Drawn;
use super::forged::Forged;

/// What is spoilt, and how.
type Spoil = fn(&mut Entry);

const SPOILT: [(&str, Spoil); 10] = [
    ("a larger gap", |e| e.gap += 1e-6 + 1e-3 * e.gap.abs()),
    ("a gap that is no gap", |e| e.gap = 1e30),
    ("a smaller displacement", |e| e.displacement *= 0.99),
    ("a turned direction", |e| {
        e.direction = e.direction.map(|x| -x)
    }),
    ("a long direction", |e| {
        e.direction = e.direction.map(|x| 2.0 * x)
    }),
    ("another interval", |e| e.times[0] += 1e-9),
    ("another item", |e| e.item += 1),
    ("another link", |e| e.links[0] ^= 1),
    ("another body", |e| e.bodies[0] ^= 1),
    ("other primitives", |e| e.groups[0][1] += 1),
];

#[test]
fn a_certificate_with_one_number_spoilt_is_refused() {
    let mut random = Random::new(1907);
    let mut spoilt = [0; SPOILT.len()];
    let mut certificates = 0;
    while certificates < 60 {
        let drawn = Drawn::new(&mut random);
        let (_, Some(certificate)) = drawn.certified(0.0) else {
            continue;
        };
        certificates += 1;
        let count = certificate.entries().len();
        for (number, (name, spoil)) in SPOILT.iter().enumerate() {
            let mut forged = Forged::of(&certificate);
            let place = random.below(count);
            let mut entry = forged.entry(place);
            spoil(&mut entry);
            if entry == forged.entry(place) || (number == 0 && entry.gap > 1e9) {
                continue;
            }
            forged.set_entry(place, &entry);
            assert!(!drawn.accepts(&forged.certificate()), "{name}");
            spoilt[number] += 1;
        }
        // An entry is missing; the last that a step makes is too.
        let mut forged = Forged::of(&certificate);
        forged.remove_entry(random.below(count));
        assert!(!drawn.accepts(&forged.certificate()), "an entry is missing");
        // Two halves of an interval become one, which the first shows.
        for place in 0..count {
            let mut forged = Forged::of(&certificate);
            if let Some(whole) = forged.joined(place) {
                let forged = forged.certificate();
                assert_eq!(forged.entries()[place].times, whole);
                assert!(!drawn.accepts(&forged), "an interval is left out");
            }
        }
        let mut forged = Forged::of(&certificate);
        forged.step_mut(0, |step| *step = step.wrapping_add(1));
        assert!(!drawn.accepts(&forged.certificate()), "another step");
    }
    assert!(spoilt.iter().all(|count| *count > 20), "{spoilt:?}");
}

#[test]
fn other_bodies_robots_poses_ends_and_thresholds_are_refused() {
    let slider = |at: f64, axis: Vec3| {
        let links = vec![LinkDefinition {
            at: Pose::from_translation(Vec3::new(at, 0.0, 0.0)),
            body: Some(cuboid([1.0; 3]).body),
            ..link(None, JointKind::Prismatic, axis)
        }];
        space(vec![robot(3, links)])
    };
    let cell = |space: &Arc<Space>, side: f64, at: f64, margin: f64| {
        let wall = cuboid([side; 3]).body;
        let pose = Pose::from_translation(Vec3::new(at, 0.0, 0.0));
        let options = InducedOptions {
            margin,
            ..InducedOptions::default()
        };
        against_with(space, &environment(&[(&wall, pose)]).0, options)
    };
    let own = slider(0.0, Vec3::x());
    let drawn = Drawn {
        cobject: cell(&own, 1.0, 3.0, 0.0),
        q0: vec![0.0],
        q1: vec![1.5],
    };
    let (_, certificate) = drawn.certified(0.01);
    let certificate = certificate.unwrap();
    let refused = |cobject: &CObject, q0: f64, q1: f64, threshold: f64| {
        let error = certificate.verify(cobject, &[q0], &[q1], threshold);
        assert_eq!(error.unwrap_err().kind, ErrorKind::NotProved);
    };
    certificate
        .verify(&drawn.cobject, &[0.0], &[1.5], 0.01)
        .unwrap();
    // Made anew, the same things are the same.
    let again = cell(&slider(0.0, Vec3::x()), 1.0, 3.0, 0.0);
    certificate.verify(&again, &[0.0], &[1.5], 0.01).unwrap();
    for cobject in [
        cell(&own, 0.9, 3.0, 0.0),
        cell(&own, 1.0, 3.0 + 1e-12, 0.0),
        cell(&own, 1.0, 3.0, 0.001),
        cell(&slider(-1e-12, Vec3::x()), 1.0, 3.0, 0.0),
        cell(&slider(0.0, -Vec3::x()), 1.0, 3.0, 0.0),
    ] {
        refused(&cobject, 0.0, 1.5, 0.01);
    }
    refused(&drawn.cobject, 0.0, 1.4, 0.01);
    refused(&drawn.cobject, 0.1, 1.5, 0.01);
    refused(&drawn.cobject, 0.0, 1.5, 0.0);
    refused(&drawn.cobject, 0.0, 1.5, f64::NAN);
    let error = certificate.verify(&drawn.cobject, &[0.0, 0.0], &[1.5], 0.01);
    assert_eq!(error.unwrap_err().kind, ErrorKind::WrongSize);
}

/// No change of ends and intervals makes a certificate of a free motion one of a motion that hits.
#[test]
fn a_certificate_of_a_motion_that_hits_cannot_be_forged() {
    let mut random = Random::new(1913);
    let context = &mut QueryContext::new();
    let mut forgeries = 0;
    while forgeries < 2000 {
        let drawn = Drawn::new(&mut random);
        let options = MotionOptions::default();
        let answer = context.motion(&drawn.cobject, &drawn.q0, &drawn.q1, &options);
        let answer = answer.unwrap();
        if answer.outcome != MotionOutcome::Hit || answer.times[0] < 0.1 {
            continue;
        }
        let until = Drawn {
            q1: drawn.at(0.9 * answer.times[0]),
            q0: drawn.q0.clone(),
            cobject: drawn.cobject,
        };
        let (_, Some(certificate)) = until.certified(0.0) else {
            continue;
        };
        let whole = Drawn {
            q1: drawn.q1,
            ..until
        };
        let count = certificate.entries().len();
        for round in 0..20 {
            let mut forged = Forged::of(&certificate);
            forged.set_end(1, &whole.q1);
            if round > 0 {
                for _ in 0..1 + random.below(3) {
                    let place = random.below(count);
                    let mut entry = forged.entry(place);
                    match random.below(4) {
                        0 => entry.times[random.below(2)] = random.within(0.0, 1.0),
                        1 => entry.gap += random.within(0.0, 0.1),
                        2 => entry.displacement *= random.within(0.0, 3.0),
                        _ => entry.direction = random.unit().into(),
                    }
                    forged.set_entry(place, &entry);
                }
                if random.below(2) == 0 {
                    let place = random.below(count);
                    forged.joined(place);
                }
            }
            if round % 5 == 4 {
                forged.remove_entry(random.below(count));
            }
            assert!(!whole.accepts(&forged.certificate()));
            forgeries += 1;
        }
    }
}

/// Any bytes are refused, or a certificate that proves nothing false.
#[test]
fn altered_files_are_refused_or_harmless() {
    let mut random = Random::new(1931);
    let (drawn, certificate) = loop {
        let drawn = Drawn::new(&mut random);
        if let (_, Some(certificate)) = drawn.certified(0.0)
            && certificate.entries().len() > 12
        {
            break (drawn, certificate);
        }
    };
    let bytes = certificate.to_bytes();
    for length in 0..bytes.len().min(5000) {
        assert!(
            Certificate::from_bytes(&bytes[..length]).is_err(),
            "{length}"
        );
    }
    for place in 0..bytes.len().min(5000) {
        let mut altered = bytes.clone();
        altered[place] ^= 1 << (place % 8);
        assert!(Certificate::from_bytes(&altered).is_err(), "byte {place}");
    }
    for place in (32..bytes.len().min(20_000)).step_by(4) {
        for value in [u32::MAX, 0, 1, 0x7ff0_0000] {
            let mut forged = bytes.clone();
            let end = (place + 4).min(bytes.len());
            forged[place..end].copy_from_slice(&value.to_le_bytes()[..end - place]);
            helpers::files::sign(&mut forged);
            match Certificate::from_bytes(&forged) {
                Err(error) => assert_eq!(error.kind, ErrorKind::Parse),
                Ok(found) => drop(drawn.accepts(&found)),
            }
        }
    }
    let mut newer = bytes;
    newer[8] = 2;
    let error = Certificate::from_bytes(&newer).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
}
