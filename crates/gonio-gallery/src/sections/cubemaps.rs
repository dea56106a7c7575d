//! Environments laid out on the plane: panoramas, crosses, the two layouts of faces.

use crate::GalleryError;
use crate::environment_picture::{EnvironmentPicture, PictureForm};
use crate::exhibit::{Exhibit, Section};
use gonio_environment::{Arrangement, Builtin, Layout};

/// Two rows: the room as faces and back, and the debug cubemap.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "cubemaps",
        title: "Panorama to cubemap",
        equation: "u = \\f{1}{2} + \\f{atan(x / −z)}{2π},   v = \\f{acos y}{π}   →   (s, t) = \\f{(±d_1, ±d_2)}{|d_{max}|}",
        introduction: "One function of a direction, laid out in several ways. OpenGL's faces are left-handed: in a viewer \
                       they are mirrored, and the face ahead, −Z, comes last. Photographic faces look right, and the \
                       face ahead is in the middle.",
        rows: vec![room(), debug()],
    })
}

fn room() -> Vec<Exhibit> {
    let make = |form| EnvironmentPicture { from: Builtin::Room, form };
    let cross = |layout| make(PictureForm::Faces(Arrangement::Cross, layout));
    vec![
        Exhibit::environment("room-panorama", "a panorama", make(PictureForm::Panorama)).remark("built in: 512 × 256, −Z in the middle").about(
            "u = \\f{1}{2} + \\f{φ}{2π},   v = \\f{θ}{π}",
            "Longitude to the right, latitude downwards: straight lines are bent, and the poles are stretched to whole \
             rows.",
        ),
        Exhibit::environment("room-cross-opengl", "six faces, opengl", cross(Layout::OpenGl))
            .joined(Some("→"))
            .remark("as texture(samplerCube, d) expects them")
            .about(
                "+X: (s, t) = \\f{(−z, −y)}{|x|}",
                "The wall behind, +Z, is in the middle, and every face is mirrored. The rows and columns are those of OpenGL's \
                 table, so that no shader has to rotate anything.",
            ),
        Exhibit::environment("room-cross-photographic", "the same, photographic", cross(Layout::Photographic))
            .joined(Some("="))
            .remark("as it looks from inside")
            .about(
                "d → (x, y, !{−z})",
                "As six photographs would be: the window straight ahead, the blue wall to the right. Most free cubemaps \
                 are like this.",
            ),
        Exhibit::environment("room-panorama-back", "and back", make(PictureForm::PanoramaOfCubemap(128)))
            .joined(Some("→"))
            .remark("from faces of 128 × 128")
            .about(
                "E(θ, φ) = cubemap(d(θ, φ))",
                "Faces a quarter as wide as the panorama keep nearly all of its detail, and none of the twelve edges is visible.",
            ),
    ]
}

fn debug() -> Vec<Exhibit> {
    let make = |form| EnvironmentPicture { from: Builtin::Debug, form };
    let faces = |arrangement, layout| make(PictureForm::Faces(arrangement, layout));
    vec![
        Exhibit::environment("debug-panorama", "debug", make(PictureForm::Panorama)).remark("six faces as a panorama").about(
            "E(d) = cubemap(d)",
            "−Z in the middle, +X to its right, +Z half on the left and half on the right; every word is legible.",
        ),
        Exhibit::environment("debug-cross-opengl", "opengl", faces(Arrangement::Cross, Layout::OpenGl))
            .joined(Some("→"))
            .remark("mirrored, as OpenGL expects")
            .about(
                "texture(samplerCube, !{d})",
                "A viewer shows OpenGL's faces mirrored. Seen from the middle of the cube, the writing is the right way \
                 round.",
            ),
        Exhibit::environment(
            "debug-cross-photographic",
            "photographic",
            faces(Arrangement::Cross, Layout::Photographic),
        )
        .joined(Some("="))
        .remark("legible, and posz is −Z")
        .about(
            "texture(samplerCube, !{(x, y, −z)})",
            "The names say which file each face is in: posz is straight ahead here. Sampled unchanged by OpenGL, the whole \
             world would be mirrored.",
        ),
        Exhibit::environment(
            "debug-vertical-cross",
            "a vertical cross",
            faces(Arrangement::VerticalCross, Layout::Photographic),
        )
        .joined(Some("="))
        .remark("the face behind is rotated")
        .about(
            "negz: (s, t) → !{(−s, −t)}",
            "The format of light probes: the face behind is at the bottom, rotated by 180 degrees so that its edge matches.",
        ),
    ]
}
