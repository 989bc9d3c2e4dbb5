//! The tools of the view of the plant: a bar below its picture, which covers nothing of it. Above the tools stand the choices of
//! the one that is in hand, and what the pen does with it.
//!
//! The bar is as high as what it shows was in the frame before; what stands lowest, the tools, stays where it is when choices come
//! and go.

use super::snapshot::Snapshot;
use super::widgets::{note, palette};
use super::{brush, garden, petals, pose, space};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use egui::{Id, Margin, Rect, Ui, UiBuilder, vec2};

/// Space between the edges of the bar and what is in it, logical pixels.
const MARGIN: Margin = Margin { left: 8, right: 8, top: 6, bottom: 6 };
/// Widest that sliders become, logical pixels.
const WIDTH: f32 = 380.0;
/// Narrower the view has no tools, logical pixels.
const LEAST_WIDTH: f32 = 80.0;
/// Narrower than this what is said has three lines of room, otherwise two, whatever it says: the picture does not move when a part is
/// chosen and something else is said.
const NARROW: f32 = 640.0;
/// Height of a line of it.
const LINE: f32 = 17.0;
/// Largest share of the view's height.
const MOST: f32 = 0.6;

/// The bar at the lower edge of `view`, logical pixels. Returns what is left for the picture: all of it where no tool has anything
/// to work on.
pub(super) fn show(
    ui: &mut Ui,
    view: Rect,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) -> Rect {
    if !Available::of(snapshot).any() || view.width() < LEAST_WIDTH {
        return view;
    }
    let at = Id::unique("height of the plant's tools");
    let known: f32 = ui.data(|data| data.get_temp(at)).unwrap_or_default();
    let height = known.min(MOST * view.height());
    let (picture, bar) = view.split_top_bottom_at_y((view.bottom() - height).round());
    ui.painter().rect_filled(bar, 0.0, palette(ui).panel);
    ui.painter().hline(bar.x_range(), bar.top(), (1.0, palette(ui).line));
    let mut within = ui.new_child(UiBuilder::new().max_rect(bar - MARGIN));
    within.shrink_clip_rect(bar);
    content(&mut within, snapshot, messages, out);
    let shown = within.min_rect().height() + MARGIN.sum().y;
    if (shown - known).abs() > 0.5 {
        ui.data_mut(|data| data.insert_temp(at, shown));
        ui.ctx().request_repaint();
    }
    picture
}

/// For which tools there is something to work on.
struct Available {
    wood: bool,
    parts: bool,
    petals: bool,
    garden: bool,
}

impl Available {
    fn of(snapshot: &Snapshot) -> Self {
        let Snapshot { petals, space, pose, garden, brush, .. } = snapshot;
        Self {
            wood: space.any || space.on || brush.tool.is_some(),
            parts: pose.any || pose.on,
            petals: petals.any || petals.on,
            garden: garden.any || garden.on,
        }
    }

    fn any(&self) -> bool {
        self.wood || self.parts || self.petals || self.garden
    }
}

fn content(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
    if let Some(said) = said(snapshot) {
        let lines = if ui.available_width() < NARROW { 3.0 } else { 2.0 };
        ui.scope(|ui| {
            ui.set_min_height(lines * LINE);
            note(ui, messages.get(said));
        });
        if snapshot.garden.on {
            // Without any, too: the bar keeps its height while somebody paints.
            let count = snapshot.garden.plants.unwrap_or_default();
            note(ui, &messages.fill(Msg::GardenCount, &[("count", &count)]));
        }
        ui.scope(|ui| {
            ui.set_max_width(WIDTH.min(ui.available_width()));
            brush::rails(ui, &snapshot.brush, messages, out);
            pose::rails(ui, &snapshot.pose, messages, out);
            garden::rails(ui, &snapshot.garden, messages, out);
        });
    }
    let Snapshot { petals, space, pose, garden, .. } = snapshot;
    if garden.on || space.on || pose.on || petals.on {
        ui.horizontal_wrapped(|ui| options(ui, snapshot, messages, out));
    }
    ui.horizontal_wrapped(|ui| tools(ui, snapshot, messages, out));
}

/// The choices of the tool in hand.
fn options(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    if snapshot.garden.on {
        garden::options(ui, snapshot, messages, out);
    } else if snapshot.space.on {
        space::options(ui, &snapshot.space, messages, out);
    } else if snapshot.pose.on {
        pose::options(ui, &snapshot.pose, messages, out);
    } else {
        petals::options(ui, &snapshot.petals, messages, out);
    }
}

/// What the pen does now.
fn said(snapshot: &Snapshot) -> Option<Msg> {
    let Snapshot { petals, space, pose, garden, brush, view, .. } = snapshot;
    let walking = view.walking.then_some(Msg::ViewWalking);
    let said = walking.or_else(|| petals.on.then(|| petals::said(petals)));
    let said = said.or_else(|| space.on.then(|| space::said(space)));
    let said = said.or_else(|| brush.tool.map(brush::said));
    let said = said.or_else(|| garden.on.then(|| garden::said(garden)));
    said.or_else(|| pose.on.then(|| pose::said(pose)))
}

/// The tools to take up.
fn tools(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages, out: &mut Vec<Action>) {
    let available = Available::of(snapshot);
    if available.wood {
        space::button(ui, &snapshot.space, messages, out);
    }
    if available.parts {
        pose::button(ui, &snapshot.pose, messages, out);
    }
    if available.wood {
        brush::buttons(ui, &snapshot.brush, messages, out);
    }
    if available.petals {
        petals::button(ui, &snapshot.petals, messages, out);
    }
    if available.garden {
        garden::button(ui, &snapshot.garden, messages, out);
    }
}
