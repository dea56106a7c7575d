//! Who may know whom: dependencies between crates point one way.
//!
//! ```text
//! light <- mesh, image <- environment, bsdf <- scene <- reference, gl <- check <- exercises <- app <- web, gonio (the command line)
//! ```

use serde_json::Value;
use std::collections::BTreeSet;

/// A crate of this workspace, and which others it may know.
pub struct Rule {
    /// The crate.
    pub krate: &'static str,
    /// The crates that it may depend on: those that it does depend on, or may with good reason.
    pub may_know: &'static [&'static str],
    /// The crates that only its tests may depend on.
    pub tests_may_know: &'static [&'static str],
}

/// The one place that says it. A new crate adds itself here.
pub const RULES: &[Rule] = &[
    // Tables of test cases: every crate's tests may read them (`FOR_ALL_TESTS`).
    Rule { krate: "gonio-fixtures", may_know: &[], tests_may_know: &[] },
    // Texts for people, which know nothing of what they are about.
    Rule { krate: "gonio-language", may_know: &[], tests_may_know: &[] },
    Rule { krate: "gonio-light", may_know: &[], tests_may_know: &[] },
    Rule { krate: "gonio-threads", may_know: &[], tests_may_know: &[] },
    Rule { krate: "gonio-mesh", may_know: &["gonio-light", "gonio-threads"], tests_may_know: &[] },
    Rule { krate: "gonio-image", may_know: &["gonio-light"], tests_may_know: &[] },
    // Texture coordinates of meshes, and a picture of them.
    Rule { krate: "gonio-atlas", may_know: &["gonio-mesh", "gonio-image"], tests_may_know: &[] },
    // Rays against meshes, for renderers and for baking.
    Rule { krate: "gonio-rays", may_know: &["gonio-mesh"], tests_may_know: &[] },
    Rule {
        krate: "gonio-environment",
        may_know: &["gonio-light", "gonio-image", "gonio-threads"],
        tests_may_know: &[],
    },
    // A language, and nothing of ours.
    Rule { krate: "gonio-glsl", may_know: &[], tests_may_know: &[] },
    Rule { krate: "gonio-interpreter", may_know: &["gonio-glsl"], tests_may_know: &[] },
    // Functions of two directions, some of them written in GLSL.
    Rule { krate: "gonio-bsdf", may_know: &["gonio-light", "gonio-glsl", "gonio-interpreter"], tests_may_know: &[] },
    // A material may be such a function.
    Rule { krate: "gonio-scene", may_know: BELOW_SCENES, tests_may_know: &[] },
    Rule { krate: "gonio-reference", may_know: BELOW_PICTURES, tests_may_know: &[] },
    Rule { krate: "gonio-trace", may_know: BELOW_PICTURES, tests_may_know: &["gonio-reference"] },
    // OpenGL alone: no scenes, meshes or lights.
    Rule { krate: "gonio-gl", may_know: &[], tests_may_know: &[] },
    // The GPU's pictures are compared with the reference's.
    Rule { krate: "gonio-render", may_know: BELOW_RENDERER, tests_may_know: &["gonio-reference"] },
    Rule { krate: "gonio-plot", may_know: BELOW_PLOTS, tests_may_know: &[] },
    // Light that the rendering equation leaves out, with plots of its laws.
    Rule { krate: "gonio-beyond", may_know: BELOW_BEYOND, tests_may_know: &[] },
    // It draws, and sets text as the window does.
    Rule { krate: "gonio-gallery", may_know: BELOW_GALLERY, tests_may_know: &[] },
    // It compares pictures by both equations, and writes a page like the gallery's.
    Rule { krate: "gonio-simplify", may_know: BELOW_SIMPLIFY, tests_may_know: &[] },
    // Pictures of a scene's surfaces instead of its views. Traced light is a function that it is given: the page has no tracer.
    Rule { krate: "gonio-bake", may_know: BELOW_BAKING, tests_may_know: &["gonio-reference", "gonio-trace"] },
    // It measures the checker, so neither knows the other.
    Rule { krate: "gonio-submissions", may_know: &["gonio-glsl", "gonio-interpreter"], tests_may_know: &[] },
    Rule { krate: "gonio-check", may_know: BELOW_CHECK, tests_may_know: &[] },
    Rule { krate: "gonio-exercises", may_know: BELOW_EXERCISES, tests_may_know: &[] },
    // Exercises that are read from a folder; the page has the built-in ones alone.
    Rule { krate: "gonio-course", may_know: BELOW_COURSES, tests_may_know: &[] },
    Rule { krate: "gonio-app", may_know: BELOW_SHELLS, tests_may_know: &[] },
    // The page is the application, and the checker and the path tracer in workers beside it; the tracer's worker bakes
    // and computes stations too.
    Rule {
        krate: "gonio-web",
        may_know: &[
            "gonio-app",
            "gonio-bake",
            "gonio-beyond",
            "gonio-gl",
            "gonio-check",
            "gonio-exercises",
            "gonio-language",
            "gonio-light",
            "gonio-mesh",
            "gonio-scene",
            "gonio-trace",
        ],
        tests_may_know: &[],
    },
    // The page's first picture, without the application.
    Rule {
        krate: "gonio-web-first",
        may_know: &["gonio-gl", "gonio-mesh", "gonio-render", "gonio-scene"],
        tests_may_know: &[],
    },
    Rule { krate: "gonio", may_know: COMMAND_LINE, tests_may_know: &[] },
    // The Python package, a shell like the command line, without the window.
    Rule { krate: "gonio-python", may_know: PYTHON, tests_may_know: &[] },
    // It measures the window too, as the command line opens it.
    Rule { krate: "gonio-bench", may_know: COMMAND_LINE, tests_may_know: &[] },
    Rule { krate: "gonio-web-bindgen", may_know: &[], tests_may_know: &[] },
    Rule { krate: "xtask", may_know: &["gonio-fixtures"], tests_may_know: &[] },
];

