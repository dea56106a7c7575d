//! Finds shaders in a program: its string literals, joined as its compiler would.
//!
//! C and C++ (escapes, `\`-continuation, adjacent literals, `R"x(...)x"`), JavaScript (`+`, templates, arrays joined
//! by line ends), Python (triple quotes, prefixes), Java, C#, Go and Rust if they use the same syntax; and the
//! `<script>` elements of a web page.

use super::stage;
use super::text::Builder;

/// A text found in a program.
#[derive(Clone, Debug)]
pub(super) struct Literal {
    /// The variable or key that holds it; empty if there is none.
    pub(super) variable: String,
    pub(super) text: Builder,
    /// Whether values that the program inserts were left out.
    pub(super) has_holes: bool,
}

/// How a language writes comments and strings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Language {
    /// C, C++ and their relatives, Java, C#, Rust, Go.
    C,
    /// JavaScript and TypeScript.
    JavaScript,
    /// Python.
    Python,
    /// A web page: scripts in JavaScript and shaders in elements of their own.
    Html,
}

/// Returns the language of a file by its extension; `None` if it is not a program's.
pub(super) fn language(file: &str) -> Option<Language> {
    let ending = file.rsplit_once('.')?.1.to_lowercase();
    match ending.as_str() {
        "c" | "cc" | "cpp" | "cxx" | "c++" | "h" | "hh" | "hpp" | "hxx" | "inl" | "ino" | "m" | "mm" | "java"
        | "cs" | "rs" | "go" | "kt" | "swift" => Some(Language::C),
        "js" | "mjs" | "cjs" | "ts" | "jsx" | "tsx" | "vue" => Some(Language::JavaScript),
        "py" | "pyw" => Some(Language::Python),
        "html" | "htm" | "xhtml" => Some(Language::Html),
        _ => None,
    }
}

/// Returns the texts of a program that contain a `main`, in order.
pub(super) fn shaders(source: &str, language: Language) -> Vec<Literal> {
    let mut scanner = Scanner::new(source, language);
    scanner.run();
    scanner.found.retain(|literal| {
        let (glsl, main) = stage::looks_like_glsl(&stage::without_comments(&literal.text.text));
        glsl && main
    });
    for literal in &mut scanner.found {
        // Some compilers require `#version` first; an opening quote is often followed by an empty line.
        literal.text.trim_start();
    }
    scanner.found
}

/// The code between the last literal and the current position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Between {
    /// White space and comments, or one `+`.
    Nothing,
    /// One comma.
    Comma,
    /// Anything else: the literal has ended.
    Code,
}

struct Scanner<'a> {
    chars: std::iter::Peekable<std::str::Chars<'a>>,
    rest: &'a str,
    language: Language,
    line: u32,
    column: u32,
    /// The current word, and the previous one, which may be the name of a literal.
    word: String,
    name: String,
    /// The name before the last `=`, `:` or `(`.
    target: String,
    between: Between,
    /// Whether the literal is appended: `source += "..."`.
    adds: bool,
    current: Option<Literal>,
    /// Whether the current literal is a whole shader.
    whole: Wholeness,
    found: Vec<Literal>,
    previous: char,
}

impl<'a> Scanner<'a> {
    fn new(source: &'a str, language: Language) -> Self {
        Self {
            chars: source.chars().peekable(),
            rest: source,
            language,
            line: 1,
            column: 1,
            word: String::new(),
            name: String::new(),
            target: String::new(),
            between: Between::Code,
            adds: false,
            current: None,
            whole: Wholeness::default(),
            found: Vec::new(),
            previous: '\n',
        }
    }

    fn next(&mut self) -> Option<char> {
        let c = self.chars.next()?;
        self.rest = &self.rest[c.len_utf8()..];
        if c == '\n' {
            self.line = self.line.saturating_add(1);
            self.column = 1;
        } else {
            self.column = self.column.saturating_add(1);
        }
        Some(c)
    }

