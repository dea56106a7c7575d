//! Shadow maps compared with the reference's rays.
//!
//! Shadows are compared by their edges: texels of a map are about as wide as pixels. The project has set 2 pixels: farther
//! from every edge of a traced shadow and from every outline each pixel is lit, or dark, in both.

use super::bench::{Bench, scene_from};
use super::{CLAY, textured_model};
use gonio_light::Quantity;
use gonio_reference::ReferenceScene;
use gonio_scene::{DisplayMap, Picture, Scene, ViewSpec};

const SIZE: [u32; 2] = [480, 360];
/// Pixels from an edge within which the two may differ.
const BAND: i32 = 2;

/// Pixels near an edge of the reference's visibility, or near an outline: there neighbours see different surfaces (with flat
/// shading, different triangles).
fn near_edges([visibility, positions, normals]: [&Picture; 3], flat: bool) -> Vec<bool> {
    let [w, h] = SIZE.map(|side| side as i32);
    let at = |x: i32, y: i32| (y * w + x) as usize;
    let vector = |picture: &Picture, i: usize| {
        let [x, y, z, _] = picture.pixels[i].map(f64::from);
        glam::DVec3::new(x, y, z)
    };
    let mut edge = vec![false; (w * h) as usize];
    for y in 0..h {
        for x in 0..w {
            for (dx, dy) in [(1, 0), (0, 1)] {
                if x + dx >= w || y + dy >= h {
                    continue;
                }
                let (i, j) = (at(x, y), at(x + dx, y + dy));
                let lit = |i: usize| visibility.pixels[i][0] > 0.5;
                let seen = |i: usize| positions.pixels[i][3] > 0.5;
                let (n, other) = (vector(normals, i), vector(normals, j));
                let way = vector(positions, j) - vector(positions, i);
                let folded = way.dot(n).abs() > 0.35 * way.length() || (flat && n.distance(other) > 1e-5);
                if lit(i) != lit(j) || seen(i) != seen(j) || (seen(i) && folded) {
                    (edge[i], edge[j]) = (true, true);
                }
            }
        }
    }
    let mut near = vec![false; edge.len()];
    for y in 0..h {
        for x in 0..w {
            let mut around = (-BAND..=BAND).flat_map(|dy| (-BAND..=BAND).map(move |dx| (x + dx, y + dy)));
            near[at(x, y)] = around.any(|(x, y)| (0..w).contains(&x) && (0..h).contains(&y) && edge[at(x, y)]);
        }
    }
    near
}

