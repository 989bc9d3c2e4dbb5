//! Messages on the screen: each once, a few at a time, and no longer than they are needed.
//!
//! Information goes after [`INFO_STAYS`], warnings when they can have been read. A message with something to decide stays until
//! the artist puts it away: a failure, and whatever says what can be done or offers to do it. Nothing goes while the
//! pointer is over it. What is said again while it is still shown is not said twice; it stays as long as if it were new.

use crate::app::panels::snapshot::{Notice, Severity};
use std::time::{Duration, Instant};

/// How long information stays on the screen.
const INFO_STAYS: Duration = Duration::from_secs(6);
/// How long a warning stays: until it is seen, and then for each of its characters.
const SEEN: Duration = Duration::from_secs(8);
const PER_CHARACTER: Duration = Duration::from_millis(70);
/// Most messages that wait to be read; of more the oldest go.
const MOST: usize = 50;

/// The messages that wait to be read, oldest first.
#[derive(Debug, Default)]
pub(super) struct Notices {
    waiting: Vec<(Notice, Instant)>,
    count: u64,
}

impl Notices {
    /// Adds a message, or keeps the equal one that is there.
    pub(super) fn add(&mut self, notice: Notice, now: Instant) {
        let same = |shown: &Notice| (&shown.what, &shown.remedy) == (&notice.what, &notice.remedy);
        if let Some((_, since)) = self.waiting.iter_mut().find(|(shown, _)| same(shown)) {
            *since = now;
            return;
        }
        self.count += 1;
        self.waiting.push((Notice { id: self.count, ..notice }, now));
        if self.waiting.len() > MOST {
            self.waiting.remove(0);
        }
    }

    /// Puts a message away.
    pub(super) fn dismiss(&mut self, id: u64) {
        self.waiting.retain(|(notice, _)| notice.id != id);
    }

    /// Keeps a message that is being looked at.
    pub(super) fn hold(&mut self, id: u64, now: Instant) {
        let held = self.waiting.iter_mut().filter(|(notice, _)| notice.id == id);
        held.for_each(|(_, since)| *since = now);
    }

    /// Lets those go that have been on the screen for long enough.
    pub(super) fn let_go(&mut self, now: Instant) {
        self.waiting.retain(|(notice, since)| stay(notice).is_none_or(|stay| now < *since + stay));
    }

    /// When the next one goes by itself.
    pub(super) fn next_goes_at(&self) -> Option<Instant> {
        self.waiting.iter().filter_map(|(notice, since)| Some(*since + stay(notice)?)).min()
    }

    /// All of them, oldest first.
    pub(super) fn iter(&self) -> impl DoubleEndedIterator<Item = &Notice> {
        self.waiting.iter().map(|(notice, _)| notice)
    }
}

/// How long a message stays; `None` until the artist puts it away.
fn stay(notice: &Notice) -> Option<Duration> {
    let decides = notice.find.is_some() || !notice.remedy.is_empty();
    match notice.severity {
        _ if decides => None,
        Severity::Info => Some(INFO_STAYS),
        Severity::Warning => Some(SEEN + PER_CHARACTER * notice.what.chars().count() as u32),
        Severity::Error => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::panels::snapshot::PathPurpose;

    fn words(notices: &Notices) -> Vec<&str> {
        notices.iter().map(|notice| notice.what.as_str()).collect()
    }

    #[test]
    fn a_repeated_message_is_shown_once() {
        let (mut notices, now) = (Notices::default(), Instant::now());
        for _ in 0..9 {
            notices.add(Notice::error("no", ""), now);
            notices.add(Notice::warning("odd", ""), now);
        }
        assert_eq!(words(&notices), ["no", "odd"]);
        for number in 0..200 {
            notices.add(Notice::error(number.to_string(), ""), now);
        }
        assert_eq!((words(&notices).len(), words(&notices).last()), (MOST, Some(&"199")));
    }

    #[test]
    fn only_what_needs_a_decision_stays() {
        let (mut notices, now) = (Notices::default(), Instant::now());
        notices.add(Notice::info("done"), now);
        notices.add(Notice::warning("odd", ""), now);
        notices.add(Notice::warning("odd, but", "do this"), now);
        let find = Some(PathPurpose::Reference);
        notices.add(Notice { find, ..Notice::warning("missing", "") }, now);
        notices.add(Notice::error("no", ""), now);
        assert_eq!(notices.next_goes_at(), Some(now + INFO_STAYS));
        notices.let_go(now + INFO_STAYS);
        assert_eq!(words(&notices), ["odd", "odd, but", "missing", "no"]);
        notices.let_go(now + Duration::from_secs(3600));
        assert_eq!(words(&notices), ["odd, but", "missing", "no"]);
        assert_eq!(notices.next_goes_at(), None);
    }

    #[test]
    fn a_message_under_the_pointer_stays_and_a_long_one_can_be_read() {
        let (mut notices, now) = (Notices::default(), Instant::now());
        notices.add(Notice::info("done"), now);
        let id = notices.iter().next().unwrap().id;
        notices.hold(id, now + INFO_STAYS / 2);
        notices.let_go(now + INFO_STAYS);
        assert_eq!(words(&notices), ["done"]);
        let long = Notice::warning("word ".repeat(100), "");
        assert!(stay(&long).unwrap() > Duration::from_secs(40));
    }
}
