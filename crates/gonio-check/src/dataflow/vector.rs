//! Classifies the vectors of a program: a normal, a position, a direction to the light or to the eye.

use super::graph::{Graph, Id, Op, component, is_leading};
use super::matrix::{Base, Matrix};
use crate::roles::Role;
use gonio_glsl::Components;
use gonio_glsl::ast::BinaryOp;

/// The space of a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Space {
    Model,
    /// Multiplied by M without its translation.
    Untranslated,
    World,
    View,
    Clip,
    Other,
}

/// The matrix that a normal was multiplied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum By {
    Nothing,
    /// The inverse transpose of M, which is right in world space.
    NormalMatrix,
    /// The same with V, which is right in view space, or M and V themselves.
    View {
        by_model: bool,
    },
    Model,
    /// M, with the normal as a point.
    Translated,
    Whole,
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum VectorKind {
    Point(Space),
    Normal(By),
    /// The position of a light, with its number; `None` for a constant.
    Light(Option<u32>),
    LightDirection,
    Eye,
    Front,
    /// The direction from a position in this space.
    ToLight(Option<u32>, Space),
    ToEye(Space),
    LightMinusNormal,
    /// The normal times a number that contains a cosine.
    AlongNormal,
    /// The reflection of this direction.
    Reflected(Incoming),
    Refracted(Incoming),
    Half,
    Constant,
}

/// The incident direction of a reflection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Incoming {
    Light,
    Eye,
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vector {
    pub kind: VectorKind,
    /// -1 if it points the other way.
    pub sign: f64,
    pub is_unit: bool,
    /// Whether it is interpolated between vertices and not normalised since.
    pub is_between: bool,
    /// The fourth component, if there is one.
    pub w: Option<f64>,
    /// The space of the position of a light or an eye, or of a direction to one; for a reflected direction, world
    /// space if it was transformed back there.
    pub end: Space,
    /// The node that gives it its meaning.
    pub at: Id,
    /// The node that negated it, if any.
    pub turned_at: Option<Id>,
    /// The incident direction of a reflected one.
    pub incoming: Option<Id>,
}

impl Vector {
    fn new(kind: VectorKind, at: Id) -> Self {
        Vector {
            kind,
            sign: 1.0,
            is_unit: false,
            is_between: false,
            w: None,
            end: Space::World,
            at,
            turned_at: None,
            incoming: None,
        }
    }

    fn turned(self, at: Id) -> Self {
        // From a position in view space it points to the eye.
        if self.kind == VectorKind::Point(Space::View) {
            return Vector { kind: VectorKind::ToEye(Space::View), end: Space::View, at, ..self };
        }
        Vector { sign: -self.sign, turned_at: Some(at), ..self }
    }

    pub fn is_normal(&self) -> bool {
        matches!(self.kind, VectorKind::Normal(_))
    }

    /// Whether it is used as the direction to the light, right or wrong.
    pub fn is_light(&self) -> bool {
        matches!(
            self.kind,
            VectorKind::ToLight(..) | VectorKind::Light(_) | VectorKind::LightDirection | VectorKind::LightMinusNormal
        )
    }

    pub fn is_eye(&self) -> bool {
        matches!(self.kind, VectorKind::ToEye(_) | VectorKind::Eye | VectorKind::Front)
    }
}

/// Returns the meaning of each node that is a vector, if it is known.
pub(crate) fn vectors(graph: &Graph, matrices: &[Option<Matrix>]) -> Vec<Option<Vector>> {
    let mut vectors = Vectors { graph, matrices, found: Vec::with_capacity(graph.len()) };
    for id in graph.ids() {
        let vector = vectors.vector(id);
        vectors.found.push(vector);
    }
    vectors.found
}

struct Vectors<'a> {
    graph: &'a Graph,
    matrices: &'a [Option<Matrix>],
    found: Vec<Option<Vector>>,
}

