//! The panels around the picture.

mod camera;
mod compare;
mod dialogs;
mod equation;
mod file;
mod frame;
mod lights;
mod messages;
mod objects;
mod picture;
mod probe;
mod shaders;
mod status;
mod top_bar;

pub use dialogs::path_field;
pub use messages::show as messages;
pub use picture::environment_image;

use crate::action::Action;
use crate::baking;
use crate::document::{Document, History};
use crate::environment;
use crate::exported::{self, WidgetRole};
use crate::platform::Purpose;
use crate::session::{Session, Tab};
use crate::theme::{colors, touch};
use egui::{Color32, FontId, Frame, Margin, Panel, Rect, ScrollArea, Sense, Ui, Vec2, Visuals, WidgetInfo, vec2};

/// Below this width (points) the side panel is below the picture: a phone in portrait orientation.
const NARROW: f32 = 720.0;
const SIDE_WIDTH: f32 = 352.0;
/// Its width in a window of little height, whose tabs are as large as fingers.
const LOW_SIDE_WIDTH: f32 = 392.0;
/// The share of a phone's height that the atlas has.
const ATLAS_SHARE: f32 = 0.56;
/// Least height of the texts of shaders with their values.
const TEXTS_HEIGHT: f32 = 400.0;
/// Font size of the tabs' names, and the range of gaps between them.
const TAB_SIZE: f32 = 12.5;
/// Font size with more tabs than there is room for, so that they stay in one line.
const SMALL_TAB_SIZE: f32 = 11.5;
const TAB_GAP: std::ops::RangeInclusive<f32> = 3.0..=14.0;

/// The background of the panels. The window is cleared with it and panels draw no background, because filling half the window
/// takes a software driver milliseconds per frame.
pub fn ground(visuals: &Visuals) -> Color32 {
    visuals.panel_fill
}

/// Shows everything but the pictures, on [`ground`].
pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, history: &History, actions: &mut Vec<Action>) {
    let narrow = ui.available_width() < NARROW;
    let bar = Frame::NONE.inner_margin(Margin::symmetric(10, 5));
    Panel::top("top bar").frame(bar).resizable(false).show(ui, |ui| {
        top_bar::show(ui, document, session, history, actions);
    });
    Panel::top("equation").frame(bar).resizable(false).show(ui, |ui| {
        equation::show(ui, document, session, actions);
    });
    Panel::bottom("status").frame(bar).resizable(false).show(ui, |ui| {
        status::show(ui, session);
    });
    if status::period(document, session).is_some() {
        Panel::bottom("time").frame(bar).resizable(false).show(ui, |ui| {
            ui.horizontal(|ui| status::show_time(ui, document, session, actions));
        });
    }
    messages(ui, &session.messages, actions);
    let inside = Frame::NONE.inner_margin(Margin::symmetric(10, 8));
    if narrow {
        let is_atlas = session.tab == Tab::Bake && session.baking.shows_atlas && !is_landscape(ui);
        let share = if is_atlas && baking::shows_atlas(session) { ATLAS_SHARE } else { 0.42 };
        let height = share * ui.available_height();
        Panel::bottom("side").frame(inside).exact_size(height).show(ui, |ui| side(ui, document, session, actions));
        if baking::shows_atlas(session) && is_landscape(ui) {
            atlas(ui, session);
        }
    } else {
        let panel = Panel::right("side").frame(inside);
        let panel = match touch::is_low(ui.ctx()) {
            true => panel.exact_size(LOW_SIDE_WIDTH),
            false => panel.default_size(SIDE_WIDTH).size_range(280.0..=560.0),
        };
        panel.show(ui, |ui| side(ui, document, session, actions));
        if baking::shows_atlas(session) {
            atlas(ui, session);
        } else if let Some(shaders) = session.shaders.as_mut().filter(|shaders| shaders.is_reading()) {
            let width = (0.52 * ui.available_width()).max(260.0);
            let panel = Panel::left("shader texts").frame(inside).default_size(width).size_range(240.0..=1200.0);
            panel.show(ui, |ui| shaders::texts(ui, shaders));
        }
    }
    dialogs::help(ui, session);
    path_field(ui, session, Purpose::Scene, actions);
}

/// The atlas at the left of the scene.
fn atlas(ui: &mut Ui, session: &mut Session) {
    let inside = Frame::NONE.inner_margin(Margin::symmetric(8, 6));
    let width = ui.available_width();
    let most = (width - 120.0).max(160.0);
    let panel = Panel::left("atlas").frame(inside).default_size(0.5 * width).size_range(160.0..=most);
    panel.show(ui, |ui| baking::view(ui, session));
}