    fn skip(&mut self, count: usize) {
        for _ in 0..count {
            self.next();
        }
    }

    fn run(&mut self) {
        while let Some(&c) = self.chars.peek() {
            if self.comment(c) {
                continue;
            }
            if self.language == Language::Html && self.script() {
                continue;
            }
            if c.is_alphanumeric() || c == '_' {
                if !(self.previous.is_alphanumeric() || self.previous == '_') {
                    self.word.clear();
                }
                // Longer words are not names.
                if self.word.len() < 200 {
                    self.word.push(c);
                }
                self.previous = c;
                self.next();
                continue;
            }
            if self.string(c) {
                self.previous = '"';
                continue;
            }
            self.code(c);
            self.previous = c;
            self.next();
        }
        self.end_literal();
    }

    /// Skips a comment that begins here.
    fn comment(&mut self, c: char) -> bool {
        let python = self.language == Language::Python;
        if python && c == '#' || !python && self.rest.starts_with("//") {
            while self.chars.peek().is_some_and(|&c| c != '\n') {
                self.next();
            }
        } else if !python && self.rest.starts_with("/*") {
            self.skip_behind("*/");
        } else if self.language == Language::Html && self.rest.starts_with("<!--") {
            self.skip_behind("-->");
        } else {
            return false;
        }
        self.previous = ' ';
        true
    }

    fn skip_behind(&mut self, end: &str) {
        let until = self.rest.find(end).map_or(self.rest.len(), |at| at + end.len());
        let stop = self.rest.len() - until;
        while self.rest.len() > stop && self.next().is_some() {}
    }

    /// Reads a character of code.
    fn code(&mut self, c: char) {
        if !self.word.is_empty() {
            self.settle_word();
        }
        match c {
            // In `vs: string = "..."` the type is not the name.
            '=' if matches!(self.name.as_str(), "string" | "str" | "String") && !self.target.is_empty() => {
                self.name.clear();
                self.between = Between::Code;
            }
            '=' | ':' | '(' | '{' => {
                if !self.name.is_empty() {
                    // `shader(gl.VERTEX_SHADER, "...")` is more specific than `shader`; see the comma below.
                    self.target = std::mem::take(&mut self.name);
                }
                self.adds = c == '=' && self.previous == '+';
                self.between = Between::Code;
            }
            ',' if self.between == Between::Nothing && self.current.is_some() => self.between = Between::Comma,
            ',' => {
                if !self.name.is_empty() {
                    self.target = std::mem::take(&mut self.name);
                }
                self.between = Between::Code;
            }
            // Concatenated, or written to a stream one after the other.
            '+' | '<' if self.between == Between::Nothing => {}
            '\\' => {}
            c if c.is_whitespace() => {}
            ';' | '}' => {
                self.name.clear();
                self.target.clear();
                self.between = Between::Code;
            }
            _ => self.between = Between::Code,
        }
    }

    /// Ends a word of code.
    fn settle_word(&mut self) {
        let word = std::mem::take(&mut self.word);
        if word.is_empty() {
            return;
        }
        // Prefixes and suffixes of literals, and types, are not names.
        if !matches!(
            word.as_str(),
            "R" | "u8" | "u8R" | "L" | "LR" | "r" | "f" | "b" | "fr" | "rf" | "s" | "string_literals"
        ) {
            self.between = Between::Code;
            self.name = word;
        }
    }

    fn end_literal(&mut self) {
        if let Some(literal) = self.current.take() {
            self.found.push(literal);
        }
    }

