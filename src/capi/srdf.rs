//! SRDF.
//!
//! What an SRDF file says of a robot: which pairs of links not to test, joint groups, named states, end effectors. It is read
//! into the builder that holds the robot's links, after its URDF file.
//!
//! ```c
//! uint32_t arm, home;
//! cstk_joint_group group;
//! cstk_robot *arm_alone = NULL;
//! check(cstk_robot_builder_load_urdf(robot_builder, "arm.urdf", NULL, NULL, NULL, NULL));
//! check(cstk_robot_builder_load_srdf(robot_builder, "arm.srdf", NULL));
//! check(cstk_robot_build(robot_builder, &robot));
//! check(cstk_robot_find_group(robot, "arm", &arm));
//! check(cstk_robot_find_state(robot, "arm", "home", &home));
//! check(cstk_robot_apply_state(robot, home, q, nq));
//! check(cstk_robot_get_group(robot, arm, &group));
//! check(cstk_robot_create_frozen(robot, group.joints, group.joint_count, q, nq, &arm_alone));
//! ```

use std::ffi::c_char;

use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::input::{
    OptionsStruct, Output, OutputSlice, options_or_default, path, slice, text, write_defaults,
};
use crate::capi::robot::builder::{cstk_robot_builder, with_builder};
use crate::capi::robot::joint::cstk_joint_kind;
use crate::capi::robot::robot::cstk_robot;
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
use crate::robot::{Robot, Semantics, VirtualJointKind, check_configuration};
use crate::srdf::{SrdfOptions, SrdfReport, add_srdf_file, add_srdf_text};

/// Options for reading an SRDF file. Write it with cstk_srdf_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_srdf_options {
    pub size: u32,
    pub cookie: u32,
    /// Prepended to all names of the file, also of groups, states and end effectors: the prefix that the URDF file was
    /// loaded with; may be NULL.
    pub prefix: *const c_char,
    /// Nonzero: elements that name a link, joint or group that is not there are skipped, and the report counts them (a file
    /// for a robot with a hand, read for the robot without); so are virtual joints to links that are no roots. 0, the
    /// default: they are refused.
    pub skip_unknown: u32,
    pub reserved: u32,
}

// SAFETY: repr(C), two u32, a pointer, two u32: no padding; the pointer is only read after checks.
unsafe impl OptionsStruct for cstk_srdf_options {
    const COOKIE: u32 = 0x4353_0205;
    const NAME: &'static str = "cstk_srdf_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            prefix: std::ptr::null(),
            skip_unknown: 0,
            reserved: 0,
        }
    }
}

/// What was read from an SRDF file, and what was skipped.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_srdf_report {
    /// The number of elements of each kind that were read; groups inside others are not counted.
    pub group_count: u32,
    pub state_count: u32,
    pub end_effector_count: u32,
    pub virtual_joint_count: u32,
    pub passive_joint_count: u32,
    /// The pairs that `disable_collisions` elements name, each counted once.
    pub disabled_pair_count: u32,
    /// Elements of other kinds, directly in the robot or in a group.
    pub skipped_elements: u32,
    /// Elements that were left out since they name what is not there; see skip_unknown.
    pub unknown_names: u32,
    /// Values in states that are not applied: for joints that are not in the state's group, as MoveIt has it, for joints without
    /// coordinates (a fixed one, or a base that was loaded with another joint), and for those whose coordinate another joint of
    /// the state sets.
    pub unused_values: u32,
    pub reserved_number: u32,
    pub reserved: [u64; 4],
}

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

impl From<&SrdfReport> for cstk_srdf_report {
    fn from(report: &SrdfReport) -> Self {
        Self {
            group_count: report.groups as u32,
            state_count: report.states as u32,
            end_effector_count: report.end_effectors as u32,
            virtual_joint_count: report.virtual_joints as u32,
            passive_joint_count: report.passive_joints as u32,
            disabled_pair_count: report.disabled_pairs as u32,
            skipped_elements: report.skipped_elements as u32,
            unknown_names: report.unknown_names as u32,
            unused_values: report.unused_values as u32,
            reserved_number: 0,
            reserved: [0; 4],
        }
    }
}

/// Writes the default options. `size` is sizeof(cstk_srdf_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_srdf_options_default(
    out: *mut cstk_srdf_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

