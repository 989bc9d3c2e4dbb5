//! Four crosses that are touched one after the other, so that a pen display's pen draws where its tip is.
//!
//! They lie over the whole window while they are asked for. What was touched is kept beside the dialog until the fourth;
//! Escape ends, and crosses that were not touched well are asked for again. They stand in the rectangle that the tablet
//! covers; where that is larger than the window nothing can be asked, since the window shows only part of it.

use super::widgets::{note, palette, text_button};
use crate::app::messages::{Messages, Msg};
use crate::app::pen_settings::PenSettings;
use crate::pen::calibration::{CROSSES, Calibration};
use egui::{Align2, Area, Context, FontId, Id, Order, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, vec2};
use glam::DVec2;

/// Half of a cross's arms.
const ARM: f32 = 18.0;

/// What was touched so far; `None` while nothing is asked for.
type Asked = Option<Vec<DVec2>>;

fn state(context: &Context) -> Asked {
    context.data(|data| data.get_temp(id()).unwrap_or_default())
}

fn set(context: &Context, asked: Asked) {
    context.data_mut(|data| data.insert_temp(id(), asked));
}

fn id() -> Id {
    Id::unique("calibration of a pen display")
}

/// The button that begins, and what was made of the last time. `target` is the rectangle that the tablet covers, if all
/// of it is in the window.
pub(super) fn show(ui: &mut Ui, pen: &mut PenSettings, target: Option<Rect>, messages: &Messages) {
    let Some(target) = target else {
        note(ui, messages.get(Msg::CalibrateNotHere));
        return;
    };
    note(ui, messages.get(Msg::CalibrateHint));
    ui.horizontal_wrapped(|ui| {
        if text_button(ui, None, messages.get(Msg::Calibrate), false).clicked() {
            set(ui.ctx(), Some(Vec::new()));
        }
        let is_calibrated = pen.calibration != Calibration::default();
        if is_calibrated && text_button(ui, None, messages.get(Msg::CalibrateForget), false).clicked() {
            pen.calibration = Calibration::default();
        }
    });
    ask(ui.ctx(), pen, target, messages);
}

/// Shows the next cross, if one is asked for.
fn ask(context: &Context, pen: &mut PenSettings, target: Rect, messages: &Messages) {
    let Some(mut said) = state(context) else { return };
    if context.input(|input| input.key_pressed(egui::Key::Escape)) {
        return set(context, None);
    }
    let Some(cross) = CROSSES.get(said.len()) else { return set(context, None) };
    let at = target.min + vec2(cross.x as f32, cross.y as f32) * target.size();
    let window = context.content_rect();
    let area = Area::new(id().with("crosses")).order(Order::Foreground).fixed_pos(window.min);
    let touched = area.show(context, |ui| {
        let (rect, response) = ui.allocate_exact_size(window.size(), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, messages.get(Msg::CalibrateTouch)));
        paint(ui, rect, at, messages);
        response.interact_pointer_pos().filter(|_| response.clicked())
    });
    let Some(touched) = touched.inner else { return };
    let share = (touched - target.min) / target.size();
    said.push(DVec2::new(f64::from(share.x), f64::from(share.y)));
    let Ok(all) = <[DVec2; 4]>::try_from(said.as_slice()) else { return set(context, Some(said)) };
    match pen.calibration.refined(all) {
        Some(calibration) => {
            pen.calibration = calibration;
            set(context, None);
        }
        // Not touched well: once more.
        None => set(context, Some(Vec::new())),
    }
}

fn paint(ui: &Ui, window: Rect, at: Pos2, messages: &Messages) {
    let p = palette(ui);
    let painter = ui.painter();
    painter.rect_filled(window, 0.0, p.panel);
    let stroke = Stroke::new(2.0, p.accent);
    painter.line_segment([at - vec2(ARM, 0.0), at + vec2(ARM, 0.0)], stroke);
    painter.line_segment([at - vec2(0.0, ARM), at + vec2(0.0, ARM)], stroke);
    let text = messages.get(Msg::CalibrateTouch);
    painter.text(window.center(), Align2::CENTER_CENTER, text, FontId::proportional(18.0), p.text);
}
