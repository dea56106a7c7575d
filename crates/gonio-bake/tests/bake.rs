//! Baked textures against the pictures of the scenes that they come from.
#![allow(clippy::unwrap_used, missing_docs)]

use glam::{DMat4, DVec3};
use gonio_atlas::{AtlasUv, UnwrapSettings, unwrap};
use gonio_bake::model::{AtlasSet, MapFile, baked_model};
use gonio_bake::texels::BakedTexels;
use gonio_bake::{BakeSettings, BakedMap, Baker, MapKind, MaterialDetail, SceneSurface};
use gonio_light::color::{ColorEncoding, OutputTransform};
use gonio_light::{Attenuation, Light, Quantity, Specular};
use gonio_mesh::{Material, Mesh, Wrap, sphere};
use gonio_reference::ReferenceScene;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::scene::BoundTexture;
use gonio_scene::{Camera, ColorSpace, DisplayMap, Scene, SceneMaterial, Texture, ViewSpec, load};
use std::path::Path;
use std::sync::Arc;

fn builtin(name: &str) -> Scene {
    load::load(load::describe(&[name], &BuiltinOnly).unwrap(), Path::new(""), &BuiltinOnly).unwrap()
}

fn one_object(mesh: Mesh, material: Material) -> Scene {
    let mut scene = Scene::default();
    scene.add_object(mesh, SceneMaterial::from(material), DMat4::IDENTITY);
    scene
}

struct Baked {
    surface: SceneSurface,
    atlas: AtlasUv,
    map: BakedMap,
}

fn bake(scene: &Scene, kind: MapKind, settings: BakeSettings, finer: Option<&Scene>) -> Baked {
    let surface = SceneSurface::new(scene);
    let settings_of_atlas = match MaterialDetail::new(scene, &surface, &[kind]) {
        Some(detail) if finer.is_none() => detail.applied_to(UnwrapSettings::default()),
        _ => UnwrapSettings::default(),
    };
    let atlas = unwrap(&surface.mesh, &settings_of_atlas, &|_| true).unwrap();
    let frame = scene.frame(0.0);
    let finer = finer.map(|finer| (finer, SceneSurface::new(finer)));
    let map = {
        let mut baker = Baker::new(scene, &frame, &surface, &atlas, settings);
        if let Some((scene, surface)) = &finer {
            baker = baker.from_finer(scene, surface);
        }
        baker.bake(kind, &|_| true).unwrap()
    };
    Baked { surface, atlas, map }
}

/// The texture as a reader of its file has it.
fn texture(map: &BakedMap) -> Texture {
    let mut texture = Texture::decode("baked", &map.encode().unwrap()).unwrap();
    if map.kind == MapKind::Normal {
        texture.color_space = ColorSpace::Data;
    }
    texture
}

/// The scene with the baked model in place of its objects.
fn rebuilt(scene: &Scene, baked: &Baked) -> Scene {
    let file = MapFile { kind: baked.map.kind, name: "baked".into(), factor: baked.map.factor() };
    let model = baked_model(scene, &baked.surface, &baked.atlas, &[file], AtlasSet::Only).model;
    let mut whole = Scene { objects: Vec::new(), meshes: Vec::new(), materials: Vec::new(), ..scene.clone() };
    whole.textures = vec![Arc::new(texture(&baked.map))];
    let mut mesh = model.mesh.clone();
    if baked.map.kind == MapKind::Normal {
        mesh = gonio_mesh::tangents::with_tangents(&mesh).unwrap();
    }
    let parts = mesh.parts.clone();
    whole.add_object(mesh, SceneMaterial::from(Material::default()), DMat4::IDENTITY);
    whole.materials = model.materials.into_iter().map(SceneMaterial::from).collect();
    let bound = BoundTexture { wrap: [Wrap::Clamp; 2], ..BoundTexture::plain(0) };
    for material in &mut whole.materials {
        match baked.map.kind {
            MapKind::Normal => material.maps.normal = Some(bound),
            _ => material.maps.diffuse = Some(bound),
        }
    }
    let part = |part: &gonio_mesh::Part| gonio_scene::ObjectPart {
        name: part.name.clone(),
        first_triangle: part.first_triangle,
        triangle_count: part.triangle_count,
        material: part.material,
    };
    whole.objects[0].parts = parts.iter().map(part).collect();
    whole
}

