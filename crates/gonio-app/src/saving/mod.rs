//! Saving of pictures and scenes.

pub mod png;
mod scene_file;

pub use scene_file::scene_file;

/// Something to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// The current pane's picture as it is shown, in its size there.
    Picture,
    /// The same in the size that the scene says (`[picture]`).
    SizedPicture,
    /// The current pane's light, linear, in its size there.
    Light,
    /// The scene.
    Scene,
}

impl Product {
    /// All.
    pub const ALL: [Product; 4] = [Product::Picture, Product::SizedPicture, Product::Light, Product::Scene];

    /// Kebab-case, for widgets' ids.
    pub fn id(self) -> &'static str {
        match self {
            Product::Picture => "picture",
            Product::SizedPicture => "sized-picture",
            Product::Light => "light",
            Product::Scene => "scene",
        }
    }

    /// The title in menus.
    pub fn title(self) -> &'static str {
        match self {
            Product::Picture => "Picture as displayed (PNG)",
            Product::SizedPicture => "Picture at the scene's resolution (PNG)",
            Product::Light => "Linear light (EXR)",
            Product::Scene => "Scene (TOML)",
        }
    }

    /// The file name extension.
    pub fn extension(self) -> &'static str {
        match self {
            Product::Picture | Product::SizedPicture => "png",
            Product::Light => "exr",
            Product::Scene => "toml",
        }
    }

    /// A name for its file, after what is open.
    pub fn file_name(self, title: &str) -> String {
        let stem = title.split(" and ").next().unwrap_or(title);
        let stem = stem.split('.').next().unwrap_or(stem);
        let stem: String = stem.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect();
        let stem = if stem.is_empty() { "scene" } else { stem.as_str() };
        format!("{stem}.{}", self.extension())
    }
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
}
