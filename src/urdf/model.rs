//! The elements of a URDF file, with every number checked.

use roxmltree::Node;

use crate::error::{ErrorKind, Result};
use crate::pose::{Pose, Vec3};
use crate::xml::{child, children, fault, numbers, require_expanded, required, required_child};

/// Limits the links and the joints of a file. The largest humanoids have some hundred links; generated chains have
/// thousands.
const MAX_LINKS: usize = 1 << 17;

/// A shape in its own frame.
#[derive(Debug)]
pub enum Shape {
    Box { size: [f64; 3] },
    Sphere { radius: f64 },
    Cylinder { radius: f64, length: f64 },
    Capsule { radius: f64, length: f64 },
    Mesh { file: String, scale: [f64; 3] },
}

/// A shape of a link.
pub struct Geometry<'a, 'i> {
    pub node: Node<'a, 'i>,
    pub origin: Pose,
    pub shape: Shape,
}

/// A <link>.
pub struct LinkElement<'a, 'i> {
    pub node: Node<'a, 'i>,
    pub name: &'a str,
    pub geometry: Vec<Geometry<'a, 'i>>,
    /// The link has shapes of a kind that is not read.
    pub has_other_shapes: bool,
}

/// The kind of a <joint>.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointType {
    Fixed,
    Revolute,
    Continuous,
    Prismatic,
    Planar,
    Floating,
    Spherical,
}

/// A <mimic>: the joint follows `multiplier * other + offset`.
pub struct Mimic<'a> {
    pub joint: &'a str,
    pub multiplier: f64,
    pub offset: f64,
}

/// A <joint>.
pub struct JointElement<'a, 'i> {
    pub node: Node<'a, 'i>,
    pub name: &'a str,
    pub kind: JointType,
    pub parent: &'a str,
    pub child: &'a str,
    pub origin: Pose,
    pub axis: Vec3,
    pub limits: [f64; 2],
    pub mimic: Option<Mimic<'a>>,
}

/// A <robot>.
pub struct Model<'a, 'i> {
    pub node: Node<'a, 'i>,
    pub links: Vec<LinkElement<'a, 'i>>,
    pub joints: Vec<JointElement<'a, 'i>>,
    /// The number of elements that are not read.
    pub skipped_elements: usize,
}

impl<'a, 'i> Model<'a, 'i> {
    /// Reads the robot. `geometry` names the elements that hold the links' shapes; without it no shapes are read.
    pub fn read(root: Node<'a, 'i>, geometry: Option<&str>) -> Result<Self> {
        if root.tag_name().name() != "robot" {
            return Err(fault(
                root,
                ErrorKind::Parse,
                "a URDF file begins with <robot>",
            ));
        }
        for name in ["link", "joint"] {
            let count = children(root, name).count();
            if count > MAX_LINKS {
                let message = format!("it has {count} {name}s; at most {MAX_LINKS} are possible");
                return Err(fault(root, ErrorKind::Unsupported, message));
            }
        }
        // What a macro would have added is not there; elements that are not read, such as those of a simulator, may hold anything.
        let is_known = |node: &Node| ["link", "joint"].contains(&node.tag_name().name());
        for element in root.children().filter(Node::is_element) {
            if is_known(&element) {
                element.descendants().try_for_each(require_expanded)?;
            } else if element.tag_name().namespace().is_some() {
                require_expanded(element)?;
            }
        }
        let links: Vec<_> = children(root, "link")
            .map(|node| read_link(node, geometry))
            .collect::<Result<_>>()?;
        // Only the joints directly in the robot: those in <transmission> and the like are references.
        let joints: Vec<_> = children(root, "joint")
            .map(read_joint)
            .collect::<Result<_>>()?;
        let of_links = links
            .iter()
            .map(|link: &LinkElement| link.skipped_elements(geometry));
        let of_joints = joints.iter().map(|joint: &JointElement| {
            skipped(
                joint.node,
                &["origin", "parent", "child", "axis", "limit", "mimic"],
            )
        });
        Ok(Self {
            node: root,
            skipped_elements: skipped(root, &["link", "joint"])
                + of_links.chain(of_joints).sum::<usize>(),
            links,
            joints,
        })
    }
}

