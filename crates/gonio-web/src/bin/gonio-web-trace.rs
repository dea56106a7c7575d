//! The path tracer that the page's worker calls (`web/page/tracer.js`), baking, and the stations beyond the rendering equation: a
//! module of its own, loaded when a pane shows the traced picture, textures are baked or a station is shown. On other targets
//! the program does nothing.

#[cfg(target_arch = "wasm32")]
mod tracer {
    use glam::DVec3;
    use gonio_bake::{BakeJob, BakedAtlas};
    use gonio_light::Simplifications;
    use gonio_mesh::Limits;
    use gonio_scene::edit::{self, Edited};
    use gonio_scene::files::{FileBytes, FileSource, is_builtin, within};
    use gonio_scene::{Camera, Frame, Scene, load, toml_file};
    use gonio_trace::{Refinement, TraceScene, TraceSettings};
    use js_sys::{Array, Float32Array, Object, Reflect, Uint8Array, Uint32Array};
    use std::cell::RefCell;
    use std::collections::BTreeMap;
    use std::io::{Error, ErrorKind};
    use std::path::{Path, PathBuf};
    use std::sync::{Mutex, PoisonError};
    use wasm_bindgen::prelude::*;

    thread_local! {
        // JavaScript's functions belong to a thread, and baking asks for one that any may call; a worker has one.
        static PROGRESS: RefCell<Option<js_sys::Function>> = const { RefCell::new(None) };
    }

    /// A baked atlas as an object.
    fn object_of(atlas: BakedAtlas) -> Result<JsValue, JsValue> {
        let BakedAtlas { uv, report, corners, layout, pictures, files, warnings } = atlas;
        let object = |entries: &[(&str, JsValue)]| -> Result<JsValue, JsValue> {
            let object = Object::new();
            for (name, value) in entries {
                Reflect::set(&object, &(*name).into(), value)?;
            }
            Ok(object.into())
        };
        let list = |items: Vec<Result<JsValue, JsValue>>| items.into_iter().collect::<Result<Array, _>>();
        let bytes = |bytes: &[u8]| JsValue::from(Uint8Array::from(bytes));
        let charts: Vec<u32> = uv.chart_of_triangle.iter().map(|chart| chart.unwrap_or(u32::MAX)).collect();
        let maps = pictures.into_iter().map(|map| {
            object(&[
                ("kind", map.kind.name().into()),
                ("file", map.file.into()),
                ("factor", map.factor.into()),
                ("size", map.picture.width.into()),
                ("rgba", bytes(&map.picture.rgba)),
            ])
        });
        let maps = list(maps.collect())?;
        let files = files.iter().map(|(name, content)| object(&[("name", name.into()), ("bytes", bytes(content))]));
        let report = serde_json::to_string(&report).map_err(|error| JsValue::from_str(&error.to_string()))?;
        object(&[
            ("texCoords", Float32Array::from(uv.tex_coords.as_flattened()).into()),
            ("charts", Uint32Array::from(charts.as_slice()).into()),
            ("chartCount", (uv.chart_count as f64).into()),
            ("margin", uv.margin.into()),
            ("report", report.into()),
            ("corners", Float32Array::from(corners.as_flattened()).into()),
            ("layout", object(&[("size", layout.width.into()), ("rgba", bytes(&layout.rgba))])?),
            ("pictures", maps.into()),
            ("files", list(files.collect())?.into()),
            ("warnings", warnings.into_iter().map(JsValue::from).collect::<Array>().into()),
        ])
    }

    /// The scene's files: the user's by their paths, and built-in ones by their paths below `assets`.
    #[derive(Default)]
    struct WorkerFiles {
        opened: BTreeMap<String, FileBytes>,
        /// `None` for a file that could not be fetched.
        builtin: BTreeMap<String, Option<FileBytes>>,
        /// Built-in files that were asked for and are not here.
        missing: Mutex<Vec<String>>,
    }

    impl FileSource for WorkerFiles {
        fn read_within(&self, path: &Path, most: u64) -> Result<FileBytes, Error> {
            match self.opened.get(&*path.to_string_lossy()) {
                Some(bytes) => within(bytes.clone(), most),
                None => Err(Error::new(ErrorKind::NotFound, "it is not among the opened files")),
            }
        }
        fn list(&self, folder: &Path) -> Vec<PathBuf> {
            let names = self.opened.keys().map(Path::new).filter(|path| path.parent() == Some(folder));
            names.filter_map(|path| path.file_name().map(PathBuf::from)).collect()
        }
        fn builtin(&self, name: &str) -> Option<FileBytes> {
            let known = self.builtin.get(name);
            if known.is_none() && is_builtin(name) {
                self.missing.lock().unwrap_or_else(PoisonError::into_inner).push(name.to_owned());
            }
            known.cloned().flatten()
        }
    }

