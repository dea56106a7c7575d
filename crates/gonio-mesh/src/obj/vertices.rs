//! Converts corners of faces to vertices, merging equal ones.
//!
//! The first attributes used at a position make vertex number `position`, so that vertices are in file order and their
//! positions need not be moved. Further attributes make extra vertices, numbered from `position_count` on in the order
//! of their first use.

use crate::ReadError;
use crate::input::too_many_vertices;
use std::collections::HashMap;

/// Texture coordinate and normal of a corner, as one number: their indices from 1, 0 for none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct CornerAttributes(u64);

impl CornerAttributes {
    /// Set in every value, to distinguish it from an empty entry.
    const IS_USED: u64 = 1 << 63;
    /// The largest index of a normal.
    pub(super) const MOST_NORMALS: u64 = (1 << 31) - 1;
    /// The largest index of a texture coordinate.
    pub(super) const MOST_TEX_COORDS: u64 = u32::MAX as u64;

    /// Creates the value for indices within the limits above.
    #[inline(always)]
    pub(super) fn new(tex_coord: u64, normal: u64) -> Self {
        CornerAttributes(Self::IS_USED | normal << 32 | tex_coord)
    }

    /// Whether this is not an empty entry.
    pub(super) fn is_used(self) -> bool {
        self.0 & Self::IS_USED != 0
    }

    /// The index of the texture coordinate, from 1, or 0.
    #[inline(always)]
    pub(super) fn tex_coord(self) -> usize {
        (self.0 & Self::MOST_TEX_COORDS) as usize
    }

    /// The index of the normal, from 1, or 0.
    #[inline(always)]
    pub(super) fn normal(self) -> usize {
        (self.0 >> 32 & Self::MOST_NORMALS) as usize
    }

    /// Whether the texture coordinate or the normal is missing.
    #[inline(always)]
    pub(super) fn is_incomplete(self) -> bool {
        (self.0 as u32 == 0) | (self.0 << 1 < 1 << 33)
    }

    /// Stores a number in place of attributes.
    pub(super) fn number(number: u32) -> Self {
        CornerAttributes(u64::from(number))
    }

    /// Returns the number if this is one.
    pub(super) fn as_number(self) -> Option<u32> {
        (!self.is_used()).then_some(self.0 as u32)
    }
}

/// A corner: its position, from 0, and its other attributes.
pub(super) type Corner = (u32, CornerAttributes);

/// The vertices of some faces.
#[derive(Default)]
pub(super) struct Vertices {
    /// For each position its first attributes. Untouched memory costs nothing.
    first: Vec<u64>,
    /// For each [`BLOCK`] of positions whether one of them is used.
    touched: Vec<bool>,
    pub(super) extras: Extras,
}

/// Number of positions that share a flag.
const BLOCK: usize = 1024;

const NONE: u32 = u32::MAX;

/// Most extra vertices of one position that are searched linearly.
const MOST_IN_A_CHAIN: u32 = 16;

/// Corners whose position already has other attributes.
#[derive(Default)]
pub(super) struct Extras {
    /// In the order of their first use.
    pub(super) corners: Vec<Corner>,
    /// For each position the number of its latest extra vertex plus 1, or 0.
    latest: Vec<u32>,
    /// For each extra vertex the number of the previous one at its position plus 1, or 0.
    before: Vec<u32>,
    /// Corners of positions with many extra vertices.
    crowded: HashMap<Corner, u32>,
}

impl Vertices {
    pub(super) fn new(position_count: usize) -> Self {
        Vertices {
            first: vec![0; position_count],
            touched: vec![false; position_count / BLOCK + 1],
            extras: Extras::default(),
        }
    }

