//! The probe: the selected pixel, and all its values.
//!
//! The numbers come from the CPU reference, in f64 through the pixel's centre, and are compared with the value that OpenGL draws.
//! The reference's bounding volume hierarchy is built once per geometry, in a thread if possible; changes of lights and
//! colours do not rebuild it.

use crate::truth::PixelLight;
use glam::DVec3;
use gonio_language::tr;
use gonio_reference::{Probe, ReferenceGeometry, ReferenceScene};
use gonio_scene::{DisplayMap, Frame, Scene};
use serde::Serialize;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// State of the probe.
pub struct Probing {
    /// Whether the pixel under the pointer is probed.
    pub follows: bool,
    /// The pinned place, as shares of the picture's width (from the left) and height (from the top).
    pub pinned: Option<[f64; 2]>,
    /// The place under the pointer, in the same units.
    pub hovered: Option<[f64; 2]>,
    /// Whether the lobe of the light that is reflected at a pinned pixel is shown.
    pub shows_lobe: bool,
    /// The pane that is probed.
    pub pane: usize,
    /// Whether the part at the pinned place is to be selected, once it is known.
    pub selects: bool,
    geometry: Option<Arc<ReferenceGeometry>>,
    building: Option<Building>,
    reading: Option<Arc<Reading>>,
}

impl Default for Probing {
    fn default() -> Self {
        Probing {
            follows: false,
            pinned: None,
            hovered: None,
            shows_lobe: true,
            pane: 0,
            selects: false,
            geometry: None,
            building: None,
            reading: None,
        }
    }
}

/// A hierarchy that is being built, and its scene.
struct Building {
    scene: Arc<Scene>,
    result: Receiver<ReferenceGeometry>,
}

/// All values of a pixel. Colours are linear, premultiplied RGBA.
#[derive(Clone, Serialize)]
pub struct Reading {
    /// Column, from the left.
    pub x: u32,
    /// Row, from the top.
    pub y: u32,
    /// Width of the picture, pixels.
    pub width: u32,
    /// Height of the picture, pixels.
    pub height: u32,
    /// Every term, if a surface is visible.
    pub probe: Option<Probe>,
    /// The pixel by the CPU reference.
    pub reference: [f64; 4],
    /// The displayed 8-bit value, sRGB or direct.
    pub displayed: [u8; 3],
    /// The value that OpenGL draws.
    pub gpu: Option<GpuValue>,
    /// The frame that it was read from.
    #[serde(skip)]
    pub frame: Frame,
    /// The scene it was read from.
    #[serde(skip)]
    pub loaded: Arc<Scene>,
}

/// The value that OpenGL draws at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GpuValue {
    /// With one sample at the pixel centre.
    pub value: [f32; 4],
    /// The displayed 8-bit value.
    pub displayed: [u8; 3],
    /// The largest absolute difference of the four from the reference.
    pub difference: f64,
}

impl Probing {
    /// The place that is probed: the pinned one, else the one under the pointer if it is followed.
    pub fn place(&self) -> Option<[f64; 2]> {
        self.pinned.or(self.hovered.filter(|_| self.follows))
    }

    /// Column and row of the pinned place, if it is in this pane with this frame.
    pub fn pinned_pixel(&self, pane: usize, frame: &Frame) -> Option<[u32; 2]> {
        let place = self.pinned.filter(|_| pane == self.pane)?;
        Some(pixel_at(place, [frame.width, frame.height]))
    }

    /// The values at that place, once known.
    pub fn reading(&self) -> Option<&Arc<Reading>> {
        self.reading.as_ref().filter(|_| self.place().is_some())
    }

    /// Whether the reference is being built.
    pub fn is_building(&self) -> bool {
        self.building.is_some()
    }

    /// Forgets everything about the previous scene.
    pub fn forget(&mut self) {
        *self = Probing { follows: self.follows, shows_lobe: self.shows_lobe, ..Probing::default() };
    }

    /// Reads the place again if the pixel, the scene or its time changed. `gpu` returns OpenGL's value
    /// at a column and row of `frame`.
    pub fn update(
        &mut self,
        ctx: &egui::Context,
        loaded: &Arc<Scene>,
        frame: &Frame,
        gpu: impl FnOnce(u32, u32) -> Option<[f32; 4]>,
    ) {
        let Some(place) = self.place() else { return };
        let [x, y] = pixel_at(place, [frame.width, frame.height]);
        let is_current = self.reading.as_ref().is_some_and(|reading| {
            // The number of samples does not change the pixel's light.
            let same_moment = Frame { samples: frame.samples, ..reading.frame.clone() } == *frame;
            (reading.x, reading.y) == (x, y) && same_moment && Arc::ptr_eq(&reading.loaded, loaded)
        });
        if is_current {
            return;
        }
        self.geometry = self.geometry.take().filter(|geometry| geometry.fits(loaded));
        if self.geometry.is_none() {
            self.build(ctx, loaded);
        }
        let Some(geometry) = &self.geometry else { return };
        let Some(reference) = ReferenceScene::with_geometry(loaded, geometry.clone()) else { return };
        self.reading = Some(Arc::new(Reading::at_pixel(&reference, loaded, frame, [x, y], gpu)));
        // The panel has already been laid out in this frame.
        ctx.request_repaint();
    }

