//! The few widgets that all panels are made of, each at least [`TARGET`] wide and high.

use super::icons::{self, Icon};
use crate::app::theme::{Palette, ROUND, TARGET};
use egui::{
    Align2, Color32, ComboBox, CornerRadius, FontId, Frame, Margin, Rect, Response, Role, Sense, Stroke,
    TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};

/// Side of an icon inside a button.
pub(super) const ICON: f32 = 22.0;

/// Width of a button whose name stands below its icon.
pub(super) const CAPTIONED: f32 = 92.0;

/// The colours that a piece of interface is shown in.
pub(super) fn palette(ui: &Ui) -> &'static Palette {
    Palette::in_use(ui.visuals())
}

/// A square button with an icon.
pub(super) struct IconButton<'a> {
    icon: Icon,
    label: &'a str,
    hint: String,
    side: f32,
    captioned: bool,
    chosen: bool,
    enabled: bool,
    colour: Option<Color32>,
}

impl<'a> IconButton<'a> {
    /// A button that is called `label` in its tooltip and by screen readers.
    pub(super) fn new(icon: Icon, label: &'a str) -> Self {
        let hint = label.to_owned();
        Self { icon, label, hint, side: TARGET, captioned: false, chosen: false, enabled: true, colour: None }
    }

    /// What the tooltip says.
    pub(super) fn hint(self, hint: String) -> Self {
        Self { hint, ..self }
    }

    /// Width and height.
    pub(super) fn side(self, side: f32) -> Self {
        Self { side, ..self }
    }

    /// Writes the name below the icon, for those who have no tooltips.
    pub(super) fn captioned(self) -> Self {
        Self { captioned: true, ..self }
    }

    /// Whether it is shown as chosen.
    pub(super) fn chosen(self, chosen: bool) -> Self {
        Self { chosen, ..self }
    }

    /// Whether it can be pressed.
    pub(super) fn enabled(self, enabled: bool) -> Self {
        Self { enabled, ..self }
    }

    /// Colour of the icon.
    pub(super) fn colour(self, colour: Color32) -> Self {
        Self { colour: Some(colour), ..self }
    }

    /// Shows it.
    pub(super) fn show(self, ui: &mut Ui) -> Response {
        let sense = if self.enabled { Sense::click() } else { Sense::hover() };
        let size = if self.captioned { vec2(CAPTIONED, self.side + 12.0) } else { Vec2::splat(self.side) };
        let (rect, response) = ui.allocate_exact_size(size, sense);
        let p = palette(ui);
        let fill = ground(p, &response, self.chosen);
        ui.painter().rect_filled(rect.shrink(1.0), CornerRadius::same(ROUND), fill);
        let colour = self.colour.unwrap_or(if self.chosen { p.accent } else { p.text });
        let colour = if self.enabled { colour } else { colour.gamma_multiply(0.3) };
        let mut middle = rect.center();
        if self.captioned {
            middle.y -= 8.0;
            let line =
                Rect::from_min_max(pos2(rect.left() + 6.0, rect.bottom() - 24.0), rect.max - vec2(2.0, 4.0));
            fitted_text(ui, line, self.label, 12.0, p.text);
        }
        icons::paint(ui.painter(), Rect::from_center_size(middle, Vec2::splat(ICON)), self.icon, colour);
        if self.chosen {
            let mark = Rect::from_center_size(
                pos2(rect.left() + 3.5, rect.center().y),
                vec2(3.0, rect.height() * 0.5),
            );
            ui.painter().rect_filled(mark, CornerRadius::same(2), colour);
        }
        response.widget_info(|| WidgetInfo::selected(Role::Button, self.enabled, self.chosen, self.label));
        response.on_hover_text(self.hint)
    }
}

/// What lies behind a button without a frame.
fn ground(p: &Palette, response: &Response, chosen: bool) -> Color32 {
    if response.is_pointer_button_down_on() {
        p.accent_soft
    } else if chosen {
        if response.hovered() { p.card_hover } else { p.card }
    } else if response.hovered() {
        p.card
    } else {
        Color32::TRANSPARENT
    }
}

/// A button with a text, and an icon before it; `loud` for the one that people came for.
pub(super) fn text_button(ui: &mut Ui, icon: Option<Icon>, label: &str, loud: bool) -> Response {
    text_button_sized(ui, icon, label, loud, None)
}

