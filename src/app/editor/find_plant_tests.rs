//! Tests of plants found on the picture under the drawing.

use super::*;
use crate::app::canvas_tool::CanvasTool;
use crate::app::editor::Places;
use crate::pen::{PenButtons, PenSample};
use crate::photo::picture_of;
use crate::picture::decode::Rgba;
use crate::sketch::{Sketch, TextureChoice, json};
use std::path::Path;
use std::time::{Duration, Instant};

/// Longest wait for anything; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(120);
/// Size of the picture; two canvas pixels are one of it.
const SIZE: (u32, u32) = (200, 160);

/// Two trees before the sky: a large green one to the right, a smaller to the left.
fn photograph() -> Reference {
    let pixels = (0..SIZE.0 * SIZE.1).flat_map(|i| {
        let at = Vec2::new((i % SIZE.0) as f32 + 0.5, (i / SIZE.0) as f32 + 0.5);
        let grain = (i.wrapping_mul(2_654_435_761) >> 28) as u8;
        let tree = |x: f32, radius: f32| {
            let is_trunk = (at.x - x).abs() < 3.5 && (70.0..145.0).contains(&at.y);
            let is_crown = at.distance(Vec2::new(x, 70.0)) < radius;
            if is_crown {
                Some([30 + grain, 95 + grain, 35, 255])
            } else {
                is_trunk.then_some([80 + grain, 60, 45, 255])
            }
        };
        tree(135.0, 42.0).or(tree(45.0, 28.0)).unwrap_or([170, 200, 225 + grain, 255])
    });
    let picture = picture_of(&Rgba { width: SIZE.0, height: SIZE.1, pixels: pixels.collect() }).unwrap();
    Reference::new(picture, Vec2::new(300.0, 260.0), 400.0)
}

fn editor(home: &Path) -> Editor {
    let file = home.join("tree.penstemon");
    let drawing = Sketch { reference: Some(Arc::new(photograph())), ..Sketch::empty() };
    std::fs::write(&file, json::write(&drawing)).unwrap();
    let places = Places { config: home.join("config"), state: home.join("state") };
    Editor::open_in(places, Some(file), || ()).unwrap()
}

fn until(editor: &mut Editor, holds: impl Fn(&Editor) -> bool) {
    let begun = Instant::now();
    while !holds(editor) {
        assert!(begun.elapsed() < PATIENCE, "it never happens");
        std::thread::sleep(Duration::from_millis(1));
        editor.submit();
        editor.collect();
    }
}

fn is_found(editor: &Editor) -> bool {
    editor.search.found.is_some() && editor.search.work.is_none()
}

/// A line of the pen over the picture, in its pixels.
fn draw(editor: &mut Editor, line: &[(f32, f32)], tool: PenTool) {
    let reference = editor.sketch().reference.clone().unwrap();
    let last = line.len() - 1;
    for (k, place) in line.iter().chain([&line[last]]).enumerate() {
        let canvas = on_canvas(&reference, Vec2::from(*place));
        let phase = match k {
            0 => PenPhase::Down,
            k if k > last => PenPhase::Up,
            _ => PenPhase::Move,
        };
        let position = editor.canvas.view().to_window(canvas.as_dvec2());
        let buttons = PenButtons { primary: true, ..PenButtons::default() };
        let sample = PenSample {
            position,
            pressure: 0.5,
            tilt_deg: Vec2::ZERO,
            twist_deg: 0.0,
            distance: 0.0,
            tool,
            buttons,
            time_ms: 10.0 * k as f64,
        };
        editor.pen(PenEvent { phase, sample });
    }
}

