//! Comparisons of the two renderers.

use gonio_gl::HeadlessContext;
use gonio_gl::headless::HeadlessOptions;
use gonio_reference::{Probe, ReferenceScene};
use gonio_render::Renderer;
use gonio_scene::files::Disk;
use gonio_scene::{DisplayMap, Frame, Scene, ViewSpec};
use std::path::Path;

pub const WIDTH: u32 = 160;
pub const HEIGHT: u32 = 120;

/// Texture filtering is `linear`, because the choice of mipmap levels differs between drivers within the specification.
pub fn scene_from(camera: &str, equation: &str, lights: &str, objects: &str) -> Scene {
    let text = format!(
        "[picture]\nwidth = {WIDTH}\nheight = {HEIGHT}\nsamples = 1\ntexture_filter = \"linear\"\n\
         [camera]\n{camera}\nfov_y = 40\n\
         [equation]\n{equation}\n{objects}\n{lights}"
    );
    let scene = gonio_scene::toml_file::read(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    gonio_scene::load::load(scene, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// One comparison of the two renderers.
pub struct Comparison {
    /// Pixels whose neighbourhood is one surface.
    pub interior: usize,
    /// The largest difference among them, absolute or relative, and its place.
    pub worst: (f64, String),
    /// Share of all pixels within 1/255.
    pub close: f64,
}

pub struct Bench {
    pub renderer: Renderer,
}

impl Bench {
    /// A bench with OpenGL.
    pub fn new() -> Self {
        Self::with(false)
    }

    /// A bench with OpenGL, or with OpenGL ES as in a browser.
    pub fn with(es: bool) -> Self {
        let options = HeadlessOptions { es, ..Default::default() };
        let context = HeadlessContext::with_options(&options).unwrap_or_else(|error| panic!("{error}"));
        Bench { renderer: Renderer::new(context.gl().clone()).unwrap_or_else(|error| panic!("{error}")) }
    }

    pub fn compare(&mut self, scene: &Scene, view: Option<ViewSpec>) -> Comparison {
        let frame = scene.frame(0.0);
        let uploaded = self.renderer.upload(scene).unwrap();
        let drawn = self.renderer.render(&uploaded, &frame, view).unwrap();
        let (gpu, gpu8) = (drawn.linear().unwrap(), drawn.encoded8().unwrap());
        let reference = ReferenceScene::new(scene);
        let cpu = reference.render(&frame, view, &|_| ()).picture;
        let cpu8 = cpu.encode8(&DisplayMap::for_view(view, &frame));
        let probes = reference.probe_all(&frame, (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))));
        let mut comparison = Comparison { interior: 0, worst: (0.0, String::new()), close: 0.0 };
        let mut close = 0usize;
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let (a, b) = (gpu.at(x, y), cpu.at(x, y));
                let i = (y * WIDTH + x) as usize;
                if (0..4).all(|c| gpu8.rgba[4 * i + c].abs_diff(cpu8.rgba[4 * i + c]) <= 1) {
                    close += 1;
                }
                if !on_one_surface(&probes, &frame, view, x, y) {
                    continue;
                }
                comparison.interior += 1;
                for c in 0..4 {
                    let (got, expected) = (f64::from(a[c]), f64::from(b[c]));
                    let difference = (got - expected).abs() / expected.abs().max(1.0);
                    if difference.is_nan() || difference > comparison.worst.0 {
                        comparison.worst = (difference, format!("({x}, {y})[{c}]: GPU {got}, reference {expected}"));
                    }
                }
            }
        }
        comparison.close = close as f64 / f64::from(WIDTH * HEIGHT);
        comparison
    }

    pub fn check(&mut self, name: &str, scene: &Scene, view: Option<ViewSpec>) {
        let c = self.compare(scene, view);
        assert!(c.interior >= 200, "{name}: only {} pixels lie on one surface, which tests little", c.interior);
        assert!(c.worst.0 <= 1e-3, "{name}: {} on one surface: {}", c.worst.0, c.worst.1);
        assert!(c.close >= 0.995, "{name}: only {:.3} % of the pixels are within 1/255", 100.0 * c.close);
    }
}

/// Whether a pixel and its neighbours see one continuous surface: one part of one object, with normals
/// that agree, and (where shading is per triangle) one triangle. Or only the environment.
fn on_one_surface(probes: &[Option<Probe>], frame: &Frame, view: Option<ViewSpec>, x: u32, y: u32) -> bool {
    if x == 0 || y == 0 || x + 1 >= frame.width || y + 1 >= frame.height {
        return false;
    }
    let at = |x: u32, y: u32| probes[(y * frame.width + x) as usize].as_ref();
    let Some(center) = at(x, y) else {
        let nothing = (y - 1..=y + 1).all(|y| (x - 1..=x + 1).all(|x| at(x, y).is_none()));
        return nothing && view.is_none() && frame.surroundings.is_some_and(|s| s.visible);
    };
    let per_triangle = center.shading.name().starts_with("flat")
        || view.is_some_and(|v| v.quantity == gonio_light::Quantity::GeometricNormal);
    (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y))).all(|(x, y)| {
        at(x, y).is_some_and(|p| {
            let offset = p.position - center.position;
            p.object == center.object
                && p.part_name == center.part_name
                && p.material == center.material
                && p.front_facing == center.front_facing
                && (!per_triangle || p.triangle == center.triangle)
                // At a fold or an occlusion a neighbour is outside of the tangent plane.
                && offset.dot(center.geometry.geometric_normal).abs() <= 0.35 * offset.length()
                && p.terms.point.normal.dot(center.terms.point.normal) > 0.9
        })
    })
}
