//! Values of the steps and pictures, compared with values computed here.

use super::*;
use crate::exercise;
use crate::preview::{self, SubmittedPair};
use gonio_check::submission::SourceFile;
use gonio_gl::HeadlessContext;
use gonio_glsl::Stage;
use std::sync::Arc;

const SIDE: u32 = 64;

/// Compiles a pair of exercise 07 and hands it to `use_it` in the lab's scene.
fn with_pair<T>(vertex: &str, fragment: &str, use_it: impl FnOnce(&SteppedScene) -> T) -> T {
    with_answer(vertex, fragment, 0, |scene, _| use_it(scene))
}

/// The same in one of the scenes, with the right answer.
fn with_answer<T>(
    vertex: &str,
    fragment: &str,
    scene: usize,
    use_it: impl FnOnce(&SteppedScene, &dyn Fn() -> Option<RightAnswer>) -> T,
) -> T {
    let exercise = exercise::find("ex07").unwrap();
    let files = [("a.vert", vertex), ("a.frag", fragment)].map(|(name, text)| SourceFile::new(name, text)).into();
    let submitted = SubmittedPair::gather(exercise, files).unwrap();
    let context = HeadlessContext::new().unwrap();
    let compiled = submitted.compile(context.gl()).unwrap_or_else(|notes| panic!("{notes:?}"));
    let pair = Arc::new(SteppedPair::new(&submitted, &compiled.bindings).unwrap());
    let scene = &preview::scenes(exercise)[scene];
    let objects = scene.test_scenes(&scene.eye, 0.0, [SIDE; 2]);
    let answer = || RightAnswer::new(exercise, &submitted);
    use_it(&SteppedScene::new(pair, &objects, StepOptions::square(SIDE)), &answer)
}

fn reference(name: &str) -> &'static str {
    exercise::find("ex07").unwrap().file(name).unwrap()
}

/// The listing of a fragment shader with this body at the middle of the picture, where `v_normal` is (0, 0, 1).
fn listed(body: &str) -> StepListing {
    let (before, main) = body.split_once("---").unwrap_or(("", body));
    let fragment = format!(
        "#version 330 core\nin vec3 v_frag_coord;\nin vec3 v_normal;\nout vec4 FragColor;\n{before}\nvoid main() {{\n\
         FragColor = vec4(v_frag_coord + v_normal, 1.0);\n{main}\n}}\n"
    );
    with_pair(reference("reference.vert"), &fragment, |scene| scene.step_pixel([SIDE / 2; 2]).unwrap())
}

/// The values of a variable in the order of execution, as text.
fn values(listing: &StepListing, name: &str) -> Vec<String> {
    let writes = listing.steps.iter().flat_map(|step| &step.writes);
    writes.filter(|write| write.name == name).map(|write| write.value.to_string()).collect()
}

/// The last value of a variable, as floats.
fn floats(listing: &StepListing, name: &str) -> Vec<f32> {
    let mut writes = listing.steps.iter().flat_map(|step| &step.writes).chain(&listing.inputs);
    let value = &writes.rfind(|write| write.name == name).unwrap_or_else(|| panic!("no {name}")).value;
    match value {
        ShownValue::Vector(parts) => parts.iter().map(float).collect(),
        scalar => vec![float(scalar)],
    }
}

