//! The plants beside the drawn one: a list to select from, and what can be changed of the selected one.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale, number};
use super::seed::{self, SeedEdit};
use super::snapshot::{BesideState, Dialog, PlantState, Snapshot};
use super::widgets::{IconButton, note, palette, section, text_button, text_button_sized};
use super::{export, species_grid, thumbnails};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::app::theme::{ROUND, TARGET};
use crate::sketch::{Maker, PlacedPlant, SeedOf};
use crate::species::Species;
use egui::{Align2, CornerRadius, Id, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle};
use egui::{Ui, WidgetInfo, pos2, vec2};

/// Heights on the slider, percent of the sheet's.
const HEIGHTS: (f64, f64) = (1.0, 400.0);
/// Places on the slider, percent of the sheet's width.
const PLACES: (f64, f64) = (-100.0, 200.0);

/// The list, and the selected plant.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::BesideTitle), |ui| {
        let BesideState { plants, selected, .. } = &snapshot.beside;
        for (place, state) in plants.iter().enumerate() {
            let is_selected = *selected == Some(place);
            row(ui, place, state, is_selected, messages, out);
            if is_selected {
                ui.push_id(("plant beside", place), |ui| details(ui, place, state, snapshot, messages, out));
            }
        }
        let width = ui.available_width();
        let add = text_button_sized(ui, Some(Icon::Plant), messages.get(Msg::BesideAdd), false, Some(width));
        if add.clicked() {
            out.push(Action::ShowDialog(Dialog::PlantSpecies(None)));
        }
    });
}

/// Whether a plant is selected that was not when this was asked last.
pub(super) fn selection_changed(ui: &Ui, snapshot: &Snapshot) -> bool {
    let (at, now) = (Id::unique("plant beside that was selected"), snapshot.beside.selected);
    let before: Option<usize> = ui.data(|data| data.get_temp(at)).unwrap_or_default();
    ui.data_mut(|data| data.insert_temp(at, now));
    now.is_some() && now != before
}

/// A plant's name with its age, to be selected and taken away.
fn row(
    ui: &mut Ui,
    place: usize,
    state: &PlantState,
    is_selected: bool,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let species = state.plant.maker.species();
    let name = messages.name(Named::Species, species);
    let years = match has_age(species) {
        true => messages.fill(Msg::GrowthYears, &[("count", &shown_age(state))]),
        false => String::new(),
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let width = ui.available_width() - TARGET;
        if line(ui, width, species, (&name, &years), is_selected).clicked() {
            out.push(Action::SelectPlant((!is_selected).then_some(place)));
        }
        let label = messages.fill(Msg::BesideRemove, &[("name", &name)]);
        if IconButton::new(Icon::Delete, &label).colour(palette(ui).weak).show(ui).clicked() {
            out.push(Action::RemovePlant(place));
        }
    });
}

/// The line of a plant: picture, name, and a note at the end.
fn line(ui: &mut Ui, width: f32, species: &str, (name, end): (&str, &str), is_selected: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, TARGET), Sense::click());
    let p = palette(ui);
    let corner = CornerRadius::same(ROUND);
    if is_selected || response.hovered() {
        ui.painter().rect_filled(rect, corner, if is_selected { p.accent_soft } else { p.card });
    }
    if is_selected {
        ui.painter().rect_stroke(rect, corner, Stroke::new(1.0, p.accent), StrokeKind::Inside);
    }
    if let Some(picture) = thumbnails::of_species(ui.ctx(), species) {
        let square = Rect::from_min_size(rect.min, vec2(TARGET, TARGET)).shrink(4.0);
        egui::Image::new(&picture).corner_radius(ROUND - 3).paint_at(ui, square);
    }
    let clipped = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let (font, small) = (TextStyle::Button.resolve(ui.style()), TextStyle::Small.resolve(ui.style()));
    let left = pos2(rect.left() + TARGET + 4.0, rect.center().y);
    clipped.text(left, Align2::LEFT_CENTER, name, font, p.text);
    let right = pos2(rect.right() - 8.0, rect.center().y);
    clipped.text(right, Align2::RIGHT_CENTER, end, small, p.weak);
    let label = if end.is_empty() { name.to_owned() } else { format!("{name}, {end}") };
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_selected, &label));
    response
}

