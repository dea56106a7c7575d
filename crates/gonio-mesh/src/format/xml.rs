//! Finds the name of an XML document's root element without parsing the document.

use memchr::memmem;

/// Returns the name, without a prefix, of the first element of `xml`, which begins with a `<`; `None` if there is none,
/// or if the prolog does not end.
///
/// The prolog consists of any number of processing instructions, comments and document type declarations of any length
/// (Extensible Markup Language 1.0, section 2.8).
pub(super) fn root_name(xml: &[u8]) -> Option<&[u8]> {
    let mut rest = xml;
    loop {
        rest = rest.trim_ascii_start();
        rest = if let Some(instruction) = rest.strip_prefix(b"<?") {
            behind(instruction, b"?>")?
        } else if let Some(comment) = rest.strip_prefix(b"<!--") {
            behind(comment, b"-->")?
        } else if let Some(declaration) = rest.strip_prefix(b"<!") {
            behind_declaration(declaration)?
        } else {
            break;
        }
    }
    let name = rest.strip_prefix(b"<")?;
    let end = name.iter().position(|byte| byte.is_ascii_whitespace() || matches!(byte, b'>' | b'/' | b'<'))?;
    let name = &name[..end];
    Some(name.iter().rposition(|byte| *byte == b':').map_or(name, |colon| &name[colon + 1..]))
}

/// Returns the text after the first `end`.
fn behind<'a>(text: &'a [u8], end: &[u8]) -> Option<&'a [u8]> {
    memmem::find(text, end).map(|at| &text[at + end.len()..])
}

/// Returns the text after the `>` of a declaration, which may contain declarations in brackets.
fn behind_declaration(declaration: &[u8]) -> Option<&[u8]> {
    let mut rest = declaration;
    let mut brackets = 0_usize;
    loop {
        let (byte, next) = rest.split_first()?;
        rest = match byte {
            b'>' if brackets == 0 => return Some(next),
            b'[' => {
                brackets += 1;
                next
            }
            b']' => {
                brackets = brackets.saturating_sub(1);
                next
            }
            b'"' | b'\'' => behind(next, &[*byte])?,
            b'<' if next.starts_with(b"!--") => behind(&next[3..], b"-->")?,
            b'<' if next.starts_with(b"?") => behind(next, b"?>")?,
            _ => next,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_stands_behind_the_prolog() {
        let long = format!("<!-- {} <COLLADA> -->", "-".repeat(10_000));
        let name = |xml: &str| root_name(xml.as_bytes()).map(|name| String::from_utf8_lossy(name).into_owned());
        let documents = [
            ("<COLLADA xmlns='x'>", "COLLADA"),
            ("<COLLADA>", "COLLADA"),
            ("<c:COLLADA\n>", "COLLADA"),
            ("<svg/>", "svg"),
            ("<?xml version='1.0'?>\n<?style a='>'?> <!-- <svg> --><COLLADA ", "COLLADA"),
            ("<!DOCTYPE html><html>", "html"),
            ("<!DOCTYPE COLLADA SYSTEM 'a>b.dtd'>\n<COLLADA>", "COLLADA"),
            ("<!DOCTYPE a [<!ENTITY b \"]><svg>\"> <!-- ]><svg> ' --> <?c ]> ?>]>\n<COLLADA>", "COLLADA"),
            (&format!("{long}\n<COLLADA>"), "COLLADA"),
        ];
        for (xml, root) in documents {
            assert_eq!(name(xml).as_deref(), Some(root), "{xml}");
        }
        for xml in ["<", "<?xml", "<!-- COLLADA", "<!DOCTYPE a [ <b> ", "<COLLADA", "text <COLLADA>"] {
            assert_eq!(name(xml), None, "{xml}");
        }
    }
}
