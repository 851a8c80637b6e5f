//! The report on a loaded URDF file.

/// What was read from a URDF file, what was built, and what was skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UrdfReport {
    /// The number of the root link in the builder.
    pub root: usize,
    /// The number of `<link>` elements.
    pub links: usize,
    /// The number of `<joint>` elements.
    pub joints: usize,
    /// Links that have a body.
    pub links_with_body: usize,
    /// Links without a body that have shapes of the kind not requested: `<visual>`, or `<collision>`.
    pub links_with_other_shapes: usize,
    /// The number of different bodies: links with equal shapes share one.
    pub bodies: usize,
    /// Bodies whose meshes are closed and became solids, as the options ask.
    pub solid_bodies: usize,
    /// Bodies read from the cache folder; the others were built.
    pub bodies_from_cache: usize,
    /// Built bodies that could not be written to the cache folder.
    pub cache_failures: usize,
    /// The number of shapes of all links.
    pub shapes: usize,
    /// The number of different mesh files.
    pub mesh_files: usize,
    /// The number of primitives; those of a shared body count once.
    pub primitives: u64,
    /// Mesh faces that were split into several primitives.
    pub faces_split: u64,
    /// Mesh faces without area, which were left out.
    pub faces_dropped: u64,
    /// Elements of the robot, its links, joints and shapes that were skipped: inertia, materials, transmissions.
    pub skipped_elements: usize,
}
