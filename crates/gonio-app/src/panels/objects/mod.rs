//! Objects: models, their transformations and materials.

mod material;
mod parts;

use crate::action::Action;
use crate::document::Document;
use crate::exported::{self, WidgetRole};
use crate::session::{Selection, Session};
use crate::theme::{self, colors, icons};
use crate::widgets::{
    NO_BREAK, NumberField, Vector, choice, compact, grouped, heading, icon_button, named_options, row, toggle,
};
use egui::{Align, Atom, Button, Frame, Label, Layout, Margin, RichText, TextEdit, Ui, WidgetInfo, vec2};
use glam::DVec3;
use gonio_language::tr;
use gonio_scene::scene_file::{MaterialOverride, MotionSpec, Normals, ObjectSpec, Shading, UpAxis};
use gonio_scene::settings::{Aim, CameraSettings};
use gonio_scene::{Scene, files};

pub fn show(ui: &mut Ui, document: &mut Document, session: &mut Session, actions: &mut Vec<Action>) {
    let loaded = session.loaded.clone();
    if loaded.is_none() {
        return;
    }
    let count = document.scene.objects.len();
    let mut requested = None;
    for index in 0..count {
        ui.push_id(index, |ui| {
            let selected = session.selection.object() == Some(index);
            title(ui, document, session, loaded.as_deref(), index, selected);
            if selected {
                let asked = details(ui, document, session, index, count);
                requested = requested.take().or(asked);
            }
        });
    }
    if let Some(edit) = requested {
        apply(document, session, edit);
    }
    add(ui, document, session);
    ui.add_space(8.0);
    let icon = RichText::new(icons::CHECKERBOARD).font(theme::icon_font(15.0));
    let bake = ui.button((icon, tr!("scene-bake-textures")));
    bake.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, tr!("scene-bake-textures")));
    exported::note(ui, &bake, "bake-textures", WidgetRole::Button, tr!("scene-bake-textures"), "");
    let tip = tr!("scene-unwrap-the-objects-and-bake-their");
    if bake.on_hover_text(tip).clicked() {
        actions.push(Action::ShowBake);
    }
}

/// The name with the number of triangles, over the whole line.
fn title(
    ui: &mut Ui,
    document: &Document,
    session: &mut Session,
    loaded: Option<&Scene>,
    index: usize,
    selected: bool,
) {
    let Some(spec) = document.scene.objects.get(index) else { return };
    let mesh = loaded.and_then(|l| l.meshes.get(l.objects.get(index)?.mesh));
    let size = mesh.map_or(String::new(), |mesh| {
        tr!("scene-triangles-2", count = grouped(mesh.triangle_count() as u64, NO_BREAK))
    });
    let toggle_open = ui
        .horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            let mut toggled = false;
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let caret = if selected { icons::CARET_UP } else { icons::CARET_DOWN };
                let tip = tr!("scene-properties-of", name = spec.name);
                toggled |= icon_button(ui, &format!("object-{index}-open"), caret, &tip).clicked();
                ui.label(RichText::new(size).small().weak());
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    let icon = RichText::new(icons::CUBE).font(theme::icon_font(15.0));
                    let width = ui.available_width();
                    ui.spacing_mut().button_padding.x = 3.0;
                    let button = Button::new((icon, RichText::new(&spec.name), Atom::grow()))
                        .frame_when_inactive(selected)
                        .truncate();
                    let response = ui.add(button.min_size(vec2(width, theme::touch::least(ui).max(24.0))));
                    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, selected, &spec.name));
                    exported::note(ui, &response, &format!("object-{index}"), WidgetRole::Button, &spec.name, selected);
                    toggled |= response.clicked();
                    response.on_hover_text(&spec.model);
                });
            });
            toggled
        })
        .inner;
    if toggle_open {
        session.selection = if selected { Selection::None } else { Selection::Object(index) };
    }
}

