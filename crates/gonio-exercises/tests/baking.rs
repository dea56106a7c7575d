//! Baked models with and without each mistake.
#![allow(missing_docs, clippy::unwrap_used)]

#[path = "baking/case.rs"]
mod case;

use case::{Case, Recipe, baked, encoded_twice, not_encoded, with_layout};
use gonio_atlas::{UnwrapSettings, UvSource};
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_exercises::baking::{self, Original, original::FetchedFiles};
use gonio_exercises::exercise::{self, Exercise};

struct TestLab {
    exercise: &'static Exercise,
    original: Original,
    right: Case,
}

impl TestLab {
    fn new() -> Self {
        let exercise = exercise::find("ex13").unwrap();
        let original = Original::load(exercise, &FetchedFiles::default()).unwrap();
        TestLab { exercise, original, right: baked(Recipe::default()) }
    }

    fn check(&self, files: &[SourceFile]) -> Verdict {
        baking::check(self.exercise, files, &self.original)
    }

    fn is_right(&self, what: &str, files: &[SourceFile]) -> Verdict {
        let verdict = self.check(files);
        assert_eq!(verdict.verdict, Outcome::Correct, "{what}: {} {:?}", verdict.summary, verdict.scenes);
        verdict
    }

    fn ids(&self, files: &[SourceFile]) -> Vec<String> {
        self.check(files).mistakes.into_iter().map(|found| found.id).collect()
    }

    fn given(&self) -> Vec<SourceFile> {
        self.original.given.iter().map(|(name, bytes)| SourceFile::new(name.clone(), bytes.to_vec())).collect()
    }
}

fn unwrapped(margin: f64, degrees: f64) -> UnwrapSettings {
    UnwrapSettings { margin, angle_limit_rad: degrees.to_radians(), ..UnwrapSettings::default() }
}

#[test]
fn right_answers_are_right_with_any_layout_margin_size_and_format() {
    let lab = TestLab::new();
    let right = &lab.right;
    assert!(lab.is_right("as baked", &right.files()).warnings.is_empty());
    lab.is_right("glb", &right.glb());
    for (margin, degrees, size, grid) in
        [(0.01, 40.0, 512, 1), (0.02, 80.0, 1024, 2), (0.01, 66.0, 1024, 3), (0.004, 66.0, 1500, 1)]
    {
        let recipe = Recipe { unwrap: unwrapped(margin, degrees), size, grid };
        let mut case = baked(recipe.clone());
        lab.is_right(&format!("{recipe:?}"), &case.files());
        case.cut_margin(8);
        lab.is_right(&format!("{recipe:?} with a margin of 8"), &case.files());
    }
    // Blender 5 leaves out what its specular layer reflects, which depends on the material.
    let mut darkened = right.clone();
    darkened.recolor(|color, at, case| {
        let share = if case.ids[at][0] > 0.5 { 0.93 } else { 0.97 };
        color.map(|c| share * c)
    });
    lab.is_right("from Blender 5", &darkened.files());
    // Oddities that are right.
    let warned = |change: &dyn Fn(&mut Case), piece: &str| {
        let mut case = right.clone();
        change(&mut case);
        let verdict = lab.is_right(piece, &case.files());
        assert!(verdict.warnings.iter().any(|warning| warning.contains(piece)), "{piece}: {:?}", verdict.warnings);
    };
    let positions = |case: &mut Case, change: &dyn Fn([f32; 3]) -> [f32; 3]| {
        case.model.mesh.positions.iter_mut().for_each(|p| *p = change(*p));
    };
    warned(&|case| positions(case, &|p| p.map(|c| 100.0 * c)), "100.0000 times as large");
    warned(&|case| positions(case, &|[x, y, z]| [x + 3.0, y, z]), "another place");
    warned(&|case| case.replaced = vec![("Kd 1 1 1".into(), "Kd 0.8 0.8 0.8".into())], "factor of 0.80");
    warned(&|case| case.replaced = vec![("baked.png".into(), "Baked.PNG".into())], "differ in case");
    let shifted = |case: &mut Case| {
        case.model.mesh.tex_coords.iter_mut().for_each(|uv| uv[0] += 2.0);
        case.replaced = vec![("-clamp on ".into(), String::new())];
    };
    warned(&shifted, "outside of 0 to 1");
    // The exercise's own files may lie beside the answer.
    lab.is_right("beside the original", &[lab.given(), right.files()].concat());
    let in_folder = |file: SourceFile| SourceFile::new(format!("anna/work/{}", file.name), file.bytes);
    lab.is_right("in a folder", &right.files().into_iter().map(in_folder).collect::<Vec<_>>());
}

