//! Eight lanes, and four of doubles, with AVX2 and FMA. An [`Avx2`] is created only after the processor was detected to have both; that makes its
//! operations safe.

use std::arch::x86_64::*;

use super::F64x4;
use super::doubles::DoubleInstructions;
use super::eight::{Instructions, LANES_OF};

/// The proof that the processor has AVX2 and FMA.
#[derive(Clone, Copy)]
pub struct Avx2(());

impl Avx2 {
    /// # Safety
    /// The processor must have AVX2 and FMA.
    #[inline(always)]
    pub unsafe fn assumed() -> Self {
        Self(())
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
    fn rounded(self, first: __m256d, more: __m256d) -> __m256 {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_set_m128(_mm256_cvtpd_ps(more), _mm256_cvtpd_ps(first)) }
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
    fn signed_as(self, a: __m256, sign: __m256) -> __m256 {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_xor_ps(a, _mm256_and_ps(_mm256_set1_ps(-0.0), sign)) }
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
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, _mm256_set1_ps(limit))) as u32 }
    }

    #[inline(always)]
    fn not_above(self, a: __m256, limit: f32) -> u32 {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_NGT_UQ>(a, _mm256_set1_ps(limit))) as u32 }
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
    fn numbered(self, values: &[u32; 8], kept: u32, first: u32) -> [u32; 8] {
        // SAFETY: eight numbers are read, and the processor has the instructions.
        unsafe {
            let lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
            let numbers = _mm256_add_epi32(_mm256_set1_epi32(first as i32), lanes);
            let values = _mm256_loadu_si256(values.as_ptr().cast());
            let values = _mm256_and_si256(values, _mm256_set1_epi32(kept as i32));
            std::mem::transmute::<__m256i, [u32; 8]>(_mm256_or_si256(values, numbers))
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

impl DoubleInstructions for Avx2 {
    type Numbers64 = __m256d;

    #[inline(always)]
    fn splat64(self, value: f64) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_set1_pd(value) }
    }

    #[inline(always)]
    fn load64(self, values: &[f64; 4]) -> __m256d {
        // SAFETY: four numbers are read, and the processor has the instruction.
        unsafe { _mm256_loadu_pd(values.as_ptr()) }
    }

    #[inline(always)]
    fn array64(self, a: __m256d) -> F64x4 {
        // SAFETY: both are four numbers, and the processor has the instruction.
        unsafe { std::mem::transmute::<__m256d, F64x4>(a) }
    }

    #[inline(always)]
    fn add64(self, a: __m256d, b: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_add_pd(a, b) }
    }

    #[inline(always)]
    fn sub64(self, a: __m256d, b: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_sub_pd(a, b) }
    }

    #[inline(always)]
    fn mul64(self, a: __m256d, b: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_mul_pd(a, b) }
    }

    #[inline(always)]
    fn quotient64(self, a: __m256d, divisor: __m256d) -> __m256d {
        // SAFETY: the processor has the instructions.
        unsafe {
            let is_none = _mm256_cmp_pd::<_CMP_EQ_OQ>(divisor, _mm256_setzero_pd());
            _mm256_andnot_pd(is_none, _mm256_div_pd(a, divisor))
        }
    }

    #[inline(always)]
    fn min64(self, a: __m256d, b: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_min_pd(a, b) }
    }

    #[inline(always)]
    fn max64(self, a: __m256d, b: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_max_pd(a, b) }
    }

    #[inline(always)]
    fn abs64(self, a: __m256d) -> __m256d {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), a) }
    }

    #[inline(always)]
    fn rolled64(self, a: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_permute4x64_pd::<0b11_00_10_01>(a) }
    }

    #[inline(always)]
    fn ending64(self, a: __m256d, last: __m256d) -> __m256d {
        // SAFETY: the processor has the instruction.
        unsafe { _mm256_blend_pd::<0b1000>(a, last) }
    }

    #[inline(always)]
    fn following64(self, a: __m256d, next: __m256d) -> __m256d {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_permute4x64_pd::<0b00_11_10_01>(_mm256_blend_pd::<0b0001>(a, next)) }
    }

    #[inline(always)]
    fn less64(self, a: __m256d, b: __m256d) -> u32 {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(a, b)) as u32 }
    }

    #[inline(always)]
    fn equal64(self, a: __m256d, b: __m256d) -> u32 {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_EQ_OQ>(a, b)) as u32 }
    }

    #[inline(always)]
    fn chosen64(self, a: __m256d, b: __m256d, if_less: __m256d, otherwise: __m256d) -> __m256d {
        // SAFETY: the processor has the instructions.
        unsafe { _mm256_blendv_pd(otherwise, if_less, _mm256_cmp_pd::<_CMP_LT_OQ>(a, b)) }
    }

    #[inline(always)]
    fn kept64(self, a: __m256d, lanes: u32) -> __m256d {
        // SAFETY: the processor has the instructions.
        unsafe {
            let bit = _mm256_setr_epi64x(1, 2, 4, 8);
            let chosen = _mm256_and_si256(_mm256_set1_epi64x(i64::from(lanes)), bit);
            _mm256_and_pd(a, _mm256_castsi256_pd(_mm256_cmpeq_epi64(chosen, bit)))
        }
    }

    #[inline(always)]
    fn product_error(self, x: F64x4, y: F64x4, product: F64x4) -> F64x4 {
        let mut error = product;
        for lane in 0..4 {
            error.0[lane] = x.0[lane].mul_add(y.0[lane], -product.0[lane]);
        }
        error
    }
}
