//! Derives a role from the words of a name and the type of its variable alone; `context` then considers the others.

use super::role::Role;
use super::words::{UNKNOWN, Words};

/// The kind of value that a GLSL type holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Scalar,
    Vector,
    Matrix,
    Sampler2D,
    SamplerCube,
    /// Other types, which gonio never sets.
    Other,
}

/// Returns the shape of a type by its GLSL name.
pub(super) fn shape(glsl_type: &str) -> Shape {
    match glsl_type {
        "float" | "int" | "uint" | "double" | "half" => Shape::Scalar,
        "vec2" | "vec3" | "vec4" | "dvec2" | "dvec3" | "dvec4" | "ivec2" | "ivec3" | "ivec4" | "uvec2" => Shape::Vector,
        "mat3" | "mat4" | "mat3x3" | "mat4x4" | "dmat3" | "dmat4" => Shape::Matrix,
        "sampler2D" => Shape::Sampler2D,
        "samplerCube" => Shape::SamplerCube,
        _ => Shape::Other,
    }
}

/// Words that must occur, words that must not, and the resulting role for the index of a light.
struct Rule {
    all: &'static [&'static str],
    none: &'static [&'static str],
    role: fn(u32) -> Role,
}

const fn rule(all: &'static [&'static str], none: &'static [&'static str], role: fn(u32) -> Role) -> Rule {
    Rule { all, none, role }
}

/// The rules for vectors; the first match counts. `struct` marks a field of a light's struct whose own name does not
/// contain *light*.
const VECTORS: &[Rule] = &[
    rule(&["light", "pos", "view", "space"], &["world"], Role::LightPosInView),
    rule(&["light", "pos", "camera", "space"], &["world"], Role::LightPosInView),
    rule(&["struct", "view", "pos"], &[], |_| Role::ViewPos),
    rule(&["light", "pos", "view"], &["world"], Role::LightPosInView),
    rule(&["light", "pos", "camera"], &["world"], Role::LightPosInView),
    rule(
        &["light", "view"],
        &["world", "struct", "dir", "color", "ambient", "diffuse", "specular"],
        Role::LightPosInView,
    ),
    rule(&["light", "dir", "view"], &["world", "struct"], Role::LightDirectionInView),
    rule(&["attenuation"], &["pos", "dir", "color"], Role::Attenuation),
    rule(&["light", "pos"], &[], Role::LightPos),
    rule(&["light", "dir"], &[], Role::LightDirection),
    rule(&["light", "ambient", "strength"], &["color"], Role::AmbientStrength),
    rule(&["light", "diffuse", "strength"], &["color"], Role::DiffuseStrength),
    rule(&["light", "specular", "strength"], &["color"], Role::SpecularStrength),
    rule(&["light", "ambient"], &[], Role::AmbientColor),
    rule(&["light", "diffuse"], &[], Role::DiffuseColor),
    rule(&["light", "specular"], &[], Role::SpecularColor),
    rule(&["light", "color"], &[], Role::LightColor),
    rule(&["light", "strength"], &[], Role::LightColor),
    rule(&["light", "power"], &[], Role::LightColor),
    rule(&["front", "at"], &["light"], |_| Role::ViewTarget),
    rule(&["view", "front"], &[], |_| Role::ViewFront),
    rule(&["camera", "front"], &[], |_| Role::ViewFront),
    rule(&["camera", "dir"], &[], |_| Role::ViewFront),
    rule(&["front"], &["light", "struct", "color"], |_| Role::ViewFront),
    // Students call the position of the camera a direction.
    rule(&["view", "dir"], &[], |_| Role::ViewPos),
    rule(&["view"], &["color", "screen", "size"], |_| Role::ViewPos),
    rule(&["camera"], &["color", "screen", "size"], |_| Role::ViewPos),
    rule(&["material", "ambient"], &["strength"], |_| Role::MaterialAmbient),
    rule(&["material", "diffuse"], &["strength"], |_| Role::MaterialDiffuse),
    rule(&["material", "specular"], &["strength"], |_| Role::MaterialSpecular),
    rule(&["emitted"], &[], |_| Role::Emitted),
    rule(&["light", "ka"], &["material"], Role::AmbientColor),
    rule(&["light", "kd"], &["material"], Role::DiffuseColor),
    rule(&["light", "ks"], &["material"], Role::SpecularColor),
    rule(&["ka"], &[], |_| Role::MaterialAmbient),
    rule(&["kd"], &[], |_| Role::MaterialColor),
    rule(&["ks"], &[], |_| Role::MaterialSpecular),
    rule(&["ambient", "strength"], &["color"], Role::AmbientStrength),
    rule(&["diffuse", "strength"], &["color"], Role::DiffuseStrength),
    rule(&["specular", "strength"], &["color"], Role::SpecularStrength),
    rule(&["ambient"], &[], Role::AmbientColor),
    rule(&["diffuse"], &[], |_| Role::MaterialDiffuse),
    rule(&["specular"], &[], |_| Role::MaterialSpecular),
    rule(&["albedo"], &[], |_| Role::MaterialColor),
    rule(&["color"], &["sky"], |_| Role::MaterialColor),
    rule(&["screen"], &[], |_| Role::Resolution),
    rule(&["material"], &["pos", "dir", "normal"], |_| Role::MaterialColor),
    rule(&["light"], &["space", "attenuation", "size", "constant", "struct"], Role::LightPos),
];

