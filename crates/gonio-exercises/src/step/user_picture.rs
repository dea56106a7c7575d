//! The picture that a user's shaders draw, shaded on the CPU: as OpenGL draws it with several samples for each pixel and one run
//! of the fragment shader for each pixel of a triangle.

use super::coverage::{Plane, SurfacePoint, Triangle, bounds, ndc_from_bottom, quad_of};
use super::pair::{StepWork, SteppedObject};
use super::user_scene::{UserPair, UserPart};
use super::user_textures::UserTextures;
use glam::Vec3;
use gonio_glsl::{Stage, Type};
use gonio_interpreter::{CompiledStage, EndedEarly, RunOptions, StageRun, run};
use gonio_language::tr;
use gonio_scene::{Frame, Picture, Scene};
use std::ops::Range;

/// A picture of a user's shaders.
#[derive(Clone, Debug)]
pub struct ShadedPicture {
    /// The colours as they are shown, premultiplied by alpha.
    pub picture: Picture,
    /// Runs of the vertex shader.
    pub vertices: u64,
    /// Runs of the fragment shader.
    pub fragments: u64,
}

/// Fragments that are shaded together.
const CHUNK: usize = 16_384;
/// Samples of one band of rows, which bounds the memory.
const BAND_SAMPLES: usize = 1 << 21;
/// The work for one chunk, in units of the interpreter: an endless loop ends after about ten seconds.
const CHUNK_WORK: u64 = 100_000_000;

/// Pixels along each side of a picture that is only tried, how many of them are run, and the work for those of an object.
const TRIED_SIDE: u32 = 64;
const TRIED_PIXELS: usize = 64;
const TRIED_WORK: u64 = 5_000_000;

/// The places of the samples in a pixel, in sixteenths from its middle, y upwards: those of most drivers.
fn sample_places(count: u32) -> &'static [[i8; 2]] {
    const ONE: [[i8; 2]; 1] = [[0, 0]];
    const TWO: [[i8; 2]; 2] = [[4, 4], [-4, -4]];
    const FOUR: [[i8; 2]; 4] = [[-2, -6], [6, -2], [-6, 2], [2, 6]];
    const EIGHT: [[i8; 2]; 8] = [[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]];
    match count {
        0 | 1 => &ONE,
        2 | 3 => &TWO,
        4..=7 => &FOUR,
        _ => &EIGHT,
    }
}

/// A pixel of a triangle that is to be shaded.
struct Shaded {
    /// The covered samples, each with its depth from 0 to 1.
    samples: Vec<(usize, f32)>,
    /// Its number among the points that are run.
    point: usize,
}

/// Some rows of the picture.
struct Band<'a> {
    frame: &'a Frame,
    /// The first row and the end, from the bottom.
    rows: Range<u32>,
    places: &'static [[i8; 2]],
    colours: Vec<[f32; 4]>,
    depths: Vec<f32>,
}

/// What is drawn: consecutive triangles of one object.
struct Run {
    object: usize,
    triangles: Range<usize>,
    is_blended: bool,
}

