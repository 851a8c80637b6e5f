//! How much work one piece does on a body pair that goes on in its halves.

/// A body pair that is looked at. Once a pair of its nodes is left to the halves, the whole body pair is looked at again there; so the work
/// on the rest of it is limited here.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairLook {
    number: u32,
    /// Something is left.
    is_left: bool,
    /// The work done on it, and the most that is done on the rest.
    work: u32,
    max_work: u32,
    /// The hulls of its bodies have been tried.
    are_hulls_tried: bool,
}

impl PairLook {
    pub fn new(max_work: u32) -> Self {
        Self {
            number: u32::MAX,
            is_left: false,
            work: 0,
            max_work,
            are_hulls_tried: false,
        }
    }

    fn start(&mut self, number: u32) {
        if number != self.number {
            *self = Self {
                number,
                ..Self::new(self.max_work)
            };
        }
    }

    pub fn count(&mut self, number: u32, work: u32) {
        self.start(number);
        self.work = self.work.saturating_add(work);
    }

    /// Whether the hulls of a pair are tried for the first time.
    pub fn tries_hulls(&mut self, number: u32) -> bool {
        self.start(number);
        !std::mem::replace(&mut self.are_hulls_tried, true)
    }

    /// Notes that something of a pair is left.
    pub fn leave(&mut self, number: u32) {
        self.start(number);
        self.is_left = true;
    }

    pub fn is_left_to_halves(&self, number: u32) -> bool {
        self.is_left && self.work > self.max_work && number == self.number
    }
}
