//! The pairs of links that SRDF files leave to be tested.

use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice};
use crate::capi::space::space::cstk_space;
use crate::capi::status::status::cstk_status;
use crate::space::Space;

/// Writes all pairs of links with bodies but those that SRDF files (or cstk_robot_builder_disable_pair) rule out, as
/// cstk_cobject_induced_links takes them: at most `max_count` pairs of two link numbers each to `pairs` (NULL if `max_count`
/// is 0), and their full number to `count`. Links of different robots are all paired. Nothing is sampled: where no SRDF file
/// was read joined links are among the pairs; cstk_find_link_pairs finds those.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_space_get_enabled_pairs(
    space: *const cstk_space,
    max_count: usize,
    pairs: *mut u32,
    count: *mut usize,
) -> cstk_status {
    guard(|| {
        let space = &*handle::share::<Space>(space, "space")?;
        let room = OutputSlice::checked(pairs, max_count.saturating_mul(2), "pairs")?;
        let count = Output::checked(count, "count")?;
        let mut found = 0;
        let mut written: Vec<u32> = Vec::new();
        for pair in space.enabled_pairs() {
            if found < max_count {
                written.extend(pair.map(|link| link as u32));
            }
            found += 1;
        }
        room.write(&written);
        count.write(found);
        Ok(())
    })
}