    /// Returns the vertex of a corner, whose position must exist.
    #[inline(always)]
    pub(super) fn of_corner(&mut self, (position, kind): Corner) -> Result<u32, ReadError> {
        let place = position as usize;
        let known = self.first[place];
        // One comparison, not two: which of them is true is hard to predict.
        if (known == kind.0) | (known == 0) {
            self.first[place] = kind.0;
            self.touched[place / BLOCK] = true;
            return Ok(position);
        }
        self.extra((position, kind))
    }

    #[inline(never)]
    fn extra(&mut self, corner: Corner) -> Result<u32, ReadError> {
        let extra = self.extras.number_of(corner, self.first.len());
        let vertex = self.first.len() as u64 + u64::from(extra);
        if vertex >= u64::from(NONE) { Err(too_many_vertices(u64::from(NONE))) } else { Ok(vertex as u32) }
    }

    /// Returns the first attributes of a position.
    #[inline(always)]
    pub(super) fn first(&self, position: usize) -> CornerAttributes {
        CornerAttributes(self.first[position])
    }

    /// Replaces the first attributes of a position.
    #[inline(always)]
    pub(super) fn set_first(&mut self, position: usize, kind: CornerAttributes) {
        self.first[position] = kind.0;
        self.touched[position / BLOCK] = true;
    }

    /// Numbers the used positions, replacing their first attributes.
    pub(super) fn number_used(&mut self) {
        for (number, first) in (0..).zip(self.first.iter_mut().filter(|first| **first != 0)) {
            *first = number;
        }
    }

    /// Returns the number of a position after that; `None` beyond the last one.
    #[inline(always)]
    pub(super) fn number(&self, position: usize) -> Option<u32> {
        self.first.get(position).map(|number| *number as u32)
    }

    /// Returns used positions and their first attributes, in order.
    #[inline(always)]
    pub(super) fn firsts(&self) -> impl Iterator<Item = (usize, CornerAttributes)> {
        self.first
            .iter()
            .enumerate()
            .filter(|(_, first)| **first != 0)
            .map(|(position, first)| (position, CornerAttributes(*first)))
    }

    /// Returns the number of used positions.
    pub(super) fn used_count(&self) -> usize {
        self.first.iter().map(|first| usize::from(*first != 0)).sum()
    }

    /// Returns the number of positions, used or not.
    pub(super) fn position_count(&self) -> usize {
        self.first.len()
    }

    /// Returns positions that may be used, in order.
    pub(super) fn touched(&self) -> impl Iterator<Item = usize> {
        let blocks = self.touched.iter().enumerate().filter(|(_, touched)| **touched);
        blocks.flat_map(|(block, _)| block * BLOCK..((block + 1) * BLOCK).min(self.first.len()))
    }
}

impl Extras {
    /// Returns the number of a corner, from 0, adding it if it is new.
    pub(super) fn number_of(&mut self, corner: Corner, position_count: usize) -> u32 {
        if self.latest.is_empty() {
            self.latest = vec![0; position_count];
        }
        let position = corner.0 as usize;
        let latest = self.latest[position];
        let (mut extra, mut steps) = (latest, 0);
        while extra != 0 && steps < MOST_IN_A_CHAIN {
            let number = extra - 1;
            if self.corners[number as usize] == corner {
                return number;
            }
            extra = self.before[number as usize];
            steps += 1;
        }
        let is_crowded = steps == MOST_IN_A_CHAIN;
        if is_crowded && let Some(&number) = self.crowded.get(&corner) {
            return number;
        }
        let number = self.corners.len() as u32;
        self.corners.push(corner);
        if is_crowded {
            self.crowded.insert(corner, number);
            self.before.push(0);
        } else {
            self.before.push(latest);
            self.latest[position] = number + 1;
        }
        number
    }

    /// Adds a corner that is known to be new and that will not be looked up again.
    pub(super) fn push(&mut self, corner: Corner) -> u32 {
        self.corners.push(corner);
        self.before.push(0);
        self.corners.len() as u32 - 1
    }

    pub(super) fn into_corners(self) -> Vec<Corner> {
        self.corners
    }
}
