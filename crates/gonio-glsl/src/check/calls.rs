//! Checks calls of the shader's own functions, built-in functions and constructors (GLSL 4.60, section 5.4), and
//! resolves overloads.

use super::Checker;
use crate::ast::{Call, Expr, ExprKind, UnaryOp};
use crate::builtins::{self, Signature};
use crate::limits::MOST_OVERLOADS;
use crate::{Problem, Scalar, Span, Type};

impl Checker<'_> {
    #[inline(never)]
    pub(super) fn call(&mut self, expr: &mut Expr) -> Option<Type> {
        let span = expr.span;
        let ExprKind::Call(call) = &mut expr.kind else { return None };
        let is_struct = self.structs.contains_key(&call.name);
        if call.is_constructor || is_struct || !call.sizes.is_empty() {
            call.is_constructor = true;
            for arg in &mut call.args {
                self.expression(arg);
            }
            return self.construct(call, span);
        }
        self.function_call(call)
    }

    #[inline(never)]
    fn function_call(&mut self, call: &mut Call) -> Option<Type> {
        let outs = self.before_call(call);
        for (arg, is_out) in call.args.iter_mut().zip(outs) {
            if is_out {
                self.target(arg, true)
            } else {
                self.expression(arg)
            };
        }
        self.resolved_call(call)
    }

    /// Returns which arguments are written to. A separate function, because calls may be deeply nested.
    #[inline(never)]
    fn before_call(&mut self, call: &Call) -> Vec<bool> {
        self.hidden(call);
        let is_known = self.functions.contains_key(&call.name) || builtins::is_name(&call.name);
        if is_known { self.written_args(call) } else { vec![false; call.args.len()] }
    }

    #[inline(never)]
    fn resolved_call(&mut self, call: &Call) -> Option<Type> {
        if !self.functions.contains_key(&call.name) && !builtins::is_name(&call.name) {
            self.unknown_function(call);
            return None;
        }
        let types: Vec<Option<Type>> = call.args.iter().map(|a| a.ty.clone()).collect();
        let own = self.functions.get(&call.name).map_or(&[][..], Vec::as_slice);
        if own.len() > MOST_OVERLOADS {
            return None;
        }
        let own_signatures: Vec<Candidate> = own
            .iter()
            .enumerate()
            .map(|(i, f)| Candidate {
                params: f.params.clone(),
                returns: f.returns.clone(),
                own: Some(i),
                outs: f.outs.clone(),
            })
            .collect();
        let is_there = builtins::exists(&call.name, self.version);
        let candidates = own_signatures.into_iter().chain(self.builtin_candidates(&call.name, is_there)).collect();
        let chosen = self.choose(call, &types, candidates)?;
        match chosen.own {
            Some(index) => self.called_own(call, index),
            None => {
                if !is_there {
                    self.later_function(call);
                }
                self.old_function(call);
                let first = types.first().cloned().flatten();
                self.function_uses.push((call.name.clone(), call.name_tokens, first));
                self.negative_power(call);
            }
        }
        for ((arg, expected), is_out) in call.args.iter().zip(&chosen.params).zip(&chosen.outs) {
            if !is_out {
                self.convert(arg, expected.as_ref(), "this argument");
            }
        }
        chosen.returns
    }

    fn builtin_candidates(&self, name: &str, is_there: bool) -> impl Iterator<Item = Candidate> + use<> {
        // Functions of later versions are accepted and reported: otherwise files without #version would be full of
        // errors.
        builtins::signatures(name, self.version, !is_there).map(Candidate::from)
    }

    /// Returns which arguments the function writes to.
    fn written_args(&self, call: &Call) -> Vec<bool> {
        let count = call.args.len();
        if let Some(list) = self.functions.get(&call.name) {
            let found = list.iter().find(|f| f.params.len() == count);
            return found.map_or_else(|| vec![false; count], |f| f.outs.clone());
        }
        let found = builtins::signatures(&call.name, self.version, true).find(|s| s.params.len() == count);
        found.map_or_else(|| vec![false; count], |s| s.outs.clone())
    }

    /// Reports a variable that hides the function.
    fn hidden(&mut self, call: &Call) {
        let Some(id) = self.find(&call.name) else { return };
        self.hiding.insert(id);
        let line = self.symbols[id].span.line;
        let name = &call.name;
        let is_builtin = builtins::is_name(name);
        let message = format!("the variable `{name}` of line {line} hides the function `{name}`, which is called here");
        let span = call.name_span;
        let problem = if is_builtin {
            Problem::strict(span, "variable-hides-function", message)
        } else {
            Problem::error(span, "variable-hides-function", message)
        };
        self.problems.push(problem.with_help(format!("rename the variable, for example to `my_{name}`")));
    }

    fn unknown_function(&mut self, call: &Call) {
        if self.find(&call.name).is_some() || self.is_full() {
            return;
        }
        let message = format!("the function `{}` is not declared", call.name);
        let mut problem = Problem::error(call.name_span, "unknown-function", message);
        let own = self.functions.keys().map(String::as_str);
        let mut names: Vec<&str> = own.chain(COMMON.split_ascii_whitespace()).collect();
        names.sort_unstable();
        let alias = match &*call.name {
            "lerp" => Some("mix"),
            "saturate" => Some("clamp"),
            "frac" => Some("fract"),
            "atan2" => Some("atan"),
            "tex2D" => Some("texture"),
            "rsqrt" => Some("inversesqrt"),
            "fmod" => Some("mod"),
            _ => None,
        };
        if let Some(near) = alias {
            // Its arguments may be others.
            problem = problem.with_help(format!("did you mean `{near}`?"));
        } else if let Some(near) = crate::nearest::nearest(&call.name, names.into_iter()) {
            problem = problem.did_you_mean(&call.name, near);
        }
        self.unknown(problem);
    }

    /// Selects the overload for these arguments: an exact match, or else the one with the fewest conversions.
    fn choose(&mut self, call: &Call, types: &[Option<Type>], candidates: Vec<Candidate>) -> Option<Candidate> {
        let fitting: Vec<&Candidate> = candidates.iter().filter(|c| c.params.len() == types.len()).collect();
        if fitting.is_empty() {
            self.wrong_count(call, types.len(), &candidates);
            return None;
        }
        let is_unknown = types.iter().any(Option::is_none) || fitting.iter().any(|c| c.params.contains(&None));
        let has_double = types.iter().flatten().any(|t| t.scalar() == Some(Scalar::Double));
        if has_double && fitting[0].own.is_none() && types.iter().all(Option::is_some) {
            let doubled = fitting.iter().map(|c| c.doubled()).filter_map(|c| Some((c.cost(types)?, c)));
            if let Some((_, best)) = doubled.min_by_key(|(cost, _)| *cost) {
                return Some(best);
            }
        }
        let best = fitting.iter().filter_map(|c| Some((c.cost(types)?, *c))).min_by_key(|(cost, _)| *cost);
        if is_unknown || (has_double && fitting[0].own.is_none()) {
            // All candidates may still return the same type.
            let possible: Vec<_> = fitting.iter().filter(|c| c.cost(types).is_some()).collect();
            let first = possible.first()?;
            if has_double || possible.iter().any(|c| c.returns != first.returns || c.own != first.own) {
                self.note_calls(call, &possible);
                return None;
            }
            return Some((**first).clone());
        }
        if best.is_none() {
            self.wrong_types(call, types, &fitting);
        }
        best.map(|(_, c)| c.clone())
    }

    fn note_calls(&mut self, call: &Call, possible: &[&&Candidate]) {
        match possible.first().and_then(|c| c.own) {
            Some(index) => self.called_own(call, index),
            None => self.function_uses.push((call.name.clone(), call.name_tokens, None)),
        }
    }

    fn called_own(&mut self, call: &Call, index: usize) {
        let Some(info) = self.functions.get(&call.name).and_then(|l| l.get(index)) else { return };
        let symbol = &mut self.symbols[info.symbol];
        symbol.uses.push(call.name_tokens);
        symbol.is_read = true;
        self.count_call(&call.name, index);
        if let Some((name, at)) = &self.current
            && let Some(caller) = self.functions.get_mut(name).and_then(|l| l.get_mut(*at))
        {
            caller.calls.push((call.name.clone(), index));
        }
    }

    fn wrong_count(&mut self, call: &Call, found: usize, candidates: &[Candidate]) {
        let mut counts: Vec<usize> = candidates.iter().map(|c| c.params.len()).collect();
        counts.sort_unstable();
        counts.dedup();
        let expected = counts.iter().map(usize::to_string).collect::<Vec<_>>().join(" or ");
        let plural = if expected == "1" { "argument" } else { "arguments" };
        let message = format!("`{}` takes {expected} {plural}, found {found}", call.name);
        self.unknown(Problem::error(call.name_span, "argument-count", message));
    }

    fn wrong_types(&mut self, call: &Call, types: &[Option<Type>], fitting: &[&Candidate]) {
        let words = |types: &[Option<Type>]| {
            types.iter().map(|t| t.as_ref().map_or("?".into(), Type::written)).collect::<Vec<_>>().join(", ")
        };
        let message = format!("no overload of `{}` takes ({})", call.name, words(types));
        let mut problem = Problem::error(call.name_span, "argument-types", message);
        let ways: Vec<String> = fitting.iter().take(4).map(|c| format!("({})", words(&c.params))).collect();
        let more = if fitting.len() > 4 { " and so on" } else { "" };
        problem = problem.with_help(format!("the overloads take {}{more}", ways.join(" or ")));
        self.unknown(problem);
    }

    /// Reports a function of later versions.
    fn later_function(&mut self, call: &Call) {
        let name = &call.name;
        let message = format!("the function `{name}` is not available in version {}", self.version.written());
        let mut problem = Problem::strict(call.name_span, "version-too-old", message);
        if name == "texture" {
            let is_cube =
                matches!(call.args.first().and_then(|a| a.ty.as_ref()), Some(Type::Opaque(s)) if s == "samplerCube");
            let old = if is_cube { "textureCube" } else { "texture2D" };
            problem = problem.with_help(format!("write `{old}`, or `#version 330 core` in the first line"));
        } else if self.version.line == 0 {
            problem = problem.with_help("write `#version 330 core` in the first line");
        }
        if self.version.es {
            problem.severity = crate::Severity::Error;
        }
        self.unknown(problem);
    }

    /// Reports `texture2D` and similar functions, which newer versions do not have.
    fn old_function(&mut self, call: &Call) {
        let Some(new) = modern(&call.name) else { return };
        if self.version.compatibility || !self.version.is_at_least(140, 300) {
            return;
        }
        let (is_es, name) = (self.version.es, &call.name);
        let problem = if is_es {
            let message = format!("`{name}` is not available in version {}", self.version.written());
            Problem::error(call.name_span, "old-function", message)
        } else {
            Problem::strict(call.name_span, "old-function", format!("`{name}` was removed from core OpenGL"))
        };
        self.unknown(problem.with_help(format!("write `{new}`")));
    }

    /// Reports `pow` of a negative number, which is undefined (GLSL 4.60, section 8.2).
    fn negative_power(&mut self, call: &Call) {
        if call.name != "pow" {
            return;
        }
        let Some(base) = call.args.first() else { return };
        let is_negative = self.value_of(base).is_some_and(|v| v.iter().any(|v| *v < 0.0));
        if is_negative
            || matches!(base.kind, ExprKind::Unary { op: UnaryOp::Minus, ref operand } if self.is_length(operand))
        {
            self.strict(base.span, "pow-of-negative", "`pow` of a negative number is undefined");
        }
    }

    fn is_length(&self, expr: &Expr) -> bool {
        matches!(&expr.kind, ExprKind::Call(c) if matches!(&*c.name, "length" | "abs" | "distance"))
    }
}

