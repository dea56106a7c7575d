//! Options that replace values of a scene.

use super::values::{self, BackgroundValue, BrdfValue};
use super::{EnvironmentOptions, LimitOptions};
use clap::{ArgAction, Args};
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_light::{Convention, Specular};
use gonio_scene::part_material::PartMaterial;
use gonio_scene::scene_file::{CameraSpec, LightSpec, MaterialOverride, Normals, Shading, UpAxis};
use gonio_scene::{SceneFile, TextureFilter};

/// Options that replace values of a scene. The same for every command that reads one.
#[derive(Args, Debug, Clone, Default)]
pub struct SceneOptions {
    /// Points at which the equation is evaluated.
    ///
    /// flat: at each pixel, with one normal per triangle; flat-per-face: once per triangle, at its centroid; gouraud: at
    /// the vertices, interpolating the light; phong: at each pixel, interpolating the normal.
    #[arg(long, help_heading = "Shading options", value_parser = values::named(Shading::ALL, Shading::name))]
    pub shading: Option<Shading>,
    /// Source of the normals: the file, one per triangle, or averages over adjacent faces.
    #[arg(long, help_heading = "Shading options", value_parser = values::named(Normals::ALL, Normals::name))]
    pub normals: Option<Normals>,
    /// Largest angle between faces whose normals are averaged, in degrees.
    #[arg(long, help_heading = "Shading options", value_name = "DEG", value_parser = values::crease_angle)]
    pub crease_angle: Option<f64>,
    /// Replace values of all materials.
    ///
    /// Colours: ambient, diffuse, specular, emitted. Numbers: shininess, refraction-index, opacity. Textures:
    /// textures=false. For environments: one of mirror, glass, water, ice, diamond and air, or single values: reflectivity,
    /// transmission, fresnel (none, exact, schlick), tint, absorption, dispersion, surfaces (one, two).
    #[arg(long, help_heading = "Shading options", value_name = "KEY=VALUE,...",
          value_parser = MaterialOverride::from_option_text)]
    pub material: Option<MaterialOverride>,
    /// Replace values of the materials of single parts. Repeatable.
    ///
    /// A part has its name in the model's file, the name of its material, or both as PART/MATERIAL; `gonio inspect` prints them.
    /// The values are those of --material, which they replace.
    #[arg(long, help_heading = "Shading options", value_name = "NAME:KEY=VALUE,...",
          value_parser = PartMaterial::from_option_text)]
    pub part: Vec<PartMaterial>,
    /// Texture filter.
    #[arg(long, help_heading = "Shading options", value_name = "FILTER",
          value_parser = values::named(TextureFilter::ALL, TextureFilter::name))]
    pub texture_filter: Option<TextureFilter>,

    /// Specular term.
    #[arg(long, help_heading = "Equation options", value_name = "MODEL",
          value_parser = values::named(Specular::ALL, Specular::name))]
    pub specular: Option<Specular>,
    /// BRDF that replaces the diffuse and the specular term.
    ///
    /// lambert, lafortune, blinn, phong or ward: with the colours and the shininess of the materials. Otherwise a model with
    /// parameters of its own in place of all materials: NAME:KEY=VALUE,... such as ggx:f0=1/0.8/0.3,alpha=0.2, or NAME: for
    /// its defaults; `gonio brdf list` prints all.
    #[arg(long, help_heading = "Equation options", value_name = "BRDF", value_parser = values::brdf)]
    pub brdf: Option<BrdfValue>,
    /// BRDF from a file in place of all materials.
    ///
    /// Fits (.toml), a MERL table (.binary), or a GLSL function (.brdf, .glsl); FILE:KEY=VALUE,... sets its parameters.
    #[arg(long, help_heading = "Equation options", value_name = "FILE", conflicts_with = "brdf")]
    pub brdf_file: Option<String>,
    /// Multiply the BRDF by the factor that conserves energy.
    #[arg(long, help_heading = "Equation options")]
    pub brdf_normalised: bool,
    /// Diffuse factor: 1 (lab), or 1/pi with radiometric lights (physical).
    #[arg(long, help_heading = "Equation options", value_parser = values::named(Convention::ALL, Convention::name))]
    pub convention: Option<Convention>,
    /// Multiply the specular term by <N.L>; =false switches that off.
    #[arg(long, help_heading = "Equation options", value_name = "BOOL", num_args = 0..=1, require_equals = true,
          default_missing_value = "true")]
    pub cosine_weighted: Option<bool>,
    /// Objects cast shadows; =false switches that off. Default: on in the physical convention.
    #[arg(long, help_heading = "Equation options", value_name = "BOOL", num_args = 0..=1, require_equals = true,
          default_missing_value = "true")]
    pub shadows: Option<bool>,
    /// Keep specular light where N.L <= 0, as the lab's own solutions do.
    #[arg(long, help_heading = "Equation options")]
    pub ungated: bool,
    /// Omit terms from the sum; attenuation and spot then count as 1.
    #[arg(long, help_heading = "Equation options", value_name = "TERM,...", value_delimiter = ',',
          value_parser = ["ambient", "emitted", "diffuse", "specular", "attenuation", "spot"])]
    pub without: Vec<String>,
    /// Turn the normals of back faces to the viewer.
    #[arg(long, help_heading = "Equation options", conflicts_with = "one_sided")]
    pub two_sided: bool,
    /// Light back faces with their normals unchanged.
    #[arg(long, help_heading = "Equation options")]
    pub one_sided: bool,

    /// A light that replaces the scene's lights; repeat it for several.
    ///
    /// KIND is ambient, directional, point, spot or rectangle. Keys: position, direction, radius, size, color, intensity,
    /// constant, linear, quadratic, inner-angle, outer-angle, name; motion=oscillate|circle|path with period, amplitude,
    /// center, axis, points.
    #[arg(long, help_heading = "Light options", value_name = "KIND KEY=VALUE ...", action = ArgAction::Append,
          value_parser = LightSpec::from_option_text)]
    pub light: Vec<LightSpec>,

    /// Camera of the model's file, by its name or its number (from 1).
    #[arg(long, help_heading = "Camera options", value_name = "NAME")]
    pub camera: Option<String>,
    /// Position of the eye in world space.
    #[arg(long, help_heading = "Camera options", value_name = "X,Y,Z", value_parser = values::vector,
          allow_hyphen_values = true)]
    pub camera_position: Option<[f64; 3]>,
    /// Point the camera looks at, in world space.
    #[arg(long, help_heading = "Camera options", value_name = "X,Y,Z", value_parser = values::vector,
          allow_hyphen_values = true, conflicts_with_all = ["yaw", "pitch"])]
    pub camera_target: Option<[f64; 3]>,
    /// Horizontal viewing direction in degrees: -90 looks along -Z.
    #[arg(long, help_heading = "Camera options", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true)]
    pub yaw: Option<f64>,
    /// Vertical viewing direction in degrees: positive looks up.
    #[arg(long, help_heading = "Camera options", value_name = "DEG", value_parser = values::number,
          allow_negative_numbers = true)]
    pub pitch: Option<f64>,
    /// Up direction: +Y (the default), +Z, -X, ... or a vector.
    #[arg(long, help_heading = "Camera options", value_name = "AXIS", value_parser = values::up,
          allow_hyphen_values = true)]
    pub up: Option<[f64; 3]>,
    /// The axis of all models that points up.
    ///
    /// They are turned, and the world's y stays up; `--up` turns the camera instead. Files of CAD programs and for 3D printers
    /// (STL) usually have z up, glTF has y.
    #[arg(long, help_heading = "Camera options", value_name = "AXIS", allow_hyphen_values = true,
          value_parser = values::named(UpAxis::ALL, UpAxis::name))]
    pub model_up: Option<UpAxis>,
    /// Full vertical field of view in degrees.
    #[arg(long, help_heading = "Camera options", value_name = "DEG", value_parser = values::field_of_view,
          allow_negative_numbers = true)]
    pub fov_y: Option<f64>,

    #[command(flatten)]
    pub surroundings: EnvironmentOptions,

    /// Size in pixels.
    #[arg(long, help_heading = "Picture options", value_name = "WxH", value_parser = values::size,
          allow_hyphen_values = true)]
    pub size: Option<(u32, u32)>,
    /// Samples per pixel: 1, 2, 4, 8 or 16.
    #[arg(long, help_heading = "Picture options", value_name = "N", value_parser = values::samples)]
    pub samples: Option<u32>,
    /// Encoding of colours: sRGB, or none, as in the lab's programs.
    #[arg(long, help_heading = "Picture options", value_parser = values::named(ColorEncoding::ALL, ColorEncoding::name))]
    pub color: Option<ColorEncoding>,
    /// Tone mapping of light above 1.
    #[arg(long, help_heading = "Picture options", value_name = "OPERATOR",
          value_parser = values::named(ToneMap::ALL, ToneMap::name))]
    pub tone_map: Option<ToneMap>,
    /// Exposure in stops.
    #[arg(long, help_heading = "Picture options", value_name = "STOPS", value_parser = values::number,
          allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    #[command(flatten)]
    pub limits: LimitOptions,

    /// Background: COLOR, TOP:BOTTOM or transparent.
    ///
    /// A colour is #rrggbb (sRGB), r,g,b or one number (linear).
    #[arg(long, help_heading = "Picture options", value_name = "COLOR", value_parser = values::background)]
    pub background: Option<BackgroundValue>,
}

