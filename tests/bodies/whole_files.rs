//! Files as the library writes and reads them: whole, at the names that were meant, and never waiting for ever.
#![cfg(unix)]

use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cstk::body::mesh_file::read_mesh_file;
use cstk::body::{Body, BodyBuilder};
use cstk::error::{Error, ErrorKind};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::robot::RobotBuilder;
use cstk::urdf::{UrdfOptions, add_urdf_file};

/// A folder of its own that goes when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("cstk-whole-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::set_permissions(&self.0, fs::Permissions::from_mode(0o700));
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn fifo(path: &Path) {
    let status = std::process::Command::new("mkfifo").arg(path).status();
    assert!(status.unwrap().success());
}

fn body() -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    for i in 0..50 {
        let x = f64::from(i);
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(y, z)| Vec3::new(x, y, z));
        builder.add_polygon(&corners, i as u64).unwrap();
    }
    builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap()
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o7777
}

fn refused<T>(result: Result<T, Error>, path: &Path, culprit: &str) {
    let error = result.err().expect("this was accepted");
    assert_eq!(error.kind, ErrorKind::Io, "{error}");
    for part in [path.to_str().unwrap(), culprit] {
        assert!(error.message.contains(part), "{error} names no {part}");
    }
}

#[test]
fn links_planted_in_the_folder_are_not_followed() {
    let folder = Folder::new("planted");
    let victim = folder.path("victim");
    fs::write(&victim, "precious").unwrap();
    // The names that a counter and a process number would give.
    for number in 0..100 {
        let name = format!(".cstk-{}-{number}.part", std::process::id());
        symlink(&victim, folder.path(&name)).unwrap();
    }
    let file = folder.path("body.cstk");
    body().save(&file).unwrap();
    assert_eq!(fs::read(&victim).unwrap(), b"precious");
    assert_eq!(Body::load(&file).unwrap().primitives().len(), 50);
    assert!(fs::symlink_metadata(&file).unwrap().is_file());
}

#[test]
fn a_symbolic_link_stays_and_its_target_is_written() {
    let folder = Folder::new("links");
    fs::create_dir(folder.path("there")).unwrap();
    let target = folder.path("there/target");
    let (first, second) = (folder.path("first"), folder.path("second"));
    symlink("second", &first).unwrap();
    symlink("there/target", &second).unwrap();
    // The target does not exist, then it does.
    for _ in 0..2 {
        body().save(&first).unwrap();
        for link in [&first, &second] {
            assert!(fs::symlink_metadata(link).unwrap().is_symlink());
        }
        assert!(fs::symlink_metadata(&target).unwrap().is_file());
        assert!(Body::load(&first).is_ok());
    }
    assert_eq!(folder.names(), ["first", "second", "there"]);
    let circle = folder.path("circle");
    symlink("circle", &circle).unwrap();
    refused(body().save(&circle), &circle, "symbolic links");
}

#[test]
fn what_is_no_regular_file_is_refused_both_ways() {
    let folder = Folder::new("devices");
    let pipe = folder.path("pipe.stl");
    fifo(&pipe);
    let to_null = folder.path("null.stl");
    symlink("/dev/null", &to_null).unwrap();
    let inside = folder.path("folder.stl");
    fs::create_dir(&inside).unwrap();
    let socket = folder.path("socket.stl");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let zero = folder.path("zero.stl");
    symlink("/dev/zero", &zero).unwrap();
    let cases = [
        (&pipe, "regular"),
        (&to_null, "regular"),
        (&zero, "regular"),
        (&inside, "folder"),
        (&socket, ""),
    ];
    for (path, culprit) in cases {
        refused(body().save(path), path, culprit);
        refused(Body::load(path), path, culprit);
        refused(
            BodyBuilder::new(3)
                .unwrap()
                .add_mesh_file(path, &Pose::identity(), &Vec3::repeat(1.0)),
            path,
            culprit,
        );
        assert_eq!(read_mesh_file(path).unwrap_err().kind, ErrorKind::Io);
        let urdf = |path: &Path| {
            let mut builder = RobotBuilder::new(3).unwrap();
            add_urdf_file(&mut builder, path, &UrdfOptions::default(), &mut |_| Ok(()))
        };
        refused(urdf(path), path, culprit);
        let robot = folder.path("robot.urdf");
        let name = path.file_name().unwrap().to_str().unwrap();
        let text = format!(
            "<robot><link name=\"a\"><collision><geometry><mesh filename=\"{name}\"/></geometry></collision></link></robot>"
        );
        fs::write(&robot, text).unwrap();
        let error = urdf(&robot).unwrap_err();
        assert!(error.message.contains(name), "{error}");
    }
    assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
    assert!(
        fs::metadata("/dev/null")
            .unwrap()
            .file_type()
            .is_char_device()
    );
    assert!(fs::symlink_metadata(&to_null).unwrap().is_symlink());
}