/// The same, as wide as asked for.
pub(super) fn text_button_sized(
    ui: &mut Ui,
    icon: Option<Icon>,
    label: &str,
    loud: bool,
    width: Option<f32>,
) -> Response {
    let p = palette(ui);
    let enabled = ui.is_enabled();
    let (fill, text) = if loud { (p.accent, p.on_accent) } else { (p.card, p.text) };
    let galley = ui.painter().layout_no_wrap(label.to_owned(), TextStyle::Button.resolve(ui.style()), text);
    let before = if icon.is_some() { ICON + 6.0 } else { 0.0 };
    let content = before + galley.size().x;
    let size = vec2(width.unwrap_or(content + 30.0).max(TARGET), TARGET);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let fill = match () {
        () if response.is_pointer_button_down_on() => fill.lerp_to_gamma(p.text, 0.2),
        () if response.hovered() => fill.lerp_to_gamma(p.text, 0.09),
        () => fill,
    };
    ui.painter().rect_filled(rect, CornerRadius::same(ROUND), fill);
    let left = rect.center().x - content * 0.5;
    if let Some(icon) = icon {
        let square =
            Rect::from_center_size(pos2(left + ICON * 0.5, rect.center().y), Vec2::splat(ICON - 2.0));
        icons::paint(ui.painter(), square, icon, text);
    }
    let clipped = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    clipped.galley(pos2(left + before, rect.center().y - galley.size().y * 0.5), galley, text);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, label));
    response
}

/// A full line of a menu: icon, text, and a key or note at the end.
pub(super) fn menu_line(ui: &mut Ui, icon: Icon, label: &str, note: &str) -> Response {
    let width = ui.available_width().max(220.0);
    let enabled = ui.is_enabled();
    let (rect, response) = ui.allocate_exact_size(vec2(width, TARGET), Sense::click());
    let p = palette(ui);
    ui.painter().rect_filled(rect, CornerRadius::same(ROUND), ground(p, &response, false));
    let colour = if enabled { p.text } else { p.weak };
    let square = Rect::from_center_size(pos2(rect.left() + 22.0, rect.center().y), Vec2::splat(ICON - 2.0));
    icons::paint(ui.painter(), square, icon, colour);
    let font = TextStyle::Button.resolve(ui.style());
    let clipped = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    clipped.text(pos2(rect.left() + 42.0, rect.center().y), Align2::LEFT_CENTER, label, font, colour);
    let small = TextStyle::Small.resolve(ui.style());
    clipped.text(pos2(rect.right() - 10.0, rect.center().y), Align2::RIGHT_CENTER, note, small, p.weak);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, label));
    response
}

/// One of several choices side by side, over the whole width; the one that was pressed.
pub(super) fn segments<T: Copy + PartialEq>(ui: &mut Ui, choices: &[(T, &str)], current: T) -> Option<T> {
    let width = ui.available_width();
    let (rect, row) = ui.allocate_exact_size(vec2(width, TARGET), Sense::hover());
    let p = palette(ui);
    ui.painter().rect_filled(rect, CornerRadius::same(ROUND), p.card);
    let each = width / choices.len().max(1) as f32;
    let mut pressed = None;
    for (i, (value, label)) in choices.iter().enumerate() {
        let part = Rect::from_min_size(rect.min + vec2(each * i as f32, 0.0), vec2(each, TARGET));
        let response = ui.interact(part, row.id.with((*label, i)), Sense::click());
        let chosen = *value == current;
        let inner = part.shrink(3.0);
        if chosen {
            ui.painter().rect_filled(inner, CornerRadius::same(ROUND - 2), p.panel);
            ui.painter().rect_stroke(
                inner,
                CornerRadius::same(ROUND - 2),
                Stroke::new(1.0, p.accent),
                egui::StrokeKind::Inside,
            );
        } else if response.hovered() {
            ui.painter().rect_filled(inner, CornerRadius::same(ROUND - 2), p.card_hover);
        }
        let colour = if chosen { p.accent } else { p.text };
        fitted_text(ui, inner, label, TextStyle::Button.resolve(ui.style()).size, colour);
        response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, chosen, *label));
        if response.clicked() && !chosen {
            pressed = Some(*value);
        }
    }
    pressed
}

