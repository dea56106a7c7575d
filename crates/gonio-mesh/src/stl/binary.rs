//! Binary STL: an arbitrary header of 80 bytes, the number of facets, 50 bytes for each: normal, three corners, two
//! more bytes.

use super::Facets;
use crate::diagnostic::{Reports, Tally};
use crate::{Diagnostic, Limits, Material, PropertySource, ReadError, Severity};
use gonio_light::color::srgb_decode;

const HEADER: usize = 80;
const FACETS_AT: usize = 84;
const FACET: usize = 50;

/// Returns the number of facets that the file declares, in one of the byte orders.
fn declared_count(bytes: &[u8], is_big_endian: bool) -> Option<u64> {
    let count = bytes.get(HEADER..)?.first_chunk().copied()?;
    Some(u64::from(if is_big_endian { u32::from_be_bytes(count) } else { u32::from_le_bytes(count) }))
}

fn size_of(count: u64) -> u64 {
    FACETS_AT as u64 + FACET as u64 * count
}

/// Whether the file has exactly the declared size, in either byte order.
pub(super) fn has_exact_size(bytes: &[u8]) -> bool {
    [false, true]
        .iter()
        .any(|&order| declared_count(bytes, order).is_some_and(|count| size_of(count) == bytes.len() as u64))
}

pub(super) fn read(bytes: &[u8], limits: &Limits, reports: &mut Reports) -> Result<Facets, ReadError> {
    let Some(count) = declared_count(bytes, false) else {
        let message = format!("this is not an STL file: it does not begin with `solid`, and {} bytes", bytes.len());
        return Err(ReadError::new(message + " are too few for a binary one (84 at least)"));
    };
    let (count, is_big_endian) = count_and_order(bytes, count, reports)?;
    if count > limits.max_triangles {
        let most = limits.max_triangles;
        return Err(ReadError::new(format!("contains {count} facets, more than {most}, which is the limit")));
    }
    let records = bytes[FACETS_AT..].chunks_exact(FACET).take(count as usize);
    let mut facets = Facets::default();
    facets.corners.reserve_exact(3 * records.len());
    facets.normals.reserve_exact(records.len());
    let mut attributes = Vec::with_capacity(records.len());
    for (index, record) in records.enumerate() {
        let number = |at: usize| {
            let bytes = record.get(at..).and_then(|b| b.first_chunk().copied()).unwrap_or_default();
            if is_big_endian { f32::from_be_bytes(bytes) } else { f32::from_le_bytes(bytes) }
        };
        let vector = |at: usize| [number(at), number(at + 4), number(at + 8)];
        let corners = [vector(12), vector(24), vector(36)];
        if facets.add(vector(0), corners, None, || format!("facet {index}")) {
            attributes.push(if is_big_endian {
                u16::from_be_bytes([record[48], record[49]])
            } else {
                u16::from_le_bytes([record[48], record[49]])
            });
        }
    }
    facets.contents = vec![("facet".to_owned(), count)];
    facets.solids.push((String::new(), 0));
    color(&mut facets, &bytes[..HEADER], &attributes, reports);
    Ok(facets)
}

/// Decides on the number of facets and the byte order.
fn count_and_order(bytes: &[u8], declared: u64, reports: &mut Reports) -> Result<(u64, bool), ReadError> {
    let size = bytes.len() as u64;
    let there = (size - FACETS_AT as u64) / FACET as u64;
    let mut warn = |message: String| reports.push(0, Diagnostic::warning(message));
    if size == size_of(declared) {
        return Ok((declared, false));
    }
    if let Some(count) = declared_count(bytes, true).filter(|&count| size == size_of(count)) {
        warn("the numbers are big-endian, contrary to the specification: read as such".to_owned());
        return Ok((count, true));
    }
    if declared == 0 && there > 0 && size == size_of(there) {
        warn(format!("the file declares no facets but contains {there}: they are read"));
        return Ok((there, false));
    }
    if size < size_of(declared) {
        let message = format!("the file declares {declared} facets but contains only {there}: it is cut off");
        return Err(ReadError::new(message + " (or not an STL file), get it again"));
    }
    let more = size - size_of(declared);
    warn(format!("{more} bytes after the last facet (from byte {}) are ignored", size_of(declared)));
    Ok((declared, false))
}

