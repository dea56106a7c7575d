//! Answers to requests.

use super::page::{Encoding, Page};
use super::request::{Method, Request};

/// The page, and the port that it is served on.
pub struct Site {
    pub page: Page,
    /// The port in the `Host` header of every request that is answered.
    pub port: u16,
}

/// An answer before it is written.
pub struct Answer {
    /// The status code (RFC 9110, 15) and its reason phrase.
    pub status: (u16, &'static str),
    /// Headers in addition to [`ALWAYS`].
    pub headers: Vec<(&'static str, String)>,
    pub body: Vec<u8>,
    /// Whether only the length of the body is sent, for HEAD.
    pub head_only: bool,
}

/// The page may run its own scripts and its own WebAssembly, send requests to its own server, and show pictures that it made
/// itself. Nothing inline, nothing from elsewhere, and no frame around it. The page has the same policy in a `meta` element,
/// for hosts that send no headers.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
    img-src 'self' blob: data:; connect-src 'self'; manifest-src 'self'; worker-src 'self'; base-uri 'none'; \
    form-action 'none'; frame-ancestors 'none'";

/// Headers of every answer.
pub const ALWAYS: &[(&str, &str)] = &[
    ("Content-Security-Policy", POLICY),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Connection", "close"),
];

/// Media types by extension. Browsers compile WebAssembly while it arrives only if its type is right.
const TYPES: &[(&str, &str)] = &[
    (".html", "text/html; charset=utf-8"),
    (".css", "text/css; charset=utf-8"),
    (".js", "text/javascript; charset=utf-8"),
    (".json", "application/json"),
    (".webmanifest", "application/manifest+json"),
    (".wasm", "application/wasm"),
    (".svg", "image/svg+xml"),
    (".png", "image/png"),
    (".jpg", "image/jpeg"),
    (".ttf", "font/ttf"),
    (".woff2", "font/woff2"),
    (".toml", "text/plain; charset=utf-8"),
    (".obj", "text/plain; charset=utf-8"),
    (".mtl", "text/plain; charset=utf-8"),
    (".txt", "text/plain; charset=utf-8"),
];

impl Site {
    /// The answer to a request; `None` is a malformed one.
    pub fn answer(&self, request: Option<&Request>) -> Answer {
        let Some(request) = request else {
            return Answer::text((400, "Bad Request"), "this is not an HTTP/1.1 request");
        };
        // The name of a page from elsewhere may resolve to this machine, which would give that page the same origin (DNS
        // rebinding). So only our own names are answered.
        if !request.host.as_deref().is_some_and(|host| self.is_own_name(host)) {
            let own = format!("this server answers to localhost:{0} and 127.0.0.1:{0} only", self.port);
            return Answer::text((403, "Forbidden"), &own);
        }
        if request.method == Method::Other {
            let mut answer = Answer::text((405, "Method Not Allowed"), "only GET and HEAD are answered");
            answer.headers.push(("Allow", "GET, HEAD".into()));
            return answer;
        }
        let mut answer = self.file(request);
        answer.head_only = request.method == Method::Head;
        answer
    }

    fn is_own_name(&self, host: &str) -> bool {
        ["localhost", "127.0.0.1"].iter().any(|name| match host.strip_prefix(name) {
            // Port 80 is left out of the header.
            Some("") => self.port == 80,
            Some(rest) => rest.strip_prefix(':') == Some(self.port.to_string().as_str()),
            None => false,
        })
    }

    fn file(&self, request: &Request) -> Answer {
        let name = match request.path.trim_start_matches('/') {
            "" => "index.html",
            name => name,
        };
        let Some(file) = self.page.file(name) else {
            return Answer::text((404, "Not Found"), "there is no such file; the page is at /");
        };
        let (encoding, body) = match file.read(|encoding| request.accepts(encoding)) {
            Ok(read) => read,
            Err(_) => return Answer::text((500, "Internal Server Error"), "the file can no longer be read"),
        };
        // The content of a hashed name never changes; anything else is requested again each time.
        let caching = if is_hashed(name) { "public, max-age=31536000, immutable" } else { "no-cache" };
        let mut headers = vec![("Content-Type", content_type(name).to_owned()), ("Cache-Control", caching.to_owned())];
        if encoding != Encoding::Identity {
            headers.push(("Content-Encoding", encoding.name().to_owned()));
        }
        if file.varies() {
            headers.push(("Vary", "Accept-Encoding".to_owned()));
        }
        Answer { status: (200, "OK"), headers, body, head_only: false }
    }
}

impl Answer {
    /// An answer of one sentence.
    pub fn text(status: (u16, &'static str), sentence: &str) -> Answer {
        let headers =
            vec![("Content-Type", "text/plain; charset=utf-8".to_owned()), ("Cache-Control", "no-store".to_owned())];
        Answer { status, headers, body: format!("{sentence}\n").into_bytes(), head_only: false }
    }

    /// The head of the message, including the empty line.
    pub fn head(&self) -> String {
        let (code, reason) = self.status;
        let mut head = format!("HTTP/1.1 {code} {reason}\r\nContent-Length: {}\r\n", self.body.len());
        let own = self.headers.iter().map(|(name, value)| (*name, value.as_str()));
        for (name, value) in ALWAYS.iter().copied().chain(own) {
            head.push_str(&format!("{name}: {value}\r\n"));
        }
        head + "\r\n"
    }
}

/// Whether a name contains the hash of its content: `gonio.0123456789abcdef.wasm`.
fn is_hashed(name: &str) -> bool {
    let mut parts = name.rsplit('.');
    parts.next();
    parts.next().is_some_and(|hash| {
        hash.len() == 16 && hash.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte))
    })
}

fn content_type(name: &str) -> &'static str {
    TYPES.iter().find(|(end, _)| name.ends_with(end)).map_or("application/octet-stream", |(_, kind)| kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_recognised() {
        assert!(is_hashed("gonio.0123456789abcdef.wasm") && is_hashed("samples/a.b.0123456789abcdef.obj"));
        assert!(!is_hashed("index.html") && !is_hashed("gonio.0123456789ABCDEF.wasm"));
        assert!(!is_hashed("0123456789abcdef") && !is_hashed("gonio.0123456789abcde.wasm"));
    }
}
