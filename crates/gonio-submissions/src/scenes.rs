//! Test scenes of the generator's own: meshes, places, lights; and the value of each input in them.

use glam::{Mat3, Mat4, Quat, Vec3};

/// The meaning of an input of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    Position,
    Normal,
    Model,
    View,
    Projection,
    ModelView,
    ViewProjection,
    ModelViewProjection,
    InverseTranspose,
    NormalMatrix,
    NormalMatrixInEye,
    ViewPosition,
    /// A value of a light, by the number of the light.
    OfLight(Field, usize),
    /// A value of all lights, in an array.
    OfAll(Field),
    Shininess,
    Material,
    Index,
    Cubemap,
    /// Unused, and of any value.
    Unused,
}

/// A value of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Field {
    Position,
    PositionInEye,
    Ambient,
    Diffuse,
    Specular,
    Constant,
    Linear,
    Quadratic,
}

/// A light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    pub position: Vec3,
    /// Ambient, diffuse, specular.
    pub strengths: [f32; 3],
    /// kc, kl, kq.
    pub attenuation: [f32; 3],
}

/// A scene with one object.
#[derive(Clone, Debug)]
pub(crate) struct BenchScene {
    pub mesh: Mesh,
    pub model: Mat4,
    pub eye: Vec3,
    pub view: Mat4,
    pub projection: Mat4,
    pub lights: [Light; 2],
    pub shininess: f32,
    pub material: Vec3,
    pub index: f32,
}

impl BenchScene {
    /// The value of a uniform.
    pub fn value(&self, meaning: Meaning) -> Vec<f32> {
        let mat3 = |m: Mat4| Mat3::from_mat4(m).inverse().transpose().to_cols_array().to_vec();
        match meaning {
            Meaning::Model => self.model.to_cols_array().to_vec(),
            Meaning::View => self.view.to_cols_array().to_vec(),
            Meaning::Projection => self.projection.to_cols_array().to_vec(),
            Meaning::ModelView => (self.view * self.model).to_cols_array().to_vec(),
            Meaning::ViewProjection => (self.projection * self.view).to_cols_array().to_vec(),
            Meaning::ModelViewProjection => (self.projection * self.view * self.model).to_cols_array().to_vec(),
            Meaning::InverseTranspose => self.model.inverse().transpose().to_cols_array().to_vec(),
            Meaning::NormalMatrix => mat3(self.model),
            Meaning::NormalMatrixInEye => mat3(self.view * self.model),
            Meaning::ViewPosition => self.eye.to_array().to_vec(),
            Meaning::OfLight(field, index) => self.of_light(field, index),
            Meaning::OfAll(field) => [self.of_light(field, 0), self.of_light(field, 1)].concat(),
            Meaning::Shininess => vec![self.shininess],
            Meaning::Material => self.material.to_array().to_vec(),
            Meaning::Index => vec![self.index],
            Meaning::Position | Meaning::Normal | Meaning::Cubemap | Meaning::Unused => vec![0.0],
        }
    }
}

impl BenchScene {
    fn of_light(&self, field: Field, index: usize) -> Vec<f32> {
        let light = self.lights[index.min(1)];
        match field {
            Field::Position => light.position.to_array().to_vec(),
            Field::PositionInEye => self.view.transform_point3(light.position).to_array().to_vec(),
            Field::Ambient => vec![light.strengths[0]],
            Field::Diffuse => vec![light.strengths[1]],
            Field::Specular => vec![light.strengths[2]],
            Field::Constant => vec![light.attenuation[0]],
            Field::Linear => vec![light.attenuation[1]],
            Field::Quadratic => vec![light.attenuation[2]],
        }
    }
}

