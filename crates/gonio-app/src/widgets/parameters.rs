//! A parameter of a BSDF or of a station, as a row with a slider, a colour or a switch.

use super::{NumberField, color_swatch, row, toggle};
use egui::Ui;
use gonio_bsdf::{DVec3, Parameter, ParameterKind};
use gonio_language::tr;
use gonio_scene::color_value::Color;

/// The ratio of the ends of a range from which on a slider is logarithmic.
const WIDE_RANGE: f64 = 50.0;

/// Shows a parameter under the id `id`. Returns its value if it was changed; that of a number or a switch is in all three
/// channels.
pub fn parameter(ui: &mut Ui, id: &str, parameter: &Parameter, value: DVec3) -> Option<DVec3> {
    match parameter.kind {
        ParameterKind::Number { min, max, default } => {
            number(ui, id, parameter, [min, max, default], value.x).map(DVec3::splat)
        }
        ParameterKind::Color { default } => tint(ui, id, parameter, default, value),
        ParameterKind::Switch { .. } => {
            let mut is_on = value.x != 0.0;
            toggle(ui, id, &parameter.name, &mut is_on, &parameter.description)
                .then(|| DVec3::splat(f64::from(u8::from(is_on))))
        }
    }
}

fn number(ui: &mut Ui, id: &str, parameter: &Parameter, ends: [f64; 3], value: f64) -> Option<f64> {
    let [min, max, default] = ends;
    let mut edited = value;
    row(ui, &parameter.name, &parameter.description, |ui| {
        let tip = if parameter.unit.is_empty() {
            format!("{}: {}", parameter.name, parameter.description)
        } else {
            format!("{}: {} ({})", parameter.name, &parameter.description, parameter.unit)
        };
        let field = NumberField::new(id, &parameter.name).tip(&tip).range(min..=max).default(default).width(64.0);
        field.show_with_slider(ui, &mut edited, min > 0.0 && max / min >= WIDE_RANGE);
    });
    (edited != value).then_some(edited)
}

/// A colour: a swatch for the hue, a slider for the largest channel.
fn tint(ui: &mut Ui, id: &str, parameter: &Parameter, default: [f64; 3], value: DVec3) -> Option<DVec3> {
    let mut color = Color(value.to_array());
    row(ui, &parameter.name, &parameter.description, |ui| {
        let tip = &*parameter.description;
        color_swatch(ui, &format!("{id}-color"), &parameter.name, &mut color, Some(Color(default)), tip);
        let largest = color.0.iter().copied().fold(0.0, f64::max);
        let mut edited = largest;
        let label = tr!("window-largest-channel", name = parameter.name);
        let most = default.iter().copied().fold(0.0, f64::max);
        let field = NumberField::new(id, &label).range(0.0..=1.0).default(most).width(64.0);
        field.show_with_slider(ui, &mut edited, false);
        if edited != largest {
            let is_grey = color.0.iter().all(|channel| *channel == largest);
            color.0 = if is_grey { [edited; 3] } else { color.0.map(|channel| channel / largest * edited) };
        }
    });
    if color.0 == value.to_array() {
        return None;
    }
    // Few digits, for the legend.
    Some(DVec3::from_array(color.0.map(|channel| (1e3 * channel.clamp(0.0, 1.0)).round() / 1e3)))
}
