//! `gonio tour`, small and by the CPU: every file that the page names exists, and every picture can be drawn again.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::Lab;
use std::collections::HashSet;

/// Every text between `before` and the next `"`.
fn attributes<'a>(page: &'a str, before: &str) -> Vec<&'a str> {
    page.split(before).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn a_small_tour_is_complete_and_reproducible() {
    let lab = Lab::new();
    let run = lab.run(&["tour", "-o", "out tour", "--scale", "0.1", "--backend", "cpu", "--json"]).good();
    let report = run.json();
    let pictures = report["pictures"].as_array().unwrap();
    assert!(pictures.len() >= 105, "{}", pictures.len());

    // The sheet: a tenth of 1920 wide, with the height in the report.
    let sheet = lab.picture("out tour/sheet.png");
    assert_eq!(sheet.width(), 192);
    assert_eq!(u64::from(sheet.height()), report["sheet"]["height"].as_u64().unwrap());
    // Not an empty sheet: the first picture has many colours.
    let colors: HashSet<[u8; 3]> = sheet.to_rgb8().pixels().map(|p| p.0).collect();
    assert!(colors.len() > 1000, "{}", colors.len());

    // The page works from disk, and all files that it names exist.
    let page = String::from_utf8(lab.read("out tour/index.html")).unwrap();
    assert!(!page.contains("<script") && !page.contains("http://") && !page.contains("https://"));
    let images = attributes(&page, "<img src=\"");
    assert_eq!(images.len(), pictures.len());
    for href in attributes(&page, "href=\"") {
        match href.strip_prefix('#') {
            Some(id) => assert!(page.contains(&format!("id=\"{id}\"")), "{href}"),
            None => assert!(lab.path("out tour").join(href).is_file(), "{href}"),
        }
    }
    let drawn = pictures.iter().filter(|p| p["scene"].is_string()).count();
    assert!(drawn > 0 && drawn < pictures.len());
    assert_eq!(page.matches("n/a: drawn by the CPU").count(), drawn);
    let stations = pictures.iter().filter(|p| p["section"] == "beyond").count();
    assert_eq!((stations, page.matches("<dt>computed in</dt>").count()), (10, 10));
    assert_eq!(page.matches("<dt>converted in</dt>").count(), pictures.len() - drawn - stations);
    for (tag, close) in [("<figure", "</figure>"), ("<section", "</section>"), ("<mrow", "</mrow>"), ("<div", "</div>")]
    {
        assert_eq!(page.matches(tag).count(), page.matches(close).count(), "{tag}");
    }

    for picture in pictures {
        let name = picture["name"].as_str().unwrap();
        assert!(images.contains(&format!("pictures/{name}.png").as_str()), "{name}");
        let fragments = picture["drawn"]["fragments"].as_u64();
        assert_eq!(fragments.is_some_and(|n| n > 0), picture["scene"].is_string(), "{name}");
        draw_again(&lab, picture);
    }

    // A tour into an existing folder updates it and leaves no other files.
    let before: Vec<_> = std::fs::read_dir(lab.path("out tour")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(before.len(), 4, "{before:?}");
}

/// Runs the printed command of a picture, and compares the bytes.
#[track_caller]
fn draw_again(lab: &Lab, picture: &serde_json::Value) {
    let name = picture["name"].as_str().unwrap();
    for command in picture["command"].as_str().unwrap().split(" && ") {
        // A quoted text is one word.
        let parts = command.split('"').enumerate();
        let words: Vec<&str> = parts
            .flat_map(|(i, part)| if i % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
            .collect();
        assert_eq!(words[0], "gonio");
        lab.run(&words[1..]).good();
    }
    let (again, first) = (lab.read(&format!("{name}.png")), lab.read(&format!("out tour/pictures/{name}.png")));
    assert!(again == first, "{name} differs from its second drawing");
}

/// Drawn by OpenGL where it is available, else by the CPU, so the commands name no backend.
#[test]
fn the_commands_of_a_tour_name_no_backend() {
    let lab = Lab::new();
    let report = lab.run(&["tour", "-o", "out tour", "--scale", "0.1", "--json"]).good().json();
    let pictures = report["pictures"].as_array().unwrap();
    pictures.iter().step_by(12).for_each(|picture| draw_again(&lab, picture));
    let by_gl = report["backend"]["name"] == "gl";
    for picture in pictures {
        let difference = &picture["gpu_against_cpu"];
        let compared = by_gl && picture["scene"].is_string();
        assert_eq!(difference.is_object(), compared, "{picture}");
        // Set by llvmpipe (Mesa 22.3), whose anisotropic filter on pictures of this size is the worst case.
        assert!(!compared || difference["mean"].as_f64().unwrap() < 6.0, "{picture}");
    }
}

#[test]
fn a_file_at_the_path_of_a_folder_is_named() {
    let lab = Lab::new();
    lab.write("tour", "a file");
    lab.run(&["tour", "--backend", "cpu"]).refused(&["`tour` is a file", "-o"]);
    lab.run(&["tour", "-o", "tour/inside", "--backend", "cpu"]).refused(&["tour/inside", "not a folder"]);
    lab.run(&["tour", "--scale", "0"]);
    assert_eq!(lab.read("tour"), b"a file");
    assert_eq!(lab.names(), ["tour"]);
}
