//! From the inputs that a user names to a scene file.

use crate::environment_file;
use crate::files::{self, FileSource};
use crate::input_kind::{self, InputKind};
use crate::scene_file::{ObjectSpec, SceneFile};
use crate::toml_reader;
use crate::toml_tree::line_and_column;
use gonio_mesh::{Cause, ReadError, encoding};
use std::borrow::Cow;
use std::path::Path;

/// Reads what `inputs` name: scene files (`.toml`), bare models, or `builtin:NAME` of either. The
/// models of a scene file are relative to its folder; in the result they are relative to the current
/// one, so that [`crate::load::load`] is given an empty base.
///
/// Several inputs become one scene, models in the coordinates of their files; the first scene file
/// among them gives picture, camera, background and equation. Models are only read as far as it takes to
/// detect their format.
pub fn describe(inputs: &[&str], files: &dyn FileSource) -> Result<SceneFile, ReadError> {
    if inputs.is_empty() {
        return Err(ReadError::new("nothing to read: name a model, a scene file or builtin:suzanne"));
    }
    let mut whole = SceneFile::default();
    let mut has_settings = false;
    for &input in inputs {
        let (mut scene, is_scene_file) = describe_one(input, files).map_err(|e| e.in_file(input))?;
        whole.objects.append(&mut scene.objects);
        whole.lights.append(&mut scene.lights);
        if is_scene_file && !has_settings {
            has_settings = true;
            whole = SceneFile { objects: whole.objects, lights: whole.lights, ..scene };
        }
    }
    Ok(whole)
}

/// The scene of one input, and whether it came from a scene file.
fn describe_one(input: &str, files: &dyn FileSource) -> Result<(SceneFile, bool), ReadError> {
    let path = files::resolve(Path::new(""), input);
    let explain = |e: std::io::Error| {
        if e.kind() == std::io::ErrorKind::NotFound && environment_file::builtin_of(input).is_some() {
            let message = "this is a built-in environment, not a model; to surround a model by it, name it as the \
                           environment";
            return ReadError::new(message).caused_by(Cause::EnvironmentAsModel);
        }
        files::failed(&e)
    };
    let bytes = files::read(files, &path).map_err(explain)?;
    match input_kind::detect(&bytes, &path)? {
        InputKind::Model => {
            let object = ObjectSpec { model: input.to_owned(), ..ObjectSpec::default() };
            Ok((SceneFile { objects: vec![object], ..SceneFile::default() }, false))
        }
        InputKind::Scene => {
            let bytes = scene_text(&bytes)?;
            let text = std::str::from_utf8(&bytes).map_err(|e| not_utf8(&bytes, e.valid_up_to()))?;
            let mut scene = toml_reader::read(text)?;
            let base = path.parent().unwrap_or(Path::new(""));
            for object in &mut scene.objects {
                if !object.model.starts_with(files::BUILTIN) {
                    object.model = files::resolve(base, &object.model).to_string_lossy().into_owned();
                }
            }
            if let Some(environment) = &mut scene.environment {
                for image in std::iter::once(&mut environment.image).chain(&mut environment.background) {
                    *image = environment_file::rebased(base, image);
                }
            }
            Ok((scene, true))
        }
    }
}

/// The text of a scene file as UTF-8: nothing of it may be lost.
fn scene_text(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ReadError> {
    let text = encoding::to_utf8(bytes);
    match text.diagnostics.first() {
        Some(damage) => {
            let message = "a scene file must be UTF-8 or UTF-16 text, and here it is neither".to_owned();
            Err(ReadError { message, file: None, line: damage.line, column: damage.column, cause: None })
        }
        None => Ok(text.bytes),
    }
}

fn not_utf8(bytes: &[u8], valid: usize) -> ReadError {
    let (line, column) = line_and_column(&String::from_utf8_lossy(&bytes[..valid]), valid);
    ReadError::new("a scene file must be UTF-8 text, and here it is not").at(line, Some(column))
}
