//! Wavefront MTL, as the "MTL material format" (Alias|Wavefront, 1995), its physically based extension (Exocortex,
//! 2015) and the exporters define it.

mod draft;
mod map;
mod physical;
mod rules;
mod values;

use crate::diagnostic::Reports;
use crate::encoding::to_utf8;
use crate::text::{Cursor, quote};
use crate::{Diagnostic, Material, PropertySource, Severity};
use draft::Draft;
use map::UnsupportedOptions;
use rules::Rules;
use std::collections::HashMap;
use values::Place;

/// Reads a material library. It never fails: text that cannot be understood becomes a warning.
///
/// The defaults are:
///
/// | statement | absent | with a map of its own |
/// |---|---|---|
/// | `Ka` | follows the diffuse colour; so does `Ka 1 1 1`, which Blender always writes | the same if it is `map_Kd` |
/// | `Kd` | 0.8 0.8 0.8 (a new material of Blender's) | 1 1 1 (Blender leaves out `Kd` then); so is `Kd 0 0 0` |
/// | `Ks`, `Ke` | 0 0 0 | 1 1 1; so is 0 0 0 |
/// | `Ns` | 32 | 1000, the largest that Blender writes; so is 0 |
/// | `Ni` | 1.5 | |
/// | `d`, `Tr` | 1, 0 | the same; `d 0` beside `map_d` is 1. `map_Tr` is `map_d` inverted |
/// | `illum` | nothing; 0 and 1 switch the highlight off; what 3 to 10 ask for beyond 2 is noted | |
/// | `Pm` | 0 | 1; so is 0 |
/// | `Pr` | that of `Ns`, else 0.5 (a new material of Blender's) | 1; so is 0 |
///
/// A `map_Ka` with another image than `map_Kd` is not used.
///
/// Where `Pr`, `Pm` or one of their maps is written, they replace `Ks` and `Ns`: the material is
/// [`crate::MetallicRoughness`], with `Kd` as its base colour, and `Ks`, `map_Ks`, `Ns`, `map_Ns` go to
/// [`Material::unused`]. With these extensions Blender writes `Ks 0.5` for a reflectance of 0.04, and no `Ns`, but
/// itself renders `Pr` and `Pm`.
///
/// Colours are linear RGB as written; `xyz` is converted (values outside sRGB are clamped at 0), `spectral` is not
/// read.
///
/// Options of maps: `-s` and `-o` transform the texture coordinates, `-mm` and `-imfchan` are [`crate::TexelRule`],
/// `-clamp` is [`crate::Wrap`], `-bm` the strength of a bump or normal map; `-t`, `-boost`, `-blendu off`, `-cc on`,
/// `-texres`, `-type`, `-colorspace` other than the usual one and `-lod` are not supported, which is noted once each.
///
/// [`Material::sources`] has an entry for each value up to `opacity`, and for the others if they are in the file;
/// [`Material::unused`] has the statements that are understood but not used, in the order of their lines.
///
/// A file without `newmtl` has no materials; materials beyond 65,536 are ignored. If a name is defined twice, the last
/// definition is used, in the first one's place.
pub fn read(bytes: &[u8]) -> (Vec<Material>, Vec<Diagnostic>) {
    let text = to_utf8(bytes);
    let (materials, mut diagnostics) = read_utf8(&text.bytes);
    diagnostics.splice(..0, text.diagnostics);
    (materials, diagnostics)
}

fn read_utf8(bytes: &[u8]) -> (Vec<Material>, Vec<Diagnostic>) {
    let mut reader = Reader::default();
    let mut cursor = Cursor::new(bytes);
    while !cursor.at_end() {
        if cursor.next_word() {
            reader.statement(&mut cursor);
        }
        cursor.next_line();
    }
    reader.finish(bytes)
}

/// Most materials of a library, so that a file of empty ones cannot fill the memory.
const MOST_MATERIALS: usize = 1 << 16;

#[derive(Default)]
struct Reader {
    /// The material whose statements are read.
    draft: Option<Draft>,
    materials: Vec<Material>,
    /// The index of a name in `materials`, and its line.
    by_name: HashMap<String, (usize, u64)>,
    reports: Reports,
    unsupported: UnsupportedOptions,
    unused: Unused,
    has_reported_physical: bool,
    /// Whether a statement before the first `newmtl` was reported.
    has_homeless: bool,
}

