//! Material libraries with one statement or oddity each, and what the reader must make of them: the table `mtl.txt`. The
//! expectations were written by hand: each value, the line that it came from and by which rule, what is not used, and every
//! diagnostic.
//!
//! `PROPERTY = VALUE | LINE: STATEMENT | RULE`. Values without a line are only listed for files called `absent...`; `~` marks
//! numbers that are rounded to four places.

#![allow(clippy::unwrap_used, missing_docs)]

use gonio_fixtures::{ExpectedCase, FixtureTable, assert_as_expected};
use gonio_mesh::{AmbientRule, Material, PropertySource, TexelRule, TextureMap, Wrap, mtl};
use std::fmt::Write as _;

fn cases() -> Vec<ExpectedCase> {
    let table = FixtureTable::read(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mtl.txt"));
    let cases = table.and_then(|table| table.expected_cases("mtl")).unwrap_or_else(|error| panic!("{error}"));
    assert!(cases.len() >= 80, "only {} cases", cases.len());
    cases
}

fn files() -> Vec<(String, Vec<u8>)> {
    cases().into_iter().map(|case| (case.name, case.bytes)).collect()
}

fn color(color: [f32; 3]) -> String {
    color.map(|c| c.to_string()).join(" ")
}

fn texture(map: &TextureMap) -> String {
    let mut text = map.path.clone();
    if map.scale != [1.0; 2] {
        write!(text, " scale {} {}", map.scale[0], map.scale[1]).unwrap();
    }
    if map.offset != [0.0; 2] {
        write!(text, " offset {} {}", map.offset[0], map.offset[1]).unwrap();
    }
    if map.wrap != [Wrap::Repeat; 2] {
        let [u, v] = map.wrap.map(|wrap| format!("{wrap:?}").to_lowercase());
        write!(text, " {u} {v}").unwrap();
    }
    if let Some(channel) = map.texel.channel {
        write!(text, " channel {}", format!("{channel:?}").to_lowercase()).unwrap();
    }
    if (TexelRule { channel: None, ..map.texel }) != TexelRule::default() {
        write!(text, " base {} gain {}", map.texel.base, map.texel.gain).unwrap();
    }
    if map.bump_multiplier != 1.0 {
        write!(text, " bump {}", map.bump_multiplier).unwrap();
    }
    assert!(map.embedded.is_none() && map.rotation == 0.0 && map.texel.cutoff.is_none() && map.line.is_some());
    text
}

fn value(material: &Material, property: &str) -> String {
    let map = |map: &Option<TextureMap>| texture(map.as_ref().unwrap());
    let physical = || material.metallic_roughness.as_ref().unwrap();
    match property {
        "ambient" => match material.ambient {
            AmbientRule::FollowsDiffuse => "follows diffuse".to_owned(),
            AmbientRule::Value(value) => color(value),
        },
        "diffuse" => color(material.diffuse),
        "specular" => color(material.specular),
        "emitted" => color(material.emitted),
        "shininess" => material.shininess.to_string(),
        "refraction_index" => material.refraction_index.to_string(),
        "opacity" => material.opacity.to_string(),
        "illumination_model" => material.illumination_model.unwrap().to_string(),
        "diffuse_map" => map(&material.diffuse_map),
        "specular_map" => map(&material.specular_map),
        "emitted_map" => map(&material.emitted_map),
        "shininess_map" => map(&material.shininess_map),
        "opacity_map" => map(&material.opacity_map),
        "normal_map" => map(&material.normal_map),
        "bump_map" => map(&material.bump_map),
        "metallic_roughness.metallic" => physical().metallic.to_string(),
        "metallic_roughness.roughness" => physical().roughness.to_string(),
        "metallic_roughness.metallic_map" => map(&physical().metallic_map),
        "metallic_roughness.roughness_map" => map(&physical().roughness_map),
        other => panic!("{other} is no property of a material"),
    }
}

fn source(source: &PropertySource) -> String {
    let mut text = match source.line {
        Some(line) => format!(" | {line}: {}", source.written),
        None => " | -".to_owned(),
    };
    if !source.rule.is_empty() {
        write!(text, " | {}", source.rule).unwrap();
    }
    text
}

fn summary(name: &str, bytes: &[u8]) -> String {
    let (materials, diagnostics) = mtl::read(bytes);
    let mut text = String::new();
    for material in &materials {
        writeln!(text, "material {:?}", material.name).unwrap();
        for from in &material.sources {
            if from.line.is_none() && !name.starts_with("absent") {
                continue;
            }
            let property = from.property;
            let value = value(material, property);
            let is_rounded = from.rule.contains("XYZ");
            if is_rounded {
                let numbers = value.split(' ').map(|n| format!("{:.4}", n.parse::<f32>().unwrap()));
                let numbers = numbers.collect::<Vec<_>>().join(" ");
                writeln!(text, "{property} ~ {numbers}{}", source(from)).unwrap();
            } else {
                writeln!(text, "{property} = {value}{}", source(from)).unwrap();
            }
        }
        for unused in &material.unused {
            writeln!(text, "unused {}{}", unused.property, source(unused)).unwrap();
        }
    }
    for diagnostic in &diagnostics {
        writeln!(text, "{diagnostic}").unwrap();
    }
    text
}

#[test]
fn every_file_gives_what_is_expected() {
    assert_as_expected(cases(), |case| summary(&case.name, &case.bytes));
}

#[test]
fn names_tell_which_files_give_warnings() {
    for case in cases() {
        assert_eq!(case.expected.contains("warning:"), case.name.starts_with("warn_"), "{}", case.name);
    }
}

/// Each value is accounted for once, in the order of the material's fields.
#[test]
fn every_value_has_its_source() {
    const ALWAYS: [&str; 7] = ["ambient", "diffuse", "specular", "emitted", "shininess", "refraction_index", "opacity"];
    let mut materials = 0;
    for (name, bytes) in files() {
        for material in mtl::read(&bytes).0 {
            let properties: Vec<&str> = material.sources.iter().map(|s| s.property).collect();
            assert_eq!(properties[..7], ALWAYS, "{name}");
            let maps = [
                ("diffuse_map", material.diffuse_map.is_some()),
                ("specular_map", material.specular_map.is_some()),
                ("emitted_map", material.emitted_map.is_some()),
                ("shininess_map", material.shininess_map.is_some()),
                ("opacity_map", material.opacity_map.is_some()),
                ("normal_map", material.normal_map.is_some()),
                ("bump_map", material.bump_map.is_some()),
            ];
            let has_model = material.illumination_model.is_some();
            let expected = [("illumination_model", has_model)].into_iter().chain(maps);
            let expected: Vec<&str> = expected.filter(|(_, is)| *is).map(|(property, _)| property).collect();
            let physical = properties.iter().position(|p| p.starts_with("metallic")).unwrap_or(properties.len());
            assert_eq!(properties[7..physical], expected, "{name}");
            assert_eq!(physical < properties.len(), material.metallic_roughness.is_some(), "{name}");
            for from in material.sources.iter().chain(&material.unused) {
                assert_eq!(from.line.is_none(), from.written.is_empty(), "{name}: {from:?}");
                assert!(from.line.is_some() || !from.rule.is_empty(), "{name}: {from:?}");
            }
            materials += 1;
        }
    }
    assert!(materials > 80, "{materials}");
}

/// No prefix and no changed byte makes a panic, or a number that is no use.
#[test]
fn every_prefix_and_every_changed_byte_is_survived() {
    let mut tried = 0;
    for (_, bytes) in files() {
        for at in 0..=bytes.len() {
            check(&bytes[..at]);
            for byte in *b"\n\\#-9 \0\xFF" {
                let mut changed = bytes.clone();
                if let Some(place) = changed.get_mut(at) {
                    *place = byte;
                    check(&changed);
                    tried += 1;
                }
            }
        }
    }
    assert!(tried > 10_000, "{tried}");
}

fn check(bytes: &[u8]) {
    for material in mtl::read(bytes).0 {
        let colors = [material.diffuse, material.specular, material.emitted];
        assert!(colors.as_flattened().iter().all(|c| c.is_finite() && *c >= 0.0), "{material:?}");
        assert!(material.shininess.is_finite() && material.shininess >= 1.0, "{material:?}");
        assert!((0.0..=1.0).contains(&material.opacity) && material.refraction_index > 0.0, "{material:?}");
    }
}
