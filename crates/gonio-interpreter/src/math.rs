//! Functions of floats, from additions and multiplications alone: the same bits on every machine, and loops over them
//! can be vectorized. They compute in 64 bits and round once, so that errors stay below one unit in the last place of
//! the result where nothing else is said.

use std::f64::consts::{FRAC_PI_2, LN_2, LOG2_E, PI};

#[inline(always)]
pub(crate) fn f(bits: u32) -> f32 {
    f32::from_bits(bits)
}

#[inline(always)]
pub(crate) fn i(bits: u32) -> i32 {
    bits as i32
}

/// The smaller number; `b` if either is NaN, as the SSE instruction that llvmpipe uses.
#[inline(always)]
pub(crate) fn min(a: f32, b: f32) -> f32 {
    if a < b || b.is_nan() { a } else { b }
}

/// The larger number; the other one if one is NaN.
#[inline(always)]
pub(crate) fn max(a: f32, b: f32) -> f32 {
    if a > b || b.is_nan() { a } else { b }
}

/// 1, 0 or -1; 0 for NaN.
#[inline(always)]
pub(crate) fn sign(x: f32) -> f32 {
    f32::from(i8::from(x > 0.0) - i8::from(x < 0.0))
}

/// The integer part. Floats from 2^23 on, infinity and NaN have no fraction.
#[inline(always)]
pub(crate) fn trunc(x: f32) -> f32 {
    let whole = x as i32 as f32;
    if x.abs() < 8_388_608.0 { whole.copysign(x) } else { x }
}

#[inline(always)]
pub(crate) fn floor(x: f32) -> f32 {
    let whole = trunc(x);
    if whole > x { whole - 1.0 } else { whole }
}

/// The nearest integer, the even one of two.
#[inline(always)]
pub(crate) fn round_even(x: f32) -> f32 {
    const MAGIC: f32 = 8_388_608.0;
    let magic = MAGIC.copysign(x);
    if x.abs() < MAGIC { ((x + magic) - magic).copysign(x) } else { x }
}

/// Adding it rounds a number below 2^51 to an integer.
const MAGIC: f64 = 6_755_399_441_055_744.0;

/// 2^x for |x| <= 1100, by the series of e^(x ln 2) around the nearest integer.
#[inline(always)]
fn exp2_64(x: f64) -> f64 {
    let shifted = x + MAGIC;
    let whole = shifted - MAGIC;
    let r = (x - whole) * LN_2;
    let mut sum = 1.0 / 479_001_600.0;
    for factor in [
        1.0 / 39_916_800.0,
        1.0 / 3_628_800.0,
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        0.5,
        1.0,
        1.0,
    ] {
        sum = sum * r + factor;
    }
    // The low bits of the shifted number are the integer.
    sum * f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52))
}

/// 2^x; overflows to infinity and underflows to zero.
#[inline(always)]
fn exp2_wide(x: f64) -> f32 {
    let value = exp2_64(x.clamp(-1000.0, 1000.0)) as f32;
    if x.is_nan() { f32::NAN } else { value }
}

pub(crate) fn exp2(x: f32) -> f32 {
    exp2_wide(f64::from(x))
}

pub(crate) fn exp(x: f32) -> f32 {
    exp2_wide(f64::from(x) * LOG2_E)
}

/// log2 of a positive normal number, by the series of the inverse hyperbolic tangent.
#[inline(always)]
fn log2_64(x: f64) -> f64 {
    const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    let bits = x.to_bits();
    let exponent = (bits.wrapping_sub(SQRT_HALF) as i64) >> 52;
    let m = f64::from_bits(bits.wrapping_sub((exponent as u64) << 52));
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    let mut sum = 1.0 / 19.0;
    for odd in [17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        sum = sum * s2 + 1.0 / odd;
    }
    (exponent as i32) as f64 + 2.0 * s * sum * LOG2_E
}

/// log2 with the limits: minus infinity at 0, NaN below.
#[inline(always)]
fn log2_wide(x: f32) -> f64 {
    let value = log2_64(f64::from(x));
    if x > 0.0 && x < f32::INFINITY {
        value
    } else if x == 0.0 {
        f64::NEG_INFINITY
    } else if x == f32::INFINITY {
        f64::INFINITY
    } else {
        f64::NAN
    }
}

pub(crate) fn log2(x: f32) -> f32 {
    log2_wide(x) as f32
}

pub(crate) fn log(x: f32) -> f32 {
    (log2_wide(x) * LN_2) as f32
}

/// x^y = 2^(y log2 x). Undefined for x < 0, and for y <= 0 at x = 0 (GLSL 4.60, section 8.2): NaN and 0, as llvmpipe.
#[inline(always)]
pub(crate) fn pow(x: f32, y: f32) -> f32 {
    let value = exp2_wide(f64::from(y) * log2_wide(x));
    if x == 0.0 { 0.0 } else { value }
}

