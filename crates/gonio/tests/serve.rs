//! `gonio serve`, with requests over real sockets.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::Lab;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};

const HASHED: &str = "gonio.0123abcd.wasm";

/// A small page: `index.html` and a compressed file with a hashed name.
fn page() -> Lab {
    let lab = Lab::new();
    std::fs::create_dir(lab.path("dist")).unwrap();
    lab.write("dist/index.html", "<!doctype html>");
    lab.write(&format!("dist/{HASHED}"), "plain bytes");
    lab.write(&format!("dist/{HASHED}.br"), "brotli bytes");
    lab.write(&format!("dist/{HASHED}.gz"), "gzip bytes");
    lab.write("dist/.hidden", "nobody's");
    lab.write("secret.txt", "outside");
    lab
}

/// A server that stops when it is dropped.
struct Server {
    child: Child,
    port: u16,
    url: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// An answer, its headers by their names in lower case.
struct Answer {
    status: u16,
    headers: BTreeMap<String, String>,
    body: Vec<u8>,
}

impl Answer {
    fn header(&self, name: &str) -> &str {
        self.headers.get(name).map_or("", String::as_str)
    }

    fn text(&self) -> &str {
        std::str::from_utf8(&self.body).unwrap()
    }
}

impl Server {
    fn start(lab: &Lab) -> Server {
        let mut child = Command::new(env!("CARGO_BIN_EXE_gonio"))
            .args(["serve", "--port", "0", "--quiet", "--from"])
            .arg(lab.path("dist"))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut url = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut url).unwrap();
        let url = url.trim().to_owned();
        let port = url.trim_end_matches('/').rsplit(':').next().unwrap().parse().unwrap();
        Server { child, port, url }
    }

    fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    fn get(&self, path: &str) -> Answer {
        self.ask("GET", path, &[])
    }

    /// A request under the server's own name.
    fn ask(&self, method: &str, path: &str, headers: &[&str]) -> Answer {
        let more: String = headers.iter().map(|line| format!("{line}\r\n")).collect();
        self.send(format!("{method} {path} HTTP/1.1\r\nHost: {}\r\n{more}\r\n", self.host()).as_bytes())
    }

    fn send(&self, bytes: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.write_all(bytes).unwrap();
        stream.shutdown(Shutdown::Write).unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|window| window == b"\r\n\r\n").unwrap();
        let head = std::str::from_utf8(&answer[..end]).unwrap();
        let mut lines = head.split("\r\n");
        let status = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
        let headers =
            lines.map(|line| line.split_once(": ").unwrap()).map(|(k, v)| (k.to_lowercase(), v.to_owned())).collect();
        Answer { status, headers, body: answer[end + 4..].to_vec() }
    }
}

#[test]
fn the_page_is_served_with_restrictive_headers() {
    let lab = page();
    let server = Server::start(&lab);
    assert_eq!(server.url, format!("http://127.0.0.1:{}/", server.port));
    for path in ["/", "/index.html", "/?scene=x"] {
        let answer = server.get(path);
        assert_eq!((answer.status, answer.text()), (200, "<!doctype html>"), "{path}");
        assert_eq!(answer.header("content-type"), "text/html; charset=utf-8");
        assert_eq!(answer.header("content-length"), "15");
        // A new page must be visible at once.
        assert_eq!(answer.header("cache-control"), "no-cache");
        assert_eq!(answer.header("x-content-type-options"), "nosniff");
        assert_eq!(answer.header("referrer-policy"), "no-referrer");
        let policy = answer.header("content-security-policy");
        for part in ["default-src 'none'", "script-src 'self' 'wasm-unsafe-eval'", "frame-ancestors 'none'"] {
            assert!(policy.contains(part), "{policy}");
        }
        assert!(!policy.contains("unsafe-inline") && !policy.contains("'unsafe-eval'"), "{policy}");
    }
}

#[test]
fn the_smallest_accepted_encoding_is_sent() {
    let lab = page();
    let server = Server::start(&lab);
    let path = format!("/{HASHED}");
    for (accepted, encoding, body) in [
        ("gzip, deflate, br, zstd", "br", "brotli bytes"),
        ("gzip, br;q=0", "gzip", "gzip bytes"),
        ("deflate", "", "plain bytes"),
    ] {
        let answer = server.ask("GET", &path, &[&format!("Accept-Encoding: {accepted}")]);
        assert_eq!((answer.header("content-encoding"), answer.text()), (encoding, body), "{accepted}");
        assert_eq!(answer.header("vary"), "Accept-Encoding");
        assert_eq!(answer.header("content-type"), "application/wasm");
        // The name contains a hash of the content, so it never has to be requested again.
        assert_eq!(answer.header("cache-control"), "public, max-age=31536000, immutable");
    }
}

#[test]
fn head_returns_the_headers_of_get() {
    let lab = page();
    let server = Server::start(&lab);
    let (get, head) = (server.get("/"), server.ask("HEAD", "/", &[]));
    assert_eq!((head.status, head.body.len()), (200, 0));
    assert_eq!(head.headers, get.headers);
}

#[test]
fn only_files_of_the_page_are_served() {
    let lab = page();
    let server = Server::start(&lab);
    for path in [
        "/nothing.js",
        "/../secret.txt",
        "/%2e%2e/secret.txt",
        "/..%2fsecret.txt",
        "/dist/index.html",
        "/.hidden",
        "/\\..\\secret.txt",
        "/index.html/",
    ] {
        let answer = server.get(path);
        assert_eq!(answer.status, 404, "{path}: {}", answer.text());
        assert_eq!(answer.header("x-content-type-options"), "nosniff");
    }
}

