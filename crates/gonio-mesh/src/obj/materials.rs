//! Materials of an OBJ: finds and reads its libraries, and looks `usemtl` names up in them.

use crate::diagnostic::Reports;
use crate::text::quote;
use crate::{Diagnostic, Material, Severity, SidecarUse, Sidecars, mtl};
use std::collections::HashMap;

/// All materials of all libraries, and those used by faces.
#[derive(Default)]
pub(super) struct MaterialTable {
    materials: Vec<Material>,
    by_name: HashMap<String, usize>,
    /// The names looked up so far, including unknown ones.
    resolved: HashMap<String, Option<usize>>,
    /// Names that are in no library, with the line, in file order.
    unknown: Vec<(String, u64)>,
    /// Whether some face has no material from a library.
    needs_default: bool,
    has_libraries: bool,
    sidecars: Vec<SidecarUse>,
}

impl MaterialTable {
    /// Reads the libraries of the `mtllib` statements (line and rest of the line).
    pub(super) fn read(libraries: &[(u64, String)], sidecars: &mut dyn Sidecars, reports: &mut Reports) -> Self {
        let mut table = MaterialTable { has_libraries: !libraries.is_empty(), ..Self::default() };
        let mut seen: Vec<String> = Vec::new();
        for (line, names) in libraries {
            let (uses, found) = find(names, *line, sidecars, &mut seen, reports);
            table.sidecars.extend(uses);
            for (name, bytes) in found {
                let (mut materials, diagnostics) = mtl::read(&bytes);
                // Blender writes an empty library for a model without materials, so nothing is missing. A face that
                // refers to a material is still reported.
                let is_hollow = materials.is_empty() && !bytes.is_empty();
                for diagnostic in diagnostics {
                    if is_hollow && diagnostic.severity == Severity::Note {
                        continue;
                    }
                    reports.push(*line, diagnostic.in_file(&name));
                }
                materials.iter_mut().for_each(|material| material.file = Some(name.clone()));
                table.add(materials, &name, *line, reports);
            }
        }
        table
    }

    fn add(&mut self, materials: Vec<Material>, library: &str, line: u64, reports: &mut Reports) {
        for material in materials {
            if self.by_name.contains_key(&material.name) {
                let name = quote(material.name.as_bytes());
                let message = format!("the material {name} of {library} is also in an earlier library, which is used");
                reports.warning(line, message);
                continue;
            }
            self.by_name.insert(material.name.clone(), self.materials.len());
            self.materials.push(material);
        }
    }

    /// Returns the index of the material of a `usemtl` statement, in a list that begins with the default material.
    pub(super) fn index_of(&mut self, named: Option<(String, u64)>) -> usize {
        let found = named.and_then(|(name, line)| match self.resolved.get(&name) {
            Some(found) => *found,
            None => {
                let found = self.look_up(&name);
                if found.is_none() {
                    self.unknown.push((name.clone(), line));
                }
                self.resolved.insert(name, found);
                found
            }
        });
        self.needs_default |= found.is_none();
        found.map_or(0, |index| index + 1)
    }

    /// Looks up the whole name, or else the part before a `#`.
    fn look_up(&self, name: &str) -> Option<usize> {
        let whole = self.by_name.get(name);
        whole.or_else(|| self.by_name.get(name.split_once(" #")?.0.trim_end())).copied()
    }

    /// Reports materials that were not found: one by one if there are others, or else all at once.
    pub(super) fn report_unknown(&mut self, reports: &mut Reports) {
        let unknown = std::mem::take(&mut self.unknown);
        let is_lone = unknown.len() == 1;
        let reason = match (self.has_libraries, is_lone) {
            (true, true) => "is in none of the material libraries",
            (true, false) => "are in none of the material libraries",
            (false, true) => "is used, but there is no mtllib",
            (false, false) => "are used, but there is no mtllib",
        };
        if is_lone || !self.materials.is_empty() {
            let reason = if self.has_libraries { "is in none of the material libraries" } else { reason };
            for (name, line) in unknown {
                let name = quote(name.as_bytes());
                reports.add("materials not found", Severity::Warning, line, None, || {
                    format!("the material {name} {reason}: using the default material")
                });
            }
        } else if let Some((_, line)) = unknown.first() {
            const MOST_NAMED: usize = 3;
            let count = unknown.len();
            let names: Vec<String> = unknown.iter().take(MOST_NAMED).map(|(name, _)| quote(name.as_bytes())).collect();
            let more = if count > MOST_NAMED { format!(" and {} more", count - MOST_NAMED) } else { String::new() };
            let names = names.join(", ") + &more;
            reports.warning(*line, format!("{count} materials ({names}) {reason}: using the default material"));
        }
    }

