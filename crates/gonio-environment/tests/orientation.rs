//! Faces that were mirrored, turned or swapped are found and brought back, bit for bit.

use glam::DVec3;
use gonio_environment::check::{Certificate, FaceFit, check};
use gonio_environment::repair::{FaceSource, Repair};
use gonio_environment::{Builtin, Cubemap, Face, Layout};
use gonio_image::Image;

/// Many lobes of all sizes and colours: every edge has something of its own.
fn rich(d: DVec3) -> DVec3 {
    let wave = |k: DVec3, phase: f64| (k.dot(d) + phase).sin();
    DVec3::new(
        1.2 + wave(DVec3::new(3.0, 1.0, -2.0), 0.3) * wave(DVec3::new(-1.0, 7.0, 4.0), 1.0),
        1.2 + wave(DVec3::new(2.0, -4.0, 1.5), 2.0) * wave(DVec3::new(9.0, 2.0, -3.0), 0.0),
        1.2 + wave(DVec3::new(1.0, 2.5, 5.0), 4.0) * wave(DVec3::new(-2.0, 6.0, 8.0), 0.7),
    )
}

fn faces_of(map: &Cubemap) -> [Image; 6] {
    map.faces(Layout::Photographic)
}

fn rich_faces() -> [Image; 6] {
    faces_of(&Cubemap::from_function(64, rich))
}

fn builtin(kind: Builtin) -> [Image; 6] {
    faces_of(&kind.cubemap(96, Layout::Photographic).unwrap_or_else(|e| panic!("{e}")))
}

fn certified(faces: &[Image; 6]) -> Certificate {
    check(faces, Layout::Photographic).unwrap_or_else(|e| panic!("{e}"))
}

/// Files in which a face's picture is another's, mirrored and turned.
fn spoilt(faces: &[Image; 6], changes: &[(usize, usize, bool, u8)]) -> [Image; 6] {
    let mut spoil = Repair::nothing();
    for &(to, from, mirrored, quarter_turns) in changes {
        spoil.faces[to] = FaceSource { file: Face::ALL[from], mirrored, quarter_turns };
    }
    spoil.apply(faces)
}

/// The seven ways in which one face can lie wrongly.
fn ways() -> impl Iterator<Item = (bool, u8)> {
    (1..8).map(|i| (i >= 4, i % 4))
}

fn assert_repaired(name: &str, faces: &[Image; 6], changes: &[(usize, usize, bool, u8)]) {
    let spoilt = spoilt(faces, changes);
    let found = certified(&spoilt);
    assert_eq!(found.fit, FaceFit::Misplaced, "{name} {changes:?}: {:?}", found.sentences());
    assert!(found.repair.apply(&spoilt) == *faces, "{name} {changes:?}: {:?}", found.sentences());
    assert!(found.margin > 1.15, "{name} {changes:?}: {}", found.margin);
}

#[test]
fn correct_faces_are_not_repaired() {
    for (name, faces) in [("rich", rich_faces()), ("room", builtin(Builtin::Room)), ("sky", builtin(Builtin::Sky))] {
        let found = certified(&faces);
        assert_eq!((found.fit, found.repair), (FaceFit::Fits, Repair::nothing()), "{name}: {:?}", found.sentences());
        assert!(found.edges.iter().all(|e| e.meets), "{name}: {:?}", found.edges);
        // Of the sky only the plain ground could lie otherwise.
        let undecided: &[Face] = if name == "sky" { &[Face::NegY] } else { &[] };
        assert_eq!(found.undecided, undecided, "{name}");
        assert!(found.margin > 1.15, "{name}: {}", found.margin);
        // Across an edge it changes as much as beside it. (Edges of the cube are seen at a slant: texels there are
        // narrower, seen from the middle, so less; the room has outlines of things that cross.)
        let mean = found.edges.iter().map(|e| e.ratio()).sum::<f64>() / 12.0;
        assert!((0.5..1.5).contains(&mean), "{name}: {mean}");
    }
}

#[test]
fn every_turned_or_mirrored_face_is_found() {
    for (name, faces) in [("rich", rich_faces()), ("room", builtin(Builtin::Room)), ("sky", builtin(Builtin::Sky))] {
        for face in 0..6 {
            for (mirrored, turns) in ways() {
                if name == "sky" && Face::ALL[face] == Face::NegY {
                    // Plain ground: nothing to compare, which is reported.
                    let found = certified(&spoilt(&faces, &[(face, face, mirrored, turns)]));
                    assert_eq!((found.fit, found.undecided), (FaceFit::Fits, vec![Face::NegY]));
                    continue;
                }
                assert_repaired(name, &faces, &[(face, face, mirrored, turns)]);
            }
        }
    }
}

