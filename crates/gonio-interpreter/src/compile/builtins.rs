//! Calls of built-in functions (GLSL 4.60, chapter 8; GLSL 1.10, section 8.7, for the old texture functions).

use super::expressions::is_float;
use super::{Compiler, Result, unsupported};
use crate::code::{Along, Detail, Instr, One, Reg, TextureCall, TextureOperation, Three, Two, Whole};
use gonio_glsl::ast::Call;
use gonio_glsl::{Expr, Scalar, Type};

/// An evaluated argument.
type Arg = (Reg, Type);

impl Compiler<'_> {
    pub(super) fn builtin(&mut self, call: &Call, expr: &Expr, dst: Reg, ty: &Type) -> Result<()> {
        let name = &*call.name;
        if name.starts_with("tex") || name.starts_with("shadow") {
            return self.texture(call, expr, dst, ty);
        }
        if let Some(count) = out_argument(name) {
            return self.with_out(call, expr, dst, ty, count);
        }
        let mut args: Vec<Arg> = Vec::new();
        for arg in &call.args {
            args.push((self.evaluate(arg)?, self.type_of(arg)?));
        }
        let n = self.size(ty, expr.span)?;
        let first = args.first().map_or(ty, |arg| &arg.1).clone();
        if let [a] = &args[..]
            && let Some(op) = one(name, &first)
        {
            return self.emit(Instr::One { op, dst, a: a.0, n });
        }
        if let [a, b] = &args[..]
            && let Some(op) = two(name, &first)
        {
            return self.two_of(op, dst, a, b, n);
        }
        if let [a, b, c] = &args[..]
            && let Some((op, order)) = three(name, &first, &c.1)
        {
            let ordered = order.map(|at| [a, b, c][at]);
            let [x, y, z] = ordered.map(|arg| arg.0);
            let steps = ordered.map(|arg| u8::from(arg.1.components() != Some(1)));
            return self.emit(Instr::Three { op, dst, a: x, b: y, c: z, n, steps });
        }
        if let [a] = &args[..]
            && let Some((op, to)) = whole(name, &first)
        {
            let n = self.size(&first, expr.span)? as u8;
            return self.emit(Instr::Whole { op, dst, to, a: a.0, n });
        }
        if let [a] = &args[..]
            && let Some(along) = derivative(name)
        {
            return self.emit(Instr::Derivative { dst, a: a.0, n, along });
        }
        match (name, &args[..]) {
            ("any", [a]) => self.emit(Instr::Reduce { dst, a: a.0, n: components(a), all: false }),
            ("all", [a]) => self.emit(Instr::Reduce { dst, a: a.0, n: components(a), all: true }),
            ("interpolateAtCentroid", [a]) => self.emit(Instr::Copy { dst, src: a.0, n }),
            _ => self.geometric(name, &args, dst, expr),
        }
    }

    fn two_of(&mut self, op: Two, dst: Reg, a: &Arg, b: &Arg, n: u32) -> Result<()> {
        let steps = [u8::from(components(a) > 1), u8::from(components(b) > 1)];
        self.emit(Instr::Two { op, dst, a: a.0, b: b.0, n, steps })
    }

    fn dot(&mut self, dst: Reg, a: Reg, b: Reg, n: u32) -> Result<()> {
        self.emit(Instr::Dot { dst, a, b, n: n as u8, steps: [1, 1] })
    }

    /// Geometric and matrix functions (sections 8.5 and 8.6).
    fn geometric(&mut self, name: &str, args: &[Arg], dst: Reg, expr: &Expr) -> Result<()> {
        match (name, args) {
            ("dot", [a, b]) => self.dot(dst, a.0, b.0, components(a)),
            ("length", [a]) => self.length(dst, a.0, components(a)),
            ("distance", [a, b]) => {
                let n = components(a);
                let difference = self.allocate(n)?;
                self.two_of(Two::FSub, difference, a, b, n)?;
                self.length(dst, difference, n)
            }
            ("normalize", [a]) => {
                let n = components(a);
                let (square, scale) = (self.allocate(1)?, self.allocate(1)?);
                self.dot(square, a.0, a.0, n)?;
                self.emit(Instr::One { op: One::InverseSqrt, dst: scale, a: square, n: 1 })?;
                self.scaled(dst, a.0, scale, n)
            }
            ("cross", [a, b]) => {
                for (at, (i, j)) in [(1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
                    let (x, y) = (self.allocate(1)?, self.allocate(1)?);
                    self.times(x, a.0 + i, b.0 + j)?;
                    self.times(y, a.0 + j, b.0 + i)?;
                    let dst = dst + at as u32;
                    self.emit(Instr::Two { op: Two::FSub, dst, a: x, b: y, n: 1, steps: [0, 0] })?;
                }
                Ok(())
            }
            // faceforward(N, I, Nref): N if dot(Nref, I) < 0, -N otherwise.
            ("faceforward", [normal, incident, reference]) => {
                let n = components(normal);
                let (cosine, negative, zero) = (self.allocate(1)?, self.allocate(n)?, self.constant(0.0)?);
                self.dot(cosine, reference.0, incident.0, n)?;
                self.emit(Instr::Two { op: Two::FLess, dst: cosine, a: cosine, b: zero, n: 1, steps: [0, 0] })?;
                self.emit(Instr::One { op: One::FNeg, dst: negative, a: normal.0, n })?;
                let (op, steps) = (Three::Select, [0, 1, 1]);
                self.emit(Instr::Three { op, dst, a: cosine, b: normal.0, c: negative, n, steps })
            }
            // reflect(I, N) = I - 2 dot(N, I) N.
            ("reflect", [incident, normal]) => {
                let n = components(incident);
                let (cosine, twice, along) = (self.allocate(1)?, self.allocate(1)?, self.allocate(n)?);
                let two = self.constant(2.0)?;
                self.dot(cosine, normal.0, incident.0, n)?;
                self.times(twice, cosine, two)?;
                self.scaled(along, normal.0, twice, n)?;
                self.emit(Instr::Two { op: Two::FSub, dst, a: incident.0, b: along, n, steps: [1, 1] })
            }
            ("refract", [incident, normal, ratio]) => {
                let n = components(incident);
                let all = self.allocate(2 * n + 1)?;
                self.emit(Instr::Copy { dst: all, src: incident.0, n })?;
                self.emit(Instr::Copy { dst: all + n, src: normal.0, n })?;
                self.emit(Instr::Copy { dst: all + 2 * n, src: ratio.0, n: 1 })?;
                self.emit(Instr::Whole { op: Whole::Refract(n as u8), dst, to: n as u8, a: all, n: (2 * n + 1) as u8 })
            }
            ("matrixCompMult", [a, b]) => self.two_of(Two::FMul, dst, a, b, components(a)),
            ("outerProduct", [a, b]) => {
                let rows = components(a);
                for column in 0..components(b) {
                    self.scaled(dst + column * rows, a.0, b.0 + column, rows)?;
                }
                Ok(())
            }
            ("transpose", [(a, Type::Matrix { columns, rows, .. })]) => {
                let (columns, rows) = (u32::from(*columns), u32::from(*rows));
                for (column, row) in (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r))) {
                    self.emit(Instr::Copy { dst: dst + row * columns + column, src: a + column * rows + row, n: 1 })?;
                }
                Ok(())
            }
            ("ftransform", []) => {
                let (matrix, vertex) =
                    (self.builtins.get("gl_ModelViewProjectionMatrix"), self.builtins.get("gl_Vertex"));
                let (Some(matrix), Some(vertex)) = (matrix.cloned(), vertex.cloned()) else {
                    return Err(unsupported("`ftransform`", expr.span));
                };
                let (m, v) = (self.allocate(16)?, self.allocate(4)?);
                self.emit(Instr::Load { dst: m, src: matrix.reg, n: 16 })?;
                self.emit(Instr::Load { dst: v, src: vertex.reg, n: 4 })?;
                self.product(dst, (m, &matrix.ty), (v, &vertex.ty))
            }
            _ => Err(unsupported(format!("the function `{name}` with these arguments"), expr.span)),
        }
    }

    fn times(&mut self, dst: Reg, a: Reg, b: Reg) -> Result<()> {
        self.emit(Instr::Two { op: Two::FMul, dst, a, b, n: 1, steps: [0, 0] })
    }

    fn scaled(&mut self, dst: Reg, a: Reg, scale: Reg, n: u32) -> Result<()> {
        self.emit(Instr::Two { op: Two::FMul, dst, a, b: scale, n, steps: [1, 0] })
    }

    fn length(&mut self, dst: Reg, a: Reg, n: u32) -> Result<()> {
        let square = self.allocate(1)?;
        self.dot(square, a, a, n)?;
        self.emit(Instr::One { op: One::Sqrt, dst, a: square, n: 1 })
    }

    /// Functions with an `out` parameter.
    fn with_out(&mut self, call: &Call, expr: &Expr, dst: Reg, ty: &Type, at: usize) -> Result<()> {
        let Some((out, rest)) = call.args.get(at).zip(call.args.get(..at)) else {
            return Err(unsupported(format!("the function `{}`", call.name), expr.span));
        };
        let mut args = Vec::new();
        for arg in rest {
            args.push((self.evaluate(arg)?, self.type_of(arg)?));
        }
        let place = self.place(out)?;
        let n = self.size(ty, expr.span)?;
        let second = self.allocate(n)?;
        match (&*call.name, &args[..]) {
            ("modf" | "frexp", [a]) => {
                let op = if call.name == "modf" { Whole::Modf } else { Whole::Frexp };
                let both = self.allocate(2)?;
                for component in 0..n {
                    self.emit(Instr::Whole { op, dst: both, to: 2, a: a.0 + component, n: 1 })?;
                    self.emit(Instr::Copy { dst: dst + component, src: both, n: 1 })?;
                    self.emit(Instr::Copy { dst: second + component, src: both + 1, n: 1 })?;
                }
            }
            ("uaddCarry", [a, b]) => {
                self.two_of(Two::IAdd, dst, a, b, n)?;
                self.two_of(Two::CarryOut, second, a, b, n)?;
            }
            ("usubBorrow", [a, b]) => {
                self.two_of(Two::ISub, dst, a, b, n)?;
                self.two_of(Two::BorrowOut, second, a, b, n)?;
            }
            _ => return Err(unsupported(format!("the function `{}`", call.name), expr.span)),
        }
        self.store(&place, second, out.span)
    }
}

