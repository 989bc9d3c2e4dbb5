//! The seed, with dice.

use super::icons::Icon;
use super::snapshot::Snapshot;
use super::widgets::{IconButton, section, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use egui::{Label, Ui, vec2};

/// A change of a seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SeedEdit {
    /// Any other one.
    Roll,
    /// This one.
    To(u64),
}

/// The seed of everything random in the plant.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::SeedTitle), |ui| {
        out.extend(row(ui, snapshot.seed, messages).map(|edit| match edit {
            SeedEdit::Roll => Action::RollSeed,
            SeedEdit::To(seed) => Action::SetSeed(seed),
        }));
    });
}

/// Dice, and a seed between those before and after it.
pub(super) fn row(ui: &mut Ui, seed: u64, messages: &Messages) -> Option<SeedEdit> {
    let mut edit = None;
    ui.horizontal(|ui| {
        let dice = (ui.available_width() * 0.48).max(TARGET);
        let roll = text_button_sized(ui, Some(Icon::Dice), messages.get(Msg::SeedRoll), false, Some(dice));
        if roll.on_hover_text(messages.get(Msg::SeedHint)).clicked() {
            edit = Some(SeedEdit::Roll);
        }
        ui.spacing_mut().item_spacing.x = 0.0;
        if IconButton::new(Icon::Minus, messages.get(Msg::SeedLess)).show(ui).clicked() {
            edit = Some(SeedEdit::To(seed.wrapping_sub(1)));
        }
        let number = messages.fill(Msg::SeedNumber, &[("number", &seed)]);
        let room = vec2((ui.available_width() - TARGET).max(0.0), TARGET);
        ui.add_sized(room, Label::new(number.as_str()).truncate()).on_hover_text(number);
        if IconButton::new(Icon::Plus, messages.get(Msg::SeedMore)).show(ui).clicked() {
            edit = Some(SeedEdit::To(seed.wrapping_add(1)));
        }
    });
    edit
}
