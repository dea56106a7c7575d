//! Draws a frame of a sphere of one million triangles and compares it with the barest OpenGL loop that draws it: the same
//! buffers, program, target and culling, and nothing else.

use crate::measure::{self, Cost};
use crate::{Places, models};
use gonio_gl::HeadlessContext;
use gonio_render::Renderer;
use gonio_scene::files::Disk;
use serde_json::json;
use std::path::Path;

/// 2 * 1000 * (501 - 1) triangles.
const SECTORS: usize = 1000;
const RINGS: usize = 501;
const TRIANGLES: usize = 1_000_000;
/// Frames of each side per turn.
const FRAMES: usize = 4;
/// Measured turns of each side.
const TURNS: usize = 9;
/// The allowed CPU time as a multiple of the bare loop's.
const BAR: f64 = 1.1;

/// Measures, prints, and returns whether the requirement is met.
pub fn run(places: &Places) -> Result<bool, String> {
    let model = models::written(&places.out, "sphere_1m.obj", || models::sphere_obj(SECTORS, RINGS))?;
    let name = model.to_string_lossy();
    let scene = gonio_scene::load::describe(&[&name], &Disk).map_err(|e| e.to_string())?;
    let loaded = gonio_scene::load::load(scene, Path::new("."), &Disk).map_err(|e| e.to_string())?;
    let triangles: usize = loaded.meshes.iter().map(|m| m.triangle_count()).sum();
    if triangles != TRIANGLES {
        return Err(format!("the sphere has {triangles} triangles instead of {TRIANGLES}"));
    }
    // The mesh reader detects closed meshes; otherwise both sides would draw back faces.
    let culled = loaded.objects.iter().all(|object| object.closed);

    let context = HeadlessContext::new().map_err(|e| e.message)?;
    let mut renderer = Renderer::new(context.gl().clone()).map_err(|e| e.message)?;
    let uploaded = renderer.upload(&loaded).map_err(|e| e.message)?;
    let frame = loaded.frame(0.0);
    let (mut ours, mut bare): (Vec<Cost>, Vec<Cost>) = (Vec::new(), Vec::new());
    for turn in 0..=TURNS {
        let (result, our_cost) =
            measure::here(|| (0..FRAMES).try_for_each(|_| renderer.render(&uploaded, &frame, None).map(drop)));
        result.map_err(|e| e.message)?;
        let (result, bare_cost) = measure::here(|| renderer.bare_loop(&uploaded, FRAMES));
        result.map_err(|e| e.message)?;
        // The first turn compiles shaders and fills caches.
        if turn > 0 {
            ours.push(per_frame(our_cost));
            bare.push(per_frame(bare_cost));
        }
    }
    let (our_median, bare_median) = (measure::median_cost(&ours), measure::median_cost(&bare));
    let ratio = our_median.cpu_s / bare_median.cpu_s;
    let row = |name: &str, cost: Cost| {
        vec![name.to_owned(), format!("{:.1}", 1e3 * cost.wall_s), format!("{:.1}", 1e3 * cost.cpu_s)]
    };
    let heading = ["", "wall ms", "CPU ms"].map(String::from).to_vec();
    measure::print_table(
        &format!(
            "frame: {TRIANGLES} triangles, {}x{}, {} samples, back faces {}; {}; medians of {TURNS} turns of {FRAMES} frames",
            frame.width,
            frame.height,
            frame.samples,
            if culled { "culled" } else { "drawn" },
            renderer.info().renderer,
        ),
        &[heading, row("gonio-gl", our_median), row("bare loop", bare_median)],
    );
    let mut held = measure::bar("CPU time against the bare loop", ratio, " x", BAR, true);
    if !culled {
        println!("  MISSED the sphere was not recognised as closed, so its back faces are drawn");
        held = false;
    }
    let side = |cost: Cost| json!({"wall_s": cost.wall_s, "cpu_s": cost.cpu_s});
    let result = json!({
        "triangles": TRIANGLES,
        "renderer": renderer.info().renderer,
        "back_faces_culled": culled,
        "gonio": side(our_median),
        "bare": side(bare_median),
        "cpu_ratio": ratio,
        "bar_held": held,
    });
    measure::write_json(&places.out, "frame", &result)?;
    Ok(held)
}

fn per_frame(cost: Cost) -> Cost {
    Cost { wall_s: cost.wall_s / FRAMES as f64, cpu_s: cost.cpu_s / FRAMES as f64 }
}
