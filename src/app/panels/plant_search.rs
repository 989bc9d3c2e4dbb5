//! Finding the plant on the picture under the drawing, among what the panel shows of that picture.

use super::icons::Icon;
use super::snapshot::{PlantSearchState, Snapshot};
use super::widgets::{note, segments, switch, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::plant_search::PlantMark;
use egui::Ui;

/// The switch, and while it is on what the pen marks and what becomes of the plant.
pub(super) fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let state = snapshot.plant_search;
    out.extend(switch(ui, messages.get(Msg::ReferenceFindPlant), state.on).map(Action::FindPlant));
    if state.on {
        note(ui, messages.get(Msg::ReferenceFindPlantHint));
        let marks = [
            (PlantMark::Plant, messages.get(Msg::ReferenceMarkPlant)),
            (PlantMark::Around, messages.get(Msg::ReferenceMarkAround)),
            (PlantMark::Outline, messages.get(Msg::ReferenceMarkOutline)),
        ];
        out.extend(segments(ui, &marks, state.mark).map(Action::MarkPlant));
        note(ui, &progress(state, messages));
    }
    let mut button = |ui: &mut Ui, icon, name, hint, loud, action| {
        let width = ui.available_width();
        let button = text_button_sized(ui, Some(icon), messages.get(name), loud, Some(width));
        let button = if let Some(hint) = hint { button.on_hover_text(messages.get(hint)) } else { button };
        if button.clicked() {
            out.push(action);
        }
    };
    if state.on && state.share.is_some() {
        let hint = Some(Msg::ReferenceUseAsCrownHint);
        button(ui, Icon::Crown, Msg::ReferenceUseAsCrown, hint, true, Action::UseAsCrown);
    }
    if state.share.is_some() {
        let hint = Some(Msg::ReferencePlantColoursHint);
        button(ui, Icon::Leaf, Msg::ReferencePlantColours, hint, false, Action::ColoursFromPicture);
    }
    if let Some(branch) = state.branch {
        let hint = Some(Msg::ReferenceSnapHint);
        button(ui, Icon::Branch, Msg::ReferenceSnap, hint, false, Action::SnapToTrunk(branch));
    }
    if state.on && state.any_marks {
        button(ui, Icon::Delete, Msg::ReferenceClearMarks, None, false, Action::ClearPlantMarks);
    }
}

fn progress(state: PlantSearchState, messages: &Messages) -> String {
    match state.share {
        _ if state.is_searching => messages.get(Msg::ReferenceSearching).to_owned(),
        Some(share) => messages.fill(Msg::ReferenceFound, &[("share", &format!("{share:.0}"))]),
        None => messages.get(Msg::ReferenceNotFound).to_owned(),
    }
}
