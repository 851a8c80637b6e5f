//! Several numbers at once: plain arrays, which the compiler turns into vector instructions, and the choice between
//! instruction sets at run time.
//!
//! No operation fuses a product and a sum, so that every instruction set gives the same bits.

use std::ops::{Add, Mul, Neg, Sub};

/// Work that is compiled for several instruction sets. `run` and all it calls in its loops are to be inlined.
pub trait Work {
    type Output;

    fn run(self) -> Self::Output;
}

/// Runs work with the widest instructions this processor has.
#[inline]
pub fn with_widest<W: Work>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn with_avx2<W: Work>(work: W) -> W::Output {
            work.run()
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor was just found to have AVX2.
            return unsafe { with_avx2(work) };
        }
    }
    work.run()
}

macro_rules! lanes {
    ($name:ident, $number:ty, $count:literal, $align:literal) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(C, align($align))]
        pub struct $name(pub [$number; $count]);

        impl $name {
            #[inline(always)]
            pub fn splat(value: $number) -> Self {
                Self([value; $count])
            }

            #[inline(always)]
            pub fn map(self, f: impl Fn($number) -> $number) -> Self {
                let mut result = self;
                for lane in 0..$count {
                    result.0[lane] = f(self.0[lane]);
                }
                result
            }

            #[inline(always)]
            pub fn zip(self, other: Self, f: impl Fn($number, $number) -> $number) -> Self {
                let mut result = self;
                for lane in 0..$count {
                    result.0[lane] = f(self.0[lane], other.0[lane]);
                }
                result
            }

            #[inline(always)]
            pub fn abs(self) -> Self {
                self.map(<$number>::abs)
            }

            #[inline(always)]
            pub fn sqrt(self) -> Self {
                self.map(<$number>::sqrt)
            }

            /// Lane by lane the lesser; the second where either is not a number.
            #[inline(always)]
            pub fn min(self, other: Self) -> Self {
                self.zip(other, |a, b| if a < b { a } else { b })
            }

            /// Lane by lane the greater; the second where either is not a number.
            #[inline(always)]
            pub fn max(self, other: Self) -> Self {
                self.zip(other, |a, b| if a > b { a } else { b })
            }

            #[inline(always)]
            pub fn least(self) -> $number {
                {
                    let mut least = self.0[0];
                    for lane in 1..$count {
                        least = if self.0[lane] < least {
                            self.0[lane]
                        } else {
                            least
                        };
                    }
                    least
                }
            }

            #[inline(always)]
            pub fn greatest(self) -> $number {
                {
                    let mut most = self.0[0];
                    for lane in 1..$count {
                        most = if self.0[lane] > most {
                            self.0[lane]
                        } else {
                            most
                        };
                    }
                    most
                }
            }
        }

        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                self.zip(other, |a, b| a + b)
            }
        }

        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                self.zip(other, |a, b| a - b)
            }
        }

        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                self.zip(other, |a, b| a * b)
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.map(|a| -a)
            }
        }

        impl Mul<$number> for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: $number) -> Self {
                self.map(|a| a * factor)
            }
        }
    };
}

lanes!(F32x8, f32, 8, 32);
lanes!(F64x4, f64, 4, 32);

/// Something for each of the three axes. As `array::map`, which is not always inlined.
#[inline(always)]
pub fn each3<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// Points or vectors, coordinates apart.
pub type Points32 = [F32x8; 3];
pub type Points64 = [F64x4; 3];

#[inline(always)]
pub fn dot32(a: &Points32, b: &Points32) -> F32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The products of many vectors with one.
#[inline(always)]
pub fn along32(points: &Points32, direction: &[f32; 3]) -> F32x8 {
    points[0] * direction[0] + points[1] * direction[1] + points[2] * direction[2]
}

#[inline(always)]
pub fn dot64(a: &Points64, b: &Points64) -> F64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn along64(points: &Points64, direction: &[f64; 3]) -> F64x4 {
    points[0] * direction[0] + points[1] * direction[1] + points[2] * direction[2]
}

#[inline(always)]
pub fn cross64(a: &Points64, b: &Points64) -> Points64 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub fn sub64(a: &Points64, b: &Points64) -> Points64 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub fn splat64(point: &[f64; 3]) -> Points64 {
    each3(|k| F64x4::splat(point[k]))
}
