//! Texture functions.

use super::Machine;
use crate::code::{Detail, Reg, TextureCall, TextureOperation};
use crate::lanes::LaneSet;
use crate::math::{f, i};
use crate::texture::{TextureDetail, TextureLookup};
use gonio_glsl::Scalar;

impl Machine<'_> {
    pub(super) fn texture(&mut self, call: &TextureCall) {
        let active = self.control.active();
        let mut written = self.registers.written(call.sampler);
        for at in 0..u32::from(call.dims) {
            written = written.and(self.registers.written(call.coordinates + at));
        }
        if matches!(call.operation, TextureOperation::Size | TextureOperation::Levels) {
            written = LaneSet::FULL;
        }
        let mut results = vec![[0_u32; 4]; crate::lanes::LANES];
        for lane in active.iter() {
            results[lane] = self.result(call, lane);
        }
        for component in 0..u32::from(call.n) {
            self.registers.set_each(call.dst + component, written, |lane| results[lane][component as usize]);
        }
    }

    fn at(&self, reg: Reg, lane: usize) -> u32 {
        self.registers.operand(reg).at(lane)
    }

    fn result(&self, call: &TextureCall, lane: usize) -> [u32; 4] {
        let sampler = self.at(call.sampler, lane);
        match call.operation {
            TextureOperation::Size => {
                let level = match call.detail {
                    Detail::Explicit(reg) => i(self.at(reg, lane)),
                    _ => 0,
                };
                let [w, h, d] = self.options.textures.size(sampler, level);
                [w, h, d, 0]
            }
            TextureOperation::Levels => [self.options.textures.levels(sampler), 0, 0, 0],
            TextureOperation::QueryLod => [0; 4],
            _ => {
                let lookup = self.lookup(call, sampler, lane);
                let found = self.options.textures.look_up(&lookup);
                match call.to {
                    Scalar::Int => found.map(|x| x as i32 as u32),
                    Scalar::UInt => found.map(|x| x as u32),
                    _ => found.map(f32::to_bits),
                }
            }
        }
    }

    fn lookup(&self, call: &TextureCall, sampler: u32, lane: usize) -> TextureLookup {
        let is_fetch = call.operation == TextureOperation::Fetch;
        let dims = usize::from(call.dims);
        let coordinate = |at: usize, lane: usize| -> f32 {
            let bits = self.at(call.coordinates + at as u32, lane);
            let value = if is_fetch { i(bits) as f32 } else { f(bits) };
            match call.divisor {
                Some(divisor) => value / f(self.at(divisor, lane)),
                None => value,
            }
        };
        let mut coordinates = [0.0; 4];
        for (at, value) in coordinates.iter_mut().enumerate().take(dims) {
            *value = coordinate(at, lane);
        }
        let difference = |far: usize, near: usize| -> [f32; 3] {
            std::array::from_fn(|at| if at < dims { coordinate(at, far) - coordinate(at, near) } else { 0.0 })
        };
        let vector = |reg: Reg, n: u8| -> [f32; 3] {
            std::array::from_fn(|at| if at < usize::from(n) { f(self.at(reg + at as u32, lane)) } else { 0.0 })
        };
        let detail = match call.detail {
            Detail::Explicit(reg) if is_fetch => TextureDetail::Level(i(self.at(reg, lane)) as f32),
            Detail::Explicit(reg) => TextureDetail::Level(f(self.at(reg, lane))),
            Detail::Gradient { dx, dy, n } => {
                TextureDetail::Implicit { dx: vector(dx, n), dy: vector(dy, n), bias: 0.0 }
            }
            Detail::Implicit(bias) if self.options.quads => TextureDetail::Implicit {
                dx: difference(lane | 1, lane & !1),
                dy: difference(lane | 2, lane & !2),
                bias: bias.map_or(0.0, |reg| f(self.at(reg, lane))),
            },
            Detail::Implicit(_) => TextureDetail::Base,
        };
        let mut offset = [0; 3];
        if let Some((reg, n)) = call.offset {
            for (at, value) in offset.iter_mut().enumerate().take(usize::from(n)) {
                *value = i(self.at(reg + at as u32, lane));
            }
        }
        let compare = call.compare.map(|reg| {
            let depth = f(self.at(reg, lane));
            call.divisor.map_or(depth, |divisor| depth / f(self.at(divisor, lane)))
        });
        let gather = (call.operation == TextureOperation::Gather)
            .then(|| call.component.map_or(0, |reg| self.at(reg, lane).min(3) as u8));
        TextureLookup {
            point: self.start + lane,
            sampler,
            dims: call.dims,
            coordinates,
            detail,
            offset,
            compare,
            is_fetch,
            gather,
        }
    }
}
