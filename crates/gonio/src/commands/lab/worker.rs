//! `gonio lab check-worker`: the process that a check runs in (see [`gonio_app::platform::desktop::worker`]).

use super::exercise;
use crate::report::{self, CliError, Outcome};
use gonio_app::platform::desktop::worker::{self, Answer, Request};
use gonio_exercises::Checker;
use gonio_gl::HeadlessContext;
use gonio_gl::headless::HeadlessOptions;

/// Stack of the thread that reads, compiles and draws: drivers recurse along the shader. The system commits only what is used.
const STACK_BYTES: usize = 256 << 20;

/// Reads one request from stdin and writes one answer to stdout.
pub fn run() -> Result<Outcome, CliError> {
    let failed = |error| CliError::io("cannot answer the check", &error);
    worker::serve(std::io::stdin(), report::output_for_gonio(), |request| {
        let checking = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(move || check(request));
        let checking = checking.map_err(|error| format!("cannot start the check: {error}"))?;
        // The panic has been reported on stderr; without an answer the process counts as crashed.
        checking.join().unwrap_or_else(|_| std::process::abort())
    })
    .map_err(failed)?;
    Ok(Outcome::Done)
}

fn check(request: Request) -> Result<Answer, String> {
    let exercise = exercise(&request.exercise).map_err(|error| error.to_string())?;
    let context = HeadlessContext::with_options(&HeadlessOptions { es: request.es, ..Default::default() })
        .map_err(|why| why.message)?;
    let mut checker = Checker::new(context.gl());
    let (mut verdict, evidence) = gonio_exercises::check(&mut checker, exercise, request.files, &request.options)
        .map_err(|error| CliError::from(error).to_string())?;
    // The process ends next, and the system frees it faster.
    std::mem::forget((checker, context));
    verdict.warnings.extend(request.left_out);
    let page =
        request.page.map(|label| gonio_exercises::report::page(&label, &verdict, evidence.as_ref()).into_bytes());
    let sheet =
        evidence.filter(|_| request.sheet).map(|evidence| gonio_exercises::report::contact_sheet(&evidence, &verdict));
    Ok(Answer { verdict, page, sheet })
}
