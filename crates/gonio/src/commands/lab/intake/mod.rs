//! Turns the paths on the command line into submissions: one, or those of a class.
//!
//! [`tree`] reads folders and archives, [`gonio_exercises::class`] separates submissions, [`gather`] reads the files of one, within
//! limits.

mod tree;

#[cfg(test)]
mod tests;

use crate::error::CliError;
use clap::ValueEnum;
use gonio_check::submission::SourceFile;
use gonio_exercises::class::{self, ClassEntry, ClassLayout, Many, is_noise};
use gonio_exercises::exercise::Exercise;
use gonio_exercises::preview;
use std::path::{Path, PathBuf};
use tree::Tree;

/// A value of `--submissions`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Submissions {
    /// Decide by names and contents.
    #[default]
    Auto,
    /// One submission.
    One,
    /// One for each folder, archive and answer, or for each student of a flat download.
    Many,
}

/// The submissions of a command.
pub enum Intake {
    One(GatheredFiles),
    Class(ClassSubmissions),
}

/// Several submissions.
pub struct ClassSubmissions {
    /// The submissions in order of their labels, which are unique.
    pub submissions: Vec<ClassMember>,
    /// Entries that belong to no submission: `name (reason)`.
    pub skipped: Vec<String>,
}

/// One submission of several. [`ClassMember::gather`] reads its files.
pub struct ClassMember {
    /// The name of the student, folder or archive.
    pub label: String,
    members: Vec<(Tree, String)>,
}

impl ClassMember {
    /// Reads its files.
    pub fn gather(&self) -> GatheredFiles {
        gather(self.members.iter().map(|(tree, name)| (tree, name.clone())))
    }
}

/// The submissions at `paths`. With `as_class` one submission is a class of one.
///
/// # Errors
/// A path that cannot be read.
pub fn take(
    paths: &[PathBuf],
    exercise: &Exercise,
    requested: Submissions,
    as_class: bool,
) -> Result<Intake, CliError> {
    let trees = paths.iter().map(|path| tree_of(path)).collect::<Result<Vec<Tree>, CliError>>()?;
    let label = match requested {
        Submissions::One => first_name(&trees),
        Submissions::Auto | Submissions::Many => match class_of(&trees, exercise, requested) {
            Ok(class) => return Ok(Intake::Class(class)),
            Err(label) => label,
        },
    };
    let members = members(paths, trees);
    let gathered = gather_some(&members)?;
    Ok(match as_class {
        true => {
            Intake::Class(ClassSubmissions { submissions: vec![ClassMember { label, members }], skipped: Vec::new() })
        }
        false => Intake::One(gathered),
    })
}

fn first_name(trees: &[Tree]) -> String {
    trees.first().map_or_else(String::new, |tree| tree.name.clone())
}

/// Reads the files at these paths as one submission, for commands that check no classes.
///
/// # Errors
/// A path that cannot be read, or no files in them.
pub fn read(paths: &[PathBuf]) -> Result<Vec<SourceFile>, CliError> {
    gather_files(paths).map(|gathered| gathered.files)
}

/// The same, with the entries that were left out.
///
/// # Errors
/// A path that cannot be read, or no files in them.
pub fn gather_files(paths: &[PathBuf]) -> Result<GatheredFiles, CliError> {
    let trees = paths.iter().map(|path| tree_of(path)).collect::<Result<Vec<Tree>, CliError>>()?;
    gather_some(&members(paths, trees))
}

fn tree_of(path: &Path) -> Result<Tree, CliError> {
    Tree::open(path).map_err(|reason| CliError::new(format!("{}: {reason}", tree::shown(path.as_os_str()))))
}

/// The trees at these paths with their names in one submission.
fn members(paths: &[PathBuf], trees: Vec<Tree>) -> Vec<(Tree, String)> {
    let named = |(tree, path): (Tree, &PathBuf)| {
        let name = root_name(path, &tree, paths.len());
        (tree, name)
    };
    trees.into_iter().zip(paths).map(named).collect()
}

/// Reads the files. If there are none because of a damaged archive, say, that is an error.
fn gather_some(members: &[(Tree, String)]) -> Result<GatheredFiles, CliError> {
    let gathered = gather(members.iter().map(|(tree, name)| (tree, name.clone())));
    match gathered.left_out.first() {
        Some(reason) if gathered.files.is_empty() => Err(CliError::new(reason.clone())),
        _ => Ok(gathered),
    }
}

/// The name of a path in a submission: that of a file as on the command line; none for a folder or an archive, whose files have their
/// names within it, unless there are several.
fn root_name(path: &Path, tree: &Tree, count: usize) -> String {
    match tree.is_container() {
        false => tree::shown(path.as_os_str()),
        true if count == 1 => String::new(),
        true => tree.name.clone(),
    }
}

