//! The values of roles in a frame: matrices, camera, lights and materials.

use crate::roles::Role;
use glam::{DMat3, DMat4, DVec3};
use gonio_language::tr;
use gonio_light::light::ambient_color;
use gonio_light::{Attenuation, Light, LightKind};
use gonio_mesh::AmbientRule;
use gonio_scene::{Frame, SceneMaterial};

/// The distance of a directional light's position, in radii of the scene: its rays are parallel to 1/1000 of a radian.
const SUN_DISTANCE: f64 = 1000.0;
/// The ambient light of a scene without ambient lights, as a share of its first light: the lab's.
const AMBIENT: f64 = 0.1;
/// No driver has more uniforms.
const MOST_ELEMENTS: u32 = 256;

/// What the values of one draw depend on.
pub(super) struct DrawInputs<'a> {
    pub(super) frame: &'a Frame,
    pub(super) world_from_model: DMat4,
    pub(super) material: &'a SceneMaterial,
}

/// A sentence part that says where the value of a role comes from.
pub(super) fn origin(role: Role) -> String {
    let light = |index: u32, what: &str| match index {
        0 => tr!("check-inputs-the-first-light-s", what = what),
        1 => tr!("check-inputs-the-second-light-s", what = what),
        more => tr!("check-inputs-light-s", more = more + 1, what = what),
    };
    match role {
        Role::Model => tr!("check-inputs-the-object-s-matrix-m").to_owned(),
        Role::View => tr!("check-inputs-the-camera-s-matrix-v").to_owned(),
        Role::Projection => tr!("check-inputs-the-camera-s-matrix-p").to_owned(),
        Role::ModelView => tr!("check-inputs-v-m-of-object-and-camera").to_owned(),
        Role::ViewProjection => tr!("check-inputs-the-camera-s-p-v").to_owned(),
        Role::ModelViewProjection => tr!("check-inputs-p-v-m-of-object-and").to_owned(),
        Role::NormalMatrix => tr!("check-inputs-the-object-s-inverse-transpose-of").to_owned(),
        Role::NormalMatrixOfModelView => tr!("check-inputs-the-inverse-transpose-of-v-m").to_owned(),
        Role::ModelInverse => tr!("check-inputs-the-inverse-of-the-object-s").to_owned(),
        Role::ViewInverse => tr!("check-inputs-the-inverse-of-the-camera-s").to_owned(),
        Role::ModelViewInverse => tr!("check-inputs-the-inverse-of-v-m").to_owned(),
        Role::ViewRotation => tr!("check-inputs-the-camera-s-matrix-v-without").to_owned(),
        Role::ViewProjectionRotation => tr!("check-inputs-the-camera-s-p-v-without").to_owned(),
        Role::ViewPos | Role::ViewFront | Role::ViewUp | Role::WorldUp | Role::ViewRight | Role::ViewTarget => {
            tr!("check-inputs-from-the-camera").to_owned()
        }
        Role::Yaw | Role::Pitch => tr!("check-inputs-from-the-camera-in-degrees").to_owned(),
        Role::LightPos(i) => light(i, tr!("check-inputs-position")),
        Role::LightPosInView(i) => light(i, tr!("check-inputs-position-in-view-space")),
        Role::LightDirection(i) => light(i, tr!("check-inputs-direction")),
        Role::LightDirectionInView(i) => light(i, tr!("check-inputs-direction-in-view-space")),
        Role::LightHalfVector(i) => light(i, tr!("check-inputs-half-vector")),
        Role::LightColor(i) | Role::DiffuseColor(i) | Role::SpecularColor(i) => light(i, tr!("check-inputs-colour")),
        Role::DiffuseStrength(i) | Role::SpecularStrength(i) | Role::Strengths(i) => {
            light(i, tr!("check-inputs-strength"))
        }
        Role::AmbientColor(_) | Role::AmbientStrength(_) => tr!("check-inputs-the-ambient-light").to_owned(),
        Role::AttenuationConstant(i)
        | Role::AttenuationLinear(i)
        | Role::AttenuationQuadratic(i)
        | Role::Attenuation(i) => light(i, tr!("check-inputs-attenuation")),
        Role::LightCount => tr!("check-inputs-the-number-of-lights").to_owned(),
        Role::Time => tr!("check-inputs-the-time-in-seconds").to_owned(),
        Role::Resolution => tr!("check-inputs-the-picture-s-size-in-pixels").to_owned(),
        Role::Gamma => "2.2".to_owned(),
        Role::Tint => "1".to_owned(),
        _ => tr!("check-inputs-from-the-material").to_owned(),
    }
}

