use super::*;

fn set(words: [&str; 6], before: &str, after: &str) -> Vec<String> {
    words.iter().map(|w| format!("{before}{w}{after}")).collect()
}

fn found<S: AsRef<str>>(names: &[S]) -> Assignment {
    assign(names).unwrap_or_else(|e| panic!("{e}"))
}

fn refused<S: AsRef<str>>(names: &[S]) -> String {
    assign(names).err().map(|e| e.message).unwrap_or_default()
}

#[test]
fn every_row_of_the_table_is_recognised_alone_and_in_longer_names() {
    for (convention, words) in TABLE {
        for (before, after) in [
            ("", ".png"),
            ("sky_", ".JPG"),
            ("My Sky-", ".hdr"),
            ("folder.x/day.2k.", ".exr"),
            ("", "_2k.png"),
            ("a_", "_b.png"),
        ] {
            let names = set(*words, before, after);
            let mut shuffled = names.clone();
            shuffled.rotate_left(2);
            shuffled.swap(0, 5);
            let assignment = found(&shuffled);
            assert_eq!(assignment.convention, *convention, "{names:?}");
            for (i, name) in names.iter().enumerate() {
                assert_eq!(&shuffled[assignment.files[i]], name, "{assignment:?}");
            }
        }
    }
}

#[test]
fn words_need_no_separator_at_the_end() {
    for words in [["ft", "bk", "up", "dn", "rt", "lf"], ["Right", "Left", "Top", "Bottom", "Front", "Back"]] {
        let names = set(words, "sky_day01_01", ".png");
        let assignment = found(&names);
        assert_eq!(assignment.files, [0, 1, 2, 3, 4, 5]);
        assert_eq!(assignment.pattern, "sky_day01_01*.png");
    }
}

#[test]
fn ambiguous_words_have_the_documented_meaning() {
    let at = |names: &[&str], name: &str| {
        let files = found(names).files;
        Face::ALL.into_iter().find(|f| names[files[*f as usize]] == name)
    };
    let words = ["back.png", "bottom.png", "front.png", "left.png", "right.png", "top.png"];
    assert_eq!(at(&words, "front.png"), Some(Face::PosZ));
    assert_eq!(at(&words, "right.png"), Some(Face::PosX));
    let quake = ["s_bk.tga", "s_dn.tga", "s_ft.tga", "s_lf.tga", "s_rt.tga", "s_up.tga"];
    assert_eq!(at(&quake, "s_rt.tga"), Some(Face::PosZ));
    assert_eq!(at(&quake, "s_ft.tga"), Some(Face::PosX));
    assert_eq!(at(&quake, "s_lf.tga"), Some(Face::NegZ));
    let numbers = ["0.png", "1.png", "2.png", "3.png", "4.png", "5.png"];
    assert_eq!(at(&numbers, "5.png"), Some(Face::NegZ));
    let from_one = ["1.png", "2.png", "3.png", "4.png", "5.png", "6.png"];
    assert_eq!(at(&from_one, "5.png"), Some(Face::PosZ));
}

/// Quake II's sky box as its source defines it: face by face the axis, where columns and rows run, in a world with Z
/// up. Straight ahead of a player who has not turned is +X, to the right -Y.
#[test]
fn quakes_letters_fit_together_as_its_source_lays_them() {
    // From Quake's world to ours: ahead (+X) is -Z, left (+Y) is -X, up (+Z) is +Y.
    let ours = |q: [f64; 3]| glam::DVec3::new(-q[1], q[2], -q[0]);
    // (letters, middle, columns run to, rows run to): `st_to_vec`, with rows downwards.
    type Axis = [f64; 3];
    let faces: [(&str, Axis, Axis, Axis); 6] = [
        ("rt", [1., 0., 0.], [0., -1., 0.], [0., 0., -1.]),
        ("lf", [-1., 0., 0.], [0., 1., 0.], [0., 0., -1.]),
        ("bk", [0., 1., 0.], [1., 0., 0.], [0., 0., -1.]),
        ("ft", [0., -1., 0.], [-1., 0., 0.], [0., 0., -1.]),
        ("up", [0., 0., 1.], [0., -1., 0.], [1., 0., 0.]),
        ("dn", [0., 0., -1.], [0., -1., 0.], [-1., 0., 0.]),
    ];
    let words = TABLE.iter().find(|(c, _)| *c == NamingScheme::Quake).map(|(_, words)| *words).unwrap_or_default();
    for (letters, middle, columns, rows) in faces {
        let face = face_of(&words, letters).unwrap_or_else(|| panic!("{letters}"));
        let at = |s, t| face.direction(s, t, crate::Layout::Photographic);
        let centre = at(0.0, 0.0);
        assert_eq!(centre, ours(middle), "{letters}");
        assert_eq!(at(1.0, 0.0) - centre, ours(columns), "{letters}");
        assert_eq!(at(0.0, 1.0) - centre, ours(rows), "{letters}");
    }
}

