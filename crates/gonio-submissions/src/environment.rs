//! Writes skyboxes, mirrors and glass: exercises 08 to 10.

use crate::expression::{Expr, Site};
use crate::plan::GeneratedTask;
use crate::scenes::{LAB_INDEX, Meaning};
use crate::writer::{Block, Writer};

/// Writes both stages.
pub(crate) fn write(vertex: &mut Writer<'_>, fragment: &mut Writer<'_>) -> (Block, Block) {
    let (mut first, mut second) = (Block::default(), Block::default());
    let direction = if vertex.context.answer.task == GeneratedTask::Skybox {
        vertex.sky(&mut first);
        fragment.varying("v_direction", "vec3")
    } else {
        let position = vertex.place(&mut first);
        let normal = vertex.vertex_normal(&mut first);
        for (key, value) in [("v_position", position), ("v_normal", normal)] {
            let out = vertex.varying(key, "vec3");
            vertex.statement(&mut first, format!("{} = {};", out.text, value.text));
        }
        fragment.bent(&mut second)
    };
    let direction = fragment.looked_up(&direction);
    let cubemap = fragment.uniform("cubemap", "samplerCube", Meaning::Cubemap);
    let function = if fragment.version().has_in_and_out() { "texture" } else { "textureCube" };
    let found = Expr::call(function, &[&cubemap, &direction]).field("rgb");
    let found = fragment.value(&mut second, "found", "vec3", found, 1);
    fragment.output(&mut second, &found);
    (first, second)
}

