//! The files that the exercise's GL programs name.

use gonio_gl::Gl;
use gonio_render::gl_program::{GlProgramFiles, GlProgramImage};
use gonio_render::user_program::is_embedded;
use std::borrow::Cow;
use std::sync::Arc;

const VERTEX: &str = include_str!("../../../../exercises/ex11-texture-unit/start.vert");
const FRAGMENT: &str = include_str!("../../../../exercises/ex11-texture-unit/start.frag");

/// The exercise's shaders, and the images that gonio carries: none on the web, where they are fetched.
pub fn exercise_files() -> GlProgramFiles {
    let mut files = GlProgramFiles::default();
    files.shaders.insert("start.vert".to_owned(), VERTEX.to_owned());
    files.shaders.insert("start.frag".to_owned(), FRAGMENT.to_owned());
    for name in ["checker.png", "planks.png", "tiles.png"] {
        if let Some(image) = GlProgramImage::built_in(name) {
            files.images.insert(name.to_owned(), Arc::new(image));
        }
    }
    files
}

/// What the first line of the exercise's shaders is in OpenGL ES, which WebGL2 speaks.
const ES_VERSION: &str = "#version 300 es";

/// The same files for the context that draws: in OpenGL ES, `#version 330 core` becomes `#version 300 es`, and the line
/// after it begins with the precisions that OpenGL ES wants. Lines keep their numbers.
pub fn for_context<'a>(gl: &Gl, files: &'a GlProgramFiles) -> Cow<'a, GlProgramFiles> {
    if !is_embedded(gl) {
        return Cow::Borrowed(files);
    }
    let mut files = files.clone();
    for source in files.shaders.values_mut() {
        *source = embedded(source);
    }
    Cow::Owned(files)
}

fn embedded(source: &str) -> String {
    let mut lines = source.lines();
    match lines.next() {
        Some(first) if first.starts_with("#version") && !first.contains("es") => {
            let rest: Vec<&str> = lines.collect();
            format!("{ES_VERSION}\nprecision highp float; precision highp int; {}\n", rest.join("\n"))
        }
        _ => source.to_owned(),
    }
}
