//! Executes the instructions of a shader on one block of points.

mod arithmetic;
mod control;
mod lookup;
mod registers;
mod watch;

pub use registers::prepare_thread;

use crate::code::{CompiledStage, Instr, One, Reg, Three, Two, Whole};
use crate::lanes::{LANES, LaneSet};
use crate::run::{Anomalies, AnomalyKind, EndedEarly, PointValues, RunOptions, StageInputs};
use crate::source::{ExprId, StatementId};
use control::Control;
pub(crate) use registers::Row;
use registers::{Operand, Registers};
pub(crate) use watch::{Seen, Write};

/// The state of a block.
pub(crate) struct Machine<'a> {
    stage: &'a CompiledStage,
    inputs: &'a StageInputs,
    pub(crate) options: &'a RunOptions<'a>,
    pub(crate) registers: Registers,
    pub(crate) control: Control,
    /// All ones for active lanes, for the set of lanes beside it.
    ones: Box<Row>,
    ones_of: LaneSet,
    valid: LaneSet,
    /// The first point of the block.
    start: usize,
    pub(crate) anomalies: Anomalies,
    pub(crate) seen: Seen,
    statement: Option<StatementId>,
    /// Executed instructions, weighted by their time.
    pub(crate) work: u64,
    /// Statements that active points have executed.
    pub(crate) statements: u64,
}

impl<'a> Machine<'a> {
    pub fn new(stage: &'a CompiledStage, inputs: &'a StageInputs, options: &'a RunOptions<'a>) -> Self {
        Self {
            stage,
            inputs,
            options,
            registers: Registers::new(stage.registers),
            control: Control::new(LaneSet::EMPTY),
            ones: Box::new([0; LANES]),
            ones_of: LaneSet::EMPTY,
            valid: LaneSet::EMPTY,
            start: 0,
            anomalies: Anomalies::default(),
            seen: Seen::new(stage, options),
            statement: None,
            work: 0,
            statements: 0,
        }
    }

    /// Runs the shader for `count` points from `start` on.
    pub fn block(&mut self, start: usize, count: usize) -> Result<(), EndedEarly> {
        self.valid = LaneSet::first(count);
        self.start = start;
        self.control = Control::new(self.valid);
        self.seen.start_block(start);
        self.registers.confine(self.valid);
        let stage = self.stage;
        let mut at = 0_usize;
        while let Some(instr) = stage.code.get(at) {
            let place = stage.places.get(at).copied().flatten();
            at += 1;
            match *instr {
                Instr::If { condition, otherwise } => {
                    let condition = self.registers.truth(condition);
                    if !self.control.branch(condition) {
                        at = otherwise as usize;
                    }
                }
                Instr::Else { end } => {
                    if !self.control.otherwise() {
                        at = end as usize;
                    }
                }
                Instr::Test { condition, end } => {
                    let condition = self.registers.truth(condition);
                    if !self.control.test(condition) {
                        at = end as usize;
                    }
                }
                Instr::Repeat { start } => {
                    self.work += 4;
                    if self.work > self.options.most_work {
                        return Err(EndedEarly { statement: self.statement, point: self.any_point() });
                    }
                    if !self.control.active().is_empty() {
                        at = start as usize;
                    }
                }
                Instr::EndIf | Instr::EndLoop | Instr::EndSwitch | Instr::Leave => self.control.end(),
                Instr::Loop => self.control.start_loop(),
                Instr::Next => self.control.next_iteration(),
                Instr::Switch => self.control.start_switch(),
                Instr::Case { condition } => {
                    let condition = self.registers.truth(condition);
                    self.control.case(condition);
                }
                Instr::Break => self.control.end_loop(),
                Instr::Continue => self.control.continue_loop(),
                Instr::Enter { frame } => self.control.enter(frame),
                Instr::Return => self.control.return_from_call(),
                Instr::Discard { ends } => self.control.discard(ends),
                Instr::Statement { id } => {
                    self.statement = Some(id);
                    let visible = self.control.visible();
                    self.statements += visible.count() as u64;
                    self.seen.statement(id, visible, &self.control);
                    continue;
                }
                Instr::Mark { expr, reg, n } => {
                    if self.seen.is_watching() {
                        self.mark(expr, reg, n);
                    }
                    continue;
                }
                Instr::Wrote { variable } => {
                    if self.seen.is_tracing()
                        && let Some(traced) = stage.variables.get(variable as usize)
                    {
                        let write = Write { variable, expr: place, reg: traced.reg, size: traced.size };
                        let visible = self.control.visible();
                        self.seen.wrote(write, visible, &self.control, &self.registers);
                    }
                    continue;
                }
                _ => {
                    self.data(instr, place);
                    continue;
                }
            }
            self.registers.confine(self.control.active());
        }
        if self.work > self.options.most_work {
            return Err(EndedEarly { statement: self.statement, point: self.any_point() });
        }
        Ok(())
    }

