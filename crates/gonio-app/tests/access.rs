//! What everybody can read and reach: contrast of text and its background, as painted (WCAG 2.2, level AA), a button by the Tab key,
//! and the mirror of the accessibility tree, which screen readers read on the page.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::epaint::ClippedShape;
use egui::{Color32, Key, Modifiers, Pos2, Rect, Shape, Theme, Vec2, vec2};
use egui_kittest::kittest::NodeT;
use gonio_app::mirror::{MirrorChange, MirrorKind, MirrorNode, TreeMirror};
use std::collections::BTreeMap;
use support::Window;

/// The least contrast of text (WCAG 2.2, success criterion 1.4.3).
const TEXT: f64 = 4.5;
/// The least contrast of large text and of icons (1.4.3 and 1.4.11).
const LARGE: f64 = 3.0;
/// Text is large from this height on, points: 24 CSS pixels.
const LARGE_HEIGHT: f32 = 24.0;
/// The icons' font uses characters for private use.
const ICONS: std::ops::RangeInclusive<char> = '\u{e000}'..='\u{f8ff}';

/// Relative luminance.
fn luminance(color: Color32) -> f64 {
    let linear = |byte: u8| {
        let c = f64::from(byte) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
}

fn contrast(a: Color32, b: Color32) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// egui's blending: premultiplied, in gamma space.
fn over(front: Color32, back: Color32) -> Color32 {
    back.blend(front)
}

/// Finds the colour behind each character in paint order.
struct Reader {
    /// What is painted so far: an area with its colour, or with none where a picture is.
    painted: Vec<(Rect, Option<Color32>)>,
    ground: Color32,
    disabled: Vec<Rect>,
    /// The least contrast of each text, with the required one and the two colours.
    found: BTreeMap<String, (f64, f64, [Color32; 2])>,
}

impl Reader {
    fn behind(&self, place: Pos2) -> Option<Color32> {
        let mut color = Some(self.ground);
        for (_, fill) in self.painted.iter().filter(|(area, _)| area.contains(place)) {
            color = match fill {
                Some(fill) if fill.a() == 255 => Some(*fill),
                Some(fill) => color.map(|below| over(*fill, below)),
                None => None,
            };
        }
        color
    }

    fn read(&mut self, shape: &Shape, clip: Rect) {
        let picture = |shape: &Shape| (shape.visual_bounding_rect().intersect(clip), None);
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| self.read(shape, clip)),
            Shape::Rect(rect) if rect.brush.is_some() => self.painted.push(picture(shape)),
            // A shadow is blurred.
            Shape::Rect(rect) if rect.blur_width > 0.0 => {}
            Shape::Rect(rect) if rect.fill.a() > 0 => self.painted.push((rect.rect.intersect(clip), Some(rect.fill))),
            Shape::Mesh(_) | Shape::Callback(_) => self.painted.push(picture(shape)),
            Shape::Circle(circle) if circle.fill.a() > 0 => self.painted.push(picture(shape)),
            Shape::Path(path) if path.fill.a() > 0 => self.painted.push(picture(shape)),
            Shape::Text(text) => {
                for row in &text.galley.rows {
                    let origin = text.pos + row.pos.to_vec2();
                    let visuals = &row.row.visuals;
                    let glyphs = &visuals.mesh.vertices[visuals.glyph_vertex_range.clone()];
                    let said = row.row.glyphs.iter().map(|glyph| glyph.chr).collect::<String>();
                    for corners in glyphs.chunks(4) {
                        let middle =
                            corners.iter().fold(Vec2::ZERO, |sum, v| sum + v.pos.to_vec2()) / corners.len() as f32;
                        let color = match text.override_text_color {
                            Some(color) => color,
                            None if corners[0].color == Color32::PLACEHOLDER => text.fallback_color,
                            None => corners[0].color,
                        };
                        let color = color.gamma_multiply(text.opacity_factor);
                        self.judge(&said, row.row.size.y, color, origin + middle, clip);
                    }
                }
            }
            _ => {}
        }
    }

    fn judge(&mut self, said: &str, height: f32, color: Color32, place: Pos2, clip: Rect) {
        let is_seen = clip.contains(place) && color.a() > 0;
        // WCAG exempts controls that cannot be used.
        if !is_seen || self.disabled.iter().any(|area| area.contains(place)) {
            return;
        }
        let Some(ground) = self.behind(place) else { return };
        let is_icon = said.chars().all(|c| ICONS.contains(&c));
        let required = if is_icon || height >= LARGE_HEIGHT { LARGE } else { TEXT };
        let seen = over(color, ground);
        let ratio = contrast(seen, ground);
        let least = self.found.entry(said.to_owned()).or_insert((f64::INFINITY, required, [seen, ground]));
        if ratio < least.0 {
            *least = (ratio, required, [seen, ground]);
        }
    }
}

