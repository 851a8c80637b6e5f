//! Named states: values for the coordinates of a group.

use std::collections::{BTreeMap, HashSet};

use roxmltree::Node;

use super::reader::{Reader, invalid};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::robot::{Joint, JointKind, NamedState, SemanticName};
use crate::xml::{children, fault, list, required};

/// At most 4096 states in a file; each is compared with all before it.
const MAX_STATES: usize = 1 << 12;

/// How far the norm of a written quaternion may be off 1: three digits are.
const MAX_NORM_ERROR: f64 = 1e-2;

/// A value that some joint gives its coordinate.
struct Value {
    number: f64,
    /// The joint moves by a multiple of the coordinate; another's own value is stronger.
    is_derived: bool,
}

impl Reader<'_> {
    pub fn state(&mut self, node: Node) -> Result<()> {
        let name = required(node, "name")?;
        let named = |e: Error| e.within(format_args!("group state \"{name}\""));
        if self.report.states == MAX_STATES {
            let message = format!("more than {MAX_STATES} states");
            return Err(named(fault(node, ErrorKind::Unsupported, message)));
        }
        let group = match node.attribute("group") {
            Some(group) => {
                let Some(found) = self.group(node, group).map_err(named)? else {
                    return Ok(());
                };
                Some(found)
            }
            None => None,
        };
        let own_name = self.prefixed(name);
        if self.semantics.find_state(group, &own_name).is_some() {
            let message = "another state of this group has this name";
            return Err(named(invalid(node, message)));
        }
        let values = self.values(node, group).map_err(named)?;
        self.semantics.states.push(NamedState {
            name: SemanticName::new(&own_name),
            group,
            coordinates: values.keys().copied().collect(),
            values: values.values().map(|value| value.number).collect(),
        });
        self.report.states += 1;
        Ok(())
    }

    fn values(&mut self, node: Node, group: Option<usize>) -> Result<BTreeMap<u32, Value>> {
        let mut values: BTreeMap<u32, Value> = BTreeMap::new();
        let mut seen = HashSet::new();
        for element in children(node, "joint") {
            let name = required(element, "name")?;
            let named = |e: Error| e.within(format_args!("joint \"{name}\""));
            let Some(link) = self.joint(element, name)? else {
                continue;
            };
            if !seen.insert(link) {
                return Err(named(invalid(
                    element,
                    "the state has a value for it already",
                )));
            }
            let text = required(element, "value").map_err(named)?;
            let numbers = list::<f64>(element, "value", text).map_err(named)?;
            require_coordinates(&numbers, "value")
                .map_err(|e| named(fault(element, e.kind, e.message)))?;
            let joint = &self.builder.links()[link as usize].joint;
            let mut virtual_joints = self.semantics.virtual_joints.iter();
            let is_virtual = virtual_joints.any(|joint| joint.child_link == link);
            let is_fixed = joint.kind.nq() == 0;
            let is_outside = group.is_some_and(|group| {
                let joints = &self.semantics.groups[group].joints;
                joints.binary_search(&link).is_err()
            });
            if is_outside {
                // The state is of its group alone.
                self.report.unused_values += 1;
                continue;
            }
            if is_fixed || (is_virtual && numbers.len() != joint.kind.nq()) {
                // The base was loaded with another joint than the file has in mind.
                self.report.unused_values += 1;
                continue;
            }
            let numbers = own_coordinates(element, joint, numbers).map_err(named)?;
            let Some(numbers) = numbers else {
                self.report.unused_values += 1;
                continue;
            };
            let is_derived = (joint.multiplier, joint.offset) != (1.0, 0.0);
            let mut is_used = false;
            for (i, number) in numbers.into_iter().enumerate() {
                let coordinate = (joint.coordinate + i) as u32;
                let taken = values.get(&coordinate);
                if taken.is_none_or(|value| value.is_derived && !is_derived) {
                    values.insert(coordinate, Value { number, is_derived });
                    is_used = true;
                }
            }
            self.report.unused_values += usize::from(!is_used);
        }
        Ok(values)
    }
}

/// The coordinates of a joint at written values; `None` where no coordinate brings it there.
fn own_coordinates(node: Node, joint: &Joint, numbers: Vec<f64>) -> Result<Option<Vec<f64>>> {
    let count = joint.kind.nq();
    if numbers.len() != count {
        let message = format!("value has {} numbers, not {count}", numbers.len());
        return Err(fault(node, ErrorKind::WrongSize, message));
    }
    let mut numbers = numbers;
    if joint.kind.has_axis() {
        if joint.multiplier == 0.0 {
            return Ok(None);
        }
        numbers[0] = (numbers[0] - joint.offset) / joint.multiplier;
        require_coordinates(&numbers, "coordinate").map_err(|e| fault(node, e.kind, e.message))?;
    }
    if matches!(joint.kind, JointKind::Spherical | JointKind::Free) {
        let quaternion = &mut numbers[count - 4..];
        let norm = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (norm - 1.0).abs() > MAX_NORM_ERROR {
            let message = format!("the last four numbers are a quaternion of norm {norm}, not 1");
            return Err(fault(node, ErrorKind::NotARotation, message));
        }
        quaternion.iter_mut().for_each(|x| *x /= norm);
    }
    Ok(Some(numbers))
}
