//! Rayon's interface on one thread: the same names, the same order of results.

use std::slice::{Chunks, ChunksExact, ChunksExactMut, ChunksMut, Iter, IterMut};

/// The traits, for `use`.
pub mod prelude {
    pub use super::{IntoParallelIterator, ParallelSlice, ParallelSliceMut};
}

/// 1.
pub fn current_num_threads() -> usize {
    1
}

/// Runs `a`, then `b`.
pub fn join<A, B>(a: impl FnOnce() -> A, b: impl FnOnce() -> B) -> (A, B) {
    (a(), b())
}

/// Runs `other`, then `here`.
pub fn beside<A, B>(other: impl FnOnce() -> A, here: impl FnOnce() -> B) -> (A, B) {
    join(other, here)
}

/// Runs `f` on the only thread.
pub fn broadcast<A>(f: impl FnOnce(()) -> A) -> Vec<A> {
    vec![f(())]
}

/// An iterator with the methods of a parallel one.
pub struct Sequential<I>(I);

impl<I: Iterator> Sequential<I> {
    /// Each item through `f`.
    pub fn map<T, F: FnMut(I::Item) -> T>(self, f: F) -> Sequential<std::iter::Map<I, F>> {
        Sequential(self.0.map(f))
    }

    /// All items of the iterators that `f` makes.
    pub fn flat_map_iter<U: IntoIterator, F: FnMut(I::Item) -> U>(
        self,
        f: F,
    ) -> Sequential<std::iter::FlatMap<I, U, F>> {
        Sequential(self.0.flat_map(f))
    }

    /// Pairs of items, until one of the two ends.
    pub fn zip<B: IntoParallelIterator>(self, other: B) -> Sequential<std::iter::Zip<I, B::Iter>> {
        Sequential(self.0.zip(other.into_par_iter().0))
    }

    /// From the last to the first.
    pub fn rev(self) -> Sequential<std::iter::Rev<I>>
    where
        I: DoubleEndedIterator,
    {
        Sequential(self.0.rev())
    }

    /// Items with their indices.
    pub fn enumerate(self) -> Sequential<std::iter::Enumerate<I>> {
        Sequential(self.0.enumerate())
    }

    /// The least number of items for one thread: nothing to do.
    #[must_use]
    pub fn with_min_len(self, _: usize) -> Self {
        self
    }

    /// Calls `f` with each item.
    pub fn for_each(self, f: impl FnMut(I::Item)) {
        self.0.for_each(f);
    }

    /// Combines all items by `f`, starting with `identity()`.
    pub fn reduce(self, identity: impl FnOnce() -> I::Item, f: impl FnMut(I::Item, I::Item) -> I::Item) -> I::Item {
        self.0.fold(identity(), f)
    }

    /// Collects the items in order.
    pub fn collect<C: FromIterator<I::Item>>(self) -> C {
        self.0.collect()
    }
}

/// Anything that can be iterated over.
pub trait IntoParallelIterator {
    /// The iterator below.
    type Iter: Iterator<Item = Self::Item>;
    /// What it gives.
    type Item;
    /// Its items.
    fn into_par_iter(self) -> Sequential<Self::Iter>;
}

impl<I: IntoIterator> IntoParallelIterator for I {
    type Iter = I::IntoIter;
    type Item = I::Item;
    fn into_par_iter(self) -> Sequential<I::IntoIter> {
        Sequential(self.into_iter())
    }
}

/// So that one sequential iterator can be zipped with another.
impl<I: Iterator> IntoIterator for Sequential<I> {
    type Item = I::Item;
    type IntoIter = I;
    fn into_iter(self) -> I {
        self.0
    }
}

/// The items of a slice.
pub trait ParallelSlice<T> {
    /// Each item.
    fn par_iter(&self) -> Sequential<Iter<'_, T>>;
    /// Runs of `size` items; the last may be shorter.
    fn par_chunks(&self, size: usize) -> Sequential<Chunks<'_, T>>;
    /// Runs of `size` items; what is left over at the end is left out.
    fn par_chunks_exact(&self, size: usize) -> Sequential<ChunksExact<'_, T>>;
}

