//! Registers: one scalar of every lane, or one for all lanes while they are the same; and the loops over lanes.

use crate::code::Reg;
use crate::lanes::{LANES, LaneSet};
use std::cell::RefCell;
use std::ops::Range;

/// A scalar of each lane, as bits.
pub(crate) type Row = [u32; LANES];

#[derive(Clone, Default)]
struct Slot {
    /// Allocated when lanes first differ.
    row: Option<Box<Row>>,
    is_uniform: bool,
    bits: u32,
    /// The lanes that were ever written, or computed from values that were.
    written: LaneSet,
}

/// The values of an operand.
#[derive(Clone, Copy)]
pub(crate) enum Operand<'a> {
    Same(u32),
    Each(&'a Row),
}

impl Operand<'_> {
    pub fn at(&self, lane: usize) -> u32 {
        match self {
            Self::Same(bits) => *bits,
            Self::Each(row) => row[lane],
        }
    }

    /// The values of the first `count` lanes.
    pub fn first(&self, count: usize) -> Vec<u32> {
        match self {
            Self::Same(bits) => vec![*bits; count],
            Self::Each(row) => row[..count.min(LANES)].to_vec(),
        }
    }

    /// Appends the values of the first `count` lanes.
    pub fn append_to(&self, all: &mut Vec<u32>, count: usize) {
        match self {
            Self::Same(bits) => all.resize(all.len() + count, *bits),
            Self::Each(row) => all.extend_from_slice(&row[..count.min(LANES)]),
        }
    }
}

/// All registers of a block.
pub(crate) struct Registers {
    slots: Vec<Slot>,
    /// Rows that are not used now.
    spare: Vec<Option<Box<Row>>>,
    /// The lanes that instructions compute: the active ones, and those between and around them. Elsewhere rows have old
    /// numbers.
    from: usize,
    to: usize,
}

/// The lanes that instructions compute begin and end at multiples of this, so that loops over lanes need no remainder and
/// quads are whole.
const STEP: usize = 16;

/// Most rows that a thread keeps for its next run.
const MOST_KEPT: usize = 2048;

thread_local! {
    /// Rows of earlier runs: a check runs a program hundreds of times, and spent a fifth of its time on their memory.
    static KEPT: RefCell<Vec<Option<Box<Row>>>> = const { RefCell::new(Vec::new()) };
}

/// Sets up what this thread keeps for its next run.
pub fn prepare_thread() {
    KEPT.with(|_| ());
}

/// A row of zeros, so that no run depends on earlier ones.
fn zeros() -> Box<Row> {
    match KEPT.with_borrow_mut(Vec::pop).flatten() {
        Some(mut row) => {
            row.fill(0);
            row
        }
        None => Box::new([0; LANES]),
    }
}

impl Drop for Registers {
    fn drop(&mut self) {
        let rows =
            self.slots.iter_mut().map(|slot| slot.row.take()).chain(self.spare.drain(..)).filter(Option::is_some);
        // At the end of a thread, there is nothing to keep them for.
        let _ = KEPT.try_with(|kept| {
            let mut kept = kept.borrow_mut();
            let room = MOST_KEPT.saturating_sub(kept.len());
            kept.extend(rows.take(room));
        });
    }
}

impl Registers {
    pub fn new(count: u32) -> Self {
        let slot = Slot { is_uniform: true, ..Slot::default() };
        Self { slots: vec![slot; count as usize], spare: Vec::new(), from: 0, to: LANES }
    }

    /// Lets instructions compute these lanes and no others, as far as [`STEP`] allows.
    #[inline]
    pub fn confine(&mut self, active: LaneSet) {
        (self.from, self.to) = match (active.lowest(), active.highest()) {
            (Some(first), Some(last)) => (first / STEP * STEP, (last + 1).next_multiple_of(STEP)),
            _ => (0, 0),
        };
    }

    #[inline(always)]
    fn lanes(&self) -> Range<usize> {
        self.from..self.to
    }

    fn take_row(&mut self) -> Box<Row> {
        self.spare.pop().flatten().unwrap_or_else(zeros)
    }

    fn put_row(&mut self, dst: Reg, row: Box<Row>, written: LaneSet) {
        let slot = &mut self.slots[dst as usize];
        slot.is_uniform = false;
        slot.written = written;
        if let Some(old) = slot.row.replace(row) {
            self.spare.push(Some(old));
        }
    }

    /// Sets the number that is the same in all lanes, or else the row; a row that is not used is kept.
    fn put(&mut self, dst: Reg, same: Option<u32>, row: Box<Row>, written: LaneSet) {
        match same {
            Some(bits) => {
                self.spare.push(Some(row));
                self.set(dst, bits, written);
            }
            None => self.put_row(dst, row, written),
        }
    }

