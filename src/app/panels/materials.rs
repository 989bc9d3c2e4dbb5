//! Choosing textures: for each kind of part the species' own, a built-in one, or a picture of the artist's.

use super::icons::Icon;
use super::snapshot::{PathPurpose, Snapshot};
use super::widgets::{note, section, segments, text_button_sized};
use super::{thumbnails, tiles};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::plant::{OrganKind, Texture};
use crate::sketch::TextureChoice;
use crate::species::builtin_textures::texture_names;
use crate::species::textures::{chosen, key};
use egui::{Id, Ui};

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
    let choice = snapshot.textures.get(key(organ));
    let shown = choice.and_then(chosen);
    let missing = match choice {
        Some(TextureChoice::Named(name)) if shown.is_none() => Some(name),
        _ => None,
    };
    if let Some(name) = missing {
        note(ui, &messages.fill(Msg::MaterialsMissing, &[("name", name)]));
    }
    let own = match choice {
        Some(TextureChoice::Own(picture)) => Some(picture),
        _ => None,
    };
    let textures: Vec<&str> = texture_names()
        .into_iter()
        .filter(|name| starts.iter().any(|start| name.starts_with(start)))
        .collect();
    ui.scope(|ui| {
        tiles::grid(
            ui,
            COLUMNS,
            1 + usize::from(own.is_some()) + textures.len(),
            |width| width,
            |ui, index, size| {
                if index == 0 {
                    let species = tiles::text(ui, size, messages.get(Msg::MaterialsOwn), choice.is_none());
                    if species.clicked() && choice.is_some() {
                        out.push(Action::SetTexture { organ, texture: None });
                    }
                    return;
                }
                let Some(name) = (index - 1).checked_sub(usize::from(own.is_some())).map(|i| textures[i])
                else {
                    let picture = own.and_then(|own| thumbnails::of_picture(ui.ctx(), own));
                    let label = messages.get(Msg::MaterialsOwnPicture);
                    tiles::picture(ui, size, picture.as_ref(), label, false, true).on_hover_text(label);
                    return;
                };
                let is_chosen = shown == Some(Texture::BuiltIn(name.to_owned()));
                let picture = thumbnails::of_texture(ui.ctx(), name);
                let label = name.trim_end_matches(".png").replace('_', " ");
                let tile = tiles::picture(ui, size, picture.as_ref(), &label, false, is_chosen);
                if tile.on_hover_text(label).clicked() {
                    let texture = Some(TextureChoice::Named(name.to_owned()));
                    out.push(Action::SetTexture { organ, texture });
                }
            },
        );
    });
    let width = ui.available_width();
    let label = messages.get(if missing.is_some() { Msg::NoticeFind } else { Msg::MaterialsPicture });
    if text_button_sized(ui, Some(Icon::Picture), label, missing.is_some(), Some(width)).clicked() {
        out.push(Action::ChooseFile(PathPurpose::Texture(organ)));
    }
    if matches!(organ, None | Some(OrganKind::Petal | OrganKind::Leaf)) {
        let label = messages.get(Msg::MaterialsPhotograph);
        let button = text_button_sized(ui, Some(Icon::Picture), label, false, Some(width));
        if button.on_hover_text(messages.get(Msg::MaterialsPhotographHint)).clicked() {
            out.push(Action::ChooseFile(PathPurpose::Photograph(organ)));
        }
    }
}
