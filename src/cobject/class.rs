//! The class of a configuration with respect to a C-object.

/// Outside, in contact or inside. The order is that of the set algebra: a union takes the maximum, an intersection the
/// minimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Farther away than the contact epsilon.
    Outside,
    /// Apart, but no farther than the contact epsilon.
    Contact,
    /// The closed sets meet.
    Inside,
}

impl Class {
    /// The class with respect to the complement.
    pub fn reversed(self) -> Self {
        match self {
            Self::Outside => Self::Inside,
            Self::Contact => Self::Contact,
            Self::Inside => Self::Outside,
        }
    }

    /// The class itself, or reversed.
    pub fn reversed_if(self, reverse: bool) -> Self {
        if reverse { self.reversed() } else { self }
    }
}
