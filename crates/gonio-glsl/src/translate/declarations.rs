//! Translates global declarations: qualifiers, layouts, blocks.

use std::collections::HashMap;

use super::{Translator, UniformDefault};
use crate::ast::{Declaration, InterfaceBlock, Item, Qualifier, Statement, StatementKind, has};
use crate::check::Storage;
use crate::walk::{Visitor, walk_statement};
use crate::{Scalar, Stage, TokenRange, Type};

/// Most blocks between the stages.
const MOST_BLOCKS: usize = 64;

/// The role of a variable, which determines its qualifiers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// A vertex shader's input or a fragment shader's output.
    Edge,
    /// A variable between the stages.
    Between,
    Uniform,
    Other,
}

impl Translator<'_> {
    pub(super) fn declarations(&mut self) {
        let ids: HashMap<u32, usize> =
            self.checked.symbols.iter().enumerate().map(|(id, s)| (s.declared.first, id)).collect();
        let mut colours = 0;
        for item in &self.parsed.unit.items {
            match item {
                Item::Empty(span) => self.edits.blank(&self.parsed.source, span.start, span.end),
                Item::Declaration(declaration) => {
                    self.global(declaration, &ids);
                    self.colour(declaration, &mut colours);
                }
                Item::Block(block) => self.block(block),
                Item::Function(function) => {
                    for param in &function.params {
                        self.qualifiers(&param.qualifiers, Place::Other, None);
                    }
                    for statement in function.body.iter().flatten() {
                        self.locals(statement, &ids);
                    }
                }
                Item::Qualify(qualify) => {
                    let is_invariant = has(&qualify.qualifiers, "invariant");
                    if !is_invariant || self.stage() == Stage::Fragment {
                        let span = qualify.span;
                        self.edits.blank(&self.parsed.source, span.start, span.end);
                    }
                }
                Item::Precision(_) => {}
            }
        }
    }

    fn place(&self, qualifiers: &[Qualifier]) -> Place {
        let is_vertex = self.stage() == Stage::Vertex;
        if has(qualifiers, "uniform") {
            Place::Uniform
        } else if has(qualifiers, "attribute") || has(qualifiers, "in") {
            if is_vertex { Place::Edge } else { Place::Between }
        } else if has(qualifiers, "out") {
            if is_vertex { Place::Between } else { Place::Edge }
        } else if has(qualifiers, "varying") {
            Place::Between
        } else {
            Place::Other
        }
    }

    fn global(&mut self, declaration: &Declaration, ids: &HashMap<u32, usize>) {
        let place = self.place(&declaration.qualifiers);
        let names_gl = declaration.declarators.iter().any(|d| d.name.starts_with("gl_") && d.name != "gl_FragColor");
        if names_gl && self.is_es() {
            // ES does not allow built-in variables to be redeclared.
            let span = declaration.span;
            self.edits.blank(&self.parsed.source, span.start, span.end);
            return;
        }
        let first = declaration.declarators.first();
        let ty = first.and_then(|d| ids.get(&d.tokens.first)).and_then(|id| self.checked.symbols[*id].ty.clone());
        self.qualifiers(&declaration.qualifiers, place, ty.as_ref());
        let binding = declaration.qualifiers.iter().flat_map(|q| &q.layout).find(|e| e.name == "binding");
        let binding = binding.and_then(|e| e.value.as_ref()).and_then(|v| crate::constant::evaluate(v, &|_| None));
        let mut is_computed_constant = false;
        for declarator in &declaration.declarators {
            let Some(id) = ids.get(&declarator.tokens.first).copied() else { continue };
            let symbol = &self.checked.symbols[id];
            if symbol.storage == Storage::Uniform {
                let value = self.checked.values.get(&id).cloned();
                if declarator.initialiser.is_some() || binding.is_some() {
                    let name = self.name_of(symbol.declared.first);
                    let value = value.or_else(|| binding.clone());
                    self.defaults.push(UniformDefault { name, ty: symbol.ty.clone(), value });
                }
            }
            let Some(initialiser) = &declarator.initialiser else { continue };
            let whole = TokenRange { first: declarator.equals.first, last: initialiser.tokens.last };
            let is_computed = self.checked.computed.contains(&id);
            is_computed_constant |= is_computed && symbol.storage == Storage::Const;
            if symbol.storage == Storage::Uniform && self.is_es() {
                if let Some((start, end)) = self.stretch(whole) {
                    self.edits.blank(&self.parsed.source, start, end);
                }
            } else if is_computed && (self.is_es() || symbol.storage == Storage::Const) {
                self.move_to_main(symbol.declared.first, declarator.equals.first, initialiser.tokens);
            }
        }
        if is_computed_constant {
            self.drop_word(&declaration.qualifiers, "const");
        }
    }

    fn name_of(&self, token: u32) -> String {
        let place = self.parsed.tokens[token as usize];
        self.edits.apply(&self.parsed.source, place.start, place.end)
    }

    fn drop_word(&mut self, qualifiers: &[Qualifier], word: &str) {
        for qualifier in qualifiers.iter().filter(|q| q.word == word) {
            self.replace_token(qualifier.tokens.first, "");
        }
    }

    /// Numbers the outputs if there are several colours, as ES requires.
    fn colour(&mut self, declaration: &Declaration, count: &mut usize) {
        if !self.is_es() || self.stage() == Stage::Vertex || self.place(&declaration.qualifiers) != Place::Edge {
            return;
        }
        let has_location = declaration.qualifiers.iter().flat_map(|q| &q.layout).any(|e| e.name == "location");
        let all = self.checked.interface.outputs.len();
        if all > 1
            && !has_location
            && let Some((start, _)) = self.stretch(declaration.tokens)
        {
            self.edits.insert(start, &format!("layout(location = {count}) "));
        }
        *count += declaration.declarators.len();
    }

    /// Handles local constants with an initializer that is not constant, which only 4.20 has.
    fn locals(&mut self, statement: &Statement, ids: &HashMap<u32, usize>) {
        struct Found<'a> {
            words: Vec<u32>,
            ids: &'a HashMap<u32, usize>,
            checked: &'a crate::Checked,
        }
        impl Visitor for Found<'_> {
            fn statement(&mut self, statement: &Statement) -> bool {
                let StatementKind::Declaration(declaration) = &statement.kind else { return true };
                let mut ids = declaration.declarators.iter().filter_map(|d| self.ids.get(&d.tokens.first));
                if ids.any(|id| self.checked.computed.contains(id)) {
                    let words = declaration.qualifiers.iter().filter(|q| q.word == "const");
                    self.words.extend(words.map(|q| q.tokens.first));
                }
                true
            }
        }
        let mut found = Found { words: Vec::new(), ids, checked: self.checked };
        walk_statement(statement, &mut found);
        let words = found.words;
        for word in words {
            self.replace_token(word, "");
        }
    }

    /// Translates the qualifiers before a type, in the order of the output version.
    fn qualifiers(&mut self, qualifiers: &[Qualifier], place: Place, ty: Option<&Type>) {
        let mut kept: Vec<(u8, String)> = Vec::new();
        for qualifier in qualifiers {
            if let Some(found) = self.qualifier(qualifier, place) {
                kept.push(found);
            }
        }
        let is_integer = ty.is_some_and(|t| matches!(t.innermost().scalar(), Some(Scalar::Int | Scalar::UInt)));
        if place == Place::Between && is_integer && !kept.iter().any(|k| k.1 == "flat") {
            kept.push((1, "flat".into()));
        }
        kept.sort_by_key(|k| k.0);
        let expected: Vec<String> = kept.into_iter().map(|k| k.1).collect();
        let now: Vec<String> = qualifiers
            .iter()
            .map(|q| {
                let Some((start, end)) = self.stretch(q.tokens) else { return String::new() };
                self.edits.apply(&self.parsed.source, start, end)
            })
            .collect();
        if expected == now {
            return;
        }
        for (index, qualifier) in qualifiers.iter().enumerate() {
            let Some((start, end)) = self.stretch(qualifier.tokens) else {
                self.cannot(qualifier.span, "this declaration comes from a macro");
                return;
            };
            let text = if index == 0 { expected.join(" ") } else { String::new() };
            let lines = self.parsed.source.get(start as usize..end as usize).unwrap_or("").matches('\n').count();
            self.edits.replace(start, end, text + &"\n".repeat(lines));
        }
    }

    /// Returns a qualifier with its rank in the order, or `None` to remove it (GLSL 3.30, section 4.7).
    fn qualifier(&mut self, qualifier: &Qualifier, place: Place) -> Option<(u8, String)> {
        let word = &*qualifier.word;
        let is_vertex = self.stage() == Stage::Vertex;
        let found = match word {
            "attribute" => (4, "in"),
            "varying" => (4, if is_vertex { "out" } else { "in" }),
            "mediump" | "lowp" | "highp" => (6, "highp"),
            "invariant" if place == Place::Between && is_vertex => (0, "invariant"),
            "flat" | "smooth" if place == Place::Between => (1, word),
            "noperspective" if place == Place::Between && !self.is_es() => (1, word),
            "centroid" if place == Place::Between => (3, word),
            "layout" => return self.layout(qualifier, place).map(|text| (2, text)),
            "const" => (3, word),
            "in" | "out" | "inout" | "uniform" => (4, word),
            _ => return None,
        };
        Some((found.0, found.1.to_string()))
    }

    fn layout(&mut self, qualifier: &Qualifier, place: Place) -> Option<String> {
        let mut kept = Vec::new();
        for entry in &qualifier.layout {
            let is_kept = match &*entry.name {
                "location" => place == Place::Edge,
                "std140" | "row_major" | "column_major" => place == Place::Uniform,
                "std430" => {
                    kept.push("std140".to_string());
                    false
                }
                "index" => place == Place::Edge && !self.is_es(),
                _ => false,
            };
            if is_kept && let Some((start, end)) = self.stretch(entry.tokens) {
                kept.push(self.edits.apply(&self.parsed.source, start, end));
            }
        }
        (!kept.is_empty()).then(|| format!("layout({})", kept.join(", ")))
    }

    fn block(&mut self, block: &InterfaceBlock) {
        if block.name.starts_with("gl_") {
            self.edits.blank(&self.parsed.source, block.span.start, block.span.end);
            return;
        }
        let place = self.place(&block.qualifiers);
        if has(&block.qualifiers, "buffer") {
            self.cannot(block.span, "storage buffers need version 430");
            return;
        }
        // The caller has no buffers to bind.
        if place == Place::Uniform || self.is_es() {
            self.take_apart(block, place);
            return;
        }
        self.qualifiers(&block.qualifiers, place, None);
        for member in &block.members {
            self.drop_layout(&member.qualifiers);
        }
    }

    fn drop_layout(&mut self, qualifiers: &[Qualifier]) {
        for qualifier in qualifiers.iter().filter(|q| q.word == "layout") {
            if let Some((start, end)) = self.stretch(qualifier.tokens) {
                self.edits.blank(&self.parsed.source, start, end);
            }
        }
    }

    /// Converts each member to a variable, `Block_member` if the block has an instance name: ES 3.00 has no blocks
    /// between the stages, and uniforms are set one by one.
    fn take_apart(&mut self, block: &InterfaceBlock, place: Place) {
        let word = match (place, self.stage()) {
            (Place::Uniform, _) => "uniform",
            (_, Stage::Vertex) => "out",
            (_, Stage::Fragment) => "in",
        };
        let (Some((start, _)), Some((_, end))) = (self.stretch(block.tokens), self.stretch(block.tokens)) else {
            self.cannot(block.span, "this block comes from a macro");
            return;
        };
        let first = block.members.first().and_then(|m| self.stretch(m.tokens));
        let Some((first, _)) = first else { return };
        self.edits.blank(&self.parsed.source, start, first);
        if let Some((close, _)) = self.stretch(block.close) {
            self.edits.blank(&self.parsed.source, close, end);
        }
        for member in &block.members {
            let mut qualifiers = member.qualifiers.clone();
            let Some((at, _)) = self.stretch(member.ty.tokens) else { continue };
            let is_integer =
                Type::named(&member.ty.name).is_some_and(|t| matches!(t.scalar(), Some(Scalar::Int | Scalar::UInt)));
            let has_flat = has(&qualifiers, "flat") || has(&block.qualifiers, "flat");
            qualifiers.retain(|q| q.word != "in" && q.word != "out");
            if place == Place::Uniform {
                self.drop_layout(&member.qualifiers);
            } else {
                self.qualifiers(&member.qualifiers, place, None);
            }
            let is_integer = is_integer && place != Place::Uniform;
            let flat =
                if has_flat && !has(&member.qualifiers, "flat") || is_integer && !has_flat { "flat " } else { "" };
            let is_written = ["in", "out", "uniform"].iter().any(|word| has(&member.qualifiers, word));
            let word = if is_written { "" } else { word };
            self.edits.insert(at, &format!("{flat}{word} "));
            if block.instance.is_some() {
                for declarator in &member.declarators {
                    let name = format!("{}_{}", block.name, declarator.name);
                    self.replace_token(declarator.tokens.first, &name);
                }
            }
        }
        // Each block searches the whole shader.
        self.blocks += 1;
        match &block.instance {
            Some(instance) if self.blocks <= MOST_BLOCKS => self.rename_members(block, &instance.name),
            Some(_) => self.cannot(block.name_span, "this shader has too many blocks"),
            None => {}
        }
    }

    /// Renames `vs_out.normal` to `VS_OUT_normal`.
    fn rename_members(&mut self, block: &InterfaceBlock, instance: &str) {
        struct Members<'a>(Vec<(TokenRange, String)>, &'a str, String);
        impl Visitor for Members<'_> {
            fn expression(&mut self, expr: &crate::Expr) -> bool {
                if let crate::ExprKind::Field { base, name, .. } = &expr.kind
                    && matches!(&base.kind, crate::ExprKind::Name(n) if n == self.1)
                    && base.ty == Some(Type::Struct(self.2.clone()))
                {
                    self.0.push((expr.tokens, name.clone()));
                }
                true
            }
        }
        let mut found = Members(Vec::new(), instance, format!("{} (block)", block.name));
        crate::walk::walk_unit(&self.parsed.unit, &mut found);
        for (tokens, name) in found.0 {
            let name = format!("{}_{name}", block.name);
            // Enclosing parentheses are removed too, which changes nothing.
            match self.stretch(tokens) {
                Some((start, end)) => self.edits.replace(start, end, name),
                None => self.cannot(block.name_span, "the use of this block comes from a macro"),
            }
        }
    }
}
