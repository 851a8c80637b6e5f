//! The depth of two bodies that meet: how far one must move, at least, until they are apart.

use super::context::{QueryContext, check_threshold};
use super::pairs::target;
use super::target::{Placement, Target};
use crate::body::Body;
use crate::depth::{DepthOptions, DepthSearch, require_exact, require_inside};
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
    pub fn pair_depth<'a>(
        &mut self,
        a: Placement<'a>,
        b: Placement<'a>,
        options: &DepthOptions,
    ) -> Result<PairDepth> {
        check_threshold(options.tolerance, "options->tolerance")?;
        self.scratch.meter_mut().start_call();
        if !self.any_within(&[target(a, b)?], |_| 0.0)? {
            return Ok(PairDepth {
                is_tight: true,
                ..Default::default()
            });
        }
        require_exact(a.0, b.0)?;
        // Solids that are convex have the depth of polyhedra, which is found at once and exact.
        let wholes = [a.0, b.0].map(Body::convex_whole);
        let hull = |(body, pose): Placement<'a>, whole: Option<(&'a Body, f64)>| {
            (whole.map_or(body, |(whole, _)| whole), pose)
        };
        let target = target(hull(a, wholes[0]), hull(b, wholes[1]))?;
        let excess = wholes.into_iter().flatten().map(|(_, excess)| excess);
        let found = self.searched_depth(&target, options, |search| search.bounds())?;
        let pairing = target.pairing();
        Ok(PairDepth {
            meet: true,
            lower: (found.lower - excess.sum::<f64>()).max(0.0),
            upper: found.upper,
            translation: pairing.frame.rotation * found.way,
            is_tight: found.is_tight,
            steps: found.steps,
        })
    }

    /// The depth of a target that meets, in the centred frame of its first body.
    pub(super) fn searched_depth<D>(
        &mut self,
        target: &Target,
        options: &DepthOptions,
        search: impl FnOnce(DepthSearch) -> D,
    ) -> Result<D> {
        let [(a, _), (b, _)] = target.sides;
        require_inside(a, b)?;
        let found = search(DepthSearch::new(
            &target.pairing(),
            options,
            &mut self.scratch,
        ));
        self.scratch.meter().check()?;
        Ok(found)
    }
}
