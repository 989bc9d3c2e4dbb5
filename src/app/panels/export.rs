//! The export dialog: format, what goes into it, how large it gets; progress and a way to stop.

use super::icons::Icon;
use super::snapshot::{ExportChoice, ExportFormat, Snapshot, Task};
use super::status::grouped;
use super::widgets::{note, palette, segments, switch, text_button};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use crate::pipeline::{Level, LevelSet};
use egui::{Align, Layout, ProgressBar, Ui, vec2};

/// Picture sizes to choose from, pixels.
const SIZES: [(u32, u32, &str); 4] =
    [(800, 600, "800×600"), (1600, 1200, "1600×1200"), (2048, 2048, "2048²"), (3840, 2160, "4K")];
/// Numbers of pictures of a turntable to choose from.
const FRAMES: [(u32, &str); 4] = [(1, "1"), (12, "12"), (36, "36"), (72, "72")];

/// What stands in the dialog.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    if let Some(task) = &snapshot.task {
        progress(ui, task, messages, out);
        return;
    }
    let mut choice = snapshot.export.clone();
    let formats = ExportFormat::ALL.map(|format| (format, name(format)));
    if let Some(format) = segments(ui, &formats, choice.format) {
        choice.format = format;
    }
    let about = match choice.format {
        ExportFormat::Obj => Msg::ExportFormatObj,
        ExportFormat::Glb => Msg::ExportFormatGlb,
        ExportFormat::Svg => Msg::ExportFormatSvg,
        ExportFormat::Png => Msg::ExportFormatPng,
    };
    note(ui, messages.get(about));
    match choice.format {
        ExportFormat::Obj | ExportFormat::Glb => {
            model(ui, &mut choice, snapshot.garden.plants.is_some(), messages)
        }
        ExportFormat::Png => picture(ui, &mut choice, messages),
        ExportFormat::Svg => {}
    }
    if choice != snapshot.export {
        out.push(Action::SetExport(choice.clone()));
    }
    ui.add_space(6.0);
    if choice.is_empty() {
        ui.colored_label(palette(ui).warning, messages.get(Msg::ExportTooLittle));
    } else if let Some(bytes) = snapshot.export_bytes {
        note(ui, &messages.fill(Msg::ExportEstimate, &[("size", &size(bytes))]));
    } else {
        note(ui, "");
    }
    buttons(ui, |ui| {
        let go = ui.add_enabled_ui(!choice.is_empty(), |ui| {
            text_button(ui, Some(Icon::Export), messages.get(Msg::ExportGo), true).clicked()
        });
        if go.inner {
            out.push(Action::Export(choice));
        }
        if text_button(ui, None, messages.get(Msg::DialogCancel), false).clicked() {
            out.push(Action::CloseDialog);
        }
    });
}

fn name(format: ExportFormat) -> &'static str {
    match format {
        ExportFormat::Obj => "OBJ",
        ExportFormat::Glb => "GLB",
        ExportFormat::Svg => "SVG",
        ExportFormat::Png => "PNG",
    }
}

fn model(ui: &mut Ui, choice: &mut ExportChoice, has_garden: bool, messages: &Messages) {
    for (msg, on) in [
        (Msg::ExportBranches, &mut choice.branches),
        (Msg::ExportLeaves, &mut choice.leaves),
        (Msg::ExportFlowers, &mut choice.flowers),
        (Msg::ExportExtras, &mut choice.extras),
        (Msg::ExportTextures, &mut choice.textures),
    ] {
        if let Some(new) = switch(ui, messages.get(msg), *on) {
            *on = new;
        }
    }
    let levels = choice.format == ExportFormat::Glb && levels(ui, choice, messages);
    if has_garden
        && !levels
        && let Some(garden) = switch(ui, messages.get(Msg::ExportGarden), choice.garden)
    {
        choice.garden = garden;
    }
    if choice.format == ExportFormat::Glb
        && let Some(copies) = switch(ui, messages.get(Msg::ExportCopies), choice.copies)
    {
        choice.copies = copies;
    }
}

/// The sets of levels of detail that one chooses from, and what they are called.
pub(super) fn level_sets(messages: &Messages) -> [(Option<LevelSet>, &str); 4] {
    let name = |set: Option<LevelSet>| match set {
        None => Msg::ExportLevelsNone,
        Some(LevelSet::Hero) => Msg::ExportLevelsHero,
        Some(LevelSet::Game) => Msg::ExportLevelsGame,
        Some(LevelSet::Mobile) => Msg::ExportLevelsMobile,
    };
    let [hero, game, mobile] = LevelSet::ALL.map(Some);
    [None, hero, game, mobile].map(|set| (set, messages.get(name(set))))
}

/// Levels of detail besides the plant; whether there are any.
fn levels(ui: &mut Ui, choice: &mut ExportChoice, messages: &Messages) -> bool {
    note(ui, messages.get(Msg::ExportLevels));
    if let Some(levels) = segments(ui, &level_sets(messages), choice.levels) {
        choice.levels = levels;
    }
    let Some(set) = choice.levels else { return false };
    let about = set.levels().into_iter().map(|level| match level {
        Level::Triangles(count) => grouped(count as usize),
        Level::Billboards => messages.get(Msg::ExportBillboards).to_owned(),
    });
    note(ui, &about.collect::<Vec<_>>().join(" · "));
    if let Some(capsules) = switch(ui, messages.get(Msg::ExportCapsules), choice.capsules) {
        choice.capsules = capsules;
    }
    true
}

fn picture(ui: &mut Ui, choice: &mut ExportChoice, messages: &Messages) {
    note(ui, messages.get(Msg::ExportSize));
    let sizes = SIZES.map(|(width, height, name)| ((width, height), name));
    if let Some((width, height)) = segments(ui, &sizes, (choice.width, choice.height)) {
        (choice.width, choice.height) = (width, height);
    }
    note(ui, messages.get(Msg::ExportFrames));
    if let Some(frames) = segments(ui, &FRAMES, choice.frames) {
        choice.frames = frames;
    }
    if let Some(on) = switch(ui, messages.get(Msg::ExportTransparent), choice.transparent) {
        choice.transparent = on;
    }
}

fn progress(ui: &mut Ui, task: &Task, messages: &Messages, out: &mut Vec<Action>) {
    let percent = (task.progress.clamp(0.0, 1.0) * 100.0).round();
    ui.label(messages.fill(Msg::ExportProgress, &[("name", &task.name), ("percent", &percent)]));
    let p = palette(ui);
    ui.add(ProgressBar::new(task.progress.clamp(0.0, 1.0)).fill(p.accent).desired_height(10.0));
    ui.add_space(6.0);
    buttons(ui, |ui| {
        if text_button(ui, Some(Icon::Close), messages.get(Msg::ExportStop), false).clicked() {
            out.push(Action::CancelTask);
        }
    });
}

/// The last row of a dialog: what people came for at its end.
pub(super) fn buttons(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let row = vec2(ui.available_width(), TARGET);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), add);
}

/// A number of bytes as people say it.
fn size(bytes: u64) -> String {
    match bytes as f64 {
        b if b < 1e3 => format!("{b:.0} B"),
        b if b < 1e6 => format!("{:.0} kB", b / 1e3),
        b if b < 1e9 => format!("{:.1} MB", b / 1e6),
        b => format!("{:.1} GB", b / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn sizes_are_short() {
        assert_eq!(size(999), "999 B");
        assert_eq!(size(25_400), "25 kB");
        assert_eq!(size(3_456_789), "3.5 MB");
        assert_eq!(size(7_000_000_000), "7.0 GB");
    }
}