impl Reader {
    fn statement(&mut self, cursor: &mut Cursor<'_>) {
        let (line, column) = (cursor.line(), cursor.column());
        let keyword = cursor.word();
        if keyword.eq_ignore_ascii_case(b"newmtl") {
            let name = cursor.name();
            if name.is_empty() {
                let column = Some(cursor.column());
                self.reports.add("materials without a name", Severity::Warning, line, column, || {
                    "newmtl has no name".to_owned()
                });
            }
            self.finish_material();
            self.draft = Some(Draft::new(name, line));
            return;
        }
        let Some(draft) = &mut self.draft else {
            if !std::mem::replace(&mut self.has_homeless, true) {
                let message = format!("{} before the first newmtl is ignored", quote(keyword));
                self.reports.push(line, Diagnostic::warning(message).at(line, Some(column)));
            }
            return;
        };
        let place = Place::of_statement(line, column, keyword, cursor);
        if !draft.statement(keyword, place, cursor, &mut self.unsupported, &mut self.reports) {
            self.reports.add("unknown statements", Severity::Warning, line, Some(column), || {
                format!("unknown material statement {}", quote(keyword))
            });
        }
    }

    /// Finishes the current material.
    fn finish_material(&mut self) {
        let Some(draft) = self.draft.take() else { return };
        let line = draft.line;
        let earlier = self.by_name.get(&draft.name).copied();
        if earlier.is_none() && self.materials.len() >= MOST_MATERIALS {
            self.reports.add("materials beyond the limit", Severity::Warning, line, None, || {
                format!("the library has more than {MOST_MATERIALS} materials: this one is ignored")
            });
            return;
        }
        self.unused.count(&draft.unused);
        let mut rules = Rules {
            name: rules::quoted_name(&draft),
            reports: &mut self.reports,
            sources: Vec::new(),
            unused: Vec::new(),
            has_reported_physical: &mut self.has_reported_physical,
        };
        let material = rules.material(draft);
        match earlier {
            Some((index, earlier)) => {
                let name = quote(material.name.as_bytes());
                self.reports.add("materials with a duplicate name", Severity::Warning, line, None, || {
                    format!("the material {name} is already defined on line {earlier}: using this one")
                });
                self.materials[index] = material;
            }
            None => {
                self.by_name.insert(material.name.clone(), (self.materials.len(), line));
                self.materials.push(material);
            }
        }
    }

    fn finish(mut self, bytes: &[u8]) -> (Vec<Material>, Vec<Diagnostic>) {
        self.finish_material();
        if self.materials.is_empty() && !self.has_homeless {
            // Blender writes such a library for a model without materials.
            let message =
                if bytes.is_empty() { "the material library is empty" } else { "contains no material (newmtl)" };
            self.reports.push(0, Diagnostic::note(message));
        }
        self.unsupported.report(&mut self.reports);
        self.unused.report(&mut self.reports);
        (self.materials, self.reports.finish())
    }
}

/// Statements that are understood but not used, to be reported once.
#[derive(Default)]
struct Unused {
    keywords: Vec<&'static str>,
    count: u64,
    first_line: u64,
}

impl Unused {
    /// Counts the statements of a material that would change its appearance.
    fn count(&mut self, sources: &[PropertySource]) {
        let has_coat = sources.iter().any(|source| source.property == "Pc" && !is_idle(source));
        for source in sources {
            // Blender writes `Pcr 0.03` without a coat; refl has a report of its own.
            let is_of_no_coat = source.property == "Pcr" && !has_coat;
            if source.property == "refl" || is_of_no_coat || is_idle(source) {
                continue;
            }
            if self.count == 0 {
                self.first_line = source.line.unwrap_or(0);
            }
            self.count += 1;
            if !self.keywords.contains(&source.property) {
                self.keywords.push(source.property);
            }
        }
    }

    fn report(&self, reports: &mut Reports) {
        if self.count > 0 {
            let (statements, keywords) = (if self.count == 1 { "statement" } else { "statements" }, &self.keywords);
            let keywords = keywords.join(", ");
            let message = format!("{} {statements} without a term in the light equation: {keywords}", self.count);
            reports.note(self.first_line, message);
        }
    }
}

/// Whether a statement sets the neutral value: no sheen, no coat, a filter that transmits everything.
fn is_idle(source: &PropertySource) -> bool {
    let neutral = if source.property == "Tf" { 1.0 } else { 0.0 };
    let mut numbers = source.written.split_whitespace().skip(1).map(|word| word.parse::<f32>());
    let has_numbers = source.written.split_whitespace().count() > 1;
    has_numbers && numbers.all(|number| number == Ok(neutral))
}