fn components(arg: &Arg) -> u32 {
    arg.1.components().unwrap_or(1)
}

/// The index of the `out` argument.
fn out_argument(name: &str) -> Option<usize> {
    match name {
        "modf" | "frexp" => Some(1),
        "uaddCarry" | "usubBorrow" => Some(2),
        _ => None,
    }
}

fn one(name: &str, ty: &Type) -> Option<One> {
    let float = is_float(ty);
    let unsigned = ty.scalar() == Some(Scalar::UInt);
    Some(match name {
        "radians" => One::Radians,
        "degrees" => One::Degrees,
        "sin" => One::Sin,
        "cos" => One::Cos,
        "tan" => One::Tan,
        "asin" => One::Asin,
        "acos" => One::Acos,
        "atan" => One::Atan,
        "sinh" => One::Sinh,
        "cosh" => One::Cosh,
        "tanh" => One::Tanh,
        "asinh" => One::Asinh,
        "acosh" => One::Acosh,
        "atanh" => One::Atanh,
        "exp" => One::Exp,
        "log" => One::Log,
        "exp2" => One::Exp2,
        "log2" => One::Log2,
        "sqrt" => One::Sqrt,
        "inversesqrt" => One::InverseSqrt,
        "abs" if float => One::FAbs,
        "abs" => One::IAbs,
        "sign" if float => One::FSign,
        "sign" => One::ISign,
        "floor" => One::Floor,
        "ceil" => One::Ceil,
        "trunc" => One::Trunc,
        "round" | "roundEven" => One::Round,
        "fract" => One::Fract,
        "isnan" => One::IsNan,
        "isinf" => One::IsInf,
        "not" => One::Not,
        // The bits stay the same.
        "floatBitsToInt" | "floatBitsToUint" | "intBitsToFloat" | "uintBitsToFloat" => One::Same,
        "bitfieldReverse" => One::BitReverse,
        "bitCount" => One::BitCount,
        "findLSB" => One::LowestBit,
        "findMSB" if unsigned => One::HighestBitU,
        "findMSB" => One::HighestBitI,
        // Every implementation returns 0 (GLSL 4.60, section 8.16).
        "noise1" | "noise2" | "noise3" | "noise4" => One::Zero,
        _ => return None,
    })
}

