//! Batches allocate for their threads, and nothing for their items once these were asked before. Left out is what allocates in single
//! queries too (see warm_queries.rs).

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use cstk::batch::{Batch, BatchJob, BatchOptions, Configurations, ItemAnswer, PosePairs};
use cstk::cobject::Class;
use cstk::pose::{Pose, Vec3};
use cstk::query::Configuration::Coordinates;
use cstk::query::QueryContext;

use helpers::random::Random;
use helpers::robots::{against, environment, free_body, space};
use helpers::shapes::dented_ball;

/// The system's allocator, and how often it was asked for memory.
struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as the caller states.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as the caller states.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// So many items, each asked several times over.
const ITEMS: usize = 4000;
const DIFFERENT: usize = 40;
/// More than the threads and the snapshots of a call take.
const MAX_PER_CALL: usize = 40;

/// The allocations of a call, once warm.
fn allocations(threads: u32, mut run: impl FnMut(&mut Batch, &BatchOptions)) -> usize {
    let options = BatchOptions {
        threads,
        ..Default::default()
    };
    let batch = &mut Batch::new();
    (0..6).for_each(|_| run(batch, &options));
    let before = COUNT.load(Ordering::Relaxed);
    run(batch, &options);
    COUNT.load(Ordering::Relaxed) - before
}

fn job<'a, S>(
    options: &'a BatchOptions,
    slots: S,
    progress: &'a mut dyn FnMut(f64) -> cstk::error::Result<()>,
) -> BatchJob<'a, S> {
    BatchJob {
        options,
        slots,
        progress,
    }
}

#[test]
fn warm_batches_allocate_nothing_for_their_items() {
    let mut random = Random::new(75);
    let dented = dented_ball(|| random.within(0.5, 0.8)).body;
    let placed: Vec<_> = (0..100).map(|_| (&dented, random.pose(9.0))).collect();
    let (around, _) = environment(&placed);
    let cobject = Arc::new(against(&space(vec![free_body(&dented)]), &around));
    let context = &mut QueryContext::new();
    let mut apart: Vec<f64> = Vec::new();
    while apart.len() < 6 * DIFFERENT {
        let q: Vec<f64> = (0..6).map(|_| random.within(-3.0, 3.0)).collect();
        if context.classify(&cobject, Coordinates(&q)).unwrap() == Class::Outside {
            apart.extend(q);
        }
    }
    let q = apart.repeat(ITEMS / DIFFERENT);
    let at = Configurations {
        q: &q,
        count: ITEMS,
    };
    let poses: Vec<[f64; 12]> = (0..DIFFERENT)
        .map(|_| Pose::from_translation(Vec3::x() * random.within(1.7, 3.0)).to_row_major())
        .collect();
    let (poses, still) = (
        poses.repeat(ITEMS / DIFFERENT),
        [Pose::identity().to_row_major(); ITEMS],
    );
    let pairs = PosePairs {
        bodies: [&dented, &dented],
        poses: [&poses, &still],
    };
    let mut sums = vec![0.0; ITEMS];
    for threads in [1, 2, 4] {
        let nothing = &mut |_| Ok(());
        let classified = allocations(threads, |batch, options| {
            let put = |slots: &mut &mut [f64], i: usize, class: ItemAnswer<Class>| {
                slots[i] = f64::from(u8::from(class.unwrap() == Class::Inside));
            };
            batch
                .classify(&cobject, at, job(options, &mut sums[..], nothing), put)
                .unwrap();
        });
        let measured = allocations(threads, |batch, options| {
            let put = |slots: &mut &mut [f64], i: usize, found: ItemAnswer<(_, &[f64])>| {
                slots[i] = found.unwrap().1[0];
            };
            let job = job(options, &mut sums[..], nothing);
            batch
                .distance_with_gradient(&cobject, at, f64::INFINITY, job, put)
                .unwrap();
        });
        let paired = allocations(threads, |batch, options| {
            let put = |slots: &mut &mut [f64], i: usize, within: ItemAnswer<bool>| {
                slots[i] = f64::from(u8::from(within.unwrap()));
            };
            batch
                .pair_within(pairs, 0.0, job(options, &mut sums[..], nothing), put)
                .unwrap();
        });
        let all = [classified, measured, paired];
        let most = if threads == 1 { 4 } else { MAX_PER_CALL };
        assert!(
            all.iter().all(|&count| count <= most),
            "{threads} threads: {all:?}"
        );
    }
}
