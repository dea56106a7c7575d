//! Materials of an OBJ: its libraries are found and read, and `usemtl` is looked up in them.

use crate::report::Reports;
use crate::text::quote;
use crate::{Diagnostic, Material, Sidecars, mtl};
use std::collections::HashMap;

/// All materials of all libraries, and those that faces use.
#[derive(Default)]
pub(super) struct MaterialTable {
    materials: Vec<Material>,
    by_name: HashMap<String, usize>,
    /// What names stood for, unknown ones included.
    resolved: HashMap<String, Option<usize>>,
    /// Whether some face has no material of any library.
    needs_default: bool,
    has_libraries: bool,
}

impl MaterialTable {
    /// Reads the libraries that `mtllib` statements (line and rest of the line) name.
    pub(super) fn read(libraries: &[(u64, String)], sidecars: &mut dyn Sidecars, reports: &mut Reports) -> Self {
        let mut table = MaterialTable { has_libraries: !libraries.is_empty(), ..Self::default() };
        let mut seen: Vec<String> = Vec::new();
        for (line, names) in libraries {
            for (name, bytes) in find(names, *line, sidecars, &mut seen, reports) {
                let (materials, diagnostics) = mtl::read(&bytes);
                // Blender writes a library without materials for a model without: nothing is missing there. Where a
                // face names a material all the same, that is said.
                let is_hollow = materials.is_empty() && !bytes.is_empty();
                for diagnostic in diagnostics {
                    if is_hollow && diagnostic.severity == crate::Severity::Note {
                        continue;
                    }
                    reports.push(*line, diagnostic.in_file(&name));
                }
                table.add(materials, &name, *line, reports);
            }
        }
        table
    }

    fn add(&mut self, materials: Vec<Material>, library: &str, line: u64, reports: &mut Reports) {
        for material in materials {
            if self.by_name.contains_key(&material.name) {
                let name = quote(material.name.as_bytes());
                let message = format!("the material {name} of {library} is also in an earlier library, which is taken");
                reports.warning(line, message);
                continue;
            }
            self.by_name.insert(material.name.clone(), self.materials.len());
            self.materials.push(material);
        }
    }

    /// The index, in a list that begins with the default material, of what `usemtl` named at a line.
    pub(super) fn index_of(&mut self, named: Option<&(String, u64)>, reports: &mut Reports) -> usize {
        let found = named.and_then(|(name, line)| match self.resolved.get(name) {
            Some(found) => *found,
            None => {
                let found = self.look_up(name);
                if found.is_none() {
                    self.report_unknown(name, *line, reports);
                }
                self.resolved.insert(name.clone(), found);
                found
            }
        });
        self.needs_default |= found.is_none();
        found.map_or(0, |index| index + 1)
    }

    /// By the whole name, or by what stands before a `#`.
    fn look_up(&self, name: &str) -> Option<usize> {
        let whole = self.by_name.get(name);
        whole.or_else(|| self.by_name.get(name.split_once(" #")?.0.trim_end())).copied()
    }

    fn report_unknown(&self, name: &str, line: u64, reports: &mut Reports) {
        let name = quote(name.as_bytes());
        let has_libraries = self.has_libraries;
        reports.add("materials not found", crate::Severity::Warning, line, None, || {
            let why = if has_libraries { "is in none of the material libraries" } else { "is named, but no mtllib" };
            format!("the material {name} {why}: the default material is taken")
        });
    }

    /// The materials, and how much smaller every index of [`Self::index_of`] is in them: the default material is
    /// only there where it is needed.
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

/// The files behind the rest of an `mtllib` line: one name, perhaps with spaces, or several names.
fn find(
    names: &str,
    line: u64,
    sidecars: &mut dyn Sidecars,
    seen: &mut Vec<String>,
    reports: &mut Reports,
) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    let whole = unquote(names);
    let parts = split(names);
    let mut candidates = parts;
    if candidates.len() > 1 {
        match sidecars.read(&whole) {
            Ok(bytes) => {
                if !seen.contains(&whole) {
                    seen.push(whole.clone());
                    found.push((whole, bytes));
                }
                return found;
            }
            Err(_) => candidates.retain(|name| !name.is_empty()),
        }
    }
    for name in candidates {
        if seen.contains(&name) {
            continue;
        }
        seen.push(name.clone());
        match sidecars.read(&name) {
            Ok(bytes) => found.push((name, bytes)),
            Err(missing) => {
                let places = match missing.tried.as_slice() {
                    [] => String::new(),
                    tried => format!("; looked for at {}", tried.join(", ")),
                };
                let message = format!("the material library {} was not found{places}", quote(name.as_bytes()));
                reports.push(line, Diagnostic::warning(message).at(line, None));
            }
        }
    }
    found
}

/// Names end at blanks after `.mtl`; where there is no such end, at any blank that no `\` precedes.
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

/// Without quotes around it and without `\` before blanks.
fn unquote(name: &str) -> String {
    let name = name.trim();
    let inner = name.strip_prefix('"').and_then(|n| n.strip_suffix('"')).unwrap_or(name);
    inner.replace("\\ ", " ")
}
