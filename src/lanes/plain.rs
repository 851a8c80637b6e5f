//! Eight lanes, and four of doubles, without special instructions, for every processor.

use super::F64x4;
use super::doubles::DoubleInstructions;
use super::eight::{Instructions, LANES_OF};

/// The fallback, available on every processor.
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
    fn rounded(self, first: F64x4, more: F64x4) -> [f32; 8] {
        let [a, b, c, d] = first.0.map(|x| x as f32);
        let [e, f, g, h] = more.0.map(|x| x as f32);
        [a, b, c, d, e, f, g, h]
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
        // Not fused: without an FMA instruction, `mul_add` is a function call.
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
    fn signed_as(self, a: [f32; 8], sign: [f32; 8]) -> [f32; 8] {
        zip(a, sign, |a, s| if s.is_sign_negative() { -a } else { a })
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
    fn not_above(self, a: [f32; 8], limit: f32) -> u32 {
        let mut above = 0;
        for (lane, value) in a.into_iter().enumerate() {
            above |= u32::from(value > limit) << lane;
        }
        above ^ 255
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
    fn numbered(self, values: &[u32; 8], kept: u32, first: u32) -> [u32; 8] {
        let mut result = *values;
        for (value, number) in result.iter_mut().zip(first..) {
            *value = *value & kept | number;
        }
        result
    }

    #[inline(always)]
    fn gathered(self, values: &[u32; 8], lanes: u32) -> [u32; 8] {
        let order = &LANES_OF[(lanes & 255) as usize];
        order.map(|lane| values[usize::from(lane & 7)])
    }
}

/// The bit mask of the lanes that are true.
#[inline(always)]
fn mask(lanes: [bool; 4]) -> u32 {
    let mut mask = 0;
    for (lane, is_true) in lanes.into_iter().enumerate() {
        mask |= u32::from(is_true) << lane;
    }
    mask
}

impl DoubleInstructions for Plain {
    type Numbers64 = F64x4;

    #[inline(always)]
    fn splat64(self, value: f64) -> F64x4 {
        F64x4::splat(value)
    }

    #[inline(always)]
    fn load64(self, values: &[f64; 4]) -> F64x4 {
        F64x4(*values)
    }

    #[inline(always)]
    fn array64(self, a: F64x4) -> F64x4 {
        a
    }

    #[inline(always)]
    fn add64(self, a: F64x4, b: F64x4) -> F64x4 {
        a + b
    }

    #[inline(always)]
    fn sub64(self, a: F64x4, b: F64x4) -> F64x4 {
        a - b
    }

    #[inline(always)]
    fn mul64(self, a: F64x4, b: F64x4) -> F64x4 {
        a * b
    }

    #[inline(always)]
    fn quotient64(self, a: F64x4, divisor: F64x4) -> F64x4 {
        a.quotient(divisor)
    }

    #[inline(always)]
    fn min64(self, a: F64x4, b: F64x4) -> F64x4 {
        a.min(b)
    }

    #[inline(always)]
    fn max64(self, a: F64x4, b: F64x4) -> F64x4 {
        a.max(b)
    }

    #[inline(always)]
    fn abs64(self, a: F64x4) -> F64x4 {
        a.abs()
    }

    #[inline(always)]
    fn rolled64(self, F64x4([x, y, z, w]): F64x4) -> F64x4 {
        F64x4([y, z, x, w])
    }

    #[inline(always)]
    fn ending64(self, F64x4([x, y, z, _]): F64x4, last: F64x4) -> F64x4 {
        F64x4([x, y, z, last.0[3]])
    }

    #[inline(always)]
    fn following64(self, a: F64x4, next: F64x4) -> F64x4 {
        F64x4([a.0[1], a.0[2], a.0[3], next.0[0]])
    }

    #[inline(always)]
    fn less64(self, a: F64x4, b: F64x4) -> u32 {
        mask([0, 1, 2, 3].map(|lane: usize| a.0[lane] < b.0[lane]))
    }

    #[inline(always)]
    fn equal64(self, a: F64x4, b: F64x4) -> u32 {
        mask([0, 1, 2, 3].map(|lane: usize| a.0[lane] == b.0[lane]))
    }

    #[inline(always)]
    fn chosen64(self, a: F64x4, b: F64x4, if_less: F64x4, otherwise: F64x4) -> F64x4 {
        let mut chosen = otherwise;
        for lane in 0..4 {
            if a.0[lane] < b.0[lane] {
                chosen.0[lane] = if_less.0[lane];
            }
        }
        chosen
    }

    #[inline(always)]
    fn kept64(self, a: F64x4, lanes: u32) -> F64x4 {
        let mut kept = a;
        for (lane, value) in kept.0.iter_mut().enumerate() {
            if lanes >> lane & 1 == 0 {
                *value = 0.0;
            }
        }
        kept
    }

    /// After Dekker (1971).
    #[inline(always)]
    fn product_error(self, x: F64x4, y: F64x4, product: F64x4) -> F64x4 {
        let split = |v: F64x4| {
            let scaled = v * 134_217_729.0; // 2^27 + 1
            let high = scaled - (scaled - v);
            (high, v - high)
        };
        let ((xh, xl), (yh, yl)) = (split(x), split(y));
        ((xh * yh - product) + xh * yl + xl * yh) + xl * yl
    }
}