    fn any_point(&self) -> usize {
        self.start + self.control.visible().lowest().unwrap_or(0)
    }

    /// Executes an instruction that computes.
    #[inline(always)]
    fn data(&mut self, instr: &Instr, place: Option<ExprId>) {
        match *instr {
            Instr::Constant { dst, bits } => self.registers.set(dst, bits, LaneSet::FULL),
            Instr::Copy { dst, src, n } => {
                self.work += u64::from(n);
                for at in 0..n {
                    self.registers.copy(dst + at, src + at);
                }
            }
            Instr::Load { dst, src, n } => {
                self.work += u64::from(n);
                for at in 0..n {
                    self.registers.copy(dst + at, src + at);
                }
                self.check_written(src, n, place);
            }
            Instr::Store { dst, src, n } => {
                self.work += u64::from(n);
                self.store(dst, src, n);
            }
            Instr::Forget { dst, n } => {
                for at in 0..n {
                    self.registers.set(dst + at, 0, LaneSet::EMPTY);
                }
            }
            Instr::One { op, dst, a, n } => {
                self.work += u64::from(n) * if is_slow(op) { 16 } else { 1 };
                for at in 0..n {
                    self.registers.apply_one(op, dst + at, a + at);
                }
            }
            Instr::Two { op, dst, a, b, n, steps } => {
                self.work += u64::from(n) * if matches!(op, Two::Pow | Two::Atan2) { 24 } else { 1 };
                let [step_a, step_b] = steps.map(u32::from);
                for at in 0..n {
                    self.registers.apply_two(op, dst + at, a + at * step_a, b + at * step_b);
                }
            }
            Instr::Three { op, dst, a, b, c, n, steps } => {
                self.work += 2 * u64::from(n);
                let [step_a, step_b, step_c] = steps.map(u32::from);
                for at in 0..n {
                    let regs = [a + at * step_a, b + at * step_b, c + at * step_c];
                    self.registers.apply_three(op, dst + at, regs);
                }
            }
            Instr::Dot { dst, a, b, n, steps } => {
                self.work += u64::from(n);
                self.registers.dot(dst, a, b, u32::from(n), steps.map(u32::from));
            }
            Instr::Reduce { dst, a, n, all } => {
                self.work += u64::from(n);
                self.registers.reduce(dst, a, n, all);
            }
            Instr::Derivative { dst, a, n, along } => {
                self.work += 4 * u64::from(n);
                for at in 0..n {
                    match self.options.quads {
                        true => self.registers.derivative(dst + at, a + at, along),
                        false => self.registers.set(dst + at, 0, LaneSet::EMPTY),
                    }
                }
            }
            Instr::Whole { .. } | Instr::Offset { .. } | Instr::Gather { .. } | Instr::Scatter { .. } => {
                self.lane_by_lane(instr, place);
            }
            Instr::Texture { index } => {
                if let Some(call) = self.stage.textures.get(index as usize) {
                    self.work += 256;
                    self.texture(&call.clone());
                }
            }
            Instr::Input { index } => self.input(index),
            _ => {}
        }
        if self.options.find_non_finite {
            self.find_non_finite(instr, place);
        }
    }

