//! The element `vertex`.

use super::header::Element;
use super::number_reader::{ListProblem, NumberReader, explain, skip_property};
use crate::diagnostic::{Reports, Tally};
use crate::{Diagnostic, Limits, ReadError, Severity};
use glam::DVec3;
use gonio_light::color::srgb_decode;

/// Indices of the values of a vertex among twelve slots.
const NORMAL: usize = 3;
const TEX_COORD: usize = 6;
const COLOR: usize = 8;
const ALPHA: usize = 11;
const SLOTS: usize = 12;

/// Returns the slot of a property name.
fn slot(name: &str) -> Option<usize> {
    Some(match name {
        "x" => 0,
        "y" => 1,
        "z" => 2,
        "nx" | "normal_x" => NORMAL,
        "ny" | "normal_y" => NORMAL + 1,
        "nz" | "normal_z" => NORMAL + 2,
        "s" | "u" | "texture_u" | "texture_s" => TEX_COORD,
        "t" | "v" | "texture_v" | "texture_t" => TEX_COORD + 1,
        _ => return color_slot(name).map(|channel| COLOR + channel),
    })
}

/// Returns the channel of a property name.
pub(super) fn color_slot(name: &str) -> Option<usize> {
    Some(match name {
        "red" | "r" | "diffuse_red" => 0,
        "green" | "g" | "diffuse_green" => 1,
        "blue" | "b" | "diffuse_blue" => 2,
        "alpha" | "a" | "diffuse_alpha" => 3,
        _ => return None,
    })
}

/// The vertices of a file, in order; arrays are empty if the file has no such values.
#[derive(Default)]
pub(super) struct Vertices {
    pub(super) positions: Vec<[f32; 3]>,
    /// Vectors of length 1, or 0.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// Linear, once all are read.
    pub(super) colors: Vec<[f32; 4]>,
    /// Number of vertices whose position is not finite.
    pub(super) not_finite: u64,
}

/// The slots of a vertex's properties.
pub(super) struct VertexLayout {
    slots: Vec<Option<usize>>,
    /// The divisor of each colour property.
    whites: Vec<f32>,
    has_normals: bool,
    has_tex_coords: bool,
    has_colors: bool,
}

impl VertexLayout {
    /// Assigns properties to slots. The first property of a name counts; lists are skipped.
    pub(super) fn of_element(element: &Element) -> VertexLayout {
        let mut taken = [false; SLOTS];
        let mut slots: Vec<Option<usize>> = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            let free = slot(&property.name).filter(|&slot| property.count.is_none() && !taken[slot]);
            free.iter().for_each(|&slot| taken[slot] = true);
            slots.push(free);
        }
        let has = |range: std::ops::Range<usize>| taken[range].iter().all(|&taken| taken);
        let layout = VertexLayout {
            slots,
            whites: element.properties.iter().map(|p| p.value.white() as f32).collect(),
            has_normals: has(NORMAL..TEX_COORD),
            has_tex_coords: has(TEX_COORD..COLOR),
            has_colors: has(COLOR..ALPHA),
        };
        layout.without_halves()
    }

    /// Skips normals with only two coordinates.
    fn without_halves(mut self) -> VertexLayout {
        let keeps = |slot: usize| match slot {
            0..NORMAL => true,
            NORMAL..TEX_COORD => self.has_normals,
            TEX_COORD..COLOR => self.has_tex_coords,
            _ => self.has_colors,
        };
        self.slots = self.slots.iter().map(|slot| slot.filter(|&slot| keeps(slot))).collect();
        self
    }

    /// Whether property `index` is read.
    pub(super) fn reads(&self, index: usize) -> bool {
        self.slots[index].is_some()
    }

    fn check(&self) -> Result<(), ReadError> {
        let missing: Vec<&str> = ["x", "y", "z"]
            .into_iter()
            .enumerate()
            .filter(|(i, _)| !self.slots.contains(&Some(*i)))
            .map(|m| m.1)
            .collect();
        if missing.is_empty() {
            return Ok(());
        }
        Err(ReadError::new(format!("the vertices have no {}: nothing to draw", missing.join(", no "))))
    }
}

/// Reads all vertices.
pub(super) fn read(
    source: &mut impl NumberReader,
    element: &Element,
    layout: &VertexLayout,
    limits: &Limits,
    reports: &mut Reports,
) -> Result<Vertices, ReadError> {
    layout.check()?;
    if element.count > limits.max_vertices.min(u64::from(u32::MAX)) {
        let most = limits.max_vertices.min(u64::from(u32::MAX));
        return Err(ReadError::new(format!(
            "contains {} vertices, more than {most}, which is the limit",
            element.count
        )));
    }
    // The caller has checked that so many fit into the file.
    let count = element.count as usize;
    let mut vertices = Vertices::default();
    vertices.positions.reserve_exact(count);
    vertices.normals.reserve_exact(if layout.has_normals { count } else { 0 });
    vertices.tex_coords.reserve_exact(if layout.has_tex_coords { count } else { 0 });
    vertices.colors.reserve_exact(if layout.has_colors { count } else { 0 });
    let mut anomalies = Anomalies::default();
    for index in 0..element.count {
        let mut values = [0.0_f32; SLOTS];
        values[ALPHA] = 1.0;
        source.begin();
        for (i, property) in element.properties.iter().enumerate() {
            match layout.slots[i] {
                Some(slot) => match source.coordinate(property.value) {
                    Ok(value) if slot >= COLOR => values[slot] = value / layout.whites[i],
                    Ok(value) => values[slot] = value,
                    Err(problem) => {
                        return Err(explain(ListProblem::Number(problem), source, element, index, property));
                    }
                },
                None => skip_property(source, property).map_err(|e| explain(e, source, element, index, property))?,
            }
        }
        source.end();
        anomalies.line = source.line();
        vertices.push(&values, layout, index, &mut anomalies);
    }
    vertices.decode_colors(&mut anomalies, reports);
    anomalies.report(reports);
    Ok(vertices)
}

