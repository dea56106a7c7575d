//! `gonio serve`: the web page for this machine.
//!
//! The server uses `std::net` and answers GET and HEAD for a handful of files whose names it knows beforehand. A server crate
//! would be ten times the code, and none of those examined limits the time of a request.

mod answer;
mod connection;
mod page;
mod request;

use crate::cli::GeneralOptions;
use crate::report::{CliError, Outcome, Reporter};
use answer::Site;
use clap::Args;
use page::Page;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Serve the lab as a web page to this machine.
#[derive(Args, Debug)]
#[command(after_long_help = "\
Examples:
  gonio serve
      Prints the address to open in a browser. Ctrl-C ends it.
  gonio serve --port 0
      On any free port.
  gonio serve --from dist
      The page in this folder instead of the embedded one.

Only programs on this machine can connect (127.0.0.1), and only by the names localhost and 127.0.0.1.")]
pub struct ServeArgs {
    /// Port of 127.0.0.1; 0 is any free one.
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
    Page::embedded().is_some()
}

/// More connections than a browser opens, and few enough for any machine.
const MOST_CONNECTIONS: usize = 64;

/// Serves until the process is ended.
pub fn run(args: &ServeArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let page = match &args.from {
        Some(folder) => Page::in_folder(folder)?,
        None => Page::embedded().ok_or_else(|| {
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
    let port =
        listener.local_addr().map_err(|error| CliError::io("cannot find out the number of the port", &error))?.port();
    let url = format!("http://127.0.0.1:{port}/");
    if reporter.json() {
        reporter.report(&serde_json::json!({ "command": "serve", "url": url, "port": port }))?;
    } else {
        reporter.text(&crate::page::Page::from_text(&url))?;
        reporter.note("open this address in a browser; press Ctrl-C to stop");
    }
    accept(&listener, &Arc::new(Site { page, port }), reporter);
    Ok(Outcome::Done)
}

/// Accepts connections for ever, and starts a thread for each.
fn accept(listener: &TcpListener, site: &Arc<Site>, reporter: &Reporter) {
    let open = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        let stream = match stream {
            Ok(stream) => stream,
            Err(error) => {
                // The other side has gone, or this process has too many open files, which passes.
                reporter.warning(format_args!("cannot accept a connection: {}", crate::report::io_reason(&error)));
                std::thread::sleep(Duration::from_millis(100));
                continue;
            }
        };
        let connection = OpenConnection::count(&open);
        let crowded = connection.0.load(Ordering::Relaxed) > MOST_CONNECTIONS;
        let site = Arc::clone(site);
        let started = std::thread::Builder::new().spawn(move || {
            connection::serve(stream, &site, crowded);
            drop(connection);
        });
        if let Err(error) = started {
            reporter.warning(format_args!("cannot serve a connection: {}", crate::report::io_reason(&error)));
        }
    }
}

/// Counts an open connection as long as it lives.
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
