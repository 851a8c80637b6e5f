//! The report's Figures 6 to 9 for our bodies: writes each picture's scene as a .glb file into the given folder, and to
//! standard output one line a picture: file, camera position, focal point, title. scripts/figures.sh renders them.

use std::error::Error;
use std::path::Path;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::hierarchy::{HierarchyOptions, WrapperKind};
use cstk::pose::Vec3;
use cstk::show::show_nodes;
use cstk_scenes as scenes;

/// One of the report's figures: a body, and the numbers of nodes of the levels it shows.
struct Figure {
    name: &'static str,
    title: &'static str,
    mesh: scenes::Mesh,
    levels: Vec<(WrapperKind, usize)>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("usage: hierarchy_figures FOLDER")?;
    let folder = Path::new(&folder);
    use WrapperKind::{Hull, TightSphere};
    let figures = [
        Figure {
            name: "figure6",
            title: "robot base",
            mesh: scenes::robot_base(),
            levels: vec![(TightSphere, 251), (TightSphere, 104), (TightSphere, 8)],
        },
        Figure {
            name: "figure7",
            title: "lamp",
            mesh: scenes::lamp(),
            levels: vec![
                (TightSphere, 414),
                (TightSphere, 167),
                (TightSphere, 4),
                (Hull, 167),
                (Hull, 4),
            ],
        },
        Figure {
            name: "figure8",
            title: "five lamps",
            mesh: scenes::lamps(5, 1),
            levels: vec![(Hull, 8)],
        },
        Figure {
            name: "figure9",
            title: "44 robot bases",
            mesh: scenes::robot_bases(44, 1),
            levels: vec![(Hull, 1604), (Hull, 126)],
        },
    ];
    for figure in &figures {
        let view = view(&figure.mesh);
        let input = build(&figure.mesh, WrapperKind::AlignedBox)?;
        let leaves = input.tree().level(u32::MAX);
        let title = format!("{}: {} polygons", figure.title, figure.mesh.polygons());
        draw(
            folder,
            &format!("{}_0", figure.name),
            &input,
            &leaves,
            &view,
            &title,
        )?;
        for (i, &(kind, count)) in figure.levels.iter().enumerate() {
            let body = build(&figure.mesh, kind)?;
            let depth = body.statistics().depth as u32;
            let levels = (0..depth).map(|level| (level, body.tree().level(level)));
            let (level, nodes) = levels
                .min_by_key(|(_, nodes)| nodes.len().abs_diff(count))
                .ok_or("a tree has levels")?;
            let wrappers = if kind == Hull { "hulls" } else { "spheres" };
            let title = format!(
                "{wrappers}, level {level} of {depth}: {} nodes",
                nodes.len()
            );
            let name = format!("{}_{}", figure.name, i + 1);
            draw(folder, &name, &body, &nodes, &view, &title)?;
        }
    }
    Ok(())
}

fn build(mesh: &scenes::Mesh, wrapper: WrapperKind) -> Result<Body, Box<dyn Error>> {
    let mut builder = BodyBuilder::new(3)?;
    builder.add_mesh(&Mesh {
        vertices: mesh.vertices.iter().map(|&p| Vec3::from(p)).collect(),
        face_sizes: mesh.faces.iter().map(|face| face.len() as u32).collect(),
        indices: mesh.faces.concat(),
    })?;
    let options = HierarchyOptions {
        wrapper,
        // As good as no limit: the report's pictures show hulls, not boxes that stand for large ones.
        hull_vertex_limit: 10_000,
        ..HierarchyOptions::default()
    };
    Ok(builder.build(&options, &mut |_| Ok(()))?)
}

/// A camera that sees the whole mesh from the front, a little from above, and the point it looks at.
fn view(mesh: &scenes::Mesh) -> (Vec3, Vec3) {
    let (low, high) = mesh.bounds();
    let (low, high) = (Vec3::from(low), Vec3::from(high));
    let focus = (low + high) * 0.5;
    let away = Vec3::new(0.55, -1.0, 0.5).normalize();
    (focus + away * (1.85 * (high - low).norm()), focus)
}

fn draw(
    folder: &Path,
    name: &str,
    body: &Body,
    nodes: &[u32],
    view: &(Vec3, Vec3),
    title: &str,
) -> Result<(), Box<dyn Error>> {
    show_nodes(body, nodes, &folder.join(format!("{name}.glb")))?;
    let (camera, focus) = view;
    println!(
        "{name} {},{},{} {},{},{} {title}",
        camera.x, camera.y, camera.z, focus.x, focus.y, focus.z
    );
    Ok(())
}
