//! What a stage of the pipeline made, kept from one build to the next by what it was made from.
//!
//! Every stage is a pure function of plain data, so a thing whose key says everything that it was made from is the very
//! thing that would be made again. A stage asks once in a build for all things of a kind ([`Kept::made`]); what it does not
//! ask for is forgotten. Long lists are not compared but known by their address ([`Same`]): what comes unchanged out of one
//! stage's memory is found at once in the next one's.
//!
//! Limits: lists of equal content at two addresses are two keys, which costs time but changes nothing.

use rayon::prelude::*;
use std::collections::HashMap;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// Things that one thread makes at a time: fewer are not worth waking another thread for.
const BATCH: usize = 16;

/// The hash of a name that is random already: itself.
#[derive(Debug, Default)]
pub struct NameHasher(u64);

impl Hasher for NameHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.0 = self.0.rotate_left(8) ^ u64::from(*byte));
    }

    fn write_u64(&mut self, name: u64) {
        self.0 = name;
    }
}

/// What two lists have in common at their beginnings and, beyond that, at their ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Length of the common beginning.
    pub begin: usize,
    /// Length of the common end.
    pub end: usize,
}

impl Window {
    /// Compares two lists.
    pub fn between<A, B>(old: &[A], new: &[B], is_same: impl Fn(&A, &B) -> bool) -> Self {
        let same = |(a, b): &(&A, &B)| is_same(a, b);
        let begin = old.iter().zip(new).take_while(same).count();
        let end = old[begin..].iter().rev().zip(new[begin..].iter().rev()).take_while(same).count();
        Self { begin, end }
    }
}

/// Shared data, known by its address. It is held, so that nothing else comes to lie there.
#[derive(Debug)]
pub struct Same<T: ?Sized>(Arc<T>);

impl<T: ?Sized> Same<T> {
    /// This very data.
    pub fn of(data: &Arc<T>) -> Self {
        Self(Arc::clone(data))
    }

    fn address(&self) -> *const () {
        Arc::as_ptr(&self.0).cast()
    }
}

impl<T: ?Sized> Clone for Same<T> {
    fn clone(&self) -> Self {
        Self::of(&self.0)
    }
}

impl<T: ?Sized> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        self.address() == other.address()
    }
}

impl<T: ?Sized> Eq for Same<T> {}

impl<T: ?Sized> Hash for Same<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.address().hash(state);
    }
}

/// Things of one kind, by what they were made from, in the order in which the last call asked for them.
#[derive(Debug)]
pub struct Kept<K, V> {
    held: Vec<(K, V)>,
    /// Whether there is no next call, so that nothing is kept and no key is asked for.
    is_for_one_call: bool,
}

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self { held: Vec::new(), is_for_one_call: false }
    }
}

impl<K, V> Kept<K, V> {
    /// For a single call, which keeps nothing.
    pub fn for_one_call() -> Self {
        Self { held: Vec::new(), is_for_one_call: true }
    }
}

impl<K: Eq + Hash, V: Clone + Send + Sync> Kept<K, V> {
    /// What `make` makes of each input, in their order; what the last call made from the same key is not made again. The
    /// key must say everything that `make` reads.
    pub fn made<I: Sync>(
        &mut self,
        inputs: &[I],
        key: impl Fn(&I) -> K,
        make: impl Fn(&I) -> V + Sync,
    ) -> Vec<V> {
        self.made_where(inputs, key, |_, _| true, make)
    }

