//! Explanations at the edge of contact: a class that doubt within rounding makes comes with the pair that made it.

use cstk::cobject::{Class, InducedOptions};
use cstk::pose::Pose;
use cstk::query::{Configuration, ContactsListed, QueryContext};

use helpers::random::Random;
use helpers::robots::{against_with, environment, free_body, space};
use helpers::shapes::{Shape, cuboid, hull, mesh};

fn shape(random: &mut Random) -> Shape {
    match random.below(3) {
        0 => hull(&random.points(6, 0.5)),
        1 => mesh(&random.points(6, 0.5), &[[0, 1, 2], [3, 4, 5]]),
        _ => hull(&random.points(3, 0.5)),
    }
}

#[test]
fn contact_and_inside_always_come_with_a_witness() {
    let mut random = Random::new(61);
    let mut by_doubt = 0;
    for case in 0..400 {
        let [a, b] = [shape(&mut random), shape(&mut random)];
        let space = space(vec![free_body(&a.body)]);
        let (environment, _) = environment(&[(&b.body, random.pose(1.0))]);
        let q: Vec<f64> = (0..6).map(|_| random.within(-1.0, 1.0)).collect();
        let at = Configuration::Coordinates(&q);
        for margin in [0.0, 0.03] {
            let ask = |contact_epsilon: f64| {
                let options = InducedOptions {
                    margin,
                    contact_epsilon,
                };
                let cobject = against_with(&space, &environment, options);
                let mut query = QueryContext::new();
                let distance = query.distance(&cobject, at, f64::INFINITY).unwrap();
                (query.explain(&cobject, at, 100).unwrap(), distance)
            };
            let (_, distance) = ask(0.0);
            let bits = distance.distance.to_bits();
            let below = |doubles: u64| f64::from_bits(bits.saturating_sub(doubles));
            let around = [0, 1, 2, 100, 10_000].map(below);
            let epsilons = around.into_iter().chain([
                distance.lower,
                distance.lower.next_down().max(0.0),
                0.5 * (distance.lower + distance.distance),
                distance.distance.next_up(),
            ]);
            for epsilon in epsilons {
                let (found, _) = ask(epsilon);
                let count = found.list.witnesses.len();
                assert_eq!(
                    found.class > Class::Outside,
                    count > 0,
                    "case {case}: {:?} with {count} witnesses, epsilon {epsilon:e} of {distance:?}",
                    found.class
                );
                by_doubt += usize::from(count > 0 && epsilon < distance.distance);
            }
        }
    }
    assert!(by_doubt > 300, "{by_doubt}");
}

/// Of contacts that are not asked for, explanations have none.
#[test]
fn explanations_have_the_contacts_asked_for() {
    let [a, b] = [cuboid([1.0; 3]), cuboid([1.0; 3])];
    let space = space(vec![free_body(&a.body)]);
    let (environment, _) = environment(&[(&b.body, Pose::identity())]);
    let options = InducedOptions {
        margin: 0.0,
        contact_epsilon: 0.1,
    };
    let cobject = against_with(&space, &environment, options);
    let q = [1.05, 0.3, 0.2, 0.0, 0.0, 0.0];
    let contacts = |listed: ContactsListed| {
        let mut query = QueryContext::new();
        query.set_contacts(listed);
        let explained = query
            .explain(&cobject, Configuration::Coordinates(&q), 9)
            .unwrap();
        assert_eq!(explained.class, Class::Contact);
        assert_eq!(explained.list.witnesses.len(), 1);
        explained.list.contacts.len()
    };
    assert_eq!(contacts(ContactsListed::None), 0);
    assert!(contacts(ContactsListed::All) > 0);
}
