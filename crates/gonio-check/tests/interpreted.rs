//! The interpreter draws what the driver draws: all submissions, the exercises' reference solutions, and gonio's own shaders.
//!
//! The driver says which triangle each pixel shows and with which weights, because rasterization is not the
//! interpreter's task. The tolerance is that of the issue: 1/255 in at least 99.9 % of the pixels of each pair.
#![allow(clippy::unwrap_used)]

mod own;
mod submissions;

use gonio_check::comparison::{Task, declared};
use gonio_check::compile::{ParsedStage, compile};
use gonio_check::roles::{self, NamesFile, VariableKind};
use gonio_check::submission::{StageText, Submission};
use gonio_check::testbench::{
    CUBEMAP_UNIT, SKY_SIDE, TILE, TestMesh, TestScene, WHITE_UNIT, numbers_of, sky_faces, stream_of, unit,
};
use gonio_fixtures::{FixtureTable, selected};
use gonio_gl::{Gl, HeadlessContext};
use gonio_glsl::{OutputVersion, Severity, Stage};
use gonio_interpreter::{
    CompiledStage, Fragment, PointValues, RunOptions, StageInputs, TextureLookup, TextureSource, interpolate, run,
};
use gonio_render::user_program::{FloatTexture, NOT_DRAWN, Stream, StreamMesh, TileTarget, UserProgram};
use std::collections::{BTreeSet, HashMap};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Mutex;

/// A pair to draw.
struct Pair {
    name: String,
    exercise: String,
    vertex: StageText,
    fragment: StageText,
    names: NamesFile,
    /// The uniforms of gonio's own shaders, which have no roles, by name.
    given: &'static [(&'static str, &'static [f32])],
}

fn pairs() -> Vec<Pair> {
    let mut all = Vec::new();
    for submission in submissions::submissions("correct").into_iter().chain(submissions::submissions("wrong")) {
        let Ok(found) = Submission::gather(submission.files) else { continue };
        let names = found.names.as_deref().map_or_else(NamesFile::default, |text| NamesFile::parse(text).unwrap());
        let (name, exercise) = (submission.name, submission.exercise);
        all.push(Pair { name, exercise, vertex: found.vertex, fragment: found.fragment, names, given: &[] });
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../exercises");
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let read = |file: &str| std::fs::read_to_string(entry.path().join(file));
        let (Ok(vertex), Ok(fragment)) = (read("reference.vert"), read("reference.frag")) else { continue };
        let name = entry.file_name().into_string().unwrap();
        let exercise = name.split('-').next().unwrap().to_owned();
        let (vertex, fragment) =
            (StageText::whole("reference.vert", vertex), StageText::whole("reference.frag", fragment));
        all.push(Pair { name, exercise, vertex, fragment, names: NamesFile::default(), given: &[] });
    }
    // Pairs in every dialect, drawn in the scenes of the light equation.
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../gonio-glsl/tests/pairs.txt")).unwrap();
    for case in table.cases().unwrap() {
        let text = |file: &str| StageText::whole(file, case.text(file).unwrap());
        let (vertex, fragment) = (text("shader.vert"), text("shader.frag"));
        let (name, exercise) = (format!("dialects/{}", case.name), "ex07".to_owned());
        all.push(Pair { name, exercise, vertex, fragment, names: NamesFile::default(), given: &[] });
    }
    all.retain(|pair| !NOT_COMPARED.iter().any(|(name, _)| *name == pair.name));
    all.sort_by(|a, b| a.name.cmp(&b.name));
    all
}

fn own_pairs() -> Vec<Pair> {
    let pair = |(name, [vertex, fragment]): (String, [String; 2])| Pair {
        name: format!("own/{name}"),
        exercise: "ex07".into(),
        vertex: StageText::whole("own.vert", vertex),
        fragment: StageText::whole("own.frag", fragment),
        names: NamesFile::default(),
        given: own::UNIFORMS,
    };
    own::sources().into_iter().map(pair).collect()
}

