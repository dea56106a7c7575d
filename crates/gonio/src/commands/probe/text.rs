//! A probe as text: aligned numbers, and the light equation with its numbers.

use super::{GpuValue, Report};
use crate::terminal::TerminalPage;
use glam::DVec3;
use gonio_light::{Convention, LightKind, LightTerms, Specular, Terms, is_noise};
use gonio_reference::Probe;
use gonio_scene::{Frame, MaterialBrdf, Scene};
use std::fmt::Write as _;

/// The width of the column of names.
const NAME: usize = 22;

/// A page about one pixel of a scene.
pub struct ProbePage<'a> {
    pub(super) scene: &'a Scene,
    pub(super) frame: &'a Frame,
    pub(super) text: TerminalPage,
}

impl<'a> ProbePage<'a> {
    /// An empty page.
    pub fn new(scene: &'a Scene, frame: &'a Frame) -> Self {
        ProbePage { scene, frame, text: TerminalPage::new() }
    }

    /// Writes everything.
    pub(super) fn write(mut self, report: &Report<'_>) -> TerminalPage {
        let size = format!("pixel {},{} of {}x{}", report.x, report.y, report.width, report.height);
        self.heading(&size);
        match report.probe {
            None => {
                let sky = self.frame.surroundings.is_some_and(|s| s.visible);
                let behind = if sky { "the environment" } else { "the background" };
                self.line("object", &format!("none, only {behind} is visible"));
            }
            Some(probe) => {
                self.place(probe);
                self.material(probe);
                match &probe.interpolated {
                    Some(_) => self.corners(probe),
                    None => probe.terms.lights.iter().for_each(|light| self.light(light, probe)),
                }
                self.sum(probe);
                self.surroundings(probe);
            }
        }
        if let Some(traced) = &report.traced {
            self.traced(traced);
        }
        self.result(report);
        self.text
    }

    pub(super) fn heading(&mut self, text: &str) {
        self.text.heading(text);
    }

    pub(super) fn line(&mut self, name: &str, value: &str) {
        let padding = NAME.saturating_sub(name.chars().count());
        self.text.line(format_args!("  {name}{:padding$}{value}", ""));
    }

    pub(super) fn vector(&mut self, name: &str, v: DVec3, remark: &str) {
        let remark = if remark.is_empty() { String::new() } else { format!("   {remark}") };
        self.line(name, &format!("{}{}{}{remark}", number(v.x), number(v.y), number(v.z)));
    }

    pub(super) fn scalar(&mut self, name: &str, v: f64, remark: &str) {
        self.line(name, format!("{}   {remark}", number(v)).trim_end());
    }

    fn place(&mut self, probe: &Probe) {
        let part = if probe.part_name.is_empty() { String::new() } else { format!(", part `{}`", probe.part_name) };
        self.line("object", &format!("`{}`{part}", probe.object_name));
        let [a, b, c] = probe.vertices;
        let w = probe.barycentrics;
        self.line(
            "triangle",
            &format!("{} (vertices {a}, {b}, {c}, weights {:.4}, {:.4}, {:.4})", probe.triangle, w.x, w.y, w.z),
        );
        let side = match (probe.front_facing, probe.normal_turned) {
            (true, _) => "front",
            (false, true) => "back, N is turned to the viewer",
            (false, false) => "back",
        };
        self.line("side", side);
        self.line("shading", probe.shading.name());
        self.vector("position", probe.position, "world space");
        self.scalar("depth", probe.depth, "from the eye, along the viewing direction");
        self.vector("N", probe.terms.point.normal, "shading normal");
        self.vector("N geometric", probe.geometry.geometric_normal, "of the triangle");
        self.vector("V", probe.terms.point.view, "to the eye");
        let uv = probe.geometry.uv;
        self.line("uv", &format!("{}{}", number(uv.x), number(uv.y)));
    }

    fn material(&mut self, probe: &Probe) {
        self.heading(&format!("material `{}`", probe.material_name));
        let surface = &probe.surface;
        self.vector("k_a", surface.ambient, "ambient");
        self.vector("k_d", surface.diffuse, "diffuse");
        self.vector("k_s", surface.specular, "specular");
        self.vector("E", surface.emitted, "emitted");
        match self.own_brdf(probe) {
            Some(brdf) => self.line("f", &format!("   {}", brdf.name)),
            None => self.line("shininess", &format!("{:>11}", short(surface.shininess))),
        }
        self.line("refraction index", &format!("{:>11}", short(surface.refraction_index)));
        if probe.opacity < 1.0 || probe.surfaces_behind > 0 {
            let behind = match probe.surfaces_behind {
                1 => "1 surface is visible behind it".to_owned(),
                n => format!("{n} surfaces are visible behind it"),
            };
            self.scalar("opacity", probe.opacity, &behind);
        }
        for texel in &probe.texels {
            let v = texel.value;
            self.line(
                &format!("map {}", texel.map),
                &format!(
                    "{}{}{}{}   {} at {:.4}, {:.4}",
                    number(v.x),
                    number(v.y),
                    number(v.z),
                    number(v.w),
                    texel.texture,
                    texel.uv.x,
                    texel.uv.y
                ),
            );
        }
    }

