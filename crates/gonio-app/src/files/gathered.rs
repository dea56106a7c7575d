//! Finds the model among several files.
//!
//! The rules, in this order:
//!
//! 1. If there are scene files (`.toml`), they are opened; the other files are their sidecars.
//! 2. Otherwise all models are opened, in one scene. Pictures are their textures, except formats that models do not use
//!    (Radiance, OpenEXR, KTX2, DDS): one of these is the environment.
//! 3. Otherwise pictures are the environment of the open scene: one picture, or the six faces of a cubemap.
//! 4. Shaders and a `names.toml` draw the scene, whether another input is among the files or not.
//! 5. Otherwise there is nothing to open, which is an error.

use super::{MOST_SHADER_BYTES, ShaderFiles, base_name};
use gonio_check::submission::stage_of;
use gonio_environment::names;
use gonio_glsl::Stage;
use gonio_image::decode::FileFormat;
use gonio_language::tr;
use gonio_mesh::{Format, compression};
use gonio_scene::files::FileSource;
use std::path::Path;

/// The inputs among several files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GatheredInputs {
    /// Models or scene files to open; empty if there is only an environment.
    pub inputs: Vec<String>,
    /// The environment.
    pub environment: Option<String>,
    /// The user's own shaders.
    pub shaders: Option<ShaderFiles>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Shader,
    /// The names of the variables of shaders.
    Names,
    Scene,
    Model,
    /// May be a texture or an environment.
    Picture,
    /// A format that models do not use for textures.
    Environment,
    /// A sidecar of a model: materials, buffers.
    Sidecar,
    Other,
}

/// Applies the rules to files of `source`. An error is one sentence.
pub fn gather(names: &[String], source: &dyn FileSource) -> Result<GatheredInputs, String> {
    let kinds: Vec<(&String, Kind)> = names.iter().map(|name| (name, kind(name, source))).collect();
    let of = |requested: Kind| -> Vec<String> {
        kinds.iter().filter(|(_, kind)| *kind == requested).map(|(name, _)| (*name).clone()).collect()
    };
    let shaders = shaders(&of(Kind::Shader), of(Kind::Names), source);
    let rest: Vec<(&String, Kind)> =
        kinds.iter().copied().filter(|(_, kind)| !matches!(kind, Kind::Shader | Kind::Names)).collect();
    match (scene(&rest), shaders) {
        (Ok(scene), shaders) => Ok(GatheredInputs { shaders: shaders.ok().flatten(), ..scene }),
        (Err(_), Ok(Some(shaders))) => Ok(GatheredInputs { shaders: Some(shaders), ..GatheredInputs::default() }),
        (Err(_), Err(error)) | (Err(error), Ok(None)) => Err(error),
    }
}

/// One shader for each stage, and their names. An error is one sentence.
fn shaders(files: &[String], names: Vec<String>, source: &dyn FileSource) -> Result<Option<ShaderFiles>, String> {
    let mut found = ShaderFiles { names: names.into_iter().next(), ..ShaderFiles::default() };
    for name in files {
        let bytes = source.read_within(Path::new(name), MOST_SHADER_BYTES);
        let bytes = bytes.map_err(|error| tr!("window-cannot-read-the-shader", name = name, error = error))?;
        let stage = stage_of(name, &String::from_utf8_lossy(&bytes));
        let (place, stage) = match stage {
            Some(Stage::Vertex) => (&mut found.vertex, "vertex"),
            Some(_) => (&mut found.fragment, "fragment"),
            None => {
                return Err(tr!("window-may-be-a-vertex-or-a", name = name));
            }
        };
        if let Some(other) = place.replace(name.clone()) {
            return Err(tr!("window-and-are-both-shaders-open-one", other = other, name = name, stage = stage));
        }
    }
    Ok((found.any() || found.names.is_some()).then_some(found))
}