/// The share of pixels in which two scenes' pictures differ by at most 2/255 in every channel.
fn share_of_equal_pixels(a: &Scene, b: &Scene, frame: &gonio_scene::Frame) -> f64 {
    let transform = OutputTransform { encoding: ColorEncoding::Srgb, ..frame.output };
    let picture = |scene: &Scene| {
        let rendered = ReferenceScene::new(scene).render(frame, None, &|_| ());
        rendered.picture.encode8(&DisplayMap::Light(transform)).rgba
    };
    let (a, b) = (picture(a), picture(b));
    let pairs = a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0);
    let equal = pairs.filter(|(a, b)| a.iter().zip(*b).all(|(a, b)| a.abs_diff(*b) <= 2)).count();
    equal as f64 / (a.len() / 4) as f64
}

/// Issue 20 asks for 2/255 in 99 % of the pixels, at about one texel per pixel: of the still life's floor a pixel covers 1.0 texels
/// in the mean. (In smaller pictures both textures are minified, from other levels.) What differs lies along the hard edges of its
/// checker, in the texels in which the ramp between two texels of the source begins or ends: 99.09 % without, 99.22 % with more
/// texels for the parts that have a texture.
#[test]
fn a_picture_with_the_baked_texture_is_the_same() {
    for (name, least) in [("builtin:still-life", 0.992), ("builtin:suzanne", 0.992)] {
        let scene = builtin(name);
        let mut frame = scene.frame(0.0);
        (frame.width, frame.height, frame.samples) = (1600, 1200, 1);
        frame.equation.specular = Specular::None;
        let baked = bake(&scene, MapKind::Diffuse, BakeSettings::default(), None);
        let share = share_of_equal_pixels(&scene, &rebuilt(&scene, &baked), &frame);
        assert!(share >= least, "{name}: {share}");
    }
}

/// A triangle with a texture between two plain ones of two materials: each has a chart of its own, the textured one with twice as many
/// texels along its edges. Light varies over all of them, so a map of it weights nothing.
#[test]
fn detail_is_where_textures_are() {
    let part = |material: usize| gonio_mesh::Part {
        material,
        first_triangle: material,
        triangle_count: 1,
        ..Default::default()
    };
    let mesh = Mesh {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0]],
        normals: vec![[0.0, 0.0, 1.0]; 5],
        tex_coords: vec![[0.0; 2], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]],
        indices: vec![0, 1, 2, 0, 2, 3, 1, 4, 2],
        parts: (0..3).map(part).collect(),
        ..Mesh::default()
    };
    let mut scene = one_object(mesh, Material::default());
    scene.materials = vec![SceneMaterial::from(Material::default()); 3];
    scene.objects[0].parts = (0..3)
        .map(|material| gonio_scene::ObjectPart {
            name: String::new(),
            first_triangle: material,
            triangle_count: 1,
            material,
        })
        .collect();
    scene.textures = vec![Arc::new(Texture::new("grey", 1, 1, vec![128; 4], ColorSpace::Srgb))];
    scene.materials[0].maps.diffuse = Some(BoundTexture::plain(0));
    let baked = bake(&scene, MapKind::Diffuse, BakeSettings { size: 64, ..BakeSettings::default() }, None);
    assert_eq!(baked.atlas.chart_count, 3);
    let edge = |triangle: usize| {
        let [a, b] = [0, 1].map(|k| glam::Vec2::from(baked.atlas.tex_coords[3 * triangle + k]));
        a.distance(b)
    };
    // Edges of the lengths 1, root of 2 and root of 2.
    assert!((edge(0) / edge(1) * 2.0_f32.sqrt() - 2.0).abs() < 1e-4, "{} {}", edge(0), edge(1));
    assert!((edge(1) - edge(2)).abs() < 1e-4);
    let surface = SceneSurface::new(&scene);
    let plain = |kinds: &[MapKind]| MaterialDetail::new(&scene, &surface, kinds).map(|detail| detail.plain_parts());
    assert_eq!(plain(&[MapKind::Diffuse, MapKind::Emitted]), Some(2));
    assert_eq!(plain(&[MapKind::Specular]), Some(0), "all parts have one specular colour");
    assert_eq!(plain(&[MapKind::Diffuse, MapKind::Light]), None);
}