/// Whether a scene has a value for a role.
pub(super) fn has_value(role: Role) -> bool {
    let is_texture = matches!(
        role,
        Role::Cubemap | Role::DiffuseTexture | Role::SpecularTexture | Role::NormalTexture | Role::Panorama
    );
    !role.is_attribute() && !is_texture && role != Role::Face
}

/// The value of a uniform with a role; arrays of lights have consecutive lights, others the same value in all elements.
/// `None` if a scene has no such value.
pub(super) fn values(role: Role, glsl_type: &str, elements: u32, input: &DrawInputs<'_>) -> Option<Vec<f32>> {
    if elements <= 1 {
        return value(role, glsl_type, input);
    }
    let size = super::uniforms::components(glsl_type);
    let first = role.light().unwrap_or(0);
    let element = |element: u32| {
        let mut numbers = value(role.with_light(first.saturating_add(element)), glsl_type, input)?;
        numbers.resize(size, 0.0);
        Some(numbers)
    };
    (0..elements.min(MOST_ELEMENTS)).map(element).collect::<Option<Vec<_>>>().map(|all| all.concat())
}

fn value(role: Role, glsl_type: &str, input: &DrawInputs<'_>) -> Option<Vec<f32>> {
    let frame = input.frame;
    let camera = &frame.camera;
    let (width, height) = (f64::from(frame.width.max(1)), f64::from(frame.height.max(1)));
    let model = input.world_from_model;
    let view = camera.view_from_world();
    let projection = camera.clip_from_view(width / height);
    let matrix = |m: DMat4| match glsl_type {
        "mat3" => DMat3::from_mat4(m).as_mat3().to_cols_array().to_vec(),
        _ => m.as_mat4().to_cols_array().to_vec(),
    };
    let normal_matrix = |m: DMat4| {
        let linear = DMat3::from_mat4(m);
        let inverse = if linear.determinant() == 0.0 { linear } else { linear.inverse().transpose() };
        matrix(DMat4::from_mat3(inverse))
    };
    let vector = |v: DVec3, w: f32| {
        let [x, y, z] = v.as_vec3().to_array();
        vec![x, y, z, w]
    };
    let is_scalar = super::uniforms::components(glsl_type) == 1;
    // A colour may be declared as a number: its mean.
    let color = |c: DVec3| if is_scalar { vec![(c.element_sum() / 3.0) as f32] } else { vector(c, 1.0) };
    let number = |x: f64| if is_scalar { vec![x as f32] } else { vector(DVec3::splat(x), 1.0) };
    let center = 0.5 * (frame.bounds_min + frame.bounds_max);
    let radius = (0.5 * (frame.bounds_max - frame.bounds_min)).length().max(1e-3);
    let light = |index: u32| light(frame, index);
    let position = |light: Light| match light.kind {
        LightKind::Point { position } | LightKind::Spot { position, .. } => position,
        LightKind::Directional { direction } => center - direction * SUN_DISTANCE * radius,
        LightKind::Ambient => center,
    };
    let direction = |light: Option<Light>| match light.map(|light| light.kind) {
        Some(LightKind::Directional { direction }) => direction,
        Some(LightKind::Spot { axis, .. }) => axis,
        Some(LightKind::Point { position }) => (center - position).normalize_or(DVec3::NEG_Y),
        _ => DVec3::NEG_Y,
    };
    let ambient = || {
        let sum = ambient_color(&frame.lights);
        let first = light(0).map_or(DVec3::ONE, |light| light.color);
        if sum == DVec3::ZERO { AMBIENT * first } else { sum }
    };
    let material = &input.material.material;
    let triple = |c: [f32; 3]| color(DVec3::from(c.map(f64::from)));
    Some(match role {
        Role::Model => matrix(model),
        Role::View => matrix(view),
        Role::Projection => matrix(projection),
        Role::ModelView => matrix(view * model),
        Role::ViewProjection => matrix(projection * view),
        Role::ModelViewProjection => matrix(projection * view * model),
        Role::NormalMatrix => normal_matrix(model),
        Role::NormalMatrixOfModelView => normal_matrix(view * model),
        Role::ModelInverse => matrix(model.inverse()),
        Role::ViewInverse => matrix(view.inverse()),
        Role::ModelViewInverse => matrix((view * model).inverse()),
        Role::ViewRotation => matrix(DMat4::from_mat3(DMat3::from_mat4(view))),
        Role::ViewProjectionRotation => matrix(projection * DMat4::from_mat3(DMat3::from_mat4(view))),
        Role::ViewPos => vector(camera.position, 1.0),
        Role::ViewFront => vector(camera.front, 0.0),
        Role::ViewUp | Role::WorldUp => vector(camera.up, 0.0),
        Role::ViewRight => vector(camera.right, 0.0),
        Role::ViewTarget => vector(camera.position + camera.front * camera.depth_of(center).max(camera.near), 1.0),
        Role::Yaw => vec![camera.yaw_pitch_deg().0 as f32],
        Role::Pitch => vec![camera.yaw_pitch_deg().1 as f32],
        Role::LightPos(i) => vector(light(i).map_or(center, position), 1.0),
        Role::LightPosInView(i) => vector(view.transform_point3(light(i).map_or(center, position)), 1.0),
        Role::LightDirection(i) => vector(direction(light(i)), 0.0),
        Role::LightDirectionInView(i) => vector(-view.transform_vector3(direction(light(i))), 0.0),
        Role::LightHalfVector(i) => {
            vector((DVec3::Z - view.transform_vector3(direction(light(i)))).normalize_or(DVec3::Z), 0.0)
        }
        Role::LightColor(i) | Role::DiffuseColor(i) | Role::SpecularColor(i) => {
            color(light(i).map_or(DVec3::ZERO, |light| light.color))
        }
        Role::DiffuseStrength(i) | Role::SpecularStrength(i) => number(if light(i).is_some() { 1.0 } else { 0.0 }),
        Role::Strengths(i) => {
            let lit = if light(i).is_some() { 1.0 } else { 0.0 };
            let of_ambient = if i == 0 { ambient().element_sum() / 3.0 } else { 0.0 };
            vector(DVec3::new(of_ambient, lit, lit), 1.0)
        }
        Role::AmbientColor(0) => color(ambient()),
        Role::AmbientStrength(0) => number(ambient().element_sum() / 3.0),
        Role::AmbientColor(_) | Role::AmbientStrength(_) => number(0.0),
        Role::AttenuationConstant(i) => number(attenuation(light(i))[0]),
        Role::AttenuationLinear(i) => number(attenuation(light(i))[1]),
        Role::AttenuationQuadratic(i) => number(attenuation(light(i))[2]),
        Role::Attenuation(i) => vector(attenuation(light(i)).into(), 0.0),
        Role::LightCount => vec![lights(frame).count().max(1) as f32],
        Role::Shininess => number(material.shininess.into()),
        Role::MaterialColor | Role::MaterialDiffuse => triple(material.diffuse),
        Role::MaterialAmbient => match material.ambient {
            AmbientRule::FollowsDiffuse => triple(material.diffuse),
            AmbientRule::Value(value) => triple(value),
        },
        Role::MaterialSpecular => triple(material.specular),
        Role::Emitted => triple(material.emitted),
        Role::RefractionIndex => number(material.refraction_index.into()),
        Role::RefractionRatio => number(1.0 / f64::from(material.refraction_index.max(1e-3))),
        Role::Time => number(frame.time),
        Role::Gamma => number(2.2),
        Role::Tint => number(1.0),
        Role::Resolution => vec![width as f32, height as f32, 1.0, 1.0],
        _ => return None,
    })
}

/// A light of the sum. A scene without any gets a white one at the camera, so that shapes can be seen.
fn light(frame: &Frame, index: u32) -> Option<Light> {
    let own = lights(frame).nth(index as usize).copied();
    let at_camera = || Light {
        kind: LightKind::Point { position: frame.camera.position },
        color: DVec3::ONE,
        attenuation: Attenuation::NONE,
    };
    own.or_else(|| (index == 0).then(at_camera))
}

/// The lights of the sum: without the ambient ones.
fn lights(frame: &Frame) -> impl Iterator<Item = &Light> {
    frame.lights.iter().filter(|light| light.kind != LightKind::Ambient)
}

fn attenuation(light: Option<Light>) -> [f64; 3] {
    match light {
        Some(Light { kind: LightKind::Point { .. } | LightKind::Spot { .. }, attenuation, .. }) => {
            [attenuation.constant, attenuation.linear, attenuation.quadratic]
        }
        _ => [1.0, 0.0, 0.0],
    }
}
