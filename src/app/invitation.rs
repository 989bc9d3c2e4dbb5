//! What an empty canvas says to do first.

use super::messages::{Messages, Msg};
use super::theme::Palette;

/// Says on an empty canvas what to do first.
pub(super) fn invite(painter: &egui::Painter, canvas: egui::Rect, messages: &Messages, palette: &Palette) {
    let font = egui::FontId::proportional(19.0);
    let (first, then) = (messages.get(Msg::CanvasInvite), messages.get(Msg::CanvasInviteHint));
    let middle = canvas.center();
    painter.text(middle, egui::Align2::CENTER_BOTTOM, first, font, palette.weak);
    let small = egui::FontId::proportional(14.0);
    painter.text(middle + egui::vec2(0.0, 8.0), egui::Align2::CENTER_TOP, then, small, palette.weak);
}
