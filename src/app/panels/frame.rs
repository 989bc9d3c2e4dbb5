//! All panels in their places around the canvas, for either hand.

use super::snapshot::Snapshot;
use super::widgets::{palette, segments};
use super::{
    beside, dialogs, focus, growth, legend, materials, notices, opening, parameters, part_menu, petals,
    plant_tools, presets, readings, season, seed, species, status, toolbar, view,
};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use crate::app::settings::{Handedness, SIDE_WIDTH};
use crate::app::theme::{TARGET, TOOL};
use egui::{Align2, Area, Frame, Id, Margin, Order, Panel, Rect, ScrollArea, Stroke, Ui, vec2};

/// Height of the bar above the canvas.
const BAR: f32 = TARGET + 12.0;
/// Height of the status line.
const STATUS: f32 = 30.0;

/// A page of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Page {
    #[default]
    Plant,
    Shape,
    View,
}

/// Shows bars and side panel at the edges of `ui` and returns what is left for canvas and plant.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) -> Rect {
    let p = palette(ui);
    let frame = |x, y| Frame::NONE.fill(p.panel).inner_margin(Margin::symmetric(x, y));
    let fixed = |panel: Panel, size| panel.exact_size(size).resizable(false);
    fixed(Panel::top("bar"), BAR)
        .frame(frame(8, 4))
        .show(ui, |ui| toolbar::show(ui, snapshot, messages, out));
    fixed(Panel::bottom("status"), STATUS)
        .frame(frame(14, 0))
        .show(ui, |ui| status::show(ui, snapshot, messages));
    let right_handed = snapshot.handedness == Handedness::Right;
    let tools = if right_handed { Panel::left("tools left") } else { Panel::right("tools right") };
    fixed(tools, TOOL + 12.0).frame(frame(6, 6)).show(ui, |ui| toolbar::tools(ui, snapshot, messages, out));
    if snapshot.side_shown {
        side(ui, right_handed, snapshot, messages, out);
    }
    ui.available_rect_before_wrap()
}

fn side(ui: &mut Ui, right_handed: bool, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let p = palette(ui);
    let panel = if right_handed { Panel::right("side right") } else { Panel::left("side left") };
    let width = snapshot.side_width.clamp(SIDE_WIDTH.0, SIDE_WIDTH.2);
    let most = (ui.available_width() * 0.5).max(SIDE_WIDTH.0).min(SIDE_WIDTH.2);
    let panel = panel.default_size(width).size_range(SIDE_WIDTH.0..=most).resizable(true);
    let frame = Frame::NONE.fill(p.panel).inner_margin(Margin { left: 12, right: 4, top: 8, bottom: 0 });
    let shown = panel.frame(frame).show(ui, |ui| {
        let at = Id::unique("page of the side panel");
        let mut page: Page = ui.data(|data| data.get_temp(at)).unwrap_or_default();
        // What is selected in the view of the plant is shown.
        if beside::selection_changed(ui, snapshot) {
            page = Page::Plant;
            ui.data_mut(|data| data.insert_temp(at, page));
        }
        let pages = [
            (Page::Plant, messages.get(Msg::TabPlant)),
            (Page::Shape, messages.get(Msg::TabShape)),
            (Page::View, messages.get(Msg::TabView)),
        ];
        let bar = vec2(ui.available_width() - 8.0, TARGET);
        if let Some(new) = ui.allocate_ui(bar, |ui| segments(ui, &pages, page)).inner {
            page = new;
            ui.data_mut(|data| data.insert_temp(at, page));
        }
        let content = ScrollArea::vertical().id_salt(("page", page as u8)).auto_shrink([false, false]);
        content.show(ui, |ui| {
            ui.set_width(ui.available_width() - 10.0);
            match page {
                Page::Plant => {
                    petals::side(ui, snapshot, messages, out);
                    growth::show(ui, snapshot, messages, out);
                    season::show(ui, snapshot, messages, out);
                    opening::show(ui, snapshot, messages, out);
                    beside::show(ui, snapshot, messages, out);
                    species::show(ui, snapshot, messages, out);
                    seed::show(ui, snapshot, messages, out);
                    materials::show(ui, snapshot, messages, out);
                    presets::show(ui, snapshot, messages, out);
                }
                Page::Shape => parameters::show(ui, snapshot, messages, out),
                Page::View => view::show(ui, snapshot, messages, out),
            }
            ui.add_space(16.0);
            focus::reveal(ui);
        });
    });
    let now = shown.response.rect.width();
    if (now - width).abs() > 1.0 && ui.input(|i| i.pointer.any_released()) {
        out.push(Action::SetSideWidth(now));
    }
}

/// Shows the tools of the plant at the lower edge of its view and returns what is left for its picture.
pub fn plant_tools(
    ui: &mut Ui,
    view: Rect,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) -> Rect {
    plant_tools::show(ui, view, snapshot, messages, out)
}

/// Shows what floats above the canvas: legend, part menu, what can be done with a selection, notices, dialogs.
///
/// `canvas` is where the drawing is shown, in logical pixels.
pub fn overlays(ui: &Ui, canvas: Rect, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let ctx = ui.ctx();
    let (corner, pivot) = match snapshot.handedness {
        Handedness::Right => (canvas.left_bottom() + vec2(12.0, -12.0), Align2::LEFT_BOTTOM),
        Handedness::Left => (canvas.right_bottom() - vec2(12.0, 12.0), Align2::RIGHT_BOTTOM),
    };
    let area = Area::new(Id::unique("legend"))
        .order(Order::Middle)
        .fixed_pos(corner)
        .pivot(pivot)
        .interactable(false);
    area.show(ctx, |ui| legend::show(ui, snapshot, messages));
    readings::show(ctx, canvas, snapshot, messages, out);
    part_menu::selection(ctx, canvas, snapshot, messages, out);
    part_menu::show(ctx, canvas, snapshot, messages, out);
    notices::show(ctx, canvas, snapshot, messages, out);
    dialogs::show(ctx, snapshot, messages, out);
    focus::ring(ui);
}

/// A hairline between canvas and plant.
pub fn divider(ui: &Ui, x: f32, rect: Rect) {
    ui.painter().vline(x, rect.y_range(), Stroke::new(1.0, palette(ui).line));
}
