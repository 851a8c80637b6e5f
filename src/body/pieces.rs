//! The connected pieces of a body.

use super::vertex_numbers::VertexNumbers;
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// Primitives that are one connected set: polygons that share vertices, or a single primitive of another kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The lowest primitive.
    pub lowest: u32,
    /// The first vertex of that primitive, and a vertex of the piece that is farthest from it.
    pub ends: [Vec3; 2],
}

impl Piece {
    /// The piece that is a single point.
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
    /// Per primitive, the index of its piece.
    of: Vec<u32>,
    /// Per scrap, the index of its piece.
    of_scraps: Vec<u32>,
}

impl Pieces {
    /// Finds the pieces. Scraps are rings of vertices that join the polygons they share vertices with.
    pub(super) fn new(primitives: &Primitives, scraps: &[Vec<Vec3>]) -> Self {
        let mut numbers = VertexNumbers::default();
        let mut firsts = Vec::with_capacity(primitives.len());
        // Union-find links of connected vertices; the root is the lowest vertex.
        let mut parents: Vec<u32> = Vec::new();
        let mut join_all = |vertices: &[Vec3]| {
            let mut first = None;
            for vertex in vertices {
                let number = numbers.number(vertex);
                parents.extend(parents.len() as u32..numbers.len() as u32);
                join(&mut parents, *first.get_or_insert(number), number);
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
        let mut piece_at: Vec<Option<u32>> = vec![None; parents.len()];
        for (i, (primitive, first)) in (0..).zip(primitives.iter().zip(firsts)) {
            let next = pieces.list.len() as u32;
            let piece = match first {
                Some(first) => *piece_at[find(&mut parents, first) as usize].get_or_insert(next),
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
        // A scrap is only kept if polygons need it, so it has a piece.
        let of_scrap = |first: Option<u32>| {
            let piece = first.and_then(|first| piece_at[find(&mut parents, first) as usize]);
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

fn find(parents: &mut [u32], vertex: u32) -> u32 {
    let mut root = vertex;
    while parents[root as usize] != root {
        root = parents[root as usize];
    }
    let mut at = vertex;
    while at != root {
        at = std::mem::replace(&mut parents[at as usize], root);
    }
    root
}

fn join(parents: &mut [u32], a: u32, b: u32) {
    let (a, b) = (find(parents, a), find(parents, b));
    parents[a.max(b) as usize] = a.min(b);
}
