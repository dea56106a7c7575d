//! The same program written in other ways, which draws the same pictures. A checker that calls one of them wrong raises a false
//! alarm (metamorphic testing: Chen, Cheung and Yiu, 1998).

use super::source::{Source, range, replaced};
use gonio_check::roles::{Bindings, Role, VariableKind};
use gonio_check::submission::without_comments;
use gonio_glsl::ast::{BinaryOp, Call, Declaration, ExprKind, Function, Item, Param, StatementKind};
use gonio_glsl::walk::{Visitor, parts, walk_unit};
use gonio_glsl::{Expr, Stage, Statement, Type};
use std::collections::BTreeMap;
use std::ops::Range;

/// A rewritten program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rewrite {
    /// What was done, as in [`RewriteKind::word`], joined by `+`.
    pub name: String,
    /// The shaders.
    pub shaders: [String; 2],
}

/// A way to write a program differently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RewriteKind {
    /// Variables and functions have names without a meaning.
    MeaninglessNames,
    /// Inputs have other usual names.
    OtherInputNames,
    /// No comments, one space at most, Windows line ends.
    Layout,
    /// Operands in the other order, where that makes no difference.
    OtherOrder,
    /// Built-in functions written out, divisions as products.
    WrittenOut,
    /// Declarations without values, and assignments after them.
    Assignments,
    /// The work is done in a function that `main` calls.
    Function,
}

impl RewriteKind {
    /// All of them.
    pub const ALL: [RewriteKind; 7] = [
        RewriteKind::MeaninglessNames,
        RewriteKind::OtherInputNames,
        RewriteKind::Layout,
        RewriteKind::OtherOrder,
        RewriteKind::WrittenOut,
        RewriteKind::Assignments,
        RewriteKind::Function,
    ];

    /// The word in reports.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            RewriteKind::MeaninglessNames => "meaningless-names",
            RewriteKind::OtherInputNames => "other-input-names",
            RewriteKind::Layout => "layout",
            RewriteKind::OtherOrder => "other-order",
            RewriteKind::WrittenOut => "written-out",
            RewriteKind::Assignments => "assignments",
            RewriteKind::Function => "function",
        }
    }

    fn apply(self, shaders: &[String; 2], bindings: &Bindings) -> [String; 2] {
        let each = |change: &dyn Fn(&Source<'_>) -> String| {
            [change(&Source::new(Stage::Vertex, &shaders[0])), change(&Source::new(Stage::Fragment, &shaders[1]))]
        };
        match self {
            RewriteKind::MeaninglessNames => renamed(shaders, &meaningless(shaders)),
            RewriteKind::OtherInputNames => renamed(shaders, &usual(shaders, bindings)),
            RewriteKind::Layout => shaders.clone().map(|text| plain_layout(&text)),
            RewriteKind::OtherOrder => each(&|source| rewritten(source, &other_order)),
            RewriteKind::WrittenOut => each(&|source| rewritten(source, &written_out)),
            RewriteKind::Assignments => each(&assignments),
            RewriteKind::Function => each(&in_a_function),
        }
    }
}

/// Each rewrite alone, then all together; those that change nothing are left out.
#[must_use]
pub fn rewrites(reference: &[String; 2], bindings: &Bindings) -> Vec<Rewrite> {
    let mut all: Vec<Rewrite> = Vec::new();
    let mut add = |kinds: &[RewriteKind]| {
        let shaders = kinds.iter().fold(reference.clone(), |shaders, kind| kind.apply(&shaders, bindings));
        if shaders != *reference && all.iter().all(|known| known.shaders != shaders) {
            let name = kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>().join("+");
            all.push(Rewrite { name, shaders });
        }
    };
    RewriteKind::ALL.iter().for_each(|kind| add(&[*kind]));
    use RewriteKind::{Assignments, Function, Layout, MeaninglessNames, OtherInputNames, OtherOrder, WrittenOut};
    add(&[OtherOrder, WrittenOut, Assignments]);
    add(&[WrittenOut, OtherInputNames, Function, Layout]);
    add(&[OtherOrder, Assignments, MeaninglessNames, OtherInputNames, Layout]);
    all
}

