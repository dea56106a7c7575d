//! The only place that prints.
//!
//! What a command was asked for goes to stdout, as bytes or text or (`--json`) as one JSON object;
//! everything said *about* it goes to stderr: `error:`, `warning:`, `note:`, one sentence each, and
//! progress bars where stderr is a terminal. Whatever is printed goes through [`crate::page`], so that nothing that a file
//! says can move the cursor, hide what was said, or pass for a line of ours.
#![allow(clippy::print_stderr, clippy::print_stdout)]

use crate::escapes::json_for_terminal;
use crate::hints::hint;
use crate::page::{Page, Style, line_for_terminal};
use clap::Parser;
use gonio_gallery::GalleryError;
use gonio_gl::GlError;
use gonio_image::ImageError;
use gonio_mesh::{Diagnostic, ReadError, Severity};
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::sync::mpsc;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Warnings beyond this many are counted, not printed: a model with a thousand missing textures should
/// not scroll everything else away. `--json` has all of them.
const MOST_DIAGNOSTICS: usize = 20;

/// How long something may take before a bar is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// What `gonio` alone says where no window can be shown: its help, and why. The exit code is that of a command that is
/// missing.
pub fn help_instead_of_a_window(command: &mut clap::Command) -> i32 {
    let help = command.render_help();
    // A closed stderr is nobody's error.
    let _ = writeln!(anstream::stderr(), "{}", help.ansi());
    Reporter::new(false, false)
        .note("there is no display for the window, so this is the help; `gonio render` draws without");
    2
}

/// Prints why the arguments were refused, or the help that was asked for. The exit code.
///
/// What was refused is quoted, so the arguments are read once more with hidden characters as escapes.
pub fn refused_arguments<C: Parser>(error: &clap::Error) -> i32 {
    // A closed stream is nobody's error.
    if !error.use_stderr() {
        let _ = error.print();
        return error.exit_code();
    }
    let shown = std::env::args_os().map(|word| line_for_terminal(&word.to_string_lossy()));
    let _ = match C::try_parse_from(shown) {
        Err(same) if same.kind() == error.kind() => write!(anstream::stderr(), "{}", same.render().ansi()),
        _ => {
            let page = Page::of_text(&error.render().to_string());
            write!(anstream::stderr(), "{}", page.for_terminal())
        }
    };
    error.exit_code()
}

/// Prints a panic like any other error: its message may quote a file.
pub fn panicked(panic: &std::panic::PanicHookInfo<'_>) {
    let place = panic.location().map(ToString::to_string).unwrap_or_default();
    let message = panic.payload_as_str().unwrap_or("for an unknown reason");
    let mut page = Page::new();
    let (red, end) = (Style::Red, Style::Red);
    page.line(format_args!("{red}error{end:#}: gonio panicked at {place}: {message}; this is a fault of gonio"));
    let trace = std::backtrace::Backtrace::capture();
    if trace.status() == std::backtrace::BacktraceStatus::Captured {
        page.text(&trace.to_string());
    }
    let _ = write!(anstream::stderr(), "{}", page.for_terminal());
}

/// How a command ended that did not fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Exit code 0.
    Done,
    /// A check that was asked for did not hold: exit code 1.
    CheckFailed,
}

/// Why a command failed: exit code 2.
#[derive(Debug)]
pub enum CliError {
    /// One sentence: what, where, what to do.
    Message(String),
    /// Several, a line each: what a compiler says.
    Lines(Vec<String>),
    /// Whoever read our stdout has gone: there is nobody left to tell, so nothing is said.
    ClosedPipe,
    /// A process that did the work has said it.
    AlreadySaid,
}

impl CliError {
    /// An error with this sentence.
    pub fn new(message: impl Into<String>) -> Self {
        CliError::Message(message.into())
    }

    /// An error of several lines.
    pub fn lines(lines: impl IntoIterator<Item = String>) -> Self {
        CliError::Lines(lines.into_iter().collect())
    }

    /// `doing`, then why the system refused.
    pub fn io(doing: impl Display, error: &io::Error) -> Self {
        CliError::Message(format!("{doing}: {}", io_reason(error)))
    }
}

impl Display for CliError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CliError::Message(message) => f.write_str(message),
            CliError::Lines(lines) => f.write_str(&lines.join("\n")),
            CliError::ClosedPipe => f.write_str("stdout was closed before everything was written"),
            CliError::AlreadySaid => f.write_str("the reason was said before"),
        }
    }
}

impl From<ReadError> for CliError {
    fn from(error: ReadError) -> Self {
        CliError::Message(format!("{error}{}", hint(error.cause)))
    }
}

