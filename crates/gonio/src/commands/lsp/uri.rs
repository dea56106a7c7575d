//! Paths and the URIs of the protocol.

use gonio_exercises::report::uri_of;
use lsp_types::Uri;
use std::path::{Path, PathBuf};

/// The path of a `file:` URI; `None` for other schemes, and for names that are not UTF-8.
pub fn path_of_uri(uri: &Uri) -> Option<PathBuf> {
    path_of(uri.as_str(), cfg!(windows)).map(PathBuf::from)
}

/// The URI of a path.
pub fn uri_of_path(path: &Path) -> Option<Uri> {
    uri_of(&path.to_string_lossy()).parse().ok()
}

fn path_of(uri: &str, is_windows: bool) -> Option<String> {
    let (scheme, rest) = uri.split_once(':')?;
    if !scheme.eq_ignore_ascii_case("file") {
        return None;
    }
    let rest = rest.split(['?', '#']).next().unwrap_or_default();
    let (host, path) = match rest.strip_prefix("//") {
        Some(rest) => rest.split_at(rest.find('/')?),
        None => ("", rest),
    };
    let path = decoded(path)?;
    match (is_windows, host) {
        (false, _) => Some(path),
        // `/c:/work`
        (true, "" | "localhost") => Some(path.strip_prefix('/').map_or(path.clone(), str::to_owned).replace('/', "\\")),
        (true, host) => Some(format!("\\\\{host}{path}").replace('/', "\\")),
    }
}

/// The text without percent signs; `None` if it is damaged or not UTF-8.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digits = [rest.next()?, rest.next()?].map(|digit| char::from(digit).to_digit(16));
        let [Some(high), Some(low)] = digits else { return None };
        bytes.push(u8::try_from(16 * high + low).ok()?);
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn uris_of_files_become_paths() {
        let path = |uri, is_windows| path_of(uri, is_windows);
        assert_eq!(path("file:///home/a%20b/%C3%A9.vert", false).as_deref(), Some("/home/a b/é.vert"));
        assert_eq!(path("file://localhost/home/x%25y", false).as_deref(), Some("/home/x%y"));
        assert_eq!(path("FILE:/home/x", false).as_deref(), Some("/home/x"));
        assert_eq!(path("file:///c%3A/my%20work/a.vert", true).as_deref(), Some("c:\\my work\\a.vert"));
        assert_eq!(path("file://server/share/a.vert", true).as_deref(), Some("\\\\server\\share\\a.vert"));
        for uri in ["untitled:Untitled-1", "file:///%", "file:///%f", "file:///%gg", "file:///%ff", "file", ""] {
            assert_eq!(path(uri, false), None, "{uri}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn paths_become_uris_and_paths_again() {
        let path = Path::new("/tmp/a b/é,100%#?.vert");
        let uri = uri_of_path(path).unwrap();
        assert_eq!(uri.as_str(), "file:///tmp/a%20b/%C3%A9%2C100%25%23%3F.vert");
        assert_eq!(path_of_uri(&uri).as_deref(), Some(path));
    }
}
