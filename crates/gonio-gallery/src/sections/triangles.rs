//! The cost and the benefit of triangles.

use crate::GalleryError;
use crate::base_scene::BaseScene;
use crate::exhibit::{Exhibit, Section};
use gonio_scene::scene_file::Shading;

/// Coarse and smooth, Gouraud and Phong, with the numbers of vertices and fragments lit.
pub fn section() -> Result<Section, GalleryError> {
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
        introduction: "Gouraud shading pays for each vertex, Phong shading for each fragment. The counts below the \
                       pictures come from whoever drew them.",
        rows: vec![vec![
            exhibit(
                "triangles-coarse",
                "sphere-coarse",
                gouraud,
                "224, Gouraud",
                "The normals of the file are those of the faces: Gouraud shading is flat then.",
            )?,
            exhibit(
                "triangles-averaged",
                "sphere-coarse-averaged",
                gouraud,
                "224, averaged normals",
                "The same triangles with averaged normals: smooth, but the highlight has the corners of the mesh.",
            )?,
            exhibit(
                "triangles-smooth",
                "sphere-smooth",
                gouraud,
                "3 968, Gouraud",
                "Enough vertices for the highlight. Light is still summed only at them.",
            )?,
            exhibit(
                "triangles-averaged-phong",
                "sphere-coarse-averaged",
                Shading::Phong,
                "224, Phong",
                "Few triangles and a normal for each fragment: all is right but the outline.",
            )?,
            exhibit(
                "triangles-smooth-phong",
                "sphere-smooth",
                Shading::Phong,
                "3 968, Phong",
                "Nothing left to see of the triangles.",
            )?,
            Exhibit::new("triangles-suzanne", "15 744, Phong", BaseScene::Suzanne.scene()?)
                .aspect(1.3)
                .with_counts()
                .about("L_o(!{N}) at every fragment", "As many triangles as a small character in a game has."),
        ]],
    })
}
