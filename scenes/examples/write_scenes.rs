//! Writes the bodies of the scenes with a rigid body, for benchmarks that are not in Rust: for each scene NAME_moving.obj in the body's
//! frame and NAME_obstacle_0.obj, _1 and so on in the world's. `cargo run -p cstk-scenes --example write_scenes -- FOLDER`.

use std::error::Error;
use std::fs;
use std::path::Path;

use cstk_scenes::{Scene, bumpy_pair, free_lamp, teapot_contacts};

/// Triangles of each bumpy body.
const BUMPY_TRIANGLES: usize = 20_000;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("usage: write_scenes FOLDER")?;
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    let bumpy = Scene {
        name: "bumpy".into(),
        ..bumpy_pair(BUMPY_TRIANGLES, 1).scene
    };
    for scene in [free_lamp(), teapot_contacts(), bumpy] {
        let write = |part: &str, text: String| {
            fs::write(folder.join(format!("{}_{part}.obj", scene.name)), text)
        };
        write("moving", scene.moving.to_obj())?;
        for (i, obstacle) in scene.obstacles.iter().enumerate() {
            write(&format!("obstacle_{i}"), obstacle.to_obj())?;
        }
    }
    Ok(())
}
