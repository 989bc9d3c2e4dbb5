//! How far the flowers have opened: a slider from bud to full bloom, and a button that lets them open before the artist's eyes.

use super::icons::Icon;
use super::rail::{Rail, Scale};
use super::snapshot::Snapshot;
use super::widgets::{IconButton, section};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use egui::Ui;

/// The parameter that the slider sets.
pub const OPEN: &str = "flower.open";

/// The opening of flowers in layers; nothing where there are none.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let Some(opening) = snapshot.opening else { return };
    section(ui, messages.get(Msg::OpeningTitle), |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let (icon, msg) = match opening.playing {
                true => (Icon::Pause, Msg::OpeningPause),
                false => (Icon::Play, Msg::OpeningPlay),
            };
            let can_play = opening.playing || opening.open > 0.0;
            if IconButton::new(icon, messages.get(msg)).enabled(can_play).show(ui).clicked() {
                out.push(Action::PlayOpening(!opening.playing));
            }
            let text = words(opening.open, messages);
            let scale = Scale { min: 0.0, max: 1.0, whole: false };
            let label = messages.get(Msg::OpeningOf);
            let reset = opening.chosen.then(|| messages.get(Msg::OpeningBySpecies));
            let rail = Rail { label, text: &text, scale, value: f64::from(opening.open), reset };
            out.extend(rail.set(ui, OPEN));
        });
    });
}

/// An opening in words.
fn words(open: f32, messages: &Messages) -> String {
    match (open * 100.0).round() {
        0.0 => messages.get(Msg::OpeningBud).to_owned(),
        100.0 => messages.get(Msg::OpeningFull).to_owned(),
        percent => messages.fill(Msg::OpeningShare, &[("percent", &percent.to_string())]),
    }
}