#[test]
fn every_swap_is_found_and_turns_besides() {
    for (name, faces) in [("rich", rich_faces()), ("room", builtin(Builtin::Room)), ("sky", builtin(Builtin::Sky))] {
        for a in 0..6 {
            for b in a + 1..6 {
                if name == "sky" && (a == 3 || b == 3) {
                    // Found too, but the ground may come back in any turn: only its place is sure.
                    let found = certified(&spoilt(&faces, &[(a, b, false, 0), (b, a, false, 0)]));
                    assert_eq!(found.repair.faces[a].file, Face::ALL[b], "{:?}", found.sentences());
                    continue;
                }
                assert_repaired(name, &faces, &[(a, b, false, 0), (b, a, false, 0)]);
                assert_repaired(name, &faces, &[(a, b, false, 3), (b, a, false, 0)]);
            }
        }
    }
    // In sentences.
    let faces = rich_faces();
    let spoilt_faces = spoilt(&faces, &[(0, 1, false, 0), (1, 0, false, 0), (3, 3, false, 1)]);
    let sentences = certified(&spoilt_faces).sentences();
    assert_eq!(sentences[..2], ["`posx` and `negx` are swapped", "`negy` is turned by 90 degrees clockwise"]);
}

#[test]
fn worlds_that_are_the_same_but_turned_are_named() {
    // Swapping both X and turning the bottom by half a turn is, but for half a turn of the world, swapping both Z and
    // turning the top.
    let faces = rich_faces();
    let spoilt = spoilt(&faces, &[(0, 1, false, 0), (1, 0, false, 0), (3, 3, false, 2)]);
    let found = certified(&spoilt);
    let repairs: Vec<Repair> = std::iter::once(found.repair).chain(found.alternatives.iter().copied()).collect();
    assert_eq!(repairs.len(), 3, "{:?}", found.sentences());
    assert_eq!(repairs.iter().filter(|r| r.apply(&spoilt) == faces).count(), 1, "{:?}", found.sentences());
    // What they leave fits, each of them.
    for repair in repairs {
        assert_eq!(certified(&repair.apply(&spoilt)).fit, FaceFit::Fits);
    }
}

#[test]
fn conventions_of_other_programs_are_found() {
    for (name, faces) in [("rich", rich_faces()), ("room", builtin(Builtin::Room))] {
        // Quake's top and bottom lie a quarter turned.
        assert_repaired(name, &faces, &[(2, 2, false, 1), (3, 3, false, 3)]);
        assert_repaired(name, &faces, &[(2, 2, false, 3), (3, 3, false, 3)]);
        // Three faces in a round.
        assert_repaired(name, &faces, &[(0, 4, false, 0), (4, 1, false, 0), (1, 0, false, 0)]);
    }
}

#[test]
fn six_mirrored_faces_are_a_swap_of_the_mirrored_world() {
    for faces in [rich_faces(), builtin(Builtin::Room)] {
        let all: Vec<_> = (0..6).map(|f| (f, f, true, 0)).collect();
        let mirrored = spoilt(&faces, &all);
        let found = certified(&mirrored);
        // Two faces swapped explain the edges as well, and are fewer; that leaves the world mirrored, and the other way
        // is named too.
        assert_eq!(found.fit, FaceFit::Misplaced);
        assert_eq!(found.repair.changed().len(), 2, "{:?}", found.sentences());
        let other = found.alternatives.last().copied().unwrap_or(Repair::nothing());
        assert!(other.apply(&mirrored) == faces, "{:?}", found.sentences());
        assert!(found.sentences().iter().any(|s| s.contains("all six faces are mirrored")), "{:?}", found.sentences());
    }
}

#[test]
fn the_layouts_have_the_same_edges() {
    let map = Cubemap::from_function(64, rich);
    for layout in [Layout::OpenGl, Layout::Photographic] {
        for stated in [Layout::OpenGl, Layout::Photographic] {
            let found = check(&map.faces(layout), stated).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!((found.fit, found.layout), (FaceFit::Fits, stated));
            let is_open = found.sentences().iter().any(|s| s.contains("do not show whether the layout"));
            assert!(is_open, "{:?}", found.sentences());
        }
    }
}

/// A number that looks random, from -1 to 1.
fn noise(seed: u32) -> f32 {
    let mut x = seed.wrapping_mul(0x9E37_79B9) ^ 0x85EB_CA6B;
    x = (x ^ (x >> 15)).wrapping_mul(0x2C1B_3C6D);
    x = (x ^ (x >> 12)).wrapping_mul(0x297A_2D39);
    (x ^ (x >> 15)) as f32 / u32::MAX as f32 * 2.0 - 1.0
}