/// Returns the current name of an old function.
pub(crate) fn modern(name: &str) -> Option<&'static str> {
    Some(match name {
        "texture1D" | "texture2D" | "texture3D" | "textureCube" | "shadow1D" | "shadow2D" => "texture",
        "texture1DProj" | "texture2DProj" | "texture3DProj" | "shadow2DProj" => "textureProj",
        "texture1DLod" | "texture2DLod" | "texture3DLod" | "textureCubeLod" | "texture2DLodEXT"
        | "textureCubeLodEXT" => "textureLod",
        "texture1DProjLod" | "texture2DProjLod" | "texture3DProjLod" => "textureProjLod",
        "texture2DGradEXT" | "texture2DGradARB" | "textureCubeGradEXT" | "textureCubeGradARB" => "textureGrad",
        _ => return None,
    })
}

#[derive(Debug, Clone)]
struct Candidate {
    params: Vec<Option<Type>>,
    returns: Option<Type>,
    own: Option<usize>,
    outs: Vec<bool>,
}

impl From<&Signature> for Candidate {
    fn from(found: &Signature) -> Self {
        let params = found.params.iter().cloned().map(Some).collect();
        Self { params, returns: Some(found.returns.clone()), own: None, outs: found.outs.clone() }
    }
}

impl Candidate {
    /// A function of floats as one of doubles, which the table does not list: it would be twice as long.
    fn doubled(&self) -> Self {
        let double = |ty: &Option<Type>| match ty {
            Some(ty) if ty.scalar() == Some(Scalar::Float) => Some(ty.with_scalar(Scalar::Double)),
            other => other.clone(),
        };
        Self { params: self.params.iter().map(double).collect(), returns: double(&self.returns), ..self.clone() }
    }

