//! Reads the elements of an SRDF file into a robot builder.

use std::fmt::Display;
use std::path::Path;

use roxmltree::Node;

use super::report::SrdfReport;
use crate::error::{Error, ErrorKind, Result};
use crate::robot::{
    EndEffector, RobotBuilder, SemanticName, Semantics, VirtualJoint, VirtualJointKind,
};
use crate::whole_file::{read_whole, text_of};
use crate::xml::{children, fault, parse, require_expanded, required};

/// How to read an SRDF file.
#[derive(Clone, Debug, Default)]
pub struct SrdfOptions {
    /// Prepended to the names of links, joints, groups, states and end effectors: that of the URDF's options.
    pub prefix: String,
    /// Skips elements that name links, joints or groups that are not there, and virtual joints to links that are no roots;
    /// counts them.
    pub skip_unknown: bool,
}

/// The largest SRDF file accepted, 64 MiB; those of humanoids have some 100 KiB.
const MAX_SRDF_BYTES: u64 = 1 << 26;

/// At most 4096 end effectors and 256 virtual joints in a file; each is compared with all before it.
const MAX_END_EFFECTORS: usize = 1 << 12;
const MAX_VIRTUAL_JOINTS: usize = 1 << 8;

/// At most 2^20 touch links of all end effectors: several may share a large group.
const MAX_TOUCH_LINKS: usize = 1 << 20;

/// Adds what an SRDF file says to a builder that holds the robot's links. The file is added whole or not at all; errors name
/// file, line and element.
pub fn add_srdf_file(
    builder: &mut RobotBuilder,
    path: &Path,
    options: &SrdfOptions,
) -> Result<SrdfReport> {
    let named = |e: Error| e.within(path.display());
    let bytes = read_whole(path, MAX_SRDF_BYTES).map_err(named)?;
    let text = text_of(&bytes).map_err(named)?;
    add_text(builder, text, options).map_err(named)
}

/// The same for a text: ROS's robot_description_semantic.
pub fn add_srdf_text(
    builder: &mut RobotBuilder,
    text: &str,
    options: &SrdfOptions,
) -> Result<SrdfReport> {
    let named = |e: Error| e.within("SRDF text");
    if text.len() as u64 > MAX_SRDF_BYTES {
        let length = text.len();
        let message = format!("it has {length} bytes; at most {MAX_SRDF_BYTES} are read");
        return Err(named(Error::new(ErrorKind::Unsupported, message)));
    }
    add_text(builder, text, options).map_err(named)
}

fn add_text(builder: &mut RobotBuilder, text: &str, options: &SrdfOptions) -> Result<SrdfReport> {
    let document = parse(text)?;
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        let message = "an SRDF file begins with <robot>";
        return Err(fault(root, ErrorKind::Parse, message));
    }
    require_srdf(root)?;
    let mut extended = builder.clone();
    let semantics = extended.semantics().clone();
    let mut reader = Reader {
        builder: &mut extended,
        options,
        semantics,
        report: SrdfReport::default(),
        touch_links: 0,
    };
    require_count(root, "virtual_joint", MAX_VIRTUAL_JOINTS)?;
    require_count(root, "end_effector", MAX_END_EFFECTORS)?;
    // Virtual joints first: groups and states name them.
    for node in children(root, "virtual_joint") {
        reader.virtual_joint(node)?;
    }
    reader.groups(root)?;
    for node in children(root, "group_state") {
        reader.state(node)?;
    }
    for node in children(root, "end_effector") {
        reader.end_effector(node)?;
    }
    for node in children(root, "passive_joint") {
        reader.passive_joint(node)?;
    }
    reader.pairs(root)?;
    reader.count_skipped(root);
    let Reader {
        semantics, report, ..
    } = reader;
    extended.set_semantics(semantics);
    *builder = extended;
    Ok(report)
}

