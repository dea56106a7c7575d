//! Environments on the GPU: the same directions, texels and seams as on the CPU, also when converted; difference maps of
//! pictures.

use crate::conversion::Converter;
use crate::environment_on_gpu::{CubeTexture, EnvironmentOnGpu, Seamless};
use crate::scene_on_gpu::{GpuCache, GpuScene};
use crate::{DifferenceScale, DisplayTexture, Renderer};
use glam::{DMat3, DVec3};
use gonio_environment::convert::{Conversion, EnvironmentRef, Filter};
use gonio_environment::{CubeMips, Cubemap, Face, Layout, Panorama};
use gonio_gl::objects::{TextureObject, VertexArray};
use gonio_gl::program::Program;
use gonio_gl::target::OutputTarget;
use gonio_gl::{Dialect, DriverInfo, Texels};
use gonio_image::Pixel;
use gonio_scene::difference::{heat, signed};
use gonio_scene::files::Disk;
use gonio_scene::{LoadedEnvironment, Scene};
use std::path::Path;
use std::sync::Arc;

/// Looks a cube texture up with `textureLod` at (direction, level).
fn look_up(es: bool, mips: &CubeMips, at: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let context = super::context(es);
    let gl = context.gl();
    let dialect = if es { Dialect::Es300 } else { Dialect::Core330 };
    let fragment = format!(
        "{}uniform highp samplerCube map;\nuniform highp sampler2D places;\nout vec4 result;\nvoid main() {{\n\
         vec4 place = texelFetch(places, ivec2(gl_FragCoord.xy), 0);\nresult = textureLod(map, place.xyz, place.w);\n}}\n",
        dialect.header()
    );
    let vertex = format!("{}{}", dialect.header(), include_str!("../../shaders/output.vert"));
    let program = Program::new(gl, "look up", &vertex, &fragment, &[]).unwrap_or_else(|error| panic!("{error}"));
    let cube = CubeTexture::upload(gl, "cube", mips.levels(), 1 << 14).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((cube.size, cube.levels_left_out), (mips.full().size(), 0));
    let width = 64;
    let height = at.len().div_ceil(width);
    let mut places = at.to_vec();
    places.resize(width * height, [0.0, 0.0, 1.0, 0.0]);
    gl.active_texture(glow::TEXTURE1);
    let texture = TextureObject::bound(gl, "places").unwrap_or_else(|error| panic!("{error}"));
    let target = OutputTarget::new(gl, [width as i32, height as i32], true).unwrap_or_else(|error| panic!("{error}"));
    let array = VertexArray::bound(gl, "none").unwrap_or_else(|error| panic!("{error}"));
    let _seamless = Seamless::new(gl);
    gl.bind_texture(glow::TEXTURE_2D, Some(texture.handle()));
    gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MIN_FILTER, glow::NEAREST as i32);
    gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAG_FILTER, glow::NEAREST as i32);
    gl.tex_image_2d(
        glow::TEXTURE_2D,
        0,
        glow::RGBA32F,
        [width as i32, height as i32],
        Texels::f32(glow::RGBA, bytemuck::cast_slice(&places)),
    );
    cube.bind(gl, 0);
    target.bind(gl);
    program.bind();
    program.set_i32("map", 0);
    program.set_i32("places", 1);
    gl.bind_vertex_array(Some(array.handle()));
    gl.draw_arrays(glow::TRIANGLES, 0, 3);
    let values = target.read_f32(gl);
    bytemuck::cast_slice::<f32, [f32; 4]>(&values)[..at.len()].to_vec()
}

/// A cubemap whose texels all differ, most of them much from their neighbours.
fn speckled(size: u32) -> Cubemap {
    let mut map = Cubemap::new(size, [0.0; 4]);
    for (i, pixel) in map.pixels_mut().iter_mut().enumerate() {
        let hash = (i as u32).wrapping_mul(0x9E37_79B9) >> 8;
        let [r, g, b] = [hash, hash / 64, hash / 4096].map(|v| (v % 64) as f32 / 4.0);
        *pixel = [r, g, b, 1.0];
    }
    map
}

