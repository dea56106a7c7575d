//! `mistakes.toml` in the folder of an exercise that is judged by its own reference: the mistakes that a teacher expects.
//!
//! ```toml
//! [[mistake]]
//! id = "rim-not-inverted"
//! name = "The rim is bright in the middle"
//! looks_like = "The object glows where it faces the camera."
//! fix = "Subtract the cosine from 1."
//! lecture_section = "Rim light"
//! change = [{ file = "reference.frag", find = "1.0 - facing", write = "facing" }]
//!
//! [mistake.fr]
//! name = "Le liseré est clair au milieu"
//! ```

use super::REFERENCE_FILES;
use gonio_check::picture_judge::{OwnMistakeTexts, WrittenMark};
use gonio_language::Language;
use gonio_scene::toml_table::{Fault, TableReader, parse_toml};

/// Most mistakes of an exercise: each is drawn at every check.
const MOST_MISTAKES: usize = 200;

/// A change of a reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReferenceChange {
    /// The index in [`REFERENCE_FILES`].
    pub file: usize,
    /// The text to replace, which occurs once.
    pub find: String,
    /// The text to write instead.
    pub write: String,
}

/// A mistake that a teacher expects.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MistakeDefinition {
    /// Its id in kebab-case.
    pub id: String,
    /// The section of the lecture that teaches it.
    pub lecture_section: String,
    /// Its texts by language; at least one.
    pub texts: Vec<(Language, OwnMistakeTexts)>,
    /// The changes that make it; none where the reference is only there as pictures.
    pub change: Vec<ReferenceChange>,
    /// The wrong expressions, by which its line is found.
    pub written: Vec<WrittenMark>,
}

impl MistakeDefinition {
    /// The reference with this mistake.
    #[must_use]
    pub fn applied(&self, reference: &[String; 2]) -> [String; 2] {
        let mut texts = reference.clone();
        for change in &self.change {
            if let Some(text) = texts.get_mut(change.file) {
                *text = text.replacen(&change.find, &change.write, 1);
            }
        }
        texts
    }
}

/// Reads the file. With a `reference`, every change has to apply to it; without one, there are none.
pub(super) fn read(
    text: &str,
    languages: &[Language],
    reference: Option<&[String; 2]>,
) -> Result<Vec<MistakeDefinition>, Fault> {
    let root = parse_toml(text)?;
    let mut t = TableReader::new("a list of mistakes", &root)?;
    let mut all: Vec<MistakeDefinition> = Vec::new();
    for mut table in t.tables("mistake")? {
        let mistake = read_mistake(&mut table, languages, reference)?;
        if all.iter().any(|known| known.id == mistake.id) {
            return Err(Fault::at(&table.place("id"), format!("there are two mistakes `{}`", mistake.id)));
        }
        if all.len() == MOST_MISTAKES {
            return Err(Fault::at(&table.span, format!("an exercise has at most {MOST_MISTAKES} mistakes of its own")));
        }
        all.push(mistake);
    }
    t.finish()?;
    Ok(all)
}