impl Vertices {
    fn push(&mut self, values: &[f32; SLOTS], layout: &VertexLayout, index: u64, anomalies: &mut Anomalies) {
        let &[x, y, z, nx, ny, nz, u, v, r, g, b, a] = values;
        self.positions.push([x, y, z]);
        if ![x, y, z].iter().all(|c| c.is_finite()) {
            self.not_finite += 1;
        }
        if layout.has_normals {
            if ![nx, ny, nz].iter().all(|c| c.is_finite()) {
                anomalies.normals.add(anomalies.line, || format!("vertex {index}"));
            }
            let unit = DVec3::new(nx.into(), ny.into(), nz.into()).normalize_or_zero();
            self.normals.push(unit.as_vec3().to_array());
        }
        if layout.has_tex_coords {
            let finite = u.is_finite() && v.is_finite();
            if !finite {
                anomalies.tex_coords.add(anomalies.line, || format!("vertex {index}"));
            }
            self.tex_coords.push(if finite { [u, v] } else { [0.0; 2] });
        }
        if layout.has_colors {
            let color = [r, g, b, a];
            if !color.iter().all(|c| c.is_finite()) {
                anomalies.colors_not_finite.add(anomalies.line, || format!("vertex {index}"));
            }
            self.colors.push(color.map(|c| if c.is_finite() { c } else { 0.0 }));
        }
    }

    /// Converts from sRGB to linear, in place.
    fn decode_colors(&mut self, anomalies: &mut Anomalies, reports: &mut Reports) {
        let largest = self.colors.iter().flat_map(|c| &c[..3]).fold(0.0, |a: f32, &b| a.max(b));
        let is_in_bytes = largest > 1.0 && largest <= 255.0;
        if is_in_bytes {
            let message = format!("vertex colors reach {largest}: treated as 0 to 255");
            reports.push(u64::MAX, Diagnostic::note(message));
        }
        let linear = LinearFromSrgb::new();
        for (index, color) in self.colors.iter_mut().enumerate() {
            if is_in_bytes {
                let [r, g, b, a] = *color;
                *color = [r / 255.0, g / 255.0, b / 255.0, if a > 1.0 { a / 255.0 } else { a }];
            }
            if !color.iter().all(|c| (0.0..=1.0).contains(c)) {
                anomalies.colors.add(None, || format!("vertex {index}"));
            }
            *color = linear.rgba(*color);
        }
    }
}

/// Counts of oddities in vertices.
#[derive(Default)]
struct Anomalies {
    line: Option<u64>,
    normals: Tally,
    tex_coords: Tally,
    colors_not_finite: Tally,
    colors: Tally,
}

impl Anomalies {
    fn report(&self, reports: &mut Reports) {
        self.normals.report(Severity::Warning, reports, |tally| {
            let vertices = tally.counted("vertex has", "vertices have");
            format!("{vertices} a normal that is not finite (the first is {}): ignored", tally.first)
        });
        self.tex_coords.report(Severity::Warning, reports, |tally| {
            let vertices = tally.counted("vertex has", "vertices have");
            format!("{vertices} texture coordinates that are not finite (the first is {}): using (0, 0)", tally.first)
        });
        self.colors_not_finite.report(Severity::Warning, reports, |tally| {
            let vertices = tally.counted("vertex has", "vertices have");
            format!("{vertices} a color that is not finite (the first is {}): using 0 instead", tally.first)
        });
        self.colors.report(Severity::Warning, reports, |tally| {
            let vertices = tally.counted("vertex has", "vertices have");
            format!("{vertices} a color outside 0 to 1 (the first is {}): clamped", tally.first)
        });
    }
}

/// Decodes sRGB (IEC 61966-2-1), with a table for bytes.
pub(super) struct LinearFromSrgb {
    of_byte: [f32; 256],
}

impl LinearFromSrgb {
    pub(super) fn new() -> Self {
        LinearFromSrgb { of_byte: std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)) }
    }

    /// Decodes values from 0 to 1; alpha is not encoded. NaN becomes 0.
    pub(super) fn rgba(&self, encoded: [f32; 4]) -> [f32; 4] {
        let [r, g, b, a] = encoded.map(|c| if c.is_nan() { 0.0 } else { c.clamp(0.0, 1.0) });
        let linear = |c: f32| {
            let byte = (c * 255.0).round();
            if byte / 255.0 == c { self.of_byte[byte as usize] } else { linear_from_srgb(c) }
        };
        [linear(r), linear(g), linear(b), a]
    }
}

fn linear_from_srgb(encoded: f32) -> f32 {
    srgb_decode(encoded.into()) as f32
}