impl Vectors<'_> {
    fn classify(&self, id: Id) -> Option<Vector> {
        self.found.get(id.0 as usize).copied().flatten()
    }

    fn matrix(&self, id: Id) -> Option<&Matrix> {
        self.matrices.get(id.0 as usize)?.as_ref()
    }

    fn vector(&self, id: Id) -> Option<Vector> {
        let graph = self.graph;
        match graph.op(id) {
            Op::Input { role, .. } => {
                let kind = match (*role)? {
                    Role::Position => VectorKind::Point(Space::Model),
                    Role::Normal => VectorKind::Normal(By::Nothing),
                    Role::LightPos(i) | Role::LightPosInView(i) => VectorKind::Light(Some(i)),
                    Role::LightDirection(_) => VectorKind::LightDirection,
                    Role::ViewPos => VectorKind::Eye,
                    Role::ViewFront => VectorKind::Front,
                    _ => return None,
                };
                let end = if matches!(role, Some(Role::LightPosInView(_))) { Space::View } else { Space::World };
                Some(Vector { end, ..Vector::new(kind, id) })
            }
            Op::Copy(a, name) => {
                let mut vector = self.classify(*a)?;
                // A constant position is that of the light or the eye if its name says so.
                if vector.kind == VectorKind::Constant
                    && let Some(kind) = named_place(name)
                {
                    vector.kind = kind;
                }
                Some(vector)
            }
            Op::Interpolated(a) => {
                let vector = self.classify(*a)?;
                Some(match vector.kind {
                    VectorKind::Normal(_) => Vector { is_unit: false, is_between: true, ..vector },
                    _ => Vector { is_between: true, ..vector },
                })
            }
            // The position of the camera, from its matrix.
            Op::Index(a, Some(3)) => {
                let factors = &self.matrix(*a)?.factors;
                let is_camera = matches!(factors[..], [f] if f.base == Base::View && f.is_inverse && !f.is_transposed);
                is_camera.then(|| Vector { w: Some(1.0), ..Vector::new(VectorKind::Eye, id) })
            }
            Op::Swizzle(a, letters) if is_leading(letters) => {
                let w = self.classify(*a)?.w.filter(|_| letters.len() == 4);
                Some(Vector { w, ..self.classify(*a)? })
            }
            Op::Construct(parts) => self.constructed(id, parts),
            Op::Neg(a) => Some(self.classify(*a)?.turned(id)),
            Op::Binary(op, a, b) => self.binary(id, *op, *a, *b),
            Op::Call(name, parts) => self.called(id, name, parts),
            Op::Select(_, a, b) => match (self.classify(*a), self.classify(*b)) {
                // A normal that is flipped to face the eye.
                (Some(a), Some(b)) if a.kind == b.kind => Some(if a.sign < b.sign { b } else { a }),
                // Between the direction of a sun and that to a lamp, the latter is more specific.
                (Some(a), Some(b)) => Some(if matches!(b.kind, VectorKind::ToLight(..)) { b } else { a }),
                (a, b) => a.or(b),
            },
            Op::Write(base, letters, value) if is_leading(letters) => self.classify(*value).or(self.classify(*base)),
            Op::Number(number) if number.len() >= 3 => self.constant(id, number),
            _ => None,
        }
    }

    fn constant(&self, id: Id, number: &Components) -> Option<Vector> {
        let unit = number.iter().take(3).map(|x| x * x).sum::<f64>();
        Some(Vector { is_unit: (unit - 1.0).abs() < 1e-3, ..Vector::new(VectorKind::Constant, id) })
    }

    fn constructed(&self, id: Id, parts: &[Id]) -> Option<Vector> {
        if self.graph.node(id).is_matrix {
            return None;
        }
        if let Some(number) = self.graph.number(id).filter(|number| number.len() >= 3) {
            return self.constant(id, number);
        }
        let first = *parts.first()?;
        match parts.len() {
            1 => Some(Vector { w: None, ..self.classify(first)? }),
            2 => Some(Vector { w: self.graph.scalar(parts[1]), ..self.classify(first)? }),
            _ => {
                // `vec3(p.x, p.y, p.z)`
                let bases: Option<Vec<Id>> = parts
                    .iter()
                    .take(3)
                    .enumerate()
                    .map(|(i, part)| match self.graph.op(self.graph.plain(*part)) {
                        Op::Swizzle(base, letter) if letter.chars().next().and_then(component) == Some(i) => {
                            Some(*base)
                        }
                        _ => None,
                    })
                    .collect();
                let bases = bases?;
                let w = parts.get(3).and_then(|w| self.graph.scalar(*w));
                bases.iter().all(|base| base == &bases[0]).then(|| self.classify(bases[0]))?.map(|v| Vector { w, ..v })
            }
        }
    }

    fn binary(&self, id: Id, op: BinaryOp, a: Id, b: Id) -> Option<Vector> {
        match op {
            BinaryOp::Multiply => {
                if let (Some(matrix), Some(vector)) = (self.matrix(a), self.classify(b)) {
                    return self.transformed(id, matrix, vector);
                }
                // A vector on the left is multiplied by the transpose.
                if let (Some(vector), Some(matrix)) = (self.classify(a), self.matrix(b)) {
                    return self.transformed(id, &matrix.clone().transposed(), vector);
                }
                if self.graph.node(a).is_matrix || self.graph.node(b).is_matrix {
                    return None;
                }
                match (self.classify(a), self.classify(b)) {
                    (Some(vector), _) if self.graph.node(b).width == 1 => self.scaled(id, vector, b),
                    (_, Some(vector)) if self.graph.node(a).width == 1 => self.scaled(id, vector, a),
                    _ => None,
                }
            }
            BinaryOp::Divide => {
                let vector = self.classify(a)?;
                let divisor = self.graph.plain(b);
                match self.graph.op(divisor) {
                    Op::Call(name, _) if is_length(name) => Some(Vector { is_unit: true, is_between: false, ..vector }),
                    // Protected against a division by 0.
                    Op::Call(name, parts) if name == "max" && parts.iter().any(|part| self.is_measured(*part)) => {
                        Some(Vector { is_unit: true, is_between: false, ..vector })
                    }
                    // From homogeneous coordinates.
                    Op::Swizzle(..) => Some(vector),
                    _ => self.scaled(id, vector, b),
                }
            }
            BinaryOp::Add => self.sum(id, self.classify(a), self.classify(b), 1.0, a, b),
            BinaryOp::Subtract => self.sum(id, self.classify(a), self.classify(b), -1.0, a, b),
            _ => None,
        }
    }

    fn is_measured(&self, id: Id) -> bool {
        matches!(self.graph.op(self.graph.plain(id)), Op::Call(name, _) if is_length(name))
    }

    fn scaled(&self, id: Id, vector: Vector, by: Id) -> Option<Vector> {
        match self.graph.scalar(by) {
            Some(number) if number < 0.0 => {
                Some(Vector { is_unit: vector.is_unit && number == -1.0, ..vector.turned(id) })
            }
            Some(number) => Some(Vector { is_unit: vector.is_unit && number == 1.0, ..vector }),
            None if self.graph.call(by, "inversesqrt").is_some() => {
                Some(Vector { is_unit: true, is_between: false, ..vector })
            }
            None if vector.is_normal() => Some(Vector { kind: VectorKind::AlongNormal, at: id, ..vector }),
            None => None,
        }
    }

    fn sum(&self, id: Id, a: Option<Vector>, b: Option<Vector>, sign: f64, at_a: Id, at_b: Id) -> Option<Vector> {
        let is_zero = |id: Id| self.graph.scalar(id) == Some(0.0);
        if is_zero(at_a) {
            return b.map(|b| if sign < 0.0 { b.turned(id) } else { b });
        }
        if is_zero(at_b) {
            return a;
        }
        let is_shift = |id: Id| {
            let matrix = super::matrix::of_columns(self.graph, self.matrices, id);
            matrix.is_some_and(|matrix| matrix.has(Base::View))
        };
        match (a, b) {
            // `mat3(V) * lightPos + V[3].xyz`
            (Some(light), None) if matches!(light.kind, VectorKind::Light(_)) && is_shift(at_b) => return Some(light),
            _ => {}
        }
        let (a, b) = (a?, Vector { sign: sign * b?.sign, ..b? });
        let opposed = a.sign * b.sign < 0.0;
        let end = if a.end == Space::View || b.end == Space::View { Space::View } else { Space::World };
        let made = |kind: VectorKind, sign: f64| Some(Vector { sign, end, w: None, ..Vector::new(kind, id) });
        let pair = |one: Vector, other: Vector| match (one.kind, other.kind) {
            (VectorKind::Light(light), VectorKind::Point(space)) if opposed => {
                made(VectorKind::ToLight(light, space), one.sign)
            }
            (VectorKind::Eye, VectorKind::Point(space)) if opposed => made(VectorKind::ToEye(space), one.sign),
            (VectorKind::Constant, VectorKind::Point(space)) if opposed => {
                made(VectorKind::ToLight(None, space), one.sign)
            }
            (VectorKind::Light(light), VectorKind::ToEye(Space::View)) if !opposed => {
                made(VectorKind::ToLight(light, Space::View), one.sign)
            }
            (VectorKind::Light(_), VectorKind::Normal(_)) if opposed => made(VectorKind::LightMinusNormal, one.sign),
            (VectorKind::ToLight(..), VectorKind::ToEye(_)) => made(VectorKind::Half, one.sign),
            (_, VectorKind::AlongNormal) if one.is_light() || one.is_eye() => {
                let incoming = if one.is_light() { Incoming::Light } else { Incoming::Eye };
                let mut vector = made(VectorKind::Reflected(incoming), one.sign)?;
                vector.is_unit = one.is_unit;
                vector.incoming = Some(if one == a { at_a } else { at_b });
                Some(vector)
            }
            _ => None,
        };
        pair(a, b).or_else(|| pair(b, a))
    }

    fn called(&self, id: Id, name: &str, parts: &[Id]) -> Option<Vector> {
        let first = self.classify(*parts.first()?);
        match name {
            "normalize" => {
                let unit = Vector { is_unit: true, is_between: false, w: None, ..first? };
                Some(match unit.kind {
                    VectorKind::Point(Space::View) => Vector {
                        kind: VectorKind::ToEye(Space::View),
                        end: Space::View,
                        sign: -unit.sign,
                        at: id,
                        ..unit
                    },
                    _ => unit,
                })
            }
            "reflect" | "refract" => {
                let incoming = match first {
                    Some(vector) if vector.is_light() => Incoming::Light,
                    Some(vector) if vector.is_eye() => Incoming::Eye,
                    _ => Incoming::Other,
                };
                let kind =
                    if name == "reflect" { VectorKind::Reflected(incoming) } else { VectorKind::Refracted(incoming) };
                let mut vector = Vector::new(kind, id);
                vector.sign = first.map_or(1.0, |first| first.sign);
                vector.is_unit = first.is_some_and(|first| first.is_unit);
                vector.incoming = parts.first().copied();
                vector.end = first.map_or(Space::World, |first| match first.kind {
                    VectorKind::Point(space) => space,
                    _ => first.end,
                });
                Some(vector)
            }
            "faceforward" | "mix" => first.filter(|vector| vector.kind != VectorKind::Constant),
            _ => None,
        }
    }

    fn transformed(&self, id: Id, matrix: &Matrix, vector: Vector) -> Option<Vector> {
        if matrix.factors.is_empty() {
            return Some(vector);
        }
        let kind = match vector.kind {
            VectorKind::Point(space) => VectorKind::Point(moved(space, matrix, vector.w)),
            VectorKind::Normal(before) => VectorKind::Normal(normal_by(before, matrix, vector.w)),
            // The position of a light or an eye does not depend on the space.
            VectorKind::Light(_) | VectorKind::LightDirection | VectorKind::Eye | VectorKind::Front => {
                let into_view = matrix.bases().is_some_and(|bases| bases[..] == [Base::View]);
                let end = if into_view { Space::View } else { vector.end };
                return Some(Vector { w: vector.w.or(Some(1.0)), end, ..vector });
            }
            VectorKind::ToLight(..) | VectorKind::ToEye(_) | VectorKind::Half => {
                return Some(Vector { w: None, ..vector });
            }
            VectorKind::Reflected(_) | VectorKind::Refracted(_) => {
                let back = matrix.factors.iter().all(|f| f.base == Base::View && f.is_inverse != f.is_transposed);
                return Some(Vector { w: None, end: if back { Space::World } else { vector.end }, ..vector });
            }
            VectorKind::Constant if vector.w == Some(1.0) || self.graph.node(id).width == 4 => {
                let is_origin = self.graph.number(vector.at).is_some_and(|n| n.iter().take(3).all(|x| *x == 0.0));
                return Some(Vector {
                    kind: if is_origin { VectorKind::Eye } else { VectorKind::Constant },
                    at: id,
                    ..vector
                });
            }
            _ => return None,
        };
        let w = if self.graph.node(id).width == 4 { vector.w } else { None };
        Some(Vector { kind, is_unit: false, w, at: id, ..vector })
    }
}

