//! The scene file: what a person writes, and what `gonio scene` prints complete.
//!
//! Angles are degrees, lengths world units, colours linear RGB. Whatever is left out gets the
//! documented default; `gonio scene INPUT` prints the whole, with every default filled in.

use crate::color_value::Color;
use crate::defaults;
pub use crate::light_spec::{LightSourceKind, LightSpec, MotionKind, MotionSpec};
use crate::part_material::PartMaterials;
use crate::texture::TextureFilter;
use gonio_environment::Layout;
use gonio_light::brdf::BrdfKind;
use gonio_light::color::{ColorEncoding, ToneMap};
use gonio_light::named_enum;
use gonio_light::optics::Medium;
use gonio_light::{Convention, Fresnel, Specular, Surfaces};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

named_enum! {
    /// The points at which the equation is evaluated.
    pub enum Shading {
        /// One normal per triangle, the equation at every fragment.
        Flat = "flat",
        /// One normal per triangle, the equation once per triangle, at its centroid.
        FlatPerFace = "flat-per-face",
        /// The equation at the vertices, the light interpolated.
        Gouraud = "gouraud",
        /// The normal interpolated and renormalised, the equation at every fragment.
        Phong = "phong",
    }
    default Phong;
    what "shading";
}

named_enum! {
    /// The normals of a mesh.
    pub enum Normals {
        /// The file's; averaged where it has none.
        File = "file",
        /// One per triangle.
        Flat = "flat",
        /// Angle-weighted mean over adjacent faces; the file's are ignored.
        Averaged = "averaged",
    }
    default File;
    what "source of normals";
}

named_enum! {
    /// The axis of a model that points up.
    pub enum UpAxis {
        /// y, as in glTF and in the world.
        Y = "y",
        /// z, as in CAD, in files for 3D printers and in Blender.
        Z = "z",
        /// x.
        X = "x",
        /// -y.
        NegativeY = "-y",
        /// -z.
        NegativeZ = "-z",
        /// -x.
        NegativeX = "-x",
    }
    default Y;
    what "up axis";
}

/// A scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SceneFile {
    /// Size and encoding of the picture.
    pub picture: PictureSpec,
    /// The eye. What is left out is chosen so that all objects are in the picture.
    pub camera: CameraSpec,
    /// The colours behind the objects.
    pub background: BackgroundSpec,
    /// Light that comes from everywhere: what is seen behind the objects, in mirrors and through glass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub environment: Option<EnvironmentSpec>,
    /// The form of the light equation.
    pub equation: EquationSpec,
    /// The models.
    #[serde(rename = "object")]
    pub objects: Vec<ObjectSpec>,
    /// The lights; without any, those of the models' files; where these have none either, a key, a fill and a rim
    /// light and a little ambient.
    #[serde(rename = "light")]
    pub lights: Vec<LightSpec>,
}

/// Size and encoding of the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PictureSpec {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Samples per pixel: 1, 2, 4, 8 or 16 (OpenGL: at most what the driver has).
    pub samples: u32,
    /// sRGB or direct.
    pub color: ColorEncoding,
    /// None, Reinhard, ACES or AgX.
    pub tone_map: ToneMap,
    /// Stops.
    pub exposure: f64,
    /// The filter of textures.
    pub texture_filter: TextureFilter,
}

impl Default for PictureSpec {
    fn default() -> Self {
        PictureSpec {
            width: 1024,
            height: 768,
            samples: 4,
            color: ColorEncoding::Srgb,
            tone_map: ToneMap::None,
            exposure: 0.0,
            texture_filter: TextureFilter::Anisotropic,
        }
    }
}

/// The eye: `position` and either `target`, or `yaw` and `pitch`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraSpec {
    /// A camera of a model's file, by its name or (from 1) its number; what else is given here replaces its values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from_model: Option<String>,
    /// World space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<[f64; 3]>,
    /// The point looked at, world space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<[f64; 3]>,
    /// Degrees; -90 looks along -Z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw: Option<f64>,
    /// Degrees; positive looks up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
    /// The up direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::UP))]
    pub up: Option<[f64; 3]>,
    /// Full vertical field of view in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("default" = defaults::FOV_Y))]
    pub fov_y: Option<f64>,
    /// Distance of the near plane; left out, it is chosen so that no object is cut off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near: Option<f64>,
    /// Distance of the far plane; left out, it is chosen so that no object is cut off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub far: Option<f64>,
}

