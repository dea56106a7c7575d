//! The head of a request (RFC 9112), as far as files are asked for.

/// Methods that are answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// A file.
    Get,
    /// What is known about a file.
    Head,
    /// Anything else: refused.
    Other,
}

/// What a client asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Request {
    /// What to do.
    pub method: Method,
    /// The path without its query, from the leading `/` on.
    pub path: String,
    /// The name by which the server was called. `None`: not said, or said more than once.
    pub host: Option<String>,
    /// Encodings that the client takes, as it wrote them.
    pub accept_encoding: String,
}

impl Request {
    /// From the bytes up to the empty line. `None`: this is no HTTP/1 request.
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
                // A header said twice means the same as once with commas.
                accept_encoding = [accept_encoding.as_str(), value].join(",");
            }
        }
        let host = if hosts.len() == 1 { hosts.pop() } else { None };
        Some(Request { method, path, host, accept_encoding })
    }

    /// Whether the client takes this encoding (RFC 9110, 12.5.3): named, or covered by `*`, and not with weight 0.
    pub fn takes(&self, encoding: &str) -> bool {
        let weight_of = |wanted: &str| {
            self.accept_encoding.split(',').find_map(|item| {
                let mut parts = item.split(';').map(str::trim);
                if !parts.next()?.eq_ignore_ascii_case(wanted) {
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
            panic!("refused");
        };
        assert_eq!((request.method, request.path.as_str()), (Method::Get, "/a/b.js"));
        assert_eq!(request.host.as_deref(), Some("localhost:80"));
        assert!(request.takes("br") && !request.takes("gzip"));
    }

    #[test]
    fn what_is_no_request_is_refused() {
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
        let takes = |list: &str, encoding: &str| {
            parse(&format!("GET / HTTP/1.1\r\nAccept-Encoding: {list}\r\n\r\n")).is_some_and(|r| r.takes(encoding))
        };
        assert!(takes("gzip, deflate, br", "br"));
        assert!(takes("gzip;q=0.5", "gzip"));
        assert!(!takes("br;q=0, gzip", "br"));
        assert!(takes("*", "br") && !takes("*;q=0", "br") && !takes("br;q=0, *", "br"));
        assert!(!takes("", "gzip"));
    }
}