impl UserPair {
    /// Draws a frame on the CPU. `behind` is the shown colour behind the objects, premultiplied by alpha, in a column and row
    /// from the top left.
    ///
    /// # Errors
    /// A shader does not end; one sentence with file and line.
    pub fn shaded(
        &self,
        scene: &Scene,
        frame: &Frame,
        behind: impl Fn(u32, u32) -> [f32; 4],
        progress: &dyn Fn(f64),
    ) -> Result<ShadedPicture, String> {
        let (parts, textures) = self.parts(scene, frame);
        let points: usize = parts.iter().map(|part| part.drawn.vertices.points()).sum();
        let most_work = StepWork::PATIENT.vertices.max(points as u64 * 1000);
        let kinds: Vec<(usize, bool, Vec<Vec3>)> =
            parts.iter().map(|p| (p.drawn.indices.len() / 3, p.is_transparent, p.centres.clone())).collect();
        let drawn = parts.into_iter().map(|part: UserPart| part.drawn).collect();
        let (objects, triangles) = self.pair.run_vertices(drawn, &textures, most_work);
        if let Some(ended) = objects.iter().find_map(|object| object.vertices.ended) {
            return Err(self.endless(Stage::Vertex, ended));
        }
        let runs = ordered(&kinds, frame);
        let mut picture = Picture::new(frame.width, frame.height, [0.0; 4]);
        let places = sample_places(frame.samples);
        let rows = (BAND_SAMPLES / (frame.width.max(1) as usize * places.len())).max(2) as u32 & !1;
        let mut fragments = 0;
        for first in (0..frame.height).step_by(rows as usize) {
            let mut band = Band::new(frame, first..(first + rows).min(frame.height), places, &behind);
            for run in &runs {
                let shading = Shading { pair: self, object: &objects[run.object], textures: &textures };
                fragments +=
                    band.draw(&shading, run, &triangles).map_err(|ended| self.endless(Stage::Fragment, ended))?;
            }
            band.resolve(&mut picture);
            progress(f64::from(band.rows.end) / f64::from(frame.height));
        }
        Ok(ShadedPicture { picture, vertices: points as u64, fragments })
    }

    /// Runs the shaders at some pixels of a small picture, which takes a second at most. It finds most loops that never end.
    ///
    /// # Errors
    /// A shader does not end; one sentence with file and line.
    pub fn try_at_some_pixels(&self, scene: &Scene) -> Result<(), String> {
        let frame = Frame { width: TRIED_SIDE, height: TRIED_SIDE, samples: 1, ..scene.frame(0.0) };
        let tried = self.in_scene(scene, &frame, StepWork::BRIEF);
        if let Some(ended) = tried.objects.iter().find_map(|object| object.vertices.ended) {
            return Err(self.endless(Stage::Vertex, ended));
        }
        let stage = &self.pair.fragment.compiled;
        let quads = stage.takes_derivatives;
        let pixels: Vec<[u32; 2]> = tried.coverage.covered().collect();
        let apart = pixels.len().div_ceil(TRIED_PIXELS).max(1);
        let at_object = |pixel: &[u32; 2], object| tried.coverage.at(*pixel).is_some_and(|at| at.object == object);
        for object in 0..tried.objects.len() {
            let of_object = pixels.iter().step_by(apart).copied().filter(|pixel| at_object(pixel, object));
            let inputs = tried.fragment_inputs(object, &of_object.collect::<Vec<_>>(), quads);
            let options =
                RunOptions { textures: &*tried.textures, quads, most_work: TRIED_WORK, ..RunOptions::default() };
            if let Some(ended) = run(stage, &inputs, &options).ended {
                return Err(self.endless(Stage::Fragment, ended));
            }
        }
        Ok(())
    }

    fn endless(&self, stage: Stage, ended: EndedEarly) -> String {
        let of = self.stage(stage);
        let span = ended.statement.and_then(|id| of.compiled.source.statements.get(id.0 as usize)).map(|s| s.span);
        let span = span.unwrap_or_default();
        let (file, line, _) = of.text.place(span.line, span.column);
        tr!("check-step-the-shader-does-not-end-here", file = file, line = line)
    }
}

/// The order of the triangles: opaque parts, then transparent triangles from back to front.
fn ordered(parts: &[(usize, bool, Vec<Vec3>)], frame: &Frame) -> Vec<Run> {
    let front = frame.camera.front.as_vec3();
    let (mut runs, mut sorted, mut first) = (Vec::new(), Vec::new(), 0);
    for (object, (count, is_transparent, centres)) in parts.iter().enumerate() {
        match is_transparent {
            false => runs.push(Run { object, triangles: first..first + count, is_blended: false }),
            true => sorted.extend(centres.iter().enumerate().map(|(at, c)| (c.dot(front), object, first + at))),
        }
        first += count;
    }
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, object, triangle) in sorted {
        match runs.last_mut() {
            Some(run) if run.is_blended && run.object == object && run.triangles.end == triangle => {
                run.triangles.end += 1;
            }
            _ => runs.push(Run { object, triangles: triangle..triangle + 1, is_blended: true }),
        }
    }
    runs
}

