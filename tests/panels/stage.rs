//! A stage on which panels are shown without a window: a snapshot, a language, and the wishes that came out.

use super::pictures::Textures;
use egui::{Pos2, Rect, Role, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use penstemon::app::action::Action;
use penstemon::app::canvas_tool::CanvasTool;
use penstemon::app::fonts::{ChineseFont, definitions};
use penstemon::app::messages::{Language, Messages};
use penstemon::app::panels::snapshot::{Autosave, Found, PenUsed, Status, ViewState};
use penstemon::app::panels::{Snapshot, frame};
use penstemon::app::{settings, theme};
use penstemon::sketch::Tool;
use std::sync::OnceLock;

/// What a test sees.
pub(super) struct Stage {
    /// What panels read.
    pub(super) snapshot: Snapshot,
    /// Texts.
    pub(super) messages: Messages,
    /// What panels asked for since the last look.
    pub(super) actions: Vec<Action>,
    /// What bars and panels left over.
    pub(super) canvas: Rect,
}

/// A snapshot of somebody in the middle of work.
pub(super) fn busy() -> Snapshot {
    let settings = settings::Settings {
        recent: vec!["/home/ada/garden/daisy.penstemon".into(), "/home/ada/rose.penstemon".into()],
        ..Default::default()
    };
    let snapshot = Snapshot {
        name: Some("Meadow".into()),
        unsaved: true,
        tool: CanvasTool::Draw(Tool::Auto),
        can_undo: true,
        chinese_font: chinese_font().is_some(),
        species: "daisy".into(),
        seed: 17,
        view: ViewState { orthographic: false, ..ViewState::default() },
        found: Found {
            petals: true,
            leaves: true,
            branch_levels: 3,
            branch_outlines: false,
            leaf_outlines: true,
            crowns: true,
            ignored: true,
            ..Found::default()
        },
        status: Status {
            strokes: 42,
            flowers: 3,
            vertices: 18_240,
            triangles: 33_912,
            build_ms: Some(6.4),
            building: false,
            shortfall: None,
            pen: PenUsed::Pen(Some("Wacom Intuos".into())),
            autosave: Autosave::Journaled,
        },
        ..Default::default()
    };
    snapshot.with_settings(&settings)
}

/// A Chinese font of this machine, looked for once.
pub(super) fn chinese_font() -> Option<&'static ChineseFont> {
    static FONT: OnceLock<Option<ChineseFont>> = OnceLock::new();
    FONT.get_or_init(ChineseFont::of_system).as_ref()
}

/// All panels with this snapshot in a window of 1280 × 800.
pub(super) fn stage(snapshot: Snapshot, language: Language) -> Harness<'static, Stage> {
    let size = egui::vec2(1280.0, 800.0);
    stage_of(snapshot, language, size, 1.0, None)
}

/// The same in a window of another size, in logical pixels, at a scale.
pub(super) fn stage_of(
    snapshot: Snapshot,
    language: Language,
    size: egui::Vec2,
    scale: f32,
    textures: Option<Textures>,
) -> Harness<'static, Stage> {
    let theme = snapshot.theme.resolve(None);
    let state =
        Stage { snapshot, messages: Messages::new(language), actions: Vec::new(), canvas: Rect::NOTHING };
    let mut ready = false;
    // boxes for missing letters are looked for by a test of their own, which knows whether there is a Chinese font
    let builder = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(scale)
        .with_max_steps(120)
        .allow_missing_glyphs();
    let builder = match textures {
        Some(textures) => builder.renderer(textures),
        None => builder,
    };
    let mut harness = builder.build_ui_state(
        move |ui, stage: &mut Stage| {
            if !ready {
                ready = true;
                ui.ctx().set_fonts(definitions(chinese_font()));
                theme::apply(ui.ctx(), theme);
                ui.ctx().request_repaint();
            }
            let Stage { snapshot, messages, actions, canvas } = stage;
            *canvas = frame::show(ui, snapshot, messages, actions);
            let (canvas, plant) = canvas.split_left_right_at_fraction(0.5);
            frame::plant_tools(ui, plant, snapshot, messages, actions);
            frame::overlays(ui, canvas, snapshot, messages, actions);
        },
        state,
    );
    harness.run();
    harness
}

/// What was asked for since the last look.
pub(super) fn asked(harness: &mut Harness<'_, Stage>) -> Vec<Action> {
    std::mem::take(&mut harness.state_mut().actions)
}

/// What can be touched.
pub(super) const ROLES: [Role; 7] = [
    Role::Button,
    Role::ComboBox,
    Role::RadioButton,
    Role::CheckBox,
    Role::Slider,
    Role::TextInput,
    Role::DisclosureTriangle,
];

/// Presses what has this name.
pub(super) fn press(harness: &mut Harness<'_, Stage>, label: &str) {
    let touched = |node: &egui_kittest::Node<'_>| ROLES.contains(&node.accesskit_node().role());
    let found: Vec<_> = harness.query_all_by_label(label).filter(touched).collect();
    assert_eq!(found.len(), 1, "there should be one {label}");
    found[0].click();
    drop(found);
    harness.run();
}

/// Moves the pointer from a rail's middle by this much, held down, in small steps.
pub(super) fn drag(harness: &mut Harness<'_, Stage>, label: &str, by: Vec2) {
    let from = harness.get_by_label(label).rect().center();
    drag_from(harness, from, by);
}

/// The same for the rail of this name, whatever else has it.
pub(super) fn drag_rail(harness: &mut Harness<'_, Stage>, label: &str, by: Vec2) {
    let from = harness.get_by_role_and_label(Role::Slider, label).rect().center();
    drag_from(harness, from, by);
}

fn drag_from(harness: &mut Harness<'_, Stage>, from: Pos2, by: Vec2) {
    harness.drag_at(from);
    harness.step();
    for step in 1..=10 {
        harness.hover_at(from + by * (step as f32 / 10.0));
        harness.step();
    }
    harness.drop_at(from + by);
    harness.run();
}

pub(super) fn english() -> Messages {
    Messages::new(Language::English)
}
