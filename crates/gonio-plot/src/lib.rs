//! Plots of BSDFs as SVG and PNG.
//!
//! | module | plots |
//! |---|---|
//! | [`mod@polar`] | values in the plane of incidence, as distances from the point |
//! | [`curves`] | values over an angle, directional albedo, reciprocity error, Fresnel factors |
//! | [`lobe`] | values of all directions, as a surface |
//! | [`pictures`] | the image slice of half and difference angle, lit spheres |
//! | [`mod@residuals`] | a fit beside its target and their difference |
//! | [`scatter`] | directions drawn by importance sampling |
//! | [`shape`] | the parts of a plot as data, for any painter |
//! | [`canvas`], [`text`] | shapes and text on SVG and pixels |
//! | [`mod@palette`] | the colours of the themes |
//! | [`scale`] | linear, logarithmic and cube-root scales |
//!
//! Nothing here opens a file or prints. Text is set in Inter, which is embedded.
#![forbid(unsafe_code)]

#[macro_use]
extern crate gonio_light;

pub mod canvas;
pub mod curves;
pub mod lobe;
pub mod palette;
pub mod pictures;
pub mod polar;
pub mod residuals;
pub mod scale;
pub mod scatter;
pub mod shape;
pub mod text;

pub use canvas::PlotFigure;
pub use palette::palette;
pub use residuals::residuals;
pub use shape::{PlacedPicture, PlotShape, PolarPlace, TextAlign};

use gonio_bsdf::Bsdf;
use gonio_bsdf::sampling::direction;
use gonio_light::DVec3;
use std::fmt;

named_enum! {
    /// A kind of plot.
    pub enum PlotKind {
        /// Values in the plane of incidence as distances from the point
        Polar = "polar",
        /// Values over an angle
        Cartesian = "cartesian",
        /// Values of all directions as a surface
        Lobe = "lobe",
        /// Values over half and difference angle, the image slice of measured BRDFs
        Slice = "slice",
        /// A sphere lit by one light
        Sphere = "sphere",
        /// The share of light that is reflected, over the angle of incidence
        Albedo = "albedo",
        /// The difference when light and viewer change places, over the angle of incidence
        Reciprocity = "reciprocity",
        /// Fresnel factors of the first model that has an index of refraction
        Fresnel = "fresnel",
        /// Directions drawn by importance sampling
        Samples = "samples",
    }
    default Polar;
    what "kind of plot";
}

named_enum! {
    /// The angle along the horizontal axis of a Cartesian plot.
    pub enum PlottedAngle {
        /// Polar angle of the viewer in the plane of incidence, negative on the light's side
        ThetaO = "theta-o",
        /// Azimuth of the viewer relative to the light, at the mirror direction's polar angle
        PhiO = "phi-o",
        /// Polar angle of the light, with the viewer in the mirror direction
        ThetaI = "theta-i",
        /// Half angle, with the difference angle of the incidence
        ThetaH = "theta-h",
        /// Difference angle, with the half vector along the normal
        ThetaD = "theta-d",
    }
    default ThetaO;
    what "angle";
}

named_enum! {
    /// The colours of the paper.
    pub enum PlotTheme {
        /// Dark on white
        Light = "light",
        /// Light on near black
        Dark = "dark",
    }
    default Light;
    what "theme";
}

pub use scale::PlotScale;

/// How to plot.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotSettings {
    /// The kind.
    pub kind: PlotKind,
    /// The angle of incidence in degrees, in `[0, 90)`.
    pub theta_i_deg: f64,
    /// The azimuth of the light in degrees; anisotropic functions depend on it.
    pub phi_i_deg: f64,
    /// The angle of a Cartesian plot.
    pub over: PlottedAngle,
    /// The scale of values.
    pub scale: PlotScale,
    /// Whether values are multiplied by the cosine of the angle of incidence.
    pub with_cosine: bool,
    /// The colours of the paper.
    pub theme: PlotTheme,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The colour of each function, as an index into [`palette::Palette::series`].
    pub series: [usize; MOST_FUNCTIONS],
    /// The view of a lobe in degrees: turned about the normal, and raised above the horizon.
    pub view_deg: [f64; 2],
    /// The largest side of the picture of a lit sphere in pixels. A smaller one takes less time.
    pub most_sphere_pixels: u32,
}

impl Default for PlotSettings {
    fn default() -> Self {
        Self {
            kind: PlotKind::Polar,
            theta_i_deg: 45.0,
            phi_i_deg: 0.0,
            over: PlottedAngle::ThetaO,
            scale: PlotScale::Linear,
            with_cosine: false,
            theme: PlotTheme::Light,
            size: [900, 620],
            series: std::array::from_fn(|index| index),
            view_deg: DEFAULT_VIEW_DEG,
            most_sphere_pixels: 420,
        }
    }
}

