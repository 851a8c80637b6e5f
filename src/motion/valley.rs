//! The lowest place of a function of time around a known one, by parabolas and golden sections.

/// An upper bound of a distance at a time.
#[derive(Clone, Copy)]
pub(super) struct Height {
    pub time: f64,
    pub upper: f64,
}

/// The lowest of the heights known around a place, from 0 to 1, between the two next to it.
pub(super) struct Valley {
    pub lowest: Height,
    /// Before and after the lowest; itself at an end of the time.
    sides: [Height; 2],
}

/// The part of an interval that a golden section takes off.
const GOLDEN: f64 = 0.381_966;

/// Where the first or the last time is the nearest, a time so near to it, as a part of the interval, shows whether the distance
/// rises at once.
const NEAR_END: f64 = 1.0 / 16.0;

/// Shorter valleys are points.
const SHORTEST: f64 = 1e-12;

impl Valley {
    pub fn new(lowest: Height, sides: [Height; 2]) -> Self {
        Self { lowest, sides }
    }

    /// The side that is lower than what was taken for the lowest, if any.
    pub fn lower_side(&self) -> Option<usize> {
        (0..2).find(|&side| self.sides[side].upper < self.lowest.upper)
    }

    /// Goes on to a lower side. Returns the time as far beyond it again, whose height is the side's.
    pub fn walk_to(&mut self, side: usize) -> f64 {
        let left = self.lowest;
        self.lowest = self.sides[side];
        self.sides[1 - side] = left;
        let further = self.lowest.time + (self.lowest.time - left.time);
        further.clamp(0.0, 1.0)
    }

    pub fn set_side(&mut self, side: usize, height: Height) {
        self.sides[side] = height;
    }

    /// By how much a convex function may fall below the lowest, which is lower than its sides.
    pub fn may_fall(&self) -> f64 {
        let spans = self.spans();
        let rises = self.sides.map(|side| side.upper - self.lowest.upper);
        let towards = |side: usize| match spans[1 - side] {
            0.0 => rises[side],
            other => rises[1 - side] / other * spans[side],
        };
        towards(0).max(towards(1))
    }

    pub fn is_point(&self) -> bool {
        let [before, after] = self.spans();
        before + after < SHORTEST
    }

    /// The time to look at next, the `count`th.
    pub fn time_between(&self, count: usize) -> f64 {
        let [before, after] = self.spans();
        let part_way = |side: usize, part: f64| {
            self.lowest.time + (self.sides[side].time - self.lowest.time) * part
        };
        match self.parabola_vertex() {
            _ if self.is_at_end() => part_way(usize::from(after > 0.0), NEAR_END),
            // Parabolas alone may come nearer from one side for ever.
            Some(vertex) if count % 3 != 2 => vertex,
            _ => part_way(usize::from(after > before), GOLDEN),
        }
    }

    /// Takes a height between the lowest and a side. Returns whether there may be a lower one.
    pub fn take(&mut self, found: Height) -> bool {
        let side = usize::from(found.time > self.lowest.time);
        if found.upper < self.lowest.upper {
            self.sides[1 - side] = self.lowest;
            self.lowest = found;
        } else if self.is_at_end() {
            return false;
        } else {
            self.sides[side] = found;
        }
        true
    }

    /// The times from the lowest to either side.
    fn spans(&self) -> [f64; 2] {
        self.sides.map(|side| (side.time - self.lowest.time).abs())
    }

    fn is_at_end(&self) -> bool {
        self.spans().contains(&0.0)
    }

    /// The time at which the parabola through the three is least, if it is between the two sides and not at one of the three.
    fn parabola_vertex(&self) -> Option<f64> {
        let Self { lowest, sides } = self;
        let [before, after] =
            sides.map(|side| (side.time - lowest.time, side.upper - lowest.upper));
        let denominator = before.1 * after.0 - after.1 * before.0;
        let numerator = before.1 * after.0 * after.0 - after.1 * before.0 * before.0;
        let step = 0.5 * numerator / denominator;
        let room = 0.02 * (after.0 - before.0);
        let is_inside = step > before.0 + room && step < after.0 - room;
        if !step.is_finite() || !is_inside {
            return None;
        }
        // A sample too near the lowest would tell nothing.
        let step = if step.abs() < room {
            room.copysign(step)
        } else {
            step
        };
        (step < after.0 && step > before.0).then_some(lowest.time + step)
    }
}
