//! The tools of the view of the plant: a small card in its lower corner, away from flowers. Under the tools stand the choices of
//! the one that is in hand.

use super::snapshot::Snapshot;
use super::widgets::{card, note};
use super::{brush, garden, petals, pose, space};
use crate::app::action::Action;
use crate::app::messages::{Messages, Msg};
use egui::{Align2, Area, Context, Id, Margin, Order, Rect, vec2};

/// Width of the card while a tool is in hand, logical pixels, where there is room.
const WIDTH: f32 = 200.0;

/// The card over `plant`, logical pixels; nothing where no tool has anything to work on.
pub(super) fn show(
    ctx: &Context,
    plant: Rect,
    snapshot: &Snapshot,
    messages: &Messages,
    out: &mut Vec<Action>,
) {
    let (of_petals, of_branches, of_poses) = (snapshot.petals, snapshot.space, snapshot.pose);
    let has_petals = of_petals.any || of_petals.on;
    let of_brushes = snapshot.brush;
    let has_wood = of_branches.any || of_branches.on || of_brushes.tool.is_some();
    let has_parts = of_poses.any || of_poses.on;
    let of_garden = &snapshot.garden;
    let has_garden = of_garden.any || of_garden.on;
    if !(has_petals || has_wood || has_parts || has_garden) || plant.width() < 80.0 {
        return;
    }
    let corner = plant.left_bottom() + vec2(12.0, -12.0);
    let area = Area::new(Id::unique("plant tools"))
        .order(Order::Middle)
        .fixed_pos(corner)
        .pivot(Align2::LEFT_BOTTOM);
    area.constrain_to(plant).show(ctx, |ui| {
        card(ui).inner_margin(Margin::same(4)).show(ui, |ui| {
            ui.horizontal(|ui| {
                if has_wood {
                    space::button(ui, &of_branches, messages, out);
                }
                if has_parts {
                    pose::button(ui, &of_poses, messages, out);
                }
                if has_wood {
                    brush::buttons(ui, &of_brushes, messages, out);
                }
                if has_petals {
                    petals::button(ui, &of_petals, messages, out);
                }
                if has_garden {
                    garden::button(ui, of_garden, messages, out);
                }
            });
            if of_garden.on {
                garden::options(ui, snapshot, messages, out);
            }
            if of_branches.on || of_poses.on || of_petals.on {
                ui.horizontal(|ui| match (of_branches.on, of_poses.on) {
                    (true, _) => space::options(ui, &of_branches, messages, out),
                    (_, true) => pose::options(ui, &of_poses, messages, out),
                    _ => petals::options(ui, &of_petals, messages, out),
                });
            }
            let said = of_petals.on.then(|| petals::said(&of_petals));
            let said = said.or_else(|| of_branches.on.then(|| space::said(&of_branches)));
            let said = said.or_else(|| of_brushes.tool.map(brush::said));
            let said = said.or_else(|| of_garden.on.then(|| garden::said(of_garden)));
            let said = said.or_else(|| of_poses.on.then(|| pose::said(&of_poses)));
            if let Some(said) = said.or_else(|| snapshot.view.walking.then_some(Msg::ViewWalking)) {
                let width = if of_garden.on { garden::WIDTH } else { WIDTH };
                ui.set_max_width(width.min(plant.width() - 32.0));
                brush::rails(ui, &of_brushes, messages, out);
                pose::rails(ui, &of_poses, messages, out);
                garden::rails(ui, of_garden, messages, out);
                note(ui, messages.get(said));
                if let Some(count) = of_garden.plants.filter(|_| of_garden.on) {
                    note(ui, &messages.fill(Msg::GardenCount, &[("count", &count)]));
                }
            }
        });
    });
}
