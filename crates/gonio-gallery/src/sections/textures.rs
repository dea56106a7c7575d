//! Textures and their filters; tone maps.

use crate::GalleryError;
use crate::exhibit::{BaseScene, Exhibit, Section};
use gonio_light::color::ToneMap;
use gonio_scene::TextureFilter;
use gonio_scene::color_value::Color;
use gonio_scene::scene_file::SceneFile;

/// Two rows.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "textures",
        title: "Textures and tone",
        equation: "k_d(u, v),   from L_o to the screen",
        introduction: "Colour textures are decoded before light is summed. Exposure, a tone map and the sRGB curve follow: \
                       the second row shows the same light, overexposed by two and a half stops.",
        rows: vec![filters()?, tones()?],
    })
}

fn filters() -> Result<Vec<Exhibit>, GalleryError> {
    let close = |s: &mut SceneFile| {
        s.camera.position = Some([-3.2, 0.16, 1.45]);
        s.camera.target = Some([-1.0, 0.3, -0.25]);
        s.camera.fov_y = Some(36.0);
    };
    let exhibit = |name: &str, caption: &str, remark: &str, filter, look: &str| {
        let scene = BaseScene::StillLife.with(|s| {
            close(s);
            s.picture.texture_filter = filter;
        })?;
        Ok::<_, GalleryError>(
            Exhibit::new(name, caption, scene)
                .at_sheet_size()
                .remark(remark)
                .aspect(1.75)
                .about("k_d = !{texture(u, v)}", look),
        )
    };
    let without = BaseScene::StillLife.with(|s| {
        close(s);
        s.objects[0].material.textures = Some(false);
    })?;
    Ok(vec![
        Exhibit::new("texture-none", "without", without)
            .at_sheet_size()
            .remark("k_d of the material alone")
            .aspect(1.75)
            .about(
                "k_d ~{texture(u, v)}",
                "The floor and the crate have no colour of their own: their k_d comes from the texture.",
            ),
        exhibit(
            "texture-nearest",
            "nearest",
            "one texel for each sample",
            TextureFilter::Nearest,
            "Jagged edges near the eye, and noise in the distance, which would flicker in motion.",
        )?,
        exhibit(
            "texture-mipmap",
            "mipmaps",
            "smaller copies in the distance",
            TextureFilter::Mipmap,
            "No noise in the distance, but too blurred where the view grazes the floor.",
        )?,
        exhibit(
            "texture-anisotropic",
            "anisotropic",
            "several samples along the slope",
            TextureFilter::Anisotropic,
            "Sharp along the view direction, without noise across it.",
        )?,
    ])
}

fn tones() -> Result<Vec<Exhibit>, GalleryError> {
    let exhibit = |tone_map: ToneMap, caption: &str, remark: &str, equation: &str, look: &str| {
        let scene = BaseScene::StillLife.with(|s| {
            s.picture.tone_map = tone_map;
            s.picture.exposure = 2.5;
            // The background is light too: so much over-exposed it would no longer be dark.
            s.background.top = Color([0.001, 0.0013, 0.0022]);
            s.background.bottom = Color([0.003, 0.0035, 0.005]);
        })?;
        Ok::<_, GalleryError>(
            Exhibit::new(format!("tone-{tone_map}"), caption, scene).remark(remark).aspect(1.75).about(equation, look),
        )
    };
    Ok(vec![
        exhibit(
            ToneMap::None,
            "none",
            "clamped",
            "min(x, 1)",
            "Values above 1 are clipped per channel: the lit floor is plain white.",
        )?,
        exhibit(
            ToneMap::Reinhard,
            "Reinhard",
            "x / (1 + x)",
            "\\f{x}{1 + x}",
            "Nothing is clipped, and nothing is fully white: low contrast.",
        )?,
        exhibit(
            ToneMap::Aces,
            "ACES",
            "a filmic curve",
            "\\f{x (2.51 x + 0.03)}{x (2.43 x + 0.59) + 0.14}",
            "A shoulder for the highlights and a toe for the shadows; strong colours shift to primaries.",
        )?,
        exhibit(
            ToneMap::Agx,
            "AgX",
            "a gentler curve",
            "sigmoid(log_2 x)",
            "Bright colours shift towards white, as on film: the ember glows instead of being yellow.",
        )?,
    ])
}
