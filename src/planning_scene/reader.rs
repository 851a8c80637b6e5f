//! Reads the objects of a scene file: a name, poses, and for each object its shapes.

use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

use super::words::Words;
use crate::body::{Body, BodyBuilder, Mesh, MeshBudget, MeshForm, MeshSize};
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::HierarchyOptions;
use crate::pose::{Pose, Vec3};
use crate::whole_file::{read_whole, text_of};

/// How to read a scene.
#[derive(Clone, Debug)]
pub struct SceneOptions {
    /// Where the scene's frame is in the world.
    pub at: Pose,
    /// What meshes stand for.
    pub form: MeshForm,
    /// How the objects' hierarchies are built.
    pub hierarchy: HierarchyOptions,
}

impl Default for SceneOptions {
    fn default() -> Self {
        Self {
            at: Pose::identity(),
            form: MeshForm::default(),
            hierarchy: HierarchyOptions::default(),
        }
    }
}

/// An object of a scene.
#[derive(Clone, Debug)]
pub struct SceneObject {
    /// Unique in the scene.
    pub name: String,
    /// Its shapes, in its frame; primitives are tagged with the number of the shape, those of a mesh's surface with the
    /// number of the face.
    pub body: Arc<Body>,
    /// In the world.
    pub pose: Pose,
}

/// The largest scene file accepted, 1 GiB: those with meshes have some 100 bytes a triangle.
const MAX_SCENE_BYTES: u64 = 1 << 30;

/// At most 2^17 objects, and as many shapes in all of them.
const MAX_SHAPES: usize = 1 << 17;

/// The objects of a `.scene` file, in its order. Errors name file, line and object.
pub fn read_scene_file(path: &Path, options: &SceneOptions) -> Result<Vec<SceneObject>> {
    let named = |e: Error| e.within(path.display());
    let bytes = read_whole(path, MAX_SCENE_BYTES).map_err(named)?;
    text_of(&bytes)
        .and_then(|text| read_scene_text(text, options))
        .map_err(named)
}

/// The same for the content of such a file.
pub fn read_scene_text(text: &str, options: &SceneOptions) -> Result<Vec<SceneObject>> {
    let mut reader = SceneReader {
        words: Words::new(text),
        options,
        has_object_poses: None,
        budget: MeshBudget::default(),
        shapes: 0,
    };
    reader.words.rest_of_line();
    let mut objects: Vec<SceneObject> = Vec::new();
    let mut names = HashSet::new();
    loop {
        match reader.words.word("* or .")? {
            "." => return Ok(objects),
            "*" => {}
            other => {
                let message = format!("\"{other}\" stands where an object should begin with *");
                return Err(reader.words.fault(ErrorKind::Parse, message));
            }
        }
        let name = reader.words.rest_of_line();
        if name.contains('\0') {
            let message = "the object's name holds a NUL";
            return Err(reader.words.fault(ErrorKind::Parse, message));
        }
        if !names.insert(name) {
            let message = format!("another object is called \"{name}\"");
            return Err(reader.words.fault(ErrorKind::InvalidArgument, message));
        }
        let object = reader.object(name);
        objects.push(object.map_err(|e| e.within(format_args!("object \"{name}\"")))?);
    }
}

struct SceneReader<'a, 'o> {
    words: Words<'a>,
    options: &'o SceneOptions,
    /// Objects have poses and subframes, as they have since MoveIt 1.1: known from the first object on.
    has_object_poses: Option<bool>,
    budget: MeshBudget,
    shapes: usize,
}

