//! The bodies, each about 1 across and about the origin.

use std::f64::consts::TAU;

use cstk_scenes::{Random, bumpy_sphere};
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::convex_hull;

use super::case::Triangles;

/// An axis is z, and its middle the origin.
pub enum Kind {
    Sphere {
        radius: f64,
    },
    Capsule {
        radius: f64,
        length: f64,
    },
    Box {
        half: [f64; 3],
    },
    Cylinder {
        radius: f64,
        length: f64,
    },
    Cone {
        radius: f64,
        length: f64,
    },
    Ellipsoid {
        semi_axes: [f64; 3],
    },
    Hull(Triangles),
    Mesh(Triangles),
    /// Points alone, without triangles.
    Cloud {
        points: Triangles,
        radius: f64,
    },
}

pub struct Shape {
    pub name: String,
    pub kind: Kind,
}

/// Meshes and clouds are made with this, so that their diameter is about 1.
const SCALE: f64 = 0.5;

impl Shape {
    fn new(name: impl Into<String>, kind: Kind) -> Self {
        Self {
            name: name.into(),
            kind,
        }
    }

    /// Balls to us and to parry, voxels to FCL and Coal.
    pub fn is_cloud(&self) -> bool {
        matches!(self.kind, Kind::Cloud { .. })
    }

    /// One of the simple kinds, by its name.
    pub fn named(name: &str) -> Self {
        let kind = match name {
            "sphere" => Kind::Sphere { radius: 0.5 },
            "capsule" => Kind::Capsule {
                radius: 0.25,
                length: 0.6,
            },
            "box" => Kind::Box {
                half: [0.5, 0.4, 0.3],
            },
            "cylinder" => Kind::Cylinder {
                radius: 0.35,
                length: 0.8,
            },
            "cone" => Kind::Cone {
                radius: 0.45,
                length: 0.9,
            },
            "ellipsoid" => Kind::Ellipsoid {
                semi_axes: [0.5, 0.35, 0.25],
            },
            "hull 50" => return Self::hull(50),
            "hull 500" => return Self::hull(500),
            "prism 12" => return Self::hull_of(name, &prism(12)),
            _ => panic!("no shape is called {name}"),
        };
        Self::new(name, kind)
    }

    /// The hull of points on an ellipsoid, all of which are vertices of it.
    fn hull(points: usize) -> Self {
        let random = &mut Random::new(points as u64);
        let axes = [0.5, 0.4, 0.35];
        let points: Vec<Vector> = (0..points)
            .map(|_| random.direction())
            .map(|d| Vector::new(axes[0] * d[0], axes[1] * d[1], axes[2] * d[2]))
            .collect();
        Self::hull_of(&format!("hull {}", points.len()), &points)
    }

    fn hull_of(name: &str, points: &[Vector]) -> Self {
        let (vertices, triangles) = convex_hull(points);
        let vertices = vertices.iter().flat_map(|p| [p.x, p.y, p.z]).collect();
        let triangles = triangles.concat();
        Self::new(
            name,
            Kind::Hull(Triangles {
                vertices,
                triangles,
            }),
        )
    }

    /// A bumpy sphere, a surface without inside.
    pub fn mesh(polygons: usize, seed: u64) -> Self {
        let mesh = bumpy_sphere(polygons, seed);
        let kind = Kind::Mesh(Triangles {
            vertices: scaled(&mesh.vertices),
            triangles: mesh.faces.concat(),
        });
        Self::new(format!("mesh {polygons}"), kind)
    }

    /// Points all over a bumpy sphere, with a radius that about closes the gaps between them.
    pub fn cloud(points: usize, seed: u64) -> Self {
        // A closed surface has two vertices more than half its triangles.
        let mesh = bumpy_sphere(2 * points - 4, seed);
        let spacing = 2.0 * SCALE * (std::f64::consts::PI / points as f64).sqrt();
        let kind = Kind::Cloud {
            points: Triangles {
                vertices: scaled(&mesh.vertices),
                triangles: Vec::new(),
            },
            radius: 0.5 * spacing,
        };
        Self::new(format!("cloud {points}"), kind)
    }
}

/// The corners of an upright prism over a regular polygon.
fn prism(corners: usize) -> Vec<Vector> {
    let at = |k: usize, height: f64| {
        let (y, x) = (TAU * k as f64 / corners as f64).sin_cos();
        Vector::new(0.4 * x, 0.4 * y, height)
    };
    (0..corners)
        .flat_map(|k| [at(k, -0.4), at(k, 0.4)])
        .collect()
}

fn scaled(points: &[[f64; 3]]) -> Vec<f64> {
    points.iter().flatten().map(|x| SCALE * x).collect()
}
