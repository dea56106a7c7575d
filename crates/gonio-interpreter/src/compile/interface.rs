//! Inputs, outputs and built-in variables.

use super::{Compiler, Result, Variable, unsupported};
use crate::code::{InputRate, Instr, StageInput, StageOutput};
use crate::layout::{NamedPart, OPEN_ARRAY};
use gonio_glsl::ast::{Declaration, InterfaceBlock, Qualifier, has};
use gonio_glsl::{Span, Stage, Storage, SymbolKind, Type};

/// The qualifiers of a variable that the caller sees.
#[derive(Clone, Default)]
struct Exposed {
    interpolation: Option<String>,
    location: Option<i32>,
    span: Option<Span>,
}

impl Compiler<'_> {
    /// Declares global variables, and initializes them.
    pub(super) fn global(&mut self, declaration: &Declaration) -> Result<()> {
        for declarator in &declaration.declarators {
            if declarator.name.starts_with("gl_") && self.builtins.contains_key(&declarator.name) {
                continue;
            }
            let Some(id) = self.symbol_at(declarator.tokens.first) else { continue };
            let symbol = &self.checked.symbols[id];
            let Some(ty) = symbol.ty.clone() else {
                return Err(unsupported(format!("`{}`, whose type is unknown", declarator.name), declarator.span));
            };
            let storage = symbol.storage;
            let variable = self.variable(Some(id), &declarator.name, ty, Some(declarator.span))?;
            match &declarator.initialiser {
                Some(value) => self.initialise(value, &variable)?,
                None => self.forget(&variable)?,
            }
            let has_default = declarator.initialiser.is_some();
            let exposed = exposed(&declaration.qualifiers, declarator.span);
            self.expose(&declarator.name, &variable, storage, has_default, &exposed)?;
        }
        Ok(())
    }

    pub(super) fn forget(&mut self, variable: &Variable) -> Result<()> {
        let n = self.size(&variable.ty, Span::default())?;
        self.emit(Instr::Forget { dst: variable.reg, n })
    }

    /// Declares the variables of a block.
    pub(super) fn block(&mut self, block: &InterfaceBlock) -> Result<()> {
        if has(&block.qualifiers, "buffer") {
            return Err(unsupported("a `buffer` block", block.name_span));
        }
        let storage = if has(&block.qualifiers, "uniform") {
            Storage::Uniform
        } else if has(&block.qualifiers, "in") {
            Storage::In
        } else {
            Storage::Out
        };
        if let Some(instance) = &block.instance {
            let Some(id) = self.symbol_at(instance.tokens.first) else { return Ok(()) };
            if block.name == "gl_PerVertex" {
                return Err(unsupported("a redeclared `gl_PerVertex` with an instance name", block.name_span));
            }
            let Some(ty) = self.checked.symbols[id].ty.clone() else {
                return Err(unsupported(format!("the block `{}`", block.name), block.name_span));
            };
            let variable = self.variable(Some(id), &block.name, ty, Some(instance.span))?;
            self.forget(&variable)?;
            if let Type::Struct(of) = &variable.ty {
                return self.members(block, &variable, &of.clone(), storage);
            }
            return self.expose(&block.name, &variable, storage, false, &exposed(&block.qualifiers, instance.span));
        }
        for member in &block.members {
            for declarator in &member.declarators {
                let Some(id) = self.symbol_at(declarator.tokens.first) else { continue };
                debug_assert_eq!(self.checked.symbols[id].kind, SymbolKind::BlockMember);
                if self.builtins.contains_key(&declarator.name) {
                    continue;
                }
                let Some(ty) = self.checked.symbols[id].ty.clone() else {
                    return Err(unsupported(format!("the block `{}`", block.name), block.name_span));
                };
                let variable = self.variable(Some(id), &declarator.name, ty, Some(declarator.span))?;
                self.forget(&variable)?;
                let qualifiers = [&block.qualifiers[..], &member.qualifiers[..]].concat();
                self.expose(&declarator.name, &variable, storage, false, &exposed(&qualifiers, declarator.span))?;
            }
        }
        Ok(())
    }

    /// Lists the members of a block with an instance name, each with its own qualifiers.
    fn members(&mut self, block: &InterfaceBlock, whole: &Variable, of: &str, storage: Storage) -> Result<()> {
        let mut location = exposed(&block.qualifiers, block.span).location;
        for member in &block.members {
            for declarator in &member.declarators {
                let Some((offset, ty)) = self.layouts.member(of, &declarator.name) else { continue };
                let part = Variable { reg: whole.reg + offset, ty, traced: whole.traced };
                let qualifiers = [&block.qualifiers[..], &member.qualifiers[..]].concat();
                let name = format!("{}.{}", block.name, declarator.name);
                let own = exposed(&member.qualifiers, declarator.span).location;
                location = own.or(location);
                let exposed = Exposed { location, ..exposed(&qualifiers, declarator.span) };
                self.expose(&name, &part, storage, false, &exposed)?;
                location = self.located(&name, &part.ty, location).1;
            }
        }
        Ok(())
    }

    /// Lists a variable among the inputs or outputs.
    fn expose(
        &mut self,
        name: &str,
        variable: &Variable,
        storage: Storage,
        has_default: bool,
        exposed: &Exposed,
    ) -> Result<()> {
        let rate = match storage {
            Storage::Uniform => InputRate::Uniform,
            Storage::In => InputRate::PerPoint,
            Storage::Out => {
                self.expose_output(name, variable, exposed);
                return Ok(());
            }
            Storage::Buffer => return Err(unsupported("a `buffer`", exposed.span.unwrap_or_default())),
            Storage::None | Storage::Const => return Ok(()),
        };
        for (part, location) in self.located(name, &variable.ty, exposed.location).0 {
            let each = self.size(&part.ty, exposed.span.unwrap_or_default())?;
            let index = self.inputs.len() as u32;
            self.inputs.push(StageInput {
                name: part.name,
                ty: part.ty,
                count: part.count,
                rate,
                interpolation: exposed.interpolation.clone(),
                location,
                span: exposed.span,
                reg: variable.reg + part.offset,
                size: each * part.count,
                has_default,
            });
            self.emit(Instr::Input { index })?;
        }
        Ok(())
    }

    /// The parts of a variable, each with its location, and the next location.
    fn located(&self, name: &str, ty: &Type, first: Option<i32>) -> (Vec<(NamedPart, Option<i32>)>, Option<i32>) {
        let mut next = first;
        let with_location = |part: NamedPart| {
            let location = next;
            next = next.map(|first| first + locations(&part.ty, part.count));
            (part, location)
        };
        let parts = self.layouts.parts(name, ty).into_iter().map(with_location).collect();
        (parts, next)
    }

    fn expose_output(&mut self, name: &str, variable: &Variable, exposed: &Exposed) {
        for (part, location) in self.located(name, &variable.ty, exposed.location).0 {
            let each = self.layouts.size(&part.ty).unwrap_or(0);
            self.outputs.push(StageOutput {
                name: part.name,
                ty: part.ty,
                count: part.count,
                interpolation: exposed.interpolation.clone(),
                location,
                span: exposed.span,
                reg: variable.reg + part.offset,
                size: each * part.count,
            });
        }
    }

    /// Declares the built-in variables that the shader uses.
    pub(super) fn builtin_variables(&mut self) -> Result<()> {
        let mut names: Vec<String> = self.checked.variables_used.iter().cloned().collect();
        // Redeclared ones are symbols of the shader.
        let is_global = |kind| matches!(kind, SymbolKind::Global | SymbolKind::BlockMember);
        let declared = self.checked.symbols.iter().filter(|s| s.name.starts_with("gl_") && is_global(s.kind));
        names.extend(declared.map(|s| s.name.clone()));
        if self.checked.functions_used.contains("ftransform") {
            names.extend(["gl_ModelViewProjectionMatrix".into(), "gl_Vertex".into()]);
        }
        if self.checked.stage == Stage::Vertex {
            names.push("gl_Position".into());
        }
        names.sort();
        names.dedup();
        for name in names {
            self.builtin_variable(&name)?;
        }
        Ok(())
    }

    fn builtin_variable(&mut self, name: &str) -> Result<()> {
        let stage = self.checked.stage;
        let redeclared = self.checked.symbols.iter().find(|s| s.name == name).and_then(|s| s.ty.clone());
        let version = self.parsed.dialect();
        let known = gonio_glsl::builtin_variable(name, stage, version);
        let Some(ty) = redeclared.or_else(|| known.as_ref().and_then(|k| k.ty.clone())) else {
            return Err(unsupported(format!("`{name}`"), Span::default()));
        };
        for info in gonio_glsl::builtin_structs() {
            self.layouts.add(info);
        }
        let variable = self.variable(None, name, ty, None)?;
        self.builtins.insert(name.to_string(), variable.clone());
        if let Some(value) = limit(name) {
            return self.emit(Instr::Constant { dst: variable.reg, bits: value as u32 });
        }
        self.forget(&variable)?;
        let exposed = Exposed::default();
        if known.is_some_and(|k| k.is_writable) {
            self.expose_output(name, &variable, &exposed);
            return Ok(());
        }
        let storage = if is_per_point(name) { Storage::In } else { Storage::Uniform };
        self.expose(name, &variable, storage, false, &exposed)
    }
}