/// The number of a part by its material.
fn part(case: &Case, material: &str) -> usize {
    let is = |part: &gonio_mesh::Part| case.model.materials[part.material].name == material;
    case.model.mesh.parts.iter().position(is).unwrap()
}

type Change = fn(&mut Case);

/// Mistakes that are changes of a right answer.
const CHANGES: &[(&str, Change)] = &[
    ("v-flipped", |case| {
        let last = case.side() - 1;
        case.move_texels(|x, y| (x, last - y));
    }),
    ("u-flipped", |case| {
        let last = case.side() - 1;
        case.move_texels(|x, y| (last - x, y));
    }),
    ("picture-turned", |case| case.move_texels(|x, y| (y, x))),
    ("srgb-applied-twice", |case| case.recolor(|color, _, _| color.map(encoded_twice))),
    ("srgb-not-applied", |case| case.recolor(|color, _, _| color.map(not_encoded))),
    ("tone-curve-applied", |case| case.recolor(|color, _, _| color.map(|c| 0.6 * c.powf(0.8)))),
    ("light-baked", |case| {
        case.recolor(|color, at, case| [0, 1, 2].map(|k| color[k] * (0.1 + 0.6 * case.light[at][k])));
    }),
    ("highlights-baked", |case| {
        case.recolor(|color, at, case| {
            let light = case.light[at];
            [0, 1, 2].map(|k| color[k] * (0.1 + 0.4 * light[k]) + 0.25 * (light[0] / 1.5).clamp(0.0, 1.0).powi(3))
        });
    }),
    ("picture-empty", |case| case.recolor(|_, _, _| [0.0; 3])),
    ("other-map-baked", |case| case.recolor(|_, at, case| case.emitted[at])),
    ("parts-not-baked", |case| {
        let id = case.id_of(part(case, "Wood"));
        case.recolor(|color, at, case| if case.ids[at] == id { [0.0; 3] } else { color });
    }),
    ("margin-missing", |case| case.cut_margin(0)),
    ("parts-missing", |case| case.remove_part(part(case, "Emerald"))),
    ("model-mirrored", |case| case.model.mesh.positions.iter_mut().for_each(|p| p[0] = -p[0])),
    ("axes-turned", |case| case.model.mesh.positions.iter_mut().for_each(|p| *p = [p[0], -p[2], p[1]])),
    ("normals-missing", |case| case.model.mesh.normals.clear()),
    ("no-tex-coords", |case| case.model.mesh.tex_coords.clear()),
    ("picture-missing", |case| case.has_picture = false),
    ("texture-path-broken", |case| case.replaced.push(("baked.png".into(), "textures/bake_final.png".into()))),
    ("texture-path-absolute", |case| case.replaced.push(("baked.png".into(), "C:\\Users\\anna\\baked.png".into()))),
    ("material-library-missing", |case| case.has_library = false),
    ("old-textures-kept", |case| case.replaced.push(("map_Kd -clamp on baked.png".into(), "Ni 1.4".into()))),
    ("materials-left", |case| {
        let library = String::from_utf8(gonio_mesh::write::obj::write(&case.model, "baked.mtl").mtl).unwrap();
        let wood = library.split("newmtl ").find(|text| text.starts_with("Wood")).unwrap();
        case.replaced.push((wood.to_owned(), wood.replace("baked.png", "textures/planks.png")));
    }),
    ("wrong-image", |case| {
        let mut other = case.clone();
        other.recolor(|_, at, _| [at as f64 / 1e6, 0.3, 0.9]);
        case.beside.push(SourceFile::new("render.png", other.picture_file()));
        case.replaced.push(("baked.png".into(), "render.png".into()));
    }),
    ("color-factor-left", |case| case.replaced.push(("Kd 1 1 1".into(), "Kd 0.9 0.35 0.55".into()))),
];

