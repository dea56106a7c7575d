//! A summary of a model as text that can be written by hand, and checks that hold for every model.

use gonio_fixtures::{ExpectedCase, FixtureTable};
use gonio_mesh::{Mesh, Model, ReadError, TextureMap};
use std::fmt::{Display, Write as _};
use std::path::Path;

/// The cases of a table in `tests` whose names end in `.extension`, of which there must be at least `least`.
pub fn cases(table: &str, extension: &str, least: usize) -> Vec<ExpectedCase> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(table);
    let cases = FixtureTable::read(path).and_then(|table| table.expected_cases(extension));
    let cases = cases.unwrap_or_else(|error| panic!("{error}"));
    assert!(cases.len() >= least, "only {} cases in {table}", cases.len());
    for case in &cases {
        assert_eq!(case.expected.starts_with("error "), case.name.starts_with("fail_"), "{}", case.name);
    }
    cases
}

/// Names and contents.
pub fn files(cases: Vec<ExpectedCase>) -> Vec<(String, Vec<u8>)> {
    cases.into_iter().map(|case| (case.name, case.bytes)).collect()
}

/// Numbers with at most four places, -0 as 0.
pub fn numbers<T: Copy + Into<f64>>(values: &[T]) -> String {
    let round = |value: f64| (value * 1e4).round() / 1e4 + 0.0;
    values.iter().map(|&value| round(value.into()).to_string()).collect::<Vec<_>>().join(" ")
}

fn list<T: Display>(text: &mut String, what: &str, values: impl IntoIterator<Item = T>) {
    let values: Vec<String> = values.into_iter().map(|value| value.to_string()).collect();
    if !values.is_empty() {
        writeln!(text, "{what} {}", values.join(" | ")).unwrap();
    }
}

/// Mesh, parts, contents and diagnostics; or the error.
pub fn summary(result: &Result<Model, ReadError>) -> String {
    let model = match result {
        Ok(model) => model,
        Err(error) => return format!("error {error}\n"),
    };
    check(model);
    let mesh = &model.mesh;
    let mut text = String::new();
    list(&mut text, "contents", model.contents.iter().map(|(name, count)| format!("{count} {name}")));
    list(&mut text, "positions", mesh.positions.iter().map(|p| numbers(p)));
    list(&mut text, "normals", mesh.normals.iter().map(|p| numbers(p)));
    list(&mut text, "tex coords", mesh.tex_coords.iter().map(|p| numbers(p)));
    list(&mut text, "colors", mesh.colors.iter().map(|p| numbers(p)));
    list(&mut text, "triangles", mesh.indices.chunks(3).map(|t| format!("{} {} {}", t[0], t[1], t[2])));
    for part in &mesh.parts {
        let material = &model.materials[part.material].name;
        writeln!(text, "part {:?}: {material:?} {}+{}", part.name, part.first_triangle, part.triangle_count).unwrap();
    }
    for diagnostic in &model.diagnostics {
        writeln!(text, "{diagnostic}").unwrap();
    }
    text
}

/// Checks properties that every model must have.
pub fn check(model: &Model) {
    let mesh: &Mesh = &model.mesh;
    let count = mesh.positions.len();
    assert!(!mesh.indices.is_empty() && mesh.indices.len().is_multiple_of(3));
    assert!(mesh.indices.iter().all(|&i| (i as usize) < count));
    assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.normals.iter().flatten().chain(mesh.tex_coords.iter().flatten()).all(|x| x.is_finite()));
    for length in [mesh.normals.len(), mesh.tex_coords.len(), mesh.colors.len()] {
        assert!(length == 0 || length == count, "{length} instead of {count}");
    }
    let lengths = mesh.normals.iter().map(|n| n.iter().map(|x| x * x).sum::<f32>());
    assert!(lengths.into_iter().all(|l| l == 0.0 || (l - 1.0).abs() < 1e-5));
    let mut next = 0;
    for part in &mesh.parts {
        assert_eq!(part.first_triangle, next);
        assert!(part.triangle_count > 0 && part.material < model.materials.len());
        next += part.triangle_count;
    }
    assert_eq!(next, mesh.triangle_count());
    for material in &model.materials {
        let colors = [material.diffuse, material.specular, material.emitted];
        assert!(colors.iter().flatten().all(|c| c.is_finite() && *c >= 0.0), "{material:?}");
        assert!(material.shininess >= 1.0 && (0.0..=1.0).contains(&material.opacity), "{material:?}");
        let maps: [&Option<TextureMap>; 3] = [&material.diffuse_map, &material.bump_map, &material.opacity_map];
        assert!(maps.into_iter().flatten().all(|map| map.embedded.is_none_or(|i| i < model.images.len())));
    }
}
