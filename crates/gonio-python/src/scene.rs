//! A scene: pictures of it, the equation at a pixel, traced light.

use crate::draw::{Drawn, DrawnPictures};
use crate::error::{Failure, hint, without_lock};
use crate::picture::NativePicture;
use crate::session::{DrawingThread, NativeSession};
use crate::{json, options};
use gonio_light::Quantity;
use gonio_mesh::{Diagnostic, Limits, Severity};
use gonio_reference::ReferenceScene;
use gonio_scene::files::{Disk, FileSource, Sandbox};
use gonio_scene::{DisplayMap, Frame, Picture, Scene, ViewSpec, load};
use gonio_trace::{Film, Simplification, Simplifications, TraceScene, TraceSettings};
use pyo3::prelude::*;
use serde_json::{Map, Value};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// A loaded scene.
#[pyclass(frozen, module = "gonio._native")]
pub struct NativeScene {
    session: Arc<DrawingThread>,
    number: u64,
    scene: Arc<Scene>,
    /// For the CPU, at the time with these bits: the moment that was drawn last.
    reference: Mutex<Option<(u64, Arc<ReferenceScene>)>>,
}

/// Limits on what files may make gonio allocate.
fn limits(max_memory: Option<u64>, max_triangles: Option<u64>) -> Limits {
    let usual = Limits::default();
    Limits {
        max_triangles: max_triangles.map_or(usual.max_triangles, |most| most.min(usual.max_triangles)),
        max_bytes: max_memory.unwrap_or(usual.max_bytes),
        ..usual
    }
}

/// The disk, or only the folders of the files that the user names.
fn files(named: &[&str], sandbox: bool) -> Box<dyn FileSource> {
    if sandbox { Box::new(Sandbox::new(Disk, named.iter().copied())) } else { Box::new(Disk) }
}

/// The file or the name of an environment that the user gives.
fn environments(options: &Map<String, Value>) -> impl Iterator<Item = &str> {
    let value = options.get("environment");
    let of_table = value.into_iter().flat_map(|table| ["image", "background"].map(|key| table.get(key)));
    value.into_iter().chain(of_table.flatten()).filter_map(Value::as_str)
}

#[pymethods]
impl NativeScene {
    /// Loads what `inputs` name, with `options` (JSON) in place of its own values.
    #[staticmethod]
    #[pyo3(signature = (session, inputs, options, sandbox, max_memory, max_triangles))]
    fn load(
        py: Python<'_>,
        session: &NativeSession,
        inputs: Vec<String>,
        options: &str,
        sandbox: bool,
        max_memory: Option<u64>,
        max_triangles: Option<u64>,
    ) -> PyResult<Self> {
        let session = session.shared();
        without_lock(py, || {
            session.check_process()?;
            let options: Map<String, Value> = serde_json::from_str(options).map_err(Failure::new)?;
            let inputs: Vec<&str> = inputs.iter().map(String::as_str).collect();
            let named: Vec<&str> = inputs.iter().copied().chain(environments(&options)).collect();
            let files = files(&named, sandbox);
            let mut file = load::describe(&inputs, &files)?;
            options::apply(&mut file, options)?;
            let limits = limits(max_memory, max_triangles);
            // Paths in the scene are relative to the current folder.
            let scene = Arc::new(load::load_within(file, Path::new(""), &files, &limits)?);
            Ok(NativeScene { number: session.new_scene(), session, scene, reference: Mutex::default() })
        })
    }

    /// Sentences about what was odd in the files, each with whether it is a warning and not only a note.
    fn diagnostics(&self) -> Vec<(bool, String)> {
        let one = |diagnostic: &Diagnostic| {
            let text = format!("{}{}{}", diagnostic.place, diagnostic.message, hint(diagnostic.cause));
            (diagnostic.severity == Severity::Warning, text)
        };
        self.scene.diagnostics.iter().map(one).collect()
    }

    /// The complete scene file, as JSON.
    fn settings(&self) -> PyResult<String> {
        json(&gonio_scene::SceneFile::from(&self.scene.settings))
    }

