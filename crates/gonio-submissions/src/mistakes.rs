//! The mistakes that are put into programs: each changes one quantity.

use crate::expression::Site;
use crate::plan::{Answer, GeneratedTask, Matrices, NormalBy, Plan, Space, SumForm};

/// A mistake of the generator.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slip {
    /// Its key; the id in the catalogue if it has one.
    pub key: &'static str,
    /// Where the wrong quantity is computed.
    pub site: Site,
    /// Whether the catalogue (`exercises/mistakes.toml`) has it under its key.
    pub listed: bool,
    /// Whether a program with this answer and plan can have it.
    pub fits: fn(&Answer, &Plan) -> bool,
}

/// The id in the catalogue, where it is not the key.
pub(crate) fn id_of(key: &'static str) -> &'static str {
    match key {
        "specular-with-normal-and-light" => "specular-without-eye",
        "distance-of-surface-from-origin" => "attenuation-distance-from-origin",
        "reflection-by-normal" => "reflection-normal-only",
        "direction-reversed" | "direction-turned-by-view" | "direction-projected" => "skybox-wrong-direction",
        "diffuse-times-specular" => "terms-multiplied",
        _ => key,
    }
}

const fn listed(key: &'static str, site: Site, fits: fn(&Answer, &Plan) -> bool) -> Slip {
    Slip { key, site, listed: true, fits }
}

const fn unlisted(key: &'static str, site: Site, fits: fn(&Answer, &Plan) -> bool) -> Slip {
    Slip { key, site, listed: false, fits }
}

fn object(answer: &Answer, _: &Plan) -> bool {
    answer.task != GeneratedTask::Skybox
}

fn object_in_world(answer: &Answer, plan: &Plan) -> bool {
    object(answer, plan) && plan.space == Space::World
}

fn lit_in_eye(answer: &Answer, plan: &Plan) -> bool {
    answer.task.is_lit() && plan.space == Space::Eye
}

fn lit(answer: &Answer, _: &Plan) -> bool {
    answer.task.is_lit()
}

fn by_position(answer: &Answer, plan: &Plan) -> bool {
    answer.task.is_lit() && !plan.passes_directions
}

fn specular(answer: &Answer, _: &Plan) -> bool {
    answer.task.has_specular()
}

fn specular_by_position(answer: &Answer, plan: &Plan) -> bool {
    answer.task.has_specular() && !plan.passes_directions
}

fn specular_in_world(answer: &Answer, plan: &Plan) -> bool {
    specular_by_position(answer, plan) && plan.space == Space::World
}

fn phong(answer: &Answer, _: &Plan) -> bool {
    answer.task.has_specular() && !answer.half_vector
}

fn blinn(answer: &Answer, _: &Plan) -> bool {
    answer.task.has_specular() && answer.half_vector
}

fn diffuse(answer: &Answer, _: &Plan) -> bool {
    answer.task.has_diffuse()
}

fn whole(answer: &Answer, _: &Plan) -> bool {
    answer.task == GeneratedTask::LightEquation
}

/// A number in place of a written strength would be another strength, which is no mistake.
fn strengths_sent(answer: &Answer, plan: &Plan) -> bool {
    whole(answer, plan) && !answer.writes.strengths
}

fn whole_by_position(answer: &Answer, plan: &Plan) -> bool {
    whole(answer, plan) && !plan.passes_directions
}

/// The sum is written for uncoloured terms, and the highlight is coloured.
fn plain_sum(answer: &Answer, plan: &Plan) -> bool {
    whole(answer, plan) && plan.sum != SumForm::PerTerm && !answer.white_highlight
}

fn coloured_sum(answer: &Answer, plan: &Plan) -> bool {
    whole(answer, plan) && !answer.white_highlight && plan.sum != SumForm::Accumulated
}

fn one_light(answer: &Answer, plan: &Plan) -> bool {
    whole(answer, plan) && answer.lights == 1
}

fn two_lights(answer: &Answer, _: &Plan) -> bool {
    answer.lights == 2
}

fn mirror(answer: &Answer, _: &Plan) -> bool {
    answer.task == GeneratedTask::Reflection
}

fn mirror_by_formula(answer: &Answer, plan: &Plan) -> bool {
    mirror(answer, plan) && plan.formula
}

fn glass(answer: &Answer, _: &Plan) -> bool {
    answer.task == GeneratedTask::Refraction
}

fn bent(answer: &Answer, _: &Plan) -> bool {
    matches!(answer.task, GeneratedTask::Reflection | GeneratedTask::Refraction)
}

fn cubemap(answer: &Answer, _: &Plan) -> bool {
    !answer.task.is_lit()
}

fn sky(answer: &Answer, _: &Plan) -> bool {
    answer.task == GeneratedTask::Skybox
}

fn separate(answer: &Answer, plan: &Plan) -> bool {
    object(answer, plan) && plan.matrices == Matrices::Separate
}

/// M or V M is at hand where the normal is transformed.
fn has_matrix(answer: &Answer, plan: &Plan) -> bool {
    object(answer, plan) && plan.normal_by != NormalBy::RowTimesInverse
}

/// Every mistake.
pub(crate) const SLIPS: &[Slip] = &[
    listed("normal-by-model-matrix", Site::NormalTransform, has_matrix),
    listed("normal-by-model-view", Site::NormalTransform, object_in_world),
    listed("normal-by-whole-matrix", Site::NormalTransform, separate),
    listed("normal-not-transformed", Site::NormalTransform, object),
    listed("normal-translated", Site::NormalTransform, object),
    listed("normal-is-position", Site::NormalTransform, object),
    listed("normal-reversed", Site::NormalTransform, object),
    unlisted("normal-in-world-space", Site::NormalTransform, lit_in_eye),
    listed("normal-not-normalised-in-vertex", Site::Normal, |a, _| a.task.is_per_vertex()),
    listed("normal-not-renormalised", Site::Normal, |a, p| object(a, p) && !a.task.is_per_vertex()),
    listed("position-not-transformed", Site::Position, object),
    listed("position-without-translation", Site::Position, object),
    listed("position-in-view-space", Site::Position, object_in_world),
    listed("position-in-clip-space", Site::Position, separate),
    unlisted("position-in-world-space", Site::Position, lit_in_eye),
    listed("matrix-order", Site::ClipPosition, separate),
    listed("matrix-order-reversed", Site::ClipPosition, separate),
    listed("model-matrix-missing", Site::ClipPosition, separate),
    listed("view-matrix-missing", Site::ClipPosition, separate),
    listed("projection-matrix-missing", Site::ClipPosition, separate),
    unlisted("clip-without-translation", Site::ClipPosition, separate),
    unlisted("clip-row-vector", Site::ClipPosition, separate),
    listed("light-direction-reversed", Site::LightDirection, lit),
    listed("light-direction-not-normalised", Site::LightDirection, lit),
    listed("light-direction-minus-normal", Site::LightDirection, by_position),
    listed("light-position-as-direction", Site::LightDirection, by_position),
    unlisted("light-from-eye", Site::LightDirection, specular_in_world),
    listed("light-direction-plus-position", Site::LightDirection, by_position),
    unlisted("position-of-other-light", Site::LightDirection, |a, p| a.lights == 2 && p.loops),
    listed("view-direction-reversed", Site::ViewDirection, specular),
    listed("view-direction-not-normalised", Site::ViewDirection, |a, _| {
        a.task.has_specular() || a.task == GeneratedTask::Refraction
    }),
    listed("view-position-as-direction", Site::ViewDirection, |a, p| specular_in_world(a, p) || bent(a, p)),
    listed("view-position-at-origin", Site::ViewDirection, |a, p| specular_in_world(a, p) || bent(a, p)),
    listed("view-direction-is-front", Site::ViewDirection, specular),
    unlisted("view-plus-position", Site::ViewDirection, |a, p| specular_in_world(a, p) || bent(a, p)),
    unlisted("view-from-light", Site::ViewDirection, specular_in_world),
    listed("diffuse-not-clamped", Site::DiffuseCosine, diffuse),
    listed("diffuse-absolute", Site::DiffuseCosine, diffuse),
    listed("diffuse-floor", Site::DiffuseCosine, diffuse),
    listed("diffuse-half-lambert", Site::DiffuseCosine, diffuse),
    listed("diffuse-min-for-max", Site::DiffuseCosine, diffuse),
    listed("diffuse-without-cosine", Site::DiffuseCosine, diffuse),
    unlisted("diffuse-with-view", Site::DiffuseCosine, whole),
    unlisted("diffuse-cosine-squared", Site::DiffuseCosine, diffuse),
    unlisted("diffuse-sine", Site::DiffuseCosine, diffuse),
    listed("specular-reflect-sign", Site::Mirror, phong),
    listed("specular-reflect-swapped", Site::Mirror, phong),
    listed("reflection-arguments-swapped", Site::Mirror, mirror),
    unlisted("formula-without-2", Site::Mirror, |a, p| phong(a, p) || mirror_by_formula(a, p)),
    unlisted("formula-plus", Site::Mirror, phong),
    listed("half-vector-not-normalised", Site::Mirror, blinn),
    listed("half-vector-of-unequal-vectors", Site::Mirror, blinn),
    unlisted("half-vector-minus", Site::Mirror, blinn),
    listed("specular-not-clamped", Site::SpecularCosine, specular),
    listed("specular-absolute", Site::SpecularCosine, specular),
    listed("specular-with-normal", Site::SpecularCosine, specular),
    listed("specular-with-light", Site::SpecularCosine, specular),
    listed("specular-without-eye", Site::SpecularCosine, |a, p| phong(a, p) && p.mirror != crate::plan::Mirror::OfView),
    listed("specular-with-normal-and-light", Site::SpecularCosine, specular),
    unlisted("specular-min-for-max", Site::SpecularCosine, specular),
    listed("specular-without-power", Site::Power, specular),
    listed("specular-multiplied-by-exponent", Site::Power, specular),
    listed("specular-exponent-wrong", Site::Power, |a, p| specular(a, p) && !a.writes.exponent),
    listed("specular-power-swapped", Site::Power, specular),
    listed("attenuation-distance-of-direction", Site::Distance, whole),
    listed("attenuation-with-view-distance", Site::Distance, whole_by_position),
    listed("attenuation-plus-view-distance", Site::Distance, whole_by_position),
    listed("attenuation-distance-from-origin", Site::Distance, |a, p| {
        whole_by_position(a, p) && p.space == Space::World
    }),
    listed("distance-of-surface-from-origin", Site::Distance, |a, p| {
        whole_by_position(a, p) && p.space == Space::World
    }),
    unlisted("distance-light-to-eye", Site::Distance, |a, p| whole_by_position(a, p) && p.space == Space::World),
    listed("distance-squared", Site::Distance, whole),
    listed("attenuation-missing", Site::Attenuation, whole),
    listed("attenuation-without-constant", Site::Attenuation, whole),
    listed("attenuation-without-linear", Site::Attenuation, whole),
    listed("attenuation-without-quadratic", Site::Attenuation, whole),
    listed("attenuation-distance-not-squared", Site::Attenuation, whole),
    listed("attenuation-inverse-square", Site::Attenuation, whole),
    listed("attenuation-inverse-distance", Site::Attenuation, whole),
    listed("attenuation-swapped", Site::Attenuation, |a, p| whole(a, p) && !a.writes.attenuation),
    listed("attenuation-not-inverted", Site::Attenuation, whole),
    unlisted("attenuation-cubed", Site::Attenuation, whole),
    unlisted("attenuation-constant-outside", Site::Attenuation, whole),
    unlisted("attenuation-minus-linear", Site::Attenuation, whole),
    listed("ambient-strength-missing", Site::Ambient, strengths_sent),
    unlisted("ambient-strength-is-diffuse", Site::Ambient, strengths_sent),
    listed("diffuse-strength-missing", Site::Diffuse, strengths_sent),
    unlisted("diffuse-strength-is-specular", Site::Diffuse, strengths_sent),
    unlisted("diffuse-strength-squared", Site::Diffuse, strengths_sent),
    listed("specular-strength-missing", Site::Specular, strengths_sent),
    listed("specular-strength-is-diffuse", Site::Specular, strengths_sent),
    unlisted("specular-strength-squared", Site::Specular, strengths_sent),
    listed("ambient-missing", Site::Sum, whole),
    listed("diffuse-missing", Site::Sum, whole),
    listed("specular-missing", Site::Sum, whole),
    listed("ambient-attenuated", Site::Sum, whole),
    listed("diffuse-not-attenuated", Site::Sum, whole),
    listed("specular-not-attenuated", Site::Sum, whole),
    listed("terms-not-put-out", Site::Sum, |a, p| plain_sum(a, p) && a.lights == 1),
    // Twice a written strength is another strength, a grey of written numbers another colour, and with a written colour each term
    // may have its own.
    listed("ambient-twice", Site::Sum, |a, p| one_light(a, p) && !a.writes.strengths && !a.writes.material),
    listed("ambient-times-diffuse", Site::Sum, whole),
    listed("ambient-as-maximum", Site::Sum, |a, p| coloured_sum(a, p) && a.lights == 1),
    listed("ambient-not-coloured", Site::Sum, |a, p| coloured_sum(a, p) && !(a.writes.strengths && a.writes.material)),
    listed("terms-multiplied", Site::Sum, plain_sum),
    listed("diffuse-times-specular", Site::Sum, plain_sum),
    listed("attenuation-added", Site::Sum, |a, p| plain_sum(a, p) && a.lights == 1),
    listed("albedo-squared", Site::Sum, |a, p| coloured_sum(a, p) && !a.writes.material),
    listed("albedo-missing", Site::Sum, |a, p| plain_sum(a, p) && !a.writes.material),
    listed("albedo-added", Site::Sum, |a, p| plain_sum(a, p) && a.lights == 1),
    listed("attenuation-twice", Site::Sum, plain_sum),
    unlisted("specular-subtracted", Site::Sum, plain_sum),
    unlisted("sum-minimum", Site::Sum, plain_sum),
    listed("second-light-missing", Site::Lights, two_lights),
    listed("lights-overwritten", Site::Lights, two_lights),
    listed("gamma-applied", Site::Output, one_light),
    listed("output-normal", Site::Output, one_light),
    listed("output-constant", Site::Output, one_light),
    unlisted("channels-swapped", Site::Output, |a, p| whole(a, p) && !a.writes.material),
    listed("reflection-by-normal", Site::Mirror, bent),
    listed("reflection-by-position", Site::Mirror, bent),
    listed("reflection-by-view", Site::Mirror, bent),
    listed("reflection-vector-reversed", Site::Mirror, mirror),
    listed("refraction-instead-of-reflection", Site::Mirror, mirror),
    listed("refraction-view-reversed", Site::Mirror, glass),
    listed("reflection-instead-of-refraction", Site::Mirror, glass),
    unlisted("refract-swapped", Site::Mirror, glass),
    listed("refraction-ratio-inverted", Site::Ratio, glass),
    listed("refraction-ratio-missing", Site::Ratio, glass),
    unlisted("refraction-ratio-squared", Site::Ratio, |a, p| glass(a, p) && !a.writes.index),
    listed("lookup-mirrored", Site::Lookup, cubemap),
    listed("lookup-flipped", Site::Lookup, cubemap),
    listed("lookup-depth-mirrored", Site::Lookup, bent),
    unlisted("lookup-swizzled", Site::Lookup, cubemap),
    listed("skybox-keeps-translation", Site::Turn, sky),
    listed("skybox-not-turned", Site::Turn, sky),
    listed("direction-reversed", Site::Direction, sky),
    listed("direction-turned-by-view", Site::Direction, sky),
    listed("direction-projected", Site::Direction, sky),
];
