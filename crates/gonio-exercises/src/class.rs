//! The submissions in a folder, a zip or a list of files: one, or those of a whole class.
//!
//! The decision depends on names and on the content of each entry; nothing is read here. The entries are those of one level:
//! everything inside a folder or an archive belongs to one submission.
//!
//! Flat downloads, in which a learning platform puts the files of all students side by side, are recognised by their names:
//!
//! | platform | name |
//! |---|---|
//! | Moodle | `Name_12345_assignsubmission_file_light.vert` |
//! | Canvas | `namefirst_12345_678901_light.vert`, `namefirst_LATE_12345_678901_light.vert` |
//! | Blackboard | `Exercise 7_user_attempt_2026-11-20-18-04-11_light.vert` |
//! | Brightspace | `12345-67890 - First Last - Nov 20, 2026 604 PM - light.vert` |

use gonio_check::words::words_of;
use gonio_language::tr;
use std::collections::{BTreeMap, BTreeSet};

/// One entry of a folder or an archive, or one argument of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassEntry {
    /// Its name, without folders.
    pub name: String,
    /// Whether it is a folder or an archive rather than a file.
    pub is_container: bool,
}

/// How entries are divided into submissions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ClassLayout {
    /// All entries are one submission.
    One,
    /// The only container among them contains everything; its own entries decide.
    Within(usize),
    /// Several submissions.
    Many(Many),
}

/// Several submissions, and the entries that belong to none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Many {
    /// In order of their labels, which differ even if case is ignored.
    pub submissions: Vec<Group>,
    /// Indices of the entries that belong to no submission, each with the reason.
    pub skipped: Vec<(usize, &'static str)>,
}

/// One submission among several.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The name of its folder or archive, or the student's in a flat download.
    pub label: String,
    /// Its entries, each with its name within the submission.
    pub members: Vec<(usize, String)>,
}

/// The layout of these entries. `answers` returns whether the file with an index could be part of an answer to the exercise
/// (a shader, a buffer, a GL program), or whether a container contains a whole answer; it is called only if names do not
/// decide.
pub fn layout(entries: &[ClassEntry], answers: &dyn Fn(usize) -> bool) -> ClassLayout {
    if let Some(many) = flat_download(entries, answers) {
        return ClassLayout::Many(many);
    }
    let is_container = |at: &usize| entries[*at].is_container && !is_noise(&entries[*at].name);
    let containers: Vec<usize> = (0..entries.len()).filter(is_container).collect();
    let is_loose_answer = |at: usize| !entries[at].is_container && !is_noise(&entries[at].name) && answers(at);
    let loose_answers = !containers.is_empty() && (0..entries.len()).any(is_loose_answer);
    match (containers.as_slice(), loose_answers) {
        ([], _) | ([_], true) => ClassLayout::One,
        ([only], false) => ClassLayout::Within(*only),
        _ if is_one_project(entries, &containers, loose_answers, answers) => ClassLayout::One,
        _ => ClassLayout::Many(each_its_own(entries, &containers, answers)),
    }
}

/// Each entry as a submission of its own (the files of a flat download grouped by student), regardless of [`layout`].
pub fn each(entries: &[ClassEntry], answers: &dyn Fn(usize) -> bool) -> Many {
    flat_download(entries, answers).unwrap_or_else(|| {
        let is_submission = |at: &usize| {
            let entry = &entries[*at];
            !is_noise(&entry.name) && (entry.is_container || answers(*at))
        };
        let chosen: Vec<usize> = (0..entries.len()).filter(is_submission).collect();
        each_its_own(entries, &chosen, answers)
    })
}

/// Maximum number of folders with any names that may be the stages of one project.
const MOST_STAGE_FOLDERS: usize = 3;