#[test]
fn a_replaced_file_keeps_its_mode_and_a_new_one_has_the_default() {
    let folder = Folder::new("modes");
    // What the umask makes of a new file, as the standard library makes it.
    let plain = folder.path("plain");
    fs::write(&plain, "").unwrap();
    let new = folder.path("new");
    body().save(&new).unwrap();
    assert_eq!(mode(&new), mode(&plain));
    for wanted in [0o600, 0o640, 0o666, 0o755, 0o444] {
        let file = folder.path("replaced");
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(wanted)).unwrap();
        body().save(&file).unwrap();
        assert_eq!(mode(&file), wanted, "{wanted:o}");
        assert!(Body::load(&file).is_ok());
        fs::remove_file(&file).unwrap();
    }
    assert_eq!(folder.names(), ["new", "plain"]);
}

#[test]
fn failures_leave_nothing_behind() {
    let folder = Folder::new("readonly");
    let nowhere = folder.path("nowhere/body");
    refused(body().save(&nowhere), &nowhere, "");
    let locked = folder.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::write(locked.join("body"), "old").unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o500)).unwrap();
    // Who may write everywhere is not kept out.
    if fs::write(locked.join("probe"), "").is_err() {
        refused(body().save(&locked.join("body")), &locked, "denied");
        assert_eq!(fs::read(locked.join("body")).unwrap(), b"old");
    }
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o700)).unwrap();
    let _ = fs::remove_file(locked.join("probe"));
    let names: Vec<_> = fs::read_dir(&locked).unwrap().collect();
    assert_eq!(names.len(), 1);
    // A name of any bytes.
    let odd = folder.0.join(std::ffi::OsStr::from_bytes(b"\xff\xfe"));
    body().save(&odd).unwrap();
    assert!(Body::load(&odd).is_ok());
}

#[test]
fn of_many_writers_one_wins_whole() {
    let folder = Folder::new("writers");
    let file = folder.path("body");
    let shared = Arc::new(body());
    shared.save(&file).unwrap();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..20 {
                    shared.save(&file).unwrap();
                    assert_eq!(Body::load(&file).unwrap().primitives().len(), 50);
                }
            });
        }
    });
    assert_eq!(folder.names(), ["body"]);
}

/// Keywords of any case; and nothing behind the numbers.
#[test]
fn ascii_stl_is_read_whole_or_not() {
    let folder = Folder::new("stl");
    let facet = |first: &str| {
        format!(
            "SOLID it\n FACET NORMAL 0 0 1\n OUTER LOOP\n VERTEX {first}\n VERTEX 1 0 0\n VERTEX 0 1 0\n ENDLOOP\n ENDFACET\nENDSOLID it\n"
        )
    };
    let path = folder.path("upper.stl");
    fs::write(&path, facet("0 0 0")).unwrap();
    assert_eq!(read_mesh_file(&path).unwrap().face_sizes, [3]);
    for damaged in ["0 0 0 0", "0 0 0 more", "0 0 x", "0 0"] {
        fs::write(&path, facet(damaged)).unwrap();
        let error = read_mesh_file(&path).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Parse);
        assert!(error.message.contains("line 4"), "{error}");
    }
}
