//! PLY and PCD files: what writers of our own in all encodings put in is read again, and no bytes lead to a fault. The tests
//! check overflows.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use cstk::body::BodyBuilder;
use cstk::body::cloud_file::{Cloud, read_cloud_file};
use cstk::body::mesh_file::read_mesh_file;
use cstk::error::{Error, ErrorKind};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};

use helpers::random::Random;

/// Writes a file with this ending, and reads it.
fn read<T>(ending: &str, bytes: &[u8], read: impl Fn(&Path) -> T) -> T {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let name = format!("cstk-cloud-{}-{number}.{ending}", std::process::id());
    let path: PathBuf = std::env::temp_dir().join(name);
    std::fs::write(&path, bytes).unwrap();
    let result = read(&path);
    std::fs::remove_file(&path).unwrap();
    result
}

fn cloud(ending: &str, bytes: &[u8]) -> Result<Cloud, Error> {
    read(ending, bytes, read_cloud_file)
}

fn refused(ending: &str, bytes: &[u8], kind: ErrorKind, culprit: &str) {
    let error = cloud(ending, bytes).unwrap_err();
    assert_eq!(error.kind, kind, "{error}");
    assert!(
        error.message.contains(culprit),
        "{error} names no {culprit}"
    );
}

/// Numbers that single precision holds.
fn points(random: &mut Random, count: usize) -> Vec<[f32; 3]> {
    let mut coordinate = || random.within(-5.0, 5.0) as f32;
    (0..count)
        .map(|_| [coordinate(), coordinate(), coordinate()])
        .collect()
}

fn is_same(cloud: &Cloud, points: &[[f32; 3]]) -> bool {
    let expected = points.iter().map(|p| Vec3::from(p.map(f64::from)));
    cloud.points.iter().copied().eq(expected)
}

