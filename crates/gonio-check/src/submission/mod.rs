//! Finds the pair of shaders in the files that students hand in.
//!
//! Files may have any names and extensions: one file with both stages, a program whose strings hold them, a whole
//! folder. Guesses, corrections and ignored files are warnings; unusable files are one [`IntakeError`].

mod choose;
mod error;
mod include;
mod literal;
mod split;
mod stage;
mod text;

#[cfg(test)]
mod tests;

pub use error::IntakeError;
pub use stage::without_comments;
pub use text::StageText;

use choose::Candidate;
use gonio_glsl::Stage;
use gonio_language::tr;

/// A file as it was handed in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// Its name as the user gave it; may have folders.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl SourceFile {
    /// Creates a file.
    #[must_use]
    pub fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: bytes.into() }
    }
}

/// A pair of shaders ready for the compiler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The vertex stage.
    pub vertex: StageText,
    /// The fragment stage.
    pub fragment: StageText,
    /// The content of `names.toml`, if there was one.
    pub names: Option<String>,
    /// Guesses, corrections and ignored files, a sentence or two each.
    pub warnings: Vec<String>,
}

impl Submission {
    /// Finds the pair in these files. Among several pairs, the object's is preferred, then the last.
    ///
    /// # Errors
    /// Returns an [`IntakeError`] if there is no pair.
    pub fn gather(files: Vec<SourceFile>) -> Result<Self, IntakeError> {
        Self::gather_with(files, None, &[])
    }

    /// Finds the pair whose file or variable is called `wanted` (a part is enough; case and punctuation are ignored).
    ///
    /// # Errors
    /// Returns an [`IntakeError`] if there is no pair, or none with that name.
    pub fn gather_choosing(files: Vec<SourceFile>, requested: &str) -> Result<Self, IntakeError> {
        Self::gather_with(files, Some(requested), &[])
    }

    /// Finds the `wanted` pair; otherwise the one whose names contain one of `hints` (earlier hints take precedence,
    /// for example `["ex04", "phong", "diffuse"]`); otherwise as [`gather`](Self::gather).
    ///
    /// # Errors
    /// Returns an [`IntakeError`] if there is no pair, or none with the requested name.
    pub fn gather_with(files: Vec<SourceFile>, requested: Option<&str>, hints: &[&str]) -> Result<Self, IntakeError> {
        if files.is_empty() {
            return Err(IntakeError::NoFiles);
        }
        // If there are only two files, one that is not a shader was meant to be one.
        let mut intake = Intake { few: files.len() <= 2, ..Intake::default() };
        for file in &files {
            intake.take(file);
        }
        intake.finish(requested, hints, files.iter().map(|file| file.name.clone()).collect())
    }
}

/// The text of a file, with lines that end in `\n`; `None` if it is not text.
pub(crate) fn decoded(file: &SourceFile) -> Option<String> {
    text::decode(&file.name, &file.bytes).ok().map(|(text, _)| text)
}

/// The parts of a submission that a file contains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Holds {
    /// A vertex shader.
    pub vertex: bool,
    /// A fragment shader.
    pub fragment: bool,
    /// A `names.toml`.
    pub names: bool,
}

/// Returns the parts of a submission that a file contains. A shader of unknown stage counts as both.
///
/// # Errors
/// Returns an [`IntakeError`] if the file should be a shader and cannot be read.
pub fn holds(file: &SourceFile) -> Result<Holds, IntakeError> {
    if kind(&file.name) == FileKind::Perhaps && text::decode(&file.name, &file.bytes).is_err() {
        return Ok(Holds::default());
    }
    let mut intake = Intake { few: true, ..Intake::default() };
    intake.take(file);
    if let Some(error) = intake.errors.into_iter().next() {
        return Err(error);
    }
    let has = |stage| !intake.undecided.is_empty() || intake.candidates.iter().any(|found| found.stage == stage);
    Ok(Holds { vertex: has(Stage::Vertex), fragment: has(Stage::Fragment), names: intake.names.is_some() })
}

