//! Numbers vertices by their coordinates: equal coordinates get equal numbers.

use std::collections::HashMap;

use foldhash::fast::RandomState;

use crate::pose::Vec3;

#[derive(Default)]
pub struct VertexNumbers(HashMap<[u64; 3], u32, RandomState>);

impl VertexNumbers {
    /// The number of a vertex: 0 for the first, the next one for each new vertex.
    pub fn number(&mut self, p: &Vec3) -> u32 {
        // Adding 0 makes -0 the same as 0.
        let key = [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
        let next = self.0.len() as u32;
        *self.0.entry(key).or_insert(next)
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }
}
