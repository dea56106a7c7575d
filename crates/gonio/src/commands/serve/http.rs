//! HTTP as far as a server of files needs it (RFC 9110, RFC 9112): the head of a request, and the response to it.

use super::files::{ContentEncoding, WebPage};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Get,
    Head,
    /// Any other method, which is rejected.
    Other,
}

/// A request for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HttpRequest {
    pub method: Method,
    /// The path without its query, including the leading `/`.
    pub path: String,
    /// The `Host` header; `None` if it is missing or repeated.
    pub host: Option<String>,
    /// The encodings that the client accepts, as it wrote them.
    pub accept_encoding: String,
}

impl HttpRequest {
    /// Parses the bytes up to the empty line; `None` if they are not an HTTP/1 request.
    pub fn parse(head: &[u8]) -> Option<HttpRequest> {
        let text = std::str::from_utf8(head).ok()?;
        let mut lines = text.split("\r\n");
        let mut words = lines.next()?.split(' ');
        let (method, target, version) = (words.next()?, words.next()?, words.next()?);
        if words.next().is_some() || !version.starts_with("HTTP/1.") || !target.starts_with('/') {
            return None;
        }
        let method = match method {
            "GET" => Method::Get,
            "HEAD" => Method::Head,
            _ => Method::Other,
        };
        let path = target.split(['?', '#']).next().unwrap_or_default().to_owned();
        let (mut hosts, mut accept_encoding) = (Vec::new(), String::new());
        for line in lines.take_while(|line| !line.is_empty()) {
            let (name, value) = line.split_once(':')?;
            let value = value.trim();
            if name.eq_ignore_ascii_case("host") {
                hosts.push(value.to_ascii_lowercase());
            } else if name.eq_ignore_ascii_case("accept-encoding") {
                // Repeating a header means the same as commas in one.
                accept_encoding = [accept_encoding.as_str(), value].join(",");
            }
        }
        let host = if hosts.len() == 1 { hosts.pop() } else { None };
        Some(HttpRequest { method, path, host, accept_encoding })
    }

    /// Whether the client accepts this encoding (RFC 9110, 12.5.3): named or covered by `*`, with a weight above 0.
    pub fn accepts(&self, encoding: &str) -> bool {
        let weight_of = |name: &str| {
            self.accept_encoding.split(',').find_map(|item| {
                let mut parts = item.split(';').map(str::trim);
                if !parts.next()?.eq_ignore_ascii_case(name) {
                    return None;
                }
                let weight = parts.find_map(|part| part.strip_prefix("q="));
                Some(weight.map_or(1.0, |text| text.parse::<f64>().unwrap_or(0.0)))
            })
        };
        weight_of(encoding).or_else(|| weight_of("*")).is_some_and(|weight| weight > 0.0)
    }
}

/// The page, and the port that it is served on.
pub struct Site {
    pub page: WebPage,
    /// The port in the `Host` header of every request that is answered.
    pub port: u16,
}

