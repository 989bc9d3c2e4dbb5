//! The time of the year that the plant is shown at: a slider from breaking buds to winter.

use super::rail::{Rail, Scale};
use super::snapshot::Snapshot;
use super::widgets::section;
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::params::Parameters as _;
use crate::species::SeasonParams;
use egui::Ui;

/// The parameter that the slider sets.
pub const TIME: &str = "season.time";

/// What the whole numbers of the parameter are called.
const NAMES: [Msg; 6] = [
    Msg::SeasonBudding,
    Msg::SeasonSpring,
    Msg::SeasonSummer,
    Msg::SeasonLateSummer,
    Msg::SeasonAutumn,
    Msg::SeasonWinter,
];

/// The season of the plant.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::SeasonTitle), |ui| {
        let &(min, max) = &SeasonParams::RANGES[0];
        let own = snapshot.params.own.get(TIME).copied();
        let usual = f64::from(SeasonParams::default().time);
        let value = own.or_else(|| snapshot.params.species.get(TIME).copied()).unwrap_or(usual);
        let name = NAMES[(value.round() as usize).min(NAMES.len() - 1)];
        let rail = Rail {
            label: messages.get(Msg::SeasonTime),
            text: messages.get(name),
            scale: Scale { min, max, whole: false },
            value,
            reset: own.map(|_| messages.get(Msg::SeasonUsual)),
        };
        out.extend(rail.set(ui, TIME));
    });
}
