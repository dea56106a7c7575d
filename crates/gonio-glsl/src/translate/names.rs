//! Renames old functions, replaces the built-in variables of old OpenGL by attributes, varyings and uniforms, and
//! renames the student's names that conflict with the output version.

use super::{COLOUR, Rename, Translator};
use crate::ast::{Expr, ExprKind};
use crate::check::{Storage, SymbolKind};
use crate::walk::{Visitor, walk_unit};
use crate::{Problem, Stage, Type, builtins, lex};
use std::collections::BTreeSet;

impl Translator<'_> {
    pub(super) fn names(&mut self) {
        self.functions();
        self.outputs();
        self.own_names();
    }

    /// Renames `texture2D` and similar functions.
    fn functions(&mut self) {
        for (name, tokens, first) in &self.checked.function_uses {
            if let Some(new) = crate::check::modern(name) {
                self.replace_token(tokens.first, new);
            } else if name == "fma" {
                self.replace_token(tokens.first, "gonio_fma");
                for ty in ["float", "vec2", "vec3", "vec4"] {
                    self.preamble.insert(format!("{ty} gonio_fma({ty} a, {ty} b, {ty} c) {{ return a * b + c; }}"));
                }
            } else if name != "ftransform" && !builtins::exists(name, self.target.version()) {
                let message =
                    format!("the function `{name}` is not available in version {}", self.target.version().written());
                self.problems.push(Problem::strict(
                    self.parsed.tokens[tokens.first as usize].span,
                    "no-translation",
                    message,
                ));
            }
            if let (Some(Type::Opaque(sampler)), true) = (first, self.is_es())
                && (sampler.contains("1D") || sampler.contains("Rect") || sampler.contains("Buffer"))
            {
                let span = self.parsed.tokens[tokens.first as usize].span;
                let message = format!("WebGL 2 has no `{sampler}`");
                self.problems.push(Problem::strict(span, "no-translation", message));
            }
        }
    }

    /// Replaces `gl_FragColor` and `gl_FragData[..]`.
    fn outputs(&mut self) {
        struct Data(Vec<(crate::TokenRange, u32, f64)>);
        impl Visitor for Data {
            fn expression(&mut self, expr: &Expr) -> bool {
                if let ExprKind::Index { base, index } = &expr.kind
                    && matches!(&base.kind, ExprKind::Name(name) if name == "gl_FragData")
                    && let Some(value) = crate::constant::evaluate(index, &|_| None)
                {
                    self.0.push((expr.tokens, base.tokens.first, value.first().copied().unwrap_or(0.0)));
                }
                true
            }
        }
        let is_own = self.checked.symbols.iter().any(|s| matches!(&*s.name, "gl_FragColor" | "gl_FragData"));
        let is_used = |name: &str| self.checked.variables_used.contains(name);
        if is_own || !(is_used("gl_FragColor") || is_used("gl_FragData")) {
            return;
        }
        self.preamble.insert(format!("out vec4 {COLOUR};"));
        for (name, tokens) in &self.checked.variable_uses {
            if name == "gl_FragColor" {
                self.replace_token(tokens.first, COLOUR);
            }
        }
        let mut data = Data(Vec::new());
        walk_unit(&self.parsed.unit, &mut data);
        for (tokens, base, index) in data.0 {
            let name = if index == 0.0 { COLOUR.to_string() } else { format!("gonio_FragData{index}") };
            if index != 0.0 {
                self.preamble.insert(format!("vec4 {name};"));
            }
            // The index may be a macro; its bracket is not.
            match self.stretch(tokens) {
                Some((start, end)) => self.edits.replace(start, end, name),
                None => self.cannot(self.parsed.tokens[base as usize].span, "`gl_FragData` is used in a macro here"),
            }
        }
    }

    /// Renames the student's names that are reserved in the output version, or that hide a function that is called.
    fn own_names(&mut self) {
        let mut taken: BTreeSet<String> = self.checked.symbols.iter().map(|s| s.name.clone()).collect();
        taken.extend(self.parsed.macros.iter().cloned());
        let target = self.target.version();
        let mut done: Vec<(String, String)> = Vec::new();
        for (id, symbol) in self.checked.symbols.iter().enumerate() {
            let name = &symbol.name;
            let is_shared = symbol.kind == SymbolKind::Global && matches!(symbol.storage, Storage::In | Storage::Out);
            let is_function = symbol.kind == SymbolKind::Function;
            let is_builtin = builtins::exists(name, target);
            let is_bad = lex::is_reserved(name, target)
                || name.contains("__")
                || name.starts_with("gl_") && builtins::variable(name, self.stage(), target).is_none_or(|f| f.is_err())
                || name.starts_with("webgl_")
                || self.checked.hiding.contains(&id)
                || self.hides_modern(symbol)
                // Both stages must choose the same name independently.
                || is_shared && is_builtin
                || is_function && is_builtin && self.is_es();
            if !is_bad || name.is_empty() {
                continue;
            }
            let new = match done.iter().find(|(from, _)| from == name) {
                Some((_, to)) => to.clone(),
                None => new_name(name, &taken),
            };
            taken.insert(new.clone());
            done.push((name.clone(), new.clone()));
            self.replace_token(symbol.declared.first, &new);
            for tokens in &symbol.uses {
                self.replace_token(tokens.first, &new);
            }
            let is_interface = is_shared || symbol.storage == Storage::Uniform;
            self.renames.push(Rename { from: name.clone(), to: new, span: symbol.span, is_interface });
        }
    }

    /// Whether a variable is called `texture` and `texture2D` becomes `texture`.
    fn hides_modern(&self, symbol: &crate::Symbol) -> bool {
        let is_variable = symbol.kind != SymbolKind::Function;
        is_variable
            && self.checked.functions_used.iter().any(|f| crate::check::modern(f).is_some_and(|new| new == symbol.name))
    }
}

