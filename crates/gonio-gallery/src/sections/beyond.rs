//! Stations beyond the rendering equation: what the equation leaves out.

use crate::GalleryError;
use crate::exhibit::{Exhibit, Section};
use crate::station_exhibit::StationExhibit;

/// A row of five stations, and another one.
pub fn section() -> Result<Section, GalleryError> {
    Ok(Section {
        id: "beyond",
        title: "Beyond the rendering equation",
        equation: "L_o(x, ω_o, λ, t) = L_e + ∫_Ω f_r(x, ω_i, ω_o) L_i(x, ω_i, λ, t) (N·ω_i) dω_i",
        introduction: "What the rendering equation leaves out: each picture breaks one of its assumptions. `gonio \
         beyond` writes them large, with the law as a plot and checks that measure it.",
        rows: vec![first_row()?, second_row()?],
    })
}

fn exhibit(station: &str, caption: &str) -> Result<Exhibit, GalleryError> {
    let found = StationExhibit::of(station);
    let found = found.ok_or_else(|| GalleryError::Incomplete(format!("there is no station `{station}`")))?;
    Ok(Exhibit::station(caption, found))
}

fn first_row() -> Result<Vec<Exhibit>, GalleryError> {
    Ok(vec![
        exhibit("transmission", "transmission")?.remark("light leaves on the other side").about(
            "n_1 sin θ_1 = n_2 sin θ_2",
            "Water and glass let light through and bend it: the pencil breaks at the water, which is a lens and \
            turns the lower arrow round.",
        ),
        exhibit("subsurface", "subsurface scattering")?.remark("light leaves at another place").about(
            "L_o(!{x_o}, ω_o) = ∫_A ∫_Ω S(!{x_i}, ω_i, x_o, ω_o) L_i (N·ω_i) dω_i dA",
            "Pawns of marble, milk, potato and skin with the lamp behind them: light enters, is scattered many times \
            and leaves elsewhere, so that rims and thin parts glow.",
        ),
        exhibit("polarisation", "polarisation")?.remark("light has a direction of oscillation").about(
            "R_p(θ_B) = 0,   tan θ_B = n",
            "Inside the filter the reflection on the water is gone: near Brewster's angle all of it is polarised, \
            and the stones show.",
        ),
        exhibit("phosphorescence", "phosphorescence")?.remark("light leaves later").about(
            "L_o(t) = \\f{n_0}{τ} e^{−t/τ}",
            "The lamp went out three seconds ago. Each pigment gives its light back with a time constant of its own.",
        ),
        exhibit("interference", "interference")?.remark("amplitudes add, not radiances").about(
            "R = |\\f{r_1 + r_2 e^{iφ}}{1 + r_1 r_2 e^{iφ}}|^2,   φ = \\f{4π n d cos θ_t}{λ}",
            "A soap film that drains: each band is a line of equal thickness, and where the film is thinnest it is \
            black.",
        ),
    ])
}

fn second_row() -> Result<Vec<Exhibit>, GalleryError> {
    Ok(vec![
        exhibit("fluorescence", "fluorescence")?.remark("light changes its wavelength").about(
            "L_o(!{λ_o}) = Σ_{λ_i} M(!{λ_o}, !{λ_i}) L_i(λ_i)",
            "Highlighters below an ultraviolet lamp that the eye does not see: all light in the picture is light of \
            another wavelength.",
        ),
        exhibit("nonlinear", "non-linear effects")?.remark("twice the light, four times the glow").about(
            "L_o = c I^{!{2}}",
            "Two photons at the same moment: the lower beam glows at its focus only, where its light is concentrated.",
        ),
        exhibit("doppler", "relativistic Doppler effect")?.remark("light has a speed").about(
            "λ' = \\f{λ}{D},   D = \\f{1}{γ (1 − v cos θ')}",
            "Green dice at 0.35 of the speed of light: blue and bright where they approach, red and dark where they \
            leave, and all turned.",
        ),
        exhibit("fog", "the volume rendering equation")?.remark("light between the surfaces").about(
            "\\f{dL}{ds} = −σ_t L + σ_a L_e + σ_s ∫_S p L_i dω_i",
            "Fog scatters the spotlight's light to the camera, bars before the lamp cut shadows out of the air, and \
            the flame is a medium that emits.",
        ),
        exhibit("transient", "the transient rendering equation")?.remark("light in flight").about(
            "L_o(x, ω_o, !{t}) = L_e + ∫_Ω f_r L_i(x, ω_i, !{t − d/c}) (N·ω_i) dω_i",
            "4.5 nanoseconds after a flash: its light is a ring on the table, and the mirror has sent a second one.",
        ),
    ])
}