const SCALARS: &[Rule] = &[
    rule(&["light", "count"], &[], |_| Role::LightCount),
    rule(&["shininess"], &["strength"], |_| Role::Shininess),
    rule(&["exponent"], &[], |_| Role::Shininess),
    rule(&["specular", "power"], &["strength"], |_| Role::Shininess),
    rule(&["power"], &["light", "ambient", "diffuse"], |_| Role::Shininess),
    rule(&["shininess"], &[], |_| Role::Shininess),
    rule(&["roughness"], &[], |_| Role::Roughness),
    rule(&["ambient"], &[], Role::AmbientStrength),
    rule(&["diffuse"], &[], Role::DiffuseStrength),
    rule(&["specular"], &[], Role::SpecularStrength),
    rule(&["ka"], &[], Role::AmbientStrength),
    rule(&["kd"], &[], Role::DiffuseStrength),
    rule(&["ks"], &[], Role::SpecularStrength),
    rule(&["light", "strength"], &["attenuation", "constant", "linear", "quadratic", "material"], Role::LightColor),
    rule(&["light", "power"], &["attenuation"], Role::LightColor),
    rule(&["constant"], &[], Role::AttenuationConstant),
    rule(&["linear"], &[], Role::AttenuationLinear),
    rule(&["quadratic"], &[], Role::AttenuationQuadratic),
    rule(&["refraction", "ratio"], &[], |_| Role::RefractionRatio),
    rule(&["refraction"], &["strength"], |_| Role::RefractionIndex),
    rule(&["gamma"], &[], |_| Role::Gamma),
    rule(&["time"], &["light"], |_| Role::Time),
    rule(&["screen"], &["light"], |_| Role::Resolution),
    rule(&["yaw"], &["light"], |_| Role::Yaw),
    rule(&["pitch"], &["light"], |_| Role::Pitch),
];

const SAMPLERS_2D: &[Rule] = &[
    rule(&["normal"], &[], |_| Role::NormalTexture),
    rule(&["specular"], &[], |_| Role::SpecularTexture),
    rule(&["panorama"], &[], |_| Role::Panorama),
    rule(&["env"], &[], |_| Role::Panorama),
    rule(&["sky"], &[], |_| Role::Panorama),
    rule(&["diffuse"], &[], |_| Role::DiffuseTexture),
    rule(&["albedo"], &[], |_| Role::DiffuseTexture),
    rule(&["color"], &[], |_| Role::DiffuseTexture),
    rule(&["tex"], &["emitted", "ambient", "light", "screen", "reflect", "shininess"], |_| Role::DiffuseTexture),
];

const SAMPLERS_CUBE: &[Rule] = &[
    rule(&["cube"], &[], |_| Role::Cubemap),
    rule(&["sky"], &[], |_| Role::Cubemap),
    rule(&["env"], &[], |_| Role::Cubemap),
    rule(&["reflect"], &[], |_| Role::Cubemap),
    rule(&["tex"], &[], |_| Role::Cubemap),
];

