//! Robot builders, which collect links and joints.

use std::ffi::c_char;
use std::sync::Arc;

use crate::body::Body;
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{OptionsStruct, Output, index_or_none, options, text, write_defaults};
use crate::capi::robot::custom_joint::{Functions, cstk_custom_joint};
use crate::capi::robot::joint::cstk_joint_kind;
use crate::capi::robot::robot::cstk_robot;
use crate::capi::status::status::cstk_status;
use crate::error::Error;
use crate::exclusive::Exclusive;
use crate::pose::{Pose, Vec3};
use crate::robot::{JointKind, LinkDefinition, RobotBuilder};
use crate::srdf::SrdfReport;
use crate::urdf::UrdfReport;

/// Collects the links of a robot. Serves one call at a time; another call meanwhile is CSTK_ERROR_BUSY.
pub struct cstk_robot_builder {
    _opaque: [u8; 0],
}

pub(crate) struct Builder(Exclusive<State>);

/// The links so far, and the report on the last URDF file.
pub(crate) struct State {
    pub robot: RobotBuilder,
    pub urdf: Option<UrdfReport>,
    /// The report on the last SRDF file.
    pub srdf: Option<SrdfReport>,
}

impl Noun for Builder {
    type Handle = cstk_robot_builder;
    const KIND: u32 = 3;
    const NAME: &'static str = "cstk_robot_builder";
}

/// The definition of a link and its joint. Write it with cstk_link_def_default first: a fixed link without name or body at
/// the world's origin.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_def {
    pub size: u32,
    pub cookie: u32,
    /// Unique within the robot, UTF-8; NULL for "link<number>". It is copied.
    pub name: *const c_char,
    /// The link's geometry, or NULL for a frame without any. The robot keeps a reference.
    pub body: *const cstk_body,
    /// The number of the parent link, or -1 for the world.
    pub parent: i32,
    /// A cstk_joint_kind.
    pub joint: i32,
    /// The joint's frame in the parent's frame: a pose of 12 doubles. The link's frame, in which its body is given, is
    /// pose(link) = pose(parent) at motion(coordinate), and coincides with the joint's frame at coordinate 0. For the
    /// report's (x, y, z, yaw, pitch, roll) see cstk_pose_from_euler.
    pub at: [f64; 12],
    /// The axis of a revolute or prismatic joint in the joint's frame, of any length; default z.
    pub axis: [f64; 3],
    /// The joint's first coordinate, or -1 for the next unused ones. A revolute or prismatic joint may use a single
    /// coordinate of an earlier joint, and so mimic it; other joints have their own coordinates.
    pub coordinate: i32,
    pub reserved: u32,
    /// The joint's name, unique within the robot, UTF-8; NULL for none. It is copied.
    pub joint_name: *const c_char,
    /// A revolute or prismatic joint moves by multiplier * coordinate + offset; default 1 and 0.
    pub multiplier: f64,
    pub offset: f64,
    /// The range of a revolute or prismatic joint's coordinate, which a space may override; radians or lengths. The default
    /// is infinite: a revolute joint then turns on a circle. Finite ones are at most 1e50 in size. Ignored where the joint shares an earlier joint's coordinate.
    pub lower: f64,
    pub upper: f64,
    /// For CSTK_JOINT_CUSTOM, else NULL. It is copied.
    pub custom: *const cstk_custom_joint,
}

// SAFETY: repr(C), no padding (8 + 16 + 8 + 96 + 24 + 8 + 8 + 32 + 8 bytes), pointers only read after checks.
unsafe impl OptionsStruct for cstk_link_def {
    const COOKIE: u32 = 0x4353_0201;
    const NAME: &'static str = "cstk_link_def";
    const EARLIER_SIZES: &'static [usize] = &[160];
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            name: std::ptr::null(),
            body: std::ptr::null(),
            parent: -1,
            joint: 0,
            at: Pose::identity().to_row_major(),
            axis: [0.0, 0.0, 1.0],
            coordinate: -1,
            reserved: 0,
            joint_name: std::ptr::null(),
            multiplier: 1.0,
            offset: 0.0,
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            custom: std::ptr::null(),
        }
    }
}

