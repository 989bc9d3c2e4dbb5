//! Tests of textures from photographs: under a traced stroke, and of a file.

use super::*;
use crate::app::editor::Places;
use crate::sketch::{Change, Sketch, Stroke, StrokePoint, Tool, json};
use std::path::Path;
use std::time::{Duration, Instant};

/// Longest wait for anything; only a test that has failed takes so long.
const PATIENCE: Duration = Duration::from_secs(120);
/// The names of the stem and the leaf.
const STEM: StrokeId = 1;
const LEAF: StrokeId = 2;

/// A green leaf on white paper: upright, 60 pixels wide and 140 high; darker to its right.
fn photograph() -> Picture {
    let pixels = (0..200 * 100).flat_map(|i| {
        let at = Vec2::new((i % 100) as f32 + 0.5, (i / 100) as f32 + 0.5);
        let off = (at - Vec2::new(50.0, 100.0)) / Vec2::new(30.0, 70.0);
        let green = (200.0 - 1.2 * at.x) as u8;
        if off.length() < 1.0 { [40, green, 40, 255] } else { [240, 240, 240, 255] }
    });
    let picture = Rgba { width: 100, height: 200, pixels: pixels.collect() };
    picture_of(&picture).unwrap()
}

/// A drawing of a stem and a leaf that is traced over the photograph, which lies turned about its middle.
fn drawing(rotation_deg: f32) -> Sketch {
    let middle = Vec2::new(400.0, 300.0);
    let reference = Reference { rotation_deg, ..Reference::new(photograph(), middle, 200.0) };
    let turn = Vec2::from_angle(rotation_deg.to_radians());
    // Two canvas pixels are one of the picture's.
    let on_canvas = |p: Vec2| middle + turn.rotate((p - Vec2::new(50.0, 100.0)) * 2.0);
    let leaf = (0..=60).map(|k| {
        let angle = std::f32::consts::TAU * k as f32 / 60.0;
        on_canvas(Vec2::new(50.0, 100.0) + Vec2::new(30.0 * angle.sin(), 70.0 * angle.cos()))
    });
    let stem = (0..=20).map(|k| on_canvas(Vec2::new(50.0, 170.0 + 9.0 * (20 - k) as f32)));
    let stroke = |id, tool, points: Vec<Vec2>| {
        Arc::new(Stroke { id, tool, points: points.into_iter().map(StrokePoint::at).collect(), brush: None })
    };
    let strokes = vec![stroke(STEM, Tool::Branch, stem.collect()), stroke(LEAF, Tool::Leaf, leaf.collect())];
    Sketch { reference: Some(Arc::new(reference)), strokes, ..Sketch::empty() }
}

/// An editor with this drawing, once its plant is built.
fn editor(home: &Path, sketch: &Sketch) -> Editor {
    let file = home.join("leaf.penstemon");
    std::fs::write(&file, json::write(sketch)).unwrap();
    let places = Places { config: home.join("config"), state: home.join("state") };
    let mut editor = Editor::open_in(places, Some(file), || ()).unwrap();
    until(&mut editor, |editor| editor.built().is_some_and(|built| !built.anatomy.leaves.is_empty()));
    editor
}

fn until(editor: &mut Editor, holds: impl Fn(&Editor) -> bool) {
    let begun = Instant::now();
    while !holds(editor) {
        assert!(begun.elapsed() < PATIENCE, "it never happens");
        std::thread::sleep(Duration::from_millis(1));
        // What a frame of the window does.
        editor.submit();
        editor.collect();
    }
}

fn leaf_texture(editor: &Editor) -> Option<Rgba> {
    match editor.sketch().textures.get("leaf")? {
        TextureChoice::Own(picture) => picture.pixels().ok(),
        TextureChoice::Named(_) => None,
    }
}

/// Green at a place of a texture.
fn green(texture: &Rgba, u: f32, v: f32) -> u8 {
    let x = (u * texture.width as f32) as u32;
    let y = ((1.0 - v) * texture.height as f32) as u32;
    texture.pixels[(4 * (y * texture.width + x) + 1) as usize]
}

