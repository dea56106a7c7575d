//! A BRDF that belongs to a material: a model with parameters, or a function or table from a file.

use crate::files::{self, FileBytes, FileRefusal, FileSource, OverLimit};
use crate::scene_file::MaterialOverride;
use glam::DVec3;
use gonio_bsdf::integrate::albedo_with_steps;
use gonio_bsdf::merl::FILE_BYTES;
use gonio_bsdf::{
    Bsdf, BsdfSource, GlslBrdfError, MerlError, MerlTable, ModelSpec, NamedBsdf, NamedBsdfError, ParameterKind,
    ParameterValues, embedded_glsl, fit_file, function_lobe, model_spec,
};
use gonio_light::brdf::{LOBE_CAP, SHININESS_MAX, effective_shininess};
use gonio_light::function_light::{self, FunctionLobe};
use gonio_light::{ShadingPoint, Surface};
use gonio_mesh::{Diagnostic, Material, ReadError};
use std::f64::consts::FRAC_1_SQRT_2;
use std::fmt;
use std::io::{Error, ErrorKind};
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// Most bytes of a file. A table has 35 MB; a file up to twice as large is read to say how large it is.
const MOST_BYTES: u64 = 2 * FILE_BYTES as u64;

/// Reads the file of a function.
///
/// # Errors
///
/// As [`FileSource::read_within`]. A file that is too long for every format has a message of its own.
pub fn read_brdf_file(path: &Path, files: &dyn FileSource) -> Result<FileBytes, Error> {
    files.read_within(path, MOST_BYTES).map_err(|error| match FileRefusal::in_error(&error) {
        Some(FileRefusal::OverLimit(OverLimit { needed: Some(bytes), left: MOST_BYTES, .. })) => {
            Error::new(ErrorKind::InvalidData, MerlError::Length { bytes: *bytes as usize })
        }
        _ => error,
    })
}

/// Steps of the quadrature of the albedo: 1.5 degrees, as only a colour is needed.
const ALBEDO_STEPS: u32 = 60;

/// A BRDF in place of a material's colours, exponents and their textures.
pub struct MaterialBrdf {
    /// The notation of the model, or the name of the file.
    pub name: String,
    /// The function, in the local frame.
    pub bsdf: Arc<dyn Bsdf>,
    /// The function as a part of a shader ([`mod@gonio_bsdf::embedded_glsl`]), or why there is none. `None` for a table, and
    /// for a smooth boundary, which is 0 for nearly all directions.
    pub shader: Option<Result<Arc<str>, GlslBrdfError>>,
    /// The table, where the function is one.
    pub table: Option<Arc<MerlTable>>,
    /// The share of light at 45 degrees that is scattered: the material's diffuse colour, which ambient light meets.
    pub albedo: DVec3,
    /// The exponent of the light equation's lobe that is about as wide.
    shininess: f64,
    /// Measured at the first use: only an environment needs it.
    lobe: OnceLock<FunctionLobe>,
}

impl fmt::Debug for MaterialBrdf {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MaterialBrdf").field("name", &self.name).finish_non_exhaustive()
    }
}

/// The same function, and not only an equal one: functions cannot be compared.
impl PartialEq for MaterialBrdf {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.bsdf, &other.bsdf)
    }
}

impl MaterialBrdf {
    /// The BRDF of a model or a file.
    pub fn new(named: NamedBsdf) -> Self {
        let NamedBsdf { name, bsdf, glsl, values, source, .. } = named;
        let table = if let BsdfSource::Table(table) = source { Some(table) } else { None };
        let view = DVec3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
        let albedo = held(albedo_with_steps(bsdf.as_ref(), view, ALBEDO_STEPS), 1.0);
        let shininess = shininess(&values);
        let shader = glsl.map(|text| embedded_glsl(&text, &values).map(Arc::from));
        MaterialBrdf { name, bsdf, shader, table, albedo, shininess, lobe: OnceLock::new() }
    }

