//! Writes the vertex shader's part of all programs with objects: position, normal, `gl_Position`.

use crate::expression::{Expr, Site};
use crate::plan::{Matrices, NormalBy, Space};
use crate::scenes::Meaning;
use crate::writer::{Block, Writer};

impl Writer<'_> {
    fn matrix(&mut self, key: &str, meaning: Meaning) -> Expr {
        self.uniform(key, "mat4", meaning)
    }

    /// M.
    pub fn model(&mut self) -> Expr {
        self.matrix("M", Meaning::Model)
    }

    /// V.
    pub fn view(&mut self) -> Expr {
        self.matrix("V", Meaning::View)
    }

    /// P.
    pub fn projection(&mut self) -> Expr {
        self.matrix("P", Meaning::Projection)
    }

    /// V M, as one uniform or two.
    fn model_view(&mut self) -> Expr {
        match self.context.plan.matrices {
            Matrices::ModelView | Matrices::Whole => self.matrix("MV", Meaning::ModelView),
            _ => self.view().mul(&self.model()),
        }
    }

    /// The matrix from model space to the space in which vectors meet.
    fn space_matrix(&mut self) -> Expr {
        match self.context.plan.space {
            Space::World => self.model(),
            Space::Eye => self.model_view(),
        }
    }

    pub fn position_attribute(&mut self) -> Expr {
        self.attribute("position", "vec3", Meaning::Position)
    }

    /// `mat3(matrix) * vector`, or with a `vec4` where the version has no such constructor.
    fn turned(&mut self, matrix: &Expr, vector: &Expr) -> Expr {
        if self.version().has_mat3_of_mat4() && self.coin("mat3", 0.6) {
            Expr::call("mat3", &[matrix]).mul(vector)
        } else {
            let product = matrix.mul(&self.vec4(vector, 0.0));
            self.xyz(&product, "xyz of a direction")
        }
    }

    /// Writes `gl_Position` and returns the position in the space of the light.
    pub fn place(&mut self, block: &mut Block) -> Expr {
        let position = self.position_attribute();
        let whole = self.vec4(&position, 1.0);
        let to_space = self.space_matrix();
        let slip = self.slip(&[
            "position-not-transformed",
            "position-without-translation",
            "position-in-view-space",
            "position-in-clip-space",
            "position-in-world-space",
        ]);
        let (mut point, mut whole_point) = (None, None);
        let value = match slip {
            None => {
                let product = to_space.mul(&whole);
                if self.coin("position as vec4", 0.6) {
                    let name = self.variable(block, "world4", "vec4", &product.at(Site::Position));
                    whole_point = Some(name.clone());
                    self.xyz(&name, "xyz of a position")
                } else {
                    self.xyz(&product, "xyz of a position").at(Site::Position)
                }
            }
            Some("position-not-transformed") => position.clone().at(Site::Position),
            Some("position-without-translation") => self.turned(&to_space, &position).at(Site::Position),
            Some("position-in-world-space") => self.model().mul(&whole).field("xyz").at(Site::Position),
            Some("position-in-view-space") => self.model_view().mul(&whole).field("xyz").at(Site::Position),
            Some(_) => {
                let chain = self.projection().mul(&self.view()).mul(&self.model()).mul(&whole);
                chain.field("xyz").at(Site::Position)
            }
        };
        // In Phong shading the position is only passed on, unless `gl_Position` is computed from it.
        let uses = if self.context.answer.task.is_per_vertex() || self.context.plan.passes_directions { 3 } else { 1 };
        let value = if whole_point.is_some() && self.coin("repeat xyz", 0.5) {
            value
        } else {
            let value = self.value(block, "world", "vec3", value, uses);
            point = Some(value.clone()).filter(|value| value.text == self.context.names.get("world"));
            value
        };
        if slip.is_some() {
            (point, whole_point) = (None, None);
        }
        let clip = self.clip_position(&whole, point, whole_point).at(Site::ClipPosition);
        let clip = self.value(block, "clip", "vec4", clip, if self.coin("clip variable", 0.1) { 2 } else { 0 });
        self.statement(block, format!("gl_Position = {};", clip.text));
        value
    }

    fn clip_position(&mut self, whole: &Expr, point: Option<Expr>, whole_point: Option<Expr>) -> Expr {
        let slip = self.slip(&[
            "matrix-order",
            "matrix-order-reversed",
            "model-matrix-missing",
            "view-matrix-missing",
            "projection-matrix-missing",
            "clip-without-translation",
            "clip-row-vector",
        ]);
        if let Some(slip) = slip {
            let [m, v, p] = [self.model(), self.view(), self.projection()];
            return match slip {
                "matrix-order" => p.mul(&m).mul(&v).mul(whole),
                "matrix-order-reversed" => m.mul(&v).mul(&p).mul(whole),
                "model-matrix-missing" => p.mul(&v).mul(whole),
                "view-matrix-missing" => p.mul(&m).mul(whole),
                "projection-matrix-missing" => v.mul(&m).mul(whole),
                "clip-row-vector" => whole.mul(&p).mul(&v).mul(&m),
                _ => {
                    let position = self.position_attribute();
                    p.mul(&v).mul(&m).mul(&self.vec4(&position, 0.0))
                }
            };
        }
        let there = whole_point.or_else(|| point.map(|point| self.vec4(&point, 1.0)));
        let there = there.filter(|_| self.coin("clip from position", 0.6));
        let eye = self.context.plan.space == Space::Eye;
        match (self.context.plan.matrices, there) {
            (Matrices::Whole, _) => self.matrix("MVP", Meaning::ModelViewProjection).mul(whole),
            (_, Some(there)) if eye => self.projection().mul(&there),
            (Matrices::Separate, Some(there)) => {
                if self.coin("grouping", 0.2) {
                    let inner = self.view().mul(&there);
                    Expr::atom(format!("{} * ({})", self.projection().text, inner.text))
                } else {
                    self.projection().mul(&self.view()).mul(&there)
                }
            }
            (Matrices::ViewProjection, Some(there)) => self.matrix("VP", Meaning::ViewProjection).mul(&there),
            (Matrices::ViewProjection, None) => {
                self.matrix("VP", Meaning::ViewProjection).mul(&self.model()).mul(whole)
            }
            (Matrices::ModelView, _) => self.projection().mul(&self.model_view()).mul(whole),
            (Matrices::Separate, None) => self.projection().mul(&self.view()).mul(&self.model()).mul(whole),
        }
    }

    /// The transformed normal, of any length.
    pub fn transformed_normal(&mut self) -> Expr {
        let normal = self.attribute("normal", "vec3", Meaning::Normal);
        let slip = self.slip(&[
            "normal-by-model-matrix",
            "normal-by-model-view",
            "normal-by-whole-matrix",
            "normal-not-transformed",
            "normal-translated",
            "normal-is-position",
            "normal-reversed",
            "normal-in-world-space",
        ]);
        match slip {
            Some("normal-by-model-matrix") => {
                let matrix = self.space_matrix();
                self.turned(&matrix, &normal)
            }
            Some("normal-by-model-view") => {
                let matrix = self.model_view();
                self.turned(&matrix, &normal)
            }
            Some("normal-by-whole-matrix") => {
                let matrix = self.projection().mul(&self.view()).mul(&self.model());
                self.turned(&matrix, &normal)
            }
            Some("normal-not-transformed") => normal,
            Some("normal-translated") => {
                let product = self.space_matrix().mul(&self.vec4(&normal, 1.0));
                self.xyz(&product, "xyz of a direction")
            }
            Some("normal-is-position") => {
                let position = self.position_attribute();
                self.right_normal(&position)
            }
            Some("normal-in-world-space") => self.normal_in_world(&normal),
            Some(_) => {
                let right = self.right_normal(&normal);
                right.neg()
            }
            None => self.right_normal(&normal),
        }
        .at(Site::NormalTransform)
    }

    fn normal_in_world(&mut self, normal: &Expr) -> Expr {
        let matrix = self.uniform("itM", "mat4", Meaning::InverseTranspose);
        self.turned(&matrix, normal)
    }

    fn right_normal(&mut self, normal: &Expr) -> Expr {
        let eye = self.context.plan.space == Space::Eye;
        match self.context.plan.normal_by {
            NormalBy::Mat3Uniform => {
                let meaning = if eye { Meaning::NormalMatrixInEye } else { Meaning::NormalMatrix };
                self.uniform("normal_matrix", "mat3", meaning).mul(normal)
            }
            NormalBy::Computed => {
                let matrix = self.space_matrix();
                let forms: [&dyn Fn(&Expr) -> Expr; 2] =
                    [&|m| Expr::call("mat3", &[&Expr::call("transpose", &[&Expr::call("inverse", &[m])])]), &|m| {
                        Expr::call("transpose", &[&Expr::call("inverse", &[&Expr::call("mat3", &[m])])])
                    }];
                forms[self.choice("inverse transpose", 2)](&matrix).mul(normal)
            }
            NormalBy::RowTimesInverse => {
                let matrix = self.space_matrix();
                normal.mul(&Expr::call("inverse", &[&Expr::call("mat3", &[&matrix])]))
            }
            by => {
                let matrix = self.uniform("itM", "mat4", Meaning::InverseTranspose);
                let world = match by {
                    NormalBy::Mat3OfUniform => Expr::call("mat3", &[&matrix]).mul(normal),
                    NormalBy::Vec4WithOne => {
                        let product = matrix.mul(&self.vec4(normal, 1.0));
                        self.xyz(&product, "xyz of a normal")
                    }
                    _ => {
                        let product = matrix.mul(&self.vec4(normal, 0.0));
                        self.xyz(&product, "xyz of a normal")
                    }
                };
                if eye {
                    // The fourth component of itM times a direction is not 0: V must not meet it.
                    let view = self.view();
                    let inner = Expr::atom(format!("({})", world.text));
                    if self.coin("mat3 of V", 0.6) {
                        Expr::call("mat3", &[&view]).mul(&inner)
                    } else {
                        let product = view.mul(&self.vec4(&world, 0.0));
                        self.xyz(&product, "xyz of a normal in eye space")
                    }
                } else {
                    world
                }
            }
        }
    }

    /// The normal in the vertex shader, made a unit vector if the answer does so.
    pub fn vertex_normal(&mut self, block: &mut Block) -> Expr {
        let normal = self.transformed_normal();
        if !self.context.answer.unit_in_vertex || self.slips("normal-not-normalised-in-vertex") {
            let normal = normal.at(Site::Normal);
            return if self.context.answer.task.is_per_vertex() {
                self.value(block, "N", "vec3", normal, 2)
            } else {
                normal
            };
        }
        let unit = Expr::call("normalize", &[&normal]).at(Site::Normal);
        let uses = if self.context.answer.task.is_per_vertex() { 2 } else { 1 };
        self.value(block, "N", "vec3", unit, uses)
    }

    /// The unit normal in the fragment shader.
    pub fn fragment_normal(&mut self, block: &mut Block) -> Expr {
        let passed = self.varying("v_normal", "vec3");
        if self.slips("normal-not-renormalised") {
            let passed = passed.at(Site::Normal);
            return if self.coin("copy of the normal", 0.5) {
                self.variable(block, "N", "vec3", &passed)
            } else {
                passed
            };
        }
        let unit = Expr::call("normalize", &[&passed]).at(Site::Normal);
        self.variable(block, "N", "vec3", &unit)
    }
}
