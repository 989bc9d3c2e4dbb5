//! The tool that turns and bends branches, as the card over the plant shows it.

use super::icons::Icon;
use super::snapshot::PoseState;
use super::widgets::IconButton;
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
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
}

/// What a drag does now.
pub(super) fn said(state: &PoseState) -> Msg {
    if state.bends { Msg::PoseDragBend } else { Msg::PoseDrag }
}
