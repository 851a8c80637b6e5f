//! Queries at a configuration.
//!
//! Operations 4 to 8 of §2.2.4 for a C-object: is q free, how far is it from contact, between what, which way is out, and
//! why. Callers with their own kinematics pass link poses instead of q.
//!
//! ```c
//! cstk_class place;
//! cstk_distance_result nearest;
//! check(cstk_classify(query, cobject, q, nq, &place));
//! check(cstk_distance(query, cobject, q, nq, INFINITY, &nearest));
//! ```

pub mod answers;

pub mod questions;

pub mod explain;

pub mod find_link_pairs;

pub mod prove_clear_pairs;
