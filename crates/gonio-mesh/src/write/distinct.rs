//! Removes repeated values.

use crate::weld::{Table, mix};

/// Values without repetition, in the order of their first use.
pub(super) struct Distinct {
    /// For each value the number of the equal distinct one.
    pub(super) number_of: Vec<u32>,
    /// For each distinct value its first index.
    pub(super) firsts: Vec<u32>,
}

impl Distinct {
    /// Finds the distinct ones of `count` values (below 2^32), `N` numbers each: values are equal if they have the same
    /// bits.
    pub(super) fn from_values<const N: usize>(count: usize, value: impl Fn(usize) -> [f32; N]) -> Distinct {
        let bits = |index: usize| value(index).map(f32::to_bits);
        let mut table = Table::with_room_for(count);
        let mut distinct = Distinct { number_of: Vec::with_capacity(count), firsts: Vec::new() };
        for index in 0..count {
            let key = bits(index);
            let hash = key.iter().fold(0, |hash, &part| mix(hash ^ u64::from(part)));
            let firsts = &mut distinct.firsts;
            let found = table.find(hash, |number| bits(firsts[number as usize] as usize) == key);
            distinct.number_of.push(found.unwrap_or_else(|slot| {
                let number = firsts.len() as u32;
                table.fill(slot, number);
                firsts.push(index as u32);
                number
            }));
        }
        distinct
    }

    /// Returns the indices of the distinct values.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        self.firsts.iter().map(|&first| first as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_bits_are_one_value() {
        let values = [[0.0], [1.0], [-0.0], [1.0], [0.0]];
        let distinct = Distinct::from_values(values.len(), |i| values[i]);
        assert_eq!(distinct.number_of, [0, 1, 2, 1, 0]);
        assert_eq!(distinct.firsts, [0, 1, 2]);
    }
}
