//! Screen readers in the page: egui's accessibility tree goes to a mirror of hidden elements (`web/page/access.js`), and what is
//! done with those comes back as events.

use eframe::egui::accesskit::{Action, ActionData, ActionRequest, NodeId, TreeId};
use eframe::egui::{self, Event, FullOutput, Key, Modifiers, RawInput};
use gonio_app::mirror::TreeMirror;
use std::cell::RefCell;
use wasm_bindgen::prelude::*;

/// The page's side of the mirror.
#[derive(Default)]
struct Mirror {
    /// Receives changes as JSON; absent while support for screen readers is off.
    receive: Option<js_sys::Function>,
    /// Events for the next frame.
    events: Vec<Event>,
    has_focus: bool,
}

thread_local! {
    // The plugin must be `Send`, and the page's functions are not; a page has one thread.
    static MIRROR: RefCell<Mirror> = RefCell::default();
}

fn with_mirror<T>(act: impl FnOnce(&mut Mirror) -> T) -> T {
    MIRROR.with(|mirror| act(&mut mirror.borrow_mut()))
}

/// Sends the accessibility tree of each frame to the mirror.
#[derive(Default)]
struct MirrorPlugin {
    tree: TreeMirror,
}

impl egui::Plugin for MirrorPlugin {
    fn debug_name(&self) -> &'static str {
        "mirror for screen readers"
    }

    fn output_hook(&mut self, ctx: &egui::Context, output: &mut FullOutput) {
        let Some(update) = output.platform_output.accesskit_update.take() else { return };
        let Some(receive) = with_mirror(|mirror| mirror.receive.clone()) else { return };
        let Some(change) = self.tree.change(update, f64::from(ctx.zoom_factor())) else { return };
        if let Ok(text) = serde_json::to_string(&change) {
            // The page applies it after the frame; a failure is reported there.
            let _ = receive.call1(&JsValue::NULL, &text.into());
        }
    }
}

/// Starts the mirror: `receive` gets each change as JSON (`gonio_app::mirror::MirrorChange`), first all elements.
pub fn start(ctx: &egui::Context, receive: js_sys::Function) {
    with_mirror(|mirror| mirror.receive = Some(receive));
    resume(ctx);
}

/// Starts it again, in a new context, if it is on.
pub fn resume(ctx: &egui::Context) {
    if with_mirror(|mirror| mirror.receive.is_none()) {
        return;
    }
    ctx.add_plugin(MirrorPlugin::default());
    // Of two plugins of one type, the first stays; its elements are told anew.
    ctx.with_plugin(|plugin: &mut MirrorPlugin| plugin.tree = TreeMirror::default());
    ctx.enable_accesskit();
    ctx.request_repaint();
}

/// Ends it.
pub fn stop(ctx: &egui::Context) {
    with_mirror(|mirror| *mirror = Mirror::default());
    ctx.disable_accesskit();
}

/// Notes whether an element of the mirror has the page's focus.
pub fn set_focus(has_focus: bool) {
    with_mirror(|mirror| mirror.has_focus = has_focus);
}

/// An action on an element, by AccessKit's names; false if there is no such action or element.
pub fn act(id: &str, action: &str, value: &JsValue) -> bool {
    let Ok(target_node) = id.parse().map(NodeId) else { return false };
    let action = match action {
        "click" => Action::Click,
        "focus" => Action::Focus,
        "scroll-into-view" => Action::ScrollIntoView,
        "set-value" => Action::SetValue,
        "increment" => Action::Increment,
        "decrement" => Action::Decrement,
        _ => return false,
    };
    let number = value.as_f64().map(ActionData::NumericValue);
    let data = number.or_else(|| value.as_string().map(|text| ActionData::Value(text.into())));
    let request = ActionRequest { action, target_tree: TreeId::ROOT, target_node, data };
    with_mirror(|mirror| mirror.events.push(Event::AccessKitActionRequest(request)));
    true
}

/// A key pressed on an element that has no use for it, by the name in its event; false if the application knows no such key.
pub fn key(name: &str, [ctrl, shift, alt, meta]: [bool; 4]) -> bool {
    let Some(key) = Key::from_name(name) else { return false };
    let modifiers = Modifiers { alt, ctrl, shift, mac_cmd: meta, command: ctrl || meta };
    let event = |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
    let events =
        [Event::ModifiersChanged(modifiers), event(true), event(false), Event::ModifiersChanged(Modifiers::NONE)];
    with_mirror(|mirror| mirror.events.extend(events));
    true
}

/// Adds the mirror's events to a frame's. While an element of the mirror has the focus, so has the application.
pub fn add_events(input: &mut RawInput) {
    with_mirror(|mirror| {
        if mirror.has_focus {
            input.focused = true;
            input.events.retain(|event| !matches!(event, Event::WindowFocused(false)));
        }
        input.events.append(&mut mirror.events);
    });
}
