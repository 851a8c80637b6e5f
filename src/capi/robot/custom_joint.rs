//! Joints defined by callbacks.

use std::ffi::c_void;
use std::sync::Arc;

use crate::capi::boundary::{Failure, guard};
use crate::capi::input::{OptionsStruct, write_defaults};
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::CallerData;
use crate::error::{Error, ErrorKind};
use crate::pose::{Pose, Vec3};
use crate::robot::{CustomJoint, Speeds, Twist};

type Result<T, E = Error> = std::result::Result<T, E>;

/// Writes the pose of the link in the joint's frame, 12 doubles, at the joint's `n` coordinates. Returns CSTK_OK, or
/// anything else to make the calling function fail with CSTK_ERROR_CALLBACK_FAILED.
pub type cstk_joint_pose_fn =
    Option<unsafe extern "C" fn(q: *const f64, n: usize, pose: *mut f64, user: *mut c_void) -> i32>;

/// Writes the derivative of that pose: 6 rows of `n` doubles, row-major, three of the velocity of the link's origin, then
/// three of the angular velocity of the link, both in the joint's frame.
pub type cstk_joint_jacobian_fn = Option<
    unsafe extern "C" fn(q: *const f64, n: usize, jacobian: *mut f64, user: *mut c_void) -> i32,
>;

/// A joint defined by callbacks: the report's arbitrary kinematics (§4). Write it with cstk_custom_joint_default first.
/// Both functions are called from any thread that uses the robot, concurrently, and from within queries; they must be pure,
/// must not throw, and must not call back into the running query. Numbers that are NaN or infinite (or left unwritten in a
/// Jacobian) are CSTK_ERROR_NOT_FINITE, a pose that is not rigid (or left unwritten) is CSTK_ERROR_NOT_A_ROTATION, and a
/// pose that leaves the plane of a planar robot or a number beyond 1e50 is CSTK_ERROR_INVALID_ARGUMENT.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_custom_joint {
    pub size: u32,
    pub cookie: u32,
    /// The number of coordinates, 1 to 64; as many velocities, their rates.
    pub coordinates: u32,
    pub reserved: u32,
    /// Both must be set.
    pub pose: cstk_joint_pose_fn,
    pub jacobian: cstk_joint_jacobian_fn,
    /// Passed to the functions.
    pub user: *mut c_void,
    /// May be NULL. Called once for each link added with it, by the thread that drops the last reference to whatever uses
    /// the link's joint; not called if adding the link fails.
    pub destroy: cstk_destroy_fn,
    /// Upper bounds of the speed of the link's origin and of its angular speed (radians), per unit rate of any one
    /// coordinate, at all coordinates. Negative, the default, means unknown: motions, regions and slides that move this joint
    /// are then refused, since nothing can be proved about them.
    pub linear_speed: f64,
    pub angular_speed: f64,
}

// SAFETY: repr(C), four u32, four pointers, two doubles: no padding; function pointers are read as options.
unsafe impl OptionsStruct for cstk_custom_joint {
    const COOKIE: u32 = 0x4353_0203;
    const NAME: &'static str = "cstk_custom_joint";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            coordinates: 1,
            reserved: 0,
            pose: None,
            jacobian: None,
            user: std::ptr::null_mut(),
            destroy: None,
            linear_speed: -1.0,
            angular_speed: -1.0,
        }
    }
}

/// Writes the defaults: one coordinate, and nothing else. `size` is sizeof(cstk_custom_joint).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_custom_joint_default(
    out: *mut cstk_custom_joint,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

type Map = unsafe extern "C" fn(*const f64, usize, *mut f64, *mut c_void) -> i32;

/// The caller's functions and their user data.
pub(crate) struct Functions {
    coordinates: usize,
    pose: Map,
    jacobian: Map,
    user: Arc<CallerData>,
    speeds: Option<Speeds>,
}

impl Functions {
    pub fn new(given: &cstk_custom_joint) -> Result<Self, Failure> {
        let missing = |name: &str| {
            Failure::new(
                cstk_status::CSTK_ERROR_NULL_ARGUMENT,
                format!("def->custom->{name} is NULL"),
            )
        };
        let speeds = [
            (given.linear_speed, "linear_speed"),
            (given.angular_speed, "angular_speed"),
        ];
        for (speed, name) in speeds {
            if !speed.is_finite() {
                return Err(Error::new(
                    ErrorKind::NotFinite,
                    format!("def->custom->{name} is {speed}"),
                )
                .into());
            }
        }
        let known = given.linear_speed >= 0.0 && given.angular_speed >= 0.0;
        Ok(Self {
            coordinates: given.coordinates as usize,
            pose: given.pose.ok_or_else(|| missing("pose"))?,
            jacobian: given.jacobian.ok_or_else(|| missing("jacobian"))?,
            user: CallerData::new(given.user, given.destroy),
            speeds: known.then_some(Speeds {
                linear: given.linear_speed,
                angular: given.angular_speed,
            }),
        })
    }

    /// From now on the data are released when nothing refers to them.
    pub fn take_ownership(&self) {
        self.user.take_ownership();
    }

    fn call(&self, function: Map, name: &str, q: &[f64], out: &mut [f64]) -> Result<()> {
        // SAFETY: the header states the lengths, and asks that any thread may call, several at once.
        let status =
            unsafe { function(q.as_ptr(), q.len(), out.as_mut_ptr(), self.user.address()) };
        if status != 0 {
            return Err(Error::new(
                ErrorKind::Callback,
                format!("the joint's {name} function returned {status}"),
            ));
        }
        Ok(())
    }
}

impl CustomJoint for Functions {
    fn coordinates(&self) -> usize {
        self.coordinates
    }

    fn pose(&self, q: &[f64]) -> Result<Pose> {
        // A pose that the function leaves unwritten is no rotation, and the robot refuses it, as all that are none.
        let mut values = [0.0; 12];
        self.call(self.pose, "pose", q, &mut values)?;
        Ok(Pose::as_given(&values))
    }

    fn jacobian(&self, q: &[f64], columns: &mut Vec<Twist>) -> Result<()> {
        let n = self.coordinates;
        let mut rows = vec![f64::NAN; 6 * n];
        self.call(self.jacobian, "jacobian", q, &mut rows)?;
        columns.extend((0..n).map(|i| Twist {
            linear: Vec3::new(rows[i], rows[n + i], rows[2 * n + i]),
            angular: Vec3::new(rows[3 * n + i], rows[4 * n + i], rows[5 * n + i]),
        }));
        Ok(())
    }

    fn speeds(&self) -> Option<Speeds> {
        self.speeds
    }
}
