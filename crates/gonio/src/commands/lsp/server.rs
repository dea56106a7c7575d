//! The server's thread: documents, and what is published about them.

use super::LspOptions;
use super::check::{self, CheckResult, RunningCheck};
use super::diagnostics::{self, FileDiagnostics};
use super::document::OpenDocument;
use super::fix;
use super::hover::{self, HoverAnswer, HoverJob, HoverQuestion};
use super::positions::Lines;
use super::sources::{FolderCache, Sources};
use super::uri::path_of_uri;
use crate::error::CliError;
use gonio_check::verdict::Outcome;
use gonio_language::{Language, tr};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, RequestId, Response};
use lsp_types::notification::{
    DidChangeTextDocument, DidChangeWatchedFiles, DidCloseTextDocument, DidOpenTextDocument, DidSaveTextDocument, Exit,
    Notification as _, PublishDiagnostics, ShowMessage,
};
use lsp_types::request::{CodeActionRequest, HoverRequest, Request as _, Shutdown};
use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOptions, CodeActionOrCommand, CodeActionParams, CodeActionProviderCapability,
    Diagnostic, DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams,
    DidSaveTextDocumentParams, Hover, HoverContents, HoverParams, HoverProviderCapability, InitializeParams,
    MarkupContent, MarkupKind, MessageType, NumberOrString, PublishDiagnosticsParams, Range, ServerCapabilities,
    ShowMessageParams, TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
    TextDocumentSyncSaveOptions, Uri, WorkspaceEdit,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// The pause in typing after which gonio's own front end reads the text.
const READ_AFTER: Duration = Duration::from_millis(80);
/// The pause after which a check starts.
const CHECK_AFTER: Duration = Duration::from_millis(500);

/// How the server ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServerEnd {
    /// By `exit` after `shutdown`.
    AfterShutdown,
    /// By `exit` alone.
    BeforeShutdown,
    /// By the end of its input, or a damaged message.
    WithoutExit,
}

/// What the server's thread waits for.
enum Event {
    Client(Message),
    ClientIsGone,
    Checked { key: String, content: u64, result: CheckResult },
}

/// A pair, or a single shader, with the result of its last check.
struct Unit {
    sources: Sources,
    checked: Option<CheckResult>,
    running: Option<RunningCheck>,
    check_at: Option<Instant>,
}

impl Unit {
    fn has_verdict(&self) -> bool {
        matches!(self.checked, Some(CheckResult::Verdict(_)))
    }
}

/// What the editor can do.
struct Client {
    has_versioned_edits: bool,
    has_markdown: bool,
}

struct Server {
    options: LspOptions,
    client: Client,
    outbox: Sender<Message>,
    events: Sender<Event>,
    hover: Sender<HoverJob>,
    /// Open documents by their URIs.
    documents: BTreeMap<String, OpenDocument>,
    folders: FolderCache,
    units: BTreeMap<String, Unit>,
    /// The unit of each document.
    unit_of: BTreeMap<String, String>,
    published: FileDiagnostics,
    /// The outcome that was reported last, by unit.
    outcomes: BTreeMap<String, Outcome>,
    read_at: Option<Instant>,
    /// Lets one check run at a time.
    turn: Arc<Mutex<()>>,
    has_said_unavailable: bool,
    is_shut_down: bool,
}

