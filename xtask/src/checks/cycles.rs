//! Import cycles: groups of files of one crate in which each file uses every other, directly or through the rest.
//!
//! An edge leads from a file to the file that *defines* what it names: a name is followed through `use` and `pub use`, so a
//! `mod.rs` that only re-exports its submodules is not part of a cycle. Names come from `use` declarations and from paths in
//! the code, such as `crate::a::b`. A module's use of its own submodules is not counted, because they are parts of it; their
//! use of it and of each other is. Tests are left out.

use super::source::{Source, TextFile};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// More files than this in a cycle fail the check. Two may depend on each other: a module and its helper.
pub const MOST_FILES: usize = 2;

type Path = Vec<String>;

/// One `use` of a name.
struct Import {
    /// The name that it brings into the file; `*` for all.
    name: String,
    path: Path,
}

/// A file as a module.
struct Module {
    file: String,
    path: Path,
    imports: Vec<Import>,
    /// Paths of at least two segments in the code.
    paths: Vec<Path>,
    /// Names of items that the file declares.
    items: BTreeSet<String>,
}

/// The cycles of all crates with more than [`MOST_FILES`] files, each sorted, the largest first.
pub fn cycles(files: &[TextFile]) -> Vec<Vec<String>> {
    let mut found: Vec<Vec<String>> = crates(files).iter().flat_map(|modules| components(&edges(modules))).collect();
    found.retain(|cycle| cycle.len() > MOST_FILES);
    found.sort_by_key(|cycle| std::cmp::Reverse(cycle.len()));
    found
}

/// One complaint for each cycle that is too large, with its shortest path.
pub fn check(files: &[TextFile]) -> Vec<String> {
    let all: BTreeMap<String, BTreeSet<String>> = crates(files).iter().flat_map(|modules| edges(modules)).collect();
    cycles(files)
        .iter()
        .map(|cycle| {
            let around = shortest_way_around(&all, cycle).join(" -> ");
            let count = cycle.len();
            format!("{count} files import each other: {}; for example {around}", cycle.join(", "))
        })
        .collect()
}

/// The modules of each crate. Tests and files outside `src` folders are left out.
fn crates(files: &[TextFile]) -> Vec<Vec<Module>> {
    let mut crates: BTreeMap<&str, Vec<Module>> = BTreeMap::new();
    for file in files.iter().filter(|file| file.is_rust()) {
        let Some((root, inside)) = file.path.split_once("/src/") else { continue };
        let Some(path) = module_path(inside) else { continue };
        crates.entry(root).or_default().push(Module::parse(file, path));
    }
    crates.into_values().collect()
}

/// `a/mod.rs` is `a`, `a/b.rs` is `a::b`; `None` for tests.
fn module_path(inside: &str) -> Option<Path> {
    let mut path: Path = inside.strip_suffix(".rs")?.split('/').map(str::to_owned).collect();
    let last = path.last()?.clone();
    if path.iter().any(|part| part == "tests" || part == "bin") || last.ends_with("_tests") {
        return None;
    }
    let is_root = path.len() == 1 && (last == "lib" || last == "main");
    if is_root || last == "mod" {
        path.pop();
    }
    Some(path)
}

impl Module {
    fn parse(file: &TextFile, path: Path) -> Self {
        let source = Source::parse(&file.text);
        let is_test = source.test_lines();
        let code: Vec<&str> =
            source.code.iter().zip(is_test).filter(|(_, is_test)| !is_test).map(|(line, _)| line.as_str()).collect();
        let tokens = tokens(&code.join("\n"));
        let mut module =
            Module { file: file.path.clone(), path, imports: Vec::new(), paths: Vec::new(), items: BTreeSet::new() };
        let mut at = 0;
        while at < tokens.len() {
            at = match tokens[at].as_str() {
                "use" => module.read_use(&tokens, at + 1),
                "fn" | "struct" | "enum" | "trait" | "type" | "const" | "static" => {
                    module.items.extend(tokens.get(at + 1).cloned());
                    at + 1
                }
                _ => module.read_path(&tokens, at),
            };
        }
        module
    }

