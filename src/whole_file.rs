//! Files that are written whole or not at all.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::error::{Error, ErrorKind, Result};

/// Writes beside the file and renames, so that no reader ever sees half of it. A file of that name is replaced.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let failed =
        |error: std::io::Error| Error::new(ErrorKind::Io, format!("{}: {error}", path.display()));
    if path.is_dir() {
        return Err(Error::new(
            ErrorKind::Io,
            format!("{} is a folder", path.display()),
        ));
    }
    // Threads may write under one name at the same time.
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let beside = path.with_file_name(format!(".cstk-{}-{number}.part", std::process::id()));
    std::fs::write(&beside, bytes)
        .and_then(|()| std::fs::rename(&beside, path))
        .map_err(|error| {
            let _ = std::fs::remove_file(&beside);
            failed(error)
        })
}