/// One of several things out of a list that opens, behind its name, which takes a share of the width; the one that was pressed.
pub(super) fn list<T: Copy + PartialEq>(
    ui: &mut Ui,
    (label, share): (&str, f32),
    choices: &[(T, &str)],
    current: T,
) -> Option<T> {
    let mut value = current;
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width() * share, TARGET), Sense::hover());
        let font = TextStyle::Body.resolve(ui.style());
        let at = pos2(rect.left() + 6.0, rect.center().y);
        let clipped = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        clipped.text(at, Align2::LEFT_CENTER, label, font, palette(ui).text);
        ui.spacing_mut().interact_size.y = TARGET;
        let chosen = choices.iter().find(|(one, _)| *one == current).map_or("", |(_, name)| *name);
        let width = ui.available_width();
        let list = ComboBox::from_id_salt(label).width(width).selected_text(chosen).show_ui(ui, |ui| {
            ui.spacing_mut().interact_size.y = TARGET;
            ui.spacing_mut().button_padding.y = 10.0;
            for (one, name) in choices {
                ui.selectable_value(&mut value, *one, *name);
            }
        });
        list.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("{label}: {chosen}")));
    });
    (value != current).then_some(value)
}

/// A text in the middle of a rectangle, smaller than `largest` where it would not fit.
pub(super) fn fitted_text(ui: &Ui, rect: Rect, text: &str, largest: f32, colour: Color32) {
    let family = TextStyle::Button.resolve(ui.style()).family;
    let mut size = largest;
    loop {
        let font = FontId::new(size, family.clone());
        let galley = ui.painter().layout_no_wrap(text.to_owned(), font, colour);
        if galley.size().x <= rect.width() - 4.0 || size <= 10.0 {
            let place = rect.center() - galley.size() * 0.5;
            ui.painter().with_clip_rect(rect.intersect(ui.clip_rect())).galley(place, galley, colour);
            return;
        }
        size -= 0.5;
    }
}

/// A switch with its name, over the whole width; the new state when it was pressed.
pub(super) fn switch(ui: &mut Ui, label: &str, on: bool) -> Option<bool> {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), TARGET), Sense::click());
    let p = palette(ui);
    let enabled = ui.is_enabled();
    if response.hovered() {
        ui.painter().rect_filled(rect, CornerRadius::same(ROUND), p.card);
    }
    let font = TextStyle::Body.resolve(ui.style());
    let clipped = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    clipped.text(pos2(rect.left() + 6.0, rect.center().y), Align2::LEFT_CENTER, label, font, p.text);
    let track = Rect::from_center_size(pos2(rect.right() - 26.0, rect.center().y), vec2(36.0, 20.0));
    let place = ui.ctx().animate_bool(response.id, on);
    let fill = p.card_hover.lerp_to_gamma(p.accent, place);
    ui.painter().rect(
        track,
        CornerRadius::same(10),
        fill,
        Stroke::new(1.0, p.line),
        egui::StrokeKind::Inside,
    );
    let knob = pos2(egui::lerp(track.left() + 10.0..=track.right() - 10.0, place), track.center().y);
    ui.painter().circle_filled(knob, 7.0, if on { p.on_accent } else { p.weak });
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, enabled, on, label));
    response.clicked().then_some(!on)
}

/// A heading with what belongs to it.
pub(super) fn section<R>(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui) -> R) -> R {
    let p = palette(ui);
    ui.add_space(6.0);
    ui.label(egui::RichText::new(title).size(15.5).strong().color(p.text));
    ui.add_space(-2.0);
    let out = body(ui);
    ui.add_space(8.0);
    out
}

/// A card on a panel.
pub(super) fn card(ui: &Ui) -> Frame {
    let p = palette(ui);
    Frame::NONE
        .fill(p.panel)
        .stroke(Stroke::new(1.0, p.line))
        .corner_radius(CornerRadius::same(12))
        .inner_margin(Margin::symmetric(10, 8))
        .shadow(ui.visuals().popup_shadow)
}

/// A line of less important text that wraps.
pub(super) fn note(ui: &mut Ui, text: &str) {
    ui.label(egui::RichText::new(text).size(13.0).color(palette(ui).weak));
}
