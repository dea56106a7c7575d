//! Everything of one light.

use super::edits::{self, Edit};
use super::{falloff, motion};
use crate::document::Document;
use crate::exported::{self, Role};
use crate::session::Session;
use crate::theme::icons;
use crate::typeset::{self, EguiFonts, Node};
use crate::widgets::{Number, Vector, color, dropdown, icon_button, named_options, row, tool_button};
use egui::{Frame, Margin, Sense, TextEdit, Ui, pos2, vec2};
use glam::DVec3;
use gonio_scene::defaults;
use gonio_scene::scene_file::LightSourceKind;
use gonio_scene::settings::{LightSettings, MotionPath};

/// Shows it; what is asked for that changes the list.
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
    row(ui, "Name", "Used in reports and lists", |ui| {
        let edit = TextEdit::singleline(&mut light.name).id_salt("name").hint_text(light.kind.name());
        let response = ui.add(edit.desired_width(ui.available_width() - 8.0));
        exported::note(ui, &response, &id("name"), Role::Text, "name", &light.name);
    });
    let mut kind = light.kind;
    let options = named_options!(LightSourceKind);
    if row(ui, "Kind", "", |ui| dropdown(ui, &id("kind"), "kind of light", &mut kind, &options)) {
        edits::convert(light, kind, session);
    }
    if let Some(position) = &mut light.position {
        let tip = "Position in world space, at time 0 if the light moves";
        let moved = row(ui, "Position", tip, |ui| Vector::new(&id("position"), "position").tip(tip).show(ui, position));
        let path = light.motion.as_mut().map(|motion| &mut motion.path);
        if moved
            && let Some(MotionPath::Path { points }) = path
            && let Some(first) = points.first_mut()
        {
            *first = *position;
        }
    }
    if let Some(direction) = &mut light.direction {
        let tip = "Direction of the light's travel, of any length";
        row(ui, "Direction", tip, |ui| {
            Vector::new(&id("direction"), "direction").tip(tip).step(0.01).show(ui, direction)
        });
    }
    let tip = "Colour of L_i, linear RGB";
    row(ui, "Colour", tip, |ui| color(ui, &id("color"), "colour", &mut light.color, Some(defaults::LIGHT_COLOR), tip));
    if light.position.is_some() {
        attenuation(ui, light, session, index);
    }
    if light.kind == LightSourceKind::Spot {
        cone(ui, light, index);
    }
    if light.position.is_some() {
        motion::show(ui, light, session, index);
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
            ("kc", "k_c, the constant coefficient", constant, 0.005),
            ("kl", "k_l, the linear coefficient", linear, 0.002),
            (
                "kq",
                "k_q, the quadratic coefficient; k_c = k_l = 0, k_q = 1 is the inverse square law",
                quadratic,
                0.002,
            ),
        ];
        for ((name, tip, default, step), value) in names.into_iter().zip(&mut values) {
            ui.label(egui::RichText::new(name).weak());
            let id = format!("light-{index}-{name}");
            Number::new(&id, name).tip(tip).range(0.0..=1e6).default(default).step(step).width(66.0).show(ui, value);
        }
    });
    let (center, radius) = edits::around(session);
    let here = light.position.map_or(radius, |p| DVec3::from(p).distance(center));
    falloff::show(ui, values, (2.0 * here).max(radius), here);
    if values != [0.0; 3] {
        [light.constant, light.linear, light.quadratic] = values;
    }
}

fn cone(ui: &mut Ui, light: &mut LightSettings, index: usize) {
    let (mut inner, mut outer) = (light.inner_angle, light.outer_angle);
    let before = (inner, outer);
    let angles = [
        ("inner", "Inner angle", "Half angle of the cone with full intensity", &mut inner, defaults::INNER_ANGLE),
        (
            "outer",
            "Outer angle",
            "Half angle of the cone outside of which there is no light",
            &mut outer,
            defaults::OUTER_ANGLE,
        ),
    ];
    for (name, label, tip, value, default) in angles {
        row(ui, label, tip, |ui| {
            let id = format!("light-{index}-{name}-angle");
            let number = Number::new(&id, label).tip(tip).unit("\u{b0}").range(0.0..=90.0).default(default);
            number.show(ui, value);
        });
    }
    // The one that is moved pushes the other.
    if inner > outer {
        if inner == before.0 {
            inner = outer;
        } else {
            outer = inner;
        }
    }
    (light.inner_angle, light.outer_angle) = (inner, outer);
}

/// Keeps the previous direction if the new one has no length.
fn keep_possible(light: &mut LightSettings, before: &LightSettings) {
    if light.direction == Some([0.0; 3]) {
        light.direction = before.direction;
    }
}

fn tools(ui: &mut Ui, index: usize, count: usize) -> Option<Edit> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (name, icon, tip, edit, enabled) in [
            ("duplicate", icons::COPY, "Duplicate this light", Edit::Duplicate(index), true),
            ("up", icons::CARET_UP, "Move up", Edit::Up(index), index > 0),
            ("down", icons::CARET_DOWN, "Move down", Edit::Down(index), index + 1 < count),
        ] {
            if tool_button(ui, &format!("light-{index}-{name}"), icon, tip, None, enabled).clicked() {
                asked = Some(edit);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if icon_button(ui, &format!("light-{index}-remove"), icons::TRASH, "Remove this light").clicked() {
                asked = Some(Edit::Remove(index));
            }
        });
    });
    asked
}
