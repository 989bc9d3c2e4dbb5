//! The pen: which one it is and how it is read, a place to try it, how it presses, what its buttons do, what its tablet
//! covers, and what the tablet's keys do (`tablet_keys`).

use super::icons::Icon;
use super::snapshot::{PenLive, PenState, Snapshot};
use super::widgets::{list, note, palette, section, segments, switch, text_button, text_button_sized};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::pen_settings::{Covers, PenSettings, TabletDoubt};
use crate::app::pen_uses::ButtonUse;
use crate::app::theme::TARGET;
use crate::pen::mapping::Turn;
use crate::pen::{PenSource, PressureCurve};
use egui::{ComboBox, CornerRadius, Id, Pos2, Rect, Role, ScrollArea, Sense, Shape, Stroke, Ui, WidgetInfo};
use egui::{Vec2, vec2};

/// Height of the place to try the pen, and of the curve.
const PAD: f32 = 168.0;
/// Radius within which a handle of the curve is taken, and with which it is shown.
const HANDLE: (f32, f32) = (TARGET * 0.5, 7.0);
/// Width of a line under full pressure.
const WIDEST_LINE: f32 = 9.0;
/// Most samples that the place to try the pen keeps.
const MOST_TRIED: usize = 4000;
/// Pieces of the drawn curve.
const PIECES: usize = 48;

/// What stands in the dialog; `height` is the window's.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, height: f32, messages: &Messages, out: &mut Vec<Action>) {
    let mut pen = snapshot.pen.settings;
    who(ui, snapshot, messages);
    ScrollArea::vertical().max_height((height - 260.0).max(160.0)).show(ui, |ui| {
        section(ui, messages.get(Msg::PenSource), |ui| source(ui, snapshot, messages, out));
        if !snapshot.pen.doubts.is_empty() {
            section(ui, messages.get(Msg::PenModel), |ui| {
                snapshot.pen.doubts.iter().for_each(|doubt| model(ui, doubt, messages, out));
            });
        }
        ui.columns_const(|[left, right]| {
            section(left, messages.get(Msg::PenTry), |ui| try_out(ui, &snapshot.pen.live, &pen, messages));
            section(right, messages.get(Msg::PenPressure), |ui| {
                curve(ui, &mut pen.pressure, &snapshot.pen.live, messages);
            });
        });
        section(ui, messages.get(Msg::PenButtons), |ui| buttons(ui, &mut pen, messages));
        section(ui, messages.get(Msg::PenArea), |ui| area(ui, &mut pen, &snapshot.pen, messages));
        if snapshot.pen.is_raw {
            section(ui, messages.get(Msg::CalibrateTitle), |ui| {
                super::calibration::show(ui, &mut pen, snapshot.pen.target, messages);
            });
            section(ui, messages.get(Msg::TabletKeys), |ui| {
                super::tablet_keys::show(ui, &mut pen.keys, messages);
            });
        }
        super::focus::reveal(ui);
    });
    if pen != snapshot.pen.settings {
        out.push(Action::SetPen(pen));
    }
    super::export::buttons(ui, |ui| {
        if text_button(ui, None, messages.get(Msg::PenDone), true).clicked() {
            out.push(Action::CloseDialog);
        }
        if pen != PenSettings::default()
            && text_button(ui, Some(Icon::Reset), messages.get(Msg::PenReset), false).clicked()
        {
            out.push(Action::SetPen(PenSettings::default()));
        }
    });
}

/// The pen last used, and what it can do.
fn who(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages) {
    let name = snapshot.pen.device.as_deref().filter(|name| !name.is_empty());
    let none = if snapshot.pen.device.is_some() { Msg::PenOfSystem } else { Msg::PenNone };
    note(ui, name.unwrap_or(messages.get(none)));
    if let Some(percent) = snapshot.pen.battery {
        note(ui, &messages.fill(Msg::PenBattery, &[("percent", &percent)]));
    }
    if let Some(trouble) = &snapshot.pen.trouble {
        ui.colored_label(palette(ui).warning, trouble);
    }
}

fn source(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let choices = [
        (PenSource::Auto, messages.get(Msg::PenSourceAuto)),
        (PenSource::System, messages.get(Msg::PenSourceSystem)),
        (PenSource::Raw, messages.get(Msg::PenSourceRaw)),
    ];
    out.extend(segments(ui, &choices, snapshot.pen.source).map(Action::SetPenSource));
    let about = match snapshot.pen.source {
        PenSource::Auto => Msg::PenSourceAutoHint,
        PenSource::System => Msg::PenSourceSystemHint,
        PenSource::Raw => Msg::PenSourceRawHint,
    };
    note(ui, messages.get(about));
}

