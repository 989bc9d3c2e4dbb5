//! What a stage of the pipeline made, kept from one build to the next by what it was made from.
//!
//! Every stage is a pure function of plain data, so a thing whose key says everything that it was made from is the very
//! thing that would be made again. A stage asks once in a build for all things of a kind ([`Kept::made`]); what it does not
//! ask for is forgotten. Long lists are not compared but known by their address ([`Same`]): what comes unchanged out of one
//! stage's memory is found at once in the next one's. What did not change is neither moved nor copied: stages are given the
//! kept things themselves.
//!
//! Limits: lists of equal content at two addresses are two keys, which costs time but changes nothing.

use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::hash::{Hash, Hasher};
use std::ops::Range;
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

/// What a key is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// Only to be compared while its input is there.
    Comparing,
    /// To be kept: it holds what it knows by its address, so that nothing else comes to lie there.
    Keeping,
}

/// Shared data, known by its address.
#[derive(Debug)]
pub struct Same<T: ?Sized> {
    address: usize,
    _held: Option<Arc<T>>,
}

impl<T: ?Sized> Same<T> {
    /// This very data. Holding it writes to memory that is far away, so that comparing thousands goes without.
    pub fn of(data: &Arc<T>, used: Use) -> Self {
        let held = (used == Use::Keeping).then(|| Arc::clone(data));
        Self { address: Arc::as_ptr(data).addr(), _held: held }
    }
}

impl<T: ?Sized> Clone for Same<T> {
    fn clone(&self) -> Self {
        Self { address: self.address, _held: self._held.clone() }
    }
}

impl<T: ?Sized> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        self.address == other.address
    }
}

impl<T: ?Sized> Eq for Same<T> {}

impl<T: ?Sized> Hash for Same<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.address.hash(state);
    }
}

/// Things of one kind, by what they were made from, in the order in which the last call asked for them.
#[derive(Debug)]
pub struct Kept<K, V> {
    /// One for each thing; none at all for a single call.
    keys: Vec<K>,
    things: Vec<V>,
    /// Whether there is no next call, so that no key is asked for.
    is_for_one_call: bool,
    /// Fewest things that are made on one thread.
    batch: usize,
}

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self { keys: Vec::new(), things: Vec::new(), is_for_one_call: false, batch: BATCH }
    }
}

impl<K, V> Kept<K, V> {
    /// For a single call, for which no keys are made.
    pub fn for_one_call() -> Self {
        Self { is_for_one_call: true, ..Self::default() }
    }

    /// The same for things of which each is worth a thread of its own.
    #[must_use]
    pub fn of_large_things(self) -> Self {
        Self { batch: 1, ..self }
    }
}

impl<K: Eq + Hash, V: Clone + Send + Sync> Kept<K, V> {
    /// What `make` makes of each input, in their order; what the last call made from the same key is not made again. The
    /// key must say everything that `make` reads.
    pub fn made<I: Sync>(
        &mut self,
        inputs: &[I],
        key: impl Fn(&I, Use) -> K,
        make: impl Fn(&I) -> V + Sync,
    ) -> &[V] {
        self.made_where(inputs, key, |_, _| true, make)
    }

    /// The same where a key does not say everything: what was made from it is taken only if it still `holds`.
    pub fn made_where<I: Sync>(
        &mut self,
        inputs: &[I],
        key: impl Fn(&I, Use) -> K,
        holds: impl Fn(&I, &V) -> bool,
        make: impl Fn(&I) -> V + Sync,
    ) -> &[V] {
        if self.is_for_one_call {
            self.things = inputs.par_iter().with_min_len(self.batch).map(&make).collect();
            return &self.things;
        }
        // Most calls ask for what the last one asked for, in the same order: only what stands between the common beginning
        // and the common end needs a search.
        let is_same = |known: &K, input: &I| *known == key(input, Use::Comparing);
        let Window { begin, end } = Window::between(&self.keys, inputs, is_same);
        let (old_end, new_end) = (self.keys.len() - end, inputs.len() - end);
        let keys: Vec<K> = inputs[begin..new_end].iter().map(|input| key(input, Use::Keeping)).collect();
        let between = self.places(begin..old_end, &keys);
        let place_of = |i: usize| match i {
            i if i < begin => Some(i),
            i if i < new_end => between[i - begin],
            i => Some(i - new_end + old_end),
        };
        let is_missing =
            |i: &usize| place_of(*i).is_none_or(|place| !holds(&inputs[*i], &self.things[place]));
        let missing: Vec<usize> = (0..inputs.len()).filter(is_missing).collect();
        let new: Vec<V> = missing.par_iter().with_min_len(self.batch).map(|i| make(&inputs[*i])).collect();
        let mut new: BTreeMap<usize, V> = missing.into_iter().zip(new).collect();
        let thing = |i: usize| new.remove(&i).or_else(|| Some(self.things[between[i - begin]?].clone()));
        let things: Vec<V> = (begin..new_end).filter_map(thing).collect();
        self.keys.splice(begin..old_end, keys);
        self.things.splice(begin..old_end, things);
        for (i, thing) in new {
            self.things[i] = thing;
        }
        &self.things
    }

