//! `gonio lsp`, in the Language Server Protocol.

use crate::common::Lab;
use crate::hand_in;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// The server that hangs is reported after this time.
const HANGS: Duration = Duration::from_secs(120);
/// The line of the mistake, as students write it.
const WRONG: (&str, &str) = ("mat3(itM)", "mat3(M)");

/// An editor with a server, which is stopped when this is dropped.
pub struct Editor {
    child: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    /// Everything that the server sent.
    log: Vec<Value>,
    requests: i64,
}

impl Drop for Editor {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn message(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim_end().split_once(": ") {
            Some(("Content-Length", number)) => length = number.parse().unwrap(),
            Some(_) => {}
            None => break,
        }
    }
    let mut body = vec![0; length];
    output.read_exact(&mut body).ok()?;
    Some(serde_json::from_slice(&body).unwrap())
}

impl Editor {
    /// Starts a server without the handshake.
    fn of(mut command: Command) -> Editor {
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let (input, output) = (child.stdin.take(), child.stdout.take().unwrap());
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = message(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Editor { child, input, messages, log: Vec::new(), requests: 0 }
    }

    fn start(lab: &Lab, args: &[&str]) -> Editor {
        Editor::with(lab.command(&[&["lsp"], args].concat()))
    }

    fn with(command: Command) -> Editor {
        let mut editor = Editor::of(command);
        let capabilities = json!({
            "textDocument": { "hover": { "contentFormat": ["markdown", "plaintext"] } },
            "workspace": { "workspaceEdit": { "documentChanges": true } },
        });
        let params = json!({ "processId": null, "rootUri": null, "capabilities": capabilities });
        let result = editor.request("initialize", params)["result"].clone();
        assert_eq!(result["serverInfo"]["name"], "gonio");
        editor.notify("initialized", json!({}));
        editor
    }

    fn send(&mut self, message: &Value) {
        self.send_raw(&message.to_string());
    }

    fn send_raw(&mut self, body: &str) {
        let input = self.input.as_mut().unwrap();
        write!(input, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        input.flush().unwrap();
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn request(&mut self, method: &str, params: Value) -> Value {
        self.requests += 1;
        let id = self.requests;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        self.until(|message| message["id"] == id)
    }

    /// The next message that fits.
    #[track_caller]
    fn until(&mut self, fits: impl Fn(&Value) -> bool) -> Value {
        loop {
            let Ok(message) = self.messages.recv_timeout(HANGS) else { panic!("no such message: {:#?}", self.log) };
            self.log.push(message.clone());
            if fits(&message) {
                return message;
            }
        }
    }

    fn open(&mut self, uri: &str, text: &str) {
        let document = json!({ "uri": uri, "languageId": "glsl", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    fn change(&mut self, uri: &str, version: i32, text: &str) {
        let document = json!({ "uri": uri, "version": version });
        let changes = json!([{ "text": text }]);
        self.notify("textDocument/didChange", json!({ "textDocument": document, "contentChanges": changes }));
    }

    /// The next diagnostics of a document that fit.
    #[track_caller]
    fn diagnostics(&mut self, uri: &str, fits: impl Fn(&[Value]) -> bool) -> Vec<Value> {
        let of = |message: &Value| message["params"]["diagnostics"].as_array().cloned().unwrap_or_default();
        let is_it =
            |message: &Value| message["method"] == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri;
        of(&self.until(|message| is_it(message) && fits(&of(message))))
    }

    fn hover(&mut self, uri: &str, line: usize, character: usize) -> Value {
        let position = json!({ "line": line, "character": character });
        self.request("textDocument/hover", json!({ "textDocument": { "uri": uri }, "position": position }))["result"]
            .clone()
    }

    fn actions(&mut self, uri: &str, line: u64) -> Value {
        let place = json!({ "line": line, "character": 0 });
        let params = json!({
            "textDocument": { "uri": uri },
            "range": { "start": place, "end": place },
            "context": { "diagnostics": [] },
        });
        self.request("textDocument/codeAction", params)["result"].clone()
    }

    /// Ends the server as editors do; returns the exit code and what it wrote to stderr.
    fn end(mut self) -> (Option<i32>, String) {
        assert_eq!(self.request("shutdown", Value::Null)["result"], Value::Null);
        self.notify("exit", Value::Null);
        self.wait()
    }

    fn wait(mut self) -> (Option<i32>, String) {
        drop(self.input.take());
        let mut text = String::new();
        self.child.stderr.take().unwrap().read_to_string(&mut text).unwrap();
        (self.child.wait().unwrap().code(), text)
    }
}

fn has(code: &str) -> impl Fn(&[Value]) -> bool {
    move |found| found.iter().any(|diagnostic| diagnostic["code"] == code)
}

/// The URI of a file as editors write it, and its text.
fn file(lab: &Lab, name: &str) -> (String, String) {
    let path = lab.path(name).to_string_lossy().into_owned();
    let uri = format!("file://{}", path.replace(' ', "%20").replace('é', "%C3%A9"));
    (uri, String::from_utf8(lab.read(name)).unwrap())
}

/// The number of the first line with a text, from 0.
fn line_of(text: &str, part: &str) -> usize {
    text.lines().position(|line| line.contains(part)).unwrap_or_else(|| panic!("`{part}` is not in {text}"))
}

/// The column of a text in its line, in UTF-16 code units from 0.
fn column_of(text: &str, part: &str) -> usize {
    let line = text.lines().nth(line_of(text, part)).unwrap();
    line[..line.find(part).unwrap()].encode_utf16().count()
}

#[test]
fn a_mistake_is_shown_at_its_line_until_it_is_right() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ex04 é", WRONG.0, WRONG.1);
    let (uri, text) = file(&lab, "ex04 é/reference.vert");
    let mut editor = Editor::start(&lab, &[]);
    editor.open(&uri, &text);
    let found = editor.diagnostics(&uri, has("normal-by-model-matrix"));
    let [mistake] = found.as_slice() else { panic!("{found:#?}") };
    let range = &mistake["range"];
    assert_eq!((&range["start"]["line"], &mistake["source"]), (&line_of(&text, WRONG.1).into(), &"gonio".into()));
    let line = text.lines().nth(line_of(&text, WRONG.1)).unwrap();
    let indented = line.len() - line.trim_start().len();
    assert_eq!((&range["start"]["character"], &range["end"]["character"]), (&indented.into(), &line.len().into()));
    assert!(mistake["message"].as_str().unwrap().contains("\nAdvice: "), "{mistake}");
    // A syntax error is reported at once, and the verdict on another text is not.
    let broken = text.replace("gl_Position =", "gl_Position = )");
    editor.change(&uri, 2, &broken);
    let found = editor.diagnostics(&uri, |found| !found.is_empty() && !has("normal-by-model-matrix")(found));
    let place = &found[0]["range"]["start"];
    assert_eq!((&place["line"], &found[0]["severity"]), (&line_of(&broken, "= )").into(), &1.into()), "{found:#?}");
    // The course shows lines and no fixes.
    editor.change(&uri, 3, &text);
    editor.diagnostics(&uri, has("normal-by-model-matrix"));
    assert_eq!(editor.actions(&uri, line_of(&text, WRONG.1) as u64), json!([]));
    editor.change(&uri, 4, &text.replace(WRONG.1, WRONG.0));
    let shown = editor.until(|message| message["method"] == "window/showMessage");
    assert!(shown["params"]["message"].as_str().unwrap().starts_with("ex04 is correct"), "{shown}");
    assert!(editor.diagnostics(&uri, <[Value]>::is_empty).is_empty());
    assert_eq!(editor.end(), (Some(0), String::new()));
}

#[test]
fn the_other_shader_gets_its_diagnostics_too_and_loses_them_with_the_last_document() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "mine", WRONG.0, WRONG.1);
    // The text that `gonio lab start` writes tells the exercise, also of the folders below.
    std::fs::create_dir(lab.path("mine/shaders")).unwrap();
    for name in ["reference.vert", "reference.frag"] {
        let text = String::from_utf8(lab.read(&format!("mine/{name}"))).unwrap();
        lab.write(&format!("mine/shaders/{name}"), text.replace("itM", "qqq"));
        std::fs::remove_file(lab.path(&format!("mine/{name}"))).unwrap();
    }
    lab.write("mine/text.md", lab.run(&["lab", "show", "ex04"]).good().stdout);
    lab.write("mine/names.toml", "[names]\nqqq = \"normal-matrix\"\n");
    let (vertex, other) = file(&lab, "mine/shaders/reference.vert");
    let (fragment, text) = file(&lab, "mine/shaders/reference.frag");
    let mut editor = Editor::start(&lab, &["--language", "fr"]);
    editor.open(&fragment, &text);
    let found = editor.diagnostics(&vertex, has("normal-by-model-matrix"));
    assert!(found[0]["message"].as_str().unwrap().contains("\nConseil : "), "{found:#?}");
    editor.open(&vertex, &other);
    let hover = editor.hover(&vertex, line_of(&other, "mat4 qqq"), column_of(&other, "mat4 qqq") + 5);
    assert!(hover["contents"]["value"].as_str().unwrap().contains("names.toml"), "{hover}");
    for uri in [&vertex, &fragment] {
        editor.notify("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    }
    assert!(editor.diagnostics(&vertex, <[Value]>::is_empty).is_empty());
}

#[test]
fn results_of_older_texts_are_dropped() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ex04", WRONG.0, WRONG.1);
    let (uri, text) = file(&lab, "ex04/reference.vert");
    let mut editor = Editor::start(&lab, &[]);
    editor.open(&uri, &text);
    // The first check has begun; the fragment shader's mistake below is another one.
    editor.change(&uri, 2, &text.replace(WRONG.1, WRONG.0));
    let (fragment, other) = file(&lab, "ex04/reference.frag");
    let raw = other.replace("normalize(v_normal)", "v_normal");
    assert_ne!(raw, other);
    editor.open(&fragment, &raw);
    editor.diagnostics(&fragment, has("normal-not-renormalised"));
    let is_late =
        |message: &Value| message["params"]["version"] == 2 && message.to_string().contains("normal-by-model-matrix");
    assert!(!editor.log.iter().any(is_late), "{:#?}", editor.log);
}

#[test]
fn the_proven_fix_is_a_quick_fix_where_feedback_permits_it() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ex04", WRONG.0, WRONG.1);
    let (uri, text) = file(&lab, "ex04/reference.vert");
    let mut editor = Editor::start(&lab, &["--feedback", "fix"]);
    editor.open(&uri, &text);
    editor.diagnostics(&uri, has("normal-by-model-matrix"));
    let line = line_of(&text, WRONG.1);
    assert_eq!(editor.actions(&uri, 0), json!([]), "away from the mistake");
    let actions = editor.actions(&uri, line as u64);
    let [action] = actions.as_array().unwrap().as_slice() else { panic!("{actions:#}") };
    assert_eq!(
        (&action["kind"], &action["diagnostics"][0]["code"]),
        (&"quickfix".into(), &"normal-by-model-matrix".into())
    );
    let change = &action["edit"]["documentChanges"][0];
    assert_eq!(change["textDocument"], json!({ "uri": uri, "version": 1 }));
    let edit = &change["edits"][0];
    let of = |end: &str| edit["range"][end]["line"].as_u64().unwrap() as usize;
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let fixed =
        [&lines[..of("start")].concat(), edit["newText"].as_str().unwrap(), &lines[of("end")..].concat()].concat();
    lab.write("ex04/reference.vert", fixed);
    lab.run(&["lab", "check", "ex04", "ex04"]).good();
    // The answer is for the text that the editor has now.
    editor.change(&uri, 2, &format!("{text}\n"));
    assert_eq!(editor.actions(&uri, line as u64), json!([]));
}

#[test]
fn a_misspelt_name_has_a_quick_fix_at_once() {
    let lab = Lab::new();
    let text = "#version 330 core\nin vec3 v;\nout vec4 c;\nvoid main() { /* 😀 */ c = vec4(normalise(v), 1.0); }\n";
    lab.write("a.frag", text);
    let (uri, _) = file(&lab, "a.frag");
    let mut editor = Editor::start(&lab, &[]);
    editor.open(&uri, text);
    editor.diagnostics(&uri, |found| !found.is_empty());
    let actions = editor.actions(&uri, 3);
    let [action] = actions.as_array().unwrap().as_slice() else { panic!("{actions:#}") };
    let edit = &action["edit"]["documentChanges"][0]["edits"][0];
    let start = column_of(text, "normalise");
    let range = json!({ "start": { "line": 3, "character": start }, "end": { "line": 3, "character": start + 9 } });
    assert_eq!(edit, &json!({ "range": range, "newText": "normalize" }));
    assert_eq!(editor.actions(&uri, 1), json!([]));
}

#[test]
fn hovering_shows_type_role_and_value() {
    let lab = Lab::new();
    hand_in(&lab, "ex07", "ex07", "mat3(itM)", "mat3(itM)");
    let (uri, text) = file(&lab, "ex07/reference.frag");
    let text = text.replace("    float d =", "    /* 😀 é */ float d =");
    let mut editor = Editor::start(&lab, &[]);
    editor.open(&uri, &text);
    let mut at = |part: &str, within: usize| {
        let hover = editor.hover(&uri, line_of(&text, part), column_of(&text, part) + within);
        (hover["contents"]["value"].as_str().unwrap_or_default().to_owned(), hover["range"].clone())
    };
    // The same pixel and the same values as there.
    let stepped = lab.run(&["lab", "step", "ex07", "ex07", "--json"]).good().json();
    let steps = stepped["stages"][0]["steps"].as_array().unwrap().iter();
    let mut writes = steps.flat_map(|step| step["writes"].as_array().unwrap());
    let d = writes.find(|write| write["name"] == "d").unwrap()["value"].as_f64().unwrap();
    assert_eq!(stepped["pixel"], json!([256, 256]));
    let (shown, range) = at("float d =", 6);
    assert!(
        shown.starts_with("```glsl\nfloat d\n```") && shown.contains(&format!("Value: {d:.3}, at pixel 256,256")),
        "{shown}"
    );
    let start = column_of(&text, "float d =") + 6;
    assert_eq!((&range["start"]["character"], &range["end"]["character"]), (&start.into(), &(start + 1).into()));
    let (shown, _) = at("light.light_pos", 8);
    for part in ["vec3 light.light_pos", "Role: ", "Value: (1, 2, 1.5), at pixel 256,256"] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    let (shown, _) = at("normalize(v_normal)", 2);
    assert!(shown.contains("vec3 normalize(v_normal)") && shown.contains("Value: ("), "{shown}");
    let (shown, _) = at("in vec3 v_normal", 9);
    assert!(shown.starts_with("```glsl\nin vec3 v_normal\n```") && shown.contains("Value: ("), "{shown}");
    let (shown, range) = at("#version", 3);
    assert_eq!((shown.as_str(), range), ("", Value::Null));
    let (uri, text) = file(&lab, "ex07/reference.vert");
    editor.open(&uri, &text);
    let hover = editor.hover(&uri, line_of(&text, "mat4 itM"), column_of(&text, "mat4 itM") + 5);
    let shown = hover["contents"]["value"].as_str().unwrap();
    assert!(shown.contains("uniform mat4 itM") && shown.contains("Role: ") && shown.contains("at vertex"), "{shown}");
}

#[test]
fn shaders_without_an_exercise_get_the_compilers_messages() {
    let lab = Lab::new();
    let text = "#version 330 core\nin vec3 v;\nout vec4 c;\n/* 😀 */ void main() { c = vec4(v, 1.0) + vec3(1.0); }\n";
    lab.write("a.frag", text);
    let mut editor = Editor::start(&lab, &[]);
    let (uri, _) = file(&lab, "a.frag");
    for uri in [uri.as_str(), "untitled:b.frag"] {
        editor.open(uri, text);
        let found = editor.diagnostics(uri, |found| !found.is_empty());
        let start = &found[0]["range"]["start"];
        assert_eq!((&start["line"], &found[0]["severity"]), (&3.into(), &1.into()), "{found:#?}");
        // In UTF-16 code units.
        assert!(start["character"].as_u64().unwrap() as usize >= column_of(text, "c = vec4"), "{found:#?}");
    }
    let hover = editor.hover(&uri, 3, column_of(text, "v, 1.0"));
    assert_eq!(hover["contents"]["value"], "```glsl\nin vec3 v\n```");
    assert_eq!(editor.hover("file:///nowhere/x.frag", 0, 0), Value::Null);
    assert_eq!(editor.actions(&uri, 3), json!([]));
    // Half an exercise is said to be one.
    std::fs::create_dir(lab.path("ex04")).unwrap();
    lab.write("ex04/only.frag", "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n");
    let (uri, text) = file(&lab, "ex04/only.frag");
    editor.open(&uri, &text);
    let found = editor.diagnostics(&uri, has("incomplete"));
    assert!(found[0]["message"].as_str().unwrap().contains("vertex"), "{found:#?}");
}

#[test]
fn a_shader_that_never_ends_does_not_keep_the_server() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ex04", "void main() {", "void main() { while (true) { gl_Position.x += 1.0; }");
    let (uri, text) = file(&lab, "ex04/reference.vert");
    let mut editor = Editor::start(&lab, &[]);
    editor.open(&uri, &text);
    // While it is being checked.
    let hover = editor.hover(&uri, line_of(&text, "in vec3 normal"), column_of(&text, "normal;"));
    assert!(hover["contents"]["value"].as_str().unwrap().contains("in vec3 normal"), "{hover}");
    let ends = text.replace("while (true) { gl_Position.x += 1.0; }", "").replace(WRONG.0, WRONG.1);
    editor.change(&uri, 2, &ends);
    editor.diagnostics(&uri, has("normal-by-model-matrix"));
    editor.change(&uri, 3, &text);
    let found = editor.diagnostics(&uri, |found| found.iter().any(|d| d["message"].to_string().contains("loop")));
    let line = &found[0]["range"]["start"]["line"];
    assert_eq!(line, &Value::from(line_of(&text, "while")), "{found:#?}");
    assert_eq!(editor.end().0, Some(0));
}

#[test]
fn without_opengl_wrong_values_are_found_and_it_is_said_once() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ex04", WRONG.0, WRONG.1);
    let (uri, text) = file(&lab, "ex04/reference.vert");
    let mut command = lab.command(&["lsp"]);
    // The system's EGL finds no driver.
    command.env("__EGL_VENDOR_LIBRARY_FILENAMES", lab.path("none.json"));
    let mut editor = Editor::with(command);
    editor.open(&uri, &text);
    let found = editor.diagnostics(&uri, has("wrong-value"));
    assert_eq!(found[0]["range"]["start"]["line"], line_of(&text, WRONG.1), "{found:#?}");
    let hover = editor.hover(&uri, line_of(&text, WRONG.1), column_of(&text, WRONG.1) + 5);
    assert!(hover["contents"]["value"].as_str().unwrap().contains("Value: ["), "{hover}");
    editor.change(&uri, 2, &format!("{text}\n"));
    let is_second = |message: &Value| message["params"]["version"] == 2 && message.to_string().contains("wrong-value");
    editor.until(is_second);
    let shown = editor.log.iter().filter(|message| message["method"] == "window/showMessage").count();
    assert_eq!(shown, 1, "{:#?}", editor.log);
}

#[test]
fn the_protocol_is_kept_and_its_breaches_are_survived_or_reported() {
    let lab = Lab::new();
    let mut editor = Editor::start(&lab, &["--stdio"]);
    assert_eq!(editor.request("textDocument/rename", json!({}))["error"]["code"], -32601);
    assert_eq!(editor.request("textDocument/hover", json!({ "position": 7 }))["error"]["code"], -32602);
    editor.notify("textDocument/didOpen", json!({ "textDocument": [] }));
    editor.change("file:///not/open.frag", 3, "void");
    editor.notify("$/setTrace", json!({ "value": "off" }));
    assert_eq!(editor.request("shutdown", Value::Null)["result"], Value::Null);
    assert_eq!(editor.request("textDocument/hover", json!({}))["error"]["code"], -32600);
    editor.notify("exit", Value::Null);
    assert_eq!(editor.wait(), (Some(0), String::new()));

    let mut editor = Editor::start(&lab, &[]);
    editor.notify("exit", Value::Null);
    assert_eq!(editor.wait().0, Some(1), "without `shutdown`");
    assert_eq!(Editor::start(&lab, &[]).wait().0, Some(1), "its input ended");
    let mut editor = Editor::of(lab.command(&["lsp"]));
    assert_eq!(editor.request("textDocument/hover", json!({}))["error"]["code"], -32002);
    assert_eq!(editor.wait().0, Some(1));
    let mut editor = Editor::start(&lab, &[]);
    editor.send_raw("{ no JSON");
    let (code, words) = editor.wait();
    assert!(code == Some(2) && words.starts_with("error: ") && words.lines().count() == 1, "{words}");
    lab.run(&["lsp", "--exercise", "ex99"]).refused(&["there is no exercise `ex99`"]);
}
