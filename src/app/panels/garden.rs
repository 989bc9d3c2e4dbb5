//! The tool that paints a garden on the ground, as the bar below the plant shows it: what the brush paints, of which species, how wide
//! and how densely.

use super::icons::Icon;
use super::snapshot::{Dialog, GardenState, PathPurpose, Snapshot};
use super::widgets::{IconButton, note, text_button};
use super::{export, rail, species_grid};
use crate::app::action::Action;
use crate::app::garden_brush::{GardenBrush, GardenBrushKind};
use crate::app::messages::{Messages, Msg, Named};
use crate::sketch::{BRUSH_DENSITIES, GardenPlant};
use egui::Ui;

/// Width from which sliders stand side by side.
const SIDE_BY_SIDE: f32 = 340.0;

/// Letters of a drawing's name on a button.
const LONGEST_NAME: usize = 16;

/// What the brush paints, each with what it is called and what it is for.
const KINDS: [(GardenBrushKind, Icon, Msg, Msg); 4] = [
    (GardenBrushKind::Plants, Icon::GardenPlants, Msg::GardenPlants, Msg::GardenPlantsHint),
    (GardenBrushKind::Path, Icon::GardenPath, Msg::GardenPath, Msg::GardenPathHint),
    (GardenBrushKind::Clear, Icon::GardenClear, Msg::GardenClear, Msg::GardenClearHint),
    (GardenBrushKind::Erase, Icon::Eraser, Msg::GardenErase, Msg::GardenEraseHint),
];

/// The tool.
pub(super) fn button(ui: &mut Ui, state: &GardenState, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::Garden);
    let hint = format!("{name} (N)\n{}", messages.get(Msg::GardenHint));
    if IconButton::new(Icon::Garden, name).hint(hint).chosen(state.on).show(ui).clicked() {
        out.push(Action::PaintGarden(!state.on));
    }
}

/// Walks through the garden.
fn walk_button(ui: &mut Ui, walks: bool, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.get(Msg::ViewWalk);
    let hint = format!("{name} (Q)\n{}", messages.get(Msg::ViewWalkHint));
    if IconButton::new(Icon::Walk, name).hint(hint).chosen(walks).show(ui).clicked() {
        out.push(Action::Walk(!walks));
    }
}

/// What its brush paints, and the walk through what was painted.
pub(super) fn options(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let (state, walks) = (&snapshot.garden, snapshot.view.walking);
    walk_button(ui, walks, messages, out);
    for (kind, icon, name, hint) in KINDS {
        let name = messages.get(name);
        let button = IconButton::new(icon, name).hint(format!("{name}\n{}", messages.get(hint)));
        if button.chosen(state.brush.kind == kind && !walks).show(ui).clicked() {
            out.push(Action::SetGardenBrush(GardenBrush { kind, ..state.brush.clone() }));
        }
    }
    if state.brush.kind == GardenBrushKind::Plants {
        let label = named(&state.brush.plant, messages);
        if text_button(ui, Some(Icon::Plant), &label, false).clicked() {
            out.push(Action::ShowDialog(Dialog::GardenSpecies));
        }
    }
}