/// Vertices and triangles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// A closed grid around a shape; `vertex` gives position and normal by two angles.
fn grid(around: u32, along: u32, vertex: impl Fn(f32, f32) -> (Vec3, Vec3)) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=along {
        for column in 0..=around {
            let (p, n) = vertex(column as f32 / around as f32, row as f32 / along as f32);
            mesh.positions.push(p);
            mesh.normals.push(n);
        }
    }
    for row in 0..along {
        for column in 0..around {
            let a = row * (around + 1) + column;
            let (b, c, d) = (a + 1, a + around + 2, a + around + 1);
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// An ellipsoid whose normals are not its positions.
fn ellipsoid(around: u32, along: u32, radii: Vec3) -> Mesh {
    use std::f32::consts::{PI, TAU};
    grid(around, along, |u, v| {
        let (a, b) = (u * TAU, PI - v * PI);
        let p = Vec3::new(b.sin() * a.cos(), b.cos(), -b.sin() * a.sin());
        (p * radii, (p / radii).normalize())
    })
}

fn torus(around: u32, tube: u32) -> Mesh {
    use std::f32::consts::TAU;
    grid(around, tube, |u, v| {
        let (a, b) = (u * TAU, v * TAU);
        let n = Vec3::new(b.cos() * a.cos(), b.sin(), -b.cos() * a.sin());
        (Vec3::new(a.cos(), 0.0, -a.sin()) * 0.75 + 0.32 * n, n)
    })
}

fn cube() -> Mesh {
    let side = |corner: u32, bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let positions: Vec<Vec3> = (0..8).map(|c| Vec3::new(side(c, 0), side(c, 1), side(c, 2))).collect();
    let sides = [[1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]];
    Mesh {
        normals: positions.iter().map(|p| p.normalize()).collect(),
        positions,
        triangles: sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

/// The lab's strengths and constants of attenuation.
pub(crate) const LAB: Light =
    Light { position: Vec3::new(1.0, 2.0, 1.5), strengths: [0.1, 0.5, 0.8], attenuation: [1.0, 0.14, 0.07] };
/// The lab's other values: the exponent, the material and the refractive index.
pub(crate) const LAB_SHININESS: f32 = 32.0;
pub(crate) const LAB_MATERIAL: Vec3 = Vec3::new(0.5, 0.6, 0.8);
pub(crate) const LAB_INDEX: f32 = 1.52;

fn scene(mesh: Mesh, model: Mat4, eye: [f32; 3], target: [f32; 3], up: [f32; 3], light: [f32; 3]) -> BenchScene {
    let (eye, target) = (Vec3::from(eye), Vec3::from(target));
    let first = Light { position: light.into(), ..LAB };
    let second = Light {
        position: target + Quat::from_rotation_y(1.9) * (first.position - target) * 0.9,
        strengths: [0.05, 0.4, 0.5],
        attenuation: [1.0, 0.1, 0.12],
    };
    BenchScene {
        mesh,
        model,
        eye,
        view: glam::camera::rh::view::look_at_mat4(eye, target, up.into()),
        projection: glam::camera::rh::proj::opengl::perspective(0.75, 1.0, 0.1, 100.0),
        lights: [first, second],
        shininess: LAB_SHININESS,
        material: LAB_MATERIAL,
        index: LAB_INDEX,
    }
}

fn placed(at: [f32; 3], turn: [f32; 3], scale: [f32; 3]) -> Mat4 {
    let [y, x, z] = turn;
    Mat4::from_scale_rotation_translation(scale.into(), Quat::from_euler(glam::EulerRot::YXZ, y, x, z), at.into())
}

/// The scenes for programs that compute light, and for mirrors and glass: stretched, turned and moved models; coarse meshes;
/// lights near, far and behind; several eyes.
pub(crate) fn objects() -> Vec<BenchScene> {
    const UP: [f32; 3] = [0.0, 1.0, 0.0];
    let sphere = |around, along| ellipsoid(around, along, Vec3::ONE);
    let stretched = placed([0.3, -0.2, -0.5], [0.6, 0.8, 0.3], [0.55, 1.15, 0.35]);
    let turned = placed([0.5, 0.4, -0.4], [0.4, -0.7, 0.5], [0.75, 0.5, 0.95]);
    let small = placed([-0.3, 0.2, 0.1], [0.2, 0.4, 0.0], [0.5; 3]);
    let behind = placed([-0.2, 0.1, -0.3], [-1.0, 0.2, 0.0], [0.8; 3]);
    let far = placed([0.2, 0.1, 0.0], [1.0, 0.3, 0.0], [0.8, 0.9, 0.7]);
    let mut all = vec![
        scene(torus(16, 9), stretched, [1.8, 1.0, 2.1], [0.3, -0.2, -0.5], UP, [1.5, 2.1, 1.3]),
        scene(sphere(7, 5), small, [0.6, 0.6, 1.6], [-0.3, 0.2, 0.1], UP, [0.6, 0.9, 0.9]),
        scene(torus(14, 8), behind, [0.3, 0.9, 2.5], [-0.2, 0.1, -0.3], UP, [-1.1, 1.0, -2.0]),
        scene(torus(14, 8), far, [-0.5, 0.6, 2.7], [0.2, 0.1, 0.0], UP, [3.6, 4.2, 4.1]),
        scene(torus(12, 8), turned, [-1.5, -0.9, -2.3], [0.5, 0.4, -0.4], [0.4, 1.0, 0.2], [-1.5, 1.1, -1.9]),
        scene(
            ellipsoid(9, 7, Vec3::new(0.6, 1.0, 0.8)),
            placed([-0.4, -0.3, -0.4], [0.0, 0.5, 0.7], [0.9, 0.8, 0.7]),
            [0.4, -0.2, 2.3],
            [-0.4, -0.3, -0.4],
            UP,
            [1.1, 0.7, 1.5],
        ),
    ];
    for (index, scene) in all.iter_mut().enumerate() {
        scene.shininess = [32.0, 20.0, 6.0, 12.0, 32.0, 10.0][index % 6];
        scene.lights[0].attenuation[0] = [1.0, 1.0, 0.8, 1.0, 1.2, 0.9][index % 6];
        scene.lights[0].strengths[0] = [0.1, 0.1, 0.25, 0.35, 0.1, 0.2][index % 6];
        scene.index = [1.52, 1.52, 1.33, 1.4, 1.52, 1.3][index % 6];
    }
    if let Some(last) = all.last_mut() {
        last.material = Vec3::new(0.85, 0.4, 0.15);
    }
    all
}

/// The scenes for skyboxes.
pub(crate) fn skies() -> Vec<BenchScene> {
    let sky = |eye: [f32; 3], towards: [f32; 3], up: [f32; 3]| {
        let target = (Vec3::from(eye) + Vec3::from(towards)).to_array();
        scene(cube(), Mat4::IDENTITY, eye, target, up, [1.0, 2.0, 1.5])
    };
    vec![
        sky([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        sky([0.5, 0.3, 0.4], [-0.6, 0.4, 0.8], [0.0, 1.0, 0.0]),
        sky([0.2, -0.4, 0.1], [1.0, 0.2, -0.3], [0.0, 1.0, 0.0]),
        sky([-3.0, 1.0, 2.0], [0.3, 1.0, 0.2], [0.4, 0.0, -1.0]),
    ]
}

/// The light from a direction: smooth and without symmetry.
pub(crate) fn radiance(direction: Vec3) -> Vec3 {
    let d = direction.normalize();
    let wave = |x: f32, y: f32, z: f32, phase: f32| 0.5 + 0.4 * (d.dot(Vec3::new(x, y, z)) + phase).sin();
    Vec3::new(wave(2.1, 0.6, -0.5, 0.2), wave(0.4, 2.3, 0.7, 1.3), wave(-0.7, 0.8, 2.2, -0.6))
}
