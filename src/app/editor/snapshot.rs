//! What the panels show of the editor, copied together once per frame.

use super::{Editor, estimate, task};
use crate::app::fonts;
use crate::app::messages::{Localize as _, Messages, Msg};
use crate::app::panels::snapshot::{
    Autosave, Dialog, Found, MenuOf, ParamValues, PartMenu, PenState, Recovered, ReferenceState, Status,
};
use crate::app::panels::{Snapshot, toolbar};
use crate::app::presets;
use crate::app::settings::ThemeChoice;
use crate::app::system_theme;
use crate::app::theme::Palette;
use crate::app::thumbnail;
use crate::growth::Habit;
use crate::pipeline::DEFAULT_SPECIES;
use crate::sketch::Warning;
use crate::sketch::journal::JournalState;
use serde_json::Map;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

/// How long the journal may take before it is said.
const SLOW_DISK: Duration = Duration::from_secs(1);
/// Width and height of a found drawing's picture in pixels.
const THUMBNAIL: [usize; 2] = [192, 144];

impl Editor {
    /// The panels' state of the application.
    pub(in crate::app) fn panel_snapshot(&mut self) -> Snapshot {
        self.notices.let_go(Instant::now());
        let sketch = self.document.sketch();
        let reference =
            sketch.reference.as_ref().map(|r| ReferenceState { opacity: r.opacity, locked: r.locked });
        Snapshot {
            name: self.file.name(),
            unsaved: !self.document.is_saved(),
            tool: self.canvas.tool(),
            can_undo: self.document.can_undo(),
            can_redo: self.document.can_redo(),
            selected: self.canvas.selection().ids().len(),
            // Until it is loaded, the language is called by its Latin name.
            chinese_font: self.chinese.font().is_some(),
            lacks_chinese_font: self.chinese.is_missing(),
            species: sketch.species.clone().unwrap_or_else(|| DEFAULT_SPECIES.to_owned()),
            textures: sketch.textures.clone(),
            seed: sketch.seed,
            params: self.param_values(),
            growth: self.growth_state(),
            presets: self.presets(),
            reference,
            view: self.plant.state,
            pen: self.pen_state(),
            status: self.status(),
            found: self.found_parts(),
            part_menu: self.part_menu,
            remarks: self.remarks(),
            dialog: self.dialog.clone(),
            export_bytes: self.export_bytes(),
            task: self.task_state(),
            notices: self.notices.iter().cloned().collect(),
            ..Snapshot::default()
        }
        .with_settings(&self.settings)
    }

    fn param_values(&self) -> ParamValues {
        let none = Map::new();
        let species = self.species.as_ref().map(|(_, species)| species);
        let of_species = species.map_or(&none, |species| &species.params);
        let values = ParamValues::of(of_species, &self.document.sketch().params);
        let Some(growth) = self.growth_state() else { return values };
        let habit = species.and_then(|species| species.growth.as_ref());
        values.growing(habit.unwrap_or(&Habit::default()), growth.age)
    }

    /// The presets' folder is read when something may have changed in it, not with every frame.
    fn presets(&self) -> Vec<presets::Listed> {
        self.listed_presets.clone()
    }

    pub(super) fn list_presets(&mut self) {
        self.listed_presets = presets::list(&self.places.presets());
    }

    fn status(&self) -> Status {
        Status {
            strokes: self.document.sketch().strokes.len(),
            flowers: self.counts.flowers,
            vertices: self.counts.vertices,
            triangles: self.counts.triangles,
            build_ms: self.building.last.map(|took| took.as_secs_f32() * 1e3),
            // A build of a few milliseconds is not worth a flicker.
            building: self.building.is_running
                && self.building.last.is_some_and(|t| t > Duration::from_millis(150)),
            shortfall: self.shortfall(),
            pen: self.pen_used.clone(),
            autosave: self.autosave(),
        }
    }