fn two(name: &str, ty: &Type) -> Option<Two> {
    let float = is_float(ty);
    let unsigned = ty.scalar() == Some(Scalar::UInt);
    let pick = |f: Two, i: Two, u: Two| {
        if float {
            f
        } else if unsigned {
            u
        } else {
            i
        }
    };
    Some(match name {
        "atan" => Two::Atan2,
        "pow" => Two::Pow,
        "mod" => Two::FMod,
        "min" => pick(Two::FMin, Two::IMin, Two::UMin),
        "max" => pick(Two::FMax, Two::IMax, Two::UMax),
        "step" => Two::Step,
        "ldexp" => Two::Ldexp,
        "lessThan" => pick(Two::FLess, Two::ILess, Two::ULess),
        "lessThanEqual" => pick(Two::FLessEqual, Two::ILessEqual, Two::ULessEqual),
        "greaterThan" => pick(Two::FGreater, Two::IGreater, Two::UGreater),
        "greaterThanEqual" => pick(Two::FGreaterEqual, Two::IGreaterEqual, Two::UGreaterEqual),
        "equal" => pick(Two::FEqual, Two::IEqual, Two::IEqual),
        "notEqual" => pick(Two::FNotEqual, Two::INotEqual, Two::INotEqual),
        _ => return None,
    })
}