#[test]
fn one_click_gives_a_leaf_the_picture_under_it_however_it_lies() {
    for rotation_deg in [0.0, 35.0, -160.0] {
        let home = tempfile::tempdir().unwrap();
        let mut editor = editor(home.path(), &drawing(rotation_deg));
        assert_eq!(editor.over_picture(), None, "nothing is selected");
        editor.perform(Action::SelectStroke { stroke: LEAF, besides: false });
        assert_eq!(editor.over_picture(), Some(LEAF));
        editor.perform(Action::TakePictureUnder(LEAF));
        until(&mut editor, |editor| leaf_texture(editor).is_some());
        let texture = leaf_texture(&editor).unwrap();
        let (left, right) = (green(&texture, 0.15, 0.5), green(&texture, 0.85, 0.5));
        assert!(left > right + 20, "{rotation_deg}: {left} {right}");
        for pixel in texture.pixels.as_chunks::<4>().0 {
            assert!(pixel[0] < 120, "{rotation_deg}: paper in the texture, {pixel:?}");
        }
        editor.perform(Action::Undo);
        assert_eq!(leaf_texture(&editor), None);
        editor.perform(Action::Redo);
        assert!(json::write(editor.sketch()).contains("\"leaf\":{\"picture\""));
    }
}

#[test]
fn without_a_picture_or_a_blade_there_is_nothing_to_click() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path(), &drawing(0.0));
    editor.perform(Action::SelectStroke { stroke: STEM, besides: false });
    assert_eq!(editor.over_picture(), None, "a stem has no outline");
    editor.perform(Action::SelectStroke { stroke: LEAF, besides: true });
    assert_eq!(editor.over_picture(), None, "of two none is meant");
    editor.perform(Action::SelectStroke { stroke: LEAF, besides: false });
    editor.perform(Action::RemoveReference);
    assert_eq!(editor.over_picture(), None);
    editor.perform(Action::TakePictureUnder(LEAF));
    editor.perform(Action::TakePictureUnder(77));
    assert_eq!(editor.dialogs.notices().iter().count(), 0);
}

#[test]
fn a_stroke_beside_the_picture_is_reported() {
    let home = tempfile::tempdir().unwrap();
    let mut sketch = drawing(0.0);
    let moved = Reference {
        center: Vec2::new(4000.0, 300.0),
        ..Reference::clone(sketch.reference.as_ref().unwrap())
    };
    sketch.reference = Some(Arc::new(moved));
    let mut editor = editor(home.path(), &sketch);
    editor.perform(Action::TakePictureUnder(LEAF));
    until(&mut editor, |editor| {
        editor.dialogs.notices().iter().any(|n| n.what.contains("does not lie over"))
    });
    assert!(editor.sketch().textures.is_empty());
}

#[test]
fn a_photograph_is_cut_out_and_one_that_cannot_be_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path(), &drawing(0.0));
    editor.change(Change::reference(None));
    let [photo, plain] = ["photo.png", "plain.png"].map(|name| home.path().join(name));
    std::fs::write(&photo, photograph().bytes()).unwrap();
    let grey = Rgba { width: 40, height: 40, pixels: vec![128; 6400] };
    std::fs::write(&plain, picture_of(&grey).unwrap().bytes()).unwrap();
    let purpose = PathPurpose::Photograph(Some(OrganKind::Leaf));
    editor.perform(Action::PathChosen { purpose, path: plain });
    until(&mut editor, |editor| editor.dialogs.notices().iter().any(|n| n.what.contains("plain.png")));
    assert_eq!(editor.dialogs.notices().iter().next_back().unwrap().find, Some(purpose));
    assert!(editor.sketch().textures.is_empty());
    editor.perform(Action::PathChosen { purpose, path: photo });
    until(&mut editor, |editor| leaf_texture(editor).is_some());
    let texture = leaf_texture(&editor).unwrap();
    assert!(green(&texture, 0.15, 0.5) > green(&texture, 0.85, 0.5) + 20);
}