/// Whether several containers are parts of one student's project. Beside loose answers (`main.cpp` with shaders in string
/// literals) they are, unless two of them answer the exercise by themselves and are not named like parts.
fn is_one_project(
    entries: &[ClassEntry],
    containers: &[usize],
    loose_answers: bool,
    answers: &dyn Fn(usize) -> bool,
) -> bool {
    let is_part = |at: usize| is_part_of_a_project(&entries[at].name);
    let (parts, own): (Vec<usize>, Vec<usize>) = containers.iter().copied().partition(|&at| is_part(at));
    let some_answer = |containers: &[usize], enough: usize| {
        containers.iter().filter(|&&at| answers(at)).take(enough).count() == enough
    };
    match (parts.as_slice(), own.as_slice(), loose_answers) {
        (_, [], _) => true,
        (_, own, true) => !some_answer(own, 2),
        // A folder for each stage: `a.vert/` and `a.frag/`.
        ([], own, false) => own.len() <= MOST_STAGE_FOLDERS && !some_answer(own, 1),
        (parts, [one], false) => !(some_answer(parts, 1) && answers(*one)),
        (_, _, false) => !some_answer(containers, 2),
    }
}

fn each_its_own(entries: &[ClassEntry], chosen: &[usize], answers: &dyn Fn(usize) -> bool) -> Many {
    let mut many = Many::default();
    for (at, entry) in entries.iter().enumerate() {
        if chosen.contains(&at) {
            many.submissions.push(Group { label: entry.name.clone(), members: vec![(at, String::new())] });
        } else {
            many.skipped.push((at, why_skipped(entries, at, answers)));
        }
    }
    shorten_labels(&mut many.submissions);
    distinguish(&mut many.submissions);
    many
}

fn why_skipped(entries: &[ClassEntry], at: usize, answers: &dyn Fn(usize) -> bool) -> &'static str {
    if is_noise(&entries[at].name) {
        tr!("check-a-system-file-not-a-student")
    } else if answers(at) {
        tr!("check-it-is-beside-the-submissions-not")
    } else {
        tr!("check-it-contains-no-answer")
    }
}

/// Files and folders that operating systems and tools leave behind.
pub fn is_noise(name: &str) -> bool {
    const NAMES: [&str; 8] = ["__MACOSX", ".git", ".svn", ".vs", ".vscode", ".DS_Store", "Thumbs.db", "desktop.ini"];
    NAMES.contains(&name) || name.starts_with("._") || name.starts_with(".~lock.") || name.starts_with("~$")
}

/// Shortens `anna.zip` to `anna` if nothing else has that name.
fn shorten_labels(groups: &mut [Group]) {
    let taken: BTreeMap<String, usize> = groups.iter().fold(BTreeMap::new(), |mut count, group| {
        *count.entry(without_archive_ending(&group.label).to_lowercase()).or_default() += 1;
        count
    });
    for group in groups {
        let short = without_archive_ending(&group.label);
        if taken.get(&short.to_lowercase()) == Some(&1) {
            group.label = short.to_owned();
        }
    }
}

fn without_archive_ending(name: &str) -> &str {
    let stem = name.len().checked_sub(4).and_then(|at| Some((name.get(..at)?, name.get(at..)?)));
    match stem {
        Some((stem, ending)) if ending.eq_ignore_ascii_case(".zip") && !stem.is_empty() => stem,
        _ => name,
    }
}

/// Sorts the groups, and numbers labels that differ only in case, which some file systems ignore.
fn distinguish(groups: &mut [Group]) {
    groups.sort_by(|a, b| a.label.cmp(&b.label));
    let mut taken: BTreeSet<String> = BTreeSet::new();
    for group in groups {
        let first = group.label.clone();
        let mut number = 2;
        while !taken.insert(group.label.to_lowercase()) {
            group.label = format!("{first} ({number})");
            number += 1;
        }
    }
}