    /// Reads a `use` declaration from `at`; returns the place after it.
    fn read_use(&mut self, tokens: &[String], at: usize) -> usize {
        let end = tokens[at..].iter().position(|token| token == ";").map_or(tokens.len(), |length| at + length);
        self.read_use_tree(&tokens[at..end], &Path::new());
        end + 1
    }

    fn read_use_tree(&mut self, tokens: &[String], before: &Path) {
        let mut path = before.clone();
        let mut at = 0;
        while let Some(token) = tokens.get(at) {
            match token.as_str() {
                "::" => {}
                "{" => {
                    let inside = &tokens[at + 1..tokens.len().saturating_sub(1).max(at + 1)];
                    for branch in branches(inside) {
                        self.read_use_tree(branch, &path);
                    }
                    return;
                }
                "as" => {
                    if let Some(name) = tokens.get(at + 1) {
                        self.imports.push(Import { name: name.clone(), path });
                    }
                    return;
                }
                "*" => {
                    self.imports.push(Import { name: "*".to_owned(), path });
                    return;
                }
                "self" if !path.is_empty() => {}
                segment => path.push(segment.to_owned()),
            }
            at += 1;
        }
        if let Some(name) = path.last().cloned() {
            self.imports.push(Import { name, path });
        }
    }

    /// Reads a path of at least two segments from `at`; returns the place after it.
    fn read_path(&mut self, tokens: &[String], at: usize) -> usize {
        let mut path = vec![tokens[at].clone()];
        let mut next = at + 1;
        while tokens.get(next).is_some_and(|token| token == "::")
            && let Some(segment) = tokens.get(next + 1).filter(|token| is_name(token))
        {
            path.push(segment.clone());
            next += 2;
        }
        if path.len() > 1 && is_name(&path[0]) {
            self.paths.push(path);
        }
        next
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The parts of a list between commas outside inner brackets.
fn branches(tokens: &[String]) -> Vec<&[String]> {
    let mut depth = 0_i32;
    let is_comma = |token: &String| {
        depth += i32::from(token == "{") - i32::from(token == "}");
        token == "," && depth == 0
    };
    tokens.split(is_comma).filter(|branch| !branch.is_empty()).collect()
}

/// Names, `::`, and single characters.
fn tokens(code: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = match first {
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            ':' if rest.starts_with("::") => 2,
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        if !first.is_whitespace() {
            tokens.push(token.to_owned());
        }
        rest = after;
    }
    tokens
}

/// For each file of a crate, the others that define what it names. The submodules of a module are parts of it, and not
/// counted.
fn edges(modules: &[Module]) -> BTreeMap<String, BTreeSet<String>> {
    let by_path: BTreeMap<&Path, &Module> = modules.iter().map(|module| (&module.path, module)).collect();
    let resolver = Resolver { by_path };
    let defined_elsewhere = |module: &Module| {
        let imports = module.imports.iter().map(|import| &import.path);
        let named = imports.chain(&module.paths).filter_map(|path| resolver.definition(module, path, 0));
        let outside = named.filter(|other| !other.path.starts_with(&module.path));
        outside.map(|other| other.file.clone()).collect()
    };
    modules.iter().map(|module| (module.file.clone(), defined_elsewhere(module))).collect()
}

struct Resolver<'a> {
    by_path: BTreeMap<&'a Path, &'a Module>,
}

impl<'a> Resolver<'a> {
    /// The module that defines the item that `path` names in `module`; `None` for other crates and for modules themselves, whose
    /// items are followed where they are used.
    fn definition(&self, module: &'a Module, path: &[String], depth: usize) -> Option<&'a Module> {
        // The compiler rejects names that are imported in a circle.
        if depth > 16 {
            return None;
        }
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.within(&Path::new(), rest, depth),
            "self" => self.within(&module.path, rest, depth),
            "super" => {
                let mut parent = module.path.clone();
                parent.pop()?;
                let above = rest.iter().take_while(|segment| *segment == "super").count();
                for _ in 0..above {
                    parent.pop()?;
                }
                self.within(&parent, &rest[above..], depth)
            }
            name => {
                let child: Path = module.path.iter().cloned().chain([name.to_owned()]).collect();
                if self.by_path.contains_key(&child) {
                    return self.within(&child, rest, depth);
                }
                let import = module.imports.iter().find(|import| import.name == name && import.path != path)?;
                let full: Path = import.path.iter().chain(rest).cloned().collect();
                // An import of another crate is found again under its own name.
                if import.path.first() == Some(first) { None } else { self.definition(module, &full, depth + 1) }
            }
        }
    }

