//! Which of several sources a pen is read from, when more than one reports it.
//!
//! A tablet that is read directly mostly moves the system's pointer as well, as a pen or as a mouse. Of all that points, one
//! thing is in range at a time; a pen takes over from a mouse that does not press, never the other way round. Between the
//! system's pen and a tablet read directly the artist's choice decides: left to itself the system's pen is preferred,
//! because it knows which monitor the tablet covers, and a tablet that the system was once seen to serve is not read
//! directly any more. Nothing is taken over while it touches, so that no stroke has two ends.
//!
//! What comes out obeys [`super::grammar`] if every way in does: a pen that is shut out has left, one that is let in again enters.
//! Fingers pass; the palm gate is their judge.

use super::{PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Which way pens come in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PenSource {
    /// The window system's pens, and tablets that it does not know read directly.
    #[default]
    Auto,
    /// Only what the window system says.
    System,
    /// Every tablet directly; the window system's pens are ignored while one of them is in range.
    Raw,
}

/// The way by which an event came.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// The system's mouse.
    Mouse,
    /// A pen of the window system.
    System,
    /// A tablet read directly, by its number.
    Direct(u32),
}

/// Milliseconds after a pen left during which what looks like a mouse may still be its shadow.
const SHADOW_MS: f64 = 150.0;

/// Lets one thing at a time point.
#[derive(Clone, Debug)]
pub struct Arbiter {
    source: PenSource,
    /// What is in range, and its last sample.
    owner: Option<(Origin, PenSample)>,
    /// Tablets that the system was seen to serve.
    served: BTreeSet<u32>,
    /// When a tablet read directly last left.
    left_ms: f64,
}

impl Default for Arbiter {
    fn default() -> Self {
        Self::new(PenSource::default())
    }
}

impl Arbiter {
    /// One that obeys this choice.
    pub fn new(source: PenSource) -> Self {
        Self { source, owner: None, served: BTreeSet::new(), left_ms: f64::NEG_INFINITY }
    }

    /// Obeys another choice from now on.
    pub fn set_source(&mut self, source: PenSource) {
        if std::mem::replace(&mut self.source, source) != source {
            self.served.clear();
        }
    }

    /// What is in range.
    pub fn owner(&self) -> Option<Origin> {
        self.owner.map(|(origin, _)| origin)
    }

    /// Takes an event and appends what passes of it: nothing, the event, or two where one thing takes over from
    /// another.
    pub fn pass(&mut self, event: PenEvent, origin: Origin, out: &mut Vec<PenEvent>) {
        if matches!(event.sample.tool, PenTool::Finger(_)) {
            return out.push(event);
        }
        if self.owner() != Some(origin) && !self.take_over(&event, origin, out) {
            return;
        }
        let is_known = self.owner.is_some_and(|(_, last)| last.tool == event.sample.tool);
        let phase = match event.phase {
            // Let in again in the middle of something.
            PenPhase::Hover if !is_known => PenPhase::Enter,
            PenPhase::Down if !is_known => {
                let buttons = PenButtons { primary: false, ..event.sample.buttons };
                let sample = PenSample { pressure: 0.0, buttons, ..event.sample };
                out.push(PenEvent { phase: PenPhase::Enter, sample });
                PenPhase::Down
            }
            PenPhase::Enter if is_known => PenPhase::Hover,
            phase if is_known || phase == PenPhase::Enter => phase,
            _ => return,
        };
        let event = PenEvent { phase, ..event };
        out.push(event);
        if matches!(phase, PenPhase::Leave | PenPhase::Cancel) {
            self.leave(event.sample.time_ms);
        } else {
            self.owner = Some((origin, event.sample));
        }
    }