fn details(ui: &mut Ui, document: &mut Document, session: &mut Session, index: usize, count: usize) -> Option<Edit> {
    let shared = session.loaded.clone();
    let loaded = shared.as_deref();
    let has_environment = document.scene.environment.is_some();
    let mut wants_sky = false;
    let spec = document.scene.objects.get_mut(index)?;
    let frame = Frame::NONE.fill(ui.visuals().faint_bg_color).corner_radius(6).inner_margin(Margin::symmetric(8, 6));
    let edit = frame
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 4.0;
            place(ui, spec, index);
            motion(ui, spec, index);
            surface(ui, spec, loaded, index);
            if let Some(loaded) = loaded {
                material(ui, spec, loaded, &mut session.selection, index);
            }
            if !has_environment && spec.materials().any(material::mirrors_surroundings) {
                wants_sky = without_surroundings(ui, index);
            }
            tools(ui, index, count)
        })
        .inner;
    if wants_sky {
        document.scene.set_environment("sky");
    }
    edit
}

/// The list of the parts, and the material of the selected one or of all.
fn material(ui: &mut Ui, spec: &mut ObjectSpec, loaded: &Scene, selection: &mut Selection, index: usize) {
    let parts = loaded.objects.get(index).map_or(0, |object| object.parts.len());
    let selected = selection.part().map(|[_, part]| part).filter(|part| parts > 1 && *part < parts);
    match parts::list(ui, loaded, index, selected) {
        Some(Some(part)) => *selection = Selection::Part(index, part),
        Some(None) => *selection = Selection::Object(index),
        None => {}
    }
    if let Some(part) = selected {
        parts::material_of(ui, spec, loaded, index, part);
        return;
    }
    let files = loaded.materials_in_file(index);
    heading(ui, tr!("scene-material"));
    material::show(ui, &mut spec.material, &MaterialOverride::default(), &files, index);
}

/// Says why glass and mirrors look flat without an environment. Returns whether to add one.
fn without_surroundings(ui: &mut Ui, index: usize) -> bool {
    let text = tr!("scene-there-is-no-environment-so-this");
    let label = ui.add(Label::new(RichText::new(text).color(colors::WARNING.of(ui))).wrap());
    exported::note(ui, &label, &format!("object-{index}-no-environment"), WidgetRole::Text, text, "");
    let add = ui.button(tr!("scene-add-a-sky"));
    exported::note(ui, &add, &format!("object-{index}-add-sky"), WidgetRole::Button, tr!("scene-add-a-sky"), "");
    add.clicked()
}

fn place(ui: &mut Ui, spec: &mut ObjectSpec, index: usize) {
    let id = |name: &str| format!("object-{index}-{name}");
    row(ui, tr!("scene-name"), tr!("scene-used-in-reports-and-opengl-debug"), |ui| {
        let edit = TextEdit::singleline(&mut spec.name).id_salt("name");
        let response = ui.add(edit.desired_width(ui.available_width() - 8.0));
        exported::note(ui, &response, &id("name"), WidgetRole::Text, "name", &spec.name);
    });
    let tip = tr!("scene-up-axis-tip");
    row(ui, tr!("scene-up-axis"), tip, |ui| {
        choice(ui, &id("up"), tr!("scene-up-axis"), &mut spec.up, &named_options!(UpAxis), UpAxis::Y);
    });
    let tip = tr!("scene-applied-last-in-world-units");
    let mut translate = spec.translate;
    row(ui, tr!("scene-translation"), tip, |ui| {
        Vector::new(&id("translate"), "translation").tip(tip).default([0.0; 3]).show(ui, &mut translate)
    });
    if translate != spec.translate {
        spec.move_to(translate);
    }
    let tip = tr!("scene-about-the-world-s-x-then");
    row(ui, tr!("scene-rotation"), tip, |ui| {
        let id = id("rotate");
        let vector = Vector::new(&id, "rotation").tip(tip).unit("\u{b0}").default([0.0; 3]);
        vector.range(-36000.0..=36000.0).step(0.5).show(ui, &mut spec.rotate)
    });
    let before = spec.scale;
    let tip = tr!("scene-applied-first-per-axis-hold-shift");
    row(ui, tr!("scene-scale"), tip, |ui| {
        Vector::new(&id("scale"), "scale").tip(tip).default([1.0; 3]).step(0.005).show(ui, &mut spec.scale)
    });
    // A scale of 0 would leave no surface to light.
    for (now, before) in spec.scale.iter_mut().zip(before) {
        if *now == 0.0 {
            *now = before;
        }
    }
}

