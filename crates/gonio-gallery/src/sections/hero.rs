//! The two pictures at the top.

use crate::GalleryError;
use crate::base_scene::BaseScene;
use crate::exhibit::{Exhibit, Section};

const WHOLE: &str = "L_o = A + E + Σ_i [ diff k_d ⟨N·L_i⟩ + k_s spec_i ] L_i att_i spot_i";

/// The still life and Suzanne.
pub fn section() -> Result<Section, GalleryError> {
    let still_life = Exhibit::new("still-life", "A still life by the whole equation", BaseScene::StillLife.scene()?)
        .aspect(1.72)
        .remark("a warm key, a cold rim, an ember that emits and lights what is around it")
        .about(
            WHOLE,
            "Four lights and an emitting body. The ember's E is the same from everywhere; the point light in its \
             middle is what falls on the floor and the donut, and fades with att.",
        );
    let suzanne = Exhibit::new("suzanne", "Suzanne in bronze", BaseScene::Suzanne.scene()?)
        .remark("15 744 triangles, a normal for every fragment")
        .about(
            WHOLE,
            "Key, rim and kicker: three point lights that differ in colour show which part of the surface faces which.",
        );
    Ok(Section { id: "whole", title: "", equation: WHOLE, introduction: "", rows: vec![vec![still_life, suzanne]] })
}