#[test]
fn other_methods_and_other_protocols_are_refused() {
    let lab = page();
    let server = Server::start(&lab);
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "TRACE", "get"] {
        let answer = server.ask(method, "/", &["Content-Length: 0"]);
        assert_eq!((answer.status, answer.header("allow")), (405, "GET, HEAD"), "{method}");
    }
    for nonsense in ["\r\n\r\n", "GET /\r\n\r\n", "GET / HTTP/3\r\n\r\n", "GET http://a/ HTTP/1.1\r\nHost: a\r\n\r\n"] {
        assert_eq!(server.send(nonsense.as_bytes()).status, 400, "{nonsense:?}");
    }
    let long = format!("GET / HTTP/1.1\r\nHost: {}\r\nX: {}\r\n\r\n", server.host(), "x".repeat(40_000));
    assert_eq!(server.send(long.as_bytes()).status, 431);
    // The server still answers.
    assert_eq!(server.get("/").status, 200);
}

#[test]
fn other_names_for_this_machine_are_refused() {
    let lab = page();
    let server = Server::start(&lab);
    let with_hosts = |hosts: &[&str]| {
        let lines: String = hosts.iter().map(|host| format!("Host: {host}\r\n")).collect();
        server.send(format!("GET / HTTP/1.1\r\n{lines}\r\n").as_bytes()).status
    };
    let port = server.port;
    let own = [format!("127.0.0.1:{port}"), format!("localhost:{port}"), format!("LocalHost:{port}")];
    for host in &own {
        assert_eq!(with_hosts(&[host]), 200, "{host}");
    }
    for host in ["evil.example", "localhost", "127.0.0.1", &format!("localhost.evil.example:{port}"), "localhost:1", ""]
    {
        assert_eq!(with_hosts(&[host]), 403, "{host}");
    }
    assert_eq!(with_hosts(&[]), 403);
    assert_eq!(with_hosts(&[&own[0], "evil.example"]), 403);
}

#[test]
fn a_silent_client_blocks_no_other() {
    let lab = page();
    let server = Server::start(&lab);
    let silent: Vec<TcpStream> = (0..20).map(|_| TcpStream::connect(("127.0.0.1", server.port)).unwrap()).collect();
    assert_eq!(server.get("/").status, 200);
    drop(silent);
}

#[test]
fn only_this_machine_can_connect() {
    let lab = page();
    let server = Server::start(&lab);
    // The port is in use on the loopback address only; on other addresses it is free.
    assert!(TcpListener::bind(("127.0.0.1", server.port)).is_err());
    assert!(TcpListener::bind(("127.0.0.2", server.port)).is_ok());
}

#[cfg(unix)]
#[test]
fn an_interrupt_stops_the_server() {
    let lab = page();
    let mut server = Server::start(&lab);
    let sent = Command::new("kill").args(["-INT", &server.child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    use std::os::unix::process::ExitStatusExt;
    assert_eq!(server.child.wait().unwrap().signal(), Some(2));
}

#[test]
fn a_port_in_use_and_a_folder_without_a_page_are_refused() {
    let lab = page();
    let server = Server::start(&lab);
    let port = server.port.to_string();
    lab.run(&["serve", "--from", "dist", "--port", &port]).refused(&[&port, "in use", "--port"]);
    lab.run(&["serve", "--from", "nowhere"]).refused(&["nowhere", "no such file"]);
    lab.write("dist/index.html", "");
    std::fs::remove_file(lab.path("dist/index.html")).unwrap();
    lab.run(&["serve", "--from", "dist"]).refused(&["dist", "index.html", "cargo xtask web"]);
}

#[test]
fn the_embedded_page_is_served_or_reported_missing() {
    let built: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/embedded_page.rs"));
    let lab = Lab::new();
    if built.is_empty() {
        lab.run(&["serve", "--port", "0"]).refused(&["without the web page", "cargo xtask web", "--from"]);
        return;
    }
    let mut child = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args(["serve", "--port", "0", "--json"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut report = String::new();
    let mut lines = BufReader::new(child.stdout.take().unwrap());
    while !report.ends_with("}\n") {
        assert_ne!(lines.read_line(&mut report).unwrap(), 0, "it ended: {report}");
    }
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let port = u16::try_from(report["port"].as_u64().unwrap()).unwrap();
    let server = Server { child, port, url: report["url"].as_str().unwrap().to_owned() };
    let index = server.get("/");
    assert_eq!(index.status, 200);
    // Every file that the page names is complete, also for a client that accepts no compression.
    let names: Vec<&str> =
        index.text().split('"').filter(|word| word.ends_with(".wasm") || word.ends_with(".js")).collect();
    // Four modules, those of the first picture, the application, the checker and the tracer, with their scripts, and the script of
    // the mirror for screen readers.
    let modules = names.iter().filter(|name| name.ends_with(".wasm")).count();
    assert!(modules == 4 && names.len() == modules + 5, "{names:?}");
    for name in names {
        let answer = server.get(&format!("/{name}"));
        assert_eq!((answer.status, answer.header("content-encoding")), (200, ""), "{name}");
        assert!(name.ends_with(".js") || answer.body.starts_with(b"\0asm"), "{name}");
    }
}
