//! Where a configuration stands with respect to a C-object.

/// The order is that of the set algebra: a union takes the maximum, an intersection the minimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Farther from contact than the contact epsilon.
    Outside,
    /// Apart, but within the contact epsilon.
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

    /// The same, or reversed.
    pub fn reversed_if(self, reverse: bool) -> Self {
        if reverse { self.reversed() } else { self }
    }
}