    /// The numbers of objects, triangles, vertices, materials, textures and lights.
    fn counts(&self) -> [(&'static str, usize); 6] {
        let scene = &self.scene;
        let meshes = || scene.objects.iter().filter_map(|object| scene.meshes.get(object.mesh));
        [
            ("objects", scene.objects.len()),
            ("triangles", meshes().map(|mesh| mesh.triangle_count()).sum()),
            ("vertices", meshes().map(|mesh| mesh.positions.len()).sum()),
            ("materials", scene.materials.len()),
            ("textures", scene.textures.len()),
            ("lights", scene.settings.lights.len()),
        ]
    }

    /// Draws views: `""` is the picture, others are names of quantities. Returns the pictures, a sentence about what drew them, and
    /// notes.
    #[pyo3(signature = (views, size, samples, time, backend))]
    fn draw(
        &self,
        py: Python<'_>,
        views: Vec<String>,
        size: Option<(u32, u32)>,
        samples: Option<u32>,
        time: f64,
        backend: &str,
    ) -> PyResult<(Vec<NativePicture>, String, Vec<String>)> {
        let (pictures, maps, by) = without_lock(py, || {
            self.session.check_process()?;
            let views = self.views(&views)?;
            let frame = self.frame(size, samples, time)?;
            let maps: Vec<DisplayMap> = views.iter().map(|view| DisplayMap::for_view(*view, &frame)).collect();
            let (pictures, by) = self.draw_by(backend, frame, views)?;
            Ok((pictures, maps, by))
        })?;
        let both = pictures.pictures.into_iter().zip(maps);
        let natives = both.map(|(picture, map)| NativePicture::new(py, picture, map)).collect::<PyResult<Vec<_>>>()?;
        Ok((natives, by, pictures.notes))
    }

    /// The light equation at a pixel, as JSON: `null` where no surface is seen; and the pixel's linear RGBA.
    #[pyo3(signature = (x, y, size, time))]
    fn probe(
        &self,
        py: Python<'_>,
        x: i64,
        y: i64,
        size: Option<(u32, u32)>,
        time: f64,
    ) -> PyResult<(String, [f64; 4])> {
        let (probe, value) = without_lock(py, || {
            self.session.check_process()?;
            let frame = self.frame(size, Some(1), time)?;
            let (width, height) = (frame.width, frame.height);
            let pixel = u32::try_from(x).ok().zip(u32::try_from(y).ok());
            let Some((x, y)) = pixel.filter(|&(x, y)| x < width && y < height) else {
                return Err(Failure(format!(
                    "pixel {x},{y} is outside the picture of {width}x{height} pixels: columns 0 to {}, rows 0 to {}",
                    width - 1,
                    height - 1
                )));
            };
            let reference = self.reference(time);
            let probe = reference.probe(&frame, x, y);
            let value = probe.as_ref().map_or_else(|| reference.behind(&frame, x, y), |probe| probe.total.to_array());
            Ok((probe, value))
        })?;
        Ok((json(&probe)?, value))
    }

    /// Traces paths of light. Returns the picture, the variance of each pixel's luminance, the error relative to the mean luminance,
    /// and notes.
    #[pyo3(signature = (samples, seed, max_depth, rgb, denoise, size, time))]
    #[expect(clippy::too_many_arguments, reason = "they are keyword arguments in Python")]
    fn trace(
        &self,
        py: Python<'_>,
        samples: u32,
        seed: u64,
        max_depth: u32,
        rgb: bool,
        denoise: bool,
        size: Option<(u32, u32)>,
        time: f64,
    ) -> PyResult<(NativePicture, NativePicture, f64, Vec<String>)> {
        if samples == 0 || max_depth == 0 {
            return Err(Failure::new("samples and max_depth must be at least 1").into());
        }
        if denoise && samples < LEAST_DENOISED {
            let message = format!("denoise=True needs samples of at least {LEAST_DENOISED} to tell noise from light");
            return Err(Failure(message).into());
        }
        let (ready, settings) = without_lock(py, || {
            self.session.check_process()?;
            let scene = self.scene.at(time);
            let ready = TraceScene::new(&scene, &self.frame(size, None, time)?);
            let mut settings = TraceSettings { seed, most_depth: max_depth, ..TraceSettings::default() };
            if rgb {
                settings.simplified = Simplifications::NONE.with(Simplification::Wavelengths);
            }
            Ok((ready, settings))
        })?;
        let mut film = Film::new(ready.frame().width, ready.frame().height);
        while film.least_samples() < samples {
            // Ctrl-C between two passes, which take a fraction of a second each.
            py.check_signals()?;
            let pass = (samples - film.least_samples()).min(pass_of(&film));
            film = without_lock(py, || {
                let mut film = film;
                ready.add_samples(&mut film, &settings, pass, None, &|_| true);
                Ok(film)
            })?;
        }
        let (picture, variance, error, notes) = without_lock(py, || {
            let mut notes: Vec<String> = ready.oddities().iter().map(ToString::to_string).collect();
            if film.lost_samples() > 0 {
                notes.push(format!(
                    "{} of {} paths were not finite and count as black; the materials or lights are too bright for 32-bit \
                     floats",
                    film.lost_samples(),
                    film.total_samples()
                ));
            }
            let variance: Vec<[f32; 4]> = film.variance().iter().map(|v| [*v as f32; 4]).collect();
            let variance = Picture { width: film.width, height: film.height, pixels: variance };
            let picture =
                if denoise { film.denoised(&ready.features(&settings, FEATURE_SAMPLES)) } else { film.picture() };
            Ok((picture, variance, film.error().relative, notes))
        })?;
        let map = DisplayMap::for_view(None, ready.frame());
        Ok((NativePicture::new(py, picture, map)?, NativePicture::new(py, variance, map)?, error, notes))
    }
}

/// Paths without which the noise of a pixel is not known.
const LEAST_DENOISED: u32 = 4;
/// Points of a pixel at which its surfaces are looked at for the filter.
const FEATURE_SAMPLES: u32 = 64;
/// Paths of one pass.
const PASS: u64 = 300_000;

fn pass_of(film: &Film) -> u32 {
    let pixels = (u64::from(film.width) * u64::from(film.height)).max(1);
    u32::try_from(PASS / pixels).unwrap_or(u32::MAX).max(1)
}

impl NativeScene {
    /// The views of these names, whose lights exist.
    fn views(&self, names: &[String]) -> Result<Vec<Option<ViewSpec>>, Failure> {
        let lights = self.scene.settings.lights.len();
        let view = |name: &String| {
            if name.is_empty() {
                return Ok(None);
            }
            let view: ViewSpec = name.parse().map_err(Failure)?;
            match view.light {
                Some(light) if light >= lights => {
                    Err(Failure(format!("`{view}`: there is no light {light}; the scene has {lights}, counted from 0")))
                }
                _ => Ok(Some(view)),
            }
        };
        names.iter().map(view).collect()
    }