/// Pairs that cannot be compared in this way, with the reason.
const NOT_COMPARED: [(&str, &str); 5] = [
    ("dialects/06-legacy-120", "the translation renames the built-in attributes"),
    ("dialects/07-block-450", "gl_VertexID: the driver draws without indices"),
    ("dialects/12-texture-named", "the translation renames the uniform `texture`"),
    ("dialects/22-compat-330", "the translation renames the built-in attributes"),
    ("ex12/wrong/degrees", "the tangent of up to 90 radians, whose poles magnify the last bit of the arc cosine"),
];

/// A third of the pairs, which were not looked at while the interpreter was written.
fn is_held_back(name: &str) -> bool {
    name.bytes().fold(7_u32, |hash, byte| hash.wrapping_mul(31).wrapping_add(u32::from(byte))) % 3 == 0
}

/// The testbench's textures: bilinear filters on the faces of the cubemap, each clamped to its edge.
struct BenchTextures {
    faces: [Vec<[f32; 4]>; 6],
    /// The face that each point has looked up.
    met: Mutex<Vec<(usize, usize)>>,
}

impl TextureSource for BenchTextures {
    fn look_up(&self, lookup: &TextureLookup) -> [f32; 4] {
        match lookup.sampler {
            CUBEMAP_UNIT if lookup.dims == 3 => self.sky(lookup),
            // The filter weighs texels with parts of the coordinates.
            WHITE_UNIT if lookup.coordinates.iter().any(|x| !x.is_finite()) => [f32::NAN; 4],
            WHITE_UNIT => [1.0; 4],
            _ => [0.0, 0.0, 0.0, 1.0],
        }
    }

    fn size(&self, _sampler: u32, _level: i32) -> [u32; 3] {
        [SKY_SIDE as u32, SKY_SIDE as u32, 1]
    }
}

impl BenchTextures {
    fn sky(&self, lookup: &TextureLookup) -> [f32; 4] {
        let [x, y, z, _] = lookup.coordinates;
        let (face, s, t) = on_face(x, y, z);
        self.met.lock().unwrap().push((lookup.point, face));
        let place = |v: f32| (v + 1.0) * 0.5 * SKY_SIDE as f32 - 0.5;
        let (u, v) = (place(s), place(t));
        let (fu, fv) = (u - u.floor(), v - v.floor());
        let texel = |i: f32, j: f32| {
            let clamp = |x: f32| x.clamp(0.0, SKY_SIDE as f32 - 1.0) as usize;
            self.faces[face][clamp(j) * SKY_SIDE + clamp(i)]
        };
        let (i, j) = (u.floor(), v.floor());
        let corners = [texel(i, j), texel(i + 1.0, j), texel(i, j + 1.0), texel(i + 1.0, j + 1.0)];
        let weights = [(1.0 - fu) * (1.0 - fv), fu * (1.0 - fv), (1.0 - fu) * fv, fu * fv];
        std::array::from_fn(|c| corners.iter().zip(weights).map(|(corner, weight)| corner[c] * weight).sum())
    }
}

/// The face that a direction meets, and where (OpenGL 4.6, table 8.19).
fn on_face(x: f32, y: f32, z: f32) -> (usize, f32, f32) {
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    if ax + ay + az == 0.0 {
        // Undefined; this driver takes the middle of +Z.
        (4, 0.0, 0.0)
    } else if ax >= ay && ax >= az {
        if x > 0.0 { (0, -z / ax, -y / ax) } else { (1, z / ax, -y / ax) }
    } else if ay >= az {
        if y > 0.0 { (2, x / ay, z / ay) } else { (3, x / ay, -z / ay) }
    } else if z > 0.0 {
        (4, x / az, -y / az)
    } else {
        (5, -x / az, -y / az)
    }
}

struct Bench {
    gl: Gl,
    target: TileTarget,
    cube: FloatTexture,
    white: FloatTexture,
    textures: BenchTextures,
}

