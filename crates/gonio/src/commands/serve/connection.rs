//! One connection: reads a request's head, writes the answer, closes.

use super::answer::{Answer, Site};
use super::request::Request;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::{Duration, Instant};

/// Longer heads are rejected; no browser sends them.
const MOST_HEAD_BYTES: usize = 16 * 1024;
/// The time a client has to send its request.
const REQUEST_TIMEOUT: Duration = Duration::from_secs(10);
/// The time a client may pause while it receives the answer.
const STALL: Duration = Duration::from_secs(60);

/// Serves one request, or answers that there are too many connections if `crowded`.
///
/// Errors of a connection are ignored: its client has gone.
pub fn serve(mut stream: TcpStream, site: &Site, crowded: bool) {
    let answer = if crowded {
        Answer::text((503, "Service Unavailable"), "too many connections at once; try again")
    } else {
        match read_head(&mut stream) {
            Ok(Head::Whole(bytes)) => site.answer(Request::parse(&bytes).as_ref()),
            Ok(Head::TooLong) => {
                Answer::text((431, "Request Header Fields Too Large"), "the request's head is too long")
            }
            Ok(Head::Late) => Answer::text((408, "Request Timeout"), "the request took too long"),
            Ok(Head::Empty) | Err(_) => return,
        }
    };
    let _ = write(&mut stream, &answer);
}

enum Head {
    Whole(Vec<u8>),
    TooLong,
    Late,
    /// Closed before it was complete.
    Empty,
}

fn read_head(stream: &mut TcpStream) -> io::Result<Head> {
    let deadline = Instant::now() + REQUEST_TIMEOUT;
    let (mut head, mut buffer) = (Vec::new(), [0; 2048]);
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Ok(Head::Late);
        }
        stream.set_read_timeout(Some(left))?;
        let count = match stream.read(&mut buffer) {
            Ok(0) => return Ok(Head::Empty),
            Ok(count) => count,
            Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) => continue,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        head.extend(buffer.iter().take(count));
        if let Some(end) = head.windows(4).position(|bytes| bytes == b"\r\n\r\n") {
            head.truncate(end + 4);
            return Ok(Head::Whole(head));
        }
        if head.len() > MOST_HEAD_BYTES {
            return Ok(Head::TooLong);
        }
    }
}

fn write(stream: &mut TcpStream, answer: &Answer) -> io::Result<()> {
    stream.set_write_timeout(Some(STALL))?;
    stream.write_all(answer.head().as_bytes())?;
    if !answer.head_only {
        stream.write_all(&answer.body)?;
    }
    stream.shutdown(Shutdown::Write)?;
    // Closing while the client still sends would discard the answer: let it finish, within bounds.
    stream.set_read_timeout(Some(Duration::from_secs(1)))?;
    let mut sink = [0; 2048];
    for _ in 0..64 {
        if stream.read(&mut sink)? == 0 {
            break;
        }
    }
    Ok(())
}
