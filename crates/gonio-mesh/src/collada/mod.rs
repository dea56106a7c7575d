//! COLLADA 1.4 and 1.5, `.dae` (Khronos Group, 2008, "COLLADA - Digital Asset Schema Release 1.4.1" and "1.5.0").
//!
//! XML becomes a tree (`xml`), in which addresses are looked up (`document`). Nodes are walked through (`walker`); each
//! geometry that one places is read once (`geometry`, `source`), made an indexed mesh once (`local`) and then copied to
//! where it stands (`build`).

mod build;
mod document;
mod effect;
mod geometry;
mod image;
mod light;
mod local;
mod materials;
mod source;
mod transform;
mod walker;
mod xml;

use crate::encoding::xml_to_text;
use crate::line_index::LineIndex;
use crate::{Diagnostic, Limits, Model, ReadError, Sidecars};
use document::Document;
use walker::NodeWalker;
use xml::Tree;

/// Reads a COLLADA document. Documents that it refers to are not read; textures are left to the caller.
///
/// - The model is in metres (`unit`), Y up (`up_axis`), with the transforms of all nodes done. A mirror turns the
///   corners of triangles around, so that fronts stay fronts.
/// - Parts have the name of the node that places them.
/// - Colours are taken as linear RGB, as Blender writes them; colours of vertices too, but for those that Blender
///   writes (`authoring_tool`), which are sRGB.
/// - Effects are read from `profile_COMMON`:
///
/// | element | here | absent |
/// |---|---|---|
/// | `emission` | emitted | 0 |
/// | `ambient` | ambient; a texture follows the diffuse colour | follows the diffuse colour |
/// | `diffuse` | diffuse | 0.8; of `constant` 0 |
/// | `specular` | specular | 0 |
/// | `shininess` | exponent; above 0 and up to 1, as some programs write it, times 128; at least 1 | 32 |
/// | `transparent`, `transparency` | opacity by the four `opaque` rules; 0 is taken as 1 | 1 |
/// | `index_of_refraction` | refraction index | 1.5 |
/// | `reflective`, `reflectivity` | unused | |
/// | `bump` of an `extra` | bump map, or with `bumptype="NORMALMAP"` normal map | |
///
///   Some programs write 0 for opaque, so that a model would not be seen at all. A texture takes the place of a colour.
///   The set of texture coordinates is that of a material's first texture.
/// - Lights: `falloff_angle` is the whole angle of a spot's cone. `falloff_exponent` has no equal: from 0 to 1 it moves
///   the inner cone from the outer one to the axis. A colour beyond 1 is divided by its largest component, which is
///   then the intensity. Attenuation is per metre.
/// - Skins are drawn as they were bound, morphs as their base; animations are not played.
///
/// The text may be in UTF-8, UTF-16, UTF-32, ISO-8859-1 or Windows-1252, by its byte order mark or XML declaration
/// ([`crate::encoding`]). A decimal comma is read as a point, with a warning.
///
/// What can be survived is a warning with line and column. Errors are: broken XML, entities of the document's own,
/// elements nested deeper than 512, what is no number where one should be, positions that are not finite, nodes that
/// hold themselves, no triangle at all, more than `limits` allow.
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
        let why = document.why_nothing();
        return Err(ReadError::new(format!("contains no triangles ({counts}): nothing to draw{why}")));
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

/// Elements worth counting, by the name of their library.
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
        document.say_at_end(Diagnostic::warning(message));
    }
    if scene.cuts.too_large > 0 {
        let most = crate::polygon::MOST_CORNERS_FOR_EARS;
        let message = format!(
            "{} concave polygons have more than {most} corners: triangulated as if convex",
            scene.cuts.too_large
        );
        document.say_at_end(Diagnostic::warning(message));
    }
}