/// The operation, and the arguments in its order.
fn three(name: &str, ty: &Type, last: &Type) -> Option<(Three, [usize; 3])> {
    let unsigned = ty.scalar() == Some(Scalar::UInt);
    let same = [0, 1, 2];
    Some(match name {
        "clamp" if is_float(ty) => (Three::FClamp, same),
        "clamp" if unsigned => (Three::UClamp, same),
        "clamp" => (Three::IClamp, same),
        // mix(x, y, a) with booleans is y where a is true.
        "mix" if last.scalar() == Some(Scalar::Bool) => (Three::Select, [2, 1, 0]),
        "mix" => (Three::Mix, same),
        "smoothstep" => (Three::Smoothstep, same),
        "fma" => (Three::Fma, same),
        "bitfieldExtract" if unsigned => (Three::ExtractU, same),
        "bitfieldExtract" => (Three::ExtractI, same),
        _ => return None,
    })
}

fn whole(name: &str, ty: &Type) -> Option<(Whole, u8)> {
    let side = match ty {
        Type::Matrix { columns, .. } => *columns,
        _ => 0,
    };
    Some(match name {
        "determinant" => (Whole::Determinant(side), 1),
        "inverse" => (Whole::Inverse(side), side * side),
        "packUnorm2x16" => (Whole::PackUnorm2x16, 1),
        "packSnorm2x16" => (Whole::PackSnorm2x16, 1),
        "packHalf2x16" => (Whole::PackHalf2x16, 1),
        "packUnorm4x8" => (Whole::PackUnorm4x8, 1),
        "packSnorm4x8" => (Whole::PackSnorm4x8, 1),
        "unpackUnorm2x16" => (Whole::UnpackUnorm2x16, 2),
        "unpackSnorm2x16" => (Whole::UnpackSnorm2x16, 2),
        "unpackHalf2x16" => (Whole::UnpackHalf2x16, 2),
        "unpackUnorm4x8" => (Whole::UnpackUnorm4x8, 4),
        "unpackSnorm4x8" => (Whole::UnpackSnorm4x8, 4),
        _ => return None,
    })
}

fn derivative(name: &str) -> Option<Along> {
    Some(match name.trim_end_matches("Fine").trim_end_matches("Coarse") {
        "dFdx" => Along::X,
        "dFdy" => Along::Y,
        "fwidth" => Along::Both,
        _ => return None,
    })
}

