//! Dialogs and messages.

use super::stage::{ROLES, Stage, asked, busy, drag, press, stage};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::snapshot::{
    Dialog, ExportChoice, ExportFormat, Notice, PathPurpose, PathRequest, Recovered, Task,
};
use penstemon::app::pen_settings::{Covers, TabletDoubt};
use penstemon::app::pen_uses::ButtonUse;
use penstemon::app::tablet_keys::KeyUse;
use penstemon::pen::calibration::CROSSES;
use penstemon::pen::mapping::Turn;
use penstemon::pen::{PenSource, PressureCurve};
use penstemon::pipeline::LevelSet;

fn with_dialog(dialog: Dialog) -> Harness<'static, Stage> {
    let mut snapshot = busy();
    snapshot.dialog = Some(dialog);
    stage(snapshot, Language::English)
}

/// Presses the last thing of this name: dialogs stand above everything else.
fn press_last(harness: &mut Harness<'_, Stage>, label: &str) {
    let touched = |node: &egui_kittest::Node<'_>| ROLES.contains(&node.accesskit_node().role());
    harness.query_all_by_label(label).rfind(touched).unwrap().click();
    harness.run();
}

#[test]
fn unsaved_changes_have_three_answers() {
    for (label, action) in [
        ("Save", Action::SaveAndContinue),
        ("Don't save", Action::DiscardAndContinue),
        ("Cancel", Action::CloseDialog),
    ] {
        let mut harness = with_dialog(Dialog::Unsaved);
        press_last(&mut harness, label);
        assert_eq!(asked(&mut harness), [action]);
    }
    // a tap beside the dialog is no answer, and nothing below it is reached
    let mut harness = with_dialog(Dialog::Unsaved);
    press(&mut harness, "Petal");
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn found_drawings_are_discarded_only_after_asking() {
    let one = Recovered {
        path: "/state/1.journal".into(),
        name: "Rose".into(),
        strokes: 12,
        when: "yesterday, 18:03".into(),
        thumbnail: None,
    };
    let mut harness = with_dialog(Dialog::Recovery(vec![one]));
    press(&mut harness, "Discard Rose");
    assert_eq!(asked(&mut harness), []);
    press(&mut harness, "Really discard?");
    assert_eq!(asked(&mut harness), [Action::DiscardRecovery("/state/1.journal".into())]);
}

#[test]
fn the_pen_is_set_up_without_a_keyboard() {
    let pen = |harness: &mut Harness<'_, Stage>| match &asked(harness)[..] {
        [.., Action::SetPen(pen)] => *pen,
        other => panic!("a wish about the pen expected: {other:?}"),
    };
    let mut harness = with_dialog(Dialog::Pen);
    press_last(&mut harness, "Directly");
    assert_eq!(asked(&mut harness), [Action::SetPenSource(PenSource::Raw)]);
    press_last(&mut harness, "Soft");
    assert_eq!(pen(&mut harness).pressure, PressureCurve::soft());
    drag(&mut harness, "Hardest press", egui::vec2(-40.0, 40.0));
    let curve = pen(&mut harness).pressure;
    assert!(curve.end[0] < 0.95 && curve.end[1] < 0.95, "{curve:?}");
    press_last(&mut harness, "Done");
    assert_eq!(asked(&mut harness), [Action::CloseDialog]);
}