    /// `f` in 1/sr, per channel, for light from `l`: at least 0 and at most [`LOBE_CAP`]; 0 where the function has no value.
    /// The frame is that of the point's normal and tangent.
    pub fn evaluate(&self, point: &ShadingPoint, l: DVec3) -> DVec3 {
        let (n, t) = (point.normal, point.tangent);
        let b = n.cross(t);
        let local = |w: DVec3| DVec3::new(t.dot(w), b.dot(w), n.dot(w));
        held(self.bsdf.evaluate(local(l), local(point.view)), LOBE_CAP)
    }

    /// The directions, in the local frame, from which an environment's light is summed.
    pub fn lobe(&self) -> &FunctionLobe {
        self.lobe.get_or_init(|| function_lobe(self.bsdf.as_ref()))
    }

    /// The light of an environment that is reflected to the view, in the frame of the point's normal and tangent. `radiance`
    /// returns the mean over a solid angle about a unit direction in world space; `lights` are directions and irradiances of
    /// small lights besides.
    pub fn environment_light(
        &self,
        point: &ShadingPoint,
        radiance: impl Fn(DVec3, f64) -> DVec3,
        lights: &[(DVec3, DVec3)],
    ) -> DVec3 {
        let (n, t) = (point.normal, point.tangent);
        let b = n.cross(t);
        let local = |w: DVec3| DVec3::new(t.dot(w), b.dot(w), n.dot(w));
        let wo = function_light::raised_view(local(point.view));
        let extended = self.lobe().directions(wo);
        let extended = extended.into_iter().map(|(wi, w)| (wi, w * radiance(t * wi.x + b * wi.y + n * wi.z, w)));
        let small = lights.iter().map(|(direction, irradiance)| (local(*direction), *irradiance));
        let incident: Vec<(DVec3, DVec3)> = extended.chain(small).filter(|(wi, _)| wi.z > 0.0).collect();
        let pairs: Vec<(DVec3, DVec3)> = incident.iter().map(|(wi, _)| (*wi, wo)).collect();
        let values = self.bsdf.evaluate_all(&pairs);
        incident.iter().zip(values).map(|((wi, light), value)| held(value, LOBE_CAP) * wi.z * *light).sum()
    }

    /// Whether it scatters light in single directions only, as a smooth boundary does.
    pub fn is_smooth(&self) -> bool {
        self.shader.is_none() && self.table.is_none()
    }

    /// Whether the function depends on the direction of the tangent.
    pub fn has_direction(&self) -> bool {
        !self.bsdf.is_isotropic()
    }

    /// The material with this BRDF: its colours and their textures are replaced, and normals, opacity and emission stay.
    pub(crate) fn replace(&self, material: &mut Material) {
        material.diffuse = self.albedo.as_vec3().to_array();
        // The light equation multiplies the BRDF by it.
        material.specular = [1.0; 3];
        material.shininess = self.shininess as f32;
        (material.diffuse_map, material.specular_map, material.shininess_map) = (None, None, None);
        material.metallic_roughness = None;
    }
}

/// Each channel from 0 to `most`; NaN counts as 0.
fn held(value: DVec3, most: f64) -> DVec3 {
    value.map(|channel| if channel > 0.0 { channel.min(most) } else { 0.0 })
}

/// The exponent of the light equation's lobe that is about as wide as that of a model with a rough mirror; 1 for other functions.
fn shininess(values: &ParameterValues) -> f64 {
    let value = |name: &str| {
        let is_number = |kind: &ParameterKind| !matches!(kind, ParameterKind::Color { .. });
        values.iter().find(|(p, _)| p.name == name && is_number(&p.kind)).map(|(_, value)| value.x)
    };
    let rough = |alpha: f64| (2.0 / (alpha * alpha).max(1e-6) - 2.0).min(SHININESS_MAX);
    let of_slope = value("alpha").or_else(|| value("m")).map(rough);
    // Ward's slope is at most 1; the exponents of Phong and Blinn are at least 1.
    let exponent = of_slope.or_else(|| value("c").map(|c| if c < 1.0 { rough(c) } else { c }));
    effective_shininess(exponent.unwrap_or(Surface::default().shininess))
}

