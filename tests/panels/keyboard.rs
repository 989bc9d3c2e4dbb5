//! The keyboard reaches everything, in order, and is seen where it is.

use super::stage::{Stage, asked, busy, english, stage};
use egui::{Key, Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::{By, NodeT, Queryable};
use penstemon::app::action::Action;
use penstemon::app::messages::{Language, Msg};
use penstemon::app::panels::snapshot::Dialog;
use penstemon::app::theme::LIGHT;

/// Name and place of what has the keyboard.
fn focused(harness: &Harness<'_, Stage>) -> Option<(String, Rect)> {
    let node = harness.query_all(By::new().predicate(|node| node.is_focused())).next()?;
    let node_name = node.accesskit_node();
    Some((node_name.label().or_else(|| node_name.value()).unwrap_or_default(), node.rect()))
}

/// Whether a ring of the accent colour is seen around a place.
fn has_ring(harness: &Harness<'_, Stage>, place: Rect) -> bool {
    harness.output().shapes.iter().any(|clipped| match &clipped.shape {
        Shape::Rect(ring) => {
            let near =
                (ring.rect.min - place.min).length() < 4.0 && (ring.rect.max - place.max).length() < 4.0;
            near && ring.stroke.width >= 2.0 && ring.stroke.color == LIGHT.accent
        }
        _ => false,
    })
}

/// Every stop of Tab until the first comes again.
fn stops(harness: &mut Harness<'_, Stage>) -> Vec<(String, Rect)> {
    let mut stops: Vec<(String, Rect)> = Vec::new();
    for _ in 0..200 {
        harness.key_press(Key::Tab);
        harness.run();
        let Some((name, place)) = focused(harness) else { continue };
        if stops.first().is_some_and(|(first, _)| *first == name) {
            return stops;
        }
        assert!(!name.is_empty(), "something without a name at {place:?}");
        assert!(has_ring(harness, place), "no ring around {name} at {place:?}");
        stops.push((name, place));
    }
    panic!("Tab does not come round: {stops:?}");
}

#[test]
fn tab_goes_through_everything_and_a_ring_shows_where() {
    let mut harness = stage(busy(), Language::English);
    let stops = stops(&mut harness);
    let names: Vec<&str> = stops.iter().map(|(name, _)| name.as_str()).collect();
    for wanted in ["Menu", "Undo", "Export", "Petal", "Select", "Plant", "Shape", "Oak", "Roll the dice"] {
        assert!(names.contains(&wanted), "{wanted} is not reached: {names:?}");
    }
    let window = Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 800.0));
    for (name, place) in &stops {
        assert!(window.intersects(*place), "{name} is out of sight at {place:?}");
    }
}

#[test]
fn what_has_the_keyboard_is_pressed_by_enter_and_space() {
    for key in [Key::Enter, Key::Space] {
        let mut harness = stage(busy(), Language::English);
        harness.get_by_label(english().get(Msg::EditUndo)).focus();
        harness.run();
        harness.key_press(key);
        harness.run();
        assert_eq!(asked(&mut harness), [Action::Undo], "{key:?}");
    }
}

#[test]
fn a_dialog_keeps_the_keyboard_to_itself() {
    let mut snapshot = busy();
    snapshot.dialog = Some(Dialog::Unsaved);
    let mut harness = stage(snapshot, Language::English);
    let names: Vec<String> = stops(&mut harness).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names.len(), 3, "{names:?}");
    for wanted in ["Save", "Cancel", "Don't save"] {
        assert!(names.iter().any(|name| name == wanted), "{names:?}");
    }
}
