//! Every link of the book leads somewhere, and every picture is a link to its scene on gonio's page.

use crate::REGENERATE;
use crate::commands::words;
use crate::common::Lab;
use crate::pages::{Page, docs, pages};
use gonio_app::files::link;
use gonio_beyond::station;
use gonio_bsdf::ParameterValues;
use gonio_scene::files::BuiltinOnly;
use gonio_scene::{SceneFile, load, toml_file};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

/// Where the book expects gonio's page, seen from `docs`: beside the book's folder.
const PAGE: &str = "../index.html";
/// Limit on the size of a picture, in bytes.
const MOST_PICTURE_BYTES: u64 = 40_000;

/// A link, an image or a definition of a link.
struct Link {
    target: String,
    is_image: bool,
    /// For an image: whether it is the text of a link.
    is_linked: bool,
}

fn links(page: &Page) -> Vec<Link> {
    let prose = page.prose();
    let definitions: BTreeMap<&str, &str> = prose
        .iter()
        .filter_map(|line| line.strip_prefix('[')?.split_once("]: "))
        .filter(|(name, _)| !name.contains(']'))
        .collect();
    let mut links = Vec::new();
    let link = |target: &str| Link { target: target.to_owned(), is_image: false, is_linked: false };
    links.extend(definitions.values().map(|target| link(target)));
    for line in &prose {
        assert!(
            !line.contains("<img") && !line.contains("href="),
            "{}: write links and images in Markdown: {line}",
            page.name
        );
        for (at, _) in line.match_indices("](") {
            let target = line[at + 2..].split_once(')').unwrap_or_else(|| panic!("{}: {line}", page.name)).0;
            let open = line[..at].rfind('[').unwrap_or_else(|| panic!("{}: {line}", page.name));
            let is_image = line[..open].ends_with('!');
            let after = &line[at + 2 + target.len() + 1..];
            links.push(Link {
                is_image,
                is_linked: is_image && line[..open].ends_with("[!") && after.starts_with(']'),
                ..link(target)
            });
        }
        for (at, _) in line.match_indices("][") {
            let name = line[at + 2..].split_once(']').unwrap_or_else(|| panic!("{}: {line}", page.name)).0;
            assert!(definitions.contains_key(name), "{}: [{name}] is not defined", page.name);
        }
    }
    links
}

/// The path of a link's target below `docs`, without `..` where possible.
fn resolved(page: &Page, target: &str) -> PathBuf {
    let mut path = PathBuf::new();
    for component in Path::new(&page.name).parent().unwrap().join(target).components() {
        let is_below = path.components().next_back().is_some_and(|last| last != Component::ParentDir);
        if component == Component::ParentDir && is_below {
            path.pop();
        } else {
            path.push(component);
        }
    }
    path
}

#[test]
fn every_link_leads_somewhere() {
    let pages = pages();
    let mut count = 0;
    for page in &pages {
        for Link { target, .. } in links(page) {
            count += 1;
            if let Some(rest) = target.strip_prefix("https://") {
                let host = rest.split('/').next().unwrap();
                let is_host = host.contains('.') && host.chars().all(|c| c.is_ascii_alphanumeric() || "-.".contains(c));
                assert!(is_host && !rest.contains(char::is_whitespace), "{}: {target}", page.name);
                continue;
            }
            assert!(!target.contains(':'), "{}: addresses begin with https: {target}", page.name);
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let path = if file.is_empty() { PathBuf::from(&page.name) } else { resolved(page, file) };
            if path == Path::new(PAGE) {
                opened(anchor).unwrap_or_else(|e| panic!("{}: {target}: {e}", page.name));
                continue;
            }
            assert!(!path.starts_with(".."), "{}: {target} is not part of the book", page.name);
            assert!(docs().join(&path).is_file(), "{}: there is no {target}", page.name);
            if !anchor.is_empty() {
                let name = path.to_string_lossy().replace('\\', "/");
                let other = pages.iter().find(|other| other.name == name);
                let anchors = other.unwrap_or_else(|| panic!("{}: {target} is no page", page.name)).anchors();
                assert!(
                    anchors.iter().any(|known| known == anchor),
                    "{}: no heading for {target}: {anchors:?}",
                    page.name
                );
            }
        }
    }
    assert!(count > 100, "only {count} links were found");
}