/// The colours behind the objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BackgroundSpec {
    /// At the top edge of the picture.
    pub top: Color,
    /// At the bottom edge of the picture; between them linear in light.
    pub bottom: Color,
    /// Whether the background is transparent: the picture gets an alpha channel.
    pub transparent: bool,
}

impl Default for BackgroundSpec {
    /// Mid-grey (sRGB 128 is 0.216), a little darker above than below.
    fn default() -> Self {
        BackgroundSpec { top: Color::grey(0.16), bottom: Color::grey(0.28), transparent: false }
    }
}

/// Light from all directions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentSpec {
    /// `debug`, `sky`, `room`; or a panorama, a cross, a strip, a KTX2 or DDS cubemap, a folder of six faces, one of six
    /// faces, or a pattern such as `sky_*.png`: relative to the scene file.
    pub image: String,
    /// The layout of the faces; by default photographic for six files, a cross or a strip, and OpenGL's for KTX2 and
    /// DDS.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layout: Option<Layout>,
    /// Texels along an edge of the cubemap that a panorama is made into; left out, about as fine as the panorama is, and
    /// at most 1024.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<u32>,
    /// Yaw, pitch and roll in degrees: turned about Z (roll), then X (pitch), then Y (yaw). A positive yaw turns what is
    /// straight ahead to the left, a positive pitch upwards.
    pub rotate: [f64; 3],
    /// The factor of its radiance.
    pub intensity: f64,
    /// Whether it lights the objects: diffuse light and glossy reflection. By default it does if the scene has no
    /// lights of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub light: Option<bool>,
    /// Whether it is seen behind the objects.
    pub visible: bool,
    /// Blur of the background, 0 to 1.
    pub blur: f64,
    /// Another environment, seen behind the objects; it has the same rotation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<String>,
}

impl Default for EnvironmentSpec {
    fn default() -> Self {
        EnvironmentSpec {
            image: String::new(),
            layout: None,
            size: None,
            rotate: [0.0; 3],
            intensity: 1.0,
            light: None,
            visible: true,
            blur: 0.0,
            background: None,
        }
    }
}

/// The form of the light equation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EquationSpec {
    /// Lab or physical.
    pub convention: Convention,
    /// None, Phong or Blinn-Phong.
    pub specular: Specular,
    /// A BRDF of Appendix 6 in place of both terms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub brdf: Option<BrdfKind>,
    /// The BRDF with the factor that keeps its energy in bounds.
    pub brdf_normalised: bool,
    /// Diagonal of Lafortune's matrix in (tangent, bitangent, normal).
    pub lafortune: [f64; 3],
    /// No specular light where N.L <= 0.
    pub gated: bool,
    /// Whether the specular term is weighted by <N.L>; by default in the physical convention only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cosine_weighted: Option<bool>,
    /// Whether objects cast shadows: the light of a directional light, a point light or a spot reaches only what it sees.
    /// By default in the physical convention only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shadows: Option<bool>,
    /// The normal is turned to the viewer on back faces.
    pub two_sided: bool,
    /// Whether `A` is added.
    pub ambient: bool,
    /// Whether `E` is added.
    pub emitted: bool,
    /// Whether the diffuse term is added.
    pub diffuse: bool,
    /// Whether the specular term is added.
    pub specular_term: bool,
    /// Whether `att` is applied (otherwise it is 1).
    pub attenuation: bool,
    /// Whether `spot` is applied (otherwise it is 1).
    pub spot: bool,
}

impl Default for EquationSpec {
    fn default() -> Self {
        EquationSpec {
            convention: Convention::Lab,
            specular: Specular::BlinnPhong,
            brdf: None,
            brdf_normalised: false,
            lafortune: [1.0, 1.0, -1.0],
            gated: true,
            cosine_weighted: None,
            shadows: None,
            two_sided: true,
            ambient: true,
            emitted: true,
            diffuse: true,
            specular_term: true,
            attenuation: true,
            spot: true,
        }
    }
}