fn new_name(name: &str, taken: &BTreeSet<String>) -> String {
    let mut new = name.to_string();
    while new.contains("__") {
        new = new.replace("__", "_");
    }
    if let Some(rest) = new.strip_prefix("gl_").or_else(|| new.strip_prefix("webgl_")) {
        new = if name == "gl_FragColor" { COLOUR.to_string() } else { format!("my_{rest}") };
    }
    if new == name && !new.ends_with('_') {
        new.push('_');
    }
    let mut count = 2;
    let mut found = new.clone();
    while taken.contains(&found) || found == name {
        found = format!("{}{count}", new.trim_end_matches('_'));
        count += 1;
    }
    found
}

/// Old name, replacement, and declaration; `{}` is `out` or `in`.
const VERTEX: [(&str, &str, &str); 8] = [
    ("gl_Vertex", "gonio_Vertex", "in vec4 gonio_Vertex;"),
    ("gl_Normal", "gonio_Normal", "in vec3 gonio_Normal;"),
    ("gl_Color", "gonio_VertexColor", "in vec4 gonio_VertexColor;"),
    ("gl_FrontColor", "gonio_Color", "out vec4 gonio_Color;"),
    ("gl_BackColor", "gonio_BackColor", "vec4 gonio_BackColor;"),
    ("gl_TexCoord", "gonio_TexCoord", "out vec4 gonio_TexCoord[8];"),
    ("gl_FogFragCoord", "gonio_FogFragCoord", "out float gonio_FogFragCoord;"),
    ("gl_ClipVertex", "gonio_ClipVertex", "vec4 gonio_ClipVertex;"),
];

const FRAGMENT: [(&str, &str, &str); 3] = [
    ("gl_Color", "gonio_Color", "in vec4 gonio_Color;"),
    ("gl_TexCoord", "gonio_TexCoord", "in vec4 gonio_TexCoord[8];"),
    ("gl_FogFragCoord", "gonio_FogFragCoord", "in float gonio_FogFragCoord;"),
];

