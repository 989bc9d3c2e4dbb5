//! Messages that wait to be read: what happened, what can be done, and a way to put them away.

use super::icons::{self, Icon};
use super::snapshot::{Notice, Severity, Snapshot};
use super::widgets::{ICON, IconButton, card, note, palette, text_button};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::theme::TARGET;
use egui::{
    Align2, Area, Context, CornerRadius, Frame, Id, Label, Margin, Order, Rect, RichText, ScrollArea, Sense,
    Stroke, Ui, Vec2, vec2,
};
use std::time::Duration;

/// Width of a message, logical pixels, where there is room.
const WIDTH: f32 = 420.0;
/// Most messages shown at once: the newest.
const SHOWN: usize = 3;
/// Share of the canvas that messages may cover; they scroll beyond it.
const COVERED: f32 = 0.6;
/// How often a message under the pointer is kept for longer.
const HOLD: Duration = Duration::from_secs(1);

/// The messages at the upper edge of `canvas`, the newest first.
pub fn show(ctx: &Context, canvas: Rect, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    if snapshot.notices.is_empty() {
        return;
    }
    let at = canvas.center_top() + vec2(0.0, 12.0);
    let area =
        Area::new(Id::unique("notices")).order(Order::Foreground).pivot(Align2::CENTER_TOP).fixed_pos(at);
    area.constrain_to(canvas).show(ctx, |ui| {
        ui.set_width(WIDTH.min(canvas.width() - 24.0));
        let most = (canvas.height() * COVERED).max(TARGET);
        ScrollArea::vertical().max_height(most).show(ui, |ui| {
            for notice in snapshot.notices.iter().rev().take(SHOWN) {
                one(ui, notice, messages, out);
            }
            let more = snapshot.notices.len().saturating_sub(SHOWN);
            if more > 0 {
                card(ui).show(ui, |ui| note(ui, &messages.fill(Msg::NoticeMore, &[("count", &more)])));
            }
        });
    });
}

fn one(ui: &mut Ui, notice: &Notice, messages: &Messages, out: &mut Vec<Action>) {
    let p = palette(ui);
    let (icon, colour) = match notice.severity {
        Severity::Info => (Icon::Check, p.good),
        Severity::Warning => (Icon::Warning, p.warning),
        Severity::Error => (Icon::Warning, p.error),
    };
    let frame = Frame::NONE
        .fill(p.panel)
        .stroke(Stroke::new(1.5, colour))
        .corner_radius(CornerRadius::same(12))
        .inner_margin(Margin::symmetric(12, 8))
        .shadow(ui.visuals().popup_shadow);
    let shown = frame.show(ui, |ui| {
        ui.horizontal(|ui| {
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(ICON), Sense::hover());
            icons::paint(ui.painter(), rect, icon, colour);
            let width = ui.available_width() - TARGET - 8.0;
            ui.vertical(|ui| {
                ui.set_width(width);
                ui.spacing_mut().item_spacing.y = 3.0;
                ui.add(Label::new(RichText::new(&notice.what).color(p.text)).wrap());
                if !notice.remedy.is_empty() {
                    note(ui, &messages.fill(Msg::NoticeWhatToDo, &[("remedy", &notice.remedy)]));
                }
                if let Some(purpose) = notice.find
                    && text_button(ui, None, messages.get(Msg::NoticeFind), false).clicked()
                {
                    out.push(Action::DismissNotice(notice.id));
                    out.push(Action::ChooseFile(purpose));
                }
            });
            if IconButton::new(Icon::Close, messages.get(Msg::NoticeDismiss)).show(ui).clicked() {
                out.push(Action::DismissNotice(notice.id));
            }
        });
    });
    if shown.response.contains_pointer() {
        out.push(Action::HoldNotice(notice.id));
        ui.ctx().request_repaint_after(HOLD);
    }
}