    fn refresh_ones(&mut self, mask: LaneSet) {
        if self.ones_of != mask {
            mask.spread(&mut self.ones);
            self.ones_of = mask;
        }
    }

    fn store(&mut self, dst: Reg, src: Reg, n: u32) {
        let active = self.control.active();
        if active.covers(self.valid) {
            for at in 0..n {
                self.registers.copy(dst + at, src + at);
            }
        } else if !active.is_empty() {
            self.refresh_ones(active);
            for at in 0..n {
                self.registers.store(dst + at, src + at, active, &self.ones);
            }
        }
    }

    fn note(&mut self, kind: AnomalyKind, place: Option<ExprId>, lanes: LaneSet) {
        if let (Some(place), Some(lane)) = (place, lanes.lowest()) {
            self.anomalies.add(kind, place, self.start + lane, lanes.count());
        }
    }

    /// Notes active points that read what was never written.
    fn check_written(&mut self, reg: Reg, n: u32, place: Option<ExprId>) {
        let visible = self.control.visible();
        let written = (0..n).fold(LaneSet::FULL, |written, at| written.and(self.registers.written(reg + at)));
        if !written.covers(visible) {
            self.note(AnomalyKind::ReadBeforeWritten, place, visible.without(written));
        }
    }

    fn lane_by_lane(&mut self, instr: &Instr, place: Option<ExprId>) {
        match *instr {
            Instr::Whole { op, dst, to, a, n } => {
                self.work += 32;
                let written = (0..u32::from(n)).fold(LaneSet::FULL, |w, at| w.and(self.registers.written(a + at)));
                let mut input = [0_u32; 16];
                let operands = (0..u32::from(n)).map(|at| self.registers.operand(a + at));
                // A matrix is mostly that of all points.
                if operands.clone().all(|operand| matches!(operand, Operand::Same(_))) {
                    input.iter_mut().zip(operands).for_each(|(bits, operand)| *bits = operand.at(0));
                    let result = arithmetic::apply_whole(op, &input[..usize::from(n).min(16)]);
                    for at in 0..u32::from(to) {
                        self.registers.set(dst + at, result[at as usize], written);
                    }
                    return;
                }
                let mut results = vec![[0_u32; 16]; LANES];
                for lane in self.control.active().iter() {
                    for (at, bits) in input.iter_mut().enumerate().take(usize::from(n)) {
                        *bits = self.registers.operand(a + at as u32).at(lane);
                    }
                    results[lane] = arithmetic::apply_whole(op, &input[..usize::from(n).min(16)]);
                }
                for at in 0..u32::from(to) {
                    self.registers.set_each(dst + at, written, |lane| results[lane][at as usize]);
                }
            }
            Instr::Offset { dst, before, index, is_signed, stride, count } => {
                self.work += 2;
                let inside = |bits: u32| bits < count && (!is_signed || bits as i32 >= 0);
                let moved = |before: u32, bits: u32| match inside(bits) && before != u32::MAX {
                    true => before + bits * stride,
                    false => u32::MAX,
                };
                let visible = self.control.visible();
                let operand = self.registers.operand(index);
                let outside = LaneSet::filter(|lane| visible.contains(lane) && !inside(operand.at(lane)));
                self.note(AnomalyKind::IndexOutOfRange, place, outside);
                match before {
                    None => self.registers.one(dst, index, |bits| moved(0, bits)),
                    Some(before) => self.registers.two(dst, before, index, moved),
                }
            }
            Instr::Gather { dst, base, offset, total, n } => self.gather(dst, base, (offset, total), n, place),
            Instr::Scatter { base, offset, src, total, n } => self.scatter(base, (offset, total), src, n),
            _ => {}
        }
    }