/// Refuses a URDF file, and a file whose macros were not expanded.
fn require_srdf(root: Node) -> Result<()> {
    let is_read = |node: &Node| READ.contains(&node.tag_name().name());
    let elements = || root.children().filter(Node::is_element);
    if !elements().any(|node| is_read(&node)) {
        let is_urdf = |node: &Node| ["link", "joint"].contains(&node.tag_name().name());
        if let Some(node) = elements().find(is_urdf) {
            let message = "the robot has none of SRDF's elements, but this: is it a URDF file?";
            return Err(fault(node, ErrorKind::Parse, message));
        }
    }
    let read = elements().filter(is_read);
    read.flat_map(|node| node.descendants())
        .try_for_each(require_expanded)
}

fn require_count(root: Node, name: &str, max: usize) -> Result<()> {
    let count = children(root, name).count();
    if count <= max {
        return Ok(());
    }
    let message = format!("it has {count} elements <{name}>; at most {max} are possible");
    Err(fault(root, ErrorKind::Unsupported, message))
}

/// What was read so far.
pub(super) struct Reader<'o> {
    pub builder: &'o mut RobotBuilder,
    pub options: &'o SrdfOptions,
    pub semantics: Semantics,
    pub report: SrdfReport,
    /// Those of all end effectors.
    touch_links: usize,
}

/// The elements that are read.
const READ: [&str; 8] = [
    "group",
    "group_state",
    "end_effector",
    "virtual_joint",
    "passive_joint",
    "disable_collisions",
    "enable_collisions",
    "disable_default_collisions",
];

