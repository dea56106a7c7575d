//! The only module that prints.
//!
//! The result of a command goes to stdout: bytes, text or (`--json`) one JSON object. Messages about it go to stderr:
//! `error:`, `warning:`, `note:`, one sentence each, `info:` with `--verbose`, and progress bars if stderr is a terminal.
//! Text goes through [`crate::terminal`], so that nothing in a file can move the cursor, hide a message or forge one.
#![allow(clippy::disallowed_methods, clippy::print_stderr, clippy::print_stdout)]

use crate::error::{CliError, hint};
use crate::options::GeneralOptions;
use crate::terminal::{Style, TerminalPage, json_for_terminal, line_for_terminal};
use gonio_mesh::{Diagnostic, Severity};
use gonio_scene::files::{FileBytes, FileSource};
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// The number of diagnostics that are printed; the rest is counted, so that a model with a thousand missing textures does not
/// scroll everything else away. `--json` has all of them.
const MOST_DIAGNOSTICS: usize = 20;

/// The time after which a progress bar appears.
const PATIENCE: Duration = Duration::from_secs(1);

/// Prints the help for `gonio` without a command where no window can open, and returns the exit code: that of a missing command.
pub fn print_help_without_display(command: &mut clap::Command) -> i32 {
    let help = command.render_help();
    // A closed stderr cannot be reported.
    let _ = writeln!(anstream::stderr(), "{}", help.ansi());
    Reporter::new(&GeneralOptions::default())
        .note("there is no display for the window; `gonio render` draws pictures without one");
    2
}

/// Prints why the arguments were rejected, or the requested help or version, and returns the exit code.
///
/// Messages quote the arguments, so these are parsed once more with hidden characters as escapes.
/// `parse` is the parser that rejected them.
pub fn print_usage_error(error: &clap::Error, parse: impl Fn(Vec<String>) -> Option<clap::Error>) -> i32 {
    // A closed stream cannot be reported.
    if !error.use_stderr() {
        let _ = error.print();
        return error.exit_code();
    }
    let escaped = std::env::args_os().map(|word| line_for_terminal(&word.to_string_lossy())).collect();
    let _ = match parse(escaped) {
        Some(same) if same.kind() == error.kind() => write!(anstream::stderr(), "{}", same.render().ansi()),
        _ => {
            let page = TerminalPage::from_text(&error.render().to_string());
            write!(anstream::stderr(), "{}", page.for_terminal())
        }
    };
    error.exit_code()
}

/// Prints a panic like any other error: its message may quote a file.
pub fn print_panic(panic: &std::panic::PanicHookInfo<'_>) {
    let place = panic.location().map(ToString::to_string).unwrap_or_default();
    let message = panic.payload_as_str().unwrap_or("for an unknown reason");
    let mut page = TerminalPage::new();
    let (red, end) = (Style::Red, Style::Red);
    page.line(format_args!("{red}error{end:#}: gonio panicked at {place}: {message}; this is a bug, please report it"));
    let trace = std::backtrace::Backtrace::capture();
    if trace.status() == std::backtrace::BacktraceStatus::Captured {
        page.text(&trace.to_string());
    }
    let _ = write!(anstream::stderr(), "{}", page.for_terminal());
}

/// Stdout for bytes that another process of gonio reads.
pub fn output_for_gonio() -> impl Write {
    io::stdout().lock()
}

/// Writes bytes to stdout unchanged.
pub fn write_stdout(bytes: &[u8]) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(stdout_error)
}

/// Prints a command's messages and its report.
pub struct Reporter {
    quiet: bool,
    json: bool,
    verbose: bool,
    bars: bool,
}

impl Reporter {
    pub fn new(options: &GeneralOptions) -> Self {
        let &GeneralOptions { quiet, json, verbose, .. } = options;
        Reporter { quiet, json, verbose, bars: !quiet && io::stderr().is_terminal() }
    }

    /// Whether the report is one JSON object.
    pub fn json(&self) -> bool {
        self.json
    }

    pub fn stdout_is_terminal(&self) -> bool {
        io::stdout().is_terminal()
    }

    pub fn error(&self, error: &CliError) {
        match error {
            CliError::Lines(lines) => Self::print_message("error", Style::Red, lines),
            one => Self::print_message("error", Style::Red, &[one]),
        }
    }

