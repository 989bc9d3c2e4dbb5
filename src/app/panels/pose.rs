//! The tool that turns, bends and moves parts of the plant, as the bar below the plant shows it.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale};
use super::snapshot::PoseState;
use super::widgets::IconButton;
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::pose_drag::PoseDrag;
use crate::sketch::part_poses::THICKNESSES;
use egui::Ui;

/// What a drag may do: its picture, name and help.
const DRAGS: [(PoseDrag, Icon, Msg, Msg); 3] = [
    (PoseDrag::Turn, Icon::TurnBranch, Msg::PoseTurn, Msg::PoseTurnHint),
    (PoseDrag::Bend, Icon::BendBranch, Msg::PoseBend, Msg::PoseBendHint),
    (PoseDrag::Move, Icon::SlideLeaf, Msg::PoseMove, Msg::PoseMoveHint),
];

/// The tool.
pub(super) fn button(ui: &mut Ui, state: &PoseState, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::PoseParts);
    let hint = format!("{name} (J)\n{}", messages.get(Msg::PosePartsHint));
    if IconButton::new(Icon::PoseParts, name).hint(hint).chosen(state.on).show(ui).clicked() {
        out.push(Action::PoseParts(!state.on));
    }
}

/// What a drag with it does, and what else can be done with the part that was held last.
pub(super) fn options(ui: &mut Ui, state: &PoseState, messages: &Messages, out: &mut Vec<Action>) {
    for (drag, icon, name, hint) in DRAGS {
        let (name, hint) = (messages.get(name), messages.get(hint));
        let button = IconButton::new(icon, name).hint(format!("{name}\n{hint}"));
        if button.chosen(state.drag == drag).show(ui).clicked() {
            out.push(Action::PoseBy(drag));
        }
    }
    let reset = IconButton::new(Icon::Reset, messages.get(Msg::PoseReset)).enabled(state.posed);
    if reset.show(ui).clicked() {
        out.push(Action::ResetPose);
    }
    let name = messages.get(Msg::PoseCut);
    let cut =
        IconButton::new(Icon::Cut, name).hint(format!("{name} (Del)\n{}", messages.get(Msg::PoseCutHint)));
    if cut.enabled(state.size.is_some()).show(ui).clicked() {
        out.push(Action::TakeAwayPart);
    }
}

/// How thick or large the part that was held last is.
pub(super) fn rails(ui: &mut Ui, state: &PoseState, messages: &Messages, out: &mut Vec<Action>) {
    if !state.on {
        return;
    }
    // Without a part, too, so that the picture above stays where it is when one is tapped.
    let size = state.size.unwrap_or(1.0);
    let text = format!("{:.0} %", size * 100.0);
    let (min, max) = THICKNESSES.into_inner();
    let rail = Rail {
        label: messages.get(if state.is_organ { Msg::PoseSize } else { Msg::PoseThickness }),
        text: &text,
        scale: Scale { min: min.into(), max: max.into(), whole: false },
        value: size.into(),
        reset: (size != 1.0).then(|| messages.get(Msg::PoseReset)),
    };
    let room = ui.available_width();
    let change = ui.add_enabled_ui(state.size.is_some(), |ui| rail.show(ui, room).1).inner;
    out.extend(change.map(|change| match change {
        RailChange::To(value) => Action::SizePart(value as f32),
        RailChange::Reset => Action::SizePart(1.0),
    }));
}

/// What a drag does now.
pub(super) fn said(state: &PoseState) -> Msg {
    match state.drag {
        PoseDrag::Turn => Msg::PoseDrag,
        PoseDrag::Bend => Msg::PoseDragBend,
        PoseDrag::Move => Msg::PoseDragMove,
    }
}