/// Reads a file that is one shader, whatever its name is. Also returns a warning if its encoding had to be corrected.
///
/// # Errors
/// Returns an [`IntakeError`] if it is not text.
pub fn read_shader(file: &SourceFile) -> Result<(StageText, Option<String>), IntakeError> {
    let (text, warning) = text::decode(&file.name, &file.bytes)?;
    Ok((StageText::whole(&file.name, text), warning))
}

/// The stage of a shader by its name and content, if they tell.
pub fn stage_of(name: &str, text: &str) -> Option<Stage> {
    stage::determine(name, name, &without_comments(text)).0
}

/// The shaders and messages found so far.
#[derive(Default)]
struct Intake {
    candidates: Vec<Candidate>,
    names: Option<String>,
    /// Files and their corrections; reported only for files that are used.
    corrected: Vec<(String, String)>,
    /// Shaders of unknown stage.
    undecided: Vec<(String, String)>,
    few: bool,
    /// The names and texts of files that a shader may include.
    texts: Vec<(String, String)>,
    left_aside: Vec<String>,
    /// Errors of files that should have been shaders; they matter only if no pair is found without them.
    errors: Vec<IntakeError>,
}

/// The use of a file by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum FileKind {
    Names,
    /// Ignored without a warning.
    Silent,
    /// Not a shader; ignored with a warning.
    Aside,
    Program(literal::Language),
    /// A shader by its extension.
    Shader,
    /// A shader if its content is one.
    Perhaps,
}

fn kind(name: &str) -> FileKind {
    let path = name.replace('\\', "/");
    let mut parts = path.split('/').rev();
    let base = parts.next().unwrap_or_default();
    let is_silent_folder = |part: &str| {
        matches!(
            part,
            "__MACOSX" | ".git" | ".svn" | ".vs" | ".vscode" | ".idea" | "node_modules" | "CMakeFiles" | "_deps"
        ) || part.starts_with("cmake-build")
    };
    if parts.clone().any(is_silent_folder) || base.starts_with("._") || matches!(base, ".DS_Store" | "Thumbs.db") {
        return FileKind::Silent;
    }
    if base.eq_ignore_ascii_case("names.toml") {
        return FileKind::Names;
    }
    let in_other_code = parts.any(|part| {
        matches!(part.to_lowercase().as_str(), "build" | "debug" | "release" | "3rdparty" | "external" | "glad" | "glm")
    });
    let lower = base.to_lowercase();
    if in_other_code || base.starts_with('.') || lower.starts_with("cmake") || lower.starts_with("readme") {
        return FileKind::Aside;
    }
    if let Some(language) = literal::language(base) {
        return FileKind::Program(language);
    }
    match lower.rsplit_once('.').map_or("", |(_, ending)| ending) {
        "md" | "rst" | "pdf" | "doc" | "docx" | "odt" | "png" | "jpg" | "jpeg" | "bmp" | "tga" | "gif" | "webp"
        | "hdr" | "exr" | "svg" | "psd" | "ppm" | "dds" | "ktx" | "obj" | "mtl" | "fbx" | "gltf" | "glb" | "ply"
        | "stl" | "mesh" | "dae" | "blend" | "zip" | "gz" | "rar" | "7z" | "exe" | "dll" | "so" | "lib" | "a" | "o"
        | "pdb" | "sln" | "vcxproj" | "filters" | "user" | "toml" | "json" | "yaml" | "yml" | "xml" | "ini"
        | "cmake" | "make" | "lock" | "log" | "csv" | "css" | "mp4" | "mov" | "wav" | "mp3" | "ttf" | "otf" | "bat"
        | "sh" | "geom" | "gs" | "tesc" | "tese" | "tcs" | "tes" | "comp" | "spv" | "ipynb" => FileKind::Aside,
        "vert" | "frag" | "vs" | "fs" | "vsh" | "fsh" | "vertexshader" | "fragmentshader" | "glsl" | "vp" | "fp" => {
            FileKind::Shader
        }
        _ if lower == "makefile" || lower == "license" => FileKind::Aside,
        _ => FileKind::Perhaps,
    }
}

