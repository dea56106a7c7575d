//! The operations on registers, and functions of all components of one point.

use super::registers::{Operand, Registers};
use crate::code::{Along, One, Reg, Three, Two, Whole};
use crate::lanes::LaneSet;
use crate::math::{self, f, i};

#[inline(always)]
fn bits(value: f32) -> u32 {
    value.to_bits()
}

#[inline(always)]
fn truth(value: bool) -> u32 {
    u32::from(value)
}

impl Registers {
    pub fn apply_one(&mut self, op: One, dst: Reg, a: Reg) {
        macro_rules! float {
            ($e:expr) => {
                self.one(dst, a, |x| bits($e(f(x))))
            };
        }
        match op {
            One::FNeg => self.one(dst, a, |x| x ^ 0x8000_0000),
            One::INeg => self.one(dst, a, u32::wrapping_neg),
            One::Not => self.one(dst, a, |x| x ^ 1),
            One::Complement => self.one(dst, a, |x| !x),
            One::FAbs => self.one(dst, a, |x| x & 0x7fff_ffff),
            One::IAbs => self.one(dst, a, |x| i(x).wrapping_abs() as u32),
            One::FSign => float!(math::sign),
            One::ISign => self.one(dst, a, |x| i(x).signum() as u32),
            One::Floor => float!(math::floor),
            One::Ceil => float!(|x: f32| -math::floor(-x)),
            One::Trunc => float!(math::trunc),
            One::Round => float!(math::round_even),
            One::Fract => float!(|x: f32| x - math::floor(x)),
            One::Sqrt => float!(f32::sqrt),
            One::InverseSqrt => float!(|x: f32| 1.0 / x.sqrt()),
            One::Exp => float!(math::exp),
            One::Exp2 => float!(math::exp2),
            One::Log => float!(math::log),
            One::Log2 => float!(math::log2),
            One::Sin => float!(math::sin),
            One::Cos => float!(math::cos),
            One::Tan => float!(math::tan),
            One::Asin => float!(math::asin),
            One::Acos => float!(math::acos),
            One::Atan => float!(|x| math::atan2(x, 1.0)),
            One::Sinh => float!(math::sinh),
            One::Cosh => float!(math::cosh),
            One::Tanh => float!(math::tanh),
            One::Asinh => float!(math::asinh),
            One::Acosh => float!(math::acosh),
            One::Atanh => float!(math::atanh),
            One::Radians => float!(|x: f32| x * (std::f32::consts::PI / 180.0)),
            One::Degrees => float!(|x: f32| x * (180.0 / std::f32::consts::PI)),
            One::IsNan => self.one(dst, a, |x| truth(f(x).is_nan())),
            One::IsInf => self.one(dst, a, |x| truth(f(x).is_infinite())),
            One::FToI => self.one(dst, a, |x| f(x) as i32 as u32),
            // A negative number is undefined (GLSL 4.60, section 5.4.1); Mesa converts it by way of `int`.
            One::FToU => self.one(dst, a, |x| if f(x) < 0.0 { f(x) as i32 as u32 } else { f(x) as u32 }),
            One::IToF => self.one(dst, a, |x| bits(i(x) as f32)),
            One::UToF => self.one(dst, a, |x| bits(x as f32)),
            One::FToB => self.one(dst, a, |x| truth(f(x) != 0.0)),
            One::IToB => self.one(dst, a, |x| truth(x != 0)),
            One::BToF => self.one(dst, a, |x| if x != 0 { bits(1.0) } else { 0 }),
            One::BitCount => self.one(dst, a, u32::count_ones),
            One::BitReverse => self.one(dst, a, u32::reverse_bits),
            One::LowestBit => self.one(dst, a, |x| if x == 0 { u32::MAX } else { x.trailing_zeros() }),
            One::HighestBitU => self.one(dst, a, math::highest_bit),
            One::HighestBitI => self.one(dst, a, |x| math::highest_bit(if i(x) < 0 { !x } else { x })),
            One::Zero => self.set(dst, 0, LaneSet::FULL),
            One::Same => self.copy(dst, a),
        }
    }