    /// Returns the number of conversions that a call needs, those to `float` counting least; `None` if it is
    /// impossible.
    fn cost(&self, types: &[Option<Type>]) -> Option<u32> {
        let mut cost = 0;
        for (param, ty) in self.params.iter().zip(types) {
            let (Some(param), Some(ty)) = (param, ty) else { continue };
            if ty == param {
                continue;
            }
            if !ty.becomes(param) {
                return None;
            }
            cost += match param.scalar() {
                Some(Scalar::Float) => 1,
                Some(Scalar::Double) => 3,
                _ => 2,
            };
        }
        Some(cost)
    }
}

/// Functions suggested for a misspelt name.
const COMMON: &str = "radians degrees sin cos tan asin acos atan pow exp log exp2 log2 sqrt inversesqrt abs sign floor ceil \
fract mod min max clamp mix step smoothstep length distance dot cross normalize faceforward reflect refract transpose \
inverse texture texture2D textureCube textureLod texelFetch dFdx dFdy fwidth lessThan greaterThan equal any all not vec2 \
vec3 vec4 mat2 mat3 mat4 float int main";

impl Checker<'_> {
    #[inline(never)]
    /// Returns the constructed type; the arguments have been checked.
    pub(super) fn construct(&mut self, call: &mut Call, span: Span) -> Option<Type> {
        let is_struct = self.structs.contains_key(&call.name);
        let of = if is_struct { Type::Struct(call.name.clone()) } else { Type::named(&call.name)? };
        if !call.sizes.is_empty() {
            return self.construct_array(of, call, span);
        }
        match of {
            Type::Struct(_) => self.construct_struct(call, span),
            Type::Void | Type::Opaque(_) | Type::Array(..) => {
                self.error(span, "constructor", format!("cannot construct a value of type `{of}`"));
                return None;
            }
            Type::Scalar(_) | Type::Vector(..) | Type::Matrix { .. } => self.construct_number(&of, call, span),
        }
        Some(of)
    }

    fn construct_array(&mut self, of: Type, call: &mut Call, span: Span) -> Option<Type> {
        let mut ty = self.sized(of, &mut call.sizes)?;
        let Type::Array(of, count) = &mut ty else { return None };
        let found = call.args.len() as u32;
        let expected = *count.get_or_insert(found);
        if expected != found {
            self.error(span, "constructor", format!("this array has {expected} elements, found {found}"));
        }
        let of = (**of).clone();
        for arg in &call.args {
            self.convert(arg, Some(&of), "this element");
        }
        self.check_type(&ty, span);
        Some(ty)
    }

    fn construct_struct(&mut self, call: &Call, span: Span) {
        let Some(info) = self.structs.get(&call.name).cloned() else { return };
        if info.members.len() != call.args.len() {
            let (expected, found) = (info.members.len(), call.args.len());
            self.error(span, "constructor", format!("`{}` has {expected} members, found {found}", call.name));
            return;
        }
        for (arg, (_, ty)) in call.args.iter().zip(&info.members) {
            self.convert(arg, ty.as_ref(), "this member");
        }
    }

    fn construct_number(&mut self, of: &Type, call: &Call, span: Span) {
        let Some(expected) = of.components() else { return };
        if call.args.is_empty() {
            self.error(span, "constructor", format!("`{of}()` needs an argument"));
            return;
        }
        let mut found = 0;
        for (index, arg) in call.args.iter().enumerate() {
            let Some(ty) = &arg.ty else { return };
            let Some(count) = ty.components() else {
                self.error(arg.span, "constructor", format!("cannot construct `{of}` from `{ty}`"));
                return;
            };
            let is_matrix = matches!(ty, Type::Matrix { .. });
            if is_matrix && matches!(of, Type::Matrix { .. }) {
                if call.args.len() > 1 {
                    self.error(arg.span, "constructor", "a matrix constructed from a matrix takes no other arguments");
                }
                return;
            }
            if found >= expected {
                let message = format!(
                    "too many arguments: `{of}` has {expected} components, which are filled before argument {}",
                    index + 1
                );
                self.error(arg.span, "constructor", message);
                return;
            }
            found += count;
        }
        if found == 1 && call.args.len() == 1 {
            return;
        }
        if found < expected {
            let message = format!("`{of}` needs {expected} components, found {found}");
            let mut problem = Problem::error(span, "constructor", message);
            if found == 3 && expected == 4 {
                problem = problem.with_help("add a fourth component, such as `1.0`");
            }
            self.problems.push(problem);
        } else if found > expected && matches!(of, Type::Matrix { .. }) {
            let message = format!("`{of}` needs {expected} components, found {found}");
            self.error(span, "constructor", message);
        }
    }
}
