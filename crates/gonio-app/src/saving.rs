//! Saving of pictures and scenes.

use crate::environment::EnvironmentProduct;
use gonio_image::encode::png::{self, ColorTag};
use gonio_image::{EncodedPicture, ImageError};
use gonio_language::tr;
use gonio_scene::convert::ModelFormat;
use gonio_scene::files::BUILTIN;
use gonio_scene::{SceneFile, SceneSettings, environment_file};
use std::path::{Path, PathBuf};

/// Follows the title in the names of a baked model's files, so that they do not replace the original's.
pub const BAKED: &str = "_baked";

/// Something to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// The current pane's picture as it is shown, in its size there.
    Picture,
    /// The same in the size of the scene file (`[picture]`).
    SizedPicture,
    /// The current pane's light, linear, in its size there.
    Light,
    /// The scene.
    Scene,
    /// A RenderDoc capture of the current pane's picture ([`crate::platform::CaptureAccess`]).
    Capture,
    /// The plot of the BRDF bench, as SVG.
    PlotSvg,
    /// The same as PNG.
    PlotPng,
    /// The baked model as OBJ, with its other files beside it.
    BakedObj,
    /// The baked model as GLB.
    BakedGlb,
    /// All files of the baked model as ZIP.
    BakedZip,
    /// The inspected model as GLB.
    ModelGlb,
    /// The same as OBJ, with its other files beside it.
    ModelObj,
    /// The same as PLY, with its textures beside it.
    ModelPly,
    /// The environment, converted.
    Environment(EnvironmentProduct),
}

impl Product {
    /// The products of the scene view.
    pub const OF_SCENE: [Product; 4] = [Product::Picture, Product::SizedPicture, Product::Light, Product::Scene];

    /// The products of a bake. A page cannot save several files at once.
    pub const OF_BAKING: &'static [Product] = if cfg!(target_arch = "wasm32") {
        &[Product::BakedZip, Product::BakedGlb]
    } else {
        &[Product::BakedObj, Product::BakedGlb, Product::BakedZip]
    };

    /// The inspected model in the formats that can be written.
    pub const OF_MODEL: [Product; 3] = [Product::ModelGlb, Product::ModelObj, Product::ModelPly];

    /// The format of a model that is converted.
    pub fn model_format(self) -> Option<ModelFormat> {
        match self {
            Product::ModelGlb => Some(ModelFormat::Glb),
            Product::ModelObj => Some(ModelFormat::Obj),
            Product::ModelPly => Some(ModelFormat::Ply),
            _ => None,
        }
    }

    /// Kebab-case, for widgets' ids.
    pub fn id(self) -> &'static str {
        match self {
            Product::Picture => "picture",
            Product::SizedPicture => "sized-picture",
            Product::Light => "light",
            Product::Scene => "scene",
            Product::Capture => "capture",
            Product::PlotSvg => "plot-svg",
            Product::PlotPng => "plot-png",
            Product::BakedObj => "baked-obj",
            Product::BakedGlb => "baked-glb",
            Product::BakedZip => "baked-zip",
            Product::ModelGlb => "model-glb",
            Product::ModelObj => "model-obj",
            Product::ModelPly => "model-ply",
            Product::Environment(product) => product.id(),
        }
    }

    /// The title in menus.
    pub fn title(self) -> &'static str {
        match self {
            Product::Picture => tr!("window-picture-as-displayed-png"),
            Product::SizedPicture => tr!("window-picture-at-the-scene-s-resolution"),
            Product::Light => tr!("window-linear-light-exr"),
            Product::Scene => tr!("window-scene-toml"),
            Product::Capture => tr!("window-renderdoc-capture-rdc"),
            Product::PlotSvg => tr!("window-plot-svg"),
            Product::PlotPng => tr!("window-plot-png"),
            Product::BakedObj => tr!("window-obj-and-png"),
            Product::BakedGlb | Product::ModelGlb => "GLB",
            Product::BakedZip => "ZIP",
            Product::ModelObj => "OBJ",
            Product::ModelPly => "PLY",
            Product::Environment(product) => product.title(),
        }
    }

    /// The file name extension.
    pub fn extension(self) -> &'static str {
        match self {
            Product::Picture | Product::SizedPicture | Product::PlotPng => "png",
            Product::PlotSvg => "svg",
            Product::Light => "exr",
            Product::Scene => "toml",
            Product::Capture => "rdc",
            Product::BakedObj | Product::ModelObj => "obj",
            Product::BakedGlb | Product::ModelGlb => "glb",
            Product::BakedZip => "zip",
            Product::ModelPly => "ply",
            Product::Environment(product) => product.extension(),
        }
    }

    /// The proposed file name, from the title of the open scene.
    pub fn file_name(self, title: &str) -> String {
        let baked = if Self::OF_BAKING.contains(&self) { BAKED } else { "" };
        format!("{}{baked}.{}", Self::stem(title), self.extension())
    }

    /// The title of the open scene as the beginning of a file name.
    pub fn stem(title: &str) -> String {
        let stem = title.split(" and ").next().unwrap_or(title);
        let stem = stem.split('.').next().unwrap_or(stem);
        let stem: String = stem.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect();
        if stem.is_empty() { "scene".to_owned() } else { stem }
    }
}

