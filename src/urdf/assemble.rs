//! Turns the elements of a URDF file into links of a robot builder.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use nalgebra::Rotation3;

use super::bodies::LinkBodies;
use super::link_forms::LinkForms;
use super::model::{JointElement, JointType, LinkElement, Model};
use super::packages::PackageFolders;
use super::report::UrdfReport;
use super::shapes::ShapeReader;
use crate::body::BodyCache;
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::HierarchyOptions;
use crate::pose::{Pose, Vec3};
use crate::robot::{JointKind, LinkDefinition, RobotBuilder};
use crate::whole_file::{read_whole, text_of};
use crate::xml::{fault, parse};

/// Which of a link's shapes become its body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UrdfGeometry {
    /// The `collision` shapes.
    Collision,
    /// The `visual` shapes.
    Visual,
    /// None: the links have frames only.
    None,
}

/// The joint between the root link and what carries the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseJoint {
    /// As [`JointKind::Fixed`].
    Fixed,
    /// As [`JointKind::Planar`].
    Planar,
    /// As [`JointKind::Free`].
    Free,
    /// As [`JointKind::FreeEuler`].
    FreeEuler,
}

/// How to read a URDF file.
#[derive(Clone, Debug)]
pub struct UrdfOptions {
    /// Which shapes become bodies.
    pub geometry: UrdfGeometry,
    /// The joint of the root link.
    pub base: BaseJoint,
    /// The link of the builder that carries the robot; `None` for the world.
    pub parent: Option<usize>,
    /// Where the root's joint is, in the frame of `parent`.
    pub at: Pose,
    /// Prepended to the names of links and joints, so that a file can be loaded twice.
    pub prefix: String,
    /// Folders to search for packages; after them come the URDF file's folder and those above it, then the folders of
    /// `AMENT_PREFIX_PATH` and `ROS_PACKAGE_PATH`.
    pub search: Vec<PathBuf>,
    /// With 3 or more, spheres, cylinders and capsules become polyhedra that enclose them, their circles divided into this
    /// many sides. With 0 they stay exact.
    pub sides: usize,
    /// How the links' hierarchies are built.
    pub hierarchy: HierarchyOptions,
    /// Whether meshes are surfaces, solids or convex hulls.
    pub forms: LinkForms,
    /// A folder that caches built bodies between loads; created if it does not exist.
    pub cache_folder: Option<PathBuf>,
}

impl Default for UrdfOptions {
    fn default() -> Self {
        Self {
            geometry: UrdfGeometry::Collision,
            base: BaseJoint::Fixed,
            parent: None,
            at: Pose::identity(),
            prefix: String::new(),
            search: Vec::new(),
            sides: 0,
            hierarchy: HierarchyOptions::default(),
            forms: LinkForms::default(),
            cache_folder: None,
        }
    }
}

/// The most sides a circle is divided into.
const MAX_SIDES: usize = 1024;

/// The largest URDF file accepted, 64 MiB; those of humanoids have some 100 KiB.
const MAX_URDF_FILE_BYTES: u64 = 1 << 26;