const ATTRIBUTES: &[Rule] = &[
    rule(&["tangent"], &["blocked"], |_| Role::Tangent),
    rule(&["normal"], &["blocked"], |_| Role::Normal),
    rule(&["color"], &[], |_| Role::Color),
    rule(&["tex"], &[], |_| Role::TexCoord),
    rule(&["coord"], &["model", "world", "vertex", "pos"], |_| Role::TexCoord),
    rule(&["pos"], &["blocked"], |_| Role::Position),
    rule(&["vertex"], &["blocked"], |_| Role::Position),
    rule(&["coord"], &[], |_| Role::Position),
];

/// Returns the role of an attribute by its name.
pub(super) fn attribute(shape: Shape, words: &Words) -> Option<Role> {
    if shape != Shape::Vector || names_axis(words) {
        return None;
    }
    // A letter that is the whole name.
    match (words.tokens.as_slice(), words.letters.as_slice()) {
        ([], ['p'] | ['a', 'p']) => Some(Role::Position),
        ([], ['n'] | ['a', 'n']) => Some(Role::Normal),
        _ => first(ATTRIBUTES, words, 0),
    }
}

/// Returns the role of a uniform by its name and type.
pub(super) fn uniform(shape: Shape, words: &Words, light: u32) -> Option<Role> {
    if shape == Shape::Matrix {
        return matrix(words);
    }
    // `faceId` has no other meaning.
    let is_only_face =
        shape == Shape::Scalar && words.tokens.iter().all(|t| matches!(*t, "face" | "blocked" | "index"));
    if words.has("face") && is_only_face {
        return Some(Role::Face);
    }
    if words.has("blocked") {
        return None;
    }
    if words.has("face") && (words.has("size") || words.has("screen")) {
        return matches!(shape, Shape::Scalar | Shape::Vector).then_some(Role::Resolution);
    }
    if names_axis(words) {
        return if shape == Shape::Vector { axis(words) } else { None };
    }
    // A letter that counts (`nLights`) or is the whole name (`t`).
    if shape == Shape::Scalar {
        match words.letters[..] {
            [.., 'n'] if words.has("light") && words.tokens.len() == 1 => return Some(Role::LightCount),
            ['t'] | ['u', 't'] if words.tokens.is_empty() => return Some(Role::Time),
            _ => {}
        }
    }
    let rules = match shape {
        Shape::Scalar => SCALARS,
        Shape::Vector => VECTORS,
        Shape::Sampler2D => SAMPLERS_2D,
        Shape::SamplerCube => SAMPLERS_CUBE,
        Shape::Matrix | Shape::Other => return None,
    };
    // A colour is never a vec2 and a picture's size never a vec4, but the names are clear enough.
    first(rules, words, light)
}

/// Whether the words are those of a camera's axes, which have no other meaning.
fn names_axis(words: &Words) -> bool {
    ["up", "right", "target"].iter().any(|word| words.has(word))
}

/// Returns the axis of a camera or its target. `context` distinguishes the camera's own Up from the world's.
fn axis(words: &Words) -> Option<Role> {
    const OF_CAMERAS: [&str; 10] = ["up", "right", "target", "view", "camera", "world", "pos", "dir", "front", "at"];
    if !words.tokens.iter().all(|token| OF_CAMERAS.contains(token)) {
        return None;
    }
    Some(match (words.has("target"), words.has("right")) {
        (true, _) => Role::ViewTarget,
        (false, true) => Role::ViewRight,
        (false, false) => Role::WorldUp,
    })
}

fn first(rules: &[Rule], words: &Words, light: u32) -> Option<Role> {
    let fits =
        |rule: &&Rule| rule.all.iter().all(|word| words.has(word)) && !rule.none.iter().any(|word| words.has(word));
    rules.iter().find(fits).map(|rule| (rule.role)(light))
}