/// The class, if the trees form one; else the label of the single submission: the name of the innermost folder or archive that
/// contains all of it, unless that is the name of a part of a project.
fn class_of(trees: &[Tree], exercise: &Exercise, requested: Submissions) -> Result<ClassSubmissions, String> {
    let mut level: Vec<Tree> = trees.to_vec();
    let mut label = first_name(trees);
    let mut skipped = Vec::new();
    // A single folder or archive contains the submissions.
    let mut within = match trees {
        [only] if only.is_container() => Some(0),
        _ => None,
    };
    loop {
        if let Some(at) = within {
            let outer = &level[at];
            if !class::is_part_of_a_project(&outer.name) {
                label = outer.name.clone();
            }
            let rest = level.iter().enumerate().filter(|(other, _)| *other != at);
            skipped.extend(rest.map(|(_, tree)| format!("{} (it contains no answer)", tree.name)));
            level = match outer.children() {
                Ok(children) => children,
                // Gathering it reports the reason.
                Err(_) => return Err(label),
            };
        }
        let entry = |tree: &Tree| ClassEntry { name: tree.name.clone(), is_container: tree.is_container() };
        let entries: Vec<ClassEntry> = level.iter().map(entry).collect();
        let answers = |at: usize| contains_answer(exercise, &level[at]);
        match class::layout(&entries, &answers) {
            ClassLayout::Many(many) => return Ok(class_from_groups(many, &level, skipped)),
            ClassLayout::Within(at) => within = Some(at),
            ClassLayout::One if requested == Submissions::Many && entries.iter().any(|entry| entry.is_container) => {
                return Ok(class_from_groups(class::each(&entries, &answers), &level, skipped));
            }
            ClassLayout::One => return Err(label),
        }
    }
}

fn class_from_groups(many: Many, level: &[Tree], mut skipped: Vec<String>) -> ClassSubmissions {
    let reason = |at: usize, why| format!("{} ({})", level[at].name, level[at].unread().unwrap_or(why));
    skipped.extend(many.skipped.iter().map(|&(at, why)| reason(at, why)));
    let member = |(at, name): (usize, String)| {
        let tree = level[at].clone();
        let name = if name.is_empty() && !tree.is_container() { tree.name.clone() } else { name };
        (tree, name)
    };
    let submission = |group: class::Group| ClassMember {
        label: group.label,
        members: group.members.into_iter().map(member).collect(),
    };
    ClassSubmissions { submissions: many.submissions.into_iter().map(submission).collect(), skipped }
}

fn contains_answer(exercise: &Exercise, tree: &Tree) -> bool {
    if !tree.is_container() {
        let file = tree.bytes().map(|bytes| SourceFile { name: tree.name.clone(), bytes });
        return file.is_ok_and(|file| preview::is_answer(exercise, &file));
    }
    preview::is_complete(exercise, &gather([(tree, String::new())]).files)
}

/// Bytes of all files of a submission: six large faces and a project around them.
const MAX_BYTES: u64 = 128 << 20;
/// Files of a submission.
const MAX_FILES: usize = 2000;
/// Entries that are visited.
const MAX_VISITED: usize = 20_000;
/// Folders and archives within one another.
const MAX_DEPTH: usize = 32;

/// The files of a submission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GatheredFiles {
    /// The files in the order of the submission.
    pub files: Vec<SourceFile>,
    /// The entries that were left out, each with its name and the reason.
    pub left_out: Vec<String>,
}

/// Reads the files of these trees. Each tree has a name: that of a file, or of the folder that its files get (empty for none).
/// Small files are read first, so that a large one cannot keep a shader out.
pub fn gather<'a>(roots: impl IntoIterator<Item = (&'a Tree, String)>) -> GatheredFiles {
    let mut walk = Walk::default();
    for (tree, name) in roots {
        walk.visit(tree, name, 0);
    }
    let mut gathered = GatheredFiles { files: Vec::new(), left_out: walk.left_out };
    let mut by_size: Vec<usize> = (0..walk.found.len()).collect();
    by_size.sort_by_key(|&at| walk.found[at].1.size());
    let mut total = 0;
    let mut read: Vec<(usize, SourceFile)> = Vec::new();
    let mut over = 0;
    for at in by_size {
        let (name, tree) = &walk.found[at];
        if read.len() >= MAX_FILES || total + tree.size() > MAX_BYTES {
            over += 1;
            continue;
        }
        match tree.bytes() {
            Ok(bytes) => {
                total += bytes.len() as u64;
                read.push((at, SourceFile { name: name.clone(), bytes }));
            }
            Err(reason) => gathered.left_out.push(format!("{name}: {reason}")),
        }
    }
    if over > 0 {
        gathered.left_out.push(format!(
            "the {over} largest files; at most {MAX_FILES} files and {} MiB of a submission are read",
            MAX_BYTES >> 20
        ));
    }
    read.sort_by_key(|(at, _)| *at);
    gathered.files = read.into_iter().map(|(_, file)| file).collect();
    gathered
}

#[derive(Default)]
struct Walk {
    found: Vec<(String, Tree)>,
    left_out: Vec<String>,
    visited: usize,
}

impl Walk {
    fn visit(&mut self, tree: &Tree, name: String, depth: usize) {
        self.visited += 1;
        if self.visited == MAX_VISITED {
            self.left_out.push(format!("everything after the first {MAX_VISITED} entries"));
        }
        if self.visited >= MAX_VISITED {
            return;
        }
        if !tree.is_container() {
            match tree.unread() {
                Some(reason) => self.left_out.push(format!("{name}: {reason}")),
                None => self.found.push((name, tree.clone())),
            }
            return;
        }
        if depth >= MAX_DEPTH {
            return self.left_out.push(format!("{name}: folders are read up to {MAX_DEPTH} deep"));
        }
        match tree.children() {
            Ok(children) => {
                for child in children.iter().filter(|child| !is_noise(&child.name)) {
                    let name = if name.is_empty() { child.name.clone() } else { format!("{name}/{}", child.name) };
                    self.visit(child, name, depth + 1);
                }
            }
            Err(reason) => {
                let name = if name.is_empty() { &tree.name } else { &name };
                self.left_out.push(format!("{name}: {reason}"));
            }
        }
    }
}
