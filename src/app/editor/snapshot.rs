//! What the panels show of the editor, copied together once per frame.

use super::{Editor, estimate};
use crate::anatomy::Part;
use crate::app::messages::{Localize as _, Msg};
use crate::app::panels::snapshot::{
    Autosave, Dialog, Found, MenuOf, ParamValues, PartMenu, ReferenceState, Status,
};
use crate::app::panels::{Snapshot, toolbar};
use crate::growth::Habit;
use crate::sketch::Remark;
use crate::sketch::journal::JournalState;
use serde_json::Map;
use std::time::{Duration, Instant};

/// How long the journal may take before it is said.
const SLOW_DISK: Duration = Duration::from_secs(1);

impl Editor {
    /// The panels' state of the application.
    pub(in crate::app) fn panel_snapshot(&mut self) -> Snapshot {
        self.dialogs.notices_mut().let_go(Instant::now());
        let sketch = self.sketch();
        let reference =
            sketch.reference.as_ref().map(|r| ReferenceState { opacity: r.opacity, locked: r.locked });
        Snapshot {
            name: self.drawing.name(),
            unsaved: !self.drawing.is_saved(),
            tool: self.canvas.tool(),
            can_undo: self.drawing.can_undo() || self.search.can_take_back(),
            can_redo: self.drawing.can_redo(),
            selected: self.canvas.selection().ids().len(),
            chinese_font: self.prefs.have_chinese_font(),
            lacks_chinese_font: self.prefs.lack_chinese_font(),
            species: self.live.species_name(sketch),
            species_is_guess: sketch.species.is_none(),
            blank: sketch.strokes.is_empty(),
            missing_species: self.missing_species(),
            textures: sketch.textures.clone(),
            seed: sketch.seed,
            params: self.param_values(),
            growth: self.live.growth_state(sketch),
            opening: self.live.opening_state(sketch),
            beside: self.beside_state(),
            petals: self.petal_state(),
            space: self.space_state(),
            brush: self.brush_state(),
            garden: self.garden_state(),
            pose: self.pose_state(),
            presets: self.disk.presets.listed().to_vec(),
            reference,
            plant_search: self.search.state(self.branch_over_picture()),
            view: self.plant.state,
            levels: self.levels_state(),
            pen: self.pens.state(self.prefs.settings(), self.layout.pixels_per_point()),
            status: self.status(),
            found: self.found_parts(),
            readings: self.read_together(),
            ways: self.ways(),
            part_menu: self.dialogs.part_menu(),
            over_picture: self.over_picture(),
            remarks: self.remarks(),
            dialog: self.dialogs.dialog().cloned(),
            export_bytes: self.export_bytes(),
            task: self.disk.exports.state(),
            notices: self.dialogs.notices().iter().cloned().collect(),
            ..Snapshot::default()
        }
        .with_settings(self.prefs.settings())
    }

    fn missing_species(&self) -> Option<String> {
        match self.live.missing_species()? {
            Remark::SpeciesMissing { name } => Some(name.clone()),
            _ => None,
        }
    }

    fn param_values(&self) -> ParamValues {
        let none = Map::new();
        let species = self.live.species();
        let of_species = species.map_or(&none, |species| &species.params);
        let has_garden = !self.sketch().garden.is_empty();
        let values = ParamValues::of(of_species, &self.sketch().params).with_garden(has_garden);
        let Some(growth) = self.live.growth_state(self.sketch()) else { return values };
        let habit = species.and_then(|species| species.growth.as_ref());
        values.growing(habit.unwrap_or(&Habit::default()), growth.age)
    }

    fn status(&self) -> Status {
        let (counts, took) = (self.live.counts(), self.live.last_took());
        Status {
            strokes: self.sketch().strokes.len(),
            flowers: counts.flowers,
            vertices: counts.vertices,
            triangles: counts.triangles,
            build_ms: took.map(|took| took.as_secs_f32() * 1e3),
            // A build of a few milliseconds is not worth a flicker.
            building: self.live.is_running() && took.is_some_and(|took| took > Duration::from_millis(150)),
            shortfall: self.shortfall(),
            pen: self.pens.used(),
            autosave: self.autosave(),
        }
    }

    /// What the analysis found odd about the stroke that the menu of parts is about.
    fn remarks(&self) -> Vec<String> {
        let Some(PartMenu { of: MenuOf::Stroke(stroke), .. }) = self.dialogs.part_menu() else {
            return Vec::new();
        };
        // What strokes are read as is shown with the other ways.
        let is_odd = |remark: &Remark| !matches!(remark, Remark::ReadAs(_));
        let about = self.live.warnings().iter().filter(|w| w.stroke == Some(stroke) && is_odd(&w.remark));
        about.map(|warning| warning.remark.localize(self.prefs.messages())).collect()
    }

    /// What a plant beside the drawn one lacks, or else this one of what was drawn for it last, by what it was drawn as.
    fn shortfall(&self) -> Option<String> {
        let lacking = self.live.warnings().iter().rfind(|warning| warning.remark.is_shortfall())?;
        let remark = lacking.remark.localize(self.prefs.messages());
        if matches!(lacking.remark, Remark::OfPlant { .. }) {
            return Some(remark);
        }
        let stroke = self.sketch().strokes.iter().rfind(|s| Some(s.id) == lacking.stroke)?;
        let part = self.prefs.messages().get(toolbar::name_of(stroke.tool));
        Some(self.prefs.messages().fill(Msg::WarningPart, &[("part", &part), ("remark", &remark)]))
    }

    fn autosave(&self) -> Autosave {
        if self.disk.saver.is_busy() {
            return Autosave::Saving;
        }
        match self.drawing.journal_state() {
            None | Some(JournalState::Failed(_)) => Autosave::Failed,
            Some(JournalState::Saving { steps, since }) if since.elapsed() > SLOW_DISK => {
                Autosave::Behind(steps)
            }
            Some(JournalState::Saving { .. }) => Autosave::Writing,
            Some(JournalState::Saved) if self.drawing.is_saved() => Autosave::Saved,
            Some(JournalState::Saved) => Autosave::Journaled,
        }
    }

    fn found_parts(&self) -> Found {
        if self.built().is_none() {
            return Found::default();
        }
        let (counts, outlines) = (self.live.counts(), self.live.outlines());
        let is_read = |part| self.live.pieces().iter().any(|pieces| pieces.have(part));
        Found {
            petals: counts.petals || is_read(Part::Petal),
            leaves: counts.leaves || is_read(Part::Leaf),
            branch_levels: counts.branch_levels,
            branch_outlines: outlines.branches,
            leaf_outlines: outlines.leaves,
            crowns: outlines.crowns || is_read(Part::Crown),
            pots: counts.pots,
            ground: counts.ground,
            ignored: counts.ignored,
        }
    }

    fn export_bytes(&self) -> Option<u64> {
        let built = self.built().filter(|_| self.dialog() == Some(&Dialog::Export))?;
        estimate::bytes(&self.prefs.settings().export, (&built.model, built.garden.as_deref()), self.sketch())
    }
}

#[cfg(test)]
#[path = "snapshot_tests.rs"]
mod tests;
