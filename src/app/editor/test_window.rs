//! For tests: an editor with a drawing of the program's own, laid out in a window of 1280 × 800, and hands that work in its view
//! of the plant.

use super::{Editor, Places};
use crate::model::pick::{Element, pick};
use crate::pen::tests::Hand;
use crate::pen::{PenPhase, PenTool};
use crate::plant::{Organ, Shape};
use glam::DVec2;
use std::time::{Duration, Instant};

/// Longest wait for a plant or a click; only a test that has failed takes so long.
pub(super) const PATIENCE: Duration = Duration::from_secs(180);

/// An editor with a sketch of `assets/sketches`, built.
pub(super) fn with_sketch(home: &tempfile::TempDir, name: &str) -> (Editor, egui::Context) {
    let places = Places { config: home.path().join("config"), state: home.path().join("state") };
    let file = format!("{}/assets/sketches/{name}.penstemon", env!("CARGO_MANIFEST_DIR"));
    let mut editor = Editor::open_in(places, Some(file.into()), || ()).unwrap();
    build(&mut editor);
    let egui = egui::Context::default();
    frame(&mut editor, &egui);
    (editor, egui)
}

/// Builds what is drawn now.
pub(super) fn build(editor: &mut Editor) {
    let begun = Instant::now();
    editor.submit();
    while editor.is_working() || editor.built().is_none() {
        assert!(begun.elapsed() < PATIENCE, "it is built for ever");
        editor.submit();
        editor.collect();
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Lays out a frame of the window.
pub(super) fn frame(editor: &mut Editor, egui: &egui::Context) {
    let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 800.0)));
    // The bar below the plant has its height from the frame before.
    for _ in 0..2 {
        let input = egui::RawInput { screen_rect, ..egui::RawInput::default() };
        let mut output = egui.run_ui(input, |ui| editor.ui(ui, egui::TextureId::default()));
        output.textures_delta.clear();
    }
}

/// One event of a pointer over the plant.
pub(super) fn touch(editor: &mut Editor, (phase, tool): (PenPhase, PenTool), at: DVec2, pressure: f32) {
    let mut event = Hand { position: at, ..Hand::default() }.event(phase, tool, 0.0);
    event.sample.pressure = pressure;
    editor.plant_pen(&event);
}

/// A drag of a pointer over the plant, from one place in the window to another.
pub(super) fn drag(editor: &mut Editor, tool: PenTool, from: DVec2, to: DVec2) {
    touch(editor, (PenPhase::Down, tool), from, 0.5);
    for k in 1..=10 {
        touch(editor, (PenPhase::Move, tool), from.lerp(to, f64::from(k) / 10.0), 0.5);
    }
    touch(editor, (PenPhase::Up, tool), to, 0.0);
}

/// The first blade of a kind that is seen and hit, and where.
pub(super) fn seen_organ(editor: &Editor, is_it: impl Fn(&Organ) -> bool) -> (usize, DVec2) {
    let built = editor.built().unwrap();
    let seen = |(index, organ): (usize, &Organ)| {
        let Shape::Blade(blade) = &organ.shape else { return None };
        let blade = built.plant.templates.resolve(blade);
        let place = blade.base + blade.v * (0.6 * blade.template.length());
        let at = editor.plant.seen_at(place)?;
        let hit = pick(&built.model, &built.plant, &editor.plant.ray(editor.plant.place(at))?)?;
        (hit.element == Element::Organ(index)).then_some((index, at))
    };
    let organs = built.plant.organs.iter().enumerate().filter(|(_, organ)| is_it(organ));
    organs.filter_map(seen).next().expect("one is seen")
}
