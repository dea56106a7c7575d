//! Scenes made by hand, for tests.
#![allow(dead_code, clippy::unwrap_used, missing_docs)]

use glam::{DMat4, DVec3};
use gonio_environment::Cubemap;
use gonio_light::{Attenuation, Convention, Equation, Light, LightKind, Optics, Quantity, Specular};
use gonio_mesh::{AmbientRule, Material, Mesh};
use gonio_reference::{Probe, ReferenceScene, Rendered};
use gonio_scene::scene_file::Shading;
use gonio_scene::{
    Background, BoundTexture, Camera, ColorSpace, Frame, LoadedEnvironment, Maps, Scene, SceneMaterial, Surroundings,
    Texture, TextureFilter, ViewSpec,
};
use std::sync::Arc;

/// A scene and a moment of it.
pub struct TestScene {
    pub scene: Scene,
    pub frame: Frame,
}

/// Purely diffuse, linear RGB; no ambient light, no gloss.
pub fn matte(color: [f32; 3]) -> Material {
    Material { diffuse: color, specular: [0.0; 3], ..Material::default() }
}

pub fn directional(direction: [f64; 3], color: f64) -> Light {
    Light {
        kind: LightKind::Directional { direction: DVec3::from(direction).normalize() },
        color: DVec3::splat(color),
        attenuation: Attenuation::NONE,
    }
}

pub fn point(position: [f64; 3], color: f64, attenuation: Attenuation) -> Light {
    Light { kind: LightKind::Point { position: position.into() }, color: DVec3::splat(color), attenuation }
}

pub fn ambient(color: f64) -> Light {
    Light { kind: LightKind::Ambient, color: DVec3::splat(color), attenuation: Attenuation::NONE }
}

pub fn view(quantity: Quantity) -> ViewSpec {
    ViewSpec { quantity, light: None }
}

impl TestScene {
    /// 33 x 33 pixels, one sample, the eye at (0, 0, 5) looking along -Z, black behind, no light, no object.
    pub fn new() -> TestScene {
        TestScene {
            scene: Scene::default(),
            frame: Frame {
                width: 33,
                height: 33,
                samples: 1,
                time: 0.0,
                camera: Camera::looking_along(
                    DVec3::new(0.0, 0.0, 5.0),
                    DVec3::NEG_Z,
                    DVec3::Y,
                    40f64.to_radians(),
                    0.1,
                    100.0,
                ),
                lights: Vec::new(),
                light_shapes: Vec::new(),
                equation: Equation { specular: Specular::None, convention: Convention::Lab, ..Equation::default() },
                shadows: false,
                two_sided: true,
                background: Background { top: DVec3::ZERO, bottom: DVec3::ZERO, transparent: false },
                surroundings: None,
                output: Default::default(),
                texture_filter: TextureFilter::Nearest,
                bounds_min: DVec3::NEG_ONE,
                bounds_max: DVec3::ONE,
            },
        }
    }

    pub fn light(mut self, light: Light) -> TestScene {
        self.frame.lights.push(light);
        self
    }

    /// The eye at `position`, looking at `target`.
    pub fn eye(mut self, position: [f64; 3], target: [f64; 3]) -> TestScene {
        let (position, target) = (DVec3::from(position), DVec3::from(target));
        let c = self.frame.camera;
        self.frame.camera = Camera::looking_along(position, target - position, DVec3::Y, c.fov_y_rad, c.near, c.far);
        self
    }

    pub fn frame(mut self, change: impl FnOnce(&mut Frame)) -> TestScene {
        change(&mut self.frame);
        self
    }

    /// A texture; the index of the next one is the number of those before.
    pub fn texture(mut self, width: u32, height: u32, rgba: &[u8], color_space: ColorSpace) -> TestScene {
        let texture = Texture::new("test", width, height, rgba.to_vec(), color_space);
        self.scene.textures.push(std::sync::Arc::new(texture));
        self
    }

    /// An object of one material.
    pub fn object(self, mesh: Mesh, shading: Shading, material: Material) -> TestScene {
        self.placed(mesh, shading, material, Maps::default(), DMat4::IDENTITY)
    }

    pub fn placed(mut self, mesh: Mesh, shading: Shading, material: Material, maps: Maps, m: DMat4) -> TestScene {
        let object = self.scene.add_object(mesh, SceneMaterial { maps, ..material.into() }, m);
        self.scene.objects[object].shading = shading;
        self
    }

    /// An environment all around, seen and of intensity 1.
    pub fn environment(mut self, map: Cubemap) -> TestScene {
        self.scene.environment = Some(Arc::new(LoadedEnvironment::new("test", map)));
        self.frame.surroundings = Some(Surroundings::default());
        self
    }

    /// The last object's material shows the environment so.
    pub fn optics(mut self, optics: Optics) -> TestScene {
        self.scene.materials.last_mut().unwrap().optics = optics;
        self
    }

    /// The index of refraction of the last object's material.
    pub fn index(mut self, index: f32) -> TestScene {
        self.scene.materials.last_mut().unwrap().material.refraction_index = index;
        self
    }