/// Serves an editor until it ends.
///
/// # Errors
/// An editor that breaks the protocol before anything else, or threads that cannot be started.
pub fn serve(connection: Connection, options: LspOptions) -> Result<ServerEnd, CliError> {
    let Ok((id, params)) = connection.initialize_start() else { return Ok(ServerEnd::WithoutExit) };
    let params: InitializeParams = match serde_json::from_value(params) {
        Ok(params) => params,
        Err(error) => {
            let text = format!("the parameters of `initialize` cannot be read: {error}");
            let _ = connection.sender.send(Response::new_err(id, INVALID_PARAMS, text.clone()).into());
            return Err(CliError::new(text));
        }
    };
    if let Some(language) = params.locale.as_deref().and_then(Language::from_tag).filter(|_| !options.has_language) {
        language.make_current();
    }
    let result = serde_json::json!({
        "capabilities": capabilities(),
        "serverInfo": { "name": "gonio", "version": crate::commands::about::VERSION },
    });
    if connection.initialize_finish(id, result).is_err() {
        return Ok(ServerEnd::WithoutExit);
    }
    let cannot_start = |error| CliError::io("cannot start a thread of the server", &error);
    let (events, inbox) = channel();
    let (outbox, outgoing) = channel::<Message>();
    let Connection { sender, receiver } = connection;
    let arrivals = events.clone();
    // Neither direction waits for the other: an editor may write before it reads.
    std::thread::Builder::new()
        .spawn(move || outgoing.into_iter().try_for_each(|m| sender.send(m)))
        .map_err(cannot_start)?;
    let forward = move || {
        let _ = receiver.into_iter().try_for_each(|message| arrivals.send(Event::Client(message)));
        let _ = arrivals.send(Event::ClientIsGone);
    };
    std::thread::Builder::new().spawn(forward).map_err(cannot_start)?;
    let capabilities = &params.capabilities;
    let edits = capabilities.workspace.as_ref().and_then(|workspace| workspace.workspace_edit.as_ref());
    let hovers = capabilities.text_document.as_ref().and_then(|document| document.hover.as_ref());
    let formats = hovers.and_then(|hover| hover.content_format.as_ref());
    let server = Server {
        options,
        client: Client {
            has_versioned_edits: edits.and_then(|edit| edit.document_changes).unwrap_or(false),
            has_markdown: formats.is_some_and(|formats| formats.contains(&MarkupKind::Markdown)),
        },
        outbox,
        events,
        hover: hover::start().map_err(cannot_start)?,
        documents: BTreeMap::new(),
        folders: FolderCache::default(),
        units: BTreeMap::new(),
        unit_of: BTreeMap::new(),
        published: FileDiagnostics::new(),
        outcomes: BTreeMap::new(),
        read_at: None,
        turn: Arc::default(),
        has_said_unavailable: false,
        is_shut_down: false,
    };
    Ok(server.run(&inbox))
}

const INVALID_PARAMS: i32 = ErrorCode::InvalidParams as i32;

fn capabilities() -> ServerCapabilities {
    ServerCapabilities {
        text_document_sync: Some(TextDocumentSyncCapability::Options(TextDocumentSyncOptions {
            open_close: Some(true),
            // Shaders are short.
            change: Some(TextDocumentSyncKind::FULL),
            save: Some(TextDocumentSyncSaveOptions::Supported(true)),
            ..TextDocumentSyncOptions::default()
        })),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QUICKFIX]),
            ..CodeActionOptions::default()
        })),
        ..ServerCapabilities::default()
    }
}

impl Server {
    fn run(mut self, inbox: &Receiver<Event>) -> ServerEnd {
        loop {
            let event = match self.next_deadline() {
                None => inbox.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(at) => inbox.recv_timeout(at.saturating_duration_since(Instant::now())),
            };
            match event {
                Ok(Event::Client(Message::Request(request))) => self.request(request),
                Ok(Event::Client(Message::Notification(notification))) if notification.method == Exit::METHOD => {
                    return if self.is_shut_down { ServerEnd::AfterShutdown } else { ServerEnd::BeforeShutdown };
                }
                Ok(Event::Client(Message::Notification(notification))) => self.notification(notification),
                // Nothing is asked of the editor.
                Ok(Event::Client(Message::Response(_))) | Err(RecvTimeoutError::Timeout) => {}
                Ok(Event::Checked { key, content, result }) => self.checked(&key, content, result),
                Ok(Event::ClientIsGone) | Err(RecvTimeoutError::Disconnected) => return ServerEnd::WithoutExit,
            }
            self.work();
        }
    }

    fn next_deadline(&self) -> Option<Instant> {
        self.units.values().filter_map(|unit| unit.check_at).chain(self.read_at).min()
    }

    /// Does what is due.
    fn work(&mut self) {
        let now = Instant::now();
        if self.read_at.is_some_and(|at| at <= now) {
            self.refresh();
        }
        let due = |unit: &Unit| unit.check_at.is_some_and(|at| at <= now);
        let keys: Vec<String> = self.units.iter().filter(|(_, unit)| due(unit)).map(|(key, _)| key.clone()).collect();
        for key in keys {
            self.start_check(&key);
        }
    }

    fn notify<N: lsp_types::notification::Notification>(&self, params: N::Params)
    where
        N::Params: Serialize,
    {
        // If the editor has gone, so has the reader of this.
        let _ = self.outbox.send(Notification::new(N::METHOD.to_owned(), params).into());
    }

