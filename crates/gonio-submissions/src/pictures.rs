//! Pictures of programs, run by the interpreter, and the right pictures, computed without any shader.

use crate::plan::{Answer, GeneratedTask};
use crate::scenes::{
    BenchScene, LAB, LAB_INDEX, LAB_MATERIAL, LAB_SHININESS, Light, Meaning, objects, radiance, skies,
};
use crate::writer::Input;
use glam::{Mat3, Vec3, Vec4};
use gonio_glsl::{Severity, Stage};
use gonio_interpreter::{
    CompiledStage, Fragment, PointValues, RunOptions, StageInputs, TextureLookup, TextureSource, interpolate, run,
};

/// Side length of a picture in pixels.
const SIDE: usize = 32;

/// The colours of a picture; `None` where nothing is drawn.
pub(crate) type Picture = Vec<Option<Vec3>>;

/// A visible point: pixel, triangle, and the weights of its corners in space.
#[derive(Clone, Copy, Debug)]
struct Hit {
    pixel: usize,
    triangle: [u32; 3],
    weights: Vec3,
}

/// A program that can be run.
pub(crate) struct Program {
    stages: [CompiledStage; 2],
    inputs: Vec<Input>,
}

fn compiled(text: &str, stage: Stage) -> Result<(CompiledStage, gonio_glsl::Checked), String> {
    let mut parsed = gonio_glsl::parse(text);
    let checked = gonio_glsl::check(&mut parsed, stage);
    let problems = parsed.problems.iter().chain(&checked.problems);
    if let Some(problem) = problems.into_iter().find(|problem| problem.severity == Severity::Error) {
        return Err(format!("{stage}, line {}: {}", problem.span.line, problem.message));
    }
    let code = gonio_interpreter::compile(&parsed, &checked).map_err(|error| format!("{stage}: {error}"))?;
    Ok((code, checked))
}

impl Program {
    pub fn new(vertex: &str, fragment: &str, inputs: Vec<Input>) -> Result<Self, String> {
        let (first, first_checked) = compiled(vertex, Stage::Vertex)?;
        let (second, second_checked) = compiled(fragment, Stage::Fragment)?;
        let linked = gonio_glsl::check_pair(&first_checked, &second_checked);
        if let Some(problem) = linked.iter().find(|problem| problem.severity == Severity::Error) {
            return Err(format!("the stages do not fit: {}", problem.message));
        }
        let program = Program { stages: [first, second], inputs };
        program.all_inputs_are_known()?;
        Ok(program)
    }

    /// Every uniform and attribute that is used has a value.
    fn all_inputs_are_known(&self) -> Result<(), String> {
        let [vertex, fragment] = &self.stages;
        let uniforms = |stage: &CompiledStage| {
            let all = stage.inputs.iter().filter(|input| input.rate == gonio_interpreter::InputRate::Uniform);
            all.map(|input| input.name.clone()).collect::<Vec<_>>()
        };
        for name in uniforms(vertex).into_iter().chain(uniforms(fragment)) {
            if !name.starts_with("gl_") && !self.inputs.iter().any(|input| input.name == name) {
                return Err(format!("no value for {name}"));
            }
        }
        Ok(())
    }

    fn set(&self, stage: &CompiledStage, inputs: &mut StageInputs, scene: &BenchScene) {
        for input in &self.inputs {
            let Some(found) = stage.inputs.iter().position(|known| known.name == input.name) else { continue };
            let each = |all: &[Vec3]| {
                let planes: Vec<Vec<f32>> = (0..3).map(|c| all.iter().map(|v| v[c]).collect()).collect();
                PointValues::each(&planes.iter().map(Vec::as_slice).collect::<Vec<_>>())
            };
            let values = match input.meaning {
                Meaning::Position => each(&scene.mesh.positions),
                Meaning::Normal => each(&scene.mesh.normals),
                Meaning::Cubemap => PointValues::ints(&[0]),
                meaning => PointValues::floats(&scene.value(meaning)),
            };
            inputs.set(found, values);
        }
    }