fn worst(es: bool, mips: &CubeMips, at: &[[f32; 4]]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (place, got) in at.iter().zip(look_up(es, mips, at)) {
        let [x, y, z, level] = place.map(f64::from);
        let expected = mips.sample(DVec3::new(x, y, z), level);
        let got = DVec3::new(got[0].into(), got[1].into(), got[2].into());
        let difference = (got - expected).abs().max_element();
        if difference.is_nan() || difference > worst.0 {
            worst = (difference, format!("{place:?}: GPU {got}, CPU {expected}"));
        }
    }
    worst
}

/// Looks up the middle of every texel of every face: turned, mirrored or exchanged faces would fail.
#[test]
fn every_texel_is_where_the_cubemap_has_it() {
    for es in [false, true] {
        let mips = CubeMips::new(speckled(8));
        let middles: Vec<[f32; 4]> = Face::ALL
            .iter()
            .flat_map(|face| (0..64).map(move |i| (face, i % 8, i / 8)))
            .map(|(face, x, y)| {
                let centre = |v: i32| f64::from(2 * v + 1) / 8.0 - 1.0;
                face.direction(centre(x), centre(y), Layout::OpenGl).as_vec3().extend(0.0).to_array()
            })
            .collect();
        let (difference, at) = worst(es, &mips, &middles);
        // The values are half floats, so they are exact; the place of a direction on the face is rounded to f32.
        assert!(difference <= 1e-5, "es {es}: {difference} at {at}");
    }
}

#[test]
fn lookups_between_texels_faces_and_levels_are_the_cpus() {
    for es in [false, true] {
        let mips = CubeMips::new(speckled(8));
        let mut at = Vec::new();
        for face in Face::ALL {
            for i in 0..=40 {
                for j in 0..=40 {
                    let (s, t) = (f64::from(i) / 20.0 - 1.0, f64::from(j) / 20.0 - 1.0);
                    // Not quite to the edges: a direction on two faces may be looked up in either, and in corners they
                    // differ.
                    let d = face.direction(0.9999 * s, 0.9999 * t, Layout::OpenGl).as_vec3();
                    at.extend([0.0, 1.0, 0.5, 2.0].map(|level| d.extend(level).to_array()));
                }
            }
        }
        let (difference, at) = worst(es, &mips, &at);
        // Levels are rounded to halves, which between 8 and 16 are 1/128 apart. llvmpipe filters half floats with 32
        // bits, edges and corners too, where the texel that is missing is the mean of three; hardware has filter
        // weights of 8 bits, which of neighbours this far apart would be 16/512 more.
        assert!(difference <= 0.005, "es {es}: {difference} at {at}");
    }
}

#[test]
fn cubemaps_that_are_too_large_begin_at_a_smaller_level_with_a_note() {
    let context = super::context(false);
    let environment = Arc::new(LoadedEnvironment::new("of colours", Cubemap::from_function(32, |d| d * d)));
    let uploaded = EnvironmentOnGpu::upload(context.gl(), &environment, 20).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((uploaded.map.size, uploaded.map.levels_left_out), (16, 1));
    let note = "the environment is drawn with 16 x 16 texels a face instead of 32 x 32: the driver has no more";
    assert_eq!(uploaded.notes, [note]);
    let uploaded = EnvironmentOnGpu::upload(context.gl(), &environment, 32).unwrap_or_else(|error| panic!("{error}"));
    assert!(uploaded.notes.is_empty());
    assert!(std::ptr::eq(uploaded.seen(), &uploaded.map), "one texture serves both");
}

