//! The parts of an object: a list to select one, and its own material.

use super::material;
use crate::exported::{self, WidgetRole};
use crate::widgets::{NO_BREAK, grouped, heading};
use egui::{Align, Atom, Button, Id, Layout, Rect, RichText, ScrollArea, Ui, WidgetInfo, vec2};
use gonio_language::tr;
use gonio_mesh::Material;
use gonio_scene::Scene;
use gonio_scene::scene_file::{MaterialOverride, ObjectSpec};

/// Rows of the list that are visible at once.
const ROWS: usize = 6;
/// Height of a material that is scrolled into view, in points: its heading and first values.
const SHOWN: f32 = 150.0;

/// Shows the list of an object's parts, if there are several. Returns the part that was pressed; `Some(None)` for all of them.
pub fn list(ui: &mut Ui, loaded: &Scene, index: usize, selected: Option<usize>) -> Option<Option<usize>> {
    let object = loaded.objects.get(index).filter(|object| object.parts.len() > 1)?;
    heading(ui, &tr!("scene-parts", count = object.parts.len()));
    let mut pressed = None;
    let height = ui.spacing().interact_size.y.max(crate::theme::touch::least(ui));
    ui.spacing_mut().item_spacing.y = 1.0;
    let area = ScrollArea::vertical().id_salt("parts").max_height(ROWS as f32 * height).auto_shrink([false, true]);
    area.show_rows(ui, height, object.parts.len() + 1, |ui, rows| {
        for row in rows {
            let part = row.checked_sub(1);
            let of_part = part.and_then(|part| object.parts.get(part));
            let name = match part {
                Some(part) => loaded.part_name(index, part),
                None => tr!("scene-all-parts").to_owned(),
            };
            let triangles = of_part.map_or(String::new(), |part| grouped(part.triangle_count as u64, NO_BREAK));
            let id = part.map_or(format!("object-{index}-all-parts"), |part| format!("object-{index}-part-{part}"));
            let is_selected = part == selected;
            ui.horizontal(|ui| {
                ui.set_height(height);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(RichText::new(triangles).small().weak());
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        let button = Button::selectable(is_selected, (RichText::new(&name), Atom::grow())).truncate();
                        let button = ui.add(button.min_size(vec2(ui.available_width(), height)));
                        button.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, is_selected, &name));
                        exported::note(ui, &button, &id, WidgetRole::Choice, &name, is_selected);
                        if button.clicked() {
                            pressed = Some(part);
                        }
                    });
                });
            });
        }
    });
    pressed
}

/// Shows the material of one part: values that replace those of the object and the file.
pub fn material_of(ui: &mut Ui, spec: &mut ObjectSpec, loaded: &Scene, index: usize, part: usize) {
    let name = loaded.part_name(index, part);
    let top = ui.cursor().top();
    heading(ui, &tr!("scene-material-of-part", name = name));
    show_once(ui, top, [index, part]);
    let mut own = spec.parts.remove(&name).unwrap_or_default();
    let others = loaded.part_material(index, part, spec);
    let file = loaded.part_material_in_file(index, part).cloned().unwrap_or_default();
    let below = others.applied_to(Material { name: file.name.clone(), ..file });
    material::show(ui, &mut own, &others, &[&below], index);
    if own != MaterialOverride::default() {
        spec.parts.insert(name, own);
    }
}

/// Scrolls to what begins at `top` when another part is selected.
fn show_once(ui: &Ui, top: f32, part: [usize; 2]) {
    let id = Id::unique("part whose material is shown");
    if ui.data(|data| data.get_temp(id)) != Some(part) {
        ui.data_mut(|data| data.insert_temp(id, part));
        ui.scroll_to_rect(Rect::from_x_y_ranges(ui.max_rect().x_range(), top..=top + SHOWN), None);
    }
}
