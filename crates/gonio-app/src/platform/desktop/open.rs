//! Opens files on disk in a thread: finds the model among them, and unpacks zip
//! files.

use super::Access;
use super::exercise_files;
use crate::files::{Layered, MemoryFiles, gather, zip};
use crate::platform::{Event, Purpose, SceneInput};
use gonio_scene::files::{Disk, FileSource, Sandbox};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// Looks at them beside the window: a zip takes its time.
pub fn in_thread(paths: Vec<String>, purpose: Purpose, access: Access, sender: Sender<Event>, ctx: &egui::Context) {
    let ctx = ctx.clone();
    std::thread::spawn(move || {
        let event = match purpose {
            Purpose::Scene => given(paths, access).map(Event::Open),
            Purpose::Exercise => exercise_files::read(&paths).map(Event::ExerciseFiles),
        };
        let event = event.unwrap_or_else(Event::Failed);
        // The window may be closed by now.
        let _ = sender.send(event);
        ctx.request_repaint();
    });
}

/// Finds the models and the environment among these files. A folder stands for the files directly in it.
fn given(paths: Vec<String>, access: Access) -> Result<SceneInput, String> {
    let disk: Arc<dyn FileSource> =
        if access.sandbox { Arc::new(Sandbox::new(Disk, paths.iter().map(String::as_str))) } else { Arc::new(Disk) };
    let mut names = Vec::new();
    let mut memory = MemoryFiles::default();
    let mut left = access.max_bytes;
    let paths = paths.into_iter().flat_map(|path| if Path::new(&path).is_dir() { within(&path) } else { vec![path] });
    for path in paths {
        let is_zip = Path::new(&path).extension().is_some_and(|e| e.eq_ignore_ascii_case("zip"));
        if !is_zip {
            names.push(path);
            continue;
        }
        let bytes =
            disk.read_within(Path::new(&path), left).map_err(|why| format!("`{path}` cannot be read: {why}"))?;
        let unpacked = zip::unpack_within(&bytes, &zip::Limits::MODELS.within(left));
        let unpacked = unpacked.map_err(|why| format!("`{path}`: {why}"))?;
        left -= unpacked.total_bytes().min(left);
        memory.add_all(unpacked);
    }
    names.extend(memory.names());
    let files = if memory.is_empty() { disk } else { Arc::new(Layered { first: Arc::new(memory), then: disk }) };
    let gathered = gather(&names, &*files)?;
    Ok(SceneInput { inputs: gathered.inputs, environment: gathered.environment, files })
}

fn within(folder: &str) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .map(|entries| entries.filter_map(|entry| Some(entry.ok()?.path())).collect::<Vec<_>>())
        .unwrap_or_default()
        .into_iter()
        .filter(|path| path.is_file())
        .map(|path| path.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn what_is_given_is_confined_to_its_folder_where_that_is_wanted() {
        let folder = std::env::temp_dir().join(format!("gonio-given-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("in")).unwrap();
        let [model, secret] = ["in/m.obj", "secret.mtl"].map(|name| folder.join(name));
        std::fs::write(&model, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        std::fs::write(&secret, "newmtl m\n").unwrap();
        let paths = vec![model.to_string_lossy().into_owned()];
        for sandbox in [false, true] {
            let files = given(paths.clone(), Access { max_bytes: 1 << 20, sandbox }).unwrap().files;
            assert!(files.read(&model).is_ok());
            assert_eq!(files.read(&folder.join("in/../secret.mtl")).is_ok(), !sandbox);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
