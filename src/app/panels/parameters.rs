//! Every parameter of every stage, by its own description: name, value, unit, range, help, and the way back.
//!
//! What the artist changed stands first, then the groups: how the plant looks before how strokes are understood. A search
//! looks through names, help and paths. While something is held the list of changed parameters stays as it is, so that nothing moves under the pen.

use super::icons::Icon;
use super::rail::{Rail, Scale, number};
use super::snapshot::Snapshot;
use super::widgets::{IconButton, note, palette, switch, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::app::theme::TARGET;
use crate::params::{Description, Kind, Parameters as _};
use crate::pipeline::Params;
use egui::{CollapsingHeader, Id, RichText, TextEdit, Ui, vec2};
use serde_json::{Map, Value};
use std::sync::OnceLock;

/// Groups in the order in which an artist comes to them: the plant as a whole, flowers and leaves, branches, what fills
/// outlines, surfaces, and last what only matters where strokes were misunderstood.
const ORDER: [&str; 25] = [
    "depth.world",
    "growth",
    "habit",
    "habit.crown",
    "habit.leaf",
    "habit.light",
    "habit.space",
    "depth.cone",
    "depth.leaves",
    "depth.curl",
    "depth.stem",
    "depth.branches",
    "depth.radii",
    "anatomy.leaf_fill",
    "anatomy.leaf_twigs",
    "anatomy.twigs",
    "model.blade",
    "model.tube",
    "model.solid",
    "anatomy.flowers",
    "anatomy.hierarchy",
    "anatomy.attach",
    "anatomy.tip",
    "anatomy.ignore",
    "anatomy.preprocess",
];

/// Every parameter, group by group; groups that are not in [`ORDER`] come last.
fn known() -> &'static [Description] {
    static KNOWN: OnceLock<Vec<Description>> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let mut all = Params::of_any_species().describe();
        let place = |d: &Description| ORDER.iter().position(|group| *group == group_of(&d.path));
        all.sort_by_key(|d| place(d).unwrap_or(ORDER.len()));
        all
    })
}

/// All parameters.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let text = search(ui, messages);
    if !text.trim().is_empty() {
        found(ui, text.trim(), snapshot, messages, out);
        return;
    }
    changed(ui, snapshot, messages, out);
    let mut rest = known();
    while let Some(first) = rest.first() {
        let group = group_of(&first.path);
        let end = rest.iter().position(|d| group_of(&d.path) != group).unwrap_or(rest.len());
        let (these, others) = rest.split_at(end);
        rest = others;
        if !snapshot.params.applies(&first.path) {
            continue;
        }
        let title = RichText::new(messages.name(Named::Group, group)).size(14.5);
        CollapsingHeader::new(title).id_salt(group).show_unindented(ui, |ui| {
            if group == "habit" && snapshot.growth.is_some_and(|growth| growth.crown) {
                note(ui, messages.get(Msg::ParamsInCrown));
            }
            these.iter().for_each(|one| row(ui, one, snapshot, messages, out));
            ui.add_space(6.0);
        });
    }
}

fn group_of(path: &str) -> &str {
    path.rsplit_once('.').map_or(path, |(group, _)| group)
}

fn search(ui: &mut Ui, messages: &Messages) -> String {
    let at = Id::unique("text that parameters are searched for");
    let mut text: String = ui.data(|data| data.get_temp(at)).unwrap_or_default();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        let clear = if text.is_empty() { 0.0 } else { TARGET + 2.0 };
        let field = TextEdit::singleline(&mut text)
            .hint_text(messages.get(Msg::ParamsSearch))
            .align(egui::Align2::LEFT_CENTER)
            .margin(egui::Margin::symmetric(10, 4));
        let mut edited = ui.add_sized(vec2(ui.available_width() - clear, TARGET), field).changed();
        if clear > 0.0
            && IconButton::new(Icon::Close, messages.get(Msg::ParamsClearSearch)).show(ui).clicked()
        {
            text.clear();
            edited = true;
        }
        if edited {
            ui.data_mut(|data| data.insert_temp(at, text.clone()));
        }
    });
    text
}

fn found(ui: &mut Ui, text: &str, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let wanted = text.to_lowercase();
    let hit = |d: &Description| {
        let group = messages.name(Named::Group, group_of(&d.path));
        let all = [&messages.param_name(&d.path), &messages.param_help(d), &d.path, &group];
        all.into_iter().any(|text| text.to_lowercase().contains(&wanted))
    };
    let mut last = "";
    for one in known().iter().filter(|d| snapshot.params.applies(&d.path) && hit(d)) {
        let group = group_of(&one.path);
        if group != last {
            ui.add_space(4.0);
            note(ui, &messages.name(Named::Group, group));
            last = group;
        }
        row(ui, one, snapshot, messages, out);
    }
    if last.is_empty() {
        note(ui, &messages.fill(Msg::ParamsNoneFound, &[("text", &text)]));
    }
}

