//! What the colours of strokes mean: only those that are there.

use super::snapshot::{Found, Snapshot};
use super::widgets::{card, palette};
use crate::app::messages::{Messages, Msg};
use crate::app::theme::Palette;
use egui::{Color32, CornerRadius, Rect, RichText, Sense, Ui, vec2};

/// The legend as a small card; nothing while nothing is understood.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, messages: &Messages) {
    let p = palette(ui);
    let entries = entries(&snapshot.found, p);
    if entries.is_empty() {
        return;
    }
    card(ui).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        ui.spacing_mut().interact_size.y = 18.0;
        ui.label(RichText::new(messages.get(Msg::LegendTitle)).size(12.0).color(p.weak));
        for (msg, colour) in entries {
            ui.horizontal(|ui| {
                let (rect, _) = ui.allocate_exact_size(vec2(22.0, 18.0), Sense::hover());
                let line = Rect::from_center_size(rect.center(), vec2(20.0, 4.0));
                ui.painter().rect_filled(line, CornerRadius::same(2), colour);
                ui.label(RichText::new(messages.get(msg)).size(13.0).color(p.text));
            });
        }
    });
}

fn entries(found: &Found, p: &Palette) -> Vec<(Msg, Color32)> {
    let all = [
        (found.petals, Msg::LegendPetal, p.petal),
        (found.leaves, Msg::LegendLeaf, p.leaf),
        (found.branch_levels > 0, Msg::LegendTrunk, p.branch_level(0)),
        (found.branch_levels > 1, Msg::LegendBranch, p.branch_level(1)),
        (found.branch_levels > 2, Msg::LegendTwig, p.branch_level(2)),
        (found.branch_outlines, Msg::ToolBranchOutline, p.branch_outline),
        (found.leaf_outlines, Msg::ToolLeafOutline, p.leaf_outline),
        (found.crowns, Msg::ToolCrown, p.crown),
        (found.pots, Msg::LegendPot, p.pot),
        (found.ground, Msg::LegendGround, p.earth),
        (found.ignored, Msg::LegendIgnored, p.ignored),
    ];
    all.into_iter().filter(|(there, ..)| *there).map(|(_, msg, colour)| (msg, colour)).collect()
}
