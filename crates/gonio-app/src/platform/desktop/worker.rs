//! A check in a worker process, for single checks and batches of the command line and for the window.
//!
//! The worker reads the files from its standard input and answers on its standard output, one request after the other; it opens no
//! file but those of a course, and writes none. Its input stays open as long as the parent wants answers. When the parent
//! ends, for any reason, the worker reads the end of its input and ends too. Both messages are a header (its length as 4
//! little-endian bytes, then JSON) followed by the bytes whose lengths the header states.

use super::child::{self, Ended, Waited};
use gonio_check::CheckOptions;
use gonio_check::feedback::Feedback;
use gonio_check::submission::SourceFile;
use gonio_check::verdict::Verdict;
use gonio_exercises::exercise::course_folder;
use gonio_exercises::report::SubmissionThumbnail;
use gonio_language::{Language, tr};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::{Error, ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// The hidden command of `gonio` that calls [`serve`].
pub const COMMAND: [&str; 2] = ["lab", "check-worker"];

/// Most bytes of a header, which contains the verdict with its quotes.
const MAX_HEADER_BYTES: u64 = 64 << 20;
/// Most bytes of an answer, with a page and its pictures.
const MAX_ANSWER_BYTES: u64 = 512 << 20;

/// A request for a check.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WorkerRequest {
    /// The id of the exercise: `ex04`.
    pub exercise: String,
    /// The submission.
    pub files: Vec<SourceFile>,
    /// Sentences on files of the submission that were left out; they become warnings of the verdict.
    pub left_out: Vec<String>,
    /// See [`CheckOptions`].
    pub options: CheckOptions,
    /// How much of the verdict is shown; `None` for the exercise's own setting.
    pub feedback: Option<Feedback>,
    /// OpenGL ES 3 instead of OpenGL.
    pub es: bool,
    /// The title of the requested page, if any.
    pub page: Option<String>,
    /// Whether the contact sheet is requested.
    pub sheet: bool,
}

/// The answer to a request.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkerAnswer {
    /// The verdict.
    pub verdict: Verdict,
    /// The verdict as a web page, if it was requested and could be created.
    pub page: Option<Vec<u8>>,
    /// The most telling pictures, if a page was requested and something was drawn.
    pub thumbnail: Option<SubmissionThumbnail>,
    /// The contact sheet as PNG, if it was requested and something was drawn.
    pub sheet: Option<Vec<u8>>,
}

#[derive(Serialize, Deserialize)]
struct RequestHeader {
    exercise: String,
    files: Vec<(String, u64)>,
    left_out: Vec<String>,
    pair: Option<String>,
    as_the_lab: bool,
    feedback: Option<Feedback>,
    es: bool,
    page: Option<String>,
    sheet: bool,
}

#[derive(Serialize, Deserialize)]
struct AnswerHeader {
    verdict: Result<Verdict, String>,
    page: Option<u64>,
    thumbnail: Option<SubmissionThumbnail>,
    sheet: Option<u64>,
}

/// An answer as it is read: `None` if the process ended without one, or else why it could not be read.
type AnswerRead = Result<Option<WorkerAnswer>, String>;

/// A worker process. It ends with this value.
pub struct Worker {
    child: Child,
    requests: Sender<WorkerRequest>,
    answers: Receiver<AnswerRead>,
    /// The exercise of the last request.
    exercise: String,
    is_alive: bool,
}

