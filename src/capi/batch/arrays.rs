//! The arrays of a caller that a batch reads and fills.

use std::mem::MaybeUninit;
use std::ops::Range;

use smallvec::SmallVec;

use crate::batch::{BatchSummary, Slots};
use crate::capi::batch::batch::cstk_batch_result;
use crate::capi::boundary::{Failure, keep_message};
use crate::capi::input::{Output, numbers, product, too_many};
use crate::capi::status::status::cstk_status;
use crate::error::Error;

/// An array with `width` entries for each item. An array that the caller left out is empty.
pub struct Entries<'a, T> {
    items: &'a mut [MaybeUninit<T>],
    width: usize,
    argument: &'static str,
}

impl<'a, T: Copy> Entries<'a, T> {
    /// Of `count` items.
    pub unsafe fn checked(
        items: *mut T,
        count: usize,
        width: usize,
        argument: &'static str,
    ) -> Result<Self, Failure> {
        let entries = product(count, width, argument)?;
        if entries == 0 {
            return Ok(Self::absent(argument));
        }
        Output::checked(items, argument)?;
        if entries > isize::MAX as usize / size_of::<T>() {
            return Err(too_many(count, width, argument));
        }
        // SAFETY: not null, aligned, and the caller states that so many items are writable and that nobody else uses them.
        let items = unsafe { std::slice::from_raw_parts_mut(items.cast(), entries) };
        Ok(Self {
            items,
            width,
            argument,
        })
    }

    /// NULL is allowed: then nothing is written.
    pub unsafe fn optional(
        items: *mut T,
        count: usize,
        width: usize,
        argument: &'static str,
    ) -> Result<Self, Failure> {
        if items.is_null() {
            return Ok(Self::absent(argument));
        }
        // SAFETY: as the caller states.
        unsafe { Self::checked(items, count, width, argument) }
    }

    fn absent(argument: &'static str) -> Self {
        Self {
            items: &mut [],
            width: 0,
            argument,
        }
    }

    pub fn is_absent(&self) -> bool {
        self.items.is_empty()
    }

    /// Writes the entries of an item.
    pub fn write(&mut self, item: usize, values: impl IntoIterator<Item = T>) {
        let places = self.items.iter_mut().skip(item * self.width);
        for (place, value) in places.take(self.width).zip(values) {
            place.write(value);
        }
    }
}

impl<T: Copy + Send> Slots for Entries<'_, T> {
    fn split(self, count: usize) -> (Self, Self) {
        let (first, rest) = self.items.split_at_mut(self.width * count);
        let part = |items| Self { items, ..self };
        (part(first), part(rest))
    }
}

/// The arrays that a batch writes, beside the statuses.
pub trait Outputs: Slots {
    /// Adds where each of them lies.
    fn add_places(&self, places: &mut Places);
}

impl<T: Copy + Send> Outputs for Entries<'_, T> {
    fn add_places(&self, places: &mut Places) {
        places.push(Place::of(self.items, self.argument));
    }
}

impl<A: Outputs, B: Outputs> Outputs for (A, B) {
    fn add_places(&self, places: &mut Places) {
        self.0.add_places(places);
        self.1.add_places(places);
    }
}

/// The statuses of the items. All are CSTK_ERROR_CANCELLED, not reached, when a batch begins.
pub struct Statuses<'a>(Entries<'a, cstk_status>);

impl Statuses<'_> {
    pub fn write(&mut self, item: usize, status: cstk_status) {
        self.0.write(item, [status]);
    }

    /// The status of an item that failed.
    pub fn refuse(&mut self, item: usize, error: &Error) {
        self.write(item, error.kind.into());
    }
}

impl Slots for Statuses<'_> {
    fn begin(&mut self) {
        for place in self.0.items.iter_mut() {
            place.write(cstk_status::CSTK_ERROR_CANCELLED);
        }
    }

    fn split(self, count: usize) -> (Self, Self) {
        let (first, rest) = self.0.split(count);
        (Self(first), Self(rest))
    }
}

/// The outputs that all batches share, checked.
pub struct Outcome {
    statuses: *mut cstk_status,
    count: usize,
    out: Output<cstk_batch_result>,
}

