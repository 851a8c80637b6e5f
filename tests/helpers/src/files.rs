//! Body files as bytes.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use cstk::body::Body;
use cstk::error::Result;

const HEADER: usize = 32;

/// A file of this process that no other test uses.
fn fresh() -> PathBuf {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    std::env::temp_dir().join(format!("cstk_{}_{number}", std::process::id()))
}

pub fn bytes_of(body: &Body) -> Vec<u8> {
    let path = fresh();
    body.save(&path).unwrap();
    let bytes = std::fs::read(&path);
    std::fs::remove_file(&path).unwrap();
    bytes.unwrap()
}

pub fn body_of(bytes: &[u8]) -> Result<Arc<Body>> {
    let path = fresh();
    std::fs::write(&path, bytes).unwrap();
    let body = Body::load(&path);
    std::fs::remove_file(&path).unwrap();
    body.map(Arc::new)
}

pub fn loaded(body: &Body) -> Arc<Body> {
    body_of(&bytes_of(body)).unwrap()
}

/// CRC-32 as in ISO 3309, bit by bit.
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            sum >> 1 ^ if sum & 1 == 1 { 0xEDB8_8320 } else { 0 }
        })
    })
}

/// Makes length and checksums right, so that the content alone is to blame.
pub fn sign(bytes: &mut [u8]) {
    let length = (bytes.len() - HEADER) as u64;
    bytes[16..24].copy_from_slice(&length.to_le_bytes());
    let sum = checksum(&bytes[HEADER..]);
    bytes[24..28].copy_from_slice(&sum.to_le_bytes());
    let sum = checksum(&bytes[..28]);
    bytes[28..32].copy_from_slice(&sum.to_le_bytes());
}