    /// Traces one picture after the other, or bakes a scene.
    #[wasm_bindgen]
    #[derive(Default)]
    pub struct PageTracer {
        files: WorkerFiles,
        refinement: Option<Refinement>,
        /// The scene to bake, and its time.
        to_bake: Option<(Scene, f64)>,
    }

    #[wasm_bindgen]
    impl PageTracer {
        /// Creates a tracer without files.
        #[wasm_bindgen(constructor)]
        pub fn new() -> PageTracer {
            PageTracer::default()
        }

        /// Adds a built-in file, or notes that it could not be fetched: `name` is its path below `assets`.
        pub fn give(&mut self, name: String, bytes: Option<Vec<u8>>) {
            self.files.builtin.insert(name, bytes.map(FileBytes::from));
        }

        /// Adds a file that the user has opened, by its path.
        pub fn give_opened(&mut self, path: String, bytes: Vec<u8>) {
            self.files.opened.insert(path, FileBytes::from(bytes));
        }

        /// Reads a scene file, for a picture at `time` in seconds. `simplified` is a set of simplifications as a number, `goal` the
        /// relative error to reach. Returns the names of built-in files that are missing: then nothing has begun. An error is one
        /// sentence.
        pub fn open(
            &mut self,
            text: &str,
            time: f64,
            simplified: u16,
            points_per_light: u32,
            goal: f64,
        ) -> Result<Vec<String>, String> {
            self.refinement = None;
            let scene = match self.read_whole(text)? {
                Ok(scene) => scene.at(time),
                Err(missing) => return Ok(missing),
            };
            let settings = TraceSettings {
                simplified: Simplifications::from_bits(simplified),
                points_per_light,
                ..TraceSettings::default()
            };
            // Its camera and size come with `look`.
            let frame = Frame { width: 1, height: 1, ..scene.frame(time) };
            self.refinement = Some(Refinement::new(TraceScene::new(&scene, &frame), settings, goal));
            Ok(Vec::new())
        }

        /// Reads a scene file to bake at `time` in seconds. Returns the names of built-in files that are missing, as
        /// [`PageTracer::open`] does.
        pub fn open_to_bake(&mut self, text: &str, time: f64) -> Result<Vec<String>, String> {
            match self.read_whole(text)? {
                Ok(scene) => self.to_bake = Some((scene, time)),
                Err(missing) => return Ok(missing),
            }
            Ok(Vec::new())
        }

        /// Bakes the scene of [`PageTracer::open_to_bake`]. `job` is a [`BakeJob`] as JSON; the files' names begin with `stem`.
        /// `progress` gets the step at work and the share done. Returns an object, which `bake.rs` of gonio-app reads. An error
        /// is one sentence.
        pub fn bake(&mut self, job: &str, stem: &str, progress: js_sys::Function) -> Result<JsValue, String> {
            let (scene, time) = self.to_bake.take().ok_or("there is no scene to bake")?;
            let job: BakeJob = serde_json::from_str(job).map_err(|error| error.to_string())?;
            PROGRESS.set(Some(progress));
            let report = |step: &str, share: f64| {
                PROGRESS.with_borrow(|progress| {
                    if let Some(progress) = progress {
                        // The page shows what arrives.
                        let _ = progress.call2(&JsValue::NULL, &step.into(), &share.into());
                    }
                });
                true
            };
            let baked = job.run(&scene, time, stem, &report).map_err(|error| error.to_string());
            PROGRESS.set(None);
            object_of(baked?).map_err(|error| format!("{error:?}"))
        }

        /// Reads a scene, or returns the names of built-in files that are missing.
        fn read_whole(&self, text: &str) -> Result<Result<Scene, Vec<String>>, String> {
            let scene = self.read(text);
            let missing = std::mem::take(&mut *self.files.missing.lock().unwrap_or_else(PoisonError::into_inner));
            if missing.is_empty() { Ok(Ok(scene?)) } else { Ok(Err(missing)) }
        }

        fn read(&self, text: &str) -> Result<Scene, String> {
            let file = toml_file::read(text).map_err(|error| error.to_string())?;
            let is_dark = file.lights.is_empty();
            let scene = load::load_within(file, Path::new(""), &self.files, &Limits::default());
            let scene = scene.map_err(|error| error.to_string())?;
            if !is_dark {
                return Ok(scene);
            }
            // Loading adds lights to a scene without any; here the user removed them.
            let mut dark = scene.settings.clone();
            dark.lights.clear();
            match edit::apply(&scene, dark).map_err(|error| error.to_string())? {
                Edited::Done(applied) => Ok(applied.loaded),
                Edited::NeedsFiles(_) => Ok(scene),
            }
        }

