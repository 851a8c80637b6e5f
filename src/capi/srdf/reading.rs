//! Files read into a builder.

use std::ffi::c_char;

use crate::capi::boundary::{Failure, guard};
use crate::capi::input::{OptionsStruct, Output, options_or_default, path, text, write_defaults};
use crate::capi::robot::builder::{cstk_robot_builder, with_builder};
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind};
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
