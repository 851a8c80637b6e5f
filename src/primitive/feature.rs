//! Features: the vertices, edges and faces of a primitive, by index.

/// Which kind of feature an index counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FeatureKind {
    Vertex,
    Edge,
    Face,
    /// The inside of a solid, where no boundary feature is involved.
    Interior,
    /// The surface of a smooth primitive.
    Surface,
}

/// One feature of one primitive. A polygon has one face; its edge i joins vertices i and i + 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Feature {
    pub kind: FeatureKind,
    pub index: u32,
}

impl Feature {
    pub fn vertex(index: u32) -> Self {
        Self {
            kind: FeatureKind::Vertex,
            index,
        }
    }

    pub fn edge(index: u32) -> Self {
        Self {
            kind: FeatureKind::Edge,
            index,
        }
    }

    pub fn face(index: u32) -> Self {
        Self {
            kind: FeatureKind::Face,
            index,
        }
    }

    pub fn surface() -> Self {
        Self {
            kind: FeatureKind::Surface,
            index: 0,
        }
    }

    pub fn interior() -> Self {
        Self {
            kind: FeatureKind::Interior,
            index: 0,
        }
    }
}
