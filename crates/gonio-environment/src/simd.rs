//! The instruction set of the lane-wise loops, chosen at run time.
//!
//! A program is compiled for the oldest CPU that it must run on: SSE2 on x86-64. The loops of [`crate::convert`] and the
//! traversal of the path tracer's tree are generic over [`fearless_simd::Simd`] and compiled twice on x86-64, once for that
//! baseline and once for AVX2 (x86-64-v3 with FMA and F16C, as CPUs have had since 2013). On other CPUs there is one
//! version: NEON on 64-bit ARM, `simd128` in WebAssembly where it is compiled in, plain floats elsewhere.
//!
//! AVX-512 has no version of its own: it took 2 % less time than AVX2, for a third copy of every loop.
//!
//! All versions give the same result bit by bit, apart from the payload of a NaN. Each lane goes through the same sums,
//! products, quotients and square roots in the same order, all of which IEEE 754 rounds exactly; products and sums are
//! never fused.

use fearless_simd::{Level, Simd};

/// An instruction set that the loops are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimdLevel {
    /// The oldest CPU that the program runs on.
    Baseline,
    /// x86-64-v3: AVX2 and its companions.
    Avx2,
}

impl SimdLevel {
    /// Returns the levels of this CPU, the fastest last.
    pub fn available() -> &'static [SimdLevel] {
        match Self::detect() {
            SimdLevel::Baseline => &[SimdLevel::Baseline],
            SimdLevel::Avx2 => &[SimdLevel::Baseline, SimdLevel::Avx2],
        }
    }

    /// Returns the fastest level of this CPU.
    pub fn detect() -> SimdLevel {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if Level::new().as_avx2().is_some() {
            return SimdLevel::Avx2;
        }
        SimdLevel::Baseline
    }

    /// Returns the name of the instruction set on this architecture.
    pub fn name(self) -> &'static str {
        match self {
            SimdLevel::Avx2 => "AVX2",
            SimdLevel::Baseline if cfg!(any(target_arch = "x86", target_arch = "x86_64")) => "SSE2",
            SimdLevel::Baseline if cfg!(target_arch = "aarch64") => "NEON",
            SimdLevel::Baseline if cfg!(target_feature = "simd128") => "simd128",
            SimdLevel::Baseline => "no SIMD",
        }
    }

    /// Runs a kernel at this level, or at the baseline if the CPU does not support it.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            let level = Level::new();
            if let (SimdLevel::Avx2, Some(simd)) = (self, level.as_avx2()) {
                return vectorized(simd, kernel);
            }
            if let Some(simd) = level.as_sse2() {
                return vectorized(simd, kernel);
            }
        }
        fearless_simd::dispatch!(Level::baseline(), simd => kernel.run(simd))
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
#[inline(always)]
fn vectorized<S: Simd, K: Kernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run(simd),
    )
}

/// A computation that is compiled for every level. `run` and everything that it calls must be `#[inline(always)]`, closures
/// included: a function of its own is compiled for the baseline.
pub trait Kernel {
    /// What it returns.
    type Output;

    /// Runs the computation.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}
