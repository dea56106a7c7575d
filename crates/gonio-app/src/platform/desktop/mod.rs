//! The desktop: a window of its own, files on disk.

pub(super) mod bake;
pub(super) mod capture;
mod check;
pub mod child;
mod dialog;
mod drafts;
mod fonts;
mod open;
pub(super) mod stations;
mod storage;
pub(super) mod trace;
pub mod trial;
mod watch;
pub mod worker;

use super::{
    CheckRequest, CheckResult, Event, FileDialog, FontSearch, Pending, Platform, Purpose, Ready, TrialOutcome,
};
use crate::exercise::Start;
use crate::files::ShaderFiles;
use crate::files::link::StationLink;
use crate::saving::Product;
use crate::session::Settings;
use crate::{Adjust, App, SceneOpening};
use drafts::DraftFolder;
use fonts::SystemFonts;
use gonio_bsdf::NamedBsdf;
use gonio_gl::Gl;
use gonio_language::{Language, tr};
use gonio_mesh::Limits;
use gonio_scene::files::{BUILTIN, DiskAndInput, FileSource, Sandbox};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use watch::Watcher;

/// A pool of threads for work beside the interface, to which it leaves a core; `None` if the system refuses it.
fn thread_pool() -> Option<rayon::ThreadPool> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build().ok()
}

/// Options of `gonio view`.
#[derive(Default)]
pub struct WindowOptions {
    /// Models and scenes; empty for the first sample.
    pub inputs: Vec<String>,
    /// Size of the window, points.
    pub size: Option<[f32; 2]>,
    /// Changes to the scene file of the inputs.
    pub adjust: Option<Adjust>,
    /// Limits on memory that files may claim.
    pub limits: Limits,
    /// Environments that `adjust` adds to the inputs; they are files that the user names too.
    pub environments: Vec<String>,
    /// Restrict reading to the folders of the files that the user names.
    pub sandbox: bool,
    /// A file that the state is written to after every frame ([`crate::exported`]), for tests.
    pub state: Option<PathBuf>,
    /// gonio's own program, which runs checks in separate processes. Without it there are no checks.
    pub program: Option<PathBuf>,
    /// The user's own shaders, which draw the scene.
    pub shaders: Option<ShaderFiles>,
    /// The language of the window; without it, the one that its user selected, or the current one.
    pub language: Option<Language>,
    /// An exercise to open at the start.
    pub exercise: Option<Start>,
    /// Functions on the BRDF bench, which is opened at the start; without any, those of a new bench.
    pub bench: Option<Vec<NamedBsdf>>,
    /// A station beyond the rendering equation to open at the start.
    pub station: Option<StationLink>,
}

/// Opens the window, and returns when it is closed. An error is one sentence: no display, no OpenGL.
pub fn run(options: WindowOptions) -> Result<(), String> {
    run_within(options, |app, _| Box::new(app))
}

/// [`run`] with a wrapper around the application and its OpenGL, for measurements.
pub fn run_within(
    options: WindowOptions,
    around: impl FnOnce(App, Option<Gl>) -> Box<dyn eframe::App> + 'static,
) -> Result<(), String> {
    check_display()?;
    let [width, height] = options.size.unwrap_or([1280.0, 800.0]);
    let viewport = egui::ViewportBuilder::default()
        .with_title("gonio")
        .with_app_id("gonio")
        .with_inner_size([width, height])
        .with_min_inner_size([320.0, 420.0]);
    let native = eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Glow,
        // Flat colours need no dithering, and software drivers would compute noise for each pixel.
        dithering: false,
        // gonio asks for the system's fonts when it needs them: `fonts`.
        system_font_fallback: false,
        ..Default::default()
    };
    let access = Access { max_bytes: options.limits.max_bytes, sandbox: options.sandbox };
    let shaders = options.shaders.iter().flat_map(ShaderFiles::named);
    let named: Vec<String> = options.inputs.iter().chain(&options.environments).chain(shaders).cloned().collect();
    let created = move |creation: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        let gl = creation.gl.clone().map(Gl::of_window);
        gonio_gl::capture::hide_overlay();
        let opening = SceneOpening {
            inputs: options.inputs,
            adjust: options.adjust,
            limits: options.limits,
            shaders: options.shaders,
            ..SceneOpening::default()
        };
        let mut platform = Box::new(Desktop::new(options.state, options.program, access, &named));
        platform.language = options.language;
        let mut app = App::with_options(&creation.egui_ctx, gl.clone(), platform, opening);
        if let Some(start) = options.exercise {
            app.begin_exercise(&creation.egui_ctx, start);
        }
        if let Some(functions) = options.bench {
            app.begin_bench(functions);
        }
        if let Some(station) = options.station {
            app.begin_stations(station);
        }
        Ok(around(app, gl))
    };
    eframe::run_native("gonio", native, Box::new(created)).map_err(window_error)
}

/// Stack of a thread that reads shaders: the parser recurses along deeply nested expressions.
const STACK_BYTES: usize = 32 << 20;