    pub(super) fn take_sidecars(&mut self) -> Vec<SidecarUse> {
        std::mem::take(&mut self.sidecars)
    }

    /// Returns the materials, and the number to subtract from every index of [`Self::index_of`]: the default material
    /// is only included where it is needed.
    pub(super) fn finish(self) -> (Vec<Material>, usize) {
        if self.needs_default {
            let mut materials = vec![Material::default()];
            materials.extend(self.materials);
            (materials, 0)
        } else {
            (self.materials, 1)
        }
    }
}

/// Finds the files of an `mtllib` line, one name that may contain spaces, or several names. Returns all requests, and
/// path and bytes of the files that were found.
fn find(
    names: &str,
    line: u64,
    sidecars: &mut dyn Sidecars,
    seen: &mut Vec<String>,
    reports: &mut Reports,
) -> (Vec<SidecarUse>, Vec<(String, Vec<u8>)>) {
    let (mut uses, mut found) = (Vec::new(), Vec::new());
    let whole = unquote(names);
    let mut candidates = split(names);
    if candidates.len() > 1 {
        // `a b.mtl c.mtl` may be one file before it is two.
        let (sidecar, bytes) = SidecarUse::ask(sidecars, &whole, Some(line));
        if let Some(bytes) = bytes {
            if !seen.contains(&whole) {
                seen.push(whole.clone());
                found.push((sidecar.found.clone().unwrap_or(whole), bytes));
                uses.push(sidecar);
            }
            return (uses, found);
        }
        candidates.retain(|name| !name.is_empty());
    }
    for name in candidates {
        if seen.contains(&name) {
            continue;
        }
        seen.push(name.clone());
        let (sidecar, bytes) = SidecarUse::ask(sidecars, &name, Some(line));
        match bytes {
            Some(bytes) => found.push((sidecar.found.clone().unwrap_or(name), bytes)),
            None => {
                let reason = match (&sidecar.refused, sidecar.tried.as_slice()) {
                    (Some(refused), _) => format!("was not read: {refused}"),
                    (None, []) => "was not found".to_owned(),
                    (None, tried) => format!("was not found; tried {}", tried.join(", ")),
                };
                let message = format!("the material library {} {reason}", quote(name.as_bytes()));
                reports.push(line, Diagnostic::warning(message).at(line, None));
            }
        }
        uses.push(sidecar);
    }
    (uses, found)
}

/// Splits names at blanks after `.mtl`; if there is no such blank, at any blank that is not preceded by `\`.
fn split(names: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    let mut part = String::new();
    let ends_at_any_blank = !names.to_ascii_lowercase().contains(".mtl");
    for word in names.split_whitespace() {
        if !part.is_empty() {
            part.push(' ');
        }
        part.push_str(word);
        let is_escaped = part.ends_with('\\');
        let is_quoted = part.starts_with('"') && (part.len() == 1 || !part.ends_with('"'));
        let is_library = part.trim_end_matches('"').to_ascii_lowercase().ends_with(".mtl");
        if !is_escaped && !is_quoted && (is_library || ends_at_any_blank) {
            parts.push(unquote(&part));
            part.clear();
        }
    }
    if !part.is_empty() {
        parts.push(unquote(&part));
    }
    parts
}

/// Removes surrounding quotes, and `\` before blanks.
fn unquote(name: &str) -> String {
    let name = name.trim();
    let inner = name.strip_prefix('"').and_then(|n| n.strip_suffix('"')).unwrap_or(name);
    inner.replace("\\ ", " ")
}