#[test]
fn the_model_of_a_tablet_in_doubt_is_chosen() {
    let models = ["Huion H640P", "Huion H950P"].map(str::to_owned).to_vec();
    let (device, name) = ("256c:006d HUION Tablet".to_owned(), "HUION Tablet".to_owned());
    let refused = TabletDoubt { device, name, models, taken: None, is_chosen: false };
    let guessed = TabletDoubt { taken: Some("Huion H640P".into()), ..refused.clone() };
    let chosen = TabletDoubt { is_chosen: true, ..guessed.clone() };
    for (doubt, about, shown) in [
        (refused, "HUION Tablet is not read", "Choose…"),
        (guessed, "HUION Tablet may be one of several", "Huion H640P"),
        (chosen, "HUION Tablet is read as the model that you chose", "Huion H640P"),
    ] {
        let mut snapshot = busy();
        snapshot.dialog = Some(Dialog::Pen);
        snapshot.pen.trouble = Some("HUION Tablet: no permission; install the rule file".into());
        snapshot.pen.doubts = vec![doubt];
        let mut harness = stage(snapshot, Language::English);
        assert!(harness.query_by_label_contains(about).is_some(), "{about}");
        assert!(harness.query_by_label_contains("install the rule file").is_some());
        harness.get_by_label(&format!("Model of the tablet: {shown}")).click();
        harness.run();
        harness.get_by_label("Huion H950P").click();
        harness.run();
        let action =
            Action::SetTabletModel { device: "256c:006d HUION Tablet".into(), model: "Huion H950P".into() };
        assert_eq!(asked(&mut harness), [action]);
    }
    assert!(with_dialog(Dialog::Pen).query_by_label_contains("Model of the tablet").is_none());
}

#[test]
fn the_third_button_of_a_pen_is_assigned() {
    let mut harness = with_dialog(Dialog::Pen);
    harness.get_by_label_contains("Third button: ").scroll_to_me();
    harness.run();
    harness.get_by_label_contains("Third button: ").click();
    harness.run();
    harness.get_by_label("Turn the plant").click();
    harness.run();
    assert!(matches!(&asked(&mut harness)[..], [Action::SetPen(pen)] if pen.uses.third == ButtonUse::Orbit));
}

#[test]
fn the_area_is_asked_for_only_where_the_program_decides() {
    let raw = |is_raw| {
        let mut snapshot = busy();
        snapshot.dialog = Some(Dialog::Pen);
        snapshot.pen.is_raw = is_raw;
        let mut harness = stage(snapshot, Language::English);
        harness.get_by_label("Monitor").scroll_to_me();
        harness.run();
        press_last(&mut harness, "Monitor");
        asked(&mut harness)
    };
    assert_eq!(raw(false), []);
    assert!(matches!(&raw(true)[..], [Action::SetPen(pen)] if pen.covers == Covers::Monitor));
}

/// The dialog of a tablet that is read directly and covers one of two monitors.
fn of_tablet() -> Harness<'static, Stage> {
    let mut snapshot = busy();
    snapshot.dialog = Some(Dialog::Pen);
    snapshot.pen.is_raw = true;
    snapshot.pen.monitors = 2;
    snapshot.pen.settings.covers = Covers::Monitor;
    stage(snapshot, Language::English)
}

#[test]
fn a_key_of_a_tablet_is_given_another_use() {
    let mut harness = of_tablet();
    harness.get_by_label("Key 8: Show all").scroll_to_me();
    harness.run();
    harness.get_by_label("Key 8: Show all").click();
    harness.run();
    harness.get_by_label("Zoom in").click();
    harness.run();
    assert!(
        matches!(&asked(&mut harness)[..], [Action::SetPen(pen)] if pen.keys.keys[7] == KeyUse::ZoomIn),
        "the eighth key zooms"
    );
    assert!(with_dialog(Dialog::Pen).query_by_label_contains("Key 8").is_none(), "the system's pen has none");
}

#[test]
fn a_tablet_is_turned_by_quarters_and_put_on_another_monitor() {
    let mut harness = of_tablet();
    harness.get_by_label("90°").scroll_to_me();
    harness.run();
    press_last(&mut harness, "90°");
    assert!(matches!(&asked(&mut harness)[..], [Action::SetPen(pen)] if pen.turn == Turn::Right));
    press_last(&mut harness, "2");
    assert!(matches!(&asked(&mut harness)[..], [Action::SetPen(pen)] if pen.monitor == Some(1)));
}

