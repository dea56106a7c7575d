//! All parameters of one light: values, falloff, cone, motion.

use super::edits::{self, Edit};
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::Session;
use crate::theme::{colors, icons};
use crate::typeset::{self, EguiFonts, Node};
use crate::widgets::{
    NumberField, Vector, color, compact, dropdown, icon_button, named_options, row, spectrum, tool_button,
};
use egui::{Align2, FontId, Frame, Margin, Sense, Stroke, TextEdit, Ui, pos2, vec2};
use glam::DVec3;
use gonio_language::tr;
use gonio_scene::defaults;
use gonio_scene::scene_file::{LightSourceKind, MotionKind};
use gonio_scene::settings::{LightSettings, Motion, MotionPath};

/// Shows the light. Returns an edit of the list if one was requested.
pub fn show(ui: &mut Ui, document: &mut Document, session: &Session, index: usize) -> Option<Edit> {
    let count = document.scene.lights.len();
    let light = document.scene.lights.get_mut(index)?;
    let before = light.clone();
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(6).inner_margin(Margin::symmetric(8, 6));
    let asked = frame
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 4.0;
            values(ui, light, session, index);
            tools(ui, index, count)
        })
        .inner;
    keep_possible(light, &before);
    asked
}

fn values(ui: &mut Ui, light: &mut LightSettings, session: &Session, index: usize) {
    let id = |name: &str| format!("light-{index}-{name}");
    row(ui, tr!("scene-name"), tr!("scene-used-in-reports-and-lists"), |ui| {
        let edit =
            TextEdit::singleline(&mut light.name).id_salt("name").hint_text(gonio_language::name(light.kind.name()));
        let response = ui.add(edit.desired_width(ui.available_width() - 8.0));
        exported::note(ui, &response, &id("name"), WidgetRole::Text, "name", &light.name);
    });
    let mut kind = light.kind;
    let options = named_options!(LightSourceKind);
    if row(ui, tr!("scene-kind"), "", |ui| dropdown(ui, &id("kind"), tr!("scene-kind-of-light"), &mut kind, &options)) {
        edits::convert(light, kind, session);
    }
    if let Some(position) = &mut light.position {
        let tip = tr!("scene-position-in-world-space-at-time");
        let moved = row(ui, tr!("scene-position"), tip, |ui| {
            Vector::new(&id("position"), "position").tip(tip).show(ui, position)
        });
        let path = light.motion.as_mut().map(|motion| &mut motion.path);
        if moved
            && let Some(MotionPath::Path { points }) = path
            && let Some(first) = points.first_mut()
        {
            *first = *position;
        }
    }
    if let Some(direction) = &mut light.direction {
        let tip = tr!("scene-direction-of-the-light-s-travel");
        row(ui, tr!("scene-direction"), tip, |ui| {
            Vector::new(&id("direction"), "direction").tip(tip).step(0.01).show(ui, direction)
        });
    }
    extent(ui, light, session, index);
    let tip = tr!("scene-colour-of-l-i-linear-rgb");
    row(ui, tr!("scene-colour"), tip, |ui| {
        color(ui, &id("color"), "colour", &mut light.color, Some(defaults::LIGHT_COLOR), tip)
    });
    if let Some(own) = &light.spectrum {
        let tip = tr!("scene-relative-power-by-wavelength-the-scene");
        row(ui, tr!("scene-spectrum"), tip, |ui| {
            let plot = spectrum(ui, |lambda| own.power_at(lambda), None, tip);
            exported::note(ui, &plot, &id("spectrum"), WidgetRole::Picture, "spectrum", own.samples().len());
        });
    }
    if light.position.is_some() {
        attenuation(ui, light, session, index);
    }
    if light.kind == LightSourceKind::Spot {
        cone(ui, light, index);
    }
    if light.position.is_some() {
        motion(ui, light, session, index);
    }
}

