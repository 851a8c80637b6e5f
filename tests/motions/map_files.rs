//! Maps in files: arrays of NumPy, and pictures.

use cstk::error::ErrorKind;
use cstk::map::{MapKind, MapValues};

use crate::maps::{arm_among_boxes, cells, map, of_kind, turns, with_cells};

/// The bytes are those that NumPy's format, version 1.0, asks for.
#[test]
fn saved_maps_are_arrays_of_numpy() {
    let cobject = arm_among_boxes();
    let [a, b] = turns(1);
    let axes = [with_cells(a, 3), with_cells(b, 5)];
    let folder = tempfile::tempdir().unwrap();
    for (kind, descr, size) in [(MapKind::Classes, "|u1", 1), (MapKind::Distances, "<f8", 8)] {
        let made = map(&cobject, &[0.0; 2], &axes, &of_kind(kind));
        let file = folder.path().join("map.npy");
        made.save(&file).unwrap();
        let bytes = std::fs::read(&file).unwrap();
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!(end % 64, 0);
        let header = std::str::from_utf8(&bytes[10..end]).unwrap();
        let start = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': (3, 5, ), }}");
        assert!(
            header.starts_with(&start) && header.ends_with('\n'),
            "{header}"
        );
        assert!(header[start.len()..].trim().is_empty());
        assert_eq!(bytes.len() - end, 15 * size);
        match made.values() {
            MapValues::Distances(values) => {
                for (bytes, value) in bytes[end..].chunks_exact(8).zip(values) {
                    assert_eq!(f64::from_le_bytes(bytes.try_into().unwrap()), *value);
                }
            }
            MapValues::Classes(values) | MapValues::Cells(values) => {
                assert_eq!(&bytes[end..], values);
            }
        }
    }
}

/// The chunks of a PNG file: their kinds and contents, with sums checked bit by bit.
fn chunks(mut bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    while let Some((head, rest)) = bytes.split_at_checked(8) {
        let length = u32::from_be_bytes(head[..4].try_into().unwrap()) as usize;
        let mut sum = u32::MAX;
        for byte in head[4..].iter().chain(&rest[..length]) {
            sum ^= u32::from(*byte);
            for _ in 0..8 {
                sum = (sum >> 1) ^ (0xEDB8_8320 * (sum & 1));
            }
        }
        let expected = u32::from_be_bytes(rest[length..length + 4].try_into().unwrap());
        assert_eq!(!sum, expected);
        found.push((
            String::from_utf8(head[4..].to_vec()).unwrap(),
            rest[..length].to_vec(),
        ));
        bytes = &rest[length + 4..];
    }
    found
}

/// What a zlib stream of stored blocks holds.
fn stored(stream: &[u8]) -> Vec<u8> {
    assert_eq!(&stream[..2], [0x78, 0x01]);
    let (mut at, mut held) = (2, Vec::new());
    loop {
        let length = u16::from_le_bytes([stream[at + 1], stream[at + 2]]);
        assert_eq!(
            !length,
            u16::from_le_bytes([stream[at + 3], stream[at + 4]])
        );
        let end = at + 5 + usize::from(length);
        held.extend_from_slice(&stream[at + 5..end]);
        if stream[at] == 1 {
            let (mut low, mut high) = (1u64, 0u64);
            for &byte in &held {
                low = (low + u64::from(byte)) % 65521;
                high = (high + low) % 65521;
            }
            assert_eq!(stream[end..], (high << 16 | low).to_be_bytes()[4..]);
            return held;
        }
        at = end;
    }
}

#[test]
fn pictures_of_maps_show_their_cells() {
    let cobject = arm_among_boxes();
    let [a, b] = turns(1);
    // Several blocks of a zlib stream.
    let axes = [with_cells(a, 600), with_cells(b, 130)];
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("map.png");
    for kind in [MapKind::Classes, MapKind::Cells, MapKind::Distances] {
        let made = map(&cobject, &[0.0; 2], &axes, &of_kind(kind));
        made.show(&file).unwrap();
        let bytes = std::fs::read(&file).unwrap();
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        let chunks = chunks(&bytes[8..]);
        let (first, header) = &chunks[0];
        assert_eq!((&first[..], header.len()), ("IHDR", 13));
        assert_eq!(
            header[..8],
            [
                0,
                0,
                600u16.to_be_bytes()[0],
                600u16.to_be_bytes()[1],
                0,
                0,
                0,
                130
            ]
        );
        assert_eq!(chunks.last().unwrap().0, "IEND");
        let all: Vec<u8> = chunks
            .iter()
            .filter(|(kind, _)| kind == "IDAT")
            .flat_map(|(_, content)| content.clone())
            .collect();
        let rows = stored(&all);
        assert_eq!(rows.len(), 130 * 601);
        for (i, cell) in cells(&axes).iter().enumerate() {
            let pixel = rows[(129 - cell[1]) * 601 + 1 + cell[0]];
            match made.values() {
                MapValues::Classes(values) | MapValues::Cells(values) => {
                    assert_eq!(pixel, values[i]);
                }
                MapValues::Distances(values) => assert_eq!(pixel == 0, values[i] == 0.0),
            }
        }
        if let Some(kept) = std::env::var_os("CSTK_MAP_PICTURES") {
            let kept = std::path::Path::new(&kept).join(format!("{kind:?}.png"));
            std::fs::copy(&file, kept).unwrap();
        }
    }
    let line = map(&cobject, &[0.0; 2], &axes[..1], &of_kind(MapKind::Classes));
    assert_eq!(line.show(&file).unwrap_err().kind, ErrorKind::Unsupported);
}