fn read_mistake(
    t: &mut TableReader<'_>,
    languages: &[Language],
    reference: Option<&[String; 2]>,
) -> Result<MistakeDefinition, Fault> {
    let id = t.text("id")?.ok_or_else(|| Fault::at(&t.span, "[[mistake]] has no `id`"))?;
    if !is_kebab_case(&id) {
        let message = format!("`id`: `{id}` is not in kebab-case: small letters, digits and single hyphens");
        return Err(Fault::at(&t.place("id"), message));
    }
    let first = read_texts(t)?;
    if first.name.is_empty() {
        return Err(Fault::at(&t.span, format!("the mistake `{id}` has no `name`")));
    }
    let lecture_section = t.text("lecture_section")?.unwrap_or_default();
    let mut texts = vec![(languages.first().copied().unwrap_or(Language::English), first)];
    for language in languages.iter().skip(1) {
        let code = language.code();
        let table = t.table(code, &format!("[mistake.{code}]"))?;
        let mut table =
            table.ok_or_else(|| Fault::at(&t.span, format!("the mistake `{id}` has no texts in [mistake.{code}]")))?;
        let translated = read_texts(&mut table)?;
        table.finish()?;
        texts.push((*language, translated));
    }
    let mut change = Vec::new();
    for mut table in t.tables("change")? {
        change.push(read_change(&mut table, reference)?);
    }
    let place = t.place("written");
    let written = t.texts("written")?.map(|marks| marks.iter().map(|mark| read_mark(mark)).collect::<Option<Vec<_>>>());
    if written == Some(None) {
        let message = "`written`: expected marks that `gonio course package` wrote; without this key, they are made from `change`";
        return Err(Fault::at(&place, message));
    }
    t.finish()?;
    if reference.is_some() && change.is_empty() {
        return Err(Fault::at(&t.span, format!("the mistake `{id}` has no `change` of the reference")));
    }
    let of_changes = || change.iter().filter_map(|change| mark_of(change, reference)).collect();
    let written = written.flatten().unwrap_or_else(of_changes);
    Ok(MistakeDefinition { id, lecture_section, texts, change, written })
}

/// The mark of a change: the text that it writes, or the whole lines if the reference has that text elsewhere too.
fn mark_of(change: &ReferenceChange, reference: Option<&[String; 2]>) -> Option<WrittenMark> {
    let own = WrittenMark::new(&change.write)?;
    let Some(reference) = reference else { return Some(own) };
    let is_elsewhere = |text: &String| text.lines().any(|line| own.is_in(line));
    let text = &reference[change.file];
    if !reference.iter().any(is_elsewhere) {
        return Some(own);
    }
    let at = text.find(&change.find)?;
    let first = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let after = at + change.find.len();
    let last = text[after..].find('\n').map_or(text.len(), |length| after + length);
    let lines = format!("{}{}{}", &text[first..at], change.write, &text[after..last]);
    let code: String = gonio_check::submission::without_comments(&lines);
    WrittenMark::new(&code)
}

/// `LENGTH:HASH` in decimal and hexadecimal digits.
fn read_mark(text: &str) -> Option<WrittenMark> {
    let (length, hash) = text.split_once(':')?;
    Some(WrittenMark { length: length.parse().ok()?, hash: u64::from_str_radix(hash, 16).ok()? })
}

/// A mark as [`read_mark`] reads it.
pub(crate) fn written_mark(mark: &WrittenMark) -> String {
    format!("{}:{:016x}", mark.length, mark.hash)
}

fn read_texts(t: &mut TableReader<'_>) -> Result<OwnMistakeTexts, Fault> {
    let mut text = |key: &'static str| t.text(key).map(Option::unwrap_or_default);
    Ok(OwnMistakeTexts { name: text("name")?, looks_like: text("looks_like")?, fix: text("fix")? })
}

fn read_change(t: &mut TableReader<'_>, reference: Option<&[String; 2]>) -> Result<ReferenceChange, Fault> {
    let file = t.choice("file", &REFERENCE_FILES)?;
    let file = file.ok_or_else(|| Fault::at(&t.span, "a change has no `file`: reference.vert or reference.frag"))?;
    let find = t.text("find")?.filter(|find| !find.is_empty());
    let find = find.ok_or_else(|| Fault::at(&t.span, "a change has no `find`, the text to replace"))?;
    let write =
        t.text("write")?.ok_or_else(|| Fault::at(&t.span, "a change has no `write`, the text to write instead"))?;
    t.finish()?;
    let text = reference.map(|reference| &reference[file]);
    match text.map(|text| text.matches(find.as_str()).count()) {
        None | Some(1) => Ok(ReferenceChange { file, find, write }),
        Some(count) => {
            let message =
                format!("`find`: `{find}` occurs {count} times in {}; it has to occur once", REFERENCE_FILES[file]);
            Err(Fault::at(&t.place("find"), message))
        }
    }
}

/// Whether a word has small letters, digits and single hyphens alone.
pub(super) fn is_kebab_case(word: &str) -> bool {
    let part = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit());
    word.split('-').all(part)
}
