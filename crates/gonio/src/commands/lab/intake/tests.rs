#![allow(clippy::unwrap_used)]
use super::*;
use std::io::Write;
use tempfile::TempDir;

const VERTEX: &str = "#version 330 core\nin vec3 p;\nvoid main() { gl_Position = vec4(p, 1.0); }\n";
const FRAGMENT: &str = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n";

fn exercise() -> &'static Exercise {
    gonio_exercises::exercise::find("ex04").unwrap()
}

/// A folder with files; names may have folders.
fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }
    folder
}

/// A zip of uncompressed files.
fn zip_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut zip, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut common = [20, 0, 0, 0, 0, 0].to_vec();
        common.extend([0; 8]);
        common.extend((content.len() as u32).to_le_bytes());
        common.extend((content.len() as u32).to_le_bytes());
        common.extend((name.len() as u16).to_le_bytes());
        let local = zip.len() as u32;
        zip.write_all(b"PK\x03\x04").unwrap();
        zip.extend(&common);
        zip.extend([0, 0]);
        zip.extend(name.as_bytes());
        zip.extend(*content);
        directory.write_all(b"PK\x01\x02\x14\x00").unwrap();
        directory.extend(&common);
        directory.extend([0; 12]);
        directory.extend(local.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let at = zip.len() as u32;
    let (size, count) = (directory.len() as u32, (files.len() as u16).to_le_bytes());
    zip.extend(directory);
    zip.extend(b"PK\x05\x06\0\0\0\0");
    zip.extend([count, count].concat());
    zip.extend(size.to_le_bytes());
    zip.extend(at.to_le_bytes());
    zip.extend([0, 0]);
    zip
}

