//! Options about the environment of a scene.

use super::values;
use clap::Args;
use gonio_environment::Layout;
use gonio_scene::SceneFile;
use gonio_scene::scene_file::EnvironmentSpec;

/// Options about the environment of a scene.
#[derive(Args, Debug, Clone, Default)]
#[command(next_help_heading = "Environment options")]
pub struct EnvironmentOptions {
    /// Environment around the scene: debug, sky, room, or files.
    ///
    /// Files: a panorama, a cross, a strip, a .ktx2 or .dds cubemap, a folder of six faces, one of six faces, or a pattern
    /// such as "sky_*.png".
    #[arg(long, value_name = "FILE")]
    pub environment: Option<String>,
    /// Layout of the faces in files.
    ///
    /// By default photographic, and opengl for .ktx2 and .dds. `gonio help environment convert` explains both.
    #[arg(long, value_name = "LAYOUT", value_parser = values::named(Layout::ALL, Layout::name))]
    pub environment_layout: Option<Layout>,
    /// Texels along an edge of the cubemap that a panorama is converted to.
    #[arg(long, value_name = "N", value_parser = values::cubemap_size)]
    pub environment_size: Option<u32>,
    /// Rotate the environment, in degrees.
    ///
    /// A positive yaw rotates the part ahead to the left, a positive pitch rotates it up.
    #[arg(long, value_name = "YAW,PITCH,ROLL", value_parser = values::angles, allow_hyphen_values = true)]
    pub environment_rotate: Option<[f64; 3]>,
    /// Multiply the environment's light.
    #[arg(long, value_name = "FACTOR", value_parser = values::not_negative, allow_negative_numbers = true)]
    pub environment_intensity: Option<f64>,
    /// Light the objects with the environment; =false prevents it.
    ///
    /// By default the environment lights scenes that have no lights.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub environment_light: Option<bool>,
    /// Show the environment behind the objects; =false hides it.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    pub environment_visible: Option<bool>,
    /// Blur the environment behind the objects, 0 to 1.
    #[arg(long, value_name = "SHARE", value_parser = values::share, allow_negative_numbers = true)]
    pub environment_blur: Option<f64>,
    /// Show another environment behind the objects.
    #[arg(long, value_name = "FILE")]
    pub environment_background: Option<String>,
}

impl EnvironmentOptions {
    /// The environments that the user names.
    pub fn named(&self) -> impl Iterator<Item = &str> {
        self.environment.iter().chain(&self.environment_background).map(String::as_str)
    }

    /// Replaces values of `scene` by those of the options. Without `--environment` they change the scene's environment; a scene
    /// without one is then rejected by its own check.
    pub fn apply(&self, scene: &mut SceneFile) {
        if let Some(image) = &self.environment {
            // The layout and size in the scene file belong to its own picture.
            let before = scene.environment.take().unwrap_or_default();
            scene.environment = Some(EnvironmentSpec { image: image.clone(), layout: None, size: None, ..before });
        } else if self.changes_something() {
            scene.environment.get_or_insert_default();
        }
        let Some(spec) = &mut scene.environment else { return };
        spec.layout = self.environment_layout.or(spec.layout);
        spec.size = self.environment_size.or(spec.size);
        spec.rotate = self.environment_rotate.unwrap_or(spec.rotate);
        spec.intensity = self.environment_intensity.unwrap_or(spec.intensity);
        spec.light = self.environment_light.or(spec.light);
        spec.visible = self.environment_visible.unwrap_or(spec.visible);
        spec.blur = self.environment_blur.unwrap_or(spec.blur);
        spec.background = self.environment_background.clone().or(spec.background.take());
    }

    fn changes_something(&self) -> bool {
        self.environment_layout.is_some()
            || self.environment_size.is_some()
            || self.environment_rotate.is_some()
            || self.environment_intensity.is_some()
            || self.environment_light.is_some()
            || self.environment_visible.is_some()
            || self.environment_blur.is_some()
            || self.environment_background.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_picture_keeps_the_values_that_do_not_depend_on_it() {
        let before = EnvironmentSpec {
            image: "old.ktx2".into(),
            layout: Some(Layout::OpenGl),
            size: Some(64),
            intensity: 2.0,
            ..EnvironmentSpec::default()
        };
        let mut scene = SceneFile { environment: Some(before), ..SceneFile::default() };
        EnvironmentOptions { environment: Some("room".into()), ..EnvironmentOptions::default() }.apply(&mut scene);
        let spec = scene.environment.clone().unwrap_or_default();
        assert_eq!((spec.image.as_str(), spec.layout, spec.size, spec.intensity), ("room", None, None, 2.0));

        let mut bare = SceneFile::default();
        EnvironmentOptions::default().apply(&mut bare);
        assert_eq!(bare, SceneFile::default());
        EnvironmentOptions { environment_blur: Some(0.5), ..EnvironmentOptions::default() }.apply(&mut bare);
        // The scene's own check reports this.
        assert!(gonio_scene::validate::check(&bare).is_err_and(|p| p.message.contains("`image`")));
    }
}
