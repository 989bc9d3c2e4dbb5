//! How the plant is shown: light, what it is shown as, camera.

use super::export::level_sets;
use super::icons::Icon;
use super::plant_search;
use super::rail::{Rail, RailChange, Scale, number};
use super::snapshot::{LevelsState, LightChoice, ReferenceState, Shading, Snapshot};
use super::status::grouped;
use super::widgets::{note, palette, section, segments, switch, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use crate::growth::habit::Resource;
use crate::growth::overlay::Wanted;
use egui::{Color32, Role, Sense, Stroke, Ui, WidgetInfo, vec2};
use std::fmt::Display;

/// Colours of the sun: kelvin, and the swatch that stands for it, linear RGB.
const COLOURS: [(Msg, f32, [f32; 3]); 4] = [
    (Msg::ViewColourPink, 3600.0, [1.0, 0.72, 0.52]),
    (Msg::ViewColourWarm, 5500.0, [1.0, 0.93, 0.83]),
    (Msg::ViewColourDay, 6500.0, [1.0, 1.0, 1.0]),
    (Msg::ViewColourCool, 9000.0, [0.80, 0.90, 1.0]),
];

/// View of the plant, and the reference picture under the drawing.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::ViewShading), |ui| {
        let choices = [
            (Shading::Shaded, messages.get(Msg::ViewShaded)),
            (Shading::Wireframe, messages.get(Msg::ViewWireframe)),
            (Shading::Parts, messages.get(Msg::ViewParts)),
        ];
        out.extend(segments(ui, &choices, snapshot.view.shading).map(Action::SetShading));
        let orthographic = switch(ui, messages.get(Msg::ViewOrthographic), snapshot.view.orthographic);
        out.extend(orthographic.map(Action::SetOrthographic));
        let outdoors = switch(ui, messages.get(Msg::ViewOutdoors), snapshot.view.outdoors);
        out.extend(outdoors.map(Action::SetOutdoors));
        let turntable = switch(ui, messages.get(Msg::ViewTurntable), snapshot.view.turntable);
        out.extend(turntable.map(Action::SetTurntable));
        let walking = switch(ui, messages.get(Msg::ViewWalk), snapshot.view.walking);
        out.extend(walking.map(Action::Walk));
        let mut button = |icon, msg, action| {
            let width = ui.available_width();
            if text_button_sized(ui, Some(icon), messages.get(msg), false, Some(width)).clicked() {
                out.push(action);
            }
        };
        button(Icon::Plant, Msg::EditFront, Action::FrontView);
        button(Icon::Picture, Msg::ViewCopyPicture, Action::CopyPicture);
    });
    if let Some(growth) = snapshot.growth {
        section(ui, messages.get(Msg::ViewInside), |ui| {
            inside(ui, snapshot.view.overlay, growth.resource, messages, out);
        });
    }
    section(ui, messages.get(Msg::ViewLight), |ui| light(ui, &snapshot.view.light, messages, out));
    if !snapshot.blank {
        section(ui, messages.get(Msg::ViewLevels), |ui| levels(ui, &snapshot.levels, messages, out));
    }
    if let Some(state) = snapshot.reference {
        section(ui, messages.get(Msg::ReferenceTitle), |ui| {
            reference(ui, state, messages, out);
            plant_search::show(ui, snapshot, messages, out);
        });
    }
}

/// Levels of detail: which of them are shown, how far away the plant is, each of them with its triangles.
fn levels(ui: &mut Ui, state: &LevelsState, messages: &Messages, out: &mut Vec<Action>) {
    let sets = level_sets(messages);
    out.extend(segments(ui, &sets, state.set).map(Action::ShowLevels));
    if state.set.is_none() {
        return;
    }
    let width = ui.available_width();
    if let Some((metres, (nearest, farthest))) = state.distance {
        let scale = Scale { min: nearest.into(), max: farthest.into(), whole: false };
        let (label, text) = (messages.get(Msg::ViewDistance), metres_text(metres));
        let rail = Rail { label, text: &text, scale, value: metres.into(), reset: None };
        if let Some(RailChange::To(metres)) = rail.show(ui, width).1 {
            out.push(Action::SetDistance(metres as f32));
        }
    }
    if state.levels.is_empty() {
        return note(ui, messages.get(Msg::ViewLevelsComing));
    }
    for (number, level) in state.levels.iter().enumerate() {
        let (count, up_to) = (grouped(level.triangles), metres_text(level.up_to));
        let of_level = [("number", &number as &dyn Display), ("count", &count), ("distance", &up_to)];
        let (text, is_shown) = (messages.fill(Msg::ViewLevel, &of_level), number == state.shown);
        if text_button_sized(ui, None, &text, is_shown, Some(width)).clicked() {
            out.push(Action::HoldLevel((!(is_shown && state.is_held)).then_some(number)));
        }
    }
    note(ui, messages.get(if state.is_held { Msg::ViewLevelHeld } else { Msg::ViewLevelHint }));
}

/// A distance as people read it.
fn metres_text(metres: f32) -> String {
    let digits = if metres < 10.0 { 2 } else { 0 };
    format!("{metres:.digits$} m")
}

