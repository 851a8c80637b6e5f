//! What was read of a robot.

use std::ffi::c_char;

use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, slice, start, text};
use crate::capi::robot::joint::cstk_joint_kind;
use crate::capi::robot::robot::cstk_robot;
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::robot::{Robot, Semantics, VirtualJointKind, check_configuration};

/// Counts of what SRDF files say of a robot.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_semantics {
    pub group_count: u32,
    pub state_count: u32,
    pub end_effector_count: u32,
    pub virtual_joint_count: u32,
    /// The passive joints, by the number of the link that each moves, ascending. The array belongs to the robot.
    pub passive_joints: *const u32,
    pub passive_joint_count: usize,
    pub reserved: [u64; 4],
}

/// A joint group. Name and arrays belong to the robot and live as long as it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_joint_group {
    pub name: *const c_char,
    /// The joints, by the number of the link that each moves, ascending: those named, those on chains, those of groups in
    /// it; also joints that are fixed.
    pub joints: *const u32,
    pub joint_count: usize,
    /// Where their coordinates stand in q, ascending; none twice where joints share one.
    pub coordinates: *const u32,
    pub coordinate_count: usize,
    pub reserved: [u64; 4],
}

/// A named state. Name and arrays belong to the robot and live as long as it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_named_state {
    pub name: *const c_char,
    /// The index of its group, or -1 where the file names none.
    pub group: i32,
    pub reserved_number: u32,
    /// The coordinates that it sets, ascending, and their values.
    pub coordinates: *const u32,
    pub values: *const f64,
    pub count: usize,
    pub reserved: [u64; 4],
}

/// An end effector. Name and array belong to the robot and live as long as it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_end_effector {
    pub name: *const c_char,
    /// The index of the group of its joints.
    pub group: u32,
    /// The index of the arm's group, or -1 where the file names none.
    pub parent_group: i32,
    /// The link that carries it.
    pub parent_link: u32,
    pub reserved_number: u32,
    /// The links with bodies that an object it holds may touch, for CSTK_CHANGE_ATTACH: those that its joints move, and the
    /// parent link.
    pub touch_links: *const u32,
    pub touch_count: usize,
    pub reserved: [u64; 4],
}

/// A virtual joint: how the file means the robot to be carried. What carries it is the `base` of cstk_urdf_options; its
/// joint gets this name. Names belong to the robot and live as long as it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_virtual_joint {
    pub name: *const c_char,
    pub parent_frame: *const c_char,
    /// CSTK_JOINT_FIXED, _PLANAR or, for a floating one, _FREE.
    pub kind: cstk_joint_kind,
    /// The root link.
    pub child_link: u32,
    pub reserved: [u64; 4],
}

