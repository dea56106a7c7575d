//! Lightmaps by the path tracer against its own pictures of the same scene.
#![allow(clippy::unwrap_used, missing_docs)]

use glam::{DMat4, DVec2, DVec3};
use gonio_atlas::{AtlasUv, UnwrapSettings, unwrap};
use gonio_bake::{BakeSettings, BakedMap, Baker, LitPoint, MapKind, SceneSurface};
use gonio_light::color::luminance;
use gonio_mesh::{Material, Mesh};
use gonio_scene::{Camera, Frame, Scene, SceneMaterial};
use gonio_trace::{Film, Simplification, Simplifications, SurfacePoint, TraceScene, TraceSettings};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A parallelogram, its front towards `along x across`.
fn quad(corner: [f32; 3], along: [f32; 3], across: [f32; 3]) -> Mesh {
    let add = |a: [f32; 3], b: [f32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let positions = vec![corner, add(corner, along), add(add(corner, along), across), add(corner, across)];
    let mesh = Mesh { positions, indices: vec![0, 1, 2, 0, 2, 3], ..Mesh::default() };
    gonio_mesh::normals::make_flat(&mesh)
}

/// The Cornell box, 2 wide: a red and a green wall, a lamp below the ceiling, and a tall block.
fn cornell_box() -> (Scene, Frame) {
    let mut scene = Scene::default();
    let matte = |diffuse: [f32; 3]| Material { diffuse, specular: [0.0; 3], ..Material::default() };
    let (white, red, green) = (matte([0.73; 3]), matte([0.63, 0.065, 0.05]), matte([0.14, 0.45, 0.091]));
    let lamp = Material { emitted: [17.0, 12.0, 6.0], ..matte([0.0; 3]) };
    let (x, y, z) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]);
    let back = |v: [f32; 3]| v.map(|c| -c);
    let turn = DMat4::from_translation(DVec3::new(-0.3, -1.0, -0.3)) * DMat4::from_rotation_y(0.3);
    let block = |corner, along, across| (quad(corner, along, across), white.clone(), turn);
    let (w, h) = ([0.6, 0.0, 0.0], [0.0, 1.2, 0.0]);
    let d = [0.0, 0.0, 0.6];
    for (mesh, material, place) in [
        (quad([-1.0, -1.0, 1.0], x, back(z)), white.clone(), DMat4::IDENTITY),
        (quad([-1.0, 1.0, -1.0], x, z), white.clone(), DMat4::IDENTITY),
        (quad([-1.0, -1.0, -1.0], x, y), white.clone(), DMat4::IDENTITY),
        (quad([-1.0, -1.0, 1.0], back(z), y), red, DMat4::IDENTITY),
        (quad([1.0, -1.0, -1.0], z, y), green, DMat4::IDENTITY),
        (quad([-0.28, 0.98, -0.3], [0.56, 0.0, 0.0], [0.0, 0.0, 0.6]), lamp, DMat4::IDENTITY),
        block([-0.3, 0.0, 0.3], w, h),
        block([0.3, 0.0, -0.3], back(w), h),
        block([0.3, 0.0, 0.3], back(d), h),
        block([-0.3, 0.0, -0.3], d, h),
        block([-0.3, 1.2, 0.3], w, back(d)),
    ] {
        scene.add_object(mesh, SceneMaterial::from(material), place);
    }
    scene.settings.lights.clear();
    let mut frame = scene.frame(0.0);
    frame.lights.clear();
    frame.light_shapes.clear();
    (frame.width, frame.height) = (64, 64);
    frame.camera = Camera::looking_along(DVec3::new(0.0, 0.0, 3.8), DVec3::NEG_Z, DVec3::Y, 0.66, 0.1, 100.0);
    (scene, frame)
}

struct Lightmap {
    surface: SceneSurface,
    atlas: AtlasUv,
    map: BakedMap,
}

const RGB: TraceSettings = TraceSettings {
    simplified: Simplifications::NONE.with(Simplification::Wavelengths),
    points_per_light: 1,
    most_depth: 64,
    technique: gonio_trace::Technique::Both,
    seed: 3,
    aperture: 0.0,
    focus: 1.0,
    shutter: 0.0,
};

