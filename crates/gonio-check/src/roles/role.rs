//! The roles of a shader's variables.

use gonio_language::tr;
use std::fmt;
use std::str::FromStr;

/// The meaning of an attribute or a uniform. Numbers are a light's index, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// Attribute: the position of a vertex in model space.
    Position,
    /// Attribute: the normal of a vertex in model space.
    Normal,
    /// Attribute: texture coordinates.
    TexCoord,
    /// Attribute: a colour per vertex.
    Color,
    /// Attribute: the tangent.
    Tangent,
    /// M: world from model.
    Model,
    /// V: view from world.
    View,
    /// P: clip from view.
    Projection,
    /// V M.
    ModelView,
    /// P V.
    ViewProjection,
    /// P V M.
    ModelViewProjection,
    /// The inverse transpose of M.
    NormalMatrix,
    /// The inverse transpose of V M.
    NormalMatrixOfModelView,
    /// The inverse of M: model from world.
    ModelInverse,
    /// The inverse of V: world from view.
    ViewInverse,
    /// The inverse of V M: model from view.
    ModelViewInverse,
    /// V without its translation.
    ViewRotation,
    /// P V without the translation of V.
    ViewProjectionRotation,
    /// The position of the camera, in world space.
    ViewPos,
    /// The direction that the camera looks in, in world space.
    ViewFront,
    /// The camera's own Up, perpendicular to Front, in world space.
    ViewUp,
    /// The approximate up direction of the camera, in world space.
    WorldUp,
    /// The camera's own Right, in world space.
    ViewRight,
    /// The point that the camera looks at, in world space.
    ViewTarget,
    /// The yaw of the camera in degrees: -90 looks towards -Z.
    Yaw,
    /// The pitch of the camera in degrees.
    Pitch,
    /// The position of a light, in world space.
    LightPos(u32),
    /// The position of a light, in view space.
    LightPosInView(u32),
    /// The direction in which a light shines.
    LightDirection(u32),
    /// The direction of a light that is infinitely far away, in view space.
    LightDirectionInView(u32),
    /// The unit vector halfway between the directions to a light and to an eye infinitely far away, in view space.
    LightHalfVector(u32),
    /// A light's colour.
    LightColor(u32),
    /// A light's ambient part, as a colour.
    AmbientColor(u32),
    /// A light's diffuse part, as a colour.
    DiffuseColor(u32),
    /// A light's specular part, as a colour.
    SpecularColor(u32),
    /// A light's ambient strength.
    AmbientStrength(u32),
    /// A light's diffuse strength.
    DiffuseStrength(u32),
    /// A light's specular strength.
    SpecularStrength(u32),
    /// All three of them in one vector, the ambient one first.
    Strengths(u32),
    /// A light's constant attenuation.
    AttenuationConstant(u32),
    /// A light's attenuation with the distance.
    AttenuationLinear(u32),
    /// A light's attenuation with the square of the distance.
    AttenuationQuadratic(u32),
    /// All three of them in one vector, the constant first.
    Attenuation(u32),
    /// Number of lights.
    LightCount,
    /// The exponent of the specular term.
    Shininess,
    /// The roughness of a surface: the RMS slope, Ward's alpha.
    Roughness,
    /// The object's colour.
    MaterialColor,
    /// The material's ambient reflectance.
    MaterialAmbient,
    /// The material's diffuse reflectance.
    MaterialDiffuse,
    /// The material's specular reflectance.
    MaterialSpecular,
    /// Light that the material emits.
    Emitted,
    /// A colour or number that another one of the same meaning is multiplied by: 1 in test scenes.
    Tint,
    /// Index of refraction, such as 1.52.
    RefractionIndex,
    /// Ratio of the indices, such as 1 / 1.52.
    RefractionRatio,
    /// Seconds since the start.
    Time,
    /// The exponent of a gamma correction, such as 2.2.
    Gamma,
    /// The environment as a cubemap.
    Cubemap,
    /// The texture of the object's colour.
    DiffuseTexture,
    /// The texture of its specular reflectance.
    SpecularTexture,
    /// Its normal map.
    NormalTexture,
    /// The environment as a panorama (equirectangular).
    Panorama,
    /// Width and height of the picture in pixels.
    Resolution,
    /// The index of the cubemap face that is drawn, 0 to 5.
    Face,
}

/// A role, or a function from a light's index to one.
enum Named {
    Plain(Role),
    Light(fn(u32) -> Role),
}

use Named::{Light, Plain};