fn moved(from: Space, matrix: &Matrix, w: Option<f64>) -> Space {
    let is_direction = matrix.is_turn || w == Some(0.0);
    let Some(bases) = matrix.bases() else { return Space::Other };
    if bases.contains(&Base::Projection) {
        return Space::Clip;
    }
    match (from, &bases[..]) {
        (Space::Model, [Base::Model]) if is_direction => Space::Untranslated,
        (Space::Model, [Base::Model]) => Space::World,
        (Space::Model, [Base::View, Base::Model]) | (Space::World, [Base::View]) => Space::View,
        _ => Space::Other,
    }
}

fn normal_by(before: By, matrix: &Matrix, w: Option<f64>) -> By {
    if matrix.has(Base::Projection) {
        return By::Whole;
    }
    let has_view = matrix.has(Base::View);
    let mut of_model = matrix.factors.iter().filter(|factor| factor.base == Base::Model);
    let view_turned = matrix.factors.iter().any(|f| f.base == Base::View && f.is_inverse != f.is_transposed);
    let first = of_model.next().map(|factor| (factor.is_inverse, factor.is_transposed));
    if of_model.next().is_some() {
        return By::Other;
    }
    match (before, first) {
        // Back from view space.
        (By::View { by_model }, None) if view_turned => {
            if by_model {
                By::Model
            } else {
                By::NormalMatrix
            }
        }
        (By::Nothing, Some((true, true))) if has_view => By::View { by_model: false },
        (By::Nothing, Some((true, true))) => By::NormalMatrix,
        (By::Nothing, Some((false, false))) if has_view => By::View { by_model: true },
        (By::Nothing, Some((false, false))) if w == Some(1.0) && !matrix.is_turn => By::Translated,
        (By::Nothing, Some((false, false))) => By::Model,
        (By::NormalMatrix, None) => By::View { by_model: false },
        (By::Model, None) => By::View { by_model: true },
        _ => By::Other,
    }
}

fn is_length(name: &str) -> bool {
    matches!(name, "length" | "sqrt" | "distance")
}

/// Returns the meaning of a constant position by the name of its variable.
fn named_place(name: &str) -> Option<VectorKind> {
    let name = name.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    if has(&["col", "coul", "amb", "diff", "spec", "str", "int", "att"]) {
        None
    } else if has(&["light", "lum", "lamp", "licht", "sun"]) {
        Some(VectorKind::Light(None))
    } else if has(&["view", "cam", "eye", "oeil", "viewer"]) {
        Some(VectorKind::Eye)
    } else {
        None
    }
}