impl Compiler<'_> {
    pub(super) fn texture(&mut self, call: &Call, expr: &Expr, dst: Reg, ty: &Type) -> Result<()> {
        let refuse = || unsupported(format!("the function `{}` with these arguments", call.name), expr.span);
        let mut args: Vec<(Reg, Type)> = Vec::new();
        for arg in &call.args {
            args.push((self.evaluate(arg)?, self.type_of(arg)?));
        }
        let Some((sampler, Type::Opaque(kind))) = args.first().cloned() else { return Err(refuse()) };
        let kind = &*kind;
        let shape = kind.trim_start_matches(['i', 'u']).trim_start_matches("sampler");
        let is_shadow = shape.ends_with("Shadow");
        let dims: u8 = match shape.trim_end_matches("Shadow") {
            "1D" => 1,
            "2D" | "2DRect" | "1DArray" => 2,
            "3D" | "Cube" | "2DArray" => 3,
            "CubeArray" => 4,
            _ => return Err(unsupported(format!("a `{kind}`"), expr.span)),
        };
        let to = match kind.chars().next() {
            Some('i') => Scalar::Int,
            Some('u') => Scalar::UInt,
            _ => Scalar::Float,
        };
        // `texture2DProjLodEXT` is what `textureProjLod` is.
        let words = call.name.trim_end_matches("EXT").trim_end_matches("ARB");
        let has = |word: &str| words.contains(word);
        let operation = match words {
            "textureSize" => TextureOperation::Size,
            "textureQueryLevels" => TextureOperation::Levels,
            "textureQueryLod" => TextureOperation::QueryLod,
            _ if has("Gather") => TextureOperation::Gather,
            _ if has("Fetch") => TextureOperation::Fetch,
            _ => TextureOperation::Sample,
        };
        let n = self.size(ty, expr.span)?;
        let (coordinates, coordinate_type) = match args.get(1) {
            Some((reg, ty)) if operation != TextureOperation::Size => (*reg, ty.components().unwrap_or(1)),
            _ => (dst, 0),
        };
        let mut rest = args.get(2..).unwrap_or_default().iter().map(|arg| (arg.0, arg.1.components().unwrap_or(1)));
        // After the coordinates: the compared depth of a gather, the detail, the offset, the bias or component.
        let divisor = (has("Proj") && coordinate_type > 0).then(|| coordinates + coordinate_type - 1);
        let compare = match operation {
            TextureOperation::Gather if is_shadow => rest.next().map(|arg| arg.0),
            TextureOperation::Sample if is_shadow => match shape {
                // The third component also for one dimension.
                "1DShadow" => Some(coordinates + 2),
                "CubeArrayShadow" => rest.next().map(|arg| arg.0),
                _ => Some(coordinates + u32::from(dims)),
            },
            _ => None,
        };
        if u32::from(dims) > coordinate_type && coordinate_type > 0 {
            return Err(refuse());
        }
        let detail = if operation == TextureOperation::Size {
            args.get(1).map_or(Detail::Implicit(None), |arg| Detail::Explicit(arg.0))
        } else if has("Grad") {
            let (Some((dx, n)), Some((dy, _))) = (rest.next(), rest.next()) else { return Err(refuse()) };
            Detail::Gradient { dx, dy, n: n as u8 }
        } else if has("Lod") && operation == TextureOperation::Sample || operation == TextureOperation::Fetch {
            match rest.next() {
                Some((reg, _)) => Detail::Explicit(reg),
                // Rectangles have one level.
                None => Detail::Implicit(None),
            }
        } else {
            Detail::Implicit(None)
        };
        let offset = match has("Offset") {
            true => Some(rest.next().map(|(reg, n)| (reg, n as u8)).ok_or_else(refuse)?),
            false => None,
        };
        let last = rest.next().map(|arg| arg.0);
        let (detail, component) = match (operation, detail, last) {
            (TextureOperation::Gather, detail, component) => (detail, component),
            (_, Detail::Implicit(None), bias @ Some(_)) => (Detail::Implicit(bias), None),
            (_, detail, _) => (detail, None),
        };
        let index = self.textures.len() as u32;
        self.textures.push(TextureCall {
            operation,
            dst,
            n: n as u8,
            to,
            sampler,
            coordinates,
            dims,
            divisor,
            compare,
            detail,
            offset,
            component,
        });
        self.emit(Instr::Texture { index })
    }
}