impl LinkElement<'_, '_> {
    fn skipped_elements(&self, geometry: Option<&str>) -> usize {
        let in_shape = |shape: &Geometry| {
            let own = skipped(shape.node, &["origin", "geometry"]);
            // Of several shapes in one <geometry>, the first is read.
            let shapes = child(shape.node, "geometry").into_iter();
            own + shapes.map(|node| skipped(node, &[]) - 1).sum::<usize>()
        };
        let in_shapes: usize = self.geometry.iter().map(in_shape).sum();
        skipped(self.node, geometry.as_slice()) + in_shapes
    }
}

/// Counts the child elements whose name is not in `read`.
fn skipped(node: Node, read: &[&str]) -> usize {
    let elements = node.children().filter(Node::is_element);
    elements
        .filter(|element| !read.contains(&element.tag_name().name()))
        .count()
}

fn read_link<'a, 'i>(node: Node<'a, 'i>, geometry: Option<&str>) -> Result<LinkElement<'a, 'i>> {
    let name = required(node, "name")?;
    let named = |e: crate::error::Error| e.within(format_args!("link \"{name}\""));
    let elements = children(node, geometry.unwrap_or_default());
    Ok(LinkElement {
        node,
        name,
        geometry: elements
            .map(read_geometry)
            .collect::<Result<_>>()
            .map_err(named)?,
        has_other_shapes: ["collision", "visual"]
            .into_iter()
            .any(|kind| geometry != Some(kind) && child(node, kind).is_some()),
    })
}

fn read_geometry<'a, 'i>(node: Node<'a, 'i>) -> Result<Geometry<'a, 'i>> {
    let geometry = required_child(node, "geometry")?;
    let shape = geometry
        .children()
        .find(Node::is_element)
        .ok_or_else(|| fault(geometry, ErrorKind::Parse, "it holds no shape"))?;
    let positive = |attribute: &str| {
        let [value] = numbers::<1>(shape, attribute, required(shape, attribute)?)?;
        if value > 0.0 {
            return Ok(value);
        }
        let message = format!("{attribute} is {value}; it must be larger than 0");
        Err(fault(shape, ErrorKind::InvalidArgument, message))
    };
    let shape = match shape.tag_name().name() {
        "box" => {
            let size = numbers::<3>(shape, "size", required(shape, "size")?)?;
            if let Some(value) = size.iter().find(|x| **x <= 0.0) {
                let message = format!("size holds {value}; all must be larger than 0");
                return Err(fault(shape, ErrorKind::InvalidArgument, message));
            }
            Shape::Box { size }
        }
        "sphere" => Shape::Sphere {
            radius: positive("radius")?,
        },
        "cylinder" => Shape::Cylinder {
            radius: positive("radius")?,
            length: positive("length")?,
        },
        "capsule" => Shape::Capsule {
            radius: positive("radius")?,
            length: positive("length")?,
        },
        "mesh" => {
            let scale = match shape.attribute("scale") {
                Some(text) => numbers::<3>(shape, "scale", text)?,
                None => [1.0; 3],
            };
            if scale.contains(&0.0) {
                return Err(fault(shape, ErrorKind::Degenerate, "scale holds a 0"));
            }
            Shape::Mesh {
                file: required(shape, "filename")?.to_string(),
                scale,
            }
        }
        other => {
            let message = format!("<{other}> is no shape: box, sphere, cylinder, capsule or mesh");
            return Err(fault(shape, ErrorKind::Unsupported, message));
        }
    };
    Ok(Geometry {
        node,
        origin: origin(node)?,
        shape,
    })
}

