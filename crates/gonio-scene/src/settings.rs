//! The settings of a complete scene: a [`SceneFile`] with every default filled in.
//!
//! A value is optional here only where a scene can do without it: a light that does not move has no motion.

use crate::camera::Camera;
use crate::defaults;
pub use crate::light_settings::{LightSettings, Motion, MotionPath};
use crate::scene_file::{
    BackgroundSpec, CameraSpec, EnvironmentSpec, EquationSpec, LightSpec, ObjectSpec, PictureSpec, SceneFile,
};
use glam::DVec3;
use gonio_environment::Layout;
use gonio_light::brdf::BrdfKind;
use gonio_light::{Convention, Specular};

/// The part of a scene that is not read from its models and pictures. Units and spaces are those of [`SceneFile`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneSettings {
    /// Size and encoding of the picture.
    pub picture: PictureSpec,
    /// The camera.
    pub camera: CameraSettings,
    /// The colours behind the objects.
    pub background: BackgroundSpec,
    /// The environment; `None` where there is none.
    pub environment: Option<EnvironmentSettings>,
    /// The form of the light equation.
    pub equation: EquationSettings,
    /// The models, at least one. Every object has a name.
    pub objects: Vec<ObjectSpec>,
    /// The lights; there may be none.
    pub lights: Vec<LightSettings>,
}

/// The target or the direction of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// A point, world space.
    Target([f64; 3]),
    /// A direction, degrees. Yaw -90 and pitch 0 look along -Z.
    Angles {
        /// Around the vertical axis.
        yaw: f64,
        /// Positive looks up.
        pitch: f64,
    },
}

/// A camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraSettings {
    /// The eye, world space.
    pub position: [f64; 3],
    /// The target or the direction.
    pub aim: Aim,
    /// The up direction, world space.
    pub up: [f64; 3],
    /// Full vertical field of view, degrees.
    pub fov_y: f64,
    /// Distance of the near plane, world units.
    pub near: f64,
    /// Distance of the far plane, world units.
    pub far: f64,
}

impl Default for CameraSettings {
    /// At the origin, looking along -Z.
    fn default() -> Self {
        CameraSettings {
            position: [0.0; 3],
            aim: Aim::Angles { yaw: defaults::YAW, pitch: defaults::PITCH },
            up: defaults::UP,
            fov_y: defaults::FOV_Y,
            near: defaults::NEAR,
            far: defaults::FAR,
        }
    }
}

impl CameraSettings {
    /// The point looked at; `None` where the camera looks along angles.
    pub fn target(&self) -> Option<[f64; 3]> {
        match self.aim {
            Aim::Target(target) => Some(target),
            Aim::Angles { .. } => None,
        }
    }

    /// The camera with its axes.
    pub fn to_camera(&self) -> Camera {
        let position = DVec3::from(self.position);
        let direction = match self.aim {
            Aim::Target(target) => DVec3::from(target) - position,
            Aim::Angles { yaw, pitch } => Camera::direction_of(yaw, pitch),
        };
        Camera::looking_along(position, direction, self.up.into(), self.fov_y.to_radians(), self.near, self.far)
    }
}

/// An environment.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentSettings {
    /// The name or the path of the picture.
    pub image: String,
    /// The layout of its faces; `None` where it has no faces, or image and background differ in it.
    pub layout: Option<Layout>,
    /// Texels along an edge of the cubemap; `None` where image and background differ in it, or before it is read.
    pub size: Option<u32>,
    /// Yaw, pitch and roll, degrees.
    pub rotate: [f64; 3],
    /// The factor of its radiance.
    pub intensity: f64,
    /// Whether it lights the objects.
    pub light: bool,
    /// Whether it is seen behind the objects.
    pub visible: bool,
    /// Blur of the background, 0 to 1.
    pub blur: f64,
    /// Another environment, seen behind the objects.
    pub background: Option<String>,
}

impl Default for EnvironmentSettings {
    /// One that does not light the objects.
    fn default() -> Self {
        EnvironmentSettings::new(EnvironmentSpec::default(), false)
    }
}

impl EnvironmentSettings {
    /// The environment of a scene file. `lights` is the default of whether it lights the objects.
    pub fn new(spec: EnvironmentSpec, lights: bool) -> Self {
        let EnvironmentSpec { image, layout, size, rotate, intensity, light, visible, blur, background } = spec;
        let light = light.unwrap_or(lights);
        EnvironmentSettings { image, layout, size, rotate, intensity, light, visible, blur, background }
    }
}

