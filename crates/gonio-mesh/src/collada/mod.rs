//! COLLADA 1.4 and 1.5, `.dae` (Khronos Group, 2008, "COLLADA - Digital Asset Schema Release 1.4.1" and "1.5.0").
//!
//! The XML is parsed into a tree (`xml`), in which references are looked up (`document`). A walk over the nodes
//! (`walker`) reads each geometry once (`geometry`, `source`), converts it to an indexed mesh once (`local`) and copies
//! that to each place (`build`).

mod document;
mod effect;
mod geometry;
mod image;
mod light;
mod local;
mod materials;
mod source;
mod walker;
mod xml;

use crate::encoding::xml_to_text;
use crate::text::LineIndex;
use crate::{Diagnostic, Limits, Model, ReadError, Sidecars};
use document::Document;
use walker::NodeWalker;
use xml::Tree;

/// Reads a COLLADA document. Other documents that it refers to are not read; textures are left to the caller.
///
/// - The model is in metres (`unit`), Y up (`up_axis`), with the transforms of all nodes applied. Mirrored triangles
///   have their winding reversed, so that front faces stay front faces.
/// - Parts have the name of the node that places them.
/// - Colours are linear RGB, as Blender writes them. Vertex colours are linear too, except in files from Blender
///   (`authoring_tool`), where they are sRGB.
/// - Effects are read from `profile_COMMON`:
///
/// | element | here | absent |
/// |---|---|---|
/// | `emission` | emitted | 0 |
/// | `ambient` | ambient; a texture follows the diffuse colour | follows the diffuse colour |
/// | `diffuse` | diffuse | 0.8; of `constant` 0 |
/// | `specular` | specular | 0 |
/// | `shininess` | exponent; above 0 and up to 1, as some programs write it, times 128; at least 1 | 32 |
/// | `transparent`, `transparency` | opacity by the four `opaque` rules; 0 is treated as 1 | 1 |
/// | `index_of_refraction` | refraction index | 1.5 |
/// | `reflective`, `reflectivity` | unused | |
/// | `bump` of an `extra` | bump map, or with `bumptype="NORMALMAP"` normal map | |
///
///   Some programs write 0 for opaque, which would make the model invisible. A texture replaces a colour. The set of
///   texture coordinates is that of a material's first texture.
/// - Lights: `falloff_angle` is the full angle of a spot's cone. `falloff_exponent` has no equivalent: from 0 to 1 it
///   moves the inner cone from the outer one to the axis. A colour above 1 is divided by its largest component, which
///   becomes the intensity. Attenuation is per metre.
/// - Skins are drawn in their bind pose, morphs in their base shape; animations are not played.
///
/// The text may be in UTF-8, UTF-16, UTF-32, ISO-8859-1 or Windows-1252, by its byte order mark or XML declaration
/// ([`crate::encoding`]). A decimal comma is read as a point, with a warning.
///
/// Problems that reading can survive become warnings with line and column. Errors are: malformed XML, entities that the
/// document defines itself, elements nested deeper than 512, text in place of a number, positions that are not finite,
/// nodes that contain themselves, no triangles, and more data than `limits` allow.
pub fn read(bytes: &[u8], _sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    let (text, encoding) = xml_to_text(bytes);
    let text = &*text;
    let lines = LineIndex::new(text.as_bytes());
    let tree = Tree::parse(text, &lines, limits)?;
    let document = Document::new(&tree, &lines, limits);
    check_version(&document);
    let mut scene = NodeWalker::new(&document)?;
    scene.walk()?;
    let contents = contents(&document, &scene);
    report_cuts(&document, &scene);
    let NodeWalker { materials, builder, lights, cameras, .. } = scene;
    let mut mesh = builder.finish();
    if mesh.indices.is_empty() {
        let counts: Vec<String> = contents.iter().map(|(name, count)| format!("{count} {name}")).collect();
        let counts = if counts.is_empty() { "no known element".to_owned() } else { counts.join(", ") };
        let reason = document.why_nothing();
        return Err(ReadError::new(format!("contains no triangles ({counts}): nothing to draw{reason}")));
    }
    let (materials, images, offset) = materials.finish();
    for part in &mut mesh.parts {
        part.material -= offset;
    }
    let diagnostics = encoding.into_iter().chain(document.finish()).collect();
    Ok(Model { mesh, materials, images, lights, cameras, contents, diagnostics, ..Model::default() })
}

fn check_version(document: &Document<'_>) {
    let root = document.tree.root();
    let version = root.attribute("version").unwrap_or_default();
    if !version.starts_with("1.4") && !version.starts_with("1.5") {
        let version = crate::text::quote(version.as_bytes());
        document.warn(root.at(), format!("the version is {version}: reading it as 1.4 or 1.5"));
    }
    for library in root.all("library_animations") {
        if let Some(animation) = library.child("animation") {
            document.note(animation.at(), "animations are not played: the model is shown at rest");
        }
    }
}

/// Elements that are counted, by the name of their library.
const COUNTED: [(&str, &str); 9] = [
    ("library_geometries", "geometry"),
    ("library_controllers", "controller"),
    ("library_materials", "material"),
    ("library_effects", "effect"),
    ("library_images", "image"),
    ("library_lights", "light"),
    ("library_cameras", "camera"),
    ("library_animations", "animation"),
    ("library_nodes", "node"),
];

fn contents(document: &Document<'_>, scene: &NodeWalker<'_, '_>) -> Vec<(String, u64)> {
    let root = document.tree.root();
    let count = |(library, name): (&'static str, &'static str)| {
        let count = root.all(library).flat_map(|library| library.all(name)).count();
        (name.to_owned(), count as u64)
    };
    let mut contents: Vec<(String, u64)> = COUNTED.into_iter().map(count).filter(|(_, count)| *count > 0).collect();
    if scene.placed > 0 {
        contents.push(("geometries placed".to_owned(), scene.placed));
    }
    contents.extend(scene.counts.iter().map(|(name, count)| ((*name).to_owned(), *count)));
    contents
}

fn report_cuts(document: &Document<'_>, scene: &NodeWalker<'_, '_>) {
    if scene.cuts.not_simple > 0 {
        let message =
            format!("{} polygons cross or touch themselves: their triangles are guessed", scene.cuts.not_simple);
        document.report_at_end(Diagnostic::warning(message));
    }
    if scene.cuts.too_large > 0 {
        let most = crate::polygon::MOST_CORNERS_FOR_EARS;
        let message = format!(
            "{} concave polygons have more than {most} corners: triangulated as if convex",
            scene.cuts.too_large
        );
        document.report_at_end(Diagnostic::warning(message));
    }
}
