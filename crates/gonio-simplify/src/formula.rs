//! The equation after any set of simplifications, in the notation of the lecture, and what a step strikes out and adds.

use gonio_trace::Simplification::{
    Ambient, Attenuation, Brdf, Cosine, Emission, Interreflection, Shadows, Sum, Time, Wavelengths,
};
use gonio_trace::Simplifications;

/// The pieces of an equation: markup of [`gonio_gallery::markup`], one symbol or group of symbols each.
pub type Formula = Vec<&'static str>;

/// The equation with these simplifications. `keeps_cosine`: the scene's specular term has its cosine, so that
/// [`Cosine`] changes nothing.
pub fn formula(simplified: Simplifications, keeps_cosine: bool) -> Formula {
    let has = |one| simplified.contains(one);
    let mut pieces: Formula = Vec::new();
    // The arguments of a function: place, directions, wavelength, moment.
    let call = |pieces: &mut Formula, name: &'static str, directions: &[&'static str]| {
        pieces.extend([name, "(", "x"]);
        pieces.extend(directions);
        if !has(Wavelengths) {
            pieces.push(", λ");
        }
        if !has(Time) {
            pieces.push(", t");
        }
        pieces.push(")");
    };
    // As in the lecture, the direction goes once the light that comes in does not depend on directions either.
    let out: &[&str] = if has(Brdf) && has(Interreflection) { &[] } else { &[", ω_o"] };
    call(&mut pieces, "L_o", out);
    pieces.push("=");
    if has(Ambient) {
        pieces.extend(["A", "+"]);
    }
    if has(Emission) {
        pieces.push("E");
    } else {
        call(&mut pieces, "L_e", &[", ω_o"]);
    }
    pieces.push("+");
    pieces.push(if has(Sum) { "Σ_N" } else { "∫_Ω" });
    let splits_cosine = has(Cosine) && !keeps_cosine;
    match (has(Brdf), splits_cosine) {
        (false, false) => call(&mut pieces, "f_r", &[", ω_i", ", ω_o"]),
        (false, true) => {
            pieces.push("[");
            call(&mut pieces, "f_{diff}", &[", ω_i", ", ω_o"]);
            pieces.extend(["(ω_i·n)", "+"]);
            call(&mut pieces, "f_{spec}", &[", ω_i", ", ω_o"]);
            pieces.push("]");
        }
        // Blanks distinguish these parentheses from those of a function.
        (true, false) => pieces.extend(["( ", "diff", "+", "spec", " )"]),
        (true, true) => pieces.extend(["( ", "diff", "(ω_i·n)", "+", "spec", " )"]),
    }
    match (has(Interreflection), has(Shadows)) {
        (false, false) => call(&mut pieces, "L_i", &[", ω_i"]),
        // Light passes through surfaces, but those behind still emit and reflect.
        (false, true) => call(&mut pieces, "L_i^{V=1}", &[", ω_i"]),
        (true, blocked) => {
            pieces.push("L_i");
            if !has(Wavelengths) || !has(Time) {
                pieces.push("(");
                pieces.extend((!has(Wavelengths)).then_some("λ"));
                pieces.extend((!has(Wavelengths) && !has(Time)).then_some(", "));
                pieces.extend((!has(Time)).then_some("t"));
                pieces.push(")");
            }
            if !blocked {
                pieces.push(if has(Time) { "V(x, ω_i)" } else { "V(x, ω_i, t)" });
            }
        }
    }
    if has(Attenuation) {
        pieces.push("att_i");
    }
    if !splits_cosine {
        pieces.push("(ω_i·n)");
    }
    if !has(Sum) {
        pieces.push("dω_i");
    }
    pieces
}

/// What happens to a piece in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// It is in both equations.
    Kept,
    /// It is in the first one only.
    Removed,
    /// It is in the second one only.
    Added,
}

/// The pieces of both equations in order, with what the step does to each: the fewest changes.
pub fn changes(before: &Formula, after: &Formula) -> Vec<(&'static str, Change)> {
    // The length of the longest common subsequence of what is left of both.
    let mut common = vec![vec![0_usize; after.len() + 1]; before.len() + 1];
    for i in (0..before.len()).rev() {
        for j in (0..after.len()).rev() {
            common[i][j] = match before[i] == after[j] {
                true => common[i + 1][j + 1] + 1,
                false => common[i + 1][j].max(common[i][j + 1]),
            };
        }
    }
    let (mut i, mut j) = (0, 0);
    let mut all = Vec::new();
    while i < before.len() || j < after.len() {
        if i < before.len() && j < after.len() && before[i] == after[j] {
            all.push((before[i], Change::Kept));
            (i, j) = (i + 1, j + 1);
        } else if j == after.len() || (i < before.len() && common[i + 1][j] >= common[i][j + 1]) {
            all.push((before[i], Change::Removed));
            i += 1;
        } else {
            all.push((after[j], Change::Added));
            j += 1;
        }
    }
    all
}