/// All texts of the last frame that are too faint, each in a line.
fn faint(window: &Window) -> (usize, Vec<String>) {
    let disabled = window.harness.root().children_recursive().filter(|node| node.accesskit_node().is_disabled());
    let mut reader = Reader {
        painted: Vec::new(),
        ground: window.harness.ctx.global_style().visuals.panel_fill,
        disabled: disabled.map(|node| node.rect()).collect(),
        found: BTreeMap::new(),
    };
    for ClippedShape { clip_rect, shape, .. } in &window.harness.output().shapes {
        reader.read(shape, *clip_rect);
    }
    let hex = |color: Color32| format!("{:02x}{:02x}{:02x}", color.r(), color.g(), color.b());
    let too_faint = reader.found.iter().filter(|(_, (ratio, required, _))| ratio < required);
    let lines = too_faint.map(|(said, (ratio, required, [text, ground]))| {
        format!("`{said}` {} on {}: {ratio:.2}, at least {required}", hex(*text), hex(*ground))
    });
    (reader.found.len(), lines.collect())
}

/// Waits for the verdict.
fn judged(window: &mut Window) {
    for _ in 0..1200 {
        window.steps(1);
        if !window.app().state(&window.harness.ctx)["exercise"]["verdict"].is_null() {
            return window.steps(2);
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    panic!("no verdict");
}

/// Goes through a window in both themes: each step is a widget to click.
fn check(input: &str, steps: &[&str]) {
    let mut complaints = Vec::new();
    for theme in [Theme::Light, Theme::Dark] {
        let mut window = Window::with(input, vec2(1280.0, 900.0));
        for _ in 0..600 {
            window.steps(1);
            if window.app().session().loaded.is_some() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        window.steps(4);
        if window.harness.ctx.theme() != theme {
            window.click_at(window.center("theme"));
        }
        for step in steps {
            window.click_at(window.center(step));
            window.move_to(Pos2::new(4.0, 4.0));
            // Menus have faded in, and the next click is not part of a double click.
            window.steps(30);
            if *step == "check" {
                judged(&mut window);
            }
            let (texts, lines) = faint(&window);
            assert!(texts > 5, "{step}: only {texts} texts");
            complaints.extend(lines.into_iter().map(|line| format!("{theme:?}, {step}: {line}")));
        }
    }
    complaints.dedup();
    assert!(complaints.is_empty(), "{}\n{} texts are too faint", complaints.join("\n"), complaints.len());
}

#[test]
fn text_on_the_panels_can_be_read() {
    check(
        "builtin:still-life",
        &[
            "tab-lights",
            "light-0-on",
            "tab-objects",
            "tab-camera",
            "tab-picture",
            "tab-probe",
            "pane-0",
            "tab-compare",
            "tab-frame",
        ],
    );
}

#[test]
fn terms_that_are_off_can_be_read() {
    check("builtin:cube", &["term-diffuse", "term-specular", "term-ambient"]);
}

#[test]
fn text_of_exercises_can_be_read() {
    check("builtin:cube", &["exercises", "exercise-ex04", "check"]);
}

#[test]
fn without_renderdoc_the_button_for_captures_is_reached_by_tab_and_says_what_to_do() {
    let mut window = Window::with("builtin:cube", vec2(1280.0, 900.0));
    window.click_at(window.center("tab-frame"));
    for _ in 0..600 {
        window.steps(1);
        if window.app().session().recorded_frame.is_some() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    window.steps(2);
    assert_eq!(window.widget("capture").label, "Capture with RenderDoc");
    for _ in 0..200 {
        if window.widget("capture").focused {
            break;
        }
        window.press(Modifiers::NONE, Key::Tab);
    }
    window.press(Modifiers::NONE, Key::Enter);
    let session = window.app().session();
    let messages: Vec<&str> = session.messages.list().iter().map(|message| message.text.as_str()).collect();
    let expected = "RenderDoc must be loaded when the window starts: run `LD_PRELOAD=librenderdoc.so gonio view` to capture frames";
    assert_eq!(messages, [expected]);
    assert_eq!(session.asking, None, "no path is asked for");
}

/// A frame of some widgets; returns what the mirror is told.
fn frame(mirror: &mut TreeMirror, ctx: &egui::Context, add: impl Fn(&mut egui::Ui)) -> Option<MirrorChange> {
    let mut output = ctx.run_ui(egui::RawInput::default(), |ui| add(ui));
    // Nothing is drawn.
    output.textures_delta.clear();
    mirror.change(output.platform_output.accesskit_update.take().unwrap_or_else(|| panic!("no tree")), 1.0)
}

#[test]
fn the_mirror_is_told_of_changes_only() {
    let ctx = egui::Context::default();
    ctx.enable_accesskit();
    let mut mirror = TreeMirror::default();
    let widgets = |on: bool, last: bool| {
        move |ui: &mut egui::Ui| {
            let mut on = on;
            ui.label("Words");
            let _ = ui.button("Press");
            ui.checkbox(&mut on, "Check");
            let name = ui.label("Speed");
            ui.add(egui::DragValue::new(&mut 3.5)).labelled_by(name.id);
            if last {
                let _ = ui.button("Last");
            }
        }
    };
    // The layout settles.
    let mut all: BTreeMap<String, MirrorNode> = BTreeMap::new();
    for _ in 0..4 {
        for node in frame(&mut mirror, &ctx, widgets(true, true)).into_iter().flat_map(|change| change.nodes) {
            all.insert(node.id.clone(), node);
        }
    }
    let by_name = |name: &str, kind: MirrorKind| {
        all.values().find(|n| n.name == name && n.kind == kind).cloned().unwrap_or_else(|| panic!("{name}: {all:#?}"))
    };
    assert!(!by_name("Words", MirrorKind::Text).focusable);
    let press = by_name("Press", MirrorKind::Button);
    assert!(press.focusable && !press.disabled && press.rect[2] > 10 && press.rect[3] > 10, "{press:?}");
    let check = by_name("Check", MirrorKind::CheckBox);
    assert_eq!(check.on, Some(true));
    assert_eq!(by_name("Speed", MirrorKind::Number).number, Some(3.5));
    let last = by_name("Last", MirrorKind::Button);
    // Everything has a place in the tree.
    let children: Vec<&String> = all.values().flat_map(|node| &node.children).collect();
    assert!(all.keys().filter(|id| !children.contains(id)).count() == 1, "only the root has no parent");
    // Nothing changes: nothing is told.
    assert_eq!(frame(&mut mirror, &ctx, widgets(true, true)), None);
    let change = frame(&mut mirror, &ctx, widgets(false, true)).unwrap_or_else(|| panic!("a switch is not told"));
    assert_eq!(change.nodes.iter().map(|node| (&node.id, node.on)).collect::<Vec<_>>(), [(&check.id, Some(false))]);
    assert!(change.removed.is_empty());
    let change = frame(&mut mirror, &ctx, widgets(false, false)).unwrap_or_else(|| panic!("an end is not told"));
    assert_eq!(change.removed, [last.id]);
    assert!(change.nodes.iter().all(|node| node.kind == MirrorKind::Group), "{:?}", change.nodes);
}

#[test]
fn luminance_is_that_of_the_standard() {
    // WCAG's own extremes, and a grey that is known to just pass on white.
    assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
    assert!((contrast(Color32::from_gray(0x76), Color32::WHITE) - 4.54).abs() < 0.005);
}
