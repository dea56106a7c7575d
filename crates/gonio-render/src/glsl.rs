//! GLSL, composed once: a header for the dialect, constants generated from Rust, then the files.

mod material_function;
mod output;
mod special;
mod surroundings;

pub use material_function::{FunctionId, MERL_WIDTH, MaterialFunction, MaterialFunctions};
pub use output::{Display, OutputKey, difference_sources, presentation_sources};
pub use special::{OVERDRAW_SCALE, SpecialProgram};
pub use surroundings::{SurfaceOptics, SurroundingsKey, sky_sources};

use crate::body::LEAF_STEP;
use crate::shader_text::shader_text;
use gonio_bsdf::merl;
use gonio_environment::small_lights;
use gonio_gl::Dialect;
use gonio_light::brdf::{self, BrdfKind};
use gonio_light::color::{self, ColorEncoding, ToneMap};
use gonio_light::light::Attenuation;
use gonio_light::optics::{self, Fresnel};
use gonio_light::{Quantity, Specular, function_light, microfacet, vector};
use gonio_scene::scene::HOLE_OPACITY;
use gonio_scene::scene_file::Shading;
use output::{DISPLAY_LIGHT, tone_map_define};
use std::fmt::Write;

/// Texels of one light in the light table.
pub const LIGHT_TEXELS: usize = 4;
/// Lights in one row of the light table: 1024 texels, half of what every WebGL2 has.
pub const LIGHTS_PER_ROW: usize = 256;
/// Most lights that are passed in uniforms: 64 of the 224 vectors that every WebGL2 has. Reading a
/// texture costs a software driver several times as much as reading a uniform.
pub const LIGHTS_IN_UNIFORMS: usize = 16;
/// Most lights that are summed one by one, without a loop: `lighting.glsl` has as many statements.
pub const LIGHTS_UNROLLED: usize = 4;
/// Texels in one row of the table of an object's body: the least maximum of WebGL2.
pub const BODY_ROW: usize = 2048;
/// Depths within this many widths of a shadow map's texels are the same surface. Less leaves dark lines where surfaces
/// meet; more parts shadows of thin sheets from them.
pub const SHADOW_BIAS_TEXELS: f64 = 1.5;
/// Kinds of light in the light table.
pub const LIGHT_DIRECTIONAL: i32 = 0;
/// A point light.
pub const LIGHT_POINT: i32 = 1;
/// A spot.
pub const LIGHT_SPOT: i32 = 2;

/// The texture units: one for each texture of a material, the lights, and the environment. 16 are guaranteed.
pub const TEXTURE_UNITS: [(&str, u32); 15] = [
    ("diffuse_map", 0),
    ("specular_map", 1),
    ("emitted_map", 2),
    ("shininess_map", 3),
    ("opacity_map", 4),
    ("normal_map", 5),
    ("light_table", 6),
    ("environment_map", 7),
    ("glossy_map", 8),
    ("environment_brdf", 9),
    ("body_table", 10),
    ("shadow_atlas", 11),
    ("shadow_table", 12),
    ("merl_table", 13),
    ("function_map", 14),
];

/// The unit of a sampler by its name in GLSL.
pub fn texture_unit(sampler: &str) -> u32 {
    TEXTURE_UNITS.iter().find(|(name, _)| *name == sampler).map_or(0, |(_, unit)| *unit)
}

/// The locations of vertex attributes, the same in all programs.
pub const ATTRIBUTES: [(u32, &str); 6] =
    [(0, "position"), (1, "normal"), (2, "tex_coord"), (3, "tangent"), (4, "color"), (5, "face_center")];

/// The reflection of a surface: the specular terms of the lab's equation and the BRDFs in one list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reflectance {
    /// The lab's equation.
    Lab(Specular),
    /// The form of Appendix 6.
    Brdf(BrdfKind),
    /// The material's own BRDF.
    Material(FunctionId),
}

impl Reflectance {
    /// All values but the BRDFs of materials.
    pub fn all() -> Vec<Reflectance> {
        let lab = Specular::ALL.iter().map(|&s| Reflectance::Lab(s));
        lab.chain(BrdfKind::ALL.iter().map(|&b| Reflectance::Brdf(b))).collect()
    }