/// Touches the four crosses, or places beside them; the wishes that follow are given.
fn touch_crosses(harness: &mut Harness<'_, Stage>, place: impl Fn(egui::Pos2) -> egui::Pos2) -> Vec<Action> {
    harness.get_by_label("Touch four crosses").scroll_to_me();
    harness.run();
    press_last(harness, "Touch four crosses");
    for cross in CROSSES {
        assert!(harness.query_by_label_contains("Touch the middle of the cross").is_some());
        let at = place(egui::pos2(1280.0 * cross.x as f32, 800.0 * cross.y as f32));
        harness.hover_at(at);
        harness.step();
        harness.drag_at(at);
        harness.step();
        harness.drop_at(at);
        harness.run();
    }
    asked(harness)
}

#[test]
fn four_crosses_put_a_pen_display_right() {
    let mut snapshot = busy();
    snapshot.dialog = Some(Dialog::Pen);
    snapshot.pen.is_raw = true;
    snapshot.pen.target = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 800.0)));
    let mut harness = stage(snapshot, Language::English);
    let actions = touch_crosses(&mut harness, |cross| cross + egui::vec2(12.8, -8.0));
    let [.., Action::SetPen(pen)] = &actions[..] else { panic!("{actions:?}") };
    let put_right = pen.calibration.apply(glam::DVec2::new(0.51, 0.49));
    assert!(put_right.distance(glam::DVec2::splat(0.5)) < 1e-3, "{put_right}");
    assert!(harness.query_by_label_contains("Touch the middle of the cross").is_none(), "that was all");
    let mut far = of_tablet();
    assert!(far.query_by_label_contains("Touch four crosses").is_none(), "its monitor is not in the window");
    far.state_mut().snapshot.pen.target = harness.state().snapshot.pen.target;
    far.run();
    let actions = touch_crosses(&mut far, |_| egui::pos2(600.0, 400.0));
    assert_eq!(actions, [], "all at one place");
    assert!(far.query_by_label_contains("Touch the middle of the cross").is_some(), "once more");
}

