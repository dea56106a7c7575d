//! The `.binary` files of the MERL BRDF database: measured isotropic BRDFs.
//!
//! A file has three little-endian 32-bit integers, 90, 90 and 180, then for red, green and blue 90 x 90 x 180 doubles in the
//! order `theta_h`, `theta_d`, `phi_d` (the last one runs fastest). A value times 1/1500 (red), 1.15/1500 (green) or
//! 1.66/1500 (blue) is `f` in 1/sr; a negative one is missing. Cell `i` of `theta_h` covers `90 (i / 90)^2` to
//! `90 ((i + 1) / 90)^2` degrees, the other cells are a degree wide; `phi_d` covers `[0, 180)` degrees.
//!
//! *Source*: W. Matusik, H. Pfister, M. Brand, L. McMillan, *A Data-Driven Reflectance Model*, SIGGRAPH 2003, and the format
//! that comes with its database. Between the middles of cells the value is interpolated; missing cells are left out.

use crate::bsdf::{Bsdf, both_above, mean};
use crate::half_angles::HalfAngles;
use crate::integrate::albedo_with_steps;
use gonio_light::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// Cells of `theta_h`.
pub const THETA_H: usize = 90;
/// Cells of `theta_d`.
pub const THETA_D: usize = 90;
/// Cells of `phi_d`.
pub const PHI_D: usize = 180;
/// Cells of one channel.
pub const CELLS: usize = THETA_H * THETA_D * PHI_D;
/// The factors of the channels.
pub const SCALES: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];
/// Bytes of a file.
pub const FILE_BYTES: usize = 12 + 3 * 8 * CELLS;

/// A measured BRDF.
#[derive(Clone, PartialEq)]
pub struct MerlTable {
    /// `f` in 1/sr, channel after channel; negative where it is missing.
    values: Vec<f32>,
    missing: usize,
}

impl fmt::Debug for MerlTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "MerlTable with {} missing values", self.missing)
    }
}

/// A file that is no MERL table, or a function that has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MerlError {
    /// The file is shorter than its header.
    NoHeader {
        /// Bytes of the file.
        bytes: usize,
    },
    /// The sizes in the header are not 90, 90 and 180.
    Sizes {
        /// The three numbers.
        found: [i32; 3],
    },
    /// The file has another length than its header requires.
    Length {
        /// Bytes of the file.
        bytes: usize,
    },
    /// Values are infinite, not a number, or beyond `f32`.
    NotFinite {
        /// How many.
        count: usize,
        /// The first one, counted from 0 over all channels.
        first: usize,
    },
    /// All values are missing.
    Empty,
    /// The table holds isotropic reflection only.
    Unsuitable {
        /// What the function does that a table cannot hold.
        reason: &'static str,
    },
}

impl fmt::Display for MerlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoHeader { bytes } => {
                write!(f, "the file has {bytes} bytes: a MERL file begins with three integers, 12 bytes")
            }
            Self::Sizes { found: [a, b, c] } => {
                write!(f, "the table is {a} x {b} x {c}: expected a MERL table of 90 x 90 x 180")
            }
            Self::Length { bytes } if *bytes < FILE_BYTES => {
                write!(f, "the file is truncated: it has {bytes} of {FILE_BYTES} bytes")
            }
            Self::Length { bytes } => write!(f, "the file is too long: it has {bytes} bytes, expected {FILE_BYTES}"),
            Self::NotFinite { count, first } => {
                write!(f, "{count} of {} values are not numbers below 3e38, the first one is value {first}", 3 * CELLS)
            }
            Self::Empty => write!(f, "all values are negative, which means missing"),
            Self::Unsuitable { reason } => write!(f, "a MERL table cannot hold a function that {reason}"),
        }
    }
}

impl std::error::Error for MerlError {}