/// Assigns the file's colours to the facets, or to the material.
fn color(facets: &mut Facets, header: &[u8], attributes: &[u16], reports: &mut Reports) {
    const KEY: &[u8] = b"COLOR=";
    let header_color = header.windows(KEY.len() + 4).find_map(|bytes| bytes.strip_prefix(KEY));
    match header_color {
        Some(rgba) => color_by_magics(facets, rgba, attributes, reports),
        None => color_by_viscam(facets, attributes, reports),
    }
}

/// Returns the linear values of three channels of five bits, starting with the lowest.
fn channels(attribute: u16) -> [f32; 3] {
    [0, 5, 10].map(|shift| srgb_decode(f64::from((attribute >> shift) & 31) / 31.0) as f32)
}

fn color_by_viscam(facets: &mut Facets, attributes: &[u16], reports: &mut Reports) {
    let has_color = |attribute: u16| attribute & 0x8000 != 0;
    if attributes.iter().copied().any(has_color) {
        facets.colors.extend(attributes.iter().map(|&attribute| {
            let [b, g, r] = channels(attribute);
            if has_color(attribute) { [r, g, b, 1.0] } else { [1.0; 4] }
        }));
        facets.material = white_material("white beside the colors of facets");
        let colored = attributes.iter().filter(|a| has_color(**a)).count() as u64;
        facets.contents.push(("facet with a color".to_owned(), colored));
    }
    let mut anomalies = Tally::default();
    for (index, _) in attributes.iter().enumerate().filter(|(_, a)| **a != 0 && !has_color(**a)) {
        anomalies.add(None, || format!("facet {index}"));
    }
    anomalies.report(Severity::Note, reports, |tally| {
        let facets = tally.counted("facet has", "facets have");
        format!("{facets} attribute bytes that are not a color (the first is {}): ignored", tally.first)
    });
}

fn color_by_magics(facets: &mut Facets, rgba: &[u8], attributes: &[u16], reports: &mut Reports) {
    let written = format!("COLOR={rgba:?}");
    let [r, g, b, a] = [0, 1, 2, 3].map(|i| f64::from(rgba.get(i).copied().unwrap_or(255)) / 255.0);
    let of_header = [r, g, b].map(|c| srgb_decode(c) as f32);
    let mut opacity = a as f32;
    if opacity == 0.0 {
        reports.push(0, Diagnostic::note("the color of the header is invisible (its alpha is 0): treated as opaque"));
        opacity = 1.0;
    }
    let source =
        |property, rule: &str| PropertySource { property, line: None, written: written.clone(), rule: rule.to_owned() };
    // In this dialect no facet is black: programs without colours write 0.
    let has_color = |attribute: u16| attribute & 0x8000 == 0;
    let is_colored = attributes.iter().any(|&attribute| has_color(attribute) && attribute != 0);
    if !is_colored {
        facets.material = Material { diffuse: of_header, opacity, ..Material::default() };
        facets.material.sources = vec![source("diffuse", ""), source("opacity", "")];
        return;
    }
    let [r, g, b] = of_header;
    facets.colors.extend(attributes.iter().map(|&attribute| {
        let [own_r, own_g, own_b] = channels(attribute);
        if has_color(attribute) { [own_r, own_g, own_b, 1.0] } else { [r, g, b, 1.0] }
    }));
    facets.material = Material { opacity, ..white_material("white beside the colors of facets") };
    facets.material.sources.push(source("opacity", ""));
    let colored = attributes.iter().filter(|a| has_color(**a)).count() as u64;
    facets.contents.push(("facet with a color".to_owned(), colored));
}

fn white_material(rule: &str) -> Material {
    let source = PropertySource { property: "diffuse", line: None, written: String::new(), rule: rule.to_owned() };
    Material { diffuse: [1.0; 3], sources: vec![source], ..Material::default() }
}