impl SceneOptions {
    /// Replaces values of `scene` by those of the options; values of objects are set on all of them.
    pub fn apply(&self, scene: &mut SceneFile) {
        self.apply_to_objects(scene);
        self.apply_to_equation(scene);
        self.apply_to_camera(scene);
        self.apply_to_picture(scene);
        self.surroundings.apply(scene);
        if !self.light.is_empty() {
            scene.lights.clone_from(&self.light);
        }
    }

    fn apply_to_objects(&self, scene: &mut SceneFile) {
        for object in &mut scene.objects {
            set(&mut object.up, self.model_up);
            set(&mut object.shading, self.shading);
            set(&mut object.normals, self.normals);
            object.crease_angle = self.crease_angle.or(object.crease_angle);
            if let Some(material) = &self.material {
                object.material.replace_by(material);
            }
            for PartMaterial { part, material } in &self.part {
                object.parts.entry(part.clone()).or_default().replace_by(material);
            }
            let (model, file) = match &self.brdf {
                Some(BrdfValue::Model(text)) => (Some(text.clone()), None),
                _ => (None, self.brdf_file.clone()),
            };
            object.material.replace_brdf(model, file);
        }
    }

    fn apply_to_equation(&self, scene: &mut SceneFile) {
        let equation = &mut scene.equation;
        set(&mut equation.convention, self.convention);
        set(&mut equation.specular, self.specular);
        if let Some(BrdfValue::Equation(kind)) = self.brdf {
            equation.brdf = Some(kind);
        }
        equation.brdf_normalised |= self.brdf_normalised;
        equation.cosine_weighted = self.cosine_weighted.or(equation.cosine_weighted);
        equation.shadows = self.shadows.or(equation.shadows);
        equation.gated &= !self.ungated;
        equation.two_sided = (equation.two_sided || self.two_sided) && !self.one_sided;
        for term in &self.without {
            let switch = match term.as_str() {
                "ambient" => &mut equation.ambient,
                "emitted" => &mut equation.emitted,
                "diffuse" => &mut equation.diffuse,
                "specular" => &mut equation.specular_term,
                "attenuation" => &mut equation.attenuation,
                "spot" => &mut equation.spot,
                // The option's parser accepts no other name.
                _ => continue,
            };
            *switch = false;
        }
    }