/// Whether a narrow window has room for the atlas beside the scene.
fn is_landscape(ui: &Ui) -> bool {
    let size = ui.ctx().content_rect().size();
    size.x > size.y
}

/// The tabs, and the panel of the selected one.
fn side(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    tabs(ui, session, actions);
    ui.separator();
    let is_narrow = ui.ctx().content_rect().width() < NARROW;
    let reading = session.shaders.as_mut().filter(|shaders| is_narrow && shaders.is_reading());
    if let Some(shaders) = reading.filter(|_| session.tab == Tab::Shaders) {
        // Steps, text, variables and messages need more room than the panel of a phone has.
        let height = ui.available_height().max(TEXTS_HEIGHT);
        ScrollArea::vertical().id_salt("shader texts").auto_shrink([false, false]).show(ui, |ui| {
            ui.set_max_height(height);
            shaders::texts(ui, shaders);
        });
        return;
    }
    if session.tab == Tab::Bake {
        let has_atlas = is_narrow && !is_landscape(ui);
        return baking::panel(ui, document, session, has_atlas, actions);
    }
    if session.tab == Tab::File {
        return file::show(ui, session, is_narrow, actions);
    }
    ScrollArea::vertical().id_salt(session.tab.title()).auto_shrink([false, false]).show(ui, |ui| match session.tab {
        Tab::Lights => lights::show(ui, document, session, actions),
        Tab::Objects => objects::show(ui, document, session, actions),
        Tab::Camera => camera::show(ui, document, session, actions),
        Tab::Picture => picture::show(ui, document, session, actions),
        Tab::Probe => probe::show(ui, document, session, actions),
        Tab::Compare => compare::show(ui, document, session, actions),
        Tab::Frame => frame::show(ui, document, session, actions),
        Tab::Shaders => shaders::show(ui, session, document.panes.current, actions),
        Tab::Environment => environment::panel(ui, document, session, actions),
        // They scroll themselves.
        Tab::Bake | Tab::File => {}
    });
}

/// The tabs, side by side over the whole width; the selected one is underlined. It is not bold, so that the others do not move.
fn tabs(ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
    let color = |ui: &Ui, chosen| if chosen { colors::ACCENT.of(ui) } else { ui.visuals().text_color() };
    let seen = || {
        Tab::ALL.into_iter().filter(|tab| match tab {
            Tab::Shaders => session.shaders.is_some(),
            Tab::Bake => session.baking.is_open,
            Tab::Environment => session.environment.is_open,
            _ => true,
        })
    };
    let laid_out = |size: f32| {
        let name = |tab: Tab| {
            let color = color(ui, session.tab == tab);
            ui.painter().layout_no_wrap(tab.title().into(), FontId::proportional(size), color)
        };
        let names: Vec<_> = seen().map(name).collect();
        let all: f32 = names.iter().map(|name| name.size().x.max(touch::least(ui))).sum();
        (names, all)
    };
    let gaps = seen().count().saturating_sub(1).max(1) as f32;
    let (mut names, mut all) = laid_out(TAB_SIZE);
    if all + gaps * TAB_GAP.start() > ui.available_width() {
        (names, all) = laid_out(SMALL_TAB_SIZE);
    }
    let gap = ((ui.available_width() - all) / gaps).floor().clamp(*TAB_GAP.start(), *TAB_GAP.end());
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(gap, 2.0);
        for (tab, name) in seen().zip(names) {
            let chosen = session.tab == tab;
            let size = vec2(name.size().x, TAB_SIZE + 11.0).max(Vec2::splat(touch::least(ui)));
            let (rect, button) = ui.allocate_exact_size(size, Sense::click());
            button.widget_info(|| WidgetInfo::selected(egui::Role::Tab, true, chosen, tab.title()));
            let color = if button.hovered() { ui.visuals().strong_text_color() } else { color(ui, chosen) };
            let place = vec2(0.5 * (size.x - name.size().x), 0.5 * (size.y - TAB_SIZE - 11.0) + 2.0);
            ui.painter().galley_with_override_text_color(rect.min + place, name, color);
            if chosen || button.has_focus() {
                let line = Rect::from_min_max(rect.left_bottom() - vec2(0.0, 2.0), rect.right_bottom());
                ui.painter().rect_filled(line, 1.0, color);
            }
            let button = button.on_hover_text(tab.description());
            exported::note(ui, &button, &format!("tab-{}", tab.id()), WidgetRole::Tab, tab.title(), chosen);
            if button.clicked() {
                actions.push(Action::Show(tab));
            }
        }
    });
}
