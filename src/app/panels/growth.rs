//! How old the plant is: a slider over its years, and a button that lets it grow before the artist's eyes.

use super::icons::Icon;
use super::rail::{Rail, Scale, number};
use super::snapshot::Snapshot;
use super::widgets::{IconButton, note, section};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use egui::Ui;

/// The parameter that the slider sets.
pub const YEARS: &str = "growth.years";

/// The age of a plant that grows; nothing for others.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let Some(growth) = snapshot.growth else { return };
    section(ui, messages.get(Msg::GrowthTitle), |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let (icon, msg) = match growth.playing {
                true => (Icon::Pause, Msg::GrowthPause),
                false => (Icon::Play, Msg::GrowthPlay),
            };
            let can_play = growth.playing || growth.age > 0.0;
            if IconButton::new(icon, messages.get(msg)).enabled(can_play).show(ui).clicked() {
                out.push(Action::PlayGrowth(!growth.playing));
            }
            let scale = Scale { min: 0.0, max: f64::from(growth.most), whole: false };
            let value = f64::from(growth.age);
            let years = number((value * 10.0).round() / 10.0);
            let text = messages.fill(Msg::GrowthYears, &[("count", &years)]);
            let label = messages.get(Msg::GrowthAge);
            let by_itself = if growth.crown { Msg::GrowthInCrown } else { Msg::GrowthByItself };
            let reset = growth.chosen.then(|| messages.get(by_itself));
            let rail = Rail { label, text: &text, scale, value, reset };
            out.extend(rail.set(ui, YEARS));
        });
        if !(growth.crown || snapshot.found.crowns) {
            note(ui, messages.get(Msg::GrowthHint));
        }
    });
}
