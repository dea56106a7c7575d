//! A BSDF with its name: a model, a `.brdf` or `.glsl` file, a MERL table, or a file of fits.

use crate::bsdf::{Bsdf, mean};
use crate::explorer::{self, BrdfFile};
use crate::fit_file::{self, FitFileError};
use crate::glsl::{GlslBrdf, GlslBrdfError};
use crate::merl::{MerlError, MerlTable};
use crate::model_spec::{ModelSpec, ModelSpecError, set_all};
use crate::models::BsdfModel;
use crate::parameter::ParameterValues;
use crate::sampling::direction;
use std::fmt;
use std::fmt::Write as _;
use std::sync::Arc;

/// Where a function comes from, to make it again with other values.
#[derive(Clone, Debug)]
pub enum BsdfSource {
    /// A model.
    Model(&'static BsdfModel),
    /// A compiled GLSL function.
    Glsl(GlslBrdf),
    /// A measured table, which has no parameters.
    Table(Arc<MerlTable>),
}

/// A function to plot, check or export.
#[derive(Clone)]
pub struct NamedBsdf {
    /// The notation of the model, or the name of the file.
    pub name: String,
    /// One line about it.
    pub title: String,
    /// The function.
    pub bsdf: Arc<dyn Bsdf>,
    /// Where it comes from.
    pub source: BsdfSource,
    /// The text of its GLSL function, if it has one.
    pub glsl: Option<String>,
    /// Its parameters; a table has none.
    pub values: ParameterValues,
    /// Oddities of its file.
    pub warnings: Vec<String>,
}

impl fmt::Debug for NamedBsdf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NamedBsdf").field("name", &self.name).finish_non_exhaustive()
    }
}

/// A file that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamedBsdfError {
    /// A `.brdf` file with an error.
    Brdf(GlslBrdfError),
    /// A MERL file with an error.
    Merl(MerlError),
    /// A file of fits with an error.
    Fit(FitFileError),
    /// Settings that the file does not have.
    Settings(ModelSpecError),
    /// Bytes of neither format.
    UnknownFormat,
}

impl fmt::Display for NamedBsdfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Brdf(error) => error.fmt(f),
            Self::Merl(error) => error.fmt(f),
            Self::Fit(error) => error.fmt(f),
            Self::Settings(error) => error.fmt(f),
            Self::UnknownFormat => {
                write!(
                    f,
                    "unknown format: expected a MERL .binary, a .brdf file of BRDF Explorer, a .glsl function, or a .toml of fits"
                )
            }
        }
    }
}

impl std::error::Error for NamedBsdfError {}

impl NamedBsdf {
    /// A model.
    pub fn of_model(spec: &ModelSpec) -> Self {
        Self {
            name: spec.text(),
            title: spec.model.title.to_owned(),
            bsdf: spec.build().into(),
            source: BsdfSource::Model(spec.model),
            glsl: spec.model.glsl.map(str::to_owned),
            values: spec.values.clone(),
            warnings: Vec::new(),
        }
    }

    /// A MERL table.
    pub fn of_table(name: &str, table: MerlTable) -> Self {
        let warnings = table.scale_warning().into_iter().collect();
        let table = Arc::new(table);
        Self {
            name: name.to_owned(),
            title: format!("measured BRDF, {:.1} % of the values are missing", missing_percent(&table)),
            bsdf: table.clone(),
            source: BsdfSource::Table(table),
            glsl: None,
            values: ParameterValues::defaults(Vec::new()),
            warnings,
        }
    }

    fn of_glsl(name: &str, title: &str, text: String, bsdf: GlslBrdf) -> Self {
        Self {
            name: name.to_owned(),
            title: title.to_owned(),
            values: bsdf.values().clone(),
            source: BsdfSource::Glsl(bsdf.clone()),
            bsdf: Arc::new(bsdf),
            glsl: Some(text),
            warnings: Vec::new(),
        }
    }

    /// The same function with other values of its parameters. The text of a file is not read again.
    ///
    /// # Errors
    ///
    /// A loop of a GLSL function that does not end for these values.
    pub fn with_values(&self, values: ParameterValues) -> Result<Self, GlslBrdfError> {
        match &self.source {
            BsdfSource::Model(model) => {
                let spec = ModelSpec { model, values };
                // The name of a fit begins with that of its file.
                let is_model = self.name.split(':').next() == Some(model.name);
                let made = Self::of_model(&spec);
                Ok(if is_model { made } else { Self { name: self.name.clone(), ..made } })
            }
            BsdfSource::Glsl(brdf) => {
                let brdf = brdf.with_values(values.clone())?;
                Ok(Self { bsdf: Arc::new(brdf.clone()), source: BsdfSource::Glsl(brdf), values, ..self.clone() })
            }
            BsdfSource::Table(_) => Ok(self.clone()),
        }
    }