    fn define(self) -> &'static str {
        match self {
            Reflectance::Lab(Specular::None) => "REFLECTANCE_NONE",
            Reflectance::Lab(Specular::Phong) => "REFLECTANCE_PHONG",
            Reflectance::Lab(Specular::BlinnPhong) => "REFLECTANCE_BLINN_PHONG",
            Reflectance::Brdf(BrdfKind::Lambert) => "REFLECTANCE_LAMBERT",
            Reflectance::Brdf(BrdfKind::Lafortune) => "REFLECTANCE_LAFORTUNE",
            Reflectance::Brdf(BrdfKind::Blinn) => "REFLECTANCE_BLINN",
            Reflectance::Brdf(BrdfKind::Phong) => "REFLECTANCE_PHONG_BRDF",
            Reflectance::Brdf(BrdfKind::Ward) => "REFLECTANCE_WARD",
            Reflectance::Material(_) => "REFLECTANCE_MATERIAL",
        }
    }
}

impl Reflectance {
    /// The GLSL function of a BRDF's specular lobe.
    fn lobe(self) -> &'static str {
        match self {
            Reflectance::Lab(_) | Reflectance::Brdf(BrdfKind::Lambert) | Reflectance::Material(_) => "lambert_lobe",
            Reflectance::Brdf(BrdfKind::Lafortune) => "lafortune_lobe",
            Reflectance::Brdf(BrdfKind::Blinn) => "blinn_lobe",
            Reflectance::Brdf(BrdfKind::Phong) => "phong_lobe",
            Reflectance::Brdf(BrdfKind::Ward) => "ward_lobe",
        }
    }
}

/// The textures of a material that a program samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapSet {
    /// None.
    None,
    /// `map_Kd`: by far the most frequent.
    Diffuse,
    /// All; missing ones are white.
    All,
}

/// The variant of a scene program. Choices are made here rather than by uniforms if a branch would be expensive: a software
/// driver executes both sides of a branch on a uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SceneKey {
    /// The shading.
    pub shading: Shading,
    /// The reflection.
    pub reflectance: Reflectance,
    /// The textures.
    pub maps: MapSet,
    /// Normals from a texture (Phong shading only).
    pub normal_map: bool,
    /// Whether the vertices have colours.
    pub vertex_colors: bool,
    /// Whether back faces are lit from behind.
    pub two_sided: bool,
    /// Whether a debug view is drawn.
    pub view: bool,
    /// The storage of the lights, and the form of the loops over them.
    pub lights: LightLoops,
    /// Whether lights have shadow maps.
    pub shadows: bool,
    /// The part of the environment that the surface shows.
    pub surroundings: SurroundingsKey,
    /// The tone map and encoding, if the program writes displayed colours; otherwise it writes linear ones.
    pub display: Option<(ToneMap, ColorEncoding)>,
}

/// The storage of the lights, and the form of the loops over them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightLoops {
    /// Very few: in uniforms, and the ends of the directional lights, points and spots are constants. There are no loops.
    Unrolled([u8; 3]),
    /// Few: in uniforms.
    Uniforms,
    /// Many: in a texture.
    Texture,
}

impl LightLoops {
    /// Chooses for lights whose kinds end at `ends`.
    pub fn for_ends(ends: [usize; 3]) -> Self {
        let count = ends[2];
        if count <= LIGHTS_UNROLLED {
            LightLoops::Unrolled(ends.map(|end| end as u8))
        } else if count <= LIGHTS_IN_UNIFORMS {
            LightLoops::Uniforms
        } else {
            LightLoops::Texture
        }
    }

    /// All combinations of ends for very few lights.
    pub fn all_unrolled() -> Vec<LightLoops> {
        let most = LIGHTS_UNROLLED as u8;
        let mut all = Vec::new();
        for directional in 0..=most {
            for point in directional..=most {
                all.extend((point..=most).map(|spot| LightLoops::Unrolled([directional, point, spot])));
            }
        }
        all
    }
}