fn changed(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let at = Id::unique("changed parameters");
    let mut paths: Vec<String> = ui.data(|data| data.get_temp(at)).unwrap_or_default();
    if !ui.input(|i| i.pointer.any_down()) {
        paths = snapshot.params.own.keys().cloned().collect();
        ui.data_mut(|data| data.insert_temp(at, paths.clone()));
    }
    let applies = |path: &String| paths.contains(path) && snapshot.params.applies(path);
    let these: Vec<_> = known().iter().filter(|d| applies(&d.path)).collect();
    if these.is_empty() {
        return;
    }
    let title = messages.fill(Msg::ParamsChanged, &[("count", &these.len())]);
    let title = RichText::new(title).size(14.5).color(palette(ui).accent);
    CollapsingHeader::new(title).id_salt("changed").default_open(true).show_unindented(ui, |ui| {
        these.into_iter().for_each(|one| row(ui, one, snapshot, messages, out));
        let width = ui.available_width();
        let reset =
            text_button_sized(ui, Some(Icon::Reset), messages.get(Msg::ParamsResetAll), false, Some(width));
        if reset.clicked() {
            out.push(Action::SetParams(Map::new()));
        }
        ui.add_space(6.0);
    });
}

fn row(
    ui: &mut Ui,
    description: &Description,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let (path, kind) = (&description.path, description.kind);
    let base = snapshot.params.species.get(path).copied().unwrap_or(description.default);
    let own = snapshot.params.own.get(path).copied();
    let value = own.unwrap_or(base);
    let name = messages.param_name(path);
    let mut set = |value: Option<Value>| out.push(Action::SetParam { path: path.clone(), value });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let width = ui.available_width() - TARGET;
        if kind == Kind::Switch {
            let shown = ui.allocate_ui(vec2(width, TARGET), |ui| switch(ui, &name, value > 0.5));
            shown.response.on_hover_ui(|ui| help(ui, description, base, messages));
            if let Some(on) = shown.inner {
                set(Some(Value::Bool(on)));
            }
        } else {
            let scale = Scale { min: description.min, max: description.max, whole: kind == Kind::Whole };
            let number = || with_unit(&scale.text(value), description, messages);
            let words = messages.below_zero(path).filter(|_| value < 0.0);
            let text = words.map_or_else(number, str::to_owned);
            let rail = Rail { label: &name, text: &text, scale, value, changed: own.is_some() };
            let (response, moved) = rail.show(ui, width);
            if !response.dragged() {
                response.on_hover_ui(|ui| help(ui, description, base, messages));
            }
            if let Some(new) = moved {
                set(Some(if scale.whole { Value::from(new as u64) } else { Value::from(new) }));
            }
        }
        if own.is_some() {
            let to = value_text(base, description, messages);
            let label = messages.fill(Msg::ParamsReset, &[("name", &name), ("value", &to)]);
            if IconButton::new(Icon::Reset, &label).colour(palette(ui).accent).show(ui).clicked() {
                set(None);
            }
        }
    });
}

fn value_text(value: f64, of: &Description, messages: &Messages) -> String {
    if let Some(words) = messages.below_zero(&of.path).filter(|_| value < 0.0) {
        return words.to_owned();
    }
    match of.kind {
        Kind::Switch if value > 0.5 => messages.get(Msg::ParamsOn).to_owned(),
        Kind::Switch => messages.get(Msg::ParamsOff).to_owned(),
        Kind::Whole => format!("{value:.0}"),
        Kind::Number | Kind::Aged => number(value),
    }
}

fn with_unit(value: &str, description: &Description, messages: &Messages) -> String {
    match description.unit {
        "" => value.to_owned(),
        "degrees" => format!("{value}{}", messages.name(Named::Unit, "degrees")),
        unit => format!("{value} {}", messages.name(Named::Unit, unit)),
    }
}

fn help(ui: &mut Ui, description: &Description, base: f64, messages: &Messages) {
    let kind = description.kind;
    ui.label(messages.param_help(description));
    if kind == Kind::Aged {
        note(ui, messages.get(Msg::ParamsAged));
    }
    let [min, max, default] =
        [description.min, description.max, base].map(|v| value_text(v, description, messages));
    note(ui, &messages.fill(Msg::ParamsRange, &[("min", &min), ("max", &max), ("default", &default)]));
    ui.label(RichText::new(&description.path).monospace().small().color(palette(ui).weak));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_and_switches_are_told_from_numbers() {
        let kind = |path: &str| known().iter().find(|d| d.path == path).unwrap().kind;
        assert_eq!(kind("depth.cone.flip"), Kind::Switch);
        assert_eq!(kind("anatomy.flowers.min_petals"), Kind::Whole);
        assert_eq!(kind("depth.world.height"), Kind::Number);
        assert_eq!(kind("habit.lambda"), Kind::Aged);
    }

    #[test]
    fn groups_stand_together() {
        let mut seen = Vec::new();
        for description in known() {
            let group = group_of(&description.path);
            if seen.last() != Some(&group) {
                assert!(!seen.contains(&group), "{group} stands in two places");
                seen.push(group);
            }
        }
        assert_eq!(seen, ORDER, "every group has its place");
    }
}