impl SceneFile {
    /// Replaces the image of the environment. Its rotation, its intensity and its use stay.
    pub fn set_environment(&mut self, image: &str) {
        let before = self.environment.take().unwrap_or_default();
        let image = image.to_owned();
        self.environment = Some(EnvironmentSpec { image, layout: None, size: None, background: None, ..before });
    }
}

impl SceneSettings {
    /// Replaces the image of the environment. Its rotation, its intensity and its use stay.
    pub fn set_environment(&mut self, image: &str) {
        let before = self.environment.take();
        let before = before
            .unwrap_or_else(|| EnvironmentSettings { light: self.lights.is_empty(), ..EnvironmentSettings::default() });
        let image = image.to_owned();
        self.environment = Some(EnvironmentSettings { image, layout: None, size: None, background: None, ..before });
    }
}

/// The form of the light equation. The fields are those of [`EquationSpec`].
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "documented in EquationSpec")]
pub struct EquationSettings {
    pub convention: Convention,
    pub specular: Specular,
    pub brdf: Option<BrdfKind>,
    pub brdf_normalised: bool,
    pub lafortune: [f64; 3],
    pub gated: bool,
    pub cosine_weighted: bool,
    pub shadows: bool,
    pub two_sided: bool,
    pub ambient: bool,
    pub emitted: bool,
    pub diffuse: bool,
    pub specular_term: bool,
    pub attenuation: bool,
    pub spot: bool,
}

impl Default for EquationSettings {
    fn default() -> Self {
        EquationSpec::default().into()
    }
}

impl From<EquationSpec> for EquationSettings {
    fn from(spec: EquationSpec) -> Self {
        let cosine_weighted = spec.cosine_weighted.unwrap_or(defaults::cosine_weighted(spec.convention));
        EquationSettings {
            convention: spec.convention,
            specular: spec.specular,
            brdf: spec.brdf,
            brdf_normalised: spec.brdf_normalised,
            lafortune: spec.lafortune,
            gated: spec.gated,
            cosine_weighted,
            shadows: spec.shadows.unwrap_or(defaults::shadows(spec.convention)),
            two_sided: spec.two_sided,
            ambient: spec.ambient,
            emitted: spec.emitted,
            diffuse: spec.diffuse,
            specular_term: spec.specular_term,
            attenuation: spec.attenuation,
            spot: spec.spot,
        }
    }
}

/// The scene file in which everything is written out.
impl From<&SceneSettings> for SceneFile {
    fn from(settings: &SceneSettings) -> Self {
        SceneFile {
            picture: settings.picture.clone(),
            camera: (&settings.camera).into(),
            background: settings.background.clone(),
            environment: settings.environment.as_ref().map(EnvironmentSpec::from),
            equation: (&settings.equation).into(),
            objects: settings.objects.clone(),
            lights: settings.lights.iter().map(LightSpec::from).collect(),
        }
    }
}

impl From<&CameraSettings> for CameraSpec {
    fn from(camera: &CameraSettings) -> Self {
        let (yaw, pitch) = match camera.aim {
            Aim::Target(_) => (None, None),
            Aim::Angles { yaw, pitch } => (Some(yaw), Some(pitch)),
        };
        CameraSpec {
            from_model: None,
            position: Some(camera.position),
            target: camera.target(),
            yaw,
            pitch,
            up: Some(camera.up),
            fov_y: Some(camera.fov_y),
            near: Some(camera.near),
            far: Some(camera.far),
        }
    }
}

impl From<&EnvironmentSettings> for EnvironmentSpec {
    fn from(environment: &EnvironmentSettings) -> Self {
        let EnvironmentSettings { image, layout, size, rotate, intensity, light, visible, blur, background } =
            environment.clone();
        EnvironmentSpec { image, layout, size, rotate, intensity, light: Some(light), visible, blur, background }
    }
}

impl From<&EquationSettings> for EquationSpec {
    fn from(equation: &EquationSettings) -> Self {
        EquationSpec {
            convention: equation.convention,
            specular: equation.specular,
            brdf: equation.brdf,
            brdf_normalised: equation.brdf_normalised,
            lafortune: equation.lafortune,
            gated: equation.gated,
            cosine_weighted: Some(equation.cosine_weighted),
            shadows: Some(equation.shadows),
            two_sided: equation.two_sided,
            ambient: equation.ambient,
            emitted: equation.emitted,
            diffuse: equation.diffuse,
            specular_term: equation.specular_term,
            attenuation: equation.attenuation,
            spot: equation.spot,
        }
    }
}
