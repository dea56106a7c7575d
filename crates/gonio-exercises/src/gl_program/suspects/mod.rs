//! Suspected mistakes of a GL program. Each suspect comes with the corrected program; executing that shows whether it is the
//! mistake.

mod picture;
mod textures;
mod vertices;

use gonio_render::gl_program::{CallError, Constant, GlCall, GlProgramRun, ObjectKind, Step, constant};

/// A suspected mistake.
#[derive(Clone, Debug)]
pub struct Suspect {
    /// Its id, one of [`super::names()`].
    pub id: &'static str,
    /// The wrong line; if a call is missing, the line after which it belongs.
    pub line: u32,
    /// The exact error there.
    pub message: String,
    /// The exact text to write.
    pub fix: String,
    /// The program with the mistake fixed.
    pub corrected: Vec<Step>,
}

/// A program that draws the wrong picture, with its run and the reference.
pub struct Case<'a> {
    /// Its calls.
    pub steps: &'a [Step],
    /// The result of running them.
    pub run: &'a GlProgramRun,
    /// The right program.
    pub reference: &'a [Step],
    /// Index of the last draw call; the number of calls if there is none.
    pub draw: usize,
}

impl<'a> Case<'a> {
    /// Creates a case, and finds its last draw call.
    pub fn new(steps: &'a [Step], run: &'a GlProgramRun, reference: &'a [Step]) -> Self {
        let draw = steps.iter().rposition(|step| step.call.draws()).unwrap_or(steps.len());
        Case { steps, run, reference, draw }
    }

    /// All suspects, the most specific ones first.
    pub fn suspects(&self) -> Vec<Suspect> {
        let mut found = Vec::new();
        textures::suspect(self, &mut found);
        vertices::suspect(self, &mut found);
        picture::suspect(self, &mut found);
        found
    }

    /// Calls before the last draw, with their indices.
    fn before(&self) -> impl DoubleEndedIterator<Item = (usize, &'a Step)> {
        self.steps.iter().enumerate().take(self.draw)
    }

    /// The line of a call; the last line if there is no such call.
    fn line(&self, at: usize) -> u32 {
        self.steps.get(at).or(self.steps.last()).map_or(1, |step| step.line)
    }

    /// The error of a rejected call.
    fn refused(&self, at: usize) -> Option<&CallError> {
        let step = self.steps.get(at)?;
        self.run.errors.iter().find(|error| error.line == step.line && error.call == step.call.word())
    }

    /// The names of all objects of a kind.
    fn objects(&self, kind: ObjectKind) -> Vec<&'a str> {
        let name = |step: &'a Step| match &step.call {
            GlCall::Generate { name, kind: made } if *made == kind => Some(name.as_str()),
            _ => None,
        };
        self.steps.iter().filter_map(name).collect()
    }

    /// The first call that satisfies a condition.
    fn first(&self, is: impl Fn(&GlCall) -> bool) -> Option<usize> {
        self.steps.iter().position(|step| is(&step.call))
    }

    /// The last call before the draw that satisfies a condition.
    fn last(&self, is: impl Fn(&GlCall) -> bool) -> Option<usize> {
        self.before().rev().find(|(_, step)| is(&step.call)).map(|(at, _)| at)
    }

    /// The program with a call replaced.
    fn replaced(&self, at: usize, call: GlCall) -> Vec<Step> {
        let mut steps = self.steps.to_vec();
        if let Some(step) = steps.get_mut(at) {
            step.call = call;
        }
        steps
    }

    /// The program without a call.
    fn without(&self, at: usize) -> Vec<Step> {
        let mut steps = self.steps.to_vec();
        if at < steps.len() {
            steps.remove(at);
        }
        steps
    }

    /// The program with calls inserted before the one at an index.
    fn inserted(&self, at: usize, calls: impl IntoIterator<Item = GlCall>) -> Vec<Step> {
        let mut steps = self.steps.to_vec();
        let at = at.min(steps.len());
        let line = self.line(at.saturating_sub(1));
        steps.splice(at..at, calls.into_iter().map(|call| Step { line, call }));
        steps
    }

    /// The program with a call moved before the one at an index.
    fn moved(&self, from: usize, to: usize) -> Vec<Step> {
        let mut steps = self.steps.to_vec();
        if from < steps.len() {
            let step = steps.remove(from);
            let to = if from < to { to - 1 } else { to };
            steps.insert(to.min(steps.len()), step);
        }
        steps
    }

    /// The program with `change` applied to every call, and the index of the first changed call; `None` if none changes.
    fn changed(&self, mut change: impl FnMut(usize, &mut GlCall) -> bool) -> Option<(usize, Vec<Step>)> {
        let mut steps = self.steps.to_vec();
        let mut first = None;
        for (at, step) in steps.iter_mut().enumerate() {
            if change(at, &mut step.call) && first.is_none() {
                first = Some(at);
            }
        }
        first.map(|at| (at, steps))
    }

    /// A suspect at a call.
    fn suspect(
        &self,
        id: &'static str,
        at: usize,
        message: impl Into<String>,
        fix: impl Into<String>,
        corrected: Vec<Step>,
    ) -> Suspect {
        Suspect { id, line: self.line(at), message: message.into(), fix: fix.into(), corrected }
    }
}

/// A constant that is known to exist.
fn known(name: &'static str) -> Constant {
    constant(name).unwrap_or(Constant { name, value: 0 })
}
