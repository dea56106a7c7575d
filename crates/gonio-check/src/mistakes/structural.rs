//! Mistakes that are not a change of one line.

use super::{Mistake, Model};

/// Mistakes that are another model, or more than any model has, and not a change of a line.
pub fn structural() -> Vec<Mistake> {
    let mistake = |(id, name, looks_like, fix): &(&str, &str, &str, &str)| Mistake {
        id: (*id).to_owned(),
        name: (*name).to_owned(),
        models: vec![Model::Phong, Model::Gouraud],
        looks_like: (*looks_like).to_owned(),
        fix: (*fix).to_owned(),
        lecture_section: "Where is the rendering equation computed?".to_owned(),
        ..Mistake::default()
    };
    STRUCTURAL.iter().map(mistake).collect()
}

/// Their ids, names, symptoms and fixes.
const STRUCTURAL: &[(&str, &str, &str, &str)] = &[
    (
        "phong-instead-of-gouraud",
        "The light is computed for each fragment instead of each vertex",
        "The picture is smoother than Gouraud shading is.",
        "Compute the light in the vertex shader and pass the colour to the fragment shader.",
    ),
    (
        "gouraud-instead-of-phong",
        "The light is computed for each vertex instead of each fragment",
        "The light is interpolated across triangles, and highlights are angular or missing.",
        "Pass position and normal to the fragment shader, and compute the light there.",
    ),
    (
        "ambient-in-cone",
        "The spot light's cone cuts the ambient term too",
        "Outside the cone the surface is black, where ambient light should remain.",
        "Multiply only the diffuse and specular terms by the cone's factor.",
    ),
    (
        "attenuation-other-formula",
        "The attenuation is not 1 / (kc + kl d + kq d^2)",
        "The light is too bright or too dark at most distances, or ends abruptly.",
        "`1.0 / (constant + linear * d + quadratic * d * d)`. In a project of your own this may be intended.",
    ),
];
