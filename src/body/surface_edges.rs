//! The edges of a surface's faces, and the choice of faces without area that close it.

use super::vertex_numbers::VertexNumbers;
use crate::pose::Vec3;

/// A face as it was given: its vertices in cyclic order, and its primitive and tag for messages.
pub struct Outline<'a> {
    pub vertices: &'a [Vec3],
    /// The primitive it became; `None` for a face without area, which is used only if the others need it to close.
    pub primitive: Option<u32>,
    pub tag: u64,
}

/// How a face uses an edge.
#[derive(Clone, Copy)]
pub struct EdgeUse {
    /// The vertex numbers of its ends, the lower first.
    pub edge: [u32; 2],
    pub face: u32,
    /// How often the face runs from the lower end to the higher minus how often back; not 0.
    pub net: i32,
}

/// The edge uses of faces, sorted by edge.
pub struct SurfaceEdges {
    pub uses: Vec<EdgeUse>,
    /// The vertices by their numbers.
    pub points: Vec<Vec3>,
    /// The vertex numbers of each face.
    pub rings: Vec<Vec<u32>>,
}

impl SurfaceEdges {
    pub fn of(faces: &[Outline]) -> Self {
        let mut numbers = VertexNumbers::default();
        let mut points = Vec::new();
        let mut number = |p: &Vec3| {
            let number = numbers.number(p);
            if number as usize == points.len() {
                points.push(*p);
            }
            number
        };
        let rings: Vec<Vec<u32>> = faces
            .iter()
            .map(|face| face.vertices.iter().map(&mut number).collect())
            .collect();
        let mut runs: Vec<EdgeUse> = Vec::new();
        for (face, ring) in (0..).zip(&rings) {
            for (i, &a) in ring.iter().enumerate() {
                let b = ring[(i + 1) % ring.len()];
                if a != b {
                    let (edge, net) = ([a.min(b), a.max(b)], if a < b { 1 } else { -1 });
                    runs.push(EdgeUse { edge, face, net });
                }
            }
        }
        runs.sort_unstable_by_key(|run| (run.edge, run.face));
        let of_one = runs.chunk_by(|a, b| (a.edge, a.face) == (b.edge, b.face));
        let uses = of_one.map(|runs| EdgeUse {
            net: runs.iter().map(|run| run.net).sum(),
            ..runs[0]
        });
        Self {
            uses: uses.filter(|used| used.net != 0).collect(),
            points,
            rings,
        }
    }

    /// The uses of each edge, as one slice per edge.
    pub fn families(&self) -> impl Iterator<Item = &[EdgeUse]> {
        self.uses.chunk_by(|a, b| a.edge == b.edge)
    }

    /// Keeps only the uses of the faces that are kept.
    pub fn retain(&mut self, is_kept: &[bool]) {
        self.uses.retain(|used| is_kept[used.face as usize]);
    }

    /// Chooses the faces of the surface: all primitives, and faces without area that close edges left open, added one by one
    /// as far as they can.
    pub fn closing(&self, faces: &[Outline]) -> Vec<bool> {
        let mut is_kept: Vec<bool> = faces.iter().map(|face| face.primitive.is_some()).collect();
        if !is_kept.contains(&false) {
            return is_kept;
        }
        let families: Vec<&[EdgeUse]> = self.families().collect();
        let mut families_of: Vec<Vec<(u32, bool)>> = vec![Vec::new(); faces.len()];
        let mut is_open = vec![false; families.len()];
        for (i, family) in families.iter().enumerate() {
            for used in *family {
                let is_odd = used.net % 2 != 0;
                if is_kept[used.face as usize] {
                    is_open[i] ^= is_odd;
                } else {
                    families_of[used.face as usize].push((i as u32, is_odd));
                }
            }
        }
        // How many uses of each family have been tried; kept faces stay kept, so none is tried again.
        let mut passed = vec![0; families.len()];
        let mut open: Vec<u32> = (0..families.len() as u32)
            .filter(|&i| is_open[i as usize])
            .collect();
        while let Some(i) = open.pop() {
            if !is_open[i as usize] {
                continue;
            }
            let fills = |used: &EdgeUse| !is_kept[used.face as usize] && used.net % 2 != 0;
            let left = &families[i as usize][passed[i as usize]..];
            passed[i as usize] += left.iter().position(fills).unwrap_or(left.len());
            let Some(filling) = families[i as usize].get(passed[i as usize]) else {
                continue;
            };
            is_kept[filling.face as usize] = true;
            for &(j, is_odd) in &families_of[filling.face as usize] {
                is_open[j as usize] ^= is_odd;
                if is_open[j as usize] {
                    open.push(j);
                }
            }
        }
        is_kept
    }
}
