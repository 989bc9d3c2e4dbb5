//! A slider as high as a finger: name above a rail, beside it the number, which is typed, and the way back.
//!
//! Dragging sideways changes the value; dragging up or down scrolls the panel instead, so that a list of sliders can be
//! scrolled by touch. Only near its line the rail takes the place of the pointer: a drag from the name moves the value by as
//! much as the pointer moves, and a tap on the name or on the number changes nothing. Ranges over two orders of magnitude and
//! more have a logarithmic rail. Number and reset have their places whether they are in use or not, so that nothing moves
//! under the pointer. With the keyboard arrows move the value by a hundredth of the rail, with Shift by a tenth.

use super::icons::Icon;
use super::widgets::{IconButton, palette};
use crate::app::action;
use crate::app::theme::TARGET;
use egui::accesskit::{Action, ActionData};
use egui::{Align2, CornerRadius, CursorIcon, DragValue, EventFilter, Key, Rect, Response, Role, Sense};
use egui::{Id, TextStyle, Ui, UiBuilder, WidgetInfo, pos2, vec2};
use serde_json::Value;

/// Ratio of largest and smallest value from which a rail is logarithmic.
const LOG_FROM: f64 = 100.0;
/// Distance of the rail's ends from the widget's sides: the radius of the knob.
const INSET: f32 = 8.0;
/// Height of a rail with its name.
const HEIGHT: f32 = TARGET + 6.0;
/// Height of the name, on which a press does not move the value.
const NAME_HEIGHT: f32 = 21.0;
/// Width of the number.
const NUMBER_WIDTH: f32 = 72.0;
/// Share of the rail that an arrow key moves the value by, without and with Shift.
const KEY_STEPS: (f32, f32) = (0.01, 0.1);
/// Digits that a value keeps.
const DIGITS: i32 = 3;

/// Shows a setting, with a way back to its usual value where it has another; its new value, if there is one.
pub fn setting(
    ui: &mut Ui,
    (label, text): (&str, &str),
    (min, max): (f32, f32),
    (value, usual): (f32, f32),
    reset: &str,
) -> Option<f32> {
    let scale = Scale { min: min.into(), max: max.into(), whole: false };
    let reset = (value != usual).then_some(reset);
    let room = ui.available_width();
    let change = Rail { label, text, scale, value: value.into(), reset }.show(ui, room).1;
    change.map(|change| match change {
        RailChange::To(value) => value as f32,
        RailChange::Reset => usual,
    })
}

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

/// A number as people type it: a comma for a point, and a unit behind it, do no harm.
fn typed(text: &str) -> Option<f64> {
    let plain = text.replace(',', ".").replace('\u{2212}', "-");
    let number = plain.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.').trim();
    number.parse::<f64>().ok().filter(|number| number.is_finite())
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
    /// Name above the rail.
    pub label: &'a str,
    /// The value as shown, with its unit.
    pub text: &'a str,
    /// What values lie on it.
    pub scale: Scale,
    /// The value.
    pub value: f64,
    /// What taking the value back is called; `None` where it is what it was at first.
    pub reset: Option<&'a str>,
}

/// What was done with a rail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RailChange {
    /// Another value was chosen.
    To(f64),
    /// The value was taken back.
    Reset,
}

