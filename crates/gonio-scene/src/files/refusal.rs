//! Reasons for which a file that exists is not read.

use std::fmt;
use std::io::Error;

/// A reason for which a file that exists is not read. Travels inside an [`Error`]; [`FileRefusal::in_error`] takes it
/// out again.
///
/// Displayed, it is the predicate of a sentence whose subject is the file: "is a pipe, not a file".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileRefusal {
    /// A character or block device: reading may never end, or do something.
    Device,
    /// A FIFO: opening or reading it waits for another program.
    Pipe,
    /// A socket, which cannot be opened as a file.
    Socket,
    /// A file with data although its size is 0: the files of `/proc` are generated while they are read, in the worst
    /// case without end.
    Generated,
    /// More memory than the limit allows.
    OverLimit(OverLimit),
    /// The path leads out of the folders that a [`Sandbox`](super::Sandbox) allows.
    OutsideSandbox,
}

impl FileRefusal {
    /// The refusal inside an error of a [`FileSource`](super::FileSource), if there is one.
    pub fn in_error(error: &Error) -> Option<&FileRefusal> {
        error.get_ref()?.downcast_ref::<Refused>().map(|refused| &refused.0)
    }
}

impl From<FileRefusal> for Error {
    fn from(refusal: FileRefusal) -> Error {
        Error::other(Refused(refusal))
    }
}

/// A refusal as a whole sentence, for messages that name the file.
#[derive(Debug)]
struct Refused(FileRefusal);

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "it {}", self.0)
    }
}

impl std::error::Error for Refused {}

impl fmt::Display for FileRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileRefusal::Device => f.write_str("is a device, not a file"),
            FileRefusal::Pipe => f.write_str("is a pipe, not a file; only the input itself may be a pipe"),
            FileRefusal::Socket => f.write_str("is a socket, not a file"),
            FileRefusal::Generated => f.write_str(
                "holds data although its size is 0, like the files in /proc; copy it to an ordinary file first",
            ),
            FileRefusal::OverLimit(over) => over.fmt(f),
            FileRefusal::OutsideSandbox => {
                f.write_str("is outside the folder of the input, and the sandbox forbids reading it")
            }
        }
    }
}

/// A request for more memory than is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OverLimit {
    /// Bytes requested; `None` if the end was not reached: more than what is left.
    pub needed: Option<u64>,
    /// Bytes that were left.
    pub left: u64,
    /// Bytes allowed in total.
    pub limit: u64,
}

impl fmt::Display for OverLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.needed {
            Some(needed) => write!(f, "needs {} of memory", Size(needed))?,
            None => write!(f, "needs more than {} of memory", Size(self.left))?,
        }
        if self.left == self.limit {
            write!(f, ", and the limit is {}", Size(self.limit))
        } else {
            write!(f, ", but only {} of the limit of {} are left", Size(self.left), Size(self.limit))
        }
    }
}

/// Bytes in the unit that suits them, rounded to a tenth: `1.5 GiB`.
struct Size(u64);

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const UNITS: [&str; 3] = ["KiB", "MiB", "GiB"];
        if self.0 < 1 << 10 {
            return write!(f, "{} bytes", self.0);
        }
        let unit = (1..3).find(|unit| self.0 < 1 << (10 * (unit + 1))).unwrap_or(3);
        write!(f, "{:.1} {}", self.0 as f64 / (1_u64 << (10 * unit)) as f64, UNITS[unit - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_the_bytes_needed_and_left() {
        let text = |needed, left, limit| OverLimit { needed, left, limit }.to_string();
        assert_eq!(text(Some(3 << 30), 2 << 30, 2 << 30), "needs 3.0 GiB of memory, and the limit is 2.0 GiB");
        assert_eq!(text(None, 1023, 1023), "needs more than 1023 bytes of memory, and the limit is 1023 bytes");
        assert_eq!(
            text(Some(1536), 1 << 10, 1 << 20),
            "needs 1.5 KiB of memory, but only 1.0 KiB of the limit of 1.0 MiB are left"
        );
    }

    #[test]
    fn a_refusal_survives_in_an_error() {
        let error = Error::from(FileRefusal::Pipe);
        assert_eq!(FileRefusal::in_error(&error), Some(&FileRefusal::Pipe));
        assert!(error.to_string().starts_with("it is a pipe, not a file"), "{error}");
        assert_eq!(FileRefusal::in_error(&Error::other("else")), None);
    }
}