/// The locations that a variable takes: one for each vector, or column of a matrix.
fn locations(ty: &Type, count: u32) -> i32 {
    let written = ty.written();
    let columns = written.strip_prefix("mat").or(written.strip_prefix("dmat")).and_then(|rest| rest.chars().next());
    (columns.and_then(|digit| digit.to_digit(10)).unwrap_or(1) * count) as i32
}

fn exposed(qualifiers: &[Qualifier], span: Span) -> Exposed {
    let interpolation = ["flat", "noperspective"].iter().find(|word| has(qualifiers, word)).map(|w| (*w).to_string());
    let entry = qualifiers.iter().flat_map(|q| &q.layout).find(|entry| entry.name == "location");
    let location = entry
        .and_then(|entry| gonio_glsl::evaluate(entry.value.as_ref()?, &|_| None))
        .and_then(|value| value.first().map(|v| *v as i32));
    Exposed { interpolation, location, span: Some(span) }
}

/// Built-in inputs with a value for each point; the others are state.
fn is_per_point(name: &str) -> bool {
    const NAMES: [&str; 20] = [
        "gl_VertexID",
        "gl_InstanceID",
        "gl_FragCoord",
        "gl_FrontFacing",
        "gl_PointCoord",
        "gl_ClipDistance",
        "gl_CullDistance",
        "gl_PrimitiveID",
        "gl_SampleID",
        "gl_SamplePosition",
        "gl_SampleMaskIn",
        "gl_Layer",
        "gl_HelperInvocation",
        "gl_Vertex",
        "gl_Normal",
        "gl_Color",
        "gl_SecondaryColor",
        "gl_FogCoord",
        "gl_TexCoord",
        "gl_FogFragCoord",
    ];
    NAMES.contains(&name) || name.starts_with("gl_MultiTexCoord")
}

