use super::*;

/// Entries by their names: `anna/` a folder with an answer, `docs/-` one without, `a.vert` an answer, `a.txt` none.
fn entries(names: &[&str]) -> Vec<Entry> {
    let entry = |name: &&str| {
        let folder = name.strip_suffix('-').unwrap_or(name).strip_suffix('/');
        Entry { name: folder.unwrap_or(name).to_owned(), is_container: folder.is_some() || name.ends_with(".zip") }
    };
    names.iter().map(entry).collect()
}

fn is_answer(name: &str) -> bool {
    ["/", ".zip", ".vert", ".frag", ".cpp", ".glsl"].iter().any(|end| name.ends_with(end))
}

fn layout_of(names: &[&str]) -> Layout {
    layout(&entries(names), &|at| is_answer(names[at]))
}

fn many(names: &[&str]) -> Many {
    match layout_of(names) {
        Layout::Many(many) => many,
        other => panic!("{names:?} is {other:?}"),
    }
}

fn labels(names: &[&str]) -> Vec<String> {
    many(names).submissions.into_iter().map(|group| group.label).collect()
}

fn skipped(names: &[&str]) -> Vec<String> {
    many(names).skipped.iter().map(|(at, _)| names[*at].to_owned()).collect()
}

#[test]
fn one_students_files_are_one_submission() {
    for names in [
        &["a.vert", "a.frag"][..],
        &["main.cpp", "shaders/", "glfw/-"],
        &["main.cpp", "README.md", "ex03/", "ex04/", "ex07/"],
        &["README.md", "ex03/", "ex04/", "ex07/"],
        &["CMakeLists.txt", "src/", "include/-", "shaders/", "third-party/-", "build/"],
        &["vertex/", "fragment/"],
        &["Lab 3/", "glm/-", "glfw-3.3.8/-"],
        &["anna-opengl/", "glad/-", "stb/-"],
        &["list.txt"],
        &[],
        &["a.vert", "old.zip"],
        // Neither holds a whole answer.
        &["upper/-", "lower/-"],
    ] {
        assert_eq!(layout_of(names), Layout::One, "{names:?}");
    }
}

#[test]
fn a_single_folder_or_archive_is_looked_into() {
    for (names, at) in [
        (&["anna/"][..], 0),
        (&["anna.zip"], 0),
        (&["list.txt", "class.zip"], 1),
        (&["__MACOSX/", "shaders/"], 1),
        (&["shaders/-"], 0),
    ] {
        assert_eq!(layout_of(names), Layout::Within(at), "{names:?}");
    }
}

#[test]
fn a_folder_for_each_student_is_a_class_whatever_lies_beside() {
    assert_eq!(labels(&["anna/", "ben/"]), ["anna", "ben"]);
    assert_eq!(labels(&["anna/", "ben.zip", "cyd/-", "dan/-"]), ["anna", "ben", "cyd", "dan"]);
    let names = ["anna/", "ben/", "list.txt", ".DS_Store", "__MACOSX/", "solution.vert", "_dan/", ".eve/"];
    assert_eq!(labels(&names), [".eve", "_dan", "anna", "ben"]);
    assert_eq!(skipped(&names), ["list.txt", ".DS_Store", "__MACOSX/", "solution.vert"]);
    // Numbers of students are names, not parts of a project.
    assert_eq!(labels(&["1203344/", "1203345/"]), ["1203344", "1203345"]);
    assert_eq!(labels(&["anna/-", "ben/-", "cyd/-", "dan/-"]).len(), 4);
    // A student who is called like a part of a project, among others.
    assert_eq!(labels(&["anna/", "ben/", "lib/"]), ["anna", "ben", "lib"]);
    assert_eq!(labels(&["Anna Doe_123_assignsubmission_file/", "Ben_124_assignsubmission_file/"]).len(), 2);
}

#[test]
fn labels_differ_where_file_systems_know_no_capitals() {
    assert_eq!(labels(&["anna/", "anna.zip", "ben.zip"]), ["anna", "anna.zip", "ben"]);
    assert_eq!(labels(&["Anna/", "anna/", "ben/"]), ["Anna", "anna (2)", "ben"]);
}

#[test]
fn flat_downloads_are_grouped_by_student() {
    let names = [
        "Anna Doe_12345_assignsubmission_file_final v2.glsl",
        "Anna Doe_12345_assignsubmission_file_a.vert",
        "Ben_99_assignsubmission_file_ben.zip",
        "Ben_99_assignsubmission_onlinetext_onlinetext.html",
        "grades.csv",
        "loose.vert",
    ];
    let found = many(&names);
    assert_eq!(
        found.submissions.iter().map(|group| group.label.as_str()).collect::<Vec<_>>(),
        ["Anna Doe_12345", "Ben_99"]
    );
    assert_eq!(found.submissions[0].members, [(0, "final v2.glsl".to_owned()), (1, "a.vert".to_owned())]);
    assert_eq!(found.submissions[1].members, [(2, String::new()), (3, "onlinetext.html".to_owned())]);
    assert_eq!(found.skipped.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [4, 5]);

    assert_eq!(labels(&["doeanna_1234_56789_a.vert", "roeben_LATE_1235_56790_b.cpp"]), ["doeanna_1234", "roeben_1235"]);
    assert_eq!(
        labels(&[
            "12345-678 - Anna Doe - Nov 20, 2026 604 PM - a.vert",
            "12346-678 - Ben - Nov 2, 2026 1159 AM - b.vert"
        ]),
        ["Anna Doe 12345", "Ben 12346"]
    );
}

#[test]
fn of_several_attempts_the_last_counts_and_the_others_are_listed() {
    let names = [
        "Ex 7_anna_attempt_2026-11-20-18-04-11_a.vert",
        "Ex 7_anna_attempt_2026-11-21-09-00-00_a.vert",
        "Ex 7_ben_attempt_2026-11-20-10-00-00_b.vert",
    ];
    let found = many(&names);
    assert_eq!(found.submissions[0].members, [(1, "a.vert".to_owned())]);
    assert_eq!(found.skipped, [(0, "an earlier attempt of the same student")]);
    assert!(brightspace_time("Nov 20, 2026 604 PM") > brightspace_time("Nov 20, 2026 1104 AM"));
    assert!(brightspace_time("Nov 20, 2026 1204 AM") < brightspace_time("Nov 20, 2026 104 AM"));
    assert_eq!(brightspace_time("Nov 20"), None);
}

#[test]
fn files_that_only_look_like_a_download_are_not_torn_apart() {
    for names in [&["phong_1_2_v.vert", "phong_1_2_f.frag"][..], &["light_2024_100_a.vert", "other.frag"]] {
        assert_eq!(layout_of(names), Layout::One, "{names:?}");
    }
}

#[test]
fn each_entry_can_be_asked_for_by_itself() {
    let names = ["ex03/", "ex04/", "a.cpp", "list.txt"];
    let found = each(&entries(&names), &|at| is_answer(names[at]));
    assert_eq!(
        found.submissions.iter().map(|group| group.label.as_str()).collect::<Vec<_>>(),
        ["a.cpp", "ex03", "ex04"]
    );
    assert_eq!(found.skipped, [(3, "it contains no answer")]);
}