/// The interpreter's inputs of one name.
fn values(glsl_type: &str, numbers: &[f32]) -> PointValues {
    let is_float = glsl_type == "float" || glsl_type.starts_with("vec") || glsl_type.starts_with("mat");
    match is_float {
        true => PointValues::floats(numbers),
        false => PointValues::ints(&numbers.iter().map(|x| x.round() as i32).collect::<Vec<_>>()),
    }
}

/// Sets an input by the name that the translation gives to it: `Block_member` for the member of a block,
/// `gonio_Fog.color` for OpenGL's own.
fn set_input(inputs: &mut StageInputs, stage: &CompiledStage, name: &str, values: PointValues) {
    let own = name.replacen("gonio_", "gl_", 1);
    let is_it = |input: &str| input == name || input == own || input.replace('.', "_") == name;
    let found = stage.inputs.iter().position(|input| is_it(&input.name));
    if let Some(found) = found {
        inputs.set(found, values);
    }
}

/// The vertex shader with the weights of the corners and the number of the triangle as outputs.
fn numbered(vertex: &str) -> Option<String> {
    // "main" may also be a part of a longer word before it.
    let at = vertex.find("\nvoid main() {").map(|at| at + 6).or_else(|| vertex.find("main"))?;
    let (before, after) = vertex.split_at(at);
    let outputs = "in vec3 gonio_corner;\nin float gonio_triangle;\nout vec3 gonio_share;\nflat out float gonio_which;\n\
                   out float gonio_depth;\n";
    Some(format!(
        "{before}gonio_numbered{}\n{outputs}void main() {{ gonio_numbered(); gonio_share = gonio_corner; gonio_which = gonio_triangle; }}\n",
        &after[4..]
    ))
}

const WHICH: &str = "#version 330 core\nin vec3 gonio_share;\nflat in float gonio_which;\nout vec4 seen;\n\
                     void main() { seen = vec4(gonio_share, gonio_which); }\n";

/// What became of a pair.
enum Compared {
    /// The driver does not compile it, or it shows nothing.
    Nothing,
    /// Pixels that agree, of how many, and the first one that does not.
    Pixels(usize, usize, String),
    /// The interpreter does not run it.
    Refused(String),
}

fn interpretable(text: &StageText, stage: Stage) -> Result<CompiledStage, String> {
    let mut parsed = gonio_glsl::parse(&text.text);
    let checked = gonio_glsl::check(&mut parsed, stage);
    gonio_interpreter::compile(&parsed, &checked).map_err(|error| format!("{stage}: {error}"))
}

fn streams(mesh: &TestMesh) -> [(usize, &[f32]); 4] {
    [(3, &mesh.positions), (3, &mesh.normals), (2, &mesh.tex_coords), (3, &mesh.colors)]
}

impl Bench {
    fn new(gl: &Gl) -> Self {
        let faces = sky_faces();
        Self {
            gl: gl.clone(),
            target: TileTarget::new(gl, TILE, 2).unwrap(),
            cube: FloatTexture::cube(gl, SKY_SIDE, &faces, "sky").unwrap(),
            white: FloatTexture::flat(gl, [1, 1], &[[1.0; 4]], "white").unwrap(),
            // The driver's texels are 16-bit floats; their error is below a thousandth.
            textures: BenchTextures { faces, met: Mutex::default() },
        }
    }

