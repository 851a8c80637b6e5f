//! FCL and Coal, behind benches/peers/shapes.h.

use std::ffi::{CStr, c_char, c_int, c_void};

use super::case::Triangles;
use super::library::{Library, PeerMesh};
use super::question::{Query, Question};
use super::runner::Runner;
use super::shape::{Kind, Shape};

/// `peer_shape` of shapes.h.
#[repr(C)]
struct PeerShape {
    kind: c_int,
    sizes: [f64; 3],
    surface: PeerMesh,
}

/// One of the libraries.
pub struct Peer {
    name: &'static str,
    variant: unsafe extern "C" fn(c_int) -> *const c_char,
    pair: unsafe extern "C" fn(
        *const PeerShape,
        *const PeerShape,
        c_int,
        usize,
        c_int,
    ) -> *mut c_void,
    free: unsafe extern "C" fn(*mut c_void),
    run: unsafe extern "C" fn(*mut c_void, *const f64, *const f64, usize, *mut f64) -> f64,
}

impl Peer {
    // The fields say what the symbols are.
    #[allow(clippy::missing_transmute_annotations)]
    pub fn open(name: &'static str, prefix: &'static str) -> Option<Self> {
        let library = Library::open(name, prefix)?;
        // SAFETY: the types are those of shapes.h.
        unsafe {
            Some(Self {
                name,
                variant: std::mem::transmute::<*mut c_void, _>(library.symbol("pair_variant")),
                pair: std::mem::transmute::<*mut c_void, _>(library.symbol("pair")),
                free: std::mem::transmute::<*mut c_void, _>(library.symbol("pair_free")),
                run: std::mem::transmute::<*mut c_void, _>(library.symbol("pair_run")),
            })
        }
    }

    /// All its ways to answer the question.
    pub fn runners<'a>(&'a self, shapes: &[Shape; 2], question: &'a Question) -> Vec<Runner<'a>> {
        let none = Triangles {
            vertices: Vec::new(),
            triangles: Vec::new(),
        };
        let given = [0, 1].map(|i| peer_shape(&shapes[i], &none));
        let (mode, most) = match question.query {
            Query::Distance => (0, 0),
            Query::Within(_) => (1, 0),
            Query::Collide => (2, 0),
            Query::Contacts(most) => (3, most),
        };
        (0..)
            // SAFETY: a plain function.
            .map(|variant| (variant, unsafe { (self.variant)(variant) }))
            .take_while(|(_, name)| !name.is_null())
            .filter_map(|(variant, name)| {
                // SAFETY: the shapes live during the call, which copies them.
                let pair = unsafe { (self.pair)(&given[0], &given[1], mode, most, variant) };
                let pair = (!pair.is_null()).then_some(Pair { peer: self, pair })?;
                // SAFETY: the name is the library's, for as long as that is open.
                let name = unsafe { CStr::from_ptr(name) }.to_string_lossy();
                Some(Runner::new(self.name, name, move || pair.run(question)))
            })
            .collect()
    }
}

fn peer_shape(shape: &Shape, none: &Triangles) -> PeerShape {
    let (kind, sizes, surface) = match &shape.kind {
        Kind::Sphere { radius } => (0, [*radius, 0.0, 0.0], none),
        Kind::Capsule { radius, length } => (1, [*radius, *length, 0.0], none),
        Kind::Box { half } => (2, *half, none),
        Kind::Cylinder { radius, length } => (3, [*radius, *length, 0.0], none),
        Kind::Cone { radius, length } => (4, [*radius, *length, 0.0], none),
        Kind::Ellipsoid { semi_axes } => (5, *semi_axes, none),
        Kind::Hull(hull) => (6, [0.0; 3], hull),
        Kind::Mesh(mesh) => (7, [0.0; 3], mesh),
        Kind::Cloud { points, radius } => (8, [2.0 * radius, 0.0, 0.0], points),
    };
    PeerShape {
        kind,
        sizes,
        surface: PeerMesh::of(surface),
    }
}

/// Two shapes of a peer.
struct Pair<'a> {
    peer: &'a Peer,
    pair: *mut c_void,
}

impl Pair<'_> {
    fn run(&self, question: &Question) -> Option<(f64, Vec<f64>)> {
        let count = question.placed.len();
        let mut answers = vec![0.0; count];
        // Placements lie as arrays of 24 numbers.
        let poses = question.placed.as_ptr().cast::<f64>();
        let (thresholds, results) = (question.thresholds.as_ptr(), answers.as_mut_ptr());
        // SAFETY: two poses, a threshold and an answer for each query.
        let seconds = unsafe { (self.peer.run)(self.pair, poses, thresholds, count, results) };
        (seconds >= 0.0).then_some((seconds, answers))
    }
}

impl Drop for Pair<'_> {
    fn drop(&mut self) {
        // SAFETY: made by the same library, and not used after this.
        unsafe { (self.peer.free)(self.pair) }
    }
}
