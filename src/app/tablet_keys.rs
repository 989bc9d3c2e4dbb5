//! Keys, dials and rings of tablets that are read directly: what the artist lets them do, and what they wish for when they
//! are pressed or turned.
//!
//! A key wishes once, when it goes down; a dial wishes once for each notch. Uses are kept for each tablet by name, with the
//! other settings of its pen.

use super::action::{Action, CanvasTool};
use crate::pen::hid::HidEvent;
use crate::pen::ring::{Ring, Strip};
use crate::sketch::Tool;
use serde::{Deserialize, Serialize};

/// Keys that can be given a use; those of tablets with more come first to last.
pub const KEYS: usize = 12;
/// Rings, and strips, that are told apart.
const WHEELS: usize = 2;

/// What a key does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum KeyUse {
    /// Nothing.
    #[default]
    Nothing,
    /// Takes the last change back.
    Undo,
    /// Does again what was taken back.
    Redo,
    /// Shows the paper larger.
    ZoomIn,
    /// Shows the paper smaller.
    ZoomOut,
    /// Shows the whole drawing.
    Fit,
    /// Takes up the tool that tells parts by itself.
    Draw,
    /// Takes up the eraser of whole strokes.
    Erase,
    /// Takes up the eraser of what is touched.
    ErasePartly,
    /// Takes up the lasso.
    Select,
    /// Takes up the tool that moves the paper.
    Pan,
    /// Saves the drawing.
    Save,
}

impl KeyUse {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Nothing,
        Self::Undo,
        Self::Redo,
        Self::ZoomIn,
        Self::ZoomOut,
        Self::Fit,
        Self::Draw,
        Self::Erase,
        Self::ErasePartly,
        Self::Select,
        Self::Pan,
        Self::Save,
    ];

    fn action(self) -> Option<Action> {
        Some(match self {
            Self::Nothing => return None,
            Self::Undo => Action::Undo,
            Self::Redo => Action::Redo,
            Self::ZoomIn => Action::Zoom(1),
            Self::ZoomOut => Action::Zoom(-1),
            Self::Fit => Action::FitCanvas,
            Self::Draw => Action::SetTool(CanvasTool::Draw(Tool::Auto)),
            Self::Erase => Action::SetTool(CanvasTool::Erase { partial: false }),
            Self::ErasePartly => Action::SetTool(CanvasTool::Erase { partial: true }),
            Self::Select => Action::SetTool(CanvasTool::Select),
            Self::Pan => Action::SetTool(CanvasTool::Pan),
            Self::Save => Action::Save,
        })
    }
}

/// What dials and rings do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WheelUse {
    /// Shows the paper larger and smaller.
    #[default]
    Zoom,
    /// Takes changes back and does them again.
    History,
    /// Nothing.
    Nothing,
}

/// What the artist lets the keys and wheels of a tablet do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TabletKeys {
    /// Each key, the first of the tablet first.
    pub keys: [KeyUse; KEYS],
    /// Dials and rings.
    pub wheel: WheelUse,
}

impl Default for TabletKeys {
    fn default() -> Self {
        use KeyUse::{Draw, Erase, Fit, Nothing, Redo, Select, Undo, ZoomIn, ZoomOut};
        let keys =
            [Undo, Redo, Draw, Erase, ZoomIn, ZoomOut, Select, Fit, Nothing, Nothing, Nothing, Nothing];
        Self { keys, wheel: WheelUse::Zoom }
    }
}

/// What is held on one tablet.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeldKeys {
    held: u32,
    rings: [Ring; WHEELS],
    strips: [Strip; WHEELS],
}

impl HeldKeys {
    /// Hears what a tablet says and appends what it wishes for.
    pub fn handle(&mut self, event: &HidEvent, uses: &TabletKeys, out: &mut Vec<Action>) {
        match *event {
            HidEvent::Keys(held) => {
                let pressed = held & !std::mem::replace(&mut self.held, held);
                let uses = uses.keys.iter().enumerate().filter(|(key, _)| pressed >> key & 1 == 1);
                out.extend(uses.filter_map(|(_, usage)| usage.action()));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn wishes(events: &[HidEvent], uses: &TabletKeys) -> Vec<Action> {
        let (mut keys, mut out) = (HeldKeys::default(), Vec::new());
        events.iter().for_each(|event| keys.handle(event, uses, &mut out));
        out
    }

    #[test]
    fn a_key_wishes_when_it_goes_down() {
        let uses = TabletKeys::default();
        let events = [1, 3, 2, 0, 1 << 5].map(HidEvent::Keys);
        assert_eq!(wishes(&events, &uses), [Action::Undo, Action::Redo, Action::Zoom(-1)]);
        let beyond = [1 << 11, 1 << 12, !0xFFF].map(HidEvent::Keys);
        assert_eq!(wishes(&beyond, &uses), []);
    }

    #[test]
    fn dials_and_rings_do_the_same() {
        let dial = |notches| HidEvent::Dial { number: 0, notches };
        let ring = |place| HidEvent::Ring { number: 1, place, places: 12 };
        let uses = TabletKeys::default();
        assert_eq!(wishes(&[dial(2), dial(-1)], &uses), [Action::Zoom(2), Action::Zoom(-1)]);
        assert_eq!(wishes(&[ring(Some(4)), ring(Some(6)), ring(None)], &uses), [Action::Zoom(2)]);
        let history = TabletKeys { wheel: WheelUse::History, ..uses };
        assert_eq!(wishes(&[dial(-2), dial(1)], &history), [Action::Undo, Action::Undo, Action::Redo]);
        let strip = |place| HidEvent::Strip { number: 0, place, places: 13 };
        assert_eq!(wishes(&[strip(Some(4)), strip(Some(2)), strip(None)], &uses), [Action::Zoom(-2)]);
        let nothing = TabletKeys { wheel: WheelUse::Nothing, ..uses };
        assert_eq!(wishes(&[dial(1), HidEvent::Ring { number: 9, place: None, places: 0 }], &nothing), []);
    }

    #[test]
    fn every_use_but_nothing_wishes_for_something() {
        for usage in KeyUse::ALL {
            assert_eq!(usage.action().is_none(), usage == KeyUse::Nothing, "{usage:?}");
        }
    }
}
