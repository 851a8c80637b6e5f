//! Boxes whose faces are off being level by next to nothing, as poses of nine digits make them, and hulls whose faces hardly differ.

use cstk::body::BodyBuilder;
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::query::QueryContext;

/// The half extents of two boxes.
type Halves = [[f64; 3]; 2];

/// The rows of their poses.
type Poses = [[[f64; 4]; 3]; 2];

/// Tilted by 1e-10 to 1e-8 from boxes whose faces are level: the closest points are in the middle of an edge and a face.
const NEARLY_LEVEL: [(Halves, Poses); 3] = [
    (
        [
            [0.6841469212653735, 0.1442143228203442, 0.7511881862461168],
            [0.5115279393424608, 0.5617450005715823, 0.7124252381068176],
        ],
        [
            [
                [-1.0, 0.0, 0.0, 0.0],
                [0.0, -1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
            [
                [
                    0.9503779269265952,
                    -0.3110977274277448,
                    0.0,
                    0.5043935163354041,
                ],
                [
                    -0.3110977274277448,
                    -0.9503779269265952,
                    2.8913600634262315e-10,
                    -0.8372195513701803,
                ],
                [
                    -8.994955449072404e-11,
                    -2.7478847830773704e-10,
                    -1.0,
                    1.562372767695393,
                ],
            ],
        ],
    ),
    (
        [[1.0, 0.125, 0.625], [0.25, 0.25, 0.125]],
        [
            [
                [
                    -0.5430635226433125,
                    -0.6548646091881775,
                    0.5255800167501158,
                    0.0,
                ],
                [
                    0.47693670578154873,
                    -0.7557143689494757,
                    -0.44880638502759757,
                    0.0,
                ],
                [
                    0.691095788623025,
                    0.006938025375513504,
                    0.7227298767530009,
                    0.0,
                ],
            ],
            [
                [
                    0.5255800166493777,
                    0.5430635228075524,
                    0.6548646091328274,
                    1.4704766475183,
                ],
                [
                    -0.44880638493912595,
                    -0.47693670578777836,
                    0.755714368998086,
                    -0.3398112323503518,
                ],
                [
                    0.7227298768811989,
                    -0.691095788489666,
                    -0.0069380253050757386,
                    -0.4186833717157135,
                ],
            ],
        ],
    ),
    (
        [[0.625, 0.5, 0.375], [0.5, 0.75, 0.125]],
        [
            [
                [
                    -0.7503971549297994,
                    -0.6607992278033529,
                    0.015763578519968822,
                    0.0,
                ],
                [
                    -0.6123643422724401,
                    0.7039771245822873,
                    0.3597584194679767,
                    0.0,
                ],
                [
                    -0.24882528445980848,
                    0.2603086410385704,
                    -0.9329123159301458,
                    0.0,
                ],
            ],
            [
                [
                    0.6607992278033529,
                    0.750397154982521,
                    -0.015763576010247585,
                    0.3598342528871879,
                ],
                [
                    -0.7039771245822873,
                    0.6123643434756607,
                    -0.3597584174199095,
                    1.2912236326987232,
                ],
                [
                    -0.2603086410385704,
                    0.24882528133966092,
                    0.9329123167623479,
                    1.2630633197316583,
                ],
            ],
        ],
    ),
];

fn pose(rows: [[f64; 4]; 3]) -> Pose {
    Pose {
        rotation: Mat3::from_fn(|i, j| rows[i][j]),
        translation: Vec3::from(rows.map(|row| row[3])),
    }
}

/// Apart, they have a contact, at a point of each, along a normal that parts them by the distance.
#[test]
fn boxes_that_are_nearly_level_have_a_contact() {
    for (halves, poses) in NEARLY_LEVEL {
        let halves = halves.map(Vec3::from);
        let [a, b] = halves.map(|half| {
            let mut builder = BodyBuilder::new(3).unwrap();
            builder.add_box(&Pose::identity(), &half, 0).unwrap();
            helpers::models::built(&builder, &Default::default())
        });
        let poses = poses.map(pose);
        let mut query = QueryContext::new();
        let found = query
            .pair_distance((&a, &poses[0]), (&b, &poses[1]), f64::INFINITY)
            .unwrap();
        let contact = found.contact.expect("a contact");
        for ((point, half), pose) in contact.points.iter().zip(&halves).zip(&poses) {
            let seen = pose.inverse().transform_point(point);
            assert!((seen.abs() - half).max().abs() < 1e-9, "{contact:?}");
        }
        let off = contact.points[0] - contact.points[1] - contact.normal * found.distance;
        assert!(off.norm() < 1e-9, "{off} {contact:?}");
    }
}

/// Two points of a hull with faces that are level but for 1e-13, on a needle: within 1e-12 of each other, by exact arithmetic. Far from
/// home no corner is over any of these faces, so that the nearest features found are others. No distance is proved then.
#[test]
fn faces_that_hardly_differ_prove_no_distance() {
    let hull = |corners: &[[f64; 3]]| {
        let corners: Vec<Vec3> = corners.iter().map(|&corner| corner.into()).collect();
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_polyhedron(&corners, 0).unwrap();
        helpers::models::built(&builder, &Default::default())
    };
    let block = hull(&[
        [96.5, 224.5, 162.0],
        [96.5, 223.49999999999994, 162.00000000000006],
        [96.5, 224.5, 158.0],
        [95.5, 223.5, 158.0],
        [96.5, 223.5, 158.0],
        [95.5, 224.5, 158.0],
        [95.5, 223.5, 162.0],
        [95.5, 224.5, 162.0],
        [96.07849678307109, 224.50000000000026, 159.58967386000072],
        [95.5947794892432, 224.50000000000026, 161.10370831401673],
    ]);
    let wide = 0.0067658234670659265;
    let needle = hull(&[
        [1.5, 0.0, 0.0],
        [0.75, wide, 0.0],
        [-0.75, wide, 0.0],
        [-1.5, -3.9191856348971346e-22, 0.0],
        [-0.75, -wide, 0.0],
        [0.75, -wide, 0.0],
    ]);
    let poses = [
        pose([
            [
                0.9440373558540632,
                0.13351094389231213,
                0.3016095134657605,
                -168.80866098483187,
            ],
            [
                0.30433411365876706,
                -1.348150971061065e-33,
                -0.9525653506524016,
                123.52962898084277,
            ],
            [
                -0.1271778990847134,
                0.9910473388597458,
                -0.04063193477321219,
                -203.79339479225828,
            ],
        ]),
        pose([
            [0.0, 0.0, -1.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, -1.0, 0.0, 0.0],
        ]),
    ];
    let sides = [(&block, &poses[0]), (&needle, &poses[1])];
    for (a, b) in [(sides[0], sides[1]), (sides[1], sides[0])] {
        let found = QueryContext::new()
            .pair_distance(a, b, f64::INFINITY)
            .unwrap();
        assert!(found.lower <= 1e-12, "{found:?}");
    }
}