    fn show(&self, typ: MessageType, message: String) {
        self.notify::<ShowMessage>(ShowMessageParams { typ, message });
    }

    fn notification(&mut self, notification: Notification) {
        match notification.method.as_str() {
            DidOpenTextDocument::METHOD => {
                let Some(params) = read::<DidOpenTextDocumentParams>(notification.params) else { return };
                let opened = params.text_document;
                let path = path_of_uri(&opened.uri);
                let key = opened.uri.as_str().to_owned();
                let document = OpenDocument { uri: opened.uri, path, version: opened.version, text: opened.text };
                self.documents.insert(key, document);
                self.read_again();
            }
            DidChangeTextDocument::METHOD => {
                let Some(params) = read::<DidChangeTextDocumentParams>(notification.params) else { return };
                let Some(document) = self.documents.get_mut(params.text_document.uri.as_str()) else { return };
                document.version = params.text_document.version;
                // Each change has the whole text.
                if let Some(last) = params.content_changes.into_iter().next_back() {
                    document.text = last.text;
                }
                self.read_at = Some(Instant::now() + READ_AFTER);
            }
            DidSaveTextDocument::METHOD => {
                let Some(params) = read::<DidSaveTextDocumentParams>(notification.params) else { return };
                self.read_again();
                let unit = self.unit_of.get(params.text_document.uri.as_str()).and_then(|key| self.units.get_mut(key));
                if let Some(unit) = unit.filter(|unit| unit.running.is_none() && !unit.has_verdict()) {
                    unit.check_at = Some(Instant::now());
                }
            }
            DidCloseTextDocument::METHOD => {
                let Some(params) = read::<DidCloseTextDocumentParams>(notification.params) else { return };
                self.documents.remove(params.text_document.uri.as_str());
                self.read_again();
            }
            DidChangeWatchedFiles::METHOD => self.read_again(),
            _ => {}
        }
    }

    /// Reads folders and documents at once.
    fn read_again(&mut self) {
        self.folders.clear();
        self.refresh();
    }

    /// Finds the shaders of all documents, and publishes what changed. Checks of texts that have changed are given up.
    fn refresh(&mut self) {
        self.read_at = None;
        let (mut found, mut unit_of) = (BTreeMap::new(), BTreeMap::new());
        for (uri, document) in &self.documents {
            let sources = Sources::of(document, &self.documents, self.options.exercise, &mut self.folders);
            unit_of.insert(uri.clone(), sources.key.clone());
            found.insert(sources.key.clone(), sources);
        }
        let mut before = std::mem::take(&mut self.units);
        for (key, sources) in found {
            let unit = match before.remove(&key) {
                Some(unit) if unit.sources.content == sources.content => Unit { sources, ..unit },
                old => {
                    let delay = if old.is_some() { CHECK_AFTER } else { Duration::ZERO };
                    // While a shader is being written, saving it asks for the driver's opinion.
                    let is_checked = sources.exercise.is_some() && (old.is_none() || !sources.has_errors());
                    let check_at = is_checked.then(|| Instant::now() + delay);
                    Unit { sources, checked: None, running: None, check_at }
                }
            };
            self.units.insert(key, unit);
        }
        self.unit_of = unit_of;
        self.outcomes.retain(|key, _| self.units.contains_key(key));
        self.publish();
    }

    fn start_check(&mut self, key: &str) {
        let Some(unit) = self.units.get_mut(key) else { return };
        unit.check_at = None;
        let (events, content, of) = (self.events.clone(), unit.sources.content, key.to_owned());
        let done = move |result| {
            let _ = events.send(Event::Checked { key: of, content, result });
        };
        match check::start(&self.options, &unit.sources, &self.turn, done) {
            Ok(running) => unit.running = running,
            Err(error) => self.show(MessageType::ERROR, tr!("editor-unavailable", reason = error)),
        }
    }

