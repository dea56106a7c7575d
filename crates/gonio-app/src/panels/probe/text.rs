//! A reading as text, to be pasted elsewhere.

use super::numbers::{hex, number, triple};
use crate::session::probing::Reading;
use std::fmt::Write;

/// Aligned lines: the pixel, its value, and where a surface is seen every factor of every light.
pub fn format_reading(reading: &Reading) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:16} {value}");
    };
    line("pixel", format!("{}, {} of {} x {}", reading.x, reading.y, reading.width, reading.height));
    let [r, g, b, a] = reading.reference;
    line("CPU", format!("{r} {g} {b} {a}, {}", hex(reading.displayed)));
    if let Some(gpu) = reading.gpu {
        let [r, g, b, a] = gpu.value;
        line("OpenGL", format!("{r} {g} {b} {a}, {}", hex(gpu.displayed)));
        line("difference", number(gpu.difference));
    }
    let Some(probe) = &reading.probe else { return text };
    line("object", probe.object_name.clone());
    line("material", probe.material_name.clone());
    line("triangle", format!("{}, weights {}", probe.triangle, triple(probe.barycentrics)));
    line("position", triple(probe.position));
    line("N", triple(probe.terms.point.normal));
    line("V", triple(probe.terms.point.view));
    line("A", triple(probe.terms.ambient));
    line("E", triple(probe.terms.emitted));
    for light in &probe.terms.lights {
        line("light", super::lights::name(reading, light.light));
        line("  L", triple(light.l));
        let factors = [
            ("N.L", light.cos_theta),
            ("att", light.attenuation),
            ("spot", light.spot),
            ("diff", light.diff),
            ("spec", light.spec),
            ("R.V", light.r_dot_v),
            ("N.H", light.n_dot_h),
        ];
        line("  factors", factors.map(|(name, value)| format!("{name} {}", number(value))).join("  "));
        line("  diffuse", triple(light.diffuse));
        line("  specular", triple(light.specular));
    }
    line("L_o", triple(probe.lit));
    line("L", triple(probe.radiance));
    text
}