    /// `light 2, point "key"`
    fn light_name(&self, index: usize) -> String {
        let kind = match self.frame.lights.get(index).map(|l| l.kind) {
            Some(LightKind::Ambient) => "ambient",
            Some(LightKind::Directional { .. }) => "directional",
            Some(LightKind::Point { .. }) => "point",
            Some(LightKind::Spot { .. }) => "spot",
            None => "",
        };
        match self.scene.settings.lights.get(index).map(|l| l.name.as_str()) {
            Some(name) if !name.is_empty() => format!("light {index}, {kind} `{name}`"),
            _ => format!("light {index}, {kind}"),
        }
    }

    fn light(&mut self, light: &LightTerms, probe: &Probe) {
        let name = self.light_name(light.light);
        self.heading(&name);
        self.vector("L", light.l, "to the light");
        self.vector("R", light.r, "L reflected about N");
        self.vector("H", light.h, "halfway between L and V");
        if light.distance.is_finite() {
            self.scalar("d", light.distance, "to the light");
            self.scalar("att", light.attenuation, "");
        }
        if matches!(self.frame.lights.get(light.light).map(|l| l.kind), Some(LightKind::Spot { .. })) {
            self.scalar("spot", light.spot, "");
        }
        self.scalar(
            "N.L_i",
            light.cos_theta,
            if light.cos_theta <= 0.0 { "the light is behind the surface" } else { "" },
        );
        self.scalar("R.V", light.r_dot_v, "");
        self.scalar("N.H", light.n_dot_h, "");
        let incident = self.incident();
        if self.frame.shadows {
            self.scalar("v", light.visibility, if light.visibility <= 0.0 { "in the shadow" } else { "" });
        }
        self.vector(incident, light.incident, "");
        self.scalar("diff", light.diff, self.diff_remark());
        let shininess = probe.surface.shininess.max(1.0);
        if self.own_brdf(probe).is_some() {
            self.scalar("spec", light.spec, "pi * diff * f * <N.L_i>, the largest channel");
            self.vector("specular", light.specular, &format!("= pi * diff * f * <N.L_i> * {incident}"));
            return;
        }
        self.scalar("spec", light.spec, &self.spec_remark(light, shininess));
        self.vector("diffuse", light.diffuse, &format!("= diff * k_d * <N.L_i> * {incident}"));
        self.vector("specular", light.specular, &format!("= k_s * spec_i * {incident}"));
    }

