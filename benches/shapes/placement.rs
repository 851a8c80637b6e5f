//! Where both bodies are.

/// The poses of both bodies in the world.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Placement {
    pub poses: [[f64; 12]; 2],
}

impl Placement {
    pub fn pointers(&self) -> [*const f64; 2] {
        [self.poses[0].as_ptr(), self.poses[1].as_ptr()]
    }
}