/// The submissions of a flat download; `None` if no name looks like one.
fn flat_download(entries: &[ClassEntry], answers: &dyn Fn(usize) -> bool) -> Option<Many> {
    if !entries.iter().any(|entry| flat_name(&entry.name).is_some()) {
        return None;
    }
    let mut many = Many::default();
    let mut groups: BTreeMap<String, Attempts> = BTreeMap::new();
    for (at, entry) in entries.iter().enumerate() {
        let is_container = entry.is_container;
        match flat_name(&entry.name) {
            // A student's folder is a submission by itself: only files side by side make a download flat.
            Some(flat) if !is_container || !flat.file.is_empty() => {
                let file = if is_container { String::new() } else { flat.file };
                groups.entry(flat.student).or_default().entry(flat.attempt).or_default().push((at, file));
            }
            _ if is_noise(&entry.name) => many.skipped.push((at, why_skipped(entries, at, answers))),
            _ if is_container => {
                groups
                    .entry(entry.name.clone())
                    .or_default()
                    .entry(String::new())
                    .or_default()
                    .push((at, String::new()));
            }
            _ => many.skipped.push((at, why_skipped(entries, at, answers))),
        }
    }
    let flat_files = groups.values().flat_map(|attempts| attempts.values().flatten());
    if !flat_files.clone().any(|(at, _)| flat_name(&entries[*at].name).is_some()) {
        return None;
    }
    // Names of Canvas contain only numbers as a clue: they count only if all answers look like that.
    let only_canvas = flat_files.clone().all(|(at, _)| flat_name(&entries[*at].name).is_none_or(|flat| flat.is_weak));
    if only_canvas && many.skipped.iter().any(|(at, _)| !is_noise(&entries[*at].name) && answers(*at)) {
        return None;
    }
    for (label, mut attempts) in groups {
        let Some((_, members)) = attempts.pop_last() else { continue };
        let earlier = attempts.into_values().flatten();
        many.skipped.extend(earlier.map(|(at, _)| (at, tr!("check-an-earlier-attempt-of-the-same"))));
        many.submissions.push(Group { label, members });
    }
    many.skipped.sort_unstable();
    shorten_labels(&mut many.submissions);
    distinguish(&mut many.submissions);
    Some(many)
}

/// The files of each attempt of a student, by its time. Platforms that keep only the last attempt name no time.
type Attempts = BTreeMap<String, Vec<(usize, String)>>;

/// The parts of a name in a flat download.
struct FlatName {
    student: String,
    /// A time that sorts as text; empty if the platform names none.
    attempt: String,
    /// The student's own name for the file; empty for a folder of files.
    file: String,
    /// Whether other files may have such names by accident.
    is_weak: bool,
}

fn flat_name(name: &str) -> Option<FlatName> {
    moodle(name).or_else(|| blackboard(name)).or_else(|| brightspace(name)).or_else(|| canvas(name))
}

fn moodle(name: &str) -> Option<FlatName> {
    let (student, rest) = name.split_once("_assignsubmission_")?;
    let (_, number) = student.rsplit_once('_')?;
    let file = ["file", "onlinetext"].iter().find_map(|kind| rest.strip_prefix(kind))?;
    let is_whole = file.is_empty() || file.starts_with('_');
    (is_number(number) && is_whole).then(|| FlatName {
        student: student.to_owned(),
        attempt: String::new(),
        file: file.trim_start_matches('_').to_owned(),
        is_weak: false,
    })
}

fn blackboard(name: &str) -> Option<FlatName> {
    let (student, rest) = name.split_once("_attempt_")?;
    let time = rest.get(..19)?;
    let is_time = time.bytes().enumerate().all(|(at, byte)| match at {
        4 | 7 | 10 | 13 | 16 => byte == b'-',
        _ => byte.is_ascii_digit(),
    });
    let file = rest.get(19..)?.trim_start_matches('_').to_owned();
    is_time.then(|| FlatName { student: student.to_owned(), attempt: time.to_owned(), file, is_weak: false })
}

