//! Generates pairs of shaders as students write them, right ones and ones with mistakes, to measure the checker with
//! programs that nobody has seen.
//!
//! A program is not patched text. An `Answer` says what is computed, a `Plan` says how, and a
//! mistake changes one quantity while the text is written. Every program is run by the interpreter: without its mistake it
//! draws the right pictures, computed without any shader; with it, it draws visibly different ones. The same seed and
//! number give the same text.
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod environment;
mod expression;
mod geometry;
mod light_data;
mod lit;
mod mistakes;
mod names;
mod pictures;
mod plan;
mod scenes;
mod terms;
mod writer;

pub use plan::GeneratedTask;

use expression::{Random, Site};
use mistakes::{SLIPS, Slip, id_of};
use names::{Dialect, Names};
use pictures::{Bench, Picture, Program, is_same, is_visible};
use plan::{Answer, NormalBy, Plan, SumForm};
#[cfg(test)]
use scenes::{Field, Meaning};
use writer::{Context, Input, Style, Writer};

/// A mistake in a generated pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LabelledMistake {
    /// The generator's name for it.
    pub key: &'static str,
    /// The ids in the catalogue that name it, with those that no picture tells apart; empty if it is in no list.
    pub ids: Vec<&'static str>,
    /// The files and lines, from 1, where the wrong quantity is computed.
    pub places: Vec<(String, u32)>,
}

/// A generated pair, with what a checker should find in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeneratedPair {
    /// The exercise that it answers.
    pub exercise: &'static str,
    /// The seed of the whole series.
    pub seed: u64,
    /// Its number in the series.
    pub index: u64,
    /// Names and texts of the files.
    pub files: Vec<(String, String)>,
    /// The mistakes: none, one or two.
    pub mistakes: Vec<LabelledMistake>,
    /// The same program, rewritten: the same pictures, and so the same verdict.
    pub rewrites: Vec<Vec<(String, String)>>,
    /// Mistakes that were tried and left out, because no picture or hardly any shows them.
    pub invisible: Vec<&'static str>,
}

/// Names and texts.
type Files = Vec<(String, String)>;

/// The text of a program.
struct Written {
    texts: [String; 2],
    lines: [Vec<(Site, u32)>; 2],
    inputs: Vec<Input>,
}

/// A plan with a style and names.
struct Sketch {
    plan: Plan,
    style: Style,
    names: Names,
    random: Random,
}

impl Sketch {
    fn draw(answer: &Answer, mut random: Random) -> Self {
        let plan = Plan::draw(answer, &mut random);
        let dialects = [
            (30, (Dialect::Lab, 0)),
            (24, (Dialect::English, 0)),
            (14, (Dialect::French, 1)),
            (10, (Dialect::German, 2)),
            (10, (Dialect::Spanish, 3)),
            (12, (Dialect::Short, 0)),
        ];
        let (dialect, language) = random.weighted(&dialects, (Dialect::Lab, 0));
        // French students write the lab's names too.
        let language = if dialect == Dialect::Lab { random.below(4) } else { language };
        // The lowest version decides which literals both stages may use.
        let [first, second] = plan.versions;
        let style = Style::draw(language, if first.number < second.number { first } else { second }, &mut random);
        let names = Names::draw(dialect, &mut random);
        Sketch { plan, style, names, random }
    }