impl SceneReader<'_, '_> {
    fn object(&mut self, name: &str) -> Result<SceneObject> {
        let line = self.words.next_line();
        let has_pose = *self.has_object_poses.get_or_insert(line.contains(' '));
        let pose = match has_pose {
            true => self.words.pose("the object's pose")?,
            false => Pose::identity(),
        };
        let count = self.words.count("the number of shapes")?;
        if count == 0 {
            let message = "it has no shape";
            return Err(self.words.fault(ErrorKind::Empty, message));
        }
        let left = MAX_SHAPES - self.shapes;
        if count > left as u64 {
            let message = format!("{count} shapes: a scene has at most {MAX_SHAPES} shapes");
            return Err(self.words.fault(ErrorKind::Unsupported, message));
        }
        self.shapes += count as usize;
        let mut builder = BodyBuilder::new(3)?;
        for tag in 0..count {
            let shape = self.shape(&mut builder, tag);
            shape.map_err(|e| e.within(format_args!("shape {tag}")))?;
        }
        if has_pose {
            for _ in 0..self.words.count("the number of subframes")? {
                self.words.word("a subframe's name")?;
                self.words.pose("a subframe's pose")?;
            }
        }
        let body = builder.build_as(self.options.form, &self.options.hierarchy, &mut |_| Ok(()))?;
        Ok(SceneObject {
            name: name.to_string(),
            body: Arc::new(body),
            pose: self.options.at.compose(&pose),
        })
    }

    /// A shape, its pose in the object's frame, and its colour, which is skipped.
    fn shape(&mut self, builder: &mut BodyBuilder, tag: u64) -> Result<()> {
        let kind = self.words.word("a shape")?;
        let at_line = |e: Error, words: &Words| words.fault(e.kind, e.message);
        let sizes = match kind {
            "box" => self.words.numbers::<3>("the box's sizes")?.to_vec(),
            "sphere" => self.words.numbers::<1>("the sphere's radius")?.to_vec(),
            "cylinder" | "cone" => self.words.numbers::<2>("radius and length")?.to_vec(),
            "mesh" => return self.mesh(builder, tag),
            "plane" => {
                let message = "a plane has no end: use cstk_cobject_below_floor";
                return Err(self.words.fault(ErrorKind::Unsupported, message));
            }
            other => {
                let message =
                    format!("\"{other}\" is no shape: box, sphere, cylinder, cone or mesh");
                return Err(self.words.fault(ErrorKind::Unsupported, message));
            }
        };
        let at = self.placed()?;
        let added = match kind {
            "box" => builder.add_box(&at, &(Vec3::from_column_slice(&sizes) * 0.5), tag),
            "sphere" => builder.add_sphere(&at.translation, sizes[0], tag),
            "cylinder" => builder.add_cylinder(&at, sizes[0], 0.5 * sizes[1], tag),
            _ => builder.add_cone(&at, sizes[0], sizes[1], tag),
        };
        added.map_err(|e| at_line(e, &self.words))
    }

    fn placed(&mut self) -> Result<Pose> {
        let at = self.words.pose("the shape's pose")?;
        self.words.numbers::<4>("the shape's colour")?;
        Ok(at)
    }

    fn mesh(&mut self, builder: &mut BodyBuilder, tag: u64) -> Result<()> {
        let vertices = self.words.count("the number of vertices")?;
        let faces = self.words.count("the number of triangles")?;
        let size = MeshSize {
            faces,
            indices: faces.saturating_mul(3),
            squares: 0,
        };
        let taken = self.budget.take(size, false);
        taken.map_err(|e| self.words.fault(e.kind, e.message))?;
        // Grown as the words come: the counts are the file's own.
        let mut mesh = Mesh::default();
        for _ in 0..vertices {
            let vertex = self.words.numbers::<3>("a vertex")?;
            mesh.vertices.push(Vec3::from(vertex));
        }
        for _ in 0..faces {
            for _ in 0..3 {
                let index = self.words.count("a vertex's index")?;
                if index >= vertices {
                    let message = format!("vertex {index} does not exist; there are {vertices}");
                    return Err(self.words.fault(ErrorKind::NotFound, message));
                }
                mesh.indices.push(index as u32);
            }
            mesh.face_sizes.push(3);
        }
        let at = self.placed()?;
        let mesh = mesh.placed(&at, &Vec3::repeat(1.0))?;
        let added = builder.add_mesh_as(&mesh, self.options.form, tag);
        added.map_err(|e| self.words.fault(e.kind, e.message))
    }
}
