//! An X server without a screen. The window's tests and those under Wine use this file too.

use std::io::Read;
use std::process::{Child, Command, Stdio};

/// A running Xvfb, which ends when this is dropped.
pub struct Screen {
    server: Child,
    /// The value for `DISPLAY`.
    pub name: String,
}

impl Screen {
    /// Starts one of this size in pixels, with more options for the server, which chooses a free display number.
    pub fn new([width, height]: [u32; 2], options: &[&str]) -> Result<Screen, String> {
        let server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0"])
            .arg(format!("{width}x{height}x24"))
            .args(options)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| format!("cannot start Xvfb: {e}; install xvfb"))?;
        let mut screen = Screen { server, name: String::from(":") };
        let mut byte = [0];
        if let Some(out) = &mut screen.server.stdout {
            while out.read(&mut byte).is_ok_and(|read| read == 1) && byte != *b"\n" {
                screen.name.push(byte[0].into());
            }
        }
        if screen.name == ":" {
            return Err("Xvfb ended before it had a display; `Xvfb :99` prints the reason".into());
        }
        Ok(screen)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
