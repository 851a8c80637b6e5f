//! Locates the mesh files of a URDF file.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::error::{Error, ErrorKind, Result};

/// The folders in which the packages of `package://` names are looked for.
pub struct PackageFolders<'a> {
    /// The URDF file's folder; `None` for a text that comes from no file.
    folder: Option<&'a Path>,
    /// The folders that the caller names; they come first.
    search: &'a [PathBuf],
    workspace: Workspace,
    /// The folders below `ROS_PACKAGE_PATH` that have a package's name.
    crawled: HashMap<String, Vec<PathBuf>>,
}

/// The folders that ROS's environment variables list.
#[derive(Default)]
struct Workspace {
    /// `AMENT_PREFIX_PATH`: a package is `share/<name>` below one of them.
    prefixes: Vec<PathBuf>,
    /// `ROS_PACKAGE_PATH`: a package is one of them, or a folder below.
    roots: Vec<PathBuf>,
}

/// How deep below a folder of `ROS_PACKAGE_PATH` packages are looked for: `src/repository/group/package`.
const MAX_DEPTH: usize = 4;

/// At most 2^14 folders are looked into for one package; a workspace has some thousand.
const MAX_FOLDERS: usize = 1 << 14;

impl<'a> PackageFolders<'a> {
    /// Reads ROS's environment variables.
    pub fn new(folder: Option<&'a Path>, search: &'a [PathBuf]) -> Self {
        let listed = |name: &str| -> Vec<PathBuf> {
            let value = std::env::var_os(name).unwrap_or_default();
            let paths = std::env::split_paths(&value);
            paths.filter(|path| !path.as_os_str().is_empty()).collect()
        };
        Self {
            folder,
            search,
            workspace: Workspace {
                prefixes: listed("AMENT_PREFIX_PATH"),
                roots: listed("ROS_PACKAGE_PATH"),
            },
            crawled: HashMap::new(),
        }
    }

    /// Finds the file that a mesh name stands for. `package://name/rest` (or `model://`) is searched for as `name/rest` in
    /// each search folder, as `rest` in a search folder called `name`, likewise in the URDF file's folder and those above
    /// it, then where ROS's environment variables lead. `file://` gives a path; other names are relative to the URDF file.
    pub fn resolve(&mut self, name: &str) -> Result<PathBuf> {
        let in_package = name
            .strip_prefix("package://")
            .or_else(|| name.strip_prefix("model://"));
        let found = match in_package {
            Some(path) => self.in_package(path),
            None => self.beside(name).filter(|path| path.is_file()),
        };
        found.ok_or_else(|| {
            let looked = match in_package {
                Some(path) => {
                    let package = path.split_once('/').map_or(path, |(package, _)| package);
                    format!("for a folder \"{package}\" with it in {}", self.looked_in())
                }
                None => match self.beside(name) {
                    Some(path) => format!("in {}", path.display()),
                    None => "in no folder: a text has none unless it is given".to_string(),
                },
            };
            Error::new(
                ErrorKind::NotFound,
                format!("mesh file \"{name}\" not found; looked {looked}"),
            )
        })
    }

    /// The path of a name that is in no package.
    fn beside(&self, name: &str) -> Option<PathBuf> {
        let path = Path::new(name.strip_prefix("file://").unwrap_or(name));
        match self.folder {
            Some(folder) => Some(folder.join(path)),
            None => path.is_absolute().then(|| path.to_path_buf()),
        }
    }

    fn in_package(&mut self, path: &str) -> Option<PathBuf> {
        let (package, rest) = path.split_once('/').unwrap_or((path, ""));
        let above = self.folder.into_iter().flat_map(Path::ancestors);
        let places = self.search.iter().map(PathBuf::as_path).chain(above);
        let within = |place: &Path| {
            let is_it = place.file_name().is_some_and(|last| last == package);
            [
                is_it.then(|| place.join(rest)),
                Some(place.join(package).join(rest)),
            ]
        };
        let share = self.workspace.prefixes.iter();
        let share = share.map(|prefix| prefix.join("share").join(package).join(rest));
        let mut candidates = places.flat_map(within).flatten().chain(share);
        if let Some(found) = candidates.find(|path| path.is_file()) {
            return Some(found);
        }
        if !self.crawled.contains_key(package) {
            let folders = self.workspace.crawl(package);
            self.crawled.insert(package.to_string(), folders);
        }
        let mut candidates = self.crawled[package].iter().map(|place| place.join(rest));
        candidates.find(|path| path.is_file())
    }

    fn looked_in(&self) -> String {
        let places = self.search.iter().map(PathBuf::as_path);
        let lists = [
            ("AMENT_PREFIX_PATH", &self.workspace.prefixes),
            ("ROS_PACKAGE_PATH", &self.workspace.roots),
        ];
        let variables = lists.into_iter().map(|(variable, folders)| {
            let folders: Vec<String> = folders.iter().map(|f| f.display().to_string()).collect();
            match folders.is_empty() {
                true => format!("{variable} (empty)"),
                false => format!("{variable} ({})", folders.join(":")),
            }
        });
        let places = places.map(|path| path.display().to_string());
        let above = self.folder;
        let above = above.map(|path| format!("{} and the folders above it", path.display()));
        places
            .chain(above)
            .chain(variables)
            .collect::<Vec<_>>()
            .join(", ")
    }
}

impl Workspace {
    /// The folders below the roots, and the roots themselves, that have the package's name: breadth first, in
    /// alphabetical order.
    fn crawl(&self, package: &str) -> Vec<PathBuf> {
        let mut found = Vec::new();
        let mut level = self.roots.clone();
        let mut looked = 0;
        for _ in 0..=MAX_DEPTH {
            let mut next = Vec::new();
            for folder in level {
                if folder.file_name() == Some(OsStr::new(package)) {
                    found.push(folder.clone());
                }
                // There is no package inside another.
                let is_full = looked == MAX_FOLDERS || next.len() > MAX_FOLDERS;
                if is_full || folder.join("package.xml").is_file() {
                    continue;
                }
                looked += 1;
                next.extend(folders_in(&folder));
            }
            level = next;
        }
        found
    }
}

/// The folders in a folder but for hidden ones, in alphabetical order; none if it cannot be read.
fn folders_in(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    // Through links too, as workspaces have them: the depth ends circles.
    let is_folder = |entry: &std::fs::DirEntry| entry.path().is_dir();
    let is_hidden =
        |entry: &std::fs::DirEntry| entry.file_name().as_encoded_bytes().starts_with(b".");
    let entries = entries.flatten().take(MAX_FOLDERS);
    let mut folders: Vec<PathBuf> = entries
        .filter(|entry| is_folder(entry) && !is_hidden(entry))
        .map(|entry| entry.path())
        .collect();
    folders.sort();
    folders
}