/// The first equation with what the step removes struck out, as markup.
pub fn struck(changes: &[(&'static str, Change)]) -> String {
    written(changes, Change::Removed, "-{", Change::Added)
}

/// The second equation with what the step adds stressed, as markup.
pub fn result(changes: &[(&'static str, Change)]) -> String {
    written(changes, Change::Added, "!{", Change::Removed)
}

/// All pieces but those of one kind; runs of another kind are marked.
fn written(changes: &[(&'static str, Change)], marked: Change, mark: &str, left_out: Change) -> String {
    let mut text = String::new();
    let mut is_marked = false;
    for &(piece, change) in changes.iter().filter(|(_, change)| *change != left_out) {
        if is_marked && change != marked {
            text.push('}');
        }
        text.push(' ');
        if change == marked && !is_marked {
            text.push_str(mark);
        }
        is_marked = change == marked;
        text.push_str(piece.trim());
    }
    if is_marked {
        text.push('}');
    }
    text.trim_start().to_owned()
}

/// An equation as markup.
pub fn plain(formula: &Formula) -> String {
    formula.iter().map(|piece| piece.trim()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_trace::Simplification;

    fn without_blanks(text: &str) -> String {
        text.chars().filter(|c| !c.is_whitespace()).collect()
    }

    #[test]
    fn both_ends_are_the_equations_of_the_lecture() {
        assert_eq!(
            without_blanks(&plain(&formula(Simplifications::NONE, false))),
            "L_o(x,ω_o,λ,t)=L_e(x,ω_o,λ,t)+∫_Ωf_r(x,ω_i,ω_o,λ,t)L_i(x,ω_i,λ,t)(ω_i·n)dω_i"
        );
        // The lecture's REMARK: the specular term has no cosine, unless the scene asks for it.
        assert_eq!(
            without_blanks(&plain(&formula(Simplifications::ALL, false))),
            "L_o(x)=A+E+Σ_N(diff(ω_i·n)+spec)L_iatt_i"
        );
        assert_eq!(
            without_blanks(&plain(&formula(Simplifications::ALL, true))),
            "L_o(x)=A+E+Σ_N(diff+spec)L_iatt_i(ω_i·n)"
        );
    }

    /// Whatever is on already: a step strikes out exactly what the next equation lacks, and adds the rest.
    #[test]
    fn steps_strike_out_what_the_next_equation_lacks() {
        for bits in 0..1_u32 << Simplification::ALL.len() {
            let set: Simplifications =
                Simplification::ALL.iter().copied().filter(|&one| bits >> one as u32 & 1 == 1).collect();
            for &one in Simplification::ALL.iter().filter(|&&one| !set.contains(one)) {
                let (before, after) = (formula(set, false), formula(set.with(one), false));
                let all = changes(&before, &after);
                let left = |out: Change| all.iter().filter(|c| c.1 != out).map(|c| c.0).collect::<Formula>();
                assert_eq!((left(Change::Added), left(Change::Removed)), (before, after));
                // Nothing is struck out only to be written again at the same place.
                for pair in all.windows(2) {
                    assert!(pair[0].0 != pair[1].0 || pair[0].1 == pair[1].1, "{one}: {all:?}");
                }
            }
        }
    }

    #[test]
    fn every_step_of_the_staircase_changes_the_equation() {
        let mut set = Simplifications::NONE;
        for &one in Simplification::ALL {
            let all = changes(&formula(set, false), &formula(set.with(one), false));
            let count = |kind| all.iter().filter(|c| c.1 == kind).count();
            assert!(count(Change::Removed) + count(Change::Added) > 0, "{one}");
            assert_eq!(struck(&all).contains("-{"), count(Change::Removed) > 0, "{one}");
            assert_eq!(result(&all).contains("!{"), count(Change::Added) > 0, "{one}");
            set = set.with(one);
        }
        let time = changes(&formula(Simplifications::NONE, false), &formula(Simplifications::NONE.with(Time), false));
        let brdf = Simplifications::up_to(Emission);
        let brdf = changes(&formula(brdf, false), &formula(brdf.with(Brdf), false));
        assert!(without_blanks(&struck(&brdf)).contains("∫_Ω-{f_r(x,ω_i,ω_o)}L_i(x,ω_i)"), "{}", struck(&brdf));
        assert!(struck(&time).starts_with("L_o ( x , ω_o , λ -{, t} ) = L_e"), "{}", struck(&time));
    }
}