/// Starts `program` on a request. With `one_core`, driver and checker use one core, for one of many processes.
///
/// # Errors
/// Those of starting a process.
pub fn start(program: &Path, request: WorkerRequest, one_core: bool) -> Result<Worker, Error> {
    let mut command = child::command(program)?;
    match one_core {
        true => command.env("RAYON_NUM_THREADS", "1"),
        false => command.env_remove("LP_NUM_THREADS"),
    };
    // A software driver optimises shaders for many pixels; a check draws few, and compiles much.
    command.env("GALLIVM_PERF", "nopt").env("LP_NATIVE_VECTOR_WIDTH", "128");
    command.args(COMMAND).args(["--language", Language::current().code()]).stdin(Stdio::piped()).stdout(Stdio::piped());
    command.args(course_options());
    let mut child = command.spawn()?;
    let (Some(mut input), Some(mut output)) = (child.stdin.take(), child.stdout.take()) else {
        return Err(Error::other(tr!("window-the-process-has-no-input-or")));
    };
    let (requests, asked) = channel::<WorkerRequest>();
    std::thread::spawn(move || {
        // The input stays open between requests, because its end would end the worker. A failure to write is ignored: the worker
        // may have answered before it had read everything.
        for request in asked {
            let _ = write_request(&mut input, &request).and_then(|()| input.flush());
        }
    });
    let (answered, answers) = channel();
    std::thread::spawn(move || {
        loop {
            let answer = read_answer(&mut output);
            let is_last = !matches!(answer, Ok(Some(_)));
            if answered.send(answer).is_err() || is_last {
                return;
            }
        }
    });
    let mut worker = Worker { child, requests, answers, exercise: String::new(), is_alive: true };
    worker.ask(request);
    Ok(worker)
}

/// The options with which a process of gonio's own knows the course of this one.
pub(super) fn course_options() -> Vec<std::ffi::OsString> {
    course_folder().map_or(Vec::new(), |folder| vec!["--course".into(), folder.into()])
}

impl Worker {
    /// Asks for another check, once the last one was answered.
    pub fn ask(&mut self, request: WorkerRequest) {
        self.exercise.clone_from(&request.exercise);
        // If the process has ended, the wait for the answer tells.
        let _ = self.requests.send(request);
    }

    /// Whether another check can be asked for: the last one did not end the process.
    #[must_use]
    pub fn is_alive(&self) -> bool {
        self.is_alive
    }

    /// Waits for the answer. A check that takes too long or too much memory, or that crashes its process, has a verdict on
    /// that.
    ///
    /// # Errors
    /// The reason why there is no verdict, in one sentence.
    pub fn wait(&mut self, patience: Duration, given_up: impl Fn() -> bool) -> Result<WorkerAnswer, String> {
        let answer = |interval| match self.answers.recv_timeout(interval) {
            Ok(answer) => answer.transpose(),
            Err(RecvTimeoutError::Timeout) => None,
            // Its output has ended, and so does the process.
            Err(RecvTimeoutError::Disconnected) => {
                std::thread::sleep(interval);
                None
            }
        };
        let waited = child::wait_for(&mut self.child, patience, child::MOST_RESIDENT_KB, given_up, answer);
        self.is_alive = matches!(waited, Ok(Waited::Answered(Ok(_))));
        let without_pictures = |verdict| Ok(WorkerAnswer { verdict, page: None, thumbnail: None, sheet: None });
        let ended = match waited.map_err(|error| tr!("window-the-check-could-not-be-monitored", error = error))? {
            Waited::Answered(answer) => return answer,
            Waited::Ended(ended) => ended,
        };
        match ended {
            Ended::TooLong => without_pictures(Verdict::endless(&self.exercise, patience.as_secs())),
            Ended::TooLarge => without_pictures(Verdict::too_large(&self.exercise)),
            Ended::GivenUp => Err(tr!("window-the-check-was-stopped").into()),
            Ended::ByItself(status) => match self.answers.recv().unwrap_or(Ok(None))? {
                Some(answer) => Ok(answer),
                None if status.code().is_none_or(is_crash) => without_pictures(Verdict::crashed(&self.exercise)),
                None => Err(tr!("window-the-check-ended-without-an-answer").into()),
            },
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        child::stop(&mut self.child);
    }
}

/// Whether an exit code means a crash: those of Windows (0xC0000005 and similar), which has no signals, and those of Rust for
/// exhausted memory and panics.
fn is_crash(code: i32) -> bool {
    code < 0 || code == 101 || code == 134
}

/// Answers requests in the worker process until the input ends. `check` checks a submission; `at_end` is called once the input
/// has ended, perhaps during a check.
///
/// # Errors
/// Those of the two pipes; the parent sees the end of the process.
pub fn serve(
    mut input: impl Read + Send + 'static,
    mut output: impl Write,
    mut check: impl FnMut(WorkerRequest) -> Result<WorkerAnswer, String>,
    at_end: impl FnOnce() + Send + 'static,
) -> Result<(), Error> {
    let (read, requests) = channel();
    std::thread::spawn(move || {
        while let Ok(request) = read_request(&mut input) {
            if read.send(request).is_err() {
                return;
            }
        }
        at_end();
    });
    for request in requests {
        write_answer(&mut output, check(request))?;
    }
    Ok(())
}

fn write_answer(output: &mut impl Write, answer: Result<WorkerAnswer, String>) -> Result<(), Error> {
    let length = |bytes: &Option<Vec<u8>>| bytes.as_ref().map(|bytes| bytes.len() as u64);
    let (header, page, sheet) = match answer {
        Ok(WorkerAnswer { verdict, page, thumbnail, sheet }) => {
            let (page_length, sheet_length) = (length(&page), length(&sheet));
            (AnswerHeader { verdict: Ok(verdict), page: page_length, thumbnail, sheet: sheet_length }, page, sheet)
        }
        Err(error) => (AnswerHeader { verdict: Err(error), page: None, thumbnail: None, sheet: None }, None, None),
    };
    write_header(output, &header)?;
    for bytes in [page, sheet].into_iter().flatten() {
        output.write_all(&bytes)?;
    }
    output.flush()
}

/// Waits for the end of the input, and then ends the process.
pub fn end_with(mut input: impl Read) {
    let _ = input.read(&mut [0]);
    // `exit` would wait for the driver.
    std::process::abort();
}

/// Encodes a request for [`read_request`].
///
/// # Errors
/// A header beyond 4 GiB.
pub fn encoded(request: &WorkerRequest) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    write_request(&mut bytes, request)?;
    Ok(bytes)
}

