//! The programs of the exercise.

use super::support::{context, host_programs, judged};
use gonio_check::verdict::Outcome;

/// Each program, and the line of its mistake.
const PROGRAMS: [(&str, u32); 8] = [
    ("attribute-not-enabled", 24),
    ("mipmaps-missing", 36),
    ("offset-wrong", 24),
    ("stride-wrong", 20),
    ("texture-name-as-unit", 43),
    ("unbound-unit", 43),
    ("uniform-before-use-program", 14),
    ("wrong-target", 31),
];

#[test]
fn each_program_of_the_exercise_has_the_mistake_that_its_name_says() {
    let context = context();
    let mut texts = host_programs();
    texts.retain(|(name, _)| name != "reference");
    texts.sort();
    assert_eq!(texts.len(), PROGRAMS.len());
    for ((name, line), (file, text)) in PROGRAMS.into_iter().zip(texts) {
        assert_eq!(name, file);
        let verdict = judged(&context, &text);
        assert_eq!(verdict.verdict, Outcome::Wrong, "{name}");
        let told: Vec<_> = verdict.mistakes.iter().map(|m| (m.id.as_str(), m.line)).collect();
        assert_eq!(told, [(name, line)], "{name}: {}", verdict.summary);
        assert!(!verdict.findings.is_empty(), "{name}: the frame panel shows nothing");
        assert_eq!(text.lines().nth(line as usize - 1), Some(verdict.mistakes[0].quoted.as_str()));
    }
}

#[test]
fn the_reference_is_right_and_has_nothing_to_complain_of() {
    let verdict = judged(&context(), super::support::REFERENCE);
    assert_eq!(verdict.verdict, Outcome::Correct);
    assert_eq!((verdict.share_right, verdict.warnings.len(), verdict.findings.len()), (1.0, 0, 0));
    assert!(verdict.refused.is_empty() && verdict.mistakes.is_empty() && verdict.errors.is_empty());
    let run = verdict.run.unwrap_or_else(|| panic!("a picture"));
    let texture = run.record.texture(1).unwrap_or_else(|| panic!("{:?}", run.record.textures));
    assert_eq!((texture.name.as_str(), texture.width, texture.levels.len()), ("texture", 512, 10));
    assert!(texture.thumbnail.is_some(), "for the frame panel");
    assert_eq!(run.record.passes[0].target.name, "window");
}
