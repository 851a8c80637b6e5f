//! Joint groups: their joints by name, by the links they move, by chains, and by other groups.

use std::collections::HashMap;

use roxmltree::Node;

use super::reader::{Reader, invalid};
use crate::error::{Error, ErrorKind, Result};
use crate::robot::{JointGroup, Link, SemanticName};
use crate::xml::{children, fault, required};

/// At most 4096 groups in a file; the largest have some twenty.
const MAX_GROUPS: usize = 1 << 12;

/// At most 2^22 joints in all groups together, those of chains and of groups in others counted each time.
const MAX_GROUP_JOINTS: usize = 1 << 22;

/// A group while the file is read.
struct GroupElement<'a, 'i> {
    node: Node<'a, 'i>,
    name: &'a str,
    /// The groups in it, by index in the file.
    inner: Vec<usize>,
    joints: Vec<u32>,
}

impl Reader<'_> {
    /// Reads all groups of a file, those that others hold first.
    pub fn groups(&mut self, root: Node) -> Result<()> {
        let nodes: Vec<Node> = children(root, "group").collect();
        if nodes.len() > MAX_GROUPS {
            let count = nodes.len();
            let message = format!("it has {count} groups; at most {MAX_GROUPS} are possible");
            return Err(fault(root, ErrorKind::Unsupported, message));
        }
        let mut indices = HashMap::new();
        for (i, node) in nodes.iter().enumerate() {
            let name = required(*node, "name")?;
            let is_taken = self.semantics.find_group(&self.prefixed(name)).is_some();
            if is_taken || indices.insert(name, i).is_some() {
                return Err(invalid(
                    *node,
                    format_args!("another group is called \"{name}\""),
                ));
            }
        }
        let mut budget = MAX_GROUP_JOINTS;
        let mut groups = Vec::new();
        for node in nodes {
            let name = required(node, "name")?;
            let read = self.group_element(node, name, &indices, &mut budget);
            groups.push(read.map_err(|e| e.within(format_args!("group \"{name}\"")))?);
        }
        for index in inner_first(&groups)? {
            let mut joints = std::mem::take(&mut groups[index].joints);
            for &inner in &groups[index].inner {
                take(&mut budget, groups[index].node, groups[inner].joints.len())?;
                joints.extend_from_slice(&groups[inner].joints);
            }
            joints.sort_unstable();
            joints.dedup();
            groups[index].joints = joints;
        }
        for group in groups {
            let links = self.builder.links();
            let coordinates = coordinates(links, &group.joints);
            self.semantics.groups.push(JointGroup {
                name: SemanticName::new(&self.prefixed(group.name)),
                joints: group.joints,
                coordinates,
            });
            self.report.groups += 1;
        }
        Ok(())
    }

    fn group_element<'a, 'i>(
        &mut self,
        node: Node<'a, 'i>,
        name: &'a str,
        indices: &HashMap<&str, usize>,
        budget: &mut usize,
    ) -> Result<GroupElement<'a, 'i>> {
        let mut group = GroupElement {
            node,
            name,
            inner: Vec::new(),
            joints: Vec::new(),
        };
        // Those of chains are paid for before they are listed.
        let mut of_chains = 0;
        for element in node.children().filter(Node::is_element) {
            match element.tag_name().name() {
                "joint" => {
                    let joint = self.joint(element, required(element, "name")?)?;
                    group.joints.extend(joint);
                }
                "link" => {
                    if let Some(link) = self.link(element, required(element, "name")?)? {
                        group.joints.push(jointed(self.builder.links(), link));
                    }
                }
                "chain" => {
                    let base = self.link(element, required(element, "base_link")?)?;
                    let tip = self.link(element, required(element, "tip_link")?)?;
                    if let (Some(base), Some(tip)) = (base, tip) {
                        let links = self.builder.links();
                        let steps = chain(links, [base, tip], *budget);
                        take(budget, element, steps.as_ref().map_or(usize::MAX, Vec::len))?;
                        let steps = steps.unwrap_or_default();
                        of_chains += steps.len();
                        group.joints.extend(steps);
                    }
                }
                "group" => {
                    let other = required(element, "name")?;
                    let found = indices.get(other).copied();
                    group
                        .inner
                        .extend(self.or_unknown(element, found, "group", other)?);
                }
                _ => self.report.skipped_elements += 1,
            }
        }
        take(budget, node, group.joints.len() - of_chains)?;
        Ok(group)
    }
}

/// The coordinates of joints, ascending.
fn coordinates(links: &[Link], joints: &[u32]) -> Vec<u32> {
    let own = joints.iter().flat_map(|&link| {
        let joint = &links[link as usize].joint;
        let first = joint.coordinate as u32;
        first..first + joint.kind.nq() as u32
    });
    let mut coordinates: Vec<u32> = own.collect();
    coordinates.sort_unstable();
    coordinates.dedup();
    coordinates
}

/// The link whose joint moves a link: itself, or the carrier that a planar joint needs (it alone has an unnamed joint to a
/// parent that a named one moves).
fn jointed(links: &[Link], link: u32) -> u32 {
    let own = &links[link as usize];
    match own.parent {
        Some(parent) if own.joint_name.is_empty() && own.joint.kind.nq() == 0 => {
            let is_carrier = links[parent].name == format!("{}_plane", own.name);
            if is_carrier { parent as u32 } else { link }
        }
        _ => link,
    }
}

/// The links that the joints on the way from one link to the other move: up to where the ways to the world meet, and down.
/// `None` if there are more than `limit`.
fn chain(links: &[Link], [base, tip]: [u32; 2], limit: usize) -> Option<Vec<u32>> {
    // Parents have lower numbers, and the world none: the higher of the two is never where the ways meet.
    let (mut a, mut b) = (Some(base as usize), Some(tip as usize));
    let mut joints = Vec::new();
    while a != b {
        let higher = if a > b { &mut a } else { &mut b };
        let link = (*higher)?;
        if joints.len() == limit {
            return None;
        }
        joints.push(link as u32);
        *higher = links[link].parent;
    }
    Some(joints)
}

fn take(budget: &mut usize, node: Node, count: usize) -> Result<()> {
    match budget.checked_sub(count) {
        Some(rest) => {
            *budget = rest;
            Ok(())
        }
        None => {
            let message = format!("the groups have more than {MAX_GROUP_JOINTS} joints");
            Err(fault(node, ErrorKind::Unsupported, message))
        }
    }
}

/// The groups in an order in which each stands after those in it. Refuses groups that hold each other.
fn inner_first(groups: &[GroupElement]) -> Result<Vec<usize>> {
    let mut order = Vec::new();
    // Not seen, open, done.
    let mut state = vec![0u8; groups.len()];
    for start in 0..groups.len() {
        if state[start] == 2 {
            continue;
        }
        state[start] = 1;
        let mut stack = vec![(start, 0)];
        while let Some((index, next)) = stack.last_mut() {
            let Some(&inner) = groups[*index].inner.get(*next) else {
                state[*index] = 2;
                order.push(*index);
                stack.pop();
                continue;
            };
            *next += 1;
            match state[inner] {
                0 => {
                    state[inner] = 1;
                    stack.push((inner, 0));
                }
                1 => return Err(circle(groups, inner)),
                _ => {}
            }
        }
    }
    Ok(order)
}

fn circle(groups: &[GroupElement], index: usize) -> Error {
    let group = &groups[index];
    let message = "the groups in it form a circle";
    invalid(group.node, message).within(format_args!("group \"{}\"", group.name))
}
