//! The parts that leaves bound: whole primitives, or slabs of slender ones (§3.4).

use crate::boxes::Extent;
use crate::pose::Vec3;
use crate::primitive::Convex;
use crate::tolerance;

/// The most leaves of one primitive. More bound a slender primitive more tightly, but each is a box in memory and in queries.
const MAX_SLABS: usize = 64;

/// The most parts per primitive on average, if all are slender: bounds the memory of a body of needles.
const MAX_PARTS: usize = 8;

/// A primitive, or the slab of it between two planes. The slab only serves as a bound: queries test the whole primitive.
#[derive(Clone, Debug)]
pub struct Part {
    pub primitive: u32,
    /// The vertices of the slab; `None` for the whole primitive.
    slab: Option<Vec<Vec3>>,
}

impl Part {
    /// The points whose hull is the part, or contains it if it is curved, and how far rounding may leave the part outside
    /// that hull.
    pub fn vertices<'a>(&'a self, primitives: &'a [Convex]) -> (&'a [Vec3], f64) {
        match &self.slab {
            None => (primitives[self.primitive as usize].bounding_points(), 0.0),
            Some(slab) => {
                let largest = slab.iter().map(|p| p.amax()).fold(0.0, f64::max);
                (slab, tolerance::WRAPPER_ERROR * largest)
            }
        }
    }

    pub fn extent(&self, primitives: &[Convex]) -> Extent {
        Extent::of(self.vertices(primitives).0)
    }

    /// Visits the edges by which the part may be adjacent to others: those of the whole primitive, and the cuts.
    pub fn edges(&self, primitives: &[Convex], visit: &mut dyn FnMut([Vec3; 2])) {
        let primitive = &primitives[self.primitive as usize];
        match &self.slab {
            None => {
                for edge in &primitive.edges {
                    visit(edge.map(|i| primitive.vertices[i as usize]));
                }
            }
            // Every pair of corners, as the cuts' edges are among them; a neighbour shares only the edges of the common cut.
            Some(slab) if slab.len() <= 8 => {
                for (i, &a) in slab.iter().enumerate() {
                    for &b in &slab[i + 1..] {
                        visit([a, b]);
                    }
                }
            }
            Some(_) => {}
        }
    }
}

/// Cuts polytopes longer than `aspect_limit` times their width into slabs about as long as wide; 0 cuts none.
pub fn parts(primitives: &[Convex], aspect_limit: f64) -> Vec<Part> {
    let extents: Vec<Option<(Vec3, f64)>> = if aspect_limit > 0.0 {
        let slender = |p| longest_extent(p).filter(|(_, aspect)| *aspect > aspect_limit);
        primitives.iter().map(slender).collect()
    } else {
        vec![None; primitives.len()]
    };
    let mut max_slabs = MAX_SLABS;
    let count = |aspect: f64, max_slabs: usize| aspect.min(max_slabs as f64).ceil() as usize;
    let total = |max_slabs: usize| -> usize {
        let slender = extents.iter().flatten();
        slender.map(|&(_, aspect)| count(aspect, max_slabs)).sum()
    };
    while max_slabs > 2 && total(max_slabs) > MAX_PARTS * primitives.len() + MAX_SLABS {
        max_slabs /= 2;
    }
    let mut parts = Vec::with_capacity(primitives.len());
    for (i, (primitive, extent)) in primitives.iter().zip(&extents).enumerate() {
        let slabs = match extent {
            Some((along, aspect)) => slabs(primitive, along, count(*aspect, max_slabs)),
            None => Vec::new(),
        };
        if slabs.is_empty() {
            parts.push(Part {
                primitive: i as u32,
                slab: None,
            });
        }
        parts.extend(slabs.into_iter().map(|slab| Part {
            primitive: i as u32,
            slab: Some(slab),
        }));
    }
    parts
}

