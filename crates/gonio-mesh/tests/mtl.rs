//! Material libraries: the result of each statement, the values for absent ones, and the messages.
//!
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

fn read(text: &str) -> (Vec<Material>, Vec<String>) {
    let (materials, diagnostics) = mtl::read(text.as_bytes());
    (materials, diagnostics.iter().map(ToString::to_string).collect())
}

/// The only material, read without a message.
fn quiet(statements: &str) -> Material {
    let (mut materials, diagnostics) = read(&format!("newmtl m\n{statements}"));
    assert_eq!((materials.len(), diagnostics.as_slice()), (1, &[] as &[String]), "{statements}");
    without_sources(materials.remove(0))
}

/// Sources and what is not used are held against files of their own.
fn without_sources(material: Material) -> Material {
    assert!(material.sources.len() >= 7);
    Material { sources: Vec::new(), unused: Vec::new(), ..material }
}

/// The only material, and the messages.
fn odd(statements: &str) -> (Material, Vec<String>) {
    let (mut materials, diagnostics) = read(&format!("newmtl m\n{statements}"));
    assert_eq!(materials.len(), 1);
    assert!(!diagnostics.is_empty(), "{statements}");
    (materials.remove(0), diagnostics)
}

#[test]
fn every_number_arrives() {
    let material = quiet("Ka 0.1 0.2 0.3\nKd 0.4 0.5 0.6\nKs .7 8e-1 0.9\nKe 1 2 3\nNs 50\nNi 1.33\nd 0.25\nillum 2\n");
    let expected = Material {
        name: "m".to_owned(),
        ambient: AmbientRule::Value([0.1, 0.2, 0.3]),
        diffuse: [0.4, 0.5, 0.6],
        specular: [0.7, 0.8, 0.9],
        emitted: [1.0, 2.0, 3.0],
        shininess: 50.0,
        refraction_index: 1.33,
        opacity: 0.25,
        illumination_model: Some(2),
        ..Material::default()
    };
    assert_eq!(material, expected);
}

#[test]
fn defaults_are_documented() {
    let material = quiet("");
    assert_eq!((material.ambient, material.diffuse), (AmbientRule::FollowsDiffuse, [0.8; 3]));
    assert_eq!((material.specular, material.emitted, material.shininess), ([0.0; 3], [0.0; 3], 32.0));
    assert_eq!((material.refraction_index, material.opacity, material.illumination_model), (1.5, 1.0, None));
    let mapped = quiet("map_Kd a\nmap_Ks b\nmap_Ke c\nmap_Ns d\n");
    assert_eq!((mapped.diffuse, mapped.specular, mapped.emitted), ([1.0; 3], [1.0; 3], [1.0; 3]));
    assert_eq!(mapped.shininess, 1000.0);
}

#[test]
fn ambient_follows_diffuse_in_files_of_blender() {
    assert_eq!(quiet("Ka 1 1 1\nKd 1 0 0\n").ambient, AmbientRule::FollowsDiffuse);
    assert_eq!(quiet("Ka 0 0 0\n").ambient, AmbientRule::Value([0.0; 3]));
    assert_eq!(quiet("Ka 0.5\n").ambient, AmbientRule::Value([0.5; 3]));
}

#[test]
fn black_beside_a_map_is_white() {
    let (material, messages) = odd("Kd 0 0 0\nmap_Kd a.png\nKs 0 0 0\nmap_Ks b.png\nKe 0 0 0\nmap_Ke c.png\n");
    assert_eq!((material.diffuse, material.specular, material.emitted), ([1.0; 3], [1.0; 3], [1.0; 3]));
    let expected = ["2:1: note: Kd", "4:1: note: Ks", "6:1: note: Ke"];
    assert_eq!(messages.len(), 3);
    for (message, (start, map)) in messages.iter().zip(expected.iter().zip(["map_Kd", "map_Ks", "map_Ke"])) {
        assert_eq!(*message, format!("{start} of \"m\" is black beside {map}: treated as 1 1 1"));
    }
    assert_eq!(quiet("Kd 0 0 0\n").diffuse, [0.0; 3]);
}

#[test]
fn illumination_models_without_highlight() {
    for model in [0, 1] {
        let (material, messages) = odd(&format!("Ks 1 1 1\nmap_Ks s.png\nillum {model}\n"));
        assert_eq!((material.specular, material.specular_map), ([0.0; 3], None));
        let message = messages.last().unwrap();
        assert_eq!(*message, format!("4:1: note: the material \"m\" has illum {model}, which switches its Ks off"));
    }
    assert_eq!(quiet("Ks 1 1 1\nillum 2\n").specular, [1.0; 3]);
    let (material, messages) = odd("illum 11\n");
    assert_eq!(material.illumination_model, None);
    assert_eq!(messages, ["2:7: warning: illum 11 is not an illumination model (0 to 10): it is ignored"]);
}