    fn apply_to_camera(&self, scene: &mut SceneFile) {
        let camera = &mut scene.camera;
        camera.position = self.camera_position.or(camera.position);
        if self.camera.is_some() {
            // The file's camera replaces the scene's.
            *camera = CameraSpec { from_model: self.camera.clone(), ..CameraSpec::default() };
            camera.position = self.camera_position;
        }
        camera.up = self.up.or(camera.up);
        camera.fov_y = self.fov_y.or(camera.fov_y);
        // A direction is either a target or two angles: the option's form replaces the file's.
        if self.camera_target.is_some() {
            camera.target = self.camera_target;
            (camera.yaw, camera.pitch) = (None, None);
        }
        if self.yaw.is_some() || self.pitch.is_some() {
            camera.target = None;
            camera.yaw = self.yaw.or(camera.yaw);
            camera.pitch = self.pitch.or(camera.pitch);
        }
    }

    fn apply_to_picture(&self, scene: &mut SceneFile) {
        let picture = &mut scene.picture;
        if let Some((width, height)) = self.size {
            (picture.width, picture.height) = (width, height);
        }
        set(&mut picture.samples, self.samples);
        set(&mut picture.color, self.color);
        set(&mut picture.tone_map, self.tone_map);
        set(&mut picture.exposure, self.exposure);
        set(&mut picture.texture_filter, self.texture_filter);
        match self.background {
            None => {}
            Some(BackgroundValue::Transparent) => scene.background.transparent = true,
            Some(BackgroundValue::Colors(top, bottom)) => {
                scene.background.transparent = false;
                (scene.background.top, scene.background.bottom) = (top, bottom);
            }
        }
    }
}