/// An answer before it is written.
pub struct HttpResponse {
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
    pub fn answer(&self, request: Option<&HttpRequest>) -> HttpResponse {
        let Some(request) = request else {
            return HttpResponse::text((400, "Bad Request"), "this is not an HTTP/1.1 request");
        };
        // The name of a page from elsewhere may resolve to this machine, which would give that page the same origin (DNS
        // rebinding). So only our own names are answered.
        if !request.host.as_deref().is_some_and(|host| self.is_own_name(host)) {
            let own = format!("this server answers to localhost:{0} and 127.0.0.1:{0} only", self.port);
            return HttpResponse::text((403, "Forbidden"), &own);
        }
        if request.method == Method::Other {
            let mut answer = HttpResponse::text((405, "Method Not Allowed"), "only GET and HEAD are answered");
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

    fn file(&self, request: &HttpRequest) -> HttpResponse {
        let name = match request.path.trim_start_matches('/') {
            "" => "index.html",
            name => name,
        };
        let Some(file) = self.page.file(name) else {
            return HttpResponse::text((404, "Not Found"), "there is no such file; the page is at /");
        };
        let (encoding, body) = match file.read(|encoding| request.accepts(encoding)) {
            Ok(read) => read,
            Err(_) => return HttpResponse::text((500, "Internal Server Error"), "the file can no longer be read"),
        };
        // The content of a hashed name never changes; anything else is requested again each time.
        let caching = if is_hashed(name) { "public, max-age=31536000, immutable" } else { "no-cache" };
        let mut headers = vec![("Content-Type", content_type(name).to_owned()), ("Cache-Control", caching.to_owned())];
        if encoding != ContentEncoding::Identity {
            headers.push(("Content-Encoding", encoding.name().to_owned()));
        }
        if file.varies() {
            headers.push(("Vary", "Accept-Encoding".to_owned()));
        }
        HttpResponse { status: (200, "OK"), headers, body, head_only: false }
    }
}

impl HttpResponse {
    /// An answer of one sentence.
    pub fn text(status: (u16, &'static str), sentence: &str) -> HttpResponse {
        let headers =
            vec![("Content-Type", "text/plain; charset=utf-8".to_owned()), ("Cache-Control", "no-store".to_owned())];
        HttpResponse { status, headers, body: format!("{sentence}\n").into_bytes(), head_only: false }
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

/// Whether a name contains the hash of its content: `gonio.0123abcd.wasm`.
fn is_hashed(name: &str) -> bool {
    let mut parts = name.rsplit('.');
    parts.next();
    parts.next().is_some_and(|hash| {
        hash.len() == 8 && hash.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte))
    })
}

fn content_type(name: &str) -> &'static str {
    TYPES.iter().find(|(end, _)| name.ends_with(end)).map_or("application/octet-stream", |(_, kind)| kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(head: &str) -> Option<HttpRequest> {
        HttpRequest::parse(head.as_bytes())
    }

    #[test]
    fn a_request_is_read() {
        let Some(request) = parse("GET /a/b.js?x=1 HTTP/1.1\r\nHOST: Localhost:80\r\nAccept-Encoding: br\r\n\r\n")
        else {
            panic!("rejected");
        };
        assert_eq!((request.method, request.path.as_str()), (Method::Get, "/a/b.js"));
        assert_eq!(request.host.as_deref(), Some("localhost:80"));
        assert!(request.accepts("br") && !request.accepts("gzip"));
    }

    #[test]
    fn malformed_requests_are_rejected() {
        for bad in [
            "",
            "GET /\r\n\r\n",
            "GET / HTTP/2\r\n\r\n",
            "GET http://a/ HTTP/1.1\r\n\r\n",
            "GET / x HTTP/1.1\r\n\r\n",
            "GET / HTTP/1.1\r\nno colon\r\n\r\n",
        ] {
            assert_eq!(parse(bad), None, "{bad}");
        }
        assert_eq!(HttpRequest::parse(b"GET /\xff HTTP/1.1\r\n\r\n"), None);
    }

    #[test]
    fn two_hosts_are_none() {
        let request = parse("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil\r\n\r\n");
        assert_eq!(request.and_then(|r| r.host), None);
    }

    #[test]
    fn weights_of_encodings_count() {
        let accepts = |list: &str, encoding: &str| {
            parse(&format!("GET / HTTP/1.1\r\nAccept-Encoding: {list}\r\n\r\n")).is_some_and(|r| r.accepts(encoding))
        };
        assert!(accepts("gzip, deflate, br", "br"));
        assert!(accepts("gzip;q=0.5", "gzip"));
        assert!(!accepts("br;q=0, gzip", "br"));
        assert!(accepts("*", "br") && !accepts("*;q=0", "br") && !accepts("br;q=0, *", "br"));
        assert!(!accepts("", "gzip"));
    }

    #[test]
    fn hashes_are_recognised() {
        assert!(is_hashed("gonio.0123abcd.wasm") && is_hashed("samples/a.b.0123abcd.obj"));
        assert!(!is_hashed("index.html") && !is_hashed("gonio.0123ABCD.wasm"));
        assert!(!is_hashed("0123abcd") && !is_hashed("gonio.0123abc.wasm"));
    }
}
