//! The keyboard focus: a ring around the focused control.

use crate::theme::colors;
use egui::{Context, CornerRadius, Event, Id, Key, LayerId, Order, Stroke, StrokeKind};

/// Width of the ring, points.
const WIDTH: f32 = 2.0;
/// Keys that move the focus, or act on a focused control.
const KEYS: [Key; 7] =
    [Key::Tab, Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown, Key::Enter, Key::Space];

/// Draws a ring around the focused control while the keyboard is used; called at the end of a frame. A pointer needs no ring.
pub fn ring(ctx: &Context) {
    let key = Id::unique("the keyboard moves the focus");
    let pressed = ctx.input(|input| {
        input.events.iter().rev().find_map(|event| match event {
            Event::Key { key, pressed: true, .. } if KEYS.contains(key) => Some(true),
            Event::PointerButton { pressed: true, .. } => Some(false),
            _ => None,
        })
    });
    let by_keyboard = match pressed {
        Some(by_keyboard) => {
            ctx.data_mut(|data| data.insert_temp(key, by_keyboard));
            by_keyboard
        }
        None => ctx.data(|data| data.get_temp(key).unwrap_or(false)),
    };
    let Some(focused) = ctx.memory(|memory| memory.focused()).filter(|_| by_keyboard) else { return };
    let Some(response) = ctx.read_response(focused) else { return };
    // The visible part of a control that is scrolled half out of sight.
    let rect = response.interact_rect.expand(WIDTH);
    if !rect.is_positive() {
        return;
    }
    let color = colors::ACCENT.in_theme(ctx.theme() == egui::Theme::Dark);
    let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, key));
    painter.rect_stroke(rect, CornerRadius::same(4), Stroke::new(WIDTH, color), StrokeKind::Middle);
}

/// The control with the focus in the last frame, and the one that Escape took it from.
#[derive(Clone, Copy, Default)]
struct LeftFocus {
    last: Option<Id>,
    left: Option<Id>,
}

/// Lets Tab go on from the control that Escape has left, which may be an editor that keeps Tab for itself; called at the start
/// of a frame. egui would begin with the first control again.
pub fn resume(ctx: &Context) {
    let key = Id::unique("the control that Escape left");
    let mut state: LeftFocus = ctx.data(|data| data.get_temp(key)).unwrap_or_default();
    let (escape, tab, click) =
        ctx.input(|input| (input.key_pressed(Key::Escape), input.key_pressed(Key::Tab), input.pointer.any_pressed()));
    if let Some(focused) = ctx.memory(|memory| memory.focused()) {
        state = LeftFocus { last: Some(focused), left: None };
    } else if click {
        state = LeftFocus::default();
    } else {
        if escape {
            state.left = state.last.take();
        }
        if let Some(left) = state.left.take_if(|_| tab) {
            ctx.memory_mut(|memory| memory.request_focus(left));
            // egui moves the focus already; an editor would indent its line.
            ctx.input_mut(|input| {
                input.events.retain(|event| !matches!(event, Event::Key { key: Key::Tab, pressed: true, .. }));
            });
        }
    }
    ctx.data_mut(|data| data.insert_temp(key, state));
}

/// Lets double clicks be recognised at any frame rate: at 5 frames per second, the two clicks of one are up to four frames apart.
pub fn allow_slow_double_clicks(ctx: &Context) {
    /// egui's own value, seconds.
    const USUAL: f64 = 0.3;
    const LONGEST: f64 = 1.2;
    let frame = ctx.input(|input| f64::from(input.unstable_dt));
    ctx.options_mut(|options| {
        options.input_options.max_double_click_delay = (4.0 * frame).clamp(USUAL, LONGEST);
    });
}
