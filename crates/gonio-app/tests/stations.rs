//! The stations beyond the rendering equation as a user works with them: the whole application, without a window.
#![allow(missing_docs, clippy::unwrap_used)]

mod support;

use egui::{Vec2, vec2};
use gonio_app::exported;
use gonio_app::files::link::StationLink;
use serde_json::Value;
use std::time::Duration;
use support::Window;

const DESK: Vec2 = vec2(1280.0, 800.0);
const PHONE: Vec2 = vec2(390.0, 844.0);
/// Frames that a result may take; each waits a little.
const FRAMES: usize = 6000;

impl Window {
    fn stations(size: Vec2) -> Self {
        let mut window = Window::with("builtin:cube", size);
        if size.x < 560.0 {
            window.click("menu");
        }
        window.click("stations");
        window.until("the picture", |room| room["picture"]["serial"].as_u64() > Some(0));
        window
    }

    fn click(&mut self, id: &str) {
        let at = self.center(id);
        self.click_at(at);
        // A pause, so that the next click is not part of a double click.
        self.steps(30);
    }

    /// Waits until the room's state fulfils a condition.
    fn until(&mut self, what: &str, expected: impl Fn(&Value) -> bool) -> Value {
        for _ in 0..FRAMES {
            let state = self.app().state(&self.harness.ctx)["stations"].clone();
            if expected(&state) {
                return state;
            }
            std::thread::sleep(Duration::from_millis(10));
            self.steps(1);
        }
        panic!("{what}: {}", self.app().state(&self.harness.ctx)["stations"]);
    }
}

fn is_checked(room: &Value) -> bool {
    room["checks"].as_array().is_some_and(|checks| checks.iter().all(|check| check["holds"] == true))
}

#[test]
fn every_station_shows_its_picture_plot_and_checks() {
    let mut window = Window::stations(DESK);
    let names = window.until("the list", |room| room["stations"][9].is_string())["stations"].clone();
    for name in names.as_array().unwrap().iter().map(|name| name.as_str().unwrap()) {
        window.click(&format!("station-{name}"));
        let room = window.until(name, |room| {
            room["picture"]["newest"] == true && room["plot"]["serial"].as_u64() > Some(0) && is_checked(room)
        });
        assert_eq!((&room["chosen"], &room["plot"]["error"]), (&name.into(), &Value::Null));
    }
}

#[test]
fn a_value_changes_the_picture_the_plot_and_the_checks() {
    let mut window = Window::stations(DESK);
    window.click("station-interference");
    let before = window.until("the checks", is_checked);
    window.click("parameter-thickness");
    window.press(egui::Modifiers::COMMAND, egui::Key::A);
    window.harness.event(egui::Event::Text("300".to_owned()));
    window.press(egui::Modifiers::NONE, egui::Key::Enter);
    let after = window.until("the new checks", |room| room["values"]["thickness"] == 300.0 && is_checked(room));
    assert_ne!(before["checks"][0]["expected"], after["checks"][0]["expected"]);
    assert!(after["plot"]["serial"].as_u64() > before["plot"]["serial"].as_u64());
    assert!(after["picture"]["serial"].as_u64() > before["picture"]["serial"].as_u64());
}

#[test]
fn a_film_runs_until_it_is_stopped_and_the_work_until_it_is_paused() {
    let mut window = Window::stations(DESK);
    window.click("station-doppler");
    let speed = window.until("the values", |room| room["values"]["speed"].is_number())["values"]["speed"].clone();
    window.click("film");
    window.until("two frames", |room| {
        let now = room["values"]["speed"].as_f64().unwrap();
        room["playing"] == true && (now - speed.as_f64().unwrap()).abs() > 0.015
    });
    window.click("film");
    let room = window.until("the end", |room| room["playing"] == false && room["picture"]["newest"] == true);
    assert_eq!(room["running"], true);
    window.click("pause");
    let paused = window.until("the pause", |room| room["running"] == false);
    assert_eq!(paused["paused"], true);
    std::thread::sleep(Duration::from_millis(300));
    window.steps(30);
    let later = window.until("the same", |_| true);
    assert_eq!(later["picture"]["samples"], paused["picture"]["samples"]);
    window.click("pause");
    window.until("more samples", |room| room["picture"]["samples"].as_u64() > paused["picture"]["samples"].as_u64());
    window.click("leave");
    let left = window.until("the scene", |room| room["open"] == false);
    assert_eq!(left["running"], false);
    window.widget("exercises");
}

#[test]
fn on_a_phone_the_picture_stays_above_the_pages() {
    let mut window = Window::stations(PHONE);
    for page in ["sliders", "text", "law", "stations"] {
        window.click(&format!("page-{page}"));
        let [left, top, width, height] = window.widget("station-picture").rect;
        assert!(left >= 0.0 && top >= 0.0 && width > 300.0 && top + height < 460.0, "{page}: {width} x {height}");
    }
    window.click("station-polarisation");
    window.click("page-law");
    window.widget("station-plot");
}

#[test]
fn every_picture_of_a_station_is_shown() {
    let mut window = Window::stations(DESK);
    window.click("station-interference");
    let names: Vec<String> = exported::widgets(&window.harness.ctx)
        .iter()
        .filter_map(|widget| widget.id.strip_prefix("picture-").map(str::to_owned))
        .collect();
    assert_eq!(names, ["wand", "bubbles", "puddle", "disc"]);
    for name in names {
        window.click(&format!("picture-{name}"));
        window.until(&name, |room| room["picture"]["name"] == name.as_str() && room["picture"]["newest"] == true);
    }
}

#[test]
fn a_finished_picture_is_not_drawn_again() {
    let mut window = Window::stations(PHONE);
    window.click("station-phosphorescence");
    let done = window.until("the last sample", |room| room["running"] == false && is_checked(room));
    assert_eq!((&done["chosen"], &done["picture"]["samples"]), (&"phosphorescence".into(), &64.into()));
    // Frames are drawn only if something requests them.
    window.harness.run();
    let before = window.app().session().facts.frames;
    window.harness.run();
    let after = window.app().session().facts.frames;
    assert!(after <= before + 2, "{before} {after}");
    assert_eq!(window.until("the same", |_| true)["picture"], done["picture"]);
}

#[test]
fn a_link_opens_a_station_with_its_values_and_names_what_is_wrong() {
    let mut window = Window::with("builtin:cube", DESK);
    let mut open = |fragment: &str| {
        let link = StationLink::parse(fragment).unwrap();
        window.harness.state_mut().as_mut().unwrap().begin_stations(link);
        window.steps(2);
        let room = window.until("the list", |room| !room["chosen"].is_null());
        let texts =
            window.app().session().messages.list().iter().map(|message| message.text.clone()).collect::<Vec<_>>();
        (room, texts.join(" "))
    };
    let (room, messages) = open("#station=fog:density=0.2,g=-0.5");
    assert_eq!(
        [&room["chosen"], &room["values"]["density"], &room["values"]["g"]],
        [&"fog".into(), &0.2.into(), &(-0.5).into()] as [&Value; 3]
    );
    assert_eq!(messages, "");
    open("#station=polarisation:angle=999");
    open("#station=lake");
    let (room, messages) = open("#station=");
    assert_eq!((&room["chosen"], &room["values"]["angle"]), (&"polarisation".into(), &90.0.into()));
    assert!(messages.contains("`999`") && messages.contains("from 0 to 180 degrees"), "{messages}");
    assert!(messages.contains("unknown station `lake`"), "{messages}");
}