/// A picture in display values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DisplayedPicture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// `width * height * 4` bytes, the top row first; colours are premultiplied by alpha.
    pub rgba: Vec<u8>,
    /// Whether the values are sRGB; unencoded light and quantities are not.
    pub is_srgb: bool,
}

/// Encodes a picture as PNG. Opaque pictures have three channels; in others colours are divided by alpha, as PNG requires.
pub fn encode_png(picture: &DisplayedPicture) -> Result<Vec<u8>, ImageError> {
    let [width, height] = picture.size;
    let rgba = picture.rgba.as_chunks::<4>().0.iter().flat_map(|&pixel| straight(pixel)).collect();
    let tag = if picture.is_srgb { ColorTag::Srgb } else { ColorTag::Untagged };
    png::encode8(&EncodedPicture { width, height, rgba }, tag)
}

/// Divides colours by alpha.
fn straight([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let divided = |c: u8| match a {
        0 => 0,
        u8::MAX => c,
        _ => ((u32::from(c) * 255 + u32::from(a) / 2) / u32::from(a)).min(255) as u8,
    };
    [divided(r), divided(g), divided(b), a]
}

/// The text of a scene file in `folder`, with paths relative to it; `None` on the web, which has no folders.
pub fn scene_file(settings: &SceneSettings, folder: Option<&Path>) -> String {
    match folder {
        Some(folder) => with_paths(settings, |path| seen_from(folder, path)),
        None => SceneFile::from(settings).to_toml_string(),
    }
}

/// The text of a scene file that can be read from any folder: its paths are absolute, except on the web.
pub fn scene_file_anywhere(settings: &SceneSettings) -> String {
    with_paths(settings, |path| match std::path::absolute(path) {
        // A pattern of faces (`sky_*.png`) is not a file.
        Ok(absolute) if absolute.parent().is_some_and(Path::exists) => absolute.to_string_lossy().into_owned(),
        _ => path.to_owned(),
    })
}

/// The text of a scene file with other paths to its models and images.
fn with_paths(settings: &SceneSettings, path: impl Fn(&str) -> String) -> String {
    let mut scene = SceneFile::from(settings);
    for object in scene.objects.iter_mut().filter(|object| !object.model.starts_with(BUILTIN)) {
        object.model = path(&object.model);
    }
    if let Some(environment) = &mut scene.environment {
        let names = std::iter::once(&mut environment.image).chain(&mut environment.background);
        for name in names.filter(|name| environment_file::builtin_of(name).is_none()) {
            *name = path(name);
        }
    }
    scene.to_toml_string()
}

/// Converts a path relative to the current folder to one relative to `folder`, or returns it unchanged if that fails.
fn seen_from(folder: &Path, file: &str) -> String {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // A pattern of faces (`sky_*.png`) is not a file, so only its folder is resolved.
    let path = Path::new(file);
    let (Some(parent), Some(name)) = (path.parent(), path.file_name()) else { return file.to_owned() };
    let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
    let (Ok(folder), Ok(parent)) = (folder.canonicalize(), parent.canonicalize()) else { return file.to_owned() };
    let common = folder.components().zip(parent.components()).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return file.to_owned();
    }
    let up = std::iter::repeat_n(Path::new("..").components(), folder.components().count() - common).flatten();
    let path: PathBuf = up.chain(parent.components().skip(common)).collect::<PathBuf>().join(name);
    // Scene files have forward slashes on every system.
    path.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_called_after_what_is_open() {
        assert_eq!(Product::Picture.file_name("suzanne.obj"), "suzanne.png");
        assert_eq!(Product::Scene.file_name("my model.tar.gz and 2 more"), "my_model.toml");
        assert_eq!(Product::Light.file_name(""), "scene.exr");
    }

    #[test]
    fn alpha_is_divided_out_of_the_colours() {
        assert_eq!(straight([64, 32, 0, 128]), [128, 64, 0, 128]);
        assert_eq!(straight([0, 0, 0, 0]), [0, 0, 0, 0]);
        assert_eq!(straight([7, 200, 255, 255]), [7, 200, 255, 255]);
    }

    #[test]
    fn too_few_bytes_are_an_error() {
        assert!(encode_png(&DisplayedPicture { size: [3, 2], rgba: vec![255; 4], is_srgb: true }).is_err());
    }

    #[test]
    fn files_are_named_as_seen_from_the_scene() {
        // Tests run in this crate's folder.
        assert_eq!(seen_from(Path::new("src"), "Cargo.toml"), "../Cargo.toml");
        assert_eq!(seen_from(Path::new("src/panels"), "src/lib.rs"), "../lib.rs");
        assert_eq!(seen_from(Path::new(""), "src/lib.rs"), "src/lib.rs");
        assert_eq!(seen_from(Path::new("src"), "src/sky_*.png"), "sky_*.png");
        assert_eq!(seen_from(Path::new("src"), "nowhere/a.obj"), "nowhere/a.obj");
        let here = std::env::current_dir().unwrap_or_else(|e| panic!("{e}"));
        let absolute = here.join("Cargo.toml").to_string_lossy().into_owned();
        assert_eq!(seen_from(Path::new("src"), &absolute), "../Cargo.toml");
    }
}
