//! URDF files in a folder of their own, and the robots that they make.

use std::path::{Path, PathBuf};

use cstk::error::{Error, ErrorKind};
use cstk::robot::{Robot, RobotBuilder};
use cstk::urdf::{UrdfOptions, add_urdf_file};

/// A folder of its own that goes when the test ends.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("cstk-urdf-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub fn load(path: &Path, options: &UrdfOptions) -> Result<Robot, Error> {
    let mut builder = RobotBuilder::new(3).unwrap();
    let added = add_urdf_file(&mut builder, path, options, &mut |_| Ok(()));
    if added.is_err() {
        assert!(builder.links().is_empty());
    }
    added?;
    builder.build()
}

pub fn robot(name: &str, body: &str) -> Result<Robot, Error> {
    let folder = Folder::new(name);
    let path = folder.write(
        "robot.urdf",
        format!("<robot name=\"r\">\n{body}\n</robot>\n"),
    );
    load(&path, &UrdfOptions::default())
}

pub fn refused(name: &str, body: &str, kind: ErrorKind, culprits: &[&str]) {
    let error = robot(name, body)
        .err()
        .unwrap_or_else(|| panic!("{body} was accepted"));
    assert_eq!(error.kind, kind, "{error}");
    for culprit in culprits.iter().chain(&["robot.urdf"]) {
        assert!(
            error.message.contains(culprit),
            "{error} names no {culprit}"
        );
    }
}
