//! Which vertices of a solid's boundary must stay together when they move.

use super::solid::Solid;
use super::vertex_numbers::VertexNumbers;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// Which vertices of a solid's boundary are one, by the places of the vertices among all of the body.
#[derive(Debug)]
pub(super) struct Joints {
    /// Of each vertex, the first one with the same coordinates. Vertices that no boundary uses are their own.
    same_as: Vec<u32>,
    /// Of the vertices of each scrap, a vertex of the body with the same coordinates, if there is one.
    scraps: Vec<Vec<Option<u32>>>,
}

impl Joints {
    pub fn of(primitives: &Primitives, solid: &Solid) -> Self {
        let mut numbers = VertexNumbers::default();
        // Of each numbered vertex, its place.
        let mut places: Vec<u32> = Vec::new();
        let mut same_as = Vec::with_capacity(primitives.vertex_count());
        for (i, primitive) in (0..).zip(primitives.iter()) {
            for vertex in primitive.vertices {
                let place = same_as.len() as u32;
                if solid.sign(i) == 0 {
                    same_as.push(place);
                    continue;
                }
                let number = numbers.number(vertex) as usize;
                if number == places.len() {
                    places.push(place);
                }
                same_as.push(places[number]);
            }
        }
        let mut of_scrap = |scrap: &Vec<Vec3>| {
            let numbers = scrap.iter().map(|vertex| numbers.number(vertex) as usize);
            numbers.map(|number| places.get(number).copied()).collect()
        };
        let scraps = solid.scraps().iter().map(&mut of_scrap).collect();
        Self { same_as, scraps }
    }

    /// Refuses vertices that move what was one vertex apart.
    pub fn check(&self, primitives: &Primitives, vertices: &[Vec3]) -> Result<()> {
        for (i, &first) in self.same_as.iter().enumerate() {
            if vertices[i] != vertices[first as usize] {
                let [a, b] = [first as usize, i].map(|place| {
                    let (primitive, vertex) = owner(primitives, place);
                    format!("vertex {vertex} of primitive {primitive}")
                });
                return Err(Error::new(
                    ErrorKind::NotClosed,
                    format!("{a} and {b} were one vertex of a solid, but are moved apart"),
                ));
            }
        }
        Ok(())
    }

    /// The scraps at the moved vertices.
    pub fn scraps(&self, vertices: &[Vec3], center: &Vec3) -> Result<Vec<Vec<Vec3>>> {
        let moved = |place: &Option<u32>| {
            let place = place.ok_or_else(|| {
                Error::new(
                    ErrorKind::Unsupported,
                    "the solid is closed by faces without area that have vertices of their own",
                )
            })?;
            Ok(vertices[place as usize] - center)
        };
        let of_scrap = |scrap: &Vec<Option<u32>>| scrap.iter().map(moved).collect();
        self.scraps.iter().map(of_scrap).collect()
    }
}

/// The primitive that a vertex belongs to, and its number there.
fn owner(primitives: &Primitives, place: usize) -> (usize, usize) {
    let mut rest = place;
    for (i, primitive) in primitives.iter().enumerate() {
        match rest.checked_sub(primitive.vertices.len()) {
            Some(less) => rest = less,
            None => return (i, rest),
        }
    }
    (0, 0)
}