/// Adds the robot of a URDF file to a builder of dimension 3, and reports what was read and built. Links are added depth
/// first, parents before children, siblings in file order. `progress` receives the fraction of the links done. The file is
/// added whole or not at all; errors name file, line and element.
pub fn add_urdf_file(
    builder: &mut RobotBuilder,
    path: &Path,
    options: &UrdfOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<UrdfReport> {
    check(builder, options)?;
    let bytes = read_whole(path, MAX_URDF_FILE_BYTES).map_err(|e| e.within(path.display()))?;
    let real = path.canonicalize();
    let folder = real.as_deref().ok().and_then(Path::parent);
    let source = UrdfSource {
        name: path.display().to_string(),
        bytes: &bytes,
        folder: Some(folder.unwrap_or(Path::new("."))),
    };
    source.add_to(builder, options, progress)
}

/// Adds the robot of a URDF text, as [`add_urdf_file`] does that of a file. Names of meshes are relative to `folder`;
/// without it they must be absolute, or in a package. Errors name line and element.
pub fn add_urdf_text(
    builder: &mut RobotBuilder,
    text: &str,
    folder: Option<&Path>,
    options: &UrdfOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<UrdfReport> {
    check(builder, options)?;
    if text.len() as u64 > MAX_URDF_FILE_BYTES {
        return Err(Error::new(
            ErrorKind::Unsupported,
            format!(
                "the URDF text has {} bytes; at most {MAX_URDF_FILE_BYTES} are read",
                text.len()
            ),
        ));
    }
    let source = UrdfSource {
        name: "URDF text".to_string(),
        bytes: text.as_bytes(),
        folder,
    };
    source.add_to(builder, options, progress)
}

fn check(builder: &RobotBuilder, options: &UrdfOptions) -> Result<()> {
    if builder.dimension() != 3 {
        return Err(Error::invalid(
            "a URDF robot needs a robot builder of dimension 3",
        ));
    }
    if options.sides != 0 && !(3..=MAX_SIDES).contains(&options.sides) {
        return Err(Error::invalid(format!(
            "sides is {}; 0 and 3 to {MAX_SIDES} are possible",
            options.sides
        )));
    }
    Ok(())
}

/// The content of a URDF file, or a text.
struct UrdfSource<'a> {
    /// What errors name.
    name: String,
    bytes: &'a [u8],
    /// Where names of meshes begin.
    folder: Option<&'a Path>,
}

impl UrdfSource<'_> {
    /// Adds the robot whole or not at all.
    fn add_to(
        &self,
        builder: &mut RobotBuilder,
        options: &UrdfOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<UrdfReport> {
        let mut extended = builder.clone();
        let added = add_text(&mut extended, self.bytes, self.folder, options, progress);
        let report = added.map_err(|e| match e.kind {
            ErrorKind::Cancelled => e,
            _ => e.within(&self.name),
        })?;
        *builder = extended;
        Ok(report)
    }
}

fn add_text(
    builder: &mut RobotBuilder,
    bytes: &[u8],
    folder: Option<&Path>,
    options: &UrdfOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<UrdfReport> {
    let document = parse(text_of(bytes)?)?;
    let geometry = match options.geometry {
        UrdfGeometry::Collision => Some("collision"),
        UrdfGeometry::Visual => Some("visual"),
        UrdfGeometry::None => None,
    };
    let model = Model::read(document.root_element(), geometry)?;
    options.forms.check(&model.links)?;
    let order = Tree::of(&model)?.links_by_depth();
    let followed = followed(&model)?;
    let cache = options.cache_folder.as_deref().map(BodyCache::open);
    let packages = PackageFolders::new(folder, &options.search);
    let shapes = ShapeReader::new(packages, options.sides);
    let mut assembly = Assembly {
        builder,
        options,
        followed,
        coordinates: HashMap::new(),
        bodies: LinkBodies::new(
            &model.links,
            shapes,
            &options.hierarchy,
            cache.transpose()?,
            &options.forms,
        )?,
        numbers: HashMap::new(),
    };
    let count = order.len() as f64;
    for (i, (link, joint)) in order.iter().enumerate() {
        assembly.add(link, *joint)?;
        progress((i + 1) as f64 / count)?;
    }
    let is_hidden = |link: &&LinkElement| link.geometry.is_empty() && link.has_other_shapes;
    Ok(UrdfReport {
        root: assembly.numbers[order[0].0.name],
        links: model.links.len(),
        joints: model.joints.len(),
        links_with_other_shapes: model.links.iter().filter(is_hidden).count(),
        skipped_elements: model.skipped_elements,
        ..assembly.bodies.report()
    })
}

/// The links of a model and the joints between them, checked to form a tree.
struct Tree<'m, 'a, 'i> {
    root: &'m LinkElement<'a, 'i>,
    links: HashMap<&'a str, &'m LinkElement<'a, 'i>>,
    /// By the parent's name, in file order.
    joints: HashMap<&'a str, Vec<&'m JointElement<'a, 'i>>>,
}

/// A link with the joint that moves it; the root has none.
type Jointed<'m, 'a, 'i> = (&'m LinkElement<'a, 'i>, Option<&'m JointElement<'a, 'i>>);

impl<'m, 'a, 'i> Tree<'m, 'a, 'i> {
    fn of(model: &'m Model<'a, 'i>) -> Result<Self> {
        let mut links = HashMap::new();
        for link in &model.links {
            if links.insert(link.name, link).is_some() {
                let message = format!("another link is called \"{}\"", link.name);
                return Err(fault(link.node, ErrorKind::InvalidArgument, message));
            }
        }
        let mut names = HashSet::new();
        // The joint that moves each link, by the link's name.
        let mut carried: HashMap<&str, &str> = HashMap::new();
        let mut joints: HashMap<&str, Vec<_>> = HashMap::new();
        for joint in &model.joints {
            let wrong = |kind, message: String| {
                fault(joint.node, kind, message).within(format_args!("joint \"{}\"", joint.name))
            };
            if !names.insert(joint.name) {
                let message = "another joint has this name".to_string();
                return Err(wrong(ErrorKind::InvalidArgument, message));
            }
            for end in [joint.parent, joint.child] {
                if !links.contains_key(end) {
                    let message = format!("there is no link \"{end}\"");
                    return Err(wrong(ErrorKind::NotFound, message));
                }
            }
            if let Some(other) = carried.insert(joint.child, joint.name) {
                let message = format!("joint \"{other}\" moves link \"{}\" too", joint.child);
                return Err(wrong(ErrorKind::InvalidArgument, message));
            }
            joints.entry(joint.parent).or_default().push(joint);
        }
        let tree = Self {
            root: only_root(model, &carried)?,
            links,
            joints,
        };
        tree.check_all_reached(model)?;
        Ok(tree)
    }

    /// Refuses links that hang on each other in a circle.
    fn check_all_reached(&self, model: &Model<'a, 'i>) -> Result<()> {
        let order = self.links_by_depth();
        let reached: HashSet<&str> = order.iter().map(|(link, _)| link.name).collect();
        match model.links.iter().find(|link| !reached.contains(link.name)) {
            None => Ok(()),
            Some(lost) => {
                let message = "the joints that lead to it form a circle";
                Err(fault(lost.node, ErrorKind::InvalidArgument, message)
                    .within(format_args!("link \"{}\"", lost.name)))
            }
        }
    }

    /// All links depth first.
    fn links_by_depth(&self) -> Vec<Jointed<'m, 'a, 'i>> {
        let mut order = Vec::new();
        let mut stack: Vec<Jointed<'m, 'a, 'i>> = vec![(self.root, None)];
        while let Some((link, joint)) = stack.pop() {
            order.push((link, joint));
            for joint in self.joints.get(link.name).into_iter().flatten().rev() {
                stack.push((self.links[joint.child], Some(joint)));
            }
        }
        order
    }
}