impl Rail<'_> {
    /// Shows it over the width of the panel; the action that sets the parameter of this path, or gives it back, where that was asked for.
    pub fn set(&self, ui: &mut Ui, path: &str) -> Option<action::Action> {
        let room = ui.available_width().max(TARGET);
        let value = match self.show(ui, room).1? {
            RailChange::To(value) => Some(Value::from(value)),
            RailChange::Reset => None,
        };
        Some(action::Action::SetParam { path: path.to_owned(), value })
    }

    /// Shows it over a width; the response is that of the rail without number and reset.
    pub fn show(&self, ui: &mut Ui, width: f32) -> (Response, Option<RailChange>) {
        let (whole, place) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
        let reset = Rect::from_min_max(pos2(whole.right() - TARGET, whole.top()), whole.max);
        let number = Rect::from_min_max(pos2(reset.left() - NUMBER_WIDTH, whole.top()), reset.left_bottom());
        let rect = Rect::from_min_max(whole.min, number.left_bottom());
        let response = ui.interact(rect, place.id.with("rail"), Sense::click_and_drag());
        self.describe(ui, &response);
        let share = self.dragged(ui, rect, &response).or_else(|| self.stepped(ui, &response));
        let moved = share.map(|share| self.scale.value(share)).or_else(|| spoken(ui, &response));
        if ui.is_rect_visible(rect) {
            self.paint(ui, rect, &response, moved.unwrap_or(self.value));
        }
        let moved = moved.or_else(|| self.number(ui, number)).map(|new| self.sound(new));
        let moved = moved.filter(|new| (new - self.value).abs() > f64::EPSILON * self.value.abs().max(1e-9));
        let back = self.way_back(ui, reset);
        (response, if back { Some(RailChange::Reset) } else { moved.map(RailChange::To) })
    }

    /// Within the range, and whole where it must be.
    fn sound(&self, value: f64) -> f64 {
        let value = if self.scale.whole { value.round() } else { value };
        value.clamp(self.scale.min, self.scale.max)
    }

    /// Tells screen readers what it is.
    fn describe(&self, ui: &Ui, response: &Response) {
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), self.value, self.label));
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_min_numeric_value(self.scale.min);
            node.set_max_numeric_value(self.scale.max);
            for action in [Action::SetValue, Action::Increment, Action::Decrement] {
                node.add_action(action);
            }
        });
    }

    /// The place that a tap or a sideways drag chose; other drags scroll.
    fn dragged(&self, ui: &Ui, rect: Rect, response: &Response) -> Option<f32> {
        let (scrolls, held_at) = (response.id.with("scrolls"), response.id.with("held at"));
        let length = (rect.width() - 2.0 * INSET).max(1.0);
        let is_name = |y: f32| y < rect.top() + NAME_HEIGHT;
        let from = ui.input(|i| i.pointer.press_origin());
        if response.drag_started() {
            let way = from.zip(ui.input(|i| i.pointer.latest_pos())).map_or(vec2(1.0, 0.0), |(a, b)| b - a);
            // From the name: by how much the value differs from the place of the pointer.
            let offset = from
                .filter(|from| is_name(from.y))
                .map(|from| self.scale.share(self.value) - (from.x - rect.left() - INSET) / length);
            ui.data_mut(|data| {
                data.insert_temp(scrolls, way.y.abs() > way.x.abs());
                data.insert_temp(held_at, offset.unwrap_or(0.0));
            });
        }
        let is_held = response.dragged() && !response.clicked();
        if is_held && ui.data(|data| data.get_temp::<bool>(scrolls)).unwrap_or(false) {
            ui.scroll_with_delta(vec2(0.0, response.drag_delta().y));
            return None;
        }
        let at = response.interact_pointer_pos()?;
        let share = (at.x - rect.left() - INSET) / length;
        match () {
            () if is_held => Some(share + ui.data(|data| data.get_temp::<f32>(held_at)).unwrap_or(0.0)),
            () if response.clicked() && !is_name(at.y) => Some(share),
            () => None,
        }
    }

    /// The place that arrow keys chose.
    fn stepped(&self, ui: &Ui, response: &Response) -> Option<f32> {
        if !response.has_focus() {
            return None;
        }
        let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let (left, right, far) =
            ui.input(|i| (i.num_presses(Key::ArrowLeft), i.num_presses(Key::ArrowRight), i.modifiers.shift));
        let asked = |action| ui.input(|i| i.num_accesskit_action_requests(response.id, action));
        let steps = (right + asked(Action::Increment)) as f32 - (left + asked(Action::Decrement)) as f32;
        let step = if far { KEY_STEPS.1 } else { KEY_STEPS.0 };
        // A step over whole numbers goes at least to the next.
        let least = if self.scale.whole { self.share_of_one() } else { 0.0 };
        (steps != 0.0).then(|| self.scale.share(self.value) + steps * step.max(least))
    }

    /// How much of the rail the way to the next whole number takes.
    fn share_of_one(&self) -> f32 {
        let next = if self.value < self.scale.max { self.value + 1.0 } else { self.value - 1.0 };
        (self.scale.share(next) - self.scale.share(self.value)).abs()
    }

    /// The number, which is typed: Enter takes it, Esc leaves it as it was.
    fn number(&self, ui: &mut Ui, rect: Rect) -> Option<f64> {
        let mut chosen = None;
        let shown = self.fitted(ui, rect.width() - 12.0);
        let text = shown.clone();
        let value = |new: Option<f64>| {
            chosen = new.or(chosen);
            chosen.unwrap_or(self.value)
        };
        // A child of its own does not move what comes after it.
        let ui = &mut ui.new_child(UiBuilder::new().id_salt("number").max_rect(rect.shrink2(vec2(2.0, 3.0))));
        ui.spacing_mut().button_padding.x = 4.0;
        ui.spacing_mut().interact_size = ui.available_size();
        ui.style_mut().drag_value_text_style = TextStyle::Small;
        let visuals = &mut ui.visuals_mut().widgets;
        visuals.inactive.weak_bg_fill = egui::Color32::TRANSPARENT;
        // Dragging is the rail's.
        let number = DragValue::from_get_set(value)
            .speed(0.0)
            .range(self.scale.min..=self.scale.max)
            .clamp_existing_to_range(false)
            .update_while_editing(false)
            .custom_formatter(|_, _| shown.clone())
            // Left as it was it stays exactly what it was.
            .custom_parser(move |new| if new == text { Some(self.value) } else { typed(new) });
        let response = ui.add(number).on_hover_cursor(CursorIcon::Text);
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.set_label(format!("{}: {}", self.label, self.text))
        });
        // What was typed is taken when the field loses the keyboard, unless Esc took it away.
        let (left, frame) = (Id::unique("a number was left by Esc"), ui.ctx().cumulative_frame_nr());
        if ui.input(|i| i.key_pressed(Key::Escape)) {
            ui.data_mut(|data| data.insert_temp(left, frame));
        }
        let is_left = ui.data(|data| data.get_temp::<u64>(left)).is_some_and(|at| frame <= at + 1);
        chosen.filter(|_| !is_left)
    }

    /// The value with its unit, or without one where there is no room for it.
    fn fitted(&self, ui: &Ui, room: f32) -> String {
        let font = TextStyle::Small.resolve(ui.style());
        let whole = ui.painter().layout_no_wrap(self.text.to_owned(), font, palette(ui).text);
        if whole.size().x <= room { self.text.to_owned() } else { self.scale.text(self.value) }
    }

    fn way_back(&self, ui: &mut Ui, rect: Rect) -> bool {
        let colour = palette(ui).accent;
        let ui = &mut ui.new_child(UiBuilder::new().id_salt("reset").max_rect(rect));
        let button = self.reset.map(|label| IconButton::new(Icon::Reset, label).colour(colour));
        button.is_some_and(|button| button.show(ui).clicked())
    }

    fn paint(&self, ui: &Ui, rect: Rect, response: &Response, value: f64) {
        let p = palette(ui);
        let painter = ui.painter();
        let body = TextStyle::Body.resolve(ui.style());
        let colour = if self.reset.is_some() { p.accent } else { p.text };
        let clipped = painter.with_clip_rect(rect.intersect(ui.clip_rect()));
        let name = pos2(rect.left() + 2.0, rect.top() + 11.0);
        clipped.text(name, Align2::LEFT_CENTER, self.label, body, colour);

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

/// The value that a screen reader asks for.
fn spoken(ui: &Ui, response: &Response) -> Option<f64> {
    ui.input(|i| {
        let mut requests = i.accesskit_action_requests(response.id, Action::SetValue);
        requests.find_map(|request| match request.data {
            Some(ActionData::NumericValue(value)) => Some(value),
            _ => None,
        })
    })
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
    fn numbers_are_typed_in_any_usual_form() {
        for (text, number) in
            [("2.5", 2.5), (" 2,5 m", 2.5), ("-7°", -7.0), ("\u{2212}7", -7.0), ("1e3", 1000.0)]
        {
            assert_eq!(typed(text), Some(number), "{text}");
        }
        for text in ["", "m", "1.2.3", "inf", "NaN", "e"] {
            assert_eq!(typed(text), None, "{text}");
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
