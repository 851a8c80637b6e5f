//! Finds which flat polygons share an edge, by the coordinates of its ends.

use foldhash::{HashMap, HashMapExt};

use crate::pose::Vec3;
use crate::primitive::Convex;

/// An edge of a polygon, and the polygon on its other side.
#[derive(Clone, Copy, Debug)]
pub struct Neighbour {
    pub polygon: u32,
    /// Whether the two polygons run along the edge in opposite directions, as neighbours on an oriented surface do.
    pub opposite: bool,
    pub length: f64,
}

/// The edges shared by a body's flat polygons. Edges of more than two polygons are ignored.
pub struct SharedEdges {
    /// Per primitive, its neighbours; empty for solids, segments and points.
    pub neighbours: Vec<Vec<Neighbour>>,
    /// Per primitive, whether each of its edges has exactly one neighbour, in the opposite direction.
    pub closed: Vec<bool>,
    /// Per primitive, its vertices as indices into `points`; equal coordinates have equal indices.
    pub vertices: Vec<Vec<u32>>,
    pub points: Vec<Vec3>,
}

pub fn is_flat(primitive: &Convex) -> bool {
    primitive.is_flat()
}

impl SharedEdges {
    pub fn of(primitives: &[Convex]) -> Self {
        let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
        let mut points = Vec::new();
        let mut number = |p: &Vec3| {
            // Adding 0 makes -0 the same as 0.
            let key = [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
            *numbers.entry(key).or_insert_with(|| {
                points.push(*p);
                (points.len() - 1) as u32
            })
        };
        // The ends in ascending order, the polygon, and whether it runs from the lower end to the higher.
        let mut uses: Vec<([u32; 2], u32, bool)> = Vec::new();
        let mut vertices = Vec::with_capacity(primitives.len());
        for (i, primitive) in primitives.iter().enumerate() {
            let own: Vec<u32> = primitive
                .bounding_points()
                .iter()
                .map(&mut number)
                .collect();
            if is_flat(primitive) {
                for edge in &primitive.edges {
                    let [a, b] = edge.map(|k| own[k as usize]);
                    uses.push(([a.min(b), a.max(b)], i as u32, a < b));
                }
            }
            vertices.push(own);
        }
        uses.sort_unstable();
        let mut neighbours = vec![Vec::new(); primitives.len()];
        let mut closed: Vec<bool> = primitives.iter().map(is_flat).collect();
        for family in uses.chunk_by(|a, b| a.0 == b.0) {
            let [a, b] = *family else {
                for &(_, polygon, _) in family {
                    closed[polygon as usize] = false;
                }
                continue;
            };
            let [from, to] = a.0.map(|k| points[k as usize]);
            let (opposite, length) = (a.2 != b.2, (to - from).norm());
            for (own, other) in [(a.1, b.1), (b.1, a.1)] {
                closed[own as usize] &= opposite;
                neighbours[own as usize].push(Neighbour {
                    polygon: other,
                    opposite,
                    length,
                });
            }
        }
        Self {
            neighbours,
            closed,
            vertices,
            points,
        }
    }

    /// The connected components over shared edges: lists of primitives, each ascending.
    pub fn components(&self) -> Vec<Vec<u32>> {
        let mut seen = vec![false; self.neighbours.len()];
        let mut components = Vec::new();
        for seed in 0..seen.len() {
            if std::mem::replace(&mut seen[seed], true) {
                continue;
            }
            let mut component = vec![seed as u32];
            let mut next = 0;
            while next < component.len() {
                for neighbour in &self.neighbours[component[next] as usize] {
                    if !std::mem::replace(&mut seen[neighbour.polygon as usize], true) {
                        component.push(neighbour.polygon);
                    }
                }
                next += 1;
            }
            component.sort_unstable();
            components.push(component);
        }
        components
    }
}