    /// The same where a key does not say everything: what was made from it is taken only if it still `holds`.
    pub fn made_where<I: Sync>(
        &mut self,
        inputs: &[I],
        key: impl Fn(&I) -> K,
        holds: impl Fn(&I, &V) -> bool,
        make: impl Fn(&I) -> V + Sync,
    ) -> Vec<V> {
        if self.is_for_one_call {
            return inputs.par_iter().with_min_len(BATCH).map(&make).collect();
        }
        let keys: Vec<K> = inputs.iter().map(key).collect();
        // Most calls ask for what the last one asked for, in the same order: only what stands between the common beginning
        // and the common end needs a search.
        let Window { begin, end } = Window::between(&self.held, &keys, |(held, _), key| held == key);
        let (old_end, new_end) = (self.held.len() - end, keys.len() - end);
        let by_key: HashMap<&K, usize> = match begin < new_end {
            true => (begin..old_end).map(|place| (&self.held[place].0, place)).collect(),
            false => HashMap::new(),
        };
        let place_of = |i: usize| match i {
            i if i < begin => Some(i),
            i if i < new_end => by_key.get(&keys[i]).copied(),
            i => Some(i - new_end + old_end),
        };
        let known = |(i, input): (usize, &I)| {
            let (_, thing) = &self.held[place_of(i)?];
            holds(input, thing).then(|| thing.clone())
        };
        let found: Vec<Option<V>> = inputs.iter().enumerate().map(known).collect();
        let missing: Vec<usize> = (0..inputs.len()).filter(|i| found[*i].is_none()).collect();
        let new: Vec<V> = missing.par_iter().with_min_len(BATCH).map(|i| make(&inputs[*i])).collect();
        for (i, thing) in missing.iter().zip(&new).filter(|(i, _)| **i < begin || **i >= new_end) {
            let place = if *i < begin { *i } else { *i - new_end + old_end };
            self.held[place].1 = thing.clone();
        }
        let mut new = new.into_iter();
        let things: Vec<V> = found.into_iter().filter_map(|found| found.or_else(|| new.next())).collect();
        let between = keys.into_iter().zip(&things).take(new_end).skip(begin);
        let between: Vec<(K, V)> = between.map(|(key, thing)| (key, thing.clone())).collect();
        self.held.splice(begin..old_end, between);
        things
    }

    /// Forgets all things but those that are wanted, which may be changed on the way.
    pub fn keep_only(&mut self, mut is_wanted: impl FnMut(&mut V) -> bool) {
        self.held.retain_mut(|(_, thing)| is_wanted(thing));
    }

    /// How many things are kept.
    pub fn len(&self) -> usize {
        self.held.len()
    }

    /// Whether nothing is kept.
    pub fn is_empty(&self) -> bool {
        self.held.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Squares, and how many of them were made and not taken.
    fn squares(kept: &mut Kept<u32, u32>, of: &[u32]) -> (Vec<u32>, usize) {
        let made = AtomicUsize::new(0);
        let square = |x: &u32| {
            made.fetch_add(1, Ordering::Relaxed);
            x * x
        };
        let squares = kept.made(of, |x| *x, square);
        (squares, made.into_inner())
    }

    #[test]
    fn only_what_is_new_is_made_and_only_what_is_asked_for_is_kept() {
        let mut kept = Kept::default();
        assert_eq!(squares(&mut kept, &[3, 1, 2]), (vec![9, 1, 4], 3));
        assert_eq!(squares(&mut kept, &[1, 5, 3, 1]), (vec![1, 25, 9, 1], 1));
        assert_eq!(kept.len(), 4);
        assert_eq!(squares(&mut kept, &[2]), (vec![4], 1));
        assert_eq!(squares(&mut kept, &[]), (vec![], 0));
        assert!(kept.is_empty());
    }

    #[test]
    fn what_does_not_hold_is_made_again() {
        let mut kept = Kept::default();
        let times = |kept: &mut Kept<u32, (u32, u32)>, factor| {
            kept.made_where(&[4], |x| *x, |_, made| made.0 == factor, |x| (factor, factor * x))
        };
        assert_eq!(times(&mut kept, 2), [(2, 8)]);
        assert_eq!(times(&mut kept, 3), [(3, 12)]);
        assert_eq!(kept.len(), 1);
    }

    #[test]
    fn a_single_call_makes_all_and_keeps_nothing() {
        let mut kept = Kept::for_one_call();
        assert_eq!(squares(&mut kept, &[3, 1, 3]), (vec![9, 1, 9], 3));
        assert!(kept.is_empty());
    }

    #[test]
    fn data_is_known_by_its_address() {
        let data: Arc<[u8]> = Arc::from([1, 2]);
        assert!(Same::of(&data) == Same::of(&Arc::clone(&data)));
        assert!(Same::of(&data) != Same::of(&Arc::from([1, 2])));
    }
}
