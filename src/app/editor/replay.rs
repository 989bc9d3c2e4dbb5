//! Growth or the opening of flowers replayed from the beginning: which age, or which opening, is shown when.

use crate::app::panels::growth::YEARS;
use crate::app::panels::opening::OPEN;
use std::time::{Duration, Instant};

/// Length of a replay.
pub(super) const LENGTH: Duration = Duration::from_secs(5);
/// Least time from one value to the next.
const FRAME: Duration = Duration::from_millis(16);

/// What is replayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Replayed {
    /// The age of a plant that grows, years.
    Age,
    /// How far flowers have opened, 0 to 1.
    Opening,
}

impl Replayed {
    /// The parameter that carries it from snapshot to snapshot.
    pub(super) fn parameter(self) -> &'static str {
        match self {
            Self::Age => YEARS,
            Self::Opening => OPEN,
        }
    }
}

/// What is being replayed, or pauses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Replay {
    of: Replayed,
    /// The value at its end.
    end: f32,
    /// Time that it has run.
    run: Duration,
    /// When it was last looked at; `None` while it pauses.
    seen: Option<Instant>,
}

impl Replay {
    /// Begins now, toward this value.
    pub(super) fn begin(of: Replayed, end: f32, now: Instant) -> Self {
        Self { of, end, run: Duration::ZERO, seen: Some(now) }
    }

    /// What it replays.
    pub(super) fn of(&self) -> Replayed {
        self.of
    }

    /// The value at its end.
    pub(super) fn end(&self) -> f32 {
        self.end
    }

    /// The value that it shows.
    pub(super) fn value(&self) -> f32 {
        self.end * (self.run.as_secs_f32() / LENGTH.as_secs_f32()).min(1.0)
    }

    /// Whether it does not pause.
    pub(super) fn is_running(&self) -> bool {
        self.seen.is_some()
    }

    /// Whether the last value has been reached.
    pub(super) fn is_over(&self) -> bool {
        self.run >= LENGTH
    }

    /// Goes on from now, or pauses.
    pub(super) fn play(&mut self, from: Option<Instant>) {
        self.seen = from;
    }

    /// When the next value is due; `None` while it pauses.
    pub(super) fn next_at(&self) -> Option<Instant> {
        self.seen.map(|seen| seen + FRAME)
    }

    /// Moves on to now, if the next value is due; whether it was.
    pub(super) fn follow(&mut self, now: Instant) -> bool {
        let Some(seen) = self.seen.filter(|seen| now >= *seen + FRAME) else { return false };
        self.seen = Some(now);
        self.run += now - seen;
        true
    }

    /// Moves on by a time, whatever the clock says, which stands still from here on.
    #[cfg(test)]
    pub(super) fn advance(&mut self, by: Duration) {
        self.run += by;
        self.seen = self.seen.map(|_| Instant::now() + 1000 * LENGTH);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_replay_follows_the_clock_and_pauses() {
        let begun = Instant::now();
        let mut replay = Replay::begin(Replayed::Age, 40.0, begun);
        assert!(!replay.follow(begun + FRAME / 2) && replay.value() == 0.0, "too early");
        assert!(replay.follow(begun + LENGTH / 2));
        assert!((replay.value() - 20.0).abs() < 1e-3 && !replay.is_over());
        replay.play(None);
        assert!(!replay.follow(begun + LENGTH) && replay.next_at().is_none());
        replay.play(Some(begun + LENGTH));
        assert!(replay.follow(begun + 2 * LENGTH) && replay.is_over() && replay.value() == 40.0);
    }
}
