//! A cave floor.

use crate::mesh::Mesh;
use crate::random::Random;

/// Cells of the floor along x and y.
const CELLS: [usize; 2] = [219, 218];

/// A cave floor with 120 stalagmites, 98,106 triangles: one closed surface over the unit square, up to about 0.5 high,
/// with a flat bottom at z = -0.05.
///
/// Reconstructs in kind the "Stalagmite" of the University of North Carolina, an input of about 98,000 polygons in
/// §3.3.2.
pub fn stalagmite(seed: u64) -> Mesh {
    let spikes = spikes(&mut Random::new(seed));
    let [columns, rows] = CELLS;
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let x = column as f64 / columns as f64;
            let y = row as f64 / rows as f64;
            mesh.add_vertex([x, y, height(&spikes, x, y)]);
        }
    }
    let at = |column: usize, row: usize| (row * (columns + 1) + column) as u32;
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (at(column, row), at(column + 1, row));
            let (c, d) = (at(column + 1, row + 1), at(column, row + 1));
            mesh.faces.push(vec![a, b, c]);
            mesh.faces.push(vec![a, c, d]);
        }
    }
    let border: Vec<u32> = (0..columns)
        .map(|k| at(k, 0))
        .chain((0..rows).map(|k| at(columns, k)))
        .chain((0..columns).map(|k| at(columns - k, rows)))
        .chain((0..rows).map(|k| at(0, rows - k)))
        .collect();
    close_below(&mut mesh, &border);
    mesh
}

/// Adds walls down from `border`, which is counter-clockwise seen from above, and a bottom.
fn close_below(mesh: &mut Mesh, border: &[u32]) {
    const BOTTOM: f64 = -0.05;
    let foot: Vec<u32> = border
        .iter()
        .map(|&v| {
            let [x, y, _] = mesh.vertices[v as usize];
            mesh.add_vertex([x, y, BOTTOM])
        })
        .collect();
    let centre = mesh.add_vertex([0.5, 0.5, BOTTOM]);
    for i in 0..border.len() {
        let j = (i + 1) % border.len();
        mesh.faces.push(vec![foot[i], foot[j], border[j]]);
        mesh.faces.push(vec![foot[i], border[j], border[i]]);
        mesh.faces.push(vec![foot[j], foot[i], centre]);
    }
}

struct Spike {
    foot: [f64; 2],
    height: f64,
    width: f64,
}

fn spikes(random: &mut Random) -> Vec<Spike> {
    (0..120)
        .map(|_| Spike {
            foot: [random.within(0.05, 0.95), random.within(0.05, 0.95)],
            height: random.within(0.08, 0.5),
            width: random.within(0.008, 0.02),
        })
        .collect()
}

/// Gentle waves, and over them the highest of the spikes.
fn height(spikes: &[Spike], x: f64, y: f64) -> f64 {
    let waves = 0.01 * ((9.0 * x).sin() + (7.0 * y + 5.0 * x).cos());
    let spike = |s: &Spike| s.height * (-(x - s.foot[0]).hypot(y - s.foot[1]) / s.width).exp();
    waves + spikes.iter().map(spike).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn about_the_count_of_the_report() {
        let mesh = stalagmite(1);
        assert_eq!(mesh.polygons(), 98_106);
        assert!((0.3..0.6).contains(&mesh.bounds().1[2]));
    }
}
