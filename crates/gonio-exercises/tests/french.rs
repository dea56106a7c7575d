//! A process whose language is French.
#![allow(clippy::unwrap_used)]

use gonio_check::mistakes;
use gonio_check::verdict::FoundMistake;
use gonio_exercises::exercise::{self, find};
use gonio_language::Language;

#[test]
fn exercises_and_mistakes_are_shown_in_the_language_of_the_process() {
    Language::French.make_current();
    let exercise = find("ex04").unwrap();
    assert_eq!(
        (exercise.title(), exercise.title_in(Language::English)),
        ("Ombrage de Phong, terme diffus", "Phong shading, diffuse")
    );
    assert!(exercise.summary().starts_with("Interpolez la normale"), "{}", exercise.summary());
    assert!(exercise.look_for()[0].text.starts_with("Même la sphère grossière"), "{:?}", exercise.look_for());
    assert_eq!(exercise.inputs().attributes["position"].meaning, "un sommet, dans l'espace du modèle");
    assert_eq!(exercise.inputs().attributes["position"].glsl_type, "vec3");
    for exercise in exercise::all() {
        let texts: Vec<(&str, &str)> = exercise.start_files().filter(|(name, _)| name.ends_with(".md")).collect();
        assert!(texts == [("text.md", exercise.text_in(Language::French))], "{}", exercise.id);
        assert!(exercise.text().contains("## Ce qu'il faut observer") || exercise.id == "ex13", "{}", exercise.id);
    }
    let known = mistakes::find("normal-reversed").unwrap();
    let found = FoundMistake::from_catalogue(known, 0.5);
    assert_eq!(
        (found.id.as_str(), found.name.as_str()),
        ("normal-reversed", "La normale pointe vers l'intérieur de l'objet")
    );
    assert!(found.looks_like.starts_with("Le côté tourné vers la lumière"), "{}", found.looks_like);
    assert!(found.fix.starts_with("Enlevez le signe moins"), "{}", found.fix);
    assert_eq!((found.share_explained, &found.lecture_section), (0.5, &known.lecture_section));
}
