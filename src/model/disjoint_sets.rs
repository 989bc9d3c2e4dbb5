//! Disjoint sets whose members may stand against their representative.
//!
//! Union by smaller index with path halving, so the outcome depends on the input only. Each member also knows its
//! parity to its representative (Tarjan's union-find with a potential in ℤ₂): joining two members as *opposed* twice
//! around an odd cycle is a contradiction, which is how an unorientable surface shows.
//!
//! Limits: at most 2³¹ members.

/// Sets over `0..len`, each member alone at first.
pub(super) struct DisjointSets {
    /// Parent index shifted left by one; the low bit is the parity to the parent.
    links: Vec<u32>,
}

impl DisjointSets {
    /// `len` members, each alone.
    pub(super) fn new(len: usize) -> Self {
        Self { links: (0..len as u32).map(|i| i << 1).collect() }
    }

    /// The representative of a member, and whether the member stands against it.
    pub(super) fn find(&mut self, member: u32) -> (u32, bool) {
        let (mut at, mut parity) = (member, 0);
        loop {
            let link = self.links[at as usize];
            let parent = link >> 1;
            if parent == at {
                return (at, parity == 1);
            }
            // Skipping one generation keeps the parity: the two links' bits add up.
            let skipped = self.links[parent as usize] ^ (link & 1);
            self.links[at as usize] = skipped;
            parity ^= skipped & 1;
            at = skipped >> 1;
        }
    }

    /// The representative of a member.
    pub(super) fn root(&mut self, member: u32) -> u32 {
        self.find(member).0
    }

    /// Joins two members that agree, or with `opposed` stand against each other. Returns `false` where that
    /// contradicts what is known.
    pub(super) fn join(&mut self, a: u32, b: u32, opposed: bool) -> bool {
        let ((root_a, parity_a), (root_b, parity_b)) = (self.find(a), self.find(b));
        let between_roots = parity_a ^ parity_b ^ opposed;
        if root_a == root_b {
            return !between_roots;
        }
        let (low, high) = (root_a.min(root_b), root_a.max(root_b));
        self.links[high as usize] = low << 1 | u32::from(between_roots);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parity_adds_up_along_a_chain() {
        let mut sets = DisjointSets::new(5);
        assert!(sets.join(3, 4, true));
        assert!(sets.join(2, 3, true));
        assert!(sets.join(1, 2, false));
        assert!(sets.join(0, 1, true));
        let against: Vec<bool> = (0..5).map(|i| sets.find(i).1).collect();
        assert_eq!(against, [false, true, true, false, true]);
        assert!((0..5).all(|i| sets.root(i) == 0));
    }

    #[test]
    fn an_odd_cycle_is_a_contradiction() {
        let mut sets = DisjointSets::new(3);
        assert!(sets.join(0, 1, true) && sets.join(1, 2, true));
        assert!(sets.join(0, 2, false), "an even number of turns agrees");
        assert!(!sets.join(0, 2, true));
    }
}
