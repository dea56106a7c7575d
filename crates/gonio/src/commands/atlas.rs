//! Texture atlases for `gonio unwrap` and `gonio bake`: their options, the report, and the picture of a checker.

use crate::error::CliError;
use crate::options::values;
use crate::output::color_tag;
use crate::report::{Reporter, Times};
use crate::terminal::TerminalPage;
use clap::{ArgAction, Args};
use glam::DMat4;
use gonio_atlas::{AtlasUv, UnwrapSettings, UvReport, UvSource, layout, unwrap};
use gonio_bake::MaterialDetail;
use gonio_image::encode::png::encode8;
use gonio_mesh::{Diagnostic, Material, Mesh, Part};
use gonio_reference::ReferenceScene;
use gonio_scene::{BoundTexture, ColorSpace, DisplayMap, Scene, SceneMaterial, Texture};
use std::path::PathBuf;
use std::sync::Arc;

/// Options of a texture atlas.
#[derive(Args, Debug, Clone)]
#[command(next_help_heading = "Atlas options")]
pub struct AtlasOptions {
    /// Texels along a side of the texture.
    #[arg(long, value_name = "N", default_value = "1024", value_parser = values::texture_size)]
    pub size: u32,
    /// Distance between charts as a share of the side; half of it stays free along the sides.
    #[arg(long, value_name = "SHARE", default_value = "0.01", value_parser = values::margin, allow_negative_numbers = true)]
    pub margin: f64,
    /// Distance between charts in texels, in place of --margin.
    #[arg(long, value_name = "N", conflicts_with = "margin")]
    pub margin_texels: Option<u16>,
    /// Largest angle between a triangle and the axis of its chart, in degrees.
    #[arg(long, value_name = "DEGREES", default_value = "66", value_parser = values::chart_angle, allow_negative_numbers = true)]
    pub angle_limit: f64,
    /// Keep the model's own texture coordinates.
    #[arg(long, conflicts_with = "repack")]
    pub keep_uvs: bool,
    /// Keep the charts of the model's own texture coordinates, but pack them again.
    #[arg(long)]
    pub repack: bool,
    /// Texels per unit of length in the parts or the material NAME, relative to all others; repeat it for several.
    ///
    /// Without it all parts have the same density, except in `gonio bake` of diffuse, specular or emitted colours alone: there,
    /// parts of one colour have half the density of those with a texture.
    #[arg(long, value_name = "NAME=FACTOR", action = ArgAction::Append, value_parser = values::density,
          conflicts_with = "keep_uvs")]
    pub density: Vec<values::Density>,
    /// Keep the model's own texture coordinates as the first set, with its textures; the atlas is the second set of the .glb file.
    #[arg(long, conflicts_with = "keep_uvs")]
    pub second_uv: bool,
    /// Picture of the model to write, with a checker in the texture coordinates of the atlas.
    #[arg(long, help_heading = "Output options", value_name = "FILE.png")]
    pub checker: Option<PathBuf>,
}

impl AtlasOptions {
    pub fn settings(&self) -> Result<UnwrapSettings, CliError> {
        let margin = match self.margin_texels {
            Some(texels) if 4 * u32::from(texels) > self.size => {
                return Err(CliError::new(format!(
                    "a margin of {texels} texels is too large for --size {}: expected at most {}",
                    self.size,
                    self.size / 4
                )));
            }
            Some(texels) => f64::from(texels) / f64::from(self.size),
            None => self.margin,
        };
        let source = match (self.keep_uvs, self.repack) {
            (true, _) => UvSource::Kept,
            (_, true) => UvSource::Repacked,
            _ => UvSource::New,
        };
        let angle_limit_rad = self.angle_limit.to_radians();
        Ok(UnwrapSettings { angle_limit_rad, margin, source, ..UnwrapSettings::default() })
    }

    /// The density of each part; a later option replaces an earlier one.
    fn densities(&self, mesh: &Mesh, material_names: &[&str]) -> Result<Vec<f64>, CliError> {
        let mut densities = vec![1.0; if self.density.is_empty() { 0 } else { mesh.parts.len() }];
        for values::Density { name, factor } in &self.density {
            let is_named =
                |part: &Part| part.name == *name || material_names.get(part.material) == Some(&name.as_str());
            let mut found = false;
            for (density, _) in densities.iter_mut().zip(&mesh.parts).filter(|(_, part)| is_named(part)) {
                (*density, found) = (*factor, true);
            }
            if !found {
                let parts = mesh
                    .parts
                    .iter()
                    .flat_map(|part| [Some(&part.name[..]), material_names.get(part.material).copied()]);
                let mut known: Vec<&str> = parts.flatten().filter(|name| !name.is_empty()).collect();
                known.sort_unstable();
                known.dedup();
                let known =
                    if known.is_empty() { "it has no names".into() } else { format!("it has {}", known.join(", ")) };
                return Err(CliError::new(format!("the model has no part and no material named `{name}`: {known}")));
            }
        }
        Ok(densities)
    }

