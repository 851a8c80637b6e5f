//! Where the mesh files of a URDF file are.

use std::path::{Path, PathBuf};

use crate::error::{Error, ErrorKind, Result};

/// The file that a mesh's name in a URDF file stands for. `package://name/rest` (and `model://`) is looked for as `name/rest`
/// in the folders given, as `rest` in those of them that are called `name`, and likewise in the folders that hold the URDF
/// file; `file://` names a path, and other names are relative to the URDF file.
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
