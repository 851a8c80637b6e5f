//! Where a configuration stands with respect to a C-object.

/// The order is that of the set algebra: a union takes the maximum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Farther from contact than the contact epsilon.
    Outside,
    /// Apart, but within the contact epsilon.
    Contact,
    /// The closed sets meet.
    Inside,
}