fn write_request(output: &mut impl Write, request: &WorkerRequest) -> Result<(), Error> {
    let header = RequestHeader {
        exercise: request.exercise.clone(),
        files: request.files.iter().map(|file| (file.name.clone(), file.bytes.len() as u64)).collect(),
        left_out: request.left_out.clone(),
        pair: request.options.pair.clone(),
        as_the_lab: request.options.as_the_lab,
        feedback: request.feedback,
        es: request.es,
        page: request.page.clone(),
        sheet: request.sheet,
    };
    write_header(output, &header)?;
    request.files.iter().try_for_each(|file| output.write_all(&file.bytes))
}

/// Reads a request that was written by [`encoded`].
///
/// # Errors
/// Those of the input, and an input that ends too early or has another format.
pub fn read_request(input: &mut impl Read) -> Result<WorkerRequest, Error> {
    let header: RequestHeader = read_header(input)?.ok_or(ErrorKind::UnexpectedEof)?;
    let read = |(name, length): (String, u64)| Ok(SourceFile { name, bytes: read_exactly(input, length)? });
    Ok(WorkerRequest {
        files: header.files.into_iter().map(read).collect::<Result<_, Error>>()?,
        exercise: header.exercise,
        left_out: header.left_out,
        options: CheckOptions { pair: header.pair, as_the_lab: header.as_the_lab },
        feedback: header.feedback,
        es: header.es,
        page: header.page,
        sheet: header.sheet,
    })
}

/// Reads the answer; `None` if the worker ended without one. An error is one sentence.
fn read_answer(output: &mut impl Read) -> AnswerRead {
    let mut output = output.take(MAX_ANSWER_BYTES);
    let unreadable = |error: Error| tr!("window-the-answer-of-the-check-could", error = error);
    let header = match read_header::<AnswerHeader>(&mut output) {
        Ok(Some(header)) => header,
        Ok(None) => return Ok(None),
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => return Ok(None),
        Err(error) => return Err(unreadable(error)),
    };
    let mut read = |length: Option<u64>| length.map(|length| read_exactly(&mut output, length)).transpose();
    let (page, sheet) = (read(header.page), read(header.sheet));
    Ok(Some(WorkerAnswer {
        verdict: header.verdict?,
        thumbnail: header.thumbnail,
        page: page.map_err(unreadable)?,
        sheet: sheet.map_err(unreadable)?,
    }))
}

