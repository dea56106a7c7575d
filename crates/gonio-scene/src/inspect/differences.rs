//! Known differences in how other programs read a file.
//!
//! Each was seen in the program's source: three.js r187 (OBJLoader, MTLLoader), tobj 4.0.

use crate::model_file::ModelFile;
use crate::texture_library::TextureUse;
use gonio_mesh::{Format, Material, Model, NormalSource};
use serde::Serialize;

/// A feature of the file that other programs read differently.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub struct ReaderDifference {
    /// The feature of the file.
    pub feature: &'static str,
    /// Other programs, and their result.
    pub others: &'static str,
    /// The result here.
    pub here: &'static str,
}

/// A feature, its test, and the programs that read it differently.
struct Known {
    is_there: fn(&ModelFile, &[TextureUse]) -> bool,
    difference: ReaderDifference,
}

const KNOWN: [Known; 9] = [
    Known {
        is_there: |file, _| mentions(&file.model, "concave"),
        difference: ReaderDifference {
            feature: "concave polygons",
            others: "three.js and tobj triangulate every polygon as a fan, which covers area outside of concave ones",
            here: "triangulated inside their outline",
        },
    },
    Known {
        is_there: |file, _| counted(&file.model, "vn") == 0 && has_smoothing(&file.model),
        difference: ReaderDifference {
            feature: "smoothing groups without normals",
            others: "three.js makes flat normals, and tobj drops the groups",
            here: "normals are averaged within each group",
        },
    },
    Known {
        is_there: |file, _| file.model.mesh.normal_source == NormalSource::None && !has_smoothing(&file.model),
        difference: ReaderDifference {
            feature: "no normals",
            others: "three.js makes flat normals, tobj none",
            here: "averaged, weighted by angle; flat ones with `normals = \"flat\"`",
        },
    },
    Known {
        is_there: |file, _| materials(file).any(|m| is_black_beside_map(m, "diffuse")),
        difference: ReaderDifference {
            feature: "Kd 0 0 0 beside map_Kd",
            others: "three.js multiplies both, which is black (unless ignoreZeroRGBs is set)",
            here: "the texture is shown, as in Blender",
        },
    },
    Known {
        is_there: |file, _| materials(file).any(|m| m.file.is_some() && is_grey_or_coloured(m.diffuse)),
        difference: ReaderDifference {
            feature: "Kd between 0 and 1",
            others: "three.js takes the numbers of Kd, Ks and Ke for sRGB, which darkens them",
            here: "they are linear, as Blender writes them",
        },
    },
    Known {
        is_there: |file, _| materials(file).any(|m| writes(m, "opacity", "Tr")),
        difference: ReaderDifference {
            feature: "Tr",
            others: "some older exporters write the opacity",
            here: "1 - Tr is the opacity; d decides where both are written",
        },
    },
    Known {
        is_there: |file, _| {
            file.model.sidecars.iter().any(|s| s.found.is_none()) || file.model.sidecars.is_empty() && uses(file)
        },
        difference: ReaderDifference {
            feature: "materials without their library",
            others: "three.js and tobj use a default without a warning",
            here: "a warning lists every place that was searched",
        },
    },
    Known {
        is_there: |_, textures| textures.iter().any(|t| t.found.as_deref().is_some_and(|f| !same_place(f, &t.name))),
        difference: ReaderDifference {
            feature: "textures that are not at the path in the file",
            others: "most programs search only there",
            here: "also searched for by file name beside the model and its library, ignoring case",
        },
    },
    Known {
        is_there: |file, _| file.model.mesh.colors.iter().any(|c| c[..3] != [1.0; 3]),
        difference: ReaderDifference {
            feature: "vertex colors",
            others: "tobj returns the numbers as written",
            here: "taken as sRGB, as three.js does, and multiplied with the diffuse color",
        },
    },
];

/// Finds the differences that apply; they are known for OBJ only.
pub(super) fn find(file: &ModelFile, textures: &[TextureUse]) -> Vec<ReaderDifference> {
    if file.format != Format::Obj {
        return Vec::new();
    }
    KNOWN.into_iter().filter(|known| (known.is_there)(file, textures)).map(|known| known.difference).collect()
}

fn materials(file: &ModelFile) -> impl Iterator<Item = &Material> {
    file.model.materials.iter()
}

/// Whether a diagnostic or an element of the file contains this word.
fn mentions(model: &Model, word: &str) -> bool {
    model.diagnostics.iter().any(|d| d.message.contains(word)) || model.contents.iter().any(|(w, _)| w.contains(word))
}

fn counted(model: &Model, what: &str) -> u64 {
    model.contents.iter().find(|(name, _)| name == what).map_or(0, |(_, count)| *count)
}

fn has_smoothing(model: &Model) -> bool {
    model.mesh.smoothing_groups.iter().any(|group| *group != 0)
}

fn is_black_beside_map(material: &Material, property: &str) -> bool {
    material.sources.iter().any(|s| s.property == property && s.rule.contains("black"))
}

fn writes(material: &Material, property: &str, keyword: &str) -> bool {
    let mut words = material.sources.iter().filter(|s| s.property == property).map(|s| s.written.split_whitespace());
    words.any(|mut words| words.next().is_some_and(|word| word.eq_ignore_ascii_case(keyword)))
}

/// Neither 0 nor 1, where both encodings agree.
fn is_grey_or_coloured(color: [f32; 3]) -> bool {
    color.iter().any(|c| *c > 0.0 && *c < 1.0)
}

fn uses(file: &ModelFile) -> bool {
    file.model.diagnostics.iter().any(|d| d.message.contains("mtllib"))
}

/// Whether `found` ends in `name`, as written.
fn same_place(found: &str, name: &str) -> bool {
    let tidy = |text: &str| text.replace('\\', "/").trim_start_matches("./").to_owned();
    tidy(found).ends_with(&tidy(name)) || found.contains('#')
}
