//! `gonio serve`: the web page for this machine.
//!
//! The server is built on `std::net`: it answers GET and HEAD for files whose names it knows beforehand, and limits the time of
//! each request. A server crate would be ten times the code, and none of those examined has such a limit.

mod files;
mod http;

use crate::error::{CliError, CommandOutcome, io_reason};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use crate::terminal::TerminalPage;
use clap::Args;
use files::WebPage;
use http::{HttpRequest, HttpResponse, Site};
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Serve gonio as a web page on this machine.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio serve
      Prints the address to open in a browser; Ctrl-C stops the server.
  gonio serve --port 0
      On any free port.
  gonio serve --from dist
      The page in this folder instead of the embedded one.

Only programs on this machine can connect (127.0.0.1), and only by the names localhost and 127.0.0.1.")]
pub struct ServeArgs {
    /// Port on 127.0.0.1; 0 chooses a free one.
    #[arg(long, value_name = "N", default_value_t = 8317, help_heading = "Server options")]
    pub port: u16,
    /// Serve the page in this folder (built by `cargo xtask web`) instead of the embedded one.
    #[arg(long, value_name = "FOLDER", help_heading = "Server options")]
    pub from: Option<PathBuf>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

/// Whether this program contains the web page.
pub fn has_embedded_page() -> bool {
    WebPage::embedded().is_some()
}

/// Limit of simultaneous connections: more than a browser opens, and few enough for any machine.
const MOST_CONNECTIONS: usize = 64;

/// Serves until the process is ended.
pub fn run(args: &ServeArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let page = match &args.from {
        Some(folder) => WebPage::in_folder(folder)?,
        None => WebPage::embedded().ok_or_else(|| {
            CliError::new(
                "this gonio was built without the web page; run `cargo xtask web` and build gonio again, or name a \
                 folder that contains the page with --from",
            )
        })?,
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, args.port)).map_err(|error| match error.kind() {
        std::io::ErrorKind::AddrInUse => CliError::new(format!(
            "port {} is in use; choose another with --port N, or any free one with --port 0",
            args.port
        )),
        _ => CliError::io(format_args!("port {} of 127.0.0.1 cannot be opened", args.port), &error),
    })?;
    let port = listener.local_addr().map_err(|error| CliError::io("cannot determine the port", &error))?.port();
    let url = format!("http://127.0.0.1:{port}/");
    if reporter.json() {
        reporter.report(&serde_json::json!({ "command": "serve", "url": url, "port": port }))?;
    } else {
        reporter.text(&TerminalPage::from_text(&url))?;
        reporter.note("open this address in a browser; press Ctrl-C to stop");
    }
    accept(&listener, &Arc::new(Site { page, port }), reporter);
    Ok(CommandOutcome::Done)
}

/// Accepts connections for ever, and starts a thread for each.
fn accept(listener: &TcpListener, site: &Arc<Site>, reporter: &Reporter) {
    let open = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        let stream = match stream {
            Ok(stream) => stream,
            Err(error) => {
                // The client has gone, or this process has too many open files for the moment.
                reporter.warning(format_args!("cannot accept a connection: {}", io_reason(&error)));
                std::thread::sleep(Duration::from_millis(100));
                continue;
            }
        };
        let connection = OpenConnection::count(&open);
        let crowded = connection.0.load(Ordering::Relaxed) > MOST_CONNECTIONS;
        let site = Arc::clone(site);
        let started = std::thread::Builder::new().spawn(move || {
            serve_connection(stream, &site, crowded);
            drop(connection);
        });
        if let Err(error) = started {
            reporter.warning(format_args!("cannot serve a connection: {}", io_reason(&error)));
        }
    }
}

/// Counts an open connection until it is dropped.
struct OpenConnection(Arc<AtomicUsize>);

impl OpenConnection {
    fn count(open: &Arc<AtomicUsize>) -> OpenConnection {
        open.fetch_add(1, Ordering::Relaxed);
        OpenConnection(Arc::clone(open))
    }
}

impl Drop for OpenConnection {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Size limit of a request's head; browsers send far less.
const MOST_HEAD_BYTES: usize = 16 * 1024;
/// Time limit for receiving a request.
const REQUEST_TIMEOUT: Duration = Duration::from_secs(10);
/// Time limit for each write of a response.
const STALL: Duration = Duration::from_secs(60);

/// Serves one request, or answers that there are too many connections if `crowded`.
///
/// Errors of a connection are ignored: its client has gone.
fn serve_connection(mut stream: TcpStream, site: &Site, crowded: bool) {
    let answer = if crowded {
        HttpResponse::text((503, "Service Unavailable"), "too many connections at once; try again")
    } else {
        match read_head(&mut stream) {
            Ok(Head::Whole(bytes)) => site.answer(HttpRequest::parse(&bytes).as_ref()),
            Ok(Head::TooLong) => {
                HttpResponse::text((431, "Request Header Fields Too Large"), "the request's head is too long")
            }
            Ok(Head::Late) => HttpResponse::text((408, "Request Timeout"), "the request took too long"),
            Ok(Head::Empty) | Err(_) => return,
        }
    };
    let _ = write(&mut stream, &answer);
}

enum Head {
    Whole(Vec<u8>),
    TooLong,
    Late,
    /// Closed before it was complete.
    Empty,
}

fn read_head(stream: &mut TcpStream) -> io::Result<Head> {
    let deadline = Instant::now() + REQUEST_TIMEOUT;
    let (mut head, mut buffer) = (Vec::new(), [0; 2048]);
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Ok(Head::Late);
        }
        stream.set_read_timeout(Some(left))?;
        let count = match stream.read(&mut buffer) {
            Ok(0) => return Ok(Head::Empty),
            Ok(count) => count,
            Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) => continue,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        head.extend(buffer.iter().take(count));
        if let Some(end) = head.windows(4).position(|bytes| bytes == b"\r\n\r\n") {
            head.truncate(end + 4);
            return Ok(Head::Whole(head));
        }
        if head.len() > MOST_HEAD_BYTES {
            return Ok(Head::TooLong);
        }
    }
}

fn write(stream: &mut TcpStream, answer: &HttpResponse) -> io::Result<()> {
    stream.set_write_timeout(Some(STALL))?;
    stream.write_all(answer.head().as_bytes())?;
    if !answer.head_only {
        stream.write_all(&answer.body)?;
    }
    stream.shutdown(Shutdown::Write)?;
    // Closing while the client still sends would discard the answer: let it finish, within bounds.
    stream.set_read_timeout(Some(Duration::from_secs(1)))?;
    let mut sink = [0; 2048];
    for _ in 0..64 {
        if stream.read(&mut sink)? == 0 {
            break;
        }
    }
    Ok(())
}
