//! Actions of keys, dials and rings of tablets that are read directly.
//!
//! A key acts once, when it goes down; a dial acts once for each notch.

use super::action::Action;
use super::canvas_tool::CanvasTool;
use super::tablet_keys::{KeyUse, TabletKeys, WheelUse};
use crate::pen::hid::HidEvent;
use crate::pen::ring::{Ring, Strip};
use crate::sketch::Tool;

/// Rings, and strips, that are told apart.
const WHEELS: usize = 2;

/// What is held on one tablet.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeldKeys {
    held: u32,
    rings: [Ring; WHEELS],
    strips: [Strip; WHEELS],
}

impl HeldKeys {
    /// Handles an event of a tablet and appends the actions that follow.
    pub fn handle(&mut self, event: &HidEvent, uses: &TabletKeys, out: &mut Vec<Action>) {
        match *event {
            HidEvent::Keys(held) => {
                let pressed = held & !std::mem::replace(&mut self.held, held);
                let uses = uses.keys.iter().enumerate().filter(|(key, _)| pressed >> key & 1 == 1);
                out.extend(uses.filter_map(|(_, usage)| action(*usage)));
            }
            HidEvent::Dial { notches, .. } => turn(i32::from(notches), uses.wheel, out),
            HidEvent::Ring { number, place, places } => {
                if let Some(ring) = self.rings.get_mut(usize::from(number)) {
                    turn(ring.turn(place, places), uses.wheel, out);
                }
            }
            HidEvent::Strip { number, place, .. } => {
                if let Some(strip) = self.strips.get_mut(usize::from(number)) {
                    turn(strip.slide(place), uses.wheel, out);
                }
            }
            HidEvent::Pen(_) | HidEvent::Touch { .. } | HidEvent::Battery(_) => {}
        }
    }
}

fn turn(notches: i32, usage: WheelUse, out: &mut Vec<Action>) {
    if notches == 0 {
        return;
    }
    match usage {
        WheelUse::Nothing => {}
        WheelUse::Zoom => out.push(Action::Zoom(notches)),
        WheelUse::History => {
            let action = if notches > 0 { Action::Redo } else { Action::Undo };
            out.extend((0..notches.unsigned_abs()).map(|_| action.clone()));
        }
    }
}

/// The action of a key.
fn action(usage: KeyUse) -> Option<Action> {
    Some(match usage {
        KeyUse::Nothing => return None,
        KeyUse::Undo => Action::Undo,
        KeyUse::Redo => Action::Redo,
        KeyUse::ZoomIn => Action::Zoom(1),
        KeyUse::ZoomOut => Action::Zoom(-1),
        KeyUse::Fit => Action::FitCanvas,
        KeyUse::Draw => Action::SetTool(CanvasTool::Draw(Tool::Auto)),
        KeyUse::Erase => Action::SetTool(CanvasTool::Erase { partial: false }),
        KeyUse::ErasePartly => Action::SetTool(CanvasTool::Erase { partial: true }),
        KeyUse::Select => Action::SetTool(CanvasTool::Select),
        KeyUse::Pan => Action::SetTool(CanvasTool::Pan),
        KeyUse::Save => Action::Save,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn actions(events: &[HidEvent], uses: &TabletKeys) -> Vec<Action> {
        let (mut keys, mut out) = (HeldKeys::default(), Vec::new());
        events.iter().for_each(|event| keys.handle(event, uses, &mut out));
        out
    }

    #[test]
    fn a_key_acts_when_it_goes_down() {
        let uses = TabletKeys::default();
        let events = [1, 3, 2, 0, 1 << 5].map(HidEvent::Keys);
        assert_eq!(actions(&events, &uses), [Action::Undo, Action::Redo, Action::Zoom(-1)]);
        let beyond = [1 << 11, 1 << 12, !0xFFF].map(HidEvent::Keys);
        assert_eq!(actions(&beyond, &uses), []);
    }

    #[test]
    fn dials_and_rings_do_the_same() {
        let dial = |notches| HidEvent::Dial { number: 0, notches };
        let ring = |place| HidEvent::Ring { number: 1, place, places: 12 };
        let uses = TabletKeys::default();
        assert_eq!(actions(&[dial(2), dial(-1)], &uses), [Action::Zoom(2), Action::Zoom(-1)]);
        assert_eq!(actions(&[ring(Some(4)), ring(Some(6)), ring(None)], &uses), [Action::Zoom(2)]);
        let history = TabletKeys { wheel: WheelUse::History, ..uses };
        assert_eq!(actions(&[dial(-2), dial(1)], &history), [Action::Undo, Action::Undo, Action::Redo]);
        let strip = |place| HidEvent::Strip { number: 0, place, places: 13 };
        assert_eq!(actions(&[strip(Some(4)), strip(Some(2)), strip(None)], &uses), [Action::Zoom(-2)]);
        let nothing = TabletKeys { wheel: WheelUse::Nothing, ..uses };
        assert_eq!(actions(&[dial(1), HidEvent::Ring { number: 9, place: None, places: 0 }], &nothing), []);
    }

    #[test]
    fn every_use_but_nothing_gives_an_action() {
        for usage in KeyUse::ALL {
            assert_eq!(action(usage).is_none(), usage == KeyUse::Nothing, "{usage:?}");
        }
    }
}