    /// Reports a check that failed, which ends in exit code 1.
    pub fn check_failed(&self, message: impl Display) {
        Self::print_message("check failed", Style::Red, &[message]);
    }

    pub fn warning(&self, message: impl Display) {
        if !self.quiet {
            Self::print_message("warning", Style::Yellow, &[message]);
        }
    }

    pub fn note(&self, message: impl Display) {
        if !self.quiet {
            Self::print_message("note", Style::Cyan, &[message]);
        }
    }

    /// Reports a detail that only `--verbose` asks for.
    pub fn verbose(&self, message: impl Display) {
        if self.verbose {
            print_info(message);
        }
    }

    /// Whether `--verbose` was given.
    pub fn is_verbose(&self) -> bool {
        self.verbose
    }

    /// Reports the steps of a command and their times with `--verbose`.
    pub fn verbose_times(&self, times: &Times) {
        if self.verbose {
            let steps = times.list().into_iter().map(|(name, ms)| format!("{} {ms:.1} ms", name.replace('_', " ")));
            self.verbose(format_args!("times: {}", steps.collect::<Vec<_>>().join(", ")));
        }
    }

    /// Wraps a source of files so that each file it reads is reported with `--verbose`.
    pub fn reporting_reads<S>(&self, source: S) -> ReportedReads<S> {
        ReportedReads { source, is_verbose: self.verbose }
    }

    /// Prints diagnostics about files, each with its place.
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

    /// Prints the word before the first line, and the other lines indented.
    fn print_message(word: &str, style: Style, lines: &[impl Display]) {
        let mut page = TerminalPage::new();
        for (index, line) in lines.iter().enumerate() {
            match index {
                0 => page.line(format_args!("{style}{word}{style:#}: {line}")),
                _ => page.line(format_args!("  {line}")),
            }
        }
        // A closed stderr cannot be reported.
        let _ = write!(anstream::stderr(), "{}", page.for_terminal());
    }

    /// Prints the report to stderr, because one of the command's files goes to stdout.
    pub fn text_on_stderr(&self, page: &TerminalPage) {
        if !self.quiet {
            let _ = write!(anstream::stderr(), "{}", page.for_terminal());
        }
    }

    /// Begins a new report: on a terminal, in its upper left corner; elsewhere, after an empty line.
    pub fn begin_again(&self) -> Result<(), CliError> {
        write_stdout(if self.stdout_is_terminal() { b"\x1b[H\x1b[2J\x1b[3J" } else { b"\n" })
    }

    /// Prints the report to stdout, without styles unless stdout is a terminal.
    pub fn text(&self, page: &TerminalPage) -> Result<(), CliError> {
        let mut out = anstream::stdout().lock();
        out.write_all(page.for_terminal().as_bytes()).and_then(|()| out.flush()).map_err(stdout_error)
    }

    /// Prints the report of `--json`: one object, indented.
    pub fn report(&self, value: &impl serde::Serialize) -> Result<(), CliError> {
        write_stdout(json_text(value)?.as_bytes())
    }

    /// A progress bar for work whose progress is known; it appears after a second.
    pub fn progress(&self, label: &'static str) -> Progress {
        let bar = self.bars.then(|| (Instant::now(), Mutex::new(None)));
        Progress { label, bar }
    }

    /// A spinner for work whose progress is not known; it appears after a second, and disappears when the guard is dropped.
    pub fn busy(&self, label: &'static str) -> Busy {
        if !self.bars {
            return Busy { end: None };
        }
        let (end, ended) = mpsc::channel::<()>();
        let watcher = std::thread::spawn(move || {
            if ended.recv_timeout(PATIENCE) == Err(mpsc::RecvTimeoutError::Timeout) {
                let spinner = ProgressBar::new_spinner();
                spinner.set_message(label);
                spinner.enable_steady_tick(Duration::from_millis(100));
                let _ = ended.recv();
                spinner.finish_and_clear();
            }
        });
        Busy { end: Some((end, watcher)) }
    }
}

/// Prints one detail for `--verbose`.
pub fn print_info(message: impl Display) {
    Reporter::print_message("info", Style::Dim, &[message]);
}

/// A report as indented JSON with a newline at the end; characters that a terminal does not show are escaped.
pub fn json_text(value: &impl serde::Serialize) -> Result<String, CliError> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|e| CliError::new(format!("cannot write the report as JSON: {e}")))?;
    Ok(json_for_terminal(&text) + "\n")
}