fn brightspace(name: &str) -> Option<FlatName> {
    let mut parts = name.splitn(4, " - ");
    let (number, student, time) = (parts.next()?, parts.next()?, parts.next()?);
    let (user, folder) = number.split_once('-')?;
    let attempt = brightspace_time(time)?;
    let file = parts.next().unwrap_or_default().to_owned();
    let fits = is_number(user) && is_number(folder);
    fits.then(|| FlatName { student: format!("{student} {user}"), attempt, file, is_weak: false })
}

/// `Nov 20, 2026 604 PM` as `2026-11-20 1804`.
fn brightspace_time(text: &str) -> Option<String> {
    const MONTHS: [&str; 12] = ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];
    let words: Vec<&str> = text.split([' ', ',']).filter(|word| !word.is_empty()).collect();
    let [month, day, year, time, half] = words.as_slice() else { return None };
    let month = month.get(..3)?.to_ascii_lowercase();
    let month = MONTHS.iter().position(|known| *known == month)? + 1;
    let [day, year, time] = [day, year, time].map(|number| number.parse::<u32>().ok());
    let (hour, minute) = (time? / 100 % 12, time? % 100);
    let hour = if half.eq_ignore_ascii_case("pm") { hour + 12 } else { hour };
    Some(format!("{:04}-{month:02}-{:02} {hour:02}{minute:02}", year?, day?))
}

fn canvas(name: &str) -> Option<FlatName> {
    let (student, rest) = name.split_once('_')?;
    let rest = rest.strip_prefix("LATE_").unwrap_or(rest);
    let mut parts = rest.splitn(3, '_');
    let (user, number, file) = (parts.next()?, parts.next()?, parts.next()?);
    let is_name = student.chars().all(|c| c.is_alphanumeric() && !c.is_uppercase() || c == '-') && !student.is_empty();
    let fits = is_name && [user, number].iter().all(|word| is_number(word) && word.len() >= 3) && !file.is_empty();
    fits.then(|| FlatName {
        student: format!("{student}_{user}"),
        attempt: String::new(),
        file: file.to_owned(),
        is_weak: true,
    })
}

fn is_number(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_digit())
}