fn set<T>(place: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *place = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::scene_file::ObjectSpec;

    #[test]
    fn no_options_change_nothing() {
        let mut scene = SceneFile { objects: vec![ObjectSpec::default()], ..SceneFile::default() };
        scene.camera.yaw = Some(3.0);
        scene.equation.two_sided = false;
        let before = scene.clone();
        SceneOptions::default().apply(&mut scene);
        assert_eq!(scene, before);
    }

    #[test]
    fn a_direction_replaces_its_other_form() {
        let mut scene = SceneFile::default();
        scene.camera.target = Some([1.0, 2.0, 3.0]);
        SceneOptions { yaw: Some(10.0), ..SceneOptions::default() }.apply(&mut scene);
        assert_eq!((scene.camera.target, scene.camera.yaw), (None, Some(10.0)));
        SceneOptions { camera_target: Some([0.0; 3]), ..SceneOptions::default() }.apply(&mut scene);
        assert_eq!((scene.camera.target, scene.camera.yaw), (Some([0.0; 3]), None));
    }

    #[test]
    fn every_term_can_be_omitted() {
        let mut scene = SceneFile::default();
        let without = ["ambient", "emitted", "diffuse", "specular", "attenuation", "spot"].map(String::from).to_vec();
        SceneOptions { without, ..SceneOptions::default() }.apply(&mut scene);
        let e = &scene.equation;
        assert!(![e.ambient, e.emitted, e.diffuse, e.specular_term, e.attenuation, e.spot].contains(&true));
    }

    #[test]
    fn options_change_all_objects() {
        let mut scene = SceneFile { objects: vec![ObjectSpec::default(); 2], ..SceneFile::default() };
        scene.objects[1].material.opacity = Some(0.5);
        SceneOptions {
            shading: Some(Shading::Flat),
            material: Some(MaterialOverride { shininess: Some(9.0), ..MaterialOverride::default() }),
            ..SceneOptions::default()
        }
        .apply(&mut scene);
        assert!(scene.objects.iter().all(|o| o.shading == Shading::Flat && o.material.shininess == Some(9.0)));
        assert_eq!(scene.objects[1].material.opacity, Some(0.5));
    }
}
