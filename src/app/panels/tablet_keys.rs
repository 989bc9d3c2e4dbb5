//! What the keys and wheels of a tablet that is read directly do.

use super::widgets::{list, note, segments};
use crate::app::messages::{Messages, Msg};
use crate::app::tablet_keys::{KeyUse, TabletKeys, WheelUse};
use egui::Ui;

/// A choice for each key, in two columns, and one for dials and rings.
pub(super) fn show(ui: &mut Ui, uses: &mut TabletKeys, messages: &Messages) {
    note(ui, messages.get(Msg::TabletKeysHint));
    let half = uses.keys.len().div_ceil(2);
    let mut numbered = (1..).zip(&mut uses.keys).collect::<Vec<(usize, &mut KeyUse)>>();
    ui.columns_const(|[left, right]| {
        for (number, usage) in numbered.drain(..half) {
            key(left, number, usage, messages);
        }
        for (number, usage) in numbered.drain(..) {
            key(right, number, usage, messages);
        }
    });
    note(ui, messages.get(Msg::TabletWheel));
    let choices = [
        (WheelUse::Zoom, messages.get(Msg::TabletZoom)),
        (WheelUse::History, messages.get(Msg::TabletHistory)),
        (WheelUse::Nothing, messages.get(Msg::UseNothing)),
    ];
    if let Some(wheel) = segments(ui, &choices, uses.wheel) {
        uses.wheel = wheel;
    }
}

fn key(ui: &mut Ui, number: usize, usage: &mut KeyUse, messages: &Messages) {
    let label = messages.fill(Msg::TabletKey, &[("number", &number)]);
    let choices = KeyUse::ALL.map(|one| (one, messages.get(name(one))));
    if let Some(new) = list(ui, (&label, 0.3), &choices, *usage) {
        *usage = new;
    }
}

fn name(usage: KeyUse) -> Msg {
    match usage {
        KeyUse::Nothing => Msg::UseNothing,
        KeyUse::Undo => Msg::EditUndo,
        KeyUse::Redo => Msg::EditRedo,
        KeyUse::ZoomIn => Msg::TabletZoomIn,
        KeyUse::ZoomOut => Msg::TabletZoomOut,
        KeyUse::Fit => Msg::TabletFit,
        KeyUse::Draw => Msg::TabletDraw,
        KeyUse::Erase => Msg::UseErase,
        KeyUse::ErasePartly => Msg::UseErasePartly,
        KeyUse::Select => Msg::TabletSelect,
        KeyUse::Pan => Msg::UsePan,
        KeyUse::Save => Msg::FileSave,
    }
}