/// A diagnostic as `FILE:LINE: MESSAGE`, without its severity.
pub fn diagnostic_text(diagnostic: &Diagnostic) -> String {
    let mut text = String::new();
    if let Some(file) = &diagnostic.place.file {
        text.push_str(file);
        if let Some(line) = diagnostic.place.line {
            text.push_str(&format!(":{line}"));
            if let Some(column) = diagnostic.place.column {
                text.push_str(&format!(":{column}"));
            }
        }
        text.push_str(": ");
    } else if let Some(line) = diagnostic.place.line {
        text.push_str(&format!("line {line}: "));
    }
    text + &diagnostic.message + hint(diagnostic.cause)
}

fn stdout_error(error: io::Error) -> CliError {
    match error.kind() {
        io::ErrorKind::BrokenPipe => CliError::ClosedPipe,
        _ => CliError::io("cannot write to stdout", &error),
    }
}

/// A source of files that reports each file it reads with `--verbose`.
pub struct ReportedReads<S> {
    source: S,
    is_verbose: bool,
}

impl<S: FileSource> FileSource for ReportedReads<S> {
    fn read_within(&self, path: &Path, most: u64) -> io::Result<FileBytes> {
        let bytes = self.source.read_within(path, most);
        if self.is_verbose
            && let Ok(bytes) = &bytes
        {
            print_info(format_args!("read `{}`, {} bytes", path.display(), bytes.len()));
        }
        bytes
    }

    fn list(&self, folder: &Path) -> Vec<PathBuf> {
        self.source.list(folder)
    }

    fn builtin(&self, name: &str) -> Option<FileBytes> {
        self.source.builtin(name)
    }

    fn is_coming(&self, name: &str) -> bool {
        self.source.is_coming(name)
    }
}

/// A progress bar, which short work never shows.
pub struct Progress {
    label: &'static str,
    bar: Option<(Instant, Mutex<Option<ProgressBar>>)>,
}

impl Progress {
    /// Sets the share of the work that is done, 0 to 1. Any thread may do so.
    pub fn set(&self, share: f64) {
        let Some((start, bar)) = &self.bar else { return };
        if start.elapsed() < PATIENCE {
            return;
        }
        // Another thread is drawing it.
        let Ok(mut bar) = bar.try_lock() else { return };
        let bar = bar.get_or_insert_with(|| {
            let bar = ProgressBar::new(1000);
            if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:40}] {percent}% {eta}") {
                bar.set_style(style.progress_chars("=> "));
            }
            bar.set_message(self.label);
            bar
        });
        bar.set_position((share.clamp(0.0, 1.0) * 1000.0) as u64);
    }
}

impl Progress {
    /// Replaces the label of a bar that is visible.
    pub fn message(&self, text: String) {
        if let Some((_, bar)) = &self.bar
            && let Ok(bar) = bar.lock()
            && let Some(bar) = &*bar
        {
            bar.set_message(text);
        }
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

/// Milliseconds of the steps of a command by name, in the order in which they ended.
#[derive(Clone, Default)]
pub struct Times {
    steps: Arc<Mutex<Vec<(&'static str, f64)>>>,
}

impl Times {
    /// Runs a step and records its time; steps of one name add up.
    pub fn measure<T>(&self, name: &'static str, step: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = step();
        self.add(name, start.elapsed());
        result
    }

    /// Records a step's time.
    pub fn add(&self, name: &'static str, time: Duration) {
        let ms = time.as_secs_f64() * 1e3;
        let Ok(mut steps) = self.steps.lock() else { return };
        match steps.iter_mut().find(|(known, _)| *known == name) {
            Some((_, total)) => *total += ms,
            None => steps.push((name, ms)),
        }
    }

    fn list(&self) -> Vec<(&'static str, f64)> {
        self.steps.lock().map(|steps| steps.clone()).unwrap_or_default()
    }

    /// The times as a JSON object.
    pub fn to_json(&self) -> serde_json::Value {
        let number = |ms: f64| serde_json::json!((ms * 1e3).round() / 1e3);
        self.list().into_iter().map(|(name, ms)| (name.to_owned(), number(ms))).collect()
    }
}
