//! A folder of built bodies, each stored under a digest of its input.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::body::Body;
use super::file::{MAX_FILE_BYTES, VERSION};
use crate::error::{Error, Result};
use crate::whole_file::{read_whole, write_whole};

const MAGIC: [u8; 8] = *b"cstkkept";

/// The SHA-256 digest of everything a body is built from. Bodies with equal keys are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BodyKey([u8; 32]);

impl BodyKey {
    /// The key of a description that names everything the body depends on. The versions of this library and of its body
    /// files are part of every key.
    pub fn of(description: &str) -> Self {
        let library = env!("CARGO_PKG_VERSION");
        Self(Sha256::digest(format!("{library} {VERSION}\n{description}")).into())
    }

    /// The digest of a file's content, for a description.
    pub fn digest(bytes: &[u8]) -> String {
        hexadecimal(&Sha256::digest(bytes).into())
    }
}

fn hexadecimal(digest: &[u8; 32]) -> String {
    digest.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// A folder of built bodies. Each file holds the key and a body file; a file that is damaged or has another key is ignored.
#[derive(Debug)]
pub struct BodyCache {
    folder: PathBuf,
}

impl BodyCache {
    /// Opens a folder, and creates it if it does not exist.
    pub fn open(folder: &Path) -> Result<Self> {
        let failed = |e: std::io::Error| Error::io(e).within(folder.display());
        std::fs::create_dir_all(folder).map_err(failed)?;
        // `create_dir_all` accepts an empty name; this does not.
        std::fs::read_dir(folder).map_err(failed)?;
        Ok(Self {
            folder: folder.to_path_buf(),
        })
    }

    /// The body stored under a key.
    pub fn load(&self, key: &BodyKey) -> Option<Body> {
        let bytes = read_whole(&self.path(key), MAX_FILE_BYTES).ok()?;
        let (magic, rest) = bytes.split_at_checked(MAGIC.len())?;
        let (its_key, body) = rest.split_at_checked(key.0.len())?;
        (magic == MAGIC && its_key == key.0)
            .then(|| Body::from_bytes(body).ok())
            .flatten()
    }

    /// Stores a body. A file of the same key is replaced.
    pub fn store(&self, key: &BodyKey, body: &Body) -> Result<()> {
        let content = [&MAGIC[..], &key.0, &body.to_bytes()?].concat();
        write_whole(&self.path(key), &content)
    }

    fn path(&self, key: &BodyKey) -> PathBuf {
        self.folder.join(format!("{}.body", hexadecimal(&key.0)))
    }
}