fn compare(bench: &mut Bench, name: &str, scene: &Scene, lights: &[usize]) {
    let mut scene = scene.clone();
    [scene.settings.picture.width, scene.settings.picture.height] = SIZE;
    let frame = scene.frame(0.0);
    assert!(frame.shadows);
    let uploaded = bench.renderer.upload(&scene).unwrap();
    let reference = ReferenceScene::new(&scene);
    let mut any_edge = vec![false; (SIZE[0] * SIZE[1]) as usize];
    for &light in lights {
        let view = ViewSpec { quantity: Quantity::Visibility, light: Some(light) };
        let gpu = bench.renderer.render(&uploaded, &frame, Some(view)).unwrap().linear().unwrap();
        let whole = |quantity| ViewSpec { quantity, light: None };
        let views = [view, whole(Quantity::Position), whole(Quantity::GeometricNormal)];
        let views = reference.views(&frame, &views, &|_| ());
        let cpu = &views[0].picture;
        let flat = scene.objects[0].shading.name() == "flat";
        let near = near_edges([cpu, &views[1].picture, &views[2].picture], flat);
        let (mut lit, mut dark, mut acne, mut leaks) = (0, 0, Vec::new(), Vec::new());
        for (i, (a, b)) in gpu.pixels.iter().zip(&cpu.pixels).enumerate() {
            if near[i] || b[3] < 0.5 {
                any_edge[i] |= near[i];
                continue;
            }
            let place = || (i as u32 % SIZE[0], i as u32 / SIZE[0], a[0]);
            if b[0] > 0.5 {
                lit += 1;
                acne.extend((a[0] < 0.999).then(place));
            } else {
                dark += 1;
                leaks.extend((a[0] > 0.001).then(place));
            }
        }
        let few = |v: &[(u32, u32, f32)]| format!("{} at {:?}", v.len(), &v[..v.len().min(5)]);
        assert!(lit > 10_000 && dark > 1_000, "{name} {light}: {lit} lit and {dark} dark pixels test little");
        assert!(acne.is_empty() && leaks.is_empty(), "{name} {light}: dark {}; lit {}", few(&acne), few(&leaks));
    }
    let drawn = bench.renderer.render(&uploaded, &frame, None).unwrap();
    let gpu8 = drawn.encoded8().unwrap();
    let cpu8 = reference.render(&frame, None, &|_| ()).picture.encode8(&DisplayMap::for_view(None, &frame));
    let far = |i: usize| (0..4).any(|c| gpu8.rgba[4 * i + c].abs_diff(cpu8.rgba[4 * i + c]) > 1);
    let differing: Vec<usize> = (0..any_edge.len()).filter(|&i| far(i)).collect();
    let share = differing.len() as f64 / any_edge.len() as f64;
    assert!(share <= 0.01, "{name}: {:.2} % differ", 100.0 * share);
    let stray: Vec<_> = differing.iter().filter(|&&i| !any_edge[i]).map(|i| (i % 480, i / 480)).collect();
    assert!(
        stray.is_empty(),
        "{name}: {} pixels differ away from edges: {:?}",
        stray.len(),
        &stray[..stray.len().min(5)]
    );
}

/// A floor with a sphere above it, a cube that stands on it, a sheet without thickness, and a wall.
fn stage(shading: &str, lights: &str, equation: &str) -> Scene {
    let object = |model: &str, place: &str| {
        format!("[[object]]\nmodel = \"builtin:{model}\"\nshading = \"{shading}\"\n{place}\nmaterial = {{ {CLAY} }}\n")
    };
    let objects = [
        object("cube", "scale = [4, 0.1, 4]\ntranslate = [0, -0.1, 0]"),
        object("sphere-smooth", "scale = [0.5, 0.5, 0.5]\ntranslate = [0.2, 0.9, 0.9]"),
        object("cube", "scale = [0.4, 0.4, 0.4]\nrotate = [0, 30, 0]\ntranslate = [-1.1, 0.4, 0.4]"),
        object("suzanne", "scale = [0.5, 0.5, 0.5]\ntranslate = [1.5, 0.6, -0.6]"),
        object("cube", "scale = [4, 1, 0.1]\ntranslate = [0, 1, -2]"),
    ];
    scene_from(
        "position = [1.5, 3.0, 6.0]\ntarget = [0.1, 0.4, 0.0]",
        &format!("shadows = true\n{equation}"),
        lights,
        &objects.concat(),
    )
}

const SUN: &str = "[[light]]\nkind = \"directional\"\ndirection = [-0.6, -1.2, -0.7]\n";
const LAMP: &str = "[[light]]\nkind = \"point\"\nposition = [-0.4, 2.6, 1.8]\nconstant = 1\nquadratic = 0.05\n";
const NARROW: &str = "[[light]]\nkind = \"spot\"\nposition = [1.5, 4, 3]\ndirection = [-0.35, -1, -0.8]\n\
                      inner_angle = 20\nouter_angle = 34\n";
const WIDE: &str = "[[light]]\nkind = \"spot\"\nposition = [-1.5, 3, 1.5]\ndirection = [0.3, -1, -0.2]\n\
                    inner_angle = 40\nouter_angle = 85\n";
const FAINT: &str = "[[light]]\nkind = \"ambient\"\nintensity = 0.2\n";

#[test]
fn shadows_of_every_kind_of_light() {
    for es in [false, true] {
        let mut bench = Bench::with(es);
        for (name, light) in [("directional", SUN), ("point", LAMP), ("narrow spot", NARROW), ("wide spot", WIDE)] {
            for shading in if es { &["phong"][..] } else { &["phong", "flat"] } {
                compare(
                    &mut bench,
                    &format!("{name} {shading} es {es}"),
                    &stage(shading, &format!("{FAINT}{light}"), ""),
                    &[1],
                );
            }
        }
    }
}