    /// The frame at `time`, in another size of the same shape, or with other samples, if they are given.
    fn frame(&self, size: Option<(u32, u32)>, samples: Option<u32>, time: f64) -> Result<Frame, Failure> {
        if !time.is_finite() {
            return Err(Failure(format!("invalid time {time}: expected a number of seconds")));
        }
        let mut frame = self.scene.frame(time);
        if let Some((width, height)) = size {
            (frame.width, frame.height) = (width, height);
        }
        frame.samples = samples.unwrap_or(frame.samples);
        Ok(frame)
    }

    /// The scene for the CPU at `time`.
    fn reference(&self, time: f64) -> Arc<ReferenceScene> {
        let mut kept = self.reference.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((bits, reference)) if *bits == time.to_bits() => reference.clone(),
            _ => {
                let reference = Arc::new(ReferenceScene::new(&self.scene.at(time)));
                *kept = Some((time.to_bits(), reference.clone()));
                reference
            }
        }
    }

    fn draw_by(
        &self,
        backend: &str,
        frame: Frame,
        views: Vec<Option<ViewSpec>>,
    ) -> Result<(DrawnPictures, String), Failure> {
        if backend == "cpu" {
            return Ok((self.draw_on_cpu(&frame, &views), "the CPU reference".to_owned()));
        }
        if !matches!(backend, "auto" | "gl") {
            return Err(Failure(format!("invalid backend `{backend}`: expected \"auto\", \"gl\" or \"cpu\"")));
        }
        let drawn = Drawn { number: self.number, scene: self.scene.clone(), frame, views };
        let drawing = self.session.run(move |drawer| match drawer.open_for(drawn.frame.width, drawn.frame.height) {
            Ok(()) => Ok(Ok((drawer.draw(&drawn)?, format!("OpenGL ({})", drawer.driver())))),
            Err(reason) => Ok(Err((reason.0, drawn))),
        })?;
        match drawing {
            Ok(done) => Ok(done),
            Err((reason, _)) if backend == "gl" => Err(Failure(format!("{reason}; backend=\"cpu\" needs no OpenGL"))),
            Err((reason, drawn)) => {
                Ok((self.draw_on_cpu(&drawn.frame, &drawn.views), format!("the CPU reference: {reason}")))
            }
        }
    }

    fn draw_on_cpu(&self, frame: &Frame, views: &[Option<ViewSpec>]) -> DrawnPictures {
        let total = ViewSpec { quantity: Quantity::Total, light: None };
        let views: Vec<ViewSpec> = views.iter().map(|view| view.unwrap_or(total)).collect();
        let rendered = self.reference(frame.time).views(frame, &views, &|_| {});
        DrawnPictures { pictures: rendered.into_iter().map(|r| r.picture).collect(), notes: Vec::new() }
    }
}

impl Drop for NativeScene {
    fn drop(&mut self) {
        self.session.forget(self.number);
    }
}

/// What a model's file contains, as JSON.
#[pyfunction]
#[pyo3(signature = (input, sandbox, max_memory, max_triangles))]
pub fn inspect(
    py: Python<'_>,
    input: &str,
    sandbox: bool,
    max_memory: Option<u64>,
    max_triangles: Option<u64>,
) -> PyResult<String> {
    let found = without_lock(py, || {
        let files = files(&[input], sandbox);
        Ok(gonio_scene::inspect::inspect(input, &files, &limits(max_memory, max_triangles))?)
    })?;
    json(&found)
}

/// The names of all quantities that can be drawn.
#[pyfunction]
pub fn view_names() -> Vec<&'static str> {
    Quantity::ALL.iter().map(|quantity| quantity.name()).collect()
}