fn bake(scene: &Scene, frame: &Frame, size: u32, paths: u32, settings: &TraceSettings) -> Lightmap {
    let surface = SceneSurface::new(scene);
    let atlas = unwrap(&surface.mesh, &UnwrapSettings::default(), &|_| true).unwrap();
    let ready = TraceScene::new(scene, frame);
    let light_at = |point: &LitPoint| {
        let LitPoint { position, geometric_normal, normal, number } = *point;
        let light = ready.light_at(settings, &SurfacePoint { position, geometric_normal, normal }, number, paths);
        (light.radiance, light.variance)
    };
    let settings = BakeSettings { size, ..BakeSettings::default() };
    let map =
        Baker::new(scene, frame, &surface, &atlas, settings).with_light(&light_at).bake(MapKind::Light, &|_| true);
    Lightmap { map: map.unwrap(), surface, atlas }
}

impl Lightmap {
    /// The triangle that a ray meets first, and the texture coordinates there.
    fn hit(&self, origin: DVec3, direction: DVec3) -> Option<(usize, DVec2)> {
        let hit = |t: usize| {
            let [a, b, c] = self.surface.mesh.triangle_positions(t).map(|p| p.as_dvec3());
            let (u, v) = (b - a, c - a);
            let p = direction.cross(v);
            let along = origin - a;
            let q = along.cross(u);
            let [y, z, distance] = [along.dot(p), direction.dot(q), v.dot(q)].map(|n| n / u.dot(p));
            let uv = |k: usize| DVec2::from(self.atlas.tex_coords[3 * t + k].map(f64::from));
            let at = (1.0 - y - z) * uv(0) + y * uv(1) + z * uv(2);
            (y >= 0.0 && z >= 0.0 && y + z <= 1.0 && distance > 0.0).then_some((distance, t, at))
        };
        let hits = (0..self.surface.mesh.triangle_count()).filter_map(hit);
        hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, t, uv)| (t, uv))
    }

    /// The texels that a bilinear lookup reads, and their weights.
    fn texels(&self, uv: DVec2) -> [(usize, f64); 4] {
        let size = self.map.texels.size as usize;
        let at = uv * size as f64 - 0.5;
        let (low, share) = (at.floor(), at - at.floor());
        let index = |x: f64, y: f64| {
            let [x, y] = [low.x + x, low.y + y].map(|c| c.clamp(0.0, size as f64 - 1.0) as usize);
            y * size + x
        };
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(x, y)| {
            let weight = |share: f64, side: f64| if side > 0.0 { share } else { 1.0 - share };
            (index(x, y), weight(share.x, x) * weight(share.y, y))
        })
    }

    /// The luminance of a block of pixels as the lightmap has it, `k_d` times the map, and its variance; `None` where a lamp is seen,
    /// whose edges would have to be as smooth as those of the picture.
    fn block(&self, scene: &Scene, frame: &Frame, left: u32, top: u32) -> Option<(f64, f64)> {
        let (mut sum, mut weights) = (0.0, std::collections::HashMap::new());
        let samples = f64::from(BLOCK * BLOCK * 4 * 4);
        for (y, x) in (0..4 * BLOCK).flat_map(|y| (0..4 * BLOCK).map(move |x| (y, x))) {
            let at = |first: u32, i: u32| f64::from(first) + (f64::from(i) + 0.5) / 4.0;
            let direction = frame.camera.ray_direction(at(left, x), at(top, y), frame.width, frame.height);
            let (t, uv) = self.hit(frame.camera.position, direction)?;
            let material = &self.surface.material(scene, t).unwrap().material;
            if material.emitted != [0.0; 3] {
                return None;
            }
            let diffuse = DVec3::from(material.diffuse.map(f64::from));
            for (texel, weight) in self.texels(uv) {
                let [r, g, b, variance] = self.map.texels.values[texel].map(f64::from);
                sum += weight * luminance(diffuse * DVec3::new(r, g, b)) / samples;
                // The noise of coloured surfaces is that of one channel, at most.
                weights.entry(texel).or_insert((0.0, variance)).0 += weight * diffuse.max_element() / samples;
            }
        }
        Some((sum, weights.values().map(|(share, variance)| share * share * variance).sum()))
    }
}