    /// The module that defines the first name of `rest` in the module at `start` or below.
    fn within(&self, start: &Path, rest: &[String], depth: usize) -> Option<&'a Module> {
        let mut path = start.clone();
        let mut rest = rest;
        while let Some((name, after)) = rest.split_first() {
            let child: Path = path.iter().cloned().chain([name.clone()]).collect();
            if !self.by_path.contains_key(&child) {
                break;
            }
            (path, rest) = (child, after);
        }
        let module = *self.by_path.get(&path)?;
        let name = rest.first()?;
        if module.items.contains(name) {
            return Some(module);
        }
        if let Some(import) = module.imports.iter().find(|import| import.name == *name) {
            let full: Path = import.path.iter().chain(&rest[1..]).cloned().collect();
            return self.definition(module, &full, depth + 1);
        }
        let globs = module.imports.iter().filter(|import| import.name == "*");
        let through_glob = |import: &Import| {
            let full: Path = import.path.iter().cloned().chain([name.clone()]).collect();
            self.definition(module, &full, depth + 1)
        };
        globs.map(through_glob).find(Option::is_some).flatten().or(Some(module))
    }
}

/// The strongly connected components (Tarjan, Depth-first search and linear graph algorithms, 1972), each sorted.
fn components(edges: &BTreeMap<String, BTreeSet<String>>) -> Vec<Vec<String>> {
    let mut search =
        Search { edges, numbers: BTreeMap::new(), lowest: BTreeMap::new(), stack: Vec::new(), found: Vec::new() };
    for file in edges.keys() {
        if !search.numbers.contains_key(file.as_str()) {
            search.visit(file);
        }
    }
    search.found
}

struct Search<'a> {
    edges: &'a BTreeMap<String, BTreeSet<String>>,
    numbers: BTreeMap<&'a str, usize>,
    lowest: BTreeMap<&'a str, usize>,
    stack: Vec<&'a str>,
    found: Vec<Vec<String>>,
}

impl<'a> Search<'a> {
    fn visit(&mut self, file: &'a str) -> usize {
        let number = self.numbers.len();
        self.numbers.insert(file, number);
        self.stack.push(file);
        let mut low = number;
        for next in self.edges.get(file).into_iter().flatten() {
            let reached = match self.numbers.get(next.as_str()) {
                None => self.visit(next),
                Some(&known) if self.stack.contains(&next.as_str()) => known,
                Some(_) => continue,
            };
            low = low.min(reached);
        }
        self.lowest.insert(file, low);
        if low == number
            && let Some(start) = self.stack.iter().position(|known| *known == file)
        {
            let mut component: Vec<String> = self.stack.split_off(start).into_iter().map(str::to_owned).collect();
            component.sort();
            self.found.push(component);
        }
        low
    }
}

