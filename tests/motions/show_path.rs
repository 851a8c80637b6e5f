//! Pictures of paths: what a viewer of glTF sees at a time is where the robot is then, in closed form.

use cstk::error::ErrorKind;
use cstk::pose::{Pose, Vec3};
use cstk::robot::{JointKind, LinkDefinition};
use cstk::show::show_path;
use serde_json::Value;

use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

/// A glTF binary file, as a viewer reads it.
struct Picture {
    json: Value,
    buffer: Vec<u8>,
}

impl Picture {
    fn read(bytes: &[u8]) -> Self {
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(
            (&bytes[..4], number(4), number(8)),
            (&b"glTF"[..], 2, bytes.len())
        );
        let text = number(12);
        let start = 20 + text + 8;
        assert_eq!(start + number(20 + text), bytes.len());
        Self {
            json: serde_json::from_slice(&bytes[20..20 + text]).unwrap(),
            buffer: bytes[start..].to_vec(),
        }
    }

    fn values(&self, accessor: &Value) -> Vec<f32> {
        let accessor = &self.json["accessors"][accessor.as_u64().unwrap() as usize];
        let width = ["", "SCALAR", "VEC2", "VEC3", "VEC4"];
        let kind = accessor["type"].as_str().unwrap();
        let width = width.iter().position(|&k| k == kind).unwrap();
        let count = width * accessor["count"].as_u64().unwrap() as usize;
        let view = &self.json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let start = view["byteOffset"].as_u64().unwrap() as usize;
        let bytes = &self.buffer[start..start + 4 * count];
        let chunks = bytes.chunks(4);
        chunks
            .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
            .collect()
    }

    /// The times and the values of a node's channel.
    fn channel(&self, node: &str, path: &str) -> (Vec<f32>, Vec<f32>) {
        let animation = &self.json["animations"][0];
        let channels = animation["channels"].as_array().unwrap();
        let channel = channels.iter().find(|channel| {
            let target = &channel["target"];
            let found = &self.json["nodes"][target["node"].as_u64().unwrap() as usize];
            found["name"] == node && target["path"] == path
        });
        let sampler = channel.unwrap()["sampler"].as_u64().unwrap() as usize;
        let sampler = &animation["samplers"][sampler];
        (
            self.values(&sampler["input"]),
            self.values(&sampler["output"]),
        )
    }
}

/// A bar that turns about z at the end of a slide along x, and a wall.
#[test]
fn links_are_where_the_path_leads_them() {
    let bar = cuboid([1.0, 0.1, 0.1]).body;
    let links = vec![
        link(None, JointKind::Prismatic, Vec3::x()),
        LinkDefinition {
            name: "bar".to_string(),
            body: Some(bar.clone()),
            ..link(Some(0), JointKind::Revolute, Vec3::z())
        },
    ];
    let at = Pose::from_translation(Vec3::new(5.0, 0.0, 0.0));
    let cell = against(&space(vec![robot(3, links)]), &environment(&[(&bar, at)]).0);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("path.glb");
    // Two lengths along, then two half turns on the spot: half of the time each.
    let half = std::f64::consts::PI;
    let points = [0.0, 0.0, half, 0.0, half, 0.5 * half, half, half];
    show_path(&cell, &points, 8.0, &file).unwrap();
    let picture = Picture::read(&std::fs::read(&file).unwrap());
    let (times, places) = picture.channel("bar", "translation");
    let (_, turns) = picture.channel("bar", "rotation");
    assert_eq!((times[0], *times.last().unwrap()), (0.0, 8.0));
    assert!(times.len() > 200 && times.windows(2).all(|two| two[0] < two[1]));
    for (k, &time) in times.iter().enumerate() {
        let (along, turned) = (
            (time.min(4.0)) as f64 / 4.0,
            (time - 4.0).max(0.0) as f64 / 4.0,
        );
        let place = &places[3 * k..3 * k + 3];
        assert!(
            (f64::from(place[0]) - half * along).abs() < 1e-5,
            "{time}: {place:?}"
        );
        assert!(place[1].abs() < 1e-6 && place[2].abs() < 1e-6);
        let (s, c) = (0.5 * half * turned).sin_cos();
        let turn = &turns[4 * k..4 * k + 4];
        let along = f64::from(turn[2]) * s + f64::from(turn[3]) * c;
        assert!((along.abs() - 1.0).abs() < 1e-6, "{time}: {turn:?}");
    }
    // Neighbouring quaternions turn the short way.
    let turns: Vec<&[f32]> = turns.chunks(4).collect();
    let dot = |two: &[&[f32]]| -> f32 { two[0].iter().zip(two[1]).map(|(a, b)| a * b).sum() };
    assert!(turns.windows(2).all(|two| dot(two) > 0.9));
    // The wall stands still.
    let nodes = picture.json["nodes"].as_array().unwrap();
    assert_eq!(
        nodes
            .iter()
            .filter(|node| node.get("matrix").is_some())
            .count(),
        1
    );
    // A path that rests has one moment.
    show_path(&cell, &[1.0, 2.0, 1.0, 2.0], 8.0, &file).unwrap();
    let picture = Picture::read(&std::fs::read(&file).unwrap());
    assert_eq!(picture.channel("bar", "translation").0, [0.0]);
    let kind = |points: &[f64], seconds: f64| {
        let refused = show_path(&cell, points, seconds, &folder.path().join("no.glb"));
        refused.unwrap_err().kind
    };
    assert_eq!(kind(&points, 0.0), ErrorKind::InvalidArgument);
    assert_eq!(kind(&points[..3], 1.0), ErrorKind::WrongSize);
    assert_eq!(kind(&[], 1.0), ErrorKind::WrongSize);
    assert_eq!(kind(&[0.0, f64::NAN], 1.0), ErrorKind::NotFinite);
    assert!(!folder.path().join("no.glb").exists());
}