const BLOCK: u32 = 8;

/// The differences of all blocks in standard errors of both, and relative to the mean of the picture.
fn compare(settings: &TraceSettings, size: u32) -> (Vec<f64>, f64) {
    let (scene, frame) = cornell_box();
    let lightmap = bake(&scene, &frame, size, 256, settings);
    let mut film = Film::new(frame.width, frame.height);
    let other_noise = TraceSettings { seed: 11, ..*settings };
    assert!(TraceScene::new(&scene, &frame).add_samples(&mut film, &other_noise, 256, None, &|_| true));
    let (picture, variance) = (film.picture(), film.variance());
    let mut errors = Vec::new();
    let (mut traced_sum, mut baked_sum) = (0.0, 0.0);
    for (top, left) in (0..8).flat_map(|y| (0..8).map(move |x| (y * BLOCK, x * BLOCK))) {
        let Some((baked, of_map)) = lightmap.block(&scene, &frame, left, top) else { continue };
        let pixels = (0..BLOCK * BLOCK).map(|i| ((top + i / BLOCK) * frame.width + left + i % BLOCK) as usize);
        let count = f64::from(BLOCK * BLOCK);
        let (mut traced, mut noise) = (0.0, 0.0);
        for i in pixels {
            let [r, g, b, _] = picture.pixels[i].map(f64::from);
            traced += luminance(DVec3::new(r, g, b)) / count;
            noise += variance[i] / (count * count);
        }
        traced_sum += traced;
        baked_sum += baked;
        errors.push((baked - traced).abs() / (noise + of_map).sqrt());
    }
    (errors, baked_sum / traced_sum - 1.0)
}

/// Issue 20: three standard errors. A block that differs by chance is one of 370.
#[test]
fn baked_light_agrees_with_the_traced_picture() {
    let (errors, whole) = compare(&RGB, 128);
    let beyond: Vec<&f64> = errors.iter().filter(|error| **error > 3.0).collect();
    assert!(errors.len() > 56 && beyond.len() <= 1, "{beyond:?} of {}", errors.len());
    assert!(whole.abs() < 0.005, "{whole}");
}

/// A stop is noticed; nothing is returned.
#[test]
fn tracing_stops_when_it_is_told() {
    let (scene, frame) = cornell_box();
    let surface = SceneSurface::new(&scene);
    let atlas = unwrap(&surface.mesh, &UnwrapSettings::default(), &|_| true).unwrap();
    let asked = AtomicUsize::new(0);
    let light_at = |_: &LitPoint| {
        asked.fetch_add(1, Ordering::Relaxed);
        (DVec3::ONE, 0.25)
    };
    let settings = BakeSettings { size: 64, ..BakeSettings::default() };
    let mut baker = Baker::new(&scene, &frame, &surface, &atlas, settings).with_light(&light_at);
    assert!(baker.bake(MapKind::Light, &|_| false).is_none());
    let stopped = asked.swap(0, Ordering::Relaxed);
    let map = baker.bake(MapKind::Light, &|_| true).unwrap();
    let all = asked.load(Ordering::Relaxed);
    assert!(stopped < all, "{stopped} of {all}");
    assert_eq!(map.relative_error(), Some(0.5));
}

/// The mean of four samples has a quarter of the variance. (Samples on the diagonal of the square count for both triangles.)
#[test]
fn the_variance_is_that_of_the_mean() {
    let mut scene = Scene::default();
    let floor = quad([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    scene.add_object(floor, SceneMaterial::from(Material::default()), DMat4::IDENTITY);
    let frame = scene.frame(0.0);
    let surface = SceneSurface::new(&scene);
    let atlas = unwrap(&surface.mesh, &UnwrapSettings::default(), &|_| true).unwrap();
    let light_at = |_: &LitPoint| (DVec3::ONE, 1.0);
    let settings = BakeSettings { size: 16, grid: 2, ..BakeSettings::default() };
    let map =
        Baker::new(&scene, &frame, &surface, &atlas, settings).with_light(&light_at).bake(MapKind::Light, &|_| true);
    let texels = map.unwrap().texels;
    assert_eq!(texels.values[8 * 16 + 4], [1.0, 1.0, 1.0, 0.25]);
}
