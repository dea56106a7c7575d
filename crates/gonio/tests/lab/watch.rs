//! `gonio lab check --watch`.

use crate::common::Lab;
use crate::hand_in;
use serde_json::Value;
use std::process::{Child, Command, Stdio};

/// A process that is stopped when it is dropped.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
#[cfg(unix)]
fn a_change_is_checked_again_until_ctrl_c() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "mine", "mat3(itM)", "mat3(M)");
    let right = String::from_utf8(lab.read("mine/reference.vert")).unwrap().replace("mat3(M)", "mat3(itM)");
    // The page is within the folder: writing it is no change.
    let args = ["lab", "check", "ex04", "mine", "--watch", "--json", "--quiet", "--page", "mine/verdict.html"];
    let mut command = lab.command(&args);
    let mut child = Watching(command.stdout(Stdio::piped()).spawn().unwrap());
    let output = child.0.stdout.take().unwrap();
    let mut verdicts = serde_json::Deserializer::from_reader(output).into_iter::<Value>();
    assert_eq!(verdicts.next().unwrap().unwrap()["verdict"], "wrong");
    lab.write("mine/reference.vert", right.replace("void main", "void mian"));
    assert_eq!(verdicts.next().unwrap().unwrap()["verdict"], "does-not-compile");
    // A missing file is an error, and the watch goes on.
    std::fs::remove_dir_all(lab.path("mine")).unwrap();
    hand_in(&lab, "ex04", "mine", "mat3(itM)", "mat3(itM)");
    let last = loop {
        let verdict = verdicts.next().unwrap().unwrap();
        if verdict["verdict"] != "does-not-compile" && verdict["verdict"] != "unsure" {
            break verdict;
        }
    };
    assert_eq!(last["verdict"], "correct");
    let page = String::from_utf8(lab.read("mine/verdict.html")).unwrap();
    assert!(page.contains("correct"), "the page is that of the last check");
    let interrupted = Command::new("kill").args(["-INT", &child.0.id().to_string()]).status().unwrap();
    assert!(interrupted.success());
    assert_eq!(child.0.wait().unwrap().code(), Some(0));
    assert!(verdicts.next().is_none(), "one verdict for each change");
}