/// Writes the counts of what SRDF files say of the robot; all are 0 where none was read. The pairs to test are written by
/// cstk_space_get_enabled_pairs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_semantics(
    robot: *const cstk_robot,
    out: *mut cstk_semantics,
) -> cstk_status {
    guard(|| {
        let robot = handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let semantics = robot.semantics();
        out.write(cstk_semantics {
            group_count: semantics.groups.len() as u32,
            state_count: semantics.states.len() as u32,
            end_effector_count: semantics.end_effectors.len() as u32,
            virtual_joint_count: semantics.virtual_joints.len() as u32,
            passive_joints: start(&semantics.passive_joints),
            passive_joint_count: semantics.passive_joints.len(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Writes the index of the group with this name. CSTK_ERROR_NOT_FOUND if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_find_group(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states that it is terminated.
    guard(|| unsafe { find(robot, name, out, "group", Semantics::find_group) })
}

/// Writes the index of the end effector with this name. CSTK_ERROR_NOT_FOUND if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_find_end_effector(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states that it is terminated.
    guard(|| unsafe {
        find(
            robot,
            name,
            out,
            "end effector",
            Semantics::find_end_effector,
        )
    })
}

unsafe fn find(
    robot: *const cstk_robot,
    name: *const c_char,
    out: *mut u32,
    what: &str,
    find: impl Fn(&Semantics, &str) -> Option<usize>,
) -> Result<(), Failure> {
    let robot = handle::share::<Robot>(robot, "robot")?;
    let out = Output::checked(out, "out")?;
    // SAFETY: as the caller states.
    let name = unsafe { text(name, "name")? };
    let found = find(robot.semantics(), name).ok_or_else(|| {
        let message = format!("the robot has no {what} \"{name}\"");
        Error::new(ErrorKind::NotFound, message)
    })?;
    out.write(found as u32);
    Ok(())
}

/// Writes the index of the state with this name. `group` names its group; NULL for a state of which the file names none.
/// CSTK_ERROR_NOT_FOUND if there is no such group or state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_find_state(
    robot: *const cstk_robot,
    group: *const c_char,
    name: *const c_char,
    out: *mut u32,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states that it is terminated.
    guard(|| unsafe {
        let group = match group.is_null() {
            true => None,
            false => Some(text(group, "group")?),
        };
        let of_group = |semantics: &Semantics, name: &str| match group {
            None => semantics.find_state(None, name),
            Some(group) => semantics.find_state(Some(semantics.find_group(group)?), name),
        };
        let what = match group {
            None => "state of no group".to_string(),
            Some(group) => format!("state of a group \"{group}\" that is called"),
        };
        find(robot, name, out, &what, of_group)
    })
}

/// Writes a joint group, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_group(
    robot: *const cstk_robot,
    group: u32,
    out: *mut cstk_joint_group,
) -> cstk_status {
    guard(|| {
        let robot = handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let found = at(&robot.semantics().groups, group, "group")?;
        out.write(cstk_joint_group {
            name: found.name.as_c_str().as_ptr(),
            joints: start(&found.joints),
            joint_count: found.joints.len(),
            coordinates: start(&found.coordinates),
            coordinate_count: found.coordinates.len(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Writes a named state, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_state(
    robot: *const cstk_robot,
    state: u32,
    out: *mut cstk_named_state,
) -> cstk_status {
    guard(|| {
        let robot = handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let found = at(&robot.semantics().states, state, "state")?;
        out.write(cstk_named_state {
            name: found.name.as_c_str().as_ptr(),
            group: found.group.map_or(-1, |group| group as i32),
            reserved_number: 0,
            coordinates: start(&found.coordinates),
            values: start(&found.values),
            count: found.values.len(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Puts the values of a named state, by its index, into the configuration q (`nq` doubles); all other coordinates of q stay
/// as they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_apply_state(
    robot: *const cstk_robot,
    state: u32,
    q: *mut f64,
    nq: usize,
) -> cstk_status {
    guard(|| {
        let robot = handle::share::<Robot>(robot, "robot")?;
        let out = OutputSlice::checked(q, nq, "q")?;
        let found = at(&robot.semantics().states, state, "state")?;
        // SAFETY: checked for NULL; the caller states the length.
        let mut changed = unsafe { slice(q.cast_const(), nq, "q")? }.to_vec();
        check_configuration(&changed, robot.nq(), robot.blocks())?;
        for (&coordinate, &value) in found.coordinates.iter().zip(&found.values) {
            changed[coordinate as usize] = value;
        }
        out.write(&changed);
        Ok(())
    })
}

/// Writes an end effector, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_end_effector(
    robot: *const cstk_robot,
    end_effector: u32,
    out: *mut cstk_end_effector,
) -> cstk_status {
    guard(|| {
        let robot = handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let found = at(
            &robot.semantics().end_effectors,
            end_effector,
            "end effector",
        )?;
        out.write(cstk_end_effector {
            name: found.name.as_c_str().as_ptr(),
            group: found.group as u32,
            parent_group: found.parent_group.map_or(-1, |group| group as i32),
            parent_link: found.parent_link,
            reserved_number: 0,
            touch_links: start(&found.touch_links),
            touch_count: found.touch_links.len(),
            reserved: [0; 4],
        });
        Ok(())
    })
}

/// Writes a virtual joint, by its index. CSTK_ERROR_NOT_FOUND for an index that the robot does not have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_get_virtual_joint(
    robot: *const cstk_robot,
    virtual_joint: u32,
    out: *mut cstk_virtual_joint,
) -> cstk_status {
    guard(|| {
        let robot = handle::share::<Robot>(robot, "robot")?;
        let out = Output::checked(out, "out")?;
        let found = at(
            &robot.semantics().virtual_joints,
            virtual_joint,
            "virtual joint",
        )?;
        out.write(cstk_virtual_joint {
            name: found.name.as_c_str().as_ptr(),
            parent_frame: found.parent_frame.as_c_str().as_ptr(),
            kind: match found.kind {
                VirtualJointKind::Fixed => cstk_joint_kind::CSTK_JOINT_FIXED,
                VirtualJointKind::Planar => cstk_joint_kind::CSTK_JOINT_PLANAR,
                VirtualJointKind::Floating => cstk_joint_kind::CSTK_JOINT_FREE,
            },
            child_link: found.child_link,
            reserved: [0; 4],
        });
        Ok(())
    })
}

fn at<'a, T>(items: &'a [T], index: u32, what: &str) -> Result<&'a T, Failure> {
    items.get(index as usize).ok_or_else(|| {
        let count = items.len();
        let message = format!("{what} {index} does not exist; the robot has {count}");
        Error::new(ErrorKind::NotFound, message).into()
    })
}