/// The object's motion, which is written in the scene file: whether it moves, and how. It can be stopped and started again.
fn motion(ui: &mut Ui, spec: &mut ObjectSpec, index: usize) {
    let kept = ui.scope_id().with(("motion", &spec.model, &spec.name));
    if let Some(motion) = &spec.motion {
        ui.data_mut(|data| data.insert_temp(kept, motion.clone()));
    }
    let Some(motion) = ui.data(|data| data.get_temp::<MotionSpec>(kept)) else { return };
    let mut moves = spec.motion.is_some();
    row(ui, tr!("scene-motion"), tr!("scene-motion-over-time-as-in-the"), |ui| {
        let id = format!("object-{index}-motion");
        let words = format!("{}, {} s", motion.kind, compact(motion.period));
        if toggle(ui, &id, &words, &mut moves, gonio_language::name(motion.kind.description().trim())) {
            spec.motion = moves.then_some(motion);
        }
    });
}

fn surface(ui: &mut Ui, spec: &mut ObjectSpec, loaded: Option<&Scene>, index: usize) {
    let id = |name: &str| format!("object-{index}-{name}");
    row(ui, tr!("scene-shading"), tr!("scene-where-the-equation-is-evaluated"), |ui| {
        let names = ["flat", tr!("scene-per-face"), "Gouraud", "Phong"];
        let options: Vec<(Shading, &str, &str)> =
            Shading::ALL.iter().zip(names).map(|(shading, name)| (*shading, name, shading.description())).collect();
        choice(ui, &id("shading"), "shading", &mut spec.shading, &options, Shading::Phong);
    });
    row(ui, tr!("scene-normals"), tr!("scene-source-of-the-mesh-s-normals"), |ui| {
        let options = named_options!(Normals);
        choice(ui, &id("normals"), "normals", &mut spec.normals, &options, Normals::File);
    });
    if spec.normals != Normals::Flat {
        let mut angle = spec.crease_angle.unwrap_or(180.0);
        let tip = tr!("scene-edges-with-a-larger-angle-stay");
        let changed = row(ui, tr!("scene-crease-angle-2"), tip, |ui| {
            let id = id("crease-angle");
            let number = NumberField::new(&id, tr!("scene-crease-angle"))
                .tip(tip)
                .unit("\u{b0}")
                .range(0.0..=180.0)
                .default(180.0);
            number.step(1.0).show(ui, &mut angle).changed() || angle != spec.crease_angle.unwrap_or(180.0)
        });
        if changed {
            spec.crease_angle = (angle < 180.0).then_some(angle);
        }
    }
    let mesh = loaded.and_then(|l| l.meshes.get(l.objects.get(index)?.mesh));
    if let Some(mesh) = mesh {
        let text = tr!(
            "scene-triangles-vertices",
            triangles = grouped(mesh.triangle_count() as u64, NO_BREAK),
            vertices = grouped(mesh.positions.len() as u64, NO_BREAK)
        );
        row(ui, tr!("scene-mesh"), tr!("scene-as-it-is-drawn"), |ui| ui.label(RichText::new(text).small().weak()));
    }
}

fn tools(ui: &mut Ui, index: usize, count: usize) -> Option<Edit> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let id = |name: &str| format!("object-{index}-{name}");
        if icon_button(ui, &id("frame"), icons::FRAME_CORNERS, tr!("scene-frame-this-object")).clicked() {
            asked = Some(Edit::Frame(index));
        }
        if icon_button(ui, &id("duplicate"), icons::COPY, tr!("scene-duplicate-this-object")).clicked() {
            asked = Some(Edit::Duplicate(index));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let tip = if count > 1 { tr!("scene-remove-this-object") } else { tr!("scene-a-scene-needs-at-least-one") };
            if crate::widgets::tool_button(ui, &id("remove"), icons::TRASH, tip, None, count > 1).clicked() {
                asked = Some(Edit::Remove(index));
            }
        });
    });
    asked
}