/// The models, scenes or pictures among files.
fn scene(kinds: &[(&String, Kind)]) -> Result<GatheredInputs, String> {
    let of = |requested: Kind| -> Vec<String> {
        kinds.iter().filter(|(_, kind)| *kind == requested).map(|(name, _)| (*name).clone()).collect()
    };
    let scenes = of(Kind::Scene);
    if !scenes.is_empty() {
        return Ok(GatheredInputs { inputs: scenes, ..GatheredInputs::default() });
    }
    let models = of(Kind::Model);
    let environments = of(Kind::Environment);
    if !models.is_empty() {
        let environment = match environments.as_slice() {
            [] => None,
            several => Some(one_environment(several)?),
        };
        return Ok(GatheredInputs { inputs: models, environment, shaders: None });
    }
    let pictures: Vec<String> = environments.into_iter().chain(of(Kind::Picture)).collect();
    if !pictures.is_empty() {
        let environment = Some(one_environment(&pictures)?);
        return Ok(GatheredInputs { environment, ..GatheredInputs::default() });
    }
    let expected = tr!("window-a-model-obj-gltf-glb-dae");
    Err(match kinds {
        [] => tr!("window-no-files-to-open").to_owned(),
        [(one, Kind::Sidecar)] => {
            tr!("window-belongs-to-a-model-open-it", one = one)
        }
        [(one, _)] => tr!("window-cannot-be-opened-expected", one = one, expected = expected),
        several => tr!("window-none-of-these-files-can-be", count = several.len(), expected = expected),
    })
}

fn kind(name: &str, source: &dyn FileSource) -> Kind {
    match extension(name).as_str() {
        "toml" if base_name(name).eq_ignore_ascii_case("names.toml") => return Kind::Names,
        "toml" => return Kind::Scene,
        "vert" | "vs" | "vsh" | "vertex" | "frag" | "fs" | "fsh" | "fragment" | "glsl" => return Kind::Shader,
        "mtl" | "bin" => return Kind::Sidecar,
        "hdr" | "exr" | "ktx2" | "dds" => return Kind::Environment,
        "png" | "jpg" | "jpeg" | "bmp" | "tga" | "gif" => return Kind::Picture,
        _ => {}
    }
    // A file that cannot be read but has a model's name is opened nevertheless, so that the error is reported.
    let bytes = source.read(Path::new(name)).ok();
    let bytes = bytes.as_deref().unwrap_or(&[]);
    match FileFormat::detect(bytes) {
        Some(FileFormat::Png | FileFormat::Jpeg) => Kind::Picture,
        Some(_) => Kind::Environment,
        None if compression::is_compressed(bytes) => Kind::Model,
        None if Format::detect(bytes, name).is_ok() => Kind::Model,
        None if Format::ALL.iter().any(|format| format.extension() == extension(name)) => Kind::Model,
        None => Kind::Other,
    }
}