/// As a camera and JPEG leave it: grain, blocks of 8 x 8 whose mean is off by a little, and 8 bits.
fn photographed(faces: &[Image; 6]) -> [Image; 6] {
    let mut faces = faces.clone();
    for (index, face) in faces.iter_mut().enumerate() {
        let width = face.width;
        for (at, pixel) in face.pixels.iter_mut().enumerate() {
            let at = at as u32 + index as u32 * 100_000;
            let block = (at / width / 8) * 1000 + at % width / 8 + index as u32 * 77_777;
            for (channel, value) in pixel.iter_mut().take(3).enumerate() {
                let channel = channel as u32 * 999_983;
                let encoded = (0.5 * *value).clamp(0.0, 1.0).powf(1.0 / 2.2);
                let spoilt = encoded + 0.012 * noise(at + channel) + 0.012 * noise(block + channel);
                *value = 2.0 * ((spoilt.clamp(0.0, 1.0) * 255.0).round() / 255.0).powf(2.2);
            }
        }
    }
    faces
}

#[test]
fn grain_and_compression_do_not_mislead() {
    for (name, faces) in [("rich", photographed(&rich_faces())), ("room", photographed(&builtin(Builtin::Room)))] {
        let found = certified(&faces);
        assert_eq!(found.fit, FaceFit::Fits, "{name}: {:?}", found.sentences());
        for face in 0..6 {
            for (mirrored, turns) in ways() {
                assert_repaired(name, &faces, &[(face, face, mirrored, turns)]);
            }
            assert_repaired(name, &faces, &[(face, (face + 1) % 6, false, 0), ((face + 1) % 6, face, false, 1)]);
        }
    }
}

#[test]
fn plain_pictures_are_not_judged() {
    for plain in [
        faces_of(&Cubemap::new(32, [0.5, 0.5, 0.5, 1.0])),
        faces_of(&Cubemap::new(1, [0.5, 0.5, 0.5, 1.0])),
        faces_of(&Cubemap::new(8, [f32::NAN, f32::INFINITY, -1.0, 1.0])),
    ] {
        let found = certified(&plain);
        assert_eq!((found.fit, found.repair), (FaceFit::TooPlain, Repair::nothing()));
        assert_eq!(found.undecided.len(), 6);
    }
    // The debug cubemap has a border of one colour around each face: that can be told from nothing, and fits nothing.
    for size in [32, 64, 96, 256] {
        for layout in [Layout::OpenGl, Layout::Photographic] {
            let debug = Builtin::Debug.cubemap(size, layout).unwrap_or_else(|e| panic!("{e}"));
            let found = certified(&faces_of(&debug));
            assert!(matches!(found.fit, FaceFit::NeverMeets | FaceFit::TooPlain), "{size}: {:?}", found.sentences());
            assert_eq!(found.repair, Repair::nothing());
        }
    }
    // Six faces of six worlds.
    let mut strangers = rich_faces();
    for (face, image) in strangers.iter_mut().enumerate() {
        let turn = glam::DQuat::from_rotation_y(face as f64) * glam::DQuat::from_rotation_x(1.7 * face as f64);
        *image = faces_of(&Cubemap::from_function(64, |d| rich(turn * d)))[face].clone();
    }
    let found = certified(&strangers);
    assert_eq!((found.fit, found.repair), (FaceFit::NeverMeets, Repair::nothing()), "{:?}", found.sentences());
    let mut uneven = rich_faces();
    uneven[2] = Image::new(3, 3, [0.0; 4]);
    assert!(check(&uneven, Layout::OpenGl).is_err());
}

#[test]
fn one_painted_over_face_does_not_hide_the_rest() {
    // As where a tripod was replaced by a sign.
    let mut faces = rich_faces();
    faces[3] = Image::new(64, 64, [0.9, 0.02, 0.02, 1.0]);
    let found = certified(&faces);
    assert_eq!((found.fit, found.undecided.as_slice()), (FaceFit::Fits, &[Face::NegY][..]), "{:?}", found.sentences());
    assert_eq!(found.sentences().iter().filter(|s| s.contains("is visible: it differs")).count(), 4);
    let spoilt = spoilt(&faces, &[(1, 1, true, 2), (4, 0, false, 0), (0, 4, false, 0)]);
    let found = certified(&spoilt);
    assert!(found.repair.apply(&spoilt) == faces, "{:?}", found.sentences());
}
