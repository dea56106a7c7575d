//! The scene as a file, with its files named as seen from there.

use gonio_scene::environment_file;
use gonio_scene::files::BUILTIN;
use gonio_scene::{SceneFile, SceneSettings};
use std::path::{Path, PathBuf};

/// The text of a scene file that will lie in `folder`; `None` where there are no folders, as on the web.
pub fn scene_file(settings: &SceneSettings, folder: Option<&Path>) -> String {
    let mut scene = SceneFile::from(settings);
    if let Some(folder) = folder {
        for object in scene.objects.iter_mut().filter(|object| !object.model.starts_with(BUILTIN)) {
            object.model = seen_from(folder, &object.model);
        }
        if let Some(environment) = &mut scene.environment {
            let names = std::iter::once(&mut environment.image).chain(&mut environment.background);
            for name in names.filter(|name| environment_file::builtin_of(name).is_none()) {
                *name = seen_from(folder, name);
            }
        }
    }
    scene.to_toml_string()
}

/// Converts a path relative to the current folder to one relative to `folder`, or returns it unchanged if that fails.
fn seen_from(folder: &Path, file: &str) -> String {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // A pattern of faces (`sky_*.png`) is no file: its folder is.
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
    fn files_are_named_as_seen_from_the_scene() {
        // Tests run in this crate's folder.
        assert_eq!(seen_from(Path::new("src"), "Cargo.toml"), "../Cargo.toml");
        assert_eq!(seen_from(Path::new("src/saving"), "src/lab.rs"), "../lab.rs");
        assert_eq!(seen_from(Path::new(""), "src/lab.rs"), "src/lab.rs");
        assert_eq!(seen_from(Path::new("src"), "src/sky_*.png"), "sky_*.png");
        assert_eq!(seen_from(Path::new("src"), "nowhere/a.obj"), "nowhere/a.obj");
        let here = std::env::current_dir().unwrap_or_else(|e| panic!("{e}"));
        let absolute = here.join("Cargo.toml").to_string_lossy().into_owned();
        assert_eq!(seen_from(Path::new("src"), &absolute), "../Cargo.toml");
    }
}
