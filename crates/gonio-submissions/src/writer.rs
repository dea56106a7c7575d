//! Writes the text of a stage: declarations, functions, statements in an order that keeps their meaning, and layout.

use crate::expression::Random;
use crate::expression::{Expr, Site, plain, take_marks};
use crate::names::{HEADERS, Names, comment};
use crate::plan::{Answer, Plan, Version};
use crate::scenes::Meaning;

/// How a text looks.
#[derive(Clone, Debug)]
pub(crate) struct Style {
    indent: &'static str,
    brace_on_its_own_line: bool,
    windows_lines: bool,
    tight: bool,
    zero: &'static str,
    /// The language of comments, by [`comment`].
    language: usize,
    comments: f64,
    /// How often a value that is used once has no variable.
    inline: f64,
    /// How often declaration and assignment are apart.
    split: f64,
    shuffles: bool,
    merges_declarations: bool,
}

impl Style {
    /// Whether integers are written where numbers are needed.
    pub fn has_integers(&self) -> bool {
        self.zero == "0"
    }
}

impl Style {
    pub fn draw(language: usize, version: Version, random: &mut Random) -> Self {
        let zeros: &[&str] = match (version.converts_integers(), version.has_f_suffix()) {
            (true, true) => &["0.0", "0.0", "0.0", "0.", "0.0f", "0.0f", "0"],
            (true, false) => &["0.0", "0.0", "0.", "0"],
            (false, true) => &["0.0", "0.0", "0.", "0.0f"],
            (false, false) => &["0.0", "0.0", "0."],
        };
        Style {
            indent: random.pick(&["    ", "    ", "\t", "  "]).unwrap_or("\t"),
            brace_on_its_own_line: random.chance(0.35),
            windows_lines: random.chance(0.12),
            tight: random.chance(0.25),
            zero: random.pick(zeros).unwrap_or("0.0"),
            language,
            comments: random.pick(&[0.0, 0.0, 0.15, 0.4, 0.9]).unwrap_or(0.0),
            inline: random.pick(&[0.0, 0.1, 0.3, 0.6, 1.0]).unwrap_or(0.3),
            split: if random.chance(0.12) { 0.5 } else { 0.0 },
            shuffles: random.chance(0.45),
            merges_declarations: random.chance(0.12),
        }
    }
}

/// An input of the program, and its value in a scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Input {
    /// Its name in OpenGL.
    pub name: String,
    pub meaning: Meaning,
}

/// Statements of one function.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block(Vec<Statement>);

#[derive(Clone, Debug)]
struct Statement {
    text: String,
    comment: Option<&'static str>,
}

/// Everything that both stages are written with.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub answer: &'a Answer,
    pub plan: &'a Plan,
    pub names: &'a Names,
    pub style: &'a Style,
    /// The keys of the mistakes that are made.
    pub slips: &'a [&'static str],
    pub random: Random,
}

/// One stage while it is written. Decisions are drawn by name, so that a mistake leaves the others as they are.
pub(crate) struct Writer<'a> {
    pub context: Context<'a>,
    /// 0 for the vertex shader, 1 for the fragment shader.
    pub stage: usize,
    declared: Vec<(String, String)>,
    varyings: Vec<(String, String)>,
    functions: Vec<String>,
    pub inputs: Vec<Input>,
}

impl<'a> Writer<'a> {
    pub fn new(context: Context<'a>, stage: usize) -> Self {
        Writer { context, stage, declared: vec![], varyings: vec![], functions: vec![], inputs: vec![] }
    }

    pub fn version(&self) -> Version {
        self.context.plan.versions[self.stage]
    }

    /// Whether a mistake is made.
    pub fn slips(&self, key: &str) -> bool {
        self.context.slips.contains(&key)
    }