    /// Reads elements chosen at run time; outside of an array they are 0.
    fn gather(&mut self, dst: Reg, base: Reg, (offset, total): (Reg, u32), n: u32, place: Option<ExprId>) {
        if let Operand::Same(at) = self.registers.operand(offset) {
            self.work += u64::from(n);
            let is_inside = at.checked_add(n).is_some_and(|end| end <= total);
            for component in 0..n {
                match is_inside {
                    true => self.registers.copy(dst + component, base + at + component),
                    false => self.registers.set(dst + component, 0, LaneSet::FULL),
                }
            }
            if is_inside && n <= 16 {
                self.check_written(base + at, n, place);
            }
            return;
        }
        self.work += 8 * u64::from(n);
        let visible = self.control.visible();
        let mut values = vec![0_u32; LANES];
        let mut unwritten = LaneSet::EMPTY;
        for component in 0..n {
            let mut written = LaneSet::FULL;
            {
                let offsets = self.registers.operand(offset);
                for (lane, value) in values.iter_mut().enumerate() {
                    let at = offsets.at(lane).checked_add(component).filter(|at| *at < total);
                    *value = at.map_or(0, |at| self.registers.operand(base + at).at(lane));
                }
                written = LaneSet::filter(|lane| {
                    let at = offsets.at(lane).checked_add(component).filter(|at| *at < total);
                    at.is_none_or(|at| self.registers.written(base + at).contains(lane))
                })
                .and(written);
            }
            unwritten = unwritten.or(visible.without(written));
            self.registers.set_each(dst + component, written, |lane| values[lane]);
        }
        if n <= 16 {
            self.note(AnomalyKind::ReadBeforeWritten, place, unwritten);
        }
    }

    /// Writes elements chosen at run time; outside of an array nothing is written.
    fn scatter(&mut self, base: Reg, (offset, total): (Reg, u32), src: Reg, n: u32) {
        if let Operand::Same(at) = self.registers.operand(offset) {
            self.work += u64::from(n);
            if at.checked_add(n).is_some_and(|end| end <= total) {
                self.store(base + at, src, n);
            }
            return;
        }
        self.work += 8 * u64::from(n);
        let active = self.control.active();
        let offsets: Vec<(usize, u32)> = {
            let offsets = self.registers.operand(offset);
            active.iter().map(|lane| (lane, offsets.at(lane))).collect()
        };
        let mut places: Vec<u32> = offsets.iter().map(|(_, at)| *at).collect();
        places.sort_unstable();
        places.dedup();
        for at in places {
            if at.checked_add(n).is_none_or(|end| end > total) {
                continue;
            }
            let mut lanes = [false; LANES];
            offsets.iter().filter(|(_, other)| *other == at).for_each(|(lane, _)| lanes[*lane] = true);
            let mask = LaneSet::filter(|lane| lanes[lane]);
            self.refresh_ones(mask);
            for component in 0..n {
                self.registers.store(base + at + component, src + component, mask, &self.ones);
            }
        }
    }

