//! What an SRDF file says of a robot: which links may meet, joints by group, named states, end effectors.

use std::collections::HashSet;
use std::ffi::{CStr, CString};

use foldhash::fast::RandomState;

/// A name, terminated as C needs it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SemanticName(CString);

impl SemanticName {
    /// A name; text from a file never holds a NUL, and one that does ends there.
    pub fn new(name: &str) -> Self {
        let end = name.find('\0').unwrap_or(name.len());
        Self(CString::new(&name[..end]).unwrap_or_default())
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        self.0.to_str().unwrap_or_default()
    }

    /// The name as C reads it.
    pub fn as_c_str(&self) -> &CStr {
        &self.0
    }
}

/// Joints that are planned for together.
#[derive(Clone, Debug)]
pub struct JointGroup {
    /// Unique among the robot's groups.
    pub name: SemanticName,
    /// The joints, by the number of the link that each moves, ascending.
    pub joints: Vec<u32>,
    /// Their coordinates in the robot, ascending; none twice.
    pub coordinates: Vec<u32>,
}

/// Values for some coordinates, by name: `home`, say.
#[derive(Clone, Debug)]
pub struct NamedState {
    /// Unique among the states of its group.
    pub name: SemanticName,
    /// The group it belongs to; `None` for the robot as a whole.
    pub group: Option<usize>,
    /// The coordinates, ascending.
    pub coordinates: Vec<u32>,
    /// One for each of the coordinates.
    pub values: Vec<f64>,
}

/// A group of links that takes hold of things.
#[derive(Clone, Debug)]
pub struct EndEffector {
    /// Unique among the robot's end effectors.
    pub name: SemanticName,
    /// The group of its joints.
    pub group: usize,
    /// The link that carries it.
    pub parent_link: u32,
    /// The group of the arm, where it is named.
    pub parent_group: Option<usize>,
    /// The links with bodies that a held object may touch: those its joints move, and the one that carries it; ascending.
    pub touch_links: Vec<u32>,
}

/// How the file means the root link to be carried; the robot's own joint there is the one of the URDF options.
#[derive(Clone, Debug)]
pub struct VirtualJoint {
    /// The name, which is also that of the root link's joint.
    pub name: SemanticName,
    /// `fixed`, `planar` or `floating`.
    pub kind: VirtualJointKind,
    /// What carries the robot; no link of it.
    pub parent_frame: SemanticName,
    /// The root link.
    pub child_link: u32,
}

/// The kind of a virtual joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VirtualJointKind {
    /// The root stands still.
    Fixed,
    /// The root moves on a plane.
    Planar,
    /// The root moves freely.
    Floating,
}

/// Which pairs of links are not tested for self-collision.
#[derive(Clone, Debug, Default)]
pub struct PairRules {
    /// Lower number first.
    disabled: HashSet<[u32; 2], RandomState>,
    enabled: HashSet<[u32; 2], RandomState>,
    /// Links whose pairs are disabled unless one is enabled.
    silent: HashSet<u32, RandomState>,
}

impl PairRules {
    /// Rules a pair out; returns whether it was not before.
    pub fn disable(&mut self, pair: [u32; 2]) -> bool {
        self.disabled.insert(ordered(pair))
    }

    /// Rules out all pairs of a link that are not enabled.
    pub fn disable_all_of(&mut self, link: u32) {
        self.silent.insert(link);
    }

    /// Lets a pair count that [`Self::disable_all_of`] rules out; [`Self::disable`] is stronger.
    pub fn enable(&mut self, pair: [u32; 2]) {
        self.enabled.insert(ordered(pair));
    }

    /// Whether a pair is ruled out.
    pub fn is_disabled(&self, pair: [u32; 2]) -> bool {
        let pair = ordered(pair);
        let by_default = || pair.iter().any(|link| self.silent.contains(link));
        self.disabled.contains(&pair) || (by_default() && !self.enabled.contains(&pair))
    }
}

fn ordered([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// All that SRDF files said of a robot.
#[derive(Clone, Debug, Default)]
pub struct Semantics {
    /// In the order of the files.
    pub groups: Vec<JointGroup>,
    /// In the order of the files.
    pub states: Vec<NamedState>,
    /// In the order of the files.
    pub end_effectors: Vec<EndEffector>,
    /// At most one for each root link.
    pub virtual_joints: Vec<VirtualJoint>,
    /// Joints without a motor, by the number of the link that each moves, ascending.
    pub passive_joints: Vec<u32>,
    /// Which pairs of links are tested.
    pub pairs: PairRules,
}

impl Semantics {
    /// The index of the group with this name.
    pub fn find_group(&self, name: &str) -> Option<usize> {
        self.groups.iter().position(|g| g.name.as_str() == name)
    }

    /// The index of the state with this name, in this group or, without one, among those of no group.
    pub fn find_state(&self, group: Option<usize>, name: &str) -> Option<usize> {
        let is_it = |s: &NamedState| s.group == group && s.name.as_str() == name;
        self.states.iter().position(is_it)
    }

    /// The index of the end effector with this name.
    pub fn find_end_effector(&self, name: &str) -> Option<usize> {
        let mut all = self.end_effectors.iter();
        all.position(|e| e.name.as_str() == name)
    }

    /// The same where only some coordinates are left: `places` holds the new place of each old one.
    pub(super) fn with_coordinates(&self, places: &[Option<usize>]) -> Self {
        let place = |old: u32| places[old as usize].map(|new| new as u32);
        let mut changed = self.clone();
        for group in &mut changed.groups {
            group.coordinates = group.coordinates.iter().filter_map(|&c| place(c)).collect();
        }
        for state in &mut changed.states {
            let pairs = state.coordinates.iter().zip(&state.values);
            let left = pairs.filter_map(|(&c, &value)| Some((place(c)?, value)));
            (state.coordinates, state.values) = left.unzip();
        }
        changed
    }
}
