//! Reading the files of one submission, within limits.

use super::tree::Tree;
use gonio_check::submission::SourceFile;
use gonio_exercises::class::is_noise;

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
pub struct Gathered {
    /// The files in the order of the submission.
    pub files: Vec<SourceFile>,
    /// The entries that were left out, each with its name and the reason.
    pub left_out: Vec<String>,
}

/// Reads the files of these trees. Each tree has a name: that of a file, or of the folder that its files get (empty for none).
/// Small files are read first, so that a large one cannot keep a shader out.
pub fn gather<'a>(roots: impl IntoIterator<Item = (&'a Tree, String)>) -> Gathered {
    let mut walk = Walk::default();
    for (tree, name) in roots {
        walk.visit(tree, name, 0);
    }
    let mut gathered = Gathered { files: Vec::new(), left_out: walk.left_out };
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
            Err(why) => gathered.left_out.push(format!("{name}: {why}")),
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
                Some(why) => self.left_out.push(format!("{name}: {why}")),
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
            Err(why) => {
                let name = if name.is_empty() { &tree.name } else { &name };
                self.left_out.push(format!("{name}: {why}"));
            }
        }
    }
}