#[test]
fn the_export_dialog_keeps_what_is_chosen_and_refuses_nothing_at_all() {
    let mut harness = with_dialog(Dialog::Export);
    press_last(&mut harness, "Leaves");
    let without = ExportChoice { leaves: false, ..ExportChoice::default() };
    assert_eq!(asked(&mut harness), [Action::SetExport(without.clone())]);
    harness.state_mut().snapshot.export = without.clone();
    harness.run();
    press(&mut harness, "Export…");
    assert_eq!(asked(&mut harness), [Action::Export(without)]);
    press(&mut harness, "PNG");
    assert_eq!(
        asked(&mut harness),
        [Action::SetExport(ExportChoice {
            format: ExportFormat::Png,
            leaves: false,
            ..ExportChoice::default()
        })]
    );
    harness.state_mut().snapshot.export = ExportChoice {
        branches: false,
        leaves: false,
        flowers: false,
        extras: false,
        ..ExportChoice::default()
    };
    harness.run();
    press(&mut harness, "Export…");
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn levels_of_detail_are_chosen_for_a_glb_and_say_their_triangles() {
    let mut harness = with_dialog(Dialog::Export);
    press(&mut harness, "Game");
    let with = ExportChoice { levels: Some(LevelSet::Game), ..ExportChoice::default() };
    assert_eq!(asked(&mut harness), [Action::SetExport(with.clone())]);
    harness.state_mut().snapshot.export = with.clone();
    // The dialog becomes higher, and then comes to the middle again.
    (0..3).for_each(|_| harness.step());
    harness.run();
    assert!(harness.query_by_label_contains("80\u{202f}000 · 25\u{202f}000").is_some());
    press(&mut harness, "Capsules for collisions");
    assert_eq!(asked(&mut harness), [Action::SetExport(ExportChoice { capsules: true, ..with.clone() })]);
    harness.state_mut().snapshot.export = ExportChoice { format: ExportFormat::Obj, ..with };
    harness.run();
    assert!(harness.query_by_label_contains("Levels of detail").is_none(), "OBJ has no word for levels");
}

#[test]
fn a_long_export_shows_progress_and_can_be_stopped() {
    let mut snapshot = busy();
    snapshot.dialog = Some(Dialog::Export);
    snapshot.task = Some(Task { name: "rose.glb".into(), progress: 0.4 });
    let mut harness = stage(snapshot, Language::English);
    assert!(harness.query_by_label("Writing rose.glb: 40 %").is_some());
    press(&mut harness, "Stop");
    assert_eq!(asked(&mut harness), [Action::CancelTask]);
}

#[test]
fn a_file_is_chosen_and_one_replaced_only_after_a_second_press() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("daisy.penstemon"), "").unwrap();
    let request = |purpose, name: &str| PathRequest {
        purpose,
        folder: folder.path().to_owned(),
        name: name.to_owned(),
        extensions: vec!["penstemon"],
    };
    let path = folder.path().join("daisy.penstemon");
    let mut harness = with_dialog(Dialog::Path(request(PathPurpose::OpenDrawing, "")));
    press(&mut harness, "daisy.penstemon");
    press_last(&mut harness, "Open");
    assert_eq!(
        asked(&mut harness),
        [Action::PathChosen { purpose: PathPurpose::OpenDrawing, path: path.clone() }]
    );

    let mut harness = with_dialog(Dialog::Path(request(PathPurpose::SaveDrawing, "daisy")));
    press_last(&mut harness, "Save");
    assert_eq!(asked(&mut harness), []);
    press(&mut harness, "Replace the existing file");
    assert_eq!(asked(&mut harness), [Action::PathChosen { purpose: PathPurpose::SaveDrawing, path }]);
}

fn saving_into(folder: &std::path::Path, name: &str) -> Harness<'static, Stage> {
    with_dialog(Dialog::Path(PathRequest {
        purpose: PathPurpose::SaveDrawing,
        folder: folder.to_owned(),
        name: name.to_owned(),
        extensions: vec!["penstemon"],
    }))
}

/// Types into the text field that has the focus, in place of what is there.
fn type_over(harness: &mut Harness<'_, Stage>, text: &str) {
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run();
}

#[test]
fn a_name_that_cannot_be_used_is_answered() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = saving_into(folder.path(), "winter/daisy");
    press_last(&mut harness, "Save");
    assert_eq!(asked(&mut harness), []);
    assert!(harness.query_by_label_contains("There is no folder").is_some());
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.key_press(egui::Key::Backspace);
    harness.run();
    press_last(&mut harness, "Save");
    assert!(harness.query_by_label_contains("Type or choose a name").is_some());
    // A path in the name is as good as the list.
    std::fs::create_dir(folder.path().join("winter")).unwrap();
    let mut harness = saving_into(folder.path(), "winter/daisy");
    press_last(&mut harness, "Save");
    let path = folder.path().join("winter/daisy.penstemon");
    assert_eq!(asked(&mut harness), [Action::PathChosen { purpose: PathPurpose::SaveDrawing, path }]);
}

#[test]
fn a_folder_is_made_and_entered() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = saving_into(folder.path(), "daisy");
    press(&mut harness, "New folder");
    harness.event(egui::Event::Text("summer".to_owned()));
    harness.run();
    press(&mut harness, "Create");
    assert!(folder.path().join("summer").is_dir());
    press_last(&mut harness, "Save");
    let path = folder.path().join("summer/daisy.penstemon");
    assert_eq!(asked(&mut harness), [Action::PathChosen { purpose: PathPurpose::SaveDrawing, path }]);
}

