//! A check of a student's files, made elsewhere: in a process, in a worker. The window never waits for it.

use gonio_check::verdict::Verdict;

/// What is to be checked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckRequest {
    /// The exercise's word: `ex04`.
    pub exercise: String,
    /// The student's files: names with `/` between folders, and what they hold.
    pub files: Vec<(String, Vec<u8>)>,
    /// Pass what the lab's own solutions do too, where they differ from the textbook.
    pub as_the_lab: bool,
}

/// A check that is under way. Dropping it ends the check.
pub trait Checking {
    /// The verdict, once, when it is there: nothing before, and nothing after it. An error is one sentence: why there is
    /// none. The window is painted again when there is something to ask for.
    fn poll(&mut self) -> Option<Result<Verdict, String>>;
}

/// A check that could not begin.
pub struct Refused(Option<String>);

impl Refused {
    /// Why: one sentence.
    pub fn new(why: impl Into<String>) -> Self {
        Refused(Some(why.into()))
    }
}

impl Checking for Refused {
    fn poll(&mut self) -> Option<Result<Verdict, String>> {
        self.0.take().map(Err)
    }
}