impl<T> ParallelSlice<T> for [T] {
    fn par_iter(&self) -> Sequential<Iter<'_, T>> {
        Sequential(self.iter())
    }
    fn par_chunks(&self, size: usize) -> Sequential<Chunks<'_, T>> {
        Sequential(self.chunks(size))
    }
    fn par_chunks_exact(&self, size: usize) -> Sequential<ChunksExact<'_, T>> {
        Sequential(self.chunks_exact(size))
    }
}

/// The items of a slice, to be changed.
pub trait ParallelSliceMut<T> {
    /// Each item.
    fn par_iter_mut(&mut self) -> Sequential<IterMut<'_, T>>;
    /// Runs of `size` items; the last may be shorter.
    fn par_chunks_mut(&mut self, size: usize) -> Sequential<ChunksMut<'_, T>>;
    /// Runs of `size` items; what is left over at the end is left out.
    fn par_chunks_exact_mut(&mut self, size: usize) -> Sequential<ChunksExactMut<'_, T>>;
}

impl<T> ParallelSliceMut<T> for [T] {
    fn par_iter_mut(&mut self) -> Sequential<IterMut<'_, T>> {
        Sequential(self.iter_mut())
    }
    fn par_chunks_mut(&mut self, size: usize) -> Sequential<ChunksMut<'_, T>> {
        Sequential(self.chunks_mut(size))
    }
    fn par_chunks_exact_mut(&mut self, size: usize) -> Sequential<ChunksExactMut<'_, T>> {
        Sequential(self.chunks_exact_mut(size))
    }
}

#[cfg(test)]
mod tests {
    use super::prelude::*;
    use super::{beside, broadcast, join};

    #[test]
    fn both_parts_run_and_return_beside_each_other() {
        let own = std::rc::Rc::new(7);
        assert_eq!(crate::beside(|| 3, || *own), (3, 7));
        assert_eq!(beside(|| 3, || *own), (3, 7));
        assert_eq!(broadcast(|()| 5), [5]);
    }

    #[test]
    #[should_panic(expected = "the other part")]
    fn a_panic_of_the_other_part_is_one_here() {
        crate::beside(|| panic!("the other part"), || ());
    }

    #[test]
    fn the_results_are_those_of_rayon() {
        use rayon::prelude as parallel;
        let numbers: Vec<u64> = (0..1000).collect();
        let ours = |from: &[u64]| -> Vec<u64> {
            let doubled =
                ParallelSlice::par_iter(from).with_min_len(8).zip(IntoParallelIterator::into_par_iter(1..900));
            doubled.enumerate().map(|(i, (a, b))| a * b + i as u64).flat_map_iter(|x| [x, x + 1]).collect()
        };
        let rayons = |from: &[u64]| -> Vec<u64> {
            use parallel::{IndexedParallelIterator, ParallelIterator};
            let second = parallel::IntoParallelIterator::into_par_iter((1..900_u64).collect::<Vec<_>>());
            let doubled = parallel::IntoParallelRefIterator::par_iter(from).with_min_len(8).zip(second);
            doubled.enumerate().map(|(i, (a, b))| a * b + i as u64).flat_map_iter(|x| [x, x + 1]).collect()
        };
        assert_eq!(ours(&numbers), rayons(&numbers));
        let sums = |chunks: Vec<u64>| chunks.into_iter().rev().collect::<Vec<_>>();
        let exact: Vec<u64> = numbers.par_chunks_exact(300).map(|chunk| chunk.iter().sum()).rev().collect();
        assert_eq!(exact, sums(numbers.chunks_exact(300).map(|chunk| chunk.iter().sum()).collect()));
        let most = ParallelSlice::par_chunks(&numbers[..], 300).map(|chunk| chunk.len()).reduce(|| 0, usize::max);
        assert_eq!(most, 300);
    }

    #[test]
    fn slices_are_changed_in_place() {
        let mut numbers = [1, 2, 3, 4, 5];
        ParallelSliceMut::par_iter_mut(&mut numbers[..]).for_each(|n| *n *= 10);
        ParallelSliceMut::par_chunks_mut(&mut numbers[..], 2).for_each(|chunk| chunk[0] += 1);
        ParallelSliceMut::par_chunks_exact_mut(&mut numbers[..], 2).for_each(|chunk| chunk[1] += 2);
        assert_eq!(numbers, [11, 22, 31, 42, 51]);
        assert_eq!(join(|| 1, || "b"), (1, "b"));
    }
}