    /// What the analysis found odd about the stroke that the menu of parts is about.
    fn remarks(&self) -> Vec<String> {
        let Some(PartMenu { of: MenuOf::Stroke(stroke), .. }) = self.part_menu else { return Vec::new() };
        let about = self.warnings().iter().filter(|warning| warning.stroke == Some(stroke));
        about.map(|warning| warning.remark.localize(&self.messages)).collect()
    }

    /// What the plant lacks of what was drawn for it last, by what it was drawn as.
    fn shortfall(&self) -> Option<String> {
        let lacking = self.warnings().iter().rfind(|warning| warning.remark.is_shortfall())?;
        let stroke = self.document.sketch().strokes.iter().rfind(|s| Some(s.id) == lacking.stroke)?;
        let part = self.messages.get(toolbar::name_of(stroke.tool));
        let remark = lacking.remark.localize(&self.messages);
        Some(self.messages.fill(Msg::WarningPart, &[("part", &part), ("remark", &remark)]))
    }

    fn warnings(&self) -> &[Warning] {
        self.built.as_ref().map_or(&[], |built| &built.remarks)
    }

    /// A rectangle of physical pixels in points.
    fn points(&self, rect: crate::pen::mapping::Rect) -> egui::Rect {
        let scale = self.layout.pixels_per_point();
        let point = |at: glam::DVec2| egui::pos2((at.x / scale) as f32, (at.y / scale) as f32);
        egui::Rect::from_min_max(point(rect.min), point(rect.max))
    }

    fn pen_state(&self) -> PenState {
        let name = self.pen_device.as_deref().unwrap_or_default();
        PenState {
            device: self.pen_device.clone(),
            is_raw: self.pen_is_raw,
            battery: self.pen_battery,
            trouble: self.tablets.trouble.clone(),
            doubts: self.tablets.doubts.clone(),
            monitors: self.tablets.monitors,
            target: self.tablets.target.map(|target| self.points(target)),
            source: self.settings.pen_source,
            settings: self.settings.pen(name),
            live: self.pen_live,
        }
    }

    fn autosave(&self) -> Autosave {
        if self.saver.is_busy() {
            return Autosave::Saving;
        }
        let state = self.journal.as_ref().map(|journal| journal.state());
        match state {
            None | Some(JournalState::Failed(_)) => Autosave::Failed,
            Some(JournalState::Saving { steps, since }) if since.elapsed() > SLOW_DISK => {
                Autosave::Behind(steps)
            }
            Some(JournalState::Saving { .. }) => Autosave::Writing,
            Some(JournalState::Saved) if self.document.is_saved() => Autosave::Saved,
            Some(JournalState::Saved) => Autosave::Journaled,
        }
    }

    fn found_parts(&self) -> Found {
        if self.built.is_none() {
            return Found::default();
        }
        Found {
            petals: self.counts.petals,
            leaves: self.counts.leaves,
            branch_levels: self.counts.branch_levels,
            branch_outlines: self.outlines.branches,
            leaf_outlines: self.outlines.leaves,
            crowns: self.outlines.crowns,
            ignored: self.counts.ignored,
        }
    }

    fn export_bytes(&self) -> Option<u64> {
        let built = self.built.as_ref().filter(|_| self.dialog == Some(Dialog::Export))?;
        estimate::bytes(&self.settings.export, &built.model, self.document.sketch())
    }

    /// The list of drawings that were found again.
    pub(super) fn recovery_dialog(&self) -> Dialog {
        let untitled = self.messages.get(Msg::AppUntitled);
        let name = |title: &str| if title.is_empty() { untitled } else { title }.to_owned();
        let recovered = self.found.iter().map(|found| Recovered {
            path: found.folder().to_owned(),
            name: name(&found.meta.title),
            strokes: found.strokes(),
            when: ago(found.modified),
            thumbnail: self.picture_of(found.folder()),
        });
        Dialog::Recovery(recovered.collect())
    }