impl PlotSettings {
    /// The direction to the light.
    fn light(&self) -> DVec3 {
        direction(self.theta_i_deg.to_radians(), self.phi_i_deg.to_radians())
    }

    /// The factor of the values for a light in this direction.
    fn factor(&self, wi: DVec3) -> f64 {
        if self.with_cosine { wi.z.abs() } else { 1.0 }
    }

    /// The quantity that is plotted, with its unit.
    fn quantity(&self) -> &'static str {
        if self.with_cosine { "f cos (1/sr)" } else { "f (1/sr)" }
    }
}

/// The size of a plot that fits the number of its panels, in pixels.
pub fn default_size(kind: PlotKind, functions: usize) -> [u32; 2] {
    let has_panels = matches!(kind, PlotKind::Lobe | PlotKind::Slice | PlotKind::Sphere | PlotKind::Samples);
    match functions {
        _ if !has_panels => [900, 620],
        0 | 1 => [640, 640],
        2 => [900, 540],
        3 => [900, 400],
        4 => [900, 940],
        _ => [900, 740],
    }
}

/// A function with its label.
#[derive(Clone, Copy)]
pub struct PlottedBsdf<'a> {
    /// The text of the legend.
    pub label: &'a str,
    /// The function.
    pub bsdf: &'a dyn Bsdf,
    /// The index of refraction, if it has one: for [`PlotKind::Fresnel`].
    pub ior: Option<f64>,
}

/// The view of a lobe that shows light and mirror direction side by side.
pub const DEFAULT_VIEW_DEG: [f64; 2] = [-66.0, 22.0];
/// The largest angle of incidence that a window offers, in degrees. At 90 degrees no function has a value.
pub const LARGEST_THETA_DEG: f64 = 89.9;
/// The smallest and the largest side of a plot in pixels.
pub const SIDES: [u32; 2] = [200, 4000];
/// The largest number of functions in one plot: the palette has as many colours.
pub const MOST_FUNCTIONS: usize = 7;

/// A plot that cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlotError {
    /// No function, or more than the palette has colours.
    Functions(usize),
    /// A side beyond [`SIDES`].
    Size([u32; 2]),
    /// An angle of incidence that is not in `[0, 90)`.
    Angle(String),
    /// The function has no value that could be plotted.
    Nothing(String),
    /// No function has an index of refraction above 1.
    NoIndex,
    /// The plotting library failed.
    Drawing(String),
}

impl fmt::Display for PlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Functions(count) => write!(f, "{count} functions in a plot: expected 1 to {MOST_FUNCTIONS}"),
            Self::Size([width, height]) => {
                write!(f, "a plot of {width}x{height} pixels: expected sides from {} to {}", SIDES[0], SIDES[1])
            }
            Self::Angle(angle) => write!(f, "an angle of incidence of {angle} degrees: expected 0 to less than 90"),
            Self::Nothing(label) => write!(f, "`{label}` has no value that could be plotted"),
            Self::NoIndex => write!(f, "no function has an index of refraction above 1, which Fresnel curves need"),
            Self::Drawing(message) => write!(f, "the plot could not be drawn: {message}"),
        }
    }
}

impl std::error::Error for PlotError {}

