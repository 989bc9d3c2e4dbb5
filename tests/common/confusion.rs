//! Confusion matrix of the two classes.

use std::fmt;

/// How often each class was taken for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Confusion {
    /// Blades taken for blades.
    pub(crate) blade_as_blade: usize,
    /// Blades taken for branches.
    pub(crate) blade_as_branch: usize,
    /// Branches taken for branches.
    pub(crate) branch_as_branch: usize,
    /// Branches taken for blades.
    pub(crate) branch_as_blade: usize,
}

impl Confusion {
    /// Counts one stroke.
    pub(crate) fn add(&mut self, is_blade: bool, taken_for_blade: bool) {
        *match (is_blade, taken_for_blade) {
            (true, true) => &mut self.blade_as_blade,
            (true, false) => &mut self.blade_as_branch,
            (false, false) => &mut self.branch_as_branch,
            (false, true) => &mut self.branch_as_blade,
        } += 1;
    }

    /// Strokes that were taken for what they are.
    pub(crate) fn right(&self) -> usize {
        self.blade_as_blade + self.branch_as_branch
    }

    /// Strokes that were taken for the other class.
    pub(crate) fn wrong(&self) -> usize {
        self.blade_as_branch + self.branch_as_blade
    }

    /// Share of right verdicts, 0 to 1; NaN without strokes.
    pub(crate) fn accuracy(&self) -> f64 {
        self.right() as f64 / (self.right() + self.wrong()) as f64
    }
}

impl fmt::Display for Confusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "            taken for blade  for branch")?;
        writeln!(f, "is blade    {:>15}  {:>10}", self.blade_as_blade, self.blade_as_branch)?;
        writeln!(f, "is branch   {:>15}  {:>10}", self.branch_as_blade, self.branch_as_branch)?;
        writeln!(f, "right       {:>14.1}%", 100.0 * self.accuracy())
    }
}
