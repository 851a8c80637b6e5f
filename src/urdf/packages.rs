//! Locates the mesh files of a URDF file.

use std::path::{Path, PathBuf};

use crate::error::{Error, ErrorKind, Result};

/// Finds the file that a mesh name stands for. `package://name/rest` (or `model://`) is searched for as `name/rest` in each
/// search folder, as `rest` in a search folder called `name`, and likewise in the URDF file's folder and those above it.
/// `file://` gives a path; other names are relative to the URDF file.
pub fn resolve(name: &str, folder: &Path, search: &[PathBuf]) -> Result<PathBuf> {
    let in_package = name
        .strip_prefix("package://")
        .or_else(|| name.strip_prefix("model://"));
    let candidates: Vec<PathBuf> = match in_package {
        Some(path) => {
            let (package, rest) = path.split_once('/').unwrap_or((path, ""));
            let above = folder.ancestors().map(Path::to_path_buf);
            let within = |place: PathBuf| {
                let is_it = place.file_name().is_some_and(|last| last == package);
                [
                    is_it.then(|| place.join(rest)),
                    Some(place.join(package).join(rest)),
                ]
            };
            let places = search.iter().cloned().chain(above);
            places.flat_map(within).flatten().collect()
        }
        None => vec![folder.join(name.strip_prefix("file://").unwrap_or(name))],
    };
    match candidates.iter().find(|path| path.is_file()) {
        Some(path) => Ok(path.clone()),
        None => {
            let looked: Vec<String> = match in_package {
                Some(_) => search
                    .iter()
                    .map(PathBuf::as_path)
                    .chain([folder])
                    .map(|path| path.display().to_string())
                    .collect(),
                None => vec![candidates[0].display().to_string()],
            };
            Err(Error::new(
                ErrorKind::NotFound,
                format!(
                    "mesh file \"{name}\" not found; looked in {}",
                    looked.join(", ")
                ),
            ))
        }
    }
}