#[test]
fn shininess_is_at_least_one() {
    assert_eq!(quiet("Ns 0\nKs 0 0 0\n").shininess, 1.0);
    let (material, messages) = odd("Ns 0\nKs 1 1 1\n");
    assert_eq!(material.shininess, 1.0);
    assert_eq!(messages, ["2:1: note: the material \"m\" has Ns 0: using 1, the minimum"]);
}

#[test]
fn opacity_from_d_and_tr() {
    assert_eq!(quiet("Tr 0.25\n").opacity, 0.75);
    assert_eq!(quiet("d 0.75\nTr 0.25\n").opacity, 0.75);
    assert_eq!(quiet("d 3\n").opacity, 1.0);
    for order in ["d 0.75\nTr 0.5\n", "Tr 0.5\nd 0.75\n"] {
        let (material, messages) = odd(order);
        assert_eq!((material.opacity, messages.len()), (0.75, 1));
        assert!(
            messages[0].ends_with("note: d (0.75) and Tr (0.5) of \"m\" contradict each other: using d"),
            "{messages:?}"
        );
    }
    let (material, messages) = odd("Tr 1\n");
    assert_eq!(
        (material.opacity, messages),
        (0.0, vec!["2: note: the material \"m\" is invisible (d 0 or Tr 1)".to_owned()])
    );
    let (material, messages) = odd("d -halo 0.5\n");
    assert_eq!((material.opacity, messages.len()), (0.5, 1));
}

#[test]
fn numbers_that_are_no_use_leave_the_default() {
    let cases = [
        ("Kd -1 0 0\n", "2:4: warning: Kd is negative (\"-1\"): it is ignored"),
        ("Kd 0 nan 0\n", "2:6: warning: Kd has \"nan\", which is not finite: it is ignored"),
        ("Kd 0 1e99 0\n", "2:6: warning: Kd has \"1e99\", which is not finite: it is ignored"),
        ("Kd red\n", "2:4: warning: Kd has \"red\" instead of a number: it is ignored"),
        ("Kd\n", "2:3: warning: Kd ends before its number: it is ignored"),
        ("Kd 1 0\n", "2:7: warning: Kd has 2 numbers instead of 1 or 3: it is ignored"),
        (
            "Kd spectral file.rfl 1\n",
            "2:4: warning: Kd names the spectrum \"file.rfl 1\", which is not read: it is ignored",
        ),
    ];
    for (statement, expected) in cases {
        let (material, messages) = odd(statement);
        assert_eq!((material.diffuse, messages.as_slice()), ([0.8; 3], &[expected.to_owned()][..]), "{statement}");
    }
    assert_eq!(quiet("Ni 0\n").refraction_index, 1.5);
    assert!(quiet("Kd -0 0 0\n").diffuse[0].is_sign_positive());
}

#[test]
fn maps_go_where_they_belong() {
    let text = "map_Kd 1.png\nmap_Ks 2.png\nmap_Ke 3.png\nmap_Ns 4.png\nmap_d 5.png\nmap_Bump 6.png\nnorm 7.png\n";
    let material = quiet(text);
    let maps = [
        material.diffuse_map,
        material.specular_map,
        material.emitted_map,
        material.shininess_map,
        material.opacity_map,
        material.bump_map,
        material.normal_map,
    ];
    for (i, map) in maps.into_iter().enumerate() {
        let expected = TextureMap { line: Some(i as u64 + 2), ..TextureMap::new(format!("{}.png", i + 1)) };
        assert_eq!(map, Some(expected));
    }
    for bump in ["map_bump", "bump", "map_Bump", "MAP_BUMP"] {
        assert_eq!(quiet(&format!("{bump} b.png\n")).bump_map.unwrap().path, "b.png");
    }
}

