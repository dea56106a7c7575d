//! The small pictures of the scenes: loaded beside the interface, and drawn one in each frame.

use crate::beside::{Beside, Steps};
use crate::files::ReadRecorder;
use crate::platform::Platform;
use crate::scene_view::drawing::PaneRenderer;
use gonio_gallery::drawing::EnvironmentCache;
use gonio_gallery::exhibit::Exhibit;
use gonio_gl::GlError;
use gonio_language::tr;
use gonio_render::{DisplayOptions, DisplayTexture, Presentation};
use gonio_scene::{Frame, Scene, SceneFile};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Samples of each pixel.
const SAMPLES: u32 = 4;

/// A scene to load. Environments are shared by all scenes of the gallery.
struct LoadWork {
    scene: SceneFile,
    environments: EnvironmentCache,
    files: Arc<ReadRecorder>,
    /// The loaded scene, whose environment is being prepared.
    loaded: Option<Scene>,
}

type Loaded = (EnvironmentCache, Result<Scene, String>);

impl Steps for LoadWork {
    type Output = Loaded;

    fn step(&mut self) -> Option<Loaded> {
        if let Some(loaded) = self.loaded.take() {
            if let Some(environment) = &loaded.environment {
                environment.glossy();
            }
            return Some((std::mem::take(&mut self.environments), Ok(loaded)));
        }
        // On the page, built-in files may still be on their way.
        if self.files.is_waiting() {
            return None;
        }
        self.files.forget();
        match self.environments.load(self.scene.clone(), &*self.files) {
            _ if self.files.is_waiting() => None,
            Ok(loaded) => {
                self.loaded = Some(loaded);
                None
            }
            Err(error) => Some((std::mem::take(&mut self.environments), Err(error.to_string()))),
        }
    }
}

/// The pictures that were drawn, in one OpenGL context.
#[derive(Default)]
pub struct Thumbnails {
    environments: EnvironmentCache,
    /// The scene that is being loaded: its name, and the size of its picture in pixels.
    work: Option<(String, [u32; 2], Beside<LoadWork>)>,
    /// By the exhibit's name; `None` for a scene that could not be drawn.
    drawn: BTreeMap<String, Option<DisplayTexture>>,
}

impl Thumbnails {
    /// Ends the work. What is drawn is kept.
    pub fn stop(&mut self) {
        self.work = None;
    }

    /// Number of pictures.
    pub fn drawn(&self) -> usize {
        self.drawn.values().flatten().count()
    }

    /// Whether the picture was drawn, or cannot be.
    pub fn is_done(&self, exhibit: &Exhibit) -> bool {
        self.drawn.contains_key(&exhibit.name)
    }

    /// The picture, if it was drawn.
    pub fn picture(&self, exhibit: &Exhibit, panes: &PaneRenderer) -> Option<Presentation> {
        self.drawn.get(&exhibit.name)?.as_ref().map(|texture| panes.presented(texture))
    }

    /// Draws the scene that was loaded, and starts to load `next`. An error is one sentence.
    pub fn follow<'a>(
        &mut self,
        ctx: &egui::Context,
        platform: &mut dyn Platform,
        panes: &mut PaneRenderer,
        next: Option<(String, [u32; 2])>,
        exhibit: impl Fn(&str) -> Option<&'a Exhibit>,
    ) -> Result<(), String> {
        let mut result = Ok(());
        if let Some((name, size, mut work)) = self.work.take() {
            match work.poll(ctx) {
                None => {
                    self.work = Some((name, size, work));
                    return Ok(());
                }
                Some(finished) => {
                    let (environments, loaded) = finished.unwrap_or_else(|| {
                        (
                            EnvironmentCache::default(),
                            Err(tr!("environment-the-scene-could-not-be-loaded", name = name)),
                        )
                    });
                    self.environments = environments;
                    let drawn = loaded.and_then(|scene| {
                        let of =
                            exhibit(&name).ok_or_else(|| tr!("environment-the-scene-is-not-in-the", name = name))?;
                        draw(&scene, of, size, panes).map_err(|error| error.to_string())
                    });
                    // One that cannot be drawn is not tried in every frame.
                    result = drawn.map(|texture| {
                        self.drawn.insert(name.clone(), Some(texture));
                    });
                    if result.is_err() {
                        self.drawn.insert(name, None);
                    }
                    ctx.request_repaint();
                    return result;
                }
            }
        }
        let scene = next.and_then(|(name, size)| Some((exhibit(&name)?.scene()?.clone(), name, size)));
        if let Some((scene, name, size)) = scene {
            let environments = std::mem::take(&mut self.environments);
            let files = Arc::new(ReadRecorder::new(platform.files()));
            let work = LoadWork { scene, environments, files, loaded: None };
            self.work = Some((name, size, Beside::start(platform, ctx, work)));
        }
        result
    }
}

fn draw(scene: &Scene, exhibit: &Exhibit, size: [u32; 2], panes: &mut PaneRenderer) -> Result<DisplayTexture, GlError> {
    let [width, height] = size;
    let frame = scene.frame(exhibit.time);
    let frame = Frame { width, height, samples: frame.samples.min(SAMPLES), ..frame };
    let mut texture = DisplayTexture::new(panes.gl(), size)?;
    let uploaded = panes.renderer().upload(scene)?;
    panes.renderer().paint(&uploaded, &frame, &DisplayOptions::from(exhibit.view), &mut texture)?;
    Ok(texture)
}
