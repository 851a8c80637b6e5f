//! OBJ files: what each statement means, and that no text leads to a fault. The tests check overflows.

use std::path::PathBuf;

use cstk::body::Mesh;
use cstk::body::mesh_file::read_mesh_file;
use cstk::error::{Error, ErrorKind};

use helpers::random::Random;

fn read(text: &[u8]) -> Result<Mesh, Error> {
    use std::sync::atomic::{AtomicU64, Ordering};
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let path: PathBuf =
        std::env::temp_dir().join(format!("cstk-obj-{}-{number}.obj", std::process::id()));
    std::fs::write(&path, text).unwrap();
    let mesh = read_mesh_file(&path);
    std::fs::remove_file(&path).unwrap();
    mesh
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// The corners of the faces, as coordinates.
fn faces(text: &str) -> Vec<Vec<[f64; 3]>> {
    let mesh = read(text.as_bytes()).unwrap_or_else(|e| panic!("{e}: {text}"));
    let mut rest = &mesh.indices[..];
    let mut faces = Vec::new();
    for &size in &mesh.face_sizes {
        let (face, after) = rest.split_at(size as usize);
        faces.push(
            face.iter()
                .map(|&i| mesh.vertices[i as usize].into())
                .collect(),
        );
        rest = after;
    }
    faces
}

#[test]
fn every_way_to_name_a_corner() {
    let want = faces(&format!("{SQUARE}f 1 2 3\n"));
    assert_eq!(want, [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]]);
    let texture = "vt 0 0\nvt 1 0\nvn 0 0 1\n";
    for face in [
        "f -4 -3 -2",
        "f +1 2 3",
        "f 1/1 2/2 3/1",
        "f 1/-1/-1 2/-2/1 3/2/-1",
        "f 1//1 2//-1 3//1",
        "f 1/ 2// 3",
        "f 1/7 2//9 3",
        "f 1 2 \\\n 3",
        "f \\\r\n1\\\r\n 2 3",
        "\t f\t1  2\t3 ",
        "f 1 2 3 # a comment \\",
        "# C:\\models\\\nf 1 2 3",
        "g a\ns off\nusemtl none\nf 1 2 3",
        "p 1 2\nvp 1\nf 1 2 3",
    ] {
        assert_eq!(faces(&format!("{SQUARE}{texture}{face}\n")), want, "{face}");
        assert_eq!(faces(&format!("{SQUARE}{texture}{face}")), want, "{face}");
    }
    // Before its vertices, with weights, colours, and a line among the faces.
    assert_eq!(faces(&format!("f 1 2 3\n{SQUARE}")), want);
    let other = "v 0 0 0 2\nv 2 0 0 2\nv 1 1 0 0.5 0.5 0.5\nf 1 2 3\nl 1 2\n";
    assert_eq!(faces(other)[0], want[0]);
    assert_eq!(faces(other)[1].len(), 2);
    assert_eq!(faces(&format!("{SQUARE}f 1 2 3 4 -1 -2 -3\n"))[0].len(), 7);
}

#[test]
fn faults_are_named_by_their_line() {
    for (line, statement, culprit) in [
        (5, "f 1/-4/1 2 3", "-4"),
        (5, "f 1//-1 2 3", "-1"),
        (5, "f -5 2 3", "-5"),
        (5, "f 1 2 0", "\"0\""),
        (5, "f 1 2 5", "vertex 5"),
        (5, "f 1 2 3/1/1/1", "3 parts"),
        (5, "f /1 2 3", "\"\""),
        (5, "f 1 2 9223372036854775807", "9223372036854775807"),
        (5, "f 1 2 -9223372036854775808", "-9223372036854775808"),
        (5, "f 1 2 99999999999999999999", "99999999999999999999"),
        (5, "f 1 2 4294967297", "4294967297"),
        (6, "f 1 2 \\\n x", "\"x\""),
        (5, "f 1.0 2 3", "1.0"),
        (5, "v 1 2", "2"),
        (5, "v 1 2 3 4 5", "5"),
        (5, "v 1 2 3 4 5 6 7", "more"),
        (5, "v 1 2 3 0", "weight"),
        (5, "v 1 2 x", "\"x\""),
    ] {
        let error = read(format!("{SQUARE}{statement}\nf 1 2 3\n").as_bytes()).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Parse, "{error}");
        let place = format!("line {line}: ");
        for part in [place.as_str(), culprit] {
            assert!(error.message.contains(part), "{statement}: {error}");
        }
    }
    for end in ["f 1 2 3\\", "\\"] {
        let error = read(format!("{SQUARE}{end}").as_bytes()).unwrap_err();
        assert!(error.message.contains("truncated"), "{error}");
    }
}

/// Texts made from words that belong into OBJ files, and from damaged ones.
#[test]
fn no_text_leads_to_a_fault() {
    let words: [&[u8]; 34] = [
        b"v",
        b"vt",
        b"vn",
        b"f",
        b"l",
        b"p",
        b"o",
        b"g",
        b"usemtl",
        b"mtllib",
        b"#",
        b"\\",
        b"\n",
        b"\n",
        b"\r\n",
        b" ",
        b" ",
        b"/",
        b"//",
        b"-",
        b"0",
        b"1",
        b"2",
        b"-1",
        b"-4",
        b"1/-4/1",
        b"-9223372036854775808",
        b"18446744073709551616",
        b"nan",
        b"1e999",
        b"0.5",
        b"\xff",
        b"\0",
        b"1//1",
    ];
    let mut random = Random::new(1);
    let mut pick = |count: usize| random.below(count);
    let good = format!("{SQUARE}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 -2/-1/-1\nf 1 2 3 4\n");
    let mut taken = 0;
    for round in 0..4000 {
        let mut text = if round % 2 == 0 {
            good.clone().into_bytes()
        } else {
            SQUARE.into()
        };
        for _ in 0..=pick(6) {
            let word = words[pick(words.len())];
            let place = pick(text.len() + 1);
            match pick(3) {
                0 => drop(text.splice(place..place, word.iter().copied())),
                1 => {
                    let end = (place + pick(8)).min(text.len());
                    drop(text.splice(place..end, word.iter().copied()));
                }
                _ => {
                    text.extend(b"f ");
                    text.extend(word);
                    text.push(b' ');
                }
            }
        }
        if let Ok(mesh) = read(&text) {
            taken += 1;
            let count = mesh.vertices.len();
            assert!(mesh.indices.iter().all(|&i| (i as usize) < count));
            let corners: usize = mesh.face_sizes.iter().map(|&size| size as usize).sum();
            assert_eq!(corners, mesh.indices.len());
        }
    }
    // Both ends are met often.
    assert!((100..3900).contains(&taken), "{taken} texts were taken");
}
