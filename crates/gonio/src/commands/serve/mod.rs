//! `gonio serve`: the web page, on this machine alone.
//!
//! A server of our own over `std::net`: it answers GET and HEAD for a handful of files whose names are known
//! beforehand. A crate for it would bring ten times the code, and none of those looked at limits a request's time.

mod answer;
mod connection;
mod page;
mod request;

use crate::cli::WordOptions;
use crate::report::{CliError, Outcome, Reporter};
use answer::Site;
use clap::Args;
use page::Page;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Serve the lab as a web page, on this machine alone.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  gonio serve
      Prints the address to open in a browser; Ctrl-C ends it.
  gonio serve --port 0
      Any free port.
  gonio serve --from dist
      The page in this folder instead of the one built into gonio.

Only programs on this machine reach it (127.0.0.1), and only under the names localhost and 127.0.0.1.")]
pub struct ServeArgs {
    /// The port of 127.0.0.1; 0 takes any free one.
    #[arg(long, value_name = "N", default_value_t = 8317)]
    pub port: u16,
    /// Serve the page in this folder (by `cargo xtask web`) instead of the one built into gonio.
    #[arg(long, value_name = "FOLDER")]
    pub from: Option<PathBuf>,
    /// What is said.
    #[command(flatten)]
    pub words: WordOptions,
}

/// More connections than a browser opens, fewer than would hurt.
const MOST_CONNECTIONS: usize = 64;

/// Serves until the process is ended.
pub fn run(args: &ServeArgs, reporter: &Reporter) -> Result<Outcome, CliError> {
    let page = match &args.from {
        Some(folder) => Page::in_folder(folder)?,
        None => Page::embedded().ok_or_else(|| {
            CliError::new(
                "this gonio was built without the web page; run `cargo xtask web` and build gonio again, or name a \
                 folder that holds it by --from",
            )
        })?,
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, args.port)).map_err(|error| match error.kind() {
        std::io::ErrorKind::AddrInUse => CliError::new(format!(
            "port {} is in use; choose another by --port N, or any free one by --port 0",
            args.port
        )),
        _ => CliError::io(format_args!("port {} of 127.0.0.1 cannot be opened", args.port), &error),
    })?;
    let port = listener.local_addr().map_err(|error| CliError::io("the port's number cannot be had", &error))?.port();
    let url = format!("http://127.0.0.1:{port}/");
    if reporter.json() {
        reporter.report(&serde_json::json!({ "command": "serve", "url": url, "port": port }))?;
    } else {
        reporter.text(&crate::page::Page::of_text(&url))?;
        reporter.note("open this address in a browser; Ctrl-C ends it");
    }
    accept(&listener, &Arc::new(Site { page, port }), reporter);
    Ok(Outcome::Done)
}

/// A thread for each connection; without end.
fn accept(listener: &TcpListener, site: &Arc<Site>, reporter: &Reporter) {
    let open = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        let stream = match stream {
            Ok(stream) => stream,
            Err(error) => {
                // The other side has gone already, or this process has too many files open: the latter passes.
                reporter.warning(format_args!("a connection could not be taken: {}", crate::report::io_reason(&error)));
                std::thread::sleep(Duration::from_millis(100));
                continue;
            }
        };
        let place = Place::take(&open);
        let crowded = place.0.load(Ordering::Relaxed) > MOST_CONNECTIONS;
        let site = Arc::clone(site);
        let started = std::thread::Builder::new().spawn(move || {
            connection::serve(stream, &site, crowded);
            drop(place);
        });
        if let Err(error) = started {
            reporter.warning(format_args!("a connection could not be served: {}", crate::report::io_reason(&error)));
        }
    }
}

/// One of the connections that are open, as long as it lives.
struct Place(Arc<AtomicUsize>);

impl Place {
    fn take(open: &Arc<AtomicUsize>) -> Place {
        open.fetch_add(1, Ordering::Relaxed);
        Place(Arc::clone(open))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}