const BELOW_SCENES: &[&str] =
    &["gonio-light", "gonio-threads", "gonio-mesh", "gonio-image", "gonio-environment", "gonio-bsdf"];
const BELOW_PICTURES: &[&str] =
    &["gonio-light", "gonio-mesh", "gonio-rays", "gonio-image", "gonio-environment", "gonio-bsdf", "gonio-scene"];
const BELOW_RENDERER: &[&str] =
    &["gonio-light", "gonio-mesh", "gonio-image", "gonio-environment", "gonio-bsdf", "gonio-scene", "gonio-gl"];
const BELOW_GALLERY: &[&str] = &[
    "gonio-light",
    "gonio-mesh",
    "gonio-image",
    "gonio-environment",
    "gonio-scene",
    "gonio-reference",
    "gonio-gl",
    "gonio-render",
    "gonio-beyond",
];
const BELOW_SIMPLIFY: &[&str] =
    &["gonio-light", "gonio-image", "gonio-scene", "gonio-reference", "gonio-trace", "gonio-gallery"];
const BELOW_BAKING: &[&str] = &["gonio-light", "gonio-mesh", "gonio-rays", "gonio-image", "gonio-scene", "gonio-atlas"];
const BELOW_PLOTS: &[&str] = &["gonio-light", "gonio-image", "gonio-bsdf"];
const BELOW_BEYOND: &[&str] = &["gonio-light", "gonio-image", "gonio-bsdf", "gonio-plot", "gonio-trace"];
const BELOW_CHECK: &[&str] = &[
    "gonio-language",
    "gonio-threads",
    "gonio-light",
    "gonio-mesh",
    "gonio-image",
    "gonio-environment",
    "gonio-scene",
    "gonio-reference",
    "gonio-gl",
    "gonio-render",
    "gonio-glsl",
    "gonio-interpreter",
];
const BELOW_EXERCISES: &[&str] = &[
    "gonio-language",
    "gonio-light",
    "gonio-mesh",
    "gonio-image",
    "gonio-environment",
    "gonio-scene",
    "gonio-reference",
    "gonio-gl",
    "gonio-render",
    "gonio-glsl",
    "gonio-interpreter",
    "gonio-atlas",
    "gonio-bake",
    "gonio-check",
    "gonio-submissions",
];
const BELOW_COURSES: &[&str] =
    &["gonio-language", "gonio-mesh", "gonio-scene", "gonio-gl", "gonio-glsl", "gonio-check", "gonio-exercises"];