/// The one link that no joint moves, given the joint that moves each other link.
fn only_root<'m, 'a, 'i>(
    model: &'m Model<'a, 'i>,
    carried: &HashMap<&str, &str>,
) -> Result<&'m LinkElement<'a, 'i>> {
    let mut roots = model
        .links
        .iter()
        .filter(|link| !carried.contains_key(link.name));
    let Some(root) = roots.next() else {
        let is_macro = |node: roxmltree::Node| {
            let namespace = node.tag_name().namespace();
            namespace.is_some_and(|namespace| namespace.contains("xacro"))
        };
        let (kind, message) = if !model.links.is_empty() {
            let message = "every link hangs on another: the joints form a circle";
            (ErrorKind::InvalidArgument, message)
        } else if model.node.children().any(is_macro) {
            let message = "the robot has no link, but xacro macros: expand them first";
            (ErrorKind::Empty, message)
        } else {
            (ErrorKind::Empty, "the robot has no link")
        };
        return Err(fault(model.node, kind, message));
    };
    match roots.next() {
        None => Ok(root),
        Some(other) => {
            let message = format!(
                "no joint leads to it, nor to \"{}\": a robot has one root",
                root.name
            );
            Err(fault(other.node, ErrorKind::InvalidArgument, message)
                .within(format_args!("link \"{}\"", other.name)))
        }
    }
}

/// What a mimic joint follows: a multiple of another joint's coordinate plus an offset.
struct MimicTarget<'m, 'a, 'i> {
    joint: &'m JointElement<'a, 'i>,
    multiplier: f64,
    offset: f64,
}

/// For each mimic joint, the joint at the end of its chain, with the combined multiplier and offset.
fn followed<'m, 'a, 'i>(
    model: &'m Model<'a, 'i>,
) -> Result<HashMap<&'a str, MimicTarget<'m, 'a, 'i>>> {
    let joints: HashMap<&str, &JointElement> = model
        .joints
        .iter()
        .map(|joint| (joint.name, joint))
        .collect();
    let mut resolved: HashMap<&str, MimicTarget> = HashMap::new();
    for joint in &model.joints {
        let wrong = |kind, message: String| {
            fault(joint.node, kind, message).within(format_args!("joint \"{}\"", joint.name))
        };
        // The chain up to its end, or to a joint already resolved.
        let mut chain = Vec::new();
        let mut last = joint;
        while let Some(mimic) = &last.mimic {
            if resolved.contains_key(last.name) {
                break;
            }
            chain.push((last.name, mimic));
            last = joints.get(mimic.joint).copied().ok_or_else(|| {
                wrong(
                    ErrorKind::NotFound,
                    format!("there is no joint \"{}\" to mimic", mimic.joint),
                )
            })?;
            if chain.len() > model.joints.len() {
                let message = "the joints it mimics form a circle".to_string();
                return Err(wrong(ErrorKind::InvalidArgument, message));
            }
        }
        if chain.is_empty() {
            continue;
        }
        let (last, mut multiplier, mut offset) = match resolved.get(last.name) {
            Some(known) => (known.joint, known.multiplier, known.offset),
            None => (last, 1.0, 0.0),
        };
        if !matches!(
            last.kind,
            JointType::Revolute | JointType::Continuous | JointType::Prismatic
        ) {
            let message = format!("joint \"{}\" has no single coordinate to mimic", last.name);
            return Err(wrong(ErrorKind::Unsupported, message));
        }
        for (name, mimic) in chain.into_iter().rev() {
            offset = mimic.multiplier * offset + mimic.offset;
            multiplier *= mimic.multiplier;
            resolved.insert(
                name,
                MimicTarget {
                    joint: last,
                    multiplier,
                    offset,
                },
            );
        }
    }
    Ok(resolved)
}