#[test]
fn other_files_in_the_folder_are_reported() {
    let mut names = set(TABLE[0].1, "", ".jpg");
    names.extend(["README.txt".into(), "preview.png".into(), "posx.json".into(), "._posx.jpg".into()]);
    let assignment = found(&names);
    assert_eq!(assignment.pattern, "*.jpg");
    assert_eq!(
        assignment.notes,
        ["1 of the pictures are not among the six (`preview.png`)", "3 files that are not pictures are ignored"]
    );
}

#[test]
fn five_of_six_name_the_sixth() {
    let mut names = set(TABLE[0].1, "Sky-", ".PNG");
    let gone = names.remove(3);
    assert_eq!(refused(&names), format!("5 of six faces found; missing: `negy` (`{gone}`)"));
    let mut quake = set(["FT", "BK", "UP", "DN", "RT", "LF"], "sky01", ".png");
    quake.truncate(5);
    assert_eq!(refused(&quake), "5 of six faces found; missing: `negz` (`sky01LF.png`)");
    // From 1 to 5: whether the first or the last is missing cannot be known; one of both is reported.
    let message = refused(&set(["1", "2", "3", "4", "5", "x"], "", ".png")[..5]);
    assert_eq!(message, "5 of six faces found; missing: `posx` (`0.png`)");
}

#[test]
fn contradictions_are_reported() {
    let mut names = set(TABLE[0].1, "", ".png");
    names.push("POSX.PNG".into());
    assert_eq!(
        refused(&names),
        "`posx.png` and `POSX.PNG` are both the face `posx`; remove one of them, or give a pattern"
    );
    let mixed = ["right.png", "left.png", "top.png", "bottom.png", "posz.png", "negz.png"];
    assert_eq!(
        refused(&mixed),
        "4 of six faces found; missing: `posz` (`front.png`), `negz` (`back.png`); `posz.png` follows another \
         naming scheme, and schemes are not mixed"
    );
    let mut both = set(TABLE[0].1, "", ".png");
    both.extend(set(["right", "left", "top", "bottom", "front", "back"], "", ".png"));
    assert!(
        refused(&both).starts_with("there are 2 sets of faces (of `posx.png`, of `right.png`)"),
        "{}",
        refused(&both)
    );
    let mut two = set(TABLE[0].1, "day_", ".png");
    two.extend(set(TABLE[0].1, "night_", ".png"));
    assert_eq!(
        refused(&two),
        "there are 2 sets of faces (of `day_posx.png`, of `night_posx.png`); choose one by naming one of its files"
    );
    let night = assign_with(&two, "night_negy.png").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((night.files, night.pattern.as_str()), ([6, 7, 8, 9, 10, 11], "night_*.png"));
}

#[test]
fn one_whole_set_beside_leftovers_of_another_ending_is_taken() {
    let mut names = set(TABLE[0].1, "", ".hdr");
    names.push("posx.png".into());
    assert_eq!(found(&names).files, [0, 1, 2, 3, 4, 5]);
    names.extend(set(TABLE[0].1, "", ".png").split_off(1));
    assert!(refused(&names).contains("are both the face"), "{}", refused(&names));
}

#[test]
fn no_set_of_six_lists_the_expected_names() {
    assert!(refused::<&str>(&[]).contains("no picture"), "{}", refused::<&str>(&[]));
    assert!(refused(&["posx.txt"]).contains("no picture"));
    let message = refused(&["bright.png", "photo.jpg"]);
    assert!(message.contains("named like faces (`bright.png`, `photo.jpg`)"), "{message}");
}

#[test]
fn siblings_of_a_name_are_written_as_it_is() {
    assert_eq!(siblings("day/posx.jpg").first(), Some(&set(TABLE[0].1, "day/", ".jpg").try_into().unwrap_or_default()));
    let caps = siblings("SKY_PX.PNG").into_iter().next().unwrap_or_default();
    assert_eq!(caps.to_vec(), set(["PX", "NX", "PY", "NY", "PZ", "NZ"], "SKY_", ".PNG"));
    let words = siblings("skyRight.png").into_iter().next().unwrap_or_default();
    assert_eq!(words.to_vec(), set(["Right", "Left", "Top", "Bottom", "Front", "Back"], "sky", ".png"));
    let separated = siblings("pos-x.png").into_iter().next().unwrap_or_default();
    assert_eq!(separated.to_vec(), set(["pos-x", "neg-x", "pos-y", "neg-y", "pos-z", "neg-z"], "", ".png"));
    assert!(siblings("panorama.hdr").is_empty());
}

#[test]
fn names_of_any_kind_do_no_harm() {
    for name in
        ["", ".", "..", "/", "é+x.png", "+x", "ößposx.png", "posx", "\\px", "-x-x-x.png", "ẞ_0.png", "日本_ft.png"]
    {
        let _ = assign(&[name]);
        siblings(name);
    }
    assert_eq!(siblings("日本_ft.png").first().map(|s| s[4].clone()), Some("日本_rt.png".to_owned()));
}
