//! The text files of the repository, and Rust source without comments and texts.
//!
//! [`Source`] knows just enough of the language that a word in a string or a comment is not taken for code.

use crate::process;
use std::path::Path;
use std::process::Command;

/// A text file of the repository.
#[derive(Clone, Debug)]
pub struct TextFile {
    /// From the top of the repository, with `/`.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl TextFile {
    /// Whether it is Rust.
    pub fn is_rust(&self) -> bool {
        self.path.ends_with(".rs")
    }
}

/// Every text file that git tracks, or would track once it is added. Binary files are left out.
pub fn text_files(root: &Path) -> Result<Vec<TextFile>, String> {
    let list = process::stdout_of(Command::new("git").current_dir(root).args([
        "ls-files",
        "-z",
        "--cached",
        "--others",
        "--exclude-standard",
    ]))?;
    let mut files = Vec::new();
    for path in list.split('\0').filter(|p| !p.is_empty()) {
        // Deleted files, submodules and links cannot be read as text.
        let Ok(bytes) = std::fs::read(root.join(path)) else { continue };
        if let Ok(text) = String::from_utf8(bytes) {
            files.push(TextFile { path: path.to_owned(), text });
        }
    }
    if !files.iter().any(TextFile::is_rust) {
        return Err("git lists no Rust files here, so there is nothing to check".into());
    }
    Ok(files)
}

/// A source file, line by line.
pub struct Source {
    /// The code of each line; the insides of strings and all comments are gone.
    pub code: Vec<String>,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Code,
    LineComment,
    /// The depth of nesting.
    BlockComment(u32),
    String,
    /// The number of `#` at its end.
    RawString(usize),
}

impl Source {
    /// Takes a file apart.
    pub fn parse(text: &str) -> Source {
        let chars: Vec<char> = text.chars().collect();
        let mut code = vec![String::new()];
        let mut state = State::Code;
        let mut i = 0;
        while i < chars.len() {
            let (c, next) = (chars[i], chars.get(i + 1).copied().unwrap_or('\0'));
            if c == '\n' {
                if state == State::LineComment {
                    state = State::Code;
                }
                code.push(String::new());
                i += 1;
                continue;
            }
            let mut code_push = |c: char| code.last_mut().map_or((), |line| line.push(c));
            match state {
                State::Code if c == '/' && next == '/' => {
                    state = State::LineComment;
                    i += 1;
                }
                State::Code if c == '/' && next == '*' => {
                    state = State::BlockComment(1);
                    i += 1;
                }
                State::Code if c == '"' => {
                    code_push('"');
                    state = State::String;
                }
                State::Code if c == '\'' => {
                    code_push('\'');
                    i += char_literal_length(&chars[i..]);
                }
                State::Code => match raw_string_start(&chars[i..]) {
                    Some((length, hashes)) => {
                        code_push('"');
                        state = State::RawString(hashes);
                        i += length - 1;
                    }
                    None => code_push(c),
                },
                State::LineComment => {}
                State::BlockComment(depth) => match (c, next) {
                    ('*', '/') => {
                        state = if depth == 1 { State::Code } else { State::BlockComment(depth - 1) };
                        i += 1;
                    }
                    ('/', '*') => {
                        state = State::BlockComment(depth + 1);
                        i += 1;
                    }
                    _ => {}
                },
                State::String if c == '\\' && next != '\n' => i += 1,
                State::String if c == '"' => {
                    code_push('"');
                    state = State::Code;
                }
                State::RawString(hashes)
                    if c == '"' && chars[i + 1..].iter().take_while(|&&c| c == '#').count() >= hashes =>
                {
                    code_push('"');
                    state = State::Code;
                    i += hashes;
                }
                State::String | State::RawString(_) => {}
            }
            i += 1;
        }
        Source { code }
    }