/// Whether pixels are shaded four at a time: for derivatives, and for the level of detail of textures.
fn needs_quads(stage: &CompiledStage) -> bool {
    stage.takes_derivatives || stage.inputs.iter().any(|input| matches!(input.ty, Type::Opaque(_)))
}

/// What the fragment shader of an object reads.
struct Shading<'a> {
    pair: &'a UserPair,
    object: &'a SteppedObject,
    textures: &'a UserTextures,
}

impl Shading<'_> {
    fn run(&self, points: &[SurfacePoint<'_>], quads: bool) -> Result<StageRun, EndedEarly> {
        let inputs = self.pair.pair.inputs_of_points(self.object, [0; 2], points);
        let options = RunOptions { textures: self.textures, quads, most_work: CHUNK_WORK, ..RunOptions::default() };
        let result = run(&self.pair.pair.fragment.compiled, &inputs, &options);
        result.ended.map_or(Ok(()), Err).map(|()| result)
    }
}

impl<'a> Band<'a> {
    fn new(
        frame: &'a Frame,
        rows: Range<u32>,
        places: &'static [[i8; 2]],
        behind: &impl Fn(u32, u32) -> [f32; 4],
    ) -> Self {
        let pixels = rows.clone().flat_map(|row| (0..frame.width).map(move |x| (x, frame.height - 1 - row)));
        let colours: Vec<[f32; 4]> =
            pixels.flat_map(|(x, y)| std::iter::repeat_n(behind(x, y), places.len())).collect();
        let depths = vec![1.0; colours.len()];
        Band { frame, rows, places, colours, depths }
    }

    /// The first sample of a pixel.
    fn sample(&self, [x, row]: [u32; 2]) -> usize {
        ((row - self.rows.start) as usize * self.frame.width as usize + x as usize) * self.places.len()
    }