unsafe fn decode(given: *const cstk_srdf_options) -> Result<SrdfOptions, Failure> {
    // SAFETY: checked for size and cookie; the caller states that the prefix is terminated.
    unsafe {
        let given = options_or_default(given, "srdf_options")?;
        let prefix = if given.prefix.is_null() {
            ""
        } else {
            text(given.prefix, "srdf_options->prefix")?
        };
        Ok(SrdfOptions {
            prefix: prefix.to_string(),
            skip_unknown: given.skip_unknown != 0,
        })
    }
}

/// Adds what an SRDF file says to a builder that holds the robot's links, which cstk_robot_builder_load_urdf added; what
/// cstk_robot_build makes then has it. `srdf_options` may be NULL for the defaults. Read are `disable_collisions`,
/// `disable_default_collisions` and `enable_collisions` (a pair named by the first is never tested; one that only a link's
/// default rules out is tested if it is enabled), `group` (joints, links, chains, groups), `group_state`, `end_effector`,
/// `virtual_joint` and `passive_joint`; everything else is skipped and counted. Several files may be added, under different
/// prefixes. The pairs go to cstk_space_get_enabled_pairs and cstk_find_link_pairs.
///
/// Error messages name the file, the line and the element; the builder is then unchanged. Refused are names that are not
/// there, URDF files, names with `${` (xacro that was not expanded), two groups, end effectors or states of a group with one name, groups that hold each other, a virtual joint to a link
/// that is no root, values of the wrong number. Limits, beyond which a file is CSTK_ERROR_UNSUPPORTED: 64 MiB; 2^12 groups and
/// 2^22 joints in all of them together; 2^12 states; 2^12 end effectors and 2^20 touch links in all of them; 2^8 virtual
/// joints; those of XML at cstk_robot_builder_load_urdf.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_load_srdf(
    builder: *mut cstk_robot_builder,
    file: *const c_char,
    srdf_options: *const cstk_srdf_options,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL, size and cookie; the caller states that names are terminated.
            let (file, options) = unsafe { (path(file, "file")?, decode(srdf_options)?) };
            builder.srdf = Some(add_srdf_file(&mut builder.robot, file, &options)?);
            Ok(())
        })
    })
}

/// As cstk_robot_builder_load_srdf, from a NUL-terminated text in memory, UTF-8: what the robot_description_semantic of ROS
/// holds. Error messages begin with "SRDF text".
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_load_srdf_text(
    builder: *mut cstk_robot_builder,
    srdf: *const c_char,
    srdf_options: *const cstk_srdf_options,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL, size and cookie; the caller states that texts are terminated.
            let (srdf, options) = unsafe { (text(srdf, "srdf")?, decode(srdf_options)?) };
            builder.srdf = Some(add_srdf_text(&mut builder.robot, srdf, &options)?);
            Ok(())
        })
    })
}

/// Writes the report on the SRDF file or text that was last added to the builder. CSTK_ERROR_EMPTY if there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_get_srdf_report(
    builder: *mut cstk_robot_builder,
    out: *mut cstk_srdf_report,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::checked(out, "out")?;
            let report = builder.srdf.as_ref().ok_or_else(|| {
                Error::new(ErrorKind::Empty, "no SRDF file was added to the builder")
            })?;
            out.write(report.into());
            Ok(())
        })
    })
}

/// Rules out a pair of links, by their names, for self-collision, as `disable_collisions` of an SRDF file does.
/// CSTK_ERROR_NOT_FOUND for a name that no link of the builder has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_disable_pair(
    builder: *mut cstk_robot_builder,
    r_link: *const c_char,
    s_link: *const c_char,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states that names are terminated.
            let names = unsafe { [text(r_link, "r_link")?, text(s_link, "s_link")?] };
            Ok(builder.robot.disable_pair(names)?)
        })
    })
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
            passive_joints: semantics.passive_joints.as_ptr(),
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
            joints: found.joints.as_ptr(),
            joint_count: found.joints.len(),
            coordinates: found.coordinates.as_ptr(),
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
            coordinates: found.coordinates.as_ptr(),
            values: found.values.as_ptr(),
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
            touch_links: found.touch_links.as_ptr(),
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
