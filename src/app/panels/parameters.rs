//! Every parameter of every stage, by its own description: name, value, unit, range, help, and the way back.
//!
//! All of them stand in groups: how the plant looks before how strokes are understood. What the artist changed is listed on a
//! page of its own, which keeps what it once showed until it is left: nothing is put between rows that are in use, so that
//! nothing moves under the pointer. A search looks through names, help and paths.

use super::icons::Icon;
use super::rail::{Rail, RailChange, Scale, number};
use super::snapshot::Snapshot;
use super::widgets::{IconButton, list, note, palette, segments, switch, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::app::theme::TARGET;
use crate::params::{Description, Kind, Parameters as _};
use crate::pipeline::Params;
use egui::{CollapsingHeader, Id, RichText, TextEdit, Ui, vec2};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// Groups in the order in which an artist comes to them: the plant as a whole, flowers and leaves, branches, what fills
/// outlines, surfaces, and last what only matters where strokes were misunderstood.
const ORDER: [&str; 40] = [
    "depth.world",
    "season",
    "flower",
    "flower.layers",
    "flower.layers.outline",
    "flower.bloom",
    "flower.clump",
    "flower.leaves",
    "rose",
    "growth",
    "obstacle",
    "garden",
    "habit",
    "habit.crown",
    "habit.climb",
    "habit.leaf",
    "habit.light",
    "habit.space",
    "depth.cone",
    "depth.leaves",
    "depth.curl",
    "depth.stem",
    "depth.branches",
    "depth.radii",
    "depth.learned",
    "anatomy.leaf_fill",
    "anatomy.leaf_twigs",
    "anatomy.twigs",
    "model.budget",
    "cards",
    "model.blade",
    "model.tube",
    "model.solid",
    "anatomy.conventions",
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
        // What is to be chosen decides what the numbers below it mean.
        let is_number = |d: &Description| !matches!(d.kind, Kind::Choice(_));
        all.sort_by_key(|d| (place(d).unwrap_or(ORDER.len()), is_number(d)));
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
    if let Some(listed) = only_changed(ui, snapshot, messages) {
        changed(ui, &listed, snapshot, messages, out);
        return;
    }
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
            let these = these.iter().filter(|one| snapshot.params.applies(&one.path));
            these.for_each(|one| row(ui, one, snapshot, messages, out));
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

/// The paths to list where only changed parameters are wanted: those that are changed, and those that were while this page
/// is shown.
fn only_changed(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages) -> Option<BTreeSet<String>> {
    let at = Id::unique("changed parameters");
    let mut listed: Option<BTreeSet<String>> = ui.data(|data| data.get_temp(at)).unwrap_or_default();
    let applies = |path: &&String| snapshot.params.applies(path);
    let now: BTreeSet<String> = snapshot.params.own.keys().filter(applies).cloned().collect();
    let title = messages.fill(Msg::ParamsChanged, &[("count", &now.len())]);
    let pages = [(false, messages.get(Msg::ParamsAll)), (true, title.as_str())];
    if let Some(only) = segments(ui, &pages, listed.is_some()) {
        listed = only.then(BTreeSet::new);
    }
    if let Some(listed) = &mut listed {
        listed.extend(now);
    }
    ui.data_mut(|data| data.insert_temp(at, listed.clone()));
    listed
}

fn changed(
    ui: &mut Ui,
    listed: &BTreeSet<String>,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    if listed.is_empty() {
        note(ui, messages.get(Msg::ParamsNoneChanged));
        return;
    }
    let these = known().iter().filter(|d| listed.contains(&d.path) && snapshot.params.applies(&d.path));
    these.for_each(|one| row(ui, one, snapshot, messages, out));
    let width = ui.available_width();
    let reset =
        text_button_sized(ui, Some(Icon::Reset), messages.get(Msg::ParamsResetAll), false, Some(width));
    if reset.clicked() {
        out.push(Action::SetParams(Map::new()));
    }
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
    let base_text = value_text(base, description, messages);
    let reset = messages.fill(Msg::ParamsReset, &[("name", &name), ("value", &base_text)]);
    let reset = own.is_some().then_some(reset.as_str());
    let mut set = |value: Option<Value>| out.push(Action::SetParam { path: path.clone(), value });
    if let Kind::Switch | Kind::Choice(_) = kind {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            let width = ui.available_width() - TARGET;
            let shown = ui.allocate_ui(vec2(width, TARGET), |ui| match kind {
                Kind::Choice(names) => one_of(ui, (path, &name), names, value, messages),
                _ => switch(ui, &name, value > 0.5).map(Value::Bool),
            });
            shown.response.on_hover_ui(|ui| help(ui, description, base, messages));
            if let Some(new) = shown.inner {
                set(Some(new));
            }
            let button = |label| IconButton::new(Icon::Reset, label).colour(palette(ui).accent);
            if reset.map(button).is_some_and(|button| button.show(ui).clicked()) {
                set(None);
            }
        });
        return;
    }
    let scale = Scale { min: description.min, max: description.max, whole: kind == Kind::Whole };
    let words = messages.below_zero(path).filter(|_| value < 0.0);
    let text = words.map_or_else(|| with_unit(&scale.text(value), description, messages), str::to_owned);
    let width = ui.available_width();
    let (response, change) = Rail { label: &name, text: &text, scale, value, reset }.show(ui, width);
    if !response.dragged() {
        response.on_hover_ui(|ui| help(ui, description, base, messages));
    }
    match change {
        Some(RailChange::To(new)) if scale.whole => set(Some(Value::from(new as u64))),
        Some(RailChange::To(new)) => set(Some(Value::from(new))),
        Some(RailChange::Reset) => set(None),
        None => {}
    }
}

/// A parameter that is one of several names; the name that was pressed.
fn one_of(
    ui: &mut Ui,
    (path, name): (&str, &str),
    names: &[&str],
    value: f64,
    messages: &Messages,
) -> Option<Value> {
    let spoken: Vec<String> = names.iter().map(|one| messages.choice(path, one)).collect();
    let choices: Vec<(usize, &str)> = spoken.iter().map(String::as_str).enumerate().collect();
    let new = list(ui, (name, 0.5), &choices, value as usize)?;
    names.get(new).map(|name| Value::from(*name))
}

fn value_text(value: f64, of: &Description, messages: &Messages) -> String {
    if let Some(words) = messages.below_zero(&of.path).filter(|_| value < 0.0) {
        return words.to_owned();
    }
    match of.kind {
        Kind::Switch if value > 0.5 => messages.get(Msg::ParamsOn).to_owned(),
        Kind::Switch => messages.get(Msg::ParamsOff).to_owned(),
        Kind::Choice(_) => messages.choice(&of.path, &of.kind.written(value)),
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
    if let Kind::Choice(_) = kind {
        note(ui, &messages.fill(Msg::ParamsUsual, &[("default", &default)]));
    } else {
        note(ui, &messages.fill(Msg::ParamsRange, &[("min", &min), ("max", &max), ("default", &default)]));
    }
    ui.label(RichText::new(&description.path).monospace().small().color(palette(ui).weak));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_and_switches_are_distinguished_from_numbers() {
        let kind = |path: &str| known().iter().find(|d| d.path == path).unwrap().kind;
        assert_eq!(kind("depth.cone.flip"), Kind::Switch);
        assert_eq!(kind("anatomy.flowers.min_petals"), Kind::Whole);
        assert_eq!(kind("depth.world.height"), Kind::Number);
        assert_eq!(kind("habit.lambda"), Kind::Aged);
        assert_eq!(kind("habit.resource"), Kind::Choice(&["light", "space"]));
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