/// A driver whose textures are too small for the body of an object draws its first surface alone, with a note; scenes without
/// environment do not need it at all.
#[test]
fn a_body_that_does_not_fit_adds_a_note() {
    let context = super::context(false);
    let text = "[[object]]\nmodel = \"builtin:cube\"\nmaterial = { medium = \"glass\", surfaces = \"two\" }\n";
    let scene = gonio_scene::toml_file::read(text).unwrap_or_else(|error| panic!("{error}"));
    let mut scene = gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}"));
    let info = DriverInfo::new(context.gl());
    let small = DriverInfo { max_size: 0, ..info.clone() };
    let upload = |scene: &Scene, info| {
        let scene = GpuScene::upload(context.gl(), scene, info, &mut GpuCache::default())
            .unwrap_or_else(|error| panic!("{error}"));
        (scene.objects[0].body.is_some(), scene.notes)
    };
    assert_eq!(upload(&scene, &small), (false, Vec::new()));
    scene.environment = Some(Arc::new(LoadedEnvironment::new("grey", Cubemap::new(4, [0.5; 4]))));
    let (has_body, notes) = upload(&scene, &small);
    assert!(!has_body);
    let note = "is refracted at its first surface only: the driver has no room for the interior of 12 triangles";
    assert!(notes.len() == 1 && notes[0].ends_with(note), "{notes:?}");
    assert_eq!(upload(&scene, &info), (true, Vec::new()));
}

/// Radiance that differs in every direction, with waves and a lamp of 20.
fn radiance(d: DVec3) -> DVec3 {
    let waves = DVec3::new((9.0 * d.x).sin(), (8.0 * d.y + 1.0).sin(), (7.0 * d.z).cos());
    let lamp = 20.0 * (30.0 * (d.dot(DVec3::new(0.6, 0.7, -0.3).normalize()) - 1.0)).exp();
    DVec3::new(1.5 + d.x, 1.5 + d.y * d.z, 1.5 - d.z) + 0.3 * waves + DVec3::splat(lamp)
}

/// The largest difference, and the mean one.
fn difference(a: &[Pixel], b: &[Pixel]) -> (f32, f32) {
    assert_eq!(a.len(), b.len());
    let all = a.iter().zip(b).flat_map(|(a, b)| (0..4).map(move |c| (a[c] - b[c]).abs()));
    let (most, sum) = all.fold((0.0_f32, 0.0_f32), |(most, sum), d| (most.max(d), sum + d));
    (most, sum / (4 * a.len()).max(1) as f32)
}

#[test]
fn gpu_and_cpu_convert_alike() {
    let (map, pano) = (Cubemap::from_function(40, radiance), Panorama::from_function(120, 60, radiance));
    let turn = DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-0.4) * DMat3::from_rotation_z(1.1);
    let mut worst = Vec::new();
    for es in [false, true] {
        let context = super::context(es);
        let converter = Converter::new(context.gl().clone()).unwrap_or_else(|e| panic!("{e}"));
        for &filter in Filter::ALL {
            for source_from_target in [DMat3::IDENTITY, turn] {
                let conversion = Conversion { filter: Some(filter), source_from_target };
                for (from, name) in
                    [(EnvironmentRef::Cubemap(&map), "cubemap"), (EnvironmentRef::Panorama(&pano), "panorama")]
                {
                    // Coarser and finer than the source; even, so that no texel looks at a pole, which has no longitude.
                    for size in [14, 52] {
                        let cpu = conversion.cubemap(from, size);
                        let gpu = converter.cubemap(&conversion, from, size).unwrap_or_else(|e| panic!("{e}"));
                        worst.push((difference(cpu.pixels(), gpu.environment.pixels()), filter, name, size));
                        let cpu = conversion.panorama(from, 2 * size, size);
                        let gpu =
                            converter.panorama(&conversion, from, 2 * size, size).unwrap_or_else(|e| panic!("{e}"));
                        let (cpu, gpu) = (cpu.image.pixels, gpu.environment.image.pixels);
                        worst.push((difference(&cpu, &gpu), filter, name, 2 * size));
                    }
                }
            }
        }
    }
    for ((most, mean), filter, name, size) in worst {
        // Places agree to some 1e-5 texels, and texels differ by up to 3. The nearest texel may differ where a place
        // is between two; so may the number of lookups of the area filter where it is rounded.
        let limit = if matches!(filter, Filter::Nearest | Filter::Area) { 3.0 } else { 1e-3 };
        assert!(most < limit && mean < 1e-3, "{filter} from a {name} to {size}: {most}, {mean} on average");
    }
}

