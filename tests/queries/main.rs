//! C-objects among environments: classes, distances, witnesses, gradients.

mod boolean_sets;
mod candidates;
mod contact_gradients;
mod environment_moves;
mod environment_threads;
mod environment_tree;
mod environment_updates;
mod explained_doubt;
mod floors;
mod gradient_cases;
mod gradients;
mod grasping;
mod held_objects;
mod link_pairs;
mod link_pairs_far;
mod object_pairs;
mod octomap_files;
mod octrees;
mod pure_sets;
mod pure_sets_among_others;
mod refusals;
mod set_cases;
mod signed_distances;
mod stress;
mod unions;
mod work_limits;