    /// Where these keys stand among those of a range.
    fn places(&self, among: Range<usize>, keys: &[K]) -> Vec<Option<usize>> {
        if keys.is_empty() {
            return Vec::new();
        }
        let by_key: HashMap<&K, usize> = among.map(|place| (&self.keys[place], place)).collect();
        keys.iter().map(|key| by_key.get(key).copied()).collect()
    }

    /// Forgets all things but those that are wanted, which may be changed on the way.
    pub fn keep_only(&mut self, mut is_wanted: impl FnMut(&mut V) -> bool) {
        let is_wanted: Vec<bool> = self.things.iter_mut().map(&mut is_wanted).collect();
        if is_wanted.iter().all(|is_wanted| *is_wanted) {
            return;
        }
        let (mut of_keys, mut of_things) = (is_wanted.iter(), is_wanted.iter());
        self.keys.retain(|_| of_keys.next().is_none_or(|is_wanted| *is_wanted));
        self.things.retain(|_| of_things.next().is_none_or(|is_wanted| *is_wanted));
    }

    /// How many things are kept.
    pub fn len(&self) -> usize {
        self.things.len()
    }

    /// Whether nothing is kept.
    pub fn is_empty(&self) -> bool {
        self.things.is_empty()
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
        let squares = kept.made(of, |x, _| *x, square).to_vec();
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
            kept.made_where(&[4], |x, _| *x, |_, made| made.0 == factor, |x| (factor, factor * x)).to_vec()
        };
        assert_eq!(times(&mut kept, 2), [(2, 8)]);
        assert_eq!(times(&mut kept, 3), [(3, 12)]);
        assert_eq!(kept.len(), 1);
    }

    #[test]
    fn a_single_call_makes_all() {
        let mut kept = Kept::for_one_call();
        assert_eq!(squares(&mut kept, &[3, 1, 3]), (vec![9, 1, 9], 3));
    }

    #[test]
    fn what_does_not_hold_is_made_again_wherever_it_stands() {
        let mut kept = Kept::default();
        let made = |kept: &mut Kept<u32, (u32, u32)>, of: &[u32], again: u32, round| {
            let holds = |x: &u32, _: &(u32, u32)| *x != again;
            kept.made_where(of, |x, _| *x, holds, |x| (*x, round)).to_vec()
        };
        made(&mut kept, &[1, 2, 3, 4], 0, 1);
        assert_eq!(made(&mut kept, &[1, 5, 2, 4], 2, 2), [(1, 1), (5, 2), (2, 2), (4, 1)]);
        assert_eq!(made(&mut kept, &[1, 5, 2, 4], 1, 3), [(1, 3), (5, 2), (2, 2), (4, 1)]);
        assert_eq!(made(&mut kept, &[0, 1, 5, 4], 4, 4), [(0, 4), (1, 3), (5, 2), (4, 4)]);
        kept.keep_only(|(x, _)| *x != 5);
        assert_eq!(made(&mut kept, &[0, 1, 5, 4], 9, 5), [(0, 4), (1, 3), (5, 5), (4, 4)]);
    }

    #[test]
    fn data_is_known_by_its_address() {
        let data: Arc<[u8]> = Arc::from([1, 2]);
        assert!(Same::of(&data, Use::Keeping) == Same::of(&Arc::clone(&data), Use::Comparing));
        assert!(Same::of(&data, Use::Keeping) != Same::of(&Arc::from([1, 2]), Use::Comparing));
        let before = Arc::strong_count(&data);
        let (compared, kept) = (Same::of(&data, Use::Comparing), Same::of(&data, Use::Keeping));
        assert_eq!(Arc::strong_count(&data), before + 1);
        drop((compared, kept));
    }
}
