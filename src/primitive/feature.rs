//! Features: the vertices, edges and faces of a primitive, by index.

/// Which kind of feature an index counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum FeatureKind {
    /// A vertex.
    Vertex,
    /// An edge.
    Edge,
    /// A face.
    Face,
    /// The inside of a solid, where no boundary feature is involved.
    Interior,
    /// The surface of a smooth primitive.
    Surface,
}

/// One feature of one primitive. A polygon has one face; its edge i joins vertices i and i + 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Feature {
    /// What the index counts.
    pub kind: FeatureKind,
    /// The index among the primitive's features of this kind; 0 for an interior or a surface.
    pub index: u32,
}

impl Feature {
    /// The vertex of this index.
    pub fn vertex(index: u32) -> Self {
        Self {
            kind: FeatureKind::Vertex,
            index,
        }
    }

    /// The edge of this index.
    pub fn edge(index: u32) -> Self {
        Self {
            kind: FeatureKind::Edge,
            index,
        }
    }

    /// The face of this index.
    pub fn face(index: u32) -> Self {
        Self {
            kind: FeatureKind::Face,
            index,
        }
    }

    /// The surface of a smooth primitive.
    pub fn surface() -> Self {
        Self {
            kind: FeatureKind::Surface,
            index: 0,
        }
    }

    /// The inside of a solid.
    pub fn interior() -> Self {
        Self {
            kind: FeatureKind::Interior,
            index: 0,
        }
    }
}