/// Restrictions on reading files.
#[derive(Clone, Copy)]
pub(super) struct Access {
    /// Most bytes of a file, and of all files of a zip.
    max_bytes: u64,
    /// Whether reading is restricted to the folders of the files that the user names.
    sandbox: bool,
}

struct Desktop {
    files: Arc<dyn FileSource>,
    access: Access,
    sender: Sender<Event>,
    receiver: Receiver<Event>,
    watcher: Option<Watcher>,
    state: Option<PathBuf>,
    program: Option<PathBuf>,
    drafts: Option<DraftFolder>,
    fonts: SystemFonts,
    /// The language that the options ask for.
    language: Option<Language>,
}

impl Desktop {
    fn new(state: Option<PathBuf>, program: Option<PathBuf>, access: Access, named: &[String]) -> Self {
        let (sender, receiver) = channel();
        let disk = DiskAndInput::new(named.iter().map(String::as_str));
        let files: Arc<dyn FileSource> = if access.sandbox {
            Arc::new(Sandbox::new(disk, named.iter().map(String::as_str)))
        } else {
            Arc::new(disk)
        };
        let drafts = storage::drafts_folder().map(DraftFolder::new);
        Desktop {
            files,
            access,
            sender,
            receiver,
            watcher: None,
            state,
            program,
            drafts,
            fonts: SystemFonts::default(),
            language: None,
        }
    }
}

impl Platform for Desktop {
    fn asked_language(&self) -> Option<Language> {
        self.language
    }

    fn files(&self) -> Arc<dyn FileSource> {
        self.files.clone()
    }

    fn choose_files(&mut self, purpose: Purpose, ctx: &egui::Context) -> FileDialog {
        dialog::open(purpose, self.access, self.sender.clone(), ctx)
    }

    fn open_paths(&mut self, paths: Vec<String>, purpose: Purpose, ctx: &egui::Context) {
        open::in_thread(paths, purpose, self.access, self.sender.clone(), ctx);
    }

    fn choose_place(&mut self, product: Product, name: &str, ctx: &egui::Context) -> FileDialog {
        dialog::save(product, name, self.sender.clone(), ctx)
    }

    fn poll(&mut self, purpose: Purpose, ctx: &egui::Context) -> Vec<Event> {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        if !dropped.is_empty() {
            let paths = dropped.iter().map(|file| file.path().to_string_lossy().into_owned()).collect();
            self.open_paths(paths, purpose, ctx);
        }
        self.receiver.try_iter().collect()
    }

    fn write(&mut self, place: &str, bytes: &[u8]) -> Result<String, String> {
        storage::write_atomically(Path::new(place), bytes).map(|()| place.to_owned())
    }

    fn link(&self, fragment: &str) -> String {
        format!("#{fragment}")
    }

    fn watch(&mut self, paths: Vec<PathBuf>, ctx: &egui::Context) {
        let sender = self.sender.clone();
        self.watcher.get_or_insert_with(|| Watcher::start(sender, ctx.clone())).set(paths);
    }

    fn lasting(&self, input: &str) -> Option<String> {
        if input.starts_with(BUILTIN) {
            return None;
        }
        let path = std::path::absolute(input).ok()?;
        path.is_file().then(|| path.to_string_lossy().into_owned())
    }

    fn find_fonts(&mut self, characters: &BTreeSet<char>, ctx: &egui::Context) -> FontSearch {
        self.fonts.find(characters, ctx)
    }