/// The remainder after multiples of pi/2, and their number modulo 4. Beyond 2^30, where neighbouring floats are further
/// apart than a period, the remainder is that of the 64-bit pi.
#[inline(always)]
fn quarter_turns(x: f32) -> (f64, i32) {
    let wide = f64::from(x);
    let wide = if wide.abs() > 1e9 { wide % (2.0 * PI) } else { wide };
    let turns = (wide * (2.0 / PI) + MAGIC) - MAGIC;
    // pi/2 in two parts, of which the first has 33 bits: its products with integers below 2^20 are exact.
    const HIGH: f64 = 1.570_796_326_734_125_6;
    const LOW: f64 = 6.077_100_506_506_192e-11;
    ((wide - turns * HIGH) - turns * LOW, (turns as i64 & 3) as i32)
}

#[inline(always)]
fn sin_series(r: f64) -> f64 {
    let r2 = r * r;
    let mut sum = 1.0 / 6_227_020_800.0;
    for factor in [-1.0 / 39_916_800.0, 1.0 / 362_880.0, -1.0 / 5_040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0] {
        sum = sum * r2 + factor;
    }
    sum * r
}

#[inline(always)]
fn cos_series(r: f64) -> f64 {
    let r2 = r * r;
    let mut sum = -1.0 / 87_178_291_200.0;
    for factor in [1.0 / 479_001_600.0, -1.0 / 3_628_800.0, 1.0 / 40_320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0] {
        sum = sum * r2 + factor;
    }
    sum
}