    /// Draws the program in a scene; `right` are the points of the right program, which are drawn if the places agree.
    fn draw(&self, scene: &BenchScene, right: &[Hit], right_clip: &[Vec4]) -> Result<Picture, String> {
        let [vertex, fragment] = &self.stages;
        let mut inputs = StageInputs::new(vertex, scene.mesh.positions.len());
        self.set(vertex, &mut inputs, scene);
        let options = RunOptions { textures: &Surroundings, ..RunOptions::default() };
        let vertices = run(vertex, &inputs, &options);
        let position = vertices.output(vertex, "gl_Position").ok_or("gl_Position is not written")?;
        let clip: Vec<Vec4> = (0..scene.mesh.positions.len())
            .map(|at| Vec4::from_array(std::array::from_fn(|c| position.float(c, at))))
            .collect();
        // Only x, y and w: a skybox may choose its depth.
        let is_near = |(a, b): (&Vec4, &Vec4)| {
            [a.x - b.x, a.y - b.y, a.w - b.w].iter().all(|difference| difference.abs() <= 1e-4 * b.w.abs().max(1.0))
        };
        let own;
        let hits = if clip.iter().zip(right_clip).all(is_near) {
            right
        } else {
            own = visible(&clip, &scene.mesh.triangles);
            &own
        };
        let fragments: Vec<Fragment> = hits
            .iter()
            .map(|hit| {
                let weights = hit.weights.to_array();
                Fragment { corners: hit.triangle, screen: weights, weights }
            })
            .collect();
        let mut inputs = interpolate(vertex, &vertices.outputs, fragment, &fragments);
        self.set(fragment, &mut inputs, scene);
        let result = run(fragment, &inputs, &options);
        if result.ended.is_some() {
            return Err("it does not end".to_owned());
        }
        let output = result.outputs.first().ok_or("no colour is written")?;
        let mut picture = vec![None; SIDE * SIDE];
        for (at, hit) in hits.iter().enumerate() {
            if let Some(pixel) = picture.get_mut(hit.pixel) {
                *pixel = Some(Vec3::from_array(std::array::from_fn(|c| output.float(c, at))));
            }
        }
        Ok(picture)
    }
}

/// The environment, by a formula instead of texels.
struct Surroundings;

impl TextureSource for Surroundings {
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4] {
        let [x, y, z, _] = lookup.coordinates;
        let colour = radiance(Vec3::new(x, y, z));
        [colour.x, colour.y, colour.z, 1.0]
    }

    fn size(&self, _sampler: u32, _level: i32) -> [u32; 3] {
        [64, 64, 1]
    }
}

