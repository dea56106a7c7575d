//! Places: variables, their members, elements and components, as they are read and assigned to.

use super::{Compiler, Result, unsupported};
use crate::code::{Instr, Reg};
use crate::layout::OPEN_ARRAY;
use crate::source::ExprId;
use gonio_glsl::{Expr, ExprKind, Span, Type};

/// A part of a variable or of an intermediate value.
#[derive(Clone)]
pub(super) struct Place {
    base: Reg,
    /// A register with an offset that is known at run time.
    offset: Option<Reg>,
    /// Components of a vector, if not all in order.
    components: Option<Vec<u8>>,
    pub ty: Type,
    /// The registers of the whole variable from `base` on, which bounds `offset`.
    total: u32,
    /// The traced variable; `None` for an intermediate value.
    variable: Option<u32>,
}

impl Compiler<'_> {
    /// Returns the place of an expression; that of a value in new registers unless it is part of a variable.
    pub(super) fn place(&mut self, expr: &Expr) -> Result<Place> {
        self.enter(expr.span)?;
        let place = match &expr.kind {
            ExprKind::Name(name) => self.named(expr, name)?,
            ExprKind::Field { base, name, .. } => {
                let base = self.place(base)?;
                self.field(base, name, expr)?
            }
            ExprKind::Index { base, index } => {
                let base = self.place(base)?;
                self.element(base, index, expr)?
            }
            _ => {
                let ty = self.raw_type(expr)?;
                let total = self.size(&ty, expr.span)?;
                let base = self.allocate(total)?;
                self.evaluate_into(expr, base)?;
                Place { base, offset: None, components: None, ty, total, variable: None }
            }
        };
        self.nested -= 1;
        Ok(place)
    }

    fn named(&mut self, expr: &Expr, name: &str) -> Result<Place> {
        let own = self.symbol_at(expr.tokens.first + leading_parentheses(self, expr));
        // Redeclared built-in variables are symbols without registers of their own.
        let found = own.and_then(|id| self.variables.get(&id)).or_else(|| self.builtins.get(name));
        let Some(variable) = found.cloned() else {
            return Err(unsupported(format!("`{name}`, which is not a variable here"), expr.span));
        };
        let total = self.size(&variable.ty, expr.span)?;
        Ok(Place {
            base: variable.reg,
            offset: None,
            components: None,
            ty: variable.ty,
            total,
            variable: Some(variable.traced),
        })
    }

    fn field(&mut self, base: Place, name: &str, expr: &Expr) -> Result<Place> {
        match &base.ty {
            Type::Struct(of) => {
                let Some((offset, ty)) = self.layouts.member(of, name) else {
                    return Err(unsupported(format!("the member `{name}`"), expr.span));
                };
                Ok(self.moved(base, offset, ty))
            }
            Type::Vector(..) | Type::Scalar(_) => {
                let picked: Option<Vec<u8>> = name.chars().map(component).collect();
                let picked = picked.ok_or_else(|| unsupported(format!("`.{name}`"), expr.span))?;
                let scalar = base.ty.scalar().unwrap_or(gonio_glsl::Scalar::Float);
                let components: Vec<u8> = match &base.components {
                    Some(before) => picked.iter().filter_map(|at| before.get(usize::from(*at)).copied()).collect(),
                    None => picked,
                };
                let ty = Type::scalar_or_vector(scalar, components.len() as u8);
                Ok(Place { components: Some(components), ty, ..base })
            }
            other => Err(unsupported(format!("`.{name}` of a `{other}`"), expr.span)),
        }
    }

    fn moved(&self, base: Place, by: u32, ty: Type) -> Place {
        match base.offset {
            // The bound of a dynamic offset is that of the whole variable.
            Some(_) => Place { base: base.base + by, ty, total: base.total.saturating_sub(by), ..base },
            None => Place { base: base.base + by, total: base.total.saturating_sub(by), ty, ..base },
        }
    }

    fn element(&mut self, base: Place, index: &Expr, expr: &Expr) -> Result<Place> {
        let (of, count) = match &base.ty {
            Type::Array(of, count) => ((**of).clone(), count.unwrap_or(OPEN_ARRAY)),
            Type::Vector(scalar, n) => (Type::Scalar(*scalar), u32::from(*n)),
            Type::Matrix { scalar, columns, rows } => (Type::scalar_or_vector(*scalar, *rows), u32::from(*columns)),
            other => return Err(unsupported(format!("an index into a `{other}`"), expr.span)),
        };
        let stride = self.size(&of, expr.span)?;
        let known = gonio_glsl::evaluate(index, &|_| None).and_then(|v| v.first().copied());
        let inside = known.filter(|at| *at >= 0.0 && *at < f64::from(count)).map(|at| at as u32);
        if let Some(at) = inside {
            self.mark_literal(index)?;
            return Ok(match &base.components {
                Some(components) => {
                    let component = components.get(at as usize).copied().unwrap_or(0);
                    Place { components: Some(vec![component]), ty: of, ..base }
                }
                None => self.moved(base, at * stride, of),
            });
        }
        if base.components.is_some() {
            // An element of a swizzle, chosen at run time: a copy is indexed, which cannot be assigned to.
            let (ty, total) = (base.ty.clone(), count);
            let copy = self.allocate(total)?;
            self.load(copy, &base)?;
            let copied = Place { base: copy, offset: None, components: None, ty, total, variable: None };
            return self.dynamic(copied, index, of, stride, count);
        }
        self.dynamic(base, index, of, stride, count)
    }

    fn dynamic(&mut self, base: Place, index: &Expr, of: Type, stride: u32, count: u32) -> Result<Place> {
        let is_signed = self.type_of(index)? == Type::INT;
        let register = self.evaluate(index)?;
        let dst = self.allocate(1)?;
        self.emit(Instr::Offset { dst, before: base.offset, index: register, is_signed, stride, count })?;
        Ok(Place { offset: Some(dst), ty: of, ..base })
    }

    fn mark_literal(&mut self, index: &Expr) -> Result<()> {
        // Observers may ask for an index too.
        let next = self.next;
        self.evaluate(index)?;
        self.next = next;
        Ok(())
    }

    /// Reads a place into registers.
    pub(super) fn load(&mut self, dst: Reg, place: &Place) -> Result<()> {
        let n = self.size(&place.ty, Span::default())?;
        for (component, run, at) in runs(place, n) {
            let (dst, base) = (dst + at, place.base + component);
            let instr = match (place.offset, place.variable) {
                (Some(offset), _) => {
                    Instr::Gather { dst, base, offset, total: place.total.saturating_sub(component), n: run }
                }
                (None, Some(_)) if place.ty.components().is_some() => Instr::Load { dst, src: base, n: run },
                // Members of a struct that were never written may be copied with it.
                (None, _) => Instr::Copy { dst, src: base, n: run },
            };
            self.emit(instr)?;
        }
        Ok(())
    }

    /// Assigns the active points of a place.
    pub(super) fn store(&mut self, place: &Place, src: Reg, span: Span) -> Result<()> {
        let Some(variable) = place.variable else {
            return Err(unsupported("an assignment to this: it is not a variable", span));
        };
        let n = self.size(&place.ty, span)?;
        for (component, run, at) in runs(place, n) {
            let (src, base) = (src + at, place.base + component);
            self.emit(match place.offset {
                Some(offset) => {
                    Instr::Scatter { base, offset, src, total: place.total.saturating_sub(component), n: run }
                }
                None => Instr::Store { dst: base, src, n: run },
            })?;
        }
        self.emit(Instr::Wrote { variable })
    }

    /// Marks the whole value of a name within `name.member`, which is not evaluated by itself.
    pub(super) fn mark_base(&mut self, expr: &Expr) -> Result<()> {
        let (mut inner, mut names) = (expr, Vec::new());
        while let ExprKind::Field { base, .. } | ExprKind::Index { base, .. } = &inner.kind {
            inner = base;
            names.push(inner);
        }
        if !matches!(inner.kind, ExprKind::Name(_)) {
            return Ok(());
        }
        for part in names {
            let (Some(id), Some(ty)) = (self.source.id(part), part.ty.clone()) else { continue };
            if matches!(part.kind, ExprKind::Name(_))
                && let ExprKind::Name(name) = &part.kind
            {
                let place = self.named(part, name)?;
                let n = self.size(&ty, part.span)?;
                self.mark(id, place.base, n)?;
            }
        }
        Ok(())
    }

    pub(super) fn mark(&mut self, expr: ExprId, reg: Reg, n: u32) -> Result<()> {
        self.emit(Instr::Mark { expr, reg, n })
    }
}

/// The tokens of an expression include enclosing parentheses.
fn leading_parentheses(compiler: &Compiler<'_>, expr: &Expr) -> u32 {
    let last = expr.tokens.last.saturating_sub(expr.tokens.first);
    (0..=last).find(|skipped| compiler.symbols.contains_key(&(expr.tokens.first + skipped))).unwrap_or(0)
}

fn component(letter: char) -> Option<u8> {
    ["xyzw", "rgba", "stpq"].iter().find_map(|set| set.find(letter)).map(|at| at as u8)
}

/// Splits a place into runs of consecutive scalars: (first one, length, place in the value).
fn runs(place: &Place, n: u32) -> Vec<(u32, u32, u32)> {
    let Some(components) = &place.components else { return vec![(0, n, 0)] };
    let mut found: Vec<(u32, u32, u32)> = Vec::new();
    for (at, component) in components.iter().enumerate() {
        let component = u32::from(*component);
        match found.last_mut() {
            Some((first, length, _)) if *first + *length == component => *length += 1,
            _ => found.push((component, 1, at as u32)),
        }
    }
    found
}