#[test]
fn the_plant_is_found_marked_and_drawn_in_one_step() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    editor.perform(Action::UseAsCrown);
    assert!(editor.sketch().strokes.is_empty(), "nothing was found yet");
    editor.perform(Action::FindPlant(true));
    assert!(editor.search.state(None).is_searching);
    until(&mut editor, is_found);
    assert!(editor.dialogs.notices().iter().any(|notice| notice.what.contains('2')), "two plants");
    // A line on the other tree takes that; it is no stroke.
    draw(&mut editor, &[(35.0, 70.0), (45.0, 72.0), (55.0, 70.0)], PenTool::Pen);
    assert!(editor.sketch().strokes.is_empty() && editor.search.state(None).any_marks);
    until(&mut editor, is_found);
    let found = editor.search.found.clone().unwrap().1;
    assert!(found.contains(45, 60) && !found.contains(135, 60));
    // Undo takes the mark back, and another one brings the tree again.
    editor.perform(Action::Undo);
    assert!(!editor.search.state(None).any_marks && !editor.panel_snapshot().can_undo);
    until(&mut editor, is_found);
    assert!(editor.search.found.as_ref().unwrap().1.contains(135, 60));
    draw(&mut editor, &[(35.0, 70.0), (45.0, 72.0), (55.0, 70.0)], PenTool::Mouse);
    until(&mut editor, is_found);
    editor.perform(Action::UseAsCrown);
    assert!(!editor.search.is_on, "the search has ended");
    let tools: Vec<Tool> = editor.sketch().strokes.iter().map(|stroke| stroke.tool).collect();
    assert_eq!(tools, [Tool::Crown, Tool::Branch]);
    assert_eq!(editor.sketch().species.as_deref(), Some("oak"));
    assert!(editor.sketch().params.contains_key(TRUNK_RADIUS));
    let middle = on_canvas(&photograph(), Vec2::new(45.0, 70.0));
    for point in &editor.sketch().strokes[0].points {
        assert!((point.position.distance(middle) - 56.0).abs() < 8.0, "{}", point.position);
    }
    editor.perform(Action::Undo);
    assert!(editor.sketch().strokes.is_empty() && editor.sketch().species.is_none());
    assert!(editor.sketch().params.is_empty() && editor.sketch().reference.is_some());
}

#[test]
fn leaves_and_bark_take_the_colours_of_the_picture() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    editor.perform(Action::FindPlant(true));
    until(&mut editor, is_found);
    editor.perform(Action::UseAsCrown);
    until(&mut editor, |editor| editor.live.species().is_some_and(|species| species.name == "oak"));
    editor.perform(Action::ColoursFromPicture);
    until(&mut editor, |editor| !editor.sketch().textures.is_empty());
    let TextureChoice::Own(leaf) = &editor.sketch().textures["leaf"] else { panic!("a picture") };
    let pixels = leaf.pixels().unwrap().pixels;
    let green = pixels.as_chunks::<4>().0.iter().filter(|[r, g, b, _]| g > r && g > b).count();
    assert!(green * 10 > pixels.len() / 4 * 7, "{green} of {}", pixels.len() / 4);
    editor.perform(Action::Undo);
    assert!(editor.sketch().textures.is_empty() && !editor.sketch().strokes.is_empty());
}

#[test]
fn the_search_ends_with_its_picture_and_with_another_tool() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    editor.perform(Action::FindPlant(true));
    until(&mut editor, is_found);
    editor.perform(Action::SetTool(CanvasTool::Draw(Tool::Branch)));
    assert!(!editor.search.is_on);
    draw(&mut editor, &[(20.0, 150.0), (24.0, 120.0), (25.0, 90.0)], PenTool::Pen);
    assert_eq!(editor.sketch().strokes.len(), 1, "the pen draws again");
    editor.perform(Action::FindPlant(true));
    editor.perform(Action::MarkPlant(PlantMark::Outline));
    draw(&mut editor, &[(10.0, 10.0)], PenTool::Mouse);
    assert!(!editor.search.state(None).any_marks, "a tap is no outline");
    editor.perform(Action::RemoveReference);
    assert!(!editor.search.is_on && editor.search.found.is_none());
    until(&mut editor, |editor| editor.search.work.is_none());
    editor.perform(Action::FindPlant(true));
    assert!(!editor.search.is_on && editor.search.found.is_none(), "there is no picture");
}