    /// Takes the result of a check, unless its text has changed.
    fn checked(&mut self, key: &str, content: u64, result: CheckResult) {
        let Some(unit) = self.units.get_mut(key).filter(|unit| unit.sources.content == content) else { return };
        unit.running = None;
        match &result {
            CheckResult::Verdict(verdict) => {
                let before = self.outcomes.insert(key.to_owned(), verdict.verdict);
                let text = tr!("editor-correct", exercise = verdict.exercise, summary = verdict.summary);
                unit.checked = Some(result);
                if before.is_some_and(|before| before != Outcome::Correct)
                    && self.outcomes.get(key) == Some(&Outcome::Correct)
                {
                    self.show(MessageType::INFO, text);
                }
            }
            CheckResult::Unavailable { reason, .. } => {
                let text = tr!("editor-unavailable", reason = reason);
                unit.checked = Some(result);
                if !std::mem::replace(&mut self.has_said_unavailable, true) {
                    self.show(MessageType::WARNING, text);
                }
            }
        }
        self.publish();
    }

    /// Sends the diagnostics of files where they have changed, and of changed documents, which they are then about.
    fn publish(&mut self) {
        let mut all = FileDiagnostics::new();
        for unit in self.units.values() {
            for (uri, found) in diagnostics::of_sources(&unit.sources, unit.checked.as_ref(), &self.documents) {
                let known = all.entry(uri).or_default();
                let new: Vec<Diagnostic> = found.into_iter().filter(|diagnostic| !known.contains(diagnostic)).collect();
                known.extend(new);
            }
        }
        let gone = self.published.iter().filter(|(uri, known)| !all.contains_key(*uri) && !known.is_empty());
        let emptied: Vec<String> = gone.map(|(uri, _)| uri.clone()).collect();
        for (uri, diagnostics) in emptied.into_iter().map(|uri| (uri, Vec::new())).chain(all.clone()) {
            let document = self.documents.get(&uri);
            if document.is_none() && self.published.get(&uri).map_or(&[][..], Vec::as_slice) == diagnostics {
                continue;
            }
            let version = document.map(|document| document.version);
            let Ok(uri) = uri.parse() else { continue };
            self.notify::<PublishDiagnostics>(PublishDiagnosticsParams { uri, diagnostics, version });
        }
        self.published = all;
    }

    fn request(&mut self, request: Request) {
        let Request { id, method, params } = request;
        if self.is_shut_down {
            let text = "the server was shut down".to_owned();
            return self.answer(Response::new_err(id, ErrorCode::InvalidRequest as i32, text));
        }
        match method.as_str() {
            Shutdown::METHOD => {
                self.is_shut_down = true;
                self.answer(Response::new_ok(id, ()));
            }
            HoverRequest::METHOD => match read(params) {
                Some(params) => self.hover(id, &params),
                None => self.refuse(id, &method),
            },
            CodeActionRequest::METHOD => match read(params) {
                Some(params) => {
                    let actions = self.code_actions(&params);
                    self.answer(Response::new_ok(id, actions));
                }
                None => self.refuse(id, &method),
            },
            _ => {
                let text = format!("gonio does not know the request `{method}`");
                self.answer(Response::new_err(id, ErrorCode::MethodNotFound as i32, text));
            }
        }
    }

    fn refuse(&self, id: RequestId, method: &str) {
        let text = format!("the parameters of `{method}` cannot be read");
        self.answer(Response::new_err(id, INVALID_PARAMS, text));
    }

    fn answer(&self, response: Response) {
        let _ = self.outbox.send(response.into());
    }

    /// The unit of a document, up to date with its text.
    fn unit(&mut self, uri: &Uri) -> Option<(&OpenDocument, &Unit)> {
        if self.read_at.is_some() {
            self.refresh();
        }
        Some((self.documents.get(uri.as_str())?, self.units.get(self.unit_of.get(uri.as_str())?)?))
    }

    fn hover(&mut self, id: RequestId, params: &HoverParams) {
        let place = &params.text_document_position_params;
        let Some((document, unit)) = self.unit(&place.text_document.uri) else {
            return self.answer(Response::new_ok(id, Option::<Hover>::None));
        };
        let text = document.text.clone();
        let at = Lines::new(&text).place(place.position);
        let question = HoverQuestion { file: unit.sources.name_of(document), sources: unit.sources.clone(), at };
        let (outbox, has_markdown) = (self.outbox.clone(), self.client.has_markdown);
        let answer = move |found: Option<HoverAnswer>| {
            let hover = found.map(|found| in_markup(&found, &Lines::new(&text), has_markdown));
            let _ = outbox.send(Response::new_ok(id, hover).into());
        };
        // Its thread ends with the server.
        let _ = self.hover.send((question, Box::new(answer)));
    }