    pub fn apply_two(&mut self, op: Two, dst: Reg, a: Reg, b: Reg) {
        macro_rules! float {
            ($e:expr) => {
                self.two(dst, a, b, |x, y| bits($e(f(x), f(y))))
            };
        }
        macro_rules! slow {
            ($e:expr) => {
                self.two_slow(dst, a, b, $e)
            };
        }
        match op {
            Two::FAdd => float!(|x, y| x + y),
            Two::FSub => float!(|x, y| x - y),
            Two::FMul => float!(|x, y| x * y),
            Two::FDiv => float!(|x, y| x / y),
            Two::FMod => float!(|x: f32, y: f32| x - y * math::floor(x / y)),
            Two::FMin => float!(math::min),
            Two::FMax => float!(math::max),
            Two::Pow => slow!(|x, y| bits(math::pow(f(x), f(y)))),
            Two::Atan2 => slow!(|x, y| bits(math::atan2(f(x), f(y)))),
            Two::Step => float!(|edge: f32, x: f32| if x >= edge { 1.0 } else { 0.0 }),
            Two::Ldexp => slow!(|x, y| bits(math::ldexp(f(x), i(y)))),
            Two::IAdd => self.two(dst, a, b, u32::wrapping_add),
            Two::ISub => self.two(dst, a, b, u32::wrapping_sub),
            Two::IMul => self.two(dst, a, b, u32::wrapping_mul),
            // A division by zero is undefined (GLSL 4.60, section 5.9); Mesa returns all ones.
            Two::IDiv => slow!(|x, y| if y == 0 { u32::MAX } else { i(x).wrapping_div(i(y)) as u32 }),
            Two::IRem => slow!(|x, y| if y == 0 { u32::MAX } else { i(x).wrapping_rem(i(y)) as u32 }),
            Two::UDiv => slow!(|x, y| x.checked_div(y).unwrap_or(u32::MAX)),
            Two::URem => slow!(|x, y| x.checked_rem(y).unwrap_or(u32::MAX)),
            Two::And => self.two(dst, a, b, |x, y| x & y),
            Two::Or => self.two(dst, a, b, |x, y| x | y),
            Two::Xor => self.two(dst, a, b, |x, y| x ^ y),
            Two::Shl => self.two(dst, a, b, u32::wrapping_shl),
            Two::ShrI => self.two(dst, a, b, |x, y| i(x).wrapping_shr(y) as u32),
            Two::ShrU => self.two(dst, a, b, u32::wrapping_shr),
            Two::IMin => slow!(|x, y| i(x).min(i(y)) as u32),
            Two::IMax => slow!(|x, y| i(x).max(i(y)) as u32),
            Two::UMin => slow!(std::cmp::min),
            Two::UMax => slow!(std::cmp::max),
            Two::FLess => self.two(dst, a, b, |x, y| truth(f(x) < f(y))),
            Two::FLessEqual => self.two(dst, a, b, |x, y| truth(f(x) <= f(y))),
            Two::FGreater => self.two(dst, a, b, |x, y| truth(f(x) > f(y))),
            Two::FGreaterEqual => self.two(dst, a, b, |x, y| truth(f(x) >= f(y))),
            Two::FEqual => slow!(|x, y| truth(f(x) == f(y))),
            Two::FNotEqual => slow!(|x, y| truth(f(x) != f(y))),
            Two::ILess => self.two(dst, a, b, |x, y| truth(i(x) < i(y))),
            Two::ILessEqual => slow!(|x, y| truth(i(x) <= i(y))),
            Two::IGreater => slow!(|x, y| truth(i(x) > i(y))),
            Two::IGreaterEqual => slow!(|x, y| truth(i(x) >= i(y))),
            Two::ULess => slow!(|x, y| truth(x < y)),
            Two::ULessEqual => slow!(|x, y| truth(x <= y)),
            Two::UGreater => slow!(|x, y| truth(x > y)),
            Two::UGreaterEqual => slow!(|x, y| truth(x >= y)),
            Two::IEqual => self.two(dst, a, b, |x, y| truth(x == y)),
            Two::INotEqual => slow!(|x, y| truth(x != y)),
            Two::CarryOut => slow!(|x, y| truth(x.checked_add(y).is_none())),
            Two::BorrowOut => slow!(|x, y| truth(x < y)),
        }
    }

