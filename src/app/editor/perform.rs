//! Carries out wishes: the one place where an [`Action`] becomes a change.

use super::Editor;
use super::saving::Target;
use crate::app::action::Action;
use crate::app::messages::{Localize, Messages, Msg};
use crate::app::panels::snapshot::{Dialog, Notice, PathPurpose, ViewState};
use crate::app::presets::{self, Preset};
use crate::growth::overlay::Wanted;
use crate::plant::OrganKind;
use crate::sketch::change::StrokeChange;
use crate::sketch::settings::Settings;
use crate::sketch::{Change, Stroke, StrokeId, TextureChoice, Tool};
use crate::species;
use serde_json::{Map, Value};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

impl Editor {
    /// Carries out an action. What goes wrong is reported in a notice.
    pub fn perform(&mut self, action: Action) {
        if self.on_canvas(|canvas, drawing, out| canvas.act(&action, drawing, out)) {
            self.part_menu = None;
            self.layout.shows_all |= action == Action::FitCanvas;
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
            Action::Undo | Action::Redo => self.go_through_history(&action),
            Action::SetStrokePart { stroke, tool } => self.set_stroke_part(stroke, tool),
            Action::ClosePartMenu => self.part_menu = None,
            Action::CopySelected => self.copy_selected(),
            Action::CutSelected => self.cut_selected(),
            Action::Paste => self.clipboard.wants_paste = true,
            Action::SetSpecies(name) => self.change(Change::species(Some(name))),
            Action::SetSeed(seed) => self.change(Change::seed(seed)),
            Action::RollSeed => self.change(Change::seed(rand_seed(self.document.sketch().seed))),
            Action::SetParam { path, value } => self.set_param(&path, value),
            Action::SetParams(params) => self.change(Change::params(params)),
            Action::PlayGrowth(on) => self.play_growth(on),
            Action::SetTexture { organ, texture } => self.set_texture(organ, texture),
            Action::PictureRead { purpose, name, picture } => self.use_picture(purpose, &name, picture),
            Action::SavePreset(name) => self.save_preset(name),
            Action::ApplyPreset(path) => self.apply_preset(&path),
            Action::DeletePreset(path) => {
                self.or_tell(presets::remove(&path));
                self.list_presets();
            }
            Action::OpenReference => self.choose(PathPurpose::Reference),
            Action::SetReferenceOpacity(opacity) => self.edit_reference(|r| r.opacity = opacity),
            Action::LockReference(locked) => self.edit_reference(|r| r.locked = locked),
            Action::RemoveReference => self.change(Change::reference(None)),
            Action::ShowExport => self.dialog = Some(Dialog::Export),
            Action::SetExport(choice) => self.settings.export = choice,
            Action::Export(choice) => {
                self.settings.export = choice;
                self.dialog = None;
                self.choose(PathPurpose::Export);
            }
            Action::CancelTask => self.cancel_task(),
            Action::ShowDialog(dialog) => self.dialog = Some(dialog),
            Action::CloseDialog => self.close_dialog(),
            Action::DismissNotice(id) => self.notices.dismiss(id),
            Action::HoldNotice(id) => self.notices.hold(id, Instant::now()),
            other => self.perform_on_view(other),
        }
    }

    /// Wishes about how things look.
    fn perform_on_view(&mut self, action: Action) {
        match action {
            Action::FrontView => self.plant.show_front(),
            Action::SetLight(light) => self.plant.state.light = light,
            Action::SetShading(shading) => self.plant.state.shading = shading,
            Action::SetOrthographic(on) => self.plant.set_orthographic(on),
            Action::SetTurntable(on) => self.plant.state.turntable = on,
            Action::SetOverlay(overlay) => {
                self.plant.state.overlay = overlay;
                self.building.is_stale = true;
            }
            Action::CopyPicture => self.plant.wants_copy = true,
            Action::SetLanguage(language) => {
                self.settings.language = Some(language);
                self.messages = Messages::new(language);
                self.fonts_are_set = false;
                self.refresh_title();
            }
            Action::SetTheme(theme) => {
                self.settings.theme = theme;
                self.ask_system_theme();
            }
            Action::SetHandedness(hand) => self.settings.handedness = hand,
            Action::SetStabiliser(stabiliser) => self.settings.stabiliser = stabiliser,
            Action::SetPenSource(source) => self.settings.pen_source = source,
            Action::SetPen(pen) => {
                let name = self.pen_device.clone().unwrap_or_default();
                self.settings.set_pen(&name, pen);
            }
            Action::SetTabletModel { device, model } => self.settings.set_tablet_model(&device, &model),
            Action::ShowSide(shown) => self.settings.side_shown = shown,
            Action::SetSideWidth(width) => self.settings.side_width = width,
            // Everything else has been carried out before.
            _ => return,
        }
        self.apply_settings();
        self.versions.drawing += 1;
    }