/// Radius or size of the lamp.
fn extent(ui: &mut Ui, light: &mut LightSettings, session: &Session, index: usize) {
    let (_, around) = edits::around(session);
    let number = |ui: &mut Ui, name: &str, tip: &str, default: f64, width: Option<f32>, value: &mut f64| {
        let id = format!("light-{index}-{name}");
        let field = NumberField::new(&id, name).tip(tip).range(0.0..=1e6).default(default).step(0.005 * around);
        match width {
            Some(width) => field.width(width).show(ui, value),
            None => field.show(ui, value),
        };
    };
    if light.kind.has_radius() {
        let tip = tr!("scene-radius-of-the-lamp-in-world");
        row(ui, tr!("scene-radius"), tip, |ui| {
            number(ui, "radius", tip, defaults::LIGHT_RADIUS, None, &mut light.radius)
        });
    } else if light.kind == LightSourceKind::Rectangle {
        let tip = tr!("scene-width-and-height-of-the-lamp");
        let [width, height] = &mut light.size;
        let default = defaults::LIGHT_SIZE;
        row(ui, tr!("scene-size"), tip, |ui| {
            number(ui, "width", tip, default[0], Some(82.0), width);
            number(ui, "height", tip, default[1], Some(82.0), height);
        });
    }
}

fn attenuation(ui: &mut Ui, light: &mut LightSettings, session: &Session, index: usize) {
    let k = |letter: &str| Node::variable("k").below(Node::variable(letter));
    let d = || Node::variable("d");
    let terms = [k("c"), Node::binary("+"), k("l"), d(), Node::binary("+"), k("q"), d().sup(Node::upright("2"))];
    let formula = Node::row([Node::upright("att"), Node::relation("="), Node::upright("1").over(Node::row(terms))]);
    let laid = typeset::lay(&formula, 19.0, &mut EguiFonts(ui.painter()));
    let (rect, _) = ui.allocate_exact_size(vec2(laid.width, laid.size().y + 2.0), Sense::hover());
    let color = ui.visuals().text_color();
    typeset::paint(ui.painter(), &laid, pos2(rect.left(), rect.top() + 1.0 + laid.ascent), &|_| color);
    let mut values = [light.constant, light.linear, light.quadratic];
    let [constant, linear, quadratic] = defaults::ATTENUATION;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let names = [
            ("kc", tr!("scene-k-c-the-constant-coefficient"), constant, 0.005),
            ("kl", tr!("scene-k-l-the-linear-coefficient"), linear, 0.002),
            ("kq", tr!("scene-k-q-the-quadratic-coefficient-k"), quadratic, 0.002),
        ];
        for ((name, tip, default, step), value) in names.into_iter().zip(&mut values) {
            ui.label(egui::RichText::new(name).weak());
            let id = format!("light-{index}-{name}");
            NumberField::new(&id, name)
                .tip(tip)
                .range(0.0..=1e6)
                .default(default)
                .step(step)
                .width(66.0)
                .show(ui, value);
        }
    });
    let (center, radius) = edits::around(session);
    let here = light.position.map_or(radius, |p| DVec3::from(p).distance(center));
    falloff(ui, values, (2.0 * here).max(radius), here);
    if values != [0.0; 3] {
        [light.constant, light.linear, light.quadratic] = values;
    }
}

fn cone(ui: &mut Ui, light: &mut LightSettings, index: usize) {
    let (mut inner, mut outer) = (light.inner_angle, light.outer_angle);
    let before = (inner, outer);
    let angles = [
        (
            "inner",
            tr!("scene-inner-angle"),
            tr!("scene-half-angle-of-the-cone-with"),
            &mut inner,
            defaults::INNER_ANGLE,
        ),
        (
            "outer",
            tr!("scene-outer-angle"),
            tr!("scene-half-angle-of-the-cone-outside"),
            &mut outer,
            defaults::OUTER_ANGLE,
        ),
    ];
    for (name, label, tip, value, default) in angles {
        row(ui, label, tip, |ui| {
            let id = format!("light-{index}-{name}-angle");
            let number = NumberField::new(&id, label).tip(tip).unit("\u{b0}").range(0.0..=90.0).default(default);
            number.show(ui, value);
        });
    }
    // The angle that is moved pushes the other.
    if inner > outer {
        if inner == before.0 {
            inner = outer;
        } else {
            outer = inner;
        }
    }
    (light.inner_angle, light.outer_angle) = (inner, outer);
}

