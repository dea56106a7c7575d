//! Flat, Gouraud and Phong shading, and the cost and the benefit of triangles.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_scene::scene_file::{Normals, Shading};

/// Flat, flat per face, Gouraud, Phong on a sphere of 224 triangles, and on Suzanne.
pub fn section() -> Result<Section, GalleryError> {
    let sphere = |name: &str, caption: &str, remark: &str, shading, equation: &str, look: &str| {
        let scene = BaseScene::Sphere.with(|s| s.objects[0].shading = shading)?;
        Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).remark(remark).about(equation, look))
    };
    let suzanne = |name: &str, caption: &str, remark: &str, shading, normals, look: &str| {
        let scene = BaseScene::Suzanne.with(|s| {
            s.objects[0].shading = shading;
            s.objects[0].normals = normals;
            s.camera.fov_y = Some(21.0);
            s.camera.target = Some([-0.04, 0.1, 0.3]);
        })?;
        Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).remark(remark).about("L_o = A + E + Σ_i … !{N}", look))
    };
    let spheres = vec![
        sphere(
            "flat",
            "flat",
            "N of the triangle",
            Shading::Flat,
            "!{N} = {(p_1 − p_0) × (p_2 − p_0)} / |…|",
            "One normal for each triangle, L and V at every fragment: facets, each with a part of the highlight.",
        )?,
        sphere(
            "flat-per-face",
            "flat, per face",
            "once for each triangle",
            Shading::FlatPerFace,
            "L_o ( !{\\f{p_0 + p_1 + p_2}{3}} )",
            "The whole equation once for each triangle, at its centroid: every facet has one colour.",
        )?,
        sphere(
            "gouraud",
            "Gouraud",
            "at the vertices",
            Shading::Gouraud,
            "L_o = α !{L_o(p_0)} + β !{L_o(p_1)} + γ !{L_o(p_2)}",
            "Light at the vertices, interpolated. A highlight between vertices is dim and angular.",
        )?,
        sphere(
            "phong",
            "Phong",
            "at every fragment",
            Shading::Phong,
            "!{N} = \\f{α N_0 + β N_1 + γ N_2}{|α N_0 + β N_1 + γ N_2|}",
            "The normal is interpolated and normalised, and the equation is evaluated at the fragment: a round highlight \
             on the same 224 triangles. Only the outline reveals them.",
        )?,
    ];
    let mut row = spheres;
    row.push(suzanne(
        "suzanne-flat",
        "Suzanne, flat",
        "15 744 triangles",
        Shading::Flat,
        Normals::Flat,
        "With many triangles, flat shading approximates the diffuse term well; the highlights still differ.",
    )?);
    row.push(suzanne(
        "suzanne-phong",
        "Suzanne, Phong",
        "the same mesh",
        Shading::Phong,
        Normals::File,
        "The same triangles with the normals of the file.",
    )?);
    Ok(Section {
        id: "shading",
        title: "Where the equation is evaluated",
        equation: "once for each triangle,  at the vertices,  at every fragment",
        introduction: "The equation is the same in all six pictures. They differ in the source of N and in the \
                       points where the sum is evaluated.",
        rows: vec![row],
    })
}

/// Coarse and smooth, Gouraud and Phong, with the numbers of vertices and fragments lit.
pub fn cost_section() -> Result<Section, GalleryError> {
    let exhibit = |name: &str, model: &str, shading, caption: &str, look: &str| {
        let scene = BaseScene::Sphere.with(|s| {
            s.objects[0].model = format!("builtin:{model}");
            s.objects[0].shading = shading;
            s.objects[0].material.shininess = Some(64.0);
        })?;
        let equation = match shading {
            Shading::Gouraud => "L_o = α !{L_o(p_0)} + β !{L_o(p_1)} + γ !{L_o(p_2)}",
            _ => "L_o(!{N}) at every fragment",
        };
        Ok::<_, GalleryError>(Exhibit::new(name, caption, scene).aspect(1.3).with_counts().about(equation, look))
    };
    let gouraud = Shading::Gouraud;
    Ok(Section {
        id: "triangles",
        title: "Triangles",
        equation: "triangles,   vertices and fragments lit",
        introduction: "Gouraud shading evaluates light at each vertex, Phong shading at each fragment. The renderer \
                       reports the counts below the pictures.",
        rows: vec![vec![
            exhibit(
                "triangles-coarse",
                "sphere-coarse",
                gouraud,
                "224, Gouraud",
                "The file has one normal per face, so Gouraud shading looks flat.",
            )?,
            exhibit(
                "triangles-averaged",
                "sphere-coarse-averaged",
                gouraud,
                "224, averaged normals",
                "The same triangles with averaged normals: smooth, but the highlight has the shape of the mesh.",
            )?,
            exhibit(
                "triangles-smooth",
                "sphere-smooth",
                gouraud,
                "3 968, Gouraud",
                "Enough vertices for the highlight, although light is summed only there.",
            )?,
            exhibit(
                "triangles-averaged-phong",
                "sphere-coarse-averaged",
                Shading::Phong,
                "224, Phong",
                "Few triangles with a normal for each fragment: everything but the outline is right.",
            )?,
            exhibit(
                "triangles-smooth-phong",
                "sphere-smooth",
                Shading::Phong,
                "3 968, Phong",
                "The triangles are no longer visible.",
            )?,
            Exhibit::new("triangles-suzanne", "15 744, Phong", BaseScene::Suzanne.scene()?)
                .aspect(1.3)
                .with_counts()
                .about("L_o(!{N}) at every fragment", "About as many triangles as a small character in a game."),
        ]],
    })
}
