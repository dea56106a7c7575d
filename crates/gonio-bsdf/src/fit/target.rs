//! The values that a fit compares with.

use super::FitError;
use crate::bsdf::Bsdf;
use crate::half_angles::HalfAngles;
use crate::merl::{CELLS, MerlTable, PHI_D, THETA_D, THETA_H, cell_middle, is_isotropic};
use gonio_light::DVec3;
use std::f64::consts::TAU;

/// The smallest cosine of the directions that count: 10 degrees above the horizon.
const LEAST_COSINE: f64 = 0.173_6;
/// The least number of values that determine a model.
const LEAST_VALUES: usize = 50;
/// Cells between two values, in each coordinate: of the grey fits from all starting points, and of the fit in colour.
const COARSE: [usize; 3] = [4, 6, 22];
const FINE: [usize; 3] = [3, 4, 14];
/// Azimuths of the half vector are multiples of this share of a turn, the golden section, which fills the circle evenly.
const GOLDEN_SECTION: f64 = 0.618_033_988_749_895;

/// A value for two directions.
pub(super) struct Point {
    pub wi: DVec3,
    pub wo: DVec3,
    /// `(f cos)^(1/3)`
    pub target: DVec3,
}

/// The values of a table or a function, at the middles of cells of a MERL table.
pub struct FitTarget {
    pub(super) coarse: Vec<Point>,
    pub(super) fine: Vec<Point>,
    pub(super) is_isotropic: bool,
}

impl FitTarget {
    /// A measured table, which is isotropic by its format.
    ///
    /// # Errors
    ///
    /// Too few cells with a value, or with one above 0.
    pub fn of_table(table: &MerlTable) -> Result<Self, FitError> {
        let points = |steps| {
            let cells: Vec<(usize, HalfAngles)> = cells(steps).collect();
            let pairs = cells.iter().map(|(_, angles)| angles.directions());
            // A table may miss single cells, so values are not interpolated.
            let values = cells.iter().map(|(cell, _)| table.at_cell(*cell));
            finite(pairs.zip(values))
        };
        Self { coarse: points(COARSE), fine: points(FINE), is_isotropic: true }.with_enough_values()
    }

    /// A function. For an anisotropic one, the half vectors have all azimuths.
    ///
    /// # Errors
    ///
    /// A function that transmits light, or that has too few finite values, or only 0.
    pub fn of_function(bsdf: &dyn Bsdf) -> Result<Self, FitError> {
        if bsdf.transmits() {
            return Err(FitError::Transmits);
        }
        let points = |steps| {
            let turned = |(index, (_, angles)): (usize, (usize, HalfAngles))| {
                let (sin, cos) = (TAU * (index as f64 * GOLDEN_SECTION).fract()).sin_cos();
                let turn = |w: DVec3| DVec3::new(cos * w.x - sin * w.y, sin * w.x + cos * w.y, w.z);
                let (wi, wo) = angles.directions();
                (turn(wi), turn(wo))
            };
            let pairs: Vec<(DVec3, DVec3)> = cells(steps).enumerate().map(turned).collect();
            let values = bsdf.evaluate_all(&pairs);
            finite(pairs.iter().copied().zip(values.into_iter().map(Some)))
        };
        Self { coarse: points(COARSE), fine: points(FINE), is_isotropic: is_isotropic(bsdf) }.with_enough_values()
    }

    /// Whether turning both directions about the normal changes nothing. Anisotropic models then have equal widths.
    pub fn is_isotropic(&self) -> bool {
        self.is_isotropic
    }

    fn with_enough_values(self) -> Result<Self, FitError> {
        let values = self.coarse.len();
        if values < LEAST_VALUES {
            return Err(FitError::TooFewValues { values });
        }
        let is_black = self.fine.iter().all(|point| point.target == DVec3::ZERO);
        if is_black { Err(FitError::Black) } else { Ok(self) }
    }
}

/// The cells with both directions well above the horizon, `step` apart in each coordinate.
fn cells([step_h, step_d, step_p]: [usize; 3]) -> impl Iterator<Item = (usize, HalfAngles)> {
    let rows = (0..THETA_H).step_by(step_h).flat_map(move |h| (0..THETA_D).step_by(step_d).map(move |d| (h, d)));
    // Other cells in every row, so that all values of phi_d take part.
    let all = rows.flat_map(move |(h, d)| {
        ((h * 7 + d * 3) % step_p..PHI_D).step_by(step_p).map(move |p| (h * THETA_D + d) * PHI_D + p)
    });
    all.filter_map(|cell| {
        debug_assert!(cell < CELLS);
        let angles = cell_middle(cell);
        let (wi, wo) = angles.directions();
        (wi.z >= LEAST_COSINE && wo.z >= LEAST_COSINE).then_some((cell, angles))
    })
}

/// The pairs with a finite value.
fn finite(values: impl Iterator<Item = ((DVec3, DVec3), Option<DVec3>)>) -> Vec<Point> {
    let known = values.filter_map(|((wi, wo), f)| Some((wi, wo, f.filter(|f| f.is_finite())?)));
    known.map(|(wi, wo, f)| Point { wi, wo, target: (f * wi.z).map(f64::cbrt) }).collect()
}