    pub fn apply_three(&mut self, op: Three, dst: Reg, regs: [Reg; 3]) {
        macro_rules! float {
            ($e:expr) => {
                self.three(dst, regs, |x, y, z| bits($e(f(x), f(y), f(z))))
            };
        }
        match op {
            Three::FClamp => float!(|x, low, high| math::min(math::max(x, low), high)),
            Three::IClamp => self.three(dst, regs, |x, y, z| i(x).max(i(y)).min(i(z)) as u32),
            Three::UClamp => self.three(dst, regs, |x, y, z| x.max(y).min(z)),
            Three::Mix => float!(|x: f32, y: f32, a: f32| x * (1.0 - a) + y * a),
            Three::Smoothstep => float!(math::smoothstep),
            Three::Fma => float!(|x: f32, y: f32, z: f32| x * y + z),
            Three::Select => self.three(dst, regs, |c, x, y| if c != 0 { x } else { y }),
            Three::ExtractI => self.three(dst, regs, |x, at, n| math::extract(x, at, n, true)),
            Three::ExtractU => self.three(dst, regs, |x, at, n| math::extract(x, at, n, false)),
        }
    }

    pub fn reduce(&mut self, dst: Reg, a: Reg, n: u32, all: bool) {
        if n == 0 {
            return self.set(dst, truth(all), LaneSet::FULL);
        }
        self.copy(dst, a);
        for at in 1..n {
            self.apply_two(if all { Two::And } else { Two::Or }, dst, dst, a + at);
        }
    }

    /// The difference within each 2x2 quad, whose lanes are (0, 0), (1, 0), (0, 1), (1, 1); separately in both rows or
    /// columns.
    pub fn derivative(&mut self, dst: Reg, a: Reg, along: Along) {
        let written = self.written(a);
        let Operand::Each(row) = self.operand(a) else { return self.set(dst, 0, written) };
        let row = *row;
        let x = |lane: usize| f(row[lane | 1]) - f(row[lane & !1]);
        let y = |lane: usize| f(row[lane | 2]) - f(row[lane & !2]);
        let written = LaneSet::filter(|lane| (lane & !3..=lane | 3).all(|lane| written.contains(lane)));
        match along {
            Along::X => self.set_each(dst, written, |lane| bits(x(lane))),
            Along::Y => self.set_each(dst, written, |lane| bits(y(lane))),
            Along::Both => self.set_each(dst, written, |lane| bits(x(lane).abs() + y(lane).abs())),
        }
    }
}

