//! What strokes were read as together: a card that takes each reading back with one tap, and pictures of all ways to read
//! some strokes.

use super::snapshot::{ReadTogether, Snapshot, Ways};
use super::tiles;
use super::widgets::{card, note, palette, text_button};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg, Named};
use crate::app::settings::Handedness;
use crate::app::theme::{Palette, ROUND, TARGET};
use crate::app::ways_to_read::{PictureLine, WayToRead, holds};
use crate::sketch::Verdict;
use egui::{
    Align, Align2, Area, Context, CornerRadius, Id, Layout, Margin, Order, Pos2, Rect, Response, Role,
    ScrollArea, Sense, Shape, Stroke, TextStyle, Ui, WidgetInfo, pos2, vec2,
};

/// Width of the card, logical pixels, where there is room.
const WIDTH: f32 = 246.0;
/// Readings that are seen without scrolling.
const ROWS: f32 = 4.0;
/// Pictures in a row.
const COLUMNS: usize = 2;
/// Space around a picture within its tile.
const MARGIN: f32 = 9.0;
/// Thinnest and thickest line of a picture.
const LINES: (f32, f32) = (1.6, 14.0);

/// The card of readings in the upper corner of `canvas` that is away from the plant; nothing while nothing was read together.
pub fn show(ctx: &Context, canvas: Rect, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    if snapshot.readings.is_empty() {
        return;
    }
    let (corner, pivot) = match snapshot.handedness {
        Handedness::Right => (canvas.left_top() + vec2(12.0, 12.0), Align2::LEFT_TOP),
        Handedness::Left => (canvas.right_top() + vec2(-12.0, 12.0), Align2::RIGHT_TOP),
    };
    let area = Area::new(Id::unique("readings")).order(Order::Middle).fixed_pos(corner).pivot(pivot);
    area.constrain_to(canvas).show(ctx, |ui| {
        card(ui).inner_margin(Margin::same(4)).show(ui, |ui| {
            ui.set_width(WIDTH.min(canvas.width() - 32.0));
            ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
            let most = (ROWS * (TARGET + 4.0)).min(canvas.height() * 0.5);
            ScrollArea::vertical().max_height(most).show(ui, |ui| {
                for read in &snapshot.readings {
                    ui.push_id(read.stroke, |ui| row(ui, read, messages, out));
                }
            });
        });
    });
}

/// One reading: a press on it shows the other ways, its button takes it back.
fn row(ui: &mut Ui, read: &ReadTogether, messages: &Messages, out: &mut Vec<Action>) {
    let name = messages.name(Named::Reading, read.reading.name());
    let size = vec2(ui.available_width(), TARGET);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        let refuse = text_button(ui, None, messages.get(Msg::ReadTogetherRefuse), false);
        if refuse.on_hover_text(messages.fill(Msg::ReadTogetherRefuseHint, &[("name", &name)])).clicked() {
            out.push(Action::RefuseReading(read.stroke));
        }
        let named = named(ui, read, &name, messages);
        if named.hovered() {
            set_pointed_at(ui.ctx(), read);
        }
        if named.clicked() {
            let at = [named.rect.left(), named.rect.bottom() - 8.0];
            out.push(Action::ShowWays { stroke: read.stroke, at });
        }
    });
}

/// What strokes were read as and how many they are, as a button over the rest of a row.
fn named(ui: &mut Ui, read: &ReadTogether, name: &str, messages: &Messages) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), TARGET), Sense::click());
    let p = palette(ui);
    if response.hovered() {
        ui.painter().rect_filled(rect, CornerRadius::same(ROUND), p.card);
    }
    let count = messages.fill(Msg::PartSelected, &[("count", &read.count)]);
    let clipped = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let font = TextStyle::Button.resolve(ui.style());
    let left = pos2(rect.left() + 8.0, rect.center().y);
    let written = clipped.text(left, Align2::LEFT_CENTER, name, font, p.text);
    let behind = pos2(written.right() + 8.0, rect.center().y + 1.0);
    clipped.text(behind, Align2::LEFT_CENTER, &count, TextStyle::Small.resolve(ui.style()), p.weak);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{name}, {count}")));
    response.on_hover_text(messages.get(Msg::ReadTogetherHint))
}

