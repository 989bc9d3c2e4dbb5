//! The bar, the strip of tools and what floats over the canvas: one tap each.

use super::stage::{self, asked, busy, english, press, stage, stage_of};
use egui_kittest::kittest::Queryable;
use penstemon::app::action::Action;
use penstemon::app::canvas_tool::Mirror;
use penstemon::app::messages::{Language, Messages, Msg};
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::snapshot::{Dialog, MenuOf, PartMenu};
use penstemon::app::panels::toolbar::TOOLS;
use penstemon::app::settings::{Handedness, ThemeChoice};
use penstemon::app::stabiliser::Stabiliser;
use penstemon::sketch::Tool;

#[test]
fn every_tool_is_one_tap() {
    let mut harness = stage(busy(), Language::English);
    for tool in TOOLS {
        let name = english().get(tool.name).to_owned();
        press(&mut harness, &name);
        assert_eq!(asked(&mut harness), [Action::SetTool(tool.tool)], "{name}");
    }
}

#[test]
fn tools_have_keys_of_their_own() {
    let mut keys: Vec<_> = TOOLS.iter().map(|tool| tool.key).collect();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), TOOLS.len());
}

#[test]
fn the_bar_asks_for_what_its_buttons_say() {
    let mut harness = stage(busy(), Language::English);
    for (label, action) in [
        ("New", Action::New),
        ("Open", Action::Open),
        ("Save", Action::Save),
        ("Undo", Action::Undo),
        ("Show all", Action::FitCanvas),
        ("Front view", Action::FrontView),
        ("Reference picture", Action::OpenReference),
        ("Export", Action::ShowExport),
        ("Help", Action::ShowDialog(Dialog::About)),
        ("Hide the side panel", Action::ShowSide(false)),
    ] {
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
    // nothing to redo
    press(&mut harness, "Redo");
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn the_menu_opens_recent_drawings() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Menu");
    press(&mut harness, "rose");
    assert_eq!(asked(&mut harness), [Action::OpenPath("/home/ada/rose.penstemon".into())]);
    press(&mut harness, "Menu");
    press(&mut harness, "Save as");
    assert_eq!(asked(&mut harness), [Action::SaveAs]);
}

#[test]
fn settings_are_a_tap_each() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Settings");
    for (label, action) in [
        ("Dark", Action::SetTheme(ThemeChoice::Dark)),
        ("Left", Action::SetHandedness(Handedness::Left)),
        ("Strong", Action::SetStabiliser(Stabiliser::Strong)),
        ("Stabiliser: Light", Action::SetStabiliser(Stabiliser::Strong)),
    ] {
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
    press(&mut harness, "Settings");
    let chinese = if stage::chinese_font().is_some() { "简体中文" } else { "Chinese (Zhongwen)" };
    press(&mut harness, chinese);
    assert_eq!(asked(&mut harness), [Action::SetLanguage(Language::Chinese)]);
}

#[test]
fn another_language_changes_every_label_at_once() {
    let mut harness = stage(busy(), Language::English);
    assert!(harness.query_all_by_label("Petal").next().is_some());
    harness.state_mut().messages = Messages::new(Language::Chinese);
    harness.run();
    for english in ["Petal", "Undo", "Export", "Daisy", "Plant", "Roll the dice"] {
        assert!(harness.query_all_by_label(english).next().is_none(), "{english} is still there");
    }
    for chinese in ["花瓣", "撤销", "导出", "雏菊", "植物", "掷骰子"] {
        assert!(harness.query_all_by_label(chinese).next().is_some(), "{chinese} is missing");
    }
}

#[test]
fn a_wrong_guess_is_corrected_by_one_tap() {
    let mut snapshot = busy();
    snapshot.part_menu = Some(PartMenu { of: MenuOf::Stroke(9), tool: Tool::Auto, at: [1270.0, 790.0] });
    let mut harness = stage(snapshot, Language::English);
    let leaf = harness.query_all_by_label("Leaf").find(|node| node.rect().left() > 200.0).unwrap();
    assert!(harness.state().canvas.contains_rect(leaf.rect()), "the menu stays inside the canvas");
    leaf.click();
    harness.run();
    let actions = asked(&mut harness);
    assert!(actions.contains(&Action::SetStrokePart { stroke: 9, tool: Tool::Leaf }), "{actions:?}");
    assert!(actions.contains(&Action::ClosePartMenu));
}

#[test]
fn what_is_odd_about_a_stroke_is_reported_where_it_is_asked_about() {
    let mut snapshot = busy();
    snapshot.part_menu = Some(PartMenu { of: MenuOf::Stroke(9), tool: Tool::Auto, at: [300.0, 300.0] });
    snapshot.remarks = vec!["太短，看不出含义，已跳过".to_owned()];
    let harness = stage(snapshot, Language::Chinese);
    let shown = harness.get_by_label("太短，看不出含义，已跳过").rect();
    assert!(harness.state().canvas.contains_rect(shown), "{shown:?}");
}

#[test]
fn the_status_line_tells_what_the_plant_lacks_and_stays_readable() {
    let long = "Branch outline: no branch runs through this outline, so no twig could grow in it".repeat(3);
    for (width, lacking) in [(640.0, long.as_str()), (1280.0, "Leaf: encloses nothing")] {
        let mut snapshot = busy();
        snapshot.status.shortfall = Some(lacking.to_owned());
        let size = egui::vec2(width, 700.0);
        let harness = stage_of(snapshot, Language::English, size, 1.0, None);
        let [shown, safe, time] = [lacking, "Unsaved, kept safe", "built in 6.4 ms"].map(|label| {
            let shown = harness.query_by_label(label);
            shown.unwrap_or_else(|| panic!("{label} is not shown in {width}")).rect()
        });
        assert!(safe.right() <= width && shown.right() <= safe.left(), "{shown:?} {safe:?}");
        assert!(shown.left() >= time.right() || width < 700.0, "{shown:?} {time:?}");
    }
}

#[test]
fn selected_strokes_offer_what_can_be_done() {
    let mut snapshot = busy();
    snapshot.selected = 3;
    let mut harness = stage(snapshot, Language::English);
    for (label, action) in [
        ("Duplicate", Action::DuplicateSelected),
        ("Delete", Action::DeleteSelected),
        ("Copy", Action::CopySelected),
        ("Cut", Action::CutSelected),
        ("Paste", Action::Paste),
        ("Mirror left and right", Action::MirrorSelected(Mirror::LeftRight)),
        ("Mirror top and bottom", Action::MirrorSelected(Mirror::TopBottom)),
    ] {
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action]);
    }
}

#[test]
fn a_stroke_over_a_picture_offers_it_as_its_texture() {
    for language in Language::ALL {
        let messages = Messages::new(language);
        let label = messages.get(Msg::PartPictureUnder);
        let over = |stroke| {
            let mut snapshot = busy();
            (snapshot.selected, snapshot.over_picture) = (1, stroke);
            snapshot
        };
        assert!(stage(over(None), language).query_by_label(label).is_none());
        let mut harness = stage(over(Some(9)), language);
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [Action::TakePictureUnder(9)]);
        let menu = PartMenu { of: MenuOf::Stroke(9), tool: Tool::Leaf, at: [300.0, 200.0] };
        let mut harness = stage(Snapshot { part_menu: Some(menu), ..over(Some(9)) }, language);
        press(&mut harness, label);
        assert!(asked(&mut harness).contains(&Action::TakePictureUnder(9)));
    }
}