    /// For each line, whether it is within an item marked `#[cfg(test)]`.
    pub fn test_lines(&self) -> Vec<bool> {
        let mut marks = vec![false; self.code.len()];
        // Brackets open since the mark; `Some(0)`: the item's body has not begun.
        let mut depth: Option<i32> = None;
        for (index, line) in self.code.iter().enumerate() {
            if depth.is_none() && line.contains("#[cfg(test)]") {
                depth = Some(0);
            }
            if let Some(open) = depth.as_mut() {
                marks[index] = true;
                let mut ended = false;
                for c in line.chars() {
                    match c {
                        '{' => *open += 1,
                        '}' => {
                            *open -= 1;
                            ended |= *open <= 0;
                        }
                        ';' if *open == 0 => ended = true,
                        _ => {}
                    }
                }
                if ended {
                    depth = None;
                }
            }
        }
        marks
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Byte offsets of `word` in `line` where it is not part of a longer word.
pub fn find_words<'a>(line: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    line.match_indices(word).map(|(at, _)| at).filter(move |&at| {
        let before = line[..at].chars().next_back();
        let after = line[at + word.len()..].chars().next();
        !before.is_some_and(is_word) && !after.is_some_and(is_word)
    })
}

/// The number of characters of a character literal after its quote; 0 for a lifetime.
fn char_literal_length(from_quote: &[char]) -> usize {
    match from_quote {
        ['\'', '\\', rest @ ..] => {
            // The character after the backslash may itself be a quote.
            rest.iter().skip(1).position(|&c| c == '\'').map_or(0, |at| at + 3)
        }
        ['\'', _, '\'', ..] => 2,
        _ => 0,
    }
}

/// The length of `r"`, `r#"`, `br"`... where one begins here, and its number of `#`.
fn raw_string_start(from: &[char]) -> Option<(usize, usize)> {
    let prefix = match from {
        ['b' | 'c', 'r', ..] => 2,
        ['r', ..] => 1,
        _ => return None,
    };
    let hashes = from[prefix..].iter().take_while(|&&c| c == '#').count();
    (from.get(prefix + hashes) == Some(&'"')).then_some((prefix + hashes + 1, hashes))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines that contain `word` as a whole word, counted from 0; a line as often as it has the word.
    fn lines_with_word(source: &Source, word: &str) -> Vec<usize> {
        let lines = source.code.iter().enumerate();
        lines.flat_map(|(index, line)| std::iter::repeat_n(index, find_words(line, word).count())).collect()
    }

    #[test]
    fn strings_and_comments_are_not_code() {
        let source = Source::parse(
            "let a = \"unsafe \\\" {\"; // unsafe 1\n/* unsafe /* nested */ unsafe */ let b = r#\"unsafe \" \"#;\nlet c = '\"'; let d: &'a str = '\\''; unsafe {}\n",
        );
        assert_eq!(lines_with_word(&source, "unsafe"), [2]);
        assert_eq!(source.code[1].trim(), "let b = \"\";");
    }

    #[test]
    fn a_string_over_two_lines_stays_a_string() {
        let source = Source::parse("let a = \"one\\\n unsafe\nunsafe\";\nunsafe {}");
        assert_eq!(lines_with_word(&source, "unsafe"), [3]);
        assert_eq!(source.code.len(), 4);
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(find_words("unsafe_code unsafe(unsafe)", "unsafe").collect::<Vec<_>>(), [12, 19]);
        let source = Source::parse("for r in bar { attr\"\" }\nunsafe {} unsafe {}");
        assert_eq!(lines_with_word(&source, "unsafe"), [1, 1]);
    }

    #[test]
    fn test_modules_are_found_to_their_end() {
        let source = Source::parse(
            "fn a() {}\n#[cfg(test)]\nmod tests {\n fn b() { }\n}\nfn c() {}\n#[cfg(test)]\nuse x;\nfn d() {}",
        );
        assert_eq!(source.test_lines(), [false, true, true, true, true, false, true, true, false]);
    }
}