    /// Draws triangles in order. Returns the number of runs of the fragment shader.
    fn draw(&mut self, shading: &Shading<'_>, drawn: &Run, triangles: &[Triangle]) -> Result<u64, EndedEarly> {
        let stage = &shading.pair.pair.fragment.compiled;
        let writes_depth = stage.output("gl_FragDepth").is_some();
        let quads = needs_quads(stage);
        let size = [self.frame.width, self.frame.height];
        let mut count = 0;
        let (mut points, mut waiting): (Vec<SurfacePoint<'_>>, Vec<Shaded>) = (Vec::new(), Vec::new());
        for triangle in triangles.get(drawn.triangles.clone()).unwrap_or_default() {
            let Some(plane) = Plane::new(&triangle.clip) else { continue };
            let [columns, from_top] = bounds(&triangle.clip, size);
            let rows = (size[1] - from_top.end).max(self.rows.start)..(size[1] - from_top.start).min(self.rows.end);
            let mut last_quad = None;
            let quads_of = |range: &Range<u32>| range.start / 2..range.end.div_ceil(2);
            let corners = quads_of(&rows).flat_map(|row| quads_of(&columns).map(move |column| [2 * column, 2 * row]));
            let inside = |[x, row]: &[u32; 2]| columns.contains(x) && rows.contains(row);
            for pixel in corners.flat_map(quad_of).filter(inside) {
                let quad = quad_of(pixel);
                if points.len() >= CHUNK && last_quad != Some(quad[0]) {
                    count += waiting.len() as u64;
                    self.shade(shading, drawn, &points, &waiting)?;
                    points.clear();
                    waiting.clear();
                }
                let samples = self.covered(&plane, pixel, writes_depth);
                if samples.is_empty() {
                    continue;
                }
                let point = |pixel: [u32; 2]| SurfacePoint {
                    triangle,
                    is_front: plane.is_front,
                    pixel,
                    place: plane.at(ndc_from_bottom(pixel, size)),
                };
                let point = if !quads {
                    points.push(point(pixel));
                    points.len() - 1
                } else {
                    if last_quad != Some(quad[0]) {
                        points.extend(quad.map(point));
                        last_quad = Some(quad[0]);
                    }
                    points.len() - 4 + quad.iter().position(|other| *other == pixel).unwrap_or(0)
                };
                waiting.push(Shaded { samples, point });
            }
        }
        count += waiting.len() as u64;
        self.shade(shading, drawn, &points, &waiting)?;
        Ok(count)
    }

    /// The samples of a pixel that a triangle covers, and that pass the depth test so far.
    fn covered(&self, plane: &Plane, pixel: [u32; 2], writes_depth: bool) -> Vec<(usize, f32)> {
        let size = [self.frame.width, self.frame.height];
        let [x, y] = ndc_from_bottom(pixel, size);
        let first = self.sample(pixel);
        let sample = |(at, offset): (usize, &[i8; 2])| {
            let [right, up] = [0, 1].map(|axis| f64::from(offset[axis]) / 8.0 / f64::from(size[axis]));
            let depth = (plane.covered([x + right, y + up])?.depth * 0.5 + 0.5) as f32;
            (writes_depth || depth <= self.depths[first + at]).then_some((first + at, depth))
        };
        self.places.iter().enumerate().filter_map(sample).collect()
    }

    /// Runs the fragment shader and writes its colours in order.
    fn shade(
        &mut self,
        shading: &Shading<'_>,
        drawn: &Run,
        points: &[SurfacePoint<'_>],
        waiting: &[Shaded],
    ) -> Result<(), EndedEarly> {
        if waiting.is_empty() {
            return Ok(());
        }
        let stage = &shading.pair.pair.fragment.compiled;
        let result = shading.run(points, needs_quads(stage))?;
        let outputs = || stage.outputs.iter().enumerate().filter(|(_, output)| output.name != "gl_FragDepth");
        let colour =
            outputs().min_by_key(|(_, output)| output.location.unwrap_or(0)).map(|(at, _)| &result.outputs[at]);
        let depth = result.output(stage, "gl_FragDepth");
        for Shaded { samples, point, .. } in waiting {
            if result.discarded.get(*point).copied().unwrap_or(false) {
                continue;
            }
            let component = |at: usize| {
                let missing = if at == 3 { 1.0 } else { 0.0 };
                colour.and_then(|values| values.component(at, *point)).map_or(missing, f32::from_bits)
            };
            let rgba: [f32; 4] = std::array::from_fn(component);
            for (sample, own_depth) in samples {
                let depth = depth.map_or(*own_depth, |depth| depth.float(0, *point).clamp(0.0, 1.0));
                if depth <= self.depths[*sample] {
                    self.depths[*sample] = depth;
                    self.write(*sample, rgba, drawn.is_blended);
                }
            }
        }
        Ok(())
    }

    fn write(&mut self, sample: usize, [r, g, b, a]: [f32; 4], is_blended: bool) {
        let before = self.colours[sample];
        let over = |new: f32, old: f32| new * a + old * (1.0 - a);
        self.colours[sample] = match (is_blended, self.frame.background.transparent) {
            (true, true) => [over(r, before[0]), over(g, before[1]), over(b, before[2]), a + before[3] * (1.0 - a)],
            (true, false) => [over(r, before[0]), over(g, before[1]), over(b, before[2]), before[3]],
            (false, true) => [r, g, b, a],
            (false, false) => [r, g, b, before[3]],
        };
    }

    /// Writes the means of the samples.
    fn resolve(&self, picture: &mut Picture) {
        let share = 1.0 / self.places.len() as f32;
        for row in self.rows.clone() {
            for x in 0..self.frame.width {
                let first = self.sample([x, row]);
                let mut mean = [0.0; 4];
                for colour in &self.colours[first..first + self.places.len()] {
                    mean.iter_mut().zip(colour).for_each(|(sum, value)| *sum += value * share);
                }
                let y = self.frame.height - 1 - row;
                picture.pixels[y as usize * self.frame.width as usize + x as usize] = mean;
            }
        }
    }
}