        /// Begins a picture of the open scene, of `width` x `height` pixels. `camera`: position, front and up in world space, the
        /// vertical field of view in radians, the near and the far plane. Returns whether there is a scene.
        pub fn look(&mut self, camera: &[f64], width: u32, height: u32) -> bool {
            let (Some(refinement), &[px, py, pz, fx, fy, fz, ux, uy, uz, fov, near, far]) =
                (&mut self.refinement, camera)
            else {
                return false;
            };
            let [position, front, up] = [[px, py, pz], [fx, fy, fz], [ux, uy, uz]].map(DVec3::from);
            refinement.restart(Camera::looking_along(position, front, up, fov, near, far), [width, height]);
            true
        }

        /// Traces the next rows, at most `rows` of them.
        pub fn advance(&mut self, rows: u32) {
            if let Some(refinement) = &mut self.refinement {
                refinement.advance(rows, &|| true);
            }
        }

        /// Paths per pixel; the relative error, or NaN while it is unknown; the share of the pass that is done; and 1 if the error is
        /// below the goal, or else 0.
        pub fn facts(&self) -> Vec<f64> {
            let Some(refinement) = &self.refinement else { return Vec::new() };
            let status = refinement.status();
            vec![status.paths, status.error.unwrap_or(f64::NAN), status.pass, f64::from(u8::from(status.done))]
        }

        /// Follows more paths through a pixel, column and row. Returns both, and the numbers of
        /// [`gonio_trace::PixelContributions::to_numbers`]; nothing if no path is left to follow.
        pub fn probe(&mut self, x: u32, y: u32) -> Vec<f64> {
            let paths = self.refinement.as_mut().and_then(|refinement| refinement.probe([x, y], &|| true));
            let Some(paths) = paths else { return Vec::new() };
            [vec![f64::from(x), f64::from(y)], paths.contributions().to_numbers()].concat()
        }

        /// The picture so far: four values a pixel, linear and premultiplied, the top row first.
        pub fn picture(&self) -> Vec<f32> {
            let picture = self.refinement.as_ref().map(|refinement| refinement.picture().pixels);
            picture.unwrap_or_default().into_iter().flatten().collect()
        }
    }
}

#[cfg(target_arch = "wasm32")]
mod stations {
    use gonio_beyond::{STATIONS, StationDescription, StationResult, StationWork};
    use js_sys::{Function, Object, Reflect, Uint8Array};
    use wasm_bindgen::prelude::*;

    /// Stations, computed one step at a time (`web/page/stations.js`). `stations.rs` of gonio-app reads the results.
    #[wasm_bindgen]
    #[derive(Default)]
    pub struct PageStations(StationWork);

    #[wasm_bindgen]
    impl PageStations {
        /// Nothing is requested.
        #[wasm_bindgen(constructor)]
        pub fn new() -> PageStations {
            PageStations::default()
        }

        /// All stations: [`StationDescription`]s as JSON.
        pub fn list(&self) -> Result<String, String> {
            json(&STATIONS.iter().map(StationDescription::from).collect::<Vec<_>>())
        }

        /// Begins a request, a [`gonio_beyond::StationRequest`] as JSON, at a time in milliseconds.
        pub fn begin(&mut self, request: &str, now: f64) -> Result<(), String> {
            let request = serde_json::from_str(request).map_err(|error| error.to_string())?;
            if self.0.begin(request, now) { Ok(()) } else { Err("there is no such station".to_owned()) }
        }

        /// Whether there is something to show of the request.
        pub fn is_presentable(&self) -> bool {
            self.0.is_presentable()
        }

        /// Works for a moment. `clock` returns milliseconds. Returns an object: whether something is `left` to do, and if there is a new
        /// result, `rgb` with `width`, `height` and `samples`, or `plot`, or `checks`; the last two are JSON.
        pub fn advance(&mut self, clock: &Function) -> Result<JsValue, JsValue> {
            let clock = || clock.call0(&JsValue::NULL).ok().and_then(|now| now.as_f64()).unwrap_or_default();
            let (result, is_left) = self.0.advance(&clock, &|| true);
            let object = Object::new();
            let set = |name: &str, value: JsValue| Reflect::set(&object, &name.into(), &value).map(drop);
            set("left", is_left.into())?;
            match result {
                Some(StationResult::Picture(picture)) => {
                    set("width", picture.size[0].into())?;
                    set("height", picture.size[1].into())?;
                    set("samples", picture.samples.into())?;
                    set("rgb", Uint8Array::from(picture.rgb.as_slice()).into())?;
                }
                Some(StationResult::Plot(plot)) => set("plot", json(&plot)?.into())?,
                Some(StationResult::Checks(checks)) => set("checks", json(&checks)?.into())?,
                None => {}
            }
            Ok(object.into())
        }
    }

    fn json(value: &impl serde::Serialize) -> Result<String, String> {
        serde_json::to_string(value).map_err(|error| error.to_string())
    }
}

fn main() {}
