//! The page's first picture: a scene of one OBJ model, drawn before the application has arrived.
//!
//! `web/page/first.js` calls it. It has the reader, the scene and the renderer of the application, so the picture is the
//! application's, and none of its interface. On other targets the program does nothing.

#[cfg(target_arch = "wasm32")]
mod first {
    use gonio_gl::Gl;
    use gonio_mesh::Limits;
    use gonio_render::{DisplayTexture, Presenter, Renderer};
    use gonio_scene::files::{BUILTIN, FileBytes, FileSource};
    use gonio_scene::readers::{Readers, decoded_picture};
    use gonio_scene::scene_file::{ObjectSpec, SceneFile};
    use gonio_scene::{Frame, load};
    use std::collections::BTreeMap;
    use std::io::{Error, ErrorKind};
    use std::path::{Path, PathBuf};
    use std::sync::Arc;
    use wasm_bindgen::prelude::*;
    use web_sys::WebGl2RenderingContext;

    /// Files by their paths below `builtin:`.
    #[derive(Default)]
    struct Files(BTreeMap<String, FileBytes>);

    impl FileSource for Files {
        fn read_within(&self, _: &Path, _: u64) -> Result<FileBytes, Error> {
            Err(ErrorKind::NotFound.into())
        }
        fn list(&self, _: &Path) -> Vec<PathBuf> {
            Vec::new()
        }
        fn builtin(&self, name: &str) -> Option<FileBytes> {
            self.0.get(name).cloned()
        }
        fn made(&self, _: &str) -> Result<FileBytes, Error> {
            Err(ErrorKind::NotFound.into())
        }
    }

    /// A scene whose files arrive one after the other.
    #[wasm_bindgen]
    #[derive(Default)]
    pub struct FirstScene {
        files: Files,
    }

    #[wasm_bindgen]
    impl FirstScene {
        /// A scene without files.
        #[wasm_bindgen(constructor)]
        pub fn new() -> Self {
            Self::default()
        }

        /// Adds a model or a material library by its path below `builtin:`.
        pub fn give(&mut self, name: String, bytes: Vec<u8>) {
            self.files.0.insert(name, bytes.into());
        }

        /// Adds a texture: `rgba` has `width * height * 4` bytes, first row the top one.
        pub fn give_texture(&mut self, name: String, width: u32, height: u32, rgba: &[u8]) {
            self.files.0.insert(name, decoded_picture(width, height, rgba).into());
        }

        /// Draws the model `builtin:NAME` over the whole canvas of `context`, as the application does first. An error is one
        /// sentence; the application, which reads the same files, explains it.
        pub fn draw(&self, context: WebGl2RenderingContext, name: &str) -> Result<(), String> {
            let object = ObjectSpec { model: format!("{BUILTIN}{name}"), ..ObjectSpec::default() };
            let scene = SceneFile { objects: vec![object], ..SceneFile::default() };
            let scene = load::load_by(Readers::OBJ, scene, Path::new(""), &self.files, &Limits::default());
            let mut scene = scene.map_err(|error| error.message)?;
            let [width, height] =
                [context.drawing_buffer_width(), context.drawing_buffer_height()].map(|side| side.max(1) as u32);
            scene.settings.camera = scene.framed(&scene.settings.camera, f64::from(width) / f64::from(height));
            // `Gl::of_window` takes an `Arc`, as egui does; the page has one thread.
            #[allow(clippy::arc_with_non_send_sync)]
            let gl = Gl::of_window(Arc::new(glow::Context::from_webgl2_context(context)));
            let text = |error: gonio_gl::GlError| error.to_string();
            let mut renderer = Renderer::new(gl.clone()).map_err(text)?;
            let mut frame = Frame { width, height, ..scene.frame(0.0) };
            // As the application's first picture.
            if renderer.info().is_software() {
                frame.samples = 1;
            }
            let uploaded = renderer.upload(&scene).map_err(text)?;
            let mut canvas = DisplayTexture::new(&gl, [width, height]).map_err(text)?;
            renderer.paint_scene(&uploaded, &frame, &mut canvas).map_err(text)?;
            let presenter = Presenter::new(&gl).map_err(text)?;
            presenter.presentation(canvas.texture()).opaque().draw(&gl);
            Ok(())
        }
    }
}

fn main() {}
