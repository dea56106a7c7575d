//! Loading the scene of a command from its inputs and options.

use crate::error::CliError;
use crate::options::SceneOptions;
use crate::report::{Reporter, Times};
use gonio_scene::{Scene, ViewSpec, load};
use std::path::Path;

/// Loads the scene of `inputs`, with the options in place of its own values.
pub fn load_scene(inputs: &[String], options: &SceneOptions, reporter: &Reporter) -> Result<Scene, CliError> {
    let inputs: Vec<&str> = inputs.iter().map(String::as_str).collect();
    let named = inputs.iter().copied().chain(options.surroundings.named());
    let files = options.limits.files(named, reporter);
    let mut scene = load::describe(&inputs, &files)?;
    options.apply(&mut scene);
    // Paths in the scene are relative to the current folder.
    Ok(load::load_within(scene, Path::new(""), &files, &options.limits.limits())?)
}

/// Loads the scene on a second thread while `meanwhile` runs on this one: creating an OpenGL context takes longer than reading
/// most models, and the context must stay on its thread.
pub fn load_scene_while<T>(
    inputs: &[String],
    options: &SceneOptions,
    reporter: &Reporter,
    times: &Times,
    meanwhile: impl FnOnce() -> T,
) -> (Result<Scene, CliError>, T) {
    let _busy = reporter.busy("reading the scene");
    std::thread::scope(|scope| {
        let loader = scope.spawn(|| times.measure("load", || load_scene(inputs, options, reporter)));
        let other = meanwhile();
        let scene = loader.join().unwrap_or_else(|_| {
            Err(CliError::new("reading the scene ended unexpectedly; this is a bug, please report it"))
        });
        (scene, other)
    })
}

/// Checks that the light of every view exists.
pub fn check_views(views: impl IntoIterator<Item = ViewSpec>, scene: &Scene) -> Result<(), CliError> {
    let count = scene.settings.lights.len();
    for view in views {
        if let Some(light) = view.light
            && light >= count
        {
            let lights = match count {
                0 => "no light".to_owned(),
                1 => "one light, number 0".to_owned(),
                _ => format!("{count} lights, numbers 0 to {}", count - 1),
            };
            return Err(CliError::new(format!("`{view}`: there is no light {light}; the scene has {lights}")));
        }
    }
    Ok(())
}
