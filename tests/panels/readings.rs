//! Strokes that were read together: what takes that back, and pictures of the ways to read them.

use super::stage::{Stage, asked, busy, press, stage};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use penstemon::anatomy::Part;
use penstemon::app::action::Action;
use penstemon::app::messages::{Language, Messages, Msg, Named};
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::snapshot::{MenuOf, PartMenu, ReadTogether, Ways};
use penstemon::app::settings::Handedness;
use penstemon::app::theme::TARGET;
use penstemon::app::ways_to_read::{PictureLine, Shown, WayToRead};
use penstemon::sketch::{Correction, Reading, Tool, Verdict};

/// A drawing of which these readings were made.
pub(super) fn read(readings: &[(Reading, usize)]) -> Snapshot {
    let together = |(&(reading, count), stroke)| ReadTogether { reading, stroke, count };
    Snapshot { readings: readings.iter().zip(10..).map(together).collect(), ..busy() }
}

/// The same with a menu of the ways to read the first of them.
pub(super) fn with_ways() -> Snapshot {
    let way = |verdict, part| WayToRead {
        correction: Correction::new([10, 11, 12], verdict),
        lines: [PictureLine {
            part: Shown::Part(part, 0),
            points: vec![[0.1, 0.9], [0.4, 0.2], [0.9, 0.3]],
            width: 0.0,
            is_closed: true,
        }]
        .into(),
    };
    let found = vec![
        way(Verdict::As(Reading::Tree), Part::Branch),
        way(Verdict::As(Reading::Fronds), Part::Crown),
        way(Verdict::Separate, Part::Leaf),
    ];
    let ways = Ways { count: 3, reading: Some(Reading::Tree), found: Some(found) };
    let part_menu = PartMenu { of: MenuOf::Reading(10), tool: Tool::Auto, at: [300.0, 200.0] };
    Snapshot { ways: Some(ways), part_menu: Some(part_menu), ..read(&[(Reading::Tree, 3)]) }
}

fn name(language: Language, reading: Reading, count: usize) -> String {
    let messages = Messages::new(language);
    let count = messages.fill(Msg::PartSelected, &[("count", &count)]);
    format!("{}, {count}", messages.name(Named::Reading, reading.name()))
}

fn rect(harness: &Harness<'_, Stage>, label: &str) -> egui::Rect {
    harness.get_all_by_label(label).next().unwrap().rect()
}

#[test]
fn one_tap_says_that_a_reading_is_not_so() {
    for language in Language::ALL {
        let mut harness = stage(read(&[(Reading::Tree, 5)]), language);
        press(&mut harness, Messages::new(language).get(Msg::ReadTogetherRefuse));
        assert_eq!(asked(&mut harness), [Action::RefuseReading(10)]);
        press(&mut harness, &name(language, Reading::Tree, 5));
        let actions = asked(&mut harness);
        assert!(matches!(actions[..], [Action::ShowWays { stroke: 10, .. }]), "{actions:?}");
    }
}

#[test]
fn readings_stand_below_each_other_on_the_canvas_and_are_large_enough() {
    for (language, hand) in Language::ALL.into_iter().zip([Handedness::Right, Handedness::Left]) {
        let all: Vec<(Reading, usize)> = Reading::ALL.into_iter().zip([1, 120, 7]).collect();
        let mut snapshot = read(&all);
        snapshot.handedness = hand;
        let harness = stage(snapshot, language);
        let canvas = harness.state().canvas;
        let rects: Vec<egui::Rect> =
            all.iter().map(|(reading, count)| rect(&harness, &name(language, *reading, *count))).collect();
        for place in &rects {
            assert!(canvas.contains_rect(*place) && place.height() >= TARGET && place.width() >= 100.0);
        }
        assert!(rects.windows(2).all(|pair| pair[0].bottom() <= pair[1].top()));
    }
}

#[test]
fn many_readings_scroll_and_leave_the_canvas_free() {
    let many: Vec<(Reading, usize)> = std::iter::repeat_n((Reading::Leaf, 3), 40).collect();
    let harness = stage(read(&many), Language::English);
    let (canvas, legend) = (harness.state().canvas, rect(&harness, "What Penstemon understood"));
    let seen = |rect: egui::Rect| rect.top() < canvas.top() + 190.0;
    let label = name(Language::English, Reading::Leaf, 3);
    let shown = harness.get_all_by_label(&label).filter(|node| seen(node.rect())).count();
    assert!((4..=5).contains(&shown), "{shown}");
    assert!(legend.top() > canvas.top() + 200.0);
}

#[test]
fn the_ways_to_read_are_pictures_and_a_tap_chooses() {
    for language in Language::ALL {
        let messages = Messages::new(language);
        let mut harness = stage(with_ways(), language);
        let fronds = messages.name(Named::Reading, "fronds");
        press(&mut harness, &fronds);
        let chosen = Correction::new([10, 11, 12], Verdict::As(Reading::Fronds));
        assert_eq!(asked(&mut harness), [Action::Correct(chosen)]);
        press(&mut harness, messages.get(Msg::ReadTogetherSeparate));
        assert_eq!(asked(&mut harness), [Action::Correct(Correction::new([10, 11, 12], Verdict::Separate))]);
        // What holds already is only confirmed.
        press(&mut harness, &messages.name(Named::Reading, "tree"));
        assert_eq!(asked(&mut harness), [Action::ClosePartMenu]);
        let node = harness.get_by_label(&fronds);
        assert!(node.rect().width() >= TARGET && node.accesskit_node().role() == egui::Role::Button);
    }
}
