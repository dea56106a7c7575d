//! Scenes made by hand, and pictures of them.
#![allow(dead_code, clippy::unwrap_used, missing_docs)]

use glam::{DMat4, DVec3};
use gonio_environment::Cubemap;
use gonio_light::{Attenuation, Convention, Equation, Light, LightKind, Optics, Specular};
use gonio_mesh::{Material, Mesh};
use gonio_scene::{Background, Camera, Frame, LoadedEnvironment, Scene, SceneMaterial, Surroundings, TextureFilter};
use gonio_trace::{Film, Simplification, Simplifications, TraceScene, TraceSettings};
use std::sync::Arc;

#[derive(Clone)]
pub struct TestScene {
    pub scene: Scene,
    pub frame: Frame,
}

/// RGB, no limit of depth that matters.
pub const RGB: TraceSettings = TraceSettings {
    simplified: Simplifications::NONE.with(Simplification::Wavelengths),
    points_per_light: 1,
    most_depth: 200,
    technique: gonio_trace::Technique::Both,
    seed: 1,
    aperture: 0.0,
    focus: 1.0,
    shutter: 0.0,
};

pub fn matte(color: f32) -> Material {
    Material { diffuse: [color; 3], specular: [0.0; 3], ..Material::default() }
}

pub fn point(position: [f64; 3], color: f64) -> Light {
    Light {
        kind: LightKind::Point { position: position.into() },
        color: DVec3::splat(color),
        attenuation: Attenuation::INVERSE_SQUARE,
    }
}

impl TestScene {
    /// 8 x 8 pixels, 5 degrees wide, the eye at (0, 0, 5) looking along -Z, black behind, physical units.
    pub fn new() -> TestScene {
        TestScene {
            scene: Scene::default(),
            frame: Frame {
                width: 8,
                height: 8,
                samples: 1,
                time: 0.0,
                camera: Camera::looking_along(
                    DVec3::new(0.0, 0.0, 5.0),
                    DVec3::NEG_Z,
                    DVec3::Y,
                    5f64.to_radians(),
                    1e-3,
                    1e6,
                ),
                lights: Vec::new(),
                light_shapes: Vec::new(),
                equation: Equation {
                    specular: Specular::Phong,
                    convention: Convention::Physical,
                    ..Equation::default()
                },
                shadows: false,
                two_sided: true,
                background: Background { top: DVec3::ZERO, bottom: DVec3::ZERO, transparent: false },
                surroundings: None,
                output: Default::default(),
                texture_filter: TextureFilter::Linear,
                bounds_min: DVec3::NEG_ONE,
                bounds_max: DVec3::ONE,
            },
        }
    }

    pub fn light(mut self, light: Light) -> TestScene {
        self.frame.lights.push(light);
        self
    }

    pub fn eye(mut self, position: [f64; 3], target: [f64; 3]) -> TestScene {
        let (position, target) = (DVec3::from(position), DVec3::from(target));
        let c = self.frame.camera;
        self.frame.camera = Camera::looking_along(position, target - position, DVec3::Y, c.fov_y_rad, c.near, c.far);
        self
    }

    pub fn object(self, mesh: Mesh, material: Material) -> TestScene {
        self.placed(mesh, material, Optics::default(), DMat4::IDENTITY)
    }

    pub fn placed(mut self, mesh: Mesh, material: Material, optics: Optics, m: DMat4) -> TestScene {
        self.scene.add_object(mesh, SceneMaterial { optics, ..material.into() }, m);
        self
    }

    pub fn environment(mut self, radiance: impl Fn(DVec3) -> DVec3) -> TestScene {
        let map = Cubemap::from_function(64, radiance);
        self.scene.environment = Some(Arc::new(LoadedEnvironment::new("test", map)));
        self.frame.surroundings = Some(Surroundings::default());
        self
    }

    #[track_caller]
    pub fn trace(&self, settings: &TraceSettings, samples: u32) -> Film {
        let mut film = Film::new(self.frame.width, self.frame.height);
        let finished =
            TraceScene::new(&self.scene, &self.frame).add_samples(&mut film, settings, samples, None, &|_| true);
        assert!(finished && film.lost_samples() == 0, "{} samples lost", film.lost_samples());
        film
    }

    /// The mean of all pixels, and the standard error of its luminance.
    pub fn mean(&self, settings: &TraceSettings, samples: u32) -> (DVec3, f64) {
        let film = self.trace(settings, samples);
        let pixels = film.picture().pixels;
        let n = pixels.len() as f64;
        let sum: DVec3 = pixels.iter().map(|p| DVec3::new(p[0].into(), p[1].into(), p[2].into())).sum();
        (sum / n, (film.variance().iter().sum::<f64>()).sqrt() / n)
    }
}

/// A square of half edge `half` at height `z`, front towards +Z.
pub fn square(half: f32, z: f32) -> Mesh {
    Mesh {
        positions: vec![[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    }
}

/// The unit sphere by latitude and longitude, closed, with exact normals.
pub fn sphere(rings: u32) -> Mesh {
    let segments = 2 * rings;
    let mut mesh = Mesh::default();
    for ring in 0..=rings {
        let theta = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        for segment in 0..segments {
            let phi = std::f64::consts::TAU * f64::from(segment) / f64::from(segments);
            let p = [theta.sin() * phi.cos(), theta.cos(), -theta.sin() * phi.sin()].map(|v| v as f32);
            mesh.positions.push(p);
            mesh.normals.push(p);
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let [a, b] = [segment, next].map(|s| ring * segments + s);
            let [c, d] = [segment, next].map(|s| (ring + 1) * segments + s);
            mesh.indices.extend([a, c, d, a, d, b]);
        }
    }
    mesh
}

/// The box from -`half` to +`half`, fronts outwards.
pub fn cuboid(half: [f32; 3]) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let first = mesh.positions.len() as u32;
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for (su, sv) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let (mut p, mut n) = ([0.0; 3], [0.0; 3]);
                p[axis] = sign * half[axis];
                p[u] = su * half[u];
                p[v] = sv * half[v];
                n[axis] = sign;
                mesh.positions.push(p);
                mesh.normals.push(n);
            }
            let quad = if sign > 0.0 { [0, 1, 2, 0, 2, 3] } else { [0, 2, 1, 0, 3, 2] };
            mesh.indices.extend(quad.map(|i| first + i));
        }
    }
    mesh
}

/// The irradiance from a square lamp of radiance 1 at a point below its centre (Lambert's formula): each edge adds its
/// angle times its tilt.
pub fn irradiance_below_square(half: f64, height: f64) -> f64 {
    let corners =
        [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| DVec3::new(x, y, height).normalize());
    let sum: f64 = (0..4)
        .map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            a.cross(b).normalize().z * a.dot(b).acos()
        })
        .sum();
    0.5 * sum.abs()
}