impl From<GalleryError> for CliError {
    fn from(error: GalleryError) -> Self {
        match error {
            GalleryError::Scene(error) => error.into(),
            GalleryError::OpenGl(error) => error.into(),
            other => CliError::new(other.to_string()),
        }
    }
}

impl From<ImageError> for CliError {
    fn from(error: ImageError) -> Self {
        CliError::new(error.to_string())
    }
}

impl From<GlError> for CliError {
    fn from(error: GlError) -> Self {
        // What a driver says of a shader has several lines.
        CliError::lines(error.message.lines().map(str::to_owned))
    }
}

/// The reason of an I/O error in plain words, without the system's number.
pub fn io_reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        io::ErrorKind::IsADirectory => "it is a folder".into(),
        io::ErrorKind::NotADirectory => "a part of the path is not a folder".into(),
        io::ErrorKind::StorageFull => "the disk is full".into(),
        io::ErrorKind::QuotaExceeded => "the disk quota is exceeded".into(),
        io::ErrorKind::FileTooLarge => "the file would become larger than this system allows".into(),
        io::ErrorKind::ReadOnlyFilesystem => "the file system is read-only".into(),
        _ => {
            let text = error.to_string();
            match text.find(" (os error") {
                Some(end) => text[..end].to_lowercase(),
                None => text,
            }
        }
    }
}

/// Standard output as another process of gonio's reads it: bytes that no person sees.
pub fn output_for_gonio() -> impl Write {
    io::stdout().lock()
}

/// Where a command's words go.
pub struct Reporter {
    quiet: bool,
    json: bool,
    bars: bool,
}

impl Reporter {
    /// `quiet`: only errors are said. `json`: stdout gets one JSON object.
    pub fn new(quiet: bool, json: bool) -> Self {
        Reporter { quiet, json, bars: !quiet && io::stderr().is_terminal() }
    }

    /// Whether stdout gets one JSON object.
    pub fn json(&self) -> bool {
        self.json
    }

    /// Whether stdout is a terminal: no place for a picture.
    pub fn stdout_is_terminal(&self) -> bool {
        io::stdout().is_terminal()
    }

    /// `error: ...`
    pub fn error(&self, error: &CliError) {
        match error {
            CliError::Lines(lines) => Self::say("error", Style::Red, lines),
            one => Self::say("error", Style::Red, &[one]),
        }
    }

    /// `check failed: ...`: said before exit code 1.
    pub fn check_failed(&self, message: impl Display) {
        Self::say("check failed", Style::Red, &[message]);
    }

    /// `warning: ...`
    pub fn warning(&self, message: impl Display) {
        if !self.quiet {
            Self::say("warning", Style::Yellow, &[message]);
        }
    }

    /// `note: ...`
    pub fn note(&self, message: impl Display) {
        if !self.quiet {
            Self::say("note", Style::Cyan, &[message]);
        }
    }

    /// What was odd about the files, each with its place.
    pub fn diagnostics(&self, diagnostics: &[Diagnostic]) {
        for diagnostic in diagnostics.iter().take(MOST_DIAGNOSTICS) {
            let text = diagnostic_text(diagnostic);
            match diagnostic.severity {
                Severity::Warning => self.warning(text),
                Severity::Note => self.note(text),
            }
        }
        if diagnostics.len() > MOST_DIAGNOSTICS {
            self.note(format!("and {} more of these; --json lists them all", diagnostics.len() - MOST_DIAGNOSTICS));
        }
    }

    /// The word before the first line, the others indented.
    fn say(word: &str, style: Style, lines: &[impl Display]) {
        let mut page = Page::new();
        for (index, line) in lines.iter().enumerate() {
            match index {
                0 => page.line(format_args!("{style}{word}{style:#}: {line}")),
                _ => page.line(format_args!("  {line}")),
            }
        }
        // A closed stderr is nobody's error.
        let _ = write!(anstream::stderr(), "{}", page.for_terminal());
    }

    /// What was asked for, as bytes.
    pub fn data(&self, bytes: &[u8]) -> Result<(), CliError> {
        let mut out = io::stdout().lock();
        out.write_all(bytes).and_then(|()| out.flush()).map_err(stdout_error)
    }

    /// What was asked for, as text; styles are left out where stdout is no terminal.
    pub fn text(&self, page: &Page) -> Result<(), CliError> {
        let mut out = anstream::stdout().lock();
        out.write_all(page.for_terminal().as_bytes()).and_then(|()| out.flush()).map_err(stdout_error)
    }

    /// The report of `--json`: one object, indented.
    pub fn report(&self, value: &impl serde::Serialize) -> Result<(), CliError> {
        self.data(json_text(value)?.as_bytes())
    }