impl SceneKey {
    /// Every key that the renderer can ask for, with one of the ways to unroll the loops over the lights; colours
    /// of vertices, which are multiplied in one place, with one kind of loops only; and environments with what they
    /// meet (`surroundings::added_to`).
    pub fn all() -> Vec<SceneKey> {
        let loops = [LightLoops::Unrolled([1, 2, 3]), LightLoops::Uniforms, LightLoops::Texture];
        let mut keys = Vec::new();
        for &shading in Shading::ALL {
            for reflectance in Reflectance::all() {
                for maps in [MapSet::None, MapSet::Diffuse, MapSet::All] {
                    for normal_map in [false, true] {
                        if normal_map && shading != Shading::Phong {
                            continue;
                        }
                        for two_sided in [false, true] {
                            for view in [false, true] {
                                let key = |lights, vertex_colors| SceneKey {
                                    shading,
                                    reflectance,
                                    maps,
                                    normal_map,
                                    vertex_colors,
                                    two_sided,
                                    view,
                                    lights,
                                    shadows: false,
                                    surroundings: SurroundingsKey::NONE,
                                    display: None,
                                };
                                keys.extend(loops.map(|lights| key(lights, false)));
                                keys.push(key(LightLoops::Uniforms, true));
                                keys.push(SceneKey { shadows: true, ..key(LightLoops::Uniforms, false) });
                                keys.extend(surroundings::added_to(key(LightLoops::Uniforms, false)));
                                if !view {
                                    let display = Some((ToneMap::Agx, ColorEncoding::Srgb));
                                    keys.push(SceneKey { display, ..key(LightLoops::Uniforms, false) });
                                }
                            }
                        }
                    }
                }
            }
        }
        keys
    }

    /// Whether the material has a BRDF of its own.
    pub fn has_own_brdf(&self) -> bool {
        matches!(self.reflectance, Reflectance::Material(_))
    }

    /// Whether the light is summed in the vertex shader.
    pub fn vertex_lit(&self) -> bool {
        matches!(self.shading, Shading::Gouraud | Shading::FlatPerFace)
    }

    fn defines(&self) -> String {
        let mut text = String::new();
        let flat = |on: bool| if on { "flat" } else { "" };
        let per_triangle = matches!(self.shading, Shading::Flat | Shading::FlatPerFace);
        for (name, value) in [
            ("SHADING", shading_define(self.shading)),
            ("REFLECTANCE", self.reflectance.define()),
            ("BRDF_LOBE", self.reflectance.lobe()),
            ("VERTEX_LIT", bit(self.vertex_lit())),
            ("DIFFUSE_MAP", bit(self.maps != MapSet::None)),
            ("OTHER_MAPS", bit(self.maps == MapSet::All)),
            ("NORMAL_MAP", bit(self.normal_map)),
            ("VERTEX_COLORS", bit(self.vertex_colors)),
            ("TWO_SIDED", bit(self.two_sided)),
            ("VIEW", bit(self.view)),
            ("TANGENTS", bit(self.normal_map || self.view || self.has_own_brdf())),
            ("SHADOWS", bit(self.shadows)),
            ("LIGHTS_IN_TEXTURE", bit(self.lights == LightLoops::Texture)),
            ("LIGHTS_UNROLLED", bit(matches!(self.lights, LightLoops::Unrolled(_)))),
            ("FLAT_IF_PER_TRIANGLE", flat(per_triangle)),
            ("FLAT_IF_LIT_PER_FACE", flat(self.shading == Shading::FlatPerFace)),
        ] {
            define(&mut text, name, value);
        }
        text += &self.surroundings.defines();
        define(&mut text, "DISPLAYED", bit(self.display.is_some()));
        if let Some((tone_map, encoding)) = self.display {
            define(&mut text, "TONE_MAP", tone_map_define(tone_map));
            define(&mut text, "ENCODE_SRGB", bit(encoding == ColorEncoding::Srgb));
        }
        if let LightLoops::Unrolled(ends) = self.lights {
            for (name, end) in ["DIRECTIONAL_END", "POINT_END", "SPOT_END"].into_iter().zip(ends) {
                define(&mut text, name, &end.to_string());
            }
            let [directional, point, all] = ends;
            for light in 0..all {
                let kind = match light {
                    light if light < directional => "LIGHT_DIRECTIONAL",
                    light if light < point => "LIGHT_POINT",
                    _ => "LIGHT_SPOT",
                };
                define(&mut text, &format!("LIGHT_{light}"), kind);
            }
        }
        text
    }

    /// Vertex and fragment shader, for materials without a BRDF of their own.
    pub fn sources(&self, dialect: Dialect) -> [String; 2] {
        self.sources_with(dialect, "")
    }

