//! What may be wrong with a GL program, and what it would be without that: each suspicion comes with the program as it
//! would be corrected. Whether it is the mistake is told by carrying that out.

mod picture;
mod textures;
mod vertices;

use gonio_render::gl_program::{CallError, Constant, GlCall, GlProgramRun, ObjectKind, Step, constant};

/// A mistake that is suspected.
#[derive(Clone, Debug)]
pub struct Suspect {
    /// Its word, one of `names`.
    pub id: &'static str,
    /// The line that is wrong; where a call is missing, the line after which it is.
    pub line: u32,
    /// The exact error there.
    pub said: String,
    /// The exact text to write.
    pub fix: String,
    /// The program with the mistake fixed.
    pub corrected: Vec<Step>,
}

/// A program that draws the wrong picture, and what is known of it.
pub struct Case<'a> {
    /// Its calls.
    pub steps: &'a [Step],
    /// What came of them.
    pub run: &'a GlProgramRun,
    /// The program that is right.
    pub reference: &'a [Step],
    /// The place of the last draw call; where there is none, the end.
    pub draw: usize,
}

impl<'a> Case<'a> {
    /// Takes note of where it draws.
    pub fn new(steps: &'a [Step], run: &'a GlProgramRun, reference: &'a [Step]) -> Self {
        let draw = steps.iter().rposition(|step| step.call.draws()).unwrap_or(steps.len());
        Case { steps, run, reference, draw }
    }

    /// All suspicions: those that fit one case only come first.
    pub fn suspects(&self) -> Vec<Suspect> {
        let mut found = Vec::new();
        textures::suspect(self, &mut found);
        vertices::suspect(self, &mut found);
        picture::suspect(self, &mut found);
        found
    }

    /// Calls before the last draw, with their places.
    fn before(&self) -> impl DoubleEndedIterator<Item = (usize, &'a Step)> {
        self.steps.iter().enumerate().take(self.draw)
    }

    /// The line of a call; of the end, the last one.
    fn line(&self, at: usize) -> u32 {
        self.steps.get(at).or(self.steps.last()).map_or(1, |step| step.line)
    }

    /// Why a call was refused, where it was.
    fn refused(&self, at: usize) -> Option<&CallError> {
        let step = self.steps.get(at)?;
        self.run.errors.iter().find(|error| error.line == step.line && error.call == step.call.word())
    }

    /// What holds the numbers of all objects of a kind.
    fn objects(&self, kind: ObjectKind) -> Vec<&'a str> {
        let name = |step: &'a Step| match &step.call {
            GlCall::Generate { name, kind: made } if *made == kind => Some(name.as_str()),
            _ => None,
        };
        self.steps.iter().filter_map(name).collect()
    }

    /// The first call of some sort.
    fn first(&self, is: impl Fn(&GlCall) -> bool) -> Option<usize> {
        self.steps.iter().position(|step| is(&step.call))
    }

    /// The last call of some sort before the draw.
    fn last(&self, is: impl Fn(&GlCall) -> bool) -> Option<usize> {
        self.before().rev().find(|(_, step)| is(&step.call)).map(|(at, _)| at)
    }

    /// The program with another call in a place.
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

    /// The program with calls put in before the one that is in a place.
    fn inserted(&self, at: usize, calls: impl IntoIterator<Item = GlCall>) -> Vec<Step> {
        let mut steps = self.steps.to_vec();
        let at = at.min(steps.len());
        let line = self.line(at.saturating_sub(1));
        steps.splice(at..at, calls.into_iter().map(|call| Step { line, call }));
        steps
    }

    /// The program with a call moved before the one that is in a place.
    fn moved(&self, from: usize, to: usize) -> Vec<Step> {
        let mut steps = self.steps.to_vec();
        if from < steps.len() {
            let step = steps.remove(from);
            let to = if from < to { to - 1 } else { to };
            steps.insert(to.min(steps.len()), step);
        }
        steps
    }

    /// The program with every call changed that `change` changes; `None` where it changes none. With the first of them.
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

    /// A suspicion at a call.
    fn suspect(
        &self,
        id: &'static str,
        at: usize,
        said: impl Into<String>,
        fix: impl Into<String>,
        corrected: Vec<Step>,
    ) -> Suspect {
        Suspect { id, line: self.line(at), said: said.into(), fix: fix.into(), corrected }
    }
}

/// A constant that is known to be there.
fn known(name: &'static str) -> Constant {
    constant(name).unwrap_or(Constant { name, value: 0 })
}
