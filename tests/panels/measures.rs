//! Everything is large enough to be touched, nothing overlaps, nothing leaves the window, and nothing moves by itself.

use super::stage::{self, ROLES, Stage, asked, busy, english, press, stage};
use egui::{Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use penstemon::app::action::Action;
use penstemon::app::canvas_tool::CanvasTool;
use penstemon::app::messages::{Language, Messages, Msg};
use penstemon::app::panels::snapshot::{Dialog, ReferenceState};
use penstemon::app::settings::{Handedness, ThemeChoice};
use penstemon::app::theme::TARGET;

/// Every widget that can be touched, with its name and the part of it that is in the window.
fn targets(harness: &Harness<'_, Stage>) -> Vec<(String, Rect)> {
    let all =
        harness.get_all(egui_kittest::kittest::By::new().predicate(|node| ROLES.contains(&node.role())));
    let named = |node: egui_kittest::Node<'_>| {
        let node_rect = node.rect();
        let label = node.accesskit_node().label().unwrap_or_default();
        (label, node_rect)
    };
    all.map(named).collect()
}

/// Every state whose measures are checked.
fn states() -> Vec<(&'static str, Stage)> {
    let state = |change: &dyn Fn(&mut Stage)| {
        let mut stage =
            Stage { snapshot: busy(), messages: english(), actions: Vec::new(), canvas: Rect::NOTHING };
        change(&mut stage);
        stage
    };
    let mut found = vec![("right-handed", state(&|_| ()))];
    found.push(("left-handed", state(&|s| s.snapshot.handedness = Handedness::Left)));
    found.push(("without side panel", state(&|s| s.snapshot.side_shown = false)));
    found
}

#[test]
fn everything_that_can_be_touched_is_large_enough() {
    for language in Language::ALL {
        for page in [Msg::TabPlant, Msg::TabShape, Msg::TabView] {
            let mut snapshot = busy();
            snapshot.reference = Some(ReferenceState { opacity: 0.5, locked: false });
            snapshot.beside = super::beside::garden(Some(0)).beside;
            let mut harness = stage(snapshot, language);
            press(&mut harness, Messages::new(language).get(page));
            check_sizes(&harness);
        }
        for dialog in
            [Dialog::Unsaved, Dialog::Export, Dialog::Pen, Dialog::PlantSpecies(None), Dialog::About]
        {
            let mut snapshot = busy();
            snapshot.dialog = Some(dialog);
            check_sizes(&stage(snapshot, language));
        }
        let mut harness = stage(busy(), language);
        let menus = [Msg::FileMenu, Msg::SettingsTitle];
        for menu in menus {
            press(&mut harness, Messages::new(language).get(menu));
            check_sizes(&harness);
        }
    }
}

fn check_sizes(harness: &Harness<'_, Stage>) {
    let all = targets(harness);
    assert!(all.len() > 15, "only {} targets", all.len());
    for (label, rect) in all {
        let enough = rect.width() >= TARGET - 0.5 && rect.height() >= TARGET - 0.5;
        assert!(enough, "{label:?} is {} × {}", rect.width(), rect.height());
    }
}

#[test]
fn nothing_overlaps_and_nothing_leaves_the_window() {
    for language in Language::ALL {
        for (name, state) in states() {
            let harness = stage(state.snapshot, language);
            let window = Rect::from_min_size(egui::Pos2::ZERO, vec2(1280.0, 800.0));
            let canvas = harness.state().canvas;
            assert!(canvas.width() > 700.0 && canvas.height() > 600.0, "{name}: {canvas:?}");
            let bottom = window.bottom();
            // what a scrolled page holds below the window's edge is not seen
            let all: Vec<_> =
                targets(&harness).into_iter().filter(|(_, rect)| rect.bottom() <= bottom - 30.0).collect();
            for (i, (label, rect)) in all.iter().enumerate() {
                assert!(
                    window.expand(0.5).contains_rect(*rect),
                    "{name}: {label} leaves the window: {rect:?}"
                );
                assert!(
                    !canvas.shrink(1.0).intersects(*rect),
                    "{name}: {label} lies on the canvas: {rect:?}"
                );
                for (other, place) in &all[i + 1..] {
                    let common = rect.intersect(*place);
                    let apart = common.width() <= 1.0 || common.height() <= 1.0;
                    assert!(apart, "{name}, {language:?}: {label} {rect:?} lies on {other} {place:?}");
                }
            }
        }
    }
}

#[test]
fn left_handed_is_the_mirror_image() {
    let mut snapshot = busy();
    let right = stage(snapshot.clone(), Language::English);
    snapshot.handedness = Handedness::Left;
    let left = stage(snapshot, Language::English);
    let tool = |harness: &Harness<'_, Stage>| harness.get_by_label("Partial eraser").rect().center().x;
    assert!(tool(&right) < 80.0 && tool(&left) > 1200.0);
}

#[test]
fn a_small_window_still_reaches_everything() {
    let harness = stage::stage_of(busy(), Language::English, vec2(800.0, 480.0), 1.0, None);
    assert!(harness.state().canvas.width() >= 300.0);
    assert!(harness.get_by_label("Export").rect().right() <= 800.0);
    let mut harness = harness;
    harness.get_by_label("Hand").scroll_to_me();
    harness.run();
    press(&mut harness, "Hand");
    assert_eq!(asked(&mut harness), [Action::SetTool(CanvasTool::Pan)]);
}

#[test]
fn an_idle_interface_asks_for_no_more_frames() {
    let mut harness = stage(busy(), Language::English);
    harness.run();
    harness.step();
    let wait = harness.output().viewport_output.values().map(|v| v.repaint_delay).min().unwrap();
    assert!(wait > std::time::Duration::from_secs(1), "{wait:?}");
}

#[test]
fn everything_that_can_be_touched_is_distinguished_from_everything_else() {
    for language in Language::ALL {
        let mut snapshot = busy();
        snapshot.theme = ThemeChoice::Light;
        let mut harness = stage(snapshot, language);
        press(&mut harness, Messages::new(language).get(Msg::SettingsTitle));
        // Where two have one name for egui, it writes that over them, in the colour of errors.
        let clash = |shape: &egui::epaint::ClippedShape| match &shape.shape {
            egui::Shape::Text(text) => text.galley.text().contains("widget ID"),
            _ => false,
        };
        assert!(!harness.output().shapes.iter().any(clash), "{language:?}");
    }
}