/// What is seen of growth, and what its colours mean.
fn inside(
    ui: &mut Ui,
    wanted: Wanted,
    resource: Option<Resource>,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let mut one = |on: bool, name: Msg, hint: Msg, with: fn(Wanted, bool) -> Wanted| {
        let changed = switch(ui, messages.get(name), on);
        out.extend(changed.map(|on| Action::SetOverlay(with(wanted, on))));
        if on {
            note(ui, messages.get(hint));
        }
    };
    let hint = if resource == Some(Resource::Light) { Msg::ViewNoMarkers } else { Msg::ViewMarkersHint };
    one(wanted.markers, Msg::ViewMarkers, hint, |wanted, markers| Wanted { markers, ..wanted });
    one(wanted.buds, Msg::ViewBuds, Msg::ViewBudsHint, |wanted, buds| Wanted { buds, ..wanted });
    let hint = if resource == Some(Resource::Space) { Msg::ViewNoShade } else { Msg::ViewShadeHint };
    one(wanted.light, Msg::ViewShade, hint, |wanted, light| Wanted { light, ..wanted });
}

fn light(ui: &mut Ui, light: &LightChoice, messages: &Messages, out: &mut Vec<Action>) {
    let start = LightChoice::default();
    let differs = |a: f32, b: f32| (a - b).abs() > 1e-4;
    let rail = |ui: &mut Ui, msg, value: f32, first: f32, (min, max): (f32, f32), unit: &str| {
        let scale = Scale { min: f64::from(min), max: f64::from(max), whole: false };
        let text = format!("{}{unit}", scale.text(f64::from(value)));
        let label = messages.get(msg);
        let reset = messages.fill(
            Msg::ParamsReset,
            &[("name", &label), ("value", &format!("{}{unit}", number(f64::from(first))))],
        );
        let reset = differs(value, first).then_some(reset.as_str());
        let width = ui.available_width();
        match (Rail { label, text: &text, scale, value: f64::from(value), reset }).show(ui, width).1? {
            RailChange::To(value) => Some(value as f32),
            RailChange::Reset => Some(first),
        }
    };
    let (from, height, strength) = (light.azimuth_deg, light.elevation_deg, light.strength);
    if let Some(azimuth_deg) =
        rail(ui, Msg::ViewAzimuth, from, start.azimuth_deg, LightChoice::AZIMUTHS_DEG, "°")
    {
        out.push(Action::SetLight(LightChoice { azimuth_deg, ..*light }));
    }
    if let Some(elevation_deg) =
        rail(ui, Msg::ViewElevation, height, start.elevation_deg, LightChoice::ELEVATIONS_DEG, "°")
    {
        out.push(Action::SetLight(LightChoice { elevation_deg, ..*light }));
    }
    if let Some(strength) = rail(ui, Msg::ViewStrength, strength, start.strength, LightChoice::STRENGTHS, "×")
    {
        out.push(Action::SetLight(LightChoice { strength, ..*light }));
    }
    ui.label(messages.get(Msg::ViewColour));
    ui.horizontal(|ui| {
        let width = (ui.available_width() - 8.0 * (COLOURS.len() - 1) as f32) / COLOURS.len() as f32;
        for (msg, temperature_k, colour) in COLOURS {
            let chosen = !differs(light.temperature_k, temperature_k);
            if swatch(ui, width, messages.get(msg), colour, chosen) {
                out.push(Action::SetLight(LightChoice { temperature_k, ..*light }));
            }
        }
    });
    // Always there, so that nothing moves.
    ui.add_enabled_ui(*light != start, |ui| {
        let width = ui.available_width();
        let label = messages.get(Msg::ViewResetLight);
        if text_button_sized(ui, Some(Icon::Reset), label, false, Some(width)).clicked() {
            out.push(Action::SetLight(start));
        }
    });
}

fn swatch(ui: &mut Ui, width: f32, name: &str, colour: [f32; 3], chosen: bool) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(width, TARGET), Sense::click());
    let p = palette(ui);
    let [r, g, b] = colour;
    let fill = Color32::from(egui::Rgba::from_rgb(r, g, b));
    let line = if chosen { Stroke::new(3.0, p.accent) } else { Stroke::new(1.0, p.line) };
    ui.painter().rect(rect, 9, fill, line, egui::StrokeKind::Inside);
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, chosen, name));
    response.on_hover_text(name).clicked()
}

fn reference(ui: &mut Ui, state: ReferenceState, messages: &Messages, out: &mut Vec<Action>) {
    let scale = Scale { min: 0.0, max: 100.0, whole: true };
    let value = f64::from(state.opacity * 100.0);
    let text = format!("{} %", scale.text(value));
    let width = ui.available_width();
    let rail = Rail { label: messages.get(Msg::ReferenceOpacity), text: &text, scale, value, reset: None };
    if let Some(RailChange::To(percent)) = rail.show(ui, width).1 {
        out.push(Action::SetReferenceOpacity(percent as f32 / 100.0));
    }
    out.extend(switch(ui, messages.get(Msg::ReferenceLock), state.locked).map(Action::LockReference));
    if text_button_sized(ui, Some(Icon::Delete), messages.get(Msg::ReferenceRemove), false, Some(width))
        .clicked()
    {
        out.push(Action::RemoveReference);
    }
}
