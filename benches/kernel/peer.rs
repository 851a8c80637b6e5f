//! FCL and Coal, behind benches/peers/peers.h.

use std::ffi::{CStr, c_char, c_int, c_void};

use super::case::{Case, Mode, Triangles};
use super::library::{Library, PeerMesh};
use super::runner::Runner;

/// One of the libraries.
pub struct Peer {
    name: &'static str,
    variant_count: unsafe extern "C" fn(c_int) -> c_int,
    variant_serves: unsafe extern "C" fn(c_int, c_int) -> c_int,
    variant_name: unsafe extern "C" fn(c_int) -> *const c_char,
    scene:
        unsafe extern "C" fn(*const PeerMesh, usize, *const PeerMesh, usize, c_int) -> *mut c_void,
    scene_free: unsafe extern "C" fn(*mut c_void),
    run: unsafe extern "C" fn(*mut c_void, c_int, f64, *const f64, usize, *mut f64) -> f64,
}

impl Peer {
    // The fields say what the symbols are.
    #[allow(clippy::missing_transmute_annotations)]
    pub fn open(name: &'static str, prefix: &'static str) -> Option<Self> {
        let library = Library::open(name, prefix)?;
        let symbol = |suffix: &str| library.symbol(suffix);
        // SAFETY: the types are those of peers.h.
        unsafe {
            Some(Self {
                name,
                variant_count: std::mem::transmute::<*mut c_void, _>(symbol("variant_count")),
                variant_serves: std::mem::transmute::<*mut c_void, _>(symbol("variant_serves")),
                variant_name: std::mem::transmute::<*mut c_void, _>(symbol("variant_name")),
                scene: std::mem::transmute::<*mut c_void, _>(symbol("scene")),
                scene_free: std::mem::transmute::<*mut c_void, _>(symbol("scene_free")),
                run: std::mem::transmute::<*mut c_void, _>(symbol("run")),
            })
        }
    }

    /// All its ways to answer the queries of a case.
    pub fn runners<'a>(&'a self, case: &Case, mode: Mode) -> Vec<Runner<'a>> {
        // SAFETY: plain functions.
        let serves =
            |variant: &c_int| unsafe { (self.variant_serves)(*variant, number(mode)) != 0 };
        // SAFETY: a plain function.
        let count = unsafe { (self.variant_count)(number(mode)) };
        let triangles = [&case.moving, &case.obstacles]
            .map(|meshes| meshes.iter().map(Triangles::of).collect::<Vec<_>>());
        let poses: Vec<f64> = case
            .poses
            .iter()
            .flatten()
            .flat_map(|pose| pose.to_row_major())
            .collect();
        let queries = case.poses.len();
        (0..count)
            .filter(serves)
            .filter_map(|variant| {
                let built = Built::new(self, &triangles, variant)?;
                // SAFETY: the name is a literal of the library.
                let name = unsafe { CStr::from_ptr((self.variant_name)(variant)) };
                let poses = poses.clone();
                Some(Runner::new(self.name, name.to_string_lossy(), move || {
                    built.run(mode, &poses, queries)
                }))
            })
            .collect()
    }
}

fn number(mode: Mode) -> c_int {
    match mode {
        Mode::Distance => 0,
        Mode::Within(_) => 1,
        Mode::Collide => 2,
    }
}

/// A scene of a peer.
struct Built<'a> {
    peer: &'a Peer,
    scene: *mut c_void,
}

impl<'a> Built<'a> {
    fn new(
        peer: &'a Peer,
        [moving, obstacles]: &[Vec<Triangles>; 2],
        variant: c_int,
    ) -> Option<Self> {
        let [moving, obstacles] =
            [moving, obstacles].map(|all| all.iter().map(PeerMesh::of).collect::<Vec<_>>());
        // SAFETY: the meshes live during the call, which copies them.
        let scene = unsafe {
            (peer.scene)(
                moving.as_ptr(),
                moving.len(),
                obstacles.as_ptr(),
                obstacles.len(),
                variant,
            )
        };
        (!scene.is_null()).then_some(Self { peer, scene })
    }

    fn run(&self, mode: Mode, poses: &[f64], queries: usize) -> Option<(f64, Vec<f64>)> {
        let mut answers = vec![0.0; queries];
        let threshold = match mode {
            Mode::Within(threshold) => threshold,
            _ => 0.0,
        };
        let (poses, results) = (poses.as_ptr(), answers.as_mut_ptr());
        // SAFETY: the poses of all moving meshes for each query, and one answer.
        let seconds = unsafe {
            (self.peer.run)(self.scene, number(mode), threshold, poses, queries, results)
        };
        (seconds >= 0.0).then_some((seconds, answers))
    }
}

impl Drop for Built<'_> {
    fn drop(&mut self) {
        // SAFETY: made by the same library, and not used after this.
        unsafe { (self.peer.scene_free)(self.scene) }
    }
}
