//! MoveIt's planning scenes: `.scene` files, the text that its RViz panel exports, as bodies at poses.

mod reader;
mod words;

pub use reader::{SceneObject, SceneOptions, read_scene_file, read_scene_text};