impl MerlTable {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// Another size than that of the format, values that `f32` cannot hold, or none at all.
    pub fn read(bytes: &[u8]) -> Result<Self, MerlError> {
        let Some((header, body)) = bytes.split_first_chunk::<12>() else {
            return Err(MerlError::NoHeader { bytes: bytes.len() });
        };
        let mut sizes = header.as_chunks::<4>().0.iter().map(|four| i32::from_le_bytes(*four));
        let found = std::array::from_fn(|_| sizes.next().unwrap_or(0));
        if found != [THETA_H as i32, THETA_D as i32, PHI_D as i32] {
            return Err(MerlError::Sizes { found });
        }
        if bytes.len() != FILE_BYTES {
            return Err(MerlError::Length { bytes: bytes.len() });
        }
        let mut values = Vec::with_capacity(3 * CELLS);
        let (mut missing, mut not_finite) = (0, 0);
        let mut first = None;
        for (index, eight) in body.as_chunks::<8>().0.iter().enumerate() {
            let raw = f64::from_le_bytes(*eight);
            let value = if raw < 0.0 { -1.0 } else { (raw * SCALES[(index / CELLS).min(2)]) as f32 };
            if !(raw.is_finite() && value.is_finite()) {
                not_finite += 1;
                first.get_or_insert(index);
            }
            missing += usize::from(raw < 0.0);
            values.push(value);
        }
        if let Some(first) = first {
            return Err(MerlError::NotFinite { count: not_finite, first });
        }
        if missing == values.len() {
            return Err(MerlError::Empty);
        }
        Ok(Self { values, missing })
    }

    /// Tabulates a function at the middles of the cells. Cells whose directions lie below the horizon are missing.
    ///
    /// # Errors
    ///
    /// An anisotropic function, or one that transmits light.
    pub fn tabulate(bsdf: &dyn Bsdf) -> Result<Self, MerlError> {
        if bsdf.transmits() {
            return Err(MerlError::Unsuitable { reason: "transmits light" });
        }
        if !is_isotropic(bsdf) {
            return Err(MerlError::Unsuitable { reason: "is anisotropic" });
        }
        let mut values = vec![-1.0; 3 * CELLS];
        let mut missing = 0;
        for h in 0..THETA_H {
            let first = h * THETA_D * PHI_D;
            let pairs: Vec<_> = (first..first + THETA_D * PHI_D).map(|cell| cell_middle(cell).directions()).collect();
            for (cell, ((wi, wo), value)) in (first..).zip(pairs.iter().zip(bsdf.evaluate_all(&pairs))) {
                let is_valid = both_above(*wi, *wo) && value.is_finite();
                missing += if is_valid { 0 } else { 3 };
                for channel in 0..3 {
                    if is_valid {
                        // A negative value would mean a missing one.
                        values[channel * CELLS + cell] = value[channel].max(0.0) as f32;
                    }
                }
            }
        }
        Ok(Self { values, missing })
    }

    /// The bytes of a file.
    pub fn write(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(FILE_BYTES);
        for size in [THETA_H, THETA_D, PHI_D] {
            bytes.extend((size as i32).to_le_bytes());
        }
        for (index, value) in self.values.iter().enumerate() {
            let raw = if *value < 0.0 { -1.0 } else { f64::from(*value) / SCALES[(index / CELLS).min(2)] };
            bytes.extend(raw.to_le_bytes());
        }
        bytes
    }

    /// The number of missing values, of `3 CELLS`.
    pub fn missing(&self) -> usize {
        self.missing
    }

    /// A warning if the table seems to have other scale factors than those of the database, or none: no surface reflects
    /// more than ten times or less than a thousandth of the light.
    pub fn scale_warning(&self) -> Option<String> {
        // Steps of 1.5 degrees: a file is read in a tenth of a second.
        let albedo = mean(albedo_with_steps(self, DVec3::new(0.6, 0.0, 0.8), 60));
        let advice = "check whether the file has the scale factors of the database (1/1500, 1.15/1500, 1.66/1500)";
        if albedo > 10.0 {
            Some(format!("the surface would reflect {albedo:.0} times the light that arrives; {advice}"))
        } else if albedo < 1e-3 {
            Some(format!("the surface would reflect {:.4} % of the light only; {advice}", 100.0 * albedo))
        } else {
            None
        }
    }

    /// `f` at the middle of a cell, or `None` where a channel is missing.
    pub fn at_cell(&self, cell: usize) -> Option<DVec3> {
        let channel = |channel: usize| self.values.get(channel * CELLS + cell).copied().filter(|value| *value >= 0.0);
        Some(DVec3::new(channel(0)?.into(), channel(1)?.into(), channel(2)?.into()))
    }

