//! A slider as high as a finger: name and value above a rail over the whole width.
//!
//! Dragging sideways changes the value; dragging up or down scrolls the panel instead, so that a list of sliders can be
//! scrolled by touch. Ranges over two orders of magnitude and more have a logarithmic rail.

use super::widgets::palette;
use crate::app::theme::TARGET;
use egui::{Align2, CornerRadius, Rect, Response, Role, Sense, TextStyle, Ui, WidgetInfo, pos2, vec2};

/// Ratio of largest and smallest value from which a rail is logarithmic.
const LOG_FROM: f64 = 100.0;
/// Distance of the rail's ends from the widget's sides: the radius of the knob.
const INSET: f32 = 8.0;
/// Height of a rail with its name.
const HEIGHT: f32 = TARGET + 6.0;
/// Digits that a value keeps.
const DIGITS: i32 = 3;

/// How values lie on a rail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Value at the left end.
    pub min: f64,
    /// Value at the right end.
    pub max: f64,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
}

impl Scale {
    fn is_log(&self) -> bool {
        self.min > 0.0 && self.max / self.min >= LOG_FROM
    }

    /// Where a value lies, 0 to 1.
    pub fn share(&self, value: f64) -> f32 {
        let share = if self.is_log() {
            (value.max(self.min) / self.min).ln() / (self.max / self.min).ln()
        } else {
            (value - self.min) / (self.max - self.min)
        };
        share.clamp(0.0, 1.0) as f32
    }

    /// The value at a place, with few digits and never outside the range.
    pub fn value(&self, share: f32) -> f64 {
        let share = f64::from(share.clamp(0.0, 1.0));
        let exact = if self.is_log() {
            self.min * (self.max / self.min).powf(share)
        } else {
            self.min + (self.max - self.min) * share
        };
        let step = if self.is_log() { exact } else { self.max - self.min };
        let rounded = if self.whole { exact.round() } else { to_digits(exact, step.abs()) };
        rounded.clamp(self.min, self.max)
    }

    /// A value as people read it.
    pub fn text(&self, value: f64) -> String {
        if self.whole { format!("{value:.0}") } else { number(value) }
    }
}

/// Rounds to the digits that a quantity of this size has.
fn to_digits(value: f64, size: f64) -> f64 {
    if size <= 0.0 || !size.is_finite() {
        return value;
    }
    let decimals = DIGITS - 1 - size.log10().floor() as i32;
    let unit = 10_f64.powi(decimals.clamp(-12, 12));
    (value * unit).round() / unit
}

/// A number with few digits and no empty decimals.
pub fn number(value: f64) -> String {
    let text = format!("{:.6}", to_digits(value, value.abs()));
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// One rail.
pub struct Rail<'a> {
    /// Name before the value.
    pub label: &'a str,
    /// The value as shown, with its unit.
    pub text: &'a str,
    /// What values lie on it.
    pub scale: Scale,
    /// The value.
    pub value: f64,
    /// Whether it is not what it was at first.
    pub changed: bool,
}

