//! The tool that turns and bends branches, as the card over the plant shows it.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale};
use super::snapshot::PoseState;
use super::widgets::IconButton;
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::sketch::wood_poses::THICKNESSES;
use egui::Ui;

/// The tool, and while it is in hand what it does.
pub(super) fn buttons(ui: &mut Ui, state: &PoseState, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::PoseWood);
    let hint = format!("{name} (J)\n{}", messages.get(Msg::PoseWoodHint));
    if IconButton::new(Icon::TurnBranch, name).hint(hint).chosen(state.on).show(ui).clicked() {
        out.push(Action::PoseWood(!state.on));
    }
    if !state.on {
        return;
    }
    let name = messages.get(Msg::PoseBend);
    let bend =
        IconButton::new(Icon::BendBranch, name).hint(format!("{name}\n{}", messages.get(Msg::PoseBendHint)));
    if bend.chosen(state.bends).show(ui).clicked() {
        out.push(Action::BendWood(!state.bends));
    }
    let reset = IconButton::new(Icon::Reset, messages.get(Msg::PoseReset)).enabled(state.posed);
    if reset.show(ui).clicked() {
        out.push(Action::ResetPose);
    }
    let name = messages.get(Msg::PoseCut);
    let cut =
        IconButton::new(Icon::Cut, name).hint(format!("{name} (Del)\n{}", messages.get(Msg::PoseCutHint)));
    if cut.enabled(state.thickness.is_some()).show(ui).clicked() {
        out.push(Action::CutWood);
    }
}

/// How thick the branch that was held last is.
pub(super) fn rails(ui: &mut Ui, state: &PoseState, messages: &Messages, out: &mut Vec<Action>) {
    let Some(thickness) = state.thickness.filter(|_| state.on) else { return };
    let text = format!("{:.0} %", thickness * 100.0);
    let (min, max) = THICKNESSES.into_inner();
    let rail = Rail {
        label: messages.get(Msg::PoseThickness),
        text: &text,
        scale: Scale { min: min.into(), max: max.into(), whole: false },
        value: thickness.into(),
        reset: (thickness != 1.0).then(|| messages.get(Msg::PoseReset)),
    };
    let room = ui.available_width();
    out.extend(rail.show(ui, room).1.map(|change| match change {
        RailChange::To(value) => Action::ThickenWood(value as f32),
        RailChange::Reset => Action::ThickenWood(1.0),
    }));
}

/// What a drag does now.
pub(super) fn said(state: &PoseState) -> Msg {
    if state.bends { Msg::PoseDragBend } else { Msg::PoseDrag }
}