#[test]
fn a_drawn_trunk_comes_to_the_middle_of_the_one_on_the_picture() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    editor.perform(Action::SetTool(CanvasTool::Draw(Tool::Branch)));
    let line: Vec<(f32, f32)> = (0..=10).map(|k| (132.0, 143.0 - 2.5 * k as f32)).collect();
    draw(&mut editor, &line, PenTool::Pen);
    let id = editor.sketch().strokes[0].id;
    assert_eq!(editor.branch_over_picture(), None, "it is not selected");
    editor.perform(Action::SelectStroke { stroke: id, besides: false });
    assert_eq!(editor.branch_over_picture(), Some(id));
    editor.perform(Action::SnapToTrunk(id));
    until(&mut editor, |editor| editor.search.snapping.is_none());
    let middle = on_canvas(&photograph(), Vec2::new(135.0, 0.0)).x;
    let stroke = &editor.sketch().strokes[0];
    assert!(stroke.id == id && stroke.tool == Tool::Branch);
    for point in &stroke.points {
        assert!((point.position.x - middle).abs() < 3.0, "{} and not {middle}", point.position);
    }
    assert!(editor.sketch().params.contains_key(TRUNK_RADIUS));
    editor.perform(Action::Undo);
    assert!((editor.sketch().strokes[0].points[3].position.x - middle).abs() > 4.0);
    // In the sky there is no trunk.
    editor.perform(Action::SetTool(CanvasTool::Draw(Tool::Branch)));
    draw(&mut editor, &[(85.0, 40.0), (86.0, 30.0), (86.0, 20.0), (87.0, 10.0)], PenTool::Pen);
    let other = editor.sketch().strokes[1].id;
    editor.perform(Action::SnapToTrunk(other));
    until(&mut editor, |editor| {
        editor.dialogs.notices().iter().any(|notice| notice.what.contains("two sides"))
    });
}

#[test]
fn what_was_found_is_seen_over_the_picture() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    let egui = egui::Context::default();
    let lines = |editor: &mut Editor| -> Vec<Vec<Pos2>> {
        let screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 800.0)));
        let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
        let output = egui.run_ui(input, |ui| editor.ui(ui, egui::TextureId::default()));
        let long = output.shapes.into_iter().filter_map(|clipped| match clipped.shape {
            Shape::Path(path) if path.points.len() > 12 => Some(path.points),
            _ => None,
        });
        long.collect()
    };
    editor.perform(Action::FindPlant(true));
    let reference = photograph();
    let scale = editor.layout.pixels_per_point() as f32;
    let is_crown = |editor: &Editor, line: &Vec<Pos2>| {
        let view = editor.canvas.view();
        let place = on_canvas(&reference, Vec2::new(135.0, 70.0)).as_dvec2();
        let middle = view.to_window(place).as_vec2() / scale;
        let radius = 42.0 * 2.0 * view.zoom() as f32 / scale;
        line.iter().all(|p| (Vec2::new(p.x, p.y).distance(middle) / radius - 1.0).abs() < 0.1)
    };
    let crowns = |editor: &mut Editor| {
        let lines = lines(editor);
        lines.iter().filter(|line| is_crown(editor, line)).count()
    };
    assert_eq!(crowns(&mut editor), 0, "nothing has been found");
    until(&mut editor, is_found);
    assert_eq!(crowns(&mut editor), 2, "a light line in a dark one");
    editor.perform(Action::FindPlant(false));
    assert_eq!(crowns(&mut editor), 0);
}

#[test]
fn where_nothing_is_drawn_all_of_the_picture_is_shown() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    let viewport = crate::app::canvas::Rect::new(DVec2::ZERO, DVec2::splat(300.0));
    editor.canvas.set_viewport(viewport, 1.0);
    editor.perform(Action::FitCanvas);
    let (low, high) = editor.sketch().reference.as_ref().unwrap().bounds();
    assert_eq!((low, high), (Vec2::new(100.0, 100.0), Vec2::new(500.0, 420.0)));
    let seen = [low, high].map(|corner| editor.canvas.view().to_window(corner.as_dvec2()));
    assert!(seen.iter().all(|p| p.min_element() >= 0.0 && p.max_element() <= 300.0), "{seen:?}");
    assert!(seen[1].x - seen[0].x > 200.0, "{seen:?}");
}