/// How the brush is set, side by side: what of its settings means anything.
pub(super) fn rails(ui: &mut Ui, state: &GardenState, messages: &Messages, out: &mut Vec<Action>) {
    if !state.on || state.brush.kind == GardenBrushKind::Erase {
        return;
    }
    let (now, usual) = (&state.brush, GardenBrush::default());
    let plants = now.kind == GardenBrushKind::Plants;
    let slider = |ui: &mut Ui, msg: Msg, range: (f32, f32), text: &str, values: (f32, f32)| {
        rail::setting(ui, (messages.get(msg), text), range, values, messages.get(Msg::BrushReset))
    };
    let columns = if ui.available_width() < SIDE_BY_SIDE { 1 } else { 2 };
    ui.columns(columns, |columns| {
        let width = format!("{:.2} m", 2.0 * now.radius);
        let values = (now.radius, state.usual_radius);
        let radius = slider(&mut columns[0], Msg::GardenWidth, GardenBrush::RADII, &width, values);
        out.extend(radius.map(|radius| Action::SetGardenBrush(GardenBrush { radius, ..now.clone() })));
        if let Some((age, name)) = state.age.zip(species(&now.plant)).filter(|_| plants) {
            let text = messages.fill(Msg::GrowthYears, &[("count", &format!("{:.0}", age.years))]);
            let (range, values) = ((0.0, age.most), (age.years, age.own));
            if let Some(years) = slider(&mut columns[0], Msg::GrowthAge, range, &text, values) {
                let age = (years != age.own).then_some(years.round());
                let plant = GardenPlant::Species { name: name.to_owned(), age };
                out.push(Action::SetGardenBrush(GardenBrush { plant, ..now.clone() }));
            }
        }
        let Some(beside) = columns.last_mut().filter(|_| plants) else { return };
        let percent = format!("{:.0} %", now.density * 100.0);
        let (range, values) = (BRUSH_DENSITIES.into_inner(), (now.density, usual.density));
        let density = slider(beside, Msg::BrushDensity, range, &percent, values);
        out.extend(density.map(|density| Action::SetGardenBrush(GardenBrush { density, ..now.clone() })));
    });
}

/// What the pen does now.
pub(super) fn said(state: &GardenState) -> Msg {
    match state.brush.kind {
        GardenBrushKind::Plants => Msg::GardenPlanting,
        GardenBrushKind::Path => Msg::GardenPaving,
        GardenBrushKind::Clear => Msg::GardenClearing,
        GardenBrushKind::Erase => Msg::GardenErasing,
    }
}

fn named(plant: &GardenPlant, messages: &Messages) -> String {
    match plant {
        GardenPlant::Drawn => messages.get(Msg::GardenDrawn).to_owned(),
        GardenPlant::Species { name, .. } => messages.name(Named::Species, name),
        GardenPlant::Drawing(drawing) => shortened(drawing.name()),
    }
}

/// As much of a name as a button has room for.
fn shortened(name: &str) -> String {
    match name.char_indices().nth(LONGEST_NAME) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

/// The dialog that chooses the species of the plants.
pub(super) fn dialog(
    ui: &mut Ui,
    screen_height: f32,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    note(ui, messages.get(Msg::GardenSpeciesHint));
    let GardenState { brush, drawings, .. } = &snapshot.garden;
    let mut choose = |plant: GardenPlant| {
        out.extend([Action::CloseDialog, Action::SetGardenBrush(GardenBrush { plant, ..brush.clone() })]);
    };
    if let Some(name) = species_grid::by_themselves(ui, screen_height, species(&brush.plant), messages) {
        choose(GardenPlant::species(name));
    }
    ui.add_space(10.0);
    let own = std::iter::once(GardenPlant::Drawn).chain(drawings.iter().cloned().map(GardenPlant::Drawing));
    ui.horizontal_wrapped(|ui| {
        for plant in own {
            if text_button(ui, Some(Icon::Plant), &named(&plant, messages), brush.plant == plant).clicked() {
                choose(plant);
            }
        }
    });
    ui.add_space(10.0);
    export::buttons(ui, |ui| {
        if text_button(ui, None, messages.get(Msg::DialogCancel), false).clicked() {
            out.push(Action::CloseDialog);
        }
        if text_button(ui, Some(Icon::Open), messages.get(Msg::GardenOther), false).clicked() {
            out.push(Action::ChooseFile(PathPurpose::GardenDrawing));
        }
    });
}

/// The species of what is planted, where it has one.
fn species(plant: &GardenPlant) -> Option<&str> {
    match plant {
        GardenPlant::Species { name, .. } => Some(name),
        GardenPlant::Drawn | GardenPlant::Drawing(_) => None,
    }
}