    fn picture_of(&self, folder: &Path) -> Option<egui::TextureId> {
        self.found_pictures.iter().find(|(of, _)| of == folder).map(|(_, picture)| picture.id())
    }

    /// Draws what was found again, once egui is there to keep the pictures.
    pub(in crate::app) fn picture_found_drawings(&mut self, ctx: &egui::Context) {
        if self.found.len() <= self.found_pictures.len() {
            return;
        }
        let palette = Palette::of(self.theme());
        for found in &self.found {
            let known = self.picture_of(found.folder()).is_some();
            if let Some(restored) = found.content.as_ref().ok().filter(|_| !known) {
                let picture = thumbnail::of_drawing(&restored.sketch, THUMBNAIL, palette.paper, palette.ink);
                let handle = ctx.load_texture("found drawing", picture, egui::TextureOptions::LINEAR);
                self.found_pictures.push((found.folder().to_owned(), handle));
            }
        }
        if matches!(self.dialog, Some(Dialog::Recovery(_))) {
            self.dialog = Some(self.recovery_dialog());
        }
    }

    /// The theme to show.
    pub(in crate::app) fn theme(&self) -> egui::Theme {
        self.settings.theme.resolve(self.system_theme)
    }

    /// The window's system said what its colours are.
    pub fn set_system_theme(&mut self, theme: Option<egui::Theme>) {
        if self.system_theme != theme {
            self.system_theme = theme;
            self.versions.drawing += 1;
        }
    }

    /// Asks the desktop for its colours, where they are followed and the window's system does not say them.
    pub fn ask_system_theme(&mut self) {
        let is_followed = self.settings.theme == ThemeChoice::System;
        if is_followed && self.theme_asked.is_none() && system_theme::can_be_asked() {
            // Without threads there is no opinion.
            self.theme_asked = task::begin("system theme", &self.wake, system_theme::ask).ok();
        }
    }

    pub(super) fn collect_system_theme(&mut self) {
        if let Some(answer) = self.theme_asked.as_ref().and_then(|work| work.result()) {
            self.theme_asked = None;
            self.set_system_theme(answer.flatten());
        }
    }

    /// Whether egui has not been given the fonts of the language yet.
    pub(in crate::app) fn needs_fonts(&mut self) -> bool {
        !std::mem::replace(&mut self.fonts_are_set, true)
    }

    /// As on a system without a Chinese font.
    #[cfg(test)]
    pub(in crate::app) fn lose_chinese_font(&mut self) {
        self.chinese = fonts::ChineseLookup::missing();
    }

    /// Fonts for the language of the interface, which becomes English, with a notice, where there are none.
    pub(in crate::app) fn fonts(&mut self) -> egui::FontDefinitions {
        let wanted = self.messages.language();
        let drawable = self.chinese.drawable(wanted);
        if drawable != wanted {
            self.messages = Messages::new(drawable);
            self.tell(fonts::missing_notice());
        }
        fonts::definitions(self.chinese.font())
    }

    /// What follows from a frame.
    pub(in crate::app) fn end_of_frame(&mut self, ui: &egui::Ui) {
        // A slider that was let go: its next move is a step of its own.
        if ui.input(|input| input.pointer.any_released()) {
            self.document.end_merging();
        }
        // Not with every frame of a drag.
        if !ui.input(|input| input.pointer.any_down()) {
            self.save_settings();
        }
    }
}

/// How long ago something was, in hours or days.
fn ago(then: SystemTime) -> String {
    let minutes = then.elapsed().unwrap_or_default().as_secs() / 60;
    match minutes {
        0..=59 => format!("{minutes} min"),
        60..=2879 => format!("{} h", minutes / 60),
        _ => format!("{} d", minutes / 1440),
    }
}

#[cfg(test)]
#[path = "snapshot_tests.rs"]
mod tests;