    /// The first of some mistakes that is made.
    pub fn slip<'k>(&self, keys: &[&'k str]) -> Option<&'k str> {
        keys.iter().copied().find(|key| self.slips(key))
    }

    pub fn coin(&self, name: &str, probability: f64) -> bool {
        self.context.random.named(name, self.stage as u64).chance(probability)
    }

    pub fn choice(&self, name: &str, count: usize) -> usize {
        self.context.random.named(name, self.stage as u64).below(count)
    }

    pub fn name(&self, key: &str) -> Expr {
        Expr::atom(self.context.names.get(key))
    }

    /// Zero where a number is needed and an integer would do.
    pub fn zero(&self) -> Expr {
        Expr::atom(self.context.style.zero)
    }

    /// A number as an operand or an argument of a constructor.
    pub fn number(&self, value: f32) -> Expr {
        let suffix = if self.context.style.zero.ends_with('f') { "f" } else { "" };
        Expr::atom(match self.context.style.zero {
            "0." if value.fract() == 0.0 => format!("{value:.0}."),
            _ => format!("{value:?}{suffix}"),
        })
    }

    pub fn vec4(&self, xyz: &Expr, w: f32) -> Expr {
        Expr::call("vec4", &[xyz, &self.number(w)])
    }

    /// The first three components, as `.xyz` or `vec3()`.
    pub fn xyz(&self, of: &Expr, decision: &str) -> Expr {
        if self.coin(decision, 0.5) { of.field("xyz") } else { Expr::call("vec3", &[of]) }
    }

    pub fn uniform(&mut self, key: &str, ty: &str, meaning: Meaning) -> Expr {
        let name = self.context.names.get(key).to_owned();
        self.declare(&format!("uniform {ty}"), &name);
        self.input(&name, meaning);
        Expr::atom(name)
    }

    pub fn attribute(&mut self, key: &str, ty: &str, meaning: Meaning) -> Expr {
        let name = self.context.names.get(key).to_owned();
        let word = if self.version().has_in_and_out() { "in" } else { "attribute" };
        let number = ["position", "normal", "tex_coord"].iter().position(|known| *known == key).unwrap_or(3);
        let located = self.version().has_locations() && self.coin("locations", 0.35);
        let location = if located { format!("layout (location = {number}) ") } else { String::new() };
        self.declare(&format!("{location}{word} {ty}"), &name);
        self.input(&name, meaning);
        Expr::atom(name)
    }

    /// A value from the vertex shader to the fragment shader.
    pub fn varying(&mut self, key: &str, ty: &str) -> Expr {
        let name = self.context.names.get(key).to_owned();
        if !self.varyings.iter().any(|(_, known)| *known == name) {
            self.varyings.push((ty.to_owned(), name.clone()));
        }
        if self.context.plan.varying_block {
            Expr::atom(format!("{}.{name}", self.context.names.get("varying_block")))
        } else {
            Expr::atom(name)
        }
    }

    /// A declaration outside of functions, once.
    pub fn declare(&mut self, before: &str, name: &str) {
        let declaration = (before.to_owned(), name.to_owned());
        if !self.declared.contains(&declaration) {
            self.declared.push(declaration);
        }
    }

    pub fn input(&mut self, name: &str, meaning: Meaning) {
        if !self.inputs.iter().any(|input| input.name == name) {
            self.inputs.push(Input { name: name.to_owned(), meaning });
        }
    }

    /// Adds a function of this stage; `head` is everything before the body.
    pub fn function(&mut self, head: &str, body: &Block) {
        let text = format!("{head} {{\n{}}}", self.body(body, head));
        if !self.functions.contains(&text) {
            self.functions.push(text);
        }
    }

    /// A value for further use: a new variable, or the expression itself if it is used once.
    pub fn value(&self, block: &mut Block, key: &str, ty: &str, value: Expr, uses: usize) -> Expr {
        let inline = uses <= 1 && self.coin(&format!("inline {key}"), self.context.style.inline);
        if inline { value } else { self.variable(block, key, ty, &value) }
    }

    /// A new variable.
    pub fn variable(&self, block: &mut Block, key: &str, ty: &str, value: &Expr) -> Expr {
        let name = self.context.names.get(key);
        // The same variable again, for a second use.
        let is_same = |statement: &Statement| {
            let text = plain(&statement.text);
            text == format!("{ty} {name} = {};", plain(&value.text))
                || text == format!("{name} = {};", plain(&value.text))
        };
        if block.0.iter().any(is_same) {
            return Expr::atom(name);
        }
        let said = self.coin(&format!("comment {key}"), self.context.style.comments);
        let comment = comment(key, self.context.style.language).filter(|_| said);
        if self.coin(&format!("split {key}"), self.context.style.split) {
            block.0.push(Statement { text: format!("{ty} {name};"), comment: None });
            block.0.push(Statement { text: format!("{name} = {};", value.text), comment });
        } else {
            block.0.push(Statement { text: format!("{ty} {name} = {};", value.text), comment });
        }
        Expr::atom(name)
    }

    /// Any other statement; further lines are indented by tabs.
    pub fn statement(&self, block: &mut Block, text: String) {
        block.0.push(Statement { text, comment: None });
    }

    /// The lines of a function's body.
    pub fn body(&self, block: &Block, decision: &str) -> String {
        let statements = if self.context.style.shuffles {
            shuffled(&block.0, self.context.random.named(decision, self.stage as u64 + 7))
        } else {
            block.0.clone()
        };
        let mut text = String::new();
        for (index, statement) in statements.iter().enumerate() {
            let code = statement.text.replace('\n', "\n\t");
            let code = self.broken(&code);
            match statement.comment {
                Some(comment) if index % 2 == 0 => text.push_str(&format!("\t// {comment}\n\t{code}\n")),
                Some(comment) => text.push_str(&format!("\t{code} // {comment}\n")),
                None => text.push_str(&format!("\t{code}\n")),
            }
            if self.coin(&format!("blank {decision} {index}"), 0.12) {
                text.push('\n');
            }
        }
        text
    }

    /// A long line in two.
    fn broken(&self, code: &str) -> String {
        let at = code.char_indices().position(|(at, _)| at > 60 && code[at..].starts_with(" + "));
        let at = at.and_then(|place| code.char_indices().nth(place)).map(|(at, _)| at);
        match at {
            Some(at) if code.len() > 100 && !code.contains('\n') && self.coin("break", 0.5) => {
                format!("{}\n\t\t+ {}", &code[..at], &code[at + 3..])
            }
            _ => code.to_owned(),
        }
    }

    /// Adds what programs declare and never use.
    pub fn leftovers(&mut self) {
        if self.stage == 0 && self.coin("unused attribute", 0.3) {
            self.attribute("tex_coord", "vec2", Meaning::Unused);
        }
        if self.coin("unused uniform", 0.06) {
            self.uniform("time", "float", Meaning::Unused);
        }
        if self.coin("unused function", 0.08) {
            let [name, x] = ["helper", "arg_x"].map(|key| self.name(key).text);
            self.functions.push(format!("float {name}(float {x}) {{\n\treturn {x} * {x};\n}}"));
        }
    }

    /// The whole text, and the lines of each quantity.
    pub fn finish(self, main: &Block) -> (String, Vec<(Site, u32)>) {
        let (style, version) = (self.context.style, self.version());
        let mut text = String::new();
        let number = version.number;
        let profile = if number >= 330 && self.coin("core", 0.8) { " core" } else { "" };
        match number {
            300 => text.push_str("#version 300 es\n"),
            110 if self.coin("no version", 0.5) => {}
            _ => text.push_str(&format!("#version {number}{}\n", if version.is_es() { "" } else { profile })),
        }
        if style.comments > 0.0 && self.coin("header", 0.5) {
            let lines = HEADERS[style.language.min(3)];
            text.push_str(&format!("// {}\n", lines[self.choice("which header", lines.len())]));
        }
        if version.is_es() && self.stage == 1 || version.number >= 130 && self.coin("precision", 0.08) {
            text.push_str("precision highp float;\n");
        }
        let declarations = self.declarations();
        text.push_str(&declarations);
        for function in &self.functions {
            text.push_str(&format!("\n{function}\n"));
        }
        text.push_str(&format!("\nvoid main() {{\n{}}}\n", self.body(main, "main")));
        let text = laid_out(&text, style);
        take_marks(&if style.windows_lines { text.replace('\n', "\r\n") } else { text })
    }

    fn declarations(&self) -> String {
        let version = self.version();
        let mut lines: Vec<(String, String)> = self.declared.clone();
        let word = match (version.has_in_and_out(), self.stage) {
            (false, _) => "varying",
            (true, 0) => "out",
            (true, _) => "in",
        };
        if self.context.plan.varying_block && !self.varyings.is_empty() {
            let members: Vec<String> =
                self.sorted_varyings().iter().map(|(ty, name)| format!("\t{ty} {name};\n")).collect();
            let [ty, instance] = ["varying_type", "varying_block"].map(|key| self.context.names.get(key));
            lines.push((format!("{word} {ty} {{\n{}}}", members.concat()), instance.to_owned()));
        } else {
            lines.extend(self.varyings.iter().map(|(ty, name)| (format!("{word} {ty}"), name.clone())));
        }
        // Structs and constants come before their uses.
        let is_type = |line: &(String, String)| line.0.starts_with("struct") || line.0.starts_with('#');
        let (mut first, mut others): (Vec<_>, Vec<_>) = lines.into_iter().partition(is_type);
        if self.coin("order of declarations", 0.5) {
            let mut random = self.context.random.named("declarations", self.stage as u64);
            for index in (1..others.len()).rev() {
                others.swap(index, random.below(index + 1));
            }
        }
        first.append(&mut others);
        let mut text = String::new();
        let mut merged: Vec<(String, String)> = Vec::new();
        for (before, name) in first {
            let same = merged.iter_mut().find(|(known, _)| *known == before && before.starts_with("uniform"));
            match same {
                Some((_, names)) if self.context.style.merges_declarations => *names = format!("{names}, {name}"),
                _ => merged.push((before, name)),
            }
        }
        for (before, name) in merged {
            let end = if before.starts_with('#') { "" } else { ";" };
            let space = if name.is_empty() { "" } else { " " };
            text.push_str(&format!("{before}{space}{name}{end}\n"));
        }
        text
    }

    /// Both stages list a block's members in the same order.
    fn sorted_varyings(&self) -> Vec<(String, String)> {
        let mut all = self.varyings.clone();
        all.sort_by(|a, b| a.1.cmp(&b.1));
        all
    }
}

