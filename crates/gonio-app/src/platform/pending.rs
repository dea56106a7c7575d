//! Results of work that runs elsewhere, in a process or a worker. The window never waits for them.

use gonio_check::verdict::Verdict;

/// A student's files to check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckRequest {
    /// The id of the exercise: `ex04`.
    pub exercise: String,
    /// The student's files: names with `/` between folders, and contents.
    pub files: Vec<(String, Vec<u8>)>,
    /// Accept what the lab's own solutions do too, where they differ from the textbook.
    pub as_the_lab: bool,
}

/// The verdict, or one sentence on why there is none.
pub type CheckResult = Result<Verdict, String>;

/// A result that is on its way. Dropping it ends the work.
pub trait Pending<T> {
    /// Returns the result once, when it has arrived, and `None` before and after that. The window is repainted when it arrives.
    fn poll(&mut self) -> Option<T>;
}

/// A result that is known from the start.
pub struct Ready<T>(Option<T>);

impl<T> Ready<T> {
    /// Has this result.
    pub fn new(result: T) -> Self {
        Ready(Some(result))
    }
}

impl<T> Pending<T> for Ready<T> {
    fn poll(&mut self) -> Option<T> {
        self.0.take()
    }
}