    /// Vertex and fragment shader, with the function of the material's BRDF.
    pub fn sources_with(&self, dialect: Dialect, function: &str) -> [String; 2] {
        let shared = format!("{}{}{}", dialect.header(), constants(), self.defines());
        let view = if self.view { QUANTITY } else { "" };
        let shadow = if self.shadows { SHADOW } else { "" };
        let own = self.has_own_brdf().then(|| [function, MATERIAL_BRDF].concat());
        let function = own.as_deref().unwrap_or_default();
        let lit = [VECTOR, LIGHT, FRESNEL, BRDF, LIGHT_TABLE, shadow, function, LIGHTING, view].concat();
        let (vertex_light, fragment_light) = if self.vertex_lit() {
            (lit.as_str(), "struct LightSums { vec3 diffuse; vec3 specular; };\nuniform vec3 eye_in_world;\n")
        } else {
            (VECTOR, lit.as_str())
        };
        let fragment_view = if self.vertex_lit() && self.view { "uniform int view_quantity;\n" } else { "" };
        let fragment_vector = if self.vertex_lit() { VECTOR } else { "" };
        let display = if self.display.is_some() { [COLOR, DISPLAY_LIGHT].concat() } else { String::new() };
        let around = self.surroundings.functions(self.vertex_lit(), own.as_deref());
        [
            [shared.as_str(), vertex_light, SCENE_VERT].concat(),
            [&shared, fragment_vector, fragment_light, fragment_view, &around, &display, MATERIAL, SCENE_FRAG].concat(),
        ]
    }

    /// The name in labels and messages.
    pub fn name(&self) -> String {
        format!(
            "scene {} {}{}{}{}{}{}{}{}{}{}",
            self.shading,
            self.reflectance.define().trim_start_matches("REFLECTANCE_").to_ascii_lowercase(),
            match self.maps {
                MapSet::None => "",
                MapSet::Diffuse => " diffuse-map",
                MapSet::All => " all-maps",
            },
            if self.normal_map { " normal-map" } else { "" },
            if self.vertex_colors { " vertex-colors" } else { "" },
            if self.two_sided { " two-sided" } else { "" },
            if self.view { " view" } else { "" },
            match self.lights {
                LightLoops::Unrolled([d, p, s]) => format!(" lights {d} {} {}", p - d, s - p),
                LightLoops::Uniforms => " few-lights".to_owned(),
                LightLoops::Texture => " many-lights".to_owned(),
            },
            if self.shadows { " shadows" } else { "" },
            self.surroundings.name(),
            if self.display.is_some() { " displayed" } else { "" },
        )
    }
}

const VECTOR: &str = shader_text!("../shaders/light/vector.glsl");
const LIGHT: &str = shader_text!("../shaders/light/light.glsl");
const FRESNEL: &str = shader_text!("../shaders/light/fresnel.glsl");
const BRDF: &str = shader_text!("../shaders/light/brdf.glsl");
const OPTICS: &str = shader_text!("../shaders/light/optics.glsl");
const ENVIRONMENT_LIGHT: &str = shader_text!("../shaders/light/environment_light.glsl");
const FUNCTION_LIGHT: &str = shader_text!("../shaders/light/function_light.glsl");
const COLOR: &str = shader_text!("../shaders/light/color.glsl");
const LIGHT_TABLE: &str = shader_text!("../shaders/light_table.glsl");
const SHADOW: &str = shader_text!("../shaders/shadow.glsl");
const LIGHTING: &str = shader_text!("../shaders/lighting.glsl");
const MATERIAL_BRDF: &str = shader_text!("../shaders/material_brdf.glsl");
const QUANTITY: &str = shader_text!("../shaders/quantity.glsl");
const MATERIAL: &str = shader_text!("../shaders/material.glsl");
const SCENE_VERT: &str = shader_text!("../shaders/scene.vert");
const SCENE_FRAG: &str = shader_text!("../shaders/scene.frag");

/// The pure functions of the equation alone, for the test that compares them with their Rust twins.
pub fn light_functions(dialect: Dialect) -> String {
    let parts = [VECTOR, LIGHT, FRESNEL, BRDF, COLOR, OPTICS, ENVIRONMENT_LIGHT, FUNCTION_LIGHT];
    [dialect.header(), &constants(), &parts.concat()].concat()
}

fn bit(on: bool) -> &'static str {
    if on { "1" } else { "0" }
}

fn define(text: &mut String, name: &str, value: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "#define {name} {value}");
}

fn shading_define(shading: Shading) -> &'static str {
    match shading {
        Shading::Flat => "SHADING_FLAT",
        Shading::FlatPerFace => "SHADING_FLAT_PER_FACE",
        Shading::Gouraud => "SHADING_GOURAUD",
        Shading::Phong => "SHADING_PHONG",
    }
}

