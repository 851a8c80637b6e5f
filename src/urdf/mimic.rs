//! What the mimic joints of a URDF file follow.

use std::collections::HashMap;

use super::model::{JointElement, JointType, Model};
use crate::error::{ErrorKind, Result};
use crate::xml::fault;

/// What a mimic joint follows: a multiple of another joint's coordinate plus an offset.
pub(super) struct MimicTarget<'m, 'a, 'i> {
    pub joint: &'m JointElement<'a, 'i>,
    pub multiplier: f64,
    pub offset: f64,
}

/// For each mimic joint, the joint at the end of its chain, with the combined multiplier and offset.
pub(super) fn followed<'m, 'a, 'i>(
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