    fn write(&self, answer: &Answer, slips: &[&'static str]) -> Written {
        let Sketch { plan, style, names, random } = self;
        let context = Context { answer, plan, names, style, slips, random: *random };
        let (mut vertex, mut fragment) = (Writer::new(context, 0), Writer::new(context, 1));
        let (first, second) = if answer.task.is_lit() {
            lit::write(&mut vertex, &mut fragment)
        } else {
            environment::write(&mut vertex, &mut fragment)
        };
        vertex.leftovers();
        fragment.leftovers();
        let mut inputs = std::mem::take(&mut vertex.inputs);
        inputs.append(&mut fragment.inputs);
        let ((vertex, vertex_lines), (fragment, fragment_lines)) = (vertex.finish(&first), fragment.finish(&second));
        Written { texts: [vertex, fragment], lines: [vertex_lines, fragment_lines], inputs }
    }

    fn pictures(&self, bench: &Bench, answer: &Answer, slips: &[&'static str]) -> Result<Vec<Picture>, String> {
        let written = self.write(answer, slips);
        let said = |error: String| format!("{slips:?}: {error}\n{}\n{}", written.texts[0], written.texts[1]);
        let program = Program::new(&written.texts[0], &written.texts[1], written.inputs.clone()).map_err(said)?;
        bench.draw(&program)
    }

    /// Whether the program with these mistakes draws these pictures.
    fn draws(&self, bench: &Bench, answer: &Answer, slips: &[&Slip], pictures: &[Picture]) -> bool {
        if !slips.iter().all(|slip| self.fits(answer, slip)) {
            return false;
        }
        let text = self.write(answer, &slips.iter().map(|slip| slip.key).collect::<Vec<_>>());
        Program::new(&text.texts[0], &text.texts[1], text.inputs).is_ok_and(|program| bench.draws(&program, pictures))
    }

    fn fits(&self, answer: &Answer, slip: &Slip) -> bool {
        // `a * b * position` is right with P V and M, and `a * b * c * position` in the order in which it is written: without the
        // names nothing says that they are others.
        let is_product = slip.site == Site::ClipPosition
            && (slip.key.ends_with("-matrix-missing") || slip.key.starts_with("matrix-order"));
        // Only the exercise says that its V has the translation of the camera.
        let is_open_sky =
            slip.key == "skybox-keeps-translation" && [self.names.get("V"), self.names.get("P")] != ["V", "P"];
        // Diffuse light in view space is right with a normal matrix and a light of that space, unless the name tells another one.
        let is_open_space = slip.key == "position-in-view-space"
            && !answer.task.has_specular()
            && match self.plan.normal_by {
                NormalBy::Mat3Uniform => true,
                NormalBy::Computed | NormalBy::RowTimesInverse => false,
                _ => !["itM", "inverseTransposeModel"].contains(&self.names.get("itM")),
            };
        // Without names, V M may be sent as M, or as the matrix of the normals, P V as the sky's matrix, and the root of a strength
        // as the strength.
        let is_of_other_input =
            ["position-in-view-space", "normal-by-model-view", "direction-turned-by-view", "skybox-not-turned"]
                .contains(&slip.key)
                || slip.key.ends_with("-strength-squared");
        let is_open = (is_product || is_of_other_input) && self.names.are_meaningless || is_open_sky || is_open_space;
        (slip.fits)(answer, &self.plan) && !is_open
    }

    /// Where a mistake is in the text.
    fn site(&self, slip: &Slip) -> Site {
        let per_term = self.plan.sum == SumForm::PerTerm;
        if slip.key == "ambient-not-coloured" && per_term { Site::Ambient } else { slip.site }
    }

    /// The files, and the number of lines before each stage's text.
    fn files(&self, written: &Written) -> (Files, [(usize, u32); 2]) {
        let mut random = self.random.named("files", 0);
        let [vertex, fragment] = &written.texts;
        if random.chance(0.05) && !vertex.contains('\r') {
            let head = "#include <glad/glad.h>\n\nconst char* vertexSource = R\"(";
            let middle = ")\";\n\nconst char* fragmentSource = R\"(";
            let text = format!(
                "{head}{vertex}{middle}{fragment})\";\n\nint main() {{\n    return run(vertexSource, fragmentSource);\n}}\n"
            );
            let lines = |text: &str| text.matches('\n').count() as u32;
            let before = lines(head);
            return (vec![("main.cpp".into(), text)], [(0, before), (0, before + lines(vertex) + lines(middle))]);
        }
        let names = [
            ["shader.vert", "shader.frag"],
            ["vertex.glsl", "fragment.glsl"],
            ["phong.vs", "phong.fs"],
            ["vertexShader.txt", "fragmentShader.txt"],
            ["tp.vert", "tp.frag"],
        ];
        let [a, b] = random.pick(&names).unwrap_or(names[0]);
        (vec![(a.into(), vertex.clone()), (b.into(), fragment.clone())], [(0, 0), (1, 0)])
    }

    /// Files and lines of a quantity.
    fn places(&self, written: &Written, site: Site) -> Vec<(String, u32)> {
        let (files, stages) = self.files(written);
        let mut all = Vec::new();
        for (lines, (file, before)) in written.lines.iter().zip(stages) {
            all.extend(
                lines.iter().filter(|(of, _)| *of == site).map(|(_, line)| (files[file].0.clone(), line + before)),
            );
        }
        all
    }
}

/// Mistakes that real students make most (`lab-facts` of the exercises: by frequency in 131 public pairs).
const COMMON: [&str; 16] = [
    "normal-not-renormalised",
    "normal-by-model-matrix",
    "normal-not-normalised-in-vertex",
    "terms-not-put-out",
    "ambient-attenuated",
    "attenuation-without-constant",
    "attenuation-inverse-square",
    "attenuation-distance-of-direction",
    "attenuation-plus-view-distance",
    "normal-not-transformed",
    "normal-by-model-view",
    "position-in-clip-space",
    "diffuse-floor",
    "ambient-twice",
    "albedo-squared",
    "specular-not-clamped",
];

/// Generates the pair with a number.
///
/// # Errors
/// A fault of the generator: a program that does not compile, or that does not draw the right pictures without its mistakes.
pub fn generate(seed: u64, index: u64, task: Option<GeneratedTask>, rewrites: usize) -> Result<GeneratedPair, String> {
    let base = Random::new(seed).named("pair", index);
    let mut random = base;
    let task =
        task.unwrap_or_else(|| base.named("task", 0).weighted(&GeneratedTask::ALL, GeneratedTask::LightEquation));
    let answer = Answer::draw(task, &mut random);
    let bench = Bench::new(&answer);
    let sketch = Sketch::draw(&answer, base.named("sketch", 0));
    let fault = |error: String| format!("pair {index} of seed {seed} ({}): {error}", task.exercise());
    let check_right = |sketch: &Sketch| -> Result<Vec<Picture>, String> {
        let right = sketch.pictures(&bench, &answer, &[])?;
        match right.iter().zip(bench.right()).position(|(own, right)| !is_same(own, right, false)) {
            None => Ok(right),
            Some(at) => {
                let [vertex, fragment] = sketch.write(&answer, &[]).texts;
                Err(format!("scene {at} is not right\n{answer:?}\n{:?}\n{vertex}\n{fragment}", sketch.plan))
            }
        }
    };
    let right = check_right(&sketch).map_err(fault)?;
    let mut invisible = Vec::new();
    let wanted = random.weighted(&[(30, 0), (45, 1), (25, 2)], 0);
    let mut slips: Vec<&'static Slip> = Vec::new();
    let mut pictures = right.clone();
    for _ in 0..40 {
        if slips.len() == wanted {
            break;
        }
        let Some(slip) = draw_slip(&answer, &sketch, &slips, &mut random) else { break };
        let keys: Vec<&'static str> = slips.iter().chain([&slip]).map(|slip| slip.key).collect();
        let drawn = sketch.pictures(&bench, &answer, &keys).map_err(fault)?;
        // The second mistake has to show beside the first, and the first beside the second.
        let mut is_shown = is_visible(&drawn, &right) && is_visible(&drawn, &pictures);
        if is_shown && !slips.is_empty() {
            let alone = sketch.pictures(&bench, &answer, &[slip.key]).map_err(fault)?;
            is_shown = is_visible(&drawn, &alone) && is_visible(&alone, &right);
            // Two mistakes with the picture of one would be named as that one.
            is_shown = is_shown && !SLIPS.iter().any(|one| sketch.draws(&bench, &answer, &[one], &drawn));
        }
        if is_shown {
            slips.push(slip);
            pictures = drawn;
        } else {
            invisible.push(slip.key);
        }
    }
    let keys: Vec<&'static str> = slips.iter().map(|slip| slip.key).collect();
    let written = sketch.write(&answer, &keys);
    let mistakes =
        slips.iter().map(|slip| label(&bench, &answer, &sketch, &written, slip, &slips, &pictures)).collect();
    let mut others = Vec::new();
    for number in 0..rewrites * 12 {
        if others.len() == rewrites {
            break;
        }
        let other = Sketch::draw(&answer, base.named("rewrite", number as u64));
        if !slips.iter().all(|slip| other.fits(&answer, slip)) {
            continue;
        }
        check_right(&other).map_err(fault)?;
        let text = other.write(&answer, &keys);
        let drawn = other.pictures(&bench, &answer, &keys).map_err(fault)?;
        // A mistake may mean something else in another space.
        if drawn.iter().zip(&pictures).all(|(a, b)| is_same(a, b, false)) {
            others.push(other.files(&text).0);
        }
    }
    let files = sketch.files(&written).0;
    Ok(GeneratedPair { exercise: task.exercise(), seed, index, files, mistakes, rewrites: others, invisible })
}

/// Chooses a mistake that fits, at another quantity than those made already.
fn draw_slip(answer: &Answer, sketch: &Sketch, made: &[&Slip], random: &mut Random) -> Option<&'static Slip> {
    let is_free = |slip: &Slip| made.iter().all(|other| sketch.site(other) != sketch.site(slip));
    let fitting = SLIPS.iter().filter(|slip| sketch.fits(answer, slip) && is_free(slip));
    let weighted: Vec<(u32, &'static Slip)> =
        fitting.map(|slip| (if COMMON.contains(&slip.key) { 6 } else { 2 }, slip)).collect();
    let (_, first) = weighted.first()?;
    Some(random.weighted(&weighted, *first))
}

/// What a checker may say about a mistake: its own id and lines, and those of every other mistake with the same pictures.
fn label(
    bench: &Bench,
    answer: &Answer,
    sketch: &Sketch,
    written: &Written,
    slip: &'static Slip,
    slips: &[&'static Slip],
    pictures: &[Picture],
) -> LabelledMistake {
    let others: Vec<&'static str> = slips.iter().filter(|other| other.key != slip.key).map(|other| other.key).collect();
    let mut ids: Vec<&'static str> = Vec::new();
    let mut places = sketch.places(written, sketch.site(slip));
    if slip.listed {
        ids.push(id_of(slip.key));
    }
    if slip.key == "specular-absolute" {
        // The catalogue has |R.V| under both ids.
        ids.push("specular-not-clamped");
    }
    for other in SLIPS.iter().filter(|other| other.key != slip.key && sketch.fits(answer, other)) {
        if others.contains(&other.key) {
            continue;
        }
        let with_other: Vec<&Slip> = slips.iter().copied().filter(|made| made.key != slip.key).chain([other]).collect();
        if sketch.draws(bench, answer, &with_other, pictures) {
            places.extend(sketch.places(written, sketch.site(other)));
            if other.listed {
                ids.push(id_of(other.key));
            }
        }
    }
    ids.sort_unstable();
    ids.dedup();
    places.sort();
    places.dedup();
    LabelledMistake { key: slip.key, ids, places }
}

impl GeneratedPair {
    /// All files with the label, each with its path: `EXERCISE/correct/0001/NAME`, or `EXERCISE/wrong/0001-MISTAKES/NAME`, as
    /// the corpus has them; the rewrites: `EXERCISE/rewritten/0001-1/NAME`.
    pub fn paths(&self) -> Vec<(String, String)> {
        let folder = match self.mistakes.is_empty() {
            true => format!("{}/correct/{:04}", self.exercise, self.index),
            false => format!("{}/wrong/{:04}-{}", self.exercise, self.index, self.title()),
        };
        let files = self.files.iter().map(|(name, text)| (format!("{folder}/{name}"), text.clone()));
        let rewritten = self.rewrites.iter().enumerate().flat_map(|(number, files)| {
            let folder = format!("{}/rewritten/{:04}-{}", self.exercise, self.index, number + 1);
            files.iter().map(move |(name, text)| (format!("{folder}/{name}"), text.clone()))
        });
        files.chain([(format!("{folder}/expected.toml"), self.expected())]).chain(rewritten).collect()
    }

    /// The label as `expected.toml` of the corpus, with a line about where the pair comes from.
    pub fn expected(&self) -> String {
        let quoted = |all: Vec<String>| {
            let list: Vec<String> = all.iter().map(|text| format!("\"{text}\"")).collect();
            format!("[{}]", list.join(", "))
        };
        let mut text = format!("note = \"generated: seed {}, pair {}\"\n", self.seed, self.index);
        let listed = self.mistakes.iter().filter_map(|mistake| mistake.ids.first());
        if !self.mistakes.is_empty() {
            text.push_str(&format!("mistakes = {}\n", quoted(listed.map(|id| (*id).to_owned()).collect())));
        }
        let also: Vec<String> =
            self.mistakes.iter().flat_map(|mistake| mistake.ids.iter().skip(1).map(|id| (*id).to_owned())).collect();
        if !also.is_empty() {
            text.push_str(&format!("also_right = {}\n", quoted(also)));
        }
        let unlisted = self.mistakes.iter().filter(|mistake| mistake.ids.is_empty());
        let unlisted: Vec<String> = unlisted.map(|mistake| mistake.key.to_owned()).collect();
        if !unlisted.is_empty() {
            text.push_str(&format!("in_no_list = {}\n", quoted(unlisted)));
        }
        let places = self.mistakes.iter().flat_map(|mistake| &mistake.places);
        let places: Vec<String> = places.map(|(file, line)| format!("{file}:{line}")).collect();
        if !places.is_empty() {
            text.push_str(&format!("places = {}\n", quoted(places)));
        }
        text
    }

    /// `correct`, or the mistakes.
    pub fn title(&self) -> String {
        if self.mistakes.is_empty() {
            return "correct".to_owned();
        }
        self.mistakes.iter().map(|mistake| mistake.key).collect::<Vec<_>>().join("+")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::time::{SystemTime, UNIX_EPOCH};

    /// A seed that is new in every run; a failure prints it.
    fn fresh_seed() -> u64 {
        SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos() as u64
    }

    /// `generate` fails if a program does not compile, or if it does not draw the right pictures without its mistakes.
    #[test]
    fn programs_are_right_without_their_mistakes() {
        let seed = fresh_seed();
        let pairs: Vec<GeneratedPair> =
            (0..60).map(|index| generate(seed, index, None, 1).unwrap_or_else(|fault| panic!("{fault}"))).collect();
        let correct = pairs.iter().filter(|pair| pair.mistakes.is_empty()).count();
        let rewritten = pairs.iter().filter(|pair| pair.rewrites.len() == 1).count();
        assert!((5..40).contains(&correct) && rewritten > 45, "seed {seed}: {correct} correct, {rewritten} rewritten");
        for pair in &pairs {
            for mistake in &pair.mistakes {
                assert!(!mistake.places.is_empty(), "seed {seed}, pair {}: {} has no line", pair.index, mistake.key);
                for (file, line) in &mistake.places {
                    let (_, text) = pair.files.iter().find(|(name, _)| name == file).unwrap();
                    assert!(text.lines().count() >= *line as usize, "seed {seed}, pair {}", pair.index);
                }
            }
            assert!(pair.rewrites.iter().all(|rewrite| *rewrite != pair.files), "seed {seed}, pair {}", pair.index);
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_text() {
        let seed = fresh_seed();
        let all: Vec<GeneratedPair> = (0..8).map(|index| generate(seed, index, None, 1).unwrap()).collect();
        for index in [7, 3] {
            assert_eq!(generate(seed, index as u64, None, 1).unwrap(), all[index], "seed {seed}");
        }
        assert_ne!(generate(seed ^ 1, 3, None, 1).unwrap().files, all[3].files, "seed {seed}");
        let programs: BTreeSet<&Files> = all.iter().map(|pair| &pair.files).collect();
        assert_eq!(programs.len(), all.len(), "seed {seed}");
    }

    #[test]
    fn the_exercises_own_answers_draw_the_right_pictures() {
        let inputs = |list: &[(&str, Meaning)]| -> Vec<Input> {
            list.iter().map(|(name, meaning)| Input { name: (*name).to_owned(), meaning: *meaning }).collect()
        };
        let mut all = inputs(&[
            ("position", Meaning::Position),
            ("normal", Meaning::Normal),
            ("tex_coord", Meaning::Unused),
            ("M", Meaning::Model),
            ("itM", Meaning::InverseTranspose),
            ("V", Meaning::View),
            ("P", Meaning::Projection),
            ("u_light_pos", Meaning::OfLight(Field::Position, 0)),
            ("u_view_pos", Meaning::ViewPosition),
            ("shininess", Meaning::Shininess),
            ("materialColour", Meaning::Material),
            ("refractionIndice", Meaning::Index),
            ("cubemapSampler", Meaning::Cubemap),
            ("now", Meaning::Unused),
        ]);
        let of_light = [
            ("light_pos", Field::Position),
            ("ambient_strength", Field::Ambient),
            ("diffuse_strength", Field::Diffuse),
            ("specular_strength", Field::Specular),
            ("constant", Field::Constant),
            ("linear", Field::Linear),
            ("quadratic", Field::Quadratic),
        ];
        all.extend(
            of_light.map(|(name, field)| Input { name: format!("light.{name}"), meaning: Meaning::OfLight(field, 0) }),
        );
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../exercises");
        for (_, task) in GeneratedTask::ALL {
            let entries = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
            let own = entries
                .into_iter()
                .find(|path| path.file_name().unwrap().to_string_lossy().starts_with(task.exercise()));
            let read = |name: &str| std::fs::read_to_string(own.as_ref().unwrap().join(name)).unwrap();
            let program = Program::new(&read("reference.vert"), &read("reference.frag"), all.clone()).unwrap();
            let is_right = [true, false].into_iter().any(|unit_in_vertex| {
                let bench = Bench::new(&Answer { unit_in_vertex, ..Answer::plain(task) });
                let drawn = bench.draw(&program).unwrap();
                drawn.iter().zip(bench.right()).all(|(own, right)| is_same(own, right, false))
            });
            assert!(is_right, "{task:?}");
        }
    }
}
