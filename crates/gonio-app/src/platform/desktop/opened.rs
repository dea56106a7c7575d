//! Files on disk that a person gave, looked at beside the window; which of them is the model, and what a zip among them
//! holds.

use super::handed;
use crate::files::{Layered, MemoryFiles, gather, zip};
use crate::platform::{Event, Given, Purpose};
use gonio_scene::files::{Disk, FileSource};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// Looks at them beside the window: a zip takes its time.
pub fn in_thread(paths: Vec<String>, purpose: Purpose, sender: Sender<Event>, ctx: &egui::Context) {
    let ctx = ctx.clone();
    std::thread::spawn(move || {
        let event = match purpose {
            Purpose::Scene => given(paths).map(Event::Open),
            Purpose::Exercise => handed::read(&paths).map(Event::Handed),
        };
        let event = event.unwrap_or_else(Event::Failed);
        // The window may be closed by now.
        let _ = sender.send(event);
        ctx.request_repaint();
    });
}

/// What these files are. Of a folder, the files that lie directly in it are meant.
fn given(paths: Vec<String>) -> Result<Given, String> {
    let mut names = Vec::new();
    let mut memory = MemoryFiles::default();
    let paths = paths.into_iter().flat_map(|path| if Path::new(&path).is_dir() { within(&path) } else { vec![path] });
    for path in paths {
        let is_zip = Path::new(&path).extension().is_some_and(|e| e.eq_ignore_ascii_case("zip"));
        if !is_zip {
            names.push(path);
            continue;
        }
        let bytes = Disk.read(Path::new(&path)).map_err(|why| format!("`{path}` cannot be read: {why}"))?;
        memory.add_all(zip::unpack(&bytes).map_err(|why| format!("`{path}`: {why}"))?);
    }
    names.extend(memory.names());
    let disk: Arc<dyn FileSource> = Arc::new(Disk);
    let files = if memory.is_empty() { disk } else { Arc::new(Layered { first: Arc::new(memory), then: disk }) };
    let gathered = gather(&names, &*files)?;
    Ok(Given { inputs: gathered.inputs, environment: gathered.environment, files })
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
