//! Output: pictures, scenes, and the list of recent files.

use super::{App, NOTHING_DRAWN};
use crate::saving::{self, Product, png::DisplayedPicture};
use crate::session::Severity;
use gonio_image::encode::exr_compact;
use std::path::Path;

impl App {
    pub(super) fn save(&mut self, product: Product, place: &str) {
        let folder = cfg!(not(target_arch = "wasm32")).then(|| Path::new(place).parent()).flatten();
        let saved = self.produced(product, folder).and_then(|bytes| self.platform.write(place, &bytes));
        match saved {
            Ok(place) => self.session.announcement = format!("saved {place}"),
            Err(why) => self.session.messages.say(Severity::Error, why),
        }
    }

    fn produced(&mut self, product: Product, folder: Option<&Path>) -> Result<Vec<u8>, String> {
        let picture = &self.document.scene.picture;
        let size = (product == Product::SizedPicture).then_some([picture.width, picture.height]);
        match product {
            Product::Scene => Ok(saving::scene_file(&self.document.scene, folder).into_bytes()),
            Product::Picture | Product::SizedPicture => {
                saving::png::encode(&self.shown(size)?).map_err(|why| why.to_string())
            }
            Product::Light => {
                let pane = self.document.panes.current;
                let light =
                    self.pane_renderer.as_mut().map(|pane_renderer| pane_renderer.light(pane, size)).transpose();
                let light = light.map_err(|why| why.to_string())?.flatten().ok_or(NOTHING_DRAWN)?;
                exr_compact::encode([light.width, light.height], &light.pixels).map_err(|why| why.to_string())
            }
        }
    }

    /// The current pane's picture as displayed.
    fn shown(&mut self, size: Option<[u32; 2]>) -> Result<DisplayedPicture, String> {
        let pane = self.document.panes.current;
        let shown = self.pane_renderer.as_mut().map(|pane_renderer| pane_renderer.shown(pane, size)).transpose();
        shown.map_err(|why| why.to_string())?.flatten().ok_or_else(|| NOTHING_DRAWN.to_owned())
    }

    pub(super) fn copy_picture(&mut self, ctx: &egui::Context) {
        match self.shown(None) {
            Ok(DisplayedPicture { size: [width, height], rgba, .. }) => {
                let size = [width as usize, height as usize];
                ctx.copy_image(egui::ColorImage::from_rgba_premultiplied(size, &rgba));
                self.session.announcement = "copied the picture".into();
            }
            Err(why) => self.session.messages.say(Severity::Error, why),
        }
    }

    /// Adds the input to the recent files.
    pub(super) fn remember(&mut self, inputs: &[String]) {
        let [input] = inputs else { return };
        if let Some(lasting) = self.platform.lasting(input) {
            self.session.settings.opened(lasting);
            self.platform.keep(&self.session.settings);
        }
    }
}