/// Elements before, with and after the vertices, some with lists, whose numbers lie between those that are wanted.
fn ply(points: &[[f32; 3]], faces: &[Vec<u32>], encoding: &str) -> Vec<u8> {
    let (n, m) = (points.len(), faces.len());
    let mut bytes = format!(
        "ply\r\nformat {encoding} 1.0\ncomment of no use\nelement camera 2\nproperty list uchar short marks\n\
         element vertex {n}\nproperty uchar red\nproperty float z\nproperty list int double weights\nproperty float x\n\
         property double y\nelement face {m}\nproperty int group\nproperty list ushort int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let ascii = encoding == "ascii";
    let is_big = encoding == "binary_big_endian";
    let mut put = |number: f64, kind: char| {
        let mut raw: Vec<u8> = match kind {
            'B' => vec![number as u8],
            'h' => (number as i16).to_le_bytes().into(),
            'H' => (number as u16).to_le_bytes().into(),
            'i' => (number as i32).to_le_bytes().into(),
            'f' => (number as f32).to_le_bytes().into(),
            _ => number.to_le_bytes().into(),
        };
        if is_big {
            raw.reverse();
        }
        match ascii {
            true => write_text(&mut bytes, number),
            false => bytes.extend(raw),
        }
    };
    let end = '\n';
    let rows: Vec<Vec<(f64, char)>> = [
        vec![(3.0, 'B'), (1.0, 'h'), (-2.0, 'h'), (3.0, 'h')],
        vec![(0.0, 'B')],
    ]
    .into_iter()
    .chain(points.iter().enumerate().map(|(i, p)| {
        let [x, y, z] = p.map(f64::from);
        let mut row = vec![(7.0, 'B'), (z, 'f'), ((i % 3) as f64, 'i')];
        row.extend((0..i % 3).map(|k| (k as f64 + 0.5, 'd')));
        row.extend([(x, 'f'), (y, 'd')]);
        row
    }))
    .chain(faces.iter().map(|face| {
        let mut row = vec![(-1.0, 'i'), (face.len() as f64, 'H')];
        row.extend(face.iter().map(|&i| (f64::from(i), 'i')));
        row
    }))
    .collect();
    for row in rows {
        for (number, kind) in row {
            put(number, kind);
        }
        if ascii {
            put(f64::NAN, end);
        }
    }
    bytes
}

/// A number and a space; of NaN the end of a line.
fn write_text(bytes: &mut Vec<u8>, number: f64) {
    match number.is_nan() {
        true => bytes.push(b'\n'),
        false => bytes.extend(format!("{number} ").into_bytes()),
    }
}

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

#[test]
fn points_and_faces_of_ply_files_in_each_encoding() {
    let mut random = Random::new(5);
    let vertices = points(&mut random, 40);
    let faces = vec![vec![0, 1, 2], vec![3, 4, 5, 6], vec![39, 0, 7]];
    for encoding in ENCODINGS {
        let bytes = ply(&vertices, &faces, encoding);
        assert!(is_same(&cloud("ply", &bytes).unwrap(), &vertices));
        let mesh = read("ply", &bytes, read_mesh_file).unwrap();
        assert_eq!(mesh.face_sizes, [3, 4, 3]);
        assert_eq!(mesh.indices, faces.concat());
        for cut in [10, 300, bytes.len() / 2, bytes.len() - 3] {
            refused("ply", &bytes[..cut], ErrorKind::Parse, "");
        }
        let longer = [&bytes[..], b" 1"].concat();
        refused("ply", &longer, ErrorKind::Parse, "after the last element");
    }
    let none = read("ply", &ply(&vertices, &[], "ascii"), read_mesh_file);
    assert_eq!(none.unwrap_err().kind, ErrorKind::Empty);
}

#[test]
fn what_ply_files_may_not_say() {
    let head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    let of = |data: &str| [head, data].concat().into_bytes();
    assert!(cloud("ply", &of("0 0 0\n\n1 1 1")).is_ok());
    for (data, kind, culprit) in [
        ("0 0 0\n1 1\n", ErrorKind::Parse, "vertex 1 (line 9)"),
        ("0 0 0 0\n1 1 1\n", ErrorKind::Parse, "vertex 0 (line 8)"),
        ("0 0 0\n1 x 1\n", ErrorKind::Parse, "\"x\""),
        (
            "0 0 0\n1 nan 1\n",
            ErrorKind::NotFinite,
            "vertex 1 (line 9)",
        ),
        ("0 0 0\n1 1 1e60\n", ErrorKind::InvalidArgument, "vertex 1"),
        ("0 0 0\n", ErrorKind::Parse, "truncated"),
    ] {
        refused("ply", &of(data), kind, culprit);
    }
    for (old, new, culprit) in [
        ("ply\n", "plx\n", "no PLY file"),
        ("ascii", "asci", "line 2"),
        ("format ascii 1.0\n", "", "format"),
        ("vertex 2", "vertex -2", "line 3"),
        ("vertex 2", "vertex 99999999999999999999999", "line 3"),
        ("float z", "flot z", "line 6"),
        ("float z", "float w", "no property z"),
        ("property float z", "element vertex 1", "line 6"),
        ("end_header\n", "", "line 7"),
    ] {
        let text = of("0 0 0\n1 1 1\n");
        let text = String::from_utf8(text).unwrap().replacen(old, new, 1);
        refused("ply", text.as_bytes(), ErrorKind::Parse, culprit);
    }
    let many = head.replace("vertex 2", "vertex 99999999999");
    refused(
        "ply",
        many.as_bytes(),
        ErrorKind::Unsupported,
        "99999999999 vertices",
    );
    let empty = "ply\nformat ascii 1.0\nelement nothing 99999999999999\nend_header\n";
    refused(
        "ply",
        empty.as_bytes(),
        ErrorKind::Parse,
        "\"nothing\" has no property",
    );
    let long = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint uchar vertex_index\nend_header\n";
    let long = [long.as_bytes(), &[0xFE, 0xFF, 0xFF, 0xFF, 0, 0, 0]].concat();
    let error = read("ply", &long, read_mesh_file).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported, "{error}");
}

/// Points with padding between their coordinates, as the Point Cloud Library has them.
fn pcd(points: &[[f32; 3]], encoding: &str, random: &mut Random) -> Vec<u8> {
    let n = points.len();
    let mut bytes = format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS label x y _ z\nSIZE 2 4 8 1 4\nTYPE U F F U F\n\
         COUNT 1 1 1 3 1\nWIDTH {n}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA {encoding}\n"
    )
    .into_bytes();
    let parts = |[x, y, z]: [f32; 3], i: usize| -> [Vec<u8>; 5] {
        [
            (i as u16).to_le_bytes().into(),
            x.to_le_bytes().into(),
            f64::from(y).to_le_bytes().into(),
            vec![9, 9, 9],
            z.to_le_bytes().into(),
        ]
    };
    let rows: Vec<[Vec<u8>; 5]> = (0..).zip(points).map(|(i, p)| parts(*p, i)).collect();
    match encoding {
        "ascii" => {
            let mut text = String::new();
            for (i, p) in points.iter().enumerate() {
                let [x, y, z] = p.map(f64::from);
                writeln!(text, "{i} {x} {y} 9 9 9 {z}").unwrap();
            }
            bytes.extend(text.into_bytes());
        }
        "binary" => bytes.extend(rows.concat().concat()),
        _ => {
            let columns: Vec<u8> = (0..5)
                .flat_map(|k| rows.iter().flat_map(move |row| row[k].clone()))
                .collect();
            let packed = packed(&columns, random);
            bytes.extend((packed.len() as u32).to_le_bytes());
            bytes.extend((columns.len() as u32).to_le_bytes());
            bytes.extend(packed);
        }
    }
    bytes
}

