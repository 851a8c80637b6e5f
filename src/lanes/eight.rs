//! Eight numbers in single precision, for bounds: they say only what is worth a look, so products and sums are fused where
//! that is cheap, and different instruction sets may give different bits.

/// Numbers of an instruction set.
pub type Lanes8<I> = <I as Instructions>::Numbers;

/// Points or vectors, coordinates apart.
pub type Triple<I> = [Lanes8<I>; 3];

/// An instruction set that the processor has.
pub trait Instructions: Copy {
    /// Eight numbers.
    type Numbers: Copy;

    fn splat(self, value: f32) -> Self::Numbers;
    fn signed(self, values: &[i16; 8]) -> Self::Numbers;
    fn unsigned(self, values: &[u16; 8]) -> Self::Numbers;
    fn whole(self, values: &[i32; 8]) -> Self::Numbers;
    fn load(self, values: &[f32; 8]) -> Self::Numbers;
    /// Four numbers, then zeros.
    fn four(self, values: &[f32; 4]) -> Self::Numbers;
    fn array(self, a: Self::Numbers) -> [f32; 8];
    fn add(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn sub(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn mul(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn div(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// a * b + c
    fn mul_add(self, a: Self::Numbers, b: Self::Numbers, c: Self::Numbers) -> Self::Numbers;
    fn sqrt(self, a: Self::Numbers) -> Self::Numbers;
    fn abs(self, a: Self::Numbers) -> Self::Numbers;
    /// Lane by lane the lesser; the second where either is not a number.
    fn min(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// Lane by lane the greater; the second where either is not a number.
    fn max(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// One of each four in the place of all.
    fn spread<const LANE: i32>(self, a: Self::Numbers) -> Self::Numbers;
    /// Of each four the first three moved around: the second, the third, the first.
    fn rolled(self, a: Self::Numbers) -> Self::Numbers;
    /// The last four, then the first four.
    fn swapped(self, a: Self::Numbers) -> Self::Numbers;
    /// Which lanes are at most a limit, as bits.
    fn at_most(self, a: Self::Numbers, limit: f32) -> u32;
    /// Numbers with infinity for the lanes that are not in a set of bits.
    fn only(self, a: Self::Numbers, lanes: u32) -> Self::Numbers;
    /// The values of the lanes in a set of bits, one after the other; what follows them means nothing.
    fn gathered(self, values: &[u32; 8], lanes: u32) -> [u32; 8];

    /// The least of all lanes.
    #[inline(always)]
    fn least(self, a: Self::Numbers) -> f32 {
        let mut rest = self.array(a);
        let mut count = 8;
        while count > 1 {
            count /= 2;
            for lane in 0..count {
                let (a, b) = (rest[lane], rest[lane + count]);
                rest[lane] = if a < b { a } else { b };
            }
        }
        rest[0]
    }

    #[inline(always)]
    fn dot(self, a: &[Self::Numbers; 3], b: &[Self::Numbers; 3]) -> Self::Numbers {
        let first = self.mul(a[0], b[0]);
        self.mul_add(a[2], b[2], self.mul_add(a[1], b[1], first))
    }

    /// The products of many vectors with one.
    #[inline(always)]
    fn along(self, a: &[Self::Numbers; 3], b: &[f32; 3]) -> Self::Numbers {
        let b = [self.splat(b[0]), self.splat(b[1]), self.splat(b[2])];
        self.dot(a, &b)
    }

    #[inline(always)]
    fn cross(self, a: &[Self::Numbers; 3], b: &[Self::Numbers; 3]) -> [Self::Numbers; 3] {
        // Products and differences one by one, as for a single box.
        [
            self.sub(self.mul(a[1], b[2]), self.mul(a[2], b[1])),
            self.sub(self.mul(a[2], b[0]), self.mul(a[0], b[2])),
            self.sub(self.mul(a[0], b[1]), self.mul(a[1], b[0])),
        ]
    }
}

/// For each set of lanes, as bits, the lanes in it, and then any others.
const LANES_OF: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut set = 0;
    while set < 256 {
        let (mut lane, mut place) = (0, 0);
        while lane < 8 {
            if set >> lane & 1 == 1 {
                table[set][place] = lane as u8;
                place += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};

/// What every processor has.
#[derive(Clone, Copy)]
pub struct Plain;

#[inline(always)]
fn zip(a: [f32; 8], b: [f32; 8], f: impl Fn(f32, f32) -> f32) -> [f32; 8] {
    let mut result = a;
    for lane in 0..8 {
        result[lane] = f(a[lane], b[lane]);
    }
    result
}

impl Instructions for Plain {
    type Numbers = [f32; 8];

    #[inline(always)]
    fn splat(self, value: f32) -> [f32; 8] {
        [value; 8]
    }

    #[inline(always)]
    fn signed(self, values: &[i16; 8]) -> [f32; 8] {
        values.map(|value| i32::from(value) as f32)
    }

    #[inline(always)]
    fn unsigned(self, values: &[u16; 8]) -> [f32; 8] {
        values.map(|value| i32::from(value) as f32)
    }

    #[inline(always)]
    fn whole(self, values: &[i32; 8]) -> [f32; 8] {
        values.map(|value| value as f32)
    }

    #[inline(always)]
    fn load(self, values: &[f32; 8]) -> [f32; 8] {
        *values
    }

    #[inline(always)]
    fn four(self, [x, y, z, w]: &[f32; 4]) -> [f32; 8] {
        [*x, *y, *z, *w, 0.0, 0.0, 0.0, 0.0]
    }

    #[inline(always)]
    fn array(self, a: [f32; 8]) -> [f32; 8] {
        a
    }

    #[inline(always)]
    fn add(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, |a, b| a * b)
    }

    #[inline(always)]
    fn div(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, |a, b| a / b)
    }

    #[inline(always)]
    fn mul_add(self, a: [f32; 8], b: [f32; 8], c: [f32; 8]) -> [f32; 8] {
        // Not fused: without an instruction for it that is a call.
        self.add(self.mul(a, b), c)
    }

    #[inline(always)]
    fn sqrt(self, a: [f32; 8]) -> [f32; 8] {
        zip(a, a, |a, _| a.sqrt())
    }

    #[inline(always)]
    fn abs(self, a: [f32; 8]) -> [f32; 8] {
        zip(a, a, |a, _| a.abs())
    }

    #[inline(always)]
    fn min(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn spread<const LANE: i32>(self, a: [f32; 8]) -> [f32; 8] {
        let (x, y) = (a[LANE as usize & 3], a[4 + (LANE as usize & 3)]);
        [x, x, x, x, y, y, y, y]
    }

    #[inline(always)]
    fn rolled(self, a: [f32; 8]) -> [f32; 8] {
        [a[1], a[2], a[0], a[3], a[5], a[6], a[4], a[7]]
    }

    #[inline(always)]
    fn swapped(self, a: [f32; 8]) -> [f32; 8] {
        [a[4], a[5], a[6], a[7], a[0], a[1], a[2], a[3]]
    }

    #[inline(always)]
    fn at_most(self, a: [f32; 8], limit: f32) -> u32 {
        let mut lanes = 0;
        for (lane, value) in a.into_iter().enumerate() {
            lanes |= u32::from(value <= limit) << lane;
        }
        lanes
    }

    #[inline(always)]
    fn only(self, a: [f32; 8], lanes: u32) -> [f32; 8] {
        let mut result = a;
        for (lane, value) in result.iter_mut().enumerate() {
            if lanes >> lane & 1 == 0 {
                *value = f32::INFINITY;
            }
        }
        result
    }

    #[inline(always)]
    fn gathered(self, values: &[u32; 8], lanes: u32) -> [u32; 8] {
        let order = &LANES_OF[(lanes & 255) as usize];
        order.map(|lane| values[usize::from(lane & 7)])
    }
}

#[cfg(target_arch = "x86_64")]
pub use x86_64::Avx2;

// An `Avx2` is made only where the processor was found to have AVX2 and FMA: that makes its operations safe.
#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use std::arch::x86_64::*;

    use super::{Instructions, LANES_OF};

    /// AVX2 and FMA.
    #[derive(Clone, Copy)]
    pub struct Avx2(());

    impl Avx2 {
        #[inline]
        pub fn detected() -> Option<Self> {
            let has_both = std::arch::is_x86_feature_detected!("avx2")
                && std::arch::is_x86_feature_detected!("fma");
            has_both.then_some(Self(()))
        }
    }

    impl Instructions for Avx2 {
        type Numbers = __m256;

        #[inline(always)]
        fn splat(self, value: f32) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_set1_ps(value) }
        }

        #[inline(always)]
        fn signed(self, values: &[i16; 8]) -> __m256 {
            // SAFETY: eight numbers are read, and the processor has the instruction.
            unsafe {
                _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128(
                    values.as_ptr().cast(),
                )))
            }
        }

        #[inline(always)]
        fn unsigned(self, values: &[u16; 8]) -> __m256 {
            // SAFETY: eight numbers are read, and the processor has the instruction.
            unsafe {
                _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(_mm_loadu_si128(
                    values.as_ptr().cast(),
                )))
            }
        }

        #[inline(always)]
        fn whole(self, values: &[i32; 8]) -> __m256 {
            // SAFETY: eight numbers are read, and the processor has the instruction.
            unsafe { _mm256_cvtepi32_ps(_mm256_loadu_si256(values.as_ptr().cast())) }
        }

        #[inline(always)]
        fn load(self, values: &[f32; 8]) -> __m256 {
            // SAFETY: eight numbers are read, and the processor has the instruction.
            unsafe { _mm256_loadu_ps(values.as_ptr()) }
        }

        #[inline(always)]
        fn four(self, values: &[f32; 4]) -> __m256 {
            // SAFETY: four numbers are read, and the processor has the instruction.
            unsafe { _mm256_zextps128_ps256(_mm_loadu_ps(values.as_ptr())) }
        }

        #[inline(always)]
        fn spread<const LANE: i32>(self, a: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe {
                match LANE {
                    0 => _mm256_permute_ps::<0b00_00_00_00>(a),
                    1 => _mm256_permute_ps::<0b01_01_01_01>(a),
                    2 => _mm256_permute_ps::<0b10_10_10_10>(a),
                    _ => _mm256_permute_ps::<0b11_11_11_11>(a),
                }
            }
        }

        #[inline(always)]
        fn rolled(self, a: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_permute_ps::<0b11_00_10_01>(a) }
        }

        #[inline(always)]
        fn swapped(self, a: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_permute2f128_ps::<1>(a, a) }
        }

