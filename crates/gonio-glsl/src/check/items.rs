//! Checks declarations: functions, variables, structs, blocks.

use super::interface::StructInfo;
use super::scope::storage_of;
use super::{Checker, FunctionInfo, Storage, Symbol, SymbolKind};
use crate::ast::{
    Declaration, Declarator, Expr, ExprKind, Function, InterfaceBlock, Item, Param, Qualifier, StructDefinition,
    TypeName, Unit, has,
};
use crate::{Problem, Span, Type, lex};
use std::collections::HashSet;

impl Checker<'_> {
    pub(super) fn unit(&mut self, unit: &mut Unit) {
        for item in &mut unit.items {
            match item {
                Item::Function(function) => self.function(function),
                Item::Declaration(declaration) => self.declaration(declaration, SymbolKind::Global),
                Item::Block(block) => self.block(block),
                Item::Precision(_) | Item::Empty(_) => {}
                Item::Qualify(qualify) => self.layout_values(&mut qualify.qualifiers),
            }
        }
        self.report_unset();
    }

    fn layout_values(&mut self, qualifiers: &mut [Qualifier]) {
        for entry in qualifiers.iter_mut().flat_map(|q| &mut q.layout) {
            if let Some(value) = &mut entry.value {
                self.expression(value);
            }
        }
    }

    /// Resolves a type; reports an unknown one and returns `None`.
    pub(super) fn resolve(&mut self, ty: &mut TypeName) -> Option<Type> {
        let defined = ty.definition.as_mut().and_then(|definition| self.structure(definition));
        let of = if let Some(name) = defined {
            Some(Type::Struct(name))
        } else if self.structs.contains_key(&ty.name) {
            Some(Type::Struct(ty.name.clone()))
        } else if let Some(found) = Type::named(&ty.name) {
            if !lex::is_type(&ty.name, self.version) {
                let message = format!("the type `{}` is not available in version {}", ty.name, self.version.written());
                self.unknown(Problem::error(ty.span, "unknown-type", message));
            }
            Some(found)
        } else {
            if ty.definition.is_none() {
                self.unknown_type(ty);
            }
            None
        };
        self.sized(of?, &mut ty.sizes)
    }

    fn unknown_type(&mut self, ty: &TypeName) {
        let mut problem = Problem::error(ty.span, "unknown-type", format!("unknown type `{}`", ty.name));
        let own = ["float", "int", "vec2", "vec3", "vec4", "mat3", "mat4", "bool", "sampler2D", "samplerCube", "void"];
        let more = ["uniform", "varying", "attribute", "const", "return", "precision", "layout", "else"];
        let structs = self.struct_order.iter().map(String::as_str);
        let alias = match &*ty.name {
            "float2" | "Vec2" => Some("vec2"),
            "float3" | "Vec3" => Some("vec3"),
            "float4" | "Vec4" => Some("vec4"),
            "float4x4" => Some("mat4"),
            _ => None,
        };
        let near = alias.or_else(|| crate::nearest::nearest(&ty.name, structs.chain(own).chain(more)));
        if let Some(near) = near {
            problem = problem.did_you_mean(&ty.name, near);
        }
        self.unknown(problem);
    }

    /// Returns a type with array sizes: the first size is the outermost.
    pub(super) fn sized(&mut self, of: Type, sizes: &mut [Option<Expr>]) -> Option<Type> {
        let mut ty = of;
        for size in sizes.iter_mut().rev() {
            let count = match size {
                None => None,
                Some(size) => {
                    let found = self.expression(size);
                    let value = self.value_of(size).and_then(|v| v.first().copied());
                    if found.is_some_and(|t| t != Type::INT && t != Type::UINT) {
                        self.error(size.span, "array-size", "the size of an array must be an `int`");
                    } else if value.is_some_and(|v| v < 1.0) {
                        self.error(size.span, "array-size", "the size of an array must be at least 1");
                    }
                    self.check_size(size, value);
                    value.filter(|v| (1.0..1e9).contains(v)).map(|v| v as u32)
                }
            };
            ty = Type::Array(Box::new(ty), count);
            self.check_type(&ty, size.as_ref().map_or(Span::default(), |size| size.span));
        }
        Some(ty)
    }

    /// Returns the components of a constant expression whose types are known.
    pub(super) fn value_of(&self, expr: &Expr) -> Option<Vec<f64>> {
        crate::constant::evaluate(expr, &|name| {
            let id = self.find(name)?;
            (self.symbols[id].storage == Storage::Const).then(|| self.values.get(&id).cloned())?
        })
    }

    /// Declares a struct and returns its name. One without a name is named by its members, so that it is the same type in both
    /// stages.
    fn structure(&mut self, definition: &mut StructDefinition) -> Option<String> {
        let mut members: Vec<(String, Option<Type>)> = Vec::new();
        let mut names = HashSet::new();
        for member in &mut definition.members {
            let of = self.resolve(&mut member.ty);
            for declarator in &mut member.declarators {
                let ty = of.clone().and_then(|t| self.sized(t, &mut declarator.sizes));
                if !names.insert(declarator.name.clone()) {
                    let message = format!("the struct already has a member `{}`", declarator.name);
                    self.error(declarator.span, "declared-twice", message);
                }
                members.push((declarator.name.clone(), ty));
            }
        }
        self.check_struct(&definition.name, &members, definition.span);
        if definition.name.is_empty() {
            let of = |ty: &Option<Type>| ty.as_ref().map(Type::to_string);
            let texts = members.iter().map(|(name, ty)| Some(format!("{} {name};", of(ty)?)));
            let name = format!("struct {{ {} }}", texts.collect::<Option<Vec<_>>>()?.join(" "));
            let info = StructInfo { name: name.clone(), members, span: definition.span };
            if self.structs.insert(name.clone(), info).is_none() {
                self.struct_order.push(name.clone());
            }
            return Some(name);
        }
        if self.structs.contains_key(&definition.name) && self.scopes.len() == 1 {
            let message = format!("the struct `{}` is already defined", definition.name);
            self.error(definition.span, "declared-twice", message);
        }
        let info = StructInfo { name: definition.name.clone(), members, span: definition.span };
        if self.structs.insert(definition.name.clone(), info).is_none() {
            self.struct_order.push(definition.name.clone());
        }
        Some(definition.name.clone())
    }

    pub(super) fn declaration(&mut self, declaration: &mut Declaration, kind: SymbolKind) {
        self.layout_values(&mut declaration.qualifiers);
        self.storage_words(&declaration.qualifiers, kind);
        let of = self.resolve(&mut declaration.ty);
        let storage = storage_of(&declaration.qualifiers, self.stage);
        for declarator in &mut declaration.declarators {
            let mut ty = of.clone().and_then(|t| self.sized(t, &mut declarator.sizes));
            if ty == Some(Type::Void) {
                self.error(
                    declarator.span,
                    "void-variable",
                    format!("`{}` cannot have the type `void`", declarator.name),
                );
            }
            if let (Some(Type::Opaque(name)), true) = (&ty, storage != Storage::Uniform) {
                let message = format!("a `{name}` must be a `uniform`");
                self.error(declarator.span, "sampler-not-uniform", message);
            }
            let mut value = None;
            let mut is_computed = false;
            if let Some(initialiser) = &mut declarator.initialiser {
                self.initialise(initialiser, &mut ty, storage);
                value = self.value_of(initialiser);
                is_computed = !self.is_constant(initialiser);
                if is_computed && storage == Storage::Const && !self.is_const_free(kind) {
                    let message =
                        format!("the initializer of the constant `{}` is not a constant expression", declarator.name);
                    self.strict(initialiser.span, "const-not-constant", message);
                }
            } else if storage == Storage::Const {
                self.error(
                    declarator.span,
                    "const-without-value",
                    format!("the constant `{}` has no value", declarator.name),
                );
            }
            let id = self.declare(symbol(declarator, kind, ty, storage, self.loops.len()));
            if is_computed && (kind == SymbolKind::Global || storage == Storage::Const) {
                self.computed.insert(id);
            }
            if let Some(value) = value {
                self.values.insert(id, value);
            }
        }
    }

    /// From 4.20 on the initializer of a local constant need not be a constant expression.
    fn is_const_free(&self, kind: SymbolKind) -> bool {
        self.has_syntax_errors || (kind == SymbolKind::Local && self.version.is_at_least(420, 0))
    }

    fn storage_words(&mut self, qualifiers: &[Qualifier], kind: SymbolKind) {
        let version = self.version;
        for qualifier in qualifiers {
            let word = &*qualifier.word;
            let span = qualifier.span;
            let is_inside = kind == SymbolKind::Local;
            match word {
                "attribute" | "varying" if version.is_at_least(0, 300) => {
                    let now = if word == "attribute" || self.stage == crate::Stage::Fragment { "in" } else { "out" };
                    let message = format!("`{word}` is not available in version {}", version.written());
                    self.problems.push(Problem::error(span, "old-word", message).with_help(format!("write `{now}`")));
                }
                "attribute" | "varying" if version.is_at_least(140, 0) && !version.compatibility => {
                    let now = if word == "attribute" || self.stage == crate::Stage::Fragment { "in" } else { "out" };
                    let message = format!("`{word}` was removed from core OpenGL");
                    self.problems.push(Problem::strict(span, "old-word", message).with_help(format!("write `{now}`")));
                }
                "in" | "out" if !is_inside && !version.is_at_least(130, 300) => {
                    let message =
                        format!("`{word}` outside of functions is not available in version {}", version.written());
                    let help = "write `#version 330 core` in the first line";
                    self.problems.push(Problem::strict(span, "version-too-old", message).with_help(help));
                }
                "layout" if !version.is_at_least(140, 300) => {
                    let message = format!("`layout` is not available in version {}", version.written());
                    let help = "write `#version 330 core` in the first line";
                    self.problems.push(Problem::strict(span, "version-too-old", message).with_help(help));
                }
                "uniform" | "attribute" | "varying" | "in" | "out" | "inout" | "buffer" if is_inside => {
                    let message = format!("`{word}` is only allowed outside of functions");
                    self.error(span, "qualifier-place", message);
                }
                "attribute" if self.stage == crate::Stage::Fragment => {
                    self.error(span, "qualifier-place", "a fragment shader has no attributes; write `varying` or `in`");
                }
                _ => {}
            }
        }
    }

    /// Checks an initializer against the variable's type, and completes an open array size.
    fn initialise(&mut self, initialiser: &mut Expr, ty: &mut Option<Type>, storage: Storage) {
        if matches!(initialiser.kind, ExprKind::List(_)) {
            if let Some(ty) = ty {
                self.list(initialiser, ty);
            }
            return;
        }
        let found = self.expression(initialiser);
        if let (Some(Type::Array(of, None)), Some(Type::Array(_, Some(count)))) = (&*ty, &found) {
            *ty = Some(Type::Array(of.clone(), Some(*count)));
        }
        match storage {
            Storage::In => self.error(initialiser.span, "input-initialised", "an input cannot have an initializer"),
            _ => self.convert(initialiser, ty.as_ref(), "this value"),
        }
    }

    /// Checks `{1.0, 2.0}` for an array, a vector, a matrix or a struct.
    pub(super) fn list(&mut self, expr: &mut Expr, ty: &mut Type) {
        let tokens = expr.tokens;
        let ExprKind::List(list) = &mut expr.kind else { return };
        let count = list.len() as u32;
        if let Type::Array(of, size @ None) = ty {
            *size = Some(count);
            let _ = of;
        }
        let members: Vec<Option<Type>> = match &*ty {
            Type::Array(of, _) => vec![Some((**of).clone()); list.len()],
            Type::Vector(scalar, n) => vec![Some(Type::Scalar(*scalar)); usize::from(*n)],
            Type::Matrix { scalar, columns, rows } => {
                vec![Some(Type::scalar_or_vector(*scalar, *rows)); usize::from(*columns)]
            }
            Type::Struct(name) => {
                self.structs.get(name).map(|s| s.members.iter().map(|m| m.1.clone()).collect()).unwrap_or_default()
            }
            _ => vec![Some(ty.clone())],
        };
        for (value, expected) in list.iter_mut().zip(members) {
            match expected {
                Some(mut expected) if matches!(value.kind, ExprKind::List(_)) => self.list(value, &mut expected),
                expected => {
                    self.expression(value);
                    self.convert(value, expected.as_ref(), "this value");
                }
            }
        }
        expr.ty = Some(ty.clone());
        self.lists.push((tokens, ty.clone()));
    }

    fn block(&mut self, block: &mut InterfaceBlock) {
        self.layout_values(&mut block.qualifiers);
        let storage = storage_of(&block.qualifiers, self.stage);
        let mut members = Vec::new();
        for member in &mut block.members {
            let of = self.resolve(&mut member.ty);
            for declarator in &mut member.declarators {
                let ty = of.clone().and_then(|t| self.sized(t, &mut declarator.sizes));
                if block.instance.is_none() {
                    let found = symbol(declarator, SymbolKind::BlockMember, ty.clone(), storage, 0);
                    self.declare(found);
                }
                members.push((declarator.name.clone(), ty));
            }
        }
        self.check_struct(&format!("{} (block)", block.name), &members, block.name_span);
        let Some(instance) = &mut block.instance else { return };
        // The instance behaves like a struct, with a name that no declaration can have.
        let name = format!("{} (block)", block.name);
        let info = StructInfo { name: name.clone(), members, span: block.name_span };
        self.structs.insert(name.clone(), info);
        let ty = self.sized(Type::Struct(name), &mut instance.sizes);
        let found = symbol(instance, SymbolKind::BlockInstance, ty, storage, 0);
        self.declare(found);
    }

    fn function(&mut self, function: &mut Function) {
        let returns = self.resolve(&mut function.returns);
        let params: Vec<_> = function.params.iter_mut().map(|p| self.param_type(p)).collect();
        let outs: Vec<_> =
            function.params.iter().map(|p| has(&p.qualifiers, "out") || has(&p.qualifiers, "inout")).collect();
        let known = self.functions.get(&function.name);
        let same = known.and_then(|list| list.iter().position(|f| f.params == params));
        let name = function.name.clone();
        let index = match same {
            Some(index) => self.second(function, &name, index, returns.as_ref()),
            None => self.first(function, &name, params.clone(), outs, returns.clone()),
        };
        let Some(body) = &mut function.body else { return };
        self.current = Some((name.clone(), index));
        self.cost = super::size::Cost::default();
        self.push_scope();
        for (param, ty) in function.params.iter().zip(params) {
            let storage = if has(&param.qualifiers, "const") { Storage::Const } else { Storage::None };
            self.declare(Symbol {
                name: param.name.clone(),
                kind: SymbolKind::Param,
                ty,
                storage,
                span: param.span,
                declared: param.tokens,
                uses: Vec::new(),
                is_read: false,
                is_written: false,
                has_initialiser: true,
                loops: 0,
            });
        }
        // A function's parameters and its body are one scope.
        for statement in body.iter_mut() {
            self.statement(statement, returns.as_ref());
        }
        self.pop_scope();
        self.current = None;
        let cost = std::mem::take(&mut self.cost);
        if let Some(info) = self.functions.get_mut(&name).and_then(|list| list.get_mut(index)) {
            info.cost = cost;
        }
        if returns.is_some_and(|t| t != Type::Void)
            && !super::statements::always_leaves(body)
            && !self.has_syntax_errors
        {
            let message = format!("`{}` can reach its end without a `return`", function.name);
            self.strict(function.name_span, "missing-return", message);
        }
    }

    fn param_type(&mut self, param: &mut Param) -> Option<Type> {
        let of = self.resolve(&mut param.ty)?;
        self.sized(of, &mut param.sizes)
    }

    /// Checks a second declaration or definition of a function.
    fn second(&mut self, function: &Function, name: &str, index: usize, returns: Option<&Type>) -> usize {
        let Some(known) = self.functions.get_mut(name).and_then(|l| l.get_mut(index)) else { return index };
        let (line, was) = (known.span.line, known.returns.clone());
        let is_twice = known.has_body && function.body.is_some();
        known.has_body |= function.body.is_some();
        self.symbols[known.symbol].uses.push(function.name_tokens);
        if is_twice {
            self.error(function.name_span, "declared-twice", format!("`{name}` is already defined in line {line}"));
        } else if was.as_ref() != returns {
            self.error(
                function.name_span,
                "declared-twice",
                format!("`{name}` is declared with another return type in line {line}"),
            );
        }
        index
    }

    fn first(
        &mut self,
        function: &Function,
        name: &str,
        params: Vec<Option<Type>>,
        outs: Vec<bool>,
        returns: Option<Type>,
    ) -> usize {
        // Several functions may share a name, also with a built-in function.
        let symbol = self.symbols.len();
        let kind = SymbolKind::Function;
        self.symbols.push(Symbol {
            name: name.to_string(),
            kind,
            ty: returns.clone(),
            storage: Storage::None,
            span: function.name_span,
            declared: function.name_tokens,
            uses: Vec::new(),
            is_read: false,
            is_written: false,
            has_initialiser: true,
            loops: 0,
        });
        self.function_name(function.name_span, name);
        let list = self.functions.entry(name.to_string()).or_default();
        list.push(FunctionInfo {
            symbol,
            params,
            outs,
            returns,
            has_body: function.body.is_some(),
            span: function.name_span,
            calls: Vec::new(),
            cost: Default::default(),
        });
        list.len() - 1
    }

    fn function_name(&mut self, span: Span, name: &str) {
        if name.starts_with("gl_") || name.contains("__") {
            self.strict(
                span,
                "reserved-name",
                format!("names with `gl_` or two underscores, such as `{name}`, are reserved"),
            );
        }
        if self.version.is_at_least(0, 300) && crate::builtins::exists(name, self.version) {
            let message = format!("`{name}` is a built-in function and cannot be redefined in GLSL ES");
            self.error(span, "built-in-again", message);
        }
        if let Some(id) = self.scopes[0].get(name) {
            let line = self.symbols[*id].span.line;
            self.error(span, "declared-twice", format!("`{name}` is already declared as a variable in line {line}"));
        }
    }
}

fn symbol(declarator: &Declarator, kind: SymbolKind, ty: Option<Type>, storage: Storage, loops: usize) -> Symbol {
    Symbol {
        name: declarator.name.clone(),
        kind,
        ty,
        storage,
        span: declarator.span,
        declared: declarator.tokens,
        uses: Vec::new(),
        is_read: false,
        is_written: false,
        has_initialiser: declarator.initialiser.is_some(),
        loops,
    }
}
