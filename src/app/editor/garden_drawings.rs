//! Other drawings whose plants the artist plants in the garden: a file is asked for, and a copy of its plant comes into the brush, from
//! there into the garden.

use super::Editor;
use crate::app::messages::{Localize as _, Msg};
use crate::app::panels::snapshot::Notice;
use crate::pipeline;
use crate::sketch::garden::{for_garden, named};
use crate::sketch::save::{self, Opened};
use crate::sketch::species_file::is_file;
use crate::sketch::{GardenDrawing, GardenPlant};
use std::path::Path;

impl Editor {
    /// Plants the plant of a drawing from now on; where it cannot be read all stays as it is.
    pub(super) fn plant_drawing(&mut self, path: &Path) {
        let mut sketch = match save::open(path) {
            Ok(Opened { sketch, warnings, .. }) => {
                for warning in &warnings {
                    self.notify(Notice::warning(warning.localize(self.prefs.messages()), ""));
                }
                sketch
            }
            Err(error) => return self.notify_error(&error),
        };
        self.take_in(&mut sketch.textures, path.parent().unwrap_or(Path::new("")));
        let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let about = |msg| self.prefs.messages().fill(msg, &[("name", &name)]);
        if sketch.strokes.is_empty() {
            return self.notify(Notice::error(about(Msg::GardenNothingDrawn), ""));
        }
        if sketch.species.is_none() {
            // What is read of it does not change when it stands in a garden.
            sketch.species = Some(pipeline::usual_species(&sketch, &[]).to_owned());
        }
        let of_own_species = sketch.species.as_deref().is_some_and(is_file);
        let warning = of_own_species.then(|| about(Msg::GardenOwnSpecies));
        match for_garden(&self.sketch().garden, &name, &sketch) {
            Ok(drawing) => self.garden.brush.plant = GardenPlant::Drawing(drawing),
            Err(what) => return self.notify(Notice::error(what, "")),
        }
        if let Some(warning) = warning {
            self.notify(Notice::warning(warning, ""));
        }
    }

    /// The drawings that are planted in the garden, and the one that the brush has.
    pub(super) fn garden_drawings(&self) -> Vec<GardenDrawing> {
        // A sound garden has no two of one name.
        let planted = named(&self.sketch().garden).unwrap_or_default();
        let mut all: Vec<GardenDrawing> = planted.into_values().cloned().collect();
        if let GardenPlant::Drawing(drawing) = &self.garden.brush.plant
            && !all.contains(drawing)
        {
            all.push(drawing.clone());
        }
        all
    }
}
