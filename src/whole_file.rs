//! Files that are read whole, and written whole or not at all; line numbers in texts.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use crate::error::{Error, ErrorKind, Result};

/// Symbolic links followed to a destination, at most: the limit of Linux for a path.
const MAX_SYMLINKS: usize = 40;

/// What is written piece by piece is gathered to so many bytes.
const PIECE: usize = 1 << 16;

/// Reads a regular file of at most `max_bytes`. FIFOs and devices are refused at once: reading one could block for ever or
/// never end.
pub fn read_whole(path: &Path, max_bytes: u64) -> Result<Vec<u8>> {
    let file = open_at_once(path).map_err(Error::io)?;
    // The metadata of the open file, even if its name refers to another one by now.
    let metadata = file.metadata().map_err(Error::io)?;
    if metadata.is_dir() {
        return Err(Error::new(ErrorKind::Io, "it is a folder"));
    }
    if !metadata.is_file() {
        return Err(not_regular());
    }
    let too_large = |length: u64| {
        Error::new(
            ErrorKind::Unsupported,
            format!("the file has {length} bytes; at most {max_bytes} are read"),
        )
    };
    if metadata.len() > max_bytes {
        return Err(too_large(metadata.len()));
    }
    let mut bytes = Vec::new();
    let reserved = bytes.try_reserve_exact(metadata.len() as usize);
    reserved.map_err(Error::memory)?;
    // If the file grows meanwhile, reading stops one byte beyond the limit.
    file.take(max_bytes.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(Error::io)?;
    match bytes.len() as u64 {
        length if length > max_bytes => Err(too_large(length)),
        _ => Ok(bytes),
    }
}

/// Opens for reading, without waiting for a FIFO's writer.
fn open_at_once(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true);
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags((OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32);
    }
    options.open(path)
}

/// Writes a temporary file in the destination's folder and renames it, so that no reader ever sees half of it. A regular file
/// of that name is replaced and its mode kept; a symbolic link stays and its target is replaced, as editors do. A destination
/// that is not a regular file is refused. File and folder are synced to disk when this returns.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    write_piecewise(path, |file| file.write_all(bytes))
}

/// The same of what `write` writes, piece by piece.
pub fn write_piecewise(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    write_unnamed(path, write).map_err(|error| error.within(path.display()))
}

fn write_unnamed(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let target = followed(path)?;
    let mode = match fs::symlink_metadata(&target) {
        Ok(there) if there.is_dir() => return Err(Error::new(ErrorKind::Io, "it is a folder")),
        Ok(there) if !there.is_file() => return Err(not_regular()),
        Ok(there) => Some(kept_mode(&there.permissions())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(Error::io(error)),
    };
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".cstk-").suffix(".part");
    // A new file gets the process's default mode; a replacement never has more permissions than the file it replaces.
    if let Some(mode) = mode.clone().or_else(new_mode) {
        builder.permissions(mode);
    }
    let written = builder.tempfile_in(folder).and_then(|mut part| {
        let mut pieces = BufWriter::with_capacity(PIECE, part.as_file_mut());
        write(&mut pieces)?;
        pieces.flush()?;
        drop(pieces);
        if let Some(mode) = mode {
            part.as_file().set_permissions(mode)?;
        }
        part.as_file().sync_all()?;
        part.persist(&target).map_err(|failed| failed.error)
    });
    written.map_err(Error::io)?;
    // The file is complete by now. A folder that is writable but not readable cannot be opened for syncing.
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// The target of the chain of symbolic links that begins at `path`. It need not exist.
fn followed(path: &Path) -> Result<PathBuf> {
    let mut target = path.to_path_buf();
    for _ in 0..=MAX_SYMLINKS {
        let Ok(next) = fs::read_link(&target) else {
            return Ok(target);
        };
        // A relative link is relative to its own folder.
        target = target.parent().unwrap_or(Path::new("")).join(next);
    }
    Err(Error::new(ErrorKind::Io, "too many symbolic links"))
}

fn not_regular() -> Error {
    Error::new(
        ErrorKind::Io,
        "it is no regular file, but a FIFO, socket or device",
    )
}

#[cfg(unix)]
fn kept_mode(permissions: &Permissions) -> Permissions {
    use std::os::unix::fs::PermissionsExt;
    // Without set-user-ID and set-group-ID: the new file may have another owner.
    Permissions::from_mode(permissions.mode() & 0o777)
}

#[cfg(not(unix))]
fn kept_mode(permissions: &Permissions) -> Permissions {
    permissions.clone()
}

/// The mode of new files before the process's umask.
#[cfg(unix)]
fn new_mode() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn new_mode() -> Option<Permissions> {
    None
}

/// The bytes of a file as UTF-8 text.
pub fn text_of(bytes: &[u8]) -> Result<&str> {
    std::str::from_utf8(bytes).map_err(|e| {
        let line = line_of(bytes, e.valid_up_to());
        Error::new(ErrorKind::Parse, format!("line {line}: not UTF-8"))
    })
}

/// The line number of a byte, from 1.
pub fn line_of(bytes: &[u8], place: usize) -> usize {
    1 + bytes[..place].iter().filter(|&&b| b == b'\n').count()
}