/// Draws a plot as SVG.
///
/// # Errors
///
/// Settings beyond their ranges, too many functions, or a function without values.
pub fn svg(functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<String, PlotError> {
    figure(functions, settings)?.svg()
}

/// Draws a plot as PNG.
///
/// # Errors
///
/// As [`svg`].
pub fn png(functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<Vec<u8>, PlotError> {
    figure(functions, settings)?.png()
}

/// Computes a plot as shapes, which any painter can draw.
///
/// # Errors
///
/// As [`svg`].
pub fn figure(functions: &[PlottedBsdf<'_>], settings: &PlotSettings) -> Result<PlotFigure, PlotError> {
    if functions.is_empty() || functions.len() > MOST_FUNCTIONS {
        return Err(PlotError::Functions(functions.len()));
    }
    if settings.size.iter().any(|side| !(SIDES[0]..=SIDES[1]).contains(side)) {
        return Err(PlotError::Size(settings.size));
    }
    if !(0.0..90.0).contains(&settings.theta_i_deg) {
        return Err(PlotError::Angle(settings.theta_i_deg.to_string()));
    }
    let mut figure = PlotFigure::new(settings.size, settings.theme);
    let series = figure.palette.series;
    figure.palette.series = settings.series.map(|index| series[index % series.len()]);
    match settings.kind {
        PlotKind::Polar => polar::draw(&mut figure, functions, settings)?,
        PlotKind::Cartesian => curves::values(&mut figure, functions, settings)?,
        PlotKind::Lobe => lobe::draw(&mut figure, functions, settings)?,
        PlotKind::Slice => pictures::slices(&mut figure, functions, settings)?,
        PlotKind::Sphere => pictures::spheres(&mut figure, functions, settings)?,
        PlotKind::Albedo => curves::albedos(&mut figure, functions)?,
        PlotKind::Reciprocity => curves::reciprocity(&mut figure, functions)?,
        PlotKind::Fresnel => curves::fresnel(&mut figure, functions)?,
        PlotKind::Samples => scatter::draw(&mut figure, functions, settings)?,
    }
    Ok(figure)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use gonio_bsdf::ModelSpec;
    use gonio_image::DecodeLimits;

    fn with_functions<T>(specs: &[&str], use_them: impl FnOnce(&[PlottedBsdf<'_>]) -> T) -> T {
        let all: Vec<_> = specs.iter().map(|spec| ModelSpec::parse(spec).unwrap().build()).collect();
        let functions: Vec<_> = specs
            .iter()
            .zip(&all)
            .map(|(label, bsdf)| PlottedBsdf { label, bsdf: bsdf.as_ref(), ior: Some(1.5) })
            .collect();
        use_them(&functions)
    }

    #[test]
    fn no_text_overlaps_and_none_is_cut() {
        let sets: [&[&str]; 4] = [
            &["ggx"],
            &["ward:a=0.3", "rough-dielectric"],
            &[
                "phong-normalised:b=0.123/0.234/0.345,c=123.456",
                "blinn-normalised:c=12.345,a=0.111/0.222/0.333",
                "lambert",
            ],
            &["ggx", "ward", "phong", "blinn", "lafortune", "disney", "cook-torrance"],
        ];
        for kind in PlotKind::ALL {
            for specs in sets {
                for (scale, theta_i_deg) in
                    [(PlotScale::Linear, 45.0), (PlotScale::Log, 0.0), (PlotScale::CubeRoot, 80.0)]
                {
                    for over in PlottedAngle::ALL
                        .iter()
                        .filter(|over| *kind == PlotKind::Cartesian || **over == PlottedAngle::ThetaO)
                    {
                        let settings = PlotSettings {
                            kind: *kind,
                            scale,
                            theta_i_deg,
                            over: *over,
                            size: default_size(*kind, specs.len()),
                            ..PlotSettings::default()
                        };
                        let figure = with_functions(specs, |functions| figure(functions, &settings)).unwrap();
                        let overlaps = figure.text_faults();
                        assert!(
                            overlaps.is_empty(),
                            "{kind} of {} at {theta_i_deg}, {scale}, {over}: {overlaps:?}",
                            specs.len()
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn no_text_overlaps_on_a_phone() {
        for kind in PlotKind::ALL {
            for specs in [&["ggx"][..], &["phong-normalised", "blinn-normalised:c=128", "ward-normalised:c=0.12"]] {
                for over in PlottedAngle::ALL {
                    let settings =
                        PlotSettings { kind: *kind, over: *over, size: [378, 380], ..PlotSettings::default() };
                    let figure = with_functions(specs, |functions| figure(functions, &settings));
                    let overlaps = figure.map(|figure| figure.text_faults());
                    assert_eq!(overlaps, Ok(Vec::new()), "{kind} of {}, {over}", specs.len());
                }
            }
        }
    }

    #[test]
    fn a_function_has_the_colour_that_is_asked_for() {
        let series = std::array::from_fn(|index| (index + 4) % MOST_FUNCTIONS);
        let settings = PlotSettings { kind: PlotKind::Cartesian, series, ..PlotSettings::default() };
        let figure = with_functions(&["lambert"], |functions| figure(functions, &settings)).unwrap();
        let curve = |color: usize| {
            let lines = figure.lines(palette(PlotTheme::Light).series[color]);
            lines.iter().any(|line| line.len() > 1400)
        };
        assert!(curve(4) && !curve(0));
        // An index beyond the palette starts again.
        let settings = PlotSettings { series: [usize::MAX; MOST_FUNCTIONS], ..settings };
        assert!(with_functions(&["lambert"], |functions| super::figure(functions, &settings)).is_ok());
    }

    #[test]
    fn the_half_circle_of_a_polar_plot_is_where_the_curve_ends() {
        let figure = with_functions(&["lambert:a=1"], |functions| figure(functions, &PlotSettings::default())).unwrap();
        let polar = figure.polar.unwrap();
        let lines = figure.lines(figure.palette.series[0]);
        let curve = lines.iter().max_by_key(|line| line.len()).unwrap();
        // 1/pi of 0.4, the value at the rim, in every direction.
        let expected = polar.radius / std::f64::consts::PI / 0.4;
        let distance = |[x, y]: [f64; 2]| (x - polar.center[0]).hypot(y - polar.center[1]);
        assert!(curve.iter().all(|point| (distance(*point) - expected).abs() < 1e-6));
        assert!(polar.theta_i_deg(curve[0]).is_some_and(|angle| angle > 89.0));
    }

    #[test]
    fn a_curve_is_at_its_value() {
        let settings = PlotSettings { kind: PlotKind::Cartesian, ..PlotSettings::default() };
        let figure = with_functions(&["lambert:a=1"], |functions| figure(functions, &settings)).unwrap();
        let lines = figure.lines(figure.palette.series[0]);
        let curve = lines.iter().max_by_key(|line| line.len()).unwrap();
        let frame = figure.lines(figure.palette.ink).into_iter().find(|line| line.len() == 5).unwrap();
        let (top, bottom) = (frame[0][1], frame[2][1]);
        // 1/pi on an axis that ends at 0.4.
        let expected = bottom - (bottom - top) / std::f64::consts::PI / 0.4;
        assert!(curve.len() > 1400 && curve.iter().all(|point| (point[1] - expected).abs() < 1e-9), "{expected}");
        assert!(curve[0][0] >= frame[0][0] && curve[curve.len() - 1][0] <= frame[1][0]);
    }

    #[test]
    fn nothing_is_drawn_below_a_logarithmic_axis() {
        let settings = PlotSettings { kind: PlotKind::Cartesian, scale: PlotScale::Log, ..PlotSettings::default() };
        let figure = with_functions(&["phong:c=200"], |functions| figure(functions, &settings)).unwrap();
        let lines = figure.lines(figure.palette.series[0]);
        let curve = lines.iter().max_by_key(|line| line.len()).unwrap();
        // 0.5 cos^200 is above 1e-5 up to 18.68 degrees from the mirror direction; 8 points are a degree.
        assert_eq!(curve.len(), 299);
    }

    #[test]
    fn both_formats_show_both_themes() {
        for theme in PlotTheme::ALL {
            let settings =
                PlotSettings { kind: PlotKind::Sphere, theme: *theme, size: [300, 320], ..PlotSettings::default() };
            let (svg, png) = with_functions(&["lambert:a=0.8/0.2/0.1"], |functions| {
                (svg(functions, &settings).unwrap(), png(functions, &settings).unwrap())
            });
            assert!(svg.starts_with("<svg width=\"300\" height=\"320\"") && svg.trim_end().ends_with("</svg>"));
            assert!(svg.contains("data:image/png;base64,iVBOR") && svg.contains("lambert:a=0.8/0.2/0.1"));
            let decoded = gonio_image::decode::decode("plot.png", &png, &DecodeLimits::default()).unwrap();
            let gonio_image::decode::DecodedContent::Picture(image) = decoded.shape else { panic!("not a picture") };
            assert_eq!((image.width, image.height), (300, 320));
            let background = f64::from(palette(*theme).background[0]) / 255.0;
            let expected = gonio_light::color::srgb_decode(background);
            assert!((f64::from(image.at(0, 0)[0]) - expected).abs() < 1e-3);
            // The lit side is red.
            let red = image.pixels.iter().filter(|p| p[0] > 0.3 && p[1] < 0.25 && p[2] < 0.15).count();
            assert!(red > 2000, "{red}");
        }
    }

    #[test]
    fn impossible_plots_are_refused() {
        let refused = |settings: PlotSettings| {
            with_functions(&["lambert"], |functions| svg(functions, &settings).unwrap_err().to_string())
        };
        let default = PlotSettings::default;
        assert_eq!(
            refused(PlotSettings { size: [900, 10], ..default() }),
            "a plot of 900x10 pixels: expected sides from 200 to 4000"
        );
        assert_eq!(
            refused(PlotSettings { theta_i_deg: 90.0, ..default() }),
            "an angle of incidence of 90 degrees: expected 0 to less than 90"
        );
        assert!(refused(PlotSettings { theta_i_deg: f64::NAN, ..default() }).contains("NaN"));
        assert_eq!(svg(&[], &default()).unwrap_err(), PlotError::Functions(0));
        // A black surface has no lobe.
        let black = with_functions(&["lambert:a=0"], |functions| {
            svg(functions, &PlotSettings { kind: PlotKind::Lobe, ..default() }).unwrap_err()
        });
        assert_eq!(black.to_string(), "`lambert:a=0` has no value that could be plotted");
        // But it has a slice, and a sphere.
        for kind in [PlotKind::Slice, PlotKind::Sphere, PlotKind::Cartesian] {
            with_functions(&["lambert:a=0"], |functions| svg(functions, &PlotSettings { kind, ..default() })).unwrap();
        }
    }
}
