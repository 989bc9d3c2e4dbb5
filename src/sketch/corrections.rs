//! What the artist says of how strokes are read together, kept with the drawing.
//!
//! A [`Correction`] names strokes and says what they are not, what they are, or that each is a part by itself. It holds for
//! every reading of these strokes, also for one with a few strokes more or fewer ([`shares_most`]), so that it stays while
//! drawing goes on. Strokes with a tool of their own are never read together, so a correction says nothing of them. Names of
//! strokes that are not there mean nothing: a stroke that was removed finds its correction when it comes back.

use super::{Reading, StrokeId, limits};
use std::collections::HashSet;
use std::sync::Arc;

/// What is said of some strokes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Correction {
    /// The strokes, ascending, each once, at least one.
    pub strokes: Vec<StrokeId>,
    /// What is said of them.
    pub verdict: Verdict,
}

/// What can be said of strokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// They are not this together; the next likely reading holds.
    Not(Reading),
    /// They are this together and nothing else.
    As(Reading),
    /// Each is a part by itself.
    Separate,
}

/// All corrections of a drawing, oldest first; shared, because drawings are copied with every sample of the pen.
pub type Corrections = Arc<[Correction]>;

impl Correction {
    /// What is said of these strokes, in any order.
    pub fn new(strokes: impl IntoIterator<Item = StrokeId>, verdict: Verdict) -> Self {
        let mut strokes: Vec<StrokeId> = strokes.into_iter().collect();
        strokes.sort_unstable();
        strokes.dedup();
        Self { strokes, verdict }
    }

    /// Whether two corrections are about the same strokes.
    fn is_about(&self, strokes: &[StrokeId]) -> bool {
        let shared = self.strokes.iter().filter(|stroke| strokes.binary_search(stroke).is_ok()).count();
        shares_most(shared, self.strokes.len(), strokes.len())
    }
}

/// Whether two sets of strokes that have `shared` in common are about the same: more than half of the smaller one.
pub fn shares_most(shared: usize, one: usize, other: usize) -> bool {
    2 * shared > one.min(other)
}

/// The corrections with a new one. What they are not adds up, until it is said what the strokes are: that takes the place of all
/// that was said of them before. What is said only of strokes that are not there is left out.
pub fn corrected(
    known: &[Correction],
    new: Correction,
    strokes: impl IntoIterator<Item = StrokeId>,
) -> Corrections {
    let there: HashSet<StrokeId> = strokes.into_iter().collect();
    let stays = |old: &Correction| {
        let is_refusal = |verdict: Verdict| matches!(verdict, Verdict::Not(_));
        let adds_up = is_refusal(old.verdict) && is_refusal(new.verdict) && *old != new;
        old.strokes.iter().any(|stroke| there.contains(stroke)) && (adds_up || !old.is_about(&new.strokes))
    };
    let kept: Vec<Correction> = known.iter().filter(|old| stays(old)).cloned().collect();
    kept.into_iter().chain([new]).collect()
}

/// Checks that there are not too many, and that each names strokes, ascending and each once.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(corrections: &[Correction]) -> Result<(), String> {
    if corrections.len() > limits::MAX_CORRECTIONS {
        return Err(format!("a drawing holds at most {} corrections", limits::MAX_CORRECTIONS));
    }
    let names: usize = corrections.iter().map(|correction| correction.strokes.len()).sum();
    if names > limits::MAX_CORRECTED_STROKES {
        return Err(format!(
            "corrections name at most {} strokes, all together",
            limits::MAX_CORRECTED_STROKES
        ));
    }
    let is_sound = |c: &Correction| !c.strokes.is_empty() && c.strokes.is_sorted_by(|a, b| a < b);
    match corrections.iter().position(|correction| !is_sound(correction)) {
        Some(at) => Err(format!("correction {} names no stroke, or one twice", at + 1)),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn not(strokes: &[StrokeId], reading: Reading) -> Correction {
        Correction::new(strokes.iter().copied(), Verdict::Not(reading))
    }

    #[test]
    fn refusals_add_up_until_it_is_said_what_strokes_are() {
        let tree = corrected(&[], not(&[2, 1, 3], Reading::Tree), 1..=9);
        assert_eq!(tree[0].strokes, [1, 2, 3]);
        let other = corrected(&tree, not(&[7], Reading::Leaf), 1..=9);
        let both = corrected(&other, not(&[1, 2], Reading::Bush), 1..=9);
        assert_eq!(both.len(), 3);
        assert_eq!(corrected(&both, not(&[1, 2], Reading::Bush), 1..=9), both);
        let said = corrected(&both, Correction::new([1, 2, 3], Verdict::As(Reading::Cactus)), 1..=9);
        let verdicts: Vec<Verdict> = said.iter().map(|correction| correction.verdict).collect();
        assert_eq!(verdicts, [Verdict::Not(Reading::Leaf), Verdict::As(Reading::Cactus)]);
        let apart = corrected(&said, Correction::new([1, 2], Verdict::Separate), 1..=9);
        assert_eq!((apart.len(), apart[1].verdict), (2, Verdict::Separate));
        let refused = corrected(&apart, not(&[1, 2], Reading::Grass), 1..=9);
        assert_eq!((refused.len(), refused[1].verdict), (2, Verdict::Not(Reading::Grass)));
    }

    #[test]
    fn what_is_said_of_strokes_that_went_goes_with_the_next_correction() {
        let gone = corrected(&[], not(&[1, 2], Reading::Tree), 1..=2);
        assert_eq!(corrected(&gone, not(&[5], Reading::Leaf), 3..=9).len(), 1);
    }

    #[test]
    fn too_much_is_refused() {
        assert_eq!(check(&[not(&[1], Reading::Pot)]), Ok(()));
        assert!(check(&[not(&[], Reading::Pot)]).is_err());
        let twice = Correction { strokes: vec![1, 1], verdict: Verdict::Separate };
        assert!(check(&[twice]).is_err());
        assert!(check(&vec![not(&[1], Reading::Pot); limits::MAX_CORRECTIONS + 1]).is_err());
        let all = Correction::new(0..limits::MAX_CORRECTED_STROKES as u64, Verdict::Separate);
        assert!(check(std::slice::from_ref(&all)).is_ok() && check(&[all, not(&[1], Reading::Pot)]).is_err());
    }
}