/// Cuts a primitive into `count` slabs of equal height in the direction `along`.
fn slabs(primitive: &Convex, along: &Vec3, count: usize) -> Vec<Vec<Vec3>> {
    let vertices = &primitive.vertices;
    let lowest = range(vertices, along).0;
    let heights: Vec<f64> = vertices.iter().map(|v| along.dot(v) - lowest).collect();
    let top = heights.iter().copied().fold(0.0, f64::max);
    let cut = |k: usize| match k {
        0 => f64::NEG_INFINITY,
        k if k == count => f64::INFINITY,
        k => top * k as f64 / count as f64,
    };
    // Both slabs at a cut get identical points.
    let on_cut = |height: f64| {
        let heights = &heights;
        primitive.edges.iter().filter_map(move |edge| {
            let [a, b] = edge.map(|i| i as usize);
            let (from, to) = (heights[a], heights[b]);
            let between = from.min(to) < height && height < from.max(to);
            between.then(|| vertices[a].lerp(&vertices[b], (height - from) / (to - from)))
        })
    };
    (0..count)
        .map(|k| {
            let (low, high) = (cut(k), cut(k + 1));
            let inside = (0..vertices.len()).filter(|&i| low <= heights[i] && heights[i] <= high);
            let mut slab: Vec<Vec3> = inside.map(|i| vertices[i]).collect();
            for height in [low, high].into_iter().filter(|h| h.is_finite()) {
                slab.extend(on_cut(height));
            }
            slab
        })
        .filter(|slab| !slab.is_empty())
        .collect()
}

/// The direction of the largest aspect ratio, along the diameter or the longest edge, and that ratio.
fn longest_extent(primitive: &Convex) -> Option<(Vec3, f64)> {
    // Curved primitives are not cut.
    if primitive.curve.is_some() {
        return None;
    }
    let vertices = &primitive.vertices;
    let farthest = |measure: &dyn Fn(&Vec3) -> f64| {
        let measured = vertices.iter().map(|v| (measure(v), *v));
        measured.max_by(|a, b| a.0.total_cmp(&b.0)).map(|m| m.1)
    };
    let first = farthest(&|v| (v - vertices[0]).norm())?;
    let second = farthest(&|v| (v - first).norm())?;
    let edges = primitive
        .edges
        .iter()
        .map(|edge| edge.map(|i| vertices[i as usize]))
        .map(|[a, b]| b - a);
    let longest_edge = edges.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let directions = [second - first, longest_edge].into_iter();
    directions
        .filter_map(|direction| direction.try_normalize(0.0))
        .map(|along| {
            let across = |v: &Vec3| (v - first) - along * along.dot(&(v - first));
            let outermost = farthest(&|v| across(v).norm()).map_or(first, |v| across(&v));
            let width = outermost.try_normalize(0.0).map_or(0.0, |across| {
                let (low, high) = range(vertices, &across);
                high - low
            });
            let (low, high) = range(vertices, &along);
            (along, (high - low) / width)
        })
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The interval of the points' projections onto a direction.
fn range(points: &[Vec3], direction: &Vec3) -> (f64, f64) {
    let extents = points.iter().map(|p| direction.dot(p));
    extents.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::{convex_polygon, convex_polyhedron};

    #[test]
    fn slender_primitives_become_slabs_that_cover_them() {
        let plank = [(0., 0.), (10., 0.), (10., 1.), (0., 1.)].map(|(x, y)| Vec3::new(x, y, 0.5));
        let rod: Vec<Vec3> = (0..16)
            .map(|i| {
                let angle = f64::from(i % 8) * std::f64::consts::FRAC_PI_4;
                Vec3::new(angle.cos(), angle.sin(), if i < 8 { 0.0 } else { 50.0 })
            })
            .collect();
        let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| Vec3::new(x, y, 9.0));
        let primitives = [
            convex_polygon(&plank).unwrap(),
            convex_polyhedron(&rod).unwrap(),
            convex_polygon(&square).unwrap(),
        ];
        let parts = parts(&primitives, 2.0);
        let count = |primitive| parts.iter().filter(|p| p.primitive == primitive).count();
        assert!(
            count(0) >= 10 && count(1) >= 20,
            "{} {}",
            count(0),
            count(1)
        );
        assert_eq!(count(2), 1);
        for part in &parts {
            let extent = part.extent(&primitives);
            let s = extent.size();
            assert!(s.amax() <= 3.0, "a slab of {s:?}");
        }
        // A point of the primitive lies in the box of one of its slabs.
        for k in 0..=1000 {
            let p = Vec3::new(0.01 * f64::from(k), 0.25, 0.5);
            let inside = |e: Extent| e.low.inf(&p) == e.low && e.high.sup(&p) == e.high;
            let holds = |part: &Part| part.primitive == 0 && inside(part.extent(&primitives));
            assert!(parts.iter().any(holds), "{p:?}");
        }
    }
}
