//! The residuals of a fit: image slices and lit spheres of the target, the fitted model and their difference.

use crate::{PlotError, PlotFigure, PlotKind, PlotScale, PlotSettings, PlotTheme, PlottedBsdf, default_size, figure};
use gonio_bsdf::FitResidual;

/// The factor of the difference on the spheres: light is encoded as sRGB there, which hides differences of a percent.
const SPHERE_FACTOR: f64 = 10.0;

/// Image slices by cube roots, as the metric of fits has them, above spheres lit at 45 degrees.
///
/// # Errors
///
/// A function without finite values.
pub fn residuals(target: PlottedBsdf<'_>, fitted: PlottedBsdf<'_>, theme: PlotTheme) -> Result<PlotFigure, PlotError> {
    let row = |kind, factor, label| {
        let difference = FitResidual { target: target.bsdf, fitted: fitted.bsdf, factor };
        let functions = [target, fitted, PlottedBsdf { label, bsdf: &difference, ior: None }];
        let size = default_size(kind, functions.len());
        figure(&functions, &PlotSettings { kind, scale: PlotScale::CubeRoot, theme, size, ..PlotSettings::default() })
    };
    let slices = row(PlotKind::Slice, 1.0, "absolute difference")?;
    Ok(slices.above(row(PlotKind::Sphere, SPHERE_FACTOR, "absolute difference, ten times")?))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_bsdf::ModelSpec;

    #[test]
    fn slices_lie_above_spheres() {
        let build = |spec: &str| ModelSpec::parse(spec).unwrap().build();
        let (target, fitted) = (build("ggx:f0=0.9/0.6/0.3"), build("ggx:f0=0.9/0.6/0.2,alpha=0.25"));
        let plotted = |label, bsdf| PlottedBsdf { label, bsdf, ior: None };
        let figure = residuals(
            plotted("a measured surface", target.as_ref()),
            plotted("ggx:f0=0.9/0.6/0.2,alpha=0.25", fitted.as_ref()),
            PlotTheme::Light,
        );
        let figure = figure.unwrap();
        assert_eq!(figure.size(), [900.0, 800.0]);
        assert_eq!(figure.text_faults(), Vec::<String>::new());
        let tops: Vec<f64> = figure.pictures().iter().map(|picture| picture.place[1]).collect();
        assert!(tops.len() == 6 && tops[..3].iter().all(|y| *y < 200.0) && tops[3..].iter().all(|y| *y > 440.0));
        // The channel that differs, in slice and sphere.
        for picture in [&figure.pictures()[2], &figure.pictures()[5]] {
            let sum = |channel: usize| {
                picture.picture.rgba.iter().skip(channel).step_by(4).map(|value| u64::from(*value)).sum::<u64>()
            };
            assert!(sum(2) > 0 && sum(0) > 0, "{} {}", sum(0), sum(2));
        }
    }
}