/// LZF: references to any earlier place that repeats the next bytes, and literals between them.
fn packed(data: &[u8], random: &mut Random) -> Vec<u8> {
    let (mut out, mut at) = (Vec::new(), 0);
    while at < data.len() {
        let length = |from: usize| {
            let same = data[at..]
                .iter()
                .zip(&data[from..])
                .take_while(|(a, b)| a == b);
            same.count().min(264)
        };
        let from = (at.saturating_sub(8192)..at).max_by_key(|&from| length(from));
        match from.map(|from| (from, length(from))) {
            Some((from, count)) if count > 2 => {
                let offset = at - from - 1;
                match count - 2 {
                    short @ 0..7 => out.push((short << 5 | offset >> 8) as u8),
                    long => out.extend([(7 << 5 | offset >> 8) as u8, (long - 7) as u8]),
                }
                out.push((offset & 255) as u8);
                at += count;
            }
            _ => {
                let count = (1 + random.below(32)).min(data.len() - at);
                out.push(count as u8 - 1);
                out.extend(&data[at..at + count]);
                at += count;
            }
        }
    }
    out
}

const DATA: [&str; 3] = ["ascii", "binary", "binary_compressed"];

#[test]
fn points_of_pcd_files_in_each_encoding() {
    let mut random = Random::new(7);
    let mut all = points(&mut random, 500);
    for i in 100..300 {
        all[i] = all[i % 7];
    }
    for encoding in DATA {
        let bytes = pcd(&all, encoding, &mut random);
        let read = cloud("pcd", &bytes).unwrap();
        assert!(is_same(&read, &all) && read.left_out == 0, "{encoding}");
        let cut = &bytes[..bytes.len() * 2 / 3];
        let kind = cloud("pcd", cut).unwrap_err().kind;
        assert_eq!(kind, ErrorKind::Parse);
    }
    // What was not measured is left out.
    all[3][1] = f32::NAN;
    all[9] = [f32::NAN; 3];
    for encoding in DATA {
        let read = cloud("pcd", &pcd(&all, encoding, &mut random)).unwrap();
        assert!(read.left_out == 2 && read.points.len() == 498, "{encoding}");
    }
    all[12][0] = f32::INFINITY;
    refused(
        "pcd",
        &pcd(&all, "ascii", &mut random),
        ErrorKind::NotFinite,
        "line 24",
    );
    refused(
        "pcd",
        &pcd(&all, "binary", &mut random),
        ErrorKind::NotFinite,
        "point 12",
    );
}