    /// The proposed fix at the mistakes that it mends, and the right spelling of names.
    fn code_actions(&mut self, params: &CodeActionParams) -> Vec<CodeActionOrCommand> {
        let kinds = params.context.only.as_deref();
        // An empty kind contains all.
        let is_asked = |kind: &CodeActionKind| kind.as_str().is_empty() || *kind == CodeActionKind::QUICKFIX;
        if kinds.is_some_and(|kinds| !kinds.iter().any(is_asked)) {
            return Vec::new();
        }
        let has_versions = self.client.has_versioned_edits;
        let uri = &params.text_document.uri;
        if self.unit(uri).is_none() {
            return Vec::new();
        }
        let here = |diagnostic: &&Diagnostic| overlap(diagnostic.range, params.range);
        let published = self.published.get(uri.as_str()).into_iter().flatten();
        let diagnostics: Vec<&Diagnostic> = published.filter(here).collect();
        let Some((document, unit)) = self.documents.get(uri.as_str()).zip(self.unit_at(uri)) else { return Vec::new() };
        let file = unit.sources.name_of(document);
        let lines = Lines::new(&document.text);
        let problems = unit.sources.problems.iter().filter(|problem| problem.file == file);
        let mut actions: Vec<CodeActionOrCommand> = problems
            .filter_map(|problem| {
                let range = lines.range(problem.start, problem.end);
                let is_it =
                    |diagnostic: &&&Diagnostic| diagnostic.range == range && code_of(diagnostic) == Some(problem.code);
                let diagnostic = diagnostics.iter().find(is_it)?;
                let renaming = problem.renaming.as_ref()?;
                let edit = fix::renaming_edit(renaming, document, has_versions)?;
                Some(quick_fix(tr!("editor-rename", name = renaming.name), vec![(*diagnostic).clone()], edit))
            })
            .collect();
        if let Some(CheckResult::Verdict(verdict)) = &unit.checked {
            let is_mistake =
                |diagnostic: &&&Diagnostic| verdict.mistakes.iter().any(|m| code_of(diagnostic) == Some(&m.id));
            let mended: Vec<Diagnostic> = diagnostics.iter().filter(is_mistake).map(|found| (*found).clone()).collect();
            if !mended.is_empty() && !verdict.proposed_fix.is_empty() {
                let edit = fix::workspace_edit(&verdict.proposed_fix, &unit.sources, &self.documents, has_versions);
                actions.extend(edit.map(|edit| quick_fix(tr!("editor-fix").to_owned(), mended, edit)));
            }
        }
        actions
    }

    fn unit_at(&self, uri: &Uri) -> Option<&Unit> {
        self.units.get(self.unit_of.get(uri.as_str())?)
    }
}

fn quick_fix(title: String, diagnostics: Vec<Diagnostic>, edit: WorkspaceEdit) -> CodeActionOrCommand {
    CodeActionOrCommand::CodeAction(CodeAction {
        title,
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(diagnostics),
        edit: Some(edit),
        is_preferred: Some(true),
        ..CodeAction::default()
    })
}

fn code_of(diagnostic: &Diagnostic) -> Option<&str> {
    match &diagnostic.code {
        Some(NumberOrString::String(code)) => Some(code),
        _ => None,
    }
}

/// Whether two ranges have a line in common: editors ask for the cursor's place.
fn overlap(a: Range, b: Range) -> bool {
    a.start.line <= b.end.line && b.start.line <= a.end.line
}

fn in_markup(answer: &HoverAnswer, lines: &Lines<'_>, has_markdown: bool) -> Hover {
    let sentences = answer.sentences.iter().map(|sentence| format!("\n\n{sentence}"));
    let (kind, begin) = match has_markdown {
        true => (MarkupKind::Markdown, format!("```glsl\n{}\n```", answer.declaration)),
        false => (MarkupKind::PlainText, answer.declaration.clone()),
    };
    let value = begin + &sentences.collect::<String>();
    Hover {
        contents: HoverContents::Markup(MarkupContent { kind, value }),
        range: Some(lines.range(answer.start, answer.end)),
    }
}

/// The parameters of a message. Those of a notification that cannot be read are ignored, as the protocol asks.
fn read<T: DeserializeOwned>(params: serde_json::Value) -> Option<T> {
    serde_json::from_value(params).ok()
}