/// Returns the role of a matrix: which of M, V and P it contains.
fn matrix(words: &Words) -> Option<Role> {
    // The matrix of a light is for shadows.
    if words.has("blocked") || words.has("light") || words.has("tex") || names_axis(words) {
        return None;
    }
    if let Some(role) = between_spaces(&words.order) {
        // `normalWorldFromModel`
        return match (words.has("normal") || words.has("transpose"), role) {
            (false, _) => Some(role),
            (true, Role::Model) => Some(Role::NormalMatrix),
            (true, Role::ModelView) => Some(Role::NormalMatrixOfModelView),
            (true, _) => None,
        };
    }
    // From which space it leads to which is said by a word of another language.
    if words.order.windows(3).any(|three| is_space(three[0]) && three[1] == UNKNOWN && is_space(three[2])) {
        return None;
    }
    let spelt = |word: &str| words.has(word);
    // Beside words a letter is a prefix (`mModel`, `u_model`); alone it is the matrix (`M`, `u_M`, `itM`).
    let has_words =
        ["model", "world", "object", "view", "camera", "proj", "normal", "mv", "vp", "mvp"].iter().any(|w| spelt(w));
    let letter = |c: char| !has_words && words.letters.contains(&c);
    let joined =
        |c: &str| words.tokens.iter().any(|token| matches!(*token, "m" | "mv" | "vp" | "mvp") && token.contains(c));
    let m = spelt("model") || spelt("world") || spelt("object") || joined("m") || letter('m') || letter('w');
    // `cameraMatrix` may also be P V; `context` decides.
    let v = spelt("view") || spelt("camera") || joined("v") || letter('v');
    let p = spelt("proj") || joined("p") || letter('p');
    let inverse_transpose = spelt("inverse") && (spelt("transpose") || spelt("trans") || letter('t'))
        || spelt("transpose")
        || letter('i') && letter('t');
    if spelt("normal") || letter('n') || inverse_transpose {
        return match (v, p) {
            (_, true) => None,
            (true, false) => Some(Role::NormalMatrixOfModelView),
            (false, false) => Some(Role::NormalMatrix),
        };
    }
    if spelt("inverse") {
        return match (m, v, p) {
            (true, false, false) => Some(Role::ModelInverse),
            (false, true, false) => Some(Role::ViewInverse),
            (true, true, false) => Some(Role::ModelViewInverse),
            _ => None,
        };
    }
    if spelt("trans") && !(m || v || p) {
        return None;
    }
    match (m, v, p) {
        (true, false, false) => Some(Role::Model),
        (false, true, false) => Some(Role::View),
        (false, false, true) => Some(Role::Projection),
        (true, true, false) => Some(Role::ModelView),
        (false, true, true) => Some(Role::ViewProjection),
        (true, true, true) => Some(Role::ModelViewProjection),
        (true, false, true) | (false, false, false) => None,
    }
}

/// Whether a word means a space.
fn is_space(word: &str) -> bool {
    matches!(word, "model" | "object" | "world" | "view" | "camera" | "clip" | "proj" | "screen")
}

/// Returns the role of names such as `world_from_model` and `modelToWorld`.
fn between_spaces(order: &[&str]) -> Option<Role> {
    let at = order.iter().position(|word| matches!(*word, "from" | "to"))?;
    let space = |word: Option<&&str>| {
        Some(match *word? {
            "model" | "object" => 0,
            "world" => 1,
            "view" | "camera" => 2,
            "clip" | "proj" | "screen" => 3,
            _ => return None,
        })
    };
    let (before, behind) = (space(order.get(at.checked_sub(1)?)), space(order.get(at + 1)));
    let (source, target): (u8, u8) =
        if order.get(at) == Some(&"from") { (behind?, before?) } else { (before?, behind?) };
    Some(match (source, target) {
        (0, 1) => Role::Model,
        (1, 2) => Role::View,
        (2, 3) => Role::Projection,
        (0, 2) => Role::ModelView,
        (1, 3) => Role::ViewProjection,
        (0, 3) => Role::ModelViewProjection,
        (1, 0) => Role::ModelInverse,
        (2, 1) => Role::ViewInverse,
        (2, 0) => Role::ModelViewInverse,
        _ => return None,
    })
}
