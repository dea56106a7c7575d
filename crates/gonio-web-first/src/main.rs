//! The page's first picture: a scene of one OBJ model, drawn before the application has arrived.
//!
//! `web/page/first.js` calls it. It has the reader, the scene and the renderer of the application, so the picture is the
//! application's, and none of its interface. On other targets the program does nothing.

#[cfg(target_arch = "wasm32")]
mod first {
    use gonio_gl::{Gl, GlError};
    use gonio_mesh::Limits;
    use gonio_render::{GpuScene, Renderer};
    use gonio_scene::files::{BUILTIN, FileBytes, FileSource};
    use gonio_scene::readers::{Readers, decoded_picture};
    use gonio_scene::scene_file::{ObjectSpec, SceneFile};
    use gonio_scene::{Frame, Scene, load};
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

    /// A triangle without and one with a texture, drawn in place of the scene while its files arrive.
    const STAND_IN: [(&str, &str); 2] = [
        (
            "stand-in.obj",
            "mtllib stand-in.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\nusemtl t\nf 1/1/1 2/1/1 3/1/1\n",
        ),
        ("stand-in.mtl", "newmtl t\nmap_Kd stand-in.png\n"),
    ];

    /// A context with what draws into it.
    struct Canvas {
        context: WebGl2RenderingContext,
        renderer: Renderer,
    }

    impl Canvas {
        fn new(context: WebGl2RenderingContext) -> Result<Self, GlError> {
            // `Gl::of_window` takes an `Arc`, as egui does; the page has one thread.
            #[allow(clippy::arc_with_non_send_sync)]
            let gl = Gl::of_window(Arc::new(glow::Context::from_webgl2_context(context.clone())));
            Ok(Canvas { context, renderer: Renderer::new(gl)? })
        }

        /// Draws a stand-in for the scene into a corner of the canvas, which is not visible yet.
        fn warm_up(&mut self, stand_in: &mut Scene) -> Result<(), GlError> {
            // Most models are closed, and drivers compile anew for other settings of culling.
            stand_in.objects.iter_mut().for_each(|object| object.closed = true);
            self.draw_at_size(stand_in, [16, 16])
        }

        /// Draws a scene over the whole canvas.
        fn draw(&mut self, scene: &mut Scene) -> Result<(), GlError> {
            let size = [self.context.drawing_buffer_width(), self.context.drawing_buffer_height()];
            self.draw_at_size(scene, size.map(|side| side.max(1) as u32))
        }

        fn draw_at_size(&mut self, scene: &mut Scene, size: [u32; 2]) -> Result<(), GlError> {
            let (uploaded, frame) = self.prepare(scene, size)?;
            self.renderer.paint_scene_on_window(&uploaded, &frame)?;
            // Drivers collect commands until somebody waits for them.
            self.context.flush();
            Ok(())
        }

        /// Uploads a scene and makes the frame of the application's first picture.
        fn prepare(&mut self, scene: &mut Scene, [width, height]: [u32; 2]) -> Result<(GpuScene, Frame), GlError> {
            scene.settings.camera = scene.framed(&scene.settings.camera, f64::from(width) / f64::from(height));
            let mut frame = Frame { width, height, ..scene.frame(0.0) };
            if self.renderer.info().is_software() {
                frame.samples = 1;
            }
            Ok((self.renderer.upload(scene)?, frame))
        }
    }

    /// A scene whose files arrive one after the other.
    #[wasm_bindgen]
    #[derive(Default)]
    pub struct FirstScene {
        files: Files,
        canvas: Option<Canvas>,
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

        /// Takes the context, and draws a stand-in that stays invisible: a software driver compiles programs when it first draws with
        /// them, and does that while the scene is read. `textured`: the scene has materials with textures. An error is one sentence.
        pub fn begin(&mut self, context: WebGl2RenderingContext, textured: bool) -> Result<(), String> {
            let mut canvas = Canvas::new(context).map_err(|error| error.to_string())?;
            let mut files = Files::default();
            for (name, text) in STAND_IN {
                files.0.insert(name.to_owned(), text.as_bytes().to_vec().into());
            }
            if textured {
                files.0.insert("stand-in.png".to_owned(), decoded_picture(1, 1, &[255; 4]).into());
            }
            canvas.warm_up(&mut read(&files, STAND_IN[0].0)?).map_err(|error| error.to_string())?;
            self.canvas = Some(canvas);
            Ok(())
        }

        /// Draws the model `builtin:NAME` over the whole canvas, as the application does first. An error is one sentence; the
        /// application, which reads the same files, explains it.
        pub fn draw(&mut self, name: &str) -> Result<(), String> {
            let canvas = self.canvas.as_mut().ok_or("there is no canvas")?;
            canvas.draw(&mut read(&self.files, name)?).map_err(|error| error.to_string())
        }
    }

    /// The scene of the model `builtin:NAME`.
    fn read(files: &Files, name: &str) -> Result<Scene, String> {
        let object = ObjectSpec { model: format!("{BUILTIN}{name}"), ..ObjectSpec::default() };
        let scene = SceneFile { objects: vec![object], ..SceneFile::default() };
        load::load_by(Readers::OBJ, scene, Path::new(""), files, &Limits::default()).map_err(|error| error.message)
    }
}

fn main() {}