/// A white sphere: every texel of every level is white, so a lookup that reads beyond a chart sees no seam.
#[test]
fn no_level_has_a_dark_seam() {
    let white = Material { diffuse: [1.0; 3], ..Material::default() };
    let scene = one_object(sphere::sphere(12).unwrap(), white);
    let baked = bake(&scene, MapKind::Diffuse, BakeSettings { size: 128, ..BakeSettings::default() }, None);
    assert!(baked.map.texels.covered.iter().any(|covered| !covered), "there is a background");
    let texture = texture(&baked.map);
    assert!(texture.rgba.iter().all(|value| *value == 255));
    assert_eq!(texture.mip_levels().len(), 7);
    for (number, level) in texture.mip_levels().iter().enumerate() {
        assert!(level.rgba.iter().all(|value| *value == 255), "level {}", number + 1);
    }
}

/// The normals of a sphere of 28,800 triangles on one of 512, as a renderer sees them. With one normal per triangle the map
/// has to bend them by up to 8 degrees; interpolated ones are radial without a map, and must stay so.
#[test]
fn normals_of_a_finer_sphere() {
    let sphere = sphere::sphere(8).unwrap();
    let flat = gonio_mesh::normals::make_flat(&sphere);
    for (name, coarse) in [("smooth", sphere), ("flat", flat)] {
        let mean = mean_error_of_sphere(one_object(coarse, Material::default()));
        assert!(mean <= 1.0, "{name}: {mean} degrees");
    }
}

/// The mean angle between the normals of a fine sphere's picture and those of a coarse one's with its baked map, in degrees.
fn mean_error_of_sphere(coarse: Scene) -> f64 {
    let fine = one_object(sphere::sphere(60).unwrap(), Material::default());
    let settings = BakeSettings { size: 512, cage_distance: 0.05, ..BakeSettings::default() };
    let baked = bake(&coarse, MapKind::Normal, settings, Some(&fine));
    let coarse_with_map = rebuilt(&coarse, &baked);
    let mut frame = fine.frame(0.0);
    (frame.width, frame.height, frame.samples) = (200, 200, 1);
    let eye = DVec3::new(1.0, 1.5, 3.0);
    frame.camera = Camera::looking_along(eye, -eye, DVec3::Y, 0.7, 0.1, 100.0);
    let view = Some(ViewSpec { quantity: Quantity::Normal, light: None });
    let normals = |scene: &Scene| ReferenceScene::new(scene).render(&frame, view, &|_| ()).picture.pixels;
    let (a, b) = (normals(&coarse_with_map), normals(&fine));
    let vector = |p: [f32; 4]| DVec3::new(p[0].into(), p[1].into(), p[2].into());
    let both = a.into_iter().zip(b).filter(|(a, b)| a[3] > 0.0 && b[3] > 0.0);
    let errors: Vec<f64> = both.map(|(a, b)| vector(a).angle_between(vector(b)).to_degrees()).collect();
    assert!(errors.len() > 5000, "{} pixels", errors.len());
    errors.iter().sum::<f64>() / errors.len() as f64
}