/// Everything that can be changed of a plant.
fn details(
    ui: &mut Ui,
    place: usize,
    state: &PlantState,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let PlacedPlant { maker: Maker::Growth(seed), foot, height } = &state.plant;
    let name = messages.name(Named::Species, &seed.species);
    let label = messages.fill(Msg::BesideSpecies, &[("name", &name)]);
    let width = ui.available_width();
    if text_button_sized(ui, None, &label, false, Some(width)).clicked() {
        out.push(Action::ShowDialog(Dialog::PlantSpecies(Some(place))));
    }
    let mut set = |plant: PlacedPlant| out.push(Action::SetPlant { place, plant });
    let of_seed = |seed: SeedOf| PlacedPlant { maker: Maker::Growth(seed), ..state.plant.clone() };
    if has_age(&seed.species)
        && let Some(age) = age(ui, state, seed.age.is_some(), messages)
    {
        set(of_seed(SeedOf { age, ..seed.clone() }));
    }
    let [sheet_width, sheet_height] = snapshot.beside.sheet;
    let tall = state.height.unwrap_or_default() / sheet_height * 100.0;
    let reset = (height.is_some(), Msg::BesideOwnHeight);
    match percent(ui, (Msg::BesideHeight, Msg::BesideOfSheet), tall, HEIGHTS, reset, messages) {
        Some(RailChange::To(percent)) => {
            let height = Some(percent as f32 / 100.0 * sheet_height);
            set(PlacedPlant { height, ..state.plant.clone() });
        }
        Some(RailChange::Reset) => set(PlacedPlant { height: None, ..state.plant.clone() }),
        None => {}
    }
    let across = foot.x / sheet_width * 100.0;
    let reset = ((across - 50.0).abs() > 0.01, Msg::BesideMiddle);
    let moved = percent(ui, (Msg::BesidePlace, Msg::BesideOfSheet), across, PLACES, reset, messages);
    if let Some(moved) = moved {
        let share = match moved {
            RailChange::To(percent) => percent as f32 / 100.0,
            RailChange::Reset => 0.5,
        };
        let foot = glam::Vec2::new(share * sheet_width, foot.y);
        set(PlacedPlant { foot, ..state.plant.clone() });
    }
    match seed::row(ui, seed.seed, messages) {
        Some(SeedEdit::Roll) => out.push(Action::RollPlantSeed(place)),
        Some(SeedEdit::To(number)) => {
            let plant = of_seed(SeedOf { seed: number, ..seed.clone() });
            out.push(Action::SetPlant { place, plant });
        }
        None => {}
    }
    note(ui, messages.get(Msg::BesideMoveHint));
    ui.add_space(6.0);
}

/// Years with one decimal at most.
fn shown_age(state: &PlantState) -> String {
    number((f64::from(state.age) * 10.0).round() / 10.0)
}

/// Whether plants of a species have an age: roses and single flowers have none.
fn has_age(species: &str) -> bool {
    Species::growing().contains(&species)
}

/// The slider of the age; the new age when it was changed.
fn age(ui: &mut Ui, state: &PlantState, is_chosen: bool, messages: &Messages) -> Option<Option<f32>> {
    let text = messages.fill(Msg::GrowthYears, &[("count", &shown_age(state))]);
    let scale = Scale { min: 0.0, max: f64::from(state.most_age), whole: false };
    let reset = is_chosen.then(|| messages.get(Msg::BesideOwnAge));
    let rail =
        Rail { label: messages.get(Msg::GrowthAge), text: &text, scale, value: state.age.into(), reset };
    let width = ui.available_width();
    match rail.show(ui, width).1? {
        RailChange::To(years) => Some(Some(years as f32)),
        RailChange::Reset => Some(None),
    }
}

/// A slider in percent.
fn percent(
    ui: &mut Ui,
    (label, unit): (Msg, Msg),
    value: f32,
    (min, max): (f64, f64),
    (can_reset, reset): (bool, Msg),
    messages: &Messages,
) -> Option<RailChange> {
    let value = f64::from(value);
    let text = messages.fill(unit, &[("percent", &number((value * 10.0).round() / 10.0))]);
    let scale = Scale { min, max, whole: false };
    let reset = can_reset.then(|| messages.get(reset));
    let rail = Rail { label: messages.get(label), text: &text, scale, value, reset };
    let width = ui.available_width();
    rail.show(ui, width).1
}

/// The dialog that asks for the species of a new plant, or of one that is there.
pub(super) fn dialog(
    ui: &mut Ui,
    place: Option<usize>,
    screen_height: f32,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let of_place = place.and_then(|place| snapshot.beside.plants.get(place));
    if place.is_none() {
        note(ui, messages.get(Msg::BesideAddHint));
    }
    let chosen = of_place.map(|state| state.plant.maker.species());
    if let Some(name) = species_grid::by_themselves(ui, screen_height, chosen, messages) {
        out.push(Action::CloseDialog);
        out.push(match (place, of_place) {
            (Some(place), Some(state)) => {
                let Maker::Growth(seed) = state.plant.maker.clone();
                // Another species has another usual age.
                let maker = Maker::Growth(SeedOf { species: name.to_owned(), age: None, ..seed });
                Action::SetPlant { place, plant: PlacedPlant { maker, ..state.plant.clone() } }
            }
            _ => Action::AddPlant(name.to_owned()),
        });
    }
    ui.add_space(10.0);
    export::buttons(ui, |ui| {
        if text_button(ui, None, messages.get(Msg::DialogCancel), false).clicked() {
            out.push(Action::CloseDialog);
        }
    });
}
