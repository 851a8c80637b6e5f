//! SIMD lanes, and the choice of the instruction set at run time.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod doubles;
mod eight;
mod four;
mod plain;

pub use doubles::{DoubleTriple, Doubles};
pub use eight::{Instructions, Lanes8, Triple};
pub use four::{F64x4, Numbers, Points64, along64, at64, cross64, dot64, nearest, splat64, sub64};
pub use plain::Plain;

#[cfg(target_arch = "x86_64")]
use std::arch::is_x86_feature_detected as has;
#[cfg(target_arch = "x86_64")]
use std::sync::atomic::{AtomicU8, Ordering};

#[cfg(target_arch = "x86_64")]
use avx2::Avx2;

/// Code that is compiled once per instruction set. `run` and everything it calls in its loops must be inlined; the compiler may
/// not inline a closure that is called from several places.
pub trait Work {
    type Output;

    fn run<I: Instructions>(self, instructions: I) -> Self::Output;
}

/// Whether this processor has AVX2 and what comes with it. Detected once and cached: all of it is one load then.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn has_avx2() -> bool {
    const UNKNOWN: u8 = 0;
    const ABSENT: u8 = 1;
    const PRESENT: u8 = 2;
    static KNOWN: AtomicU8 = AtomicU8::new(UNKNOWN);

    #[cold]
    fn find() -> u8 {
        let has_bits = has!("popcnt") && has!("bmi1") && has!("bmi2") && has!("lzcnt");
        let found = match has!("avx2") && has!("fma") && has_bits {
            true => PRESENT,
            false => ABSENT,
        };
        KNOWN.store(found, Ordering::Relaxed);
        found
    }
    match KNOWN.load(Ordering::Relaxed) {
        UNKNOWN => find() == PRESENT,
        known => known == PRESENT,
    }
}

/// AVX-512 is not used: its registers, twice as many, gain a fiftieth on an AMD EPYC and lose a tenth on an Intel Xeon, where the
/// compiler copies structures 512 bits at a time; wider lanes gain nothing.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,popcnt,bmi1,bmi2,lzcnt")]
fn with_avx2<W: Work>(work: W, avx2: Avx2) -> W::Output {
    work.run(avx2)
}

/// Runs work with AVX2 where this processor has it.
#[inline]
pub fn with_widest<W: Work>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: the processor was detected to have the instructions of the branch taken.
    unsafe {
        if has_avx2() {
            return with_avx2(work, Avx2::assumed());
        }
    }
    work.run(Plain)
}

/// What work gives with each instruction set that this processor has, [`Plain`] first: for tests that compare them.
pub fn with_each<W: Work>(work: impl Fn() -> W) -> Vec<W::Output> {
    #[allow(unused_mut)]
    let mut found = vec![work().run(Plain)];
    #[cfg(target_arch = "x86_64")]
    // SAFETY: used only where the processor was detected to have it.
    unsafe {
        if has_avx2() {
            found.push(with_avx2(work(), Avx2::assumed()));
        }
    }
    found
}

/// The values of a function for the three axes. Like `array::map`, which is not always inlined. What computes with lanes takes
/// [`each_axis`] instead.
#[inline(always)]
pub fn each3<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// The values of an expression for the three axes, `each_axis!(k => ...)`. Not every closure is inlined: one that computes with lanes is
/// then compiled without the processor's instructions, and makes a call of each.
macro_rules! each_axis {
    ($k:ident => $value:expr) => {
        [
            {
                let $k = 0usize;
                $value
            },
            {
                let $k = 1usize;
                $value
            },
            {
                let $k = 2usize;
                $value
            },
        ]
    };
}
pub(crate) use each_axis;

/// The cross product in single precision.
#[inline(always)]
pub fn cross3(a: &[f32; 3], b: &[f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