impl Outcome {
    /// The checked outputs, and the statuses as slots of a batch.
    pub unsafe fn checked<'a>(
        statuses: *mut cstk_status,
        count: usize,
        out: *mut cstk_batch_result,
    ) -> Result<(Self, Statuses<'a>), Failure> {
        let out = Output::checked(out, "out")?;
        // SAFETY: as the caller states.
        let entries = unsafe { Entries::checked(statuses, count, 1, "statuses")? };
        let outcome = Self {
            statuses,
            count,
            out,
        };
        Ok((outcome, Statuses(entries)))
    }

    /// Refuses outputs that overlap inputs, or each other: threads write some while others read.
    pub fn require_apart(&self, inputs: &[Place], outputs: &impl Outputs) -> Result<(), Failure> {
        let array = |start: usize, size: usize, name| Place {
            name,
            bytes: start..start.saturating_add(size),
        };
        let statuses = self.count.saturating_mul(size_of::<cstk_status>());
        let mut places = Places::new();
        outputs.add_places(&mut places);
        places.push(array(self.statuses.addr(), statuses, "statuses"));
        places.push(array(
            self.out.address(),
            size_of::<cstk_batch_result>(),
            "out",
        ));
        for (i, output) in places.iter().enumerate() {
            let mut others = inputs.iter().chain(&places[..i]);
            if let Some(other) = others.find(|other| output.meets(other)) {
                let message = format!("{} overlaps {}", output.name, other.name);
                return Err(Error::invalid(message).into());
            }
        }
        Ok(())
    }

    /// Counts, and writes the result of a batch that was worked off, or cancelled: that is then the call's failure. What was answered
    /// beyond the first hit does not count.
    pub fn write(self, summary: BatchSummary) -> Result<(), Failure> {
        let statuses: &mut [cstk_status] = if self.count == 0 {
            &mut []
        } else {
            // SAFETY: checked; written throughout when the batch began, and its borrow has ended.
            unsafe { std::slice::from_raw_parts_mut(self.statuses, self.count) }
        };
        if let Some(hit) = summary.first_hit {
            statuses[hit + 1..].fill(cstk_status::CSTK_ERROR_CANCELLED);
        }
        let count = |wanted: fn(cstk_status) -> bool| {
            statuses.iter().filter(|&&status| wanted(status)).count()
        };
        let answered = count(|status| status == cstk_status::CSTK_OK);
        let unreached = count(|status| status == cstk_status::CSTK_ERROR_CANCELLED);
        let first_failed = summary.first_failure.map_or(0, |(item, error)| {
            keep_message(error.message);
            item
        });
        self.out.write(cstk_batch_result {
            answered,
            failed: statuses.len() - answered - unreached,
            first_failed,
            first_hit: summary.first_hit.unwrap_or(0),
            has_hit: summary.first_hit.is_some(),
            reserved_bytes: [0; 7],
            environment_version: summary.version,
            reserved: [0; 4],
        });
        match summary.end {
            Some(end) => Err(end.into()),
            None => Ok(()),
        }
    }
}

/// Where the arrays of a call lie.
pub type Places = SmallVec<[Place; 8]>;

/// Where an array of the caller's lies; one that was left out is empty.
pub struct Place {
    name: &'static str,
    bytes: Range<usize>,
}

impl Place {
    pub fn of<T>(items: &[T], name: &'static str) -> Self {
        let ends = items.as_ptr_range();
        Self {
            name,
            bytes: ends.start.addr()..ends.end.addr(),
        }
    }

    fn meets(&self, other: &Self) -> bool {
        let (a, b) = (&self.bytes, &other.bytes);
        !a.is_empty() && !b.is_empty() && a.start < b.end && b.start < a.end
    }
}

/// `count` poses of 12 numbers each.
pub unsafe fn poses<'a>(
    values: *const f64,
    count: usize,
    argument: &str,
) -> Result<&'a [[f64; 12]], Failure> {
    // SAFETY: as the caller states.
    let numbers = unsafe { numbers(values, count, 12, argument)? };
    Ok(numbers.as_chunks().0)
}
