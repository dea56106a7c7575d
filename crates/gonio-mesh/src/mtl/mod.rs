//! Wavefront MTL, as the "MTL material format" (Alias|Wavefront, 1995) and the exporters define it.

mod draft;
mod map;

use crate::report::Reports;
use crate::text::{BadNumber, Cursor, quote};
use crate::{Diagnostic, Material, Severity};
use draft::Draft;

/// Reads a material library. Nothing in one is fatal: what cannot be understood is a warning.
///
/// What a material does not say is:
///
/// | statement | absent | with a map of its own |
/// |---|---|---|
/// | `Ka` | follows the diffuse colour; so does `Ka 1 1 1`, which Blender writes into every file | the same |
/// | `Kd` | 0.8 0.8 0.8 (a new material of Blender's) | 1 1 1 (Blender leaves `Kd` out beside `map_Kd`); so is `Kd 0 0 0` |
/// | `Ks`, `Ke` | 0 0 0 | 1 1 1; so is 0 0 0 |
/// | `Ns` | 32 | 1000, the largest that Blender writes |
/// | `Ni` | 1.5 | |
/// | `d`, `Tr` | 1, 0 | the same |
/// | `illum` | nothing; 0 and 1 switch `Ks` off | |
///
/// A file without any `newmtl` has no materials. Where a name comes twice, the last one counts, at the first one's
/// place.
pub fn read(bytes: &[u8]) -> (Vec<Material>, Vec<Diagnostic>) {
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

#[derive(Default)]
struct Reader {
    drafts: Vec<Draft>,
    reports: Reports,
    /// Statements before the first `newmtl` have no one to go to.
    has_homeless: bool,
    unused: Unused,
}

/// Statements that are understood and not used, to be told once.
#[derive(Default)]
struct Unused {
    keywords: Vec<String>,
    count: u64,
    first_line: u64,
}

impl Unused {
    fn add(&mut self, keyword: &[u8], line: u64) {
        let keyword = String::from_utf8_lossy(keyword);
        if self.count == 0 {
            self.first_line = line;
        }
        self.count += 1;
        // No more than a few spellings of each, whatever is in the file.
        if self.keywords.len() < UNUSED.len() && !self.keywords.iter().any(|known| *known == keyword) {
            self.keywords.push(keyword.into_owned());
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

/// Statements of the format, and of its physically based extension, that the light equation has no term for.
const UNUSED: [&[u8]; 26] = [
    b"map_Ka",
    b"map_Tr",
    b"map_Pr",
    b"map_Pm",
    b"map_Ps",
    b"map_Pc",
    b"map_Pcr",
    b"map_RMA",
    b"map_ORM",
    b"map_aniso",
    b"map_refl",
    b"map_aat",
    b"Tf",
    b"Kt",
    b"Km",
    b"Pr",
    b"Pm",
    b"Ps",
    b"Pc",
    b"Pcr",
    b"aniso",
    b"anisor",
    b"sharpness",
    b"refl",
    b"decal",
    b"disp",
];

impl Reader {
    fn statement(&mut self, cursor: &mut Cursor<'_>) {
        let (line, column) = (cursor.line(), cursor.column());
        let keyword = cursor.word();
        if keyword.eq_ignore_ascii_case(b"newmtl") {
            let name = cursor.name();
            if name.is_empty() {
                self.reports.warning(line, "newmtl has no name");
            }
            self.drafts.push(Draft::new(name, line));
            return;
        }
        let Some(draft) = self.drafts.last_mut() else {
            if !std::mem::replace(&mut self.has_homeless, true) {
                let what = quote(keyword);
                self.reports.warning(line, format!("{what} stands before the first newmtl and is ignored"));
            }
            return;
        };
        let reports = &mut self.reports;
        // Programs disagree about the case of letters, and no two statements differ only in it.
        match keyword.to_ascii_lowercase().as_slice() {
            b"ka" => draft.ambient = color(cursor, "Ka", reports).or(draft.ambient),
            b"kd" => draft.diffuse = color(cursor, "Kd", reports).or(draft.diffuse),
            b"ks" => draft.specular = color(cursor, "Ks", reports).or(draft.specular),
            b"ke" => draft.emitted = color(cursor, "Ke", reports).or(draft.emitted),
            b"ns" => draft.shininess = scalar(cursor, "Ns", reports).or(draft.shininess),
            b"ni" => draft.refraction_index = scalar(cursor, "Ni", reports).or(draft.refraction_index),
            b"d" => draft.read_opacity(cursor, reports),
            b"tr" => {
                draft.transparency = scalar(cursor, "Tr", reports).map(|value| (value, line)).or(draft.transparency)
            }
            b"illum" => draft.read_illumination_model(cursor, reports),
            b"map_kd" => map::read(&mut draft.diffuse_map, cursor, "map_Kd", reports),
            b"map_ks" => map::read(&mut draft.specular_map, cursor, "map_Ks", reports),
            b"map_ke" => map::read(&mut draft.emitted_map, cursor, "map_Ke", reports),
            b"map_ns" => map::read(&mut draft.shininess_map, cursor, "map_Ns", reports),
            b"map_d" | b"map_opacity" => map::read(&mut draft.opacity_map, cursor, "map_d", reports),
            b"map_bump" | b"bump" => map::read(&mut draft.bump_map, cursor, "map_Bump", reports),
            b"norm" | b"map_kn" | b"map_norm" => map::read(&mut draft.normal_map, cursor, "norm", reports),
            lower if UNUSED.iter().any(|unused| unused.eq_ignore_ascii_case(lower)) => {
                self.unused.add(keyword, line);
            }
            _ => reports.add("unknown statements", Severity::Warning, line, Some(column), || {
                format!("{} is no known statement of a material", quote(keyword))
            }),
        }
    }

    fn finish(mut self, bytes: &[u8]) -> (Vec<Material>, Vec<Diagnostic>) {
        if self.drafts.is_empty() && !self.has_homeless {
            // Blender writes such a library for a model without materials.
            let message = if bytes.is_empty() { "the material library is empty" } else { "holds no material (newmtl)" };
            self.reports.push(0, Diagnostic::note(message));
        }
        self.unused.report(&mut self.reports);
        let mut materials: Vec<Material> = Vec::new();
        let mut by_name = std::collections::HashMap::new();
        for draft in self.drafts {
            let line = draft.line;
            let material = draft.into_material(&mut self.reports);
            match by_name.get(&material.name) {
                Some(&(index, earlier)) => {
                    let name = quote(material.name.as_bytes());
                    let message = format!("the material {name} is already on line {earlier}: this one is taken");
                    self.reports.warning(line, message);
                    materials[index] = material;
                }
                None => {
                    by_name.insert(material.name.clone(), (materials.len(), line));
                    materials.push(material);
                }
            }
        }
        (materials, self.reports.finish())
    }
}

/// One number (grey) or three, as colours are written; `spectral` and `xyz` are not understood.
fn color(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) -> Option<[f32; 3]> {
    let first = scalar(cursor, keyword, reports)?;
    if !cursor.next_word() {
        return Some([first; 3]);
    }
    let second = scalar(cursor, keyword, reports)?;
    if !cursor.next_word() {
        let line = cursor.line();
        reports.add("colors with two numbers", Severity::Warning, line, None, || {
            format!("{keyword} has 2 numbers where a color has 1 or 3: it is ignored")
        });
        return None;
    }
    Some([first, second, scalar(cursor, keyword, reports)?])
}

/// A number that is finite and not negative.
fn scalar(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) -> Option<f32> {
    let (line, has_word) = (cursor.line(), cursor.next_word());
    let column = Some(cursor.column());
    let what = quote(cursor.offending_word());
    let problem = match cursor.number() {
        _ if !has_word => "ends before its number".to_owned(),
        Ok(value) if value >= 0.0 => return Some(value.abs()),
        Ok(_) => format!("is negative ({what})"),
        Err(BadNumber::NotFinite) => format!("has {what}, which is not finite"),
        Err(BadNumber::Unreadable) => format!("has {what} where a number should be"),
    };
    reports.add("numbers of materials that are no use", Severity::Warning, line, column, || {
        format!("{keyword} {problem}: it is ignored")
    });
    None
}