    fn compare(&self, pair: &Pair) -> Compared {
        let vertex = ParsedStage::new(&pair.vertex, Stage::Vertex, OutputVersion::Core330);
        let fragment = ParsedStage::new(&pair.fragment, Stage::Fragment, OutputVersion::Core330);
        let Ok(program) = compile(&self.gl, &vertex, &fragment) else { return Compared::Nothing };
        // This driver also links inputs that are not outputs of the vertex shader; their values are arbitrary.
        let problems = gonio_glsl::check_pair(&vertex.checked, &fragment.checked);
        if problems.iter().any(|problem| problem.severity == Severity::Error) {
            return Compared::Nothing;
        }
        let stages = interpretable(&pair.vertex, Stage::Vertex)
            .and_then(|vertex| Ok((vertex, interpretable(&pair.fragment, Stage::Fragment)?)));
        let (vertex_code, fragment_code) = match stages {
            Ok(stages) => stages,
            Err(error) => return Compared::Refused(error),
        };
        let Some(numbered) = numbered(&vertex.translated.text) else { return Compared::Nothing };
        let places = UserProgram::new(&self.gl, &numbered, WHICH).unwrap_or_else(|e| panic!("{}: {e}", pair.name));
        let (scenes, [whole, _]) = Task::find(&pair.exercise).unwrap().test_scenes();
        let components = fragment_code.outputs.first().and_then(|output| output.ty.components()).unwrap_or(4) as usize;
        let (mut right, mut all, mut first) = (0, 0, String::new());
        for scene in [0, whole / 2, whole - 1].map(|index| &scenes[index]) {
            let drawn = self.draw(pair, &program, &places, scene);
            let own = self.interpret(pair, &program, (&vertex_code, &fragment_code), scene, &drawn[1]);
            for (pixel, color) in own {
                let expected = drawn[0][pixel];
                if expected == NOT_DRAWN {
                    continue;
                }
                // What an `out vec3` leaves open is not compared.
                let is_right = color
                    .iter()
                    .zip(expected)
                    .take(components)
                    .all(|(a, b)| (a - b).abs() <= b.abs().max(1.0) / 255.0 || (!a.is_finite() && !b.is_finite()));
                all += 1;
                right += usize::from(is_right);
                if !is_right && first.is_empty() {
                    first = format!("pixel {pixel}: {color:?}, the driver {expected:?}");
                }
            }
        }
        if all == 0 { Compared::Nothing } else { Compared::Pixels(right, all, first) }
    }

    /// Draws the pair, and the triangle and weights of each pixel.
    fn draw(&self, pair: &Pair, program: &UserProgram, places: &UserProgram, scene: &TestScene) -> [Vec<[f32; 4]>; 2] {
        let mesh = scene.shape.mesh();
        let mut all: [Vec<f32>; 6] = Default::default();
        for (index, vertex) in mesh.indices.iter().enumerate() {
            for ((components, numbers), into) in streams(&mesh).iter().zip(&mut all) {
                into.extend(&numbers[*vertex as usize * components..][..*components]);
            }
            all[4].extend([0, 1, 2].map(|corner| if index % 3 == corner { 1.0 } else { 0.0 }));
            all[5].push((index / 3) as f32);
        }
        let sizes = [3, 3, 2, 3, 3, 1];
        let list: Vec<Stream<'_>> =
            all.iter().zip(sizes).map(|(numbers, components)| Stream { name: "stream", components, numbers }).collect();
        let indices: Vec<u32> = (0..mesh.indices.len() as u32).collect();
        let mesh = StreamMesh::new(&self.gl, &list, &indices, "mesh").unwrap();
        self.target.begin();
        self.cube.bind(CUBEMAP_UNIT);
        self.white.bind(WHITE_UNIT);
        for (tile, drawn) in [program, places].into_iter().enumerate() {
            drawn.bind();
            for (name, _, numbers) in uniforms(program, pair, scene) {
                drawn.set(&name, &numbers);
            }
            let mut feed: Vec<(u32, usize)> = attributes(program, pair)
                .into_iter()
                .filter_map(|(name, stream)| Some((drawn.attribute_location(&name)?, stream)))
                .collect();
            for (name, stream) in [("gonio_corner", 4), ("gonio_triangle", 5)] {
                feed.extend(drawn.attribute_location(name).map(|location| (location, stream)));
            }
            self.target.select(tile);
            mesh.draw(drawn, &feed);
        }
        let pixels = self.target.read(2);
        let size = (TILE * TILE) as usize;
        [pixels[..size].to_vec(), pixels[size..].to_vec()]
    }