fn read_joint<'a, 'i>(node: Node<'a, 'i>) -> Result<JointElement<'a, 'i>> {
    let name = required(node, "name")?;
    read_named_joint(node, name).map_err(|e| e.within(format_args!("joint \"{name}\"")))
}

fn read_named_joint<'a, 'i>(node: Node<'a, 'i>, name: &'a str) -> Result<JointElement<'a, 'i>> {
    let kind = match required(node, "type")? {
        "fixed" => JointType::Fixed,
        "revolute" => JointType::Revolute,
        "continuous" => JointType::Continuous,
        "prismatic" => JointType::Prismatic,
        "planar" => JointType::Planar,
        "floating" => JointType::Floating,
        "spherical" => JointType::Spherical,
        other => {
            let message = format!("type \"{other}\" is no joint");
            return Err(fault(node, ErrorKind::Unsupported, message));
        }
    };
    let axis = match child(node, "axis") {
        Some(axis) => Vec3::from(numbers::<3>(axis, "xyz", required(axis, "xyz")?)?),
        None => Vec3::x(),
    };
    let has_axis = !matches!(
        kind,
        JointType::Fixed | JointType::Floating | JointType::Spherical
    );
    if has_axis && axis.norm() == 0.0 {
        return Err(fault(node, ErrorKind::Degenerate, "its axis has no length"));
    }
    let is_limited = matches!(kind, JointType::Revolute | JointType::Prismatic);
    let limits = if is_limited {
        let limit = required_child(node, "limit")?;
        let number = |attribute: &str| match limit.attribute(attribute) {
            Some(text) => Ok(numbers::<1>(limit, attribute, text)?[0]),
            None => Ok(0.0),
        };
        [number("lower")?, number("upper")?]
    } else {
        [f64::NEG_INFINITY, f64::INFINITY]
    };
    if limits[0] > limits[1] {
        let message = format!("its limits are empty: {} to {}", limits[0], limits[1]);
        return Err(fault(node, ErrorKind::InvalidArgument, message));
    }
    let mimic = child(node, "mimic")
        .map(|mimic| read_mimic(mimic))
        .transpose()?;
    // A fixed joint does not move, so its mimic is ignored.
    let mimic = mimic.filter(|_| kind != JointType::Fixed);
    if let (Some(_), false) = (&mimic, is_limited || kind == JointType::Continuous) {
        let message = "only revolute, continuous and prismatic joints can mimic others";
        return Err(fault(node, ErrorKind::Unsupported, message));
    }
    let link = |name: &str| required(required_child(node, name)?, "link");
    Ok(JointElement {
        node,
        name,
        kind,
        parent: link("parent")?,
        child: link("child")?,
        origin: origin(node)?,
        axis,
        limits,
        mimic,
    })
}

fn read_mimic<'a>(node: Node<'a, '_>) -> Result<Mimic<'a>> {
    let number = |attribute: &str, default: f64| match node.attribute(attribute) {
        Some(text) => Ok(numbers::<1>(node, attribute, text)?[0]),
        None => Ok(default),
    };
    Ok(Mimic {
        joint: required(node, "joint")?,
        multiplier: number("multiplier", 1.0)?,
        offset: number("offset", 0.0)?,
    })
}

/// The <origin> of an element: a translation, and rotations about the fixed x, then y, then z.
fn origin(node: Node) -> Result<Pose> {
    let Some(origin) = child(node, "origin") else {
        return Ok(Pose::identity());
    };
    let triple = |attribute: &str| match origin.attribute(attribute) {
        Some(text) => numbers::<3>(origin, attribute, text),
        None => Ok([0.0; 3]),
    };
    let [[x, y, z], [roll, pitch, yaw]] = [triple("xyz")?, triple("rpy")?];
    Ok(Pose::from_rpy(&[x, y, z, roll, pitch, yaw]))
}
