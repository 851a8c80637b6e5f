//! Which edges and faces of a polytope meet in each of its vertices.

use super::{Convex, Feature};

/// The edges and the faces of each vertex, by number.
#[derive(Clone, Debug)]
pub struct Incidence {
    edges: Lists,
    faces: Lists,
}

/// A list for each vertex, one after another.
#[derive(Clone, Debug)]
struct Lists {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// From pairs of a vertex and an item, in the order of the items.
    fn new(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        for (vertex, _) in pairs.clone() {
            starts[vertex as usize + 1] += 1;
        }
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[count] as usize];
        for (vertex, item) in pairs {
            let place = &mut next[vertex as usize];
            items[*place as usize] = item;
            *place += 1;
        }
        Self { starts, items }
    }

    fn of(&self, vertex: u32) -> &[u32] {
        let [start, end] = [vertex, vertex + 1].map(|i| self.starts[i as usize] as usize);
        &self.items[start..end]
    }

    /// The lowest item that the lists of all given vertices hold.
    fn common(&self, vertices: &[u32]) -> Option<u32> {
        let fewest = vertices
            .iter()
            .min_by_key(|vertex| self.of(**vertex).len())?;
        // The lists are in ascending order.
        let has = |vertex: &u32, item: &u32| self.of(*vertex).binary_search(item).is_ok();
        let is_common = |item: &&u32| vertices.iter().all(|vertex| has(vertex, item));
        self.of(*fewest).iter().find(is_common).copied()
    }
}

impl Incidence {
    /// Of a shape's edges and faces.
    pub fn new(shape: &Convex) -> Self {
        let count = shape.vertices.len();
        let edges = (0..).zip(&shape.edges);
        let faces = (0..).zip(&shape.faces);
        Self {
            edges: Lists::new(count, edges.flat_map(|(e, ends)| ends.map(|v| (v, e)))),
            faces: Lists::new(
                count,
                faces.flat_map(|(f, face)| face.vertices.iter().map(move |v| (*v, f))),
            ),
        }
    }

    /// The edges that end in a vertex, in ascending order.
    pub fn edges_of(&self, vertex: u32) -> &[u32] {
        self.edges.of(vertex)
    }

    /// The faces around a vertex, in ascending order.
    pub fn faces_of(&self, vertex: u32) -> &[u32] {
        self.faces.of(vertex)
    }

    /// The lowest-dimensional feature that holds the given vertices: for two vertices without a common edge, a face. `None` if
    /// only the interior does.
    pub fn feature_of(&self, vertices: &[u32]) -> Option<Feature> {
        match vertices {
            [vertex] => return Some(Feature::vertex(*vertex)),
            [_, _] => {
                if let Some(edge) = self.edges.common(vertices) {
                    return Some(Feature::edge(edge));
                }
            }
            _ => {}
        }
        self.faces.common(vertices).map(Feature::face)
    }

    /// Bytes of memory allocated.
    pub fn bytes(&self) -> usize {
        let lists = [&self.edges, &self.faces];
        lists
            .iter()
            .map(|lists| size_of_val(&lists.starts[..]) + size_of_val(&lists.items[..]))
            .sum()
    }
}
