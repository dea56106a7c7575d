//! The language of all texts.

use crate::exported::{self, WidgetRole};
use egui::{RichText, Ui, WidgetInfo};
use gonio_language::{Language, tr};

/// A menu of the languages, by their own names. Returns the one that was selected.
pub fn language_menu(ui: &mut Ui) -> Option<Language> {
    let current = Language::current();
    let title = RichText::new(current.code().to_uppercase()).small().strong();
    let mut selected = None;
    let menu = ui.menu_button(title, |ui| {
        for language in Language::ALL {
            let entry = ui.selectable_label(language == current, language.own_name());
            let id = format!("language-{}", language.code());
            exported::note(ui, &entry, &id, WidgetRole::Choice, language.own_name(), language == current);
            if entry.clicked() {
                selected = Some(language);
                ui.close();
            }
        }
    });
    let name = tr!("window-language");
    menu.response.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, name));
    exported::note(ui, &menu.response, "language", WidgetRole::Choice, name, current.own_name());
    menu.response.on_hover_text(name);
    selected
}
