//! Custom joints whose functions fail while a motion is looked at: their error ends it, whenever it comes.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use cstk::cobject::CObject;
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{ClearanceOptions, MotionOptions, RegionOptions, SlideOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{CustomJoint, JointKind, LinkDefinition, Speeds, Twist};

use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

/// A prismatic joint that can be asked for its pose so many times.
#[derive(Default)]
struct Tiring {
    left: AtomicUsize,
}

impl CustomJoint for Tiring {
    fn coordinates(&self) -> usize {
        1
    }

    fn pose(&self, q: &[f64]) -> Result<Pose> {
        let left = self.left.load(Ordering::Relaxed);
        if left == 0 {
            return Err(Error::new(ErrorKind::Callback, "it is tired"));
        }
        self.left.store(left - 1, Ordering::Relaxed);
        Ok(Pose::from_translation(Vec3::new(q[0], 0.0, 0.0)))
    }

    fn jacobian(&self, _: &[f64], columns: &mut Vec<Twist>) -> Result<()> {
        columns.push(Twist {
            linear: Vec3::x(),
            angular: Vec3::zeros(),
        });
        Ok(())
    }

    fn speeds(&self) -> Option<Speeds> {
        Some(Speeds {
            linear: 1.0,
            angular: 0.0,
        })
    }
}

fn arm_with(joint: &Arc<Tiring>) -> CObject {
    let cube = cuboid([1.0; 3]).body;
    let links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        LinkDefinition {
            body: Some(cube.clone()),
            ..link(Some(0), JointKind::Custom(joint.clone()), Vec3::z())
        },
    ];
    let far = Pose::from_translation(Vec3::new(5.0, 4.2, 0.0));
    let space = space(vec![robot(3, links)]);
    against(&space, &environment(&[(&cube, far)]).0)
}

#[test]
fn a_joint_that_fails_is_no_joint_without_speeds() {
    let joint = Arc::new(Tiring::default());
    let cobject = arm_with(&joint);
    let (q0, q1) = ([0.0, 0.0], [0.5, 10.0]);
    type Ask<'a> = &'a dyn Fn(&mut QueryContext) -> Result<()>;
    let clearance = ClearanceOptions::with_tolerance(1e-3);
    let asks: [Ask; 4] = [
        &|c| {
            c.motion(&cobject, &q0, &q1, &MotionOptions::default())
                .map(drop)
        },
        &|c| c.motion_clearance(&cobject, &q0, &q1, &clearance).map(drop),
        &|c| {
            let options = RegionOptions::default();
            c.classify_region(&cobject, &[-0.1, -1.0], &[0.1, 10.0], &options)
                .map(drop)
        },
        &|c| {
            c.slide(&cobject, &q0, &[0.3, 1.0], &SlideOptions::with_shell(10.0))
                .map(drop)
        },
    ];
    for (number, ask) in asks.iter().enumerate() {
        let mut failed = 0;
        for calls in 0..40 {
            joint.left.store(calls, Ordering::Relaxed);
            if let Err(error) = ask(&mut QueryContext::new()) {
                assert_eq!(
                    error.kind,
                    ErrorKind::Callback,
                    "{number} after {calls}: {error}"
                );
                failed += 1;
            }
        }
        assert!(failed > 2, "{number}: {failed}");
    }
}
