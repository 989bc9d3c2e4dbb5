//! What stands above everything until it is answered: unsaved changes, found drawings, export, paths, about.

use super::export::buttons;
use super::icons::{self, Icon};
use super::snapshot::{Dialog, PathPurpose, Recovered, Snapshot};
use super::toolbar::TOOLS;
use super::widgets::{IconButton, note, palette, text_button};
use super::{beside, garden, path_dialog, pen};
use super::{export, widgets};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use egui::{Align2, Context, CornerRadius, Grid, Id, Modal, RichText, ScrollArea, Sense, Ui, Vec2, vec2};
use std::path::Path;

/// The open dialog, if there is one.
pub fn show(ctx: &Context, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let Some(dialog) = &snapshot.dialog else { return };
    let screen = ctx.content_rect();
    let width = match dialog {
        Dialog::About | Dialog::Pen | Dialog::PlantSpecies(_) | Dialog::GardenSpecies => 640.0,
        Dialog::Path(_) | Dialog::Recovery(_) => 560.0,
        Dialog::Unsaved | Dialog::Replace { .. } | Dialog::Export => 440.0,
    };
    let style = ctx.global_style();
    let margin = style.spacing.window_margin;
    let frame = egui::Frame::window(&style).inner_margin(margin);
    let modal = Modal::new(Id::unique("dialog")).frame(frame).show(ctx, |ui| {
        ui.set_width(f32::min(width, screen.width() - 100.0));
        ui.set_max_height(screen.height() - 80.0);
        ui.label(RichText::new(messages.get(title(dialog))).heading().strong());
        ui.add_space(4.0);
        match dialog {
            Dialog::Unsaved => unsaved(ui, snapshot, messages, out),
            Dialog::Replace { purpose, path } => replace(ui, *purpose, path, messages, out),
            Dialog::Recovery(found) => recovery(ui, found, screen.height(), messages, out),
            Dialog::Export => export::show(ui, snapshot, messages, out),
            Dialog::Path(request) => path_dialog::show(ui, request, screen.height(), messages, out),
            Dialog::Pen => pen::show(ui, snapshot, screen.height(), messages, out),
            Dialog::PlantSpecies(place) => {
                beside::dialog(ui, *place, screen.height(), snapshot, messages, out)
            }
            Dialog::GardenSpecies => garden::dialog(ui, screen.height(), snapshot, messages, out),
            Dialog::About => about(ui, screen.height(), messages, out),
        }
    });
    // a tap beside the dialog must not throw a question away that somebody has to answer
    let may_leave =
        matches!(dialog, Dialog::About | Dialog::Pen | Dialog::PlantSpecies(_) | Dialog::GardenSpecies)
            || (matches!(dialog, Dialog::Export) && snapshot.task.is_none());
    let escaped = ctx.input(|i| i.key_pressed(egui::Key::Escape));
    if out.is_empty() && ((modal.should_close() && may_leave) || (escaped && snapshot.task.is_none())) {
        out.push(Action::CloseDialog);
    }
}

fn title(dialog: &Dialog) -> Msg {
    match dialog {
        Dialog::Unsaved => Msg::UnsavedTitle,
        Dialog::Replace { .. } => Msg::ReplaceTitle,
        Dialog::Recovery(_) => Msg::RecoveryTitle,
        Dialog::Export => Msg::ExportTitle,
        Dialog::PlantSpecies(None) => Msg::BesideAddTitle,
        Dialog::PlantSpecies(Some(_)) => Msg::BesideChangeTitle,
        Dialog::GardenSpecies => Msg::GardenSpeciesTitle,
        Dialog::Pen => Msg::PenTitle,
        Dialog::About => Msg::AboutHelp,
        Dialog::Path(request) => match request.purpose {
            PathPurpose::OpenDrawing => Msg::PathOpenTitle,
            PathPurpose::SaveDrawing => Msg::PathSaveTitle,
            PathPurpose::GardenDrawing => Msg::PathGardenDrawingTitle,
            PathPurpose::Export => Msg::PathExportTitle,
            PathPurpose::Texture(_) => Msg::PathTextureTitle,
            PathPurpose::Photograph(_) => Msg::PathPhotographTitle,
            PathPurpose::Species => Msg::PathSpeciesTitle,
            PathPurpose::Reference => Msg::PathReferenceTitle,
        },
    }
}