const BOTH: [(&str, &str, &str); 9] = [
    ("gl_ModelViewMatrix", "gonio_ModelViewMatrix", "uniform mat4 gonio_ModelViewMatrix;"),
    ("gl_ProjectionMatrix", "gonio_ProjectionMatrix", "uniform mat4 gonio_ProjectionMatrix;"),
    (
        "gl_ModelViewProjectionMatrix",
        "gonio_ModelViewProjectionMatrix",
        "uniform mat4 gonio_ModelViewProjectionMatrix;",
    ),
    ("gl_NormalMatrix", "gonio_NormalMatrix", "uniform mat3 gonio_NormalMatrix;"),
    ("gl_TextureMatrix", "gonio_TextureMatrix", "uniform mat4 gonio_TextureMatrix[8];"),
    ("gl_ModelViewMatrixInverse", "inverse(gonio_ModelViewMatrix)", "uniform mat4 gonio_ModelViewMatrix;"),
    ("gl_ModelViewMatrixTranspose", "transpose(gonio_ModelViewMatrix)", "uniform mat4 gonio_ModelViewMatrix;"),
    (
        "gl_ModelViewMatrixInverseTranspose",
        "transpose(inverse(gonio_ModelViewMatrix))",
        "uniform mat4 gonio_ModelViewMatrix;",
    ),
    ("gl_ProjectionMatrixInverse", "inverse(gonio_ProjectionMatrix)", "uniform mat4 gonio_ProjectionMatrix;"),
];

impl Translator<'_> {
    pub(super) fn legacy(&mut self) {
        let own: &[_] = if self.stage() == Stage::Vertex { &VERTEX } else { &FRAGMENT };
        let target = self.target.version();
        for (name, tokens) in &self.checked.variable_uses {
            if matches!(&**name, "gl_FragColor" | "gl_FragData") {
                continue;
            }
            if let Some((_, new, line)) = own.iter().chain(&BOTH).find(|row| row.0 == name) {
                self.replace_token(tokens.first, new);
                self.preamble.insert((*line).to_string());
                continue;
            }
            if let Some(number) = name.strip_prefix("gl_MultiTexCoord").filter(|_| self.stage() == Stage::Vertex) {
                let new = format!("gonio_MultiTexCoord{number}");
                self.replace_token(tokens.first, &new);
                self.preamble.insert(format!("in vec4 {new};"));
                continue;
            }
            if let Some(new) = self.fixed_state(name) {
                self.replace_token(tokens.first, &new);
                continue;
            }
            let is_there = crate::builtins::variable(name, self.stage(), target).is_some_and(|f| f.is_ok());
            if !is_there {
                let span = self.parsed.tokens[tokens.first as usize].span;
                self.cannot(span, format!("`{name}` is not available in version {}", target.written()));
            }
        }
        for (name, tokens, _) in &self.checked.function_uses {
            if name == "ftransform" {
                self.replace_token(tokens.first, "gonio_ftransform");
                self.preamble.insert("in vec4 gonio_Vertex;".into());
                self.preamble.insert("uniform mat4 gonio_ModelViewProjectionMatrix;".into());
                let line = "vec4 gonio_ftransform() { return gonio_ModelViewProjectionMatrix * gonio_Vertex; }";
                // After the declarations, in alphabetical order.
                self.preamble.insert(line.into());
            }
        }
    }
}

/// The length of the arrays `gl_LightSource` and `gl_FrontLightProduct`: the least `gl_MaxLights` that OpenGL allows.
const LIGHTS: u32 = 8;

impl Translator<'_> {
    /// Declares a struct of the fixed-function state, such as `gl_LightSource`, as a uniform with the same members, and
    /// returns its name.
    fn fixed_state(&mut self, name: &str) -> Option<String> {
        let ty = builtins::variable(name, self.stage(), self.parsed.dialect())?.ok()?.ty?;
        let Type::Struct(of) = ty.innermost() else { return None };
        let info = crate::check::builtin_structs().iter().find(|info| info.name == *of)?;
        let (of, new) = (format!("gonio_{}", of.strip_prefix("gl_")?), format!("gonio_{}", name.strip_prefix("gl_")?));
        let members: Vec<String> = (info.members.iter())
            .filter_map(|(member, ty)| Some(format!("{} {member};", ty.as_ref()?.written())))
            .collect();
        let count = if matches!(ty, Type::Array(..)) { format!("[{LIGHTS}]") } else { String::new() };
        // Structs come before uniforms in alphabetical order.
        self.preamble.insert(format!("struct {of} {{ {} }};", members.join(" ")));
        self.preamble.insert(format!("uniform {of} {new}{count};"));
        Some(new)
    }
}
