//! Where an interval lies, seen from the time at which bodies are compared.

/// Where an interval lies, seen from the time at which bodies are compared.
#[derive(Clone, Copy, Debug)]
pub(super) enum Span {
    /// It goes as far to either side.
    Around(f64),
    /// It ends there, and has this length. What approaches all the while is nearest there, however it bends before.
    Before(f64),
}

impl Span {
    /// The longest time from there.
    pub fn reach(self) -> f64 {
        let (Self::Around(reach) | Self::Before(reach)) = self;
        reach
    }
}

/// Whether a proof follows a pair or a set through a piece. What touches at the start of a slide is followed from a later time on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Followed {
    /// What comes before the time at which it is followed is known to be free.
    No,
    /// Through the later part, which the halves of the piece tell apart.
    InPart,
    Yes,
}

impl Followed {
    /// What is followed from a time on, over an interval in which it is compared at another time.
    #[inline(always)]
    pub fn over_interval(from: f64, compared_at: f64, span: Span) -> Self {
        let end = match span {
            Span::Around(half) => compared_at + half,
            Span::Before(_) => compared_at,
        };
        if from <= compared_at {
            Self::Yes
        } else if end <= from {
            Self::No
        } else {
            Self::InPart
        }
    }
}
