//! Environments laid out on the plane: panoramas, crosses, the two layouts of faces.

use super::super::converted::{Converted, Target};
use super::super::exhibit::{Exhibit, Section};
use crate::report::CliError;
use gonio_environment::{Arrangement, Builtin, Layout};

/// Two rows: the room there and back, and the debug cubemap.
pub fn section() -> Result<Section, CliError> {
    Ok(Section {
        id: "cubemaps",
        title: "Panorama to cubemap",
        equation: "u = \\f{1}{2} + \\f{atan(x / −z)}{2π},   v = \\f{acos y}{π}   ↔   (s, t) = \\f{(±d_1, ±d_2)}{|d_{max}|}",
        introduction: "One function of a direction, laid out in several ways. OpenGL's faces are left-handed: in a viewer \
                       they are mirrored, and what is straight ahead, −Z, is at the end. Photographic faces look right, \
                       and straight ahead is in the middle.",
        rows: vec![room(), debug()],
    })
}

fn room() -> Vec<Exhibit> {
    let make = |to| Converted { from: Builtin::Room, to };
    let cross = |layout| make(Target::Faces(Arrangement::Cross, layout));
    vec![
        Exhibit::converted("room-panorama", "a panorama", make(Target::Panorama)).remark("512 × 256, straight ahead is −Z").tells(
            "u = \\f{1}{2} + \\f{φ}{2π},   v = \\f{θ}{π}",
            "Longitude to the right, latitude downwards: what is straight is bent, and the poles are stretched to whole \
             rows.",
        ),
        Exhibit::converted("room-cross-opengl", "six faces, opengl", cross(Layout::OpenGl))
            .joined(Some("→"))
            .remark("as texture(samplerCube, d) wants them")
            .tells(
                "+X: (s, t) = \\f{(−z, −y)}{|x|}",
                "The cross of the room in a mirror: red and blue walls have changed sides. The rows and columns are those \
                 of OpenGL's table, so that no shader has to turn anything.",
            ),
        Exhibit::converted("room-cross-photographic", "the same, photographic", cross(Layout::Photographic))
            .joined(Some("="))
            .remark("as it looks from inside")
            .tells(
                "d → (x, y, !{−z})",
                "As six photographs would be: the window straight ahead, the blue wall to the right. Most cubemaps that \
                 are given away are like this.",
            ),
        Exhibit::converted("room-panorama-back", "and back", make(Target::PanoramaBack(128)))
            .joined(Some("→"))
            .remark("from faces of 128 × 128")
            .tells(
                "E(θ, φ) = cubemap(d(θ, φ))",
                "Faces a quarter as wide as the panorama keep nearly all of it, and none of the twelve edges can be seen.",
            ),
    ]
}

fn debug() -> Vec<Exhibit> {
    let make = |to| Converted { from: Builtin::Debug, to };
    let faces = |arrangement, layout| make(Target::Faces(arrangement, layout));
    vec![
        Exhibit::converted("debug-panorama", "debug", make(Target::Panorama)).remark("six faces as a panorama").tells(
            "E(d) = cubemap(d)",
            "−Z in the middle, +X to its right, +Z half on the left and half on the right; every word can be read.",
        ),
        Exhibit::converted("debug-cross-opengl", "opengl", faces(Arrangement::Cross, Layout::OpenGl))
            .joined(Some("→"))
            .remark("mirrored, and right")
            .tells(
                "texture(samplerCube, !{d})",
                "A viewer shows OpenGL's faces as a mirror does. Seen from inside the cube, by the eye at its middle, the \
                 writing is the right way round.",
            ),
        Exhibit::converted(
            "debug-cross-photographic",
            "photographic",
            faces(Arrangement::Cross, Layout::Photographic),
        )
        .joined(Some("="))
        .remark("legible, and posz is −Z")
        .tells(
            "texture(samplerCube, !{(x, y, −z)})",
            "The names say which file each face is in: posz is straight ahead here. Sampled as it is by OpenGL, the whole \
             world would be mirrored.",
        ),
        Exhibit::converted(
            "debug-vertical-cross",
            "a vertical cross",
            faces(Arrangement::VerticalCross, Layout::Photographic),
        )
        .joined(Some("="))
        .remark("the face behind is turned")
        .tells(
            "negz: (s, t) → !{(−s, −t)}",
            "As light probes have it: the face behind hangs at the bottom, turned by 180 degrees so that its edge goes on.",
        ),
    ]
}