/// What the page opens for the part of its address after `#`, read by the application's own functions.
fn opened(fragment: &str) -> Result<Opened, String> {
    if let Some(link) = link::StationLink::parse(fragment) {
        let station = station(&link.name).ok_or_else(|| format!("there is no station `{}`", link.name))?;
        let mut values = ParameterValues::defaults(station.parameters);
        for (key, value) in &link.values {
            values.set(key, value).map_err(|e| e.to_string())?;
        }
        return Ok(Opened::Station(link.name));
    }
    let text = link::scene_file(fragment).ok_or("it contains neither a scene nor a station")??;
    let file = toml_file::read(&text).map_err(|e| e.to_string())?;
    load::load(file.clone(), Path::new(""), &BuiltinOnly).map_err(|e| e.to_string())?;
    Ok(Opened::Scene(Box::new(file)))
}

#[derive(Debug, PartialEq)]
enum Opened {
    Scene(Box<SceneFile>),
    Station(String),
}

/// The pictures that `docs/pictures.txt` lists: names, and the words after `gonio`.
fn listed() -> BTreeMap<String, Vec<String>> {
    let text = std::fs::read_to_string(docs().join("pictures.txt")).unwrap();
    let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let pictures: BTreeMap<String, Vec<String>> = lines
        .map(|line| {
            let (name, arguments) = line.split_once(": ").unwrap_or_else(|| panic!("{line}"));
            (name.to_owned(), words(arguments))
        })
        .collect();
    assert!(pictures.len() >= 8, "{pictures:?}");
    pictures
}

#[test]
fn every_picture_is_listed_and_links_to_its_scene() {
    let lab = Lab::new();
    let listed = listed();
    let mut shown = BTreeSet::new();
    for page in &pages() {
        let all = links(page);
        for Link { target, is_linked, .. } in all.iter().filter(|link| link.is_image) {
            let path = resolved(page, target);
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            assert_eq!(path, Path::new("pictures").join(format!("{name}.png")), "{}: {target}", page.name);
            // Written as [![text](pictures/NAME.png)][NAME], with the definition at the end of the page.
            assert!(
                *is_linked && page.text.contains(&format!("{name}.png)][{name}]")),
                "{}: {target} is no link",
                page.name
            );
            let definition = page.text.lines().find_map(|line| line.strip_prefix(&format!("[{name}]: ")));
            let (place, fragment) = definition
                .and_then(|target| target.split_once('#'))
                .unwrap_or_else(|| panic!("{}: [{name}]", page.name));
            assert_eq!(resolved(page, place), Path::new(PAGE), "{}: {name}", page.name);
            let arguments = listed.get(&name).unwrap_or_else(|| panic!("docs/pictures.txt does not list {name}"));
            assert_eq!(opened(fragment), expected(&lab, arguments), "{}: the link of {name}: {REGENERATE}", page.name);
            shown.insert(name);
        }
    }
    assert_eq!(shown, listed.keys().cloned().collect(), "left: shown in the book; right: docs/pictures.txt");
    for entry in std::fs::read_dir(docs().join("pictures")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        assert!(listed.contains_key(name), "{} is on no page", path.display());
        assert!(path.metadata().unwrap().len() <= MOST_PICTURE_BYTES, "{}", path.display());
    }
}

/// What the link of a picture must open.
fn expected(lab: &Lab, arguments: &[String]) -> Result<Opened, String> {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["render", scene @ ..] => {
            let run = lab.run(&[&["scene"], scene, &["--link"]].concat()).good();
            opened(run.text().trim().trim_start_matches('#'))
        }
        ["beyond", name, ..] => Ok(Opened::Station((*name).to_owned())),
        other => panic!("docs/pictures.txt: {other:?}"),
    }
}

/// The committed pictures are those that the program draws, by another driver too: outlines and textures differ a little.
#[test]
fn every_picture_is_what_the_program_draws() {
    listed().par_iter().for_each(|(name, arguments)| {
        let lab = Lab::new();
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let drawn = match words.as_slice() {
            ["beyond", station, options @ ..] => {
                let picture = options.iter().skip_while(|word| **word != "--picture").nth(1).unwrap();
                lab.run(&[&words, &["-o", "out"][..]].concat()).good();
                format!("out/{station}-{picture}.png")
            }
            _ => {
                lab.run(&[&words, &["-o", "drawn.png"][..]].concat()).good();
                "drawn.png".to_owned()
            }
        };
        let committed = docs().join("pictures").join(format!("{name}.png"));
        let compared =
            lab.run(&["diff", committed.to_str().unwrap(), &drawn, "--tolerance", "3", "--max-differing", "1"]);
        assert_eq!(
            compared.code,
            0,
            "{name}: `cargo xtask book --pictures` draws it again\n{}{}",
            compared.text(),
            compared.stderr
        );
    });
}