fn pair(prefix: &str) -> [(String, &'static [u8]); 2] {
    [(format!("{prefix}a.vert"), VERTEX.as_bytes()), (format!("{prefix}a.frag"), FRAGMENT.as_bytes())]
}

fn zipped_pair(prefix: &str) -> Vec<u8> {
    let files = pair(prefix);
    zip_of(&files.iter().map(|(name, content)| (name.as_str(), *content)).collect::<Vec<_>>())
}

fn class_at(path: &Path) -> ClassSubmissions {
    match take(&[path.to_owned()], exercise(), Submissions::Auto, false).unwrap() {
        Intake::Class(class) => class,
        Intake::One(one) => panic!("one submission: {one:?}"),
    }
}

fn one_at(path: &Path) -> GatheredFiles {
    match take(&[path.to_owned()], exercise(), Submissions::Auto, false).unwrap() {
        Intake::One(one) => one,
        Intake::Class(class) => panic!("{} submissions", class.submissions.len()),
    }
}

fn names(gathered: &GatheredFiles) -> Vec<&str> {
    gathered.files.iter().map(|file| file.name.as_str()).collect()
}

#[test]
fn a_submission_is_never_a_class() {
    let zip = zipped_pair("work/");
    for (files, expected) in [
        (&[("shaders/a.vert", VERTEX.as_bytes()), ("shaders/a.frag", FRAGMENT.as_bytes())][..], "shaders/a.frag"),
        (&[("work.zip", &zip)], "work.zip/work/a.frag"),
        (&[("deep/down/work.zip", &zip)], "deep/down/work.zip/work/a.frag"),
        (
            &[("README.md", b"x"), ("vertex/a.vert", VERTEX.as_bytes()), ("fragment/a.frag", FRAGMENT.as_bytes())],
            "README.md",
        ),
    ] {
        let folder = folder(files);
        let one = one_at(folder.path());
        assert_eq!(names(&one)[0], expected);
        assert_eq!(one.left_out, [""; 0]);
    }
}

#[test]
fn a_class_is_found_in_folders_in_a_zip_and_in_a_flat_download() {
    let zip = zipped_pair("");
    let files: &[(&str, &[u8])] = &[
        ("class/anna/shaders/a.vert", VERTEX.as_bytes()),
        ("class/anna/shaders/a.frag", FRAGMENT.as_bytes()),
        ("class/ben/ben.zip", &zip),
        ("class/cyd.zip", &zip),
        ("class/list.txt", b"anna, ben, cyd"),
    ];
    let flat: &[(&str, &[u8])] = &[
        ("Anna_1_assignsubmission_file_a.vert", VERTEX.as_bytes()),
        ("Anna_1_assignsubmission_file_a.frag", FRAGMENT.as_bytes()),
        ("Ben Roe_2_assignsubmission_file_ben.zip", &zip),
    ];
    let in_folders = folder(files);
    let in_a_zip = folder(&[("class.zip", &zip_of(files))]);
    let side_by_side = folder(flat);
    let labels = |class: &ClassSubmissions| class.submissions.iter().map(|one| one.label.clone()).collect::<Vec<_>>();
    for place in [in_folders.path().join("class"), in_folders.path().to_owned(), in_a_zip.path().join("class.zip")] {
        let class = class_at(&place);
        assert_eq!(labels(&class), ["anna", "ben", "cyd"], "{place:?}");
        assert_eq!(class.skipped, ["list.txt (it contains no answer)"]);
        assert_eq!(names(&class.submissions[1].gather()), ["ben.zip/a.frag", "ben.zip/a.vert"]);
    }
    let class = class_at(side_by_side.path());
    assert_eq!(labels(&class), ["Anna_1", "Ben Roe_2"]);
    assert_eq!(names(&class.submissions[0].gather()), ["a.frag", "a.vert"]);
    assert_eq!(names(&class.submissions[1].gather()), ["a.frag", "a.vert"]);
}

#[test]
fn several_arguments_are_a_class_where_a_folder_of_them_would_be() {
    let (anna, ben) = (pair("anna/"), pair("ben/"));
    let files: Vec<(&str, &[u8])> = anna.iter().chain(&ben).map(|(name, content)| (name.as_str(), *content)).collect();
    let folder = folder(&files);
    let paths = ["anna", "ben"].map(|name| folder.path().join(name));
    assert!(
        matches!(take(&paths, exercise(), Submissions::Auto, false), Ok(Intake::Class(class)) if class.submissions.len() == 2)
    );
    assert!(matches!(take(&paths, exercise(), Submissions::One, false), Ok(Intake::One(one)) if one.files.len() == 4));
    let only = std::slice::from_ref(&paths[0]);
    assert!(
        matches!(take(only, exercise(), Submissions::Many, true), Ok(Intake::Class(class)) if class.submissions.len() == 1)
    );
}

#[test]
fn one_submission_as_a_class_keeps_its_folders_together_and_its_students_name() {
    let pairs = ["class/anna/work/ex03/", "class/anna/work/ex04/"].map(pair);
    let files: Vec<(&str, &[u8])> = pairs.iter().flatten().map(|(name, content)| (name.as_str(), *content)).collect();
    let folder = folder(&files);
    let found = |asked| match take(&[folder.path().join("class")], exercise(), asked, true).unwrap() {
        Intake::Class(class) => {
            class.submissions.iter().map(|one| (one.label.clone(), one.gather().files.len())).collect::<Vec<_>>()
        }
        Intake::One(one) => panic!("{one:?}"),
    };
    assert_eq!(found(Submissions::Auto), [("anna".to_owned(), 4)]);
    assert_eq!(found(Submissions::One), [("class".to_owned(), 4)]);
    assert_eq!(found(Submissions::Many), [("ex03".to_owned(), 2), ("ex04".to_owned(), 2)]);
}

#[test]
fn what_is_not_read_is_said_and_small_files_go_first() {
    let folder = folder(&[("a.vert", VERTEX.as_bytes()), ("b.zip", b"PK\x03\x04 and no more")]);
    let sparse = |name: &str, size: u64| {
        std::fs::File::create(folder.path().join(name)).unwrap().set_len(size).unwrap();
    };
    sparse("huge.bin", 3 << 30);
    sparse("huge.zip", 3 << 30);
    for number in 0..5 {
        sparse(&format!("large{number}.bin"), 31 << 20);
    }
    let one = one_at(folder.path());
    assert_eq!(names(&one).first(), Some(&"a.vert"));
    assert!(one.files.iter().map(|file| file.bytes.len()).sum::<usize>() <= 128 << 20);
    let said = one.left_out.join("\n");
    for piece in ["b.zip: the zip file is truncated", "huge.zip: the zip file is truncated", "the 2 largest files"] {
        assert!(said.contains(piece), "{piece}: {said}");
    }
}

#[test]
fn an_archive_that_unpacks_to_more_than_it_says_or_than_is_read_is_left_aside() {
    let mut bomb = zip_of(&[("a.vert", VERTEX.as_bytes()), ("bomb.frag", &vec![b' '; 40 << 20])]);
    let folder = folder(&[("work.zip", &bomb)]);
    let one = one_at(&folder.path().join("work.zip"));
    assert_eq!(names(&one), ["a.vert"]);
    assert!(one.left_out[0].contains("larger than 32 MiB"), "{:?}", one.left_out);
    // The directory states one byte less.
    let at = bomb.windows(4).rposition(|w| w == b"PK\x01\x02").unwrap();
    bomb[at + 24..at + 28].copy_from_slice(&10_u32.to_le_bytes());
    std::fs::write(folder.path().join("work.zip"), &bomb).unwrap();
    let one = one_at(&folder.path().join("work.zip"));
    assert!(one.left_out[0].contains("its size differs"), "{:?}", one.left_out);
}

#[test]
fn archives_in_archives_end_somewhere() {
    let mut zip = zipped_pair("");
    for depth in 0..6 {
        zip = zip_of(&[(&format!("{depth}.zip"), &zip)]);
    }
    let folder = folder(&[("deep.zip", &zip), ("b.vert", VERTEX.as_bytes())]);
    let one = one_at(folder.path());
    assert_eq!(names(&one), ["b.vert"]);
    assert!(one.left_out[0].contains("more than 3 archives"), "{:?}", one.left_out);
}

#[cfg(unix)]
#[test]
fn links_pipes_and_devices_are_named_and_not_opened() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder(&[("anna/a.vert", VERTEX.as_bytes()), ("ben/a.vert", VERTEX.as_bytes())]);
    let at = |name: &str| folder.path().join(name);
    std::os::unix::fs::symlink("..", at("anna/loop")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", at("anna/zero.frag")).unwrap();
    std::os::unix::fs::symlink("/", at("root")).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(at("ben/pipe.frag")).status().unwrap().success());
    // Two names that differ in a byte that is not UTF-8.
    for byte in [0xfe, 0xff] {
        let name = [b"cyd".as_slice(), &[byte]].concat();
        std::fs::create_dir(folder.path().join(std::ffi::OsStr::from_bytes(&name))).unwrap();
    }
    let class = class_at(folder.path());
    let labels: Vec<&str> = class.submissions.iter().map(|one| one.label.as_str()).collect();
    assert_eq!(labels, ["anna", "ben", "cyd\\xfe", "cyd\\xff"]);
    assert_eq!(class.skipped, ["root (it is a link, and links are not followed)"]);
    let (anna, ben) = (class.submissions[0].gather(), class.submissions[1].gather());
    assert_eq!((names(&anna), names(&ben)), (vec!["a.vert"], vec!["a.vert"]));
    assert_eq!((anna.left_out.len(), ben.left_out.len()), (2, 1));
    assert!(ben.left_out[0].contains("a pipe or a device"), "{:?}", ben.left_out);
    let device = take(&["/dev/zero".into()], exercise(), Submissions::Auto, false);
    assert!(device.is_err_and(|error| error.to_string().contains("it is a device")));
}