/// A square with a texture whose texels are white and black in turn, 8 of them for each texel of the map: in the map of the square
/// itself, and of a coarser one above it, every texel is as bright as half of them.
#[test]
fn minified_textures_are_filtered() {
    let square = |height: f32| Mesh {
        positions: vec![[0.0, 0.0, height], [1.0, 0.0, height], [1.0, 1.0, height], [0.0, 1.0, height]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        tex_coords: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let mut scene = one_object(square(0.0), Material { diffuse: [1.0; 3], ..Material::default() });
    let texels = (0..256 * 256).flat_map(|i| [[0, 0, 0, 255], [255; 4]][(i % 256 + i / 256) % 2]).collect();
    scene.textures = vec![Arc::new(Texture::new("checker", 256, 256, texels, ColorSpace::Srgb))];
    scene.materials[0].maps.diffuse = Some(BoundTexture::plain(0));
    let coarse = one_object(square(0.1), Material::default());
    let settings = BakeSettings { size: 32, cage_distance: 0.2, ..BakeSettings::default() };
    for (name, baked) in [
        ("itself", bake(&scene, MapKind::Diffuse, settings, None)),
        ("coarser", bake(&coarse, MapKind::Diffuse, settings, Some(&scene))),
    ] {
        let values = || baked.map.texels.values.iter().zip(&baked.map.texels.covered).filter(|(_, covered)| **covered);
        let farthest = values().map(|(value, _)| (value[0] - 0.5).abs()).fold(0.0, f32::max);
        // Mip levels are sRGB of 8 bits.
        assert!(farthest < 0.01 && values().count() > 800, "{name}: {farthest}");
    }
}

/// The floor of a room: a square of side 2 below another one.
fn two_squares(height: f32) -> Mesh {
    let square = |y: f32, side: f32| [[-side, y, -side], [-side, y, side], [side, y, side], [side, y, -side]];
    let positions: Vec<[f32; 3]> = square(0.0, 1.0).into_iter().chain(square(height, 0.5)).collect();
    let normals = vec![[0.0, 1.0, 0.0]; 8];
    Mesh { positions, normals, indices: vec![0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7], ..Mesh::default() }
}

/// The value at the place of the floor nearest to (x, 0, z), found by the map of positions.
fn value_at(scene: &Scene, values: &BakedTexels, settings: BakeSettings, x: f64, z: f64) -> f64 {
    let positions = bake(scene, MapKind::Position, settings, None).map.texels;
    let distance = |p: &[f32; 4]| DVec3::new(p[0].into(), p[1].into(), p[2].into()).distance(DVec3::new(x, 0.0, z));
    let nearest = (0..positions.values.len())
        .filter(|&i| positions.covered[i])
        .min_by(|&a, &b| distance(&positions.values[a]).total_cmp(&distance(&positions.values[b])));
    values.values[nearest.unwrap()][0].into()
}

/// Occlusion below the middle of a square: the form factor of a parallel square (J. R. Howell's catalogue, B-3) is
/// 4/(2 pi) (a/sqrt(1+a^2) atan(a/sqrt(1+a^2)) 2), a = half side by height.
#[test]
fn occlusion_is_one_less_the_form_factor() {
    let scene = one_object(two_squares(0.5), Material::default());
    let settings = BakeSettings { size: 64, grid: 4, occlusion_rays: 4096, ..BakeSettings::default() };
    let baked = bake(&scene, MapKind::AmbientOcclusion, settings, None);
    let a = 1.0_f64;
    let one = a / (1.0 + a * a).sqrt();
    let form_factor = 4.0 / std::f64::consts::TAU * 2.0 * one * one.atan();
    let found = value_at(&scene, &baked.map.texels, settings, 0.0, 0.0);
    // 4096 directions, and a texel of finite size.
    assert!((found - (1.0 - form_factor)).abs() < 0.01, "{found}, expected {}", 1.0 - form_factor);
    assert!(value_at(&scene, &baked.map.texels, settings, 0.95, 0.95) > 0.9);
}

/// `<N.L>` of a directional light on the floor, and nothing in the shadow of the square above.
#[test]
fn light_is_that_of_the_equation() {
    let mut scene = one_object(two_squares(0.5), Material::default());
    scene.settings.lights.clear();
    let settings = BakeSettings { size: 64, ..BakeSettings::default() };
    let surface = SceneSurface::new(&scene);
    let atlas = unwrap(&surface.mesh, &UnwrapSettings::default(), &|_| true).unwrap();
    let mut frame = scene.frame(0.0);
    let to_light = DVec3::new(0.0, 2.0, 1.0).normalize();
    let kind = gonio_light::LightKind::Directional { direction: -to_light };
    frame.lights = vec![Light { kind, color: DVec3::splat(0.5), attenuation: Attenuation::NONE }];
    frame.shadows = true;
    let light = Baker::new(&scene, &frame, &surface, &atlas, settings).bake(MapKind::Light, &|_| true).unwrap();
    // The shadow is moved by half the height: from z = -0.75 to 0.25.
    let lit = value_at(&scene, &light.texels, settings, 0.0, 0.8);
    assert!((lit - 0.5 * to_light.y).abs() < 1e-5, "{lit}");
    assert_eq!(value_at(&scene, &light.texels, settings, 0.0, -0.25), 0.0);
}