#[test]
fn shadows_of_several_lights_add_up() {
    let lights = format!("{LAMP}{FAINT}{SUN}{WIDE}{NARROW}");
    let mut bench = Bench::new();
    compare(&mut bench, "all", &stage("phong", &lights, "convention = \"physical\""), &[0, 2, 3, 4]);
}

/// Light that is summed at vertices is tested for shadows there: the corners of these triangles are lit, or dark, in both.
#[test]
fn shadows_at_vertices() {
    let mut bench = Bench::new();
    for shading in ["gouraud", "flat-per-face"] {
        let scene = stage(shading, &format!("{FAINT}{SUN}"), "");
        let frame = scene.frame(0.0);
        let uploaded = bench.renderer.upload(&scene).unwrap();
        let view = Some(ViewSpec { quantity: Quantity::Visibility, light: Some(1) });
        let gpu = bench.renderer.render(&uploaded, &frame, view).unwrap().linear().unwrap();
        let cpu = ReferenceScene::new(&scene).render(&frame, view, &|_| ()).picture;
        let differs = gpu.pixels.iter().zip(&cpu.pixels).filter(|(a, b)| (a[0] - b[0]).abs() > 0.1).count();
        // A few vertices near the boundary of light and dark, with the triangles around them.
        assert!(differs * 50 <= gpu.pixels.len(), "{shading}: {differs} of {}", gpu.pixels.len());
        let dark = cpu.pixels.iter().filter(|p| p[3] > 0.5 && p[0] < 0.1).count();
        assert!(dark > 50, "{shading}: {dark} dark pixels test little");
    }
}

/// Opacity decides: 0.4 casts none, 0.6 does, and a texture that is 0.8 everywhere does too.
#[test]
fn shadows_of_what_is_not_opaque() {
    let folder = tempfile::tempdir().unwrap();
    let model = textured_model::write(folder.path());
    let mut bench = Bench::new();
    let scene = |opacity: f32, textured: bool| {
        let stage = "[[object]]\nmodel = \"builtin:cube\"\nscale = [4, 0.1, 4]\ntranslate = [0, -1.6, 0]\n";
        let model = if textured { model.display().to_string() } else { "builtin:sphere-smooth".to_owned() };
        let caster = format!("[[object]]\nmodel = \"{model}\"\n");
        let camera = "position = [1.5, 3.0, 6.0]\ntarget = [0.1, -0.6, 0.0]";
        let mut scene = scene_from(camera, "shadows = true", SUN, &format!("{stage}{caster}"));
        // Of the sphere alone; `opacity` in a scene file replaces the texture.
        if let Some(material) = scene.materials.last_mut() {
            assert_eq!(material.maps.opacity.is_some(), textured);
            material.material.opacity = opacity;
        }
        scene
    };
    for (opacity, textured, casts) in [(0.4, false, false), (0.6, false, true), (1.0, true, true), (0.5, true, false)] {
        let scene = scene(opacity, textured);
        let frame = scene.frame(0.0);
        let uploaded = bench.renderer.upload(&scene).unwrap();
        let mut shaded = scene.clone();
        shaded.settings.equation.shadows = false;
        let dark = |a: &Picture, b: &Picture| a.pixels.iter().zip(&b.pixels).filter(|(a, b)| a[0] < 0.8 * b[0]).count();
        let lit = bench.renderer.render(&uploaded, &shaded.frame(0.0), None).unwrap().linear().unwrap();
        let gpu = dark(&bench.renderer.render(&uploaded, &frame, None).unwrap().linear().unwrap(), &lit);
        let reference = ReferenceScene::new(&scene);
        let cpu = dark(&reference.render(&frame, None, &|_| ()).picture, &lit);
        assert_eq!((gpu > 200, cpu > 200), (casts, casts), "{opacity} {textured}: {gpu} and {cpu} pixels");
    }
}
