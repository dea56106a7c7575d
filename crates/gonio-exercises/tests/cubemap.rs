//! Submissions of six pictures of a panorama's faces, right and wrong.
#![allow(missing_docs, clippy::unwrap_used)]

use gonio_check::CheckOptions;
use gonio_check::feedback::Feedback;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::{Outcome, Verdict};
use gonio_environment::{Arrangement, Conversion, Cubemap, Face, Filter, Layout, Panorama, arrange, convert};
use gonio_exercises::Checker;
use gonio_exercises::exercise;
use gonio_gl::HeadlessContext;
use gonio_image::decode::{DecodedContent, decode};
use gonio_image::encode::png;
use gonio_image::{DecodeLimits, Image};
use gonio_light::color::OutputTransform;

const SIDE: u32 = 128;

/// The panorama that the exercise hands out.
fn panorama() -> Panorama {
    let (name, bytes) = exercise::find("s1").unwrap().pictures().next().unwrap();
    match decode(name, bytes, &DecodeLimits::default()).unwrap().shape {
        DecodedContent::Picture(image) => Panorama::new(image).unwrap(),
        DecodedContent::Faces(_) => panic!("{name} is not a panorama"),
    }
}

fn converted(panorama: &Panorama, size: u32, filter: Filter) -> Cubemap {
    let conversion = Conversion { filter: Some(filter), ..Conversion::default() };
    conversion.cubemap(convert::EnvironmentRef::Panorama(panorama), size)
}

fn faces() -> [Image; 6] {
    converted(&panorama(), SIDE, Filter::Bilinear).faces(Layout::OpenGl)
}

fn file(name: &str, image: &Image) -> SourceFile {
    let depth = png::Depth::Eight;
    SourceFile::new(name, png::encode(image, &OutputTransform::default(), depth).unwrap())
}

fn files(faces: &[Image; 6], names: [&str; 6]) -> Vec<SourceFile> {
    names.into_iter().zip(faces).map(|(name, image)| file(name, image)).collect()
}

const NAMES: [&str; 6] = ["posx.png", "negx.png", "posy.png", "negy.png", "posz.png", "negz.png"];

/// A picture whose pixels come from other places of an image.
fn from_elsewhere(image: &Image, place: impl Fn(u32, u32) -> (u32, u32)) -> Image {
    let mut other = image.clone();
    for y in 0..image.height {
        for x in 0..image.width {
            let (from_x, from_y) = place(x, y);
            other.pixels[(y * image.width + x) as usize] = image.at(from_x, from_y);
        }
    }
    other
}

fn with(face: Face, change: impl Fn(&Image) -> Image) -> [Image; 6] {
    let mut all = faces();
    all[face as usize] = change(&all[face as usize]);
    all
}

struct TestLab {
    checker: Checker,
    _context: HeadlessContext,
}

impl TestLab {
    fn new() -> Self {
        let context = HeadlessContext::new().unwrap_or_else(|error| panic!("{error}"));
        TestLab { checker: Checker::new(context.gl()), _context: context }
    }

    fn check(&mut self, files: Vec<SourceFile>) -> Verdict {
        let s1 = exercise::find("s1").unwrap();
        gonio_exercises::check(&mut self.checker, s1, files, &CheckOptions::default(), Feedback::Fix).unwrap().0
    }

    fn is_right(&mut self, what: &str, files: Vec<SourceFile>) -> Verdict {
        let verdict = self.check(files);
        assert_eq!(verdict.verdict, Outcome::Correct, "{what}: {}", verdict.summary);
        verdict
    }

    fn ids(&mut self, faces: &[Image; 6]) -> Vec<String> {
        let verdict = self.check(files(faces, NAMES));
        assert_eq!(verdict.verdict, Outcome::Wrong, "{}", verdict.summary);
        verdict.mistakes.into_iter().map(|found| found.id).collect()
    }
}

#[test]
fn right_faces_are_right_under_every_name_filter_and_size() {
    let mut lab = TestLab::new();
    lab.is_right("as the text says", files(&faces(), NAMES));
    lab.is_right("px", files(&faces(), ["px.png", "nx.png", "py.png", "ny.png", "pz.png", "nz.png"]));
    let words = ["my_right.png", "my_left.png", "my_top.png", "my_bottom.png", "my_front.png", "my_back.png"];
    lab.is_right("words", files(&faces(), words));
    for filter in [Filter::Nearest, Filter::Bicubic, Filter::Area] {
        lab.is_right("filter", files(&converted(&panorama(), SIDE, filter).faces(Layout::OpenGl), NAMES));
    }
    for size in [96, 200, 512] {
        let faces = converted(&panorama(), size, Filter::Bilinear).faces(Layout::OpenGl);
        lab.is_right("size", files(&faces, NAMES));
    }
    let small = converted(&panorama(), 48, Filter::Area).faces(Layout::OpenGl);
    let verdict = lab.is_right("small", files(&small, NAMES));
    assert!(verdict.warnings.iter().any(|warning| warning.contains("48 x 48")), "{:?}", verdict.warnings);
    let map = Cubemap::from_faces(faces(), Layout::OpenGl).unwrap();
    for arrangement in [Arrangement::Strip, Arrangement::VerticalStrip, Arrangement::Cross] {
        let one = arrange::from_cubemap(&map, arrangement, Layout::OpenGl).unwrap();
        lab.is_right("one picture", vec![file("faces.png", &one)]);
    }
}