#[test]
fn options_of_maps() {
    let map = |text: &str| quiet(&format!("map_Bump {text}\n")).bump_map.unwrap();
    let path = |text: &str| map(text).path;
    assert_eq!(path("two words.png"), "two words.png");
    assert_eq!(path("-1.png"), "-1.png");
    assert_eq!(path("a -b.png"), "a -b.png");
    assert_eq!(path("\"quoted name.png\""), "quoted name.png");
    assert_eq!(path("C:\\tex\\a.png"), "C:\\tex\\a.png");
    assert_eq!(path("a.png # bumpy"), "a.png");
    assert_eq!(path("-s 2 3 4 -o 0.5 0.25 0 a b.png"), "a b.png");
    assert_eq!(path("-s 1 1 1 01.png"), "01.png");
    assert_eq!(path("-blendu on -blendv on -cc off -mm 0 1 -t 0 0 0 a.png"), "a.png");
    let full = map("-s 2 3 4 -o 0.5 -0.25 -clamp on -bm 1.5 a.png");
    let expected = TextureMap {
        scale: [2.0, 3.0],
        offset: [0.5, -0.25],
        wrap: [Wrap::Clamp; 2],
        bump_multiplier: 1.5,
        line: Some(2),
        ..TextureMap::new("a.png")
    };
    assert_eq!(full, expected);
    assert_eq!(map("-s 2 a.png").scale, [2.0, 1.0]);
    // Options behind the name.
    let last = map("my bumps.jpg -bm 1.5 -s 2 2");
    assert_eq!((last.path.as_str(), last.bump_multiplier, last.scale), ("my bumps.jpg", 1.5, [2.0, 2.0]));

    let (material, messages) = odd("map_Kd -t 0.1 0.9 a.png\n");
    assert_eq!(material.diffuse_map.unwrap().path, "a.png");
    assert_eq!(messages, ["2:8: note: the texture option -t (once) is not supported"]);
    let (material, messages) = odd("map_Kd -type sphere a.png\n");
    assert_eq!((material.diffuse_map.unwrap().path.as_str(), messages.len()), ("a.png", 1));
    let (material, messages) = odd("map_Kd -fancy a.png\n");
    assert_eq!(material.diffuse_map.unwrap().path, "a.png");
    assert_eq!(messages, ["2:8: warning: map_Kd has the unknown option \"-fancy\": it is skipped"]);
    let (material, messages) = odd("map_Kd -clamp on\n");
    assert_eq!(material.diffuse_map, None);
    assert_eq!(messages, ["2:17: warning: map_Kd names no file: it is ignored"]);
}

#[test]
fn several_materials_and_names() {
    let (materials, messages) =
        read("\u{feff}newmtl  first one \r\nKd 1 0 0\r\n\r\n\tnewmtl second # two\r\n\tKd 0 \\\r\n 1 0");
    assert_eq!(materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["first one", "second"]);
    assert_eq!((materials[0].diffuse, materials[1].diffuse), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    assert!(messages.is_empty(), "{messages:?}");
}

#[test]
fn the_last_of_two_counts() {
    let (materials, messages) = read("newmtl a\nKd 1 0 0\nnewmtl b\nnewmtl a\nKd 0 0 1\n");
    assert_eq!(materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(), ["a", "b"]);
    assert_eq!(materials[0].diffuse, [0.0, 0.0, 1.0]);
    assert_eq!(messages, ["4: warning: the material \"a\" is already defined on line 1: using this one"]);
}

#[test]
fn unused_statements_are_reported_once() {
    let (_, messages) = odd("Ps 0.5\nPc 1\nmap_Ps velvet.png\nTf 0 1 1\nPs 0.4\n");
    assert_eq!(messages, ["3: note: 4 statements without a term in the light equation: Pc, map_Ps, Tf, Ps"]);
    let (_, messages) = odd("shiny yes\n");
    assert_eq!(messages, ["2:1: warning: unknown material statement \"shiny\""]);
}

#[test]
fn a_library_without_materials() {
    assert_eq!(read("# Blender\n").1, ["note: contains no material (newmtl)"]);
    assert_eq!(read("").1, ["note: the material library is empty"]);
    let (materials, messages) = read("Kd 1 1 1\nKs 1 1 1\n");
    assert_eq!(
        (materials.len(), messages),
        (0, vec!["1:1: warning: \"Kd\" before the first newmtl is ignored".to_owned()])
    );
}

#[test]
fn an_exponent_that_gives_the_roughness_stays_as_written() {
    let material = quiet("Ns 250\nPm 0\n");
    assert_eq!(material.shininess, 250.0);
    // (2 / 252)^(1/4)
    let roughness = material.metallic_roughness.unwrap().roughness;
    assert!((roughness - 0.298_475).abs() < 1e-6, "{roughness}");
}

#[test]
fn no_number_of_materials_fills_the_memory() {
    let text: String = (0..70_000).map(|i| format!("newmtl {i}\n")).collect();
    let (materials, messages) = read(&text);
    assert_eq!((materials.len(), messages.len()), (65_536, 21));
    assert_eq!(messages[0], "65537: warning: the library has more than 65536 materials: this one is ignored");
    assert_eq!(messages[20], "warning: and 4444 more: materials beyond the limit");
}

#[test]
fn every_prefix_is_survived() {
    let text = b"newmtl a b\\\n c\nKa 1 1 1\nKd 0.5 -0 1e0\nd -halo 0.5\nTr 1\nillum 2\nmap_Kd -s 1 2 -o 0 0 0 -clamp on -bm 2 a b.png -bm 1\nnorm \"x\"\n";
    let mut found = 0;
    for length in 0..=text.len() {
        found += mtl::read(&text[..length]).0.len();
        let mut changed = text.to_vec();
        if let Some(byte) = changed.get_mut(length) {
            *byte = 0xFF;
            mtl::read(&changed);
        }
    }
    assert!(found > text.len() / 2);
}

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
fn every_file_has_its_expected_result() {
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