/// A change of an expression, given the texts of its parts; `None` keeps it.
type ExprChange = dyn Fn(&Source<'_>, &Expr, &[String]) -> Option<String>;

/// The source with every expression rewritten from the inside out. `change` is given an expression and the texts of its parts.
fn rewritten(source: &Source<'_>, change: &ExprChange) -> String {
    fn text(source: &Source<'_>, expr: &Expr, change: &ExprChange) -> String {
        let parts = parts(expr);
        let texts: Vec<String> = parts.iter().map(|part| text(source, part, change)).collect();
        if let Some(new) = change(source, expr, &texts) {
            return new;
        }
        let from = range(expr).start;
        let edits = parts.iter().zip(&texts).map(|(part, text)| {
            let Range { start, end } = range(part);
            (start.saturating_sub(from)..end.saturating_sub(from), text.clone())
        });
        replaced(source.of(expr), edits.collect())
    }
    let roots = source.roots();
    // A macro's text is at the place of its use, and must stay.
    let is_written = |expr: &Expr| source.parsed.macros.iter().all(|name| !source.of(expr).contains(name.as_str()));
    let edits = roots.iter().filter(|expr| is_written(expr)).map(|expr| (range(expr), text(source, expr, change)));
    replaced(source.text, edits.collect())
}

fn other_order(_: &Source<'_>, expr: &Expr, parts: &[String]) -> Option<String> {
    let is_simple = |part: &Expr| matches!(part.ty, Some(Type::Scalar(_) | Type::Vector(..)));
    match (&expr.kind, parts) {
        (ExprKind::Binary { op: op @ (BinaryOp::Add | BinaryOp::Multiply), left, right }, [a, b])
            if is_simple(left) && is_simple(right) =>
        {
            Some(format!("({b} {} {a})", op.mark()))
        }
        (ExprKind::Call(Call { name, args, .. }), [a, b])
            if matches!(name.as_str(), "dot" | "max" | "min") && args[0].ty.is_some() && args[0].ty == args[1].ty =>
        {
            Some(format!("{name}({b}, {a})"))
        }
        _ => None,
    }
}

fn written_out(source: &Source<'_>, expr: &Expr, parts: &[String]) -> Option<String> {
    let is_name = |expr: &Expr| matches!(expr.kind, ExprKind::Name(_));
    match (&expr.kind, parts) {
        (ExprKind::Binary { op: BinaryOp::Divide, left, right }, [a, b])
            if left.ty == Some(Type::FLOAT) && right.ty == Some(Type::FLOAT) && source.of(left) != "1.0" =>
        {
            Some(format!("({a} * (1.0 / ({b})))"))
        }
        (ExprKind::Binary { op: BinaryOp::Subtract, left, right }, [a, b]) if left.ty == right.ty => {
            Some(format!("({a} + -({b}))"))
        }
        (ExprKind::Call(Call { name, args, .. }), [only]) if is_name(&args[0]) => match name.as_str() {
            "normalize" => Some(format!("({only} / sqrt(dot({only}, {only})))")),
            "length" => Some(format!("sqrt(dot({only}, {only}))")),
            _ => None,
        },
        (ExprKind::Call(Call { name, args, .. }), [a, b]) if name == "reflect" && is_name(&args[1]) => {
            Some(format!("({a} - 2.0 * dot({b}, {a}) * {b})"))
        }
        _ => None,
    }
}

/// `vec3 N = f();` as `vec3 N; N = f();`
fn assignments(source: &Source<'_>) -> String {
    struct Locals<'a, 'b> {
        source: &'b Source<'a>,
        edits: Vec<(Range<usize>, String)>,
    }
    impl Visitor for Locals<'_, '_> {
        fn statement(&mut self, statement: &Statement) -> bool {
            if let StatementKind::For { .. } | StatementKind::While { .. } = statement.kind {
                return false;
            }
            let StatementKind::Declaration(declaration) = &statement.kind else { return true };
            let [only] = declaration.declarators.as_slice() else { return true };
            let is_plain =
                declaration.qualifiers.is_empty() && only.sizes.is_empty() && declaration.ty.sizes.is_empty();
            if let Some(value) = only.initialiser.as_ref().filter(|_| is_plain && declaration.ty.definition.is_none()) {
                let range = statement.span.start as usize..statement.span.end as usize;
                let text = self.source.slice(range.clone());
                if text.ends_with(';') {
                    let (ty, name) = (&declaration.ty.name, &only.name);
                    self.edits.push((range, format!("{ty} {name}; {name} = {};", self.source.of(value))));
                }
            }
            true
        }
    }
    let mut locals = Locals { source, edits: Vec::new() };
    walk_unit(&source.parsed.unit, &mut locals);
    replaced(source.text, locals.edits)
}

/// The body of `main` in another function.
fn in_a_function(source: &Source<'_>) -> String {
    let main = source.parsed.unit.items.iter().find_map(|item| match item {
        Item::Function(function) if function.name == "main" && function.body.is_some() => Some(function),
        _ => None,
    });
    let Some(Function { name_span, .. }) = main else { return source.text.to_owned() };
    let at = name_span.start as usize..name_span.end as usize;
    let text = replaced(source.text, vec![(at, "computeAll".to_owned())]);
    format!("{}\n\nvoid main()\n{{\n    computeAll();\n}}\n", text.trim_end())
}

/// No comments and no blank lines, one space at most, Windows line ends.
fn plain_layout(text: &str) -> String {
    let code = without_comments(text);
    let lines = code.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    lines.filter(|line| !line.is_empty()).map(|line| line + "\r\n").collect()
}

/// New names without a meaning for varyings, functions and local variables.
fn meaningless(shaders: &[String; 2]) -> BTreeMap<String, String> {
    struct Own(Vec<String>);
    impl Visitor for Own {
        fn function(&mut self, function: &Function) -> bool {
            if function.name != "main" {
                self.0.push(function.name.clone());
            }
            true
        }
        fn param(&mut self, param: &Param) {
            self.0.push(param.name.clone());
        }
        fn statement(&mut self, statement: &Statement) -> bool {
            if let StatementKind::Declaration(Declaration { declarators, .. }) = &statement.kind {
                self.0.extend(declarators.iter().map(|declarator| declarator.name.clone()));
            }
            true
        }
    }
    let sources = [Source::new(Stage::Vertex, &shaders[0]), Source::new(Stage::Fragment, &shaders[1])];
    let mut own = Own(Vec::new());
    for source in &sources {
        walk_unit(&source.parsed.unit, &mut own);
    }
    let [vertex, fragment] = &sources;
    own.0.extend(fragment.checked.interface.inputs.iter().map(|varying| varying.name.clone()));
    own.0.extend(vertex.checked.interface.outputs.iter().map(|varying| varying.name.clone()));
    own.0.extend(fragment.checked.interface.outputs.iter().map(|output| output.name.clone()));
    let mut fixed: Vec<&str> = Vec::new();
    for source in &sources {
        fixed.extend(source.checked.interface.uniforms.iter().map(|uniform| uniform.name.as_str()));
        fixed.extend(source.parsed.macros.iter().map(String::as_str));
    }
    fixed.extend(vertex.checked.interface.inputs.iter().map(|attribute| attribute.name.as_str()));
    own.0.sort();
    own.0.dedup();
    let renamed = own
        .0
        .into_iter()
        .filter(|name| !name.is_empty() && !name.starts_with("gl_") && !fixed.contains(&name.as_str()));
    renamed.enumerate().map(|(at, name)| (name, format!("x{}q", at + 1))).collect()
}

/// Other usual names for the inputs with a role, where nothing has that name yet.
fn usual(shaders: &[String; 2], bindings: &Bindings) -> BTreeMap<String, String> {
    let name = |role: Role, kind: VariableKind| match (role, kind) {
        (Role::Position, VariableKind::Attribute) => Some("aPos"),
        (Role::Normal, VariableKind::Attribute) => Some("aNormal"),
        (Role::TexCoord, VariableKind::Attribute) => Some("aTexCoords"),
        (Role::Model, _) => Some("modelMatrix"),
        (Role::View, _) => Some("viewMatrix"),
        (Role::Projection, _) => Some("projectionMatrix"),
        (Role::NormalMatrix, _) => Some("normalMatrix"),
        (Role::ViewPos, _) => Some("cameraPosition"),
        (Role::LightPos(0), _) => Some("lightPosition"),
        (Role::Shininess, _) => Some("specularExponent"),
        (Role::MaterialColor, _) => Some("objectColor"),
        _ => None,
    };
    let renamed = bindings.bound.iter().filter_map(|bound| {
        let (old, new) = (&bound.declared.name, name(bound.role, bound.declared.kind)?);
        let is_plain = old.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        (is_plain && shaders.iter().all(|text| !text.contains(new))).then(|| (old.clone(), new.to_owned()))
    });
    renamed.collect()
}

/// The shaders with words renamed, except members and words in directives.
fn renamed(shaders: &[String; 2], names: &BTreeMap<String, String>) -> [String; 2] {
    shaders.clone().map(|text| {
        let code = without_comments(&text);
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut edits = Vec::new();
        let mut at = 0;
        // Comments are replaced by as many characters; bytes agree only where they are ASCII.
        let code = if code.len() == text.len() { code } else { text.clone() };
        while let Some(start) = code[at..].find(is_word).map(|start| at + start) {
            let end = code[start..].find(|c| !is_word(c)).map_or(code.len(), |length| start + length);
            let before = code[..start].trim_end();
            let line = code[..start].rsplit('\n').next().unwrap_or_default();
            if !before.ends_with('.')
                && !line.trim_start().starts_with('#')
                && let Some(new) = names.get(&code[start..end])
            {
                edits.push((start..end, new.clone()));
            }
            at = end;
        }
        replaced(&text, edits)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTEX: &str = "#version 330 core\nin vec3 position; // place\nuniform mat4 M;\nout vec3 v;\nvoid main() {\n    vec4 p = M * vec4(position, 1.0);\n    gl_Position = p;\n    v = p.xyz;\n}\n";
    const FRAGMENT: &str = "#version 330 core\nin vec3 v;\nuniform vec3 a;\nout vec4 c;\nvoid main() {\n    vec3 n = normalize(v);\n    c = vec4(max(dot(n, a) / 2.0, 0.0));\n}\n";

    fn shaders() -> [String; 2] {
        [VERTEX.to_owned(), FRAGMENT.to_owned()]
    }

    #[test]
    fn rewrites_change_what_they_say() {
        let apply = |kind: RewriteKind| kind.apply(&shaders(), &Bindings::default());
        let [vertex, fragment] = apply(RewriteKind::MeaninglessNames);
        assert!(!vertex.contains(" v;") && vertex.contains("uniform mat4 M;") && vertex.contains(".xyz"), "{vertex}");
        let varying = vertex.split("out vec3 ").nth(1).unwrap().split(';').next().unwrap();
        assert!(fragment.contains(&format!("in vec3 {varying};")), "{fragment}");
        assert!(apply(RewriteKind::OtherOrder)[1].contains("max(0.0, dot(a, n) / 2.0)"));
        let fragment = &apply(RewriteKind::WrittenOut)[1];
        assert!(
            fragment.contains("(v / sqrt(dot(v, v)))") && fragment.contains("(dot(n, a) * (1.0 / (2.0)))"),
            "{fragment}"
        );
        assert!(apply(RewriteKind::Assignments)[1].contains("vec3 n; n = normalize(v);"));
        assert!(apply(RewriteKind::Function)[0].ends_with("void main()\n{\n    computeAll();\n}\n"));
        let vertex = &apply(RewriteKind::Layout)[0];
        assert!(vertex.contains("in vec3 position;\r\nuniform") && !vertex.contains("  "), "{vertex}");
        // A product of a matrix and a vector has an order.
        assert!(apply(RewriteKind::OtherOrder)[0].contains("M * vec4(position, 1.0)"));
    }
}
