//! How old the plant is: a slider over its years, and a button that lets it grow before the artist's eyes.

use super::icons::Icon;
use super::rail::{Rail, Scale, number};
use super::snapshot::Snapshot;
use super::widgets::{IconButton, note, section, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use egui::Ui;
use serde_json::Value;

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
            let rail = Rail { label, text: &text, scale, value, changed: growth.chosen };
            let room = ui.available_width().max(TARGET);
            if let Some(years) = rail.show(ui, room).1 {
                out.push(Action::SetParam { path: YEARS.to_owned(), value: Some(Value::from(years)) });
            }
        });
        if growth.chosen {
            let msg = if growth.crown { Msg::GrowthInCrown } else { Msg::GrowthByItself };
            let width = ui.available_width();
            if text_button_sized(ui, Some(Icon::Reset), messages.get(msg), false, Some(width)).clicked() {
                out.push(Action::SetParam { path: YEARS.to_owned(), value: None });
            }
        } else if !growth.crown {
            note(ui, messages.get(Msg::GrowthHint));
        }
    });
}
