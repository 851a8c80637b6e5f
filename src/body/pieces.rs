//! What of a body hangs together.

use super::vertex_numbers::VertexNumbers;
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// Primitives that are one connected set: polygons that share vertices, or a single primitive of another kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The lowest primitive.
    pub lowest: u32,
    /// The first vertex of that, and of the piece's vertices one that is farthest from it.
    pub ends: [Vec3; 2],
}

impl Piece {
    /// A point by itself.
    pub(super) fn of_point(primitive: u32, point: &Vec3) -> Self {
        Self {
            lowest: primitive,
            ends: [*point; 2],
        }
    }
}

/// The pieces of a body, which may touch or overlap.
#[derive(Clone, Debug)]
pub struct Pieces {
    /// In the order of their lowest primitives.
    pub list: Vec<Piece>,
    /// The piece of each primitive.
    of: Vec<u32>,
    /// The piece of each scrap.
    of_scraps: Vec<u32>,
}

impl Pieces {
    /// Scraps are rings of vertices that join the polygons which they share vertices with.
    pub(super) fn new(primitives: &Primitives, scraps: &[Vec<Vec3>]) -> Self {
        let mut numbers = VertexNumbers::default();
        let mut firsts = Vec::with_capacity(primitives.len());
        // Vertices that hang together, each towards the first of them.
        let mut above: Vec<u32> = Vec::new();
        let mut join_all = |vertices: &[Vec3]| {
            let mut first = None;
            for vertex in vertices {
                let number = numbers.number(vertex);
                above.extend(above.len() as u32..numbers.len() as u32);
                join(&mut above, *first.get_or_insert(number), number);
            }
            first
        };
        for primitive in primitives.iter() {
            let is_polygon = primitive.shape.faces.len() == 1;
            firsts.push(is_polygon.then(|| join_all(primitive.vertices)).flatten());
        }
        let scrap_firsts: Vec<Option<u32>> = scraps.iter().map(|scrap| join_all(scrap)).collect();
        let mut pieces = Self {
            list: Vec::new(),
            of: Vec::with_capacity(primitives.len()),
            of_scraps: Vec::new(),
        };
        let mut piece_at: Vec<Option<u32>> = vec![None; above.len()];
        for (i, (primitive, first)) in (0..).zip(primitives.iter().zip(firsts)) {
            let next = pieces.list.len() as u32;
            let piece = match first {
                Some(first) => *piece_at[find(&mut above, first) as usize].get_or_insert(next),
                None => next,
            };
            if piece == next {
                let end = primitive.vertices[0];
                pieces.list.push(Piece {
                    lowest: i,
                    ends: [end, end],
                });
            }
            pieces.of.push(piece);
            let [start, end] = &mut pieces.list[piece as usize].ends;
            for vertex in primitive.vertices {
                if (vertex - *start).norm_squared() > (*end - *start).norm_squared() {
                    *end = *vertex;
                }
            }
        }
        // A scrap is there for the polygons around it.
        let of_scrap = |first: Option<u32>| {
            let piece = first.and_then(|first| piece_at[find(&mut above, first) as usize]);
            piece.unwrap_or(0)
        };
        pieces.of_scraps = scrap_firsts.into_iter().map(of_scrap).collect();
        pieces
    }

    /// The piece that a primitive belongs to.
    pub fn of(&self, primitive: u32) -> u32 {
        self.of[primitive as usize]
    }

    /// The piece that a scrap belongs to.
    pub fn of_scrap(&self, scrap: usize) -> u32 {
        self.of_scraps[scrap]
    }
}

fn find(above: &mut [u32], vertex: u32) -> u32 {
    let mut root = vertex;
    while above[root as usize] != root {
        root = above[root as usize];
    }
    let mut at = vertex;
    while at != root {
        at = std::mem::replace(&mut above[at as usize], root);
    }
    root
}

fn join(above: &mut [u32], a: u32, b: u32) {
    let (a, b) = (find(above, a), find(above, b));
    above[a.max(b) as usize] = a.min(b);
}