    /// The part at the pinned place of `frame`, once, after a click and when it is known: its object's index and its own; `Some(None)`
    /// where there is no surface.
    pub fn take_selected(&mut self, frame: &Frame) -> Option<Option<[usize; 2]>> {
        let [x, y] = pixel_at(self.pinned.filter(|_| self.selects)?, [frame.width, frame.height]);
        let reading = self.reading.as_ref().filter(|reading| (reading.x, reading.y) == (x, y))?;
        self.selects = false;
        Some(reading.part())
    }

    /// Takes the finished hierarchy, or starts to build one.
    fn build(&mut self, ctx: &egui::Context, loaded: &Arc<Scene>) {
        if let Some(building) = &self.building {
            match building.result.try_recv() {
                Ok(geometry) => {
                    self.building = None;
                    if geometry.fits(loaded) {
                        self.geometry = Some(Arc::new(geometry));
                        return;
                    }
                }
                // It is for an outdated scene, and has to end before the next one starts.
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => self.building = None,
            }
        }
        let (sender, result) = channel();
        self.building = Some(Building { scene: loaded.clone(), result });
        let (ctx, scene) = (ctx.clone(), loaded.clone());
        let build = move || {
            // The window may be closed by now.
            let _ = sender.send(ReferenceGeometry::new(&scene));
            ctx.request_repaint();
        };
        #[cfg(not(target_arch = "wasm32"))]
        std::thread::spawn(build);
        // On the web, the frame that announces it is shown first.
        #[cfg(target_arch = "wasm32")]
        build();
    }

    /// Number of triangles of the hierarchy that is being built.
    pub fn building_triangles(&self) -> usize {
        let scene = self.building.as_ref().map(|building| &building.scene);
        scene.map_or(0, |scene| scene.meshes.iter().map(|mesh| mesh.triangle_count()).sum())
    }
}

impl Reading {
    /// The part that is seen: its object's index and its own.
    pub fn part(&self) -> Option<[usize; 2]> {
        let probe = self.probe.as_ref()?;
        Some([probe.object, self.loaded.objects.get(probe.object)?.part_of(probe.triangle)?])
    }

    /// A light's name, or its kind and number.
    pub fn light_name(&self, index: usize) -> String {
        match self.loaded.settings.lights.get(index) {
            Some(spec) if !spec.name.is_empty() => spec.name.clone(),
            Some(spec) => format!("{} {index}", gonio_language::name(spec.kind.name())),
            None => tr!("window-light", index = index),
        }
    }

    /// The parts of the pixel's light: a name, what it means, and linear RGB.
    pub fn ways(&self, light: &PixelLight) -> Vec<(String, &'static str, DVec3)> {
        const DIRECT: &str = "window-light-of-this-source-that-only";
        let way = |&(part, index, rgb): &(u32, usize, DVec3)| {
            let (name, about) = match part {
                0 => ("emitted", tr!("window-light-that-no-surface-scattered-of")),
                1 => return (self.light_name(index), tr!(DIRECT), rgb),
                2 => {
                    let object = self.loaded.objects.get(index).map(|object| object.name.as_str());
                    return (tr!("window-object", object = object.unwrap_or_default()), tr!(DIRECT), rgb);
                }
                3 => ("environment", tr!(DIRECT)),
                4 => ("ambient", tr!("window-k-a-times-the-ambient-light")),
                5 => (tr!("window-first-bounce"), tr!("window-light-that-two-surfaces-scattered")),
                6 => (tr!("window-the-rest"), tr!("window-light-that-more-than-two-surfaces")),
                7 => ("total", tr!("window-the-sum-which-is-the-traced")),
                _ => (tr!("window-standard-error"), tr!("window-of-the-total-how-far-it")),
            };
            (name.to_owned(), about, rgb)
        };
        light.parts.iter().map(way).collect()
    }

    /// The displayed 8-bit value of the sum of the parts.
    pub fn displayed_total(&self, light: &PixelLight) -> Option<([u8; 3], DVec3)> {
        let &(.., total) = light.parts.iter().find(|(part, ..)| *part == 7)?;
        let [red, green, blue] = total.as_vec3().to_array();
        Some((displayed(&self.frame, [red, green, blue, 1.0]), total))
    }