/// Which model a tablet is that may be one of several.
fn model(ui: &mut Ui, doubt: &TabletDoubt, messages: &Messages, out: &mut Vec<Action>) {
    let about = match (&doubt.taken, doubt.is_chosen) {
        (None, _) => Msg::PenModelNone,
        (Some(_), false) => Msg::PenModelGuess,
        (Some(_), true) => Msg::PenModelChosen,
    };
    note(ui, &messages.fill(about, &[("tablet", &doubt.name)]));
    let none = messages.get(Msg::PenModelChoose);
    let taken = doubt.taken.as_deref().unwrap_or(none);
    let label = messages.get(Msg::PenModel);
    ui.spacing_mut().interact_size.y = TARGET;
    let list =
        ComboBox::from_id_salt((label, &doubt.device)).width(ui.available_width()).selected_text(taken);
    let list = list.show_ui(ui, |ui| {
        ui.spacing_mut().interact_size.y = TARGET;
        ui.spacing_mut().button_padding.y = 10.0;
        for model in &doubt.models {
            if ui.selectable_label(doubt.taken.as_ref() == Some(model), model).clicked() {
                out.push(Action::SetTabletModel { device: doubt.device.clone(), model: model.clone() });
            }
        }
    });
    let name = format!("{label}: {taken}");
    list.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
}

/// A pad on which lines are as wide as they would be drawn.
fn try_out(ui: &mut Ui, live: &PenLive, pen: &PenSettings, messages: &Messages) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), PAD), Sense::DRAG);
    let p = palette(ui);
    ui.painter().rect(
        rect,
        CornerRadius::same(8),
        p.paper,
        Stroke::new(1.0, p.line),
        egui::StrokeKind::Inside,
    );
    let id = Id::unique("lines of the tried pen");
    let mut tried: Vec<Option<(Pos2, f32)>> = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if response.drag_started() || tried.len() > MOST_TRIED {
        tried.clear();
    }
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        tried.push(Some((at, pen.pressure.apply(live.pressure))));
    } else if tried.last().is_some_and(Option::is_some) {
        tried.push(None);
    }
    let painter = ui.painter().with_clip_rect(rect);
    for pair in tried.windows(2) {
        if let [Some((from, _)), Some((to, pressure))] = pair {
            painter.line_segment([*from, *to], Stroke::new(1.0 + WIDEST_LINE * pressure, p.ink));
        }
    }
    if tried.is_empty() {
        let font = egui::TextStyle::Body.resolve(ui.style());
        painter.text(rect.center(), egui::Align2::CENTER_CENTER, messages.get(Msg::PenTryHint), font, p.weak);
    }
    ui.data_mut(|data| data.insert_temp(id, tried));
    let tilt = messages.fill(
        Msg::PenLive,
        &[
            ("pressure", &(live.pressure * 100.0).round()),
            ("x", &live.tilt_deg[0].round()),
            ("y", &live.tilt_deg[1].round()),
        ],
    );
    note(ui, &tilt);
}

/// The pressure curve with its two ends, two handles, and the pen's own pressure on it.
fn curve(ui: &mut Ui, curve: &mut PressureCurve, live: &PenLive, messages: &Messages) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), PAD), Sense::hover());
    let p = palette(ui);
    ui.painter().rect(
        rect,
        CornerRadius::same(8),
        p.card,
        Stroke::new(1.0, p.line),
        egui::StrokeKind::Inside,
    );
    let inner = rect.shrink(12.0);
    let sound = curve.sound();
    for (name, at, set) in grips(&sound) {
        if let Some(to) = drag(ui, inner, (name, at), messages) {
            set(curve, to);
        }
    }
    let place = |[x, y]: [f32; 2]| inner.left_bottom() + vec2(x * inner.width(), -y * inner.height());
    let line = (0..=PIECES).map(|k| k as f32 / PIECES as f32).map(|x| place([x, curve.apply(x)]));
    ui.painter().add(Shape::line(line.collect(), Stroke::new(2.0, p.text)));
    for (_, at, _) in grips(&curve.sound()) {
        ui.painter().circle(place(at), HANDLE.1, p.panel, Stroke::new(2.0, p.accent));
    }
    if live.pressure > 0.0 {
        ui.painter().circle_filled(place([live.pressure, curve.apply(live.pressure)]), 5.0, p.warning);
    }
    let presets = [
        (PressureCurve::soft(), messages.get(Msg::PenSoft)),
        (PressureCurve::default(), messages.get(Msg::PenMedium)),
        (PressureCurve::hard(), messages.get(Msg::PenHard)),
    ];
    if let Some(preset) = segments(ui, &presets, *curve) {
        *curve = PressureCurve { start: curve.start, end: curve.end, ..preset };
    }
}

/// What can be dragged: its name, where it is, and what a new place means.
type Grip = (Msg, [f32; 2], fn(&mut PressureCurve, [f32; 2]));

fn grips(curve: &PressureCurve) -> [Grip; 4] {
    let in_box = |[x, y]: [f32; 2]| {
        let (start, end) = (curve.start, curve.end);
        [start[0] + x * (end[0] - start[0]), start[1] + y * (end[1] - start[1])]
    };
    [
        (Msg::PenCurveStart, curve.start, |c, to| {
            c.start = [to[0].min(c.end[0] - 0.05), to[1].min(c.end[1])]
        }),
        (Msg::PenCurveEnd, curve.end, |c, to| c.end = [to[0].max(c.start[0] + 0.05), to[1].max(c.start[1])]),
        (Msg::PenCurveHandle, in_box(curve.handles[0]), |c, to| c.handles[0] = share_of_box(c, to)),
        (Msg::PenCurveHandle, in_box(curve.handles[1]), |c, to| c.handles[1] = share_of_box(c, to)),
    ]
}

