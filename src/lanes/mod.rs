//! Several numbers at once, and the choice between instruction sets at run time.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod eight;
mod four;
mod plain;

pub use eight::{Instructions, Lanes8, Triple};
pub use four::{F64x4, Points64, along64, cross64, dot64, splat64, sub64};
pub use plain::Plain;

#[cfg(target_arch = "x86_64")]
use avx2::Avx2;

/// Work that is compiled for several instruction sets. `run` and all it calls in its loops are to be inlined: closures that
/// are called from several places may not be.
pub trait Work {
    type Output;

    fn run<I: Instructions>(self, instructions: I) -> Self::Output;
}

/// Runs work with the widest instructions this processor has.
#[inline]
pub fn with_widest<W: Work>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2,fma")]
        fn with_avx2<W: Work>(work: W, avx2: Avx2) -> W::Output {
            work.run(avx2)
        }
        // Twice the registers are what AVX-512 is for here: wider lanes gain nothing.
        #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
        fn with_avx512<W: Work>(work: W, avx2: Avx2) -> W::Output {
            work.run(avx2)
        }
        if let Some(avx2) = Avx2::detected() {
            let has_avx512 = std::arch::is_x86_feature_detected!("avx512f")
                && std::arch::is_x86_feature_detected!("avx512vl")
                && std::arch::is_x86_feature_detected!("avx512dq")
                && std::arch::is_x86_feature_detected!("avx512bw");
            // SAFETY: the processor was just found to have what either takes.
            return unsafe {
                if has_avx512 {
                    with_avx512(work, avx2)
                } else {
                    with_avx2(work, avx2)
                }
            };
        }
    }
    work.run(Plain)
}

/// Something for each of the three axes. As `array::map`, which is not always inlined.
#[inline(always)]
pub fn each3<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// The cross product in single precision.
#[inline(always)]
pub fn cross3(a: &[f32; 3], b: &[f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