    /// Gives the canvas and the rest what the settings say.
    pub(super) fn apply_settings(&mut self) {
        let pen = self.settings.pen(self.pen_device.as_deref().unwrap_or_default());
        self.canvas.settings.stabiliser = self.settings.stabiliser;
        self.canvas.settings.pressure = pen.pressure;
        self.canvas.settings.pen = pen.uses;
    }

    /// Keeps the settings, if they are others than those that were kept last.
    pub(super) fn save_settings(&mut self) {
        self.settings.view = ViewState { turntable: false, overlay: Wanted::default(), ..self.plant.state };
        if self.kept_settings.as_ref() == Some(&self.settings) {
            return;
        }
        self.kept_settings = Some(self.settings.clone());
        if let Err(error) = self.settings.save(&self.places.config) {
            let reason = error.localize(&self.messages);
            self.tell(Notice::warning(
                self.messages.fill(Msg::NoticeSettingsUnsaved, &[("reason", &reason)]),
                "",
            ));
        }
    }

    /// Tells of a failure.
    pub(super) fn tell_error(&mut self, error: &dyn Localize) {
        self.tell(Notice::error(error.localize(&self.messages), ""));
    }

    /// Tells of a failure, if it is one.
    pub(super) fn or_tell<T, E: Localize>(&mut self, result: Result<T, E>) {
        if let Err(error) = result {
            self.tell_error(&error);
        }
    }

    fn go_through_history(&mut self, action: &Action) {
        let step = if *action == Action::Undo { self.document.undo() } else { self.document.redo() };
        if let Some(step) = step {
            self.changed(&step);
        }
    }

    fn set_stroke_part(&mut self, id: StrokeId, tool: Tool) {
        self.part_menu = None;
        let known = self.document.sketch().strokes.iter().find(|s| s.id == id);
        if let Some(stroke) = known {
            let stroke = Stroke { tool, ..Stroke::clone(stroke) };
            self.change(Change::strokes(vec![StrokeChange::Put(Arc::new(stroke))]));
        }
    }

    /// Sets one parameter in the flat form `path → value`, whatever form the drawing had.
    fn set_param(&mut self, path: &str, value: Option<Value>) {
        let mut params = without(&self.document.sketch().params, path);
        if let Some(value) = value {
            params.insert(path.to_owned(), value);
        }
        self.change_merging(Change::params(params), path);
    }

    fn set_texture(&mut self, organ: Option<OrganKind>, texture: Option<TextureChoice>) {
        let mut textures = self.document.sketch().textures.clone();
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
        let sketch = self.document.sketch();
        let preset = Preset {
            name,
            species: sketch.species.clone(),
            params: sketch.params.clone(),
            textures: sketch.textures.clone(),
        };
        let saved = presets::save(&self.places.presets(), &preset);
        self.or_tell(saved);
        self.list_presets();
    }

    fn apply_preset(&mut self, path: &Path) {
        match presets::load(path) {
            Ok(Preset { species, params, mut textures, .. }) => {
                self.take_in(&mut textures, &self.places.presets());
                let species = species.map(Some);
                let (params, textures) = (Some(params), Some(textures));
                self.change(Settings { species, params, textures, ..Settings::default() }.into());
            }
            Err(error) => self.tell_error(&error),
        }
    }
}

/// A seed that differs from the last, by the clock.
fn rand_seed(last: u64) -> u64 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    // Small enough to be read and typed.
    let seed = crate::random::mix(last, now.subsec_nanos().into()) % 10_000;
    if seed == last { seed + 1 } else { seed }
}

/// Parameters without one path, whether it was written as one dotted key or nested.
pub(super) fn without(params: &Map<String, Value>, path: &str) -> Map<String, Value> {
    let mut out = params.clone();
    remove(&mut out, path);
    out
}

fn remove(params: &mut Map<String, Value>, path: &str) {
    params.remove(path);
    for (end, _) in path.match_indices('.') {
        let (head, rest) = (&path[..end], &path[end + 1..]);
        if let Some(Value::Object(inner)) = params.get_mut(head) {
            remove(inner, rest);
            if inner.is_empty() {
                params.remove(head);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_parameter_is_removed_in_any_spelling() {
        let spellings = [
            json!({"a.b.c": 1, "a.b.d": 2}),
            json!({"a": {"b": {"c": 1, "d": 2}}}),
            json!({"a.b": {"c": 1, "d": 2}}),
            json!({"a": {"b.c": 1, "b.d": 2}}),
        ];
        for spelling in spellings {
            let left = without(spelling.as_object().unwrap(), "a.b.c");
            assert!(!Value::from(left.clone()).to_string().contains('c'), "{left:?}");
            assert!(Value::from(left).to_string().contains('d'));
        }
        assert!(without(json!({"a": {"b": 1}}).as_object().unwrap(), "a.b").is_empty());
    }
}
