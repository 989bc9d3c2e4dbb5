//! Carries out actions: the one place where an [`Action`] becomes a change.
//!
//! Each action goes to the part that owns what it is about: the canvas first, then the drawing and what happens on the disk,
//! the view of the plant, and what the artist chose for the program.

use super::Editor;
use super::dice;
use super::parameters::without;
use super::saver::Target;
use crate::app::action::Action;
use crate::app::panels::snapshot::{Dialog, PathPurpose, ViewState};
use crate::app::presets::{self, Preset};
use crate::growth::overlay::Wanted;
use crate::plant::OrganKind;
use crate::sketch::change::StrokeChange;
use crate::sketch::settings::Settings;
use crate::sketch::{Change, Stroke, StrokeId, TextureChoice, Tool};
use crate::species;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

impl Editor {
    /// Carries out an action. What goes wrong is reported in a notice.
    pub fn perform(&mut self, action: Action) {
        if matches!(action, Action::SetTool(_)) {
            self.search.stop();
        }
        if self.on_canvas(|canvas, drawing, out| canvas.act(&action, drawing, out)) {
            self.dialogs.close_part_menu();
            if action == Action::FitCanvas {
                self.fit_all();
                self.layout.shows_all = true;
            }
            return;
        }
        match action {
            Action::New | Action::Open | Action::OpenPath(_) | Action::Recover(_) | Action::Quit => {
                self.perform_if_saved(action);
            }
            Action::Save => self.save(Target::Own),
            Action::SaveAs => self.choose(PathPurpose::SaveDrawing),
            Action::SaveAndContinue => self.save_and_continue(),
            Action::DiscardAndContinue => self.discard_and_continue(),
            Action::ChooseFile(purpose) => self.choose(purpose),
            Action::PathChosen { purpose, path } => self.chosen(purpose, path),
            Action::DiscardRecovery(path) => self.discard_recovery(&path),
            Action::CopySelected => self.copy_selected(),
            Action::CutSelected => self.cut_selected(),
            Action::Paste => self.updates.want_paste(),
            Action::PictureRead { purpose, name, picture } => self.use_picture(purpose, &name, picture),
            Action::TakePictureUnder(stroke) => self.take_picture_under(stroke),
            Action::TextureCut { organ, name, cut } => self.use_cut(organ, &name, cut),
            Action::SavePreset(name) => self.save_preset(name),
            Action::ApplyPreset(path) => self.apply_preset(&path),
            Action::DeletePreset(path) => {
                let removed = self.disk.presets.remove(&path);
                self.notify_failure(removed);
            }
            Action::OpenReference => self.choose(PathPurpose::Reference),
            Action::SetExport(choice) => self.prefs.set_export(choice),
            Action::Export(choice) => {
                self.prefs.set_export(choice);
                self.dialogs.set_dialog(None);
                self.choose(PathPurpose::Export);
            }
            Action::CancelTask => self.disk.exports.cancel(),
            other => self.perform_on_drawing(other),
        }
    }

    /// Actions about what is drawn and what grows of it.
    fn perform_on_drawing(&mut self, action: Action) {
        match action {
            Action::Undo if self.search.take_back() => self.seek_plant(),
            Action::Undo => {
                let is_other = self.drawing.undo();
                self.changed(is_other);
            }
            Action::Redo => {
                let is_other = self.drawing.redo();
                self.changed(is_other);
            }
            Action::SetStrokePart { stroke, tool } => self.set_stroke_part(stroke, tool),
            Action::RefuseReading(stroke) => self.refuse_reading(stroke),
            Action::Correct(correction) => self.correct(correction),
            Action::ShowWays { stroke, at } => self.show_ways(stroke, at),
            Action::WaysFound { about, ways } => self.dialogs.ways_found(&about, ways),
            Action::SetSpecies(name) => self.change(Change::species(Some(name))),
            Action::GuessSpecies => self.change(Change::species(None)),
            Action::SetSeed(seed) => self.change(Change::seed(seed)),
            Action::RollSeed => self.change(Change::seed(dice::another_seed(self.sketch().seed))),
            Action::SetParam { path, value } => self.set_param(&path, value),
            Action::SetParams(params) => self.change(Change::params(params)),
            Action::PlayGrowth(on) => self.live.play_growth(on, self.drawing.sketch()),
            Action::PlayOpening(on) => self.live.play_opening(on, self.drawing.sketch()),
            Action::SetTexture { organ, texture } => self.set_texture(organ, texture),
            Action::SetReferenceOpacity(opacity) => self.edit_reference(|r| r.opacity = opacity),
            Action::LockReference(locked) => self.edit_reference(|r| r.locked = locked),
            Action::RemoveReference => self.change(Change::reference(None)),
            other => self.perform_on_plant_search(other),
        }
    }