    /// Returns the pixels that show a triangle with the interpreter's colours.
    fn interpret(
        &self,
        pair: &Pair,
        program: &UserProgram,
        (vertex, fragment): (&CompiledStage, &CompiledStage),
        scene: &TestScene,
        places: &[[f32; 4]],
    ) -> Vec<(usize, [f32; 4])> {
        let mesh = scene.shape.mesh();
        let mut inputs = StageInputs::new(vertex, mesh.positions.len() / 3);
        let given = uniforms(program, pair, scene);
        for (name, glsl_type, numbers) in &given {
            set_input(&mut inputs, vertex, name, values(glsl_type, numbers));
        }
        for (name, stream) in attributes(program, pair) {
            let (components, numbers) = streams(&mesh)[stream];
            let mut planes: Vec<Vec<f32>> =
                (0..components).map(|c| numbers.iter().skip(c).step_by(components).copied().collect()).collect();
            // OpenGL's own position and colour have four components.
            if ["gonio_Vertex", "gonio_VertexColor"].contains(&name.as_str()) {
                planes.push(vec![1.0; planes[0].len()]);
            }
            let planes: Vec<&[f32]> = planes.iter().map(Vec::as_slice).collect();
            set_input(&mut inputs, vertex, &name, PointValues::each(&planes));
        }
        // The driver draws without indices: what counts is the first triangle, which alone is the sky.
        let number =
            |vertex: usize| mesh.indices.iter().position(|index| *index as usize == vertex).unwrap_or(3) as i32;
        let numbers: Vec<u32> = (0..inputs.points()).map(|vertex| number(vertex) as u32).collect();
        inputs.set_named(vertex, "gl_VertexID", PointValues::Each { components: vec![numbers], written: None });
        let options = RunOptions { textures: &self.textures, ..RunOptions::default() };
        let vertices = run(vertex, &inputs, &options);
        let position = vertices.output(vertex, "gl_Position").unwrap();
        let (mut pixels, mut fragments) = (Vec::new(), Vec::new());
        for (pixel, place) in places.iter().enumerate().filter(|(_, place)| **place != NOT_DRAWN) {
            let first = place[3].round() as usize * 3;
            let corners: [u32; 3] = std::array::from_fn(|at| mesh.indices[first + at]);
            let weights = [place[0], place[1], place[2]];
            let w: [f32; 3] = std::array::from_fn(|at| position.float(3, corners[at] as usize));
            // The driver's weights are those in space.
            let shares: [f32; 3] = std::array::from_fn(|at| weights[at] * w[at]);
            let sum: f32 = shares.iter().sum();
            let screen = if sum == 0.0 { weights } else { shares.map(|share| share / sum) };
            pixels.push(pixel);
            fragments.push(Fragment { corners, screen, weights });
        }
        let mut inputs = interpolate(vertex, &vertices.outputs, fragment, &fragments);
        for (name, glsl_type, numbers) in &given {
            set_input(&mut inputs, fragment, name, values(glsl_type, numbers));
        }
        let along = |of: fn(u32) -> u32| pixels.iter().map(|p| of(*p as u32) as f32 + 0.5).collect::<Vec<f32>>();
        let (x, y) = (along(|pixel| pixel % TILE), along(|pixel| pixel / TILE));
        inputs.set_named(fragment, "gl_FragCoord", PointValues::each(&[&x, &y]));
        self.textures.met.lock().unwrap().clear();
        let fragments = run(fragment, &inputs, &options);
        // This driver chooses one face of a cubemap for all four pixels of a quad.
        let mut faces: HashMap<[usize; 2], BTreeSet<usize>> = HashMap::new();
        let quad = |pixel: usize| [pixel % TILE as usize / 2, pixel / TILE as usize / 2];
        for (point, face) in self.textures.met.lock().unwrap().iter() {
            faces.entry(quad(pixels[*point])).or_default().insert(*face);
        }
        assert_eq!(fragments.ended, None, "{}", pair.name);
        let output = fragments.outputs.first().unwrap();
        let color = |point: usize| -> [f32; 4] {
            std::array::from_fn(|c| output.component(c, point).map_or(if c == 3 { 1.0 } else { 0.0 }, f32::from_bits))
        };
        let is_kept = |point: &usize| {
            let is_discarded = fragments.discarded.get(*point).copied().unwrap_or(false);
            !is_discarded && faces.get(&quad(pixels[*point])).is_none_or(|faces| faces.len() == 1)
        };
        (0..pixels.len()).filter(is_kept).map(|point| (pixels[point], color(point))).collect()
    }
}