fn changed(right: &Case, names: &[&str]) -> Case {
    let mut case = right.clone();
    for name in names {
        CHANGES.iter().find(|(known, _)| known == name).unwrap().1(&mut case);
    }
    case
}

#[test]
fn each_mistake_is_named() {
    let lab = TestLab::new();
    for (name, _) in CHANGES {
        let case = changed(&lab.right, &[name]);
        let verdict = lab.check(&case.files());
        let ids: Vec<&str> = verdict.mistakes.iter().map(|found| found.id.as_str()).collect();
        assert_eq!(ids, [*name], "{}", verdict.summary);
        assert_eq!(verdict.verdict, Outcome::Wrong, "{name}");
        assert!(verdict.score < 1.0, "{name}");
    }
}

/// Filmic and AgX also take the colour from what is bright.
#[test]
fn a_view_transform_is_told_from_light() {
    let lab = TestLab::new();
    let mut case = lab.right.clone();
    case.recolor(|[r, g, b], _, _| {
        let mean = (r + g + b) / 3.0;
        [r, g, b].map(|c| 0.7 * (c + 0.4 * (mean - c)).powf(0.7))
    });
    assert_eq!(lab.ids(&case.files()), ["tone-curve-applied"]);
}

#[test]
fn mistakes_in_the_layout_are_named() {
    let lab = TestLab::new();
    let ids =
        |recipe: Recipe, change: &dyn Fn(&mut gonio_atlas::AtlasUv)| lab.ids(&with_layout(recipe, change).files());
    let kept =
        Recipe { unwrap: UnwrapSettings { source: UvSource::Kept, ..UnwrapSettings::default() }, ..Recipe::default() };
    assert_eq!(ids(kept, &|_| ()), ["old-tex-coords-kept"]);
    // Everything at one and a half times the size around the middle.
    let grown = |atlas: &mut gonio_atlas::AtlasUv| {
        atlas.tex_coords.iter_mut().flatten().for_each(|c| *c = 1.3 * (*c - 0.5) + 0.5);
    };
    assert_eq!(ids(Recipe::default(), &grown), ["charts-outside"]);
    let overlapping = |atlas: &mut gonio_atlas::AtlasUv| {
        let chart = |t: usize| atlas.chart_of_triangle[t];
        let moved: Vec<usize> = (0..atlas.chart_of_triangle.len()).filter(|&t| chart(t) > Some(3)).collect();
        for t in moved {
            for corner in &mut atlas.tex_coords[3 * t..3 * t + 3] {
                *corner = [0.4 + 0.3 * corner[0], 0.3 + 0.3 * corner[1]];
            }
        }
    };
    assert_eq!(ids(Recipe::default(), &overlapping), ["charts-overlap"]);
    assert_eq!(ids(Recipe { size: 64, ..Recipe::default() }, &|_| ()), ["picture-too-small"]);
    let mut thin = baked(Recipe { size: 1024, ..Recipe::default() });
    thin.cut_margin(1);
    assert_eq!(lab.ids(&thin.files()), ["margin-too-small"]);
}

/// Each triangle is a chart of its own in half a square of a grid, beside triangles from elsewhere in the model.
#[test]
fn charts_that_touch_are_named() {
    let lab = TestLab::new();
    let touching = |atlas: &mut gonio_atlas::AtlasUv| {
        let count = atlas.chart_of_triangle.len();
        let columns = (count as f32 / 2.0).sqrt().ceil();
        for (t, corners) in atlas.tex_coords.chunks_exact_mut(3).enumerate() {
            let (cell, half) = (t % count.div_ceil(2), t / count.div_ceil(2));
            let (x, y) = (cell % columns as usize, cell / columns as usize);
            // Equal coordinates would make one chart of both halves.
            let shapes = [[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[1.0, 1.0], [0.001, 1.0], [1.0, 0.001]]];
            for (corner, shape) in corners.iter_mut().zip(shapes[half]) {
                *corner = [(x as f32 + shape[0]) / columns, (y as f32 + shape[1]) / columns];
            }
            atlas.chart_of_triangle[t] = Some(t as u32);
        }
    };
    let recipe = Recipe { size: 1024, ..Recipe::default() };
    assert_eq!(lab.ids(&with_layout(recipe, &touching).files()), ["charts-too-close"]);
}