fn add(ui: &mut Ui, document: &mut Document, session: &mut Session) {
    ui.add_space(6.0);
    let icon = RichText::new(icons::PLUS).font(theme::icon_font(13.0));
    let menu = ui.menu_button((icon, RichText::new(tr!("scene-add-a-sample-model"))), |ui| {
        for name in files::builtin_names().into_iter().filter(|name| is_model(name)) {
            let entry = ui.button(&name);
            exported::note(ui, &entry, &format!("add-object-{name}"), WidgetRole::Button, &name, "");
            if entry.clicked() {
                add_model(document, session, &name);
                ui.close();
            }
        }
    });
    exported::note(ui, &menu.response, "add-object", WidgetRole::Button, tr!("scene-add-a-sample-model"), "");
}

/// An edit of the list of objects.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Edit {
    /// Adds a copy beside the object.
    Duplicate(usize),
    /// Removes the object.
    Remove(usize),
    /// Frames the object in the picture.
    Frame(usize),
}

/// Applies an edit.
fn apply(document: &mut Document, session: &mut Session, edit: Edit) {
    let objects = &mut document.scene.objects;
    match edit {
        Edit::Duplicate(index) if index < objects.len() => {
            let bounds = session.loaded.as_ref().and_then(|loaded| bounds_of(loaded, index));
            let width = bounds.map_or(1.0, |(min, max)| 1.15 * (max.x - min.x));
            let mut copy = objects[index].clone();
            copy.name = tr!("scene-copy", copy = copy.name.trim_end_matches(" copy"));
            let [x, y, z] = copy.translate;
            copy.move_to([((x + width) * 1000.0).round() / 1000.0, y, z]);
            objects.insert(index + 1, copy);
            session.selection = Selection::Object(index + 1);
        }
        // A scene has at least one object.
        Edit::Remove(index) if index < objects.len() && objects.len() > 1 => {
            objects.remove(index);
            session.selection = Selection::None;
        }
        Edit::Frame(index) => {
            let Some(loaded) = &session.loaded else { return };
            if let Some(bounds) = bounds_of(loaded, index) {
                document.scene.camera = loaded.with_planes(looking_at(&document.scene.camera, bounds, aspect(session)));
            }
        }
        _ => {}
    }
}

fn aspect(session: &Session) -> f64 {
    let [width, height] = session.facts.size.map(f64::from);
    if width > 0.0 && height > 0.0 { width / height } else { 1.0 }
}

/// Whether a built-in file is a model, not a scene.
fn is_model(name: &str) -> bool {
    let text = files::builtin(name).map(String::from_utf8_lossy).unwrap_or_default();
    text.lines().any(|line| line.starts_with("v "))
}

/// Adds a built-in model beside the others.
fn add_model(document: &mut Document, session: &mut Session, name: &str) {
    let (min, max) = session.loaded.as_ref().map(|loaded| loaded.bounds()).unwrap_or_default();
    // Sample models extend about a unit to each side.
    let [x, y, z] = [max.x + 1.2, 0.5 * (min.y + max.y), 0.5 * (min.z + max.z)].map(|v| (100.0 * v).round() / 100.0);
    let model = format!("{}{name}", files::BUILTIN);
    document.scene.objects.push(ObjectSpec { model, translate: [x, y, z], ..ObjectSpec::default() });
    session.selection = Selection::Object(document.scene.objects.len() - 1);
    session.announcement = tr!("scene-was-added", name = name);
}

/// The box around an object, world space.
fn bounds_of(loaded: &Scene, index: usize) -> Option<(DVec3, DVec3)> {
    let object = loaded.objects.get(index)?;
    let mesh = loaded.meshes.get(object.mesh)?;
    let points = mesh.positions.iter().map(|p| object.world_from_model.transform_point3(DVec3::from(p.map(f64::from))));
    points.fold(None, |known, p| {
        let (min, max) = known.unwrap_or((p, p));
        Some((min.min(p), max.max(p)))
    })
}

/// A camera with the same viewing direction, far enough away for the box's bounding sphere.
fn looking_at(spec: &CameraSettings, (min, max): (DVec3, DVec3), aspect: f64) -> CameraSettings {
    let camera = spec.to_camera();
    let center = 0.5 * (min + max);
    let radius = (0.5 * (max - min).length()).max(1e-6);
    let half_y = 0.5 * camera.fov_y_rad;
    let half = half_y.min((half_y.tan() * aspect).atan());
    let position = center - camera.front * (1.05 * radius / half.sin());
    CameraSettings { position: position.to_array(), aim: Aim::Target(center.to_array()), ..spec.clone() }
}
