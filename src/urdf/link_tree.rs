//! The tree of a URDF file's links.

use std::collections::{HashMap, HashSet};

use super::model::{JointElement, LinkElement, Model};
use crate::error::{ErrorKind, Result};
use crate::xml::fault;

/// The links of a model and the joints between them, checked to form a tree.
pub(super) struct LinkTree<'m, 'a, 'i> {
    root: &'m LinkElement<'a, 'i>,
    links: HashMap<&'a str, &'m LinkElement<'a, 'i>>,
    /// By the parent's name, in file order.
    joints: HashMap<&'a str, Vec<&'m JointElement<'a, 'i>>>,
}

/// A link with the joint that moves it; the root has none.
pub(super) type Jointed<'m, 'a, 'i> = (&'m LinkElement<'a, 'i>, Option<&'m JointElement<'a, 'i>>);

impl<'m, 'a, 'i> LinkTree<'m, 'a, 'i> {
    pub fn of(model: &'m Model<'a, 'i>) -> Result<Self> {
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
    pub fn links_by_depth(&self) -> Vec<Jointed<'m, 'a, 'i>> {
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