    /// A bar for something whose share done is known; it appears when a second has passed.
    pub fn progress(&self, what: &'static str) -> Progress {
        let bar = self.bars.then(|| (Instant::now(), Mutex::new(None)));
        Progress { what, bar }
    }

    /// Something whose share done is not known: a spinner appears when a second has passed, and goes
    /// when the guard is dropped.
    pub fn busy(&self, what: &'static str) -> Busy {
        if !self.bars {
            return Busy { end: None };
        }
        let (end, ended) = mpsc::channel::<()>();
        let watcher = std::thread::spawn(move || {
            if ended.recv_timeout(PATIENCE) == Err(mpsc::RecvTimeoutError::Timeout) {
                let spinner = ProgressBar::new_spinner();
                spinner.set_message(what);
                spinner.enable_steady_tick(Duration::from_millis(100));
                let _ = ended.recv();
                spinner.finish_and_clear();
            }
        });
        Busy { end: Some((end, watcher)) }
    }
}

/// A report as indented JSON, with a newline at its end; characters that a terminal does not show are escaped.
pub fn json_text(value: &impl serde::Serialize) -> Result<String, CliError> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|e| CliError::new(format!("the report could not be written as JSON: {e}")))?;
    Ok(json_for_terminal(&text) + "\n")
}

/// A diagnostic as `FILE:LINE: MESSAGE`, without its severity.
pub fn diagnostic_text(diagnostic: &Diagnostic) -> String {
    let mut text = String::new();
    if let Some(file) = &diagnostic.file {
        text.push_str(file);
        if let Some(line) = diagnostic.line {
            text.push_str(&format!(":{line}"));
            if let Some(column) = diagnostic.column {
                text.push_str(&format!(":{column}"));
            }
        }
        text.push_str(": ");
    } else if let Some(line) = diagnostic.line {
        text.push_str(&format!("line {line}: "));
    }
    text + &diagnostic.message + hint(diagnostic.cause)
}

fn stdout_error(error: io::Error) -> CliError {
    match error.kind() {
        io::ErrorKind::BrokenPipe => CliError::ClosedPipe,
        _ => CliError::io("stdout could not be written", &error),
    }
}

/// A progress bar that may never be seen.
pub struct Progress {
    what: &'static str,
    bar: Option<(Instant, Mutex<Option<ProgressBar>>)>,
}

impl Progress {
    /// The share done, 0 to 1; from any thread.
    pub fn set(&self, share: f64) {
        let Some((start, bar)) = &self.bar else { return };
        if start.elapsed() < PATIENCE {
            return;
        }
        // Whoever finds it taken leaves the drawing to the other.
        let Ok(mut bar) = bar.try_lock() else { return };
        let bar = bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(1000);
            if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:40}] {percent}% {eta}") {
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_message(self.what);
            bar
        });
        bar.set_position((share.clamp(0.0, 1.0) * 1000.0) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((_, bar)) = &self.bar
            && let Ok(mut bar) = bar.lock()
            && let Some(bar) = bar.take()
        {
            bar.finish_and_clear();
        }
    }
}

/// The guard of [`Reporter::busy`].
pub struct Busy {
    end: Option<(mpsc::Sender<()>, std::thread::JoinHandle<()>)>,
}

impl Drop for Busy {
    fn drop(&mut self) {
        if let Some((end, watcher)) = self.end.take() {
            drop(end);
            let _ = watcher.join();
        }
    }
}

/// Milliseconds of the steps of a command, by name, in the order they ended.
#[derive(Clone, Default)]
pub struct Times {
    steps: Arc<Mutex<Vec<(&'static str, f64)>>>,
}

impl Times {
    /// Runs a step and notes how long it took; steps of one name add up.
    pub fn measure<T>(&self, name: &'static str, step: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = step();
        self.add(name, start.elapsed());
        result
    }

    /// Notes a step's time.
    pub fn add(&self, name: &'static str, time: Duration) {
        let ms = time.as_secs_f64() * 1e3;
        let Ok(mut steps) = self.steps.lock() else { return };
        match steps.iter_mut().find(|(known, _)| *known == name) {
            Some((_, total)) => *total += ms,
            None => steps.push((name, ms)),
        }
    }

    /// As a JSON object.
    pub fn to_json(&self) -> serde_json::Value {
        let steps = self.steps.lock().map(|s| s.clone()).unwrap_or_default();
        steps.iter().map(|(name, ms)| ((*name).to_owned(), serde_json::json!((ms * 1e3).round() / 1e3))).collect()
    }
}
