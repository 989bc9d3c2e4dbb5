//! What has the keyboard is seen: a ring around it, whichever widget it is.
//!
//! Tab and Shift+Tab go through everything that can be pressed, in the order in which panels show it; Enter and Space press it.
//! A widget that gets the keyboard while it is out of sight is scrolled into sight by [`reveal`].

use super::widgets::palette;
use crate::app::theme::ROUND;
use egui::{CornerRadius, Response, Stroke, StrokeKind, Ui};

/// Width of the ring.
const WIDTH: f32 = 2.0;

/// Paints the ring; called when everything has been shown.
pub(super) fn ring(ui: &Ui) {
    let ctx = ui.ctx();
    let Some(focused) = ctx.memory(|memory| memory.focused()) else { return };
    let Some(Response { layer_id, interact_rect, .. }) = ctx.read_response(focused) else { return };
    if !interact_rect.is_positive() {
        return;
    }
    let painter = ctx.layer_painter(layer_id).with_clip_rect(interact_rect.expand(WIDTH));
    let line = Stroke::new(WIDTH, palette(ui).accent);
    painter.rect_stroke(interact_rect, CornerRadius::same(ROUND), line, StrokeKind::Middle);
}

/// Scrolls to what has just got the keyboard; called at the end of what is scrolled.
pub(super) fn reveal(ui: &Ui) {
    let focused = ui.memory(|memory| memory.focused()).and_then(|focused| ui.ctx().read_response(focused));
    let Some(response) = focused.filter(Response::gained_focus) else { return };
    if response.layer_id == ui.layer_id() && ui.min_rect().intersects(response.rect) {
        ui.scroll_to_rect(response.rect, None);
    }
}