/// Resolves the path of `FILE` or `FILE:key=value,...` relative to `base`.
pub(crate) fn rebased(base: &Path, text: &str) -> String {
    let (file, settings) = model_spec::split(text);
    let path = files::resolve(base, file).to_string_lossy().into_owned();
    if settings.is_empty() { path } else { format!("{path}:{settings}") }
}

/// The BRDFs of a scene, each once, by the text that names them.
#[derive(Clone, Debug, Default)]
pub(crate) struct BrdfLibrary {
    known: Vec<(Named, Arc<MaterialBrdf>)>,
}

/// How a material names its BRDF.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Named {
    Model(String),
    File(String),
}

impl Named {
    fn of(material: &MaterialOverride) -> Option<Named> {
        let model = material.brdf.clone().map(Named::Model);
        model.or_else(|| material.brdf_file.clone().map(Named::File))
    }
}

impl BrdfLibrary {
    /// The BRDF of a material, if it has one and it was read.
    pub fn find(&self, material: &MaterialOverride) -> Option<&Arc<MaterialBrdf>> {
        let named = Named::of(material)?;
        self.known.iter().find(|(known, _)| *known == named).map(|(_, brdf)| brdf)
    }

    /// Whether the BRDF of a material needs a file that was not read.
    pub fn lacks(&self, material: &MaterialOverride) -> bool {
        material.brdf.is_none() && material.brdf_file.is_some() && self.find(material).is_none()
    }

    /// Makes the BRDF of a material without files: that of a model.
    pub fn add_model(&mut self, material: &MaterialOverride) {
        if let Some(text) = &material.brdf
            && self.find(material).is_none()
            && let Ok(spec) = ModelSpec::parse(text)
        {
            let brdf = Arc::new(MaterialBrdf::new(NamedBsdf::of_model(&spec)));
            self.known.push((Named::Model(text.clone()), brdf));
        }
    }

    /// Makes the BRDF of a material, reading its file relative to `base`; adds warnings about it.
    pub fn add(
        &mut self,
        material: &MaterialOverride,
        base: &Path,
        files: &dyn FileSource,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<(), ReadError> {
        let before = self.known.len();
        self.add_file(material, base, files, diagnostics)?;
        if let Some((_, brdf)) = self.known.get(before).filter(|(_, brdf)| brdf.bsdf.transmits()) {
            let shown = if brdf.is_smooth() { "elsewhere it is black" } else { "elsewhere it only reflects" };
            let message = format!("`{}` transmits light, which the path tracer alone shows; {shown}", brdf.name);
            diagnostics.push(Diagnostic::note(message));
        }
        Ok(())
    }

    fn add_file(
        &mut self,
        material: &MaterialOverride,
        base: &Path,
        files: &dyn FileSource,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<(), ReadError> {
        self.add_model(material);
        let Some(text) = material.brdf_file.as_ref().filter(|_| self.lacks(material)) else { return Ok(()) };
        let (file, settings) = model_spec::split(text);
        let path = files::resolve(base, file);
        let bytes = read_brdf_file(&path, files).map_err(|e| files::failed(&e).in_file(file))?;
        let named = NamedBsdf::of_file(file, &bytes, settings).map_err(|error| read_error(file, error))?;
        diagnostics.extend(named.warnings.iter().map(|warning| Diagnostic::warning(warning.clone()).in_file(file)));
        self.known.push((Named::File(text.clone()), Arc::new(MaterialBrdf::new(named))));
        Ok(())
    }
}

/// The error of a file, with line and column where they are known.
fn read_error(file: &str, error: NamedBsdfError) -> ReadError {
    let (message, place) = match error {
        NamedBsdfError::Brdf(error) => (error.message, Some((error.line, error.column))),
        NamedBsdfError::Fit(fit_file::FitFileError::Toml { message, place }) => (message, place),
        error => (error.to_string(), None),
    };
    let error = ReadError::new(message).in_file(file);
    match place {
        Some((line, column)) => error.at(line.into(), Some(column.into())),
        None => error,
    }
}