fn sin_cos(x: f32) -> (f64, f64) {
    let (r, quarter) = quarter_turns(x);
    let (s, c) = (sin_series(r), cos_series(r));
    match quarter {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// NaN for infinity.
pub(crate) fn sin(x: f32) -> f32 {
    if x.is_finite() { sin_cos(x).0 as f32 } else { f32::NAN }
}

pub(crate) fn cos(x: f32) -> f32 {
    if x.is_finite() { sin_cos(x).1 as f32 } else { f32::NAN }
}

pub(crate) fn tan(x: f32) -> f32 {
    let (s, c) = sin_cos(x);
    if x.is_finite() { (s / c) as f32 } else { f32::NAN }
}

/// The arc tangent of a number from 0 to 1, by its series around 0 after two halvings of the angle.
fn atan_64(x: f64) -> f64 {
    let halved = |t: f64| t / (1.0 + (1.0 + t * t).sqrt());
    let t = halved(halved(x));
    let t2 = t * t;
    let mut sum = 1.0 / 21.0;
    for (index, odd) in [19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0].into_iter().enumerate() {
        let factor = if index % 2 == 0 { -1.0 / odd } else { 1.0 / odd };
        sum = sum * t2 + factor;
    }
    4.0 * t * sum
}

fn atan2_64(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let angle = if ax.is_infinite() && ay.is_infinite() {
        FRAC_PI_2 / 2.0
    } else if ax == 0.0 && ay == 0.0 {
        0.0
    } else if ay <= ax {
        atan_64(ay / ax)
    } else {
        FRAC_PI_2 - atan_64(ax / ay)
    };
    let angle = if x.is_sign_negative() { PI - angle } else { angle };
    if x.is_nan() || y.is_nan() { f64::NAN } else { angle.copysign(y) }
}

/// The angle of (x, y); 0 or pi at the origin, where it is undefined.
pub(crate) fn atan2(y: f32, x: f32) -> f32 {
    atan2_64(f64::from(y), f64::from(x)) as f32
}

/// NaN outside of -1 to 1.
pub(crate) fn asin(x: f32) -> f32 {
    let x = f64::from(x);
    atan2_64(x, (1.0 - x * x).sqrt()) as f32
}

pub(crate) fn acos(x: f32) -> f32 {
    let x = f64::from(x);
    atan2_64((1.0 - x * x).sqrt(), x) as f32
}

fn exp_64(x: f32) -> f64 {
    let x = f64::from(x) * LOG2_E;
    exp2_64(x.clamp(-1000.0, 1000.0))
}

pub(crate) fn sinh(x: f32) -> f32 {
    // The difference of two exponentials loses digits near zero.
    if x.abs() < 0.1 {
        let wide = f64::from(x);
        let w2 = wide * wide;
        return (wide * (1.0 + w2 / 6.0 * (1.0 + w2 / 20.0 * (1.0 + w2 / 42.0)))) as f32;
    }
    if x.is_nan() { x } else { (0.5 * (exp_64(x) - exp_64(-x))) as f32 }
}

pub(crate) fn cosh(x: f32) -> f32 {
    if x.is_nan() { x } else { (0.5 * (exp_64(x) + exp_64(-x))) as f32 }
}

pub(crate) fn tanh(x: f32) -> f32 {
    if x.abs() > 20.0 {
        return 1.0_f32.copysign(x);
    }
    let (plus, minus) = (exp_64(x), exp_64(-x));
    if x.abs() < 0.1 {
        let wide = f64::from(x);
        let w2 = wide * wide;
        return (wide * (1.0 - w2 * (1.0 / 3.0 - w2 * (2.0 / 15.0 - w2 * 17.0 / 315.0)))) as f32;
    }
    if x.is_nan() { x } else { ((plus - minus) / (plus + minus)) as f32 }
}

fn log_64(x: f64) -> f64 {
    if x > 0.0 && x.is_finite() {
        log2_64(x) * LN_2
    } else if x == 0.0 {
        f64::NEG_INFINITY
    } else if x > 0.0 {
        x
    } else {
        f64::NAN
    }
}

pub(crate) fn asinh(x: f32) -> f32 {
    let wide = f64::from(x).abs();
    // log(1 + t) near zero.
    let value = if wide < 0.01 { wide * (1.0 - wide * wide / 6.0) } else { log_64(wide + (wide * wide + 1.0).sqrt()) };
    (value as f32).copysign(x)
}

/// NaN below 1.
pub(crate) fn acosh(x: f32) -> f32 {
    let wide = f64::from(x);
    if wide < 1.0 { f32::NAN } else { log_64(wide + (wide * wide - 1.0).sqrt()) as f32 }
}

/// NaN outside of -1 to 1.
pub(crate) fn atanh(x: f32) -> f32 {
    let wide = f64::from(x);
    if wide.abs() < 0.01 {
        return (wide * (1.0 + wide * wide / 3.0)) as f32;
    }
    (0.5 * log_64((1.0 + wide) / (1.0 - wide))) as f32
}

pub(crate) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = min(max((x - low) / (high - low), 0.0), 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub(crate) fn ldexp(x: f32, exponent: i32) -> f32 {
    (f64::from(x) * exp2_64(f64::from(exponent.clamp(-1000, 1000)))) as f32
}

/// The place of the highest bit; -1 if there is none.
pub(crate) fn highest_bit(x: u32) -> u32 {
    31_u32.wrapping_sub(x.leading_zeros())
}

pub(crate) fn extract(x: u32, offset: u32, count: u32, signed: bool) -> u32 {
    let (offset, count) = (i(offset), i(count));
    // Undefined outside of these ranges (GLSL 4.60, section 8.8).
    if count <= 0 || !(0..=31).contains(&offset) || offset.saturating_add(count) > 32 {
        return 0;
    }
    let (left, right) = ((32 - offset - count) as u32, (32 - count) as u32);
    if signed { (i(x << left) >> right) as u32 } else { (x << left) >> right }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of all magnitudes and both signs.
    fn samples() -> impl Iterator<Item = f32> {
        (0..200_000_u32).map(|at| f32::from_bits(at.wrapping_mul(21_474_843))).filter(|x| x.is_finite())
    }

    /// The distance to a number of 64 bits, in units in the last place of the 32-bit number.
    fn units(found: f32, exact: f64) -> f64 {
        let rounded = exact as f32;
        if found == rounded || (found.is_nan() && rounded.is_nan()) {
            return 0.0;
        }
        let unit = f64::from(f32::from_bits(rounded.abs().to_bits() + 1)) - f64::from(rounded.abs());
        ((f64::from(found) - exact) / unit).abs()
    }

    #[test]
    fn functions_are_exact_to_one_unit() {
        type Case = (&'static str, fn(f32) -> f32, fn(f64) -> f64, fn(f32) -> bool);
        let any: fn(f32) -> bool = |_| true;
        let cases: [Case; 17] = [
            ("exp2", exp2, f64::exp2, any),
            ("exp", exp, f64::exp, any),
            ("log2", log2, f64::log2, |x| x >= 0.0),
            ("log", log, f64::ln, |x| x >= 0.0),
            ("sin", sin, f64::sin, |x| x.abs() < 1e5),
            ("cos", cos, f64::cos, |x| x.abs() < 1e5),
            ("tan", tan, f64::tan, |x| x.abs() < 1e5),
            ("atan", |x| atan2(x, 1.0), f64::atan, any),
            ("asin", asin, f64::asin, any),
            ("acos", acos, f64::acos, any),
            ("sinh", sinh, f64::sinh, any),
            ("cosh", cosh, f64::cosh, any),
            ("tanh", tanh, f64::tanh, any),
            ("asinh", asinh, f64::asinh, any),
            ("acosh", acosh, f64::acosh, |x| x < 1e18),
            ("atanh", atanh, f64::atanh, any),
            ("pow", |x| pow(x, 7.3), |x| x.powf(f64::from(7.3_f32)), |x| x > 0.0),
        ];
        for (name, own, exact, holds) in cases {
            for x in samples().filter(|x| holds(*x)) {
                let worst = units(own(x), exact(f64::from(x)));
                assert!(worst <= 1.0, "{name}({x}) is {}, not {}", own(x), exact(f64::from(x)));
            }
        }
    }

    #[test]
    fn rounding_is_exact() {
        for x in samples() {
            assert_eq!((floor(x), trunc(x), round_even(x)), (x.floor(), x.trunc(), x.round_ties_even()), "{x}");
        }
        assert_eq!((min(f32::NAN, 1.0), max(1.0, f32::NAN), sign(-0.0)), (1.0, 1.0, 0.0));
    }
}