impl Writer<'_> {
    fn sky(&mut self, block: &mut Block) {
        let position = self.position_attribute();
        let (view, projection) = (self.view(), self.projection());
        let slip = self.slip(&["direction-reversed", "direction-turned-by-view", "direction-projected"]);
        let direction = match slip {
            None => position.clone(),
            Some("direction-reversed") => position.neg(),
            Some("direction-turned-by-view") => view.mul(&self.vec4(&position, 0.0)).field("xyz"),
            Some(_) => projection.mul(&view).mul(&self.vec4(&position, 1.0)).field("xyz"),
        };
        let out = self.varying("v_direction", "vec3");
        self.statement(block, format!("{} = {};", out.text, direction.at(Site::Direction).text));
        let kept = self.slips("skybox-keeps-translation");
        let fixed = self.slips("skybox-not-turned");
        let mat3 = self.version().has_mat3_of_mat4();
        let whole = self.vec4(&position, 1.0);
        let place = match self.choice("view without translation", 4) {
            0 | 1 if mat3 => {
                let turn = match (kept, fixed) {
                    (true, _) => view,
                    (_, true) => Expr::call("mat4", &[&self.number(1.0)]),
                    _ => Expr::call("mat4", &[&Expr::call("mat3", &[&view])]),
                };
                let turn = self.value(block, "turn", "mat4", turn.at(Site::Turn), 1);
                projection.mul(&turn).mul(&whole)
            }
            2 if !fixed => {
                let turn = self.variable(block, "turn", "mat4", &view.at(Site::Turn));
                if !kept {
                    let last = Expr::atom("vec4(0.0, 0.0, 0.0, 1.0)").at(Site::Turn);
                    self.statement(block, format!("{}[3] = {};", turn.text, last.text));
                }
                projection.mul(&turn).mul(&whole)
            }
            _ => {
                let product = match (kept, fixed) {
                    (true, _) => view.mul(&self.vec4(&position, 1.0)).field("xyz"),
                    (_, true) => position.clone(),
                    _ => view.mul(&self.vec4(&position, 0.0)).field("xyz"),
                };
                projection.mul(&self.vec4(&product.at(Site::Turn), 1.0))
            }
        };
        let clip = self.variable(block, "clip", "vec4", &place);
        let deep = if self.coin("depth", 0.85) { clip.field("xyww") } else { clip };
        self.statement(block, format!("gl_Position = {};", deep.text));
    }

    /// The reflected or refracted direction.
    fn bent(&mut self, block: &mut Block) -> Expr {
        let normal = self.fragment_normal(block);
        let position = self.varying("v_position", "vec3");
        let eye = self.uniform("view_pos", "vec3", Meaning::ViewPosition);
        let slip = self.slip(&[
            "view-position-at-origin",
            "view-position-as-direction",
            "view-direction-not-normalised",
            "view-plus-position",
        ]);
        // Towards the surface, or the negative of the direction towards the eye.
        let towards = self.context.plan.from_light || self.coin("incident", 0.5);
        let (from, to) = match slip {
            Some("view-position-at-origin") => (position.clone(), position.neg()),
            Some("view-position-as-direction") => (eye.neg(), eye.clone()),
            Some("view-plus-position") => (position.add(&eye).neg(), position.add(&eye)),
            _ => (position.sub(&eye), eye.sub(&position)),
        };
        let vector = if towards { from } else { to };
        let unit =
            if slip == Some("view-direction-not-normalised") { vector } else { Expr::call("normalize", &[&vector]) };
        let key = if towards { "I" } else { "eye_dir" };
        let name = self.variable(block, key, "vec3", &unit.at(Site::ViewDirection));
        let (incident, view) = if towards { (name.clone(), name.neg()) } else { (name.neg(), name.clone()) };
        let swapped = self.slip(&["reflection-by-normal", "reflection-by-position", "reflection-by-view"]);
        let value = match swapped {
            Some("reflection-by-normal") => normal.clone(),
            Some("reflection-by-position") => position,
            Some(_) => incident,
            None if self.context.answer.task == GeneratedTask::Reflection => self.reflected(&incident, &view, &normal),
            None => self.refracted(block, &incident, &view, &normal),
        };
        self.value(block, "R", "vec3", value.at(Site::Mirror), 1)
    }

    fn reflected(&mut self, incident: &Expr, view: &Expr, normal: &Expr) -> Expr {
        let two = self.number(2.0);
        let cosine = Expr::call("dot", &[normal, view]);
        let slip = self.slip(&[
            "reflection-vector-reversed",
            "refraction-instead-of-reflection",
            "formula-without-2",
            "reflection-arguments-swapped",
        ]);
        match slip {
            Some("reflection-vector-reversed") => Expr::call("reflect", &[view, normal]),
            Some("refraction-instead-of-reflection") => {
                Expr::call("refract", &[incident, normal, &self.number(1.0).div(&self.number(LAB_INDEX))])
            }
            Some("formula-without-2") => cosine.mul(normal).sub(view),
            Some(_) => Expr::call("reflect", &[normal, incident]),
            None if self.context.plan.formula => two.mul(&cosine).mul(normal).sub(view),
            None => Expr::call("reflect", &[incident, normal]),
        }
    }

    fn refracted(&mut self, block: &mut Block, incident: &Expr, view: &Expr, normal: &Expr) -> Expr {
        let index = if self.context.answer.writes.index {
            self.number(LAB_INDEX)
        } else {
            self.uniform("index", "float", Meaning::Index)
        };
        let one = self.number(1.0);
        let ratio =
            match self.slip(&["refraction-ratio-inverted", "refraction-ratio-missing", "refraction-ratio-squared"]) {
                None => one.div(&index),
                Some("refraction-ratio-inverted") => index,
                Some("refraction-ratio-missing") => one.clone(),
                Some(_) => one.div(&index.mul(&index)),
            };
        let formula = self.context.plan.formula;
        let uses = if formula { 4 } else { 1 };
        let ratio = self.value(block, "ratio", "float", ratio.at(Site::Ratio), uses);
        match self.slip(&["refraction-view-reversed", "reflection-instead-of-refraction", "refract-swapped"]) {
            Some("refraction-view-reversed") => return Expr::call("refract", &[view, normal, &ratio]),
            Some("reflection-instead-of-refraction") => return Expr::call("reflect", &[incident, normal]),
            Some(_) => return Expr::call("refract", &[normal, incident, &ratio]),
            None => {}
        }
        if !formula {
            return Expr::call("refract", &[incident, normal, &ratio]);
        }
        let cosine = Expr::call("dot", &[normal, view]);
        let cosine = self.variable(block, "cosine", "float", &cosine);
        let radicand = one.sub(&ratio.mul(&ratio).mul(&one.sub(&cosine.mul(&cosine))));
        let root = Expr::call("sqrt", &[&radicand]);
        ratio.mul(&cosine).sub(&root).mul(normal).sub(&ratio.mul(view))
    }

    /// The direction of the lookup.
    fn looked_up(&mut self, direction: &Expr) -> Expr {
        let slip = self.slip(&["lookup-mirrored", "lookup-flipped", "lookup-depth-mirrored", "lookup-swizzled"]);
        let part = |name: &str| direction.field(name);
        let [x, y, z] = ["x", "y", "z"].map(part);
        match slip {
            None => direction.clone(),
            Some("lookup-mirrored") => Expr::call("vec3", &[&x.neg(), &y, &z]),
            Some("lookup-flipped") => Expr::call("vec3", &[&x, &y.neg(), &z]),
            Some("lookup-depth-mirrored") => Expr::call("vec3", &[&x, &y, &z.neg()]),
            Some(_) => direction.field("xzy"),
        }
        .at(Site::Lookup)
    }
}