        #[inline(always)]
        fn array(self, a: __m256) -> [f32; 8] {
            // SAFETY: both are eight numbers, and the processor has the instruction.
            unsafe { std::mem::transmute::<__m256, [f32; 8]>(a) }
        }

        #[inline(always)]
        fn add(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_add_ps(a, b) }
        }

        #[inline(always)]
        fn sub(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_sub_ps(a, b) }
        }

        #[inline(always)]
        fn mul(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_mul_ps(a, b) }
        }

        #[inline(always)]
        fn div(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_div_ps(a, b) }
        }

        #[inline(always)]
        fn mul_add(self, a: __m256, b: __m256, c: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_fmadd_ps(a, b, c) }
        }

        #[inline(always)]
        fn sqrt(self, a: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_sqrt_ps(a) }
        }

        #[inline(always)]
        fn abs(self, a: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), a) }
        }

        #[inline(always)]
        fn min(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_min_ps(a, b) }
        }

        #[inline(always)]
        fn max(self, a: __m256, b: __m256) -> __m256 {
            // SAFETY: the processor has the instruction.
            unsafe { _mm256_max_ps(a, b) }
        }

        #[inline(always)]
        fn at_most(self, a: __m256, limit: f32) -> u32 {
            // SAFETY: the processor has the instruction.
            unsafe {
                _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, _mm256_set1_ps(limit))) as u32
            }
        }

        #[inline(always)]
        fn only(self, a: __m256, lanes: u32) -> __m256 {
            // SAFETY: the processor has the instructions.
            unsafe {
                let bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
                let chosen = _mm256_and_si256(_mm256_set1_epi32(lanes as i32), bit);
                let is_chosen = _mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, bit));
                _mm256_blendv_ps(_mm256_set1_ps(f32::INFINITY), a, is_chosen)
            }
        }

        #[inline(always)]
        fn gathered(self, values: &[u32; 8], lanes: u32) -> [u32; 8] {
            let order = &LANES_OF[(lanes & 255) as usize];
            // SAFETY: eight bytes and eight numbers are read, and the processor has the instructions.
            unsafe {
                let order = _mm256_cvtepu8_epi32(_mm_loadl_epi64(order.as_ptr().cast()));
                let values = _mm256_loadu_si256(values.as_ptr().cast());
                std::mem::transmute::<__m256i, [u32; 8]>(_mm256_permutevar8x32_epi32(values, order))
            }
        }
    }
}
