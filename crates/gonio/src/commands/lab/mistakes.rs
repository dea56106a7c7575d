//! `gonio lab mistakes`: the catalogue of mistakes.

use crate::error::{CliError, CommandOutcome};
use crate::options::GeneralOptions;
use crate::report::Reporter;
use crate::terminal::{Style, TerminalPage};
use clap::Args;
use gonio_check::mistakes::structural;
use gonio_check::mistakes::{self, Hypotheses, Mistake};

/// List the mistakes that the checker knows, or explain one of them.
#[derive(Args, Debug)]
pub struct MistakesArgs {
    /// Id of the mistake to explain.
    #[arg(value_name = "ID")]
    pub id: Option<String>,
    #[command(flatten)]
    pub general: GeneralOptions,
}

pub fn run(args: &MistakesArgs, reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let Some(id) = &args.id else { return list(reporter) };
    let all = all();
    let Some(mistake) = all.iter().find(|mistake| mistake.id == *id) else {
        let nearest = all.iter().min_by_key(|m| strsim::levenshtein(&m.id, id)).map_or("", |m| &m.id);
        return Err(CliError::new(format!(
            "there is no mistake `{id}`; did you mean `{nearest}`? `gonio lab mistakes` lists them"
        )));
    };
    if reporter.json() {
        reporter.report(mistake)?;
    } else {
        reporter.text(&explanation(mistake))?;
    }
    Ok(CommandOutcome::Done)
}

/// The catalogue's mistakes, and those that are not changes of a line, each kind with its heading.
pub fn by_kind() -> [(&'static str, Vec<Mistake>); 3] {
    [
        ("A quantity that is computed wrongly", mistakes::all().to_vec()),
        ("The program as a whole", structural().to_vec()),
        ("Baking", gonio_exercises::baking::mistakes().to_vec()),
    ]
}

/// All mistakes.
fn all() -> Vec<Mistake> {
    by_kind().into_iter().flat_map(|(_, mistakes)| mistakes).collect()
}

fn list(reporter: &Reporter) -> Result<CommandOutcome, CliError> {
    let all = all();
    if reporter.json() {
        reporter.report(&all)?;
        return Ok(CommandOutcome::Done);
    }
    let (bold, dim) = (Style::Bold, Style::Dim);
    let width = all.iter().map(|m| m.id.len()).max().unwrap_or(0);
    let mut page = TerminalPage::new();
    let mut seen = std::collections::BTreeSet::new();
    for mistake in all.iter().filter(|m| seen.insert(m.id.as_str())) {
        let mark = if mistake.harmless { format!(" {dim}(harmless){dim:#}") } else { String::new() };
        page.line(format_args!("{bold}{:<width$}{bold:#}  {}{mark}", mistake.id, mistake.texts().name));
    }
    reporter.text(&page)?;
    Ok(CommandOutcome::Done)
}

fn explanation(mistake: &Mistake) -> TerminalPage {
    let mut page = TerminalPage::new();
    page.heading(&mistake.id);
    let texts = mistake.texts();
    page.line(format_args!("{}.", texts.name));
    for (heading, text) in [
        ("What it looks like", texts.looks_like.as_ref()),
        ("How to fix it", texts.fix.as_ref()),
        ("In the lecture", mistake.lecture_section.as_str()),
    ] {
        if !text.is_empty() {
            page.heading(heading);
            page.line(format_args!("  {text}"));
        }
    }
    if let Some(model) = mistake.models.first() {
        let hypotheses = Hypotheses::for_model(*model);
        let right = hypotheses.written(&gonio_check::mistakes::Hypothesis::default());
        let this = |h: &&gonio_check::mistakes::Hypothesis| hypotheses.mistakes[h.mistakes[0]].id == mistake.id;
        for hypothesis in hypotheses.singles.iter().filter(this) {
            page.blank();
            for (wrong, right) in hypotheses.written(hypothesis).iter().zip(&right) {
                for (wrong, right) in wrong.lines().zip(right.lines()).filter(|(wrong, right)| wrong != right) {
                    page.line(format_args!("  - {}", wrong.trim()));
                    page.line(format_args!("  + {}", right.trim()));
                }
            }
        }
    }
    page
}