    /// Reads a pixel.
    fn at_pixel(
        reference: &ReferenceScene,
        loaded: &Arc<Scene>,
        frame: &Frame,
        [x, y]: [u32; 2],
        gpu: impl FnOnce(u32, u32) -> Option<[f32; 4]>,
    ) -> Self {
        let frame = Frame { samples: 1, ..frame.clone() };
        let probe = reference.probe(&frame, x, y);
        let value = probe.as_ref().map_or_else(|| reference.behind(&frame, x, y), |probe| probe.total.to_array());
        let gpu = gpu(x, y).map(|pixel| GpuValue {
            value: pixel,
            displayed: displayed(&frame, pixel),
            difference: (0..4).map(|c| (f64::from(pixel[c]) - value[c]).abs()).fold(0.0, f64::max),
        });
        Reading {
            x,
            y,
            width: frame.width,
            height: frame.height,
            probe,
            reference: value,
            displayed: displayed(&frame, value.map(|v| v as f32)),
            gpu,
            frame,
            loaded: loaded.clone(),
        }
    }
}

/// Column and row of a place.
fn pixel_at(place: [f64; 2], size: [u32; 2]) -> [u32; 2] {
    // Shares are rounded f32, which must not select the pixel before.
    let along = |share: f64, count: u32| ((share * f64::from(count) + 1e-3).max(0.0) as u32).min(count.max(1) - 1);
    [along(place[0], size[0]), along(place[1], size[1])]
}

/// The displayed value of a pixel.
fn displayed(frame: &Frame, pixel: [f32; 4]) -> [u8; 3] {
    let [red, green, blue, _] = DisplayMap::for_view(None, frame).apply(pixel).map(|v| (v * 255.0 + 0.5) as u8);
    [red, green, blue]
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::files::Disk;
    use gonio_scene::load;
    use std::path::Path;

    fn still_life() -> Arc<Scene> {
        let described = load::describe(&["builtin:still-life"], &Disk).unwrap_or_else(|error| panic!("{error}"));
        Arc::new(load::load(described, Path::new(""), &Disk).unwrap_or_else(|error| panic!("{error}")))
    }

    /// Frames until the reading is there; the thread has as many as it needs.
    fn read(probing: &mut Probing, loaded: &Arc<Scene>, frame: &Frame) -> Arc<Reading> {
        let ctx = egui::Context::default();
        loop {
            probing.update(&ctx, loaded, frame, |_, _| Some([0.25; 4]));
            match probing.reading() {
                Some(reading) if Arc::ptr_eq(&reading.loaded, loaded) => return reading.clone(),
                _ => std::thread::yield_now(),
            }
        }
    }

    #[test]
    fn its_numbers_are_those_of_the_reference() {
        let loaded = still_life();
        let frame = Frame { width: 200, height: 120, ..loaded.frame(0.0) };
        let mut probing = Probing { pinned: Some([0.5, 0.55]), ..Probing::default() };
        let reading = read(&mut probing, &loaded, &frame);
        assert_eq!((reading.x, reading.y), (100, 66));
        let expected = ReferenceScene::new(&loaded).probe(&Frame { samples: 1, ..frame }, 100, 66);
        assert!(expected.is_some() && reading.probe == expected);
        assert_eq!(reading.reference, expected.map_or([0.0; 4], |probe| probe.total.to_array()));
        let difference = reading.gpu.map_or(0.0, |gpu| gpu.difference);
        assert!(
            (difference - reading.reference.map(|v| (v - 0.25).abs()).into_iter().fold(0.0, f64::max)).abs() < 1e-12
        );
    }

    #[test]
    fn a_pinned_pixel_follows_a_light_with_the_same_tree() {
        let loaded = still_life();
        let frame = Frame { width: 200, height: 120, ..loaded.frame(0.0) };
        let mut probing = Probing { pinned: Some([0.5, 0.55]), ..Probing::default() };
        let before = read(&mut probing, &loaded, &frame);
        let tree = probing.geometry.clone();
        let mut darker = (*loaded).clone();
        darker.settings.lights.clear();
        let darker = Arc::new(darker);
        let frame = Frame { width: 200, height: 120, ..darker.frame(0.0) };
        let after = read(&mut probing, &darker, &frame);
        assert!(after.reference[1] < before.reference[1], "{:?} {:?}", after.reference, before.reference);
        let same = tree.zip(probing.geometry.clone()).is_some_and(|(a, b)| Arc::ptr_eq(&a, &b));
        assert!(same && !probing.is_building(), "the hierarchy was rebuilt");
    }

    #[test]
    fn places_become_pixels_within_the_picture() {
        assert_eq!(pixel_at([0.0, 0.999], [10, 5]), [0, 4]);
        assert_eq!(pixel_at([1.0, -0.2], [10, 5]), [9, 0]);
        assert_eq!(pixel_at([0.5, 0.5], [0, 0]), [0, 0]);
    }
}
