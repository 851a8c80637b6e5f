//! The threads of a batch: each takes the next run of consecutive items until none is left.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::batch::Batch;
use super::job::{BatchJob, BatchSummary, ItemAnswer};
use super::options::BatchOptions;
use super::slots::Slots;
use super::worker::Worker;
use crate::contained::contained;
use crate::error::{Error, ErrorKind, Result};
use crate::query::QueryContext;

/// The most items of a run. Neighbouring items are asked by one thread, which remembers the pair that decided the last.
const MAX_RUN: usize = 64;
/// So many runs a thread, at least, where there are items enough: then none waits long for the last.
const RUNS_PER_THREAD: usize = 16;
/// The stack of a thread, in bytes: that of a program's main thread. C-objects may be nested deeply.
const STACK_SIZE: usize = 8 << 20;
/// Within a run, and while others work, progress is told no more often.
const REPORT_INTERVAL: Duration = Duration::from_millis(20);

/// An item, with its slot: `slots` are those of its run.
pub(super) struct Item<'s, S> {
    pub number: usize,
    pub slots: &'s mut S,
    pub place: usize,
    /// To be called within long items: tells progress where it is time, and fails where the item is to be left.
    pub pulse: &'s mut dyn FnMut() -> Result<()>,
}

/// The progress function, called on the caller's thread alone.
struct Reporter<'p> {
    progress: &'p mut dyn FnMut(f64) -> Result<()>,
    last: Instant,
    /// What ended the job.
    end: Option<Error>,
}

impl Reporter<'_> {
    /// Whether work goes on.
    fn report(&mut self, fraction: f64) -> bool {
        if self.end.is_none() {
            self.end = (self.progress)(fraction).err();
            self.last = Instant::now();
        }
        self.end.is_none()
    }

    fn is_due(&self) -> bool {
        self.last.elapsed() >= REPORT_INTERVAL
    }
}

/// Consecutive items and their slots.
struct Run<S> {
    first: usize,
    count: usize,
    slots: S,
}

/// The items that nobody has taken.
struct Queue<S> {
    next: usize,
    slots: Option<S>,
}

/// What the threads of a call share.
struct Shared<'a, S, Ask, Refuse> {
    count: usize,
    run_length: usize,
    options: &'a BatchOptions,
    /// A failure ends the job: what comes before it is still asked, so that the first is the same on any number of threads.
    stops_at_failure: bool,
    queue: Mutex<Queue<S>>,
    is_stopped: AtomicBool,
    /// How many items are done.
    done: AtomicUsize,
    /// Beyond this item nothing is asked any more.
    first_hit: AtomicUsize,
    /// The same, for a failure that ends the job.
    last: AtomicUsize,
    first_failure: Mutex<Option<(usize, Error)>>,
    /// How many threads work beside the caller's.
    helping: Mutex<usize>,
    helped: Condvar,
    ask: Ask,
    refuse: Refuse,
}

