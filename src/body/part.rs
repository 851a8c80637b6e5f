//! Where bodies are that are parts of another body.

use crate::pose::Pose;

/// Where a body stands in the larger one that it is part of. Its primitives follow one another in their own order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPart {
    /// The number of its first primitive in the larger body.
    pub first: u32,
    /// The number of its primitives.
    pub count: u32,
    /// The caller's tag of the part.
    pub tag: u64,
    /// From its frame to that of the larger body, as the callers of both gave them.
    pub pose: Pose,
}

/// The index of the part that a primitive belongs to, among parts in order.
#[inline(always)]
pub(super) fn part_of(parts: &[BodyPart], primitive: u32) -> Option<u32> {
    // Fast path: most bodies have none.
    if parts.is_empty() {
        return None;
    }
    let after = parts.partition_point(|part| part.first <= primitive);
    let index = after.checked_sub(1)?;
    let part = &parts[index];
    (primitive - part.first < part.count).then_some(index as u32)
}
