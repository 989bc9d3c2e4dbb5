//! What the panels show about a drawing that is odd.

use crate::app::action::Action;
use crate::app::editor::{Editor, Places};
use crate::app::messages::Language;
use crate::app::panels::snapshot::{MenuOf, PartMenu};
use crate::sketch::{Change, Stroke, StrokePoint, Tool};
use glam::vec2;
use std::time::{Duration, Instant};

/// Longest wait for a plant; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(60);

/// Builds what is drawn.
fn build(editor: &mut Editor) {
    let (begun, before) = (Instant::now(), editor.versions().plant);
    while editor.versions().plant == before || editor.is_working() {
        assert!(begun.elapsed() < PATIENCE, "it is built for ever");
        editor.submit();
        editor.collect();
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn an_outline_without_a_branch_is_reported_until_there_is_one() {
    let home = tempfile::tempdir().unwrap();
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.prefs.speak(Language::Chinese);
    editor.perform(Action::New);
    let line = |id, tool, places: &[[f32; 2]]| {
        let points = places.iter().map(|&[x, y]| StrokePoint::at(vec2(x, y))).collect();
        Change::put(Stroke { id, tool, points, brush: None })
    };
    let ring = [[0.0, 0.0], [300.0, 0.0], [300.0, 300.0], [0.0, 300.0], [0.0, 0.0]];
    editor.change(line(1, Tool::BranchOutline, &ring));
    build(&mut editor);
    let remark = "没有枝条穿过此轮廓，轮廓内长不出小枝";
    assert_eq!(editor.panel_snapshot().status.shortfall, Some(format!("枝条轮廓：{remark}")));
    assert!(editor.panel_snapshot().remarks.is_empty(), "nobody asked");
    let menu = |stroke| PartMenu { of: MenuOf::Stroke(stroke), tool: Tool::Auto, at: [0.0; 2] };
    editor.dialogs.ask_for_part(menu(1));
    assert_eq!(editor.panel_snapshot().remarks, [remark]);
    editor.change(line(2, Tool::Branch, &[[150.0, 500.0], [150.0, 20.0]]));
    build(&mut editor);
    assert_eq!(editor.panel_snapshot().status.shortfall, None);
    assert!(editor.panel_snapshot().remarks.is_empty());
}

#[test]
fn a_plant_beside_that_cannot_stand_is_reported() {
    let home = tempfile::tempdir().unwrap();
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.prefs.speak(Language::English);
    editor.perform(Action::New);
    editor.perform(Action::AddPlant("mallow".to_owned()));
    build(&mut editor);
    let reported = editor.panel_snapshot().status.shortfall.unwrap();
    assert!(reported.starts_with("plant 1 (`Mallow`): no species of this name grows"), "{reported}");
}
