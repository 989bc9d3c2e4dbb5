//! The tool that draws branches in space, as the bar below the plant shows it: the tool, and the surface that it draws on.

use super::icons::Icon;
use super::snapshot::SpaceState;
use super::widgets::IconButton;
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::work_surface::WorkSurface;
use egui::Ui;

/// The surfaces in their order, each with what it is called and what it is for.
const SURFACES: [(WorkSurface, Icon, Msg, Msg); 3] = [
    (WorkSurface::Facing, Icon::FacingSurface, Msg::SpaceFacing, Msg::SpaceFacingHint),
    (WorkSurface::Level, Icon::LevelSurface, Msg::SpaceLevel, Msg::SpaceLevelHint),
    (WorkSurface::Lifted, Icon::LiftedSurface, Msg::SpaceLifted, Msg::SpaceLiftedHint),
];

/// The tool, and while it is in hand its surfaces.
pub(super) fn button(ui: &mut Ui, state: &SpaceState, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::SpaceDraw);
    let hint = format!("{name} (W)\n{}", messages.get(Msg::SpaceDrawHint));
    if IconButton::new(Icon::SpaceBranch, name).hint(hint).chosen(state.on).show(ui).clicked() {
        out.push(Action::DrawInSpace(!state.on));
    }
}

/// The surfaces that it draws on.
pub(super) fn options(ui: &mut Ui, state: &SpaceState, messages: &Messages, out: &mut Vec<Action>) {
    for (surface, icon, name, hint) in SURFACES {
        let name = messages.get(name);
        let button = IconButton::new(icon, name).hint(format!("{name}\n{}", messages.get(hint)));
        let is_there = surface != WorkSurface::Lifted || state.can_lift;
        if button.enabled(is_there).chosen(state.surface == surface).show(ui).clicked() {
            out.push(Action::SetWorkSurface(surface));
        }
    }
}

/// What the pen does now.
pub(super) fn said(state: &SpaceState) -> Msg {
    match state.surface {
        WorkSurface::Facing | WorkSurface::Level => Msg::SpaceBegin,
        WorkSurface::Lifted => Msg::SpaceLift,
    }
}
