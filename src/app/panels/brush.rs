//! The brushes, as the bar below the plant shows them: which is in hand, and its size, density and guide.

use super::icons::Icon;
use super::rail;
use super::snapshot::BrushState;
use super::widgets::IconButton;
use crate::app::action::Action;
use crate::app::brush_settings::BrushSettings;
use crate::app::messages::{Messages, Msg};
use crate::sketch::{BRUSH_DENSITIES, BRUSH_GUIDES, Tool};
use egui::Ui;

/// The brushes, each with its key, what it is called and what it is for.
const BRUSHES: [(Tool, Icon, char, Msg, Msg); 5] = [
    (Tool::GrowthBrush, Icon::GrowthBrush, 'U', Msg::BrushGrow, Msg::BrushGrowHint),
    (Tool::LeafBrush, Icon::LeafBrush, 'Y', Msg::BrushLeaves, Msg::BrushLeavesHint),
    (Tool::FlowerBrush, Icon::FlowerBrush, 'M', Msg::BrushFlowers, Msg::BrushFlowersHint),
    (Tool::PruningBrush, Icon::PruningBrush, 'X', Msg::BrushPrune, Msg::BrushPruneHint),
    (Tool::LightBrush, Icon::LightBrush, 'I', Msg::BrushLight, Msg::BrushLightHint),
];

/// The brushes to take up.
pub(super) fn buttons(ui: &mut Ui, state: &BrushState, messages: &Messages, out: &mut Vec<Action>) {
    for (tool, icon, key, name, hint) in BRUSHES {
        let name = messages.get(name);
        let hint = format!("{name} ({key})\n{}", messages.get(hint));
        let is_chosen = state.tool == Some(tool);
        if IconButton::new(icon, name).hint(hint).chosen(is_chosen).show(ui).clicked() {
            out.push(Action::TakeBrush((!is_chosen).then_some(tool)));
        }
    }
}

/// How the brush in hand is set: what of its settings means anything.
pub(super) fn rails(ui: &mut Ui, state: &BrushState, messages: &Messages, out: &mut Vec<Action>) {
    let Some(tool) = state.tool else { return };
    let (now, usual) = (state.settings, BrushSettings::default());
    let mut slider = |msg: Msg, range: (f32, f32), value: f32, usual: f32| {
        let text = format!("{:.0} %", value * 100.0);
        rail::setting(ui, (messages.get(msg), &text), range, (value, usual), messages.get(Msg::BrushReset))
    };
    let size = slider(Msg::BrushSize, BrushSettings::SIZES, now.size, usual.size);
    out.extend(size.map(|size| Action::SetBrush(BrushSettings { size, ..now })));
    if matches!(tool, Tool::GrowthBrush | Tool::LeafBrush | Tool::FlowerBrush) {
        let density = slider(Msg::BrushDensity, BRUSH_DENSITIES.into_inner(), now.density, usual.density);
        out.extend(density.map(|density| Action::SetBrush(BrushSettings { density, ..now })));
    }
    if matches!(tool, Tool::GrowthBrush | Tool::LightBrush) {
        let name = if tool == Tool::LightBrush { Msg::BrushStrength } else { Msg::BrushGuide };
        let guide = slider(name, BRUSH_GUIDES.into_inner(), now.guide, usual.guide);
        out.extend(guide.map(|guide| Action::SetBrush(BrushSettings { guide, ..now })));
    }
}

/// What the pen does now.
pub(super) fn said(tool: Tool) -> Msg {
    match tool {
        Tool::PruningBrush => Msg::BrushPruning,
        Tool::LightBrush => Msg::BrushLighting,
        Tool::LeafBrush | Tool::FlowerBrush => Msg::BrushPainting,
        _ => Msg::BrushGrowing,
    }
}
