//! What the keys and wheels of a tablet that is read directly do.

use super::widgets::{note, palette, segments};
use crate::app::messages::{Messages, Msg};
use crate::app::tablet_keys::{KeyUse, TabletKeys, WheelUse};
use crate::app::theme::TARGET;
use egui::{ComboBox, Role, Sense, Ui, WidgetInfo, pos2, vec2};

/// A choice for each key, in two columns, and one for dials and rings.
pub(super) fn show(ui: &mut Ui, uses: &mut TabletKeys, messages: &Messages) {
    note(ui, messages.get(Msg::TabletKeysHint));
    let half = uses.keys.len().div_ceil(2);
    let mut numbered = (1..).zip(&mut uses.keys).collect::<Vec<(usize, &mut KeyUse)>>();
    ui.columns_const(|[left, right]| {
        for (number, usage) in numbered.drain(..half) {
            key(left, number, usage, messages);
        }
        for (number, usage) in numbered.drain(..) {
            key(right, number, usage, messages);
        }
    });
    note(ui, messages.get(Msg::TabletWheel));
    let choices = [
        (WheelUse::Zoom, messages.get(Msg::TabletZoom)),
        (WheelUse::History, messages.get(Msg::TabletHistory)),
        (WheelUse::Nothing, messages.get(Msg::UseNothing)),
    ];
    if let Some(wheel) = segments(ui, &choices, uses.wheel) {
        uses.wheel = wheel;
    }
}

fn key(ui: &mut Ui, number: usize, usage: &mut KeyUse, messages: &Messages) {
    ui.horizontal(|ui| {
        let label = messages.fill(Msg::TabletKey, &[("number", &number)]);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width() * 0.3, TARGET), Sense::hover());
        let font = egui::TextStyle::Body.resolve(ui.style());
        let at = pos2(rect.left() + 6.0, rect.center().y);
        ui.painter().text(at, egui::Align2::LEFT_CENTER, &label, font, palette(ui).text);
        ui.spacing_mut().interact_size.y = TARGET;
        let chosen = messages.get(name(*usage));
        let width = ui.available_width();
        let list = ComboBox::from_id_salt(&label).width(width).selected_text(chosen).show_ui(ui, |ui| {
            ui.spacing_mut().interact_size.y = TARGET;
            ui.spacing_mut().button_padding.y = 10.0;
            for one in KeyUse::ALL {
                ui.selectable_value(usage, one, messages.get(name(one)));
            }
        });
        list.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("{label}: {chosen}")));
    });
}

fn name(usage: KeyUse) -> Msg {
    match usage {
        KeyUse::Nothing => Msg::UseNothing,
        KeyUse::Undo => Msg::EditUndo,
        KeyUse::Redo => Msg::EditRedo,
        KeyUse::ZoomIn => Msg::TabletZoomIn,
        KeyUse::ZoomOut => Msg::TabletZoomOut,
        KeyUse::Fit => Msg::TabletFit,
        KeyUse::Draw => Msg::TabletDraw,
        KeyUse::Erase => Msg::UseErase,
        KeyUse::ErasePartly => Msg::UseErasePartly,
        KeyUse::Select => Msg::TabletSelect,
        KeyUse::Pan => Msg::UsePan,
        KeyUse::Save => Msg::FileSave,
    }
}
