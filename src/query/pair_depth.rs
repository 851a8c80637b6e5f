//! The depth of two bodies that meet: how far one must move, at least, until they are apart.

use super::context::{QueryContext, check_threshold};
use super::pairs::target;
use super::target::{Placement, Target};
use crate::depth::{Depth, DepthOptions, DepthSearch, require_exact, require_inside};
use crate::error::Result;
use crate::pose::Vec3;

/// The depth of two bodies, with a translation that parts them. Everything 0 for bodies that are apart.
#[derive(Clone, Debug, Default)]
pub struct PairDepth {
    /// Whether the bodies meet.
    pub meet: bool,
    /// No shorter translation parts the bodies.
    pub lower: f64,
    /// The length of `translation`.
    pub upper: f64,
    /// After this translation of body a, in the world, the bodies are proved apart.
    pub translation: Vec3,
    /// The bounds are within the tolerance.
    pub is_tight: bool,
    /// The nodes that the search took.
    pub steps: u64,
}

impl QueryContext {
    /// The depth of two bodies: bounds of the least length of a translation after which they do not meet, and a translation that
    /// parts them. Fails for two bodies that both have primitives without an inside, and for those that state a deviation.
    pub fn pair_depth(
        &mut self,
        a: Placement,
        b: Placement,
        options: &DepthOptions,
    ) -> Result<PairDepth> {
        check_threshold(options.tolerance, "options->tolerance")?;
        let target = target(a, b)?;
        self.scratch.meter_mut().start_call();
        if !self.any_within(std::slice::from_ref(&target), |_| 0.0)? {
            return Ok(PairDepth {
                is_tight: true,
                ..Default::default()
            });
        }
        require_exact(a.0, b.0)?;
        let found = self.depth_of(&target, options)?;
        let pairing = target.pairing();
        Ok(PairDepth {
            meet: true,
            lower: found.lower,
            upper: found.upper,
            translation: pairing.frame.rotation * found.way,
            is_tight: found.is_tight,
            steps: found.steps,
        })
    }

    /// The depth of a target that meets, in the centred frame of its first body.
    pub(super) fn depth_of(&mut self, target: &Target, options: &DepthOptions) -> Result<Depth> {
        let [(a, _), (b, _)] = target.sides;
        require_inside(a, b)?;
        let pairing = target.pairing();
        let found = DepthSearch::new(&pairing, options, &mut self.scratch).run();
        self.scratch.meter().check()?;
        Ok(found)
    }
}