impl Intake {
    fn take(&mut self, file: &SourceFile) {
        let name = &file.name;
        let kind = kind(name);
        match kind {
            FileKind::Silent => return,
            FileKind::Aside => return self.left_aside.push(name.clone()),
            FileKind::Names | FileKind::Program(_) | FileKind::Shader | FileKind::Perhaps => {}
        }
        let text = match text::decode(name, &file.bytes) {
            Ok((text, warning)) => {
                self.corrected.extend(warning.map(|warning| (name.clone(), warning)));
                text
            }
            Err(_) if kind == FileKind::Perhaps && !self.few => return self.left_aside.push(name.clone()),
            Err(error) => {
                self.errors.push(error);
                return;
            }
        };
        if matches!(kind, FileKind::Shader | FileKind::Perhaps) || kind == FileKind::Program(literal::Language::C) {
            self.texts.push((name.clone(), text.clone()));
        }
        let found_before = self.candidates.len() + self.undecided.len();
        match kind {
            FileKind::Names => return self.names = Some(text),
            FileKind::Program(language) => self.take_program(name, &text, language),
            _ => self.take_shader(name, text, kind == FileKind::Shader),
        }
        if self.candidates.len() + self.undecided.len() == found_before {
            self.left_aside.push(name.clone());
        }
    }

    fn take_program(&mut self, name: &str, text: &str, language: literal::Language) {
        let found = literal::shaders(text, language);
        if found.is_empty() {
            // A shader with the name of a program (`shader.h`, to be included unchanged, or `vertex.c`).
            let code = stage::without_comments(text);
            if code.contains("gl_Position") || code.contains("gl_FragColor") || code.contains("#version") {
                self.take_plain(name, text.to_owned(), &code, false);
            }
            return;
        }
        for literal in found {
            let code = stage::without_comments(&literal.text.text);
            let both = split::split(&literal.text.text, &code).is_some();
            let (stage, warning) =
                stage::determine(&format!("{name} `{}`", literal.variable), &literal.variable, &code);
            let hole = literal.has_holes.then(|| {
                tr!("check-submission-inserts-values-into-with-gonio-left", name = name, variable = literal.variable)
            });
            let Some(stage) = stage.filter(|_| !both) else { continue };
            self.candidates.push(Candidate {
                stage,
                text: literal.text.finish(name),
                variable: Some(literal.variable),
                warning: warning.or(hole),
            });
        }
    }

    fn take_shader(&mut self, name: &str, text: String, surely: bool) {
        let code = stage::without_comments(&text);
        // Strings of a program in a file named as a shader: `vertex.glsl` with `const char* vs = "..."` or
        // `R"(...)"`.
        if code.contains('"') {
            let before = self.candidates.len();
            let found = literal::shaders(&text, literal::Language::C);
            if !found.is_empty() {
                self.take_program(name, &text, literal::Language::C);
            }
            if self.candidates.len() > before {
                return;
            }
        }
        if let Some((vertex, fragment)) = split::split(&text, &code) {
            for (stage, builder) in [(Stage::Vertex, vertex), (Stage::Fragment, fragment)] {
                let text = builder.finish(name);
                self.candidates.push(Candidate { stage, text, variable: None, warning: None });
            }
            return;
        }
        self.take_plain(name, text, &code, surely);
    }

