//! Grids of species to choose from, each with its picture and its name.

use super::{thumbnails, tiles};
use crate::app::messages::{Messages, Named};
use crate::app::theme::TARGET;
use crate::species::Species;
use egui::{ScrollArea, Ui};

/// Species in a row of a dialog.
const IN_DIALOG: usize = 7;
/// Height of a window that the pictures in a dialog leave to everything else: its title, hint and buttons, and the space around it.
const AROUND_TILES: f32 = 260.0;
/// Height of the names below pictures.
const CAPTION: f32 = 22.0;

/// A grid of so many columns; the species that was clicked.
pub(super) fn show<'a>(
    ui: &mut Ui,
    columns: usize,
    names: &[&'a str],
    chosen: Option<&str>,
    messages: &Messages,
) -> Option<&'a str> {
    let mut clicked = None;
    tiles::grid(
        ui,
        columns,
        names.len(),
        |width| width + CAPTION,
        |ui, index, size| {
            let name = names[index];
            let picture = thumbnails::of_species(ui.ctx(), name);
            let label = messages.name(Named::Species, name);
            let is_chosen = chosen == Some(name);
            if tiles::picture(ui, size, picture.as_ref(), &label, true, is_chosen).clicked() {
                clicked = Some(name);
            }
        },
    );
    clicked
}

/// All that make themselves, as a dialog shows them.
pub(super) fn by_themselves(
    ui: &mut Ui,
    screen_height: f32,
    chosen: Option<&str>,
    messages: &Messages,
) -> Option<&'static str> {
    let room = (screen_height - AROUND_TILES).max(TARGET);
    let names = Species::by_themselves();
    ScrollArea::vertical().max_height(room).show(ui, |ui| show(ui, IN_DIALOG, &names, chosen, messages)).inner
}
