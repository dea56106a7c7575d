//! Random scenes of extreme numbers: nothing panics, and every pixel is a number that is not negative.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{RGB, TestScene, cuboid, sphere, square};
use glam::{DMat4, DQuat, DVec3};
use gonio_light::{Attenuation, Convention, Equation, Fresnel, Light, LightKind, Optics, Specular};
use gonio_mesh::{Material, Mesh, MetallicRoughness};
use gonio_scene::LightShape;
use gonio_trace::{Film, Simplification, Simplifications, Technique, TraceScene, TraceSettings};

/// SplitMix64 (G. Steele, D. Lea and C. Flood, 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// In `[0, 1)`.
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn one_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    fn choose<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.bits() as usize % values.len()]
    }

    /// From 0 to 1, the ends included.
    fn share(&mut self) -> f64 {
        let inner = self.unit();
        self.choose(&[0.0, 1.0, inner, inner])
    }

    /// A length or a brightness: ordinary, tiny or huge.
    fn size(&mut self) -> f64 {
        let most = self.choose(&[1.0, 1.0, 20.0]);
        10f64.powf((2.0 * self.unit() - 1.0) * most)
    }

    /// Not always a number.
    fn number(&mut self, usual: f64) -> f64 {
        if self.one_in(40) { self.choose(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0]) } else { usual }
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| 2.0 * self.unit() - 1.0))
    }

    fn color(&mut self) -> [f32; 3] {
        let bright = if self.one_in(4) { self.size() } else { 1.0 };
        [(); 3].map(|()| {
            let channel = bright * self.share();
            self.number(channel) as f32
        })
    }

    fn mesh(&mut self) -> Mesh {
        let mut mesh = match self.bits() % 5 {
            0 => square(1.0, 0.0),
            1 => sphere(6),
            2 => cuboid([1.0, 1.0, 0.0]),
            3 => cuboid([1.0; 3]),
            _ => {
                let positions: Vec<_> = (0..6).map(|_| self.vector().as_vec3().to_array()).collect();
                // A point, a line, and indices beyond the mesh among them.
                Mesh {
                    normals: positions.clone(),
                    positions,
                    indices: vec![0, 1, 2, 3, 3, 3, 0, 1, 0, 3, 4, 5, 0, 1, 9],
                    ..Mesh::default()
                }
            }
        };
        if self.one_in(5) {
            let corner = self.bits() as usize % mesh.positions.len();
            mesh.positions[corner][1] = self.choose(&[f32::NAN, f32::INFINITY, f32::MAX, 1e-40, 1e15]);
        }
        if self.one_in(5) {
            mesh.normals.iter_mut().for_each(|n| *n = [0.0; 3]);
        }
        mesh
    }

    fn material(&mut self) -> (Material, Optics) {
        let shininess = 10f64.powf(6.0 * self.unit()) * self.share();
        let physical = MetallicRoughness {
            base_color: self.color(),
            metallic: self.share() as f32,
            roughness: self.share() as f32,
            metallic_map: None,
            roughness_map: None,
        };
        let material = Material {
            diffuse: self.color(),
            specular: self.color(),
            emitted: if self.one_in(3) { self.color() } else { [0.0; 3] },
            shininess: self.number(shininess) as f32,
            opacity: self.share() as f32,
            refraction_index: (1.0 + 4.0 * self.share()) as f32,
            metallic_roughness: self.one_in(3).then_some(physical),
            ..Material::default()
        };
        let optics = Optics {
            reflectivity: self.share(),
            transmission: self.share(),
            fresnel: self.choose(&[Fresnel::None, Fresnel::Exact, Fresnel::Schlick]),
            absorption: self.vector().abs() * self.size(),
            dispersion: self.choose(&[0.0, 0.05]),
            ..Optics::default()
        };
        (material, if self.one_in(2) { optics } else { Optics::default() })
    }

    fn light(&mut self, size: f64) -> (Light, LightShape) {
        let position = self.vector() * size;
        let kind = match self.bits() % 5 {
            0 => LightKind::Ambient,
            1 => LightKind::Directional { direction: self.vector() },
            2 => {
                let outer_rad = 3.0 * self.share();
                LightKind::Spot { position, axis: self.vector(), inner_rad: self.share() * outer_rad, outer_rad }
            }
            _ => LightKind::Point { position },
        };
        let [constant, linear, quadratic] = [(); 3].map(|()| self.share() * self.size());
        let light = Light {
            kind,
            color: DVec3::from(self.color().map(f64::from)),
            attenuation: Attenuation { constant, linear, quadratic },
        };
        let radius = self.share() * self.size();
        let shape = match self.bits() % 3 {
            0 => LightShape::Point,
            // Around the camera, too.
            1 => LightShape::Sphere { radius: self.number(radius * size) },
            _ => LightShape::Rectangle { half_right: radius * self.vector(), half_up: size * self.vector() },
        };
        (light, shape)
    }

    fn scene(&mut self) -> TestScene {
        let size = self.size();
        let mut scene = TestScene::new();
        for _ in 0..=self.bits() % 4 {
            let scale = DVec3::splat(if self.one_in(3) { self.size() } else { size });
            let turn = DQuat::from_axis_angle(self.vector().normalize_or(DVec3::Y), self.unit());
            let (material, optics) = self.material();
            let m = DMat4::from_scale_rotation_translation(scale, turn, self.vector() * size);
            scene = scene.placed(self.mesh(), material, optics, m);
        }
        for _ in 0..self.bits() % 4 {
            let (light, shape) = self.light(size);
            scene = scene.light(light);
            scene.frame.light_shapes.push(shape);
        }
        if self.one_in(3) {
            let bright = self.size();
            let odd = self.number(bright);
            scene = scene.environment(|d| if d.y > 0.9 { DVec3::splat(odd) } else { DVec3::splat(0.5 + 0.5 * d.x) });
        }
        let eye = self.vector() * self.choose(&[0.0, 1.0, 4.0]) * size;
        scene = scene.eye(eye.to_array(), (self.vector() * size).to_array());
        let camera = &mut scene.frame.camera;
        (camera.near, camera.far) = (1e-3 * size, 1e6 * size);
        camera.fov_y_rad = 0.01 + 2.0 * self.unit();
        (scene.frame.bounds_min, scene.frame.bounds_max) = scene.scene.bounds();
        scene.frame.two_sided = self.one_in(2);
        scene.frame.equation = Equation {
            specular: self.choose(&[Specular::None, Specular::Phong, Specular::BlinnPhong]),
            convention: self.choose(&[Convention::Lab, Convention::Physical]),
            gated: self.one_in(2),
            ..Equation::default()
        };
        scene
    }

    fn settings(&mut self) -> TraceSettings {
        let some = Simplification::ALL.iter().copied().filter(|_| self.one_in(5)).collect::<Simplifications>();
        TraceSettings {
            simplified: self.choose(&[Simplifications::NONE, some, some, Simplifications::ALL]),
            points_per_light: self.choose(&[1, 5]),
            technique: self.choose(&[Technique::Both, Technique::Both, Technique::Lights, Technique::Directions]),
            aperture: self.choose(&[0.0, 0.0, 1.0, 1e20]),
            seed: self.bits(),
            ..RGB
        }
    }
}