    /// The last object is closed: its back faces are culled.
    pub fn closed(mut self) -> TestScene {
        self.scene.objects.last_mut().unwrap().closed = true;
        self
    }

    pub fn draw(&self) -> Rendered {
        ReferenceScene::new(&self.scene).render(&self.frame, None, &|_| ())
    }

    pub fn show(&self, quantity: Quantity) -> Rendered {
        ReferenceScene::new(&self.scene).render(&self.frame, Some(view(quantity)), &|_| ())
    }

    /// The picture's middle pixel.
    pub fn middle(&self) -> [f64; 4] {
        self.draw().picture.at(self.frame.width / 2, self.frame.height / 2).map(f64::from)
    }

    /// A debug view's middle pixel, without alpha.
    pub fn middle_of(&self, quantity: Quantity) -> DVec3 {
        let p = self.show(quantity).picture.at(self.frame.width / 2, self.frame.height / 2);
        DVec3::new(p[0].into(), p[1].into(), p[2].into())
    }
}

/// A material's texture without options.
pub fn bound(texture: usize) -> Option<BoundTexture> {
    Some(BoundTexture::plain(texture))
}

/// A mesh of triangles with one normal each vertex.
pub fn mesh(positions: &[[f32; 3]], normals: &[[f32; 3]], indices: &[u32]) -> Mesh {
    Mesh { positions: positions.to_vec(), normals: normals.to_vec(), indices: indices.to_vec(), ..Mesh::default() }
}

/// A square of half edge `half` at height `z`, front towards +Z, uv from (0, 0) to (1, 1), tangents along +X.
pub fn square(half: f32, z: f32) -> Mesh {
    Mesh {
        positions: vec![[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        tex_coords: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        tangents: vec![[1.0, 0.0, 0.0, 1.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    }
}

/// The unit sphere by latitude and longitude, poles on the y axis, closed, with exact normals.
pub fn sphere(rings: u32, segments: u32) -> Mesh {
    let mut positions = vec![[0.0f32, 1.0, 0.0]];
    for ring in 1..rings {
        let theta = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        for segment in 0..segments {
            let phi = std::f64::consts::TAU * f64::from(segment) / f64::from(segments);
            let p = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
            positions.push(p.map(|v| v as f32));
        }
    }
    positions.push([0.0, -1.0, 0.0]);
    let at = |ring: u32, segment: u32| match ring {
        0 => 0,
        r if r == rings => 1 + (rings - 1) * segments,
        r => 1 + (r - 1) * segments + segment % segments,
    };
    let mut indices = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let [a, b, c, d] =
                [at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1), at(ring, segment + 1)];
            if ring + 1 < rings {
                indices.extend([a, b, c]);
            }
            if ring > 0 {
                indices.extend([a, c, d]);
            }
        }
    }
    Mesh { normals: positions.clone(), positions, indices, ..Mesh::default() }
}

/// An environment whose light encodes its direction: [`on_cube`] of the direction. Linear on each face, so that bilinear
/// look-ups are exact but for the f32 of the texels, except within half a texel of a face's edge.
pub fn compass() -> Cubemap {
    Cubemap::from_function(COMPASS_SIZE, on_cube)
}

/// Texels along the edge of a face of [`compass`].
pub const COMPASS_SIZE: u32 = 64;

/// The direction with its largest component 1 or -1.
pub fn on_cube(d: DVec3) -> DVec3 {
    d / d.abs().max_element()
}

/// Whether [`compass`] is exact in this direction.
pub fn is_exact(d: DVec3) -> bool {
    let on_cube = on_cube(d).abs();
    let second = on_cube.element_sum() - 1.0 - on_cube.min_element();
    second < 1.0 - 1.0 / f64::from(COMPASS_SIZE)
}

/// The unit direction through the middle of a pixel.
pub fn ray_of(lab: &TestScene, x: u32, y: u32) -> DVec3 {
    let frame = &lab.frame;
    frame.camera.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, frame.width, frame.height)
}

/// The normal that a shading has where the first object is hit.
pub fn shading_normal(lab: &TestScene, probe: &Probe, shading: Shading) -> DVec3 {
    if matches!(shading, Shading::Flat | Shading::FlatPerFace) {
        return probe.geometry.geometric_normal;
    }
    let w = probe.barycentrics;
    let corners = probe.vertices.map(|v| DVec3::from(lab.scene.meshes[0].normals[v].map(f64::from)));
    (w.x * corners[0] + w.y * corners[1] + w.z * corners[2]).normalize()
}

/// A pixel's colour, alpha left out.
pub fn rgb(pixel: [f32; 4]) -> DVec3 {
    DVec3::new(pixel[0].into(), pixel[1].into(), pixel[2].into())
}

/// `k_a` of its own, so that tests of the ambient term do not depend on `k_d`.
pub fn with_ambient(mut material: Material, value: f32) -> Material {
    material.ambient = AmbientRule::Value([value; 3]);
    material
}

pub fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}