/// Mistakes of which neither hides the other.
const PAIRED: [&str; 13] = [
    "v-flipped",
    "srgb-applied-twice",
    "srgb-not-applied",
    "light-baked",
    "parts-not-baked",
    "margin-missing",
    "parts-missing",
    "axes-turned",
    "normals-missing",
    "texture-path-broken",
    "texture-path-absolute",
    "materials-left",
    "color-factor-left",
];

#[test]
fn two_mistakes_are_both_named() {
    let lab = TestLab::new();
    let hidden = [
        // One says that the file is gone, the other where it was.
        ["texture-path-broken", "texture-path-absolute"],
        // Two changes of all colours are one.
        ["srgb-applied-twice", "srgb-not-applied"],
        ["srgb-applied-twice", "light-baked"],
        ["srgb-not-applied", "light-baked"],
        // What was not baked has no light.
        ["light-baked", "parts-not-baked"],
    ];
    let mut missed = Vec::new();
    let (mut all, mut number) = (0, 0);
    for (first, a) in PAIRED.iter().enumerate() {
        for b in PAIRED[first + 1..].iter().filter(|b| !hidden.contains(&[*a, **b])) {
            number += 1;
            // A third of the pairs, spread evenly, takes a third of the time.
            if number % 3 != 0 {
                continue;
            }
            all += 1;
            // A later change of the library cannot find the text that an earlier one replaced.
            let mut found = lab.ids(&changed(&lab.right, &[b, a]).files());
            found.sort();
            let mut expected = [*a, *b];
            expected.sort_unstable();
            if found != expected {
                missed.push(format!("{a} and {b}: {found:?}"));
            }
        }
    }
    assert!(missed.len() * 20 <= all, "{} of {all}: {missed:#?}", missed.len());
}

#[test]
fn other_answers_are_described() {
    let lab = TestLab::new();
    let of_given = |names: &[&str]| {
        lab.given().into_iter().filter(|file| names.iter().any(|end| file.name.ends_with(end))).collect::<Vec<_>>()
    };
    assert_eq!(lab.ids(&lab.given()), ["nothing-baked"]);
    let model = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    assert_eq!(lab.ids(&[SourceFile::new("cube.obj", model)]), ["wrong-model"]);
    let picture = lab.right.files().pop().unwrap();
    for (files, piece) in [
        (vec![picture.clone()], "there is no model among the files"),
        (of_given(&[".png"]), "there is no model among the files"),
        (vec![SourceFile::new("a.obj", "hello\n")], "a.obj: this is not an OBJ file"),
        (vec![SourceFile::new("a.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")], "a.obj"),
        (vec![SourceFile::new("a.glb", b"glTF".as_slice())], "a.glb"),
        (vec![SourceFile::new("a.obj", ""); 5], "there are 5 models"),
    ] {
        let verdict = lab.check(&files);
        assert_eq!(verdict.verdict, Outcome::Unsure, "{piece}: {}", verdict.summary);
        assert!(
            verdict.summary.contains(piece) && verdict.summary.lines().count() == 1,
            "{piece}: {}",
            verdict.summary
        );
    }
    let with_picture = |bytes: Vec<u8>| {
        let mut files = lab.right.files();
        files.last_mut().unwrap().bytes = bytes;
        lab.check(&files)
    };
    for length in [0, 8, 40, picture.bytes.len() / 2] {
        let verdict = with_picture(picture.bytes[..length].to_vec());
        assert_eq!(verdict.verdict, Outcome::Unsure, "{length}: {}", verdict.summary);
        assert!(verdict.summary.starts_with("baked.png: "), "{length}: {}", verdict.summary);
    }
    // A header that promises 100,000 x 100,000 texels.
    let mut huge = picture.bytes.clone();
    huge[16..20].copy_from_slice(&100_000_u32.to_be_bytes());
    huge[20..24].copy_from_slice(&100_000_u32.to_be_bytes());
    let verdict = with_picture(huge);
    assert_eq!(verdict.verdict, Outcome::Unsure, "{}", verdict.summary);
}