fn unsaved(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let name = snapshot.name.as_deref().unwrap_or(messages.get(Msg::AppUntitled));
    ui.label(messages.fill(Msg::UnsavedBody, &[("name", &name)]));
    ui.add_space(10.0);
    buttons(ui, |ui| {
        for (msg, loud, action) in [
            (Msg::FileSave, true, Action::SaveAndContinue),
            (Msg::DialogCancel, false, Action::CloseDialog),
            (Msg::UnsavedDiscard, false, Action::DiscardAndContinue),
        ] {
            if text_button(ui, None, messages.get(msg), loud).clicked() {
                out.push(action);
            }
        }
    });
}

/// A file would be written over of which nobody was asked, because its extension was added afterwards.
fn replace(ui: &mut Ui, purpose: PathPurpose, path: &Path, messages: &Messages, out: &mut Vec<Action>) {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().unwrap_or(path).display();
    ui.label(messages.fill(Msg::ReplaceBody, &[("name", &name), ("folder", &folder)]));
    ui.add_space(10.0);
    let path = path.to_owned();
    buttons(ui, |ui| {
        for (msg, loud, action) in [
            (Msg::PathReplace, true, Action::PathChosen { purpose, path }),
            (Msg::DialogCancel, false, Action::CloseDialog),
            (Msg::ReplaceOther, false, Action::ChooseFile(purpose)),
        ] {
            if text_button(ui, None, messages.get(msg), loud).clicked() {
                out.push(action);
            }
        }
    });
}

fn recovery(ui: &mut Ui, found: &[Recovered], height: f32, messages: &Messages, out: &mut Vec<Action>) {
    note(ui, messages.get(Msg::RecoveryBody));
    ui.add_space(4.0);
    ScrollArea::vertical().max_height((height - 280.0).max(120.0)).show(ui, |ui| {
        found.iter().for_each(|one| recovered(ui, one, messages, out));
    });
    ui.add_space(6.0);
    buttons(ui, |ui| {
        if text_button(ui, None, messages.get(Msg::RecoveryLater), false).clicked() {
            out.push(Action::CloseDialog);
        }
    });
}

fn recovered(ui: &mut Ui, one: &Recovered, messages: &Messages, out: &mut Vec<Action>) {
    let p = palette(ui);
    let asked = Id::unique(("asked whether to discard", &one.path));
    let sure = ui.data(|data| data.get_temp::<bool>(asked)).unwrap_or(false);
    let frame = egui::Frame::NONE.fill(p.card).corner_radius(CornerRadius::same(10)).inner_margin(8);
    frame.show(ui, |ui| {
        ui.horizontal(|ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(96.0, 72.0), Sense::hover());
            ui.painter().rect_filled(rect, CornerRadius::same(8), p.paper);
            match one.thumbnail {
                Some(texture) => {
                    let image = egui::Image::new((texture, rect.size())).corner_radius(8);
                    image.paint_at(ui, rect);
                }
                None => icons::paint(ui.painter(), rect.shrink(20.0), Icon::Plant, p.weak),
            }
            ui.vertical(|ui| {
                ui.label(RichText::new(&one.name).strong());
                note(
                    ui,
                    &messages.fill(Msg::RecoveryStrokes, &[("count", &one.strokes), ("when", &one.when)]),
                );
            });
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let open = messages.fill(Msg::RecoveryOpen, &[("name", &one.name)]);
                let discard = messages.fill(Msg::RecoveryDiscard, &[("name", &one.name)]);
                if sure {
                    if text_button(ui, Some(Icon::Delete), messages.get(Msg::RecoverySure), true).clicked() {
                        out.push(Action::DiscardRecovery(one.path.clone()));
                    }
                    return;
                }
                if IconButton::new(Icon::Delete, &discard).colour(p.error).show(ui).clicked() {
                    ui.data_mut(|data| data.insert_temp(asked, true));
                }
                let button = text_button(ui, Some(Icon::Open), messages.get(Msg::FileOpen), true);
                if button.on_hover_text(open).clicked() {
                    out.push(Action::Recover(one.path.clone()));
                }
            });
        });
    });
}

