//! The tool that turns, bends, straightens, moves and grafts parts of the plant, as the bar below the plant shows it.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale};
use super::snapshot::PoseState;
use super::widgets::{IconButton, note};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::pose_drag::PoseDrag;
use crate::modelling::OnContact;
use crate::sketch::part_poses::THICKNESSES;
use egui::Ui;

/// What a drag may do: its picture, name and help.
const DRAGS: [(PoseDrag, Icon, Msg, Msg); 6] = [
    (PoseDrag::Turn, Icon::TurnBranch, Msg::PoseTurn, Msg::PoseTurnHint),
    (PoseDrag::Bend, Icon::BendBranch, Msg::PoseBend, Msg::PoseBendHint),
    (PoseDrag::Move, Icon::SlideLeaf, Msg::PoseMove, Msg::PoseMoveHint),
    (PoseDrag::Graft, Icon::GraftBranch, Msg::PoseGraft, Msg::PoseGraftHint),
    (PoseDrag::Replace, Icon::ReplaceOrgan, Msg::PoseReplace, Msg::PoseReplaceHint),
    (PoseDrag::Choose, Icon::Lasso, Msg::PoseChoose, Msg::PoseChooseHint),
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
    contact(ui, state.on_contact, messages, out);
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
    if state.chosen > 1 {
        note(ui, &messages.fill(Msg::PoseChosen, &[("count", &state.chosen)]));
    }
}

/// What becomes of wood that meets other wood: it passes through, stops, or slides along, one after the other with each press.
fn contact(ui: &mut Ui, now: OnContact, messages: &Messages, out: &mut Vec<Action>) {
    let stop = (Icon::StopAtWood, Msg::PoseStop, Msg::PoseStopHint);
    let slide = (Icon::SlideAlongWood, Msg::PoseSlide, Msg::PoseSlideHint);
    let ((icon, name, hint), next) = match now {
        OnContact::Pass => (stop, OnContact::Stop),
        OnContact::Stop => (stop, OnContact::Slide),
        OnContact::Slide => (slide, OnContact::Pass),
    };
    let (name, hint) = (messages.get(name), messages.get(hint));
    let button = IconButton::new(icon, name).hint(format!("{name}\n{hint}"));
    if button.chosen(now != OnContact::Pass).show(ui).clicked() {
        out.push(Action::MeetWood(next));
    }
}

/// How thick or large the part that was held last is, how straight a branch, and how many years younger on a plant that grew.
pub(super) fn rails(ui: &mut Ui, state: &PoseState, messages: &Messages, out: &mut Vec<Action>) {
    if !state.on {
        return;
    }
    // Without a part, too, so that the picture above stays where it is when one is tapped.
    let (min, max) = THICKNESSES.into_inner();
    let size_name = if state.is_organ { Msg::PoseSize } else { Msg::PoseThickness };
    let size = (size_name, state.size, Scale { min: min.into(), max: max.into(), whole: false }, 1.0);
    let straight = (Msg::PoseStraight, state.straight, Scale { min: 0.0, max: 1.0, whole: false }, 0.0);
    let room = 0.5 * (ui.available_width() - ui.spacing().item_spacing.x);
    ui.horizontal(|ui| {
        let size = share(ui, size, room, messages);
        let straight = share(ui, straight, room, messages);
        out.extend(size.map(Action::SizePart));
        out.extend(straight.map(Action::StraightenPart));
    });
    if state.years > 0 {
        out.extend(younger(ui, state, messages));
    }
}

/// How many years younger than it is a branch is shown; another number, if one is chosen.
fn younger(ui: &mut Ui, state: &PoseState, messages: &Messages) -> Option<Action> {
    let now = state.younger.unwrap_or(0);
    let text = messages.fill(Msg::GrowthYears, &[("count", &now)]);
    let scale = Scale { min: 0.0, max: state.years.into(), whole: true };
    let reset = (now > 0).then(|| messages.get(Msg::PoseReset));
    let rail = Rail { label: messages.get(Msg::PoseYounger), text: &text, scale, value: now.into(), reset };
    let room = ui.available_width();
    let change = ui.add_enabled_ui(state.younger.is_some(), |ui| rail.show(ui, room).1).inner;
    change.map(|change| match change {
        RailChange::To(years) => Action::MakePartYounger(years as u16),
        RailChange::Reset => Action::MakePartYounger(0),
    })
}

/// A share of the part in percent, usually `usual`; its new value, if there is one.
fn share(
    ui: &mut Ui,
    (name, value, scale, usual): (Msg, Option<f32>, Scale, f32),
    room: f32,
    messages: &Messages,
) -> Option<f32> {
    let now = value.unwrap_or(usual);
    let text = format!("{:.0} %", now * 100.0);
    let reset = (now != usual).then(|| messages.get(Msg::PoseReset));
    let rail = Rail { label: messages.get(name), text: &text, scale, value: now.into(), reset };
    let change = ui.add_enabled_ui(value.is_some(), |ui| rail.show(ui, room).1).inner;
    change.map(|change| match change {
        RailChange::To(value) => value as f32,
        RailChange::Reset => usual,
    })
}

/// What a drag does now.
pub(super) fn said(state: &PoseState) -> Msg {
    match state.drag {
        PoseDrag::Turn => Msg::PoseDrag,
        PoseDrag::Bend => Msg::PoseDragBend,
        PoseDrag::Move => Msg::PoseDragMove,
        PoseDrag::Graft => Msg::PoseDragGraft,
        PoseDrag::Replace => Msg::PoseDragReplace,
        PoseDrag::Choose => Msg::PoseDragChoose,
    }
}
