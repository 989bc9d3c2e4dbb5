//! How much work growth has been, counted in elementary steps rather than in seconds.
//!
//! A step is about what a processor does in a nanosecond: one comparison of a marker with a bud, four voxels that are
//! darkened, one visit of a node. Whatever grows counts its steps, or what they are at most, before it makes them. The
//! count depends on the plant alone, so a cap on it ends growth at the same internode on every machine, on any number of
//! threads, and whether or not the plant went back to an age before.

use crate::growth::limits::Outcome;

/// Steps for each node in each year: resources run down and up through it, and it may be shed.
pub(crate) const NODE: u64 = 12;
/// Steps for each open bud in each year: it senses, and its fate is decided.
pub(crate) const BUD: u64 = 150;
/// Steps for each internode that grows, beside those of its space or shadow and of the volume that holds it.
pub(crate) const INTERNODE: u64 = 400;

/// Steps of each year, and their cap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Effort {
    /// Steps until the end of each year, from year 0, which is what the plant begins with.
    until: Vec<u64>,
    now: u64,
    most: u64,
}

impl Effort {
    /// Nothing is done yet.
    pub(crate) fn new(most: u64) -> Self {
        Self { until: Vec::new(), now: 0, most }
    }

    /// Counts steps that are about to be made.
    ///
    /// # Errors
    /// [`Outcome::TooManySteps`] where there would be too many.
    pub(crate) fn spend(&mut self, steps: u64) -> Result<(), Outcome> {
        self.now = self.now.saturating_add(steps);
        if self.now > self.most { Err(Outcome::TooManySteps(self.most)) } else { Ok(()) }
    }

    /// Steps that were made.
    pub(crate) fn spent(&self) -> u64 {
        self.now
    }

    /// Ends a year.
    pub(crate) fn end_year(&mut self) {
        self.until.push(self.now);
    }

    /// Goes back to the end of a year.
    pub(crate) fn rewind(&mut self, year: u16) {
        self.until.truncate(usize::from(year) + 1);
        self.now = self.until.last().copied().unwrap_or(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_counted_by_year_up_to_the_cap() {
        let mut effort = Effort::new(10);
        let left = |effort: &Effort| effort.most.saturating_sub(effort.spent());
        effort.end_year();
        for _ in 1..=3 {
            assert_eq!(effort.spend(3), Ok(()));
            effort.end_year();
        }
        assert_eq!((effort.spend(2), left(&effort)), (Err(Outcome::TooManySteps(10)), 0));
        effort.rewind(3);
        assert_eq!((effort.spent(), left(&effort)), (9, 1));
        effort.rewind(1);
        assert_eq!((effort.spent(), effort.spend(7)), (3, Ok(())));
        assert!(effort.spend(u64::MAX).is_err());
    }
}