#[test]
fn sources_that_are_too_large_are_reduced_with_a_note() {
    let context = super::context(false);
    let mut converter = Converter::new(context.gl().clone()).unwrap_or_else(|e| panic!("{e}"));
    converter.info.max_size = 64;
    let (map, pano) = (Cubemap::from_function(100, radiance), Panorama::from_function(256, 128, radiance));
    for from in [EnvironmentRef::Cubemap(&map), EnvironmentRef::Panorama(&pano)] {
        let made = converter.cubemap(&Conversion::default(), from, 16).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(made.notes.len(), 1);
        assert!(made.notes[0].contains("exceed the driver's limit of 64"), "{}", made.notes[0]);
        // The mean over texels of 0.1 rad of a function that is smooth there.
        let (_, mean) = difference(made.environment.pixels(), Conversion::default().cubemap(from, 16).pixels());
        assert!(mean < 0.02, "{mean}");
    }
    let refused = converter.cubemap(&Conversion::default(), EnvironmentRef::Panorama(&pano), 65).map(|_| ());
    assert!(refused.is_err_and(|e| e.message.contains("65 x 65 texels exceed the driver's limit of 64")));
}

const SIZE: [u32; 2] = [48, 32];

/// A display texture with these pixels.
fn canvas(gl: &gonio_gl::Gl, pixels: &[u8]) -> DisplayTexture {
    let canvas = DisplayTexture::new(gl, SIZE).unwrap_or_else(|e| panic!("{e}"));
    gl.bind_texture(glow::TEXTURE_2D, Some(canvas.texture()));
    gl.tex_sub_image_2d(glow::TEXTURE_2D, 0, [0, 0], SIZE.map(|side| side as i32), Texels::u8(glow::RGBA, pixels));
    canvas
}

/// Every size of difference, in each channel, of both signs.
fn pictures() -> [Vec<u8>; 2] {
    let count = (SIZE[0] * SIZE[1]) as usize;
    let byte = |i: usize, salt: usize| ((i * 37 + salt * 101 + i * i % 61 * salt) % 256) as u8;
    let of =
        |salt: usize| (0..count).flat_map(|i| [byte(i, salt), byte(i + 7, salt), byte(3 * i, salt), 255]).collect();
    [of(1), of(2)]
}

#[test]
fn gpu_and_cpu_colour_differences_alike() {
    for es in [false, true] {
        let context = super::context(es);
        let gl = context.gl();
        let mut renderer = Renderer::new(gl.clone()).unwrap_or_else(|e| panic!("{e}"));
        let [first, second] = pictures();
        let (a, b) = (canvas(gl, &first), canvas(gl, &second));
        let mut map = DisplayTexture::new(gl, [1, 1]).unwrap_or_else(|e| panic!("{e}"));
        for (full_scale, is_signed) in [(255.0, false), (24.0, false), (200.0, true)] {
            let scale = DifferenceScale { full_scale, signed: is_signed };
            renderer.paint_difference(&a, &b, scale, &mut map).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(map.size(), SIZE);
            let drawn = map.read8();
            for (i, pixel) in drawn.chunks_exact(4).enumerate() {
                let ways = [0, 1, 2].map(|c| f64::from(second[4 * i + c]) - f64::from(first[4 * i + c]));
                // The first of equal channels, as in the shader.
                let way = ways.into_iter().fold(0.0, |most: f64, way| if way.abs() > most.abs() { way } else { most });
                let expected = if is_signed { signed(way / full_scale) } else { heat(way.abs() / full_scale) };
                for (got, expected) in pixel.iter().zip(expected) {
                    // Rounding of f32 decides between two neighbours.
                    assert!(got.abs_diff(expected) <= 1, "pixel {i}: {pixel:?} and {expected:?}, es {es}");
                }
            }
        }
        let other = DisplayTexture::new(gl, [3, 3]).unwrap_or_else(|e| panic!("{e}"));
        let refused =
            renderer.paint_difference(&a, &other, DifferenceScale { full_scale: 1.0, signed: false }, &mut map);
        assert!(refused.is_err());
    }
}