    /// Unwraps a mesh with a progress bar. `detail` gives the densities if there is no option for them. Warns if the margin had to be
    /// reduced.
    pub fn unwrap(
        &self,
        mesh: &Mesh,
        material_names: &[&str],
        detail: Option<&MaterialDetail>,
        name: &str,
        reporter: &Reporter,
    ) -> Result<AtlasUv, CliError> {
        if self.second_uv && mesh.tex_coords.is_empty() {
            return Err(CliError::new(format!(
                "{name}: the model has no texture coordinates that could be the first set; leave --second-uv out"
            )));
        }
        let settings = match detail.filter(|_| self.density.is_empty()) {
            Some(detail) => detail.applied_to(self.settings()?),
            None => UnwrapSettings { density_of_part: self.densities(mesh, material_names)?, ..self.settings()? },
        };
        let progress = reporter.progress("unwrapping");
        let atlas = unwrap(mesh, &settings, &|share| {
            progress.set(share);
            true
        })
        .map_err(|error| CliError::new(format!("{name}: {error}")))?;
        drop(progress);
        if settings.source != UvSource::Kept && atlas.margin < 0.999 * settings.margin {
            let texels = atlas.margin * f64::from(self.size);
            reporter.warning(format_args!(
                "{} charts leave no room for the margin: it is {texels:.2} texels instead of {:.2}",
                atlas.chart_count,
                settings.margin * f64::from(self.size)
            ));
        }
        Ok(atlas)
    }
}

/// The result of a command that makes an atlas.
pub struct AtlasReport<'a> {
    pub command: &'static str,
    pub inputs: &'a [String],
    /// The files that were written.
    pub outputs: &'a [String],
    pub uv: &'a UvReport,
    /// Parts of one colour that have half the density of the others.
    pub plain_parts: usize,
    /// The names of the baked maps.
    pub maps: &'a [&'static str],
    /// The relative noise of a lightmap.
    pub light_error: Option<f64>,
}

impl AtlasReport<'_> {
    /// Prints it as text, or as JSON if that was asked for.
    pub fn print(
        &self,
        is_quiet: bool,
        diagnostics: &[Diagnostic],
        times: &Times,
        reporter: &Reporter,
    ) -> Result<(), CliError> {
        if reporter.json() {
            return reporter.report(&serde_json::json!({
                "command": self.command,
                "inputs": self.inputs,
                "outputs": self.outputs,
                "maps": self.maps,
                "uv": self.uv,
                "plain_parts": self.plain_parts,
                "light_error": self.light_error,
                "warnings": diagnostics,
                "times_ms": times.to_json(),
            }));
        }
        if is_quiet { Ok(()) } else { reporter.text(&self.text()) }
    }

    /// The figures, one per line.
    fn text(&self) -> TerminalPage {
        let report = self.uv;
        let mut page = TerminalPage::new();
        let mut line = |name: &str, value: String| page.line(format_args!("{name:20}{value}"));
        line("charts", report.charts.to_string());
        line("triangles", report.triangles.to_string());
        for (name, count) in [
            ("degenerate", report.degenerate_triangles),
            ("collapsed", report.collapsed_triangles),
            ("mirrored", report.mirrored_triangles),
        ] {
            if count > 0 {
                line(&format!("  {name}"), count.to_string());
            }
        }
        line("coverage", format!("{:.1} %", 100.0 * report.coverage));
        line("overlaps", format!("{} of {} texels", report.overlapping_texels, u64::from(report.size).pow(2)));
        line("angle stretch", format!("{:.3} (1 keeps angles)", report.angle_stretch));
        line("area stretch", format!("{:.3} (1 keeps areas)", report.area_stretch));
        line("density", format!("{} texels per unit of length", significant(report.texels_per_unit)));
        if self.plain_parts > 0 {
            line("plain parts", format!("{}, of one colour, with half the density of the others", self.plain_parts));
        }
        if report.margin_texels > 0.0 {
            line("margin", format!("{:.1} texels", report.margin_texels));
        }
        if let Some(error) = self.light_error {
            line("error of light", format!("{:.2} % of the mean brightness", 100.0 * error));
        }
        page
    }
}

/// A number with four decimals, or four digits if that would be 0.
fn significant(number: f64) -> String {
    if number.abs() < 0.001 { format!("{number:.3e}") } else { format!("{number:.4}") }
}

/// Squares along a side of the checker, texels along a side, and the size of the picture.
const CHECKER: (u32, u32) = (32, 1024);
const PICTURE: (u32, u32) = (1024, 768);

/// Draws a mesh, in world space and with the texture coordinates of an atlas, in place of a scene's objects, with a checker: as PNG.
pub fn checker_picture(mut scene: Scene, mesh: Mesh) -> Result<Vec<u8>, CliError> {
    // The camera looks at the scene's own objects.
    (scene.settings.picture.width, scene.settings.picture.height) = PICTURE;
    let frame = scene.frame(0.0);
    let (squares, size) = CHECKER;
    let rgba = layout::draw_checker(size, squares).rgba;
    scene.textures = vec![Arc::new(Texture::new("checker", size, size, rgba, ColorSpace::Srgb))];
    scene.objects.clear();
    scene.meshes.clear();
    scene.materials.clear();
    let mut material = SceneMaterial::from(Material { diffuse: [1.0; 3], specular: [0.0; 3], ..Material::default() });
    material.maps.diffuse = Some(BoundTexture::plain(0));
    scene.add_object(mesh, material, DMat4::IDENTITY);
    let rendered = ReferenceScene::new(&scene).render(&frame, None, &|_| ());
    let map = DisplayMap::for_view(None, &frame);
    Ok(encode8(&rendered.picture.encode8(&map), color_tag(&map))?)
}