/// The visible points of triangles: rasterisation in homogeneous coordinates, which needs no clipping (M. Olano and
/// T. Greer, *Triangle Scan Conversion using 2D Homogeneous Coordinates*, 1997).
fn visible(clip: &[Vec4], triangles: &[[u32; 3]]) -> Vec<Hit> {
    let mut nearest: Vec<Option<(f32, Hit)>> = vec![None; SIDE * SIDE];
    for triangle in triangles {
        let corners = triangle.map(|index| clip.get(index as usize).copied().unwrap_or(Vec4::ZERO));
        let matrix = Mat3::from_cols_array_2d(&corners.map(|c| [c.x, c.y, c.w]));
        if matrix.determinant().abs() < 1e-9 {
            continue;
        }
        let inverse = matrix.inverse();
        for pixel in 0..SIDE * SIDE {
            let along = |at: usize| (at as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
            let shares = inverse * Vec3::new(along(pixel % SIDE), along(pixel / SIDE), 1.0);
            let sum = shares.x + shares.y + shares.z;
            if sum <= 0.0 || shares.min_element() < 0.0 {
                continue;
            }
            let weights = shares / sum;
            // w is 1 / sum; points nearer than the near plane are kept, because a skybox may be drawn there.
            let depth = 1.0 / sum;
            let hit = Hit { pixel, triangle: *triangle, weights };
            if let Some(found) = nearest.get_mut(pixel)
                && found.is_none_or(|(known, _)| depth < known)
            {
                *found = Some((depth, hit));
            }
        }
    }
    nearest.into_iter().flatten().map(|(_, hit)| hit).collect()
}

/// The scenes of an answer with the right pictures.
pub(crate) struct Bench {
    scenes: Vec<BenchScene>,
    clip: Vec<Vec<Vec4>>,
    hits: Vec<Vec<Hit>>,
    right: Vec<Picture>,
}

impl Bench {
    pub fn new(answer: &Answer) -> Self {
        let mut scenes = if answer.task == GeneratedTask::Skybox { skies() } else { objects() };
        for scene in &mut scenes {
            let [first, _] = &mut scene.lights;
            if answer.writes.position {
                first.position = answer.lab_light_position();
            }
            if answer.writes.strengths {
                first.strengths = LAB.strengths;
            }
            if answer.writes.attenuation {
                first.attenuation = LAB.attenuation;
            }
            if answer.writes.exponent {
                scene.shininess = LAB_SHININESS;
            }
            if answer.writes.material {
                scene.material = LAB_MATERIAL;
            }
            if answer.writes.index {
                scene.index = LAB_INDEX;
            }
        }
        let sky = answer.task == GeneratedTask::Skybox;
        let clip: Vec<Vec<Vec4>> = scenes
            .iter()
            .map(|scene| {
                let view = if sky { glam::Mat4::from_mat3(Mat3::from_mat4(scene.view)) } else { scene.view };
                let whole = scene.projection * view * scene.model;
                scene.mesh.positions.iter().map(|p| whole * p.extend(1.0)).collect()
            })
            .collect();
        let hits: Vec<Vec<Hit>> =
            clip.iter().zip(&scenes).map(|(clip, scene)| visible(clip, &scene.mesh.triangles)).collect();
        let right = scenes.iter().zip(&hits).map(|(scene, hits)| right_picture(answer, scene, hits)).collect();
        Bench { scenes, clip, hits, right }
    }

    pub fn right(&self) -> &[Picture] {
        &self.right
    }

    pub fn draw(&self, program: &Program) -> Result<Vec<Picture>, String> {
        (0..self.scenes.len()).map(|at| self.draw_one(program, at)).collect()
    }

    fn draw_one(&self, program: &Program, at: usize) -> Result<Picture, String> {
        program.draw(&self.scenes[at], &self.hits[at], &self.clip[at])
    }

    /// Whether a program draws these pictures, as a screen shows them.
    pub fn draws(&self, program: &Program, pictures: &[Picture]) -> bool {
        (0..self.scenes.len()).all(|at| {
            let own = self.draw_one(program, at);
            own.is_ok_and(|own| is_same(&own, &pictures[at], true))
        })
    }
}

/// The right picture.
fn right_picture(answer: &Answer, scene: &BenchScene, hits: &[Hit]) -> Picture {
    let mesh = &scene.mesh;
    let world: Vec<Vec3> = mesh.positions.iter().map(|p| scene.model.transform_point3(*p)).collect();
    let by_transpose = Mat3::from_mat4(scene.model).inverse().transpose();
    let normals: Vec<Vec3> = mesh
        .normals
        .iter()
        .map(|n| if answer.unit_in_vertex { (by_transpose * *n).normalize() } else { by_transpose * *n })
        .collect();
    let mut picture = vec![None; SIDE * SIDE];
    for hit in hits {
        let mix = |all: &[Vec3]| -> Vec3 {
            let corners = hit.triangle.map(|index| all[index as usize]);
            corners[0] * hit.weights.x + corners[1] * hit.weights.y + corners[2] * hit.weights.z
        };
        picture[hit.pixel] = Some(match answer.task {
            GeneratedTask::Skybox => radiance(mix(&mesh.positions)),
            task if task.is_per_vertex() => {
                let at = |index: u32| shade(answer, scene, world[index as usize], normals[index as usize]);
                let [a, b, c] = hit.triangle.map(at);
                a * hit.weights.x + b * hit.weights.y + c * hit.weights.z
            }
            _ => shade(answer, scene, mix(&world), mix(&normals).normalize()),
        });
    }
    picture
}

/// The equation of the exercise at a point, in world space.
fn shade(answer: &Answer, scene: &BenchScene, position: Vec3, n: Vec3) -> Vec3 {
    let v = (scene.eye - position).normalize();
    match answer.task {
        GeneratedTask::Reflection => return radiance(2.0 * n.dot(v) * n - v),
        GeneratedTask::Refraction => {
            let (ratio, cosine) = (1.0 / scene.index, n.dot(v));
            return radiance((ratio * cosine - (1.0 - ratio * ratio * (1.0 - cosine * cosine)).sqrt()) * n - ratio * v);
        }
        _ => {}
    }
    let mut sum = Vec3::ZERO;
    for Light { position: place, strengths: [ka, kd, ks], attenuation: [kc, kl, kq] } in
        scene.lights.iter().take(answer.lights)
    {
        let (l, d) = ((*place - position).normalize(), place.distance(position));
        let cosine = n.dot(l).max(0.0);
        let base = if answer.half_vector { n.dot((l + v).normalize()) } else { (2.0 * n.dot(l) * n - l).dot(v) };
        let mut power = base.max(0.0).powf(scene.shininess);
        if answer.gated && n.dot(l) <= 0.0 {
            power = 0.0;
        }
        if answer.cosine_weighted {
            power *= cosine;
        }
        sum += match answer.task {
            GeneratedTask::GouraudDiffuse | GeneratedTask::PhongDiffuse => Vec3::splat(cosine + answer.ambient),
            GeneratedTask::GouraudSpecular | GeneratedTask::PhongSpecular => Vec3::splat(power + answer.ambient),
            _ => {
                let attenuation = 1.0 / (kc + kl * d + kq * d * d);
                let highlight = if answer.white_highlight { Vec3::ONE } else { scene.material };
                scene.material * (ka + attenuation * kd * cosine) + highlight * (attenuation * ks * power)
            }
        };
    }
    sum
}

/// Whether two pictures are the same up to rounding; `clamped`: as a screen shows them.
pub(crate) fn is_same(a: &Picture, b: &Picture, clamped: bool) -> bool {
    let (beyond, drawn) = beyond(a, b, 3e-3, clamped);
    beyond * 200 <= drawn
}

/// Whether a person sees the difference of two pictures, in at least one pixel of 60.
pub(crate) fn is_visible(a: &[Picture], b: &[Picture]) -> bool {
    a.iter().zip(b).any(|(a, b)| {
        let (beyond, drawn) = beyond(a, b, 0.02, true);
        beyond >= 4 && beyond * 60 >= drawn
    })
}

/// The pixels that differ, and those drawn.
fn beyond(a: &Picture, b: &Picture, tolerance: f32, clamped: bool) -> (usize, usize) {
    let (mut beyond, mut drawn) = (0, 0);
    for (a, b) in a.iter().zip(b) {
        let (a, b) = match (a, b) {
            (None, None) => continue,
            (Some(a), Some(b)) => (a, b),
            _ => {
                (beyond, drawn) = (beyond + 1, drawn + 1);
                continue;
            }
        };
        drawn += 1;
        let shown = |x: f32| if clamped { x.clamp(0.0, 1.0) } else { x };
        let differs = |c: usize| match (a[c].is_finite(), b[c].is_finite()) {
            (true, true) => (shown(a[c]) - shown(b[c])).abs() > tolerance * b[c].abs().clamp(1.0, 4.0),
            (a, b) => a != b,
        };
        beyond += usize::from((0..3).any(differs));
    }
    (beyond, drawn)
}
