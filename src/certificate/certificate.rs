//! What a certificate holds.

/// A proof that a motion keeps clear of a C-object.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    pub(super) ends: [Vec<f64>; 2],
    pub(super) threshold: f64,
    /// Of the robots, bodies, poses and sets that it is about.
    pub(super) fingerprint: [u8; 32],
    /// For each of the different bodies an order of its primitives. Groups of primitives are ranges in it.
    pub(super) orders: Vec<Vec<u32>>,
    /// The proof, parted: see [`Step`].
    pub(super) steps: Vec<Step>,
    /// One for each [`Step::PROVED`], in order.
    pub(super) entries: Vec<Entry>,
}

/// A step of a proof, as a number: the proof is a tree, and its steps stand before the parts that they make.
///
/// An item that the C-object asks about is to be shown for two groups of primitives, at first all of both bodies, over an interval, at
/// first the whole time. Either an entry shows it, or one of the groups or the interval is halved, and it is shown for both halves,
/// one after the other. Where a set is an intersection, the part is chosen that the motion keeps out of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step(pub u32);

impl Step {
    /// The next entry shows it.
    pub const PROVED: Self = Self(0);
    /// Halves the interval.
    pub const HALVE_TIME: Self = Self(1);
    /// Halves the first group; of an odd number of primitives the first half has one fewer.
    pub const HALVE_FIRST: Self = Self(2);
    /// Halves the second group.
    pub const HALVE_SECOND: Self = Self(3);
    /// What chooses the first part of an intersection; the numbers that follow choose the others.
    pub const CHOOSE_FIRST: u32 = 4;
}

/// What one part of a proof claims: over an interval of time two groups of primitives, one of each body of an item, stay farther
/// apart than the threshold. Along a unit direction their gap is at least `gap` at both ends of the interval, and between these no
/// point moves off the line between its places by more than `displacement`. Of sets given in C-space, whose items have no bodies, gap
/// and displacement are of their distances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The number of the item among all that the C-object asks about: body pairs, links over floors or in the world box, sets given
    /// in C-space.
    pub item: u32,
    /// The links that carry the two bodies; [`Entry::NONE`] for what rests in the world.
    pub links: [u32; 2],
    /// The bodies' numbers among the different ones of the certificate; [`Entry::NONE`] for a plane or the origin of a link.
    pub bodies: [u32; 2],
    /// The first primitive of each group and their number, in the certificate's order of the body's primitives.
    pub groups: [[u32; 2]; 2],
    /// The interval.
    pub times: [f64; 2],
    /// The body in whose frame the direction rests, as the caller gave it: 0 or 1.
    pub carrier: u32,
    /// From the second body to the first.
    pub direction: [f64; 3],
    /// A lower bound, with rounding counted.
    pub gap: f64,
    /// An upper bound.
    pub displacement: f64,
}

impl Entry {
    /// In the place of a link or a body: there is none.
    pub const NONE: u32 = u32::MAX;
}

impl Certificate {
    /// The first and last configuration.
    pub fn ends(&self) -> &[Vec<f64>; 2] {
        &self.ends
    }

    /// Everything stays farther away than this.
    pub fn threshold(&self) -> f64 {
        self.threshold
    }

    /// A digest of all that the certificate is about.
    pub fn fingerprint(&self) -> &[u8; 32] {
        &self.fingerprint
    }

    /// All that it claims.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The primitives of one of an entry's groups, 0 or 1: none for a plane or the origin of a link, or if the entry is none of
    /// this certificate's.
    pub fn primitives(&self, entry: &Entry, side: usize) -> &[u32] {
        let [first, count] = entry.groups[side].map(|number| number as usize);
        let order = self.orders.get(entry.bodies[side] as usize);
        let group = order.and_then(|order| order.get(first..)?.get(..count));
        group.unwrap_or_default()
    }
}
