//! Choosing textures: for each kind of part the species' own, a built-in one, or a picture of the artist's.

use super::icons::Icon;
use super::snapshot::{PathPurpose, Snapshot};
use super::widgets::{note, section, segments, text_button_sized};
use super::{thumbnails, tiles};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::plant::{OrganKind, Texture};
use crate::species::builtin::texture_names;
use crate::species::textures::{chosen, key};
use egui::{Id, Ui};
use std::path::Path;

/// Kinds of parts that the panel offers, and how names of built-in textures for them begin.
const PARTS: [(Option<OrganKind>, &[&str]); 5] = [
    (Some(OrganKind::Petal), &["petal_"]),
    (Some(OrganKind::Leaf), &["leaf_"]),
    (None, &["bark_", "stem_", "twig"]),
    (Some(OrganKind::Sepal), &["sepal", "leaf_"]),
    (Some(OrganKind::Receptacle), &["disc_"]),
];
/// Textures in a row.
const COLUMNS: usize = 5;

/// Textures of the plant's parts.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    section(ui, messages.get(Msg::MaterialsTitle), |ui| {
        let at = Id::unique("part whose textures are shown");
        let shown: usize = ui.data(|data| data.get_temp(at)).unwrap_or(0).min(PARTS.len() - 1);
        let names = PARTS.map(|(organ, _)| messages.name(Named::Organ, key(organ)));
        let choices: Vec<(usize, &str)> = names.iter().map(String::as_str).enumerate().collect();
        // two rows, for five names side by side would be too small to read
        let split = choices.len().div_ceil(2);
        let pressed = segments(ui, &choices[..split], shown);
        let pressed = pressed.or(ui.push_id("second row", |ui| segments(ui, &choices[split..], shown)).inner);
        if let Some(index) = pressed {
            ui.data_mut(|data| data.insert_temp(at, index));
        }
        let (organ, starts) = PARTS[shown];
        part(ui, organ, starts, snapshot, messages, out);
    });
}

fn part(
    ui: &mut Ui,
    organ: Option<OrganKind>,
    starts: &[&str],
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let choice = snapshot.textures.get(key(organ)).map(|name| chosen(name));
    if let Some(Texture::File(path)) = &choice {
        note(ui, &messages.fill(Msg::MaterialsChosen, &[("name", &file_name(path))]));
    }
    let textures: Vec<&str> = texture_names()
        .into_iter()
        .filter(|name| starts.iter().any(|start| name.starts_with(start)))
        .collect();
    ui.scope(|ui| {
        tiles::grid(
            ui,
            COLUMNS,
            textures.len() + 1,
            |width| width,
            |ui, index, size| {
                let Some(name) = index.checked_sub(1).and_then(|i| textures.get(i)) else {
                    let own = tiles::text(ui, size, messages.get(Msg::MaterialsOwn), choice.is_none());
                    if own.clicked() && choice.is_some() {
                        out.push(Action::SetTexture { organ, texture: None });
                    }
                    return;
                };
                let is_chosen = choice == Some(Texture::BuiltIn((*name).to_owned()));
                let picture = thumbnails::of_texture(ui.ctx(), name);
                let label = name.trim_end_matches(".png").replace('_', " ");
                let tile = tiles::picture(ui, size, picture.as_ref(), &label, false, is_chosen);
                if tile.on_hover_text(label).clicked() {
                    out.push(Action::SetTexture { organ, texture: Some((*name).to_owned()) });
                }
            },
        );
    });
    let width = ui.available_width();
    if text_button_sized(ui, Some(Icon::Picture), messages.get(Msg::MaterialsPicture), false, Some(width))
        .clicked()
    {
        out.push(Action::ChooseFile(PathPurpose::Texture(organ)));
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