impl Rail<'_> {
    /// Shows it and returns the new value where it was moved.
    pub fn show(&self, ui: &mut Ui, width: f32) -> (Response, Option<f64>) {
        let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::slider(true, self.value, self.label));
        let moved = self.moved(ui, rect, &response).map(|share| self.scale.value(share));
        if ui.is_rect_visible(rect) {
            self.paint(ui, rect, &response, moved.unwrap_or(self.value));
        }
        let moved = moved.filter(|new| (new - self.value).abs() > f64::EPSILON * self.value.abs().max(1e-9));
        (response, moved)
    }

    /// The place that a tap or a sideways drag chose; other drags scroll.
    fn moved(&self, ui: &Ui, rect: Rect, response: &Response) -> Option<f32> {
        let scrolls = response.id.with("scrolls");
        if response.drag_started() {
            let (from, to) = ui.input(|i| (i.pointer.press_origin(), i.pointer.latest_pos()));
            let way = from.zip(to).map_or(vec2(1.0, 0.0), |(from, to)| to - from);
            ui.data_mut(|data| data.insert_temp(scrolls, way.y.abs() > way.x.abs()));
        }
        let held = response.dragged() && !response.clicked();
        if held && ui.data(|data| data.get_temp::<bool>(scrolls)).unwrap_or(false) {
            ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
            return None;
        }
        let at = response.interact_pointer_pos().filter(|_| held || response.clicked())?;
        Some((at.x - rect.left() - INSET) / (rect.width() - 2.0 * INSET).max(1.0))
    }

    fn paint(&self, ui: &Ui, rect: Rect, response: &Response, value: f64) {
        let p = palette(ui);
        let painter = ui.painter();
        let body = TextStyle::Body.resolve(ui.style());
        let colour = if self.changed { p.accent } else { p.text };
        let line = rect.top() + 11.0;
        let value_text =
            painter.layout_no_wrap(self.text.to_owned(), TextStyle::Small.resolve(ui.style()), p.weak);
        let value_left = rect.right() - 2.0 - value_text.size().x;
        painter.galley(pos2(value_left, line - value_text.size().y * 0.5), value_text, p.weak);
        let before = Rect::from_min_max(rect.min, pos2((value_left - 6.0).max(rect.left()), rect.bottom()));
        let clipped = painter.with_clip_rect(before.intersect(ui.clip_rect()));
        clipped.text(pos2(rect.left() + 2.0, line), Align2::LEFT_CENTER, self.label, body, colour);

        let rail = Rect::from_min_max(
            pos2(rect.left() + INSET, rect.bottom() - 14.0),
            pos2(rect.right() - INSET, rect.bottom() - 9.0),
        );
        let knob = pos2(egui::lerp(rail.left()..=rail.right(), self.scale.share(value)), rail.center().y);
        painter.rect_filled(rail.expand2(vec2(INSET * 0.5, 0.0)), CornerRadius::same(3), p.card_hover);
        let done = Rect::from_min_max(rail.min - vec2(INSET * 0.5, 0.0), pos2(knob.x, rail.bottom()));
        painter.rect_filled(done, CornerRadius::same(3), p.accent);
        let active = response.hovered() || response.dragged();
        painter.circle(knob, if active { 8.5 } else { 7.0 }, p.panel, egui::Stroke::new(2.5, p.accent));
    }
}

/// The role under which screen readers and tests find a rail.
pub const ROLE: Role = Role::Slider;

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: Scale = Scale { min: 0.0005, max: 0.05, whole: false };
    const COUNT: Scale = Scale { min: 1.0, max: 1_000_000.0, whole: true };
    const ANGLE: Scale = Scale { min: 0.0, max: 80.0, whole: false };

    #[test]
    fn ends_of_the_rail_are_ends_of_the_range() {
        for scale in [LENGTH, COUNT, ANGLE] {
            assert_eq!(scale.value(0.0), scale.min);
            assert_eq!(scale.value(1.0), scale.max);
            assert_eq!(scale.value(-3.0), scale.min);
            assert_eq!(scale.value(7.0), scale.max);
        }
    }

    #[test]
    fn a_value_comes_back_from_its_place() {
        for (scale, value) in [(LENGTH, 0.004), (COUNT, 200.0), (ANGLE, 35.0)] {
            let back = scale.value(scale.share(value));
            assert!((back - value).abs() <= 0.006 * value, "{value} came back as {back}");
        }
    }

    #[test]
    fn values_are_short() {
        assert_eq!(number(f64::from(0.004_f32)), "0.004");
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(1e-5), "0.00001");
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(100.0), "100");
        assert_eq!(COUNT.text(COUNT.value(0.5)), "1000");
        assert_eq!(ANGLE.value(0.333), 26.6);
    }
}
