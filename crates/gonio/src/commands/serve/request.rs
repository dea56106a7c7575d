//! The head of a request (RFC 9112), as far as a server of files needs it.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Get,
    Head,
    /// Any other method, which is rejected.
    Other,
}

/// A request for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    pub method: Method,
    /// The path without its query, including the leading `/`.
    pub path: String,
    /// The `Host` header; `None` if it is missing or repeated.
    pub host: Option<String>,
    /// The encodings that the client accepts, as it wrote them.
    pub accept_encoding: String,
}

impl Request {
    /// Parses the bytes up to the empty line; `None` if they are not an HTTP/1 request.
    pub fn parse(head: &[u8]) -> Option<Request> {
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
        Some(Request { method, path, host, accept_encoding })
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

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(head: &str) -> Option<Request> {
        Request::parse(head.as_bytes())
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
        assert_eq!(Request::parse(b"GET /\xff HTTP/1.1\r\n\r\n"), None);
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
}
