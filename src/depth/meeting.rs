//! Whether and where two bodies meet after a translation.

use std::ops::ControlFlow;

use crate::pair::{Pairing, PrimitivePair, Scratch, Visitor, Wanted, meets, traverse};
use crate::pose::Vec3;
use crate::work_meter::WorkMeter;

/// How two bodies meet.
#[derive(Clone, Debug, Default)]
pub struct Meeting {
    /// They meet; false is proved.
    pub meets: bool,
    /// Places of primitive pairs that meet, of which not both are flat: some, if there are many.
    pub places: Vec<[u32; 2]>,
    /// A place of each of some primitive pairs that meet, flat ones too.
    pub flat: Vec<[u32; 2]>,
}

/// Pairs of which not both are flat, at most. Any one of them covers translations around; of more, the best is a little better.
const MAX_PAIRS: usize = 16;

/// Pairs looked at, at most.
const MAX_SEEN: usize = 128;

struct MeetingPairs<'a> {
    pairing: &'a Pairing<'a>,
    found: Meeting,
    seen: usize,
}

impl Visitor for MeetingPairs<'_> {
    fn wanted(&self) -> Wanted {
        Wanted::MEETING
    }

    fn visit(&mut self, pair: &PrimitivePair, _: &mut WorkMeter) -> ControlFlow<()> {
        if !meets(pair) {
            return ControlFlow::Continue(());
        }
        self.found.meets = true;
        self.seen += 1;
        let [a, b] = pair.primitives.map(|primitive| primitive as usize);
        let (a, b) = (
            self.pairing.a.primitives().get(a),
            self.pairing.b.primitives().get(b),
        );
        let are_flat = !self.pairing.precision.planar && a.shape.is_flat() && b.shape.is_flat();
        if are_flat {
            self.found.flat.push(pair.places);
        } else {
            self.found.places.push(pair.places);
        }
        match self.found.places.len() >= MAX_PAIRS || self.seen >= MAX_SEEN {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

/// How the bodies meet after A has moved by `way`. "Not" is wrong if the meter's limit is exceeded.
pub fn meeting_at(pairing: &Pairing, way: &Vec3, scratch: &mut Scratch) -> Meeting {
    let shifted = pairing.shifted(way);
    scratch.meter_mut().count_nodes(1);
    let mut visitor = MeetingPairs {
        pairing: &shifted,
        found: Meeting::default(),
        seen: 0,
    };
    if shifted.sphere_bound() <= 0.0 {
        let _ = traverse(&shifted, None, scratch, &mut visitor);
        if !visitor.found.meets && shifted.has_solid() {
            visitor.found.meets = shifted.is_one_inside(scratch);
        }
    }
    visitor.found
}

/// Whether the bodies are proved not to meet after A has moved by `way`.
pub fn is_parted(pairing: &Pairing, way: &Vec3, scratch: &mut Scratch) -> bool {
    !meeting_at(pairing, way, scratch).meets && !scratch.meter().is_exceeded()
}