fn share_of_box(curve: &PressureCurve, at: [f32; 2]) -> [f32; 2] {
    let share = |k: usize| (at[k] - curve.start[k]) / (curve.end[k] - curve.start[k]).max(1e-3);
    [share(0).clamp(0.0, 1.0), share(1).clamp(0.0, 1.0)]
}

/// Lets one grip be dragged; where it is dragged to, 0 to 1.
fn drag(ui: &mut Ui, inner: Rect, (name, at): (Msg, [f32; 2]), messages: &Messages) -> Option<[f32; 2]> {
    let centre = inner.left_bottom() + vec2(at[0] * inner.width(), -at[1] * inner.height());
    let id = ui.next_auto_id();
    ui.skip_ahead_auto_ids(1);
    let response = ui.interact(Rect::from_center_size(centre, Vec2::splat(2.0 * HANDLE.0)), id, Sense::DRAG);
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, messages.get(name)));
    let to = response.interact_pointer_pos().filter(|_| response.dragged())?;
    let share = (to - inner.left_bottom()) / inner.size();
    Some([share.x.clamp(0.0, 1.0), (-share.y).clamp(0.0, 1.0)])
}

fn buttons(ui: &mut Ui, pen: &mut PenSettings, messages: &Messages) {
    let uses = &mut pen.uses;
    for (msg, usage) in [
        (Msg::PenLower, &mut uses.lower),
        (Msg::PenUpper, &mut uses.upper),
        (Msg::PenThird, &mut uses.third),
        (Msg::PenEraser, &mut uses.eraser),
    ] {
        let choices = ButtonUse::ALL.map(|one| (one, messages.get(name(one))));
        if let Some(new) = list(ui, (messages.get(msg), 0.45), &choices, *usage) {
            *usage = new;
        }
    }
}

fn name(usage: ButtonUse) -> Msg {
    match usage {
        ButtonUse::Pan => Msg::UsePan,
        ButtonUse::Orbit => Msg::UseOrbit,
        ButtonUse::Erase => Msg::UseErase,
        ButtonUse::ErasePartly => Msg::UseErasePartly,
        ButtonUse::Pick => Msg::UsePick,
        ButtonUse::Menu => Msg::UseMenu,
        ButtonUse::Undo => Msg::EditUndo,
        ButtonUse::Redo => Msg::EditRedo,
        ButtonUse::Nothing => Msg::UseNothing,
    }
}

/// What the tablet covers; only tablets that are read directly ask.
fn area(ui: &mut Ui, pen: &mut PenSettings, state: &PenState, messages: &Messages) {
    let is_raw = state.is_raw;
    note(ui, messages.get(if is_raw { Msg::PenAreaHint } else { Msg::PenAreaSystem }));
    ui.add_enabled_ui(is_raw, |ui| {
        let choices = [
            (Covers::Canvas, messages.get(Msg::PenAreaCanvas)),
            (Covers::Window, messages.get(Msg::PenAreaWindow)),
            (Covers::Monitor, messages.get(Msg::PenAreaMonitor)),
        ];
        if let Some(covers) = segments(ui, &choices, pen.covers) {
            pen.covers = covers;
        }
        if pen.covers == Covers::Monitor && state.monitors > 1 {
            monitor(ui, pen, state.monitors, messages);
        }
        if let Some(on) = switch(ui, messages.get(Msg::PenKeepAspect), pen.keeps_aspect) {
            pen.keeps_aspect = on;
        }
        note(ui, messages.get(Msg::PenTurned));
        let turns = [(Turn::None, "0°"), (Turn::Right, "90°"), (Turn::Half, "180°"), (Turn::Left, "270°")];
        if let Some(turn) = segments(ui, &turns, pen.turn) {
            pen.turn = turn;
        }
    });
}

/// Which of several monitors the tablet covers.
fn monitor(ui: &mut Ui, pen: &mut PenSettings, monitors: usize, messages: &Messages) {
    let names: Vec<String> = (1..=monitors).map(|number| number.to_string()).collect();
    let numbered = (0u8..).zip(&names).map(|(number, name)| (Some(number), name.as_str()));
    let choices: Vec<(Option<u8>, &str)> =
        std::iter::once((None, messages.get(Msg::PenMonitorUnder))).chain(numbered).collect();
    if let Some(monitor) = segments(ui, &choices, pen.monitor) {
        pen.monitor = monitor;
    }
}

/// The line in the toolbar's menu that opens the dialog.
pub fn open_button(ui: &mut Ui, messages: &Messages, out: &mut Vec<Action>) {
    let width = ui.available_width();
    if text_button_sized(ui, Some(Icon::Pen), messages.get(Msg::PenTitle), false, Some(width)).clicked() {
        out.push(Action::ShowDialog(super::snapshot::Dialog::Pen));
    }
}