fn extension(name: &str) -> String {
    Path::new(name).extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// The only picture, or the first of six faces, beside which the others are found.
fn one_environment(pictures: &[String]) -> Result<String, String> {
    if let [one] = pictures {
        return Ok(one.clone());
    }
    let bare: Vec<&str> = pictures.iter().map(|name| base_name(name)).collect();
    match names::assign(&bare) {
        Ok(assignment) => assignment
            .files
            .first()
            .and_then(|&index| pictures.get(index))
            .cloned()
            .ok_or_else(|| tr!("window-the-six-faces-of-the-environment").into()),
        Err(error) => {
            Err(tr!("window-these-pictures-are-not-one-environment", count = pictures.len(), message = error.message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::MemoryFiles;

    const OBJ: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    fn of(files: &[(&str, &[u8])]) -> Result<GatheredInputs, String> {
        let mut memory = MemoryFiles::default();
        for (name, bytes) in files {
            memory.insert(name, bytes.to_vec());
        }
        gather(&memory.names(), &memory)
    }

    fn inputs(names: &[&str]) -> GatheredInputs {
        GatheredInputs { inputs: names.iter().map(|n| (*n).to_owned()).collect(), ..GatheredInputs::default() }
    }

    fn environment(name: &str) -> GatheredInputs {
        GatheredInputs { environment: Some(name.to_owned()), ..GatheredInputs::default() }
    }

    #[test]
    fn one_model_with_its_sidecars() {
        let files = of(&[("a.mtl", b"newmtl a"), ("a.obj", OBJ), ("wood.png", b""), ("notes.txt", b"")]);
        assert_eq!(files, Ok(inputs(&["a.obj"])));
        // A model is detected by its content.
        assert_eq!(of(&[("thing", OBJ)]), Ok(inputs(&["thing"])));
        // glTF whose `asset` is at its end.
        let gltf = format!("{{\"nodes\": [{}{{}}], \"asset\": {{}}}}", "{}, ".repeat(2000));
        assert_eq!(of(&[("model.json", gltf.as_bytes())]), Ok(inputs(&["model.json"])));
        assert!(of(&[("package.json", b"{\"name\": \"asset\"}")]).is_err());
    }

    #[test]
    fn several_models_are_all_opened() {
        assert_eq!(of(&[("a.obj", OBJ), ("m/b.obj", OBJ)]), Ok(inputs(&["a.obj", "m/b.obj"])));
    }

    #[test]
    fn a_scene_file_wins() {
        let files = of(&[("a.obj", OBJ), ("scene.toml", b"[[objects]]"), ("sky.hdr", b"")]);
        assert_eq!(files, Ok(inputs(&["scene.toml"])));
    }

    #[test]
    fn pictures_alone_are_the_environment() {
        assert_eq!(of(&[("sky.hdr", b"")]), Ok(environment("sky.hdr")));
        let faces = ["negx.png", "negy.png", "negz.png", "posx.png", "posy.png", "posz.png"];
        let six: Vec<(&str, &[u8])> = faces.map(|name| (name, &b""[..])).into();
        assert_eq!(of(&six), Ok(environment("posx.png")));
        assert!(of(&[("a.png", b""), ("b.png", b"")]).is_err_and(|error| error.starts_with("these 2 pictures")));
    }

    #[test]
    fn pictures_that_no_model_uses_are_the_environment() {
        let files = of(&[("a.obj", OBJ), ("wood.png", b""), ("sky.hdr", b"")]);
        assert_eq!(files, Ok(GatheredInputs { environment: Some("sky.hdr".into()), ..inputs(&["a.obj"]) }));
    }

    #[test]
    fn shaders_are_found_by_name_or_content_also_beside_a_model() {
        let vertex = b"in vec3 p; void main() { gl_Position = vec4(p, 1.0); }";
        let shaders = |vertex: Option<&str>, fragment: Option<&str>, names: Option<&str>| {
            let [vertex, fragment, names] = [vertex, fragment, names].map(|name| name.map(str::to_owned));
            Some(ShaderFiles { vertex, fragment, names, ..ShaderFiles::default() })
        };
        let both = of(&[("a.frag", b"void main() {}"), ("light.glsl", vertex), ("names.toml", b"[names]")]);
        let expected = shaders(Some("light.glsl"), Some("a.frag"), Some("names.toml"));
        assert_eq!(both, Ok(GatheredInputs { shaders: expected, ..GatheredInputs::default() }));
        let with_model = of(&[("a.frag", b"void main() {}"), ("a.obj", OBJ)]);
        assert_eq!(
            with_model,
            Ok(GatheredInputs { shaders: shaders(None, Some("a.frag"), None), ..inputs(&["a.obj"]) })
        );
        let two = of(&[("a.frag", b""), ("b.frag", b"")]);
        assert!(two.is_err_and(|error| error == "`a.frag` and `b.frag` are both fragment shaders: open one of them"));
        // A project's folder has many; the model is opened without them.
        assert_eq!(of(&[("a.frag", b""), ("b.frag", b""), ("a.obj", OBJ)]), Ok(inputs(&["a.obj"])));
        assert!(of(&[("a.glsl", b"float f();")]).is_err_and(|error| error.starts_with("`a.glsl` may be a vertex or")));
    }

    #[test]
    fn files_that_cannot_be_opened_are_errors() {
        assert!(of(&[]).is_err());
        assert!(of(&[("a.mtl", b"newmtl a")]).is_err_and(|error| error.contains("belongs to a model")));
        assert!(of(&[("a.txt", b"hello")]).is_err_and(|error| error.contains("`a.txt` cannot be opened")));
        // The reader will report the error.
        assert_eq!(of(&[("a.glb", b"")]), Ok(inputs(&["a.glb"])));
    }
}