/// Applies a function to the components of one point; results beyond its own are 0.
pub(super) fn apply_whole(op: Whole, input: &[u32]) -> [u32; 16] {
    let mut output = [0; 16];
    let x = |at: usize| input.get(at).map_or(0.0, |bits| f(*bits));
    let first = input.first().copied().unwrap_or(0);
    match op {
        Whole::Determinant(side) => output[0] = (determinant(input, usize::from(side)) as f32).to_bits(),
        Whole::Inverse(side) => inverse(input, usize::from(side), &mut output),
        Whole::Refract(n) => refract(input, usize::from(n), &mut output),
        Whole::Modf => {
            let whole = crate::math::trunc(x(0));
            let rest = if x(0).is_infinite() { 0.0 } else { x(0) - whole };
            (output[0], output[1]) = (rest.copysign(x(0)).to_bits(), whole.to_bits());
        }
        Whole::Frexp => {
            let (fraction, exponent) = frexp(x(0));
            (output[0], output[1]) = (fraction.to_bits(), exponent as u32);
        }
        Whole::PackUnorm2x16 => output[0] = pack(&[x(0), x(1)], 0.0, 65535.0),
        Whole::PackSnorm2x16 => output[0] = pack(&[x(0), x(1)], -1.0, 32767.0),
        Whole::PackUnorm4x8 => output[0] = pack(&[x(0), x(1), x(2), x(3)], 0.0, 255.0),
        Whole::PackSnorm4x8 => output[0] = pack(&[x(0), x(1), x(2), x(3)], -1.0, 127.0),
        Whole::PackHalf2x16 => output[0] = half(x(0)) | half(x(1)) << 16,
        Whole::UnpackUnorm2x16 => unpack(first, 2, false, &mut output),
        Whole::UnpackSnorm2x16 => unpack(first, 2, true, &mut output),
        Whole::UnpackUnorm4x8 => unpack(first, 4, false, &mut output),
        Whole::UnpackSnorm4x8 => unpack(first, 4, true, &mut output),
        Whole::UnpackHalf2x16 => {
            (output[0], output[1]) = (from_half(first & 0xffff).to_bits(), from_half(first >> 16).to_bits());
        }
    }
    output
}

/// A cell of a matrix without some of its rows and columns.
fn minor(m: &[u32], side: usize, rows: &[usize], columns: &[usize]) -> f64 {
    let cell = |row: usize, column: usize| m.get(column * side + row).map_or(0.0, |bits| f64::from(f(*bits)));
    match (rows, columns) {
        ([row], [column]) => cell(*row, *column),
        ([first, rest @ ..], columns) => {
            let mut sum = 0.0;
            for (at, column) in columns.iter().enumerate() {
                let others: Vec<usize> = columns.iter().copied().filter(|c| c != column).collect();
                let term = cell(*first, *column) * minor(m, side, rest, &others);
                sum += if at % 2 == 0 { term } else { -term };
            }
            sum
        }
        _ => 1.0,
    }
}

fn determinant(m: &[u32], side: usize) -> f64 {
    let all: Vec<usize> = (0..side).collect();
    minor(m, side, &all, &all)
}

/// The inverse by cofactors; infinities and NaN for a singular matrix.
fn inverse(m: &[u32], side: usize, output: &mut [u32; 16]) {
    let whole = determinant(m, side);
    let without = |left_out: usize| (0..side).filter(|at| *at != left_out).collect::<Vec<usize>>();
    for (row, column) in (0..side).flat_map(|row| (0..side).map(move |column| (row, column))) {
        // The transposed cofactor.
        let cofactor = minor(m, side, &without(column), &without(row));
        let signed = if (row + column) % 2 == 0 { cofactor } else { -cofactor };
        if let Some(cell) = output.get_mut(column * side + row) {
            *cell = ((signed / whole) as f32).to_bits();
        }
    }
}

/// refract(I, N, eta) (GLSL 4.60, section 8.5): zero for total reflection.
fn refract(input: &[u32], n: usize, output: &mut [u32; 16]) {
    let x = |at: usize| input.get(at).map_or(0.0, |bits| f(*bits));
    let (incident, normal, eta) = (|at: usize| x(at), |at: usize| x(n + at), x(2 * n));
    let cosine: f32 = (0..n).map(|at| normal(at) * incident(at)).sum();
    let k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if k < 0.0 {
        return;
    }
    for (at, cell) in output.iter_mut().enumerate().take(n) {
        *cell = (eta * incident(at) - (eta * cosine + k.sqrt()) * normal(at)).to_bits();
    }
}

/// x = fraction * 2^exponent with a fraction from 1/2 to 1; zero, infinity and NaN stay with the exponent 0.
fn frexp(x: f32) -> (f32, i32) {
    if x == 0.0 || !x.is_finite() {
        return (x, 0);
    }
    let bits = f64::from(x).to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32 - 1022;
    (f64::from_bits(bits & !(0x7ff << 52) | 1022 << 52) as f32, exponent)
}

