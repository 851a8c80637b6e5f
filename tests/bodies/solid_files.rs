//! Files of solid bodies that were not written by the library: refused, or a body that can be asked.

use cstk::pose::Pose;
use cstk::query::QueryContext;

use helpers::checked::at;
use helpers::files::{body_of, bytes_of, sign};
use helpers::surfaces::*;

#[test]
fn forged_boundaries_are_refused_or_harmless() {
    let body = solid(&[with_sliver(0.0)]);
    assert_eq!(body.solid().unwrap().scraps().len(), 1);
    let inner = surface(&[cube(0.2)]);
    let bytes = bytes_of(&body);
    // Two flags, eight signs, and a sliver of three vertices.
    let boundary = bytes.len() - (4 + 4 + 8 + 8 + 4 + 72);
    let values = [[0xff; 4], [0; 4], [1, 0, 0, 0], [0x7f; 4], [2, 0xff, 1, 0]];
    let mut accepted = 0;
    for place in boundary..bytes.len() {
        for value in values {
            let mut forged = bytes.clone();
            let end = (place + 4).min(bytes.len());
            forged[place..end].copy_from_slice(&value[..end - place]);
            sign(&mut forged);
            let Ok(body) = body_of(&forged) else {
                continue;
            };
            accepted += 1;
            for pose in [Pose::identity(), at(0.9, 0.5, 0.0)] {
                let (a, b) = ((&*inner, &pose), (&*body, &Pose::identity()));
                let mut query = QueryContext::new();
                query.pair_distance(a, b, f64::INFINITY).unwrap();
                query.pair_distance(b, a, f64::INFINITY).unwrap();
                query.pair_witnesses(a, b, 0.1, 9).unwrap();
            }
        }
    }
    assert!(accepted > 100, "{accepted}");
}

#[test]
fn shortened_boundaries_are_refused() {
    let bytes = bytes_of(&solid(&[with_sliver(0.0)]));
    for missing in 1..100 {
        let mut short = bytes[..bytes.len() - missing].to_vec();
        sign(&mut short);
        assert!(body_of(&short).is_err(), "{missing} bytes missing");
    }
    let mut long = bytes.clone();
    long.push(0);
    sign(&mut long);
    assert!(body_of(&long).is_err());
    let mut same = bytes.clone();
    sign(&mut same);
    assert_eq!(same, bytes);
}