fn about(ui: &mut Ui, height: f32, messages: &Messages, out: &mut Vec<Action>) {
    let p = palette(ui);
    ScrollArea::vertical().max_height((height - 200.0).max(160.0)).show(ui, |ui| {
        ui.horizontal(|ui| {
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(64.0), Sense::hover());
            ui.painter().rect_filled(rect, CornerRadius::same(16), p.accent);
            icons::paint(ui.painter(), rect.shrink(12.0), Icon::Plant, p.on_accent);
            ui.vertical(|ui| {
                ui.label(messages.get(Msg::AboutBody));
                let version = messages.fill(Msg::AboutVersion, &[("version", &env!("CARGO_PKG_VERSION"))]);
                note(ui, &format!("{version} · {}", messages.get(Msg::AboutLicence)));
            });
        });
        widgets::section(ui, messages.get(Msg::AboutStartTitle), |ui| {
            ui.spacing_mut().interact_size.y = 28.0;
            ui.spacing_mut().item_spacing.y = 3.0;
            let steps = [
                Msg::AboutStart1,
                Msg::AboutStart2,
                Msg::AboutStart3,
                Msg::AboutStart4,
                Msg::AboutStart5,
                Msg::AboutStart6,
            ];
            for (number, msg) in steps.into_iter().enumerate() {
                ui.horizontal(|ui| {
                    let (rect, _) = ui.allocate_exact_size(Vec2::splat(26.0), Sense::hover());
                    ui.painter().circle_filled(rect.center(), 13.0, p.accent_soft);
                    let font = egui::FontId::proportional(14.0);
                    ui.painter().text(
                        rect.center(),
                        Align2::CENTER_CENTER,
                        (number + 1).to_string(),
                        font,
                        p.accent,
                    );
                    ui.add(egui::Label::new(messages.get(msg)).wrap());
                });
            }
        });
        widgets::section(ui, messages.get(Msg::AboutShortcuts), |ui| shortcuts(ui, messages));
    });
    buttons(ui, |ui| {
        if text_button(ui, None, messages.get(Msg::DialogClose), true).clicked() {
            out.push(Action::CloseDialog);
        }
    });
}

/// Two columns of keys and what they do.
fn shortcuts(ui: &mut Ui, messages: &Messages) {
    let mut all: Vec<(String, Msg)> =
        TOOLS.iter().map(|tool| (tool.key.name().to_owned(), tool.name)).collect();
    for (keys, msg) in [
        ("Ctrl+Z", Msg::EditUndo),
        ("Ctrl+Shift+Z, Ctrl+Y", Msg::EditRedo),
        ("Ctrl+S", Msg::FileSave),
        ("Ctrl+O", Msg::FileOpen),
        ("Ctrl+E", Msg::FileExport),
        ("Ctrl+A", Msg::EditSelectAll),
        ("G", Msg::BesideAddTitle),
        ("K", Msg::PetalsShape),
        ("W", Msg::SpaceDraw),
        ("J", Msg::PoseParts),
        ("N", Msg::Garden),
        ("U", Msg::BrushGrow),
        ("X", Msg::BrushPrune),
        ("Y", Msg::BrushLeaves),
        ("M", Msg::BrushFlowers),
        ("I", Msg::BrushLight),
        ("Ctrl+C", Msg::EditCopy),
        ("Ctrl+X", Msg::EditCut),
        ("Ctrl+V", Msg::EditPaste),
        ("Ctrl+D", Msg::EditDuplicate),
        ("Shift+H", Msg::EditMirrorLeftRight),
        ("Shift+V", Msg::EditMirrorTopBottom),
        ("Del", Msg::EditDelete),
        ("0", Msg::EditFit),
        ("1", Msg::EditFront),
        ("Q", Msg::ViewWalk),
    ] {
        all.push((keys.to_owned(), msg));
    }
    for (keys, msg) in [
        (Msg::KeysArrows, Msg::KeysNudge),
        (Msg::KeysSpaceDrag, Msg::KeysPan),
        (Msg::KeysShiftSpaceDrag, Msg::KeysRotate),
        (Msg::KeysWheel, Msg::KeysZoom),
        (Msg::KeysTwoFingers, Msg::KeysFingersUndo),
        (Msg::KeysThreeFingers, Msg::KeysFingersRedo),
        (Msg::KeysClickPlant, Msg::KeysPick),
    ] {
        all.push((messages.get(keys).to_owned(), msg));
    }
    let p = palette(ui);
    ui.spacing_mut().interact_size.y = TARGET * 0.5;
    Grid::new("shortcuts").num_columns(4).spacing(vec2(14.0, 5.0)).show(ui, |ui| {
        for pair in all.chunks(2) {
            for (keys, msg) in pair {
                ui.label(RichText::new(keys).monospace().size(12.5).color(p.accent));
                ui.label(messages.get(*msg));
            }
            ui.end_row();
        }
    });
}