    /// Takes the values of an input.
    fn input(&mut self, index: u32) {
        let Some(input) = self.stage.inputs.get(index as usize) else { return };
        let block = self.start / LANES;
        let Some(values) = self.inputs.values(index as usize) else {
            if input.has_default {
                return;
            }
            if input.name == "gl_VertexID" {
                let start = self.start;
                return self.registers.set_each(input.reg, LaneSet::FULL, |lane| (start + lane) as u32);
            }
            let is_uniform = input.rate == crate::code::InputRate::Uniform;
            for at in 0..input.size {
                // OpenGL's defaults: 0 for uniforms, (0, 0, 0, 1) for attributes. The latter count as unwritten.
                let is_last = !is_uniform && at == 3 && input.count == 1;
                let bits = if is_last { 1.0_f32.to_bits() } else { 0 };
                self.registers.set(input.reg + at, bits, if is_uniform { LaneSet::FULL } else { LaneSet::EMPTY });
            }
            return;
        };
        let is_attribute = input.rate == crate::code::InputRate::PerPoint && input.count == 1;
        // What OpenGL fills in where an attribute has fewer components is (0, 0, 0, 1).
        let default = |at: u32| if is_attribute && at == 3 { 1.0_f32.to_bits() } else { 0 };
        for at in 0..input.size {
            let dst = input.reg + at;
            match values {
                PointValues::Same(components) => match components.get(at as usize) {
                    Some(bits) => self.registers.set(dst, *bits, LaneSet::FULL),
                    None => self.registers.set(dst, default(at), LaneSet::FULL),
                },
                PointValues::Each { components, written } => {
                    let written =
                        written.as_ref().map_or(LaneSet::FULL, |sets| sets.get(block).copied().unwrap_or_default());
                    match components.get(at as usize).and_then(|all| all.get(self.start..)) {
                        Some(values) => self.registers.set_slice(dst, written, values),
                        None => self.registers.set(dst, default(at), written),
                    }
                }
            }
        }
    }
}

fn is_slow(op: One) -> bool {
    use One::*;
    matches!(
        op,
        Exp | Exp2 | Log | Log2 | Sin | Cos | Tan | Asin | Acos | Atan | Sinh | Cosh | Tanh | Asinh | Acosh | Atanh
    )
}

/// The result of an instruction that is a float, and its float operands: first register and length, 0 where there is none.
pub(crate) type FloatOperation = (Reg, u32, [(Reg, u32); 3]);

/// Returns the result and operands of an instruction that may be the first to compute an infinity or NaN.
pub(crate) fn float_operation(instr: &Instr, stage: &CompiledStage) -> Option<FloatOperation> {
    use One::*;
    const NONE: (Reg, u32) = (0, 0);
    Some(match *instr {
        Instr::One {
            op:
                Sqrt | InverseSqrt | Exp | Exp2 | Log | Log2 | Sin | Cos | Tan | Asin | Acos | Atan | Sinh | Cosh | Tanh
                | Asinh | Acosh | Atanh | Fract | Radians | Degrees,
            dst,
            a,
            n,
        } => (dst, n, [(a, n), NONE, NONE]),
        Instr::Two {
            op: Two::FAdd | Two::FSub | Two::FMul | Two::FDiv | Two::FMod | Two::Pow | Two::Atan2 | Two::Ldexp,
            dst,
            a,
            b,
            n,
            steps,
        } => {
            let count = |step: u8| if step == 0 { 1 } else { n };
            (dst, n, [(a, count(steps[0])), (b, count(steps[1])), NONE])
        }
        Instr::Three { op: Three::Mix | Three::Smoothstep | Three::Fma, dst, a, b, c, n, steps } => {
            let count = |step: u8| if step == 0 { 1 } else { n };
            (dst, n, [(a, count(steps[0])), (b, count(steps[1])), (c, count(steps[2]))])
        }
        Instr::Dot { dst, a, b, n, steps } => {
            let reach = |step: u8| u32::from(n.saturating_sub(1)) * u32::from(step) + 1;
            (dst, 1, [(a, reach(steps[0])), (b, reach(steps[1])), NONE])
        }
        Instr::Whole { op: Whole::Determinant(_) | Whole::Inverse(_) | Whole::Refract(_), dst, to, a, n } => {
            (dst, u32::from(to), [(a, u32::from(n)), NONE, NONE])
        }
        Instr::Derivative { dst, a, n, .. } => (dst, n, [(a, n), NONE, NONE]),
        Instr::Texture { index } => {
            let call = stage.textures.get(index as usize)?;
            (call.dst, u32::from(call.n), [(call.coordinates, u32::from(call.dims)), NONE, NONE])
        }
        _ => return None,
    })
}