fn pack(values: &[f32], low: f32, scale: f32) -> u32 {
    let width = 32 / values.len() as u32;
    let mask = if width == 32 { u32::MAX } else { (1 << width) - 1 };
    values.iter().enumerate().fold(0, |packed, (at, value)| {
        let scaled = crate::math::round_even(value.max(low).min(1.0) * scale) as i32;
        packed | (scaled as u32 & mask) << (at as u32 * width)
    })
}

fn unpack(packed: u32, count: u32, signed: bool, output: &mut [u32; 16]) {
    let width = 32 / count;
    for (at, cell) in output.iter_mut().enumerate().take(count as usize) {
        let left = packed << (32 - width - at as u32 * width);
        let most = if signed { (1_i32 << (width - 1)) - 1 } else { ((1_u32 << width) - 1) as i32 } as f32;
        let value = match signed {
            true => ((left as i32 >> (32 - width)) as f32 / most).max(-1.0),
            false => (left >> (32 - width)) as f32 / most,
        };
        *cell = value.to_bits();
    }
}

/// A 16-bit float, rounded to the nearest, the even one of two.
fn half(x: f32) -> u32 {
    let bits = x.to_bits();
    let sign = bits >> 16 & 0x8000;
    let magnitude = bits & 0x7fff_ffff;
    if magnitude > 0x7f80_0000 {
        return sign | 0x7e00;
    }
    // From 65520 on it is infinity.
    if magnitude >= 0x477f_f000 {
        return sign | 0x7c00;
    }
    if magnitude < 0x3880_0000 {
        // Subnormal: units of 2^-24.
        let units = f64::from(f(magnitude)) * 16_777_216.0;
        let whole = (units + 6_755_399_441_055_744.0) - 6_755_399_441_055_744.0;
        return sign | whole as u32;
    }
    let rounded = magnitude + 0xfff + (magnitude >> 13 & 1);
    sign | (rounded - 0x3800_0000) >> 13
}

fn from_half(bits: u32) -> f32 {
    let sign = (bits & 0x8000) << 16;
    let (exponent, fraction) = (bits >> 10 & 0x1f, bits & 0x3ff);
    match exponent {
        0 => f((fraction as f32 / 16_777_216.0).to_bits() | sign),
        31 => f(sign | 0x7f80_0000 | fraction << 13),
        _ => f(sign | (exponent + 112) << 23 | fraction << 13),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_go_there_and_back() {
        for bits in 0..0x7c00_u32 {
            assert_eq!(half(from_half(bits)), bits);
            assert_eq!(half(-from_half(bits)), bits | 0x8000);
        }
        assert_eq!((half(65519.0), half(65520.0), half(f32::INFINITY)), (0x7bff, 0x7c00, 0x7c00));
        assert_eq!((half(1e-9), half(-0.0)), (0, 0x8000));
    }

    #[test]
    fn inverses_of_matrices_undo_them() {
        let m: Vec<u32> = [2.0_f32, 1.0, 0.0, 3.0, 1.0, 4.0, 0.5, 2.0, 0.0, 2.0, 5.0, 1.0, 1.0, 0.0, 2.0, 3.0]
            .map(f32::to_bits)
            .to_vec();
        let mut inverse_of = [0; 16];
        inverse(&m, 4, &mut inverse_of);
        for (row, column) in (0..4).flat_map(|r| (0..4).map(move |c| (r, c))) {
            let cell: f32 = (0..4).map(|k| f(m[k * 4 + row]) * f(inverse_of[column * 4 + k])).sum();
            assert!((cell - f32::from(u8::from(row == column))).abs() < 1e-5, "{row} {column}: {cell}");
        }
    }

    #[test]
    fn fractions_and_exponents() {
        assert_eq!((frexp(8.0), frexp(-0.75), frexp(0.0)), ((0.5, 4), (-0.75, 0), (0.0, 0)));
        assert_eq!(frexp(f32::from_bits(1)), (0.5, -148));
    }
}