#[test]
fn extreme_scenes_give_numbers() {
    let (mut lit, mut lost) = (0, 0);
    for seed in 0..200 {
        let random = &mut Random(seed);
        let (scene, settings) = (random.scene(), random.settings());
        let ready = TraceScene::new(&scene.scene, &scene.frame);
        let mut film = Film::new(8, 8);
        assert!(ready.add_samples(&mut film, &settings, 1 + (seed % 2) as u32, None, &|_| true));
        ready.oddities();
        // Of two channels that are not in sRGB's gamut one may be negative; luminance is not.
        let spectral = !settings.simplified.contains(Simplification::Wavelengths);
        for p in film.picture().pixels {
            let luminance = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
            let least = if spectral { luminance } else { p.into_iter().fold(f32::INFINITY, f32::min) };
            assert!(p.iter().all(|v| v.is_finite()) && least >= 0.0, "seed {seed}: {p:?}");
            lit += u32::from(luminance > 0.0);
        }
        assert!(film.variance().iter().all(|v| *v >= 0.0), "seed {seed}: {:?}", film.variance());
        lost += film.lost_samples();
        let parts = ready.contributions(&settings, 3, 4, 1, &|_| true);
        assert!(parts.total.is_finite(), "seed {seed}: {parts:?}");
        let denoised = film.denoised(&ready.features(&settings, 1));
        assert!(denoised.pixels.iter().flatten().all(|v| v.is_finite()), "seed {seed}: denoised");
    }
    assert!(lit > 2000, "only {lit} of 12,800 pixels are lit");
    assert!(lost < 200, "{lost} samples lost");
}
