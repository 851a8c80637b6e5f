//! FCL and Coal as libraries to open: benches/peers builds them.

use std::ffi::{CString, c_char, c_int, c_void};

use super::case::Triangles;

/// A library of benches/peers, open until the program ends.
pub struct Library {
    handle: *mut c_void,
    prefix: &'static str,
}

unsafe extern "C" {
    fn dlopen(file: *const c_char, flags: c_int) -> *mut c_void;
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

impl Library {
    pub fn open(name: &str, prefix: &'static str) -> Option<Self> {
        let file = format!(
            "{}/build/peers/lib{prefix}_peer.so",
            env!("CARGO_MANIFEST_DIR")
        );
        let path = CString::new(file.clone()).expect("a path without NUL");
        const NOW: c_int = 2;
        // SAFETY: the library is ours; its constructors are those of C++ libraries.
        let handle = unsafe { dlopen(path.as_ptr(), NOW) };
        if handle.is_null() {
            eprintln!("LEFT OUT: {name}, for there is no {file}");
            return None;
        }
        Some(Self { handle, prefix })
    }

    /// The function whose name has the library's prefix and this end.
    pub fn symbol(&self, suffix: &str) -> *mut c_void {
        let name = CString::new(format!("{}_{suffix}", self.prefix)).expect("a name without NUL");
        // SAFETY: the library stays open.
        let found = unsafe { dlsym(self.handle, name.as_ptr()) };
        assert!(!found.is_null(), "{name:?} is missing");
        found
    }
}

/// `peer_mesh` of peers.h.
#[repr(C)]
pub struct PeerMesh {
    vertices: *const f64,
    vertex_count: usize,
    triangles: *const u32,
    triangle_count: usize,
}

impl PeerMesh {
    pub fn of(mesh: &Triangles) -> Self {
        Self {
            vertices: mesh.vertices.as_ptr(),
            vertex_count: mesh.vertices.len() / 3,
            triangles: mesh.triangles.as_ptr(),
            triangle_count: mesh.triangles.len() / 3,
        }
    }
}
