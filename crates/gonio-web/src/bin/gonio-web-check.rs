//! The checker that the page's worker calls (`web/page/checker.js`): it takes a student's files and returns a verdict. A module of
//! its own, loaded with the first exercise. The worker has a thread and an OpenGL context of its own, so that a shader that never
//! ends does not block the page and is stopped with the worker. On other targets the program does nothing.

#[cfg(target_arch = "wasm32")]
mod checker {
    use eframe::glow;
    use gonio_check::CheckOptions;
    use gonio_check::submission::SourceFile;
    use gonio_exercises::Checker;
    use gonio_exercises::exercise;
    use gonio_gl::Gl;
    use gonio_language::Language;
    use std::sync::Arc;
    use wasm_bindgen::prelude::*;
    use web_sys::{OffscreenCanvas, WebGl2RenderingContext};

    /// Checks submissions one after the other, in a canvas of its own. Compiled programs of the exercises are kept.
    #[wasm_bindgen]
    pub struct PageChecker {
        checker: Checker,
        context: WebGl2RenderingContext,
    }

    #[wasm_bindgen]
    impl PageChecker {
        /// Creates a checker with a canvas of any size; programs are drawn into textures. An error is one sentence: the browser has no
        /// WebGL 2 in workers, or cannot draw into float textures.
        #[wasm_bindgen(constructor)]
        pub fn new(canvas: &OffscreenCanvas) -> Result<PageChecker, String> {
            let context = canvas.get_context("webgl2").ok().flatten();
            let context: WebGl2RenderingContext = context
                .and_then(|context| context.dyn_into().ok())
                .ok_or("this browser has no WebGL 2 in workers: use another one, or `gonio lab check`")?;
            if !matches!(context.get_extension("EXT_color_buffer_float"), Ok(Some(_))) {
                return Err(
                    "this browser cannot draw into float textures (EXT_color_buffer_float): use another one, or \
                     `gonio lab check`"
                        .to_owned(),
                );
            }
            // `Gl::of_window` takes an `Arc`, as egui does; the page has one thread.
            #[allow(clippy::arc_with_non_send_sync)]
            let functions = Arc::new(glow::Context::from_webgl2_context(context.clone()));
            Ok(PageChecker { checker: Checker::new(&Gl::of_window(functions)), context })
        }

        /// The built-in files that a check of an exercise reads, by their paths below `assets`.
        pub fn needed_files(&self, exercise: &str) -> Vec<String> {
            exercise::find(exercise).map_or_else(Vec::new, |exercise| exercise.needed_files())
        }

        /// Adds such a file. An error is one sentence.
        pub fn give_file(&mut self, path: &str, bytes: &[u8]) -> Result<(), String> {
            self.checker.give_file(path, bytes.to_vec())
        }

        /// Checks files, given by `names` and `contents`, each a `Uint8Array`. Returns the verdict as JSON, as `gonio lab check --json`
        /// does, in the language with this code. An error is one sentence.
        pub fn check(
            &mut self,
            exercise: &str,
            names: Vec<String>,
            contents: js_sys::Array,
            as_the_lab: bool,
            language: &str,
        ) -> Result<String, String> {
            Language::from_tag(language).unwrap_or_default().make_current();
            let exercise = exercise::find(exercise).ok_or_else(|| format!("unknown exercise `{exercise}`"))?;
            let bytes = contents.iter().map(|content| js_sys::Uint8Array::new(&content).to_vec());
            let files = names.into_iter().zip(bytes).map(|(name, bytes)| SourceFile::new(name, bytes)).collect();
            let options = CheckOptions { as_the_lab, ..CheckOptions::default() };
            let outcome = gonio_exercises::check(&mut self.checker, exercise, files, &options, exercise.feedback);
            if self.context.is_context_lost() {
                return Err(
                    "the browser reset the graphics during the check: look for a loop in a shader that never ends"
                        .to_owned(),
                );
            }
            let (verdict, _) = outcome.map_err(|error| error.to_string())?;
            serde_json::to_string(&verdict).map_err(|error| format!("the verdict cannot be written: {error}"))
        }
    }
}

fn main() {}