const NAMES: [(&str, Named); 63] = [
    ("position", Plain(Role::Position)),
    ("normal", Plain(Role::Normal)),
    ("tex-coord", Plain(Role::TexCoord)),
    ("color", Plain(Role::Color)),
    ("tangent", Plain(Role::Tangent)),
    ("model", Plain(Role::Model)),
    ("view", Plain(Role::View)),
    ("projection", Plain(Role::Projection)),
    ("model-view", Plain(Role::ModelView)),
    ("view-projection", Plain(Role::ViewProjection)),
    ("model-view-projection", Plain(Role::ModelViewProjection)),
    ("normal-matrix", Plain(Role::NormalMatrix)),
    ("normal-matrix-of-model-view", Plain(Role::NormalMatrixOfModelView)),
    ("model-inverse", Plain(Role::ModelInverse)),
    ("view-inverse", Plain(Role::ViewInverse)),
    ("model-view-inverse", Plain(Role::ModelViewInverse)),
    ("view-rotation", Plain(Role::ViewRotation)),
    ("view-projection-rotation", Plain(Role::ViewProjectionRotation)),
    ("view-pos", Plain(Role::ViewPos)),
    ("view-front", Plain(Role::ViewFront)),
    ("view-up", Plain(Role::ViewUp)),
    ("world-up", Plain(Role::WorldUp)),
    ("view-right", Plain(Role::ViewRight)),
    ("view-target", Plain(Role::ViewTarget)),
    ("yaw", Plain(Role::Yaw)),
    ("pitch", Plain(Role::Pitch)),
    ("light-pos", Light(Role::LightPos)),
    ("light-pos-in-view", Light(Role::LightPosInView)),
    ("light-direction", Light(Role::LightDirection)),
    ("light-direction-in-view", Light(Role::LightDirectionInView)),
    ("light-half-vector", Light(Role::LightHalfVector)),
    ("light-color", Light(Role::LightColor)),
    ("ambient-color", Light(Role::AmbientColor)),
    ("diffuse-color", Light(Role::DiffuseColor)),
    ("specular-color", Light(Role::SpecularColor)),
    ("ambient-strength", Light(Role::AmbientStrength)),
    ("diffuse-strength", Light(Role::DiffuseStrength)),
    ("specular-strength", Light(Role::SpecularStrength)),
    ("strengths", Light(Role::Strengths)),
    ("attenuation-constant", Light(Role::AttenuationConstant)),
    ("attenuation-linear", Light(Role::AttenuationLinear)),
    ("attenuation-quadratic", Light(Role::AttenuationQuadratic)),
    ("attenuation", Light(Role::Attenuation)),
    ("light-count", Plain(Role::LightCount)),
    ("shininess", Plain(Role::Shininess)),
    ("roughness", Plain(Role::Roughness)),
    ("material-color", Plain(Role::MaterialColor)),
    ("material-ambient", Plain(Role::MaterialAmbient)),
    ("material-diffuse", Plain(Role::MaterialDiffuse)),
    ("material-specular", Plain(Role::MaterialSpecular)),
    ("emitted", Plain(Role::Emitted)),
    ("tint", Plain(Role::Tint)),
    ("refraction-index", Plain(Role::RefractionIndex)),
    ("refraction-ratio", Plain(Role::RefractionRatio)),
    ("time", Plain(Role::Time)),
    ("gamma", Plain(Role::Gamma)),
    ("cubemap", Plain(Role::Cubemap)),
    ("diffuse-texture", Plain(Role::DiffuseTexture)),
    ("specular-texture", Plain(Role::SpecularTexture)),
    ("normal-texture", Plain(Role::NormalTexture)),
    ("panorama", Plain(Role::Panorama)),
    ("resolution", Plain(Role::Resolution)),
    ("face", Plain(Role::Face)),
];

impl Role {
    /// Whether it is a matrix that contains the projection.
    #[must_use]
    pub fn projects(self) -> bool {
        matches!(self, Role::Projection | Role::ViewProjection | Role::ModelViewProjection)
    }

    /// Returns all roles, those of lights for light 0.
    pub fn all() -> impl Iterator<Item = Self> {
        NAMES.iter().map(|(_, named)| named.with_light(0))
    }

    /// Returns the index of the light that the role belongs to.
    #[must_use]
    pub const fn light(self) -> Option<u32> {
        match self {
            Self::LightPos(i)
            | Self::LightPosInView(i)
            | Self::LightDirection(i)
            | Self::LightDirectionInView(i)
            | Self::LightHalfVector(i)
            | Self::LightColor(i)
            | Self::AmbientColor(i)
            | Self::DiffuseColor(i)
            | Self::SpecularColor(i)
            | Self::AmbientStrength(i)
            | Self::DiffuseStrength(i)
            | Self::SpecularStrength(i)
            | Self::Strengths(i)
            | Self::AttenuationConstant(i)
            | Self::AttenuationLinear(i)
            | Self::AttenuationQuadratic(i)
            | Self::Attenuation(i) => Some(i),
            _ => None,
        }
    }

    /// Returns the same role of another light; roles without a light are unchanged.
    #[must_use]
    pub fn with_light(self, light: u32) -> Self {
        if self.light().is_none() {
            return self;
        }
        let of_first = |named: &Named| std::mem::discriminant(&named.with_light(0)) == std::mem::discriminant(&self);
        NAMES.iter().find(|(_, named)| of_first(named)).map_or(self, |(_, named)| named.with_light(light))
    }