/// Where it is kept which reading the pointer is over, and in which pass.
fn pointed_id() -> Id {
    Id::unique("reading under the pointer")
}

fn set_pointed_at(ctx: &Context, read: &ReadTogether) {
    let now = (read.stroke, ctx.cumulative_pass_nr());
    ctx.data_mut(|data| data.insert_temp(pointed_id(), now));
}

/// The first stroke of the reading that the pointer is over in this pass.
pub fn pointed_at(ctx: &Context) -> Option<u64> {
    let (stroke, pass) = ctx.data(|data| data.get_temp::<(u64, u64)>(pointed_id()))?;
    (pass == ctx.cumulative_pass_nr()).then_some(stroke)
}

/// What some strokes are read as, and pictures of the ways in which they can be.
pub(super) fn ways(ui: &mut Ui, ways: &Ways, messages: &Messages, out: &mut Vec<Action>) {
    let now = match ways.reading {
        Some(reading) => {
            let name = messages.name(Named::Reading, reading.name());
            messages.fill(Msg::ReadTogetherNow, &[("count", &ways.count), ("name", &name)])
        }
        None => messages.fill(Msg::ReadTogetherApart, &[("count", &ways.count)]),
    };
    note(ui, &now);
    // As long as they are looked for, there are two empty places: most strokes can be read in two ways.
    let found = ways.found.as_deref();
    let extent = extent(found.unwrap_or_default());
    let count = found.map_or(COLUMNS, <[WayToRead]>::len);
    ui.scope(|ui| {
        tiles::grid(
            ui,
            COLUMNS,
            count,
            |width| 0.72 * width + 22.0,
            |ui, index, size| match found.and_then(|found| found.get(index)) {
                Some(way) => tile(ui, size, (way, ways, extent), messages, out),
                None => drop(ui.allocate_exact_size(size, Sense::hover())),
            },
        );
    });
}

fn tile(
    ui: &mut Ui,
    size: egui::Vec2,
    (way, all, extent): (&WayToRead, &Ways, egui::Vec2),
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let name = match way.correction.verdict {
        Verdict::As(reading) | Verdict::Not(reading) => messages.name(Named::Reading, reading.name()),
        Verdict::Separate if all.count == 1 => messages.get(Msg::ReadTogetherItself).to_owned(),
        Verdict::Separate => messages.get(Msg::ReadTogetherSeparate).to_owned(),
    };
    let is_now = holds(way, all.reading);
    let response = tiles::picture(ui, size, None, &name, true, is_now);
    let rect = response.rect;
    let place = Rect::from_min_max(rect.min, pos2(rect.right(), rect.bottom() - 22.0)).shrink(MARGIN);
    let side = (place.size() / extent).min_elem();
    let square = Rect::from_center_size(place.center(), egui::Vec2::splat(side));
    let p = palette(ui);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    way.lines.iter().for_each(|line| {
        painter.add(shape(line, square, p));
    });
    if response.clicked() {
        out.push(if is_now { Action::ClosePartMenu } else { Action::Correct(way.correction.clone()) });
    }
}

/// How wide and high the pictures are, as shares of their square; never nothing.
fn extent(ways: &[WayToRead]) -> egui::Vec2 {
    let points = ways.iter().flat_map(|way| way.lines.iter()).flat_map(|line| &line.points);
    let from_middle = points.map(|[x, y]| 2.0 * vec2((x - 0.5).abs(), (y - 0.5).abs()));
    from_middle.fold(egui::Vec2::splat(0.05), egui::Vec2::max)
}

fn shape(line: &PictureLine, square: Rect, p: &Palette) -> Shape {
    let at = |[x, y]: [f32; 2]| square.min + vec2(x, y) * square.width();
    let points: Vec<Pos2> = line.points.iter().map(|point| at(*point)).collect();
    let stroke = Stroke::new((line.width * square.width()).clamp(LINES.0, LINES.1), p.shown(line.part));
    if line.is_closed { Shape::closed_line(points, stroke) } else { Shape::line(points, stroke) }
}