    pub fn set(&mut self, dst: Reg, bits: u32, written: LaneSet) {
        let slot = &mut self.slots[dst as usize];
        (slot.is_uniform, slot.bits, slot.written) = (true, bits, written);
    }

    /// Sets each lane.
    pub fn set_each(&mut self, dst: Reg, written: LaneSet, value: impl Fn(usize) -> u32) {
        let mut row = self.take_row();
        for lane in self.lanes() {
            row[lane] = value(lane);
        }
        self.put_row(dst, row, written);
    }

    /// Sets the lanes from a slice; the last number is repeated.
    pub fn set_slice(&mut self, dst: Reg, written: LaneSet, values: &[u32]) {
        let mut row = self.take_row();
        let count = values.len().min(LANES);
        row[..count].copy_from_slice(&values[..count]);
        row[count..].fill(values.last().copied().unwrap_or(0));
        self.put_row(dst, row, written);
    }

    pub fn operand(&self, reg: Reg) -> Operand<'_> {
        let slot = &self.slots[reg as usize];
        match &slot.row {
            Some(row) if !slot.is_uniform => Operand::Each(row),
            _ => Operand::Same(slot.bits),
        }
    }

    pub fn written(&self, reg: Reg) -> LaneSet {
        self.slots[reg as usize].written
    }

    /// Returns the lanes where a boolean is true.
    pub fn truth(&self, reg: Reg) -> LaneSet {
        match self.operand(reg) {
            Operand::Same(0) => LaneSet::EMPTY,
            Operand::Same(_) => LaneSet::FULL,
            Operand::Each(row) => LaneSet::not_zero(row),
        }
    }

    pub fn copy(&mut self, dst: Reg, src: Reg) {
        let written = self.written(src);
        match self.operand(src) {
            Operand::Same(bits) => self.set(dst, bits, written),
            Operand::Each(_) if dst == src => {}
            Operand::Each(_) => {
                let mut row = self.take_row();
                if let Operand::Each(from) = self.operand(src) {
                    row[self.lanes()].copy_from_slice(&from[self.lanes()]);
                }
                self.put_row(dst, row, written);
            }
        }
    }

    /// Copies the lanes of a mask, given as a set and as a row of all ones or zeros.
    pub fn store(&mut self, dst: Reg, src: Reg, mask: LaneSet, ones: &Row) {
        if dst == src {
            return;
        }
        let written = self.written(dst).without(mask).or(self.written(src).and(mask));
        if let (Operand::Same(a), Operand::Same(b)) = (self.operand(dst), self.operand(src))
            && a == b
        {
            self.slots[dst as usize].written = written;
            return;
        }
        let lanes = self.lanes();
        let slot = &mut self.slots[dst as usize];
        // Other lanes keep their numbers.
        let mut row = match slot.row.take() {
            Some(row) if !slot.is_uniform => row,
            unused => {
                let bits = slot.bits;
                let mut row = unused.unwrap_or_else(|| self.take_row());
                row.fill(bits);
                row
            }
        };
        let all = row[lanes.clone()].iter_mut().zip(&ones[lanes.clone()]);
        match self.operand(src) {
            Operand::Each(src) => {
                for ((out, m), s) in all.zip(&src[lanes]) {
                    *out = (*out & !m) | (s & m);
                }
            }
            Operand::Same(s) => {
                for (out, m) in all {
                    *out = (*out & !m) | (s & m);
                }
            }
        }
        self.put_row(dst, row, written);
    }

    #[inline(always)]
    pub fn one(&mut self, dst: Reg, a: Reg, f: impl Fn(u32) -> u32 + Copy) {
        let written = self.written(a);
        if let Operand::Same(bits) = self.operand(a) {
            return self.set(dst, f(bits), written);
        }
        let mut row = self.take_row();
        let lanes = self.lanes();
        if let Operand::Each(a) = self.operand(a) {
            for (out, a) in row[lanes.clone()].iter_mut().zip(&a[lanes.clone()]) {
                *out = f(*a);
            }
        }
        self.put_row(dst, row, written);
    }

    #[inline(always)]
    pub fn two(&mut self, dst: Reg, a: Reg, b: Reg, f: impl Fn(u32, u32) -> u32 + Copy) {
        let written = self.written(a).and(self.written(b));
        if let (Operand::Same(a), Operand::Same(b)) = (self.operand(a), self.operand(b)) {
            return self.set(dst, f(a, b), written);
        }
        let mut row = self.take_row();
        let lanes = self.lanes();
        match (self.operand(a), self.operand(b)) {
            (Operand::Each(a), Operand::Each(b)) => {
                for ((out, a), b) in row[lanes.clone()].iter_mut().zip(&a[lanes.clone()]).zip(&b[lanes.clone()]) {
                    *out = f(*a, *b);
                }
            }
            (Operand::Each(a), Operand::Same(b)) => {
                for (out, a) in row[lanes.clone()].iter_mut().zip(&a[lanes.clone()]) {
                    *out = f(*a, b);
                }
            }
            (Operand::Same(a), Operand::Each(b)) => {
                for (out, b) in row[lanes.clone()].iter_mut().zip(&b[lanes.clone()]) {
                    *out = f(a, *b);
                }
            }
            (Operand::Same(_), Operand::Same(_)) => {}
        }
        self.put_row(dst, row, written);
    }

    /// Like `two`, for expensive functions: one loop instead of three.
    #[inline(always)]
    pub fn two_slow(&mut self, dst: Reg, a: Reg, b: Reg, f: impl Fn(u32, u32) -> u32 + Copy) {
        let written = self.written(a).and(self.written(b));
        let mut row = self.take_row();
        let lanes = self.lanes();
        let same = match (self.operand(a), self.operand(b)) {
            (Operand::Same(a), Operand::Same(b)) => Some(f(a, b)),
            (a, b) => {
                for lane in lanes.clone() {
                    row[lane] = f(a.at(lane), b.at(lane));
                }
                None
            }
        };
        self.put(dst, same, row, written);
    }

    #[inline(always)]
    pub fn three(&mut self, dst: Reg, regs: [Reg; 3], f: impl Fn(u32, u32, u32) -> u32 + Copy) {
        let [a, b, c] = regs;
        let written = self.written(a).and(self.written(b)).and(self.written(c));
        let mut row = self.take_row();
        let lanes = self.lanes();
        let same = match (self.operand(a), self.operand(b), self.operand(c)) {
            (Operand::Same(a), Operand::Same(b), Operand::Same(c)) => Some(f(a, b, c)),
            (Operand::Each(a), Operand::Each(b), Operand::Each(c)) => {
                for (((out, a), b), c) in
                    row[lanes.clone()].iter_mut().zip(&a[lanes.clone()]).zip(&b[lanes.clone()]).zip(&c[lanes.clone()])
                {
                    *out = f(*a, *b, *c);
                }
                None
            }
            (a, b, c) => {
                for lane in lanes.clone() {
                    row[lane] = f(a.at(lane), b.at(lane), c.at(lane));
                }
                None
            }
        };
        self.put(dst, same, row, written);
    }

    /// The sum of products of floats, from the first one to the last.
    pub fn dot(&mut self, dst: Reg, a: Reg, b: Reg, n: u32, steps: [u32; 2]) {
        let regs = |i: u32| (a + i * steps[0], b + i * steps[1]);
        let mut written = LaneSet::FULL;
        let mut is_uniform = true;
        for i in 0..n {
            let (a, b) = regs(i);
            written = written.and(self.written(a)).and(self.written(b));
            is_uniform &= matches!((self.operand(a), self.operand(b)), (Operand::Same(_), Operand::Same(_)));
        }
        let product = |a: u32, b: u32| f32::from_bits(a) * f32::from_bits(b);
        if is_uniform {
            let mut sum = 0.0;
            for i in 0..n {
                let (a, b) = regs(i);
                let term = product(self.operand(a).at(0), self.operand(b).at(0));
                sum = if i == 0 { term } else { sum + term };
            }
            return self.set(dst, sum.to_bits(), written);
        }
        let mut row = self.take_row();
        let lanes = self.lanes();
        for i in 0..n {
            let (a, b) = regs(i);
            let add = |out: &mut u32, term: f32| {
                *out = if i == 0 { term.to_bits() } else { (f32::from_bits(*out) + term).to_bits() };
            };
            match (self.operand(a), self.operand(b)) {
                (Operand::Each(a), Operand::Each(b)) => {
                    for ((out, a), b) in row[lanes.clone()].iter_mut().zip(&a[lanes.clone()]).zip(&b[lanes.clone()]) {
                        add(out, product(*a, *b));
                    }
                }
                (Operand::Each(row_of), Operand::Same(factor)) | (Operand::Same(factor), Operand::Each(row_of)) => {
                    for (out, a) in row[lanes.clone()].iter_mut().zip(&row_of[lanes.clone()]) {
                        add(out, product(*a, factor));
                    }
                }
                (Operand::Same(a), Operand::Same(b)) => {
                    let term = product(a, b);
                    row[lanes.clone()].iter_mut().for_each(|out| add(out, term));
                }
            }
        }
        self.put_row(dst, row, written);
    }
}