    /// Whether something else than the owner may pass with this event; the owner leaves.
    fn take_over(&mut self, event: &PenEvent, origin: Origin, out: &mut Vec<PenEvent>) -> bool {
        let now_ms = event.sample.time_ms;
        self.learn(origin);
        let may = match (origin, self.owner()) {
            (Origin::Direct(_), _) if self.source == PenSource::System => false,
            (Origin::Direct(tablet), _)
                if self.source == PenSource::Auto && self.served.contains(&tablet) =>
            {
                false
            }
            (Origin::Mouse, None) => now_ms - self.left_ms >= SHADOW_MS,
            (_, None) | (Origin::System | Origin::Direct(_), Some(Origin::Mouse)) => true,
            (Origin::Mouse, Some(_)) => false,
            (Origin::System, Some(Origin::Direct(_))) => self.source != PenSource::Raw,
            (Origin::Direct(_), Some(Origin::System)) => self.source == PenSource::Raw,
            (Origin::Direct(_), Some(Origin::Direct(_))) | (Origin::System, Some(Origin::System)) => false,
        };
        let is_free = self.owner.is_none_or(|(_, last)| !last.buttons.primary);
        let begins = matches!(event.phase, PenPhase::Enter | PenPhase::Hover | PenPhase::Down);
        if !(may && is_free && begins) {
            return false;
        }
        if let Some((_, last)) = self.owner.take() {
            let time_ms = now_ms.max(last.time_ms);
            let sample = PenSample { time_ms, pressure: 0.0, buttons: PenButtons::default(), ..last };
            out.push(PenEvent { phase: PenPhase::Leave, sample });
        }
        true
    }

    /// A tablet and a pen of the system that are in range together are one and the same.
    fn learn(&mut self, origin: Origin) {
        match (origin, self.owner()) {
            (Origin::System, Some(Origin::Direct(tablet)))
            | (Origin::Direct(tablet), Some(Origin::System)) => {
                self.served.insert(tablet);
            }
            _ => {}
        }
    }

