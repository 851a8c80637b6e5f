//! What became of a URDF file.

/// What was read from a URDF file, what was built, and what was passed over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UrdfReport {
    /// The number of the root link in the builder.
    pub root: usize,
    /// The `<link>` and `<joint>` elements.
    pub links: usize,
    pub joints: usize,
    /// Links that have a body.
    pub links_with_body: usize,
    /// Links without a body that have shapes of the kind that was not asked for: `<visual>`, or `<collision>`.
    pub links_with_other_shapes: usize,
    /// The bodies of the links: links of equal shapes share theirs.
    pub bodies: usize,
    /// Those of them that were read from the cache folder; the others were built.
    pub bodies_from_cache: usize,
    /// Built bodies that could not be written to the cache folder.
    pub cache_failures: usize,
    /// The shapes of all links.
    pub shapes: usize,
    pub mesh_files: usize,
    /// Primitives of the bodies, those of a shared body once.
    pub primitives: u64,
    /// Mesh faces that became several primitives, and those without area that were left out.
    pub faces_split: u64,
    pub faces_dropped: u64,
    /// Elements in the robot, its links, joints and shapes that were passed over: inertia, materials, transmissions.
    pub skipped_elements: usize,
}