/// A model in the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ObjectSpec {
    /// A file, relative to the scene file, or `builtin:NAME`; `builtin:sphere-N` has N triangles: 8, 32, ... 8 f².
    pub model: String,
    /// The name in reports and debug groups; the model's file name by default.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// The axis of the model that points up; it is turned to y first of all.
    pub up: UpAxis,
    /// Applied last.
    pub translate: [f64; 3],
    /// Degrees about x, then y, then z (the world's axes).
    pub rotate: [f64; 3],
    /// Applied before the rotation, per axis.
    pub scale: [f64; 3],
    /// The points at which the equation is evaluated.
    pub shading: Shading,
    /// The normals of the mesh.
    pub normals: Normals,
    /// The largest angle, in degrees, between faces whose normals are averaged, for averaged normals; by default 180,
    /// which averages all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crease_angle: Option<f64>,
    /// Its motion, of the translation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionSpec>,
    /// Values that replace those of the model's materials.
    #[serde(skip_serializing_if = "MaterialOverride::is_empty")]
    pub material: MaterialOverride,
    /// Values that replace those of single parts, in tables by their names in the model's file: of a part (an object or a
    /// group), of a material, or of both (`PART/MATERIAL`).
    #[serde(skip_serializing_if = "PartMaterials::is_empty")]
    pub parts: PartMaterials,
}

impl ObjectSpec {
    /// Moves the object; a path moves with it.
    pub fn move_to(&mut self, translate: [f64; 3]) {
        let way = [0, 1, 2].map(|axis| translate[axis] - self.translate[axis]);
        for point in self.motion.iter_mut().flat_map(|motion| &mut motion.points).flatten() {
            *point = [0, 1, 2].map(|axis| point[axis] + way[axis]);
        }
        self.translate = translate;
        self.start_on_path();
    }

    /// An object on a path starts at the path's first point.
    pub(crate) fn start_on_path(&mut self) {
        let first = self.motion.as_ref().and_then(|motion| motion.points.as_ref()?.first());
        self.translate = *first.unwrap_or(&self.translate);
    }
}

impl Default for ObjectSpec {
    fn default() -> Self {
        ObjectSpec {
            model: String::new(),
            name: String::new(),
            up: UpAxis::Y,
            translate: [0.0; 3],
            rotate: [0.0; 3],
            scale: [1.0; 3],
            shading: Shading::Phong,
            normals: Normals::File,
            crease_angle: None,
            motion: None,
            material: MaterialOverride::default(),
            parts: PartMaterials::default(),
        }
    }
}

/// Values that replace those of the model's materials. A colour that is given here is not multiplied
/// by the model's texture for it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MaterialOverride {
    /// `k_a`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ambient: Option<Color>,
    /// `k_d`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diffuse: Option<Color>,
    /// The reflectance in place of `diffuse`: wavelengths in nm, rising, and shares of 0 to 1. `k_d` is its colour in
    /// daylight.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diffuse_spectrum: Option<Vec<[f64; 2]>>,
    /// `k_s`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub specular: Option<Color>,
    /// `E`
    #[serde(skip_serializing_if = "Option::is_none")]
    pub emitted: Option<Color>,
    /// `gamma`, at least 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shininess: Option<f64>,
    /// Greater than 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refraction_index: Option<f64>,
    /// 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opacity: Option<f64>,
    /// Whether the model's textures are used at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub textures: Option<bool>,
    /// A clear body of this medium: its index of refraction, transmission 1 and exact Fresnel factors, unless other
    /// values are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub medium: Option<Medium>,
    /// The share of the mirror, from the lit surface (0) to a mirror (1) of the environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reflectivity: Option<f64>,
    /// The share of the clear surface, from opaque (0) to clear (1), through which the environment is seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transmission: Option<f64>,
    /// The Fresnel factor: none, exact or Schlick's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fresnel: Option<Fresnel>,
    /// The colour of transmitted light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tint: Option<Color>,
    /// Absorption in a body with two refracting surfaces, per world unit and channel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absorption: Option<Color>,
    /// A model of reflection in place of `diffuse`, `specular`, `shininess` and their textures: `NAME` or
    /// `NAME:key=value,...`, for example `ggx:f0=1/0.8/0.3,alpha=0.2`; `gonio brdf list` prints all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub brdf: Option<String>,
    /// A file in place of `brdf`, relative to the scene file: fits (.toml), a MERL table (.binary), or a function in GLSL
    /// (.brdf, .glsl). `FILE:key=value,...` sets its parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub brdf_file: Option<String>,
    /// The index of refraction for blue minus that for red.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dispersion: Option<f64>,
    /// The refracting surfaces: one, as in the lab, or two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<Surfaces>,
}

impl MaterialOverride {
    /// Whether nothing is replaced.
    pub fn is_empty(&self) -> bool {
        *self == MaterialOverride::default()
    }
}