/// Whether a folder is named like a part of a project (`shaders`, `ex04`, `glfw-3.3`) rather than like a student.
pub fn is_part_of_a_project(name: &str) -> bool {
    const WORDS: &str = "shader shaders glsl hlsl vertex fragment vert frag vs fs src source sources include includes inc lib libs \
        library libraries external externals extern third 3 rd party thirdparty dep deps dependencies vendor build \
        builds bin obj out output outputs debug release x x64 x86 win cmake texture textures tex image images img \
        imgs picture pictures model models object objects mesh meshes asset assets resource resources res data media \
        doc docs documentation report reports rapport screenshot screenshots screens skybox cubemap cubemaps cube \
        cubes map maps glad glfw glm glew glut freeglut stb imgui assimp opengl gl khr ex exo exos exercise \
        exercises exercice exercices tp td lab labs labo laboratory task tasks part question q step code codes \
        project projet projects app work main core common util utils tool tools test tests camera light lights \
        lighting phong blinn gouraud flat diffuse specular reflection refraction mirror host faces scene scenes \
        backup old new final solution starter template node modules packages";
    let words = words_of(name);
    let letters = |word: &String| word.chars().any(char::is_alphabetic);
    words.iter().any(letters)
        && words.iter().all(|word| !letters(word) || WORDS.split_whitespace().any(|known| known == word))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entries by name: `anna/` is a folder with an answer, `docs/-` one without, `a.vert` an answer, `a.txt` not.
    fn entries(names: &[&str]) -> Vec<ClassEntry> {
        let entry = |name: &&str| {
            let folder = name.strip_suffix('-').unwrap_or(name).strip_suffix('/');
            ClassEntry {
                name: folder.unwrap_or(name).to_owned(),
                is_container: folder.is_some() || name.ends_with(".zip"),
            }
        };
        names.iter().map(entry).collect()
    }

    fn is_answer(name: &str) -> bool {
        ["/", ".zip", ".vert", ".frag", ".cpp", ".glsl"].iter().any(|end| name.ends_with(end))
    }

    fn layout_of(names: &[&str]) -> ClassLayout {
        layout(&entries(names), &|at| is_answer(names[at]))
    }

    fn many(names: &[&str]) -> Many {
        match layout_of(names) {
            ClassLayout::Many(many) => many,
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
            // Neither contains a whole answer.
            &["upper/-", "lower/-"],
        ] {
            assert_eq!(layout_of(names), ClassLayout::One, "{names:?}");
        }
    }

    #[test]
    fn a_single_folder_or_archive_is_opened() {
        for (names, at) in [
            (&["anna/"][..], 0),
            (&["anna.zip"], 0),
            (&["list.txt", "class.zip"], 1),
            (&["__MACOSX/", "shaders/"], 1),
            (&["shaders/-"], 0),
        ] {
            assert_eq!(layout_of(names), ClassLayout::Within(at), "{names:?}");
        }
    }

    #[test]
    fn a_folder_for_each_student_is_a_class_despite_other_files() {
        assert_eq!(labels(&["anna/", "ben/"]), ["anna", "ben"]);
        assert_eq!(labels(&["anna/", "ben.zip", "cyd/-", "dan/-"]), ["anna", "ben", "cyd", "dan"]);
        let names = ["anna/", "ben/", "list.txt", ".DS_Store", "__MACOSX/", "solution.vert", "_dan/", ".eve/"];
        assert_eq!(labels(&names), [".eve", "_dan", "anna", "ben"]);
        assert_eq!(skipped(&names), ["list.txt", ".DS_Store", "__MACOSX/", "solution.vert"]);
        // Student numbers are names, not parts of a project.
        assert_eq!(labels(&["1203344/", "1203345/"]), ["1203344", "1203345"]);
        assert_eq!(labels(&["anna/-", "ben/-", "cyd/-", "dan/-"]).len(), 4);
        // A student whose name is that of a part of a project.
        assert_eq!(labels(&["anna/", "ben/", "lib/"]), ["anna", "ben", "lib"]);
        assert_eq!(labels(&["Anna Doe_123_assignsubmission_file/", "Ben_124_assignsubmission_file/"]).len(), 2);
    }

    #[test]
    fn labels_differ_even_if_case_is_ignored() {
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

        assert_eq!(
            labels(&["doeanna_1234_56789_a.vert", "roeben_LATE_1235_56790_b.cpp"]),
            ["doeanna_1234", "roeben_1235"]
        );
        assert_eq!(
            labels(&[
                "12345-678 - Anna Doe - Nov 20, 2026 604 PM - a.vert",
                "12346-678 - Ben - Nov 2, 2026 1159 AM - b.vert"
            ]),
            ["Anna Doe 12345", "Ben 12346"]
        );
    }

    #[test]
    fn only_the_last_attempt_counts_and_the_others_are_listed() {
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
    fn files_that_only_look_like_a_download_are_not_separated() {
        for names in [&["phong_1_2_v.vert", "phong_1_2_f.frag"][..], &["light_2024_100_a.vert", "other.frag"]] {
            assert_eq!(layout_of(names), ClassLayout::One, "{names:?}");
        }
    }

    #[test]
    fn each_entry_can_be_a_submission() {
        let names = ["ex03/", "ex04/", "a.cpp", "list.txt"];
        let found = each(&entries(&names), &|at| is_answer(names[at]));
        assert_eq!(
            found.submissions.iter().map(|group| group.label.as_str()).collect::<Vec<_>>(),
            ["a.cpp", "ex03", "ex04"]
        );
        assert_eq!(found.skipped, [(3, "it contains no answer")]);
    }
}