#[test]
fn a_path_is_typed_and_completed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("summer")).unwrap();
    std::fs::write(folder.path().join("summer/rose.penstemon"), "").unwrap();
    let mut harness = with_dialog(Dialog::Path(PathRequest {
        purpose: PathPurpose::OpenDrawing,
        folder: folder.path().to_owned(),
        name: String::new(),
        extensions: vec!["penstemon"],
    }));
    let address = |node: &egui_kittest::Node<'_>| {
        node.accesskit_node().value().is_some_and(|value| value.starts_with('/'))
    };
    harness.query_all_by_role(egui::Role::TextInput).find(address).unwrap().click();
    harness.run();
    type_over(&mut harness, &format!("{}/su", folder.path().display()));
    harness.key_press(egui::Key::Tab);
    harness.run();
    harness.event(egui::Event::Text("rose.penstemon".to_owned()));
    harness.run();
    harness.key_press(egui::Key::Enter);
    harness.run();
    let path = folder.path().join("summer/rose.penstemon");
    assert_eq!(asked(&mut harness), [Action::PathChosen { purpose: PathPurpose::OpenDrawing, path }]);
}

#[test]
fn a_file_nobody_was_asked_about_is_replaced_only_after_asking() {
    let dialog = || Dialog::Replace { purpose: PathPurpose::SaveDrawing, path: "/a/rose.penstemon".into() };
    for (label, action) in [
        (
            "Replace the existing file",
            Action::PathChosen { purpose: PathPurpose::SaveDrawing, path: "/a/rose.penstemon".into() },
        ),
        ("Choose another name", Action::ChooseFile(PathPurpose::SaveDrawing)),
        ("Cancel", Action::CloseDialog),
    ] {
        let mut harness = with_dialog(dialog());
        assert!(harness.query_by_label_contains("“rose.penstemon” is already in /a").is_some());
        press_last(&mut harness, label);
        assert_eq!(asked(&mut harness), [action]);
    }
}

#[test]
fn notices_say_what_to_do_and_go_away_by_a_tap() {
    let mut snapshot = busy();
    let what = "The disk is full; the drawing stays in memory.";
    snapshot.notices = vec![Notice { id: 5, ..Notice::error(what, "free some space, or save elsewhere") }];
    let mut harness = stage(snapshot, Language::English);
    assert!(harness.query_by_label(what).is_some());
    assert!(harness.query_by_label_contains("save elsewhere").is_some());
    press(&mut harness, "Dismiss");
    assert_eq!(asked_but_hold(&mut harness), [Action::DismissNotice(5)]);
}

/// What was asked for, but that a message under the pointer stays.
fn asked_but_hold(harness: &mut Harness<'_, Stage>) -> Vec<Action> {
    asked(harness).into_iter().filter(|action| !matches!(action, Action::HoldNotice(_))).collect()
}

#[test]
fn long_notices_are_whole_and_of_many_the_newest_are_shown() {
    let mut snapshot = busy();
    let path = format!("/home/ada/{}/rose.penstemon", "a-very-long-folder-name-without-any-space".repeat(4));
    let notice = |id: u64| Notice { id, ..Notice::error(format!("{id}: {path} cannot be read"), "") };
    snapshot.notices = (1..=5).map(notice).collect();
    snapshot.notices[4].find = Some(PathPurpose::Reference);
    let mut harness = stage(snapshot, Language::English);
    for id in 1..=5 {
        let text = format!("{id}: {path} cannot be read");
        let label = harness.query_by_label(&text);
        assert_eq!(label.is_some(), id > 2, "message {id}");
        if let Some(label) = label {
            let rect = label.rect();
            assert!(rect.width() < 400.0 && rect.height() > 2.0 * 14.0, "it is not wrapped: {rect:?}");
        }
    }
    assert!(harness.query_by_label("2 more messages").is_some());
    press(&mut harness, "Find…");
    let find = [Action::DismissNotice(5), Action::ChooseFile(PathPurpose::Reference)];
    assert_eq!(asked_but_hold(&mut harness), find);
}