pub(crate) fn with_builder(
    builder: *mut cstk_robot_builder,
    action: impl FnOnce(&mut State) -> Result<(), Failure>,
) -> Result<(), Failure> {
    // Shared ownership: another thread may release the handle during the call.
    let builder = handle::share::<Builder>(builder, "builder")?;
    // Additions are made whole or not at all, so a panic leaves the builder sound.
    builder.0.with("the builder", |_| {}, action)
}

/// Creates an empty builder for robots of dimension 2 (planar: joints turn about z or shift along x and y) or 3. Release it
/// with cstk_robot_builder_release.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_create(
    dimension: u32,
    out: *mut *mut cstk_robot_builder,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        let state = State {
            robot: RobotBuilder::new(dimension)?,
            urdf: None,
            srdf: None,
        };
        out.write(handle::create(Arc::new(Builder(Exclusive::new(state)))));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_retain(
    builder: *mut cstk_robot_builder,
) -> cstk_status {
    guard(|| handle::retain::<Builder>(builder, "builder"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_release(
    builder: *mut cstk_robot_builder,
) -> cstk_status {
    guard(|| handle::release::<Builder>(builder, "builder"))
}

/// Writes the default link. `size` is sizeof(cstk_link_def).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_link_def_default(
    out: *mut cstk_link_def,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Adds a link; parents before children. Links are numbered from 0 in the order in which they are added; the number is
/// written to `out`, which may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_builder_add_link(
    builder: *mut cstk_robot_builder,
    def: *const cstk_link_def,
    out: *mut u32,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::optional(out, "out")?;
            // SAFETY: checked for size and cookie.
            let def = unsafe { options(def, "def")? };
            // SAFETY: the caller states that names are terminated, and the joint's structure is checked.
            let (name, joint_name, custom) = unsafe {
                (
                    text_or_empty(def.name, "def->name")?,
                    text_or_empty(def.joint_name, "def->joint_name")?,
                    custom_joint(&def)?,
                )
            };
            let kind = match &custom {
                Some(functions) => JointKind::Custom(functions.clone()),
                None => cstk_joint_kind::decode(def.joint).ok_or_else(|| {
                    Error::invalid(format!("def->joint {} is no cstk_joint_kind", def.joint))
                })?,
            };
            let body = if def.body.is_null() {
                None
            } else {
                Some(handle::share::<Body>(def.body, "def->body")?)
            };
            let link = builder.robot.add_link(LinkDefinition {
                name: name.to_string(),
                joint_name: joint_name.to_string(),
                body,
                parent: index_or_none(def.parent, "def->parent")?,
                at: Pose::from_row_major(&def.at).map_err(|e| e.within("def->at"))?,
                kind,
                axis: Vec3::from(def.axis),
                coordinate: index_or_none(def.coordinate, "def->coordinate")?,
                multiplier: def.multiplier,
                offset: def.offset,
                limits: [def.lower, def.upper],
            })?;
            if let Some(functions) = custom {
                functions.take_ownership();
            }
            out.write(link as u32);
            Ok(())
        })
    })
}

unsafe fn text_or_empty<'a>(string: *const c_char, argument: &str) -> Result<&'a str, Failure> {
    if string.is_null() {
        return Ok("");
    }
    // SAFETY: as the caller states.
    unsafe { text(string, argument) }
}

/// The caller's joint, if the definition is of that kind.
unsafe fn custom_joint(def: &cstk_link_def) -> Result<Option<Arc<Functions>>, Failure> {
    let is_custom = def.joint == cstk_joint_kind::CSTK_JOINT_CUSTOM as i32;
    if !is_custom && !def.custom.is_null() {
        return Err(
            Error::invalid("def->custom is set, but def->joint is not CSTK_JOINT_CUSTOM").into(),
        );
    }
    if !is_custom {
        return Ok(None);
    }
    // SAFETY: checked for NULL, size and cookie.
    let given = unsafe { options(def.custom, "def->custom")? };
    Ok(Some(Arc::new(Functions::new(&given)?)))
}

/// Builds a robot from the links added so far; the builder is unchanged. CSTK_ERROR_EMPTY if there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_robot_build(
    builder: *mut cstk_robot_builder,
    out: *mut *mut cstk_robot,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let out = Output::checked(out, "out")?;
            out.write(handle::create(Arc::new(builder.robot.build()?)));
            Ok(())
        })
    })
}