    /// Takes a file that is a single stage.
    fn take_plain(&mut self, name: &str, text: String, code: &str, surely: bool) {
        let (glsl, main) = stage::looks_like_glsl(code);
        let named = stage::hint_from_name(name) != stage::StageHint::Nothing;
        // Without a `main` it is a shader only if its name says so.
        if !(main && glsl || named && (surely || glsl)) {
            return;
        }
        match stage::determine(name, name, code) {
            (Some(stage), warning) => {
                let text = StageText::whole(name, text);
                self.candidates.push(Candidate { stage, text, variable: None, warning });
            }
            (None, _) => self.undecided.push((name.to_owned(), text)),
        }
    }

    /// Assigns a shader of unknown stage to the stage that its partner is not.
    fn assign_undecided_by_partner(&mut self) {
        let has = |stage| self.candidates.iter().any(|c| c.stage == stage);
        let missing = match (has(Stage::Vertex), has(Stage::Fragment)) {
            (true, false) => Some(Stage::Fragment),
            (false, true) => Some(Stage::Vertex),
            _ => None,
        };
        for (index, (name, text)) in std::mem::take(&mut self.undecided).into_iter().enumerate() {
            match missing {
                Some(stage) if index == 0 => {
                    let warning = Some(tr!(
                        "check-submission-neither-the-name-nor-the-content",
                        name = name,
                        stage = stage.to_string()
                    ));
                    let text = StageText::whole(name, text);
                    self.candidates.push(Candidate { stage, text, variable: None, warning });
                }
                _ => self.left_aside.push(name),
            }
        }
    }

    /// Among several shaders named as vertex shaders, one that outputs a colour and no position is the fragment
    /// shader: `vertex lighting.glsl`.
    fn assign_misnamed_by_content(&mut self) {
        if self.candidates.len() < 2 || self.candidates.iter().any(|found| found.stage == Stage::Fragment) {
            return;
        }
        let is_fragment = |found: &Candidate| {
            let evidence = stage::evidence(&stage::without_comments(&found.text.text));
            evidence.rather_fragment && !evidence.vertex
        };
        let misnamed: Vec<usize> = (0..self.candidates.len()).filter(|&at| is_fragment(&self.candidates[at])).collect();
        if let [at] = misnamed.as_slice() {
            let found = &mut self.candidates[*at];
            found.stage = Stage::Fragment;
            found.warning = Some(tr!("check-submission-is-named-like-a-vertex-shader", file = found.text.file));
        }
    }

    fn finish(
        mut self,
        requested: Option<&str>,
        hints: &[&str],
        files: Vec<String>,
    ) -> Result<Submission, IntakeError> {
        self.assign_undecided_by_partner();
        self.assign_misnamed_by_content();
        let chosen = match choose::choose(&self.candidates, requested, hints) {
            Ok(chosen) => chosen,
            // An unreadable file is the better explanation.
            Err(error) => {
                return Err(match (self.errors.into_iter().next(), error) {
                    (Some(unreadable), _) => unreadable,
                    (None, IntakeError::NoShader { .. }) => IntakeError::NoShader { files },
                    (None, error) => error,
                });
            }
        };
        let (vertex, fragment, chosen_because) = chosen;
        let is_taken =
            |name: &str| name == vertex.text.file || name == fragment.text.file || kind(name) == FileKind::Names;
        let (vertex_text, in_vertex) = include::insert(vertex.text.clone(), &self.texts)?;
        let (fragment_text, in_fragment) = include::insert(fragment.text.clone(), &self.texts)?;
        self.left_aside.retain(|name| !in_vertex.contains(name) && !in_fragment.contains(name));
        let mut warnings: Vec<String> =
            self.corrected.into_iter().filter(|(name, _)| is_taken(name)).map(|(_, warning)| warning).collect();
        warnings.extend(chosen_because);
        let ignored = tr!("check-submission-ignored");
        warnings.extend(self.errors.iter().map(|error| format!("{ignored}{error}")));
        if !self.left_aside.is_empty() {
            warnings.push(format!("{ignored}{}", error::list(&self.left_aside)));
        }
        Ok(Submission { vertex: vertex_text, fragment: fragment_text, names: self.names, warnings })
    }
}