/// Keeps the previous direction if the new one has no length, and the previous size if the new one has no area.
fn keep_possible(light: &mut LightSettings, before: &LightSettings) {
    if light.direction == Some([0.0; 3]) {
        light.direction = before.direction;
    }
    if light.size.contains(&0.0) {
        light.size = before.size;
    }
}

fn tools(ui: &mut Ui, index: usize, count: usize) -> Option<Edit> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (name, icon, tip, edit, enabled) in [
            ("duplicate", icons::COPY, tr!("scene-duplicate-this-light"), Edit::Duplicate(index), true),
            ("up", icons::CARET_UP, tr!("scene-move-up"), Edit::Up(index), index > 0),
            ("down", icons::CARET_DOWN, tr!("scene-move-down"), Edit::Down(index), index + 1 < count),
        ] {
            if tool_button(ui, &format!("light-{index}-{name}"), icon, tip, None, enabled).clicked() {
                asked = Some(edit);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if icon_button(ui, &format!("light-{index}-remove"), icons::TRASH, tr!("scene-remove-this-light")).clicked()
            {
                asked = Some(Edit::Remove(index));
            }
        });
    });
    asked
}

/// Height of the falloff plot, points.
const HEIGHT: f32 = 58.0;

/// Plots `1 / (kc + kl d + kq d^2)` from 0 to `reach` world units; `here` is the distance to the scene's middle.
fn falloff(ui: &mut Ui, [constant, linear, quadratic]: [f64; 3], reach: f64, here: f64) {
    let width = ui.available_width().min(360.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    let painter = ui.painter();
    let weak = ui.visuals().weak_text_color();
    painter.rect_filled(rect, 4.0, ui.visuals().faint_bg_color);
    let plot = rect.shrink2(vec2(6.0, 8.0));
    let at = |d: f64| {
        let below = constant + linear * d + quadratic * d * d;
        if below > 0.0 { (1.0 / below).min(1e6) } else { 1e6 }
    };
    // If attenuation exceeds 1 near the light, the axis ends at its value for the nearest part of the scene.
    let most = at(0.15 * reach).max(at(here)).max(1e-9);
    let top = if at(0.0) <= 1.5 * most { at(0.0) } else { 1.5 * most };
    let place = |d: f64| {
        let x = plot.left() + (d / reach) as f32 * plot.width();
        let y = plot.bottom() - (at(d) / top).min(1.08) as f32 * plot.height();
        pos2(x, y)
    };
    let color = colors::LIGHT.of(ui);
    let points = (0..=96).map(|i| place(reach * f64::from(i) / 96.0)).collect();
    painter.with_clip_rect(rect).line(points, Stroke::new(1.5, color));
    painter.hline(plot.x_range(), plot.bottom(), Stroke::new(1.0, weak.gamma_multiply(0.5)));
    if here <= reach {
        let dot = place(here);
        painter.vline(dot.x, dot.y..=plot.bottom(), Stroke::new(1.0, weak));
        painter.circle_filled(dot, 3.0, color);
    }
    let font = FontId::proportional(10.5);
    let text = tr!("scene-att-at-d", attenuation = compact(at(here)), distance = compact(here));
    painter.text(plot.right_top(), Align2::RIGHT_TOP, text, font, weak);
    response.on_hover_text(tr!("scene-att-as-a-function-of-the"));
}

/// Most points of a path that are shown; more are edited in the scene file.
const MOST_POINTS: usize = 24;

/// The light's motion.
fn motion(ui: &mut Ui, light: &mut LightSettings, session: &Session, index: usize) {
    let mut kind = light.motion.as_ref().map(|motion| motion.path.kind());
    let mut options = vec![(None, "none", tr!("scene-the-light-does-not-move"))];
    options.extend(MotionKind::ALL.iter().map(|kind| (Some(*kind), kind.name(), kind.description())));
    let changed = row(ui, tr!("scene-motion"), tr!("scene-motion-over-time"), |ui| {
        dropdown(ui, &format!("light-{index}-motion"), "motion", &mut kind, &options)
    });
    if changed {
        light.motion = kind.map(|kind| fresh(kind, light, session));
    }
    let Some(motion) = &mut light.motion else { return };
    row(ui, tr!("scene-period"), tr!("scene-duration-of-one-cycle-in-seconds"), |ui| {
        let id = format!("light-{index}-period");
        let number = NumberField::new(&id, "period").tip(tr!("scene-duration-of-one-cycle-in-seconds")).unit(" s");
        number.range(0.01..=1e6).default(4.0).show(ui, &mut motion.period);
    });
    match &mut motion.path {
        MotionPath::Oscillate { amplitude } => {
            row(ui, tr!("scene-amplitude"), tr!("scene-largest-displacement-in-world-units"), |ui| {
                let id = format!("light-{index}-amplitude");
                Vector::new(&id, "amplitude").tip(tr!("scene-largest-displacement-in-world-units")).show(ui, amplitude);
            });
        }
        MotionPath::Circle { center, axis } => {
            row(ui, tr!("scene-centre"), tr!("scene-centre-of-the-circle-in-world"), |ui| {
                Vector::new(&format!("light-{index}-center"), "centre").show(ui, center);
            });
            let before = *axis;
            row(ui, tr!("scene-axis"), tr!("scene-axis-of-rotation"), |ui| {
                Vector::new(&format!("light-{index}-axis"), "axis").default(defaults::MOTION_AXIS).show(ui, axis);
            });
            // An axis must have a length.
            if *axis == [0.0; 3] {
                *axis = before;
            }
        }
        MotionPath::Path { points } => {
            path(ui, points, index);
            light.position = points.first().copied().or(light.position);
        }
    }
}

fn path(ui: &mut Ui, points: &mut Vec<[f64; 3]>, index: usize) {
    let mut removed = None;
    let count = points.len();
    for (number, point) in points.iter_mut().enumerate().take(MOST_POINTS) {
        row(ui, &tr!("scene-point", number = number + 1), tr!("scene-in-world-space-the-path-is"), |ui| {
            let id = format!("light-{index}-point-{number}");
            ui.scope(|ui| {
                ui.set_max_width(ui.available_width() - 26.0);
                Vector::new(&id, "point").show(ui, point);
            });
            if count > 2 && icon_button(ui, &format!("{id}-remove"), icons::X, tr!("scene-remove-this-point")).clicked()
            {
                removed = Some(number);
            }
        });
    }
    if let Some(number) = removed {
        points.remove(number);
    }
    row(ui, "", "", |ui| {
        if icon_button(ui, &format!("light-{index}-add-point"), icons::PLUS, tr!("scene-add-a-point")).clicked() {
            let last = points.last().copied().unwrap_or_default();
            points.push([last[0] + 0.5, last[1], last[2]]);
        }
    });
}

/// A new motion that is large enough to be visible.
fn fresh(kind: MotionKind, light: &LightSettings, session: &Session) -> Motion {
    let (center, radius) = edits::around(session);
    let round = |v: f64| (100.0 * v).round() / 100.0;
    let place = light.position.unwrap_or_default();
    let step = round(radius).max(0.01);
    let path = match kind {
        MotionKind::Oscillate => MotionPath::Oscillate { amplitude: [0.0, 0.0, step] },
        MotionKind::Circle => {
            MotionPath::Circle { center: [round(center.x), place[1], round(center.z)], axis: defaults::MOTION_AXIS }
        }
        MotionKind::Path => {
            let [x, y, z] = place;
            MotionPath::Path { points: vec![place, [x + step, y, z], [x + step, y + step, z]] }
        }
    };
    Motion { period: 4.0, path }
}