/// The names in a text.
fn words(text: &str) -> Vec<String> {
    plain(text).split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty()).map(str::to_owned).collect()
}

/// The names that a statement may write.
fn written(text: &str) -> Vec<String> {
    if text.contains('{') || text.contains('\n') {
        return words(text);
    }
    let before = text.split('=').next().unwrap_or(text);
    let all = words(before);
    // `vec3 N = ...` and `N += ...`, but `N.x = ...`, `N[3] = ...`, `data.N = ...`.
    if before.contains(['.', '[']) { all } else { all.last().cloned().into_iter().collect() }
}

/// The statements in a random order in which every value is computed before it is used.
fn shuffled(statements: &[Statement], mut random: Random) -> Vec<Statement> {
    let sets: Vec<(Vec<String>, Vec<String>)> =
        statements.iter().map(|statement| (written(&statement.text), words(&statement.text))).collect();
    let meet = |a: &[String], b: &[String]| a.iter().any(|word| b.contains(word));
    let depends =
        |later: usize, earlier: usize| meet(&sets[earlier].0, &sets[later].1) || meet(&sets[later].0, &sets[earlier].1);
    let mut left: Vec<usize> = (0..statements.len()).collect();
    let mut order = Vec::new();
    while !left.is_empty() {
        let ready: Vec<usize> = left
            .iter()
            .copied()
            .filter(|&one| left.iter().all(|&other| other >= one || !depends(one, other)))
            // A return comes last.
            .filter(|&one| left.len() == 1 || !statements[one].text.starts_with("return"))
            .collect();
        let Some(next) = random.pick(&ready).or(left.first().copied()) else { break };
        left.retain(|&one| one != next);
        order.push(statements[next].clone());
    }
    order
}

/// Indentation, braces and spaces in a style.
fn laid_out(text: &str, style: &Style) -> String {
    let mut lines = Vec::new();
    for line in text.lines() {
        let depth = line.chars().take_while(|c| *c == '\t').count();
        let (code, comment) = match line.find("//") {
            Some(at) => line.split_at(at),
            None => (line, ""),
        };
        let mut code = code[depth.min(code.len())..].to_owned();
        if style.tight && !code.starts_with('#') {
            for (wide, narrow) in [(" * ", "*"), (", ", ","), (" / ", "/"), (" > ", ">")] {
                code = code.replace(wide, narrow);
            }
        }
        let indent = style.indent.repeat(depth);
        match code.strip_suffix(" {") {
            Some(head) if style.brace_on_its_own_line => {
                lines.push(format!("{indent}{head}"));
                lines.push(format!("{indent}{{"));
            }
            _ if code.is_empty() && comment.is_empty() => lines.push(String::new()),
            _ => lines.push(format!("{indent}{code}{comment}")),
        }
    }
    lines.join("\n") + "\n"
}
