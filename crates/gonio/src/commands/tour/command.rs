//! The commands that make single pictures of the tour again.

use super::{Folder, TourArgs};
use crate::backend::BackendChoice;
use gonio_gallery::environment_picture::{EnvironmentPicture, PictureForm};
use gonio_gallery::exhibit::Exhibit;
use gonio_light::color::ToneMap;

/// Returns the command that draws a scene again, with the path of the tour as it was given.
pub fn of_scene(args: &TourArgs, folder: &Folder, exhibit: &Exhibit) -> String {
    let quoted = |text: String| if text.contains(char::is_whitespace) { format!("\"{text}\"") } else { text };
    let scene = quoted(folder.scene(&exhibit.name).display().to_string());
    let mut command = format!("gonio render {scene} -o {}.png", exhibit.name);
    if let Some(view) = exhibit.view {
        command += &format!(" --debug {view}");
    }
    if exhibit.time != 0.0 {
        command += &format!(" --time {}", exhibit.time);
    }
    match args.backend.backend {
        BackendChoice::Auto => {}
        BackendChoice::Gl => command += " --backend gl",
        BackendChoice::Cpu => command += " --backend cpu",
    }
    command
}

/// Returns the commands that convert an environment again to a picture that is at least `width` pixels wide.
pub fn of_environment(picture: EnvironmentPicture, name: &str, width: u32) -> String {
    let (from, size) = (picture.from.name(), picture.size(width));
    let tone_map = match picture.tone_map() {
        ToneMap::None => String::new(),
        other => format!(" --tone-map {other}"),
    };
    match picture.form {
        PictureForm::Panorama => format!("gonio environment convert {from} {name}.png --size {size}{tone_map}"),
        PictureForm::PanoramaOfCubemap(face) => format!(
            "gonio environment convert {from} {from}.ktx2 --size {face} && \
             gonio environment convert {from}.ktx2 {name}.png --size {size}{tone_map}"
        ),
        PictureForm::Faces(arrangement, layout) => format!(
            "gonio environment convert {from} {name}.png --to {arrangement} --layout {layout} --size {size}{tone_map}"
        ),
    }
}
