//! The interface to the platform: a station computed beside the interface.

use gonio_beyond::{StationDescription, StationRequest, StationResult};

/// The number of a request: each has a larger one than those before.
pub type RequestNumber = u32;

/// News of the work.
#[derive(Clone, Debug, PartialEq)]
pub enum StationNews {
    /// All stations; the first news.
    Stations(Vec<StationDescription>),
    /// A result of a request.
    Result(RequestNumber, StationResult),
    /// Nothing is left to do for a request.
    Finished(RequestNumber),
    /// Why there is no result, in one sentence; nothing follows.
    Failed(String),
}

/// Stations at work. Dropping it ends the work.
pub trait StationTask {
    /// Computes this in place of what was requested before. What both share goes on.
    fn request(&mut self, number: RequestNumber, request: &StationRequest);
    /// Pauses the work until the next request.
    fn pause(&mut self);
    /// Returns the next news, once. The window is repainted when there are some.
    fn poll(&mut self) -> Option<StationNews>;
}
