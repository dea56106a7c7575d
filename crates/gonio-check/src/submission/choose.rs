//! Chooses the pair among several shaders.

use super::error::{IntakeError, list};
use super::stage::stage_of_word;
use super::text::StageText;
use crate::words::words_of;
use gonio_glsl::Stage;
use gonio_language::tr;

/// A shader that was found.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) stage: Stage,
    pub(super) text: StageText,
    /// The variable of the program that holds it.
    pub(super) variable: Option<String>,
    /// A warning that is reported only if it is chosen.
    pub(super) warning: Option<String>,
}

impl Candidate {
    /// Returns its name for messages: the file, or file and variable.
    fn shown(&self) -> String {
        match &self.variable {
            Some(variable) if !variable.is_empty() => format!("{} `{variable}`", self.text.file),
            Some(_) => tr!("check-submission-line", file = self.text.file, line = self.text.place(1, 1).1),
            None => self.text.file.clone(),
        }
    }

    /// Returns the words of its name except those of stages and filler words; two shaders with the same words belong
    /// together.
    fn stem(&self) -> Vec<String> {
        let base = self.text.file.rsplit(['/', '\\']).next().unwrap_or_default();
        let name = match &self.variable {
            Some(variable) => variable,
            None => base.split_once('.').map_or(base, |(stem, _)| stem),
        };
        let mut words = words_of(name);
        words.retain(|word| {
            stage_of_word(word).is_none()
                && !matches!(
                    word.as_str(),
                    "v" | "f"
                        | "shader"
                        | "shaders"
                        | "source"
                        | "src"
                        | "code"
                        | "text"
                        | "str"
                        | "string"
                        | "glsl"
                        | "k"
                        | "g"
                        | "m"
                        | "id"
                        | "type"
                        | "x"
                        | "program"
                        | "data"
                )
        });
        for word in &mut words {
            for filling in ["vertexshader", "fragmentshader", "vertex", "fragment", "vert", "frag", "shader"] {
                if word.len() > filling.len() {
                    *word = word.replace(filling, "");
                }
            }
        }
        words
    }

    /// Returns the folder, without folders that only name the stage.
    fn folder(&self) -> String {
        let file = self.text.file.replace('\\', "/");
        let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
        folder.split('/').filter(|part| stage_of_word(&part.to_lowercase()).is_none()).collect::<Vec<_>>().join("/")
    }

    /// Returns the text in which a requested name is searched, in lower case and without punctuation.
    fn searched(&self) -> String {
        plain(&format!("{} {}", self.text.file, self.variable.as_deref().unwrap_or_default()))
    }
}

fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The properties of a candidate that the score uses, computed once.
struct Measured<'a> {
    candidate: &'a Candidate,
    order: usize,
    /// Number of shaders of the same stage before it.
    rank: usize,
    stem: Vec<String>,
    folder: String,
    requested: bool,
    hint: usize,
    /// Prefers the object to its surroundings.
    liking: i32,
}

impl<'a> Measured<'a> {
    fn new(order: usize, candidate: &'a Candidate, requested: Option<&str>, hints: &[&str]) -> Self {
        let searched = candidate.searched();
        let hint = hints
            .iter()
            .position(|hint| !plain(hint).is_empty() && searched.contains(&plain(hint)))
            .map_or(0, |at| hints.len() - at);
        let name = candidate
            .variable
            .clone()
            .unwrap_or_else(|| candidate.text.file.rsplit(['/', '\\']).next().unwrap_or_default().to_owned());
        let name = plain(&name);
        let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let liking = i32::from(has(&["obj", "model", "mesh", "phong", "light", "main", "sphere"]))
            - 2 * i32::from(has(&[
                "sky",
                "cubemap",
                "lamp",
                "lightcube",
                "lightsource",
                "lightbox",
                "screen",
                "quad",
                "text",
                "outline",
                "depth",
                "shadow",
                "debug",
                "axis",
                "grid",
                "post",
                "old",
                "backup",
                "copy",
                "test",
                "panorama",
            ]));
        Self {
            candidate,
            order,
            rank: 0,
            stem: candidate.stem(),
            folder: candidate.folder(),
            requested: requested
                .is_some_and(|requested| !plain(requested).is_empty() && searched.contains(&plain(requested))),
            hint,
            liking,
        }
    }
}