const BELOW_SHELLS: &[&str] = &[
    "gonio-language",
    "gonio-light",
    "gonio-mesh",
    "gonio-image",
    "gonio-environment",
    "gonio-scene",
    "gonio-reference",
    "gonio-trace",
    "gonio-gl",
    "gonio-render",
    "gonio-glsl",
    "gonio-interpreter",
    "gonio-bsdf",
    "gonio-plot",
    "gonio-check",
    "gonio-exercises",
    "gonio-gallery",
    "gonio-atlas",
    "gonio-bake",
    "gonio-beyond",
];
/// `gonio view` opens the window.
const COMMAND_LINE: &[&str] = &[
    "gonio-language",
    "gonio-light",
    "gonio-mesh",
    "gonio-image",
    "gonio-environment",
    "gonio-scene",
    "gonio-reference",
    "gonio-trace",
    "gonio-gl",
    "gonio-render",
    "gonio-gallery",
    "gonio-atlas",
    "gonio-bake",
    "gonio-simplify",
    "gonio-beyond",
    "gonio-glsl",
    "gonio-interpreter",
    "gonio-bsdf",
    "gonio-plot",
    "gonio-check",
    "gonio-submissions",
    "gonio-exercises",
    "gonio-course",
    "gonio-app",
];

/// Scenes, both renderers, the path tracer, BRDFs and checks.
const PYTHON: &[&str] = &[
    "gonio-light",
    "gonio-mesh",
    "gonio-image",
    "gonio-bsdf",
    "gonio-scene",
    "gonio-reference",
    "gonio-trace",
    "gonio-gl",
    "gonio-render",
    "gonio-check",
    "gonio-exercises",
];

/// Crates that the tests of every crate may depend on.
const FOR_ALL_TESTS: &[&str] = &["gonio-fixtures"];

/// Crates from outside that only some of ours may know directly: (crate, who may).
pub const GUARDED: &[(&str, &[&str])] = &[
    ("glow", &["gonio-gl", "gonio-render", "gonio-app", "gonio-web-first"]),
    ("glutin_egl_sys", &["gonio-gl"]),
    ("glutin", &["gonio-gl"]),
    ("renderdoc", &["gonio-gl"]),
    ("clap", &["gonio"]),
    ("indicatif", &["gonio"]),
    ("pyo3", &["gonio-python"]),
];

/// One dependency, as a manifest declares it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The crate that knows.
    pub from: String,
    /// The crate that is known.
    pub to: String,
    /// Whether only its tests do.
    pub for_tests: bool,
}

/// The workspace's crates and all their direct dependencies, from what `cargo metadata --no-deps` prints.
pub fn read_metadata(json: &str) -> Result<(BTreeSet<String>, Vec<Edge>), String> {
    let metadata: Value = serde_json::from_str(json).map_err(|e| format!("cargo metadata: {e}"))?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata: no `packages`")?;
    let (mut crates, mut edges) = (BTreeSet::new(), Vec::new());
    for package in packages {
        let from = package["name"].as_str().ok_or("cargo metadata: a package without a name")?;
        crates.insert(from.to_owned());
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            let to = dependency["name"].as_str().ok_or("cargo metadata: a dependency without a name")?;
            let for_tests = dependency["kind"].as_str() == Some("dev");
            edges.push(Edge { from: from.to_owned(), to: to.to_owned(), for_tests });
        }
    }
    if crates.is_empty() {
        return Err("cargo metadata: no packages".into());
    }
    Ok((crates, edges))
}