/// The least values that OpenGL 3.3 allows, or those of old OpenGL (GLSL 4.60 compatibility, section 7.3).
fn limit(name: &str) -> Option<i32> {
    Some(match name {
        "gl_MaxLights" | "gl_MaxClipPlanes" | "gl_MaxTextureCoords" | "gl_MaxClipDistances" | "gl_MaxDrawBuffers" => {
            OPEN_ARRAY as i32
        }
        "gl_MaxTextureUnits" => 2,
        "gl_MaxVertexAttribs" | "gl_MaxTextureImageUnits" | "gl_MaxVertexTextureImageUnits" => 16,
        "gl_MaxVertexUniformComponents" | "gl_MaxFragmentUniformComponents" => 1024,
        "gl_MaxVertexUniformVectors" => 256,
        "gl_MaxFragmentUniformVectors" => 224,
        "gl_MaxVaryingFloats" | "gl_MaxVaryingComponents" => 60,
        "gl_MaxVaryingVectors" | "gl_MaxVertexOutputVectors" | "gl_MaxFragmentInputVectors" => 15,
        "gl_MaxCombinedTextureImageUnits" => 48,
        "gl_MinProgramTexelOffset" => -8,
        "gl_MaxProgramTexelOffset" => 7,
        _ if name.starts_with("gl_Max") => 16,
        _ => return None,
    })
}