/// The uniforms of a program with their types and values.
fn uniforms(program: &UserProgram, pair: &Pair, scene: &TestScene) -> Vec<(String, String, Vec<f32>)> {
    let bindings = roles::bind(&declared(program), &pair.names);
    let mut found = Vec::new();
    for variable in declared(program).into_iter().filter(|d| d.kind == VariableKind::Uniform) {
        let (name, ty) = (variable.name.clone(), variable.glsl_type.clone());
        let fixed = bindings.fixed.iter().find(|f| f.declared.name == name).map(|f| f.values.clone());
        let role = bindings.bound.iter().find(|bound| bound.declared.name == name);
        let given = pair.given.iter().find(|(given, _)| *given == name).map(|(_, numbers)| numbers.to_vec());
        let numbers = match unit(&name, &ty) {
            _ if given.is_some() => given,
            Some(unit) => Some(vec![unit as f32; variable.array as usize]),
            None => fixed.or_else(|| numbers_of(&bindings, role?, scene)),
        };
        found.extend(numbers.map(|numbers| (name, ty, numbers)));
    }
    found
}

/// The attributes with their streams.
fn attributes(program: &UserProgram, pair: &Pair) -> Vec<(String, usize)> {
    if !pair.given.is_empty() {
        let streams = ["position", "normal", "tex_coord"];
        return streams.iter().enumerate().map(|(stream, name)| ((*name).to_owned(), stream)).collect();
    }
    let bindings = roles::bind(&declared(program), &pair.names);
    let of = bindings.bound.iter().filter(|bound| bound.declared.kind == VariableKind::Attribute);
    of.filter_map(|bound| Some((bound.declared.name.clone(), stream_of(bound.role)?))).collect()
}

/// Compares all pairs; returns how many hold, of how many, and a line for each of the others.
fn compared(pairs: Vec<Pair>) -> (usize, usize, String) {
    let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
    let bench = Bench::new(context.gl());
    let (mut held, mut all, mut others) = (0, 0, String::new());
    for pair in pairs {
        match bench.compare(&pair) {
            Compared::Nothing => {}
            Compared::Refused(why) => {
                all += 1;
                writeln!(others, "{}: refused: {why}", pair.name).unwrap();
            }
            Compared::Pixels(right, of, first) => {
                all += 1;
                if right * 1000 >= of * 999 {
                    held += 1;
                } else {
                    writeln!(others, "{}: {right} of {of}; {first}", pair.name).unwrap();
                }
            }
        }
    }
    (held, all, others)
}

#[test]
fn pairs_are_drawn_as_the_driver_draws_them() {
    let known: Vec<Pair> = pairs().into_iter().filter(|pair| !is_held_back(&pair.name)).collect();
    let (held, all, others) = compared(selected(known, |pair| &pair.name));
    assert!(held == all && all > 370, "{held} of {all}\n{others}");
}

#[test]
fn pairs_that_were_held_back_are_drawn_as_the_driver_draws_them() {
    let known: Vec<Pair> = pairs().into_iter().filter(|pair| is_held_back(&pair.name)).collect();
    let (held, all, others) = compared(selected(known, |pair| &pair.name));
    assert!(held == all && all > 180, "{held} of {all}\n{others}");
}

#[test]
fn own_shaders_are_drawn_as_the_driver_draws_them() {
    let (held, all, others) = compared(selected(own_pairs(), |pair| &pair.name));
    assert!(held == all && all > 80, "{held} of {all}\n{others}");
}
