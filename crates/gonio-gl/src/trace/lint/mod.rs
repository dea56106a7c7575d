//! Mistakes in a frame, found in its record alone.
//!
//! A rule finds calls that OpenGL executes without an error although they are hardly intended. For each sampler and each draw
//! the cause is reported, but not its consequences.

mod inputs;
mod samplers;

use super::data::{DrawRecord, FrameRecord};
use serde::Serialize;

/// Declares an enum with a written name for each variant. (`named_enum!` also generates a JSON Schema, which findings do not
/// have.)
macro_rules! named {
    ($(#[$meta:meta])* $Enum:ident { $($(#[$doc:meta])* $Variant:ident = $name:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
        pub enum $Enum {
            $($(#[$doc])* #[serde(rename = $name)] $Variant,)+
        }

        impl $Enum {
            /// Every variant.
            pub const ALL: &'static [$Enum] = &[$($Enum::$Variant),+];

            /// As reports write it.
            pub const fn name(self) -> &'static str {
                match self { $($Enum::$Variant => $name),+ }
            }
        }
    };
}

named! {
    /// The rules.
    Rule {
        /// A sampler was set to a texture's name, not to the unit that the texture is bound to.
        TextureNameAsUnit = "texture-name-as-unit",
        /// A sampler was never set, so it reads unit 0.
        SamplerNeverSet = "sampler-never-set",
        /// Samplers of two types read one unit.
        TwoSamplerTypes = "two-sampler-types",
        /// A draw reads a texture that is attached to the framebuffer it draws into.
        FeedbackLoop = "feedback-loop",
        /// A draw reads the texture that was bound for something else drawn before.
        StaleTexture = "stale-texture",
        /// A sampler reads a unit with a texture of another kind only.
        WrongTextureKind = "wrong-texture-kind",
        /// A sampler reads a unit with no texture.
        UnboundUnit = "unbound-unit",
        /// A texture lacks levels or faces that its filter needs, and reads as black.
        IncompleteTexture = "incomplete-texture",
        /// A uniform was never set, so it is 0.
        UniformNeverSent = "uniform-never-sent",
        /// Normals are multiplied with a matrix that does not fit an uneven scale of the model.
        NormalMatrix = "normal-matrix",
        /// An attribute has no array and no constant.
        AttributeWithoutArray = "attribute-without-array",
        /// The distance from vertex to vertex does not fit the data.
        WrongStride = "wrong-stride",
        /// A draw reads vertices beyond the end of a buffer.
        BeyondBuffer = "beyond-buffer",
        /// A draw that cannot leave anything in the picture.
        NothingToDraw = "nothing-to-draw",
        /// OpenGL reported an error that none of the other rules explains.
        OpenGlError = "opengl-error",
    }
}

named! {
    /// The severity of a finding.
    Severity {
        /// It may be intended.
        Warning = "warning",
        /// It cannot be intended.
        Error = "error",
    }
}

/// A mistake that a rule found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// The rule that found it.
    pub rule: Rule,
    /// Its severity.
    pub severity: Severity,
    /// The first draw that has it, an index into [`FrameRecord::draws`].
    pub draw: usize,
    /// Number of draws that have it.
    pub draws: usize,
    /// That draw, for people: [`DrawRecord::title`].
    pub draw_title: String,
    /// The mistake in one sentence, with names and numbers.
    pub message: String,
    /// The fix, in one sentence.
    pub advice: String,
}

/// A mistake in one draw.
struct Issue {
    rule: Rule,
    severity: Severity,
    message: String,
    advice: String,
}

impl Issue {
    fn error(rule: Rule, message: String, advice: impl Into<String>) -> Issue {
        Issue { rule, severity: Severity::Error, message, advice: advice.into() }
    }

    fn warning(rule: Rule, message: String, advice: impl Into<String>) -> Issue {
        Issue { rule, severity: Severity::Warning, message, advice: advice.into() }
    }
}

/// Returns all mistakes in a frame, in the order of the draws. A mistake of several draws is reported once.
pub fn lint(record: &FrameRecord) -> Vec<Finding> {
    let mut findings: Vec<Finding> = Vec::new();
    for draw in &record.draws {
        for issue in issues_of_draw(record, draw) {
            let known = findings.iter_mut().find(|f| f.rule == issue.rule && f.message == issue.message);
            if let Some(known) = known {
                known.draws += 1;
                continue;
            }
            let Issue { rule, severity, message, advice } = issue;
            let (draw, draw_title) = (draw.index, draw.title());
            findings.push(Finding { rule, severity, draw, draws: 1, draw_title, message, advice });
        }
    }
    findings
}

fn issues_of_draw(record: &FrameRecord, draw: &DrawRecord) -> Vec<Issue> {
    let mut issues = Vec::new();
    samplers::check(record, draw, &mut issues);
    inputs::check_uniforms(draw, &mut issues);
    inputs::check_attributes(draw, &mut issues);
    let is_explained = issues.iter().any(|issue| issue.severity == Severity::Error);
    if !draw.errors.is_empty() && !is_explained {
        issues.push(Issue::error(
            Rule::OpenGlError,
            format!("OpenGL reported {} before or at this draw", draw.errors.join(", ")),
            "check the calls since the previous draw: OpenGL refused one of them",
        ));
    }
    issues
}
