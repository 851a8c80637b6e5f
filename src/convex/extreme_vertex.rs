//! The support vertex of a polytope by hill climbing along its edges.

use crate::pose::Vec3;

/// A hill climb that starts where the last one ended: a step or two if the direction has turned little.
pub struct ExtremeVertex<'a> {
    vertices: &'a [Vec3],
    /// The neighbours of vertex i are `neighbours[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    neighbours: Vec<u32>,
    /// Where the last climbs along a direction and along its opposite ended.
    ends: [u32; 2],
}

impl<'a> ExtremeVertex<'a> {
    pub fn new(vertices: &'a [Vec3], edges: &[[u32; 2]]) -> Self {
        let mut starts = vec![0; vertices.len() + 1];
        for &vertex in edges.as_flattened() {
            starts[vertex as usize + 1] += 1;
        }
        for i in 0..vertices.len() {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0; 2 * edges.len()];
        for &[a, b] in edges {
            for (from, to) in [(a, b), (b, a)] {
                let place = &mut next[from as usize];
                neighbours[*place as usize] = to;
                *place += 1;
            }
        }
        Self {
            vertices,
            starts,
            neighbours,
            ends: [0; 2],
        }
    }

    /// The lowest and highest projection on a direction: for a convex polytope its extent up to rounding, for other sets values
    /// within it.
    pub fn extent_within(&mut self, direction: &Vec3) -> (f64, f64) {
        let [up, down] = self.ends;
        let (up, high) = self.climb(up, direction);
        let (down, low) = self.climb(down, &-direction);
        self.ends = [up, down];
        (-low, high)
    }

    fn climb(&self, from: u32, direction: &Vec3) -> (u32, f64) {
        let mut at = from;
        let mut height = direction.dot(&self.vertices[at as usize]);
        loop {
            let before = at;
            let [start, end] = [at, at + 1].map(|i| self.starts[i as usize] as usize);
            for &next in &self.neighbours[start..end] {
                let there = direction.dot(&self.vertices[next as usize]);
                if there > height {
                    (at, height) = (next, there);
                }
            }
            if at == before {
                return (at, height);
            }
        }
    }
}