fn float(value: &ShownValue) -> f32 {
    match value {
        ShownValue::Float(x) => *x,
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn near(found: &[f32], expected: &[f32], tolerance: f32) {
    let is_near = found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
    assert!(is_near, "{found:?}, not {expected:?}");
}

/// The light equation of exercise 07 at one pixel, from the ray through it and a sphere of radius 0.5 around (0, 0, -2).
#[test]
fn the_model_solution_has_the_values_of_the_equation() {
    let pixel = [40, 21];
    let listing =
        with_pair(reference("reference.vert"), reference("reference.frag"), |scene| scene.step_pixel(pixel).unwrap());
    let tangent = (0.5 * 38_f32.to_radians()).tan();
    let along = |i: u32| ((i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0) * tangent;
    let direction = glam::Vec3::new(along(pixel[0]), -along(pixel[1]), -1.0).normalize();
    let centre = glam::Vec3::new(0.0, 0.0, -2.0);
    let middle = direction.dot(centre);
    let distance = middle - (middle * middle - centre.length_squared() + 0.25).sqrt();
    let p = direction * distance;
    let n = (p - centre) * 2.0;
    let light = glam::Vec3::new(1.0, 2.0, 1.5);
    let (d, l, v) = ((light - p).length(), (light - p).normalize(), -direction);
    let attenuation = 1.0 / (1.0 + 0.14 * d + 0.07 * d * d);
    // The mesh has flat triangles, 5 degrees across: its surface is up to 0.5 * (1 - cos 2.5 degrees) inside the sphere.
    near(&floats(&listing, "v_frag_coord"), &p.to_array(), 2e-3);
    near(&floats(&listing, "N"), &n.to_array(), 4e-3);
    near(&floats(&listing, "L"), &l.to_array(), 1e-3);
    near(&floats(&listing, "V"), &v.to_array(), 1e-5);
    near(&floats(&listing, "d"), &[d], 2e-3);
    near(&floats(&listing, "attenuation"), &[attenuation], 5e-4);
    // From the listed N, L and V, the terms are exact.
    let of = |name: &str| glam::Vec3::from_slice(&floats(&listing, name));
    let (n, l, v) = (of("N"), of("L"), of("V"));
    let r = 2.0 * n.dot(l) * n - l;
    near(&floats(&listing, "diffuse"), &[0.8 * n.dot(l).max(0.0)], 1e-6);
    near(&floats(&listing, "specular"), &[0.8 * r.dot(v).max(0.0).powf(32.0)], 1e-5);
    // Varyings come first, and every step's line is the source's.
    assert_eq!(listing.inputs[0].name, "v_frag_coord");
    let step = listing.steps.iter().find(|step| step.writes.iter().any(|write| write.name == "attenuation")).unwrap();
    assert!(listing.lines[step.line as usize - 1].text.contains("float attenuation ="), "{step:?}");
    assert!(listing.unwritten.is_empty() && listing.non_finite.is_none() && listing.endless.is_none());
}

#[test]
fn matrices_are_listed_by_rows_at_the_corners_of_a_triangle() {
    with_pair(reference("reference.vert"), reference("reference.frag"), |scene| {
        let surface = scene.surface([SIDE / 2; 2]).unwrap();
        assert!((surface.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        let mut middle = glam::Vec3::ZERO;
        for (vertex, share) in surface.vertices.into_iter().zip(surface.shares) {
            let listing = scene.step_vertex(vertex).unwrap();
            let model = listing.inputs.iter().find(|input| input.name == "M").unwrap();
            assert_eq!(model.value.to_string(), "[0.5, 0, 0, 0; 0, 0.5, 0, 0; 0, 0, 0.5, -2; 0, 0, 0, 1]");
            let (position, placed) = (floats(&listing, "position"), floats(&listing, "v_frag_coord"));
            near(&placed, &[0.5 * position[0], 0.5 * position[1], 0.5 * position[2] - 2.0], 1e-6);
            middle += share as f32 * glam::Vec3::from_slice(&placed);
        }
        let at_pixel = scene.step_pixel([SIDE / 2; 2]).unwrap();
        near(&floats(&at_pixel, "v_frag_coord"), &middle.to_array(), 1e-5);
        assert!(scene.step_vertex(scene.vertex_count()).is_none());
        assert!(scene.step_pixel([0, 0]).is_none() && scene.step_pixel([SIDE, 0]).is_none());
        assert_eq!(scene.nearest_drawn([SIDE / 2, 3]).unwrap()[0], SIDE / 2);
    });
}

#[test]
fn a_varying_that_the_vertex_shader_never_writes_is_listed() {
    let vertex = reference("reference.vert").replace("v_normal = normalize(mat3(itM) * normal);", "");
    with_pair(&vertex, reference("reference.frag"), |scene| {
        let listing = scene.step_pixel([SIDE / 2; 2]).unwrap();
        let unwritten: Vec<_> = listing.inputs.iter().filter(|i| i.value.is_unwritten()).map(|i| &*i.name).collect();
        assert_eq!(unwritten, ["v_normal"]);
        let place = &listing.unwritten[0];
        assert_eq!((&*place.expression, place.line), ("v_normal", 26));
        // What depends on it is cyan in pictures.
        let picture = scene.picture(Stage::Fragment, [28, 10], [0; 3], None).unwrap().own;
        assert_eq!((&*picture.expression, picture.unwritten), ("normalize(u_view_pos - v_frag_coord)", 0));
        let picture = scene.picture(Stage::Fragment, [29, 10], [0; 3], None).unwrap().own;
        assert_eq!((&*picture.expression, picture.unwritten), ("reflect(-L, N)", picture.drawn));
        assert_eq!(picture.rgba[((SIDE / 2 * SIDE + SIDE / 2) * 4) as usize..][..4], NEVER_WRITTEN_COLOUR);
    });
}

#[test]
fn the_first_value_that_is_not_finite_is_found() {
    let listing = listed("vec3 zero = v_normal * 0.0;\nvec3 n = normalize(zero);\nFragColor.rgb = n;");
    let (place, value) = listing.non_finite.clone().unwrap();
    assert_eq!((&*place.expression, place.line, place.column), ("normalize(zero)", 9, 10));
    assert_eq!(value.to_string(), "(NaN, NaN, NaN)");
    assert_eq!(values(&listing, "n"), ["(NaN, NaN, NaN)"]);
    // The driver removes `v_normal` from this program, because the colour does not depend on it; the listing has its value.
    near(&floats(&listing, "v_normal"), &[0.0, 0.0, 1.0], 0.1);
    for (body, expression, value) in [
        ("FragColor.r = pow(-1., .5);", "pow(-1., .5)", "NaN"),
        ("FragColor.rgb = normalize(vec3(0));", "normalize(vec3(0))", "(NaN, NaN, NaN)"),
        ("FragColor.r = 1.0 / (v_normal.z * 0.0);", "1.0 / (v_normal.z * 0.0)", "inf"),
    ] {
        let (place, found) = listed(body).non_finite.unwrap();
        assert_eq!((&*place.expression, &*found.to_string()), (expression, value));
    }
}

#[test]
fn iterations_and_calls_are_steps_in_the_order_of_execution() {
    let body = "void add(inout float a, float b) {\n a += b;\n}\n---\nfloat sum = 0.5;\nfor (int i = 0; i < 3; i++) {\n\
                add(sum, float(i));\n}\nFragColor.r = sum;";
    let listing = listed(body);
    assert_eq!(values(&listing, "sum"), ["0.5", "0.5", "1.5", "3.5"]);
    assert_eq!(values(&listing, "i"), ["0", "1", "2", "3"]);
    assert_eq!(values(&listing, "a"), ["0.5", "0.5", "0.5", "1.5", "1.5", "3.5"]);
    let steps: Vec<_> = listing.steps.iter().filter(|step| step.writes.iter().any(|w| w.name == "a")).collect();
    // The parameter's value at the function's header, then the assignment, in each of three iterations.
    let seen: Vec<_> = steps.iter().map(|step| (step.line, step.iterations[0])).collect();
    assert_eq!(seen, [(5, 1), (6, 1), (5, 2), (6, 2), (5, 3), (6, 3)]);
    assert_eq!((&*steps[1].function, &steps[1].calls[..]), ("add", &[14][..]));
    let callers: Vec<_> = listing.steps.iter().filter(|s| s.writes.iter().any(|w| w.name == "sum")).collect();
    assert!(callers.iter().all(|step| step.function == "main"), "{callers:?}");
}

#[test]
fn returned_values_are_listed_and_undefined_ones_have_one_origin() {
    let listing = listed(
        "float twice(float x) {\n return 2.0 * x;\n}\n---\nfloat y = twice(4.0);\nfloat z;\ny += z;\nFragColor.r = y;",
    );
    assert_eq!(values(&listing, "return"), ["8"]);
    assert_eq!(values(&listing, "y"), ["8", "undefined"]);
    let unwritten: Vec<_> = listing.unwritten.iter().map(|place| (&*place.expression, place.line)).collect();
    assert_eq!(unwritten, [("z", 14)]);
    assert_eq!(values(&listing, "FragColor").last().unwrap().split(", ").next(), Some("(?"));
}

#[test]
fn branches_that_were_not_taken_and_discards_are_listed() {
    let listing = listed(
        "if (v_normal.z < 0.5) {\nFragColor.r = 1.0;\n} else {\nFragColor.g = v_normal.x > 2.0 ? 1.0 : 0.25;\n}\ndiscard;",
    );
    let conditions: Vec<_> = listing
        .steps
        .iter()
        .flat_map(|step| step.conditions.iter().map(|c| (step.line, &*c.expression, c.holds)))
        .collect();
    assert_eq!(conditions, [(8, "v_normal.z < 0.5", false), (11, "v_normal.x > 2.0", false)]);
    let ran: Vec<_> = listing.lines.iter().filter_map(|line| Some((line.number, line.ran?))).collect();
    assert_eq!(ran, [(7, true), (8, true), (9, false), (11, true), (13, true)]);
    assert_eq!(listing.discarded, Some(13));
    assert_eq!(listed("").discarded, None);
}

#[test]
fn an_endless_loop_ends_with_its_line() {
    let listing = listed("float x = 0.0;\nfor (;;) {\nif (v_normal.z < 9.0) {\nx += 1.0;\n}\n}\nFragColor.r = x;");
    let (line, statements) = listing.endless.unwrap();
    assert_eq!(line, 9);
    assert!(statements > 1000, "{statements}");
    assert!(listing.lines.iter().all(|line| line.ran != Some(false)), "nothing is known about lines after it");
    let fragment = reference("reference.frag").replace("float d =", "for (;;) { N += 1.0; }\nfloat d =");
    with_pair(reference("reference.vert"), &fragment, |scene| {
        let picture = scene.picture(Stage::Fragment, [26, 10], [0; 3], None).unwrap().own;
        assert!(picture.is_truncated && (1..picture.drawn).contains(&picture.unevaluated), "{}", picture.unevaluated);
    });
    let vertex = reference("reference.vert").replace("v_normal =", "while (true) { v_normal.x += 1.0; }\nv_normal =");
    with_pair(&vertex, reference("reference.frag"), |scene| {
        assert_eq!((scene.endless_vertex(), scene.nearest_drawn([0, 0])), (Some(0), None));
        assert_eq!(scene.step_vertex(0).unwrap().endless.unwrap().0, 20);
    });
}

#[test]
fn derivatives_are_those_of_neighbouring_pixels() {
    let listing = listed("vec2 a = vec2(dFdx(gl_FragCoord.x), dFdy(gl_FragCoord.y));\nfloat b = dFdx(v_frag_coord.x);");
    assert_eq!(values(&listing, "a"), ["(1, 1)"]);
    // At distance 1.5, the picture of 64 pixels is 2 * 1.5 * tan 19 degrees wide.
    near(&floats(&listing, "b"), &[3.0 * 19_f32.to_radians().tan() / SIDE as f32], 2e-4);
}

#[test]
fn a_picture_shows_the_smallest_expression_at_a_place() {
    with_pair(reference("reference.vert"), reference("reference.frag"), |scene| {
        let shown = |line, column| scene.picture(Stage::Fragment, [line, column], [9; 3], None).unwrap().own;
        let middle = |picture: &ExpressionPicture| {
            let at = ((SIDE / 2 * SIDE + SIDE / 2) * 4) as usize;
            [picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]]
        };
        // `vec3 N = normalize(v_normal);`: the name, the call, the argument.
        for column in [10, 14] {
            let picture = shown(26, column);
            assert_eq!((&*picture.expression, picture.mapping), ("normalize(v_normal)", ExpressionMapping::Direction));
            let listing = scene.step_pixel([SIDE / 2; 2]).unwrap();
            let n = floats(&listing, "N").iter().map(|x| ((x * 0.5 + 0.5) * 255.0).round() as u8).collect::<Vec<_>>();
            assert_eq!(middle(&picture), *n);
            assert_eq!(picture.rgba[..4], [9, 9, 9, 255]);
        }
        assert_eq!(shown(26, 25).expression, "v_normal");
        let d = shown(35, 11);
        assert_eq!((&*d.expression, &*d.glsl_type), ("length(light.light_pos - v_frag_coord)", "float"));
        let ExpressionMapping::Grey { least, greatest } = d.mapping else { panic!("{:?}", d.mapping) };
        // The sphere's nearest point is at 0.5 from its centre on the way to the light.
        let nearest = glam::Vec3::new(1.0, 2.0, 3.5).length() - 0.5;
        assert!((least - nearest).abs() < 0.01 && greatest < nearest + 1.0, "{least} to {greatest}, {nearest}");
        let error = scene.picture(Stage::Fragment, [1, 1], [0; 3], None).unwrap_err();
        assert!(error.contains("a.frag:1:1") && error.contains("no expression"), "{error}");
        // In the vertex shader: `v_normal = normalize(mat3(itM) * normal);`
        let normal = scene.picture(Stage::Vertex, [20, 16], [0; 3], None).unwrap().own;
        assert_eq!(
            (&*normal.expression, normal.mapping),
            ("normalize(mat3(itM) * normal)", ExpressionMapping::Direction)
        );
        let error = scene.picture(Stage::Vertex, [20, 27], [0; 3], None).unwrap_err();
        assert!(error.contains("mat3(itM)") && error.contains("has the type mat3"), "{error}");
    });
}

#[test]
fn an_expression_has_a_value_for_each_iteration_and_call() {
    let body = "float half_of(float x) {\n return 0.5 * x;\n}\n---\nfloat sum = 0.0;\nfor (int i = 0; i < 3; i++) {\n\
                sum += half_of(float(i));\n}\nFragColor.r = sum;";
    let (before, main) = body.split_once("---").unwrap();
    let fragment = format!(
        "#version 330 core\nin vec3 v_normal;\nout vec4 FragColor;\n{before}\nvoid main() {{\nFragColor = \
         vec4(v_normal, 1.0);\n{main}\n}}\n"
    );
    with_pair(reference("reference.vert"), &fragment, |scene| {
        let middle = SteppedPlace::Pixel([SIDE / 2; 2]);
        let found = scene.expression_value(middle, [5, 15]).unwrap();
        assert_eq!((&*found.expression, found.line, found.column, found.length), ("x", 5, 15, 1));
        let product = scene.expression_value(middle, [5, 13]).unwrap();
        assert_eq!((&*product.expression, &*product.glsl_type, product.length), ("0.5 * x", "float", 7));
        let seen: Vec<_> = product.evaluations.iter().map(|e| (e.value.to_string(), e.iterations.clone())).collect();
        let expected = [("0", 1), ("0.5", 2), ("1", 3)].map(|(value, iteration)| (value.to_owned(), vec![iteration]));
        assert_eq!(seen, expected);
        assert!(product.evaluations.iter().all(|e| e.function == "half_of" && e.calls == [13]));
        let picture = scene.picture_of(Stage::Fragment, &product, [0; 3], None).unwrap().own;
        assert_eq!((&*picture.expression, picture.evaluations), ("0.5 * x", 3));
        assert!(scene.expression_value(SteppedPlace::Pixel([0; 2]), [5, 15]).is_none(), "nothing is drawn there");
        assert!(scene.expression_value(middle, [1, 1]).is_none(), "there is no expression");
        // `v_normal = normalize(mat3(itM) * normal);`
        let corner = scene.surface([SIDE / 2; 2]).unwrap().vertices[0];
        let matrix = scene.expression_value(SteppedPlace::Vertex(corner), [20, 27]).unwrap();
        assert_eq!((&*matrix.glsl_type, matrix.evaluations.len()), ("mat3", 1));
    });
}

#[test]
fn a_part_of_the_square_has_coordinates_of_its_own() {
    let fragment = "#version 330 core\nout vec4 FragColor;\nvoid main() {\nFragColor = gl_FragCoord;\n}\n";
    let exercise = exercise::find("ex07").unwrap();
    with_pair(reference("reference.vert"), fragment, |scene| {
        let of_scene = &preview::scenes(exercise)[0];
        let objects = of_scene.test_scenes(&of_scene.eye, 0.0, [SIDE; 2]);
        let options = StepOptions { origin: [4, 10], ..StepOptions::square(SIDE) };
        let part = SteppedScene::new(scene.pair.clone(), &objects, options);
        let [whole, part] = [scene, &part].map(|scene| floats(&scene.step_pixel([30, 40]).unwrap(), "FragColor"));
        assert_eq!((whole[0], whole[1]), (30.5, SIDE as f32 - 40.5));
        assert_eq!((part[0], part[1]), (whole[0] - 4.0, whole[1] - 10.0));
    });
}

/// The page has no thread for it.
#[test]
fn brief_work_suffices_for_every_exercise() {
    let context = HeadlessContext::new().unwrap();
    for exercise in exercise::all().iter().filter(|exercise| preview::is_drawn(exercise)) {
        let submitted = preview::reference(exercise).unwrap();
        let compiled = submitted.compile(context.gl()).unwrap();
        let pair = Arc::new(SteppedPair::new(&submitted, &compiled.bindings).unwrap());
        for of_scene in preview::scenes(exercise) {
            let objects = of_scene.test_scenes(&of_scene.eye, 0.0, [200; 2]);
            let options = StepOptions { work: StepWork::BRIEF, ..StepOptions::square(200) };
            let scene = SteppedScene::new(pair.clone(), &objects, options);
            let name = format!("{} in {}", exercise.id, of_scene.name);
            assert_eq!(scene.endless_vertex(), None, "{name}");
            let pixel = scene.nearest_drawn([100; 2]).unwrap_or_else(|| panic!("{name}: nothing is drawn"));
            let listing = scene.step_pixel(pixel).unwrap();
            assert!(listing.endless.is_none() && !listing.is_truncated, "{name}");
            let output = &listing.outputs[0];
            assert!(!output.value.is_partly_unwritten(), "{name}: {output:?}");
            let last = listing.steps.last().unwrap().line;
            let text = &listing.lines[last as usize - 1].text;
            let column = text.find("= ").unwrap_or_else(|| panic!("{name}: {text}")) as u32 + 3;
            let picture = scene.picture(Stage::Fragment, [last, column], [0; 3], None);
            let picture = picture.unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(!picture.own.is_truncated, "{name}");
        }
    }
}

/// The line and column of the first place of some code, both from 1.
fn place(text: &str, code: &str) -> [u32; 2] {
    let line = text.lines().position(|line| line.contains(code)).unwrap();
    let column = text.lines().nth(line).unwrap().find(code).unwrap();
    [line as u32 + 1, column as u32 + 1]
}

#[track_caller]
fn alike(found: &ExpressionPicture, expected: &ExpressionPicture) {
    assert_eq!((found.mapping, found.drawn), (expected.mapping, expected.drawn));
    let differ = |(a, b): (&u8, &u8)| a.abs_diff(*b) > 1;
    let different = found.rgba.iter().zip(&expected.rgba).filter(|pair| differ(*pair)).count();
    assert!(found.drawn > 200 && different == 0, "{different} bytes of {}", found.drawn * 4);
}

#[test]
fn right_values_are_those_of_a_right_program() {
    let vertex = reference("reference.vert");
    // A colour that is no quantity of the light equation.
    let dark = "vec3 dark = vec3(0.5 * attenuation * attenuation);\n    float sum = ";
    let fragment = reference("reference.frag").replace("float sum = ", dark);
    let normal = ["normalize(mat3(itM) * normal)", "normalize(mat3(M) * normal)"];
    let distance = ["length(light.light_pos - v_frag_coord)", "length(light.light_pos)"];
    let wrongs = [
        (vertex.to_owned(), fragment.replace(distance[0], distance[1]), Stage::Fragment, distance[1]),
        (vertex.replace(normal[0], normal[1]), fragment.clone(), Stage::Vertex, "mat3(M) * normal"),
    ];
    for (wrong_vertex, wrong_fragment, stage, cause) in wrongs {
        for (number, code) in [(0, "* sum, 1.0"), (1, "normalize(v_normal)"), (1, "vec3(0.5")] {
            let at = place(&fragment, code);
            let of_right = with_answer(vertex, &fragment, number, |scene, answer| {
                let shown = scene.picture(Stage::Fragment, at, [0; 3], answer().as_ref()).unwrap();
                // Its own right values are the model solution's.
                shown.right.iter().for_each(|right| alike(right, &shown.own));
                assert_eq!(shown.right.is_some(), code != "vec3(0.5", "{code}");
                shown.own
            });
            with_answer(&wrong_vertex, &wrong_fragment, number, |scene, answer| {
                let answer = answer().unwrap();
                let shown = scene.picture(Stage::Fragment, at, [0; 3], Some(&answer)).unwrap();
                let is_wrong = (stage == Stage::Fragment) == (code != "normalize(v_normal)");
                let sentence = shown.quantity.unwrap_or_default();
                if is_wrong || code == "* sum, 1.0" {
                    assert!(sentence.ends_with("earlier value is wrong."), "{code}: {sentence}");
                }
                match shown.right {
                    Some(right) => alike(&right, &of_right),
                    None => assert!(stage == Stage::Vertex && code == "vec3(0.5", "{code}"),
                }
                let text = if stage == Stage::Vertex { &wrong_vertex } else { &wrong_fragment };
                let pixel = scene.nearest_drawn([SIDE / 2; 2]).unwrap();
                let vertex = scene.surface(pixel).unwrap().vertices[0];
                let both = [SteppedPlace::Pixel(pixel), SteppedPlace::Vertex(vertex)];
                let found = both.map(|place| scene.right_at(&answer, place));
                let right = &found[usize::from(stage == Stage::Vertex)];
                assert_eq!(found.iter().flatten().count(), 1);
                assert_eq!([right[0].line, right[0].column], place(text, cause), "{}", right[0].should);
                assert!(right[0].value.is_some() && right[0].should.starts_with("should be "), "{right:?}");
            });
        }
    }
}

#[test]
fn a_right_value_at_a_pixel_is_that_of_the_reference() {
    let fragment = reference("reference.frag");
    let pixel = [SIDE / 2 + 5, SIDE / 2 - 3];
    let d = with_pair(reference("reference.vert"), fragment, |scene| floats(&scene.step_pixel(pixel).unwrap(), "d"));
    let wrong = fragment.replace("length(light.light_pos - v_frag_coord)", "length(light.light_pos)");
    with_answer(reference("reference.vert"), &wrong, 0, |scene, answer| {
        let right = scene.right_at(&answer().unwrap(), SteppedPlace::Pixel(pixel));
        assert!((float(right[0].value.as_ref().unwrap()) - d[0]).abs() < 1e-4, "{right:?} {d:?}");
    });
}