fn write_header(output: &mut impl Write, header: &impl Serialize) -> Result<(), Error> {
    let text = serde_json::to_vec(header)?;
    let length = u32::try_from(text.len()).map_err(Error::other)?;
    output.write_all(&length.to_le_bytes())?;
    output.write_all(&text)
}

/// Reads a header; `None` at the end of the input.
fn read_header<T: DeserializeOwned>(input: &mut impl Read) -> Result<Option<T>, Error> {
    let mut length = [0; 4];
    let first = input.read(&mut length)?;
    if first == 0 {
        return Ok(None);
    }
    input.read_exact(&mut length[first..])?;
    let length = u64::from(u32::from_le_bytes(length));
    if length > MAX_HEADER_BYTES {
        return Err(Error::other("its header is too long"));
    }
    Ok(Some(serde_json::from_slice(&read_exactly(input, length)?)?))
}

/// Reads `length` bytes. Memory grows with the bytes that arrive, not with the announced length.
fn read_exactly(input: &mut impl Read, length: u64) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    input.take(length).read_to_end(&mut bytes)?;
    if bytes.len() as u64 == length { Ok(bytes) } else { Err(ErrorKind::UnexpectedEof.into()) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use gonio_check::verdict::Outcome;

    fn request() -> WorkerRequest {
        WorkerRequest {
            exercise: "ex04".into(),
            files: vec![SourceFile::new("a.vert", "void main() {}"), SourceFile::new("\u{fffd}/b.frag", [0, 255])],
            left_out: vec!["c.png: too large".into()],
            options: CheckOptions { pair: Some("phong".into()), as_the_lab: true },
            feedback: Some(Feedback::Name),
            es: true,
            page: Some("anna".into()),
            sheet: true,
        }
    }

    #[test]
    fn requests_and_answers_arrive_as_they_were_sent() {
        let (mut sent, mut received) = (Vec::new(), Vec::new());
        write_request(&mut sent, &request()).unwrap();
        let answer = WorkerAnswer {
            verdict: Verdict::new("ex04", Outcome::Wrong, "as asked"),
            page: Some(b"<html>".to_vec()),
            thumbnail: Some(SubmissionThumbnail {
                scene: "lab".into(),
                yours: "data:a".into(),
                reference: None,
                pixels_beyond: 0.25,
            }),
            sheet: None,
        };
        let answered = answer.clone();
        // One request after the other, until the input ends.
        let twice = std::io::Cursor::new(sent.clone()).chain(std::io::Cursor::new(sent.clone()));
        let (ended, end) = channel();
        let check = |got| {
            assert_eq!(got, request());
            Ok(answered.clone())
        };
        serve(twice, &mut received, check, move || ended.send(()).unwrap()).unwrap();
        end.recv().unwrap();
        let mut both = received.as_slice();
        assert_eq!(read_answer(&mut both), Ok(Some(answer.clone())));
        assert_eq!(received.len(), 2 * both.len());
        assert_eq!(read_answer(&mut both), Ok(Some(answer)));
        assert_eq!(read_answer(&mut both), Ok(None));
        received.truncate(received.len() / 2);
        for length in 0..received.len() {
            let cut = read_answer(&mut &received[..length]);
            assert!(matches!(cut, Ok(None) | Err(_)), "cut at {length}: {cut:?}");
        }
        for length in 0..sent.len() {
            assert!(read_request(&mut &sent[..length]).is_err(), "cut at {length}");
        }
    }

    /// The answer of another program in place of gonio.
    fn asked_of(program: &str) -> Result<WorkerAnswer, String> {
        start(Path::new(program), request(), true).unwrap().wait(Duration::from_secs(20), || false)
    }

    #[test]
    #[cfg(unix)]
    fn a_program_without_an_answer_is_an_error() {
        assert_eq!(asked_of("/bin/false").map_err(|error| error.contains("without an answer")), Err(true));
        assert_eq!(asked_of("/bin/echo").map_err(|error| error.contains("could not be understood")), Err(true));
        assert!(start(Path::new("/nowhere/gonio"), request(), true).is_err());
    }
}