    /// The BRDF `f` that the material has in place of its colours.
    fn own_brdf(&self, probe: &Probe) -> Option<&'a MaterialBrdf> {
        self.scene.materials.get(probe.material)?.brdf.as_deref()
    }

    /// The light that arrives, in symbols: with the visibility if there are shadows.
    fn incident(&self) -> &'static str {
        if self.frame.shadows { "L_i * att_i * spot_i * v_i" } else { "L_i * att_i * spot_i" }
    }

    fn diff_remark(&self) -> &'static str {
        match (self.frame.equation.brdf.is_some(), self.frame.equation.convention) {
            (true, _) => "1/pi, from the BRDF",
            (false, Convention::Physical) => "1/pi, physical convention",
            (false, Convention::Lab) => "lab convention",
        }
    }

    fn spec_remark(&self, light: &LightTerms, shininess: f64) -> String {
        let equation = &self.frame.equation;
        if let Some(brdf) = &equation.brdf {
            return format!("{} lobe * <N.L>", brdf.kind);
        }
        let shininess = short(shininess);
        let (symbol, cosine) = match equation.specular {
            Specular::None => return "no specular model".into(),
            Specular::Phong => ("R.V", light.r_dot_v),
            Specular::BlinnPhong => ("N.H", light.n_dot_h),
        };
        let mut remark = format!("<{symbol}>^shininess = {}^{shininess}", short(cosine.max(0.0)));
        if equation.cosine_weighted {
            remark += " * <N.L>";
        }
        if equation.gated && light.cos_theta <= 0.0 {
            remark += ", but 0 because N.L <= 0";
        }
        remark
    }

    /// The points at which Gouraud shading and flat shading per face evaluate the equation.
    fn corners(&mut self, probe: &Probe) {
        let at_corners = probe.at_vertices.len() == 3;
        for (k, terms) in probe.at_vertices.iter().enumerate() {
            if at_corners {
                self.heading(&format!("corner {k}, vertex {}, weight {:.4}", probe.vertices[k], probe.barycentrics[k]));
            } else {
                self.heading("centroid of the triangle");
            }
            self.corner(terms);
        }
        if let Some(sums) = &probe.interpolated {
            self.heading(if at_corners { "light, interpolated" } else { "light" });
            let incident = self.incident();
            self.vector("diffuse light", sums.diffuse, &format!("= sum_i diff * <N.L_i> * {incident}"));
            self.vector("specular light", sums.specular, &format!("= sum_i spec_i * {incident}"));
        }
    }

    fn corner(&mut self, terms: &Terms) {
        self.vector("position", terms.point.position, "");
        self.vector("N", terms.point.normal, "");
        self.vector("V", terms.point.view, "");
        for light in &terms.lights {
            let name = self.light_name(light.light);
            let cosines = format!(
                "N.L{}  R.V{}  N.H{}  att{}  spot{}",
                number(light.cos_theta),
                number(light.r_dot_v),
                number(light.n_dot_h),
                number(light.attenuation),
                number(light.spot)
            );
            self.line(&name, "");
            self.line("", &cosines);
            self.vector("  diffuse light", light.diffuse_light, "");
            self.vector("  specular light", light.specular_light, "");
        }
    }

    fn sum(&mut self, probe: &Probe) {
        self.heading("sum");
        let terms = &probe.terms;
        self.vector("A", terms.ambient, "= k_a * ambient light");
        self.vector("E", terms.emitted, "");
        match &probe.interpolated {
            Some(sums) => {
                self.vector("diffuse", probe.surface.diffuse * sums.diffuse, "= k_d * diffuse light");
                self.vector("specular", probe.surface.specular * sums.specular, "= k_s * specular light");
            }
            None => {
                for light in &terms.lights {
                    self.vector(&format!("light {} diffuse", light.light), light.diffuse, "");
                    self.vector(&format!("light {} specular", light.light), light.specular, "");
                }
            }
        }
        self.vector("L_o", probe.lit, "");
        self.equation(probe);
    }

    /// The light equation in symbols, and in numbers for each channel, one line per light.
    fn equation(&mut self, probe: &Probe) {
        let symbols = match probe.interpolated {
            Some(_) => "L_o = A + E + k_d * diffuse light + k_s * specular light".to_owned(),
            None => {
                format!("L_o = A + E + sum_i [ diff * k_d * <N.L_i> + k_s * spec_i ] * {}", self.incident())
            }
        };
        self.text.blank();
        self.text.line(format_args!("  {symbols}"));
        let (terms, surface) = (&probe.terms, &probe.surface);
        for (c, channel) in ["red", "green", "blue"].into_iter().enumerate() {
            let (a, e, total) = (short(terms.ambient[c]), short(terms.emitted[c]), short(probe.lit[c]));
            let (k_d, k_s) = (short(surface.diffuse[c]), short(surface.specular[c]));
            let mut sum = format!("  {channel:6}{total:>9} = {a} + {e}");
            if let Some(sums) = &probe.interpolated {
                let (diffuse, specular) = (short(sums.diffuse[c]), short(sums.specular[c]));
                // Writing into a String cannot fail.
                let _ = write!(sum, " + {k_d} * {diffuse} + {k_s} * {specular}");
            }
            self.text.line(sum);
            if probe.interpolated.is_none() {
                for light in &terms.lights {
                    let cosine = short(light.cos_theta.max(0.0));
                    let (diff, spec, incident) = (short(light.diff), short(light.spec), short(light.incident[c]));
                    let product = format!("+ [ {diff} * {k_d} * {cosine} + {k_s} * {spec} ] * {incident}");
                    self.text.line(format_args!("{:18}{product:60}light {}", "", light.light));
                }
            }
        }
        if self.has_switches() {
            self.text.line("  (omitted terms count as 0, omitted attenuation and spot as 1)");
        }
    }

    fn has_switches(&self) -> bool {
        self.frame.equation.terms != gonio_light::TermSwitches::default()
    }

    fn result(&mut self, report: &Report<'_>) {
        self.heading("value");
        let rgba = |v: [f64; 4]| v.map(number).concat();
        self.line(
            "CPU reference",
            &format!("{}   linear RGBA, displayed as {}", rgba(report.reference), report.displayed),
        );
        if let Some(GpuValue { renderer, value, difference }) = &report.gpu {
            self.line("OpenGL", &format!("{}   {renderer}", rgba(value.map(f64::from))));
            self.line("difference", &format!("{}   the largest of the four", number(*difference)));
        }
    }
}

/// Formats a number like [`number`], without padding and trailing zeros.
pub(super) fn short(v: f64) -> String {
    let text = number(v).trim().to_owned();
    let plain = text.contains('.') && !text.contains('e');
    if plain { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Formats a number in eleven columns: with five decimals, or an exponent where they would hide it; noise is 0.
fn number(v: f64) -> String {
    if is_noise(v) {
        return format!("{:>11}", "0");
    }
    if (1e-4..1e5).contains(&v.abs()) { format!("{v:>11.5}") } else { format!("{v:>11.3e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_zero_and_small_numbers_are_not() {
        // A cosine of 1e-5 to the power of ten, and the cosine of a right angle.
        assert_eq!((short(5e-47), short(-6.123e-17)), ("0".into(), "0".into()));
        assert_eq!((short(2.5e-11), short(0.25), short(-0.0)), ("2.500e-11".into(), "0.25".into(), "0".into()));
    }
}