    /// Reads a string literal that begins here.
    fn string(&mut self, c: char) -> bool {
        let prefix = if self.previous.is_alphanumeric() { self.word.clone() } else { String::new() };
        let mut piece = Builder::new();
        let mut has_holes = false;
        let read = match (self.language, c) {
            (Language::C, '"') if matches!(prefix.as_str(), "R" | "u8R" | "LR" | "uR" | "UR") => self.raw(&mut piece),
            // A character literal; in `1'000` it separates digits.
            (Language::C, '\'') => {
                self.character();
                return true;
            }
            (Language::C | Language::Python, '"' | '\'') if self.rest.starts_with(&c.to_string().repeat(3)) => {
                self.skip(3);
                let raw = prefix.contains('r');
                self.quoted(&mut piece, &c.to_string().repeat(3), !raw, true, &mut has_holes)
            }
            (Language::C, '"') => {
                self.next();
                // C#'s `@"..."` and Rust's strings may span lines.
                self.quoted(&mut piece, "\"", true, false, &mut has_holes)
            }
            (Language::Python, '"' | '\'') => {
                self.next();
                self.quoted(&mut piece, &c.to_string(), !prefix.contains('r'), false, &mut has_holes)
            }
            (Language::JavaScript | Language::Html, '"' | '\'') => {
                self.next();
                self.quoted(&mut piece, &c.to_string(), true, false, &mut has_holes)
            }
            (Language::C | Language::JavaScript | Language::Html, '`') => {
                self.next();
                self.quoted(&mut piece, "`", self.language != Language::C, true, &mut has_holes)
            }
            _ => return false,
        };
        if !read {
            return true;
        }
        self.settle_word();
        self.take(piece, has_holes);
        true
    }

    /// Appends a piece to the current literal, or begins a new one.
    fn take(&mut self, piece: Builder, has_holes: bool) {
        let of_piece = Wholeness::measure(&piece.text);
        let variable = if self.target.is_empty() { self.name.clone() } else { self.target.clone() };
        let join = match (self.between, &self.current) {
            (_, None) => false,
            (Between::Code, Some(current)) => self.adds && current.variable == variable,
            (Between::Nothing, _) => true,
            // An array of lines continues until the shader is complete.
            (Between::Comma, _) => !self.whole.is_whole() && (self.whole.begun || !of_piece.is_whole()),
        };
        match &mut self.current {
            Some(current) if join => {
                if self.between == Between::Comma && self.language != Language::C {
                    // Arrays of JavaScript and Python are joined by line ends.
                    current.text.push('\n', self.line, self.column);
                }
                current.text.append(&piece);
                current.has_holes |= has_holes;
                self.whole.add(of_piece);
            }
            _ => {
                self.end_literal();
                self.current = Some(Literal { variable, text: piece, has_holes });
                self.whole = of_piece;
            }
        }
        self.between = Between::Nothing;
    }

    /// Reads `'x'` or a digit separator.
    fn character(&mut self) {
        self.next();
        if self.previous.is_alphanumeric() {
            return;
        }
        let end = self.rest.char_indices().take(12).take_while(|&(_, c)| c != '\n').skip(1);
        let mut escaped = self.rest.starts_with('\\');
        let mut length = None;
        for (at, c) in end {
            if c == '\'' && !escaped {
                length = Some(at + 1);
                break;
            }
            escaped = c == '\\' && !escaped;
        }
        if let Some(length) = length {
            let stop = self.rest.len() - length;
            while self.rest.len() > stop && self.next().is_some() {}
        }
    }

    /// Reads `"delimiter( ... )delimiter"` from its first quote.
    fn raw(&mut self, piece: &mut Builder) -> bool {
        let Some(open) = self.rest.bytes().take(18).position(|b| b == b'(') else {
            self.next();
            return false;
        };
        let end = format!("){}\"", &self.rest[1..open]);
        let length = self.rest.find(&end).unwrap_or(self.rest.len());
        let stop = self.rest.len() - length;
        let start = self.rest.len() - (open + 1);
        while self.rest.len() > start && self.next().is_some() {}
        while self.rest.len() > stop {
            let (line, column) = (self.line, self.column);
            let Some(c) = self.next() else { break };
            piece.push(c, line, column);
        }
        self.skip(end.chars().count());
        true
    }