#[test]
fn what_pcd_files_may_not_say() {
    let good = String::from_utf8(pcd(&[[1.0, 2.0, 3.0]], "ascii", &mut Random::new(1))).unwrap();
    for (old, new, kind, culprit) in [
        ("VERSION", "VERSON", ErrorKind::Parse, "line 2"),
        (
            "FIELDS label x",
            "FIELDS label u",
            ErrorKind::Parse,
            "field x",
        ),
        (
            "SIZE 2 4 8 1 4",
            "SIZE 2 4 8 1",
            ErrorKind::Parse,
            "field z",
        ),
        ("SIZE 2 4", "SIZE 2 3", ErrorKind::Parse, "field x"),
        ("TYPE U F", "TYPE U X", ErrorKind::Parse, "field x"),
        (
            "TYPE U F F U F",
            "TYPE U F F U F F",
            ErrorKind::Parse,
            "TYPE",
        ),
        ("COUNT 1 1", "COUNT 1 2", ErrorKind::Parse, "field x"),
        (
            "COUNT 1 1 1 3",
            "COUNT 1 1 1 99999999",
            ErrorKind::Parse,
            "field _",
        ),
        ("WIDTH 1", "WIDTH 2", ErrorKind::Parse, "POINTS"),
        ("WIDTH 1", "WIDTH x", ErrorKind::Parse, "WIDTH"),
        ("DATA ascii", "DATA text", ErrorKind::Parse, "line 11"),
        ("DATA ascii\n", "", ErrorKind::Parse, "line 11"),
        (
            "DATA ascii\n",
            "DATA binary\n",
            ErrorKind::Parse,
            "bytes of data",
        ),
        (
            "DATA ascii\n",
            "DATA binary_compressed\n",
            ErrorKind::Parse,
            "unpacked",
        ),
        ("0 1 2", "0 1", ErrorKind::Parse, "line 12"),
        ("0 1 2", "0 one 2", ErrorKind::Parse, "\"one\""),
        ("0 1 2 9 9 9 3\n", "", ErrorKind::Parse, "truncated"),
        (
            "0 1 2 9 9 9 3\n",
            "0 1 2 9 9 9 nan\n",
            ErrorKind::Empty,
            "no point",
        ),
        (
            "9 9 9 3\n",
            "9 9 9 3\n0 1 2 9 9 9 3\n",
            ErrorKind::Parse,
            "line 13",
        ),
    ] {
        assert!(good.contains(old), "{old}");
        refused("pcd", good.replacen(old, new, 1).as_bytes(), kind, culprit);
    }
    let many = good
        .replace("WIDTH 1", "WIDTH 99999999999")
        .replace("POINTS 1", "POINTS 99999999999");
    refused(
        "pcd",
        many.as_bytes(),
        ErrorKind::Unsupported,
        "99999999999 points",
    );
    refused("xyz", b"", ErrorKind::Unsupported, ".pcd or .ply");
}

/// Bytes changed, taken away and repeated at random are read or refused.
#[test]
fn no_damage_leads_to_a_fault() {
    let mut random = Random::new(31);
    let all = points(&mut random, 30);
    let faces = vec![vec![0, 1, 2], vec![3, 4, 5]];
    let mut files: Vec<(&str, Vec<u8>)> = Vec::new();
    for i in 0..3 {
        files.push(("ply", ply(&all, &faces, ENCODINGS[i])));
        files.push(("pcd", pcd(&all, DATA[i], &mut random)));
    }
    for round in 0..6000 {
        let (ending, whole) = &files[round % files.len()];
        let mut bytes = whole.clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len());
            match random.below(4) {
                0 => bytes[at] = random.next_bits() as u8,
                1 => bytes[at] = *random_of(&mut random, b"0129. -\n\xFF"),
                2 => bytes.truncate(at.max(1)),
                _ => bytes.insert(at, bytes[at]),
            }
        }
        let _ = cloud(ending, &bytes);
        if *ending == "ply" {
            let _ = read(ending, &bytes, read_mesh_file);
        }
    }
}

fn random_of<'a>(random: &mut Random, from: &'a [u8]) -> &'a u8 {
    &from[random.below(from.len())]
}

/// The points of a file become balls where the pose and the scale move them.
#[test]
fn clouds_are_added_at_a_pose() {
    let mut random = Random::new(3);
    let mut all = points(&mut random, 20);
    all[4] = [f32::NAN; 3];
    let bytes = pcd(&all, "binary", &mut random);
    let pose = random.pose(1.0);
    let scale = Vec3::new(2.0, 1.0, -0.5);
    let mut builder = BodyBuilder::new(3).unwrap();
    let add = |path: &Path| builder.add_cloud_file(path, &pose, &scale, 0.25);
    let left_out = std::cell::RefCell::new(add);
    assert_eq!(
        read("pcd", &bytes, |path| (left_out.borrow_mut())(path)).unwrap(),
        1
    );
    let body = builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap();
    let expected = all.iter().filter(|p| !p[0].is_nan()).map(|p| {
        let p = Vec3::from(p.map(f64::from)).component_mul(&scale);
        pose.rotation * p + pose.translation
    });
    assert_eq!(body.primitives().len(), 19);
    for (i, (expected, primitive)) in expected.zip(body.primitives().iter()).enumerate() {
        let found = primitive.vertices[0] + body.center();
        assert!((found - expected).norm() < 1e-14 && body.tag(i as u32) == i as u64);
    }
    let highest = Pose::identity();
    let nowhere =
        BodyBuilder::new(3)
            .unwrap()
            .add_cloud_file(Path::new("none.pcd"), &highest, &scale, 0.1);
    assert_eq!(nowhere.unwrap_err().kind, ErrorKind::Io);
}