    fn check(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<CheckResult>> {
        let begun = match &self.program {
            Some(program) => check::begin(program, &request, ctx),
            None => Err(tr!("window-the-gonio-program-was-not-found-2").into()),
        };
        match begun {
            Ok(checking) => Box::new(checking),
            Err(error) => Box::new(Ready::new(Err(error))),
        }
    }

    fn tries_every_pair(&self) -> bool {
        true
    }

    fn trial(&mut self, request: CheckRequest, ctx: &egui::Context) -> Box<dyn Pending<TrialOutcome>> {
        let ctx = ctx.clone();
        let begun = match &self.program {
            Some(program) => trial::begin(program, &request, move || ctx.request_repaint()),
            None => Err(tr!("window-the-gonio-program-was-not-found").into()),
        };
        match begun {
            Ok(trial) => Box::new(trial),
            Err(error) => Box::new(Ready::new(TrialOutcome::Unavailable(error))),
        }
    }

    fn shader_trial(&mut self, files: &ShaderFiles, ctx: &egui::Context) -> Box<dyn Pending<TrialOutcome>> {
        let ctx = ctx.clone();
        let begun = match &self.program {
            Some(program) => trial::begin_own(program, files, move || ctx.request_repaint()),
            None => Err(tr!("window-the-gonio-program-was-not-found").into()),
        };
        match begun {
            Ok(trial) => Box::new(trial),
            Err(error) => Box::new(Ready::new(TrialOutcome::Unavailable(error))),
        }
    }

    fn run(&mut self, work: Box<dyn FnOnce() + Send>) {
        // Without a thread there is no answer, and the receiver says so.
        let _ = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(work);
    }

    fn settings(&self) -> Settings {
        storage::settings_file()
            .and_then(|file| std::fs::read_to_string(file).ok())
            .map_or_else(Settings::default, |text| Settings::from_text(&text))
    }

    fn keep(&mut self, settings: &Settings) {
        let Some(file) = storage::settings_file() else { return };
        let made = file.parent().is_some_and(|folder| std::fs::create_dir_all(folder).is_ok());
        if made {
            // A failure loses only the theme and the list of recent files.
            let _ = storage::write_atomically(&file, settings.to_text().as_bytes());
        }
    }

    fn keep_draft(&mut self, key: &str, text: &str) -> Result<(), String> {
        let drafts = self.drafts.as_mut().ok_or(tr!("window-there-is-no-home-folder-home"))?;
        drafts.keep(key, text)
    }

    fn remove_draft(&mut self, key: &str) {
        if let Some(drafts) = &mut self.drafts {
            drafts.remove(key);
        }
    }

    fn take_draft(&mut self, key: &str) -> Option<String> {
        self.drafts.as_mut()?.take(key)
    }

    fn publish(&mut self, state: &dyn Fn() -> Value) {
        let Some(file) = &self.state else { return };
        if let Err(error) = storage::write_atomically(file, state().to_string().as_bytes()) {
            let _ = self.sender.send(Event::Failed(error));
            self.state = None;
        }
    }
}

/// The alternative without a window.
const INSTEAD: &str = "window-gonio-render-draws-without-a-window";

/// Whether there is a display; only Unix systems other than macOS may have none.
pub fn has_display() -> bool {
    !cfg!(all(unix, not(target_os = "macos"))) || is_set("WAYLAND_DISPLAY") || is_set("DISPLAY")
}

fn is_set(name: &str) -> bool {
    std::env::var_os(name).is_some_and(|value| !value.is_empty())
}

/// Checks for a display and libraries, because without them winit panics or gives unhelpful errors. An error is one sentence.
fn check_display() -> Result<(), String> {
    if !has_display() {
        return Err(tr!("window-there-is-no-display-neither-wayland", instead = tr!(INSTEAD)));
    }
    check_libraries()
}

#[cfg(target_os = "linux")]
fn check_libraries() -> Result<(), String> {
    let lacks = |library: &str, package: &str| {
        tr!("window-the-window-needs-which-is-not", library = library, package = package)
    };
    if xkbcommon_dl::xkbcommon_option().is_none() {
        return Err(lacks("libxkbcommon.so.0", "libxkbcommon0"));
    }
    // winit prefers Wayland, and does not need the X11 library then.
    if !is_set("WAYLAND_DISPLAY") && xkbcommon_dl::x11::xkbcommon_x11_option().is_none() {
        return Err(lacks("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"));
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn check_libraries() -> Result<(), String> {
    Ok(())
}

/// Converts an error of eframe to one sentence.
fn window_error(error: eframe::Error) -> String {
    let packages = tr!("window-on-debian-and-ubuntu-apt-get");
    let words = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    match error {
        eframe::Error::AppCreation(_) => tr!("window-the-window-could-not-be-opened", words = words),
        eframe::Error::Glutin(_) | eframe::Error::NoGlutinConfigs(..) | eframe::Error::OpenGL(_) => {
            tr!("window-the-window-has-no-opengl", words = words, packages = packages, instead = tr!(INSTEAD))
        }
        _ => {
            tr!(
                "window-the-display-cannot-be-reached-check",
                words = words,
                packages = packages,
                instead = tr!(INSTEAD)
            )
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::files::ExerciseFile;

    #[derive(Debug)]
    struct Dropped(PathBuf);

    impl egui::DroppedFile for Dropped {
        fn path(&self) -> &Path {
            &self.0
        }
        fn bytes(&self) -> Result<Vec<u8>, String> {
            std::fs::read(&self.0).map_err(|error| error.to_string())
        }
    }

    /// The event for a file that is dropped on the window.
    fn dropped(path: &Path, purpose: Purpose) -> Event {
        let access = Access { max_bytes: 1 << 20, sandbox: false };
        let mut desktop = Desktop::new(None, None, access, &[]);
        let ctx = egui::Context::default();
        let input = egui::RawInput { dropped_files: vec![Arc::new(Dropped(path.to_owned()))], ..Default::default() };
        let mut events = Vec::new();
        ctx.run_ui(input, |ui| events.extend(desktop.poll(purpose, ui.ctx()))).textures_delta.clear();
        // A thread reads it.
        events.into_iter().next().unwrap_or_else(|| desktop.receiver.recv().unwrap())
    }

    #[test]
    fn dropped_files_go_to_the_scene_or_the_exercise() {
        let path = std::env::temp_dir().join(format!("gonio-dropped-{}.obj", std::process::id()));
        std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        let Event::Open(input) = dropped(&path, Purpose::Scene) else { panic!("no model") };
        assert_eq!(input.inputs, [path.to_string_lossy()]);
        let Event::ExerciseFiles(files) = dropped(&path, Purpose::Exercise) else { panic!("no file") };
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!(files, [ExerciseFile { name, path: Some(path.clone()), bytes }]);
        std::fs::remove_file(&path).unwrap();
    }
}