struct Assembly<'m, 'a, 'i, 'o> {
    builder: &'o mut RobotBuilder,
    options: &'o UrdfOptions,
    followed: HashMap<&'a str, MimicTarget<'m, 'a, 'i>>,
    /// The coordinate of each joint, by the name of the joint at the end of its mimic chain.
    coordinates: HashMap<&'a str, usize>,
    bodies: LinkBodies<'o>,
    /// Link numbers in the builder, by name.
    numbers: HashMap<&'a str, usize>,
}

impl<'a> Assembly<'_, 'a, '_, '_> {
    fn add(
        &mut self,
        link: &LinkElement<'a, '_>,
        joint: Option<&JointElement<'a, '_>>,
    ) -> Result<()> {
        let body = self.bodies.body(link)?;
        let prefix = &self.options.prefix;
        let definition = LinkDefinition {
            name: format!("{prefix}{}", link.name),
            body,
            ..Default::default()
        };
        let number = match joint {
            None => self.builder.add_link(LinkDefinition {
                parent: self.options.parent,
                at: self.options.at,
                kind: match self.options.base {
                    BaseJoint::Fixed => JointKind::Fixed,
                    BaseJoint::Planar => JointKind::Planar,
                    BaseJoint::Free => JointKind::Free,
                    BaseJoint::FreeEuler => JointKind::FreeEuler,
                },
                ..definition
            })?,
            Some(joint) => self
                .add_joint(definition, joint)
                .map_err(|e| e.within(format_args!("joint \"{}\"", joint.name)))?,
        };
        self.numbers.insert(link.name, number);
        Ok(())
    }

    fn add_joint(
        &mut self,
        definition: LinkDefinition,
        joint: &JointElement<'a, '_>,
    ) -> Result<usize> {
        let kind = match joint.kind {
            JointType::Fixed => JointKind::Fixed,
            JointType::Revolute | JointType::Continuous => JointKind::Revolute,
            JointType::Prismatic => JointKind::Prismatic,
            JointType::Planar => JointKind::Planar,
            JointType::Floating => JointKind::Free,
            JointType::Spherical => JointKind::Spherical,
        };
        let mut definition = LinkDefinition {
            joint_name: format!("{}{}", self.options.prefix, joint.name),
            parent: Some(self.numbers[joint.parent]),
            at: joint.origin,
            axis: joint.axis,
            kind,
            limits: joint.limits,
            ..definition
        };
        if definition.kind.has_axis() {
            // The first of the joints that share a coordinate adds it, with the limits of the joint that owns it.
            let owner = match self.followed.get(joint.name) {
                Some(followed) => {
                    definition.multiplier = followed.multiplier;
                    definition.offset = followed.offset;
                    definition.limits = followed.joint.limits;
                    followed.joint.name
                }
                None => joint.name,
            };
            definition.coordinate = self.coordinates.get(owner).copied();
            let number = self.builder.add_link(definition)?;
            let taken = self.builder.links()[number].joint.coordinate;
            self.coordinates.insert(owner, taken);
            return Ok(number);
        }
        if joint.kind == JointType::Planar && joint.axis.cross(&Vec3::z()).norm() > 0.0 {
            return self.add_tilted_plane(definition, &joint.axis);
        }
        self.builder.add_link(definition)
    }

    /// Adds a planar joint whose axis is not z. [`JointKind::Planar`] moves in the xy-plane of its frame, so an extra link
    /// is tilted to the axis, and the link is fixed to it.
    fn add_tilted_plane(&mut self, definition: LinkDefinition, axis: &Vec3) -> Result<usize> {
        let half_turn = || Rotation3::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI);
        let turn = Rotation3::rotation_between(&Vec3::z(), &(axis / axis.amax()))
            .unwrap_or_else(half_turn);
        let tilt = Pose {
            rotation: turn.into_inner(),
            translation: Vec3::zeros(),
        };
        let carrier = self.builder.add_link(LinkDefinition {
            name: format!("{}_plane", definition.name),
            body: None,
            at: definition.at.compose(&tilt),
            ..definition.clone()
        })?;
        self.builder.add_link(LinkDefinition {
            joint_name: String::new(),
            kind: JointKind::Fixed,
            parent: Some(carrier),
            at: tilt.inverse(),
            ..definition
        })
    }
}