/// Complaints about crates without a rule and about dependencies that the rules do not allow.
pub fn check(crates: &BTreeSet<String>, edges: &[Edge], rules: &[Rule], guarded: &[(&str, &[&str])]) -> Vec<String> {
    let mut complaints = rules_that_point_back(rules);
    let rule_of = |name: &str| rules.iter().find(|r| r.krate == name);
    for name in crates.iter().filter(|name| rule_of(name).is_none()) {
        complaints.push(format!("{name}: no rule says whom it may know (xtask/src/checks/dependencies.rs)"));
    }
    for Edge { from, to, for_tests } in edges {
        if crates.contains(to) {
            let allowed = rule_of(from).is_none_or(|rule| {
                rule.may_know.contains(&to.as_str())
                    || (*for_tests && [rule.tests_may_know, FOR_ALL_TESTS].concat().contains(&to.as_str()))
            });
            if !allowed {
                let tests = if *for_tests { " (its tests)" } else { "" };
                complaints.push(format!("{from}{tests} may not know {to}"));
            }
        } else if let Some((_, who)) = guarded.iter().find(|(name, _)| name == to)
            && !who.contains(&from.as_str())
        {
            complaints.push(format!("{from} may not know {to}; only {} may", who.join(" and ")));
        }
    }
    complaints
}

/// Complaints about the table itself: a crate may depend on crates above it only, so no cycle can be allowed.
fn rules_that_point_back(rules: &[Rule]) -> Vec<String> {
    let position = |name: &str| rules.iter().position(|r| r.krate == name);
    let mut complaints = Vec::new();
    for (index, rule) in rules.iter().enumerate() {
        for known in rule.may_know {
            if position(known).is_none_or(|at| at >= index) {
                complaints.push(format!("the rules let {} know {known}, which does not stand above it", rule.krate));
            }
        }
    }
    complaints
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const LITTLE: &[Rule] = &[
        Rule { krate: "light", may_know: &[], tests_may_know: &[] },
        Rule { krate: "mesh", may_know: &["light"], tests_may_know: &["scene"] },
        Rule { krate: "scene", may_know: &["light", "mesh"], tests_may_know: &[] },
    ];

    fn edge(from: &str, to: &str, for_tests: bool) -> Edge {
        Edge { from: from.into(), to: to.into(), for_tests }
    }

    fn complaints(edges: &[Edge]) -> Vec<String> {
        let crates = ["light", "mesh", "scene"].map(String::from).into();
        check(&crates, edges, LITTLE, &[("glow", &["scene"])])
    }

    #[test]
    fn dependencies_that_point_back_are_found() {
        assert!(
            complaints(&[edge("scene", "mesh", false), edge("mesh", "light", false), edge("mesh", "serde", false)])
                .is_empty()
        );
        assert_eq!(complaints(&[edge("light", "mesh", false)]), ["light may not know mesh"]);
        assert_eq!(complaints(&[edge("light", "mesh", true)]), ["light (its tests) may not know mesh"]);
    }

    #[test]
    fn tests_may_know_what_is_declared_for_them() {
        assert!(complaints(&[edge("mesh", "scene", true)]).is_empty());
        assert_eq!(complaints(&[edge("mesh", "scene", false)]).len(), 1);
    }

    #[test]
    fn guarded_crates_and_crates_without_a_rule_are_found() {
        assert!(complaints(&[edge("scene", "glow", false)]).is_empty());
        assert_eq!(complaints(&[edge("mesh", "glow", false)]), ["mesh may not know glow; only scene may"]);
        let crates = ["light", "stranger"].map(String::from).into();
        assert_eq!(check(&crates, &[], LITTLE, &[]).len(), 1);
    }

    #[test]
    fn the_rules_allow_no_circle() {
        assert!(rules_that_point_back(RULES).is_empty());
        let circle = [
            Rule { krate: "a", may_know: &["b"], tests_may_know: &[] },
            Rule { krate: "b", may_know: &["a"], tests_may_know: &[] },
        ];
        assert_eq!(rules_that_point_back(&circle).len(), 1);
    }

    #[test]
    fn metadata_is_read() {
        let json = r#"{"packages": [{"name": "a", "dependencies": [
            {"name": "b", "kind": null}, {"name": "c", "kind": "dev"}, {"name": "d", "kind": "build"}]}]}"#;
        let (crates, edges) = read_metadata(json).unwrap();
        assert!(crates.contains("a"));
        assert_eq!(edges, [edge("a", "b", false), edge("a", "c", true), edge("a", "d", false)]);
        assert!(read_metadata("{}").is_err());
        assert!(read_metadata(r#"{"packages": []}"#).is_err());
    }
}