impl Reader<'_> {
    pub fn prefixed(&self, name: &str) -> String {
        format!("{}{name}", self.options.prefix)
    }

    /// The number of a link; `None` if there is none and the element may be skipped.
    pub fn link(&mut self, node: Node, name: &str) -> Result<Option<u32>> {
        let found = self.builder.find_link(&self.prefixed(name));
        self.or_unknown(node, found.map(|link| link as u32), "link", name)
    }

    /// The number of the link that a joint moves.
    pub fn joint(&mut self, node: Node, name: &str) -> Result<Option<u32>> {
        let found = self.builder.find_joint(&self.prefixed(name));
        self.or_unknown(node, found.map(|link| link as u32), "joint", name)
    }

    /// The index of a group that was read.
    pub fn group(&mut self, node: Node, name: &str) -> Result<Option<usize>> {
        let found = self.semantics.find_group(&self.prefixed(name));
        self.or_unknown(node, found, "group", name)
    }

    pub fn or_unknown<T>(
        &mut self,
        node: Node,
        found: Option<T>,
        what: &str,
        name: &str,
    ) -> Result<Option<T>> {
        if found.is_none() {
            if !self.options.skip_unknown {
                let message = format!("there is no {what} \"{}\"", self.prefixed(name));
                return Err(fault(node, ErrorKind::NotFound, message));
            }
            self.report.unknown_names += 1;
        }
        Ok(found)
    }

    fn virtual_joint(&mut self, node: Node) -> Result<()> {
        let name = required(node, "name")?;
        let named = |e: Error| e.within(format_args!("virtual joint \"{name}\""));
        let kind = match required(node, "type").map_err(named)? {
            "fixed" => VirtualJointKind::Fixed,
            "planar" => VirtualJointKind::Planar,
            "floating" => VirtualJointKind::Floating,
            other => {
                let message = format!("type \"{other}\" is none of fixed, planar and floating");
                return Err(named(fault(node, ErrorKind::Unsupported, message)));
            }
        };
        let parent_frame = required(node, "parent_frame").map_err(named)?;
        let child = required(node, "child_link").map_err(named)?;
        let Some(child_link) = self.link(node, child).map_err(named)? else {
            return Ok(());
        };
        let own = &self.builder.links()[child_link as usize].joint_name;
        let own_name = self.prefixed(name);
        if !own.is_empty() && self.options.skip_unknown {
            self.report.unknown_names += 1;
            return Ok(());
        }
        let message = if !own.is_empty() {
            format!("joint \"{own}\" moves link \"{child}\" already: it is no root")
        } else if self.builder.find_joint(&own_name).is_some() {
            "another joint has this name".to_string()
        } else {
            self.builder.name_joint(child_link as usize, &own_name);
            self.semantics.virtual_joints.push(VirtualJoint {
                name: SemanticName::new(&own_name),
                kind,
                parent_frame: SemanticName::new(parent_frame),
                child_link,
            });
            self.report.virtual_joints += 1;
            return Ok(());
        };
        Err(named(fault(node, ErrorKind::InvalidArgument, message)))
    }

    fn end_effector(&mut self, node: Node) -> Result<()> {
        let name = required(node, "name")?;
        let named = |e: Error| e.within(format_args!("end effector \"{name}\""));
        let own_name = self.prefixed(name);
        if self.semantics.find_end_effector(&own_name).is_some() {
            let message = "another end effector has this name";
            return Err(named(fault(node, ErrorKind::InvalidArgument, message)));
        }
        let parent = required(node, "parent_link").map_err(named)?;
        let group = required(node, "group").map_err(named)?;
        let parent_link = self.link(node, parent).map_err(named)?;
        let group = self.group(node, group).map_err(named)?;
        let parent_group = match node.attribute("parent_group") {
            Some(group) => self.group(node, group).map_err(named)?,
            None => None,
        };
        let (Some(parent_link), Some(group)) = (parent_link, group) else {
            return Ok(());
        };
        let mut touch_links = self.semantics.groups[group].joints.clone();
        touch_links.push(parent_link);
        touch_links.sort_unstable();
        touch_links.dedup();
        let links = self.builder.links();
        touch_links.retain(|&link| links[link as usize].body.is_some());
        self.touch_links += touch_links.len();
        if self.touch_links > MAX_TOUCH_LINKS {
            let message = format!("the end effectors have more than {MAX_TOUCH_LINKS} links");
            return Err(named(fault(node, ErrorKind::Unsupported, message)));
        }
        self.semantics.end_effectors.push(EndEffector {
            name: SemanticName::new(&own_name),
            group,
            parent_link,
            parent_group,
            touch_links,
        });
        self.report.end_effectors += 1;
        Ok(())
    }

    fn passive_joint(&mut self, node: Node) -> Result<()> {
        let name = required(node, "name")?;
        if let Some(joint) = self.joint(node, name)? {
            let passive = &mut self.semantics.passive_joints;
            if let Err(place) = passive.binary_search(&joint) {
                passive.insert(place, joint);
            }
            self.report.passive_joints += 1;
        }
        Ok(())
    }

    /// The rules for pairs: what is disabled by name holds against what is enabled, and that against a link's default.
    fn pairs(&mut self, root: Node) -> Result<()> {
        for node in children(root, "disable_default_collisions") {
            let name = required(node, "link")?;
            if let Some(link) = self.link(node, name)? {
                self.semantics.pairs.disable_all_of(link);
            }
        }
        for node in children(root, "enable_collisions") {
            if let Some(pair) = self.pair(node)? {
                self.semantics.pairs.enable(pair);
            }
        }
        for node in children(root, "disable_collisions") {
            if let Some(pair) = self.pair(node)? {
                let is_new = self.semantics.pairs.disable(pair);
                self.report.disabled_pairs += usize::from(is_new);
            }
        }
        Ok(())
    }

    fn pair(&mut self, node: Node) -> Result<Option<[u32; 2]>> {
        let names = [required(node, "link1")?, required(node, "link2")?];
        let a = self.link(node, names[0])?;
        let b = self.link(node, names[1])?;
        let (Some(a), Some(b)) = (a, b) else {
            return Ok(None);
        };
        if a == b {
            let message = format!("link \"{}\" is paired with itself", names[0]);
            return Err(fault(node, ErrorKind::InvalidArgument, message));
        }
        Ok(Some([a, b]))
    }

    fn count_skipped(&mut self, root: Node) {
        let elements = root.children().filter(Node::is_element);
        let is_skipped = |node: &Node| !READ.contains(&node.tag_name().name());
        self.report.skipped_elements += elements.filter(is_skipped).count();
    }
}

/// An error of an element that says what cannot be.
pub(super) fn invalid(node: Node, message: impl Display) -> Error {
    fault(node, ErrorKind::InvalidArgument, message)
}