    fn leave(&mut self, now_ms: f64) {
        if let Some((Origin::Direct(_), _)) = self.owner.take() {
            self.left_ms = now_ms;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::grammar::Grammar;
    use crate::pen::tests::{Hand, random_hand};
    use PenPhase::*;
    use glam::DVec2;
    use proptest::prelude::*;

    const MOUSE: (Origin, PenTool) = (Origin::Mouse, PenTool::Mouse);
    const SYSTEM: (Origin, PenTool) = (Origin::System, PenTool::Pen);
    const DIRECT: (Origin, PenTool) = (Origin::Direct(7), PenTool::Pen);

    /// What passes of a run of events, one every 10 ms: phases and whose.
    fn passed(source: PenSource, events: &[((Origin, PenTool), PenPhase)]) -> Vec<(PenTool, PenPhase, f64)> {
        let (mut arbiter, mut out) = (Arbiter::new(source), Vec::new());
        for (k, ((origin, tool), phase)) in events.iter().enumerate() {
            // Each way in points elsewhere, so that the places tell them apart.
            let x = match origin {
                Origin::Mouse => 1.0,
                Origin::System => 2.0,
                Origin::Direct(_) => 3.0,
            };
            let mut hand = Hand { position: DVec2::new(x, 0.0), ..Hand::default() };
            arbiter.pass(hand.event(*phase, *tool, 10.0 * k as f64), *origin, &mut out);
        }
        out.iter().map(|e| (e.sample.tool, e.phase, e.sample.position.x)).collect()
    }

    fn places(passed: &[(PenTool, PenPhase, f64)], phase: PenPhase) -> Vec<f64> {
        passed.iter().filter(|h| h.1 == phase).map(|h| h.2).collect()
    }

    #[test]
    fn left_to_itself_the_systems_pen_passes() {
        let both = [
            (DIRECT, Enter),
            (SYSTEM, Enter),
            (DIRECT, Down),
            (SYSTEM, Down),
            (DIRECT, Up),
            (SYSTEM, Up),
            (DIRECT, Leave),
            (SYSTEM, Leave),
            (DIRECT, Enter),
            (SYSTEM, Enter),
            (DIRECT, Down),
            (SYSTEM, Down),
        ];
        assert_eq!(places(&passed(PenSource::Auto, &both), Down), [2.0, 2.0]);
        assert_eq!(places(&passed(PenSource::System, &both), Down), [2.0, 2.0]);
        assert_eq!(places(&passed(PenSource::Raw, &both), Down), [3.0, 3.0]);
    }

    #[test]
    fn a_tablet_that_the_system_takes_for_a_mouse_is_read_directly() {
        let shadowed = [
            (MOUSE, Enter),
            (MOUSE, Hover),
            (DIRECT, Enter),
            (MOUSE, Hover),
            (DIRECT, Down),
            (MOUSE, Down),
            (DIRECT, Move),
            (MOUSE, Move),
            (DIRECT, Up),
            (MOUSE, Up),
            (DIRECT, Leave),
            (MOUSE, Hover),
        ];
        let passed = passed(PenSource::Auto, &shadowed);
        assert_eq!(places(&passed, Down), [3.0]);
        let phases: Vec<_> = passed.iter().map(|h| (h.2, h.1)).collect();
        assert_eq!(phases[..4], [(1.0, Enter), (1.0, Hover), (1.0, Leave), (3.0, Enter)]);
        assert_eq!(phases.last(), Some(&(3.0, Leave)), "the shadow of the pen is no mouse");
    }

    #[test]
    fn a_touching_pen_keeps_its_stroke() {
        let late =
            [(DIRECT, Enter), (DIRECT, Down), (SYSTEM, Enter), (SYSTEM, Down), (DIRECT, Move), (DIRECT, Up)];
        let passed = passed(PenSource::Auto, &late);
        assert_eq!(places(&passed, Move), [3.0]);
        assert_eq!(places(&passed, Down), [3.0]);
    }

    #[test]
    fn a_mouse_draws_again_when_the_pen_is_away() {
        let (mut arbiter, mut out, mut hand) = (Arbiter::new(PenSource::Raw), Vec::new(), Hand::default());
        for (phase, time_ms) in [(Enter, 0.0), (Leave, 10.0)] {
            arbiter.pass(hand.event(phase, PenTool::Pen, time_ms), Origin::Direct(1), &mut out);
        }
        for time_ms in [20.0, 500.0] {
            arbiter.pass(hand.event(Hover, PenTool::Mouse, time_ms), Origin::Mouse, &mut out);
        }
        let phases: Vec<_> = out.iter().map(|e| (e.sample.tool, e.phase)).collect();
        assert_eq!(phases, [(PenTool::Pen, Enter), (PenTool::Pen, Leave), (PenTool::Mouse, Enter)]);
    }

    #[test]
    fn a_mouse_that_rested_in_the_pens_shadow_clicks() {
        let click = [(MOUSE, Enter), (DIRECT, Enter), (DIRECT, Leave), (MOUSE, Hover)];
        let (mut arbiter, mut out) = (Arbiter::new(PenSource::Auto), Vec::new());
        for (time_ms, ((origin, tool), phase)) in click.into_iter().enumerate() {
            arbiter.pass(Hand::default().event(phase, tool, time_ms as f64), origin, &mut out);
        }
        out.clear();
        arbiter.pass(Hand::default().event(Down, PenTool::Mouse, 900.0), Origin::Mouse, &mut out);
        assert_eq!(out.iter().map(|e| e.phase).collect::<Vec<_>>(), [Enter, Down]);
    }

    proptest! {
        #[test]
        fn several_ways_in_at_once_come_out_as_one(
            runs in prop::collection::vec((0u8..3, random_hand(60)), 2..4),
            order in prop::collection::vec(0usize..4, 0..200),
            source in prop_oneof![Just(PenSource::Auto), Just(PenSource::System), Just(PenSource::Raw)],
        ) {
            let (mut arbiter, mut grammar, mut out) = (Arbiter::new(source), Grammar::default(), Vec::new());
            let fits = |kind: u8, tool: PenTool| match kind {
                0 => tool == PenTool::Mouse,
                _ => matches!(tool, PenTool::Pen | PenTool::Eraser),
            };
            let mut queues: Vec<_> = runs
                .into_iter()
                .enumerate()
                .map(|(n, (kind, events))| {
                    let origin = match kind {
                        0 => Origin::Mouse,
                        1 => Origin::System,
                        _ => Origin::Direct(n as u32),
                    };
                    let events = events.into_iter().filter(move |e| fits(kind, e.sample.tool));
                    (origin, events.collect::<Vec<_>>().into_iter())
                })
                .collect();
            // Two mice or two pens of the system cannot be told apart.
            queues.dedup_by_key(|(origin, _)| *origin);
            queues.sort_by_key(|(origin, _)| *origin);
            queues.dedup_by_key(|(origin, _)| *origin);
            for (time, k) in order.into_iter().enumerate() {
                let count = queues.len();
                let (origin, events) = &mut queues[k % count];
                if let Some(mut event) = events.next() {
                    event.sample.time_ms = 20.0 * time as f64;
                    arbiter.pass(event, *origin, &mut out);
                }
            }
            for event in &out {
                if let Err(broken) = grammar.accept(event) {
                    prop_assert!(false, "{broken}");
                }
            }
            prop_assert!(grammar.touching().count() <= 1);
        }
    }
}