    /// The index of refraction that its parameters `ior` or `f0` state; `f0` of a dielectric is `((n - 1) / (n + 1))^2`.
    pub fn refraction_index(&self) -> Option<f64> {
        let has = |name: &str| self.values.parameters().iter().any(|parameter| parameter.name == name);
        if has("ior") {
            return Some(self.values.number("ior"));
        }
        let root = mean(self.values.color("f0")).max(0.0).sqrt();
        (has("f0") && root < 1.0).then(|| (1.0 + root) / (1.0 - root))
    }

    /// A file, with `key=value,...` for its parameters. The format is recognised by the content; `name` may say that a
    /// damaged file is meant as `.brdf` or `.binary`.
    ///
    /// # Errors
    ///
    /// A file of neither format, or with an error; settings that it does not have.
    pub fn of_file(name: &str, bytes: &[u8], settings: &str) -> Result<Self, NamedBsdfError> {
        let ends_with = |end: &str| name.len() >= end.len() && name.to_ascii_lowercase().ends_with(end);
        let text = std::str::from_utf8(bytes).ok();
        let is_brdf = text.is_some_and(|text| text.trim_start_matches('\u{feff}').starts_with("analytic"));
        if is_brdf || ends_with(".brdf") {
            let Some(text) = text else {
                let message = "the file is not text in UTF-8".to_owned();
                return Err(NamedBsdfError::Brdf(GlslBrdfError { line: 1, column: 1, message }));
            };
            let file = BrdfFile::parse(text).map_err(NamedBsdfError::Brdf)?;
            let mut values = file.defaults();
            set_all(&mut values, settings).map_err(NamedBsdfError::Settings)?;
            let bsdf = file.compile(values).map_err(NamedBsdfError::Brdf)?;
            return Ok(Self::of_glsl(name, "GLSL function of a .brdf file", file.shader, bsdf));
        }
        let header = [90_i32, 90, 180].map(i32::to_le_bytes).concat();
        if ends_with(".binary") || bytes.starts_with(&header) {
            let table = MerlTable::read(bytes).map_err(NamedBsdfError::Merl)?;
            set_all(&mut ParameterValues::defaults(Vec::new()), settings).map_err(NamedBsdfError::Settings)?;
            return Ok(Self::of_table(name, table));
        }
        if let Some(text) = text.filter(|_| ends_with(".glsl")) {
            let mut values = ParameterValues::defaults(Vec::new());
            set_all(&mut values, settings).map_err(NamedBsdfError::Settings)?;
            let bsdf = GlslBrdf::new(text, 1, values).map_err(NamedBsdfError::Brdf)?;
            return Ok(Self::of_glsl(name, "GLSL function", text.to_owned(), bsdf));
        }
        if let Some(text) = text.filter(|_| ends_with(".toml")) {
            let mut fits = fit_file::read(text).map_err(NamedBsdfError::Fit)?;
            let mut best = fits.swap_remove(0);
            set_all(&mut best.values, settings).map_err(NamedBsdfError::Settings)?;
            return Ok(Self { name: format!("{name}: {}", best.model.name), ..Self::of_model(&best) });
        }
        Err(NamedBsdfError::UnknownFormat)
    }

    /// The text of a `.brdf` file, if there is a GLSL function.
    pub fn to_brdf(&self) -> Option<String> {
        self.glsl.as_ref().map(|shader| explorer::write(&self.title, shader, &self.values))
    }

    /// The text of a GLSL function with the parameters as constants, if there is one.
    pub fn to_glsl(&self) -> Option<String> {
        self.glsl.as_ref().map(|shader| explorer::write_glsl(&self.name, shader, &self.values))
    }

    /// A table as comma-separated values: polar angles every 5 degrees, differences of azimuth every 15.
    pub fn to_csv(&self) -> String {
        let mut text = "theta_i_deg,theta_o_deg,phi_deg,f_red,f_green,f_blue\n".to_owned();
        let last = if self.bsdf.transmits() { 36 } else { 17 };
        for i in 0..=last {
            let mut rows = Vec::new();
            let mut pairs = Vec::new();
            for o in 0..=last {
                for azimuth in 0..=12 {
                    let [theta_i, theta_o, phi] = [5 * i, 5 * o, 15 * azimuth];
                    let radians = |degrees: i32| f64::from(degrees).to_radians();
                    rows.push([theta_i, theta_o, phi]);
                    pairs.push((direction(radians(theta_i), 0.0), direction(radians(theta_o), radians(phi))));
                }
            }
            for ([theta_i, theta_o, phi], f) in rows.iter().zip(self.bsdf.evaluate_all(&pairs)) {
                // Writing to a String does not fail.
                let _ = writeln!(text, "{theta_i},{theta_o},{phi},{:.6e},{:.6e},{:.6e}", f.x, f.y, f.z);
            }
        }
        text
    }
}

/// The share of missing values in percent.
fn missing_percent(table: &MerlTable) -> f64 {
    100.0 * table.missing() as f64 / (3 * crate::merl::CELLS) as f64
}