#[test]
fn each_face_with_a_wrong_orientation_is_named() {
    let mut lab = TestLab::new();
    let last = SIDE - 1;
    let left = |image: &Image| from_elsewhere(image, |x, y| (last - y, x));
    let half = |image: &Image| from_elsewhere(image, |x, y| (last - x, last - y));
    let mirrored = |image: &Image| from_elsewhere(image, |x, y| (last - x, y));
    assert_eq!(lab.ids(&with(Face::PosY, left)), ["face-posy-turned-left"]);
    assert_eq!(lab.ids(&with(Face::NegY, half)), ["face-negy-turned-half"]);
    assert_eq!(lab.ids(&with(Face::PosX, mirrored)), ["face-posx-mirrored"]);
    let mut swapped = faces();
    swapped.swap(4, 5);
    assert_eq!(lab.ids(&swapped), ["faces-posz-negz-swapped"]);
    let mut three = with(Face::PosY, half);
    three[3] = left(&three[3]);
    three.swap(0, 1);
    assert_eq!(lab.ids(&three), ["faces-posx-negx-swapped", "face-posy-turned-half", "face-negy-turned-left"]);
    let verdict = lab.check(files(&three, NAMES));
    let right: Vec<&str> = verdict.scenes.iter().filter(|s| s.right).map(|s| s.scene.as_str()).collect();
    assert_eq!(right, ["+Z posz", "-Z negz"]);
    let mut same = faces();
    same[1] = same[0].clone();
    assert_eq!(lab.ids(&same), ["face-negx-shows-posx"]);
}

#[test]
fn a_mistake_in_all_faces_is_one_mistake() {
    let mut lab = TestLab::new();
    let last = SIDE - 1;
    let photographic = converted(&panorama(), SIDE, Filter::Bilinear).faces(Layout::Photographic);
    assert_eq!(lab.ids(&photographic), ["layout-photographic"]);
    let all = |change: &dyn Fn(&Image) -> Image| faces().each_ref().map(change);
    assert_eq!(lab.ids(&all(&|image| from_elsewhere(image, |x, y| (x, last - y)))), ["faces-flipped"]);
    assert_eq!(lab.ids(&all(&|image| from_elsewhere(image, |x, y| (last - x, y)))), ["faces-mirrored"]);
    assert_eq!(lab.ids(&std::array::from_fn(|_| faces()[4].clone())), ["face-ignored"]);
    let given = panorama();
    let flipped = from_elsewhere(&given.image, |x, y| (x, given.image.height - 1 - y));
    let upside_down = converted(&Panorama::new(flipped).unwrap(), SIDE, Filter::Bilinear);
    assert_eq!(lab.ids(&upside_down.faces(Layout::OpenGl)), ["panorama-upside-down"]);
    let brighter = |image: &Image| {
        let mut other = image.clone();
        other
            .pixels
            .iter_mut()
            .flat_map(|pixel| &mut pixel[..3])
            .for_each(|channel| *channel = channel.powf(1.0 / 2.2));
        other
    };
    assert_eq!(lab.ids(&all(&brighter)), ["faces-too-bright"]);
    let blurred = converted(&panorama(), 40, Filter::Area);
    let blurred = Conversion { filter: Some(Filter::Bilinear), ..Conversion::default() }
        .cubemap(convert::EnvironmentRef::Cubemap(&blurred), SIDE);
    assert_eq!(lab.ids(&blurred.faces(Layout::OpenGl)), ["faces-blurred"]);
}

#[test]
fn a_panorama_beside_the_faces_is_used() {
    let mut lab = TestLab::new();
    let other = Panorama::from_function(256, 128, |d| {
        0.5 + 0.4 * glam::DVec3::new((3.0 * d.x).sin(), (4.0 * d.y + d.x).cos(), d.z)
    });
    let faces = converted(&other, SIDE, Filter::Bilinear).faces(Layout::OpenGl);
    let mut handed = files(&faces, NAMES);
    assert_eq!(lab.check(handed.clone()).verdict, Outcome::Wrong);
    handed.push(file("my-panorama.png", &other.image));
    lab.is_right("with its panorama", handed);
}

#[test]
fn reasons_for_no_verdict_are_reported() {
    let mut lab = TestLab::new();
    let mut five = files(&faces(), NAMES);
    five.remove(2);
    let mut broken = files(&faces(), NAMES);
    broken[3].bytes.truncate(200);
    let mut odd = files(&faces(), NAMES);
    odd[5] = file("negz.png", &converted(&panorama(), 64, Filter::Area).faces(Layout::OpenGl)[5]);
    let tiny = files(&converted(&panorama(), 16, Filter::Area).faces(Layout::OpenGl), NAMES);
    for (what, files, reason) in [
        ("five faces", five, "posy"),
        ("a broken file", broken, "negy.png"),
        ("two sizes", odd, "64 x 64"),
        ("too small", tiny, "16 x 16"),
    ] {
        let verdict = lab.check(files);
        assert_eq!(verdict.verdict, Outcome::Unsure, "{what}: {}", verdict.summary);
        assert!(verdict.summary.contains(reason), "{what}: {}", verdict.summary);
    }
}