    /// Actions about what stands over the window.
    pub(super) fn perform_on_dialogs(&mut self, action: Action) {
        match action {
            Action::ShowExport => self.dialogs.set_dialog(Some(Dialog::Export)),
            Action::ShowDialog(dialog) => self.dialogs.set_dialog(Some(dialog)),
            Action::CloseDialog => self.dialogs.cancel(),
            Action::ClosePartMenu => self.dialogs.close_part_menu(),
            Action::DismissNotice(id) => self.dialogs.notices_mut().dismiss(id),
            Action::HoldNotice(id) => self.dialogs.notices_mut().hold(id, Instant::now()),
            other => self.perform_on_view(other),
        }
    }

    /// Actions about how things look.
    fn perform_on_view(&mut self, action: Action) {
        match action {
            Action::FrontView => self.plant.show_front(),
            Action::SetLight(light) => self.plant.state.light = light,
            Action::SetShading(shading) => self.plant.state.shading = shading,
            Action::SetOrthographic(on) => self.plant.set_orthographic(on),
            Action::SetTurntable(on) => self.plant.set_turntable(on),
            Action::SetOutdoors(on) => self.plant.set_outdoors(on),
            Action::Walk(on) => self.walk(on),
            Action::Stride(step) => self.plant.stride(step),
            Action::SetOverlay(overlay) => {
                self.plant.state.overlay = overlay;
                self.live.set_stale();
            }
            Action::ShowLevels(set) => self.show_levels(set),
            Action::HoldLevel(level) => self.hold_level(level),
            Action::SetDistance(metres) => self.plant.set_distance(metres),
            Action::CopyPicture => self.plant.wants_copy = true,
            other => {
                if self.prefs.obey(other, self.pens.name(), self.background.wake()).is_err() {
                    // Everything else has been carried out before.
                    return;
                }
                self.refresh_title();
            }
        }
        self.apply_settings();
        self.updates.drawing_changed();
    }

    /// Gives the canvas what the artist chose for it and for the pen in use.
    pub(super) fn apply_settings(&mut self) {
        let pen = self.prefs.pen(self.pens.name());
        self.canvas.settings.stabiliser = self.prefs.settings().stabiliser;
        self.canvas.settings.pressure = pen.pressure;
        self.canvas.settings.pen = pen.uses;
    }

    /// Keeps the settings, if they are others than those that were kept last.
    pub(super) fn save_settings(&mut self) {
        let view =
            ViewState { turntable: false, walking: false, overlay: Wanted::default(), ..self.plant.state };
        let trouble = self.prefs.save(view);
        trouble.into_iter().for_each(|notice| self.notify(notice));
    }

    fn set_stroke_part(&mut self, id: StrokeId, tool: Tool) {
        self.dialogs.close_part_menu();
        let known = self.sketch().strokes.iter().find(|s| s.id == id);
        if let Some(stroke) = known {
            let stroke = Stroke { tool, ..Stroke::clone(stroke) };
            self.change(Change::strokes(vec![StrokeChange::Put(Arc::new(stroke))]));
        }
    }

    /// Sets one parameter in the flat form `path → value`, whatever form the drawing had.
    fn set_param(&mut self, path: &str, value: Option<Value>) {
        let mut params = without(&self.sketch().params, path);
        if let Some(value) = value {
            params.insert(path.to_owned(), value);
        }
        self.change_merging(Change::params(params), path);
    }

    fn set_texture(&mut self, organ: Option<OrganKind>, texture: Option<TextureChoice>) {
        let mut textures = self.sketch().textures.clone();
        let part = species::textures::key(organ);
        let Some(texture) = texture else {
            textures.remove(part);
            return self.change(Change::textures(textures));
        };
        // A picture that was missing is found for every part that has it.
        if let Some(missing) =
            textures.get(part).filter(|known| species::textures::chosen(known).is_none()).cloned()
        {
            textures
                .values_mut()
                .filter(|known| **known == missing)
                .for_each(|known| *known = texture.clone());
        }
        textures.insert(part.to_owned(), texture);
        self.change(Change::textures(textures));
    }

    fn save_preset(&mut self, name: String) {
        let sketch = self.sketch();
        let preset = Preset {
            name,
            species: sketch.species.clone(),
            params: sketch.params.clone(),
            textures: sketch.textures.clone(),
        };
        let saved = self.disk.presets.save(&preset);
        self.notify_failure(saved);
    }

    fn apply_preset(&mut self, path: &Path) {
        match presets::load(path) {
            Ok(Preset { species, params, mut textures, .. }) => {
                let folder = self.disk.presets.path().to_owned();
                self.take_in(&mut textures, &folder);
                let species = species.map(Some);
                let (params, textures) = (Some(params), Some(textures));
                self.change(Settings { species, params, textures, ..Settings::default() }.into());
                self.notify_missing_species();
            }
            Err(error) => self.notify_error(&error),
        }
    }
}
