//! Turns the elements of a URDF file into links of a robot builder.

use std::collections::HashMap;
use std::path::Path;

use nalgebra::{Rotation3, Unit};

use super::bodies::LinkBodies;
use super::link_tree::LinkTree;
use super::mimic::{MimicTarget, followed};
use super::model::{JointElement, JointType, LinkElement, Model};
use super::options::{BaseJoint, UrdfGeometry, UrdfOptions, check};
use super::packages::PackageFolders;
use super::report::UrdfReport;
use super::shapes::ShapeReader;
use crate::body::BodyCache;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::{Pose, Vec3};
use crate::robot::{JointKind, LinkDefinition, RobotBuilder};
use crate::whole_file::{read_whole, text_of};
use crate::xml::parse;

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
    let order = LinkTree::of(&model)?.links_by_depth();
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
        // One that points straight down is tilted too: it turns the other way round.
        let is_upright = joint.axis.x == 0.0 && joint.axis.y == 0.0 && joint.axis.z > 0.0;
        if joint.kind == JointType::Planar && !is_upright {
            return self.add_tilted_plane(definition, &joint.axis);
        }
        self.builder.add_link(definition)
    }

    /// Adds a planar joint whose axis is not z. [`JointKind::Planar`] moves in the xy-plane of its frame, so an extra link
    /// is tilted to the axis, and the link is fixed to it.
    fn add_tilted_plane(&mut self, definition: LinkDefinition, axis: &Vec3) -> Result<usize> {
        // The shortest turn from z. By its sine and cosine: near the half turn the cosine alone says little.
        let across = Vec3::z().cross(&(axis / axis.amax()));
        let turn = match across.amax() {
            0.0 => Rotation3::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI),
            largest => {
                let about = Unit::new_normalize(across / largest);
                let angle = across.norm().atan2(axis.z / axis.amax());
                Rotation3::from_axis_angle(&about, angle)
            }
        };
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