/// The score of a pair: how well the two belong together and match the request. The greatest wins, the last among
/// equals.
type Score = (usize, usize, bool, bool, bool, i32, usize, bool, usize);

fn score(vertex: &Measured<'_>, fragment: &Measured<'_>) -> Score {
    let prefix = vertex.stem.iter().zip(&fragment.stem).take_while(|(a, b)| a == b).count();
    (
        usize::from(vertex.requested) + usize::from(fragment.requested),
        vertex.hint + fragment.hint,
        vertex.folder == fragment.folder && vertex.stem == fragment.stem,
        vertex.candidate.variable.is_none() && fragment.candidate.variable.is_none(),
        vertex.candidate.text.file == fragment.candidate.text.file,
        vertex.liking + fragment.liking + i32::from(vertex.folder == fragment.folder),
        prefix,
        // Among pairs without names, the last complete one: the second vertex shader belongs to the second fragment
        // shader.
        vertex.rank == fragment.rank,
        vertex.order.min(fragment.order),
    )
}

/// Most shaders of a stage; only the last ones are considered, because the number of pairs grows with the square.
const MOST: usize = 300;

/// Chooses the pair. Returns vertex shader, fragment shader and warnings.
pub(super) fn choose(
    candidates: &[Candidate],
    requested: Option<&str>,
    hints: &[&str],
) -> Result<(Candidate, Candidate, Vec<String>), IntakeError> {
    let of = |stage: Stage| -> Vec<Measured<'_>> {
        let all = candidates.iter().enumerate().filter(|(_, c)| c.stage == stage).enumerate();
        let all: Vec<_> = all.collect();
        let last = all.get(all.len().saturating_sub(MOST)..).unwrap_or_default();
        let measured = |&(rank, (order, candidate)): &(usize, (usize, _))| Measured {
            rank,
            ..Measured::new(order, candidate, requested, hints)
        };
        last.iter().map(measured).collect()
    };
    let (vertices, fragments) = (of(Stage::Vertex), of(Stage::Fragment));
    for (these, others, stage) in [(&vertices, &fragments, Stage::Vertex), (&fragments, &vertices, Stage::Fragment)] {
        if others.is_empty() && !these.is_empty() {
            let found: Vec<String> = these.iter().map(|m| m.candidate.shown()).collect();
            return Err(if found.len() == 1 {
                IntakeError::MissingStage { missing: stage.other(), found }
            } else {
                IntakeError::SameStageTwice { stage, found }
            });
        }
    }
    if let Some(requested) = requested
        && !vertices.iter().chain(&fragments).any(|m| m.requested)
    {
        let candidates = candidates.iter().map(Candidate::shown).collect();
        return Err(IntakeError::NotFound { requested: requested.to_owned(), candidates });
    }
    let pairs = vertices.iter().flat_map(|v| fragments.iter().map(move |f| (score(v, f), v, f)));
    let Some((_, vertex, fragment)) = pairs.max_by_key(|&(score, _, _)| score) else {
        return Err(IntakeError::NoShader { files: Vec::new() });
    };
    let (vertex, fragment) = (vertex.candidate, fragment.candidate);
    let mut warnings: Vec<String> =
        [vertex, fragment].into_iter().filter_map(|candidate| candidate.warning.clone()).collect();
    warnings.dedup();
    if candidates.len() > 2 {
        let all: Vec<String> = candidates.iter().map(|c| format!("{} ({})", c.shown(), c.stage)).collect();
        warnings.push(tr!(
            "check-submission-there-are-several-shaders-and-were",
            all = list(&all),
            vertex = vertex.shown(),
            fragment = fragment.shown()
        ));
    }
    Ok((vertex.clone(), fragment.clone(), warnings))
}