    /// Reads the content of a literal up to `end`. Without `lines`, a line end that is not continued ends it too.
    fn quoted(&mut self, piece: &mut Builder, end: &str, escapes: bool, lines: bool, has_holes: &mut bool) -> bool {
        while !self.rest.is_empty() {
            if self.rest.starts_with(end) {
                self.skip(end.len());
                return true;
            }
            let (line, column) = (self.line, self.column);
            if end == "`" && self.rest.starts_with("${") {
                *has_holes = true;
                self.skip_hole();
                continue;
            }
            let Some(c) = self.next() else { break };
            match c {
                '\\' if escapes => {
                    if let Some(c) = self.escape() {
                        piece.push(c, line, column);
                    }
                }
                // Not closed: not a literal, or an error that the program's compiler reports.
                '\n' if !lines => return false,
                _ => piece.push(c, line, column),
            }
        }
        // Never closed: if it spans lines, the end of the file may be missing.
        lines
    }

    /// Skips `${...}`, counting nested braces.
    fn skip_hole(&mut self) {
        let mut depth = 0u32;
        while let Some(c) = self.next() {
            match c {
                '{' => depth += 1,
                '}' if depth <= 1 => return,
                '}' => depth -= 1,
                _ => {}
            }
        }
    }

    /// Returns the character of an escape sequence; `None` for a continued line.
    fn escape(&mut self) -> Option<char> {
        Some(match self.next()? {
            '\n' => return None,
            'n' => '\n',
            't' => '\t',
            'r' => return None,
            '0' => return None,
            'a' | 'b' | 'f' | 'v' => ' ',
            'x' => return self.code_point(2),
            'u' => return self.code_point(4),
            c => c,
        })
    }

    fn code_point(&mut self, digits: usize) -> Option<char> {
        let mut value = 0;
        for _ in 0..digits {
            let Some(digit) = self.chars.peek().and_then(|c| c.to_digit(16)) else { break };
            value = value * 16 + digit;
            self.next();
        }
        char::from_u32(value).filter(|&c| c != '\0')
    }

    /// Reads `<script id="vertex-shader" type="x-shader/x-vertex">...</script>`.
    fn script(&mut self) -> bool {
        if !self.rest.get(..7).is_some_and(|tag| tag.eq_ignore_ascii_case("<script")) {
            return false;
        }
        let Some(close) = self.rest.bytes().take(1000).position(|b| b == b'>') else { return false };
        let tag = self.rest[..close].to_lowercase();
        let is_shader =
            tag.contains("shader") || tag.contains("glsl") || tag.contains("vertex") || tag.contains("fragment");
        if !is_shader || tag.contains("src=") {
            return false;
        }
        let variable =
            self.rest[7..close].chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect::<String>();
        let start = self.rest.len() - (close + 1);
        while self.rest.len() > start && self.next().is_some() {}
        let end = self.rest.find("</").unwrap_or(self.rest.len());
        let stop = self.rest.len() - end;
        let mut piece = Builder::new();
        while self.rest.len() > stop {
            let (line, column) = (self.line, self.column);
            let Some(c) = self.next() else { break };
            piece.push(c, line, column);
        }
        self.end_literal();
        self.found.push(Literal { variable: variable.trim().to_owned(), text: piece, has_holes: false });
        true
    }
}

/// Whether a text has a `main` with closed braces, counted piece by piece.
#[derive(Clone, Copy, Debug, Default)]
struct Wholeness {
    open: usize,
    close: usize,
    main: bool,
    /// Whether there is a directive or a statement, which the name of a shader never contains.
    begun: bool,
}

impl Wholeness {
    fn measure(text: &str) -> Self {
        let count = |brace| text.matches(brace).count();
        Self { open: count('{'), close: count('}'), main: text.contains("main"), begun: text.contains(['#', ';']) }
    }

    fn add(&mut self, other: Self) {
        self.open += other.open;
        self.close += other.close;
        self.main |= other.main;
        self.begun |= other.begun;
    }

    const fn is_whole(self) -> bool {
        self.main && self.open > 0 && self.open <= self.close
    }
}