/// Constants, enums and layouts that Rust and GLSL share: generated from Rust, so that they always agree.
fn constants() -> String {
    let mut text = String::new();
    for (index, &shading) in Shading::ALL.iter().enumerate() {
        define(&mut text, shading_define(shading), &index.to_string());
    }
    let own = Reflectance::Material(FunctionId::NONE);
    for (index, reflectance) in Reflectance::all().into_iter().chain([own]).enumerate() {
        define(&mut text, reflectance.define(), &index.to_string());
    }
    for (index, &tone_map) in ToneMap::ALL.iter().enumerate() {
        define(&mut text, tone_map_define(tone_map), &index.to_string());
    }
    for (index, &fresnel) in Fresnel::ALL.iter().enumerate() {
        define(&mut text, &format!("FRESNEL_{}", fresnel.name().to_ascii_uppercase()), &index.to_string());
    }
    for &quantity in Quantity::ALL {
        let name = format!("QUANTITY_{}", quantity.name().to_ascii_uppercase().replace('-', "_"));
        define(&mut text, &name, &quantity_number(quantity).to_string());
    }
    for (name, value) in [
        ("LIGHT_TEXELS", LIGHT_TEXELS as i32),
        ("LIGHTS_PER_ROW", LIGHTS_PER_ROW as i32),
        ("LIGHTS_IN_UNIFORMS", LIGHTS_IN_UNIFORMS as i32),
        ("LIGHT_DIRECTIONAL", LIGHT_DIRECTIONAL),
        ("LIGHT_POINT", LIGHT_POINT),
        ("LIGHT_SPOT", LIGHT_SPOT),
        ("MOST_MEETINGS", optics::MOST_MEETINGS as i32),
        ("BODY_ROW", BODY_ROW as i32),
        ("LEAF_STEP", LEAF_STEP as i32),
        ("MOST_SMALL_LIGHTS", small_lights::MOST_LIGHTS as i32),
        ("MERL_WIDTH", MERL_WIDTH as i32),
        ("MERL_THETA_H", merl::THETA_H as i32),
        ("MERL_THETA_D", merl::THETA_D as i32),
        ("MERL_PHI_D", merl::PHI_D as i32),
    ] {
        define(&mut text, name, &value.to_string());
    }
    for (name, value) in [
        ("ATTENUATION_CAP", Attenuation::CAP),
        ("DEGENERATE_LENGTH", vector::DEGENERATE_LENGTH),
        ("LEAST_TILT", vector::LEAST_TILT),
        ("LOBE_CAP", brdf::LOBE_CAP),
        ("SHININESS_MAX", brdf::SHININESS_MAX),
        ("SHININESS_OF_ROUGHNESS_MAX", microfacet::SHININESS_OF_ROUGHNESS_MAX),
        ("GRAZING_COSINE", brdf::ward::GRAZING_COSINE),
        ("RADIANCE_CAP", color::RADIANCE_CAP),
        ("EXPOSURE_LIMIT", color::EXPOSURE_LIMIT),
        ("HOLE_OPACITY", HOLE_OPACITY),
        ("SHADOW_BIAS_TEXELS", SHADOW_BIAS_TEXELS),
        ("WEIGHT_THAT_COUNTS", optics::WEIGHT_THAT_COUNTS),
        ("NEAREST_MEETING", optics::NEAREST_MEETING),
        ("LEAST_VIEW_COSINE", function_light::LEAST_VIEW_COSINE),
        ("LEVELS_BEYOND", function_light::LEVELS_BEYOND),
        ("GOLDEN_SECTION", function_light::GOLDEN_SECTION),
        ("PI", std::f64::consts::PI),
    ] {
        // `{:e}` writes 1e6; GLSL needs a decimal point or an exponent, so this is a float.
        define(&mut text, name, &format!("{value:e}"));
    }
    text
}

/// A Fresnel factor's number in GLSL.
pub fn fresnel_number(fresnel: Fresnel) -> i32 {
    Fresnel::ALL.iter().position(|&f| f == fresnel).map_or(0, |i| i as i32)
}

/// A quantity's number in GLSL.
pub fn quantity_number(quantity: Quantity) -> i32 {
    Quantity::ALL.iter().position(|&q| q == quantity).map_or(-1, |i| i as i32)
}
