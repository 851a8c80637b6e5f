//! A parallel map over threads that reports progress on the calling thread.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::contained::contained;
use crate::error::Result;

/// Reports the progress of one part of a longer job to the caller's function. An error from that function cancels the job.
pub struct Progress<'a> {
    report: &'a mut dyn FnMut(f64) -> Result<()>,
    from: f64,
    to: f64,
}

impl<'a> Progress<'a> {
    /// The progress of a whole job, from 0 to 1.
    pub fn new(report: &'a mut dyn FnMut(f64) -> Result<()>) -> Self {
        Self {
            report,
            from: 0.0,
            to: 1.0,
        }
    }

    /// The progress of the part of this job between two fractions of it.
    pub fn part(&mut self, from: f64, to: f64) -> Progress<'_> {
        let span = self.to - self.from;
        Progress {
            report: &mut *self.report,
            from: self.from + span * from,
            to: self.from + span * to,
        }
    }

    /// Reports the fraction done of this part.
    pub fn at(&mut self, fraction: f64) -> Result<()> {
        (self.report)(self.from + (self.to - self.from) * fraction.clamp(0.0, 1.0))
    }
}

/// Runs `task(i)` for all i below `count` on up to `threads` threads; the results are in order of i.
pub fn map<T: Send>(
    threads: usize,
    count: usize,
    progress: &mut Progress,
    task: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>> {
    if threads.min(count) < 2 {
        return (0..count)
            .map(|i| {
                let value = task(i);
                progress.at((i + 1) as f64 / count as f64)?;
                Ok(value)
            })
            .collect();
    }
    let next = AtomicUsize::new(0);
    let stopped = AtomicBool::new(false);
    let work = |done: &mut Vec<(usize, T)>| -> bool {
        let i = next.fetch_add(1, Ordering::Relaxed);
        if i >= count || stopped.load(Ordering::Relaxed) {
            return false;
        }
        done.push((i, task(i)));
        true
    };
    let (mut done, outcome) = std::thread::scope(|scope| {
        let helpers: Vec<_> = (1..threads.min(count))
            .map(|_| {
                scope.spawn(|| {
                    contained(|| {
                        let mut done = Vec::new();
                        while work(&mut done) {}
                        done
                    })
                })
            })
            .collect();
        let mut done = Vec::new();
        let mut outcome = Ok(());
        while outcome.is_ok() && work(&mut done) {
            outcome = progress.at(next.load(Ordering::Relaxed).min(count) as f64 / count as f64);
        }
        if outcome.is_err() {
            stopped.store(true, Ordering::Relaxed);
        }
        for helper in helpers {
            match helper.join() {
                Ok(Ok(part)) => done.extend(part),
                Ok(Err(panic)) => outcome = outcome.and(Err(panic)),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        (done, outcome)
    });
    outcome?;
    done.sort_unstable_by_key(|(i, _)| *i);
    Ok(done.into_iter().map(|(_, value)| value).collect())
}