impl<S, Ask, Refuse> Shared<'_, S, Ask, Refuse>
where
    S: Slots,
    Ask: Fn(&mut Worker, &mut Item<S>) -> Result<bool> + Sync,
    Refuse: Fn(&mut S, usize, &Error) + Sync,
{
    /// The next run.
    fn take(&self) -> Option<Run<S>> {
        let mut queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
        let first = queue.next;
        if first >= self.count || self.is_over(first) {
            return None;
        }
        let count = self.run_length.min(self.count - first);
        let (slots, rest) = queue.slots.take()?.split(count);
        queue.next = first + count;
        queue.slots = Some(rest);
        Some(Run {
            first,
            count,
            slots,
        })
    }

    fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    fn is_ended(&self) -> bool {
        self.is_stopped() || self.last.load(Ordering::Relaxed) < self.count
    }

    fn is_over(&self, item: usize) -> bool {
        self.is_ended_before(item) || item > self.first_hit.load(Ordering::Relaxed)
    }

    fn is_ended_before(&self, item: usize) -> bool {
        self.is_stopped() || item > self.last.load(Ordering::Relaxed)
    }

    /// Tells progress on the caller's thread, if it is time; whether work goes on.
    fn pulse(&self, reporter: Option<&mut Reporter>) -> bool {
        if let Some(reporter) = reporter
            && reporter.is_due()
            && !reporter.report(self.fraction())
        {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
        !self.is_stopped()
    }

    /// Asks the items of a run; whether there was one. The caller's thread has the reporter.
    fn work(&self, worker: &mut Worker, mut reporter: Option<&mut Reporter>) -> bool {
        let Some(mut run) = self.take() else {
            return false;
        };
        for place in 0..run.count {
            let number = run.first + place;
            if self.is_over(number) {
                return false;
            }
            worker.context.start_item(self.options.limit);
            let pulse = &mut || {
                self.pulse(reporter.as_deref_mut());
                match self.is_ended_before(number) {
                    true => Err(Error::new(ErrorKind::Cancelled, "the work is ended")),
                    false => Ok(()),
                }
            };
            let item = &mut Item {
                number,
                slots: &mut run.slots,
                place,
                pulse,
            };
            let asked = contained(|| (self.ask)(worker, item)).unwrap_or_else(|panic| {
                // Caches and scratch memory may be inconsistent.
                *worker = Worker::default();
                Err(panic)
            });
            match asked {
                Ok(true) if self.options.stop_at_hit => {
                    self.first_hit.fetch_min(number, Ordering::Relaxed);
                }
                Ok(_) => {}
                Err(error) => {
                    (self.refuse)(&mut run.slots, place, &error);
                    self.keep_failure(number, error);
                }
            }
            self.done.fetch_add(1, Ordering::Relaxed);
            if place + 1 < run.count && !self.pulse(reporter.as_deref_mut()) {
                return false;
            }
        }
        true
    }

    fn keep_failure(&self, number: usize, error: Error) {
        if self.stops_at_failure {
            let last = self.last.fetch_min(number, Ordering::Relaxed);
            // Once the job is ended, items fail because it is.
            if self.is_stopped() || last < number {
                return;
            }
        }
        let first = self.first_failure.lock();
        let mut first = first.unwrap_or_else(PoisonError::into_inner);
        if first.as_ref().is_none_or(|(other, _)| number < *other) {
            *first = Some((number, error));
        }
    }

    /// The part of the items that is done.
    fn fraction(&self) -> f64 {
        self.done.load(Ordering::Relaxed) as f64 / self.count as f64
    }

    /// Works until no run is left, and tells progress after each.
    fn work_here(&self, worker: &mut Worker, reporter: &mut Reporter) {
        while self.work(worker, Some(reporter)) {
            if !reporter.report(self.fraction()) {
                self.is_stopped.store(true, Ordering::Relaxed);
            }
        }
    }

    fn change_helping(&self, change: impl FnOnce(&mut usize)) {
        let helping = self.helping.lock();
        change(&mut helping.unwrap_or_else(PoisonError::into_inner));
        self.helped.notify_all();
    }

    /// Tells progress until the other threads are done.
    fn await_helpers(&self, reporter: &mut Reporter) {
        let mut helping = self.helping.lock().unwrap_or_else(PoisonError::into_inner);
        while *helping > 0 {
            let waited = self.helped.wait_timeout(helping, REPORT_INTERVAL);
            drop(waited.unwrap_or_else(PoisonError::into_inner));
            self.pulse(Some(reporter));
            helping = self.helping.lock().unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Works until no run is left, this thread among others.
    fn work_off(&self, workers: &mut [Worker], reporter: &mut Reporter) -> Result<()> {
        let Some((own, others)) = workers.split_first_mut() else {
            return Ok(());
        };
        if others.is_empty() {
            self.work_here(own, reporter);
            return Ok(());
        }
        std::thread::scope(|scope| {
            let helpers = others.iter_mut().map_while(|worker| {
                let work = || {
                    let ended = contained(|| while self.work(worker, None) {});
                    self.change_helping(|helping| *helping -= 1);
                    ended
                };
                self.change_helping(|helping| *helping += 1);
                let thread = std::thread::Builder::new().stack_size(STACK_SIZE);
                // Where the system has no more threads, those that there are do the work.
                let begun = thread.spawn_scoped(scope, work).ok();
                if begun.is_none() {
                    self.change_helping(|helping| *helping -= 1);
                }
                begun
            });
            let helpers: Vec<_> = helpers.collect();
            self.work_here(own, reporter);
            self.await_helpers(reporter);
            let mut helped = Ok(());
            for helper in helpers {
                match helper.join() {
                    Ok(ended) => helped = helped.and(ended),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            helped
        })
    }

    fn summary(&self, end: Option<Error>) -> BatchSummary {
        let first_hit = self.first_hit.load(Ordering::Relaxed);
        let first_failure = self.first_failure.lock();
        let mut first_failure = first_failure.unwrap_or_else(PoisonError::into_inner);
        BatchSummary {
            // Where the batch was ended there may be hits before it.
            first_hit: (first_hit < self.count && end.is_none()).then_some(first_hit),
            first_failure: first_failure
                .take()
                .filter(|(number, _)| end.is_some() || *number < first_hit),
            version: 0,
            end,
        }
    }
}

impl Batch {
    /// Asks `count` items, each by `ask`, which fills its slot and tells whether it was a hit; what fails or panics is passed to
    /// `refuse`. A thread is worth its while with `items_per_thread`.
    pub(super) fn run<S: Slots>(
        &mut self,
        job: BatchJob<S>,
        count: usize,
        items_per_thread: usize,
        ask: impl Fn(&mut Worker, &mut Item<S>) -> Result<bool> + Sync,
        refuse: impl Fn(&mut S, usize, &Error) + Sync,
    ) -> Result<BatchSummary> {
        let threads = job.options.thread_count(count, items_per_thread)?;
        let mut done = self.run_on(threads, job, count, false, ask, refuse)?;
        done.first_failure = done
            .first_failure
            .map(|(item, error)| (item, error.within(format_args!("item {item}"))));
        Ok(done)
    }

    fn run_on<S: Slots>(
        &mut self,
        threads: usize,
        job: BatchJob<S>,
        count: usize,
        stops_at_failure: bool,
        ask: impl Fn(&mut Worker, &mut Item<S>) -> Result<bool> + Sync,
        refuse: impl Fn(&mut S, usize, &Error) + Sync,
    ) -> Result<BatchSummary> {
        let BatchJob {
            options,
            mut slots,
            progress,
        } = job;
        if self.workers.len() < threads {
            self.workers.resize_with(threads, Worker::default);
        }
        slots.begin();
        let shared = &Shared {
            count,
            run_length: (count / (RUNS_PER_THREAD * threads)).clamp(1, MAX_RUN),
            options,
            stops_at_failure,
            queue: Mutex::new(Queue {
                next: 0,
                slots: Some(slots),
            }),
            is_stopped: AtomicBool::new(false),
            done: AtomicUsize::new(0),
            first_hit: AtomicUsize::new(usize::MAX),
            last: AtomicUsize::new(usize::MAX),
            first_failure: Mutex::new(None),
            helping: Mutex::new(0),
            helped: Condvar::new(),
            ask,
            refuse,
        };
        let reporter = &mut Reporter {
            progress,
            last: Instant::now(),
            end: None,
        };
        if reporter.report(0.0) {
            shared.work_off(&mut self.workers[..threads], reporter)?;
            // After a failure that ended the job it is not done.
            if !shared.is_ended() {
                reporter.report(1.0);
            }
        }
        Ok(shared.summary(reporter.end.take()))
    }

    /// Runs a part of a longer job for each item, on any number of threads, until the first fails. `work` calls the function that it is
    /// given now and then, and fails where that does.
    pub(crate) fn work_off(
        &mut self,
        job: BatchJob<()>,
        count: usize,
        work: impl Fn(&mut QueryContext, usize, &mut dyn FnMut() -> Result<()>) -> Result<()> + Sync,
    ) -> Result<()> {
        let ask = |worker: &mut Worker, item: &mut Item<()>| {
            work(&mut worker.context, item.number, item.pulse)?;
            Ok(false)
        };
        let threads = job.options.thread_count(count, 1)?;
        let done = self.run_on(threads, job, count, true, ask, |(), _, _| ())?;
        match (done.end, done.first_failure) {
            (Some(error), _) | (None, Some((_, error))) => Err(error),
            (None, None) => Ok(()),
        }
    }

    /// Asks `count` items where the answer needs nothing of the thread's.
    pub(super) fn answer_each<S: Slots, T>(
        &mut self,
        job: BatchJob<S>,
        count: usize,
        items_per_thread: usize,
        ask: impl Fn(&mut QueryContext, usize) -> Result<(T, bool)> + Sync,
        put: impl Fn(&mut S, usize, ItemAnswer<T>) + Sync,
    ) -> Result<BatchSummary> {
        let put = &put;
        let answer = |worker: &mut Worker, item: &mut Item<S>| {
            let (answer, is_hit) = ask(&mut worker.context, item.number)?;
            put(item.slots, item.place, Ok(answer));
            Ok(is_hit)
        };
        self.run(
            job,
            count,
            items_per_thread,
            answer,
            |slots, place, error| put(slots, place, Err(error)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second of two failures comes first in time, and must not be told for that.
    #[test]
    fn the_first_failure_ends_the_work_whatever_the_threads_do() {
        for threads in [1, 2, 4] {
            let options = BatchOptions {
                threads,
                ..BatchOptions::default()
            };
            let job = BatchJob {
                options: &options,
                slots: (),
                progress: &mut |_| Ok(()),
            };
            let asked = AtomicUsize::new(0);
            let work =
                |_: &mut QueryContext, item: usize, pulse: &mut dyn FnMut() -> Result<()>| {
                    asked.fetch_add(1, Ordering::Relaxed);
                    match item {
                        3 => {
                            for _ in 0..20 {
                                std::thread::sleep(Duration::from_millis(1));
                                pulse()?;
                            }
                            Err(Error::invalid("item 3"))
                        }
                        4.. => Err(Error::invalid(format!("item {item}"))),
                        _ => Ok(()),
                    }
                };
            let ended = Batch::new().work_off(job, 10_000, work);
            assert_eq!(ended.unwrap_err().message, "item 3", "{threads} threads");
            assert!(asked.into_inner() <= 4 + threads as usize);
        }
    }
}
