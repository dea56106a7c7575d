//! `unsafe` stands only where it is declared, and says why it is sound.

use super::source::Source;
use super::tree::TextFile;

/// The files that may use `unsafe`. The compiler denies it everywhere (`unsafe_code` in the workspace's lints); these files
/// may allow it.
pub const DECLARED: &[&str] = &[
    "crates/gonio-gl/src/capture.rs",
    "crates/gonio-gl/src/functions.rs",
    "crates/gonio-gl/src/headless/egl.rs",
    "crates/gonio-gl/src/headless/glutin_window.rs",
    "crates/gonio-gl/src/memory.rs",
    "crates/gonio-scene/src/files/disk.rs",
];

/// Complaints about `unsafe` in the wrong place, about permissions given in the wrong place, and
/// about `unsafe` that does not say why it is sound.
pub fn check(files: &[TextFile], declared: &[&str]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in files.iter().filter(|f| f.is_rust()) {
        let allowed = declared
            .iter()
            .any(|place| if place.ends_with('/') { file.path.starts_with(place) } else { file.path == *place });
        let source = Source::parse(&file.text);
        for line in source.lines_with_word("unsafe") {
            let at = format!("{}:{}", file.path, line + 1);
            if !allowed {
                complaints.push(format!("{at}: `unsafe` is not declared for this place ({})", declared.join(", ")));
            } else if needs_reason(&source.code[line]) && !has_reason(&source, line) {
                complaints.push(format!("{at}: `unsafe` without a comment `SAFETY: ...` that says why it is sound"));
            }
        }
        for line in source.lines_with_word("unsafe_code") {
            let code = &source.code[line];
            if !allowed && (code.contains("allow") || code.contains("expect") || code.contains("warn")) {
                complaints.push(format!("{}:{}: permits `unsafe` where none is declared", file.path, line + 1));
            }
        }
    }
    complaints
}

/// Complaints about manifests of crates that may use `unsafe` nowhere and yet do not deny it.
pub fn check_manifests(files: &[TextFile]) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut seen = 0;
    for file in files.iter().filter(|f| f.path.ends_with("/Cargo.toml")) {
        seen += 1;
        let lines: Vec<&str> = file.text.lines().map(str::trim).collect();
        let inherits = lines.windows(2).any(|pair| pair == ["[lints]", "workspace = true"]);
        let own = lines.iter().any(|l| matches!(*l, "unsafe_code = \"deny\"" | "unsafe_code = \"forbid\""));
        if !inherits && !own {
            complaints.push(format!("{}: neither takes the workspace's lints nor denies `unsafe_code`", file.path));
        }
    }
    if seen == 0 {
        complaints.push("no crate's Cargo.toml was found".into());
    }
    complaints
}

/// Blocks and implementations promise something and have to say why they may; functions and traits
/// that are unsafe to call or to implement only ask for it, in their documentation.
fn needs_reason(code: &str) -> bool {
    super::source::find_words(code, "unsafe").any(|at| {
        let rest = code[at + "unsafe".len()..].trim_start();
        !(rest.starts_with("fn ") || rest.starts_with("trait ") || rest.starts_with("extern "))
    })
}

/// Whether a comment with `SAFETY` stands on the line, or above it within the same statement.
fn has_reason(source: &Source, line: usize) -> bool {
    let says = |line: usize| source.comments[line].to_uppercase().contains("SAFETY");
    if says(line) {
        return true;
    }
    // Upwards: comments right above, attributes, and lines of a statement that has not ended there.
    for above in (0..line).rev() {
        if says(above) {
            return true;
        }
        let code = source.code[above].trim();
        let ends_statement = code.ends_with(';') || code.ends_with('{') || code.ends_with('}');
        let blank = code.is_empty() && source.comments[above].is_empty();
        if ends_statement || blank {
            return false;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> TextFile {
        TextFile { path: path.into(), text: text.into() }
    }

    #[test]
    fn unsafe_in_an_undeclared_place_is_found() {
        let files = [
            file("crates/gonio-mesh/src/obj.rs", "fn f() {\n    // SAFETY: no\n    unsafe { g() }\n}\n"),
            file("crates/gonio-mesh/src/mtl.rs", "// unsafe\nconst A: &str = \"unsafe\";\n"),
        ];
        let complaints = check(&files, &["crates/gonio-gl/"]);
        assert_eq!(complaints.len(), 1);
        assert!(complaints[0].starts_with("crates/gonio-mesh/src/obj.rs:3: "), "{complaints:?}");
        assert!(check(&files, &["crates/gonio-mesh/src/obj.rs"]).is_empty());
    }

    #[test]
    fn a_permission_in_an_undeclared_place_is_found() {
        let files =
            [file("crates/gonio/src/main.rs", "#![allow(unsafe_code)]\n"), file("a.rs", "#![deny(unsafe_code)]")];
        let complaints = check(&files, &["crates/gonio-gl/"]);
        assert_eq!(complaints, ["crates/gonio/src/main.rs:1: permits `unsafe` where none is declared"]);
    }

    #[test]
    fn unsafe_must_say_why() {
        let with = "fn f() {\n    // SAFETY: the context is current.\n    let a = g(\n        unsafe { h() },\n    );\n    unsafe { k() } // SAFETY: as above\n}\nunsafe fn m() {}\n";
        assert!(check(&[file("gl/a.rs", with)], &["gl/"]).is_empty());
        let without = "fn f() {\n    // SAFETY: this one.\n    unsafe { g() };\n    unsafe { h() };\n}\nunsafe impl Send for A {}\n";
        let complaints = check(&[file("gl/a.rs", without)], &["gl/"]);
        assert_eq!(complaints.len(), 2, "{complaints:?}");
        assert!(complaints[0].starts_with("gl/a.rs:4: ") && complaints[1].starts_with("gl/a.rs:6: "));
    }

    #[test]
    fn a_crate_that_leaves_the_lints_is_found() {
        let good = file("crates/a/Cargo.toml", "[lints]\nworkspace = true\n");
        let bad = file("crates/b/Cargo.toml", "[package]\nname = \"b\"\n[dependencies]\nc = { workspace = true }\n");
        assert!(check_manifests(std::slice::from_ref(&good)).is_empty());
        assert_eq!(check_manifests(&[good, bad]).len(), 1);
        assert_eq!(check_manifests(&[]).len(), 1);
    }
}