    /// Returns the same quantity in world space or in view space; `None` if it is not given in one of them.
    #[must_use]
    pub const fn in_space(self, is_in_view: bool) -> Option<Self> {
        Some(match (self, is_in_view) {
            (Self::LightPos(i) | Self::LightPosInView(i), false) => Self::LightPos(i),
            (Self::LightPos(i) | Self::LightPosInView(i), true) => Self::LightPosInView(i),
            (Self::LightDirection(i) | Self::LightDirectionInView(i), false) => Self::LightDirection(i),
            (Self::LightDirection(i) | Self::LightDirectionInView(i), true) => Self::LightDirectionInView(i),
            (Self::NormalMatrix | Self::NormalMatrixOfModelView, false) => Self::NormalMatrix,
            (Self::NormalMatrix | Self::NormalMatrixOfModelView, true) => Self::NormalMatrixOfModelView,
            _ => return None,
        })
    }

    /// Whether it is a colour of a light or of the material.
    #[must_use]
    pub const fn is_colour(self) -> bool {
        matches!(
            self,
            Self::LightColor(_)
                | Self::AmbientColor(_)
                | Self::DiffuseColor(_)
                | Self::SpecularColor(_)
                | Self::MaterialColor
                | Self::MaterialAmbient
                | Self::MaterialDiffuse
                | Self::MaterialSpecular
        )
    }

    /// Whether it scales the light of a term, the ambient one first, as a strength or as a colour of that light.
    #[must_use]
    pub const fn scales(self, term: usize) -> bool {
        match self {
            Self::AmbientStrength(_) | Self::AmbientColor(_) => term == 0,
            Self::DiffuseStrength(_) | Self::DiffuseColor(_) => term == 1,
            Self::SpecularStrength(_) | Self::SpecularColor(_) => term == 2,
            Self::Strengths(_) => true,
            _ => false,
        }
    }

    /// Whether it is a light's strength, or several.
    #[must_use]
    pub const fn is_strength(self) -> bool {
        matches!(
            self,
            Self::AmbientStrength(_) | Self::DiffuseStrength(_) | Self::SpecularStrength(_) | Self::Strengths(_)
        )
    }

    /// Whether it is a constant of the attenuation, or several.
    #[must_use]
    pub const fn is_of_attenuation(self) -> bool {
        matches!(
            self,
            Self::AttenuationConstant(_)
                | Self::AttenuationLinear(_)
                | Self::AttenuationQuadratic(_)
                | Self::Attenuation(_)
        )
    }

    /// Whether it is a role of attributes.
    #[must_use]
    pub const fn is_attribute(self) -> bool {
        matches!(self, Self::Position | Self::Normal | Self::TexCoord | Self::Color | Self::Tangent)
    }
}

impl Named {
    fn with_light(&self, light: u32) -> Role {
        match self {
            Plain(role) => *role,
            Light(role) => role(light),
        }
    }
}

impl fmt::Display for Role {
    /// Writes the name; from the second light on with its index, `light-pos-1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let first = self.with_light(0);
        let name = NAMES.iter().find(|(_, named)| named.with_light(0) == first).map_or("", |&(name, _)| name);
        match self.light() {
            None | Some(0) => f.write_str(name),
            Some(light) => write!(f, "{name}-{light}"),
        }
    }
}

/// An unknown role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownRole {
    /// The word.
    pub word: String,
    /// The most similar name of a role.
    pub nearest: &'static str,
}

impl fmt::Display for UnknownRole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&tr!("check-inputs-unknown-role-did-you-mean", word = self.word, nearest = self.nearest))
    }
}

impl std::error::Error for UnknownRole {}

impl FromStr for Role {
    type Err = UnknownRole;

    fn from_str(word: &str) -> Result<Self, UnknownRole> {
        let (name, light) = match word.rsplit_once('-').map(|(name, light)| (name, light.parse::<u32>())) {
            Some((name, Ok(light))) => (name, Some(light)),
            _ => (word, None),
        };
        match (NAMES.iter().find(|(written, _)| *written == name), light) {
            (Some((_, named @ Light(_))), light) => Ok(named.with_light(light.unwrap_or(0))),
            (Some((_, Plain(role))), None) => Ok(*role),
            _ => {
                let nearest = crate::words::most_like(name, NAMES.iter().map(|&(name, _)| name)).unwrap_or("position");
                Err(UnknownRole { word: word.to_owned(), nearest })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn role_names_survive_a_round_trip() {
        assert_eq!(Role::all().count(), 63);
        for role in Role::all() {
            assert_eq!(role.to_string().parse(), Ok(role));
            let third = role.with_light(2);
            assert_eq!(third.to_string().parse(), Ok(third));
            assert_eq!(third.light(), role.light().map(|_| 2));
        }
        assert_eq!(Role::LightPos(3).to_string(), "light-pos-3");
        assert_eq!("light-pos-0".parse(), Ok(Role::LightPos(0)));
        assert_eq!(Role::ModelViewProjection.to_string(), "model-view-projection");
    }

    #[test]
    fn unknown_roles_suggest_the_nearest_name() {
        for (word, nearest) in [
            ("ligth-pos", "light-pos"),
            ("lightpos", "light-pos"),
            ("Model", "model"),
            ("model-1", "model"),
            ("", "yaw"),
        ] {
            let error = word.parse::<Role>().unwrap_err();
            assert_eq!((error.word.as_str(), error.nearest), (word, nearest));
        }
    }
}