    /// All cells, for a texture: red, green and blue, and 1; or zeros where a channel is missing.
    pub fn texels(&self) -> Vec<[f32; 4]> {
        let texel = |cell| self.at_cell(cell).map_or([0.0; 4], |f| f.as_vec3().extend(1.0).to_array());
        (0..CELLS).map(texel).collect()
    }

    /// `f` by interpolation; 0 where all cells around are missing.
    pub fn lookup(&self, angles: HalfAngles) -> DVec3 {
        let h = around((angles.theta_h / FRAC_PI_2).max(0.0).sqrt() * THETA_H as f64, THETA_H);
        let d = around(angles.theta_d / FRAC_PI_2 * THETA_D as f64, THETA_D);
        let position = angles.phi_d / PI * PHI_D as f64 - 0.5;
        let share = position - position.floor();
        let cell = |offset: f64| (position.floor() + offset).rem_euclid(PHI_D as f64) as usize % PHI_D;
        let p = [(cell(0.0), 1.0 - share), (cell(1.0), share)];
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for (h, weight_h) in h {
            for (d, weight_d) in d {
                for (p, weight_p) in p {
                    let weight = weight_h * weight_d * weight_p;
                    if weight > 0.0
                        && let Some(value) = self.at_cell((h * THETA_D + d) * PHI_D + p)
                    {
                        sum += weight * value;
                        weights += weight;
                    }
                }
            }
        }
        if weights > 0.0 { sum / weights } else { DVec3::ZERO }
    }
}

/// The two cells around a position, with their weights.
fn around(position: f64, cells: usize) -> [(usize, f64); 2] {
    let position = (position - 0.5).clamp(0.0, cells as f64 - 1.0);
    let first = (position.floor() as usize).min(cells - 2);
    let share = position - first as f64;
    [(first, 1.0 - share), (first + 1, share)]
}

/// The coordinates of the middle of a cell.
pub fn cell_middle(cell: usize) -> HalfAngles {
    let middle = |index: usize, cells: usize| (index as f64 + 0.5) / cells as f64;
    HalfAngles {
        theta_h: FRAC_PI_2 * middle(cell / (THETA_D * PHI_D), THETA_H).powi(2),
        theta_d: FRAC_PI_2 * middle(cell / PHI_D % THETA_D, THETA_D),
        phi_d: PI * middle(cell % PHI_D, PHI_D),
    }
}

/// Whether turning both directions about the normal changes nothing, by pairs all over the hemisphere: a narrow lobe is seen
/// at few of them.
pub(crate) fn is_isotropic(bsdf: &dyn Bsdf) -> bool {
    if bsdf.is_isotropic() {
        return true;
    }
    let of_half = |theta_h: f64| {
        let of_difference =
            move |theta_d: f64| [0.1, 1.0, 2.0].map(|phi_d| HalfAngles { theta_h, theta_d, phi_d }.directions());
        [0.02, 0.15, 0.4, 0.7, 1.0, 1.25].map(of_difference).into_iter().flatten()
    };
    let pairs: Vec<_> = [0.02, 0.1, 0.25, 0.5, 0.8, 1.1, 1.35].map(of_half).into_iter().flatten().collect();
    let turned = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let turn = |w: DVec3| DVec3::new(cos * w.x - sin * w.y, sin * w.x + cos * w.y, w.z);
        bsdf.evaluate_all(&pairs.iter().map(|(wi, wo)| (turn(*wi), turn(*wo))).collect::<Vec<_>>())
    };
    let first = turned(0.0);
    [0.7, 1.6, 2.3, 4.0, 5.2].into_iter().all(|angle| {
        first.iter().zip(turned(angle)).all(|(a, b)| {
            let largest = a.abs().max_element().max(b.abs().max_element());
            let difference = (*a - b).abs().max_element();
            // NaN is no difference: it says nothing about the azimuth.
            difference <= 1e-3 * largest || difference.is_nan()
        })
    })
}

impl Bsdf for MerlTable {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if both_above(wi, wo) { self.lookup(HalfAngles::of(wi, wo)) } else { DVec3::ZERO }
    }

    fn samples_follow_function(&self) -> bool {
        false
    }
}
