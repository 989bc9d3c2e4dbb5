//! The tool that shapes petals: its part of the bar below the plant, and numbers of the point that was touched last on the side.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale};
use super::snapshot::{PetalPoint, PetalState, Snapshot};
use super::widgets::{IconButton, section};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::sketch::limits;
use egui::Ui;
use glam::Vec3;

/// The tool, and while it is in hand what it does.
pub(super) fn button(ui: &mut Ui, state: &PetalState, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::PetalsShape);
    let hint = format!("{name} (K)\n{}", messages.get(Msg::PetalsShapeHint));
    if IconButton::new(Icon::Petals, name).hint(hint).chosen(state.on).show(ui).clicked() {
        out.push(Action::ShapePetals(!state.on));
    }
}

/// How it shapes them.
pub(super) fn options(ui: &mut Ui, state: &PetalState, messages: &Messages, out: &mut Vec<Action>) {
    let mirror = IconButton::new(Icon::MirrorLeftRight, messages.get(Msg::PetalsMirror));
    if mirror.chosen(state.mirrored).show(ui).clicked() {
        out.push(Action::MirrorPetals(!state.mirrored));
    }
    let reset = IconButton::new(Icon::Reset, messages.get(Msg::PetalsReset)).enabled(state.shaped);
    if reset.show(ui).clicked() {
        out.push(Action::ResetPetals);
    }
}

/// What the pen does now.
pub(super) fn said(state: &PetalState) -> Msg {
    if state.chosen { Msg::PetalsDrag } else { Msg::PetalsChoose }
}

/// On the side: the numbers of the point that was touched last.
pub fn side(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    if let Some(point) = snapshot.petals.point {
        section(ui, messages.get(Msg::PetalsShape), |ui| numbers(ui, &point, messages, out));
    }
}

/// The point that was touched last, in percent of the petal's length.
fn numbers(ui: &mut Ui, point: &PetalPoint, messages: &Messages, out: &mut Vec<Action>) {
    let most = f64::from(limits::MAX_PETAL_OFFSET) * 100.0;
    let scale = Scale { min: -most, max: most, whole: false };
    let names = [Msg::PetalsAcross, Msg::PetalsAlong, Msg::PetalsFace];
    for (direction, msg) in names.into_iter().enumerate() {
        let mut numbers = point.offset.to_array();
        let value = f64::from(numbers[direction]) * 100.0;
        let text = format!("{} %", scale.text(value));
        let label = messages.get(msg);
        let back = messages.fill(Msg::ParamsReset, &[("name", &label), ("value", &"0 %")]);
        let reset = (numbers[direction] != 0.0).then_some(back.as_str());
        let width = ui.available_width();
        let changed = Rail { label, text: &text, scale, value, reset }.show(ui, width).1;
        numbers[direction] = match changed {
            Some(RailChange::To(percent)) => (percent / 100.0) as f32,
            Some(RailChange::Reset) => 0.0,
            None => continue,
        };
        out.push(Action::SetPetalPoint(Vec3::from(numbers)));
    }
}