/// A shortest path from a file of the cycle back to it.
fn shortest_way_around(edges: &BTreeMap<String, BTreeSet<String>>, cycle: &[String]) -> Vec<String> {
    let ways = cycle.iter().filter_map(|start| {
        let mut from: BTreeMap<&str, &str> = BTreeMap::new();
        let mut waiting = VecDeque::from([start.as_str()]);
        while let Some(file) = waiting.pop_front() {
            for next in edges.get(file)?.iter().filter(|next| cycle.contains(next)) {
                if next == start {
                    let mut way = vec![start.clone()];
                    let mut at = file;
                    while at != start {
                        way.push(at.to_owned());
                        at = from.get(at)?;
                    }
                    way.push(start.clone());
                    way.reverse();
                    return Some(way);
                }
                if next != start && !from.contains_key(next.as_str()) {
                    from.insert(next, file);
                    waiting.push_back(next);
                }
            }
        }
        None
    });
    ways.max_by_key(Vec::len).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: format!("crates/x/src/{path}"), text: text.into() }
    }

    fn names(files: &[TextFile]) -> Vec<Vec<String>> {
        let short = |path: String| path.trim_start_matches("crates/x/src/").to_owned();
        cycles(files).into_iter().map(|cycle| cycle.into_iter().map(short).collect()).collect()
    }

    #[test]
    fn three_files_in_a_circle_are_found_and_two_may_be() {
        let circle = [
            file("lib.rs", "mod a;\nmod b;\nmod c;\n"),
            file("a.rs", "use crate::b::B;\npub struct A;\n"),
            file("b.rs", "pub struct B;\nfn f() { crate::c::g(); }\n"),
            file("c.rs", "use super::a::A as Other;\npub fn g() {}\n"),
        ];
        assert_eq!(names(&circle), [["a.rs", "b.rs", "c.rs"]]);
        let complaints = check(&circle);
        assert!(complaints.len() == 1 && complaints[0].starts_with("3 files import each other: crates/x/src/a.rs,"));
        assert!(complaints[0].contains("a.rs -> crates/x/src/b.rs") && complaints[0].matches(" -> ").count() == 3);
        let pair = [circle[0].clone(), circle[1].clone(), file("b.rs", "use crate::a::A;\npub struct B;\n")];
        assert_eq!(names(&pair), Vec::<Vec<String>>::new());
    }

    #[test]
    fn names_are_followed_to_the_file_that_defines_them() {
        // Each child takes the other's type through the module that re-exports both.
        let through = [
            file("lib.rs", "mod shapes;\n"),
            file("shapes/mod.rs", "mod line;\nmod circle;\npub use line::Line;\npub use circle::{Circle, area};\n"),
            file("shapes/line.rs", "pub struct Line;\n"),
            file("shapes/circle.rs", "use super::Line;\npub struct Circle(Line);\npub fn area() {}\n"),
        ];
        assert_eq!(names(&through), Vec::<Vec<String>>::new());
        // The line asks the circle through an imported module, and through the module itself, whose parts they are.
        let mut around = through.to_vec();
        around[1].text.push_str("mod arc;\npub fn all() { line::f() }\n");
        around[2].text.push_str("use crate::shapes;\nfn f() { shapes::area() }\n");
        around[3].text.push_str("fn g() { super::all(); super::arc::h() }\n");
        around.push(file("shapes/arc.rs", "use super::line;\npub fn h() {}\nfn i() { line::f() }\n"));
        assert_eq!(names(&around), [["shapes/arc.rs", "shapes/circle.rs", "shapes/line.rs"]]);
    }

    #[test]
    fn tests_comments_and_other_crates_make_no_cycle() {
        let files = [
            file("lib.rs", "mod a;\nmod b;\nmod c;\n"),
            file("a.rs", "use std::fmt;\nuse crate::b::B;\npub struct A;\n"),
            file("b.rs", "// crate::c::C\npub struct B;\nfn f() { let x = \"crate::c::C\"; }\n"),
            file("c.rs", "pub struct C;\n#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}\n"),
            file("b_tests.rs", "use crate::c::C;\nuse crate::a::A;\n"),
        ];
        assert_eq!(names(&files), Vec::<Vec<String>>::new());
    }

    #[test]
    fn globs_and_lists_are_read() {
        let files = [
            file("lib.rs", "mod a;\nmod b;\nmod c;\n"),
            file("a.rs", "use crate::{b::{self, B}, c};\npub struct A;\n"),
            file("b.rs", "pub use crate::c::*;\npub struct B(C);\n"),
            file("c.rs", "use crate::a::{A};\npub struct C;\n"),
        ];
        assert_eq!(names(&files).len(), 0, "a glob alone names nothing");
        let mut named = files.to_vec();
        named[2].text.push_str("fn f(c: crate::c::C) {}\n");
        assert_eq!(names(&named), [["a.rs", "b.rs", "c.rs"]]);
    }
}
